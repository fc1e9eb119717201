#include "import/placement.h"

#include "import/control_points.h"
#include "import/gps_ties.h"
#include "lib/place.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A receiver without correction is good to some metres; a point taken by hand to less. */
#define GPS_INLIER_M 5.0
#define POINT_INLIER_M 1.0

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(double *values, size_t n)
{
    qsort(values, n, sizeof *values, by_value);
    return n % 2 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

/* Move the ties' frame from one of them to the middle of all, where a round place is the origin. */
static bool centre(struct tie *ties, size_t n, double origin[3], struct error *err)
{
    double(*places)[3] = calloc(n, sizeof *places), *sorted = calloc(n, sizeof *sorted), middle[3] = { 0 };
    bool ok = places && sorted ? true : error_set(err, ERR_MEMORY, "no memory for %zu positions", n);
    for (size_t i = 0; ok && i < n; i++) {
        const double enu_m[3] = { ties[i].p_enu_m.x, ties[i].p_enu_m.y, ties[i].p_enu_m.z };
        ok = place_geodetic_from_enu(places[i], origin, enu_m, err);
        /* West of the date line's neighbours in the east: count on beyond 180. */
        if (ok && places[i][1] - places[0][1] > 180) places[i][1] -= 360;
        if (ok && places[i][1] - places[0][1] < -180) places[i][1] += 360;
    }
    for (int axis = 0; ok && axis < 3; axis++) {
        const double unit = axis < 2 ? 1e6 : 1e2;
        for (size_t i = 0; i < n; i++) sorted[i] = places[i][axis];
        middle[axis] = round(median(sorted, n) * unit) / unit;
    }
    middle[1] = remainder(middle[1], 360);
    for (size_t i = 0; ok && i < n; i++) {
        double enu_m[3];
        ok = place_enu_from_geodetic(enu_m, middle, places[i], err);
        if (ok) ties[i].p_enu_m = vec3(enu_m[0], enu_m[1], enu_m[2]);
    }
    if (ok) memcpy(origin, middle, sizeof middle);
    free(places);
    free(sorted);
    return ok;
}

/* The same axes with their origin a shift farther up. */
static bool raise_origin(struct placement *placement, const struct reconstruction *reconstruction, struct error *err)
{
    size_t n = reconstruction->point_count;
    if (!n) return true;
    double *heights = malloc(n * sizeof *heights);
    if (!heights) return error_set(err, ERR_MEMORY, "no memory for %zu points", n);
    for (size_t i = 0; i < n; i++)
        heights[i] = similarity_apply(placement->world_from_reconstruction, reconstruction->points[i]).z;
    double up_m = round(median(heights, n) * 100) / 100;
    free(heights);
    placement->origin_lat_lon_h[2] = round((placement->origin_lat_lon_h[2] + up_m) * 100) / 100;
    placement->world_from_reconstruction.translation.z -= up_m;
    for (size_t i = 0; i < placement->tie_count; i++) placement->ties[i].p_enu_m.z -= up_m;
    return true;
}

static bool fit(struct placement *placement, const struct reconstruction *reconstruction, double inlier_m,
                struct error *err)
{
    size_t n = placement->tie_count;
    placement->residuals = calloc(n, sizeof *placement->residuals);
    if (!placement->residuals) return error_set(err, ERR_MEMORY, "no memory for %zu positions", n);
    placement->has_place = true;
    return centre(placement->ties, n, placement->origin_lat_lon_h, err) &&
           georeference_ties(&placement->world_from_reconstruction, placement->residuals, &placement->rms_m,
                             placement->ties, n, inlier_m, err) &&
           raise_origin(placement, reconstruction, err);
}

bool placement_find(struct placement *placement, const struct reconstruction *reconstruction,
                    const struct photo_facts *facts, const struct placement_request *request, struct error *err)
{
    struct placement found = { .way = request->way,
                               .world_from_reconstruction = { 1, mat3_identity(), { 0, 0, 0 } } };
    if (found.way == PLACEMENT_DEFAULT && !reconstruction->is_enu) found.way = PLACEMENT_GPS;
    bool ok = true;
    switch (found.way) {
    case PLACEMENT_GPS:
        ok = gps_ties(&found.ties, &found.tie_count, found.origin_lat_lon_h, reconstruction, facts, err) &&
             fit(&found, reconstruction, GPS_INLIER_M, err);
        break;
    case PLACEMENT_POINTS:
        ok = control_points_read(&found.ties, &found.tie_count, found.origin_lat_lon_h, request->points_file, err) &&
             fit(&found, reconstruction, POINT_INLIER_M, err);
        if (!ok && !err->file[0]) snprintf(err->file, sizeof err->file, "%s", request->points_file);
        break;
    case PLACEMENT_DISTANCE:
        ok = georeference_distance(&found.world_from_reconstruction, &found.upright, reconstruction, request->p,
                                   request->distance_m, err);
        break;
    case PLACEMENT_DEFAULT:
    case PLACEMENT_NONE:
        found.has_place = reconstruction->is_enu;
        memcpy(found.origin_lat_lon_h, reconstruction->reference_lat_lon_h, sizeof found.origin_lat_lon_h);
        break;
    }
    if (ok)
        *placement = found;
    else
        placement_release(&found);
    return ok;
}

void placement_release(struct placement *placement)
{
    if (placement->way == PLACEMENT_POINTS)
        control_points_release(placement->ties, placement->tie_count);
    else
        free(placement->ties);
    free(placement->residuals);
    *placement = (struct placement){ 0 };
}

/* p_camera = R p + t in units becomes s (R p + t) in metres, where p = rotation^T (p_world - translation) / s. */
struct pose placement_shot(const struct placement *placement, const struct recon_shot *shot)
{
    const struct similarity *s = &placement->world_from_reconstruction;
    struct mat3 rotation = mat3_multiply(mat3_from_quat(shot->camera_from_world_q), mat3_transpose(s->rotation));
    struct vec3 t = vec3_scale(shot->camera_from_world_t, s->scale);
    return (struct pose){ rotation, vec3_sub(t, mat3_apply(rotation, s->translation)) };
}
