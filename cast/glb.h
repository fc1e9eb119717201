/* A binary glTF 2.0 file in the making: its bytes, and the JSON lists that tell what they are. Metres; +y up, +z front. */
#ifndef STAFFAGE_CAST_GLB_H
#define STAFFAGE_CAST_GLB_H

#include "lib/error.h"
#include "lib/vec.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* What is written to f is at data, once it is closed. The owner frees data. */
struct text { FILE *f; char *data; size_t size; };
void text_open(struct text *text);
void text_close(struct text *text);

enum component { U8 = 5121, I16 = 5122, U16 = 5123, U32 = 5125, F32 = 5126 };
enum target { NO_TARGET, VERTICES = 34962, INDICES = 34963 };

struct glb { struct text bytes, views, accessors; size_t size; int view_count, accessor_count; };
void glb_open(struct glb *glb);
/* Each returns its number. stride: of one vertex; 0 where that goes without saying */
int glb_view(struct glb *glb, const void *data, size_t bytes, enum target target, size_t stride);
int glb_accessor(struct glb *glb, int view, size_t offset, size_t count, enum component component, bool normalized, const char *type, const char *limits);
/* The buffer, its views and accessors, each with a comma behind it. */
void glb_lists(struct glb *glb, FILE *json);
/* Closes the JSON, writes the file, and releases both. */
bool glb_write(const char *path, struct glb *glb, struct text *json, struct error *err);

/* Forward, left, up become z, x, y. */
void glb_place(float to[3], struct vec3 p);
/* ,"min":[...],"max":[...] of count values of n components; a vertex' values begin `stride` floats after those before it. */
enum { LIMITS_SIZE = 256 };
void glb_limits(char text[LIMITS_SIZE], const float *values, size_t count, size_t n, size_t stride);

#endif
