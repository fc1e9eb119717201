#include "gen/trace/sunlit_ground.h"

#include "gen/world/sun_blockers.h"

#include <stdlib.h>

static bool add_entities(struct sun_blockers *blockers, const struct entity *entities, size_t n, struct error *err)
{
    bool ok = true;
    for (size_t i = 0; i < n; i++)
        for (size_t m = 0; ok && m < entities[i].model->mesh_count; m++) {
            const struct mesh *mesh = &entities[i].model->meshes[m];
            ok = sun_blockers_add(blockers, entities[i].world_from_entity, mesh->position_m, mesh->vertices, mesh->triangle, mesh->triangles, err);
        }
    return ok;
}

/* Where the map has a column and row: at its north-western corner, between pixels. */
static struct vec3 map_corner(const struct sun_share *share, double x, double y)
{
    double east = share->low_m.x + (share->high_m.x - share->low_m.x) * x / share->map.width_px;
    double north = share->high_m.y - (share->high_m.y - share->low_m.y) * y / share->map.height_px;
    return vec3(east, north, plane_height(&share->ground, east, north));
}

/* Shade that the photograph tells of hangs above all entities. Between texels it reaches into the next ones. */
static void add_map(struct sun_blockers *blockers, const struct sunlit_input *in)
{
    const struct sun_share *share = in->share;
    const struct image *map = &share->map;
    double up = sun_share_hangs_m(share, in->towards_sun, in->entities, in->entity_count);
    for (int y = 0; y < map->height_px; y++)
        for (int x = 0; x < map->width_px; x++) {
            int from = x;
            while (x < map->width_px && *image_u8(map, x, y) < 255) x++;
            if (x == from) continue;
            struct vec3 corner[4];
            for (int k = 0; k < 4; k++) corner[k] = map_corner(share, k & 1 ? x + 1 : from - 1, k & 2 ? y + 2 : y - 1);
            sun_blockers_add_above(blockers, corner, up);
            sun_blockers_add_above(blockers, corner + 1, up);
        }
}

static bool is_sunlit(const struct shaded_ground *ground, size_t triangle, const struct sun_blockers *blockers)
{
    struct vec3 corner[3];
    for (int k = 0; k < 3; k++) corner[k] = ground->position_m[ground->triangle[triangle][k]];
    return !sun_blockers_reach(blockers, corner);
}

bool sunlit_ground_find(struct shaded_ground *ground, const struct sunlit_input *in, struct error *err)
{
    static const struct static_cut nothing = { 0 };
    const struct static_cut *shades = in->shades ? in->shades : &nothing;
    struct sun_blockers *blockers = NULL;
    struct sunlit *sunlit = calloc(ground->triangles + 1, sizeof *sunlit);
    free(ground->sunlit);
    ground->sunlit = sunlit;
    if (!sunlit) return error_set(err, ERR_MEMORY, "no memory for the ground");
    if (!ground->triangles) return true;
    bool ok = sun_blockers_create(&blockers, in->towards_sun, ground->position_m, ground->vertices, err) &&
              sun_blockers_add(blockers, pose_identity(), shades->position_m, shades->vertices, shades->triangle, shades->triangles, err);
    if (ok && in->share && in->share->map.data) add_map(blockers, in);
    for (size_t i = 0; ok && i < ground->triangles; i++) sunlit[i].without = is_sunlit(ground, i, blockers);
    ok = ok && add_entities(blockers, in->entities, in->entity_count, err);
    for (size_t i = 0; ok && i < ground->triangles; i++) sunlit[i].with = is_sunlit(ground, i, blockers);
    sun_blockers_destroy(blockers);
    return ok;
}
