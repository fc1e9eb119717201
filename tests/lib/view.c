#include "lib/view.h"

#include "tests/tap.h"

static const struct camera pinhole = { CAMERA_PINHOLE, 640, 480, { 510, 490, 350.25, 231.5 } };
static const struct rect whole = { 0, 0, 640, 480 };

static const struct sample {
    const char *what;
    struct camera camera;
    struct rect window;
} samples[] = {
    { "SIMPLE_RADIAL, barrel", { CAMERA_SIMPLE_RADIAL, 640, 480, { 500, 300.25, 251.5, -0.2 } }, { 0, 0, 640, 480 } },
    { "SIMPLE_RADIAL, pincushion", { CAMERA_SIMPLE_RADIAL, 640, 480, { 400, 300.25, 251.5, 0.4 } }, { 0, 0, 640, 480 } },
    { "RADIAL, moustache", { CAMERA_RADIAL, 640, 480, { 400, 300.25, 251.5, -0.34, 0.15 } }, { 31, 17, 640, 480 } },
    { "OPENCV", { CAMERA_OPENCV, 640, 480, { 460, 470, 350.5, 219.5, -0.15, 0.08, 0.03, -0.02 } }, { 400, 300, 640, 480 } },
    { "OPENCV, one pixel", { CAMERA_OPENCV, 640, 480, { 460, 470, 350.5, 219.5, -0.15, 0.08, 0.03, -0.02 } }, { 639, 479, 640, 480 } },
    { "OPENCV, a line", { CAMERA_OPENCV, 640, 480, { 460, 470, 350.5, 219.5, -0.15, 0.08, 0.03, -0.02 } }, { 0, 479, 640, 480 } },
    { "FULL_OPENCV", { CAMERA_FULL_OPENCV, 640, 480, { 420, 421, 330.5, 229.5, 0.9, 0.15, 0.0007, -0.0004, 0.02, 1.2, 0.35, 0.03 } }, { 0, 0, 640, 480 } },
    { "FOV", { CAMERA_FOV, 640, 480, { 400, 402, 330.5, 229.5, 0.92 } }, { 0, 0, 640, 480 } },
    { "OPENCV_FISHEYE, off the axis", { CAMERA_OPENCV_FISHEYE, 640, 480, { 180, 181, 310.5, 250.5, 0.02, -0.005, 0.001, -0.0001 } }, { 0, 0, 200, 480 } },
    { "OPENCV_FISHEYE, beyond 90 deg", { CAMERA_OPENCV_FISHEYE, 640, 480, { 180, 181, 310.5, 250.5, 0.02, -0.005, 0.001, -0.0001 } }, { 560, 380, 640, 480 } },
    { "SIMPLE_RADIAL_FISHEYE", { CAMERA_SIMPLE_RADIAL_FISHEYE, 640, 480, { 320, 310.5, 250.5, -0.01 } }, { 0, 0, 640, 480 } },
    { "RADIAL_FISHEYE", { CAMERA_RADIAL_FISHEYE, 640, 480, { 190, 310.5, 250.5, 0.03, -0.004 } }, { 100, 0, 500, 130 } },
    { "THIN_PRISM_FISHEYE", { CAMERA_THIN_PRISM_FISHEYE, 640, 480, { 340, 341, 325.5, 236.5, -0.02, 0.01, 0.0004, -0.0006, -0.004, 0.0005, 0.0012, -0.0009 } }, { 0, 0, 640, 480 } },
};

static void covers(const struct sample *sample, double fineness)
{
    const struct camera *camera = &sample->camera;
    struct rect w = sample->window;
    struct view view;
    struct error err = ERROR_NONE;
    if (!OK(view_cover(&view, camera, w, fineness, &err), "%s: a view covers the window", sample->what)) {
        printf("# %s\n", err.text);
        return;
    }
    OK(!view.aligned && view.window_px.x0 == w.x0 && view.window_px.y1 == w.y1, "%s: it is a view through a lens", sample->what);
    NEAR(mat3_orthonormality(view.view_from_camera) + fabs(mat3_determinant(view.view_from_camera) - 1), 0, 1e-14,
         "%s: turned, not bent", sample->what);
    /* Every pixel's centre lies in the view with room for a cubic filter; across no pixel,
     * in any direction, lie fewer of the view's than were wanted. */
    double inside = INFINITY, least = INFINITY;
    for (int y = w.y0; y < w.y1; y++)
        for (int x = w.x0; x < w.x1; x++) {
            struct vec2 c, r, b, l, a;
            if (!view_from_photograph(&view, camera, &c, (struct vec2){ x + 0.5, y + 0.5 }, &err)) continue;
            inside = fmin(inside, fmin(fmin(c.x, c.y), fmin(view.width_px - c.x, view.height_px - c.y)));
            if ((x % 5 && x != w.x0 && x != w.x1 - 1) || (y % 5 && y != w.y0 && y != w.y1 - 1)) continue;
            view_from_photograph(&view, camera, &l, (struct vec2){ x + 0.49, y + 0.5 }, &err);
            view_from_photograph(&view, camera, &r, (struct vec2){ x + 0.51, y + 0.5 }, &err);
            view_from_photograph(&view, camera, &a, (struct vec2){ x + 0.5, y + 0.49 }, &err);
            view_from_photograph(&view, camera, &b, (struct vec2){ x + 0.5, y + 0.51 }, &err);
            double xx = (r.x - l.x) / 0.02, xy = (r.y - l.y) / 0.02, yx = (b.x - a.x) / 0.02, yy = (b.y - a.y) / 0.02;
            double sum = xx * xx + xy * xy + yx * yx + yy * yy, area = xx * yy - xy * yx;
            least = fmin(least, sqrt((sum - sqrt(fmax(sum * sum - 4 * area * area, 0))) / 2));
        }
    OK(err.code == ERR_OK && inside >= 2, "%s: every pixel centre lies in the view, 2 px from its edge", sample->what);
    OK(least >= fineness, "%s: everywhere a photograph pixel is %g of the view's", sample->what, fineness);
    OK(least <= 1.01 * fineness, "%s: nor is the view finer than it must be", sample->what);
}

int main(void)
{
    struct view view;
    struct vec2 v;
    struct error err = ERROR_NONE;
    struct rect window = { 100, 50, 300, 180 };
    OK(view_cover(&view, &pinhole, window, 1.5, &err) && view.aligned && view.width_px == 200 && view.height_px == 130,
       "a pinhole camera's view is the window itself, however fine it was wanted");
    OK(view.fx_px == 510 && view.fy_px == 490 && view.cx_px == 250.25 && view.cy_px == 181.5,
       "with the camera's focal lengths and a shifted principal point");
    OK(memcmp(&view.view_from_camera, &(struct mat3){ { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } }, sizeof(struct mat3)) == 0,
       "and not turned");
    OK(view_from_photograph(&view, &pinhole, &v, (struct vec2){ 100.5, 179.5 }, &err) && v.x == 0.5 && v.y == 129.5,
       "pixel on pixel");
    for (size_t i = 0; i < sizeof samples / sizeof *samples; i++) covers(samples + i, i % 2 ? 1.5 : 1);

    /* The pinhole figures of the view and its rotation must describe the same mapping as
     * view_from_photograph: what POV-Ray renders is these, and nothing else. */
    const struct camera *lens = &samples[8].camera;
    OK(view_cover(&view, lens, samples[8].window, 1, &err), "a view off the axis");
    struct vec3 p = { -3, 0.4, 0.6 };
    struct vec2 q = { NAN, NAN };
    OK(camera_project(lens, &q, p, &err) && view_from_photograph(&view, lens, &v, q, &err), "a point seen in it");
    struct vec3 turned = mat3_apply(view.view_from_camera, p);
    NEAR(v.x, view.fx_px * turned.x / turned.z + view.cx_px, 1e-8, "lies where the pinhole puts it, x");
    NEAR(v.y, view.fy_px * turned.y / turned.z + view.cy_px, 1e-8, "and y");
    OK(!view_from_photograph(&view, lens, &v, (struct vec2){ 639, 250 }, &err) && err.code == ERR_BEHIND_CAMERA,
       "the other side of a fisheye picture lies behind it");

    struct view untouched = { .width_px = -7 };
    err = ERROR_NONE;
    OK(!view_cover(&untouched, lens, whole, 1, &err) && err.code == ERR_INPUT && untouched.width_px == -7,
       "a whole fisheye picture is refused");
    OK(strstr(err.text, "x 0 to 640, y 0 to 480, spans") && strstr(err.text, "150 deg"), "with the window and the limit: %s",
       err.text);
    const struct camera large = { CAMERA_SIMPLE_RADIAL, 20000, 15000, { 15000, 10000, 7500, -0.05 } };
    const struct rect all = { 0, 0, 20000, 15000 };
    struct view own, finer;
    OK(view_cover(&own, &large, all, 1, &err) && view_cover(&finer, &large, all, 2, &err), "a large photograph's view can be wanted finer");
    OK(own.width_px < 30000 && finer.width_px > 32700 && finer.width_px <= 32767, "and is so as far as there is room: %d, %d", own.width_px, finer.width_px);
    struct camera folded = { CAMERA_SIMPLE_RADIAL, 640, 480, { 400, 300.25, 251.5, -0.35 } };
    err = ERROR_NONE;
    OK(!view_cover(&untouched, &folded, whole, 1, &err) && err.code == ERR_INPUT && untouched.width_px == -7,
       "a window beyond the lens's fold is refused");
    OK(strstr(err.text, "pixel (0.0, 0.0)") && strstr(err.text, "44.3 deg"), "with the pixel and the angle: %s", err.text);
    return tap_done();
}
