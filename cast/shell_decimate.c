/* A shell with fewer faces. */
#include "cast/hull.h"
#include "cast/need.h"
#include "cast/shell.h"

#include <stdlib.h>
#include <string.h>

struct place { struct vec3 p; uint32_t point; };

static int by_place(const void *a, const void *b)
{
    const struct vec3 *p = &((const struct place *)a)->p, *q = &((const struct place *)b)->p;
    if (p->x != q->x) return p->x < q->x ? -1 : 1;
    if (p->y != q->y) return p->y < q->y ? -1 : 1;
    return (p->z > q->z) - (p->z < q->z);
}

/* Points that differ in their normals only are one again. */
static struct hull hull_of(const struct shell *s)
{
    struct hull hull = { .triangles = s->faces_count };
    struct place *places = need(malloc((s->points + 1) * sizeof *places));
    uint32_t *one = need(malloc((s->points + 1) * sizeof *one));
    hull.point = need(malloc((s->points + 1) * sizeof *hull.point));
    hull.piece = need(calloc(s->points + 1, 1));
    hull.triangle = need(malloc((s->faces_count + 1) * sizeof *hull.triangle));
    hull.material = need(malloc(s->faces_count + 1));
    for (size_t i = 0; i < s->points; i++) places[i] = (struct place){ s->p[i], (uint32_t)i };
    qsort(places, s->points, sizeof *places, by_place);
    for (size_t i = 0; i < s->points; i++) {
        if (!i || by_place(&places[i], &places[i - 1])) hull.point[hull.points++] = places[i].p;
        one[places[i].point] = (uint32_t)(hull.points - 1);
    }
    for (size_t f = 0; f < s->faces_count; f++) {
        for (int k = 0; k < 3; k++) hull.triangle[f][k] = one[s->faces[f].v[k]];
        hull.material[f] = s->faces[f].material;
    }
    free(places), free(one);
    return hull;
}

void shell_decimate(struct shell *s, size_t faces)
{
    struct hull hull = hull_of(s);
    hull_decimate(&hull, faces, (const double[]){ 1 });
    s->points = s->faces_count = 0;
    for (size_t i = 0; i < hull.points; i++) shell_point(s, hull.point[i], vec3(0, 0, 1));
    for (size_t t = 0; t < hull.triangles; t++) shell_face(s, hull.triangle[t][0], hull.triangle[t][1], hull.triangle[t][2], hull.material[t]);
    shell_smooth(s, 0, 40);
    hull_release(&hull);
}
