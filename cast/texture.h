/* One picture a person, with a tile for each of its materials. */
#ifndef STAFFAGE_CAST_TEXTURE_H
#define STAFFAGE_CAST_TEXTURE_H

#include "cast/person.h"

#include <stdint.h>

enum { TEXTURE_PX = 256 };
struct texture { uint8_t rgb[TEXTURE_PX][TEXTURE_PX][3]; };

void paint_texture(struct texture *texture, const struct person *person);
/* Where in it a point of a piece lies, 0 to 1 from its upper left corner. */
struct vec2 texture_place(enum piece piece, const struct person *person, const struct body *body, struct vec3 p);
/* As PNG, at 1/shrink of its size. The caller frees. */
uint8_t *texture_png(size_t *size, const struct texture *texture, int shrink);

#endif
