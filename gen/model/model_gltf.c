/* glTF 2.0: the meshes that a scene shows, at rest.
 * Src: Khronos, glTF 2.0 Specification, 3.5 to 3.9 and 5 */
#include "gen/model/model_gltf.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The primitive's corners as a list, three to a triangle, whatever its mode. */
static uint32_t (*read_triangles(struct gltf_loader *l, size_t *triangles, const struct gltf_primitive *p, size_t vertices))[3]
{
    double *index = NULL;
    size_t n = vertices;
    if (p->indices >= 0 && !(index = gltf_accessor_read(l, &n, p->indices, 1, "indices"))) return NULL;
    size_t count = p->mode == GLTF_TRIANGLES ? n / 3 : n > 2 ? n - 2 : 0;
    uint32_t(*out)[3] = malloc((count + 1) * sizeof *out);
    if (!out) gltf_no_memory(l);
    for (size_t i = 0; index && i < n && l->err->code == ERR_OK; i++)
        if (!(index[i] >= 0 && index[i] < (double)vertices)) GLTF_FAIL(l, "index %zu is %.0f, but there are %zu vertices", i, index[i], vertices);
    if (p->mode == GLTF_TRIANGLES && n % 3) GLTF_FAIL(l, "triangles of %zu corners: a multiple of 3 would be right", n);
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

static const struct gltf_texture *texture_of(const struct gltf_loader *l, const struct gltf_texture_use *use)
{
    return use->texture >= 0 && (size_t)use->texture < l->gltf->texture_count ? &l->gltf->textures[use->texture] : NULL;
}

/* Texture positions as we keep them: v up, and KHR_texture_transform applied. */
static bool read_uv(struct gltf_loader *l, struct mesh *mesh, const struct gltf_primitive *p, const struct gltf_texture_use *use)
{
    const struct gltf_texture *texture = texture_of(l, use);
    int set = use->uv_set;
    if (set < 0 || set >= GLTF_UV_SETS || p->uv[set] < 0) return GLTF_FAIL(l, "a textured primitive has no TEXCOORD_%d (0 to %d are read)", set, GLTF_UV_SETS - 1);
    size_t count;
    double *uv = gltf_accessor_read(l, &count, p->uv[set], 2, "texture positions");
    if (!uv) return false;
    if (count != mesh->vertices) GLTF_FAIL(l, "%zu texture positions for %zu vertices", count, mesh->vertices);
    double c = cos(use->rotation_rad), s = sin(use->rotation_rad);
    for (size_t i = 0; l->err->code == ERR_OK && i < count; i++) {
        double u = uv[2 * i] * use->scale[0], v = uv[2 * i + 1] * use->scale[1];
        double at[2] = { use->offset[0] + c * u + s * v, use->offset[1] - s * u + c * v };
        int wrap[2] = { texture->wrap_u, texture->wrap_v };
        for (int k = 0; k < 2; k++) {
            bool outside = at[k] < -1e-4 || at[k] > 1 + 1e-4;
            if (outside && wrap[k] == GLTF_MIRROR) GLTF_FAIL(l, "a texture repeats mirrored, which is not supported: repeat it in the image");
            if (wrap[k] == GLTF_CLAMP) at[k] = fmin(fmax(at[k], 0), 1);
        }
        mesh->uv[i][0] = (float)at[0];
        mesh->uv[i][1] = (float)(1 - at[1]);
    }
    free(uv);
    return l->err->code == ERR_OK;
}

static float (*to_floats(struct gltf_loader *l, const double *values, size_t count))[3]
{
    float(*out)[3] = malloc((count + 1) * sizeof *out);
    if (!out) gltf_no_memory(l);
    for (size_t i = 0; out && i < count; i++)
        for (size_t k = 0; k < 3; k++) out[i][k] = (float)values[3 * i + k];
    return out;
}

/* Make room for one more mesh in the rig, as import_add_mesh does in the import. */
static bool add_rig_mesh(struct gltf_loader *l, struct rig_mesh *mesh)
{
    struct rig *rig = l->import->rig;
    if ((rig->mesh_count & (rig->mesh_count - 1)) == 0) {
        void *grown = realloc(rig->meshes, (rig->mesh_count ? 2 * rig->mesh_count : 1) * sizeof *rig->meshes);
        if (!grown) return gltf_no_memory(l);
        rig->meshes = grown;
    }
    rig->meshes[rig->mesh_count++] = *mesh;
    *mesh = (struct rig_mesh){ 0 };
    return true;
}

static bool add_primitive(struct gltf_loader *l, const struct gltf_primitive *p, size_t node, int skin)
{
    if (p->mode < GLTF_TRIANGLES || p->mode > GLTF_FAN) return true; /* points and lines have no surface */
    if (p->material >= 0 && (size_t)p->material >= l->gltf->material_count) return GLTF_FAIL(l, "material %d of %zu does not exist", p->material, l->gltf->material_count);
    bool ok = false;
    size_t vertices = 0, triangles = 0, normals = 0;
    struct mesh mesh = { 0 };
    struct rig_mesh follow = { .node = node, .skin = skin < 0 ? 0 : (size_t)skin };
    double *normal = NULL;
    uint32_t(*triangle)[3] = NULL;
    const struct gltf_texture_use *base = p->material >= 0 ? &l->gltf->materials[p->material].base : NULL;
    bool textured = base && texture_of(l, base);
    double *position = gltf_accessor_read(l, &vertices, p->position, 3, "positions");
    if (!position) goto out;
    if (p->normal >= 0 && !(normal = gltf_accessor_read(l, &normals, p->normal, 3, "normals"))) goto out;
    if (normal && normals != vertices) {
        GLTF_FAIL(l, "%zu normals for %zu vertices", normals, vertices);
        goto out;
    }
    if (!(triangle = read_triangles(l, &triangles, p, vertices))) goto out;
    if (skin >= 0 && p->joints[0] >= 0 && !gltf_add_influences(l, &follow, p, vertices)) goto out;
    if (!mesh_init(&mesh, vertices, triangles, normal, textured, l->err)) goto out;
    if (!(mesh.source = malloc((vertices + 1) * sizeof *mesh.source))) {
        gltf_no_memory(l);
        goto out;
    }
    for (size_t i = 0; i < vertices; i++) mesh.source[i] = (uint32_t)i;
    if (textured && !read_uv(l, &mesh, p, base)) goto out;
    if (!(follow.position = to_floats(l, position, vertices)) || (normal && !(follow.normal = to_floats(l, normal, vertices)))) goto out;
    follow.vertices = vertices;
    if (triangles) memcpy(mesh.triangle, triangle, triangles * sizeof *triangle);
    if (p->material < 0 && l->default_material < 0) {
        l->default_material = (int)l->import->material_count;
        struct import_material *made = import_add_material(l->import, "", l->err);
        if (!made) goto out;
        made->material.names_only = true;
    }
    mesh.material = (size_t)(p->material >= 0 ? p->material : l->default_material);
    ok = add_rig_mesh(l, &follow) && import_add_mesh(l->import, &mesh, l->err);
out:
    mesh_release(&mesh);
    rig_mesh_release(&follow);
    free(position);
    free(normal);
    free(triangle);
    return ok;
}

static bool add_node(struct gltf_loader *l, int node)
{
    const struct gltf *g = l->gltf;
    if (node < 0 || (size_t)node >= g->node_count) return GLTF_FAIL(l, "scene: node %d of %zu does not exist", node, g->node_count);
    const struct gltf_node *n = &g->nodes[node];
    if (n->mesh >= 0) {
        if ((size_t)n->mesh >= g->mesh_count) return GLTF_FAIL(l, "node %d: mesh %d of %zu does not exist", node, n->mesh, g->mesh_count);
        const struct gltf_mesh *mesh = &g->meshes[n->mesh];
        for (size_t i = 0; i < mesh->primitive_count; i++) {
            if (mesh->primitives[i].has_targets && (mesh->is_morphed || n->is_morphed))
                return GLTF_FAIL(l, "mesh %d is shaped by morph targets, which is not supported: export the shape itself", n->mesh);
            if (!add_primitive(l, &mesh->primitives[i], (size_t)node, n->skin)) return error_prefix(l->err, "mesh %d: ", n->mesh);
        }
    }
    for (size_t i = 0; i < n->child_count; i++)
        if (!add_node(l, n->children[i])) return false;
    return true;
}

bool import_gltf(struct import *import, const char *path, struct error *err)
{
    struct gltf gltf;
    if (!gltf_read(&gltf, path, err)) return false;
    struct gltf_loader l = { .import = import, .gltf = &gltf, .path = path, .default_material = -1, .err = err };
    bool ok = gltf_add_images(&l) && gltf_add_materials(&l) && gltf_add_rig(&l);
    for (size_t i = 0; ok && i < gltf.root_count; i++) ok = add_node(&l, gltf.roots[i]);
    ok = ok && rig_wind(import->meshes, import->rig, err) && rig_pose(import->meshes, import->rig, &(struct posture){ 0 }, err);
    if (!ok && !err->file[0]) snprintf(err->file, sizeof err->file, "%s", path);
    import->unit_m = 1;
    gltf_release(&gltf);
    return ok;
}
