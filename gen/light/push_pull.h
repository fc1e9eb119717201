/* Fill what is not known of an image with what is round it, smoothly.
 * Src: Gortler, Grzeszczuk, Szeliski, Cohen 1996, The Lumigraph, 3.4: pull and push */
#ifndef STAFFAGE_GEN_PUSH_PULL_H
#define STAFFAGE_GEN_PUSH_PULL_H

#include "lib/error.h"

/* In/out: rgbw (height,width,4): colour times weight, and the weight, from 0 unknown to 1; then colours, all of weight 1,
 *         where any weight was above 0
 * Err: ERR_MEMORY */
bool push_pull(float (*rgbw)[4], int width, int height, struct error *err);

#endif
