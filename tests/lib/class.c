#include "lib/class.h"

#include "tests/tap.h"

/* Whether a label of the palette has this id, name and colour. */
static bool has(enum palette palette, int id, const char *name, int r, int g, int b)
{
    size_t n;
    const struct palette_label *l = palette_labels(palette, &n);
    for (size_t i = 0; i < n; i++)
        if (l[i].id == id) return !strcmp(l[i].name, name) && l[i].color[0] == r && l[i].color[1] == g && l[i].color[2] == b;
    return false;
}

static bool is(enum palette palette, enum entity_class c, const char *name, int id, int r, int g, int b)
{
    struct palette_label l = palette_entity(palette, c);
    return !strcmp(l.name, name) && l.id == id && l.color[0] == r && l.color[1] == g && l.color[2] == b;
}

int main(void)
{
    OK(!strcmp(palette_name(PALETTE_CITYSCAPES), "cityscapes") && !strcmp(palette_name(PALETTE_UAVID), "uavid"), "palettes have names");
    OK(!palette_name(PALETTE_COUNT) && !palette_name(-1), "and there are no others");
    for (int p = 0; p < PALETTE_COUNT; p++) {
        size_t n, i = 1;
        const struct palette_label *l = palette_labels((enum palette)p, &n);
        while (i < n && l[i - 1].id < l[i].id) i++;
        OK(n > 0 && i == n, "%s is in the order of its ids", palette_name(p));
        bool known = true;
        for (int c = 0; c < CLASS_COUNT; c++) {
            struct palette_label e = palette_entity((enum palette)p, (enum entity_class)c);
            bool found = false;
            for (i = 0; i < n; i++) found = found || l[i].id == e.id;
            known = known && found;
        }
        OK(known, "every class gets an id that %s has", palette_name(p));
    }
    OK(has(PALETTE_UAVID, 0, "clutter", 0, 0, 0) && has(PALETTE_UAVID, 3, "static car", 192, 0, 192) &&
           has(PALETTE_UAVID, 6, "human", 64, 64, 0) && has(PALETTE_UAVID, 7, "moving car", 64, 0, 128),
       "UAVid's ids follow its published colours, from 0");
    OK(has(PALETTE_CITYSCAPES, 7, "road", 128, 64, 128) && has(PALETTE_CITYSCAPES, 8, "sidewalk", 244, 35, 232) &&
           has(PALETTE_CITYSCAPES, 21, "vegetation", 107, 142, 35) && has(PALETTE_CITYSCAPES, 23, "sky", 70, 130, 180),
       "Cityscapes' ids and colours are the published ones");
    OK(is(PALETTE_CITYSCAPES, CLASS_CAR, "car", 26, 0, 0, 142) && is(PALETTE_CITYSCAPES, CLASS_VAN, "van", 26, 0, 30, 170),
       "in Cityscapes a van is a car of another colour");
    OK(is(PALETTE_UAVID, CLASS_CAR, "moving car", 7, 64, 0, 128) && is(PALETTE_UAVID, CLASS_BUS, "moving car", 7, 64, 0, 128) &&
           is(PALETTE_UAVID, CLASS_PERSON, "human", 6, 64, 64, 0),
       "in UAVid vehicles are moving cars, people are human");
    OK(is(PALETTE_UAVID, CLASS_BICYCLE, "clutter", 0, 0, 0, 0) && is(PALETTE_UAVID, CLASS_ANIMAL, "clutter", 0, 0, 0, 0),
       "and what is neither is clutter");
    return tap_done();
}
