#include "catalogue/list.h"

#include "catalogue/portrait.h"
#include "catalogue/sheet.h"
#include "lib/draw.h"
#include "lib/file.h"
#include "lib/image.h"

#include <jansson.h>
#include <stdlib.h>
#include <string.h>

#define SHEET_COLUMNS 6

static void size_text(char text[64], const struct catalogue_model *m)
{
    if (m->size_m[0] > 0 && m->size_m[1] > 0 && m->size_m[2] > 0)
        snprintf(text, 64, "%.2f x %.2f x %.2f", m->size_m[0], m->size_m[1], m->size_m[2]);
    else
        snprintf(text, 64, "-");
}

static void triangle_text(char text[64], const struct catalogue_model *m)
{
    int used = snprintf(text, 64, "%s", m->triangles[0] ? "" : "-");
    for (int i = 0; i < DETAIL_COUNT && m->triangles[i]; i++)
        used += snprintf(text + used, 64 - (size_t)used, "%s%d", i ? " / " : "", m->triangles[i]);
}

/* --- text --- */

enum { COLUMNS = 6 };
struct row { char cell[COLUMNS][256]; };

static void fill_row(struct row *row, const struct catalogue_model *m)
{
    char *folder = path_folder(m->home);
    snprintf(row->cell[0], sizeof row->cell[0], "%s", m->name);
    snprintf(row->cell[1], sizeof row->cell[1], "%s", class_info(m->class_)->name);
    size_text(row->cell[2], m);
    triangle_text(row->cell[3], m);
    snprintf(row->cell[4], sizeof row->cell[4], "%.60s", *m->license ? m->license : "not told");
    snprintf(row->cell[5], sizeof row->cell[5], "%.250s", folder ? folder : "");
    free(folder);
}

void list_text(FILE *out, const struct catalogue *catalogue)
{
    static const struct row head = { { "name", "class", "length x width x height, m", "triangles: near / middle / far", "licence", "folder" } };
    size_t width[COLUMNS] = { 0 };
    for (int pass = 0; pass < 2; pass++)
        for (size_t i = 0; i <= catalogue->count; i++) {
            struct row row = head;
            if (i) fill_row(&row, &catalogue->models[i - 1]);
            for (int c = 0; c < COLUMNS; c++) {
                size_t n = strlen(row.cell[c]);
                if (pass == 0 && n > width[c]) width[c] = n;
                if (pass) fprintf(out, "%s%*s", row.cell[c], c + 1 < COLUMNS ? (int)(width[c] - n + 2) : 0, "");
            }
            if (pass) fputc('\n', out);
        }
}

/* --- JSON --- */

static json_t *json_of(const struct catalogue_model *m)
{
    json_t *files = json_object(), *triangles = json_array();
    for (int i = 0; i < DETAIL_COUNT; i++) {
        if (m->files[i]) json_object_set_new(files, detail_name((enum detail)i), json_string(m->files[i]));
        if (m->triangles[i]) json_array_append_new(triangles, json_integer(m->triangles[i]));
    }
    json_t *json = json_pack("{s:s, s:s, s:o, s:o, s:f, s:s, s:s, s:s}", "name", m->name, "class", class_info(m->class_)->name, "files", files,
                             "triangles", triangles, "weight", m->weight, "animations", m->animations, "license", m->license, "source", m->source);
    if (json && m->size_m[0] > 0) json_object_set_new(json, "size_m", json_pack("[fff]", m->size_m[0], m->size_m[1], m->size_m[2]));
    if (json && m->picture) json_object_set_new(json, "picture", json_string(m->picture));
    return json;
}

bool list_json(FILE *out, const struct catalogue *catalogue, struct error *err)
{
    json_t *list = json_array();
    for (size_t i = 0; i < catalogue->count; i++) json_array_append_new(list, json_of(&catalogue->models[i]));
    char *text = json_dumps(list, JSON_INDENT(2) | JSON_REAL_PRECISION(6));
    json_decref(list);
    if (!text) return error_set(err, ERR_MEMORY, "no memory for the list");
    fprintf(out, "%s\n", text);
    free(text);
    return true;
}

/* --- pictures --- */

static struct sitter sitter_of(const struct catalogue_model *m, uint32_t number)
{
    struct sitter sitter = { .name = m->name, .file = m->files[DETAIL_NEAR], .options = m->options, .has_color = m->color_count > 0 };
    for (int k = 0; k < 3; k++) sitter.size_m[k] = m->size_m[k] > 0 ? m->size_m[k] : 2;
    if (!m->color_count) return sitter;
    double *weights = calloc(m->color_count, sizeof *weights);
    for (size_t i = 0; weights && i < m->color_count; i++) weights[i] = m->colors[i].weight;
    size_t color = weights ? draw_weighted((struct draw_key){ .entity = number, .purpose = DRAW_PAINT }, weights, m->color_count) : 0;
    free(weights);
    for (int k = 0; k < 3; k++) sitter.color[k] = m->colors[color].linear[k];
    return sitter;
}

static void put_html(FILE *f, const char *text)
{
    for (; *text; text++)
        if (*text == '<') fputs("&lt;", f);
        else if (*text == '&') fputs("&amp;", f);
        else if (*text == '"') fputs("&quot;", f);
        else fputc(*text, f);
}

static bool write_index(const char *folder, const struct catalogue *catalogue, int width_px, struct error *err)
{
    char *text = NULL, *path = string_format("%s/index.html", folder);
    size_t size = 0;
    FILE *f = open_memstream(&text, &size);
    if (!f || !path) {
        if (f) fclose(f);
        free(text);
        free(path);
        return error_set(err, ERR_MEMORY, "no memory for a page");
    }
    fprintf(f, "<!doctype html>\n<meta charset=\"utf-8\">\n<title>Models</title>\n<style>body { font: 14px sans-serif } "
               "figure { display: inline-block; width: %dpx; margin: 8px; vertical-align: top } img { width: 100%% }</style>\n", width_px);
    for (size_t i = 0; i < catalogue->count; i++) {
        struct row row;
        fill_row(&row, &catalogue->models[i]);
        fprintf(f, "<figure><img src=\"%s.png\" alt=\"\"><figcaption><b>%s</b> (%s), %s m<br>%s triangles; ", row.cell[0], row.cell[0], row.cell[1],
                row.cell[2], row.cell[3]);
        put_html(f, row.cell[4]);
        fputs("</figcaption></figure>\n", f);
    }
    bool ok = fclose(f) == 0 ? file_write(path, text, size, err) : error_set(err, ERR_MEMORY, "no memory for a page");
    free(text);
    free(path);
    return ok;
}

static bool write_pictures(const char *folder, const struct catalogue *catalogue, const struct portraits *portraits, struct error *err)
{
    bool ok = true;
    for (size_t i = 0; ok && i < catalogue->count; i++) {
        char *path = string_format("%s/%s.png", folder, catalogue->models[i].name);
        ok = path ? image_write(path, &portraits->pictures[i], err) : error_set(err, ERR_MEMORY, "no memory for a path");
        free(path);
    }
    struct image sheet = { 0 };
    char (*text)[160] = calloc(catalogue->count, sizeof *text), *path = string_format("%s/sheet.png", folder);
    const char **captions = calloc(catalogue->count, sizeof *captions);
    if (!text || !captions || !path) ok = error_set(err, ERR_MEMORY, "no memory for a sheet");
    for (size_t i = 0; ok && i < catalogue->count; i++) {
        char size[64];
        size_text(size, &catalogue->models[i]);
        snprintf(text[i], sizeof text[i], "%s  %s m", catalogue->models[i].name, size);
        captions[i] = text[i];
    }
    size_t columns = catalogue->count < SHEET_COLUMNS ? catalogue->count : SHEET_COLUMNS;
    ok = ok && sheet_make(&sheet, portraits->pictures, captions, catalogue->count, columns, err) && image_write(path, &sheet, err);
    image_release(&sheet);
    free(captions);
    free(text);
    free(path);
    return ok;
}

bool list_pictures(const char *folder, const struct catalogue *catalogue, int width_px, struct error *err)
{
    static const enum side sides[] = { SIDE_ABOVE };
    struct portraits portraits = { 0 };
    struct sitter *sitters = calloc(catalogue->count + 1, sizeof *sitters);
    char *work = string_format("%s/.work", folder);
    bool ok = (sitters && work) || error_set(err, ERR_MEMORY, "no memory for pictures");
    if (ok && !catalogue->count) ok = error_set(err, ERR_INPUT, "the catalogue is empty: there is nothing to make pictures of");
    for (size_t i = 0; ok && i < catalogue->count; i++) sitters[i] = sitter_of(&catalogue->models[i], (uint32_t)i);
    ok = ok && portraits_make(&portraits, sitters, catalogue->count, sides, 1, &(struct portrait_options){ .width_px = width_px }, work, err) &&
         write_pictures(folder, catalogue, &portraits, err) && write_index(folder, catalogue, width_px, err);
    portraits_release(&portraits);
    free(sitters);
    free(work);
    return ok;
}
