/* Heads, and what is on them. */
#include "cast/person.h"

/* In shares of the head from chin (0) to top (1), x from the middle of the neck's top. */
struct frame { double unit; struct vec3 at; };

static struct vec3 on(const struct frame *f, double x, double y, double z)
{
    return vec3_add(f->at, vec3_scale(vec3(x, y, z), f->unit));
}

static struct vec3 size(const struct frame *f, double x, double y, double z) { return vec3_scale(vec3(x, y, z), f->unit); }

static void ball(struct shape *s, const struct frame *f, enum blend blend, double soft, struct vec3 at, struct vec3 half)
{
    add_ball(s, blend, soft * f->unit, on(f, at.x, at.y, at.z), size(f, half.x, half.y, half.z));
}

/* One on each side. */
static void balls(struct shape *s, const struct frame *f, enum blend blend, double soft, struct vec3 at, struct vec3 half)
{
    ball(s, f, blend, soft, at, half);
    ball(s, f, blend, soft, vec3(at.x, -at.y, at.z), half);
}

static void rod(struct shape *s, const struct frame *f, enum blend blend, double soft, struct vec3 a, double ra, struct vec3 b, double rb)
{
    add_rod(s, blend, soft * f->unit, on(f, a.x, a.y, a.z), ra * f->unit, on(f, b.x, b.y, b.z), rb * f->unit);
}

static void make_face(struct shape *s, const struct frame *f, const struct person *person)
{
    double child = ramp(16, 5, person->measures.age_years), male = person->measures.sex == MALE ? 1 - child : 0;
    ball(s, f, JOIN, 0, vec3(-0.03, 0, 0.66), vec3(0.43 - 0.01 * child, 0.335 + 0.015 * child, 0.345));          /* skull */
    ball(s, f, JOIN, 0.10, vec3(0.10, 0, 0.40), vec3(0.29, 0.25 + 0.012 * male, 0.34));                          /* middle of the face */
    ball(s, f, JOIN, 0.12, vec3(0.13, 0, 0.22), vec3(0.24, 0.205 + 0.025 * male + 0.02 * child, 0.17));         /* jaw */
    ball(s, f, JOIN, 0.08, vec3(0.295, 0, 0.085), vec3(0.075, 0.08 + 0.03 * male, 0.075));                       /* chin */
    balls(s, f, JOIN, 0.10, vec3(0.23, 0.17, 0.42), vec3(0.11, 0.10, 0.10));                                     /* cheekbones */
    rod(s, f, JOIN, 0.07, vec3(0.33, -0.15, 0.575), 0.05 + 0.012 * male, vec3(0.33, 0.15, 0.575), 0.05 + 0.012 * male); /* brow */
    balls(s, f, CUT, 0.07, vec3(0.455, 0.145, 0.50), vec3(0.09, 0.085, 0.06));                                   /* eye sockets */
    balls(s, f, JOIN, 0.015, vec3(0.315, 0.145, 0.505), vec3(0.062, 0.068, 0.06));                               /* eyeballs behind lids */
    rod(s, f, JOIN, 0.04, vec3(0.385, 0, 0.55), 0.032, vec3(0.455 - 0.02 * child, 0, 0.375), 0.042 + 0.01 * male); /* nose */
    balls(s, f, JOIN, 0.03, vec3(0.425 - 0.02 * child, 0.045, 0.355), vec3(0.04, 0.035, 0.032));
    rod(s, f, JOIN, 0.035, vec3(0.385, -0.06, 0.245), 0.03, vec3(0.385, 0.06, 0.245), 0.03);                     /* lips */
    rod(s, f, JOIN, 0.02, vec3(0.38, -0.045, 0.195), 0.03, vec3(0.38, 0.045, 0.195), 0.03);
    rod(s, f, CUT, 0.012, vec3(0.425, -0.07, 0.222), 0.012, vec3(0.425, 0.07, 0.222), 0.012);
    for (int y = -1; y <= 1; y += 2) {                                                                           /* ears */
        struct solid *ear = add_ball(s, JOIN, 0.03 * f->unit, on(f, -0.02, y * 0.335, 0.47), size(f, 0.075, 0.03, 0.13));
        solid_tip(ear, 0.25);
    }
}

/* A shell of hair close around the skull, cut free of the face and the nape. */
static void make_cap_of_hair(struct shape *s, const struct frame *f, double thick, double nape_z, bool over_ears)
{
    ball(s, f, JOIN, 0, vec3(-0.035, 0, 0.67), vec3(0.43 + thick, 0.335 + thick, 0.345 + thick));
    ball(s, f, JOIN, 0.1, vec3(-0.16, 0, 0.42), vec3(0.27 + thick, 0.26 + thick, 0.28));
    ball(s, f, CUT, 0.06, vec3(0.47, 0, 0.36), vec3(0.36, 0.46, 0.45));
    if (!over_ears) ball(s, f, CUT, 0.04, vec3(0.09, 0, 0.30), vec3(0.24, 0.6, 0.25));
    add_half(s, CUT, 0.03 * f->unit, on(f, -0.3, 0, nape_z), vec3(0.25, 0, 1));
}

static void make_hair(struct shape *s, const struct frame *f, enum hair hair, double seed)
{
    s->seed = seed;
    s->folds_m = 0.022 * f->unit;
    switch (hair) {
    case CROPPED_HAIR:
        make_cap_of_hair(s, f, 0.012, 0.20, false);
        s->folds_m = 0.002 * f->unit;
        break;
    case CURLY_HAIR:
        make_cap_of_hair(s, f, 0.07, 0.17, false);
        s->folds_m = 0.07 * f->unit;
        break;
    case BOB_HAIR:
        make_cap_of_hair(s, f, 0.055, 0.02, true);
        for (int y = -1; y <= 1; y += 2) rod(s, f, JOIN, 0.08, vec3(0.02, y * 0.29, 0.62), 0.12, vec3(0.03, y * 0.29, 0.14), 0.085);
        rod(s, f, JOIN, 0.1, vec3(-0.25, 0, 0.5), 0.22, vec3(-0.22, 0, 0.1), 0.2);
        ball(s, f, CUT, 0.05, vec3(0.50, 0, 0.34), vec3(0.38, 0.30, 0.44));
        break;
    case LONG_HAIR:
        make_cap_of_hair(s, f, 0.05, -0.2, true);
        for (int y = -1; y <= 1; y += 2) {
            rod(s, f, JOIN, 0.08, vec3(-0.02, y * 0.29, 0.62), 0.11, vec3(-0.06, y * 0.27, 0.05), 0.085);
            rod(s, f, JOIN, 0.08, vec3(-0.06, y * 0.27, 0.05), 0.085, vec3(-0.14, y * 0.22, -0.32), 0.06);
        }
        {
            struct station rows[] = { { 0, 0.30 * f->unit, 0.2 * f->unit, 0.2 * f->unit, 0 }, { 0.5, 0.30 * f->unit, 0.13 * f->unit, 0.14 * f->unit, 0 },
                                      { 1, 0.2 * f->unit, 0.07 * f->unit, 0.09 * f->unit, 0 } };
            struct vec3 low = on(f, -0.33, 0, -0.5), high = on(f, -0.2, 0, 0.6);
            add_tube(s, JOIN, 0.1 * f->unit, high, low, vec3(1, 0, 0), rows, 3);
        }
        ball(s, f, CUT, 0.05, vec3(0.48, 0, 0.32), vec3(0.40, 0.285, 0.46));
        break;
    case BUN:
        make_cap_of_hair(s, f, 0.03, 0.22, false);
        ball(s, f, JOIN, 0.06, vec3(-0.50, 0, 0.72), vec3(0.15, 0.17, 0.16));
        break;
    case PONYTAIL:
        make_cap_of_hair(s, f, 0.03, 0.22, false);
        add_chain(s, JOIN, 0.05 * f->unit, (struct vec3[]){ on(f, -0.42, 0, 0.72), on(f, -0.58, 0, 0.62), on(f, -0.60, 0, 0.2), on(f, -0.50, 0, -0.18) },
                  (double[]){ 0.06 * f->unit, 0.09 * f->unit, 0.11 * f->unit, 0.05 * f->unit }, 4);
        break;
    default: make_cap_of_hair(s, f, 0.04, 0.17, false);
    }
}

static void make_beard(struct shape *s, const struct frame *f)
{
    s->folds_m = 0.01 * f->unit;
    ball(s, f, JOIN, 0, vec3(0.13, 0, 0.21), vec3(0.255, 0.245, 0.19));
    ball(s, f, JOIN, 0.08, vec3(0.295, 0, 0.07), vec3(0.10, 0.11, 0.10));
    rod(s, f, JOIN, 0.04, vec3(0.40, -0.07, 0.275), 0.025, vec3(0.40, 0.07, 0.275), 0.025);
    ball(s, f, CUT, 0.03, vec3(0.46, 0, 0.215), vec3(0.12, 0.075, 0.045));
    balls(s, f, CUT, 0.06, vec3(0.34, 0.20, 0.42), vec3(0.2, 0.15, 0.16));
    add_half(s, CUT, 0.04 * f->unit, on(f, 0.0, 0, 0.30), vec3(1, 0, -0.05));
}

static void make_headscarf(struct shape *s, const struct frame *f)
{
    s->folds_m = 0.03 * f->unit;
    ball(s, f, JOIN, 0, vec3(-0.04, 0, 0.65), vec3(0.49, 0.40, 0.42));
    rod(s, f, JOIN, 0.15, vec3(-0.06, 0, 0.55), 0.38, vec3(0.02, 0, -0.05), 0.31);
    ball(s, f, JOIN, 0.2, vec3(0.0, 0, -0.34), vec3(0.5, 0.66, 0.26));
    ball(s, f, CUT, 0.04, vec3(0.52, 0, 0.42), vec3(0.40, 0.26, 0.40));
}

static void make_cap(struct shape *s, const struct frame *f)
{
    ball(s, f, JOIN, 0, vec3(-0.03, 0, 0.70), vec3(0.465, 0.375, 0.365));
    add_half(s, CUT, 0.01 * f->unit, on(f, 0, 0, 0.70), vec3(-0.15, 0, 1));
    struct solid *visor = add_ball(s, JOIN, 0.03 * f->unit, on(f, 0.46, 0, 0.75), size(f, 0.28, 0.27, 0.03));
    solid_tip(visor, -0.22);
}

static void make_cycle_helmet(struct shape *s, const struct frame *f)
{
    ball(s, f, JOIN, 0, vec3(-0.05, 0, 0.72), vec3(0.56, 0.44, 0.45));
    add_half(s, CUT, 0.03 * f->unit, on(f, 0, 0, 0.72), vec3(-0.12, 0, 1));
    for (int y = -1; y <= 1; y++) rod(s, f, CUT, 0.03, vec3(0.50, 0.17 * y, 1.06), 0.03, vec3(-0.50, 0.20 * y, 1.08), 0.06); /* vents */
}

/* With a visor, which is a piece of its own. */
static void make_full_helmet(struct shape *s, const struct frame *f, bool visor)
{
    double out = visor ? 0.015 : 0;
    ball(s, f, JOIN, 0, vec3(-0.04, 0, 0.60), vec3(0.60 + out, 0.50 + out, 0.54 + out));
    rod(s, f, JOIN, 0.15, vec3(0.32, 0, 0.20), 0.26 + out, vec3(-0.08, 0, 0.28), 0.42 + out);
    if (visor) add_box(s, KEEP, 0.02 * f->unit, on(f, 0.50, 0, 0.60), size(f, 0.42, 0.6, 0.20), 0.08 * f->unit);
    else add_half(s, CUT, 0.03 * f->unit, on(f, 0, 0, 0.0), vec3(0, 0, 1));
}

void wear_head(struct wardrobe *wardrobe, const struct person *person, const struct body *body)
{
    struct frame f = { body->head_m, vec3(body->at[HEAD].x, 0, body->chin_z) };
    double cell = 0.031 * f.unit;
    struct garment *head = add_garment(wardrobe, SKIN_PIECE, cell);
    make_face(&head->shape, &f, person);
    struct solid *neck = add_solid(&head->shape, &body->neck);
    neck->soft_m = 0.14 * f.unit;
    /* Down to where any neckline hides it, and no farther than a shirt below an open coat lets it. */
    double low = person->top == OPEN_COAT || person->top == OPEN_JACKET ? 0.045 : 0.075;
    struct solid *chest = add_solid(&head->shape, &body->trunk);
    chest->soft_m = 0.04;
    add_half(&head->shape, CUT, 0, vec3(0, 0, body->neck_z - low * body->measures.stature_m), vec3(0, 0, 1));
    struct garment *on_top = add_garment(wardrobe, HAIR_PIECE, 1.3 * cell);
    switch (person->hair) {
    case BALD: wardrobe->count--; break;
    case CAP:
        make_hair(&on_top->shape, &f, CROPPED_HAIR, 1);
        on_top = add_garment(wardrobe, HAT_PIECE, cell);
        make_cap(&on_top->shape, &f);
        break;
    case BEANIE:
        make_hair(&on_top->shape, &f, CROPPED_HAIR, 1);
        on_top = add_garment(wardrobe, HAT_PIECE, 1.2 * cell);
        ball(&on_top->shape, &f, JOIN, 0, vec3(-0.045, 0, 0.72), vec3(0.475, 0.385, 0.38));
        add_half(&on_top->shape, CUT, 0.03 * f.unit, on(&f, 0, 0, 0.60), vec3(-0.22, 0, 1));
        on_top->shape.folds_m = 0.012 * f.unit;
        break;
    case CYCLE_HELMET:
        make_hair(&on_top->shape, &f, CROPPED_HAIR, 1);
        make_cycle_helmet(&add_garment(wardrobe, HAT_PIECE, cell)->shape, &f);
        break;
    case FULL_HELMET:
        on_top->piece = HAT_PIECE;
        make_full_helmet(&on_top->shape, &f, false);
        make_full_helmet(&add_garment(wardrobe, UNDER_PIECE, cell)->shape, &f, true);
        break;
    case HEADSCARF:
        on_top->piece = HAT_PIECE;
        make_headscarf(&on_top->shape, &f);
        break;
    default: make_hair(&on_top->shape, &f, person->hair, 5 + (double)person->name[0]);
    }
    if (person->beard) make_beard(&add_garment(wardrobe, HAIR_PIECE, cell)->shape, &f);
}
