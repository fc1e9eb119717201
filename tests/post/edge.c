#include "post/edge.h"

#include "post/softness.h"
#include "tests/post/taken.h"
#include "tests/tap.h"

#define W 480
#define H 360
#define FINE 8 /* samples a pixel and side */

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

static struct image taken(const struct image *layer, double sharpening, double grain)
{
    struct image rgb = grey(W, H, 0), levels;
    struct error err = ERROR_NONE;
    if (!image_init(&levels, W, H, 3, PIXEL_F32, &err)) exit(99);
    for (int i = 0; i < W * H; i++) {
        const float *px = (const float *)layer->data + 4 * i;
        for (int c = 0; c < 3; c++) ((float *)levels.data)[3 * i + c] = 255 * srgb_from_linear(0.08f * (1 - px[3]) + px[c]);
    }
    if (sharpening > 0) camera_sharpens(&levels, sharpening);
    for (size_t i = 0; i < image_size(&rgb); i++) ((uint8_t *)rgb.data)[i] = byte((double)((float *)levels.data)[i] + grain * noise());
    image_release(&levels);
    return rgb;
}

int main(void)
{
    static const double blurs[] = { 0.4, 0.7, 1.2, 2.0 };
    const double pixel = sqrt(1.0 / 12); /* of an ideal edge seen by a pixel's area */
    struct error err = ERROR_NONE;
    struct edges edges;
    srand(3);
    for (int i = 0; i < 4; i++) {
        struct image layer = covered(), light = { 0 };
        if (!image_init(&light, W, H, 3, PIXEL_F32, &err)) return 99;
        softness_blur(&layer, &light, NULL, NULL, blurs[i], &err);
        struct image rgb = taken(&layer, 0, 1.5);
        OK(edges_measure(&edges, &rgb, NULL, &err) && edges.count > 40, "edges are found: %zu", edges.count);
        NEAR(edges.sigma_px[1] / hypot(blurs[i], pixel), 1, 0.15, "they are blurred by %g px", blurs[i]);
        NEAR(edges.sigma_px[0] / hypot(blurs[i], pixel), 1, 0.15, "nearly all of them");
        OK(edges_of_layer(&edges, &layer, 0.3, 0.7, &err), "and those of the layer itself");
        NEAR(edges.sigma_px[1] / hypot(blurs[i], pixel), 1, 0.1, "as much");
        image_release(&rgb);
        image_release(&light);
        image_release(&layer);
    }

    for (int i = 0; i < 3; i++) {
        static const double amounts[] = { 0, 0.35, 0.8 };
        struct image layer = covered(), light = { 0 };
        if (!image_init(&light, W, H, 3, PIXEL_F32, &err)) return 99;
        softness_blur(&layer, &light, NULL, NULL, 0.3, &err);
        struct image rgb = taken(&layer, amounts[i], 1.5);
        OK(edges_measure(&edges, &rgb, NULL, &err) && edges.telling > 40, "of a camera that sharpens by %g: %zu", amounts[i], edges.telling);
        NEAR(edges.sharpening, amounts[i], 0.1 + 0.15 * amounts[i], "so much is found");
        NEAR(edges.sigma_px[1] / hypot(0.3, pixel), 1, 0.15, "and how wide the edges were before");
        image_release(&rgb);
        image_release(&light);
        image_release(&layer);
    }

    struct image rgb = grey(W, H, 90);
    OK(edges_measure(&edges, &rgb, NULL, &err) && edges.count == 0, "where there is no edge none is found");
    image_release(&rgb);
    return tap_done();
}
