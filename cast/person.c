/* People: bones whose balls blend into one another, a piece of cloth at a time, and a mesh of each surface. */
#include "cast/mesh.h"
#include "cast/skeleton.h"

#include <assert.h>

#define COUNT(a) (sizeof(a) / sizeof *(a))

/* A bone: a ball of radius r[0] at p[0] blended into one of r[1] at p[1]. depth flattens it front to back. */
struct bone { struct vec3 p[2]; double r[2], depth; };
struct flesh { struct bone bones[12]; int count; double blend_m, folds_m, cell_m, hem_z; enum material material; enum part part; };

static void add_bone(struct flesh *flesh, struct vec3 a, double ra, struct vec3 b, double rb, double depth)
{
    assert((size_t)flesh->count < COUNT(flesh->bones));
    flesh->bones[flesh->count++] = (struct bone){ { a, b }, { ra, rb }, depth };
}

/* Below 0 inside: the bones' distances under a smooth minimum, cut off at the hem. */
static double field(const struct flesh *flesh, struct vec3 p)
{
    double all = 1e9;
    for (int k = 0; k < flesh->count; k++) {
        const struct bone *bone = &flesh->bones[k];
        struct vec3 a = bone->p[0], ab = vec3_sub(bone->p[1], a), ap = vec3_sub(p, a);
        double t = fmin(fmax(vec3_dot(ap, ab) / fmax(vec3_dot(ab, ab), 1e-12), 0), 1);
        struct vec3 off = vec3_sub(ap, vec3_scale(ab, t));
        off.x /= bone->depth;
        double d = (vec3_norm(off) - bone->r[0] - t * (bone->r[1] - bone->r[0])) * fmin(1, bone->depth);
        double h = fmax(flesh->blend_m - fabs(all - d), 0);
        all = fmin(all, d) - h * h / (4 * flesh->blend_m);
    }
    all += flesh->folds_m * sin(24 * p.z + 31 * p.y) * sin(34 * p.x - 19 * p.z - 14 * p.y);
    return fmax(all, flesh->hem_z - p.z);
}

/* Mesh the surface (surface nets): a vertex a cell that the surface passes, a quad an edge that it cuts. */
static void add_flesh(struct model *model, const struct flesh *flesh)
{
    enum { NX = 64, NY = 64, NZ = 96 };
    static double value[NX][NY][NZ];
    static struct vec3 vertex[NX][NY][NZ];
    struct vec3 low = { 1e9, 1e9, 1e9 }, high = { -1e9, -1e9, -1e9 };
    for (int k = 0; k < 2 * flesh->count; k++) {
        const struct bone *bone = &flesh->bones[k / 2];
        struct vec3 p = bone->p[k % 2];
        double r = bone->r[k % 2] * fmax(1, bone->depth);
        low = vec3(fmin(low.x, p.x - r), fmin(low.y, p.y - r), fmin(low.z, p.z - r));
        high = vec3(fmax(high.x, p.x + r), fmax(high.y, p.y + r), fmax(high.z, p.z + r));
    }
    double h = flesh->cell_m, margin = 2 * h + flesh->blend_m;
    low = vec3_sub(low, vec3(margin, margin, margin));
    int n[3] = { (int)((high.x - low.x + margin) / h) + 2, (int)((high.y - low.y + margin) / h) + 2,
                 (int)((high.z - low.z + margin) / h) + 2 };
    assert(n[0] <= NX && n[1] <= NY && n[2] <= NZ);
    for (int i = 0; i < n[0]; i++)
        for (int j = 0; j < n[1]; j++)
            for (int k = 0; k < n[2]; k++) value[i][j][k] = field(flesh, vec3_add(low, vec3(i * h, j * h, k * h)));

    for (int i = 0; i + 1 < n[0]; i++)
        for (int j = 0; j + 1 < n[1]; j++)
            for (int k = 0; k + 1 < n[2]; k++) {
                struct vec3 sum = { 0, 0, 0 };
                int cuts = 0;
                for (int e = 0; e < 12; e++) { /* an edge: its axis, and the corner of the other two axes */
                    int axis = e / 4, c[3] = { 0, 0, 0 };
                    c[(axis + 1) % 3] = e & 1, c[(axis + 2) % 3] = e >> 1 & 1;
                    double a = value[i + c[0]][j + c[1]][k + c[2]];
                    double b = value[i + c[0] + (axis == 0)][j + c[1] + (axis == 1)][k + c[2] + (axis == 2)];
                    if ((a < 0) == (b < 0)) continue;
                    double t[3] = { c[0], c[1], c[2] };
                    t[axis] += a / (a - b);
                    sum = vec3_add(sum, vec3(i + t[0], j + t[1], k + t[2]));
                    cuts++;
                }
                if (cuts) vertex[i][j][k] = vec3_add(low, vec3_scale(sum, h / cuts));
            }
    for (int i = 1; i + 1 < n[0]; i++)
        for (int j = 1; j + 1 < n[1]; j++)
            for (int k = 1; k + 1 < n[2]; k++)
                for (int axis = 0; axis < 3; axis++) {
                    bool in = value[i][j][k] < 0;
                    if (in == (value[i + (axis == 0)][j + (axis == 1)][k + (axis == 2)] < 0)) continue;
                    struct vec3 q[4];
                    for (int s = 0; s < 4; s++) {
                        int d[3] = { 0, 0, 0 }, at = in ? s : 3 - s;
                        d[(axis + 1) % 3] = at == 0 || at == 3, d[(axis + 2) % 3] = at < 2;
                        q[s] = vertex[i - d[0]][j - d[1]][k - d[2]];
                    }
                    model->part = flesh->part;
                    add_quad(model, flesh->material, q);
                }
}

/* Joints of the two sides, metres, for a body of 1.78 m: side 0 is left. */
struct joints { struct vec3 knee[2], ankle[2], elbow[2], wrist[2]; double toe_drop_m[2]; };

static const struct joints joints[] = {
    [STANDING] = {
        { { 0.02, 0.10, 0.51 }, { 0.03, 0.10, 0.51 } }, { { -0.02, 0.11, 0.085 }, { 0.03, 0.11, 0.085 } },
        { { -0.04, 0.235, 1.15 }, { -0.03, 0.235, 1.15 } }, { { 0.04, 0.245, 0.90 }, { 0.07, 0.235, 0.90 } }, { 0, 0 }
    },
    [WALKING] = {
        { { 0.19, 0.09, 0.52 }, { -0.04, 0.09, 0.49 } }, { { 0.31, 0.085, 0.10 }, { -0.32, 0.085, 0.165 } },
        { { -0.13, 0.24, 1.18 }, { 0.05, 0.24, 1.17 } }, { { -0.06, 0.25, 0.93 }, { 0.22, 0.20, 0.99 } }, { -0.02, 0.085 }
    },
    [READY] = { /* knees bend in the plane of hip, ankle and front */
        { { 0.012, 0.115, 0.51 }, { 0.012, 0.115, 0.51 } }, { { 0, 0.15, 0.085 }, { 0, 0.15, 0.085 } },
        { { -0.025, 0.235, 1.15 }, { -0.025, 0.235, 1.15 } }, { { 0.025, 0.245, 0.90 }, { 0.025, 0.245, 0.90 } }, { 0, 0 }
    }
};

static const struct frame {
    double shoulder_y, girth[4], limb, hem_z, stride; /* girth: radius at hem, waist, chest, shoulders */
    bool long_hair;
} frames[] = {
    [MAN] = { 0.18, { 0.132, 0.115, 0.122, 0.066 }, 1, 0.85, 1.42, false },
    [WOMAN] = { 0.15, { 0.136, 0.098, 0.112, 0.058 }, 0.92, 0.83, 1.36, true }
};

void make_person(struct model *model, struct skeleton *skeleton, enum build build, enum stance stance, double height_m)
{
    const struct frame *frame = &frames[build];
    const struct joints *joint = &joints[stance];
    struct flesh trousers = { .blend_m = 0.04, .folds_m = 0.004, .cell_m = 0.032, .material = TROUSERS, .part = LEGS };
    struct flesh jacket = { .blend_m = 0.08, .folds_m = 0.004, .cell_m = 0.03, .hem_z = frame->hem_z, .material = JACKET };
    struct flesh skin = { .blend_m = 0.03, .cell_m = 0.02, .material = SKIN, .part = HEAD_PART };
    struct flesh hair = { .blend_m = 0.04, .folds_m = 0.002, .cell_m = 0.025, .material = HAIR, .part = HEAD_PART };
    double limb = frame->limb, hip_z = stance == WALKING ? 0.92 : 0.94;
    bool ready = stance == READY;
    size_t first = model->count;

    for (int side = 0; side < 2; side++) {
        double y = side ? -1 : 1;
#define AT(p) vec3((p).x, y * (p).y, (p).z)
        struct vec3 hip = vec3(0, y * 0.08, hip_z), knee = AT(joint->knee[side]), ankle = AT(joint->ankle[side]);
        struct vec3 pelvis = vec3(-0.005, y * 0.03, hip_z + 0.03);
        add_bone(&trousers, pelvis, 0.095, hip, 0.092 * limb, 1);
        add_bone(&trousers, hip, 0.092 * limb, knee, 0.07 * limb, 1);
        add_bone(&trousers, knee, 0.07 * limb, vec3_add(ankle, vec3(0, 0, -0.02)), 0.06 * limb, 1.1);

        struct flesh shoe = { .blend_m = 0.03, .cell_m = 0.025, .material = SHOES, .part = SHOE };
        struct vec3 heel = vec3_add(ankle, vec3(-0.04, 0, -0.045)), toe = vec3_add(ankle, vec3(0.155, y * 0.03, -0.05));
        toe.z -= joint->toe_drop_m[side];
        if (ready) shoe.hem_z = 0.008; /* a flat sole, to be rolled over */
        add_bone(&shoe, heel, 0.043, toe, 0.036, 1);
        add_bone(&shoe, heel, 0.043, ankle, 0.045, 1);
        add_flesh(model, &shoe);

        struct vec3 trunk[4] = { { -0.005, y * 0.065, frame->hem_z - 0.06 }, { 0, y * 0.048, 1.12 }, { 0, y * 0.07, 1.30 },
                                 { -0.01, y * frame->shoulder_y * (ready ? 0.88 : 0.7), ready ? 1.40 : 1.415 } };
        for (int k = 0; k < 3; k++) add_bone(&jacket, trunk[k], frame->girth[k], trunk[k + 1], frame->girth[k + 1], 1);

        struct flesh sleeve = { .blend_m = 0.03, .folds_m = 0.004, .cell_m = 0.03, .material = JACKET, .part = ARM };
        struct vec3 shoulder = vec3(-0.01, y * frame->shoulder_y, ready ? 1.385 : 1.40), elbow = AT(joint->elbow[side]);
        struct vec3 wrist = AT(joint->wrist[side]), hand = vec3_unit(vec3_sub(wrist, elbow));
        add_bone(&sleeve, shoulder, 0.066 * limb, elbow, 0.053 * limb, 1);
        add_bone(&sleeve, elbow, 0.053 * limb, wrist, 0.043 * limb, 1);
        add_flesh(model, &sleeve);
        struct flesh fist = { .blend_m = 0.02, .cell_m = 0.025, .material = SKIN, .part = FIST };
        add_bone(&fist, vec3_add(wrist, vec3_scale(hand, 0.03)), 0.03 * limb, vec3_add(wrist, vec3_scale(hand, 0.12)),
                 0.032 * limb, 1.2);
        add_flesh(model, &fist);
        if (skeleton) {
            struct vec3 limbs[LIMB_COUNT] = { [UPPER_ARM] = shoulder, [FOREARM] = elbow, [HAND] = wrist, [THIGH] = hip, [SHIN] = knee,
                                              [FOOT] = ankle, [TOES] = vec3_add(heel, vec3_scale(vec3_sub(toe, heel), 0.7)) };
            for (int k = 0; k < LIMB_COUNT; k++) skeleton->at[LIMB(side, k)] = limbs[k];
        }
    }
    add_bone(&jacket, vec3(-0.01, 0, 1.42), 0.09, vec3(0.005, 0, 1.50), 0.06, 1); /* collar */
    add_flesh(model, &trousers);
    add_flesh(model, &jacket);

    add_bone(&skin, vec3(0, 0, 1.46), 0.052, vec3(0.015, 0, 1.58), 0.05, 1);           /* neck */
    add_bone(&skin, vec3(0.01, 0, 1.675), 0.083, vec3(0.035, 0, 1.605), 0.056, 1.12);  /* skull to chin */
    add_bone(&skin, vec3(0.10, 0, 1.655), 0.01, vec3(0.112, 0, 1.635), 0.014, 1);      /* nose */
    add_flesh(model, &skin);
    add_bone(&hair, vec3(-0.006, 0, 1.698), 0.085, vec3(-0.03, 0, 1.66), 0.082, 1.12);
    if (frame->long_hair) {
        add_bone(&hair, vec3(-0.05, 0, 1.66), 0.075, vec3(-0.075, 0, 1.50), 0.06, 0.8);
        for (int y = -1; y <= 1; y += 2) add_bone(&hair, vec3(-0.02, y * 0.05, 1.66), 0.045, vec3(-0.01, y * 0.075, 1.53), 0.03, 1);
    }
    add_flesh(model, &hair);
#undef AT
    double low = 1e9, high = -1e9; /* to the height told, feet on the ground */
    for (size_t i = first; i < model->count; i++)
        for (int k = 0; k < 3; k++) {
            low = fmin(low, model->triangles[i].p[k].z);
            high = fmax(high, model->triangles[i].p[k].z);
        }
    double scale = height_m / (high - low);
    if (skeleton) {
        skeleton->at[HIPS] = vec3(0, 0, 0.96), skeleton->at[SPINE] = vec3(0, 0, 1.10);
        skeleton->at[CHEST] = vec3(0, 0, 1.26), skeleton->at[HEAD] = vec3(0.005, 0, 1.50);
        skeleton->scale = scale, skeleton->ground_z = low, skeleton->stride = frame->stride;
    }
    for (size_t i = first; i < model->count; i++)
        for (int k = 0; k < 3; k++)
            model->triangles[i].p[k] = vec3_scale(vec3_sub(model->triangles[i].p[k], vec3(0, 0, low)), scale);
}
