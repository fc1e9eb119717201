/* PLY, ASCII and binary. Read here and not by assimp, whose PLY reader trusts the file's counts:
 * a file that ends early, as after a broken download, takes the process with it. */
#include "gen/model/model_import.h"
#include "gen/model/ply.h"
#include "lib/file.h"
#include "lib/image.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

struct reader {
    struct ply ply;
    struct mesh mesh;
    bool has[PLY_ROLE_COUNT];
    double color_sum[3];
    size_t triangle_capacity;
    struct error *err;
};

#define FAIL(r, ...) error_at((r)->err, ERR_INPUT, (r)->ply.path, 0, 0, __VA_ARGS__)

static bool add_triangle(struct reader *r, const uint32_t corner[3])
{
    struct mesh *m = &r->mesh;
    if (m->triangles == r->triangle_capacity) {
        size_t capacity = r->triangle_capacity ? 2 * r->triangle_capacity : 1024;
        void *grown = realloc(m->triangle, capacity * sizeof *m->triangle);
        if (!grown) return error_at(r->err, ERR_MEMORY, r->ply.path, 0, 0, "no memory for this model");
        m->triangle = grown;
        r->triangle_capacity = capacity;
    }
    memcpy(m->triangle[m->triangles++], corner, sizeof *m->triangle);
    return true;
}

/* A polygon becomes a fan about its first corner. Out: *ended when the file ends first. */
static bool read_list(struct reader *r, bool *ended, const struct ply_property *p)
{
    double count, value;
    uint32_t corner[3] = { 0 };
    bool is_indices = ply_is_indices(p);
    if ((*ended = !ply_read(&r->ply, &count, p->count_type))) return true;
    for (double i = 0; i < count; i++) {
        if ((*ended = !ply_read(&r->ply, &value, p->type))) return true;
        if (!is_indices) continue;
        if (!(value >= 0 && value < (double)r->mesh.vertices)) return FAIL(r, "a face uses vertex %.0f of %zu", value, r->mesh.vertices);
        if (i == 0) corner[0] = (uint32_t)value;
        corner[1] = corner[2];
        corner[2] = (uint32_t)value;
        if (i >= 2 && !add_triangle(r, corner)) return false;
    }
    return true;
}

static void take(struct reader *r, uint64_t vertex, const double value[PLY_ROLE_COUNT])
{
    struct mesh *m = &r->mesh;
    for (int k = 0; k < 3; k++) {
        m->position_m[vertex][k] = (float)value[PLY_X + k];
        if (m->normal) m->normal[vertex][k] = (float)value[PLY_NX + k];
        r->color_sum[k] += value[PLY_RED + k];
    }
    if (m->uv) m->uv[vertex][0] = (float)value[PLY_U], m->uv[vertex][1] = (float)value[PLY_V];
}

static bool read_element(struct reader *r, const struct ply_element *e, bool is_vertex)
{
    enum ply_role role[PLY_PROPERTIES];
    for (size_t k = 0; k < e->property_count; k++) role[k] = ply_role(&e->properties[k]);
    for (uint64_t i = 0; i < e->count; i++) {
        double value[PLY_ROLE_COUNT] = { 0 };
        bool ended = false;
        for (size_t k = 0; k < e->property_count && !ended; k++) {
            const struct ply_property *p = &e->properties[k];
            if (p->is_list) {
                if (!read_list(r, &ended, p)) return false;
                continue;
            }
            ended = !ply_read(&r->ply, &value[role[k]], p->type);
            if (role[k] >= PLY_RED && role[k] <= PLY_BLUE)
                value[role[k]] = (double)linear_from_srgb((float)ply_color(value[role[k]], p->type));
        }
        if (ended) return ply_truncated(&r->ply, e, i, r->err);
        if (is_vertex) take(r, i, value);
    }
    return true;
}

static bool start_vertices(struct reader *r, const struct ply_element *e)
{
    for (size_t k = 0; k < e->property_count; k++)
        r->has[ply_role(&e->properties[k])] = true;
    if (!r->has[PLY_X] || !r->has[PLY_Y] || !r->has[PLY_Z]) return FAIL(r, "the PLY header gives vertices no x, y and z");
    bool normals = r->has[PLY_NX] && r->has[PLY_NY] && r->has[PLY_NZ];
    return mesh_init(&r->mesh, (size_t)e->count, 0, normals, r->has[PLY_U] && r->has[PLY_V] && r->ply.texture_count > 0, r->err);
}

static bool read_elements(struct reader *r)
{
    bool has_vertices = false;
    for (size_t i = 0; i < r->ply.element_count; i++) {
        const struct ply_element *e = &r->ply.elements[i];
        bool is_vertex = !strcmp(e->name, "vertex");
        if (!ply_check_count(&r->ply, e, r->err)) return false;
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
    if (r->has[PLY_RED] && r->has[PLY_GREEN] && r->has[PLY_BLUE] && r->mesh.vertices)
        for (int k = 0; k < 3; k++) material->material.base_color[k] = r->color_sum[k] / (double)r->mesh.vertices;
    if (r->mesh.uv && (material->base = import_add_image(import, r->ply.textures[0], r->err)) == NO_IMAGE) return false;
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
        r->err = err;
        ok = ply_open(&r->ply, path, data, size, err) && read_elements(r) && hand_over(r, import);
        mesh_release(&r->mesh);
    }
    free(r);
    free(data);
    return ok;
}
