/* What is wrong with a model's surface, on solids whose faults are known. */
#include "catalogue/inspect.h"

#include "tests/catalogue/solids.h"

static struct inspection look(struct solids *s, const char *name)
{
    struct error err = ERROR_NONE;
    struct inspection found = { 0 };
    struct model *model = load(solids_end(s, name), &metres_z_up);
    if (OK(model && inspect_model(&found, model, &err), "%s is looked at %s", name, err.text)) model_destroy(model);
    return found;
}

static void closed_and_open(void)
{
    struct solids s;
    solids_begin(&s);
    solids_box(&s, "body", vec3(0, 0, 0), vec3(4, 2, 1.5), 0);
    struct inspection box = look(&s, "box.obj");
    OK(box.triangles == 12 && box.edges == 18, "a box has 12 triangles and 18 edges (%zu)", box.edges);
    NEAR(box.open_share, 0, 0, "none of them is open");
    NEAR(box.inward_share, 0, 0, "no face looks inward");
    NEAR(box.contact_length, 1, 1e-6, "it touches the ground all along");
    solids_begin(&s);
    solids_box(&s, "body", vec3(0, 0, 0), vec3(4, 2, 1.5), OPEN_ROOF);
    struct inspection shell = look(&s, "shell.obj");
    NEAR(shell.open_share, 4 / 17.0, 1e-9, "without its roof 4 of 17 edges are open");
    NEAR(shell.inward_share, 0, 0, "and still no face looks inward");
}

static void turned_faces(void)
{
    struct solids s;
    solids_begin(&s);
    solids_box(&s, "body", vec3(0, 0, 0), vec3(4, 2, 1.5), TURNED);
    NEAR(look(&s, "turned.obj").inward_share, 1, 0, "turned inside out, all that is seen looks inward");
    solids_begin(&s);
    solids_box(&s, "body", vec3(0, 0, 0), vec3(2, 2, 2), 0);
    solids_box(&s, "body", vec3(10, 0, 0), vec3(12, 2, 2), TURNED);
    NEAR(look(&s, "half.obj").inward_share, 0.5, 1e-9, "one of two equal boxes is half of it");
    solids_begin(&s);
    solids_box(&s, "body", vec3(0, 0, 0), vec3(4, 2, 1.5), 0);
    solids_box(&s, "body", vec3(1, 0.5, 0.2), vec3(2, 1, 0.7), TURNED);
    NEAR(look(&s, "hidden.obj").inward_share, 0, 0, "what nobody sees does not count");
}

static void contact(void)
{
    struct solids s;
    solids_begin(&s);
    solids_box(&s, "body", vec3(0, 0, 0.3), vec3(4, 2, 1.5), 0);
    solids_box(&s, "body", vec3(1, 0.5, 0), vec3(1.2, 0.7, 0.3), 0);
    struct inspection leg = look(&s, "leg.obj");
    NEAR(leg.contact_length, 0.05, 1e-6, "on one leg it touches the ground along that leg only");
    NEAR(leg.contact_width, 0.1, 1e-6, "and across it");
}

int main(void)
{
    if (!OK(mkdtemp(folder) != NULL, "a folder")) return tap_done();
    closed_and_open();
    turned_faces();
    contact();
    remove_tree(folder);
    return tap_done();
}
