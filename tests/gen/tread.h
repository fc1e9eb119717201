/* How feet tread, told by nothing but where posed vertices are in the world. */
#ifndef STAFFAGE_TESTS_GEN_TREAD_H
#define STAFFAGE_TESTS_GEN_TREAD_H

#include "gen/model/model.h"
#include "lib/vec.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

/* What is nearer to the ground than this is on it. */
#define TREAD_M 0.005

struct tread_point { bool down; struct vec3 came_m, last_m; };
/* Over pictures one after the other: how far a point goes over the ground while it is on it; from one picture to the next; below the
 * ground; and in how many of them somebody stands on something. */
struct tread { double slide_m, jump_m, sunk_m; int pictures, trodden; struct tread_point *point; };

/* The next picture. The ground is at z = 0 of the world. */
static inline void tread_add(struct tread *tread, const struct model *posed, const struct pose *world_from_model)
{
    size_t total = 0, k = 0;
    bool treads = false;
    for (size_t i = 0; i < posed->mesh_count; i++) total += posed->meshes[i].vertices;
    if (!tread->point) tread->point = calloc(total, sizeof *tread->point);
    if (!tread->point) abort();
    for (size_t i = 0; i < posed->mesh_count; i++)
        for (size_t v = 0; v < posed->meshes[i].vertices; v++, k++) {
            const float *q = posed->meshes[i].position_m[v];
            struct vec3 p = pose_apply(*world_from_model, vec3((double)q[0], (double)q[1], (double)q[2]));
            struct tread_point *at = &tread->point[k];
            bool down = p.z < TREAD_M;
            if (down && !at->down) at->came_m = p;
            if (down) tread->slide_m = fmax(tread->slide_m, hypot(p.x - at->came_m.x, p.y - at->came_m.y));
            if (tread->pictures) tread->jump_m = fmax(tread->jump_m, vec3_norm(vec3_sub(p, at->last_m)));
            tread->sunk_m = fmax(tread->sunk_m, -p.z);
            at->down = down;
            at->last_m = p;
            treads = treads || down;
        }
    tread->trodden += treads;
    tread->pictures++;
}

static inline void tread_release(struct tread *tread) { free(tread->point); }

#endif
