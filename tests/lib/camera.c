#include "lib/camera.h"

#include "tests/tap.h"

/* Off-centre principal points throughout. `whole`: every pixel of the image has a ray. */
static const struct sample {
    const char *what;
    bool whole;
    struct camera camera;
} samples[] = {
    { "SIMPLE_PINHOLE", true, { CAMERA_SIMPLE_PINHOLE, 640, 480, { 500, 300.25, 251.5 } } },
    { "PINHOLE", true, { CAMERA_PINHOLE, 640, 480, { 510, 490, 350.25, 231.5 } } },
    { "SIMPLE_RADIAL, barrel", true, { CAMERA_SIMPLE_RADIAL, 640, 480, { 500, 300.25, 251.5, -0.2 } } },
    { "SIMPLE_RADIAL, pincushion", true, { CAMERA_SIMPLE_RADIAL, 640, 480, { 400, 300.25, 251.5, 0.4 } } },
    { "SIMPLE_RADIAL, folded within the image", false, { CAMERA_SIMPLE_RADIAL, 640, 480, { 400, 300.25, 251.5, -0.35 } } },
    { "RADIAL, moustache", true, { CAMERA_RADIAL, 640, 480, { 400, 300.25, 251.5, -0.34, 0.15 } } },
    { "RADIAL, folded within the image", false, { CAMERA_RADIAL, 640, 480, { 400, 300.25, 251.5, 0.3, -0.3 } } },
    { "OPENCV, drone", true, { CAMERA_OPENCV, 640, 480, { 460, 458, 330.5, 229.5, -0.12, 0.09, 0.0013, -0.0021 } } },
    { "OPENCV, strongly decentred", true, { CAMERA_OPENCV, 640, 480, { 460, 470, 350.5, 219.5, -0.15, 0.08, 0.03, -0.02 } } },
    { "OPENCV_FISHEYE, equidistant", true, { CAMERA_OPENCV_FISHEYE, 640, 480, { 200, 201, 310.5, 250.5, 0, 0, 0, 0 } } },
    { "OPENCV_FISHEYE, action camera", true, { CAMERA_OPENCV_FISHEYE, 640, 480, { 285, 284, 325.5, 236.5, -0.03, 0.012, -0.006, 0.0008 } } },
    { "OPENCV_FISHEYE, beyond 90 deg", true, { CAMERA_OPENCV_FISHEYE, 640, 480, { 180, 181, 310.5, 250.5, 0.02, -0.005, 0.001, -0.0001 } } },
    { "FULL_OPENCV, rational", true, { CAMERA_FULL_OPENCV, 640, 480, { 420, 421, 330.5, 229.5, 0.9, 0.15, 0.0007, -0.0004, 0.02, 1.2, 0.35, 0.03 } } },
    { "FULL_OPENCV, strong", true, { CAMERA_FULL_OPENCV, 640, 480, { 300, 305, 340.5, 229.5, 6.1, 2.3, 0.001, 0.002, 0.11, 6.4, 4.1, 0.6 } } },
    { "FOV", true, { CAMERA_FOV, 640, 480, { 300, 302, 330.5, 229.5, 0.92 } } },
    { "FOV, strong", true, { CAMERA_FOV, 640, 480, { 380, 382, 330.5, 229.5, 1.3 } } },
    { "FOV, nearly none", true, { CAMERA_FOV, 640, 480, { 300, 302, 330.5, 229.5, 1e-3 } } },
    { "SIMPLE_RADIAL_FISHEYE", true, { CAMERA_SIMPLE_RADIAL_FISHEYE, 640, 480, { 190, 310.5, 250.5, -0.01 } } },
    { "RADIAL_FISHEYE", true, { CAMERA_RADIAL_FISHEYE, 640, 480, { 190, 310.5, 250.5, 0.03, -0.004 } } },
    { "RADIAL_FISHEYE, folded within the image", false, { CAMERA_RADIAL_FISHEYE, 640, 480, { 190, 310.5, 250.5, -0.05, -0.02 } } },
    { "THIN_PRISM_FISHEYE", true, { CAMERA_THIN_PRISM_FISHEYE, 640, 480, { 280, 281, 325.5, 236.5, -0.02, 0.01, 0.0004, -0.0006, -0.004, 0.0005, 0.0012, -0.0009 } } },
    { "THIN_PRISM_FISHEYE, strong", true, { CAMERA_THIN_PRISM_FISHEYE, 640, 480, { 220, 221, 325.5, 236.5, -0.03, 0.008, 0.004, -0.006, -0.001, 0.0001, 0.012, -0.009 } } },
};

static void pixels_round_trip(const struct sample *sample)
{
    const struct camera *camera = &sample->camera;
    int found = 0, all = 0, unlike = 0;
    double worst_px = 0, worst_norm = 0, worst_rad = 0;
    for (int y = 0; y <= camera->height_px; y += 5)
        for (int x = 0; x <= camera->width_px; x += 5, all++) {
            struct vec2 q = { x, y }, back;
            struct vec3 ray, again;
            struct error err = ERROR_NONE;
            if (!camera_unproject(camera, &ray, q, &err)) {
                unlike += err.code != ERR_NOT_INVERTIBLE;
                continue;
            }
            found++;
            worst_norm = fmax(worst_norm, fabs(vec3_norm(ray) - 1));
            if (!camera_project(camera, &back, vec3_scale(ray, 7.5), &err) ||
                !camera_unproject(camera, &again, back, &err)) {
                unlike++;
                continue;
            }
            worst_px = fmax(worst_px, hypot(back.x - q.x, back.y - q.y));
            worst_rad = fmax(worst_rad, vec3_norm(vec3_sub(again, ray)));
        }
    NEAR(worst_px, 0, 1e-6, "%s: project(unproject(q)) is q", sample->what);
    /* At a fold a ray moves by the root of what its pixel moves. */
    NEAR(worst_rad * camera_intrinsics(camera).fx_px, 0, sample->whole ? 1e-6 : 1e-3,
         "%s: unproject(project(p)) is p's direction, in px at the centre", sample->what);
    NEAR(worst_norm, 0, 1e-14, "%s: rays have unit length", sample->what);
    OK(unlike == 0, "%s: what has a ray has an image, and what has none says not invertible", sample->what);
    OK(sample->whole ? found == all : found < all && found > all / 3, "%s: %s", sample->what,
       sample->whole ? "every pixel has a ray" : "the folded corners have none");
}


static void directions_round_trip(const struct sample *sample)
{
    const struct camera *camera = &sample->camera;
    double end_rad = fmin(camera_invertible_angle_rad(camera), 179.0 / 180 * M_PI), worst = 0;
    int inside = 0;
    for (int i = 0; i < 200; i++)
        for (int j = 0; j < 36; j++) {
            double angle = end_rad * i / 200, turn = 2 * M_PI * j / 36;
            struct vec3 p = { sin(angle) * cos(turn), sin(angle) * sin(turn), cos(angle) }, back;
            struct vec2 q, again;
            struct error err = ERROR_NONE;
            if (!camera_project(camera, &q, p, &err)) continue; /* decentred lenses end a little earlier */
            if (!(q.x >= 0 && q.y >= 0 && q.x <= camera->width_px && q.y <= camera->height_px)) continue;
            inside++;
            if (!camera_unproject(camera, &back, q, &err) || !camera_project(camera, &again, back, &err))
                worst = INFINITY;
            else
                worst = fmax(worst, fmax(hypot(again.x - q.x, again.y - q.y),
                                         vec3_norm(vec3_sub(back, p)) * camera_intrinsics(camera).fx_px));
        }
    OK(inside > 1000, "%s: directions fall into the image", sample->what);
    NEAR(worst, 0, 1e-6, "%s: each of them comes back from its pixel, in px", sample->what);
}

static void scales(const struct sample *sample)
{
    const struct camera *camera = &sample->camera;
    struct camera half = camera_scaled(camera, 320, 240), squeezed = camera_scaled(camera, 333, 250);
    OK(half.model == camera->model && half.width_px == 320 && half.height_px == 240,
       "%s: stays what it is at half the size", sample->what);
    double worst = 0;
    struct vec3 p = { 0.21, -0.13, 0.9 };
    struct vec2 q = { NAN, NAN }, h = q, s = q;
    struct error err = ERROR_NONE;
    camera_project(camera, &q, p, &err);
    camera_project(&half, &h, p, &err);
    camera_project(&squeezed, &s, p, &err);
    worst = hypot(h.x - q.x / 2, h.y - q.y / 2);
    NEAR(worst, 0, 1e-11, "%s: and its images shrink with it", sample->what);
    worst = hypot(s.x - q.x * 333 / 640, s.y - q.y * 250 / 480);
    NEAR(worst, 0, 1e-11, "%s: as they do where the aspect changes a little", sample->what);
}

/* Figures of truth: OpenCV 4.6, cv2.projectPoints and cv2.fisheye.projectPoints (Python), of the
 * points below. FOV is its equidistant fisheye with f / omega, which FOV equals where
 * 2 tan(omega/2) = 1. The first THIN_PRISM_FISHEYE is the equidistant fisheye of f = 1 followed by
 * projectPoints with k1, k2, p1, p2, k3, s1 and s3; the second holds k4, by fisheye.projectPoints. */
static const struct vec3 truth_points[3] = { { 0.3, -0.2, 1.1 }, { -1.7, 0.9, 2.5 }, { 0.05, 0.9, 1.3 } };
static const struct { struct camera camera; struct vec2 q[3]; } truths[] = {
    { { CAMERA_SIMPLE_RADIAL, 640, 480, { 500, 300.25, 251.5, -0.2 } },
      { { 433.6835086401, 162.5443275733 }, { 0.5060000000, 410.1880000000 }, { 317.6316568047, 564.3698224852 } } },
    { { CAMERA_RADIAL, 640, 480, { 400, 300.25, 251.5, -0.34, 0.15 } },
      { { 405.5448196534, 181.3034535644 }, { 68.6992288000, 374.0857024000 }, { 313.6532203004, 492.7579654074 } } },
    { { CAMERA_OPENCV, 640, 480, { 460, 470, 350.5, 219.5, -0.15, 0.08, 0.03, -0.02 } },
      { { 470.3229865074, 138.7230417694 }, { 35.9955888640, 395.0230807040 }, { 363.5281861629, 547.2303368229 } } },
    { { CAMERA_FULL_OPENCV, 640, 480, { 420, 421, 330.5, 229.5, 0.9, 0.15, 0.0007, -0.0004, 0.02, 1.2, 0.35, 0.03 } },
      { { 441.4800439411, 155.3567455148 }, { 83.2845383637, 360.8120737944 }, { 344.7253228774, 487.7644588728 } } },
    { { CAMERA_OPENCV_FISHEYE, 640, 480, { 285, 284, 325.5, 236.5, -0.03, 0.012, -0.006, 0.0008 } },
      { { 400.3929375034, 186.7465631556 }, { 162.1534646566, 322.6741474382 }, { 334.9915691590, 406.7487773366 } } },
    { { CAMERA_SIMPLE_RADIAL_FISHEYE, 640, 480, { 190, 310.5, 250.5, -0.01 } },
      { { 360.5233494058, 217.1511003961 }, { 200.8499420314, 308.5500306893 }, { 316.8661355955, 365.0904407193 } } },
    { { CAMERA_RADIAL_FISHEYE, 640, 480, { 190, 310.5, 250.5, 0.03, -0.004 } },
      { { 360.7222795660, 217.0184802893 }, { 199.0369044147, 309.5098741334 }, { 316.9566250288, 366.7192505181 } } },
    { { CAMERA_FOV, 640, 480, { 300, 302, 330.5, 229.5, 0.92729521800161219 } },
      { { 415.7625520138, 172.2793539818 }, { 142.9874328570, 329.4331681362 }, { 341.3798960264, 426.6437159989 } } },
    { { CAMERA_THIN_PRISM_FISHEYE, 640, 480,
        { 280, 281, 325.5, 236.5, -0.02, 0.01, 0.004, -0.006, -0.004, 0, 0.012, -0.009 } },
      { { 398.9831699692, 187.3080686463 }, { 163.5553034456, 322.3212429630 }, { 335.5172121856, 405.7827003099 } } },
    { { CAMERA_THIN_PRISM_FISHEYE, 640, 480, { 280, 281, 325.5, 236.5, -0.02, 0.01, 0, 0, -0.004, 0.0005, 0, 0 } },
      { { 399.1517204291, 187.2234918082 }, { 164.3570953595, 322.1156314781 }, { 334.8580000885, 405.5455873122 } } },
};

static void matches_truth(void)
{
    for (size_t i = 0; i < sizeof truths / sizeof *truths; i++) {
        double worst = 0;
        for (int j = 0; j < 3; j++) {
            struct vec2 q = { NAN, NAN };
            struct error err = ERROR_NONE;
            if (!camera_project(&truths[i].camera, &q, truth_points[j], &err)) worst = INFINITY;
            worst = fmax(worst, hypot(q.x - truths[i].q[j].x, q.y - truths[i].q[j].y));
        }
        NEAR(worst, 0, 1e-9, "%s projects as OpenCV does", camera_model_name(truths[i].camera.model));
    }
}

static double invertible_deg(struct camera camera) { return camera_invertible_angle_rad(&camera) * 180 / M_PI; }

/* By hand, from the zeros of the slope of the radial part. */
static void tells_where_it_folds(void)
{
    NEAR(invertible_deg((struct camera){ CAMERA_PINHOLE, 640, 480, { 500, 500, 320, 240 } }), 90, 1e-12,
         "a pinhole camera sees a half space");
    NEAR(invertible_deg((struct camera){ CAMERA_OPENCV_FISHEYE, 640, 480, { 200, 200, 320, 240 } }), 180, 1e-12,
         "an equidistant fisheye sees all round");
    NEAR(invertible_deg((struct camera){ CAMERA_SIMPLE_RADIAL, 640, 480, { 500, 320, 240, -1.0 / 3 } }), 45, 1e-9,
         "r - r^3/3 rises until r = 1");
    NEAR(invertible_deg((struct camera){ CAMERA_RADIAL, 640, 480, { 500, 320, 240, -1.25 / 3, 0.05 } }), 45, 1e-9,
         "slope (1 - s)(1 - s/4): the first of two folds counts");
    NEAR(invertible_deg((struct camera){ CAMERA_FULL_OPENCV, 640, 480, { 500, 500, 320, 240, 0, 0, 0, 0, 0, -1 } }), 45,
         1e-9, "r / (1 - r^2) ends at its pole, though it rises beyond it too");
    NEAR(invertible_deg((struct camera){ CAMERA_FULL_OPENCV, 640, 480, { 500, 500, 320, 240, 0, 0, 0, 0, 0, 1 } }), 45,
         1e-9, "r / (1 + r^2) rises until r = 1");
    NEAR(invertible_deg((struct camera){ CAMERA_SIMPLE_RADIAL_FISHEYE, 640, 480, { 200, 320, 240, -1.0 / 12 } }),
         2 * 180 / M_PI, 1e-9, "theta - theta^3/12 rises until 2 rad");

    struct camera folded = { CAMERA_SIMPLE_RADIAL, 640, 480, { 500, 320, 240, -1.0 / 3 } };
    struct vec2 q = { -7, -7 };
    struct vec3 ray = { -7, -7, -7 };
    struct error err = ERROR_NONE;
    OK(camera_project(&folded, &q, vec3(0.999, 0, 1), &err), "a point short of the fold has an image");
    q = (struct vec2){ -7, -7 };
    OK(!camera_project(&folded, &q, vec3(1.001, 0, 1), &err) && err.code == ERR_BEHIND_CAMERA && q.x == -7,
       "a point beyond it has none");
    err = ERROR_NONE;
    OK(camera_unproject(&folded, &ray, (struct vec2){ 320 + 500 * 0.6666, 240 }, &err),
       "a pixel within the image circle, of radius 2/3, has a ray");
    ray.x = -7;
    OK(!camera_unproject(&folded, &ray, (struct vec2){ 320 + 500 * 0.6667, 240 }, &err) &&
           err.code == ERR_NOT_INVERTIBLE && ray.x == -7,
       "a pixel outside has none");
    err = ERROR_NONE;
    OK(!camera_unproject(&folded, &ray, (struct vec2){ NAN, 240 }, &err) && err.code == ERR_NOT_INVERTIBLE,
       "no pixel at all has none");
}

static void looks_ahead_or_around(void)
{
    struct vec2 q = { -7, -7 };
    for (int m = 0; m < CAMERA_MODEL_COUNT; m++) {
        struct camera camera = { .model = (enum camera_model)m, .width_px = 640, .height_px = 480 };
        const double one[] = { 200, 320, 240 }, two[] = { 200, 200, 320, 240 };
        bool single = m == CAMERA_SIMPLE_PINHOLE || m == CAMERA_SIMPLE_RADIAL || m == CAMERA_RADIAL ||
                      m == CAMERA_SIMPLE_RADIAL_FISHEYE || m == CAMERA_RADIAL_FISHEYE;
        bool fisheye = m == CAMERA_OPENCV_FISHEYE || m == CAMERA_SIMPLE_RADIAL_FISHEYE ||
                       m == CAMERA_RADIAL_FISHEYE || m == CAMERA_THIN_PRISM_FISHEYE;
        memcpy(camera.params, single ? one : two, single ? sizeof one : sizeof two);
        const char *name = camera_model_name(camera.model);
        struct error err = ERROR_NONE;
        bool seen = camera_project(&camera, &q, vec3(1, 0, -1), &err);
        if (fisheye)
            NEAR(q.x, 320 + 200 * 0.75 * M_PI, 1e-12, "%s sees 135 degrees off its axis", name);
        else
            OK(!seen && err.code == ERR_BEHIND_CAMERA, "%s does not see behind itself", name);
        err = ERROR_NONE;
        OK(!camera_project(&camera, &q, vec3(0, 0, 0), &err) && err.code == ERR_BEHIND_CAMERA,
           "%s: its own centre has no image", name);
        OK(camera_is_pinhole(&camera) == !fisheye, "%s with no distortion: is it a pinhole camera", name);
        struct camera_intrinsics in = camera_intrinsics(&camera);
        OK(in.fx_px == 200 && in.fy_px == 200 && in.cx_px == 320 && in.cy_px == 240, "%s: its intrinsics", name);
    }
    struct camera bent = { CAMERA_FULL_OPENCV, 640, 480, { 500, 500, 320, 240, 0, 0, 0, 0, 0, 0, 0, 1e-9 } };
    OK(!camera_is_pinhole(&bent), "the last coefficient alone bends a lens");
}

static void knows_names(void)
{
    enum camera_model model;
    /* cameras.txt of COLMAP: the names by id, and the number of parameters. */
    static const struct { const char *name; int params; } want[] = {
        { "SIMPLE_PINHOLE", 3 }, { "PINHOLE", 4 }, { "SIMPLE_RADIAL", 4 }, { "RADIAL", 5 }, { "OPENCV", 8 },
        { "OPENCV_FISHEYE", 8 }, { "FULL_OPENCV", 12 }, { "FOV", 5 }, { "SIMPLE_RADIAL_FISHEYE", 4 },
        { "RADIAL_FISHEYE", 5 }, { "THIN_PRISM_FISHEYE", 12 },
    };
    for (int i = 0; i < CAMERA_MODEL_COUNT; i++)
        OK(camera_model_from_name(&model, want[i].name) && model == (enum camera_model)i &&
               !strcmp(camera_model_name(model), want[i].name) && camera_model_param_count(model) == want[i].params,
           "%s is model %d", want[i].name, i);
    OK(!camera_model_from_name(&model, "PINHLE") && !camera_model_from_name(&model, "pinhole"),
       "no other name is a model");
}

int main(void)
{
    for (size_t i = 0; i < sizeof samples / sizeof *samples; i++) {
        pixels_round_trip(samples + i);
        directions_round_trip(samples + i);
        scales(samples + i);
    }
    matches_truth();
    tells_where_it_folds();
    looks_ahead_or_around();
    knows_names();
    return tap_done();
}
