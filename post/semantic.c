#include "post/semantic.h"

#include <stdlib.h>
#include <string.h>

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

int semantic_id_of_color(enum palette palette, const uint8_t color[3])
{
    size_t n;
    const struct palette_label *labels = palette_labels(palette, &n);
    for (size_t i = 0; i < n; i++)
        if (!memcmp(labels[i].color, color, 3)) return labels[i].id;
    for (int c = 0; c < CLASS_COUNT; c++) {
        struct palette_label label = palette_entity(palette, (enum entity_class)c);
        if (!memcmp(label.color, color, 3)) return label.id;
    }
    return -1;
}

static void colors_of_ids(uint8_t colors[256][3], enum palette palette)
{
    size_t n;
    const struct palette_label *labels = palette_labels(palette, &n);
    memset(colors, 0, 256 * sizeof *colors);
    for (size_t i = 0; i < n; i++) memcpy(colors[labels[i].id], labels[i].color, 3);
}

bool semantic_color(struct image *color, const struct image *classes, const struct image *before, enum palette palette,
                    struct error *err)
{
    bool own = before->data && before->channels >= 3;
    if (!image_init(color, classes->width_px, classes->height_px, own ? before->channels : 3, PIXEL_U8, err)) return false;
    uint8_t of_id[256][3];
    colors_of_ids(of_id, palette);
    if (own) memcpy(color->data, before->data, image_size(before));
    const uint8_t *class_ = classes->data, *ids = own ? NULL : before->data;
    uint8_t *to = color->data;
    size_t n = (size_t)color->width_px * (size_t)color->height_px, channels = (size_t)color->channels;
    for (size_t i = 0; i < n; i++, to += channels) {
        if (class_[i]) {
            struct palette_label label = palette_entity(palette, (enum entity_class)(class_[i] - 1));
            memcpy(to, label.color, 3);
            if (channels == 4) to[3] = 255;
        } else if (ids) {
            memcpy(to, of_id[ids[i]], 3);
        }
    }
    return true;
}

bool semantic_ids(struct image *ids, const struct image *classes, const struct image *before, enum palette palette,
                  struct error *err)
{
    if (!image_init(ids, classes->width_px, classes->height_px, 1, PIXEL_U8, err)) return false;
    const uint8_t *class_ = classes->data, *from = before->data;
    uint8_t *to = ids->data, last[3] = { 0 };
    int last_id = semantic_id_of_color(palette, last); /* neighbours mostly have one colour */
    size_t n = (size_t)ids->width_px * (size_t)ids->height_px, channels = (size_t)before->channels;
    for (size_t i = 0; i < n; i++) {
        if (class_[i]) {
            to[i] = palette_entity(palette, (enum entity_class)(class_[i] - 1)).id;
        } else if (from && channels == 1) {
            to[i] = from[i];
        } else if (from) {
            if (memcmp(last, from + channels * i, 3) != 0) {
                memcpy(last, from + channels * i, 3);
                last_id = semantic_id_of_color(palette, last);
            }
            to[i] = (uint8_t)(last_id < 0 ? 0 : last_id);
        }
    }
    return true;
}
