/* Unit, axes, class and front of models that do not state them. */
#include "catalogue/guess.h"

#include "tests/catalogue/solids.h"

static const struct model_options raw = { .length_m = 1, .axes_given = true, .up = AXIS_POS_Z, .front = AXIS_POS_X };

/* A car with lights, or without: length along +x, z up, metres times a scale; turned by axis: 1 puts y up. */
static const char *put_car(const char *name, double scale, bool y_up, bool lights, bool backward)
{
    struct solids s;
    solids_begin(&s);
    const struct { const char *material; double low[3], high[3]; } boxes[] = {
        { "body", { -2.2, -0.9, 0 }, { 2.2, 0.9, 0.8 } }, { "body", { -1.6, -0.8, 0.8 }, { 1.2, 0.8, 1.5 } },
        { "HeadLight", { 2.2, -0.8, 0.5 }, { 2.25, 0.8, 0.7 } }, { "tail_light", { -2.25, -0.8, 0.5 }, { -2.2, 0.8, 0.7 } } };
    for (size_t i = 0; i < (lights ? 4 : 2); i++) {
        const double *a = boxes[i].low, *b = boxes[i].high;
        double x0 = backward ? -b[0] : a[0], x1 = backward ? -a[0] : b[0];
        /* (x, y, z) becomes (-y, z, -x)... of an upright y: front -z, so that both axes differ from z up. */
        struct vec3 low = y_up ? vec3(-b[1], a[2], -x1) : vec3(x0, a[1], a[2]), high = y_up ? vec3(-a[1], b[2], -x0) : vec3(x1, b[1], b[2]);
        solids_box(&s, boxes[i].material, vec3_scale(low, scale), vec3_scale(high, scale), 0);
    }
    return solids_end(&s, name);
}

static struct guess guess_file(const char *path, struct known known)
{
    struct model *model = load(path, &raw);
    struct guess guess = { 0 };
    if (!known.name) known.name = path_name(path);
    if (!OK(model != NULL, "%s is read", path_name(path))) return guess;
    guess = guess_model(model, &known);
    model_destroy(model);
    return guess;
}

static void units_follow_from_the_size(void)
{
    static const struct { double scale, unit_m; const char *what; } cases[] = {
        { 1, 1, "metres" }, { 100, 0.01, "centimetres" }, { 1000, 0.001, "millimetres" }, { 1 / 0.0254, 0.0254, "inches" } };
    for (size_t i = 0; i < 4; i++) {
        struct guess g = guess_file(put_car("thing.obj", cases[i].scale, false, true, false), (struct known){ 0 });
        OK(g.unit_m == cases[i].unit_m && g.unit_sure > 0.9 && g.class_ == CLASS_CAR && g.class_sure > 0.9, "a car in %s: unit %g (%.2f), %s (%.2f)",
           cases[i].what, g.unit_m, g.unit_sure, class_info(g.class_)->name, g.class_sure);
        OK(g.up == AXIS_POS_Z && g.up_sure > 0.9 && g.front == AXIS_POS_X && g.along_sure > 0.9, "up +z (%.2f), along x (%.2f)", g.up_sure, g.along_sure);
    }
    struct guess g = guess_file(put_car("thing.obj", 17, false, true, false), (struct known){ .has_class = true, .class_ = CLASS_CAR });
    OK(g.unit_sure < 0.1 && g.class_ == CLASS_CAR && g.misfit < 1, "in a unit that nobody uses, it is as long as cars are, which is not sure (%.2f)", g.unit_sure);
    g = guess_file(put_car("thing.obj", 17, false, true, false), (struct known){ .has_class = true, .class_ = CLASS_CAR, .length_m = 4.5 });
    NEAR(g.unit_m, 1 / 17.0, 1e-6, "its length, when said, gives the unit");
    OK(g.misfit < 2, "and then it fits");
}

static void lights_tell_the_front(void)
{
    struct guess g = guess_file(put_car("a.obj", 1, false, true, false), (struct known){ 0 });
    OK(g.front == AXIS_POS_X && g.front_sure > 0.9 && !strcmp(g.front_by, "names of lights"), "lights in front at +x (%.2f)", g.front_sure);
    g = guess_file(put_car("a.obj", 1, false, true, true), (struct known){ 0 });
    OK(g.front == AXIS_NEG_X && g.front_sure > 0.9, "turned around: -x (%.2f)", g.front_sure);
    g = guess_file(put_car("a.obj", 1, true, true, false), (struct known){ 0 });
    OK(g.up == AXIS_POS_Y && g.front == AXIS_NEG_Z && g.up_sure > 0.9 && g.front_sure > 0.9, "y up, front -z (%.2f, %.2f)", g.up_sure, g.front_sure);
    g = guess_file(put_car("a.obj", 1, false, false, false), (struct known){ 0 });
    OK(g.front == AXIS_POS_X && g.front_sure > 0.6 && g.front_sure < 0.9, "by its cabin alone it is not sure (%.2f)", g.front_sure);
    g = guess_file(put_car("a.obj", 1, false, false, false), (struct known){ .has_front = true, .front = AXIS_NEG_X });
    OK(g.front == AXIS_NEG_X && g.front_sure == 1, "what is said is so");
}

static void formats_that_state_axes_are_mostly_right(void)
{
    const struct known gltf = { .format_has_axes = true, .stated_unit_m = 1 };
    struct guess g = guess_file(put_car("a.obj", 1, true, false, true), gltf);
    OK(g.up == AXIS_POS_Y && g.front == AXIS_POS_Z && g.front_sure > 0.9, "+y up, +z front, as stated (%.2f)", g.front_sure);
    g = guess_file(put_car("a.obj", 1, true, true, false), gltf);
    OK(g.front_sure < 0.9, "lights at the other end make it unsure (%.2f)", g.front_sure);
    g = guess_file(put_car("a.obj", 100, true, false, true), gltf);
    OK(g.unit_m == 0.01 && g.unit_sure > 0.9, "a stated metre that would be a car of 440 m is a centimetre (%g, %.2f)", g.unit_m, g.unit_sure);
}

/* What is told of a body of plain boxes, front +x, in one material. */
static struct guess guess_shape(const char *name, const double (*box)[6], size_t n, bool red_tail)
{
    struct solids s;
    solids_begin(&s);
    for (size_t i = 0; i < n; i++) solids_box(&s, "body", vec3(box[i][0], box[i][2], box[i][4]), vec3(box[i][1], box[i][3], box[i][5]), 0);
    if (red_tail) solids_box(&s, "tail_light", vec3(-2.8, -0.9, 0.7), vec3(-2.79, 0.9, 0.9), 0);
    if (red_tail) solids_box(&s, "HeadLight", vec3(-2.8, -0.9, 0.5), vec3(-2.79, 0.9, 0.7), 0); /* a name at both ends tells nothing */
    return guess_file(solids_end(&s, name), (struct known){ .has_class = true, .class_ = CLASS_CAR });
}

static void shape_and_color_tell_the_front(void)
{
    static const double sedan[][6] = { { -2.2, 1.2, -0.9, 0.9, 0, 1 }, { 1.2, 2.2, -0.9, 0.9, 0, 0.7 }, { -1.4, 0.8, -0.8, 0.8, 1, 1.5 } };
    static const double pickup[][6] = { { -2.8, 2.8, -0.9, 0.9, 0, 0.8 }, { -2.8, -0.6, -0.9, -0.85, 0.8, 1.1 }, { -2.8, -0.6, 0.85, 0.9, 0.8, 1.1 }, { -2.8, -2.7, -0.9, 0.9, 0.8, 1.1 },
                                        { -0.6, 1.4, -0.8, 0.8, 0.8, 1.7 }, { 1.4, 2.8, -0.9, 0.9, 0.8, 1.1 } };
    struct guess g = guess_shape("a.obj", sedan, 3, false);
    OK(g.front == AXIS_POS_X && g.front_sure > 0.9 && !strcmp(g.front_by, "the height of its ends"), "a bonnet is lower than a boot: %s (%.2f) by %s",
       axis_name(g.front), g.front_sure, g.front_by);
    g = guess_shape("b.obj", pickup, 6, true);
    OK(g.front == AXIS_POS_X && !strcmp(g.front_by, "red lights"), "a pickup, its cabin before the middle: %s (%.2f) by %s", axis_name(g.front),
       g.front_sure, g.front_by);
}

static void feet_tell_where_people_look(void)
{
    struct solids s;
    solids_begin(&s);
    solids_box(&s, "body", vec3(-0.12, -0.28, 0.15), vec3(0.12, 0.28, 1.75), 0);
    solids_box(&s, "body", vec3(-0.1, -0.2, 0.04), vec3(0.04, 0.2, 0.18), 0);
    solids_box(&s, "body", vec3(-0.1, -0.2, 0), vec3(0.18, 0.2, 0.04), 0);
    struct guess g = guess_file(solids_end(&s, "somebody.obj"), (struct known){ .has_class = true, .class_ = CLASS_PERSON });
    OK(g.unit_m == 1 && g.up == AXIS_POS_Z && g.front == AXIS_POS_X && !strcmp(g.front_by, "the feet") && g.front_sure > 0.9,
       "toes point ahead: %s (%.2f) by %s", axis_name(g.front), g.front_sure, g.front_by);
}

static void names_tell_what_it_is(void)
{
    struct guess g = guess_file(put_car("a.obj", 1, false, true, false), (struct known){ .name = "Old_Taxi-2.obj" });
    OK(g.class_ == CLASS_CAR && g.class_sure > 0.99, "a word of the name");
    g = guess_file(put_car("a.obj", 1.3, false, true, false), (struct known){ .name = "AmbulanceLow.obj" });
    OK(g.class_ == CLASS_AMBULANCE, "a word in capitals: %s", class_info(g.class_)->name);
    g = guess_file(put_car("a.obj", 1, false, true, false), (struct known){ .name = "busy.obj" });
    OK(g.class_ == CLASS_CAR, "busy is no bus");
}

int main(void)
{
    if (!OK(mkdtemp(folder) != NULL, "a folder")) return tap_done();
    units_follow_from_the_size();
    lights_tell_the_front();
    formats_that_state_axes_are_mostly_right();
    shape_and_color_tell_the_front();
    feet_tell_where_people_look();
    names_tell_what_it_is();
    remove_tree(folder);
    return tap_done();
}
