#include "cast/skin_glb.h"

#include "cast/glb.h"
#include "cast/need.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --- the skin: a primitive a piece; views of all pieces together --- */

static void add_pieces(struct glb *glb, FILE *primitives, const struct skin_figure *figure)
{
    size_t n = 0, indices = 0, v = 0, used = 0;
    for (int i = 0; i < figure->pieces; i++) n += figure->piece[i].vertices, indices += figure->piece[i].indices;
    float(*position)[3] = need(malloc(n * sizeof *position)), (*normal)[3] = need(malloc(n * sizeof *normal));
    uint16_t(*uv)[2] = need(malloc(n * sizeof *uv)), *index = need(malloc(indices * sizeof *index));
    uint8_t(*joints)[4] = need(malloc(n * sizeof *joints)), (*weights)[4] = need(malloc(n * sizeof *weights));
    for (int i = 0; i < figure->pieces; i++) {
        const struct skin_piece *piece = &figure->piece[i];
        for (size_t k = 0; k < piece->vertices; k++, v++) {
            const struct skin_vertex *from = &piece->vertex[k];
            glb_place(position[v], from->position);
            glb_place(normal[v], from->normal);
            uv[v][0] = (uint16_t)lround(65535 * from->uv.x), uv[v][1] = (uint16_t)lround(65535 * from->uv.y);
            memcpy(joints[v], from->joint, 4);
            memcpy(weights[v], from->weight, 4);
        }
        memcpy(index + used, piece->index, piece->indices * sizeof *index);
        used += piece->indices;
    }
    int views[6] = { glb_view(glb, position, n * sizeof *position, VERTICES, 12), glb_view(glb, normal, n * sizeof *normal, VERTICES, 12),
                     glb_view(glb, uv, n * sizeof *uv, VERTICES, 4), glb_view(glb, joints, n * sizeof *joints, VERTICES, 4),
                     glb_view(glb, weights, n * sizeof *weights, VERTICES, 4), glb_view(glb, index, indices * sizeof *index, INDICES, 0) };
    v = used = 0;
    for (int i = 0; i < figure->pieces; i++) {
        const struct skin_piece *piece = &figure->piece[i];
        size_t count = piece->vertices;
        char limits[LIMITS_SIZE];
        glb_limits(limits, position[v], count, 3, 3);
        int first = glb_accessor(glb, views[0], 12 * v, count, F32, false, "VEC3", limits);
        glb_accessor(glb, views[1], 12 * v, count, F32, false, "VEC3", "");
        glb_accessor(glb, views[2], 4 * v, count, U16, true, "VEC2", "");
        glb_accessor(glb, views[3], 4 * v, count, U8, false, "VEC4", "");
        glb_accessor(glb, views[4], 4 * v, count, U8, true, "VEC4", "");
        glb_accessor(glb, views[5], 2 * used, piece->indices, U16, false, "SCALAR", "");
        fprintf(primitives, "%s{\"attributes\":{\"POSITION\":%d,\"NORMAL\":%d,\"TEXCOORD_0\":%d,\"JOINTS_0\":%d,\"WEIGHTS_0\":%d},\"indices\":%d,\"material\":%d}",
                i ? "," : "", first, first + 1, first + 2, first + 3, first + 4, first + 5, i);
        v += count, used += piece->indices;
    }
    free(position), free(normal), free(uv), free(index), free(joints), free(weights);
}

/* --- the skeleton --- */

/* The mesh is node 0, a joint j node 1 + j. */
static void write_nodes(FILE *f, const struct body *body, const char *name)
{
    fprintf(f, "{\"name\":\"%s\",\"mesh\":0,\"skin\":0}", name);
    for (int j = 0; j < JOINT_COUNT; j++) {
        int parent = joint_parent(j), children = 0;
        float t[3];
        glb_place(t, parent < 0 ? body->at[j] : vec3_sub(body->at[j], body->at[parent]));
        fprintf(f, ",{\"name\":\"%s\",\"translation\":[%.9g,%.9g,%.9g]", joint_name[j], (double)t[0], (double)t[1], (double)t[2]);
        for (int c = 0; c < JOINT_COUNT; c++)
            if (joint_parent(c) == j) fprintf(f, "%s%d", children++ ? "," : ",\"children\":[", 1 + c);
        fputs(children ? "]}" : "}", f);
    }
}

static int add_inverse_bind(struct glb *glb, const struct body *body)
{
    float m[JOINT_COUNT][16] = { { 0 } };
    for (int j = 0; j < JOINT_COUNT; j++) {
        glb_place(&m[j][12], vec3_scale(body->at[j], -1));
        m[j][0] = m[j][5] = m[j][10] = m[j][15] = 1;
    }
    return glb_accessor(glb, glb_view(glb, m, sizeof m, NO_TARGET, 0), 0, JOINT_COUNT, F32, false, "MAT4", "");
}

static void add_clip(struct glb *glb, FILE *f, const struct clip *clip)
{
    size_t n = (size_t)clip->keys + 1;
    float time_s[MOST_KEYS + 1], hips[MOST_KEYS + 1][3];
    int16_t turn[JOINT_COUNT][MOST_KEYS + 1][4];
    char limits[LIMITS_SIZE];
    for (size_t i = 0; i < n; i++) {
        time_s[i] = (float)(clip->duration_s * (double)i / clip->keys);
        glb_place(hips[i], clip->hips[i]);
        for (int j = 0; j < JOINT_COUNT; j++) {
            struct quat q = clip->turn[j][i];
            const double file[4] = { q.y, q.z, q.x, q.w };
            for (int k = 0; k < 4; k++) turn[j][i][k] = (int16_t)lround(32767 * file[k]);
        }
    }
    glb_limits(limits, time_s, n, 1, 1);
    int input = glb_accessor(glb, glb_view(glb, time_s, n * sizeof *time_s, NO_TARGET, 0), 0, n, F32, false, "SCALAR", limits);
    int first = glb_accessor(glb, glb_view(glb, hips, n * sizeof *hips, NO_TARGET, 0), 0, n, F32, false, "VEC3", "");
    for (int j = 0; j < JOINT_COUNT; j++) glb_accessor(glb, glb_view(glb, turn[j], n * sizeof *turn[j], NO_TARGET, 0), 0, n, I16, true, "VEC4", "");
    fprintf(f, "{\"name\":\"%s\",\"channels\":[{\"sampler\":0,\"target\":{\"node\":%d,\"path\":\"translation\"}}", clip->name, 1 + HIPS);
    for (int j = 0; j < JOINT_COUNT; j++) fprintf(f, ",{\"sampler\":%d,\"target\":{\"node\":%d,\"path\":\"rotation\"}}", 1 + j, 1 + j);
    fputs("],\"samplers\":[", f);
    for (int j = 0; j <= JOINT_COUNT; j++) fprintf(f, "%s{\"input\":%d,\"output\":%d}", j ? "," : "", input, first + j);
    fputs("]}", f);
}

/* --- the file --- */

bool write_skin_glb(const char *path, const struct skin_figure *figure, struct error *err)
{
    struct glb glb;
    struct text json, primitives, clips;
    glb_open(&glb), text_open(&json), text_open(&primitives), text_open(&clips);
    add_pieces(&glb, primitives.f, figure);
    int inverse_bind = add_inverse_bind(&glb, figure->body);
    for (int i = 0; i < figure->clips; i++) {
        if (i) fputc(',', clips.f);
        add_clip(&glb, clips.f, &figure->clip[i]);
    }
    int image = glb_view(&glb, figure->png, figure->png_size, NO_TARGET, 0);
    text_close(&primitives), text_close(&clips);

    FILE *f = json.f;
    fputs("{\"asset\":{\"version\":\"2.0\",\"generator\":\"Staffage\",\"copyright\":\"CC0-1.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0,1]}],", f);
    glb_lists(&glb, f);
    fprintf(f, "\"images\":[{\"bufferView\":%d,\"mimeType\":\"image/png\"}],\"samplers\":[{\"wrapS\":33071,\"wrapT\":33071}],\"textures\":[{\"source\":0,\"sampler\":0}],\"materials\":[", image);
    for (int i = 0; i < figure->pieces; i++)
        fprintf(f, "%s{\"name\":\"%s\",\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0},\"metallicFactor\":0,\"roughnessFactor\":%g}}", i ? "," : "",
                figure->piece[i].material, figure->piece[i].roughness);
    fprintf(f, "],\"meshes\":[{\"name\":\"%s\",\"primitives\":[%s]}],\"nodes\":[", figure->name, primitives.data);
    write_nodes(f, figure->body, figure->name);
    fprintf(f, "],\"skins\":[{\"inverseBindMatrices\":%d,\"skeleton\":1,\"joints\":[", inverse_bind);
    for (int j = 0; j < JOINT_COUNT; j++) fprintf(f, "%s%d", j ? "," : "", 1 + j);
    fprintf(f, "]}],\"animations\":[%s]}", clips.data);
    free(primitives.data), free(clips.data);
    return glb_write(path, &glb, &json, err);
}
