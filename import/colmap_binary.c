#include "import/colmap_records.h"

#include "lib/file.h"

#include <endian.h>
#include <stdlib.h>
#include <string.h>

/* A file in memory, read from front to back. */
struct bytes {
    const struct colmap_records *records;
    const char *file;
    char *data;
    size_t size, at;
    const char *item;  /* what is being read: "image" */
    uint64_t index, count;
    struct error *err;
};

static size_t left(const struct bytes *b) { return b->size - b->at; }

static bool ends(const struct bytes *b)
{
    colmap_fault(b->records, b->file, b->size, b->err, "the file ends in %s %llu of %llu: it is cut off", b->item,
                 (unsigned long long)b->index + 1, (unsigned long long)b->count);
    return false;
}

static bool u64(struct bytes *b, uint64_t *value)
{
    if (left(b) < sizeof *value) return ends(b);
    memcpy(value, b->data + b->at, sizeof *value);
    *value = le64toh(*value);
    b->at += sizeof *value;
    return true;
}

static bool u32(struct bytes *b, uint64_t *value)
{
    uint32_t v;
    if (left(b) < sizeof v) return ends(b);
    memcpy(&v, b->data + b->at, sizeof v);
    *value = le32toh(v);
    b->at += sizeof v;
    return true;
}

static bool doubles(struct bytes *b, double *values, int n)
{
    for (int i = 0; i < n; i++) {
        uint64_t bits;
        if (!u64(b, &bits)) return false;
        memcpy(&values[i], &bits, sizeof bits);
    }
    return true;
}

static bool skip(struct bytes *b, size_t n)
{
    if (left(b) < n) return ends(b);
    b->at += n;
    return true;
}

/* A number of things, each of at least `least` bytes: no more than the file has room for. */
static bool count(struct bytes *b, uint64_t *n, size_t least, const char *things)
{
    size_t where = b->at;
    if (!u64(b, n)) return false;
    if (*n <= left(b) / least) return true;
    return colmap_fault(b->records, b->file, where, b->err,
                        "tells of %llu %s, but only %zu bytes follow: the file is cut off or no COLMAP model",
                        (unsigned long long)*n, things, left(b));
}

static bool open_file(struct bytes *b, const struct colmap_records *records, const char *file, const char *item,
                      const char *items, size_t least, struct error *err)
{
    *b = (struct bytes){ .records = records, .file = file, .item = item, .err = err };
    if (!file_read(&b->data, &b->size, file, err)) return false;
    if (b->size < sizeof(uint64_t))
        return error_at(err, ERR_INPUT, file, 0, 0, "%zu bytes are no COLMAP model: it begins with 8 that count its %s",
                        b->size, items);
    return count(b, &b->count, least, items);
}

static bool at_end(const struct bytes *b)
{
    if (!left(b)) return true;
    return colmap_fault(b->records, b->file, b->at, b->err, "%zu bytes follow the last %s of %llu", left(b), b->item,
                        (unsigned long long)b->count);
}

static bool read_camera(struct colmap_records *r, struct bytes *b)
{
    struct colmap_camera camera = { .where = b->at };
    uint64_t model, w, h;
    if (!u32(b, &camera.id)) return false;
    size_t model_at = b->at;
    if (!u32(b, &model) || !u64(b, &w) || !u64(b, &h)) return false;
    if (model >= CAMERA_MODEL_COUNT)
        return colmap_fault(r, b->file, model_at, b->err,
                            "camera %llu: unknown camera model %d%s: the models 0 (%s) to %d (%s) are understood",
                            (unsigned long long)camera.id, (int)(int32_t)model,
                            model == 11 ? " (RAD_TAN_THIN_PRISM_FISHEYE)" : "", camera_model_name(0),
                            CAMERA_MODEL_COUNT - 1, camera_model_name(CAMERA_MODEL_COUNT - 1));
    camera.camera.model = (enum camera_model)model;
    camera.camera.width_px = (int)(w > 65536 ? 65536 : w);
    camera.camera.height_px = (int)(h > 65536 ? 65536 : h);
    return doubles(b, camera.camera.params, camera_model_param_count(camera.camera.model)) &&
           colmap_add_camera(r, &camera, b->err);
}

static bool read_image(struct colmap_records *r, struct bytes *b)
{
    struct colmap_image image = { .where = b->at };
    double v[7];
    if (!u32(b, &image.id) || !doubles(b, v, 7) || !u32(b, &image.camera_id)) return false;
    image.camera_from_world_q = (struct quat){ v[0], v[1], v[2], v[3] };
    image.camera_from_world_t = vec3(v[4], v[5], v[6]);
    const char *name = b->data + b->at;
    size_t length = strnlen(name, left(b));
    if (!skip(b, length + 1) || !colmap_add_image(r, &image, name, length, b->err)) return false;
    uint64_t n;
    if (!count(b, &n, 24, "keypoints")) return false;
    for (uint64_t i = 0; i < n; i++) {
        struct colmap_keypoint keypoint = { .where = b->at };
        if (!doubles(b, v, 2) || !u64(b, &keypoint.point_id)) return false;
        keypoint.q_px = (struct vec2){ v[0], v[1] };
        if (keypoint.point_id != UINT64_MAX && !colmap_add_keypoint(r, &keypoint, b->err)) return false;
    }
    return true;
}

static bool read_point(struct colmap_records *r, struct bytes *b)
{
    struct colmap_point point = { .where = b->at };
    double v[3];
    uint64_t n;
    if (!u64(b, &point.id) || !doubles(b, v, 3) || !skip(b, 3) || !doubles(b, &point.error_px, 1)) return false;
    point.p = vec3(v[0], v[1], v[2]);
    return count(b, &n, 8, "observations") && skip(b, 8 * (size_t)n) && colmap_add_point(r, &point, b->err);
}

bool colmap_read_binary(struct colmap_records *records, struct error *err)
{
    const struct {
        const char *file, *item, *items;
        size_t least;
        bool (*read)(struct colmap_records *, struct bytes *);
    } files[] = {
        { records->cameras_file, "camera", "cameras", 24 + 3 * 8, read_camera },
        { records->images_file, "image", "images", 8 + 7 * 8 + 1 + 8, read_image },
        { records->points_file, "point", "points", 4 * 8 + 3 + 8 + 8, read_point },
    };
    bool ok = true;
    for (int i = 0; ok && i < 3; i++) {
        struct bytes b;
        ok = open_file(&b, records, files[i].file, files[i].item, files[i].items, files[i].least, err);
        for (; ok && b.index < b.count; b.index++) ok = files[i].read(records, &b);
        ok = ok && at_end(&b);
        free(b.data);
    }
    return ok;
}
