/* A place from an OBJ file and its materials. Read here and not by assimp, which takes many times as
 * long over a million triangles, passes over vertex colours, and knows no lines. */
#include "gen/model/number.h"
#include "gen/world/static_mesh_impl.h"
#include "lib/file.h"

#include <stdlib.h>
#include <string.h>

struct obj_material {
    char *name;
    bool has_color, has_texture;
    uint8_t color[3];     /* sRGB */
    uint16_t texture;
};

/* One of the two files, line by line. */
struct lines {
    const char *path, *at;
    int line;
    struct error *err;
};

struct reader {
    struct lines in;
    struct static_mesh *mesh;
    size_t vertex_capacity, uvs, uv_capacity, polygon_capacity;
    float (*uv)[2];
    struct corner { uint32_t vertex; long uv; } *polygon; /* uv: -1 none */
    struct obj_material *materials;
    size_t material_count;
    const struct obj_material *material; /* in use, or NULL */
};

#define FAIL(l, ...) error_at((l)->err, ERR_INPUT, (l)->path, (l)->line, 0, __VA_ARGS__)
#define NO_MEMORY(l) error_set((l)->err, ERR_MEMORY, "no memory for a mesh")

/* --- lines --- */

static bool more(struct lines *l)
{
    while (*l->at == ' ' || *l->at == '\t') l->at++;
    return *l->at && *l->at != '\n' && *l->at != '\r' && *l->at != '#';
}

static void next_line(struct lines *l)
{
    const char *end = strchr(l->at, '\n');
    l->at = end ? end + 1 : l->at + strlen(l->at);
    l->line++;
}

/* Is this the line's first word? Then `at` moves behind it. */
static bool keyword(struct lines *l, const char *word)
{
    size_t n = strlen(word);
    if (strncmp(l->at, word, n) != 0 || (l->at[n] != ' ' && l->at[n] != '\t')) return false;
    l->at += n;
    return true;
}

/* Up to max numbers of this line. Returns how many there are, or -1 where something else stands. */
static int numbers(struct lines *l, double *value, int max)
{
    int n = 0;
    for (; n < max && more(l); n++)
        if (!number_read(&l->at, &value[n])) return -1;
    return n;
}

/* The rest of the line without blanks at its ends. The caller frees. */
static char *rest(struct lines *l)
{
    while (*l->at == ' ' || *l->at == '\t') l->at++;
    size_t n = strcspn(l->at, "\r\n");
    while (n && (l->at[n - 1] == ' ' || l->at[n - 1] == '\t')) n--;
    return strndup(l->at, n);
}

static bool grow(void *array, size_t *capacity, size_t count, size_t element, struct lines *l)
{
    if (count <= *capacity) return true;
    void **at = array, *grown = realloc(*at, 2 * count * element);
    if (!grown) return NO_MEMORY(l);
    *at = grown;
    *capacity = 2 * count;
    return true;
}

/* --- materials --- */

static uint8_t clamp_srgb(double share)
{
    return static_srgb(share > 0 ? share < 1 ? share : 1 : 0);
}

/* The file name of a map: what stands after its options, each a word that begins with "-" and numbers or on, off. */
static char *map_name(struct lines *l)
{
    for (more(l); *l->at == '-';) {
        l->at += strcspn(l->at, " \t\r\n");
        for (double value; more(l);) {
            const char *word = l->at;
            if (!strncmp(word, "on ", 3) || !strncmp(word, "off ", 4)) l->at += strcspn(l->at, " ");
            else if (!number_read(&l->at, &value) || !strchr(" \t", *l->at)) {
                l->at = word; /* a name that begins with digits */
                break;
            }
        }
    }
    return rest(l);
}

static bool read_material_line(struct reader *r, struct lines *l)
{
    struct obj_material *m = r->material_count ? &r->materials[r->material_count - 1] : NULL;
    double c[3];
    if (keyword(l, "newmtl")) {
        struct obj_material *grown = realloc(r->materials, (r->material_count + 1) * sizeof *grown);
        if (!grown) return NO_MEMORY(l);
        r->materials = grown;
        grown[r->material_count] = (struct obj_material){ .name = rest(l) };
        return grown[r->material_count++].name || NO_MEMORY(l);
    }
    if (m && keyword(l, "Kd")) {
        if (numbers(l, c, 3) != 3) return FAIL(l, "\"Kd\" must be followed by three numbers");
        for (int k = 0; k < 3; k++) m->color[k] = clamp_srgb(c[k]);
        m->has_color = true;
    } else if (m && keyword(l, "map_Kd")) {
        char *name = map_name(l);
        bool ok = name ? static_mesh_read_texture(r->mesh, &m->texture, l->path, name, l->err) : NO_MEMORY(l);
        free(name);
        m->has_texture = true;
        return ok;
    }
    return true;
}

static bool read_materials(struct reader *r)
{
    char *name = rest(&r->in), *path = name ? path_beside(r->in.path, name) : NULL, *data;
    size_t size;
    bool ok = path ? file_exists(path) || FAIL(&r->in, "its materials \"%s\" are not there", name) : NO_MEMORY(&r->in);
    if (ok && (ok = file_read(&data, &size, path, r->in.err))) {
        struct lines l = { .path = path, .at = data, .line = 1, .err = r->in.err };
        for (; ok && *l.at; next_line(&l)) ok = !more(&l) || read_material_line(r, &l);
        free(data);
    }
    free(name);
    free(path);
    return ok;
}

static bool use_material(struct reader *r)
{
    char *name = rest(&r->in);
    if (!name) return NO_MEMORY(&r->in);
    r->material = NULL;
    for (size_t i = 0; i < r->material_count; i++)
        if (!strcmp(r->materials[i].name, name)) r->material = &r->materials[i];
    bool ok = r->material || r->material_count == 0 || FAIL(&r->in, "uses material \"%s\", which its material files do not have", name);
    free(name);
    return ok;
}

/* --- the mesh --- */

static bool read_vertex(struct reader *r)
{
    struct static_mesh *m = r->mesh;
    double v[6];
    int n = numbers(&r->in, v, 6);
    if (n < 3) return FAIL(&r->in, "a vertex must have three coordinates");
    if (m->vertices == 0 && n == 6 && !static_mesh_reserve_vertices(m, 0, true, r->in.err)) return false;
    if (m->color && n < 6) return FAIL(&r->in, "a vertex has no colour, though others have");
    if (m->vertices == r->vertex_capacity) {
        size_t capacity = r->vertex_capacity + r->vertex_capacity / 2 + 4096;
        if (!static_mesh_reserve_vertices(m, capacity, m->color != NULL, r->in.err)) return false;
        r->vertex_capacity = capacity;
    }
    static_mesh_place(m, m->vertices, vec3(v[0], v[1], v[2]));
    for (int k = 0; m->color && k < 3; k++) m->color[m->vertices][k] = clamp_srgb(v[3 + k]);
    m->vertices++;
    return true;
}

static bool read_uv(struct reader *r)
{
    double v[2];
    if (numbers(&r->in, v, 2) != 2) return FAIL(&r->in, "\"vt\" must be followed by two numbers");
    if (!grow(&r->uv, &r->uv_capacity, r->uvs + 1, sizeof *r->uv, &r->in)) return false;
    r->uv[r->uvs][0] = (float)v[0];
    r->uv[r->uvs++][1] = (float)v[1];
    return true;
}

/* An index, from 1 or, negative, from the last on, as one from 0. */
static bool read_index(struct reader *r, long *index, size_t count, const char *what)
{
    char *end;
    long i = strtol(r->in.at, &end, 10);
    if (end == r->in.at) return FAIL(&r->in, "a face has no index of a %s where one belongs", what);
    r->in.at = end;
    *index = i < 0 ? (long)count + i : i - 1;
    return (*index >= 0 && *index < (long)count) || FAIL(&r->in, "a face uses %s %ld of %zu", what, i, count);
}

static bool read_corner(struct reader *r, struct corner *corner)
{
    long vertex, unused;
    if (!read_index(r, &vertex, r->mesh->vertices, "vertex")) return false;
    *corner = (struct corner){ (uint32_t)vertex, -1 };
    if (*r->in.at != '/') return true;
    r->in.at++;
    if (*r->in.at != '/' && !read_index(r, &corner->uv, r->uvs, "texture position")) return false;
    if (*r->in.at != '/') return true;
    r->in.at++;
    return read_index(r, &unused, SIZE_MAX / 4, "normal"); /* the triangles have their own */
}

/* Arrays for what this face has, where there are none yet. */
static bool fit_face(struct reader *r, size_t triangles, bool textured)
{
    struct static_mesh *m = r->mesh;
    bool colored = r->material && r->material->has_color && !m->color;
    if (!static_mesh_reserve_triangles(m, m->triangles + triangles, r->in.err)) return false;
    if (textured && !static_mesh_with_textures(m, r->in.err)) return false;
    if (!colored || m->face_color) return true;
    if (!static_mesh_with_face_colors(m, r->in.err)) return false;
    memset(m->face_color, clamp_srgb((double)srgb_from_linear(STATIC_GREY)), m->triangle_capacity * sizeof *m->face_color);
    return true;
}

static bool read_face(struct reader *r)
{
    struct static_mesh *m = r->mesh;
    size_t n = 0;
    bool uvs = true;
    for (; more(&r->in); n++) {
        if (!grow(&r->polygon, &r->polygon_capacity, n + 1, sizeof *r->polygon, &r->in)) return false;
        if (!read_corner(r, &r->polygon[n])) return false;
        uvs &= r->polygon[n].uv >= 0;
    }
    if (n < 3) return FAIL(&r->in, "a face has %zu corners", n);
    const struct obj_material *material = r->material;
    bool textured = uvs && material && material->has_texture;
    if (!fit_face(r, n - 2, textured)) return false;
    for (size_t i = 2; i < n; i++, m->triangles++) {
        const struct corner *pick[3] = { &r->polygon[0], &r->polygon[i - 1], &r->polygon[i] };
        for (int c = 0; c < 3; c++) {
            m->triangle[m->triangles][c] = pick[c]->vertex;
            if (textured) memcpy(m->uv[m->triangles][c], r->uv[pick[c]->uv], sizeof *r->uv);
        }
        if (textured) m->texture[m->triangles] = material->texture;
        if (m->face_color && material && material->has_color) memcpy(m->face_color[m->triangles], material->color, 3);
    }
    return true;
}

static bool read_line(struct reader *r)
{
    if (keyword(&r->in, "v")) return read_vertex(r);
    if (keyword(&r->in, "vt")) return read_uv(r);
    if (keyword(&r->in, "f")) return read_face(r);
    if (keyword(&r->in, "mtllib")) return read_materials(r);
    if (keyword(&r->in, "usemtl")) return use_material(r);
    return true;
}

bool static_mesh_read_obj(struct static_mesh *mesh, const char *path, struct error *err)
{
    char *data;
    size_t size;
    if (!file_read(&data, &size, path, err)) return false;
    struct reader r = { .in = { .path = path, .at = data, .line = 1, .err = err }, .mesh = mesh };
    bool ok = true;
    for (; ok && *r.in.at; next_line(&r.in)) ok = !more(&r.in) || read_line(&r);
    if (ok && r.in.at != data + size) ok = FAIL(&r.in, "is not a text file");
    for (size_t i = 0; i < r.material_count; i++) free(r.materials[i].name);
    free(r.materials);
    free(r.polygon);
    free(r.uv);
    free(data);
    return ok;
}
