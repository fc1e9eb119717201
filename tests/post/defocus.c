#include "post/defocus.h"

#include "tests/post/layers.h"
#include "tests/tap.h"

#define W 41
#define H 41

/* Of a point of alpha 1 at (20, 20), 10 m away, on ground shaded by 0.4 there that is ground_m away. */
struct scene { struct image object, light, depth, ground; };

static struct scene scene_init(int half, float ground_m)
{
    struct scene s = { filled(W, H, 4, 0), filled(W, H, 3, 0), filled(W, H, 1, NAN), filled(W, H, 1, ground_m) };
    fill(&s.object, 20 - half, 20 - half, 21 + half, 21 + half, (float[]){ 0.5f, 0.25f, 0.1f, 1 });
    fill(&s.light, 20 - half, 20 - half, 21 + half, 21 + half, (float[]){ -0.4f, -0.4f, -0.4f });
    fill(&s.depth, 20 - half, 20 - half, 21 + half, 21 + half, (float[]){ 10 });
    return s;
}

static void scene_release(struct scene *s)
{
    image_release(&s->object);
    image_release(&s->light);
    image_release(&s->depth);
    image_release(&s->ground);
}

static bool blur(struct scene *s, const struct image *visible, double at_infinity, double focus)
{
    struct error err = ERROR_NONE;
    return defocus_blur(&s->object, &s->light, &s->depth, &s->ground, visible, visible, at_infinity, focus, &err);
}

static void check_diameter(void)
{
    NEAR(defocus_diameter_px(4, 5, 10), 2, 1e-12, "at twice the distance of focus the disc is half of that at infinity");
    NEAR(defocus_diameter_px(4, 5, 5), 0, 0, "at the focus it is a point");
    NEAR(defocus_diameter_px(4, 5, 2.5), 4, 1e-12, "at half the distance as large as at infinity");
    NEAR(defocus_diameter_px(4, 5, 1e9), 4, 1e-6, "which is given");
    NEAR(defocus_diameter_px(4, 5, (double)NAN), 0, 0, "at a distance that is not known there is none");
    NEAR(defocus_diameter_px(4, 5, 1e-3), DEFOCUS_MAX_PX, 0, "and there is an end to it");
}

/* A disc of radius 1 covers its own pixel, of its neighbours sqrt(3)/4 + pi/6 - 1/2 = 0.456612 each, and of
 * each pixel at a corner a quarter of what is left of pi: 0.078786. */
static void check_disc(void)
{
    struct scene s = scene_init(0, 5);
    if (!OK(blur(&s, NULL, 4, 5), "a point out of focus, its ground in focus")) return;
    NEAR((double)image_f32(&s.object, 20, 20)[3], 1 / M_PI, 2e-4, "the disc of 2 px: its middle");
    NEAR((double)image_f32(&s.object, 21, 20)[3], 0.456612 / M_PI, 2e-4, "a side");
    NEAR((double)image_f32(&s.object, 19, 21)[3], 0.078786 / M_PI, 2e-4, "a corner");
    OK(image_f32(&s.object, 22, 20)[3] == 0, "and no further");
    NEAR((double)image_f32(&s.object, 20, 19)[1], 0.25 * 0.456612 / M_PI, 2e-4, "colours go with their coverage");
    NEAR((double)image_f32(&s.light, 20, 20)[0], (double)-0.4f, 0, "the ground in focus keeps every bit");
    scene_release(&s);

    const double diameters[] = { 1.5, 3, 7.3, 12 };
    for (size_t i = 0; i < sizeof diameters / sizeof *diameters; i++) {
        s = scene_init(0, 10);
        OK(blur(&s, NULL, 2 * diameters[i], 5), "a disc of %g px", diameters[i]);
        NEAR(sum_of(&s.object, 3), 1, 1e-5, "is as much as the point was");
        NEAR(sum_of(&s.light, 2), (double)-0.4f, 1e-5, "and its shadow");
        scene_release(&s);
    }
    s = scene_init(0, 10);
    /* A disc's variance along a line is R^2/4; its pixels add a twelfth. */
    OK(blur(&s, NULL, 24, 5), "of 12 px");
    NEAR(variance_of(&s.object, 3, 20), 36 / 4.0 + 1 / 12.0, 0.03, "has the variance of a disc");
    NEAR(variance_of(&s.light, 0, 20), 36 / 4.0 + 1 / 12.0, 0.03, "and so has the shadow");
    scene_release(&s);
}

static void check_edges(void)
{
    struct scene s = scene_init(8, 10), sharp = scene_init(8, 10);
    OK(blur(&s, NULL, 4, 10) && !memcmp(s.object.data, sharp.object.data, image_size(&s.object)) &&
           !memcmp(s.light.data, sharp.light.data, image_size(&s.light)), "what is in focus keeps every bit");
    scene_release(&s);
    s = scene_init(8, 10);
    if (!OK(blur(&s, NULL, 8, 5), "a large thing out of focus")) return;
    NEAR((double)image_f32(&s.object, 20, 20)[3], 1, 1e-6, "is whole inside");
    NEAR((double)image_f32(&s.object, 28, 20)[3] + (double)image_f32(&s.object, 29, 20)[3], 1, 1e-5, "its edge is half way where it was");
    OK(image_f32(&s.object, 31, 20)[3] == 0, "and nothing is beyond the radius of 2 px");
    scene_release(&s);
    scene_release(&sharp);

    s = scene_init(8, 10);
    struct image visible = hidden_between(W, H, 20, 29), none = { 0 };
    struct error err = ERROR_NONE;
    OK(blur(&s, &visible, 8, 5), "a thing half hidden");
    NEAR((double)image_f32(&s.object, 19, 20)[0], 0.5, 1e-6, "is not darkened beside what hides it");
    OK(image_f32(&s.object, 29, 20)[3] == 0, "and what is hidden does not come out");
    scene_release(&s);
    s = scene_init(0, 10);
    OK(defocus_blur(&s.object, &s.light, &s.depth, &none, NULL, NULL, 4, 5, &err), "without a depth of the ground");
    NEAR((double)image_f32(&s.light, 21, 20)[0], -0.4 * 0.456612 / M_PI, 2e-4, "a shadow is as blurred as what casts it");
    image_release(&visible);
    scene_release(&s);
}

int main(void)
{
    check_diameter();
    check_disc();
    check_edges();
    return tap_done();
}
