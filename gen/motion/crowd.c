#include "gen/motion/crowd.h"

#include <math.h>

#define SLOW_M_S 0.4   /* slower than this a sidestep does not turn one */

void body_place(struct body *body)
{
    struct path_point at = path_at(&body->track->path, body->s_m, body->offset_m);
    double aside = atan2(body->direction * body->lateral_m_s, fmax(body->speed_m_s, SLOW_M_S));
    body->p_m = at.p_m;
    body->heading_rad = at.heading_rad + (body->direction > 0 ? 0 : M_PI) - (body->is_person ? aside : 0);
}

bool bodies_touch(const struct body *a, const struct body *b, double margin_m)
{
    struct vec2 d = { b->p_m.x - a->p_m.x, b->p_m.y - a->p_m.y };
    if (hypot(d.x, d.y) > (hypot(a->length_m, a->width_m) + hypot(b->length_m, b->width_m)) / 2 + margin_m) return false;
    const struct body *both[2] = { a, b };
    double turn = fabs(a->heading_rad - b->heading_rad), c = fabs(cos(turn)), s = fabs(sin(turn));
    for (int k = 0; k < 2; k++) {
        const struct body *own = both[k], *other = both[1 - k];
        double sine = sin(own->heading_rad), cosine = cos(own->heading_rad);
        double along = fabs(d.x * sine + d.y * cosine), across = fabs(d.x * cosine - d.y * sine);
        if (along > (own->length_m + other->length_m * c + other->width_m * s) / 2 + margin_m) return false;
        if (across > (own->width_m + other->width_m * c + other->length_m * s) / 2 + margin_m) return false;
    }
    return true;
}
