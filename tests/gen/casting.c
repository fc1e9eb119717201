/* Who plays an entity of a scene: models by short name, by class, by weight; in which colour and detail. */
#include "gen/moment.h"

#include "tests/gen/model_files.h"
#include "tests/tap.h"

#define ENTITIES 600

static const char catalogue[] =
    "{\"models\": ["
    "{\"name\": \"sedan\", \"class\": \"car\", \"file\": \"box.obj\", \"middle\": \"box-middle.obj\", \"far\": \"box-far.obj\", \"unit_m\": 1, \"up\": \"z\","
    " \"front\": \"x\", \"colors\": [{\"color\": \"#ffffff\", \"weight\": 3}, {\"color\": \"#000000\", \"weight\": 2}, {\"color\": \"#ff0000\", \"weight\": 1}]},"
    "{\"name\": \"taxi\", \"class\": \"car\", \"file\": \"box.obj\", \"weight\": 0.5, \"unit_m\": 1, \"up\": \"z\", \"front\": \"x\","
    " \"colors\": [{\"color\": \"#ffff00\", \"weight\": 1}]},"
    "{\"name\": \"van\", \"class\": \"van\", \"file\": \"box.obj\", \"far\": \"box-far.obj\", \"unit_m\": 1, \"up\": \"z\", \"front\": \"x\"},"
    "{\"name\": \"walker\", \"class\": \"person\", \"file\": \"box.obj\", \"unit_m\": 1, \"up\": \"z\", \"front\": \"x\"}]}";

static const char top[] =
    "staffage: 1\n"
    "photographs: {files: [a.png, a.png], rate_hz: 1}\n"
    "camera: {model: PINHOLE, size_px: [1000, 1000], horizontal_fov_deg: 90, pose: {look_at: {position_m: [0, 0, 20], target_m: [0, 100, 20]}}}\n"
    "light: {sky: overcast}\n"
    "ground: {height_m: 0}\n"
    "exposure: {value: 1}\n";

struct play { struct scene *scene; struct stage *stage; struct error err; };
static struct material_rules *rules;

static struct play play(const char *more)
{
    struct play p = { NULL, NULL, ERROR_NONE };
    char *text = string_format("%s%s", top, more), path[600];
    snprintf(path, sizeof path, "%s", put_text("scene.yaml", text));
    if (scene_read(&p.scene, path, NULL, &p.err)) stage_create(&p.stage, p.scene, rules, &p.err);
    free(text);
    return p;
}

static void play_release(struct play *p)
{
    stage_destroy(p->stage);
    scene_destroy(p->scene);
}

/* So many entities beside the camera, all with the same model. */
static char *many(const char *model, int seed)
{
    char *text = NULL;
    size_t size;
    FILE *f = open_memstream(&text, &size);
    fprintf(f, "seed: %d\nentities:\n", seed);
    for (int i = 0; i < ENTITIES; i++)
        fprintf(f, "  - {name: e%d, model: %s, at: {world_m: [%d, %d]}, heading_deg: 0}\n", i, model, 10 * (i % 30), 100 + 10 * (i / 30));
    fclose(f);
    return text;
}

static size_t model_of(const struct play *p, size_t entity) { return p->stage->cast[entity]; }
static bool is(const struct play *p, size_t entity, const char *name) { return !strcmp(p->scene->models[model_of(p, entity)].name, name); }

static double chi_square(const double *seen, const double *share, int n)
{
    double sum = 0;
    for (int i = 0; i < n; i++) sum += pow(seen[i] - share[i] * ENTITIES, 2) / (share[i] * ENTITIES);
    return sum;
}

static void names_need_no_entry(void)
{
    struct play p = play("models: {van: {file: box.obj, unit_m: 1, up: z, front: x, class: bus}}\n"
                         "entities:\n"
                         "  - {name: a, model: sedan, at: {world_m: [0, 30]}, heading_deg: 0}\n"
                         "  - {name: b, model: van, at: {world_m: [10, 30]}, heading_deg: 0}\n"
                         "  - {name: c, model: taxi, class: truck, at: {world_m: [20, 30]}, heading_deg: 0}\n");
    struct moment m;
    if (!OK(p.stage && moment_at(&m, p.stage, 0, &p.err), "models of the folder models beside the scene %s", p.err.text)) return;
    OK(m.entities[0].class_ == CLASS_CAR && !strcmp(m.entities[0].model_name, "sedan"), "a short name has its catalogue's class");
    OK(m.entities[1].class_ == CLASS_BUS, "what the scene has under models goes before the catalogue");
    OK(m.entities[2].class_ == CLASS_TRUCK && m.entities[2].color[0] == 1 && m.entities[2].color[2] == 0, "its own class, its model's one colour");
    OK(m.entities[0].has_color && !m.entities[1].has_color, "painted where the catalogue knows colours");
    moment_release(&m);
    play_release(&p);
}

static void weights_are_kept(void)
{
    char *text = many("{sedan: 3, taxi: 2, any van: 1}", 7), *other = many("{sedan: 3, taxi: 2, any van: 1}", 8), *any = many("any car", 7);
    struct play p = play(text), again = play(text), q = play(other), cars = play(any);
    if (OK(p.stage && again.stage && q.stage && cars.stage, "scenes of many %s %s", p.err.text, cars.err.text)) {
        double seen[3] = { 0 }, car[2] = { 0 }, paint[3] = { 0 };
        size_t same = 0, moved = 0;
        for (size_t i = 0; i < ENTITIES; i++) {
            seen[is(&p, i, "sedan") ? 0 : is(&p, i, "taxi") ? 1 : 2]++;
            car[is(&cars, i, "taxi")]++;
            same += model_of(&p, i) == model_of(&again, i);
            moved += model_of(&p, i) != model_of(&q, i);
            const double *color = stage_color(p.stage, 0, (uint16_t)(i + 1));
            paint[color[0] == 1 && color[1] == 1 ? 0 : color[0] == 1 ? 2 : 1]++;
        }
        OK(chi_square(seen, (const double[]){ 3 / 6.0, 2 / 6.0, 1 / 6.0 }, 3) < 13.8, "weights 3, 2, 1 draw %g, %g, %g", seen[0], seen[1], seen[2]);
        OK(chi_square(car, (const double[]){ 1 / 1.5, 0.5 / 1.5 }, 2) < 10.8, "any car: by the catalogue's weights 1, 0.5: %g, %g", car[0], car[1]);
        OK(chi_square(paint, (const double[]){ 3 / 6.0, 2 / 6.0, 1 / 6.0 }, 3) < 13.8, "paints of weights 3, 2, 1: %g, %g, %g", paint[0], paint[1], paint[2]);
        OK(same == ENTITIES && p.stage->hash == again.stage->hash, "a seed draws the same again");
        OK(moved > ENTITIES / 3 && p.stage->hash != q.stage->hash, "another seed draws others (%zu)", moved);
    }
    play_release(&p);
    play_release(&again);
    play_release(&q);
    play_release(&cars);
    free(text);
    free(other);
    free(any);
}

static size_t shown(const struct stage *stage, size_t model)
{
    size_t n = 0;
    for (size_t i = 0; i < stage->models[model]->mesh_count; i++) n += stage->models[model]->meshes[i].triangles;
    return n;
}

/* f is 500 px: 50 px a metre at 10 m, 15 at 33 m. The boxes are of 12, 10 and 8 triangles. */
static void detail_follows_the_picture(void)
{
    static const struct { double y; size_t want; const char *what; } cases[] = {
        { 12, 12, "23 m away: middle, but it has none: near" }, { 24, 12, "31 m away: the same" }, { 60, 8, "63 m away: far" },
        { -40, 8, "behind the camera: far" } };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char *text = string_format("entities: [{name: v, model: van, at: {world_m: [0, %g]}, heading_deg: 0}]\n", cases[i].y);
        struct play p = play(text);
        if (OK(p.stage, "a van %s", p.err.text)) OK(shown(p.stage, 0) == cases[i].want, "%s (%zu triangles)", cases[i].what, shown(p.stage, 0));
        play_release(&p);
        free(text);
    }
    struct play p = play("entities:\n"
                         "  - {name: far off, model: sedan, at: {world_m: [0, 80]}, heading_deg: 0}\n"
                         "  - {name: nearer, model: sedan, at: {world_m: [0, 20]}, heading_deg: 0}\n");
    OK(p.stage && shown(p.stage, 0) == 10 && p.stage->details[0] == DETAIL_MIDDLE, "the nearest of a model decides for all of them");
    play_release(&p);
    p = play("paths: [{name: road, use: vehicles, width_m: 6, points_m: [[-60, 60], [0, 22], [60, 60]]}]\n"
             "time: 2022-06-01T15:00:00Z\n"
             "traffic: {vehicles: {count: 2, models: [sedan]}}\n");
    OK(p.stage && shown(p.stage, 0) == 10, "of traffic, the nearest that its roads come %s", p.err.text);
    play_release(&p);
}

static void traffic_takes_what_the_scene_leaves(void)
{
    struct play p = play("paths:\n  - {name: road, use: vehicles, width_m: 6, points_m: [[-200, 60], [200, 60]]}\n"
                         "  - {name: walk, use: people, width_m: 3, points_m: [[-60, 70], [60, 70]]}\n"
                         "time: 2022-06-01T15:00:00Z\n"
                         "traffic:\n  vehicles: {count: 20, models: {any car: 1, van: {weight: 2}}, colors: [\"#0000ff\"]}\n"
                         "  people: {count: 2, models: any person}\n");
    struct moment m;
    size_t yellow = 0, blue = 0, vans = 0, cars = 0, people = 0;
    if (!OK(p.stage && moment_at(&m, p.stage, 0, &p.err), "traffic of the catalogue %s", p.err.text)) return;
    for (size_t i = 0; i < m.n; i++) {
        const struct entity *e = &m.entities[i];
        bool taxi = !strcmp(e->model_name, "taxi");
        yellow += taxi && e->color[0] == 1 && e->color[2] == 0;
        blue += !taxi && e->has_color && e->color[2] == 1 && e->color[0] == 0;
        vans += e->class_ == CLASS_VAN;
        cars += e->class_ == CLASS_CAR;
        people += e->class_ == CLASS_PERSON && !e->has_color;
    }
    OK(vans > 0 && cars > 0 && vans + cars == 20 && people == 2, "classes with weights: %zu cars, %zu vans", cars, vans);
    OK(yellow > 0 && yellow + blue == 20, "the scene's paints, but for what comes in one colour only: %zu and %zu", blue, yellow);
    moment_release(&m);
    play_release(&p);
}

static void wrong(const char *more, const char *want)
{
    struct play p = play(more);
    OK(!p.stage && p.err.code == ERR_INPUT && !strcmp(p.err.text, want), "refused: %s", want);
    if (strcmp(p.err.text, want)) printf("# got: %s\n", p.err.text);
    play_release(&p);
}

#define ONE(model) "entities: [{name: a, model: " model ", at: {world_m: [0, 30]}, heading_deg: 0}]\n"

static void what_is_wrong_is_said(void)
{
    wrong(ONE("sedna"), "entity \"a\": unknown model \"sedna\" (did you mean \"sedan\"?)");
    wrong(ONE("zeppelin"), "entity \"a\": unknown model \"zeppelin\" (it must be one of the names under models, or one that staffage models lists)");
    wrong(ONE("any cra"), "entity \"a\": \"any cra\": unknown class (did you mean \"any car\"?)");
    wrong(ONE("any bus"), "entity \"a\": the catalogue has no model of class bus: staffage models lists what it has");
    wrong(ONE("{sedan: 0}"), "entities[0].model.sedan: expected number above 0, found 0");
    wrong(ONE("{sedan: {weight: 1}}"), "entities[0].model.sedan: expected number above 0, found mapping");
    wrong(ONE("[]"), "entity \"a\": names no model");
    wrong(ONE("[sedan, 3, [x]]"), "entities[0].model[2]: expected text, found list of 1");
    wrong("paths: [{name: r, use: vehicles, width_m: 6, points_m: [[0, 30], [60, 30]]}]\ntraffic: {vehicles: {count: 1, models: [walker]}}\n",
            "traffic.vehicles: model \"walker\" is of class person: vehicles only drive here");
    put_text("models/catalogue.json", "{\"models\": 1}");
    wrong(ONE("sedan"), "has no list \"models\"");
    struct play p = play("models: {own: {file: box.obj, unit_m: 1, up: z, front: x, class: car}}\n" ONE("own"));
    OK(p.stage, "a scene that asks for nothing of a catalogue does not mind a broken one %s", p.err.text);
    play_release(&p);
}

int main(void)
{
    static const char far_box[] = "v -2 -1 0\nv 2 -1 0\nv 2 1 0\nv -2 1 0\nv -2 -1 1.5\nv 2 -1 1.5\nv 2 1 1.5\nv -2 1 1.5\n"
                                  "f 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n", floor_[] = "f 4 3 2 1\n", roof[] = "f 5 6 7 8\n";
    struct error err = ERROR_NONE;
    char *rules_path = string_format("%s/templates/materials.rules", getenv("top_srcdir") ? getenv("top_srcdir") : "."), *text;
    if (!OK(mkdtemp(folder) != NULL && material_rules_read(&rules, rules_path, &err), "a folder and rules %s", err.text)) return tap_done();
    put_image("a.png", 90, 90, 90);
    put_text("models/catalogue.json", catalogue);
    put_text("models/box-far.obj", far_box);
    text = string_format("%s%s", far_box, floor_);
    put_text("models/box-middle.obj", text);
    free(text);
    text = string_format("%s%s%s", far_box, floor_, roof);
    put_text("models/box.obj", text);
    put_text("box.obj", text);
    free(text);
    names_need_no_entry();
    weights_are_kept();
    detail_follows_the_picture();
    traffic_takes_what_the_scene_leaves();
    what_is_wrong_is_said();
    material_rules_destroy(rules);
    free(rules_path);
    remove_tree(folder);
    return tap_done();
}
