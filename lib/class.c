#include "lib/class.h"

#include <string.h>

/* Ids and colours are Cityscapes' where it has the class (FORMATS.md); the kinds of
 * vehicle that it does not tell apart take the id of the nearest one, and a colour of their own. */
static const struct class_info classes[CLASS_COUNT] = {
    [CLASS_PERSON] = { "person", 24, { 220, 20, 60 }, true },
    [CLASS_RIDER] = { "rider", 25, { 255, 0, 0 }, true },
    [CLASS_CAR] = { "car", 26, { 0, 0, 142 }, false },
    [CLASS_VAN] = { "van", 26, { 0, 30, 170 }, false },
    [CLASS_TRUCK] = { "truck", 27, { 0, 0, 70 }, false },
    [CLASS_BUS] = { "bus", 28, { 0, 60, 100 }, false },
    [CLASS_TRAIN] = { "train", 31, { 0, 80, 100 }, false },
    [CLASS_MOTORCYCLE] = { "motorcycle", 32, { 0, 0, 230 }, false },
    [CLASS_BICYCLE] = { "bicycle", 33, { 119, 11, 32 }, false },
    [CLASS_AMBULANCE] = { "ambulance", 27, { 200, 0, 120 }, false },
    [CLASS_FIRE_TRUCK] = { "fire truck", 27, { 200, 60, 0 }, false },
    [CLASS_CONSTRUCTION] = { "construction vehicle", 27, { 200, 160, 0 }, false },
    [CLASS_ANIMAL] = { "animal", 5, { 111, 74, 0 }, false },
    [CLASS_OTHER] = { "other", 5, { 111, 111, 0 }, false },
};

const struct class_info *class_info(enum entity_class c)
{
    return &classes[c];
}

bool class_from_name(enum entity_class *c, const char *name)
{
    for (int i = 0; i < CLASS_COUNT; i++)
        if (!strcmp(classes[i].name, name)) {
            *c = (enum entity_class)i;
            return true;
        }
    return false;
}
