/* glTF 2.0: images and materials. */
#include "gen/model/model_gltf.h"
#include "lib/file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The import's index of a texture's image; images keep their order. */
static bool use_image(struct gltf_loader *l, int *image, const struct gltf_texture_use *use)
{
    *image = NO_IMAGE;
    if (use->texture < 0) return true;
    if ((size_t)use->texture >= l->gltf->texture_count) return GLTF_FAIL(l, "texture %d of %zu does not exist", use->texture, l->gltf->texture_count);
    int source = l->gltf->textures[use->texture].image;
    if (source < 0) return true; /* an image of an extension's format */
    if ((size_t)source >= l->gltf->image_count) return GLTF_FAIL(l, "image %d of %zu does not exist", source, l->gltf->image_count);
    *image = source;
    return true;
}

static int hex(char c)
{
    return c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/* %20 and the like. */
static void decode_uri(char *uri)
{
    char *to = uri;
    for (const char *from = uri; *from; from++) {
        if (from[0] == '%' && hex(from[1]) >= 0 && hex(from[2]) >= 0) {
            *to++ = (char)(16 * hex(from[1]) + hex(from[2]));
            from += 2;
        } else {
            *to++ = *from;
        }
    }
    *to = 0;
}

bool gltf_add_images(struct gltf_loader *l)
{
    const struct gltf *g = l->gltf;
    l->import->images = calloc(g->image_count + 1, sizeof *l->import->images);
    if (!l->import->images) return gltf_no_memory(l);
    l->import->image_count = g->image_count;
    for (size_t i = 0; i < g->image_count; i++) {
        struct import_image *to = &l->import->images[i];
        const struct gltf_image *from = &g->images[i];
        const uint8_t *data = from->data;
        to->name = from->uri ? strdup(from->uri) : string_format("embedded image %zu", i);
        if (!to->name) return gltf_no_memory(l);
        if (from->uri) {
            decode_uri(to->name);
            continue;
        }
        to->size = from->size;
        if (from->view >= 0 && (size_t)from->view < g->view_count) {
            size_t stride;
            to->size = g->views[from->view].size;
            data = gltf_elements(l, from->view, 0, to->size, 1, &stride);
        }
        if (!data) {
            GLTF_FAIL(l, "has no data");
            return error_prefix(l->err, "image %zu: ", i);
        }
        if (!(to->data = malloc(to->size + 1))) return gltf_no_memory(l);
        memcpy(to->data, data, to->size);
    }
    return true;
}

static double unit(double x)
{
    return x > 0 ? x < 1 ? x : 1 : 0;
}

bool gltf_add_materials(struct gltf_loader *l)
{
    for (size_t i = 0; i < l->gltf->material_count; i++) {
        const struct gltf_material *from = &l->gltf->materials[i];
        struct import_material *to = import_add_material(l->import, from->name, l->err);
        if (!to) return false;
        struct material *m = &to->material;
        m->names_only = !from->has_figures;
        for (int k = 0; k < 3; k++) {
            m->base_color[k] = unit(from->base_color[k]);
            m->emissive[k] = fmax(from->emissive[k], 0);
        }
        m->alpha = unit(from->base_color[3]);
        m->alpha_mode = !strcmp(from->alpha_mode, "MASK") ? ALPHA_MASK : !strcmp(from->alpha_mode, "BLEND") ? ALPHA_BLEND : ALPHA_OPAQUE;
        m->alpha_cutoff = from->alpha_cutoff;
        m->metallic = from->has_figures ? unit(from->metallic) : 0;
        m->roughness = unit(from->roughness);
        m->clearcoat = unit(from->clearcoat);
        m->clearcoat_roughness = unit(from->clearcoat_roughness);
        m->transmission = unit(from->transmission);
        m->ior = from->ior >= 1 && from->ior <= 3 ? from->ior : 1.5;
        if (!use_image(l, &to->base, &from->base) || !use_image(l, &to->metallic_roughness, &from->metallic_roughness) ||
            !use_image(l, &to->emissive, &from->emissive_texture))
            return error_prefix(l->err, "material %zu: ", i);
    }
    return true;
}
