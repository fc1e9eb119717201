/* Models as POV-Ray includes: meshes, textures and finishes, once for all entities that look alike. */
#ifndef STAFFAGE_GEN_MODEL_SDL_H
#define STAFFAGE_GEN_MODEL_SDL_H

#include "gen/world/entity.h"
#include "lib/error.h"

#include <stdbool.h>
#include <stddef.h>

/* POV-Ray runs in the output folder: scenes name what they include relative to it. */
#define MODELS_FOLDER "frames/models"
#define TEXTURES_FOLDER "frames/textures"

/* The name under which a model is declared, and the file that declares it, relative to the output folder. */
struct model_include { char name[48], path[96]; };

/* Of an entity's model in its colour: entities of one model and colour share it. */
struct model_include model_include(size_t model_index, const struct entity *entity);
/* Of a model that is posed for one entity in one frame ("000123"). */
struct model_include model_include_posed(const char *frame, const struct entity *entity);

/* Which include files a run has written already. */
struct include_set { char (*names)[48]; size_t n; };
void include_set_release(struct include_set *set);

/* Write the include file of an entity's model in its colour, and its textures; once a run, whatever an
 * earlier one left.
 * In:  written   NULL: always write
 * Err: ERR_IO, ERR_MEMORY */
bool model_include_write(const struct model_include *include, struct include_set *written, const char *out_folder,
                         const struct entity *entity, struct error *err);

#endif
