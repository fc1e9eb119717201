#include "gen/model/texture.h"

#include "lib/file.h"
#include "tests/tap.h"

#include <dirent.h>
#include <unistd.h>

static char folder[] = "texture-test.XXXXXX";

static size_t files(void)
{
    size_t n = 0;
    DIR *dir = opendir(folder);
    for (struct dirent *entry; dir && (entry = readdir(dir));) n += entry->d_name[0] == 't';
    if (dir) closedir(dir);
    return n;
}

static void empty_folder(void)
{
    DIR *dir = opendir(folder);
    for (struct dirent *entry; dir && (entry = readdir(dir));) {
        char *path = string_format("%s/%s", folder, entry->d_name);
        if (entry->d_name[0] == 't') unlink(path);
        free(path);
    }
    if (dir) closedir(dir);
}

/* One square of 1 m, uv over the whole texture, facing up. */
static float position[4][3] = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } }, uv[4][2] = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } };
static uint32_t triangle[2][3] = { { 0, 1, 2 }, { 0, 2, 3 } };
static struct mesh mesh = { .position_m = position, .uv = uv, .triangle = triangle, .vertices = 4, .triangles = 2 };
static struct material material;
static struct model model = { .meshes = &mesh, .mesh_count = 1, .materials = &material, .material_count = 1 };

static void set_material(int width, int height, int channels, void *pixels)
{
    material_default(&material);
    material.base_image = (struct image){ width, height, channels, PIXEL_U8, pixels };
}

/* What texture_write makes; an empty image when it fails. */
static struct image written(const double *paint, int max_px, char name[TEXTURE_NAME_SIZE], bool *has_alpha)
{
    struct error err = ERROR_NONE;
    struct image image = { 0 };
    char *path = NULL;
    if (texture_write(name, has_alpha, &model, 0, paint, folder, max_px, &err)) path = string_format("%s/%s", folder, name);
    if (!path || !image_read(&image, path, &err)) printf("# %s: %s\n", err.file, err.text);
    free(path);
    return image;
}

static bool pixel_is(const struct image *image, int x, int y, int r, int g, int b, int tolerance)
{
    if (!image->data) return false;
    const uint8_t *p = image_u8(image, x, y);
    bool ok = abs(p[0] - r) <= tolerance && abs(p[1] - g) <= tolerance && abs(p[2] - b) <= tolerance;
    if (!ok) printf("# pixel (%d, %d) is %d %d %d, want %d %d %d\n", x, y, p[0], p[1], p[2], r, g, b);
    return ok;
}

static void textures_are_written(void)
{
    static uint8_t rgba[16] = { 255, 0, 0, 0, 0, 255, 0, 100, 0, 0, 255, 200, 188, 188, 188, 255 };
    char name[TEXTURE_NAME_SIZE], again[TEXTURE_NAME_SIZE];
    bool has_alpha = true;
    set_material(2, 2, 4, rgba);
    struct image image = written(NULL, 0, name, &has_alpha);
    OK(image.channels == 3 && !has_alpha && pixel_is(&image, 0, 0, 255, 0, 0, 0) && pixel_is(&image, 1, 1, 188, 188, 188, 0), "an opaque material's alpha channel is dropped, its colours stay");
    image_release(&image);
    OK(strlen(name) == 21 && name[0] == 't' && strspn(name + 1, "0123456789abcdef") == 16 && !strcmp(name + 17, ".png"), "the file is named after its content");
    snprintf(material.name, sizeof material.name, "x\" #fopen F \"/etc/passwd");
    image = written(NULL, 0, again, &has_alpha);
    OK(!strcmp(again, name) && files() == 1, "the same content is one file, whatever the material is called");
    image_release(&image);
    material.base_color[0] = material.base_color[1] = material.base_color[2] = 0.5;
    image = written(NULL, 0, again, &has_alpha);
    /* sRGB 188 is linear 0.503; half of it is sRGB 137 */
    OK(strcmp(again, name) != 0 && pixel_is(&image, 0, 0, 188, 0, 0, 1) && pixel_is(&image, 1, 1, 137, 137, 137, 1), "the colour factor multiplies linear light");
    image_release(&image);
    set_material(2, 2, 4, rgba);
    material.alpha_mode = ALPHA_MASK;
    material.alpha_cutoff = 0.5;
    image = written(NULL, 0, name, &has_alpha);
    OK(has_alpha && image.channels == 4 && image_u8(&image, 0, 0)[3] == 0 && image_u8(&image, 1, 0)[3] == 0 && image_u8(&image, 0, 1)[3] == 255, "a mask's alpha is all or nothing");
    image_release(&image);
    material.alpha_mode = ALPHA_BLEND;
    material.alpha = 0.5;
    image = written(NULL, 0, name, &has_alpha);
    OK(has_alpha && image.channels == 4 && image_u8(&image, 1, 0)[3] == 50 && image_u8(&image, 1, 1)[3] == 128, "a blended one's is factor times texel");
    image_release(&image);
    set_material(2, 2, 4, rgba);
    material.transmission = 0.8;
    image = written(NULL, 0, name, &has_alpha);
    OK(has_alpha && image.channels == 4 && image_u8(&image, 0, 0)[3] == 51, "transmission lets light through");
    image_release(&image);
    set_material(2, 2, 4, rgba);
    image = written(NULL, 1, name, &has_alpha);
    OK(image.width_px == 1 && image.height_px == 1, "a texture is scaled down to the size wanted");
    image_release(&image);
    image = written(NULL, 2, name, &has_alpha);
    OK(image.width_px == 2, "and left alone where it is no larger");
    image_release(&image);
    struct error err = ERROR_NONE;
    OK(!texture_write(name, &has_alpha, &model, 0, NULL, "/dev/null/x", 0, &err) && err.code == ERR_IO, "a folder that cannot be made is an error");
}

/* 10x10: rows 0 to 6 body (light grey, the last of them in shade), rows 7 and 8 glass (nearly black), row 9 a red light. */
static void fill_car(uint8_t *pixels, int channels, bool alpha_marks)
{
    static const uint8_t rows[10][3] = { { 200, 200, 200 }, { 200, 200, 200 }, { 200, 200, 200 }, { 200, 200, 200 }, { 200, 200, 200 }, { 200, 200, 200 },
                                         { 145, 145, 145 }, { 20, 20, 22 }, { 20, 20, 22 }, { 220, 20, 20 } };
    for (int i = 0; i < 100; i++) {
        memcpy(pixels + i * channels, rows[i / 10], 3);
        if (channels == 4) pixels[4 * i + 3] = alpha_marks && i / 10 >= 2 ? 0 : 255;
    }
}

static void bodies_are_painted(void)
{
    static uint8_t pixels[400];
    char name[TEXTURE_NAME_SIZE];
    bool has_alpha;
    const double red[3] = { 0.5, 0.02, 0.02 };
    fill_car(pixels, 3, false);
    set_material(10, 10, 3, pixels);
    material.kind = FINISH_PAINT;
    struct image image = written(red, 0, name, &has_alpha);
    /* linear 0.5 and 0.02 are sRGB 188 and 39; the shade (sRGB 145 of 200) has 0.487 of the light: 135 and 25 */
    OK(pixel_is(&image, 5, 3, 188, 39, 39, 2), "the body's lit colour becomes the paint");
    OK(pixel_is(&image, 5, 6, 135, 25, 25, 3), "its shade a shade of the paint");
    OK(pixel_is(&image, 5, 8, 20, 20, 22, 1), "glass stays");
    OK(pixel_is(&image, 5, 9, 220, 20, 20, 1), "a light stays");
    image_release(&image);
    material.kind = FINISH_PLASTIC;
    image = written(red, 0, name, &has_alpha);
    OK(pixel_is(&image, 5, 3, 200, 200, 200, 0), "only what is paint is painted");
    image_release(&image);
    material.kind = FINISH_PAINT;
    image = written(NULL, 0, name, &has_alpha);
    OK(pixel_is(&image, 5, 3, 200, 200, 200, 0), "and nothing for an entity without a colour");
    image_release(&image);
    fill_car(pixels, 4, true);
    set_material(10, 10, 4, pixels);
    material.kind = FINISH_PAINT;
    image = written(red, 0, name, &has_alpha);
    OK(!has_alpha && pixel_is(&image, 5, 1, 188, 39, 39, 2) && pixel_is(&image, 5, 3, 200, 200, 200, 0), "an alpha channel of two values says where the paint is");
    image_release(&image);
    const double black[3] = { 0, 0, 0 };
    image = written(black, 0, name, &has_alpha);
    OK(pixel_is(&image, 5, 1, 0, 0, 0, 0), "black paint is black");
    image_release(&image);
    for (int i = 0; i < 100; i++) memset(pixels + 4 * i, 0, 4);
    image = written(red, 0, name, &has_alpha);
    OK(image.data != NULL, "a texture that is all black and marks nothing is no error");
    image_release(&image);
}

int main(void)
{
    if (!mkdtemp(folder)) return 1;
    textures_are_written();
    bodies_are_painted();
    empty_folder();
    rmdir(folder);
    return tap_done();
}
