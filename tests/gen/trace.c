#include "gen/trace/trace.h"

#include "tests/gen/solid.h"
#include "tests/tap.h"

/* A camera 1 m above the ground at the origin that looks north, level. */
static const struct pose camera_pose = { { { { 1, 0, 0 }, { 0, 0, 1 }, { 0, -1, 0 } } }, { 0, 0, 1 } };
static const struct plane flat = { { 0, 0, 1 }, 0 };
static const struct camera pinhole = { CAMERA_PINHOLE, 320, 240, { 400, 400, 160, 120 } };

/* The entity's x axis points at `facing_rad`, clockwise from north. */
static struct entity place(uint16_t id, const struct model *model, double x, double y, double z, double facing_rad)
{
    double s = sin(facing_rad), c = cos(facing_rad);
    return (struct entity){ .id = id,
                            .name = "thing",
                            .model_name = "solid",
                            .class_ = CLASS_CAR,
                            .model = model,
                            .world_from_entity = { { { { s, -c, 0 }, { c, s, 0 }, { 0, 0, 1 } } }, { x, y, z } } };
}

static bool trace(struct frame_labels *labels, const struct camera *camera, const struct entity *entities, size_t n,
                  const struct occluder *occluders, size_t occluder_count, struct error *err)
{
    const struct model *models[8];
    struct tracer *tracer = NULL;
    for (size_t i = 0; i < n; i++) models[i] = entities[i].model;
    bool ok = tracer_create(&tracer, models, n, err) &&
              trace_frame(labels, tracer, &(struct trace_input){ .camera = camera, .world_from_camera = camera_pose, .ground = &flat,
                                                                  .entities = entities, .entity_count = n, .occluders = occluders,
                                                                  .occluder_count = occluder_count }, err);
    tracer_destroy(tracer);
    return ok;
}

static bool same_rect(struct rect a, int x0, int y0, int x1, int y1)
{
    return a.x0 == x0 && a.y0 == y0 && a.x1 == x1 && a.y1 == y1;
}

/* A 2 m plate 10 m ahead fills exactly the 80 x 80 pixels in the middle. */
static void known_plate(void)
{
    struct error err = ERROR_NONE;
    struct solid plate;
    solid_plate(&plate, 2, 2);
    struct entity e = place(7, &plate.model, 0, 10, 0, M_PI);
    struct frame_labels labels = { 0 };
    OK(trace(&labels, &pinhole, &e, 1, NULL, 0, &err), "a plate is traced%s", err.text);
    int wrong = 0;
    double worst = 0;
    for (int y = 0; y < 240; y++)
        for (int x = 0; x < 320; x++) {
            bool in = x >= 120 && x < 200 && y >= 80 && y < 160;
            wrong += *image_u16(&labels.instance, x, y) != (in ? 7 : 0);
            double z = (double)*image_f32(&labels.depth, x, y);
            if (in)
                worst = fmax(worst, fabs(z - 10));
            else
                wrong += !isnan(z);
        }
    OK(wrong == 0, "the instance image holds its id in just its 80 x 80 pixels, and depth nothing elsewhere (%d wrong)",
       wrong);
    NEAR(worst, 0, 1e-5, "depth is the plate's z at every pixel");
    struct entity_labels *l = &labels.entities[0];
    OK(l->in_frame && l->pixels_visible == 6400 && l->pixels_amodal == 6400 && l->pixels_total == 6400,
       "6400 pixels each way");
    OK(same_rect(l->box_visible_px, 120, 80, 200, 160) && same_rect(l->box_amodal_px, 120, 80, 200, 160),
       "both boxes are half open");
    OK(same_rect(l->mask_px, 120, 80, 200, 160), "the mask is cropped to its pixels");
    OK(l->visible_fraction == 1 && l->truncation == 0 && l->hider_count == 0, "nothing hides or cuts it");
    OK(!labels.visible.data && !labels.receiver.data, "without occluders there are no shares");
    frame_labels_release(&labels);

    struct entity back = place(7, &plate.model, 0, 10, 0, 0);
    OK(trace(&labels, &pinhole, &back, 1, NULL, 0, &err) && labels.entities[0].pixels_visible == 6400,
       "a triangle is as solid from behind");
    frame_labels_release(&labels);

    struct entity far_ = place(7, &plate.model, 0, 1000, 0, M_PI);
    struct camera tele = pinhole;
    tele.params[0] = tele.params[1] = 40000;
    OK(trace(&labels, &tele, &far_, 1, NULL, 0, &err) && labels.entities[0].pixels_visible == 6400,
       "100 times as far through 100 times the focal length");
    worst = 0;
    for (size_t i = 0; i < 6400 && labels.entities[0].mask; i++)
        worst = fmax(worst, fabs((double)labels.entities[0].depth_m[i] - 1000));
    NEAR(worst, 0, 1e-4, "keeps the depth to a float's last bit");
    frame_labels_release(&labels);

    struct entity behind = place(7, &plate.model, 0, -10, 0, M_PI);
    OK(trace(&labels, &pinhole, &behind, 1, NULL, 0, &err), "an entity behind the camera is traced");
    l = &labels.entities[0];
    OK(!l->in_frame && l->pixels_total == 0 && !l->mask && l->visible_fraction == 0 && l->truncation == 1,
       "and is not in the frame");
    frame_labels_release(&labels);
    solid_free(&plate);
}

/* Near: 80 x 80 pixels in the middle. Far: as large, 40 px to the right and 20 px lower, so the near one hides 40 x 60
 * of it. */
static void overlap(void)
{
    struct error err = ERROR_NONE;
    struct solid near, far_;
    solid_plate(&near, 2, 2);
    solid_plate(&far_, 4, 4);
    struct entity e[2] = { place(3, &far_.model, 2, 20, -2, M_PI), place(9, &near.model, 0, 10, 0, M_PI) };
    struct frame_labels labels = { 0 };
    OK(trace(&labels, &pinhole, e, 2, NULL, 0, &err), "two plates are traced%s", err.text);
    struct entity_labels *hidden = &labels.entities[0], *front = &labels.entities[1];
    OK(front->pixels_visible == 6400 && front->hider_count == 0, "the nearer is whole");
    OK(hidden->pixels_amodal == 6400 && hidden->pixels_visible == 4000, "2400 of the further one's pixels are hidden");
    NEAR(hidden->visible_fraction, 0.625, 1e-12, "visible fraction");
    OK(hidden->hider_count == 1 && hidden->hiders[0].id == 9 && hidden->hiders[0].pixels == 2400,
       "and the nearer hides them");
    OK(same_rect(hidden->box_amodal_px, 160, 100, 240, 180) && same_rect(hidden->box_visible_px, 160, 100, 240, 180),
       "an L has the box of the whole");
    OK(*image_u16(&labels.instance, 180, 120) == 9 && *image_u16(&labels.instance, 220, 120) == 3,
       "one owner a pixel, the nearest");
    NEAR((double)hidden->depth_m[0], 20, 1e-5, "amodal depth goes on behind what hides");
    frame_labels_release(&labels);
    solid_free(&near);
    solid_free(&far_);
}

static void truncated(void)
{
    struct error err = ERROR_NONE;
    struct solid plate;
    solid_plate(&plate, 2, 2);
    struct entity e = place(1, &plate.model, -4, 10, 0, M_PI);
    struct frame_labels labels = { 0 };
    OK(trace(&labels, &pinhole, &e, 1, NULL, 0, &err), "a plate on the border is traced");
    struct entity_labels *l = &labels.entities[0];
    NEAR(l->truncation, 0.5, 1e-12, "half outside is a truncation of 0.5");
    OK(l->pixels_total == 6400 && l->pixels_amodal == 3200, "counted in pixels");
    OK(same_rect(l->box_amodal_px, -40, 80, 40, 160) && same_rect(l->box_visible_px, 0, 80, 40, 160),
       "the amodal box goes beyond the border");
    frame_labels_release(&labels);

    struct entity out = place(1, &plate.model, -6, 10, 0, M_PI);
    OK(trace(&labels, &pinhole, &out, 1, NULL, 0, &err), "a plate beside the picture is traced");
    l = &labels.entities[0];
    OK(!l->in_frame && l->pixels_total == 6400 && l->truncation == 1 && same_rect(l->box_amodal_px, -120, 80, -40, 160),
       "it is not in the frame, yet its amodal box is known");
    frame_labels_release(&labels);
    solid_free(&plate);

    struct solid box;
    solid_box(&box, 20, 20, 20);
    struct camera large = { CAMERA_PINHOLE, 960, 720, { 900, 900, 480, 360 } };
    struct entity around = place(1, &box.model, 0, 0, -5, 0.3);
    OK(trace(&labels, &large, &around, 1, NULL, 0, &err), "a box around the camera is traced");
    l = &labels.entities[0];
    OK(l->pixels_amodal == 960 * 720, "it fills the picture");
    NEAR(l->truncation, 1 - 1.0 / 9, 2e-3, "it is counted to one picture beyond each side, by samples");
    frame_labels_release(&labels);
    solid_free(&box);
}

/* Slabs: Kay and Kajiya 1986. */
static bool meets(struct vec3 o, struct vec3 d, const struct model *m, double grow, double *range)
{
    double near = 0, far = INFINITY, oo[3] = { o.x, o.y, o.z }, dd[3] = { d.x, d.y, d.z };
    double lo[3] = { m->min_m.x, m->min_m.y, m->min_m.z }, hi[3] = { m->max_m.x, m->max_m.y, m->max_m.z };
    for (int i = 0; i < 3; i++) {
        double a = (lo[i] - grow - oo[i]) / dd[i], b = (hi[i] + grow - oo[i]) / dd[i];
        near = fmax(near, fmin(a, b));
        far = fmin(far, fmax(a, b));
    }
    *range = near > 0 ? near : far;
    return near < far;
}

/* Against every pixel of the photograph: nothing that a box covers is left out by the search for where it is. */
static void box_through(const struct camera *camera, struct entity e, const char *where)
{
    struct error err = ERROR_NONE;
    struct frame_labels labels = { 0 };
    bool ok = trace(&labels, camera, &e, 1, NULL, 0, &err);
    struct pose entity_from_camera = pose_compose(pose_inverse(e.world_from_entity), camera_pose);
    int wrong = 0, covered = 0;
    double worst = 0;
    for (int y = 0; y < camera->height_px && ok; y++)
        for (int x = 0; x < camera->width_px; x++) {
            struct error none = ERROR_NONE;
            struct vec3 d;
            double surely, maybe, range = 0;
            bool got = *image_u16(&labels.instance, x, y) != 0, inner = false, outer = false;
            if (camera_unproject(camera, &d, (struct vec2){ x + 0.5, y + 0.5 }, &none)) {
                struct vec3 r = mat3_apply(entity_from_camera.rotation, d);
                inner = meets(entity_from_camera.translation, r, e.model, -1e-6, &surely);
                outer = meets(entity_from_camera.translation, r, e.model, 1e-6, &maybe);
                if (inner && got && meets(entity_from_camera.translation, r, e.model, 0, &range))
                    worst = fmax(worst, fabs((double)*image_f32(&labels.depth, x, y) - range * d.z));
            }
            wrong += got ? !outer : inner;
            covered += inner;
        }
    OK(ok && wrong == 0 && worst < 2e-5, "%s %s: each of %d pixels as a box says (%d wrong, depth off by %.1e m)",
       camera_model_name(camera->model), where, covered, wrong, worst);
    OK(covered > 20, "and it is seen");
    frame_labels_release(&labels);
}

static void lenses(void)
{
    static const struct camera cameras[] = {
        { CAMERA_PINHOLE, 320, 240, { 300, 310, 150, 130 } },
        { CAMERA_SIMPLE_RADIAL, 320, 240, { 300, 160, 120, -0.15 } },
        { CAMERA_OPENCV, 320, 240, { 300, 310, 150, 130, -0.2, 0.05, 0.003, -0.002 } },
        { CAMERA_FULL_OPENCV, 320, 240, { 200, 200, 160, 120, 0.1, 0.02, 0.001, 0.001, 0.01, 0.2, 0.05, 0.01 } },
        { CAMERA_FOV, 320, 240, { 200, 200, 160, 120, 0.9 } },
        { CAMERA_OPENCV_FISHEYE, 320, 240, { 90, 90, 160, 120, 0.02, -0.004, 0.001, 0 } },
        { CAMERA_RADIAL_FISHEYE, 320, 240, { 70, 160, 120, 0, 0 } },
    };
    struct solid car, room;
    solid_box(&car, 4.5, 1.8, 1.5);
    solid_box(&room, 9, 8, 7);
    for (size_t i = 0; i < sizeof cameras / sizeof *cameras; i++) {
        box_through(&cameras[i], place(1, &car.model, 1, 9, 0, 0.7), "ahead");
        box_through(&cameras[i], place(1, &car.model, -3.2, 7, 0, 0.4), "over the border");
        box_through(&cameras[i], place(1, &car.model, 1.6, 1.5, 0, 0.05), "partly behind the camera");
        box_through(&cameras[i], place(1, &room.model, 0.5, 0.2, -2, 0.2), "around the camera");
    }
    solid_free(&car);
    solid_free(&room);
}

/* The outline of a plate by camera_project, against the outline of its mask. */
static void outline(void)
{
    struct error err = ERROR_NONE;
    struct camera camera = { CAMERA_OPENCV, 640, 480, { 500, 505, 310, 250, -0.28, 0.09, 0.002, -0.001 } };
    struct solid plate;
    solid_plate(&plate, 9, 3);
    struct entity e = place(1, &plate.model, 0.4, 10, 0.2, M_PI + 0.3);
    struct frame_labels labels = { 0 };
    OK(trace(&labels, &camera, &e, 1, NULL, 0, &err), "a plate is traced through a distorted lens");
    static bool near_edge[480][640];
    struct pose camera_from_entity = pose_compose(pose_inverse(camera_pose), e.world_from_entity);
    static const double corner[5][2] = { { -4.5, 0 }, { 4.5, 0 }, { 4.5, 3 }, { -4.5, 3 }, { -4.5, 0 } };
    int off = 0, samples = 0;
    for (int k = 0; k < 4; k++)
        for (int i = 0; i <= 8000; i++) {
            double t = i / 8000.0;
            struct vec3 p = vec3(0, corner[k][0] + t * (corner[k + 1][0] - corner[k][0]),
                                 corner[k][1] + t * (corner[k + 1][1] - corner[k][1]));
            struct vec2 q;
            if (!camera_project(&camera, &q, pose_apply(camera_from_entity, p), &err)) continue;
            int x = (int)floor(q.x), y = (int)floor(q.y), inside = 0, outside = 0;
            samples++;
            for (int v = y - 1; v <= y + 1; v++)
                for (int u = x - 1; u <= x + 1; u++) {
                    near_edge[v][u] = true;
                    /* 1 px, and what a pixel's centre can be off a half-disc of that size */
                    if (hypot(u + 0.5 - q.x, v + 0.5 - q.y) > 1.12) continue;
                    *(*image_u16(&labels.instance, u, v) ? &inside : &outside) += 1;
                }
            off += !inside || !outside;
        }
    OK(samples == 4 * 8001, "all of its outline is in the picture");
    OK(off == 0, "within 1 px of each point of the outline the mask has pixels in and out (%d without)", off);
    int stray = 0;
    for (int y = 0; y < 480; y++)
        for (int x = 1; x < 640; x++)
            stray += *image_u16(&labels.instance, x, y) != *image_u16(&labels.instance, x - 1, y) && !near_edge[y][x] &&
                     !near_edge[y][x - 1];
    OK(stray == 0, "and the mask changes nowhere else");
    frame_labels_release(&labels);
    solid_free(&plate);
}

/* Left half of the texture is there, of the right half only the top. */
static void holes(void)
{
    struct error err = ERROR_NONE;
    struct solid plate;
    solid_plate(&plate, 2, 2);
    OK(image_init(&plate.texture, 2, 2, 4, PIXEL_U8, &err), "a texture of 2 x 2");
    memset(plate.texture.data, 255, 16);
    image_u8(&plate.texture, 1, 1)[3] = 127;
    plate.material.base_image = plate.texture;
    struct entity e[2] = { place(1, &plate.model, 0, 10, 0, M_PI), { 0 } };
    struct frame_labels labels = { 0 };
    plate.material.alpha_mode = ALPHA_MASK;
    plate.material.alpha_cutoff = 0.5;
    OK(trace(&labels, &pinhole, e, 1, NULL, 0, &err), "a masked plate is traced");
    OK(labels.entities[0].pixels_amodal == 4800, "a quarter is not there");
    OK(*image_u16(&labels.instance, 161, 121) == 0 && *image_u16(&labels.instance, 159, 121) == 1 &&
           *image_u16(&labels.instance, 161, 119) == 1,
       "the lower right one: v is up");
    frame_labels_release(&labels);

    struct solid solid_behind;
    solid_plate(&solid_behind, 4, 4);
    e[1] = place(2, &solid_behind.model, 0, 20, -1, M_PI);
    OK(trace(&labels, &pinhole, e, 2, NULL, 0, &err) && labels.entities[1].pixels_visible == 1600 &&
           *image_u16(&labels.instance, 161, 121) == 2,
       "what is behind is seen through it");
    frame_labels_release(&labels);

    plate.material.alpha_cutoff = 0.4;
    OK(trace(&labels, &pinhole, e, 1, NULL, 0, &err) && labels.entities[0].pixels_amodal == 6400,
       "a texel of alpha above the cutoff is there");
    frame_labels_release(&labels);
    plate.material.alpha_mode = ALPHA_BLEND;
    image_u8(&plate.texture, 0, 0)[3] = 10;
    OK(trace(&labels, &pinhole, e, 1, NULL, 0, &err) && labels.entities[0].pixels_amodal == 6400,
       "glass counts as the entity");
    frame_labels_release(&labels);
    solid_free(&plate);
    solid_free(&solid_behind);
}

/* A post from x = 140 to 150.25, far above and below the plate. */
static void occluders(void)
{
    struct error err = ERROR_NONE;
    struct solid plate;
    solid_plate(&plate, 2, 2);
    struct entity e = place(5, &plate.model, 0, 10, 0, M_PI);
    static const struct vec2 post[4] = { { 140, 20 }, { 150.25, 20 }, { 150.25, 230 }, { 140, 230 } };
    static const struct vec2 sign[4] = { { 145, 100 }, { 160, 100 }, { 160, 110 }, { 145, 110 } };
    struct occluder before[2] = { { "post", post, 4, { -0.2, 5, 0 } }, { "sign", sign, 4, { 0, 4, 0 } } };
    struct frame_labels labels = { 0 };
    OK(trace(&labels, &pinhole, &e, 1, before, 1, &err), "a plate behind a post is traced");
    struct entity_labels *l = &labels.entities[0];
    OK(l->pixels_amodal == 6400 && l->pixels_visible == 5600,
       "the post hides the 10 x 80 pixels whose centres it covers");
    OK(l->hider_count == 1 && l->hiders[0].id == 0 && !strcmp(l->hiders[0].name, "post") && l->hiders[0].pixels == 800,
       "and is named");
    OK(*image_u16(&labels.instance, 145, 100) == 0 && isnan(*image_f32(&labels.depth, 145, 100)),
       "its pixels are nobody's");
    OK(*image_u8(&labels.visible, 145, 100) == 0, "nothing of the plate is seen there");
    OK(*image_u8(&labels.visible, 150, 100) == 191 && *image_u8(&labels.visible, 151, 100) == 255,
       "two of eight columns of samples hide a quarter of pixel 150");
    OK(*image_u8(&labels.visible, 145, 78) == 0 && *image_u8(&labels.visible, 145, 77) == 255,
       "the plate's edge reaches 2 px beyond it");
    /* The foot is 5 m away, 1 m below: at y = 120 + 400 / 5 = 200. */
    OK(*image_u8(&labels.receiver, 145, 199) == 0 && *image_u8(&labels.receiver, 145, 200) == 255,
       "ground beyond the foot is hidden, before it not");
    OK(*image_u8(&labels.receiver, 145, 119) == 255, "there is no ground above the horizon");
    OK(*image_u8(&labels.receiver, 150, 170) == 191, "and shares of a pixel are as for the plate");
    frame_labels_release(&labels);

    OK(trace(&labels, &pinhole, &e, 1, before, 2, &err), "a plate behind a post and a sign is traced");
    l = &labels.entities[0];
    OK(l->hider_count == 2 && !strcmp(l->hiders[0].name, "post") && l->hiders[0].pixels == 750 &&
           !strcmp(l->hiders[1].name, "sign") && l->hiders[1].pixels == 150,
       "a pixel is hidden by what is nearest, most pixels first");
    OK(l->pixels_visible + 750 + 150 == l->pixels_amodal, "hidden and visible pixels add up");
    frame_labels_release(&labels);

    before[0].foot_m = vec3(-0.2, 12, 0);
    OK(trace(&labels, &pinhole, &e, 1, before, 1, &err), "a plate before a post is traced");
    l = &labels.entities[0];
    OK(l->pixels_visible == 6400 && l->hider_count == 0 && *image_u8(&labels.visible, 145, 100) == 255, "and is whole");
    frame_labels_release(&labels);

    struct solid wide;
    solid_plate(&wide, 8, 8);
    struct entity both[2] = { e, place(6, &wide.model, 0, 40, -3, M_PI) };
    OK(trace(&labels, &pinhole, both, 2, before, 1, &err), "a post between two plates is traced");
    OK(labels.entities[0].pixels_visible == 6400 && labels.entities[1].hider_count == 1 &&
           labels.entities[1].hiders[0].id == 5,
       "it hides neither the one before it, nor what that hides already");
    frame_labels_release(&labels);

    struct frame_labels untouched = { 0 };
    before[0].foot_m = vec3(0, 0, 0);
    OK(!trace(&untouched, &pinhole, &e, 1, before, 1, &err) && err.code == ERR_INPUT && !untouched.instance.data,
       "refuses a post right below the camera: %s", err.text);
    solid_free(&plate);
    solid_free(&wide);
}

static void repeats(void)
{
    struct error err = ERROR_NONE;
    struct camera camera = { CAMERA_OPENCV, 320, 240, { 300, 310, 150, 130, -0.2, 0.05, 0.003, -0.002 } };
    struct solid car;
    solid_box(&car, 4.5, 1.8, 1.5);
    struct entity e[2] = { place(1, &car.model, 1, 9, 0, 0.7), place(2, &car.model, -1, 12, 0, 2) };
    struct frame_labels a = { 0 }, b = { 0 };
    bool ok = trace(&a, &camera, e, 2, NULL, 0, &err) && trace(&b, &camera, e, 2, NULL, 0, &err);
    OK(ok && !memcmp(a.instance.data, b.instance.data, image_size(&a.instance)) &&
           !memcmp(a.depth.data, b.depth.data, image_size(&a.depth)),
       "a second run gives the same bits");
    frame_labels_release(&a);
    frame_labels_release(&b);

    struct model other = car.model;
    const struct model *models[1] = { &other };
    struct tracer *tracer = NULL;
    ok = trace(&a, &camera, e, 1, NULL, 0, &err) && tracer_create(&tracer, models, 1, &err) &&
         trace_frame(&b, tracer, &(struct trace_input){ .camera = &camera, .world_from_camera = camera_pose, .ground = &flat,
                                                        .entities = e, .entity_count = 1 }, &err);
    OK(ok && !memcmp(a.depth.data, b.depth.data, image_size(&a.depth)),
       "a model that the tracer does not hold, posed for one frame, is traced all the same: %s", err.text);
    frame_labels_release(&a);
    frame_labels_release(&b);
    tracer_destroy(tracer);
    solid_free(&car);
}

int main(void)
{
    known_plate();
    overlap();
    truncated();
    lenses();
    outline();
    holes();
    occluders();
    repeats();
    return tap_done();
}
