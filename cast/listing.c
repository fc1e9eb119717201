#include "cast/listing.h"

#include "lib/file.h"

#include <jansson.h>
#include <stdlib.h>
#include <string.h>

#define LICENSE "CC0-1.0"

static void put(json_t *object, const char *key, json_t *value, bool given)
{
    if (given) json_object_set_new(object, key, value);
    else json_decref(value);
}
static void put_text(json_t *object, const char *key, const char *text) { put(object, key, json_string(text ? text : ""), text); }
static void put_number(json_t *object, const char *key, double value) { put(object, key, json_real(value), value > 0); }

static json_t *colors_of(const struct listed *model)
{
    json_t *colors = json_array();
    for (size_t i = 0; i < model->color_count; i++)
        json_array_append_new(colors, json_pack("{s:s, s:f}", "color", model->colors[i].color, "weight", model->colors[i].weight));
    return colors;
}

bool listing_add(struct listing *listing, const struct listed *m, struct error *err)
{
    json_t *entry = json_object(), *animations = json_array(), *triangles = json_array();
    put_text(entry, "name", m->name);
    put_text(entry, "class", m->class_);
    put_text(entry, "kind", m->kind);
    put_text(entry, "file", m->file);
    put_text(entry, "middle", m->middle);
    put_text(entry, "far", m->far);
    put_number(entry, "weight", m->weight);
    put_number(entry, "length_m", m->length_m);
    put_number(entry, "width_m", m->width_m);
    put_number(entry, "height_m", m->height_m);
    put_number(entry, "wheelbase_m", m->wheelbase_m);
    put_number(entry, "track_m", m->track_m);
    put_number(entry, "clearance_m", m->clearance_m);
    put_number(entry, "wheel_diameter_m", m->wheel_diameter_m);
    for (int i = 0; i < 3 && m->triangles[i]; i++) json_array_append_new(triangles, json_integer((json_int_t)m->triangles[i]));
    put(entry, "triangles", triangles, json_array_size(triangles) > 0);
    for (size_t i = 0; m->animations && m->animations[i]; i++) json_array_append_new(animations, json_string(m->animations[i]));
    put(entry, "animations", animations, json_array_size(animations) > 0);
    put(entry, "colors", colors_of(m), m->color_count > 0);
    put_text(entry, "license", LICENSE);
    put_text(entry, "source", m->source);
    if (!listing->models) listing->models = json_array();
    return json_array_append_new(listing->models, entry) == 0 || error_set(err, ERR_MEMORY, "no memory for the catalogue");
}

bool listing_append(struct listing *listing, struct listing *from, struct error *err)
{
    if (!listing->models) listing->models = json_array();
    bool ok = !from->models || json_array_extend(listing->models, from->models) == 0;
    listing_release(from);
    return ok || error_set(err, ERR_MEMORY, "no memory for the catalogue");
}

bool listing_write(const struct listing *listing, const char *folder, struct error *err)
{
    json_t *root = json_pack("{s:O*}", "models", listing->models);
    char *text = root ? json_dumps(root, JSON_INDENT(2) | JSON_REAL_PRECISION(6)) : NULL, *path = string_format("%s/catalogue.json", folder);
    bool ok = text && path ? file_write(path, text, strlen(text), err) : error_set(err, ERR_MEMORY, "no memory for the catalogue");
    free(path);
    free(text);
    json_decref(root);
    return ok;
}

void listing_release(struct listing *listing)
{
    json_decref(listing->models);
    *listing = (struct listing){ 0 };
}
