/* A mapping flight over the street: orthographic views of it without entities, straight down and from four sides. */
#ifndef STAFFAGE_PROVING_MAP_FLIGHT_H
#define STAFFAGE_PROVING_MAP_FLIGHT_H

#include "lib/vec.h"

#include <stdbool.h>

enum { PROVING_MAP_VIEWS = 5, PROVING_MAP_PX_PER_M = 5 };

struct map_view {
    const char *kind;               /* as write_pov knows it */
    struct vec3 right, up, forward; /* unit */
    struct vec3 middle_m;           /* what the picture's middle sees */
    int width_px, height_px;
};

/* i below PROVING_MAP_VIEWS */
struct map_view map_view(int i);
/* Out: x, y, a pixel of the view. Returns whether it has one there */
bool map_view_pixel(const struct map_view *v, int *x, int *y, struct vec3 p);

#endif
