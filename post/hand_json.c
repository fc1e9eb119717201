#include "post/hand.h"

#include "lib/file.h"

#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What nobody needs more than six digits of. */
static json_t *number(double v)
{
    return json_real(isfinite(v) ? round(v * 1e6) / 1e6 : 0);
}

static json_t *numbers(const double *v, size_t n)
{
    json_t *list = json_array();
    for (size_t i = 0; i < n; i++) json_array_append_new(list, number(v[i]));
    return list;
}

static const char *source(bool automatic, bool done)
{
    return !done ? "none" : automatic ? "measured" : "given";
}

static json_t *softness(const struct hand *h, const struct manifest *m)
{
    json_t *o = json_pack("{s:s, s:o, s:o, s:o}", "source", source(m->softness_auto, h->softness_px > 0 || h->too_soft_px2 > 0),
                          "px", number(h->softness_px), "taken_back_px2", number(h->too_soft_px2), "hider_px", number(h->hider_px));
    if (m->softness_auto) {
        json_object_set_new(o, "edges", json_integer((json_int_t)h->edges.count));
        json_object_set_new(o, "edge_sigma_px", number(h->edges.sharp_px));
        json_object_set_new(o, "edge_sigma_px_quartiles", numbers(h->edges.sigma_px, 3));
        json_object_set_new(o, "rendered_edges", json_integer((json_int_t)h->layer_edges.count));
        json_object_set_new(o, "rendered_edge_sigma_px", number(h->layer_edges.sharp_px));
        json_object_set_new(o, "rendered_edge_sigma_px_quartiles", numbers(h->layer_edges.sigma_px, 3));
    }
    return o;
}

static json_t *sharpening(const struct hand *h, const struct manifest *m)
{
    json_t *o = json_pack("{s:s, s:o}", "source", source(m->sharpening_auto, h->sharpening > 0), "amount", number(h->sharpening));
    if (m->sharpening_auto) {
        json_object_set_new(o, "edges", json_integer((json_int_t)h->edges.telling));
        json_object_set_new(o, "amount_quartiles", numbers(h->edges.sharpening_quartiles, 3));
    }
    return o;
}

/* Of each 16 levels the standard deviations of R, G and B; and how alike the brightness of neighbours is. */
static json_t *grain(const struct hand *h, const struct manifest *m)
{
    json_t *o = json_pack("{s:s}", "source", source(m->grain_auto, h->has_grain)), *levels = json_array();
    json_object_set_new(o, "patches", json_integer((json_int_t)h->grain.patches));
    for (int i = 0; h->has_grain && i < GRAIN_LEVELS; i++) {
        double level = (i + 0.5) * 256 / GRAIN_LEVELS, sigma[3];
        for (int c = 0; c < 3; c++) sigma[c] = grain_sigma(&h->grain, level, c);
        json_array_append_new(levels, json_pack("{s:o, s:b, s:o}", "level", number(level), "seen", (int)h->grain.seen[i],
                                                "sigma_rgb", numbers(sigma, 3)));
    }
    json_object_set_new(o, "levels", levels);
    double right[GRAIN_LAG_PX], down[GRAIN_LAG_PX];
    for (int k = 0; k < GRAIN_LAG_PX; k++) {
        right[k] = h->grain.correlation[0][GRAIN_LAG_PX][GRAIN_LAG_PX + 1 + k];
        down[k] = h->grain.correlation[0][GRAIN_LAG_PX + 1 + k][GRAIN_LAG_PX];
    }
    json_object_set_new(o, "correlation_right", numbers(right, GRAIN_LAG_PX));
    json_object_set_new(o, "correlation_down", numbers(down, GRAIN_LAG_PX));
    return o;
}

static json_t *vignetting(const struct hand *h, const struct manifest *m)
{
    json_t *o = json_pack("{s:s, s:o}", "source", source(m->vignetting_auto, h->fall_off > 0), "fall_off", number(h->fall_off));
    if (m->vignetting_auto) {
        json_object_set_new(o, "patches", json_integer((json_int_t)h->vignette.patches));
        json_object_set_new(o, "fall_off_by_quarter", numbers(h->vignette.quarter, 4));
    }
    return o;
}

static json_t *highlights(const struct hand *h, const struct manifest *m)
{
    json_t *o = json_pack("{s:s, s:o}", "source", source(m->highlights_auto, h->knee < 1), "knee", number(h->knee));
    if (m->highlights_auto) {
        json_object_set_new(o, "told", json_boolean(h->highlights.told));
        json_object_set_new(o, "misfit", number(h->highlights.misfit));
        json_object_set_new(o, "exponent", number(h->highlights.exponent));
    }
    return o;
}

static json_t *blacks(const struct hand *h, const struct manifest *m)
{
    json_t *o = json_pack("{s:s, s:o}", "source", source(m->blacks_auto, h->black > 0), "level", number(h->black));
    if (m->blacks_auto) json_object_set_new(o, "level_rgb", numbers(h->blacks.channel, 3));
    return o;
}

static json_t *compression(const struct hand *h)
{
    const struct compression *c = &h->compression;
    json_t *o = json_pack("{s:s}", "source", source(true, c->found));
    if (!c->found) return o;
    /* The first step of each table: of a block's mean. */
    json_t *steps = json_array(), *sampling = json_array();
    for (int i = 0; i < c->components; i++) {
        json_array_append_new(steps, json_integer(c->table[i][0]));
        json_array_append_new(sampling, json_pack("[i,i]", c->across[i], c->down[i]));
    }
    json_object_set_new(o, "dc_steps", steps);
    json_object_set_new(o, "sampling", sampling);
    return o;
}

bool hand_write(const char *path, const struct hand *h, const struct manifest *m, struct error *err)
{
    json_t *json = json_pack("{s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "softness", softness(h, m), "sharpening", sharpening(h, m), "grain", grain(h, m),
                             "vignetting", vignetting(h, m), "highlights", highlights(h, m), "blacks", blacks(h, m), "compression", compression(h));
    char *text = json ? json_dumps(json, JSON_INDENT(1) | JSON_REAL_PRECISION(9)) : NULL;
    bool ok = text ? file_write(path, text, strlen(text), err) : error_set(err, ERR_MEMORY, "no memory for %s", path);
    free(text);
    json_decref(json);
    return ok;
}
