#include "gen/model/model_import.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Make room for one more element. */
static bool grow(void **array, size_t count, size_t element, struct error *err)
{
    if (count & (count - 1)) return true; /* capacity is the next power of two */
    void *grown = realloc(*array, (count ? 2 * count : 1) * element);
    if (!grown) return error_set(err, ERR_MEMORY, "no memory for a model");
    *array = grown;
    return true;
}

struct import_material *import_add_material(struct import *import, const char *name, struct error *err)
{
    void *array = import->materials;
    if (!grow(&array, import->material_count, sizeof *import->materials, err)) return NULL;
    import->materials = array;
    struct import_material *made = &import->materials[import->material_count++];
    *made = (struct import_material){ .base = NO_IMAGE, .opacity = NO_IMAGE, .metallic_roughness = NO_IMAGE, .emissive = NO_IMAGE };
    material_default(&made->material);
    snprintf(made->material.name, sizeof made->material.name, "%s", name);
    return made;
}

bool import_add_mesh(struct import *import, struct mesh *mesh, struct error *err)
{
    void *array = import->meshes;
    if (!grow(&array, import->mesh_count, sizeof *import->meshes, err)) return false;
    import->meshes = array;
    import->meshes[import->mesh_count++] = *mesh;
    *mesh = (struct mesh){ 0 };
    return true;
}

int import_add_image(struct import *import, const char *name, struct error *err)
{
    for (size_t i = 0; i < import->image_count; i++)
        if (!strcmp(import->images[i].name, name)) return (int)i;
    void *array = import->images;
    if (!grow(&array, import->image_count, sizeof *import->images, err)) return NO_IMAGE;
    import->images = array;
    char *copy = strdup(name);
    if (!copy) {
        error_set(err, ERR_MEMORY, "no memory for a model");
        return NO_IMAGE;
    }
    import->images[import->image_count] = (struct import_image){ .name = copy };
    return (int)import->image_count++;
}

bool import_add_missing(struct import *import, const char *name, struct error *err)
{
    void *array = import->missing;
    if (!grow(&array, import->missing_count, sizeof *import->missing, err)) return false;
    import->missing = array;
    if (!(import->missing[import->missing_count] = strdup(name))) return error_set(err, ERR_MEMORY, "no memory for a model");
    import->missing_count++;
    return true;
}

void import_release(struct import *import)
{
    for (size_t i = 0; i < import->mesh_count; i++) mesh_release(&import->meshes[i]);
    for (size_t i = 0; i < import->image_count; i++) {
        free(import->images[i].name);
        free(import->images[i].data);
    }
    for (size_t i = 0; i < import->missing_count; i++) free(import->missing[i]);
    rig_destroy(import->rig);
    free(import->meshes);
    free(import->materials);
    free(import->images);
    free(import->missing);
    *import = (struct import){ 0 };
}
