#include "gen/world/entity.h"

#include <math.h>

struct pose entity_stand(const struct plane *ground, struct vec3 at_m, double heading_rad)
{
    struct vec3 up = ground->normal;
    struct vec3 forward = vec3(sin(heading_rad), cos(heading_rad), 0);
    forward.z = -vec3_dot(up, forward) / up.z; /* straight up or down onto the plane keeps the heading */
    forward = vec3_unit(forward);
    at_m.z = plane_height(ground, at_m.x, at_m.y);
    return (struct pose){ mat3_from_columns(forward, vec3_cross(up, forward), up), at_m };
}

struct box { struct vec3 centre_m, axis[3]; double half_m[3]; };

static struct box box_of(const struct entity *entity)
{
    struct vec3 low = entity->model->min_m, high = entity->model->max_m;
    struct box box = { .centre_m = pose_apply(entity->world_from_entity, vec3_scale(vec3_add(low, high), 0.5)),
                       .half_m = { (high.x - low.x) / 2, (high.y - low.y) / 2, (high.z - low.z) / 2 } };
    for (int i = 0; i < 3; i++) box.axis[i] = mat3_column(entity->world_from_entity.rotation, i);
    return box;
}

/* Half the length of the box's shadow on a unit axis. */
static double box_reach(const struct box *box, struct vec3 axis)
{
    double reach = 0;
    for (int i = 0; i < 3; i++) reach += box->half_m[i] * fabs(vec3_dot(box->axis[i], axis));
    return reach;
}

static bool separates(struct vec3 axis, const struct box *a, const struct box *b, double tolerance_m)
{
    double norm = vec3_norm(axis);
    if (norm < 1e-9) return false; /* parallel edges: the faces' axes decide */
    axis = vec3_scale(axis, 1 / norm);
    double apart = fabs(vec3_dot(vec3_sub(b->centre_m, a->centre_m), axis));
    return box_reach(a, axis) + box_reach(b, axis) - apart <= tolerance_m;
}

bool entities_intersect(const struct entity *a, const struct entity *b, double tolerance_m)
{
    struct box box_a = box_of(a), box_b = box_of(b);
    for (int i = 0; i < 3; i++) {
        if (separates(box_a.axis[i], &box_a, &box_b, tolerance_m)) return false;
        if (separates(box_b.axis[i], &box_a, &box_b, tolerance_m)) return false;
        for (int j = 0; j < 3; j++)
            if (separates(vec3_cross(box_a.axis[i], box_b.axis[j]), &box_a, &box_b, tolerance_m)) return false;
    }
    return true;
}

void entity_corners(struct vec3 corners_m[8], const struct entity *entity)
{
    const struct vec3 bounds[2] = { entity->model->min_m, entity->model->max_m };
    for (int i = 0; i < 8; i++)
        corners_m[i] = pose_apply(entity->world_from_entity,
                                  vec3(bounds[i >> 2].x, bounds[i >> 1 & 1].y, bounds[i & 1].z));
}
