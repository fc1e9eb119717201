/* A surface in the making: triangles of named materials that share points. What is symmetric is made as
 * its left half (y >= 0) and mirrored at the end. Running out of memory ends the program. */
#ifndef STAFFAGE_CAST_SHELL_H
#define STAFFAGE_CAST_SHELL_H

#include "cast/form.h"
#include "lib/vec.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define PI 3.14159265358979323846

struct vec3 form_normal(const struct form *form, struct vec3 p);
/* Onto the surface of a solid, from near it; y = 0 stays. */
struct vec3 form_project(const struct form *form, struct vec3 p);

struct face { uint32_t v[3]; uint8_t material; }; /* counter-clockwise from outside */
struct shell { /* { 0 } is empty */
    struct vec3 *p, *n;
    bool *pinned;       /* lies on a line that was cut */
    struct face *faces;
    size_t points, faces_count, point_room, face_room;
    double least_bevel_m; /* smaller ones of boxes are left out */
};
void shell_release(struct shell *shell);
uint32_t shell_point(struct shell *shell, struct vec3 p, struct vec3 n);
void shell_face(struct shell *shell, uint32_t a, uint32_t b, uint32_t c, int material);
/* Along the shorter diagonal. */
void shell_quad(struct shell *shell, uint32_t a, uint32_t b, uint32_t c, uint32_t d, int material);

/* Append the left half of a symmetric solid's surface, in cells of a size, in a box. */
void shell_add_solid(struct shell *shell, const struct form *solid, struct vec3 low, struct vec3 high, struct vec3 cell_m, int material);

/* ---- lines on the surface ---- */

/* Split edges longer than length_m where `near` is within +-width. */
void shell_refine(struct shell *shell, const struct form *solid, const struct form *near, double width, double length_m);
/* Split faces along near = level. New points lie on the solid, if there is one. */
void shell_cut(struct shell *shell, const struct form *solid, const struct form *near, double level);
/* Give a material to faces of one material (-1: of any) whose middle has low < near < high. */
void shell_paint(struct shell *shell, const struct form *near, double low, double high, int from, int to);

/* ---- regions ---- */

typedef struct vec3 move_fn(const void *self, struct vec3 p, struct vec3 n);
/* Sink all faces of a material; the step becomes walls of the material `wall`. */
void shell_sink(struct shell *shell, int material, int wall, move_fn *move, const void *self);
/* Take the faces of a material out; walls go from their rim to where `move` puts it, and end in a flat
 * piece around `middle`. The rim must be seen whole from there. */
void shell_hollow(struct shell *shell, int material, int wall, int end, move_fn *move, const void *self, struct vec3 middle);
/* Move faces of a material to another shell. */
void shell_take(struct shell *to, struct shell *from, int material);
/* Give the faces that have chosen(p) < 0 an inner side, `thickness_m` within; holes in them get edges, and
 * what goes on beyond them ends in a sheet from side to side. */
void shell_line(struct shell *shell, const struct form *chosen, double thickness_m, int material);

/* ---- the whole ---- */

/* Append another, moved; mirrored across y = 0 where `mirrored`. */
void shell_append(struct shell *shell, const struct shell *other, struct vec3 at, bool mirrored);
/* Append the mirror image, which shares the points of y = 0. */
void shell_mirror(struct shell *shell);
/* Normals of faces from `first` on, over edges that bend by less than the angle. Points become as many as
 * are needed. */
void shell_smooth(struct shell *shell, size_t first_face, double crease_deg);
/* Make do with fewer faces: lines between materials stay where they are as well as can be. */
void shell_decimate(struct shell *shell, size_t faces);
/* Points nearer than 0.05 mm become one place, and so do those of faces that are but lines; faces that vanish with it go. */
void shell_clean(struct shell *shell);
void shell_bounds(struct vec3 *low, struct vec3 *high, const struct shell *shell);

#endif
