/* A function of space. Of a solid: about the distance to its surface in metres, negative inside. */
#ifndef STAFFAGE_CAST_FORM_H
#define STAFFAGE_CAST_FORM_H

#include "lib/vec.h"

struct form { double (*at)(const void *self, struct vec3 p); const void *self; };
static inline double form_at(const struct form *form, struct vec3 p) { return form->at(form->self, p); }

#endif
