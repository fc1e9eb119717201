/* What COLMAP's files say, id by id, before ids become indices: what the text and the binary
 * reader both fill. */
#ifndef STAFFAGE_IMPORT_COLMAP_RECORDS_H
#define STAFFAGE_IMPORT_COLMAP_RECORDS_H

#include "lib/camera.h"
#include "lib/error.h"
#include "lib/vec.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* `where` is a line of the file or, in a binary one, a byte. */
struct colmap_camera { uint64_t id; size_t where; struct camera camera; };
struct colmap_image {
    uint64_t id, camera_id;
    size_t where;
    char *name;
    struct quat camera_from_world_q;
    struct vec3 camera_from_world_t;
    size_t first, count; /* of its keypoints */
};
struct colmap_keypoint { struct vec2 q_px; uint64_t point_id; size_t where; };
struct colmap_point { uint64_t id; size_t where; struct vec3 p; double error_px; };

struct colmap_records {
    bool binary;
    char *cameras_file, *images_file, *points_file;
    struct colmap_camera *cameras;
    struct colmap_image *images;
    struct colmap_keypoint *keypoints; /* those that belong to a point */
    struct colmap_point *points;
    size_t camera_count, image_count, keypoint_count, point_count;
    size_t camera_room, image_room, keypoint_room, point_room;
};

/* Record an error at a line or byte of one of the files. Always returns false. */
__attribute__((format(printf, 5, 6)))
bool colmap_fault(const struct colmap_records *records, const char *file, size_t where, struct error *err,
                  const char *format, ...);

/* Append; each checks what it is given and keeps a copy. where is in the record.
 * Err: ERR_INPUT: a size or focal length that is none, a rotation of norm 0, a figure that is not finite */
bool colmap_add_camera(struct colmap_records *records, const struct colmap_camera *camera, struct error *err);
bool colmap_add_image(struct colmap_records *records, const struct colmap_image *image, const char *name,
                      size_t name_length, struct error *err);
/* Of the image that was added last. */
bool colmap_add_keypoint(struct colmap_records *records, const struct colmap_keypoint *keypoint, struct error *err);
bool colmap_add_point(struct colmap_records *records, const struct colmap_point *point, struct error *err);

/* Read the three files named in records. */
bool colmap_read_text(struct colmap_records *records, struct error *err);
bool colmap_read_binary(struct colmap_records *records, struct error *err);

#endif
