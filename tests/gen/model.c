#include "gen/model/model.h"

#include "gen/model/model_texture.h"
#include "lib/file.h"
#include "tests/tap.h"

#include <dirent.h>
#include <stdint.h>
#include <sys/stat.h>
#include <unistd.h>

/* --- a folder of files that the tests write --- */

static char folder[] = "model-test.XXXXXX";

static const char *put(const char *name, const void *data, size_t size)
{
    static char path[256];
    struct error err = ERROR_NONE;
    snprintf(path, sizeof path, "%s/%s", folder, name);
    char *above = path_folder(path);
    if (!folder_make(above, &err) || !file_write(path, data, size, &err)) error_print(&err, "test");
    free(above);
    return path;
}

static const char *put_text(const char *name, const char *text)
{
    return put(name, text, strlen(text));
}

/* A 2x2 picture of one colour. */
static const char *put_image(const char *name, uint8_t r, uint8_t g, uint8_t b)
{
    static char path[256];
    struct error err = ERROR_NONE;
    struct image image;
    put_text(name, "");
    snprintf(path, sizeof path, "%s/%s", folder, name);
    if (image_init(&image, 2, 2, 3, PIXEL_U8, &err)) {
        for (int i = 0; i < 4; i++) memcpy((uint8_t *)image.data + 3 * i, (uint8_t[]){ r, g, b }, 3);
        image_write(path, &image, &err);
        image_release(&image);
    }
    return path;
}

static void remove_tree(const char *path)
{
    DIR *dir = opendir(path);
    for (struct dirent *entry; dir && (entry = readdir(dir));) {
        if (!strcmp(entry->d_name, ".") || !strcmp(entry->d_name, "..")) continue;
        char *below = string_format("%s/%s", path, entry->d_name);
        remove_tree(below);
        free(below);
    }
    if (dir) closedir(dir);
    remove(path);
}

/* --- loading --- */

static const struct model_options metres_z_up = { .unit_m = 1, .axes_given = true, .up = AXIS_POS_Z, .front = AXIS_POS_X };

static struct model *load(const char *path, const struct model_options *options)
{
    struct error err = ERROR_NONE;
    struct model *model = NULL;
    if (!model_load(&model, path, options, &err)) printf("# %s: %s\n", err.file, err.text);
    return model;
}

/* `want` stands after the folder's name. */
static void refused(const char *path, const struct model_options *options, const char *want, const char *behaviour)
{
    struct error err = ERROR_NONE;
    struct model *model = NULL;
    char got[2048];
    bool ok = !model_load(&model, path, options, &err) && !model && err.code == ERR_INPUT;
    snprintf(got, sizeof got, "%s: %s", path_name(err.file), err.text);
    if (!OK(ok && !strcmp(got, want), "%s", behaviour)) printf("# got:  %s\n# want: %s\n", got, want);
    model_destroy(model);
}

/* Six times the volume is the sum of triple products: positive when triangles wind outward. */
static double volume(const struct model *model)
{
    double sum = 0;
    for (size_t i = 0; i < model->mesh_count; i++) {
        const struct mesh *m = &model->meshes[i];
        for (size_t t = 0; t < m->triangles; t++) {
            struct vec3 p[3];
            for (int k = 0; k < 3; k++) {
                const float *v = m->position_m[m->triangle[t][k]];
                p[k] = vec3((double)v[0], (double)v[1], (double)v[2]);
            }
            sum += vec3_dot(p[0], vec3_cross(p[1], p[2])) / 6;
        }
    }
    return sum;
}

/* Do all normals lie on the side from which their triangles are seen counter-clockwise? */
static bool normals_outward(const struct model *model)
{
    for (size_t i = 0; i < model->mesh_count; i++) {
        const struct mesh *m = &model->meshes[i];
        for (size_t t = 0; t < m->triangles; t++) {
            struct vec3 p[3], n[3];
            for (int k = 0; k < 3; k++) {
                const float *v = m->position_m[m->triangle[t][k]], *w = m->normal[m->triangle[t][k]];
                p[k] = vec3((double)v[0], (double)v[1], (double)v[2]);
                n[k] = vec3((double)w[0], (double)w[1], (double)w[2]);
            }
            struct vec3 face = vec3_cross(vec3_sub(p[1], p[0]), vec3_sub(p[2], p[0]));
            for (int k = 0; k < 3; k++)
                if (vec3_dot(face, n[k]) <= 0 || fabs(vec3_norm(n[k]) - 1) > 1e-5) return false;
        }
    }
    return true;
}

static bool has_vertex(const struct model *model, double x, double y, double z)
{
    for (size_t i = 0; i < model->mesh_count; i++)
        for (size_t v = 0; v < model->meshes[i].vertices; v++) {
            const float *p = model->meshes[i].position_m[v];
            if (fabs((double)p[0] - x) < 1e-5 && fabs((double)p[1] - y) < 1e-5 && fabs((double)p[2] - z) < 1e-5) return true;
        }
    return false;
}

static size_t vertices(const struct model *model)
{
    size_t n = 0;
    for (size_t i = 0; i < model->mesh_count; i++) n += model->meshes[i].vertices;
    return n;
}

static size_t triangles(const struct model *model)
{
    size_t n = 0;
    for (size_t i = 0; i < model->mesh_count; i++) n += model->meshes[i].triangles;
    return n;
}

/* --- OBJ and PLY --- */

/* A corner at the origin and one 2 m along a, 1 m along b, 3 m along c; a, b, c right-handed. */
static const char *const tetrahedron_faces = "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

static void add_axis(double p[3], const char *axis, double length)
{
    p[axis[1] - 'x'] += axis[0] == '-' ? -length : length;
}

static const char *put_tetrahedron(const char *name, const char *a, const char *b, const char *c)
{
    char text[512];
    double p[3][3] = { { 0 } };
    add_axis(p[0], a, 2);
    add_axis(p[1], b, 1);
    add_axis(p[2], c, 3);
    int n = snprintf(text, sizeof text, "v 0 0 0\n");
    for (int i = 0; i < 3; i++) n += snprintf(text + n, sizeof text - (size_t)n, "v %g %g %g\n", p[i][0], p[i][1], p[i][2]);
    snprintf(text + n, sizeof text - (size_t)n, "%s", tetrahedron_faces);
    return put_text(name, text);
}

static enum axis axis_of(const char *text)
{
    return (enum axis)(2 * (text[1] - 'x') + (text[0] == '-'));
}

/* Left of each up and front, by the right-hand rule. */
static const char *const axes[24][3] = {
    { "+z", "+x", "+y" }, { "+z", "+y", "-x" }, { "+z", "-x", "-y" }, { "+z", "-y", "+x" },
    { "-z", "+x", "-y" }, { "-z", "+y", "+x" }, { "-z", "-x", "+y" }, { "-z", "-y", "-x" },
    { "+y", "+z", "+x" }, { "+y", "+x", "-z" }, { "+y", "-z", "-x" }, { "+y", "-x", "+z" },
    { "-y", "+z", "-x" }, { "-y", "+x", "+z" }, { "-y", "-z", "+x" }, { "-y", "-x", "-z" },
    { "+x", "+y", "+z" }, { "+x", "+z", "-y" }, { "+x", "-y", "-z" }, { "+x", "-z", "+y" },
    { "-x", "+y", "-z" }, { "-x", "+z", "+y" }, { "-x", "-y", "+z" }, { "-x", "-z", "-y" },
};

static void axes_are_turned(void)
{
    for (int i = 0; i < 24; i++) {
        const char *up = axes[i][0], *front = axes[i][1], *left = axes[i][2];
        struct model_options options = { .unit_m = 1, .axes_given = true, .up = axis_of(up), .front = axis_of(front) };
        struct model *m = load(put_tetrahedron("axes.obj", front, left, up), &options);
        OK(m && has_vertex(m, 1, -0.5, 0) && has_vertex(m, -1, 0.5, 0) && has_vertex(m, -1, -0.5, 3) && has_vertex(m, -1, -0.5, 0) &&
           fabs(volume(m) - 1) < 1e-5 && normals_outward(m), "up %s, front %s: left is %s, and nothing is mirrored", up, front, left);
        model_destroy(m);
    }
}

static void sizes_are_scaled(void)
{
    const char *path = put_tetrahedron("size.obj", "+x", "+y", "+z");
    struct model_options options = metres_z_up;
    options.unit_m = 0.5;
    struct model *m = load(path, &options);
    OK(m && fabs(m->max_m.x - m->min_m.x - 1) < 1e-6 && fabs(m->max_m.y - m->min_m.y - 0.5) < 1e-6 && fabs(m->max_m.z - 1.5) < 1e-6, "a unit scales all axes");
    OK(m && m->min_m.z == 0 && m->min_m.x == -m->max_m.x && m->min_m.y == -m->max_m.y, "the box stands on the ground, around the origin");
    model_destroy(m);
    options = metres_z_up;
    options.unit_m = 0;
    options.length_m = 4;
    m = load(path, &options);
    OK(m && fabs(m->max_m.x - 2) < 1e-6 && fabs(m->max_m.z - 6) < 1e-6, "a length scales the extent along the front axis");
    model_destroy(m);
    options.length_m = 0;
    options.height_m = 1.5;
    m = load(path, &options);
    OK(m && fabs(m->max_m.z - 1.5) < 1e-6 && fabs(m->max_m.x - 0.5) < 1e-6, "a height scales the extent along the up axis");
    model_destroy(m);
    options = metres_z_up;
    options.length_m = 4;
    refused(path, &options, "size.obj: a unit, a length and a height exclude each other: give one of them in the scene", "refuses a unit and a length");
    options = metres_z_up;
    options.unit_m = 0;
    refused(path, &options, "size.obj: this file does not tell its unit: say so in the scene, for example \"unit_m: 0.01\", or give its real size, for example \"length_m: 4.2\"",
            "refuses an OBJ file without a unit");
    options.unit_m = 1000;
    refused(path, &options, "size.obj: would be 3000 m long with a unit of 1000 m: the unit cannot be right", "refuses a unit that makes a mountain of it");
    options.unit_m = 0.0254 / 1000;
    refused(path, &options, "size.obj: would be 7.62e-05 m long with a unit of 2.54e-05 m: the unit cannot be right", "and one that makes a grain");
    refused(path, &(struct model_options){ .unit_m = 1 },
            "size.obj: this format does not tell which axes are up and front: say so in the scene, for example \"up: z\" and \"front: -y\"", "refuses an OBJ file without axes");
    options = metres_z_up;
    options.front = AXIS_NEG_Z;
    refused(path, &options, "size.obj: up and front lie along the same axis of the file: two different axes would be right", "refuses a front along the up axis");
}

static void normals_are_computed(void)
{
    struct model *m = load(put_tetrahedron("flat.obj", "+x", "+y", "+z"), &metres_z_up);
    OK(m && vertices(m) == 12, "a sharp edge keeps a normal a face");
    model_destroy(m);
    /* Two squares that meet in the x axis and bend by 30 degrees: their normals are (0, -0.5 sin, cos). */
    m = load(put_text("bend.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 -0.8660254 -0.5\nv 0 -0.8660254 -0.5\nf 1 2 3 4\nf 6 5 2 1\n"), &metres_z_up);
    OK(m && vertices(m) == 6 && triangles(m) == 4, "an edge of 30 degrees is smooth: its corners are shared");
    double worst = 0;
    for (size_t v = 0; m && v < m->meshes[0].vertices; v++)
        if (fabs((double)m->meshes[0].position_m[v][2] - 0.5) < 1e-6 && fabs((double)m->meshes[0].position_m[v][1] - 0.8660254 + 0.9330127) < 1e-5)
            worst = fmax(worst, fabs((double)m->meshes[0].normal[v][1] + sin(M_PI / 12)));
    NEAR(worst, 0, 1e-5, "its normals are the mean of the two faces'");
    model_destroy(m);
    m = load(put_text("degenerate.obj", "v 0 0 0\nv 2 0 0\nv 0 1 0\nv 0 0 3\nv 9 9 9\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\nf 5 5 5\nf 1 2 1\n"), &metres_z_up);
    OK(m && triangles(m) == 4 && fabs(m->max_m.x - 1) < 1e-6, "triangles without area are dropped, and what only they used");
    model_destroy(m);
}

static void ply_is_read(void)
{
    static const char ply[] = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                              "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
                              "0 0 0\n2 0 0\n0 1 0\n0 0 3\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
    struct model *m = load(put_text("t.ply", ply), &metres_z_up);
    OK(m && triangles(m) == 4 && fabs(volume(m) - 1) < 1e-5 && m->materials[0].names_only, "a PLY file is read");
    model_destroy(m);
    char lying[sizeof ply + 16];
    const char *at = strstr(ply, "vertex 4");
    snprintf(lying, sizeof lying, "%.*svertex 4000000000%s", (int)(at - ply), ply, at + 8);
    refused(put_text("lying.ply", lying), &metres_z_up, "lying.ply: the PLY header tells of 4000000000 elements \"vertex\", but only 56 bytes follow", "refuses a PLY header that tells of more than there is");
    m = load(put_text("none.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                                  "element face 2\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n2 0 0\n0 1 0\n3 0 1 2\n0\n"), &metres_z_up);
    OK(m && triangles(m) == 1, "a face without corners is passed over");
    model_destroy(m);
    static const char binary[] = "ply\nformat binary_little_endian 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
                                 "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
    char cut[sizeof binary + 64] = { 0 };
    memcpy(cut, binary, sizeof binary - 1);
    refused(put("vertex.ply", cut, sizeof binary - 1 + 20), &metres_z_up, "vertex.ply: the PLY header tells of 2 elements \"vertex\", but only 20 bytes follow", "refuses a binary PLY file that ends among its vertices");
    cut[sizeof binary - 1 + 24] = 3;
    cut[sizeof binary - 1 + 25] = 7;
    refused(put("face.ply", cut, sizeof binary - 1 + 24 + 26), &metres_z_up, "face.ply: a face uses vertex 7 of 2", "refuses a face of a vertex that is not there");
    cut[sizeof binary - 1 + 24] = 100;
    cut[sizeof binary - 1 + 25] = 0;
    refused(put("list.ply", cut, sizeof binary - 1 + 24 + 13), &metres_z_up, "list.ply: is truncated, or has no number where one belongs: element \"face\" 1 of 2", "refuses a binary PLY file that ends in a list");
    refused(put_text("xyz.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n"), &metres_z_up, "xyz.ply: the PLY header gives vertices no x, y and z", "refuses vertices without coordinates");
    refused(put_text("type.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty half x\nend_header\n0\n"), &metres_z_up, "type.ply: the PLY header has a property of unknown type \"half\"", "refuses a type that there is not");
    m = load(put_text("rich.ply", "ply\nformat ascii 1.0\ncomment TextureFile none.png\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty float nx\nproperty float ny\nproperty float nz\n"
                                  "property float s\nproperty float t\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\nelement face 1\nproperty uchar flags\nproperty list uchar uint vertex_index\nend_header\n"
                                  "0 0 0 0 0 1 0 0 255 0 188 255\n1 0 0 0 0 1 1 0 255 0 188 255\n1 1 0 0 0 1 1 1 255 0 188 255\n0 1 0 0 0 1 0 0.75 255 0 188 255\n1 4 0 1 2 3\n"), &metres_z_up);
    OK(m && triangles(m) == 2 && vertices(m) == 4 && m->meshes[0].triangle[1][0] == 0 && m->meshes[0].triangle[1][1] == 2 && m->meshes[0].triangle[1][2] == 3, "a polygon becomes a fan");
    OK(m && m->meshes[0].uv && m->meshes[0].uv[3][1] == 0.75f && m->missing_texture_count == 1 && !strcmp(m->missing_textures[0], "none.png"), "uv and the texture's name are read");
    OK(m && m->materials[0].base_color[0] == 1 && m->materials[0].base_color[1] == 0 && fabs(m->materials[0].base_color[2] - 0.5028865) < 1e-5, "vertex colours become their mean, in linear light");
    model_destroy(m);
    unsigned char big[512];
    int header = snprintf((char *)big, sizeof big, "ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty short x\nproperty short y\nproperty short z\nelement face 1\nproperty list uchar ushort vertex_indices\nend_header\n");
    static const unsigned char body[] = { 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0xff, 0xfe, 0, 0, 3, 0, 0, 0, 1, 0, 2 };
    memcpy(big + header, body, sizeof body);
    m = load(put("big.ply", big, (size_t)header + sizeof body), &metres_z_up);
    OK(m && triangles(m) == 1 && has_vertex(m, 128, 1, 0) && has_vertex(m, -128, -1, 0), "a big-endian file is read");
    model_destroy(m);
    refused(put_text("none.ply", "plx\n"), &metres_z_up, "none.ply: is no PLY file: it has no header", "refuses a PLY file without a header");
}

static void units_of_collada_and_fbx_are_known(void)
{
    static const char dae[] =
        "<?xml version=\"1.0\"?><COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">"
        "<asset><unit name=\"inch\" meter=\"0.0254\"/><up_axis>Y_UP</up_axis></asset>"
        "<library_geometries><geometry id=\"g\"><mesh><source id=\"p\"><float_array id=\"pa\" count=\"9\">0 0 0 100 0 0 0 0 50</float_array>"
        "<technique_common><accessor source=\"#pa\" count=\"3\" stride=\"3\"><param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/><param name=\"Z\" type=\"float\"/></accessor></technique_common></source>"
        "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices>"
        "<triangles count=\"1\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>0 1 2</p></triangles></mesh></geometry></library_geometries>"
        "<library_visual_scenes><visual_scene id=\"s\"><node id=\"n\"><instance_geometry url=\"#g\"/></node></visual_scene></library_visual_scenes>"
        "<scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>";
    struct model_options options = metres_z_up;
    options.unit_m = 0;
    const char *path = put_text("unit.dae", dae);
    struct model *m = load(path, &options);
    OK(m && fabs(m->max_m.x - m->min_m.x - 2.54) < 1e-5 && fabs(m->max_m.z - 1.27) < 1e-5, "a COLLADA file's own unit counts, and its axes are the file's own");
    model_destroy(m);
    options.unit_m = 0.01;
    m = load(path, &options);
    OK(m && fabs(m->max_m.x - m->min_m.x - 1) < 1e-5, "a unit given stands instead of it");
    model_destroy(m);
    static const char fbx[] =
        "; FBX 7.3.0 project file\nFBXHeaderExtension:  {\n\tFBXHeaderVersion: 1003\n\tFBXVersion: 7300\n}\n"
        "GlobalSettings:  {\n\tProperties70:  {\n\t\tP: \"UnitScaleFactor\", \"double\", \"Number\", \"\",2.54\n\t}\n}\n"
        "Objects:  {\n\tGeometry: 1, \"Geometry::g\", \"Mesh\" {\n\t\tVertices: *9 {\n\t\t\ta: 0,0,0,100,0,0,0,0,50\n\t\t}\n"
        "\t\tPolygonVertexIndex: *3 {\n\t\t\ta: 0,1,-3\n\t\t}\n\t\tGeometryVersion: 124\n"
        "\t\tLayerElementMaterial: 0 {\n\t\t\tMappingInformationType: \"AllSame\"\n\t\t\tReferenceInformationType: \"IndexToDirect\"\n\t\t\tMaterials: *1 {\n\t\t\t\ta: 0\n\t\t\t}\n\t\t}\n"
        "\t\tLayer: 0 {\n\t\t\tLayerElement:  {\n\t\t\t\tType: \"LayerElementMaterial\"\n\t\t\t\tTypedIndex: 0\n\t\t\t}\n\t\t}\n\t}\n"
        "\tModel: 2, \"Model::m\", \"Mesh\" {\n\t\tVersion: 232\n\t\tProperties70:  {\n\t\t\tP: \"Lcl Scaling\", \"Lcl Scaling\", \"\", \"A\",2,1,1\n\t\t}\n\t}\n"
        "\tMaterial: 3, \"Material::Tire\", \"\" {\n\t\tVersion: 102\n\t\tShadingModel: \"phong\"\n\t\tProperties70:  {\n\t\t\tP: \"DiffuseColor\", \"Color\", \"\", \"A\",0.5,0.25,0\n\t\t}\n\t}\n}\n"
        "Connections:  {\n\tC: \"OO\",2,0\n\tC: \"OO\",1,2\n\tC: \"OO\",3,2\n}\n";
    options.unit_m = 0;
    m = load(put_text("unit.fbx", fbx), &options);
    OK(m && fabs(m->max_m.x - m->min_m.x - 5.08) < 1e-5 && fabs(m->max_m.z - 1.27) < 1e-5, "so does an FBX file's; its nodes are applied");
    OK(m && !strcmp(m->materials[0].name, "Tire") && fabs(m->materials[0].base_color[0] - 0.2140411) < 1e-5 && m->materials[0].names_only,
       "its material has its name, and its colour in linear light");
    model_destroy(m);
}

static void bad_files_are_refused(void)
{
    refused("nowhere.obj", &metres_z_up, "nowhere.obj: does not exist", "refuses a file that is not there");
    refused(put_text("car.stl", "solid"), &metres_z_up, "car.stl: is no model file by its name: .gltf, .glb, .obj, .ply, .dae or .fbx would be right", "refuses a format it does not know");
    refused(put_text("empty.obj", ""), &metres_z_up, "empty.obj: is empty", "refuses an empty file");
    refused(put_text("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2 3\n"), &metres_z_up, "points.obj: has no triangles", "refuses an OBJ file without faces");
    refused(put_text("only.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"), &metres_z_up, "only.obj: has no triangles", "refuses an OBJ file of vertices alone");
    refused(put_text("range.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n"), &metres_z_up, "range.obj: is no model that can be read: OBJ: vertex index out of range", "refuses an OBJ index out of range");
    refused(put_text("nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n"), &metres_z_up, "nan.obj: mesh 0: the position of vertex 1 is not a number", "refuses a coordinate that is not a number");
    refused(put_text("no.dae", "<COLLADA"), &metres_z_up, "no.dae: is no model that can be read: Unable to read file, malformed XML", "refuses a broken COLLADA file");
    refused(put_text("no.fbx", "Kaydara"), &metres_z_up, "no.fbx: is no model that can be read: FBX-Parser unexpected end of file", "refuses a broken FBX file");
}

/* --- glTF --- */

struct bytes { uint8_t data[4096]; size_t size; };

static void add_floats(struct bytes *b, const float *values, size_t n)
{
    memcpy(b->data + b->size, values, n * sizeof *values);
    b->size += n * sizeof *values;
}

static void base64(char *out, const uint8_t *data, size_t size)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < size; i += 3) {
        uint32_t v = (uint32_t)data[i] << 16 | (i + 1 < size ? (uint32_t)data[i + 1] << 8 : 0) | (i + 2 < size ? data[i + 2] : 0);
        *out++ = digits[v >> 18];
        *out++ = digits[v >> 12 & 63];
        *out++ = i + 1 < size ? digits[v >> 6 & 63] : '=';
        *out++ = i + 2 < size ? digits[v & 63] : '=';
    }
    *out = 0;
}

/* A .gltf file: one buffer of these bytes, and the rest of the JSON as given. */
static const char *put_gltf(const char *name, const struct bytes *b, const char *rest)
{
    static char text[32768], data[8192];
    base64(data, b->data, b->size);
    snprintf(text, sizeof text, "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":%zu,\"uri\":\"data:application/octet-stream;base64,%s\"}],%s}",
             b->size, data, rest);
    return put_text(name, text);
}

static const struct model_options as_in_file = { .axes_given = true, .up = AXIS_POS_Z, .front = AXIS_POS_X };

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

/* Two joints: the first stays; the second is turned 90 degrees about x at (0,0,2), having been bound
 * at (0,0,1). The corners follow the first, the second, and both by half. */
static void skins_are_applied(void)
{
    struct bytes b = { .size = 0 };
    add_floats(&b, (float[]){ 0, 0, 0, 1, 0, 3, 1, 0, 3 }, 9);          /* positions at 0 */
    add_floats(&b, (float[]){ 0, 0, 1, 0, 0, 1, 0, 0, 1 }, 9);          /* normals at 36 */
    memcpy(b.data + b.size, (uint8_t[]){ 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0 }, 12); /* joints at 72 */
    b.size += 12;
    add_floats(&b, (float[]){ 1, 0, 0, 0, 1, 0, 0, 0, 0.5f, 0.5f, 0, 0 }, 12); /* weights at 84 */
    add_floats(&b, (float[]){ 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -1, 1 }, 32); /* inverse bind at 132 */
    add_floats(&b, (float[]){ 0, 1 }, 2);                                /* key times at 260 */
    add_floats(&b, (float[]){ 0.70710678f, 0, 0, 0.70710678f, 0, 0, 0, 1 }, 8); /* rotations at 268 */
#define SKIN_START \
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36},{\"buffer\":0,\"byteOffset\":36,\"byteLength\":36},{\"buffer\":0,\"byteOffset\":72,\"byteLength\":12}," \
    "{\"buffer\":0,\"byteOffset\":84,\"byteLength\":48},{\"buffer\":0,\"byteOffset\":132,\"byteLength\":128},{\"buffer\":0,\"byteOffset\":260,\"byteLength\":8},{\"buffer\":0,\"byteOffset\":268,\"byteLength\":32}]," \
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},{\"bufferView\":1,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}," \
    "{\"bufferView\":2,\"componentType\":5121,\"count\":3,\"type\":\"VEC4\"},{\"bufferView\":3,\"componentType\":5126,\"count\":3,\"type\":\"VEC4\"},{\"bufferView\":4,\"componentType\":5126,\"count\":2,\"type\":\"MAT4\"}," \
    "{\"bufferView\":5,\"componentType\":5126,\"count\":2,\"type\":\"SCALAR\"},{\"bufferView\":6,\"componentType\":5126,\"count\":2,\"type\":\"VEC4\"}]," \
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1,\"JOINTS_0\":2,\"WEIGHTS_0\":3}}]}],"
#define SKIN_END "\"skins\":[{\"joints\":[1,2],\"inverseBindMatrices\":4}],\"scenes\":[{\"nodes\":[0,1]}],\"scene\":0"
    /* (1,0,3) by the second joint: (1,0,2) from where it was bound, turned (1,-2,0), at its place (1,-2,2).
     * By half: ((1,0,3) + (1,-2,2)) / 2 = (1,-1,2.5). The box is 0..1, -2..0, 0..2.5. */
    const char *nodes = "\"nodes\":[{\"mesh\":0,\"skin\":0,\"scale\":[100,100,100]},{\"children\":[2]},{\"translation\":[0,0,2],\"rotation\":[0.70710678,0,0,0.70710678]}],";
    char rest[4096];
    snprintf(rest, sizeof rest, SKIN_START "%s" SKIN_END, nodes);
    struct model *m = load(put_gltf("skin.gltf", &b, rest), &as_in_file);
    bool posed = m && has_vertex(m, -0.5, 1, 0) && has_vertex(m, 0.5, -1, 2) && has_vertex(m, 0.5, 0, 2.5);
    OK(posed, "a skin moves vertices by joint times inverse bind matrix; the mesh node's own transform does not count");
    OK(m && fabsf(m->meshes[0].normal[1][1] + 1) < 1e-6f && fabsf(m->meshes[0].normal[2][1] + 0.70710678f) < 1e-6f, "and turns normals with them");
    model_destroy(m);
    nodes = "\"nodes\":[{\"mesh\":0,\"skin\":0},{\"children\":[2]},{\"translation\":[0,0,2]}],"
            "\"animations\":[{\"channels\":[{\"sampler\":0,\"target\":{\"node\":2,\"path\":\"rotation\"}}],\"samplers\":[{\"input\":5,\"output\":6}]}],";
    snprintf(rest, sizeof rest, SKIN_START "%s" SKIN_END, nodes);
    m = load(put_gltf("animated.gltf", &b, rest), &as_in_file);
    OK(m && has_vertex(m, -0.5, 1, 0) && has_vertex(m, 0.5, -1, 2) && has_vertex(m, 0.5, 0, 2.5), "the first animation at time 0 is the pose");
    model_destroy(m);
    b.data[76] = 7;
    snprintf(rest, sizeof rest, SKIN_START "%s" SKIN_END, nodes);
    refused(put_gltf("joint.gltf", &b, rest), &as_in_file, "joint.gltf: mesh 0: joints: vertex 1 uses joint 7 of 2", "refuses a joint that the skin does not have");
    b.data[76] = 1;
    memset(b.data + 100, 0, 16);
    refused(put_gltf("weight.gltf", &b, rest), &as_in_file, "weight.gltf: mesh 0: joint weights: vertex 1 has none", "refuses a vertex without a weight");
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

/* --- real models --- */

static void real_models_are_loaded(void)
{
    static const struct { const char *file; double unit_m; const char *up, *front; double length_m[2], width_m[2], height_m[2]; size_t missing; } cars[] = {
        { "hatchback/meshes/hatchback.obj", 0.0254, "+z", "-y", { 3.8, 4.2 }, { 1.7, 2.2 }, { 1.4, 1.7 }, 0 },
        { "suv/meshes/suv.obj", 0.06, "+z", "+y", { 4.6, 5.3 }, { 1.9, 2.7 }, { 1.8, 2.3 }, 0 },
        { "prius_hybrid/meshes/Hybrid.obj", 0.01, "+z", "-y", { 4.4, 4.7 }, { 1.7, 2.1 }, { 1.4, 1.6 }, 0 },
        { "ambulance/meshes/ambulance.obj", 0.0254, "+z", "-y", { 6.5, 8 }, { 2.2, 3.1 }, { 2.5, 3.1 }, 1 },
        { "pickup/meshes/pickup.dae", 0, "+z", "+y", { 5.3, 6 }, { 1.9, 2.6 }, { 1.7, 2 }, 0 },
        { "CesiumMan.glb", 0, "+y", "+x", { 0.2, 0.5 }, { 0.8, 1.3 }, { 1.4, 1.9 }, 0 },
    };
    const char *shared = tap_shared();
    if (!shared) {
        SKIP("real vehicles and a person are loaded", "no folder of real material");
        return;
    }
    for (size_t i = 0; i < sizeof cars / sizeof *cars; i++) {
        char path[600];
        snprintf(path, sizeof path, "%s/models/%s", shared, cars[i].file);
        struct model_options options = { .unit_m = cars[i].unit_m, .axes_given = true, .up = axis_of(cars[i].up), .front = axis_of(cars[i].front) };
        struct model *m = load(path, &options);
        if (!OK(m != NULL, "%s is loaded", cars[i].file)) continue;
        double length = m->max_m.x - m->min_m.x, width = m->max_m.y - m->min_m.y, height = m->max_m.z;
        printf("# %s: %.3f x %.3f x %.3f m, %zu triangles\n", cars[i].file, length, width, height, triangles(m));
        OK(length > cars[i].length_m[0] && length < cars[i].length_m[1] && width > cars[i].width_m[0] && width < cars[i].width_m[1] &&
           height > cars[i].height_m[0] && height < cars[i].height_m[1], "its size is plausible");
        OK(m->missing_texture_count == cars[i].missing, "it misses %zu textures", cars[i].missing);
        for (size_t k = 0; k < m->missing_texture_count; k++)
            OK(!strcmp(m->missing_textures[k], "model://suv/materials/textures/wheels_01.png"), "and names it: %s", m->missing_textures[k]);
        /* Four wheels: the ground is touched ahead and behind, left and right. */
        bool touched[4] = { false };
        for (size_t k = 0; k < m->mesh_count; k++)
            for (size_t v = 0; v < m->meshes[k].vertices; v++) {
                const float *p = m->meshes[k].position_m[v];
                if (p[2] < 0.03f) touched[2 * (p[0] > 0) + (p[1] > 0)] = true;
            }
        if (cars[i].height_m[1] > length) OK(touched[0] || touched[1] || touched[2] || touched[3], "its feet are on the ground");
        else OK(touched[0] && touched[1] && touched[2] && touched[3], "its wheels are on the ground");
        model_destroy(m);
    }
}

int main(void)
{
    if (!mkdtemp(folder)) return 1;
    axes_are_turned();
    sizes_are_scaled();
    normals_are_computed();
    ply_is_read();
    units_of_collada_and_fbx_are_known();
    bad_files_are_refused();
    gltf_geometry_is_read();
    gltf_accessors_are_read();
    skins_are_applied();
    gltf_materials_are_read();
    bad_gltf_is_refused();
    textures_are_found();
    real_models_are_loaded();
    remove_tree(folder);
    return tap_done();
}
