/* Markers at known points through all that carries geometry from scene to photograph: view_cover,
 * camera_write, POV-Ray as staffage-povray runs it, resample_view. Where they come out is held
 * against camera_project, which knows neither views nor rays. */
#include "gen/render/camera_sdl.h"
#include "gen/render/makefile.h"
#include "gen/render/sdl.h"
#include "lib/camera.h"
#include "lib/file.h"
#include "lib/view.h"
#include "post/input.h"
#include "post/resample.h"

#include "tests/tap.h"

#include <sys/wait.h>
#include <unistd.h>

#define TOLERANCE_PX 0.1
#define RADIUS_PX 2.0 /* small: a lens bends the image of a larger one so that its centroid leaves its centre's */
#define WINDOW_PX 64
#define BOX_PX 10     /* a marker's light lies within this of its place */
#define PROCESSES 8   /* POV-Ray idles for most of its half second */
#define WIDTH_PX 640
#define HEIGHT_PX 480

/* Near the middle, two corners and an edge. */
#define MARKERS 4
static const struct vec2 places_px[MARKERS] = { { 322.3, 241.6 }, { 627.4, 11.8 }, { 11.2, 301.9 }, { 13.7, 466.3 } };

#define LENS(model) CAMERA_##model, WIDTH_PX, HEIGHT_PX
static const struct sample {
    const char *what;
    struct camera camera;
    struct rect wide; /* one view of many markers beside the small ones; empty: none */
} samples[] = {
    { "SIMPLE_PINHOLE", { LENS(SIMPLE_PINHOLE), { 500, 300.25, 251.5 } }, { 0, 0, 640, 480 } },
    { "PINHOLE", { LENS(PINHOLE), { 510, 490, 350.25, 231.5 } }, { 0 } },
    { "PINHOLE, a crop far from its axis", { LENS(PINHOLE), { 700, 710, -250.3, 820.8 } }, { 0 } },
    { "SIMPLE_RADIAL, barrel", { LENS(SIMPLE_RADIAL), { 500, 300.25, 251.5, -0.2 } }, { 0, 0, 640, 480 } },
    { "SIMPLE_RADIAL, pincushion", { LENS(SIMPLE_RADIAL), { 400, 300.25, 251.5, 0.4 } }, { 0 } },
    { "RADIAL, moustache", { LENS(RADIAL), { 400, 300.25, 251.5, -0.34, 0.15 } }, { 0, 0, 640, 480 } },
    { "OPENCV, drone", { LENS(OPENCV), { 460, 458, 330.5, 229.5, -0.12, 0.09, 0.0013, -0.0021 } }, { 0 } },
    { "OPENCV, strongly decentred", { LENS(OPENCV), { 460, 470, 350.5, 219.5, -0.15, 0.08, 0.03, -0.02 } }, { 0 } },
    { "OPENCV_FISHEYE, action camera", { LENS(OPENCV_FISHEYE), { 285, 284, 325.5, 236.5, -0.03, 0.012, -0.006, 0.0008 } }, { 0, 0, 400, 480 } },
    { "OPENCV_FISHEYE, beyond 90 deg", { LENS(OPENCV_FISHEYE), { 180, 181, 310.5, 250.5, 0.02, -0.005, 0.001, -0.0001 } }, { 0, 240, 160, 480 } },
    { "FULL_OPENCV, rational", { LENS(FULL_OPENCV), { 420, 421, 330.5, 229.5, 0.9, 0.15, 0.0007, -0.0004, 0.02, 1.2, 0.35, 0.03 } }, { 0 } },
    { "FULL_OPENCV, strong", { LENS(FULL_OPENCV), { 300, 305, 340.5, 229.5, 6.1, 2.3, 0.001, 0.002, 0.11, 6.4, 4.1, 0.6 } }, { 0 } },
    { "FOV", { LENS(FOV), { 300, 302, 330.5, 229.5, 0.92 } }, { 0 } },
    { "FOV, strong", { LENS(FOV), { 380, 382, 330.5, 229.5, 1.3 } }, { 0 } },
    { "SIMPLE_RADIAL_FISHEYE, beyond 90 deg", { LENS(SIMPLE_RADIAL_FISHEYE), { 190, 310.5, 250.5, -0.01 } }, { 0 } },
    { "RADIAL_FISHEYE, beyond 90 deg", { LENS(RADIAL_FISHEYE), { 190, 310.5, 250.5, 0.03, -0.004 } }, { 0 } },
    { "THIN_PRISM_FISHEYE", { LENS(THIN_PRISM_FISHEYE), { 280, 281, 325.5, 236.5, -0.02, 0.01, 0.0004, -0.0006, -0.004, 0.0005, 0.0012, -0.0009 } }, { 0 } },
    { "THIN_PRISM_FISHEYE, strong", { LENS(THIN_PRISM_FISHEYE), { 220, 221, 325.5, 236.5, -0.03, 0.008, 0.004, -0.006, -0.001, 0.0001, 0.012, -0.009 } }, { 0 } },
};
#define SAMPLES (sizeof samples / sizeof *samples)
#define SHOTS (MARKERS + 1)

/* A sphere, and what it must look like in the photograph: the lens's image of its outline. */
struct marker {
    struct vec3 center; /* m, camera */
    double radius_m;
    struct vec2 projection_px, centroid_px;
    double area_px;
};

struct shot { char *stem; struct view view; };

struct trial {
    struct marker markers[MARKERS];
    struct shot shots[SHOTS]; /* stem NULL: there is none */
};

static char out[] = "staffage-marker-XXXXXX";

static bool inside(struct rect r, struct vec2 q) { return q.x > r.x0 && q.y > r.y0 && q.x < r.x1 && q.y < r.y1; }

/* Area and centroid of the image of a cone of directions around the axis, by Green's theorem. */
static bool outline(double *area_px, struct vec2 *centroid_px, const struct camera *camera, struct vec3 axis,
                    double angle_rad, struct error *err)
{
    enum { CORNERS = 720 };
    struct vec2 q[CORNERS], mean = { 0, 0 };
    struct vec3 across = vec3_unit(vec3_cross(axis, fabs(axis.x) < 0.6 ? vec3(1, 0, 0) : vec3(0, 1, 0)));
    struct vec3 along = vec3_cross(axis, across);
    for (int i = 0; i < CORNERS; i++) {
        double turn = 2 * M_PI * i / CORNERS;
        struct vec3 off = vec3_add(vec3_scale(across, cos(turn)), vec3_scale(along, sin(turn)));
        struct vec3 d = vec3_add(vec3_scale(axis, cos(angle_rad)), vec3_scale(off, sin(angle_rad)));
        if (!camera_project(camera, &q[i], d, err)) return false;
    }
    double twice = 0;
    for (int i = 0; i < CORNERS; i++) { /* from q[0], which keeps the products small */
        struct vec2 a = { q[i].x - q[0].x, q[i].y - q[0].y }, b = q[(i + 1) % CORNERS];
        b.x -= q[0].x;
        b.y -= q[0].y;
        double cross = a.x * b.y - a.y * b.x;
        twice += cross;
        mean.x += (a.x + b.x) * cross;
        mean.y += (a.y + b.y) * cross;
    }
    *area_px = fabs(twice) / 2;
    *centroid_px = (struct vec2){ q[0].x + mean.x / (3 * twice), q[0].y + mean.y / (3 * twice) };
    return true;
}

/* At a place of the photograph, as large there as a disc of RADIUS_PX. */
static bool marker_at(struct marker *marker, const struct camera *camera, struct vec2 place_px, double distance_m,
                      struct error *err)
{
    struct vec3 ray;
    double angle_rad = 1e-4, area_px;
    struct vec2 none;
    if (!camera_unproject(camera, &ray, place_px, err) || !outline(&area_px, &none, camera, ray, angle_rad, err))
        return false;
    angle_rad *= sqrt(M_PI * RADIUS_PX * RADIUS_PX / area_px);
    marker->center = vec3_scale(ray, distance_m);
    marker->radius_m = distance_m * sin(angle_rad);
    return camera_project(camera, &marker->projection_px, marker->center, err) &&
           outline(&marker->area_px, &marker->centroid_px, camera, ray, angle_rad, err);
}

/* Channels in powers of two: POV-Ray's half floats hold their ratios exactly. */
static const double color[3] = { 4, 1, 0.25 };

static bool write_scene(const struct shot *shot, struct pose world_from_camera, const struct marker *markers,
                        struct error *err)
{
    struct sdl sdl;
    sdl_init(&sdl);
    sdl_header(&sdl, "markers");
    sdl_declare_number(&sdl, "Radiosity", 0);
    sdl_include(&sdl, "settings.inc");
    camera_write(&sdl, &shot->view, world_from_camera);
    for (int i = 0; i < MARKERS; i++) {
        sdl_begin(&sdl, "sphere");
        sdl_vector(&sdl, pose_apply(world_from_camera, markers[i].center));
        sdl_comma(&sdl);
        sdl_number(&sdl, markers[i].radius_m);
        sdl_begin(&sdl, "pigment");
        sdl_color(&sdl, color);
        sdl_end(&sdl);
        sdl_begin(&sdl, "finish");
        sdl_word(&sdl, "diffuse");
        sdl_number(&sdl, 0);
        sdl_word(&sdl, "emission");
        sdl_number(&sdl, 1);
        sdl_end(&sdl);
        sdl_end(&sdl);
    }
    char *path = string_format("%s/%s.pov", out, shot->stem);
    bool ok = sdl_write(&sdl, path, err);
    free(path);
    sdl_release(&sdl);
    return ok;
}

/* POV-Ray on a shot, as soon as fewer than PROCESSES run. A failure shows as a picture that is not there. */
static void start(const struct shot *shot)
{
    static int running;
    if (running < PROCESSES) running++;
    else wait(NULL);
    char width[12], height[12], *program = string_format("%s/staffage-povray", getenv("top_builddir"));
    snprintf(width, sizeof width, "%d", shot->view.width_px);
    snprintf(height, sizeof height, "%d", shot->view.height_px);
    fflush(stdout);
    if (fork() == 0) {
        /* Finer than the passes: what is measured is where things are, not how POV-Ray samples an edge. */
        if (chdir(out) == 0) execl(program, program, shot->stem, width, height, "+A0.1", "+AM2", "+R4", "-J", (char *)NULL);
        perror(program);
        _exit(127);
    }
    free(program);
}

static struct rect around(struct vec2 q)
{
    /* Not the middle: the marker must not profit from symmetry. */
    int x = (int)q.x - 27, y = (int)q.y - 35;
    struct rect r = { x, y, x + WINDOW_PX, y + WINDOW_PX };
    if (r.x0 < 0) r.x0 = 0;
    if (r.y0 < 0) r.y0 = 0;
    if (r.x1 > WIDTH_PX) r.x1 = WIDTH_PX;
    if (r.y1 > HEIGHT_PX) r.y1 = HEIGHT_PX;
    return r;
}

static bool begin(struct trial *trial, size_t index, struct error *err)
{
    const struct sample *sample = &samples[index];
    double k = (double)index;
    struct pose world_from_camera = { mat3_from_quat((struct quat){ 1, 0.3 * k - 1.7, 0.9 - 0.2 * k, 0.4 }),
                                      { 31.7 - 5 * k, -412.3 + 11 * k, 7.9 } };
    for (int i = 0; i < MARKERS; i++)
        if (!marker_at(&trial->markers[i], &sample->camera, places_px[i], 4 + 7.3 * i, err)) return false;
    for (int i = 0; i < SHOTS; i++) {
        struct shot *shot = &trial->shots[i];
        struct rect window = i < MARKERS ? around(places_px[i]) : sample->wide;
        if (window.x1 == 0) continue;
        if (!view_cover(&shot->view, &sample->camera, window, 1.5, err)) return false;
        shot->stem = string_format("frames/%06zu/%d", index, i);
        char *folder = string_format("%s/frames/%06zu", out, index);
        bool ok = folder_make(folder, err) && write_scene(shot, world_from_camera, trial->markers, err);
        free(folder);
        if (!ok) return false;
        start(shot);
    }
    return true;
}

/* What the photograph shows of a marker. */
struct sight { struct vec2 centroid_px; double area_px, uneven; };

static struct sight look(const struct image *image, struct rect window, struct vec2 at)
{
    struct sight sight = { { 0, 0 }, 0, 0 };
    for (int y = 0; y < image->height_px; y++)
        for (int x = 0; x < image->width_px; x++) {
            struct vec2 q = { window.x0 + x + 0.5, window.y0 + y + 0.5 };
            if (fabs(q.x - at.x) > BOX_PX || fabs(q.y - at.y) > BOX_PX) continue;
            const float *p = image_f32(image, x, y);
            double a = (double)p[3];
            sight.area_px += a;
            sight.centroid_px.x += a * q.x;
            sight.centroid_px.y += a * q.y;
            for (int c = 0; c < 3; c++) sight.uneven = fmax(sight.uneven, fabs((double)p[c] - color[c] * a));
        }
    sight.centroid_px.x /= sight.area_px;
    sight.centroid_px.y /= sight.area_px;
    return sight;
}

static double distance(struct vec2 a, struct vec2 b) { return hypot(a.x - b.x, a.y - b.y); }

/* fmax would drop the NaN that a place without light gives. */
static double worse(double worst, double value) { return value <= worst ? worst : value; }

struct worst { double off_px, off_outline_px, area, uneven; int seen; };

static bool inspect(struct worst *worst, const struct sample *sample, const struct marker *markers,
                    const struct shot *shot, struct error *err)
{
    const struct view *view = &shot->view;
    struct image pass, image;
    char *path = string_format("%s/%s.exr", out, shot->stem);
    bool ok = input_pass(&pass, path, view->width_px, view->height_px, err);
    free(path);
    if (!ok) return false;
    ok = resample_view(&image, &pass, 1, view, &sample->camera, err);
    image_release(&pass);
    if (!ok) return false;
    for (int i = 0; i < MARKERS; i++) {
        if (!inside(view->window_px, markers[i].projection_px)) continue;
        struct sight sight = look(&image, view->window_px, markers[i].projection_px);
        worst->seen++;
        worst->off_px = worse(worst->off_px, distance(sight.centroid_px, markers[i].projection_px));
        worst->off_outline_px = worse(worst->off_outline_px, distance(sight.centroid_px, markers[i].centroid_px));
        worst->area = worse(worst->area, fabs(sight.area_px / markers[i].area_px - 1));
        worst->uneven = worse(worst->uneven, sight.uneven);
    }
    image_release(&image);
    return true;
}

static void check(const struct sample *sample, const struct trial *trial)
{
    struct error err = ERROR_NONE;
    struct worst worst = { 0, 0, 0, 0, 0 };
    bool ok = true;
    for (int i = 0; i < SHOTS && ok; i++)
        if (trial->shots[i].stem) ok = inspect(&worst, sample, trial->markers, &trial->shots[i], &err);
    if (!OK(ok && worst.seen >= MARKERS, "%s: each marker is rendered and resampled", sample->what)) {
        printf("# %s: %s\n", err.file, err.text);
        return;
    }
    double bias = 0;
    for (int i = 0; i < MARKERS; i++)
        bias = worse(bias, distance(trial->markers[i].projection_px, trial->markers[i].centroid_px));
    printf("# %s, %d sights: %.4f px from the projection, %.4f px from the outline's centroid (bias %.4f px), "
           "area within %.2f %%\n", sample->what, worst.seen, worst.off_px, worst.off_outline_px, bias, 100 * worst.area);
    NEAR(worst.off_px, 0, TOLERANCE_PX, "%s: its centroid lies where the lens projects its centre", sample->what);
    NEAR(worst.off_outline_px, 0, TOLERANCE_PX / 2, "%s: and nearer to the centroid of its outline", sample->what);
    NEAR(worst.area, 0, 0.03, "%s: it is as large as its outline: no light is lost or made", sample->what);
    NEAR(worst.uneven, 0, 1e-6, "%s: in every pixel light goes with coverage, beyond 1 too", sample->what);
}

static bool covers_every_model(void)
{
    for (int m = 0; m < CAMERA_MODEL_COUNT; m++) {
        size_t i = 0;
        while (i < SAMPLES && samples[i].camera.model != (enum camera_model)m) i++;
        if (i == SAMPLES) return false;
    }
    return true;
}

static void remove_out(void)
{
    fflush(stdout);
    if (fork() == 0) {
        execlp("rm", "rm", "-rf", out, (char *)NULL);
        _exit(127);
    }
    wait(NULL);
}

int main(void)
{
    struct error err = ERROR_NONE;
    static struct trial trials[SAMPLES];
    char *templates = string_format("%s/templates", getenv("top_srcdir"));
    if (!mkdtemp(out)) return 2;
    bool ok = makefile_write(out, templates, NULL, 0, &err);
    for (size_t i = 0; i < SAMPLES && ok; i++) ok = begin(&trials[i], i, &err);
    while (wait(NULL) > 0) continue;
    OK(covers_every_model(), "no camera model is left out");
    if (!OK(ok, "their views and scenes are written")) printf("# %s: %s\n", err.file, err.text);
    for (size_t i = 0; i < SAMPLES && ok; i++) check(&samples[i], &trials[i]);
    for (size_t i = 0; i < SAMPLES; i++)
        for (int k = 0; k < SHOTS; k++) free(trials[i].shots[k].stem);
    free(templates);
    int done = tap_done();
    if (done == 0) remove_out();
    return done;
}
