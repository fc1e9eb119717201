/* Writes our own models: `staffage-cast FOLDER` makes OBJ and MTL files there, in metres, z up,
 * front +x, and people that walk as GLB files. The same numbers give the same bytes on every run. */
#include "cast/figure.h"
#include "cast/fleet.h"
#include "cast/glb.h"
#include "cast/listing.h"
#include "cast/mesh.h"
#include "lib/file.h"

#include <math.h>
#include <stdio.h>

#define COUNT(a) (sizeof(a) / sizeof *(a))

/* What can be told from a model before it is written: NAME.obj in metres, z up, front +x, or NAME.glb. */
static bool list_model(struct listing *listing, const struct model *model, const char *name, bool moves, struct error *err)
{
    static const char *const walk[] = { "walk", NULL };
    struct vec3 low = model->triangles[0].p[0], high = low;
    char file[64];
    for (size_t i = 0; i < model->count; i++)
        for (int k = 0; k < 3; k++) {
            struct vec3 p = model->triangles[i].p[k];
            low = vec3(fmin(low.x, p.x), fmin(low.y, p.y), fmin(low.z, p.z));
            high = vec3(fmax(high.x, p.x), fmax(high.y, p.y), fmax(high.z, p.z));
        }
    snprintf(file, sizeof file, "%s.%s", name, moves ? "glb" : "obj");
    struct listed listed = { .name = name, .class_ = "person", .kind = "person", .file = file,
                             .length_m = high.x - low.x, .width_m = high.y - low.y, .height_m = high.z - low.z,
                             .triangles = { model->count }, .animations = moves ? walk : NULL };
    if (!moves) {
        listed.unit_m = 1;
        listed.up = "+z";
        listed.front = "+x";
    }
    return listing_add(listing, &listed, err);
}

int main(int argc, char **argv)
{
    static const struct { const char *name; enum build build; enum stance stance; struct palette palette; } people[] = {
        { "man-walking", MAN, WALKING, { { [SKIN] = { 0.80, 0.57, 0.46 }, [HAIR] = { 0.05, 0.04, 0.03 },
            [JACKET] = { 0.12, 0.14, 0.18 }, [TROUSERS] = { 0.13, 0.12, 0.11 }, [SHOES] = { 0.05, 0.04, 0.04 } } } },
        { "man-standing", MAN, STANDING, { { [SKIN] = { 0.74, 0.52, 0.41 }, [HAIR] = { 0.10, 0.07, 0.05 },
            [JACKET] = { 0.20, 0.17, 0.12 }, [TROUSERS] = { 0.06, 0.06, 0.07 }, [SHOES] = { 0.06, 0.04, 0.03 } } } },
        { "woman-walking", WOMAN, WALKING, { { [SKIN] = { 0.86, 0.64, 0.53 }, [HAIR] = { 0.13, 0.07, 0.04 },
            [JACKET] = { 0.36, 0.07, 0.08 }, [TROUSERS] = { 0.05, 0.05, 0.06 }, [SHOES] = { 0.04, 0.03, 0.03 } } } },
        { "woman-standing", WOMAN, STANDING, { { [SKIN] = { 0.82, 0.60, 0.49 }, [HAIR] = { 0.35, 0.24, 0.12 },
            [JACKET] = { 0.45, 0.42, 0.38 }, [TROUSERS] = { 0.09, 0.12, 0.20 }, [SHOES] = { 0.15, 0.10, 0.07 } } } }
    };
    static const struct { const char *name; enum build build; struct palette palette; } walkers[] = {
        { "walker-man", MAN, { { [SKIN] = { 0.78, 0.56, 0.45 }, [HAIR] = { 0.14, 0.09, 0.06 },
            [JACKET] = { 0.16, 0.25, 0.36 }, [TROUSERS] = { 0.30, 0.27, 0.22 }, [SHOES] = { 0.09, 0.06, 0.05 } } } },
        { "walker-woman", WOMAN, { { [SKIN] = { 0.84, 0.62, 0.51 }, [HAIR] = { 0.30, 0.18, 0.09 },
            [JACKET] = { 0.55, 0.13, 0.11 }, [TROUSERS] = { 0.10, 0.12, 0.19 }, [SHOES] = { 0.07, 0.06, 0.06 } } } }
    };

    if (argc != 2) {
        fprintf(stderr, "usage: staffage-cast FOLDER\n");
        return 2;
    }
    struct error err = ERROR_NONE;
    struct model model = { 0 };
    struct listing listing = { 0 };
    bool good = folder_make(argv[1], &err);
    good = good && write_fleet(&listing, argv[1], &err);
    for (size_t i = 0; good && i < COUNT(people); i++) {
        make_person(&model, NULL, people[i].build, people[i].stance, people[i].build == MAN ? 1.78 : 1.66);
        good = list_model(&listing, &model, people[i].name, false, &err) && write_model(&model, argv[1], people[i].name, &people[i].palette, &err);
    }
    for (size_t i = 0; good && i < COUNT(walkers); i++) {
        struct skeleton skeleton;
        static struct walk walk;
        make_person(&model, &skeleton, walkers[i].build, READY, walkers[i].build == MAN ? 1.78 : 1.66);
        make_walk(&walk, &skeleton, &model);
        good = list_model(&listing, &model, walkers[i].name, true, &err) &&
               write_walker(&model, &skeleton, &walk, argv[1], walkers[i].name, &walkers[i].palette, &err);
    }
    good = good && write_people(&listing, argv[1], &err);
    good = good && listing_write(&listing, argv[1], &err);
    if (!good) error_print(&err, "staffage-cast");
    return error_exit_status(&err);
}
