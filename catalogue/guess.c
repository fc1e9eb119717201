#include "catalogue/guess.h"

#include "catalogue/front.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define UNITS 6
#define UNITS_MORE 2 /* what the file states, and none that anybody uses */
#define AXES 6
#define GLANCES 2 /* of the front's axis: the two that are not up */

/* --- what things are like --- */

/* Medians and spreads (standard deviation of the logarithm) of length, width and height, of what is modelled: people with
 * their arms as they have them, cycles with and without a rider. Share: how often such a model comes. */
struct kind { double size_m[3], spread[3], share; const char *words[12]; };
static const struct kind kinds[CLASS_COUNT] = {
    [CLASS_PERSON] = { { 0.35, 0.65, 1.68 }, { 0.5, 0.4, 0.13 }, 4,
                       { "person", "man", "woman", "human", "girl", "boy", "walker", "pedestrian", "people" } },
    [CLASS_RIDER] = { { 0.8, 0.6, 1.5 }, { 0.3, 0.3, 0.15 }, 0.1, { "rider" } },
    [CLASS_CAR] = { { 4.4, 1.85, 1.5 }, { 0.15, 0.12, 0.13 }, 8,
                    { "car", "sedan", "hatchback", "suv", "coupe", "taxi", "estate", "minivan", "mpv", "pickup", "wagon" } },
    [CLASS_VAN] = { { 5.3, 2.05, 2.2 }, { 0.14, 0.1, 0.15 }, 1.5, { "van", "minibus", "transporter" } },
    [CLASS_TRUCK] = { { 8, 2.5, 3.2 }, { 0.35, 0.1, 0.2 }, 1.5, { "truck", "lorry", "tipper" } },
    [CLASS_BUS] = { { 12, 2.6, 3.1 }, { 0.2, 0.08, 0.12 }, 1, { "bus", "coach" } },
    [CLASS_TRAIN] = { { 25, 2.8, 3.8 }, { 0.4, 0.1, 0.15 }, 0.2, { "train", "tram", "locomotive" } },
    [CLASS_MOTORCYCLE] = { { 2.1, 0.8, 1.3 }, { 0.12, 0.22, 0.22 }, 0.7, { "motorcycle", "motorbike", "scooter", "moped" } },
    [CLASS_BICYCLE] = { { 1.75, 0.6, 1.25 }, { 0.1, 0.2, 0.25 }, 0.7, { "bicycle", "bike", "cycle" } },
    [CLASS_AMBULANCE] = { { 6, 2.2, 2.7 }, { 0.18, 0.15, 0.15 }, 0.2, { "ambulance" } },
    [CLASS_FIRE_TRUCK] = { { 8.5, 2.5, 3.3 }, { 0.2, 0.07, 0.12 }, 0.2, { "firetruck", "fireengine", "fire" } },
    [CLASS_CONSTRUCTION] = { { 7, 2.6, 3.2 }, { 0.35, 0.15, 0.25 }, 0.2, { "excavator", "digger", "bulldozer", "crane", "dumper" } },
    [CLASS_ANIMAL] = { { 1, 0.4, 0.8 }, { 0.6, 0.5, 0.5 }, 0.2, { "dog", "cat", "horse", "cow", "deer", "sheep", "bird" } },
    [CLASS_OTHER] = { { 1, 1, 1 }, { 1.2, 1.2, 1.2 }, 0.1, { NULL } },
};
#define WORD_SHARE 1000.0 /* where a word of the name says what it is */

static const struct { double unit_m, share; } units[UNITS] = {
    { 1, 40 }, { 0.01, 25 }, { 0.001, 12 }, { 0.0254, 15 }, { 0.3048, 4 }, { 0.1, 4 } };
/* To 1, that a file is right in what it states: programs turn axes right more often than they scale units. */
#define UNIT_RIGHT 9.0
#define AXES_RIGHT 30.0
/* That a file is in no unit at all: then it is as long as things of its class are. */
#define UNIT_FREE (UNITS + UNITS_MORE - 1) /* its place among the units */
#define UNIT_FREE_SHARE 0.0015

bool class_size(struct vec3 *size_m, enum entity_class class_)
{
    const double *s = kinds[class_].size_m;
    *size_m = vec3(s[0], s[1], s[2]);
    return class_ != CLASS_OTHER && class_ != CLASS_ANIMAL;
}

/* Is a word of the name that word? "red_sedan-2" has the words red and sedan; of "firetruck", fire is none. */
static bool has_word(const char *name, const char *word)
{
    size_t n = strlen(word);
    for (const char *c = name; *c; c++) {
        bool begins = c == name || !isalpha((unsigned char)c[-1]) || (isupper((unsigned char)*c) && islower((unsigned char)c[-1]));
        size_t k = 0;
        while (begins && k < n && tolower((unsigned char)c[k]) == word[k]) k++;
        if (begins && k == n && !islower((unsigned char)c[k])) return true;
    }
    return false;
}

static double class_share(enum entity_class class_, const struct known *known)
{
    if (known->has_class) return class_ == known->class_;
    for (int i = 0; i < 12 && kinds[class_].words[i]; i++)
        if (has_word(known->name, kinds[class_].words[i])) return WORD_SHARE;
    return kinds[class_].share;
}

/* --- size: class, unit, up and the line of the front --- */

static double extent(const struct model *raw, int axis)
{
    struct vec3 d = vec3_sub(raw->max_m, raw->min_m);
    return (axis == 0 ? d.x : axis == 1 ? d.y : d.z) / raw->unit_m;
}

static double misfit(const double size_m[3], enum entity_class class_)
{
    double worst = 0;
    for (int k = 0; k < 3; k++)
        worst = fmax(worst, fabs(log(size_m[k] / kinds[class_].size_m[k])) / kinds[class_].spread[k]);
    return worst;
}

static double likelihood(const double size_m[3], enum entity_class class_)
{
    double log_sum = 0;
    for (int k = 0; k < 3; k++) {
        double spread = kinds[class_].spread[k], off = log(fmax(size_m[k], 1e-9) / kinds[class_].size_m[k]) / spread;
        log_sum -= off * off / 2 + log(spread);
    }
    return log_sum;
}

static double up_share(int up, const struct known *known)
{
    if (known->has_up) return up == (int)known->up;
    if (known->format_has_axes) return up == AXIS_POS_Y ? AXES_RIGHT : up == AXIS_POS_Z ? 0.9 : 0.025;
    return up == AXIS_POS_Y || up == AXIS_POS_Z ? 1 : 0.005;
}

static double along_share(int up, int along, const struct known *known)
{
    if (along == up / 2) return 0;
    if (known->has_front) return along == (int)known->front / 2;
    if (known->format_has_axes && up / 2 == AXIS_POS_Y / 2) return along == AXIS_POS_Z / 2 ? AXES_RIGHT : 1;
    return 1;
}

/* The units to think of, with their shares. Returns how many. */
static int unit_choices(double unit_m[UNITS + UNITS_MORE], double share[UNITS + UNITS_MORE], const struct model *raw, enum entity_class class_, int up, int along,
                        const struct known *known)
{
    int n = 0;
    double given = known->unit_m > 0     ? known->unit_m
                   : known->length_m > 0 ? known->length_m / extent(raw, along)
                   : known->height_m > 0 ? known->height_m / extent(raw, up / 2)
                                         : 0;
    if (given > 0) {
        unit_m[0] = given;
        share[0] = 1;
        return 1;
    }
    for (; n < UNITS; n++) {
        unit_m[n] = units[n].unit_m;
        share[n] = units[n].share / 100;
    }
    if (known->stated_unit_m > 0) {
        unit_m[n] = known->stated_unit_m;
        share[n++] = UNIT_RIGHT;
    }
    unit_m[n] = kinds[class_].size_m[0] / extent(raw, along);
    share[n++] = UNIT_FREE_SHARE;
    return n;
}

struct sums { double class_[CLASS_COUNT], unit[UNITS + UNITS_MORE], up[AXES], along[3], total; };

static void weigh_size(struct guess *guess, const struct model *raw, const struct known *known)
{
    struct sums sums = { 0 };
    double best = -INFINITY, peak = -INFINITY;
    /* Twice: the best of all first, so that the sums are relative to it and none runs out of a double's range. */
    for (int pass = 0; pass < 2; pass++)
        for (int c = 0; c < CLASS_COUNT; c++)
            for (int up = 0; up < AXES; up++)
                for (int along = 0; along < 3; along++) {
                    double unit[UNITS + UNITS_MORE], share[UNITS + UNITS_MORE];
                    double prior = class_share((enum entity_class)c, known) * up_share(up, known) * along_share(up, along, known);
                    int n = prior > 0 ? unit_choices(unit, share, raw, (enum entity_class)c, up, along, known) : 0, across = 3 - along - up / 2;
                    for (int u = 0; u < n; u++) {
                        double size_m[3] = { unit[u] * extent(raw, along), unit[u] * extent(raw, across), unit[u] * extent(raw, up / 2) };
                        double score = log(prior * share[u]) + likelihood(size_m, (enum entity_class)c);
                        if (pass == 0) {
                            if (score > peak) peak = score;
                            continue;
                        }
                        double weight = exp(score - peak);
                        sums.class_[c] += weight;
                        /* What the file states is one of the others when it says the same. */
                        int same = n > 1 && u == n - 1 ? UNIT_FREE : u;
                        for (int k = 0; k < u; k++)
                            if (fabs(unit[k] / unit[u] - 1) < 1e-6) same = k;
                        sums.unit[same] += weight;
                        sums.up[up] += weight;
                        sums.along[along] += weight;
                        sums.total += weight;
                        if (score <= best) continue;
                        best = score;
                        guess->class_ = (enum entity_class)c;
                        guess->unit_m = unit[u];
                        guess->unit_sure = same; /* for now: which one */
                        guess->up = (enum axis)up;
                        guess->front = (enum axis)(2 * along);
                        guess->misfit = misfit(size_m, (enum entity_class)c);
                    }
                }
    guess->class_sure = sums.class_[guess->class_] / sums.total;
    guess->unit_sure = guess->unit_sure == UNIT_FREE ? 0 : sums.unit[(int)guess->unit_sure] / sums.total;
    guess->up_sure = sums.up[guess->up] / sums.total;
    guess->along_sure = sums.along[guess->front / 2] / sums.total;
}

/* --- all of it --- */

struct guess guess_model(const struct model *raw, const struct known *known)
{
    struct guess guess = { .front_by = "the user" };
    weigh_size(&guess, raw, known);
    bool is_person = class_info(guess.class_)->is_person;
    int along = (int)guess.front / 2;
    if (known->has_front) {
        guess.front = known->front;
        guess.front_sure = 1;
        return guess;
    }
    double line_odds = is_person ? front_line_odds(raw, guess.up, along) : 1;
    guess.along_sure *= line_odds / (1 - guess.along_sure + line_odds * guess.along_sure);
    if (is_person && guess.along_sure < 0.5) {
        along = 3 - along - (int)guess.up / 2;
        guess.along_sure = 1 - guess.along_sure;
    }
    double odds = front_odds(&guess.front_by, raw, guess.up, along, is_person);
    bool stated = known->format_has_axes && guess.up == AXIS_POS_Y && along == AXIS_POS_Z / 2;
    if (stated) {
        if (odds > 1 / AXES_RIGHT) guess.front_by = "the format";
        odds *= AXES_RIGHT;
    }
    guess.front = (enum axis)(2 * along + (odds < 1));
    guess.front_sure = fmax(odds, 1 / odds) / (1 + fmax(odds, 1 / odds));
    return guess;
}
