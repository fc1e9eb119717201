#include "import/focal.h"
#include "import/georeference.h"
#include "import/gps_ties.h"
#include "lib/file.h"

#include "tests/tap.h"

static char *file_of(const char *folder, const char *name)
{
    return string_format("%s/data/brighton/%s%s", tap_shared(), folder, name);
}

/* The similarity from the photographs' GPS; every residual 3 m at most. */
static bool georeference(struct similarity *s, struct tie_residual *residuals, double *rms_m, struct focal_check *focal,
                         struct error *err)
{
    char *folder = file_of("colmap", "");
    struct reconstruction flight;
    struct photo_facts facts[18];
    struct tie *ties = NULL;
    size_t n = 0;
    double origin[3];
    bool good = colmap_read(&flight, folder, err);
    if (good) {
        good = flight.shot_count == 18;
        for (size_t i = 0; good && i < 18; i++) {
            char *photograph = file_of("images/", flight.shots[i].image);
            good = photo_facts_read(&facts[i], photograph, err);
            free(photograph);
        }
        good = good && gps_ties(&ties, &n, origin, &flight, facts, err) && n == 18
               && georeference_ties(s, residuals, rms_m, ties, n, 3, err)
               && focal_differs(focal, &flight, facts);
        reconstruction_release(&flight);
    }
    free(ties);
    free(folder);
    return good;
}

int main(void)
{
    if (!tap_shared()) {
        SKIP("brighton's GPS", "no shared folder");
        return tap_done();
    }
    struct similarity s;
    struct tie_residual residuals[18];
    struct error err = ERROR_NONE;
    double rms_m = NAN;
    struct focal_check focal = { 0 };
    if (!OK(georeference(&s, residuals, &rms_m, &focal, &err), "brighton: 18 positions give the similarity")) {
        printf("# %s\n", err.text);
        return tap_done();
    }
    OK(rms_m <= 0.7, "brighton: rms at most 0.7 m (%.3f m)", rms_m);
    size_t inliers = 0;
    for (size_t i = 0; i < 18; i++) inliers += residuals[i].inlier;
    OK(inliers == 18, "brighton: no position is wrong");
    /* By numpy: places by the WGS 84 definition, GPS by exiftool, rotation and scale by numpy.linalg.svd. */
    NEAR(rms_m, 0.6003938, 1e-5, "brighton: the rms that numpy finds");
    NEAR(s.scale, 8.3421999, 1e-6, "brighton: the scale that numpy finds");
    const double rotation[3][3] = { { 0.75246308, -0.65863272, -0.00149974 },
                                    { -0.65669787, -0.75042318, 0.07491962 },
                                    { -0.05046995, -0.05538937, -0.99718845 } };
    double worst = 0;
    for (int i = 0; i < 9; i++) worst = fmax(worst, fabs(s.rotation.m[i / 3][i % 3] - rotation[i / 3][i % 3]));
    NEAR(worst, 0, 1e-7, "brighton: the rotation that numpy finds");
    NEAR(vec3_norm(vec3_sub(s.translation, vec3(42.22802948, 8.27600913, 0.70139913))), 0, 1e-5, "brighton: and the place");
    NEAR(focal.reconstruction_mm, 1466.4181492 * 36 / 2000, 1e-6, "brighton: the lens that COLMAP found is told,");
    NEAR(focal.exif_mm, 20, 0, "brighton: and that it is not the one of EXIF");
    return tap_done();
}
