/* PLY, ASCII and binary. Read here and not by assimp, whose PLY reader trusts the file's counts:
 * a file that ends early, as after a broken download, takes the process with it.
 * Src: Turk 1994, The PLY Polygon File Format */
#include "gen/model/model_import.h"
#include "lib/file.h"
#include "lib/image.h"

#include <inttypes.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_ELEMENTS = 16, MAX_PROPERTIES = 64 };

enum type { INT8, UINT8, INT16, UINT16, INT32, UINT32, FLOAT32, FLOAT64, TYPE_COUNT };
static const struct { const char *names[2]; size_t size; } types[TYPE_COUNT] = {
    [INT8] = { { "char", "int8" }, 1 },     [UINT8] = { { "uchar", "uint8" }, 1 },     [INT16] = { { "short", "int16" }, 2 },
    [UINT16] = { { "ushort", "uint16" }, 2 }, [INT32] = { { "int", "int32" }, 4 },     [UINT32] = { { "uint", "uint32" }, 4 },
    [FLOAT32] = { { "float", "float32" }, 4 }, [FLOAT64] = { { "double", "float64" }, 8 },
};

/* What a property of a vertex says. */
enum role { X, Y, Z, NX, NY, NZ, U, V, RED, GREEN, BLUE, ROLE_COUNT, NO_ROLE = ROLE_COUNT };
static const struct { const char *name; enum role role; } roles[] = {
    { "x", X }, { "y", Y }, { "z", Z }, { "nx", NX }, { "ny", NY }, { "nz", NZ },
    { "u", U }, { "v", V }, { "s", U }, { "t", V }, { "texture_u", U }, { "texture_v", V },
    { "red", RED }, { "green", GREEN }, { "blue", BLUE },
};

struct property { bool is_list, is_indices; enum type count_type, type; enum role role; };
struct element { char name[32]; uint64_t count; struct property properties[MAX_PROPERTIES]; size_t property_count; };

struct reader {
    const char *path, *at, *end;
    struct element elements[MAX_ELEMENTS];
    size_t element_count;
    bool binary, big_endian;
    char texture[256];
    struct mesh mesh;
    bool has[ROLE_COUNT];
    double color_sum[3];
    size_t triangle_capacity;
    struct error *err;
};

#define FAIL(r, ...) error_at((r)->err, ERR_INPUT, (r)->path, 0, 0, __VA_ARGS__)

/* --- header --- */

static bool find_type(enum type *type, const char *name)
{
    for (int i = 0; i < TYPE_COUNT; i++)
        if (!strcmp(name, types[i].names[0]) || !strcmp(name, types[i].names[1])) {
            *type = (enum type)i;
            return true;
        }
    return false;
}

static bool read_property(struct reader *r, const char *line)
{
    char count[16] = "", type[16] = "", name[32] = "";
    struct element *e = r->element_count ? &r->elements[r->element_count - 1] : NULL;
    struct property p = { .role = NO_ROLE };
    p.is_list = sscanf(line, "property list %15s %15s %31s", count, type, name) == 3;
    if (!p.is_list && sscanf(line, "property %15s %31s", type, name) != 2) return FAIL(r, "the PLY header has a property without type and name");
    if (!e || e->property_count == MAX_PROPERTIES) return FAIL(r, "the PLY header has properties of no element, or more than %d", MAX_PROPERTIES);
    if (!find_type(&p.type, type)) return FAIL(r, "the PLY header has a property of unknown type \"%s\"", type);
    if (p.is_list && (!find_type(&p.count_type, count) || p.count_type >= FLOAT32)) return FAIL(r, "the PLY header counts a list in \"%s\"", count);
    p.is_indices = p.is_list && (!strcmp(name, "vertex_indices") || !strcmp(name, "vertex_index"));
    for (size_t i = 0; !p.is_list && i < sizeof roles / sizeof *roles; i++)
        if (!strcmp(name, roles[i].name)) p.role = roles[i].role;
    e->properties[e->property_count++] = p;
    return true;
}

static bool read_header(struct reader *r)
{
    if (strncmp(r->at, "ply", 3) != 0 || !strchr("\r\n", r->at[3])) return FAIL(r, "is no PLY file: it has no header");
    for (const char *line = r->at; (line = strchr(line, '\n')) && *++line;) {
        char word[32] = "";
        sscanf(line, "%31s", word);
        if (!strcmp(word, "format")) {
            r->binary = !strncmp(line, "format binary", 13);
            r->big_endian = !strncmp(line, "format binary_big", 17);
        } else if (!strcmp(word, "comment")) {
            sscanf(line, "comment TextureFile %255[^\r\n]", r->texture);
        } else if (!strcmp(word, "element")) {
            struct element e = { .property_count = 0 };
            if (sscanf(line, "element %31s %" SCNu64, e.name, &e.count) != 2) return FAIL(r, "the PLY header has an element without a number");
            if (r->element_count == MAX_ELEMENTS) return FAIL(r, "the PLY header has more than %d elements", MAX_ELEMENTS);
            r->elements[r->element_count++] = e;
        } else if (!strcmp(word, "property")) {
            if (!read_property(r, line)) return false;
        } else if (!strcmp(word, "end_header")) {
            const char *end = strchr(line, '\n');
            r->at = end ? end + 1 : r->end;
            return true;
        }
    }
    return FAIL(r, "is no PLY file: it has no header");
}

/* --- data --- */

static bool read_binary(struct reader *r, double *value, enum type type)
{
    size_t size = types[type].size;
    unsigned char bytes[8];
    if (size > (size_t)(r->end - r->at)) return false;
    for (size_t i = 0; i < size; i++) bytes[i] = (unsigned char)r->at[r->big_endian ? size - 1 - i : i];
    r->at += size;
    int8_t i8;
    int16_t i16;
    uint16_t u16;
    int32_t i32;
    uint32_t u32;
    float f32;
    switch (type) {
    case INT8: memcpy(&i8, bytes, size); *value = i8; break;
    case UINT8: *value = bytes[0]; break;
    case INT16: memcpy(&i16, bytes, size); *value = i16; break;
    case UINT16: memcpy(&u16, bytes, size); *value = u16; break;
    case INT32: memcpy(&i32, bytes, size); *value = i32; break;
    case UINT32: memcpy(&u32, bytes, size); *value = u32; break;
    case FLOAT32: memcpy(&f32, bytes, size); *value = (double)f32; break;
    default: memcpy(value, bytes, size);
    }
    return true;
}

/* False where the file ends, or has something else than a number. */
static bool read_value(struct reader *r, double *value, enum type type)
{
    if (r->binary) return read_binary(r, value, type);
    char *end;
    *value = strtod(r->at, &end);
    if (end == r->at) return false;
    r->at = end;
    return true;
}

static bool add_triangle(struct reader *r, const uint32_t corner[3])
{
    struct mesh *m = &r->mesh;
    if (m->triangles == r->triangle_capacity) {
        size_t capacity = r->triangle_capacity ? 2 * r->triangle_capacity : 1024;
        void *grown = realloc(m->triangle, capacity * sizeof *m->triangle);
        if (!grown) return error_at(r->err, ERR_MEMORY, r->path, 0, 0, "no memory for this model");
        m->triangle = grown;
        r->triangle_capacity = capacity;
    }
    memcpy(m->triangle[m->triangles++], corner, sizeof *m->triangle);
    return true;
}

/* A polygon becomes a fan about its first corner. Out: *ended when the file ends first. */
static bool read_list(struct reader *r, bool *ended, const struct property *p)
{
    double count, value;
    uint32_t corner[3] = { 0 };
    if ((*ended = !read_value(r, &count, p->count_type))) return true;
    for (double i = 0; i < count; i++) {
        if ((*ended = !read_value(r, &value, p->type))) return true;
        if (!p->is_indices) continue;
        if (!(value >= 0 && value < (double)r->mesh.vertices)) return FAIL(r, "a face uses vertex %.0f of %zu", value, r->mesh.vertices);
        if (i == 0) corner[0] = (uint32_t)value;
        corner[1] = corner[2];
        corner[2] = (uint32_t)value;
        if (i >= 2 && !add_triangle(r, corner)) return false;
    }
    return true;
}

static void take(struct reader *r, uint64_t vertex, const double value[ROLE_COUNT])
{
    struct mesh *m = &r->mesh;
    for (int k = 0; k < 3; k++) {
        m->position_m[vertex][k] = (float)value[X + k];
        if (m->normal) m->normal[vertex][k] = (float)value[NX + k];
        r->color_sum[k] += value[RED + k];
    }
    if (m->uv) m->uv[vertex][0] = (float)value[U], m->uv[vertex][1] = (float)value[V];
}

static bool read_element(struct reader *r, const struct element *e, bool is_vertex)
{
    for (uint64_t i = 0; i < e->count; i++) {
        double value[ROLE_COUNT + 1] = { 0 };
        bool ended = false;
        for (size_t k = 0; k < e->property_count && !ended; k++) {
            const struct property *p = &e->properties[k];
            if (p->is_list) {
                if (!read_list(r, &ended, p)) return false;
                continue;
            }
            ended = !read_value(r, &value[p->role], p->type);
            if (p->role < RED || p->role > BLUE) continue;
            float c = (float)(p->type < FLOAT32 ? value[p->role] / 255 : value[p->role]);
            value[p->role] = (double)linear_from_srgb(c > 0 ? c < 1 ? c : 1 : 0);
        }
        if (ended) return FAIL(r, "is truncated, or has no number where one belongs: element \"%s\" %" PRIu64 " of %" PRIu64, e->name, i + 1, e->count);
        if (is_vertex) take(r, i, value);
    }
    return true;
}

static bool start_vertices(struct reader *r, const struct element *e)
{
    for (size_t k = 0; k < e->property_count; k++)
        if (e->properties[k].role != NO_ROLE) r->has[e->properties[k].role] = true;
    if (!r->has[X] || !r->has[Y] || !r->has[Z]) return FAIL(r, "the PLY header gives vertices no x, y and z");
    bool normals = r->has[NX] && r->has[NY] && r->has[NZ];
    return mesh_init(&r->mesh, (size_t)e->count, 0, normals, r->has[U] && r->has[V] && r->texture[0], r->err);
}

static bool read_elements(struct reader *r)
{
    bool has_vertices = false;
    for (size_t i = 0; i < r->element_count; i++) {
        const struct element *e = &r->elements[i];
        size_t left = (size_t)(r->end - r->at);
        bool is_vertex = !strcmp(e->name, "vertex");
        if (e->count > left) return FAIL(r, "the PLY header tells of %" PRIu64 " elements \"%s\", but only %zu bytes follow", e->count, e->name, left);
        if (is_vertex && has_vertices) return FAIL(r, "the PLY header has two elements \"vertex\"");
        if (is_vertex && !start_vertices(r, e)) return false;
        has_vertices |= is_vertex;
        if (!read_element(r, e, is_vertex)) return false;
    }
    return has_vertices || FAIL(r, "has no triangles");
}

static bool hand_over(struct reader *r, struct import *import)
{
    struct import_material *material = import_add_material(import, "", r->err);
    if (!material) return false;
    material->material.names_only = true;
    material->base_replaces_color = true;
    if (r->has[RED] && r->has[GREEN] && r->has[BLUE] && r->mesh.vertices)
        for (int k = 0; k < 3; k++) material->material.base_color[k] = r->color_sum[k] / (double)r->mesh.vertices;
    if (r->mesh.uv && (material->base = import_add_image(import, r->texture, r->err)) == NO_IMAGE) return false;
    return import_add_mesh(import, &r->mesh, r->err);
}

bool import_ply(struct import *import, const char *path, struct error *err)
{
    char *data;
    size_t size;
    if (!file_read(&data, &size, path, err)) return false;
    struct reader *r = calloc(1, sizeof *r);
    bool ok = r != NULL || error_set(err, ERR_MEMORY, "no memory for a model");
    if (r) {
        r->path = path;
        r->at = data;
        r->end = data + size;
        r->err = err;
        ok = read_header(r) && read_elements(r) && hand_over(r, import);
        mesh_release(&r->mesh);
    }
    free(r);
    free(data);
    return ok;
}
