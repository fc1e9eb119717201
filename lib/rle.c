#include "lib/rle.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

/* Runs under construction. */
struct runs {
    uint32_t *counts;
    size_t count, capacity;
    uint64_t start; /* of the open run */
    bool value;     /* of the open run */
    bool failed;    /* memory ended */
};

static void runs_push(struct runs *runs, uint64_t length)
{
    if (runs->count == runs->capacity) {
        size_t capacity = runs->capacity ? 2 * runs->capacity : 64;
        uint32_t *counts = realloc(runs->counts, capacity * sizeof *counts);
        if (!counts) {
            runs->failed = true;
            return;
        }
        runs->counts = counts;
        runs->capacity = capacity;
    }
    runs->counts[runs->count++] = (uint32_t)length;
}

/* From position `at` on, pixels are `value`. */
static void runs_set(struct runs *runs, bool value, uint64_t at)
{
    if (value == runs->value) return;
    runs_push(runs, at - runs->start);
    runs->start = at;
    runs->value = value;
}

static bool runs_finish(struct rle *rle, struct runs *runs, int width_px, int height_px, struct error *err)
{
    if (runs->failed) {
        free(runs->counts);
        return error_set(err, ERR_MEMORY, "no memory for the runs of a mask");
    }
    *rle = (struct rle){ width_px, height_px, runs->counts, runs->count };
    return true;
}

bool rle_encode(struct rle *rle, const uint8_t *mask, struct rect mask_px, int width_px, int height_px,
                struct error *err)
{
    uint64_t height = (uint64_t)height_px, size = (uint64_t)width_px * height;
    assert(size <= UINT32_MAX);
    struct runs runs = { 0 };
    size_t stride = (size_t)(mask_px.x1 - mask_px.x0);
    for (int x = mask_px.x0; x < mask_px.x1; x++) {
        const uint8_t *column = mask + (x - mask_px.x0);
        uint64_t top = (uint64_t)x * height;
        for (int y = mask_px.y0; y < mask_px.y1; y++, column += stride)
            runs_set(&runs, *column != 0, top + (uint64_t)y);
        if (mask_px.y1 < height_px) runs_set(&runs, false, top + (uint64_t)mask_px.y1);
        if (mask_px.y0 > 0 && x + 1 < mask_px.x1) runs_set(&runs, false, top + height);
    }
    if (mask_px.y1 == height_px && mask_px.x1 < width_px) runs_set(&runs, false, (uint64_t)mask_px.x1 * height);
    runs_push(&runs, size - runs.start);
    return runs_finish(rle, &runs, width_px, height_px, err);
}

void rle_decode(uint8_t *mask, const struct rle *rle)
{
    size_t width = (size_t)rle->width_px, height = (size_t)rle->height_px, x = 0, y = 0;
    for (size_t i = 0; i < rle->count; i++)
        for (uint32_t n = rle->counts[i]; n > 0; n--) {
            mask[y * width + x] = i & 1;
            if (++y == height) {
                y = 0;
                x++;
            }
        }
}

char *rle_to_string(const struct rle *rle)
{
    char *string = malloc(rle->count * 7 + 1); /* 33 bits and a sign, 5 bits a byte */
    if (!string) return NULL;
    char *end = string;
    for (size_t i = 0; i < rle->count; i++) {
        int64_t rest = (int64_t)rle->counts[i] - (i > 2 ? (int64_t)rle->counts[i - 2] : 0);
        for (bool more = true; more;) {
            int bits = (int)(rest & 31);
            rest >>= 5;
            /* the last group's top bit is the sign */
            more = bits & 16 ? rest != -1 : rest != 0;
            *end++ = (char)(48 + bits + (more ? 32 : 0));
        }
    }
    *end = 0;
    return string;
}

bool rle_from_string(struct rle *rle, const char *string, int width_px, int height_px, struct error *err)
{
    uint64_t size = (uint64_t)width_px * (uint64_t)height_px, filled = 0;
    struct runs runs = { 0 };
    for (const char *c = string; *c;) {
        int64_t value = 0;
        int shift = 0;
        for (bool more = true; more; c++, shift += 5) {
            int bits = *c - 48;
            if (bits < 0 || bits > 63 || shift > 30) {
                error_set(err, ERR_INPUT,
                          *c ? "byte %zu of a mask string is out of place"
                             : "a mask string ends within a number at byte %zu",
                          (size_t)(c - string) + 1);
                goto out;
            }
            value |= (int64_t)(bits & 31) << shift;
            more = bits & 32;
            if (!more && bits & 16) value -= (int64_t)32 << shift;
        }
        if (runs.count > 2) value += (int64_t)runs.counts[runs.count - 2];
        if (value < 0 || filled + (uint64_t)value > size) {
            error_set(err, ERR_INPUT, "run %zu of a mask string does not fit into %d x %d pixels", runs.count + 1,
                      width_px, height_px);
            goto out;
        }
        filled += (uint64_t)value;
        runs_push(&runs, (uint64_t)value);
        if (runs.failed) break;
    }
    if (!runs.failed && filled != size) {
        error_set(err, ERR_INPUT, "a mask string fills %llu pixels of %d x %d", (unsigned long long)filled, width_px,
                  height_px);
        goto out;
    }
    return runs_finish(rle, &runs, width_px, height_px, err);
out:
    free(runs.counts);
    return false;
}

uint64_t rle_area(const struct rle *rle)
{
    uint64_t area = 0;
    for (size_t i = 1; i < rle->count; i += 2) area += rle->counts[i];
    return area;
}

void rle_release(struct rle *rle)
{
    free(rle->counts);
    *rle = (struct rle){ 0 };
}
