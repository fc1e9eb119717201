/* From a scene to frames: everything loaded once, then frame by frame. */
#ifndef STAFFAGE_GEN_GENERATOR_H
#define STAFFAGE_GEN_GENERATOR_H

#include "gen/frame.h"
#include "gen/render/passes.h"
#include "gen/scene/scene.h"
#include "lib/error.h"

#include <stdbool.h>
#include <stddef.h>

/* Everything that is loaded once for all frames. */
struct generator;

/* Load models, light and tracer, and check what the scene file alone cannot tell.
 * In: scene and out_folder are borrowed for the generator's life; rules_path: the material
 *     rules when the scene names none
 * Out: *generator, the caller's
 * Err: ERR_INPUT at the user's file and line */
bool generator_create(struct generator **generator, const struct scene *scene, const char *out_folder,
                      const char *rules_path, struct error *err);
void generator_destroy(struct generator *generator);

/* How many frames the scene has, and the name of each. */
size_t generator_frame_count(const struct generator *generator);
void generator_frame_name(char name[FRAME_NAME_SIZE], const struct generator *generator, size_t frame);

/* What is no error and yet not as it should be: one line each, in the order found. */
size_t generator_warning_count(const struct generator *generator);
const char *generator_warning(const struct generator *generator, size_t i);

/* What was found of north and light in the photographs, a line each with a newline; empty where the scene gives both. The caller
 * frees; NULL when memory ends. */
char *generator_light_text(const struct generator *generator);

/* Take the photographs of the frames first ... end-1 out of the video, those that are missing;
 * nothing to do for files. Call before generator_frame. */
bool generator_prepare(struct generator *generator, const size_t *frames, size_t n, struct error *err);

/* How its passes are rendered. */
struct pass_settings generator_pass_settings(const struct generator *generator);

/* Generate one frame, unless it is there from the same input. */
bool generator_frame(struct frame_result *result, struct generator *generator, size_t frame, struct error *err);

/* Add warnings of entities that no frame shows, or none larger than a few pixels. A part of the scene's frames does not tell
 * what the others show: of it nothing is said.
 * In:  frames (n)   those of this run
 * Err: ERR_IO, ERR_INPUT: labels that cannot be read; ERR_MEMORY */
bool generator_warn_of_unseen(struct generator *generator, const struct frame_result *frames, size_t n, struct error *err);

/* OUT/run.json: version, scene and its hash, settings, light, frames; those of earlier runs of the same
 * input, too.
 * Out: others   frames in the folder that are of another input, which run.json no longer names */
bool generator_write_run(const struct generator *generator, const struct frame_result *frames, size_t n,
                         size_t *others, struct error *err);

#endif
