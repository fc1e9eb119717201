#include "gen/estimate/estimate_impl.h"

#include "gen/estimate/shadow_edges.h"
#include "lib/image.h"
#include "lib/photograph.h"

#include <math.h>
#include <stdlib.h>

#define SUN_NEAR_M 0.3
#define SUN_FAR_M 1000
enum { SKY_RAYS = 48, PLACE_PX = 16 };

static bool out_of_memory(struct error *err)
{
    return error_set(err, ERR_MEMORY, "no memory for an estimate of the light");
}

/* --- one photograph --- */

bool look_at(struct looked_at *l, const struct stage *stage, const struct estimate_photograph *photograph, size_t index,
             const struct vec3 *sun, struct error *err)
{
    const struct scene_shot *shot = &stage->scene->shots[photograph->shot];
    struct image image;
    *l = (struct looked_at){ .stage = stage };
    if (!image_read(&image, photograph->path, err)) return false;
    bool ok = photograph_is_of_integers(&image, shot->photograph ? shot->photograph : photograph->path, err) &&
              look_at_image(l, stage, &image, shot, index, sun, err);
    image_release(&image);
    return ok;
}

bool look_at_image(struct looked_at *l, const struct stage *stage, const struct image *image, const struct scene_shot *shot, size_t index,
                   const struct vec3 *sun, struct error *err)
{
    const struct scene *s = stage->scene;
    *l = (struct looked_at){ .stage = stage, .shot = shot, .index = index };
    l->camera = camera_scaled(&s->cameras[shot->camera].camera, image->width_px, image->height_px);
    if (!tones_of(&l->tones, image, err) || !ground_view_of(&l->view, stage, &l->tones, &l->camera, shot->world_from_camera, GROUND_NEAR_M, err)) return false;
    if (s->has_mist) ground_view_clear(&l->tones, &l->view, s->visibility_m, s->haze);
    if (!lit_ground_find(&l->lit[0], NULL, NULL, stage, &l->tones, &l->view, sun, &l->camera, l->shot, err)) return false;
    l->surfaces = lit_surfaces_find(l->lit, SHADE_SURFACES, &l->lit[0], stage, &l->tones, &l->view, sun);
    return l->surfaces || out_of_memory(err);
}

void looked_at_release(struct looked_at *l)
{
    tones_release(&l->tones);
    ground_view_release(&l->view);
}

/* What of the sky a point of the mesh sees, by cosine. */
static double sky_seen(const struct static_mesh *mesh, struct vec3 p)
{
    int open = 0;
    for (int i = 0; i < SKY_RAYS; i++) {
        double r = sqrt((i + 0.5) / SKY_RAYS), turn = 2 * M_PI * fmod(i * 0.61803398874989485, 1);
        open += !static_mesh_blocks(mesh, p, vec3(r * cos(turn), r * sin(turn), sqrt(1 - r * r)), SUN_NEAR_M, SUN_FAR_M);
    }
    return (double)open / SKY_RAYS;
}

/* From what two points with a part of the sky each show, to what they would in the open. With q the sky's light
 * over the sun's, shade / lit is (of the shade) q / (1 + (of the lit) q). False where there is no such q. */
static bool open_ratio(float ln[3], double of_lit, double of_shade)
{
    for (int c = 0; c < 3; c++) {
        double ratio = exp((double)ln[c]), q = ratio / (of_shade - ratio * of_lit);
        if (!(of_shade - ratio * of_lit > 0.02)) return false;
        ln[c] = (float)log(q / (1 + q));
    }
    return true;
}

static bool grow_array(void **array, size_t size)
{
    void *grown = realloc(*array, size);
    if (grown) *array = grown;
    return grown != NULL;
}

static bool grow(struct gathered *g)
{
    if (g->n < g->room) return true;
    g->room = g->room ? 2 * g->room : 8192;
    return grow_array((void **)&g->samples, g->room * sizeof *g->samples) && grow_array((void **)&g->on_lit, g->room * sizeof *g->on_lit) &&
           (!g->by_place || (grow_array((void **)&g->sides, g->room * sizeof *g->sides) && grow_array((void **)&g->told, g->room)));
}

static int place_of(const struct looked_at *l, const int16_t px[2])
{
    int across = l->tones.width_px / PLACE_PX + 1, down = l->tones.height_px / PLACE_PX + 1;
    return ((int)l->index * down + px[1] / PLACE_PX) * across + px[0] / PLACE_PX;
}

/* Which of the commonest surfaces, or -1. */
static int surface_of(const struct looked_at *l, const float *ln)
{
    for (size_t i = 0; i < l->surfaces; i++)
        if (lit_ground_is(&l->lit[i], ln)) return (int)i;
    return -1;
}

bool gather_edges(struct gathered *g, const struct looked_at *l, struct error *err)
{
    const struct static_mesh *mesh = l->stage->mesh;
    struct shadow_edge *edges;
    size_t n;
    if (!shadow_edges_find(&edges, &n, &l->tones, &l->view, err)) return false;
    bool ok = true;
    for (size_t i = 0; ok && i < n; i++) {
        const struct shadow_edge *e = &edges[i];
        int surface = surface_of(l, e->lit);
        bool on_lit = surface >= 0;
        struct shade_sample sample = { { e->ln[0], e->ln[1], e->ln[2] }, place_of(l, e->shade_px), on_lit ? surface : 0 };
        struct shadow_sides sides;
        if (!g->by_place && !on_lit) continue;
        if (!grow(g)) {
            ok = out_of_memory(err);
            break;
        }
        if (g->by_place) {
            ground_view_at(&sides.lit_m, &l->view, e->lit_px[0], e->lit_px[1]);
            ground_view_at(&sides.shade_m, &l->view, e->shade_px[0], e->shade_px[1]);
            int lit = !static_mesh_blocks(mesh, sides.lit_m, g->sun, SUN_NEAR_M, SUN_FAR_M);
            int shade = !static_mesh_blocks(mesh, sides.shade_m, g->sun, SUN_NEAR_M, SUN_FAR_M);
            if (lit > shade && !open_ratio(sample.ln, sky_seen(mesh, sides.lit_m), sky_seen(mesh, sides.shade_m))) continue;
            g->sides[g->n] = sides;
            g->told[g->n] = (int8_t)(lit - shade);
        }
        g->on_lit[g->n] = on_lit;
        g->samples[g->n++] = sample;
    }
    free(edges);
    return ok;
}

/* --- marks --- */

static bool mark_fail(const struct scene *s, const struct scene_mark *mark, struct error *err, const char *what, const char *advice)
{
    return error_at(err, ERR_INPUT, s->path, mark->source.line, mark->source.column, "light.shadows: %s: %s", what, advice);
}

/* Mean light about a marked position. */
static bool marked(float ln[3], const struct looked_at *l, struct vec2 q)
{
    const struct camera *given = &l->stage->scene->cameras[l->shot->camera].camera;
    int x0 = (int)(q.x * l->camera.width_px / given->width_px) / l->tones.reduction;
    int y0 = (int)(q.y * l->camera.height_px / given->height_px) / l->tones.reduction, n = 0;
    double sum[3] = { 0 };
    for (int y = y0 - 1; y <= y0 + 1; y++)
        for (int x = x0 - 1; x <= x0 + 1; x++) {
            if (x < 0 || y < 0 || x >= l->tones.width_px || y >= l->tones.height_px) continue;
            if (!tones_good(&l->tones, x, y)) return false;
            for (int c = 0; c < 3; c++) sum[c] += (double)tones_at(&l->tones, x, y)[c];
            n++;
        }
    for (int c = 0; c < 3; c++) ln[c] = (float)(sum[c] / n);
    return n > 0;
}

bool gather_marks(struct gathered *g, const struct looked_at *l, size_t shot, struct error *err)
{
    const struct scene *s = l->stage->scene;
    for (size_t i = 0; i < s->mark_count; i++) {
        const struct scene_mark *mark = &s->marks[i];
        float lit[3], shade[3];
        if (mark->shot != shot) continue;
        const char *clipped = "the photograph is saturated or black there: mark another pixel";
        if (!marked(lit, l, mark->lit_px)) return mark_fail(s, mark, err, "lit_px", clipped);
        if (!marked(shade, l, mark->shade_px)) return mark_fail(s, mark, err, "shade_px", clipped);
        struct shade_sample *sample = &g->marks[g->mark_count];
        *sample = (struct shade_sample){ .place = (int)g->mark_count };
        for (int c = 0; c < 3; c++) sample->ln[c] = shade[c] - lit[c];
        if (!(sample->ln[1] < 0))
            return mark_fail(s, mark, err, "the marked shade is not darker than what is marked as lit",
                             "lit_px and shade_px are two pixels of the same surface, in the sun and in a shadow");
        if (!(sample->ln[0] < 0 && sample->ln[2] < 0))
            return mark_fail(s, mark, err, "the marked shade is brighter than what is marked as lit in one of its colours",
                             "the two pixels must show the same surface");
        g->mark_count++;
    }
    return true;
}

void gathered_release(struct gathered *g)
{
    free(g->samples);
    free(g->sides);
    free(g->told);
    free(g->on_lit);
    free(g->marks);
    *g = (struct gathered){ 0 };
}
