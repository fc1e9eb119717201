/* The frame manifest, frames/NNNNNN/frame.json: all that post needs to know of a frame,
 * written by gen as the last file of a frame. Paths are relative to the output folder. */
#ifndef STAFFAGE_LIB_MANIFEST_H
#define STAFFAGE_LIB_MANIFEST_H

#include "lib/camera.h"
#include "lib/class.h"
#include "lib/error.h"
#include "lib/view.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define MANIFEST_VERSION 5
#define MANIFEST_SOFTNESS_AUTO_MAX_PX 2.5 /* so far does the window leave room for a softness that is measured */
#define MANIFEST_SHARPENING_REACH_PX 3

struct manifest_entity { uint16_t id; char name[128]; enum entity_class class_; };

struct manifest {
    char frame[16];             /* "000123" */
    char photograph[1024];      /* absolute, or relative to the output folder; "" in a new view */
    int width_px, height_px;    /* of the result; the photograph is scaled to it */
    bool new_view;              /* no photograph: background.png in the frame's folder, rendered from the mesh */
    char key[17];               /* hash of all that the frame depends on, 16 hex digits */
    struct camera camera;
    struct pose world_from_camera;
    bool empty;                 /* nothing changes in this frame: no passes were written */
    struct view view;           /* of the passes; absent in an empty frame */
    double exposure[3];         /* linear photograph value per unit of radiance */
    struct vec2 exposure_at_px; /* where in the picture it was found: there it is right, whatever the lens takes away */
    bool exposure_fitted;       /* to the picture, else given */
    int exposure_samples;       /* fitted to so many pixels of roads, */
    struct rect exposure_patch_px; /* or, where these are 0, to this patch */
    double exposure_median[3];  /* of what it was fitted to, linear */
    char transfer[16];          /* layers, ratio, threshold, alpha */
    double t1, t2, t3;          /* 0..255 */
    bool overwrite_below;
    bool mask_dilated;
    bool has_shares;            /* visible.png and receiver.png are there: occluders, or a place in front */
    bool has_place;             /* place_depth.exr is there: F32, z of the static mesh, NaN where it has none */
    bool has_place_labels;      /* place_labels.png is there: U8, class ids of the static mesh in `palette` */
    enum palette palette;       /* of semantic/ and semantic_id/ */
    char semantic[1024];        /* the photograph's own semantic image (colours or ids), "" for none */
    char depth[1024];           /* the photograph's own depth image, "" for none */
    double shaded;              /* share of the ground in view that the photograph shows in the shade, 0 where it was not looked for */
    bool has_mist;              /* entities and their shadows fade with distance */
    double visibility_m;        /* meteorological: contrast falls to 5 % (WMO) */
    double haze[3];             /* colour of the air far away, linear values of the photograph */
    bool has_motion;            /* motion.exr is there: F32, 3 channels: pixels right and down that what is seen
                                 * (an entity, or the shade of one) moves while the shutter is open; and 0 */
    double defocus_px;          /* diameter of the blur at infinite distance, in px, 0: none */
    double focus_m;             /* distance of focus: diameter at z is defocus_px * |1 - focus_m / z| */
    /* what is measured on the photograph (auto), or else given; a new view has none to measure on */
    bool softness_auto, sharpening_auto, grain_auto, vignetting_auto, highlights_auto, blacks_auto, compression_auto;
    double softness_px;         /* standard deviation of a blur that all of the photograph has; 0: none */
    double sharpening;          /* part of what the photograph differs by from itself blurred, that was added to it */
    double grain;               /* standard deviation of the noise in 8-bit levels; 0: none */
    double vignetting;          /* share of the light that the corners lose; 0: none */
    double highlights;          /* linear value from which they are compressed; 0: none */
    double blacks;              /* level, 0 to 255, that comes out as 0; 0: none */
    int seed;                   /* of the scene, for the grain */
    struct manifest_entity *entities;
    size_t entity_count;
};

/* Err: ERR_INPUT for a text that is not UTF-8, ERR_BUG for what manifest_read would refuse */
bool manifest_write(const char *path, const struct manifest *manifest, struct error *err);
/* Out: what gen wrote, every double to the bit; of an empty frame no view and no exposure.
 *      Release it.
 * Err: ERR_INPUT at the path for a file that is not one of ours, or of another version */
bool manifest_read(struct manifest *manifest, const char *path, struct error *err);
void manifest_release(struct manifest *manifest);

#endif
