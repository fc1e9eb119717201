#include "gen/world/static_mesh_impl.h"

#include "lib/file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define CELLS_MAX 1e9 /* along an axis */
#define TRIANGLES_MAX ((size_t)1 << 31)

/* --- arrays --- */

static bool resize(void *array, size_t count, size_t element, struct error *err)
{
    void **at = array, *grown = realloc(*at, count * element);
    if (!grown) return error_set(err, ERR_MEMORY, "no memory for a mesh of %zu", count);
    *at = grown;
    return true;
}

bool static_mesh_reserve_vertices(struct static_mesh *mesh, size_t vertices, bool with_color, struct error *err)
{
    if (vertices >= UINT32_MAX) return error_set(err, ERR_INPUT, "has %zu vertices, more than 2^32", vertices);
    if (!resize(&mesh->position_m, vertices + 1, sizeof *mesh->position_m, err)) return false;
    memset(mesh->position_m[vertices], 0, sizeof *mesh->position_m);
    if (mesh->vertex_label && !resize(&mesh->vertex_label, vertices + 1, sizeof *mesh->vertex_label, err)) return false;
    return !with_color || resize(&mesh->color, vertices + 1, sizeof *mesh->color, err);
}

bool static_mesh_reserve_triangles(struct static_mesh *mesh, size_t triangles, struct error *err)
{
    if (triangles <= mesh->triangle_capacity) return true;
    if (triangles > TRIANGLES_MAX) return error_set(err, ERR_INPUT, "has more than 2^31 triangles");
    size_t n = mesh->triangle_capacity + mesh->triangle_capacity / 2;
    if (n < triangles) n = triangles;
    if (!resize(&mesh->triangle, n, sizeof *mesh->triangle, err)) return false;
    if (mesh->label && !resize(&mesh->label, n, sizeof *mesh->label, err)) return false;
    if (mesh->face_color && !resize(&mesh->face_color, n, sizeof *mesh->face_color, err)) return false;
    if (mesh->texture && !resize(&mesh->texture, n, sizeof *mesh->texture, err)) return false;
    if (mesh->uv && !resize(&mesh->uv, n, sizeof *mesh->uv, err)) return false;
    for (size_t i = mesh->triangle_capacity; i < n; i++) {
        if (mesh->label) mesh->label[i] = -1;
        if (mesh->face_color) memset(mesh->face_color[i], 0, sizeof mesh->face_color[i]);
        if (mesh->texture) mesh->texture[i] = STATIC_NO_TEXTURE;
        if (mesh->uv) memset(mesh->uv[i], 0, sizeof mesh->uv[i]);
    }
    mesh->triangle_capacity = n;
    return true;
}

bool static_mesh_with_labels(struct static_mesh *mesh, struct error *err)
{
    if (mesh->label) return true;
    if (!resize(&mesh->label, mesh->triangle_capacity + 1, sizeof *mesh->label, err)) return false;
    for (size_t i = 0; i < mesh->triangle_capacity; i++) mesh->label[i] = -1;
    return true;
}

bool static_mesh_with_face_colors(struct static_mesh *mesh, struct error *err)
{
    if (mesh->face_color) return true;
    mesh->face_color = calloc(mesh->triangle_capacity + 1, sizeof *mesh->face_color);
    return mesh->face_color || error_set(err, ERR_MEMORY, "no memory for a mesh");
}

bool static_mesh_with_textures(struct static_mesh *mesh, struct error *err)
{
    if (mesh->texture) return true;
    mesh->uv = calloc(mesh->triangle_capacity + 1, sizeof *mesh->uv);
    if (!mesh->uv) return error_set(err, ERR_MEMORY, "no memory for a mesh");
    if (!resize(&mesh->texture, mesh->triangle_capacity + 1, sizeof *mesh->texture, err)) return false;
    for (size_t i = 0; i < mesh->triangle_capacity; i++) mesh->texture[i] = STATIC_NO_TEXTURE;
    return true;
}

/* --- life --- */

static bool check(const struct static_mesh *mesh, const char *path, struct error *err)
{
    if (mesh->triangles == 0) return error_at(err, ERR_INPUT, path, 0, 0, "has no triangles");
    for (size_t i = 0; i < mesh->vertices; i++)
        for (int k = 0; k < 3; k++)
            if (!isfinite(mesh->position_m[i][k]))
                return error_at(err, ERR_INPUT, path, 0, 0, "vertex %zu has a coordinate that is not a number", i);
    return true;
}

/* What surfaces that are added later take their labels from, whatever triangles are gone by then. */
static bool label_vertices(struct static_mesh *mesh, struct error *err)
{
    if (!mesh->label) return true;
    if (!resize(&mesh->vertex_label, mesh->vertices + 1, sizeof *mesh->vertex_label, err)) return false;
    for (size_t i = 0; i < mesh->vertices; i++) mesh->vertex_label[i] = -1;
    for (size_t i = 0; i < mesh->triangles; i++)
        for (int c = 0; c < 3; c++)
            if (mesh->label[i] >= 0) mesh->vertex_label[mesh->triangle[i][c]] = mesh->label[i];
    return true;
}

bool static_mesh_load(struct static_mesh **mesh, const char *path, struct similarity world_from_mesh, struct error *err)
{
    const char *dot = strrchr(path_name(path), '.');
    bool ply = dot && !strcasecmp(dot, ".ply"), obj = dot && !strcasecmp(dot, ".obj");
    if (!ply && !obj) return error_at(err, ERR_INPUT, path, 0, 0, "is no mesh of a place by its name: .ply or .obj would be right");
    struct static_mesh *m = calloc(1, sizeof *m);
    if (!m) return error_set(err, ERR_MEMORY, "no memory for a mesh");
    m->world_from_mesh = world_from_mesh;
    static_color_init(m);
    bool ok = (ply ? static_mesh_read_ply : static_mesh_read_obj)(m, path, err) && check(m, path, err) &&
              static_mesh_color_vertices(m, err) && label_vertices(m, err);
    if (!ok) {
        static_mesh_destroy(m);
        return err->file[0] ? false : error_prefix(err, "%s: ", path);
    }
    *mesh = m;
    return true;
}

void static_mesh_destroy(struct static_mesh *mesh)
{
    if (!mesh) return;
    static_rays_release(mesh);
    static_tiles_destroy(mesh->tiles);
    for (size_t i = 0; i < mesh->texture_count; i++) {
        image_release(&mesh->textures[i]);
        free(mesh->texture_names[i]);
    }
    free(mesh->textures);
    free(mesh->texture_names);
    free(mesh->position_m);
    free(mesh->color);
    free(mesh->triangle);
    free(mesh->label);
    free(mesh->vertex_label);
    free(mesh->face_color);
    free(mesh->texture);
    free(mesh->uv);
    free(mesh);
}

/* --- reading it --- */

size_t static_mesh_vertex_count(const struct static_mesh *mesh)
{
    return mesh->vertices;
}

float (*static_mesh_vertices(struct static_mesh *mesh))[3]
{
    return mesh->position_m;
}

struct vec3 static_mesh_vertex(const struct static_mesh *mesh, uint32_t vertex)
{
    return static_vertex(mesh, vertex);
}

size_t static_mesh_triangle_count(const struct static_mesh *mesh)
{
    return mesh->triangles;
}

const uint32_t (*static_mesh_triangles(const struct static_mesh *mesh))[3]
{
    return (const uint32_t (*)[3])mesh->triangle;
}

void static_mesh_bounds(const struct static_mesh *mesh, struct vec3 *min_m, struct vec3 *max_m)
{
    *min_m = mesh->min_m;
    *max_m = mesh->max_m;
    if (mesh->indexed) return;
    float low[3] = { INFINITY, INFINITY, INFINITY }, high[3] = { -INFINITY, -INFINITY, -INFINITY };
    for (size_t i = 0; i < mesh->triangles; i++)
        for (int c = 0; c < 3; c++)
            for (int k = 0; k < 3; k++) {
                float x = mesh->position_m[mesh->triangle[i][c]][k];
                low[k] = x < low[k] ? x : low[k];
                high[k] = x > high[k] ? x : high[k];
            }
    *min_m = vec3((double)low[0], (double)low[1], (double)low[2]);
    *max_m = vec3((double)high[0], (double)high[1], (double)high[2]);
}

uint64_t static_mesh_hash(const struct static_mesh *mesh)
{
    size_t counts[] = { mesh->vertices, mesh->triangles, mesh->texture_count };
    uint64_t hash = hash_bytes(FILE_HASH_SEED, counts, sizeof counts);
    hash = hash_bytes(hash, mesh->position_m, mesh->vertices * sizeof *mesh->position_m);
    hash = hash_bytes(hash, mesh->triangle, mesh->triangles * sizeof *mesh->triangle);
    if (mesh->color) hash = hash_bytes(hash, mesh->color, mesh->vertices * sizeof *mesh->color);
    if (mesh->label) hash = hash_bytes(hash, mesh->label, mesh->triangles * sizeof *mesh->label);
    if (mesh->face_color) hash = hash_bytes(hash, mesh->face_color, mesh->triangles * sizeof *mesh->face_color);
    if (mesh->texture) hash = hash_bytes(hash, mesh->texture, mesh->triangles * sizeof *mesh->texture);
    if (mesh->uv) hash = hash_bytes(hash, mesh->uv, mesh->triangles * sizeof *mesh->uv);
    for (size_t i = 0; i < mesh->texture_count; i++)
        hash = hash_bytes(hash, mesh->textures[i].data, image_size(&mesh->textures[i]));
    return hash;
}

struct vec3 static_mesh_normal(const struct static_mesh *mesh, uint32_t triangle)
{
    const uint32_t *t = mesh->triangle[triangle];
    struct vec3 a = static_vertex(mesh, t[0]), b = static_vertex(mesh, t[1]), c = static_vertex(mesh, t[2]);
    struct vec3 n = vec3_cross(vec3_sub(b, a), vec3_sub(c, a));
    double norm = vec3_norm(n);
    return norm > 0 ? vec3_scale(n, 1 / norm) : vec3(0, 0, 1);
}

bool static_mesh_has_labels(const struct static_mesh *mesh)
{
    return mesh->label != NULL;
}

int static_mesh_label(const struct static_mesh *mesh, uint32_t triangle)
{
    return mesh->label ? mesh->label[triangle] : -1;
}

bool static_mesh_index(struct static_mesh *mesh, double detail_m, struct error *err)
{
    if (mesh->indexed) return error_set(err, ERR_BUG, "the mesh is indexed already");
    if (!(detail_m > 0)) return error_set(err, ERR_INPUT, "the detail of a mesh must be above 0 m, not %g", detail_m);
    static_mesh_bounds(mesh, &mesh->min_m, &mesh->max_m);
    struct vec3 size = vec3_sub(mesh->max_m, mesh->min_m);
    double widest = fmax(size.x, fmax(size.y, size.z));
    if (!(widest / detail_m < CELLS_MAX)) return error_set(err, ERR_INPUT, "a mesh %g m wide cannot have a detail of %g m", widest, detail_m);
    if (!static_rays_build(mesh, err) || !static_tiles_build(mesh, detail_m, err)) return false;
    mesh->indexed = true;
    return true;
}

void static_mesh_unindex(struct static_mesh *mesh)
{
    static_rays_release(mesh);
    static_tiles_destroy(mesh->tiles);
    mesh->tiles = NULL;
    mesh->indexed = false;
}
