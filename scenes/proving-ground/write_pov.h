/* What POV-Ray renders of the proving ground. The scenes include light.inc (Sun_Direction, Sun_Color, Sun_Tangent where
 * there is a sun; Sky_Map) and models.inc (Entity_N, the N-th entity, from 1), which lie beside them. */
#ifndef STAFFAGE_PROVING_WRITE_POV_H
#define STAFFAGE_PROVING_WRITE_POV_H

#include "cases.h"
#include "lib/rect.h"

enum {
    PROVING_RANGE_M = 600,   /* 65535 in pictures of the distance along the ray, and what is farther */
    PROVING_DEPTH_M = 200,   /* 65535 in the red of label pictures: z of the camera */
    PROVING_ID_SCALE = 256,  /* what green holds for each id there */
    PROVING_HEIGHT_M = 20,   /* 65535 in pictures of heights, and 0 is -1 m */
};
/* The part of the street that was reconstructed, and the side of a cell. */
#define PROVING_MESH_X0_M (-45.0)
#define PROVING_MESH_Y0_M (-30.0)
#define PROVING_MESH_CELL_M 0.2
#define PROVING_HIGHEST_M 15.0 /* nothing in it is higher */
enum { PROVING_MESH_COLUMNS = 450, PROVING_MESH_ROWS = 260 };

struct pov_job { int width_px, height_px; bool is_png; };

/* Write `kind` as a scene: photograph, truth, range, truth-range (through the pinhole, in truths with the entities; whole, so
 * that radiosity takes its samples at the same places); labels (one ray through each pixel's centre, of the place and the
 * entities), alone-N (of entity N alone, in the window that it can cover; of both the picture's first
 * row is to be left out); the kinds of place_heights.h (orthographic), map-* (of map_flight.h). No text names the
 * case: those that differ in what the tool is told have the same pictures.
 * In:  camera at the size wanted
 * Out: job, how to render it */
bool write_pov(struct pov_job *job, const char *path, const char *kind, const struct proving_case *c, size_t shot,
               const struct camera *camera, double fineness, struct error *err);
/* The window of the photograph that alone-N covers; of all entities for n = 0: that of labels. */
bool label_window(struct rect *window_px, const struct proving_case *c, size_t shot, const struct camera *camera, size_t n,
                  struct error *err);

#endif
