/* The place as rays meet it: Embree's search tree over all of its triangles, at their own detail. */
#include "gen/world/static_mesh_impl.h"

#include <float.h>
#include <math.h>

#define BATCH 64 /* rays that go to Embree together */

static bool attach(struct static_mesh *mesh)
{
    RTCGeometry geometry = rtcNewGeometry(mesh->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    if (!geometry) return false;
    rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_LOW);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, mesh->position_m, 0,
                               sizeof *mesh->position_m, mesh->vertices);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh->triangle, 0,
                               sizeof *mesh->triangle, mesh->triangles);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(mesh->scene, geometry);
    rtcReleaseGeometry(geometry);
    return true;
}

bool static_rays_build(struct static_mesh *mesh, struct error *err)
{
    mesh->device = rtcNewDevice("threads=1");
    mesh->scene = mesh->device ? rtcNewScene(mesh->device) : NULL;
    if (!mesh->scene) return error_set(err, ERR_MEMORY, "no memory for the search tree of the place");
    if (!rtcGetDeviceProperty(mesh->device, RTC_DEVICE_PROPERTY_RAY_STREAM_SUPPORTED))
        return error_set(err, ERR_BUG, "this Embree was built without ray streams");
    /* ROBUST: without it a ray can slip through between two triangles that share an edge.
     * LOW: built in a fraction of the time; millions of triangles are searched by some million rays a frame. */
    rtcSetSceneFlags(mesh->scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(mesh->scene, RTC_BUILD_QUALITY_LOW);
    bool ok = attach(mesh);
    if (ok) rtcCommitScene(mesh->scene);
    if (!ok || rtcGetDeviceError(mesh->device) != RTC_ERROR_NONE)
        return error_set(err, ERR_MEMORY, "no memory for the search tree of the place");
    return true;
}

void static_rays_release(struct static_mesh *mesh)
{
    if (mesh->scene) rtcReleaseScene(mesh->scene);
    if (mesh->device) rtcReleaseDevice(mesh->device);
    mesh->scene = NULL;
    mesh->device = NULL;
}

/* Embree counts in floats: a ray starts where it enters the mesh's box, so that an origin far away
 * costs no precision. INFINITY where it passes beside it. */
static double entry(const struct static_mesh *mesh, struct vec3 o, struct vec3 d)
{
    const double origin[3] = { o.x, o.y, o.z }, direction[3] = { d.x, d.y, d.z };
    const double low[3] = { mesh->min_m.x, mesh->min_m.y, mesh->min_m.z }, high[3] = { mesh->max_m.x, mesh->max_m.y, mesh->max_m.z };
    double near_m = 0, far_m = INFINITY;
    for (int k = 0; k < 3; k++) {
        double margin = 1e-3 + 1e-6 * (fabs(low[k]) + fabs(high[k]));
        double a = low[k] - margin - origin[k], b = high[k] + margin - origin[k];
        if (direction[k] == 0) {
            if (a > 0 || b < 0) return INFINITY;
            continue;
        }
        double t0 = a / direction[k], t1 = b / direction[k];
        near_m = fmax(near_m, fmin(t0, t1));
        far_m = fmin(far_m, fmax(t0, t1));
    }
    return near_m <= far_m ? near_m : INFINITY;
}

static struct RTCRay ray_from(struct vec3 o, struct vec3 d, double near_m, double far_m)
{
    return (struct RTCRay){ .org_x = (float)o.x, .org_y = (float)o.y, .org_z = (float)o.z,
                            .dir_x = (float)d.x, .dir_y = (float)d.y, .dir_z = (float)d.z,
                            .tnear = (float)near_m, .tfar = far_m < (double)FLT_MAX ? (float)far_m : FLT_MAX,
                            .mask = UINT32_MAX };
}

static void hit_batch(const struct static_mesh *mesh, struct static_hit *hits, struct vec3 origin_m,
                      const struct vec3 *directions, size_t n)
{
    struct RTCRayHit query[BATCH];
    double start[BATCH];
    size_t from[BATCH], queries = 0;
    for (size_t i = 0; i < n; i++) {
        hits[i] = (struct static_hit){ .range_m = INFINITY, .triangle = STATIC_NO_TRIANGLE };
        double at = entry(mesh, origin_m, directions[i]);
        if (!isfinite(at)) continue;
        struct RTCRayHit *q = &query[queries];
        q->ray = ray_from(vec3_add(origin_m, vec3_scale(directions[i], at)), directions[i], 0, INFINITY);
        q->hit.geomID = RTC_INVALID_GEOMETRY_ID;
        q->hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        start[queries] = at;
        from[queries++] = i;
    }
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect1M(mesh->scene, &context, query, (unsigned)queries, sizeof *query);
    for (size_t k = 0; k < queries; k++)
        if (query[k].hit.geomID != RTC_INVALID_GEOMETRY_ID)
            hits[from[k]] = (struct static_hit){ .range_m = start[k] + (double)query[k].ray.tfar, .triangle = query[k].hit.primID,
                                                 .u = query[k].hit.u, .v = query[k].hit.v };
}

void static_mesh_hits(const struct static_mesh *mesh, struct static_hit *hits, struct vec3 origin_m,
                      const struct vec3 *directions, size_t n)
{
    for (size_t at = 0; at < n; at += BATCH)
        hit_batch(mesh, hits + at, origin_m, directions + at, n - at < BATCH ? n - at : BATCH);
}

bool static_mesh_blocks(const struct static_mesh *mesh, struct vec3 from_m, struct vec3 direction, double near_m,
                        double far_m)
{
    struct vec3 begin = vec3_add(from_m, vec3_scale(direction, near_m));
    double start = entry(mesh, begin, direction);
    if (!(start < far_m - near_m)) return false;
    struct RTCRay ray = ray_from(vec3_add(begin, vec3_scale(direction, start)), direction, 0, far_m - near_m - start);
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(mesh->scene, &context, &ray);
    return ray.tfar < 0;
}

bool static_mesh_height(const struct static_mesh *mesh, double *z_m, double x_m, double y_m, double below_m)
{
    double top = fmin(below_m, mesh->max_m.z + 1);
    struct RTCRayHit query = { .ray = ray_from(vec3(x_m, y_m, top), vec3(0, 0, -1), 0, INFINITY) };
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(mesh->scene, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
    const uint32_t *t = mesh->triangle[query.hit.primID];
    double u = (double)query.hit.u, v = (double)query.hit.v;
    *z_m = (1 - u - v) * (double)mesh->position_m[t[0]][2] + u * (double)mesh->position_m[t[1]][2] + v * (double)mesh->position_m[t[2]][2];
    return true;
}
