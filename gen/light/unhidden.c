#include "gen/light/unhidden.h"

#include "gen/trace/polygon.h"

#include <stdlib.h>
#include <string.h>

enum { REACH_PX = 2, PICTURE_PX = 800 }; /* REACH_PX, and one more for every PICTURE_PX of the picture's width */

/* Everything within reach of the covered pixels of a row. */
static void hide_row(struct image *unhidden, const uint64_t *samples, struct rect r, int y, int reach)
{
    for (int x = r.x0; x < r.x1; x++) {
        if (!samples[x - r.x0]) continue;
        int x0 = x > reach ? x - reach : 0, x1 = x + reach < unhidden->width_px ? x + reach + 1 : unhidden->width_px;
        for (int v = y > reach ? y - reach : 0; v <= y + reach && v < unhidden->height_px; v++)
            memset(image_u8(unhidden, x0, v), 0, (size_t)(x1 - x0));
    }
}

static bool hide(struct image *unhidden, const struct occluder *o, int reach)
{
    struct polygon polygon = { 0 };
    if (!polygon_init(&polygon, o->polygon_px, o->polygon_count)) return false;
    struct rect r = polygon_bounds(&polygon, unhidden->width_px, unhidden->height_px);
    uint64_t *samples = calloc(rect_is_empty(r) ? 1 : (size_t)(r.x1 - r.x0), sizeof *samples);
    for (int y = r.y0; samples && y < r.y1; y++) {
        polygon_row_samples(&polygon, samples, y, r.x0, r.x1);
        hide_row(unhidden, samples, r, y, reach);
    }
    bool ok = samples != NULL;
    free(samples);
    polygon_release(&polygon);
    return ok;
}

bool unhidden_create(struct image *unhidden, const struct occluder *occluders, size_t n, int width_px, int height_px, struct error *err)
{
    struct image out;
    if (!image_init(&out, width_px, height_px, 1, PIXEL_U8, err)) return false;
    memset(out.data, 255, image_size(&out));
    for (size_t i = 0; i < n; i++)
        if (!hide(&out, &occluders[i], REACH_PX + width_px / PICTURE_PX)) {
            image_release(&out);
            return error_set(err, ERR_MEMORY, "no memory for an outline");
        }
    *unhidden = out;
    return true;
}
