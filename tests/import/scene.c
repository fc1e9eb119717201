#include "import/path_from.h"
#include "import/scene_yaml.h"

#include "gen/scene/scene.h"
#include "tests/import/scratch.h"

/* The scene file of a flight as the program writes it. Out: *flight, the caller's; NULL on failure. */
static char *import(struct reconstruction *flight, struct imported *in, const char *source,
                    const struct placement_request *request, const char *images, struct error *err)
{
    char *text = NULL, *scene = string_format("%s/scene.yaml", scratch);
    struct photographs photographs = { 0 };
    struct placement placement = { 0 };
    in->tool = "COLMAP";
    in->reconstruction = flight;
    in->photographs = &photographs;
    in->placement = &placement;
    if (!colmap_read(flight, source, err)) goto out;
    if (!photographs_find(&photographs, flight, scene, source, images, err) ||
        !placement_find(&placement, flight, photographs.facts, request, err) || !scene_yaml_write(&text, in, err))
        reconstruction_release(flight);
out:
    if (!text) printf("# %s: %s\n", err->file, err->text);
    placement_release(&placement);
    photographs_release(&photographs);
    in->photographs = NULL;
    in->placement = NULL;
    free(scene);
    return text;
}

/* What a user does: takes the # away from a key, and nothing else. */
static void uncomment(char *text, const char *section)
{
    char *at = strstr(text, section);
    if (OK(at, "there is an example: %s", section)) memmove(at, at + 1, strlen(at + 1) + 1);
}

static struct scene *read_scene(const char *text)
{
    struct error err = ERROR_NONE;
    struct scene *scene = NULL;
    scratch_text("scene.yaml", text);
    char *path = string_format("%s/scene.yaml", scratch);
    if (!scene_read(&scene, path, NULL, &err)) printf("# %s:%d:%d: %s\n", err.file, err.line, err.column, err.text);
    free(path);
    return scene;
}

/* How far observations lie from the points, moved into the world, through the scene's own cameras. */
static void reproject(double *rms_px, double *mean_px, const struct scene *scene, const struct reconstruction *flight)
{
    double squares = 0, sum = 0;
    for (size_t i = 0; i < flight->observation_count; i++) {
        const struct recon_observation *o = &flight->observations[i];
        const struct scene_shot *shot = &scene->shots[o->shot];
        struct error err = ERROR_NONE;
        struct vec2 q = { NAN, NAN };
        struct vec3 p = similarity_apply(scene->static_.world_from_mesh, flight->points[o->point]);
        camera_project(&scene->cameras[shot->camera].camera, &q, pose_apply(pose_inverse(shot->world_from_camera), p), &err);
        squares += (q.x - o->q_px.x) * (q.x - o->q_px.x) + (q.y - o->q_px.y) * (q.y - o->q_px.y);
        sum += hypot(q.x - o->q_px.x, q.y - o->q_px.y);
    }
    *rms_px = sqrt(squares / (double)flight->observation_count);
    *mean_px = sum / (double)flight->observation_count;
}

/* Three cameras 10 units up that look down and about, and a point that each sees in its middle. */
static void write_flight(void)
{
    struct error err = ERROR_NONE;
    char *data, *street = string_format("%s/tests/input/street.png", getenv("top_srcdir") ? getenv("top_srcdir") : ".");
    size_t size;
    if (!file_read(&data, &size, street, &err)) return;
    scratch_put("a.png", data, size);
    scratch_put("no.png", data, size);
    scratch_put("it's #2: \"x\".png", data, size);
    free(data);
    free(street);
    scratch_text("cameras.txt", "1 PINHOLE 64 48 50 50.1 32 24\n");
    scratch_text("images.txt", "1 0 1 0 0 -1 0 10 1 a.png\n32 24 1\n2 0 1 0 0 -3 4 10 1 no.png\n32 24 2\n"
                               "3 0 0.70710678118654757 0.70710678118654757 0 3 -2 10 1 it's #2: \"x\".png\n32 24 3\n");
    scratch_text("points3D.txt", "1 1 0 0 0 0 0 0\n2 3 4 0 0 0 0 0\n3 2 -3 0 0 0 0 0\n");
}

static void a_flight_by_distance(void)
{
    write_flight();
    struct reconstruction flight = { 0 };
    struct imported in = { .mesh = NULL };
    struct error err = ERROR_NONE;
    const struct placement_request request = { .way = PLACEMENT_DISTANCE, .p = { { 1, 0, 0 }, { 4, 4, 0 } }, .distance_m = 20 };
    char *text = import(&flight, &in, scratch, &request, NULL, &err);
    if (!OK(text, "a flight without GPS is imported by one distance")) return;
    OK(strstr(text, "\n#static:\n") && strstr(text, "\n#    scale: 4\n"), "without a mesh its scale is there as a comment");
    uncomment(text, "#ground:");
    uncomment(text, "#light:");
    char *sky = strstr(text, "light: {sky: clear"), *roads = strstr(text, "#exposure: {roads: true}");
    if (sky) memcpy(sky, "light: {sky: overcast} #", 24);
    if (roads) memcpy(roads, "exposure: {value: 1}   #", 24);
    struct scene *scene = read_scene(text);
    free(text);
    if (OK(scene, "and read as a scene")) {
        OK(scene->shot_count == 3 && !scene->has_place && !scene->has_time && scene->camera_count == 1, "three shots of one camera, no place, no times");
        OK(strstr(scene->shots[1].photograph, "it's #2: \"x\".png") && strstr(scene->shots[2].photograph, "no.png"), "a name with quotes and #, and one that YAML could take for another thing");
        const double *p = scene->cameras[0].camera.params;
        OK(p[0] == 50 && p[1] == 50.1 && p[2] == 32 && p[3] == 24, "the lens, to the last bit");
        for (size_t i = 0; i < 3; i++) NEAR(scene->shots[i].world_from_camera.translation.z, 40, 1e-9, "10 units at 4 m a unit up: 40 m");
        double apart = vec3_norm(vec3_sub(scene->shots[0].world_from_camera.translation, scene->shots[2].world_from_camera.translation));
        NEAR(apart, 4 * hypot(2, 4), 1e-9, "cameras are as far apart, in metres");
        scene_destroy(scene);
    }
    reconstruction_release(&flight);

    const struct placement_request gps = { .way = PLACEMENT_DEFAULT };
    err = ERROR_NONE;
    OK(!import(&flight, &in, scratch, &gps, NULL, &err) && strstr(err.text, "0 of 3 photographs have a GPS position"), "photographs without GPS are refused by what they lack");
    err = ERROR_NONE;
    OK(!import(&flight, &in, scratch, &request, "/", &err) && !strcmp(err.file, "//a.png"), "a photograph that is missing is named: %s", err.file);
    scratch_empty();
}

/* Control points that were made by a known similarity: scale 3, a turn by 90 deg about up, about 46.8 N 92 W. */
static void a_flight_by_control_points(void)
{
    write_flight();
    /* 1 arc second of latitude and longitude there, m, by the WGS 84 radii of curvature at 46.8 deg. */
    const double f = 1 / 298.257223563, a = 6378137, e2 = f * (2 - f), phi = 46.8 * M_PI / 180;
    const double w2 = 1 - e2 * sin(phi) * sin(phi), prime = a / sqrt(w2), meridian = a * (1 - e2) / (w2 * sqrt(w2));
    static const double at[4][3] = { { 0, 0, 0 }, { 10, 0, 1 }, { 0, 12, -1 }, { 9, 8, 2 } };
    char points[1024] = "# four\n";
    for (int i = 0; i < 4; i++) {
        double east = -3 * at[i][1], north = 3 * at[i][0], up = 3 * at[i][2];
        sprintf(points + strlen(points), "p%d %g %g %g %.12f %.12f %.6f\n", i, at[i][0], at[i][1], at[i][2],
                46.8 + north / (meridian + 200) * 180 / M_PI, -92 + east / ((prime + 200) * cos(phi)) * 180 / M_PI, 200 + up);
    }
    scratch_text("points.gcp", points);
    char *file = string_format("%s/points.gcp", scratch);
    struct reconstruction flight = { 0 };
    struct error err = ERROR_NONE;
    struct photo_facts facts[3] = { 0 };
    struct placement placement = { 0 };
    const struct placement_request request = { .way = PLACEMENT_POINTS, .points_file = file };
    if (OK(colmap_read(&flight, scratch, &err) && placement_find(&placement, &flight, facts, &request, &err),
           "a flight is placed by control points: %s", err.text)) {
        struct similarity s = placement.world_from_reconstruction;
        NEAR(s.scale, 3, 1e-4, "at their scale");
        NEAR(s.rotation.m[0][1], -1, 1e-4, "turned as they are");
        NEAR(placement.rms_m, 0, 2e-3, "without residual");
        OK(placement.has_place, "at a place");
        NEAR(placement.origin_lat_lon_h[2], 200, 0.0051, "z = 0 is at the height of the sparse points");
        NEAR(similarity_apply(s, flight.points[0]).z, 0, 0.0051, "which lie at 0");
        NEAR(placement_shot(&placement, &flight.shots[0]).translation.z, 30, 0.01, "below cameras 30 m up");
    }
    placement_release(&placement);
    reconstruction_release(&flight);
    free(file);
    scratch_empty();
}

static void brighton(void)
{
    if (!tap_shared()) {
        SKIP("brighton as a scene", "no shared folder");
        return;
    }
    char *forms[2], *text[2] = { NULL }, *mesh = string_format("%s/data/brighton/mesh.ply", tap_shared());
    char *roads = string_format("%s/data/brighton/roads.osm", tap_shared()), *base = string_format("%s/scene.yaml", scratch);
    struct error err = ERROR_NONE;
    struct imported in = { .utc_offset = "-05:00", .mesh = path_from(base, mesh, &err), .roads = path_from(base, roads, &err) };
    struct reconstruction flight[2] = { 0 };
    const struct placement_request request = { .way = PLACEMENT_DEFAULT };
    forms[0] = string_format("%s/data/brighton/colmap", tap_shared());
    forms[1] = string_format("%s/data/brighton/colmap_bin", tap_shared());
    for (int i = 0; i < 2; i++) text[i] = import(&flight[i], &in, forms[i], &request, NULL, &err);
    if (OK(text[0] && text[1], "brighton: text and binary are imported by GPS")) {
        OK(!strcmp(text[0], text[1]), "brighton: and give the same scene, byte for byte");
        /* COLMAP's own figure, out of points3D.txt; those over all observations by a script in Python. */
        struct reprojection e = reconstruction_reprojection(&flight[0]);
        NEAR(e.point_mean_px, flight[0].stated_error_px, 1e-9, "brighton: every point reprojects as COLMAP states (%.4f px)", e.point_mean_px);
        NEAR(flight[0].stated_error_px, 0.39385275, 1e-8, "brighton: which is 0.39 px");
        static const char *const keys[] = { "#light:", "#exposure:", "#ground:", "#lens:" };
        for (size_t i = 0; i < sizeof keys / sizeof *keys; i++) uncomment(text[0], keys[i]);
        struct scene *scene = read_scene(text[0]);
        if (OK(scene && scene->shot_count == 18, "brighton: all 18 images are shots of a scene")) {
            double rms_px, mean_px;
            reproject(&rms_px, &mean_px, scene, &flight[0]);
            NEAR(rms_px, 0.5298110774, 1e-8, "brighton: the rms over all observations through the scene's cameras, in metres");
            NEAR(mean_px, 0.4077356256, 1e-8, "brighton: and the mean");
            OK(scene->has_place && fabs(scene->place.latitude_rad * 180 / M_PI - 46.8426) < 1e-3 &&
                   fabs(scene->place.longitude_rad * 180 / M_PI + 91.994) < 1e-3, "brighton: at its place");
            OK(scene->ground_albedo[0] == 0.2 && scene->sidewalk_m == 1.8, "brighton: the road's albedo and the sidewalks' width are the defaults");
            OK(scene->has_time && scene->time_utc.hour == 21 && scene->time_utc.minute == 31 && scene->time_utc.second == 59, "brighton: at 16:31:59, five hours behind UTC");
            double least = INFINITY, most = -INFINITY;
            for (size_t i = 0; i < 18; i++) {
                least = fmin(least, scene->shots[i].world_from_camera.translation.z);
                most = fmax(most, scene->shots[i].world_from_camera.translation.z);
            }
            OK(least > 38 && most < 50, "brighton: flown 40-odd metres above the ground (%.1f to %.1f m)", least, most);
        }
        scene_destroy(scene);
    }
    for (int i = 0; i < 2; i++) {
        if (text[i]) reconstruction_release(&flight[i]);
        free(text[i]);
        free(forms[i]);
    }
    free((void *)in.mesh);
    free((void *)in.roads);
    free(mesh);
    free(roads);
    free(base);
    scratch_empty();
}

static void names(void)
{
    char *in = string_format("%s/in.txt", scratch), *out = string_format("%s-out.txt", scratch), *scene = string_format("%s/scene.yaml", scratch);
    struct error err = ERROR_NONE;
    scratch_text("in.txt", "");
    file_write(out, "", 0, &err);
    const struct { const char *base, *path, *name; } cases[] = {
        { scene, in, "in.txt" }, { "scene.yaml", in, in }, { scene, "/etc/passwd", "/etc/passwd" },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char *name = path_from(cases[i].base, cases[i].path, &err);
        OK(name && !strcmp(name, cases[i].name), "from %s, %s is %s", i == 1 ? "above" : "its folder", i == 2 ? "a file elsewhere" : "a file", name ? name : "nothing");
        free(name);
    }
    char *name = path_from(scene, out, &err);
    OK(name && !strncmp(name, "../", 3) && !strcmp(name + 3, out), "from a folder below, a file is ../");
    free(name);
    OK(!path_from(scene, "none", &err) && !strcmp(err.file, "none"), "a file that is not there is named");
    unlink(out);
    free(in);
    free(out);
    free(scene);
    scratch_empty();
}

int main(void)
{
    if (!mkdtemp(scratch)) return 1;
    names();
    a_flight_by_distance();
    a_flight_by_control_points();
    brighton();
    rmdir(scratch);
    return tap_done();
}
