#include "gen/run_json.h"

#include "lib/file.h"

#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define DEG (180 / M_PI)

void run_ground_radiance(double rgb[3], const struct run_facts *facts)
{
    for (int c = 0; c < 3; c++) rgb[c] = facts->scene->ground_albedo[c] * facts->light->irradiance[c];
}

/* The frames of this run and, of those that run.json names already, what the scene still has and the same input made. */
static json_t *list_frames(const struct run_facts *facts, const struct frame_result *frames, size_t n, const json_t *before,
                           const char *input, size_t *others)
{
    const char *input_before = json_string_value(json_object_get(before, "input_hash"));
    const json_t *names_before = json_object_get(before, "frames");
    bool same = input_before && !strcmp(input_before, input);
    json_t *names = json_array();
    *others = json_array_size(names_before);
    for (size_t k = 0; k < facts->scene->shot_count; k++) {
        char name[FRAME_NAME_SIZE];
        bool made = false, was = false;
        frame_name(name, &facts->scene->shots[k]);
        for (size_t i = 0; i < n; i++) made = made || !strcmp(frames[i].name, name);
        for (size_t i = 0; i < json_array_size(names_before); i++) {
            const char *other = json_string_value(json_array_get(names_before, i));
            was = was || (other && !strcmp(other, name));
        }
        if (made || (was && same)) json_array_append_new(names, json_string(name));
        if (was && (made || same)) --*others;
    }
    return names;
}

static void add_sun(json_t *run, const struct run_facts *facts)
{
    struct vec3 d = facts->light->sun_direction;
    double azimuth_rad = atan2(d.x, d.y) + facts->scene->north_rad;
    json_object_set_new(run, "sun_direction", json_pack("[fff]", d.x, d.y, d.z));
    json_object_set_new(run, "sun_elevation_deg", json_real(asin(d.z) * DEG));
    json_object_set_new(run, "sun_azimuth_deg", json_real(fmod(azimuth_rad * DEG + 720, 360)));
}

static void add_north(json_t *run, const struct scene *s)
{
    json_object_set_new(run, "north", json_pack("{s:f, s:f, s:f}", "north_deg", fmod(s->north_rad * DEG + 720, 360), "shadow_m",
                                                s->north_shadow_m, "height_m", s->north_height_m));
}

static void add_estimate(json_t *run, const struct run_facts *facts)
{
    double radiance[3];
    run_ground_radiance(radiance, facts);
    json_object_set_new(run, "light", light_estimate_json(facts->estimate, radiance));
}

bool run_json_write(size_t *others, const char *path, const struct run_facts *facts, const struct frame_result *frames, size_t n,
                    struct error *err)
{
    static const char *const qualities[] = { "draft", "standard", "high" };
    const struct scene *s = facts->scene;
    const double *irradiance = facts->light->irradiance;
    char hash[17], input[17];
    snprintf(hash, sizeof hash, "%016llx", (unsigned long long)s->hash);
    snprintf(input, sizeof input, "%016llx", (unsigned long long)facts->input_hash);
    json_t *before = json_load_file(path, 0, NULL), *names = list_frames(facts, frames, n, before, input, others);
    json_decref(before);
    json_t *run = json_pack("{s:s, s:s, s:s, s:s, s:s, s:i, s:[fff], s:o}", "version", PACKAGE_VERSION, "scene", s->path,
                            "scene_hash", hash, "input_hash", input, "quality", qualities[s->quality], "seed", s->seed,
                            "ground_irradiance_over_pi", irradiance[0], irradiance[1], irradiance[2], "frames", names);
    if (run && facts->light->has_sun) add_sun(run, facts);
    if (run && s->north_shadow_m > 0) add_north(run, s);
    if (run && facts->estimate) add_estimate(run, facts);
    char *text = run ? json_dumps(run, JSON_INDENT(2) | JSON_REAL_PRECISION(9)) : NULL;
    bool ok = text ? file_write_if_changed(path, text, strlen(text), err) : error_set(err, ERR_MEMORY, "no memory for run.json");
    free(text);
    json_decref(run);
    return ok;
}
