#include "catalogue/portrait.h"

#include "gen/scene/scene.h"
#include "lib/file.h"
#include "lib/image.h"

#include "catalogue/folder.h"

#include <errno.h>
#include <fcntl.h>
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#define APART_M 1000.0   /* sitters stand so far from each other that none shades or shows in another's picture */
#define VIEW_DEG 24.0    /* a long lens: sizes compare */
#define EXPOSURE 0.8
#define GROUND_ALBEDO 0.3

/* The sun stands behind the camera, to its left; the camera looks north, and the sitter turns. */
static const struct { double heading_deg, above_deg; } views[SIDE_COUNT] = {
    [SIDE_FRONT] = { 180, 10 }, [SIDE_LEFT] = { 270, 10 }, [SIDE_REAR] = { 0, 10 }, [SIDE_ABOVE] = { 222, 28 } };

/* --- the scene: JSON is YAML --- */

static json_t *model_of(const struct sitter *s)
{
    json_t *model = json_pack("{s:s, s:s}", "file", s->file, "class", class_info(s->options.class_)->name);
    if (s->options.unit_m > 0) json_object_set_new(model, "unit_m", json_real(s->options.unit_m));
    if (s->options.length_m > 0) json_object_set_new(model, "length_m", json_real(s->options.length_m));
    if (s->options.height_m > 0) json_object_set_new(model, "height_m", json_real(s->options.height_m));
    if (s->options.axes_given) {
        json_object_set_new(model, "up", json_string(axis_name(s->options.up)));
        json_object_set_new(model, "front", json_string(axis_name(s->options.front)));
    }
    return model;
}

static json_t *shot_of(const struct sitter *s, enum side side, double x)
{
    double length = s->size_m[0], width = s->size_m[1], height = s->size_m[2], above = views[side].above_deg * M_PI / 180;
    double facing = side == SIDE_LEFT ? length : side == SIDE_ABOVE ? 0.75 * length + 0.65 * width : width;
    double deep = side == SIDE_LEFT ? width : length;
    /* What is to fill the picture, 4 to 3, seen from above; and what of it stands nearer than the middle. */
    double half = fmax(facing / 2, (height * cos(above) + deep * sin(above)) / 2 * 4 / 3 * 1.08) * 1.04;
    double range = half / tan(VIEW_DEG * M_PI / 360) + 0.3 * deep;
    return json_pack("{s:s, s:s, s:{s:{s:[fff], s:[fff]}}}", "photograph", "ground.png", "camera", "long", "pose", "look_at", "position_m",
                     x, -range * cos(above), height / 2 + range * sin(above), "target_m", x, 0.0, 0.48 * height);
}

static json_t *scene_of(const struct sitter *sitters, size_t n, const enum side *sides, size_t side_count,
                        const struct portrait_options *options)
{
    json_t *models = json_object(), *entities = json_array(), *shots = json_array();
    for (size_t i = 0; i < n; i++) {
        char name[32];
        snprintf(name, sizeof name, "m%zu", i);
        json_object_set_new(models, name, model_of(&sitters[i]));
        for (size_t k = 0; k < side_count; k++) {
            double x = APART_M * (double)(i * side_count + k);
            char who[48];
            snprintf(who, sizeof who, "m%zu-%zu", i, k);
            json_t *entity = json_pack("{s:s, s:s, s:{s:[ff]}, s:f}", "name", who, "model", name, "at", "world_m", x, 0.0, "heading_deg",
                                       views[sides[k]].heading_deg);
            if (sitters[i].has_color)
                json_object_set_new(entity, "color", json_pack("[fff]", sitters[i].color[0], sitters[i].color[1], sitters[i].color[2]));
            json_array_append_new(entities, entity);
            json_array_append_new(shots, shot_of(&sitters[i], sides[k], x));
        }
    }
    return json_pack("{s:i, s:s, s:{s:{s:s, s:[ii], s:f}}, s:o, s:{s:s, s:{s:f, s:f}}, s:{s:f, s:f}, s:{s:f}, s:o, s:o}", "staffage", 1,
                     "quality", options->quick ? "draft" : "standard", "cameras", "long", "model", "SIMPLE_PINHOLE", "size_px",
                     options->width_px, options->width_px * 3 / 4, "horizontal_fov_deg", VIEW_DEG, "shots", shots,
                     "light", "sky", "clear", "sun", "azimuth_deg", 215.0, "elevation_deg", 42.0, "ground", "height_m", 0.0, "albedo",
                     GROUND_ALBEDO, "exposure", "value", EXPOSURE, "models", models, "entities", entities);
}

/* The photograph: level ground as far as one sees. */
static bool write_ground(const char *path, int width_px, struct error *err)
{
    struct image image;
    if (!image_init(&image, width_px, width_px * 3 / 4, 3, PIXEL_U8, err)) return false;
    int value = (int)lround(255 * (double)srgb_from_linear((float)(EXPOSURE * GROUND_ALBEDO)));
    memset(image.data, value, image_size(&image));
    bool ok = image_write(path, &image, err);
    image_release(&image);
    return ok;
}

/* --- running it --- */

static _Noreturn void child(char *const *arguments, int output)
{
    if (output >= 0) dup2(output, 1);
    if (output >= 0) dup2(output, 2);
    execv(arguments[0], arguments);
    _exit(127);
}

/* What it printed last, in one line, stands in the error. */
static bool fail(const char *log, int status, struct error *err)
{
    struct error unread = ERROR_NONE;
    char *text = NULL;
    size_t size = 0;
    if (log && file_read(&text, &size, log, &unread)) {
        while (size && text[size - 1] == '\n') text[--size] = 0;
        for (char *c = text; *c; c++)
            if (*c == '\n') *c = ' ';
    }
    error_set(err, ERR_RENDER, "the pictures could not be rendered: staffage ended with %d%s%.600s",
              WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), text && *text ? ": " : "", text && *text ? text : "");
    free(text);
    return false;
}

static bool run_staffage(const char *scene, const char *out, const char *log, struct error *err)
{
    char *self = realpath("/proc/self/exe", NULL), *here = self ? path_folder(self) : NULL;
    char *program = here ? string_format("%s/staffage", here) : NULL;
    char run[] = "run", to[] = "-o", *scene_copy = strdup(scene), *out_copy = strdup(out);
    char *const arguments[] = { program, run, scene_copy, to, out_copy, NULL };
    int output = log ? open(log, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666) : -1, status = 0;
    bool ok = program && scene_copy && out_copy ? true : error_set(err, ERR_MEMORY, "no memory for a path");
    if (ok && log && output < 0) ok = error_at(err, ERR_IO, log, 0, 0, "cannot be written: %s", strerror(errno));
    fflush(stdout);
    pid_t pid = ok ? fork() : -1;
    if (ok && pid == 0) child(arguments, output);
    if (ok && pid < 0) ok = error_set(err, ERR_IO, "no process for staffage: %s", strerror(errno));
    if (ok)
        while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {}
    if (ok && status != 0) ok = fail(log, status, err);
    if (output >= 0) close(output);
    free(scene_copy);
    free(out_copy);
    free(program);
    free(here);
    free(self);
    return ok;
}

static bool read_pictures(struct portraits *portraits, size_t n, const char *out, struct error *err)
{
    portraits->pictures = calloc(n + 1, sizeof *portraits->pictures);
    if (!portraits->pictures) return error_set(err, ERR_MEMORY, "no memory for pictures");
    for (; portraits->count < n; portraits->count++) {
        char *path = string_format("%s/rgb/%06zu.png", out, portraits->count);
        bool ok = path ? image_read(&portraits->pictures[portraits->count], path, err) : error_set(err, ERR_MEMORY, "no memory for a path");
        free(path);
        if (!ok) return false;
    }
    return true;
}

bool portraits_make(struct portraits *portraits, const struct sitter *sitters, size_t n, const enum side *sides, size_t side_count,
                    const struct portrait_options *options, const char *folder, struct error *err)
{
    struct portraits made = { 0 };
    char *ground = string_format("%s/ground.png", folder), *scene = string_format("%s/scene.yaml", folder), *out = string_format("%s/out", folder),
         *log = string_format("%s/log", folder), *text = NULL;
    json_t *json = scene_of(sitters, n, sides, side_count, options);
    bool ok = ground && scene && out && log && json && (text = json_dumps(json, JSON_INDENT(1) | JSON_REAL_PRECISION(9)))
                  ? true : error_set(err, ERR_MEMORY, "no memory for pictures");
    ok = ok && folder_make(folder, err) && write_ground(ground, options->width_px, err) && file_write(scene, text, strlen(text), err) &&
         run_staffage(scene, out, options->quiet ? log : NULL, err) && read_pictures(&made, n * side_count, out, err);
    if (ok) folder_remove(folder);
    json_decref(json);
    free(text);
    free(ground);
    free(scene);
    free(out);
    free(log);
    if (ok) *portraits = made;
    else portraits_release(&made);
    return ok;
}

void portraits_release(struct portraits *portraits)
{
    for (size_t i = 0; i < portraits->count; i++) image_release(&portraits->pictures[i]);
    free(portraits->pictures);
    *portraits = (struct portraits){ 0 };
}
