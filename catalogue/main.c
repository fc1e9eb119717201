/* staffage-models: options in, one call, an exit code out. */
#include "catalogue/add.h"
#include "catalogue/list.h"
#include "gen/model/catalogue.h"
#include "lib/file.h"

#include <getopt.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "Usage: staffage models [--json] [--pictures FOLDER] [--width PX]\n"
    "       staffage models add FILE [option ...]\n"
    "List the models that scenes name by short names, or add one of your own.\n"
    "\n"
    "      --json             list as JSON\n"
    "      --pictures FOLDER  write a picture of each model, a sheet of all and index.html\n"
    "      --width PX         width of a picture (400)\n"
    "\n"
    "Of add; what is left out is found by the model's size and shape, and must be sure:\n"
    "      --name NAME        the short name (the file's)\n"
    "      --class CLASS      what it is: car, van, truck, bus, person ...\n"
    "      --unit METRES      length of one unit of the file\n"
    "      --length METRES    its real length, in place of --unit\n"
    "      --height METRES    its real height, in place of --unit\n"
    "      --up AXIS          which of the file's axes points up: +z, -y ...\n"
    "      --front AXIS       which points forward\n"
    "      --license TEXT     who may use it\n"
    "      --replace          take the place of your own model of that name\n"
    "  -h, --help             this text\n"
    "  -V, --version          the version\n"
    "\n"
    "Exit status: 0 done, 1 wrong input, 2 wrong usage, 3 a bug of ours.\n";

static int usage(const char *what, const char *value)
{
    fprintf(stderr, "staffage-models: %s%s%s (staffage models --help)\n", what, value ? ": " : "", value ? value : "");
    return 2;
}

static bool parse_metres(double *value, const char *text)
{
    char *end;
    *value = strtod(text, &end);
    return end != text && !*end && *value > 0 && *value <= 1000;
}

static const char *data_folder(void)
{
    const char *given = getenv("STAFFAGE_DATADIR");
    return given && *given ? given : PKGDATADIR;
}

static bool list(bool json, const char *pictures, int width_px, const struct catalogue_folders *folders, struct error *err)
{
    struct catalogue *catalogue = NULL;
    if (!catalogue_read(&catalogue, folders->list, err)) return false;
    bool ok = true;
    if (pictures) ok = folder_make(pictures, err) && list_pictures(pictures, catalogue, width_px, err);
    else if (json) ok = list_json(stdout, catalogue, err);
    else list_text(stdout, catalogue);
    if (ok && pictures) printf("pictures of %zu models: %s/index.html, %s/sheet.png\n", catalogue->count, pictures, pictures);
    catalogue_destroy(catalogue);
    return ok;
}

int main(int argc, char **argv)
{
    enum { JSON = 256, PICTURES, WIDTH, ADD, NAME = ADD, CLASS, UNIT, LENGTH, HEIGHT, UP, FRONT, LICENSE, REPLACE };
    static const struct option longs[] = {
        { "json", no_argument, NULL, JSON },         { "pictures", required_argument, NULL, PICTURES },
        { "width", required_argument, NULL, WIDTH }, { "name", required_argument, NULL, NAME },
        { "class", required_argument, NULL, CLASS }, { "unit", required_argument, NULL, UNIT },
        { "length", required_argument, NULL, LENGTH }, { "height", required_argument, NULL, HEIGHT },
        { "up", required_argument, NULL, UP },       { "front", required_argument, NULL, FRONT },
        { "license", required_argument, NULL, LICENSE }, { "replace", no_argument, NULL, REPLACE },
        { "help", no_argument, NULL, 'h' },          { "version", no_argument, NULL, 'V' },
        { 0 },
    };
    struct add_options add = { .width_px = 400 };
    struct known *known = &add.known;
    const char *pictures = NULL;
    bool json = false, of_add = false;
    char *end;
    long width;
    for (int c; (c = getopt_long(argc, argv, "hV", longs, NULL)) != -1;) {
        of_add = of_add || c >= ADD;
        switch (c) {
        case JSON: json = true; break;
        case PICTURES: pictures = optarg; break;
        case WIDTH:
            width = strtol(optarg, &end, 10);
            if (end == optarg || *end || width < 32 || width > 4096) return usage("--width takes pixels from 32 to 4096", optarg);
            add.width_px = (int)width / 4 * 4;
            break;
        case NAME: add.name = optarg; break;
        case CLASS:
            if (!class_from_name(&known->class_, optarg)) return usage("--class takes car, van, truck, bus, person or another class", optarg);
            known->has_class = true;
            break;
        case UNIT:
            if (!parse_metres(&known->unit_m, optarg)) return usage("--unit takes metres above 0 up to 1000", optarg);
            break;
        case LENGTH:
            if (!parse_metres(&known->length_m, optarg)) return usage("--length takes metres above 0 up to 1000", optarg);
            break;
        case HEIGHT:
            if (!parse_metres(&known->height_m, optarg)) return usage("--height takes metres above 0 up to 1000", optarg);
            break;
        case UP:
            known->has_up = true;
            if (!axis_from_name(&known->up, optarg)) return usage("--up takes +x, -x, +y, -y, +z or -z", optarg);
            break;
        case FRONT:
            known->has_front = true;
            if (!axis_from_name(&known->front, optarg)) return usage("--front takes +x, -x, +y, -y, +z or -z", optarg);
            break;
        case LICENSE: add.license = optarg; break;
        case REPLACE: add.replace = true; break;
        case 'h': fputs(help, stdout); return 0;
        case 'V': puts("staffage-models " PACKAGE_VERSION); return 0;
        default: return 2;
        }
    }
    bool adds = optind < argc && !strcmp(argv[optind], "add");
    if (!adds && optind < argc) return usage("there is nothing but \"add\" to do beside listing", argv[optind]);
    if (adds && optind + 2 != argc) return usage("add takes one file", NULL);
    if (!adds && of_add) return usage("this option is one of add's: staffage models add FILE", NULL);
    if (adds && (json || pictures)) return usage("--json and --pictures list, and add does not", NULL);
    if ((known->unit_m > 0) + (known->length_m > 0) + (known->height_m > 0) > 1) return usage("--unit, --length and --height: one of them", NULL);
    if (known->has_up && known->has_front && known->up / 2 == known->front / 2) return usage("--up and --front lie on one axis", NULL);

    struct error err = ERROR_NONE;
    struct catalogue_folders folders = { 0 };
    bool ok = catalogue_folders_init(&folders, PKGDATADIR, &err);
    char *rules = string_format("%s/templates/materials.rules", data_folder());
    if (ok && !rules) ok = error_set(&err, ERR_MEMORY, "no memory for a path");
    if (ok && adds) {
        add.file = argv[optind + 1];
        add.folder = folders.user;
        add.rules = rules;
        ok = add_model(&add, &err);
    } else if (ok)
        ok = list(json, pictures, add.width_px, &folders, &err);
    if (!ok) error_print(&err, "staffage-models");
    free(rules);
    catalogue_folders_release(&folders);
    return error_exit_status(&err);
}
