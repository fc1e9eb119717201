#include "gen/trace/share.h"

#include "gen/trace/footprint.h"
#include "gen/world/prism.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define DEPTH_EDGE_M 1.0  /* there may be a gap between faces that lie so far behind each other */
#define SMOOTH_M 0.25     /* there is none between such that lie so close */
#define ALL_SAMPLES UINT64_MAX

/* What the ray through a pixel's centre says of it. */
enum {
    NEAR = 1,     /* an entity is here or at most EDGE_PX + 1 away */
    REACHED = 2,  /* at most EDGE_PX away */
    HIDDEN = 4,   /* the place hides that entity */
    RECEIVES = 8, /* the place lies within a receiver */
};

struct shares {
    const struct share_input *in;
    int width_px, height_px;
    uint8_t *state;        /* (h,w) */
    struct rays corners[2]; /* through the corners of a row's pixels: above and below */
    uint64_t *of_entities, *of_receiver; /* (width) samples hidden */
    struct rect *receiver_px; /* (receiver_count) where they can be seen */
};

static uint8_t share(uint64_t hidden_samples)
{
    return (uint8_t)lround(255.0 * (64 - __builtin_popcountll(hidden_samples)) / 64);
}

/* The entity at a pixel, or at the pixel nearest to it, at most `reach` columns and rows away; the nearer of two as near.
 * False where there is none. */
static bool entity_near(const struct shares *s, double *range_m, int *eu, int *ev, int x, int y, int reach)
{
    const struct image *ahead = s->in->ahead;
    int least = 3 * reach * reach;
    *range_m = (double)*image_f32(ahead, x, y);
    *eu = x;
    *ev = y;
    if (isfinite(*range_m)) return true;
    for (int v = y > reach ? y - reach : 0; v <= y + reach && v < s->height_px; v++)
        for (int u = x > reach ? x - reach : 0; u <= x + reach && u < s->width_px; u++) {
            int away = (u - x) * (u - x) + (v - y) * (v - y);
            double range = (double)*image_f32(ahead, u, v);
            if (!isfinite(range) || away > least || (away == least && range >= *range_m)) continue;
            least = away;
            *range_m = range;
            *eu = u;
            *ev = v;
        }
    return isfinite(*range_m);
}

/* The point of the entity that stands for it at a pixel. */
static bool sighted_at(const struct shares *s, struct sighted *point, int x, int y, int reach)
{
    const struct backdrop *backdrop = s->in->backdrop;
    struct error ignored = ERROR_NONE;
    struct vec3 direction;
    int u, v;
    if (!entity_near(s, &point->range_m, &u, &v, x, y, reach) ||
        !camera_unproject(s->in->rays->camera, &direction, (struct vec2){ u + 0.5, v + 0.5 }, &ignored))
        return false;
    point->point_m = vec3_add(backdrop->world_from_camera.translation,
                              vec3_scale(backdrop_direction(backdrop, direction), point->range_m));
    point->beside_px = u == x && v == y ? 0 : reach;
    return true;
}

static bool receives(const struct shares *s, struct vec3 p, int x, int y)
{
    for (size_t i = 0; i < s->in->receiver_count; i++) {
        struct rect r = s->receiver_px[i];
        if (x >= r.x0 && x < r.x1 && y >= r.y0 && y < r.y1 && prism_contains(&s->in->receivers[i], p)) return true;
    }
    return false;
}

/* The states of a row. */
static void judge_row(struct shares *s, int y)
{
    const struct share_input *in = s->in;
    uint8_t *state = s->state + (size_t)y * (size_t)s->width_px;
    rays_begin_row(in->rays, y);
    for (size_t i = 0; i < in->entity_count; i++) {
        struct rect r = in->entity_px[i];
        int beyond = EDGE_PX + 1;
        r = rect_intersect((struct rect){ r.x0 - beyond, r.y0 - beyond, r.x1 + beyond, r.y1 + beyond },
                           (struct rect){ 0, 0, s->width_px, s->height_px });
        if (rect_is_empty(in->entity_px[i]) || y < r.y0 || y >= r.y1) continue;
        for (int x = r.x0; x < r.x1; x++) {
            struct vec3 direction;
            struct sighted point;
            double range;
            int u, v;
            if (state[x] & NEAR || !entity_near(s, &range, &u, &v, x, y, beyond)) continue;
            state[x] |= NEAR;
            if (abs(u - x) <= EDGE_PX && abs(v - y) <= EDGE_PX) state[x] |= REACHED;
            double place = (double)*image_f32(&in->backdrop->range, x, y);
            if (place >= range || !rays_get(in->rays, &direction, x) || !sighted_at(s, &point, x, y, beyond)) continue;
            if (backdrop_hides(in->backdrop, backdrop_direction(in->backdrop, direction), place,
                               in->backdrop->triangle[(size_t)y * (size_t)s->width_px + (size_t)x], &point))
                state[x] |= HIDDEN;
        }
    }
    for (size_t i = 0; i < in->receiver_count; i++) {
        struct rect r = s->receiver_px[i];
        if (y < r.y0 || y >= r.y1) continue;
        for (int x = r.x0; x < r.x1; x++) {
            struct vec3 direction, p;
            if (!(state[x] & RECEIVES) && rays_get(in->rays, &direction, x) &&
                backdrop_point(in->backdrop, &p, direction, x, y) && prism_contains(&in->receivers[i], p))
                state[x] |= RECEIVES;
        }
    }
}

/* Between the nearest and the farthest point of the place at a pixel and round it. */
static double depth_step(const struct shares *s, int x, int y)
{
    const struct image *range = &s->in->backdrop->range;
    float least = INFINITY, most = 0;
    for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < s->height_px; v++)
        for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < s->width_px; u++) {
            float here = *image_f32(range, u, v);
            least = here < least ? here : least;
            most = here > most ? here : most;
        }
    return (double)most - (double)least;
}

/* Which of a pixel's shares one ray cannot tell: NEAR for the entity's, RECEIVES for the receiver's. */
static int mixed(const struct shares *s, int x, int y)
{
    const uint8_t *centre = s->state + (size_t)y * (size_t)s->width_px + (size_t)x;
    int any = 0, all = RECEIVES, hidden = 0, seen = 0;
    for (int v = y > 0 ? -1 : 0; v <= 1 && y + v < s->height_px; v++)
        for (int u = x > 0 ? -1 : 0; u <= 1 && x + u < s->width_px; u++) {
            int other = centre[(ptrdiff_t)v * s->width_px + u];
            any |= other;
            all &= other;
            if (!(other & NEAR)) continue;
            hidden |= other & HIDDEN;
            seen |= ~other & HIDDEN;
        }
    int unclear = any & ~all & RECEIVES;
    if (*centre & REACHED && hidden && (seen || depth_step(s, x, y) > DEPTH_EDGE_M)) unclear |= NEAR;
    return unclear;
}

/* 64 rays through a pixel: bit 8 j + i as in polygon.h. False where the lens does not cover all of it. */
static bool sample_rays(struct shares *s, struct vec3 direction[64], int x)
{
    struct vec3 corner[4];
    for (int k = 0; k < 4; k++) {
        if (!rays_get(&s->corners[k >> 1], &corner[k], x + (k & 1))) return false;
        corner[k] = backdrop_direction(s->in->backdrop, corner[k]);
    }
    for (int i = 0; i < 64; i++) {
        double a = (i % 8 + 0.5) / 8, b = (i / 8 + 0.5) / 8;
        struct vec3 above = vec3_add(vec3_scale(corner[0], 1 - a), vec3_scale(corner[1], a)),
                    below = vec3_add(vec3_scale(corner[2], 1 - a), vec3_scale(corner[3], a));
        direction[i] = vec3_unit(vec3_add(vec3_scale(above, 1 - b), vec3_scale(below, b)));
    }
    return true;
}

/* Where the rays meet the place; at the end of a receiver that crosses a smooth part of it, where they meet the plane of
 * the pixel's face, which spares most of the rays. */
static void sample_hits(const struct shares *s, struct static_hit hit[64], const struct vec3 direction[64], int unclear,
                        int x, int y)
{
    const struct backdrop *backdrop = s->in->backdrop;
    uint32_t triangle = backdrop->triangle[(size_t)y * (size_t)s->width_px + (size_t)x];
    if (unclear & NEAR || depth_step(s, x, y) > SMOOTH_M) {
        static_mesh_hits(backdrop->place, hit, backdrop->world_from_camera.translation, direction, 64);
        return;
    }
    /* The mean of the four rays about the centre is the centre's. */
    struct vec3 normal = static_mesh_normal(backdrop->place, triangle), centre = { 0, 0, 0 };
    static const int about[4] = { 27, 28, 35, 36 };
    for (int k = 0; k < 4; k++) centre = vec3_add(centre, direction[about[k]]);
    double level = (double)*image_f32(&backdrop->range, x, y) * vec3_dot(normal, vec3_unit(centre));
    for (int i = 0; i < 64; i++) hit[i] = (struct static_hit){ level / vec3_dot(normal, direction[i]), triangle, 0, 0 };
}

/* Add what the place hides of a row: one ray's word, or 64 rays' where that is not enough. */
static void place_row(struct shares *s, int y)
{
    const struct backdrop *backdrop = s->in->backdrop;
    struct vec3 direction[64], eye = backdrop->world_from_camera.translation;
    struct static_hit hit[64];
    rays_begin_row(&s->corners[0], y);
    rays_begin_row(&s->corners[1], y + 1);
    for (int x = 0; x < s->width_px; x++) {
        uint8_t own = s->state[(size_t)y * (size_t)s->width_px + (size_t)x];
        int unclear = mixed(s, x, y);
        struct sighted point;
        if (unclear && sample_rays(s, direction, x))
            sample_hits(s, hit, direction, unclear, x, y);
        else
            unclear = 0;
        if (unclear & NEAR && sighted_at(s, &point, x, y, EDGE_PX)) {
            point.beside_px += 1;
            for (int i = 0; i < 64; i++)
                if (hit[i].triangle != STATIC_NO_TRIANGLE &&
                    backdrop_hides(backdrop, direction[i], hit[i].range_m, hit[i].triangle, &point))
                    s->of_entities[x] |= (uint64_t)1 << i;
        } else if (own & HIDDEN && own & REACHED)
            s->of_entities[x] = ALL_SAMPLES;
        if (unclear & RECEIVES) {
            for (int i = 0; i < 64; i++)
                if (hit[i].triangle == STATIC_NO_TRIANGLE ||
                    !receives(s, vec3_add(eye, vec3_scale(direction[i], hit[i].range_m)), x, y))
                    s->of_receiver[x] |= (uint64_t)1 << i;
        } else if (!(own & RECEIVES))
            s->of_receiver[x] = ALL_SAMPLES;
    }
}

/* Add what a screen hides of a row. */
static void screen_row(struct shares *s, struct screen *screen, int y)
{
    const struct share_input *in = s->in;
    struct rect r = screen->bounds_px;
    if (y < r.y0 || y >= r.y1) return;
    polygon_row_samples(&screen->polygon, screen->samples, y, r.x0, r.x1);
    for (int x = r.x0; x < r.x1; x++) {
        uint64_t samples = screen->samples[x - r.x0];
        struct vec3 direction;
        double entity_m;
        int u, v;
        if (!samples || !rays_get(in->rays, &direction, x)) continue;
        double range = sight_range(screen->plane, direction);
        double floor_m = in->backdrop ? (double)*image_f32(&in->backdrop->range, x, y) : sight_range(in->ground, direction);
        if (entity_near(s, &entity_m, &u, &v, x, y, EDGE_PX) && range < entity_m) s->of_entities[x] |= samples;
        if (isfinite(floor_m) && range < floor_m) s->of_receiver[x] |= samples;
    }
}

static bool shares_init(struct shares *s, const struct share_input *in, struct error *err)
{
    size_t width = (size_t)in->ahead->width_px, height = (size_t)in->ahead->height_px;
    *s = (struct shares){ .in = in, .width_px = in->ahead->width_px, .height_px = in->ahead->height_px };
    s->of_entities = calloc(2 * width, sizeof *s->of_entities);
    s->state = in->backdrop ? calloc(width * height, sizeof *s->state) : NULL;
    s->receiver_px = calloc(in->receiver_count + 1, sizeof *s->receiver_px);
    if (!s->of_entities || (in->backdrop && !s->state) || !s->receiver_px)
        return error_set(err, ERR_MEMORY, "no memory for the shares of a picture");
    for (int k = 0; k < 2; k++)
        if (!rays_init_corners(&s->corners[k], in->rays->camera, err)) return false;
    s->of_receiver = s->of_entities + width;
    struct rect frame = { 0, 0, s->width_px, s->height_px };
    for (size_t i = 0; in->backdrop && i < in->receiver_count; i++) {
        struct rect r = footprint_prism(in->rays->camera, pose_inverse(in->backdrop->world_from_camera), &in->receivers[i]);
        /* A corner of a pixel may see what its centre does not. */
        if (!rect_is_empty(r)) r = rect_intersect((struct rect){ r.x0 - 1, r.y0 - 1, r.x1 + 1, r.y1 + 1 }, frame);
        s->receiver_px[i] = r;
    }
    return true;
}

bool shares_trace(struct image *visible, struct image *receiver, const struct share_input *in, struct error *err)
{
    struct shares s;
    bool ok = shares_init(&s, in, err) && image_init(visible, s.width_px, s.height_px, 1, PIXEL_U8, err) &&
              image_init(receiver, s.width_px, s.height_px, 1, PIXEL_U8, err);
    for (int y = 0; ok && in->backdrop && y < s.height_px; y++) judge_row(&s, y);
    for (int y = 0; ok && y < s.height_px; y++) {
        memset(s.of_entities, 0, 2 * (size_t)s.width_px * sizeof *s.of_entities);
        rays_begin_row(in->rays, y);
        if (in->backdrop) place_row(&s, y);
        for (size_t k = 0; k < in->screen_count; k++) screen_row(&s, &in->screens[k], y);
        for (int x = 0; x < s.width_px; x++) {
            *image_u8(visible, x, y) = share(s.of_entities[x]);
            *image_u8(receiver, x, y) = share(s.of_receiver[x]);
        }
    }
    for (int k = 0; k < 2; k++) rays_release(&s.corners[k]);
    free(s.of_entities);
    free(s.state);
    free(s.receiver_px);
    return ok;
}
