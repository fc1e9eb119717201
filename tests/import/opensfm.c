#include "import/reconstruction.h"

#include "tests/import/refusals.h"
#include "tests/import/scratch.h"

/* A point at (3, 4, 1), seen through each lens by a camera that is turned by (1.7, 0.3, -0.4). Where it is seen was
 * worked out with OpenCV 4.6 (cv::Rodrigues, projectPoints, fisheye::projectPoints) with
 * K = [[focal_x 640, 0, c_x 640 + 319.5], [0, focal_y 640, c_y 640 + 239.5], [0, 0, 1]], plus half a pixel. */
#define SHOTS                                                                                          \
    "\"shots\": {\"b.jpg\": {\"rotation\": [1.7, 0.3, -0.4], \"translation\": [1.5, -2, 9], \"camera\": \"c\"}," \
    " \"a.jpg\": {\"rotation\": [0, 0, 0], \"translation\": [0, 0, 0], \"camera\": \"c\", \"orientation\": 1}}," \
    " \"points\": {\"1\": {\"coordinates\": [3, 4, 1], \"color\": [0, 0, 0]}}"
#define CAMERA(type, rest) "\"cameras\": {\"c\": {\"projection_type\": \"" type "\", \"width\": 640, \"height\": 480, " rest "}}"
#define TWO "\"focal_x\": 0.85, \"focal_y\": 0.86, \"c_x\": 0.012, \"c_y\": -0.007, \"k1\": -0.05"

static bool reads(struct reconstruction *r, const char *json, struct error *err)
{
    scratch_text("reconstruction.json", json);
    *err = ERROR_NONE;
    return opensfm_read(r, scratch, err);
}

static void lenses(void)
{
    static const struct { const char *projection, *json; enum camera_model model; double x_px, y_px; } cases[] = {
        { "perspective", "[{" CAMERA("perspective", "\"focal\": 0.8, \"k1\": -0.05, \"k2\": 0.02") ", " SHOTS "}]",
          CAMERA_RADIAL, 581.052186798, 71.796060600 },
        { "fisheye", "[{" CAMERA("fisheye", "\"focal\": 0.8, \"k1\": -0.05, \"k2\": 0.02") ", " SHOTS "}]",
          CAMERA_RADIAL_FISHEYE, 554.584190508, 88.850203293 },
        { "simple_radial", "[{" CAMERA("simple_radial", TWO) ", " SHOTS "}]", CAMERA_OPENCV, 604.233613704, 55.231638992 },
        { "radial", "[{" CAMERA("radial", TWO ", \"k2\": 0.02") ", " SHOTS "}]", CAMERA_OPENCV, 605.047948473, 54.700765145 },
        { "brown", "[{" CAMERA("brown", TWO ", \"k2\": 0.02, \"k3\": 0.003, \"p1\": 0.001, \"p2\": -0.002") ", " SHOTS "}]",
          CAMERA_FULL_OPENCV, 603.908259538, 55.383360291 },
        { "brown without k3", "[{" CAMERA("brown", TWO ", \"k2\": 0.02") ", " SHOTS "}]", CAMERA_OPENCV, 605.047948473, 54.700765145 },
        { "fisheye_opencv", "[{" CAMERA("fisheye_opencv", TWO ", \"k2\": 0.02, \"k3\": 0.003, \"k4\": -0.001") ", " SHOTS "}]",
          CAMERA_OPENCV_FISHEYE, 576.945055435, 73.021352092 },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct reconstruction r;
        struct error err;
        struct vec2 q = { NAN, NAN };
        if (!OK(reads(&r, cases[i].json, &err), "%s: is read %s", cases[i].projection, err.text)) continue;
        OK(r.cameras[0].camera.model == cases[i].model, "%s: as %s", cases[i].projection, camera_model_name(cases[i].model));
        const struct recon_shot *s = &r.shots[1];
        struct pose pose = { mat3_from_quat(s->camera_from_world_q), s->camera_from_world_t };
        camera_project(&r.cameras[s->camera].camera, &q, pose_apply(pose, r.points[0]), &err);
        NEAR(hypot(q.x - cases[i].x_px, q.y - cases[i].y_px), 0, 1e-6, "%s: a point is seen where OpenCV sees it", cases[i].projection);
        reconstruction_release(&r);
    }
}

static void world(void)
{
    struct reconstruction r;
    struct error err;
    const char *const camera = CAMERA("perspective", "\"focal\": 0.8, \"k1\": 0, \"k2\": 0");
    char *json = string_format("[{%s, " SHOTS ", \"reference_lla\": {\"latitude\": 46.8, \"longitude\": -92, \"altitude\": 12.5}}]", camera);
    if (OK(reads(&r, json, &err), "a reference is read %s", err.text)) {
        OK(r.is_enu && r.reference_lat_lon_h[0] == 46.8 && r.reference_lat_lon_h[1] == -92 && r.reference_lat_lon_h[2] == 12.5,
           "with a reference the world is east, north, up");
        OK(!strcmp(r.shots[0].image, "a.jpg") && r.shots[0].camera_from_world_q.w == 1, "shots by name; no turn is a turn by 0");
        reconstruction_release(&r);
    }
    free(json);
    json = string_format("[{%s, " SHOTS ", \"reference_lla\": {\"latitude\": 0.0, \"longitude\": 0.0, \"altitude\": 0.0}}]", camera);
    if (OK(reads(&r, json, &err), "a reference of zeros is read %s", err.text)) {
        OK(!r.is_enu, "a reference of zeros is none");
        reconstruction_release(&r);
    }
    free(json);
    json = string_format("[{%s, \"shots\": {\"z.jpg\": {}}}, {%s, " SHOTS "}]", camera, camera);
    if (OK(reads(&r, json, &err), "parts are read %s", err.text)) {
        OK(r.shot_count == 2 && r.left_out_count == 1, "the largest part counts, and what is left out is told");
        reconstruction_release(&r);
    }
    free(json);
}

static void bad_files(void)
{
    static const struct bad_file cases[] = {
        { "a file cut off", "[\n{\"cameras\": {", "/reconstruction.json:2:13: string or '}' expected near end of file" },
        { "another kind of file", "{}", "/reconstruction.json:1:1: must be an array" },
        { "no reconstruction", "[]", "/reconstruction.json: holds no reconstruction" },
        { "no shots", "[{" CAMERA("perspective", "\"focal\": 0.8") ", \"shots\": {}}]", "/reconstruction.json: holds no image with a pose" },
        { "no cameras", "[{" SHOTS "}]", "/reconstruction.json: \"cameras\" is missing" },
        { "an unknown lens", "[{" CAMERA("spherical", "\"focal\": 0.8") ", " SHOTS "}]",
          "/reconstruction.json: camera \"c\": \"projection_type\" is \"spherical\", an unknown camera model: perspective, brown, "
          "radial, simple_radial, fisheye and fisheye_opencv are understood" },
        { "no focal length", "[{" CAMERA("brown", "\"focal\": 0.8") ", " SHOTS "}]", "/reconstruction.json: camera \"c\": \"focal_x\" is missing" },
        { "a shot of no camera",
          "[{" CAMERA("perspective", "\"focal\": 0.8") ", \"shots\": {\"a.jpg\": {\"rotation\": [0, 0, 0], \"translation\": [0, 0, 0], \"camera\": \"d\"}}}]",
          "/reconstruction.json: shot \"a.jpg\": \"camera\" is \"d\", and there is none of that name" },
        { "a shot without a turn", "[{" CAMERA("perspective", "\"focal\": 0.8") ", \"shots\": {\"a.jpg\": {\"translation\": [0, 0, 0], \"camera\": \"c\"}}}]",
          "/reconstruction.json: shot \"a.jpg\": \"rotation\" is missing" },
    };
    refuses(cases, sizeof cases / sizeof *cases, reads);
}

int main(void)
{
    if (!mkdtemp(scratch)) return 1;
    lenses();
    world();
    bad_files();
    scratch_empty();
    rmdir(scratch);
    return tap_done();
}
