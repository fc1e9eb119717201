#include "tests/gen/model_files.h"

static const float corners[12] = { 0, 0, 0, 2, 0, 0, 0, 1, 0, 0, 0, 3 };
static const uint8_t faces[12] = { 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3 };

/* The tetrahedron: corners at 0 (48 bytes), faces as bytes at 48, as 16 bits at 60, as 32 bits at 84 (to 132). */
static struct bytes tetrahedron(void)
{
    struct bytes b = { .size = 0 };
    add_floats(&b, corners, 12);
    memcpy(b.data + 48, faces, 12);
    for (int i = 0; i < 12; i++) {
        b.data[60 + 2 * i] = faces[i];
        b.data[84 + 4 * i] = faces[i];
    }
    b.size = 132;
    return b;
}

#define TETRAHEDRON_VIEWS \
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":48},{\"buffer\":0,\"byteOffset\":48,\"byteLength\":12}," \
    "{\"buffer\":0,\"byteOffset\":60,\"byteLength\":24},{\"buffer\":0,\"byteOffset\":84,\"byteLength\":48}]," \
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},{\"bufferView\":1,\"componentType\":5121,\"count\":12,\"type\":\"SCALAR\"}," \
    "{\"bufferView\":2,\"componentType\":5123,\"count\":12,\"type\":\"SCALAR\"},{\"bufferView\":3,\"componentType\":5125,\"count\":12,\"type\":\"SCALAR\"}],"
#define TETRAHEDRON_MESH "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}],"

static bool is_tetrahedron(const struct model *m, double volume_m3)
{
    return m && triangles(m) == 4 && fabs(volume(m) - volume_m3) < 1e-4 && normals_outward(m);
}

static void gltf_geometry_is_read(void)
{
    struct bytes b = tetrahedron();
    char rest[4096];
    for (int i = 1; i <= 3; i++) {
        snprintf(rest, sizeof rest, TETRAHEDRON_VIEWS "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":%d}]}],\"nodes\":[{\"mesh\":0}]", i);
        struct model *m = load(put_gltf("t.gltf", &b, rest), &as_in_file);
        OK(is_tetrahedron(m, 1) && has_vertex(m, 1, -0.5, 0), "indices of %d bits are read", 8 << (i - 1));
        model_destroy(m);
    }
    /* y up and z front: (2,0,0) is 2 m to the left, (0,1,0) 1 m up, (0,0,3) 3 m ahead. */
    struct model *m = load(put_gltf("t.gltf", &b, TETRAHEDRON_VIEWS TETRAHEDRON_MESH "\"nodes\":[{\"mesh\":0}]"), &(struct model_options){ 0 });
    OK(is_tetrahedron(m, 1) && has_vertex(m, -1.5, 1, 0) && has_vertex(m, -1.5, -1, 1) && has_vertex(m, 1.5, -1, 0), "without options glTF is metres, +y up, +z front");
    OK(m && m->material_count == 1 && m->materials[0].names_only, "a primitive without material gets one without figures");
    model_destroy(m);
    m = load(put_gltf("t.gltf", &b, TETRAHEDRON_VIEWS TETRAHEDRON_MESH
                      "\"nodes\":[{\"children\":[1],\"translation\":[5,5,5],\"rotation\":[0,0,0.70710678,0.70710678]},{\"mesh\":0,\"scale\":[1,2,1]}],\"scenes\":[{\"nodes\":[0]}],\"scene\":0"), &as_in_file);
    /* (2,0,0) -> scaled (2,0,0) -> turned (0,2,0); (0,1,0) -> (0,2,0) -> (-2,0,0) */
    OK(is_tetrahedron(m, 2) && has_vertex(m, 1, 1, 0) && has_vertex(m, -1, -1, 0) && has_vertex(m, 1, -1, 3), "translation, rotation and scale of nodes are applied, from child to parent");
    model_destroy(m);
    m = load(put_gltf("t.gltf", &b, TETRAHEDRON_VIEWS TETRAHEDRON_MESH "\"nodes\":[{\"mesh\":0,\"matrix\":[0,1,0,0, -1,0,0,0, 0,0,1,0, 7,8,9,1]}]"), &as_in_file);
    OK(is_tetrahedron(m, 1) && has_vertex(m, 0.5, 1, 0) && has_vertex(m, -0.5, -1, 0), "a node's matrix is applied, column by column");
    model_destroy(m);
    m = load(put_gltf("t.gltf", &b, TETRAHEDRON_VIEWS TETRAHEDRON_MESH "\"nodes\":[{\"mesh\":0,\"scale\":[-1,1,1]}]"), &as_in_file);
    OK(is_tetrahedron(m, 1) && has_vertex(m, -1, -0.5, 0), "a node that mirrors leaves the winding outward");
    model_destroy(m);
    m = load(put_gltf("t.gltf", &b, TETRAHEDRON_VIEWS TETRAHEDRON_MESH "\"nodes\":[{\"mesh\":0},{\"mesh\":0,\"translation\":[10,0,0]}],\"scenes\":[{\"nodes\":[1]},{\"nodes\":[0,1]}],\"scene\":1"), &as_in_file);
    OK(m && triangles(m) == 8 && fabs(m->max_m.x - 6) < 1e-5, "the default scene is shown, and a mesh as often as nodes show it");
    model_destroy(m);
}

static void gltf_accessors_are_read(void)
{
    /* Interleaved: position, normal (pointing along z) and uv as normalized 16 bits, 32 bytes apart, offset 4. */
    struct bytes b = { .size = 4 };
    const uint16_t uv[4][2] = { { 0, 0 }, { 65535, 0 }, { 65535, 65535 }, { 0, 65535 } };
    const float square[4][3] = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } };
    for (int i = 0; i < 4; i++) {
        add_floats(&b, square[i], 3);
        add_floats(&b, (float[]){ 0, 0, 2 }, 3);
        memcpy(b.data + b.size, uv[i], 4);
        b.size += 8;
    }
    struct error err = ERROR_NONE;
    char *png, rest[8192], image[4096];
    size_t png_size;
    if (!file_read(&png, &png_size, put_image("red.png", 255, 0, 0), &err)) return;
    base64(image, (const uint8_t *)png, png_size);
    free(png);
    static const char *const modes[] = { "strip", "fan" };
    for (int fan = 0; fan < 2; fan++) {
        snprintf(rest, sizeof rest,
                 "\"bufferViews\":[{\"buffer\":0,\"byteOffset\":4,\"byteLength\":128,\"byteStride\":32}],"
                 "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},{\"bufferView\":0,\"byteOffset\":12,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},"
                 "{\"bufferView\":0,\"byteOffset\":24,\"componentType\":5123,\"normalized\":true,\"count\":4,\"type\":\"VEC2\"}],"
                 "\"images\":[{\"uri\":\"data:image/png;base64,%s\"}],\"textures\":[{\"source\":0}],\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0,"
                 "\"extensions\":{\"KHR_texture_transform\":{\"offset\":[0.5,0.25],\"rotation\":1.5707963267948966,\"scale\":[2,4]}}}}}],"
                 "\"meshes\":[{\"primitives\":[{\"mode\":%d,\"material\":0,\"attributes\":{\"POSITION\":0,\"NORMAL\":1,\"TEXCOORD_0\":2}}]}],\"nodes\":[{\"mesh\":0}]",
                 image, fan ? 6 : 5);
        struct model *m = load(put_gltf("strip.gltf", &b, rest), &as_in_file);
        /* A strip of the four corners crosses itself: its second triangle looks down. */
        OK(m && triangles(m) == 2 && vertices(m) == 4, "a %s without indices is read from interleaved data", modes[fan]);
        const struct mesh *mesh = m ? &m->meshes[0] : NULL;
        bool order = mesh && (fan ? mesh->triangle[0][0] == 1 && mesh->triangle[0][1] == 2 && mesh->triangle[0][2] == 0 && mesh->triangle[1][0] == 2 && mesh->triangle[1][1] == 3
                                  : mesh->triangle[1][0] == 1 && mesh->triangle[1][1] == 3 && mesh->triangle[1][2] == 2);
        OK(order, "its corners are in the specification's order");
        OK(mesh && fabsf(mesh->normal[3][2] - 1) < 1e-6f, "normals become unit vectors");
        /* uv (1,1) at vertex 2: scaled (2,4), turned by 90 degrees: (4,-2), moved: (4.5,-1.75); v up: 2.75 */
        OK(mesh && fabsf(mesh->uv[2][0] - 4.5f) < 1e-4f && fabsf(mesh->uv[2][1] - 2.75f) < 1e-4f, "normalized uv take KHR_texture_transform, and v is turned up");
        OK(m && m->materials[0].base_image.data && image_u8(&m->materials[0].base_image, 1, 1)[0] == 255, "a data URI is decoded");
        model_destroy(m);
    }
    /* Sparse: three zeros, two of them replaced. */
    struct bytes s = { .size = 4 };
    s.data[0] = 1;
    s.data[2] = 2;
    add_floats(&s, (float[]){ 2, 0, 0, 0, 1, 3 }, 6);
    struct model *m = load(put_gltf("sparse.gltf", &s,
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":4},{\"buffer\":0,\"byteOffset\":4,\"byteLength\":24}],\"accessors\":[{\"componentType\":5126,\"count\":3,\"type\":\"VEC3\","
        "\"sparse\":{\"count\":2,\"indices\":{\"bufferView\":0,\"componentType\":5123},\"values\":{\"bufferView\":1}}}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"nodes\":[{\"mesh\":0}]"), &as_in_file);
    OK(m && triangles(m) == 1 && has_vertex(m, 1, -0.5, 0) && has_vertex(m, -1, 0.5, 3), "a sparse accessor is filled in");
    model_destroy(m);
}

static void gltf_materials_are_read(void)
{
    struct bytes b = tetrahedron();
    struct model *m = load(put_gltf("m.gltf", &b, TETRAHEDRON_VIEWS
        "\"materials\":[{\"name\":\"lens\",\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.1,0.2,0.3,0.4],\"metallicFactor\":0.5,\"roughnessFactor\":0.25},\"alphaMode\":\"BLEND\",\"emissiveFactor\":[0.5,0,1],"
        "\"extensions\":{\"KHR_materials_clearcoat\":{\"clearcoatFactor\":0.75,\"clearcoatRoughnessFactor\":0.125},\"KHR_materials_transmission\":{\"transmissionFactor\":0.875},\"KHR_materials_ior\":{\"ior\":1.25},\"KHR_materials_emissive_strength\":{\"emissiveStrength\":4}}},"
        "{\"name\":\"leaf\",\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,1,1,0.4]},\"alphaMode\":\"MASK\",\"alphaCutoff\":0.3},{\"name\":\"solid\",\"pbrMetallicRoughness\":{},\"alphaMode\":\"BLEND\"},"
        "{\"name\":\"old\",\"extensions\":{\"KHR_materials_pbrSpecularGlossiness\":{\"diffuseFactor\":[0.5,0.25,0.125,1],\"glossinessFactor\":0.75}}}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1,\"material\":0},{\"attributes\":{\"POSITION\":0},\"indices\":1,\"material\":1},{\"attributes\":{\"POSITION\":0},\"indices\":1,\"material\":2},{\"attributes\":{\"POSITION\":0},\"indices\":1,\"material\":3}]}],\"nodes\":[{\"mesh\":0}]"), &as_in_file);
    if (!OK(m && m->material_count == 4, "every material that is shown is there")) return;
    const struct material *a = &m->materials[0], *leaf = &m->materials[1], *old = &m->materials[3];
    OK(!strcmp(a->name, "lens") && a->kind == FINISH_PBR && !a->names_only && a->base_color[0] == 0.1 && a->base_color[2] == 0.3 && a->alpha == 0.4 && a->alpha_mode == ALPHA_BLEND &&
       a->metallic == 0.5 && a->roughness == 0.25, "metallic-roughness figures are taken as they are");
    OK(a->clearcoat == 0.75 && a->clearcoat_roughness == 0.125 && a->transmission == 0.875 && a->ior == 1.25 && a->emissive[0] == 2 && a->emissive[2] == 4, "and those of the extensions");
    OK(leaf->alpha_mode == ALPHA_MASK && leaf->alpha_cutoff == 0.3 && leaf->metallic == 1 && leaf->roughness == 1 && material_alpha(leaf, 0, 0) == 1, "what is not said has the specification's default");
    OK(m->materials[2].alpha_mode == ALPHA_OPAQUE, "a blended material that nowhere lets light through is opaque");
    OK(old->base_color[1] == 0.25 && old->roughness == 0.25 && old->metallic == 0 && !old->names_only, "specular-glossiness is converted");
    model_destroy(m);
}

static void bad_gltf_is_refused(void)
{
    struct bytes b = tetrahedron();
    static const char scene[] = TETRAHEDRON_VIEWS TETRAHEDRON_MESH "\"nodes\":[{\"mesh\":0}]";
    struct { const char *name, *rest, *want, *behaviour; } cases[] = {
        { "view.gltf", "\"bufferViews\":[{\"buffer\":0,\"byteLength\":400}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"nodes\":[{\"mesh\":0}]",
          "view.gltf: mesh 0: positions: buffer view 0 reaches beyond its buffer of 132 bytes", "refuses a buffer view beyond its buffer" },
        { "count.gltf", "\"bufferViews\":[{\"buffer\":0,\"byteLength\":48}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":5,\"type\":\"VEC3\"}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"nodes\":[{\"mesh\":0}]",
          "count.gltf: mesh 0: positions: buffer view 0 of 48 bytes is too short for 5 elements", "refuses an accessor longer than its view" },
        { "huge.gltf", "\"bufferViews\":[{\"buffer\":0,\"byteLength\":48}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":4611686018427387904,\"type\":\"VEC3\"}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"nodes\":[{\"mesh\":0}]",
          "huge.gltf: mesh 0: positions: accessor 0 tells of 4611686018427387904 elements", "refuses a count that no memory holds" },
        { "type.gltf", "\"bufferViews\":[{\"buffer\":0,\"byteLength\":48}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC2\"}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"nodes\":[{\"mesh\":0}]",
          "type.gltf: mesh 0: positions: accessor 0 has the wrong type", "refuses positions of two coordinates" },
        { "cycle.gltf", TETRAHEDRON_VIEWS TETRAHEDRON_MESH "\"nodes\":[{\"children\":[1]},{\"children\":[0],\"mesh\":0}],\"scenes\":[{\"nodes\":[0]}]", "cycle.gltf: node 0 is its own ancestor", "refuses a node that is its own ancestor" },
        { "parents.gltf", TETRAHEDRON_VIEWS TETRAHEDRON_MESH "\"nodes\":[{\"children\":[2]},{\"children\":[2]},{\"mesh\":0}]", "parents.gltf: node 2 has two parents", "refuses a node with two parents" },
        { "draco.gltf", "\"extensionsRequired\":[\"KHR_draco_mesh_compression\"],\"nodes\":[]", "draco.gltf: requires the glTF extension KHR_draco_mesh_compression, which is not supported: export it without", "refuses a required extension that it does not know" },
        { "nothing.gltf", "\"nodes\":[{\"name\":\"empty\"}]", "nothing.gltf: has no triangles", "refuses a scene without triangles" },
        { "texture.gltf", "\"images\":[{\"uri\":\"data:image/png;base64,AAAA\"}],\"textures\":[{\"source\":0}],\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0,\"texCoord\":0}}}],"
          "\"bufferViews\":[{\"buffer\":0,\"byteLength\":48}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC2\"}],\"meshes\":[{\"primitives\":[{\"material\":0,\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":1}}]}],\"nodes\":[{\"mesh\":0}]",
          "texture.gltf: embedded image 0: is not an image that can be read (PNG, JPEG, TIFF or EXR), or is truncated", "refuses an embedded texture that is no image" },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) refused(put_gltf(cases[i].name, &b, cases[i].rest), &as_in_file, cases[i].want, cases[i].behaviour);
    struct bytes bad = b;
    bad.data[48 + 11] = 4;
    refused(put_gltf("index.gltf", &bad, scene), &as_in_file, "index.gltf: mesh 0: index 11 is 4, but there are 4 vertices", "refuses an index out of range");
    bad = b;
    memcpy(bad.data + 4, (float[]){ NAN }, 4);
    refused(put_gltf("nan.gltf", &bad, scene), &as_in_file, "nan.gltf: mesh 0: the position of vertex 0 is not a number", "refuses a position that is not a number");
    refused(put_text("json.gltf", "{\"asset\""), &as_in_file, "json.gltf: is no glTF file that can be read: [json.exception.parse_error.101] parse error at line 1, column 9: syntax error while parsing object separator - unexpected end of input; expected ':'", "refuses broken JSON, and says where");
    refused(put_text("one.gltf", "{\"asset\":{\"version\":\"1.0\"}}"), &as_in_file, "one.gltf: is glTF version 1.0: version 2.0 would be right", "refuses glTF 1");
    refused(put_text("bin.gltf", "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":4,\"uri\":\"no.bin\"}]}"), &as_in_file, "bin.gltf: is no glTF file that can be read: File not found : no.bin", "refuses a file whose buffer is missing, and names it");
    refused(put("short.glb", "glTF\2\0\0\0\xff\0\0\0\x10\0\0\0JSON{}  ", 24), &as_in_file, "short.glb: is truncated: it has 24 bytes, its header tells of 255", "refuses a truncated GLB file");
    refused(put("shorter.glb", "glTF\2\0\0\0", 8), &as_in_file, "shorter.glb: is truncated: it has 8 bytes, its header tells of 20", "and one that ends in its header");
}

int main(void)
{
    if (!mkdtemp(folder)) return 1;
    gltf_geometry_is_read();
    gltf_accessors_are_read();
    gltf_materials_are_read();
    bad_gltf_is_refused();
    remove_tree(folder);
    return tap_done();
}
