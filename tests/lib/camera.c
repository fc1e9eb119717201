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

static void round_trip(const struct sample *sample)
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
    printf("# %s: %d of %d, px %g rad %g, limit %g deg\n", sample->what, found, all, worst_px, worst_rad,
           camera_invertible_angle_rad(camera) * 180 / M_PI);
    NEAR(worst_px, 0, 1e-6, "%s: project(unproject(q)) is q", sample->what);
    /* At a fold a ray moves by the root of what its pixel moves. */
    NEAR(worst_rad * camera_intrinsics(camera).fx_px, 0, sample->whole ? 1e-6 : 1e-3,
         "%s: unproject(project(p)) is p's direction, in px at the centre", sample->what);
    NEAR(worst_norm, 0, 1e-14, "%s: rays have unit length", sample->what);
    OK(unlike == 0, "%s: what has a ray has an image, and what has none says not invertible", sample->what);
    OK(sample->whole ? found == all : found < all && found > all / 3, "%s: %s", sample->what,
       sample->whole ? "every pixel has a ray" : "the folded corners have none");
}

int main(void)
{
    for (size_t i = 0; i < sizeof samples / sizeof *samples; i++) round_trip(samples + i);
    return tap_done();
}
