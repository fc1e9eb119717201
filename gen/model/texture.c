#include "gen/model/texture.h"

#include "gen/model/paint.h"
#include "lib/file.h"
#include "lib/image.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The texture at the size wanted: a view of the model's own pixels, or scaled ones in *scaled. */
static bool limit_size(struct image *view, struct image *scaled, const struct image *image, int max_px, struct error *err)
{
    int longest = image->width_px > image->height_px ? image->width_px : image->height_px;
    *scaled = (struct image){ 0 };
    *view = *image;
    if (max_px <= 0 || longest <= max_px) return true;
    double f = (double)max_px / longest;
    int w = (int)fmax(1, round(image->width_px * f)), h = (int)fmax(1, round(image->height_px * f));
    if (!image_resize(scaled, image, w, h, err)) return false;
    *view = *scaled;
    return true;
}

/* Colours with the material's factor, and its new paint. Out: U8, 3 channels. */
static bool bake_color(struct image *out, const struct image *texture, const struct model *model, size_t material,
                       const double *paint, struct error *err)
{
    const struct material *m = &model->materials[material];
    struct image linear;
    if (!image_linear_from_srgb(&linear, texture, err)) return false;
    float *rgb = linear.data;
    size_t values = 3 * (size_t)linear.width_px * (size_t)linear.height_px;
    for (size_t i = 0; i < values; i++) rgb[i] *= (float)m->base_color[i % 3];
    bool ok = (!paint || paint_body(&linear, texture, model, material, paint, err)) && image_srgb_from_linear(out, &linear, err);
    image_release(&linear);
    return ok;
}

static uint8_t alpha_of(const struct material *m, uint8_t texel)
{
    double alpha = m->alpha * texel / 255;
    if (m->alpha_mode == ALPHA_OPAQUE) alpha = 1;
    if (m->alpha_mode == ALPHA_MASK) alpha = alpha >= m->alpha_cutoff;
    return (uint8_t)lround(255 * alpha * (1 - m->transmission));
}

static bool make(struct image *out, const struct image *texture, const struct model *model, size_t material,
                 const double *paint, struct error *err)
{
    const struct material *m = &model->materials[material];
    bool painted = paint && m->kind == FINISH_PAINT;
    bool colored = painted || m->base_color[0] != 1 || m->base_color[1] != 1 || m->base_color[2] != 1;
    bool has_alpha = m->alpha_mode != ALPHA_OPAQUE || m->transmission > 0;
    struct image color = { 0 };
    if (colored && !bake_color(&color, texture, model, material, painted ? paint : NULL, err)) return false;
    bool ok = image_init(out, texture->width_px, texture->height_px, has_alpha ? 4 : 3, PIXEL_U8, err);
    const struct image *from = colored ? &color : texture;
    for (int y = 0; ok && y < out->height_px; y++)
        for (int x = 0; x < out->width_px; x++) {
            memcpy(image_u8(out, x, y), image_u8(from, x, y), 3);
            if (has_alpha) image_u8(out, x, y)[3] = alpha_of(m, texture->channels == 4 ? image_u8(texture, x, y)[3] : 255);
        }
    image_release(&color);
    return ok;
}

bool texture_write(char name[TEXTURE_NAME_SIZE], bool *has_alpha, const struct model *model, size_t material,
                   const double paint[3], const char *folder, int max_px, struct error *err)
{
    struct image texture, scaled, out = { 0 };
    if (!limit_size(&texture, &scaled, &model->materials[material].base_image, max_px, err)) return false;
    bool ok = make(&out, &texture, model, material, paint, err) && folder_make(folder, err);
    char *path = NULL;
    if (!ok) goto done;
    int shape[] = { out.width_px, out.height_px, out.channels };
    uint64_t hash = hash_bytes(hash_bytes(FILE_HASH_SEED, shape, sizeof shape), out.data, image_size(&out));
    char file[TEXTURE_NAME_SIZE];
    snprintf(file, sizeof file, "t%016llx.png", (unsigned long long)hash);
    path = string_format("%s/%s", folder, file);
    ok = path ? file_exists(path) || image_write(path, &out, err) : error_set(err, ERR_MEMORY, "no memory for a path");
    if (!ok) goto done;
    memcpy(name, file, sizeof file);
    *has_alpha = out.channels == 4;
done:
    free(path);
    image_release(&out);
    image_release(&scaled);
    return ok;
}
