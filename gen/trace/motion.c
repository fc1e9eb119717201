#include "gen/trace/motion.h"

#include "gen/trace/footprint.h"
#include "gen/trace/rays.h"
#include "gen/world/prism.h"

#include <math.h>
#include <stdlib.h>

/* From the camera's coordinates now to those at opening and closing, for points that something carries along. */
struct carry { struct pose opening, closing; };

struct mover {
    const struct trace_input *in;
    const struct frame_labels *labels;
    const size_t *receiver_entity;
    struct carry *entity, *shade; /* (entity_count) */
    size_t *index;                /* (65536) of an entity's id */
    struct rect *receiver_px;     /* (receiver_count) */
    struct rays rays;
};

static struct pose shift(struct vec3 by)
{
    return (struct pose){ mat3_identity(), by };
}

static struct carry carry(const struct motion_input *move, struct pose opening, struct pose closing, struct pose now)
{
    return (struct carry){ pose_compose(pose_compose(pose_inverse(move->opening), opening), now),
                           pose_compose(pose_compose(pose_inverse(move->closing), closing), now) };
}

static bool mover_init(struct mover *m, const struct trace_input *in, const size_t *receiver_entity,
                       const struct frame_labels *labels, const struct motion_input *move, struct error *err)
{
    *m = (struct mover){ .in = in, .labels = labels, .receiver_entity = receiver_entity };
    m->entity = calloc(2 * in->entity_count + 1, sizeof *m->entity);
    m->index = calloc(UINT16_MAX + 1, sizeof *m->index);
    m->receiver_px = calloc(in->receiver_count + 1, sizeof *m->receiver_px);
    if (!m->entity || !m->index || !m->receiver_px) return error_set(err, ERR_MEMORY, "no memory for how a frame moves");
    m->shade = m->entity + in->entity_count;
    for (size_t i = 0; i < in->entity_count; i++) {
        const struct entity *e = &in->entities[i];
        struct vec3 from = e->world_from_entity.translation;
        m->index[e->id] = i;
        m->entity[i] = carry(move, move->entity_opening[i], move->entity_closing[i],
                             pose_compose(pose_inverse(e->world_from_entity), in->world_from_camera));
        m->shade[i] = carry(move, shift(vec3_sub(move->entity_opening[i].translation, from)),
                            shift(vec3_sub(move->entity_closing[i].translation, from)), in->world_from_camera);
    }
    for (size_t k = 0; k < in->receiver_count; k++)
        m->receiver_px[k] = footprint_prism(in->camera, pose_inverse(in->world_from_camera), &in->receivers[k]);
    return rays_init(&m->rays, in->camera, err);
}

static void mover_release(struct mover *m)
{
    free(m->entity);
    free(m->index);
    free(m->receiver_px);
    rays_release(&m->rays);
}

static void put(float *motion, const struct camera *camera, const struct carry *carry, struct vec3 p_camera)
{
    struct error ignored = ERROR_NONE;
    struct vec2 opening, closing;
    if (!camera_project(camera, &opening, pose_apply(carry->opening, p_camera), &ignored) ||
        !camera_project(camera, &closing, pose_apply(carry->closing, p_camera), &ignored))
        return;
    motion[0] = (float)(closing.x - opening.x);
    motion[1] = (float)(closing.y - opening.y);
}

/* What is seen of the entities in a row. */
static void move_entities(struct image *motion, struct mover *m, int y)
{
    for (int x = 0; x < motion->width_px; x++) {
        uint16_t id = *image_u16(&m->labels->instance, x, y);
        double z = (double)*image_f32(&m->labels->depth, x, y);
        struct vec3 direction;
        if (id == 0 || !rays_get(&m->rays, &direction, x)) continue;
        put(image_f32(motion, x, y), m->in->camera, &m->entity[m->index[id]], vec3_scale(direction, z / direction.z));
    }
}

/* The entity's pixel nearest to this one, at most EDGE_PX away. */
static bool edge(const struct mover *m, int *eu, int *ev, int x, int y)
{
    const struct image *instance = &m->labels->instance;
    int least = 3 * EDGE_PX * EDGE_PX;
    bool found = false;
    for (int v = y > EDGE_PX ? y - EDGE_PX : 0; v <= y + EDGE_PX && v < instance->height_px; v++)
        for (int u = x > EDGE_PX ? x - EDGE_PX : 0; u <= x + EDGE_PX && u < instance->width_px; u++) {
            int away = (u - x) * (u - x) + (v - y) * (v - y);
            if (away >= least || *image_u16(instance, u, v) == 0) continue;
            least = away;
            *eu = u;
            *ev = v;
            found = true;
        }
    return found;
}

/* The point of the place or the ground that the ray meets, camera coordinates. */
static bool floor_point(const struct mover *m, struct vec3 *p_camera, struct vec3 direction, int x, int y)
{
    const struct trace_input *in = m->in;
    if (in->place) {
        double z = (double)*image_f32(&m->labels->place_depth, x, y);
        *p_camera = vec3_scale(direction, z / direction.z);
        return isfinite(z);
    }
    struct vec3 p_m, world = mat3_apply(in->world_from_camera.rotation, direction);
    if (!in->ground || !plane_intersect(in->ground, &p_m, in->world_from_camera.translation, world)) return false;
    *p_camera = vec3_scale(direction, vec3_norm(vec3_sub(p_m, in->world_from_camera.translation)));
    return true;
}

/* The entity whose shade may lie at a point: of those whose receiver it is in, the nearest on the map. */
static bool shading(const struct mover *m, size_t *entity, struct vec3 p_m, int x, int y)
{
    double least = INFINITY;
    for (size_t k = 0; k < m->in->receiver_count; k++) {
        struct rect r = m->receiver_px[k];
        struct vec3 at = m->in->entities[m->receiver_entity[k]].world_from_entity.translation;
        double away = (at.x - p_m.x) * (at.x - p_m.x) + (at.y - p_m.y) * (at.y - p_m.y);
        if (x < r.x0 || x >= r.x1 || y < r.y0 || y >= r.y1 || away >= least || !prism_contains(&m->in->receivers[k], p_m))
            continue;
        least = away;
        *entity = m->receiver_entity[k];
    }
    return isfinite(least);
}

/* The shade in a row. */
static void move_shade(struct image *motion, struct mover *m, int y)
{
    struct rect within = { motion->width_px, 0, 0, 0 }; /* columns that a receiver of this row covers */
    for (size_t k = 0; k < m->in->receiver_count; k++) {
        struct rect r = m->receiver_px[k];
        if (y < r.y0 || y >= r.y1) continue;
        within.x0 = r.x0 < within.x0 ? r.x0 : within.x0;
        within.x1 = r.x1 > within.x1 ? r.x1 : within.x1;
    }
    for (int x = within.x0; x < within.x1; x++) {
        struct vec3 direction, p;
        size_t entity = 0;
        if (*image_u16(&m->labels->instance, x, y) != 0 ||
            (m->labels->receiver.data && *image_u8(&m->labels->receiver, x, y) == 0))
            continue;
        if (rays_get(&m->rays, &direction, x) && floor_point(m, &p, direction, x, y) &&
            shading(m, &entity, pose_apply(m->in->world_from_camera, p), x, y))
            put(image_f32(motion, x, y), m->in->camera, &m->shade[entity], p);
    }
}

/* The edges in a row of what is seen of the entities. */
static void move_edges(struct image *motion, const struct mover *m, int y)
{
    for (size_t i = 0; i < m->labels->entity_count; i++) {
        struct rect seen = m->labels->entities[i].box_visible_px;
        if (rect_is_empty(seen) || y < seen.y0 - EDGE_PX || y >= seen.y1 + EDGE_PX) continue;
        for (int x = seen.x0 > EDGE_PX ? seen.x0 - EDGE_PX : 0; x < seen.x1 + EDGE_PX && x < motion->width_px; x++) {
            int u, v;
            if (*image_u16(&m->labels->instance, x, y) != 0 || !edge(m, &u, &v, x, y)) continue;
            for (int c = 0; c < 2; c++) image_f32(motion, x, y)[c] = image_f32(motion, u, v)[c];
        }
    }
}

bool motion_trace(struct image *motion, const struct trace_input *in, const size_t *receiver_entity,
                  const struct frame_labels *labels, const struct motion_input *move, struct error *err)
{
    struct mover m;
    int width = in->camera->width_px, height = in->camera->height_px;
    bool ok = mover_init(&m, in, receiver_entity, labels, move, err) &&
              image_init(motion, width, height, 3, PIXEL_F32, err);
    for (int y = 0; ok && y < height; y++) {
        rays_begin_row(&m.rays, y);
        move_entities(motion, &m, y);
    }
    for (int y = 0; ok && y < height; y++) {
        rays_begin_row(&m.rays, y);
        move_shade(motion, &m, y);
        move_edges(motion, &m, y);
    }
    mover_release(&m);
    return ok;
}
