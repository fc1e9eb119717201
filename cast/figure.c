#include "cast/figure.h"

#include "cast/hull.h"
#include "cast/motion.h"
#include "cast/need.h"
#include "cast/person.h"
#include "cast/pose.h"
#include "cast/skin_glb.h"
#include "cast/texture.h"
#include "lib/file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const struct { const char *name; double roughness; } materials[PIECE_COUNT] = {
    [SKIN_PIECE] = { "Skin", 0.6 }, [HAIR_PIECE] = { "Hair", 0.65 }, [TOP_PIECE] = { "Top cloth", 0.9 }, [UNDER_PIECE] = { "Shirt cloth", 0.9 },
    [BOTTOM_PIECE] = { "Trousers cloth", 0.9 }, [SHOES_PIECE] = { "Shoes leather", 0.55 }, [CARRIED_PIECE] = { "Bag cloth", 0.7 }, [HAT_PIECE] = { "Hat cloth", 0.9 }
};
/* How much an error of the shape counts, seen from near, farther, far. */
static const double weights[3][PIECE_COUNT] = {
    { [SKIN_PIECE] = 4, [HAIR_PIECE] = 1.5, [TOP_PIECE] = 1, [UNDER_PIECE] = 0.6, [BOTTOM_PIECE] = 1, [SHOES_PIECE] = 1, [CARRIED_PIECE] = 0.7, [HAT_PIECE] = 0.8 },
    { [SKIN_PIECE] = 2, [HAIR_PIECE] = 1, [TOP_PIECE] = 1, [UNDER_PIECE] = 0.5, [BOTTOM_PIECE] = 1, [SHOES_PIECE] = 1, [CARRIED_PIECE] = 0.6, [HAT_PIECE] = 0.8 },
    { [SKIN_PIECE] = 1, [HAIR_PIECE] = 1, [TOP_PIECE] = 1, [UNDER_PIECE] = 0.4, [BOTTOM_PIECE] = 1, [SHOES_PIECE] = 1, [CARRIED_PIECE] = 0.6, [HAT_PIECE] = 0.8 }
};
static const size_t triangles[3] = { 12000, 3000, 800 };
static const char *const suffix[3] = { "", "-middle", "-far" };

#define SOLE_SHARE 0.013 /* of stature: what shoes add */

/* The four heaviest, in 255ths. */
static void bind_vertex(struct skin_vertex *v, const struct garment *g, const struct body *body, struct vec3 p)
{
    double w[JOINT_COUNT] = { 0 }, total = 0, kept[4] = { 0 };
    if (g->joint >= 0) w[g->joint] = 1;
    else bind_point(w, body, p, g->drape);
    memset(v->joint, 0, 4);
    memset(v->weight, 0, 4);
    for (int k = 0; k < 4; k++) {
        int best = 0;
        for (int j = 1; j < JOINT_COUNT; j++)
            if (w[j] > w[best]) best = j;
        if (w[best] < 0.004) break;
        v->joint[k] = (uint8_t)best, kept[k] = w[best], total += w[best], w[best] = 0;
    }
    int left = 255;
    for (int k = 3; k > 0; k--) left -= v->weight[k] = (uint8_t)lround(255 * kept[k] / total);
    v->weight[0] = (uint8_t)left;
    for (int k = 0; k < 4; k++)
        if (!v->weight[k]) v->joint[k] = 0;
}

/* Of a point: for the faces that look about where its surface does, and for those beyond an edge. */
struct normals { struct vec3 smooth, beyond; };

static struct vec3 face_of(const struct hull *hull, size_t triangle)
{
    const uint32_t *at = hull->triangle[triangle];
    struct vec3 a = hull->point[at[0]];
    return vec3_cross(vec3_sub(hull->point[at[1]], a), vec3_sub(hull->point[at[2]], a)); /* as long as twice its area */
}

static bool is_beyond(struct vec3 face, struct vec3 normal) { return vec3_dot(face, normal) < 0.15 * vec3_norm(face); }

/* The shape's own normals tell of more than the triangles do, the less so the fewer those are. */
static struct normals *make_normals(const struct hull *hull, const struct wardrobe *wardrobe, int level)
{
    static const double step_m[3] = { 0.002, 0.004, 0.015 }, share[3] = { 0.2, 0.4, 0.7 }; /* of the faces' mean */
    struct normals *made = need(calloc(hull->points + 1, sizeof *made));
    for (size_t c = 0; c < 3 * hull->triangles; c++) {
        struct vec3 *sum = &made[hull->triangle[c / 3][c % 3]].smooth;
        *sum = vec3_add(*sum, face_of(hull, c / 3));
    }
    for (size_t i = 0; i < hull->points; i++) {
        const struct garment *g = &wardrobe->garment[hull->piece[i]];
        struct vec3 own = field_normal(&g->shape, hull->point[i], fmax(step_m[level], 0.4 * g->cell_m)), faces = made[i].smooth;
        double n = vec3_norm(faces);
        faces = n > 0 ? vec3_scale(faces, 1 / n) : own;
        struct vec3 sum = vec3_add(vec3_scale(own, 1 - share[level]), vec3_scale(faces, share[level]));
        made[i].smooth = vec3_norm(sum) > 0.1 ? vec3_unit(sum) : faces;
    }
    for (size_t c = 0; c < 3 * hull->triangles; c++) {
        struct normals *at = &made[hull->triangle[c / 3][c % 3]];
        struct vec3 face = face_of(hull, c / 3);
        if (is_beyond(face, at->smooth)) at->beyond = vec3_add(at->beyond, face);
    }
    return made;
}

static uint16_t add_vertex(struct skin_piece *made, struct vec3 p, struct vec3 normal, enum piece piece, const struct garment *g, const struct person *person,
                           const struct body *body)
{
    struct skin_vertex *v = &made->vertex[made->vertices];
    if (made->vertices > UINT16_MAX) abort();
    *v = (struct skin_vertex){ .position = p, .normal = normal, .uv = texture_place(piece, person, body, p) };
    bind_vertex(v, g, body, p);
    return (uint16_t)made->vertices++;
}

/* All garments of a piece, as one list of vertices. */
static struct skin_piece make_piece(enum piece piece, const struct hull *hull, const struct normals *normals, const struct wardrobe *wardrobe, const struct person *person,
                                    const struct body *body)
{
    struct skin_piece made = { .material = materials[piece].name, .roughness = materials[piece].roughness };
    int32_t(*number)[2] = need(malloc((hull->points + 1) * sizeof *number)); /* of both kinds; -1 as long as there is none */
    memset(number, -1, (hull->points + 1) * sizeof *number);
    made.vertex = need(malloc((2 * hull->points + 1) * sizeof *made.vertex));
    made.index = need(malloc((3 * hull->triangles + 1) * sizeof *made.index));
    for (size_t c = 0; c < 3 * hull->triangles; c++) {
        uint32_t at = hull->triangle[c / 3][c % 3];
        const struct garment *g = &wardrobe->garment[hull->piece[at]];
        if (g->piece != piece) continue;
        struct vec3 face = face_of(hull, c / 3), other = normals[at].beyond;
        int beyond = is_beyond(face, normals[at].smooth);
        if (vec3_norm(other) < 0.1 * vec3_norm(face)) other = face; /* those beyond look away from each other */
        struct vec3 normal = beyond ? vec3_unit(other) : normals[at].smooth;
        if (number[at][beyond] < 0) number[at][beyond] = add_vertex(&made, hull->point[at], normal, piece, g, person, body);
        made.index[made.indices++] = (uint16_t)number[at][beyond];
    }
    free(number);
    return made;
}

static bool write_level(int level, const struct hull *hull, const struct wardrobe *wardrobe, const struct person *person,
                        const struct body *body, const struct clip *clips, const struct texture *texture, const char *folder, struct error *err)
{
    struct skin_piece pieces[PIECE_COUNT];
    struct normals *normals = make_normals(hull, wardrobe, level);
    int count = 0;
    for (int piece = 0; piece < PIECE_COUNT; piece++) {
        pieces[count] = make_piece((enum piece)piece, hull, normals, wardrobe, person, body);
        if (pieces[count].indices) count++;
        else free(pieces[count].vertex), free(pieces[count].index);
    }
    size_t png_size;
    uint8_t *png = texture_png(&png_size, texture, 1 << level);
    struct skin_figure skin = { .name = person->name, .body = body, .piece = pieces, .pieces = count, .clip = clips, .clips = MOTION_COUNT,
                                .png = png, .png_size = png_size };
    char *path = need(string_format("%s/%s%s.glb", folder, person->name, suffix[level]));
    bool good = write_skin_glb(path, &skin, err);
    for (int i = 0; i < count; i++) free(pieces[i].vertex), free(pieces[i].index);
    free(normals);
    free(png);
    free(path);
    return good;
}

static void weigh(double *weight, const struct wardrobe *wardrobe, int level)
{
    for (int i = 0; i < wardrobe->count; i++) weight[i] = weights[level][wardrobe->garment[i].piece];
}

/* Length, width, height of its surface as it begins to stand. */
static struct vec3 standing_size(const struct hull *hull, const struct wardrobe *wardrobe, const struct body *body, const struct clip *stand)
{
    struct pose at[JOINT_COUNT]; /* takes what is bound to a joint there */
    struct vec3 low = vec3(1e9, 1e9, 1e9), high = vec3(-1e9, -1e9, -1e9);
    for (int j = 0; j < JOINT_COUNT; j++) {
        int parent = joint_parent(j);
        struct pose own = { mat3_from_quat(stand->turn[j][0]), parent < 0 ? stand->hips[0] : vec3_sub(body->at[j], body->at[parent]) };
        at[j] = parent < 0 ? own : pose_compose(at[parent], own);
    }
    for (size_t i = 0; i < hull->points; i++) {
        const struct garment *g = &wardrobe->garment[hull->piece[i]];
        struct vec3 p = pose_point(at, body, g, hull->point[i]);
        low = vec3(fmin(low.x, p.x), fmin(low.y, p.y), fmin(low.z, p.z));
        high = vec3(fmax(high.x, p.x), fmax(high.y, p.y), fmax(high.z, p.z));
    }
    return vec3_sub(high, low);
}

static bool list_person(struct listing *listing, const struct person *person, struct vec3 size, const size_t count[3], struct error *err)
{
    static const char *const animations[] = { "walk", "slow_walk", "run", "stand", "halt", NULL };
    char file[3][64];
    for (int level = 0; level < 3; level++) snprintf(file[level], sizeof file[level], "%s%s.glb", person->name, suffix[level]);
    struct listed listed = { .name = person->name, .class_ = "person", .kind = "person", .file = file[0], .middle = file[1], .far = file[2],
                             .length_m = size.x, .width_m = size.y, .height_m = size.z, .triangles = { count[0], count[1], count[2] },
                             .animations = animations, .source = person->measures.age_years < 18
                                 ? "WHO growth reference 2007; Snyder et al. 1977; Drillis and Contini 1966" : "ANSUR II (2012); Drillis and Contini 1966" };
    return listing_add(listing, &listed, err);
}

bool write_person(struct listing *listing, const struct person *person, const char *folder, struct error *err)
{
    struct wardrobe *wardrobe = need(calloc(1, sizeof *wardrobe));
    struct texture *texture = need(malloc(sizeof *texture));
    struct clip *clips = need(calloc(MOTION_COUNT, sizeof *clips));
    struct body body = make_body(&person->measures, SOLE_SHARE * person->measures.stature_m);
    struct hull hull = { 0 };
    wear_shoes(wardrobe, person, &body); /* the first two garments: left and right */
    wear_clothes(wardrobe, person, &body);
    wear_head(wardrobe, person, &body);
    carry(wardrobe, person, &body);
    for (int i = 0; i < wardrobe->count; i++) hull_add_shape(&hull, &wardrobe->garment[i].shape, i, wardrobe->garment[i].cell_m);
    paint_texture(texture, person);

    bool good = true;
    size_t count[3] = { 0 };
    struct vec3 size = { 0 };
    for (int level = 0; good && level < 3; level++) {
        double weight[GARMENTS];
        weigh(weight, wardrobe, level);
        hull_decimate(&hull, triangles[level], weight);
        count[level] = hull.triangles;
        struct sole soles[2] = { sole_create(&body, &hull, 0, 0), sole_create(&body, &hull, 1, 1) };
        for (int motion = 0; motion < MOTION_COUNT; motion++) make_clip(&clips[motion], (enum motion)motion, person, &body, soles);
        for (int side = 0; side < 2; side++) sole_release(&soles[side]);
        if (level == 0) size = standing_size(&hull, wardrobe, &body, &clips[STAND]);
        good = write_level(level, &hull, wardrobe, person, &body, clips, texture, folder, err);
    }
    hull_release(&hull);
    free(wardrobe), free(texture), free(clips);
    return good && list_person(listing, person, size, count, err);
}
