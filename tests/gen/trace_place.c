/* The static mesh before, behind and below entities. */
#include "gen/trace/trace.h"

#include "tests/gen/place.h"
#include "tests/gen/solid.h"
#include "tests/tap.h"

/* A camera 1 m above the ground at the origin that looks north, level: pixel (160, 120) sees what is straight ahead. */
static const struct pose camera_pose = { { { { 1, 0, 0 }, { 0, 0, 1 }, { 0, -1, 0 } } }, { 0, 0, 1 } };
static const struct camera pinhole = { CAMERA_PINHOLE, 320, 240, { 400, 400, 160, 120 } };

static struct entity facing_south(uint16_t id, const struct model *model, double x, double y, double z)
{
    return (struct entity){ .id = id, .name = "thing", .model_name = "solid", .class_ = CLASS_CAR, .model = model,
                            .world_from_entity = { { { { 0, 1, 0 }, { -1, 0, 0 }, { 0, 0, 1 } } }, { x, y, z } } };
}

/* Trace with the place of `place` (none when it is empty). */
static bool trace(struct frame_labels *labels, struct trace_input in, const struct place *place, bool with_labels)
{
    struct error err = ERROR_NONE;
    const struct model *models[8];
    struct tracer *tracer = NULL;
    struct static_mesh *mesh = NULL;
    for (size_t i = 0; i < in.entity_count; i++) models[i] = in.entities[i].model;
    if (!in.camera) in.camera = &pinhole;
    in.world_from_camera = camera_pose;
    bool ok = tracer_create(&tracer, models, in.entity_count, &err) &&
              (place->triangles == 0 || place_mesh(&mesh, place, with_labels, &err));
    in.place = mesh;
    ok = ok && trace_frame(labels, tracer, &in, &err);
    if (!ok) printf("# %s\n", err.text);
    tracer_destroy(tracer);
    static_mesh_destroy(mesh);
    return ok;
}

static bool sums_up(const struct entity_labels *l)
{
    int64_t sum = l->pixels_visible;
    for (size_t i = 0; i < l->hider_count; i++) sum += l->hiders[i].pixels;
    return sum == l->pixels_amodal;
}

/* A plate 10 m ahead fills the 80 x 80 pixels in the middle; a wall 5 m ahead begins at x = 0, pixel 160. */
static void half_a_wall(void)
{
    struct solid plate;
    solid_plate(&plate, 2, 2);
    struct entity e = facing_south(7, &plate.model, 0, 10, 0);
    struct place wall = { 0 };
    place_wall(&wall, 0, 4, 5, -3, 5, 0);
    struct frame_labels labels = { 0 };
    OK(trace(&labels, (struct trace_input){ .entities = &e, .entity_count = 1 }, &wall, false),
       "half a wall, and no ground");
    struct entity_labels *l = &labels.entities[0];
    OK(l->pixels_visible == 3200 && l->pixels_amodal == 6400 && l->visible_fraction == 0.5, "half the plate is hidden");
    OK(l->hider_count == 1 && l->hiders[0].kind == HIDER_PLACE && l->hiders[0].id == 0 && l->hiders[0].pixels == 3200 &&
           !strcmp(l->hiders[0].name, "place"),
       "by the place");
    OK(l->box_visible_px.x0 == 120 && l->box_visible_px.x1 == 160 && l->box_amodal_px.x1 == 200, "boxes tell them apart");
    OK(fabsf(l->depth_m[40 * 80 + 60] - 10) < 1e-5f, "amodal depth goes on behind the wall");
    int wrong = 0;
    for (int y = 0; y < 240; y++)
        for (int x = 0; x < 320; x++) {
            bool on = x >= 120 && x < 200 && y >= 80 && y < 160, hidden = x >= 160,
                 near = x >= 118 && x < 202 && y >= 78 && y < 162;
            double z = (double)*image_f32(&labels.place_depth, x, y);
            wrong += *image_u16(&labels.instance, x, y) != (on && !hidden ? 7 : 0);
            wrong += isnan(*image_f32(&labels.depth, x, y)) != !(on && !hidden);
            wrong += *image_u8(&labels.visible, x, y) != (near && hidden ? 0 : 255);
            wrong += *image_u8(&labels.receiver, x, y) != 0;
            wrong += hidden ? !(fabs(z - 5) < 1e-5) : !isnan(z);
        }
    OK(wrong == 0, "every pixel of instance, depth, shares and the place's depth (%d wrong)", wrong);
    OK(!labels.place_label.data, "a place without labels has no label image");
    frame_labels_release(&labels);

    place_wall(&wall, -4, 0, 6, -3, 5, 0);
    OK(trace(&labels, (struct trace_input){ .entities = &e, .entity_count = 1 }, &wall, false), "a whole wall");
    l = &labels.entities[0];
    OK(l->in_frame && l->pixels_visible == 0 && l->pixels_amodal == 6400 && l->visible_fraction == 0 && sums_up(l) &&
           l->box_visible_px.x1 == 0 && l->mask_px.x1 - l->mask_px.x0 == 80,
       "what is wholly hidden is in the frame, whole, and not visible");
    frame_labels_release(&labels);

    struct place behind = { 0 };
    place_wall(&behind, -9, 9, 10.5, -3, 5, 0);
    OK(trace(&labels, (struct trace_input){ .entities = &e, .entity_count = 1 }, &behind, false) &&
           labels.entities[0].pixels_visible == 6400 && labels.entities[0].hider_count == 0,
       "a wall behind hides nothing");
    OK(fabsf(*image_f32(&labels.place_depth, 160, 120) - 10.5f) < 1e-5f, "and its depth is there behind the entity");
    frame_labels_release(&labels);
    place_free(&behind);
    place_free(&wall);
    solid_free(&plate);
}

/* The part of the pixel at (x, y) on the side of the line a x + b y > c, by clipping the square. */
static double covered(double a, double b, double c, int x, int y)
{
    static const int side[4][2] = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } };
    double px[8], py[8], area = 0;
    int n = 0;
    for (int i = 0; i < 4; i++) {
        double x0 = x + side[i][0], y0 = y + side[i][1], x1 = x + side[(i + 1) % 4][0], y1 = y + side[(i + 1) % 4][1];
        double d0 = a * x0 + b * y0 - c, d1 = a * x1 + b * y1 - c;
        if (d0 > 0) {
            px[n] = x0;
            py[n++] = y0;
        }
        if ((d0 > 0) != (d1 > 0)) {
            px[n] = x0 + (x1 - x0) * d0 / (d0 - d1);
            py[n++] = y0 + (y1 - y0) * d0 / (d0 - d1);
        }
    }
    for (int i = 0; i < n; i++) area += (px[i] * py[(i + 1) % n] - px[(i + 1) % n] * py[i]) / 2;
    return area;
}

/* An edge that leans: from 3 m below to 5 m above, at y = 5, x from -0.83 m to 0.91 m. */
static void soft_edge(void)
{
    struct solid plate;
    solid_plate(&plate, 2, 2);
    struct entity e = facing_south(7, &plate.model, 0, 10, 0);
    struct place wall = { 0 };
    place_quad(&wall, (const double[4][3]){ { -0.83, 5, -3 }, { 4, 5, -3 }, { 4, 5, 5 }, { 0.91, 5, 5 } }, 0);
    struct frame_labels labels = { 0 }, by_outline = { 0 };
    OK(trace(&labels, (struct trace_input){ .entities = &e, .entity_count = 1 }, &wall, false), "an edge that leans");
    /* 80 px a metre at 5 m: x = 160 + 80 X, y = 200 - 80 Z */
    struct vec2 from = { 160 - 80 * 0.83, 120 + 80 * 4 }, to = { 160 + 80 * 0.91, 120 - 80 * 4 };
    double a = from.y - to.y, b = to.x - from.x, c = a * from.x + b * from.y, square = 0, worst = 0;
    int soft = 0, wrong = 0;
    for (int y = 80; y < 160; y++)
        for (int x = 120; x < 200; x++) {
            double hidden = covered(a, b, c, x, y), off = 1 - *image_u8(&labels.visible, x, y) / 255.0 - hidden;
            if (hidden == 0 || hidden == 1) wrong += fabs(off) > 1e-9;
            else soft++;
            square += hidden == 0 || hidden == 1 ? 0 : off * off;
            worst = fmax(worst, fabs(off));
        }
    OK(wrong == 0, "pixels beside the edge are whole (%d wrong)", wrong);
    OK(soft > 80 && sqrt(square / soft) < 1.0 / 64 && worst < 3.0 / 64,
       "%d pixels on it have the share of their area that is hidden: rms %.4f, at most %.4f", soft, sqrt(square / soft), worst);

    struct vec2 outline[4] = { from, { 160 + 320, 440 }, { 160 + 320, -200 }, to };
    struct occluder same = { "outline", outline, 4, { 0, 5, 0 } };
    struct place none = { 0 };
    static const struct plane flat = { { 0, 0, 1 }, 0 };
    struct trace_input in = { .entities = &e, .entity_count = 1, .ground = &flat, .occluders = &same, .occluder_count = 1 };
    OK(trace(&by_outline, in, &none, false), "the same edge as an outline in the photograph");
    OK(!memcmp(by_outline.visible.data, labels.visible.data, image_size(&labels.visible)) &&
           labels.entities[0].pixels_visible == by_outline.entities[0].pixels_visible,
       "gives the same shares, bit for bit");
    frame_labels_release(&by_outline);

    /* Both: a wall from the left up to pixel 150.5, and the outline. */
    struct place left = { 0 };
    place_wall(&left, -4, -9.5 / 80, 5, -3, 5, 0);
    wrong = 0;
    OK(trace(&by_outline, in, &left, false), "a wall and an outline");
    for (int y = 80; y < 160; y++)
        for (int x = 120; x < 200; x++) {
            int alone = *image_u8(&labels.visible, x, y), wall_ = x < 150 ? 0 : x == 150 ? 128 : 255,
                both = *image_u8(&by_outline.visible, x, y);
            wrong += wall_ == 0 ? both != 0 : wall_ == 255 ? both != alone : both > alone || both > wall_ || (alone == 255 && both != wall_);
        }
    OK(wrong == 0 && sums_up(&by_outline.entities[0]) && by_outline.entities[0].hider_count == 2,
       "what one of them leaves the other can take (%d wrong)", wrong);
    place_free(&left);
    frame_labels_release(&by_outline);
    frame_labels_release(&labels);

    /* Through a lens the wall's straight edge is bent; what is hidden stays the same part of the plate. */
    struct camera lens = { CAMERA_OPENCV, 320, 240, { 400, 400, 160, 120, -0.35, 0.08, 0.004, -0.003 } };
    OK(trace(&labels, (struct trace_input){ .camera = &lens, .entities = &e, .entity_count = 1 }, &wall, false), "through a lens");
    square = worst = 0;
    soft = 0;
    for (int y = 90; y < 150; y++)
        for (int x = 130; x < 190; x++) {
            int hidden = 0;
            for (int k = 0; k < 32 * 32; k++) {
                struct error err = ERROR_NONE;
                struct vec3 d = { 0 };
                camera_unproject(&lens, &d, (struct vec2){ x + (k % 32 + 0.5) / 32, y + (k / 32 + 0.5) / 32 }, &err);
                hidden += a * (160 + 400 * d.x / d.z) + b * (120 + 400 * d.y / d.z) > c;
            }
            double off = 1 - *image_u8(&labels.visible, x, y) / 255.0 - hidden / 1024.0;
            worst = fmax(worst, fabs(off));
            if (hidden == 0 || hidden == 1024) continue;
            square += off * off;
            soft++;
        }
    OK(soft > 50 && sqrt(square / soft) < 1.0 / 64 && worst < 3.0 / 64, "the edge is bent: rms %.4f, at most %.4f",
       sqrt(square / soft), worst);
    frame_labels_release(&labels);
    place_free(&wall);
    solid_free(&plate);
}

/* A car-sized box seen at three degrees, on a mesh that lies as high as `lift_m` over its ground. */
static bool on_road(struct frame_labels *labels, const struct entity *e, double lift_m)
{
    struct place road = { 0 };
    place_ground(&road, lift_m, 0);
    bool ok = trace(labels, (struct trace_input){ .entities = e, .entity_count = 1 }, &road, false);
    place_free(&road);
    return ok;
}

static void road_below(void)
{
    struct solid box;
    solid_box(&box, 4.5, 1.8, 1.5);
    struct entity e = facing_south(7, &box.model, 1, 20, 0);
    struct frame_labels alone = { 0 }, labels = { 0 };
    struct place none = { 0 };
    OK(trace(&alone, (struct trace_input){ .entities = &e, .entity_count = 1 }, &none, false) &&
           alone.entities[0].pixels_visible > 800,
       "a box seen at three degrees");
    static const double lift[3] = { 0, 0.012, 0.025 };
    for (int i = 0; i < 3; i++) {
        OK(on_road(&labels, &e, lift[i]), "on a road %g m higher", lift[i]);
        bool open = true;
        for (int y = 0; y < 240; y++)
            for (int x = 0; x < 320; x++) open = open && *image_u8(&labels.visible, x, y) == 255;
        OK(!memcmp(labels.instance.data, alone.instance.data, image_size(&alone.instance)) &&
               labels.entities[0].hider_count == 0,
           "its mask is that on a plane");
        OK(open, "and nothing of it or of its edge is hidden");
        frame_labels_release(&labels);
    }
    /* At 20 m a pixel is 5 cm high: 0.15 m of road take three rows. */
    OK(on_road(&labels, &e, 0.15) && labels.entities[0].hider_count == 1 && sums_up(&labels.entities[0]), "sunk into it");
    int64_t hidden = labels.entities[0].pixels_amodal - labels.entities[0].pixels_visible, row = 40; /* 1.8 m at 17.75 m */
    OK(hidden > 2 * row && hidden < 5 * row, "it loses its lowest rows (%ld pixels)", (long)hidden);
    frame_labels_release(&labels);

    struct place walls = { 0 };
    place_ground(&walls, 0, 0);
    place_wall(&walls, -5, 5, 17.5, 0, 0.3, 0); /* 0.25 m before the box */
    OK(trace(&labels, (struct trace_input){ .entities = &e, .entity_count = 1 }, &walls, false) &&
           labels.entities[0].pixels_amodal - labels.entities[0].pixels_visible > 5 * row,
       "a kerb close before it hides it");
    frame_labels_release(&labels);
    place_free(&walls);

    /* As far away as a pixel is 0.4 m: the road before its edge would hide that if it were held against the rays beside it. */
    struct entity far_ = facing_south(7, &box.model, 0, 160, 0);
    OK(on_road(&labels, &far_, 0.01), "a box 160 m away");
    bool open = true;
    for (int y = 0; y < 240; y++)
        for (int x = 0; x < 320; x++) open = open && *image_u8(&labels.visible, x, y) == 255;
    OK(open && labels.entities[0].pixels_amodal > 10 && labels.entities[0].hider_count == 0, "keeps its edge");
    frame_labels_release(&labels);
    frame_labels_release(&alone);
    solid_free(&box);
}

/* Does the ground seen at a position lie in the receiver? */
static bool ground_sample(double x, double y)
{
    double below = y - 120;
    if (below <= 0) return false;
    double gy = 400 / below, gx = (x - 160) / below;
    return gx >= -1.03 && gx <= 1.57 && gy >= 4 && gy <= 12;
}

static void receivers(void)
{
    struct solid plate;
    solid_plate(&plate, 2, 2);
    struct entity e = facing_south(7, &plate.model, 0, 10, 0);
    static const struct vec2 corner[4] = { { -1.03, 4 }, { 1.57, 4 }, { 1.57, 12 }, { -1.03, 12 } },
                             off[4] = { { -1, 104 }, { 1, 104 }, { 1, 112 }, { -1, 112 } };
    struct prism prisms[2] = { { off, 4, 0, { 0, 0, 1 }, -1, 1 }, { corner, 4, 0, { 0, 0, 1 }, -0.5, 0.5 } };
    for (int with_wall = 0; with_wall < 2; with_wall++) {
        struct place place = { 0 };
        place_ground(&place, 0, 0);
        if (with_wall) place_wall(&place, 0, 9, 5, 0.6, 5, 0); /* what is in the prism of it would receive */
        if (with_wall) place_wall(&place, 0, 9, 3.9, 0, 0.7, 0);
        struct frame_labels labels = { 0 };
        struct trace_input in = { .entities = &e, .entity_count = 1, .receivers = prisms, .receiver_count = 2 };
        OK(trace(&labels, in, &place, false), with_wall ? "with walls before it" : "a receiver on the ground");
        int wrong = 0, soft = 0;
        for (int y = 0; y < 240; y++)
            for (int x = 0; x < 320; x++) {
                int samples = 0;
                for (int k = 0; k < 64; k++) {
                    double sx = x + (k % 8 + 0.5) / 8, sy = y + (k / 8 + 0.5) / 8;
                    /* walls: 3.9 m away up to z 0.7, 5 m away from z 0.6 on */
                    bool low = with_wall && sx >= 160 && 3.9 * (sy - 120) / 400 >= 0.3 && 3.9 * (sy - 120) / 400 <= 1,
                         high = with_wall && sx >= 160 && 5 * (sy - 120) / 400 <= 0.4;
                    samples += !low && !high && ground_sample(sx, sy);
                }
                int want = (int)lround(255.0 * samples / 64), got = *image_u8(&labels.receiver, x, y);
                soft += want > 0 && want < 255;
                if (abs(got - want) > 4) wrong++;
            }
        OK(wrong == 0 && soft > 50, "a pixel's share is that of its samples whose first hit is in a receiver (%d wrong, %d soft)",
           wrong, soft);
        frame_labels_release(&labels);
        place_free(&place);
    }

    /* Swept along a leaning axis: 45 degrees to the east. A wall at x = 1.25 of height 2 lies within from z 0.25 to 2. */
    struct place place = { 0 };
    place_quad(&place, (const double[4][3]){ { -3, 8, -2 }, { 5, 8, -2 }, { 5, 8, 5 }, { -3, 8, 5 } }, 0);
    static const struct vec2 square[4] = { { -1, 7 }, { 1, 7 }, { 1, 9 }, { -1, 9 } };
    double h = sqrt(0.5);
    struct prism leaning = { square, 4, 0, { h, 0, h }, 0, 2 };
    struct frame_labels labels = { 0 };
    OK(trace(&labels, (struct trace_input){ .receivers = &leaning, .receiver_count = 1 }, &place, false), "a leaning receiver");
    int wrong = 0;
    for (int y = 0; y < 240; y++)
        for (int x = 0; x < 320; x++) {
            double wx = (x + 0.5 - 160) / 50, wz = 1 - (y + 0.5 - 120) / 50, border = 0.03;
            double in = fmin(fmin(wz, 2 - wz), 1 - fabs(wx - wz));
            int got = *image_u8(&labels.receiver, x, y);
            wrong += in > border ? got != 255 : in < -border ? got != 0 : 0;
        }
    OK(wrong == 0, "leans (%d wrong)", wrong);
    frame_labels_release(&labels);
    place_free(&place);
    solid_free(&plate);
}

static void face_labels(void)
{
    struct place place = { 0 };
    place_wall(&place, -4, 0, 5, 1, 5, 3);
    place_wall(&place, 0, 4, 6, 1, 5, 200);
    place_wall(&place, -4, 4, 7, -9, 1, 0);
    struct frame_labels labels = { 0 };
    OK(trace(&labels, (struct trace_input){ .receiver_count = 0 }, &place, true), "a place with labels");
    int wrong = 0;
    for (int y = 0; labels.place_label.data && y < 240; y++)
        for (int x = 0; x < 320; x++)
            wrong += *image_u8(&labels.place_label, x, y) != (y >= 120 ? 0 : x < 160 ? 3 : 200);
    OK(labels.place_label.data && wrong == 0, "each pixel has its face's (%d wrong)", wrong);
    frame_labels_release(&labels);
    place_free(&place);
}

/* Many things before and behind each other. */
static void all_sums(void)
{
    struct solid box, egg;
    solid_box(&box, 2, 1.5, 1.2);
    solid_egg(&egg, 1.5, 1.5, 2, 16);
    struct place place = { 0 };
    place_ground(&place, 0, 0);
    for (int i = 0; i < 9; i++) place_wall(&place, -4 + i, -3.4 + i, 6 + 1.0 * (i * 5 % 9), 0, 1.5, 0);
    struct entity entities[6];
    for (uint16_t i = 0; i < 6; i++)
        entities[i] = facing_south((uint16_t)(i + 1), i % 2 ? &egg.model : &box.model, -3 + 1.1 * i, 8 + 3.0 * (i * 2 % 5), 0);
    static const struct vec2 outline[3] = { { 60, 90 }, { 250, 130 }, { 90, 170 } };
    struct occluder bush = { "bush", outline, 3, { 0, 7, 0 } };
    struct trace_input in = { .entities = entities, .entity_count = 6, .occluders = &bush, .occluder_count = 1 };
    struct frame_labels labels = { 0 };
    OK(trace(&labels, in, &place, false), "a crowded place");
    bool ok = true;
    int by_place = 0, by_outline = 0, by_entity = 0;
    for (size_t i = 0; i < 6; i++) {
        const struct entity_labels *l = &labels.entities[i];
        struct rect v = l->box_visible_px, a = l->box_amodal_px;
        ok = ok && l->in_frame && sums_up(l) && (l->pixels_visible == 0 || (v.x0 >= a.x0 && v.x1 <= a.x1 && v.y0 >= a.y0 && v.y1 <= a.y1));
        int64_t owned = 0;
        for (int y = 0; y < 240; y++)
            for (int x = 0; x < 320; x++) owned += *image_u16(&labels.instance, x, y) == i + 1;
        ok = ok && owned == l->pixels_visible;
        for (size_t k = 0; k < l->hider_count; k++) {
            by_place += l->hiders[k].kind == HIDER_PLACE;
            by_outline += l->hiders[k].kind == HIDER_OCCLUDER;
            by_entity += l->hiders[k].kind == HIDER_ENTITY;
        }
    }
    OK(ok && by_place > 2 && by_outline > 0 && by_entity > 0, "visible pixels and those of all that hides add up (%d, %d, %d)",
       by_place, by_outline, by_entity);
    frame_labels_release(&labels);
    place_free(&place);
    solid_free(&box);
    solid_free(&egg);
}

int main(void)
{
    half_a_wall();
    soft_edge();
    road_below();
    receivers();
    face_labels();
    all_sums();
    return tap_done();
}
