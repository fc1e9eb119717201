/* A place as a PLY file. */
#include "gen/world/static_mesh_impl.h"
#include "lib/file.h"

#include <stdlib.h>
#include <string.h>

#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
#define BYTE_ORDER_NAME "big"
#else
#define BYTE_ORDER_NAME "little"
#endif

static char *put(char *at, const void *bytes, size_t n)
{
    memcpy(at, bytes, n);
    return at + n;
}

bool static_mesh_write(const char *path, const struct static_mesh *mesh, const uint8_t *labels,
                       const uint8_t (*label_colors)[3], struct error *err)
{
    char *header = string_format("ply\nformat binary_" BYTE_ORDER_NAME "_endian 1.0\ncomment world metres, z up\nelement vertex %zu\n"
                                 "property float x\nproperty float y\nproperty float z\n%selement face %zu\n"
                                 "property list uchar int vertex_indices\n%s%send_header\n",
                                 mesh->vertices, mesh->color ? "property uchar red\nproperty uchar green\nproperty uchar blue\n" : "",
                                 mesh->triangles, labels ? "property uchar label\n" : "",
                                 label_colors ? "property uchar red\nproperty uchar green\nproperty uchar blue\n" : "");
    size_t size = (header ? strlen(header) : 0) + mesh->vertices * 15 + mesh->triangles * 17;
    char *data = malloc(size + 1), *at = data;
    bool ok = header && data;
    if (ok) {
        at = put(at, header, strlen(header));
        for (size_t i = 0; i < mesh->vertices; i++) {
            at = put(at, mesh->position_m[i], sizeof *mesh->position_m);
            if (mesh->color) at = put(at, mesh->color[i], sizeof *mesh->color);
        }
        for (size_t i = 0; i < mesh->triangles; i++) {
            *at++ = 3;
            at = put(at, mesh->triangle[i], sizeof *mesh->triangle);
            if (labels) *at++ = (char)labels[i];
            if (label_colors) at = put(at, label_colors[i], sizeof *label_colors);
        }
        ok = file_write(path, data, (size_t)(at - data), err);
    } else {
        error_set(err, ERR_MEMORY, "no memory for a mesh");
    }
    free(header);
    free(data);
    return ok;
}
