#include "lib/opencv.h"

extern "C" {
#include "lib/file.h"
}

#include <climits>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <unistd.h>

using staffage::guarded;
using staffage::mat_over;

namespace {

/* OpenCV asks for this before its first EXR file, and prints what we report ourselves. */
void prepare()
{
    setenv("OPENCV_IO_ENABLE_OPENEXR", "1", 1);
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
}

bool image_from_mat(struct image *image, const cv::Mat &mat, const char *path, struct error *err)
{
    enum pixel_type type;
    switch (mat.depth()) {
    case CV_8U: type = PIXEL_U8; break;
    case CV_16U: type = PIXEL_U16; break;
    case CV_32F: type = PIXEL_F32; break;
    default: return error_at(err, ERR_INPUT, path, 0, 0, "has pixels that are neither 8 bit, 16 bit nor float");
    }
    if (mat.channels() == 2) return error_at(err, ERR_INPUT, path, 0, 0, "has 2 channels: 1, 3 or 4 would be right");
    if (!image_init(image, mat.cols, mat.rows, mat.channels(), type, err)) return false;
    cv::Mat out = mat_over(image);
    if (mat.channels() == 3) cv::cvtColor(mat, out, cv::COLOR_BGR2RGB);
    else if (mat.channels() == 4) cv::cvtColor(mat, out, cv::COLOR_BGRA2RGBA);
    else mat.copyTo(out);
    return true;
}

const unsigned char png_signature[] = { 0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n' };

bool is_png(const unsigned char *bytes, size_t size)
{
    return size >= sizeof png_signature && !memcmp(bytes, png_signature, sizeof png_signature);
}

bool is_jpeg(const unsigned char *bytes, size_t size)
{
    return size > 3 && bytes[0] == 0xff && bytes[1] == 0xd8;
}

/* What OpenCV may be given from memory as well as from a file; an EXR it would first write to one. */
bool is_png_or_jpeg(const char *path)
{
    unsigned char head[sizeof png_signature] = { 0 };
    FILE *f = fopen(path, "rb");
    if (!f) return false;
    size_t size = fread(head, 1, sizeof head, f);
    fclose(f);
    return is_png(head, size) || is_jpeg(head, size);
}

bool jpeg_ends(const unsigned char *bytes, size_t size)
{
    /* Segments may hold whole pictures, thumbnails, and more may follow the end: the marker that counts
     * is the first one after the start of the scan, in which no other 0xff 0xd9 can stand. */
    size_t at = 2;
    while (at + 4 <= size && bytes[at] == 0xff && bytes[at + 1] != 0xda)
        at += bytes[at + 1] == 0xff ? 1 : 2 + (size_t)(bytes[at + 2] << 8 | bytes[at + 3]);
    for (; at + 1 < size; at++)
        if (bytes[at] == 0xff && bytes[at + 1] == 0xd9) return true;
    return false;
}

size_t png_length(const unsigned char *chunk)
{
    return (size_t)chunk[0] << 24 | (size_t)chunk[1] << 16 | (size_t)chunk[2] << 8 | chunk[3];
}

bool png_ends(const unsigned char *bytes, size_t size)
{
    for (size_t at = sizeof png_signature; at + 12 <= size && png_length(bytes + at) <= size - at - 12; at += png_length(bytes + at) + 12)
        if (!memcmp(bytes + at + 4, "IEND", 4)) return true;
    return false;
}

/* Looked at before it is decoded: libjpeg fills what is missing with grey, and both libraries print lines of their own. */
bool ends_early(const unsigned char *bytes, size_t size)
{
    if (is_jpeg(bytes, size)) return !jpeg_ends(bytes, size);
    return is_png(bytes, size) && !png_ends(bytes, size);
}

/* A PNG without its colour profile, which nobody here uses: libpng prints a line about many of them. */
std::vector<unsigned char> without_profile(const unsigned char *data, size_t size)
{
    std::vector<unsigned char> out(data, data + sizeof png_signature);
    for (size_t at = sizeof png_signature; at + 12 <= size;) {
        const unsigned char *chunk = data + at;
        size_t length = png_length(chunk), whole = length > size - at - 12 ? size - at : length + 12;
        if (memcmp(chunk + 4, "iCCP", 4) != 0) out.insert(out.end(), chunk, chunk + whole);
        at += whole;
    }
    return out;
}

cv::Mat decode(const void *data, size_t size)
{
    const int flags = cv::IMREAD_UNCHANGED | cv::IMREAD_IGNORE_ORIENTATION;
    const unsigned char *bytes = static_cast<const unsigned char *>(data);
    if (size == 0 || size > INT_MAX) return cv::Mat();
    if (is_png(bytes, size)) return cv::imdecode(without_profile(bytes, size), flags);
    return cv::imdecode(cv::Mat(1, (int)size, CV_8U, const_cast<void *>(data)), flags);
}

} // namespace

bool image_read(struct image *image, const char *path, struct error *err)
{
    return guarded(err, ERR_INPUT, [&] {
        prepare();
        if (!file_exists(path)) return error_at(err, ERR_INPUT, path, 0, 0, "does not exist");
        if (is_png_or_jpeg(path)) {
            char *data;
            size_t size;
            if (!file_read(&data, &size, path, err)) return false;
            bool ok = image_decode(image, data, size, path, err);
            free(data);
            return ok;
        }
        cv::Mat mat = cv::imread(path, cv::IMREAD_UNCHANGED | cv::IMREAD_IGNORE_ORIENTATION);
        if (mat.empty()) return error_at(err, ERR_INPUT, path, 0, 0, "is not an image that can be read (PNG, JPEG, TIFF or EXR), or is truncated");
        return image_from_mat(image, mat, path, err);
    });
}

bool image_decode(struct image *image, const void *data, size_t size, const char *path, struct error *err)
{
    return guarded(err, ERR_INPUT, [&] {
        prepare();
        if (ends_early(static_cast<const unsigned char *>(data), size))
            return error_at(err, ERR_INPUT, path, 0, 0, "is truncated: its end is missing");
        cv::Mat mat = decode(data, size);
        if (mat.empty()) return error_at(err, ERR_INPUT, path, 0, 0, "is not an image that can be read (PNG, JPEG, TIFF or EXR), or is truncated");
        return image_from_mat(image, mat, path, err);
    });
}

bool image_read_size(int *width_px, int *height_px, const char *path, struct error *err)
{
    struct image image;
    if (!image_read(&image, path, err)) return false;
    *width_px = image.width_px;
    *height_px = image.height_px;
    image_release(&image);
    return true;
}

bool image_write(const char *path, const struct image *image, struct error *err)
{
    return guarded(err, ERR_IO, [&] {
        prepare();
        cv::Mat in = mat_over(image), bgr;
        if (image->channels == 3) cv::cvtColor(in, bgr, cv::COLOR_RGB2BGR);
        else if (image->channels == 4) cv::cvtColor(in, bgr, cv::COLOR_RGBA2BGRA);
        else bgr = in;
        const char *dot = strrchr(path, '.');
        std::unique_ptr<char, decltype(&free)> temporary(file_temporary(path), free);
        if (!temporary) return error_set(err, ERR_MEMORY, "no memory for a path");
        std::vector<int> options;
        if (image->type == PIXEL_F32) options = { cv::IMWRITE_EXR_TYPE, cv::IMWRITE_EXR_TYPE_FLOAT };
        else if (dot && !strcmp(dot, ".jpg")) options = { cv::IMWRITE_JPEG_QUALITY, 95 };
        else options = { cv::IMWRITE_PNG_STRATEGY, cv::IMWRITE_PNG_STRATEGY_DEFAULT }; /* naming no level keeps OpenCV's one cheap filter */
        if (!cv::imwrite(temporary.get(), bgr, options)) {
            unlink(temporary.get());
            return error_at(err, ERR_IO, path, 0, 0, "cannot be written");
        }
        return file_commit(temporary.get(), path, err);
    });
}

bool image_resize(struct image *out, const struct image *in, int width_px, int height_px, struct error *err)
{
    return guarded(err, ERR_BUG, [&] {
        if (!image_init(out, width_px, height_px, in->channels, in->type, err)) return false;
        cv::Mat to = mat_over(out);
        cv::resize(mat_over(in), to, to.size(), 0, 0, width_px < in->width_px ? cv::INTER_AREA : cv::INTER_CUBIC);
        return true;
    });
}
