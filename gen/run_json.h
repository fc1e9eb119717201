/* OUT/run.json: what a run was made from, the light that was found, and the frames that are there. */
#ifndef STAFFAGE_GEN_RUN_JSON_H
#define STAFFAGE_GEN_RUN_JSON_H

#include "gen/estimate/estimate.h"
#include "gen/frame.h"
#include "gen/light/light.h"
#include "gen/scene/scene.h"
#include "lib/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Borrowed. */
struct run_facts {
    const struct scene *scene;
    const struct light *light;
    const struct light_estimate *estimate; /* NULL where the scene tells the light */
    uint64_t input_hash;                   /* of all that every frame depends on */
};

/* Of level ground in the sun, without anything round it. */
void run_ground_radiance(double rgb[3], const struct run_facts *facts);

/* In:  path   the file: frames that it names already stay in it if the same input made them and the scene still has them
 *      frames (n)   those of this run
 * Out: others   frames in the folder that are of another input, which it no longer names
 * Err: ERR_IO, ERR_MEMORY */
bool run_json_write(size_t *others, const char *path, const struct run_facts *facts, const struct frame_result *frames, size_t n,
                    struct error *err);

#endif
