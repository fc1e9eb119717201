#include "cast/field.h"

#include <assert.h>
#include <stdint.h>
#include <string.h>

double ramp(double a, double b, double x)
{
    double t = fmin(fmax((x - a) / (b - a), 0), 1);
    return t * t * (3 - 2 * t);
}

/* --- noise --- */

static double lattice(int x, int y, int z, uint32_t seed)
{
    uint32_t h = (uint32_t)x * 0x8da6b343u ^ (uint32_t)y * 0xd8163841u ^ (uint32_t)z * 0xcb1ab31fu ^ seed * 0x9e3779b9u;
    h = (h ^ h >> 15) * 0x2c1b3c6du;
    h = (h ^ h >> 12) * 0x297a2d39u;
    return (double)(h ^ h >> 15) / 4294967295.0;
}

double noise(struct vec3 p, double seed)
{
    int x = (int)floor(p.x), y = (int)floor(p.y), z = (int)floor(p.z);
    double u = ramp(0, 1, p.x - x), v = ramp(0, 1, p.y - y), w = ramp(0, 1, p.z - z), sum = 0;
    for (int k = 0; k < 8; k++) {
        int i = k & 1, j = k >> 1 & 1, l = k >> 2;
        sum += lattice(x + i, y + j, z + l, (uint32_t)seed) * (i ? u : 1 - u) * (j ? v : 1 - v) * (l ? w : 1 - w);
    }
    return sum;
}

/* --- solids --- */

static struct vec3 local(const struct solid *s, struct vec3 p)
{
    struct vec3 d = vec3_sub(p, s->at);
    const double(*m)[3] = s->axes.m;
    return vec3(m[0][0] * d.x + m[1][0] * d.y + m[2][0] * d.z, m[0][1] * d.x + m[1][1] * d.y + m[2][1] * d.z,
                m[0][2] * d.x + m[1][2] * d.y + m[2][2] * d.z);
}

/* About the distance to the surface where rho is 1, n from the middle. */
static double radial(double rho, double n, double least)
{
    return rho > 1e-6 ? n * (1 - 1 / rho) : -least;
}

static struct station section(const struct solid *s, double t)
{
    int i = 0;
    while (i + 2 < s->count && t > s->station[i + 1].t) i++;
    const struct station *a = &s->station[i], *b = a + 1, *va = &s->slope[i], *vb = va + 1;
    double h = b->t - a->t, x = fmin(fmax((t - a->t) / h, 0), 1), y = 1 - x;
    double ka = y * y * (1 + 2 * x), kb = x * x * (1 + 2 * y), kva = h * y * y * x, kvb = -h * x * x * y;
#define MIX(m) ka * a->m + kb * b->m + kva * va->m + kvb * vb->m
    return (struct station){ t, MIX(side), MIX(front), MIX(back), MIX(shift) };
#undef MIX
}

static double tube_field(const struct solid *s, struct vec3 p)
{
    double t = p.z / s->length_m, on = fmin(fmax(t, 0), 1), beyond = (t - on) * s->length_m;
    struct station at = section(s, on);
    double x = p.x - at.shift, y = p.y, wide = x > 0 ? at.front : at.back;
    double cap = s->cap_m[t > 1] > 0 ? s->cap_m[t > 1] : fmin(wide, at.side);
    double u = x / wide, v = y / at.side, w = beyond / cap;
    double round = u * u + v * v, rho = sqrt(round + w * w);
    if (s->square > 0) rho += s->square * (sqrt(sqrt(u * u * u * u + v * v * v * v) + w * w) - rho);
    return radial(rho, sqrt(x * x + y * y + beyond * beyond), fmin(wide, at.side));
}

double solid_field(const struct solid *s, struct vec3 world)
{
    struct vec3 p = local(s, world), h = s->half;
    switch (s->kind) {
    case BALL: return radial(sqrt(p.x * p.x / (h.x * h.x) + p.y * p.y / (h.y * h.y) + p.z * p.z / (h.z * h.z)), vec3_norm(p), fmin(h.x, fmin(h.y, h.z)));
    case TUBE: return tube_field(s, p);
    case HALF: return p.z;
    case BOX: {
        struct vec3 q = vec3(fabs(p.x) - h.x + s->round_m, fabs(p.y) - h.y + s->round_m, fabs(p.z) - h.z + s->round_m);
        return vec3_norm(vec3(fmax(q.x, 0), fmax(q.y, 0), fmax(q.z, 0))) + fmin(fmax(q.x, fmax(q.y, q.z)), 0) - s->round_m;
    }
    }
    return 0;
}

static double least_of(double a, double b, double soft)
{
    double h = soft > 0 ? fmax(soft - fabs(a - b), 0) : 0;
    return fmin(a, b) - (h > 0 ? h * h / (4 * soft) : 0);
}

/* Folds run around a limb where it bends, and down where cloth hangs. */
static double folds(const struct shape *shape, struct vec3 p)
{
    double hang = noise(vec3(p.x * 15, p.y * 15, p.z * 3.5 + 1.5 * (p.x + p.y)), shape->seed) - 0.5, depth = 0;
    double all = shape->folds_m * 2 * hang;
    for (int i = 0; i < shape->crease_count; i++) {
        const struct crease *c = &shape->crease[i];
        depth += c->depth_m * ramp(c->reach_m, 0.2 * c->reach_m, vec3_norm(vec3_sub(p, c->at)));
    }
    if (depth > 0) {
        double slant = 5 * noise(vec3(p.x * 5, p.y * 5, p.z * 5), shape->seed + 3);
        double ring = noise(vec3(p.x * 5, p.y * 5, p.z * 26 + slant + 10 * p.y), shape->seed + 7);
        all += depth * (2 * fabs(2 * ring - 1) - 0.6);
    }
    return all;
}

double field(const struct shape *shape, struct vec3 p)
{
    double all = 1e3;
    for (int i = 0; i < shape->count; i++) {
        const struct solid *s = &shape->solid[i];
        if (s->kind != HALF) {
            double away = vec3_norm(vec3_sub(p, s->bound)) - s->bound_m;
            if (s->blend == JOIN ? away > all + s->soft_m : s->blend == CUT && away > s->soft_m - all) continue;
        }
        double d = solid_field(s, p);
        all = s->blend == JOIN ? least_of(all, d, s->soft_m) : -least_of(-all, s->blend == CUT ? d : -d, s->soft_m);
    }
    if ((shape->folds_m > 0 || shape->crease_count) && fabs(all) < 0.05) all += folds(shape, p);
    return all;
}

struct vec3 field_normal(const struct shape *shape, struct vec3 p, double h)
{
    /* Four corners of a tetrahedron tell a gradient. */
    static const double corner[4][3] = { { 1, -1, -1 }, { -1, -1, 1 }, { -1, 1, -1 }, { 1, 1, 1 } };
    struct vec3 sum = { 0, 0, 0 };
    for (int k = 0; k < 4; k++) {
        struct vec3 c = vec3(corner[k][0], corner[k][1], corner[k][2]);
        sum = vec3_add(sum, vec3_scale(c, field(shape, vec3_add(p, vec3_scale(c, h)))));
    }
    double n = vec3_norm(sum);
    return n > 0 ? vec3_scale(sum, 1 / n) : vec3(0, 0, 1);
}

/* --- making them --- */

static struct solid *append(struct shape *shape, enum solid_kind kind, enum blend blend, double soft_m, struct vec3 at)
{
    assert(shape->count < SOLIDS);
    struct solid *s = &shape->solid[shape->count++];
    *s = (struct solid){ .kind = kind, .blend = blend, .soft_m = soft_m, .at = at, .axes = mat3_identity() };
    return s;
}

void solid_settle(struct solid *s)
{
    double wide = 0;
    for (int i = 0; i < s->count; i++) {
        const struct station *a = &s->station[i > 0 ? i - 1 : i], *b = &s->station[i + 1 < s->count ? i + 1 : i];
        double h = b->t - a->t;
        s->slope[i] = (struct station){ 1, (b->side - a->side) / h, (b->front - a->front) / h, (b->back - a->back) / h, (b->shift - a->shift) / h };
        const struct station *at = &s->station[i];
        wide = fmax(wide, fmax(at->side, fmax(at->front, at->back) + fabs(at->shift)));
    }
    if (s->kind == TUBE) {
        s->bound = vec3_add(s->at, vec3_scale(mat3_column(s->axes, 2), s->length_m / 2));
        s->bound_m = s->length_m / 2 + 1.5 * wide;
    } else {
        s->bound = s->at;
        s->bound_m = s->kind == BALL ? fmax(s->half.x, fmax(s->half.y, s->half.z)) : vec3_norm(s->half);
    }
}

struct solid *add_ball(struct shape *shape, enum blend blend, double soft_m, struct vec3 at, struct vec3 half)
{
    struct solid *s = append(shape, BALL, blend, soft_m, at);
    s->half = half;
    solid_settle(s);
    return s;
}

struct solid *add_box(struct shape *shape, enum blend blend, double soft_m, struct vec3 at, struct vec3 half, double round_m)
{
    struct solid *s = append(shape, BOX, blend, soft_m, at);
    s->half = half;
    s->round_m = round_m;
    solid_settle(s);
    return s;
}

static struct mat3 axes_of(struct vec3 up, struct vec3 front)
{
    struct vec3 left = vec3_unit(vec3_cross(up, front));
    return mat3_from_columns(vec3_cross(left, up), left, up);
}

struct solid *add_half(struct shape *shape, enum blend blend, double soft_m, struct vec3 at, struct vec3 normal)
{
    struct solid *s = append(shape, HALF, blend, soft_m, at);
    struct vec3 up = vec3_unit(normal);
    s->axes = axes_of(up, fabs(up.x) < 0.9 ? vec3(1, 0, 0) : vec3(0, 1, 0));
    return s;
}

struct solid *add_tube(struct shape *shape, enum blend blend, double soft_m, struct vec3 a, struct vec3 b, struct vec3 front,
                       const struct station *station, int count)
{
    assert(count >= 2 && count <= STATIONS);
    struct solid *s = append(shape, TUBE, blend, soft_m, a);
    struct vec3 way = vec3_sub(b, a);
    s->length_m = vec3_norm(way);
    s->axes = axes_of(vec3_unit(way), front);
    s->count = count;
    memcpy(s->station, station, (size_t)count * sizeof *station);
    solid_settle(s);
    return s;
}

struct solid *add_rod(struct shape *shape, enum blend blend, double soft_m, struct vec3 a, double ra, struct vec3 b, double rb)
{
    struct vec3 way = vec3_sub(b, a);
    struct vec3 front = fabs(way.x) < 0.9 * vec3_norm(way) ? vec3(1, 0, 0) : vec3(0, 0, 1);
    return add_tube(shape, blend, soft_m, a, b, front, (struct station[]){ { 0, ra, ra, ra, 0 }, { 1, rb, rb, rb, 0 } }, 2);
}

void add_chain(struct shape *shape, enum blend blend, double soft_m, const struct vec3 *knot, const double *radius, int count)
{
    for (int i = 0; i + 1 < count; i++) add_rod(shape, blend, soft_m, knot[i], radius[i], knot[i + 1], radius[i + 1]);
}

struct solid *add_solid(struct shape *shape, const struct solid *solid)
{
    assert(shape->count < SOLIDS);
    shape->solid[shape->count] = *solid;
    return &shape->solid[shape->count++];
}

void add_crease(struct shape *shape, struct vec3 at, double reach_m, double depth_m)
{
    assert(shape->crease_count < CREASES);
    shape->crease[shape->crease_count++] = (struct crease){ at, reach_m, depth_m };
}

void solid_tip(struct solid *s, double angle)
{
    s->axes = mat3_multiply(s->axes, mat3_from_quat((struct quat){ cos(angle / 2), 0, -sin(angle / 2), 0 }));
    solid_settle(s);
}

struct solid solid_mirrored(const struct solid *solid)
{
    struct solid s = *solid;
    s.at.y = -s.at.y;
    struct vec3 c[3];
    for (int k = 0; k < 3; k++) c[k] = mat3_column(s.axes, k), c[k].y = -c[k].y;
    s.axes = mat3_from_columns(c[0], vec3_scale(c[1], -1), c[2]); /* the same to the left and to the right */
    solid_settle(&s);
    return s;
}

void shape_bounds(struct vec3 *low, struct vec3 *high, const struct shape *shape)
{
    *low = vec3(1e9, 1e9, 1e9), *high = vec3(-1e9, -1e9, -1e9);
    for (int i = 0; i < shape->count; i++) {
        const struct solid *s = &shape->solid[i];
        if (s->blend != JOIN) continue;
        struct vec3 half = vec3(s->bound_m, s->bound_m, s->bound_m), a = s->bound, b = s->bound;
        if (s->kind == TUBE) { /* its two ends, as wide as it gets */
            double wide = s->bound_m - s->length_m / 2;
            half = vec3(wide, wide, wide);
            a = s->at, b = vec3_add(s->at, vec3_scale(mat3_column(s->axes, 2), s->length_m));
        }
        *low = vec3(fmin(low->x, fmin(a.x, b.x) - half.x), fmin(low->y, fmin(a.y, b.y) - half.y), fmin(low->z, fmin(a.z, b.z) - half.z));
        *high = vec3(fmax(high->x, fmax(a.x, b.x) + half.x), fmax(high->y, fmax(a.y, b.y) + half.y), fmax(high->z, fmax(a.z, b.z) + half.z));
    }
}
