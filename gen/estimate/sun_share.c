#include "gen/estimate/sun_share.h"

#include "gen/light/push_pull.h"
#include "lib/rect.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define TEXEL_M 0.0625       /* the sun's own penumbra at 7 m */
#define TEXELS_MAX (1 << 20) /* beyond, texels grow */
#define BORDER 2             /* texels of sun round it */
#define FINEST 3             /* samples along a texel's side, at most */
#define UNKNOWN_LIT 0.001f   /* what is not known is lit, unless it is near to what is known */
#define IN_SUN 250
/* Over a mesh, which is rough: what is so level is ground; so near to it nothing is in the way; and so far the photograph's may be off. */
#define LEVEL_COS 0.8
#define OFF_MESH_M 0.3
#define FAR_M 1000
#define DEPTH_OFF_M 0.5
/* Of a square about a texel so much is to be known. */
#define SQUARE_M 1.0
#define TOLD_MIN 0.33
enum { MEETS_MAX = 4, SUN_TEXELS = 2 }; /* the latter: what the sun's disc adds to a shadow */

struct window { struct vec2 low_m; double texel_m; int width, height; };

/* Of a texel over a mesh. */
enum cast { NO_GROUND, CAST_NONE, CAST_LOW, CAST_HIGH };

/* --- places --- */

/* Where the ray of the sun through a point meets the plane. */
static struct vec3 along_sun(const struct plane *ground, struct vec3 towards_sun, struct vec3 p)
{
    double above = vec3_dot(ground->normal, p) - ground->offset_m;
    return vec3_sub(p, vec3_scale(towards_sun, above / vec3_dot(ground->normal, towards_sun)));
}

/* At places that do not move with the entities. False where there are none. */
static bool lay_window(struct window *w, const struct sun_share_input *in)
{
    struct vec2 low = { INFINITY, INFINITY }, high = { -INFINITY, -INFINITY };
    for (size_t i = 0; i < in->n; i++)
        for (size_t k = 0; k < in->receivers[i].corners; k++) {
            struct vec3 p = in->receivers[i].corner_m[k];
            if (in->place) p = along_sun(in->ground, in->towards_sun, p);
            low = (struct vec2){ fmin(low.x, p.x), fmin(low.y, p.y) };
            high = (struct vec2){ fmax(high.x, p.x), fmax(high.y, p.y) };
        }
    if (!(low.x < high.x && low.y < high.y)) return false;
    w->texel_m = TEXEL_M;
    while ((high.x - low.x) * (high.y - low.y) > TEXELS_MAX * w->texel_m * w->texel_m) w->texel_m *= 2;
    w->low_m = (struct vec2){ (floor(low.x / w->texel_m) - BORDER) * w->texel_m, (floor(low.y / w->texel_m) - BORDER) * w->texel_m };
    w->width = (int)ceil((high.x - w->low_m.x) / w->texel_m) + BORDER;
    w->height = (int)ceil((high.y - w->low_m.y) / w->texel_m) + BORDER;
    return true;
}

static bool is_border(const struct window *w, int x, int y)
{
    return x < BORDER || y < BORDER || x >= w->width - BORDER || y >= w->height - BORDER;
}

static struct vec3 texel_middle(const struct window *w, const struct plane *ground, int x, int y)
{
    struct vec2 at = { w->low_m.x + (x + 0.5) * w->texel_m, w->low_m.y + (w->height - y - 0.5) * w->texel_m };
    return vec3(at.x, at.y, plane_height(ground, at.x, at.y));
}

/* The level ground of the mesh that a ray of the sun first meets, coming from above the entities. */
static bool meet_ground(struct vec3 *p, const struct sun_share_input *in, struct vec3 at)
{
    struct vec3 from_sun = vec3_scale(in->towards_sun, -1);
    *p = vec3_add(at, vec3_scale(in->towards_sun, in->top_m / in->towards_sun.z));
    for (int i = 0; i < MEETS_MAX; i++) {
        struct static_hit hit;
        static_mesh_hits(in->place, &hit, *p, &from_sun, 1);
        if (!isfinite(hit.range_m)) return false;
        *p = vec3_add(*p, vec3_scale(from_sun, hit.range_m));
        if (fabs(static_mesh_normal(in->place, hit.triangle).z) > LEVEL_COS) return true;
        *p = vec3_add(*p, vec3_scale(from_sun, 0.01));
    }
    return false;
}

/* What of the mesh keeps the sun from its ground: the lowest of it. */
static enum cast cast_on(const struct sun_share_input *in, struct vec3 p)
{
    struct static_hit hit;
    static_mesh_hits(in->place, &hit, vec3_add(p, vec3_scale(in->towards_sun, OFF_MESH_M)), &in->towards_sun, 1);
    return !(hit.range_m < FAR_M) ? CAST_NONE : (OFF_MESH_M + hit.range_m) * in->towards_sun.z < in->height_m ? CAST_LOW : CAST_HIGH;
}

static bool in_receiver(const struct sun_share_input *in, struct vec3 p)
{
    for (size_t i = 0; i < in->n; i++)
        if (receiver_contains(&in->receivers[i], p)) return true;
    return false;
}

/* --- the photograph --- */

/* Does the camera see a point of the mesh's ground? */
static bool is_seen(const struct sun_share_input *in, struct vec2 q, struct vec3 p)
{
    if (!in->place) return true;
    double z = pose_apply(in->seen->camera_from_world, p).z, seen = (double)*image_f32(in->place_depth, (int)q.x, (int)q.y);
    return fabs(seen - z) < DEPTH_OFF_M;
}

/* The linear colour that the picture shows of a ground point, without the haze. */
static bool colour_at(const struct sun_share_input *in, double linear[3], struct vec2 *q, struct vec3 p)
{
    const struct seen *seen = in->seen;
    if (!seen_project(seen, q, p) || seen_hidden(seen, *q) || !is_seen(in, *q, p)) return false;
    seen_radiance(seen, linear, *q);
    seen_clear_air(seen, linear, vec3_norm(vec3_sub(p, seen->world_from_camera.translation)));
    for (int c = 0; c < 3; c++) linear[c] *= seen->k[c];
    return true;
}

/* The sun's share at the ground about p, times how much of it is known, and that. */
static void look(float rgbw[4], const struct sun_share_input *in, const struct window *w, struct vec3 p)
{
    double range = vec3_norm(vec3_sub(p, in->seen->world_from_camera.translation));
    int n = (int)fmin(fmax(ceil(w->texel_m / range / in->seen->pixel_rad / 3), 1), FINEST), known = 0;
    double step = w->texel_m / n, sum = 0;
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) {
            struct vec3 s = vec3(p.x + (i - (n - 1) / 2.0) * step, p.y + (j - (n - 1) / 2.0) * step, p.z);
            struct vec2 q;
            double linear[3], sun;
            if (!in->place) s.z = plane_height(in->ground, s.x, s.y);
            if (!colour_at(in, linear, &q, s) || !ground_shade_sun(in->shade, &sun, q, linear)) continue;
            sum += sun;
            known++;
        }
    rgbw[0] = (float)sum / (float)(n * n);
    rgbw[3] = (float)known / (float)(n * n);
}

/* --- a plane --- */

static bool look_at_plane(float (*rgbw)[4], const struct sun_share_input *in, const struct window *w, struct error *err)
{
    for (int y = 0; y < w->height; y++)
        for (int x = 0; x < w->width; x++) {
            float *texel = rgbw[y * w->width + x];
            look(texel, in, w, texel_middle(w, in->ground, x, y));
            if (texel[3] <= UNKNOWN_LIT) texel[0] = texel[3] = UNKNOWN_LIT;
        }
    return push_pull(rgbw, w->width, w->height, err);
}

/* --- a mesh --- */

static int steps_of(const struct window *w)
{
    return (int)(SQUARE_M / 2 / w->texel_m);
}

/* How many texels are marked in the square about each. Out: count (height,width) In: mark (height,width), scratch (height,width) */
static void count_near(uint32_t *count, const uint8_t *mark, uint32_t *scratch, const struct window *w)
{
    int steps = steps_of(w);
    for (int y = 0; y < w->height; y++) {
        uint32_t sum = 0;
        for (int x = 0; x < w->width + steps; x++) {
            if (x < w->width) sum += mark[y * w->width + x];
            if (x > 2 * steps) sum -= mark[y * w->width + x - 2 * steps - 1];
            if (x >= steps) scratch[y * w->width + x - steps] = sum;
        }
    }
    for (int x = 0; x < w->width; x++) {
        uint32_t sum = 0;
        for (int y = 0; y < w->height + steps; y++) {
            if (y < w->height) sum += scratch[y * w->width + x];
            if (y > 2 * steps) sum -= scratch[(y - 2 * steps - 1) * w->width + x];
            if (y >= steps) count[(y - steps) * w->width + x] = sum;
        }
    }
}

/* Where the photograph tells nothing, and where what is low casts, the map is 1. Returns whether the mesh's shade counts no more. */
static bool settle(float *sun, enum cast cast, bool told)
{
    bool by_mesh = !told || (cast == CAST_LOW && *sun < 0.5f);
    if (!told || cast == CAST_LOW) *sun = 1;
    return !by_mesh;
}

/* Where the map tells of shade, or of sun in the mesh's, and round it: the mesh's shade in the passes, of a coarser mesh, may reach as far.
 * In: told (height,width) 1: the photograph tells; scratch (2,height,width) */
static void let_through(uint8_t *through, float (*rgbw)[4], const uint8_t *cast, const uint8_t *told, uint32_t *scratch, const struct window *w)
{
    size_t n = (size_t)w->width * (size_t)w->height;
    for (size_t i = 0; i < n; i++)
        through[i] = settle(&rgbw[i][0], (enum cast)cast[i], told[i]) && (cast[i] != CAST_NONE || rgbw[i][0] * 255 < IN_SUN);
    count_near(scratch, through, scratch + n, w);
    for (size_t i = 0; i < n; i++) through[i] = through[i] || (scratch[i] && told[i] && cast[i] == CAST_NONE) ? 255 : 0;
}

/* The map overlaps by a texel with the mesh's shade: between texels there is no sun. */
static void overlap(float (*rgbw)[4], const uint8_t *cast, const uint8_t *through, const struct window *w)
{
    for (int y = BORDER; y < w->height - BORDER; y++)
        for (int x = BORDER; x < w->width - BORDER; x++) {
            int at = y * w->width + x;
            if (through[at] || (cast[at] != CAST_LOW && cast[at] != CAST_HIGH)) continue;
            for (int v = y - 1; v <= y + 1; v++)
                for (int u = x - 1; u <= x + 1; u++)
                    if (through[v * w->width + u]) rgbw[at][0] = fminf(rgbw[at][0], rgbw[v * w->width + u][0]);
        }
}

static bool look_at_mesh(float (*rgbw)[4], uint8_t *through, const struct sun_share_input *in, const struct window *w, struct error *err)
{
    size_t n = (size_t)w->width * (size_t)w->height;
    uint8_t *cast = calloc(n, 1), *told = calloc(n, 1);
    uint32_t *scratch = calloc(2 * n, sizeof *scratch), enough = (uint32_t)(TOLD_MIN * (2 * steps_of(w) + 1) * (2 * steps_of(w) + 1));
    bool ok = (cast && told && scratch) || error_set(err, ERR_MEMORY, "no memory for the shade on the ground");
    for (int y = 0; ok && y < w->height; y++)
        for (int x = 0; x < w->width; x++) {
            struct vec3 p;
            int at = y * w->width + x;
            if (is_border(w, x, y) || !meet_ground(&p, in, texel_middle(w, in->ground, x, y)) || !in_receiver(in, p)) continue;
            cast[at] = (uint8_t)cast_on(in, p);
            look(rgbw[at], in, w, p);
            told[at] = rgbw[at][3] > 0.5f;
        }
    if (ok) count_near(scratch, told, scratch + n, w);
    for (size_t i = 0; ok && i < n; i++) told[i] = cast[i] != NO_GROUND && scratch[i] > enough;
    ok = ok && push_pull(rgbw, w->width, w->height, err);
    if (ok) let_through(through, rgbw, cast, told, scratch, w);
    if (ok) overlap(rgbw, cast, through, w);
    free(cast);
    free(told);
    free(scratch);
    return ok;
}

/* --- the map --- */

static uint8_t texel_at(const float (*rgbw)[4], const struct window *w, int x, int y)
{
    return is_border(w, x, y) ? 255 : (uint8_t)(fminf(1, rgbw[y * w->width + x][0]) * 255 + 0.5f);
}

/* No more than the shade and a border in the sun: every ray to the sun that meets the map costs. */
static bool draw(struct sun_share *out, const float (*rgbw)[4], const uint8_t *through, const struct window *w, struct error *err)
{
    struct rect r = { w->width, w->height, 0, 0 };
    for (int y = 0; y < w->height; y++)
        for (int x = 0; x < w->width; x++)
            if (texel_at(rgbw, w, x, y) < IN_SUN || (through && through[y * w->width + x])) r = rect_unite(r, (struct rect){ x - 1, y - 1, x + 2, y + 2 });
    if (rect_is_empty(r)) return true;
    if (!image_init(&out->map, r.x1 - r.x0, r.y1 - r.y0, 1, PIXEL_U8, err)) return false;
    if (through && !image_init(&out->through, r.x1 - r.x0, r.y1 - r.y0, 1, PIXEL_U8, err)) return false;
    for (int y = r.y0; y < r.y1; y++)
        for (int x = r.x0; x < r.x1; x++) {
            uint8_t sun = texel_at(rgbw, w, x, y);
            *image_u8(&out->map, x - r.x0, y - r.y0) = sun < IN_SUN ? sun : 255;
            if (through) *image_u8(&out->through, x - r.x0, y - r.y0) = through[y * w->width + x];
        }
    out->low_m = (struct vec2){ w->low_m.x + r.x0 * w->texel_m, w->low_m.y + (w->height - r.y1) * w->texel_m };
    out->high_m = (struct vec2){ w->low_m.x + r.x1 * w->texel_m, w->low_m.y + (w->height - r.y0) * w->texel_m };
    return true;
}

bool sun_share_create(struct sun_share *share, const struct sun_share_input *in, struct error *err)
{
    struct sun_share out = { .ground = *in->ground };
    struct window w;
    bool ok = true;
    if (in->shade->found && lay_window(&w, in)) {
        size_t n = (size_t)w.width * (size_t)w.height;
        float (*rgbw)[4] = calloc(n, sizeof *rgbw);
        uint8_t *through = in->place ? calloc(n, 1) : NULL;
        ok = (rgbw && (through || !in->place)) || error_set(err, ERR_MEMORY, "no memory for the shade on the ground");
        ok = ok && (in->place ? look_at_mesh(rgbw, through, in, &w, err) : look_at_plane(rgbw, in, &w, err)) &&
             draw(&out, (const float (*)[4])rgbw, through, &w, err);
        free(rgbw);
        free(through);
    }
    if (ok) *share = out;
    else sun_share_release(&out);
    return ok;
}

void sun_share_release(struct sun_share *share)
{
    image_release(&share->map);
    image_release(&share->through);
}

/* The map's value at a place of the plane, 0 to 1; beyond it, and without one, as told. */
static double value_at(const struct sun_share *share, const struct image *map, struct vec2 at, double beyond)
{
    if (!map->data) return beyond;
    double x = (at.x - share->low_m.x) / (share->high_m.x - share->low_m.x) * map->width_px;
    double y = (share->high_m.y - at.y) / (share->high_m.y - share->low_m.y) * map->height_px;
    if (!(x >= 0 && y >= 0 && x < map->width_px && y < map->height_px)) return beyond;
    return *image_u8(map, (int)x, (int)y) / 255.0;
}

double sun_share_at(const struct sun_share *share, struct vec2 at)
{
    return value_at(share, &share->map, at, 1);
}

double sun_share_past(const struct sun_share *share, struct vec3 p, struct vec3 towards_sun, bool cast)
{
    if (!share || !share->map.data) return cast ? 0 : 1;
    struct vec3 foot = along_sun(&share->ground, towards_sun, p);
    struct vec2 at = { foot.x, foot.y };
    return cast && !(value_at(share, &share->through, at, 0) > 0.5) ? 0 : sun_share_at(share, at);
}

/* Does the map tell of what a triangle can shade? */
static enum told told_of(const struct sun_share *share, const struct static_cut *cut, const uint32_t triangle[3], struct vec3 towards_sun)
{
    const struct image *through = &share->through;
    double texel = (share->high_m.x - share->low_m.x) / through->width_px;
    struct vec2 low = { INFINITY, INFINITY }, high = { -INFINITY, -INFINITY };
    for (int k = 0; k < 3; k++) {
        const float *v = cut->position_m[triangle[k]];
        struct vec3 p = along_sun(&share->ground, towards_sun, vec3((double)v[0], (double)v[1], (double)v[2]));
        double x = floor((p.x - share->low_m.x) / texel), y = floor((share->high_m.y - p.y) / texel);
        low = (struct vec2){ fmin(low.x, x - SUN_TEXELS), fmin(low.y, y - SUN_TEXELS) };
        high = (struct vec2){ fmax(high.x, x + SUN_TEXELS), fmax(high.y, y + SUN_TEXELS) };
    }
    bool all = low.x >= 0 && low.y >= 0 && high.x < through->width_px && high.y < through->height_px, none = true;
    for (int y = (int)fmax(0, low.y); y <= fmin(through->height_px - 1, high.y); y++)
        for (int x = (int)fmax(0, low.x); x <= fmin(through->width_px - 1, high.x); x++) {
            all = all && *image_u8(through, x, y);
            none = none && !*image_u8(through, x, y);
        }
    return none ? TOLD_NOWHERE : all ? TOLD : TOLD_IN_PART;
}

bool sun_share_part(size_t count[TOLD_KINDS], const struct sun_share *share, struct static_cut *cut, struct vec3 towards_sun, struct error *err)
{
    size_t n = cut->triangles, filled = 0;
    memset(count, 0, TOLD_KINDS * sizeof *count);
    count[TOLD_NOWHERE] = n;
    if (!share->through.data) return true;
    uint32_t (*sorted)[3] = calloc(n + 1, sizeof *sorted);
    uint8_t *kind = malloc(n + 1);
    bool ok = (sorted && kind) || error_set(err, ERR_MEMORY, "no memory for what shades the place");
    for (size_t i = 0; ok && i < n; i++) kind[i] = (uint8_t)told_of(share, cut, cut->triangle[i], towards_sun);
    for (uint8_t k = 0; ok && k < TOLD_KINDS; k++) {
        size_t before = filled;
        for (size_t i = 0; i < n; i++)
            if (kind[i] == k) memcpy(sorted[filled++], cut->triangle[i], sizeof *sorted);
        count[k] = filled - before;
    }
    if (ok) memcpy(cut->triangle, sorted, n * sizeof *sorted);
    free(sorted);
    free(kind);
    return ok;
}

double sun_share_hangs_m(const struct sun_share *share, struct vec3 sun, const struct entity *entities, size_t n)
{
    static const double above_m = 0.1;
    const struct plane *ground = &share->ground;
    double most = 0;
    for (size_t i = 0; i < n; i++) {
        struct vec3 corner[8];
        entity_corners(corner, &entities[i]);
        for (int k = 0; k < 8; k++) most = fmax(most, vec3_dot(ground->normal, corner[k]) - ground->offset_m);
    }
    return (most + above_m) / vec3_dot(ground->normal, sun);
}
