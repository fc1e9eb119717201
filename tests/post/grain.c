#include "post/grain.h"

#include "tests/post/taken.h"
#include "tests/tap.h"

#include <string.h>

#define W 640
#define H 480
#define TONES 5
static const int tones[TONES] = { 40, 88, 136, 184, 216 };
/* Of the red and green, and of the blue, which is noisier, at each tone: in levels. */
static const double green[TONES] = { 3.0, 2.6, 2.2, 1.9, 1.7 }, blue = 1.4;
/* A camera without much detail: each pixel's noise is the mean of it and its neighbours'. */
static const double smooth[3] = { 0.25, 0.5, 0.25 };

static double field[3][H + 2][W + 2];

/* Noise of variance 1 whose neighbours to the right and below share (2 * 0.25 * 0.5) / 0.375 = 2/3 of it. */
static double smooth_noise(int c, int x, int y)
{
    double sum = 0;
    for (int dy = 0; dy < 3; dy++)
        for (int dx = 0; dx < 3; dx++) sum += smooth[dy] * smooth[dx] * field[c][y + dy][x + dx];
    return sum / 0.375;
}

/* Stripes of tones, each with a slight ramp, and a third of the picture of strong texture. */
static struct image photograph(void)
{
    struct image rgb = grey(W, H, 0);
    for (int c = 0; c < 3; c++)
        for (int y = 0; y < H + 2; y++)
            for (int x = 0; x < W + 2; x++) field[c][y][x] = noise();
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++) {
            int t = y * TONES / H;
            double level = tones[t] + 0.01 * (x - W / 2), texture = x > 2 * W / 3 ? 30 * sin(0.9 * x) * cos(0.7 * y) : 0;
            for (int c = 0; c < 3; c++)
                image_u8(&rgb, x, y)[c] = byte(level + texture + green[t] * (c == 2 ? blue : 1) * smooth_noise(c, x, y));
        }
    return rgb;
}

static double sigma_of(const struct image *levels, double mean, int c)
{
    double sum = 0;
    int n = levels->width_px * levels->height_px;
    for (int i = 0; i < n; i++) {
        double v = (double)((const float *)levels->data)[3 * i + c] - mean;
        sum += v * v / n;
    }
    return sqrt(sum);
}

static double alike(const struct image *levels, double mean, int dx, int dy)
{
    double sum = 0, square = 0;
    for (int y = 0; y + dy < levels->height_px; y++)
        for (int x = 0; x + dx < levels->width_px; x++) {
            double v = (double)image_f32(levels, x, y)[1] - mean;
            sum += v * ((double)image_f32(levels, x + dx, y + dy)[1] - mean);
            square += v * v;
        }
    return sum / square;
}

static struct image flat(int width, int height, int channels, float value)
{
    struct image image;
    struct error err = ERROR_NONE;
    if (!image_init(&image, width, height, channels, PIXEL_F32, &err)) exit(99);
    for (size_t i = 0; i < image_size(&image) / sizeof value; i++) ((float *)image.data)[i] = value;
    return image;
}

static void check_added(const struct grain *g)
{
    struct error err = ERROR_NONE;
    struct draw_key key = { .seed = 7, .frame = 3 };
    struct image cover = flat(200, 200, 1, 1), half = flat(200, 200, 1, 0.5f);
    for (int t = 0; t < TONES; t++) {
        struct image levels = flat(200, 200, 3, (float)tones[t]);
        OK(grain_add(&levels, &cover, g, key, (struct rect){ 10, 20, 210, 220 }, W, &err), "grain is added at level %d", tones[t]);
        NEAR(sigma_of(&levels, tones[t], 1) / green[t], 1, 0.15, "as much as the photograph has, in green");
        NEAR(sigma_of(&levels, tones[t], 2) / (blue * green[t]), 1, 0.15, "and in blue");
        NEAR(alike(&levels, tones[t], 1, 0), 2.0 / 3, 0.15 * 2 / 3, "and as alike to the right");
        NEAR(alike(&levels, tones[t], 0, 1), 2.0 / 3, 0.15 * 2 / 3, "below");
        NEAR(alike(&levels, tones[t], 0, 2), 1.0 / 6, 0.06, "and two pixels below");
        image_release(&levels);
    }
    struct image a = flat(200, 200, 3, 100), b = flat(60, 50, 3, 100), c = flat(60, 50, 3, 100);
    grain_add(&a, &cover, g, key, (struct rect){ 10, 20, 210, 220 }, W, &err);
    grain_add(&b, &cover, g, key, (struct rect){ 40, 30, 100, 80 }, W, &err);
    bool same = true;
    for (int y = 0; y < 50; y++) same = same && !memcmp(image_f32(&a, 30, 10 + y), image_f32(&b, 0, y), 60 * 3 * sizeof(float));
    OK(same, "a pixel's grain does not depend on the window");
    key.frame = 4;
    grain_add(&c, &cover, g, key, (struct rect){ 40, 30, 100, 80 }, W, &err);
    OK(memcmp(b.data, c.data, image_size(&b)) != 0, "another frame has other grain");
    for (size_t i = 0; i < image_size(&a) / sizeof(float); i++) ((float *)a.data)[i] = 100;
    grain_add(&a, &half, g, key, (struct rect){ 10, 20, 210, 220 }, W, &err);
    NEAR(sigma_of(&a, 100, 1) / grain_sigma(g, 100, 1), sqrt(0.75), 0.03, "what covers half lets the photograph's half through");
    image_release(&a);
    image_release(&b);
    image_release(&c);
    image_release(&cover);
    image_release(&half);
}

static struct compression steps_of(int step)
{
    struct compression c = { .found = true, .width_px = W, .height_px = H, .components = 3, .across = { 2, 1, 1 }, .down = { 2, 1, 1 } };
    for (int i = 0; i < 3 * 64; i++) c.table[i / 64][i % 64] = (uint16_t)step;
    return c;
}

static void press(struct image *rgb, const struct compression *c)
{
    struct error err = ERROR_NONE;
    if (!compression_apply(rgb, (struct rect){ 0, 0, W, H }, c, &err)) exit(99);
}

static double sigma_of_bytes(const struct image *rgb, int c)
{
    double sum = 0, squares = 0, n = (double)(image_size(rgb) / 3);
    for (size_t i = 0; i < image_size(rgb) / 3; i++) {
        double v = ((const uint8_t *)rgb->data)[3 * i + (size_t)c];
        sum += v / n;
        squares += v * v / n;
    }
    return sqrt(squares - sum * sum);
}

/* A grey wall's noise, pressed by the camera; and what is drawn for another wall, pressed by us. */
static void check_pressed(double sigma, int step)
{
    struct error err = ERROR_NONE;
    struct flat_patches patches;
    struct grain g;
    struct compression c = steps_of(step);
    struct draw_key key = { .seed = 9 };
    struct image rgb = grey(W, H, 0), levels = flat(W, H, 3, 136), cover = flat(W, H, 1, 1);
    for (size_t i = 0; i < image_size(&rgb); i++) ((uint8_t *)rgb.data)[i] = byte(136 + sigma * noise());
    press(&rgb, &c);
    if (!flat_patches_find(&patches, &rgb, &err) || !grain_measure(&g, &rgb, &patches, &err)) exit(99);
    double measured = hypot(grain_sigma(&g, 136, 1), sqrt(1.0 / 12)); /* a byte is rounded */
    NEAR(measured / sigma_of_bytes(&rgb, 1), 1, 0.15, "noise of %g is measured as steps of %d left it: %.2f", sigma, step, measured);
    OK(grain_before_compression(&g, &c, &err), "what was there before is found");
    grain_add(&levels, &cover, &g, key, (struct rect){ 0, 0, W, H }, W, &err);
    for (size_t i = 0; i < image_size(&rgb); i++) ((uint8_t *)rgb.data)[i] = byte((double)((float *)levels.data)[i]);
    press(&rgb, &c);
    NEAR(sigma_of_bytes(&rgb, 1) / measured, 1, 0.07, "is drawn so that as much is left when it is pressed");
    flat_patches_release(&patches);
    image_release(&rgb);
    image_release(&levels);
    image_release(&cover);
}

/* Above, the noise of a wall; below, brighter, nothing but fine gravel. */
static void check_bright_texture(void)
{
    struct error err = ERROR_NONE;
    struct flat_patches patches;
    struct grain g;
    struct image rgb = grey(W, H, 0);
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++) {
            double level = y < H / 2 ? 88 + 2 * noise() : 168 + 7 * noise();
            for (int c = 0; c < 3; c++) image_u8(&rgb, x, y)[c] = byte(level);
        }
    OK(flat_patches_find(&patches, &rgb, &err) && grain_measure(&g, &rgb, &patches, &err), "a wall and bright gravel");
    NEAR(grain_sigma(&g, 88, 1), 2, 0.2, "the wall's noise is told");
    NEAR(grain_sigma(&g, 168, 1), 2, 0.4, "and gravel is not taken for it");
    flat_patches_release(&patches);
    image_release(&rgb);
}

/* A street from above: asphalt whose stones are a pixel or two wide, and on it the roofs of five cars of the same brightness. */
static void check_asphalt(void)
{
    static const struct rect roofs[] = { { 101, 90, 151, 122 }, { 300, 300, 350, 332 }, { 517, 203, 549, 253 }, { 40, 250, 90, 282 }, { 410, 33, 442, 83 } };
    struct error err = ERROR_NONE;
    struct flat_patches patches;
    struct grain g;
    struct image rgb = grey(W, H, 0);
    for (int y = 0; y < H + 2; y++)
        for (int x = 0; x < W + 2; x++) field[0][y][x] = noise();
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++) {
            double stones = 2 * smooth_noise(0, x, y);
            for (size_t r = 0; r < sizeof roofs / sizeof *roofs; r++)
                if (x >= roofs[r].x0 && x < roofs[r].x1 && y >= roofs[r].y0 && y < roofs[r].y1) stones = 0;
            for (int c = 0; c < 3; c++) image_u8(&rgb, x, y)[c] = byte(84 + stones + noise());
        }
    OK(flat_patches_find(&patches, &rgb, &err) && grain_measure(&g, &rgb, &patches, &err), "asphalt, and a fortieth of it roofs");
    NEAR(grain_sigma(&g, 84, 1), 1, 0.15, "the roofs' noise is told, not the asphalt's");
    flat_patches_release(&patches);
    image_release(&rgb);
}

/* Five walls, apart by what is clipped, which tells nothing; their noise has a standard deviation of 2 in each channel. */
enum { WALLS = 5 };
static const int walls[WALLS] = { 40, 72, 104, 136, 168 };

static struct image five_walls(int grey_wall, int rough_wall)
{
    struct image rgb = grey(W, H, 255);
    for (int y = 0; y < H + 2; y++)
        for (int x = 0; x < W + 2; x++) field[0][y][x] = noise();
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++) {
            int wall = y * WALLS / H, down = y - wall * H / WALLS;
            double alike = noise(), rough = wall == rough_wall ? 1.5 * smooth_noise(0, x, y) : 0;
            if (down < 16) continue;
            for (int c = 0; c < 3; c++)
                image_u8(&rgb, x, y)[c] = byte(walls[wall] + rough + 2 * (wall == grey_wall ? alike : noise()));
        }
    return rgb;
}

static struct grain grain_of(const struct image *rgb)
{
    struct error err = ERROR_NONE;
    struct flat_patches patches;
    struct grain g;
    if (!flat_patches_find(&patches, rgb, &err) || !grain_measure(&g, rgb, &patches, &err)) exit(99);
    flat_patches_release(&patches);
    return g;
}

static void check_walls(void)
{
    struct image rgb = five_walls(3, -1);
    struct grain g = grain_of(&rgb);
    for (int i = 0; i < WALLS; i++) {
        double red_less_blue = g.covariance[walls[i] / (256 / GRAIN_LEVELS)][1][1];
        NEAR(red_less_blue, i == 3 ? 0 : 4, 0.5, "colours that are without noise at one level have it at %d", walls[i]);
    }
    image_release(&rgb);
    rgb = five_walls(-1, 0);
    g = grain_of(&rgb);
    NEAR(grain_sigma(&g, walls[0], 1), 2, 0.25, "a rough wall's noise is what differs from a pixel to the next, without the roughness: 2.5 with it");
    NEAR(grain_sigma(&g, walls[1], 1), 2, 0.12, "a smooth one has all of its");
    image_release(&rgb);
}

int main(void)
{
    struct error err = ERROR_NONE;
    struct flat_patches patches;
    struct grain g;
    srand(5);
    struct image rgb = photograph();
    if (!OK(flat_patches_find(&patches, &rgb, &err) && grain_measure(&g, &rgb, &patches, &err), "grain is measured")) return tap_done();
    OK(g.patches > 100, "on many patches: %zu", g.patches);
    for (int t = 0; t < TONES; t++) {
        NEAR(grain_sigma(&g, tones[t], 1) / green[t], 1, 0.06, "green noise at level %d", tones[t]);
        NEAR(grain_sigma(&g, tones[t], 2) / (blue * green[t]), 1, 0.06, "and blue");
    }
    NEAR(g.correlation[0][3][4], 2.0 / 3, 0.15 * 2 / 3, "neighbours are as alike as they are");
    check_added(&g);
    flat_patches_release(&patches);
    image_release(&rgb);

    rgb = grey(W, H, 120);
    OK(flat_patches_find(&patches, &rgb, &err) && grain_measure(&g, &rgb, &patches, &err), "a picture without noise");
    NEAR(grain_sigma(&g, 120, 0), 0, 1e-6, "has none");
    flat_patches_release(&patches);
    image_release(&rgb);

    check_bright_texture();
    check_asphalt();
    check_walls();
    check_pressed(1, 3);
    check_pressed(2, 4);
    check_pressed(3, 6);

    g = grain_white(2.5);
    NEAR(grain_sigma(&g, 77, 2), 2.5, 1e-9, "noise that is given is the same everywhere");
    return tap_done();
}
