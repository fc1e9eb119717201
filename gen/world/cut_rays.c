#include "gen/world/cut_rays.h"

#include <embree3/rtcore.h>

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* POV-Ray's shadow rays begin as far from a surface. */
#define NEAR_M 1e-3f

struct cut_rays {
    RTCDevice device;
    RTCScene scene;
};

static bool index_triangles(RTCScene scene, RTCGeometry geometry, const struct static_cut *cut)
{
    /* Copied: Embree reads 16 bytes at a time, and may read beyond the last vertex of a shared buffer. */
    void *vertex = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof *cut->position_m,
                                           cut->vertices);
    void *index = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof *cut->triangle,
                                          cut->triangles);
    if (!vertex || !index) return false;
    memcpy(vertex, cut->position_m, cut->vertices * sizeof *cut->position_m);
    memcpy(index, cut->triangle, cut->triangles * sizeof *cut->triangle);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    return true;
}

bool cut_rays_create(struct cut_rays **rays, const struct static_cut *cut, struct error *err)
{
    struct cut_rays *r = calloc(1, sizeof *r);
    RTCGeometry geometry = NULL;
    if (r) r->device = rtcNewDevice("threads=1");
    if (r && r->device) {
        r->scene = rtcNewScene(r->device);
        geometry = rtcNewGeometry(r->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    }
    bool ok = geometry && (cut->triangles == 0 || index_triangles(r->scene, geometry, cut));
    if (ok) rtcCommitScene(r->scene);
    if (geometry) rtcReleaseGeometry(geometry);
    if (!ok || rtcGetDeviceError(r->device) != RTC_ERROR_NONE) {
        cut_rays_destroy(r);
        return error_set(err, ERR_MEMORY, "no memory for rays to the place");
    }
    *rays = r;
    return true;
}

void cut_rays_destroy(struct cut_rays *rays)
{
    if (!rays) return;
    if (rays->scene) rtcReleaseScene(rays->scene);
    if (rays->device) rtcReleaseDevice(rays->device);
    free(rays);
}

bool cut_rays_blocked(const struct cut_rays *rays, struct vec3 p, struct vec3 d, double reach_m)
{
    struct RTCRay ray = { .org_x = (float)p.x, .org_y = (float)p.y, .org_z = (float)p.z, .dir_x = (float)d.x,
                          .dir_y = (float)d.y, .dir_z = (float)d.z, .tnear = NEAR_M, .tfar = (float)fmin(reach_m, (double)FLT_MAX), .mask = UINT32_MAX };
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(rays->scene, &context, &ray);
    return ray.tfar < 0;
}
