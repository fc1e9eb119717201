/* What a surface is made of, as glTF's metallic-roughness model says it, and the
 * keyword rules for models whose materials only have names. */
#ifndef STAFFAGE_GEN_MATERIAL_H
#define STAFFAGE_GEN_MATERIAL_H

#include "lib/error.h"

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
    char *base_texture;         /* path of an sRGB image file, or NULL; owned */
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
void material_release(struct material *material);

/* The keyword rules: an ordered list, first match wins. */
struct material_rules;

/* Read a rules file (templates/materials.rules by default; docs/materials.md).
 * Err: ERR_INPUT at file:line:column */
bool material_rules_read(struct material_rules **rules, const char *path, struct error *err);
void material_rules_destroy(struct material_rules *rules);

/* Set kind and, where names_only, figures of a material by its name. `unmatched` is the
 * finish that applies when no keyword is found: FINISH_PAINT for a body, by the file's `default` line. */
void material_rules_apply(const struct material_rules *rules, struct material *material);

#endif
