/* glTF 2.0: nodes, skins and materials of what gltf.h read.
 * Src: Khronos, glTF 2.0 Specification, 3.5 to 3.9 and 5 */
#include "gen/model/gltf.h"
#include "gen/model/model_import.h"
#include "lib/file.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* An affine map: p -> rows of a with the fourth column as translation. */
struct affine { double a[3][4]; };

static const struct affine affine_identity = { { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 } } };

static struct affine affine_multiply(const struct affine *m, const struct affine *n)
{
    struct affine p;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            p.a[i][j] = m->a[i][0] * n->a[0][j] + m->a[i][1] * n->a[1][j] + m->a[i][2] * n->a[2][j] + (j == 3 ? m->a[i][3] : 0);
    return p;
}

static struct affine affine_from_columns(const double m[16])
{
    struct affine p;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++) p.a[i][j] = m[4 * j + i];
    return p;
}

static double affine_determinant(const struct affine *m)
{
    return m->a[0][0] * (m->a[1][1] * m->a[2][2] - m->a[1][2] * m->a[2][1]) -
           m->a[0][1] * (m->a[1][0] * m->a[2][2] - m->a[1][2] * m->a[2][0]) +
           m->a[0][2] * (m->a[1][0] * m->a[2][1] - m->a[1][1] * m->a[2][0]);
}

static void move_point(float out[3], const struct affine *m, const float p[3])
{
    double q[3];
    for (int i = 0; i < 3; i++)
        q[i] = m->a[i][0] * (double)p[0] + m->a[i][1] * (double)p[1] + m->a[i][2] * (double)p[2] + m->a[i][3];
    for (int i = 0; i < 3; i++) out[i] = (float)q[i];
}

/* Normals go by the inverse transpose: the matrix of cofactors, but for a positive factor. */
static void move_normal(float out[3], const struct affine *m, const float n[3])
{
    double q[3], sign = affine_determinant(m) < 0 ? -1 : 1;
    for (int i = 0; i < 3; i++) {
        const double *b = m->a[(i + 1) % 3], *c = m->a[(i + 2) % 3];
        q[i] = sign * ((b[1] * c[2] - b[2] * c[1]) * (double)n[0] + (b[2] * c[0] - b[0] * c[2]) * (double)n[1] +
                       (b[0] * c[1] - b[1] * c[0]) * (double)n[2]);
    }
    double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2]);
    for (int i = 0; i < 3; i++) out[i] = length > 0 ? (float)(q[i] / length) : 0;
}

struct loader {
    struct import *import;
    const struct gltf *gltf;
    const char *path;
    struct affine *local, *world;  /* (nodes) */
    int *parent;                   /* (nodes), -1 for a root */
    int default_material;          /* index in import, -1 until needed */
    struct error *err;
};

#define FAIL(l, ...) error_at((l)->err, ERR_INPUT, (l)->path, 0, 0, __VA_ARGS__)

static bool no_memory(struct loader *l)
{
    return error_at(l->err, ERR_MEMORY, l->path, 0, 0, "no memory for this model");
}

/* --- accessors --- */

static size_t component_size(int component)
{
    switch (component) {
    case GLTF_I8: case GLTF_U8: return 1;
    case GLTF_I16: case GLTF_U16: return 2;
    case GLTF_U32: case GLTF_F32: return 4;
    default: return 0;
    }
}

static double component_value(const uint8_t *p, int component, bool normalized)
{
    int8_t i8;
    int16_t i16;
    uint16_t u16;
    uint32_t u32;
    float f32;
    switch (component) {
    case GLTF_I8: memcpy(&i8, p, 1); return normalized ? fmax(i8 / 127.0, -1) : i8;
    case GLTF_U8: return normalized ? *p / 255.0 : *p;
    case GLTF_I16: memcpy(&i16, p, 2); return normalized ? fmax(i16 / 32767.0, -1) : i16;
    case GLTF_U16: memcpy(&u16, p, 2); return normalized ? u16 / 65535.0 : u16;
    case GLTF_U32: memcpy(&u32, p, 4); return u32;
    default: memcpy(&f32, p, 4); return (double)f32;
    }
}

/* The first byte of `count` elements in a view, having checked that they all lie in it. */
static const uint8_t *elements(struct loader *l, int view, size_t offset, size_t count, size_t element, size_t *stride)
{
    const struct gltf *g = l->gltf;
    if (view < 0 || (size_t)view >= g->view_count) {
        FAIL(l, "refers to buffer view %d of %zu", view, g->view_count);
        return NULL;
    }
    const struct gltf_view *v = &g->views[view];
    if (v->buffer < 0 || (size_t)v->buffer >= g->buffer_count) {
        FAIL(l, "buffer view %d refers to buffer %d of %zu", view, v->buffer, g->buffer_count);
        return NULL;
    }
    const struct gltf_buffer *b = &g->buffers[v->buffer];
    *stride = v->stride ? v->stride : element;
    if (v->offset > b->size || v->size > b->size - v->offset) {
        FAIL(l, "buffer view %d reaches beyond its buffer of %zu bytes", view, b->size);
        return NULL;
    }
    if (count && (element > v->size || offset > v->size - element || (count - 1) > (v->size - element - offset) / *stride)) {
        FAIL(l, "buffer view %d of %zu bytes is too short for %zu elements", view, v->size, count);
        return NULL;
    }
    return b->data + v->offset + offset;
}

static const struct gltf_accessor *accessor_of(struct loader *l, int accessor, int components, const char *what)
{
    if (accessor < 0 || (size_t)accessor >= l->gltf->accessor_count) {
        FAIL(l, "%s: accessor %d of %zu does not exist", what, accessor, l->gltf->accessor_count);
        return NULL;
    }
    const struct gltf_accessor *a = &l->gltf->accessors[accessor];
    if (a->components != components || !component_size(a->component)) {
        FAIL(l, "%s: accessor %d has the wrong type", what, accessor);
        return NULL;
    }
    if (a->count > UINT32_MAX / 16) {
        FAIL(l, "%s: accessor %d tells of %zu elements", what, accessor, a->count);
        return NULL;
    }
    return a;
}

/* All values of an accessor as doubles, (count, components). The caller frees; NULL on failure. */
static double *read_accessor(struct loader *l, size_t *count, int accessor, int components, const char *what)
{
    const struct gltf_accessor *a = accessor_of(l, accessor, components, what);
    if (!a) return NULL;
    size_t n = (size_t)components, size = component_size(a->component), stride = 0;
    const uint8_t *from = NULL;
    if (a->view >= 0 && !(from = elements(l, a->view, a->offset, a->count, n * size, &stride))) goto fail;
    if (!from && !a->sparse) {
        FAIL(l, "accessor %d has no data", accessor);
        goto fail;
    }
    const uint8_t *index = NULL, *value = NULL;
    size_t index_stride = 0, value_stride = 0, index_size = component_size(a->sparse_index_component);
    if (a->sparse) {
        if (a->sparse_count > a->count || !index_size || a->sparse_index_component == GLTF_F32) {
            FAIL(l, "accessor %d is sparse in a way that is not possible", accessor);
            goto fail;
        }
        if (!(index = elements(l, a->sparse_index_view, a->sparse_index_offset, a->sparse_count, index_size, &index_stride)) ||
            !(value = elements(l, a->sparse_value_view, a->sparse_value_offset, a->sparse_count, n * size, &value_stride))) goto fail;
    }
    double *out = calloc(a->count * n + 1, sizeof *out);
    if (!out) {
        no_memory(l);
        return NULL;
    }
    for (size_t i = 0; from && i < a->count; i++)
        for (size_t k = 0; k < n; k++)
            out[i * n + k] = component_value(from + i * stride + k * size, a->component, a->normalized);
    for (size_t i = 0; a->sparse && i < a->sparse_count; i++) {
        double at = component_value(index + i * index_stride, a->sparse_index_component, false);
        if (at < 0 || at >= (double)a->count) {
            FAIL(l, "accessor %d: sparse index %.0f of %zu", accessor, at, a->count);
            free(out);
            return NULL;
        }
        for (size_t k = 0; k < n; k++)
            out[(size_t)at * n + k] = component_value(value + i * value_stride + k * size, a->component, a->normalized);
    }
    *count = a->count;
    return out;
fail:
    error_prefix(l->err, "%s: ", what);
    return NULL;
}

/* --- nodes --- */

static struct affine affine_from_trs(const double t[3], const double r[4], const double s[3])
{
    double n = sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3]);
    double x = r[0] / n, y = r[1] / n, z = r[2] / n, w = r[3] / n;
    double m[3][3] = { { 1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y) },
                       { 2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x) },
                       { 2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y) } };
    struct affine p;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++) p.a[i][j] = j < 3 ? m[i][j] * s[j] : t[i];
    return p;
}

/* What the first animation says at time 0: key times are not negative, so the first key. */
static bool pose_nodes(struct loader *l, struct gltf_node *nodes)
{
    static const char *const what[] = { "animated translation", "animated rotation", "animated scale" };
    for (size_t i = 0; i < l->gltf->channel_count; i++) {
        const struct gltf_channel *c = &l->gltf->channels[i];
        if (c->node < 0) continue; /* by the specification: to be ignored */
        if ((size_t)c->node >= l->gltf->node_count) return FAIL(l, "animation: node %d of %zu does not exist", c->node, l->gltf->node_count);
        size_t count, n = c->path == GLTF_ROTATION ? 4 : 3, at = c->cubic ? 1 : 0; /* cubic: in-tangent, value, out-tangent */
        double *values = read_accessor(l, &count, c->output, (int)n, what[c->path]);
        if (!values) return false;
        if (count <= at) {
            free(values);
            return FAIL(l, "%s: no keys", what[c->path]);
        }
        struct gltf_node *node = &nodes[c->node];
        double *to = c->path == GLTF_TRANSLATION ? node->translation : c->path == GLTF_ROTATION ? node->rotation : node->scale;
        memcpy(to, values + at * n, n * sizeof *to);
        node->has_matrix = false;
        free(values);
    }
    return true;
}

static bool place_nodes(struct loader *l)
{
    const struct gltf *g = l->gltf;
    size_t n = g->node_count;
    struct gltf_node *nodes = malloc((n + 1) * sizeof *nodes);
    l->local = malloc((n + 1) * sizeof *l->local);
    l->world = malloc((n + 1) * sizeof *l->world);
    l->parent = malloc((n + 1) * sizeof *l->parent);
    if (!nodes || !l->local || !l->world || !l->parent) {
        no_memory(l);
        goto out;
    }
    if (n) memcpy(nodes, g->nodes, n * sizeof *nodes);
    if (!pose_nodes(l, nodes)) goto out;
    for (size_t i = 0; i < n; i++) {
        const double *r = nodes[i].rotation;
        if (!nodes[i].has_matrix && !(r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3] > 1e-12)) {
            FAIL(l, "node %zu: a rotation of norm zero", i);
            goto out;
        }
        l->local[i] = nodes[i].has_matrix ? affine_from_columns(nodes[i].matrix) : affine_from_trs(nodes[i].translation, r, nodes[i].scale);
        l->parent[i] = -1;
    }
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < nodes[i].child_count; k++) {
            int child = nodes[i].children[k];
            if (child < 0 || (size_t)child >= n) {
                FAIL(l, "node %zu: child %d of %zu does not exist", i, child, n);
                goto out;
            }
            if (l->parent[child] >= 0) {
                FAIL(l, "node %d has two parents", child);
                goto out;
            }
            l->parent[child] = (int)i;
        }
    for (size_t i = 0; i < n; i++) {
        l->world[i] = l->local[i];
        size_t depth = 0;
        for (int p = l->parent[i]; p >= 0; p = l->parent[p]) {
            if (++depth > n) {
                FAIL(l, "node %zu is its own ancestor", i);
                goto out;
            }
            l->world[i] = affine_multiply(&l->local[p], &l->world[i]);
        }
    }
out:
    free(nodes);
    return l->err->code == ERR_OK;
}

/* --- skins --- */

/* Where each joint takes a vertex of the mesh: its place now, times its inverse place when bound. */
static struct affine *joint_matrices(struct loader *l, size_t *count, int skin)
{
    if ((size_t)skin >= l->gltf->skin_count) {
        FAIL(l, "skin %d of %zu does not exist", skin, l->gltf->skin_count);
        return NULL;
    }
    const struct gltf_skin *s = &l->gltf->skins[skin];
    struct affine *out = malloc((s->joint_count + 1) * sizeof *out);
    double *inverse = NULL;
    size_t inverse_count = 0;
    if (!out) {
        no_memory(l);
        return NULL;
    }
    if (s->inverse_bind >= 0 && !(inverse = read_accessor(l, &inverse_count, s->inverse_bind, 16, "inverse bind matrices"))) goto fail;
    if (inverse && inverse_count < s->joint_count) {
        FAIL(l, "skin %d: %zu inverse bind matrices for %zu joints", skin, inverse_count, s->joint_count);
        goto fail;
    }
    for (size_t i = 0; i < s->joint_count; i++) {
        if (s->joints[i] < 0 || (size_t)s->joints[i] >= l->gltf->node_count) {
            FAIL(l, "skin %d: joint node %d of %zu does not exist", skin, s->joints[i], l->gltf->node_count);
            goto fail;
        }
        struct affine bind = inverse ? affine_from_columns(inverse + 16 * i) : affine_identity;
        out[i] = affine_multiply(&l->world[s->joints[i]], &bind);
    }
    free(inverse);
    *count = s->joint_count;
    return out;
fail:
    free(inverse);
    free(out);
    return NULL;
}

/* One map for each vertex: the weighted sum of its joints'. */
static struct affine *blend_joints(struct loader *l, const struct gltf_primitive *p, size_t vertices, int skin)
{
    size_t joint_count = 0;
    struct affine *joint = joint_matrices(l, &joint_count, skin);
    if (!joint) return NULL;
    struct affine *out = calloc(vertices + 1, sizeof *out);
    double *total = calloc(vertices + 1, sizeof *total);
    if (!out || !total) no_memory(l);
    for (int set = 0; l->err->code == ERR_OK && set < GLTF_JOINT_SETS && p->joints[set] >= 0; set++) {
        size_t joints_read = 0, weights_read = 0;
        double *index = read_accessor(l, &joints_read, p->joints[set], 4, "joints");
        double *weight = index ? read_accessor(l, &weights_read, p->weights[set], 4, "joint weights") : NULL;
        if (weight && (joints_read != vertices || weights_read != vertices))
            FAIL(l, "joints and weights are not as many as the vertices (%zu)", vertices);
        for (size_t i = 0; l->err->code == ERR_OK && i < 4 * vertices; i++) {
            if (weight[i] == 0) continue;
            if (!(index[i] < (double)joint_count)) FAIL(l, "joints: vertex %zu uses joint %.0f of %zu", i / 4, index[i], joint_count);
            else if (!(weight[i] > 0)) FAIL(l, "joint weights: vertex %zu has a negative one", i / 4);
            else {
                const struct affine *m = &joint[(size_t)index[i]];
                for (int r = 0; r < 3; r++)
                    for (int c = 0; c < 4; c++) out[i / 4].a[r][c] += weight[i] * m->a[r][c];
                total[i / 4] += weight[i];
            }
        }
        free(index);
        free(weight);
    }
    for (size_t i = 0; l->err->code == ERR_OK && i < vertices; i++) {
        if (!(total[i] > 0)) FAIL(l, "joint weights: vertex %zu has none", i);
        for (int r = 0; r < 3; r++)
            for (int c = 0; c < 4; c++) out[i].a[r][c] /= total[i];
    }
    free(total);
    free(joint);
    if (l->err->code == ERR_OK) return out;
    free(out);
    return NULL;
}

/* --- meshes --- */

/* The primitive's corners as a list, three to a triangle, whatever its mode. */
static uint32_t (*read_triangles(struct loader *l, size_t *triangles, const struct gltf_primitive *p, size_t vertices))[3]
{
    double *index = NULL;
    size_t n = vertices;
    if (p->indices >= 0 && !(index = read_accessor(l, &n, p->indices, 1, "indices"))) return NULL;
    size_t count = p->mode == GLTF_TRIANGLES ? n / 3 : n > 2 ? n - 2 : 0;
    uint32_t(*out)[3] = malloc((count + 1) * sizeof *out);
    if (!out) no_memory(l);
    for (size_t i = 0; index && i < n && l->err->code == ERR_OK; i++)
        if (!(index[i] >= 0 && index[i] < (double)vertices)) FAIL(l, "index %zu is %.0f, but there are %zu vertices", i, index[i], vertices);
    if (p->mode == GLTF_TRIANGLES && n % 3) FAIL(l, "triangles of %zu corners: a multiple of 3 would be right", n);
    if (l->err->code != ERR_OK) {
        free(index);
        free(out);
        return NULL;
    }
    for (size_t i = 0; i < count; i++) {
        size_t odd = i & 1;
        size_t corner[3] = { 3 * i, 3 * i + 1, 3 * i + 2 };
        if (p->mode == GLTF_STRIP) corner[0] = i, corner[1] = i + 1 + odd, corner[2] = i + 2 - odd;
        if (p->mode == GLTF_FAN) corner[0] = i + 1, corner[1] = i + 2, corner[2] = 0;
        for (int k = 0; k < 3; k++) out[i][k] = index ? (uint32_t)index[corner[k]] : (uint32_t)corner[k];
    }
    free(index);
    *triangles = count;
    return out;
}

static const struct gltf_texture *texture_of(const struct loader *l, const struct gltf_texture_use *use)
{
    return use->texture >= 0 && (size_t)use->texture < l->gltf->texture_count ? &l->gltf->textures[use->texture] : NULL;
}

/* Texture positions as we keep them: v up, and KHR_texture_transform applied. */
static bool read_uv(struct loader *l, struct mesh *mesh, const struct gltf_primitive *p, const struct gltf_texture_use *use)
{
    const struct gltf_texture *texture = texture_of(l, use);
    int set = use->uv_set;
    if (set < 0 || set >= GLTF_UV_SETS || p->uv[set] < 0) return FAIL(l, "a textured primitive has no TEXCOORD_%d (0 to %d are read)", set, GLTF_UV_SETS - 1);
    size_t count;
    double *uv = read_accessor(l, &count, p->uv[set], 2, "texture positions");
    if (!uv) return false;
    if (count != mesh->vertices) FAIL(l, "%zu texture positions for %zu vertices", count, mesh->vertices);
    double c = cos(use->rotation_rad), s = sin(use->rotation_rad);
    for (size_t i = 0; l->err->code == ERR_OK && i < count; i++) {
        double u = uv[2 * i] * use->scale[0], v = uv[2 * i + 1] * use->scale[1];
        double at[2] = { use->offset[0] + c * u + s * v, use->offset[1] - s * u + c * v };
        int wrap[2] = { texture->wrap_u, texture->wrap_v };
        for (int k = 0; k < 2; k++) {
            bool outside = at[k] < -1e-4 || at[k] > 1 + 1e-4;
            if (outside && wrap[k] == GLTF_MIRROR) FAIL(l, "a texture repeats mirrored, which is not supported: repeat it in the image");
            if (wrap[k] == GLTF_CLAMP) at[k] = fmin(fmax(at[k], 0), 1);
        }
        mesh->uv[i][0] = (float)at[0];
        mesh->uv[i][1] = (float)(1 - at[1]);
    }
    free(uv);
    return l->err->code == ERR_OK;
}

static bool add_primitive(struct loader *l, const struct gltf_primitive *p, const struct affine *world, int skin)
{
    if (p->mode < GLTF_TRIANGLES || p->mode > GLTF_FAN) return true; /* points and lines have no surface */
    if (p->material >= 0 && (size_t)p->material >= l->gltf->material_count) return FAIL(l, "material %d of %zu does not exist", p->material, l->gltf->material_count);
    bool ok = false;
    size_t vertices = 0, triangles = 0, normals = 0;
    struct mesh mesh = { 0 };
    double *normal = NULL;
    uint32_t(*triangle)[3] = NULL;
    struct affine *blended = NULL;
    const struct gltf_texture_use *base = p->material >= 0 ? &l->gltf->materials[p->material].base : NULL;
    bool textured = base && texture_of(l, base);
    double *position = read_accessor(l, &vertices, p->position, 3, "positions");
    if (!position) goto out;
    if (p->normal >= 0 && !(normal = read_accessor(l, &normals, p->normal, 3, "normals"))) goto out;
    if (normal && normals != vertices) {
        FAIL(l, "%zu normals for %zu vertices", normals, vertices);
        goto out;
    }
    if (!(triangle = read_triangles(l, &triangles, p, vertices))) goto out;
    if (skin >= 0 && p->joints[0] >= 0 && !(blended = blend_joints(l, p, vertices, skin))) goto out;
    if (!mesh_init(&mesh, vertices, triangles, normal, textured, l->err)) goto out;
    if (textured && !read_uv(l, &mesh, p, base)) goto out;
    for (size_t i = 0; i < vertices; i++) {
        const struct affine *m = blended ? &blended[i] : world;
        float at[3] = { (float)position[3 * i], (float)position[3 * i + 1], (float)position[3 * i + 2] };
        move_point(mesh.position_m[i], m, at);
        if (!normal) continue;
        float n[3] = { (float)normal[3 * i], (float)normal[3 * i + 1], (float)normal[3 * i + 2] };
        move_normal(mesh.normal[i], m, n);
    }
    for (size_t i = 0; i < triangles; i++) {
        const struct affine *m = blended ? &blended[triangle[i][0]] : world;
        bool mirrored = affine_determinant(m) < 0;
        mesh.triangle[i][0] = triangle[i][0];
        mesh.triangle[i][1] = triangle[i][mirrored ? 2 : 1];
        mesh.triangle[i][2] = triangle[i][mirrored ? 1 : 2];
    }
    if (p->material < 0 && l->default_material < 0) {
        l->default_material = (int)l->import->material_count;
        struct import_material *made = import_add_material(l->import, "", l->err);
        if (!made) goto out;
        made->material.names_only = true;
    }
    mesh.material = (size_t)(p->material >= 0 ? p->material : l->default_material);
    ok = import_add_mesh(l->import, &mesh, l->err);
out:
    mesh_release(&mesh);
    free(position);
    free(normal);
    free(triangle);
    free(blended);
    return ok;
}

static bool add_node(struct loader *l, int node)
{
    const struct gltf *g = l->gltf;
    if (node < 0 || (size_t)node >= g->node_count) return FAIL(l, "scene: node %d of %zu does not exist", node, g->node_count);
    const struct gltf_node *n = &g->nodes[node];
    if (n->mesh >= 0) {
        if ((size_t)n->mesh >= g->mesh_count) return FAIL(l, "node %d: mesh %d of %zu does not exist", node, n->mesh, g->mesh_count);
        const struct gltf_mesh *mesh = &g->meshes[n->mesh];
        for (size_t i = 0; i < mesh->primitive_count; i++) {
            if (mesh->primitives[i].has_targets && (mesh->is_morphed || n->is_morphed))
                return FAIL(l, "mesh %d is shaped by morph targets, which is not supported: export the shape itself", n->mesh);
            if (!add_primitive(l, &mesh->primitives[i], &l->world[node], n->skin)) return error_prefix(l->err, "mesh %d: ", n->mesh);
        }
    }
    for (size_t i = 0; i < n->child_count; i++)
        if (!add_node(l, n->children[i])) return false;
    return true;
}

/* --- materials --- */

/* The import's index of a texture's image; images keep their order. */
static bool use_image(struct loader *l, int *image, const struct gltf_texture_use *use)
{
    *image = NO_IMAGE;
    if (use->texture < 0) return true;
    if ((size_t)use->texture >= l->gltf->texture_count) return FAIL(l, "texture %d of %zu does not exist", use->texture, l->gltf->texture_count);
    int source = l->gltf->textures[use->texture].image;
    if (source < 0) return true; /* an image of an extension's format */
    if ((size_t)source >= l->gltf->image_count) return FAIL(l, "image %d of %zu does not exist", source, l->gltf->image_count);
    *image = source;
    return true;
}

static int hex(char c)
{
    return c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/* %20 and the like. */
static void decode_uri(char *uri)
{
    char *to = uri;
    for (const char *from = uri; *from; from++) {
        if (from[0] == '%' && hex(from[1]) >= 0 && hex(from[2]) >= 0) {
            *to++ = (char)(16 * hex(from[1]) + hex(from[2]));
            from += 2;
        } else {
            *to++ = *from;
        }
    }
    *to = 0;
}

static bool add_images(struct loader *l)
{
    const struct gltf *g = l->gltf;
    l->import->images = calloc(g->image_count + 1, sizeof *l->import->images);
    if (!l->import->images) return no_memory(l);
    l->import->image_count = g->image_count;
    for (size_t i = 0; i < g->image_count; i++) {
        struct import_image *to = &l->import->images[i];
        const struct gltf_image *from = &g->images[i];
        const uint8_t *data = from->data;
        to->name = from->uri ? strdup(from->uri) : string_format("embedded image %zu", i);
        if (!to->name) return no_memory(l);
        if (from->uri) {
            decode_uri(to->name);
            continue;
        }
        to->size = from->size;
        if (from->view >= 0 && (size_t)from->view < g->view_count) {
            size_t stride;
            to->size = g->views[from->view].size;
            data = elements(l, from->view, 0, to->size, 1, &stride);
        }
        if (!data) {
            FAIL(l, "has no data");
            return error_prefix(l->err, "image %zu: ", i);
        }
        if (!(to->data = malloc(to->size + 1))) return no_memory(l);
        memcpy(to->data, data, to->size);
    }
    return true;
}

static double unit(double x)
{
    return x > 0 ? x < 1 ? x : 1 : 0;
}

static bool add_materials(struct loader *l)
{
    for (size_t i = 0; i < l->gltf->material_count; i++) {
        const struct gltf_material *from = &l->gltf->materials[i];
        struct import_material *to = import_add_material(l->import, from->name, l->err);
        if (!to) return false;
        struct material *m = &to->material;
        m->names_only = !from->has_figures;
        for (int k = 0; k < 3; k++) {
            m->base_color[k] = unit(from->base_color[k]);
            m->emissive[k] = fmax(from->emissive[k], 0);
        }
        m->alpha = unit(from->base_color[3]);
        m->alpha_mode = !strcmp(from->alpha_mode, "MASK") ? ALPHA_MASK : !strcmp(from->alpha_mode, "BLEND") ? ALPHA_BLEND : ALPHA_OPAQUE;
        m->alpha_cutoff = from->alpha_cutoff;
        m->metallic = from->has_figures ? unit(from->metallic) : 0;
        m->roughness = unit(from->roughness);
        m->clearcoat = unit(from->clearcoat);
        m->clearcoat_roughness = unit(from->clearcoat_roughness);
        m->transmission = unit(from->transmission);
        m->ior = from->ior >= 1 && from->ior <= 3 ? from->ior : 1.5;
        if (!use_image(l, &to->base, &from->base) || !use_image(l, &to->metallic_roughness, &from->metallic_roughness) ||
            !use_image(l, &to->emissive, &from->emissive_texture))
            return error_prefix(l->err, "material %zu: ", i);
    }
    return true;
}

bool import_gltf(struct import *import, const char *path, struct error *err)
{
    struct gltf gltf;
    if (!gltf_read(&gltf, path, err)) return false;
    struct loader l = { .import = import, .gltf = &gltf, .path = path, .default_material = -1, .err = err };
    bool ok = add_images(&l) && add_materials(&l) && place_nodes(&l);
    for (size_t i = 0; ok && i < gltf.root_count; i++) ok = add_node(&l, gltf.roots[i]);
    import->unit_m = 1;
    free(l.local);
    free(l.world);
    free(l.parent);
    gltf_release(&gltf);
    return ok;
}
