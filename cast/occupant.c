#include "cast/occupant.h"

#include "cast/coat.h"
#include "cast/hull.h"
#include "cast/need.h"
#include "cast/pose.h"

static const struct person persons[OCCUPANTS] = {
    [DRIVER] = { .name = "driver", .measures = { MALE, 40, 1.72, 73 }, .hair = SHORT_HAIR, .top = SWEATER, .bottom = TROUSERS, .shoes = LEATHER_SHOES },
    [WOMAN_DRIVER] = { .name = "woman driver", .measures = { FEMALE, 38, 1.66, 63 }, .hair = BOB_HAIR, .top = JACKET, .bottom = JEANS, .shoes = SNEAKERS },
    [MOTORCYCLIST] = { .name = "motorcyclist", .measures = { MALE, 35, 1.77, 80 }, .hair = FULL_HELMET, .top = JACKET, .bottom = JEANS, .shoes = BOOTS },
    [CYCLIST] = { .name = "cyclist", .measures = { MALE, 30, 1.76, 73 }, .hair = CYCLE_HELMET, .top = SWEATER, .bottom = TROUSERS, .shoes = SNEAKERS }
};
static const int coats[PIECE_COUNT] = { [SKIN_PIECE] = SKIN_COAT, [HAIR_PIECE] = HAIR_COAT, [TOP_PIECE] = JACKET_COAT, [UNDER_PIECE] = BLACK_PANEL,
                                        [BOTTOM_PIECE] = TROUSERS_COAT, [SHOES_PIECE] = SHOES_COAT, [CARRIED_PIECE] = TRIM_COAT, [HAT_PIECE] = HELMET_COAT };
/* Of a driver little more is seen than chest and head. */
static const size_t triangles[OCCUPANTS][2] = { [DRIVER] = { 4000, 1000 }, [WOMAN_DRIVER] = { 4000, 1000 }, [MOTORCYCLIST] = { 9000, 2400 }, [CYCLIST] = { 9000, 2400 } };

struct dressed { struct body body; struct wardrobe wardrobe; struct hull hull[2]; };
struct crew { struct dressed *of[OCCUPANTS]; }; /* NULL as long as it is not asked for */

struct crew *crew_create(void) { return need(calloc(1, sizeof(struct crew))); }

void crew_destroy(struct crew *crew)
{
    for (int who = 0; crew && who < OCCUPANTS; who++) {
        if (!crew->of[who]) continue;
        for (int i = 0; i < 2; i++) hull_release(&crew->of[who]->hull[i]);
        free(crew->of[who]);
    }
    free(crew);
}

static struct dressed *dress(enum occupant who)
{
    struct dressed *d = need(calloc(1, sizeof *d));
    const struct person *person = &persons[who];
    double weight[GARMENTS];
    d->body = make_body(&person->measures, 0.013 * person->measures.stature_m);
    wear_shoes(&d->wardrobe, person, &d->body);
    wear_clothes(&d->wardrobe, person, &d->body);
    wear_head(&d->wardrobe, person, &d->body);
    for (int i = 0; i < d->wardrobe.count; i++) {
        const struct garment *g = &d->wardrobe.garment[i];
        hull_add_shape(&d->hull[0], &g->shape, i, g->cell_m);
        weight[i] = g->piece == SKIN_PIECE ? 2 : 1;
    }
    hull_decimate(&d->hull[0], triangles[who][0], weight);
    d->hull[1] = hull_copy(&d->hull[0]);
    hull_decimate(&d->hull[1], triangles[who][1], weight);
    return d;
}

static struct vec3 toward(struct mat3 turn, double x, double y, double z) { return mat3_apply(turn, vec3(x, y, z)); }

/* A bent back: the more, the higher up; the head looks ahead again. */
static struct body_pose pose_of(const struct seat *seat, const struct body *b)
{
    struct body_pose pose = { 0 };
    double lean = radians(seat->lean_deg);
    struct mat3 *turn = pose.turn;
    turn[HIPS] = lift(-0.75 * lean), turn[SPINE] = lift(-lean), turn[CHEST] = lift(-1.2 * lean);
    turn[NECK] = lift(-0.6 * lean), turn[HEAD] = lift(radians(-seat->nod_deg));
    struct vec3 between = vec3_scale(vec3_add(b->at[LIMB(0, HIP)], b->at[LIMB(1, HIP)]), 0.5);
    pose.hips = vec3_sub(seat->hips, mat3_apply(turn[HIPS], vec3_sub(between, b->at[HIPS])));
    for (int side = 0; side < 2; side++) {
        double out = side ? -1 : 1;
        int arm = LIMB(side, UPPER_ARM), fore = LIMB(side, FOREARM), hand = LIMB(side, HAND), thigh = LIMB(side, THIGH), shin = LIMB(side, SHIN), foot = LIMB(side, FOOT);
        turn[LIMB(side, SHOULDER)] = turn[CHEST];
        pose_bones(&pose, b, arm, fore, hand, pose_place(&pose, b, arm), seat->wrist[side], toward(turn[CHEST], -0.3, out * seat->elbows_out, -1), vec3(-1, 0, 0));
        turn[hand] = then(turn_left(-out * radians(28)), then(turn[fore], lift(radians(-14)))); /* around a grip */
        turn[LIMB(side, HIP)] = turn[HIPS];
        pose_bones(&pose, b, thigh, shin, foot, pose_place(&pose, b, LIMB(side, HIP)), seat->ankle[side], vec3(1, out * seat->knees_out, 0.5), vec3(1, 0, 0));
        turn[foot] = turn[LIMB(side, TOES)] = then(turn_left(out * 0.5 * seat->knees_out), lift(radians(seat->toes_deg[side])));
    }
    turn[HELD] = turn[LIMB(1, HAND)];
    pose_halves(&pose);
    return pose;
}

void crew_seat(struct shell *s, struct crew *crew, enum occupant who, const struct seat *seat, bool coarse)
{
    if (!crew->of[who]) crew->of[who] = dress(who);
    const struct dressed *d = crew->of[who];
    const struct hull *hull = &d->hull[coarse];
    struct body_pose pose = pose_of(seat, &d->body);
    struct pose at[JOINT_COUNT];
    uint32_t first = (uint32_t)s->points;
    size_t first_face = s->faces_count;
    pose_joints(at, &pose, &d->body);
    for (size_t i = 0; i < hull->points; i++)
        shell_point(s, pose_point(at, &d->body, &d->wardrobe.garment[hull->piece[i]], hull->point[i]), vec3(0, 0, 1));
    for (size_t t = 0; t < hull->triangles; t++) {
        const uint32_t *v = hull->triangle[t];
        enum piece piece = d->wardrobe.garment[hull->piece[v[0]]].piece;
        bool sweater = piece == TOP_PIECE && persons[who].top == SWEATER;
        shell_face(s, first + v[0], first + v[1], first + v[2], sweater ? SWEATER_COAT : coats[piece]);
    }
    shell_smooth(s, first_face, 60);
}
