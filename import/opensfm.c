#include "lib/json_file.h"
#include "import/reconstruction.h"
#include "lib/file.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* OpenSfM's lenses as COLMAP's. Each has its focal lengths, then what the letters of `more` say.
 * `one`: one focal length under "focal", and the principal point in the middle. */
static const struct lens {
    const char *projection;
    bool one;
    enum camera_model model;
    const char *coefficients[9]; /* in the order of the model's parameters; "" is always 0 */
} lenses[] = {
    { "perspective", true, CAMERA_RADIAL, { "k1", "k2" } },
    { "fisheye", true, CAMERA_RADIAL_FISHEYE, { "k1", "k2" } },
    { "simple_radial", false, CAMERA_OPENCV, { "k1" } },
    { "radial", false, CAMERA_OPENCV, { "k1", "k2" } },
    { "brown", false, CAMERA_FULL_OPENCV, { "k1", "k2", "p1", "p2", "k3" } },
    { "fisheye_opencv", false, CAMERA_OPENCV_FISHEYE, { "k1", "k2", "k3", "k4" } },
};
#define LENS_COUNT (sizeof lenses / sizeof *lenses)

static const struct lens *find_lens(struct walk *walk)
{
    char projection[64] = "perspective"; /* OpenSfM's own rule for files that do not say */
    if (json_object_get(walk->object, "projection_type") &&
        !walk_string(walk, "projection_type", projection, sizeof projection))
        return NULL;
    for (size_t i = 0; i < LENS_COUNT; i++)
        if (!strcmp(projection, lenses[i].projection)) return &lenses[i];
    walk_wrong(walk, "projection_type",
               "is \"%s\", an unknown camera model: perspective, brown, radial, simple_radial, fisheye and "
               "fisheye_opencv are understood", projection);
    return NULL;
}

/* Lengths are in units of the picture's longer side, from its middle. */
static bool read_camera(struct camera *camera, struct walk *walk)
{
    const struct lens *lens = find_lens(walk);
    struct camera c = { 0 };
    if (!lens || !walk_int(walk, "width", &c.width_px, 1, 65535) || !walk_int(walk, "height", &c.height_px, 1, 65535))
        return false;
    c.model = lens->model;
    double unit_px = c.width_px > c.height_px ? c.width_px : c.height_px, fx = 0, fy = 0, cx = 0, cy = 0;
    double *p = c.params;
    if (lens->one) {
        if (!walk_real(walk, "focal", &fx, DBL_MIN, DBL_MAX)) return false;
    } else if (!walk_real(walk, "focal_x", &fx, DBL_MIN, DBL_MAX) || !walk_real(walk, "focal_y", &fy, DBL_MIN, DBL_MAX) ||
               !json_read_optional(walk, "c_x", &cx) || !json_read_optional(walk, "c_y", &cy))
        return false;
    *p++ = fx * unit_px;
    if (!lens->one) *p++ = fy * unit_px;
    *p++ = cx * unit_px + c.width_px / 2.0;
    *p++ = cy * unit_px + c.height_px / 2.0;
    for (int i = 0; lens->coefficients[i]; i++)
        if (!json_read_optional(walk, lens->coefficients[i], p++)) return false;
    if (c.model == CAMERA_FULL_OPENCV && c.params[8] == 0) c.model = CAMERA_OPENCV; /* the same without k3 */
    *camera = c;
    return true;
}

/* The turn about an axis by its length, rad. */
static struct quat quat_from_axis_angle(struct vec3 a)
{
    double angle = vec3_norm(a), s = angle > 0 ? sin(angle / 2) / angle : 0.5;
    return (struct quat){ cos(angle / 2), a.x * s, a.y * s, a.z * s };
}

static bool read_shot(struct recon_shot *shot, const struct reconstruction *r, struct walk *walk)
{
    double rotation[3], translation[3];
    char camera[512];
    if (!walk_reals(walk, "rotation", rotation, 3) || !walk_reals(walk, "translation", translation, 3) ||
        !walk_string(walk, "camera", camera, sizeof camera))
        return false;
    size_t index = 0;
    while (index < r->camera_count && strcmp(r->cameras[index].name, camera)) index++;
    if (index == r->camera_count) return walk_wrong(walk, "camera", "is \"%.120s\", and there is none of that name", camera);
    shot->camera = index;
    shot->camera_from_world_q = quat_from_axis_angle(vec3(rotation[0], rotation[1], rotation[2]));
    shot->camera_from_world_t = vec3(translation[0], translation[1], translation[2]);
    return true;
}

/* Without GPS OpenSfM writes a reference of zeros: then the world is no ENU. */
static bool read_reference(struct reconstruction *r, struct walk *walk)
{
    if (!json_object_get(walk->object, "reference_lla")) return true;
    struct walk lla;
    double *v = r->reference_lat_lon_h;
    if (!walk_enter(&lla, walk, "reference_lla") || !walk_real(&lla, "latitude", &v[0], -90, 90) ||
        !walk_real(&lla, "longitude", &v[1], -180, 180) || !walk_real(&lla, "altitude", &v[2], -1e5, 1e5))
        return false;
    r->is_enu = v[0] != 0 || v[1] != 0;
    return true;
}

static bool read_part(struct reconstruction *r, json_t *part, const char *file, struct error *err)
{
    struct walk walk = json_read_walk(part, err), cameras, shots, points = { 0 };
    if (!walk_enter(&cameras, &walk, "cameras") || !walk_enter(&shots, &walk, "shots") || !read_reference(r, &walk) ||
        (json_object_get(part, "points") && !walk_enter(&points, &walk, "points")))
        return json_file_fault(err, file, "%s", "");
    r->cameras = calloc(json_object_size(cameras.object) + 1, sizeof *r->cameras);
    r->shots = calloc(json_object_size(shots.object) + 1, sizeof *r->shots);
    r->points = calloc(json_object_size(points.object) + 1, sizeof *r->points);
    if (!r->cameras || !r->shots || !r->points) return error_set(err, ERR_MEMORY, "no memory for the reconstruction");

    const char *name;
    json_t *value;
    json_object_foreach(cameras.object, name, value) {
        struct recon_camera *camera = &r->cameras[r->camera_count];
        struct walk inner = json_read_walk(value, err);
        if (!read_camera(&camera->camera, &inner)) return json_file_fault(err, file, "camera \"%.120s\": ", name);
        camera->name = strdup(name);
        if (!camera->name) return error_set(err, ERR_MEMORY, "no memory for the reconstruction");
        r->camera_count++;
    }
    json_object_foreach(shots.object, name, value) {
        struct recon_shot *shot = &r->shots[r->shot_count];
        struct walk inner = json_read_walk(value, err);
        if (!read_shot(shot, r, &inner)) return json_file_fault(err, file, "shot \"%.120s\": ", name);
        shot->image = strdup(name);
        if (!shot->image) return error_set(err, ERR_MEMORY, "no memory for the reconstruction");
        r->shot_count++;
    }
    json_object_foreach(points.object, name, value) {
        struct walk inner = json_read_walk(value, err);
        double p[3];
        if (!walk_reals(&inner, "coordinates", p, 3)) return json_file_fault(err, file, "point \"%.120s\": ", name);
        r->points[r->point_count++] = vec3(p[0], p[1], p[2]);
    }
    return reconstruction_sort(r, file, err);
}

/* Parts that hang together with no other have frames of their own: the largest counts. */
static json_t *largest_part(size_t *left_out, json_t *parts)
{
    json_t *largest = NULL, *part;
    size_t i, most = 0, all = 0;
    json_array_foreach(parts, i, part) {
        size_t shots = json_object_size(json_object_get(part, "shots"));
        if (!largest || shots > most) {
            largest = part;
            most = shots;
        }
        all += shots;
    }
    *left_out = all - most;
    return largest;
}

bool opensfm_read(struct reconstruction *reconstruction, const char *folder, struct error *err)
{
    static const char *const names[] = { "reconstruction.json", "opensfm/reconstruction.json", NULL };
    struct reconstruction found = { 0 };
    json_t *root = NULL;
    char *file = reconstruction_file(folder, names, err);
    bool ok = file && json_file_read(&root, file, JSON_ARRAY, err);
    json_t *part = ok ? largest_part(&found.left_out_count, root) : NULL;
    if (ok && !part) ok = error_at(err, ERR_INPUT, file, 0, 0, "holds no reconstruction");
    ok = ok && read_part(&found, part, file, err);
    if (ok)
        *reconstruction = found;
    else
        reconstruction_release(&found);
    json_decref(root);
    free(file);
    return ok;
}
