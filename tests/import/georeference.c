#include "import/control_points.h"
#include "import/focal.h"
#include "import/georeference.h"
#include "import/gps_ties.h"
#include "import/svd.h"
#include "lib/file.h"

#include "tests/tap.h"

#include <stdint.h>
#include <unistd.h>

#define DEG (M_PI / 180)

/* ---- made-up flights ---- */

static uint64_t state;

static double uniform(void)
{
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (double)(state >> 11) * 0x1p-53;
}

static double normal(double deviation)
{
    double radius = sqrt(-2 * log(1 - uniform()));
    return deviation * radius * cos(2 * M_PI * uniform());
}

static const struct similarity truth = {
    .scale = 8.25,
    .rotation = { { { 0, -1, 0 }, { -0.6, 0, 0.8 }, { -0.8, 0, -0.6 } } },
    .translation = { 120, -75, 310 },
};

/* p = (R^T (q - t)) / s */
static struct vec3 in_reconstruction(struct vec3 enu)
{
    struct vec3 p = mat3_apply(mat3_transpose(truth.rotation), vec3_sub(enu, truth.translation));
    return vec3_scale(p, 1 / truth.scale);
}

#define FLIGHT_MAX 300
static char names[FLIGHT_MAX][16];
static struct tie ties[FLIGHT_MAX];

/* Positions all over a box, with noise in what is given as their place. */
static void fly(size_t n, struct vec3 box_m, double noise_m)
{
    for (size_t i = 0; i < n; i++) {
        struct vec3 q = { box_m.x * (uniform() - 0.5), box_m.y * (uniform() - 0.5), 40 + box_m.z * (uniform() - 0.5) };
        snprintf(names[i], sizeof names[i], "P%03zu.JPG", i);
        struct vec3 noise = { normal(noise_m), normal(noise_m), normal(noise_m) };
        ties[i] = (struct tie){ names[i], in_reconstruction(q), vec3_add(q, noise) };
    }
}

static double angle_rad(struct mat3 a, struct mat3 b)
{
    struct quat q = quat_from_mat3(mat3_multiply(a, mat3_transpose(b)));
    return 2 * asin(fmin(1, sqrt(q.x * q.x + q.y * q.y + q.z * q.z)));
}

/* Farthest that a corner of the flight's box, on the ground or at the camera's height, is put wrong. */
static double worst_place_m(const struct similarity *s, double half_x_m, double half_y_m)
{
    double worst = 0;
    for (int corner = 0; corner < 8; corner++) {
        struct vec3 q = { corner & 1 ? half_x_m : -half_x_m, corner & 2 ? half_y_m : -half_y_m, corner & 4 ? 40 : 0 };
        worst = fmax(worst, vec3_norm(vec3_sub(similarity_apply(*s, in_reconstruction(q)), q)));
    }
    return worst;
}

static struct similarity found;
static struct tie_residual residuals[FLIGHT_MAX];
static double rms_m;
static struct error err;

static bool georeference(size_t n, double inlier_m)
{
    err = ERROR_NONE;
    return georeference_ties(&found, residuals, &rms_m, ties, n, inlier_m, &err);
}

static bool refused(size_t n, double inlier_m, const char *because)
{
    bool good = georeference(n, inlier_m);
    if (good || err.code != ERR_INPUT || !strstr(err.text, because)) {
        printf("# %s\n", good ? "accepted" : err.text);
        return false;
    }
    return true;
}

static void check_svd(void)
{
    double worst = 0, apart = 0;
    bool ordered = true;
    for (int t = 0; t < 200; t++) {
        struct mat3 a, u, v;
        double d[3];
        for (int i = 0; i < 9; i++) a.m[i / 3][i % 3] = normal(1);
        if (t % 4 == 1) /* of rank 2 */
            for (int i = 0; i < 3; i++) a.m[i][2] = a.m[i][0] - 2 * a.m[i][1];
        if (t % 4 == 2) /* of rank 1 */
            for (int i = 0; i < 9; i++) a.m[i / 3][i % 3] = (1 + i / 3) * (i % 3 - 0.5);
        if (t == 3) a = (struct mat3){ { { 0 } } };
        svd3(&u, d, &v, a);
        ordered = ordered && d[0] >= d[1] && d[1] >= fabs(d[2]);
        struct mat3 ud = mat3_from_columns(vec3_scale(mat3_column(u, 0), d[0]), vec3_scale(mat3_column(u, 1), d[1]),
                                           vec3_scale(mat3_column(u, 2), d[2]));
        struct mat3 back = mat3_multiply(ud, mat3_transpose(v));
        for (int i = 0; i < 9; i++) worst = fmax(worst, fabs(back.m[i / 3][i % 3] - a.m[i / 3][i % 3]));
        apart = fmax(apart, fmax(fabs(mat3_determinant(u) - 1), fabs(mat3_determinant(v) - 1)));
        apart = fmax(apart, fmax(mat3_orthonormality(u), mat3_orthonormality(v)));
    }
    NEAR(worst, 0, 1e-13, "singular values: the factors give the matrix, of rank 3, 2, 1 and 0");
    NEAR(apart, 0, 1e-13, "singular values: both outer factors are rotations");
    OK(ordered, "singular values: come in order");
}

static void check_exact(void)
{
    fly(12, vec3(120, 80, 20), 0);
    OK(georeference(12, 3), "exact positions are taken");
    NEAR(found.scale, truth.scale, 1e-9, "exact: the scale");
    NEAR(angle_rad(found.rotation, truth.rotation), 0, 1e-9, "exact: the rotation");
    NEAR(worst_place_m(&found, 60, 40), 0, 1e-8, "exact: every place");
    NEAR(rms_m, 0, 1e-9, "exact: no residual");

    fly(12, vec3(120, 80, 0), 0);
    OK(georeference(12, 3) && worst_place_m(&found, 60, 40) < 1e-8, "positions at one height are enough");

    fly(12, vec3(120, 80, 20), 0);
    for (size_t i = 0; i < 12; i++) ties[i].p_reconstruction.x *= -1;
    OK(refused(12, 1, "contradict"), "a mirrored reconstruction fits nothing");

    fly(3, vec3(0, 0, 0), 0);
    struct vec3 corners[] = { { 0, 0, 10 }, { 80, 0, 12 }, { 0, 60, 11 } };
    for (size_t i = 0; i < 3; i++) {
        ties[i].p_enu_m = corners[i];
        ties[i].p_reconstruction = in_reconstruction(corners[i]);
    }
    OK(georeference(3, 3) && angle_rad(found.rotation, truth.rotation) < 1e-9, "a triangle is enough");
}

/* 30 of 100 positions are wrong by 15 to 200 m; the others by 0.4 m in each axis. */
static void check_outliers(size_t n, const char *what)
{
    double worst_m = 0, worst_rad = 0, worst_scale = 0, worst_rms = 0;
    bool good = true, told = true;
    size_t bad = n * 3 / 10;
    /* seven numbers are fitted to three a position */
    double freedom = 3 * (double)(n - bad) - 7, expected_rms_m = 0.4 * sqrt(freedom / (double)(n - bad));
    for (int flight = 0; flight < 10; flight++) {
        fly(n, vec3(120, 80, 15), 0.4);
        for (size_t i = 0; i < bad; i++) {
            struct vec3 away = vec3_unit(vec3(normal(1), normal(1), normal(1)));
            struct tie *tie = &ties[(i * 7 + 3) % n];
            tie->p_enu_m = vec3_add(tie->p_enu_m, vec3_scale(away, 15 + 185 * uniform()));
            tie->name = "wrong";
        }
        good = good && georeference(n, 2.5);
        for (size_t i = 0; i < n; i++) told = told && residuals[i].inlier == (strcmp(ties[i].name, "wrong") != 0);
        worst_m = fmax(worst_m, worst_place_m(&found, 60, 40));
        worst_rad = fmax(worst_rad, angle_rad(found.rotation, truth.rotation));
        worst_scale = fmax(worst_scale, fabs(found.scale / truth.scale - 1));
        worst_rms = fmax(worst_rms, fabs(rms_m - expected_rms_m));
    }
    OK(good && told, "%s: exactly the wrong positions are told apart, in ten flights", what);
    /* 0.4 m over the root of the good positions' number is the mean's deviation; their spread is 35 m by 23 m.
     * Corners lie twice as far out, and 40 m below: a deviation of 4 means. */
    double mean_m = 0.4 / sqrt((double)n * 0.7);
    NEAR(worst_rad, 0, 4 * mean_m / 23, "%s: rotation within %.2f deg", what, 4 * mean_m / 23 / DEG);
    NEAR(worst_scale, 0, 4 * mean_m / 35, "%s: scale within %.2g %%", what, 400 * mean_m / 35);
    NEAR(worst_m, 0, 16 * mean_m, "%s: every place within %.2f m", what, 16 * mean_m);
    NEAR(worst_rms, 0, 3.5 * expected_rms_m / sqrt(2 * freedom), "%s: the stated rms is the noise's", what);
    struct similarity first = found;
    georeference(n, 2.5);
    OK(!memcmp(&first, &found, sizeof found), "%s: the same every time, to the last bit", what);
}

static void check_few(void)
{
    fly(3, vec3(100, 100, 0), 0);
    struct similarity before = found;
    OK(refused(0, 3, "0 positions are given"), "none is too few");
    OK(refused(1, 3, "1 position is given, P000.JPG: "), "one is too few, and is named");
    OK(refused(2, 3, "P000.JPG and P001.JPG"), "two are too few, and are named");
    OK(!memcmp(&before, &found, sizeof found), "a refusal leaves the result alone");
    ties[1].p_enu_m.z = NAN;
    OK(refused(3, 3, "P001.JPG is not finite"), "a position that is no number is named");
}

/* A flight along one line that strays from it by `across_m`, noise as GPS has it. */
static void fly_line(size_t n, double across_m, double noise_m)
{
    fly(n, vec3(0, 0, 0), 0);
    for (size_t i = 0; i < n; i++) {
        double t = (double)i / (double)(n - 1) - 0.5;
        struct vec3 q = { 140 * t, 60 * t + (i % 2 ? across_m : -across_m) / 2, 40 };
        ties[i].p_reconstruction = in_reconstruction(q);
        ties[i].p_enu_m = vec3_add(q, vec3(normal(noise_m), normal(noise_m), normal(noise_m)));
    }
}

static void check_lines(void)
{
    fly_line(18, 0, 0);
    OK(refused(18, 3, "18 of them spread over 152 m along and 0 m across"), "an exact line is refused, with its spread");
    OK(refused(18, 3, "is not determined at all"), "of an exact line, the turn about it is not known at all");
    int taken = 0;
    for (int i = 0; i < 10; i++) {
        fly_line(18, 0, 0.5);
        taken += georeference(18, 3);
    }
    OK(taken == 0 && strstr(err.text, "on one line"), "noise of GPS does not make a line an area, in ten flights");
    fly_line(18, 0.6, 0.5);
    OK(refused(18, 3, "m across"), "0.6 m across with a noise of 0.5 m does not settle the turn");
    bool good = true;
    double worst = 0;
    for (int i = 0; i < 10; i++) {
        fly_line(18, 12, 0.5);
        good = good && georeference(18, 3);
        worst = fmax(worst, angle_rad(found.rotation, truth.rotation));
    }
    OK(good && worst < 4.5 * DEG, "12 m across with a noise of 0.5 m does, to %.1f deg in ten flights", worst / DEG);
    fly_line(18, 0.6, 0.005);
    OK(georeference(18, 0.03) && angle_rad(found.rotation, truth.rotation) < 1.5 * DEG, "so do 0.6 m with a noise of 5 mm");

    fly_line(18, 0, 0.3);
    ties[4].p_enu_m = vec3_add(ties[4].p_enu_m, vec3(-20, 50, 0));
    OK(refused(18, 3, "17 of them"), "a wrong position beside a line does not make it an area");
    fly(9, vec3(0.4, 0.4, 0.4), 0.5);
    OK(refused(9, 3, "at one point"), "a drone that hovers is refused");
}

static void check_contradiction(void)
{
    fly(12, vec3(100, 80, 10), 0.2);
    for (size_t i = 0; i < 7; i++) ties[i].p_enu_m = vec3(500 * uniform(), 500 * uniform(), 90 * uniform());
    OK(refused(12, 2, "of 12 agree within 2 m"), "positions of which most are wrong are refused");
    OK(strstr(err.text, "P000.JPG (") && strstr(err.text, "P006.JPG (") && !strstr(err.text, "P009.JPG"),
       "and those are named with how far they are off, the good ones not");
    fly(60, vec3(100, 80, 10), 0.2);
    for (size_t i = 0; i < 60; i++) ties[i].p_enu_m = vec3(500 * uniform(), 500 * uniform(), 90 * uniform());
    OK(refused(60, 2, "more"), "of many, some are named and the rest counted");
    OK(refused(60, 0, "above 0"), "an allowance of 0 is refused");
}

/* ---- GPS of a flight ---- */

static void check_gps(void)
{
    struct recon_shot shots[4] = {
        { .image = "a.jpg", .camera_from_world_q = { 1, 0, 0, 0 }, .camera_from_world_t = { -1, -2, -3 } },
        { .image = "b.jpg", .camera_from_world_q = { 0, 2, 0, 0 }, .camera_from_world_t = { 4, 5, 6 } },
        { .image = "c.jpg", .camera_from_world_q = { 1, 0, 0, 0 } },
        { .image = "d.jpg", .camera_from_world_q = { 1, 0, 0, 0 } },
    };
    struct reconstruction flight = { .shots = shots, .shot_count = 4 };
    struct photo_facts facts[4] = {
        { .lat_lon_h = { 0 } },
        { .has_position = true, .has_height = true, .lat_lon_h = { 47, 8, 500 } },
        { .has_position = true, .has_height = true, .lat_lon_h = { 47.01, 8.02, 520 } },
        { .has_position = true, .lat_lon_h = { 47, 8, 0 } },
    };
    struct tie *got = NULL;
    size_t n = 0;
    double origin[3] = { 1, 2, 3 };
    err = ERROR_NONE;
    OK(!gps_ties(&got, &n, origin, &flight, facts, &err) && err.code == ERR_INPUT && strstr(err.text, "2 of 4 photographs")
           && strstr(err.text, "1 have latitude and longitude but no altitude") && strstr(err.text, "control points")
           && strstr(err.text, "one known distance") && origin[0] == 1,
       "too few photographs with GPS: how many have it, and what else can be given");
    facts[3].has_height = true;
    facts[3].lat_lon_h[2] = 510;
    err = ERROR_NONE;
    bool good = gps_ties(&got, &n, origin, &flight, facts, &err);
    OK(good && n == 3 && origin[0] == 47 && origin[1] == 8 && origin[2] == 500, "three are enough, the first is the origin");
    OK(good && !strcmp(got[0].name, "b.jpg") && vec3_norm(got[0].p_enu_m) < 1e-9
           && vec3_norm(vec3_sub(got[0].p_reconstruction, vec3(-4, 5, 6))) < 1e-12,
       "a shot's tie is its centre and its place");
    OK(good && vec3_norm(vec3_sub(got[1].p_enu_m, vec3(1520.9598723, 1111.9942852, 19.7219355))) < 1e-6,
       "places become east, north and up"); /* the figures of tests/lib/place.c, computed apart from GeographicLib */
    free(got);
}

static void check_focal(void)
{
    struct recon_camera cameras[2] = { { .camera = { CAMERA_PINHOLE, 2000, 1500, { 1111, 1111, 1000, 750 } } },
                                       { .camera = { CAMERA_SIMPLE_PINHOLE, 1500, 2000, { 1400, 750, 1000 } } } };
    struct recon_shot shots[3] = { { .camera = 0 }, { .camera = 0 }, { .camera = 1 } };
    struct reconstruction flight = { .cameras = cameras, .shots = shots, .camera_count = 2, .shot_count = 3 };
    struct photo_facts facts[3] = { { .focal_35mm = 0 } };
    struct focal_check check = { 0 };
    OK(!focal_differs(&check, &flight, facts), "lens: where EXIF says nothing, nothing differs");
    for (int i = 0; i < 3; i++) facts[i].focal_35mm = 20;
    OK(!focal_differs(&check, &flight, facts), "lens: 1111 px of 2000 are 20 mm of 36; a single shot does not count");
    shots[1].camera = 1;
    OK(focal_differs(&check, &flight, facts) && fabs(check.reconstruction_mm - 25.2) < 1e-9 && check.exif_mm == 20,
       "lens: 1400 px of 2000 upright are 25.2 mm, too long for 20");
    cameras[1].camera.params[0] = 900;
    OK(focal_differs(&check, &flight, facts), "lens: 900 px are too short");
}

/* ---- one distance ---- */

/* Rows: right, down, forward; up is (0.6, 0, 0.8). */
static const struct vec3 up = { 0.6, 0, 0.8 };

static struct recon_shot shot_towards(struct vec3 forward, struct vec3 top)
{
    struct vec3 z = vec3_unit(forward);
    struct vec3 x = vec3_unit(vec3_cross(z, top)), y = vec3_cross(z, x);
    struct mat3 rotation = mat3_transpose(mat3_from_columns(x, y, z));
    return (struct recon_shot){ .image = "shot", .camera_from_world_q = quat_from_mat3(rotation) };
}

static void check_distance(void)
{
    struct vec3 east = { 0.8, 0, -0.6 }, north = { 0, 1, 0 };
    struct recon_shot shots[12];
    struct reconstruction flight = { .shots = shots, .shot_count = 12 };
    for (int i = 0; i < 12; i++) {
        double a = i * 20 * DEG;
        struct vec3 level = vec3_add(vec3_scale(north, cos(a)), vec3_scale(east, sin(a)));
        struct vec3 tilted = vec3_add(level, vec3_scale(up, -0.1 * (i % 4)));
        struct vec3 top = vec3_add(up, vec3_scale(vec3(normal(1), normal(1), normal(1)), 0.02));
        shots[i] = shot_towards(tilted, i ? top : up);
    }
    struct similarity s = { 0 };
    struct upright upright = { 0 };
    const struct vec3 p[2] = { { 1, 2, 3 }, { 1, 2, 3.5 } };
    err = ERROR_NONE;
    bool good = georeference_distance(&s, &upright, &flight, p, 4, &err);
    OK(good && !upright.by_points, "cameras that look about tell where up is");
    NEAR(s.scale, 8, 1e-12, "the known distance gives the scale");
    NEAR(acos(vec3_dot(mat3_apply(s.rotation, up), vec3(0, 0, 1))), 0, 1.5 * DEG, "up is up, of cameras held by hand");
    OK(vec3_norm(similarity_apply(s, p[0])) < 1e-12, "the first point is the origin");
    struct vec3 ahead = mat3_apply(s.rotation, north);
    OK(ahead.y > 0.999 && mat3_determinant(s.rotation) > 0.999, "the first shot looks along y");
    OK(upright.spread_rad > 0.1 * DEG && upright.spread_rad < 3 * DEG, "how far the cameras are rolled is stated (%.1f deg)",
       upright.spread_rad / DEG);

    /* straight down, all the same way round: cameras tell nothing, the ground does, trees or not */
    struct vec3 points[400];
    for (int i = 0; i < 400; i++) {
        double high = i % 4 ? normal(0.02) : 2 * uniform();
        points[i] = vec3_add(vec3_add(vec3_scale(east, 10 * uniform()), vec3_scale(north, 6 * uniform())), vec3_scale(up, high));
    }
    for (int i = 0; i < 12; i++) shots[i] = shot_towards(vec3_scale(up, -1), north);
    flight.points = points;
    flight.point_count = 400;
    good = georeference_distance(&s, &upright, &flight, p, 4, &err);
    OK(good && upright.by_points, "cameras that all look down do not: the points' plane does");
    NEAR(acos(vec3_dot(mat3_apply(s.rotation, up), vec3(0, 0, 1))), 0, 0.7 * DEG, "up is up, a quarter of the points being trees");
    OK(mat3_apply(s.rotation, north).y > 0.999, "north is the top of the first picture");

    flight.point_count = 2;
    OK(!georeference_distance(&s, &upright, &flight, p, 4, &err) && strstr(err.text, "where up is"),
       "without points they tell nothing, which is said");
    for (int i = 0; i < 400; i++) points[i] = vec3(uniform(), uniform(), uniform());
    flight.point_count = 400;
    err = ERROR_NONE;
    OK(!georeference_distance(&s, &upright, &flight, p, 4, &err) && strstr(err.text, "near no plane"), "points all over are no plane");
    err = ERROR_NONE;
    OK(!georeference_distance(&s, &upright, &flight, p, -4, &err) && strstr(err.text, "-4 m"), "a negative distance is refused");
    err = ERROR_NONE;
    OK(!georeference_distance(&s, &upright, &flight, (struct vec3[2]){ p[0], p[0] }, 4, &err) && strstr(err.text, "are one"),
       "two points that are one are refused");
}

/* ---- control points ---- */

static char path[] = "control-points-XXXXXX";

static bool read_text(struct tie **got, size_t *n, double origin[3], const char *text)
{
    struct error ignored = ERROR_NONE;
    err = ERROR_NONE;
    return file_write(path, text, strlen(text), &ignored) && control_points_read(got, n, origin, path, &err);
}

static const struct { const char *what, *text; int line, column; const char *says; } bad_files[] = {
    { "a missing height", "# all\nA 1 2 3 47 8 500\nB 1 2 3 47 8 \n", 2 + 1, 13, "HEIGHT is missing" },
    { "a name alone", "church\n", 1, 7, "X is missing" },
    { "a field too many", "A 1 2 3 47 8 500 7\n", 1, 18, "\"7\" is one field too many" },
    { "a name with a blank", "the church 1 2 3 47 8 500", 1, 23, "a name has no blanks" },
    { "a word for a number", "A 1 2 3,5 47 8 500", 1, 7, "Z is \"3,5\"" },
    { "no finite number", "A 1 2 3 47 8 inf", 1, 14, "HEIGHT is \"inf\"" },
    { "a latitude of 97", "\n\nA 1 2 3 97 8 500", 3, 9, "-90 to 90 deg, north positive" },
    { "a longitude of 188", "A 1 2 3 47 188 500", 1, 12, "-180 to 180 deg, east positive" },
    { "a name twice", "A 1 2 3 47 8 500\n  A 1 2 3 47 8 500\n", 2, 3, "there is a point \"A\" above" },
    { "an empty file", "", 0, 0, "no control point" },
    { "comments only", "# A 1 2 3 47 8 500\n", 0, 0, "no control point" },
};

static void check_control_points(void)
{
    int file = mkstemp(path);
    if (file >= 0) close(file);
    struct tie *got = NULL;
    size_t n = 0;
    double origin[3] = { 0 };
    bool good = read_text(&got, &n, origin, "# name x y z lat lon h\nroof\t1.5 -2 3e1 47 8 500 # corner\r\n\nB 0 0 0 47.01 8.02 520");
    OK(good && n == 2 && origin[0] == 47 && origin[1] == 8 && origin[2] == 500, "points are read, the first is the origin");
    OK(good && !strcmp(got[0].name, "roof") && got[0].p_reconstruction.x == 1.5 && got[0].p_reconstruction.y == -2
           && got[0].p_reconstruction.z == 30 && vec3_norm(got[0].p_enu_m) < 1e-9, "a point has its name and coordinates");
    OK(good && vec3_norm(vec3_sub(got[1].p_enu_m, vec3(1520.9598723, 1111.9942852, 19.7219355))) < 1e-6,
       "its place becomes east, north and up");
    control_points_release(got, n);
    for (size_t i = 0; i < sizeof bad_files / sizeof *bad_files; i++) {
        got = NULL;
        good = read_text(&got, &n, origin, bad_files[i].text);
        OK(!good && !got && err.code == ERR_INPUT && err.line == bad_files[i].line && err.column == bad_files[i].column
               && !strcmp(err.file, path) && strstr(err.text, bad_files[i].says), "control points: %s is an error at its place",
           bad_files[i].what);
        if (err.line != bad_files[i].line || err.column != bad_files[i].column || !strstr(err.text, bad_files[i].says))
            printf("# %d:%d: %s\n", err.line, err.column, err.text);
    }
    unlink(path);
    err = ERROR_NONE;
    OK(!control_points_read(&got, &n, origin, path, &err) && !strcmp(err.file, path), "a file that is missing is named");
}

int main(void)
{
    check_svd();
    check_exact();
    check_outliers(20, "6 wrong of 20");
    check_outliers(200, "60 wrong of 200");
    check_few();
    check_lines();
    check_contradiction();
    check_gps();
    check_focal();
    check_distance();
    check_control_points();
    return tap_done();
}
