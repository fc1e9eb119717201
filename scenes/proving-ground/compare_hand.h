/* Whether what is put in has the edges and the grain that the camera would have given it. */
#ifndef STAFFAGE_PROVING_COMPARE_HAND_H
#define STAFFAGE_PROVING_COMPARE_HAND_H

#include "compare_picture.h"

/* Fills the figures of edges and grain: NAN without in->plain, and where there is too little to tell.
 * Err: ERR_MEMORY */
bool compare_hand(struct comparison *to, const struct picture_input *in, struct error *err);

#endif
