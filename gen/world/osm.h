/* What an OpenStreetMap file (.osm XML or .osm.pbf) knows of highways: its nodes, and the ways tagged
 * highway=*, whatever their kind. */
#ifndef STAFFAGE_GEN_OSM_H
#define STAFFAGE_GEN_OSM_H

#include "lib/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct osm_node { int64_t id; double latitude_deg, longitude_deg; };
struct osm_tag { char *key, *value; };
struct osm_way {
    int64_t id;
    int64_t *node_ids;    /* (node_count) */
    size_t node_count;
    struct osm_tag *tags; /* (tag_count) */
    size_t tag_count;
};
struct osm {
    struct osm_node *nodes; /* (node_count) by id */
    size_t node_count;
    struct osm_way *ways;   /* (way_count) in the file's order */
    size_t way_count;
};

/* Out: *osm, whose highways have two nodes or more, all of them in the file and somewhere on earth;
 *      free with osm_release
 * Err: ERR_INPUT at path, with the way's line in XML: broken or cut off, a way without nodes, a
 *      highway that names a node which the file does not have or which has no place */
bool osm_read(struct osm *osm, const char *path, struct error *err);
void osm_release(struct osm *osm);

/* NULL where there is none. */
const struct osm_node *osm_node(const struct osm *osm, int64_t id);
const char *osm_tag(const struct osm_way *way, const char *key);

#endif
