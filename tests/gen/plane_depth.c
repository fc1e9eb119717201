/* The depth of a ground plane, against rays by hand. */
#include "gen/trace/plane_depth.h"

#include "tests/tap.h"

int main(void)
{
    struct error err = ERROR_NONE;
    struct image depth;
    /* 12 m above z = 2, looking north and level: row v sees the plane at depth 12 f / (v + 0.5 - cy). */
    const struct camera pinhole = { .model = CAMERA_PINHOLE, .width_px = 40, .height_px = 60, .params = { 50, 80, 20, 21 } };
    const struct pose level = { mat3_from_columns(vec3(1, 0, 0), vec3(0, 0, -1), vec3(0, 1, 0)), { 5, 6, 14 } };
    const struct plane ground = { { 0, 0, 1 }, 2 };
    if (OK(plane_depth(&depth, &ground, &pinhole, level, &err), "a level camera %s", err.text)) {
        double worst = 0;
        int above = 0;
        for (int y = 0; y < 60; y++)
            for (int x = 0; x < 40; x++) {
                double z = (double)*image_f32(&depth, x, y);
                if (y < 21) above += isnan(z);
                else worst = fmax(worst, fabs(z / (12 * 80 / (y + 0.5 - 21)) - 1));
            }
        OK(above == 21 * 40, "above the horizon nothing is known");
        NEAR(worst, 0, 1e-6, "below it depth is height times focal length over rows");
        image_release(&depth);
    }
    /* A slope through a lens: every pixel's point lies on the plane. */
    const struct camera lens = { .model = CAMERA_OPENCV, .width_px = 64, .height_px = 48,
                                 .params = { 60, 61, 31, 25, -0.08, 0.02, 0.002, -0.001 } };
    struct vec3 ahead = vec3_unit(vec3(0.2, 0.5, -0.8)), right = vec3_unit(vec3_cross(ahead, vec3(0, 0, 1)));
    const struct pose tilted = { mat3_from_columns(right, vec3_cross(ahead, right), ahead), { -3, 2, 20 } };
    const struct plane slope = { vec3_unit(vec3(0.1, -0.05, 1)), 1 };
    if (OK(plane_depth(&depth, &slope, &lens, tilted, &err), "a tilted camera with a lens %s", err.text)) {
        double off = 0, back = 0;
        int known = 0;
        for (int y = 0; y < 48; y++)
            for (int x = 0; x < 64; x++) {
                double z = (double)*image_f32(&depth, x, y);
                struct vec3 ray;
                struct vec2 q;
                if (isnan(z) || !camera_unproject(&lens, &ray, (struct vec2){ x + 0.5, y + 0.5 }, &err)) continue;
                struct vec3 p = vec3_scale(ray, z / ray.z);
                known++;
                off = fmax(off, fabs(vec3_dot(slope.normal, pose_apply(tilted, p)) - slope.offset_m));
                if (camera_project(&lens, &q, p, &err)) back = fmax(back, hypot(q.x - x - 0.5, q.y - y - 0.5));
            }
        OK(known == 64 * 48, "the whole picture shows the ground");
        NEAR(off, 0, 1e-5, "each pixel's point lies on the plane, m");
        NEAR(back, 0, 1e-4, "and is seen by that pixel, px");
        image_release(&depth);
    }
    const struct pose up = { mat3_from_columns(vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1)), { 0, 0, 5 } };
    if (OK(plane_depth(&depth, &ground, &pinhole, up, &err), "a camera that looks up")) {
        int known = 0;
        for (int i = 0; i < 40 * 60; i++) known += !isnan(((float *)depth.data)[i]);
        OK(known == 0, "sees no ground");
        image_release(&depth);
    }
    return tap_done();
}
