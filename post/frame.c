#include "post/frame.h"

#include "lib/file.h"
#include "lib/image.h"
#include "lib/manifest.h"
#include "post/depth.h"
#include "post/exposure.h"
#include "post/input.h"
#include "post/mask.h"
#include "post/output.h"
#include "post/resample.h"
#include "post/semantic.h"
#include "post/transfer.h"
#include "post/window.h"

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { OBJECT, PLANE, SHADOW, PASS_COUNT };
static const char *const pass_file[PASS_COUNT] = { "object.exr", "plane.exr", "shadow.exr" };

struct frame {
    const char *out, *name;         /* the output folder and "000123"; borrowed */
    char *folder;                   /* OUT/frames/NAME */
    char *photograph;               /* its path */
    struct manifest manifest;
    struct image rgb;               /* the photograph, then the result: U8, 3 channels */
    struct image instance, classes; /* U16 ids; U8 as of semantic_classes */
    struct image depth;             /* F32 */
    /* of the view's window only, and empty where nothing changes */
    struct image layers[PASS_COUNT];
    struct image visible, receiver; /* U8; empty without occluders */
};

static void frame_release(struct frame *f)
{
    free(f->folder);
    free(f->photograph);
    manifest_release(&f->manifest);
    image_release(&f->rgb);
    image_release(&f->instance);
    image_release(&f->classes);
    image_release(&f->depth);
    for (int i = 0; i < PASS_COUNT; i++) image_release(&f->layers[i]);
    image_release(&f->visible);
    image_release(&f->receiver);
}

/* FOLDER/NAME; the caller frees. */
static char *path_in(const char *folder, const char *name, struct error *err)
{
    char *path = string_format("%s/%s", folder, name);
    if (!path) error_set(err, ERR_MEMORY, "no memory for a path");
    return path;
}

/* Say which file an error is about that was found in its pixels. Always returns false. */
static bool blame(struct error *err, const char *path)
{
    if (!err->file[0]) snprintf(err->file, sizeof err->file, "%s", path);
    return false;
}

static bool read_manifest(struct frame *f, struct error *err)
{
    struct manifest *m = &f->manifest;
    char *path = path_in(f->folder, "frame.json", err);
    bool ok = path && manifest_read(m, path, err);
    if (ok && strcmp(m->frame, f->name) != 0)
        ok = error_at(err, ERR_INPUT, path, 0, 0, "is of frame \"%s\": \"%s\" would be right", m->frame, f->name);
    if (ok && !m->empty && !window_inside(m->view.window_px, m->width_px, m->height_px))
        ok = error_at(err, ERR_INPUT, path, 0, 0, "the view's window lies outside the picture");
    free(path);
    return ok;
}

static bool read_layer(struct image *image, const struct frame *f, const char *name, enum pixel_type type,
                       struct error *err)
{
    char *path = path_in(f->folder, name, err);
    bool ok = path && input_image(image, path, f->manifest.width_px, f->manifest.height_px, 1, type, err);
    free(path);
    return ok;
}

/* A layer of which only the view's window is of use. */
static bool read_layer_window(struct image *image, const struct frame *f, const char *name, struct error *err)
{
    struct image whole;
    if (!read_layer(&whole, f, name, PIXEL_U8, err)) return false;
    bool ok = window_cut(image, &whole, f->manifest.view.window_px, err);
    image_release(&whole);
    return ok;
}

static bool read_photograph(struct frame *f, struct error *err)
{
    const struct manifest *m = &f->manifest;
    f->photograph = m->photograph[0] == '/' ? strdup(m->photograph) : path_in(f->out, m->photograph, err);
    if (!f->photograph) return error_set(err, ERR_MEMORY, "no memory for a path");
    return input_photograph(&f->rgb, f->photograph, m->width_px, m->height_px, err);
}

static bool read_passes(struct frame *f, struct error *err)
{
    const struct view whole = f->manifest.view, reduced = view_reduced(&whole, f->manifest.receiver_reduction);
    const struct view *const views[PASS_COUNT] = { &whole, &reduced, &reduced };
    struct image passes[PASS_COUNT] = { 0 };
    bool ok = true;
    for (int i = 0; i < PASS_COUNT && ok; i++) {
        char *path = path_in(f->folder, pass_file[i], err);
        ok = path && input_pass(&passes[i], path, views[i]->width_px, views[i]->height_px, err);
        free(path);
    }
    /* Plane and shadow by the same weights, so that their ratio is 1 where they are equal. */
    ok = ok && resample_view(&f->layers[OBJECT], &passes[OBJECT], 1, &whole, &f->manifest.camera, err) &&
         resample_view(&f->layers[PLANE], &passes[PLANE], 2, &reduced, &f->manifest.camera, err);
    for (int i = 0; i < PASS_COUNT; i++) image_release(&passes[i]);
    return ok;
}

static bool find_classes(struct frame *f, struct error *err)
{
    if (semantic_classes(&f->classes, &f->instance, &f->manifest, err)) return true;
    char *path = path_in(f->folder, "instance.png", err);
    if (path) blame(err, path);
    free(path);
    return false;
}

static bool find_exposure(struct exposure *exposure, const struct frame *f, struct error *err)
{
    const struct manifest *m = &f->manifest;
    if (m->exposure_given)
        *exposure = exposure_given(m->exposure);
    else if (!exposure_fit(exposure, &f->rgb, m->exposure_patch_px, m->ground_radiance, m->white_balance, err))
        return blame(err, f->photograph);
    char *path = path_in(f->folder, "exposure.json", err);
    bool ok = path && exposure_write(path, exposure, err);
    free(path);
    return ok;
}

static bool transfer(struct image *out, const struct frame *f, const struct transfer_input *in, struct error *err)
{
    const struct manifest *m = &f->manifest;
    if (!strcmp(m->transfer, "layers")) return transfer_layers(out, in, err);
    if (!strcmp(m->transfer, "ratio")) return transfer_ratio(out, in, err);
    if (!strcmp(m->transfer, "alpha")) return transfer_alpha(out, in, err);
    assert(!strcmp(m->transfer, "threshold"));
    struct transfer_thresholds t = { m->t1, m->t2, m->t3, m->overwrite_below };
    struct image classes;
    if (!window_cut(&classes, &f->classes, m->view.window_px, err)) return false;
    bool ok = transfer_threshold(out, in, &classes, &t, err);
    image_release(&classes);
    return ok;
}

/* Only what changed goes back to 8 bits: every other pixel keeps the photograph's own. */
static void paste_changes(struct image *rgb, const struct image *merged, const struct image *linear, struct rect w)
{
    for (int y = 0; y < merged->height_px; y++) {
        const float *now = image_f32(merged, 0, y), *before = image_f32(linear, 0, y);
        uint8_t *to = image_u8(rgb, w.x0, w.y0 + y);
        for (int i = 0; i < 3 * merged->width_px; i++) {
            if (now[i] == before[i]) continue;
            float v = now[i] > 0 ? now[i] < 1 ? now[i] : 1 : 0;
            to[i] = (uint8_t)(srgb_from_linear(v) * 255 + 0.5f);
        }
    }
}

static bool merge(struct frame *f, struct error *err)
{
    const struct manifest *m = &f->manifest;
    struct image cut = { 0 }, linear = { 0 }, merged = { 0 };
    struct exposure exposure;
    bool ok = find_exposure(&exposure, f, err) && window_cut(&cut, &f->rgb, m->view.window_px, err) &&
              image_linear_from_srgb(&linear, &cut, err);
    if (ok) {
        struct transfer_input in = {
            .photograph = &linear, .object = &f->layers[OBJECT], .plane = &f->layers[PLANE], .shadow = &f->layers[SHADOW],
            .visible = m->has_shares ? &f->visible : NULL, .receiver = m->has_shares ? &f->receiver : NULL,
            .exposure = { exposure.k[0], exposure.k[1], exposure.k[2] },
        };
        ok = transfer(&merged, f, &in, err);
    }
    if (ok) paste_changes(&f->rgb, &merged, &linear, m->view.window_px);
    image_release(&cut);
    image_release(&linear);
    image_release(&merged);
    return ok;
}

static bool write_outputs(const struct frame *f, struct error *err)
{
    const char *out = f->out, *name = f->name, *from = f->folder;
    struct image color = { 0 }, ids = { 0 }, millimetres = { 0 };
    bool ok = semantic_color(&color, &f->classes, err) && semantic_ids(&ids, &f->classes, err) &&
              depth_millimetres(&millimetres, &f->depth, err) &&
              output_image(out, "semantic", name, ".png", &color, err) &&
              output_image(out, "semantic_id", name, ".png", &ids, err) &&
              output_image(out, "instance", name, ".png", &f->instance, err) &&
              output_image(out, "depth", name, ".png", &millimetres, err) &&
              output_copy(out, "depth", name, ".exr", from, "depth.exr", err) &&
              output_copy(out, "amodal", name, ".json", from, "amodal.json", err) &&
              output_copy_folder(out, "amodal", name, from, "amodal", err) &&
              output_copy(out, "labels", name, ".json", from, "labels.json", err) &&
              output_image(out, "rgb", name, ".png", &f->rgb, err);
    image_release(&color);
    image_release(&ids);
    image_release(&millimetres);
    return ok;
}

static bool post(struct frame *f, struct error *err)
{
    if (!read_manifest(f, err)) return false;
    const struct manifest *m = &f->manifest;
    bool hidden = m->has_shares && !m->empty;
    if (!read_photograph(f, err) || !read_layer(&f->instance, f, "instance.png", PIXEL_U16, err) ||
        !read_layer(&f->depth, f, "depth.exr", PIXEL_F32, err))
        return false;
    if (hidden && (!read_layer_window(&f->visible, f, "visible.png", err) ||
                   !read_layer_window(&f->receiver, f, "receiver.png", err)))
        return false;
    if (!m->empty && !read_passes(f, err)) return false;
    if (!m->empty && m->mask_dilated &&
        !mask_dilate(&f->instance, &f->layers[OBJECT], hidden ? &f->visible : NULL, m->view.window_px, err))
        return false;
    return find_classes(f, err) && (m->empty || merge(f, err)) && write_outputs(f, err);
}

bool frame_post(const char *out, const char *name, struct error *err)
{
    struct frame f = { .out = out, .name = name, .folder = string_format("%s/frames/%s", out, name) };
    bool ok = f.folder ? post(&f, err) : error_set(err, ERR_MEMORY, "no memory for a path");
    frame_release(&f);
    return ok;
}
