#include "cast/part.h"

#include <assert.h>
#include <stdlib.h>

static uint32_t add(struct shell *s, struct vec3 p) { return shell_point(s, p, vec3(0, 0, 1)); }

static void add_plain_box(struct shell *s, struct vec3 at, struct vec3 h, int material)
{
    static const uint32_t side[6][4] = { { 0, 2, 3, 1 }, { 4, 5, 7, 6 }, { 0, 1, 5, 4 }, { 2, 6, 7, 3 }, { 0, 4, 6, 2 }, { 1, 3, 7, 5 } };
    size_t first = s->faces_count;
    uint32_t v = (uint32_t)s->points;
    for (int i = 0; i < 8; i++) add(s, vec3_add(at, vec3(i & 1 ? h.x : -h.x, i & 2 ? h.y : -h.y, i & 4 ? h.z : -h.z)));
    for (int f = 0; f < 6; f++) shell_quad(s, v + side[f][0], v + side[f][1], v + side[f][2], v + side[f][3], material);
    shell_smooth(s, first, 30);
}

void part_box(struct shell *s, struct vec3 at, struct vec3 h, double bevel, int material)
{
    size_t first = s->faces_count;
    double b = fmin(bevel, 0.9 * fmin(h.x, fmin(h.y, h.z)));
    if (b < s->least_bevel_m) {
        add_plain_box(s, at, h, material);
        return;
    }
    uint32_t v[2][2][2][3]; /* a corner's point on the face across each axis */
    for (int i = 0; i < 8; i++)
        for (int axis = 0; axis < 3; axis++) {
            double c[3] = { h.x - b, h.y - b, h.z - b };
            c[axis] += b;
            for (int k = 0; k < 3; k++) c[k] *= i >> k & 1 ? 1 : -1;
            v[i & 1][i >> 1 & 1][i >> 2][axis] = add(s, vec3_add(at, vec3(c[0], c[1], c[2])));
        }
#define V(axis, a, u, w) v[(axis) == 0 ? (a) : (axis) == 1 ? (w) : (u)][(axis) == 1 ? (a) : (axis) == 2 ? (w) : (u)][(axis) == 2 ? (a) : (axis) == 0 ? (w) : (u)]
    for (int axis = 0; axis < 3; axis++)
        for (int a = 0; a < 2; a++) {
            int turn = !a;
            uint32_t q[4] = { V(axis, a, 0, 0)[axis], V(axis, a, 1, 0)[axis], V(axis, a, 1, 1)[axis], V(axis, a, 0, 1)[axis] };
            shell_quad(s, q[0], q[turn ? 3 : 1], q[2], q[turn ? 1 : 3], material);
            for (int u = 0; u < 2; u++) { /* the edge to the next axis' face */
                int next = (axis + 1) % 3;
                uint32_t e[4] = { V(axis, a, u, 0)[axis], V(axis, a, u, 0)[next], V(axis, a, u, 1)[next], V(axis, a, u, 1)[axis] };
                bool flip = a != u;
                shell_quad(s, e[0], e[flip ? 3 : 1], e[2], e[flip ? 1 : 3], material);
            }
        }
    for (int i = 0; i < 8; i++) {
        uint32_t *c = v[i & 1][i >> 1 & 1][i >> 2];
        bool flip = ((i & 1) + (i >> 1 & 1) + (i >> 2)) % 2 == 0;
        shell_face(s, c[0], c[flip ? 2 : 1], c[flip ? 1 : 2], material);
    }
#undef V
    shell_smooth(s, first, 50);
}

void part_blob(struct shell *s, struct vec3 at, struct vec3 h, double round, int n, int material)
{
    size_t first = s->faces_count;
    int rows = n / 2;
    uint32_t *grid = malloc((size_t)(n * (rows + 1)) * sizeof *grid);
    if (!grid) abort();
    for (int j = 0; j <= rows; j++)
        for (int i = 0; i < n; i++) {
            double a = 2 * PI * i / n, b = PI * j / rows - PI / 2, c[3] = { cos(a) * cos(b), sin(a) * cos(b), sin(b) };
            for (int k = 0; k < 3; k++) c[k] = fabs(c[k]) < 1e-9 ? 0 : copysign(pow(fabs(c[k]), round), c[k]);
            bool pole = j == 0 || j == rows;
            grid[j * n + i] = pole && i ? grid[j * n] : add(s, vec3_add(at, vec3(pole ? 0 : c[0] * h.x, pole ? 0 : c[1] * h.y, c[2] * h.z)));
        }
    for (int j = 0; j < rows; j++)
        for (int i = 0; i < n; i++) {
            int o = (i + 1) % n;
            shell_quad(s, grid[j * n + i], grid[j * n + o], grid[j * n + n + o], grid[j * n + n + i], material);
        }
    free(grid);
    shell_smooth(s, first, 60);
}

void part_tube(struct shell *s, const struct vec3 *p, int count, double r0, double r1, int n, int material)
{
    size_t first = s->faces_count;
    uint32_t ends[2] = { add(s, p[0]), add(s, p[count - 1]) }, previous = 0;
    struct vec3 u = { 0, 0, 0 };
    for (int i = 0; i < count; i++) {
        struct vec3 t = vec3_unit(vec3_sub(p[i + 1 < count ? i + 1 : i], p[i ? i - 1 : i]));
        if (!i) u = fabs(t.y) < 0.9 ? vec3(0, 1, 0) : vec3(1, 0, 0);
        u = vec3_unit(vec3_sub(u, vec3_scale(t, vec3_dot(u, t))));
        struct vec3 w = vec3_cross(t, u);
        double r = r0 + (r1 - r0) * i / (count - 1);
        uint32_t ring = (uint32_t)s->points;
        for (int k = 0; k < n; k++) {
            double a = 2 * PI * k / n;
            add(s, vec3_add(p[i], vec3_add(vec3_scale(u, r * cos(a)), vec3_scale(w, r * sin(a)))));
        }
        for (int k = 0; k < n; k++) {
            uint32_t a = (uint32_t)k, b = (uint32_t)((k + 1) % n);
            if (i) shell_quad(s, previous + a, previous + b, ring + b, ring + a, material);
            if (!i) shell_face(s, ends[0], ring + b, ring + a, material);
            if (i == count - 1) shell_face(s, ends[1], ring + a, ring + b, material);
        }
        previous = ring;
    }
    shell_smooth(s, first, 60);
}

void part_rod(struct shell *s, struct vec3 a, struct vec3 b, double r, int n, int material)
{
    part_tube(s, (struct vec3[]){ a, b }, 2, r, r, n, material);
}

void part_lathe(struct shell *s, struct vec3 at, const struct ring *profile, int count, int n, double crease)
{
    size_t first = s->faces_count;
    bool loop = profile[0].r == profile[count - 1].r && profile[0].y == profile[count - 1].y && profile[0].r > 0;
    uint32_t start = 0, before = 0;
    for (int j = 0; j < count; j++) {
        bool pole = profile[j].r == 0, was_pole = j && profile[j - 1].r == 0;
        uint32_t ring = (uint32_t)s->points;
        if (loop && j == count - 1) ring = start;
        else
            for (int k = 0; k < (pole ? 1 : n); k++) {
                double a = 2 * PI * k / n;
                add(s, vec3_add(at, vec3(profile[j].r * sin(a), profile[j].y, profile[j].r * cos(a))));
            }
        if (!j) start = ring;
        for (int k = 0; j && k < n; k++) {
            uint32_t a = (uint32_t)k, b = (uint32_t)((k + 1) % n);
            shell_quad(s, before + (was_pole ? 0 : a), ring + (pole ? 0 : a), ring + (pole ? 0 : b), before + (was_pole ? 0 : b), profile[j - 1].material);
        }
        before = ring;
    }
    shell_smooth(s, first, crease);
}

void part_plate(struct shell *s, struct vec3 at, struct vec3 u, struct vec3 v, const double (*outline)[2], int count, double thickness, int material)
{
    size_t first = s->faces_count;
    struct vec3 across = vec3_scale(vec3_unit(vec3_cross(u, v)), thickness);
    double mu = 0, mv = 0;
    for (int i = 0; i < count; i++) mu += outline[i][0] / count, mv += outline[i][1] / count;
    struct vec3 middle = vec3_add(at, vec3_add(vec3_scale(u, mu), vec3_scale(v, mv)));
    uint32_t back = add(s, middle), front = add(s, vec3_add(middle, across)), ring = (uint32_t)s->points;
    for (int i = 0; i < count; i++) {
        struct vec3 p = vec3_add(at, vec3_add(vec3_scale(u, outline[i][0]), vec3_scale(v, outline[i][1])));
        add(s, p), add(s, vec3_add(p, across));
    }
    for (uint32_t i = 0; i < (uint32_t)count; i++) {
        uint32_t o = (i + 1) % (uint32_t)count, a = ring + 2 * i, b = ring + 2 * o;
        shell_face(s, back, b, a, material);
        shell_face(s, front, a + 1, b + 1, material);
        shell_quad(s, a, b, b + 1, a + 1, material);
    }
    shell_smooth(s, first, 40);
}

void part_turn(struct shell *s, size_t first, struct vec3 about, double pitch_deg, double yaw_deg, double roll_deg)
{
    double a = pitch_deg * PI / 180, b = yaw_deg * PI / 180, c = roll_deg * PI / 180;
    struct mat3 roll = { { { 1, 0, 0 }, { 0, cos(c), -sin(c) }, { 0, sin(c), cos(c) } } };
    struct mat3 pitch = { { { cos(a), 0, sin(a) }, { 0, 1, 0 }, { -sin(a), 0, cos(a) } } };
    struct mat3 yaw = { { { cos(b), -sin(b), 0 }, { sin(b), cos(b), 0 }, { 0, 0, 1 } } };
    struct mat3 turn = mat3_multiply(yaw, mat3_multiply(pitch, roll));
    for (size_t i = first; i < s->points; i++) {
        s->p[i] = vec3_add(about, mat3_apply(turn, vec3_sub(s->p[i], about)));
        s->n[i] = mat3_apply(turn, s->n[i]);
    }
}
