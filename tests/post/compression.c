#include "post/compression.h"

#include "tests/post/taken.h"
#include "tests/tap.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define W 120
#define H 90

int main(void)
{
    char folder[] = "staffage-compression-XXXXXX", path[64], png[64];
    struct error err = ERROR_NONE;
    struct compression c;
    if (!mkdtemp(folder)) return 99;
    snprintf(path, sizeof path, "%s/a.jpg", folder);
    snprintf(png, sizeof png, "%s/a.png", folder);
    srand(1);
    struct image rgb = grey(W, H, 0), stored;
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++)
            for (int k = 0; k < 3; k++)
                image_u8(&rgb, x, y)[k] = byte(100 + 60 * sin(0.2 * x + k) + (x > 60 && y > 40 ? 50 : 0) + 4 * noise());
    OK(image_write(path, &rgb, &err) && image_write(png, &rgb, &err), "a photograph is stored");
    if (!OK(compression_read(&c, path, &err) && c.found, "its tables are read")) return tap_done();
    /* quality 95 of libjpeg: (50 + 16 * 10) / 100 and (50 + 17 * 10) / 100 */
    OK(c.width_px == W && c.height_px == H && c.components == 3 && c.table[0][0] == 2 && c.table[1][0] == 2, "as they were written");

    /* The same picture, pressed by the same tables on the same grid, is what the file has. */
    image_read(&stored, path, &err);
    struct image again = grey(W, H, 0);
    memcpy(again.data, rgb.data, image_size(&rgb));
    OK(compression_apply(&again, (struct rect){ 21, 19, 77, 63 }, &c, &err), "a window is compressed");
    int off = 0, outside = 0;
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++) {
            bool in = x >= 21 && x < 77 && y >= 19 && y < 63;
            off += in && memcmp(image_u8(&again, x, y), image_u8(&stored, x, y), 3) != 0;
            outside += !in && memcmp(image_u8(&again, x, y), image_u8(&rgb, x, y), 3) != 0;
        }
    NEAR(off, 0, 0, "to the bytes of the file");
    NEAR(outside, 0, 0, "and nothing round it changes");

    OK(compression_read(&c, png, &err) && !c.found, "a PNG has no tables");
    OK(truncate(path, 40) == 0 && !compression_read(&c, path, &err) && err.code == ERR_INPUT && strstr(err.text, "damaged"),
       "a damaged head is an error");
    image_release(&again);
    image_release(&stored);
    image_release(&rgb);
    unlink(path);
    unlink(png);
    rmdir(folder);
    return tap_done();
}
