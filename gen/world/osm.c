#include "gen/world/osm.h"

#include "lib/file.h"

#include <inttypes.h>
#include <math.h>
#include <readosm.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#ifdef __SANITIZE_ADDRESS__
/* readosm 1.1.0 forgets its XML parser when the file is at fault. */
const char *__lsan_default_suppressions(void);
const char *__lsan_default_options(void);
const char *__lsan_default_suppressions(void) { return "leak:libexpat\n"; }
const char *__lsan_default_options(void) { return "print_suppressions=0"; }
#endif

struct reader {
    struct osm osm;
    size_t node_room, way_room;
    const char *path;
    struct error *err;
};

/* Room for one more. NULL without memory: the array stays as it is. */
static void *grown(void *array, size_t count, size_t *room, size_t size)
{
    if (count < *room) return array;
    size_t more = *room ? 2 * *room : 64;
    void *bigger = realloc(array, more * size);
    if (bigger) *room = more;
    return bigger;
}

/* Where the way stands in an XML file, or 0: the library does not tell. */
static int way_line(const char *path, int64_t id)
{
    const char *end = strrchr(path, '.');
    char *text = NULL;
    size_t size;
    struct error ignored = ERROR_NONE;
    if (!end || strcmp(end, ".osm") != 0 || !file_read(&text, &size, path, &ignored)) return 0;
    char wanted[2][40];
    snprintf(wanted[0], sizeof wanted[0], " id=\"%" PRId64 "\"", id);
    snprintf(wanted[1], sizeof wanted[1], " id='%" PRId64 "'", id);
    int line = 0, here = 1;
    const char *counted = text;
    for (char *way = strstr(text, "<way "); way && !line; way = strstr(way + 1, "<way ")) {
        char *close = strchr(way, '>');
        if (close) *close = 0;
        for (; counted < way; counted++) here += *counted == '\n';
        if (strstr(way, wanted[0]) || strstr(way, wanted[1])) line = here;
        if (close) *close = '>';
    }
    free(text);
    return line;
}

static int out_of_memory(struct reader *r)
{
    error_set(r->err, ERR_MEMORY, "no memory for the nodes and ways of %s", r->path);
    return READOSM_ABORT;
}

static int take_node(const void *user_data, const readosm_node *node)
{
    struct reader *r = (struct reader *)user_data;
    struct osm_node *nodes = grown(r->osm.nodes, r->osm.node_count, &r->node_room, sizeof *nodes);
    if (!nodes) return out_of_memory(r);
    r->osm.nodes = nodes;
    nodes[r->osm.node_count++] = (struct osm_node){ node->id, node->latitude, node->longitude };
    return READOSM_OK;
}

static bool way_copy(struct osm_way *copy, const readosm_way *way)
{
    size_t nodes = (size_t)way->node_ref_count, tags = (size_t)way->tag_count;
    *copy = (struct osm_way){ .id = way->id, .node_count = nodes, .node_ids = malloc(nodes * sizeof *copy->node_ids),
                              .tags = calloc(tags, sizeof *copy->tags) };
    if (!copy->node_ids || !copy->tags) return false;
    for (size_t i = 0; i < nodes; i++) copy->node_ids[i] = way->node_refs[i];
    for (; copy->tag_count < tags; copy->tag_count++) {
        struct osm_tag *tag = &copy->tags[copy->tag_count];
        *tag = (struct osm_tag){ strdup(way->tags[copy->tag_count].key), strdup(way->tags[copy->tag_count].value) };
        if (tag->key && tag->value) continue;
        free(tag->key);
        free(tag->value);
        return false;
    }
    return true;
}

static void way_release(struct osm_way *way)
{
    for (size_t i = 0; i < way->tag_count; i++) {
        free(way->tags[i].key);
        free(way->tags[i].value);
    }
    free(way->tags);
    free(way->node_ids);
}

static int take_way(const void *user_data, const readosm_way *way)
{
    struct reader *r = (struct reader *)user_data;
    if (way->node_ref_count < 1) {
        error_at(r->err, ERR_INPUT, r->path, way_line(r->path, way->id), 0,
                 "way %lld has no nodes: a way is a line through 2 or more", way->id);
        return READOSM_ABORT;
    }
    bool is_highway = false;
    for (int i = 0; i < way->tag_count; i++) is_highway = is_highway || !strcmp(way->tags[i].key, "highway");
    if (!is_highway) return READOSM_OK;
    struct osm_way *ways = grown(r->osm.ways, r->osm.way_count, &r->way_room, sizeof *ways), copy;
    if (!ways) return out_of_memory(r);
    r->osm.ways = ways;
    if (!way_copy(&copy, way)) {
        way_release(&copy);
        return out_of_memory(r);
    }
    ways[r->osm.way_count++] = copy;
    return READOSM_OK;
}

static int by_id(const void *a, const void *b)
{
    int64_t x = ((const struct osm_node *)a)->id, y = ((const struct osm_node *)b)->id;
    return (x > y) - (x < y);
}

static bool way_check(const struct osm *osm, const struct osm_way *way, const char *path, struct error *err)
{
    if (way->node_count < 2)
        return error_at(err, ERR_INPUT, path, way_line(path, way->id), 0,
                        "way %" PRId64 " has one node, %" PRId64 ": a way is a line through 2 or more", way->id,
                        way->node_ids[0]);
    for (size_t i = 0; i < way->node_count; i++) {
        const struct osm_node *node = osm_node(osm, way->node_ids[i]);
        if (!node)
            return error_at(err, ERR_INPUT, path, way_line(path, way->id), 0,
                            "way %" PRId64 " names node %" PRId64 ", which the file does not have: "
                            "extract the area with whole ways", way->id, way->node_ids[i]);
        if (!(fabs(node->latitude_deg) <= 90 && fabs(node->longitude_deg) <= 180))
            return error_at(err, ERR_INPUT, path, way_line(path, way->id), 0,
                            "way %" PRId64 " names node %" PRId64 ", which has no place: lat is -90 to 90 and "
                            "lon -180 to 180 deg", way->id, way->node_ids[i]);
    }
    return true;
}

static bool library_error(int status, const char *path, struct error *err)
{
    switch (status) {
    case READOSM_INVALID_SUFFIX:
        return error_at(err, ERR_INPUT, path, 0, 0,
                        "a map is told by its name: .osm is OpenStreetMap XML, .osm.pbf the binary form");
    case READOSM_XML_ERROR:
        return error_at(err, ERR_INPUT, path, 0, 0, "not XML, or cut off: the XML of OpenStreetMap ends with </osm>");
    case READOSM_INVALID_PBF_HEADER:
    case READOSM_UNZIP_ERROR:
        return error_at(err, ERR_INPUT, path, 0, 0, "not a PBF file of OpenStreetMap, or cut off or damaged");
    case READOSM_INSUFFICIENT_MEMORY: return error_set(err, ERR_MEMORY, "no memory to read %s", path);
    default: return error_at(err, ERR_IO, path, 0, 0, "cannot be read");
    }
}

bool osm_read(struct osm *osm, const char *path, struct error *err)
{
    struct stat about;
    if (stat(path, &about) != 0) return error_at(err, ERR_INPUT, path, 0, 0, "there is no such file");
    if (!S_ISREG(about.st_mode)) return error_at(err, ERR_INPUT, path, 0, 0, "this is no file: a map is .osm or .osm.pbf");

    struct reader r = { .path = path, .err = err };
    const void *handle = NULL;
    bool good = false;
    int status = readosm_open(path, &handle);
    if (status == READOSM_OK) status = readosm_parse(handle, &r, take_node, take_way, NULL);
    if (status != READOSM_OK) {
        library_error(status, path, err);
        goto out;
    }
    if (r.osm.node_count == 0) {
        error_at(err, ERR_INPUT, path, 0, 0, "no node is in it: this is no map of OpenStreetMap");
        goto out;
    }
    qsort(r.osm.nodes, r.osm.node_count, sizeof *r.osm.nodes, by_id);
    for (size_t i = 0; i < r.osm.way_count; i++)
        if (!way_check(&r.osm, &r.osm.ways[i], path, err)) goto out;
    *osm = r.osm;
    r.osm = (struct osm){ 0 };
    good = true;
out:
    if (handle) readosm_close(handle);
    osm_release(&r.osm);
    return good;
}

void osm_release(struct osm *osm)
{
    for (size_t i = 0; i < osm->way_count; i++) way_release(&osm->ways[i]);
    free(osm->ways);
    free(osm->nodes);
    *osm = (struct osm){ 0 };
}

const struct osm_node *osm_node(const struct osm *osm, int64_t id)
{
    struct osm_node key = { .id = id };
    return bsearch(&key, osm->nodes, osm->node_count, sizeof key, by_id);
}

const char *osm_tag(const struct osm_way *way, const char *key)
{
    for (size_t i = 0; i < way->tag_count; i++)
        if (strcmp(way->tags[i].key, key) == 0) return way->tags[i].value;
    return NULL;
}
