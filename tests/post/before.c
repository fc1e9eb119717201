#include "lib/file.h"
#include "post/before.h"
#include "post/depth.h"
#include "post/semantic.h"

#include "tests/tap.h"

#include <unistd.h>

#define W 4
#define H 2

static char out[] = "staffage-before-XXXXXX";

static const char *in_out(const char *name)
{
    static char path[256];
    snprintf(path, sizeof path, "%s/%s", out, name);
    return path;
}

static bool save(const char *name, int width, int height, int channels, enum pixel_type type, void *data)
{
    struct image image = { width, height, channels, type, data };
    struct error err = ERROR_NONE;
    return image_write(in_out(name), &image, &err);
}

static struct manifest manifest_of(const char *semantic, const char *depth)
{
    struct manifest m = { .frame = "000001", .width_px = W, .height_px = H, .palette = PALETTE_UAVID };
    snprintf(m.semantic, sizeof m.semantic, "%s", semantic);
    snprintf(m.depth, sizeof m.depth, "%s", depth);
    return m;
}

static void refuses(const char *semantic, const char *depth, const char *text)
{
    struct manifest m = manifest_of(semantic, depth);
    struct image image;
    struct error err = ERROR_NONE;
    bool refused = semantic[0] ? !before_semantic(&image, out, &m, &err) : !before_depth(&image, out, &m, &err);
    OK(refused && err.code == ERR_INPUT && strstr(err.text, text) && strstr(err.file, semantic[0] ? semantic : depth) && !image.data,
       "refused: %s: %s", err.file, err.text);
}

/* A car at pixel 1, a person at pixel 6, nothing elsewhere. */
static uint8_t class_of_pixel[W * H] = { [1] = 1 + CLASS_CAR, [6] = 1 + CLASS_PERSON };
static struct image classes = { W, H, 1, PIXEL_U8, class_of_pixel };

/* Every pixel but those of the entities has the bytes it had. */
static bool others_same(const void *a, const void *b, size_t pixel)
{
    bool same = true;
    for (size_t i = 0; i < W * H; i++)
        if (!class_of_pixel[i]) same = same && !memcmp((const char *)a + i * pixel, (const char *)b + i * pixel, pixel);
    return same;
}

/* Road, tree, a colour of nobody's, clutter, moving car, the rest road: in UAVid's colours, from FORMATS. */
static uint8_t colors[W * H * 3] = { 128, 64, 128, 0, 128, 0, 1, 2, 3, 0, 0, 0, 64, 0, 128, 128, 64, 128, 128, 64, 128, 128, 64, 128 };

static void check_colors(void)
{
    struct manifest m = manifest_of("colors.png", "");
    struct image before, color, ids;
    struct error err = ERROR_NONE;
    save("colors.png", W, H, 3, PIXEL_U8, colors);
    if (!OK(before_semantic(&before, out, &m, &err), "colours are read")) return;
    if (!OK(semantic_color(&color, &classes, &before, PALETTE_UAVID, &err) && semantic_ids(&ids, &classes, &before, PALETTE_UAVID, &err), "and overwritten")) return;
    const uint8_t *c = color.data, *id = ids.data;
    OK(others_same(c, colors, 3), "where no entity is, colours keep every bit, also one that the palette lacks");
    OK(!memcmp(c + 3, (uint8_t[]){ 64, 0, 128 }, 3) && !memcmp(c + 18, (uint8_t[]){ 64, 64, 0 }, 3), "a car is a moving car, a person human");
    OK(!memcmp(id, (uint8_t[]){ 2, 7, 0, 0, 7, 2, 6, 2 }, 8), "ids are those of the colours, 0 of one that the palette lacks");
    image_release(&before);
    image_release(&color);
    image_release(&ids);

    uint8_t rgba[W * H * 4];
    for (size_t i = 0; i < W * H; i++) {
        memcpy(rgba + 4 * i, colors + 3 * i, 3);
        rgba[4 * i + 3] = (uint8_t)(100 + i);
    }
    save("colors.png", W, H, 4, PIXEL_U8, rgba);
    if (!OK(before_semantic(&before, out, &m, &err) && semantic_color(&color, &classes, &before, PALETTE_UAVID, &err), "with alpha")) return;
    OK(color.channels == 4 && others_same(color.data, rgba, 4), "too, alpha and all");
    OK(((uint8_t *)color.data)[7] == 255, "and an entity is opaque");
    image_release(&before);
    image_release(&color);
}

static void check_ids(void)
{
    uint8_t stored[W * H] = { 2, 4, 200, 0, 7, 2, 2, 1 };
    struct manifest m = manifest_of("ids.png", "");
    struct image before, color, ids;
    struct error err = ERROR_NONE;
    save("ids.png", W, H, 1, PIXEL_U8, stored);
    if (!OK(before_semantic(&before, out, &m, &err) && before.channels == 1, "ids are read")) return;
    if (!OK(semantic_color(&color, &classes, &before, PALETTE_UAVID, &err) && semantic_ids(&ids, &classes, &before, PALETTE_UAVID, &err), "and overwritten")) return;
    const uint8_t *c = color.data, *id = ids.data;
    OK(others_same(id, stored, 1) && id[1] == 7 && id[6] == 6, "where no entity is, ids stay, also one that the palette lacks");
    OK(!memcmp(c, (uint8_t[]){ 128, 64, 128 }, 3) && !memcmp(c + 21, (uint8_t[]){ 128, 0, 0 }, 3), "colours are the palette's");
    OK(!memcmp(c + 6, (uint8_t[]){ 0, 0, 0 }, 3), "and black for an id that it lacks");
    image_release(&before);
    image_release(&color);
    image_release(&ids);

    m.semantic[0] = '\0';
    OK(before_semantic(&before, out, &m, &err) && !before.data, "a frame without labels has none");
    m.has_place_labels = true;
    folder_make(in_out("frames/000001"), &err);
    save("frames/000001/place_labels.png", W, H, 1, PIXEL_U8, stored);
    OK(before_semantic(&before, out, &m, &err) && !memcmp(before.data, stored, sizeof stored), "or the place's");
    image_release(&before);
    struct error wrong = ERROR_NONE;
    unlink(in_out("frames/000001/place_labels.png"));
    OK(!before_semantic(&before, out, &m, &wrong) && strstr(wrong.file, "place_labels.png"), "which must be there");
    OK(semantic_id_of_color(PALETTE_CITYSCAPES, (uint8_t[]){ 0, 30, 170 }) == 26, "the colour that a van gets has an id");
    OK(semantic_id_of_color(PALETTE_CITYSCAPES, (uint8_t[]){ 1, 30, 170 }) == -1, "a colour of nobody's has none");
}

static void check_depth(void)
{
    float strange; /* a NaN that carries something */
    memcpy(&strange, &(uint32_t){ 0x7fc12345 }, sizeof strange);
    float metres[W * H] = { 1.0f / 3, 20, strange, 0, INFINITY, 70, 12.25f, 3 };
    float entity[W * H] = { NAN, 8.5f, NAN, NAN, NAN, NAN, 80, NAN };
    uint16_t millimetres[W * H] = { 333, 20000, 0, 65535, 1, 2, 12250, 3000 };
    struct image of_entity = { W, H, 1, PIXEL_F32, entity }, before, m, mm;
    struct manifest with = manifest_of("", "depth.exr");
    struct error err = ERROR_NONE;
    save("depth.exr", W, H, 1, PIXEL_F32, metres);
    if (!OK(before_depth(&before, out, &with, &err) && depth_overwrite(&m, &mm, &before, &of_entity, &err), "metres are overwritten")) return;
    const float *got = m.data;
    const uint16_t *got_mm = mm.data;
    OK(others_same(got, metres, 4) && got[1] == 8.5f && got[6] == 80, "where no entity is they keep every bit");
    OK(!memcmp(got_mm, (uint16_t[]){ 333, 8500, 0, 0, 0, 0, 0, 3000 }, 16), "millimetres are made of them");
    image_release(&before);
    image_release(&m);
    image_release(&mm);

    with = manifest_of("", "depth.png");
    save("depth.png", W, H, 1, PIXEL_U16, millimetres);
    if (!OK(before_depth(&before, out, &with, &err) && depth_overwrite(&m, &mm, &before, &of_entity, &err), "millimetres are overwritten")) return;
    got = m.data, got_mm = mm.data;
    OK(others_same(got_mm, millimetres, 2) && got_mm[1] == 8500 && got_mm[6] == 0, "where no entity is they stay; what does not fit is unknown");
    OK(got[0] == 0.333f && isnan(got[2]) && got[3] == 65.535f && got[6] == 80, "metres are made of them");
    image_release(&before);
    image_release(&m);
    image_release(&mm);

    with = manifest_of("", "");
    with.has_place = true;
    save("frames/000001/place_depth.exr", W, H, 1, PIXEL_F32, metres);
    OK(before_depth(&before, out, &with, &err) && !memcmp(before.data, metres, sizeof metres), "without its own, a frame has the place's");
    image_release(&before);
    unlink(in_out("frames/000001/place_depth.exr"));
}

static void check_scaled(void)
{
    uint8_t large[2 * W * 2 * H];
    for (int i = 0; i < 4 * W * H; i++) large[i] = (uint8_t)i;
    struct manifest m = manifest_of("large.png", "");
    struct image before;
    struct error err = ERROR_NONE;
    save("large.png", 2 * W, 2 * H, 1, PIXEL_U8, large);
    if (!OK(before_semantic(&before, out, &m, &err) && before.width_px == W, "labels of another size are brought to the picture's")) return;
    const uint8_t *got = before.data;
    OK(got[0] == 9 && got[1] == 11 && got[W] == 25, "by a pixel of theirs, never by a mixture");
    image_release(&before);
}

static void check_faults(void)
{
    uint16_t wide[W * H] = { 0 };
    save("wide.png", W, H, 1, PIXEL_U16, wide);
    save("tall.png", 2, 2, 1, PIXEL_U16, wide);
    refuses("lost.png", "", "does not exist");
    refuses("wide.png", "", "is no semantic image: 8-bit colours or 8-bit ids would be right");
    refuses("tall.png", "", "is 2 x 2 pixels: not in proportion to the scene's 4 x 2");
    refuses("", "colors.png", "is no depth image: one channel of metres");
    refuses("", "lost.exr", "does not exist");
}

int main(void)
{
    if (!mkdtemp(out)) return 1;
    check_colors();
    check_ids();
    check_depth();
    check_scaled();
    check_faults();
    static const char *const made[] = { "colors.png", "ids.png", "depth.exr", "depth.png", "large.png", "wide.png", "tall.png" };
    for (size_t i = 0; i < sizeof made / sizeof *made; i++) unlink(in_out(made[i]));
    rmdir(in_out("frames/000001"));
    rmdir(in_out("frames"));
    OK(rmdir(out) == 0, "nothing else was written");
    return tap_done();
}
