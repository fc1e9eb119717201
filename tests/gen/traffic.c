#include "gen/motion/traffic.h"

#include "tests/tap.h"

#define LIMIT 4000

/* A network made by hand: a way has lanes at these offsets. */
struct plan { enum road_use use; const struct vec2 *p; size_t n; double offset[4], width; bool backward[4]; size_t lanes; double limit; };

static struct road_network build(const struct plan *plans, size_t n)
{
    struct road_network roads = { .ways = calloc(n, sizeof *roads.ways), .way_count = n };
    struct error err = ERROR_NONE;
    for (size_t i = 0; i < n; i++) {
        struct way *way = &roads.ways[i];
        way->use = plans[i].use;
        if (!path_create(&way->path, plans[i].p, plans[i].n, &err)) printf("Bail out! %s\n", err.text);
        way->lane_count = plans[i].lanes;
        way->lanes = calloc(4, sizeof *way->lanes);
        for (size_t k = 0; k < way->lane_count; k++)
            way->lanes[k] = (struct lane){ .use = plans[i].use, .offset_m = plans[i].offset[k], .width_m = plans[i].width,
                                           .backward = plans[i].backward[k], .speed_limit_m_s = plans[i].limit };
    }
    return roads;
}

static void tear_down(struct road_network *roads)
{
    for (size_t i = 0; i < roads->way_count; i++) {
        path_release(&roads->ways[i].path);
        free(roads->ways[i].lanes);
    }
    free(roads->ways);
}

static const struct mover_kind cars[2] = { { 0, 3, 4.5, 1.8 }, { 1, 1, 5.2, 2.0 } }, persons[1] = { { 7, 1, 0.7, 0.55 } };

static struct traffic_options options_for(size_t vehicles, size_t people, uint64_t seed)
{
    return (struct traffic_options){ .vehicles = cars, .people = persons, .vehicle_kinds = 2, .people_kinds = 1,
                                     .vehicle_count = vehicles, .people_count = people, .vehicle_speed_m_s = 8,
                                     .people_speed_m_s = 1.4, .lateral_m_s2 = 2, .color_count = 5, .first_id = 1,
                                     .seed = seed };
}

static struct traffic *make(const struct road_network *roads, const struct traffic_options *options, double end_s)
{
    struct traffic *traffic = NULL;
    struct error err = ERROR_NONE;
    if (!traffic_create(&traffic, roads, options, 0, end_s, &err)) {
        printf("Bail out! %s\n", err.text);
        exit(1);
    }
    return traffic;
}

static const struct mover_kind *kind_of(const struct mover *mover)
{
    return mover->is_person ? &persons[mover->kind] : &cars[mover->kind];
}

static void corners(struct vec2 c[4], const struct mover *mover)
{
    double s = sin(mover->heading_rad), k = cos(mover->heading_rad);
    double l = kind_of(mover)->length_m / 2, w = kind_of(mover)->width_m / 2;
    const double f[4] = { l, l, -l, -l }, g[4] = { w, -w, -w, w };
    for (int i = 0; i < 4; i++)
        c[i] = (struct vec2){ mover->p_m.x + f[i] * s - g[i] * k, mover->p_m.y + f[i] * k + g[i] * s };
}

/* Convex outlines overlap unless an edge of one has all of the other outside. */
static bool overlap(const struct mover *a, const struct mover *b)
{
    if (hypot(a->p_m.x - b->p_m.x, a->p_m.y - b->p_m.y) > 8) return false;
    struct vec2 c[2][4];
    corners(c[0], a);
    corners(c[1], b);
    for (int who = 0; who < 2; who++)
        for (int i = 0; i < 4; i++) {
            struct vec2 p = c[who][i], q = c[who][(i + 1) % 4];
            int outside = 0, own = 0;
            for (int k = 0; k < 4; k++) {
                struct vec2 o = c[1 - who][k], m = c[who][k];
                outside += (q.x - p.x) * (o.y - p.y) - (q.y - p.y) * (o.x - p.x) > 0;
                own += (q.x - p.x) * (m.y - p.y) - (q.y - p.y) * (m.x - p.x) > 1e-9;
            }
            if (outside == 4 && own == 0) return false;
        }
    return true;
}

/* A whole run, looked at ten times a second. */
struct findings {
    size_t fewest[2], most[2];           /* vehicles, people present */
    int overlaps, jumps, slides;
    double fastest_turn_rad_s, hardest_brake_m_s2, most_lateral_m_s2, mean_speed[2], stood[2];
    double walked_abreast_m;             /* nearest two people came */
};

static struct findings watch(const struct traffic *traffic, double end_s)
{
    static struct mover now[LIMIT], last[LIMIT];
    struct findings f = { .fewest = { LIMIT, LIMIT }, .walked_abreast_m = INFINITY };
    size_t last_count = 0, seen[2] = { 0 };
    const double dt = 0.1;
    for (double t = 0; t <= end_s; t += dt) {
        size_t n = traffic_at(traffic, now, t), present[2] = { 0 };
        for (size_t i = 0; i < n; i++) {
            int use = now[i].is_person;
            present[use]++;
            seen[use]++;
            f.mean_speed[use] += now[i].speed_m_s;
            f.stood[use] += now[i].speed_m_s < 0.1;
            for (size_t k = 0; k < i; k++)
                if (overlap(&now[i], &now[k])) {
                    if (f.overlaps++ < 5) printf("# at %.1f s %d and %d overlap near (%.1f, %.1f)\n", t, now[i].id, now[k].id, now[i].p_m.x, now[i].p_m.y);
                } else if (now[i].is_person && now[k].is_person)
                    f.walked_abreast_m = fmin(f.walked_abreast_m, hypot(now[i].p_m.x - now[k].p_m.x, now[i].p_m.y - now[k].p_m.y));
            for (size_t k = 0; k < last_count; k++) {
                if (last[k].id != now[i].id) continue;
                double dx = now[i].p_m.x - last[k].p_m.x, dy = now[i].p_m.y - last[k].p_m.y, step = hypot(dx, dy);
                double turn = fabs(remainder(now[i].heading_rad - last[k].heading_rad, 2 * M_PI)) / dt;
                f.jumps += step > dt * fmax(now[i].speed_m_s, last[k].speed_m_s) * 1.1 + 0.01 ||
                           now[i].is_person != last[k].is_person || now[i].kind != last[k].kind ||
                           now[i].color != last[k].color || now[i].distance_m < last[k].distance_m;
                f.fastest_turn_rad_s = fmax(f.fastest_turn_rad_s, turn);
                if (!use) f.most_lateral_m_s2 = fmax(f.most_lateral_m_s2, turn * (now[i].speed_m_s + last[k].speed_m_s) / 2);
                if (!use) f.hardest_brake_m_s2 = fmax(f.hardest_brake_m_s2, (last[k].speed_m_s - now[i].speed_m_s) / dt);
                double heading = (now[i].heading_rad + last[k].heading_rad) / 2;
                if (turn < 1 && fabs(now[i].heading_rad) < 3 && step > 0.05)
                    f.slides += fabs(dx * cos(heading) - dy * sin(heading)) > 0.02 + 0.15 * step;
            }
        }
        for (int use = 0; use < 2; use++) {
            if (present[use] < f.fewest[use]) f.fewest[use] = present[use];
            if (present[use] > f.most[use]) f.most[use] = present[use];
        }
        memcpy(last, now, n * sizeof *now);
        last_count = n;
    }
    for (int use = 0; use < 2; use++) {
        f.mean_speed[use] /= fmax((double)seen[use], 1);
        f.stood[use] /= fmax((double)seen[use], 1);
    }
    return f;
}

static void print(const struct findings *f)
{
    printf("# vehicles %zu to %zu, mean %.1f m/s, standing %.0f %%; people %zu to %zu, mean %.2f m/s, standing %.0f %%; "
           "turn %.2f rad/s, people %.2f m apart\n", f->fewest[0], f->most[0], f->mean_speed[0],
           100 * f->stood[0], f->fewest[1], f->most[1], f->mean_speed[1], 100 * f->stood[1], f->fastest_turn_rad_s,
           f->walked_abreast_m);
}

/* Two streets that cross, one with sidewalks, and a footway over the other. */
static const struct vec2 east_west[2] = { { -60, 0 }, { 60, 0 } }, north_south[3] = { { 5, -60 }, { 5, 5 }, { 15, 55 } },
                         footway[2] = { { -30, -25 }, { -30, 25 } };
static const struct plan town[] = {
    { ROAD_VEHICLES, east_west, 2, { 1.5, -1.5 }, 3, { true, false }, 2, 0 },
    { ROAD_PEOPLE, east_west, 2, { 4.2, -4.2 }, 2, { false, false }, 2, 0 },
    { ROAD_VEHICLES, north_south, 3, { 1.5, -1.5 }, 3, { true, false }, 2, 0 },
    { ROAD_PEOPLE, footway, 2, { 0 }, 2.5, { false }, 1, 0 },
};

/* Like brighton's: a street of some 85 m, a winding service road, a footway from one to the other. */
static const struct vec2 street[8] = { { -30.9, -17.2 }, { -25.8, -11.7 }, { -14, 1.1 }, { -5.6, 9.8 },
                                       { 1.9, 17.1 }, { 10.3, 24.9 }, { 19.7, 34.1 }, { 27.2, 43.7 } };
static const struct vec2 service[10] = { { -12.2, -37.2 }, { -4.2, -28.5 }, { 4.2, -19.8 }, { 11.7, -13 }, { 14.4, -7.4 },
                                         { 13.3, 0.9 }, { 12, 6.5 }, { 15.7, 11.6 }, { 21.3, 13.4 }, { 25.5, 16.5 } };
static const struct vec2 path[4] = { { 15.7, 11.6 }, { 8.3, 10.3 }, { 3.2, 10.8 }, { 0, 11.8 } };
static const struct plan beach[] = {
    { ROAD_VEHICLES, street, 8, { 1.5, -1.5 }, 3, { true, false }, 2, 0 },
    { ROAD_PEOPLE, street, 8, { 3.9, -3.9 }, 1.8, { false, false }, 2, 0 },
    { ROAD_VEHICLES, service, 10, { 1.25, -1.25 }, 2.5, { true, false }, 2, 5 },
    { ROAD_PEOPLE, path, 4, { 0.5, -0.5 }, 1, { true, false }, 2, 0 },
};

static void test_run(const char *name, const struct plan *plans, size_t n, size_t vehicles, size_t people)
{
    struct road_network roads = build(plans, n);
    for (uint64_t seed = 1; seed <= 3; seed++) {
        struct traffic_options options = options_for(vehicles, people, seed);
        struct traffic *traffic = make(&roads, &options, 130);
        struct findings f = watch(traffic, 130);
        print(&f);
        OK(f.overlaps == 0, "%s, seed %d: no two bodies ever overlap (%d do)", name, (int)seed, f.overlaps);
        OK(f.fewest[0] + 2 >= vehicles && f.most[0] == vehicles && f.fewest[1] + 2 >= people && f.most[1] == people,
           "as many as asked for are about all the time");
        OK(f.jumps == 0 && f.slides == 0, "each goes on from where it was, the way it heads (%d jumps, %d slides)", f.jumps, f.slides);
        OK(f.fastest_turn_rad_s < 1.6, "headings turn as bodies can");
        OK(f.most_lateral_m_s2 < 2.1, "vehicles keep v^2 * curvature within 2 m/s^2 (%.2f)", f.most_lateral_m_s2);
        OK(f.hardest_brake_m_s2 < 2.5, "and brake early enough to do it gently (%.1f m/s^2)", f.hardest_brake_m_s2);
        OK(f.mean_speed[0] > 1.5 && f.mean_speed[1] > 0.9 && f.stood[1] < 0.25, "all get on");
        traffic_destroy(traffic);
    }
    tear_down(&roads);
}

static bool same(const struct mover *a, const struct mover *b)
{
    return a->id == b->id && a->is_person == b->is_person && a->kind == b->kind && a->color == b->color && a->p_m.x == b->p_m.x &&
           a->p_m.y == b->p_m.y && a->heading_rad == b->heading_rad && a->speed_m_s == b->speed_m_s &&
           a->distance_m == b->distance_m && a->phase == b->phase;
}

static void test_seeds(void)
{
    static struct mover a[LIMIT], b[LIMIT];
    struct road_network roads = build(beach, 4);
    struct traffic_options options = options_for(12, 12, 42);
    struct traffic *one = make(&roads, &options, 60), *again = make(&roads, &options, 60);
    bool equal = true, ordered = true;
    for (int k = 0; k <= 40; k++) { /* one is asked forwards, the other in leaps */
        double t = 1.5 * (k * 17 % 41);
        for (int early = 0; early <= k % 3; early++) traffic_at(one, a, 59 - early);
        size_t n = traffic_at(one, a, t), m = traffic_at(again, b, t);
        equal = equal && n == m && n == 24;
        for (size_t i = 0; i < n && i < m; i++) {
            equal = equal && same(&a[i], &b[i]);
            ordered = ordered && (i == 0 || a[i].id > a[i - 1].id) && a[i].id >= 1 && a[i].id <= traffic_mover_count(one);
        }
    }
    OK(equal && traffic_mover_count(one) == traffic_mover_count(again), "the same seed is the same scenario, in any order of times");
    OK(ordered, "ids ascend, none twice, within the count that is told");

    static bool seen[LIMIT], gone[LIMIT];
    bool returns = false;
    size_t ids = 0;
    for (double t = 0; t <= 60; t += 0.05) {
        bool now[LIMIT] = { false };
        size_t n = traffic_at(one, a, t);
        for (size_t i = 0; i < n; i++) now[a[i].id] = true;
        for (size_t id = 1; id <= traffic_mover_count(one); id++) {
            returns = returns || (now[id] && gone[id]);
            ids += now[id] && !seen[id];
            gone[id] = seen[id] && !now[id];
            seen[id] = seen[id] || now[id];
        }
    }
    OK(ids == traffic_mover_count(one) && !returns, "every id is somebody's, once: who left does not come back");

    size_t n = traffic_at(one, a, 30);
    double phase = 0, slowest = 9, fastest = 0;
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; a[i].is_person && k < i; k++)
            if (a[k].is_person) {
                phase = fmax(phase, fabs(a[i].phase - a[k].phase));
                slowest = fmin(slowest, a[i].speed_m_s);
                fastest = fmax(fastest, a[i].speed_m_s);
            }
    OK(phase > 0.5 && fastest - slowest > 0.2, "people are out of step and each has his speed (%.2f to %.2f m/s)", slowest, fastest);
    options.seed = 43;
    struct traffic *other = make(&roads, &options, 60);
    size_t m = traffic_at(other, b, 30), alike = 0;
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < m; k++) alike += hypot(a[i].p_m.x - b[k].p_m.x, a[i].p_m.y - b[k].p_m.y) < 0.05;
    OK(alike < 3, "another seed is another scenario");
    traffic_destroy(one);
    traffic_destroy(again);
    traffic_destroy(other);
    tear_down(&roads);
}

static void test_refused(void)
{
    struct road_network roads = build(beach, 2);
    struct traffic *traffic = NULL;
    struct error err = ERROR_NONE;
    struct traffic_options options = options_for(500, 0, 1);
    int fit = 0;
    OK(!traffic_create(&traffic, &roads, &options, 0, 5, &err) && err.code == ERR_INPUT && !traffic, "500 cars on 170 m are refused");
    const char *told = strrchr(err.text, ':');
    OK(told && sscanf(told, ": %d do", &fit) == 1 && fit >= 18 && fit <= 24, "with how many fit: %s", err.text);
    options.vehicle_count = (size_t)fit;
    err = ERROR_NONE;
    OK(traffic_create(&traffic, &roads, &options, 0, 5, &err), "and so many do fit");
    traffic_destroy(traffic);
    traffic = NULL;
    options = options_for(0, 4, 1);
    roads.way_count = 1;
    err = ERROR_NONE;
    OK(!traffic_create(&traffic, &roads, &options, 0, 5, &err) && strstr(err.text, "footway"), "people without a footway are refused: %s",
       err.text);
    options = options_for(2, 0, 1);
    options.vehicle_kinds = 0;
    err = ERROR_NONE;
    OK(!traffic_create(&traffic, &roads, &options, 0, 5, &err) && strstr(err.text, "model"), "vehicles without a model are refused");
    options = options_for(2, 0, 1);
    options.first_id = 65534;
    err = ERROR_NONE;
    OK(!traffic_create(&traffic, &roads, &options, 0, 600, &err) && strstr(err.text, "ids"), "so are more than there are ids for");
    err = ERROR_NONE;
    options = options_for(0, 0, 1);
    static struct mover movers[1];
    OK(traffic_create(&traffic, &roads, &options, 0, 5, &err) && traffic_mover_count(traffic) == 0 &&
       traffic_at(traffic, movers, 3) == 0, "nobody is nobody");
    traffic_destroy(traffic);
    roads.way_count = 2;
    tear_down(&roads);
}

/* A street in two pieces, the second slower, and a path too narrow for two. */
static void test_lanes(void)
{
    static struct mover now[LIMIT];
    static const struct vec2 west[2] = { { -80, 0 }, { 0, 0 } }, east[2] = { { 0, 0.2 }, { 80, 10 } },
                             narrow[2] = { { 0, 40 }, { 60, 40 } };
    const struct plan plans[] = { { ROAD_VEHICLES, west, 2, { -1.5 }, 3, { false }, 1, 0 },
                                  { ROAD_VEHICLES, east, 2, { -1.5 }, 3, { false }, 1, 4 },
                                  { ROAD_PEOPLE, narrow, 2, { 0 }, 0.9, { false }, 1, 0 } };
    struct road_network roads = build(plans, 3);
    struct traffic_options options = options_for(4, 6, 5);
    struct traffic *traffic = make(&roads, &options, 60);
    bool crossed[LIMIT] = { false }, before[LIMIT] = { false };
    size_t across = 0;
    double fastest[2] = { 0 }, east_going = 0, walking = 0;
    for (double t = 0; t < 60; t += 0.25) {
        size_t n = traffic_at(traffic, now, t);
        for (size_t i = 0; i < n; i++) {
            if (now[i].is_person) {
                walking++;
                east_going += sin(now[i].heading_rad) > 0;
                continue;
            }
            if (now[i].p_m.x < -2) before[now[i].id] = true;
            if (now[i].p_m.x > 2 && before[now[i].id] && !crossed[now[i].id]) {
                crossed[now[i].id] = true;
                across++;
            }
            if (now[i].p_m.x < 0) fastest[0] = fmax(fastest[0], now[i].speed_m_s);
            if (now[i].p_m.x > 20) fastest[1] = fmax(fastest[1], now[i].speed_m_s);
        }
    }
    OK(across >= 4, "where a way goes on in another, so do those who drive on it (%zu did)", across);
    OK(fastest[0] > 7 && fastest[1] < 4 * 1.25 + 0.2, "as fast as they wish (%.1f m/s), where the law lets them (%.1f m/s)", fastest[0],
       fastest[1]);
    OK(walking > 500 && (east_going == 0 || east_going == walking), "a path too narrow for two is walked one way");
    traffic_destroy(traffic);
    tear_down(&roads);
}

int main(void)
{
    test_run("a crossing", town, 4, 12, 24);
    test_run("a beach", beach, 4, 12, 12);
    test_seeds();
    test_refused();
    test_lanes();
    return tap_done();
}
