#include "gen/trace/shape.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#define BATCH 64 /* rays that go to Embree together */
#define NEAR_M 1e-3f /* POV-Ray's shadow rays begin as far from a surface */

/* What the filters of a mesh that is not wholly solid are given. */
struct masked_mesh {
    const struct mesh *mesh;
    const struct material *material;
};

struct shape {
    const struct model *model;
    RTCScene scene;
    struct masked_mesh *masked; /* (meshes) */
    struct vec3 min_m, max_m, centre_m;
    double radius_m;
    bool empty;
};

/* What the surface stops where a ray hits it. Hits come in N at a time, each field N long: normal (3), u, v,
 * triangle, mesh. */
static double alpha_at(const struct RTCFilterFunctionNArguments *args, unsigned i)
{
    const struct masked_mesh *masked = args->geometryUserPtr;
    if (!masked->mesh->uv) return material_alpha(masked->material, 0, 0);
    const float *u = (const float *)(const void *)args->hit + 3 * args->N, *v = u + args->N;
    const unsigned *triangle = (const unsigned *)(const void *)args->hit + 5 * args->N;
    double uv[2];
    mesh_uv_at(uv, masked->mesh, triangle[i], (double)u[i], (double)v[i]);
    return material_alpha(masked->material, uv[0], uv[1]);
}

static void pass_holes(const struct RTCFilterFunctionNArguments *args)
{
    for (unsigned i = 0; i < args->N; i++)
        if (args->valid[i] != 0 && alpha_at(args, i) == 0) args->valid[i] = 0;
}

/* A ray of light, and what is left of it. */
struct light_ray {
    struct RTCIntersectContext embree; /* first: Embree hands it to the filter */
    double share;
};

/* Surfaces that let light through do not end a ray, but dim it. One ray at a time. */
static void dim(const struct RTCFilterFunctionNArguments *args)
{
    const struct masked_mesh *masked = args->geometryUserPtr;
    struct light_ray *light = (struct light_ray *)(void *)args->context;
    double transmission = masked->material->transmission;
    light->share *= transmission > 0 ? transmission : 1 - alpha_at(args, 0);
    if (light->share > 0) args->valid[0] = 0;
}

static bool attach(struct shape *shape, RTCDevice device, size_t index, struct error *err)
{
    const struct mesh *mesh = &shape->model->meshes[index];
    const struct material *material = &shape->model->materials[mesh->material];
    if (mesh->triangles == 0) return true;
    bool masked = material->alpha_mode == ALPHA_MASK;
    if (masked && !mesh->uv && material_alpha(material, 0, 0) == 0) return true;
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_MEDIUM);
    void *vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                             sizeof *mesh->position_m, mesh->vertices);
    void *triangles = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                              sizeof *mesh->triangle, mesh->triangles);
    if (!vertices || !triangles) {
        rtcReleaseGeometry(geometry);
        return error_set(err, ERR_MEMORY, "no memory for the triangles of a model");
    }
    memcpy(vertices, mesh->position_m, mesh->vertices * sizeof *mesh->position_m);
    memcpy(triangles, mesh->triangle, mesh->triangles * sizeof *mesh->triangle);
    if ((masked && mesh->uv) || material->alpha_mode == ALPHA_BLEND || material->transmission > 0) {
        shape->masked[index] = (struct masked_mesh){ mesh, material };
        rtcSetGeometryUserData(geometry, &shape->masked[index]);
        rtcSetGeometryOccludedFilterFunction(geometry, dim);
        if (masked && mesh->uv) rtcSetGeometryIntersectFilterFunction(geometry, pass_holes);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(shape->scene, geometry, (unsigned)index);
    rtcReleaseGeometry(geometry);
    return true;
}

bool shape_create(struct shape **shape, RTCDevice device, const struct model *model, struct error *err)
{
    struct shape *s = calloc(1, sizeof *s);
    if (!s) return error_set(err, ERR_MEMORY, "no memory for a shape");
    s->model = model;
    s->scene = rtcNewScene(device);
    s->masked = calloc(model->mesh_count + 1, sizeof *s->masked);
    if (!s->scene || !s->masked) {
        error_set(err, ERR_MEMORY, "no memory for a shape");
        goto failed;
    }
    /* ROBUST: without it a ray can slip through between two triangles that share an edge. */
    rtcSetSceneFlags(s->scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(s->scene, RTC_BUILD_QUALITY_MEDIUM);
    for (size_t i = 0; i < model->mesh_count; i++)
        if (!attach(s, device, i, err)) goto failed;
    rtcCommitScene(s->scene);
    if (rtcGetDeviceError(device) != RTC_ERROR_NONE) {
        error_set(err, ERR_MEMORY, "no memory for the search tree of a model");
        goto failed;
    }
    struct RTCBounds box;
    rtcGetSceneBounds(s->scene, &box);
    s->empty = !(box.lower_x <= box.upper_x);
    if (!s->empty) {
        s->min_m = vec3((double)box.lower_x, (double)box.lower_y, (double)box.lower_z);
        s->max_m = vec3((double)box.upper_x, (double)box.upper_y, (double)box.upper_z);
        s->centre_m = vec3_scale(vec3_add(s->min_m, s->max_m), 0.5);
        s->radius_m = vec3_norm(vec3_sub(s->max_m, s->min_m)) * 0.5;
    }
    *shape = s;
    return true;
failed:
    shape_destroy(s);
    return false;
}

void shape_destroy(struct shape *shape)
{
    if (!shape) return;
    if (shape->scene) rtcReleaseScene(shape->scene);
    free(shape->masked);
    free(shape);
}

const struct model *shape_model(const struct shape *shape)
{
    return shape->model;
}

bool shape_bounds(const struct shape *shape, struct vec3 *min_m, struct vec3 *max_m)
{
    if (shape->empty) return false;
    *min_m = shape->min_m;
    *max_m = shape->max_m;
    return true;
}

static void hit_batch(const struct shape *shape, double *range_m, struct vec3 origin_m, const struct vec3 *directions,
                      size_t n)
{
    struct RTCRayHit hits[BATCH];
    double start[BATCH];
    for (size_t i = 0; i < n; i++) {
        /* Embree counts in floats: a ray starts just before the model, so that a camera far away costs no precision. */
        struct vec3 d = directions[i];
        start[i] = fmax(0, vec3_dot(vec3_sub(shape->centre_m, origin_m), d) - shape->radius_m);
        struct vec3 o = vec3_add(origin_m, vec3_scale(d, start[i]));
        hits[i].ray = (struct RTCRay){ .org_x = (float)o.x,
                                       .org_y = (float)o.y,
                                       .org_z = (float)o.z,
                                       .dir_x = (float)d.x,
                                       .dir_y = (float)d.y,
                                       .dir_z = (float)d.z,
                                       .tfar = FLT_MAX,
                                       .mask = UINT32_MAX };
        hits[i].hit.geomID = RTC_INVALID_GEOMETRY_ID;
        hits[i].hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    }
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect1M(shape->scene, &context, hits, (unsigned)n, sizeof *hits);
    for (size_t i = 0; i < n; i++)
        range_m[i] = hits[i].hit.geomID == RTC_INVALID_GEOMETRY_ID ? INFINITY : start[i] + (double)hits[i].ray.tfar;
}

void shape_hits(const struct shape *shape, double *range_m, struct vec3 origin_m, const struct vec3 *directions,
                size_t n)
{
    for (size_t at = 0; at < n; at += BATCH)
        hit_batch(shape, range_m + at, origin_m, directions + at, n - at < BATCH ? n - at : BATCH);
}

/* Texels of BLEND that are not there at all. */
static bool is_hole(const struct shape *shape, const struct shape_point *p)
{
    const struct mesh *mesh = &shape->model->meshes[p->mesh];
    const struct material *material = &shape->model->materials[mesh->material];
    if (material->alpha_mode != ALPHA_BLEND || !mesh->uv) return false;
    double uv[2];
    mesh_uv_at(uv, mesh, p->triangle, p->u, p->v);
    return material_alpha(material, uv[0], uv[1]) == 0;
}

static bool first_hit(const struct shape *shape, struct shape_point *point, struct vec3 o, struct vec3 d, double near_m)
{
    struct RTCRayHit hit = { .ray = { .org_x = (float)o.x, .org_y = (float)o.y, .org_z = (float)o.z, .dir_x = (float)d.x,
                                      .dir_y = (float)d.y, .dir_z = (float)d.z, .tnear = (float)near_m, .tfar = FLT_MAX, .mask = UINT32_MAX },
                             .hit = { .geomID = RTC_INVALID_GEOMETRY_ID, .instID = { RTC_INVALID_GEOMETRY_ID } } };
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(shape->scene, &context, &hit);
    *point = (struct shape_point){ hit.hit.geomID, hit.hit.primID, (double)hit.ray.tfar, (double)hit.hit.u, (double)hit.hit.v };
    return hit.hit.geomID != RTC_INVALID_GEOMETRY_ID;
}

bool shape_meet(const struct shape *shape, struct shape_point *point, struct vec3 origin, struct vec3 direction)
{
    double near = (double)NEAR_M;
    while (first_hit(shape, point, origin, direction, near)) {
        if (!is_hole(shape, point)) return true;
        near = point->range_m + (double)NEAR_M;
    }
    return false;
}

void shape_shade(const struct shape *shape, float *share, struct vec3 origin_m, const struct vec3 *directions, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        if (!(share[i] > 0)) continue;
        struct vec3 d = directions[i];
        struct RTCRay ray = { .org_x = (float)origin_m.x, .org_y = (float)origin_m.y, .org_z = (float)origin_m.z,
                              .dir_x = (float)d.x, .dir_y = (float)d.y, .dir_z = (float)d.z, .tnear = NEAR_M,
                              .tfar = FLT_MAX, .mask = UINT32_MAX };
        struct light_ray light = { .share = 1 };
        rtcInitIntersectContext(&light.embree);
        rtcOccluded1(shape->scene, &light.embree, &ray);
        share[i] *= ray.tfar < 0 ? 0 : (float)light.share;
    }
}
