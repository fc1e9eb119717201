/* same-pixels A B: whether two pictures decode to the same pixels. */
#include "lib/image.h"

#include <stdio.h>
#include <string.h>

int main(int argc, char **argv)
{
    struct error err = ERROR_NONE;
    struct image a, b;
    if (argc != 3 || !image_read(&a, argv[1], &err) || !image_read(&b, argv[2], &err)) {
        error_print(&err, "same-pixels");
        return 2;
    }
    bool same = a.width_px == b.width_px && a.height_px == b.height_px && a.channels == b.channels &&
                a.type == b.type && memcmp(a.data, b.data, image_size(&a)) == 0;
    image_release(&a);
    image_release(&b);
    return same ? 0 : 1;
}
