/* make-place FOLDER: a made-up place for the tests of flights, in metres x east, y north, z up, round 50 N 10 E:
 *   street    along y = 0 from x = -40 to 40, rising by 2 %, 6 m wide, with bumps as reconstructions have them
 *   wall      at y = -12 from x = 2 to 10, 2.5 m high
 *   building  from (-16, 8) to (-6, 16), 5 m high
 *   tree      at (-8, -7), its crown 3 to 7 m high
 *   map.osm       the street, with sidewalks
 *   place.ply     the mesh with colours, half as large and turned: world_from_mesh is scale 2, a quarter turn to the
 *                 left, and then (3, -2, 1)
 *   labelled.ply  the same with labels of UAVid on its faces */
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <unistd.h>

enum { BUILDING = 1, ROAD = 2, TREE = 4, GRASS = 5 };

static struct { double p[3]; uint8_t color[3]; } vertex[200000];
static struct { int v[3], label; } face[400000];
static int vertices, faces;

/* The same on every machine: -1 to 1 by position. */
static double noise(int i, int j)
{
    uint32_t h = (uint32_t)i * 2654435761u ^ (uint32_t)j * 2246822519u;
    h = (h ^ h >> 15) * 2246822519u;
    h = (h ^ h >> 13) * 3266489917u;
    return (double)(h ^ h >> 16) / 2147483648.0 - 1;
}

static double street(double x) { return 0.02 * x; }

static int add_vertex(double x, double y, double z, int label)
{
    static const uint8_t colors[][3] = { [BUILDING] = { 176, 132, 104 }, [ROAD] = { 112, 112, 116 }, [TREE] = { 44, 88, 40 },
                                         [GRASS] = { 104, 124, 72 } };
    int speckle = (int)(14 * noise(vertices, label));
    vertex[vertices].p[0] = x;
    vertex[vertices].p[1] = y;
    vertex[vertices].p[2] = z;
    for (int c = 0; c < 3; c++) vertex[vertices].color[c] = (uint8_t)(colors[label][c] + speckle);
    return vertices++;
}

static void add_face(int a, int b, int c, int label)
{
    face[faces].v[0] = a;
    face[faces].v[1] = b;
    face[faces].v[2] = c;
    face[faces++].label = label;
}

static void add_patch(const double o[3], const double u[3], const double v[3], int label)
{
    enum { N = 12 };
    int first = vertices;
    for (int i = 0; i <= N; i++)
        for (int j = 0; j <= N; j++) {
            double a = (double)i / N, b = (double)j / N;
            add_vertex(o[0] + a * u[0] + b * v[0], o[1] + a * u[1] + b * v[1], o[2] + a * u[2] + b * v[2], label);
        }
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++) {
            int k = first + i * (N + 1) + j;
            add_face(k, k + N + 1, k + N + 2, label);
            add_face(k, k + N + 2, k + 1, label);
        }
}

static void add_box(double x0, double y0, double x1, double y1, double height)
{
    double z = street(x0) - 0.5, dx = x1 - x0, dy = y1 - y0, dz = height + 0.5;
    const double across[3] = { dx, 0, 0 }, along[3] = { 0, dy, 0 }, up[3] = { 0, 0, dz };
    add_patch((const double[3]){ x0, y0, z }, across, up, BUILDING);
    add_patch((const double[3]){ x0, y1, z }, up, across, BUILDING);
    add_patch((const double[3]){ x0, y0, z }, up, along, BUILDING);
    add_patch((const double[3]){ x1, y0, z }, along, up, BUILDING);
    add_patch((const double[3]){ x0, y0, z + dz }, across, along, BUILDING);
}

/* A surface of revolution round an upright axis. */
static void add_round(double x, double y, const double *radius, const double *z, int rings, double rough)
{
    enum { SIDES = 20 };
    int first = vertices;
    for (int i = 0; i < rings; i++)
        for (int k = 0; k < SIDES; k++) {
            double a = 2 * M_PI * k / SIDES, r = radius[i] * (1 + rough * noise(i, k));
            add_vertex(x + r * cos(a), y + r * sin(a), z[i], TREE);
        }
    for (int i = 0; i + 1 < rings; i++)
        for (int k = 0; k < SIDES; k++) {
            int a = first + i * SIDES + k, b = first + i * SIDES + (k + 1) % SIDES;
            add_face(a, b, b + SIDES, TREE);
            add_face(a, b + SIDES, a + SIDES, TREE);
        }
}

static void add_ground(void)
{
    enum { N = 160 };
    int first = vertices;
    for (int i = 0; i <= N; i++)
        for (int j = 0; j <= N; j++) {
            double x = 0.5 * i - 40, y = 0.5 * j - 40, z = street(x) + 0.04 * noise(i, j);
            /* What was parked there while it was photographed. */
            if (fabs(y) < 3 && (i / 9 + j / 3) % 4 == 0) z += 0.12;
            add_vertex(x, y, z, fabs(y) <= 3.5 ? ROAD : GRASS);
        }
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++) {
            int k = first + i * (N + 1) + j, label = fabs(0.5 * j - 39.75) <= 3.5 ? ROAD : GRASS;
            add_face(k, k + N + 1, k + N + 2, label);
            add_face(k, k + N + 2, k + 1, label);
        }
}

static void add_tree(double x, double y)
{
    enum { RINGS = 12 };
    double radius[RINGS], z[RINGS];
    const double trunk[2] = { 0.25, 0.2 }, trunk_z[2] = { street(x) - 0.2, street(x) + 3.4 };
    for (int i = 0; i < RINGS; i++) {
        double a = M_PI * (0.02 + 0.96 * i / (RINGS - 1));
        radius[i] = 2.2 * sin(a);
        z[i] = street(x) + 5 - 2 * cos(a);
    }
    add_round(x, y, trunk, trunk_z, 2, 0);
    add_round(x, y, radius, z, RINGS, 0.12);
}

static bool write_mesh(const char *name, bool labels)
{
    FILE *f = fopen(name, "w");
    if (!f) return false;
    fprintf(f, "ply\nformat ascii 1.0\nelement vertex %d\nproperty double x\nproperty double y\nproperty double z\n"
               "property uchar red\nproperty uchar green\nproperty uchar blue\n"
               "element face %d\nproperty list uchar int vertex_indices\n%send_header\n",
            vertices, faces, labels ? "property uchar label\n" : "");
    for (int i = 0; i < vertices; i++) {
        const double *p = vertex[i].p;
        const uint8_t *c = vertex[i].color;
        fprintf(f, "%.6f %.6f %.6f %d %d %d\n", (p[1] + 2) / 2, -(p[0] - 3) / 2, (p[2] - 1) / 2, c[0], c[1], c[2]);
    }
    for (int i = 0; i < faces; i++) {
        fprintf(f, "3 %d %d %d", face[i].v[0], face[i].v[1], face[i].v[2]);
        if (labels) fprintf(f, " %d", face[i].label);
        putc('\n', f);
    }
    return fclose(f) == 0;
}

/* A degree at 50 N on WGS 84: 111229 m to the north, 71696 m to the east. */
static bool write_map(void)
{
    FILE *f = fopen("map.osm", "w");
    if (!f) return false;
    fputs("<?xml version=\"1.0\"?>\n<osm version=\"0.6\">\n", f);
    for (int i = 0; i <= 4; i++)
        fprintf(f, "  <node id=\"%d\" version=\"1\" lat=\"50\" lon=\"%.8f\"/>\n", i + 1, 10 + (20 * i - 40) / 71696.0);
    fputs("  <way id=\"1\" version=\"1\">\n", f);
    for (int i = 0; i <= 4; i++) fprintf(f, "    <nd ref=\"%d\"/>\n", i + 1);
    fputs("    <tag k=\"highway\" v=\"residential\"/>\n    <tag k=\"name\" v=\"Long Street\"/>\n"
          "    <tag k=\"width\" v=\"6\"/>\n  </way>\n</osm>\n", f);
    return fclose(f) == 0;
}

int main(int argc, char **argv)
{
    if (argc != 2) return 2;
    if (chdir(argv[1]) != 0) {
        perror(argv[1]);
        return 1;
    }
    add_ground();
    add_box(2, -12.3, 10, -12, 2.5);
    add_box(-16, 8, -6, 16, 5);
    add_tree(-8, -7);
    if (write_map() && write_mesh("place.ply", false) && write_mesh("labelled.ply", true)) return 0;
    fprintf(stderr, "make-place: %s: cannot be written\n", argv[1]);
    return 1;
}
