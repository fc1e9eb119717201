#include "gen/light/sky_form.h"
#include "gen/scene/scene_keys.h"
#include "gen/scene/scene_read.h"

#include <stdlib.h>
#include <string.h>

/* A sky without a sun to see. In: what: the sky, for errors */
static bool read_no_sun(const struct reading *r, const struct yaml_node *node, const char *what)
{
    const struct yaml_node *sun = yaml_get(node, "sun");
    r->scene->sun = SUN_NONE;
    return sun->kind != YAML_MAPPING ||
           FAIL(r, sun, "light.sun: %s shows no sun: remove it, or use \"sky: clear\"", what);
}

/* A sky that is as its sun stands. In: what: the sky, for errors */
static bool read_sun(const struct reading *r, const struct yaml_node *node, const char *what)
{
    struct scene *scene = r->scene;
    const struct yaml_node *sun = yaml_get(node, "sun");
    if (sun->kind == YAML_MAPPING) {
        scene->sun = SUN_GIVEN;
        scene->sun_azimuth_rad = rad_from_deg(number_at(sun, "azimuth_deg"));
        scene->sun_elevation_rad = rad_from_deg(number_at(sun, "elevation_deg"));
        return true;
    }
    if (!strcmp(sun->text, "none"))
        return FAIL(r, sun,
                    "light.sun: %s has its light from the sun: \"sun_scale: 0\" takes the sun itself away, "
                    "\"sky: overcast\" needs none", what);
    if (!scene->has_place || !scene->has_time)
        return FAIL(r, yaml_get(node, "sky"),
                    "light: %s needs its sun, and %s missing: give place and time, or light.sun as "
                    "{azimuth_deg, elevation_deg}", what,
                    scene->has_place ? "time is" : scene->has_time ? "place is" : "place and time are");
    scene->sun = SUN_BY_TIME;
    return true;
}

static bool refuse_sun_scale(const struct reading *r, const struct yaml_node *node, const char *why)
{
    return scene_refuse_given(r, node, (const char *const[]){ "sun_scale", NULL }, "light", why);
}

static bool read_cie(const struct reading *r, const struct yaml_node *node)
{
    struct scene *scene = r->scene;
    const struct yaml_node *type = yaml_get(node, "cie_type");
    if (!type) return FAIL(r, yaml_get(node, "sky"), "light.cie_type: is missing: 1 (overcast) to 15 (clear, hazy)");
    scene->cie_type = (int)schema_number(type);
    const struct cie_sky *cie = cie_sky(scene->cie_type);
    if (cie->shows_sun) return read_sun(r, node, "this standard sky");
    if (!refuse_sun_scale(r, node, "has no meaning under a standard sky of type 1 to 6: they show no sun")) return false;
    return cie->turns ? read_sun(r, node, "this standard sky") : read_no_sun(r, node, "a standard sky of type 1, 3 or 5");
}

static bool read_map(const struct reading *r, const struct yaml_node *node)
{
    struct scene *scene = r->scene;
    const struct yaml_node *map = yaml_get(node, "map"), *sun = yaml_get(node, "sun");
    if (!map) return FAIL(r, yaml_get(node, "sky"), "light.map: is missing: {file, north_px} or {file, middle_deg}");
    const struct yaml_node *column = yaml_get(map, "north_px"), *middle = yaml_get(map, "middle_deg");
    scene->map.source = source_of(yaml_get(map, "file"));
    scene->map.north_source = source_of(column ? column : middle);
    scene->map.by_column = column != NULL;
    if (column) scene->map.north_px = schema_number(column);
    else scene->map.middle_rad = rad_from_deg(schema_number(middle));
    if (sun->kind == YAML_MAPPING) {
        if (!read_sun(r, node, "a map")) return false;
    } else {
        scene->sun = strcmp(sun->text, "none") ? SUN_IN_MAP : SUN_NONE;
    }
    if (scene->sun == SUN_NONE && !refuse_sun_scale(r, node, "has no meaning where the map is taken without a sun")) return false;
    return scene_copy_path(r, &scene->map.file, yaml_get(map, "file"));
}

/* Marks in the pictures of shots. */
static bool read_marks(const struct reading *r, const struct yaml_node *list)
{
    struct scene *scene = r->scene;
    scene->marks = calloc(list->count + 1, sizeof *scene->marks);
    if (!scene->marks) return out_of_memory(r);
    for (size_t i = 0; i < list->count; i++) {
        const struct yaml_node *item = list->items[i], *lit = yaml_get(item, "lit_px"), *shade = yaml_get(item, "shade_px");
        struct scene_mark *mark = &scene->marks[i];
        double q[4];
        schema_numbers(q, 2, lit);
        schema_numbers(q + 2, 2, shade);
        *mark = (struct scene_mark){ { q[0], q[1] }, { q[2], q[3] }, (size_t)number_at(item, "shot"), source_of(item) };
        if (!scene_check_pixel(r, mark->lit_px, mark->shot, lit, "light.shadows: lit_px") ||
            !scene_check_pixel(r, mark->shade_px, mark->shot, shade, "light.shadows: shade_px"))
            return false;
        if (!scene->video && !scene->shots[mark->shot].photograph)
            return FAIL(r, item, "light.shadows: shot %zu has no photograph: it is a new view", mark->shot);
        scene->mark_count++;
    }
    return true;
}

/* What the photographs are to tell. In: node: a mapping, or "auto" alone */
static bool read_auto(const struct reading *r, const struct yaml_node *node)
{
    struct scene *scene = r->scene;
    const struct yaml_node *sun = yaml_get(node, "sun"), *marks = yaml_get(node, "shadows"), *scale = yaml_get(node, "sun_scale");
    bool photograph = scene->video != NULL;
    for (size_t i = 0; i < scene->shot_count; i++) photograph = photograph || scene->shots[i].photograph;
    if (!photograph) return FAIL(r, node, "light: \"auto\" is told by a photograph, and all shots are new views: use \"sky: clear\" or \"overcast\"");
    if (scale && !scale->is_default) return FAIL(r, scale, "light.sun_scale: \"sky: auto\" finds it by itself: remove it, or use \"sky: clear\"");
    if (sun && sun->kind == YAML_MAPPING) {
        if (!read_sun(r, node, "")) return false;
    } else if (sun && !strcmp(sun->text, "none")) {
        return FAIL(r, sun, "light.sun: where there is none, it is \"sky: overcast\"");
    } else {
        scene->sun = scene->has_place && scene->has_time ? SUN_BY_TIME : SUN_NONE;
    }
    return !marks || read_marks(r, marks);
}

static bool read_sky_share(const struct reading *r, const struct yaml_node *node)
{
    const struct yaml_node *share = yaml_get(node, "sky_share");
    if (!share) return true;
    r->scene->has_sky_share = true;
    schema_numbers(r->scene->sky_share, 3, share);
    return refuse_sun_scale(r, node, "and sky_share say the same: remove one");
}

bool scene_read_light(const struct reading *r, const struct yaml_node *node)
{
    struct scene *scene = r->scene;
    scene->light_source = scene->sun_source = source_of(node);
    scene->sun_scale = 1;
    scene->sky = SKY_AUTO;
    if (node->kind != YAML_MAPPING) return read_auto(r, node);
    scene->sky = (enum sky_kind)schema_choice(sky_name, yaml_get(node, "sky"));
    scene->turbidity = number_at(node, "turbidity");
    scene->sun_scale = number_at(node, "sun_scale");
    scene->fill = number_at(node, "fill");
    scene->shade = (enum shade_kind)schema_choice(shade_name, yaml_get(node, "shade"));
    scene->sun_source = source_of(yaml_get(node, "sun"));

    static const struct { const char *key; enum sky_kind sky; const char *why; } only[] = {
        { "turbidity", SKY_CLEAR, "has a meaning under a clear sky only: remove it, or use \"sky: clear\"" },
        { "sky_share", SKY_CLEAR, "has a meaning under a clear sky only: remove it, or use \"sky: clear\"" },
        { "cie_type", SKY_CIE, "means a standard sky: remove it, or use \"sky: cie\"" },
        { "map", SKY_MAP, "means a measured sky: remove it, or use \"sky: map\"" },
        { "shadows", SKY_AUTO, "are marked for \"sky: auto\": remove them, or use it" },
    };
    for (size_t i = 0; i < sizeof only / sizeof *only; i++) {
        const struct yaml_node *given = yaml_get(node, only[i].key);
        if (scene->sky != only[i].sky && given && !given->is_default)
            return FAIL(r, given, "light.%s: %s", only[i].key, only[i].why);
    }
    switch (scene->sky) {
    case SKY_AUTO: return read_auto(r, node);
    case SKY_CLEAR: return read_sun(r, node, "a clear sky") && read_sky_share(r, node);
    case SKY_CIE: return read_cie(r, node);
    case SKY_MAP: return read_map(r, node);
    case SKY_OVERCAST:
    default:
        return read_no_sun(r, node, "an overcast sky") &&
               refuse_sun_scale(r, node, "has no meaning under an overcast sky: remove it, or use \"sky: clear\"");
    }
}
