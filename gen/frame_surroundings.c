#include "gen/frame_impl.h"

#include "gen/estimate/ground_shade.h"
#include "gen/estimate/sun_share.h"
#include "gen/light/orthophoto.h"
#include "gen/light/panorama.h"
#include "gen/light/relief.h"
#include "gen/light/seen.h"
#include "gen/light/standing.h"
#include "gen/light/unhidden.h"
#include "gen/render/place_sdl.h"
#include "gen/trace/bounced.h"
#include "lib/file.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define LOWEST_SUN 0.05 /* its rays' slope, for a map along them */
#define PAST_PLACE 1.02 /* no part of the place is behind the circle */
#define ROOM 1.2   /* the circle is so many times as far from the camera as what is within it */
#define BODY_M 1.0 /* height over the ground at which entities look round on a plane */
#define OVER_CARS_M 2.2 /* over a place: what stands near by hides less of what stands behind it */

static double look_round_m(const struct frame *f) { return f->stage->mesh ? OVER_CARS_M : BODY_M; }

/* Among the entities, by how much of each is seen: one that comes into the picture moves it little by little. */
static struct vec3 among_entities(const struct frame *f)
{
    struct vec3 sum = { 0, 0, 0 };
    double weights = 0;
    for (size_t i = 0; i < f->moment.n; i++) {
        if (!f->matters[i]) continue;
        double weight = (double)f->labels.entities[i].pixels_visible + 1;
        sum = vec3_add(sum, vec3_scale(f->moment.entities[i].world_from_entity.translation, weight));
        weights += weight;
    }
    return vec3_add(vec3_scale(sum, 1 / weights), vec3(0, 0, look_round_m(f)));
}

static struct seen seen_of(const struct frame *f, const struct image *unhidden)
{
    const struct scene *s = f->scene;
    struct seen seen = { .picture = &f->picture, .camera = f->camera, .world_from_camera = f->shot->world_from_camera,
                         .unhidden = unhidden };
    memcpy(seen.k, f->exposure.k, sizeof seen.k);
    /* A new view has no mist in it yet. */
    if (s->has_mist && f->photograph[0]) seen.visibility_m = s->visibility_m;
    memcpy(seen.haze, s->haze, sizeof seen.haze);
    seen_init(&seen);
    return seen;
}

#define SUN_SHARE_FILE "sun-share.png"
#define SUN_THROUGH_FILE "sun-through.png"

/* Out: path (SURROUNDINGS_PATH_SIZE) relative to the output folder */
static bool write_image(char *path, const struct frame *f, const char *name, const struct image *image, struct error *err)
{
    snprintf(path, SURROUNDINGS_PATH_SIZE, "frames/%s/%s", f->name, name);
    char *file = string_format("%s/%s", f->folder, name);
    bool ok = (file || error_set(err, ERR_MEMORY, "no memory for a path")) && image_write(file, image, err);
    free(file);
    return ok;
}

static bool remove_earlier(const struct frame *f, const char *name, struct error *err)
{
    char *earlier = string_format("%s/%s", f->folder, name);
    if (!earlier) return error_set(err, ERR_MEMORY, "no memory for a path");
    unlink(earlier);
    free(earlier);
    return true;
}

/* What of the sun reaches the ground where entities and their shadows are, as far as the photograph tells. */
static bool write_sun_share(struct pass_surroundings *out, struct frame *f, const struct seen *seen, struct error *err)
{
    const struct light *light = f->context->light;
    const struct static_mesh *mesh = f->stage->mesh;
    if (!remove_earlier(f, SUN_SHARE_FILE, err) || !remove_earlier(f, SUN_THROUGH_FILE, err)) return false;
    if (f->scene->shade == SHADE_NONE || !f->photograph[0] || !light->has_sun || (mesh && light->sun_direction.z < LOWEST_SUN)) return true;
    struct ground_shade shade = { 0 };
    struct plane level = { vec3(0, 0, 1), INFINITY };
    struct receiver *receivers = calloc(f->moment.n + 1, sizeof *receivers); /* borrowed */
    if (!receivers) return error_set(err, ERR_MEMORY, "no memory for a frame");
    struct sun_share_input in = { .shade = &shade, .seen = seen, .ground = mesh ? &level : &f->scene->ground, .receivers = receivers,
                                  .place = mesh, .place_depth = &f->labels.place_depth, .towards_sun = light->sun_direction };
    double top = -INFINITY;
    for (size_t i = 0; i < f->moment.n; i++) {
        double foot = f->moment.entities[i].world_from_entity.translation.z, height = f->moment.entities[i].model->max_m.z;
        if (!f->matters[i]) continue;
        receivers[in.n++] = f->receivers[i];
        in.height_m = fmax(in.height_m, height);
        level.offset_m = fmin(level.offset_m, floor(foot)); /* not with every step of theirs another */
        top = fmax(top, foot + height);
    }
    in.top_m = top - level.offset_m;
    bool ok = ground_shade_find(&shade, f->stage, &f->picture, seen->unhidden, f->shot, light, err) &&
              sun_share_create(&out->sun_share, &in, err);
    f->shaded = shade.share;
    ground_shade_release(&shade);
    free(receivers);
    return ok && (!out->sun_share.map.data || write_image(out->sun_share_map, f, SUN_SHARE_FILE, &out->sun_share.map, err)) &&
           (!out->sun_share.through.data || write_image(out->sun_through_map, f, SUN_THROUGH_FILE, &out->sun_share.through, err));
}

static bool write_ground(struct pass_surroundings *out, double color_gain[3], const struct frame *f, const struct seen *seen,
                         const struct sky_sight *sight, struct error *err)
{
    struct entity *entities = calloc(f->moment.n + 1, sizeof *entities);
    struct bounced_ground *below = calloc(f->moment.n + 1, sizeof *below);
    if (!entities || !below) {
        free(entities);
        free(below);
        return error_set(err, ERR_MEMORY, "no memory for a frame");
    }
    struct orthophoto_input in = {
        .seen = seen, .light = f->context->light, .ground = f->stage->mesh ? NULL : &f->scene->ground,
        .sun = f->stage->mesh ? NULL : &out->sun_share, .wet = f->scene->wet, .place = f->stage->mesh, .place_depth = &f->labels.place_depth,
        .entities = entities,
    };
    memcpy(in.ground_albedo, f->scene->ground_albedo, sizeof in.ground_albedo);
    for (size_t i = 0; i < f->moment.n; i++) {
        if (!f->matters[i]) continue;
        struct vec3 at = f->moment.entities[i].world_from_entity.translation;
        below[in.n] = (struct bounced_ground){ { at.x, at.y }, frame_local_ground(f, &f->moment.entities[i]) };
        entities[in.n++] = f->moment.entities[i];
    }
    struct orthophoto ground = { 0 };
    bool ok = orthophoto_create(&ground, &in, err);
    if (ok) {
        struct bounced_input bounced = { .sight = sight, .light = in.light, .sun = in.sun, .low_m = ground.low_m, .high_m = ground.high_m,
                                         .ground = below, .n = in.n };
        ok = bounced_shade(&ground.bouncing, &bounced, err);
    }
    free(entities);
    free(below);
    ok = ok && write_image(out->orthophoto, f, "orthophoto.png", &ground.mirrored, err) &&
         write_image(out->orthophoto_coarse, f, "orthophoto-coarse.png", &ground.bouncing, err);
    out->low_m = ground.low_m;
    out->high_m = ground.high_m;
    memcpy(out->ground_albedo, ground.elsewhere, sizeof out->ground_albedo);
    memcpy(color_gain, ground.color_gain, sizeof ground.color_gain);
    orthophoto_release(&ground);
    return ok;
}

/* All who see the circle are within it, and all that stands before it. */
static double circle_radius(const struct frame *f, double radius_m)
{
    struct vec3 eye = f->shot->world_from_camera.translation;
    for (size_t i = 0; i < f->moment.n; i++) {
        struct vec3 p = f->moment.entities[i].world_from_entity.translation;
        if (f->matters[i]) radius_m = fmax(radius_m, ROOM * hypot(p.x - eye.x, p.y - eye.y));
    }
    for (size_t i = 0; i < f->occluder_count; i++)
        radius_m = fmax(radius_m, ROOM * hypot(f->occluders[i].foot_m.x - eye.x, f->occluders[i].foot_m.y - eye.y));
    return radius_m;
}

/* Over a place, what stands near is on the relief, and the sky shows what is beyond. */
static bool write_panorama(struct pass_surroundings *out, double *radius_m, const struct frame *f, struct panorama_input *in, struct error *err)
{
    struct panorama panorama = { 0 }, far = { 0 };
    if (!panorama_create(&panorama, in, err)) return false;
    bool ok = panorama_lighting(&out->lighting, &panorama, in->light, err) &&
              write_image(in->place ? out->relief_map : out->sky_map, f, "panorama.exr", &panorama.radiance, err);
    *radius_m = panorama.radius_m;
    panorama_release(&panorama);
    if (!ok || !in->place) return ok;
    in->beyond_m = HIDDEN_PLACE_REACH_M;
    ok = panorama_create(&far, in, err) && write_image(out->sky_map, f, "far.exr", &far.radiance, err);
    panorama_release(&far);
    return ok;
}

/* How far away, level, stands what the photograph shows past the place: behind all of it, and so far off that it is no ground. A
 * new view shows nothing there. */
static double past_place(const struct frame *f, const struct seen *seen, struct vec3 low_m, struct vec3 high_m, struct vec3 from_m,
                         double ground_m)
{
    struct vec3 eye = f->shot->world_from_camera.translation;
    if (!f->photograph[0]) return 0;
    double east_m = fmax(from_m.x - low_m.x, high_m.x - from_m.x), north_m = fmax(from_m.y - low_m.y, high_m.y - from_m.y);
    double past_m = fmax(hypot(east_m, north_m), ROOM * hypot(eye.x - from_m.x, eye.y - from_m.y));
    return PAST_PLACE * fmax(past_m, seen_ground_reach(seen, eye.z - ground_m));
}

/* A measured sky has what stands round it. */
static bool write_sky(struct pass_surroundings *out, const double color_gain[3], const struct frame *f, const struct seen *seen,
                      struct error *err)
{
    out->seen_from_m = among_entities(f);
    if (f->scene->sky == SKY_MAP) return true;
    struct vec3 from = out->seen_from_m, eye = f->shot->world_from_camera.translation;
    double ground = f->stage->mesh ? from.z - look_round_m(f) : plane_height(&f->scene->ground, eye.x, eye.y);
    struct panorama_input in = {
        .seen = seen, .light = f->context->light, .from_m = from, .height_m = eye.z - ground,
        .told = !f->scene->skyline.assumed, .place = f->stage->mesh,
        .place_depth = &f->labels.place_depth, .color_gain = { color_gain[0], color_gain[1], color_gain[2] },
    };
    out->circle_m = vec3(eye.x, eye.y, ground);
    if (in.place) {
        struct vec3 low, high;
        static_mesh_bounds(in.place, &low, &high);
        in.past_m = past_place(f, seen, low, high, from, ground);
        out->circle_m = vec3(from.x, from.y, fmin(ground, low.z));
    }
    double radius = 0;
    if (!write_panorama(out, &radius, f, &in, err)) return false;
    out->circle_radius_m = in.place ? in.past_m : radius > 0 ? circle_radius(f, radius) : 0;
    return true;
}

/* Over a place, what the panorama shows stands where it stands. */
static bool write_relief(struct pass_surroundings *out, const double color_gain[3], const struct frame *f, struct error *err)
{
    if (!f->stage->mesh) return true;
    struct prism *known = calloc(f->around.n + 1, sizeof *known); /* borrowed */
    struct entity *entities = calloc(f->moment.n + 1, sizeof *entities);
    struct relief_input in = { .place = f->stage->mesh, .from_m = out->seen_from_m, .entities = entities, .known = known };
    for (size_t i = 0; known && entities && i < f->around.n; i++) {
        if (!f->matters[i]) continue;
        known[in.n] = f->around.receivers[i];
        entities[in.n++] = f->moment.entities[i];
    }
    struct relief relief = { 0 };
    struct hidden_place hidden = { 0 };
    char hidden_map[SURROUNDINGS_PATH_SIZE] = "", *path = string_format("%s/relief.inc", f->folder);
    bool ok = (known && entities && path) || error_set(err, ERR_MEMORY, "no memory for a frame"), mirrored = out->relief_map[0];
    ok = ok && relief_create(&relief, &in, err);
    /* A measured sky has what stands round it; only the ground is the place's then. */
    ok = ok && (!mirrored || (hidden_place_create(&hidden, &in, color_gain, err) && write_image(hidden_map, f, "hidden.exr", &hidden.radiance, err)));
    ok = ok && relief_include_write(path, &relief, mirrored ? &hidden : NULL, hidden_map, err);
    snprintf(out->relief_include, SURROUNDINGS_PATH_SIZE, "frames/%s/relief.inc", f->name);
    relief_release(&relief);
    hidden_place_release(&hidden);
    free(path);
    free(entities);
    free(known);
    return ok;
}

static bool write_standing(struct pass_surroundings *out, const struct frame *f, const struct seen *seen, struct error *err)
{
    size_t occluders = f->occluder_count;
    out->standing = calloc(occluders + 1, sizeof *out->standing);
    if (!out->standing) return error_set(err, ERR_MEMORY, "no memory for a frame");
    for (size_t i = 0; i < occluders; i++) {
        struct pass_standing *s = &out->standing[out->standing_count];
        char name[40];
        if (!standing_create(&s->thing, seen, &f->occluders[i], f->stage->mesh ? &f->labels.place_depth : NULL, err)) return false;
        if (!s->thing.count) continue;
        out->standing_count++;
        snprintf(name, sizeof name, "standing-%zu.exr", i);
        if (!write_image(s->radiance, f, name, &s->thing.radiance, err)) return false;
    }
    return true;
}

void frame_release_surroundings(struct pass_surroundings *surroundings)
{
    for (size_t i = 0; i < surroundings->standing_count; i++) standing_release(&surroundings->standing[i].thing);
    free(surroundings->standing);
    sun_share_release(&surroundings->sun_share);
    image_release(&surroundings->lighting);
    *surroundings = (struct pass_surroundings){ 0 };
}

bool frame_write_surroundings(struct pass_surroundings *surroundings, struct frame *f, const struct sky_sight *sight, struct error *err)
{
    struct pass_surroundings out = { 0 };
    double color_gain[3] = { 0, 0, 0 };
    struct image unhidden = { 0 };
    size_t n = f->occluder_count;
    if (!frame_read_picture(f, err) ||
        (n && !unhidden_create(&unhidden, f->occluders, n, f->picture.width_px, f->picture.height_px, err)))
        return false;
    struct seen seen = seen_of(f, n ? &unhidden : NULL);
    bool ok = write_sun_share(&out, f, &seen, err) && write_ground(&out, color_gain, f, &seen, sight, err) &&
              write_sky(&out, color_gain, f, &seen, err) && write_relief(&out, color_gain, f, err) && write_standing(&out, f, &seen, err);
    image_release(&unhidden);
    if (ok) *surroundings = out;
    else frame_release_surroundings(&out);
    return ok;
}
