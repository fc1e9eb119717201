#include "gen/motion/repertoire.h"

#include <ctype.h>
#include <math.h>
#include <string.h>

/* Speeds between which walking passes over into standing; and what part of his own speed one who dawdles must lose. */
#define STILL_M_S 0.05
#define GOING_M_S 0.45
#define DAWDLE_SHARE 0.8
/* Who comes to rest begins to stand when the ground below him all but stays; without an animation for it he is done when
 * the other foot may be down. */
#define REST_BEFORE_S 0.08
#define REST_AFTER_S 0.35
/* One runs from where v^2 / (g leg) is 0.5; the leg, from the hip down, is 0.53 of a body's height.
 * Src: Alexander 1989, Optimization and gaits in the locomotion of vertebrates; Drillis, Contini 1966 */
#define RUN_FROUDE 0.5
#define LEG_SHARE 0.53
#define GRAVITY_M_S2 9.81

static bool says(const char *name, const char *word)
{
    size_t n = strlen(word);
    for (; *name; name++) {
        size_t i = 0;
        while (i < n && tolower((unsigned char)name[i]) == word[i]) i++;
        if (i == n) return true;
    }
    return false;
}

static enum pace pace_of(const char *name)
{
    if (says(name, "stand") || says(name, "idle")) return PACE_STAND;
    if (says(name, "walk")) return says(name, "slow") ? PACE_SLOW_WALK : PACE_WALK;
    if (says(name, "run") || says(name, "jog")) return PACE_RUN;
    return PACE_COUNT;
}

bool repertoire_create(struct repertoire *out, const struct model *model, struct error *err)
{
    struct repertoire made = { .run_m_s = sqrt(RUN_FROUDE * GRAVITY_M_S2 * LEG_SHARE * model->max_m.z) };
    bool known = false;
    for (size_t i = 0; i < model->rig->animation_count; i++) {
        const char *name = model->rig->animations[i].name;
        if (says(name, "halt")) {
            if (!made.halts) made.halt = i;
            made.halts = true;
            continue;
        }
        enum pace pace = pace_of(name);
        if (pace == PACE_COUNT || made.has[pace]) continue;
        made.has[pace] = known = true;
        made.animation[pace] = i;
    }
    if (!known) made.has[PACE_WALK] = true;
    struct model standing = { 0 };
    made.halts = made.halts && made.has[PACE_STAND];
    bool stands = made.has[PACE_STAND], ok = true;
    if (stands) ok = model_pose(&standing, model, &(struct posture){ .animation = made.halts ? made.halt : made.animation[PACE_STAND] }, err);
    made.halt_s = made.halts ? model->rig->animations[made.halt].duration_s : 0;
    for (int pace = 0; ok && pace < PACE_COUNT; pace++)
        if (made.has[pace]) ok = gait_create(&made.gait[pace], model, made.animation[pace], stands ? &standing : NULL, err);
    if (stands) model_posed_release(&standing);
    if (ok) *out = made;
    else repertoire_release(&made);
    return ok;
}

void repertoire_release(struct repertoire *repertoire)
{
    for (int pace = 0; pace < PACE_COUNT; pace++) gait_release(&repertoire->gait[pace]);
    *repertoire = (struct repertoire){ 0 };
}

static double natural_speed(const struct gait *gait) { return gait->stride_m / gait->duration_s; }

/* The nearest there is, in the order given. */
static enum pace first_of(const struct repertoire *r, const enum pace *order)
{
    while (!r->has[*order]) order++;
    return *order;
}

/* For who is on his way. */
static enum pace choose(const struct repertoire *r, double speed_m_s)
{
    static const enum pace running[] = { PACE_RUN, PACE_WALK, PACE_SLOW_WALK, PACE_STAND }, walking[] = { PACE_WALK, PACE_SLOW_WALK, PACE_RUN, PACE_STAND };
    if (speed_m_s > r->run_m_s) return first_of(r, running);
    if (r->has[PACE_SLOW_WALK] && r->has[PACE_WALK] &&
        speed_m_s < sqrt(natural_speed(&r->gait[PACE_SLOW_WALK]) * natural_speed(&r->gait[PACE_WALK]))) return PACE_SLOW_WALK;
    return first_of(r, walking);
}

const struct gait *repertoire_gait(const struct repertoire *r, double speed_m_s) { return &r->gait[choose(r, fabs(speed_m_s))]; }

static double time_of(const struct repertoire *r, enum pace pace, const struct pace_now *now)
{
    const struct gait *gait = &r->gait[pace];
    return gait_time(gait, now->distance_m, now->phase) + (gait->walks ? 0 : now->time_s);
}

static double smooth(double t)
{
    t = fmin(fmax(t, 0), 1);
    return t * t * (3 - 2 * t);
}

double pace_stands(const struct pace_now *now)
{
    double speed = fabs(now->speed_m_s), wish = fmax(fabs(now->wish_m_s), speed);
    double own = wish > 0 ? fmin(1, DAWDLE_SHARE * wish / GOING_M_S) : 1;
    return smooth((GOING_M_S * own - speed) / ((GOING_M_S - STILL_M_S) * own));
}

struct posture repertoire_posture(const struct repertoire *r, const struct pace_now *now, double stands)
{
    double wish = fmax(fabs(now->wish_m_s), fabs(now->speed_m_s));
    enum pace going = wish > 0 ? choose(r, wish) : PACE_STAND, standing = r->has[PACE_STAND] ? PACE_STAND : going;
    if (!r->has[going]) going = standing = choose(r, 0);
    struct posture posture = { .animation = r->animation[going], .time_s = time_of(r, going, now) };
    if (standing == going || stands == 0) return posture;
    posture.to = r->animation[standing];
    posture.to_time_s = time_of(r, standing, now);
    posture.share = stands;
    return posture;
}

struct posture repertoire_rest(const struct repertoire *r, const struct pace_now *now, double rest_s)
{
    double since_s = rest_s + REST_BEFORE_S;
    if (!r->halts) return repertoire_posture(r, now, smooth(since_s / (REST_BEFORE_S + REST_AFTER_S)));
    if (since_s >= r->halt_s) return (struct posture){ .animation = r->animation[PACE_STAND], .time_s = since_s - r->halt_s };
    if (since_s >= REST_BEFORE_S) return (struct posture){ .animation = r->halt, .time_s = since_s };
    struct posture posture = repertoire_posture(r, now, 0);
    posture.to = r->halt, posture.to_time_s = fmax(since_s, 0), posture.share = smooth(since_s / REST_BEFORE_S);
    return posture;
}
