/* A person: a body, and what it wears and carries. */
#ifndef STAFFAGE_CAST_PERSON_H
#define STAFFAGE_CAST_PERSON_H

#include "cast/body.h"
#include "cast/field.h"
#include "cast/hull.h"

#include <stdbool.h>

enum hair { SHORT_HAIR, CROPPED_HAIR, CURLY_HAIR, LONG_HAIR, BOB_HAIR, BUN, PONYTAIL, BALD, CAP, BEANIE, HEADSCARF, CYCLE_HELMET, FULL_HELMET };
enum top { T_SHIRT, SHIRT, SWEATER, JACKET, OPEN_JACKET, HOODIE, COAT, OPEN_COAT, DRESS };
enum bottom { TROUSERS, JEANS, LEGGINGS, SHORTS, SKIRT, LONG_SKIRT };
enum shoes { SNEAKERS, LEATHER_SHOES, BOOTS };
enum carried { NOTHING, HANDBAG, SHOULDER_BAG, BACKPACK, UMBRELLA };
enum hands { SWINGING, IN_POCKETS, AT_PHONE };
enum pattern { PLAIN, STRIPES, CHECKS, PRINT, WORN };

struct person {
    const char *name;
    struct measures measures;
    enum hair hair;
    enum top top;
    enum bottom bottom;
    enum shoes shoes;
    enum carried carried;
    enum hands hands;
    enum pattern top_pattern, bottom_pattern;
    double skin[3], hair_color[3], top_color[3], under_color[3], bottom_color[3], shoes_color[3], carried_color[3]; /* sRGB, 0 to 1 */
    bool beard;
};

/* What is one material. */
enum piece { SKIN_PIECE, HAIR_PIECE, TOP_PIECE, UNDER_PIECE, BOTTOM_PIECE, SHOES_PIECE, CARRIED_PIECE, HAT_PIECE, PIECE_COUNT };

/* A surface and how it follows the joints. */
struct garment {
    struct shape shape;
    enum piece piece;
    double cell_m, drape;
    int joint;          /* of one joint alone; -1: as the body does */
};
enum { GARMENTS = 16 };
struct wardrobe { struct garment garment[GARMENTS]; int count; };

struct garment *add_garment(struct wardrobe *wardrobe, enum piece piece, double cell_m);
void wear_head(struct wardrobe *wardrobe, const struct person *person, const struct body *body);
void wear_clothes(struct wardrobe *wardrobe, const struct person *person, const struct body *body);
void wear_shoes(struct wardrobe *wardrobe, const struct person *person, const struct body *body);
void carry(struct wardrobe *wardrobe, const struct person *person, const struct body *body);

extern const struct person people[];
extern const int people_count;

#endif
