/* The catalogue as text, as JSON and as pictures. */
#ifndef STAFFAGE_CATALOGUE_LIST_H
#define STAFFAGE_CATALOGUE_LIST_H

#include "gen/model/catalogue.h"
#include "lib/error.h"

#include <stdbool.h>
#include <stdio.h>

void list_text(FILE *out, const struct catalogue *catalogue);
bool list_json(FILE *out, const struct catalogue *catalogue, struct error *err);
/* Write FOLDER/NAME.png of each model, FOLDER/sheet.png of all, and FOLDER/index.html.
 * In: width_px of a picture */
bool list_pictures(const char *folder, const struct catalogue *catalogue, int width_px, struct error *err);

#endif
