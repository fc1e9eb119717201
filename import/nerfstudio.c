#include "lib/json_file.h"
#include "import/reconstruction.h"
#include "lib/file.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Figures in files are rounded: this much off is still meant as a rotation. */
#define ROUNDING 1e-3

/* What a frame does not say of its camera, the file says of all. */
static struct walk *whose(struct walk *frame, struct walk *file, const char *key)
{
    return json_object_get(frame->object, key) ? frame : file;
}

static bool read_lens(struct camera *c, struct walk *frame, struct walk *file)
{
    /* Perspective names differ only in which coefficients may be other than 0. */
    static const char *const perspective[] = { "OPENCV", "PINHOLE", "SIMPLE_PINHOLE", "SIMPLE_RADIAL", "RADIAL" };
    char name[64] = "OPENCV";
    struct walk *from = whose(frame, file, "camera_model");
    if (json_object_get(from->object, "camera_model") && !walk_string(from, "camera_model", name, sizeof name)) return false;
    bool fisheye = !strcmp(name, "OPENCV_FISHEYE"), known = fisheye;
    for (size_t i = 0; i < sizeof perspective / sizeof *perspective; i++)
        known = known || !strcmp(name, perspective[i]);
    if (!known)
        return walk_wrong(from, "camera_model",
                          "is \"%s\", an unknown camera model: OPENCV, OPENCV_FISHEYE, PINHOLE, SIMPLE_PINHOLE, RADIAL "
                          "and SIMPLE_RADIAL are understood", name);

    static const char *const keys[] = { "k1", "k2", "k3", "k4", "p1", "p2" };
    enum { K1, K2, K3, K4, P1, P2, COEFFICIENTS };
    double k[COEFFICIENTS] = { 0 };
    for (int i = 0; i < COEFFICIENTS; i++)
        if (!json_read_optional(whose(frame, file, keys[i]), keys[i], &k[i])) return false;
    double *p = c->params;
    if (fisheye) {
        if (k[P1] != 0 || k[P2] != 0)
            return walk_wrong(from, "camera_model", "is OPENCV_FISHEYE, and p1 or p2 is not 0: that lens has none");
        c->model = CAMERA_OPENCV_FISHEYE;
        memcpy(p + 4, k, 4 * sizeof *k);
    } else {
        /* nerfstudio's k4 is a coefficient of r^8, which no model of COLMAP's has. */
        if (k[K4] != 0)
            return walk_wrong(whose(frame, file, "k4"), "k4", "is not 0, and of perspective lenses k1 to k3 are understood");
        bool distorted = k[K1] != 0 || k[K2] != 0 || k[P1] != 0 || k[P2] != 0;
        c->model = k[K3] != 0 ? CAMERA_FULL_OPENCV : distorted ? CAMERA_OPENCV : CAMERA_PINHOLE;
        p[4] = k[K1];
        p[5] = k[K2];
        p[6] = k[P1];
        p[7] = k[P2];
        p[8] = k[K3];
    }
    return true;
}

/* A size, which some writers give as 1920.0. */
static bool read_size(int *value, struct walk *walk, const char *key)
{
    double v;
    if (!walk_real(walk, key, &v, 1, 65535)) return false;
    if (v != floor(v)) return walk_wrong(walk, key, "must be a whole number");
    *value = (int)v;
    return true;
}

static bool read_camera(struct camera *camera, struct walk *frame, struct walk *file)
{
    struct camera c = { 0 };
    double *p = c.params;
    if (!read_lens(&c, frame, file) || !read_size(&c.width_px, whose(frame, file, "w"), "w") ||
        !read_size(&c.height_px, whose(frame, file, "h"), "h") ||
        !walk_real(whose(frame, file, "fl_x"), "fl_x", &p[0], DBL_MIN, DBL_MAX))
        return false;
    p[1] = p[0];
    struct walk *fl_y = whose(frame, file, "fl_y");
    if (json_object_get(fl_y->object, "fl_y") && !walk_real(fl_y, "fl_y", &p[1], DBL_MIN, DBL_MAX)) return false;
    if (!walk_real(whose(frame, file, "cx"), "cx", &p[2], -DBL_MAX, DBL_MAX) ||
        !walk_real(whose(frame, file, "cy"), "cy", &p[3], -DBL_MAX, DBL_MAX))
        return false;
    *camera = c;
    return true;
}

/* 3 or 4 rows of 4: a rotation and a translation. */
static bool read_matrix(struct pose *pose, struct walk *walk, const char *key)
{
    json_t *rows = walk_take(walk, key);
    if (!rows) return false;
    size_t n = json_array_size(rows);
    double m[4][4] = { [3] = { 0, 0, 0, 1 } };
    if (n != 3 && n != 4) return walk_wrong(walk, key, "must be 4 rows of 4 numbers");
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < 4; j++) {
            json_t *row = json_array_get(rows, i), *value = json_array_get(row, j);
            if (json_array_size(row) != 4 || !json_is_number(value))
                return walk_wrong(walk, key, "must be 4 rows of 4 numbers");
            m[i][j] = json_number_value(value);
        }
    if (m[3][0] != 0 || m[3][1] != 0 || m[3][2] != 0 || m[3][3] != 1)
        return walk_wrong(walk, key, "must have 0, 0, 0, 1 for its last row");
    struct mat3 rotation;
    for (int i = 0; i < 3; i++) memcpy(rotation.m[i], m[i], 3 * sizeof(double));
    double off = mat3_orthonormality(rotation);
    if (!(off <= ROUNDING) || mat3_determinant(rotation) < 0)
        return walk_wrong(walk, key, "must hold a rotation; its rows are off by %.2g%s", off,
                          mat3_determinant(rotation) < 0 ? " and mirror" : "");
    *pose = (struct pose){ mat3_orthonormalize(rotation), vec3(m[0][3], m[1][3], m[2][3]) };
    return true;
}

static bool alike(const struct camera *a, const struct camera *b)
{
    return a->model == b->model && a->width_px == b->width_px && a->height_px == b->height_px &&
           !memcmp(a->params, b->params, sizeof a->params);
}

/* Cameras that are alike are one. */
static bool camera_index(size_t *index, struct reconstruction *r, const struct camera *camera, struct error *err)
{
    size_t i = 0;
    while (i < r->camera_count && !alike(&r->cameras[i].camera, camera)) i++;
    if (i == r->camera_count) {
        r->cameras[i].name = string_format("camera-%zu", i + 1);
        if (!r->cameras[i].name) return error_set(err, ERR_MEMORY, "no memory for the reconstruction");
        r->cameras[i].camera = *camera;
        r->camera_count++;
    }
    *index = i;
    return true;
}

static bool read_frame(struct reconstruction *r, struct walk *frame, struct walk *file, struct pose applied_from_world)
{
    struct camera camera;
    struct pose applied_from_gl;
    char path[1024];
    size_t index = 0;
    if (!walk_string(frame, "file_path", path, sizeof path) ||
        !read_matrix(&applied_from_gl, frame, "transform_matrix") || !read_camera(&camera, frame, file) ||
        !camera_index(&index, r, &camera, frame->err))
        return false;
    /* OpenGL's camera looks along -z with y up. */
    const struct pose gl_from_camera = { { { { 1, 0, 0 }, { 0, -1, 0 }, { 0, 0, -1 } } }, { 0, 0, 0 } };
    struct pose world_from_camera =
        pose_compose(pose_compose(pose_inverse(applied_from_world), applied_from_gl), gl_from_camera);
    struct pose camera_from_world = pose_inverse(world_from_camera);
    struct recon_shot *shot = &r->shots[r->shot_count];
    shot->image = strdup(strncmp(path, "./", 2) ? path : path + 2);
    if (!shot->image) return error_set(frame->err, ERR_MEMORY, "no memory for the reconstruction");
    shot->camera = index;
    shot->camera_from_world_q = quat_from_mat3(camera_from_world.rotation);
    shot->camera_from_world_t = camera_from_world.translation;
    r->shot_count++;
    return true;
}

static bool read_file(struct reconstruction *r, json_t *root, const char *path, struct error *err)
{
    struct walk file = json_read_walk(root, err);
    struct pose applied_from_world = pose_identity();
    double applied_scale = 1;
    if ((json_object_get(root, "applied_transform") && !read_matrix(&applied_from_world, &file, "applied_transform")) ||
        !json_read_optional(&file, "applied_scale", &applied_scale))
        return json_file_fault(err, path, "%s", "");
    if (applied_scale != 1) walk_wrong(&file, "applied_scale", "is %g, and only 1 is understood", applied_scale);
    json_t *frames = walk_take(&file, "frames"), *frame;
    if (!json_is_array(frames)) walk_wrong(&file, "frames", "must be an array");
    if (err->code != ERR_OK) return json_file_fault(err, path, "%s", "");
    r->shots = calloc(json_array_size(frames) + 1, sizeof *r->shots);
    r->cameras = calloc(json_array_size(frames) + 1, sizeof *r->cameras);
    if (!r->shots || !r->cameras) return error_set(err, ERR_MEMORY, "no memory for the reconstruction");
    size_t i;
    json_array_foreach(frames, i, frame) {
        struct walk inner = json_read_walk(frame, err), whole = json_read_walk(root, err);
        if (!read_frame(r, &inner, &whole, applied_from_world)) return json_file_fault(err, path, "frame %zu: ", i + 1);
    }
    return reconstruction_sort(r, path, err);
}

bool nerfstudio_read(struct reconstruction *reconstruction, const char *folder, struct error *err)
{
    static const char *const names[] = { "transforms.json", NULL };
    struct reconstruction found = { 0 };
    json_t *root = NULL;
    char *file = reconstruction_file(folder, names, err);
    bool ok = file && json_file_read(&root, file, JSON_OBJECT, err) && read_file(&found, root, file, err);
    if (ok)
        *reconstruction = found;
    else
        reconstruction_release(&found);
    json_decref(root);
    free(file);
    return ok;
}
