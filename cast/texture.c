#include "cast/texture.h"

#include <stdlib.h>
#include <string.h>
#include <zlib.h>

/* --- tiles --- */

static const struct tile { int x, y, width, height; } tiles[PIECE_COUNT] = {
    [SKIN_PIECE] = { 0, 0, 128, 128 }, [TOP_PIECE] = { 128, 0, 128, 128 }, [BOTTOM_PIECE] = { 0, 128, 128, 128 },
    [UNDER_PIECE] = { 128, 128, 64, 64 }, [SHOES_PIECE] = { 192, 128, 64, 64 }, [HAIR_PIECE] = { 128, 192, 64, 32 },
    [HAT_PIECE] = { 128, 224, 64, 32 }, [CARRIED_PIECE] = { 192, 192, 64, 64 }
};
/* What a tile spans. Of the skin's the upper part is the head unrolled, one half of it, for both are alike;
 * all else is the figure as seen from the front and from behind. */
#define HEAD_PART 0.8
#define HEAD_TOP 1.03
#define HEAD_SPAN 1.4
#define LOW_TOP 0.66
#define UP_LOW 0.25
#define UP_SPAN 0.65
#define UP_WIDE_M 1.2

static struct vec2 vec2(double x, double y) { return (struct vec2){ x, y }; }

/* From the front and from behind alike; a pattern is laid aslant, so that it is not drawn out on the sides. */
static double across(enum pattern pattern, struct vec3 p) { return pattern == PLAIN || pattern == WORN ? p.y : p.y + 0.6 * p.x; }

static struct vec2 in_tile(enum piece piece, const struct person *person, const struct body *b, struct vec3 p)
{
    double rise = (p.z - b->sole_m) / b->measures.stature_m;
    struct vec3 head = vec3_scale(vec3_sub(p, vec3(b->at[HEAD].x - 0.02 * b->head_m, 0, b->chin_z)), 1 / b->head_m);
    switch (piece) {
    case SKIN_PIECE:
        if (head.z > HEAD_TOP - HEAD_SPAN && fabs(p.y) < b->at[LIMB(0, UPPER_ARM)].y * 0.8)
            return vec2(fabs(atan2(head.y, head.x)) / M_PI, (HEAD_TOP - head.z) / HEAD_SPAN * HEAD_PART);
        return vec2(0.5 + 0.7 * p.y, HEAD_PART + 0.03 + 0.16 * (1 - rise));
    case HAIR_PIECE: case HAT_PIECE: return vec2(fabs(atan2(head.y, head.x + 0.1)) / M_PI, 0.8 - 0.55 * head.z);
    case SHOES_PIECE: return vec2(0.5 + 1.6 * p.x, 1 - 5 * p.z);
    case BOTTOM_PIECE: return vec2(0.5 + across(person->bottom_pattern, p), 1 - rise / LOW_TOP);
    case TOP_PIECE: return vec2(0.5 + across(person->top_pattern, p) / UP_WIDE_M, 1 - (rise - UP_LOW) / UP_SPAN);
    default: return vec2(0.5 + p.y / UP_WIDE_M, 1 - (rise - UP_LOW) / UP_SPAN);
    }
}

struct vec2 texture_place(enum piece piece, const struct person *person, const struct body *body, struct vec3 p)
{
    const struct tile *t = &tiles[piece];
    struct vec2 at = in_tile(piece, person, body, p);
    /* Between the outermost pixels' centres: a tile must not take from its neighbour, at half its size neither. */
    double u = 1 + (t->width - 2) * fmin(fmax(at.x, 0), 1), v = 1 + (t->height - 2) * fmin(fmax(at.y, 0), 1);
    return vec2((t->x + u) / TEXTURE_PX, (t->y + v) / TEXTURE_PX);
}

/* --- colours: sRGB, 0 to 1 --- */

struct color { double rgb[3]; };

static struct color color_of(const double rgb[3]) { return (struct color){ { rgb[0], rgb[1], rgb[2] } }; }

static struct color mixed(struct color a, struct color b, double t)
{
    t = fmin(fmax(t, 0), 1);
    for (int k = 0; k < 3; k++) a.rgb[k] += t * (b.rgb[k] - a.rgb[k]);
    return a;
}

static struct color shaded(struct color c, double factor)
{
    for (int k = 0; k < 3; k++) c.rgb[k] *= factor;
    return c;
}

/* 1 within an ellipse, 0 outside, soft. */
static double spot(double x, double y, double at_x, double at_y, double wide, double high)
{
    double d = hypot((x - at_x) / wide, (y - at_y) / high);
    return ramp(1.3, 0.7, d);
}

/* u: from the face's middle (0) to the back (1); z: from the chin (0) to the top (1). */
static struct color paint_head(const struct person *person, double u, double z, double grain)
{
    struct color skin = color_of(person->skin), c = shaded(skin, 0.97 + 0.06 * grain), hair = color_of(person->hair_color);
    const struct color blood = { { skin.rgb[0] * 1.0, skin.rgb[1] * 0.70, skin.rgb[2] * 0.68 } };
    bool male = person->measures.sex == MALE && person->measures.age_years > 17;
    c = mixed(c, blood, 0.30 * spot(u, z, 0.22, 0.40, 0.12, 0.12));              /* cheeks */
    c = mixed(c, blood, 0.25 * spot(u, z, 0, 0.38, 0.05, 0.10));                 /* nose */
    c = mixed(c, blood, 0.25 * spot(u, z, 0.52, 0.47, 0.06, 0.13));              /* ears */
    c = mixed(c, blood, (male ? 0.40 : 0.65) * spot(u, z, 0, 0.222, 0.085, 0.034)); /* lips */
    c = mixed(c, shaded(skin, 0.35), 0.6 * spot(u, z, 0, 0.222, 0.08, 0.008));
    c = mixed(c, shaded(skin, 0.45), 0.6 * spot(u, z, 0.035, 0.335, 0.018, 0.012)); /* nostrils */
    c = mixed(c, shaded(skin, 0.72), 0.55 * spot(u, z, 0.118, 0.505, 0.085, 0.06)); /* around the eyes */
    c = mixed(c, (struct color){ { 0.80, 0.78, 0.75 } }, 0.75 * spot(u, z, 0.118, 0.502, 0.046, 0.016));
    c = mixed(c, (struct color){ { 0.12, 0.08, 0.06 } }, 0.95 * spot(u, z, 0.118, 0.503, 0.019, 0.017));
    c = mixed(c, (struct color){ { 0.10, 0.07, 0.06 } }, 0.7 * spot(u, z, 0.120, 0.520, 0.055, 0.008));  /* lashes */
    struct color brow = mixed(shaded(hair, 0.75), (struct color){ { 0.18, 0.13, 0.10 } }, 0.4);
    c = mixed(c, brow, 0.8 * spot(u, z + 0.10 * (u - 0.12), 0.122, 0.585, 0.075, 0.017));
    if (male) c = mixed(c, mixed(shaded(skin, 0.62), (struct color){ { 0.2, 0.2, 0.22 } }, 0.2),
                        0.35 * ramp(0.36, 0.26, z + 0.1 * u) * ramp(0.55, 0.40, u) * ramp(-0.12, 0.0, z)); /* shaved */
    double scalp = fmax(ramp(0.80, 0.86, z), ramp(0.50, 0.58, u) * ramp(0.08, 0.14, z) * ramp(0.50, 0.60, u + 0.2 * (z - 0.4)));
    if (person->hair == BALD) scalp *= ramp(0.86, 0.78, z) * 0.6;
    return mixed(c, hair, scalp * 0.9);
}

/* Light and shade of small folds, that run down and aslant. */
static double fold_shade(double y, double z, double seed)
{
    double slant = 0.5 * noise(vec3(y * 5, z * 5, 1), seed);
    double down = noise(vec3(y * 17 + 3 * slant, z * 4, 2), seed), across = noise(vec3(y * 5 + 3 * z, z * 13 + 7 * y + 4 * slant, 3), seed + 2);
    double crease = ramp(0.10, 0.0, fabs(across - 0.5)) * noise(vec3(y * 8, z * 8, 6), seed);
    return 1 + 0.28 * (down - 0.5) + 0.12 * (across - 0.5) - 0.14 * crease;
}

static struct color paint_cloth(struct color c, enum pattern pattern, double y, double z, double seed)
{
    double fine = noise(vec3(y * 160, z * 160, 0), seed), large = noise(vec3(y * 9, z * 6, 3), seed);
    double light = (1 + 0.06 * (fine - 0.5) + 0.10 * (large - 0.5)) * fold_shade(y, z, seed);
    switch (pattern) {
    case STRIPES: c = mixed(c, (struct color){ { 0.90, 0.89, 0.86 } }, fmod(fabs(z), 0.052) < 0.024 ? 0.85 : 0); break;
    case CHECKS: {
        double across = fmod(fabs(y) + 0.01, 0.07), up = fmod(fabs(z), 0.07);
        c = shaded(c, (across < 0.030 ? 0.68 : 1) * (up < 0.030 ? 0.68 : 1));
        if (fabs(across - 0.052) < 0.006 || fabs(up - 0.052) < 0.006) c = mixed(c, (struct color){ { 0.85, 0.82, 0.75 } }, 0.5);
        break;
    }
    case PRINT: {
        double n = noise(vec3(y * 32, z * 32, 9), seed), m = noise(vec3(y * 32, z * 32, 19), seed);
        if (n > 0.62) c = mixed(c, (struct color){ { 0.93, 0.90, 0.84 } }, 0.8);
        else if (m > 0.66) c = shaded(c, 0.55);
        break;
    }
    default: break;
    }
    return shaded(c, light);
}

/* x: 0 to 1 across the tile from the right to the left; z: share of stature. */
static struct color paint_bottom(const struct person *person, double y, double z)
{
    struct color c = color_of(person->bottom_color);
    double knee = ramp(0.08, 0.02, fabs(z - 0.29)) * ramp(0.10, 0.04, fabs(fabs(y) - 0.09)), thigh = ramp(0.16, 0.05, fabs(z - 0.40)) * ramp(0.09, 0.02, fabs(fabs(y) - 0.10));
    if (person->bottom_pattern == WORN) c = mixed(c, (struct color){ { 0.74, 0.79, 0.86 } }, 0.40 * thigh + 0.25 * knee);
    c = paint_cloth(c, person->bottom_pattern, y, z * person->measures.stature_m, 21);
    c = shaded(c, (1 - 0.25 * ramp(0.035, 0.0, fabs(y)) * ramp(0.36, 0.44, z)) * (1 - 0.12 * ramp(0.03, 0.0, fabs(y))));
    c = shaded(c, 1 - 0.18 * ramp(0.09, 0.03, z));                                /* dusty, worn hems */
    if (fabs(z - 0.475) < 0.006 && person->bottom != LEGGINGS) c = shaded(c, 0.85);
    return c;
}

static struct color paint_top(const struct person *person, double y, double z)
{
    struct color c = color_of(person->top_color);
    double meters = z * person->measures.stature_m;
    c = paint_cloth(c, person->top_pattern, y, meters, 31 + person->name[0]);
    bool buttoned = person->top == SHIRT || person->top == COAT || person->top == JACKET;
    if (buttoned && person->top_pattern == PLAIN && fabs(y) < 0.012 && z < 0.84) c = shaded(c, 0.72);             /* where it closes */
    if ((person->top == SWEATER || person->top == HOODIE) && (fabs(z - 0.497) < 0.014)) c = shaded(c, 0.86);
    if ((person->top == JACKET || person->top == COAT || person->top == OPEN_COAT) && fabs(z - 0.545) < 0.004 && fabs(y) > 0.06 && fabs(y) < 0.15) c = shaded(c, 0.6); /* pockets */
    if (person->top == DRESS && fabs(z - 0.615) < 0.008) c = shaded(c, 0.7);
    return c;
}

static struct color paint_shoe(const struct person *person, double z_m, double grain)
{
    struct color c = shaded(color_of(person->shoes_color), 0.92 + 0.16 * grain);
    bool sneakers = person->shoes == SNEAKERS;
    struct color sole = sneakers ? (struct color){ { 0.78, 0.77, 0.74 } } : (struct color){ { 0.20, 0.18, 0.17 } };
    return mixed(c, shaded(sole, 0.85 + 0.3 * grain), ramp(sneakers ? 0.030 : 0.014, sneakers ? 0.024 : 0.009, z_m));
}

static struct color paint(const struct person *person, enum piece piece, double u, double v)
{
    double grain = noise(vec3(u * 40, v * 40, 5), 41), strand = noise(vec3(u * 60, v * 7, 5), 43);
    double y = (u - 0.5) * UP_WIDE_M, z = UP_LOW + (1 - v) * UP_SPAN;
    switch (piece) {
    case SKIN_PIECE:
        if (v < HEAD_PART) return paint_head(person, u, HEAD_TOP - v / HEAD_PART * HEAD_SPAN, grain);
        return shaded(color_of(person->skin), 0.95 + 0.07 * grain);
    case HAIR_PIECE: return shaded(color_of(person->hair_color), 0.72 + 0.56 * strand);
    case HAT_PIECE: return paint_cloth(color_of(person->hair == HEADSCARF || person->hair == BEANIE ? person->under_color : person->carried_color), PLAIN, u, v, 51);
    case TOP_PIECE: return paint_top(person, y, z);
    case UNDER_PIECE: return paint_cloth(color_of(person->under_color), PLAIN, y, z, 61);
    case BOTTOM_PIECE: return paint_bottom(person, u - 0.5, (1 - v) * LOW_TOP);
    case SHOES_PIECE: return paint_shoe(person, (1 - v) / 5, grain);
    default: return paint_cloth(color_of(person->carried_color), PLAIN, y, z, 71);
    }
}

void paint_texture(struct texture *texture, const struct person *person)
{
    memset(texture, 0, sizeof *texture);
    for (int piece = 0; piece < PIECE_COUNT; piece++) {
        const struct tile *t = &tiles[piece];
        for (int y = 0; y < t->height; y++)
            for (int x = 0; x < t->width; x++) {
                struct color c = paint(person, (enum piece)piece, (x - 0.5) / (t->width - 2), (y - 0.5) / (t->height - 2));
                for (int k = 0; k < 3; k++) texture->rgb[t->y + y][t->x + x][k] = (uint8_t)lround(255 * fmin(fmax(c.rgb[k], 0), 1));
            }
    }
}

/* --- PNG --- */

static void put_u32(uint8_t *to, size_t value)
{
    for (int k = 0; k < 4; k++) to[k] = (uint8_t)(value >> (24 - 8 * k));
}

/* A chunk: its size, its name, its bytes, their checksum. Returns where it ends. */
static uint8_t *put_chunk(uint8_t *to, const char *name, const uint8_t *data, size_t size)
{
    put_u32(to, size);
    memcpy(to + 4, name, 4);
    if (size) memcpy(to + 8, data, size);
    put_u32(to + 8 + size, crc32(0, to + 4, (uInt)size + 4));
    return to + 12 + size;
}

static uint8_t mean(const struct texture *texture, int x, int y, int k, int shrink)
{
    int sum = 0;
    for (int j = 0; j < shrink; j++)
        for (int i = 0; i < shrink; i++) sum += texture->rgb[y * shrink + j][x * shrink + i][k];
    return (uint8_t)(sum / (shrink * shrink));
}

uint8_t *texture_png(size_t *size, const struct texture *texture, int shrink)
{
    int n = TEXTURE_PX / shrink;
    size_t row = 1 + 3 * (size_t)n, raw_size = row * (size_t)n;
    uLongf packed_size = compressBound(raw_size);
    uint8_t *raw = calloc(1, raw_size), *packed = malloc(packed_size), *png = malloc(packed_size + 100), *to = png;
    if (!raw || !packed || !png) abort();
    for (int y = 0; y < n; y++)
        for (int i = 0; i < 3 * n; i++) {
            uint8_t *at = raw + (size_t)y * row;
            at[0] = 1; /* filter: against the pixel before */
            uint8_t before = i < 3 ? 0 : mean(texture, i / 3 - 1, y, i % 3, shrink);
            at[1 + i] = (uint8_t)(mean(texture, i / 3, y, i % 3, shrink) - before);
        }
    if (compress2(packed, &packed_size, raw, raw_size, 9) != Z_OK) abort();
    uint8_t header[13] = { [8] = 8, [9] = 2 }; /* 8 bits, RGB */
    put_u32(header, (size_t)n), put_u32(header + 4, (size_t)n);
    memcpy(to, "\211PNG\r\n\32\n", 8);
    to = put_chunk(to + 8, "IHDR", header, sizeof header);
    to = put_chunk(to, "IDAT", packed, packed_size);
    to = put_chunk(to, "IEND", NULL, 0);
    *size = (size_t)(to - png);
    free(raw), free(packed);
    return png;
}
