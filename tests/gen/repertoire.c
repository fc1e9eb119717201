/* Which animation suits whom: by its name and the speed. */
#include "gen/motion/repertoire.h"

#include "tests/gen/model_files.h"
#include "tests/gen/walker_files.h"

static const char *name_of(const struct model *m, size_t animation) { return m->rig->animations[animation].name; }

static void speeds_choose(const char *person, double slow_m_s, double walk_m_s, double run_m_s)
{
    struct error err = ERROR_NONE;
    struct repertoire r;
    char path[100];
    snprintf(path, sizeof path, "models/%s.glb", person);
    struct model *m = load(in_folder("top_builddir", path), &(struct model_options){ 0 });
    if (!OK(m && repertoire_create(&r, m, &err), "%s has a repertoire %s", person, err.text)) return;
    const struct { double speed_m_s; const char *animation; } known[] = { { slow_m_s, "slow_walk" }, { walk_m_s, "walk" }, { -walk_m_s, "walk" }, { run_m_s, "run" } };
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        struct pace_now now = { .speed_m_s = known[i].speed_m_s, .wish_m_s = known[i].speed_m_s, .distance_m = 0.3 };
        struct posture p = repertoire_posture(&r, &now, pace_stands(&now));
        OK(p.share == 0 && !strcmp(name_of(m, p.animation), known[i].animation), "%s at %.2f m/s: %s", person, known[i].speed_m_s, known[i].animation);
        now.speed_m_s *= 0.6; /* held up by others */
        p = repertoire_posture(&r, &now, pace_stands(&now));
        OK(!strcmp(name_of(m, p.animation), known[i].animation), "slower for a while, the same");
    }
    struct pace_now stands = { .phase = 0.25, .time_s = 2 };
    struct posture p = repertoire_posture(&r, &stands, pace_stands(&stands));
    double loop_s = r.gait[PACE_STAND].duration_s;
    OK(p.share == 0 && !strcmp(name_of(m, p.animation), "stand"), "who stands stands");
    NEAR(p.time_s, 0.25 * loop_s + 2, 1e-9, "time runs by itself, from the phase on");

    /* To a halt: nothing jumps, from walking to standing. */
    struct pace_now now;
    double largest = 0, last = 0;
    for (int i = 0; i <= 200; i++) {
        now = (struct pace_now){ .speed_m_s = walk_m_s * (200 - i) / 200, .wish_m_s = walk_m_s };
        p = repertoire_posture(&r, &now, pace_stands(&now));
        if (i == 0) OK(p.share == 0, "on its way it walks");
        largest = fmax(largest, fabs(p.share - last));
        last = p.share;
    }
    OK(last == 1 && !strcmp(name_of(m, p.to), "stand") && largest < 0.05, "at a halt it stands, and passed over into that smoothly");
    repertoire_release(&r);
    model_destroy(m);
}

static void nameless_serve_all(void)
{
    struct error err = ERROR_NONE;
    struct repertoire r;
    struct model *m = load(in_folder("top_srcdir", "tests/input/skinned.gltf"), &(struct model_options){ 0 });
    if (!OK(m && m->rig->animation_count == 1 && repertoire_create(&r, m, &err), "a file of one animation of another name %s", err.text)) return;
    for (int i = 0; i < 4; i++) {
        struct pace_now now = { .speed_m_s = i, .wish_m_s = i, .distance_m = i };
        struct posture p = repertoire_posture(&r, &now, pace_stands(&now));
        OK(p.animation == 0 && p.share == 0, "it does the same at %d m/s", i);
    }
    repertoire_release(&r);
    model_destroy(m);
}

static void postures_blend(void)
{
    struct error err = ERROR_NONE;
    struct model *m = load(in_folder("top_builddir", "models/woman-skirt.glb"), &(struct model_options){ 0 }), at[3];
    if (!OK(m && m->rig->animation_count == 5, "a person of five animations")) return;
    const struct posture postures[] = { { .time_s = 0.4 }, { .time_s = 0.4, .to = 3, .to_time_s = 1, .share = 1 }, { .animation = 3, .time_s = 1 } };
    for (int i = 0; i < 3; i++)
        if (!OK(model_pose(&at[i], m, &postures[i], &err), "posture %d", i)) return;
    double whole = 0, other = 0;
    for (size_t i = 0; i < m->mesh_count; i++)
        for (size_t v = 0; v < m->meshes[i].vertices; v++)
            for (int k = 0; k < 3; k++) {
                whole = fmax(whole, fabs((double)(at[1].meshes[i].position_m[v][k] - at[2].meshes[i].position_m[v][k])));
                other = fmax(other, fabs((double)(at[0].meshes[i].position_m[v][k] - at[2].meshes[i].position_m[v][k])));
            }
    NEAR(whole, 0, 1e-5, "all of the way to another posture is that posture");
    OK(other > 0.1, "which is another one");
    for (int i = 0; i < 3; i++) model_posed_release(&at[i]);
    model_destroy(m);
}

int main(void)
{
    if (!mkdtemp(folder)) return 1;
    /* A child of six walks and runs from lower speeds on: as sqrt(leg length). */
    speeds_choose("man-jacket", 0.8, 1.4, 2.5);
    speeds_choose("boy-6", 0.6, 1.2, 2.0);
    nameless_serve_all();
    postures_blend();
    remove_tree(folder);
    return tap_done();
}
