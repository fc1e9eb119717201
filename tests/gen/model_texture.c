#include "gen/model/model_texture.h"
#include "tests/gen/model_files.h"

/* --- textures of files --- */

static const char textured_obj[] = "mtllib %s\nv 0 0 0\nv 2 0 0\nv 0 1 0\nv 0 0 3\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl Body\nf 1/1 3/3 2/2\nf 1/1 2/2 4/3\n";

static const char *put_textured(const char *name, const char *texture)
{
    char obj[512], mtl[512], path[256];
    snprintf(mtl, sizeof mtl, "newmtl Body\nKd 0.5 0.5 0.5\nmap_Kd %s\n", texture);
    snprintf(obj, sizeof obj, textured_obj, "car.mtl");
    snprintf(path, sizeof path, "%s/car.mtl", name);
    put_text(path, mtl);
    snprintf(path, sizeof path, "%s/car.obj", name);
    return put_text(path, obj);
}

static uint8_t red_of_texture(const struct model *m)
{
    return m && m->materials[0].base_image.data ? image_u8(&m->materials[0].base_image, 0, 0)[0] : 0;
}

static void textures_are_found(void)
{
    static const struct { const char *texture, *file, *behaviour; } cases[] = {
        { "skin.png", "a/meshes/skin.png", "beside the model" },
        { "../images/skin.png", "b/images/skin.png", "where the file says" },
        { "model://c/materials/textures/skin.png", "c/materials/textures/skin.png", "in the textures of the folder above, whatever the scheme" },
        { "C:\\work\\car\\skin.png", "d/meshes/maps/SKIN.PNG", "in a folder below, in other letters, whatever drive it was on" },
        { "textures/skin.png", "e/skin.png", "in the folder above" },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char name[64];
        snprintf(name, sizeof name, "%c/meshes", cases[i].file[0]);
        put_image(cases[i].file, (uint8_t)(10 + i), 0, 0);
        struct model *m = load(put_textured(name, cases[i].texture), &metres_z_up);
        OK(red_of_texture(m) == 10 + i && m->missing_texture_count == 0, "a texture is found %s", cases[i].behaviour);
        OK(m && m->materials[0].base_color[0] == 1 && m->meshes[0].uv, "and stands instead of the plain colour");
        model_destroy(m);
    }
    put_image("order/meshes/skin.png", 1, 0, 0);
    put_image("order/meshes/maps/skin.png", 2, 0, 0);
    put_image("order/textures/skin.png", 3, 0, 0);
    put_image("order/elsewhere/skin.png", 4, 0, 0);
    struct model *m = load(put_textured("order/meshes", "../elsewhere/skin.png"), &metres_z_up);
    OK(red_of_texture(m) == 4, "what the file says goes before what is near");
    model_destroy(m);
    m = load(put_textured("order/meshes", "../gone/skin.png"), &metres_z_up);
    OK(red_of_texture(m) == 1, "what is beside the model goes before what is below or above");
    model_destroy(m);
    put_image("stranger/other-model/skin.png", 9, 0, 0);
    m = load(put_textured("stranger/this-model", "model://gone/skin.png"), &metres_z_up);
    OK(m && m->missing_texture_count == 1 && !strcmp(m->missing_textures[0], "model://gone/skin.png"), "a texture of a neighbour that is no texture folder is not taken: it is named as missing");
    OK(m && !m->materials[0].base_image.data && fabs(m->materials[0].base_color[0] - 0.2140411) < 1e-5, "and the plain colour stays");
    model_destroy(m);
    put_text("broken/skin.png", "not an image");
    refused(put_textured("broken", "skin.png"), &metres_z_up, "skin.png: is not an image that can be read (PNG, JPEG, TIFF or EXR), or is truncated", "refuses a texture that is no image");
    char obj[512], no[600];
    snprintf(obj, sizeof obj, textured_obj, "gone.mtl");
    snprintf(no, sizeof no, "%s", put_text("mtl/car.obj", obj));
    m = load(no, &metres_z_up);
    OK(m && m->missing_texture_count == 1 && !strcmp(m->missing_textures[0], "gone.mtl"), "a missing material file is named as well");
    model_destroy(m);
}

int main(void)
{
    if (!mkdtemp(folder)) return 1;
    textures_are_found();
    remove_tree(folder);
    return tap_done();
}
