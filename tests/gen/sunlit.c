/* The pixels that the exposure is fitted to: road, seen, in the sun. A wall's shadow and what it hides, by geometry. */
#include "gen/sunlit.h"

#include "tests/gen/place.h"
#include "tests/tap.h"

/* Straight down from 60 m: a pixel is 0.25 m of the ground. */
static const struct camera camera = { .model = CAMERA_PINHOLE, .width_px = 240, .height_px = 200, .params = { 240, 240, 120, 100 } };
static struct pose above(void)
{
    return (struct pose){ mat3_from_columns(vec3(1, 0, 0), vec3(0, -1, 0), vec3(0, 0, -1)), vec3(0, 20, 60) };
}
static struct vec2 ground_of(struct vec2 q) { return (struct vec2){ (q.x - 120) / 4, 20 - (q.y - 100) / 4 }; }

static struct way *road(struct road_network *roads, const char *name, enum road_use use, double x, double width)
{
    struct error err = ERROR_NONE;
    const struct vec2 line[] = { { x, -40 }, { x, 100 } };
    const struct road_rules rules = { .side = DRIVE_RIGHT };
    if (!OK(roads_add(roads, name, use, line, 2, width, false, &rules, &err), "%s", name)) return NULL;
    return &roads->ways[roads->way_count - 1];
}

static struct vec2 *sunlit(size_t *n, const struct stage *stage, const struct light *light)
{
    struct error err = ERROR_NONE;
    struct vec2 *q = NULL;
    *n = 0;
    bool ok = sunlit_pixels(&q, n, stage, light, &camera, above(), &err);
    OK(ok, "%zu pixels %s", *n, err.text);
    return q;
}

/* From the south and 10 m high, the wall hides the road to where the sight over it comes down: y = 80. */
static void check_hidden(struct stage *stage, struct light *light)
{
    struct error err = ERROR_NONE;
    struct vec3 eye = { 0, -20, 10 }, ahead = vec3_unit(vec3_sub(vec3(0, 20, 0), eye));
    const struct pose low = { mat3_from_columns(vec3(1, 0, 0), vec3_cross(ahead, vec3(1, 0, 0)), ahead), eye };
    const struct plane level = { { 0, 0, 1 }, 0 };
    struct vec2 *q = NULL;
    size_t n = 0, near = 0, hidden = 0;
    light->has_sun = false;
    stage->roads = (struct road_network){ 0 };
    road(&stage->roads, "street", ROAD_VEHICLES, 0, 6);
    OK(sunlit_pixels(&q, &n, stage, light, &camera, low, &err), "a camera before the wall");
    for (size_t i = 0; i < n; i++) {
        struct vec3 p;
        if (!ground_from_pixel(&p, &level, &camera, low, q[i], &err)) continue;
        near += p.y < 19.5;
        hidden += p.y > 20.5 && p.y < 79.5;
    }
    OK(near > 50, "sees the road before it");
    OK(hidden == 0, "road behind it is not taken");
    free(q);
    roads_release(&stage->roads);
    stage->roads = (struct road_network){ 0 };
}

int main(void)
{
    struct error err = ERROR_NONE;
    struct place place = { 0 };
    struct static_mesh *mesh = NULL;
    /* A wall across a road along y, at y = 20, 6 m high; the sun in the south, 45 deg high: its shadow is 6 m of road,
     * from y = 20 to 26. */
    place_ground(&place, 0, 0);
    place_wall(&place, -10, 10, 20, 0, 6, 0);
    if (!OK(place_mesh(&mesh, &place, false, &err), "a place %s", err.text)) return tap_done();
    struct stage stage = { .mesh = mesh, .surface = { .has_mesh = true, .mesh = mesh } };
    struct light light = { .has_sun = true, .sun_direction = { 0, -sqrt(0.5), sqrt(0.5) } };
    road(&stage.roads, "street", ROAD_VEHICLES, 0, 6);

    size_t n;
    struct vec2 *q = sunlit(&n, &stage, &light);
    size_t shaded = 0, beside = 0, behind = 0, outside = 0;
    double low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < n; i++) {
        struct vec2 p = ground_of(q[i]);
        shaded += p.y > 20 && p.y < 26;
        beside += fabs(p.x) > 3;
        behind += p.y > 26;
        outside += q[i].x < 0 || q[i].y < 0 || q[i].x >= 240 || q[i].y >= 200;
        low = fmin(low, p.y);
        high = fmax(high, p.y);
    }
    OK(n > 100, "road is seen in the sun");
    OK(shaded == 0, "none in the wall's shadow");
    OK(behind > 20, "beyond the shadow, there is sun again");
    OK(beside == 0 && outside == 0, "all on the road and in the picture");
    OK(low < -3.5 && high > 43, "from one end of what is seen to the other (%.1f to %.1f)", low, high);
    free(q);

    light.has_sun = false;
    q = sunlit(&n, &stage, &light);
    shaded = 0;
    for (size_t i = 0; i < n; i++) shaded += ground_of(q[i]).y > 20.5 && ground_of(q[i]).y < 25.5;
    OK(shaded > 10, "under clouds, behind a wall is no worse than elsewhere");
    free(q);

    /* A footway counts where there is no road. */
    light.has_sun = true;
    road(&stage.roads, "footway", ROAD_PEOPLE, 15, 2);
    q = sunlit(&n, &stage, &light);
    beside = 0;
    for (size_t i = 0; i < n; i++) beside += fabs(ground_of(q[i]).x) > 3;
    OK(n > 100 && beside == 0, "footways do not count beside roads");
    free(q);
    roads_release(&stage.roads);
    stage.roads = (struct road_network){ 0 };
    road(&stage.roads, "footway", ROAD_PEOPLE, 15, 2);
    q = sunlit(&n, &stage, &light);
    beside = 0;
    for (size_t i = 0; i < n; i++) beside += fabs(ground_of(q[i]).x - 15) > 1;
    OK(n > 100 && beside == 0, "alone they do");
    free(q);
    roads_release(&stage.roads);

    /* From the south and 10 m high, the wall hides the road to where the sight over it comes down: y = 80. */
    check_hidden(&stage, &light);
    static_mesh_destroy(mesh);

    /* More road than is wanted: taken evenly, no more than is promised. */
    stage.mesh = NULL;
    stage.surface = (struct surface){ .plane = { { 0, 0, 1 }, 0 } };
    for (int i = 0; i < 12; i++) road(&stage.roads, "lane", ROAD_VEHICLES, -22 + 4 * i, 3);
    q = sunlit(&n, &stage, &light);
    size_t west = 0, east = 0;
    for (size_t i = 0; i < n; i++) (ground_of(q[i]).x < 0 ? &west : &east)[0]++;
    OK(n == SUNLIT_MAX, "a plane with many roads: as many as promised");
    OK(west > SUNLIT_MAX / 3 && east > SUNLIT_MAX / 3, "over all of them (%zu, %zu)", west, east);
    free(q);
    roads_release(&stage.roads);
    place_free(&place);
    return tap_done();
}
