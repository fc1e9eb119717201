/* North by a shadow: the sun of a published ephemeris, and shadows whose direction is known. */
#include "gen/scene/scene.h"
#include "lib/file.h"
#include "tests/gen/craig.h"
#include "tests/tap.h"


#define DEG (180 / M_PI)
static char path[] = "north-test.XXXXXX";

/* The sun of 2021-05-01 14:53:40 UTC in Pittsburgh stands at azimuth 118.6 deg (NOAA), so shadows point to 298.6 deg. */
static struct scene *read_scene(const char *more, struct error *err)
{
    const char *top = getenv("top_srcdir");
    struct scene *scene = NULL;
    char *real = realpath(top ? top : ".", NULL);
    char *text = string_format("staffage: 1\nphotographs: {files: [%s/tests/input/street.png]}\n"
                               "camera: {model: PINHOLE, size_px: [64, 48], params: [60, 60, 32, 24], "
                               "pose: {look_at: {position_m: [0, 0, 30], target_m: [0, 0, 0], up: [0, 1, 0]}}}\n"
                               "time: 2021-05-01T14:53:40Z\nlight: {sky: overcast}\nground: {height_m: 0}\nexposure: {value: 1}\n%s\n",
                               real ? real : ".", more);
    free(real);
    if (!file_write(path, text, strlen(text), err) || !scene_read(&scene, path, NULL, err)) scene = NULL;
    free(text);
    return scene;
}

#define PITTSBURGH "place: {latitude_deg: 40.44694, longitude_deg: -79.94902, height_m: 280}\n"

/* From above, with +y up in the picture, a pixel is half a metre: a shadow from the middle to (x, y) m. */
static double height_m; /* of what casts it */

static double north_of(double x_m, double y_m)
{
    struct error err = ERROR_NONE;
    char *more = string_format(PITTSBURGH "north: {foot_px: [32, 24], tip_px: [%.3f, %.3f]}", 32 + 2 * x_m, 24 - 2 * y_m);
    struct scene *scene = read_scene(more, &err);
    double north = scene ? fmod(scene->north_rad * DEG + 720, 360) : NAN;
    if (!scene) OK(false, "%s: %s", more, err.text);
    height_m = scene ? scene->north_height_m : NAN;
    scene_destroy(scene);
    free(more);
    return north;
}

static void refuses(const char *more, const char *why)
{
    struct error err = ERROR_NONE;
    struct scene *scene = read_scene(more, &err);
    OK(!scene && strstr(err.text, why), "refused: %s", err.text);
    scene_destroy(scene);
}

int main(void)
{
    int file = mkstemp(path);
    if (file >= 0) close(file);
    NEAR(north_of(0, 5), 298.6, 0.1, "a shadow along +y: it points to 298.6 deg");
    NEAR(height_m, 5 * 1.1918, 0.02, "5 m long at 50.0 deg: something 5.96 m high casts it");
    NEAR(north_of(5, 0), 208.6, 0.1, "one along +x: +y is 90 deg before it");
    double turn = 298.6 / DEG;
    NEAR(fmod(north_of(5 * sin(turn), 5 * cos(turn)) + 180, 360), 180, 0.1, "one where it is in a world of true north");
    refuses("north: {foot_px: [32, 24], tip_px: [40, 24]}", "when place and time say");
    refuses(PITTSBURGH "north: {foot_px: [32, 24], tip_px: [32.05, 24]}", "too near each other");
    refuses(PITTSBURGH "north: {foot_px: [32, 24], tip_px: [70, 24]}", "north.tip_px");
    refuses(PITTSBURGH "north_deg: 3\nnorth: {foot_px: [32, 24], tip_px: [40, 24]}", "remove one");

    /* Real ones: where two people stand on craig's road, and where the shadows of their heads are. The world there has
     * its +y 5 deg from north, by the paper; the lens's distortion, which is not calibrated, turns what is at its edges; and
     * a pixel up or down at the feet is a degree. */
    if (!tap_shared()) {
        SKIP("north by two people's shadows on craig", "no ../shared");
    } else {
        static const double people[2][4] = { { 804, 480, 852, 467 }, { 307, 630, 377, 602 } };
        for (int i = 0; i < 2; i++) {
            struct error err = ERROR_NONE;
            struct scene *scene = NULL;
            char *more = string_format("light: {sky: clear}\nexposure: {value: 1}\nnorth: {foot_px: [%g, %g], tip_px: [%g, %g]}",
                                       people[i][0], people[i][1], people[i][2], people[i][3]);
            if (OK(craig_scene(&scene, "sunny_2021-05-01T14-53-40.jpg", more, &err), "craig with a marked shadow %s", err.text))
                NEAR(scene->north_rad * DEG, 40, 12, "person %d: +y is at 40 deg, by shadows drawn over theirs", i);
            scene_destroy(scene);
            free(more);
        }
    }
    unlink(path);
    return tap_done();
}
