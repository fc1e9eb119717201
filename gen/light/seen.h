/* What a picture shows of the place, as radiance: its linear values over its exposure. */
#ifndef STAFFAGE_GEN_SEEN_H
#define STAFFAGE_GEN_SEEN_H

#include "lib/camera.h"
#include "lib/image.h"
#include "lib/vec.h"

#include <stdbool.h>

struct seen {
    const struct image *picture;       /* U8, 3 channels, sRGB; borrowed, as all pointers here */
    const struct camera *camera;       /* at the size of the picture */
    struct pose world_from_camera;
    double k[3];                       /* the exposure */
    double visibility_m, haze[3];      /* mist in the picture, haze in its linear values; visibility 0: none */
    const struct image *unhidden;      /* U8, 1 channel: 0 where something stands before it (unhidden.h); NULL: nowhere */
    struct pose camera_from_world;     /* made by seen_init, as what follows */
    double linear[256], pixel_rad;     /* pixel_rad: between neighbouring pixels, where the lens looks */
};

/* Fill in what follows from the rest. */
void seen_init(struct seen *seen);

/* Where a world point is in the picture. False when it is behind the camera or outside. */
bool seen_project(const struct seen *seen, struct vec2 *q_px, struct vec3 p_m);

/* How far along the ground a camera so high above it tells ground from what stands there: a pixel of it is
 * shorter than half a metre. It depends on the camera alone, so that nothing changes from frame to frame. */
double seen_ground_reach(const struct seen *seen, double height_m);

/* How much of what is at a pixel position is to be believed: 0 at the picture's edges, 1 a fiftieth of the picture's
 * width inside. */
double seen_within(const struct seen *seen, struct vec2 q_px);
bool seen_hidden(const struct seen *seen, struct vec2 q_px);
/* Both: 0 where something is hidden. */
double seen_trust(const struct seen *seen, struct vec2 q_px);

/* Does something of a place stand nearer beside a pixel position? By so much its outlines are off in a reconstruction, and what the
 * picture shows there may be of either.
 * In: place_depth F32, z in the picture, NaN where there is none; p_m what is looked at, at q_px; normal its surface's, unit */
bool seen_beside_nearer(const struct seen *seen, const struct image *place_depth, struct vec2 q_px, struct vec3 p_m, struct vec3 normal);

/* The radiance at a pixel position, between the middles of pixels linearly, through whatever air there is.
 * Returns true when the sensor may have been saturated: then there was this light, or more. */
bool seen_radiance(const struct seen *seen, double rgb[3], struct vec2 q_px);

/* The same without the air before it. */
void seen_clear_air(const struct seen *seen, double rgb[3], double distance_m);

#endif
