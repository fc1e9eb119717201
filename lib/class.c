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

/* Src: the Cityscapes label list; its ids 0 to 3 are all black and mean "nothing" here. */
static const struct palette_label cityscapes[] = {
    { "unlabeled", 0, { 0, 0, 0 } },          { "static", 4, { 0, 0, 0 } },
    { "dynamic", 5, { 111, 74, 0 } },         { "ground", 6, { 81, 0, 81 } },
    { "road", 7, { 128, 64, 128 } },          { "sidewalk", 8, { 244, 35, 232 } },
    { "parking", 9, { 250, 170, 160 } },      { "rail track", 10, { 230, 150, 140 } },
    { "building", 11, { 70, 70, 70 } },       { "wall", 12, { 102, 102, 156 } },
    { "fence", 13, { 190, 153, 153 } },       { "guard rail", 14, { 180, 165, 180 } },
    { "bridge", 15, { 150, 100, 100 } },      { "tunnel", 16, { 150, 120, 90 } },
    { "pole", 17, { 153, 153, 153 } },        { "pole group", 18, { 153, 153, 153 } },
    { "traffic light", 19, { 250, 170, 30 } },{ "traffic sign", 20, { 220, 220, 0 } },
    { "vegetation", 21, { 107, 142, 35 } },   { "terrain", 22, { 152, 251, 152 } },
    { "sky", 23, { 70, 130, 180 } },          { "person", 24, { 220, 20, 60 } },
    { "rider", 25, { 255, 0, 0 } },           { "car", 26, { 0, 0, 142 } },
    { "truck", 27, { 0, 0, 70 } },            { "bus", 28, { 0, 60, 100 } },
    { "caravan", 29, { 0, 0, 90 } },          { "trailer", 30, { 0, 0, 110 } },
    { "train", 31, { 0, 80, 100 } },          { "motorcycle", 32, { 0, 0, 230 } },
    { "bicycle", 33, { 119, 11, 32 } },
};

enum { UAVID_CLUTTER, UAVID_BUILDING, UAVID_ROAD, UAVID_STATIC_CAR, UAVID_TREE, UAVID_LOW_VEGETATION, UAVID_HUMAN, UAVID_MOVING_CAR };
static const struct palette_label uavid[] = {
    { "clutter", UAVID_CLUTTER, { 0, 0, 0 } },
    { "building", UAVID_BUILDING, { 128, 0, 0 } },
    { "road", UAVID_ROAD, { 128, 64, 128 } },
    { "static car", UAVID_STATIC_CAR, { 192, 0, 192 } },
    { "tree", UAVID_TREE, { 0, 128, 0 } },
    { "low vegetation", UAVID_LOW_VEGETATION, { 128, 128, 0 } },
    { "human", UAVID_HUMAN, { 64, 64, 0 } },
    { "moving car", UAVID_MOVING_CAR, { 64, 0, 128 } },
};

const char *palette_name(int palette)
{
    static const char *const names[PALETTE_COUNT] = { [PALETTE_CITYSCAPES] = "cityscapes", [PALETTE_UAVID] = "uavid" };
    return palette >= 0 && palette < PALETTE_COUNT ? names[palette] : NULL;
}

const struct palette_label *palette_labels(enum palette palette, size_t *n)
{
    *n = palette == PALETTE_UAVID ? sizeof uavid / sizeof *uavid : sizeof cityscapes / sizeof *cityscapes;
    return palette == PALETTE_UAVID ? uavid : cityscapes;
}

/* UAVid's cars are what has four wheels or more and drives; bicycles and motorcycles are none. */
static const struct palette_label *uavid_of(enum entity_class c)
{
    switch (c) {
    case CLASS_PERSON: case CLASS_RIDER:
        return &uavid[UAVID_HUMAN];
    case CLASS_CAR: case CLASS_VAN: case CLASS_TRUCK: case CLASS_BUS:
    case CLASS_AMBULANCE: case CLASS_FIRE_TRUCK: case CLASS_CONSTRUCTION:
        return &uavid[UAVID_MOVING_CAR];
    default:
        return &uavid[UAVID_CLUTTER];
    }
}

struct palette_label palette_entity(enum palette palette, enum entity_class c)
{
    if (palette == PALETTE_UAVID) return *uavid_of(c);
    const struct class_info *i = &classes[c];
    return (struct palette_label){ i->name, i->semantic_id, { i->color[0], i->color[1], i->color[2] } };
}
