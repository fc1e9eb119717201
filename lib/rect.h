/* Rectangles of pixels, half-open: [x0, x1) x [y0, y1). One without pixels is empty. */
#ifndef STAFFAGE_LIB_RECT_H
#define STAFFAGE_LIB_RECT_H

#include <stdbool.h>
#include <stddef.h>

struct rect { int x0, y0, x1, y1; };

static inline bool rect_is_empty(struct rect r)
{
    return r.x0 >= r.x1 || r.y0 >= r.y1;
}

/* Number of pixels; r must not be turned inside out. */
static inline size_t rect_area(struct rect r)
{
    return (size_t)(r.x1 - r.x0) * (size_t)(r.y1 - r.y0);
}

/* All 0 when a and b share no pixel. */
static inline struct rect rect_intersect(struct rect a, struct rect b)
{
    struct rect r = { a.x0 > b.x0 ? a.x0 : b.x0, a.y0 > b.y0 ? a.y0 : b.y0, a.x1 < b.x1 ? a.x1 : b.x1,
                      a.y1 < b.y1 ? a.y1 : b.y1 };
    return rect_is_empty(r) ? (struct rect){ 0, 0, 0, 0 } : r;
}

/* The smallest that holds the pixels of both. */
static inline struct rect rect_unite(struct rect a, struct rect b)
{
    if (rect_is_empty(a)) return b;
    if (rect_is_empty(b)) return a;
    return (struct rect){ a.x0 < b.x0 ? a.x0 : b.x0, a.y0 < b.y0 ? a.y0 : b.y0, a.x1 > b.x1 ? a.x1 : b.x1,
                          a.y1 > b.y1 ? a.y1 : b.y1 };
}

#endif
