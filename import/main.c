/* staffage-import: options in, a scene file out, and on the terminal how well it fits. */
#include "import/focal.h"
#include "import/path_from.h"
#include "import/photographs.h"
#include "import/placement.h"
#include "import/reconstruction.h"
#include "import/scene_yaml.h"
#include "lib/file.h"

#include <ctype.h>
#include <getopt.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static const char help[] =
    "Usage: staffage import colmap|opensfm|nerfstudio DIR -o SCENE.yaml [option ...]\n"
    "Write the scene file of a flight from what a structure-from-motion tool left in DIR.\n"
    "\n"
    "  -o, --output SCENE.yaml  the scene file; one that is there is not overwritten\n"
    "      --images FOLDER      where the photographs lie (without: in DIR, in a folder images\n"
    "                           in it, or likewise in the two folders above)\n"
    "      --mesh FILE          the place as a mesh (.ply, .obj), in the reconstruction's frame\n"
    "      --roads FILE         a map by OpenStreetMap (.osm, .osm.pbf)\n"
    "      --georeference WAY   gps: by the photographs' EXIF; none: the frame as it is;\n"
    "                           or a file of control points, one a line:\n"
    "                           NAME X Y Z LATITUDE LONGITUDE HEIGHT\n"
    "                           (the tool's own where it is metres, east, north, up; else gps)\n"
    "      --distance \"X Y Z X Y Z METRES\"\n"
    "                           instead: scale alone, by two points and how far they are apart\n"
    "      --utc-offset +HH:MM  of the clock that EXIF has the local time from\n"
    "  -h, --help               this text\n"
    "  -V, --version            the version\n"
    "\n"
    "Exit status: 0 done, 1 wrong input, 2 wrong usage, 3 a bug of ours.\n";

static const struct tool {
    const char *word, *name;
    bool (*read)(struct reconstruction *, const char *, struct error *);
} tools[] = {
    { "colmap", "COLMAP", colmap_read },
    { "opensfm", "OpenSfM", opensfm_read },
    { "nerfstudio", "nerfstudio", nerfstudio_read },
};

struct options {
    const struct tool *tool;
    const char *source, *scene, *images, *mesh, *roads, *utc_offset;
    struct placement_request placement;
};

static int usage(const char *what, const char *value)
{
    fprintf(stderr, "staffage-import: %s%s%s (staffage import --help)\n", what, value ? ": " : "", value ? value : "");
    return 2;
}

static bool is_utc_offset(const char *text)
{
    if (!strcmp(text, "Z")) return true;
    if (strlen(text) != 6 || !strchr("+-", text[0]) || text[3] != ':') return false;
    for (int i = 1; i < 6; i++)
        if (i != 3 && !isdigit((unsigned char)text[i])) return false;
    return atoi(text + 1) <= 14 && atoi(text + 4) < 60;
}

static bool parse_distance(struct placement_request *request, const char *text)
{
    double v[7];
    for (int i = 0; i < 7; i++) {
        char *end;
        v[i] = strtod(text, &end);
        if (end == text || !isfinite(v[i])) return false;
        text = end;
    }
    if (text[strspn(text, " ")]) return false;
    request->p[0] = vec3(v[0], v[1], v[2]);
    request->p[1] = vec3(v[3], v[4], v[5]);
    request->distance_m = v[6];
    request->way = PLACEMENT_DISTANCE;
    return true;
}

static void parse_georeference(struct placement_request *request, const char *text)
{
    request->way = !strcmp(text, "gps") ? PLACEMENT_GPS : !strcmp(text, "none") ? PLACEMENT_NONE : PLACEMENT_POINTS;
    request->points_file = text;
}

static void report_reconstruction(const struct tool *tool, const struct reconstruction *r)
{
    printf("%s: %zu photograph%s, %zu camera%s, %zu points\n", tool->name, r->shot_count, r->shot_count == 1 ? "" : "s",
           r->camera_count, r->camera_count == 1 ? "" : "s", r->point_count);
    if (r->left_out_count)
        printf("left out: %zu photographs of parts that hang together with no photograph of the largest\n",
               r->left_out_count);
    if (!r->observation_count) return;
    struct reprojection e = reconstruction_reprojection(r);
    printf("reprojection error: rms %.3f px, mean %.3f px over %zu observations\n", e.rms_px, e.mean_px,
           r->observation_count - e.without_image);
    printf("  mean over the points, of each one's mean: %.4f px", e.point_mean_px);
    if (r->has_stated_error) printf("; %s states %.4f px", tool->name, r->stated_error_px);
    putchar('\n');
    if (e.without_image) printf("  %zu observations are of points behind their camera\n", e.without_image);
}

static void report_placement(const struct placement *p)
{
    if (p->tie_count) {
        size_t inliers = 0;
        int widest = 5;
        for (size_t i = 0; i < p->tie_count; i++)
            if ((int)strlen(p->ties[i].name) > widest) widest = (int)strlen(p->ties[i].name);
        printf("%-*s  %12s  %10s\n", widest, p->way == PLACEMENT_GPS ? "image" : "point", "horizontal_m", "vertical_m");
        for (size_t i = 0; i < p->tie_count; i++) {
            const struct tie_residual *d = &p->residuals[i];
            printf("%-*s  %12.2f  %+10.2f%s\n", widest, p->ties[i].name, d->horizontal_m, d->vertical_m,
                   d->inlier ? "" : "  left out");
            inliers += d->inlier;
        }
        printf("georeference: rms %.2f m over %zu of %zu %s\n", p->rms_m, inliers, p->tie_count,
               p->way == PLACEMENT_GPS ? "GPS positions" : "control points");
    }
    if (p->way == PLACEMENT_DISTANCE)
        printf("up: by %s, which spread by %.1f deg\n", p->upright.by_points ? "the plane of the sparse points" : "the cameras",
               p->upright.spread_rad * 180 / M_PI);
    printf("scale: %.6g m to a unit\n", p->world_from_reconstruction.scale);
    if (p->has_place)
        printf("origin: latitude %.6f, longitude %.6f, height %.2f m\n", p->origin_lat_lon_h[0], p->origin_lat_lon_h[1],
               p->origin_lat_lon_h[2]);
    else if (p->way == PLACEMENT_NONE)
        puts("no georeference: the world is the tool's own frame, whose unit is hardly a metre");
}

static void warn_of_focal(const struct reconstruction *reconstruction, const struct photo_facts *facts)
{
    struct focal_check c;
    if (focal_differs(&c, reconstruction, facts))
        fprintf(stderr,
                "staffage-import: warning: the focal length is %.1f mm in the reconstruction, and EXIF says %.0f (35 mm film): "
                "heights may be wrong by about that factor, %.2f. One may go on: what stands on the ground stays right, "
                "heights of the place do not (docs/import.md, \"Is it right?\")\n",
                c.reconstruction_mm, c.exif_mm, c.reconstruction_mm / c.exif_mm);
}

/* Hardly a country keeps its clock 3 hours away from its sun. */
static void warn_of_offset(const char *utc_offset, double longitude_deg)
{
    int hours = 0, minutes = 0;
    sscanf(utc_offset + 1, "%2d:%2d", &hours, &minutes);
    double offset_h = (utc_offset[0] == '-' ? -1 : 1) * (hours + minutes / 60.0), sun_h = longitude_deg / 15;
    double apart_h = fabs(remainder(offset_h - sun_h, 24)); /* beyond the date line a day is no difference */
    if (apart_h > 3)
        fprintf(stderr, "staffage-import: warning: --utc-offset %s is %.1f h away from the sun's time at longitude %.1f "
                "(%+.1f h): is that the offset of the place?\n", utc_offset, apart_h, longitude_deg, sun_h);
}

static void warn_of_no_times(const struct photographs *photographs)
{
    size_t without = photographs->count - photographs_with_clock(photographs);
    if (without)
        fprintf(stderr, "staffage-import: warning: the shots have no times: %zu of %zu photographs have none in their EXIF\n",
                without, photographs->count);
    else
        fputs("staffage-import: warning: the shots have no times: EXIF has no offset from UTC; give --utc-offset +HH:MM\n", stderr);
}

static bool ends_in(const char *path, const char *ending)
{
    size_t n = strlen(path), m = strlen(ending);
    return n > m && !strcasecmp(path + n - m, ending);
}

/* What would fail only later, when the scene is used, or under a name that says less. */
static bool check_files(const struct options *o, struct error *err)
{
    if (file_exists(o->scene))
        return error_at(err, ERR_INPUT, o->scene, 0, 0, "is there already, and may hold your work: give another name or remove it");
    if (o->placement.way == PLACEMENT_POINTS && !file_exists(o->placement.points_file))
        return error_at(err, ERR_INPUT, o->placement.points_file, 0, 0,
                        "there is no such file; --georeference takes gps, none or a file of control points");
    if (o->mesh && !ends_in(o->mesh, ".ply") && !ends_in(o->mesh, ".obj"))
        return error_at(err, ERR_INPUT, o->mesh, 0, 0, "is no mesh of a place by its name: .ply or .obj would be right");
    if (o->roads && !ends_in(o->roads, ".osm") && !ends_in(o->roads, ".pbf"))
        return error_at(err, ERR_INPUT, o->roads, 0, 0, "is no map by its name: .osm or .osm.pbf would be right");
    return true;
}

static void report_scene(const char *scene, const struct placement *placement)
{
    if (placement->way == PLACEMENT_NONE && !placement->has_place)
        printf("scene: %s; nothing can be put into it before it is in metres: --georeference gps or FILE, or --distance\n", scene);
    else
        printf("scene: %s; light, exposure, lens and who comes by are yours to say there: #light: to #traffic:\n", scene);
}

static bool import(const struct options *o, struct error *err)
{
    struct reconstruction reconstruction = { 0 };
    struct photographs photographs = { 0 };
    struct placement placement = { 0 };
    char *mesh = NULL, *roads = NULL, *text = NULL;
    bool ok = check_files(o, err) && o->tool->read(&reconstruction, o->source, err) &&
              photographs_find(&photographs, &reconstruction, o->scene, o->source, o->images, err) &&
              (!o->mesh || (mesh = path_from(o->scene, o->mesh, err))) &&
              (!o->roads || (roads = path_from(o->scene, o->roads, err))) &&
              placement_find(&placement, &reconstruction, photographs.facts, &o->placement, err);
    if (ok) {
        const struct imported imported = { o->tool->name, &reconstruction, &photographs, &placement,
                                           o->utc_offset, mesh, roads };
        report_reconstruction(o->tool, &reconstruction);
        report_placement(&placement);
        warn_of_focal(&reconstruction, photographs.facts);
        ok = scene_yaml_write(&text, &imported, err) && file_write(o->scene, text, strlen(text), err);
        if (ok && !scene_yaml_has_times(&imported))
            warn_of_no_times(&photographs);
        else if (ok && o->utc_offset && placement.has_place)
            warn_of_offset(o->utc_offset, placement.origin_lat_lon_h[1]);
        if (ok) report_scene(o->scene, &placement);
    }
    free(text);
    free(mesh);
    free(roads);
    placement_release(&placement);
    photographs_release(&photographs);
    reconstruction_release(&reconstruction);
    return ok;
}

int main(int argc, char **argv)
{
    enum { IMAGES = 256, MESH, ROADS, GEOREFERENCE, DISTANCE, UTC_OFFSET };
    static const struct option longs[] = {
        { "output", required_argument, NULL, 'o' },      { "images", required_argument, NULL, IMAGES },
        { "mesh", required_argument, NULL, MESH },       { "roads", required_argument, NULL, ROADS },
        { "georeference", required_argument, NULL, GEOREFERENCE },
        { "distance", required_argument, NULL, DISTANCE }, { "utc-offset", required_argument, NULL, UTC_OFFSET },
        { "help", no_argument, NULL, 'h' },              { "version", no_argument, NULL, 'V' },
        { 0 },
    };
    struct options o = { 0 };
    bool placed = false;
    for (int c; (c = getopt_long(argc, argv, "o:hV", longs, NULL)) != -1;) switch (c) {
        case 'o': o.scene = optarg; break;
        case IMAGES: o.images = optarg; break;
        case MESH: o.mesh = optarg; break;
        case ROADS: o.roads = optarg; break;
        case GEOREFERENCE:
        case DISTANCE:
            if (placed) return usage("--georeference and --distance: one of them, once", NULL);
            placed = true;
            if (c == GEOREFERENCE)
                parse_georeference(&o.placement, optarg);
            else if (!parse_distance(&o.placement, optarg))
                return usage("--distance takes \"X Y Z X Y Z METRES\", seven numbers", optarg);
            break;
        case UTC_OFFSET:
            if (!is_utc_offset(optarg)) return usage("--utc-offset takes +HH:MM or -HH:MM", optarg);
            o.utc_offset = optarg;
            break;
        case 'h': fputs(help, stdout); return 0;
        case 'V': puts("staffage-import " PACKAGE_VERSION); return 0;
        default: return 2;
        }
    if (optind + 2 != argc) return usage("a tool and its folder are needed: colmap, opensfm or nerfstudio, and DIR", NULL);
    for (size_t i = 0; i < sizeof tools / sizeof *tools; i++)
        if (!strcmp(argv[optind], tools[i].word)) o.tool = &tools[i];
    if (!o.tool) return usage("colmap, opensfm and nerfstudio are understood", argv[optind]);
    if (!o.scene) return usage("a scene file is needed: -o SCENE.yaml", NULL);
    o.source = argv[optind + 1];

    struct error err = ERROR_NONE;
    if (!import(&o, &err)) error_print(&err, "staffage-import");
    return error_exit_status(&err);
}
