/* The pinhole picture from which a photograph through a lens is resampled: finer, and as wide as the lens sees. */
#ifndef STAFFAGE_PROVING_PINHOLE_H
#define STAFFAGE_PROVING_PINHOLE_H

#include "lib/camera.h"

struct pinhole { int width_px, height_px; double f_px, cx_px, cy_px; };

/* `fineness` pixels of the pinhole for one of the photograph, in its middle.
 * Err: ERR_NOT_INVERTIBLE */
bool pinhole_cover(struct pinhole *pinhole, const struct camera *camera, double fineness, struct error *err);

#endif
