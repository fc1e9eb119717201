#include "map_flight.h"

#include "write_pov.h"

struct map_view map_view(int i)
{
    static const struct { const char *kind; double from_x, from_y; } views[PROVING_MAP_VIEWS] = {
        { "map-down", 0, 0 }, { "map-north", 0, 1 }, { "map-east", 1, 0 }, { "map-south", 0, -1 }, { "map-west", -1, 0 },
    };
    double x = views[i].from_x, y = views[i].from_y, width_m = PROVING_MESH_COLUMNS * PROVING_MESH_CELL_M,
           depth_m = PROVING_MESH_ROWS * PROVING_MESH_CELL_M;
    bool down = x == 0 && y == 0;
    struct map_view v = { .kind = views[i].kind, .middle_m = { PROVING_MESH_X0_M + width_m / 2, PROVING_MESH_Y0_M + depth_m / 2, 0 } };
    v.forward = vec3_unit(vec3(-x, -y, -1));
    v.right = vec3_unit(vec3_cross(v.forward, down ? vec3(0, 1, 0) : vec3(0, 0, 1)));
    v.up = vec3_cross(v.right, v.forward);
    double across_m = x != 0 ? depth_m : width_m, high_m = x != 0 ? width_m : depth_m;
    if (!down) {
        high_m = (high_m + PROVING_HIGHEST_M) * M_SQRT1_2;
        v.middle_m.z = PROVING_HIGHEST_M / 2;
    }
    v.width_px = (int)ceil(across_m * PROVING_MAP_PX_PER_M);
    v.height_px = (int)ceil(high_m * PROVING_MAP_PX_PER_M);
    return v;
}

bool map_view_pixel(const struct map_view *v, int *x, int *y, struct vec3 p)
{
    struct vec3 from_middle = vec3_sub(p, v->middle_m);
    double a = v->width_px / 2.0 + PROVING_MAP_PX_PER_M * vec3_dot(from_middle, v->right);
    double b = v->height_px / 2.0 - PROVING_MAP_PX_PER_M * vec3_dot(from_middle, v->up);
    if (!(a >= 0 && b >= 0 && a < v->width_px && b < v->height_px)) return false;
    *x = (int)a;
    *y = (int)b;
    return true;
}
