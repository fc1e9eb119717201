/* staffage-fuse: options in, one call, an exit code out. */
#include "gen/model/catalogue.h"
#include "gen/scene/scene.h"
#include "gen/trace/fusion.h"
#include "gen/trace/semantic.h"
#include "gen/world/static_mesh.h"
#include "lib/error.h"

#include <getopt.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "Usage: staffage fuse SCENE.yaml -o SEMANTIC.ply [option ...]\n"
    "Fuse the semantic images of a scene's shots onto its mesh, and write that with a label for each face.\n"
    "\n"
    "  -o, --output SEMANTIC.ply  the mesh with labels, world metres\n"
    "      --fill METRES          how far a face that no image shows may take its label from (2)\n"
    "  -h, --help                 this text\n"
    "  -V, --version              the version\n"
    "\n"
    "Exit status: 0 done, 1 wrong input, 2 wrong usage, 3 a bug of ours.\n";

struct options { const char *scene, *out; double fill_m; };

static int usage(const char *what, const char *value)
{
    fprintf(stderr, "staffage-fuse: %s%s%s (staffage fuse --help)\n", what, value ? ": " : "", value ? value : "");
    return 2;
}

static bool add_shot(struct fusion *fusion, const struct scene *scene, const struct scene_shot *shot, struct error *err)
{
    struct image ids;
    const struct camera *given = &scene->cameras[shot->camera].camera;
    int width, height;
    if (!image_read_size(&width, &height, shot->semantic, err)) return false;
    double across = (double)width / given->width_px, down = (double)height / given->height_px;
    if (fabs(across - down) > 0.005 * across)
        return error_at(err, ERR_INPUT, shot->semantic, 0, 0, "is %d x %d pixels: not in proportion to the camera's %d x %d",
                        width, height, given->width_px, given->height_px);
    if (!semantic_read(&ids, shot->semantic, scene->palette, err)) return false;
    struct camera camera = camera_scaled(given, width, height);
    bool ok = fusion_add(fusion, &ids, &camera, shot->world_from_camera, err);
    image_release(&ids);
    return ok;
}

/* A palette's colours, face by face. */
static void color_faces(uint8_t (*color)[3], const uint8_t *label, size_t faces, enum palette palette)
{
    size_t n;
    const struct palette_label *labels = palette_labels(palette, &n);
    for (size_t i = 0; i < faces; i++)
        for (size_t k = 0; k < n; k++)
            if (labels[k].id == label[i]) memcpy(color[i], labels[k].color, sizeof color[i]);
}

static bool fuse_shots(struct fusion *fusion, const struct scene *scene, size_t *images, struct error *err)
{
    *images = 0;
    for (size_t i = 0; i < scene->shot_count; i++) {
        if (!scene->shots[i].semantic) continue;
        if (!add_shot(fusion, scene, &scene->shots[i], err)) return false;
        ++*images;
    }
    return *images > 0 || error_at(err, ERR_INPUT, scene->path, 0, 0, "no shot has a semantic image: \"semantic: FILE\" in some of them would be right");
}

static bool fuse(const struct options *o, struct error *err)
{
    struct scene *scene = NULL;
    struct static_mesh *mesh = NULL;
    struct fusion *fusion = NULL;
    struct catalogue_folders folders = { 0 };
    struct fusion_counts counts;
    uint8_t *label = NULL, (*color)[3] = NULL;
    size_t images, faces = 0;
    bool ok = false;
    if (!catalogue_folders_init(&folders, PKGDATADIR, err) || !scene_read(&scene, o->scene, folders.list, err)) goto out;
    if (!scene->static_.mesh) {
        error_at(err, ERR_INPUT, scene->path, 0, 0, "has no mesh that labels could be fused onto: \"static: {mesh: FILE}\" would be right");
        goto out;
    }
    if (!static_mesh_load(&mesh, scene->static_.mesh, scene->static_.world_from_mesh, err)) goto out;
    if (!static_mesh_index(mesh, scene->static_.detail_m, err) || !fusion_create(&fusion, mesh, err)) goto out;
    if (!fuse_shots(fusion, scene, &images, err)) goto out;
    faces = static_mesh_triangle_count(mesh);
    label = malloc(faces);
    color = calloc(faces, sizeof *color);
    if (!label || !color) {
        error_set(err, ERR_MEMORY, "no memory for the labels of a mesh");
        goto out;
    }
    if (!fusion_decide(fusion, label, &counts, o->fill_m, err)) goto out;
    color_faces(color, label, faces, scene->palette);
    ok = static_mesh_write(o->out, mesh, label, (const uint8_t (*)[3])color, err);
    if (ok)
        printf("staffage: %zu image%s fused: %.1f %% of %zu faces by votes, %.1f %% filled in, %.1f %% unknown\n", images, images == 1 ? "" : "s",
               100.0 * (double)counts.voted / (double)faces, faces, 100.0 * (double)counts.filled / (double)faces,
               100.0 * (double)counts.unknown / (double)faces);
out:
    free(label);
    free(color);
    fusion_destroy(fusion);
    static_mesh_destroy(mesh);
    scene_destroy(scene);
    catalogue_folders_release(&folders);
    return ok;
}

int main(int argc, char **argv)
{
    enum { FILL = 256 };
    static const struct option longs[] = {
        { "output", required_argument, NULL, 'o' }, { "fill", required_argument, NULL, FILL },
        { "help", no_argument, NULL, 'h' },         { "version", no_argument, NULL, 'V' },
        { 0 },
    };
    struct options o = { .fill_m = 2 };
    char *end;
    for (int c; (c = getopt_long(argc, argv, "o:hV", longs, NULL)) != -1;) switch (c) {
        case 'o': o.out = optarg; break;
        case FILL:
            o.fill_m = strtod(optarg, &end);
            if (end == optarg || *end || !(o.fill_m >= 0 && isfinite(o.fill_m))) return usage("--fill takes metres, 0 or more", optarg);
            break;
        case 'h': fputs(help, stdout); return 0;
        case 'V': puts("staffage-fuse " PACKAGE_VERSION); return 0;
        default: return 2;
        }
    if (optind + 1 != argc) return usage("one scene file is needed", NULL);
    if (!o.out) return usage("a file to write is needed: -o SEMANTIC.ply", NULL);
    o.scene = argv[optind];

    struct error err = ERROR_NONE;
    if (!fuse(&o, &err)) error_print(&err, "staffage-fuse");
    return error_exit_status(&err);
}
