/* The tracer against POV-Ray: the same triangles, each entity (and a place among them) glowing in a colour that is its id
 * and its depth, one ray a pixel. */
#include "gen/trace/trace.h"
#include "lib/file.h"

#include "tests/gen/place.h"
#include "tests/gen/solid.h"
#include "tests/tap.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#define WIDTH 320
#define HEIGHT 240
#define FAR_M 64.0
#define HALF_FLOAT (1.0 / 1024)

static const struct plane flat = { { 0, 0, 1 }, 0 };

/* 3 m up, looking 10 deg east of north and 8 deg down; the principal point is off the centre. */
static const struct camera camera = { CAMERA_PINHOLE, WIDTH, HEIGHT, { 300, 310, 150, 130 } };
static struct pose pitched(void)
{
    double a = 10 * M_PI / 180, b = 8 * M_PI / 180;
    struct vec3 right = vec3(cos(a), -sin(a), 0), forward = vec3(sin(a) * cos(b), cos(a) * cos(b), -sin(b));
    return (struct pose){ mat3_from_columns(right, vec3_cross(forward, right), forward), vec3(1, -2, 3) };
}

static void put(FILE *f, const char *name, struct vec3 v)
{
    fprintf(f, "%s <%.12g,%.12g,%.12g>\n", name, v.x, v.y, v.z);
}

static bool write_scene(const char *path, struct pose pose, const struct entity *entities, size_t n)
{
    FILE *f = fopen(path, "w");
    if (!f) return false;
    const double *p = camera.params;
    struct vec3 x = mat3_column(pose.rotation, 0), y = vec3_scale(mat3_column(pose.rotation, 1), -1),
                z = mat3_column(pose.rotation, 2);
    fputs("#version 3.7; global_settings { assumed_gamma 1 }\nbackground { rgb 0 }\ncamera {\n", f);
    put(f, "location", pose.translation);
    put(f, "right", vec3_scale(x, WIDTH / p[0]));
    put(f, "up", vec3_scale(y, HEIGHT / p[1]));
    put(f, "direction",
        vec3_add(z, vec3_add(vec3_scale(x, (WIDTH / 2.0 - p[2]) / p[0]), vec3_scale(y, (p[3] - HEIGHT / 2.0) / p[1]))));
    fputs("}\n", f);
    for (size_t i = 0; i < n; i++) {
        const struct mesh *m = &entities[i].model->meshes[0];
        fprintf(f, "mesh2 { vertex_vectors { %zu", m->vertices);
        for (size_t k = 0; k < m->vertices; k++) {
            const float *v = m->position_m[k];
            struct vec3 w = pose_apply(entities[i].world_from_entity, vec3((double)v[0], (double)v[1], (double)v[2]));
            fprintf(f, ",<%.12g,%.12g,%.12g>", w.x, w.y, w.z);
        }
        fprintf(f, "} face_indices { %zu", m->triangles);
        for (size_t k = 0; k < m->triangles; k++)
            fprintf(f, ",<%u,%u,%u>", m->triangle[k][0], m->triangle[k][1], m->triangle[k][2]);
        fprintf(
            f,
            "} texture { pigment { gradient <%.12g,%.12g,%.12g> color_map { [0 rgb <%d,0,0>] [1 rgb <%d,1,0>] } scale %.12g "
            "translate <%.12g,%.12g,%.12g> } finish { ambient 0 diffuse 0 emission 1 } } }\n",
            z.x, z.y, z.z, entities[i].id, entities[i].id, FAR_M, pose.translation.x, pose.translation.y,
            pose.translation.z);
    }
    return fclose(f) == 0;
}

static bool render(const char *scene, const char *picture)
{
    char in[600], out[600];
    snprintf(in, sizeof in, "+I%s", scene);
    snprintf(out, sizeof out, "+O%s", picture);
    pid_t child = fork();
    if (child == 0) {
        int null = open("/dev/null", O_WRONLY);
        dup2(null, 1);
        dup2(null, 2);
        execlp("povray", "povray", in, out, "+W320", "+H240", "+FE", "-A", "-D", "-GA", "+WT1", (char *)NULL);
        _exit(127);
    }
    int status;
    return child > 0 && waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

static uint16_t id_at(const struct image *picture, int x, int y)
{
    return (uint16_t)lround((double)*image_f32(picture, x, y));
}

/* Is a pixel of another owner next to this one? */
static bool at_edge(const struct image *instance, int x, int y)
{
    for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < HEIGHT; v++)
        for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < WIDTH; u++)
            if (*image_u16(instance, u, v) != *image_u16(instance, x, y)) return true;
    return false;
}

static void compare(const struct frame_labels *labels, const struct image *picture, const struct entity *entities,
                    size_t n)
{
    for (size_t i = 0; i < n; i++) {
        long both = 0, either = 0;
        for (int y = 0; y < HEIGHT; y++)
            for (int x = 0; x < WIDTH; x++) {
                bool ours = *image_u16(&labels->instance, x, y) == entities[i].id,
                     theirs = id_at(picture, x, y) == entities[i].id;
                both += ours && theirs;
                either += ours || theirs;
            }
        OK(either > 1000 && (double)both >= 0.995 * (double)either, "%s: %ld of %ld pixels agree", entities[i].name,
           both, either);
    }
    int stray = 0, edge = 0, slipped = 0;
    double worst = 0;
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            uint16_t ours = *image_u16(&labels->instance, x, y);
            if (ours != id_at(picture, x, y)) {
                edge++;
                stray += !at_edge(&labels->instance, x, y);
            } else if (ours) {
                double z = (double)*image_f32(&labels->depth, x, y),
                       off = (double)image_f32(picture, x, y)[1] * FAR_M / z - 1;
                /* POV-Ray's triangles are not watertight: a ray along an edge can slip in and see the other side. */
                if (off > HALF_FLOAT)
                    slipped++;
                else
                    worst = fmax(worst, -off);
            }
        }
    OK(stray == 0, "each of the %d pixels that disagree is at an edge", edge);
    OK(worst < HALF_FLOAT && slipped <= 5,
       "depth agrees to the half floats of POV-Ray's file, but where its rays slip between triangles (%d)", slipped);
}

#define PLACE_ID 200

/* A hill of 2 n n triangles with bumps, below what stands at z = 0, as one model. */
static void solid_hill(struct solid *hill, uint32_t n)
{
    solid_init(hill, (n + 1) * (n + 1), 2 * n * n);
    for (uint32_t i = 0; i <= n; i++)
        for (uint32_t j = 0; j <= n; j++) {
            double x = -15 + 30.0 * i / n, y = 2 + 28.0 * j / n;
            double bumps = 0.35 * sin(2.1 * x) * sin(1.7 * y) - 0.5;
            float p[3] = { (float)x, (float)y, (float)(bumps + 2.1 * exp(-(x - 1.2) * (x - 1.2) - (y - 6) * (y - 6))) };
            memcpy(hill->mesh.position_m[i * (n + 1) + j], p, sizeof p);
            hill->mesh.normal[i * (n + 1) + j][2] = 1;
        }
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t j = 0; j < n; j++) {
            uint32_t a = i * (n + 1) + j, b = a + n + 1, t[2][3] = { { a, b, a + 1 }, { b, b + 1, a + 1 } };
            memcpy(hill->mesh.triangle[2 * (i * n + j)], t, sizeof t);
        }
    solid_finish(hill);
}

/* The owner of every pixel and its depth, the place's own pixels among them. */
static void add_place(struct frame_labels *labels)
{
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            float z = *image_f32(&labels->place_depth, x, y);
            if (*image_u16(&labels->instance, x, y) != 0 || isnan(z)) continue;
            *image_u16(&labels->instance, x, y) = PLACE_ID;
            *image_f32(&labels->depth, x, y) = z;
        }
}

/* Trace and render the same entities, the last of which is the place when there is one, and compare. */
static void hold_together(struct entity *entities, size_t n, bool with_place)
{
    struct error err = ERROR_NONE;
    struct pose pose = pitched();
    const struct model *models[8];
    struct tracer *tracer = NULL;
    struct frame_labels labels = { 0 };
    struct static_mesh *mesh = NULL;
    struct place place = { 0 };
    size_t traced = with_place ? n - 1 : n;
    for (size_t i = 0; i < traced; i++) models[i] = entities[i].model;
    if (with_place) {
        const struct mesh *m = entities[traced].model->meshes;
        place_add(&place, (const float(*)[3])m->position_m, m->vertices, (const uint32_t(*)[3])m->triangle, m->triangles, 0);
    }
    OK((!with_place || place_mesh(&mesh, &place, false, &err)) && tracer_create(&tracer, models, traced, &err) &&
           trace_frame(&labels, tracer, &(struct trace_input){ .camera = &camera, .world_from_camera = pose,
                                                               .ground = with_place ? NULL : &flat, .place = mesh,
                                                               .entities = entities, .entity_count = traced }, &err),
       "%zu entities are traced%s", traced, err.text);
    if (with_place) {
        const struct entity_labels *box = &labels.entities[0];
        int64_t hidden = 0;
        for (size_t i = 0; i < box->hider_count; i++)
            if (box->hiders[i].kind == HIDER_PLACE) hidden = box->hiders[i].pixels;
        OK(hidden > 500, "the place hides %ld pixels of %s", (long)hidden, entities[0].name);
        add_place(&labels);
    }

    char folder[] = "trace-povray.XXXXXX";
    if (!mkdtemp(folder)) exit(1);
    char *scene = string_format("%s/scene.pov", folder), *picture_path = string_format("%s/picture.exr", folder);
    struct image picture = { 0 };
    bool ok = OK(write_scene(scene, pose, entities, n) && render(scene, picture_path) &&
                     image_read(&picture, picture_path, &err) && picture.width_px == WIDTH && picture.type == PIXEL_F32,
                 "POV-Ray renders them%s", err.text);
    if (ok) compare(&labels, &picture, entities, n);
    unlink(scene);
    unlink(picture_path);
    rmdir(folder);
    free(scene);
    free(picture_path);
    image_release(&picture);
    frame_labels_release(&labels);
    tracer_destroy(tracer);
    static_mesh_destroy(mesh);
    place_free(&place);
}

int main(void)
{
    struct solid box, egg, plate, hill;
    solid_box(&box, 4.5, 1.8, 1.5);
    solid_egg(&egg, 4, 2, 3, 24);
    solid_plate(&plate, 5, 4);
    solid_hill(&hill, 60);
    static const struct {
        const char *name;
        double x, y, turn;
    } at[5] = { { "a box", 0.5, 8, 0.7 },
                { "an egg behind it", 3, 14, 2.1 },
                { "a plate behind both", 4, 19, -1.2 },
                { "a box over the border", -1.2, 4.2, -0.4 },
                { "the place", 0, 0, 0 } };
    const struct model *models[5] = { &box.model, &egg.model, &plate.model, &box.model, &hill.model };
    struct entity entities[5];
    for (int i = 0; i < 5; i++) {
        double c = cos(at[i].turn), s = sin(at[i].turn);
        entities[i] = (struct entity){ .id = (uint16_t)(i == 4 ? PLACE_ID : 3 * i + 2),
                                       .name = at[i].name,
                                       .model = models[i],
                                       .world_from_entity = { { { { c, -s, 0 }, { s, c, 0 }, { 0, 0, 1 } } },
                                                              { at[i].x, at[i].y, 0 } } };
    }
    hold_together(entities, 4, false);
    hold_together(entities, 5, true);
    solid_free(&box);
    solid_free(&egg);
    solid_free(&plate);
    solid_free(&hill);
    return tap_done();
}
