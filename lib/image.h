/* Images in memory, and the files they come from and go to.
 *
 * Pixels are interleaved, rows packed without padding, top row first, channels
 * in RGB(A) order. Float images are linear light (Rec.709 primaries,
 * premultiplied alpha) or metres; 8-bit colour images are sRGB. */
#ifndef STAFFAGE_LIB_IMAGE_H
#define STAFFAGE_LIB_IMAGE_H

#include "lib/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum pixel_type { PIXEL_U8, PIXEL_U16, PIXEL_F32 };

struct image {
    int width_px, height_px, channels; /* channels: 1, 3 or 4 */
    enum pixel_type type;
    void *data; /* owned; NULL in an empty image */
};

#ifdef __cplusplus
extern "C" {
#endif

/* Allocate zeroed pixels. image need not be initialized before. */
bool image_init(struct image *image, int width_px, int height_px, int channels, enum pixel_type type,
                      struct error *err);
/* Free the pixels; the image is empty after. An empty image is fine. */
void image_release(struct image *image);

static inline size_t image_pixel_size(const struct image *image)
{
    return (size_t)image->channels * (image->type == PIXEL_U8 ? 1u : image->type == PIXEL_U16 ? 2u : 4u);
}
static inline size_t image_size(const struct image *image)
{
    return image_pixel_size(image) * (size_t)image->width_px * (size_t)image->height_px;
}
/* The first channel of pixel (x, y), which must lie inside. */
static inline float *image_f32(const struct image *image, int x, int y)
{
    return (float *)image->data + ((size_t)y * (size_t)image->width_px + (size_t)x) * (size_t)image->channels;
}
static inline uint8_t *image_u8(const struct image *image, int x, int y)
{
    return (uint8_t *)image->data + ((size_t)y * (size_t)image->width_px + (size_t)x) * (size_t)image->channels;
}
static inline uint16_t *image_u16(const struct image *image, int x, int y)
{
    return (uint16_t *)image->data + ((size_t)y * (size_t)image->width_px + (size_t)x) * (size_t)image->channels;
}

/* Read PNG, JPEG, TIFF, EXR or Radiance HDR as it is stored: type and channels as in the
 * file (a JPEG's EXIF orientation is not applied; half floats become float).
 * Err: ERR_INPUT at `path` when it is missing, truncated or no image. */
bool image_read(struct image *image, const char *path, struct error *err);

/* The same from bytes in memory; `path` names them in errors. */
bool image_decode(struct image *image, const void *data, size_t size, const char *path, struct error *err);

/* Read only the size. */
bool image_read_size(int *width_px, int *height_px, const char *path, struct error *err);

/* Write by the extension of `path`: .png (U8, U16), .jpg (U8), .exr (F32, written
 * as 32-bit float, ZIP). Written beside, flushed, renamed. */
bool image_write(const char *path, const struct image *image, struct error *err);

/* A photograph as linear float RGB from an sRGB 8 or 16 bit image of 1, 3 or 4 channels
 * (alpha dropped). Out: linear (F32, 3 channels), initialized here. */
bool image_linear_from_srgb(struct image *linear, const struct image *srgb, struct error *err);
/* The reverse, 8 bits, rounded to nearest, clamped to [0, 1] before. */
bool image_srgb_from_linear(struct image *srgb, const struct image *linear, struct error *err);

/* Scale by area averaging (smaller) or bicubic (larger). Out initialized here. */
bool image_resize(struct image *out, const struct image *in, int width_px, int height_px, struct error *err);

/* IEC 61966-2-1. */
float srgb_from_linear(float linear);
float linear_from_srgb(float srgb);

/* Write chosen frames of a video as PNG, decoding it once from its start.
 * In: frames (n) ascending, from 0; paths (n), one for each frame.
 * Err: ERR_INPUT when the video cannot be read or ends before the last frame. */
bool video_extract(const char *video, const int *frames, const char *const *paths, size_t n, struct error *err);
/* Size and number of frames. */
bool video_info(int *width_px, int *height_px, int *frames, const char *video, struct error *err);

#ifdef __cplusplus
}
#endif
#endif
