/* All that a frame is put together from, read and checked. */
#ifndef STAFFAGE_POST_FRAME_INPUT_H
#define STAFFAGE_POST_FRAME_INPUT_H

#include "lib/error.h"
#include "lib/image.h"
#include "lib/manifest.h"

#include <stdbool.h>

enum { OBJECT, PLANE, SHADOW, PASS_COUNT };

struct frame_input {
    const char *out, *name;         /* the output folder and "000123"; borrowed */
    char *folder;                   /* OUT/frames/NAME */
    char *photograph;               /* its path; of a new view, its background's */
    struct manifest manifest;
    struct image rgb;               /* the photograph: U8, 3 channels */
    struct image instance;          /* U16 ids */
    struct image depth;             /* F32, of the entities */
    struct image semantic_before, depth_before; /* as of before.h; empty when there are none */
    /* of the view's window only, and empty where nothing changes */
    struct image layers[PASS_COUNT];
    struct image visible, receiver; /* U8; empty when nothing hides */
    struct image ground;            /* F32, depth of the ground; empty unless mist or defocus want it */
    struct image motion;            /* F32, 3 channels; empty without motion */
};

/* In:  out, the output folder; name, "000123"; both must outlive the frame. Release it.
 * Err: ERR_INPUT, ERR_RENDER at the file that is at fault */
bool frame_input_read(struct frame_input *frame, const char *out, const char *name, struct error *err);
void frame_input_release(struct frame_input *frame);

#endif
