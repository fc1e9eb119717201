/* A photograph at another size. Usage: resize WIDTH_PX FROM TO */
#include "lib/image.h"

#include <math.h>
#include <stdlib.h>

int main(int argc, char **argv)
{
    struct error err = ERROR_NONE;
    struct image from = { 0 }, to = { 0 };
    if (argc != 4) return 2;
    int width = atoi(argv[1]);
    bool ok = image_read(&from, argv[2], &err) &&
              image_resize(&to, &from, width, (int)lround((double)width * from.height_px / from.width_px), &err) &&
              image_write(argv[3], &to, &err);
    image_release(&from);
    image_release(&to);
    if (!ok) error_print(&err, "resize");
    return error_exit_status(&err);
}
