#include "gen/trace/place.h"
#include "lib/file.h"
#include "tests/tap.h"

#include <math.h>
#include <unistd.h>

static char folder[64];
static const struct similarity as_it_is = { 1, { { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } }, { 0, 0, 0 } };

static struct static_mesh *load(const char *name, const char *text)
{
    char path[128];
    struct error err = ERROR_NONE;
    struct static_mesh *mesh = NULL;
    snprintf(path, sizeof path, "%s/%s", folder, name);
    file_write(path, text, strlen(text), &err);
    if (!static_mesh_load(&mesh, path, as_it_is, &err) || !static_mesh_index(mesh, 0.2, &err)) printf("# %s\n", err.text);
    return mesh;
}

/* A black square of 20 m with a white one of 1.1 m on it, off its middle and a centimetre above. */
static const char squares[] = "v -10 -10 0 0 0 0\nv 10 -10 0 0 0 0\nv 10 10 0 0 0 0\nv -10 10 0 0 0 0\nf 1 2 3 4\n"
                              "v 3 1 0.01 1 1 1\nv 4.1 1 0.01 1 1 1\nv 4.1 2.1 0.01 1 1 1\nv 3 2.1 0.01 1 1 1\nf 5 6 7 8\n";

static const struct camera lens = { CAMERA_OPENCV, 320, 240, { 210, 212, 161, 118, -0.2, 0.05, 2e-3, -1e-3 } };

static struct pose look(struct vec3 eye, struct vec3 at)
{
    struct vec3 z = vec3_unit(vec3_sub(at, eye)), x = vec3_unit(vec3_cross(z, vec3(0, 0, 1)));
    return (struct pose){ mat3_from_columns(x, vec3_cross(z, x), z), eye };
}

/* Where the white square's image has its middle, and how many pixels it covers, by projecting it. */
static struct vec2 projected(struct pose world_from_camera, double *pixels)
{
    enum { N = 200 };
    struct pose camera_from_world = pose_inverse(world_from_camera);
    struct error err = ERROR_NONE;
    struct vec2 middle = { 0, 0 };
    double area = 0;
    for (int j = 0; j < N; j++)
        for (int i = 0; i < N; i++) { /* a quarter of each cell's image, by its corner's steps */
            struct vec2 q, r, s;
            double x = 3 + 1.1 * (i + 0.5) / N, y = 1 + 1.1 * (j + 0.5) / N, e = 1.1 / N;
            camera_project(&lens, &q, pose_apply(camera_from_world, vec3(x, y, 0.01)), &err);
            camera_project(&lens, &r, pose_apply(camera_from_world, vec3(x + e, y, 0.01)), &err);
            camera_project(&lens, &s, pose_apply(camera_from_world, vec3(x, y + e, 0.01)), &err);
            double a = fabs((r.x - q.x) * (s.y - q.y) - (r.y - q.y) * (s.x - q.x));
            middle.x += a * q.x;
            middle.y += a * q.y;
            area += a;
        }
    *pixels = area;
    return (struct vec2){ middle.x / area, middle.y / area };
}

static void geometry(void)
{
    struct static_mesh *mesh = load("squares.obj", squares);
    struct error err = ERROR_NONE;
    struct place_view view;
    struct pose pose = look(vec3(-2, -9, 8), vec3(1, 0, 0));
    if (!OK(place_render(&view, mesh, &lens, pose, &err), "a view is rendered")) return;
    double sum = 0, x_sum = 0, y_sum = 0, pixels, worst = 0;
    int part = 0, grey = 0, holes = 0, wrong = 0;
    for (int y = 0; y < lens.height_px; y++)
        for (int x = 0; x < lens.width_px; x++) {
            double white = (double)linear_from_srgb(image_u8(&view.rgb, x, y)[0] / 255.f), z = (double)*image_f32(&view.depth, x, y);
            int cover = *image_u8(&view.cover, x, y);
            struct vec3 d;
            bool ray = camera_unproject(&lens, &d, (struct vec2){ x + 0.5, y + 0.5 }, &err);
            struct vec3 way = mat3_apply(pose.rotation, d), p = vec3_add(pose.translation, vec3_scale(way, -pose.translation.z / way.z));
            bool inside = ray && way.z < 0 && fabs(p.x) < 10 && fabs(p.y) < 10;
            wrong += inside != !isnan(z);
            if (inside && !isnan(z)) worst = fmax(worst, fabs(z - vec3_dot(vec3_sub(p, pose.translation), mat3_column(pose.rotation, 2))));
            part += cover > 0 && cover < 255;
            holes += cover == 0;
            grey += cover == 0 && image_u8(&view.rgb, x, y)[0] == PLACE_HOLE_SRGB && image_u8(&view.rgb, x, y)[2] == PLACE_HOLE_SRGB;
            if (cover != 255 || white == 0) continue;
            sum += white;
            x_sum += white * (x + 0.5);
            y_sum += white * (y + 0.5);
        }
    struct vec2 want = projected(pose, &pixels);
    NEAR(x_sum / sum, want.x, 0.03, "what is drawn lies where the lens projects it");
    NEAR(y_sum / sum, want.y, 0.03, "in both directions");
    NEAR(sum / pixels, 1, 0.01, "edges have the share of light that the area under the pixel gives");
    OK(wrong == 0, "depth is there just where the place is");
    NEAR(worst, 0, 0.02, "and is z in the camera");
    OK(part > 100, "the rim of the place is soft");
    OK(holes > 1000 && grey == holes, "where nothing is, it is grey");
    OK(!view.label.data, "a mesh without labels has no label image");
    place_view_release(&view);
    static_mesh_destroy(mesh);
}

static void labels(void)
{
    struct static_mesh *mesh = load("labels.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
        "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 2\nproperty list uchar int vertex_indices\nproperty uchar label\nend_header\n"
        "0 0 0 9 9 9\n4 0 0 9 9 9\n4 4 0 9 9 9\n0 4 0 9 9 9\n3 0 1 2 7\n3 0 2 3 255\n");
    const struct camera above = { CAMERA_PINHOLE, 60, 60, { 100, 100, 30, 30 } };
    struct pose pose = { mat3_from_columns(vec3(1, 0, 0), vec3(0, -1, 0), vec3(0, 0, -1)), vec3(2, 2, 10) };
    struct error err = ERROR_NONE;
    struct place_view view;
    bool ok = place_render(&view, mesh, &above, pose, &err);
    OK(ok && *image_u8(&view.label, 40, 35) == 7 && *image_u8(&view.label, 20, 25) == 0 && *image_u8(&view.label, 2, 2) == 0, "labels are those of the faces, 0 where there is none");
    NEAR(ok ? (double)*image_f32(&view.depth, 20, 25) : 0, 10, 1e-5, "depth does not ask for labels");
    if (ok) place_view_release(&view);
    static_mesh_destroy(mesh);
    mesh = load("grey.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    OK(!place_render(&view, mesh, &above, pose, &err) && err.code == ERR_INPUT && strstr(err.text, "has no colours"), "a mesh without colours gives no new view");
    static_mesh_destroy(mesh);
}

/* A photograph's own pose on brighton: the mesh's colours are much as the photograph's. */
static void brighton(const char *shared)
{
    char path[600], *data;
    size_t size;
    struct error err = ERROR_NONE;
    struct static_mesh *mesh = NULL;
    struct image photograph, small;
    struct place_view view;
    snprintf(path, sizeof path, "%s/data/brighton/mesh.ply", shared);
    bool ok = static_mesh_load(&mesh, path, as_it_is, &err) && static_mesh_index(mesh, 0.02, &err);
    snprintf(path, sizeof path, "%s/data/brighton/colmap/cameras.txt", shared);
    if (!ok || !file_read(&data, &size, path, &err)) return;
    struct camera camera = { .model = CAMERA_OPENCV };
    double *p = camera.params;
    const char *line = strstr(data, "OPENCV");
    ok = sscanf(line, "OPENCV %d %d %lf %lf %lf %lf %lf %lf %lf %lf", &camera.width_px, &camera.height_px, p, p + 1, p + 2, p + 3, p + 4, p + 5, p + 6, p + 7) == 10;
    free(data);
    snprintf(path, sizeof path, "%s/data/brighton/colmap/images.txt", shared);
    if (!ok || !file_read(&data, &size, path, &err)) return;
    char name[128] = "";
    int id, camera_id;
    struct quat q = { 1, 0, 0, 0 };
    struct vec3 t = { 0, 0, 0 };
    for (line = strstr(data, "DJI_0025.JPG"); line > data && line[-1] != '\n'; line--) continue; /* in the middle of the flight */
    sscanf(line, "%d %lf %lf %lf %lf %lf %lf %lf %d %127s", &id, &q.w, &q.x, &q.y, &q.z, &t.x, &t.y, &t.z, &camera_id, name);
    free(data);
    snprintf(path, sizeof path, "%s/data/brighton/images/%s", shared, name);
    struct camera quarter = camera_scaled(&camera, camera.width_px / 4, camera.height_px / 4);
    ok = image_read(&photograph, path, &err) && image_resize(&small, &photograph, quarter.width_px, quarter.height_px, &err) &&
         place_render(&view, mesh, &quarter, pose_inverse((struct pose){ mat3_from_quat(q), t }), &err);
    double a = 0, b = 0, aa = 0, bb = 0, ab = 0, n = 0;
    for (size_t i = 0; ok && i < image_size(&view.cover); i++) {
        if (((uint8_t *)view.cover.data)[i] != 255) continue;
        double x = ((uint8_t *)view.rgb.data)[3 * i + 1], y = ((uint8_t *)small.data)[3 * i + 1];
        a += x, b += y, aa += x * x, bb += y * y, ab += x * y, n++;
    }
    double r = (ab - a * b / n) / sqrt((aa - a * a / n) * (bb - b * b / n));
    if (!OK(ok && n > 0.6 * (double)image_size(&view.cover) && r > 0.75, "brighton's mesh looks like its photograph from where that was taken (r = %.3f)", r)) printf("# %s\n", err.text);
    if (ok && getenv("STAFFAGE_KEEP")) image_write(getenv("STAFFAGE_KEEP"), &view.rgb, &err);
    image_release(&photograph);
    image_release(&small);
    place_view_release(&view);
    static_mesh_destroy(mesh);
}

int main(void)
{
    snprintf(folder, sizeof folder, "place-test.XXXXXX");
    if (!mkdtemp(folder)) return 1;
    geometry();
    labels();
    const char *shared = tap_shared();
    if (shared) brighton(shared);
    else SKIP("brighton's mesh looks like its photograph", "the shared folder is not there");
    char command[128];
    snprintf(command, sizeof command, "rm -r %s", folder);
    return system(command) || tap_done();
}
