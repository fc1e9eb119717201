#include "gen/render/passes.h"

#include "gen/render/camera_sdl.h"
#include "gen/render/mesh_sdl.h"
#include "gen/render/sdl.h"
#include "gen/render/shade_sdl.h"
#include "gen/render/sky_uv.h"
#include "lib/file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct pass_settings pass_settings(enum quality quality)
{
    /* +R1 looks at the corners of a pixel only, and blurs by 0.5 px: too much for outlines, not for shadows. */
    const char *outlines = "+A0.1 +AM2 +R3 -J";
    const char *edges = "+A0.03 +AM2 +R1 -J", *fine_edges = "+A0.03 +AM2 +R2 -J", *none = "-A";
    switch (quality) {
    case QUALITY_DRAFT: return (struct pass_settings){ 48, 4, 30, 0.5, 1, none, none };
    case QUALITY_HIGH: return (struct pass_settings){ 512, 1, 200, 0.2, 2, outlines, fine_edges };
    case QUALITY_STANDARD:
    default: return (struct pass_settings){ 128, 2, 50, 0.25, 1.5, outlines, edges };
    }
}

/* --- passes --- */

bool sky_map_write(char path[SKY_MAP_SIZE], const char *out_folder, const struct light *light, struct error *err)
{
    uint64_t hash = hash_bytes(FILE_HASH_SEED, light->sky.data, image_size(&light->sky));
    snprintf(path, SKY_MAP_SIZE, "frames/sky_%016llx.exr", (unsigned long long)hash);
    char *file = string_format("%s/%s", out_folder, path), *folder = string_format("%s/frames", out_folder);
    bool ok = ((file && folder) || error_set(err, ERR_MEMORY, "no memory for a path")) && folder_make(folder, err) &&
              (file_exists(file) || image_write(file, &light->sky, err));
    free(folder);
    free(file);
    return ok;
}

/* What rough ground mirrors is in the receivers' light. */
static bool is_mirror(const struct scene *scene)
{
    return scene->wet.reflection > 0 && scene->wet.roughness <= 0;
}

static void write_light(struct sdl *sdl, const struct passes *p, bool object)
{
    const struct light *light = p->light;
    if (light->has_sun) {
        sdl_declare_vector(sdl, "Sun_Direction", light->sun_direction);
        sdl_declare_color(sdl, "Sun_Color", light->sun_color);
        sdl_declare_number(sdl, "Sun_Tangent", tan(SUN_RADIUS_RAD));
        sdl_include(sdl, "sun.inc");
    }
    const struct pass_surroundings *around = object ? p->surroundings : NULL;
    sdl_declare_string(sdl, "Sky_Map", around && around->sky_map[0] ? around->sky_map : p->sky_map);
    if (around && around->sky_map[0]) sdl_declare_vector(sdl, "Seen_From", around->seen_from_m);
    if (around && around->relief_map[0]) sdl_declare_string(sdl, "Relief_Map", around->relief_map);
    if (around && around->relief_include[0]) sdl_include(sdl, around->relief_include);
    if (around && around->circle_radius_m > 0) {
        sdl_declare_vector(sdl, "Circle_Centre", around->circle_m);
        sdl_declare_number(sdl, "Circle_Radius", around->circle_radius_m);
    }
    if (object || is_mirror(p->scene)) sdl_include(sdl, "sky.inc");
}

static void write_shade(struct sdl *sdl, const struct passes *p)
{
    const struct pass_surroundings *around = p->surroundings;
    if (p->light->has_sun && around && around->sun_share.map.data)
        shade_sdl(sdl, &around->sun_share, around->sun_share_map, around->sun_through_map, p->light->sun_direction, p->entities, p->entity_count);
    sdl_declare_number(sdl, "Shade_Is_Told", p->light->has_sun && around && around->sun_share.through.data);
}

static void write_entities(struct sdl *sdl, const struct passes *p, bool shapes_only)
{
    sdl_include(sdl, "materials.inc");
    sdl_declare_number(sdl, "Shapes_Only", shapes_only);
    for (size_t i = 0; i < p->entity_count; i++) {
        bool seen = false;
        for (size_t k = 0; k < i && !seen; k++) seen = !strcmp(p->includes[i].name, p->includes[k].name);
        if (!seen) sdl_include(sdl, p->includes[i].path);
    }
    sdl_declare(sdl, "Entities");
    sdl_begin(sdl, "union");
    for (size_t i = 0; i < p->entity_count; i++) {
        sdl_begin(sdl, "object");
        sdl_word(sdl, p->includes[i].name);
        sdl_matrix(sdl, p->entities[i].world_from_entity);
        sdl_end(sdl);
    }
    sdl_end(sdl);
}

static void write_ground_mesh(struct sdl *sdl, const char *name, const struct shaded_ground *g, const struct sky_scale *scale,
                              const struct passes *p, bool entities)
{
    sdl_declare(sdl, name);
    if (!g->triangles) {
        mesh_sdl_nowhere(sdl);
        return;
    }
    sdl_begin(sdl, "mesh2");
    mesh_sdl_vectors(sdl, "vertex_vectors", g->position_m, g->vertices);
    if (p->place_include) mesh_sdl_vectors(sdl, "normal_vectors", g->normal, g->vertices);
    sdl_begin(sdl, "uv_vectors");
    sdl_number(sdl, (double)g->vertices);
    for (size_t i = 0; i < g->vertices; i++) {
        struct vec2 uv = sky_uv(scale, entities ? g->sky[i].with : g->sky[i].without);
        sdl_comma(sdl);
        sdl_vector2(sdl, uv.x, uv.y);
        if (i % 8 == 7) sdl_newline(sdl);
    }
    sdl_end(sdl);
    mesh_sdl_faces(sdl, g->triangle, g->triangles);
    sdl_end(sdl);
}

/* The receivers are the same triangles in both passes, but in one mesh or another, and the sky's light on them is one function of their uv. */
static bool write_receivers(struct sdl *sdl, const struct passes *p, bool entities, struct error *err)
{
    const struct shaded_ground *g = p->receivers;
    struct sky_scale scale = sky_scale(g, p->light);
    bool ok = true, *in_sun = calloc(g->triangles + 1, sizeof *in_sun);
    if (!in_sun) return error_set(err, ERR_MEMORY, "no memory for the ground");
    for (size_t i = 0; g->sunlit && i < g->triangles; i++) in_sun[i] = entities ? g->sunlit[i].with : g->sunlit[i].without;
    sdl_declare_color(sdl, "Sky_Most", scale.most);
    sdl_declare_color(sdl, "Sky_Tint", scale.tint);
    for (int sunlit = 0; ok && sunlit < 2; sunlit++) {
        struct shaded_ground part = { 0 };
        ok = shaded_ground_pick(&part, g, in_sun, sunlit, err);
        if (ok && (!sunlit || part.triangles)) write_ground_mesh(sdl, sunlit ? "Receivers_In_Sun" : "Receivers", &part, &scale, p, entities);
        shaded_ground_release(&part);
    }
    free(in_sun);
    return ok;
}

static void write_ground(struct sdl *sdl, const struct passes *p, bool object)
{
    const struct scene *scene = p->scene;
    const struct pass_surroundings *around = object ? p->surroundings : NULL;
    sdl_declare_color(sdl, "Ground_Albedo", around ? around->ground_albedo : scene->ground_albedo);
    sdl_declare_number(sdl, "Ground_Reflection", is_mirror(scene) ? scene->wet.reflection : 0);
    sdl_include(sdl, "ground.inc");
    sdl_declare_number(sdl, "Has_Place", p->place_include != NULL);
    if (p->shades_include) sdl_include(sdl, p->shades_include);
}

/* What stands in the photograph: it shines as it is seen there. */
static void write_standing(struct sdl *sdl, const struct pass_surroundings *around)
{
    sdl_declare_number(sdl, "Has_Standing", around && around->standing_count > 0);
    if (!around || !around->standing_count) return;
    sdl_declare(sdl, "Standing");
    sdl_begin(sdl, "union");
    for (size_t i = 0; i < around->standing_count; i++) {
        const struct standing *s = &around->standing[i].thing;
        sdl_begin(sdl, "polygon");
        sdl_number(sdl, (double)s->count + 1);
        for (size_t k = 0; k <= s->count; k++) {
            sdl_comma(sdl);
            sdl_vector2(sdl, s->outline[k % s->count].x, s->outline[k % s->count].y);
        }
        sdl_begin(sdl, "pigment");
        sdl_begin(sdl, "image_map");
        sdl_word(sdl, "exr");
        sdl_string(sdl, around->standing[i].radiance);
        sdl_word(sdl, "interpolate");
        sdl_number(sdl, 2);
        sdl_word(sdl, "once");
        sdl_end(sdl);
        sdl_end(sdl);
        sdl_begin(sdl, "finish");
        sdl_word(sdl, "emission");
        sdl_number(sdl, 1);
        sdl_word(sdl, "diffuse");
        sdl_number(sdl, 0);
        sdl_end(sdl);
        sdl_word(sdl, "scale");
        sdl_vector(sdl, vec3(s->size_m.x, s->size_m.y, 1));
        sdl_matrix(sdl, s->world_from_rectangle);
        sdl_end(sdl);
    }
    sdl_end(sdl);
}

/* What bounces onto the entities in the object pass. */
static void write_surroundings(struct sdl *sdl, const struct passes *p)
{
    const struct pass_surroundings *around = p->surroundings;
    double sky[3];
    if (p->place_include) sdl_include(sdl, p->place_include);
    sdl_declare_vector(sdl, "Ground_Normal", p->ground.normal);
    sdl_declare_number(sdl, "Ground_Offset", p->ground.offset_m);
    light_sky_irradiance(sky, p->light, p->ground.normal);
    sdl_declare_color(sdl, "Ground_Sky", sky);
    sdl_declare_number(sdl, "Fill", p->scene->fill);
    sdl_declare_color(sdl, "Open_Light", p->light->irradiance);
    write_standing(sdl, around);
    sdl_declare_number(sdl, "Has_Orthophoto", around != NULL);
    if (!around) return;
    sdl_declare_string(sdl, "Orthophoto", around->orthophoto);
    sdl_declare_string(sdl, "Orthophoto_Coarse", around->orthophoto_coarse);
    sdl_declare_vector(sdl, "Orthophoto_Low", vec3(around->low_m.x, around->low_m.y, 0));
    sdl_declare_vector(sdl, "Orthophoto_High", vec3(around->high_m.x, around->high_m.y, 1));
}

static bool write_pass(const char *frame_folder, const char *name, const struct passes *p, bool entities,
                       bool receivers, struct error *err)
{
    const struct scene *scene = p->scene;
    struct pass_settings settings = pass_settings(scene->quality);
    bool mirrors = is_mirror(scene);
    struct sdl sdl;
    sdl_init(&sdl);
    sdl_header(&sdl, "a pass of a frame: POV-Ray runs in the output folder, templates on its library path");
    sdl_declare_number(&sdl, "Radiosity", receivers ? 0 : 1);
    sdl_declare_number(&sdl, "Radiosity_Count", settings.radiosity_count);
    sdl_declare_number(&sdl, "Radiosity_Error", settings.radiosity_error);
    sdl_include(&sdl, "settings.inc");
    camera_write(&sdl, &p->view, p->world_from_camera);
    write_light(&sdl, p, !receivers);
    write_shade(&sdl, p);
    write_ground(&sdl, p, !receivers);
    bool ok = !receivers || write_receivers(&sdl, p, entities, err);
    if (!receivers) write_surroundings(&sdl, p);
    /* The sky's shade is known: entities shade from the sun, and are mirrored. */
    if (entities) {
        if (receivers) sdl_declare_number(&sdl, "Entities_Matter", p->light->has_sun || mirrors);
        if (!receivers || p->light->has_sun || mirrors) write_entities(&sdl, p, receivers && !mirrors);
    }
    char *include = string_format("pass_%s.inc", name), *path = string_format("%s/%s.pov", frame_folder, name);
    ok = ok && ((include && path) || error_set(err, ERR_MEMORY, "no memory for a path"));
    if (ok) {
        sdl_include(&sdl, include);
        ok = sdl_write(&sdl, path, err);
    }
    free(include);
    free(path);
    sdl_release(&sdl);
    return ok;
}

bool passes_write(const char *frame_folder, const struct passes *passes, struct error *err)
{
    return write_pass(frame_folder, "object", passes, true, false, err) &&
           write_pass(frame_folder, "plane", passes, false, true, err) &&
           write_pass(frame_folder, "shadow", passes, true, true, err);
}
