#include "gen/render/shade_sdl.h"

#include "gen/render/mesh_sdl.h"

#include <math.h>

enum { TILE = 8 }; /* texels along the side of a tile */

/* Is there shade in it, or so near that it reaches in between texels? */
static bool is_shaded(const struct image *map, int column, int row)
{
    for (int y = row * TILE - 1; y <= (row + 1) * TILE; y++)
        for (int x = column * TILE - 1; x <= (column + 1) * TILE; x++)
            if (x >= 0 && y >= 0 && x < map->width_px && y < map->height_px && *image_u8(map, x, y) < 255) return true;
    return false;
}

/* The next rectangle of shaded tiles in a row, from a column on. False: there is none. */
static bool next_run(int *from, int *to, const struct image *map, int column, int row)
{
    int columns = (map->width_px + TILE - 1) / TILE;
    while (column < columns && !is_shaded(map, column, row)) column++;
    *from = column;
    while (column < columns && is_shaded(map, column, row)) column++;
    *to = column;
    return *from < *to;
}

/* In the unit square: every ray to the sun that meets the sheet costs, so it is where the shade is. */
static void write_sheet(struct sdl *sdl, const struct image *map)
{
    int rows = (map->height_px + TILE - 1) / TILE, from, to, count = 0;
    double width = map->width_px, height = map->height_px;
    for (int row = 0; row < rows; row++)
        for (int column = 0; next_run(&from, &to, map, column, row); column = to) count++;
    sdl_declare(sdl, "Sun_Share_Sheet");
    if (!count) {
        mesh_sdl_nowhere(sdl);
        return;
    }
    sdl_begin(sdl, "mesh2");
    sdl_begin(sdl, "vertex_vectors");
    sdl_number(sdl, 4 * count);
    for (int row = 0; row < rows; row++)
        for (int column = 0; next_run(&from, &to, map, column, row); column = to)
            for (int k = 0; k < 4; k++) {
                double x = fmin(1, (k & 1 ? to : from) * TILE / width), y = fmax(0, 1 - (row + (k >> 1)) * TILE / height);
                sdl_comma(sdl);
                sdl_vector(sdl, vec3(x, y, 0));
            }
    sdl_end(sdl);
    sdl_begin(sdl, "face_indices");
    sdl_number(sdl, 2 * count);
    for (int i = 0; i < 4 * count; i += 4) {
        sdl_comma(sdl);
        sdl_vector(sdl, vec3(i, i + 1, i + 2));
        sdl_comma(sdl);
        sdl_vector(sdl, vec3(i + 1, i + 3, i + 2));
    }
    sdl_end(sdl);
    sdl_end(sdl);
}

void shade_sdl(struct sdl *sdl, const struct sun_share *share, const char *map, const char *through, struct vec3 sun,
               const struct entity *entities, size_t n)
{
    const struct plane *ground = &share->ground;
    struct vec2 low = share->low_m, high = share->high_m;
    double along = sun_share_hangs_m(share, sun, entities, n);
    struct vec3 corner = vec3(low.x, low.y, plane_height(ground, low.x, low.y));
    sdl_declare_string(sdl, "Sun_Share", map);
    sdl_declare_vector(sdl, "Sun_Share_Corner", vec3_add(corner, vec3_scale(sun, along)));
    sdl_declare_vector(sdl, "Sun_Share_East", vec3_sub(vec3(high.x, low.y, plane_height(ground, high.x, low.y)), corner));
    sdl_declare_vector(sdl, "Sun_Share_North", vec3_sub(vec3(low.x, high.y, plane_height(ground, low.x, high.y)), corner));
    write_sheet(sdl, &share->map);
    if (through[0]) sdl_declare_string(sdl, "Sun_Through", through);
    sdl_include(sdl, "shade.inc");
}
