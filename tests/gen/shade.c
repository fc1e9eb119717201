/* Which edges are shadows, and what they have in common: from edges made by numbers. */
#include "gen/estimate/shade.h"

#include "tests/tap.h"

#include <stdint.h>

/* Repeatable, -1 to 1. */
static uint32_t state = 1;
static double noise(void)
{
    state = state * 1664525u + 1013904223u;
    return (double)(state >> 8) / (1 << 23) - 1;
}

struct edges { struct shade_sample *s; size_t n; };

static void add(struct edges *e, double r, double g, double b, double scatter, size_t n)
{
    const double ratio[3] = { r, g, b };
    e->s = realloc(e->s, (e->n + n) * sizeof *e->s);
    if (!e->s) abort();
    for (size_t i = 0; i < n; i++, e->n++) {
        double common = scatter * noise();
        for (int c = 0; c < 3; c++) e->s[e->n].ln[c] = (float)(log(ratio[c]) + common + 0.3 * scatter * noise());
        e->s[e->n].place = (int)(e->n / 10);
        e->s[e->n].surface = 0;
    }
}

static struct shade found(const struct edges *e)
{
    struct error err = ERROR_NONE;
    struct shade shade = { 0 };
    struct daylight_locus locus = daylight_locus(0.8, 1);
    if (!shade_find(&shade, e->s, e->n, 0.25, &locus, &err)) OK(false, "%s", err.text);
    return shade;
}

static void is_near(const struct shade *shade, double r, double g, double b, double within, const char *what)
{
    const double want[3] = { r, g, b };
    for (int c = 0; c < 3; c++) NEAR(shade->ratio[c], want[c], within * want[c], "%s: %c", what, "RGB"[c]);
}

int main(void)
{
    /* Shadows among three times as many edges of paint, tar and wear, which are grey. */
    struct edges street = { 0 };
    add(&street, 0.12, 0.15, 0.22, 0.1, 1000);
    add(&street, 0.45, 0.45, 0.46, 0.3, 2000);
    add(&street, 0.65, 0.66, 0.68, 0.2, 1000);
    struct shade shade = found(&street);
    is_near(&shade, 0.12, 0.15, 0.22, 0.03, "shadows among paint");
    OK(shade.edges > 900 && shade.edges < 1100, "as many as there are (%zu)", shade.edges);
    NEAR(shade.share, 0.25, 0.03, "a quarter of all edges");
    OK(shade.purity > 0.9, "nothing else is as deep (%.2f)", shade.purity);
    OK(shade.sigma[0] > 0 && shade.sigma[0] < 0.05 * shade.ratio[0], "known to %.4f", shade.sigma[0]);
    free(street.s);

    /* The shade of leaves, sun between them in any share: most edges lie between. */
    struct edges trees = { 0 };
    for (int i = 0; i < 200; i++) {
        double m = pow(fabs(noise()), 2);
        add(&trees, m + (1 - m) * 0.07, m + (1 - m) * 0.11, m + (1 - m) * 0.27, 0.05, 10);
    }
    add(&trees, 0.6, 0.6, 0.6, 0.3, 3000);
    shade = found(&trees);
    /* Not quite the deepest: none is wholly without sun. */
    is_near(&shade, 0.07, 0.11, 0.27, 0.3, "under trees, the deepest of them");
    free(trees.s);

    /* Yellow beside grey, red beside grey: as blue, but not so much less in red than in green. */
    struct edges paint = { 0 };
    add(&paint, 0.5, 0.5, 0.5, 0.3, 1000);
    add(&paint, 0.3, 0.32, 1.2, 0.1, 300);
    add(&paint, 0.2, 0.6, 0.62, 0.1, 300);
    shade = found(&paint);
    OK(shade.share < 0.05, "yellow and red are no shadows (%.3f)", shade.share);
    free(paint.s);

    struct edges none = { 0 };
    shade = found(&none);
    OK(shade.places == 0 && shade.edges == 0, "no edges, no shade");
    free(none.s);

    /* Blue beside grey can be taken for it; then other things are as deep. */
    struct edges clouds = { 0 };
    add(&clouds, 0.45, 0.45, 0.46, 0.3, 3000);
    add(&clouds, 0.40, 0.46, 0.56, 0.2, 150);
    shade = found(&clouds);
    OK(shade.purity < 0.2, "bluish edges among grey ones of the same depth are suspect (%.2f)", shade.purity);
    free(clouds.s);

    /* Marks: what they say, and how well they agree. */
    struct error err = ERROR_NONE;
    struct edges marks = { 0 };
    add(&marks, 0.2, 0.25, 0.3, 0.1, 5);
    for (size_t i = 0; i < 5; i++) marks.s[i].place = (int)i;
    OK(shade_of_marks(&shade, marks.s, 5, &err), "marks");
    is_near(&shade, 0.2, 0.25, 0.3, 0.1, "marked");
    OK(shade.edges == 5 && shade.places == 5, "five of them");
    free(marks.s);
    return tap_done();
}
