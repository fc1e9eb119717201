#include "gen/motion/traffic.h"

#include "gen/motion/crowd.h"
#include "gen/motion/population.h"

#include <math.h>
#include <stdlib.h>

#define BEND_BRAKING_M_S2 1.5

/* One mover's moments, one a step. */
struct moment { struct vec2 p_m; float heading_rad, speed_m_s, gone_m; };
struct trail {
    struct character character;
    size_t first_step, steps, room;
    bool left;               /* its last moment is not shown any more: who follows it is there */
    struct moment *moments;  /* (steps) */
};
struct traffic {
    struct trail *trails;    /* (count) by id */
    size_t count, room;
    uint16_t first_id;
    double begin_s;
    size_t last_step;
};

static bool trails_add(struct traffic *traffic, const struct character *character, size_t step)
{
    if (traffic->count == traffic->room) {
        size_t room = traffic->room ? 2 * traffic->room : 64;
        struct trail *more = realloc(traffic->trails, room * sizeof *more);
        if (!more) return false;
        traffic->trails = more;
        traffic->room = room;
    }
    traffic->trails[traffic->count++] = (struct trail){ .character = *character, .first_step = step };
    return true;
}

static bool trail_record(struct trail *trail, const struct body *body)
{
    if (trail->steps == trail->room) {
        size_t room = trail->room ? 2 * trail->room : 256;
        struct moment *more = realloc(trail->moments, room * sizeof *more);
        if (!more) return false;
        trail->moments = more;
        trail->room = room;
    }
    trail->moments[trail->steps++] = (struct moment){
        .p_m = body->p_m,
        .heading_rad = (float)remainder(body->heading_rad, 2 * M_PI),
        .speed_m_s = (float)hypot(body->speed_m_s, body->is_person ? body->lateral_m_s : 0),
        .gone_m = (float)body->gone_m,
    };
    return true;
}

/* Those who came to their end go, and others come. */
static bool renew(struct traffic *traffic, struct crowd *crowd, const struct traffic_options *options, size_t step,
                  struct error *err)
{
    size_t kept = 0, present[2] = { 0, 0 }, wanted[2] = { options->vehicle_count, options->people_count };
    for (size_t i = 0; i < crowd->count; i++) {
        struct body *body = &crowd->bodies[i];
        if (body->left) {
            crossing_leave(crowd, body);
            traffic->trails[body->id - options->first_id].left = true;
            continue;
        }
        present[body->is_person]++;
        crowd->bodies[kept++] = *body;
    }
    crowd->count = kept;
    for (int is_person = 0; is_person < 2; is_person++)
        for (; present[is_person] < wanted[is_person]; present[is_person]++) {
            if (options->first_id + traffic->count > UINT16_MAX)
                return error_set(err, ERR_INPUT, "more than %d vehicles and people come by; ask for fewer or a shorter time",
                                 UINT16_MAX - options->first_id + 1);
            struct character new = character_draw(options, (uint32_t)traffic->count, is_person);
            if (!population_add(crowd, &new, options)) break;
            new.body = crowd->bodies[crowd->count - 1];
            if (!trails_add(traffic, &new, step) || !trail_record(&traffic->trails[traffic->count - 1], &new.body))
                return error_set(err, ERR_MEMORY, "no memory for the traffic");
        }
    return true;
}

static bool run(struct traffic *traffic, struct crowd *crowd, const struct traffic_options *options, struct error *err)
{
    for (size_t step = 1; step <= traffic->last_step; step++) {
        crossings_settle(crowd);
        crowd_drive(crowd);
        crowd_walk(crowd);
        for (size_t i = 0; i < crowd->count; i++)
            if (!trail_record(&traffic->trails[crowd->bodies[i].id - options->first_id], &crowd->bodies[i]))
                return error_set(err, ERR_MEMORY, "no memory for the traffic");
        if (!renew(traffic, crowd, options, step, err)) return false;
    }
    return true;
}

static bool check_options(const struct traffic_options *options, double begin_s, double end_s, struct error *err)
{
    const struct mover_kind *kinds[2] = { options->vehicles, options->people };
    size_t kind_count[2] = { options->vehicle_kinds, options->people_kinds };
    size_t wanted[2] = { options->vehicle_count, options->people_count };
    double speed[2] = { options->vehicle_speed_m_s, options->people_speed_m_s };
    for (int use = 0; use < 2; use++) {
        const char *who = use == ROAD_PEOPLE ? "people" : "vehicles";
        if (wanted[use] == 0) continue;
        if (kind_count[use] == 0) return error_set(err, ERR_INPUT, "%s are wanted and there is no model of them", who);
        if (!(speed[use] > 0 && speed[use] < 100))
            return error_set(err, ERR_INPUT, "%s: a speed of %g m/s; it is above 0 and below 100", who, speed[use]);
        for (size_t i = 0; i < kind_count[use]; i++)
            if (!(kinds[use][i].weight > 0 && kinds[use][i].length_m > 0 && kinds[use][i].width_m > 0))
                return error_set(err, ERR_INPUT, "%s: model %zu has no weight, length or width", who, i + 1);
    }
    if (!(options->lateral_m_s2 > 0))
        return error_set(err, ERR_INPUT, "a lateral acceleration of %g m/s^2; it is above 0", options->lateral_m_s2);
    if (options->first_id + options->vehicle_count + options->people_count > UINT16_MAX)
        return error_set(err, ERR_INPUT, "%zu vehicles and people; there are ids for %d", options->vehicle_count +
                         options->people_count, UINT16_MAX - options->first_id);
    if (!(end_s >= begin_s && isfinite(end_s - begin_s)))
        return error_set(err, ERR_INPUT, "the traffic's time ends (%g s) before it begins (%g s)", end_s, begin_s);
    return true;
}

bool traffic_create(struct traffic **traffic, const struct road_network *roads, const struct traffic_options *options,
                    double begin_s, double end_s, struct error *err)
{
    if (!check_options(options, begin_s, end_s, err)) return false;
    size_t count = options->vehicle_count + options->people_count;
    struct crowd crowd = { .bodies = calloc(count + 1, sizeof *crowd.bodies) };
    struct character *characters = calloc(count + 1, sizeof *characters);
    struct traffic *new = calloc(1, sizeof *new);
    bool good = false;
    if (!crowd.bodies || !characters || !new) {
        error_set(err, ERR_MEMORY, "no memory for the traffic");
        goto out;
    }
    new->first_id = options->first_id;
    new->begin_s = begin_s;
    new->last_step = (size_t)ceil((end_s - begin_s) / CROWD_STEP_S);
    const struct body_size sizes[2] = { [ROAD_VEHICLES] = largest_of(options, false),
                                        [ROAD_PEOPLE] = largest_of(options, true) };
    if (!tracks_create(&crowd.tracks, &crowd.track_count, roads, options->lateral_m_s2, BEND_BRAKING_M_S2, err) ||
        !crossings_find(&crowd.crossings, crowd.tracks, crowd.track_count, sizes, err) ||
        !population_begin(&crowd, characters, options, err))
        goto out;
    for (size_t i = 0; i < count; i++)
        if (!trails_add(new, &characters[i], 0) || !trail_record(&new->trails[i], &crowd.bodies[i])) {
            error_set(err, ERR_MEMORY, "no memory for the traffic");
            goto out;
        }
    good = run(new, &crowd, options, err);
out:
    if (good) {
        *traffic = new;
        new = NULL;
    }
    traffic_destroy(new);
    free(characters);
    crossings_release(&crowd.crossings);
    tracks_destroy(crowd.tracks, crowd.track_count);
    free(crowd.bodies);
    return good;
}

void traffic_destroy(struct traffic *traffic)
{
    if (!traffic) return;
    for (size_t i = 0; i < traffic->count; i++) free(traffic->trails[i].moments);
    free(traffic->trails);
    free(traffic);
}

size_t traffic_mover_count(const struct traffic *traffic)
{
    return traffic->count;
}

size_t traffic_at(const struct traffic *traffic, struct mover *movers, double t_s)
{
    double u = fmin(fmax((t_s - traffic->begin_s) / CROWD_STEP_S, 0), (double)traffic->last_step);
    size_t step = (size_t)u, count = 0;
    double part = u - (double)step;
    for (size_t i = 0; i < traffic->count; i++) {
        const struct trail *trail = &traffic->trails[i];
        if (step < trail->first_step || step + trail->left >= trail->first_step + trail->steps) continue;
        const struct moment *a = &trail->moments[step - trail->first_step];
        const struct moment *b = part > 0 ? a + 1 : a;
        double turn = remainder((double)b->heading_rad - a->heading_rad, 2 * M_PI);
        movers[count++] = (struct mover){
            .id = (uint16_t)(traffic->first_id + i),
            .is_person = trail->character.body.is_person,
            .kind = trail->character.kind,
            .color = trail->character.color,
            .p_m = { a->p_m.x + part * (b->p_m.x - a->p_m.x), a->p_m.y + part * (b->p_m.y - a->p_m.y) },
            .heading_rad = remainder(a->heading_rad + part * turn, 2 * M_PI),
            .speed_m_s = a->speed_m_s + part * ((double)b->speed_m_s - a->speed_m_s),
            .wish_m_s = trail->character.body.wish_m_s,
            .distance_m = a->gone_m + part * ((double)b->gone_m - a->gone_m),
            .phase = trail->character.phase,
        };
    }
    return count;
}
