/* The sky's light on the ground, against what geometry says of it, and that it keeps still. */
#include "gen/trace/shaded_ground.h"

#include "gen/light/sky_image.h"
#include "gen/render/passes.h"
#include "gen/render/sky_uv.h"
#include "tests/gen/solid.h"
#include "tests/tap.h"

static const struct plane flat = { { 0, 0, 1 }, 0 };

static struct scene scene_of(enum sky_kind sky)
{
    return (struct scene){ .path = "scene.yaml", .sky = sky, .cie_type = 5, .sun = sky == SKY_CLEAR ? SUN_GIVEN : SUN_NONE,
                           .sun_azimuth_rad = 2, .sun_elevation_rad = 0.7, .turbidity = 3, .sun_scale = 1,
                           .ground_albedo = { 0.2, 0.2, 0.2 } };
}

static struct entity stand(uint16_t id, const struct solid *solid, double x, double y, double heading_rad)
{
    return (struct entity){ .id = id, .name = "thing", .model_name = "solid", .class_ = CLASS_CAR, .model = &solid->model,
                            .world_from_entity = entity_stand(&flat, vec3(x, y, 0), heading_rad) };
}

static double share_of(struct sky_seen seen)
{
    return luminance_of(seen.with) / luminance_of(seen.without);
}

/* A car as far as the ground is concerned: a body with air under it. */
static void car(struct solid *solid)
{
    solid_box(solid, 4.2, 1.8, 1.2);
    for (size_t i = 0; i < solid->mesh.vertices; i++) solid->mesh.position_m[i][2] += 0.2f;
    solid->model.min_m = vec3(-2.1, -0.9, 0);
    solid->model.max_m = vec3(2.1, 0.9, 1.4);
}

/* A frame's ground: entities with their receivers, lit. */
struct frame {
    struct receiver receivers[2];
    struct shaded_ground ground;
    struct sky_sight *sight;
    size_t n;
};

static bool frame_light(struct frame *f, const struct light *light, const struct tracer *tracer, const struct entity *entities,
                        size_t n, struct error *err)
{
    struct pass_settings settings = pass_settings(QUALITY_STANDARD);
    /* From 8 m high and 10 m away, at 1000 px a radian. */
    const struct shaded_ground_detail detail = { { -10, 0, 8 }, 1e-3, settings.fine_px, { 0, 0 }, { 0 } };
    bool ok = sky_sight_create(&f->sight, &(struct sky_sight_input){ .light = light, .directions = settings.sky_directions }, err);
    for (f->n = 0; ok && f->n < n; f->n++)
        ok = receiver_create(&f->receivers[f->n], &entities[f->n], &flat, light, false, NULL, err) &&
             sky_sight_add(f->sight, tracer, &entities[f->n], &f->receivers[f->n], err);
    return ok && shaded_ground_of_plane(&f->ground, &flat, f->receivers, n, err) && shaded_ground_shade(&f->ground, f->sight, detail, err);
}

static void frame_release(struct frame *f)
{
    for (size_t i = 0; i < f->n; i++) receiver_release(&f->receivers[i]);
    shaded_ground_release(&f->ground);
    sky_sight_destroy(f->sight);
    *f = (struct frame){ 0 };
}

/* The share at a ground point as POV-Ray interpolates it; NAN beside the mesh. */
static double share_at(const struct shaded_ground *g, double x, double y)
{
    for (size_t i = 0; i < g->triangles; i++) {
        struct vec3 p[3];
        double weight[3], sum = 0, with = 0, without = 0;
        for (int k = 0; k < 3; k++) p[k] = g->position_m[g->triangle[i][k]];
        for (int k = 0; k < 3; k++) {
            struct vec3 a = p[(k + 1) % 3], b = p[(k + 2) % 3];
            weight[k] = (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
            sum += weight[k];
        }
        if (weight[0] < -1e-12 || weight[1] < -1e-12 || weight[2] < -1e-12 || !(sum > 0)) continue;
        for (int k = 0; k < 3; k++) {
            with += weight[k] * luminance_of(g->sky[g->triangle[i][k]].with);
            without += weight[k] * luminance_of(g->sky[g->triangle[i][k]].without);
        }
        return with / without;
    }
    return NAN;
}

/* The wall is dark, and an eye that looks down by 45 degrees sees it in the ground up to 2 m before it; the rougher, the less sharply it ends. */
static void wet_before_a_wall(const struct sky_sight *sight)
{
    const struct wet film = { 0.05, 0.05 }, road = { 0.05, 0.4 };
    const double dark[3] = { 0 };
    double before = 0, rises = 0;
    for (double d = 0.5; d < 4; d += 0.5) {
        struct vec3 p = vec3(d, 3, 0), eye = vec3(d + 20, 3, 20);
        struct sky_seen sharp = sky_sight_mirrored(sight, &film, p, flat.normal, eye, dark), soft = sky_sight_mirrored(sight, &road, p, flat.normal, eye, dark);
        if (d != 2) NEAR(share_of(sharp), d > 2, 0.02, "%.1f m before the wall a film of water mirrors %s", d, d > 2 ? "the sky" : "it");
        double left = share_of(soft);
        rises = d > 0.5 ? fmax(rises, left - before) : 0;
        OK(left > before, "%.1f m before it rough ground mirrors %.2f of the sky", d, left);
        before = left;
    }
    OK(rises < 0.35, "and no step: %.2f at most in half a metre", rises);
    struct vec3 p = vec3(3, 3, 0), eye = vec3(23, 3, 20);
    double sky = sky_sight_at(sight, p, flat.normal).without[1], mirrored = sky_sight_mirrored(sight, &film, p, flat.normal, eye, dark).without[1];
    NEAR(mirrored / sky, 0.05 + 0.95 * pow(1 - sqrt(0.5), 5), 0.0005, "of an even sky Fresnel's share");
}

/* Of two that stand in a line the nearer hides the farther, whichever is named first. */
static void wet_before_two(const struct light *light, const struct tracer *tracer)
{
    static const struct vec2 far[] = { { -500, -500 }, { 500, -500 }, { 500, 500 }, { -500, 500 } };
    struct vec3 corner[4];
    for (int i = 0; i < 4; i++) corner[i] = vec3(far[i].x, far[i].y, 0);
    const struct receiver everywhere = { corner, 4, 1 };
    const struct wet film = { 0.05, 0.05 };
    const double lit[3] = { 1, 1, 1 };
    struct error err = ERROR_NONE;
    struct solid wall;
    solid_box(&wall, 50, 0.01, 2);
    struct entity near = stand(1, &wall, 0, 0, 0), behind = stand(2, &wall, -3, 0, 0);
    near.has_color = behind.has_color = true;
    near.color[0] = behind.color[2] = 0.5;
    wall.material.kind = FINISH_PAINT;
    for (int turn = 0; turn < 2; turn++) {
        struct sky_sight *sight = NULL;
        struct sky_sight_input in = { .light = light, .directions = 128, .round.radiance = &light->sky };
        if (!OK(sky_sight_create(&sight, &in, &err) && sky_sight_add(sight, tracer, turn ? &behind : &near, &everywhere, &err) &&
                sky_sight_add(sight, tracer, turn ? &near : &behind, &everywhere, &err), "a red wall before a blue one %s", err.text)) break;
        struct sky_seen seen = sky_sight_mirrored(sight, &film, vec3(1, 0, 0), flat.normal, vec3(21, 0, 20), lit);
        OK(seen.with[0] > 5 * seen.with[2], "the red one is mirrored, if it is named %s: R %.4f B %.4f", turn ? "last" : "first", seen.with[0], seen.with[2]);
        sky_sight_destroy(sight);
    }
    solid_free(&wall);
}

/* An eye 3 m high and 30 m away sees the roof of a car mirrored far before it. */
static void mirrored_in_receiver(const struct light *light, const struct solid *body)
{
    struct error err = ERROR_NONE;
    struct receiver dry = { 0 }, wet = { 0 };
    struct entity entity = stand(1, body, 0, 0, 0);
    const struct vec3 eye = vec3(30, 0, 3), roof = vec3(0.9, 0, 1.4);
    if (!OK(receiver_create(&dry, &entity, &flat, light, false, NULL, &err) && receiver_create(&wet, &entity, &flat, light, false, &eye, &err),
            "ground round a car, dry and wet")) return;
    struct vec3 there = vec3(roof.x + (eye.x - roof.x) * roof.z / (roof.z + eye.z), 0, 0);
    NEAR(receiver_share(&dry, there), 0, 1e-9, "dry, it takes nothing from the ground %.1f m away", there.x);
    NEAR(receiver_share(&wet, there), 1, 1e-9, "wet, it is mirrored there");
    receiver_release(&dry);
    receiver_release(&wet);
}

/* An even sky and an endless wall: of the ground's light at a distance d it takes (1 - d / sqrt(d^2 + h^2)) / 2. */
static void beside_a_wall(const struct tracer *tracer)
{
    static const struct vec2 far[] = { { -500, -500 }, { 500, -500 }, { 500, 500 }, { -500, 500 } };
    struct vec3 corner[4];
    for (int i = 0; i < 4; i++) corner[i] = vec3(far[i].x, far[i].y, 0);
    const struct receiver everywhere = { corner, 4, 1 };
    struct scene scene = scene_of(SKY_CIE);
    struct error err = ERROR_NONE;
    struct light light;
    struct solid wall;
    struct sky_sight *sight = NULL;
    solid_box(&wall, 600, 0.01, 2);
    struct entity entity = stand(1, &wall, 0, 0, 0);
    if (OK(light_create(&light, &scene, &err) && sky_sight_create(&sight, &(struct sky_sight_input){ .light = &light, .directions = 128 }, &err) &&
           sky_sight_add(sight, tracer, &entity, &everywhere, &err), "an even sky and a wall")) {
        for (double d = 0.25; d < 10; d *= 2) {
            struct sky_seen seen = sky_sight_at(sight, vec3(d, 3, 0), flat.normal);
            double want = 1 - (1 - d / hypot(d, 2)) / 2;
            NEAR(share_of(seen), want, 2.5 / 128, "%.2f m beside a wall of 2 m %.3f of the sky's light is left", d, want);
        }
        struct sky_seen slope = sky_sight_at(sight, vec3(-1, 3, 0), vec3(-1, 0, 0));
        NEAR(share_of(slope), 1, 1e-9, "what faces away from the wall loses nothing");
        wet_before_a_wall(sight);
    }
    sky_sight_destroy(sight);
    solid_free(&wall);
    light_release(&light);
}

/* Between the points where it is known the light is right, and along a line out from under a car it only grows. */
static void contact_shadow(const struct light *light, const struct tracer *tracer, const struct solid *body)
{
    struct error err = ERROR_NONE;
    struct frame f = { 0 };
    struct entity entity = stand(1, body, 0, 0, 0.5);
    if (OK(frame_light(&f, light, tracer, &entity, 1, &err), "a car on its ground")) {
        double worst = 0, squares = 0;
        int n = 0;
        struct vec3 side = mat3_column(entity.world_from_entity.rotation, 1), along = mat3_column(entity.world_from_entity.rotation, 0);
        for (int i = 0; i < 60; i++) /* on the eye's side of it and before it */
            for (int k = 0; k < 30; k++) {
                struct vec3 p = vec3_add(vec3_scale(along, -3.5 + 0.117 * i), vec3_scale(side, 0.8 + 0.031 * k));
                if (side.x > 0) p = vec3_scale(p, -1);
                double off = fabs(share_at(&f.ground, p.x, p.y) - share_of(sky_sight_at(f.sight, p, flat.normal)));
                worst = fmax(worst, off);
                squares += off * off;
                n++;
            }
        OK(f.ground.vertices > 1000 && sqrt(squares / n) < 0.012 && worst < 0.06, "between its points the light is right to %.4f, at most %.3f off", sqrt(squares / n), worst);
        double before = 0, falls = 0, leaps = 0;
        for (double d = 0.7; d < 3; d += 0.01) {
            struct vec3 p = vec3_scale(side, side.x > 0 ? -d : d);
            double share = share_at(&f.ground, p.x, p.y);
            falls = fmax(falls, before - share);
            if (before > 0) leaps = fmax(leaps, share - before);
            before = share;
        }
        OK(falls < 0.004, "from under a car outward the light only grows: no bands (falls by %.4f)", falls);
        OK(leaps < 0.04 && before > 0.85, "step by step of a centimetre (by %.3f at most, to %.2f)", leaps, before);
    }
    frame_release(&f);
}

/* The vertex of a ground at a place, or NULL. */
static const struct sky_seen *seen_at(const struct shaded_ground *g, struct vec3 p)
{
    for (size_t i = 0; i < g->vertices; i++)
        if (g->position_m[i].x == p.x && g->position_m[i].y == p.y) return &g->sky[i];
    return NULL;
}

/* Another car goes by, as near as its receiver does not reach: nothing else changes. */
static void others_stay(const struct light *light, const struct tracer *tracer, const struct solid *body)
{
    struct error err = ERROR_NONE;
    struct frame before = { 0 }, after = { 0 };
    struct entity entities[] = { stand(1, body, 0, 0, 0.5), stand(2, body, 14, 3, 0.2) };
    bool ok = frame_light(&before, light, tracer, entities, 2, &err);
    entities[1] = stand(2, body, 13.63, 4.41, 0.3);
    if (OK(ok && frame_light(&after, light, tracer, entities, 2, &err), "a car, and another that moves")) {
        size_t own = 0, same = 0;
        for (size_t i = 0; i < before.ground.vertices; i++) {
            struct vec3 p = before.ground.position_m[i];
            if (!receiver_contains(&before.receivers[0], p)) continue;
            const struct sky_seen *now = seen_at(&after.ground, p);
            own++;
            same += now && !memcmp(now, &before.ground.sky[i], sizeof *now);
        }
        OK(own > 500 && same == own, "round the one that stands every point stays, to the last bit (%zu of %zu)", same, own);
    }
    frame_release(&before);
    frame_release(&after);
}

/* A car a few millimetres further has its shade a few millimetres further. */
static void shade_travels(const struct light *light, const struct tracer *tracer, const struct solid *body)
{
    struct error err = ERROR_NONE;
    struct frame here = { 0 }, there = { 0 };
    struct entity entity = stand(1, body, 0, 0, 0.5);
    bool ok = frame_light(&here, light, tracer, &entity, 1, &err);
    struct vec3 side = mat3_column(entity.world_from_entity.rotation, 1), along = mat3_column(entity.world_from_entity.rotation, 0);
    if (side.x > 0) side = vec3_scale(side, -1);
    for (int step = 1; ok && step <= 3; step++) {
        double by = 0.0043 * step, worst = 0, squares = 0; /* a third of a pixel, there */
        int n = 0;
        entity = stand(1, body, along.x * by, along.y * by, 0.5);
        ok = frame_light(&there, light, tracer, &entity, 1, &err);
        for (int i = 0; ok && i < 40; i++)
            for (int k = 0; k < 20; k++) {
                struct vec3 p = vec3_add(vec3_scale(along, -3.4 + 0.171 * i), vec3_scale(side, 0.75 + 0.093 * k));
                double change = share_at(&there.ground, p.x + along.x * by, p.y + along.y * by) - share_at(&here.ground, p.x, p.y);
                worst = fmax(worst, fabs(change));
                squares += change * change;
                n++;
            }
        OK(ok && sqrt(squares / n) < 0.006 && worst < 0.06, "moved by %.1f mm, its shade moves with it (rms %.4f, at most %.3f)", 1000 * by,
           sqrt(squares / n), worst);
        frame_release(&there);
    }
    frame_release(&here);
}

/* What POV-Ray is told of colour. */
static void told_as_uv(const struct light *light, const struct tracer *tracer, const struct solid *body)
{
    struct error err = ERROR_NONE;
    struct frame f = { 0 };
    struct entity entity = stand(1, body, 0, 0, 0.5);
    if (OK(frame_light(&f, light, tracer, &entity, 1, &err), "a car under a blue sky")) {
        struct sky_scale scale = sky_scale(&f.ground, light);
        double worst = 0, open = luminance_of(f.ground.sky[0].without);
        bool within = true;
        for (size_t i = 0; i < f.ground.vertices; i++) {
            struct vec2 uv = sky_uv(&scale, f.ground.sky[i].with);
            within = within && uv.x >= 0 && uv.x < 1 && uv.y >= 0 && uv.y < 1;
            for (int c = 0; c < 3; c++)
                worst = fmax(worst, fabs(uv.x * scale.most[c] + (uv.y - 0.5) * scale.tint[c] - f.ground.sky[i].with[c]));
        }
        OK(within, "uv lie where POV-Ray's gradients do not repeat");
        OK(worst < 0.015 * open, "two figures a point tell its light, colour and all, to %.2f %% of the open sky's", 100 * worst / open);
    }
    frame_release(&f);
}

int main(void)
{
    struct error err = ERROR_NONE;
    struct tracer *tracer = NULL;
    struct light overcast, clear;
    struct scene cloudy = scene_of(SKY_OVERCAST), sunny = scene_of(SKY_CLEAR);
    struct solid body;
    car(&body);
    const struct model *models[] = { &body.model };
    if (!OK(tracer_create(&tracer, models, 1, &err) && light_create(&overcast, &cloudy, &err) && light_create(&clear, &sunny, &err),
            "a car, clouds and a clear sky"))
        return tap_done();
    beside_a_wall(tracer);
    wet_before_two(&overcast, tracer);
    mirrored_in_receiver(&overcast, &body);
    contact_shadow(&overcast, tracer, &body);
    contact_shadow(&clear, tracer, &body);
    others_stay(&overcast, tracer, &body);
    others_stay(&clear, tracer, &body);
    shade_travels(&overcast, tracer, &body);
    told_as_uv(&clear, tracer, &body);
    tracer_destroy(tracer);
    solid_free(&body);
    light_release(&overcast);
    light_release(&clear);
    return tap_done();
}
