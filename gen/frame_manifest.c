#include "gen/frame_impl.h"

#include "lib/file.h"
#include "lib/manifest.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Out: to (1024), empty for no path */
static bool absolute(char to[1024], const char *path, struct error *err)
{
    to[0] = 0;
    if (!path) return true;
    char *real = realpath(path, NULL);
    bool ok = real && strlen(real) < 1024;
    if (ok) snprintf(to, 1024, "%s", real);
    else error_at(err, ERR_INPUT, path, 0, 0, real ? "the path is too long: 1023 bytes are possible" : "does not exist");
    free(real);
    return ok;
}

bool frame_write_manifest(const struct frame *f, const struct frame_result *result, struct error *err)
{
    static const char *const transfers[] = { "layers", "ratio", "threshold", "alpha" };
    const struct scene *s = f->scene;
    struct manifest m = {
        .width_px = f->camera->width_px, .height_px = f->camera->height_px,
        .camera = *f->camera, .world_from_camera = f->shot->world_from_camera,
        .empty = result->empty, .view = result->view,
        .exposure_at_px = f->exposure.at_px, .exposure_fitted = f->exposure.fitted, .exposure_patch_px = f->exposure.patch_px,
        .exposure_samples = (int)f->exposure.samples,
        .t1 = s->t1, .t2 = s->t2, .t3 = s->t3,
        .overwrite_below = s->overwrite == OVERWRITE_BELOW, .mask_dilated = s->mask == MASK_DILATED,
        .has_shares = f->occluder_count > 0 || f->stage->mesh, .has_place = f->labels.place_depth.data != NULL,
        .has_place_labels = f->labels.place_label.data != NULL, .palette = s->palette, .new_view = !f->photograph[0],
        .shaded = f->shaded, .has_mist = s->has_mist, .visibility_m = s->visibility_m, .haze = { s->haze[0], s->haze[1], s->haze[2] },
        .has_motion = f->motion.data != NULL, .defocus_px = s->defocus_px, .focus_m = s->focus_m,
        .softness_auto = s->softness_auto, .sharpening_auto = s->sharpening_auto, .grain_auto = s->grain_auto,
        .vignetting_auto = s->vignetting_auto, .highlights_auto = s->highlights_auto, .blacks_auto = s->blacks_auto, .compression_auto = s->compression_auto,
        .softness_px = s->softness_px, .sharpening = s->sharpening, .grain = s->grain, .vignetting = s->vignetting,
        .highlights = s->highlights, .blacks = s->blacks, .seed = s->seed, .entity_count = f->moment.n,
    };
    memcpy(m.exposure, f->exposure.k, sizeof m.exposure);
    memcpy(m.exposure_median, f->exposure.median, sizeof m.exposure_median);
    snprintf(m.frame, sizeof m.frame, "%s", result->name);
    snprintf(m.photograph, sizeof m.photograph, "%s", f->photograph);
    snprintf(m.key, sizeof m.key, "%s", f->keys->all);
    if (!absolute(m.semantic, f->shot->semantic, err) || !absolute(m.depth, f->shot->depth, err)) return false;
    snprintf(m.transfer, sizeof m.transfer, "%s", transfers[s->transfer]);
    m.entities = calloc(f->moment.n + 1, sizeof *m.entities);
    if (!m.entities) return error_set(err, ERR_MEMORY, "no memory for a manifest");
    for (size_t i = 0; i < f->moment.n; i++) {
        m.entities[i].id = f->moment.entities[i].id;
        m.entities[i].class_ = f->moment.entities[i].class_;
        snprintf(m.entities[i].name, sizeof m.entities[i].name, "%s", f->moment.entities[i].name);
    }
    char *path = string_format("%s/frame.json", f->folder);
    bool ok = path ? manifest_write(path, &m, err) : error_set(err, ERR_MEMORY, "no memory for a path");
    free(path);
    free(m.entities);
    return ok;
}
