/* How things move in the picture while the shutter is open. */
#include "gen/trace/motion.h"

#include "tests/gen/place.h"
#include "tests/gen/solid.h"
#include "tests/tap.h"

static const struct pose level = { { { { 1, 0, 0 }, { 0, 0, 1 }, { 0, -1, 0 } } }, { 0, 0, 1 } };
static const struct plane flat = { { 0, 0, 1 }, 0 };
static const struct camera pinhole = { CAMERA_PINHOLE, 320, 240, { 400, 400, 160, 120 } };
static const struct camera lens = { CAMERA_OPENCV, 320, 240, { 400, 390, 155, 125, -0.25, 0.05, 0.002, -0.003 } };

/* x of the entity at `turn_rad` from east, counter-clockwise. */
static struct pose turned(double turn_rad, double x, double y, double z)
{
    double c = cos(turn_rad), s = sin(turn_rad);
    return (struct pose){ { { { c, -s, 0 }, { s, c, 0 }, { 0, 0, 1 } } }, { x, y, z } };
}

struct moved {
    struct frame_labels labels;
    struct image motion;
    struct static_mesh *mesh;
};

/* In: receiver k is that of entity k. */
static bool move(struct moved *out, struct trace_input in, const struct place *place, struct motion_input how)
{
    struct error err = ERROR_NONE;
    const struct model *models[4];
    struct tracer *tracer = NULL;
    static const size_t owner[4] = { 0, 1, 2, 3 };
    memset(out, 0, sizeof *out);
    for (size_t i = 0; i < in.entity_count; i++) models[i] = in.entities[i].model;
    bool ok = tracer_create(&tracer, models, in.entity_count, &err) && (!place || place_mesh(&out->mesh, place, false, &err));
    in.place = out->mesh;
    ok = ok && trace_frame(&out->labels, tracer, &in, &err) &&
         motion_trace(&out->motion, &in, owner, &out->labels, &how, &err);
    if (!ok) printf("# %s\n", err.text);
    tracer_destroy(tracer);
    return ok;
}

static void moved_release(struct moved *m)
{
    frame_labels_release(&m->labels);
    image_release(&m->motion);
    static_mesh_destroy(m->mesh);
}

static bool is_near(const struct image *motion, int x, int y, double u, double v, double tolerance)
{
    const float *m = image_f32(motion, x, y);
    return fabs((double)m[0] - u) <= tolerance && fabs((double)m[1] - v) <= tolerance && m[2] == 0;
}

/* A plate of 80 x 80 pixels, 10 m ahead, 40 px a metre. */
static void plate_aside(void)
{
    struct solid plate;
    solid_plate(&plate, 2, 2);
    struct entity e = { .id = 7, .name = "plate", .model = &plate.model, .world_from_entity = turned(-M_PI / 2, 0, 10, 0) };
    struct pose opening = turned(-M_PI / 2, -0.1, 10, 0), closing = turned(-M_PI / 2, 0.15, 10, 0.05);
    struct trace_input in = { .camera = &pinhole, .world_from_camera = level, .entities = &e, .entity_count = 1, .ground = &flat };
    struct moved m;
    OK(move(&m, in, NULL, (struct motion_input){ level, level, &opening, &closing }), "a plate that moves aside and up");
    int wrong = 0;
    for (int y = 0; y < 240; y++)
        for (int x = 0; x < 320; x++) {
            bool near = x >= 118 && x < 202 && y >= 78 && y < 162;
            wrong += !is_near(&m.motion, x, y, near ? 10 : 0, near ? -2 : 0, 1e-4);
        }
    OK(wrong == 0, "10 px right and 2 px up, there and 2 px round it, and nothing elsewhere (%d wrong)", wrong);
    moved_release(&m);

    /* The camera goes 0.2 m ahead: what is at radius r moves out by r 10 / 9.9 - r 10 / 10.1. */
    struct pose back = level, ahead = level;
    back.translation.y = -0.1;
    ahead.translation.y = 0.1;
    struct pose still = e.world_from_entity;
    OK(move(&m, in, NULL, (struct motion_input){ back, ahead, &still, &still }), "a camera that goes ahead");
    wrong = 0;
    for (int y = 80; y < 160; y++)
        for (int x = 120; x < 200; x++) {
            double grows = 10 / 9.9 - 10 / 10.1;
            wrong += !is_near(&m.motion, x, y, (x + 0.5 - 160) * grows, (y + 0.5 - 120) * grows, 1e-4);
        }
    OK(wrong == 0, "the plate grows (%d wrong)", wrong);
    moved_release(&m);

    /* It turns about its upright axis by 0.2 rad: what is w to the right of it is at w cos t, nearer or farther by w sin t. */
    struct pose left = turned(-M_PI / 2 - 0.1, 0, 10, 0), right = turned(-M_PI / 2 + 0.1, 0, 10, 0);
    OK(move(&m, in, NULL, (struct motion_input){ level, level, &left, &right }), "a plate that turns");
    wrong = 0;
    for (int y = 80; y < 160; y++)
        for (int x = 120; x < 200; x++) {
            double w = (x + 0.5 - 160) / 40, h = (y + 0.5 - 120) * 10, c = w * cos(0.1), s = w * sin(0.1);
            wrong += !is_near(&m.motion, x, y, 400 * c / (10 + s) - 400 * c / (10 - s), h / (10 + s) - h / (10 - s), 1e-3);
        }
    OK(wrong == 0, "about its own axis (%d wrong)", wrong);
    moved_release(&m);
    solid_free(&plate);
}

/* All of it at once through a lens, against finite differences: the way of the seen point, from its speed. */
static void everything_moves(void)
{
    struct solid egg;
    solid_egg(&egg, 4, 2, 1.5, 24);
    struct entity e = { .id = 7, .name = "egg", .model = &egg.model, .world_from_entity = turned(0.6, 0.5, 9, 0) };
    const double T = 1e-3, turn = 0.8, spin = 0.3;
    const struct vec3 speed = { 6, -4, 0.5 }, flight = { -2, 3, 1 };
    struct pose opening = turned(0.6 - turn * T / 2, 0.5 - speed.x * T / 2, 9 - speed.y * T / 2, -speed.z * T / 2),
                closing = turned(0.6 + turn * T / 2, 0.5 + speed.x * T / 2, 9 + speed.y * T / 2, speed.z * T / 2), eye[2];
    for (int end = 0; end < 2; end++) {
        double t = end ? T / 2 : -T / 2;
        eye[end] = pose_compose(turned(spin * t, 0, 0, 0), level);
        eye[end].translation = vec3_add(level.translation, vec3_scale(flight, t));
    }
    struct trace_input in = { .camera = &lens, .world_from_camera = level, .entities = &e, .entity_count = 1, .ground = &flat };
    struct moved m;
    OK(move(&m, in, NULL, (struct motion_input){ eye[0], eye[1], &opening, &closing }), "lens, camera and entity move");
    double worst = 0, most = 0;
    int n = 0;
    for (int y = 0; y < 240; y++)
        for (int x = 0; x < 320; x++) {
            if (*image_u16(&m.labels.instance, x, y) != 7) continue;
            struct error err = ERROR_NONE;
            struct vec3 d, p;
            struct vec2 q[2];
            camera_unproject(&lens, &d, (struct vec2){ x + 0.5, y + 0.5 }, &err);
            p = pose_apply(level, vec3_scale(d, (double)*image_f32(&m.labels.depth, x, y) / d.z));
            /* speed of the point: that of the entity and its turning; in a camera that flies and spins less so */
            struct vec3 arm = vec3_sub(p, e.world_from_entity.translation), from_eye = vec3_sub(p, level.translation);
            struct vec3 v = vec3_add(speed, vec3(-turn * arm.y, turn * arm.x, 0));
            v = vec3_sub(vec3_sub(v, flight), vec3(-spin * from_eye.y, spin * from_eye.x, 0));
            for (int end = 0; end < 2; end++) {
                double h = end ? 1e-5 : -1e-5;
                struct vec3 at = pose_apply(pose_inverse(level), vec3_add(p, vec3_scale(v, h)));
                camera_project(&lens, &q[end], at, &err);
            }
            double u = (q[1].x - q[0].x) / 2e-5 * T, w = (q[1].y - q[0].y) / 2e-5 * T;
            const float *got = image_f32(&m.motion, x, y);
            worst = fmax(worst, hypot((double)got[0] - u, (double)got[1] - w));
            most = fmax(most, hypot(u, w));
            n++;
        }
    OK(n > 2000 && most > 0.3 && worst < 1e-4 * most, "%d points move as their speed says, to %.1e of %.2f px", n, worst, most);
    moved_release(&m);
    solid_free(&egg);
}

/* Shade on the ground goes with its entity, in the picture of a camera that moves as well. */
static void shade(bool with_mesh)
{
    struct solid box;
    solid_box(&box, 1, 1, 1);
    struct entity e[2] = {
        { .id = 3, .name = "left", .model = &box.model, .world_from_entity = turned(0, -2, 9, 0) },
        { .id = 4, .name = "right", .model = &box.model, .world_from_entity = turned(0, 2, 9, 0) },
    };
    static const struct vec2 left[4] = { { -4, 5 }, { 1, 5 }, { 1, 11 }, { -4, 11 } },
                             right[4] = { { -1, 5 }, { 4, 5 }, { 4, 11 }, { -1, 11 } };
    struct prism prisms[2] = { { left, 4, 0, { 0, 0, 1 }, -0.5, 0.5 }, { right, 4, 0, { 0, 0, 1 }, -0.5, 0.5 } };
    struct pose opening[2] = { turned(0.3, -2.05, 8.9, 0), turned(0, 2.1, 9, 0) },
                closing[2] = { turned(0.5, -1.95, 9.1, 0), turned(0, 1.9, 9, 0) };
    struct pose eye[2] = { level, level };
    eye[0].translation.x = -0.05;
    eye[1].translation.x = 0.05;
    static const struct vec2 outline[4] = { { 0, 0 }, { 320, 0 }, { 320, 150 }, { 0, 150 } };
    struct occluder hedge = { "hedge", outline, 4, { 0, 1, 0 } };
    struct trace_input in = { .camera = &pinhole, .world_from_camera = level, .entities = e, .entity_count = 2,
                              .ground = with_mesh ? NULL : &flat, .receivers = prisms, .receiver_count = 2 };
    struct place ground = { 0 };
    place_ground(&ground, 0, 0);
    struct moved m;
    OK(move(&m, in, with_mesh ? &ground : NULL, (struct motion_input){ eye[0], eye[1], opening, closing }),
       with_mesh ? "shade on the place" : "shade on the ground");
    int wrong = 0, n = 0;
    for (int y = 122; y < 240; y++)
        for (int x = 0; x < 320; x++) {
            double below = y + 0.5 - 120, gy = 400 / below, gx = (x + 0.5 - 160) / below, border = 0.05;
            bool entity = false;
            for (int v = y - 2; v <= y + 2 && v < 240; v++)
                for (int u = x > 2 ? x - 2 : 0; u <= x + 2 && u < 320; u++) entity = entity || *image_u16(&m.labels.instance, u, v);
            bool in_y = gy > 5 && gy < 11, outside = gy < 5 - border || gy > 11 + border || fabs(gx) > 4 + border;
            if (entity || fabs(gx) < border) continue;
            if (outside)
                wrong += !is_near(&m.motion, x, y, 0, 0, 0);
            else if (in_y && fabs(gx) < 4 - border) {
                /* the nearer entity's way over the ground, seen from the camera at both ends */
                struct vec2 way = gx < 0 ? (struct vec2){ 0.1, 0.2 } : (struct vec2){ -0.2, 0 };
                double y0 = gy - way.y / 2, y1 = gy + way.y / 2;
                wrong += !is_near(&m.motion, x, y, 400 * (gx + way.x / 2 - 0.05) / y1 - 400 * (gx - way.x / 2 + 0.05) / y0,
                                  400 / y1 - 400 / y0, 1e-3);
                n++;
            }
        }
    OK(wrong == 0 && n > 2000, "goes with the nearer entity, and nothing moves outside (%d of %d wrong)", wrong, n);
    moved_release(&m);

    in.occluders = &hedge;
    in.occluder_count = 1;
    OK(move(&m, in, with_mesh ? &ground : NULL, (struct motion_input){ eye[0], eye[1], opening, closing }) &&
           is_near(&m.motion, 160, 159, 0, 0, 0) == false,
       "with a hedge down to row 150");
    wrong = 0;
    for (int y = 0; y < 148; y++)
        for (int x = 0; x < 320; x++) wrong += !is_near(&m.motion, x, y, 0, 0, 0);
    OK(wrong == 0, "what is hidden of shade and entity does not move (%d wrong)", wrong);
    moved_release(&m);
    place_free(&ground);
    solid_free(&box);
}

int main(void)
{
    plate_aside();
    everything_moves();
    shade(false);
    shade(true);
    return tap_done();
}
