/* Skins and animations: against an independent reading, by hand, and what is refused. */
#include "gen/model/rig.h"

#include "tests/gen/model_files.h"
#include "tests/gen/rig_table.h"
#include "tests/gen/walker_files.h"

#define COUNT(a) (sizeof(a) / sizeof *(a))

/* Where one of the file's vertices is. */
static const float *find_vertex(const struct model *shape, const struct model *model, size_t mesh, size_t source)
{
    for (size_t v = 0; mesh < model->mesh_count && v < model->meshes[mesh].vertices; v++)
        if (model->meshes[mesh].source[v] == source) return shape->meshes[mesh].position_m[v];
    return NULL;
}

/* In the file's own coordinates: what a rig gives that does not stand as an entity. */
static void awkward_features_agree(void)
{
    struct model *m = load(in_folder("top_srcdir", "tests/input/skinned.gltf"), &(struct model_options){ 0 });
    if (!OK(m && m->rig && m->mesh_count == 2 && m->rig->skin_count == 2 && m->rig->animations[0].duration_s == 2, "a file of two skins is loaded with its rig")) return;
    struct error err = ERROR_NONE;
    double worst = 0;
    m->rig->entity_from_file = affine_identity;
    m->rig->animations[0].drift_m = 0;
    for (size_t i = 0; i < COUNT(skinned); i++) {
        const struct known *k = &skinned[i];
        if (!rig_pose(m->meshes, m->rig, &(struct posture){ .time_s = k->time_s }, &err)) break;
        for (int c = 0; c < 3; c++) worst = fmax(worst, fabs((double)m->meshes[k->mesh].position_m[k->vertex][c] - k->p[c]));
    }
    OK(err.code == ERR_OK, "it can be posed");
    printf("# worst %.2g m\n", worst);
    NEAR(worst, 0, 1e-4, "STEP, LINEAR and CUBICSPLINE, 16 bit joints, normalized weights and rotations, scaled and mirrored joints, a late first key: as three.js has it");
    model_destroy(m);
}

/* By way of the whole model: +z of the file is ahead, +x left, +y up; what it was moved by shows at time 0. */
static void walker_agrees(const char *name, size_t animation, const struct known *known, size_t count)
{
    struct model *m = load(in_folder("top_builddir", name), &(struct model_options){ 0 });
    if (!OK(m && m->rig, "%s is loaded with its rig", name)) return;
    struct error err = ERROR_NONE;
    double worst = 0, shift[3] = { 0 };
    for (size_t i = 0; i < count; i++) {
        struct model posed;
        if (!model_pose(&posed, m, &(struct posture){ .animation = animation, .time_s = known[i].time_s }, &err)) break;
        const float *got = find_vertex(&posed, m, known[i].mesh, known[i].vertex);
        const double want[3] = { known[i].p[2], known[i].p[0], known[i].p[1] };
        for (int c = 0; got && c < 3; c++) {
            if (i == 0) shift[c] = (double)got[c] - want[c];
            worst = fmax(worst, fabs((double)got[c] - want[c] - shift[c]));
        }
        if (!got) worst = INFINITY;
        model_posed_release(&posed);
    }
    OK(err.code == ERR_OK && shift[0] != 0, "and posed");
    printf("# worst %.2g m\n", worst);
    NEAR(worst, 0, 1e-4, "its vertices are where three.js has them, at any time from the same origin");
    model_destroy(m);
}

static double largest_difference(const struct model *a, const struct model *b, double factor)
{
    double worst = 0;
    for (size_t i = 0; i < a->mesh_count; i++)
        for (size_t v = 0; v < a->meshes[i].vertices; v++)
            for (int c = 0; c < 3; c++) {
                worst = fmax(worst, fabs(factor * (double)a->meshes[i].position_m[v][c] - (double)b->meshes[i].position_m[v][c]));
                worst = fmax(worst, fabs((double)a->meshes[i].normal[v][c] - (double)b->meshes[i].normal[v][c]));
            }
    return worst;
}

static void poses_are_the_loaded_models(void)
{
    const char *path = in_folder("top_builddir", "models/man-jacket-far.glb");
    struct error err = ERROR_NONE;
    struct model *m = load(path, &(struct model_options){ 0 }), *twice = load(path, &(struct model_options){ .unit_m = 2 });
    struct model at[4], large;
    if (!m || !twice) return;
    double loop_s = m->rig->animations[0].duration_s;
    const double times[] = { 0, 0.37, 0.37 + 5 * loop_s, 0.37 - loop_s };
    for (int i = 0; i < 4; i++)
        if (!OK(model_pose(&at[i], m, &(struct posture){ .time_s = times[i] }, &err), "the walker is posed at %g s", times[i])) return;
    NEAR(largest_difference(&at[0], m, 1), 0, 1e-5, "at time 0 it is as it was loaded");
    OK(largest_difference(&at[1], m, 1) > 0.05, "at another time it is not");
    NEAR(largest_difference(&at[1], &at[2], 1), 0, 1e-5, "time loops");
    NEAR(largest_difference(&at[1], &at[3], 1), 0, 1e-5, "backwards as well");
    double top = 0;
    for (size_t i = 0; i < m->mesh_count; i++)
        for (size_t v = 0; v < m->meshes[i].vertices; v++) top = fmax(top, (double)at[1].meshes[i].position_m[v][2]);
    OK(at[1].max_m.z == top && at[1].max_m.z > m->max_m.z + 0.005, "the box is the pose's");
    OK(at[1].meshes[0].triangle == m->meshes[0].triangle && at[1].materials == m->materials && !at[1].rig, "what does not move is borrowed");
    if (OK(model_pose(&large, twice, &(struct posture){ .time_s = 0.37 }, &err), "a model of another unit is posed")) {
        NEAR(largest_difference(&at[1], &large, 2), 0, 1e-5, "in its unit, from the same origin");
        model_posed_release(&large);
    }
    size_t outward = 0, all = 0;
    for (size_t i = 0; i < at[1].mesh_count; i++)
        for (size_t t = 0; t < at[1].meshes[i].triangles; t++) {
            const struct mesh *mesh = &at[1].meshes[i];
            struct vec3 p[3], n[3];
            for (int k = 0; k < 3; k++) {
                const float *v = mesh->position_m[mesh->triangle[t][k]], *w = mesh->normal[mesh->triangle[t][k]];
                p[k] = vec3((double)v[0], (double)v[1], (double)v[2]);
                n[k] = vec3((double)w[0], (double)w[1], (double)w[2]);
            }
            struct vec3 face = vec3_cross(vec3_sub(p[1], p[0]), vec3_sub(p[2], p[0]));
            all += 3;
            for (int k = 0; k < 3; k++) outward += vec3_dot(face, n[k]) > 0 && fabs(vec3_norm(n[k]) - 1) < 1e-5;
        }
    OK((double)outward > 0.97 * (double)all, "normals are turned with the skin: %zu of %zu look outward", outward, all);
    for (int i = 0; i < 4; i++) model_posed_release(&at[i]);
    model_destroy(m);
    model_destroy(twice);
    err = ERROR_NONE;
    m = load(put_text("still.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), &metres_z_up);
    OK(m && !m->rig && !model_pose(&large, m, &(struct posture){ .time_s = 0 }, &err) && err.code == ERR_INPUT && strstr(err.text, "has no animation"), "a model without animation has no rig and cannot be posed");
    model_destroy(m);
}

static void root_motion_is_taken_out(void)
{
    struct error err = ERROR_NONE;
    const char *walker = "models/woman-skirt-far.glb";
    struct model *still = load(in_folder("top_builddir", walker), &(struct model_options){ 0 });
    struct model *going = load(put_going("going.glb", walker, 1.3, 0), &(struct model_options){ 0 });
    struct model a, b;
    if (OK(still && going && model_pose(&a, still, &(struct posture){ .time_s = 0.6 }, &err) && model_pose(&b, going, &(struct posture){ .time_s = 0.6 }, &err), "one walks on the spot, one ahead")) {
        NEAR(going->rig->animations[0].drift_m, 1.3, 1e-4, "what the root goes in a loop is found");
        NEAR(largest_difference(&a, &b, 1), 0, 1e-5, "and taken out: both walk on the spot");
        OK(still->rig->animations[0].drift_m == 0, "who walks on the spot goes nowhere");
        model_posed_release(&a);
        model_posed_release(&b);
    }
    model_destroy(still);
    model_destroy(going);
}

/* --- by hand --- */

/* Two joints: the first stays; the second is turned 90 degrees about x at (0,0,2), having been bound
 * at (0,0,1). The corners follow the first, the second, and both by half. */
static struct bytes skin_bytes(void)
{
    struct bytes b = { .size = 0 };
    add_floats(&b, (float[]){ 0, 0, 0, 1, 0, 3, 1, 0, 3 }, 9);          /* positions at 0 */
    add_floats(&b, (float[]){ 0, 0, 1, 0, 0, 1, 0, 0, 1 }, 9);          /* normals at 36 */
    memcpy(b.data + b.size, (uint8_t[]){ 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0 }, 12); /* joints at 72 */
    b.size += 12;
    add_floats(&b, (float[]){ 1, 0, 0, 0, 1, 0, 0, 0, 0.5f, 0.5f, 0, 0 }, 12); /* weights at 84 */
    add_floats(&b, (float[]){ 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -1, 1 }, 32); /* inverse bind at 132 */
    add_floats(&b, (float[]){ 0, 1 }, 2);                                /* key times at 260 */
    add_floats(&b, (float[]){ 0.70710678f, 0, 0, 0.70710678f, 0, 0, 0, 1 }, 8); /* rotations at 268 */
    return b;
}

#define SKIN_START \
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36},{\"buffer\":0,\"byteOffset\":36,\"byteLength\":36},{\"buffer\":0,\"byteOffset\":72,\"byteLength\":12}," \
    "{\"buffer\":0,\"byteOffset\":84,\"byteLength\":48},{\"buffer\":0,\"byteOffset\":132,\"byteLength\":128},{\"buffer\":0,\"byteOffset\":260,\"byteLength\":8},{\"buffer\":0,\"byteOffset\":268,\"byteLength\":32}]," \
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},{\"bufferView\":1,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}," \
    "{\"bufferView\":2,\"componentType\":5121,\"count\":3,\"type\":\"VEC4\"},{\"bufferView\":3,\"componentType\":5126,\"count\":3,\"type\":\"VEC4\"},{\"bufferView\":4,\"componentType\":5126,\"count\":2,\"type\":\"MAT4\"}," \
    "{\"bufferView\":5,\"componentType\":5126,\"count\":2,\"type\":\"SCALAR\"},{\"bufferView\":6,\"componentType\":5126,\"count\":2,\"type\":\"VEC4\"}]," \
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1,\"JOINTS_0\":2,\"WEIGHTS_0\":3}}]}],"
#define SKIN_END "\"skins\":[{\"joints\":[1,2],\"inverseBindMatrices\":4}],\"scenes\":[{\"nodes\":[0,1]}],\"scene\":0"
static const char still_nodes[] = "\"nodes\":[{\"mesh\":0,\"skin\":0,\"scale\":[100,100,100]},{\"children\":[2]},{\"translation\":[0,0,2],\"rotation\":[0.70710678,0,0,0.70710678]}],";
static const char moving_nodes[] = "\"nodes\":[{\"mesh\":0,\"skin\":0},{\"children\":[2]},{\"translation\":[0,0,2]}],"
                                   "\"animations\":[{\"channels\":[{\"sampler\":0,\"target\":{\"node\":2,\"path\":\"rotation\"}}],\"samplers\":[{\"input\":5,\"output\":6}]}],";

/* (1,0,3) by the second joint: (1,0,2) from where it was bound, turned (1,-2,0), at its place (1,-2,2).
 * By half: ((1,0,3) + (1,-2,2)) / 2 = (1,-1,2.5). The box is 0..1, -2..0, 0..2.5. */
static bool is_turned(const struct model *m)
{
    return m && has_vertex(m, -0.5, 1, 0) && has_vertex(m, 0.5, -1, 2) && has_vertex(m, 0.5, 0, 2.5);
}

/* Put `to` where the text says `from`. */
static void edit(char *text, size_t size, const char *from, const char *to)
{
    char after[4096];
    char *at = strstr(text, from);
    if (!OK(at != NULL, "the file says %s", from)) return;
    snprintf(after, sizeof after, "%s", at + strlen(from));
    snprintf(at, size - (size_t)(at - text), "%s%s", to, after);
}

static const char *put_skin(const char *name, const struct bytes *b, const char *nodes)
{
    char rest[4096];
    snprintf(rest, sizeof rest, SKIN_START "%s" SKIN_END, nodes);
    return put_gltf(name, b, rest);
}

static void skins_are_applied(void)
{
    struct bytes b = skin_bytes();
    struct error err = ERROR_NONE;
    struct model posed, *m = load(put_skin("skin.gltf", &b, still_nodes), &as_in_file);
    OK(is_turned(m), "a skin moves vertices by joint times inverse bind matrix; the mesh node's own transform does not count");
    OK(m && fabsf(m->meshes[0].normal[1][1] + 1) < 1e-6f && fabsf(m->meshes[0].normal[2][1] + 0.70710678f) < 1e-6f, "and turns normals with them");
    OK(m && !m->rig, "without an animation it is a model like any other");
    model_destroy(m);
    m = load(put_skin("animated.gltf", &b, moving_nodes), &as_in_file);
    OK(is_turned(m), "the first animation at time 0 is the pose");
    /* At its end the second joint only lifts by 1: (1,0,4), and half of it (1,0,3.5). The origin is (0.5,-1,0). */
    OK(m && model_pose(&posed, m, &(struct posture){ .time_s = 0.999999 }, &err) && has_vertex(&posed, 0.5, 1, 4) && has_vertex(&posed, 0.5, 1, 3.5) && posed.min_m.z == 0, "and at its end its end's, from the origin of the start");
    if (m && err.code == ERR_OK) model_posed_release(&posed);
    model_destroy(m);
    /* The third corner's half for the second joint comes from a second set, in normalized bytes. */
    char rest[4096];
    static const uint8_t set[] = { 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 255, 0 };
    b = skin_bytes();
    memcpy(b.data + 84 + 32, (float[]){ 1, 0, 0, 0 }, 16);
    memcpy(b.data + b.size, set, sizeof set);
    snprintf(rest, sizeof rest, SKIN_START "%s" SKIN_END, still_nodes);
    char views[128];
    snprintf(views, sizeof views, "\"bufferViews\":[{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":24},{\"buffer\":0,\"byteLength\":36}", b.size);
    b.size += sizeof set;
    edit(rest, sizeof rest, "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}", views);
    for (int i = 6; i >= 0; i--) { /* the first view pushed the others on */
        char from[32], to[32];
        snprintf(from, sizeof from, "\"bufferView\":%d,", i);
        snprintf(to, sizeof to, "\"bufferView\":%d,", i + 1);
        edit(rest, sizeof rest, from, to);
    }
    edit(rest, sizeof rest, "\"type\":\"VEC4\"}],", "\"type\":\"VEC4\"},{\"bufferView\":0,\"componentType\":5121,\"count\":3,\"type\":\"VEC4\"},"
         "{\"bufferView\":0,\"byteOffset\":12,\"componentType\":5121,\"normalized\":true,\"count\":3,\"type\":\"VEC4\"}],");
    edit(rest, sizeof rest, "\"WEIGHTS_0\":3", "\"WEIGHTS_0\":3,\"JOINTS_1\":7,\"WEIGHTS_1\":8");
    m = load(put_gltf("sets.gltf", &b, rest), &as_in_file);
    OK(is_turned(m), "two sets of joints count together");
    model_destroy(m);
}

static void bad_skins_are_refused(void)
{
    static const struct { const char *from, *to, *want, *behaviour; } edits[] = {
        { "\"joints\":[1,2]", "\"joints\":[1,9]", "skin 0: joint node 9 of 3 does not exist", "a skin with a joint that is missing" },
        { "\"count\":2,\"type\":\"MAT4\"", "\"count\":1,\"type\":\"MAT4\"", "skin 0: 1 inverse bind matrices for 2 joints", "fewer inverse bind matrices than joints" },
        { "\"mesh\":0,\"skin\":0", "\"mesh\":0,\"skin\":3", "mesh 0: skin 3 of 1 does not exist", "a skin that is missing" },
        { "\"count\":2,\"type\":\"SCALAR\"", "\"count\":1,\"type\":\"SCALAR\"", "animated rotation: 2 values for 1 key times: 1 would be right", "an animation with more values than times" },
        { "\"output\":6", "\"output\":6,\"interpolation\":\"CUBICSPLINE\"", "animated rotation: 2 values for 2 key times: 6 would be right (CUBICSPLINE)", "a cubic spline without tangents" },
        { "\"sampler\":0", "\"sampler\":4", "key times: accessor -1 of 7 does not exist", "a channel without its sampler" },
        { "\"node\":2,\"path\"", "\"node\":7,\"path\"", "animation: node 7 of 3 does not exist", "an animation of a node that is missing" },
        { "{\"translation\":[0,0,2]}", "{\"matrix\":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,2,1]}", "animation: node 2 has a matrix: one with translation, rotation and scale could be moved", "an animation of a node with a matrix" },
        { "\"path\":\"rotation\"", "\"path\":\"translation\"", "animated translation: accessor 6 has the wrong type", "values of another kind than the path" },
    };
    struct bytes b = skin_bytes();
    char rest[4096], want[512];
    for (size_t i = 0; i < COUNT(edits); i++) {
        snprintf(rest, sizeof rest, SKIN_START "%s" SKIN_END, moving_nodes);
        edit(rest, sizeof rest, edits[i].from, edits[i].to);
        snprintf(want, sizeof want, "bad.gltf: %s", edits[i].want);
        char behaviour[128];
        snprintf(behaviour, sizeof behaviour, "refuses %s", edits[i].behaviour);
        refused(put_gltf("bad.gltf", &b, rest), &as_in_file, want, behaviour);
    }
    b.data[76] = 7;
    refused(put_skin("joint.gltf", &b, moving_nodes), &as_in_file, "joint.gltf: mesh 0: joints: vertex 1 uses joint 7 of 2", "refuses a joint that the skin does not have");
    b = skin_bytes();
    memset(b.data + 100, 0, 16);
    refused(put_skin("weight.gltf", &b, moving_nodes), &as_in_file, "weight.gltf: mesh 0: joint weights: vertex 1 has none", "refuses weights whose sum is zero");
    b = skin_bytes();
    memcpy(b.data + 100, (float[]){ -1 }, 4);
    refused(put_skin("negative.gltf", &b, moving_nodes), &as_in_file, "negative.gltf: mesh 0: joint weights: vertex 1 has one that is not above zero", "refuses a negative weight");
    b = skin_bytes();
    memcpy(b.data + 260, (float[]){ 1, 1 }, 8);
    refused(put_skin("times.gltf", &b, moving_nodes), &as_in_file, "times.gltf: key times: key time 1 is 1, after 1: ascending times would be right", "refuses times that do not ascend");
    memcpy(b.data + 260, (float[]){ -1, 1 }, 8);
    refused(put_skin("early.gltf", &b, moving_nodes), &as_in_file, "early.gltf: key times: key time 0 is -1: seconds from 0 on would be right", "refuses a time before the beginning");
    b = skin_bytes();
    memset(b.data + 268, 0, 16);
    refused(put_skin("norm.gltf", &b, moving_nodes), &as_in_file, "norm.gltf: animated rotation: key 0 is a rotation of norm zero", "refuses a rotation of norm zero");
    b = skin_bytes();
    memcpy(b.data + 132, (float[]){ NAN }, 4);
    refused(put_skin("bind.gltf", &b, moving_nodes), &as_in_file, "bind.gltf: mesh 0: the position of vertex 0 is not a number", "refuses a matrix that is not of numbers");
}

/* What poses follow from, changed for a moment: the hash is another one, and then the same again. */
static void hash_tells(struct rig *rig, double *value, const char *what)
{
    double kept = *value;
    uint64_t before = rig_hash(1, rig);
    *value += 0.125;
    uint64_t changed = rig_hash(1, rig);
    *value = kept;
    OK(changed != before && rig_hash(1, rig) == before, "the hash of a rig tells of %s", what);
}

static void hashes_tell_of_animations(void)
{
    struct model *m = load(in_folder("top_srcdir", "tests/input/skinned.gltf"), &(struct model_options){ 0 });
    if (!OK(m && m->rig && m->rig->channel_count > 1 && m->rig->skin_count > 1, "a file of two skins is loaded")) return;
    struct rig *rig = m->rig;
    struct rig_channel *last = &rig->channels[rig->channel_count - 1];
    size_t n = last->keys * (last->path == GLTF_ROTATION ? 4 : 3) * (last->interpolation == GLTF_CUBIC ? 3 : 1);
    hash_tells(rig, &last->value[n - 1], "the last of its values");
    hash_tells(rig, &last->time_s[last->keys - 1], "the last of its times");
    hash_tells(rig, &rig->skins[1].inverse_bind[rig->skins[1].joint_count - 1].a[2][3], "its skins");
    for (size_t i = 0; i < rig->node_count; i++)
        if (!rig->nodes[i].has_matrix) hash_tells(rig, &rig->nodes[i].scale[2], "its nodes");
    uint64_t manned = rig_hash(1, rig);
    rig->nodes[0].is_driver = true;
    OK(rig_hash(1, rig) != manned, "the hash of a rig tells of who drives");
    model_destroy(m);
}

int main(void)
{
    if (!mkdtemp(folder)) return 1;
    awkward_features_agree();
    walker_agrees("models/man-jacket-far.glb", 0, walking_man, COUNT(walking_man));
    walker_agrees("models/woman-skirt-far.glb", 2, running_woman, COUNT(running_woman));
    poses_are_the_loaded_models();
    root_motion_is_taken_out();
    skins_are_applied();
    bad_skins_are_refused();
    hashes_tell_of_animations();
    remove_tree(folder);
    return tap_done();
}
