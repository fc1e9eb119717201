/* staffage-gen: options in, one call, an exit code out. */
#include "gen/generator.h"
#include "gen/light/light.h"
#include "gen/model/catalogue.h"
#include "gen/render/makefile.h"
#include "gen/render/passes.h"
#include "gen/scene/scene.h"
#include "lib/error.h"
#include "lib/file.h"

#include <getopt.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "Usage: staffage-gen SCENE.yaml -o OUT [option ...]\n"
    "Write the POV-Ray scenes, label layers and manifest of every frame of a scene.\n"
    "\n"
    "  -o, --output OUT      the output folder\n"
    "      --frames A:B      only frames A to B-1, by their number\n"
    "      --quality NAME    draft, standard or high: over the scene's own\n"
    "      --seed N          over the scene's own\n"
    "      --light           only say what the photographs tell of the light, whatever the scene says\n"
    "      --keys            print every key of a scene file: path, type, unit, default\n"
    "  -h, --help            this text\n"
    "  -V, --version         the version\n"
    "\n"
    "Frames that are there from the same input are left alone. `staffage run` does this\n"
    "and the rest. Exit status: 0 done, 1 wrong input, 2 wrong usage, 3 a bug of ours.\n";

struct options {
    const char *scene, *out;
    int first, end;  /* frames by number, end excluded */
    int quality;     /* -1: the scene's */
    bool has_seed, light;
    int seed;
};

static int usage(const char *what, const char *value)
{
    fprintf(stderr, "staffage-gen: %s%s%s (staffage-gen --help)\n", what, value ? ": " : "", value ? value : "");
    return 2;
}

static bool parse_int(int *value, const char *text, const char **end)
{
    char *stop;
    long v = strtol(text, &stop, 10);
    if (stop == text || v < 0 || v > INT_MAX) return false;
    *value = (int)v;
    *end = stop;
    return true;
}

static const char *data_folder(void)
{
    const char *given = getenv("STAFFAGE_DATADIR");
    return given && *given ? given : PKGDATADIR;
}

/* The light that the scene gives, to hold against what the photographs tell. */
static bool print_own_light(const struct scene *scene, struct error *err)
{
    struct light light;
    double sky[3];
    if (!light_create(&light, scene, err)) return false;
    light_sky_irradiance(sky, &light, vec3(0, 0, 1));
    printf("scene: in the open the sky gives R %.3f G %.3f B %.3f\n", sky[0] / light.irradiance[0], sky[1] / light.irradiance[1],
           sky[2] / light.irradiance[2]);
    light_release(&light);
    return true;
}

/* Have the light told by the photographs, in place of what the scene says. */
static bool ask_for_light(struct scene *scene, struct error *err)
{
    if (scene->sky == SKY_AUTO) return true;
    if (!print_own_light(scene, err)) return false;
    scene->sky = SKY_AUTO;
    if (scene->sun != SUN_GIVEN) scene->sun = scene->has_place && scene->has_time ? SUN_BY_TIME : SUN_NONE;
    return true;
}

/* The frames that the user asked for, and what came of each. */
struct run {
    struct generator *generator;
    size_t *chosen, n;
    struct frame_result *results;
    struct makefile_frame *entries;
    size_t done, kept, made, failed;
    struct error first;         /* what was wrong with the first that failed */
};

static void run_release(struct run *r)
{
    free(r->chosen);
    free(r->entries);
    free(r->results);
}

static bool choose_frames(struct run *r, struct generator *generator, const struct options *o, struct error *err)
{
    size_t count = generator_frame_count(generator);
    *r = (struct run){ .generator = generator, .first = ERROR_NONE };
    r->results = calloc(count + 1, sizeof *r->results);
    r->entries = calloc(count + 1, sizeof *r->entries);
    r->chosen = calloc(count + 1, sizeof *r->chosen);
    if (!r->results || !r->entries || !r->chosen) return error_set(err, ERR_MEMORY, "no memory for the frames");
    for (size_t i = 0; i < count; i++) {
        char name[FRAME_NAME_SIZE];
        generator_frame_name(name, generator, i);
        int number = atoi(name);
        if (number >= o->first && number < o->end) r->chosen[r->n++] = i;
    }
    return true;
}

/* Before the light is measured, which may take a minute. */
static bool check_range(const struct scene *scene, const struct options *o, struct error *err)
{
    int first = scene->shots[0].number, last = scene->shots[scene->shot_count - 1].number;
    for (size_t i = 0; i < scene->shot_count; i++)
        if (scene->shots[i].number >= o->first && scene->shots[i].number < o->end) return true;
    if (first == last) return error_set(err, ERR_INPUT, "--frames %d:%d: the scene has one frame, %d", o->first, o->end, first);
    return error_set(err, ERR_INPUT, "--frames %d:%d: the scene has %zu frames, from %d to %d, and none of them there", o->first, o->end,
                     scene->shot_count, first, last);
}

static struct makefile_frame makefile_entry(const struct frame_result *result, const struct pass_settings *settings)
{
    if (result->empty) return (struct makefile_frame){ .name = result->name, .empty = true };
    int width = result->view.width_px, height = result->view.height_px;
    return (struct makefile_frame){
        .name = result->name,
        .width_px = { width, width, width },
        .height_px = { height, height, height },
        .options = { settings->object_antialias, settings->receiver_antialias, settings->receiver_antialias },
    };
}

/* One bad photograph is no reason to leave the others. */
static void generate_each(struct run *r)
{
    struct pass_settings settings = generator_pass_settings(r->generator);
    for (size_t i = 0; i < r->n; i++) {
        struct frame_result *result = &r->results[r->done];
        struct error wrong = ERROR_NONE;
        if (!generator_frame(result, r->generator, r->chosen[i], &wrong)) {
            if (r->failed++) error_print(&wrong, "staffage-gen");
            else r->first = wrong;
            continue;
        }
        *(result->kept ? &r->kept : &r->made) += 1;
        r->entries[r->done++] = makefile_entry(result, &settings);
    }
}

/* Those from `first` on: the ones before were told already. */
static void tell_warnings(const struct generator *generator, size_t first)
{
    for (size_t i = first; i < generator_warning_count(generator); i++)
        fprintf(stderr, "staffage-gen: warning: %s\n", generator_warning(generator, i));
}

static bool generate_frames(struct generator *generator, const char *templates, const struct options *o, struct error *err)
{
    struct run r;
    size_t others = 0, told = generator_warning_count(generator);
    bool ok = choose_frames(&r, generator, o, err) && generator_prepare(generator, r.chosen, r.n, err);
    if (ok) generate_each(&r);
    ok = ok && (r.done == 0 || (generator_write_run(generator, r.results, r.done, &others, err) &&
                                makefile_write(o->out, templates, r.entries, r.done, err) &&
                                generator_warn_of_unseen(generator, r.results, r.done, err)));
    if (ok && r.done) printf("staffage: generated %zu frame%s, %zu unchanged\n", r.made, r.made == 1 ? "" : "s", r.kept);
    if (ok) tell_warnings(generator, told);
    if (ok && others)
        fprintf(stderr, "staffage-gen: warning: %s holds %zu frame%s of another seed, scene or version, which no longer count: "
                "take another folder (-o) to keep them apart\n", o->out, others, others == 1 ? "" : "s");
    if (ok && r.failed) {
        if (r.n > 1) fprintf(stderr, "staffage-gen: %zu of %zu frames could not be generated\n", r.failed, r.n);
        *err = r.first;
        ok = false;
    }
    run_release(&r);
    return ok;
}

static void tell_findings(const struct generator *generator)
{
    tell_warnings(generator, 0);
    char *light = generator_light_text(generator);
    if (light) fputs(light, stdout);
    free(light);
}

static bool generate(const struct options *o, struct error *err)
{
    struct scene *scene = NULL;
    struct generator *generator = NULL;
    struct catalogue_folders folders = { 0 };
    char *templates = string_format("%s/templates", data_folder());
    char *rules = string_format("%s/templates/materials.rules", data_folder());
    bool ok = catalogue_folders_init(&folders, PKGDATADIR, err) && scene_read(&scene, o->scene, folders.list, err);
    if (ok && o->quality >= 0) scene->quality = (enum quality)o->quality;
    if (ok && o->has_seed) scene->seed = o->seed;
    ok = ok && check_range(scene, o, err) && (!o->light || ask_for_light(scene, err)) && generator_create(&generator, scene, o->out, rules, err);
    if (ok) tell_findings(generator);
    ok = ok && (o->light || generate_frames(generator, templates, o, err));
    generator_destroy(generator);
    scene_destroy(scene);
    catalogue_folders_release(&folders);
    free(rules);
    free(templates);
    return ok;
}

int main(int argc, char **argv)
{
    enum { FRAMES = 256, QUALITY, SEED, KEYS, LIGHT };
    static const struct option longs[] = {
        { "output", required_argument, NULL, 'o' },  { "frames", required_argument, NULL, FRAMES },
        { "quality", required_argument, NULL, QUALITY }, { "seed", required_argument, NULL, SEED },
        { "keys", no_argument, NULL, KEYS },         { "light", no_argument, NULL, LIGHT },
        { "help", no_argument, NULL, 'h' },
        { "version", no_argument, NULL, 'V' },       { 0 },
    };
    static const char *const qualities[] = { "draft", "standard", "high" };
    struct options o = { .end = INT_MAX, .quality = -1 };
    const char *end;
    for (int c; (c = getopt_long(argc, argv, "o:hV", longs, NULL)) != -1;) switch (c) {
        case 'o': o.out = optarg; break;
        case FRAMES:
            if (!parse_int(&o.first, optarg, &end) || *end != ':' || !parse_int(&o.end, end + 1, &end) || *end)
                return usage("--frames takes A:B, two frame numbers", optarg);
            break;
        case QUALITY:
            for (int i = 0; i < 3; i++)
                if (!strcmp(optarg, qualities[i])) o.quality = i;
            if (o.quality < 0) return usage("--quality takes draft, standard or high", optarg);
            break;
        case SEED:
            if (!parse_int(&o.seed, optarg, &end) || *end) return usage("--seed takes a whole number from 0", optarg);
            o.has_seed = true;
            break;
        case LIGHT: o.light = true; break;
        case KEYS: {
            char *keys = scene_schema_text();
            if (!keys) return 3;
            fputs(keys, stdout);
            free(keys);
            return 0;
        }
        case 'h': fputs(help, stdout); return 0;
        case 'V': puts("staffage-gen " PACKAGE_VERSION); return 0;
        default: return 2;
        }
    if (optind + 1 != argc) return usage("one scene file is needed", NULL);
    if (!o.out) return usage("an output folder is needed: -o OUT", NULL);
    o.scene = argv[optind];

    struct error err = ERROR_NONE;
    if (!generate(&o, &err)) error_print(&err, "staffage-gen");
    return error_exit_status(&err);
}
