/* glTF 2.0: nodes, skins and animations.
 * Src: Khronos, glTF 2.0 Specification, 3.5, 3.7.3 and 3.11 */
#include "gen/model/model_gltf.h"

#include <stdlib.h>
#include <string.h>

static double square_norm(const double q[4])
{
    return q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
}

static bool add_nodes(struct gltf_loader *l)
{
    const struct gltf *g = l->gltf;
    struct rig *rig = l->import->rig;
    size_t n = g->node_count;
    rig->nodes = calloc(n + 1, sizeof *rig->nodes);
    rig->order = calloc(n + 1, sizeof *rig->order);
    if (!rig->nodes || !rig->order) return gltf_no_memory(l);
    rig->node_count = n;
    for (size_t i = 0; i < n; i++) {
        const struct gltf_node *from = &g->nodes[i];
        struct rig_node *to = &rig->nodes[i];
        to->parent = -1;
        to->is_driver = from->is_driver;
        to->has_matrix = from->has_matrix;
        if (from->has_matrix) to->matrix = affine_from_columns(from->matrix);
        else if (!(square_norm(from->rotation) > 1e-12)) return GLTF_FAIL(l, "node %zu: a rotation of norm zero", i);
        memcpy(to->translation, from->translation, sizeof to->translation);
        memcpy(to->rotation, from->rotation, sizeof to->rotation);
        memcpy(to->scale, from->scale, sizeof to->scale);
    }
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < g->nodes[i].child_count; k++) {
            int child = g->nodes[i].children[k];
            if (child < 0 || (size_t)child >= n) return GLTF_FAIL(l, "node %zu: child %d of %zu does not exist", i, child, n);
            if (rig->nodes[child].parent >= 0) return GLTF_FAIL(l, "node %d has two parents", child);
            rig->nodes[child].parent = (int)i;
        }
    return true;
}

/* Parents before children: roots first, then the children of each that is in the list. */
static bool order_nodes(struct gltf_loader *l)
{
    const struct gltf *g = l->gltf;
    struct rig *rig = l->import->rig;
    size_t listed = 0;
    for (size_t i = 0; i < rig->node_count; i++)
        if (rig->nodes[i].parent < 0) rig->order[listed++] = i;
    for (size_t next = 0; next < listed; next++) {
        const struct gltf_node *node = &g->nodes[rig->order[next]];
        for (size_t k = 0; k < node->child_count; k++) rig->order[listed++] = (size_t)node->children[k];
    }
    if (listed == rig->node_count) return true;
    /* Who was not reached hangs from a circle: going up from any of them ends in it. */
    bool *reached = calloc(rig->node_count, sizeof *reached);
    if (!reached) return gltf_no_memory(l);
    for (size_t i = 0; i < listed; i++) reached[rig->order[i]] = true;
    int at = 0;
    while (reached[at]) at++;
    for (size_t i = 0; i < rig->node_count; i++) at = rig->nodes[at].parent;
    int least = at;
    for (int up = rig->nodes[at].parent; up != at; up = rig->nodes[up].parent) least = up < least ? up : least;
    free(reached);
    return GLTF_FAIL(l, "node %d is its own ancestor", least);
}

/* --- the animation --- */

static bool check_keys(struct gltf_loader *l, const struct rig_channel *c, size_t values, const char *what)
{
    bool cubic = c->interpolation == GLTF_CUBIC;
    size_t want = cubic ? 3 * c->keys : c->keys;
    if (c->keys == 0) return GLTF_FAIL(l, "%s: no keys", what);
    if (values != want)
        return GLTF_FAIL(l, "%s: %zu values for %zu key times: %zu would be right%s", what, values, c->keys, want, cubic ? " (CUBICSPLINE)" : "");
    for (size_t i = 0; i < c->keys; i++) {
        if (!(c->time_s[i] >= 0 && c->time_s[i] < 1e6)) return GLTF_FAIL(l, "key times: key time %zu is %g: seconds from 0 on would be right", i, c->time_s[i]);
        if (i && c->time_s[i] <= c->time_s[i - 1])
            return GLTF_FAIL(l, "key times: key time %zu is %g, after %g: ascending times would be right", i, c->time_s[i], c->time_s[i - 1]);
        if (c->path == GLTF_ROTATION && !(square_norm(c->value + 4 * (cubic ? 3 * i + 1 : i)) > 1e-12))
            return GLTF_FAIL(l, "%s: key %zu is a rotation of norm zero", what, i);
    }
    return true;
}

static bool add_channel(struct gltf_loader *l, struct rig_animation *animation, const struct gltf_channel *from)
{
    static const char *const what[] = { "animated translation", "animated rotation", "animated scale" };
    struct rig *rig = l->import->rig;
    if (from->node < 0) return true; /* by the specification: to be ignored */
    if ((size_t)from->node >= rig->node_count) return GLTF_FAIL(l, "animation: node %d of %zu does not exist", from->node, rig->node_count);
    if (rig->nodes[from->node].has_matrix) return GLTF_FAIL(l, "animation: node %d has a matrix: one with translation, rotation and scale could be moved", from->node);
    struct rig_channel *to = &rig->channels[rig->channel_count++];
    *to = (struct rig_channel){ .node = (size_t)from->node, .path = from->path, .interpolation = from->interpolation };
    size_t values = 0;
    if (!(to->time_s = gltf_accessor_read(l, &to->keys, from->input, 1, "key times")) ||
        !(to->value = gltf_accessor_read(l, &values, from->output, from->path == GLTF_ROTATION ? 4 : 3, what[from->path])) ||
        !check_keys(l, to, values, what[from->path])) return false;
    double end = to->time_s[to->keys - 1];
    if (end > animation->duration_s) animation->duration_s = end;
    animation->count++;
    return true;
}

static bool add_animations(struct gltf_loader *l)
{
    const struct gltf *g = l->gltf;
    struct rig *rig = l->import->rig;
    for (size_t i = 0; i < g->animation_count; i++) {
        const struct gltf_animation *from = &g->animations[i];
        struct rig_animation *to = &rig->animations[rig->animation_count++];
        *to = (struct rig_animation){ .name = strdup(from->name), .first = rig->channel_count };
        if (!to->name) return gltf_no_memory(l);
        for (size_t k = from->first; k < from->first + from->count; k++)
            if (!add_channel(l, to, &g->channels[k])) return false;
    }
    return true;
}

/* --- skins --- */

static bool add_skin(struct gltf_loader *l, size_t skin)
{
    const struct gltf_skin *from = &l->gltf->skins[skin];
    struct rig_skin *to = &l->import->rig->skins[skin];
    if (from->joint_count == 0) return GLTF_FAIL(l, "has no joints");
    to->joint = calloc(from->joint_count, sizeof *to->joint);
    to->inverse_bind = calloc(from->joint_count, sizeof *to->inverse_bind);
    if (!to->joint || !to->inverse_bind) return gltf_no_memory(l);
    to->joint_count = from->joint_count;
    for (size_t i = 0; i < from->joint_count; i++) {
        if (from->joints[i] < 0 || (size_t)from->joints[i] >= l->gltf->node_count)
            return GLTF_FAIL(l, "joint node %d of %zu does not exist", from->joints[i], l->gltf->node_count);
        to->joint[i] = (size_t)from->joints[i];
        to->inverse_bind[i] = affine_identity;
    }
    if (from->inverse_bind < 0) return true;
    size_t count = 0;
    double *inverse = gltf_accessor_read(l, &count, from->inverse_bind, 16, "inverse bind matrices");
    if (!inverse) return false;
    for (size_t i = 0; i < from->joint_count && i < count; i++) to->inverse_bind[i] = affine_from_columns(inverse + 16 * i);
    free(inverse);
    return count >= from->joint_count || GLTF_FAIL(l, "%zu inverse bind matrices for %zu joints", count, from->joint_count);
}

bool gltf_add_rig(struct gltf_loader *l)
{
    const struct gltf *g = l->gltf;
    struct rig *rig = l->import->rig = calloc(1, sizeof *rig);
    if (!rig) return gltf_no_memory(l);
    rig->entity_from_file = affine_identity;
    rig->channels = calloc(g->channel_count + 1, sizeof *rig->channels);
    rig->animations = calloc(g->animation_count + 1, sizeof *rig->animations);
    rig->skins = calloc(g->skin_count + 1, sizeof *rig->skins);
    if (!rig->channels || !rig->animations || !rig->skins) return gltf_no_memory(l);
    rig->skin_count = g->skin_count;
    if (!add_nodes(l) || !order_nodes(l) || !add_animations(l)) return false;
    for (size_t i = 0; i < g->skin_count; i++)
        if (!add_skin(l, i)) return error_prefix(l->err, "skin %zu: ", i);
    return true;
}

/* --- weights --- */

static bool add_set(struct gltf_loader *l, struct rig_mesh *mesh, const struct gltf_primitive *p, size_t vertices, int set)
{
    size_t joints = l->import->rig->skins[mesh->skin].joint_count, joints_read = 0, weights_read = 0;
    double *index = gltf_accessor_read(l, &joints_read, p->joints[set], 4, "joints");
    double *weight = index ? gltf_accessor_read(l, &weights_read, p->weights[set], 4, "joint weights") : NULL;
    if (weight && (joints_read != vertices || weights_read != vertices))
        GLTF_FAIL(l, "joints and weights are not as many as the vertices (%zu)", vertices);
    for (size_t i = 0; l->err->code == ERR_OK && i < 4 * vertices; i++) {
        if (weight[i] == 0) continue;
        if (!(weight[i] > 0)) GLTF_FAIL(l, "joint weights: vertex %zu has one that is not above zero", i / 4);
        else if (!(index[i] < (double)joints)) GLTF_FAIL(l, "joints: vertex %zu uses joint %.0f of %zu", i / 4, index[i], joints);
        else mesh->influence[i / 4 * mesh->per_vertex + 4 * (size_t)set + i % 4] = (struct rig_influence){ (uint32_t)index[i], (float)weight[i] };
    }
    free(index);
    free(weight);
    return l->err->code == ERR_OK;
}

/* The heaviest first, so that reading may stop at the first weight of zero; in the sum 1. */
static bool settle(struct rig_influence *f, size_t n)
{
    double total = 0;
    for (size_t i = 0; i < n; i++) {
        struct rig_influence own = f[i];
        size_t to = i;
        for (; to > 0 && f[to - 1].weight < own.weight; to--) f[to] = f[to - 1];
        f[to] = own;
        total += (double)own.weight;
    }
    for (size_t i = 0; total > 0 && i < n; i++) f[i].weight = (float)((double)f[i].weight / total);
    return total > 0;
}

bool gltf_add_influences(struct gltf_loader *l, struct rig_mesh *mesh, const struct gltf_primitive *p, size_t vertices)
{
    size_t sets = 0;
    while (sets < GLTF_JOINT_SETS && p->joints[sets] >= 0) sets++;
    if (mesh->skin >= l->gltf->skin_count) return GLTF_FAIL(l, "skin %zu of %zu does not exist", mesh->skin, l->gltf->skin_count);
    mesh->influence = calloc(4 * sets * vertices + 1, sizeof *mesh->influence);
    if (!mesh->influence) return gltf_no_memory(l);
    mesh->per_vertex = 4 * sets;
    for (size_t set = 0; set < sets; set++)
        if (!add_set(l, mesh, p, vertices, (int)set)) return false;
    for (size_t v = 0; v < vertices; v++)
        if (!settle(mesh->influence + v * mesh->per_vertex, mesh->per_vertex)) return GLTF_FAIL(l, "joint weights: vertex %zu has none", v);
    return true;
}
