/* A mesh as OBJ and MTL files. */
#include "cast/mesh.h"
#include "lib/file.h"

#include <stdio.h>
#include <stdlib.h>

static void write_vectors(FILE *f, const char *word, const struct vec3 *v, size_t n)
{
    for (size_t i = 0; i < n; i++) fprintf(f, "%s %g %g %g\n", word, v[i].x, v[i].y, v[i].z);
}

static bool write_text(const char *folder, const char *name, const char *end, char *text, size_t size, struct error *err)
{
    char *path = string_format("%s/%s.%s", folder, name, end);
    bool good = path && file_write(path, text, size, err);
    free(path);
    free(text);
    return good;
}

bool write_model(struct model *model, const char *folder, const char *name, const struct palette *palette,
                 struct error *err)
{
    struct surface surface = make_surface(model);
    char *text;
    size_t size;
    FILE *f = open_memstream(&text, &size);
    if (!f) abort();
    fprintf(f, "# Made by staffage-cast: free for any use. Metres, z up, front +x.\nmtllib %s.mtl\n", name);
    write_vectors(f, "v", surface.points, surface.point_count);
    write_vectors(f, "vn", surface.normals, surface.normal_count);
    bool used[MATERIAL_COUNT] = { false };
    for (int m = 0; m < MATERIAL_COUNT; m++) {
        for (size_t i = 0; i < model->count; i++) {
            if ((int)model->triangles[i].material != m) continue;
            if (!used[m]) fprintf(f, "usemtl %s\n", material_name[m]);
            used[m] = true;
            fputc('f', f);
            for (size_t k = 0; k < 3; k++)
                fprintf(f, " %zu//%zu", 1 + surface.point[i][k], 1 + surface.normal[i][k]);
            fputc('\n', f);
        }
    }
    fclose(f);
    bool good = write_text(folder, name, "obj", text, size, err);

    f = open_memstream(&text, &size);
    if (!f) abort();
    for (int m = 0; m < MATERIAL_COUNT; m++) {
        const double *rgb = palette->rgb[m];
        if (used[m]) fprintf(f, "newmtl %s\nKd %g %g %g\n", material_name[m], rgb[0], rgb[1], rgb[2]);
    }
    fclose(f);
    good = write_text(folder, name, "mtl", text, size, err) && good;
    surface_release(&surface);
    model_release(model);
    return good;
}
