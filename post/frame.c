#include "post/frame.h"

#include "lib/file.h"
#include "post/depth.h"
#include "post/frame_input.h"
#include "post/hand.h"
#include "post/mask.h"
#include "post/optics.h"
#include "post/output.h"
#include "post/semantic.h"
#include "post/softness.h"
#include "post/transfer.h"
#include "post/window.h"

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Say which file an error is about that was found in its pixels. Always returns false. */
static bool blame(struct error *err, const char *path)
{
    if (!err->file[0]) snprintf(err->file, sizeof err->file, "%s", path);
    return false;
}

static char *path_in_folder(const struct frame_input *f, const char *name, struct error *err)
{
    char *path = string_format("%s/%s", f->folder, name);
    if (!path) error_set(err, ERR_MEMORY, "no memory for a path");
    return path;
}

static bool find_classes(struct image *classes, const struct frame_input *f, struct error *err)
{
    if (semantic_classes(classes, &f->instance, &f->manifest, err)) return true;
    char *path = path_in_folder(f, "instance.png", err);
    if (path) blame(err, path);
    free(path);
    return false;
}

static bool transfer(struct image *out, const struct frame_input *f, const struct image *classes,
                     const struct transfer_input *in, struct error *err)
{
    const struct manifest *m = &f->manifest;
    if (!strcmp(m->transfer, "layers")) return transfer_layers(out, in, err);
    if (!strcmp(m->transfer, "ratio")) return transfer_ratio(out, in, err);
    if (!strcmp(m->transfer, "alpha")) return transfer_alpha(out, in, err);
    assert(!strcmp(m->transfer, "threshold"));
    struct transfer_thresholds t = { m->t1, m->t2, m->t3, m->overwrite_below };
    struct image cut;
    if (!window_cut(&cut, classes, m->view.window_px, err)) return false;
    bool ok = transfer_threshold(out, in, &cut, &t, err);
    image_release(&cut);
    return ok;
}

/* What air and lens do to the layers. */
static bool through_optics(struct frame_input *f, const struct hand *hand, const struct image *linear, struct error *err)
{
    const struct manifest *m = &f->manifest;
    struct image depth;
    if (!optics_wanted(m) && hand->too_soft_px2 <= 0) return true;
    if (!window_cut(&depth, &f->depth, m->view.window_px, err)) return false;
    struct optics_input in = {
        .manifest = m, .photograph = linear, .depth = &depth, .ground = &f->ground, .motion = &f->motion,
        .visible = m->has_shares ? &f->visible : NULL, .receiver = m->has_shares ? &f->receiver : NULL,
        .exposure = { m->exposure[0], m->exposure[1], m->exposure[2] }, .too_soft_px2 = hand->too_soft_px2,
    };
    bool ok = optics_apply(&f->layers[OBJECT], &f->layers[PLANE], &f->layers[SHADOW], &in, err);
    image_release(&depth);
    return ok;
}

static bool find_hand(struct hand *hand, struct frame_input *f, struct error *err)
{
    if (!hand_measure(hand, &f->manifest, &f->rgb, f->photograph, &f->layers[OBJECT], err)) return blame(err, f->photograph);
    char *path = path_in_folder(f, "camera.json", err);
    bool ok = path && hand_write(path, hand, &f->manifest, err);
    free(path);
    f->manifest.softness_px = hand->softness_px;
    return ok;
}

/* What hides is in the photograph, and as soft as all of it. */
static bool soften_hiders(struct frame_input *f, const struct hand *hand, struct error *err)
{
    return !f->manifest.has_shares || hand->hider_px <= 0 ||
           (softness_share(&f->visible, hand->hider_px, err) && softness_share(&f->receiver, hand->hider_px, err));
}

/* The lens darkens before it blurs; the sensor's highlights come after. */
static bool through_lens(struct frame_input *f, const struct hand *hand, const struct image *linear, struct error *err)
{
    const struct manifest *m = &f->manifest;
    struct image *object = &f->layers[OBJECT];
    if (hand->fall_off > 0)
        vignette_shade(object, hand->fall_off, m->exposure_at_px, m->view.window_px, m->width_px, m->height_px);
    if (!through_optics(f, hand, linear, err) || !soften_hiders(f, hand, err)) return false;
    if (hand->knee < 1) highlights_keep(object, hand->knee, m->exposure);
    return true;
}

/* Put the layers into f->rgb. */
static bool merge(struct frame_input *f, const struct image *classes, struct error *err)
{
    const struct manifest *m = &f->manifest;
    struct image cut = { 0 }, linear = { 0 }, merged = { 0 };
    struct hand hand;
    const struct image *visible = m->has_shares ? &f->visible : NULL;
    bool ok = find_hand(&hand, f, err) && window_cut(&cut, &f->rgb, m->view.window_px, err) &&
              image_linear_from_srgb(&linear, &cut, err);
    if (ok && hand.black > 0) blacks_lift_image(&linear, &cut, hand.black);
    ok = ok && through_lens(f, &hand, &linear, err);
    if (ok) {
        struct transfer_input in = {
            .photograph = &linear, .object = &f->layers[OBJECT], .plane = &f->layers[PLANE], .shadow = &f->layers[SHADOW],
            .visible = visible, .receiver = m->has_shares ? &f->receiver : NULL,
            .exposure = { m->exposure[0], m->exposure[1], m->exposure[2] },
        };
        ok = transfer(&merged, f, classes, &in, err);
    }
    ok = ok && hand_develop(&f->rgb, &hand, m, &linear, &merged, &f->layers[OBJECT], visible, err);
    image_release(&cut);
    image_release(&linear);
    image_release(&merged);
    return ok;
}

static bool write_semantic(const struct frame_input *f, const struct image *classes, struct error *err)
{
    enum palette palette = f->manifest.palette;
    struct image color = { 0 }, ids = { 0 };
    bool ok = semantic_color(&color, classes, &f->semantic_before, palette, err) &&
              semantic_ids(&ids, classes, &f->semantic_before, palette, err) &&
              output_image(f->out, "semantic", f->name, ".png", &color, err) &&
              output_image(f->out, "semantic_id", f->name, ".png", &ids, err);
    image_release(&color);
    image_release(&ids);
    return ok;
}

static bool write_depth(const struct frame_input *f, struct error *err)
{
    struct image metres = { 0 }, millimetres = { 0 };
    bool ok = depth_overwrite(&metres, &millimetres, &f->depth_before, &f->depth, err) &&
              output_image(f->out, "depth", f->name, ".png", &millimetres, err) &&
              (f->depth_before.data ? output_image(f->out, "depth", f->name, ".exr", &metres, err)
                                    : output_copy(f->out, "depth", f->name, ".exr", f->folder, "depth.exr", err));
    image_release(&metres);
    image_release(&millimetres);
    return ok;
}

static bool write_outputs(const struct frame_input *f, const struct image *classes, struct error *err)
{
    const char *out = f->out, *name = f->name, *from = f->folder;
    return write_semantic(f, classes, err) && output_image(out, "instance", name, ".png", &f->instance, err) &&
           write_depth(f, err) && output_copy(out, "amodal", name, ".json", from, "amodal.json", err) &&
           output_copy_folder(out, "amodal", name, from, "amodal", err) &&
           output_copy(out, "labels", name, ".json", from, "labels.json", err) &&
           output_image(out, "rgb", name, ".png", &f->rgb, err);
}

static bool post(struct frame_input *f, struct error *err)
{
    const struct manifest *m = &f->manifest;
    struct image classes = { 0 };
    if (!m->empty && m->mask_dilated &&
        !mask_dilate(&f->instance, &f->layers[OBJECT], m->has_shares ? &f->visible : NULL, m->view.window_px, err))
        return false;
    bool ok = find_classes(&classes, f, err) && (m->empty || merge(f, &classes, err)) && write_outputs(f, &classes, err);
    image_release(&classes);
    return ok;
}

bool frame_post(const char *out, const char *name, struct error *err)
{
    struct frame_input f;
    if (!frame_input_read(&f, out, name, err)) return false;
    bool ok = post(&f, err);
    frame_input_release(&f);
    return ok;
}
