#include "gen/world/entity.h"

#include "tests/tap.h"

#define RAD (M_PI / 180)

static const struct plane level = { { 0, 0, 1 }, 0 };

static void check_stand(void)
{
    const struct { double heading_deg; struct vec3 forward, left; } headings[] = {
        { 0, { 0, 1, 0 }, { -1, 0, 0 } },
        { 90, { 1, 0, 0 }, { 0, 1, 0 } },
        { 180, { 0, -1, 0 }, { 1, 0, 0 } },
        { 270, { -1, 0, 0 }, { 0, -1, 0 } },
    };
    for (size_t i = 0; i < 4; i++) {
        struct pose pose = entity_stand(&level, vec3(3, 4, 0), headings[i].heading_deg * RAD);
        OK(vec3_norm(vec3_sub(mat3_column(pose.rotation, 0), headings[i].forward)) < 1e-12
               && vec3_norm(vec3_sub(mat3_column(pose.rotation, 1), headings[i].left)) < 1e-12
               && mat3_column(pose.rotation, 2).z == 1,
           "heading %g: forward is (%g, %g), the left side is to its left", headings[i].heading_deg,
           headings[i].forward.x, headings[i].forward.y);
    }

    struct plane hill = { vec3_unit(vec3(0.3, -0.5, 1)), 2 };
    double worst_rotation = 0, worst_up = 0, worst_heading = 0, worst_height = 0;
    for (int deg = -180; deg < 360; deg += 15) {
        struct vec3 at = { deg * 0.5, 30 - deg, 1000 };
        struct pose pose = entity_stand(&hill, at, deg * RAD);
        struct vec3 forward = mat3_column(pose.rotation, 0);
        worst_rotation = fmax(worst_rotation, fmax(mat3_orthonormality(pose.rotation),
                                                   fabs(mat3_determinant(pose.rotation) - 1)));
        worst_up = fmax(worst_up, vec3_norm(vec3_sub(mat3_column(pose.rotation, 2), hill.normal)));
        worst_heading = fmax(worst_heading, fabs(remainder(atan2(forward.x, forward.y) - deg * RAD, 2 * M_PI)));
        worst_height = fmax(worst_height, fmax(fabs(vec3_dot(hill.normal, pose.translation) - hill.offset_m),
                                               hypot(pose.translation.x - at.x, pose.translation.y - at.y)));
    }
    NEAR(worst_rotation, 0, 1e-14, "on a hill the pose is a rotation");
    NEAR(worst_up, 0, 0, "its z axis is the hill's normal");
    NEAR(worst_heading, 0, 1e-14, "seen from above, forward is the heading");
    NEAR(worst_height, 0, 1e-12, "and it stands on the hill at its x and y, whatever its z was");
}

/* A car-sized box: 4 m long, 2 m wide, 1.5 m high, unless said otherwise. */
static const struct model car = { .min_m = { -2, -1, 0 }, .max_m = { 2, 1, 1.5 } };
static const struct model cube = { .min_m = { -1, -1, 0 }, .max_m = { 1, 1, 2 } };
static const struct model child = { .min_m = { -0.2, -0.2, 0 }, .max_m = { 0.2, 0.2, 1 } };

static struct entity standing(const struct model *model, double x_m, double y_m, double heading_deg)
{
    return (struct entity){ .model = model, .world_from_entity = entity_stand(&level, vec3(x_m, y_m, 0), heading_deg * RAD) };
}

static struct entity turned(const struct model *model, struct vec3 at_m, struct quat q)
{
    return (struct entity){ .model = model, .world_from_entity = { mat3_from_quat(q), at_m } };
}

static bool meet(struct entity a, struct entity b, double tolerance_m)
{
    bool ab = entities_intersect(&a, &b, tolerance_m), ba = entities_intersect(&b, &a, tolerance_m);
    if (ab != ba) printf("# not the same both ways\n");
    return ab && ba;
}
static bool apart(struct entity a, struct entity b, double tolerance_m)
{
    return !entities_intersect(&a, &b, tolerance_m) && !entities_intersect(&b, &a, tolerance_m);
}

static void check_intersect(void)
{
    struct entity at_origin = standing(&car, 0, 0, 90);
    OK(meet(at_origin, at_origin, 0.01), "a box meets itself");
    OK(meet(at_origin, standing(&child, 0.5, 0.3, 20), 0.01), "a box meets one that it holds whole");
    OK(apart(at_origin, standing(&car, 10, 0, 90), 0), "two cars in a queue are apart");
    OK(meet(at_origin, standing(&car, 3.9, 0, 90), 0.01), "and meet 10 cm into each other");
    OK(apart(at_origin, standing(&car, 3.9, 0, 90), 0.11), "which a tolerance of 11 cm lets pass");
    OK(apart(at_origin, standing(&car, 4, 0, 90), 1e-9), "touching bumpers are apart");
    OK(apart(at_origin, standing(&car, 0, 2, 90), 1e-9), "touching doors are apart");
    OK(apart(at_origin, standing(&car, 4, 2, 90), 1e-9), "touching corners are apart");
    OK(meet(at_origin, standing(&car, 3.99, 1.99, 90), 1e-3), "corners a centimetre in meet");

    /* Beside a car at 45 deg the shadows on north and east overlap; only the turned axis tells. */
    OK(apart(at_origin, standing(&car, 3.2, 2.8, 45), 0), "a car turned by 45 deg passes a corner");
    OK(meet(at_origin, standing(&car, 3.2, 1.2, 45), 0.01), "and meets it when closer");

    struct entity above = at_origin;
    above.world_from_entity.translation.z = 1.6;
    OK(apart(at_origin, above, 0), "a box over another is apart");
    above.world_from_entity.translation.z = 1.4;
    OK(meet(at_origin, above, 0.05), "and meets it when let down");

    /* Two cubes stood on edge, one along x and one along y, crossing over: their nearest
     * features are edges, and no face's axis separates them. The edges are sqrt(2) from
     * the centres, which lie 1 above the cubes' origins before turning. */
    struct quat on_x = { cos(M_PI / 8), sin(M_PI / 8), 0, 0 }, on_y = { cos(M_PI / 8), 0, sin(M_PI / 8), 0 };
    struct vec3 up_a = mat3_apply(mat3_from_quat(on_x), vec3(0, 0, -1));
    struct vec3 up_b = mat3_apply(mat3_from_quat(on_y), vec3(0, 0, -1));
    double edge = 2 * sqrt(2);
    OK(apart(turned(&cube, up_a, on_x), turned(&cube, vec3_add(up_b, vec3(0, 0, edge + 0.01)), on_y), 0),
       "edge over edge, a centimetre between, is apart");
    OK(meet(turned(&cube, up_a, on_x), turned(&cube, vec3_add(up_b, vec3(0, 0, edge - 0.01)), on_y), 0.005),
       "a centimetre into each other meets");
    OK(apart(turned(&cube, up_a, on_x), turned(&cube, vec3_add(up_b, vec3(0, 0, edge - 0.01)), on_y), 0.011),
       "which a tolerance of 11 mm lets pass");

    /* Two slender beams crossing askew: the cross product of their long edges separates them. */
    const struct model beam = { .min_m = { -5, -0.1, -0.1 }, .max_m = { 5, 0.1, 0.1 } };
    struct quat askew = { 0.9, 0.1, 0.2, 0.37 };
    struct vec3 along = mat3_apply(mat3_from_quat(askew), vec3(1, 0, 0));
    struct vec3 between = vec3_unit(vec3_cross(vec3(1, 0, 0), along));
    OK(apart(turned(&beam, vec3(0, 0, 0), (struct quat){ 1, 0, 0, 0 }), turned(&beam, vec3_scale(between, 0.29), askew), 0)
           && meet(turned(&beam, vec3(0, 0, 0), (struct quat){ 1, 0, 0, 0 }), turned(&beam, vec3_scale(between, 0.19), askew), 0),
       "beams that cross are apart 29 cm from axis to axis and meet at 19");
}

static void check_corners(void)
{
    const struct model model = { .min_m = { -2, -1, 0 }, .max_m = { 3, 1.5, 1.6 } };
    struct entity entity = standing(&model, 10, 20, 0); /* forward is north, left is west */
    const struct vec3 want[8] = { { 11, 18, 0 }, { 11, 18, 1.6 }, { 8.5, 18, 0 }, { 8.5, 18, 1.6 },
                                  { 11, 23, 0 }, { 11, 23, 1.6 }, { 8.5, 23, 0 }, { 8.5, 23, 1.6 } };
    struct vec3 got[8];
    entity_corners(got, &entity);
    for (int i = 0; i < 8; i++)
        NEAR(vec3_norm(vec3_sub(got[i], want[i])), 0, 1e-12, "corner %d lies at %g, %g, %g", i, want[i].x, want[i].y,
             want[i].z);
}

int main(void)
{
    check_stand();
    check_intersect();
    check_corners();
    return tap_done();
}
