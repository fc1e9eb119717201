#include "catalogue/sheet.h"

#include "lib/opencv.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

using staffage::guarded;
using staffage::mat_over;

bool sheet_make(struct image *sheet, const struct image *pictures, const char *const *captions, size_t count, size_t columns,
                struct error *err)
{
    struct image made = {};
    bool ok = guarded(err, ERR_BUG, [&] {
        const int width = pictures[0].width_px, height = pictures[0].height_px, line = height / 9;
        const int across = (int)columns, down = (int)((count + columns - 1) / columns);
        if (!image_init(&made, across * width, down * (height + line), 3, PIXEL_U8, err)) return false;
        cv::Mat all = mat_over(&made);
        all.setTo(cv::Scalar(255, 255, 255));
        int widest = 1, below = 0;
        for (size_t i = 0; i < count; i++)
            widest = std::max(widest, cv::getTextSize(captions[i], cv::FONT_HERSHEY_SIMPLEX, 1, 1, &below).width);
        const double scale = std::min(line / 34.0, (width - line / 2.0) / widest);
        for (int i = 0; i < (int)count; i++) {
            cv::Rect at(i % across * width, i / across * (height + line), width, height);
            mat_over(&pictures[i]).copyTo(all(at));
            cv::putText(all, captions[i], cv::Point(at.x + line / 4, at.y + height + line * 7 / 10), cv::FONT_HERSHEY_SIMPLEX, scale,
                        cv::Scalar(30, 30, 30), 1, cv::LINE_AA);
        }
        return true;
    });
    if (ok) *sheet = made;
    else image_release(&made);
    return ok;
}
