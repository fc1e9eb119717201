#include "import/reconstruction.h"

#include "lib/file.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

void reconstruction_release(struct reconstruction *reconstruction)
{
    for (size_t i = 0; i < reconstruction->camera_count; i++) free(reconstruction->cameras[i].name);
    for (size_t i = 0; i < reconstruction->shot_count; i++) free(reconstruction->shots[i].image);
    free(reconstruction->cameras);
    free(reconstruction->shots);
    free(reconstruction->points);
    free(reconstruction->observations);
    *reconstruction = (struct reconstruction){ 0 };
}

char *reconstruction_file(const char *path, const char *const *names, struct error *err)
{
    if (file_exists(path)) return strdup(path);
    struct stat st;
    if (stat(path, &st) != 0) {
        error_at(err, ERR_INPUT, path, 0, 0, "is not there");
        return NULL;
    }
    int length = (int)strlen(path);
    while (length > 1 && path[length - 1] == '/') length--;
    for (const char *const *name = names; *name; name++) {
        char *file = string_format("%.*s/%s", length, path, *name);
        if (file && file_exists(file)) return file;
        free(file);
    }
    char text[256] = "";
    for (const char *const *name = names; *name; name++)
        snprintf(text + strlen(text), sizeof text - strlen(text), "%s%s", name == names ? "" : ", ", *name);
    error_at(err, ERR_INPUT, path, 0, 0, "holds none of these: %s", text);
    return NULL;
}

static int by_image(const void *a, const void *b)
{
    return strcmp(((const struct recon_shot *)a)->image, ((const struct recon_shot *)b)->image);
}

bool reconstruction_sort(struct reconstruction *r, const char *file, struct error *err)
{
    if (!r->shot_count) return error_at(err, ERR_INPUT, file, 0, 0, "holds no image with a pose");
    qsort(r->shots, r->shot_count, sizeof *r->shots, by_image);
    for (size_t i = 1; i < r->shot_count; i++)
        if (!by_image(&r->shots[i - 1], &r->shots[i]))
            return error_at(err, ERR_INPUT, file, 0, 0, "has two poses of the image \"%s\"", r->shots[i].image);
    return true;
}

/* Observations come shot by shot, so a point's error has to be gathered from all over. */
struct point_error { double sum_px; size_t count; };

struct reprojection reconstruction_reprojection(const struct reconstruction *r)
{
    struct reprojection result = { 0 };
    struct point_error *of_point = calloc(r->point_count + 1, sizeof *of_point);
    double squares = 0, sum = 0;
    size_t n = 0, shot = SIZE_MAX;
    struct pose camera_from_world = pose_identity();
    for (size_t i = 0; i < r->observation_count; i++) {
        const struct recon_observation *o = &r->observations[i];
        if (o->shot != shot) {
            shot = o->shot;
            camera_from_world = (struct pose){ mat3_from_quat(r->shots[shot].camera_from_world_q),
                                               r->shots[shot].camera_from_world_t };
        }
        struct error none = ERROR_NONE;
        struct vec2 q_px;
        if (!camera_project(&r->cameras[r->shots[shot].camera].camera, &q_px,
                            pose_apply(camera_from_world, r->points[o->point]), &none)) {
            result.without_image++;
            continue;
        }
        double square = (q_px.x - o->q_px.x) * (q_px.x - o->q_px.x) + (q_px.y - o->q_px.y) * (q_px.y - o->q_px.y);
        squares += square;
        sum += sqrt(square);
        n++;
        if (of_point) {
            of_point[o->point].sum_px += sqrt(square);
            of_point[o->point].count++;
        }
    }
    if (n) {
        result.rms_px = sqrt(squares / (double)n);
        result.mean_px = sum / (double)n;
    }
    size_t seen = 0;
    for (size_t i = 0; of_point && i < r->point_count; i++) {
        if (!of_point[i].count) continue;
        result.point_mean_px += of_point[i].sum_px / (double)of_point[i].count;
        seen++;
    }
    if (seen) result.point_mean_px /= (double)seen;
    free(of_point);
    return result;
}
