#include "influence.h"

#include "write_pov.h"

#include <string.h>

#define REACH_M 1.5
#define GROUND_M 0.2 /* the top of what counts as ground; kerbs have 0.12 */
enum { EDGE_PX = 2 }; /* beside entities, where a pixel's middle sees past them */

/* Parked cars of street.inc, and what of the ground beside them is as good as below them. */
static const double parked_m[][2] = { { -1.7, -4.6 }, { 9.4, -4.6 }, { 20.6, -4.65 }, { -14, -4.6 } };
#define PARKED_HALF_LENGTH_M 2.6
#define PARKED_HALF_WIDTH_M 1.25

static double distance_to_entity(const struct proving_entity *e, struct vec3 p)
{
    struct vec3 half = strcmp(e->class_, "person") ? vec3(2.4, 1.05, 1.5) : vec3(0.45, 0.45, 1.9);
    struct vec3 q = pose_apply(pose_inverse(proving_entity_pose(e)), p);
    double dx = fmax(0, fabs(q.x) - half.x), dy = fmax(0, fabs(q.y) - half.y), dz = fmax(0, fmax(-q.z, q.z - half.z));
    return sqrt(dx * dx + dy * dy + dz * dz);
}

static bool on_open_ground(struct vec3 p)
{
    if (p.z > GROUND_M) return false;
    for (size_t i = 0; i < sizeof parked_m / sizeof *parked_m; i++)
        if (fabs(p.x - parked_m[i][0]) < PARKED_HALF_LENGTH_M && fabs(p.y - parked_m[i][1]) < PARKED_HALF_WIDTH_M) return false;
    return true;
}

static bool is_changed(struct vec3 p, const struct proving_case *c)
{
    for (size_t i = 0; i < proving_entity_count(c); i++)
        if (distance_to_entity(&c->entities[i], p) < (p.z > GROUND_M || on_open_ground(p) ? REACH_M : 0.02)) return true;
    return on_open_ground(p);
}

bool influence_limit(struct image *truth, const struct image *photograph, const struct image *range, const struct pinhole *pinhole,
                     const struct proving_case *c, size_t shot, struct error *err)
{
    struct image changed;
    struct pose world_from_camera = proving_shot_pose(&c->shots[shot]);
    int width = truth->width_px, height = truth->height_px;
    if (!image_init(&changed, width, height, 1, PIXEL_U8, err)) return false;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            struct vec3 d = vec3_unit(vec3((x + 0.5 - pinhole->cx_px) / pinhole->f_px, (y + 0.5 - pinhole->cy_px) / pinhole->f_px, 1));
            double far = (double)*image_u16(range, x, y) / 65535 * PROVING_RANGE_M;
            *image_u8(&changed, x, y) = is_changed(pose_apply(world_from_camera, vec3_scale(d, far)), c);
        }
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            bool near = false;
            for (int v = y - EDGE_PX; v <= y + EDGE_PX; v++)
                for (int u = x - EDGE_PX; u <= x + EDGE_PX; u++)
                    near |= u >= 0 && v >= 0 && u < width && v < height && *image_u8(&changed, u, v);
            if (!near) memcpy(image_f32(truth, x, y), image_f32(photograph, x, y), 3 * sizeof(float));
        }
    image_release(&changed);
    return true;
}
