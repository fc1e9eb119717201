/* A place from a PLY file. */
#include "gen/model/ply.h"
#include "gen/world/static_mesh_impl.h"
#include "lib/file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct reader {
    struct ply ply;
    struct static_mesh *mesh;
    size_t vertices;        /* that there will be */
    float (*uv)[2];         /* (vertices) or NULL */
    double *list;           /* (list_capacity) the list that was read last */
    size_t list_capacity;
    uint16_t textures[PLY_TEXTURES];
    struct error *err;
};

#define FAIL(r, ...) error_at((r)->err, ERR_INPUT, (r)->ply.path, 0, 0, __VA_ARGS__)

/* Out: role (property_count), has */
static void find_roles(enum ply_role *role, bool has[PLY_ROLE_COUNT], const struct ply_element *e)
{
    for (size_t k = 0; k < e->property_count; k++) {
        role[k] = ply_role(&e->properties[k]);
        has[role[k]] = true;
    }
}

/* Out: *count values in r->list. False, without an error, where the file ends. */
static bool read_list(struct reader *r, size_t *count, const struct ply_property *p)
{
    double n;
    if (!ply_read(&r->ply, &n, p->count_type)) return false;
    if (!(n >= 0 && n <= (double)(r->ply.end - r->ply.at))) return false;
    if ((size_t)n > r->list_capacity) {
        size_t capacity = 2 * (size_t)n;
        double *grown = realloc(r->list, capacity * sizeof *grown);
        if (!grown) return error_at(r->err, ERR_MEMORY, r->ply.path, 0, 0, "no memory for a list of %zu", capacity);
        r->list = grown;
        r->list_capacity = capacity;
    }
    *count = (size_t)n;
    for (size_t i = 0; i < *count; i++)
        if (!ply_read(&r->ply, &r->list[i], p->type)) return false;
    return true;
}

static bool read_vertices(struct reader *r, const struct ply_element *e)
{
    enum ply_role role[PLY_PROPERTIES];
    bool has[PLY_ROLE_COUNT] = { false };
    size_t count;
    find_roles(role, has, e);
    if (!has[PLY_X] || !has[PLY_Y] || !has[PLY_Z]) return FAIL(r, "the PLY header gives vertices no x, y and z");
    bool colored = has[PLY_RED] && has[PLY_GREEN] && has[PLY_BLUE];
    if (!static_mesh_reserve_vertices(r->mesh, (size_t)e->count, colored, r->err)) return false;
    if (has[PLY_U] && has[PLY_V] && r->ply.texture_count > 0 && !(r->uv = malloc(((size_t)e->count + 1) * sizeof *r->uv)))
        return error_set(r->err, ERR_MEMORY, "no memory for a mesh");
    for (uint64_t i = 0; i < e->count; i++) {
        double value[PLY_ROLE_COUNT] = { 0 };
        for (size_t k = 0; k < e->property_count; k++) {
            const struct ply_property *p = &e->properties[k];
            if (!(p->is_list ? read_list(r, &count, p) : ply_read(&r->ply, &value[role[k]], p->type)))
                return ply_truncated(&r->ply, e, i, r->err);
            if (role[k] >= PLY_RED && role[k] <= PLY_BLUE) value[role[k]] = ply_color(value[role[k]], p->type);
        }
        static_mesh_place(r->mesh, i, vec3(value[PLY_X], value[PLY_Y], value[PLY_Z]));
        for (int c = 0; colored && c < 3; c++) r->mesh->color[i][c] = static_srgb(value[PLY_RED + c]);
        if (r->uv) r->uv[i][0] = (float)value[PLY_U], r->uv[i][1] = (float)value[PLY_V];
    }
    r->mesh->vertices = (size_t)e->count;
    return true;
}

struct face {
    size_t corners, uvs;
    uint32_t *corner;   /* (corner_capacity) */
    double *uv;         /* (uvs) u, v of each corner */
    size_t corner_capacity, uv_capacity;
    double value[PLY_ROLE_COUNT];
};

static bool take_corners(struct reader *r, struct face *f, size_t n)
{
    if (n > f->corner_capacity) {
        uint32_t *grown = realloc(f->corner, n * sizeof *grown);
        if (!grown) return error_set(r->err, ERR_MEMORY, "no memory for a mesh");
        f->corner = grown;
        f->corner_capacity = n;
    }
    for (size_t i = 0; i < n; i++) {
        if (!(r->list[i] >= 0 && r->list[i] < (double)r->vertices)) return FAIL(r, "a face uses vertex %.0f of %zu", r->list[i], r->vertices);
        f->corner[i] = (uint32_t)r->list[i];
    }
    f->corners = n;
    return true;
}

static bool take_uvs(struct reader *r, struct face *f, size_t n)
{
    if (n > f->uv_capacity) {
        double *grown = realloc(f->uv, n * sizeof *grown);
        if (!grown) return error_set(r->err, ERR_MEMORY, "no memory for a mesh");
        f->uv = grown;
        f->uv_capacity = n;
    }
    if (n) memcpy(f->uv, r->list, n * sizeof *f->uv);
    f->uvs = n;
    return true;
}

/* A polygon becomes a fan about its first corner. */
static bool add_face(struct reader *r, const struct face *f, bool uv_of_face)
{
    struct static_mesh *m = r->mesh;
    if (f->corners < 3) return true;
    if (!static_mesh_reserve_triangles(m, m->triangles + f->corners - 2, r->err)) return false;
    bool textured = m->texture && (uv_of_face ? f->uvs == 2 * f->corners : r->uv != NULL);
    double number = f->value[PLY_TEXTURE];
    if (textured && !(number >= 0 && number < (double)r->ply.texture_count))
        return FAIL(r, "a face has texture %.0f of %zu", number, r->ply.texture_count);
    for (size_t i = 2; i < f->corners; i++, m->triangles++) {
        size_t pick[3] = { 0, i - 1, i };
        for (int c = 0; c < 3; c++) {
            uint32_t vertex = m->triangle[m->triangles][c] = f->corner[pick[c]];
            for (int k = 0; textured && k < 2; k++)
                m->uv[m->triangles][c][k] = uv_of_face ? (float)f->uv[2 * pick[c] + (size_t)k] : r->uv[vertex][k];
        }
        if (textured) m->texture[m->triangles] = r->textures[(int)number];
        if (m->label) m->label[m->triangles] = (int16_t)(f->value[PLY_LABEL] == STATIC_LABEL_UNKNOWN ? -1 : f->value[PLY_LABEL]);
        for (int c = 0; m->face_color && c < 3; c++) m->face_color[m->triangles][c] = static_srgb(f->value[PLY_RED + c]);
    }
    return true;
}

static bool read_face(struct reader *r, struct face *f, const struct ply_element *e, const enum ply_role *role, uint64_t index)
{
    f->corners = f->uvs = 0;
    for (size_t k = 0; k < e->property_count; k++) {
        const struct ply_property *p = &e->properties[k];
        size_t n;
        if (!(p->is_list ? read_list(r, &n, p) : ply_read(&r->ply, &f->value[role[k]], p->type)))
            return ply_truncated(&r->ply, e, index, r->err);
        if (role[k] >= PLY_RED && role[k] <= PLY_BLUE) f->value[role[k]] = ply_color(f->value[role[k]], p->type);
        if (ply_is_indices(p) && !take_corners(r, f, n)) return false;
        if (p->is_list && !strcmp(p->name, "texcoord") && !take_uvs(r, f, n)) return false;
    }
    if (!(f->value[PLY_LABEL] >= -1 && f->value[PLY_LABEL] <= STATIC_LABEL_UNKNOWN && f->value[PLY_LABEL] == floor(f->value[PLY_LABEL])))
        return FAIL(r, "face %llu has label %g: 0 to %d would be right", (unsigned long long)index, f->value[PLY_LABEL], STATIC_LABEL_UNKNOWN);
    return true;
}

static bool has_texcoord(const struct ply_element *e)
{
    for (size_t k = 0; k < e->property_count; k++)
        if (e->properties[k].is_list && !strcmp(e->properties[k].name, "texcoord")) return true;
    return false;
}

static bool read_faces(struct reader *r, const struct ply_element *e)
{
    enum ply_role role[PLY_PROPERTIES];
    bool has[PLY_ROLE_COUNT] = { false }, uv_of_face = has_texcoord(e) && r->ply.texture_count > 0;
    find_roles(role, has, e);
    if (!static_mesh_reserve_triangles(r->mesh, (size_t)e->count, r->err)) return false;
    if (has[PLY_LABEL] && !static_mesh_with_labels(r->mesh, r->err)) return false;
    if (has[PLY_RED] && has[PLY_GREEN] && has[PLY_BLUE] && !r->mesh->color && !static_mesh_with_face_colors(r->mesh, r->err)) return false;
    if (uv_of_face || r->uv) {
        if (!static_mesh_with_textures(r->mesh, r->err)) return false;
        for (size_t i = 0; i < r->ply.texture_count; i++)
            if (!static_mesh_read_texture(r->mesh, &r->textures[i], r->ply.path, r->ply.textures[i], r->err)) return false;
    }
    struct face face = { .value = { 0 } };
    for (uint64_t i = 0; i < e->count && r->err->code == ERR_OK; i++)
        if (read_face(r, &face, e, role, i)) add_face(r, &face, uv_of_face);
    free(face.corner);
    free(face.uv);
    return r->err->code == ERR_OK;
}

static bool skip_element(struct reader *r, const struct ply_element *e)
{
    double value;
    size_t count;
    for (uint64_t i = 0; i < e->count; i++)
        for (size_t k = 0; k < e->property_count; k++) {
            const struct ply_property *p = &e->properties[k];
            if (!(p->is_list ? read_list(r, &count, p) : ply_read(&r->ply, &value, p->type)))
                return ply_truncated(&r->ply, e, i, r->err);
        }
    return true;
}

static bool read_elements(struct reader *r)
{
    bool vertices = false, faces = false;
    for (size_t i = 0; i < r->ply.element_count; i++) {
        const struct ply_element *e = &r->ply.elements[i];
        bool is_vertex = !strcmp(e->name, "vertex"), is_face = !strcmp(e->name, "face");
        if (!ply_check_count(&r->ply, e, r->err)) return false;
        if ((is_vertex && vertices) || (is_face && faces)) return FAIL(r, "the PLY header has two elements \"%s\"", e->name);
        if (is_face && !vertices) return FAIL(r, "the PLY header has faces before vertices");
        if (is_vertex) r->vertices = (size_t)e->count;
        if (!(is_vertex ? read_vertices : is_face ? read_faces : skip_element)(r, e)) return false;
        vertices |= is_vertex;
        faces |= is_face;
    }
    return true;
}

bool static_mesh_read_ply(struct static_mesh *mesh, const char *path, struct error *err)
{
    char *data;
    size_t size;
    if (!file_read(&data, &size, path, err)) return false;
    struct reader *r = calloc(1, sizeof *r);
    bool ok = r != NULL || error_set(err, ERR_MEMORY, "no memory for a mesh");
    if (r) {
        r->mesh = mesh;
        r->err = err;
        ok = ply_open(&r->ply, path, data, size, err) && read_elements(r);
        free(r->uv);
        free(r->list);
    }
    free(r);
    free(data);
    return ok;
}
