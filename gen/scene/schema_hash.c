#include "gen/scene/schema.h"

#include "lib/file.h"

#include <stdio.h>
#include <string.h>

static bool is_merging(const struct schema *schema, const char *path)
{
    for (size_t i = 0; i < schema->count; i++)
        if (!strcmp(schema->keys[i].path, path)) return schema->keys[i].merging;
    return false;
}

static uint64_t hash_text(uint64_t hash, const char *text)
{
    return hash_bytes(hash, text, strlen(text) + 1);
}

static uint64_t hash_node(const struct schema *schema, const struct yaml_node *node, const char *path);

/* A sum, for presets stand behind what is given. */
static uint64_t hash_keys(const struct schema *schema, const struct yaml_node *mapping, const char *path)
{
    uint64_t sum = 0;
    for (size_t i = 0; i < mapping->count; i++) {
        const char *key = mapping->keys[i].text;
        char below[256];
        bool known = path && snprintf(below, sizeof below, "%s%s%s", path, *path ? "." : "", key) < (int)sizeof below;
        if (known && is_merging(schema, below)) continue;
        uint64_t value = hash_node(schema, mapping->items[i], known ? below : NULL);
        sum += hash_bytes(hash_text(FILE_HASH_SEED, key), &value, sizeof value);
    }
    return sum;
}

/* In: path  as the schema names it; NULL inside a list, where no key is for merging alone */
static uint64_t hash_node(const struct schema *schema, const struct yaml_node *node, const char *path)
{
    uint64_t hash = hash_bytes(FILE_HASH_SEED, &node->kind, sizeof node->kind), value;
    if (node->kind == YAML_SCALAR) return hash_text(hash, node->text);
    if (node->kind == YAML_MAPPING) {
        value = hash_keys(schema, node, path);
        return hash_bytes(hash, &value, sizeof value);
    }
    for (size_t i = 0; i < node->count; i++) {
        value = hash_node(schema, node->items[i], NULL);
        hash = hash_bytes(hash, &value, sizeof value);
    }
    return hash;
}

uint64_t schema_rendered_hash(const struct schema *schema, const struct yaml_node *root)
{
    return hash_node(schema, root, "");
}
