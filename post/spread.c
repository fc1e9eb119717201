#include "post/spread.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Offsets to the nearest known pixel, handed on from neighbour to neighbour in two sweeps: down and up,
 * and along each row both ways. Src: Danielsson, Euclidean distance mapping, 1980. */
struct offset { int dx, dy; };
struct field { struct offset *nearest; int width_px, height_px; };

#define FAR_PX 30000

static long squared(struct offset o) { return (long)o.dx * o.dx + (long)o.dy * o.dy; }

static bool is_far(struct offset o) { return o.dx >= FAR_PX; }

static void offer(const struct field *f, struct offset *own, int x, int y, int dx, int dy)
{
    if (x + dx < 0 || x + dx >= f->width_px || y + dy < 0 || y + dy >= f->height_px) return;
    struct offset theirs = f->nearest[(long)(y + dy) * f->width_px + x + dx];
    if (is_far(theirs)) return;
    theirs.dx += dx;
    theirs.dy += dy;
    if (squared(theirs) < squared(*own)) *own = theirs;
}

/* dy: -1 downwards from the row above, 1 upwards from the row below. */
static void sweep_row(const struct field *f, int y, int dy)
{
    struct offset *row = f->nearest + (long)y * f->width_px;
    for (int x = 0; x < f->width_px; x++)
        for (int dx = -1; dx <= 1; dx++) offer(f, &row[x], x, y, dx, dy);
    for (int x = 0; x < f->width_px; x++) offer(f, &row[x], x, y, -1, 0);
    for (int x = f->width_px - 1; x >= 0; x--) offer(f, &row[x], x, y, 1, 0);
}

static void sweep(const struct field *f)
{
    for (int y = 0; y < f->height_px; y++) sweep_row(f, y, -1);
    for (int y = f->height_px - 1; y >= 0; y--) sweep_row(f, y, 1);
}

static bool field_init(struct field *f, const struct image *image, struct error *err)
{
    *f = (struct field){ NULL, image->width_px, image->height_px };
    f->nearest = malloc((size_t)f->width_px * (size_t)f->height_px * sizeof *f->nearest);
    return f->nearest || error_set(err, ERR_MEMORY, "no memory for distances in an image");
}

bool spread_known(struct image *image, struct error *err)
{
    struct field f;
    if (!field_init(&f, image, err)) return false;
    size_t n = (size_t)image->width_px * (size_t)image->height_px, channels = (size_t)image->channels;
    float *values = image->data;
    for (size_t i = 0; i < n; i++)
        f.nearest[i] = isnan(values[i * channels]) ? (struct offset){ FAR_PX, FAR_PX } : (struct offset){ 0, 0 };
    sweep(&f);
    for (size_t i = 0; i < n; i++) {
        struct offset o = f.nearest[i];
        if (is_far(o) || squared(o) == 0) continue;
        const float *from = values + ((long)i + (long)o.dy * f.width_px + o.dx) * (long)channels;
        memcpy(values + i * channels, from, channels * sizeof *from);
    }
    free(f.nearest);
    return true;
}

bool spread_mask(struct image *mask, double reach_px, struct error *err)
{
    struct field f;
    if (!field_init(&f, mask, err)) return false;
    size_t n = (size_t)mask->width_px * (size_t)mask->height_px;
    uint8_t *marked = mask->data;
    for (size_t i = 0; i < n; i++) f.nearest[i] = marked[i] ? (struct offset){ 0, 0 } : (struct offset){ FAR_PX, FAR_PX };
    sweep(&f);
    for (size_t i = 0; i < n; i++)
        marked[i] = !is_far(f.nearest[i]) && (double)squared(f.nearest[i]) <= reach_px * reach_px;
    free(f.nearest);
    return true;
}
