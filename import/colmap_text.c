#include "import/colmap_records.h"

#include "lib/file.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A text, read line by line and word by word. */
struct text {
    const struct colmap_records *records;
    const char *file;
    char *data;
    char *next;        /* start of the line after this one; NULL behind the last */
    char *line, *at;   /* this line, ended by NUL, and where reading stands in it */
    int number;
    struct error *err;
};

__attribute__((format(printf, 2, 3)))
static bool fault(const struct text *t, const char *format, ...);

static bool fault(const struct text *t, const char *format, ...)
{
    char what[512];
    va_list args;
    va_start(args, format);
    vsnprintf(what, sizeof what, format, args);
    va_end(args);
    return error_at(t->err, ERR_INPUT, t->file, t->number, (int)(t->at - t->line) + 1, "%s", what);
}

/* The next line, whatever is in it. */
static bool any_line(struct text *t)
{
    if (!t->next) return false;
    t->line = t->at = t->next;
    t->number++;
    char *end = strchr(t->line, '\n');
    if (end) *end = 0;
    t->next = end && end[1] ? end + 1 : NULL;
    return true;
}

static void skip_blanks(struct text *t) { t->at += strspn(t->at, " \t\r"); }
static bool at_end(struct text *t) { skip_blanks(t); return !*t->at; }

/* The next line that says something. */
static bool data_line(struct text *t)
{
    while (any_line(t))
        if (!at_end(t) && *t->at != '#') return true;
    return false;
}

static size_t word_length(const struct text *t) { return strcspn(t->at, " \t\r"); }

static bool wanted(struct text *t, const char *what)
{
    if (at_end(t)) return fault(t, "the line ends, and %s is wanted", what);
    return fault(t, "%s is wanted, not \"%.*s\"", what, (int)(word_length(t) > 60 ? 60 : word_length(t)), t->at);
}

static bool number(struct text *t, double *value, const char *what)
{
    skip_blanks(t);
    char *end;
    double v = strtod(t->at, &end);
    if (end == t->at || end != t->at + word_length(t)) return wanted(t, what);
    *value = v;
    t->at = end;
    return true;
}

static bool integer(struct text *t, uint64_t *value, const char *what)
{
    skip_blanks(t);
    size_t digits = strspn(t->at, "0123456789");
    if (!digits || digits > 19 || digits != word_length(t)) return wanted(t, what);
    *value = strtoull(t->at, NULL, 10);
    t->at += digits;
    return true;
}

static bool read_cameras(struct colmap_records *r, struct text *t)
{
    while (data_line(t)) {
        struct colmap_camera camera = { .where = (size_t)t->number };
        struct camera *c = &camera.camera;
        uint64_t w, h;
        if (!integer(t, &camera.id, "a camera's id")) return false;
        skip_blanks(t);
        char name[64];
        size_t length = word_length(t);
        snprintf(name, sizeof name, "%.*s", (int)(length < sizeof name ? length : sizeof name - 1), t->at);
        if (length >= sizeof name || !camera_model_from_name(&c->model, name))
            return fault(t, "camera %llu: unknown camera model \"%s\": COLMAP's models %s to %s are understood",
                         (unsigned long long)camera.id, name, camera_model_name(0),
                         camera_model_name(CAMERA_MODEL_COUNT - 1));
        t->at += length;
        if (!integer(t, &w, "the width in pixels") || !integer(t, &h, "the height in pixels")) return false;
        c->width_px = (int)(w > 65536 ? 65536 : w);
        c->height_px = (int)(h > 65536 ? 65536 : h);
        int n = camera_model_param_count(c->model);
        for (int i = 0; i < n; i++) {
            if (at_end(t))
                return fault(t, "camera %llu: %s has %d parameters (%s), and %d are given",
                             (unsigned long long)camera.id, name, n, camera_model_param_names(c->model), i);
            if (!number(t, &c->params[i], "a parameter")) return false;
        }
        if (!at_end(t))
            return fault(t, "camera %llu: %s has %d parameters (%s), and more are given",
                         (unsigned long long)camera.id, name, n, camera_model_param_names(c->model));
        if (!colmap_add_camera(r, &camera, t->err)) return false;
    }
    return true;
}

static bool read_keypoints(struct colmap_records *r, struct text *t)
{
    while (!at_end(t)) {
        struct colmap_keypoint keypoint = { .where = (size_t)t->number };
        if (!number(t, &keypoint.q_px.x, "x of a keypoint") || !number(t, &keypoint.q_px.y, "y of a keypoint"))
            return false;
        skip_blanks(t);
        if (word_length(t) == 2 && !strncmp(t->at, "-1", 2)) { /* of no point */
            t->at += 2;
            continue;
        }
        if (!integer(t, &keypoint.point_id, "a point's id or -1") || !colmap_add_keypoint(r, &keypoint, t->err))
            return false;
    }
    return true;
}

static bool read_images(struct colmap_records *r, struct text *t)
{
    static const char *const names[] = { "QW", "QX", "QY", "QZ", "TX", "TY", "TZ" };
    while (data_line(t)) {
        struct colmap_image image = { .where = (size_t)t->number };
        double v[7];
        if (!integer(t, &image.id, "an image's id")) return false;
        for (int i = 0; i < 7; i++)
            if (!number(t, &v[i], names[i])) return false;
        image.camera_from_world_q = (struct quat){ v[0], v[1], v[2], v[3] };
        image.camera_from_world_t = vec3(v[4], v[5], v[6]);
        if (!integer(t, &image.camera_id, "a camera's id")) return false;
        skip_blanks(t);
        size_t length = strlen(t->at); /* names may hold blanks */
        while (length && strchr(" \t\r", t->at[length - 1])) length--;
        if (!colmap_add_image(r, &image, t->at, length, t->err)) return false;
        if (!any_line(t))
            return fault(t, "image \"%s\": its second line, that of the keypoints, is missing: the file is cut off",
                         r->images[r->image_count - 1].name);
        if (!read_keypoints(r, t)) return false;
    }
    return true;
}

static bool read_points(struct colmap_records *r, struct text *t)
{
    static const char *const names[] = { "X", "Y", "Z", "R", "G", "B", "ERROR" };
    while (data_line(t)) {
        struct colmap_point point = { .where = (size_t)t->number };
        double v[7];
        uint64_t unused;
        if (!integer(t, &point.id, "a point's id")) return false;
        for (int i = 0; i < 7; i++)
            if (!number(t, &v[i], names[i])) return false;
        point.p = vec3(v[0], v[1], v[2]);
        point.error_px = v[6];
        while (!at_end(t))
            if (!integer(t, &unused, "an image's id") || !integer(t, &unused, "a keypoint's index")) return false;
        if (!colmap_add_point(r, &point, t->err)) return false;
    }
    return true;
}

bool colmap_read_text(struct colmap_records *records, struct error *err)
{
    const struct {
        const char *file;
        bool (*read)(struct colmap_records *, struct text *);
    } files[] = {
        { records->cameras_file, read_cameras },
        { records->images_file, read_images },
        { records->points_file, read_points },
    };
    bool ok = true;
    for (int i = 0; ok && i < 3; i++) {
        struct text t = { .records = records, .file = files[i].file, .err = err };
        size_t size;
        ok = file_read(&t.data, &size, t.file, err);
        if (!ok) break;
        t.next = *t.data ? t.data : NULL;
        t.line = t.at = t.data;
        ok = strlen(t.data) == size ? files[i].read(records, &t)
                                    : error_at(err, ERR_INPUT, t.file, 0, 0, "is no text: it holds bytes of value 0");
        free(t.data);
    }
    return ok;
}
