/* Memory, or the end of the program: what makes the cast has nothing to save. */
#ifndef STAFFAGE_CAST_NEED_H
#define STAFFAGE_CAST_NEED_H

#include <stdlib.h>

static inline void *need(void *memory)
{
    if (!memory) abort();
    return memory;
}

#endif
