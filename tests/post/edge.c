#include "post/edge.h"

#include "post/compression.h"
#include "post/softness.h"
#include "tests/post/taken.h"
#include "tests/tap.h"

#include <string.h>

#define W 480
#define H 360
#define FINE 5 /* samples a pixel and side */

/* Squares, each turned otherwise, of 60 px on grey. */
static double square(double x, double y)
{
    double u = fmod(x, 120) - 60, v = fmod(y, 120) - 60, turn = 0.1 + 0.23 * floor(x / 120) + 0.41 * floor(y / 120);
    double a = u * cos(turn) + v * sin(turn), b = v * cos(turn) - u * sin(turn);
    return fabs(a) < 30 && fabs(b) < 30 ? 1 : 0;
}

/* Seen by pixels of full area. */
static struct image covered(void)
{
    struct image cover;
    struct error err = ERROR_NONE;
    if (!image_init(&cover, W, H, 4, PIXEL_F32, &err)) exit(99);
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++) {
            double sum = 0;
            for (int j = 0; j < FINE; j++)
                for (int i = 0; i < FINE; i++) sum += square(x + (i + 0.5) / FINE, y + (j + 0.5) / FINE) / (FINE * FINE);
            for (int c = 0; c < 4; c++) image_f32(&cover, x, y)[c] = (float)(c < 3 ? 0.5 * sum : sum);
        }
    return cover;
}

static struct image levels_of(const struct image *layer)
{
    struct image levels;
    struct error err = ERROR_NONE;
    if (!image_init(&levels, W, H, 3, PIXEL_F32, &err)) exit(99);
    for (int i = 0; i < W * H; i++) {
        const float *px = (const float *)layer->data + 4 * i;
        for (int c = 0; c < 3; c++) ((float *)levels.data)[3 * i + c] = 255 * srgb_from_linear(0.08f * (1 - px[3]) + px[c]);
    }
    return levels;
}

/* Takes the levels. */
static struct image taken(struct image levels, double sharpening, double grain, int step)
{
    struct image rgb = grey(W, H, 0);
    struct error err = ERROR_NONE;
    if (sharpening > 0) camera_sharpens(&levels, sharpening);
    for (size_t i = 0; i < image_size(&rgb); i++) ((uint8_t *)rgb.data)[i] = byte((double)((float *)levels.data)[i] + grain * noise());
    struct compression c = { .found = true, .width_px = W, .height_px = H, .components = 3, .across = { 2, 1, 1 }, .down = { 2, 1, 1 } };
    for (int i = 0; i < 3 * 64; i++) c.table[i / 64][i % 64] = (uint16_t)step;
    if (step > 1) compression_apply(&rgb, (struct rect){ 0, 0, W, H }, &c, &err);
    image_release(&levels);
    return rgb;
}

static double within(double at, double half, double sigma) { return (erfc((-at - half) / sigma * M_SQRT1_2) - erfc((-at + half) / sigma * M_SQRT1_2)) / 2; }

/* Squares as above, or bars, number i of a width and height of its own. Their light is Phi's by construction. */
struct turned { double sigma, half, contrast; };
static struct image drawn(struct turned (*of)(int i, double sigma, double contrast), double sigma, double contrast)
{
    struct image levels;
    struct error err = ERROR_NONE;
    if (!image_init(&levels, W, H, 3, PIXEL_F32, &err)) exit(99);
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++) {
            int column = x / 60, row = y / 60;
            struct turned s = of(8 * row + column, sigma, contrast);
            double u = x + 0.5 - 60 * column - 30, v = y + 0.5 - 60 * row - 30, turn = 0.1 + 0.23 * column + 0.41 * row;
            double a = u * cos(turn) + v * sin(turn), b = v * cos(turn) - u * sin(turn);
            double light = 0.1 + s.contrast * within(a, s.half, s.sigma) * within(b, 17, s.sigma);
            for (int c = 0; c < 3; c++) image_f32(&levels, x, y)[c] = 255 * srgb_from_linear((float)light);
        }
    return levels;
}

/* A place: of every three one is blurred more, as shadows and what is out of focus are, by much or little, and one is a bar of
 * 4 px, which is not lone. */
static struct turned place(int i, double sigma, double contrast)
{
    return (struct turned){ i % 3 == 1 ? sigma * (1.3 + 0.1 * (i % 16)) : sigma, i % 3 == 2 ? 2 : 17, contrast * (0.3 + 0.1 * (i % 8)) };
}

/* A park: of every four one is sharp, and three have the penumbra of a tree, of 1.2 to 1.5 px. */
static struct turned park(int i, double sigma, double contrast)
{
    return (struct turned){ i % 4 == 1 ? sigma : 1.2 + 0.02 * (i % 16), 17, contrast };
}

static void check_park(void)
{
    struct error err = ERROR_NONE;
    struct edges e;
    for (double sigma = 0.4; sigma < 0.7; sigma += 0.2) {
        struct image rgb = taken(drawn(park, sigma, 0.3), 0, 1, 1);
        bool ok = edges_measure(&e, &rgb, NULL, &err);
        OK(ok && e.count > 30 && e.sigma_px[1] > 1.1, "most edges of a park are soft (%zu, %.2f px)", e.count, e.sigma_px[1]);
        NEAR(e.sharp_px / sigma, 1, 0.1, "the few sharp ones tell what the lens does");
        image_release(&rgb);
    }
}

static void check_place(void)
{
    static const struct { double sigma, contrast, grain; int step; } cases[] = {
        { 0.45, 0.6, 1, 1 }, { 0.62, 0.6, 1, 1 }, { 0.62, 0.6, 4, 1 }, { 0.62, 0.2, 2, 1 }, { 0.62, 0.6, 2, 4 }, { 0.62, 0.6, 2, 8 }, { 1.1, 0.6, 2, 4 },
    };
    struct error err = ERROR_NONE;
    struct edges e;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct image rgb = taken(drawn(place, cases[i].sigma, cases[i].contrast), 0, cases[i].grain, cases[i].step);
        bool ok = edges_measure(&e, &rgb, NULL, &err);
        OK(ok && e.count > 30, "of %g px, contrast %g, grain %g, steps of %d: %zu edges", cases[i].sigma,
           cases[i].contrast, cases[i].grain, cases[i].step, e.count);
        NEAR(e.sharp_px / cases[i].sigma, 1, 0.07, "the sharp ones agree on it, though others are softer or thin");
        NEAR(e.sharpening, 0, 1e-9, "and were not sharpened");
        image_release(&rgb);
    }
}

static void check_sharpened(void)
{
    struct error err = ERROR_NONE;
    struct edges e;
    for (int i = 0; i < 4; i++) {
        static const double amounts[] = { 0.35, 0.8, 0.35, 0.8 };
        const int step = i < 2 ? 1 : 4;
        struct image rgb = taken(drawn(place, 0.5, 0.6), amounts[i], 1.5, step);
        bool ok = edges_measure(&e, &rgb, NULL, &err);
        OK(ok && e.telling > 40, "of a camera that sharpens by %g, steps of %d: %zu edges tell", amounts[i], step, e.telling);
        NEAR(e.sharpening, amounts[i], 0.05 + 0.15 * amounts[i], "so much is found");
        NEAR(e.sharp_px / 0.5, 1, 0.07, "and how wide the edges were before");
        image_release(&rgb);
    }
}

static void check_compared(void)
{
    struct error err = ERROR_NONE;
    struct image a = taken(drawn(place, 0.8, 0.6), 0, 2, 1), b = taken(drawn(place, 0.6, 0.6), 0, 2, 1);
    double ratio;
    size_t count;
    bool ok = edges_compare(&ratio, &count, &a, &b, NULL, &err);
    OK(ok && count > 30, "two pictures are compared at %zu edges", count);
    NEAR(ratio, 0.8 / 0.6, 0.04, "soft and thin ones, too");
    image_release(&a);
    image_release(&b);
}

int main(void)
{
    static const double blurs[] = { 0.4, 0.7, 1.2, 2.0 };
    static const double off[] = { 0.12, 0.06, 0.06, 0.06 }; /* 0.4 px are but three pixels' weights, and no Gaussian */
    const double pixel = sqrt(1.0 / 12); /* of an ideal edge seen by a pixel's area */
    struct error err = ERROR_NONE;
    struct edges edges;
    struct image sharp = covered();
    srand(3);
    for (int i = 0; i < 4; i++) {
        struct image layer, light = { 0 };
        if (!image_init(&layer, W, H, 4, PIXEL_F32, &err) || !image_init(&light, W, H, 3, PIXEL_F32, &err)) return 99;
        memcpy(layer.data, sharp.data, image_size(&sharp));
        softness_blur(&layer, &light, NULL, NULL, blurs[i], &err);
        struct image rgb = taken(levels_of(&layer), 0, 1.5, 1);
        bool ok = edges_measure(&edges, &rgb, NULL, &err);
        OK(ok && edges.count > 40, "edges are found: %zu", edges.count);
        NEAR(edges.sharp_px / hypot(blurs[i], pixel), 1, off[i], "they are blurred by %g px", blurs[i]);
        NEAR(edges.sigma_px[1] / hypot(blurs[i], pixel), 1, 0.12, "nearly all of them");
        OK(edges_of_layer(&edges, &layer, &err), "and those of the layer itself");
        NEAR(edges.sharp_px / hypot(blurs[i], pixel), 1, off[i], "as much");
        image_release(&rgb);
        image_release(&light);
        image_release(&layer);
    }

    image_release(&sharp);

    check_place();
    check_park();
    check_sharpened();
    check_compared();

    struct image rgb = grey(W, H, 90);
    OK(edges_measure(&edges, &rgb, NULL, &err) && edges.count == 0, "where there is no edge none is found");
    image_release(&rgb);
    return tap_done();
}
