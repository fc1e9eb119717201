/* What colour the place has where: textures, or colours of faces or vertices. */
#include "gen/model/model_texture.h"
#include "gen/world/static_mesh_impl.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SAMPLES_MAX 8 /* texels along a side of a footprint */

void static_color_init(struct static_mesh *mesh)
{
    for (int i = 0; i < 256; i++) mesh->linear[i] = linear_from_srgb((float)i / 255);
}

bool static_mesh_has_colors(const struct static_mesh *mesh)
{
    return mesh->color || mesh->face_color || mesh->texture;
}

/* --- textures --- */

bool static_mesh_read_texture(struct static_mesh *mesh, uint16_t *index, const char *path, const char *name, struct error *err)
{
    for (size_t i = 0; i < mesh->texture_count; i++)
        if (!strcmp(mesh->texture_names[i], name)) {
            *index = (uint16_t)i;
            return true;
        }
    size_t n = mesh->texture_count;
    if (n == STATIC_NO_TEXTURE) return error_at(err, ERR_INPUT, path, 0, 0, "has more than %zu textures", n);
    char *file = texture_find(path, name);
    if (!file) return error_at(err, ERR_INPUT, path, 0, 0, "its texture \"%s\" is not there", name);
    struct image *textures = realloc(mesh->textures, (n + 1) * sizeof *textures);
    if (textures) mesh->textures = textures;
    char **names = realloc(mesh->texture_names, (n + 1) * sizeof *names);
    if (names) mesh->texture_names = names;
    char *copy = strdup(name);
    bool ok = (textures && names && copy) || error_set(err, ERR_MEMORY, "no memory for a texture");
    struct image image = { 0 };
    ok = ok && image_read(&image, file, err) && texture_make_u8(&image, err);
    free(file);
    if (!ok) {
        image_release(&image);
        free(copy);
        return false;
    }
    mesh->textures[n] = image;
    mesh->texture_names[n] = copy;
    mesh->texture_count = n + 1;
    *index = (uint16_t)n;
    return true;
}

static double triangle_area(const struct static_mesh *mesh, uint32_t triangle)
{
    const uint32_t *t = mesh->triangle[triangle];
    struct vec3 a = static_vertex(mesh, t[0]);
    return 0.5 * vec3_norm(vec3_cross(vec3_sub(static_vertex(mesh, t[1]), a), vec3_sub(static_vertex(mesh, t[2]), a)));
}

/* Texels to a metre of the triangle. */
static double texel_density(const struct static_mesh *mesh, uint32_t triangle, const struct image *image)
{
    const float (*uv)[2] = (const float (*)[2])mesh->uv[triangle];
    double texels = 0.5 * fabs((double)((uv[1][0] - uv[0][0]) * (uv[2][1] - uv[0][1]) - (uv[2][0] - uv[0][0]) * (uv[1][1] - uv[0][1]))) *
                    image->width_px * image->height_px;
    double area = triangle_area(mesh, triangle);
    return area > 0 ? sqrt(texels / area) : 0;
}

static int texel(double at, int size)
{
    double share = at / size - floor(at / size); /* repeats */
    int i = (int)(share * size);
    return i < size ? i : size - 1;
}

/* The mean of the texels in a square of side_px about (u, v), or of some spread evenly over a large one. */
static void texture_color(const struct static_mesh *mesh, float rgb[3], const struct image *image, double u, double v, double side_px)
{
    int n = side_px > 1 ? (int)fmin(ceil(side_px), SAMPLES_MAX) : 1;
    double x0 = u * image->width_px - side_px / 2, y0 = (1 - v) * image->height_px - side_px / 2, step = side_px / n;
    float sum[3] = { 0, 0, 0 };
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) {
            const uint8_t *c = image_u8(image, texel(x0 + (i + 0.5) * step, image->width_px), texel(y0 + (j + 0.5) * step, image->height_px));
            for (int k = 0; k < 3; k++) sum[k] += mesh->linear[c[k]];
        }
    for (int k = 0; k < 3; k++) rgb[k] = sum[k] / (float)(n * n);
}

/* --- colours --- */

void static_mesh_color(const struct static_mesh *mesh, float rgb[3], const struct static_hit *hit, double footprint_m)
{
    uint32_t t = hit->triangle;
    float weight[3] = { 1 - hit->u - hit->v, hit->u, hit->v };
    if (mesh->texture && mesh->texture[t] != STATIC_NO_TEXTURE) {
        const struct image *image = &mesh->textures[mesh->texture[t]];
        double uv[2] = { 0, 0 };
        for (int c = 0; c < 3; c++)
            for (int k = 0; k < 2; k++) uv[k] += (double)(weight[c] * mesh->uv[t][c][k]);
        texture_color(mesh, rgb, image, uv[0], uv[1], footprint_m > 0 ? footprint_m * texel_density(mesh, t, image) : 0);
        return;
    }
    for (int k = 0; k < 3; k++) {
        rgb[k] = STATIC_GREY;
        if (mesh->face_color) {
            rgb[k] = mesh->linear[mesh->face_color[t][k]];
        } else if (mesh->color) {
            rgb[k] = 0;
            for (int c = 0; c < 3; c++) rgb[k] += weight[c] * mesh->linear[mesh->color[mesh->triangle[t][c]][k]];
        }
    }
}

bool static_mesh_color_vertices(struct static_mesh *mesh, struct error *err)
{
    if (mesh->color || !(mesh->texture || mesh->face_color)) return true;
    float (*sum)[4] = calloc(mesh->vertices + 1, sizeof *sum);
    mesh->color = calloc(mesh->vertices + 1, sizeof *mesh->color);
    bool ok = sum && mesh->color;
    for (uint32_t t = 0; ok && t < mesh->triangles; t++) {
        const struct static_hit middle = { .triangle = t, .u = 1 / 3.f, .v = 1 / 3.f };
        float rgb[3];
        static_mesh_color(mesh, rgb, &middle, sqrt(triangle_area(mesh, t)));
        for (int c = 0; c < 3; c++) {
            float *at = sum[mesh->triangle[t][c]];
            for (int k = 0; k < 3; k++) at[k] += rgb[k];
            at[3] += 1;
        }
    }
    for (size_t i = 0; ok && i < mesh->vertices; i++)
        for (int k = 0; k < 3 && sum[i][3] > 0; k++)
            mesh->color[i][k] = static_srgb((double)srgb_from_linear(sum[i][k] / sum[i][3]));
    free(sum);
    return ok || error_set(err, ERR_MEMORY, "no memory for the colours of a mesh");
}
