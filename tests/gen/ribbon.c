#include "gen/world/ribbon.h"

#include "lib/file.h"
#include "tests/tap.h"

#include <stdint.h>
#include <unistd.h>

/* --- a made-up place: a smooth road, and what a reconstruction would make of it --- */

#define GRID_M 0.2
#define ROAD_M 7.0
#define CAR_M 1.5
#define CROWN_M 6.0

static struct road_network place_roads;
static const struct way *road;

/* Height of the road and of what lies beside it: a grade, a long wave, a crown of 2.5 %, a cross slope that changes. */
static double truth(double s, double t)
{
    return 20 + 0.04 * s + 0.6 * sin(2 * M_PI * s / 110) + 0.02 * t * sin(2 * M_PI * s / 150) - 0.025 * t * t / ROAD_M;
}

static uint32_t draw_state = 7;
static double draw(void)
{
    draw_state = draw_state * 1664525u + 1013904223u;
    return (double)(draw_state >> 8) / 16777216.0;
}
static double normal_draw(void)
{
    return sqrt(-2 * log(1 - draw())) * cos(2 * M_PI * draw());
}

/* Lumps as wide as a step or two, 4 cm rms. */
static double lumps(double x, double y)
{
    return 0.04 * (sin(2 * M_PI * (x / 1.43 + y / 2.9)) + sin(2 * M_PI * (y / 1.1 - x / 3.7) + 1)) ;
}

/* Along and across; the road runs on eastwards, so that its nearest point is not far from the one of the same x. */
static void beside_road(double *s, double *t, double x, double y)
{
    const struct path *path = &road->path;
    size_t guess = 0, low = 0, best = 0;
    for (size_t jump = path->n / 2; jump > 0; jump = jump > 1 ? (jump + 1) / 2 : 0)
        if (guess + jump < path->n && path->point_m[guess + jump].x < x) guess += jump;
    low = guess > 80 ? guess - 80 : 0;
    double least = INFINITY;
    for (size_t i = low; i < path->n && i < guess + 80; i++) {
        double d = (path->point_m[i].x - x) * (path->point_m[i].x - x) + (path->point_m[i].y - y) * (path->point_m[i].y - y);
        if (d < least) {
            least = d;
            best = i;
        }
    }
    struct path_point at = path_at(path, path->s_m[best], 0);
    double dx = x - at.p_m.x, dy = y - at.p_m.y;
    *s = path->s_m[best] + dx * sin(at.heading_rad) + dy * cos(at.heading_rad);
    *t = -dx * cos(at.heading_rad) + dy * sin(at.heading_rad);
}

/* How much of an obstacle's height there is: walls that lean out by half a metre, as reconstructions have them. */
static double block(double along, double aside, double half_length, double half_width)
{
    double out = fmax(fabs(along) - half_length, fabs(aside) - half_width);
    return fmin(fmax(1 - out / 0.5, 0), 1);
}

/* Parked cars along the right edge, 5 m of every 6.5 between 20 and 85 m. */
static double car(double s, double t)
{
    if (s < 20 || s > 85) return 0;
    double along = fmod(s - 20, 6.5) - 3.25;
    return block(along, t + 2.4, 2.2, 0.8);
}

static bool is_crown(double s, double t)
{
    return hypot(s - 98, t) < 5 || hypot(s - 60, t - 5) < 3;
}

static bool is_hole(double s, double t)
{
    return hypot(s - 12, t - 1) < 2 || (s > 110 && s < 115) || hypot((s - 50) / 3, t - 1) < 0.7;
}

static char scratch[] = "ribbon-test.XXXXXX";

static char *write_place(void)
{
    double x0 = -8, y0 = -14;
    uint32_t columns = 680, rows = 180;
    float (*vertex)[3] = malloc((size_t)columns * rows * sizeof *vertex);
    bool *gone = calloc((size_t)columns * rows, sizeof *gone);
    for (uint32_t r = 0; r < rows; r++)
        for (uint32_t c = 0; c < columns; c++) {
            size_t i = (size_t)r * columns + c;
            double x = x0 + GRID_M * c, y = y0 + GRID_M * r, s, t;
            beside_road(&s, &t, x, y);
            double z = truth(s, t) + lumps(x, y) + 0.03 * normal_draw() + CAR_M * car(s, t);
            if (fabs(t) > ROAD_M / 2 + 0.3) z += 0.15 + 0.05 * normal_draw();
            if (is_crown(s, t)) z = truth(s, t) + CROWN_M + 0.3 * normal_draw();
            gone[i] = is_hole(s, t);
            vertex[i][0] = (float)x;
            vertex[i][1] = (float)y;
            vertex[i][2] = (float)z;
        }
    uint32_t (*triangle)[3] = malloc(2 * (size_t)columns * rows * sizeof *triangle);
    size_t triangles = 0;
    for (uint32_t r = 0; r + 1 < rows; r++)
        for (uint32_t c = 0; c + 1 < columns; c++) {
            uint32_t a = r * columns + c, q[4] = { a, a + 1, a + columns, a + columns + 1 };
            if (gone[q[0]] || gone[q[1]] || gone[q[2]] || gone[q[3]]) continue;
            memcpy(triangle[triangles++], (uint32_t[3]){ q[0], q[1], q[3] }, sizeof *triangle);
            memcpy(triangle[triangles++], (uint32_t[3]){ q[0], q[3], q[2] }, sizeof *triangle);
        }
    char *path = string_format("%s/place.ply", scratch);
    FILE *f = fopen(path, "wb");
    fprintf(f, "ply\nformat binary_little_endian 1.0\nelement vertex %u\nproperty float x\nproperty float y\nproperty float z\n"
            "element face %zu\nproperty list uchar int vertex_indices\nend_header\n", columns * rows, triangles);
    fwrite(vertex, sizeof *vertex, (size_t)columns * rows, f);
    for (size_t i = 0; i < triangles; i++) {
        fputc(3, f);
        fwrite(triangle[i], sizeof *triangle, 1, f);
    }
    fclose(f);
    free(triangle);
    free(gone);
    free(vertex);
    return path;
}

static const struct similarity identity = { 1, { { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } }, { 0, 0, 0 } };

static void check_heights(const struct ribbon *ribbon)
{
    double worst = 0, square = 0, worst_bend = 0, length = path_length(&road->path);
    for (size_t r = 0; r < ribbon->rows; r++)
        for (size_t c = 0; c < ribbon->columns; c++) {
            double s = length * (double)r / (double)(ribbon->rows - 1), step = length / (double)(ribbon->rows - 1);
            double t = ribbon->half_width_m * (2 * (double)c / (double)(ribbon->columns - 1) - 1);
            const double *z = &ribbon->height_m[r * ribbon->columns + c];
            double off = fabs(*z - truth(s, t));
            worst = fmax(worst, off);
            square += off * off;
            if (r == 0 || r + 1 == ribbon->rows) continue;
            double bend = (z[-(ptrdiff_t)ribbon->columns] - 2 * z[0] + z[ribbon->columns]) / (step * step);
            double want = (truth(s - step, t) - 2 * truth(s, t) + truth(s + step, t)) / (step * step);
            worst_bend = fmax(worst_bend, fabs(bend - want));
        }
    printf("# heights: rms %.4f m, worst %.4f m; bending off by %.4f /m at most; mesh rms %.3f m over %.0f %%\n",
           sqrt(square / (double)(ribbon->rows * ribbon->columns)), worst, worst_bend, ribbon->rms_m, 100 * ribbon->taken);
    OK(worst < 0.03, "under cars, crowns, holes and lumps the road is found within 3 cm everywhere");
    OK(worst_bend < 0.02, "it bends as the road does: no lump is left in it");
}

static void check_laid(struct static_mesh *mesh, const struct ribbon *ribbon, const float (*before)[3], size_t old_vertices)
{
    const float (*after)[3] = (const float (*)[3])static_mesh_vertices(mesh);
    const uint32_t (*triangle)[3] = static_mesh_triangles(mesh);
    double worst_step = 0, step_before = 0, beyond = 0, edge = ROAD_M / 2;
    for (size_t k = 0; k < 3 * static_mesh_triangle_count(mesh); k++) {
        uint32_t i = triangle[k / 3][k % 3], j = triangle[k / 3][(k + 1) % 3];
        if (i >= old_vertices || j >= old_vertices) continue;
        double si, ti, sj, tj;
        beside_road(&si, &ti, (double)after[i][0], (double)after[i][1]);
        if (fabs(ti) > edge + RIBBON_MARGIN_M + 0.01) beyond = fmax(beyond, fabs((double)(after[i][2] - before[i][2])));
        if (fabs(ti) > edge + 0.5 || fabs(ti) < edge - 0.5 || si < 0 || si > path_length(&road->path)) continue;
        beside_road(&sj, &tj, (double)after[j][0], (double)after[j][1]);
        if ((fabs(ti) <= edge) == (fabs(tj) <= edge)) continue;
        if (car(si, ti) > 0 || car(sj, tj) > 0 || is_crown(si, ti) || is_crown(sj, tj)) continue;
        double want = truth(si, ti) - truth(sj, tj);
        worst_step = fmax(worst_step, fabs((double)(after[i][2] - after[j][2]) - want));
        step_before = fmax(step_before, fabs((double)(before[i][2] - before[j][2]) - want));
    }
    printf("# step across the edge: %.3f m at most (%.3f m before)\n", worst_step, step_before);
    OK(worst_step < 0.03 && step_before > 0.1, "no step is left along the edge");
    NEAR(beyond, 0, 0, "beyond the margin nothing is touched");

    size_t asked = 0, missing = 0;
    double over = 0, under = 0;
    for (double s = 0.05; s < path_length(&road->path); s += 0.17)
        for (double t = -ROAD_M / 2 + 0.02; t < ROAD_M / 2; t += 0.11) {
            struct vec2 p = path_at(&road->path, s, t).p_m;
            double road_m, z;
            struct vec3 normal;
            if (!ribbon_at(ribbon, &road_m, &normal, p.x, p.y)) continue;
            asked++;
            if (!static_mesh_height(mesh, &z, p.x, p.y, road_m + 0.05) || road_m - z > 0.02) missing++;
            else {
                over = fmax(over, z - road_m);
                under = fmax(under, road_m - z);
            }
        }
    OK(asked > 20000 && missing == 0, "there is a road below all of it, holes and crowns included (%zu of %zu points missing)",
       missing, asked);
    printf("# laid: %.4f m over, %.4f m under the ribbon at most\n", over, under);
    OK(under < 0.012, "and it is the ribbon");

    struct vec2 roof = path_at(&road->path, 20 + 3.25, -2.4).p_m, crown = path_at(&road->path, 98, 0).p_m;
    double z;
    OK(static_mesh_height(mesh, &z, roof.x, roof.y, INFINITY) && fabs(z - truth(23.25, -2.4) - CAR_M) < 0.3,
       "a parked car still stands there");
    OK(static_mesh_height(mesh, &z, crown.x, crown.y, INFINITY) && fabs(z - truth(98, 0) - CROWN_M) < 1.2,
       "and the tree reaches over");
}

static void check_place(void)
{
    struct error err = ERROR_NONE;
    struct road_rules rules = { 0 };
    struct vec2 p[6] = { { 0, 0 }, { 25, 0 }, { 50, 8 }, { 75, 14 }, { 100, 8 }, { 118, -4 } };
    OK(roads_add(&place_roads, "road", ROAD_VEHICLES, p, 6, ROAD_M, false, &rules, &err), "a winding road");
    road = &place_roads.ways[0];
    char *path = write_place();
    struct static_mesh *mesh = NULL;
    struct ribbon ribbon = { 0 };
    if (!OK(static_mesh_load(&mesh, path, identity, &err), "a lumpy mesh of it")) {
        printf("# %s\n", err.text);
        return;
    }
    if (!OK(ribbon_fit(&ribbon, road, mesh, &err), "a ribbon is fitted")) {
        printf("# %s\n", err.text);
        return;
    }
    check_heights(&ribbon);
    size_t vertices = static_mesh_vertex_count(mesh);
    float (*before)[3] = malloc(vertices * sizeof *before);
    memcpy(before, static_mesh_vertices(mesh), vertices * sizeof *before);
    OK(ribbons_lay(mesh, &ribbon, 1, &err), "and laid");
    if (!OK(static_mesh_index(mesh, 0.2, &err), "the mesh is indexed")) return;
    check_laid(mesh, &ribbon, (const float (*)[3])before, vertices);
    free(before);
    ribbon_release(&ribbon);
    static_mesh_destroy(mesh);
    unlink(path);
    free(path);
    roads_release(&place_roads);
}

/* --- a plain of large triangles --- */

static struct static_mesh *plain(double half_m)
{
    struct error err = ERROR_NONE;
    struct static_mesh *mesh = NULL;
    char *path = string_format("%s/plain.ply", scratch);
    char *text = string_format("ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                               "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
                               "%g %g %g\n%g %g %g\n%g %g %g\n%g %g %g\n3 0 1 2\n3 0 2 3\n",
                               -half_m, -half_m, -0.05 * half_m, half_m, -half_m, 0.05 * half_m,
                               half_m, half_m, 0.05 * half_m, -half_m, half_m, -0.05 * half_m);
    OK(file_write(path, text, strlen(text), &err) && static_mesh_load(&mesh, path, identity, &err), "a plain (%s)", err.text);
    unlink(path);
    free(text);
    free(path);
    return mesh;
}

static void check_meeting(void)
{
    struct error err = ERROR_NONE;
    struct road_network roads = { 0 };
    struct road_rules rules = { 0 };
    struct static_mesh *mesh = plain(60);
    /* A hairpin narrower than itself, and a road that crosses both its legs. */
    struct vec2 hairpin[5] = { { -40, 0 }, { 0, 0 }, { 3, 2.5 }, { 0, 5 }, { -40, 5 } }, across[2] = { { -20, -30 }, { -16, 30 } };
    OK(roads_add(&roads, "hairpin", ROAD_VEHICLES, hairpin, 5, 7, false, &rules, &err)
       && roads_add(&roads, "across", ROAD_VEHICLES, across, 2, 5, false, &rules, &err), "a hairpin and a road across it");
    struct ribbon ribbons[2] = { 0 };
    for (size_t i = 0; i < 2; i++) OK(ribbon_fit(&ribbons[i], &roads.ways[i], mesh, &err), "fitted to the plain");
    /* As if they had not been told the same: the second lies 8 cm over the plain. */
    for (size_t i = 0; i < ribbons[1].rows * ribbons[1].columns; i++) ribbons[1].height_m[i] += 0.08;
    double worst_step = 0, worst = 0, z = 0, share_step = 0;
    for (double y = -12; y < 17; y += 0.25) {
        double last = 0, last_share = 0;
        for (double x = -41; x < 12; x += 0.02) {
            double share = ribbons_at(ribbons, 2, &z, x, y);
            if (share > 0 && last_share > 0) {
                worst_step = fmax(worst_step, fabs(z - last - 0.02 * 0.05));
                worst = fmax(worst, fabs(z - 0.05 * x));
            }
            if (x > -40.9) share_step = fmax(share_step, fabs(share - last_share));
            last = z;
            last_share = share;
        }
    }
    printf("# meeting: within %.3f m, steps of %.4f m in 2 cm\n", worst, worst_step);
    OK(worst < 0.085 && worst_step < 0.02, "where roads meet, or one meets itself, heights fade into each other");
    OK(share_step < 0.05, "and so does what is road");
    for (size_t i = 0; i < 2; i++) ribbon_release(&ribbons[i]);

    struct ribbon none = { 0 };
    struct vec2 away[2] = { { 40, 50 }, { 400, 90 } };
    OK(roads_add(&roads, "away", ROAD_VEHICLES, away, 2, 5, false, &rules, &err), "a road that leaves the plain");
    OK(!ribbon_fit(&none, &roads.ways[2], mesh, &err) && err.code == ERR_INPUT && !none.height_m
       && !strcmp(err.text, "away: only 21 of its 362 m lie over the mesh of the place; a fifth is the least to tell its height by"),
       "is refused: %s", err.text);
    static_mesh_destroy(mesh);
    roads_release(&roads);
}

/* --- brighton --- */

static void check_brighton(void)
{
    const char *shared = tap_shared();
    if (!shared) {
        SKIP("the roads of brighton", "no shared material");
        return;
    }
    /* By Umeyama's method from the GPS positions of the 18 photographs (numpy; rms 0.60 m). */
    struct similarity enu_from_mesh = { 8.342199947168627,
                                        { { { 0.75245874, -0.6586377, -0.00149254 },
                                            { -0.65670324, -0.7504185, 0.07491951 },
                                            { -0.05046484, -0.05539368, -0.99718847 } } },
                                        { -0.48103779, 9.06332332, -0.98946242 } };
    enu_from_mesh.rotation = mat3_orthonormalize(enu_from_mesh.rotation);
    struct error err = ERROR_NONE;
    struct road_network roads = { 0 };
    struct road_rules rules = { .origin = { 46.8426 * M_PI / 180, -91.9940 * M_PI / 180, 200 } };
    const struct vec2 keep[2] = { { -200, -200 }, { 200, 200 } };
    char *osm = string_format("%s/data/brighton/roads.osm", shared), *ply = string_format("%s/data/brighton/mesh.ply", shared);
    struct static_mesh *mesh = NULL;
    struct ribbon ribbons[3] = { 0 };
    if (!OK(roads_read_osm(&roads, osm, &rules, keep, &err) && roads.way_count == 3
            && static_mesh_load(&mesh, ply, enu_from_mesh, &err), "brighton's mesh and roads (%s)", err.text))
        return;
    for (size_t i = 0; i < 3; i++) {
        OK(ribbon_fit(&ribbons[i], &roads.ways[i], mesh, &err), "brighton: a ribbon along %s", roads.ways[i].name);
        printf("# %s: rms %.3f m to the mesh, %.1f %% of it taken for road\n", roads.ways[i].name, ribbons[i].rms_m,
               100 * ribbons[i].taken);
        OK(ribbons[i].rms_m < 0.03 && ribbons[i].taken > 0.95, "brighton: near the mesh: its lumps are of 2 cm");
    }
    OK(ribbons_lay(mesh, ribbons, 3, &err) && static_mesh_index(mesh, 0.2, &err), "brighton: laid");
    size_t asked = 0, off = 0;
    for (size_t i = 0; i < 3; i++)
        for (double s = 0; s < path_length(&roads.ways[i].path); s += 0.31)
            for (double t = -ribbons[i].half_width_m + 0.01; t < ribbons[i].half_width_m; t += 0.23) {
                struct vec2 p = path_at(&roads.ways[i].path, s, t).p_m;
                double road_m, z;
                if (ribbons_at(ribbons, 3, &road_m, p.x, p.y) < 1) continue;
                asked++;
                /* What stands on the road may begin to rise there: only what is missing counts. */
                if (!static_mesh_height(mesh, &z, p.x, p.y, road_m + 0.05) || road_m - z > 0.01) off++;
            }
    OK(asked > 5000 && off == 0, "brighton: where entities stand, shadows fall (%zu of %zu points have no ground)", off, asked);
    for (size_t i = 0; i < 3; i++) ribbon_release(&ribbons[i]);
    static_mesh_destroy(mesh);
    roads_release(&roads);
    free(osm);
    free(ply);
}

int main(void)
{
    if (!OK(mkdtemp(scratch) != NULL, "a scratch folder")) return tap_done();
    check_place();
    check_meeting();
    check_brighton();
    rmdir(scratch);
    return tap_done();
}
