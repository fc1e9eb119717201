#include "gen/model/rig.h"

#include "lib/file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool no_memory(struct error *err)
{
    return error_set(err, ERR_MEMORY, "no memory for a model's pose");
}

/* --- the animation at a time --- */

static void normalize(double q[4])
{
    double n = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (int k = 0; k < 4; k++) q[k] /= n;
}

/* Along the shorter arc. Src: Shoemake 1985, Animating Rotation with Quaternion Curves */
static void slerp(double out[4], const double a[4], const double b[4], double t)
{
    double dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3], sign = dot < 0 ? -1 : 1;
    double angle = acos(fmin(fabs(dot), 1)), wa = 1 - t, wb = t;
    if (angle > 1e-5) {
        wa = sin((1 - t) * angle) / sin(angle);
        wb = sin(t * angle) / sin(angle);
    }
    for (int k = 0; k < 4; k++) out[k] = wa * a[k] + sign * wb * b[k];
    normalize(out);
}

/* Src: Khronos, glTF 2.0 Specification, appendix C */
static void sample(double *out, const struct rig_channel *c, double time_s)
{
    size_t n = c->path == GLTF_ROTATION ? 4 : 3, low = 0, high = c->keys - 1;
    bool cubic = c->interpolation == GLTF_CUBIC;
    size_t step = cubic ? 3 * n : n;
    const double *value = c->value + (cubic ? n : 0); /* of key k: at k * step */
    if (time_s <= c->time_s[0]) high = 0;
    else if (time_s >= c->time_s[high]) low = high;
    while (high > low + 1) {
        size_t middle = (low + high) / 2;
        if (c->time_s[middle] <= time_s) low = middle;
        else high = middle;
    }
    const double *a = value + low * step, *b = value + high * step;
    double span = c->time_s[high] - c->time_s[low], t = high > low ? (time_s - c->time_s[low]) / span : 0;
    if (c->interpolation == GLTF_STEP || high == low) {
        memcpy(out, a, n * sizeof *out);
    } else if (cubic) {
        double t2 = t * t, t3 = t2 * t;
        const double *leaves = a + n, *arrives = b - n;
        for (size_t k = 0; k < n; k++)
            out[k] = (2 * t3 - 3 * t2 + 1) * a[k] + span * (t3 - 2 * t2 + t) * leaves[k] + (3 * t2 - 2 * t3) * b[k] + span * (t3 - t2) * arrives[k];
    } else if (n == 4) {
        double from[4], to[4];
        memcpy(from, a, sizeof from);
        memcpy(to, b, sizeof to);
        normalize(from);
        normalize(to);
        slerp(out, from, to, t);
    } else {
        for (size_t k = 0; k < n; k++) out[k] = (1 - t) * a[k] + t * b[k];
    }
}

/* Each node's three as an animation has them. */
static void animate(struct rig_node *nodes, const struct rig *rig, size_t animation, double time_s)
{
    if (animation >= rig->animation_count) return; /* a file without any */
    const struct rig_animation *a = &rig->animations[animation];
    for (size_t i = a->first; i < a->first + a->count; i++) {
        const struct rig_channel *c = &rig->channels[i];
        struct rig_node *node = &nodes[c->node];
        sample(c->path == GLTF_TRANSLATION ? node->translation : c->path == GLTF_ROTATION ? node->rotation : node->scale, c, time_s);
    }
}

/* A share of the way from one to the other. */
static void blend(struct rig_node *node, const struct rig_node *to, double share)
{
    double from[4], end[4];
    for (int k = 0; k < 3; k++) {
        node->translation[k] += share * (to->translation[k] - node->translation[k]);
        node->scale[k] += share * (to->scale[k] - node->scale[k]);
    }
    memcpy(from, node->rotation, sizeof from);
    memcpy(end, to->rotation, sizeof end);
    normalize(from);
    normalize(end);
    slerp(node->rotation, from, end, share);
}

/* file_from_node for every node; times are not looped here. The caller frees; NULL: ERR_MEMORY. */
static struct affine *place_nodes(const struct rig *rig, const struct posture *posture, struct error *err)
{
    size_t n = rig->node_count;
    struct rig_node *nodes = malloc((n + 1) * sizeof *nodes), *others = malloc((n + 1) * sizeof *others);
    struct affine *world = malloc((n + 1) * sizeof *world);
    if (!nodes || !others || !world) {
        free(nodes);
        free(others);
        free(world);
        no_memory(err);
        return NULL;
    }
    if (n) memcpy(nodes, rig->nodes, n * sizeof *nodes);
    animate(nodes, rig, posture->animation, posture->time_s);
    if (posture->share > 0) {
        memcpy(others, rig->nodes, n * sizeof *others);
        animate(others, rig, posture->to, posture->to_time_s);
        for (size_t i = 0; i < n; i++)
            if (!nodes[i].has_matrix) blend(&nodes[i], &others[i], posture->share);
    }
    free(others);
    for (size_t i = 0; i < n; i++) {
        const struct rig_node *node = &nodes[rig->order[i]];
        struct affine local = node->has_matrix ? node->matrix : affine_from_trs(node->translation, node->rotation, node->scale);
        world[rig->order[i]] = node->parent < 0 ? local : affine_multiply(&world[node->parent], &local);
    }
    free(nodes);
    return world;
}

/* --- meshes --- */

/* Where each of the joints takes what is bound to it; for a mesh without influences, its node alone. */
static struct affine *joint_maps(const struct rig *rig, const struct rig_mesh *mesh, const struct affine *world, struct error *err)
{
    const struct rig_skin *skin = mesh->per_vertex ? &rig->skins[mesh->skin] : NULL;
    size_t count = skin ? skin->joint_count : 1;
    struct affine *map = malloc(count * sizeof *map);
    if (!map) {
        no_memory(err);
        return NULL;
    }
    for (size_t i = 0; i < count; i++) {
        struct affine file = skin ? affine_multiply(&world[skin->joint[i]], &skin->inverse_bind[i]) : world[mesh->node];
        map[i] = affine_multiply(&rig->entity_from_file, &file);
    }
    return map;
}

static struct affine vertex_map(const struct rig_mesh *mesh, const struct affine *joint, size_t vertex)
{
    if (!mesh->per_vertex) return joint[0];
    struct affine sum = { { { 0 } } };
    const struct rig_influence *f = &mesh->influence[vertex * mesh->per_vertex];
    for (size_t i = 0; i < mesh->per_vertex && f[i].weight > 0; i++)
        for (int r = 0; r < 3; r++)
            for (int c = 0; c < 4; c++) sum.a[r][c] += (double)f[i].weight * joint[f[i].joint].a[r][c];
    return sum;
}

/* Times are not looped here: the end of an animation is a moment of its own. */
static bool pose_at(struct mesh *meshes, const struct rig *rig, const struct posture *posture, struct error *err)
{
    struct affine *world = place_nodes(rig, posture, err);
    if (!world) return false;
    for (size_t i = 0; i < rig->mesh_count && err->code == ERR_OK; i++) {
        const struct rig_mesh *from = &rig->meshes[i];
        struct mesh *to = &meshes[i];
        struct affine *joint = joint_maps(rig, from, world, err);
        for (size_t v = 0; joint && v < to->vertices; v++) {
            struct affine map = vertex_map(from, joint, v);
            affine_move_point(to->position_m[v], &map, from->position[v]);
            if (to->normal) affine_move_normal(to->normal[v], &map, from->normal[v]);
            const float *p = to->position_m[v];
            if (!isfinite(p[0] + p[1] + p[2])) {
                error_set(err, ERR_INPUT, "mesh %zu: the position of vertex %zu is not a number", i, v);
                break;
            }
        }
        free(joint);
    }
    free(world);
    return err->code == ERR_OK;
}

/* The time within a loop, and what the animation has gone in it. */
static double looped(double *gone_m, const struct rig *rig, size_t animation, double time_s)
{
    *gone_m = 0;
    if (animation >= rig->animation_count) return 0;
    const struct rig_animation *a = &rig->animations[animation];
    double loop = a->duration_s, at = loop > 0 ? fmod(time_s, loop) : 0;
    if (at < 0) at += loop;
    if (loop > 0) *gone_m = a->drift_m * at / loop;
    return at;
}

bool rig_pose(struct mesh *meshes, const struct rig *rig, const struct posture *posture, struct error *err)
{
    struct posture at = *posture;
    double gone_m, to_gone_m;
    at.time_s = looped(&gone_m, rig, posture->animation, posture->time_s);
    at.to_time_s = looped(&to_gone_m, rig, posture->to, posture->to_time_s);
    if (!pose_at(meshes, rig, &at, err)) return false;
    float gone = (float)(gone_m + at.share * (to_gone_m - gone_m));
    for (size_t i = 0; gone != 0 && i < rig->mesh_count; i++)
        for (size_t v = 0; v < meshes[i].vertices; v++) meshes[i].position_m[v][0] -= gone;
    return true;
}

bool rig_wind(struct mesh *meshes, const struct rig *rig, struct error *err)
{
    struct affine *world = place_nodes(rig, &(struct posture){ 0 }, err);
    if (!world) return false;
    for (size_t i = 0; i < rig->mesh_count && err->code == ERR_OK; i++) {
        struct affine *joint = joint_maps(rig, &rig->meshes[i], world, err);
        for (size_t t = 0; joint && t < meshes[i].triangles; t++) {
            uint32_t *corner = meshes[i].triangle[t], keep = corner[1];
            struct affine map = vertex_map(&rig->meshes[i], joint, corner[0]);
            if (affine_determinant(&map) >= 0) continue;
            corner[1] = corner[2];
            corner[2] = keep;
        }
        free(joint);
    }
    free(world);
    return err->code == ERR_OK;
}

static struct mesh *make_meshes(const struct rig *rig, struct error *err)
{
    struct mesh *meshes = calloc(rig->mesh_count + 1, sizeof *meshes);
    if (!meshes) no_memory(err);
    for (size_t i = 0; meshes && i < rig->mesh_count && err->code == ERR_OK; i++)
        mesh_init(&meshes[i], rig->meshes[i].vertices, 0, false, false, err);
    return meshes;
}

/* A loop that walks away ends in the pose that it began with, but elsewhere: all vertices went about as
 * far. Where they only differ, as in a clip that does not close, nobody has gone anywhere. */
static bool measure_drift(struct rig_animation *animation, const struct rig *rig, struct error *err)
{
    struct mesh *begin = make_meshes(rig, err), *end = make_meshes(rig, err);
    double sum = 0, squares = 0, count = 0;
    size_t which = (size_t)(animation - rig->animations);
    bool posed = err->code == ERR_OK && pose_at(begin, rig, &(struct posture){ .animation = which }, err) &&
                 pose_at(end, rig, &(struct posture){ .animation = which, .time_s = animation->duration_s }, err);
    for (size_t i = 0; i < rig->mesh_count; i++) {
        for (size_t v = 0; posed && v < begin[i].vertices; v++) {
            double gone = (double)end[i].position_m[v][0] - (double)begin[i].position_m[v][0];
            sum += gone;
            squares += gone * gone;
            count++;
        }
        if (begin) mesh_release(&begin[i]);
        if (end) mesh_release(&end[i]);
    }
    free(begin);
    free(end);
    if (!posed) return false;
    double mean = count > 0 ? sum / count : 0, spread = sqrt(fmax(count > 0 ? squares / count - mean * mean : 0, 0));
    animation->drift_m = fabs(mean) > 2 * spread ? mean : 0;
    return true;
}

bool rig_measure_drift(struct rig *rig, struct error *err)
{
    for (size_t i = 0; i < rig->animation_count; i++)
        if (!measure_drift(&rig->animations[i], rig, err)) return false;
    return true;
}

/* The normal at rest that the map takes to n: what takes normals is the inverse transpose. */
static void rest_normal(float out[3], const struct affine *m, const float n[3])
{
    struct affine transpose = { { { 0 } } };
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) transpose.a[i][j] = m->a[j][i];
    affine_move_point(out, &transpose, n);
    float length = sqrtf(out[0] * out[0] + out[1] * out[1] + out[2] * out[2]);
    for (int k = 0; k < 3; k++) out[k] /= length > 0 ? length : 1;
}

static bool follow(struct rig_mesh *to, const struct mesh *mesh, const struct affine *joint, struct error *err)
{
    size_t n = mesh->vertices, each = to->per_vertex;
    struct rig_mesh made = *to;
    made.position = malloc((n + 1) * sizeof *made.position);
    made.normal = malloc((n + 1) * sizeof *made.normal);
    made.influence = each ? malloc((n * each + 1) * sizeof *made.influence) : NULL;
    made.vertices = n;
    if (!made.position || !made.normal || (each && !made.influence)) {
        rig_mesh_release(&made);
        return no_memory(err);
    }
    for (size_t v = 0; v < n; v++) {
        struct affine map = vertex_map(to, joint, mesh->source[v]);
        memcpy(made.position[v], to->position[mesh->source[v]], sizeof *made.position);
        rest_normal(made.normal[v], &map, mesh->normal[v]);
        if (each) memcpy(made.influence + v * each, to->influence + mesh->source[v] * each, each * sizeof *made.influence);
    }
    rig_mesh_release(to);
    *to = made;
    return true;
}

bool rig_follow(struct rig *rig, const struct mesh *meshes, struct error *err)
{
    struct affine *world = place_nodes(rig, &(struct posture){ 0 }, err);
    for (size_t i = 0; world && i < rig->mesh_count && err->code == ERR_OK; i++) {
        struct affine *joint = joint_maps(rig, &rig->meshes[i], world, err);
        if (joint) follow(&rig->meshes[i], &meshes[i], joint, err);
        free(joint);
    }
    free(world);
    return err->code == ERR_OK;
}

static uint64_t hash_node(uint64_t hash, const struct rig_node *node)
{
    hash = hash_bytes(hash, &node->parent, sizeof node->parent);
    hash = hash_bytes(hash, &node->is_driver, sizeof node->is_driver);
    if (node->has_matrix) return hash_bytes(hash, &node->matrix, sizeof node->matrix);
    hash = hash_bytes(hash, node->translation, sizeof node->translation);
    hash = hash_bytes(hash, node->rotation, sizeof node->rotation);
    return hash_bytes(hash, node->scale, sizeof node->scale);
}

static uint64_t hash_channel(uint64_t hash, const struct rig_channel *channel)
{
    const size_t what[] = { channel->node, channel->keys, channel->path, channel->interpolation };
    size_t values = channel->keys * (channel->path == GLTF_ROTATION ? 4 : 3) * (channel->interpolation == GLTF_CUBIC ? 3 : 1);
    hash = hash_bytes(hash, what, sizeof what);
    hash = hash_bytes(hash, channel->time_s, channel->keys * sizeof *channel->time_s);
    return hash_bytes(hash, channel->value, values * sizeof *channel->value);
}

static uint64_t hash_mesh(uint64_t hash, const struct rig_mesh *mesh)
{
    const size_t what[] = { mesh->node, mesh->skin, mesh->per_vertex, mesh->vertices };
    hash = hash_bytes(hash, what, sizeof what);
    if (mesh->per_vertex) hash = hash_bytes(hash, mesh->influence, mesh->vertices * mesh->per_vertex * sizeof *mesh->influence);
    hash = hash_bytes(hash, mesh->position, mesh->vertices * sizeof *mesh->position);
    return mesh->normal ? hash_bytes(hash, mesh->normal, mesh->vertices * sizeof *mesh->normal) : hash;
}

uint64_t rig_hash(uint64_t hash, const struct rig *rig)
{
    for (size_t i = 0; i < rig->node_count; i++) hash = hash_node(hash, &rig->nodes[i]);
    for (size_t i = 0; i < rig->animation_count; i++) {
        const struct rig_animation *a = &rig->animations[i];
        hash = hash_bytes(hash_bytes(hash, a->name, strlen(a->name)), &a->first, sizeof a->first);
    }
    for (size_t i = 0; i < rig->channel_count; i++) hash = hash_channel(hash, &rig->channels[i]);
    for (size_t i = 0; i < rig->skin_count; i++) {
        const struct rig_skin *skin = &rig->skins[i];
        hash = hash_bytes(hash, skin->joint, skin->joint_count * sizeof *skin->joint);
        hash = hash_bytes(hash, skin->inverse_bind, skin->joint_count * sizeof *skin->inverse_bind);
    }
    for (size_t i = 0; i < rig->mesh_count; i++) hash = hash_mesh(hash, &rig->meshes[i]);
    return hash;
}

void rig_mesh_release(struct rig_mesh *mesh)
{
    free(mesh->influence);
    free(mesh->position);
    free(mesh->normal);
    mesh->influence = NULL;
    mesh->position = mesh->normal = NULL;
}

void rig_destroy(struct rig *rig)
{
    if (!rig) return;
    for (size_t i = 0; i < rig->channel_count; i++) {
        free(rig->channels[i].time_s);
        free(rig->channels[i].value);
    }
    for (size_t i = 0; i < rig->skin_count; i++) {
        free(rig->skins[i].joint);
        free(rig->skins[i].inverse_bind);
    }
    for (size_t i = 0; i < rig->mesh_count; i++) rig_mesh_release(&rig->meshes[i]);
    for (size_t i = 0; i < rig->animation_count; i++) free(rig->animations[i].name);
    free(rig->animations);
    free(rig->nodes);
    free(rig->order);
    free(rig->channels);
    free(rig->skins);
    free(rig->meshes);
    free(rig);
}
