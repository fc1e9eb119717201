#include "gen/motion/population.h"

#include "lib/draw.h"

#include <math.h>
#include <stdlib.h>

#define VEHICLE_SPREAD 0.10
#define PEOPLE_SPREAD 0.15
#define EXTREME 2.5           /* standard deviations, no farther */
#define PLACE_GAP_M 2.5       /* between vehicles at the beginning */
#define PERSON_GAP_M 0.8

static double draw(const struct traffic_options *options, uint32_t n, enum draw_purpose purpose, uint32_t index)
{
    return draw_uniform((struct draw_key){ .seed = options->seed, .entity = n, .purpose = purpose }, index);
}

static enum road_use use_of(bool is_person) { return is_person ? ROAD_PEOPLE : ROAD_VEHICLES; }

struct character character_draw(const struct traffic_options *options, uint32_t n, bool is_person)
{
    const struct mover_kind *kinds = is_person ? options->people : options->vehicles;
    size_t count = is_person ? options->people_kinds : options->vehicle_kinds, kind = 0;
    double weight = 0;
    for (size_t i = 0; i < count; i++) weight += kinds[i].weight;
    double left = draw(options, n, DRAW_KIND, 0) * weight;
    while (kind + 1 < count && left >= kinds[kind].weight) left -= kinds[kind++].weight;

    double normal = draw_normal((struct draw_key){ .seed = options->seed, .entity = n, .purpose = DRAW_SPEED }, 0);
    double share = 1 + (is_person ? PEOPLE_SPREAD : VEHICLE_SPREAD) * fmin(fmax(normal, -EXTREME), EXTREME);
    struct character new = { .kind = kind, .color = -1, .phase = draw(options, n, DRAW_PHASE, 0) };
    if (options->color_count > 0 && !is_person)
        new.color = (int)(draw(options, n, DRAW_COLOR, 0) * (double)options->color_count);
    new.body = (struct body){
        .id = (uint16_t)(options->first_id + n), .is_person = is_person, .direction = 1,
        .length_m = kinds[kind].length_m, .width_m = kinds[kind].width_m, .wish_share = share,
        .wish_m_s = share * (is_person ? options->people_speed_m_s : options->vehicle_speed_m_s),
    };
    return new;
}

struct body_size largest_of(const struct traffic_options *options, bool is_person)
{
    const struct mover_kind *kinds = is_person ? options->people : options->vehicles;
    struct body_size size = { 0, 0 };
    for (size_t i = 0; i < (is_person ? options->people_kinds : options->vehicle_kinds); i++) {
        size.length_m = fmax(size.length_m, kinds[i].length_m);
        size.width_m = fmax(size.width_m, kinds[i].width_m);
    }
    return size;
}

static bool is_passable(const struct track *track, struct body_size size)
{
    return walk_range(track, size.width_m) >= walk_aside(size.length_m, size.width_m);
}

/* A person's direction and place on the width: to the right, and on a path too narrow to pass all one way. */
static void choose_side(struct body *body, const struct crowd *crowd, const struct traffic_options *options, bool backward)
{
    double range = walk_range(body->track, body->width_m), least = walk_aside(body->length_m, body->width_m);
    uint32_t n = (uint32_t)(body->id - options->first_id), track = (uint32_t)(body->track - crowd->tracks);
    double place = draw(options, n, DRAW_OFFSET, 0);
    bool narrow = !is_passable(body->track, largest_of(options, true));
    if (narrow) backward = draw(options, UINT32_MAX - track, DRAW_LANE, 0) < 0.5;
    body->direction = backward ? -1 : 1;
    body->wish_offset_m = narrow ? range * (2 * place - 1) : -body->direction * (least + (range - least) * place);
    body->offset_m = body->aim_offset_m = body->wish_offset_m;
}

/* Is there room in the crowd for a body at its place? Then it is added. */
static bool settle(struct crowd *crowd, struct body *body, bool outside_crossings)
{
    body_place(body);
    for (size_t i = 0; i < crowd->count; i++) {
        const struct body *other = &crowd->bodies[i];
        double apart = fabs(other->s_m - body->s_m) - (other->length_m + body->length_m) / 2;
        if (other->track != body->track) continue;
        if (body->is_person ? walkers_touch(body, other, PERSON_GAP_M / 2) : apart < STANDING_GAP_M)
            return false;
    }
    if (!crossing_appear(crowd, body)) return false;
    if (outside_crossings && body->held_from < body->held_to) {
        crossing_leave(crowd, body);
        return false;
    }
    body->speed_m_s = body->is_person ? walk_first_speed(crowd, body) : drive_first_speed(crowd, body);
    crowd->bodies[crowd->count++] = *body;
    return true;
}

/* A place to begin at: they are apart, whoever takes them. */
struct place { struct track *track; double s_m, order; bool backward, taken; };

static int in_order(const void *a, const void *b)
{
    const struct place *p = a, *q = b;
    return (p->order > q->order) - (p->order < q->order);
}

/* All places of a use, in a drawn order. Returns NULL without memory. */
static struct place *places_create(size_t *count, const struct crowd *crowd, const struct traffic_options *options,
                                   bool is_person)
{
    struct body_size size = largest_of(options, is_person);
    double pitch = size.length_m + (is_person ? PERSON_GAP_M : PLACE_GAP_M);
    struct place *places = malloc(sizeof *places);
    *count = 0;
    for (size_t t = 0; places && t < crowd->track_count; t++) {
        struct track *track = &crowd->tracks[t];
        double free_m = track->end_m - track->begin_m - size.length_m;
        if (track->use != use_of(is_person) || free_m < 0) continue;
        size_t along = (size_t)(free_m / pitch) + 1, abreast = is_person && is_passable(track, size) ? 2 : 1;
        double slack = free_m - (double)(along - 1) * pitch;
        struct place *more = realloc(places, (*count + along * abreast) * sizeof *more);
        if (!more) {
            free(places);
            return NULL;
        }
        places = more;
        for (size_t i = 0; i < along * abreast; i++) {
            uint32_t number = (uint32_t)*count, k = (uint32_t)(i / abreast);
            double shift = ((double)k + draw(options, number, DRAW_POSITION, is_person ? 2 : 0)) / (double)along;
            places[(*count)++] = (struct place){
                .track = track,
                .s_m = track->begin_m + size.length_m / 2 + k * pitch + slack * shift,
                .backward = i % abreast == 1,
                .order = draw(options, number, DRAW_POSITION, is_person ? 3 : 1),
            };
        }
    }
    if (places) qsort(places, *count, sizeof *places, in_order);
    return places;
}

static bool begin_use(struct crowd *crowd, struct character *characters, size_t first, bool is_person,
                      const struct traffic_options *options, struct error *err)
{
    size_t wanted = is_person ? options->people_count : options->vehicle_count, added = 0, count, tracks = 0;
    const char *who = is_person ? "people" : "vehicles", *where = is_person ? "footway or sidewalk" : "road";
    if (wanted == 0) return true;
    double length = 0;
    for (size_t t = 0; t < crowd->track_count; t++)
        if (crowd->tracks[t].use == use_of(is_person)) {
            tracks++;
            length += crowd->tracks[t].end_m - crowd->tracks[t].begin_m;
        }
    if (tracks == 0) return error_set(err, ERR_INPUT, "%zu %s are wanted and there is no %s for them", wanted, who, where);
    struct place *places = places_create(&count, crowd, options, is_person);
    if (!places) return error_set(err, ERR_MEMORY, "no memory for %zu %s", wanted, who);
    /* Who stood in a crossing at the beginning would hold it up: there only if there is no other place. */
    for (int inside = 0; inside < 2; inside++)
        for (size_t i = 0; i < count && added < wanted; i++) {
            if (places[i].taken) continue;
            struct character *new = &characters[first + added];
            uint32_t n = (uint32_t)(first + added);
            *new = character_draw(options, n, is_person);
            new->body.track = places[i].track;
            new->body.s_m = places[i].s_m;
            if (is_person) choose_side(&new->body, crowd, options, places[i].backward);
            places[i].taken = settle(crowd, &new->body, !inside);
            added += places[i].taken;
        }
    free(places);
    if (added == wanted) return true;
    return error_set(err, ERR_INPUT, "%zu %s do not fit onto %zu lanes of %.0f m in all: %zu do", wanted, who, tracks, length,
                     added);
}

bool population_begin(struct crowd *crowd, struct character *characters, const struct traffic_options *options,
                      struct error *err)
{
    if (!begin_use(crowd, characters, 0, false, options, err) ||
        !begin_use(crowd, characters, options->vehicle_count, true, options, err))
        return false;
    /* Now that all are there, each begins as fast as he would be behind the one before him. */
    for (size_t pass = 0; pass < options->vehicle_count; pass++) {
        double change = 0;
        for (size_t i = 0; i < options->vehicle_count; i++) {
            double v = drive_first_speed(crowd, &crowd->bodies[i]);
            change = fmax(change, fabs(v - crowd->bodies[i].speed_m_s));
            crowd->bodies[i].speed_m_s = v;
        }
        if (change < 0.01) break;
    }
    return true;
}

/* Put it at an end of the track: from the beginning, or against the track. */
static bool enter_at(struct crowd *crowd, struct body *body, struct track *track, bool backward,
                     const struct traffic_options *options)
{
    if (track->end_m - track->begin_m < 2 * body->length_m) return false;
    body->track = track;
    if (body->is_person) {
        choose_side(body, crowd, options, backward);
        if ((body->direction < 0) != backward) return false;
    }
    body->s_m = backward ? track->end_m - body->length_m / 2 : track->begin_m + body->length_m / 2;
    return settle(crowd, body, false);
}

bool population_add(struct crowd *crowd, struct character *character, const struct traffic_options *options)
{
    struct body *body = &character->body;
    uint32_t n = (uint32_t)(body->id - options->first_id), gates = 2 * (uint32_t)crowd->track_count;
    /* Gates in a drawn order, that of a longer track sooner: the largest log(u) / length first.
     * Src: Efraimidis, Spirakis 2006, Weighted random sampling with a reservoir */
    for (double before = INFINITY;;) {
        double best = -INFINITY;
        uint32_t chosen = gates;
        for (uint32_t gate = 0; gate < gates; gate++) {
            const struct track *track = &crowd->tracks[gate / 2];
            if (track->use != use_of(body->is_person) || (gate % 2 && !body->is_person)) continue;
            double score = log(draw(options, n, DRAW_LANE, 1 + gate) + 0x1p-54) / fmax(track->end_m - track->begin_m, 0.01);
            if (score < before && score > best) {
                best = score;
                chosen = gate;
            }
        }
        if (chosen == gates) return false;
        if (enter_at(crowd, body, &crowd->tracks[chosen / 2], chosen % 2, options)) return true;
        before = best;
    }
}
