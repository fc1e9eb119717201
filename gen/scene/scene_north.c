#include "gen/light/sun.h"
#include "gen/scene/scene_read.h"

/* Where on the plane a marked pixel is. */
static bool find_mark(const struct reading *r, struct vec3 *p, const struct yaml_node *node, size_t shot, const char *who)
{
    const struct scene *s = r->scene;
    double q[2];
    schema_numbers(q, 2, node);
    struct vec2 at = { q[0], q[1] };
    struct error why = ERROR_NONE;
    if (!scene_check_pixel(r, at, shot, node, who)) return false;
    const struct scene_shot *taken = &s->shots[shot];
    return ground_from_pixel(p, &s->ground, &s->cameras[taken->camera].camera, taken->world_from_camera, at, &why) ||
           FAIL(r, node, "%s: %s", who, why.text);
}

bool scene_read_north(const struct reading *r, const struct yaml_node *root)
{
    struct scene *s = r->scene;
    const struct yaml_node *node = yaml_get(root, "north"), *given = yaml_get(root, "north_deg");
    if (!node) return true;
    if (!given->is_default) return FAIL(r, node, "north: and north_deg say the same: remove one");
    if (s->static_.mesh)
        return FAIL(r, node, "north: is told by a shadow on a plane; with a static mesh, give north_deg (`staffage light` tells by how much "
                    "it is off)");
    if (!s->has_place || !s->has_time)
        return FAIL(r, node, "north: is told by a shadow when place and time say where the sun stands: give both");
    struct atmosphere air = { 1013.25 * exp(-s->place.height_m / 8434.0), 15 };
    struct sun_position sun;
    struct vec3 foot, tip;
    size_t shot = (size_t)number_at(node, "shot");
    if (!sun_position(&sun, s->time_utc, 0, s->place, air, r->err) || !find_mark(r, &foot, yaml_get(node, "foot_px"), shot, "north.foot_px") ||
        !find_mark(r, &tip, yaml_get(node, "tip_px"), shot, "north.tip_px"))
        return false;
    double length = hypot(tip.x - foot.x, tip.y - foot.y);
    if (sun.elevation_rad <= 0) return FAIL(r, node, "north: at that time the sun is below the horizon: nothing casts a shadow");
    if (length < 0.05) return FAIL(r, node, "north: foot and tip are %.2f m apart: too near each other to tell a direction", length);
    s->north_shadow_m = length;
    s->north_height_m = length * tan(sun.elevation_rad);
    s->north_rad = sun.azimuth_rad - atan2(foot.x - tip.x, foot.y - tip.y);
    return true;
}
