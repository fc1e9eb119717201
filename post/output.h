/* The dataset's files: OUT/KIND/NAME.SUFFIX, each written whole, its folder made when missing. */
#ifndef STAFFAGE_POST_OUTPUT_H
#define STAFFAGE_POST_OUTPUT_H

#include "lib/error.h"
#include "lib/image.h"

#include <stdbool.h>

/* In, here and below: kind "rgb", name "000123", suffix ".png" (it picks the image's format)
 * Err, here and below: ERR_IO, ERR_INPUT at the file that is at fault */
bool output_image(const char *out, const char *kind, const char *name, const char *suffix, const struct image *image,
                  struct error *err);

/* Copy the file FOLDER/FILE. */
bool output_copy(const char *out, const char *kind, const char *name, const char *suffix, const char *folder,
                 const char *file, struct error *err);

/* Make OUT/KIND/NAME a copy of the folder FOLDER/SUBFOLDER: its files come over, others that
 * are there from an earlier run go. Without that subfolder nothing is made. */
bool output_copy_folder(const char *out, const char *kind, const char *name, const char *folder, const char *subfolder,
                        struct error *err);

#endif
