#include "gen/trace/bounced.h"

#include <math.h>
#include <stdlib.h>

#define FAR_M 1e5

/* The light on open ground of an inclination. */
struct open_ground { double sky[3], sun[3]; };

static size_t nearest(const struct bounced_input *in, struct vec2 at)
{
    size_t found = 0;
    double least = INFINITY;
    for (size_t i = 0; i < in->n; i++) {
        double away = hypot(at.x - in->ground[i].at_m.x, at.y - in->ground[i].at_m.y);
        if (away < least) {
            least = away;
            found = i;
        }
    }
    return found;
}

/* The share of the light in the open that is left, where the sun has its own shadow. */
static void left_of(double rgb[3], const struct bounced_input *in, const struct open_ground *open, struct vec3 p, struct vec3 normal)
{
    const struct light *light = in->light;
    struct sky_seen seen = sky_sight_at(in->sight, p, normal);
    double sun = 0;
    if (light->has_sun && !sky_sight_hidden(in->sight, p, vec3_add(p, vec3_scale(light->sun_direction, FAR_M))))
        sun = in->sun ? sun_share_at(in->sun, (struct vec2){ p.x, p.y }) : 1;
    for (int c = 0; c < 3; c++) {
        double share = seen.without[c] > 0 ? seen.with[c] / seen.without[c] : 1, direct = sun * open->sun[c];
        rgb[c] = (share * open->sky[c] + direct) / fmax(open->sky[c] + direct, 1e-9);
    }
}

bool bounced_shade(struct image *albedo, const struct bounced_input *in, struct error *err)
{
    enum { SIDE = 2 }; /* samples along a texel */
    struct open_ground *open = calloc(in->n + 1, sizeof *open);
    if (!open) return error_set(err, ERR_MEMORY, "no memory for the light that the ground sends back");
    for (size_t i = 0; i < in->n; i++) {
        struct vec3 normal = in->ground[i].plane.normal;
        double all[3];
        light_sky_irradiance(open[i].sky, in->light, normal);
        light_irradiance(all, in->light, normal);
        for (int c = 0; c < 3; c++) open[i].sun[c] = all[c] - open[i].sky[c];
    }
    struct vec2 texel = { (in->high_m.x - in->low_m.x) / albedo->width_px, (in->high_m.y - in->low_m.y) / albedo->height_px };
    for (int y = 0; y < albedo->height_px; y++)
        for (int x = 0; x < albedo->width_px; x++) {
            double sum[3] = { 0, 0, 0 };
            bool near = false;
            for (int i = 0; i < SIDE * SIDE; i++) {
                struct vec2 at = { in->low_m.x + (x + (i % SIDE + 0.5) / SIDE) * texel.x, in->high_m.y - (y + (i / SIDE + 0.5) / SIDE) * texel.y };
                double left[3] = { 1, 1, 1 };
                if (sky_sight_distance(in->sight, vec3(at.x, at.y, 0)) <= 0) {
                    size_t k = nearest(in, at);
                    const struct plane *ground = &in->ground[k].plane;
                    left_of(left, in, &open[k], vec3(at.x, at.y, plane_height(ground, at.x, at.y)), ground->normal);
                    near = true;
                }
                for (int c = 0; c < 3; c++) sum[c] += left[c] / (SIDE * SIDE);
            }
            uint8_t *rgb = image_u8(albedo, x, y);
            for (int c = 0; near && c < 3; c++)
                rgb[c] = (uint8_t)(srgb_from_linear(linear_from_srgb((float)rgb[c] / 255) * (float)sum[c]) * 255 + 0.5f);
        }
    free(open);
    return true;
}
