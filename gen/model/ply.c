#include "gen/model/ply.h"

#include "gen/model/number.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

static const struct { const char *names[2]; size_t size; } types[PLY_TYPE_COUNT] = {
    [PLY_INT8] = { { "char", "int8" }, 1 },       [PLY_UINT8] = { { "uchar", "uint8" }, 1 },
    [PLY_INT16] = { { "short", "int16" }, 2 },    [PLY_UINT16] = { { "ushort", "uint16" }, 2 },
    [PLY_INT32] = { { "int", "int32" }, 4 },      [PLY_UINT32] = { { "uint", "uint32" }, 4 },
    [PLY_FLOAT32] = { { "float", "float32" }, 4 }, [PLY_FLOAT64] = { { "double", "float64" }, 8 },
};

#define FAIL(...) error_at(err, ERR_INPUT, ply->path, 0, 0, __VA_ARGS__)

static bool find_type(enum ply_type *type, const char *name)
{
    for (int i = 0; i < PLY_TYPE_COUNT; i++)
        if (!strcmp(name, types[i].names[0]) || !strcmp(name, types[i].names[1])) {
            *type = (enum ply_type)i;
            return true;
        }
    return false;
}

static bool read_property(struct ply *ply, const char *line, struct error *err)
{
    char count[16] = "", type[16] = "";
    struct ply_element *e = ply->element_count ? &ply->elements[ply->element_count - 1] : NULL;
    struct ply_property p = { .name = "" };
    p.is_list = sscanf(line, "property list %15s %15s %31s", count, type, p.name) == 3;
    if (!p.is_list && sscanf(line, "property %15s %31s", type, p.name) != 2) return FAIL("the PLY header has a property without type and name");
    if (!e || e->property_count == PLY_PROPERTIES) return FAIL("the PLY header has properties of no element, or more than %d", PLY_PROPERTIES);
    if (!find_type(&p.type, type)) return FAIL("the PLY header has a property of unknown type \"%s\"", type);
    if (p.is_list && (!find_type(&p.count_type, count) || p.count_type >= PLY_FLOAT32)) return FAIL("the PLY header counts a list in \"%s\"", count);
    e->properties[e->property_count++] = p;
    return true;
}

bool ply_open(struct ply *ply, const char *path, const char *data, size_t size, struct error *err)
{
    *ply = (struct ply){ .path = path, .at = data, .end = data + size };
    if (strncmp(data, "ply", 3) != 0 || !data[3] || !strchr("\r\n", data[3])) return FAIL("is no PLY file: it has no header");
    for (const char *line = data; (line = strchr(line, '\n')) && *++line;) {
        char word[32] = "";
        sscanf(line, "%31s", word);
        if (!strcmp(word, "format")) {
            ply->binary = !strncmp(line, "format binary", 13);
            ply->big_endian = !strncmp(line, "format binary_big", 17);
        } else if (!strcmp(word, "comment")) {
            if (ply->texture_count < PLY_TEXTURES && sscanf(line, "comment TextureFile %255[^\r\n]", ply->textures[ply->texture_count]) == 1)
                ply->texture_count++;
        } else if (!strcmp(word, "element")) {
            struct ply_element *e = &ply->elements[ply->element_count];
            if (ply->element_count == PLY_ELEMENTS) return FAIL("the PLY header has more than %d elements", PLY_ELEMENTS);
            if (sscanf(line, "element %31s %" SCNu64, e->name, &e->count) != 2) return FAIL("the PLY header has an element without a number");
            ply->element_count++;
        } else if (!strcmp(word, "property")) {
            if (!read_property(ply, line, err)) return false;
        } else if (!strcmp(word, "end_header")) {
            const char *end = strchr(line, '\n');
            ply->at = end ? end + 1 : ply->end;
            return true;
        }
    }
    return FAIL("is no PLY file: it has no header");
}

bool ply_check_count(const struct ply *ply, const struct ply_element *element, struct error *err)
{
    size_t left = (size_t)(ply->end - ply->at), least = 0; /* bytes that one of them takes */
    for (size_t i = 0; i < element->property_count; i++) {
        const struct ply_property *p = &element->properties[i];
        least += !ply->binary ? 2 : p->is_list ? types[p->count_type].size : types[p->type].size;
    }
    if (least == 0 ? element->count == 0 : element->count <= (left + !ply->binary) / least) return true;
    return FAIL("the PLY header tells of %" PRIu64 " elements \"%s\", but only %zu bytes follow", element->count, element->name, left);
}

static double from_bits(uint64_t bits, enum ply_type type)
{
    uint32_t half = (uint32_t)bits;
    float f;
    double d;
    switch (type) {
    case PLY_INT8: return (int8_t)half;
    case PLY_UINT8: return (uint8_t)half;
    case PLY_INT16: return (int16_t)half;
    case PLY_UINT16: return (uint16_t)half;
    case PLY_INT32: return (int32_t)half;
    case PLY_UINT32: return half;
    case PLY_FLOAT32: memcpy(&f, &half, sizeof f); return (double)f;
    default: memcpy(&d, &bits, sizeof d); return d;
    }
}

static bool read_binary(struct ply *ply, double *value, enum ply_type type)
{
    size_t size = types[type].size;
    const unsigned char *at = (const unsigned char *)ply->at;
    if (size > (size_t)(ply->end - ply->at)) return false;
    uint64_t bits = 0;
    if (ply->big_endian)
        for (size_t i = 0; i < size; i++) bits = bits << 8 | at[i];
    else
        for (size_t i = size; i-- > 0;) bits = bits << 8 | at[i];
    ply->at += size;
    *value = from_bits(bits, type);
    return true;
}

bool ply_read(struct ply *ply, double *value, enum ply_type type)
{
    return ply->binary ? read_binary(ply, value, type) : number_read(&ply->at, value);
}

bool ply_truncated(const struct ply *ply, const struct ply_element *element, uint64_t index, struct error *err)
{
    return FAIL("is truncated, or has no number where one belongs: element \"%s\" %" PRIu64 " of %" PRIu64, element->name, index + 1, element->count);
}

double ply_color(double value, enum ply_type type)
{
    double c = type < PLY_FLOAT32 ? value / 255 : value;
    return c > 0 ? c < 1 ? c : 1 : 0; /* a NaN becomes 0 */
}

enum ply_role ply_role(const struct ply_property *property)
{
    static const struct { const char *name; enum ply_role role; } roles[] = {
        { "x", PLY_X }, { "y", PLY_Y }, { "z", PLY_Z }, { "nx", PLY_NX }, { "ny", PLY_NY }, { "nz", PLY_NZ },
        { "u", PLY_U }, { "v", PLY_V }, { "s", PLY_U }, { "t", PLY_V }, { "texture_u", PLY_U }, { "texture_v", PLY_V },
        { "red", PLY_RED }, { "green", PLY_GREEN }, { "blue", PLY_BLUE },
        { "diffuse_red", PLY_RED }, { "diffuse_green", PLY_GREEN }, { "diffuse_blue", PLY_BLUE },
        { "label", PLY_LABEL }, { "texnumber", PLY_TEXTURE },
    };
    for (size_t i = 0; !property->is_list && i < sizeof roles / sizeof *roles; i++)
        if (!strcmp(property->name, roles[i].name)) return roles[i].role;
    return PLY_NO_ROLE;
}

bool ply_is_indices(const struct ply_property *property)
{
    return property->is_list && (!strcmp(property->name, "vertex_indices") || !strcmp(property->name, "vertex_index"));
}
