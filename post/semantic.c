#include "post/semantic.h"

#include <stdlib.h>

bool semantic_classes(struct image *classes, const struct image *instance, const struct manifest *manifest,
                      struct error *err)
{
    if (!image_init(classes, instance->width_px, instance->height_px, 1, PIXEL_U8, err)) return false;
    uint8_t *class_of_id = calloc(65536, 1);
    if (!class_of_id) {
        image_release(classes);
        return error_set(err, ERR_MEMORY, "no memory for a table of classes");
    }
    for (size_t i = 0; i < manifest->entity_count; i++)
        class_of_id[manifest->entities[i].id] = (uint8_t)(1 + manifest->entities[i].class_);
    const uint16_t *from = instance->data;
    uint8_t *to = classes->data;
    size_t width = (size_t)instance->width_px, n = width * (size_t)instance->height_px, i;
    for (i = 0; i < n; i++) {
        to[i] = from[i] ? class_of_id[from[i]] : 0;
        if (from[i] && !to[i]) break;
    }
    free(class_of_id);
    if (i == n) return true;
    image_release(classes);
    return error_set(err, ERR_INPUT, "pixel %zu,%zu has id %u, which no entity of the frame has", i % width, i / width,
                     from[i]);
}

bool semantic_color(struct image *color, const struct image *classes, struct error *err)
{
    if (!image_init(color, classes->width_px, classes->height_px, 3, PIXEL_U8, err)) return false;
    const uint8_t *from = classes->data;
    uint8_t *to = color->data;
    size_t n = (size_t)color->width_px * (size_t)color->height_px;
    for (size_t i = 0; i < n; i++)
        for (size_t c = 0; from[i] && c < 3; c++) to[3 * i + c] = class_info((enum entity_class)(from[i] - 1))->color[c];
    return true;
}

bool semantic_ids(struct image *ids, const struct image *classes, struct error *err)
{
    if (!image_init(ids, classes->width_px, classes->height_px, 1, PIXEL_U8, err)) return false;
    const uint8_t *from = classes->data;
    uint8_t *to = ids->data;
    size_t n = (size_t)ids->width_px * (size_t)ids->height_px;
    for (size_t i = 0; i < n; i++)
        if (from[i]) to[i] = class_info((enum entity_class)(from[i] - 1))->semantic_id;
    return true;
}
