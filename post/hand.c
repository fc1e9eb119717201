#include "post/hand.h"

#include "post/flat.h"
#include "post/sharpening.h"
#include "post/softness.h"
#include "post/transfer.h"
#include "post/window.h"

#include <math.h>
#include <stdlib.h>

#define EDGES_MIN 12        /* to tell how sharp a photograph is */
#define LAYER_EDGE_PX 0.45  /* of a layer with fewer: between what anti-aliasing leaves (0.35) and what a distorted view does (0.5) */

/* --- measuring --- */

static void take_vignetting(struct hand *h, const struct manifest *m, const struct flat_patches *patches)
{
    if (!m->vignetting_auto) {
        h->fall_off = m->vignetting;
        return;
    }
    vignette_measure(&h->vignette, patches, m->width_px, m->height_px);
    if (h->vignette.agree) h->fall_off = h->vignette.fall_off;
}

static void take_highlights(struct hand *h, const struct manifest *m, const struct image *rgb)
{
    h->knee = m->highlights > 0 ? m->highlights : 1;
    if (!m->highlights_auto) return;
    highlights_measure(&h->highlights, rgb);
    h->knee = h->highlights.told ? h->highlights.knee : 1;
}

static void take_blacks(struct hand *h, const struct manifest *m, const struct image *rgb)
{
    h->black = m->blacks;
    if (!m->blacks_auto) return;
    blacks_measure(&h->blacks, rgb);
    h->black = h->blacks.level;
}

/* A picture that was scaled has no blocks any more. */
static bool take_compression(struct hand *h, const struct manifest *m, const char *path, struct error *err)
{
    if (!m->compression_auto) return true;
    if (!compression_read(&h->compression, path, err)) return false;
    if (h->compression.width_px != m->width_px || h->compression.height_px != m->height_px) h->compression.found = false;
    return true;
}

/* What the area of a pixel leaves of an edge's width. */
static double besides_pixel(double sigma_px) { return sqrt(fmax(0, sigma_px * sigma_px - 1.0 / 12)); }

/* So much that the layer's outlines become as wide as the photograph's sharp edges. */
static bool take_softness(struct hand *h, const struct manifest *m, const struct image *rgb, const struct image *object, struct error *err)
{
    if ((m->softness_auto || m->sharpening_auto) && !edges_measure(&h->edges, rgb, NULL, err)) return false;
    const struct edges *e = &h->edges;
    if (m->sharpening_auto) h->sharpening = e->sharpening;
    if (!m->softness_auto || e->count < EDGES_MIN) return true;
    h->hider_px = fmin(besides_pixel(e->sharp_px), MANIFEST_SOFTNESS_AUTO_MAX_PX);
    if (!edges_of_layer(&h->layer_edges, object, err)) return false;
    double own_px = h->layer_edges.count < EDGES_MIN ? LAYER_EDGE_PX : h->layer_edges.sharp_px;
    double rest_px2 = e->sharp_px * e->sharp_px - own_px * own_px;
    if (rest_px2 > 0) h->softness_px = fmin(sqrt(rest_px2), MANIFEST_SOFTNESS_AUTO_MAX_PX);
    else h->too_soft_px2 = fmin(-rest_px2, SOFTNESS_TAKEN_BACK_MAX_PX2);
    return true;
}

static bool measure(struct hand *h, const struct manifest *m, const struct image *rgb, const char *path, const struct image *object,
                    struct error *err)
{
    struct flat_patches patches = { 0 };
    if ((m->grain_auto || m->vignetting_auto) && !flat_patches_find(&patches, rgb, err)) return false;
    bool ok = (!m->grain_auto || grain_measure(&h->grain, rgb, &patches, err)) &&
              take_softness(h, m, rgb, object, err) && take_compression(h, m, path, err);
    if (ok && m->grain_auto) {
        h->has_grain = h->grain.patches > 0;
        h->drawn = h->grain;
        if (h->has_grain && h->compression.found) ok = grain_before_compression(&h->drawn, &h->compression, err);
    }
    take_vignetting(h, m, &patches);
    take_highlights(h, m, rgb);
    take_blacks(h, m, rgb);
    flat_patches_release(&patches);
    return ok;
}

bool hand_measure(struct hand *hand, const struct manifest *m, const struct image *rgb, const char *path,
                  const struct image *object, struct error *err)
{
    struct hand h = { .softness_px = m->softness_auto ? 0 : m->softness_px, .sharpening = m->sharpening_auto ? 0 : m->sharpening, .knee = 1 };
    if (!m->new_view && h.softness_px > 0) h.hider_px = besides_pixel(hypot(h.softness_px, LAYER_EDGE_PX));
    if (!m->grain_auto && m->grain > 0) {
        h.has_grain = true;
        h.grain = h.drawn = grain_white(m->grain);
    }
    /* No camera took a new view: what is to be measured is not there. */
    struct manifest given = *m;
    if (m->new_view)
        given.softness_auto = given.sharpening_auto = given.grain_auto = given.vignetting_auto = given.highlights_auto = given.blacks_auto = given.compression_auto = false;
    if (!measure(&h, &given, rgb, path, object, err)) return false;
    *hand = h;
    return true;
}

/* --- doing --- */

static uint8_t byte_of(float level)
{
    return (uint8_t)((level > 0 ? level < 255 ? level : 255 : 0) + 0.5f);
}

/* Values that changed, as the camera's levels; those that did not keep theirs, and so do those that stay the same byte. */
static bool levels_take(struct image *levels, const struct image *rgb, const struct image *before, const struct image *after,
                        double black, struct rect w, struct error *err)
{
    if (!image_init(levels, after->width_px, after->height_px, 3, PIXEL_F32, err)) return false;
    for (int y = 0; y < after->height_px; y++) {
        const float *now = image_f32(after, 0, y), *then = image_f32(before, 0, y);
        const uint8_t *own = image_u8(rgb, w.x0, w.y0 + y);
        float *to = image_f32(levels, 0, y);
        for (int i = 0; i < 3 * after->width_px; i++) {
            float v = now[i] > 0 ? now[i] < 1 ? now[i] : 1 : 0;
            to[i] = now[i] == then[i] ? own[i] : (float)blacks_crush(black, (double)srgb_from_linear(v) * 255);
        }
    }
    return true;
}

/* A level that did not change is the whole number that it was, and keeps every bit. */
static void put_levels(struct image *to, const struct image *levels, struct rect w)
{
    for (int y = 0; y < levels->height_px; y++) {
        const float *level = image_f32(levels, 0, y);
        uint8_t *out = image_u8(to, w.x0, w.y0 + y);
        for (int i = 0; i < 3 * levels->width_px; i++) out[i] = byte_of(level[i]);
    }
}

static bool compress(struct image *levels, const struct image *rgb, const struct compression *c, struct rect w, struct error *err)
{
    struct image filed;
    struct rect whole = { 0, 0, rgb->width_px, rgb->height_px };
    if (!window_cut(&filed, rgb, whole, err)) return false;
    put_levels(&filed, levels, w);
    bool ok = compression_apply(&filed, w, c, err);
    for (int y = 0; ok && y < levels->height_px; y++) {
        float *level = image_f32(levels, 0, y);
        const uint8_t *own = image_u8(rgb, w.x0, w.y0 + y), *now = image_u8(&filed, w.x0, w.y0 + y);
        for (int x = 0; x < levels->width_px; x++, level += 3, own += 3, now += 3) {
            bool changed = byte_of(level[0]) != own[0] || byte_of(level[1]) != own[1] || byte_of(level[2]) != own[2];
            for (int c3 = 0; changed && c3 < 3; c3++) level[c3] = now[c3];
        }
    }
    image_release(&filed);
    return ok;
}

static bool cover_take(struct image *cover, const struct image *object, const struct image *visible, struct error *err)
{
    if (!image_init(cover, object->width_px, object->height_px, 1, PIXEL_F32, err)) return false;
    size_t n = (size_t)cover->width_px * (size_t)cover->height_px;
    for (size_t i = 0; i < n; i++) ((float *)cover->data)[i] = ((const float *)object->data)[4 * i + 3] * transfer_share(visible, i);
    return true;
}

static bool sharpen(struct image *levels, const struct image *rgb, const struct image *cover, double amount, struct rect w, struct error *err)
{
    struct image own;
    if (!image_init(&own, levels->width_px, levels->height_px, 3, PIXEL_F32, err)) return false;
    for (int y = 0; y < own.height_px; y++)
        for (int i = 0; i < 3 * own.width_px; i++) image_f32(&own, 0, y)[i] = image_u8(rgb, w.x0, w.y0 + y)[i];
    bool ok = sharpening_add(levels, &own, cover, amount, err);
    image_release(&own);
    return ok;
}

/* In the camera's order. */
bool hand_develop(struct image *rgb, const struct hand *hand, const struct manifest *m, const struct image *before,
                  const struct image *after, const struct image *object, const struct image *visible, struct error *err)
{
    struct image levels = { 0 }, cover = { 0 };
    struct rect w = m->view.window_px;
    struct draw_key key = { .seed = (uint64_t)m->seed, .frame = strtoll(m->frame, NULL, 10) };
    bool ok = levels_take(&levels, rgb, before, after, hand->black, w, err) && cover_take(&cover, object, visible, err) &&
              (hand->sharpening <= 0 || sharpen(&levels, rgb, &cover, hand->sharpening, w, err)) &&
              (!hand->has_grain || grain_add(&levels, &cover, &hand->drawn, key, w, m->width_px, err)) &&
              (!hand->compression.found || compress(&levels, rgb, &hand->compression, w, err));
    if (ok) put_levels(rgb, &levels, w);
    image_release(&levels);
    image_release(&cover);
    return ok;
}
