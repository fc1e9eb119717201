#include "import/focal.h"

#include <stdlib.h>

static double ratio_of(struct focal_check c) { return c.reconstruction_mm / c.exif_mm; }

static int by_ratio(const void *a, const void *b)
{
    double x = ratio_of(*(const struct focal_check *)a), y = ratio_of(*(const struct focal_check *)b);
    return (x > y) - (x < y);
}

bool focal_differs(struct focal_check *check, const struct reconstruction *reconstruction, const struct photo_facts *facts)
{
    struct focal_check *checks = calloc(reconstruction->shot_count + 1, sizeof *checks);
    size_t n = 0;
    for (size_t i = 0; checks && i < reconstruction->shot_count; i++) {
        const struct camera *camera = &reconstruction->cameras[reconstruction->shots[i].camera].camera;
        int longer_px = camera->width_px > camera->height_px ? camera->width_px : camera->height_px;
        if (facts[i].focal_35mm > 0)
            checks[n++] = (struct focal_check){ camera_intrinsics(camera).fx_px * 36 / longer_px, facts[i].focal_35mm };
    }
    bool differs = false;
    if (n) {
        qsort(checks, n, sizeof *checks, by_ratio);
        *check = checks[n / 2];
        differs = ratio_of(*check) > 1.15 || ratio_of(*check) < 1 / 1.15;
    }
    free(checks);
    return differs;
}
