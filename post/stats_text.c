#include "post/stats.h"

#include "lib/file.h"

#include <jansson.h>
#include <stdlib.h>
#include <string.h>

struct row { const char *name; int id; const uint8_t *color; /* NULL: of no label */ };

static double percent(const struct stats *stats, uint64_t pixels)
{
    return 100.0 * (double)pixels / (double)stats->pixels;
}

/* The rows that have pixels: without labels before, not that of what is no entity. Returns how many. */
static size_t rows_of(struct row rows[STATS_OTHER + 1], const struct stats *stats)
{
    size_t n, used = 0;
    const struct palette_label *labels = palette_labels(stats->palette, &n);
    for (size_t i = 0; i < n; i++) {
        int id = labels[i].id;
        if ((stats->before[id] > 0 || stats->after[id] > 0) && (stats->has_before || id != 0))
            rows[used++] = (struct row){ labels[i].name, id, labels[i].color };
    }
    if (stats->before[STATS_OTHER] > 0 || stats->after[STATS_OTHER] > 0)
        rows[used++] = (struct row){ "not in the palette", STATS_OTHER, NULL };
    return used;
}

/* A line for each class of objects, where there are any. */
static void print_objects(FILE *f, const struct stats *stats)
{
    bool headed = false;
    for (int c = 0; c < CLASS_COUNT; c++) {
        const struct objects *o = &stats->objects[c];
        if (o->count == 0) continue;
        if (!headed)
            fprintf(f, "\n%42s %26s %26s\n%-20s %10s %10s %26s %26s\n", "", "box height, px", "visible fraction", "put in", "in frames",
                    "visible", "25 %     50 %     75 %", "25 %     50 %     75 %");
        headed = true;
        fprintf(f, "%-20s %10zu %10zu", class_info((enum entity_class)c)->name, o->count, o->visible);
        if (o->visible > 0) {
            double h[3], v[3];
            objects_quartiles(h, o->height_px, o->visible);
            objects_quartiles(v, o->visible_fraction, o->visible);
            fprintf(f, " %8.1f %8.1f %8.1f %8.3f %8.3f %8.3f", h[0], h[1], h[2], v[0], v[1], v[2]);
        }
        fputc('\n', f);
    }
}

char *stats_table(const struct stats *stats)
{
    char *text = NULL;
    size_t size = 0;
    FILE *f = open_memstream(&text, &size);
    if (!f) return NULL;
    struct row rows[STATS_OTHER + 1];
    size_t n = rows_of(rows, stats);
    fprintf(f, "%zu frame%s, %llu pixels, palette %s\n\n", stats->frames, stats->frames == 1 ? "" : "s",
            (unsigned long long)stats->pixels, palette_name((int)stats->palette));
    fprintf(f, stats->has_before ? "%-20s %10s %10s\n" : "%-20s %10s\n", "class", stats->has_before ? "before, %" : "put in, %",
            "after, %");
    for (size_t i = 0; i < n; i++) {
        fprintf(f, "%-20s", rows[i].name);
        if (stats->has_before) fprintf(f, " %10.3f", percent(stats, stats->before[rows[i].id]));
        fprintf(f, " %10.3f\n", percent(stats, stats->after[rows[i].id]));
    }
    if (!stats->has_before)
        fprintf(f, "\nThe frames have no semantic images of their own, nor a place with labels: only what was put in is counted.\n");
    print_objects(f, stats);
    for (size_t i = 0; i < stats->skipped_count; i++)
        fprintf(f, "%snot counted: frame %s: %s\n", i ? "" : "\n", stats->skipped[i].frame, stats->skipped[i].why);
    if (fclose(f) == 0) return text;
    free(text);
    return NULL;
}

static json_t *row_json(const struct stats *stats, const struct row *row)
{
    json_t *json = json_pack("{s:s, s:I, s:f}", "name", row->name, "pixels_after", (json_int_t)stats->after[row->id],
                             "percent_after", percent(stats, stats->after[row->id]));
    if (!json) return NULL;
    if (row->color) {
        json_object_set_new(json, "id", json_integer(row->id));
        json_object_set_new(json, "color", json_pack("[i,i,i]", row->color[0], row->color[1], row->color[2]));
    }
    if (stats->has_before) {
        json_object_set_new(json, "pixels_before", json_integer((json_int_t)stats->before[row->id]));
        json_object_set_new(json, "percent_before", json_real(percent(stats, stats->before[row->id])));
    }
    return json;
}

static json_t *quartiles_json(const double *values, size_t n)
{
    double q[3];
    objects_quartiles(q, values, n);
    return json_pack("[f,f,f]", q[0], q[1], q[2]);
}

static json_t *objects_json(const struct stats *stats)
{
    json_t *list = json_array();
    for (int c = 0; c < CLASS_COUNT; c++) {
        const struct objects *o = &stats->objects[c];
        if (o->count == 0) continue;
        json_t *json = json_pack("{s:s, s:I, s:I}", "class", class_info((enum entity_class)c)->name, "in_frames", (json_int_t)o->count,
                                 "visible", (json_int_t)o->visible);
        if (o->visible > 0) {
            json_object_set_new(json, "height_px", quartiles_json(o->height_px, o->visible));
            json_object_set_new(json, "visible_fraction", quartiles_json(o->visible_fraction, o->visible));
        }
        json_array_append_new(list, json);
    }
    return list;
}

char *stats_json(const struct stats *stats)
{
    struct row rows[STATS_OTHER + 1];
    size_t n = rows_of(rows, stats);
    json_t *classes = json_array(), *skipped = json_array();
    for (size_t i = 0; i < n; i++) json_array_append_new(classes, row_json(stats, &rows[i]));
    for (size_t i = 0; i < stats->skipped_count; i++)
        json_array_append_new(skipped, json_pack("{s:s, s:s}", "frame", stats->skipped[i].frame, "why", stats->skipped[i].why));
    json_t *json = json_pack("{s:i, s:s, s:I, s:I, s:b, s:o, s:o, s:o}", "version", 1, "palette", palette_name((int)stats->palette),
                             "frames", (json_int_t)stats->frames, "pixels", (json_int_t)stats->pixels,
                             "has_before", (int)stats->has_before, "classes", classes, "objects", objects_json(stats), "not_counted", skipped);
    char *text = json ? json_dumps(json, JSON_INDENT(2) | JSON_REAL_PRECISION(12)) : NULL;
    char *line = text ? string_format("%s\n", text) : NULL;
    json_decref(json);
    free(text);
    return line;
}
