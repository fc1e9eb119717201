#include "post/morphology.h"

#include "lib/opencv.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

using staffage::guarded;
using staffage::mat_over;

namespace {

template <typename F> bool filter(struct image *out, const struct image *in, struct error *err, F f)
{
    struct image made = {};
    bool ok = guarded(err, ERR_BUG, [&] {
        if (!image_init(&made, in->width_px, in->height_px, in->channels, in->type, err)) return false;
        f(mat_over(in), mat_over(&made));
        return true;
    });
    if (ok) *out = made;
    else image_release(&made);
    return ok;
}

} // namespace

bool morphology_dilate(struct image *out, const struct image *in, struct error *err)
{
    return filter(out, in, err, [](const cv::Mat &from, cv::Mat to) { cv::dilate(from, to, cv::Mat()); });
}

bool morphology_erode(struct image *out, const struct image *in, struct error *err)
{
    return filter(out, in, err, [](const cv::Mat &from, cv::Mat to) { cv::erode(from, to, cv::Mat()); });
}

bool morphology_blur(struct image *out, const struct image *in, struct error *err)
{
    return filter(out, in, err, [](const cv::Mat &from, cv::Mat to) {
        cv::GaussianBlur(from, to, cv::Size(5, 5), 1.1, 1.1, cv::BORDER_REFLECT_101);
    });
}

bool morphology_gaussian(struct image *out, const struct image *in, double sigma_px, struct error *err)
{
    return filter(out, in, err, [=](const cv::Mat &from, cv::Mat to) {
        int side = 2 * (int)std::ceil(3 * sigma_px) + 1;
        cv::GaussianBlur(from, to, cv::Size(side, side), sigma_px, sigma_px, cv::BORDER_CONSTANT);
    });
}
