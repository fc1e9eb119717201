#include "lib/file.h"
#include "lib/image.h"
#include "lib/manifest.h"
#include "post/stats.h"

#include "tests/tap.h"

#include <ftw.h>
#include <jansson.h>
#include <sys/stat.h>
#include <unistd.h>

#define W 40
#define H 25 /* 1000 pixels */

static char out[] = "staffage-stats-XXXXXX";

__attribute__((format(printf, 1, 2)))
static const char *in_out(const char *format, ...)
{
    static char path[512];
    int n = snprintf(path, sizeof path, "%s/", out);
    va_list args;
    va_start(args, format);
    vsnprintf(path + n, sizeof path - (size_t)n, format, args);
    va_end(args);
    return path;
}

static bool save_manifest(const char *frame, const char *semantic, enum palette palette)
{
    struct manifest m = {
        .photograph = "p.png", .width_px = W, .height_px = H, .key = "0123456789abcdef",
        .camera = { .model = CAMERA_PINHOLE, .width_px = W, .height_px = H, .params = { 50, 50, 20, 12 } },
        .world_from_camera = pose_identity(), .empty = true, .transfer = "layers", .palette = palette,
    };
    struct error err = ERROR_NONE;
    snprintf(m.frame, sizeof m.frame, "%s", frame);
    snprintf(m.semantic, sizeof m.semantic, "%s", semantic);
    return folder_make(in_out("frames/%s", frame), &err) && folder_make(in_out("semantic"), &err) &&
           folder_make(in_out("semantic_id"), &err) && folder_make(in_out("labels"), &err) &&
           file_write(in_out("labels/%s.json", frame), "{\"entities\": []}", 16, &err) &&
           manifest_write(in_out("frames/%s/frame.json", frame), &m, &err);
}

/* Road, with the first pixels of other colours. */
struct run { int pixels; uint8_t color[3]; };

static bool save_colors(const char *name, const struct run *runs, size_t n)
{
    static uint8_t pixels[W * H * 3];
    size_t at = 0;
    for (size_t i = 0; i < n; i++)
        for (int k = 0; k < runs[i].pixels; k++) memcpy(pixels + 3 * at++, runs[i].color, 3);
    for (; at < W * H; at++) memcpy(pixels + 3 * at, (uint8_t[]){ 128, 64, 128 }, 3);
    struct image image = { W, H, 3, PIXEL_U8, pixels };
    struct error err = ERROR_NONE;
    return image_write(in_out("%s", name), &image, &err);
}

static bool save_ids(const char *name, int cars, int people)
{
    uint8_t pixels[W * H] = { 0 };
    for (int i = 0; i < cars + people; i++) pixels[i] = i < cars ? 26 : 24;
    struct image image = { W, H, 1, PIXEL_U8, pixels };
    struct error err = ERROR_NONE;
    return image_write(in_out("%s", name), &image, &err);
}

static bool says(char *text, const char *line)
{
    bool found = text && strstr(text, line);
    if (!found) printf("# no \"%s\" in\n# %s\n", line, text ? text : "nothing");
    free(text);
    return found;
}

/* Two frames in UAVid's colours: 3 pixels of moving cars in 2000 become 25, 1 of tree is hidden by a human. */
static void check_before_and_after(void)
{
    struct stats s;
    struct error err = ERROR_NONE;
    save_manifest("000000", "before0.png", PALETTE_UAVID);
    save_manifest("000001", "before1.png", PALETTE_UAVID);
    save_colors("before0.png", (struct run[]){ { 3, { 64, 0, 128 } }, { 10, { 0, 128, 0 } } }, 2);
    save_colors("before1.png", (struct run[]){ { 5, { 9, 9, 9 } } }, 1);
    save_colors("semantic/000000.png", (struct run[]){ { 3, { 64, 0, 128 } }, { 9, { 0, 128, 0 } }, { 1, { 64, 64, 0 } } }, 3);
    save_colors("semantic/000001.png", (struct run[]){ { 5, { 9, 9, 9 } }, { 22, { 64, 0, 128 } } }, 2);
    if (!OK(stats_count(&s, out, &err), "two frames are counted")) return;
    OK(s.has_before && s.frames == 2 && s.pixels == 2000 && s.skipped_count == 0, "all of their pixels");
    OK(s.before[7] == 3 && s.after[7] == 25 && s.before[6] == 0 && s.after[6] == 1 && s.before[4] == 10 && s.after[4] == 9 &&
           s.before[2] == 1982 && s.after[2] == 1960 && s.before[STATS_OTHER] == 5 && s.after[STATS_OTHER] == 5,
       "each under its class, before and after");
    OK(says(stats_table(&s), "\nmoving car                0.150      1.250\n"), "the table has percent, to 3 decimals");
    OK(says(stats_table(&s), "\nhuman                     0.000      0.050\n"), "for all that is there before or after");
    OK(says(stats_table(&s), "\nnot in the palette        0.250      0.250\n"), "and for what the palette lacks");
    OK(says(stats_json(&s), "\"percent_before\": 0.15"), "and so has the JSON");
    stats_release(&s);
}

static void check_missing(void)
{
    struct stats s;
    struct error err = ERROR_NONE;
    save_manifest("000002", "before0.png", PALETTE_UAVID); /* that was never merged */
    save_manifest("000003", "", PALETTE_UAVID);
    save_manifest("000004", "lost.png", PALETTE_UAVID);
    save_manifest("000005", "before0.png", PALETTE_CITYSCAPES);
    if (!OK(stats_count(&s, out, &err) && s.frames == 2 && s.after[7] == 25, "frames that cannot be counted do not keep others from it")) return;
    OK(s.skipped_count == 4, "and are told");
    OK(says(stats_table(&s), "not counted: frame 000002: ") && says(stats_table(&s), "semantic/000002.png: does not exist\n"), "with the picture that is missing");
    OK(says(stats_table(&s), "not counted: frame 000003: has no labels of its own, as other frames have\n"), "or why it has none");
    OK(says(stats_table(&s), "lost.png: does not exist\n"), "before as after");
    OK(says(stats_table(&s), "not counted: frame 000005: is in the palette cityscapes, the frames before it in uavid\n"), "palettes are not mixed");
    OK(says(stats_json(&s), "\"frame\": \"000004\""), "in JSON too");
    stats_release(&s);
}

static void check_put_in(void)
{
    struct stats s;
    struct error err = ERROR_NONE;
    for (int i = 0; i < 6; i++) {
        char frame[16], ids[64];
        snprintf(frame, sizeof frame, "00000%d", i);
        snprintf(ids, sizeof ids, "semantic_id/%s.png", frame);
        save_manifest(frame, "", PALETTE_CITYSCAPES);
        if (i < 2) save_ids(ids, 20 * i + 3, 1);
    }
    if (!OK(stats_count(&s, out, &err) && !s.has_before && s.frames == 2, "photographs without labels")) return;
    OK(says(stats_table(&s), "\nclass                 put in, %\nperson                    0.100\ncar                       1.300\n\n"), "have only what was put in");
    OK(says(stats_table(&s), "only what was put in is counted"), "and the table says so");
    OK(says(stats_json(&s), "\"has_before\": false"), "and the JSON");
    stats_release(&s);

    for (int i = 0; i < 2; i++) unlink(in_out("semantic_id/00000%d.png", i));
    OK(!stats_count(&s, out, &err) && strstr(err.text, "no frame can be counted: does not exist") && strstr(err.file, "000000.png"),
       "no frame at all is an error, at the first");
}

#define OBJECT(class_, in_frame, height, pixels, fraction) \
    "{\"class\": \"" class_ "\", \"in_frame\": " in_frame ", \"box_visible_px\": [1, 2, 3, " height "], " \
    "\"pixels_visible\": " pixels ", \"visible_fraction\": " fraction "}"

static bool save_labels(const char *frame, const char *entities)
{
    struct error err = ERROR_NONE;
    char *text = string_format("{\"version\": 1, \"entities\": [%s]}", entities);
    bool ok = text && file_write(in_out("labels/%s.json", frame), text, strlen(text), &err);
    free(text);
    return ok;
}

/* Frames of three cars and two people: one car is hidden, one person in no frame. */
static void check_objects(void)
{
    struct stats s;
    struct error err = ERROR_NONE;
    save_manifest("000000", "", PALETTE_CITYSCAPES);
    save_manifest("000001", "", PALETTE_CITYSCAPES);
    save_manifest("000002", "", PALETTE_CITYSCAPES);
    for (int i = 0; i < 3; i++) save_ids(i == 0 ? "semantic_id/000000.png" : i == 1 ? "semantic_id/000001.png" : "semantic_id/000002.png", 3, 1);
    save_labels("000000", OBJECT("car", "true", "20", "90", "1") ", " OBJECT("person", "false", "0", "0", "0"));
    save_labels("000001", OBJECT("car", "true", "10", "30", "0.5") ", " OBJECT("car", "true", "0", "0", "0") ", "
                OBJECT("person", "true", "7", "5", "0.25"));
    save_labels("000002", "{\"class\": \"ship\"}");
    if (!OK(stats_count(&s, out, &err) && s.frames == 2, "frames with objects: %s", err.text)) return;
    OK(s.objects[CLASS_CAR].count == 3 && s.objects[CLASS_CAR].visible == 2 && s.objects[CLASS_PERSON].count == 1 &&
           s.objects[CLASS_BUS].count == 0, "each is counted in each frame that it is in, and as visible where it is");
    OK(says(stats_table(&s), "\ncar                           3          2     12.5     15.0     17.5    0.625    0.750    0.875\n"),
       "the table has quartiles of the visible boxes' height and of the fraction that is visible");
    OK(says(stats_table(&s), "\nperson                        1          1      7.0      7.0      7.0    0.250    0.250    0.250\n"), "of one as of many");
    char *text = stats_json(&s);
    json_t *root = text ? json_loads(text, 0, NULL) : NULL, *car = json_array_get(json_object_get(root, "objects"), 1);
    OK(json_integer_value(json_object_get(car, "in_frames")) == 3 && json_integer_value(json_object_get(car, "visible")) == 2 &&
           json_number_value(json_array_get(json_object_get(car, "height_px"), 1)) == 15 &&
           json_number_value(json_array_get(json_object_get(car, "visible_fraction"), 2)) == 0.875, "and so has the JSON");
    json_decref(root);
    free(text);
    OK(says(stats_table(&s), "labels/000002.json: entities[0] is not what staffage writes\n"), "labels that are damaged are told");
    stats_release(&s);
}

static bool refuses(const char *path, const char *right)
{
    struct stats s;
    struct error err = ERROR_NONE;
    return !stats_count(&s, path, &err) && !strcmp(err.file, path) && strstr(err.text, right);
}

/* What lies beside the folder that is meant, or in it. */
static void check_neighbours(void)
{
    struct error err = ERROR_NONE;
    folder_make(in_out("out/mine/rgb"), &err);
    file_write(in_out("out/mine/run.json"), "{}", 2, &err);
    file_write(in_out("mine.yaml"), "", 0, &err);
    if (!OK(chdir(out) == 0, "a folder of scenes")) return;
    OK(refuses("out/mine/rgb", "wrote; out/mine is one"), "a folder in the output: that is named");
    OK(refuses("mine.yaml", "wrote; out/mine is one"), "a scene: its output is named");
    OK(chdir("..") == 0, "and back");
}

static int remove_entry(const char *path, const struct stat *st, int type, struct FTW *ftw)
{
    (void)st, (void)type, (void)ftw;
    return remove(path);
}

int main(void)
{
    struct stats s;
    struct error err = ERROR_NONE;
    if (!mkdtemp(out)) return 1;
    OK(!stats_count(&s, out, &err) && !strcmp(err.file, out) && !strcmp(err.text, "is not a folder that `staffage run` wrote"),
       "a folder without frames is refused");
    check_neighbours();
    check_before_and_after();
    check_missing();
    check_put_in();
    check_objects();
    nftw(out, remove_entry, 16, FTW_DEPTH | FTW_PHYS);
    return tap_done();
}
