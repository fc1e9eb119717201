#include "gen/world/shading.h"

#include <embree3/rtcore.h>

#include <float.h>
#include <stdlib.h>
#include <string.h>

/* POV-Ray's shadow rays begin as far from a surface. */
#define NEAR_M 1e-3f

static RTCScene rays_to(RTCDevice device, const struct static_cut *cut)
{
    RTCScene scene = rtcNewScene(device);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    /* Copied: Embree reads 16 bytes at a time, and may read beyond the last vertex of a shared buffer. */
    void *vertex = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof *cut->position_m,
                                           cut->vertices);
    void *index = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof *cut->triangle,
                                          cut->triangles);
    if (vertex && index) {
        memcpy(vertex, cut->position_m, cut->vertices * sizeof *cut->position_m);
        memcpy(index, cut->triangle, cut->triangles * sizeof *cut->triangle);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene, geometry);
        rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
        rtcCommitScene(scene);
    }
    rtcReleaseGeometry(geometry);
    return scene;
}

/* Does a shadow fall from p on something? */
static bool casts(RTCScene receivers, const float p[3], const struct vec3 *towards, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        struct RTCRay ray = { .org_x = p[0], .org_y = p[1], .org_z = p[2], .dir_x = (float)-towards[i].x,
                              .dir_y = (float)-towards[i].y, .dir_z = (float)-towards[i].z, .tnear = NEAR_M,
                              .tfar = FLT_MAX, .mask = UINT32_MAX };
        struct RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcOccluded1(receivers, &context, &ray);
        if (ray.tfar < 0) return true;
    }
    return false;
}

static bool is_large(const struct static_cut *cut, const uint32_t triangle[3])
{
    for (int k = 0; k < 3; k++) {
        const float *a = cut->position_m[triangle[k]], *b = cut->position_m[triangle[(k + 1) % 3]];
        struct vec3 edge = vec3((double)(b[0] - a[0]), (double)(b[1] - a[1]), (double)(b[2] - a[2]));
        if (vec3_norm(edge) > SHADING_SAMPLE_M) return true;
    }
    return false;
}

/* Mark the corners of every triangle that has a marked one. Out: to (cut->vertices) */
static void spread(bool *to, const bool *from, const struct static_cut *cut)
{
    for (size_t i = 0; i < cut->triangles; i++) {
        const uint32_t *t = cut->triangle[i];
        if (from[t[0]] || from[t[1]] || from[t[2]]) to[t[0]] = to[t[1]] = to[t[2]] = true;
    }
}

/* The triangles of a cut that have a marked corner, or those that have none. */
static bool pick(struct static_cut *out, const struct static_cut *cut, const bool *marked, bool wanted)
{
    struct static_cut picked = { .position_m = calloc(cut->vertices + 1, sizeof *cut->position_m),
                                 .triangle = calloc(cut->triangles + 1, sizeof *cut->triangle) };
    uint32_t *number = malloc((cut->vertices + 1) * sizeof *number);
    bool ok = picked.position_m && picked.triangle && number;
    if (ok) memset(number, 0xff, (cut->vertices + 1) * sizeof *number);
    for (size_t i = 0; ok && i < cut->triangles; i++) {
        const uint32_t *t = cut->triangle[i];
        if ((marked[t[0]] || marked[t[1]] || marked[t[2]]) != wanted) continue;
        for (int k = 0; k < 3; k++) {
            if (number[t[k]] == UINT32_MAX) {
                number[t[k]] = (uint32_t)picked.vertices;
                memcpy(picked.position_m[picked.vertices++], cut->position_m[t[k]], sizeof *cut->position_m);
            }
            picked.triangle[picked.triangles][k] = number[t[k]];
        }
        picked.triangles++;
    }
    free(number);
    if (ok) *out = picked;
    else static_cut_release(&picked);
    return ok;
}

bool shading_part(struct static_cut *shading, struct static_cut *rest, const struct static_cut *cut,
                  const struct static_cut *receivers, const struct vec3 *towards, size_t n, struct error *err)
{
    RTCDevice device = rtcNewDevice("threads=1");
    RTCScene scene = device && receivers->triangles ? rays_to(device, receivers) : NULL;
    bool *casting = calloc(cut->vertices + 1, sizeof *casting), *near = calloc(cut->vertices + 1, sizeof *near);
    struct static_cut part = { 0 };
    bool ok = device && casting && near && rtcGetDeviceError(device) == RTC_ERROR_NONE;
    for (size_t i = 0; ok && scene && i < cut->vertices; i++) casting[i] = casts(scene, cut->position_m[i], towards, n);
    for (size_t i = 0; ok && i < cut->triangles; i++)
        for (int k = 0; is_large(cut, cut->triangle[i]) && k < 3; k++) near[cut->triangle[i][k]] = true;
    if (ok) spread(near, casting, cut);
    ok = ok && pick(&part, cut, near, true) && pick(rest, cut, near, false);
    if (ok) *shading = part;
    else static_cut_release(&part);
    free(near);
    free(casting);
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
    return ok || error_set(err, ERR_MEMORY, "no memory for what shades the place");
}
