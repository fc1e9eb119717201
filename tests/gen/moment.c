/* Who is where at a moment: entities on a path and traffic, on a plane, as a scene file has them. */
#include "gen/moment.h"

#include "tests/gen/model_files.h"
#include "tests/gen/tread.h"
#include "tests/gen/walker_files.h"
#include "tests/tap.h"

#define WALKER_FILE "models/man-jacket-far.glb"

static const char scene_text[] =
    "staffage: 1\n"
    "photographs: {files: [a.png, a.png, a.png], rate_hz: 0.5}\n"
    "camera: {model: PINHOLE, size_px: [2, 2], horizontal_fov_deg: 60, pose: {look_at: {position_m: [0, -30, 20], target_m: [0, 0, 0]}}}\n"
    "time: 2022-06-01T15:00:00Z\n"
    "light: {sky: overcast}\n"
    "ground: {height_m: 2}\n"
    "exposure: {value: 1}\n"
    "seed: 5\n"
    "paths:\n"
    "  - {name: diagonal, use: vehicles, width_m: 6, points_m: [[0, 0], [60, 80]]}\n"
    "  - {name: walk, use: people, width_m: 3, points_m: [[100, 0], [100, 90]]}\n"
    "models:\n"
    "  box: {file: box.obj, unit_m: 1, up: z, front: x, class: car}\n"
    "  man: {file: man.glb, class: person}\n"
    "entities:\n"
    "  - {name: car, model: box, path: diagonal, start_m: 10, offset_m: 2, speed_m_s: 5}\n"
    "  - {name: reversing, model: box, path: diagonal, start_m: 80, offset_m: -2, speed_m_s: -3}\n"
    "  - {name: walker, model: man, path: walk, start_m: 5, speed_m_s: 1.4}\n"
    "  - {name: other way, model: man, path: walk, start_m: 40, speed_m_s: -1.4}\n"
    "  - {name: setting out, model: man, path: walk, start_m: 91.4, speed_m_s: -1.4, offset_m: 1}\n"
    "  - {name: parked, model: box, at: {world_m: [-20, 5]}, heading_deg: 90, parked: true}\n"
    "traffic:\n"
    "  vehicles: {count: 2, models: {box: {}}, colors: [\"#ff0000\", \"#00ff00\", \"#0000ff\"]}\n"
    "  people: {count: 3, models: {man: {}}}\n";
enum { CAR, REVERSING, WALKER, OTHER_WAY, SETTING_OUT, PARKED, GIVEN };

static const char *copied(const char *name, const char *variable, const char *from)
{
    struct error err = ERROR_NONE;
    const char *top = getenv(variable);
    char *path = string_format("%s/%s", top ? top : ".", from), *data;
    size_t size;
    const char *made = "";
    if (file_read(&data, &size, path, &err)) {
        made = put(name, data, size);
        free(data);
    }
    free(path);
    return made;
}

static struct moment at(const struct stage *stage, double time_s)
{
    struct error err = ERROR_NONE;
    struct moment moment = { 0 };
    if (!moment_at(&moment, stage, time_s, &err)) printf("# %s\n", err.text);
    return moment;
}

/* How far the vertices of two models are apart at most, from their own origins. */
static double apart(const struct model *a, const struct model *b)
{
    double most = 0;
    for (size_t m = 0; m < a->mesh_count; m++)
        for (size_t i = 0; i < a->meshes[m].vertices; i++)
            for (int k = 0; k < 3; k++)
                most = fmax(most, fabs((double)(a->meshes[m].position_m[i][k] - b->meshes[m].position_m[i][k])));
    return most;
}

static void check_place(const struct entity *e, double x, double y, double heading_x, double heading_y, const char *what)
{
    struct vec3 p = e->world_from_entity.translation, front = mat3_column(e->world_from_entity.rotation, 0);
    NEAR(hypot(p.x - x, p.y - y), 0, 0.01, "%s: where it should be (%.2f, %.2f)", what, p.x, p.y);
    NEAR(p.z, 2, 1e-9, "%s: on the ground", what);
    NEAR(hypot(front.x - heading_x, front.y - heading_y), 0, 1e-3, "%s: faces where it goes", what);
}

static void check_paths(const struct stage *stage)
{
    struct moment m = at(stage, 4);
    if (!OK(m.n >= GIVEN, "those of the scene are there")) return;
    /* The diagonal runs along (0.6, 0.8), its left is (-0.8, 0.6). */
    check_place(&m.entities[CAR], 0.6 * 30 - 0.8 * 2, 0.8 * 30 + 0.6 * 2, 0.6, 0.8, "10 m and 4 s of 5 m/s along, 2 m left");
    check_place(&m.entities[REVERSING], 0.6 * 68 + 0.8 * 2, 0.8 * 68 - 0.6 * 2, -0.6, -0.8, "3 m/s backward, 2 m right");
    check_place(&m.entities[WALKER], 100, 5 + 5.6, 0, 1, "walker");
    check_place(&m.entities[OTHER_WAY], 100, 40 - 5.6, 0, -1, "walker the other way");
    check_place(&m.entities[PARKED], -20, 5, 1, 0, "parked");
    moment_release(&m);
}

static void check_velocities(const struct stage *stage)
{
    const double step = 0.02;
    struct moment before = at(stage, 2 - step), now = at(stage, 2), after = at(stage, 2 + step);
    double worst = 0;
    size_t moving = 0;
    OK(before.n == now.n && after.n == now.n, "nobody comes or goes within a moment");
    for (size_t i = 0; i < now.n && before.n == now.n && after.n == now.n; i++) {
        struct vec3 a = before.entities[i].world_from_entity.translation, b = after.entities[i].world_from_entity.translation;
        struct vec3 measured = vec3_scale(vec3_sub(b, a), 1 / (2 * step));
        worst = fmax(worst, vec3_norm(vec3_sub(measured, now.velocity_m_s[i])));
        moving += vec3_norm(measured) > 0.5;
    }
    OK(moving >= 6, "most of them move (%zu of %zu)", moving, now.n);
    NEAR(worst, 0, 0.15, "each one's velocity is how fast and where to it moves, m/s");
    moment_release(&before);
    moment_release(&now);
    moment_release(&after);
}

static void check_ids(const struct stage *stage)
{
    struct moment first = at(stage, 0), last = at(stage, 4);
    bool given = true, ascending = true, same = true, own_colors = true;
    size_t both = 0;
    for (size_t i = 0; i < last.n; i++) {
        given = given && (i >= GIVEN || last.entities[i].id == i + 1);
        ascending = ascending && (i == 0 || last.entities[i].id > last.entities[i - 1].id);
        for (size_t k = GIVEN; k < first.n; k++) {
            if (i < GIVEN || first.entities[k].id != last.entities[i].id) continue;
            const struct entity *a = &first.entities[k], *b = &last.entities[i];
            both++;
            same = same && first.model_index[k] == last.model_index[i] && !strcmp(a->name, b->name) && a->has_color == b->has_color &&
                   !memcmp(a->color, b->color, sizeof a->color);
        }
        own_colors = own_colors && (i < GIVEN || last.entities[i].has_color == (last.entities[i].class_ == CLASS_CAR));
    }
    OK(given, "those of the scene have the ids 1, 2, 3 ... in its order");
    OK(ascending && last.n == GIVEN + 5, "traffic comes after them, no id twice");
    OK(both >= 3 && same, "who stays keeps id, name, model and colour (%zu)", both);
    OK(own_colors, "vehicles are painted, people are not");
    moment_release(&first);
    moment_release(&last);
}

/* Walks are played by the way that was gone, whichever way time runs. */
static void check_gait(const struct stage *stage)
{
    struct moment now = at(stage, 1);
    if (!OK(now.n >= GIVEN && now.posed_count >= 2, "walkers are posed")) return;
    const struct gait *gait = &stage->repertoires[now.model_index[WALKER]].gait[PACE_WALK];
    double loop_s = gait->stride_m / 1.4;
    struct moment later = at(stage, 1 + loop_s), half = at(stage, 1 + loop_s / 2), before = at(stage, 1 - 2 * loop_s);
    NEAR(apart(now.entities[WALKER].model, later.entities[WALKER].model), 0, 1e-4, "a stride later the same pose");
    OK(apart(now.entities[WALKER].model, half.entities[WALKER].model) > 0.1, "half a stride later another");
    NEAR(apart(now.entities[WALKER].model, before.entities[WALKER].model), 0, 1e-4, "before the scene's time the walk runs on, not back");
    size_t steps = 0, people = 0;
    for (size_t i = GIVEN; i < now.n; i++) {
        if (now.entities[i].class_ != CLASS_PERSON) continue;
        people++;
        steps += apart(now.entities[i].model, now.entities[WALKER].model) > 0.02;
    }
    OK(people == 3 && steps >= 2, "people of the traffic are out of step (%zu of %zu)", steps, people);
    moment_release(&now);
    moment_release(&later);
    moment_release(&half);
    moment_release(&before);
}

/* Over a time, in pictures 1/50 s apart. The scene's ground is at 2 m. */
static struct tread tread_of(const struct stage *stage, size_t who, double from_s, double to_s)
{
    struct tread tread = { 0 };
    for (double time_s = from_s; time_s < to_s; time_s += 0.02) {
        struct moment m = at(stage, time_s);
        struct pose pose = m.entities[who].world_from_entity;
        pose.translation.z -= 2;
        tread_add(&tread, m.entities[who].model, &pose);
        moment_release(&m);
    }
    return tread;
}

/* The walker the other way has 40 m to the end of the path; who sets out is to come from 1.4 m beyond the other end. */
static void check_halts(const struct stage *stage)
{
    const struct { size_t who; double moves_s, stands_s, from_s, to_s, end_y; const char *what; } known[] = {
        { OTHER_WAY, 27, 30, 27.2, 29.8, 0, "who comes to the end of his path" }, { SETTING_OUT, 3.2, 0.6, 0.6, 3.2, 90, "who sets out" }
    };
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        struct tread t = tread_of(stage, known[i].who, known[i].from_s, known[i].to_s);
        OK(t.slide_m < 0.03 && t.sunk_m < 0.02, "%s: his feet slide %.0f mm, sink %.0f mm in at most", known[i].what, 1000 * t.slide_m, 1000 * t.sunk_m);
        /* A foot that swings goes at four to five times his speed at most. */
        OK(t.jump_m < 5 * 1.4 * 0.02, "%s: no point of him goes more than %.0f mm in 1/50 s", known[i].what, 1000 * t.jump_m);
        tread_release(&t);
        struct moment moves = at(stage, known[i].moves_s), stands = at(stage, known[i].stands_s), later = at(stage, known[i].stands_s - 0.02);
        NEAR(vec3_norm(moves.velocity_m_s[known[i].who]), 1.4, 1e-9, "%s: at his speed on the way", known[i].what);
        struct vec3 p = stands.entities[known[i].who].world_from_entity.translation, q = later.entities[known[i].who].world_from_entity.translation;
        OK(vec3_norm(stands.velocity_m_s[known[i].who]) == 0 && vec3_norm(vec3_sub(p, q)) == 0, "%s: stands", known[i].what);
        NEAR(p.y, known[i].end_y, 0.1, "%s: at the end of the path", known[i].what);
        moment_release(&moves);
        moment_release(&stands);
        moment_release(&later);
    }
}

/* The walker is 5 m from where the path begins, and long before he was there. */
static void check_wait(const struct stage *stage)
{
    struct moment m = at(stage, -20);
    double least = INFINITY;
    for (double time_s = 40; time_s < 50; time_s += 0.25) { /* who stands shifts his weight about */
        struct moment stood = at(stage, time_s);
        least = fmin(least, apart(m.entities[WALKER].model, stood.entities[OTHER_WAY].model));
        moment_release(&stood);
    }
    check_place(&m.entities[WALKER], 100, 0, 0, 1, "before he sets out");
    NEAR(vec3_norm(m.velocity_m_s[WALKER]), 0, 0, "he does not move");
    NEAR(least, 0, 0.03, "and stands, as who has come to an end, not in mid-step");
    moment_release(&m);
}

static void check_parked(const struct stage *stage)
{
    bool said = stage->warning_count == 1;
    OK(said && strstr(stage->warnings[0], "scene.yaml:21:5: entity \"parked\" is parked, but ") && strstr(stage->warnings[0], "box.obj has no driver"),
       "it is said that nobody can be left out of who is parked: %s", said ? stage->warnings[0] : "");
}

/* The animation's own figures are part of what a frame depends on. */
static void check_hash(const struct stage *stage, const struct scene *scene, const struct material_rules *rules)
{
    struct error err = ERROR_NONE;
    struct stage *other = NULL;
    put_going("man.glb", WALKER_FILE, 0, 0.01);
    OK(stage_create(&other, scene, rules, &err) && other->hash != stage->hash, "an animation that changes is noticed %s", err.text);
    stage_destroy(other);
}

int main(void)
{
    struct error err = ERROR_NONE;
    struct scene *scene = NULL;
    struct material_rules *rules = NULL;
    struct stage *stage = NULL;
    char path[600], *rules_path = string_format("%s/templates/materials.rules", getenv("top_srcdir") ? getenv("top_srcdir") : ".");
    if (!OK(mkdtemp(folder) != NULL, "a folder")) return tap_done();
    put_image("a.png", 90, 90, 90);
    copied("box.obj", "top_srcdir", "tests/input/box.obj");
    copied("man.glb", "top_builddir", WALKER_FILE);
    snprintf(path, sizeof path, "%s", put_text("scene.yaml", scene_text));
    bool ok = scene_read(&scene, path, NULL, &err) && material_rules_read(&rules, rules_path, &err) && stage_create(&stage, scene, rules, &err);
    if (OK(ok, "a stage %s:%d %s", err.file, err.line, err.text)) {
        check_paths(stage);
        check_velocities(stage);
        check_ids(stage);
        check_gait(stage);
        check_halts(stage);
        check_wait(stage);
        check_parked(stage);
        check_hash(stage, scene, rules);
    }
    stage_destroy(stage);
    material_rules_destroy(rules);
    scene_destroy(scene);
    free(rules_path);
    remove_tree(folder);
    return tap_done();
}
