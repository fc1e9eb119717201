#include "import/gps_ties.h"

#include "lib/place.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct vec3 shot_centre(const struct recon_shot *shot)
{
    struct pose camera_from_world = { mat3_from_quat(shot->camera_from_world_q), shot->camera_from_world_t };
    return pose_inverse(camera_from_world).translation;
}

static bool too_few(size_t positions, size_t heights, size_t shots, struct error *err)
{
    char lacking[80] = "";
    if (heights < positions) snprintf(lacking, sizeof lacking, " (%zu have latitude and longitude but no altitude)", positions - heights);
    return error_set(err, ERR_INPUT,
                     "%zu of %zu photographs have a GPS position in their EXIF%s, and it takes 3. Copies that lost "
                     "their EXIF? Give the originals' folder, or control points, or one known distance",
                     heights, shots, lacking);
}

bool gps_ties(struct tie **ties, size_t *n, double origin_lat_lon_h[3], const struct reconstruction *reconstruction,
              const struct photo_facts *facts, struct error *err)
{
    size_t shots = reconstruction->shot_count, positions = 0, count = 0;
    const double *origin = NULL;
    struct tie *found = calloc(shots ? shots : 1, sizeof *found);
    if (!found) return error_set(err, ERR_MEMORY, "no memory for %zu positions", shots);
    for (size_t i = 0; i < shots; i++) {
        positions += facts[i].has_position;
        if (!facts[i].has_position || !facts[i].has_height) continue;
        if (!origin) origin = facts[i].lat_lon_h;
        double enu_m[3];
        if (!place_enu_from_geodetic(enu_m, origin, facts[i].lat_lon_h, err)) {
            error_prefix(err, "%s: ", reconstruction->shots[i].image);
            free(found);
            return false;
        }
        found[count++] = (struct tie){
            .name = reconstruction->shots[i].image,
            .p_reconstruction = shot_centre(&reconstruction->shots[i]),
            .p_enu_m = { enu_m[0], enu_m[1], enu_m[2] },
        };
    }
    if (count < 3) {
        free(found);
        return too_few(positions, count, shots, err);
    }
    memcpy(origin_lat_lon_h, origin, 3 * sizeof *origin);
    *ties = found;
    *n = count;
    return true;
}
