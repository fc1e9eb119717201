#include "gen/render/passes.h"

#include "gen/light/sky_image.h"
#include "gen/render/camera_sdl.h"
#include "gen/render/sdl.h"
#include "lib/file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct pass_settings pass_settings(enum quality quality, const struct light *light)
{
    /* Where most of the light is the sun's it makes the shadow, with edges, and the sky fills it: points of the
     * sky do. Where the sky makes most of it points would show as steps, and areas of the sky are dear; what they
     * make is smooth, and needs few pixels unless the sun shows as well. */
    bool sun = light->has_sun;
    double level[3] = { light->sun_color[0] * light->sun_direction.z, light->sun_color[1] * light->sun_direction.z,
                        light->sun_color[2] * light->sun_direction.z };
    bool soft = !sun || luminance_of(level) < 0.5;
    /* +R1 looks at the corners of a pixel only, and blurs by 0.5 px: too much for outlines, not for shadows. */
    const char *outlines = "+A0.2 +AM2 +R2 -J", *edges = "+A0.03 +AM2 +R1 -J", *fine = "+A0.03 +AM2 +R2 -J", *none = "-A";
    switch (quality) {
    case QUALITY_DRAFT:
        return (struct pass_settings){ 10, false, 30, 0.9, sun ? 1 : 2, none, none };
    case QUALITY_HIGH:
        return (struct pass_settings){ 48, soft, 200, 0.4, 1, fine, sun ? fine : none };
    case QUALITY_STANDARD:
    default:
        return (struct pass_settings){ soft ? 24 : 16, soft, 40, 0.8, sun ? 1 : 2, outlines, sun ? edges : none };
    }
}

/* --- passes --- */

bool sky_map_write(char path[SKY_MAP_SIZE], const char *out_folder, const struct light *light, struct error *err)
{
    uint64_t hash = hash_bytes(FILE_HASH_SEED, light->sky.data, image_size(&light->sky));
    snprintf(path, SKY_MAP_SIZE, "frames/sky_%016llx.exr", (unsigned long long)hash);
    char *file = string_format("%s/%s", out_folder, path), *folder = string_format("%s/frames", out_folder);
    bool ok = file && folder && folder_make(folder, err) && (file_exists(file) || image_write(file, &light->sky, err));
    free(folder);
    free(file);
    return ok;
}

bool pass_lights(struct vec3 **towards, size_t *n, const struct scene *scene, const struct light *light, struct error *err)
{
    struct pass_settings settings = pass_settings(scene->quality, light);
    size_t count = settings.sky_lights * (settings.soft_sky_lights ? 8 : 1);
    struct sky_light *sky = calloc(count, sizeof *sky);
    struct vec3 *directions = calloc(count + 1, sizeof *directions);
    bool ok = (sky && directions) || error_set(err, ERR_MEMORY, "no memory for the sky's lights");
    if (ok) {
        light_sample_sky(sky, count, light);
        for (size_t i = 0; i < count; i++) directions[i] = sky[i].direction;
        if (light->has_sun) directions[count++] = light->sun_direction;
        *towards = directions;
        *n = count;
    } else
        free(directions);
    free(sky);
    return ok;
}

/* How the sky lights a pass: by radiosity; by lights, with or without something in their way. */
enum lights { LIGHTS_RADIOSITY, LIGHTS_OPEN, LIGHTS_SHADED };

/* What lights give a plane, as one light above it. */
static struct sky_light light_of_plane(const struct sky_light *lights, size_t n, struct vec3 normal)
{
    struct sky_light sum = { .direction = normal };
    for (size_t i = 0; i < n; i++)
        for (int c = 0; c < 3; c++) sum.color[c] += lights[i].color[c] * fmax(0, vec3_dot(lights[i].direction, normal));
    return sum;
}

static void write_light(struct sdl *sdl, const struct passes *p, const struct pass_settings *settings, enum lights lights)
{
    const struct light *light = p->light;
    if (light->has_sun) {
        sdl_declare_vector(sdl, "Sun_Direction", light->sun_direction);
        sdl_declare_color(sdl, "Sun_Color", light->sun_color);
        sdl_declare_number(sdl, "Sun_Tangent", tan(SUN_RADIUS_RAD));
        sdl_include(sdl, "sun.inc");
    }
    const struct pass_surroundings *around = lights == LIGHTS_RADIOSITY ? p->surroundings : NULL;
    sdl_declare_string(sdl, "Sky_Map", around && around->sky_map[0] ? around->sky_map : p->sky_map);
    if (around && around->sky_map[0]) sdl_declare_string(sdl, "Mirrored_Sky_Map", around->mirrored_sky_map);
    if (lights == LIGHTS_RADIOSITY || p->scene->ground_reflection > 0) sdl_include(sdl, "sky.inc");
    if (lights == LIGHTS_RADIOSITY) return;
    size_t n = settings->sky_lights;
    struct sky_light *sky = calloc(n, sizeof *sky);
    if (!sky) {
        error_set(&sdl->err, ERR_MEMORY, "no memory for the sky's lights");
        return;
    }
    light_sample_sky(sky, n, light);
    if (lights == LIGHTS_OPEN) { /* with nothing to shade the plane, one light gives what all of them give */
        sky[0] = light_of_plane(sky, n, p->ground.normal);
        n = 1;
    }
    /* Each light's share of the hemisphere as a cone: 2 pi (1 - cos r) = 2 pi / n. */
    double radius = acos(1 - 1.0 / (double)n);
    sdl_declare_number(sdl, "Sky_Light_Soft", settings->soft_sky_lights && n > 1 ? tan(radius) : 0);
    sdl_include(sdl, "sky_lights.inc");
    for (size_t i = 0; i < n; i++) {
        const struct sky_light *s = &sky[i];
        sdl_call(sdl, "Sky_Light",
                 (double[]){ s->direction.x, s->direction.y, s->direction.z, s->color[0], s->color[1], s->color[2] }, 6);
    }
    free(sky);
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

static void write_receivers(struct sdl *sdl, const struct passes *p)
{
    sdl_declare(sdl, "Receivers");
    sdl_begin(sdl, "union");
    for (size_t i = 0; i < p->receiver_count; i++) {
        const struct receiver *r = &p->receivers[i];
        sdl_begin(sdl, "mesh2");
        sdl_begin(sdl, "vertex_vectors");
        sdl_number(sdl, (double)r->corners);
        for (size_t k = 0; k < r->corners; k++) {
            sdl_comma(sdl);
            sdl_vector(sdl, r->corner_m[k]);
        }
        sdl_end(sdl);
        sdl_begin(sdl, "face_indices");
        sdl_number(sdl, (double)r->corners - 2);
        for (size_t k = 2; k < r->corners; k++) {
            sdl_comma(sdl);
            sdl_vector(sdl, vec3(0, (double)k - 1, (double)k));
        }
        sdl_end(sdl);
        sdl_end(sdl);
    }
    sdl_end(sdl);
}

/* What receives in the plane and shadow passes. */
static void write_ground(struct sdl *sdl, const struct passes *p, bool receivers)
{
    const struct scene *scene = p->scene;
    const struct pass_surroundings *around = receivers ? NULL : p->surroundings;
    sdl_declare_color(sdl, "Ground_Albedo", around ? around->ground_albedo : scene->ground_albedo);
    sdl_declare_number(sdl, "Ground_Reflection", scene->ground_reflection);
    sdl_include(sdl, "ground.inc");
    sdl_declare_number(sdl, "Has_Place", p->place_include != NULL);
    if (p->place_include) sdl_include(sdl, p->place_include);
    else if (receivers) write_receivers(sdl, p);
    if (receivers) return;
    sdl_declare_vector(sdl, "Ground_Normal", p->ground.normal);
    sdl_declare_number(sdl, "Ground_Offset", p->ground.offset_m);
    double sky[3];
    light_sky_irradiance(sky, p->light, p->ground.normal);
    sdl_declare_color(sdl, "Ground_Sky", sky);
    sdl_declare_number(sdl, "Fill", scene->fill);
    sdl_declare_color(sdl, "Open_Light", p->light->irradiance);
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
    struct pass_settings settings = pass_settings(scene->quality, p->light);
    struct sdl sdl;
    sdl_init(&sdl);
    sdl_header(&sdl, "a pass of a frame: POV-Ray runs in the output folder, templates on its library path");
    sdl_declare_number(&sdl, "Radiosity", receivers ? 0 : 1);
    sdl_declare_number(&sdl, "Radiosity_Count", settings.radiosity_count);
    sdl_declare_number(&sdl, "Radiosity_Error", settings.radiosity_error);
    sdl_include(&sdl, "settings.inc");
    struct view view = view_reduced(&p->view, receivers ? settings.receiver_reduction : 1);
    camera_write(&sdl, &view, p->world_from_camera);
    /* Where the place shades itself, the plane pass has to know it as well. */
    bool shaded = entities || p->place_include;
    write_light(&sdl, p, &settings, !receivers ? LIGHTS_RADIOSITY : shaded ? LIGHTS_SHADED : LIGHTS_OPEN);
    write_ground(&sdl, p, receivers);
    if (entities) write_entities(&sdl, p, receivers && scene->ground_reflection <= 0);
    char *include = string_format("pass_%s.inc", name), *path = string_format("%s/%s.pov", frame_folder, name);
    bool ok = include && path;
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
