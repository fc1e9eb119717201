/* The street of shared/data/craig, whose light and shadows are known, as a scene without entities. */
#ifndef STAFFAGE_TESTS_GEN_CRAIG_H
#define STAFFAGE_TESTS_GEN_CRAIG_H

#include "gen/scene/scene.h"
#include "lib/file.h"
#include "tests/tap.h"

#include <unistd.h>

/* In: photograph: its name there; more: further keys, light among them
 * Out: *scene, the caller's */
__attribute__((unused))
static bool craig_scene(struct scene **scene, const char *photograph, const char *more, struct error *err)
{
    char path[] = "craig-test.XXXXXX";
    int file = mkstemp(path);
    if (file < 0) return error_set(err, ERR_IO, "no file for a scene");
    close(file);
    char *shared = realpath(tap_shared(), NULL);
    char *text = string_format("staffage: 1\nphotographs: {files: [%s/data/craig/%s]}\n"
                               "camera:\n  model: PINHOLE\n  size_px: [2000, 1500]\n  horizontal_fov_deg: 90\n  pose:\n"
                               "    axes: x-left-y-up\n    world_axes: [west, up, north]\n    matrix:\n"
                               "      - [-6.32009074e-01,  3.81421015e-01,  6.74598057e-01, -1.95597297e+01]\n"
                               "      - [ 5.25615099e-03,  8.72582680e-01, -4.88438164e-01,  6.43714192e+00]\n"
                               "      - [-7.74943161e-01, -3.05151563e-01, -5.53484978e-01,  4.94516235e+00]\n"
                               "place: {latitude_deg: 40.44694, longitude_deg: -79.94902, height_m: 280}\n"
                               "time: 2021-05-01T14:53:40Z\nground: {height_m: 0, albedo: 0.25}\n%s\n", shared, photograph, more);
    bool ok = shared && text && file_write(path, text, strlen(text), err) && scene_read(scene, path, NULL, err);
    free(text);
    free(shared);
    unlink(path);
    return ok;
}

#endif
