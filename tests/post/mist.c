#include "post/mist.h"
#include "post/optics.h"
#include "post/transfer.h"

#include "tests/post/layers.h"
#include "tests/tap.h"

#define W 12
#define H 9

/* The pixel at (6, 4) of the window looks 45 degrees aside: 30 right and 40 down of the centre, f = 50. */
static struct manifest manifest_of(double visibility)
{
    return (struct manifest){
        .width_px = 200, .height_px = 200,
        .camera = { .model = CAMERA_PINHOLE, .width_px = 200, .height_px = 200, .params = { 50, 50, 76.5, 64.5 } },
        .view = { .width_px = W, .height_px = H, .window_px = { 100, 100, 100 + W, 100 + H } },
        .has_mist = true, .visibility_m = visibility, .haze = { 0.4, 0.5, 0.6 },
    };
}

static const double haze[3] = { 0.4, 0.5, 0.6 }, root = 0.22360679775; /* sqrt(0.05): at half the visibility */

struct scene { struct image photograph, object, plane, shadow, depth, ground; };

/* Everything is 100 m away from the camera at pixel (6, 4), by its ray. An entity of 0.2 covers columns 0 to 4
 * and half of column 5, on ground of 0.1 with 60 % of its light gone in columns from 5; the last column is untouched. */
static struct scene scene_init(float b)
{
    float z = (float)(100 / sqrt(2));
    struct scene s = { filled(W, H, 3, b), filled(W, H, 4, 0), filled(W, H, 4, 0.1f), filled(W, H, 4, 0.1f), filled(W, H, 1, NAN), filled(W, H, 1, z) };
    fill(&s.object, 0, 0, 5, H, (float[]){ 0.2f, 0.2f, 0.2f, 1 });
    fill(&s.object, 5, 0, 6, H, (float[]){ 0.1f, 0.1f, 0.1f, 0.5f });
    fill(&s.depth, 0, 0, 5, H, (float[]){ z });
    fill(&s.plane, 0, 0, W, H, (float[]){ 0.1f, 0.1f, 0.1f, 1 });
    fill(&s.shadow, 0, 0, W, H, (float[]){ 0.1f, 0.1f, 0.1f, 1 });
    fill(&s.shadow, 5, 0, 11, H, (float[]){ 0.04f, 0.04f, 0.04f, 1 });
    return s;
}

static void scene_release(struct scene *s)
{
    image_release(&s->photograph);
    image_release(&s->object);
    image_release(&s->plane);
    image_release(&s->shadow);
    image_release(&s->depth);
    image_release(&s->ground);
}

static bool apply(struct scene *s, const struct manifest *m)
{
    struct image none = { 0 };
    struct error err = ERROR_NONE;
    struct optics_input in = { .manifest = m, .photograph = &s->photograph, .depth = &s->depth, .ground = &s->ground,
                               .motion = &none, .exposure = { 2, 2, 2 } };
    return optics_apply(&s->object, &s->plane, &s->shadow, &in, &err);
}

static bool transfer(struct image *out, const struct scene *s, int which)
{
    struct error err = ERROR_NONE;
    struct image classes;
    struct transfer_input in = { .photograph = &s->photograph, .object = &s->object, .plane = &s->plane,
                                 .shadow = &s->shadow, .exposure = { 2, 2, 2 } };
    struct transfer_thresholds t = { 30, 200, 96, false };
    if (which == 0) return transfer_layers(out, &in, &err);
    if (which == 1) return transfer_ratio(out, &in, &err);
    if (which == 2) return transfer_alpha(out, &in, &err);
    if (!image_init(&classes, W, H, 1, PIXEL_U8, &err)) return false;
    bool ok = transfer_threshold(out, &in, &classes, &t, &err);
    image_release(&classes);
    return ok;
}

static void check_transfers(void)
{
    static const char *const names[] = { "layers", "ratio", "alpha", "threshold" };
    struct manifest m = manifest_of(200);
    for (int i = 0; i < 4; i++) {
        struct scene s = scene_init(0.7f);
        struct image out;
        if (!OK(apply(&s, &m) && transfer(&out, &s, i), "mist, transferred by %s", names[i])) return;
        /* A catcher's shadow is grey: all channels fade as one, by their luminance. */
        bool grey = i >= 2;
        double darker = 0;
        for (int c = 0; c < 3; c++) {
            double own = 1 - haze[c] * (1 - root) / 0.7, weight[] = { 0.2126, 0.7152, 0.0722 };
            darker += weight[c] * 0.6 * own;
        }
        for (int c = 0; c < 3; c++) {
            /* B r + A (1 - T)(1 - r), r = 0.4; k O T + A (1 - T) */
            double shade = 0.7 * 0.4 + haze[c] * (1 - root) * 0.6;
            NEAR((double)image_f32(&out, 6, 4)[c], grey ? 0.7 * (1 - darker) : shade, 1e-5, "shade fades in channel %d", c);
            if (c == 0) NEAR((double)image_f32(&out, 11, 4)[c], (double)0.7f, 0, "what nothing touches keeps every bit");
        }
        image_release(&out);
        scene_release(&s);
    }
}

static void check_entity(void)
{
    struct manifest m = manifest_of(200);
    struct scene s = scene_init(0.7f);
    if (!OK(apply(&s, &m), "an entity in mist")) return;
    /* At (4, 4) the ray is 28 right, 40 down of f = 50. */
    double d = 100 / sqrt(2) * sqrt(1 + (28.0 * 28 + 40 * 40) / 2500), t = exp(-2.995732 * d / 200);
    NEAR(2 * (double)image_f32(&s.object, 4, 4)[2], 2 * 0.2 * t + 0.6 * (1 - t), 1e-5, "fades by the distance along its ray");
    d = 100 / sqrt(2) * sqrt(1 + (29.0 * 29 + 40 * 40) / 2500), t = exp(-2.995732 * d / 200);
    NEAR(2 * (double)image_f32(&s.object, 5, 4)[0], 2 * 0.1 * t + 0.4 * (1 - t) * 0.5, 1e-5, "its soft edge by the nearest distance");
    NEAR((double)image_f32(&s.object, 5, 4)[3], 0.5, 0, "its alpha stays");
    OK(image_f32(&s.object, 8, 4)[0] == 0, "and mist adds nothing where there is no entity");
    scene_release(&s);

    s = scene_init(0.01f);
    OK(apply(&s, &m), "a photograph darker than its haze");
    NEAR((double)(image_f32(&s.shadow, 6, 4)[0] / image_f32(&s.plane, 6, 4)[0]), 1, 0, "has no light of the ground that could be shaded");
    scene_release(&s);

    m.has_mist = false;
    s = scene_init(0.7f);
    struct scene clear = scene_init(0.7f);
    OK(apply(&s, &m) && !memcmp(s.object.data, clear.object.data, image_size(&s.object)) &&
           !memcmp(s.shadow.data, clear.shadow.data, image_size(&s.shadow)), "without mist every bit stays");
    OK(!optics_wanted(&m), "and nothing is to do");
    scene_release(&s);
    scene_release(&clear);
}

/* A new view fades as what stands in it does. */
static void a_view_is_veiled(void)
{
    struct camera camera = { .model = CAMERA_PINHOLE, .width_px = 3, .height_px = 1, .params = { 100, 100, 1.5, 0.5 } };
    struct image rgb, ground;
    struct error err = ERROR_NONE;
    if (!image_init(&rgb, 3, 1, 3, PIXEL_U8, &err) || !image_init(&ground, 3, 1, 1, PIXEL_F32, &err)) return;
    const float z[] = { 0, 50, NAN };
    memcpy(ground.data, z, sizeof z);
    for (int i = 0; i < 9; i++) ((uint8_t *)rgb.data)[i] = 200;
    mist_veil(&rgb, &ground, 100, haze, &camera);
    double own = (double)linear_from_srgb(200 / 255.0f), half = own * root + haze[1] * (1 - root);
    NEAR(image_u8(&rgb, 0, 0)[1], 200, 0, "what is right before the lens keeps its colour");
    NEAR(image_u8(&rgb, 1, 0)[1], 255 * (double)srgb_from_linear((float)half), 0.51, "at half the visibility it has faded by Koschmieder's law");
    NEAR(image_u8(&rgb, 2, 0)[1], 255 * (double)srgb_from_linear((float)haze[1]), 0.51, "where nothing is, there is haze");
    image_release(&rgb);
    image_release(&ground);
}

int main(void)
{
    check_transfers();
    check_entity();
    a_view_is_veiled();
    return tap_done();
}
