#include "import/scene_yaml.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* The shortest of 15 to 17 digits that is this very number. */
static void put_number(FILE *f, double value)
{
    char text[32];
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, value);
        if (strtod(text, NULL) == value) break;
    }
    fputs(text, f);
}

static void put_numbers(FILE *f, const double *values, int n)
{
    fputc('[', f);
    for (int i = 0; i < n; i++) {
        if (i) fputs(", ", f);
        put_number(f, values[i]);
    }
    fputs("]\n", f);
}

/* Quotes where a reader of YAML could take the text for something else. */
static bool is_plain(const char *text)
{
    static const char *const words[] = { "null", "true", "false", "yes", "no", "on", "off", "y", "n" };
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (!strcasecmp(text, words[i])) return false;
    if (!isalpha((unsigned char)text[0]) && text[0] != '/' && strncmp(text, "../", 3)) return false;
    for (const char *c = text; *c; c++)
        if (!isalnum((unsigned char)*c) && !strchr("._/-+", *c)) return false;
    return true;
}

static void put_text(FILE *f, const char *text)
{
    if (is_plain(text)) {
        fputs(text, f);
        return;
    }
    fputc('"', f);
    for (const unsigned char *c = (const unsigned char *)text; *c; c++) {
        if (*c == '"' || *c == '\\')
            fprintf(f, "\\%c", *c);
        else if (*c < 0x20 || *c == 0x7f)
            fprintf(f, "\\x%02x", *c);
        else
            fputc(*c, f);
    }
    fputc('"', f);
}

static void put_quat(FILE *f, struct mat3 rotation)
{
    struct quat q = quat_from_mat3(rotation);
    put_numbers(f, (const double[]){ q.w, q.x, q.y, q.z }, 4);
}

static void put_vec3(FILE *f, struct vec3 v) { put_numbers(f, (const double[]){ v.x, v.y, v.z }, 3); }

static const char *plural(size_t n) { return n == 1 ? "" : "s"; }

static void put_head(FILE *f, const struct imported *in)
{
    const struct placement *p = in->placement;
    fprintf(f, "# A flight of %zu photograph%s, from a reconstruction by %s (staffage import).\n",
            in->reconstruction->shot_count, plural(in->reconstruction->shot_count), in->tool);
    switch (p->way) {
    case PLACEMENT_GPS:
    case PLACEMENT_POINTS:
        fprintf(f, "# The world is in metres, x east, y north, z up, by %zu %s, to %.2f m rms.\n", p->tie_count,
                p->way == PLACEMENT_GPS ? "GPS positions in the photographs" : "control points", p->rms_m);
        break;
    case PLACEMENT_DISTANCE:
        fputs("# The world is in metres by one known distance, z up; where north is, is not known:\n"
              "# north_deg says where the y axis points.\n", f);
        break;
    case PLACEMENT_DEFAULT:
    case PLACEMENT_NONE:
        if (p->has_place)
            fprintf(f, "# The world is that of %s: metres, x east, y north, z up.\n", in->tool);
        else
            fprintf(f, "# No georeference: the world is the frame of %s, at scale 1. Its unit is hardly a metre and its z\n"
                       "# axis hardly up, so nothing can be put into it yet.\n", in->tool);
    }
    fputs("# What every key means: staffage-scene(5).\n\nstaffage: 1\n", f);
    if (p->has_place) {
        fputs("\nplace:\n  latitude_deg: ", f);
        put_number(f, p->origin_lat_lon_h[0]);
        fputs("\n  longitude_deg: ", f);
        put_number(f, p->origin_lat_lon_h[1]);
        fputs("\n  height_m: ", f);
        put_number(f, p->origin_lat_lon_h[2]);
        fputc('\n', f);
    }
}

static void put_cameras(FILE *f, const struct reconstruction *r)
{
    fputs("\ncameras:\n", f);
    for (size_t i = 0; i < r->camera_count; i++) {
        const struct camera *camera = &r->cameras[i].camera;
        fputs("  ", f);
        put_text(f, r->cameras[i].name);
        fprintf(f, ":\n    model: %s\n    size_px: [%d, %d]\n    # %s\n    params: ", camera_model_name(camera->model),
                camera->width_px, camera->height_px, camera_model_param_names(camera->model));
        put_numbers(f, camera->params, camera_model_param_count(camera->model));
    }
}

static void put_shots(FILE *f, const struct imported *in)
{
    const struct reconstruction *r = in->reconstruction;
    bool times = scene_yaml_has_times(in);
    fputs("\nshots:\n", f);
    size_t with_clock = photographs_with_clock(in->photographs);
    if (!times && with_clock == in->photographs->count)
        fputs("  # No times: the photographs' EXIF does not tell them with an offset from UTC. The sun and whatever moves need\n"
              "  # them; staffage import --utc-offset +HH:MM writes them.\n", f);
    else if (!times)
        fprintf(f, "  # No times: %zu of %zu photographs have none in their EXIF. The sun and whatever moves need them: give every\n"
                   "  # shot its own, like time: 2021-05-01T10:53:40-04:00\n",
                in->photographs->count - with_clock, in->photographs->count);
    for (size_t i = 0; i < r->shot_count; i++) {
        struct pose pose = placement_shot(in->placement, &r->shots[i]);
        fputs("  - photograph: ", f);
        put_text(f, in->photographs->names[i]);
        fputs("\n    camera: ", f);
        put_text(f, r->cameras[r->shots[i].camera].name);
        char time[40];
        if (times && photograph_time(time, &in->photographs->facts[i], in->utc_offset)) fprintf(f, "\n    time: %s", time);
        fputs("\n    pose:\n      camera_from_world:\n        quaternion_wxyz: ", f);
        put_quat(f, pose.rotation);
        fputs("        translation_m: ", f);
        put_vec3(f, pose.translation);
    }
}

/* The transform is known even where no mesh is given yet: then every line is a comment. Keys in comments have no
 * blank after the #, so that taking it away leaves them where YAML wants them. */
static void put_static(FILE *f, const struct imported *in)
{
    const struct similarity *s = &in->placement->world_from_reconstruction;
    const char *off = in->mesh ? "" : "#";
    if (in->mesh)
        fputs("\n# The place as a mesh, in the reconstruction's own frame.\n", f);
    else
        fputs("\n# The place as a mesh (PLY or OBJ), in the reconstruction's own frame; without one, the ground is a plane.\n", f);
    fprintf(f, "%sstatic:\n%s  mesh: ", off, off);
    put_text(f, in->mesh ? in->mesh : "mesh.ply");
    fprintf(f, "\n%s  world_from_mesh:\n%s    scale: ", off, off);
    put_number(f, s->scale);
    fprintf(f, "\n%s    quaternion_wxyz: ", off);
    put_quat(f, s->rotation);
    fprintf(f, "%s    translation_m: ", off);
    put_vec3(f, s->translation);
    if (!in->mesh) fputs("#ground: {height_m: 0, albedo: 0.2}  # the plane\n", f);
}

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The median of the exposures that EXIF tells; 0 for none. */
static double usual_exposure(const struct photographs *photographs)
{
    double *values = calloc(photographs->count + 1, sizeof *values), usual = 0;
    size_t n = 0;
    for (size_t i = 0; values && i < photographs->count; i++)
        if (photographs->facts[i].has_exposure) values[n++] = photographs->facts[i].exposure_s;
    if (n) {
        qsort(values, n, sizeof *values, by_value);
        usual = values[n / 2];
    }
    free(values);
    return usual;
}

static void put_rest(FILE *f, const struct imported *in)
{
    fputc('\n', f);
    if (in->roads) {
        fputs("roads:\n  osm: ", f);
        put_text(f, in->roads);
        fputs("\n  driving_side: right  # or left\n"
              "  sidewalk_m: 1.8  # where the map has sidewalks, and along residential streets; 0: none\n", f);
    } else {
        fputs("# The map (OpenStreetMap, .osm or .pbf) whose roads are driven on, or paths by hand.\n"
              "#roads: {osm: roads.osm, driving_side: right, sidewalk_m: 1.8}\n"
              "#paths: [{name: lane, use: vehicles, width_m: 3.5, points_m: [[-20, 0], [20, 5]]}]\n", f);
    }
    fputs("\n# What no reconstruction tells. Take the # away and say how it was.\n"
          "#light: {sky: clear, fill: 0.1}  # or overcast\n"
          "#exposure: {roads: true}  # or patch_px, or a value\n", f);
    if (in->mesh)
        fputs("#ground: {albedo: 0.2}  # of the road in the sun: what is put in looks too bright? raise it\n", f);
    double exposure_s = usual_exposure(in->photographs);
    fputs("#lens: {exposure_s: ", f);
    put_number(f, exposure_s > 0 ? exposure_s : 0.002);
    fputs(exposure_s > 0 ? "}  # by EXIF: what moves is blurred by it\n"
                         : "}  # a guess, for EXIF has none: what moves is blurred by it\n", f);
    fputs("\n# Who is to come by: staffage models lists who there is, and adds models of yours.\n"
          "#traffic:\n"
          "#  vehicles: {count: 12, models: any car, speed_m_s: 8}\n"
          "#  people: {count: 12, models: any person, speed_m_s: 1.4}\n", f);
}

bool scene_yaml_has_times(const struct imported *in)
{
    char time[40];
    for (size_t i = 0; i < in->photographs->count; i++)
        if (!photograph_time(time, &in->photographs->facts[i], in->utc_offset)) return false;
    return true;
}

bool scene_yaml_write(char **text, const struct imported *imported, struct error *err)
{
    char *written = NULL;
    size_t size = 0;
    FILE *f = open_memstream(&written, &size);
    if (!f) return error_set(err, ERR_MEMORY, "no memory for the scene file");
    put_head(f, imported);
    put_cameras(f, imported->reconstruction);
    put_shots(f, imported);
    put_static(f, imported);
    put_rest(f, imported);
    bool ok = !ferror(f);
    if (fclose(f) != 0 || !ok) {
        free(written);
        return error_set(err, ERR_MEMORY, "no memory for the scene file");
    }
    *text = written;
    return true;
}
