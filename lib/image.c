#include "lib/image.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

bool image_init(struct image *image, int width_px, int height_px, int channels, enum pixel_type type,
                struct error *err)
{
    if (width_px <= 0 || height_px <= 0 || width_px > 65535 || height_px > 65535)
        return error_set(err, ERR_INPUT, "an image of %d x %d pixels is not possible", width_px, height_px);
    struct image made = { width_px, height_px, channels, type, NULL };
    made.data = calloc(image_size(&made), 1);
    if (!made.data) return error_set(err, ERR_MEMORY, "no memory for an image of %d x %d", width_px, height_px);
    *image = made;
    return true;
}

void image_release(struct image *image)
{
    free(image->data);
    *image = (struct image){ 0 };
}

float srgb_from_linear(float linear)
{
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * powf(linear, 1 / 2.4f) - 0.055f;
}

float linear_from_srgb(float srgb)
{
    return srgb <= 0.04045f ? srgb / 12.92f : powf((srgb + 0.055f) / 1.055f, 2.4f);
}

bool image_linear_from_srgb(struct image *linear, const struct image *srgb, struct error *err)
{
    if (srgb->type == PIXEL_F32) return error_set(err, ERR_INPUT, "a photograph must have 8 or 16 bits a channel");
    int levels = srgb->type == PIXEL_U8 ? 256 : 65536;
    float *table = malloc((size_t)levels * sizeof *table);
    if (!table) return error_set(err, ERR_MEMORY, "no memory for a colour table");
    for (int i = 0; i < levels; i++) table[i] = linear_from_srgb((float)i / (float)(levels - 1));
    struct image out;
    if (!image_init(&out, srgb->width_px, srgb->height_px, 3, PIXEL_F32, err)) {
        free(table);
        return false;
    }
    size_t pixels = (size_t)srgb->width_px * (size_t)srgb->height_px, stride = (size_t)srgb->channels;
    const uint8_t *u8 = srgb->data;
    const uint16_t *u16 = srgb->data;
    float *to = out.data;
    for (size_t i = 0; i < pixels; i++)
        for (size_t c = 0; c < 3; c++) {
            size_t from = i * stride + (stride >= 3 ? c : 0);
            *to++ = table[levels == 256 ? u8[from] : u16[from]];
        }
    free(table);
    *linear = out;
    return true;
}

bool image_srgb_from_linear(struct image *srgb, const struct image *linear, struct error *err)
{
    struct image out;
    if (!image_init(&out, linear->width_px, linear->height_px, linear->channels, PIXEL_U8, err)) return false;
    size_t n = image_size(&out);
    const float *from = linear->data;
    uint8_t *to = out.data;
    for (size_t i = 0; i < n; i++) {
        float v = from[i] > 0 ? from[i] < 1 ? from[i] : 1 : 0; /* a NaN becomes 0 */
        to[i] = (uint8_t)(srgb_from_linear(v) * 255 + 0.5f);
    }
    *srgb = out;
    return true;
}
