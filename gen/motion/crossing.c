#include "gen/motion/crossing.h"

#include "gen/motion/crowd.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

#define CLEARANCE_M 0.15
#define LONGEST_CUT_M 15.0    /* a track that runs beside another for longer does not just end on it */
#define LARGEST_CUT 0.5       /* of its length */
#define ITSELF 2.5            /* a track comes back to itself after so many clearances */
#define PERSON_NOTICE_M 3.0
#define CALM_M_S2 1.5         /* how hard one means to brake for a crossing */
#define STOOD_M_S 0.05

/* A track at every TRACK_STEP_M: how far to its left and right a body may reach there. */
struct spot { struct vec2 p_m, direction; double left_m, right_m; bool near; size_t crossing; };
struct spots { struct spot *at; size_t n; double reach_m; };

static double spot_s(const struct track *track, size_t i)
{
    return fmin((double)i * TRACK_STEP_M, path_length(&track->path));
}

static bool spots_create(struct spots *spots, const struct track *track, struct body_size size)
{
    *spots = (struct spots){ .n = track->samples, .at = calloc(track->samples, sizeof *spots->at) };
    if (!spots->at) return false;
    double half = size.length_m / 2;
    for (size_t i = 0; i < spots->n; i++) {
        struct path_point at = path_at(&track->path, spot_s(track, i), 0);
        struct spot *spot = &spots->at[i];
        spot->p_m = at.p_m;
        spot->direction = (struct vec2){ sin(at.heading_rad), cos(at.heading_rad) };
        spot->left_m = spot->right_m = size.width_m / 2;
        if (track->use == ROAD_VEHICLES) {
            /* Its middle on the lane, a vehicle lies straight over a bend: its ends swing out. */
            double left, right;
            track_bends(track, &left, &right, spot_s(track, i), half);
            spot->left_m += right * half * half / 2;
            spot->right_m += left * half * half / 2;
        } else { /* A person may be anywhere on the width, and turned. */
            spot->left_m = spot->right_m += walk_range(track, size.width_m) + 0.4 * half;
        }
        spots->reach_m = fmax(spots->reach_m, fmax(spot->left_m, spot->right_m));
    }
    return true;
}

static double reach_towards(const struct spot *spot, struct vec2 p_m)
{
    double aside = spot->direction.x * (p_m.y - spot->p_m.y) - spot->direction.y * (p_m.x - spot->p_m.x);
    return aside > 0 ? spot->left_m : spot->right_m;
}

static bool used(const struct track *track, size_t i)
{
    double s = spot_s(track, i);
    return s >= track->begin_m && s <= track->end_m;
}

typedef bool on_near(void *context, size_t a, size_t i, size_t b, size_t j);

/* Call for every two spots where bodies could touch. */
static bool each_near(const struct spots *spots, const struct track *tracks, size_t track_count, on_near *call,
                      void *context)
{
    for (size_t a = 0; a < track_count; a++)
        for (size_t b = a; b < track_count; b++) {
            for (size_t i = 0; i < spots[a].n; i++) {
                if (!used(&tracks[a], i)) continue;
                const struct spot *p = &spots[a].at[i];
                double most = fmax(p->left_m, p->right_m) + spots[b].reach_m + CLEARANCE_M;
                size_t first = a == b ? i + (size_t)ceil(ITSELF * most / TRACK_STEP_M) : 0;
                for (size_t j = first; j < spots[b].n;) {
                    const struct spot *q = &spots[b].at[j];
                    double d = hypot(p->p_m.x - q->p_m.x, p->p_m.y - q->p_m.y);
                    bool near = d < most && used(&tracks[b], j) &&
                                d < reach_towards(p, q->p_m) + reach_towards(q, p->p_m) + CLEARANCE_M;
                    if (near && !call(context, a, i, b, j)) return false;
                    /* Along the curve one comes no nearer than straight. */
                    j += (size_t)fmax(1, floor((d - most) / TRACK_STEP_M));
                }
            }
        }
    return true;
}

static bool mark(void *context, size_t a, size_t i, size_t b, size_t j)
{
    struct spots *spots = context;
    spots[a].at[i].near = spots[b].at[j].near = true;
    return true;
}

static bool mark_others(void *context, size_t a, size_t i, size_t b, size_t j)
{
    return a == b || mark(context, a, i, b, j);
}

/* Who only ends on another way stops before it. */
static void cut_ends(struct track *track, const struct spots *spots)
{
    size_t first = 0, last = spots->n - 1;
    while (first < spots->n && spots->at[first].near) first++;
    while (last > 0 && spots->at[last].near) last--;
    double most = fmin(LONGEST_CUT_M, LARGEST_CUT * track->end_m);
    if (first > last) return;
    double begin = spot_s(track, first), end = spot_s(track, last);
    if (first > 0 && begin <= most) track->begin_m = begin;
    if (last + 1 < spots->n && track->end_m - end <= most) track->end_m = end;
}

/* Marked spots become crossings; with no room to stand between two, they are one. */
static bool crossings_from_marks(struct crossings *crossings, struct spots *spots, struct track *track,
                                 struct body_size size)
{
    double apart = size.length_m + (track->use == ROAD_VEHICLES ? STANDING_GAP_M : 0) + 2 * TRACK_STEP_M + 0.5;
    track->crossing_first = crossings->count;
    track->crossing_count = 0;
    for (size_t i = 0; i < spots->n; i++) {
        if (!spots->at[i].near) continue;
        double from = ((double)i - 1) * TRACK_STEP_M, to = ((double)i + 1) * TRACK_STEP_M;
        struct crossing *last = track->crossing_count ? &crossings->at[crossings->count - 1] : NULL;
        if (!last || from - last->to_m > apart) {
            struct crossing *more = realloc(crossings->at, (crossings->count + 1) * sizeof *more);
            if (!more) return false;
            crossings->at = more;
            crossings->at[crossings->count++] = (struct crossing){ .from_m = from };
            track->crossing_count++;
            last = &crossings->at[crossings->count - 1];
        }
        last->to_m = to;
        spots->at[i].crossing = crossings->count - 1;
    }
    return true;
}

struct pairing { struct crossings *crossings; const struct spots *spots; };

static bool against(struct crossings *crossings, size_t a, size_t b)
{
    struct crossing *crossing = &crossings->at[a];
    for (size_t k = crossing->against_count; k-- > 0;)
        if (crossing->against[k] == b) return true;
    size_t *more = realloc(crossing->against, (crossing->against_count + 1) * sizeof *more);
    if (!more) return false;
    crossing->against = more;
    crossing->against[crossing->against_count++] = b;
    return true;
}

static bool pair(void *context, size_t a, size_t i, size_t b, size_t j)
{
    struct pairing *pairing = context;
    size_t one = pairing->spots[a].at[i].crossing, other = pairing->spots[b].at[j].crossing;
    return against(pairing->crossings, one, other) && against(pairing->crossings, other, one);
}

bool crossings_find(struct crossings *crossings, struct track *tracks, size_t track_count,
                    const struct body_size largest[2], struct error *err)
{
    struct crossings new = { 0 };
    struct spots *spots = calloc(track_count + 1, sizeof *spots);
    bool good = spots != NULL;
    for (size_t i = 0; good && i < track_count; i++) good = spots_create(&spots[i], &tracks[i], largest[tracks[i].use]);
    if (good) {
        each_near(spots, tracks, track_count, mark_others, spots);
        for (size_t i = 0; i < track_count; i++) cut_ends(&tracks[i], &spots[i]);
        for (size_t i = 0; i < track_count; i++)
            for (size_t k = 0; k < spots[i].n; k++) spots[i].at[k].near = false;
        each_near(spots, tracks, track_count, mark, spots);
    }
    for (size_t i = 0; good && i < track_count; i++)
        good = crossings_from_marks(&new, &spots[i], &tracks[i], largest[tracks[i].use]);
    struct pairing pairing = { &new, spots };
    good = good && each_near(spots, tracks, track_count, pair, &pairing);
    for (size_t i = 0; spots && i < track_count; i++) free(spots[i].at);
    free(spots);
    if (!good) {
        crossings_release(&new);
        return error_set(err, ERR_MEMORY, "no memory for the crossings of %zu lanes", track_count);
    }
    *crossings = new;
    return true;
}

void crossings_release(struct crossings *crossings)
{
    for (size_t i = 0; i < crossings->count; i++) free(crossings->at[i].against);
    free(crossings->at);
    *crossings = (struct crossings){ 0 };
}

/* The k-th crossing on a body's way, and where it begins and ends on it. */
static size_t on_way(const struct body *body, size_t k)
{
    const struct track *track = body->track;
    return track->crossing_first + (body->direction > 0 ? k : track->crossing_count - 1 - k);
}
static double way_from(const struct crowd *crowd, const struct body *body, size_t k)
{
    const struct crossing *crossing = &crowd->crossings.at[on_way(body, k)];
    return body->direction > 0 ? crossing->from_m : -crossing->to_m;
}
static double way_to(const struct crowd *crowd, const struct body *body, size_t k)
{
    const struct crossing *crossing = &crowd->crossings.at[on_way(body, k)];
    return body->direction > 0 ? crossing->to_m : -crossing->from_m;
}

/* Somebody in the crossing cannot go on because of those who wait before it: they go in, out of turn. */
static bool is_stuck_in(const struct crowd *crowd, size_t crossing)
{
    for (size_t i = 0; i < crowd->count; i++) {
        const struct body *body = &crowd->bodies[i];
        for (size_t k = body->held_from; k < body->held_to; k++)
            if (on_way(body, k) == crossing && body->speed_m_s < STOOD_M_S) return true;
    }
    return false;
}

static bool is_taken(const struct crowd *crowd, const struct body *body, size_t crossing)
{
    const struct crossing *wanted = &crowd->crossings.at[crossing];
    for (size_t k = 0; k < wanted->against_count; k++)
        if (crowd->crossings.at[wanted->against[k]].holders) return true;
    if (body->is_person && is_stuck_in(crowd, crossing)) return false;
    for (size_t i = 0; i < crowd->count; i++) {
        const struct body *other = &crowd->bodies[i];
        if (!other->ticket || other->ticket >= body->ticket) continue;
        for (size_t k = 0; k < wanted->against_count; k++)
            if (on_way(other, other->held_to) == wanted->against[k]) return true;
    }
    return false;
}

bool crossing_appear(struct crowd *crowd, struct body *body)
{
    double rear = body_progress(body) - body->length_m / 2, front = rear + body->length_m;
    size_t k = 0;
    while (k < body->track->crossing_count && way_to(crowd, body, k) < rear) k++;
    body->held_from = body->held_to = k;
    body->ticket = 0;
    if (k == body->track->crossing_count || way_from(crowd, body, k) > front) return true;
    struct body asking = *body;
    asking.ticket = UINT64_MAX;
    if (is_taken(crowd, &asking, on_way(body, k))) return false;
    crowd->crossings.at[on_way(body, k)].holders++;
    body->held_to++;
    return true;
}

void crossing_leave(struct crowd *crowd, struct body *body)
{
    for (; body->held_from < body->held_to; body->held_from++) crowd->crossings.at[on_way(body, body->held_from)].holders--;
    body->ticket = 0;
}

/* Nobody before it on its lane still waits for the same, and behind it there is room to stand,
 * so that it will not block what it has left half. */
static bool may_ask(const struct crowd *crowd, const struct body *body)
{
    if (body->is_person) return true;
    size_t k = body->held_to;
    double need = body->length_m + STANDING_GAP_M;
    for (size_t i = 0; i < crowd->count; i++) {
        const struct body *other = &crowd->bodies[i];
        if (other->track != body->track || other->s_m <= body->s_m) continue;
        if (other->held_to <= k) return false;
        if (other->held_to == k + 1) need += other->length_m + STANDING_GAP_M;
    }
    return k + 1 == body->track->crossing_count || way_from(crowd, body, k + 1) - way_to(crowd, body, k) >= need;
}

static double notice(const struct body *body)
{
    double v = body->speed_m_s;
    return body->is_person ? PERSON_NOTICE_M : v * v / (2 * CALM_M_S2) + 2 * v + 5;
}

void crossings_settle(struct crowd *crowd)
{
    for (size_t i = 0; i < crowd->count; i++) {
        struct body *body = &crowd->bodies[i];
        double rear = body_progress(body) - body->length_m / 2;
        for (; body->held_from < body->held_to && way_to(crowd, body, body->held_from) < rear; body->held_from++)
            crowd->crossings.at[on_way(body, body->held_from)].holders--;
    }
    for (size_t i = 0; i < crowd->count; i++) {
        struct body *body = &crowd->bodies[i];
        if (body->held_to == body->track->crossing_count) continue;
        double front = body_progress(body) + body->length_m / 2;
        if (!body->ticket && way_from(crowd, body, body->held_to) - front <= notice(body) && may_ask(crowd, body))
            body->ticket = ++crowd->tickets;
        if (!body->ticket || is_taken(crowd, body, on_way(body, body->held_to))) continue;
        crowd->crossings.at[on_way(body, body->held_to)].holders++;
        body->held_to++;
        body->ticket = 0;
    }
}

double crossing_room(const struct crowd *crowd, const struct body *body)
{
    if (body->held_to == body->track->crossing_count) return INFINITY;
    double room = way_from(crowd, body, body->held_to) - body_progress(body) - body->length_m / 2;
    return room > notice(body) ? INFINITY : fmax(room, 0);
}
