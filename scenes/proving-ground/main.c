/* proving-ground: what `prove` needs done between the renders. */
#include "compare.h"
#include "develop.h"
#include "influence.h"
#include "map_flight.h"
#include "picture.h"
#include "pinhole.h"
#include "place_heights.h"
#include "reconstruct.h"
#include "write_pov.h"
#include "write_scene.h"

#include "lib/file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char usage[] =
    "usage: proving-ground cases\n"
    "       proving-ground scene CASE known|fitted|auto|light METHOD MODELS FILE\n"
    "       proving-ground pov CASE SHOT KIND FILE    prints width, height, extension\n"
    "       proving-ground develop CASE SHOT FOLDER         radiance to photograph and truth\n"
    "       proving-ground reconstruct CASE FOLDER\n"
    "       proving-ground compare CASE SHOT FOLDER OUT METHOD\n"
    "       proving-ground picture FOLDER SHOT METHOD X0,Y0,X1,Y1 FILE    result, truth, difference\n"
    "       proving-ground table FILE ...\n"
    "PROVING_WIDTH (960) and PROVING_FINENESS (1.4, pinhole pixels to one of the photograph) set the size,\n"
    "PROVING_SHOTS how many of a flight there are at most.\n";

static double setting(const char *name, double otherwise)
{
    const char *value = getenv(name);
    return value && *value ? strtod(value, NULL) : otherwise;
}

static struct camera camera_of(const struct proving_case *c)
{
    int width = (int)setting("PROVING_WIDTH", c->camera.width_px);
    return camera_scaled(&c->camera, width, width * c->camera.height_px / c->camera.width_px);
}
static double fineness(void) { return setting("PROVING_FINENESS", 1.4); }

static size_t shots_of(const struct proving_case *c)
{
    double most = setting("PROVING_SHOTS", (double)c->shot_count);
    return most >= 1 && most < (double)c->shot_count ? (size_t)most : c->shot_count;
}

static bool find_case(const struct proving_case **c, const char *name, struct error *err)
{
    static struct proving_case found;
    const struct proving_case *all = proving_case(name);
    if (!all) return error_set(err, ERR_INPUT, "no case is called \"%s\"", name);
    found = *all;
    found.shot_count = shots_of(all);
    *c = &found;
    return true;
}

static int list_cases(void)
{
    for (size_t i = 0; i < proving_case_count; i++)
        printf("%s %zu %zu %d\n", proving_cases[i].name, shots_of(&proving_cases[i]), proving_entity_count(&proving_cases[i]),
               proving_cases[i].has_mesh);
    return 0;
}

static bool pov(char **a, struct error *err)
{
    const struct proving_case *c;
    if (!find_case(&c, a[0], err)) return false;
    struct camera camera = camera_of(c);
    struct pov_job job;
    if (!write_pov(&job, a[3], a[2], c, strtoul(a[1], NULL, 10), &camera, fineness(), err)) return false;
    printf("%d %d %s\n", job.width_px, job.height_px, job.is_png ? "png" : "exr");
    return true;
}

static bool read_part(struct image *image, const char *folder, const char *shot, const char *name, struct error *err)
{
    char *path = string_format("%s/%s-%s", folder, shot, name);
    bool ok = path ? image_read(image, path, err) : error_set(err, ERR_MEMORY, "no memory for a path");
    free(path);
    return ok;
}

static bool write_part(const char *folder, const char *name, const char *shot, const char *extension, const struct image *image,
                       struct error *err)
{
    char *path = string_format("%s/%s-%s%s", folder, name, shot, extension);
    bool ok = path ? image_write(path, image, err) : error_set(err, ERR_MEMORY, "no memory for a path");
    free(path);
    return ok;
}

static bool develop(char **a, struct error *err)
{
    const struct proving_case *c;
    if (!find_case(&c, a[0], err)) return false;
    const char *shot = a[1], *folder = a[2];
    struct camera camera = camera_of(c);
    struct pinhole pinhole;
    struct image radiance[2] = { 0 }, range[2] = { 0 }, linear[2] = { 0 }, developed[2] = { 0 };
    const char *photographed = c->photographed_as ? c->photographed_as : c->name;
    uint64_t key = hash_bytes(hash_bytes(FILE_HASH_SEED, photographed, strlen(photographed)), shot, strlen(shot));
    bool ok = pinhole_cover(&pinhole, &camera, fineness(), err) &&
              read_part(&radiance[0], folder, shot, "photograph.exr", err) && read_part(&radiance[1], folder, shot, "truth.exr", err) &&
              read_part(&range[0], folder, shot, "range.png", err) && read_part(&range[1], folder, shot, "truth-range.png", err) &&
              influence_limit(&radiance[1], &radiance[0], &range[1], &pinhole, c, strtoul(shot, NULL, 10), err);
    for (int i = 0; ok && i < 2; i++) {
        const char *name = i ? "truth" : "photograph";
        ok = develop_light(&linear[i], &radiance[i], &range[i], &pinhole, &camera, c, err) &&
             develop_sensor(&developed[i], &linear[i], key, err) && write_part(folder, name, shot, ".exr", &linear[i], err) &&
             write_part(folder, name, shot, ".jpg", &developed[i], err);
    }
    for (int i = 0; i < 2; i++) {
        image_release(&radiance[i]);
        image_release(&range[i]);
        image_release(&linear[i]);
        image_release(&developed[i]);
    }
    return ok;
}

static bool read_photographs(struct image *photographs, const char *folder, const struct proving_case *c, struct error *err)
{
    bool ok = true;
    for (size_t i = 0; ok && i < c->shot_count; i++) {
        char *path = string_format("%s/photograph-%zu.jpg", folder, i);
        ok = path ? image_read(&photographs[i], path, err) : error_set(err, ERR_MEMORY, "no memory for a path");
        free(path);
    }
    return ok;
}

static bool read_kind(struct image *image, const char *folder, const char *kind, const char *extension, struct error *err)
{
    char *name = string_format("%s.%s", kind, extension);
    bool ok = name ? read_part(image, folder, "0", name, err) : error_set(err, ERR_MEMORY, "no memory for a path");
    free(name);
    return ok;
}

static bool read_map(struct image *map, const char *folder, struct error *err)
{
    bool ok = true;
    for (int i = 0; ok && i < PROVING_MAP_VIEWS; i++) ok = read_kind(&map[i], folder, map_view(i).kind, "exr", err);
    return ok;
}

static bool read_heights(struct image *heights, const char *folder, struct error *err)
{
    bool ok = true;
    for (int i = 0; ok && i < HEIGHTS_KINDS; i++) ok = read_kind(&heights[i], folder, place_heights_kinds[i], "png", err);
    return ok;
}

static bool reconstruct_place(char **a, struct error *err)
{
    const struct proving_case *c;
    if (!find_case(&c, a[0], err)) return false;
    if (!c->has_mesh) return error_set(err, ERR_INPUT, "%s has no mesh", c->name);
    struct camera camera = camera_of(c);
    struct image heights[HEIGHTS_KINDS] = { 0 }, map[PROVING_MAP_VIEWS] = { 0 }, *photographs = calloc(c->shot_count, sizeof *photographs);
    char *path = string_format("%s/place.ply", a[1]);
    bool ok = (photographs && path) || error_set(err, ERR_MEMORY, "no memory for the reconstruction");
    ok = ok && read_heights(heights, a[1], err) && read_map(map, a[1], err) &&
         (!c->flies || read_photographs(photographs, a[1], c, err)) &&
         reconstruct(path, heights, map, c->flies ? photographs : NULL, c, &camera, err);
    free(path);
    for (size_t i = 0; photographs && i < c->shot_count; i++) image_release(&photographs[i]);
    for (int i = 0; i < PROVING_MAP_VIEWS; i++) image_release(&map[i]);
    free(photographs);
    for (int i = 0; i < HEIGHTS_KINDS; i++) image_release(&heights[i]);
    return ok;
}

static bool compare_shot(char **a, struct error *err)
{
    const struct proving_case *c;
    if (!find_case(&c, a[0], err)) return false;
    struct camera camera = camera_of(c);
    struct comparison_files files = { .folder = a[2], .out = a[3], .shot = strtoul(a[1], NULL, 10),
                                      .plain = !strcmp(a[4], "layers") || !strcmp(a[4], "fitted") || !strcmp(a[4], "auto") };
    struct comparison result;
    if (!compare(&result, &files, c, &camera, err)) return false;
    comparison_print(stdout, c->name, files.shot, a[4], &result);
    return true;
}

static bool picture(char **a, struct error *err)
{
    struct image result = { 0 }, truth = { 0 }, beside = { 0 };
    struct rect part;
    char *ours = string_format("%s/%s-%s.png", a[0], a[2], a[1]), *other = string_format("%s/truth-%s.jpg", a[0], a[1]);
    bool ok = (sscanf(a[3], "%d,%d,%d,%d", &part.x0, &part.y0, &part.x1, &part.y1) == 4 ||
               error_set(err, ERR_INPUT, "\"%s\" is no part of a picture: X0,Y0,X1,Y1", a[3])) &&
              ours && other && image_read(&result, ours, err) && image_read(&truth, other, err) &&
              picture_beside(&beside, &result, &truth, part, err) && image_write(a[4], &beside, err);
    image_release(&result);
    image_release(&truth);
    image_release(&beside);
    free(ours);
    free(other);
    return ok;
}

static bool scene(char **a, struct error *err)
{
    const struct proving_case *c;
    if (!find_case(&c, a[0], err)) return false;
    struct camera camera = camera_of(c);
    return write_scene(a[4], c, a[1], a[2], &camera, a[3], err);
}

static const struct command { const char *name; int arguments; bool (*run)(char **, struct error *); } commands[] = {
    { "scene", 5, scene }, { "pov", 4, pov }, { "develop", 3, develop }, { "reconstruct", 2, reconstruct_place },
    { "compare", 5, compare_shot }, { "picture", 5, picture },
};

int main(int argc, char **argv)
{
    if (argc == 2 && !strcmp(argv[1], "cases")) return list_cases();
    if (argc > 2 && !strcmp(argv[1], "table")) {
        struct error err = ERROR_NONE;
        if (comparison_table(stdout, (const char *const *)argv + 2, (size_t)argc - 2, &err)) return 0;
        error_print(&err, "proving-ground");
        return error_exit_status(&err);
    }
    for (size_t i = 0; argc > 1 && i < sizeof commands / sizeof *commands; i++) {
        if (strcmp(argv[1], commands[i].name) || argc - 2 != commands[i].arguments) continue;
        struct error err = ERROR_NONE;
        if (commands[i].run(argv + 2, &err)) return 0;
        error_print(&err, "proving-ground");
        return error_exit_status(&err);
    }
    fputs(usage, stderr);
    return 2;
}
