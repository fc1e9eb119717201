/* compare-masks FRAME.json: the size of the frame's view, as POV-Ray's options.
 * compare-masks FRAME.json OBJECT.exr INSTANCE.png: per entity, the share of pixels that POV-Ray's alpha, rendered
 * with one ray a pixel, and the traced mask agree on, and how many of the others are at no edge:
 *   ID PIXELS IOU STRAY
 * A pixel that POV-Ray alone covers is the nearest entity's. For aligned views. */
#include "lib/manifest.h"
#include "lib/image.h"

#include <stdio.h>
#include <stdlib.h>

/* Is a pixel of another owner next to this one? */
static bool at_edge(const struct image *instance, int x, int y)
{
    for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < instance->height_px; v++)
        for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < instance->width_px; u++)
            if (*image_u16(instance, u, v) != *image_u16(instance, x, y)) return true;
    return false;
}

/* The entity nearest to a pixel, in growing squares; 0 in a picture without any. */
static uint16_t nearest(const struct image *instance, int x, int y)
{
    for (int r = 0; r < instance->width_px + instance->height_px; r++)
        for (int v = y - r; v <= y + r; v++)
            for (int u = x - r; u <= x + r; u += v == y - r || v == y + r ? 1 : 2 * r) {
                bool inside = u >= 0 && v >= 0 && u < instance->width_px && v < instance->height_px;
                if (inside && *image_u16(instance, u, v)) return *image_u16(instance, u, v);
                if (r == 0) break;
            }
    return 0;
}

int main(int argc, char **argv)
{
    static long both[65536], either[65536], stray[65536];
    struct error err = ERROR_NONE;
    struct manifest m;
    struct image object, instance;
    if ((argc != 2 && argc != 4) || !manifest_read(&m, argv[1], &err)) {
        error_print(&err, "compare-masks");
        return 2;
    }
    if (argc == 2) {
        printf("+W%d +H%d\n", m.view.width_px, m.view.height_px);
        manifest_release(&m);
        return 0;
    }
    if (!image_read(&object, argv[2], &err) || !image_read(&instance, argv[3], &err)) {
        error_print(&err, "compare-masks");
        return 2;
    }
    struct rect window = m.view.window_px;
    if (!m.view.aligned || object.width_px != window.x1 - window.x0 || object.height_px != window.y1 - window.y0)
        return 2;
    for (int y = 0; y < instance.height_px; y++)
        for (int x = 0; x < instance.width_px; x++) {
            bool within = x >= window.x0 && x < window.x1 && y >= window.y0 && y < window.y1;
            bool seen = within && image_f32(&object, x - window.x0, y - window.y0)[3] > 0.5f;
            uint16_t id = *image_u16(&instance, x, y);
            if (!seen && !id) continue;
            bool agree = seen && id;
            uint16_t whose = id ? id : nearest(&instance, x, y);
            either[whose]++;
            both[whose] += agree;
            stray[whose] += !agree && !at_edge(&instance, x, y);
        }
    for (int id = 0; id < 65536; id++)
        if (either[id]) printf("%d %ld %.5f %ld\n", id, either[id], (double)both[id] / (double)either[id], stray[id]);
    image_release(&object);
    image_release(&instance);
    manifest_release(&m);
    return 0;
}
