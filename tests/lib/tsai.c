/* The demo's camera: PETS 2009 S2.L1 View 001 (vtest.avi), whose published calibration is Tsai's.
 *
 * Tsai bends the other way round: undistorted = distorted (1 + kappa1 r^2), in mm on the sensor, so
 * its inverse has no polynomial. The OPENCV camera below holds it over the whole picture: k1 and k2
 * are the fit of least maximum error in pixels (0.0052 px, at a corner). Focal lengths and principal
 * point follow exactly: fx = f sx / dpx, fy = f / dpy, and half a pixel more for cx and cy, since
 * Tsai's frame buffer has its pixel centres at whole numbers. Millimetres become metres.
 *
 * Src: R. Y. Tsai, A versatile camera calibration technique, IEEE J. Robotics and Automation 3 (1987) */
#include "lib/camera.h"

#include "tests/tap.h"

static const struct camera demo_camera = {
    CAMERA_OPENCV, 768, 576,
    { 1185.0013005, 1194.6060868, 324.72149053, 283.06650050, -0.156818, 0.061820, 0, 0 },
};
static const struct pose camera_from_world = {
    { { { 0.56957867142843, -0.82031235269296, -0.05165056701692 },
        { -0.26160776598835, -0.12135625670168, -0.95751450941170 },
        { 0.77919286048347, 0.55889203159349, -0.28372201746233 } } },
    { 0.82873214225, -3.1754796051, 35.469298547 },
};
/* world_from_camera: the transpose, and the camera's place */
static const struct vec3 centre_world = { -28.94018247, -19.52905343, 7.06565763 };

/* As published. */
static const double f_mm = 5.5549183034, kappa1 = 5.1113043639e-3, cx = 324.22149053, cy = 282.56650051,
                    sx = 1.0937855397, dpx_mm = 5.1273271277e-3, dpy_mm = 4.65e-3,
                    tx_mm = 828.73214225, ty_mm = -3175.4796051, tz_mm = 35469.298547,
                    rx_rad = 2.0405458695, ry_rad = -0.89337703748, rz_rad = -0.43056124791;

/* World mm to frame buffer. */
static struct vec2 tsai_project(double x, double y, double z)
{
    double a = cos(rx_rad), b = sin(rx_rad), c = cos(ry_rad), d = sin(ry_rad), e = cos(rz_rad), g = sin(rz_rad);
    double xc = c * e * x + (e * b * d - a * g) * y + (b * g + a * e * d) * z + tx_mm;
    double yc = c * g * x + (b * d * g + a * e) * y + (a * d * g - e * b) * z + ty_mm;
    double zc = -d * x + c * b * y + a * c * z + tz_mm;
    double xu = f_mm * xc / zc, yu = f_mm * yc / zc, ru = hypot(xu, yu), rd = ru;
    for (int i = 0; i < 50; i++) rd -= (rd + kappa1 * rd * rd * rd - ru) / (1 + 3 * kappa1 * rd * rd);
    return (struct vec2){ sx * xu * rd / ru / dpx_mm + cx, yu * rd / ru / dpy_mm + cy };
}

int main(void)
{
    double worst = 0;
    for (int y = 0; y <= 576; y += 6)
        for (int x = 0; x <= 768; x += 6) {
            double xd = (x - 0.5 - cx) * dpx_mm / sx, yd = (y - 0.5 - cy) * dpy_mm;
            double undistort = 1 + kappa1 * (xd * xd + yd * yd);
            struct vec2 q = { NAN, NAN };
            struct error err = ERROR_NONE;
            camera_project(&demo_camera, &q, vec3(xd * undistort, yd * undistort, f_mm), &err);
            worst = fmax(worst, fmax(fabs(q.x - x), fabs(q.y - y)));
            if (err.code != ERR_OK) worst = INFINITY;
        }
    NEAR(worst, 0, 0.006, "the OPENCV camera is Tsai's lens over the whole picture, in px");

    /* 30 m by 30 m of the ground around the path junction, and as far as a head above it. */
    double worst_pose = 0;
    int seen = 0;
    for (int i = 0; i < 16; i++)
        for (int j = 0; j < 16; j++)
            for (int k = 0; k < 2; k++) {
                double x = -20 + 2 * i, y = -20 + 2 * j, z = 1.8 * k;
                struct vec2 want = tsai_project(1000 * x, 1000 * y, 1000 * z), got = { NAN, NAN };
                if (!(want.x >= 0 && want.x <= 767 && want.y >= 0 && want.y <= 575)) continue;
                struct error err = ERROR_NONE;
                seen++;
                if (!camera_project(&demo_camera, &got, pose_apply(camera_from_world, vec3(x, y, z)), &err))
                    worst_pose = INFINITY;
                worst_pose = fmax(worst_pose, hypot(got.x - want.x - 0.5, got.y - want.y - 0.5));
            }
    OK(seen > 100, "%d points of the place are in the picture", seen);
    NEAR(worst_pose, 0, 0.006, "world points in metres fall where Tsai puts them, in px");

    struct pose world_from_camera = pose_inverse(camera_from_world);
    NEAR(mat3_orthonormality(camera_from_world.rotation), 0, 1e-13, "the rotation is one");
    NEAR(mat3_determinant(camera_from_world.rotation), 1, 1e-13, "and does not mirror");
    NEAR(world_from_camera.translation.z, 7.07, 0.005, "the camera stands 7.07 m high");
    NEAR(vec3_norm(vec3_sub(world_from_camera.translation, centre_world)), 0, 1e-7, "at the place stated above");
    return tap_done();
}
