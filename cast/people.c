/* The people of the cast. Children have the median stature and mass of their age: WHO growth reference 2007 (stature),
 * CDC growth charts 2000 (mass). */
#include "cast/person.h"

/* sRGB. Nothing is darker than black cloth and leather are, some 3 to 5 % of the light. */
#define SKIN_PALE { 0.80, 0.66, 0.58 }
#define SKIN_LIGHT { 0.75, 0.60, 0.52 }
#define SKIN_OLIVE { 0.69, 0.53, 0.42 }
#define SKIN_TAN { 0.61, 0.45, 0.34 }
#define SKIN_BROWN { 0.47, 0.32, 0.24 }
#define SKIN_DARK { 0.36, 0.25, 0.19 }
#define HAIR_BLACK { 0.15, 0.14, 0.14 }
#define HAIR_DARK { 0.21, 0.16, 0.13 }
#define HAIR_BROWN { 0.30, 0.20, 0.13 }
#define HAIR_BLOND { 0.62, 0.48, 0.30 }
#define HAIR_RED { 0.46, 0.22, 0.11 }
#define HAIR_GREY { 0.56, 0.55, 0.53 }
#define WHITE { 0.86, 0.85, 0.82 }
#define BLACK { 0.20, 0.20, 0.21 }
#define DENIM { 0.27, 0.34, 0.47 }

const struct person people[] = {
    { .name = "man-jacket", .measures = { MALE, 34, 1.79, 78 }, .hair = SHORT_HAIR, .top = JACKET, .bottom = JEANS, .shoes = SNEAKERS, .hands = IN_POCKETS, .bottom_pattern = WORN,
      .skin = SKIN_LIGHT, .hair_color = HAIR_DARK, .top_color = { 0.20, 0.24, 0.31 }, .under_color = WHITE, .bottom_color = DENIM, .shoes_color = { 0.30, 0.30, 0.31 } },
    { .name = "man-shirt", .measures = { MALE, 27, 1.83, 74 }, .hair = CURLY_HAIR, .top = SHIRT, .bottom = TROUSERS, .shoes = SNEAKERS, .carried = BACKPACK, .top_pattern = CHECKS,
      .skin = SKIN_BROWN, .hair_color = HAIR_BLACK, .top_color = { 0.55, 0.17, 0.15 }, .bottom_color = { 0.33, 0.30, 0.25 }, .shoes_color = WHITE, .carried_color = { 0.20, 0.21, 0.23 }, .beard = true },
    { .name = "man-heavy", .measures = { MALE, 52, 1.76, 108 }, .hair = BALD, .top = T_SHIRT, .bottom = SHORTS, .shoes = SNEAKERS, .top_pattern = PLAIN,
      .skin = SKIN_PALE, .hair_color = HAIR_GREY, .top_color = { 0.20, 0.34, 0.30 }, .bottom_color = { 0.52, 0.47, 0.38 }, .shoes_color = { 0.23, 0.23, 0.25 }, .beard = true },
    { .name = "man-coat", .measures = { MALE, 45, 1.81, 84 }, .hair = SHORT_HAIR, .top = OPEN_COAT, .bottom = TROUSERS, .shoes = LEATHER_SHOES, .carried = HANDBAG,
      .skin = SKIN_OLIVE, .hair_color = HAIR_GREY, .top_color = { 0.22, 0.22, 0.23 }, .under_color = { 0.66, 0.72, 0.80 }, .bottom_color = { 0.21, 0.21, 0.23 }, .shoes_color = BLACK,
      .carried_color = { 0.24, 0.16, 0.11 } },
    { .name = "man-hoodie", .measures = { MALE, 21, 1.75, 66 }, .hair = CAP, .top = HOODIE, .bottom = JEANS, .shoes = SNEAKERS, .hands = AT_PHONE,
      .skin = SKIN_DARK, .hair_color = HAIR_BLACK, .top_color = { 0.52, 0.52, 0.53 }, .under_color = WHITE, .bottom_color = { 0.20, 0.21, 0.23 }, .shoes_color = { 0.70, 0.12, 0.10 },
      .carried_color = { 0.18, 0.20, 0.30 } },
    { .name = "man-sweater", .measures = { MALE, 68, 1.72, 76 }, .hair = BALD, .top = SWEATER, .bottom = TROUSERS, .shoes = LEATHER_SHOES,
      .skin = SKIN_LIGHT, .hair_color = { 0.75, 0.74, 0.72 }, .top_color = { 0.36, 0.14, 0.16 }, .bottom_color = { 0.42, 0.40, 0.36 }, .shoes_color = { 0.22, 0.14, 0.09 } },
    { .name = "woman-coat", .measures = { FEMALE, 41, 1.67, 63 }, .hair = LONG_HAIR, .top = OPEN_COAT, .bottom = TROUSERS, .shoes = LEATHER_SHOES, .carried = HANDBAG,
      .skin = SKIN_PALE, .hair_color = HAIR_BROWN, .top_color = { 0.55, 0.42, 0.30 }, .under_color = WHITE, .bottom_color = { 0.24, 0.24, 0.26 }, .shoes_color = BLACK,
      .carried_color = { 0.30, 0.17, 0.12 } },
    { .name = "woman-skirt", .measures = { FEMALE, 29, 1.64, 57 }, .hair = PONYTAIL, .top = SHIRT, .bottom = SKIRT, .shoes = LEATHER_SHOES, .carried = SHOULDER_BAG,
      .skin = SKIN_TAN, .hair_color = HAIR_BLACK, .top_color = { 0.80, 0.80, 0.84 }, .bottom_color = { 0.20, 0.24, 0.38 }, .shoes_color = { 0.35, 0.20, 0.12 }, .carried_color = { 0.40, 0.22, 0.12 } },
    { .name = "woman-dress", .measures = { FEMALE, 33, 1.70, 64 }, .hair = BOB_HAIR, .top = DRESS, .bottom = SKIRT, .shoes = LEATHER_SHOES, .top_pattern = PRINT,
      .skin = SKIN_LIGHT, .hair_color = HAIR_BLOND, .top_color = { 0.17, 0.37, 0.42 }, .bottom_color = { 0.17, 0.37, 0.42 }, .shoes_color = { 0.70, 0.60, 0.48 } },
    { .name = "woman-heavy", .measures = { FEMALE, 48, 1.62, 88 }, .hair = BUN, .top = SWEATER, .bottom = JEANS, .shoes = SNEAKERS,
      .skin = SKIN_BROWN, .hair_color = HAIR_DARK, .top_color = { 0.62, 0.45, 0.16 }, .bottom_color = { 0.20, 0.25, 0.36 }, .shoes_color = { 0.75, 0.74, 0.72 } },
    { .name = "woman-headscarf", .measures = { FEMALE, 36, 1.63, 61 }, .hair = HEADSCARF, .top = COAT, .bottom = LONG_SKIRT, .shoes = BOOTS,
      .skin = SKIN_OLIVE, .hair_color = HAIR_BLACK, .top_color = { 0.30, 0.31, 0.36 }, .under_color = { 0.62, 0.57, 0.52 }, .bottom_color = { 0.20, 0.20, 0.21 }, .shoes_color = BLACK },
    { .name = "woman-leggings", .measures = { FEMALE, 24, 1.71, 60 }, .hair = PONYTAIL, .top = T_SHIRT, .bottom = LEGGINGS, .shoes = SNEAKERS, .hands = AT_PHONE, .top_pattern = PLAIN,
      .skin = SKIN_LIGHT, .hair_color = HAIR_RED, .top_color = { 0.83, 0.35, 0.30 }, .bottom_color = BLACK, .shoes_color = { 0.55, 0.68, 0.36 }, .carried_color = BLACK },
    { .name = "woman-umbrella", .measures = { FEMALE, 66, 1.60, 68 }, .hair = SHORT_HAIR, .top = COAT, .bottom = TROUSERS, .shoes = BOOTS, .carried = UMBRELLA,
      .skin = SKIN_PALE, .hair_color = { 0.74, 0.73, 0.71 }, .top_color = { 0.42, 0.12, 0.16 }, .under_color = WHITE, .bottom_color = { 0.24, 0.24, 0.26 }, .shoes_color = { 0.22, 0.20, 0.18 },
      .carried_color = { 0.19, 0.20, 0.28 } },
    { .name = "boy-6", .measures = { MALE, 6, 1.16, 20.7 }, .hair = SHORT_HAIR, .top = T_SHIRT, .bottom = SHORTS, .shoes = SNEAKERS, .top_pattern = STRIPES,
      .skin = SKIN_LIGHT, .hair_color = HAIR_BLOND, .top_color = { 0.15, 0.25, 0.50 }, .bottom_color = { 0.35, 0.36, 0.30 }, .shoes_color = { 0.20, 0.30, 0.55 } },
    { .name = "girl-9", .measures = { FEMALE, 9, 1.325, 28.9 }, .hair = LONG_HAIR, .top = OPEN_JACKET, .bottom = LEGGINGS, .shoes = BOOTS,
      .skin = SKIN_TAN, .hair_color = HAIR_DARK, .top_color = { 0.70, 0.28, 0.42 }, .under_color = WHITE, .bottom_color = { 0.25, 0.24, 0.32 }, .shoes_color = { 0.40, 0.28, 0.20 } },
    { .name = "boy-13", .measures = { MALE, 13, 1.56, 45.5 }, .hair = BEANIE, .top = HOODIE, .bottom = JEANS, .shoes = SNEAKERS, .hands = IN_POCKETS, .carried = BACKPACK, .bottom_pattern = WORN,
      .skin = SKIN_OLIVE, .hair_color = HAIR_DARK, .top_color = { 0.16, 0.32, 0.24 }, .under_color = { 0.70, 0.42, 0.12 }, .bottom_color = DENIM, .shoes_color = { 0.21, 0.21, 0.22 },
      .carried_color = { 0.35, 0.12, 0.10 } },
};
const int people_count = sizeof people / sizeof *people;
