/* The scene file that a user of the tool would write for a case. */
#ifndef STAFFAGE_PROVING_WRITE_SCENE_H
#define STAFFAGE_PROVING_WRITE_SCENE_H

#include "cases.h"

/* variant: known (light and exposure are told), fitted (the light is told, the exposure is fitted to asphalt), auto (both are
 * to be found in the photograph), light (no photograph yet: a grey stand-in, from above, for the tool to write its sun, its
 * sky and its models).
 * In: camera at the size of the photographs; models: folder of the models; method: of transfer */
bool write_scene(const char *path, const struct proving_case *c, const char *variant, const char *method,
                 const struct camera *camera, const char *models, struct error *err);

#endif
