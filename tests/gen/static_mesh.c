#include "gen/world/static_mesh.h"
#include "lib/file.h"
#include "lib/image.h"
#include "tests/tap.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <sys/stat.h>
#include <unistd.h>

static char folder[64];
static const struct similarity as_it_is = { 1, { { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } }, { 0, 0, 0 } };

static const char *put(const char *name, const void *data, size_t size)
{
    static char path[8][128];
    static int turn;
    char *p = path[turn++ % 8];
    struct error err = ERROR_NONE;
    snprintf(p, sizeof path[0], "%s/%s", folder, name);
    file_write(p, data, size, &err);
    return p;
}

static struct static_mesh *load(const char *path, struct similarity world)
{
    struct static_mesh *mesh = NULL;
    struct error err = ERROR_NONE;
    if (!static_mesh_load(&mesh, path, world, &err)) printf("# %s: %s\n", err.file, err.text);
    return mesh;
}

static struct static_mesh *load_text(const char *name, const char *text)
{
    return load(put(name, text, strlen(text)), as_it_is);
}

static void refused(const char *name, const void *data, size_t size, int line, const char *text, const char *behaviour)
{
    struct static_mesh *mesh = NULL;
    struct error err = ERROR_NONE;
    bool ok = static_mesh_load(&mesh, put(name, data, size), as_it_is, &err);
    bool good = !ok && !mesh && err.code == ERR_INPUT && err.line == line && strstr(err.text, text);
    if (!OK(good, "%s", behaviour)) printf("# got %s:%d: %s\n", err.file, err.line, err.text);
    static_mesh_destroy(mesh);
}

static void refused_text(const char *name, const char *data, int line, const char *text, const char *behaviour)
{
    refused(name, data, strlen(data), line, text, behaviour);
}

/* --- a place of hills --- */

static double hill(double x, double y)
{
    return 1.5 * sin(0.35 * x) * cos(0.3 * y) + 0.2 * x;
}

/* A square from -half to half as OBJ, n x n cells, with vertex colours red = share of x, green = share of y. */
static struct static_mesh *hills(double half_m, int n)
{
    size_t size = (size_t)(n + 1) * (size_t)(n + 1) * 64 + (size_t)n * (size_t)n * 32, at = 0;
    char *text = malloc(size);
    for (int j = 0; j <= n; j++)
        for (int i = 0; i <= n; i++) {
            double x = half_m * (2.0 * i / n - 1), y = half_m * (2.0 * j / n - 1);
            at += (size_t)snprintf(text + at, size - at, "v %.6f %.6f %.6f %.4f %.4f 0\n", x, y, hill(x, y), (double)i / n, (double)j / n);
        }
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) {
            int a = j * (n + 1) + i + 1;
            at += (size_t)snprintf(text + at, size - at, "f %d %d %d %d\n", a, a + 1, a + n + 2, a + n + 1);
        }
    struct static_mesh *mesh = load(put("hills.obj", text, at), as_it_is);
    free(text);
    return mesh;
}

static struct static_mesh *indexed(struct static_mesh *mesh, double detail_m)
{
    struct error err = ERROR_NONE;
    if (!mesh || !static_mesh_index(mesh, detail_m, &err)) printf("# %s\n", err.text);
    return mesh;
}

/* --- reading --- */

#define HEAD(format, vertices, faces) "ply\nformat " format " 1.0\ncomment a made-up place\nelement vertex " vertices "\n"
#define XYZ "property float x\nproperty float y\nproperty float z\n"
#define RGB "property uchar red\nproperty uchar green\nproperty uchar blue\n"
#define FACE(n) "element face " n "\nproperty list uchar int vertex_indices\n"

struct bytes { char data[512]; size_t n; bool big; };

static void add(struct bytes *b, const void *value, size_t size)
{
    const char *from = value;
    for (size_t i = 0; i < size; i++) b->data[b->n++] = from[b->big ? size - 1 - i : i];
}

/* A square of two triangles and a quad beside it, with colours: in binary of either order. */
static struct bytes binary_square(bool big)
{
    static const float p[6][3] = { { 0, 0, 1 }, { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 }, { 2, 0, 1.5f }, { 2, 1, 1.5f } };
    static const int faces[3][5] = { { 3, 0, 1, 2 }, { 3, 0, 2, 3 }, { 4, 1, 4, 5, 2 } };
    struct bytes b = { .big = false };
    const char *head = big ? "ply\nformat binary_big_endian 1.0\nelement vertex 6\n" : "ply\nformat binary_little_endian 1.0\nelement vertex 6\n";
    add(&b, head, strlen(head));
    const char *rest = XYZ RGB "element camera 1\nproperty list ushort double k\n" FACE("3") "end_header\n";
    add(&b, rest, strlen(rest));
    b.big = big;
    for (int i = 0; i < 6; i++) {
        for (int k = 0; k < 3; k++) add(&b, &p[i][k], 4);
        for (int k = 0; k < 3; k++) add(&b, &(uint8_t){ (uint8_t)(10 * i + k) }, 1);
    }
    add(&b, &(uint16_t){ 1 }, 2);
    add(&b, &(double){ 7 }, 8);
    for (int f = 0; f < 3; f++) {
        add(&b, &(uint8_t){ (uint8_t)faces[f][0] }, 1);
        for (int k = 1; k <= faces[f][0]; k++) add(&b, &faces[f][k], 4);
    }
    return b;
}

static void reading_ply(void)
{
    struct bytes little = binary_square(false), big = binary_square(true);
    struct static_mesh *a = load(put("little.ply", little.data, little.n), as_it_is), *b = load(put("big.ply", big.data, big.n), as_it_is);
    struct static_mesh *c = load_text("text.ply", HEAD("ascii", "6", "3") XYZ RGB "element camera 1\nproperty list ushort double k\n" FACE("3") "end_header\n"
        "0 0 1 0 1 2\n1 0 1 10 11 12\n1 1 1 20 21 22\n0 1 1 30 31 32\n2 0 1.5 40 41 42\n2 1 15e-1 50 51 52\n1 7\n3 0 1 2\n3 0 2 3\n4 1 4 5 2\n");
    struct static_mesh *d = load_text("wide.ply", HEAD("ascii", "6", "3") "property double z\nproperty float red\nproperty double x\nproperty float green\n"
        "property float blue\nproperty double y\n" "element face 3\nproperty uchar flags\nproperty list int uint vertex_index\nend_header\n"
        "1 0 0 0.00392157 0.00784314 0\n1 0.03921569 1 0.04313725 0.04705882 0\n1 0.07843137 1 0.08235294 0.08627451 1\n"
        "1 0.11764706 0 0.12156863 0.1254902 1\n1.5 0.15686275 2 0.16078431 0.16470588 0\n1.5 0.19607843 2 0.2 0.20392157 1\n9 3 0 1 2\n9 3 0 2 3\n9 4 1 4 5 2\n");
    OK(a && static_mesh_vertex_count(a) == 6 && static_mesh_triangle_count(a) == 4, "a PLY's polygons become triangles");
    OK(a && b && static_mesh_hash(a) == static_mesh_hash(b), "big and little endian are the same place");
    OK(a && c && static_mesh_hash(a) == static_mesh_hash(c), "and so is text");
    OK(a && d && static_mesh_hash(a) == static_mesh_hash(d), "whatever the types and the order of its properties");
    if (a) {
        uint64_t before = static_mesh_hash(a);
        static_mesh_vertices(a)[3][1] += 1e-6f;
        OK(static_mesh_hash(a) != before, "the hash changes with a coordinate");
        struct static_hit corner = { .triangle = 0, .u = 1 };
        float rgb[3];
        static_mesh_color(a, rgb, &corner, 0);
        NEAR((double)rgb[0], (double)linear_from_srgb(10 / 255.f), 1e-6, "colours are linear light");
    }
    static_mesh_destroy(a);
    static_mesh_destroy(b);
    static_mesh_destroy(c);
    static_mesh_destroy(d);
    struct similarity turned = { 2, { { { 0, -1, 0 }, { 1, 0, 0 }, { 0, 0, 1 } } }, { 100, 200, 300 } };
    struct static_mesh *t = load_text("turned.ply", HEAD("ascii", "3", "1") XYZ FACE("1") "end_header\n5e5 0 0\n500001 0 0\n5e5 1 0\n3 0 1 2\n");
    static_mesh_destroy(t);
    turned.translation = vec3(0, -1e6, 3);
    t = load(put("turned.ply", HEAD("ascii", "3", "1") "property double x\nproperty double y\nproperty double z\n" FACE("1") "end_header\n500000.0625 0 0\n500001 0 0\n5e5 1 0\n3 0 1 2\n",
                 strlen(HEAD("ascii", "3", "1") "property double x\nproperty double y\nproperty double z\n" FACE("1") "end_header\n500000.0625 0 0\n500001 0 0\n5e5 1 0\n3 0 1 2\n")), turned);
    if (t) NEAR((double)static_mesh_vertices(t)[0][1], 0.125, 0, "doubles far from the origin keep their places when they come into the world");
    static_mesh_destroy(t);
}

static void refusing_ply(void)
{
    struct bytes b = binary_square(false);
    refused("cut.ply", b.data, b.n - 1, 0, "is truncated, or has no number where one belongs: element \"face\" 3 of 3", "a PLY that ends among its faces is refused");
    refused("cut.ply", b.data, b.n - 70, 0, "but only", "and one that ends among its vertices");
    refused_text("lie.ply", HEAD("ascii", "4000000000", "1") XYZ FACE("1") "end_header\n0 0 0\n", 0,
                 "the PLY header tells of 4000000000 elements \"vertex\", but only 6 bytes follow", "a header that lies about its vertices is refused");
    refused_text("lie.ply", HEAD("binary_little_endian", "0", "1") XYZ FACE("18446744073709551615") "end_header\n0 0 0\n", 0,
                 "the PLY header tells of 18446744073709551615 elements \"face\", but only 6 bytes follow", "and one that lies about its faces");
    refused_text("list.ply", HEAD("ascii", "3", "1") XYZ "element face 1\nproperty list uint int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n4000000000 0 1 2\n", 0,
                 "is truncated", "and one whose list is longer than the file");
    refused_text("index.ply", HEAD("ascii", "3", "1") XYZ FACE("1") "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", 0, "a face uses vertex 3 of 3", "an index out of range is refused");
    refused_text("index.ply", HEAD("ascii", "3", "1") XYZ FACE("1") "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", 0, "a face uses vertex -1 of 3", "and one below 0");
    refused_text("nan.ply", HEAD("ascii", "3", "1") XYZ FACE("1") "end_header\n0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n", 0, "vertex 1 has a coordinate that is not a number", "a coordinate that is not a number is refused");
    refused_text("none.ply", HEAD("ascii", "3", "1") XYZ FACE("0") "end_header\n0 0 0\n1 0 0\n0 1 0\n", 0, "has no triangles", "points without faces are refused");
    refused_text("xyz.ply", HEAD("ascii", "1", "1") "property float x\n" FACE("1") "end_header\n0\n", 0, "gives vertices no x, y and z", "vertices without height are refused");
    refused_text("label.ply", HEAD("ascii", "3", "1") XYZ FACE("1") "property int label\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 256\n", 0, "face 0 has label 256", "a label that no image can hold is refused");
    refused_text("order.ply", "ply\nformat ascii 1.0\n" FACE("1") "element vertex 1\n" XYZ "end_header\n3 0 0 0\n0 0 0\n", 0, "has faces before vertices", "faces before vertices are refused");
    refused_text("place.stl", "solid\n", 0, ".ply or .obj would be right", "a format that is not read is refused by name");
    refused_text("word.ply", "plywood\n", 0, "is no PLY file", "what is no PLY is refused");
}

static void reading_obj(void)
{
    struct image image;
    struct error err = ERROR_NONE;
    char path[128];
    image_init(&image, 4, 4, 3, PIXEL_U8, &err);
    memset(image_u8(&image, 0, 0), 200, 24);
    memset(image_u8(&image, 0, 2), 50, 6);
    memset(image_u8(&image, 0, 3), 50, 6);
    snprintf(path, sizeof path, "%s/skin 1.png", folder);
    image_write(path, &image, &err);
    image_release(&image);
    static const char mtl[] = "# materials\nnewmtl grass\r\nKd 0 1 0\nnewmtl skin\nKd 1 1 1\nmap_Kd -o 0 0 0 -clamp on skin 1.png\n";
    put("place.mtl", mtl, sizeof mtl - 1);
    struct static_mesh *m = load_text("place.obj", "mtllib place.mtl\nv 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\n"
                                                   "usemtl skin\nf 1/1/1 2/2/1 3/3/1\nusemtl grass\nf -4//1 -2//1 -1//1\n");
    OK(m && static_mesh_triangle_count(m) == 2 && static_mesh_triangles(m)[1][0] == 0 && static_mesh_triangles(m)[1][2] == 3, "OBJ indices count from the last, too");
    if (m) {
        float rgb[3];
        struct static_hit low = { .triangle = 0, .u = 0.2f, .v = 0.1f }, right = { .triangle = 0, .u = 0.8f, .v = 0.1f }, grass = { .triangle = 1 };
        static_mesh_color(m, rgb, &low, 0);
        NEAR((double)rgb[0], (double)linear_from_srgb(50 / 255.f), 1e-6, "a texture's lower left texel lies at (0, 0)");
        static_mesh_color(m, rgb, &right, 0);
        NEAR((double)rgb[0], 0, 1e-6, "and its lower right one at (1, 0)");
        struct static_hit middle = { .triangle = 0, .u = 0, .v = 0.5f };
        static_mesh_color(m, rgb, &middle, 4);
        NEAR((double)rgb[0], (2 * (double)linear_from_srgb(200 / 255.f) + (double)linear_from_srgb(50 / 255.f)) / 4, 1e-5, "a footprint as large as the texture takes its mean");
        static_mesh_color(m, rgb, &grass, 0);
        OK(rgb[0] == 0 && rgb[1] == 1, "a material without texture gives its colour");
    }
    static_mesh_destroy(m);
    m = load_text("plain.obj", "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nf 1 2 3\n");
    if (m) {
        float rgb[3];
        struct static_hit middle = { .triangle = 0, .u = 0.25f, .v = 0.25f };
        static_mesh_color(m, rgb, &middle, 0);
        OK(rgb[0] == 0.5f && rgb[1] == 0.25f && rgb[2] == 0.25f, "vertex colours of an OBJ are read and mixed across a triangle");
    }
    static_mesh_destroy(m);
    refused_text("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", 4, "a face uses vertex 4 of 3", "an OBJ's index out of range is refused with its line");
    refused_text("b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 x\n", 4, "a face has no index of a vertex", "and a word where an index belongs");
    refused_text("c.obj", "v 0 0\n", 1, "a vertex must have three coordinates", "a vertex of two coordinates is refused");
    refused_text("d.obj", "mtllib away.mtl\n", 1, "its materials \"away.mtl\" are not there", "materials that are not there are refused");
    refused_text("e.obj", "mtllib place.mtl\nusemtl wood\n", 2, "uses material \"wood\"", "and a material that the file does not have");
    refused_text("f.obj", "v 0 0 0\n", 0, "has no triangles", "an OBJ without faces is refused");
    static const char away[] = "newmtl a\nmap_Kd away.png\n";
    put("away.mtl", away, sizeof away - 1);
    refused_text("g.obj", "mtllib away.mtl\n", 0, "its texture \"away.png\" is not there", "a texture that is not there is refused");
}

/* --- rays --- */

static void rays(void)
{
    struct static_mesh *m = indexed(hills(20, 100), 0.1);
    struct vec3 eye = vec3(3, -4, 60);
    double worst = 0;
    bool all = true, normal = true;
    struct vec3 direction[500];
    struct static_hit hit[500];
    /* At the corners and edges of the grid, where a ray could slip through. */
    for (int i = 0; i < 500; i++) {
        double x = -16 + 0.4 * (i % 80), y = -15 + 0.2 * (i / 6);
        direction[i] = vec3_unit(vec3_sub(vec3(x, y, hill(x, y)), eye));
    }
    static_mesh_hits(m, hit, eye, direction, 500);
    for (int i = 0; i < 500; i++) {
        all &= hit[i].triangle != STATIC_NO_TRIANGLE;
        if (hit[i].triangle == STATIC_NO_TRIANGLE) continue;
        struct vec3 p = vec3_add(eye, vec3_scale(direction[i], hit[i].range_m));
        const uint32_t *t = static_mesh_triangles(m)[hit[i].triangle];
        double w[3] = { 1 - (double)hit[i].u - (double)hit[i].v, (double)hit[i].u, (double)hit[i].v }, q[3] = { 0, 0, 0 };
        for (int c = 0; c < 3; c++)
            for (int k = 0; k < 3; k++) q[k] += w[c] * (double)static_mesh_vertices(m)[t[c]][k];
        worst = fmax(worst, fmax(fabs(p.z - hill(p.x, p.y)), vec3_norm(vec3_sub(p, vec3(q[0], q[1], q[2])))));
        double e = 1e-4;
        struct vec3 n = vec3_unit(vec3((hill(p.x - e, p.y) - hill(p.x + e, p.y)) / (2 * e), (hill(p.x, p.y - e) - hill(p.x, p.y + e)) / (2 * e), 1));
        normal &= vec3_dot(n, static_mesh_normal(m, hit[i].triangle)) > 0.99;
    }
    OK(all, "no ray slips through between triangles");
    NEAR(worst, 0, 0.01, "rays meet the surface where it is, and the barycentric point is there, too");
    OK(normal, "a face's normal is the surface's");
    direction[0] = vec3(0, 0, 1);
    static_mesh_hits(m, hit, eye, direction, 1);
    OK(hit[0].triangle == STATIC_NO_TRIANGLE && isinf(hit[0].range_m), "a ray into the sky meets nothing");
    double z = 0, away = 1e7;
    OK(static_mesh_height(m, &z, 1.03, 2.07, INFINITY) && fabs(z - hill(1.03, 2.07)) < 0.01, "the height is the surface's");
    OK(!static_mesh_height(m, &z, 1.03, 2.07, hill(1.03, 2.07) - 0.1), "and there is none below it");
    OK(!static_mesh_height(m, &z, 25, 0, INFINITY), "or beside it");
    struct vec3 far_eye = vec3_add(vec3(1, 2, hill(1, 2)), vec3_scale(vec3_unit(vec3(1, 1, 2)), away));
    direction[0] = vec3_scale(vec3_unit(vec3(1, 1, 2)), -1);
    static_mesh_hits(m, hit, far_eye, direction, 1);
    NEAR(hit[0].range_m, away, 0.02, "an eye ten thousand kilometres off sees as exactly");
    OK(static_mesh_blocks(m, vec3(0, 0, 5), vec3(0, 0, -1), 0, 10), "what lies between blocks");
    OK(!static_mesh_blocks(m, vec3(0, 0, 5), vec3(0, 0, -1), 0, 4.9) && !static_mesh_blocks(m, vec3(0, 0, 5), vec3(0, 0, -1), 5.1, 100), "what lies before or behind does not");
    static_mesh_destroy(m);
}

/* --- cuts --- */

struct plane3 { struct vec3 n; double d; }; /* inside: n . p <= d */

/* The part of a polygon on the inner side of a plane. */
static size_t clip(struct vec3 *p, size_t n, struct plane3 plane)
{
    struct vec3 out[64];
    size_t m = 0;
    for (size_t i = 0; i < n; i++) {
        struct vec3 a = p[i], b = p[(i + 1) % n];
        double da = vec3_dot(plane.n, a) - plane.d, db = vec3_dot(plane.n, b) - plane.d;
        if (da <= 0) out[m++] = a;
        if ((da <= 0) != (db <= 0)) out[m++] = vec3_add(a, vec3_scale(vec3_sub(b, a), da / (da - db)));
    }
    memcpy(p, out, m * sizeof *p);
    return m;
}

/* By the planes in space that bound the prism. */
static bool reaches(const struct prism *prism, const float (*position)[3], const uint32_t triangle[3])
{
    struct vec3 p[64];
    size_t n = 3;
    for (int c = 0; c < 3; c++) p[c] = vec3((double)position[triangle[c]][0], (double)position[triangle[c]][1], (double)position[triangle[c]][2]);
    n = clip(p, n, (struct plane3){ vec3(0, 0, 1), prism->base_m + prism->above_m });
    n = clip(p, n, (struct plane3){ vec3(0, 0, -1), -prism->base_m - prism->below_m });
    for (size_t i = 0; i < prism->corners; i++) {
        struct vec2 a = prism->corner_m[i], b = prism->corner_m[(i + 1) % prism->corners];
        struct vec3 at = vec3(a.x, a.y, prism->base_m), out = vec3_cross(vec3(b.x - a.x, b.y - a.y, 0), prism->axis);
        n = clip(p, n, (struct plane3){ out, vec3_dot(out, at) });
    }
    return n > 0;
}

static const struct vec2 kite[4] = { { 1, -3 }, { 4, 0 }, { 1.5, 5 }, { -2, 1 } }, tiny[3] = { { -8.01, -8 }, { -7.99, -8 }, { -8, -7.98 } };
static const struct vec2 square[4] = { { -6, -6 }, { 6, -6 }, { 6, 6 }, { -6, 6 } };

static void cutting(void)
{
    struct static_mesh *m = indexed(hills(20, 80), 0.05); /* coarser than its cells: as it is */
    const struct prism prisms[] = {
        { kite, 4, 0.5, { 0, 0, 1 }, -1, 2 },
        { kite, 4, 0.5, vec3_unit(vec3(-0.9, 0.3, 0.3)), -0.5, 3 },
        { tiny, 3, hill(-8, -8), { 0, 0, 1 }, -3, 3 },
    };
    struct error err = ERROR_NONE;
    struct static_cut cut;
    size_t n = static_mesh_triangle_count(m), want = 0, found = 0;
    const float (*position)[3] = (const float (*)[3])static_mesh_vertices(m);
    bool ok = static_mesh_cut(m, &cut, prisms, 3, &err);
    bool *wanted = calloc(n, sizeof *wanted);
    for (size_t i = 0; i < n; i++) {
        for (int k = 0; k < 3; k++) wanted[i] |= reaches(&prisms[k], position, static_mesh_triangles(m)[i]);
        want += wanted[i];
    }
    for (size_t i = 0; ok && i < n; i++) {
        if (!wanted[i]) continue;
        const uint32_t *t = static_mesh_triangles(m)[i];
        for (size_t k = 0; k < cut.triangles; k++) {
            bool same = true;
            for (int c = 0; c < 3; c++) same &= !memcmp(cut.position_m[cut.triangle[k][c]], position[t[c]], sizeof *position);
            found += same;
        }
    }
    OK(ok && want > 100 && cut.triangles == want && found == want, "a cut has just the triangles that reach into a prism, each once");
    if (cut.triangles != want) printf("# %zu of %zu, found %zu\n", cut.triangles, want, found);
    OK(ok && cut.vertices < cut.triangles, "and shares their vertices");
    NEAR((double)cut.color[0][0], (double)linear_from_srgb(rintf((cut.position_m[0][0] + 20) / 40 * 255) / 255), 1e-2, "with their colours, linear");
    static_cut_release(&cut);
    ok = static_mesh_cut(m, &cut, prisms, 0, &err);
    OK(ok && cut.triangles == 0, "no prism cuts nothing out");
    static_cut_release(&cut);
    free(wanted);
    static_mesh_destroy(m);
}

/* As OBJ and back: a cut that can be searched itself. */
static struct static_mesh *mesh_of_cut(const struct static_cut *cut)
{
    size_t size = cut->vertices * 48 + cut->triangles * 36, at = 0;
    char *text = malloc(size + 1);
    for (size_t i = 0; i < cut->vertices; i++)
        at += (size_t)snprintf(text + at, size - at, "v %.7g %.7g %.7g\n", (double)cut->position_m[i][0], (double)cut->position_m[i][1], (double)cut->position_m[i][2]);
    for (size_t i = 0; i < cut->triangles; i++)
        at += (size_t)snprintf(text + at, size - at, "f %u %u %u\n", cut->triangle[i][0] + 1, cut->triangle[i][1] + 1, cut->triangle[i][2] + 1);
    struct static_mesh *m = indexed(load(put("cut.obj", text, at), as_it_is), 1);
    free(text);
    return m;
}

static void coarsening(void)
{
    double detail = 0.5;
    struct prism all = { square, 4, 0, { 0, 0, 1 }, -50, 50 }, west = { tiny, 3, 0, { 0, 0, 1 }, -50, 50 };
    struct error err = ERROR_NONE;
    struct static_mesh *fine = indexed(hills(10, 160), detail), *finer = indexed(hills(10, 320), detail), *again = indexed(hills(10, 160), detail);
    struct static_cut cut, cut_finer, cut_again, other;
    bool ok = static_mesh_cut(fine, &cut, &all, 1, &err) && static_mesh_cut(finer, &cut_finer, &all, 1, &err) &&
              static_mesh_cut(again, &other, &west, 1, &err) && static_mesh_cut(again, &cut_again, &all, 1, &err);
    OK(ok && cut.triangles < 160 * 160 * 2 / 5, "a fine mesh is cut coarser"); /* the whole has 51200 on 400 square metres, the cut lies on 144 */
    OK(ok && fabs((double)cut_finer.triangles / (double)cut.triangles - 1) < 0.1, "and a finer one gives a cut of the same size (%zu, %zu)", cut.triangles, cut_finer.triangles);
    OK(ok && cut.triangles == cut_again.triangles && cut.vertices == cut_again.vertices &&
       !memcmp(cut.position_m, cut_again.position_m, cut.vertices * sizeof *cut.position_m) &&
       !memcmp(cut.triangle, cut_again.triangle, cut.triangles * sizeof *cut.triangle), "a cut does not depend on those before it");
    struct static_mesh *m = mesh_of_cut(&cut);
    double worst = 0, sum = 0, z;
    int holes = 0, n = 0;
    for (double x = -5.9; x < 5.9; x += 0.07)
        for (double y = -5.9; y < 5.9; y += 0.07, n++) {
            if (!static_mesh_height(m, &z, x, y, INFINITY)) {
                holes++;
                continue;
            }
            worst = fmax(worst, fabs(z - hill(x, y)));
            sum += fabs(z - hill(x, y));
        }
    OK(holes == 0, "tiles join without a hole");
    OK(worst < detail && sum / n < detail / 10, "the coarse surface lies within the detail of the true one (at most %.3f m, mean %.3f m)", worst, sum / n);
    static_mesh_destroy(m);
    static_cut_release(&cut);
    static_cut_release(&cut_finer);
    static_cut_release(&cut_again);
    static_cut_release(&other);
    static_mesh_destroy(fine);
    static_mesh_destroy(finer);
    static_mesh_destroy(again);
}

/* --- changing and writing --- */

static void changing(void)
{
    struct static_mesh *m = hills(10, 20);
    struct error err = ERROR_NONE;
    float position[4][3] = { { -9, 9, 0 }, { 9, 9, 0 }, { 9, -9, 0 }, { -9, -9, 0 } };
    for (int i = 0; i < 4; i++) position[i][2] = (float)hill((double)position[i][0], (double)position[i][1]) + 0.1f;
    static const uint32_t triangle[2][3] = { { 0, 2, 1 }, { 0, 3, 2 } };
    size_t triangles = static_mesh_triangle_count(m), vertices = static_mesh_vertex_count(m);
    bool *keep = malloc((triangles + 2) * sizeof *keep);
    OK(static_mesh_add(m, (const float (*)[3])position, 4, triangle, 2, &err) && static_mesh_triangle_count(m) == triangles + 2 &&
       static_mesh_vertex_count(m) == vertices + 4 && static_mesh_triangles(m)[triangles][0] == vertices, "a surface that is added comes last");
    struct static_hit corner = { .triangle = (uint32_t)triangles };
    float rgb[3];
    static_mesh_color(m, rgb, &corner, 0); /* at (-9, 9): red 1/20, green 19/20 */
    NEAR((double)srgb_from_linear(rgb[0]), 0.05, 0.003, "in the colour of the mesh below it");
    NEAR((double)srgb_from_linear(rgb[1]), 0.95, 0.003, "channel by channel");
    for (size_t i = 0; i < triangles + 2; i++) keep[i] = i >= triangles;
    OK(static_mesh_keep(m, keep, &err) && static_mesh_triangle_count(m) == 2, "triangles are taken out");
    double z;
    OK(static_mesh_index(m, 0.2, &err) && static_mesh_height(m, &z, 0, 0, INFINITY) && fabs(z - (double)(position[1][2] + position[3][2]) / 2) < 1e-5 &&
       !static_mesh_height(m, &z, 0, 0, z - 0.01), "and no ray meets them any more");
    OK(!static_mesh_keep(m, keep, &err) && err.code == ERR_BUG, "a mesh that is indexed does not change");
    static_mesh_destroy(m);
    free(keep);
}

static void writing(void)
{
    struct static_mesh *m = hills(10, 20);
    struct error err = ERROR_NONE;
    size_t n = static_mesh_triangle_count(m);
    uint8_t *label = malloc(n), (*color)[3] = calloc(n, sizeof *color);
    for (size_t i = 0; i < n; i++) label[i] = i % 5 == 4 ? STATIC_LABEL_UNKNOWN : (uint8_t)(i % 5);
    char path[128];
    snprintf(path, sizeof path, "%s/written.ply", folder);
    bool ok = static_mesh_write(path, m, NULL, NULL, &err);
    struct static_mesh *r = load(path, as_it_is);
    OK(ok && r && static_mesh_hash(r) == static_mesh_hash(m) && static_mesh_label(r, 0) == -1, "what is written is read again, bit for bit");
    static_mesh_destroy(r);
    ok = static_mesh_write(path, m, label, (const uint8_t (*)[3])color, &err);
    r = load(path, as_it_is);
    OK(ok && r && static_mesh_label(r, 7) == 2 && static_mesh_label(r, 9) == -1, "with labels, where a face has one");
    struct static_hit middle = { .triangle = 100, .u = 0.3f, .v = 0.3f };
    float a[3], b[3];
    static_mesh_color(m, a, &middle, 0);
    static_mesh_color(r, b, &middle, 0);
    OK(!memcmp(a, b, sizeof a), "whose colours are not the mesh's own");
    static_mesh_destroy(r);
    static_mesh_destroy(m);
    free(label);
    free(color);
}

/* --- brighton --- */

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The sparse points of its first photograph, from where it was taken. */
static void brighton(const char *shared)
{
    char path[600], line[4096], *data;
    size_t size, n = 0;
    struct error err = ERROR_NONE;
    snprintf(path, sizeof path, "%s/data/brighton/mesh.ply", shared);
    struct static_mesh *m = indexed(load(path, as_it_is), 0.2 / 8.3);
    OK(m && static_mesh_vertex_count(m) == 129749 && static_mesh_triangle_count(m) == 255616, "brighton's mesh is as large as its header says");
    snprintf(path, sizeof path, "%s/data/brighton/colmap/images.txt", shared);
    if (!m || !file_read(&data, &size, path, &err)) return;
    int id = 0, seen[4000], seen_count = 0;
    struct quat q = { 1, 0, 0, 0 };
    struct vec3 t = { 0, 0, 0 };
    const char *at = data;
    while (*at == '#') at = strchr(at, '\n') + 1;
    sscanf(at, "%d %lf %lf %lf %lf %lf %lf %lf", &id, &q.w, &q.x, &q.y, &q.z, &t.x, &t.y, &t.z);
    at = strchr(at, '\n') + 1;
    const char *end = strchr(at, '\n');
    for (double x, y; at < end && seen_count < 4000; ) {
        int used, point;
        if (sscanf(at, "%lf %lf %d%n", &x, &y, &point, &used) != 3) break;
        if (point >= 0) seen[seen_count++] = point;
        at += used;
    }
    free(data);
    struct vec3 eye = pose_inverse((struct pose){ mat3_from_quat(q), t }).translation;
    static double off[4000];
    snprintf(path, sizeof path, "%s/data/brighton/colmap/points3D.txt", shared);
    FILE *f = fopen(path, "r");
    while (f && fgets(line, sizeof line, f)) {
        struct vec3 p;
        bool is_seen = false;
        if (sscanf(line, "%d %lf %lf %lf", &id, &p.x, &p.y, &p.z) != 4) continue;
        for (int i = 0; i < seen_count; i++) is_seen |= seen[i] == id;
        struct vec3 way = vec3_sub(p, eye), direction = vec3_unit(way);
        struct static_hit hit;
        if (!is_seen) continue;
        static_mesh_hits(m, &hit, eye, &direction, 1);
        if (isfinite(hit.range_m)) off[n++] = fabs(hit.range_m - vec3_norm(way)) * 8.3;
    }
    if (f) fclose(f);
    qsort(off, n, sizeof *off, ascending);
    OK(n > 500 && off[n / 2] < 0.15, "rays from where brighton's first photograph was taken meet the mesh at the sparse points (%zu, median %.3f m)", n, n ? off[n / 2] : 0);
    static_mesh_destroy(m);
}

int main(void)
{
    snprintf(folder, sizeof folder, "static-mesh-test.XXXXXX");
    if (!mkdtemp(folder)) return 1;
    reading_ply();
    refusing_ply();
    reading_obj();
    rays();
    cutting();
    coarsening();
    changing();
    writing();
    const char *shared = tap_shared();
    if (shared) brighton(shared);
    else SKIP("brighton's mesh", "the shared folder is not there");
    char command[128];
    snprintf(command, sizeof command, "rm -r %s", folder);
    return system(command) || tap_done();
}
