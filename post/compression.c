#include "post/compression.h"

#include "lib/file.h"
#include "post/window.h"

#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <jpeglib.h>

/* libjpeg ends the program where it fails, unless it is left by a jump. */
struct failing { struct jpeg_error_mgr manager; jmp_buf out; };

static void leave(j_common_ptr codec)
{
    struct failing *failing = (struct failing *)codec->err;
    longjmp(failing->out, 1);
}

static void say_nothing(j_common_ptr codec)
{
    (void)codec;
}

static struct jpeg_error_mgr *quiet(struct failing *failing)
{
    jpeg_std_error(&failing->manager);
    failing->manager.error_exit = leave;
    failing->manager.output_message = say_nothing;
    return &failing->manager;
}

static bool take_head(struct compression *c, const unsigned char *data, size_t size)
{
    struct jpeg_decompress_struct codec;
    struct failing failing;
    codec.err = quiet(&failing);
    jpeg_create_decompress(&codec);
    if (setjmp(failing.out)) {
        jpeg_destroy_decompress(&codec);
        return false;
    }
    jpeg_mem_src(&codec, data, (unsigned long)size);
    jpeg_read_header(&codec, TRUE);
    *c = (struct compression){ .width_px = (int)codec.image_width, .height_px = (int)codec.image_height, .components = codec.num_components };
    c->found = (codec.jpeg_color_space == JCS_YCbCr && codec.num_components == 3) ||
               (codec.jpeg_color_space == JCS_GRAYSCALE && codec.num_components == 1);
    for (int i = 0; c->found && i < codec.num_components; i++) {
        const jpeg_component_info *info = &codec.comp_info[i];
        const JQUANT_TBL *table = codec.quant_tbl_ptrs[info->quant_tbl_no];
        c->across[i] = info->h_samp_factor;
        c->down[i] = info->v_samp_factor;
        if (!table) c->found = false;
        else memcpy(c->table[i], table->quantval, sizeof c->table[i]);
    }
    jpeg_destroy_decompress(&codec);
    return true;
}

bool compression_read(struct compression *compression, const char *path, struct error *err)
{
    char *data;
    size_t size;
    struct compression c = { .found = false };
    if (!file_read(&data, &size, path, err)) return false;
    bool jpeg = size > 3 && (unsigned char)data[0] == 0xff && (unsigned char)data[1] == 0xd8;
    bool ok = !jpeg || take_head(&c, (const unsigned char *)data, size) ||
              error_at(err, ERR_INPUT, path, 0, 0, "its JPEG head is damaged");
    free(data);
    if (ok) *compression = c;
    return ok;
}

/* Out: bytes: the storage of *size that is given, or libjpeg's own where that did not do; on failure, untouched. */
static bool encode(unsigned char **bytes, unsigned long *size, const struct image *rgb, const struct compression *c)
{
    struct jpeg_compress_struct codec;
    struct failing failing;
    codec.err = quiet(&failing);
    jpeg_create_compress(&codec);
    if (setjmp(failing.out)) {
        jpeg_destroy_compress(&codec);
        return false;
    }
    jpeg_mem_dest(&codec, bytes, size);
    codec.image_width = (JDIMENSION)rgb->width_px;
    codec.image_height = (JDIMENSION)rgb->height_px;
    codec.input_components = 3;
    codec.in_color_space = JCS_RGB;
    jpeg_set_defaults(&codec);
    jpeg_set_colorspace(&codec, c->components == 1 ? JCS_GRAYSCALE : JCS_YCbCr);
    for (int i = 0; i < c->components; i++) {
        unsigned int table[64];
        for (int k = 0; k < 64; k++) table[k] = c->table[i][k];
        jpeg_add_quant_table(&codec, i, table, 100, FALSE);
        codec.comp_info[i].quant_tbl_no = i;
        codec.comp_info[i].h_samp_factor = c->across[i];
        codec.comp_info[i].v_samp_factor = c->down[i];
    }
    jpeg_start_compress(&codec, TRUE);
    for (int y = 0; y < rgb->height_px; y++) {
        JSAMPROW row = image_u8(rgb, 0, y);
        jpeg_write_scanlines(&codec, &row, 1);
    }
    jpeg_finish_compress(&codec);
    jpeg_destroy_compress(&codec);
    return true;
}

static bool decode(struct image *rgb, const unsigned char *bytes, unsigned long size)
{
    struct jpeg_decompress_struct codec;
    struct failing failing;
    codec.err = quiet(&failing);
    jpeg_create_decompress(&codec);
    if (setjmp(failing.out)) {
        jpeg_destroy_decompress(&codec);
        return false;
    }
    jpeg_mem_src(&codec, bytes, size);
    jpeg_read_header(&codec, TRUE);
    codec.out_color_space = JCS_RGB;
    jpeg_start_decompress(&codec);
    for (int y = 0; y < rgb->height_px; y++) {
        JSAMPROW row = image_u8(rgb, 0, y);
        jpeg_read_scanlines(&codec, &row, 1);
    }
    jpeg_finish_decompress(&codec);
    jpeg_destroy_decompress(&codec);
    return true;
}

/* The blocks of all components that the window touches, as far as there is a picture. */
static struct rect whole_blocks(struct rect w, const struct compression *c)
{
    int across = 8, down = 8;
    for (int i = 0; i < c->components; i++) {
        if (8 * c->across[i] > across) across = 8 * c->across[i];
        if (8 * c->down[i] > down) down = 8 * c->down[i];
    }
    /* One more each way: where colours are stored coarser, they are interpolated across blocks. */
    struct rect r = { (w.x0 / across - 1) * across, (w.y0 / down - 1) * down,
                      ((w.x1 + across - 1) / across + 1) * across, ((w.y1 + down - 1) / down + 1) * down };
    return (struct rect){ r.x0 > 0 ? r.x0 : 0, r.y0 > 0 ? r.y0 : 0, r.x1 < c->width_px ? r.x1 : c->width_px,
                          r.y1 < c->height_px ? r.y1 : c->height_px };
}

bool compression_apply(struct image *rgb, struct rect window, const struct compression *c, struct error *err)
{
    struct rect blocks = whole_blocks(window, c);
    struct image cut;
    if (!window_cut(&cut, rgb, blocks, err)) return false;
    unsigned long size = 4096 + 4 * (unsigned long)image_size(&cut);
    unsigned char *room = malloc(size), *bytes = room;
    bool ok = room && (encode(&bytes, &size, &cut, c) && decode(&cut, bytes, size));
    if (!ok) error_set(err, ERR_MEMORY, "what is put in cannot be compressed as the photograph is");
    for (int y = window.y0; ok && y < window.y1; y++)
        memcpy(image_u8(rgb, window.x0, y), image_u8(&cut, window.x0 - blocks.x0, y - blocks.y0), 3 * (size_t)(window.x1 - window.x0));
    if (bytes != room) free(bytes);
    free(room);
    image_release(&cut);
    return ok;
}
