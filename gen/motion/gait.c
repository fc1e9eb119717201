#include "gen/motion/gait.h"

#include "gen/model/rig.h"

#include <math.h>
#include <stdlib.h>

/* Samples of a loop: a step of a walk is then 10 ms, in which a planted foot goes 1 to 2 cm under the body. */
#define SAMPLES 100
/* Of the body's height: what touches the ground with the lowest point; what is a foot in the air;
 * what a loop goes at least to be a walk. */
#define SOLE_SHARE 0.006
#define AIR_SHARE 0.03
#define WALK_SHARE 0.1

/* A point of the sole over one interval: how far back it went, and how much it counts. */
struct touch { double back_m, weight; };
struct touches { struct touch *list; size_t count; };

static int by_way(const void *a, const void *b)
{
    const struct touch *p = a, *q = b;
    return (p->back_m > q->back_m) - (p->back_m < q->back_m);
}

/* A median: the other foot, swinging by close above the ground, does not count as long as the planted one has more. */
static double weighted_median(struct touches *t)
{
    double total = 0, below = 0;
    qsort(t->list, t->count, sizeof *t->list, by_way);
    for (size_t i = 0; i < t->count; i++) total += t->list[i].weight;
    for (size_t i = 0; i < t->count; i++)
        if ((below += t->list[i].weight) >= total / 2) return t->list[i].back_m;
    return 0;
}

/* What stays low from one pose to the next. */
static void find_touches(struct touches *t, const struct model *from, const struct model *to, double sole_m)
{
    t->count = 0;
    for (size_t i = 0; i < from->mesh_count; i++)
        for (size_t v = 0; v < from->meshes[i].vertices; v++) {
            const float *p = from->meshes[i].position_m[v], *q = to->meshes[i].position_m[v];
            double above = fmax((double)p[2] - from->min_m.z, (double)q[2] - to->min_m.z);
            if (above < sole_m) t->list[t->count++] = (struct touch){ (double)(p[0] - q[0]), 1 - above / sole_m };
        }
}

/* Where in the loop the feet are nearest to those of who stands, shifted so that what touches the ground is the same. */
struct meeting { double cost_m; struct vec2 shift_m; int sample; };

static double height_of(const struct model *model, size_t mesh, size_t v) { return (double)model->meshes[mesh].position_m[v][2] - model->min_m.z; }

static void meet(struct meeting *best, int sample, const struct model *at, const struct model *standing, double sole_m)
{
    double touching = 0, stood = 0, apart = 0;
    struct vec2 shift = { 0 };
    for (int turn = 0; turn < 2; turn++) {
        for (size_t i = 0; i < at->mesh_count; i++)
            for (size_t v = 0; v < at->meshes[i].vertices; v++) {
                const float *p = at->meshes[i].position_m[v], *q = standing->meshes[i].position_m[v];
                double x = (double)(p[0] - q[0]), y = (double)(p[1] - q[1]), down = fmax(1 - height_of(turn ? standing : at, i, v) / sole_m, 0);
                if (turn) stood += down, apart += down * hypot(x - shift.x, y - shift.y);
                else touching += down, shift.x += down * x, shift.y += down * y;
            }
        if (turn == 0 && touching > 0) shift = (struct vec2){ shift.x / touching, shift.y / touching };
    }
    if (touching == 0 || stood == 0) return;
    double cost_m = apart / stood + hypot(shift.x, shift.y);
    if (cost_m < best->cost_m) *best = (struct meeting){ cost_m, shift, sample };
}

/* Fill in where nothing touches the ground: the body goes on, from the last speed to the next. */
static bool bridge(double *step_m, const bool *grounded)
{
    int first = 0;
    while (first < SAMPLES && !grounded[first]) first++;
    if (first == SAMPLES) return false;
    for (int from = first, to; from < first + SAMPLES; from = to) {
        for (to = from + 1; !grounded[to % SAMPLES]; to++) {}
        double a = step_m[from % SAMPLES], b = step_m[to % SAMPLES];
        for (int i = from + 1; i < to; i++) step_m[i % SAMPLES] = a + (b - a) * (i - from) / (to - from);
    }
    return true;
}

/* Out: step_m (SAMPLES) what the body goes in each interval; low_m (SAMPLES + 1) its lowest point */
static bool measure(double *step_m, double *low_m, bool *grounded, struct meeting *meeting, const struct model *model, size_t animation,
                    double duration_s, const struct model *standing, struct error *err)
{
    double sole_m = SOLE_SHARE * model->max_m.z;
    size_t vertices = 0;
    for (size_t i = 0; i < model->mesh_count; i++) vertices += model->meshes[i].vertices;
    struct touches touches = { malloc(vertices * sizeof *touches.list), 0 };
    struct model from = { 0 }, to = { 0 };
    if (!touches.list) error_set(err, ERR_MEMORY, "no memory for a gait");
    for (int i = 0; i <= SAMPLES && err->code == ERR_OK; i++) {
        struct posture posture = { .animation = animation, .time_s = duration_s * i / SAMPLES };
        if (!model_pose(&to, model, &posture, err)) break;
        low_m[i] = to.min_m.z;
        if (standing) meet(meeting, i, &to, standing, sole_m);
        if (i > 0) {
            find_touches(&touches, &from, &to, sole_m);
            grounded[i - 1] = touches.count > 0;
            step_m[i - 1] = weighted_median(&touches);
        }
        model_posed_release(&from);
        from = to;
        to = (struct model){ 0 };
    }
    model_posed_release(&from);
    free(touches.list);
    return err->code == ERR_OK;
}

bool gait_create(struct gait *gait, const struct model *model, size_t animation, const struct model *standing, struct error *err)
{
    struct meeting meeting = { INFINITY, { 0, 0 }, 0 };
    double step_m[SAMPLES], low_m[SAMPLES + 1], ground_m = INFINITY, stride_m = 0, height_m = model->max_m.z;
    bool grounded[SAMPLES];
    if (!model->rig || animation >= model->rig->animation_count) return error_at(err, ERR_INPUT, model->path, 0, 0, "has no animation: it cannot walk");
    double duration_s = model->rig->animations[animation].duration_s;
    if (!(duration_s > 0)) return error_at(err, ERR_INPUT, model->path, 0, 0, "its animation is a single moment: it cannot walk");
    if (!measure(step_m, low_m, grounded, &meeting, model, animation, duration_s, standing, err)) return false;
    for (int i = 0; i <= SAMPLES; i++) ground_m = fmin(ground_m, low_m[i]);
    for (int i = 0; i < SAMPLES; i++)
        grounded[i] = grounded[i] && fmax(low_m[i], low_m[i + 1]) < ground_m + AIR_SHARE * height_m;
    if (!bridge(step_m, grounded)) return error_at(err, ERR_INPUT, model->path, 0, 0, "no foot is ever on the ground in its animation");
    for (int i = 0; i < SAMPLES; i++) stride_m += step_m[i];
    if (stride_m < -WALK_SHARE * height_m)
        return error_at(err, ERR_INPUT, model->path, 0, 0, "walks backwards, %.2f m in a loop: the opposite front axis would be right", -stride_m);
    double *advance_m = calloc(SAMPLES + 1, sizeof *advance_m);
    if (!advance_m) return error_set(err, ERR_MEMORY, "no memory for a gait");
    for (int i = 0; i < SAMPLES; i++) advance_m[i + 1] = advance_m[i] + fmax(step_m[i], 0); /* nobody steps back */
    *gait = (struct gait){ .duration_s = duration_s, .stride_m = advance_m[SAMPLES], .advance_m = advance_m, .samples = SAMPLES,
                           .walks = stride_m > WALK_SHARE * height_m, .meet_m = advance_m[meeting.sample] + meeting.shift_m.x, .meet_aside_m = meeting.shift_m.y };
    return true;
}

void gait_release(struct gait *gait)
{
    free(gait->advance_m);
    *gait = (struct gait){ 0 };
}

static double fraction(double x)
{
    x -= floor(x);
    return x < 1 ? x : 0;
}

double gait_time(const struct gait *gait, double distance_m, double phase)
{
    phase = fraction(phase);
    if (!gait->walks) return phase * gait->duration_s;
    const double *advance_m = gait->advance_m;
    int low = (int)(phase * gait->samples), high = gait->samples;
    double start_m = advance_m[low] + (phase * gait->samples - low) * (advance_m[low + 1] - advance_m[low]);
    double at_m = fraction((start_m + distance_m) / gait->stride_m) * gait->stride_m;
    for (low = 0; high > low + 1;) {
        int middle = (low + high) / 2;
        if (advance_m[middle] <= at_m) low = middle;
        else high = middle;
    }
    double step_m = advance_m[high] - advance_m[low];
    return gait->duration_s * (low + (step_m > 0 ? (at_m - advance_m[low]) / step_m : 0)) / gait->samples;
}
