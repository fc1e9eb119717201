#include "gen/motion/track.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SAMPLE_M 1.0          /* of a lane, before it becomes a curve of its own */
#define JOIN_M 2.0            /* a lane goes on in one that begins this near, */
#define JOIN_RAD 0.7          /* and turns by no more */
#define SHORTEST_M 1.0
#define ABREAST_M 0.1         /* between lanes of people that are one */

/* A lane on the way to a track: places in the order of driving, and the law's speed at each. */
struct strand {
    enum road_use use;
    double width_m;
    struct vec2 *p_m;    /* (n) */
    double *limit_m_s;   /* (n) */
    size_t n;
};

static double distance(struct vec2 a, struct vec2 b) { return hypot(a.x - b.x, a.y - b.y); }

static void strand_release(struct strand *strand)
{
    free(strand->p_m);
    free(strand->limit_m_s);
    *strand = (struct strand){ 0 };
}

static void strand_turn(struct strand *strand)
{
    for (size_t i = 0, k = strand->n - 1; i < k; i++, k--) {
        struct vec2 p = strand->p_m[i];
        double limit = strand->limit_m_s[i];
        strand->p_m[i] = strand->p_m[k];
        strand->limit_m_s[i] = strand->limit_m_s[k];
        strand->p_m[k] = p;
        strand->limit_m_s[k] = limit;
    }
}

static bool strand_from_lane(struct strand *strand, const struct way *way, const struct lane *lane)
{
    double length = path_length(&way->path);
    size_t steps = (size_t)ceil(length / SAMPLE_M);
    *strand = (struct strand){ .use = lane->use, .width_m = lane->width_m };
    strand->p_m = malloc((steps + 1) * sizeof *strand->p_m);
    strand->limit_m_s = malloc((steps + 1) * sizeof *strand->limit_m_s);
    if (!strand->p_m || !strand->limit_m_s) {
        strand_release(strand);
        return false;
    }
    for (size_t i = 0; i <= steps; i++) {
        struct path_point at = path_at(&way->path, length * (double)i / (double)steps, lane->offset_m);
        /* Inside a bend tighter than its offset, a lane would run backwards. */
        if (1 - at.curvature * lane->offset_m < 0.2 && i > 0 && i < steps) continue;
        strand->limit_m_s[strand->n] = lane->speed_limit_m_s > 0 ? lane->speed_limit_m_s : INFINITY;
        strand->p_m[strand->n++] = at.p_m;
    }
    if (lane->backward) strand_turn(strand);
    return true;
}

static struct vec2 strand_direction(const struct strand *strand, bool at_end)
{
    size_t reach = strand->n > 3 ? 3 : strand->n - 1, a = at_end ? strand->n - 1 - reach : 0;
    struct vec2 from = strand->p_m[a], to = strand->p_m[a + reach];
    double length = fmax(distance(from, to), 1e-9);
    return (struct vec2){ (to.x - from.x) / length, (to.y - from.y) / length };
}

/* By how much one turns who goes on from the end of a into the start of b; INFINITY: they do not meet. */
static double joint_turn(const struct strand *a, const struct strand *b)
{
    if (distance(a->p_m[a->n - 1], b->p_m[0]) > JOIN_M) return INFINITY;
    struct vec2 u = strand_direction(a, true), v = strand_direction(b, false);
    return fabs(atan2(u.x * v.y - u.y * v.x, u.x * v.x + u.y * v.y));
}

/* Append b to a; b is released. */
static bool strand_append(struct strand *a, struct strand *b)
{
    /* Where the two overlap by a little, a stops short: one must not go back. */
    struct vec2 on = strand_direction(b, false);
    while (a->n > 2 && (b->p_m[0].x - a->p_m[a->n - 1].x) * on.x + (b->p_m[0].y - a->p_m[a->n - 1].y) * on.y < SAMPLE_M / 2 &&
           distance(a->p_m[a->n - 1], b->p_m[0]) <= JOIN_M)
        a->n--;
    struct vec2 *p = realloc(a->p_m, (a->n + b->n) * sizeof *p);
    if (p) a->p_m = p;
    double *limit = realloc(a->limit_m_s, (a->n + b->n) * sizeof *limit);
    if (limit) a->limit_m_s = limit;
    if (!p || !limit) return false;
    memcpy(p + a->n, b->p_m, b->n * sizeof *p);
    memcpy(limit + a->n, b->limit_m_s, b->n * sizeof *limit);
    a->n += b->n;
    a->width_m = fmin(a->width_m, b->width_m);
    strand_release(b);
    return true;
}

/* The straightest continuation first. People's strands have no direction: they are turned to fit. */
static bool strands_join(struct strand *strands, size_t *count)
{
    for (;;) {
        double best = JOIN_RAD;
        size_t from = 0, to = 0;
        int turns = 0;
        for (size_t a = 0; a < *count; a++)
            for (size_t b = 0; b < *count; b++) {
                if (a == b || strands[a].use != strands[b].use) continue;
                for (int turned = 0; turned < (strands[a].use == ROAD_PEOPLE ? 4 : 1); turned++) {
                    if (turned & 1) strand_turn(&strands[a]);
                    if (turned & 2) strand_turn(&strands[b]);
                    double turn = joint_turn(&strands[a], &strands[b]);
                    if (turn < best) {
                        best = turn;
                        from = a;
                        to = b;
                        turns = turned;
                    }
                    if (turned & 1) strand_turn(&strands[a]);
                    if (turned & 2) strand_turn(&strands[b]);
                }
            }
        if (from == to) return true;
        if (turns & 1) strand_turn(&strands[from]);
        if (turns & 2) strand_turn(&strands[to]);
        if (!strand_append(&strands[from], &strands[to])) return false;
        strands[to] = strands[--*count];
    }
}

static bool track_from_strand(struct track *track, const struct strand *strand, double lateral_m_s2,
                              double braking_m_s2, struct error *err)
{
    struct track new = { .use = strand->use, .width_m = strand->width_m };
    if (!path_create(&new.path, strand->p_m, strand->n, err)) return false;
    new.end_m = path_length(&new.path);
    new.samples = (size_t)ceil(new.end_m / TRACK_STEP_M) + 1;
    new.limit_m_s = malloc(new.samples * sizeof *new.limit_m_s);
    new.bend_m_s = malloc(new.samples * sizeof *new.bend_m_s);
    if (!new.limit_m_s || !new.bend_m_s) {
        path_release(&new.path);
        free(new.limit_m_s);
        free(new.bend_m_s);
        return error_set(err, ERR_MEMORY, "no memory for a lane of %.0f m", new.end_m);
    }
    for (size_t i = 0; i < new.samples; i++) {
        double part = fmin((double)i * TRACK_STEP_M / new.end_m, 1);
        new.limit_m_s[i] = strand->limit_m_s[(size_t)lround(part * (double)(strand->n - 1))];
        /* The sample answers for the curve up to its neighbours. */
        double left, right;
        track_bends(&new, &left, &right, (double)i * TRACK_STEP_M, TRACK_STEP_M);
        new.bend_m_s[i] = sqrt(lateral_m_s2 / fmax(fmax(left, right), 1e-6));
    }
    for (size_t i = new.samples - 1; i-- > 0;) {
        double ahead = new.bend_m_s[i + 1];
        new.bend_m_s[i] = fmin(new.bend_m_s[i], sqrt(ahead * ahead + 2 * braking_m_s2 * TRACK_STEP_M));
    }
    *track = new;
    return true;
}

/* The lane k of a way, and with it those beside it when people walk there: they see to both directions
 * themselves. Returns how many lanes it is. */
static size_t lanes_abreast(struct lane *joined, const struct way *way, size_t k)
{
    size_t n = 1;
    *joined = way->lanes[k];
    for (; joined->use == ROAD_PEOPLE && k + n < way->lane_count; n++) {
        const struct lane *next = &way->lanes[k + n];
        double left = joined->offset_m + joined->width_m / 2, right = joined->offset_m - joined->width_m / 2;
        if (next->use != ROAD_PEOPLE || fabs(next->offset_m + next->width_m / 2 - right) > ABREAST_M) break;
        right = next->offset_m - next->width_m / 2;
        joined->offset_m = (left + right) / 2;
        joined->width_m = left - right;
    }
    return n;
}

bool tracks_create(struct track **tracks, size_t *count, const struct road_network *roads, double lateral_m_s2,
                   double braking_m_s2, struct error *err)
{
    size_t lanes = 0, strand_count = 0, made = 0;
    for (size_t i = 0; i < roads->way_count; i++) lanes += roads->ways[i].lane_count;
    struct strand *strands = calloc(lanes + 1, sizeof *strands);
    struct track *new = calloc(lanes + 1, sizeof *new);
    bool good = false, memory = strands && new;
    for (size_t i = 0; memory && i < roads->way_count; i++)
        for (size_t k = 0; memory && k < roads->ways[i].lane_count;) {
            struct lane lane;
            k += lanes_abreast(&lane, &roads->ways[i], k);
            if (path_length(&roads->ways[i].path) < SHORTEST_M) continue;
            memory = strand_from_lane(&strands[strand_count], &roads->ways[i], &lane);
            strand_count += memory;
        }
    if (!memory || !strands_join(strands, &strand_count)) {
        error_set(err, ERR_MEMORY, "no memory for the traffic of %zu lanes", lanes);
        goto out;
    }
    for (; made < strand_count; made++)
        if (!track_from_strand(&new[made], &strands[made], lateral_m_s2, braking_m_s2, err)) goto out;
    *tracks = new;
    *count = made;
    good = true;
out:
    for (size_t i = 0; i < strand_count; i++) strand_release(&strands[i]);
    free(strands);
    if (!good) tracks_destroy(new, made);
    return good;
}

void tracks_destroy(struct track *tracks, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        path_release(&tracks[i].path);
        free(tracks[i].limit_m_s);
        free(tracks[i].bend_m_s);
    }
    free(tracks);
}

static size_t sample_at(const struct track *track, double s_m, double *part)
{
    double u = fmin(fmax(s_m / TRACK_STEP_M, 0), (double)(track->samples - 1));
    size_t i = (size_t)u;
    if (i + 2 > track->samples) i = track->samples - 2;
    *part = u - (double)i;
    return i;
}

double track_limit(const struct track *track, double s_m)
{
    double part;
    size_t i = sample_at(track, s_m, &part);
    return track->limit_m_s[i + (part > 0.5)];
}

double track_bend_speed(const struct track *track, double s_m)
{
    double part;
    size_t i = sample_at(track, s_m, &part);
    double a = track->bend_m_s[i], b = track->bend_m_s[i + 1];
    return sqrt(a * a + part * (b * b - a * a));
}

void track_bends(const struct track *track, double *left, double *right, double s_m, double around_m)
{
    *left = *right = 0;
    for (double s = s_m - around_m; s <= s_m + around_m; s += PATH_STEP_M) {
        double bend = path_at(&track->path, s, 0).curvature;
        *left = fmax(*left, bend);
        *right = fmax(*right, -bend);
    }
}
