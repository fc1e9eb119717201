/* The scene file of an imported flight, for people to read and to go on with. */
#ifndef STAFFAGE_IMPORT_SCENE_YAML_H
#define STAFFAGE_IMPORT_SCENE_YAML_H

#include "import/photographs.h"
#include "import/placement.h"
#include "import/reconstruction.h"
#include "lib/error.h"

#include <stdbool.h>

struct imported {
    const char *tool;          /* "COLMAP" */
    const struct reconstruction *reconstruction;
    const struct photographs *photographs;
    const struct placement *placement;
    const char *utc_offset;    /* "-05:00" or NULL */
    const char *mesh, *roads;  /* as the scene file names them, or NULL */
};

/* Every number is written with as many digits as bring back the very same double.
 * Out: *text, the caller frees. What decides the picture and cannot be known from a reconstruction (light,
 * exposure, models, traffic) is there as comments to be completed.
 * Err: ERR_MEMORY */
bool scene_yaml_write(char **text, const struct imported *imported, struct error *err);

/* True when every shot has a time with an offset: all get one or none does. */
bool scene_yaml_has_times(const struct imported *imported);

#endif
