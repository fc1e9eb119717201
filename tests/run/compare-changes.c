/* compare-changes BEFORE A B REACH: what makes A of BEFORE, against what makes B of it. Prints
 *   CHANGED_A CHANGED_B DIFFERENT LOST FAR
 * pixels that differ from BEFORE in A, in B; pixels that differ between A and B; pixels that changed in A and not in B;
 * pixels that changed in B with none that changed in A within REACH pixels, counted along the rows and the columns. */
#include "lib/image.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool differ(const struct image *a, const struct image *b, int x, int y)
{
    size_t size = image_pixel_size(a), i = (size_t)y * (size_t)a->width_px + (size_t)x;
    return memcmp((const char *)a->data + i * size, (const char *)b->data + i * size, size) != 0;
}

static bool near(const struct image *before, const struct image *a, int x, int y, int reach)
{
    for (int v = y - reach; v <= y + reach; v++)
        for (int u = x - reach; u <= x + reach; u++)
            if (u >= 0 && v >= 0 && u < a->width_px && v < a->height_px && differ(before, a, u, v)) return true;
    return false;
}

int main(int argc, char **argv)
{
    struct error err = ERROR_NONE;
    struct image picture[3];
    if (argc != 5) return 2;
    for (int i = 0; i < 3; i++)
        if (!image_read(&picture[i], argv[1 + i], &err)) {
            error_print(&err, "compare-changes");
            return 2;
        }
    const struct image *before = &picture[0], *a = &picture[1], *b = &picture[2];
    int reach = atoi(argv[4]), changed_a = 0, changed_b = 0, different = 0, lost = 0, far = 0;
    if (image_size(before) != image_size(a) || image_size(a) != image_size(b)) return 2;
    for (int y = 0; y < a->height_px; y++)
        for (int x = 0; x < a->width_px; x++) {
            bool in_a = differ(before, a, x, y), in_b = differ(before, b, x, y);
            changed_a += in_a;
            changed_b += in_b;
            different += differ(a, b, x, y);
            lost += in_a && !in_b;
            far += in_b && !near(before, a, x, y, reach);
        }
    printf("%d %d %d %d %d\n", changed_a, changed_b, different, lost, far);
    for (int i = 0; i < 3; i++) image_release(&picture[i]);
    return 0;
}
