/* What of the place can matter to an entity, by the sun's geometry. */
#include "gen/world/surroundings.h"

#include "tests/gen/solid.h"
#include "tests/tap.h"
#include "gen/world/prism.h"

static const struct plane ground = { { 0, 0, 1 }, 10 };
static const double top_m = 60;

struct around {
    struct receiver receiver[2];
    struct surroundings s;
};

static bool look_around(struct around *a, const struct entity entity[2], const struct light *light)
{
    struct error err = ERROR_NONE;
    return receiver_create(&a->receiver[0], &entity[0], &ground, light, false, NULL, &err) &&
           receiver_create(&a->receiver[1], &entity[1], &ground, light, false, NULL, &err) &&
           surroundings_create(&a->s, a->receiver, entity, 2, light, top_m, &err);
}

static void leave(struct around *a)
{
    surroundings_release(&a->s);
    for (int i = 0; i < 2; i++) receiver_release(&a->receiver[i]);
}

static bool shades(const struct surroundings *s, struct vec3 p)
{
    bool within = false;
    for (size_t i = 0; i < s->shade_count; i++) within = within || prism_contains(&s->shades[i], p);
    return within;
}

int main(void)
{
    struct solid box;
    solid_box(&box, 4, 2, 1.5);
    const struct entity entity[2] = {
        { .id = 1, .name = "near", .class_ = CLASS_CAR, .model = &box.model, .world_from_entity = entity_stand(&ground, vec3(0, 0, 0), 0.4) },
        { .id = 2, .name = "far", .class_ = CLASS_CAR, .model = &box.model, .world_from_entity = entity_stand(&ground, vec3(30, 5, 0), 2) },
    };
    /* The sun in the south-west, 30 deg high. */
    struct vec3 sun = { -cos(M_PI / 6) / sqrt(2), -cos(M_PI / 6) / sqrt(2), 0.5 };
    struct light sunny = { .has_sun = true, .sun_direction = sun }, cloudy = { .has_sun = false };
    struct around a;

    if (OK(look_around(&a, entity, &sunny), "under a sun")) {
        OK(a.s.n == 2 && a.s.shade_count == 4, "a receiver each, and shades above and towards the sun");
        bool taken = true, hull = true;
        /* Every shadow of the box's corners on the ground, and 2 m below where it falls off. */
        for (int i = 0; i < 2; i++) {
            struct vec3 corner[8];
            entity_corners(corner, &entity[i]);
            for (int k = 0; k < 8; k++)
                for (double z = 10; z >= 8; z -= 2) {
                    struct vec3 p = vec3_add(corner[k], vec3_scale(sun, (z - corner[k].z) / sun.z));
                    if (z == 10) taken = taken && prism_contains(&a.s.receivers[i], p);
                    p.x = corner[k].x;
                    p.y = corner[k].y;
                    hull = hull && prism_contains(&a.s.receivers[i], p);
                }
        }
        OK(taken, "shadows on the ground lie within the receivers");
        OK(hull, "the ground below may lie lower");
        OK(!prism_contains(&a.s.receivers[0], vec3(15, 0, 10)) && !prism_contains(&a.s.receivers[0], vec3(0, 0, 25)),
           "what is far beside or above takes no shadow");
        bool blocked = true;
        for (double t = 0.1; t * sun.z < 48; t += 3) /* to the top of the mesh */
            for (int i = 0; i < 2; i++)
                blocked = blocked && shades(&a.s, vec3_add(entity[i].world_from_entity.translation, vec3_scale(sun, t)));
        OK(blocked, "all that lies between an entity and the sun can shade it, to the top of the place");
        OK(shades(&a.s, vec3(0, 0, 20)) && !shades(&a.s, vec3(0, 0, 40)), "what hangs over it takes sky from it, if it is not far above");
        OK(!shades(&a.s, vec3_add(vec3(0, 0, 11), vec3_scale(vec3(-sun.x, -sun.y, sun.z), 30))), "what lies away from the sun does not");
        leave(&a);
    }
    if (OK(look_around(&a, entity, &cloudy), "under clouds")) {
        OK(a.s.n == 2 && a.s.shade_count == 2, "shades above alone");
        OK(!shades(&a.s, vec3_scale(sun, 60)), "nothing towards a sun");
        leave(&a);
    }
    sunny.sun_direction = vec3_unit(vec3(-1, 0, 0.005));
    if (OK(look_around(&a, entity, &sunny), "under a sun at the horizon")) {
        bool finite = true;
        for (size_t i = 0; i < a.s.shade_count; i++) finite = finite && isfinite(a.s.shades[i].above_m) && a.s.shades[i].axis.z > 0.01;
        OK(finite, "no shade reaches without end");
        leave(&a);
    }
    struct surroundings none;
    struct error err = ERROR_NONE;
    OK(surroundings_create(&none, NULL, NULL, 0, &cloudy, top_m, &err) && none.n == 0 && none.shade_count == 0, "nobody: nothing matters");
    surroundings_release(&none);
    solid_free(&box);
    return tap_done();
}
