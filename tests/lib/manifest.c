#include "lib/file.h"
#include "lib/manifest.h"

#include "tests/tap.h"

#include <unistd.h>

static char path[] = "manifest-test-XXXXXX";

static struct manifest_entity entities[] = {
    { 1, "red \"van\"", CLASS_VAN },
    { 65535, "Menschenmenge \xc3\xbc", CLASS_PERSON },
};

static struct manifest whole_manifest(void)
{
    /* Numbers that no short decimal is: all bits must come back. */
    return (struct manifest){
        .frame = "000123",
        .photograph = "/photographs/a\\b.jpg",
        .width_px = 1000,
        .height_px = 750,
        .key = "0123456789abcdef",
        .camera = { CAMERA_FULL_OPENCV, 1000, 750, { 1.0 / 3, 2.0 / 3, M_PI, -1e-300, 0.1, 1e22, -0.0, 5e-324, 1, 2, 3, 4 } },
        .world_from_camera = { mat3_from_quat((struct quat){ 0.3, -0.5, 0.7, 0.2 }), { 1 / 7.0, -2e6 / 3, 0.1 + 0.2 } },
        .view = { 210, 120, 1 / 9.0, 1.1, -1e5 / 3, 7, mat3_from_quat((struct quat){ 1, 0.1, 0.2, 0 }), { -3, 5, 60, 70 }, false },
        .exposure = { 0.1, 0.2, 1.0 / 3 },
        .exposure_at_px = { 1e3 / 7, -0.1 },
        .exposure_fitted = true,
        .exposure_patch_px = { 10, 20, 30, 40 },
        .exposure_median = { 0.7, 1e-9 / 3, 0 },
        .transfer = "threshold",
        .t1 = 30,
        .t2 = 200.5,
        .t3 = 96,
        .overwrite_below = true,
        .has_shares = true,
        .has_place = true,
        .has_place_labels = true,
        .palette = PALETTE_UAVID,
        .semantic = "/labels/semantic.png",
        .depth = "/labels/depth.exr",
        .shaded = 1 / 7.0,
        .has_mist = true,
        .visibility_m = 1e4 / 3,
        .haze = { 0.7, 0.8, 0.1 + 0.2 },
        .has_motion = true,
        .defocus_px = 1 / 3.0,
        .focus_m = 20.5,
        .softness_px = 0.7,
        .sharpening = 0.4,
        .grain_auto = true,
        .compression_auto = true,
        .vignetting = 0.3,
        .highlights = 0.6, .blacks = 21.5, .blacks_auto = true,
        .seed = 11,
        .entities = entities,
        .entity_count = 2,
    };
}

static bool same_pose(struct pose a, struct pose b) { return memcmp(&a, &b, sizeof a) == 0; }

static bool same_rect(struct rect a, struct rect b) { return memcmp(&a, &b, sizeof a) == 0; }

static bool same(const struct manifest *a, const struct manifest *b)
{
    bool same_entities = a->entity_count == b->entity_count;
    for (size_t i = 0; same_entities && i < a->entity_count; i++)
        same_entities = a->entities[i].id == b->entities[i].id && a->entities[i].class_ == b->entities[i].class_ &&
                        !strcmp(a->entities[i].name, b->entities[i].name);
    return same_entities && !strcmp(a->frame, b->frame) && !strcmp(a->photograph, b->photograph) &&
           a->width_px == b->width_px && a->height_px == b->height_px && !strcmp(a->key, b->key) &&
           a->camera.model == b->camera.model && a->camera.width_px == b->camera.width_px &&
           a->camera.height_px == b->camera.height_px &&
           !memcmp(a->camera.params, b->camera.params, sizeof a->camera.params) &&
           same_pose(a->world_from_camera, b->world_from_camera) && a->empty == b->empty &&
           a->view.width_px == b->view.width_px && a->view.height_px == b->view.height_px &&
           a->view.fx_px == b->view.fx_px && a->view.fy_px == b->view.fy_px && a->view.cx_px == b->view.cx_px &&
           a->view.cy_px == b->view.cy_px &&
           !memcmp(&a->view.view_from_camera, &b->view.view_from_camera, sizeof(struct mat3)) &&
           same_rect(a->view.window_px, b->view.window_px) && a->view.aligned == b->view.aligned &&
           !memcmp(a->exposure, b->exposure, sizeof a->exposure) && a->exposure_fitted == b->exposure_fitted &&
           !memcmp(&a->exposure_at_px, &b->exposure_at_px, sizeof a->exposure_at_px) &&
           a->exposure_samples == b->exposure_samples && same_rect(a->exposure_patch_px, b->exposure_patch_px) &&
           !memcmp(a->exposure_median, b->exposure_median, sizeof a->exposure_median) &&
           !strcmp(a->transfer, b->transfer) && a->t1 == b->t1 && a->t2 == b->t2 && a->t3 == b->t3 &&
           a->overwrite_below == b->overwrite_below && a->mask_dilated == b->mask_dilated &&
           a->has_shares == b->has_shares && a->new_view == b->new_view && a->has_place == b->has_place &&
           a->has_place_labels == b->has_place_labels && a->palette == b->palette && !strcmp(a->semantic, b->semantic) &&
           !strcmp(a->depth, b->depth) && a->shaded == b->shaded && a->has_mist == b->has_mist && a->visibility_m == b->visibility_m &&
           !memcmp(a->haze, b->haze, sizeof a->haze) && a->has_motion == b->has_motion &&
           a->defocus_px == b->defocus_px && a->focus_m == b->focus_m && a->softness_px == b->softness_px &&
           a->softness_auto == b->softness_auto && a->sharpening_auto == b->sharpening_auto && a->sharpening == b->sharpening && a->grain_auto == b->grain_auto && a->grain == b->grain &&
           a->vignetting_auto == b->vignetting_auto && a->vignetting == b->vignetting && a->highlights_auto == b->highlights_auto &&
           a->highlights == b->highlights && a->blacks_auto == b->blacks_auto && a->blacks == b->blacks && a->compression_auto == b->compression_auto && a->seed == b->seed;
}

static void comes_back(struct manifest manifest, const char *what)
{
    struct manifest read;
    struct error err = ERROR_NONE;
    if (!OK(manifest_write(path, &manifest, &err) && manifest_read(&read, path, &err), "%s is written and read", what)) {
        printf("# %s\n", err.text);
        return;
    }
    OK(same(&manifest, &read), "%s comes back to the bit", what);
    manifest_release(&read);
    OK(read.entities == NULL && read.entity_count == 0, "and is released");
}

/* The whole manifest's text with the first `old` in it replaced, as a file, is refused
 * with this error text and the file's name. */
static void refuses(const char *old, const char *new, const char *text, const char *what)
{
    struct manifest manifest = whole_manifest(), read = { .width_px = -7 };
    struct error err = ERROR_NONE;
    char *data = NULL;
    size_t size;
    if (manifest_write(path, &manifest, &err) && file_read(&data, &size, path, &err)) {
        char *at = strstr(data, old);
        char *changed = at ? string_format("%.*s%s%s", (int)(at - data), data, new, at + strlen(old)) : NULL;
        if (!OK(changed && file_write(path, changed, strlen(changed), &err), "%s: the file to refuse", what)) return;
        free(changed);
        free(data);
    }
    bool refused = !manifest_read(&read, path, &err) && err.code == ERR_INPUT && read.width_px == -7;
    if (!OK(refused && !strcmp(err.file, path) && strstr(err.text, text), "refuses %s", what))
        printf("# %d %s: %s\n", err.code, err.file, err.text);
}

static void does_not_write(struct manifest manifest, enum error_code code, const char *text, const char *what)
{
    struct error err = ERROR_NONE;
    if (!OK(!manifest_write(path, &manifest, &err) && err.code == code && strstr(err.text, text), "does not write %s", what))
        printf("# %d %s\n", err.code, err.text);
}

int main(void)
{
    int file = mkstemp(path);
    if (file < 0) return 1;
    close(file);

    struct manifest manifest = whole_manifest();
    comes_back(manifest, "a whole manifest");
    manifest.exposure_patch_px = (struct rect){ 0, 0, 0, 0 };
    manifest.exposure_samples = 1234;
    comes_back(manifest, "an exposure of samples");
    manifest.exposure_fitted = false;
    manifest.exposure_samples = 0;
    memset(manifest.exposure_median, 0, sizeof manifest.exposure_median);
    comes_back(manifest, "a given exposure");
    manifest = whole_manifest();
    manifest.photograph[0] = manifest.semantic[0] = manifest.depth[0] = '\0';
    manifest.new_view = true;
    comes_back(manifest, "a new view");
    manifest = (struct manifest){ .frame = "000000", .photograph = "p.png", .width_px = 1, .height_px = 1,
                                  .key = "ffffffffffffffff", .camera = { CAMERA_SIMPLE_PINHOLE, 2, 2, { 1, 1, 1 } },
                                  .world_from_camera = pose_identity(), .empty = true, .transfer = "layers" };
    comes_back(manifest, "an empty frame");

    char *first = NULL, *second = NULL;
    size_t size;
    struct error err = ERROR_NONE;
    manifest = whole_manifest();
    bool done = manifest_write(path, &manifest, &err) && file_read(&first, &size, path, &err) &&
                manifest_write(path, &manifest, &err) && file_read(&second, &size, path, &err);
    OK(done && !strcmp(first, second) && !strncmp(first, "{\n \"version\": 5,\n \"frame\": \"000123\"", 33),
       "the same manifest is the same bytes, version first");

    refuses("\"version\": 5", "\"version\": 3", "\"version\" is 3, this program reads 5", "another version");
    refuses("\"version\": 5", "\"version\": 5.0", "\"version\" must be a whole number", "a version that is no number of ours");
    refuses("\"version\": 5,", "", "\"version\" is missing", "a file without a version");
    refuses("\"empty\": false,", "", "\"empty\" is missing", "a missing key");
    refuses("\"params\"", "\"parms\"", "\"camera.params\" is missing", "a missing key of an object");
    refuses("\"id\": 65535,", "", "\"entities[1].id\" is missing", "a missing key of an entity");
    refuses("\"t1\"", "\"t0\": 3, \"t1\"", "\"t0\" is no key", "an unknown key");
    refuses("\"aligned\"", "\"alined\": 3, \"aligned\"", "\"view.alined\" is no key", "an unknown key of an object");
    refuses("\"t1\"", "\"t1\": 3, \"t1\"", "duplicate", "a key that is there twice");
    refuses("\"exposure_fitted\": true", "\"exposure_fitted\": 1", "\"exposure_fitted\" must be true or false", "a number for a flag");
    refuses("\"t2\": 200.5", "\"t2\": 256", "\"t2\" must be from 0 to 255, not 256", "a threshold out of range");
    refuses("\"width_px\": 1000", "\"width_px\": 0", "\"width_px\" must be a whole number from 1", "a picture without pixels");
    refuses("\"x0\": -3", "\"x0\": 60", "\"view.window_px\" must hold pixels", "a window without pixels");
    refuses("\"FULL_OPENCV\"", "\"OPENCV\"", "\"camera.params\" must be 8 numbers", "12 parameters for a model of 8");
    refuses("\"FULL_OPENCV\"", "\"PINHLE\"", "\"camera.model\" names no camera model: PINHLE", "an unknown camera model");
    refuses("\"van\"", "\"wan\"", "\"entities[0].class\" names no class: wan", "an unknown class");
    refuses("\"id\": 65535", "\"id\": 1", "\"entities[1].id\" is taken: 1", "an id given twice");
    refuses("\"id\": 1,", "\"id\": 0,", "\"entities[0].id\" must be a whole number from 1 to 65535", "id 0");
    refuses("\"threshold\"", "\"treshold\"", "\"transfer\" has no value treshold", "an unknown transfer");
    refuses("0123456789abcdef", "0123456789ABCDEF", "\"key\" must be 16 hex digits", "a key of other digits");
    refuses("-0.2183", "-0.3183", "\"world_from_camera.rotation\" must be a rotation", "a matrix that bends");
    refuses("/photographs/a\\\\b.jpg", "", "\"photograph\" is empty, and the frame is no new view", "a frame of nothing");
    refuses("\"new_view\": false", "\"new_view\": true", "\"photograph\" must be empty in a new view", "a new view that was taken");
    refuses("\"uavid\"", "\"uavit\"", "\"palette\" names no palette: uavit", "an unknown palette");
    refuses("\"visibility_m\"", "\"visibility\"", "\"visibility_m\" is missing", "a mist of no visibility");
    refuses("\"focus_m\": 20.5", "\"focus_m\": 0", "\"focus_m\" must be more than 0 where there is a defocus", "a focus at the lens");
    refuses("\"exposure_samples\": 0", "\"exposure_samples\": -1", "\"exposure_samples\" must be a whole number from 0", "less than no samples");
    refuses("\"exposure\": [", "\"exposure\": [0, 1, 1], \"not\": [", "\"exposure\" must be above 0", "a picture without light");
    refuses("000123", "0001230001230000", "\"frame\" must be a text of 1 to 15 bytes", "a text that is too long");

    size_t lengths[] = { 0, 1, strlen(first) / 2, strlen(first) - 2 };
    for (size_t i = 0; i < sizeof lengths / sizeof *lengths; i++) {
        struct manifest read = { .width_px = -7 };
        err = ERROR_NONE;
        file_write(path, first, lengths[i], &err);
        OK(!manifest_read(&read, path, &err) && err.code == ERR_INPUT && !strcmp(err.file, path) && err.line > 0 &&
               strstr(err.text, "no frame manifest, or a damaged one") && read.width_px == -7,
           "refuses a file cut after %zu bytes, at the place", lengths[i]);
    }
    free(first);
    free(second);

    struct manifest read;
    err = ERROR_NONE;
    file_write(path, "[1]", 3, &err);
    OK(!manifest_read(&read, path, &err) && err.code == ERR_INPUT, "refuses a list");
    unlink(path);
    err = ERROR_NONE;
    OK(!manifest_read(&read, path, &err) && err.code != ERR_OK, "a file that is not there is told");

    manifest = whole_manifest();
    manifest.exposure[1] = NAN;
    does_not_write(manifest, ERR_BUG, "\"exposure\" must hold finite numbers", "what is no number");
    manifest = whole_manifest();
    manifest.world_from_camera.rotation.m[0][0] = 2;
    does_not_write(manifest, ERR_BUG, "\"world_from_camera.rotation\" must be a rotation", "a matrix that bends");
    manifest = whole_manifest();
    strcpy(manifest.photograph, "caf\xe9.jpg");
    does_not_write(manifest, ERR_INPUT, "\"photograph\" must be UTF-8", "a name in Latin-1");
    OK(!file_exists(path), "nothing is left of what is not written");
    return tap_done();
}
