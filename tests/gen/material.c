#include "gen/model/material.h"

#include "lib/file.h"
#include "tests/tap.h"

#include <unistd.h>

static struct material_rules *read_text(const char *text, struct error *err)
{
    char path[] = "material-test.XXXXXX";
    struct material_rules *rules = NULL;
    int fd = mkstemp(path);
    if (fd >= 0) close(fd);
    if (file_write(path, text, strlen(text), err)) material_rules_read(&rules, path, err);
    unlink(path);
    return rules;
}

static void refused(const char *text, int line, int column, const char *want)
{
    struct error err = ERROR_NONE;
    struct material_rules *rules = read_text(text, &err);
    if (!OK(!rules && err.code == ERR_INPUT && err.line == line && err.column == column && !strcmp(err.text, want), "refuses: %s", want))
        printf("# got %d:%d: %s\n", err.line, err.column, err.text);
    material_rules_destroy(rules);
}

static struct material named(const char *name)
{
    struct material m;
    material_default(&m);
    snprintf(m.name, sizeof m.name, "%s", name);
    m.names_only = true;
    return m;
}

static enum finish_kind kind_of(const struct material_rules *rules, const char *name, enum entity_class class_)
{
    struct material m = named(name);
    material_rules_apply(rules, &m, class_);
    return m.kind;
}

static void syntax_is_checked(void)
{
    refused("", 0, 0, "has no line \"default: finish\", which decides where no keyword is found");
    refused("# rules\n\ntire rubber: rubber\ndefault: dull\n", 3, 6, "\",\" or \":\" was expected; a keyword of several words goes in double quotes");
    refused("tire: rubbery\ndefault: dull\n", 1, 7, "unknown finish \"rubbery\": pbr, glass, plastic, paint, chrome, rubber or dull would be right");
    refused("tire:\ndefault: dull\n", 1, 6, "a finish is missing after \":\": pbr, glass, plastic, paint, chrome, rubber or dull");
    refused("tire\ndefault: dull\n", 1, 5, "\":\" and a finish were expected: \"keyword, keyword: finish\"");
    refused("\"car body: paint\ndefault: dull\n", 1, 1, "a quote is opened and not closed in this line");
    refused("\"\": paint\ndefault: dull\n", 1, 1, "an empty keyword would match every name: use \"default\"");
    refused("  tire: rubber roughnes=1\ndefault: dull\n", 1, 16, "unknown figure \"roughnes\": roughness, metallic, clearcoat, clearcoat_roughness, transmission or ior would be right");
    refused("tire: rubber roughness=1.5\ndefault: dull\n", 1, 24, "roughness must be a number from 0 to 1");
    refused("tire: rubber ior=0.5\ndefault: dull\n", 1, 18, "ior must be a number from 1 to 3");
    refused("tire: rubber roughness=high\ndefault: dull\n", 1, 24, "roughness must be a number from 0 to 1");
    refused("tire: rubber roughness\ndefault: dull\n", 1, 23, "\"=\" and a number were expected after \"roughness\"");
    refused("default kar: paint\ndefault: dull\n", 1, 9, "unknown class \"kar\": car, van, truck, person or another class would be right");
    refused("default", 1, 8, "\":\" and a finish were expected: \"keyword, keyword: finish\"");
    struct error err = ERROR_NONE;
    struct material_rules *rules = NULL;
    OK(!material_rules_read(&rules, "no-such.rules", &err) && err.code == ERR_INPUT && !strcmp(err.file, "no-such.rules"), "refuses a file that is not there");
}

static void names_are_matched(void)
{
    struct error err = ERROR_NONE;
    struct material_rules *rules = read_text("glass: glass transmission=0.9 ior=1.4 # thin\n\"car body\", \" van \": paint roughness = 0.5\r\n"
                                             "window: chrome\nglass: dull\ndefault person: rubber\ndefault: plastic\n", &err);
    if (!OK(rules != NULL, "comments, blanks and several keywords a line are read")) return;
    OK(kind_of(rules, "FrontGLASS_01", CLASS_CAR) == FINISH_GLASS, "a keyword is found anywhere, in any letters");
    OK(kind_of(rules, "glass_window", CLASS_CAR) == FINISH_GLASS && kind_of(rules, "window_glass", CLASS_CAR) == FINISH_GLASS, "the first line that matches decides");
    OK(kind_of(rules, "CarBody2", CLASS_CAR) == FINISH_PAINT && kind_of(rules, "car.body", CLASS_CAR) == FINISH_PAINT, "words are told apart by case, digits and signs");
    OK(kind_of(rules, "carbody", CLASS_CAR) == FINISH_PLASTIC, "what is written as one word is one word");
    OK(kind_of(rules, "van", CLASS_CAR) == FINISH_PAINT && kind_of(rules, "Van01", CLASS_CAR) == FINISH_PAINT && kind_of(rules, "advanced", CLASS_CAR) == FINISH_PLASTIC, "blanks around a keyword ask for the whole word");
    OK(kind_of(rules, "coat", CLASS_PERSON) == FINISH_RUBBER && kind_of(rules, "coat", CLASS_COUNT) == FINISH_PLASTIC, "a default of a class goes before that of all");
    OK(kind_of(rules, "car body", CLASS_PERSON) == FINISH_RUBBER, "people are never painted");
    OK(kind_of(rules, "", CLASS_CAR) == FINISH_PLASTIC, "a material without a name has the default");
    struct material m = named("glass");
    m.roughness = 0.25;
    material_rules_apply(rules, &m, CLASS_CAR);
    OK(m.transmission == 0.9 && m.ior == 1.4 && m.roughness == 0.25, "a line sets the figures that it gives, and no others");
    m = named("glass");
    m.names_only = false;
    material_rules_apply(rules, &m, CLASS_CAR);
    OK(m.kind == FINISH_PBR && m.transmission == 0 && m.ior == 1.5, "a material that brings figures keeps them");
    m = named("Car Body");
    m.names_only = false;
    m.roughness = 0.125;
    material_rules_apply(rules, &m, CLASS_CAR);
    OK(m.kind == FINISH_PAINT && m.roughness == 0.125, "but a body is painted");
    material_rules_destroy(rules);
}

static void the_file_we_bring_is_right(void)
{
    static const struct { const char *name; enum finish_kind kind; } wanted[] = {
        { "glass", FINISH_GLASS }, { "windshield", FINISH_GLASS }, { "Windows", FINISH_GLASS }, { "WindScreen_front", FINISH_GLASS },
        { "plastic", FINISH_PLASTIC }, { "headlight", FINISH_PLASTIC }, { "Indicator.L", FINISH_PLASTIC }, { "number_plate", FINISH_PLASTIC },
        { "car body", FINISH_PAINT }, { "chrome", FINISH_CHROME }, { "metallic paint", FINISH_PAINT }, { "metal", FINISH_CHROME }, { "silver", FINISH_CHROME },
        { "tire", FINISH_RUBBER }, { "rubber", FINISH_RUBBER }, { "wheel", FINISH_RUBBER }, { "interior", FINISH_DULL },
        { "Hatchback", FINISH_PAINT }, { "Wheels3", FINISH_RUBBER }, { "SUV_Body", FINISH_PAINT }, { "SUV_Wheels", FINISH_RUBBER },
        { "Hybrid", FINISH_PAINT }, { "Hybrid_Interior", FINISH_DULL }, { "Ambulance", FINISH_PAINT }, { "Firetruck_Wheels", FINISH_RUBBER },
        { "Pickup", FINISH_PAINT }, { "Pickup_Wheels", FINISH_RUBBER }, { "Material.001", FINISH_PAINT },
    };
    struct error err = ERROR_NONE;
    struct material_rules *rules = NULL;
    const char *top = getenv("top_srcdir");
    char *path = string_format("%s/templates/materials.rules", top ? top : ".");
    if (!material_rules_read(&rules, path, &err)) printf("# %s:%d:%d: %s\n", err.file, err.line, err.column, err.text);
    free(path);
    if (!OK(rules != NULL, "templates/materials.rules is read")) return;
    for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++)
        OK(kind_of(rules, wanted[i].name, CLASS_CAR) == wanted[i].kind, "\"%s\" of a car has the right finish", wanted[i].name);
    OK(kind_of(rules, "Body", CLASS_PERSON) == FINISH_DULL && kind_of(rules, "Material.001", CLASS_COUNT) == FINISH_DULL, "nobody and nothing unknown is painted");
    struct material m = named("Windows");
    material_rules_apply(rules, &m, CLASS_CAR);
    OK(m.transmission > 0.5 && m.roughness == 0, "glass lets light through");
    m = named("chrome");
    material_rules_apply(rules, &m, CLASS_CAR);
    OK(m.metallic == 1 && m.roughness < 0.2, "chrome is polished metal");
    m = named("metal");
    material_rules_apply(rules, &m, CLASS_CAR);
    OK(m.metallic == 1 && m.clearcoat == 1, "metal lies under a clear coat");
    material_rules_destroy(rules);
}

static void alpha_is_looked_up(void)
{
    /* alpha: 255 0 over 51 255 */
    static uint8_t pixels[16] = { 0, 0, 0, 255, 0, 0, 0, 0, 0, 0, 0, 51, 0, 0, 0, 255 };
    struct material m;
    material_default(&m);
    m.base_image = (struct image){ 2, 2, 4, PIXEL_U8, pixels };
    OK(material_alpha(&m, 0.75, 0.75) == 1, "an opaque material is whole, whatever its texture");
    m.alpha_mode = ALPHA_BLEND;
    m.alpha = 0.5;
    OK(material_alpha(&m, 0.25, 0.75) == 0.5 && material_alpha(&m, 0.75, 0.75) == 0, "v is up: the top row lies at 0.75");
    NEAR(material_alpha(&m, 0.25, 0.25), 0.1, 1e-12, "blending multiplies factor and texel");
    OK(material_alpha(&m, -0.75, 3.75) == 0.5, "textures repeat");
    OK(material_alpha(&m, 1, 1) == material_alpha(&m, 0, 0), "and their edges belong to the next turn");
    m.alpha_mode = ALPHA_MASK;
    m.alpha = 1;
    m.alpha_cutoff = 0.2;
    OK(material_alpha(&m, 0.25, 0.25) == 1, "a mask has what reaches the cutoff");
    m.alpha_cutoff = 0.21;
    OK(material_alpha(&m, 0.25, 0.25) == 0, "and not what is below");
}

static void reflectance_is_known(void)
{
    static uint8_t pixels[6] = { 255, 255, 255, 0, 0, 0 };
    static const double paint[3] = { 0.6, 0.1, 0.2 };
    struct material m;
    double rgb[3], coat = 0.04 + 0.96 / 21;
    material_default(&m);
    m.base_color[0] = 0.5;
    material_reflectance(rgb, &m, paint, 0, 0);
    OK(rgb[0] == 0.5 && rgb[1] == 1 && rgb[2] == 1, "what is rough and white but for red sends back half of red; paint is for what is painted");
    m.kind = FINISH_PAINT;
    m.clearcoat = 1;
    material_reflectance(rgb, &m, paint, 0, 0);
    for (int c = 0; c < 3; c++) NEAR(rgb[c], coat + (1 - coat) * paint[c], 1e-9, "paint below a clear coat: what the coat mirrors, and of the rest the paint's share");
    m.kind = FINISH_PBR;
    m.clearcoat = 0;
    m.base_image = (struct image){ 2, 1, 3, PIXEL_U8, pixels };
    material_reflectance(rgb, &m, NULL, 0.75, 0.5);
    OK(rgb[0] == 0 && rgb[1] == 0 && rgb[2] == 0, "a black texel sends nothing back");
    m.kind = FINISH_PAINT;
    material_reflectance(rgb, &m, paint, 0.75, 0.5);
    OK(rgb[0] == paint[0] && rgb[2] == paint[2], "but where it is painted anew");
    m.kind = FINISH_PBR;
    m.base_image = (struct image){ 0 };
    m.transmission = 0.8;
    m.roughness = 0;
    material_reflectance(rgb, &m, NULL, 0, 0);
    NEAR(rgb[1], coat + (1 - coat) * 0.3 * 0.2, 1e-9, "glass: what it mirrors, and little of what it does not let through");
}

int main(void)
{
    syntax_is_checked();
    names_are_matched();
    the_file_we_bring_is_right();
    alpha_is_looked_up();
    reflectance_is_known();
    return tap_done();
}
