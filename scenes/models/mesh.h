/* A triangle mesh of named materials, and the OBJ and MTL files that it ends in. */
#ifndef STAFFAGE_SCENES_MODELS_MESH_H
#define STAFFAGE_SCENES_MODELS_MESH_H

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

struct triangle { struct vec3 p[3]; enum material material; };
struct model { struct triangle *triangles; size_t count, room; }; /* { 0 } is empty */

/* Four corners, counter-clockwise from outside, cut along the shorter diagonal. */
void add_quad(struct model *model, enum material material, const struct vec3 corner[4]);

/* A grid of (rows + 1) x (columns + 1) points of a shape; from outside, columns run to the left of rows.
 * side is +1, or -1 for the mirror image across y = 0. */
typedef struct vec3 point_fn(const void *shape, int row, int column);
typedef enum material material_fn(const void *shape, int row, int column);
void add_sheet(struct model *model, int rows, int columns, int side, point_fn *point, material_fn *material,
               const void *shape);

/* Write FOLDER/NAME.obj and .mtl with smooth normals, and empty the model. */
bool write_model(struct model *model, const char *folder, const char *name, const struct palette *palette,
                 struct error *err);

/* ---- what there is to make ---- */

void make_sedan(struct model *model);

enum stance { STANDING, WALKING };
enum build { MAN, WOMAN };
void make_person(struct model *model, enum build build, enum stance stance, double height_m);

#endif
