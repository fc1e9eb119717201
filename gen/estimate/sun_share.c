#include "gen/estimate/sun_share.h"

#include "gen/light/push_pull.h"
#include "lib/rect.h"

#include <math.h>
#include <stdlib.h>

#define TEXEL_M 0.0625       /* the sun's own penumbra at 7 m */
#define TEXELS_MAX (1 << 20) /* beyond, texels grow */
#define BORDER 2             /* texels of sun round it */
#define FINEST 3             /* samples along a texel's side, at most */
#define UNKNOWN_LIT 0.001f   /* what is not known is lit, unless it is near to what is known */
#define IN_SUN 250

struct window { struct vec2 low_m; double texel_m; int width, height; };

/* At places that do not move with the entities. False where there are none. */
static bool lay_window(struct window *w, const struct sun_share_input *in)
{
    struct vec2 low = { INFINITY, INFINITY }, high = { -INFINITY, -INFINITY };
    for (size_t i = 0; i < in->n; i++)
        for (size_t k = 0; k < in->receivers[i].corners; k++) {
            struct vec3 p = in->receivers[i].corner_m[k];
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

/* The linear colour that the picture shows of a ground point, without the haze. */
static bool colour_at(const struct sun_share_input *in, double linear[3], struct vec2 *q, struct vec3 p)
{
    const struct seen *seen = in->seen;
    if (!seen_project(seen, q, p) || seen_hidden(seen, *q)) return false;
    seen_radiance(seen, linear, *q);
    seen_clear_air(seen, linear, vec3_norm(vec3_sub(p, seen->world_from_camera.translation)));
    for (int c = 0; c < 3; c++) linear[c] *= seen->k[c];
    return true;
}

static void look(float rgbw[4], const struct sun_share_input *in, const struct window *w, struct vec2 at)
{
    double range = vec3_norm(vec3_sub(vec3(at.x, at.y, plane_height(in->ground, at.x, at.y)), in->seen->world_from_camera.translation));
    int n = (int)fmin(fmax(ceil(w->texel_m / range / in->seen->pixel_rad / 3), 1), FINEST), known = 0;
    double step = w->texel_m / n, sum = 0;
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) {
            struct vec2 s = { at.x + (i - (n - 1) / 2.0) * step, at.y + (j - (n - 1) / 2.0) * step }, q;
            double linear[3], sun;
            if (!colour_at(in, linear, &q, vec3(s.x, s.y, plane_height(in->ground, s.x, s.y))) || !ground_shade_sun(in->shade, &sun, q, linear)) continue;
            sum += sun;
            known++;
        }
    float weight = (float)known / (float)(n * n);
    rgbw[0] = (float)sum / (float)(n * n);
    rgbw[3] = weight;
    if (weight > UNKNOWN_LIT) return;
    rgbw[0] = rgbw[3] = UNKNOWN_LIT;
}

static bool is_border(const struct window *w, int x, int y)
{
    return x < BORDER || y < BORDER || x >= w->width - BORDER || y >= w->height - BORDER;
}

static uint8_t texel_at(const float (*rgbw)[4], const struct window *w, int x, int y)
{
    return is_border(w, x, y) ? 255 : (uint8_t)(fminf(1, rgbw[y * w->width + x][0]) * 255 + 0.5f);
}

/* No more than the shade and a border in the sun: every ray to the sun that meets the map costs. */
static bool draw(struct sun_share *out, const float (*rgbw)[4], const struct window *w, struct error *err)
{
    struct rect r = { w->width, w->height, 0, 0 };
    for (int y = 0; y < w->height; y++)
        for (int x = 0; x < w->width; x++)
            if (texel_at(rgbw, w, x, y) < IN_SUN) r = rect_unite(r, (struct rect){ x - 1, y - 1, x + 2, y + 2 });
    if (rect_is_empty(r)) return true;
    if (!image_init(&out->map, r.x1 - r.x0, r.y1 - r.y0, 1, PIXEL_U8, err)) return false;
    for (int y = r.y0; y < r.y1; y++)
        for (int x = r.x0; x < r.x1; x++) {
            uint8_t sun = texel_at(rgbw, w, x, y);
            *image_u8(&out->map, x - r.x0, y - r.y0) = sun < IN_SUN ? sun : 255;
        }
    out->low_m = (struct vec2){ w->low_m.x + r.x0 * w->texel_m, w->low_m.y + (w->height - r.y1) * w->texel_m };
    out->high_m = (struct vec2){ w->low_m.x + r.x1 * w->texel_m, w->low_m.y + (w->height - r.y0) * w->texel_m };
    return true;
}

bool sun_share_create(struct sun_share *share, const struct sun_share_input *in, struct error *err)
{
    struct sun_share out = { 0 };
    struct window w;
    bool ok = true;
    if (in->shade->found && lay_window(&w, in)) {
        float (*rgbw)[4] = calloc((size_t)w.width * (size_t)w.height, sizeof *rgbw);
        if (!rgbw) return error_set(err, ERR_MEMORY, "no memory for the shade on the ground");
        for (int y = 0; y < w.height; y++)
            for (int x = 0; x < w.width; x++)
                look(rgbw[y * w.width + x], in, &w, (struct vec2){ w.low_m.x + (x + 0.5) * w.texel_m, w.low_m.y + (w.height - y - 0.5) * w.texel_m });
        ok = push_pull(rgbw, w.width, w.height, err) && draw(&out, (const float (*)[4])rgbw, &w, err);
        free(rgbw);
    }
    if (ok) *share = out;
    return ok;
}

void sun_share_release(struct sun_share *share)
{
    image_release(&share->map);
}

double sun_share_at(const struct sun_share *share, struct vec2 at)
{
    const struct image *map = &share->map;
    if (!map->data) return 1;
    double x = (at.x - share->low_m.x) / (share->high_m.x - share->low_m.x) * map->width_px;
    double y = (share->high_m.y - at.y) / (share->high_m.y - share->low_m.y) * map->height_px;
    if (!(x >= 0 && y >= 0 && x < map->width_px && y < map->height_px)) return 1;
    return *image_u8(map, (int)x, (int)y) / 255.0;
}
