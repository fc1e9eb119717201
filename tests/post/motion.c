#include "post/motion.h"

#include "tests/post/layers.h"
#include "tests/tap.h"

#define W 40
#define H 21

struct scene { struct image object, light, motion, depth, plane; };

/* An entity in columns 10 to 29 and rows 5 to 14, half covering, on ground that it shades by 0.4 there;
 * the ground reaches from column 5 to 34. Everything on it moves. */
static struct scene scene_init(float dx, float dy)
{
    struct scene s = { filled(W, H, 4, 0), filled(W, H, 3, 0), filled(W, H, 3, 0), filled(W, H, 1, NAN), filled(W, H, 4, 0) };
    fill(&s.object, 10, 5, 30, 15, (float[]){ 0.2f, 0.1f, 0.05f, 0.5f });
    fill(&s.light, 10, 5, 30, 15, (float[]){ -0.4f, -0.4f, -0.4f });
    fill(&s.motion, 5, 0, 35, H, (float[]){ dx, dy, 0 });
    fill(&s.depth, 10, 5, 30, 15, (float[]){ 12 });
    fill(&s.plane, 5, 0, 35, H, (float[]){ 0.1f, 0.1f, 0.1f, 1 });
    return s;
}

static void scene_release(struct scene *s)
{
    image_release(&s->object);
    image_release(&s->light);
    image_release(&s->motion);
    image_release(&s->depth);
    image_release(&s->plane);
}

static bool blur(struct scene *s, const struct image *visible)
{
    struct error err = ERROR_NONE;
    return motion_blur(&s->object, &s->light, &s->motion, &s->depth, &s->plane, visible, visible, &err);
}

/* An edge at x = 10 that moves 4 px: the pixel with its middle at x + 0.5 is covered (x + 2.5 - 10) / 4 of the time. */
static void check_ramp(void)
{
    struct scene s = scene_init(4, 0);
    const double want[] = { 0, 0.125, 0.375, 0.625, 0.875, 1 };
    if (!OK(blur(&s, NULL), "what moves is blurred")) return;
    for (int i = 0; i < 6; i++) {
        NEAR((double)image_f32(&s.object, 7 + i, 10)[3], 0.5 * want[i], 1e-6, "column %d is covered %g of the time", 7 + i, want[i]);
        NEAR((double)image_f32(&s.light, 7 + i, 10)[0], -0.4 * want[i], 1e-6, "and shaded");
        NEAR((double)image_f32(&s.object, 32 - i, 10)[3], 0.5 * want[i], 1e-6, "the far edge is the mirror image");
    }
    NEAR((double)image_f32(&s.object, 9, 10)[1], 0.1 * 0.375, 1e-6, "colours go with their coverage");
    OK(image_f32(&s.object, 12, 4)[3] == 0 && image_f32(&s.light, 12, 15)[0] == 0, "nothing moves across the way");
    scene_release(&s);
}

static void check_energy(void)
{
    const float ways[][2] = { { 4, 0 }, { 0, -5 }, { 3, 4 }, { -2.3f, 1.7f }, { 0.2f, 0.1f } };
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++) {
        struct scene s = scene_init(ways[i][0], ways[i][1]);
        OK(blur(&s, NULL), "a way of %g,%g", (double)ways[i][0], (double)ways[i][1]);
        NEAR(sum_of(&s.object, 3), 0.5 * 200, 1e-3, "its entity is neither more nor less");
        NEAR(sum_of(&s.object, 0), 0.2 * 200, 1e-3, "nor brighter");
        NEAR(sum_of(&s.light, 1), -0.4 * 200, 1e-3, "nor its shadow darker");
        scene_release(&s);
    }
}

static void check_rest(void)
{
    struct scene s = scene_init(0, 0), still = scene_init(0, 0);
    OK(blur(&s, NULL) && !memcmp(s.object.data, still.object.data, image_size(&s.object)) &&
           !memcmp(s.light.data, still.light.data, image_size(&s.light)), "what rests keeps every bit");
    scene_release(&s);
    /* Beside the ground, as the light on the nearest of it. */
    s = scene_init(6, 0);
    fill(&s.light, 0, 0, W, H, (float[]){ 0, 0, 0 });
    fill(&s.light, 5, 5, 10, 15, (float[]){ -0.4f, -0.4f, -0.4f });
    OK(blur(&s, NULL), "a shadow at the end of the ground");
    NEAR((double)image_f32(&s.light, 4, 10)[0], -0.4 * 2.5 / 6, 1e-6, "goes on beyond it");
    OK(image_f32(&s.light, 1, 10)[0] == 0, "for half of its way");
    scene_release(&s);
    scene_release(&still);
}

static void check_hidden(void)
{
    struct scene s = scene_init(4, 0);
    struct image visible = hidden_between(W, H, 20, 30); /* what hides goes on to the right, where no mask says so */
    if (!OK(blur(&s, &visible), "an entity half hidden")) return;
    NEAR((double)image_f32(&s.object, 19, 10)[3], 0.5, 1e-6, "is not thinned beside what hides it");
    NEAR((double)image_f32(&s.object, 19, 10)[0], 0.2, 1e-6, "nor darkened");
    OK(image_f32(&s.object, 30, 10)[3] == 0, "and its hidden end does not come out");
    NEAR((double)image_f32(&s.object, 9, 10)[3], 0.5 * 0.375, 1e-6, "its free end does");
    image_release(&visible);
    scene_release(&s);
}

static void check_endless(void)
{
    const float ways[][2] = { { 3e9f, 0 }, { 0, INFINITY }, { NAN, NAN } };
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++) {
        struct scene s = scene_init(ways[i][0], ways[i][1]);
        if (!OK(blur(&s, NULL), "a way of %g,%g px", (double)ways[i][0], (double)ways[i][1])) return;
        float alpha = image_f32(&s.object, 20, 10)[3];
        if (i == 0) NEAR((double)alpha, 0.5 * 20 / MOTION_MAX_PX, 1e-4, "what passes close by is held to MOTION_MAX_PX");
        else OK(alpha == 0.5f, "and what has no way stays");
        scene_release(&s);
    }
}

int main(void)
{
    check_endless();
    check_ramp();
    check_energy();
    check_rest();
    check_hidden();
    return tap_done();
}
