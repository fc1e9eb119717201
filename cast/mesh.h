/* A triangle mesh of named materials, and the points and normals that its triangles share. */
#ifndef STAFFAGE_CAST_MESH_H
#define STAFFAGE_CAST_MESH_H

#include "lib/error.h"
#include "lib/vec.h"

#include <stdbool.h>
#include <stddef.h>

#define PI 3.14159265358979323846

enum material {
    PAINT, GLASS, TRIM, UNDERSIDE, INTERIOR, HEADLIGHT, TAIL_LIGHT, PLATE_FRONT, PLATE_REAR, RUBBER, RIM,
    SKIN, HAIR, JACKET, TROUSERS, SHOES, MATERIAL_COUNT
};
struct palette { double rgb[MATERIAL_COUNT][3]; }; /* as MTL's Kd */

extern const char *const material_name[MATERIAL_COUNT];

/* What of a body a surface belongs to, for the joints that move it. */
enum part { TRUNK, HEAD_PART, LEGS, ARM, FIST, SHOE };

struct triangle { struct vec3 p[3]; enum material material; enum part part; };
struct model { /* { 0 } is empty */
    struct triangle *triangles;
    size_t count, room;
    enum part part; /* of what is added next */
};

/* Four corners, counter-clockwise from outside, cut along the shorter diagonal. */
void add_quad(struct model *model, enum material material, const struct vec3 corner[4]);

/* A grid of (rows + 1) x (columns + 1) points of a shape; from outside, columns run to the left of rows.
 * side is +1, or -1 for the mirror image across y = 0. */
typedef struct vec3 point_fn(const void *shape, int row, int column);
typedef enum material material_fn(const void *shape, int row, int column);
void add_sheet(struct model *model, int rows, int columns, int side, point_fn *point, material_fn *material,
               const void *shape);

/* Points and normals rounded to a grid, once each, and which of them each triangle's corners have. */
struct surface {
    struct vec3 *points, *normals;
    size_t point_count, normal_count;
    size_t (*point)[3], (*normal)[3]; /* (triangles,3) */
};
/* Weld the model (thin triangles go) and smooth it: panels shade smoothly, edges stay edges. */
struct surface make_surface(struct model *model);
void surface_release(struct surface *surface);
void model_release(struct model *model);

/* Write FOLDER/NAME.obj and .mtl, and empty the model. */
bool write_model(struct model *model, const char *folder, const char *name, const struct palette *palette,
                 struct error *err);

/* ---- what there is to make ---- */

void make_sedan(struct model *model);

enum stance { STANDING, WALKING, READY /* legs straight, arms down: to be moved by a skeleton */ };
enum build { MAN, WOMAN };
struct skeleton;
/* skeleton: the joints of the READY stance, or NULL */
void make_person(struct model *model, struct skeleton *skeleton, enum build build, enum stance stance, double height_m);

#endif
