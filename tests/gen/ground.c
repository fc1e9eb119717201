#include "gen/world/ground.h"

#include "tests/tap.h"

#define RAD (M_PI / 180)

/* A sloping grid of points around a far origin, each moved along the normal by `noise_m`
 * with signs that sum to nothing over every row and column. */
static size_t slope(struct vec3 *p, struct plane truth, double noise_m)
{
    size_t n = 0;
    for (int i = -4; i < 4; i++)
        for (int j = -4; j < 4; j++) {
            struct vec3 q = { 512000 + 3 * i, -87000 + 2 * j, 0 };
            q.z = plane_height(&truth, q.x, q.y);
            p[n++] = vec3_add(q, vec3_scale(truth.normal, (i + j) % 2 ? noise_m : -noise_m));
        }
    return n;
}

static void check_fit(void)
{
    struct vec3 p[64];
    struct plane truth = { vec3_unit(vec3(0.1, -0.2, 1)), 0 }, plane = { 0 };
    truth.offset_m = vec3_dot(truth.normal, vec3(512000, -87000, 250));
    double rms = -1;
    struct error err = ERROR_NONE;

    size_t n = slope(p, truth, 0);
    OK(plane_fit(&plane, &rms, p, n, &err), "fits points on a slope half a million metres from the origin");
    NEAR(vec3_norm(vec3_sub(plane.normal, truth.normal)), 0, 1e-10, "its normal is the slope's");
    NEAR(plane_height(&plane, 512001, -87001), plane_height(&truth, 512001, -87001), 1e-7, "so is its height");
    NEAR(rms, 0, 1e-7, "nothing is left over");

    n = slope(p, truth, 0.02);
    OK(plane_fit(&plane, &rms, p, n, &err), "fits points 2 cm off a slope");
    NEAR(acos(fmin(1, vec3_dot(plane.normal, truth.normal))) / RAD, 0, 0.05, "its normal stays within 0.05 deg");
    NEAR(rms, 0.02, 2e-4, "the residual is those 2 cm");

    struct vec3 three[] = { { 0, 0, 1 }, { 0, 1, 1 }, { 1, 0, 1 } };
    OK(plane_fit(&plane, &rms, three, 3, &err) && plane.normal.z > 0, "three points make a plane that faces up");
    NEAR(plane.normal.z, 1, 1e-15, "a level one, when they are level");
    NEAR(plane.offset_m, 1, 1e-15, "at their height");

    struct vec3 steep[] = { { 0, 0, 0 }, { 0, 5, 0 }, { 1, 0, tan(59 * RAD) }, { 1, 5, tan(59 * RAD) } };
    OK(plane_fit(&plane, &rms, steep, 4, &err), "59 deg is still a ground");
    NEAR(acos(plane.normal.z) / RAD, 59, 1e-9, "and comes out as 59 deg");
    OK(err.code == ERR_OK, "nothing of that sets an error");
}

static void check_fit_refusals(void)
{
    struct vec3 line[6], thick[6], heap[8];
    for (int i = 0; i < 6; i++) {
        line[i] = vec3(2 * i, 3 * i, 0.1 * i);
        thick[i] = vec3(2 * i, 3 * i + (i % 2 ? 0.1 : -0.1), (i % 3 - 1) * 0.1);
    }
    for (int i = 0; i < 8; i++) heap[i] = vec3(i & 1, i >> 1 & 1, i >> 2 & 1);
    struct vec3 wall[] = { { 0, 0, 0 }, { 0, 5, 0 }, { 1, 0, tan(61 * RAD) }, { 1, 5, tan(61 * RAD) } };
    struct vec3 same[] = { { 1, 1, 1 }, { 1, 1, 1 }, { 1, 1, 1 } };
    struct vec3 broken[] = { { 0, 0, 0 }, { 0, 1, 0 }, { 1, 0, NAN } };
    struct { const char *what, *says; const struct vec3 *p; size_t n; } bad[] = {
        { "two points", "3 points or more, here are 2", line, 2 },
        { "points on a line", "do not tell a plane", line, 6 },
        { "points about a line", "do not tell a plane", thick, 6 },
        { "a heap", "do not tell a plane", heap, 8 },
        { "one point three times", "do not tell a plane", same, 3 },
        { "a wall", "61 deg steep; a ground is at most 60 deg", wall, 4 },
        { "a point that is not a number", "not finite", broken, 3 },
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        struct plane plane = { .offset_m = 7 };
        double rms = 8;
        struct error err = ERROR_NONE;
        OK(!plane_fit(&plane, &rms, bad[i].p, bad[i].n, &err) && err.code == ERR_INPUT
               && strstr(err.text, bad[i].says) && plane.offset_m == 7 && rms == 8,
           "refuses %s: %s", bad[i].what, err.text);
    }
}

static void check_intersect(void)
{
    struct plane plane = { vec3_unit(vec3(0, -1, 2)), 0 }; /* rises one in two to the north */
    struct vec3 p = { 0 };
    OK(plane_intersect(&plane, &p, vec3(3, 4, 10), vec3(0, 0, -2)), "a ray straight down meets the plane");
    NEAR(vec3_norm(vec3_sub(p, vec3(3, 4, 2))), 0, 1e-14, "right below");
    NEAR(plane_height(&plane, 3, 4), 2, 1e-15, "which is the plane's height there");
    OK(plane_intersect(&plane, &p, vec3(0, 0, 1), vec3(0, 1, 0)) && fabs(p.y - 2) < 1e-14,
       "a level ray runs into the rise");
    p = vec3(7, 7, 7);
    OK(!plane_intersect(&plane, &p, vec3(0, 0, 1), vec3(0, -1, 0)), "and never the other way");
    OK(!plane_intersect(&plane, &p, vec3(0, 0, 1), vec3(5, 0, 0)), "nor along the slope's contour");
    OK(!plane_intersect(&plane, &p, vec3(0, 0, 1), vec3(0, 0, 1)), "nor upwards");
    OK(p.x == 7 && p.y == 7 && p.z == 7, "what does not meet leaves the point alone");
}

/* Camera at `centre`, looking along heading and down by a pitch. */
static struct pose looking(struct vec3 centre, double heading_rad, double down_rad)
{
    struct vec3 right = vec3(cos(heading_rad), -sin(heading_rad), 0);
    struct vec3 forward = vec3(sin(heading_rad) * cos(down_rad), cos(heading_rad) * cos(down_rad), -sin(down_rad));
    return (struct pose){ mat3_from_columns(right, vec3_cross(forward, right), forward), centre };
}

static void check_pixels(void)
{
    const struct camera cameras[] = {
        { CAMERA_PINHOLE, 2000, 1500, { 1000, 1000, 1000, 750 } },
        { CAMERA_OPENCV, 2000, 1500, { 1200, 1190, 1010, 740, -0.12, 0.03, 0.001, -0.0005 } },
        { CAMERA_OPENCV_FISHEYE, 2000, 1500, { 700, 700, 1000, 750, 0.02, -0.005, 0.001, 0 } },
    };
    const struct plane ground = { vec3_unit(vec3(0.05, -0.03, 1)), -0.4 };
    const struct pose world_from_camera = looking(vec3(12, -7, 6.4), 0.7, 30 * RAD);
    for (size_t c = 0; c < 3; c++) {
        double worst_px = 0, worst_m = 0;
        int points = 0;
        bool good = true;
        for (int y = 700; y < 1500; y += 100)
            for (int x = 300; x < 1800; x += 100) {
                struct error err = ERROR_NONE;
                struct vec3 p;
                struct vec2 back;
                good = good && ground_from_pixel(&p, &ground, &cameras[c], world_from_camera,
                                                 (struct vec2){ x + 0.25, y + 0.5 }, &err)
                       && camera_project(&cameras[c], &back, pose_apply(pose_inverse(world_from_camera), p), &err);
                if (!good) break;
                worst_px = fmax(worst_px, hypot(back.x - x - 0.25, back.y - y - 0.5));
                worst_m = fmax(worst_m, fabs(vec3_dot(ground.normal, p) - ground.offset_m));
                points++;
            }
        OK(good && points == 120, "%s: the ground is seen in 120 pixels", camera_model_name(cameras[c].model));
        NEAR(worst_px, 0, 1e-6, "and each ground point projects back into its pixel");
        NEAR(worst_m, 0, 1e-11, "and lies in the plane");
    }

    /* 45 deg down from 5 m above level ground: the middle pixel sees 5 m ahead. */
    const struct plane level = { { 0, 0, 1 }, 1 };
    struct error err = ERROR_NONE;
    struct vec3 p = { 0 };
    OK(ground_from_pixel(&p, &level, &cameras[0], looking(vec3(2, 3, 6), M_PI / 2, M_PI / 4),
                         (struct vec2){ 1000, 750 }, &err)
           && vec3_norm(vec3_sub(p, vec3(7, 3, 1))) < 1e-12, "looking 45 deg down to the east sees 5 m east");

    struct { const char *what, *says; struct pose pose; struct vec2 q; enum error_code code; } bad[] = {
        { "the sky", "pixel (1000, 100) looks at or above the horizon", looking(vec3(0, 0, 6), 0, 0),
          { 1000, 100 }, ERR_INPUT },
        { "the horizon itself", "horizon", looking(vec3(0, 0, 6), 0, 0), { 300, 750 }, ERR_INPUT },
        { "a ground above the camera", "the camera stands 3 m below the ground", looking(vec3(0, 0, -2), 0, -M_PI / 4),
          { 1000, 750 }, ERR_INPUT },
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        err = ERROR_NONE;
        p = vec3(7, 7, 7);
        OK(!ground_from_pixel(&p, &level, &cameras[0], bad[i].pose, bad[i].q, &err) && err.code == bad[i].code
               && strstr(err.text, bad[i].says) && p.x == 7, "refuses %s: %s", bad[i].what, err.text);
    }
    /* Barrel distortion this strong folds the picture's corners: no ray goes there. */
    const struct camera folded = { CAMERA_SIMPLE_RADIAL, 2000, 1500, { 800, 1000, 750, -0.5 } };
    err = ERROR_NONE;
    OK(!ground_from_pixel(&p, &level, &folded, looking(vec3(0, 0, 6), 0, 1), (struct vec2){ 5, 1495 }, &err)
           && err.code == ERR_NOT_INVERTIBLE, "passes on that a pixel has no ray: %s", err.text);
}

int main(void)
{
    check_fit();
    check_fit_refusals();
    check_intersect();
    check_pixels();
    return tap_done();
}
