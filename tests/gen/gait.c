/* Walkers by distance: what touches the ground stays where it is. */
#include "gen/motion/gait.h"

#include "gen/model/rig.h"
#include "tests/gen/model_files.h"
#include "tests/gen/tread.h"
#include "tests/gen/walker_files.h"

#define COUNT(a) (sizeof(a) / sizeof *(a))

static const char *const walkers[] = { "models/man-jacket-middle.glb", "models/woman-skirt-middle.glb" };

static struct model *load_walker(const char *name)
{
    return load(in_folder("top_builddir", name), &(struct model_options){ 0 });
}

/* Walk for two loops at a speed, a picture 1/50 s, and see how far any point goes over the ground while it is on it. */
static void walk(const struct model *model, const struct gait *gait, double speed_m_s, const char *name)
{
    struct error err = ERROR_NONE;
    struct tread tread = { 0 };
    int frames = (int)(2 * gait->stride_m / speed_m_s * 50);
    for (int f = 0; f < frames; f++) {
        double gone_m = speed_m_s * f / 50;
        struct model posed;
        if (!model_pose(&posed, model, &(struct posture){ .time_s = gait_time(gait, gone_m, 0.3) }, &err)) break;
        tread_add(&tread, &posed, &(struct pose){ mat3_identity(), vec3(gone_m, 0, 0) });
        model_posed_release(&posed);
    }
    OK(err.code == ERR_OK && frames > 40, "%s walks at %.1f m/s", name, speed_m_s);
    OK(tread.trodden == frames, "it always stands on a foot");
    OK(tread.slide_m < 0.03, "what is down stays within 3 cm (%.1f mm)", 1000 * tread.slide_m);
    tread_release(&tread);
}

static void walkers_keep_their_feet_still(void)
{
    static const double speeds[] = { 0.8, 1.35, 2.0 };
    for (size_t i = 0; i < COUNT(walkers); i++) {
        struct error err = ERROR_NONE;
        struct gait gait;
        struct model *m = load_walker(walkers[i]);
        if (!OK(m && gait_create(&gait, m, 0, NULL, &err), "%s has a gait", walkers[i])) continue;
        /* docs/cast.md: v^2 / (g leg) is 0.205; the leg 0.52 of a stature of 1.79 and 1.64 m, with shoes. */
        double leg_m = i ? 0.874 : 0.954;
        OK(gait.walks, "it walks");
        NEAR(gait.stride_m / gait.duration_s, sqrt(0.205 * 9.81 * leg_m), 0.06, "as fast as it was made for");
        for (size_t k = 0; k < COUNT(speeds); k++) walk(m, &gait, speeds[k], walkers[i]);
        gait_release(&gait);
        model_destroy(m);
    }
}

/* Ahead by 1.2 m a loop where the stride is longer, and 4 cm faster and slower within it. */
static void unsteady_roots_are_made_good(void)
{
    struct error err = ERROR_NONE;
    struct gait gait, steady;
    struct model *still = load_walker(walkers[0]);
    if (!OK(still && gait_create(&steady, still, 0, NULL, &err), "a walker on the spot has a gait")) return;
    double stride_m = steady.stride_m, quarter_m = steady.advance_m[steady.samples / 4];
    gait_release(&steady);
    model_destroy(still);
    struct model *m = load(put_going("unsteady.glb", walkers[0], 1.2, 0.04), &(struct model_options){ 0 });
    if (!OK(m && m->rig->animations[0].drift_m > 1.1 && gait_create(&gait, m, 0, NULL, &err), "a walker whose root goes ahead unsteadily has a gait")) return;
    NEAR(gait.stride_m, stride_m, 0.01, "of the same stride");
    NEAR(gait.advance_m[gait.samples / 4], quarter_m - 0.04, 0.015, "unsteady against the root's way");
    walk(m, &gait, 1.35, "unsteady.glb");
    gait_release(&gait);
    model_destroy(m);
}

static void distance_tells_the_time(void)
{
    struct error err = ERROR_NONE;
    struct gait gait;
    struct model *m = load_walker(walkers[0]);
    if (!OK(m && gait_create(&gait, m, 0, NULL, &err), "a walker has a gait")) return;
    double loop_s = gait.duration_s;
    bool ascending = gait.advance_m[0] == 0 && gait.advance_m[gait.samples] == gait.stride_m;
    for (int i = 0; i < gait.samples; i++) ascending = ascending && gait.advance_m[i + 1] >= gait.advance_m[i];
    OK(ascending, "the way ascends from 0 to the stride");
    OK(gait_time(&gait, 0, 0) == 0, "at phase 0 the walk begins as the animation does");
    NEAR(gait_time(&gait, gait.stride_m / 2, 0), 0.5 * loop_s, 0.02, "half a stride is half a loop: the steps are alike");
    NEAR(gait_time(&gait, 0.31 + 7 * gait.stride_m, 0.2), gait_time(&gait, 0.31, 0.2), 1e-9, "the loop closes");
    NEAR(gait_time(&gait, gait.stride_m - 1e-9, 0), loop_s, 1e-6, "at its end it is at the animation's end");
    NEAR(gait_time(&gait, 0, 0.25), 0.25 * loop_s, 1e-9, "a phase is a part of the loop");
    OK(fabs(gait_time(&gait, 1, 0.1) - gait_time(&gait, 1, 0.6)) > 0.4, "two who are out of step stay so");
    NEAR(gait_time(&gait, 0.4, 1.25), gait_time(&gait, 0.4, 0.25), 1e-9, "phases beyond 1 begin again");
    double gap = 0, back = 0, last = gait_time(&gait, 0, 0);
    for (int i = 1; i < 400; i++) {
        double now = gait_time(&gait, gait.stride_m * i / 400, 0);
        gap = fmax(gap, now - last);
        back = fmin(back, now - last);
        last = now;
    }
    OK(gap < 0.005 && back == 0, "time goes on steadily with the way");
    gait_release(&gait);
    model_destroy(m);
}

static void who_stands_stands(void)
{
    /* A tetrahedron that nods: its foot at the origin stays. Rotations about y at 0, 1 and 2 s. */
    struct bytes b = { .size = 0 };
    add_floats(&b, (float[]){ 0, 0, 0, 0.1f, 0, 0, 0, 0.1f, 0, 0, 0, 1.5f }, 12);
    memcpy(b.data + b.size, (uint8_t[]){ 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3 }, 12);
    b.size += 12;
    add_floats(&b, (float[]){ 0, 1, 2 }, 3);
    add_floats(&b, (float[]){ 0, 0, 0, 1, 0, 0.001f, 0, 1, 0, 0, 0, 1 }, 12);
    static const char file[] =
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":48},{\"buffer\":0,\"byteOffset\":48,\"byteLength\":12},{\"buffer\":0,\"byteOffset\":60,\"byteLength\":12},{\"buffer\":0,\"byteOffset\":72,\"byteLength\":48}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},{\"bufferView\":1,\"componentType\":5121,\"count\":12,\"type\":\"SCALAR\"},"
        "{\"bufferView\":2,\"componentType\":5126,\"count\":3,\"type\":\"SCALAR\"},{\"bufferView\":3,\"componentType\":5126,\"count\":3,\"type\":\"VEC4\"}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}],\"nodes\":[{\"mesh\":0}],"
        "\"animations\":[{\"channels\":[{\"sampler\":0,\"target\":{\"node\":0,\"path\":\"rotation\"}}],\"samplers\":[{\"input\":2,\"output\":3}]}]";
    struct error err = ERROR_NONE;
    struct gait gait;
    struct model *m = load(put_gltf("nod.gltf", &b, file), &as_in_file);
    if (OK(m && gait_create(&gait, m, 0, NULL, &err), "somebody who nods has a gait")) {
        OK(!gait.walks && gait.duration_s == 2, "but does not walk");
        NEAR(gait_time(&gait, 5, 0.25), 0.5, 1e-12, "so that distance does not move it");
        gait_release(&gait);
    }
    model_destroy(m);
    m = load(put_text("still.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), &metres_z_up);
    OK(m && !gait_create(&gait, m, 0, NULL, &err) && err.code == ERR_INPUT && !strcmp(path_name(err.file), "still.obj") && !strcmp(err.text, "has no animation: it cannot walk"), "refuses a model without animation");
    model_destroy(m);
}

static void wrong_fronts_are_refused(void)
{
    struct error err = ERROR_NONE;
    struct gait gait;
    struct model *m = load(in_folder("top_builddir", walkers[0]), &(struct model_options){ .axes_given = true, .up = AXIS_POS_Y, .front = AXIS_NEG_Z });
    OK(m && !gait_create(&gait, m, 0, NULL, &err) && err.code == ERR_INPUT && !strncmp(err.text, "walks backwards, 1.4", 20) && strstr(err.text, " m in a loop: the opposite front axis would be right"), "refuses who walks backwards, and says why");
    if (err.code != ERR_OK) printf("# %s\n", err.text);
    model_destroy(m);
}

int main(void)
{
    if (!mkdtemp(folder)) return 1;
    walkers_keep_their_feet_still();
    unsteady_roots_are_made_good();
    distance_tells_the_time();
    who_stands_stands();
    wrong_fronts_are_refused();
    remove_tree(folder);
    return tap_done();
}
