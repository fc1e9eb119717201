/* Many pictures in one. */
#ifndef STAFFAGE_CATALOGUE_SHEET_H
#define STAFFAGE_CATALOGUE_SHEET_H

#include "lib/error.h"
#include "lib/image.h"

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Paste 8 bit pictures of one size side by side, with a caption below each.
 * In:  captions   (count)
 * Out: sheet, initialized here
 * Err: ERR_MEMORY */
bool sheet_make(struct image *sheet, const struct image *pictures, const char *const *captions, size_t count, size_t columns,
                struct error *err);

#ifdef __cplusplus
}
#endif
#endif
