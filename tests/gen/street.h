/* A street seen from above in a photograph that is made pixel by pixel: its light and its shade are known. */
#ifndef STAFFAGE_TESTS_GEN_STREET_H
#define STAFFAGE_TESTS_GEN_STREET_H

#include "gen/scene/scene.h"
#include "gen/world/static_mesh.h"
#include "lib/image.h"
#include "tests/tap.h"

enum { STREET_WIDTH = 600, STREET_HEIGHT = 480 };
#define DEG (M_PI / 180)

static const struct camera lens = { .model = CAMERA_PINHOLE, .width_px = STREET_WIDTH, .height_px = STREET_HEIGHT, .params = { 500, 500, 300, 240 } };

/* From 25 m straight down on (0, 20): a pixel is 5 cm of the ground. */
static inline struct pose above(void)
{
    return (struct pose){ mat3_from_columns(vec3(1, 0, 0), vec3(0, -1, 0), vec3(0, 0, -1)), vec3(0, 20, 25) };
}
static inline struct vec3 ground_at(int x, int y) { return vec3((x + 0.5 - 300) * 0.05, 20 - (y + 0.5 - 240) * 0.05, 0); }

/* What a made photograph shows. */
struct made {
    double ratio[3];               /* of the shade */
    double balance[3];             /* of the camera */
    double haze, visibility_m;     /* 0: none */
    bool (*shade)(struct vec3 p);  /* NULL: the mesh's */
    const struct static_mesh *mesh;
    struct vec3 sun;
};

static inline bool no_shade(struct vec3 p) { (void)p; return false; }
/* A lamp post with its arm, a wall's long edge and a hedge. */
static inline bool street_shade(struct vec3 p)
{
    return (fabs(p.x - 3 - 0.3 * (p.y - 20)) < 0.5 && p.y > 12) || p.x > 9 + 0.1 * p.y || (p.y < 11 && sin(p.x * 1.3) > 0.2);
}

/* Asphalt with grain, tar, paint, a yellow line and a tan sidewalk. */
static inline void albedo_at(double rgb[3], struct vec3 p, uint32_t grain)
{
    double grey = 0.2 * (1 + 0.25 * ((double)(grain >> 16 & 255) / 255 - 0.5));
    if (fabs(p.x + 6 - sin(p.y)) < 0.35) grey *= 0.55;
    if (p.y > 24 && p.y < 27 && fmod(p.x + 40, 2) < 0.8) grey = 0.5;
    rgb[0] = rgb[1] = rgb[2] = grey;
    if (fabs(p.y - 15) < 0.3) rgb[2] *= 0.25;
    if (p.x < -11) {
        rgb[0] = 0.4;
        rgb[1] = 0.34;
        rgb[2] = 0.25;
    }
}

static inline bool is_shaded(const struct made *m, struct vec3 p)
{
    return m->shade ? m->shade(p) : static_mesh_blocks(m->mesh, p, m->sun, 0.01, 1000);
}

/* Out: *srgb, the caller's */
static inline void make_image(struct image *srgb, const struct made *m)
{
    struct error err = ERROR_NONE;
    struct image linear;
    uint32_t grain = 7;
    if (!image_init(&linear, STREET_WIDTH, STREET_HEIGHT, 3, PIXEL_F32, &err)) abort();
    for (int y = 0; y < STREET_HEIGHT; y++)
        for (int x = 0; x < STREET_WIDTH; x++) {
            struct vec3 p = ground_at(x, y);
            double rgb[3], open = 0, through = m->haze > 0 ? pow(0.05, hypot(25, hypot(p.x, p.y - 20)) / m->visibility_m) : 1;
            grain = grain * 1664525u + 1013904223u;
            albedo_at(rgb, p, grain);
            /* Penumbra, 15 cm wide. */
            for (int i = -1; i <= 1; i++)
                for (int k = -1; k <= 1; k++) open += !is_shaded(m, vec3(p.x + 0.05 * i, p.y + 0.05 * k, 0)) / 9.0;
            for (int c = 0; c < 3; c++) {
                double light = open + (1 - open) * m->ratio[c];
                image_f32(&linear, x, y)[c] = (float)(through * 1.6 * m->balance[c] * rgb[c] * light + (1 - through) * m->haze);
            }
        }
    if (!image_srgb_from_linear(srgb, &linear, &err)) abort();
    image_release(&linear);
}

/* A scene about it, without a file. */
static inline struct scene scene_of(struct scene_camera *camera, struct scene_shot *shot, char *photograph)
{
    static char path[] = "scene.yaml";
    *camera = (struct scene_camera){ .camera = lens };
    *shot = (struct scene_shot){ .photograph = photograph, .world_from_camera = above() };
    return (struct scene){ .path = path, .cameras = camera, .camera_count = 1, .shots = shot, .shot_count = 1, .sky = SKY_AUTO,
                           .light_source = { 8, 8 }, .sun = SUN_GIVEN, .sun_azimuth_rad = 200 * DEG, .sun_elevation_rad = 40 * DEG,
                           .ground = { { 0, 0, 1 }, 0 }, .ground_albedo = { 0.2, 0.2, 0.2 }, .exposure_of_ground = true, .scale = 1 };
}

#endif
