/* The one way from a C++ exception to `struct error`, for the OpenCV shims. */
#ifndef STAFFAGE_LIB_OPENCV_H
#define STAFFAGE_LIB_OPENCV_H

#include "lib/error.h"
#include "lib/image.h"

#include <exception>
#include <opencv2/core.hpp>

namespace staffage {

/* Run f; an exception becomes an error with that code. */
template <typename F> bool guarded(struct error *err, enum error_code code, F f)
{
    try {
        return f();
    } catch (const std::exception &e) {
        return error_set(err, code, "%s", e.what());
    }
}

/* A cv::Mat over the pixels of an image: no copy, channel order as in the image. */
inline cv::Mat mat_over(const struct image *image)
{
    int depth = image->type == PIXEL_U8 ? CV_8U : image->type == PIXEL_U16 ? CV_16U : CV_32F;
    return cv::Mat(image->height_px, image->width_px, CV_MAKETYPE(depth, image->channels), image->data);
}

} // namespace staffage
#endif
