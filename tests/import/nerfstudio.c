#include "import/reconstruction.h"

#include "tests/import/refusals.h"
#include "tests/import/scratch.h"

/* A camera at (1, 2, 3) of the applied world, turned by the rotation vector (0.3, -0.2, 0.9), and a point at
 * (4.5, 0.7, 3.5) of the world before applied_transform. Where it is seen was worked out with OpenCV 4.6
 * (cv::Rodrigues, projectPoints, fisheye::projectPoints) from the definitions: p_applied = T p, and OpenCV's y and z
 * are OpenGL's turned round; with cx, cy less half a pixel, plus half a pixel. */
#define MATRIX                                                                                          \
    "[[0.60726585602429672, -0.79320301152491568, -0.045355954569191323, 1],"                            \
    " [0.73775819119893404, 0.58416384755513762, -0.33832743094294743, 2],"                              \
    " [0.29485764603610864, 0.17199296996500252, 0.93993477798018643, 3], [0, 0, 0, 1]]"
#define APPLIED "\"applied_transform\": [[0, 1, 0, 0.5], [1, 0, 0, -0.25], [0, 0, -1, 2]]"
#define LENS "\"w\": 800, \"h\": 600, \"fl_x\": 700, \"fl_y\": 690, \"cx\": 401.5, \"cy\": 299"
#define FRAMES "\"frames\": [{\"file_path\": \"./images/a.jpg\", \"transform_matrix\": " MATRIX "}]"
static const struct vec3 point = { 4.5, 0.7, 3.5 };

static bool reads(struct reconstruction *r, const char *json, struct error *err)
{
    scratch_text("transforms.json", json);
    *err = ERROR_NONE;
    return nerfstudio_read(r, scratch, err);
}

static struct vec2 seen(const struct reconstruction *r, size_t shot, struct error *err)
{
    const struct recon_shot *s = &r->shots[shot];
    struct pose pose = { mat3_from_quat(s->camera_from_world_q), s->camera_from_world_t };
    struct vec2 q = { NAN, NAN };
    camera_project(&r->cameras[s->camera].camera, &q, pose_apply(pose, point), err);
    return q;
}

static void lenses(void)
{
    static const struct { const char *what, *json; enum camera_model model; double x_px, y_px; } cases[] = {
        { "OPENCV", "{\"camera_model\": \"OPENCV\", " LENS ", \"k1\": 0.1, \"k2\": -0.03, \"k3\": 0.01, \"p1\": 0.002, \"p2\": -0.001, "
          APPLIED ", " FRAMES "}", CAMERA_FULL_OPENCV, 465.185215559, 246.288493657 },
        { "PINHOLE", "{\"camera_model\": \"PINHOLE\", " LENS ", " APPLIED ", " FRAMES "}", CAMERA_PINHOLE, 465.136773774, 246.317314647 },
        { "OPENCV_FISHEYE", "{\"camera_model\": \"OPENCV_FISHEYE\", " LENS ", \"k1\": 0.1, \"k2\": -0.03, \"k3\": 0.01, \"k4\": 0.004, "
          APPLIED ", " FRAMES "}", CAMERA_OPENCV_FISHEYE, 464.928382194, 246.489834833 },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct reconstruction r;
        struct error err;
        if (!OK(reads(&r, cases[i].json, &err), "%s: is read %s", cases[i].what, err.text)) continue;
        OK(r.cameras[0].camera.model == cases[i].model && !strcmp(r.shots[0].image, "images/a.jpg"), "%s: as %s", cases[i].what,
           camera_model_name(cases[i].model));
        struct vec2 q = seen(&r, 0, &err);
        NEAR(hypot(q.x - cases[i].x_px, q.y - cases[i].y_px), 0, 1e-6, "%s: a point is seen where OpenCV sees it", cases[i].what);
        reconstruction_release(&r);
    }
}

/* Frame 2 has a camera of its own with twice the figures; frame 3 has frame 1's. */
static void cameras_by_frame(void)
{
    struct reconstruction r;
    struct error err;
    const char *const json =
        "{" LENS ", " APPLIED ", \"frames\": [{\"file_path\": \"a.jpg\", \"transform_matrix\": " MATRIX "},"
        " {\"file_path\": \"b.jpg\", \"transform_matrix\": " MATRIX ", \"w\": 1600, \"h\": 1200.0, \"fl_x\": 1400, \"fl_y\": 1380,"
        " \"cx\": 803, \"cy\": 598}, {\"file_path\": \"c.jpg\", \"transform_matrix\": " MATRIX "}]}";
    if (!OK(reads(&r, json, &err), "cameras of single frames are read %s", err.text)) return;
    OK(r.camera_count == 2 && r.shots[0].camera == 0 && r.shots[1].camera == 1 && r.shots[2].camera == 0, "cameras that are alike are one");
    OK(r.cameras[1].camera.width_px == 1600 && r.cameras[1].camera.height_px == 1200, "a frame's own size");
    struct vec2 q = seen(&r, 0, &err), twice = seen(&r, 1, &err);
    NEAR(hypot(twice.x - 2 * q.x, twice.y - 2 * q.y), 0, 1e-9, "twice the figures, twice the picture");
    reconstruction_release(&r);
}

static void bad_files(void)
{
    static const struct bad_file cases[] = {
        { "a file cut off", "{\"w\": 800,\n", "/transforms.json:2:1: string or '}' expected near end of file" },
        { "no frames", "{" LENS "}", "/transforms.json: \"frames\" is missing" },
        { "an empty list of frames", "{" LENS ", \"frames\": []}", "/transforms.json: holds no image with a pose" },
        { "a frame without its matrix", "{" LENS ", \"frames\": [{\"file_path\": \"a.jpg\"}]}",
          "/transforms.json: frame 1: \"transform_matrix\" is missing" },
        { "a matrix that is none", "{" LENS ", \"frames\": [{\"file_path\": \"a.jpg\", \"transform_matrix\": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1]]}]}",
          "/transforms.json: frame 1: \"transform_matrix\" must be 4 rows of 4 numbers" },
        { "a matrix that is no rotation", "{" LENS ", \"frames\": [{\"file_path\": \"a.jpg\", \"transform_matrix\": [[2, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]}]}",
          "/transforms.json: frame 1: \"transform_matrix\" must hold a rotation; its rows are off by 3" },
        { "a matrix that mirrors", "{" LENS ", \"frames\": [{\"file_path\": \"a.jpg\", \"transform_matrix\": [[-1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]}]}",
          "/transforms.json: frame 1: \"transform_matrix\" must hold a rotation; its rows are off by 0 and mirror" },
        { "an image twice", "{" LENS ", \"frames\": [{\"file_path\": \"a.jpg\", \"transform_matrix\": " MATRIX "}, {\"file_path\": \"a.jpg\", \"transform_matrix\": " MATRIX "}]}",
          "/transforms.json: has two poses of the image \"a.jpg\"" },
        { "no size", "{\"fl_x\": 700, \"cx\": 400, \"cy\": 300, " FRAMES "}", "/transforms.json: frame 1: \"w\" is missing" },
        { "an unknown lens", "{\"camera_model\": \"EQUIRECTANGULAR\", " LENS ", " FRAMES "}",
          "/transforms.json: frame 1: \"camera_model\" is \"EQUIRECTANGULAR\", an unknown camera model: OPENCV, OPENCV_FISHEYE, PINHOLE, "
          "SIMPLE_PINHOLE, RADIAL and SIMPLE_RADIAL are understood" },
        { "a coefficient that no model has", "{" LENS ", \"k4\": 0.1, " FRAMES "}",
          "/transforms.json: frame 1: \"k4\" is not 0, and of perspective lenses k1 to k3 are understood" },
        { "a scale that was applied", "{" LENS ", \"applied_scale\": 0.5, " FRAMES "}", "/transforms.json: \"applied_scale\" is 0.5, and only 1 is understood" },
    };
    refuses(cases, sizeof cases / sizeof *cases, reads);
}

int main(void)
{
    if (!mkdtemp(scratch)) return 1;
    lenses();
    cameras_by_frame();
    bad_files();
    scratch_empty();
    rmdir(scratch);
    return tap_done();
}
