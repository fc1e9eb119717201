#include "post/stats.h"

#include "lib/file.h"
#include "lib/manifest.h"
#include "post/before.h"
#include "post/frame_list.h"
#include "post/input.h"
#include "post/semantic.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void find_known(bool known[256], enum palette palette)
{
    size_t n;
    const struct palette_label *labels = palette_labels(palette, &n);
    memset(known, 0, 256);
    for (size_t i = 0; i < n; i++) known[labels[i].id] = true;
}

/* Count the pixels of an image of ids or of colours. */
static void count_labels(uint64_t *counts, const struct image *image, enum palette palette)
{
    bool known[256];
    find_known(known, palette);
    const uint8_t *from = image->data;
    size_t n = (size_t)image->width_px * (size_t)image->height_px, channels = (size_t)image->channels;
    uint8_t last[3] = { 0 };
    int last_id = semantic_id_of_color(palette, last);
    for (size_t i = 0; i < n; i++, from += channels) {
        int id = *from;
        if (channels == 1) {
            if (!known[id]) id = STATS_OTHER;
        } else {
            if (memcmp(last, from, 3) != 0) {
                memcpy(last, from, 3);
                last_id = semantic_id_of_color(palette, last);
            }
            id = last_id < 0 ? STATS_OTHER : last_id;
        }
        counts[id]++;
    }
}

/* The dataset's semantic image, in the form that was there before. */
static bool read_after(struct image *after, const char *out, const struct manifest *m, int channels, struct error *err)
{
    char *path = string_format("%s/%s/%s.png", out, channels == 1 ? "semantic_id" : "semantic", m->frame);
    bool ok = path ? input_image(after, path, m->width_px, m->height_px, channels, PIXEL_U8, err)
                   : error_set(err, ERR_MEMORY, "no memory for a path");
    free(path);
    return ok;
}

static bool count_objects(struct stats *stats, const char *out, const struct manifest *m, struct error *err)
{
    char *path = string_format("%s/labels/%s.json", out, m->frame);
    bool ok = path ? objects_add(stats->objects, path, err) : error_set(err, ERR_MEMORY, "no memory for a path");
    free(path);
    return ok;
}

static bool count_frame(struct stats *stats, const char *out, const struct manifest *m, struct error *err)
{
    struct image before = { 0 }, after = { 0 };
    if (m->palette != stats->palette && stats->frames > 0)
        return error_set(err, ERR_INPUT, "is in the palette %s, the frames before it in %s", palette_name((int)m->palette),
                         palette_name((int)stats->palette));
    if (!before_semantic(&before, out, m, err)) return false;
    bool ok = before.data || !stats->has_before || error_set(err, ERR_INPUT, "has no labels of its own, as other frames have");
    ok = ok && read_after(&after, out, m, before.data ? before.channels : 1, err) && count_objects(stats, out, m, err);
    if (ok) {
        stats->palette = m->palette;
        stats->frames++;
        stats->pixels += (uint64_t)m->width_px * (uint64_t)m->height_px;
        if (before.data) count_labels(stats->before, &before, m->palette);
        count_labels(stats->after, &after, m->palette);
    }
    image_release(&before);
    image_release(&after);
    return ok;
}

static bool read_manifest(struct manifest *m, const char *out, const char *frame, struct error *err)
{
    char *path = string_format("%s/frames/%s/frame.json", out, frame);
    bool ok = path ? manifest_read(m, path, err) : error_set(err, ERR_MEMORY, "no memory for a path");
    free(path);
    return ok;
}

/* Whether any frame has labels of its own. */
static bool any_before(const char *out, char *const *frames, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        struct manifest m;
        struct error ignored = ERROR_NONE;
        if (!read_manifest(&m, out, frames[i], &ignored)) continue;
        bool has = m.semantic[0] || m.has_place_labels;
        manifest_release(&m);
        if (has) return true;
    }
    return false;
}

static bool skip(struct stats *stats, const char *frame, const struct error *why)
{
    struct stats_skipped *s = &stats->skipped[stats->skipped_count++];
    snprintf(s->frame, sizeof s->frame, "%s", frame);
    s->why = why->file[0] ? string_format("%s: %s", why->file, why->text) : string_format("%s", why->text);
    return s->why != NULL;
}

bool stats_count(struct stats *stats, const char *out, struct error *err)
{
    char **frames;
    size_t count;
    struct stats s = { 0 };
    struct error first = ERROR_NONE;
    if (!frame_list(&frames, &count, out, err)) return false;
    s.skipped = calloc(count, sizeof *s.skipped);
    bool ok = s.skipped || error_set(err, ERR_MEMORY, "no memory for a list of frames");
    s.has_before = ok && any_before(out, frames, count);
    for (size_t i = 0; ok && i < count; i++) {
        struct error fault = ERROR_NONE;
        struct manifest m = { 0 };
        if (!read_manifest(&m, out, frames[i], &fault) || !count_frame(&s, out, &m, &fault)) {
            if (first.code == ERR_OK) first = fault;
            ok = skip(&s, frames[i], &fault) || error_set(err, ERR_MEMORY, "no memory for a list of frames");
        }
        manifest_release(&m);
    }
    if (ok && s.frames == 0) {
        *err = first;
        ok = error_prefix(err, "no frame can be counted: ");
    }
    frame_list_free(frames, count);
    objects_sort(s.objects);
    if (ok) *stats = s;
    else stats_release(&s);
    return ok;
}

void stats_release(struct stats *stats)
{
    for (size_t i = 0; i < stats->skipped_count; i++) free(stats->skipped[i].why);
    free(stats->skipped);
    objects_release(stats->objects);
    *stats = (struct stats){ 0 };
}
