#include "cases.h"
#include "compare.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LINES_MAX = 4096 };

struct figure { const char *name; size_t at; const char *format; bool label, high; };
#define FIGURE(field, format, label, high) { #field, offsetof(struct comparison, field), format, label, high }
static const struct figure figures[] = {
    FIGURE(changed_px, "%.0f", false, true), FIGURE(psnr_db, "%.2f", false, true), FIGURE(ssim, "%.4f", false, true),
    FIGURE(shade_px, "%.0f", false, true), FIGURE(shade_error, "%.4f", false, false), FIGURE(shade_bias, "%+.4f", false, false),
    FIGURE(color_error, "%.2f", false, false), FIGURE(mean_color_error, "%.2f", false, false),
    FIGURE(mask_iou, "%.4f", true, true), FIGURE(amodal_iou, "%.4f", true, true), FIGURE(depth_m, "%.4f", true, false),
    FIGURE(amodal_depth_m, "%.4f", true, false), FIGURE(box_px, "%.0f", true, false), FIGURE(amodal_box_px, "%.0f", true, false),
    FIGURE(visible_share, "%.4f", true, false), FIGURE(semantic_share, "%.4f", true, true), FIGURE(position_m, "%.4f", true, false),
    FIGURE(turn_deg, "%.3f", true, false), FIGURE(size_m, "%.5f", true, false), FIGURE(corner_px, "%.3f", true, false),
    FIGURE(edges, "%.0f", false, true), FIGURE(edge_width, "%.3f", false, true), FIGURE(grain, "%.3f", false, true),
    FIGURE(grain_worst, "%.3f", false, true),
};
enum { FIGURES = sizeof figures / sizeof *figures };

static double *value(const struct comparison *c, size_t i) { return (double *)((char *)c + figures[i].at); }

void comparison_print(FILE *f, const char *name, size_t shot, const char *method, const struct comparison *result)
{
    fprintf(f, "%s %zu %s", name, shot, method);
    for (size_t i = 0; i < FIGURES; i++) fprintf(f, " %.9g", *value(result, i));
    fputs("\n", f);
}

struct line { char name[48], method[48]; size_t shot; struct comparison figures; };

static bool read_lines(struct line *lines, size_t *n, const char *path, struct error *err)
{
    FILE *f = fopen(path, "r");
    if (!f) return error_at(err, ERR_INPUT, path, 0, 0, "cannot be read");
    bool ok = true;
    for (int number = 1; ok; number++) {
        struct line *l = &lines[*n];
        int got = *n < LINES_MAX ? fscanf(f, "%47s %zu %47s", l->name, &l->shot, l->method) : EOF;
        if (got == EOF) break;
        ok = got == 3;
        for (size_t i = 0; ok && i < FIGURES; i++) ok = fscanf(f, "%lf", value(&l->figures, i)) == 1;
        if (!ok) error_at(err, ERR_INPUT, path, number, 0, "is no line of figures");
        ++*n;
    }
    fclose(f);
    return ok;
}

static void print_table(FILE *f, const struct line *lines, size_t n, bool labels)
{
    fprintf(f, labels ? "| case | shot |" : "| case | shot | transfer |");
    for (size_t i = 0; i < FIGURES; i++)
        if (figures[i].label == labels) fprintf(f, " %s |", figures[i].name);
    fprintf(f, "\n| --- | --- |%s", labels ? "" : " --- |");
    for (size_t i = 0; i < FIGURES; i++)
        if (figures[i].label == labels) fputs(" --- |", f);
    for (size_t k = 0; k < n; k++) {
        if (labels && strcmp(lines[k].method, "layers")) continue;
        fprintf(f, "\n| %s | %zu |", lines[k].name, lines[k].shot);
        if (!labels) fprintf(f, " %s |", lines[k].method);
        for (size_t i = 0; i < FIGURES; i++) {
            if (figures[i].label != labels) continue;
            double v = *value(&lines[k].figures, i);
            fputs(" ", f);
            if (!isnan(v)) fprintf(f, figures[i].format, v);
            fputs(" |", f);
        }
    }
    fputs("\n\n", f);
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static bool has_mesh(const struct line *l)
{
    const struct proving_case *c = proving_case(l->name);
    return c && c->has_mesh;
}

/* Of the cases with a mesh, or of those without. */
static void print_medians(FILE *f, const struct line *lines, size_t n, bool mesh)
{
    static const char *const methods[] = { "layers", "ratio", "threshold", "alpha", "fitted", "auto" };
    double values[LINES_MAX];
    size_t rows = 0;
    for (size_t m = 0; m < sizeof methods / sizeof *methods; m++) {
        size_t found = 0;
        for (size_t i = 0; i < FIGURES; i++) {
            if (strcmp(figures[i].name, "psnr_db") && strcmp(figures[i].name, "ssim") && strcmp(figures[i].name, "shade_error") &&
                strcmp(figures[i].name, "color_error"))
                continue;
            size_t count = 0;
            for (size_t k = 0; k < n; k++)
                if (!strcmp(lines[k].method, methods[m]) && has_mesh(&lines[k]) == mesh) values[count++] = *value(&lines[k].figures, i);
            if (!count) break;
            qsort(values, count, sizeof *values, ascending);
            if (!rows++)
                fprintf(f, "| median, %s | psnr_db | ssim | shade_error | color_error |\n| --- | --- | --- | --- | --- |\n",
                        mesh ? "cases with a mesh" : "plane cases");
            if (!found++) fprintf(f, "| %s |", methods[m]);
            fputs(" ", f);
            fprintf(f, figures[i].format, (values[(count - 1) / 2] + values[count / 2]) / 2);
            fputs(" |", f);
        }
        if (found) fputs("\n", f);
    }
    if (rows) fputs("\n", f);
}

bool comparison_table(FILE *f, const char *const *files, size_t n, struct error *err)
{
    struct line *lines = calloc(LINES_MAX + 1, sizeof *lines);
    size_t count = 0;
    bool ok = lines || error_set(err, ERR_MEMORY, "no memory for a table");
    for (size_t i = 0; ok && i < n; i++) ok = read_lines(lines, &count, files[i], err);
    if (ok) {
        print_table(f, lines, count, false);
        print_medians(f, lines, count, true);
        print_medians(f, lines, count, false);
        print_table(f, lines, count, true);
    }
    free(lines);
    return ok;
}
