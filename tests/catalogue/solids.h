/* Boxes as OBJ files, for the tests that look at models. */
#ifndef STAFFAGE_TESTS_CATALOGUE_SOLIDS_H
#define STAFFAGE_TESTS_CATALOGUE_SOLIDS_H

#include "tests/gen/model_files.h"

enum { OPEN_ROOF = 1, TURNED = 2 };
struct solids { FILE *file; char *text; size_t size; int vertices; };

static void solids_begin(struct solids *s)
{
    s->vertices = 0;
    s->file = open_memstream(&s->text, &s->size);
}

/* A box from low to high, of a material. */
static void solids_box(struct solids *s, const char *material, struct vec3 low, struct vec3 high, int flags)
{
    static const int faces[6][4] = { { 1, 4, 3, 2 }, { 5, 6, 7, 8 }, { 1, 2, 6, 5 }, { 2, 3, 7, 6 }, { 3, 4, 8, 7 }, { 4, 1, 5, 8 } };
    for (int i = 0; i < 8; i++)
        fprintf(s->file, "v %.9g %.9g %.9g\n", i % 4 == 1 || i % 4 == 2 ? high.x : low.x, i % 4 > 1 ? high.y : low.y, i > 3 ? high.z : low.z);
    fprintf(s->file, "usemtl %s\n", material);
    for (int f = 0; f < 6; f++) {
        if (f == 1 && flags & OPEN_ROOF) continue;
        fputc('f', s->file);
        for (int k = 0; k < 4; k++) fprintf(s->file, " %d", s->vertices + faces[f][flags & TURNED ? 3 - k : k]);
        fputc('\n', s->file);
    }
    s->vertices += 8;
}

/* Write it under a name, with a file of the materials used. Returns its path. */
static const char *solids_end(struct solids *s, const char *name)
{
    fclose(s->file);
    put_text("solids.mtl", "newmtl body\nKd 0.5 0.5 0.5\nnewmtl HeadLight\nKd 1 1 1\nnewmtl tail_light\nKd 1 0 0\n");
    char *text = string_format("mtllib solids.mtl\n%s", s->text);
    const char *path = put_text(name, text);
    free(text);
    free(s->text);
    return path;
}

#endif
