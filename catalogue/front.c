#include "catalogue/front.h"

#include "lib/image.h"

#include <ctype.h>
#include <math.h>
#include <string.h>

/* Points of a surface, in shares of its bounding box: along the line of the front, across, up; with the area they stand for. */
struct spot { double at, across, height, area; bool is_front, is_rear, is_red; };

#define COLUMNS 64       /* of the profile, from end to end */
#define POINT_STEP 0.008 /* between points of a triangle */
#define POINTS_MAX 128   /* of a triangle's side */

struct middle { double sum, area; };
struct ends {
    struct middle front, rear, upper, all, toes, ankles; /* where along lie what is in front by name, and at the rear; what is high up, and all; feet */
    double face[2], red[2];                              /* area of either end, negative one first, and what of it is red */
    double profile[COLUMNS];                             /* of the middle, without what stands at the sides */
};

static void add_to(struct middle *middle, double at, double area)
{
    middle->sum += at * area;
    middle->area += area;
}
static double middle_of(const struct middle *middle) { return middle->area > 0 ? middle->sum / middle->area : NAN; }

/* --- what lies where --- */

static bool any_of(const char *name, const char *const *words)
{
    char plain[128];
    size_t n = 0;
    for (const char *c = name; *c && n + 1 < sizeof plain; c++)
        if (isalpha((unsigned char)*c)) plain[n++] = (char)tolower((unsigned char)*c);
    plain[n] = 0;
    for (; *words; words++)
        if (strstr(plain, *words)) return true;
    return false;
}

/* As tail lights are: far from white, and from the brown of rust. */
static bool color_is_red(const double srgb[3]) { return srgb[0] > 0.35 && srgb[1] < 0.4 * srgb[0] && srgb[2] < 0.45 * srgb[0]; }

static bool point_is_red(const struct mesh *mesh, const struct material *material, const uint32_t corner[3], const double weight[3])
{
    double color[3];
    for (int c = 0; c < 3; c++) color[c] = (double)srgb_from_linear((float)material->base_color[c]);
    const struct image *image = &material->base_image;
    if (image->data && mesh->uv) {
        double u = 0, v = 0;
        for (int k = 0; k < 3; k++) {
            u += weight[k] * (double)mesh->uv[corner[k]][0];
            v += weight[k] * (double)mesh->uv[corner[k]][1];
        }
        if (!isfinite(u) || !isfinite(v)) return false;
        int x = (int)fmin((u - floor(u)) * image->width_px, image->width_px - 1), y = (int)fmin((1 - (v - floor(v))) * image->height_px, image->height_px - 1);
        const uint8_t *pixel = (const uint8_t *)image->data + ((size_t)y * (size_t)image->width_px + (size_t)x) * (size_t)image->channels;
        for (int c = 0; c < 3; c++) color[c] *= pixel[c] / 255.0;
    }
    return color_is_red(color);
}

static void add_spot(struct ends *e, const struct spot *s)
{
    if (s->is_front && !s->is_rear) add_to(&e->front, s->at, s->area);
    if (s->is_rear && !s->is_front) add_to(&e->rear, s->at, s->area);
    if (s->height > 0.7) add_to(&e->upper, s->at, s->area);
    add_to(&e->all, s->at, s->area);
    if (s->height < 0.03) add_to(&e->toes, s->at, s->area);
    if (s->height > 0.05 && s->height < 0.12) add_to(&e->ankles, s->at, s->area);
    if (s->at < 0.1 || s->at > 0.9) {
        e->face[s->at > 0.5] += s->area;
        if (s->is_red) e->red[s->at > 0.5] += s->area;
    }
    int column = (int)fmin(s->at * COLUMNS, COLUMNS - 1);
    if (fabs(s->across - 0.5) < 0.3 && s->height > e->profile[column]) e->profile[column] = s->height;
}

static void find_ends(struct ends *ends, const struct model *model, enum axis up, int along)
{
    static const char *const front[] = { "headlight", "headlamp", "frontlight", "grill", "windscreen", "windshield", "frontbumper", "bumperfront", "bonnet", NULL };
    static const char *const rear[] = { "taillight", "taillamp", "rearlight", "rearlamp", "brakelight", "backlight", "stoplight", "rearbumper", "bumperrear",
                                        "rearwindow", "tailgate", "trunk", "exhaust", "tailpipe", NULL };
    const double low[3] = { model->min_m.x, model->min_m.y, model->min_m.z }, high[3] = { model->max_m.x, model->max_m.y, model->max_m.z };
    const int axis[3] = { along, 3 - along - (int)up / 2, (int)up / 2 };
    for (size_t i = 0; i < model->mesh_count; i++) {
        const struct mesh *mesh = &model->meshes[i];
        const struct material *material = &model->materials[mesh->material];
        struct spot spot = { .is_front = any_of(material->name, front), .is_rear = any_of(material->name, rear) };
        for (size_t t = 0; t < mesh->triangles; t++) {
            double p[3][3], longest = 0;
            for (int k = 0; k < 3; k++)
                for (int d = 0; d < 3; d++)
                    p[k][d] = ((double)mesh->position_m[mesh->triangle[t][k]][axis[d]] - low[axis[d]]) / fmax(high[axis[d]] - low[axis[d]], 1e-12);
            if (up % 2)
                for (int k = 0; k < 3; k++) p[k][2] = 1 - p[k][2];
            struct vec3 a = vec3(p[1][0] - p[0][0], p[1][1] - p[0][1], p[1][2] - p[0][2]), b = vec3(p[2][0] - p[0][0], p[2][1] - p[0][1], p[2][2] - p[0][2]);
            longest = fmax(vec3_norm(a), fmax(vec3_norm(b), vec3_norm(vec3_sub(a, b))));
            int n = (int)fmin(fmax(ceil(longest / POINT_STEP), 1), POINTS_MAX);
            spot.area = vec3_norm(vec3_cross(a, b)) / (n * n);
            /* The middles of n*n equal parts. */
            for (int row = 0; row < n; row++)
                for (int k = 0; k < 2 * row + 1; k++) {
                    double down = (row + (k % 2 ? 1.0 : 2.0) / 3) / n, right = (k / 2 + (k % 2 ? 2.0 : 1.0) / 3) / n;
                    const double weight[3] = { 1 - down, down - right, right };
                    spot.at = weight[0] * p[0][0] + weight[1] * p[1][0] + weight[2] * p[2][0];
                    spot.across = weight[0] * p[0][1] + weight[1] * p[1][1] + weight[2] * p[2][1];
                    spot.height = weight[0] * p[0][2] + weight[1] * p[1][2] + weight[2] * p[2][2];
                    spot.is_red = (spot.at < 0.1 || spot.at > 0.9) && point_is_red(mesh, material, mesh->triangle[t], weight);
                    add_spot(ends, &spot);
                }
        }
    }
}

/* --- what that tells --- */

/* To 1. Measured on fifteen vehicles of our own and five from elsewhere, each of which one or two of these name right. */
#define NAMES_ODDS 40.0
#define FEET_ODDS 30.0
#define RED_ODDS 10.0
#define END_ODDS 12.0
#define CABIN_ODDS 3.0

/* What they are for the positive end, from a figure that is positive where it is the front; 1 where it tells little. */
static double weigh(double figure, double least, double odds) { return !(fabs(figure) > least) ? 1 : figure > 0 ? odds : 1 / odds; }

static double from_names(const struct ends *e)
{
    double front = middle_of(&e->front), rear = middle_of(&e->rear);
    return weigh(isnan(front) ? 0.5 - rear : isnan(rear) ? front - 0.5 : front - rear, 0.15, NAMES_ODDS);
}

/* Only tail lights are red, but a red car is so at both ends. What has a name says that already. */
static double from_red(const struct ends *e)
{
    if (from_names(e) != 1) return 1;
    double negative = e->face[0] > 0 ? e->red[0] / e->face[0] : 0, positive = e->face[1] > 0 ? e->red[1] / e->face[1] : 0;
    double most = fmax(negative, positive), least = fmin(negative, positive);
    return most > 0.004 ? weigh((negative - positive) / most, least > 0 ? 0.6 : 0, RED_ODDS) : 1;
}

/* A bonnet falls off to its end; a boot, a hatch, a tailgate or a box ends high. */
static double end_height(const struct ends *e, bool positive)
{
    double height = 0;
    for (int i = 0; i < COLUMNS / 16; i++) height = fmax(height, e->profile[positive ? COLUMNS - 1 - i : i]);
    return height;
}
static double from_end_heights(const struct ends *e) { return weigh(end_height(e, false) - end_height(e, true), 0.12, END_ODDS); }

/* The bonnet is low and lies before the cabin; a pickup's bed as well, and behind it. */
static double from_cabin(const struct ends *e) { return weigh(0.5 - middle_of(&e->upper), 0.03, CABIN_ODDS); }

static double toes_ahead(const struct ends *e) { return middle_of(&e->toes) - middle_of(&e->ankles); }
static double from_feet(const struct ends *e) { return weigh(toes_ahead(e), 0.04, FEET_ODDS); }

double front_odds(const char **by, const struct model *model, enum axis up, int along, bool is_person)
{
    static const struct { const char *what; double (*odds)(const struct ends *); bool of_people; } clues[] = {
        { "names of lights", from_names, false }, { "the feet", from_feet, true }, { "the height of its ends", from_end_heights, false },
        { "red lights", from_red, false }, { "the cabin", from_cabin, false } };
    struct ends ends = { 0 };
    find_ends(&ends, model, up, along);
    double all = 1, most = 1;
    const char *told[2] = { "nothing", "nothing" }; /* for the negative end, for the positive one */
    double tells[2] = { 1, 1 };
    for (size_t i = 0; i < sizeof clues / sizeof *clues; i++) {
        double odds = clues[i].of_people == is_person ? clues[i].odds(&ends) : 1;
        all *= odds;
        most = fmax(odds, 1 / odds);
        if (most > tells[odds > 1]) {
            tells[odds > 1] = most;
            told[odds > 1] = clues[i].what;
        }
    }
    *by = told[all > 1];
    return all;
}

/* Of feet that point ahead, none points aside as far. */
double front_line_odds(const struct model *model, enum axis up, int along)
{
    const double size[3] = { model->max_m.x - model->min_m.x, model->max_m.y - model->min_m.y, model->max_m.z - model->min_m.z };
    int axis[2] = { along, 3 - along - (int)up / 2 };
    double far[2];
    for (int k = 0; k < 2; k++) {
        struct ends ends = { 0 };
        find_ends(&ends, model, up, axis[k]);
        far[k] = fabs(toes_ahead(&ends)) * size[axis[k]] / fmax(size[up / 2], 1e-12);
    }
    return weigh(far[0] - far[1], 0.015, far[0] < 3 * far[1] && far[1] < 3 * far[0] ? 1 : FEET_ODDS);
}
