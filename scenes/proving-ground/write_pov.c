#include "write_pov.h"

#include "map_flight.h"
#include "pinhole.h"
#include "place_heights.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct bounds { double x0, y0, x1, y1; };

static void bounds_add(struct bounds *b, double x, double y)
{
    *b = (struct bounds){ fmin(b->x0, x), fmin(b->y0, y), fmax(b->x1, x), fmax(b->y1, y) };
}
static struct bounds bounds_none(void) { return (struct bounds){ INFINITY, INFINITY, -INFINITY, -INFINITY }; }
static struct rect bounds_rect(const struct bounds *b, int width_px, int height_px)
{
    struct rect r = { (int)fmax(0, floor(b->x0)), (int)fmax(0, floor(b->y0)), (int)fmin(width_px, ceil(b->x1)),
                      (int)fmin(height_px, ceil(b->y1)) };
    return r.x1 > r.x0 && r.y1 > r.y0 ? r : (struct rect){ 0, 0, 1, 1 };
}

/* Half of a box that holds any of our cars or people, with all that hangs over. */
static struct vec3 half_box(const struct proving_entity *e)
{
    return !strcmp(e->class_, "person") ? vec3(0.7, 0.7, 2.1) : vec3(2.7, 1.25, 2.0);
}

static struct vec3 box_corner(const struct proving_entity *e, int i)
{
    struct vec3 h = half_box(e);
    struct vec3 p = vec3((i & 1 ? 1 : -1) * h.x, (i & 2 ? 1 : -1) * h.y, i & 4 ? h.z : -0.05);
    return pose_apply(proving_entity_pose(e), p);
}

bool label_window(struct rect *window_px, const struct proving_case *c, size_t shot, const struct camera *camera, size_t n,
                  struct error *err)
{
    struct pose camera_from_world = pose_inverse(proving_shot_pose(&c->shots[shot]));
    struct bounds b = bounds_none();
    for (size_t i = 0; i < proving_entity_count(c); i++)
        for (int k = 0; (n == 0 || i == n - 1) && k < 8; k++) {
            struct vec2 q;
            struct vec3 p = pose_apply(camera_from_world, box_corner(&c->entities[i], k));
            if (!camera_project(camera, &q, p, err)) return error_prefix(err, "%s: an entity outside the lens: ", c->name);
            bounds_add(&b, q.x - 2, q.y - 2);
            bounds_add(&b, q.x + 2, q.y + 2);
        }
    *window_px = bounds_rect(&b, camera->width_px, camera->height_px);
    return true;
}

/* --- text --- */

static void put_vector(FILE *f, const char *name, struct vec3 v)
{
    fprintf(f, "%s <%.12g, %.12g, %.12g>\n", name, v.x, v.y, v.z);
}

static void put_map_camera(FILE *f, const struct map_view *v)
{
    fputs("camera {\n  orthographic\n", f);
    put_vector(f, "  location", vec3_sub(v->middle_m, vec3_scale(v->forward, 100)));
    put_vector(f, "  right", vec3_scale(v->right, (double)v->width_px / PROVING_MAP_PX_PER_M));
    put_vector(f, "  up", vec3_scale(v->up, (double)v->height_px / PROVING_MAP_PX_PER_M));
    put_vector(f, "  direction", v->forward);
    fputs("}\n", f);
}

static void put_pinhole(FILE *f, const struct pinhole *p, struct pose world_from_camera)
{
    struct vec3 x = mat3_column(world_from_camera.rotation, 0), down = mat3_column(world_from_camera.rotation, 1),
                z = mat3_column(world_from_camera.rotation, 2), up = vec3_scale(down, -1);
    fputs("camera {\n  perspective\n", f);
    put_vector(f, "  location", world_from_camera.translation);
    put_vector(f, "  right", vec3_scale(x, p->width_px / p->f_px));
    put_vector(f, "  up", vec3_scale(up, p->height_px / p->f_px));
    put_vector(f, "  direction", vec3_add(z, vec3_add(vec3_scale(x, (p->width_px / 2.0 - p->cx_px) / p->f_px),
                                                      vec3_scale(up, -(p->height_px / 2.0 - p->cy_px) / p->f_px))));
    fputs("}\n", f);
}

/* One face for each pixel of the window, whose normal is the ray through the pixel's middle. The faces are 2 m wide, for
 * POV-Ray keeps their corners as floats. */
static bool put_ray_camera(FILE *f, const struct camera *camera, struct pose world_from_camera, struct rect w, struct error *err)
{
    int width = w.x1 - w.x0, height = w.y1 - w.y0;
    fprintf(f, "#declare Rays = mesh2 { vertex_vectors { %d", 3 * width * height);
    for (int y = w.y0; y < w.y1; y++)
        for (int x = w.x0; x < w.x1; x++) {
            struct vec3 d;
            if (!camera_unproject(camera, &d, (struct vec2){ x + 0.5, y + 0.5 }, err)) return false;
            d = mat3_apply(world_from_camera.rotation, d);
            struct vec3 a = vec3_unit(vec3_cross(d, fabs(d.z) < 0.7 ? vec3(0, 0, 1) : vec3(1, 0, 0))), b = vec3_cross(d, a);
            for (int k = 0; k < 3; k++) {
                double turn = -2 * M_PI * k / 3;
                struct vec3 p = vec3_add(world_from_camera.translation,
                                         vec3_add(vec3_scale(a, 2 * cos(turn)), vec3_scale(b, 2 * sin(turn))));
                fprintf(f, ",\n<%.9g,%.9g,%.9g>", p.x, p.y, p.z);
            }
        }
    fprintf(f, "}\nface_indices { %d", width * height);
    for (int i = 0; i < width * height; i++) fprintf(f, ",\n<%d,%d,%d>", 3 * i, 3 * i + 1, 3 * i + 2);
    fputs("} }\ncamera { mesh_camera { 1 0 mesh { Rays } } location <0, 0, 0> }\n", f);
    return true;
}

static void put_matrix(FILE *f, struct pose p)
{
    fputs("matrix <", f);
    for (int i = 0; i < 3; i++)
        fprintf(f, "%.12g, %.12g, %.12g, ", p.rotation.m[0][i], p.rotation.m[1][i], p.rotation.m[2][i]);
    fprintf(f, "%.12g, %.12g, %.12g>", p.translation.x, p.translation.y, p.translation.z);
}

/* Red: depth; green: the id. */
static void put_label_texture(FILE *f, struct pose world_from_camera, size_t id)
{
    struct vec3 z = mat3_column(world_from_camera.rotation, 2), at = world_from_camera.translation;
    double green = (double)id * PROVING_ID_SCALE / 65535;
    fprintf(f, "texture { pigment { function { min(0.99999, max(0, ((x - %.12g) * %.12g + (y - %.12g) * %.12g + (z - %.12g) * %.12g) / %d)) }\n"
            "  color_map { [0 rgb <0, %.9g, 0>] [1 rgb <1, %.9g, 0>] } } finish { emission 1 diffuse 0 } }\n",
            at.x, z.x, at.y, z.y, at.z, z.z, PROVING_DEPTH_M, green, green);
}

static void put_range_texture(FILE *f, struct vec3 eye)
{
    fprintf(f, "texture { pigment { function { min(0.99999, sqrt(pow(x - %.12g, 2) + pow(y - %.12g, 2) + pow(z - %.12g, 2)) / %d) }\n"
            "  color_map { [0 rgb 0] [1 rgb 1] } } finish { emission 1 diffuse 0 } }\n", eye.x, eye.y, eye.z, PROVING_RANGE_M);
}

static void put_height_texture(FILE *f)
{
    fprintf(f, "texture { pigment { function { min(0.99999, max(0, (z + 1) / %d)) }\n"
            "  color_map { [0 rgb 0] [1 rgb 1] } } finish { emission 1 diffuse 0 } }\n", PROVING_HEIGHT_M);
}

/* Of the mesh's cells, along z. */
static void put_cells_camera(FILE *f, bool from_below)
{
    double w = PROVING_MESH_COLUMNS * PROVING_MESH_CELL_M, h = PROVING_MESH_ROWS * PROVING_MESH_CELL_M;
    fprintf(f, "camera { orthographic location <%.9g, %.9g, %d> right %.9g * x up %.9g * y direction %sz }\n",
            PROVING_MESH_X0_M + w / 2, PROVING_MESH_Y0_M + h / 2, from_below ? -100 : 100, w, h, from_below ? "" : "-");
}

/* HEIGHTS_KINDS: none. */
static int heights_of(const char *kind)
{
    int i = 0;
    while (i < HEIGHTS_KINDS && strcmp(kind, place_heights_kinds[i])) i++;
    return i;
}

/* The view of the mapping flight of this kind; PROVING_MAP_VIEWS: none. */
static int map_of(const char *kind)
{
    int i = 0;
    while (i < PROVING_MAP_VIEWS && strcmp(kind, map_view(i).kind)) i++;
    return i;
}

static bool put_scene(FILE *f, struct pov_job *job, const char *kind, const struct proving_case *c, size_t shot,
                      const struct camera *camera, double fineness, struct error *err)
{
    struct pose world_from_camera = proving_shot_pose(&c->shots[shot]);
    size_t alone = !strncmp(kind, "alone-", 6) ? strtoul(kind + 6, NULL, 10) : 0;
    int cells = heights_of(kind);
    bool labels = alone || !strcmp(kind, "labels"), heights = cells < HEIGHTS_KINDS, truth = !strncmp(kind, "truth", 5);
    bool range = !strcmp(kind, "range") || !strcmp(kind, "truth-range"), lit = !labels && !heights && !range;
    int map = map_of(kind);
    bool mapped = map < PROVING_MAP_VIEWS;
    fprintf(f, "#version 3.7;\n// shot %zu: %s\n#declare Lit = %d;\n#declare With_Thin = %d;\n", shot, kind, lit, !heights && !mapped);
    fputs("#include \"settings_proving.inc\"\n", f);
    *job = (struct pov_job){ .is_png = !lit };
    struct pinhole pinhole;
    if (!pinhole_cover(&pinhole, camera, fineness, err)) return false;
    if (labels) {
        struct rect w;
        if (!label_window(&w, c, shot, camera, alone, err) || !put_ray_camera(f, camera, world_from_camera, w, err)) return false;
        job->width_px = w.x1 - w.x0;
        job->height_px = w.y1 - w.y0 + 1; /* POV-Ray gives the first row of faces to the first row and to the second */
    } else if (heights) {
        job->width_px = PROVING_MESH_COLUMNS;
        job->height_px = PROVING_MESH_ROWS;
        put_cells_camera(f, cells == HEIGHTS_BOTTOM);
    } else if (mapped) {
        struct map_view view = map_view(map);
        put_map_camera(f, &view);
        job->width_px = view.width_px;
        job->height_px = view.height_px;
    } else {
        put_pinhole(f, &pinhole, world_from_camera);
        job->width_px = pinhole.width_px;
        job->height_px = pinhole.height_px;
    }
    if (lit) fputs("#include \"light.inc\"\n#include \"light_proving.inc\"\n#include \"street_materials.inc\"\n", f);
    else {
        fputs("#declare Matter =\n", f);
        if (labels) put_label_texture(f, world_from_camera, 0);
        if (heights) put_height_texture(f);
        if (range) put_range_texture(f, world_from_camera.translation);
        fputs("#include \"street_matter.inc\"\n", f);
        if (range) fputs("background { rgb 1 }\n", f);
    }
    const char *treeless = "object { Ground }\nobject { Markings }\nobject { Houses }\nobject { Parked_Cars }";
    const char *parts = !heights ? "object { Street }" : cells == HEIGHTS_GROUND ? treeless : "object { Trees }";
    if (!alone) fprintf(f, "#include \"street.inc\"\n%s\n", parts);
    if (!truth && !labels) return true;
    fprintf(f, "#declare Shapes_Only = %d;\n#include \"models.inc\"\n", !lit);
    for (size_t i = 1; labels && !alone && i <= proving_entity_count(c); i++)
        fprintf(f, "#debug concat(\"extent %zu: \", vstr(3, min_extent(Entity_%zu), \" \", 0, 7), \" \", vstr(3, max_extent(Entity_%zu), \" \", 0, 7), \"\\n\")\n", i, i, i);
    for (size_t i = 0; i < proving_entity_count(c); i++) {
        if (alone && alone != i + 1) continue;
        fprintf(f, "object {\n  Entity_%zu ", i + 1);
        put_matrix(f, proving_entity_pose(&c->entities[i]));
        if (labels) put_label_texture(f, world_from_camera, i + 1);
        else if (!lit) fputs("texture { Matter }", f);
        fputs("\n}\n", f);
    }
    return true;
}

bool write_pov(struct pov_job *job, const char *path, const char *kind, const struct proving_case *c, size_t shot,
               const struct camera *camera, double fineness, struct error *err)
{
    FILE *f = fopen(path, "w");
    if (!f) return error_at(err, ERR_INPUT, path, 0, 0, "cannot be written");
    bool ok = put_scene(f, job, kind, c, shot, camera, fineness, err);
    return (fclose(f) == 0 || error_at(err, ERR_INPUT, path, 0, 0, "cannot be written")) && ok;
}
