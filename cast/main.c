/* Writes our own models: `staffage-cast FOLDER` makes OBJ and MTL files there, in metres, z up,
 * front +x, and people that walk as GLB files. The same numbers give the same bytes on every run. */
#include "cast/glb.h"
#include "cast/mesh.h"
#include "lib/file.h"

#include <stdio.h>

#define COUNT(a) (sizeof(a) / sizeof *(a))

int main(int argc, char **argv)
{
    static const struct palette sedan_colors = { {
        [PAINT] = { 0.55, 0.56, 0.58 }, [GLASS] = { 0.12, 0.13, 0.13 }, [TRIM] = { 0.025, 0.025, 0.027 },
        [UNDERSIDE] = { 0.015, 0.015, 0.015 }, [INTERIOR] = { 0.06, 0.06, 0.062 }, [HEADLIGHT] = { 0.75, 0.77, 0.80 },
        [TAIL_LIGHT] = { 0.45, 0.02, 0.02 }, [PLATE_FRONT] = { 0.8, 0.8, 0.78 }, [PLATE_REAR] = { 0.8, 0.6, 0.08 },
        [RUBBER] = { 0.03, 0.03, 0.03 }, [RIM] = { 0.6, 0.61, 0.62 } } };
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
    bool good = folder_make(argv[1], &err);
    if (good) make_sedan(&model);
    good = good && write_model(&model, argv[1], "sedan", &sedan_colors, &err);
    for (size_t i = 0; good && i < COUNT(people); i++) {
        make_person(&model, NULL, people[i].build, people[i].stance, people[i].build == MAN ? 1.78 : 1.66);
        good = write_model(&model, argv[1], people[i].name, &people[i].palette, &err);
    }
    for (size_t i = 0; good && i < COUNT(walkers); i++) {
        struct skeleton skeleton;
        static struct walk walk;
        make_person(&model, &skeleton, walkers[i].build, READY, walkers[i].build == MAN ? 1.78 : 1.66);
        make_walk(&walk, &skeleton, &model);
        good = write_walker(&model, &skeleton, &walk, argv[1], walkers[i].name, &walkers[i].palette, &err);
    }
    if (!good) error_print(&err, "staffage-cast");
    return error_exit_status(&err);
}
