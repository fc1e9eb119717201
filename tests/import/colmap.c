#include "import/reconstruction.h"

#include "tests/import/scratch.h"

/* A model with a camera of every lens, as COLMAP would write it. */
static const double figures[CAMERA_PARAMS_MAX] = { 1466.4181492119128, 1462.7858494074478, 1000.1, 562.5, 0.1, 1.0 / 3,
                                                   -0.0017387769992896717, 1e-17, -2.5e-9, 0.7, -0.02, 123456.789 };
static const double pose[7] = { 0.99936793353886866, 0.033089442374655151, 0.0013429945280586284,
                                -0.012923566972145214, -3.4159128063301263, 3.7911113966596459, 0.094509119109008041 };
static const double keypoints[2][2] = { { 558.85308837890625, 2.5606210231781006 }, { 1.0 / 3, 973.15936279296875 } };

static const char *image_name(int i)
{
    static char name[32];
    snprintf(name, sizeof name, i == 3 ? "over there/IMG %02d.JPG" : "IMG_%02d.JPG", i);
    return name;
}

/* Image i is of camera i + 5 and turned by i; it sees point 7 and, of no point, another one; image 2 sees nothing. */
static void write_text(void)
{
    char cameras[8192] = "# Camera list\n#   CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n", images[8192] = "# Image list\n\n";
    for (int i = 0; i < CAMERA_MODEL_COUNT; i++) {
        char *c = cameras + strlen(cameras), *m = images + strlen(images);
        c += sprintf(c, "%d %s %d 1125", i + 5, camera_model_name((enum camera_model)i), 2000 + i);
        for (int k = 0; k < camera_model_param_count((enum camera_model)i); k++) c += sprintf(c, " %.17g", figures[k]);
        sprintf(c, "\n");
        m += sprintf(m, "%d", 40 - i);
        for (int k = 0; k < 7; k++) m += sprintf(m, " %.17g", pose[k] + (k == 4 ? i : 0));
        m += sprintf(m, " %d %s\n", i + 5, image_name(i));
        if (i == 2)
            sprintf(m, "\n");
        else
            sprintf(m, "%.17g %.17g 7 %.17g %.17g -1\n", keypoints[0][0], keypoints[0][1], keypoints[1][0], keypoints[1][1]);
    }
    scratch_text("cameras.txt", cameras);
    scratch_text("images.txt", images);
    scratch_text("points3D.txt", "# 3D point list\n9 4.23702441385083 1.9345664819046862 5.3968618000775797 46 69 93 0.25 40 0 39 0\r\n"
                                 "7 -0.48107892281846054 1.0998580214005054 5.4091984351370233 116 121 147 0.75\n");
}

struct out { char bytes[16384]; size_t size; };

static void put(struct out *o, uint64_t value, int bytes)
{
    for (int i = 0; i < bytes; i++) o->bytes[o->size++] = (char)(value >> 8 * i);
}
static void put_double(struct out *o, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, 8);
    put(o, bits, 8);
}

/* The same in COLMAP's binary form. Out: images, for tests to damage. */
static void write_binary(struct out *images)
{
    struct out cameras = { .size = 0 }, points = { .size = 0 };
    *images = (struct out){ .size = 0 };
    put(&cameras, CAMERA_MODEL_COUNT, 8);
    put(images, CAMERA_MODEL_COUNT, 8);
    for (int i = 0; i < CAMERA_MODEL_COUNT; i++) {
        put(&cameras, (uint64_t)i + 5, 4);
        put(&cameras, (uint64_t)i, 4);
        put(&cameras, (uint64_t)i + 2000, 8);
        put(&cameras, 1125, 8);
        for (int k = 0; k < camera_model_param_count((enum camera_model)i); k++) put_double(&cameras, figures[k]);
        put(images, 40 - (uint64_t)i, 4);
        for (int k = 0; k < 7; k++) put_double(images, pose[k] + (k == 4 ? i : 0));
        put(images, (uint64_t)i + 5, 4);
        for (const char *c = image_name(i);; c++) {
            put(images, (uint64_t)*c, 1);
            if (!*c) break;
        }
        put(images, i == 2 ? 0 : 2, 8);
        for (int k = 0; i != 2 && k < 2; k++) {
            put_double(images, keypoints[k][0]);
            put_double(images, keypoints[k][1]);
            put(images, k == 0 ? 7 : UINT64_MAX, 8);
        }
    }
    const struct { uint64_t id; double p[3], error; int track; } list[2] = {
        { 9, { 4.23702441385083, 1.9345664819046862, 5.3968618000775797 }, 0.25, 2 },
        { 7, { -0.48107892281846054, 1.0998580214005054, 5.4091984351370233 }, 0.75, 0 },
    };
    put(&points, 2, 8);
    for (int i = 0; i < 2; i++) {
        put(&points, list[i].id, 8);
        for (int k = 0; k < 3; k++) put_double(&points, list[i].p[k]);
        put(&points, 0x010203, 3);
        put_double(&points, list[i].error);
        put(&points, (uint64_t)list[i].track, 8);
        for (int k = 0; k < 2 * list[i].track; k++) put(&points, 40, 4);
    }
    scratch_put("cameras.bin", cameras.bytes, cameras.size);
    scratch_put("images.bin", images->bytes, images->size);
    scratch_put("points3D.bin", points.bytes, points.size);
}

static void is_as_written(const struct reconstruction *r, const char *form)
{
    if (!OK(r->camera_count == CAMERA_MODEL_COUNT && r->shot_count == CAMERA_MODEL_COUNT && r->point_count == 2,
            "%s: eleven cameras and images, two points", form))
        return;
    bool cameras = true, shots = true;
    for (int i = 0; i < CAMERA_MODEL_COUNT; i++) {
        const struct camera *c = &r->cameras[i].camera;
        double params[CAMERA_PARAMS_MAX] = { 0 };
        memcpy(params, figures, (size_t)camera_model_param_count((enum camera_model)i) * sizeof *params);
        cameras = cameras && c->model == (enum camera_model)i && c->width_px == 2000 + i && c->height_px == 1125 &&
                  !memcmp(c->params, params, sizeof params);
        int k = i < 3 ? i : i < 10 ? i + 1 : 3; /* by name the one with a blank comes last */
        const struct recon_shot *s = &r->shots[i];
        shots = shots && !strcmp(s->image, image_name(k)) && s->camera == (size_t)k &&
                s->camera_from_world_q.w == pose[0] && s->camera_from_world_q.x == pose[1] &&
                s->camera_from_world_q.y == pose[2] && s->camera_from_world_q.z == pose[3] &&
                s->camera_from_world_t.x == pose[4] + k && s->camera_from_world_t.z == pose[6];
    }
    OK(cameras, "%s: every lens with its size and parameters, to the last bit", form);
    OK(shots, "%s: every image with its pose and camera, to the last bit, by name", form);
    OK(r->points[0].x == -0.48107892281846054 && r->points[1].z == 5.3968618000775797, "%s: points by id, to the last bit", form);
    bool observations = r->observation_count == 10;
    for (size_t i = 0; observations && i < 10; i++)
        observations = r->observations[i].point == 0 && r->observations[i].shot == (i < 2 ? i : i + 1) &&
                       r->observations[i].q_px.x == keypoints[0][0] && r->observations[i].q_px.y == keypoints[0][1];
    OK(observations, "%s: keypoints of a point, and only they, are observations", form);
    OK(r->has_stated_error && r->stated_error_px == 0.5 && !r->is_enu, "%s: the stated error is the mean over the points", form);
}

static bool reads(struct reconstruction *r, const char *name, struct error *err)
{
    char *path = string_format("%s/%s", scratch, name);
    *err = ERROR_NONE;
    bool ok = colmap_read(r, path, err);
    free(path);
    return ok;
}

static void both_forms(void)
{
    struct reconstruction r;
    struct error err;
    struct out images;
    write_text();
    if (OK(reads(&r, "", &err), "text is read %s", err.text)) {
        is_as_written(&r, "text");
        reconstruction_release(&r);
    }
    write_binary(&images);
    if (OK(reads(&r, "images.bin", &err), "binary is read, by the file itself %s", err.text)) {
        is_as_written(&r, "binary");
        reconstruction_release(&r);
    }
    scratch_text("cameras.txt", "");
    if (OK(reads(&r, "", &err), "with both there, binary is read %s", err.text)) reconstruction_release(&r);

    size_t refused = 0;
    for (size_t size = 0; size < images.size; size++) {
        scratch_put("images.bin", images.bytes, size);
        if (reads(&r, "", &err)) {
            reconstruction_release(&r);
            printf("# %zu bytes were read as a whole model\n", size);
        } else
            refused += err.code == ERR_INPUT && strstr(err.file, "images.bin") != NULL;
    }
    OK(refused == images.size, "images.bin cut off at any of its %zu bytes is refused (%zu)", images.size, refused);
    scratch_put("images.bin", images.bytes, images.size + 1);
    OK(!reads(&r, "", &err) && strstr(err.text, "1 bytes follow the last image of 11"), "bytes too many are refused: %s",
       err.text);
    scratch_empty();
}

/* By hand: 5 px of one point; 0 and 1 px of another. */
static void errors_by_hand(void)
{
    struct reconstruction r;
    struct error err;
    scratch_text("cameras.txt", "1 SIMPLE_PINHOLE 100 100 100 50 50\n");
    scratch_text("images.txt", "1 1 0 0 0 0 0 0 1 a.jpg\n53 54 1 60 50 2\n2 1 0 0 0 0 0 0 1 b.jpg\n60 51 2\n");
    scratch_text("points3D.txt", "1 0 0 1 0 0 0 5\n2 0.1 0 1 0 0 0 0.5\n");
    if (!OK(reads(&r, "", &err), "a model by hand is read %s", err.text)) return;
    struct reprojection e = reconstruction_reprojection(&r);
    NEAR(e.rms_px, sqrt(26.0 / 3), 1e-12, "rms over the observations");
    NEAR(e.mean_px, 2, 1e-12, "mean over the observations");
    NEAR(e.point_mean_px, 2.75, 1e-12, "mean over the points of each one's mean");
    NEAR(e.point_mean_px, r.stated_error_px, 1e-12, "which is what COLMAP states");
    reconstruction_release(&r);
    scratch_text("points3D.txt", "1 0 0 -1 0 0 0 -1\n2 0.1 0 1 0 0 0 0.5\n");
    if (!OK(reads(&r, "", &err), "a point behind its camera is read %s", err.text)) return;
    OK(reconstruction_reprojection(&r).without_image == 1, "and has no reprojection error");
    OK(!r.has_stated_error, "an error of -1 is none");
    reconstruction_release(&r);
    scratch_empty();
}

#define CAMERA "1 SIMPLE_PINHOLE 100 100 100 50 50\n"
#define IMAGE "1 1 0 0 0 0 0 0 1 a.jpg\n53 54 1\n"
#define POINT "1 0 0 1 0 0 0 5 1 0\n"

static void bad_texts(void)
{
    static const struct { const char *what, *cameras, *images, *points, *error; } cases[] = {
        { "an unknown model", "1 PINHLE 100 100 100 50 50\n", IMAGE, POINT,
          "/cameras.txt:1:3: camera 1: unknown camera model \"PINHLE\": COLMAP's models SIMPLE_PINHOLE to THIN_PRISM_FISHEYE are understood" },
        { "a newer model", "# x\n1 RAD_TAN_THIN_PRISM_FISHEYE 100 100 1\n", IMAGE, POINT,
          "/cameras.txt:2:3: camera 1: unknown camera model \"RAD_TAN_THIN_PRISM_FISHEYE\": COLMAP's models SIMPLE_PINHOLE to THIN_PRISM_FISHEYE are understood" },
        { "too few parameters", "1 PINHOLE 100 100 100 50 50\n", IMAGE, POINT,
          "/cameras.txt:1:28: camera 1: PINHOLE has 4 parameters (fx, fy, cx, cy), and 3 are given" },
        { "too many parameters", "1 PINHOLE 100 100 100 50 50 50 0.1\n", IMAGE, POINT,
          "/cameras.txt:1:32: camera 1: PINHOLE has 4 parameters (fx, fy, cx, cy), and more are given" },
        { "a parameter that is no number", "1 SIMPLE_PINHOLE 100 100 100 5o 50\n", IMAGE, POINT,
          "/cameras.txt:1:30: a parameter is wanted, not \"5o\"" },
        { "a parameter that is not finite", "1 SIMPLE_PINHOLE 100 100 nan 50 50\n", IMAGE, POINT,
          "/cameras.txt:1:1: camera 1: parameter 1 is not finite" },
        { "a focal length of none", "1 SIMPLE_PINHOLE 100 100 0 50 50\n", IMAGE, POINT,
          "/cameras.txt:1:1: camera 1: the focal length must be above 0" },
        { "a size of none", "1 SIMPLE_PINHOLE 0 100 100 50 50\n", IMAGE, POINT,
          "/cameras.txt:1:1: camera 1: the size must be from 1 to 65535 px, not 0 x 100" },
        { "a camera twice", CAMERA CAMERA, IMAGE, POINT, "/cameras.txt:2:1: there are two cameras of the id 1" },
        { "an image of no camera", CAMERA, "1 1 0 0 0 0 0 0 2 a.jpg\n\n", POINT,
          "/images.txt:1:1: image \"a.jpg\" is of camera 2, and cameras.txt has none of that id" },
        { "an image that sees no point", CAMERA, "1 1 0 0 0 0 0 0 1 a.jpg\n53 54 8\n", POINT,
          "/images.txt:2:1: image \"a.jpg\" sees point 8, and points3D.txt has none of that id" },
        { "an image twice", CAMERA, IMAGE IMAGE, POINT, "/images.txt:3:1: there are two images \"a.jpg\"" },
        { "no images", CAMERA, "# Image list\n", POINT, "/images.txt: holds no image with a pose" },
        { "a pose cut off", CAMERA, "1 1 0 0 0 0 0", POINT, "/images.txt:1:14: the line ends, and TZ is wanted" },
        { "an image without its second line", CAMERA, "1 1 0 0 0 0 0 0 1 a.jpg\n", POINT,
          "/images.txt:1:19: image \"a.jpg\": its second line, that of the keypoints, is missing: the file is cut off" },
        { "keypoints cut off", CAMERA, "1 1 0 0 0 0 0 0 1 a.jpg\n53 54 1 60", POINT,
          "/images.txt:2:11: the line ends, and y of a keypoint is wanted" },
        { "a turn of none", CAMERA, "1 0 0 0 0 0 0 0 1 a.jpg\n\n", POINT,
          "/images.txt:1:1: image \"a.jpg\": the quaternion is no rotation" },
        { "a point cut off", CAMERA, IMAGE, "1 0 0 1 0 0 0 5 1", "/points3D.txt:1:18: the line ends, and a keypoint's index is wanted" },
        { "a point twice", CAMERA, IMAGE, POINT POINT, "/points3D.txt:2:1: there are two points of the id 1" },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct reconstruction r;
        struct error err;
        scratch_text("cameras.txt", cases[i].cameras);
        scratch_text("images.txt", cases[i].images);
        scratch_text("points3D.txt", cases[i].points);
        bool read = reads(&r, "", &err);
        if (!OK(!read && !strcmp(scratch_error(&err), cases[i].error), "refuses %s", cases[i].what))
            printf("# %s\n", scratch_error(&err));
        if (read) reconstruction_release(&r);
    }
    scratch_empty();
}

static void bad_binaries(void)
{
    struct reconstruction r;
    struct error err;
    struct out images, camera = { .size = 0 };
    write_binary(&images);
    put(&camera, 1, 8);
    put(&camera, 5, 4);
    put(&camera, 11, 4);
    put(&camera, 2000, 8);
    put(&camera, 1125, 8);
    for (int i = 0; i < 16; i++) put_double(&camera, 1);
    scratch_put("cameras.bin", camera.bytes, camera.size);
    OK(!reads(&r, "", &err) && !strcmp(scratch_error(&err), "/cameras.bin: byte 12: camera 5: unknown camera model 11 (RAD_TAN_THIN_PRISM_FISHEYE): "
                                       "the models 0 (SIMPLE_PINHOLE) to 10 (THIN_PRISM_FISHEYE) are understood"),
       "a newer model is refused by name: %s", scratch_error(&err));
    memset(camera.bytes + 12, 0xff, 4);
    scratch_put("cameras.bin", camera.bytes, camera.size);
    OK(!reads(&r, "", &err) && strstr(err.text, "unknown camera model -1:"), "and so is COLMAP's -1 for no model");
    memset(images.bytes, 0xff, 6);
    write_binary(&(struct out){ .size = 0 });
    scratch_put("images.bin", images.bytes, images.size);
    OK(!reads(&r, "", &err) && strstr(err.text, "byte 0: tells of 281474976710655 images, but only"),
       "a count beyond the file is refused before memory is asked for: %s", scratch_error(&err));
    scratch_empty();
    OK(!reads(&r, "", &err) && strstr(err.text, "holds none of these: images.bin, images.txt"), "an empty folder is refused");
    OK(!reads(&r, "none", &err) && !strcmp(scratch_error(&err), "/none: is not there"), "a folder that is not there is refused");
    scratch_text("images.bin", "");
    OK(!reads(&r, "", &err) && strstr(err.file, "cameras.bin") && strstr(err.text, "cannot be opened"),
       "images without cameras are refused");
    scratch_empty();
}

int main(void)
{
    if (!mkdtemp(scratch)) return 1;
    both_forms();
    errors_by_hand();
    bad_texts();
    bad_binaries();
    rmdir(scratch);
    return tap_done();
}
