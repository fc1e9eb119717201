#include "lib/camera.h"
#include "lib/view.h"
#include "post/resample.h"

#include "tests/tap.h"

typedef double pattern(struct vec2 q_px);

static double waves(struct vec2 q)
{
    return 0.5 + 0.4 * sin(2 * M_PI * q.x / 100) * cos(2 * M_PI * q.y / 100);
}

#define EDGE_PX 151.37
static double edge(struct vec2 q)
{
    return q.x < EDGE_PX;
}

/* Where the centre of projection sees, through a view's position, the photograph. */
static bool photograph_from_view(const struct view *view, const struct camera *camera, struct vec2 *q, struct vec2 v)
{
    struct error err = ERROR_NONE;
    struct vec3 d = vec3((v.x - view->cx_px) / view->fx_px, (v.y - view->cy_px) / view->fy_px, 1);
    return camera_project(camera, q, mat3_apply(mat3_transpose(view->view_from_camera), d), &err);
}

/* A rendering of a pattern that is known in the photograph: means of n x n points a pixel. */
static bool render(struct image *image, const struct view *view, const struct camera *camera, pattern *f, int n)
{
    struct error err = ERROR_NONE;
    if (!image_init(image, view->width_px, view->height_px, 4, PIXEL_F32, &err)) return false;
    for (int y = 0; y < image->height_px; y++)
        for (int x = 0; x < image->width_px; x++) {
            double sum = 0;
            for (int k = 0; k < n * n; k++) {
                struct vec2 q, v = { x + (k % n + 0.5) / n, y + (k / n + 0.5) / n };
                if (photograph_from_view(view, camera, &q, v)) sum += f(q);
            }
            float *p = image_f32(image, x, y);
            p[0] = p[1] = p[2] = (float)(sum / (n * n));
            p[3] = 1;
        }
    return true;
}

/* The view of a window of 100 x 60 pixels under a lens. */
static bool resampled(struct image *out, const char *name, const struct camera *camera, struct view *view, pattern *f, int n)
{
    struct error err = ERROR_NONE;
    struct image in;
    if (!OK(view_cover(view, camera, (struct rect){ 100, 90, 200, 150 }, 1, &err), "%s: a view covers the window", name)) {
        printf("# %s\n", err.text);
        return false;
    }
    if (!render(&in, view, camera, f, n)) return false;
    bool ok = OK(resample_view(out, &in, 1, view, camera, &err), "%s: it is resampled", name);
    image_release(&in);
    return ok;
}

static void check_lens(const char *name, const struct camera *camera)
{
    struct view view;
    struct image out;
    if (!resampled(&out, name, camera, &view, waves, 1)) return;
    double worst = 0;
    for (int y = 0; y < out.height_px; y++)
        for (int x = 0; x < out.width_px; x++) {
            struct vec2 q = { view.window_px.x0 + x + 0.5, view.window_px.y0 + y + 0.5 };
            worst = fmax(worst, fabs((double)image_f32(&out, x, y)[0] - waves(q)));
        }
    NEAR(worst, 0, 1e-3, "%s: a smooth image comes out in the photograph's pixels", name);
    NEAR(image_f32(&out, 50, 30)[3], 1, 1e-6, "%s: what is solid stays solid", name);
    image_release(&out);

    if (!resampled(&out, name, camera, &view, edge, 16)) return;
    double off = 0;
    int widest = 0;
    for (int y = 0; y < out.height_px; y++) {
        double bright = 0;
        int between = 0;
        for (int x = 0; x < out.width_px; x++) {
            double v = (double)image_f32(&out, x, y)[0];
            bright += v;
            between += v > 0.001 && v < 0.999;
        }
        off = fmax(off, fabs(view.window_px.x0 + bright - EDGE_PX));
        if (between > widest) widest = between;
    }
    NEAR(off, 0, 0.05, "%s: a straight edge stays where it is in every row", name);
    OK(widest <= 3, "%s: and as sharp: %d pixels are grey", name, widest);
    image_release(&out);
}

static void check_equality(const struct camera *camera)
{
    struct error err = ERROR_NONE;
    struct view view;
    struct image in[2], out[2];
    if (!view_cover(&view, camera, (struct rect){ 100, 90, 200, 150 }, 1, &err)) return;
    for (int k = 0; k < 2; k++)
        if (!image_init(&in[k], view.width_px, view.height_px, 4, PIXEL_F32, &err)) return;
    for (size_t i = 0; i < image_size(&in[0]) / sizeof(float); i++)
        ((float *)in[0].data)[i] = ((float *)in[1].data)[i] = (float)(i * 2654435761u % 1000) / 999;
    *image_f32(&in[1], view.width_px / 2, view.height_px / 2) += 1;
    if (!OK(resample_view(out, in, 2, &view, camera, &err), "two layers that differ in one pixel are resampled")) return;
    int differing = 0;
    for (int i = 0; i < out[0].width_px * out[0].height_px * 4; i++)
        differing += ((float *)out[0].data)[i] != ((float *)out[1].data)[i];
    OK(differing >= 1 && differing <= 9, "and stay equal bit for bit but for its neighbours: %d", differing);
    for (int k = 0; k < 2; k++) image_release(&out[k]);

    struct view half = view;
    half.width_px /= 2;
    struct image left = { half.width_px, half.height_px, 4, PIXEL_F32, in[0].data };
    if (!OK(resample_view(out, &left, 1, &half, camera, &err), "a view that covers half of its window is resampled")) return;
    const float *p = image_f32(&out[0], 95, 30);
    OK(p[0] == 0 && p[3] == 0, "and is empty in the other half");
    image_release(&out[0]);
    for (int k = 0; k < 2; k++) image_release(&in[k]);
}

/* Where a view's pixel lies in the photograph and how large it is there: 0 within 3 px of the window's edge. */
static double area_in_window(const struct view *view, const struct camera *camera, double x, double y)
{
    struct vec2 l, r, a, b;
    if (!photograph_from_view(view, camera, &l, (struct vec2){ x - 0.5, y }) ||
        !photograph_from_view(view, camera, &r, (struct vec2){ x + 0.5, y }) ||
        !photograph_from_view(view, camera, &a, (struct vec2){ x, y - 0.5 }) ||
        !photograph_from_view(view, camera, &b, (struct vec2){ x, y + 0.5 }))
        return 0;
    struct rect w = view->window_px;
    struct vec2 q = { (l.x + r.x) / 2, (l.y + r.y) / 2 };
    if (q.x < w.x0 + 3 || q.y < w.y0 + 3 || q.x > w.x1 - 3 || q.y > w.y1 - 3) return 0;
    return fabs((r.x - l.x) * (b.y - a.y) - (r.y - l.y) * (b.x - a.x));
}

/* Lights up to 1000, as strong as the sun in chrome beside shade. */
static void check_light(const char *name, const struct camera *camera)
{
    struct error err = ERROR_NONE;
    struct view view;
    struct image in[3], out[3];
    if (!OK(view_cover(&view, camera, (struct rect){ 100, 90, 200, 150 }, 1, &err), "%s: a view covers the window", name)) return;
    for (int k = 0; k < 3; k++)
        if (!image_init(&in[k], view.width_px, view.height_px, 4, PIXEL_F32, &err)) return;
    double energy = 0;
    uint32_t state = 1;
    for (int y = 0; y < view.height_px; y++)
        for (int x = 0; x < view.width_px; x++) {
            double area = area_in_window(&view, camera, x + 0.5, y + 0.5);
            if (area == 0) continue;
            float light[2];
            for (int k = 0; k < 2; k++) {
                state = state * 1664525 + 1013904223;
                light[k] = powf(10, (float)(state >> 8) / 0x1p24f * 4 - 1);
                image_f32(&in[k], x, y)[1] = light[k];
            }
            image_f32(&in[2], x, y)[1] = 2 * light[0] + light[1] / 3;
            energy += area * (double)light[0];
        }
    if (!OK(resample_view(out, in, 3, &view, camera, &err), "%s: a light, another, and a mixture are resampled", name)) return;
    double sum = 0, off = 0;
    for (int y = 0; y < out[0].height_px; y++)
        for (int x = 0; x < out[0].width_px; x++) {
            double a = (double)image_f32(&out[0], x, y)[1], b = (double)image_f32(&out[1], x, y)[1];
            double both = 2 * a + b / 3;
            sum += a;
            if (both > 0) off = fmax(off, fabs((double)image_f32(&out[2], x, y)[1] - both) / both);
        }
    NEAR(off, 0, 1e-5, "%s: the mixture of lights is the light of the mixture", name);
    NEAR(sum / energy, 1, 0.01, "%s: the photograph receives as much light as the view has", name);
    for (int k = 0; k < 3; k++) {
        image_release(&in[k]);
        image_release(&out[k]);
    }
}

static void check_aligned(void)
{
    float p[2 * 3 * 4];
    for (int i = 0; i < 24; i++) p[i] = (float)i / 7;
    struct image in = { 2, 3, 4, PIXEL_F32, p }, out;
    struct camera camera = { .model = CAMERA_PINHOLE, .width_px = 10, .height_px = 10, .params = { 10, 10, 5, 5 } };
    struct view view = { .width_px = 2, .height_px = 3, .window_px = { 4, 5, 6, 8 }, .aligned = true };
    struct error err = ERROR_NONE;
    if (!OK(resample_view(&out, &in, 1, &view, &camera, &err), "an aligned view is taken over")) return;
    OK(!memcmp(out.data, p, sizeof p), "pixel by pixel");
    image_release(&out);
}

/* A lens that folds back: outside of a circle no direction leads to the photograph's pixels. */
static void check_fold(void)
{
    struct camera camera = { .model = CAMERA_SIMPLE_RADIAL, .width_px = 400, .height_px = 320, .params = { 200, 200, 160, -0.3 } };
    struct view view;
    struct image in, out;
    struct error err = ERROR_NONE;
    if (!OK(view_cover(&view, &camera, (struct rect){ 150, 110, 250, 210 }, 1, &err), "a view covers the middle of a folding lens")) return;
    if (!render(&in, &view, &camera, waves, 1)) return;
    view.window_px = (struct rect){ 0, 0, 400, 320 };
    if (!OK(resample_view(&out, &in, 1, &view, &camera, &err), "and is resampled into the whole photograph")) return;
    OK(image_f32(&out, 2, 2)[3] == 0, "a corner that has no direction is empty");
    NEAR(image_f32(&out, 200, 160)[0], waves((struct vec2){ 200.5, 160.5 }), 1e-3, "the middle is there");
    image_release(&in);
    image_release(&out);
}

int main(void)
{
    const struct camera barrel = { .model = CAMERA_OPENCV, .width_px = 400, .height_px = 320,
                                   .params = { 260, 262, 203, 158, -0.16, 0.03, 0.002, -0.003 } };
    const struct camera fisheye = { .model = CAMERA_OPENCV_FISHEYE, .width_px = 400, .height_px = 320,
                                    .params = { 180, 180, 200, 160, 0.02, -0.004, 0, 0 } };
    const struct camera rim = { .model = CAMERA_OPENCV_FISHEYE, .width_px = 400, .height_px = 320,
                                    .params = { 170, 172, 330, 260, 0.02, -0.004, 0, 0 } };
    check_lens("barrel", &barrel);
    check_lens("fisheye", &fisheye);
    check_light("barrel", &barrel);
    check_light("fisheye", &fisheye);
    check_light("fisheye, 95 deg off its axis", &rim);
    check_equality(&barrel);
    check_aligned();
    check_fold();
    return tap_done();
}
