/* Our walkers, as they are and with another way of their root. */
#ifndef STAFFAGE_TESTS_GEN_WALKER_FILES_H
#define STAFFAGE_TESTS_GEN_WALKER_FILES_H

#include "gen/model/gltf.h"
#include "tests/gen/model_files.h"

static const char *in_folder(const char *variable, const char *path)
{
    static char full[600];
    const char *top = getenv(variable);
    snprintf(full, sizeof full, "%s/%s", top ? top : ".", path);
    return full;
}

/* The same walk, but that the hips go `ahead_m` along the file's front (+z) in each loop, and sway by sway_m. */
__attribute__((unused))
static const char *put_going(const char *name, const char *walker, double ahead_m, double sway_m)
{
    struct error err = ERROR_NONE;
    char path[600], *data;
    size_t size;
    struct gltf gltf;
    snprintf(path, sizeof path, "%s", in_folder("top_builddir", walker));
    if (!file_read(&data, &size, path, &err)) return path_name(walker);
    if (gltf_read(&gltf, path, &err)) {
        uint32_t json_size;
        memcpy(&json_size, data + 12, 4);
        for (size_t i = 0; i < gltf.channel_count; i++) {
            if (gltf.channels[i].path != GLTF_TRANSLATION) continue;
            const struct gltf_accessor *values = &gltf.accessors[gltf.channels[i].output];
            char *at = data + 28 + json_size + gltf.views[values->view].offset;
            for (size_t k = 0; k < values->count; k++) {
                double t = (double)k / (double)(values->count - 1);
                float z;
                memcpy(&z, at + 12 * k + 8, 4);
                z += (float)(ahead_m * t + sway_m * sin(2 * M_PI * t));
                memcpy(at + 12 * k + 8, &z, 4);
            }
        }
        gltf_release(&gltf);
    }
    const char *made = put(name, data, size);
    free(data);
    return made;
}

#endif
