#include "gen/scene/scene_keys.h"
#include "gen/scene/scene_read.h"
#include "lib/luminance.h"

#include <stdlib.h>
#include <string.h>

#define STEEPEST_COS 0.5   /* ground of more than 60 deg is a mistake; plane_fit's rule */

static bool read_points(const struct reading *r, const struct yaml_node *node)
{
    struct vec3 *points = calloc(node->count, sizeof *points);
    if (!points) return out_of_memory(r);
    for (size_t i = 0; i < node->count; i++) {
        double p[3];
        schema_numbers(p, 3, node->items[i]);
        points[i] = vec3(p[0], p[1], p[2]);
    }
    double rms_m;
    struct error why = ERROR_NONE;
    bool fits = plane_fit(&r->scene->ground, &rms_m, points, node->count, &why);
    free(points);
    return fits || FAIL(r, node, "ground.points_m: %s", why.text);
}

bool scene_read_static(const struct reading *r, const struct yaml_node *root)
{
    struct scene *scene = r->scene;
    const struct yaml_node *node = yaml_get(root, "static");
    if (!node) return true;
    const struct yaml_node *at = yaml_get(node, "world_from_mesh"), *quaternion = yaml_get(at, "quaternion_wxyz");
    double q[4], t[3];
    schema_numbers(q, 4, quaternion);
    schema_numbers(t, 3, yaml_get(at, "translation_m"));
    double norm = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (fabs(norm - 1) > 0.01)
        return FAIL(r, quaternion, "static.world_from_mesh.quaternion_wxyz: has norm %.6g, a rotation has 1", norm);
    scene->static_.source = source_of(node);
    scene->static_.detail_m = number_at(node, "detail_m");
    scene->static_.world_from_mesh =
        (struct similarity){ number_at(at, "scale"), mat3_from_quat((struct quat){ q[0], q[1], q[2], q[3] }), vec3(t[0], t[1], t[2]) };
    return scene_copy_path(r, &scene->static_.mesh, yaml_get(node, "mesh"));
}

#define WET_ALBEDO_MIN 0.005

bool scene_read_ground(const struct reading *r, const struct yaml_node *node)
{
    struct scene *scene = r->scene;
    static const char *const of_wet[] = { "roughness", NULL };
    const struct yaml_node *plane = yaml_get(node, "plane"), *points = yaml_get(node, "points_m");
    scene_read_color(scene->ground_albedo, yaml_get(node, "albedo"));
    scene->wet = (struct wet){ number_at(node, "reflection"), number_at(node, "roughness") };
    if (scene->static_.mesh) {
        const struct yaml_node *other = points ? points : plane ? plane : yaml_get(node, "height_m");
        if (other) return FAIL(r, other, "ground: the static mesh is the ground: only albedo has a meaning here");
        if (scene->wet.reflection > 0)
            return FAIL(r, yaml_get(node, "reflection"), "ground.reflection: goes with a plane, not with a static mesh");
        if (!scene_refuse_given(r, node, of_wet, "ground", "goes with a reflection")) return false;
        scene->ground = (struct plane){ vec3(0, 0, 1), 0 };
        return true;
    }
    if (scene->wet.reflection <= 0 && !scene_refuse_given(r, node, of_wet, "ground", "goes with a reflection")) return false;
    if (scene->wet.reflection > 0 && luminance_of(scene->ground_albedo) < WET_ALBEDO_MIN)
        return FAIL(r, yaml_get(node, "albedo"), "ground.albedo: wet ground needs some light of its own: the darkest asphalt has 0.02");
    if (points) return read_points(r, points);
    if (!plane && !yaml_get(node, "height_m"))
        return FAIL(r, node, "ground: one of height_m, plane, points_m is missing (or a static mesh is)");
    double p[4] = { 0, 0, 1, 0 };
    if (plane)
        schema_numbers(p, 4, plane);
    else
        p[3] = number_at(node, "height_m");
    struct vec3 normal = vec3(p[0], p[1], p[2]);
    double norm = vec3_norm(normal);
    if (!(norm > 0)) return FAIL(r, plane, "ground.plane: the normal [nx, ny, nz] has no direction");
    if (normal.z < 0) norm = -norm; /* the same plane, its normal upward */
    if (normal.z / norm < STEEPEST_COS)
        return FAIL(r, plane, "ground.plane: steeper than 60 degrees; z is up, level ground is [0, 0, 1, height]");
    scene->ground = (struct plane){ vec3_scale(normal, 1 / norm), p[3] / norm };
    return true;
}

static int by_azimuth(const void *a, const void *b)
{
    const double *p = a, *q = b;
    return (p[0] > q[0]) - (p[0] < q[0]);
}

#define SKYLINE_MAX_DEG 80
/* One elevation for all sides, or [azimuth, elevation] each. */
static bool read_skyline(const struct reading *r, const struct yaml_node *node)
{
    struct scene_skyline *skyline = &r->scene->skyline;
    size_t n = node->kind == YAML_SEQUENCE ? node->count : 1;
    skyline->point_rad = calloc(n, sizeof *skyline->point_rad);
    if (!skyline->point_rad) return out_of_memory(r);
    for (size_t i = 0; i < n; i++) {
        const struct yaml_node *item = node->kind == YAML_SEQUENCE ? node->items[i] : node;
        double deg[2] = { 0, 0 };
        if (item == node) deg[1] = schema_number(node);
        else schema_numbers(deg, 2, item);
        if (!(deg[1] >= 0 && deg[1] <= SKYLINE_MAX_DEG))
            return FAIL(r, item, "surroundings.skyline_deg: an elevation of %g: it is from 0 to %d", deg[1], SKYLINE_MAX_DEG);
        if (!(fabs(deg[0]) <= 360)) return FAIL(r, item, "surroundings.skyline_deg: an azimuth of %g: it is from -360 to 360, and the order [azimuth, elevation]", deg[0]);
        skyline->point_rad[i][0] = rad_from_deg(fmod(deg[0] + 720, 360));
        skyline->point_rad[i][1] = rad_from_deg(deg[1]);
        if (deg[1] > 0) skyline->count = n;
    }
    qsort(skyline->point_rad, n, sizeof *skyline->point_rad, by_azimuth);
    for (size_t i = 1; i < n; i++)
        if (!(skyline->point_rad[i - 1][0] < skyline->point_rad[i][0]))
            return FAIL(r, node, "surroundings.skyline_deg: azimuth %g comes twice", skyline->point_rad[i][0] * 180 / M_PI);
    return true;
}

bool scene_read_surroundings(const struct reading *r, const struct yaml_node *node)
{
    static const char *const all[] = { "skyline_deg", "albedo", NULL };
    struct scene *scene = r->scene;
    const struct yaml_node *skyline = yaml_get(node, "skyline_deg");
    if (scene->static_.mesh) return scene_refuse_given(r, node, all, "surroundings", "the static mesh tells what stands around");
    if (scene->sky == SKY_MAP) return scene_refuse_given(r, node, all, "surroundings", "the sky's map shows what stands around");
    scene->skyline.source = source_of(skyline);
    scene->skyline.assumed = skyline->is_default;
    scene_read_color(scene->skyline.albedo, yaml_get(node, "albedo"));
    return read_skyline(r, skyline);
}

bool scene_read_exposure(const struct reading *r, const struct yaml_node *node)
{
    struct scene *scene = r->scene;
    if (!node && scene->sky != SKY_AUTO)
        return FAIL(r, r->root, "exposure: is missing: {patch_px}, {roads: true}, {value}, or auto");
    if (!node || node->kind != YAML_MAPPING) {
        scene->exposure_source = node ? source_of(node) : scene->light_source;
        scene->exposure_of_ground = scene->white_balance = true;
        return true;
    }
    const struct yaml_node *value = yaml_get(node, "value"), *patch = yaml_get(node, "patch_px");
    const struct yaml_node *balance = yaml_get(node, "white_balance"), *roads = yaml_get(node, "roads");
    scene->exposure_source = source_of(patch ? patch : value ? value : roads);
    yaml_boolean(&scene->white_balance, balance);
    scene->exposure_given = value != NULL;
    if (value) {
        if (!balance->is_default)
            return FAIL(r, balance, "exposure.white_balance: is fitted to a patch: it has no meaning with value");
        scene_read_color(scene->exposure, value);
        scene->white_balance = false;
        return true;
    }
    if (roads) {
        yaml_boolean(&scene->exposure_of_roads, roads);
        if (!scene->exposure_of_roads) return FAIL(r, roads, "exposure.roads: only true has a meaning: else give patch_px or value");
        if (!scene->osm && !scene->path_count) return FAIL(r, roads, "exposure.roads: there are no roads and no paths");
        return true;
    }
    double p[4];
    schema_numbers(p, 4, patch);
    if (!scene->fixed_camera && scene->shot_count > 1)
        return FAIL(r, patch, "exposure.patch_px: one patch does not lie in every shot: use \"roads: true\" or value");
    const struct camera *camera = &scene->cameras[scene->shots[0].camera].camera;
    if (!(p[0] < p[2] && p[1] < p[3]))
        return FAIL(r, patch, "exposure.patch_px: empty: the order is [left, top, right, bottom]");
    if (p[2] > camera->width_px || p[3] > camera->height_px)
        return scene_shape_fits(r, 0) && FAIL(r, patch, "exposure.patch_px: reaches out of the picture of %dx%d px (camera.size_px)",
                                              camera->width_px, camera->height_px);
    scene->exposure_patch_px[0] = (struct vec2){ p[0], p[1] };
    scene->exposure_patch_px[1] = (struct vec2){ p[2], p[3] };
    return true;
}

