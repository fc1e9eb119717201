#include "post/before.h"

#include "lib/file.h"
#include "post/input.h"

#include <stdlib.h>

/* A file of the frame's folder. */
static bool read_place(struct image *image, const char *out, const struct manifest *m, const char *name,
                       enum pixel_type type, struct error *err)
{
    char *path = string_format("%s/frames/%s/%s", out, m->frame, name);
    bool ok = path ? input_image(image, path, m->width_px, m->height_px, 1, type, err)
                   : error_set(err, ERR_MEMORY, "no memory for a path");
    free(path);
    return ok;
}

bool before_semantic(struct image *semantic, const char *out, const struct manifest *m, struct error *err)
{
    *semantic = (struct image){ 0 };
    if (!m->semantic[0])
        return !m->has_place_labels || read_place(semantic, out, m, "place_labels.png", PIXEL_U8, err);
    char *path = path_from_folder(out, m->semantic);
    struct image read = { 0 };
    bool ok = (path || error_set(err, ERR_MEMORY, "no memory for a path")) &&
              input_nearest(&read, path, m->width_px, m->height_px, err);
    if (ok && read.type != PIXEL_U8)
        ok = error_at(err, ERR_INPUT, path, 0, 0, "is no semantic image: 8-bit colours or 8-bit ids would be right");
    if (ok) *semantic = read;
    else image_release(&read);
    free(path);
    return ok;
}

bool before_depth(struct image *depth, const char *out, const struct manifest *m, struct error *err)
{
    *depth = (struct image){ 0 };
    if (!m->depth[0]) return !m->has_place || read_place(depth, out, m, "place_depth.exr", PIXEL_F32, err);
    char *path = path_from_folder(out, m->depth);
    struct image read = { 0 };
    bool ok = (path || error_set(err, ERR_MEMORY, "no memory for a path")) &&
              input_nearest(&read, path, m->width_px, m->height_px, err);
    if (ok && (read.channels != 1 || read.type == PIXEL_U8))
        ok = error_at(err, ERR_INPUT, path, 0, 0,
                      "is no depth image: one channel of metres (EXR) or of millimetres (16-bit PNG) would be right");
    if (ok) *depth = read;
    else image_release(&read);
    free(path);
    return ok;
}
