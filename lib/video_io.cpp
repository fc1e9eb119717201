/* Apart from image_io.cpp: what only reads images is not linked with FFmpeg, whose many
 * libraries cost a tenth of a second at every start. */
#include "lib/opencv.h"

#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

using staffage::guarded;
using staffage::mat_over;

bool video_info(int *width_px, int *height_px, int *frames, const char *video, struct error *err)
{
    return guarded(err, ERR_INPUT, [&] {
        cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT); /* what it prints we report ourselves */
        cv::VideoCapture capture(video, cv::CAP_FFMPEG);
        if (!capture.isOpened()) return error_at(err, ERR_INPUT, video, 0, 0, "is not a video that can be read");
        *width_px = (int)capture.get(cv::CAP_PROP_FRAME_WIDTH);
        *height_px = (int)capture.get(cv::CAP_PROP_FRAME_HEIGHT);
        *frames = (int)capture.get(cv::CAP_PROP_FRAME_COUNT);
        return true;
    });
}

bool video_extract(const char *video, const int *frames, const char *const *paths, size_t n, struct error *err)
{
    return guarded(err, ERR_INPUT, [&] {
        cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT); /* what it prints we report ourselves */
        cv::VideoCapture capture(video, cv::CAP_FFMPEG);
        if (!capture.isOpened()) return error_at(err, ERR_INPUT, video, 0, 0, "is not a video that can be read");
        int at = -1; /* seeking in a video is not exact with every codec: it is decoded in order */
        cv::Mat mat;
        for (size_t i = 0; i < n; i++) {
            for (; at < frames[i]; at++)
                if (!capture.grab())
                    return error_at(err, ERR_INPUT, video, 0, 0, "ends before frame %d: it has %d frames", frames[i], at + 1);
            struct image image;
            if (!capture.retrieve(mat)) return error_at(err, ERR_INPUT, video, 0, 0, "frame %d cannot be decoded", frames[i]);
            if (mat.type() != CV_8UC3) return error_at(err, ERR_INPUT, video, 0, 0, "has frames that are not 8-bit colour");
            if (!image_init(&image, mat.cols, mat.rows, 3, PIXEL_U8, err)) return false;
            cv::Mat rgb = mat_over(&image);
            cv::cvtColor(mat, rgb, cv::COLOR_BGR2RGB);
            bool ok = image_write(paths[i], &image, err);
            image_release(&image);
            if (!ok) return false;
        }
        return true;
    });
}
