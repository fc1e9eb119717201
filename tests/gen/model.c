/* Models of any format: axes, sizes, normals; OBJ, COLLADA and FBX. */
#include "tests/gen/model_files.h"

/* --- OBJ --- */

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
    units_of_collada_and_fbx_are_known();
    bad_files_are_refused();
    real_models_are_loaded();
    remove_tree(folder);
    return tap_done();
}
