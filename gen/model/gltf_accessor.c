#include "gen/model/model_gltf.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static size_t component_size(int component)
{
    switch (component) {
    case GLTF_I8: case GLTF_U8: return 1;
    case GLTF_I16: case GLTF_U16: return 2;
    case GLTF_U32: case GLTF_F32: return 4;
    default: return 0;
    }
}

static double component_value(const uint8_t *p, int component, bool normalized)
{
    int8_t i8;
    int16_t i16;
    uint16_t u16;
    uint32_t u32;
    float f32;
    switch (component) {
    case GLTF_I8: memcpy(&i8, p, 1); return normalized ? fmax(i8 / 127.0, -1) : i8;
    case GLTF_U8: return normalized ? *p / 255.0 : *p;
    case GLTF_I16: memcpy(&i16, p, 2); return normalized ? fmax(i16 / 32767.0, -1) : i16;
    case GLTF_U16: memcpy(&u16, p, 2); return normalized ? u16 / 65535.0 : u16;
    case GLTF_U32: memcpy(&u32, p, 4); return u32;
    default: memcpy(&f32, p, 4); return (double)f32;
    }
}

const uint8_t *gltf_elements(struct gltf_loader *l, int view, size_t offset, size_t count, size_t element, size_t *stride)
{
    const struct gltf *g = l->gltf;
    if (view < 0 || (size_t)view >= g->view_count) {
        GLTF_FAIL(l, "refers to buffer view %d of %zu", view, g->view_count);
        return NULL;
    }
    const struct gltf_view *v = &g->views[view];
    if (v->buffer < 0 || (size_t)v->buffer >= g->buffer_count) {
        GLTF_FAIL(l, "buffer view %d refers to buffer %d of %zu", view, v->buffer, g->buffer_count);
        return NULL;
    }
    const struct gltf_buffer *b = &g->buffers[v->buffer];
    *stride = v->stride ? v->stride : element;
    if (v->offset > b->size || v->size > b->size - v->offset) {
        GLTF_FAIL(l, "buffer view %d reaches beyond its buffer of %zu bytes", view, b->size);
        return NULL;
    }
    if (count && (element > v->size || offset > v->size - element || (count - 1) > (v->size - element - offset) / *stride)) {
        GLTF_FAIL(l, "buffer view %d of %zu bytes is too short for %zu elements", view, v->size, count);
        return NULL;
    }
    return b->data + v->offset + offset;
}

static const struct gltf_accessor *accessor_of(struct gltf_loader *l, int accessor, int components, const char *what)
{
    if (accessor < 0 || (size_t)accessor >= l->gltf->accessor_count) {
        GLTF_FAIL(l, "%s: accessor %d of %zu does not exist", what, accessor, l->gltf->accessor_count);
        return NULL;
    }
    const struct gltf_accessor *a = &l->gltf->accessors[accessor];
    if (a->components != components || !component_size(a->component)) {
        GLTF_FAIL(l, "%s: accessor %d has the wrong type", what, accessor);
        return NULL;
    }
    if (a->count > UINT32_MAX / 16) {
        GLTF_FAIL(l, "%s: accessor %d tells of %zu elements", what, accessor, a->count);
        return NULL;
    }
    return a;
}

double *gltf_accessor_read(struct gltf_loader *l, size_t *count, int accessor, int components, const char *what)
{
    const struct gltf_accessor *a = accessor_of(l, accessor, components, what);
    if (!a) return NULL;
    size_t n = (size_t)components, size = component_size(a->component), stride = 0;
    const uint8_t *from = NULL;
    if (a->view >= 0 && !(from = gltf_elements(l, a->view, a->offset, a->count, n * size, &stride))) goto fail;
    if (!from && !a->sparse) {
        GLTF_FAIL(l, "accessor %d has no data", accessor);
        goto fail;
    }
    const uint8_t *index = NULL, *value = NULL;
    size_t index_stride = 0, value_stride = 0, index_size = component_size(a->sparse_index_component);
    if (a->sparse) {
        if (a->sparse_count > a->count || !index_size || a->sparse_index_component == GLTF_F32) {
            GLTF_FAIL(l, "accessor %d is sparse in a way that is not possible", accessor);
            goto fail;
        }
        if (!(index = gltf_elements(l, a->sparse_index_view, a->sparse_index_offset, a->sparse_count, index_size, &index_stride)) ||
            !(value = gltf_elements(l, a->sparse_value_view, a->sparse_value_offset, a->sparse_count, n * size, &value_stride))) goto fail;
    }
    double *out = calloc(a->count * n + 1, sizeof *out);
    if (!out) {
        gltf_no_memory(l);
        return NULL;
    }
    for (size_t i = 0; from && i < a->count; i++)
        for (size_t k = 0; k < n; k++)
            out[i * n + k] = component_value(from + i * stride + k * size, a->component, a->normalized);
    for (size_t i = 0; a->sparse && i < a->sparse_count; i++) {
        double at = component_value(index + i * index_stride, a->sparse_index_component, false);
        if (at < 0 || at >= (double)a->count) {
            GLTF_FAIL(l, "accessor %d: sparse index %.0f of %zu", accessor, at, a->count);
            free(out);
            return NULL;
        }
        for (size_t k = 0; k < n; k++)
            out[(size_t)at * n + k] = component_value(value + i * value_stride + k * size, a->component, a->normalized);
    }
    *count = a->count;
    return out;
fail:
    error_prefix(l->err, "%s: ", what);
    return NULL;
}
