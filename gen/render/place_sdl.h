/* The parts of the static mesh that a frame needs, as a POV-Ray include. */
#ifndef STAFFAGE_GEN_PLACE_SDL_H
#define STAFFAGE_GEN_PLACE_SDL_H

#include "gen/estimate/sun_share.h"
#include "gen/light/hidden_place.h"
#include "gen/light/relief.h"
#include "gen/world/static_mesh.h"
#include "lib/error.h"

#include <stdbool.h>

/* Declares Receivers (what is round the entities), Level (its level faces, smooth normals: the ground as light and mirrors meet it;
 * the rest of it is on the relief) and Rest (what can shade the entities at most).
 * Err, here and below: ERR_IO, ERR_MEMORY */
bool place_include_write(const char *path, const struct static_cut *receivers, const struct static_cut *rest,
                         struct error *err);

/* Declares Shades, Shades_In_Part and Shades_Told: what of the place shades the receivers, as sun_share_part sorts it. */
bool shades_include_write(const char *path, const struct static_cut *shades, const size_t count[TOLD_KINDS], struct error *err);

/* Declares Relief, the place as light and mirrors meet it, Relief_Ground, its ground that has an orthophoto, and, if any, Hidden_Place with
 * its Hidden_Place_Map.
 * In: hidden NULL: none is; hidden_map its radiance, in a file: path relative to the output folder */
bool relief_include_write(const char *path, const struct relief *relief, const struct hidden_place *hidden, const char *hidden_map,
                          struct error *err);

#endif
