#include "cast/car.h"

#include "cast/part.h"

#include <stdlib.h>

enum { LAMP_REGION = COATS + 1, CUT_REGION = COATS + 32, BED_REGION = COATS + 36 };

void car_coach(struct coach *coach, const struct car_spec *spec)
{
    *coach = (struct coach){ .axles = 2, .axle_z = spec->wheel.diameter_m / 2, .arch_r = spec->wheel.diameter_m / 2 + spec->arch_gap,
                             .axle_x = { spec->axle_x[0], spec->axle_x[1] } };
    coach_make(coach, &spec->coach);
}

static struct vec3 inward(const void *self, struct vec3 p, struct vec3 n)
{
    struct vec3 q = vec3_sub(p, vec3_scale(n, *(const double *)self));
    q.y = p.y == 0 ? 0 : fmax(q.y, 0.001);
    return q;
}

/* A wheel house narrows inward a little: what of its rim runs inward gets walls, too. */
static struct vec3 into_house(const void *self, struct vec3 p, struct vec3 n)
{
    const struct vec3 *middle = self;
    (void)n;
    return vec3(middle->x + 0.97 * (p.x - middle->x), middle->y, middle->z + 0.97 * (p.z - middle->z));
}

static struct vec3 to_floor(const void *self, struct vec3 p, struct vec3 n)
{
    (void)n;
    return vec3(p.x, p.y, *(const double *)self);
}

/* Large bodies have larger cells. */
static double coarseness(const struct coach *coach) { return fmax(coach->spec->half_width / 0.93, (coach->x[1] - coach->x[0]) / 5.2); }

/* --- lines and fields --- */

static int decal_corners(const struct decal *d)
{
    int n = 0;
    while (n < 9 && d->corner[n].cut >= 0 && (n == 0 || d->corner[n].u != 0 || d->corner[n].v != 0 || d->corner[n].cut != 0)) n++;
    return n;
}

static void draw_decal(struct shell *s, const struct coach *coach, const struct form *solid, const struct decal *d, int index, enum level level)
{
    if (level == FAR && !d->coarse) return;
    if (level != NEAR && d->trace == LINE) return;
    struct mark mark = mark_outline(coach, d->kind, d->corner, decal_corners(d));
    if (d->kind == MARK_TOP) mark.a[0] = 0.5 * (coach->spec->belt[0] + coach->spec->tuck_z);
    struct form form = mark_form(&mark);
    if (d->trace == LINE) {
        double half = d->depth / 2;
        shell_refine(s, solid, &form, half, 0.07 * coarseness(coach)); /* or corners come out as wedges */
        shell_cut(s, solid, &form, half);
        shell_cut(s, solid, &form, -half);
        shell_paint(s, &form, -half, half, PAINT_COAT, d->coat);
        return;
    }
    if (level == NEAR) shell_refine(s, solid, &form, 0.004, 0.045 * coarseness(coach));
    shell_cut(s, solid, &form, 0);
    int region = level == FAR && d->trace == LAMP_HOUSE ? FAR_LAMP : d->trace == FILL || level == FAR ? d->coat : LAMP_REGION + index;
    shell_paint(s, &form, -10, 0, -1, region);
}

static void draw_glass(struct shell *s, const struct form *solid, const struct mark *mark, enum window_kind kind, enum level level)
{
    struct form form = mark_form(mark);
    double seal = level == NEAR ? 0.016 : 0;
    int coat = kind == BLIND_WINDOW ? BLACK_PANEL : level == FAR ? FAR_WINDOW : kind == TINTED_WINDOW ? DARK_WINDOW : WINDOW;
    shell_cut(s, solid, &form, 0);
    if (seal > 0) {
        shell_cut(s, solid, &form, -seal);
        shell_paint(s, &form, -seal, 0, -1, BLACK_PANEL);
    }
    shell_paint(s, &form, -10, -seal, -1, coat);
}

static bool adjoin(const struct window_spec *a, const struct window_spec *b) { return a->kind && b->kind && a->rear_x - b->front_x < 0.25; }

static void draw_windows(struct shell *s, const struct coach *coach, const struct form *solid, const struct car_spec *spec, enum level level)
{
    for (int i = 0; i < 2; i++) {
        const struct screen_spec *g = &spec->screen[i];
        if (!g->kind) continue;
        struct mark mark = mark_pane(coach, g->low, g->high, g->pillar, g->round);
        draw_glass(s, solid, &mark, g->kind, level);
    }
    /* Between neighbours lies a pillar of black; seen from farther off they are one. */
    for (int i = 0; i + 1 < WINDOWS && level == NEAR; i++) {
        const struct window_spec *a = &spec->window[i], *b = &spec->window[i + 1];
        if (!adjoin(a, b)) continue;
        struct mark mark = mark_window(coach, spec->window_sill, spec->window_frame, spec->window_top, a->rear_x + 0.02, a->rear_lean, b->front_x - 0.02, b->front_lean, 0.002);
        struct form form = mark_form(&mark);
        shell_cut(s, solid, &form, 0);
        shell_paint(s, &form, -10, 0, PAINT_COAT, BLACK_PANEL);
    }
    for (int i = 0; i < WINDOWS; i++) {
        const struct window_spec *w = &spec->window[i], *last = w;
        if (!w->kind) continue;
        for (; level != NEAR && i + 1 < WINDOWS && adjoin(last, last + 1); last++) i++;
        struct mark mark = mark_window(coach, spec->window_sill, spec->window_frame, spec->window_top, w->front_x, w->front_lean, last->rear_x, last->rear_lean, spec->window_round);
        draw_glass(s, solid, &mark, last->kind, level);
    }
}

static void draw_doors(struct shell *s, const struct coach *coach, const struct form *solid, const struct car_spec *spec)
{
    const double half = 0.004;
    for (int i = 0; i < DOORS; i++) {
        const struct door_spec *d = &spec->door[i];
        if (d->front_x == d->rear_x) continue;
        struct mark mark = mark_door(coach, spec->door_bottom, spec->door_frame, d->front_x, d->front_lean, d->rear_x, d->rear_lean, 0.05);
        struct form form = mark_form(&mark);
        shell_refine(s, solid, &form, 0, 0.085 * coarseness(coach));
        shell_cut(s, solid, &form, half);
        shell_cut(s, solid, &form, -half);
        shell_paint(s, &form, -half, half, PAINT_COAT, GAP);
    }
}

/* --- fittings --- */

static void add_pair(struct shell *body, const struct shell *left)
{
    shell_append(body, left, vec3(0, 0, 0), false);
    shell_append(body, left, vec3(0, 0, 0), true);
}

/* How far seats are from the middle. */
static double seat_y(const struct car_spec *spec) { return 0.42 * spec->coach.half_width + 0.01; }

static void add_seats(struct shell *left, struct shell *body, const struct car_spec *spec, enum level level)
{
    int n = level == NEAR ? 10 : 8;
    double z = spec->seat_z, half = spec->coach.half_width;
    for (int i = 0; i < SEATS; i++) {
        double x = spec->seat_x[i];
        if (i && x == 0) continue;
        size_t first = left->points;
        double y = seat_y(spec);
        part_blob(left, vec3(x + 0.16, y, z), vec3(0.28, 0.255, 0.09), 0.45, n, SEAT);
        first = left->points;
        part_blob(left, vec3(x - 0.10, y, z + 0.34), vec3(0.085, 0.245, 0.36), 0.45, n, SEAT);
        if (level == NEAR) part_blob(left, vec3(x - 0.10, y, z + 0.76), vec3(0.05, 0.13, 0.09), 0.5, n, SEAT);
        part_turn(left, first, vec3(x - 0.1, y, z), -16, 0, 0);
    }
    if (level != NEAR) return;
    double dash = spec->screen[0].low.x;
    part_blob(body, vec3(dash - 0.34, 0, spec->coach.belt[0] - 0.13), vec3(0.22, half - 0.20, 0.11), 0.4, 20, LINING);
    struct vec3 ring[21], hub = vec3(spec->seat_x[0] + 0.40, seat_y(spec), z + 0.40);
    size_t first = body->points;
    for (int k = 0; k <= 20; k++) ring[k] = vec3(hub.x, hub.y + 0.18 * sin(2 * PI * k / 20), hub.z + 0.18 * cos(2 * PI * k / 20));
    part_tube(body, ring, 21, 0.016, 0.016, 6, LINING);
    part_blob(body, hub, vec3(0.03, 0.17, 0.04), 0.6, 8, LINING);
    part_turn(body, first, hub, 25, 0, 0);
}

/* Glass, flat as it is: a rounded one shows the sun from everywhere. Across the housing's back, with a rim round it. */
static void add_mirror_glass(struct shell *left, struct vec3 at, struct vec3 half, int n)
{
    double outline[18][2];
    const struct { double size, from, thick; int material; } plates[] = {
        { 0.80, -0.80 * half.x, 0.20 * half.x + 0.003, TRIM_COAT }, { 0.74, -half.x - 0.003, 0.002, MIRROR_COAT }
    };
    for (int k = 0; k < 2; k++) {
        for (int i = 0; i < n; i++) {
            double c = cos(2 * PI * i / n), s = sin(2 * PI * i / n), round = plates[k].size / pow(pow(fabs(c), 3) + pow(fabs(s), 3), 1 / 3.0);
            outline[i][0] = half.z * c * round;
            outline[i][1] = half.y * s * round;
        }
        part_plate(left, vec3(at.x + plates[k].from, at.y, at.z), vec3(0, 0, 1), vec3(0, 1, 0), outline, n, plates[k].thick, plates[k].material);
    }
}

static void add_mirror(struct shell *left, const struct car_spec *spec, const struct coach *coach, enum level level)
{
    struct vec3 at = spec->mirror, half = spec->mirror_half;
    if (half.x == 0) return;
    int n = level == NEAR ? 18 : 8;
    size_t first = left->points;
    part_blob(left, at, half, 0.62, n, spec->mirror_coat);
    part_turn(left, first, at, 0, -8, 0);
    if (level == FAR) return;
    double flank = coach_half_width(coach, at.x, at.z - half.z);
    first = left->points;
    add_mirror_glass(left, at, half, n);
    part_turn(left, first, at, 0, -8, 0);
    if (level == NEAR)
        part_blob(left, vec3(at.x, (flank + at.y - half.y) / 2 + 0.02, at.z - 0.8 * half.z), vec3(0.035, fabs(at.y - half.y - flank) / 2 + 0.06, 0.022), 0.6, 8, TRIM_COAT);
}

static void add_plate(struct shell *body, const struct coach *coach, double sign, double z, enum level level)
{
    if (z == 0) return;
    double x = sign * fmax(sign * coach_end(coach, sign, 0, z), fmax(sign * coach_end(coach, sign, 0, z + 0.07), sign * coach_end(coach, sign, 0, z - 0.07))) + sign * 0.004;
    part_box(body, vec3(x, 0, z), vec3(0.006, 0.152, 0.076), 0.003, PLATE_WHITE);
    if (level != NEAR) return;
    static const double at[] = { -0.105, -0.065, -0.025, 0.035, 0.075, 0.115 };
    for (int k = 0; k < 6; k++) part_box(body, vec3(x + sign * 0.005, at[k], z - 0.005), vec3(0.002, 0.012, 0.032), 0.0005, PLATE_TEXT);
    part_box(body, vec3(x + sign * 0.005, 0, z + 0.058), vec3(0.002, 0.06, 0.008), 0.0005, PLATE_TEXT);
}

static void add_handle(struct shell *left, const struct coach *coach, double x, double z)
{
    double y = coach_half_width(coach, x, z);
    part_blob(left, vec3(x, y + 0.008, z), vec3(0.095, 0.022, 0.016), 0.6, 10, PAINT_COAT);
    part_blob(left, vec3(x + 0.005, y - 0.004, z - 0.004), vec3(0.06, 0.008, 0.026), 0.7, 8, GAP);
}

static void add_fittings(struct shell *body, const struct coach *coach, const struct car_spec *spec, enum level level)
{
    struct shell left = { 0 };
    add_mirror(&left, spec, coach, level);
    if (level != FAR && spec->seat_z > 0) add_seats(&left, body, spec, level);
    add_plate(body, coach, 1, spec->plate_z.x, level);
    add_plate(body, coach, -1, spec->plate_z.y, level);
    if (level == NEAR) {
        for (int i = 0; i < DOORS; i++)
            if (spec->door[i].handle_x != 0) add_handle(&left, coach, spec->door[i].handle_x, spec->handle_z);
        if (spec->badge_z.x > 0) part_blob(body, vec3(coach_end(coach, 1, 0, spec->badge_z.x), 0, spec->badge_z.x), vec3(0.012, 0.055, 0.034), 0.9, 16, BRIGHT);
        if (spec->badge_z.y > 0) part_blob(body, vec3(coach_end(coach, -1, 0, spec->badge_z.y), 0, spec->badge_z.y), vec3(0.010, 0.05, 0.03), 0.9, 16, BRIGHT);
        if (spec->wiper_x != 0)
            for (int k = 0; k < 2; k++) {
                double y = k ? -0.62 : 0.02;
                part_rod(body, vec3(spec->wiper_x + 0.02, y, spec->wiper_z), vec3(spec->wiper_x - 0.03, y + 0.55, spec->wiper_z + 0.035), 0.007, 5, TRIM_COAT);
            }
    }
    if (spec->fin) {
        double x = spec->screen[1].high.x + 0.22, span[2];
        if (outline_span(span, &coach->side, x)) part_blob(body, vec3(x, 0, span[1] + 0.005), vec3(0.09, 0.02, 0.045), 0.9, level == NEAR ? 10 : 6, PAINT_COAT);
    }
    double span[2];
    const double *sign = spec->roof_sign, *rails = spec->rails;
    if (sign[1] > 0 && outline_span(span, &coach->side, sign[0])) {
        part_box(body, vec3(sign[0], 0, span[1] + sign[3]), vec3(sign[1], sign[2], sign[3]), 0.025, YELLOW_SIGN);
        part_box(body, vec3(sign[0], 0, span[1] + 0.008), vec3(sign[1] + 0.02, sign[2] + 0.02, 0.012), 0.006, TRIM_COAT);
    }
    if (rails[2] > 0) {
        enum { N = 9 };
        struct vec3 p[N];
        for (int i = 0; i < N; i++) {
            double x = rails[0] + (rails[1] - rails[0]) * i / (N - 1), up = i == 0 || i == N - 1 ? -0.01 : 0.04;
            outline_span(span, &coach->side, x);
            p[i] = vec3(x, rails[2], span[1] - coach->spec->crown * rails[2] * rails[2] + up);
        }
        part_tube(&left, p, N, 0.016, 0.016, level == NEAR ? 8 : 4, TRIM_COAT);
    }
    add_pair(body, &left);
    shell_release(&left);
}

/* --- the body --- */

static struct vec3 cell_of(const struct coach *coach, enum level level)
{
    struct vec3 cell = level == NEAR ? vec3(0.105, 0.090, 0.074) : vec3(0.20, 0.15, 0.13);
    return vec3_scale(cell, coarseness(coach));
}

void car_body(struct shell *body, const struct car_spec *spec, enum level level)
{
    struct coach coach;
    struct shell s = { 0 }, glass = { 0 };
    car_coach(&coach, spec);
    struct form solid = coach_form(&coach);
    double top = 0, bottom = 1e9;
    for (int i = 0; i < coach.side.count; i++) top = fmax(top, coach.side.p[i][1]), bottom = fmin(bottom, coach.side.p[i][1]);
    shell_add_solid(&s, &solid, vec3(coach.x[0], 0, bottom), vec3(coach.x[1], spec->coach.half_width, top), cell_of(&coach, level), PAINT_COAT);

    struct mark skirt = { .coach = &coach, .kind = MARK_BOTTOM, .a = { spec->skirt_z } };
    struct form skirt_form = mark_form(&skirt);
    shell_cut(&s, &solid, &skirt_form, 0);
    shell_paint(&s, &skirt_form, -10, 0, -1, TRIM_COAT);
    draw_windows(&s, &coach, &solid, spec, level);
    for (int i = 0; i < DECALS; i++)
        if (spec->decal[i].trace) draw_decal(&s, &coach, &solid, &spec->decal[i], i, level);
    if (level == NEAR) draw_doors(&s, &coach, &solid, spec);
    for (int a = 0; a < 2 && spec->cladding > 0; a++) {
        struct mark wheel = mark_wheel(&coach, a, spec->arch_inner_y, spec->cladding);
        struct form form = mark_form(&wheel);
        shell_cut(&s, &solid, &form, 0);
        shell_paint(&s, &form, -10, 0, -1, TRIM_COAT);
    }
    if (spec->bed[2] > 0) {
        const double *b = spec->bed;
        const struct corner corner[4] = { { b[0], -b[2], 0.06 }, { b[0], b[2], 0.06 }, { b[1], b[2], 0.06 }, { b[1], -b[2], 0.06 } };
        struct mark mark = mark_outline(&coach, MARK_TOP, corner, 4);
        mark.a[0] = b[3] + 0.1;
        struct form form = mark_form(&mark);
        if (level == NEAR) shell_refine(&s, &solid, &form, 0.006, 0.06);
        shell_cut(&s, &solid, &form, 0);
        shell_paint(&s, &form, -10, 0, -1, BED_REGION);
    }
    for (int a = 0; a < 2; a++) {
        struct mark wheel = mark_wheel(&coach, a, spec->arch_inner_y, 0);
        struct form form = mark_form(&wheel);
        if (level == NEAR) shell_refine(&s, &solid, &form, 0.004, 0.055);
        shell_cut(&s, &solid, &form, 0);
        shell_paint(&s, &form, -10, 0, -1, CUT_REGION + a);
    }

    shell_take(&glass, &s, WINDOW);
    shell_take(&glass, &s, DARK_WINDOW);
    if (level != FAR) {
        struct mark cabin = mark_cabin(&coach, spec->cabin[0], spec->cabin[1], spec->cabin[2]);
        struct form form = mark_form(&cabin);
        shell_line(&s, &form, 0.045, LINING);
    }
    for (int i = 0; i < DECALS; i++) {
        const struct decal *d = &spec->decal[i];
        if (level == FAR || (d->trace != SINK && d->trace != LAMP_HOUSE)) continue;
        if (d->trace == LAMP_HOUSE && level == NEAR) { /* the cover stays where the surface was */
            struct shell cover = { 0 };
            for (size_t f = 0; f < s.faces_count; f++)
                if (s.faces[f].material == LAMP_REGION + i) {
                    uint32_t v[3];
                    for (int k = 0; k < 3; k++) v[k] = shell_point(&cover, s.p[s.faces[f].v[k]], s.n[s.faces[f].v[k]]);
                    shell_face(&cover, v[0], v[1], v[2], LAMP_GLASS);
                }
            shell_append(&glass, &cover, vec3(0, 0, 0), false);
            shell_release(&cover);
        }
        if (level == NEAR) shell_sink(&s, LAMP_REGION + i, d->trace == LAMP_HOUSE ? TRIM_COAT : d->coat, inward, &d->depth);
        for (size_t f = 0; f < s.faces_count; f++)
            if (s.faces[f].material == LAMP_REGION + i) s.faces[f].material = (uint8_t)(level == MIDDLE && d->trace == LAMP_HOUSE ? FAR_LAMP : d->coat);
    }
    for (int a = 0; a < 2; a++) {
        struct vec3 middle = vec3(spec->axle_x[a], spec->arch_inner_y, coach.axle_z);
        shell_hollow(&s, CUT_REGION + a, WHEEL_HOUSE, WHEEL_HOUSE, into_house, &middle, middle);
    }
    if (spec->bed[2] > 0)
        shell_hollow(&s, BED_REGION, BED, BED, to_floor, &spec->bed[3], vec3((spec->bed[0] + spec->bed[1]) / 2, 0, spec->bed[3]));
    shell_append(&s, &glass, vec3(0, 0, 0), false);
    shell_mirror(&s);
    shell_append(body, &s, vec3(0, 0, 0), false);
    shell_release(&s), shell_release(&glass);
    add_fittings(body, &coach, spec, level);
}

void vehicle_add_driver(struct vehicle *vehicle, const struct car_spec *spec, enum level level)
{
    if (level == FAR) return; /* windows are opaque */
    struct seat seat = { .lean_deg = -17, .nod_deg = 3, .toes_deg = { 35, 35 }, .elbows_out = 0.5, .knees_out = 0.12 };
    double x = spec->seat_x[0], y = seat_y(spec), z = spec->seat_z;
    seat.hips = vec3(x + 0.03, y, z + 0.14);
    for (int side = 0; side < 2; side++) {
        double out = side ? -1 : 1;
        seat.wrist[side] = vec3(x + 0.33, y + out * 0.19, z + 0.43);
        seat.ankle[side] = vec3(x + 0.74, y + out * 0.12, z - 0.10);
    }
    crew_seat(&vehicle->driver, vehicle->crew, spec->driver, &seat, level != NEAR);
}

void make_car(struct vehicle *vehicle, const struct vehicle_spec *spec, enum level level)
{
    const struct car_spec *car = spec->form;
    car_body(&vehicle->body, car, level);
    if (car->seat_z > 0) vehicle_add_driver(vehicle, car, level);
    double outer = car->coach.half_width - car->wheel_out;
    vehicle_add_axle(vehicle, &car->wheel, "wheel_front_left", "wheel_front_right", car->axle_x[0], outer, level);
    const struct wheel_spec *rear = car->rear_wheel.diameter_m > 0 ? &car->rear_wheel : &car->wheel;
    vehicle_add_axle(vehicle, rear, "wheel_rear_left", "wheel_rear_right", car->axle_x[1], outer, level);
}
