/* What a structure-from-motion tool knows of a flight: cameras, the pose of every image, sparse
 * points. Read from COLMAP, OpenSfM or nerfstudio, in the tool's own frame. */
#ifndef STAFFAGE_IMPORT_RECONSTRUCTION_H
#define STAFFAGE_IMPORT_RECONSTRUCTION_H

#include "lib/camera.h"
#include "lib/error.h"
#include "lib/vec.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct recon_camera { char *name; struct camera camera; };
struct recon_shot {
    char *image;                     /* its name as the tool has it: "DJI_0018.JPG" */
    size_t camera;                   /* index */
    struct quat camera_from_world_q; /* as in the file, to the last digit, not normalized */
    struct vec3 camera_from_world_t;
};
struct recon_observation { size_t shot, point; struct vec2 q_px; };

struct reconstruction {
    struct recon_camera *cameras;
    struct recon_shot *shots;        /* by image name */
    struct vec3 *points;             /* sparse; may be none */
    struct recon_observation *observations;
    size_t camera_count, shot_count, point_count, observation_count;
    size_t left_out_count;           /* shots of parts that hang together with no other: only the largest is read */
    bool has_stated_error;
    double stated_error_px;          /* by the tool: the mean over the points of each one's mean reprojection error */
    bool is_enu;                     /* the tool says that its world is east, north, up, metres */
    double reference_lat_lon_h[3];   /* with is_enu: its origin */
};

/* In:  folder as the tool leaves it: COLMAP's (text or binary; binary when both are there), the one
 *      with reconstruction.json, the one with transforms.json; or that file itself
 * Out: reconstruction, initialized here; free with reconstruction_release
 * Err: ERR_INPUT at the file, with its line (text, JSON) or byte (binary): missing, truncated, an
 *      unknown camera model by name or id, an index that leads nowhere, no image */
bool colmap_read(struct reconstruction *reconstruction, const char *folder, struct error *err);
bool opensfm_read(struct reconstruction *reconstruction, const char *folder, struct error *err);
bool nerfstudio_read(struct reconstruction *reconstruction, const char *folder, struct error *err);
void reconstruction_release(struct reconstruction *reconstruction);

/* For the readers: the file at a path, or the first of names (NULL ends them) in the folder at it.
 * Returns NULL with ERR_INPUT at path when there is none; the caller frees. */
char *reconstruction_file(const char *path, const char *const *names, struct error *err);
/* Bring the shots into the order of their images' names; before observations point to them.
 * Err: ERR_INPUT at file: none, or two of one image */
bool reconstruction_sort(struct reconstruction *reconstruction, const char *file, struct error *err);

/* Lengths of the observations' reprojection errors through our cameras. */
struct reprojection {
    double rms_px, mean_px;          /* over all observations */
    double point_mean_px;            /* over the points, of each one's mean: what COLMAP calls mean reprojection error */
    size_t without_image;            /* observations of points that lie behind their camera; they count nowhere */
};
struct reprojection reconstruction_reprojection(const struct reconstruction *reconstruction);

#endif
