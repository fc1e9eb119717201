/* What the surfaces of vehicles are: materials, with names that the rules of materials know. */
#ifndef STAFFAGE_CAST_COAT_H
#define STAFFAGE_CAST_COAT_H

enum coat {
    PAINT_COAT, WINDOW, DARK_WINDOW, FAR_WINDOW, TRIM_COAT, GAP, WHEEL_HOUSE, FLOOR, LINING, SEAT, LAMP_GLASS, REFLECTOR, FAR_LAMP, LAMP, REAR_LAMP, TURN_LAMP,
    BRIGHT, MIRROR_COAT, PLATE_WHITE, PLATE_TEXT, TYRE, RIM_COAT, RIM_DARK, STEEL, WHITE_PANEL, RED_PANEL, BLUE_LAMP, RED_LAMP, YELLOW_SIGN,
    ORANGE_PANEL, LIVERY, BLACK_PANEL, SILVER_PANEL, DISPLAY, SKIN_COAT, HAIR_COAT, SWEATER_COAT, JACKET_COAT, TROUSERS_COAT, SHOES_COAT, HELMET_COAT, BED, COATS
};
struct coat_info {
    const char *name;
    double rgb[3];                  /* sRGB, 0 to 1 */
    double metallic, roughness, clearcoat, transmission;
};
extern const struct coat_info coat_info[COATS];

#endif
