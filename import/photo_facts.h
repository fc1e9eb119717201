/* What a photograph's EXIF says of place, time and lens (libexif). */
#ifndef STAFFAGE_IMPORT_PHOTO_FACTS_H
#define STAFFAGE_IMPORT_PHOTO_FACTS_H

#include "lib/error.h"

#include <stdbool.h>

struct photo_facts {
    bool has_position, has_height, has_time, has_exposure;
    double lat_lon_h[3];  /* deg, north and east positive; m as EXIF has it: of drones only differences can be trusted */
    char time[32];        /* "2016-06-23T16:31:59": local, DateTimeOriginal */
    char offset[8];       /* "-05:00" where EXIF 2.31 gives it, else "" */
    double exposure_s;
    double f_number, focal_mm, focal_35mm; /* 0 where EXIF does not say; the last as 35 mm film would need it */
};

/* A JPEG's facts; of a picture in another format there are none. No EXIF at all is no error.
 * Err: ERR_INPUT at path: missing; EXIF that is truncated, damaged or says what cannot be
 *      (a latitude of 97 deg, or one without N or S) */
bool photo_facts_read(struct photo_facts *facts, const char *path, struct error *err);

#endif
