#include "gen/motion/crowd.h"

#include <math.h>

void body_place(struct body *body)
{
    struct path_point at = path_at(&body->track->path, body->s_m, body->offset_m);
    body->p_m = at.p_m;
    body->heading_rad = at.heading_rad + (body->direction > 0 ? 0 : M_PI);
}
