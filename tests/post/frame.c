/* The whole of staffage-post, run as users run it, on a frame folder made here. */
#include "lib/file.h"
#include "lib/image.h"
#include "lib/manifest.h"

#include "tests/tap.h"

#include <fcntl.h>
#include <ftw.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#define W 64
#define H 48
static const struct rect window = { 16, 8, 48, 40 }; /* 32 x 32 pixels */

static char out[] = "staffage-frame-XXXXXX";
static char said[4096]; /* what the last run wrote to stdout and stderr */

/* A path in the output folder, in static storage. */
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

/* Returns the exit status; the last argument is NULL. */
static int run(const char *const *arguments)
{
    char program[512], log[512];
    const char *top = getenv("top_builddir"), *argv[8] = { program };
    snprintf(program, sizeof program, "%s/staffage-post", top ? top : ".");
    snprintf(log, sizeof log, "%s.log", out);
    for (int i = 0; i < 6 && arguments[i]; i++) argv[i + 1] = arguments[i];
    fflush(stdout);
    pid_t pid = fork();
    if (pid == 0) {
        int fd = open(log, O_WRONLY | O_CREAT | O_TRUNC, 0666);
        dup2(fd, 1);
        dup2(fd, 2);
        execv(program, (char *const *)argv);
        _exit(127);
    }
    int status = 0;
    waitpid(pid, &status, 0);
    char *text = NULL;
    size_t size = 0;
    struct error err = ERROR_NONE;
    if (file_read(&text, &size, log, &err)) snprintf(said, sizeof said, "%s", text);
    free(text);
    unlink(log);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

static int post(const char *frame)
{
    return run((const char *const[]){ out, "--frame", frame, NULL });
}

static bool save(const char *name, const struct image *image)
{
    struct error err = ERROR_NONE;
    bool ok = image_write(in_out("%s", name), image, &err);
    if (!ok) error_print(&err, "frame.test");
    return ok;
}

static bool save_text(const char *name, const char *text)
{
    struct error err = ERROR_NONE;
    return file_write(in_out("%s", name), text, strlen(text), &err);
}

/* Every level of every channel is in the photograph; (20, 20) is ground of level 137 = 0.25016. */
static uint8_t photograph[W * H * 3];
static float object[32 * 32 * 4], plane[32 * 32 * 4], shadow[32 * 32 * 4], depth[W * H];
static uint16_t ids[W * H];
static uint8_t hidden[W * H];

static float *layer_at(float *layer, int x, int y)
{
    return layer + ((y - window.y0) * 32 + x - window.x0) * 4;
}

static void set(float *pixel, float color, float alpha)
{
    pixel[0] = pixel[1] = pixel[2] = color;
    pixel[3] = alpha;
}

static void paint(void)
{
    for (int i = 0; i < W * H; i++) {
        for (int c = 0; c < 3; c++) photograph[3 * i + c] = (uint8_t)(i + 85 * c);
        depth[i] = NAN;
        hidden[i] = 255;
    }
    for (int i = 0; i < 32 * 32; i++) {
        set(plane + 4 * i, 0.1f, 1);
        set(shadow + 4 * i, 0.1f, 1);
    }
    for (int x = 20; x < 24; x++) memset(photograph + 3 * (20 * W + x), 137, 3);
    set(layer_at(shadow, 20, 20), 0.05f, 1);    /* half shadow */
    set(layer_at(object, 21, 20), 0.2f, 1);     /* entity */
    set(layer_at(object, 22, 20), 0.1f, 0.5f);  /* its edge */
    set(layer_at(object, 23, 20), 0.2f, 1);     /* hidden by the occluder */
    ids[20 * W + 21] = 1;
    depth[20 * W + 21] = 12.5f;
    hidden[20 * W + 23] = 0;
}

static struct manifest_entity entities[] = { { 1, "taxi", CLASS_CAR } };

static struct manifest manifest_of(const char *frame)
{
    struct manifest m = {
        .photograph = "photograph.png", .width_px = W, .height_px = H, .key = "0123456789abcdef",
        .camera = { .model = CAMERA_PINHOLE, .width_px = W, .height_px = H, .params = { 50, 50, 32, 24 } },
        .world_from_camera = pose_identity(),
        .view = { .width_px = 32, .height_px = 32, .fx_px = 50, .fy_px = 50, .cx_px = 16, .cy_px = 16,
                  .view_from_camera = mat3_identity(), .window_px = window, .aligned = true },
        .exposure = { 2, 2, 2 },
        .transfer = "layers", .t1 = 30, .t2 = 200, .t3 = 96, .has_shares = true,
        .entities = entities, .entity_count = 1,
    };
    snprintf(m.frame, sizeof m.frame, "%s", frame);
    return m;
}

static bool save_manifest(const char *frame, const struct manifest *m)
{
    struct error err = ERROR_NONE;
    bool ok = folder_make(in_out("frames/%s/amodal", frame), &err) &&
              manifest_write(in_out("frames/%s/frame.json", frame), m, &err);
    if (!ok) error_print(&err, "frame.test");
    return ok;
}

static bool save_layer(const char *frame, const char *name, int width, int height, int channels, enum pixel_type type, void *data)
{
    char path[128];
    struct image image = { width, height, channels, type, data };
    snprintf(path, sizeof path, "frames/%s/%s", frame, name);
    return save(path, &image);
}

static bool save_frame(const char *frame)
{
    struct manifest m = manifest_of(frame);
    char labels[64], amodal[64], mask[64];
    snprintf(labels, sizeof labels, "frames/%s/labels.json", frame);
    snprintf(amodal, sizeof amodal, "frames/%s/amodal.json", frame);
    snprintf(mask, sizeof mask, "frames/%s/amodal/000001.bin", frame);
    return save_manifest(frame, &m) && save_layer(frame, "object.exr", 32, 32, 4, PIXEL_F32, object) &&
           save_layer(frame, "plane.exr", 32, 32, 4, PIXEL_F32, plane) &&
           save_layer(frame, "shadow.exr", 32, 32, 4, PIXEL_F32, shadow) &&
           save_layer(frame, "instance.png", W, H, 1, PIXEL_U16, ids) &&
           save_layer(frame, "depth.exr", W, H, 1, PIXEL_F32, depth) &&
           save_layer(frame, "visible.png", W, H, 1, PIXEL_U8, hidden) &&
           save_layer(frame, "receiver.png", W, H, 1, PIXEL_U8, hidden) && save_text(labels, "{\"labels\": true}\n") &&
           save_text(amodal, "{\"amodal\": true}\n") && save_text(mask, "mask");
}

static bool has_text(const char *path, const char *text)
{
    struct error err = ERROR_NONE;
    char *data;
    size_t size;
    if (!file_read(&data, &size, path, &err)) return false;
    bool same = !strcmp(data, text);
    free(data);
    return same;
}

static void check_pictures(void)
{
    struct image rgb, instance, semantic, mm, exr;
    struct error err = ERROR_NONE;
    if (!OK(post("000001") == 0, "a frame is done: %s", said)) return;
    if (!OK(image_read(&rgb, in_out("rgb/000001.png"), &err), "rgb is written")) return;
    int changed = 0;
    for (int i = 0; i < W * H; i++)
        if (i < 20 * W + 20 || i > 20 * W + 22) changed += memcmp((uint8_t *)rgb.data + 3 * i, photograph + 3 * i, 3) != 0;
    NEAR(changed, 0, 0, "every pixel that nothing touches keeps every bit, at all 256 levels");
    /* sRGB of 0.12508, 0.4 and 0.32508 is 99.1, 169.6 and 154.4 */
    NEAR(image_u8(&rgb, 20, 20)[0], 99, 0, "shadow: 0.25016 * 0.05/0.1 = 0.12508");
    NEAR(image_u8(&rgb, 21, 20)[1], 170, 0, "entity: 2 * 0.2");
    NEAR(image_u8(&rgb, 22, 20)[2], 154, 0, "its edge: 0.25016 * (1 - 0.5) + 2 * 0.1");
    OK(image_u8(&rgb, 23, 20)[0] == 137, "behind the occluder nothing shows");
    image_release(&rgb);

    if (!OK(image_read(&instance, in_out("instance/000001.png"), &err) && instance.type == PIXEL_U16, "instance is 16 bit")) return;
    OK(*image_u16(&instance, 21, 20) == 1 && *image_u16(&instance, 22, 20) == 0, "and has the traced ids");
    image_release(&instance);
    if (!OK(image_read(&semantic, in_out("semantic/000001.png"), &err) && semantic.channels == 3, "semantic is in colours")) return;
    OK(image_u8(&semantic, 21, 20)[2] == 142 && image_u8(&semantic, 22, 20)[2] == 0, "a car's is 0,0,142");
    image_release(&semantic);
    if (!OK(image_read(&semantic, in_out("semantic_id/000001.png"), &err) && semantic.channels == 1, "semantic_id has ids")) return;
    OK(*image_u8(&semantic, 21, 20) == 26, "a car's is 26");
    image_release(&semantic);
    if (!OK(image_read(&mm, in_out("depth/000001.png"), &err) && mm.type == PIXEL_U16, "depth is 16 bit")) return;
    OK(*image_u16(&mm, 21, 20) == 12500 && *image_u16(&mm, 20, 20) == 0, "in millimetres");
    image_release(&mm);
    if (!OK(image_read(&exr, in_out("depth/000001.exr"), &err), "and float")) return;
    OK(*image_f32(&exr, 21, 20) == 12.5f && isnan(*image_f32(&exr, 20, 20)), "in metres");
    image_release(&exr);
    OK(has_text(in_out("labels/000001.json"), "{\"labels\": true}\n"), "labels are handed on");
    OK(has_text(in_out("amodal/000001.json"), "{\"amodal\": true}\n"), "amodal masks too");
    OK(has_text(in_out("amodal/000001/000001.bin"), "mask"), "and each entity's layer");
    save_text("amodal/000001/000009.bin", "of an entity that is there no more");
    OK(post("000001") == 0 && !file_exists(in_out("amodal/000001/000009.bin")), "what an earlier run left is gone");
    OK(file_exists(in_out("amodal/000001/000001.bin")), "and nothing else");
}

static void check_options(void)
{
    OK(run((const char *const[]){ "--help", NULL }) == 0 && strstr(said, "--frame"), "--help tells the options");
    OK(run((const char *const[]){ "--version", NULL }) == 0 && strstr(said, "staffage-post " PACKAGE_VERSION), "--version tells the version");
    OK(run((const char *const[]){ NULL }) == 2 && strstr(said, "no output folder"), "no folder is wrong usage");
    OK(run((const char *const[]){ out, "--fast", NULL }) == 2 && strstr(said, "--fast"), "an unknown option is named");
    OK(run((const char *const[]){ out, "--frame", "../x", NULL }) == 2 && strstr(said, "../x"), "a frame is a number");
    OK(run((const char *const[]){ out, "elsewhere", NULL }) == 2 && strstr(said, "elsewhere"), "there is one folder");
    OK(run((const char *const[]){ "/nowhere", NULL }) == 1 && strstr(said, "/nowhere: is not a folder that `staffage run` wrote"), "a folder that is not there is named");
}

/* The frame fails, the file is named with what is wrong, and no picture pretends to be whole. */
static void fails(const char *frame, const char *file, const char *text)
{
    char place[512];
    snprintf(place, sizeof place, "%s: %s", in_out("%s", file), text);
    int status = post(frame);
    OK(status == 1 && strstr(said, place), "exit 1 with \"%s\"", text);
    if (!strstr(said, place)) printf("# %d: %s# wanted %s\n", status, said, place);
    OK(!file_exists(in_out("rgb/%s.png", frame)), "and no picture");
}

static void check_faults(void)
{
    const char *f = "000002";
    if (!OK(save_frame(f), "a second frame is made")) return;
    unlink(in_out("frames/%s/plane.exr", f));
    fails(f, "frames/000002/plane.exr", "does not exist");
    save_layer(f, "plane.exr", 16, 32, 4, PIXEL_F32, plane);
    fails(f, "frames/000002/plane.exr", "is 16 x 32 pixels: 32 x 32 would be right");
    save_layer(f, "plane.exr", 32, 32, 4, PIXEL_F32, plane);
    OK(truncate(in_out("frames/%s/shadow.exr", f), 500) == 0, "a pass is cut off");
    fails(f, "frames/000002/shadow.exr", "is not an image that can be read");
    save_layer(f, "shadow.exr", 32, 32, 4, PIXEL_F32, shadow);
    save_layer(f, "depth.exr", 32, 32, 1, PIXEL_F32, depth);
    fails(f, "frames/000002/depth.exr", "is 32 x 32 pixels: 64 x 48 would be right");
    save_layer(f, "depth.exr", W, H, 1, PIXEL_F32, depth);
    ids[0] = 77;
    save_layer(f, "instance.png", W, H, 1, PIXEL_U16, ids);
    ids[0] = 0;
    fails(f, "frames/000002/instance.png", "pixel 0,0 has id 77, which no entity of the frame has");
    save_layer(f, "instance.png", W, H, 1, PIXEL_U16, ids);
    unlink(in_out("frames/%s/labels.json", f));
    fails(f, "frames/000002/labels.json", "cannot be opened");
    save_text("frames/000002/labels.json", "{}");

    struct manifest m = manifest_of(f);
    snprintf(m.photograph, sizeof m.photograph, "lost.png");
    save_manifest(f, &m);
    fails(f, "lost.png", "does not exist");
    m = manifest_of("000003");
    save_manifest(f, &m);
    fails(f, "frames/000002/frame.json", "is of frame \"000003\": \"000002\" would be right");
    m = manifest_of(f);
    m.view.window_px.x1 = 100;
    m.view.window_px.x0 = 68;
    save_manifest(f, &m);
    fails(f, "frames/000002/frame.json", "the view's window lies outside the picture");

    /* A folder that cannot be written in: its name is taken by a file. */
    m = manifest_of(f);
    save_manifest(f, &m);
    char kept[512];
    snprintf(kept, sizeof kept, "%s.kept", in_out("semantic"));
    rename(in_out("semantic"), kept);
    save_text("semantic", "in the way");
    fails(f, "semantic", "is not a folder");
    unlink(in_out("semantic"));
    rename(kept, in_out("semantic"));

    unlink(in_out("rgb/000001.png"));
    unlink(in_out("frames/%s/object.exr", f));
    OK(run((const char *const[]){ out, NULL }) == 1 && strstr(said, "object.exr"), "all frames are tried when none is named");
    OK(file_exists(in_out("rgb/000001.png")), "and one that fails does not stop the others");
}

static void check_unchanged(void)
{
    const char *f = "000002";
    struct manifest m = manifest_of(f);
    m.empty = true;
    m.has_shares = false;
    save_manifest(f, &m);
    struct image rgb;
    struct error err = ERROR_NONE;
    if (!OK(post(f) == 0 && image_read(&rgb, in_out("rgb/000002.png"), &err), "an empty frame needs no passes")) return;
    OK(!memcmp(rgb.data, photograph, sizeof photograph), "and is the photograph");
    image_release(&rgb);
}

static void check_transfers(void)
{
    /* The pixel at (22, 20) is O = 0.1, alpha 0.5, over 0.25016; k = 2. */
    const struct { const char *name; bool dilated; double want; const char *why; } rows[] = {
        { "alpha", false, 154, "alpha: 0.25016 * (1 - 0.5) + 2 * 0.1, as sRGB" },
        { "threshold", false, 154, "threshold: 127.5 is above T1, and no entity's mask: as alpha" },
        { "threshold", true, 170, "threshold with the dilated mask: a car, overwritten by 2 * 0.1 / 0.5" },
    };
    const char *f = "000001";
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct manifest m = manifest_of(f);
        snprintf(m.transfer, sizeof m.transfer, "%s", rows[i].name);
        m.mask_dilated = rows[i].dilated;
        m.t2 = 100;
        struct image rgb, instance;
        struct error err = ERROR_NONE;
        save_manifest(f, &m);
        if (!OK(post(f) == 0 && image_read(&rgb, in_out("rgb/%s.png", f), &err), "transfer by %s", rows[i].name)) continue;
        NEAR(image_u8(&rgb, 22, 20)[0], rows[i].want, 0, "%s", rows[i].why);
        image_release(&rgb);
        if (!image_read(&instance, in_out("instance/%s.png", f), &err)) continue;
        NEAR(*image_u16(&instance, 22, 20), rows[i].dilated, 0, "the mask is %s", rows[i].dilated ? "dilated" : "as traced");
        image_release(&instance);
    }
    struct manifest m = manifest_of(f);
    snprintf(m.transfer, sizeof m.transfer, "ratio");
    save_manifest(f, &m);
    struct image rgb;
    struct error err = ERROR_NONE;
    if (!OK(post(f) == 0 && image_read(&rgb, in_out("rgb/%s.png", f), &err), "transfer by ratio")) return;
    NEAR(image_u8(&rgb, 20, 20)[0], 99, 0, "ratio: 0.25016 * 0.05/0.1, as sRGB");
    image_release(&rgb);
}

/* The camera's hand, through the whole program: measured where it is asked for, and only where something changes. */
static void check_hand(const char *f)
{
    struct manifest m = manifest_of(f);
    struct image plain, grainy, again;
    struct error err = ERROR_NONE;
    save_manifest(f, &m);
    OK(post(f) == 0 && image_read(&plain, in_out("rgb/%s.png", f), &err) && file_exists(in_out("frames/%s/camera.json", f)),
       "what the camera did is written: %s", said);
    m.grain = 12;
    m.vignetting = 0.2;
    m.highlights = 0.7;
    m.softness_auto = m.compression_auto = true; /* of a PNG as small as this: nothing */
    m.seed = 3;
    save_manifest(f, &m);
    if (!OK(post(f) == 0 && image_read(&grainy, in_out("rgb/%s.png", f), &err), "grain is given: %s", said)) return;
    int entity = 0, elsewhere = 0;
    for (int i = 0; i < W * H; i++) {
        bool same = !memcmp((uint8_t *)plain.data + 3 * i, (uint8_t *)grainy.data + 3 * i, 3);
        if (i / W == 20 && (i % W == 21 || i % W == 22)) entity += !same;
        else elsewhere += !same;
    }
    NEAR(entity, 2, 0, "the entity and its edge change");
    NEAR(elsewhere, 0, 0, "and nothing else");
    OK(post(f) == 0 && image_read(&again, in_out("rgb/%s.png", f), &err), "once more");
    OK(!memcmp(grainy.data, again.data, image_size(&again)), "the same grain comes out");
    image_release(&again);
    m.seed = 4;
    save_manifest(f, &m);
    OK(post(f) == 0 && image_read(&again, in_out("rgb/%s.png", f), &err), "with another seed");
    OK(memcmp(grainy.data, again.data, image_size(&again)) != 0, "other grain");
    image_release(&again);
    image_release(&grainy);
    image_release(&plain);
}

/* Own labels, a view that nobody took, mist and lens, through the whole program. */
static void check_flight(void)
{
    const char *f = "000001";
    struct manifest m = manifest_of(f);
    struct image got, before;
    struct error err = ERROR_NONE;
    static uint8_t colors[W * H * 3];
    static float place[W * H], moved[W * H * 3];
    for (int i = 0; i < W * H; i++) {
        memcpy(colors + 3 * i, i % 5 ? (uint8_t[]){ 128, 64, 128 } : (uint8_t[]){ 1, 2, 3 }, 3);
        place[i] = 20 + (float)i / 3;
    }
    struct image image = { W, H, 3, PIXEL_U8, colors };
    save("colors.png", &image);
    save_layer(f, "place_depth.exr", W, H, 1, PIXEL_F32, place);
    m.palette = PALETTE_UAVID;
    m.has_place = true;
    snprintf(m.semantic, sizeof m.semantic, "colors.png");
    save_manifest(f, &m);
    if (!OK(post(f) == 0 && image_read(&got, in_out("semantic/%s.png", f), &err), "a frame with labels of its own: %s", said)) return;
    const size_t at = 20 * W + 21;
    OK(!memcmp(got.data, colors, 3 * at) && !memcmp((uint8_t *)got.data + 3 * at + 3, colors + 3 * at + 3, sizeof colors - 3 * at - 3),
       "keeps them bit for bit");
    OK(!memcmp((uint8_t *)got.data + 3 * at, (uint8_t[]){ 64, 0, 128 }, 3), "but for the entity's pixel, a moving car");
    image_release(&got);
    if (!OK(image_read(&got, in_out("semantic_id/%s.png", f), &err), "as ids")) return;
    OK(*image_u8(&got, 21, 20) == 7 && *image_u8(&got, 22, 20) == 2 && *image_u8(&got, 0, 0) == 0, "by the palette");
    image_release(&got);
    if (!OK(image_read(&got, in_out("depth/%s.exr", f), &err), "depth")) return;
    OK(*image_f32(&got, 21, 20) == 12.5f && !memcmp(got.data, place, 4 * at), "is the place's round the entity's");
    image_release(&got);

    /* Mist: the entity's 2 * 0.2 at 12.5 m, on a ray (21.5 - 32, 20.5 - 24) / 50 aside: 12.813 m;
     * T = 0.05^(12.813 / 12.813) and A = 0.25016: 0.4 T + A (1 - T) = 0.25765, as sRGB 138.9 */
    m.has_mist = true;
    m.visibility_m = 12.813;
    for (int c = 0; c < 3; c++) m.haze[c] = 0.25016;
    save_manifest(f, &m);
    if (!OK(post(f) == 0 && image_read(&got, in_out("rgb/%s.png", f), &err), "in mist: %s", said)) return;
    NEAR(image_u8(&got, 21, 20)[1], 139, 0, "an entity at the visibility keeps a twentieth of its contrast");
    image_release(&got);
    m.has_mist = false;

    for (int i = 0; i < W * H; i++) moved[3 * i] = 2;
    m.has_motion = true;
    m.defocus_px = 3;
    m.focus_m = 100;
    m.softness_px = 0.5;
    save_manifest(f, &m);
    image_read(&before, in_out("instance/%s.png", f), &err);
    OK(post(f) == 1 && strstr(said, "motion.exr: does not exist"), "motion must be told");
    save_layer(f, "motion.exr", W, H, 3, PIXEL_F32, moved);
    if (!OK(post(f) == 0 && image_read(&got, in_out("rgb/%s.png", f), &err), "moving and out of focus: %s", said)) return;
    int changed = 0, outside = 0;
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++) {
            if (!memcmp(image_u8(&got, x, y), photograph + 3 * (y * W + x), 3)) continue;
            changed++;
            outside += x < window.x0 || x >= window.x1 || y < window.y0 || y >= window.y1;
        }
    OK(changed > 20 && outside == 0, "changes what is round the entity, and only there");
    image_release(&got);
    if (!OK(image_read(&got, in_out("instance/%s.png", f), &err), "labels")) return;
    OK(!memcmp(got.data, before.data, image_size(&got)), "are not blurred");
    image_release(&got);
    image_release(&before);

    check_hand(f);

    m = manifest_of(f);
    m.new_view = true;
    m.empty = true;
    m.has_shares = false;
    m.photograph[0] = '\0';
    save_manifest(f, &m);
    save_layer(f, "background.png", W, H, 3, PIXEL_U8, colors);
    if (!OK(post(f) == 0 && image_read(&got, in_out("rgb/%s.png", f), &err), "a view that nobody took: %s", said)) return;
    OK(!memcmp(got.data, colors, sizeof colors), "is its background");
    image_release(&got);
}

static int remove_entry(const char *path, const struct stat *st, int type, struct FTW *ftw)
{
    (void)st, (void)type, (void)ftw;
    return remove(path);
}

int main(void)
{
    if (!mkdtemp(out)) return 1;
    paint();
    struct image image = { W, H, 3, PIXEL_U8, photograph };
    if (OK(save("photograph.png", &image) && save_frame("000001"), "a frame is made")) {
        check_pictures();
        check_options();
        check_faults();
        check_unchanged();
        check_transfers();
        check_flight();
    }
    nftw(out, remove_entry, 16, FTW_DEPTH | FTW_PHYS);
    return tap_done();
}
