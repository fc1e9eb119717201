#include "post/frame_input.h"

#include "lib/file.h"
#include "lib/photograph.h"
#include "post/before.h"
#include "post/input.h"
#include "post/mist.h"
#include "post/resample.h"
#include "post/window.h"

#include <stdlib.h>
#include <string.h>

static const char *const pass_file[PASS_COUNT] = { "object.exr", "plane.exr", "shadow.exr" };

void frame_input_release(struct frame_input *f)
{
    free(f->folder);
    free(f->photograph);
    manifest_release(&f->manifest);
    image_release(&f->rgb);
    image_release(&f->instance);
    image_release(&f->depth);
    image_release(&f->semantic_before);
    image_release(&f->depth_before);
    for (int i = 0; i < PASS_COUNT; i++) image_release(&f->layers[i]);
    image_release(&f->visible);
    image_release(&f->receiver);
    image_release(&f->ground);
    image_release(&f->motion);
}

/* FOLDER/NAME; the caller frees. */
static char *path_in(const char *folder, const char *name, struct error *err)
{
    char *path = string_format("%s/%s", folder, name);
    if (!path) error_set(err, ERR_MEMORY, "no memory for a path");
    return path;
}

static bool read_manifest(struct frame_input *f, struct error *err)
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

static bool read_layer(struct image *image, const struct frame_input *f, const char *name, int channels,
                       enum pixel_type type, struct error *err)
{
    char *path = path_in(f->folder, name, err);
    bool ok = path && input_image(image, path, f->manifest.width_px, f->manifest.height_px, channels, type, err);
    free(path);
    return ok;
}

/* A layer of which only the view's window is of use. */
static bool read_layer_window(struct image *image, const struct frame_input *f, const char *name, int channels,
                              enum pixel_type type, struct error *err)
{
    struct image whole;
    if (!read_layer(&whole, f, name, channels, type, err)) return false;
    bool ok = window_cut(image, &whole, f->manifest.view.window_px, err);
    image_release(&whole);
    return ok;
}

static bool read_photograph(struct frame_input *f, struct error *err)
{
    const struct manifest *m = &f->manifest;
    f->photograph = m->new_view ? path_in(f->folder, "background.png", err) : path_from_folder(f->out, m->photograph);
    return (f->photograph || error_set(err, ERR_MEMORY, "no memory for a path")) &&
           photograph_read(&f->rgb, f->photograph, m->width_px, m->height_px, err);
}

static bool read_passes(struct frame_input *f, struct error *err)
{
    const struct view *view = &f->manifest.view;
    struct image passes[PASS_COUNT] = { 0 };
    bool ok = true;
    for (int i = 0; i < PASS_COUNT && ok; i++) {
        char *path = path_in(f->folder, pass_file[i], err);
        ok = path && input_pass(&passes[i], path, view->width_px, view->height_px, err);
        free(path);
    }
    /* Plane and shadow by the same weights, so that their ratio is 1 where they are equal. */
    ok = ok && resample_view(&f->layers[OBJECT], &passes[OBJECT], 1, view, &f->manifest.camera, err) &&
         resample_view(&f->layers[PLANE], &passes[PLANE], 2, view, &f->manifest.camera, err);
    for (int i = 0; i < PASS_COUNT; i++) image_release(&passes[i]);
    return ok;
}

/* How far away the ground is, for air and lens. */
static bool read_ground(struct frame_input *f, struct error *err)
{
    const struct manifest *m = &f->manifest;
    if (!m->has_mist && !(m->has_place && m->defocus_px > 0)) return true;
    if (m->has_place && !m->depth[0]) return window_cut(&f->ground, &f->depth_before, m->view.window_px, err);
    return read_layer_window(&f->ground, f, "place_depth.exr", 1, PIXEL_F32, err);
}

/* What only a frame in which something changes needs. */
static bool read_layers(struct frame_input *f, struct error *err)
{
    const struct manifest *m = &f->manifest;
    if (m->has_shares && (!read_layer_window(&f->visible, f, "visible.png", 1, PIXEL_U8, err) ||
                          !read_layer_window(&f->receiver, f, "receiver.png", 1, PIXEL_U8, err)))
        return false;
    return read_ground(f, err) && (!m->has_motion || read_layer_window(&f->motion, f, "motion.exr", 3, PIXEL_F32, err)) && read_passes(f, err);
}

/* A new view is rendered without the air. */
static bool veil(struct frame_input *f, struct error *err)
{
    const struct manifest *m = &f->manifest;
    struct image ground;
    if (!read_layer(&ground, f, "place_depth.exr", 1, PIXEL_F32, err)) return false;
    mist_veil(&f->rgb, &ground, m->visibility_m, m->haze, &m->camera);
    image_release(&ground);
    return true;
}

bool frame_input_read(struct frame_input *frame, const char *out, const char *name, struct error *err)
{
    struct frame_input f = { .out = out, .name = name, .folder = string_format("%s/frames/%s", out, name) };
    bool ok = f.folder || error_set(err, ERR_MEMORY, "no memory for a path");
    ok = ok && read_manifest(&f, err) && read_photograph(&f, err) &&
         read_layer(&f.instance, &f, "instance.png", 1, PIXEL_U16, err) &&
         read_layer(&f.depth, &f, "depth.exr", 1, PIXEL_F32, err) &&
         before_semantic(&f.semantic_before, out, &f.manifest, err) && before_depth(&f.depth_before, out, &f.manifest, err) &&
         (!f.manifest.new_view || !f.manifest.has_mist || veil(&f, err)) && (f.manifest.empty || read_layers(&f, err));
    if (ok) *frame = f;
    else frame_input_release(&f);
    return ok;
}
