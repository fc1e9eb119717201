/* What an entity is: names, ids and colours of the classes. */
#ifndef STAFFAGE_LIB_CLASS_H
#define STAFFAGE_LIB_CLASS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum entity_class {
    CLASS_PERSON, CLASS_RIDER, CLASS_CAR, CLASS_VAN, CLASS_TRUCK, CLASS_BUS, CLASS_TRAIN,
    CLASS_MOTORCYCLE, CLASS_BICYCLE, CLASS_AMBULANCE, CLASS_FIRE_TRUCK, CLASS_CONSTRUCTION, CLASS_ANIMAL,
    CLASS_OTHER, CLASS_COUNT
};

struct class_info {
    const char *name;      /* in scene files and labels: "car" */
    uint8_t semantic_id;   /* in semantic_id/: the Cityscapes labelId of the nearest class */
    uint8_t color[3];      /* in semantic/: sRGB */
    bool is_person;        /* the papers' thresholds and masks tell people from vehicles */
};

const struct class_info *class_info(enum entity_class c);

/* Which label set semantic images are written in. */
enum palette { PALETTE_CITYSCAPES, PALETTE_UAVID, PALETTE_COUNT };
/* "cityscapes", "uavid"; NULL from PALETTE_COUNT on. */
const char *palette_name(int palette);
/* A label of a palette: an id and its colour. UAVid's ids are in the order of FORMATS.md's list, from 0. */
struct palette_label { const char *name; uint8_t id; uint8_t color[3]; };
/* Out: *n. Static, by id. */
const struct palette_label *palette_labels(enum palette palette, size_t *n);
/* The label that an entity's pixels get: for Cityscapes class_info's; for UAVid human, moving car,
 * or clutter for what is neither (a bicycle, a train, an animal). */
struct palette_label palette_entity(enum palette palette, enum entity_class c);
bool class_from_name(enum entity_class *c, const char *name);

#endif
