/* Who drives and who rides: people of the cast, posed by what they sit on and hold. */
#ifndef STAFFAGE_CAST_OCCUPANT_H
#define STAFFAGE_CAST_OCCUPANT_H

#include "cast/person.h"
#include "cast/shell.h"

/* Where a body is held: hips in the middle, wrists and ankles left and right. */
struct seat {
    struct vec3 hips, wrist[2], ankle[2];
    double lean_deg, nod_deg;          /* trunk forward from upright; head down */
    double toes_deg[2];                /* up */
    double elbows_out, knees_out;      /* 0: below, ahead; 1: as far to the side */
};

enum occupant { DRIVER, WOMAN_DRIVER, MOTORCYCLIST, CYCLIST, OCCUPANTS };
/* They are dressed when they are first asked for. */
struct crew;
struct crew *crew_create(void);
void crew_destroy(struct crew *crew);
/* Append one who sits. coarse: for views from some way off */
void crew_seat(struct shell *shell, struct crew *crew, enum occupant who, const struct seat *seat, bool coarse);

#endif
