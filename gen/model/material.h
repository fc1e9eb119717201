/* What a surface is made of, as glTF's metallic-roughness model says it, and the
 * keyword rules for models whose materials only have names. */
#ifndef STAFFAGE_GEN_MATERIAL_H
#define STAFFAGE_GEN_MATERIAL_H

#include "lib/class.h"
#include "lib/error.h"
#include "lib/image.h"

#include <stdbool.h>
#include <stddef.h>

enum alpha_mode { ALPHA_OPAQUE, ALPHA_MASK, ALPHA_BLEND };

/* The finish families that templates/materials.inc knows. */
enum finish_kind {
    FINISH_PBR,      /* as the numbers say */
    FINISH_GLASS,    /* thin glass: no refraction, Fresnel reflection */
    FINISH_PLASTIC,  /* smooth plastic */
    FINISH_PAINT,    /* body colour under a clear coat; takes the entity's colour */
    FINISH_CHROME,   /* polished metal */
    FINISH_RUBBER,   /* rough diffuse */
    FINISH_DULL,     /* interior */
    FINISH_KIND_COUNT
};

struct material {
    char name[128];             /* as in the model: data, never scene code */
    enum finish_kind kind;
    double base_color[3];       /* linear, 0..1; multiplies the texture */
    double alpha;               /* 0..1; used by BLEND and MASK */
    struct image base_image;    /* sRGB, U8, 3 channels or 4 (straight alpha); empty without texture; borrowed from the model */
    enum alpha_mode alpha_mode;
    double alpha_cutoff;        /* MASK: a texel of less alpha is not there */
    double metallic, roughness; /* 0..1 */
    double emissive[3];         /* linear radiance relative to white */
    double clearcoat, clearcoat_roughness; /* 0..1 */
    double transmission;        /* 0..1: share of light that passes (thin) */
    double ior;                 /* 1.5 unless told */
    bool names_only;            /* no physical figures came with the file: the rules decide */
};

/* White, rough, opaque, ior 1.5. */
void material_default(struct material *material);

/* The share of light that the surface stops at a texture position (v up, repeating; the texel
 * that the position lies in): 1 where opaque, 0 or 1 where MASK, factor times texel where BLEND. */
double material_alpha(const struct material *material, double u, double v);

/* Of light from all around, the share that the surface sends back, as if it were matte (position as above).
 * In: paint  the colour of FINISH_PAINT materials, linear; NULL: their own. It counts for all of a texture, also for what is none of the body */
void material_reflectance(double rgb[3], const struct material *material, const double *paint, double u, double v);

/* The keyword rules: an ordered list, first match wins. */
struct material_rules;

/* Read a rules file (templates/materials.rules by default; docs/materials.md).
 * Err: ERR_INPUT at file:line:column */
bool material_rules_read(struct material_rules **rules, const char *path, struct error *err);
void material_rules_destroy(struct material_rules *rules);

/* Set a material's kind by its name. Where names_only, a keyword or else the file's `default`
 * line for the class (CLASS_COUNT: not known) sets kind and figures. A material that came with
 * figures keeps them: only a keyword for FINISH_PAINT applies, so that it takes the entity's colour.
 * People are never painted. */
void material_rules_apply(const struct material_rules *rules, struct material *material,
                          enum entity_class class_);

#endif
