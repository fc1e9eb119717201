#include "gen/motion/journey.h"

#include <math.h>

/* Who walks takes a step or two to start and to stop, who runs some more. */
#define EASE_M_S2 1.5
/* At rest for so long where there is no way to go. */
#define LONG_S 60

struct journey_now journey_at(const struct journey *j, double time_s)
{
    if (!(j->length_m > 0)) return (struct journey_now){ 0, 0, LONG_S + time_s };
    double ease_m_s2 = fmax(EASE_M_S2, j->speed_m_s / 2), eased_m = j->from_rest ? j->length_m / 2 : j->length_m;
    double cruise_m_s = fmin(j->speed_m_s, sqrt(2 * ease_m_s2 * eased_m)); /* who begins near the end is slowing down */
    double ease_s = cruise_m_s / ease_m_s2, ease_m = cruise_m_s * ease_s / 2, begun_s = j->from_rest ? ease_s : 0, begun_m = j->from_rest ? ease_m : 0;
    double left_s = begun_s + (j->length_m - ease_m - begun_m) / cruise_m_s + ease_s - time_s;
    double rest_s = j->from_rest ? fmax(-left_s, -time_s) : -left_s;
    if (left_s <= 0) return (struct journey_now){ j->length_m, 0, rest_s };
    if (left_s < ease_s) return (struct journey_now){ j->length_m - ease_m_s2 * left_s * left_s / 2, ease_m_s2 * left_s, rest_s };
    if (time_s >= begun_s || !j->from_rest) return (struct journey_now){ begun_m + cruise_m_s * (time_s - begun_s), cruise_m_s, rest_s };
    if (time_s > 0) return (struct journey_now){ ease_m_s2 * time_s * time_s / 2, ease_m_s2 * time_s, rest_s };
    return (struct journey_now){ 0, 0, rest_s };
}
