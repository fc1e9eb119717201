#include "gen/trace/exitance.h"

#include "gen/light/sky_image.h"
#include "gen/trace/sky_sight.h"

#include <math.h>
#include <stdlib.h>

enum { RAYS = 32 };
#define OFF_SURFACE_M 0.005

/* Irradiance / pi of a side of a triangle, in its middle. */
struct received { bool known; float above[3], ground[3]; /* sun and sky; what the ground sends up, lit as in the open */ };

struct exitance {
    const struct entity *entity;
    struct entity_light in;
    struct received **received; /* (meshes) each (triangles, 2): the front, the back */
};

bool exitance_create(struct exitance **exitance, const struct entity *entity, const struct entity_light *in, struct error *err)
{
    const struct model *model = entity->model;
    struct exitance *e = calloc(1, sizeof *e);
    bool ok = e;
    if (ok) {
        *e = (struct exitance){ entity, *in, calloc(model->mesh_count + 1, sizeof *e->received) };
        ok = e->received;
    }
    for (size_t i = 0; ok && i < model->mesh_count; i++)
        ok = (e->received[i] = calloc(model->meshes[i].triangles + 1, 2 * sizeof *e->received[i]));
    if (!ok) {
        exitance_destroy(e);
        return error_set(err, ERR_MEMORY, "no memory for the light that entities send back");
    }
    *exitance = e;
    return true;
}

void exitance_destroy(struct exitance *e)
{
    if (!e) return;
    for (size_t i = 0; e->received && i < e->entity->model->mesh_count; i++) free(e->received[i]);
    free(e->received);
    free(e);
}

static struct vec3 corner_of(const struct mesh *mesh, unsigned triangle, int k)
{
    const float *p = mesh->position_m[mesh->triangle[triangle][k]];
    return vec3((double)p[0], (double)p[1], (double)p[2]);
}

/* Directions that share a matte surface's irradiance equally. */
static void round_normal(struct vec3 direction[RAYS], struct vec3 normal)
{
    struct vec3 aside = vec3_unit(vec3_cross(normal, fabs(normal.z) < 0.9 ? vec3(0, 0, 1) : vec3(1, 0, 0))), up = vec3_cross(aside, normal);
    for (int i = 0; i < RAYS; i++) {
        struct vec3 d = cosine_direction((size_t)i, RAYS);
        direction[i] = vec3_add(vec3_scale(normal, d.z), vec3_add(vec3_scale(aside, d.x), vec3_scale(up, d.y)));
    }
}

/* In: p, normal  world */
static void receive(struct received *out, const struct entity_light *in, struct vec3 p, struct vec3 normal)
{
    struct vec3 direction[RAYS];
    float left[RAYS];
    double sun = in->light->has_sun ? fmax(0, vec3_dot(normal, in->light->sun_direction)) : 0;
    if (sun > 0) sun *= sky_sight_sun(in->sight, p);
    round_normal(direction, normal);
    for (int i = 0; i < RAYS; i++) left[i] = 1;
    sky_sight_shade(in->sight, left, p, direction, RAYS);
    *out = (struct received){ .known = true };
    for (int i = 0; i < RAYS; i++) {
        const float *radiance = sky_radiance(in->around, direction[i]);
        for (int c = 0; c < 3; c++) (direction[i].z > 0 ? out->above : out->ground)[c] += left[i] * radiance[c] / RAYS;
    }
    for (int c = 0; c < 3; c++) out->above[c] += (float)(sun * in->light->sun_color[c]);
}

void exitance_radiance(double rgb[3], struct exitance *e, const struct shape_point *at, struct vec3 direction, double ground_left)
{
    const struct model *model = e->entity->model;
    const struct mesh *mesh = &model->meshes[at->mesh];
    const struct material *material = &model->materials[mesh->material];
    struct vec3 a = corner_of(mesh, at->triangle, 0), b = corner_of(mesh, at->triangle, 1), c = corner_of(mesh, at->triangle, 2);
    struct vec3 normal = vec3_cross(vec3_sub(b, a), vec3_sub(c, a)), middle = vec3_scale(vec3_add(a, vec3_add(b, c)), 1.0 / 3);
    bool back = vec3_dot(normal, direction) > 0;
    struct received *received = &e->received[at->mesh][2 * at->triangle + back];
    if (!received->known && vec3_norm(normal) > 0) {
        normal = vec3_scale(normal, (back ? -1 : 1) / vec3_norm(normal));
        middle = vec3_add(middle, vec3_scale(normal, OFF_SURFACE_M));
        receive(received, &e->in, pose_apply(e->entity->world_from_entity, middle), mat3_apply(e->entity->world_from_entity.rotation, normal));
    }
    double uv[2];
    mesh_uv_at(uv, mesh, at->triangle, at->u, at->v);
    material_reflectance(rgb, material, e->entity->has_color ? e->entity->color : NULL, uv[0], uv[1]);
    for (int i = 0; i < 3; i++) rgb[i] *= (double)received->above[i] + ground_left * (double)received->ground[i];
}
