#include "cast/figure.h"

#include "cast/hull.h"
#include "cast/motion.h"
#include "cast/person.h"
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

static void *need(void *memory)
{
    if (!memory) abort();
    return memory;
}

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

/* All garments of a piece, as one list of vertices. */
static struct skin_piece make_piece(enum piece piece, const struct hull *hull, const struct wardrobe *wardrobe, const struct body *body, double step_m)
{
    struct skin_piece made = { .material = materials[piece].name, .roughness = materials[piece].roughness };
    uint16_t *number = need(calloc(hull->points + 1, sizeof *number));
    made.vertex = need(malloc((hull->points + 1) * sizeof *made.vertex));
    made.index = need(malloc((3 * hull->triangles + 1) * sizeof *made.index));
    for (size_t i = 0; i < hull->points; i++) {
        const struct garment *g = &wardrobe->garment[hull->piece[i]];
        if (g->piece != piece) continue;
        struct skin_vertex *v = &made.vertex[made.vertices];
        if (made.vertices > UINT16_MAX) abort();
        number[i] = (uint16_t)made.vertices++;
        *v = (struct skin_vertex){ .position = hull->point[i], .normal = field_normal(&g->shape, hull->point[i], fmax(step_m, 0.4 * g->cell_m)),
                                   .uv = texture_place(piece, body, hull->point[i]) };
        bind_vertex(v, g, body, hull->point[i]);
    }
    for (size_t c = 0; c < 3 * hull->triangles; c++) {
        uint32_t at = hull->triangle[c / 3][c % 3];
        if (wardrobe->garment[hull->piece[at]].piece == piece) made.index[made.indices++] = number[at];
    }
    free(number);
    return made;
}

static bool write_level(int level, const struct hull *hull, const struct wardrobe *wardrobe, const struct person *person,
                        const struct body *body, const struct clip *clips, const struct texture *texture, const char *folder, struct error *err)
{
    struct skin_piece pieces[PIECE_COUNT];
    static const double step_m[3] = { 0.002, 0.006, 0.015 };
    int count = 0;
    for (int piece = 0; piece < PIECE_COUNT; piece++) {
        pieces[count] = make_piece((enum piece)piece, hull, wardrobe, body, step_m[level]);
        if (pieces[count].indices) count++;
        else free(pieces[count].vertex), free(pieces[count].index);
    }
    size_t png_size;
    uint8_t *png = texture_png(&png_size, texture, 1 << level);
    struct skin_figure skin = { .name = person->name, .body = body, .piece = pieces, .pieces = count, .clip = clips, .clips = MOTION_COUNT,
                                .png = png, .png_size = png_size };
    char *path = string_format("%s/%s%s.glb", folder, person->name, suffix[level]);
    bool good = path && write_skin_glb(path, &skin, err);
    for (int i = 0; i < count; i++) free(pieces[i].vertex), free(pieces[i].index);
    free(png);
    free(path);
    return good;
}

static void weigh(double *weight, const struct wardrobe *wardrobe, int level)
{
    for (int i = 0; i < wardrobe->count; i++) weight[i] = weights[level][wardrobe->garment[i].piece];
}

/* Standing, arms down: as long and as wide as it is from near. */
static struct vec3 standing_size(const struct hull *hull, const struct body *body)
{
    struct vec3 low = hull->point[0], high = low;
    for (size_t i = 0; i < hull->points; i++) {
        struct vec3 p = hull->point[i];
        low = vec3(fmin(low.x, p.x), fmin(low.y, p.y), fmin(low.z, p.z));
        high = vec3(fmax(high.x, p.x), fmax(high.y, p.y), fmax(high.z, p.z));
    }
    double lowered = 2 * (body->at[LIMB(0, HAND)].y - body->trunk.station[2].side - 0.05); /* from where the arms are bound */
    return vec3(high.x - low.x, high.y - low.y - lowered, high.z - low.z);
}

static bool list_person(struct listing *listing, const struct person *person, struct vec3 size, const size_t count[3], struct error *err)
{
    static const char *const animations[] = { "walk", "slow_walk", "run", "stand", NULL };
    char file[3][64];
    for (int level = 0; level < 3; level++) snprintf(file[level], sizeof file[level], "%s%s.glb", person->name, suffix[level]);
    struct listed listed = { .name = person->name, .class_ = "person", .kind = "person", .file = file[0], .middle = file[1], .far = file[2],
                             .length_m = size.x, .width_m = size.y, .height_m = size.z, .triangles = { count[0], count[1], count[2] },
                             .animations = animations, .source = person->measures.age_years < 18
                                 ? "WHO growth reference 2007; Snyder et al. 1977; Drillis and Contini 1966" : "ANSUR II (2012); Drillis and Contini 1966" };
    return listing_add(listing, &listed, err);
}

static bool write_person(struct listing *listing, const struct person *person, const char *folder, struct error *err)
{
    struct wardrobe *wardrobe = need(calloc(1, sizeof *wardrobe));
    struct texture *texture = need(malloc(sizeof *texture));
    struct clip *clips = need(calloc(MOTION_COUNT, sizeof *clips));
    struct body body = make_body(&person->measures, SOLE_SHARE * person->measures.stature_m);
    struct hull hull = { 0 };
    wear_shoes(wardrobe, person, &body); /* the left one is the first garment */
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
        if (level == 0) size = standing_size(&hull, &body);
        struct sole sole = sole_create(&body, &hull, 0);
        for (int motion = 0; motion < MOTION_COUNT; motion++) make_clip(&clips[motion], (enum motion)motion, person, &body, &sole);
        sole_release(&sole);
        good = write_level(level, &hull, wardrobe, person, &body, clips, texture, folder, err);
    }
    hull_release(&hull);
    free(wardrobe), free(texture), free(clips);
    return good && list_person(listing, person, size, count, err);
}

bool write_people(struct listing *listing, const char *folder, struct error *err)
{
    for (int i = 0; i < people_count; i++)
        if (!write_person(listing, &people[i], folder, err)) return false;
    return true;
}
