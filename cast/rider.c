#include "cast/rider.h"

#include "cast/coat.h"
#include "cast/part.h"

/* A bone with flesh around it: a ball drawn from a to b. */
struct limb { struct vec3 a, b; double ra, rb; };
enum { LIMBS_MAX = 24 };
struct flesh { struct limb limb[LIMBS_MAX]; int count; double soft_m; };

static double limb_at(const struct limb *l, struct vec3 p)
{
    struct vec3 ab = vec3_sub(l->b, l->a), ap = vec3_sub(p, l->a);
    double t = fmin(fmax(vec3_dot(ap, ab) / fmax(vec3_dot(ab, ab), 1e-9), 0), 1);
    return vec3_norm(vec3_sub(ap, vec3_scale(ab, t))) - (l->ra + t * (l->rb - l->ra));
}

/* A soft minimum. Src: Quilez, Smooth minimum (quadratic polynomial) */
static double flesh_at(const void *self, struct vec3 p)
{
    const struct flesh *f = self;
    double d = 1e9;
    for (int i = 0; i < f->count; i++) {
        double e = limb_at(&f->limb[i], p), h = fmax(f->soft_m - fabs(d - e), 0) / f->soft_m;
        d = fmin(d, e) - h * h * f->soft_m / 4;
    }
    return d;
}

static void limb(struct flesh *f, struct vec3 a, struct vec3 b, double ra, double rb) { f->limb[f->count++] = (struct limb){ a, b, ra, rb }; }

static struct vec3 side(struct vec3 p, int right) { return vec3(p.x, right ? -p.y : p.y, p.z); }

static struct vec3 between(struct vec3 a, struct vec3 b, double t) { return vec3_add(vec3_scale(a, 1 - t), vec3_scale(b, t)); }

static void add_flesh(struct shell *s, const struct flesh *f, enum level level, double fineness, int coat)
{
    struct vec3 low = { 1e9, 1e9, 1e9 }, high = { -1e9, -1e9, -1e9 };
    for (int i = 0; i < f->count; i++) {
        const struct limb *l = &f->limb[i];
        double r = fmax(l->ra, l->rb) + 0.03;
        low = vec3(fmin(low.x, fmin(l->a.x, l->b.x) - r), fmin(low.y, fmin(l->a.y, l->b.y) - r), fmin(low.z, fmin(l->a.z, l->b.z) - r));
        high = vec3(fmax(high.x, fmax(l->a.x, l->b.x) + r), fmax(high.y, fmax(l->a.y, l->b.y) + r), fmax(high.z, fmax(l->a.z, l->b.z) + r));
    }
    if (low.y >= 0) low.y = -0.01;
    double cell = level == NEAR ? 0.026 / fineness : 0.048 / fineness;
    struct form form = { flesh_at, f };
    shell_add_solid(s, &form, low, high, vec3(cell, cell, cell), coat);
}

void add_rider(struct shell *s, const struct rider *r, enum level level)
{
    struct flesh jacket = { .soft_m = 0.07 }, trousers = { .soft_m = 0.06 }, skin = { .soft_m = 0.03 }, shoes = { .soft_m = 0.03 }, helmet = { .soft_m = 0.05 };
    struct vec3 waist = between(r->hip, r->chest, 0.42), back = between(r->hip, r->chest, 0.7);
    limb(&jacket, vec3(r->hip.x, 0.07, r->hip.z + 0.06), vec3(r->hip.x, -0.07, r->hip.z + 0.06), 0.115, 0.115);
    limb(&jacket, vec3(waist.x, 0.05, waist.z), vec3(waist.x, -0.05, waist.z), 0.112, 0.112);
    limb(&jacket, vec3(back.x, 0.07, back.z), vec3(back.x, -0.07, back.z), 0.122, 0.122);
    limb(&jacket, vec3(r->chest.x, 0.10, r->chest.z), vec3(r->chest.x, -0.10, r->chest.z), 0.105, 0.105);
    limb(&jacket, r->chest, r->neck, 0.08, 0.062);
    limb(&skin, r->neck, r->head, 0.052, 0.055);
    limb(&skin, vec3(r->head.x + 0.02, 0, r->head.z + 0.01), vec3(r->head.x - 0.02, 0, r->head.z + 0.03), 0.088, 0.095);
    limb(&skin, vec3(r->head.x + 0.07, 0, r->head.z - 0.06), vec3(r->head.x + 0.06, 0, r->head.z), 0.045, 0.05);
    for (int k = 0; k < 2; k++) {
        struct vec3 shoulder = side(r->shoulder, k), elbow = side(r->elbow, k), hand = side(r->hand, k);
        limb(&jacket, shoulder, elbow, 0.068, 0.052);
        limb(&jacket, elbow, between(elbow, hand, 0.88), 0.052, 0.040);
        limb(&skin, between(elbow, hand, 0.85), hand, 0.032, 0.038);
        struct vec3 joint = vec3(r->hip.x, k ? -r->hip_half : r->hip_half, r->hip.z);
        limb(&trousers, joint, r->knee[k], 0.098, 0.064);
        limb(&trousers, r->knee[k], r->ankle[k], 0.062, 0.050);
        limb(&shoes, r->ankle[k], vec3(r->ankle[k].x - 0.03, r->ankle[k].y, r->ankle[k].z - 0.06), 0.042, 0.040);
        limb(&shoes, vec3(r->ankle[k].x - 0.03, r->ankle[k].y, r->ankle[k].z - 0.06), r->toe[k], 0.040, 0.034);
    }
    limb(&trousers, vec3(r->hip.x - 0.02, 0.06, r->hip.z), vec3(r->hip.x - 0.02, -0.06, r->hip.z), 0.12, 0.12);
    add_flesh(s, &jacket, level, 1, JACKET_COAT);
    add_flesh(s, &trousers, level, 1, TROUSERS_COAT);
    add_flesh(s, &shoes, level, 1.4, SHOES_COAT);
    add_flesh(s, &skin, level, 1.5, SKIN_COAT);
    struct vec3 top = vec3(r->head.x, 0, r->head.z + 0.035);
    if (r->full_helmet) {
        limb(&helmet, vec3(top.x - 0.01, 0, top.z + 0.005), vec3(top.x + 0.02, 0, top.z - 0.03), 0.137, 0.130);
        limb(&helmet, vec3(top.x + 0.08, 0, top.z - 0.085), vec3(top.x, 0, top.z - 0.09), 0.075, 0.09);
        add_flesh(s, &helmet, level, 1, HELMET_COAT);
        int n = level == NEAR ? 18 : 8;
        if (level != FAR) part_blob(s, vec3(top.x + 0.085, 0, top.z - 0.005), vec3(0.075, 0.115, 0.055), 0.7, n, BLACK_PANEL);
    } else
        part_blob(s, vec3(top.x, 0, top.z + 0.055), vec3(0.138, 0.108, 0.085), 0.95, level == NEAR ? 24 : 10, HELMET_COAT);
}
