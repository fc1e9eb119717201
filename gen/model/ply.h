/* PLY files: the header, and values one by one. What they mean is their reader's affair.
 * Src: Turk 1994, The PLY Polygon File Format */
#ifndef STAFFAGE_GEN_PLY_H
#define STAFFAGE_GEN_PLY_H

#include "lib/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { PLY_ELEMENTS = 16, PLY_PROPERTIES = 64, PLY_TEXTURES = 64 };

enum ply_type { PLY_INT8, PLY_UINT8, PLY_INT16, PLY_UINT16, PLY_INT32, PLY_UINT32, PLY_FLOAT32, PLY_FLOAT64, PLY_TYPE_COUNT };

/* What a number of a vertex or a face says, by the names that scanners and editors give it. */
enum ply_role {
    PLY_X, PLY_Y, PLY_Z, PLY_NX, PLY_NY, PLY_NZ, PLY_U, PLY_V, PLY_RED, PLY_GREEN, PLY_BLUE, PLY_LABEL, PLY_TEXTURE,
    PLY_NO_ROLE, PLY_ROLE_COUNT
};

struct ply_property { char name[32]; bool is_list; enum ply_type count_type, type; };
struct ply_element {
    char name[32];
    uint64_t count;
    struct ply_property properties[PLY_PROPERTIES];
    size_t property_count;
};

struct ply {
    const char *path, *at, *end;  /* the file's name, and what is not read yet; borrowed, a NUL byte at *end */
    bool binary, big_endian;
    struct ply_element elements[PLY_ELEMENTS];
    size_t element_count;
    char textures[PLY_TEXTURES][256]; /* of the comments "TextureFile" */
    size_t texture_count;
};

/* Read the header: `at` is left at the first element.
 * Out: *ply, initialized here
 * Err: ERR_INPUT at path: no PLY, or a header that cannot be understood */
bool ply_open(struct ply *ply, const char *path, const char *data, size_t size, struct error *err);

/* Can the rest of the file hold the element's count? Before anything is allocated for it.
 * Err: ERR_INPUT at path */
bool ply_check_count(const struct ply *ply, const struct ply_element *element, struct error *err);

/* The next value. False where the file ends, or has something else than a number. */
bool ply_read(struct ply *ply, double *value, enum ply_type type);

/* For a ply_read that failed in element number `index`, from 0. Always false. */
bool ply_truncated(const struct ply *ply, const struct ply_element *element, uint64_t index, struct error *err);

/* A colour channel as a share of full, 0 to 1: integers count to 255, floats to 1. */
double ply_color(double value, enum ply_type type);
enum ply_role ply_role(const struct ply_property *property);
bool ply_is_indices(const struct ply_property *property);

#endif
