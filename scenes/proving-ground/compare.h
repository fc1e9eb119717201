/* The tool's result against the truth: the picture, and every label. */
#ifndef STAFFAGE_PROVING_COMPARE_H
#define STAFFAGE_PROVING_COMPARE_H

#include "cases.h"

#include <stdio.h>

struct comparison_files {
    const char *folder; /* of the truth: photograph-N.jpg, truth-N.jpg, their .exr, plain-N.png, N-labels.png, N-alone-E.png, N-labels.log */
    const char *out;    /* the tool's output folder */
    size_t shot;
    bool plain;         /* plain-N.png is there, what the transfer made before grain and compression */
};

struct comparison {
    /* Over the pixels that change by more than 2 levels, in the truth without noise or in the result. */
    double changed_px, psnr_db, ssim;
    /* Over the ground whose light changes by more than 1.5 % in either, means of 3 x 3 px: of what is left of the light, mean
     * distance and mean difference (result - truth). */
    double shade_px, shade_error, shade_bias;
    /* Over entities' pixels, a pixel inside their edges: mean CIE 1976 distance, and that of the entities' mean colours. */
    double color_error, mean_color_error;
    /* Labels; of several entities the worst, unless it says mean. */
    double mask_iou, amodal_iou;        /* pixels visible; whole masks */
    double depth_m, amodal_depth_m;     /* mean distance over pixels that both give to the entity */
    double box_px, amodal_box_px;       /* any side */
    double visible_share;               /* distance of visible fractions */
    double semantic_share;              /* of the pixels that are an entity's in truth and instance/, those of its class */
    double position_m, turn_deg;        /* of the pose */
    double size_m, corner_px;           /* of the 3D box: any side; any corner in the picture */
    /* The camera's hand on entities, result / truth: median width of `edges` edges; standard deviation of the grain, the
     * median of eight bands of brightness (of 1000 pixels or more) and the one that is farthest off; NAN without plain-N.png. */
    double edges, edge_width, grain, grain_worst;
};

bool compare(struct comparison *result, const struct comparison_files *files, const struct proving_case *c,
             const struct camera *camera, struct error *err);

/* One line a comparison, which comparison_table reads again. */
void comparison_print(FILE *f, const char *name, size_t shot, const char *method, const struct comparison *result);
/* In: files of such lines. Prints a Markdown table of pictures, one of labels, and the medians. */
bool comparison_table(FILE *f, const char *const *files, size_t n, struct error *err);

#endif
