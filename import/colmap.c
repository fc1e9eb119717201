#include "import/colmap_records.h"
#include "import/reconstruction.h"
#include "lib/file.h"

#include <stdlib.h>
#include <string.h>

/* Every record begins with its id. */
static int by_id(const void *a, const void *b)
{
    uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

static bool sort_cameras(struct colmap_records *r, struct error *err)
{
    if (r->camera_count) qsort(r->cameras, r->camera_count, sizeof *r->cameras, by_id);
    for (size_t i = 1; i < r->camera_count; i++)
        if (r->cameras[i].id == r->cameras[i - 1].id)
            return colmap_fault(r, r->cameras_file, r->cameras[i].where, err, "there are two cameras of the id %llu",
                                (unsigned long long)r->cameras[i].id);
    return true;
}

static bool sort_points(struct colmap_records *r, struct error *err)
{
    if (r->point_count) qsort(r->points, r->point_count, sizeof *r->points, by_id);
    for (size_t i = 1; i < r->point_count; i++)
        if (r->points[i].id == r->points[i - 1].id)
            return colmap_fault(r, r->points_file, r->points[i].where, err, "there are two points of the id %llu",
                                (unsigned long long)r->points[i].id);
    return true;
}

static int by_name(const void *a, const void *b)
{
    return strcmp(((const struct colmap_image *)a)->name, ((const struct colmap_image *)b)->name);
}

static bool sort_images(struct colmap_records *r, struct error *err)
{
    if (!r->image_count) return error_at(err, ERR_INPUT, r->images_file, 0, 0, "holds no image with a pose");
    qsort(r->images, r->image_count, sizeof *r->images, by_name);
    for (size_t i = 1; i < r->image_count; i++)
        if (!by_name(&r->images[i - 1], &r->images[i]))
            return colmap_fault(r, r->images_file, r->images[i].where, err, "there are two images \"%s\"",
                                r->images[i].name);
    return true;
}

static bool take_cameras(struct reconstruction *out, const struct colmap_records *r, struct error *err)
{
    for (size_t i = 0; i < r->camera_count; i++) {
        struct recon_camera *camera = &out->cameras[i];
        camera->camera = r->cameras[i].camera;
        camera->name = string_format("camera-%llu", (unsigned long long)r->cameras[i].id);
        if (!camera->name) return error_set(err, ERR_MEMORY, "no memory for the reconstruction");
        out->camera_count++;
    }
    return true;
}

static bool take_shots(struct reconstruction *out, struct colmap_records *r, struct error *err)
{
    for (size_t i = 0; i < r->image_count; i++) {
        struct colmap_image *image = &r->images[i];
        const struct colmap_camera *camera =
            r->camera_count ? bsearch(&image->camera_id, r->cameras, r->camera_count, sizeof *camera, by_id) : NULL;
        if (!camera)
            return colmap_fault(r, r->images_file, image->where, err,
                                "image \"%s\" is of camera %llu, and %s has none of that id", image->name,
                                (unsigned long long)image->camera_id, path_name(r->cameras_file));
        out->shots[i] = (struct recon_shot){
            .image = image->name,
            .camera = (size_t)(camera - r->cameras),
            .camera_from_world_q = image->camera_from_world_q,
            .camera_from_world_t = image->camera_from_world_t,
        };
        image->name = NULL;
        out->shot_count++;
    }
    return true;
}

static bool take_observations(struct reconstruction *out, const struct colmap_records *r, struct error *err)
{
    for (size_t i = 0; i < r->image_count; i++)
        for (size_t k = 0; k < r->images[i].count; k++) {
            const struct colmap_keypoint *keypoint = &r->keypoints[r->images[i].first + k];
            const struct colmap_point *point =
                r->point_count ? bsearch(&keypoint->point_id, r->points, r->point_count, sizeof *point, by_id) : NULL;
            if (!point)
                return colmap_fault(r, r->images_file, keypoint->where, err,
                                    "image \"%s\" sees point %llu, and %s has none of that id", out->shots[i].image,
                                    (unsigned long long)keypoint->point_id, path_name(r->points_file));
            out->observations[out->observation_count++] = (struct recon_observation){
                .shot = i, .point = (size_t)(point - r->points), .q_px = keypoint->q_px,
            };
        }
    return true;
}

/* COLMAP writes -1 for a point whose error it has not computed. */
static void take_points(struct reconstruction *out, const struct colmap_records *r)
{
    double sum = 0;
    out->has_stated_error = r->point_count > 0;
    for (size_t i = 0; i < r->point_count; i++) {
        out->points[out->point_count++] = r->points[i].p;
        sum += r->points[i].error_px;
        out->has_stated_error = out->has_stated_error && r->points[i].error_px >= 0;
    }
    if (out->has_stated_error) out->stated_error_px = sum / (double)r->point_count;
}

static bool assemble(struct reconstruction *out, struct colmap_records *r, struct error *err)
{
    if (!sort_cameras(r, err) || !sort_images(r, err) || !sort_points(r, err)) return false;
    out->cameras = calloc(r->camera_count + 1, sizeof *out->cameras);
    out->shots = calloc(r->image_count, sizeof *out->shots);
    out->points = calloc(r->point_count + 1, sizeof *out->points);
    out->observations = calloc(r->keypoint_count + 1, sizeof *out->observations);
    if (!out->cameras || !out->shots || !out->points || !out->observations)
        return error_set(err, ERR_MEMORY, "no memory for the reconstruction");
    take_points(out, r);
    return take_cameras(out, r, err) && take_shots(out, r, err) && take_observations(out, r, err);
}

static void release(struct colmap_records *r)
{
    for (size_t i = 0; i < r->image_count; i++) free(r->images[i].name);
    free(r->cameras);
    free(r->images);
    free(r->keypoints);
    free(r->points);
    free(r->cameras_file);
    free(r->images_file);
    free(r->points_file);
}

bool colmap_read(struct reconstruction *reconstruction, const char *folder, struct error *err)
{
    static const char *const names[] = { "images.bin", "images.txt", "sparse/0/images.bin", "sparse/0/images.txt",
                                         NULL };
    struct reconstruction found = { 0 };
    struct colmap_records records = { .images_file = reconstruction_file(folder, names, err) };
    if (!records.images_file) return false;
    const char *extension = strrchr(path_name(records.images_file), '.');
    records.binary = extension && !strcmp(extension, ".bin");
    char *beside[2] = { string_format("cameras.%s", records.binary ? "bin" : "txt"),
                        string_format("points3D.%s", records.binary ? "bin" : "txt") };
    records.cameras_file = beside[0] ? path_beside(records.images_file, beside[0]) : NULL;
    records.points_file = beside[1] ? path_beside(records.images_file, beside[1]) : NULL;
    bool ok = records.cameras_file && records.points_file ? true : error_set(err, ERR_MEMORY, "no memory for paths");
    ok = ok && (records.binary ? colmap_read_binary(&records, err) : colmap_read_text(&records, err)) &&
         assemble(&found, &records, err);
    if (ok)
        *reconstruction = found;
    else
        reconstruction_release(&found);
    release(&records);
    free(beside[0]);
    free(beside[1]);
    return ok;
}
