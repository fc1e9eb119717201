#include "gen/world/surface.h"

#include "lib/file.h"
#include "tests/tap.h"

#include <unistd.h>

#define DEG (M_PI / 180)
static const struct similarity identity = { 1, { { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } }, { 0, 0, 0 } };
static char scratch[] = "surface-test.XXXXXX";

/* A mesh from text. */
static struct static_mesh *mesh_of(const char *ply)
{
    struct error err = ERROR_NONE;
    struct static_mesh *mesh = NULL;
    char *path = string_format("%s/mesh.ply", scratch);
    OK(file_write(path, ply, strlen(ply), &err) && static_mesh_load(&mesh, path, identity, &err), "a mesh (%s)", err.text);
    unlink(path);
    free(path);
    return mesh;
}

/* A slope of 8 % to the east and -5 % to the north: two large triangles; over it a table 3 m high. */
static const char slope[] =
    "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
    "-50 -50 8.5\n50 -50 16.5\n50 50 11.5\n-50 50 3.5\n"
    "20 20 13.0\n24 20 13.0\n24 24 13.0\n20 24 13.0\n"
    "3 0 1 2\n3 0 2 3\n3 4 5 6\n3 4 6 7\n";
static double slope_height(double x, double y) { return 10 + 0.08 * x - 0.05 * y; }

/* What a body's axes say of it: heading clockwise from +y, pitch up, roll to the right, of the axes. */
static void check_stand(const struct surface *surface, double x, double y, double heading, const char *what)
{
    struct pose pose;
    if (!OK(surface_stand(surface, &pose, x, y, heading, 2.7, 1.6), "%s: a car stands", what)) return;
    struct vec3 forward = mat3_column(pose.rotation, 0), left = mat3_column(pose.rotation, 1), up = mat3_column(pose.rotation, 2);
    double east = 0.08, north = -0.05; /* slopes */
    NEAR(mat3_orthonormality(pose.rotation), 0, 1e-12, "%s: in a rotation", what);
    NEAR(mat3_determinant(pose.rotation), 1, 1e-12, "%s: that does not mirror", what);
    NEAR(remainder(atan2(forward.x, forward.y) - heading, 2 * M_PI), 0, 1e-6, "%s: with its heading", what);
    NEAR(asin(forward.z), atan(east * sin(heading) + north * cos(heading)), 1e-6, "%s: its pitch is the slope ahead", what);
    double n = sqrt(1 + east * east + north * north);
    NEAR(up.x, -east / n, 1e-6, "%s: upright on the slope, x", what);
    NEAR(up.y, -north / n, 1e-6, "%s: upright on the slope, y", what);
    /* Left lies in the plane, at a right angle to (f, ahead): its rise over its run follows from both. */
    double ahead = east * sin(heading) + north * cos(heading), aside = -east * cos(heading) + north * sin(heading);
    NEAR(asin(left.z), asin(aside / sqrt(1 + ahead * ahead) / n), 1e-6, "%s: its roll", what);
    NEAR(pose.translation.z, slope_height(x, y), 2e-6, "%s: its middle on the ground", what);

    OK(surface_stand(surface, &pose, x, y, heading, 0, 0) && mat3_column(pose.rotation, 2).z == 1, "%s: people are upright", what);
    NEAR(remainder(atan2(pose.rotation.m[0][0], pose.rotation.m[1][0]) - heading, 2 * M_PI), 0, 1e-12, "%s: and look ahead", what);
}

static void check_plane(void)
{
    struct vec3 normal = vec3_unit(vec3(-0.08, 0.05, 1));
    struct surface surface = { .plane = { normal, vec3_dot(normal, vec3(0, 0, 10)) } };
    check_stand(&surface, 3, -4, 30 * DEG, "plane");
    check_stand(&surface, 0, 0, 200 * DEG, "plane, the other way");
    double z;
    struct vec3 n, p;
    OK(surface_at(&surface, &z, &n, 5, 7), "plane: a height");
    NEAR(z, slope_height(5, 7), 1e-12, "plane: which is the plane's");
    NEAR(n.x, normal.x, 1e-12, "plane: with its normal");
    OK(surface_intersect(&surface, &p, vec3(0, 0, 60), vec3(1, 2, -40)), "plane: a ray meets it");
    NEAR(p.z, slope_height(p.x, p.y), 1e-9, "plane: on it");
}

static void check_mesh(void)
{
    struct error err = ERROR_NONE;
    struct static_mesh *mesh = mesh_of(slope);
    if (!mesh) return;
    struct road_network roads = { 0 };
    struct road_rules rules = { 0 };
    OK(roads_add(&roads, "road", ROAD_VEHICLES, (struct vec2[2]){ { -30, -10 }, { 30, 10 } }, 2, 6, false, &rules, &err), "a road");
    struct ribbon ribbon;
    if (!OK(ribbon_fit(&ribbon, &roads.ways[0], mesh, &err), "two large triangles are enough to fit a ribbon to")) {
        printf("# %s\n", err.text);
        return;
    }
    size_t triangles = static_mesh_triangle_count(mesh);
    OK(ribbons_lay(mesh, &ribbon, 1, &err) && static_mesh_index(mesh, 0.2, &err), "laid");
    OK(static_mesh_triangle_count(mesh) == triangles, "where there is no hole nothing is filled");
    struct surface surface = { .has_mesh = true, .mesh = mesh, .ribbons = &ribbon, .ribbon_count = 1 };
    check_stand(&surface, 3, 1.5, 71 * DEG, "ribbon");
    check_stand(&surface, -20, -6, -109 * DEG, "ribbon, the other way");
    check_stand(&surface, 10, -30, 120 * DEG, "bare mesh");

    double z;
    struct vec3 normal, p;
    OK(surface_at(&surface, &z, &normal, 12, -20), "beside the road");
    NEAR(z, slope_height(12, -20), 2e-6, "the mesh has its height");
    NEAR(normal.x / normal.z, -0.08, 1e-5, "and its slope to the east");
    NEAR(normal.y / normal.z, 0.05, 1e-5, "and to the north");
    OK(!surface_at(&surface, &z, &normal, 60, 0), "beyond the mesh there is nothing to stand on");
    struct pose pose;
    OK(!surface_stand(&surface, &pose, 60, 0, 0, 2.7, 1.6), "for a car neither");
    OK(!surface_stand(&surface, &pose, 49.5, -40, 90 * DEG, 2.7, 1.6), "nor with two wheels over the brink");

    OK(surface_intersect(&surface, &p, vec3(22, 22, 50), vec3(0, 0, -2)), "a ray from above");
    NEAR(p.z, 13, 1e-5, "meets the table before the ground");
    OK(surface_intersect(&surface, &p, vec3(0, 0, 30), vec3(0.3, -0.2, -1)), "a slanting ray");
    NEAR(p.z, slope_height(p.x, p.y), 1e-5, "meets the ground");
    NEAR((p.x - 0) / (p.y - 0), -1.5, 1e-5, "on the ray");
    OK(!surface_intersect(&surface, &p, vec3(0, 0, 30), vec3(0, 0, 1)), "a ray to the sky meets nothing");
    ribbon_release(&ribbon);
    roads_release(&roads);
    static_mesh_destroy(mesh);
}

int main(void)
{
    if (!OK(mkdtemp(scratch) != NULL, "a scratch folder")) return tap_done();
    check_plane();
    check_mesh();
    rmdir(scratch);
    return tap_done();
}
