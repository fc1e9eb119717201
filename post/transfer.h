/* The four ways to merge the rendered layers into the photograph.
 *
 * B photograph, O entities (alpha a), P ground alone, S ground with the entities' shadows,
 * k exposure, v share of an entity pixel and g share of a ground pixel that nothing in the
 * photograph hides. All images cover the same window, in linear light. Where the layers
 * change nothing, the output is B to the last bit. */
#ifndef STAFFAGE_POST_TRANSFER_H
#define STAFFAGE_POST_TRANSFER_H

#include "lib/error.h"
#include "lib/image.h"

#include <stdbool.h>
#include <stddef.h>

struct transfer_input {               /* all borrowed */
    const struct image *photograph;   /* B: F32, 3 channels */
    const struct image *object;       /* O: F32, RGBA premultiplied */
    const struct image *plane;        /* P: F32, RGBA premultiplied */
    const struct image *shadow;       /* S: F32, RGBA premultiplied */
    const struct image *visible;      /* v: U8, 255 = all; NULL: 1 everywhere */
    const struct image *receiver;     /* g: U8, 255 = all; NULL: 1 everywhere */
    double exposure[3];               /* k */
};

struct transfer_thresholds {
    double t1, t2, t3;      /* 0..255: blending, vehicles, people */
    bool overwrite_below;   /* overwrite below t2, t3 rather than from them upwards */
};

/* out = B + B' (clamp(S/P) - 1) (g - a min(g, v)) + (k O - a B') v: the ground under a soft edge is shaded
 * before the edge goes over it. B' is B; under an entity with v below 1, what B shows beside: at the
 * edge of what hides, a pixel's light comes in part from it and in part from behind.
 * Out, here and below: F32, 3 channels, initialized here. Err, here and below: ERR_MEMORY */
bool transfer_layers(struct image *out, const struct transfer_input *in, struct error *err);

/* out = k I_all in the objects' mask, B I_all / I_pl on the rest of the plane; B elsewhere, and beyond the rendered plane
 * B / k is I_pl, so that the objects' eroded rim comes out as k O + (1 - a) B.
 * I_all is O over S, I_pl is P. Both masks are eroded; the contour of the objects' mask is
 * blended half and half with its Gaussian blur.
 * Src: Mixed Reality Synthetic Data Generation, III.D, equations 1 and 2 */
bool transfer_ratio(struct image *out, const struct transfer_input *in, struct error *err);

/* The shadow catcher's picture is blended where its alpha is above t1, and where the class mask
 * has an entity, it overwrites by the threshold of people or that of everything else.
 * In:  classes (U8) as of semantic_classes
 * Src: Static Mesh Enrichment with Dynamic Entities, IV.F */
bool transfer_threshold(struct image *out, const struct transfer_input *in, const struct image *classes,
                        const struct transfer_thresholds *thresholds, struct error *err);

/* Plain alpha blending of the shadow catcher's picture. */
bool transfer_alpha(struct image *out, const struct transfer_input *in, struct error *err);

/* What the operations share. */

/* v or g at the i-th pixel. */
static inline float transfer_share(const struct image *share, size_t i)
{
    return share ? (float)((const uint8_t *)share->data)[i] / 255 : 1;
}

/* a/b held to [0, 4]; 1 where b has no light to compare with. */
static inline float transfer_ratio_of(float a, float b)
{
    if (!(b > 0)) return 1;
    float r = a / b;
    return r < 0 ? 0 : r > 4 ? 4 : r;
}

/* Light that is left on the ground in channel c: S/P for the part of the pixel that the
 * ground covers, 1 for the rest. In: p, s pixels of P and S */
static inline float transfer_ground(const float *p, const float *s, int c)
{
    return 1 + p[3] * (transfer_ratio_of(s[c], p[c]) - 1);
}

/* One pixel of the picture that a shadow catcher gives: entities in front of black shadow.
 * Out: premultiplied RGBA, exposed as the photograph */
void transfer_caught(float rgba[4], const struct transfer_input *in, size_t i);

#endif
