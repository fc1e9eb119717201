/* The passes as POV-Ray renders them, against what light.c, trace.c and camera.c say. */
#include "gen/render/passes.h"

#include "gen/trace/trace.h"
#include "lib/file.h"
#include "lib/image.h"
#include "tests/gen/shade.h"
#include "tests/gen/povray.h"
#include "tests/tap.h"

/* A box of 2 x 1 x 1 m standing at its origin. */
static struct model box_model(struct material *material, struct mesh *mesh)
{
    static float position[24][3], normal[24][3];
    static uint32_t triangle[12][3];
    for (uint32_t f = 0; f < 6; f++) {
        int axis = (int)f / 2, side = (int)f % 2 ? 1 : -1;
        for (uint32_t k = 0; k < 4; k++) {
            int u = (k == 1 || k == 2) ? 1 : -1, v = k >= 2 ? 1 : -1;
            float *p = position[4 * f + k];
            int p1 = (axis + 1) % 3, p2 = (axis + 2) % 3;
            p[axis] = (float)side;
            p[p1] = (float)u;
            p[p2] = (float)(v * side);
            normal[4 * f + k][axis] = (float)side;
        }
        for (uint32_t k = 0; k < 3; k++) {
            triangle[2 * f][k] = 4 * f + k;
            triangle[2 * f + 1][k] = 4 * f + (k == 0 ? 0 : k + 1);
        }
    }
    for (int i = 0; i < 24; i++) {
        position[i][1] *= 0.5f;
        position[i][2] = 0.5f + 0.5f * position[i][2];
    }
    material_default(material);
    *mesh = (struct mesh){ .position_m = position, .normal = normal, .triangle = triangle, .vertices = 24, .triangles = 12 };
    return (struct model){ .meshes = mesh, .mesh_count = 1, .materials = material, .material_count = 1,
                           .min_m = { -1, -0.5, 0 }, .max_m = { 1, 0.5, 1 } };
}

static bool render(struct image pass[3], const char *out, const struct passes *p)
{
    static const char *const names[] = { "object", "plane", "shadow" };
    struct error err = ERROR_NONE;
    char *folder = string_format("%s/frames", out);
    bool ok = folder_make(folder, &err) && model_include_write(&p->includes[0], NULL, out, &p->entities[0], &err) &&
              passes_write(folder, p, &err);
    for (int i = 0; ok && i < 3; i++) {
        char *path = string_format("%s/%s.exr", folder, names[i]);
        /* The object pass by one ray a pixel, as labels are traced; the others as they are. */
        struct pass_settings settings = pass_settings(p->scene->quality);
        ok = povray(out, names[i], p->view.width_px, p->view.height_px, i == 0 ? "-A -J" : settings.receiver_antialias) && image_read(&pass[i], path, &err);
        free(path);
    }
    if (!ok) printf("# %s %s; %s/povray.log\n", err.file, err.text, out);
    free(folder);
    return ok;
}

static double iou(const struct image *object, const struct image *instance, struct rect window, int *inner)
{
    int both = 0, either = 0;
    *inner = 0;
    for (int y = window.y0; y < window.y1; y++)
        for (int x = window.x0; x < window.x1; x++) {
            bool seen = image_f32(object, x - window.x0, y - window.y0)[3] > 0.5f, traced = *image_u16(instance, x, y) != 0;
            both += seen && traced;
            either += seen || traced;
            if (seen == traced || x == 0 || y == 0 || x == instance->width_px - 1 || y == instance->height_px - 1) continue;
            /* At an edge, a neighbour in the tracer's mask differs. */
            bool edge = false;
            for (int k = 0; k < 9; k++) edge |= (*image_u16(instance, x + k % 3 - 1, y + k / 3 - 1) != 0) != traced;
            *inner += !edge;
        }
    return either ? (double)both / either : 0;
}

int main(void)
{
    struct error err = ERROR_NONE;
    struct material material;
    struct mesh mesh;
    struct model model = box_model(&material, &mesh);
    const struct model *models[] = { &model };
    struct scene scene = {
        .path = "scene.yaml", .sky = SKY_CLEAR, .sun = SUN_GIVEN, .sun_azimuth_rad = 1, .sun_elevation_rad = 0.8,
        .turbidity = 3, .sun_scale = 1, .ground = { { 0, 0, 1 }, 0 }, .ground_albedo = { 0.22, 0.2, 0.18 },
        .quality = QUALITY_STANDARD,
    };
    const struct camera camera = { .model = CAMERA_PINHOLE, .width_px = 200, .height_px = 150, .params = { 180, 180, 93, 80 } };
    struct vec3 eye = { -4, -5, 4 }, ahead = vec3_unit(vec3_sub(vec3(0, 0, 0.3), eye));
    struct vec3 right = vec3_unit(vec3_cross(ahead, vec3(0, 0, 1)));
    const struct pose world_from_camera = { mat3_from_columns(right, vec3_cross(ahead, right), ahead), eye };
    struct entity entity = { .id = 1, .name = "box", .model_name = "box", .class_ = CLASS_OTHER, .model = &model,
                             .world_from_entity = entity_stand(&scene.ground, vec3(0, 0, 0), 0.4) };
    char out[] = "passes.XXXXXX", sky_map[SKY_MAP_SIZE];
    if (!OK(mkdtemp(out) != NULL, "a folder to render in")) return tap_done();

    for (int round = 0; round < 2; round++) {
        const char *name = round ? "overcast" : "clear";
        struct light light;
        struct receiver receiver;
        struct shaded_ground ground;
        struct image pass[3] = { { 0 } };
        const struct model_include include = model_include(0, &entity);
        scene.sky = round ? SKY_OVERCAST : SKY_CLEAR;
        scene.sun = round ? SUN_NONE : SUN_GIVEN;
        if (!OK(light_create(&light, &scene, &err) && sky_map_write(sky_map, out, &light, &err) &&
                receiver_create(&receiver, &entity, &scene.ground, &light, false, NULL, &err), "%s: light and receivers", name))
            return tap_done();
        struct passes p = { .scene = &scene, .sky_map = sky_map, .light = &light, .world_from_camera = world_from_camera,
                            .entities = &entity, .includes = &include, .entity_count = 1, .ground = scene.ground,
                            .receivers = &ground };
        OK(view_cover(&p.view, &camera, (struct rect){ 0, 0, 200, 150 }, 1, &err) &&
           shaded_ground_of_plane(&ground, &scene.ground, &receiver, 1, &err) && shade_ground(&ground, &p, &receiver, NULL, &err),
           "%s: a view and its ground", name);
        if (!OK(render(pass, out, &p), "%s: POV-Ray renders all three passes", name)) return tap_done();

        /* The ground's radiance, everywhere in the plane pass. */
        double low[3] = { 9, 9, 9 }, high[3] = { 0 };
        int lit = 0, shaded_wrong = 0, edges = 0, edges_wrong = 0;
        double deepest = 1, open = 0;
        for (int y = 0; y < pass[1].height_px; y++)
            for (int x = 0; x < pass[1].width_px; x++) {
                const float *plane = image_f32(&pass[1], x, y), *shadow = image_f32(&pass[2], x, y);
                if (plane[3] > 0 && plane[3] < 1) {
                    edges++;
                    edges_wrong += fabs((double)(shadow[1] / plane[1]) - 1) > 0.08 || fabsf(shadow[3] - plane[3]) > 0.01f;
                }
                edges_wrong += plane[3] <= 0 && shadow[3] > 0;
                if (plane[3] < 1) continue;
                lit++;
                for (int c = 0; c < 3; c++) {
                    low[c] = fmin(low[c], (double)plane[c]);
                    high[c] = fmax(high[c], (double)plane[c]);
                }
                double ratio = (double)(shadow[1] / plane[1]);
                deepest = fmin(deepest, ratio);
                open = fmax(open, ratio);
                shaded_wrong += ratio > 1.001;
            }
        OK(edges_wrong == 0, "%s: the receivers' edges draw no line (%d px on them)", name, edges);
        OK(lit > 3000, "%s: receivers lie around the box (%d px)", name, lit);
        for (int c = 0; c < 3; c++) {
            double want = scene.ground_albedo[c] * light.irradiance[c];
            NEAR(low[c], want, 0.01 * want, "%s: ground in the plane pass has the radiance that light.c gives, channel %d", name, c);
            NEAR(high[c], want, 0.01 * want, "%s: everywhere", name);
        }
        NEAR(open, 1, 0.002, "%s: ground in the open is not shaded", name);
        OK(shaded_wrong == 0, "%s: nothing is lit by an entity's absence of shade", name);
        double sky_only = 1 - light.sun_color[1] * light.sun_direction.z / light.irradiance[1];
        OK(deepest < (round ? 0.5 : sky_only), "%s: beside the box the ground is darker (%.2f)", name, deepest);

        if (!round) { /* the tip of the shadow of the box's centre line, by hand */
            struct vec3 top = vec3(0, 0, 1), tip;
            plane_intersect(&scene.ground, &tip, top, vec3_scale(light.sun_direction, -1));
            struct vec2 q;
            struct pose camera_from_world = pose_inverse(world_from_camera);
            if (OK(camera_project(&camera, &q, pose_apply(camera_from_world, tip), &err), "the shadow is in the picture")) {
                int x = (int)q.x, y = (int)q.y;
                double ratio = (double)(image_f32(&pass[2], x, y)[1] / image_f32(&pass[1], x, y)[1]);
                OK(ratio < sky_only + 0.02, "the sun's shadow falls where it should (%.3f < %.3f)", ratio, sky_only);
            }
        }

        struct tracer *tracer;
        struct frame_labels labels;
        if (OK(tracer_create(&tracer, models, 1, &err) &&
               trace_frame(&labels, tracer, &(struct trace_input){ .camera = &camera, .world_from_camera = world_from_camera,
                                                                   .ground = &scene.ground, .entities = &entity, .entity_count = 1 }, &err),
               "%s: labels traced", name)) {
            int inner;
            double agreement = iou(&pass[0], &labels.instance, p.view.window_px, &inner);
            OK(agreement >= 0.995, "%s: POV-Ray's mask and the tracer's agree (IoU %.4f)", name, agreement);
            OK(inner == 0, "%s: where they do not, it is an edge", name);
            frame_labels_release(&labels);
            tracer_destroy(tracer);
        }
        for (int i = 0; i < 3; i++) image_release(&pass[i]);
        shaded_ground_release(&ground);
        receiver_release(&receiver);
        light_release(&light);
    }
    /* On a slope, far from what stands there, the passes agree as well. */
    struct light light;
    struct receiver receiver;
    struct shaded_ground ground = { 0 };
    struct image pass[3] = { { 0 } };
    size_t open = 0, wrong = 0;
    const struct model_include include = model_include(0, &entity);
    scene.sky = SKY_OVERCAST;
    scene.sun = SUN_NONE;
    scene.ground.normal = vec3_unit(vec3(0.2, 0.1, 1));
    entity.world_from_entity = entity_stand(&scene.ground, vec3(0, 0, 0), 0.4);
    if (OK(light_create(&light, &scene, &err) && sky_map_write(sky_map, out, &light, &err) &&
           receiver_create(&receiver, &entity, &scene.ground, &light, false, NULL, &err), "a slope: light and receivers")) {
        struct passes p = { .scene = &scene, .sky_map = sky_map, .light = &light, .world_from_camera = world_from_camera,
                            .entities = &entity, .includes = &include, .entity_count = 1, .ground = scene.ground,
                            .receivers = &ground };
        OK(view_cover(&p.view, &camera, (struct rect){ 0, 0, 200, 150 }, 1, &err) &&
           shaded_ground_of_plane(&ground, &scene.ground, &receiver, 1, &err) && shade_ground(&ground, &p, &receiver, NULL, &err),
           "a slope: a view and its ground");
        if (OK(render(pass, out, &p), "a slope: POV-Ray renders all three passes"))
            for (int y = 0; y < pass[1].height_px; y++)
                for (int x = 0; x < pass[1].width_px; x++) {
                    const float *plane = image_f32(&pass[1], x, y), *shadow = image_f32(&pass[2], x, y);
                    if (plane[3] < 0.5f) continue;
                    double ratio = (double)(shadow[1] / plane[1]);
                    open += ratio > 0.98;
                    wrong += ratio > 1.002;
                }
        OK(open > 50 && wrong == 0, "a slope: ground in the open is not shaded (%zu px), none is brighter (%zu px)", open, wrong);
        for (int i = 0; i < 3; i++) image_release(&pass[i]);
        shaded_ground_release(&ground);
        shaded_ground_release(&ground);
        receiver_release(&receiver);
        light_release(&light);
    }
    povray_remove(out);
    return tap_done();
}
