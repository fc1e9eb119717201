/* A made-up place whose classes are known: road, grass, buildings, trees, cars. What is true is told by solids
 * met by formula, through the same lens, and knows nothing of meshes. */
#include "gen/trace/fusion.h"
#include "gen/trace/place.h"
#include "gen/trace/semantic.h"
#include "lib/class.h"
#include "lib/file.h"
#include "tests/tap.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <unistd.h>

enum { CLUTTER, BUILDING, ROAD, CAR, TREE, GRASS, CLASSES };
#define HALF_M 30.0
#define FACE_M 0.2

static char folder[64];

/* --- the solids --- */

struct box { double x, y, yaw_rad, length_m, width_m, height_m; int label; };
static const struct box boxes[] = {
    { -14, 9, 0.3, 12, 8, 7, BUILDING },  { 15, 14, -0.5, 9, 9, 10, BUILDING }, { 13, -15, 0.1, 14, 6, 5, BUILDING },
    { -3, -1, 0.35, 4.5, 1.8, 1.5, CAR }, { 6, 0.5, 0.36, 4.2, 1.7, 1.4, CAR }, { -14, -8.5, 0.3, 4.8, 1.9, 1.8, CAR }, { 4, -11, 1.9, 4.4, 1.8, 1.5, CAR },
};
struct cone { double x, y, radius_m, height_m; };
static const struct cone cones[] = { { -5, 13, 2.5, 7 }, { 3, 10, 2, 6 }, { -18, -15, 3, 9 }, { -9, -17, 2.2, 6 }, { 22, 1, 2.4, 8 } };
enum { BOXES = sizeof boxes / sizeof *boxes, CONES = sizeof cones / sizeof *cones };

static int ground_label(double x, double y)
{
    return fabs(-sin(0.35) * x + cos(0.35) * y) < 3.6 ? ROAD : GRASS;
}

static double box_range(const struct box *b, struct vec3 o, struct vec3 d)
{
    double c = cos(b->yaw_rad), s = sin(b->yaw_rad), dx = o.x - b->x, dy = o.y - b->y, near_m = 0, far_m = INFINITY;
    double origin[3] = { c * dx + s * dy, -s * dx + c * dy, o.z }, way[3] = { c * d.x + s * d.y, -s * d.x + c * d.y, d.z };
    double low[3] = { -b->length_m / 2, -b->width_m / 2, 0 }, high[3] = { b->length_m / 2, b->width_m / 2, b->height_m };
    for (int k = 0; k < 3; k++) {
        double t0 = (low[k] - origin[k]) / way[k], t1 = (high[k] - origin[k]) / way[k];
        near_m = fmax(near_m, fmin(t0, t1));
        far_m = fmin(far_m, fmax(t0, t1));
    }
    return near_m <= far_m ? near_m : INFINITY;
}

static double cone_range(const struct cone *k, struct vec3 o, struct vec3 d)
{
    double m = k->radius_m / k->height_m, x = o.x - k->x, y = o.y - k->y, h = k->height_m - o.z; /* x^2 + y^2 = m^2 h^2 */
    double a = d.x * d.x + d.y * d.y - m * m * d.z * d.z, b = x * d.x + y * d.y + m * m * h * d.z, c = x * x + y * y - m * m * h * h;
    double root = b * b - a * c, best = INFINITY;
    for (int sign = -1; root >= 0 && sign <= 1; sign += 2) {
        double t = (-b + sign * sqrt(root)) / a, z = o.z + t * d.z;
        if (t > 0 && z >= 0 && z <= k->height_m) best = fmin(best, t);
    }
    return best;
}

/* The class that a ray meets, or SEMANTIC_VOID. */
static int truth(struct vec3 o, struct vec3 d)
{
    double best = d.z < 0 ? -o.z / d.z : INFINITY, x = o.x + best * d.x, y = o.y + best * d.y;
    int label = isfinite(best) && fabs(x) < HALF_M && fabs(y) < HALF_M ? ground_label(x, y) : SEMANTIC_VOID;
    for (int i = 0; i < BOXES; i++) {
        double t = box_range(&boxes[i], o, d);
        if (t < best) best = t, label = boxes[i].label;
    }
    for (int i = 0; i < CONES; i++) {
        double t = cone_range(&cones[i], o, d);
        if (t < best) best = t, label = TREE;
    }
    return label;
}

/* --- their mesh, as a reconstruction would give it --- */

struct text { char *data; size_t n, capacity, vertices; };

__attribute__((format(printf, 2, 3)))
static void say(struct text *t, const char *format, ...)
{
    va_list args;
    if (t->capacity - t->n < 256) t->data = realloc(t->data, t->capacity = 2 * t->capacity + 4096);
    va_start(args, format);
    t->n += (size_t)vsnprintf(t->data + t->n, 256, format, args);
    va_end(args);
}

/* A patch o + i u + j v of n x m cells. */
static void patch(struct text *t, struct vec3 o, struct vec3 u, struct vec3 v)
{
    int n = (int)ceil(vec3_norm(u) / FACE_M), m = (int)ceil(vec3_norm(v) / FACE_M);
    for (int j = 0; j <= m; j++)
        for (int i = 0; i <= n; i++) {
            struct vec3 p = vec3_add(o, vec3_add(vec3_scale(u, (double)i / n), vec3_scale(v, (double)j / m)));
            say(t, "v %.5f %.5f %.5f 0.5 0.5 0.5\n", p.x, p.y, p.z);
        }
    for (int j = 0; j < m; j++)
        for (int i = 0; i < n; i++) {
            size_t a = t->vertices + (size_t)(j * (n + 1) + i + 1), b = a + (size_t)n + 1;
            say(t, "f %zu %zu %zu %zu\n", a, a + 1, b + 1, b);
        }
    t->vertices += (size_t)((n + 1) * (m + 1));
}

static void add_box(struct text *t, const struct box *b)
{
    double c = cos(b->yaw_rad), s = sin(b->yaw_rad);
    struct vec3 u = vec3(c * b->length_m, s * b->length_m, 0), v = vec3(-s * b->width_m, c * b->width_m, 0), up = vec3(0, 0, b->height_m);
    struct vec3 o = vec3_sub(vec3(b->x, b->y, 0), vec3_scale(vec3_add(u, v), 0.5));
    patch(t, o, u, up);
    patch(t, vec3_add(o, u), v, up);
    patch(t, vec3_add(o, vec3_add(u, v)), vec3_scale(u, -1), up);
    patch(t, vec3_add(o, v), vec3_scale(v, -1), up);
    patch(t, vec3_add(o, up), u, v);
}

static void add_cone(struct text *t, const struct cone *k)
{
    int around = (int)(2 * M_PI * k->radius_m / FACE_M), rings = (int)(hypot(k->radius_m, k->height_m) / FACE_M);
    for (int j = 0; j <= rings; j++)
        for (int i = 0; i < around; i++) {
            double r = k->radius_m * (1 - (double)j / rings), a = 2 * M_PI * i / around;
            say(t, "v %.5f %.5f %.5f 0.5 0.5 0.5\n", k->x + r * cos(a), k->y + r * sin(a), k->height_m * j / rings);
        }
    for (int j = 0; j < rings; j++)
        for (int i = 0; i < around; i++) {
            size_t a = t->vertices + (size_t)(j * around + i + 1), b = t->vertices + (size_t)(j * around + (i + 1) % around + 1), up = (size_t)around;
            say(t, "f %zu %zu %zu %zu\n", a, b, b + up, a + up);
        }
    t->vertices += (size_t)(around * (rings + 1));
}

static const struct similarity as_it_is = { 1, { { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } }, { 0, 0, 0 } };

static struct static_mesh *load(const char *path)
{
    struct error err = ERROR_NONE;
    struct static_mesh *mesh = NULL;
    if (!static_mesh_load(&mesh, path, as_it_is, &err) || !static_mesh_index(mesh, FACE_M, &err)) printf("# %s\n", err.text);
    return mesh;
}

static struct static_mesh *make_place(void)
{
    struct text t = { 0 };
    struct error err = ERROR_NONE;
    patch(&t, vec3(-HALF_M, -HALF_M, 0), vec3(2 * HALF_M, 0, 0), vec3(0, 2 * HALF_M, 0));
    for (int i = 0; i < BOXES; i++) add_box(&t, &boxes[i]);
    for (int i = 0; i < CONES; i++) add_cone(&t, &cones[i]);
    char path[128];
    snprintf(path, sizeof path, "%s/place.obj", folder);
    file_write(path, t.data, t.n, &err);
    free(t.data);
    return load(path);
}

/* --- views --- */

static const struct camera camera = { CAMERA_OPENCV, 480, 360, { 400, 400, 238, 183, -0.12, 0.03, 1e-3, -5e-4 } };

static struct pose look(struct vec3 eye, struct vec3 at)
{
    struct vec3 z = vec3_unit(vec3_sub(at, eye)), x = vec3_unit(vec3_cross(z, vec3(0.01, 0, 1)));
    return (struct pose){ mat3_from_columns(x, vec3_cross(z, x), z), eye };
}

static struct pose view(int i, int n, double ring_m, double height_m)
{
    double a = 2 * M_PI * i / n + 0.4;
    return look(vec3(ring_m * cos(a), ring_m * sin(a), height_m), vec3(4 * sin(3.0 * i), 4 * cos(2.0 * i), 0));
}

static struct image true_labels(struct pose world_from_camera)
{
    static struct vec3 direction[360][480]; /* the lens is inverted once */
    struct image ids;
    struct error err = ERROR_NONE;
    for (int y = 0; direction[359][479].z == 0 && y < 360; y++)
        for (int x = 0; x < 480; x++) camera_unproject(&camera, &direction[y][x], (struct vec2){ x + 0.5, y + 0.5 }, &err);
    image_init(&ids, camera.width_px, camera.height_px, 1, PIXEL_U8, &err);
    for (int y = 0; y < ids.height_px; y++)
        for (int x = 0; x < ids.width_px; x++)
            *image_u8(&ids, x, y) = (uint8_t)truth(world_from_camera.translation, mat3_apply(world_from_camera.rotation, direction[y][x]));
    return ids;
}

/* Every so many pixels a wrong one. */
static void spoil(struct image *ids, unsigned every)
{
    unsigned state = 12345;
    for (size_t i = 0; i < image_size(ids); i++) {
        state = state * 1664525u + 1013904223u;
        if (state % every < 7) ((uint8_t *)ids->data)[i] = (uint8_t)((state >> 16) % CLASSES);
    }
}

struct result { double miou, iou[CLASSES]; struct fusion_counts counts; };

/* Fuse five views, write the mesh, read it again, and compare twenty other views of it. */
static struct result propagate(const struct static_mesh *mesh, unsigned spoiled)
{
    struct result r = { 0 };
    struct error err = ERROR_NONE;
    struct fusion *fusion = NULL;
    size_t faces = static_mesh_triangle_count(mesh);
    uint8_t *label = malloc(faces);
    bool ok = fusion_create(&fusion, mesh, &err);
    for (int i = 0; ok && i < 5; i++) {
        struct pose pose = i == 0 ? look(vec3(0, 0, 48), vec3(0.5, 0, 0)) : view(i, 4, 30, 34);
        struct image ids = true_labels(pose);
        if (spoiled) spoil(&ids, spoiled);
        ok = fusion_add(fusion, &ids, &camera, pose, &err);
        image_release(&ids);
    }
    char path[128];
    snprintf(path, sizeof path, "%s/semantic.ply", folder);
    ok = ok && fusion_decide(fusion, label, &r.counts, 2, &err) && static_mesh_write(path, mesh, label, NULL, &err);
    struct static_mesh *semantic = ok ? load(path) : NULL;
    double both[CLASSES] = { 0 }, either[CLASSES] = { 0 };
    for (int i = 0; semantic && i < 20; i++) {
        struct pose pose = view(i, 20, 12 + i, 26 + i % 7 * 3);
        struct image want = true_labels(pose);
        struct place_view got;
        if (!place_render(&got, semantic, &camera, pose, &err)) break;
        for (size_t k = 0; k < image_size(&want); k++) {
            int a = ((uint8_t *)want.data)[k], b = ((uint8_t *)got.label.data)[k];
            if (a == SEMANTIC_VOID) continue;
            either[a]++;
            if (a == b) both[a]++;
            else either[b]++;
        }
        image_release(&want);
        place_view_release(&got);
    }
    for (int c = BUILDING; c < CLASSES; c++) {
        r.iou[c] = both[c] / either[c];
        r.miou += r.iou[c] / (CLASSES - 1);
    }
    if (!ok) printf("# %s\n", err.text);
    static_mesh_destroy(semantic);
    fusion_destroy(fusion);
    free(label);
    return r;
}

static void say_result(const struct result *r)
{
    printf("# mIoU %.4f: building %.4f, road %.4f, car %.4f, tree %.4f, grass %.4f; %zu faces by votes, %zu filled, %zu unknown\n",
           r->miou, r->iou[BUILDING], r->iou[ROAD], r->iou[CAR], r->iou[TREE], r->iou[GRASS], r->counts.voted, r->counts.filled, r->counts.unknown);
}

/* --- deciding --- */

/* Five strips of a metre, side by side, seen from right above: who votes, who is filled in. */
static void deciding(void)
{
    struct text t = { 0 };
    struct error err = ERROR_NONE;
    for (int i = 0; i <= 10; i++) say(&t, "v %d 0 0\nv %d 1 0\n", i, i);
    for (int i = 0; i < 10; i++) say(&t, "f %d %d %d %d\n", 2 * i + 1, 2 * i + 3, 2 * i + 4, 2 * i + 2);
    char path[128];
    snprintf(path, sizeof path, "%s/strip.obj", folder);
    file_write(path, t.data, t.n, &err);
    free(t.data);
    struct static_mesh *m = load(path);
    struct fusion *fusion = NULL;
    struct fusion_counts counts;
    uint8_t label[20];
    /* 100 x 10 pixels of a tenth of a metre: x is the strip's, the first quarter is 1, then 3, and void from 4 m on. */
    const struct camera above = { CAMERA_PINHOLE, 100, 10, { 200, 200, 50, 5 } };
    struct image ids;
    image_init(&ids, 100, 10, 1, PIXEL_U8, &err);
    for (int y = 0; y < 10; y++)
        for (int x = 0; x < 100; x++) *image_u8(&ids, x, y) = x < 20 ? 1 : x < 40 ? 3 : SEMANTIC_VOID;
    struct pose pose = { mat3_from_columns(vec3(1, 0, 0), vec3(0, -1, 0), vec3(0, 0, -1)), vec3(5, 0.5, 20) };
    bool ok = fusion_create(&fusion, m, &err) && fusion_add(fusion, &ids, &above, pose, &err) && fusion_decide(fusion, label, &counts, 2.1, &err);
    OK(ok && label[0] == 1 && label[3] == 1 && label[4] == 3 && label[7] == 3 && counts.voted == 8, "faces take the label of the pixels that show them");
    OK(ok && label[8] == 3 && label[10] == 3, "those that none shows take their neighbours'");
    OK(ok && label[16] == STATIC_LABEL_UNKNOWN && label[19] == STATIC_LABEL_UNKNOWN && counts.voted + counts.filled + counts.unknown == 20, "unless those are too far away: they stay unknown");
    ok = fusion_decide(fusion, label, &counts, 100, &err);
    OK(ok && counts.unknown == 0 && label[19] == 3, "with a longer reach they are filled, too");
    for (size_t i = 0; i < image_size(&ids); i++) ((uint8_t *)ids.data)[i] = 5;
    ok = fusion_add(fusion, &ids, &above, pose, &err) && fusion_decide(fusion, label, &counts, 0, &err);
    OK(ok && label[0] == STATIC_LABEL_UNKNOWN, "a face of which two images say two things is undecided");
    ok = fusion_add(fusion, &ids, &above, pose, &err) && fusion_decide(fusion, label, &counts, 0, &err);
    OK(ok && label[0] == 5, "until a third one decides");
    image_release(&ids);
    fusion_destroy(fusion);
    static_mesh_destroy(m);
}

/* --- reading --- */

static void reading(void)
{
    struct image image, ids = { 0 };
    struct error err = ERROR_NONE;
    char path[128];
    size_t n;
    const struct palette_label *labels = palette_labels(PALETTE_UAVID, &n);
    image_init(&image, (int)n, 1, 3, PIXEL_U8, &err);
    for (size_t i = 0; i < n; i++) memcpy(image_u8(&image, (int)i, 0), labels[i].color, 3);
    snprintf(path, sizeof path, "%s/semantic.png", folder);
    image_write(path, &image, &err);
    bool same = semantic_read(&ids, path, PALETTE_UAVID, &err);
    for (size_t i = 0; same && i < n; i++) same = *image_u8(&ids, (int)i, 0) == labels[i].id;
    OK(same, "colours of a palette become its ids");
    image_release(&ids);
    *image_u8(&image, 3, 0) = 193;
    image_write(path, &image, &err);
    OK(!semantic_read(&ids, path, PALETTE_UAVID, &err) && strstr(err.text, "pixel (3, 0) has colour #c100c0, which the palette \"uavid\" has not"), "a colour between two is refused with its place");
    image_release(&image);
    err = ERROR_NONE;
    image_init(&image, 2, 1, 1, PIXEL_U8, &err);
    *image_u8(&image, 0, 0) = SEMANTIC_VOID;
    *image_u8(&image, 1, 0) = 2;
    image_write(path, &image, &err);
    OK(semantic_read(&ids, path, PALETTE_UAVID, &err) && *image_u8(&ids, 0, 0) == SEMANTIC_VOID && *image_u8(&ids, 1, 0) == 2, "ids are read as they are, and void stays void");
    image_release(&ids);
    *image_u8(&image, 1, 0) = 8;
    image_write(path, &image, &err);
    OK(!semantic_read(&ids, path, PALETTE_UAVID, &err) && strstr(err.text, "pixel (1, 0) has id 8"), "an id that there is not is refused");
    image_release(&image);
}

/* --- the program --- */

/* A shot right above two triangles, one road, one grass. */
static void program(const char *build)
{
    static const char scene[] = "staffage: 1\ncameras:\n  drone: {model: PINHOLE, size_px: [80, 40], params: [100, 100, 40, 20]}\n"
        "shots:\n  - {photograph: two.png, camera: drone, pose: {matrix: [[1, 0, 0, 0], [0, -1, 0, 0], [0, 0, -1, 10]]}, semantic: two.png}\n"
        "static: {mesh: two.obj, world_from_mesh: {scale: 2}}\nlight: {sky: overcast}\nexposure: {value: 1}\nlabels: {palette: uavid}\n";
    static const char obj[] = "v -2 -1 0\nv 0 -1 0\nv 0 1 0\nv -2 1 0\nv 2 -1 0\nv 2 1 0\nf 1 2 3 4\nf 2 5 6 3\n";
    char path[128], command[512];
    struct image image;
    struct error err = ERROR_NONE;
    image_init(&image, 40, 20, 3, PIXEL_U8, &err); /* half as large as the camera is */
    for (int y = 0; y < 20; y++)
        for (int x = 0; x < 40; x++) memcpy(image_u8(&image, x, y), x < 20 ? (uint8_t[]){ 128, 64, 128 } : (uint8_t[]){ 128, 128, 0 }, 3);
    snprintf(path, sizeof path, "%s/two.png", folder);
    image_write(path, &image, &err);
    image_release(&image);
    snprintf(path, sizeof path, "%s/two.obj", folder);
    file_write(path, obj, sizeof obj - 1, &err);
    snprintf(path, sizeof path, "%s/scene.yaml", folder);
    file_write(path, scene, sizeof scene - 1, &err);
    snprintf(command, sizeof command, "'%s/staffage-fuse' %s/scene.yaml -o %s/two.ply", build, folder, folder);
    fflush(stdout);
    bool ok = system(command) == 0;
    snprintf(path, sizeof path, "%s/two.ply", folder);
    struct static_mesh *mesh = ok ? load(path) : NULL;
    OK(mesh && static_mesh_label(mesh, 0) == ROAD && static_mesh_label(mesh, 1) == ROAD && static_mesh_label(mesh, 2) == GRASS && static_mesh_label(mesh, 3) == GRASS,
       "staffage-fuse puts the image of a shot onto the scene's mesh");
    NEAR(mesh ? static_mesh_vertex(mesh, 5).x : 0, 4, 1e-6, "and writes it in world metres");
    static_mesh_destroy(mesh);
}

int main(void)
{
    snprintf(folder, sizeof folder, "fusion-test.XXXXXX");
    if (!mkdtemp(folder)) return 1;
    struct static_mesh *mesh = make_place();
    struct result exact = propagate(mesh, 0), spoiled = propagate(mesh, 100);
    OK(exact.miou >= 0.97, "labels of five views, on the mesh, are those of twenty others to 0.97 mIoU");
    say_result(&exact);
    OK(exact.counts.voted > static_mesh_triangle_count(mesh) / 2, "most faces are decided by votes");
    OK(spoiled.miou >= 0.97, "even when seven in a hundred pixels are wrong");
    say_result(&spoiled);
    static_mesh_destroy(mesh);
    deciding();
    reading();
    program(getenv("top_builddir") ? getenv("top_builddir") : ".");
    char command[128];
    snprintf(command, sizeof command, "rm -r %s", folder);
    return system(command) || tap_done();
}
