#include "gen/light/sky_form.h"
#include "gen/scene/scene_keys.h"
#include "gen/scene/scene_read.h"

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

bool scene_read_light(const struct reading *r, const struct yaml_node *node)
{
    struct scene *scene = r->scene;
    scene->sky = (enum sky_kind)schema_choice(sky_name, yaml_get(node, "sky"));
    scene->turbidity = number_at(node, "turbidity");
    scene->sun_scale = number_at(node, "sun_scale");
    scene->fill = number_at(node, "fill");
    scene->sun_source = source_of(yaml_get(node, "sun"));

    static const struct { const char *key; enum sky_kind sky; const char *why; } only[] = {
        { "turbidity", SKY_CLEAR, "has a meaning under a clear sky only: remove it, or use \"sky: clear\"" },
        { "cie_type", SKY_CIE, "means a standard sky: remove it, or use \"sky: cie\"" },
        { "map", SKY_MAP, "means a measured sky: remove it, or use \"sky: map\"" },
    };
    for (size_t i = 0; i < sizeof only / sizeof *only; i++) {
        const struct yaml_node *given = yaml_get(node, only[i].key);
        if (scene->sky != only[i].sky && given && !given->is_default)
            return FAIL(r, given, "light.%s: %s", only[i].key, only[i].why);
    }
    switch (scene->sky) {
    case SKY_CLEAR: return read_sun(r, node, "a clear sky");
    case SKY_CIE: return read_cie(r, node);
    case SKY_MAP: return read_map(r, node);
    case SKY_OVERCAST:
    default:
        return read_no_sun(r, node, "an overcast sky") &&
               refuse_sun_scale(r, node, "has no meaning under an overcast sky: remove it, or use \"sky: clear\"");
    }
}
