/* Clothes: the body's own solids, wider; and the skin that they leave bare. */
#include "cast/person.h"

#include <assert.h>

struct garment *add_garment(struct wardrobe *wardrobe, enum piece piece, double cell_m)
{
    assert(wardrobe->count < GARMENTS);
    struct garment *g = &wardrobe->garment[wardrobe->count++];
    *g = (struct garment){ .piece = piece, .cell_m = cell_m, .joint = -1 };
    return g;
}

/* Wider by so much at its beginning and its end. */
static struct solid grown(const struct solid *from, double begin_m, double end_m)
{
    struct solid s = *from;
    for (int i = 0; i < s.count; i++) {
        double more = begin_m + (end_m - begin_m) * s.station[i].t;
        s.station[i].side += more, s.station[i].front += more, s.station[i].back += more;
    }
    if (s.kind == BALL) s.half = vec3_add(s.half, vec3(begin_m, begin_m, begin_m));
    solid_settle(&s);
    return s;
}

/* Cut a limb's cloth off at a point, straight across; what is farther away from it stays. */
static void cut_across(struct shape *shape, struct vec3 at, struct vec3 way, double wide_m, double long_m)
{
    struct shape one = { 0 };
    struct vec3 up = vec3_unit(way), left = vec3_unit(vec3_cross(up, vec3(1, 0, 0)));
    struct solid box = *add_box(&one, CUT, 0.004, vec3_add(at, vec3_scale(up, long_m / 2)), vec3(wide_m, wide_m, long_m / 2), 0);
    box.axes = mat3_from_columns(vec3_cross(left, up), left, up);
    add_solid(shape, &box);
    box = solid_mirrored(&box);
    add_solid(shape, &box);
}

static void join(struct shape *shape, struct solid s, double soft_m)
{
    s.soft_m = soft_m;
    add_solid(shape, &s);
}

static void join_pair(struct shape *shape, struct solid s, double soft_m)
{
    join(shape, s, soft_m);
    join(shape, solid_mirrored(&s), soft_m);
}

/* --- hands and other bare skin --- */

static void make_hand(struct shape *s, const struct body *b)
{
    const struct vec3 *at = &b->at[LIMB(0, 0)];
    double length = 0.109 * b->measures.stature_m;
    struct vec3 down = vec3_unit(vec3_sub(at[HAND], at[FOREARM])), front = vec3(1, 0, 0), in = vec3_cross(front, down); /* to the thigh */
#define AT(d, f, n) vec3_add(at[HAND], vec3_scale(vec3_add(vec3_add(vec3_scale(down, d), vec3_scale(front, f)), vec3_scale(in, n)), length))
    struct solid *palm = add_box(s, JOIN, 0.012, AT(0.27, 0.01, 0), vec3(0.20 * length, 0.075 * length, 0.26 * length), 0.07 * length);
    palm->axes = mat3_from_columns(front, vec3_scale(in, -1), vec3_scale(down, -1));
    static const double finger[4][3] = { { 0.16, 0.42, 0.24 }, { 0.055, 0.48, 0.26 }, { -0.05, 0.45, 0.24 }, { -0.145, 0.35, 0.20 } }; /* place, lengths */
    for (int i = 0; i < 4; i++) {
        double f = finger[i][0], spread = f, near = 0.48, curl = 0.10 + 0.02 * i;
        add_chain(s, JOIN, 0.004, (struct vec3[]){ AT(near - 0.06, f + 0.01, 0), AT(near + finger[i][2], spread + 0.01, curl), AT(near + 0.93 * finger[i][1], 0.75 * spread + 0.005, 0.14 + 2.4 * curl) },
                  (double[]){ 0.052 * length, 0.05 * length, 0.038 * length }, 3);
    }
    add_chain(s, JOIN, 0.008, (struct vec3[]){ AT(0.08, 0.10, 0.04), AT(0.30, 0.21, 0.16), AT(0.52, 0.21, 0.22) }, (double[]){ 0.08 * length, 0.062 * length, 0.042 * length }, 3);
#undef AT
}

static void mirror(struct shape *shape, const struct shape *from)
{
    *shape = *from;
    for (int i = 0; i < shape->count; i++) shape->solid[i] = solid_mirrored(&from->solid[i]);
}

/* From where the sleeve may end, to the fingers. */
static void bare_arms(struct wardrobe *wardrobe, const struct body *b, bool whole)
{
    struct garment *left = add_garment(wardrobe, SKIN_PIECE, whole ? 0.0075 : 0.0065);
    struct shape *s = &left->shape;
    if (whole) join(s, b->upper_arm, 0);
    join(s, b->forearm, 0.02);
    make_hand(s, b);
    if (!whole) { /* a hand's breadth up the sleeve */
        const struct vec3 *at = &b->at[LIMB(0, 0)];
        struct vec3 down = vec3_unit(vec3_sub(at[HAND], at[FOREARM]));
        add_half(s, CUT, 0, vec3_sub(at[HAND], vec3_scale(down, 0.045 * b->measures.stature_m)), down);
    }
    struct garment *right = add_garment(wardrobe, SKIN_PIECE, left->cell_m);
    mirror(&right->shape, s);
}

static void bare_legs(struct wardrobe *wardrobe, const struct body *b, double from_z, double wide_m, enum piece piece)
{
    struct garment *g = add_garment(wardrobe, piece, 0.011);
    join_pair(&g->shape, grown(&b->thigh, wide_m, wide_m), 0.004);
    join_pair(&g->shape, grown(&b->shin, wide_m, wide_m), 0.02);
    add_half(&g->shape, CUT, 0, vec3(0, 0, from_z), vec3(0, 0, -1));
}

/* --- legs --- */

static void wear_trousers(struct wardrobe *wardrobe, const struct person *person, const struct body *b)
{
    enum bottom kind = person->bottom;
    double h = b->measures.stature_m;
    struct garment *g = add_garment(wardrobe, BOTTOM_PIECE, 0.0125);
    struct shape *s = &g->shape;
    double tight = kind == LEGGINGS ? 0.003 : kind == JEANS ? 0.008 : 0.012;
    double wide = kind == LEGGINGS ? 0.003 : kind == JEANS ? 0.012 : kind == SHORTS ? 0.035 : 0.026;
    bool hidden = person->top == COAT || person->top == OPEN_COAT; /* under a coat all is flat */
    double ease = hidden ? -0.004 : 0.008;
    if (hidden) tight = -0.004;
    struct solid seat = grown(&b->trunk, ease, ease), ball = grown(&b->seat, ease, ease);
    join(s, seat, 0);
    join_pair(s, ball, 0.05);
    struct solid thigh = grown(&b->thigh, tight, kind == SHORTS ? wide : fmax(tight, 0.004) + 0.4 * (wide - fmax(tight, 0.004)));
    if (kind == SHORTS) {
        join_pair(s, thigh, 0.02);
        add_half(s, CUT, 0.004, vec3(0, 0, b->at[LIMB(0, KNEE)].z + 0.035 * h), vec3(0, 0, 1));
    } else {
        struct solid shin = grown(&b->shin, fmax(tight, 0.004) + 0.4 * (wide - fmax(tight, 0.004)), wide);
        if (kind != LEGGINGS)
            for (int i = 1; i < shin.count; i++) { /* cloth hangs from knee and calf */
                struct station *st = &shin.station[i];
                st->front = fmax(st->front, 0.9 * shin.station[0].front);
                st->back = fmax(st->back, (kind == JEANS ? 0.84 : 0.97) * shin.station[i - 1].back);
                st->side = fmax(st->side, (kind == JEANS ? 0.86 : 0.96) * shin.station[i - 1].side);
            }
        solid_settle(&shin);
        join(s, thigh, 0.02);
        join(s, shin, 0.03);
        join(s, solid_mirrored(&thigh), 0.02);
        join(s, solid_mirrored(&shin), 0.03);
        add_half(s, CUT, 0.004, vec3(0, 0, b->at[LIMB(0, FOOT)].z + (kind == LEGGINGS ? 0.02 : -0.02) * h), vec3(0, 0, 1));
    }
    /* Each leg has its own cloth: as wide a gap as the net of cells can tell. */
    double gap_top = b->crotch_z - 0.03 * h, gap_low = b->at[LIMB(0, FOOT)].z - 0.03 * h;
    add_box(s, CUT, 0.010, vec3(0, 0, (gap_top + gap_low) / 2), vec3(0.25, 0.0085, (gap_top - gap_low) / 2), 0.008);
    double top = b->waist_z + (person->top == OPEN_COAT || person->top == OPEN_JACKET ? -0.05 : 0.01) * h; /* well below the shirt's creases */
    if (person->top == COAT) top = b->sole_m + 0.40 * h; /* the rest is hidden */
    add_half(s, CUT, 0, vec3(0, 0, top), vec3(0, 0, -1));
    s->seed = 11 + person->name[0];
    if (kind == LEGGINGS) return;
    s->folds_m = kind == JEANS ? 0.004 : 0.007;
    double deep = kind == JEANS ? 0.006 : 0.008;
    for (int side = -1; side <= 1; side += 2) {
        add_crease(s, vec3(0.01 * h, side * b->at[LIMB(0, KNEE)].y, b->at[LIMB(0, KNEE)].z), 0.09 * h, deep);
        if (kind != SHORTS) add_crease(s, vec3(0.02 * h, side * b->at[LIMB(0, FOOT)].y, b->at[LIMB(0, FOOT)].z + 0.035 * h), 0.085 * h, 1.6 * deep);
    }
    add_crease(s, vec3(0.05 * h, 0, b->crotch_z), 0.10 * h, deep);
}

/* A skirt, or the lower part of a dress or a coat: from the waist around both legs. */
static struct solid hanging(const struct body *b, double hem_z, double ease_m, double flare_m)
{
    struct shape one = { 0 };
    struct station rows[8];
    double top = b->waist_z, length = top - hem_z;
    const struct station *t = b->trunk.station;
    double thigh = b->thigh.station[1].side, hip_y = b->at[LIMB(0, HIP)].y;
    double side = fmax(t[2].side, hip_y + thigh) + ease_m, front = fmax(t[2].front, b->thigh.station[1].front) + ease_m;
    double back = fmax(t[2].back + 0.25 * b->seat.half.x, b->thigh.station[1].back) + ease_m;
    double hip = fmin((top - b->at[LIMB(0, HIP)].z) / length, 0.7);
    rows[0] = (struct station){ 0, t[4].side + 0.5 * ease_m, t[4].front + 0.5 * ease_m, t[4].back + 0.5 * ease_m, 0 };
    rows[1] = (struct station){ hip, side, front, back, 0 };
    double more = flare_m * (1 - hip);
    rows[2] = (struct station){ 1, side + more, front + more, back + more, 0 };
    struct solid s = *add_tube(&one, JOIN, 0, vec3(0, 0, top), vec3(0, 0, hem_z), vec3(1, 0, 0), rows, 3);
    s.cap_m[0] = 0.02;
    return s;
}

static void wear_skirt(struct wardrobe *wardrobe, const struct person *person, const struct body *b)
{
    double h = b->measures.stature_m, hem = person->bottom == SKIRT ? b->at[LIMB(0, KNEE)].z - 0.01 * h : 0.10 * h + b->sole_m;
    struct garment *g = add_garment(wardrobe, BOTTOM_PIECE, 0.0125);
    g->drape = 1;
    join(&g->shape, hanging(b, hem - 0.03, 0.012, person->bottom == SKIRT ? 0.05 : 0.12), 0);
    add_half(&g->shape, CUT, 0.004, vec3(0, 0, hem), vec3(0, 0, 1));
    g->shape.folds_m = 0.012;
    g->shape.seed = 3 + person->name[0];
}

/* --- trunk and arms --- */

static bool is_outer(enum top top) { return top == JACKET || top == OPEN_JACKET || top == COAT || top == OPEN_COAT || top == HOODIE; }

static void open_front(struct shape *s, const struct body *b, double hem_z)
{
    double h = b->measures.stature_m, neck = b->neck_z;
    struct station rows[] = { { 0, 0.050 * h, 0.16 * h, 0.14 * h, 0 }, { 0.75, 0.036 * h, 0.14 * h, 0.13 * h, 0 }, { 1, 0.034 * h, 0.14 * h, 0.125 * h, 0 } };
    struct vec3 low = vec3(0.17 * h, 0.01 * h, hem_z - 0.06 * h), high = vec3(0.13 * h, 0, neck + 0.02 * h);
    struct solid *gap = add_tube(s, CUT, 0.008, low, high, vec3(1, 0, 0), rows, 3);
    gap->square = 0.6;
}

static void wear_top(struct wardrobe *wardrobe, const struct person *person, const struct body *b, enum top kind, enum piece piece)
{
    double h = b->measures.stature_m;
    bool outer = is_outer(kind), coat = kind == COAT || kind == OPEN_COAT, under = piece == UNDER_PIECE;
    static const double ease[] = { [T_SHIRT] = 0.013, [SHIRT] = 0.012, [SWEATER] = 0.018, [JACKET] = 0.026, [OPEN_JACKET] = 0.026,
                                   [HOODIE] = 0.024, [COAT] = 0.028, [OPEN_COAT] = 0.030, [DRESS] = 0.008 };
    double e = under ? 0.006 : ease[kind], hem = 0;
    struct garment *g = add_garment(wardrobe, piece, 0.0125);
    struct shape *s = &g->shape;
    struct solid trunk = grown(&b->trunk, e, 0.6 * e);
    for (int i = 6; i >= 1 && kind != DRESS && !under; i--) { /* cloth hangs from chest and shoulder blades */
        double loose = outer ? 0.97 : 0.94;
        trunk.station[i].front = fmax(trunk.station[i].front, loose * trunk.station[i + 1].front);
        trunk.station[i].back = fmax(trunk.station[i].back, (loose - 0.03) * trunk.station[i + 1].back);
        trunk.station[i].side = fmax(trunk.station[i].side, (loose - 0.02) * trunk.station[i + 1].side);
    }
    solid_settle(&trunk);
    join(s, trunk, 0);
    join_pair(s, grown(&b->girdle, 0.8 * e, 0.8 * e), 0.06);
    join_pair(s, grown(&b->bust, 0.8 * e, 0), outer ? 0.07 : 0.05);
    join_pair(s, grown(&b->seat, e, 0), 0.06);
    switch (kind) {
    case T_SHIRT: hem = 0.475; break;
    case SHIRT: hem = 0.485; break;
    case SWEATER: hem = 0.495; break;
    case HOODIE: hem = 0.485; break;
    case COAT: case OPEN_COAT: hem = 0.29; break;
    case DRESS: hem = 0.27; break;
    default: hem = 0.465;
    }
    hem = b->sole_m + hem * b->at[LIMB(0, HIP)].z / 0.525;
    double hip_z = b->at[LIMB(0, HIP)].z;
    g->drape = 0.08;
    if (coat || kind == DRESS) {
        join(s, hanging(b, hem - 0.03, e + (coat ? 0.012 : 0.004), coat ? 0.05 : 0.08), 0.04);
        g->drape = 1;
    } else if (hem < hip_z + 0.02 * h) { /* around the tops of the legs */
        struct solid skirt = hanging(b, hem - 0.03, e + 0.010, 0.0);
        join(s, skirt, 0.04);
    }
    add_half(s, CUT, 0.004, vec3(0, 0, hem), vec3(coat ? 0 : 0.05, 0, 1));

    bool bare = kind == T_SHIRT || kind == DRESS, none = under;
    if (!none) {
        double cuff = e * (outer ? 0.85 : 0.75) + 0.002;
        struct solid upper = grown(&b->upper_arm, 0.9 * e, bare ? e + 0.008 : e), fore = grown(&b->forearm, e, cuff);
        const struct vec3 *at = &b->at[LIMB(0, 0)];
        struct vec3 way = vec3_unit(vec3_sub(at[ELBOW], at[UPPER_ARM]));
        join_pair(s, upper, 0.045);
        if (!bare) join_pair(s, fore, 0.02);
        if (bare) cut_across(s, vec3_add(at[UPPER_ARM], vec3_scale(way, 0.105 * h)), way, 0.085, 0.24);
        else cut_across(s, vec3_add(at[HAND], vec3_scale(way, 0.008 * h)), way, 0.08, 0.12);
    }
    /* The neck's opening, and what stands around it. */
    double neck = b->neck.station[0].side, wide = neck + (outer ? 0.010 : 0.006);
    struct vec3 base = vec3_add(b->neck.at, vec3(0.002 * h, 0, 0.012 * h)), up = mat3_column(b->neck.axes, 2);
    bool collar = (kind == SHIRT && !under) || outer;
    if (collar) {
        double stand = (coat ? 0.036 : 0.028) * h;
        struct vec3 top = vec3_add(base, vec3_scale(up, stand));
        if (kind == HOODIE) add_ball(s, JOIN, 0.03, vec3_add(base, vec3(-0.045 * h, 0, -0.004 * h)), vec3(0.042 * h, 0.062 * h, 0.04 * h));
        add_rod(s, CUT, 0.005, vec3_add(base, vec3_scale(up, -0.004)), wide - 0.002, vec3_add(top, vec3_scale(up, 0.1)), wide + 0.01);
        add_ball(s, CUT, 0.006, vec3_add(base, vec3(neck + 0.024, 0, 0.004 * h)), vec3(0.045, 0.02, kind == SHIRT ? 0.04 : 0.05));
        struct garment *collar_of = add_garment(wardrobe, piece, 0.0065);
        struct shape *c = &collar_of->shape;
        struct solid *ring = add_rod(c, JOIN, 0, vec3_sub(base, vec3_scale(up, 0.03)), wide + 0.016, top, wide + 0.006);
        ring->cap_m[1] = ring->cap_m[0] = 0.006;
        add_ball(c, CUT, 0.004, vec3_add(top, vec3(neck + 0.02, 0, 0)), vec3(0.06, kind == COAT ? 0.012 : 0.032, 1.3 * stand));
    } else {
        double low = kind == DRESS ? 0.024 * h : 0.008 * h;
        add_ball(s, CUT, 0.006, vec3_add(base, vec3(0.022 * h, 0, 0.01 * h)), vec3(wide + low, wide + 0.7 * low, 0.012 * h + 1.3 * low));
        add_rod(s, CUT, 0.006, vec3_add(base, vec3(0, 0, 0.004 * h)), wide, vec3_add(base, vec3_scale(up, 0.1)), wide);
    }
    if (kind == OPEN_JACKET || kind == OPEN_COAT) open_front(s, b, hem);

    if (under) { /* only where it shows */
        bool open = person->top == OPEN_JACKET || person->top == OPEN_COAT;
        add_half(s, CUT, 0, vec3(0, 0, b->neck_z - (open ? 0.40 : 0.16) * h), vec3(0, 0, 1));
        if (open) add_half(s, CUT, 0, vec3(0.01 * h, 0, 0), vec3(1, 0, 0));
    }
    s->seed = 17 + person->name[1] + (under ? 5 : 0);
    s->folds_m = outer ? 0.008 : kind == SWEATER ? 0.006 : 0.007;
    double deep = outer ? 0.009 : 0.008;
    for (int side = 0; side < 2; side++) {
        const struct vec3 *at = &b->at[LIMB(side, 0)];
        if (!bare) add_crease(s, at[ELBOW], 0.08 * h, deep);
        add_crease(s, vec3_add(at[UPPER_ARM], vec3(0, side ? 0.03 : -0.03, -0.07 * h)), 0.08 * h, 0.7 * deep);
    }
    add_crease(s, vec3(0.02, 0, b->waist_z - 0.02 * h), 0.11 * h, 0.4 * deep);
    if (kind == DRESS) s->folds_m = 0.008;
}

void wear_clothes(struct wardrobe *wardrobe, const struct person *person, const struct body *b)
{
    bool skirt = person->bottom == SKIRT || person->bottom == LONG_SKIRT, dress = person->top == DRESS;
    if (dress) bare_legs(wardrobe, b, b->at[LIMB(0, KNEE)].z + 0.12, person->bottom == LEGGINGS ? 0.002 : 0, person->bottom == LEGGINGS ? BOTTOM_PIECE : SKIN_PIECE);
    else if (skirt) {
        bool ankles = person->bottom == LONG_SKIRT;
        bare_legs(wardrobe, b, ankles ? b->at[LIMB(0, FOOT)].z + 0.14 : b->at[LIMB(0, KNEE)].z + 0.12, 0, SKIN_PIECE);
        wear_skirt(wardrobe, person, b);
    } else {
        if (person->bottom == SHORTS) bare_legs(wardrobe, b, b->at[LIMB(0, KNEE)].z + 0.14, 0, SKIN_PIECE);
        if (person->bottom == LEGGINGS) bare_legs(wardrobe, b, b->at[LIMB(0, FOOT)].z + 0.14, 0, SKIN_PIECE);
        wear_trousers(wardrobe, person, b);
    }
    if (is_outer(person->top)) wear_top(wardrobe, person, b, SHIRT, UNDER_PIECE);
    wear_top(wardrobe, person, b, person->top, TOP_PIECE);
    bare_arms(wardrobe, b, person->top == T_SHIRT || dress);
}

/* --- feet --- */

void wear_shoes(struct wardrobe *wardrobe, const struct person *person, const struct body *b)
{
    const struct vec3 *at = &b->at[LIMB(0, 0)];
    double f = b->foot_m * (person->shoes == LEATHER_SHOES ? 1.05 : 1.07), heel_x = at[FOOT].x - 0.26 * f, z = 0.10 * f;
    bool high = person->shoes == BOOTS;
    struct station rows[] = { { 0, 0.08, 0.14, 0.115, 0 }, { 0.09, 0.125, 0.17, 0.13, 0 }, { 0.30, 0.135, 0.20, 0.13, 0 }, { 0.5, 0.15, 0.16, 0.13, 0 },
                              { 0.70, 0.185, 0.105, 0.13, 0 }, { 0.88, 0.165, 0.07, 0.125, 0 }, { 1, 0.10, 0.035, 0.10, 0 } };
    for (int i = 0; i < 7; i++) rows[i].side *= f, rows[i].front *= f, rows[i].back *= f;
    struct garment *left = add_garment(wardrobe, SHOES_PIECE, 0.0085);
    struct shape *s = &left->shape;
    struct solid *shoe = add_tube(s, JOIN, 0, vec3(heel_x + 0.03 * f, at[FOOT].y, z), vec3(heel_x + 0.95 * f, at[FOOT].y + 0.012 * f, z), vec3(0, 0, 1), rows, 7);
    shoe->cap_m[0] = shoe->cap_m[1] = 0.07 * f;
    struct vec3 ankle = at[FOOT], top = vec3_add(ankle, vec3(-0.004, 0, high ? 0.28 * f : 0.08 * f));
    add_rod(s, JOIN, 0.03, vec3(ankle.x - 0.02 * f, ankle.y, 0.22 * f), 0.145 * f, top, (high ? 0.175 : 0.15) * f)->cap_m[1] = 0.008;
    struct solid *sole = add_half(s, CUT, 0.006, vec3(0, 0, 0), vec3(0, 0, 1));
    (void)sole;
    struct garment *right = add_garment(wardrobe, SHOES_PIECE, left->cell_m);
    mirror(&right->shape, s);
}

/* --- what is carried --- */

void carry(struct wardrobe *wardrobe, const struct person *person, const struct body *b)
{
    double h = b->measures.stature_m;
    const struct station *chest = &b->trunk.station[7];
    struct garment *g;
    switch (person->carried) {
    case BACKPACK: {
        g = add_garment(wardrobe, CARRIED_PIECE, 0.013);
        g->joint = CHEST;
        double back = -(chest->back - chest->shift) - 0.03, z = b->at[CHEST].z + 0.03 * h;
        add_box(&g->shape, JOIN, 0, vec3(back - 0.055, 0, z), vec3(0.075, 0.145, 0.21), 0.06);
        add_box(&g->shape, JOIN, 0.02, vec3(back - 0.125, 0, z - 0.07), vec3(0.04, 0.11, 0.10), 0.03);
        g->shape.folds_m = 0.004;
        struct garment *straps = add_garment(wardrobe, CARRIED_PIECE, 0.009);
        double y = 0.45 * b->at[LIMB(0, UPPER_ARM)].y + 0.025, out = 0.030;
        double front = chest->front + chest->shift + out, high = b->at[LIMB(0, UPPER_ARM)].z + 0.062 * h;
        for (int side = -1; side <= 1; side += 2)
            add_chain(&straps->shape, JOIN, 0.006, (struct vec3[]){ vec3(back, side * y, high - 0.03), vec3(-0.02 * h, side * y, high), vec3(0.7 * front, side * y * 1.05, high - 0.045 * h),
                      vec3(front, side * y * 1.15, b->at[CHEST].z + 0.05 * h), vec3(0.3 * front, side * (chest->side + out), b->at[CHEST].z - 0.03 * h), vec3(back, side * chest->side * 0.7, b->at[CHEST].z - 0.05 * h) },
                      (double[]){ 0.016, 0.018, 0.018, 0.018, 0.014, 0.014 }, 6);
        straps->joint = -1;
        break;
    }
    case SHOULDER_BAG: {
        g = add_garment(wardrobe, CARRIED_PIECE, 0.012);
        g->joint = HIPS;
        double side = b->trunk.station[2].side + 0.075, z = b->at[HIPS].z - 0.02 * h;
        struct solid *bag = add_box(&g->shape, JOIN, 0, vec3(-0.05, -side, z), vec3(0.16, 0.055, 0.125), 0.04);
        (void)bag;
        break;
    }
    case HANDBAG: {
        g = add_garment(wardrobe, CARRIED_PIECE, 0.011);
        g->joint = HELD;
        struct vec3 grip = b->at[HELD];
        add_box(&g->shape, JOIN, 0, vec3_add(grip, vec3(0, 0, -0.26)), vec3(0.17, 0.055, 0.125), 0.035);
        for (int y = -1; y <= 1; y += 2)
            add_chain(&g->shape, JOIN, 0.004, (struct vec3[]){ vec3_add(grip, vec3(0.10, 0.02 * y, -0.14)), vec3_add(grip, vec3(0.05, 0.008 * y, -0.005)), vec3_add(grip, vec3(-0.05, 0.008 * y, -0.005)),
                      vec3_add(grip, vec3(-0.10, 0.02 * y, -0.14)) }, (double[]){ 0.011, 0.011, 0.011, 0.011 }, 4);
        break;
    }
    case UMBRELLA: {
        struct vec3 grip = b->at[HELD], top = vec3_add(grip, vec3(0, 0, 0.78));
        g = add_garment(wardrobe, SHOES_PIECE, 0.011);
        g->joint = HELD;
        add_rod(&g->shape, JOIN, 0, vec3_add(grip, vec3(0, 0, -0.09)), 0.012, vec3_add(top, vec3(0, 0, 0.02)), 0.011);
        g = add_garment(wardrobe, CARRIED_PIECE, 0.013);
        g->joint = HELD;
        struct vec3 middle = vec3_add(grip, vec3(0, 0, 0.46)); /* a dome, hollow */
        add_ball(&g->shape, JOIN, 0, middle, vec3(0.56, 0.56, 0.33));
        add_ball(&g->shape, CUT, 0, middle, vec3(0.535, 0.535, 0.305));
        add_half(&g->shape, CUT, 0, vec3_add(grip, vec3(0, 0, 0.56)), vec3(0, 0, 1));
        break;
    }
    default: break;
    }
    if (person->hands == AT_PHONE) {
        g = add_garment(wardrobe, CARRIED_PIECE, 0.005);
        g->joint = HELD;
        solid_tip(add_box(&g->shape, JOIN, 0, vec3_add(b->at[HELD], vec3(0.03, 0.02, 0.05)), vec3(0.006, 0.037, 0.074), 0.004), -0.6);
    }
}
