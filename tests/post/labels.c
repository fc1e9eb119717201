#include "lib/class.h"
#include "post/depth.h"
#include "post/semantic.h"
#include "post/window.h"

#include "tests/tap.h"

static void check_semantic(void)
{
    struct manifest_entity entities[] = { { 7, "taxi", CLASS_CAR }, { 300, "walker", CLASS_PERSON } };
    struct manifest manifest = { .entities = entities, .entity_count = 2 };
    uint16_t ids[4] = { 0, 7, 300, 7 };
    struct image instance = { 2, 2, 1, PIXEL_U16, ids }, classes, color, semantic;
    struct error err = ERROR_NONE;
    if (!OK(semantic_classes(&classes, &instance, &manifest, &err), "every id of the manifest has a class")) return;
    struct image none = { 0 };
    OK(semantic_color(&color, &classes, &none, PALETTE_CITYSCAPES, &err) && semantic_ids(&semantic, &classes, &none, PALETTE_CITYSCAPES, &err), "pictures are made of them");
    const uint8_t *c = color.data, *s = semantic.data;
    OK(s[0] == 0 && s[1] == 26 && s[2] == 24 && s[3] == 26, "ids are Cityscapes': car 26, person 24");
    OK(c[0] == 0 && c[1] == 0 && c[2] == 0, "nothing is black");
    OK(c[3] == 0 && c[4] == 0 && c[5] == 142, "a car is 0,0,142");
    OK(c[6] == 220 && c[7] == 20 && c[8] == 60, "a person is 220,20,60");
    image_release(&classes);
    image_release(&color);
    image_release(&semantic);
    ids[3] = 8;
    OK(!semantic_classes(&classes, &instance, &manifest, &err), "an id that the manifest does not name is refused");
    OK(!strcmp(err.text, "pixel 1,1 has id 8, which no entity of the frame has"), "and said where: %s", err.text);
}

static void check_depth(void)
{
    float metres[8] = { NAN, 12.3456f, 65.535f, 65.54f, 200, -1, 0.0004f, INFINITY };
    struct image depth = { 8, 1, 1, PIXEL_F32, metres }, before = { 0 }, exr, out;
    struct error err = ERROR_NONE;
    if (!OK(depth_overwrite(&exr, &out, &before, &depth, &err), "depth is turned into millimetres")) return;
    OK(!memcmp(exr.data, metres, sizeof metres), "and in metres is the entities' alone");
    image_release(&exr);
    const uint16_t *mm = out.data;
    OK(mm[0] == 0, "unknown is 0");
    OK(mm[1] == 12346, "12.3456 m is 12346 mm, rounded");
    OK(mm[2] == 65535, "65.535 m is the last that fits");
    OK(mm[3] == 0 && mm[4] == 0 && mm[7] == 0, "what does not fit is unknown, never cut off");
    OK(mm[5] == 0 && mm[6] == 0, "nothing is nearer than a millimetre");
    image_release(&out);
}

static void check_window(void)
{
    uint16_t p[6] = { 1, 2, 3, 4, 5, 6 };
    struct image in = { 3, 2, 1, PIXEL_U16, p }, out;
    struct error err = ERROR_NONE;
    OK(window_inside((struct rect){ 0, 0, 3, 2 }, 3, 2), "the whole picture is inside");
    OK(!window_inside((struct rect){ 0, 0, 4, 2 }, 3, 2) && !window_inside((struct rect){ -1, 0, 2, 2 }, 3, 2), "a column beyond is not");
    OK(!window_inside((struct rect){ 2, 1, 2, 2 }, 3, 2), "an empty window is not");
    if (!OK(window_cut(&out, &in, (struct rect){ 1, 0, 3, 2 }, &err), "a window is cut")) return;
    const uint16_t *q = out.data;
    OK(out.width_px == 2 && q[0] == 2 && q[1] == 3 && q[2] == 5 && q[3] == 6, "it has the window's pixels");
    image_release(&out);
}

int main(void)
{
    check_semantic();
    check_depth();
    check_window();
    return tap_done();
}
