#include "gen/light/panorama.h"

#include "gen/light/push_pull.h"
#include "gen/light/relief.h"
#include "gen/light/sky_image.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 1024, FINE = 2 };   /* FINE: samples along a side of a pixel that shows something of the picture */
#define STEP_RAD (0.5 * M_PI / 180)
#define TOP_SHARE 0.7 /* higher up the sides of a picture show less */
#define OFF_PLACE_M 0.3
#define SKY_FAR_M 1e5
#define GROUND_RISE 0.02 /* a level face counts as ground where it lies no higher than this share of how far away it is */
#define GROUND_STEP 0.3  /* of what is met next, in the ground that goes on past the place */
enum { AZIMUTHS = 24 };

/* The circle on which stands what the picture shows beyond its ground. */
struct wall {
    bool there;
    double upright[AZIMUTHS][3];   /* irradiance / pi of an upright surface that faces an azimuth */
    double radius_m, forward_rad;  /* azimuth, from +x towards +y, of the camera's look */
    double left_rad, right_rad;    /* how far to both sides the picture shows it, from the height of a body to near its top */
};

static struct vec3 wall_point(const struct panorama_input *in, const struct wall *wall, double aside_rad, double z_m)
{
    struct vec3 eye = in->seen->world_from_camera.translation;
    double turn = wall->forward_rad + aside_rad;
    return vec3(eye.x + wall->radius_m * cos(turn), eye.y + wall->radius_m * sin(turn), z_m);
}

static bool shown(const struct panorama_input *in, const struct wall *wall, double aside_rad, double z_m)
{
    struct vec2 q;
    return seen_project(in->seen, &q, wall_point(in, wall, aside_rad, z_m)) && seen_within(in->seen, q) > 0.5;
}

static double shown_to_side(const struct panorama_input *in, const struct wall *wall, double sign, double top_m)
{
    double aside = 0;
    while (aside < M_PI && shown(in, wall, sign * aside, in->from_m.z) && shown(in, wall, sign * aside, top_m)) aside += STEP_RAD;
    return aside - STEP_RAD;
}

static struct wall raise_wall(const struct panorama_input *in)
{
    struct vec3 forward = mat3_column(in->seen->world_from_camera.rotation, 2), eye = in->seen->world_from_camera.translation;
    struct wall wall = { .forward_rad = atan2(forward.y, forward.x) };
    double away = hypot(in->from_m.x - eye.x, in->from_m.y - eye.y), top = in->from_m.z;
    wall.radius_m = fmax(seen_ground_reach(in->seen, in->height_m), 1.25 * away);
    while (top < in->from_m.z + wall.radius_m && shown(in, &wall, 0, top)) top += wall.radius_m * STEP_RAD;
    top = in->from_m.z + TOP_SHARE * (top - in->from_m.z);
    wall.left_rad = shown_to_side(in, &wall, 1, top);
    wall.right_rad = shown_to_side(in, &wall, -1, top);
    wall.there = wall.left_rad > 0 && wall.right_rad > 0;
    for (int i = 0; wall.there && i < AZIMUTHS; i++)
        light_irradiance(wall.upright[i], in->light, vec3(cos(2 * M_PI * i / AZIMUTHS), sin(2 * M_PI * i / AZIMUTHS), 0));
    return wall;
}

/* An angle beside the picture, as one inside: the rest of the circle is the picture back and forth, an odd number of
 * times, so that it joins at both sides. */
static double fold(const struct wall *wall, double aside)
{
    double span = wall->left_rad + wall->right_rad, rest = 2 * M_PI - span;
    double at = fmod(aside + wall->right_rad + 4 * M_PI, 2 * M_PI) - wall->right_rad - wall->left_rad;
    if (at <= 0) return at + wall->left_rad;
    double times = 2 * floor(rest / span / 2) + 1, turns = at / rest * times, whole = floor(turns), part = turns - whole;
    return fmod(whole, 2) == 0 ? wall->left_rad - part * span : part * span - wall->right_rad;
}

/* Where a direction meets the wall: how far aside, and how high. */
static void meet_wall(double *aside_rad, double *z_m, const struct panorama_input *in, const struct wall *wall, struct vec3 d)
{
    struct vec3 eye = in->seen->world_from_camera.translation;
    double level = hypot(d.x, d.y), ux = d.x / level, uy = d.y / level, x = in->from_m.x - eye.x, y = in->from_m.y - eye.y;
    double along = x * ux + y * uy, way = -along + sqrt(along * along - (x * x + y * y) + wall->radius_m * wall->radius_m);
    *aside_rad = atan2(y + way * uy, x + way * ux) - wall->forward_rad;
    *z_m = in->from_m.z + way * d.z / level;
}

static void upright_irradiance(double rgb[3], const struct wall *wall, double azimuth_rad)
{
    double at = azimuth_rad / (2 * M_PI), part = (at - floor(at)) * AZIMUTHS;
    int i = (int)part % AZIMUTHS;
    for (int c = 0; c < 3; c++) rgb[c] = wall->upright[i][c] + (part - floor(part)) * (wall->upright[(i + 1) % AZIMUTHS][c] - wall->upright[i][c]);
}

/* What stands elsewhere on the circle is lit as the side that faces its middle there. */
static void turned_light(double gain[3], const struct wall *wall, double aside_rad, double shown_aside_rad)
{
    double here[3], there[3];
    upright_irradiance(here, wall, wall->forward_rad + aside_rad + M_PI);
    upright_irradiance(there, wall, wall->forward_rad + shown_aside_rad + M_PI);
    for (int c = 0; c < 3; c++) gain[c] = here[c] / fmax(there[c], 1e-6);
}

/* A sky between the middles of its pixels; the ground's half is not mixed in. */
static void sky_between(double rgb[3], const struct image *sky, struct vec3 d)
{
    double turn = atan2(d.y, d.x) / (2 * M_PI), fx = (turn - floor(turn)) * sky->width_px - 0.5;
    double fy = fmin(fmax((0.5 - asin(fmin(1, fmax(-1, d.z))) / M_PI) * sky->height_px - 0.5, 0), sky->height_px / 2 - 1);
    int x = (int)floor(fx), y = (int)fy, below = y + 1 < sky->height_px / 2 ? y + 1 : y;
    double u = fx - x, v = fy - y;
    int left = (x + sky->width_px) % sky->width_px, right = (x + 1) % sky->width_px;
    for (int c = 0; c < 3; c++)
        rgb[c] = (1 - v) * ((1 - u) * (double)image_f32(sky, left, y)[c] + u * (double)image_f32(sky, right, y)[c]) +
                 v * ((1 - u) * (double)image_f32(sky, left, below)[c] + u * (double)image_f32(sky, right, below)[c]);
}

/* As bright and as blue as half of the sky's own. */
static bool like_sky(const double shown[3], const double sky[3])
{
    return shown[1] > 0.5 * sky[1] && shown[2] * shown[2] * sky[0] > shown[0] * shown[0] * sky[2];
}

/* A look in a direction. */
struct sight {
    double rgb[3];   /* radiance */
    double known;    /* 0: something hides it */
    bool open;       /* in a column, from the horizon upward: the picture showed the sky, and what stands around ends below */
    bool has_ground; /* in a column, from below: level ground was met, the farthest of this radiance: */
    double ground[3];
};

/* Mix what the picture shows at a pixel position in.
 * In: sky  the open sky there, NULL: it is below the horizon; clipped light is at least as bright as the sky behind it
 *     gain  of what is not sky; NULL: 1
 *     closed  no sky is to be seen there */
static double mix_picture(struct sight *sight, const struct seen *seen, struct vec2 q, const double *sky, const double *gain, bool closed)
{
    double shown[3], trust = seen_within(seen, q);
    if (trust <= 0) return 0;
    bool hidden = seen_hidden(seen, q), clipped = seen_radiance(seen, shown, q), of_sky = sky && (clipped || like_sky(shown, sky));
    if (of_sky && closed) return 0;
    if (hidden) sight->known = 0;
    else if (sky) sight->open = of_sky;
    for (int c = 0; c < 3; c++) {
        if (gain && !of_sky) shown[c] *= gain[c];
        if (clipped && sky) shown[c] = fmax(shown[c], sky[c]);
        sight->rgb[c] += trust * (shown[c] - sight->rgb[c]);
    }
    return trust;
}

static double ground_height(const struct panorama_input *in) { return in->seen->world_from_camera.translation.z - in->height_m; }

/* Where a look begins: above the ground. */
static struct vec3 look_from(const struct panorama_input *in, struct vec3 d)
{
    double above_m = in->from_m.z - ground_height(in) - OFF_PLACE_M, way = in->beyond_m;
    if (d.z < 0) way = fmin(way, fmax(0, above_m / -d.z));
    return vec3_add(in->from_m, vec3_scale(d, way));
}

/* Does the picture show a point of the place, and where? */
static bool is_shown(const struct panorama_input *in, struct vec2 *q, struct vec3 p, struct vec3 normal)
{
    struct vec3 to_eye = vec3_sub(in->seen->world_from_camera.translation, p);
    double range = vec3_norm(to_eye);
    return seen_project(in->seen, q, p) && !seen_hidden(in->seen, *q) && !seen_beside_nearer(in->seen, in->place_depth, *q, p, normal) &&
           !static_mesh_blocks(in->place, p, vec3_scale(to_eye, 1 / range), OFF_PLACE_M, range);
}

/* Ground goes on as what was met last, a little of it at a time: a rough end makes no streaks. */
static void keep_ground(struct sight *sight)
{
    if (sight->known <= 0) return;
    for (int c = 0; c < 3; c++) sight->ground[c] = sight->has_ground ? sight->ground[c] + GROUND_STEP * (sight->rgb[c] - sight->ground[c]) : sight->rgb[c];
    sight->has_ground = true;
}

/* Level, and no higher than ground gets to be with the distance. */
static bool is_ground(const struct panorama_input *in, struct vec3 p, struct vec3 normal)
{
    double away = hypot(p.x - in->from_m.x, p.y - in->from_m.y);
    return fabs(normal.z) > RELIEF_LEVEL && p.z < ground_height(in) + OFF_PLACE_M + GROUND_RISE * away;
}

/* What the place shows in a direction. False where it is open. */
static bool of_place(struct sight *sight, const struct panorama_input *in, struct vec3 d)
{
    struct static_hit hit;
    struct vec2 q;
    float own[3];
    struct vec3 from = look_from(in, d);
    static_mesh_hits(in->place, &hit, from, &d, 1);
    if (!isfinite(hit.range_m)) return false;
    static_mesh_color(in->place, own, &hit, (vec3_norm(vec3_sub(from, in->from_m)) + hit.range_m) * 2 * M_PI / WIDTH);
    for (int c = 0; c < 3; c++) sight->rgb[c] = (double)own[c] * in->color_gain[c];
    struct vec3 p = vec3_add(from, vec3_scale(d, hit.range_m)), normal = static_mesh_normal(in->place, hit.triangle);
    if (is_shown(in, &q, p, normal)) mix_picture(sight, in->seen, q, NULL, NULL, false);
    if (d.z < 0 && is_ground(in, p, normal)) keep_ground(sight);
    return true;
}

/* Does the picture show the place at a pixel position, or at one that is mixed with it? */
static bool shows_place(const struct image *place_depth, struct vec2 q)
{
    for (int k = 0; k < 4; k++) {
        int x = (int)floor(q.x + (k & 1 ? 0.5 : -0.5)), y = (int)floor(q.y + (k & 2 ? 0.5 : -0.5));
        bool inside = x >= 0 && y >= 0 && x < place_depth->width_px && y < place_depth->height_px;
        if (inside && isfinite((double)*image_f32(place_depth, x, y))) return true;
    }
    return false;
}

/* Rays tell what is of a place: what the picture shows past it stands round it, and level ground goes on till there. */
static bool past_place(struct sight *sight, const struct panorama_input *in, struct vec3 d, const double *sky)
{
    double way = in->past_m / hypot(d.x, d.y);
    struct vec2 q;
    if (d.z < 0) way = fmin(way, (in->from_m.z - ground_height(in)) / -d.z);
    if (!(way > 0)) return false;
    struct vec3 p = vec3_add(in->from_m, vec3_scale(d, fmin(way, SKY_FAR_M)));
    if (!seen_project(in->seen, &q, p) || shows_place(in->place_depth, q)) return false;
    /* Below the camera, what it shows is no sky. */
    return mix_picture(sight, in->seen, q, p.z > in->seen->world_from_camera.translation.z ? sky : NULL, NULL, false) > 0;
}

/* Ground that no ray met: as where the place ends, or else the light's own. Returns whether the picture shows it. */
static bool below(struct sight *sight, const struct panorama_input *in, struct vec3 d)
{
    const float *ground = image_f32(&in->light->sky, 0, in->light->sky.height_px - 1);
    for (int c = 0; c < 3; c++) sight->rgb[c] = sight->has_ground ? sight->ground[c] : (double)ground[c];
    if (!in->place || !past_place(sight, in, d, NULL)) return false;
    keep_ground(sight);
    return true;
}

/* Returns whether it is other than the light's sky. */
static bool look(struct sight *sight, const struct panorama_input *in, const struct wall *wall, struct vec3 d)
{
    struct vec2 q;
    double aside, z, gain[3], sky[3];
    sight->known = 1;
    if (in->place && of_place(sight, in, d)) return true;
    if (d.z < 0) return below(sight, in, d);
    sky_between(sky, &in->light->open_sky, d);
    sky_between(sight->rgb, &in->light->sky, d);
    bool closed = in->told && sight->rgb[1] != sky[1];
    if (sight->open) memcpy(sight->rgb, sky, sizeof sky);
    if (in->place) return past_place(sight, in, d, sky);
    if (!wall->there || hypot(d.x, d.y) < 0.1) return false;
    meet_wall(&aside, &z, in, wall, d);
    double shown_aside = fold(wall, aside);
    if (!seen_project(in->seen, &q, wall_point(in, wall, shown_aside, z))) return false;
    turned_light(gain, wall, aside, shown_aside);
    bool elsewhere = fabs(remainder(aside - shown_aside, 2 * M_PI)) > 1e-9;
    return mix_picture(sight, in->seen, q, z > in->seen->world_from_camera.translation.z ? sky : NULL, gain, closed && elsewhere) > 0;
}

static struct vec3 direction(const struct image *image, double x, double y)
{
    double turn = x / image->width_px * 2 * M_PI, elevation = M_PI / 2 - y / image->height_px * M_PI;
    return vec3(cos(elevation) * cos(turn), cos(elevation) * sin(turn), sin(elevation));
}

/* To the 11 digits of a half float: a file of such values is a quarter as large, and sooner written. */
static float rounded(double value)
{
    int exponent;
    double digits = frexp(value, &exponent);
    return (float)ldexp(round(ldexp(digits, 11)), exponent - 11);
}

/* The mean over a pixel, and how much of it is known. In/out: sight  of the pixel below, of this one */
static void paint_pixel(float rgbw[4], struct sight *sight, const struct image *image, const struct panorama_input *in, const struct wall *wall,
                        int x, int y)
{
    struct sight middle = *sight;
    int n = look(&middle, in, wall, direction(image, x + 0.5, y + 0.5)) ? FINE : 1;
    if (n == 1) *sight = middle;
    for (int j = n - 1; j >= 0; j--)
        for (int i = 0; i < n; i++) {
            if (n > 1) look(sight, in, wall, direction(image, x + (i + 0.5) / n, y + (j + 0.5) / n));
            for (int c = 0; c < 3; c++) rgbw[c] += (float)(sight->known * sight->rgb[c] / (n * n));
            rgbw[3] += (float)(sight->known / (n * n));
        }
}

/* From above: to the horizon; of a place, as far as its relief. */
static int painted_rows(const struct panorama_input *in, const struct image *image)
{
    double lowest_rad = in->place ? RELIEF_LOWEST_RAD : 0;
    return (int)ceil((0.5 + lowest_rad / M_PI) * image->height_px - 1e-9);
}

/* What something hides is as what is round it. */
static bool paint(struct image *image, const struct panorama_input *in, const struct wall *wall, struct error *err)
{
    int width = image->width_px, height = painted_rows(in, image);
    float (*rgbw)[4] = calloc((size_t)width * (size_t)height, sizeof *rgbw);
    if (!rgbw) return error_set(err, ERR_MEMORY, "no memory for what stands round the entities");
    for (int x = 0; x < width; x++) {
        struct sight sight = { .open = false };
        for (int y = height - 1; y >= 0; y--) paint_pixel(rgbw[y * width + x], &sight, image, in, wall, x, y);
    }
    bool ok = !in->seen->unhidden || push_pull(rgbw, width, height, err);
    for (int y = 0; ok && y < height; y++)
        for (int x = 0; x < width; x++)
            for (int c = 0; c < 3; c++) image_f32(image, x, y)[c] = rounded((double)rgbw[y * width + x][c]);
    free(rgbw);
    return ok;
}

bool panorama_create(struct panorama *panorama, const struct panorama_input *in, struct error *err)
{
    struct panorama out = { 0 };
    const struct image *sky = &in->light->sky;
    int scale = sky->width_px < WIDTH ? WIDTH / sky->width_px : 1;
    struct wall wall = { .there = false };
    if (!in->place) wall = raise_wall(in);
    bool ok = image_init(&out.radiance, scale * sky->width_px, scale * sky->height_px, 3, PIXEL_F32, err) && paint(&out.radiance, in, &wall, err);
    if (!ok) {
        panorama_release(&out);
        return false;
    }
    const float *ground = image_f32(sky, 0, sky->height_px - 1);
    for (int y = painted_rows(in, &out.radiance); y < out.radiance.height_px; y++)
        for (int x = 0; x < out.radiance.width_px; x++) memcpy(image_f32(&out.radiance, x, y), ground, 3 * sizeof *ground);
    if (wall.there) out.radius_m = wall.radius_m;
    *panorama = out;
    return true;
}

/* The means of squares of the large image. */
bool panorama_lighting(struct image *lighting, const struct panorama *panorama, const struct light *light, struct error *err)
{
    const struct image *sky = &light->sky, *large = &panorama->radiance;
    int square = large->width_px / sky->width_px;
    if (!image_init(lighting, sky->width_px, sky->height_px, 3, PIXEL_F32, err)) return false;
    memcpy(lighting->data, sky->data, image_size(sky));
    for (int y = 0; y < sky->height_px / 2; y++)
        for (int x = 0; x < sky->width_px; x++)
            for (int c = 0; c < 3; c++) {
                double sum = 0;
                for (int j = 0; j < square; j++)
                    for (int i = 0; i < square; i++) sum += (double)image_f32(large, x * square + i, y * square + j)[c];
                image_f32(lighting, x, y)[c] = (float)(sum / (square * square));
            }
    return true;
}

void panorama_release(struct panorama *panorama)
{
    image_release(&panorama->radiance);
}
