/* What a look round a place hides: a wall behind a board, and a shelf on it. */
#include "gen/light/hidden_place.h"

#include "lib/image.h"
#include "tests/gen/place.h"
#include "tests/tap.h"

#define WALL_Y 12.0
#define BOARD_Y 5.0
#define CELL_M 0.5
#define SHELF_Z 3.0
#define STEP_Y 1.0

static const struct vec3 from = { 0, 0, 2.2 };
static const double gain[3] = { 2, 1, 0.5 };

/* Each spot has its own colour. */
static void spotted(uint8_t srgb[3], const float p[3])
{
    srgb[0] = (uint8_t)(20 + 3 * lrintf((p[0] + 8) / (float)CELL_M));
    srgb[1] = (uint8_t)(20 + 20 * lrintf(p[2] / (float)CELL_M));
    srgb[2] = (uint8_t)(40 + 10 * lrintf(p[1] / (float)CELL_M));
}

/* Open ground as far as a wall. */
static void open_place(struct place *place)
{
    place->paint = spotted;
    place_grid(place, vec3(-8, 0, 0), vec3(1, 0, 0), vec3(0, 1, 0), 38, (int)WALL_Y);
    place_grid(place, vec3(-8, WALL_Y, 0), vec3(CELL_M, 0, 0), vec3(0, 0, CELL_M), 76, 8);
}

/* How many faces stand where. */
struct count { size_t behind, beside, shelf, step, ground, far; };

static bool on_plane(const struct static_cut *part, const uint32_t triangle[3], int axis, double at)
{
    for (int k = 0; k < 3; k++)
        if (fabs((double)part->position_m[triangle[k]][axis] - at) > 1e-3) return false;
    return true;
}

/* In: edge_m  half of what the board hides of the wall, across */
static struct count count_faces(const struct static_cut *part, double edge_m)
{
    struct count n = { 0 };
    for (size_t i = 0; i < part->triangles; i++) {
        const uint32_t *t = part->triangle[i];
        double x = 0, away = INFINITY;
        for (int k = 0; k < 3; k++) {
            const float *p = part->position_m[t[k]];
            x += (double)p[0] / 3;
            away = fmin(away, hypot((double)p[0], (double)p[1]));
        }
        n.far += away > HIDDEN_PLACE_REACH_M;
        n.ground += on_plane(part, t, 2, 0);
        n.step += on_plane(part, t, 1, STEP_Y);
        n.shelf += on_plane(part, t, 2, SHELF_Z);
        if (on_plane(part, t, 1, WALL_Y)) *(fabs(x) < edge_m ? &n.behind : &n.beside) += 1;
    }
    return n;
}

/* The most that a texel is off its face's colour, as painted. */
static double worst_color(const struct hidden_place *hidden)
{
    double worst = 0;
    for (size_t i = 0; i < hidden->part.triangles; i++) {
        const float *texel = image_f32(&hidden->radiance, (int)(i % HIDDEN_PLACE_COLUMNS), (int)(i / HIDDEN_PLACE_COLUMNS));
        double want[3] = { 0, 0, 0 };
        for (int k = 0; k < 3; k++) {
            uint8_t srgb[3];
            spotted(srgb, hidden->part.position_m[hidden->part.triangle[i][k]]);
            for (int c = 0; c < 3; c++) want[c] += gain[c] * (double)linear_from_srgb((float)srgb[c] / 255) / 3;
        }
        for (int c = 0; c < 3; c++) worst = fmax(worst, fabs((double)texel[c] - want[c]));
    }
    return worst;
}

static bool has_room(const struct hidden_place *hidden)
{
    const struct image *r = &hidden->radiance;
    return r->data && r->width_px == HIDDEN_PLACE_COLUMNS && r->height_px >= 1 && (size_t)r->height_px * HIDDEN_PLACE_COLUMNS >= hidden->part.triangles;
}

static void test_nothing(const struct entity *entity)
{
    struct error err = ERROR_NONE;
    struct place place = { 0 };
    struct static_mesh *mesh = NULL;
    struct hidden_place hidden;
    open_place(&place);
    if (!OK(place_mesh(&mesh, &place, false, &err), "open ground and a wall")) return;
    for (size_t n = 0; n < 2; n++) {
        struct relief_input in = { .place = mesh, .from_m = from, .entities = entity, .n = n };
        if (!OK(hidden_place_create(&hidden, &in, gain, &err), "with %zu entities", n)) continue;
        OK(hidden.part.triangles == 0, "nothing is hidden (%zu)", hidden.part.triangles);
        OK(has_room(&hidden), "a picture of it is there all the same");
        hidden_place_release(&hidden);
    }
    static_mesh_destroy(mesh);
    place_free(&place);
}

static void test_near(const struct relief_input *in)
{
    struct error err = ERROR_NONE;
    struct hidden_place hidden;
    if (!OK(hidden_place_create(&hidden, in, gain, &err), "what is hidden round an entity")) return;
    struct count n = count_faces(&hidden.part, 1 * WALL_Y / BOARD_Y);
    /* The middles of the faces of 10 columns and 8 rows, 2 to a cell, are within. */
    OK(n.behind == 160, "the wall behind the board is hidden, all of it (%zu faces)", n.behind);
    OK(n.beside == 0, "beside the board it is not (%zu)", n.beside);
    OK(n.shelf == 16, "a shelf behind the board and above the look is hidden, too (%zu)", n.shelf);
    OK(n.ground == 0, "level ground behind the board is not on it (%zu)", n.ground);
    OK(n.step == 4, "what stands lower than the relief goes is on it, though it is seen (%zu)", n.step);
    OK(n.far == 0, "nor is what is farther away than its reach (%zu)", n.far);
    OK(hidden.part.triangles == n.behind + n.shelf + n.step, "and nothing else (%zu)", hidden.part.triangles);
    OK(has_room(&hidden), "each face has a texel");
    NEAR(worst_color(&hidden), 0, 1e-4, "its colour is the place's, by the gain");
    hidden_place_release(&hidden);
}

/* A second board hides the wall from 19.2 to 28.8 m aside: near the second entity alone. */
static void test_far(const struct relief_input *in)
{
    struct error err = ERROR_NONE;
    struct hidden_place hidden;
    if (!OK(hidden_place_create(&hidden, in, gain, &err), "what is hidden round two")) return;
    struct count n = count_faces(&hidden.part, 1 * WALL_Y / BOARD_Y);
    OK(n.behind == 160 && n.far > 270, "also what is far from the first and near the second (%zu faces)", n.far);
    OK(n.ground == 0 && hidden.part.triangles == n.behind + n.beside + n.shelf + n.step, "no ground");
    OK(hidden.part.triangles > HIDDEN_PLACE_COLUMNS && has_room(&hidden), "more than a row of texels (%zu)", hidden.part.triangles);
    NEAR(worst_color(&hidden), 0, 1e-4, "each with its face's colour");
    hidden_place_release(&hidden);
}

int main(void)
{
    struct error err = ERROR_NONE;
    struct place place = { 0 };
    struct static_mesh *mesh = NULL;
    struct entity entities[] = { { .world_from_entity = pose_identity() }, { .world_from_entity = pose_identity() } };
    entities[1].world_from_entity.translation = vec3(20, 0, 0);
    test_nothing(entities);
    open_place(&place);
    place_wall(&place, -1, 1, BOARD_Y, 0, 3, 0);
    place_wall(&place, 8, 12, BOARD_Y, 0, 3, 0);
    place_grid(&place, vec3(-1, WALL_Y - 1, SHELF_Z), vec3(CELL_M, 0, 0), vec3(0, CELL_M, 0), 4, 2);
    place_grid(&place, vec3(-CELL_M, STEP_Y, 0), vec3(CELL_M, 0, 0), vec3(0, 0, CELL_M), 2, 1);
    if (!OK(place_mesh(&mesh, &place, false, &err), "a place with boards before the wall")) return tap_done();
    struct relief_input in = { .place = mesh, .from_m = from, .entities = entities, .n = 1 };
    test_near(&in);
    in.n = 2;
    test_far(&in);
    static_mesh_destroy(mesh);
    place_free(&place);
    return tap_done();
}
