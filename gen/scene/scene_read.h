/* What the readers of a scene's sections share. Each reads its part of a tree that fits the schema and
 * returns false with the error set. */
#ifndef STAFFAGE_GEN_SCENE_READ_H
#define STAFFAGE_GEN_SCENE_READ_H

#include "gen/scene/scene.h"
#include "gen/scene/schema.h"
#include "gen/scene/yaml.h"
#include "lib/error.h"

/* The catalogue, read when the first name is looked up in it. */
struct scene_library { const char *const *folders; struct catalogue *catalogue; };
struct reading {
    struct scene *scene;
    const char *path;
    const struct yaml_node *root;
    struct scene_library *library;
    struct error *err;
};

#define FAIL(r, node, ...) \
    error_at((r)->err, ERR_INPUT, (r)->path, (node)->line, (node)->column, __VA_ARGS__)

static inline double rad_from_deg(double deg) { return deg * M_PI / 180; }
static inline struct source source_of(const struct yaml_node *node) { return (struct source){ node->line, node->column }; }
static inline bool out_of_memory(const struct reading *r) { return error_set(r->err, ERR_MEMORY, "no memory for a scene"); }
static inline double number_at(const struct yaml_node *mapping, const char *key)
{
    return schema_number(yaml_get(mapping, key));
}

bool scene_copy_text(const struct reading *r, char **text, const struct yaml_node *node);
/* Resolved against the scene file. */
bool scene_copy_path(const struct reading *r, char **path, const struct yaml_node *node);
/* "#rrggbb", three linear numbers, or one for all. */
void scene_read_color(double linear[3], const struct yaml_node *node);
/* A key that the user gave and that nothing would come of is a misunderstanding. In: keys, NULL at the end */
bool scene_refuse_given(const struct reading *r, const struct yaml_node *mapping, const char *const *keys,
                        const char *section, const char *why);

/* After place and time: photographs and camera, or cameras and shots. */
bool scene_read_shots(const struct reading *r, const struct yaml_node *root);
/* After the ground: north, where a shadow tells it. */
bool scene_read_north(const struct reading *r, const struct yaml_node *root);
bool scene_read_light(const struct reading *r, const struct yaml_node *node);
bool scene_read_static(const struct reading *r, const struct yaml_node *root);
bool scene_read_ground(const struct reading *r, const struct yaml_node *node);
/* After light and static. */
bool scene_read_surroundings(const struct reading *r, const struct yaml_node *node);
bool scene_read_exposure(const struct reading *r, const struct yaml_node *node);
/* Models first, then entities and occluders; traffic needs models, too. */
bool scene_read_models(const struct reading *r, const struct yaml_node *node);
bool scene_read_entities(const struct reading *r, const struct yaml_node *node);
bool scene_read_occluders(const struct reading *r, const struct yaml_node *node);
bool scene_read_roads(const struct reading *r, const struct yaml_node *root);
bool scene_read_traffic(const struct reading *r, const struct yaml_node *node);
/* A name of a model, "any CLASS", a list of these, or each with its weight.
 * In: who wants it, for the error */
bool scene_read_choice(const struct reading *r, struct scene_choice *choice, const struct yaml_node *node, const char *who);
/* What is outside of the camera's picture may be so because that has another shape than the photograph: then that is the error.
 * True where the shape is the same, or the photograph cannot be read: the caller's own error is the right one. */
bool scene_shape_fits(const struct reading *r, size_t shot);
/* Does a pixel position lie in the picture of a shot? In: who, for the error */
bool scene_check_pixel(const struct reading *r, struct vec2 q_px, size_t shot, const struct yaml_node *node,
                       const char *who);

#endif
