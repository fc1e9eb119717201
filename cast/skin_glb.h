/* A skinned figure as a binary glTF file. */
#ifndef STAFFAGE_CAST_SKIN_GLB_H
#define STAFFAGE_CAST_SKIN_GLB_H

#include "cast/motion.h"
#include "lib/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct skin_vertex { struct vec3 position, normal; struct vec2 uv; uint8_t joint[4], weight[4]; /* sum 255 */ };
struct skin_piece { /* of one material */
    const char *material;
    double roughness;
    struct skin_vertex *vertex;
    size_t vertices;
    uint16_t *index;
    size_t indices;
};
struct skin_figure {
    const char *name;
    const struct body *body;
    const struct skin_piece *piece;
    int pieces;
    const struct clip *clip;
    int clips;
    const uint8_t *png;
    size_t png_size;
};

bool write_skin_glb(const char *path, const struct skin_figure *figure, struct error *err);

#endif
