/* compare-frame OUT FRAME PHOTOGRAPH SEMANTIC DEPTH.exr: a frame of a dataset against what was there before it. Prints
 *   rgb CHANGED STILL STRAY          pixels that differ from the photograph; pixels within the rendered window where the
 *                                    passes say that nothing changes; those of them, and outside the window, that differ
 *   semantic COVERED WRONG           pixels of entities; pixels that are neither as before nor an entity's
 *   depth COVERED WRONG              the same, and those of entities that do not lie before the place
 *   soft PIXELS CHANGED              pixels of which the place hides a part; those that are not as in the photograph
 *   UAVid's colours. */
#include "lib/file.h"
#include "lib/image.h"
#include "lib/manifest.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static struct error err = ERROR_NONE;
static const char *out, *frame;

static struct image picture(const char *path)
{
    struct image image;
    if (!path || !image_read(&image, path, &err)) {
        error_print(&err, "compare-frame");
        exit(2);
    }
    return image;
}

/* OUT/FOLDER/FRAME EXTENSION, or OUT/frames/FRAME/NAME. */
static struct image output(const char *folder, const char *extension)
{
    char *path = string_format("%s/%s/%s%s", out, folder, frame, extension);
    struct image image = picture(path);
    free(path);
    return image;
}

static struct image working(const char *name)
{
    char *path = string_format("%s/frames/%s/%s", out, frame, name);
    struct image image = picture(path);
    free(path);
    return image;
}

struct passes { struct image object, plane, shadow; };

/* Do the passes say that a pixel stays as it is? In all the rendered pixels that can go into it. */
static bool still(const struct passes *p, const struct manifest *m, int x, int y)
{
    struct vec2 v;
    if (!view_from_photograph(&m->view, &m->camera, &v, (struct vec2){ x + 0.5, y + 0.5 }, &err)) return false;
    for (int j = (int)floor(v.y) - 2; j <= (int)floor(v.y) + 2; j++)
        for (int i = (int)floor(v.x) - 2; i <= (int)floor(v.x) + 2; i++) {
            if (i < 0 || j < 0 || i >= p->object.width_px || j >= p->object.height_px) continue;
            if (image_f32(&p->object, i, j)[3] > 0) return false;
            const float *a = image_f32(&p->plane, i, j), *b = image_f32(&p->shadow, i, j);
            if (memcmp(a, b, 3 * sizeof *a) != 0) return false;
        }
    return true;
}

static void compare_rgb(const struct manifest *m, const struct image *before)
{
    struct image now = output("rgb", ".png");
    struct passes p = { .object = { 0 } };
    if (!m->empty) p = (struct passes){ working("object.exr"), working("plane.exr"), working("shadow.exr") };
    struct rect w = m->view.window_px;
    int changed = 0, quiet = 0, stray = 0;
    for (int y = 0; y < now.height_px; y++)
        for (int x = 0; x < now.width_px; x++) {
            bool differs = memcmp(image_u8(&now, x, y), image_u8(before, x, y), 3) != 0;
            bool within = !m->empty && x >= w.x0 && x < w.x1 && y >= w.y0 && y < w.y1;
            bool stays = !within || still(&p, m, x, y);
            changed += differs;
            quiet += within && stays;
            stray += differs && stays;
        }
    printf("rgb %d %d %d\n", changed, quiet, stray);
    image_release(&now);
    image_release(&p.object);
    image_release(&p.plane);
    image_release(&p.shadow);
}

static const struct manifest_entity *owner(const struct manifest *m, uint16_t id)
{
    for (size_t i = 0; i < m->entity_count; i++)
        if (m->entities[i].id == id) return &m->entities[i];
    return NULL;
}

static void compare_labels(const struct manifest *m, const struct image *semantic_before, const struct image *depth_before)
{
    static const uint8_t human[3] = { 64, 64, 0 }, moving_car[3] = { 64, 0, 128 };
    struct image instance = output("instance", ".png"), semantic = output("semantic", ".png"), depth = output("depth", ".exr");
    int covered = 0, wrong = 0, behind = 0;
    for (int y = 0; y < instance.height_px; y++)
        for (int x = 0; x < instance.width_px; x++) {
            uint16_t id = *image_u16(&instance, x, y);
            float z = *image_f32(&depth, x, y), z_before = *image_f32(depth_before, x, y);
            const struct manifest_entity *e = owner(m, id);
            const uint8_t *want = !id ? image_u8(semantic_before, x, y) : e && e->class_ == CLASS_PERSON ? human : moving_car;
            covered += id != 0;
            wrong += memcmp(image_u8(&semantic, x, y), want, 3) != 0;
            /* Wheels may be sunk into the road by 3 cm, seen at a slant. */
            behind += id ? z >= z_before + 0.1f : memcmp(&z, &z_before, sizeof z) != 0;
        }
    printf("semantic %d %d\ndepth %d %d\n", covered, wrong, covered, behind);
    image_release(&instance);
    image_release(&semantic);
    image_release(&depth);
}

static void compare_edges(const struct image *visible, const struct image *before)
{
    struct image now = output("rgb", ".png");
    int soft = 0, changed = 0;
    for (int y = 0; y < now.height_px; y++)
        for (int x = 0; x < now.width_px; x++) {
            uint8_t share = *image_u8(visible, x, y);
            if (share == 0 || share == 255) continue;
            soft++;
            changed += memcmp(image_u8(&now, x, y), image_u8(before, x, y), 3) != 0;
        }
    printf("soft %d %d\n", soft, changed);
    image_release(&now);
}

int main(int argc, char **argv)
{
    struct manifest m;
    if (argc != 6) return 2;
    out = argv[1];
    frame = argv[2];
    char *path = string_format("%s/frames/%s/frame.json", out, frame);
    if (!path || !manifest_read(&m, path, &err)) {
        error_print(&err, "compare-frame");
        return 2;
    }
    struct image photograph = picture(argv[3]), semantic = picture(argv[4]), depth = picture(argv[5]);
    struct image visible = working("visible.png");
    compare_rgb(&m, &photograph);
    compare_labels(&m, &semantic, &depth);
    compare_edges(&visible, &photograph);
    free(path);
    image_release(&photograph);
    image_release(&semantic);
    image_release(&depth);
    image_release(&visible);
    manifest_release(&m);
    return 0;
}
