/* project-box LABELS.json ID  EYE TARGET (x y z each)  FX FY CX CY K1 K2 P1 P2
 * Projects the box of an entity, by its labelled pose in the world and size, with a camera that the command line tells, and
 * prints by how many pixels it misses box_amodal_px at most. Nothing of the project's own code is used.
 * Src: the camera as OpenCV's documentation of calibrateCamera has it, pixels from the corner of the first. */
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static void numbers(double *to, size_t n, const json_t *array)
{
    for (size_t i = 0; i < n; i++) to[i] = json_number_value(json_array_get(array, i));
}

static const json_t *find(const json_t *labels, int id)
{
    const json_t *list = json_object_get(labels, "entities");
    for (size_t i = 0; i < json_array_size(list); i++)
        if (json_integer_value(json_object_get(json_array_get(list, i), "id")) == id) return json_array_get(list, i);
    return NULL;
}

static void cross(double c[3], const double a[3], const double b[3])
{
    for (int i = 0; i < 3; i++) c[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static void unit(double a[3])
{
    double n = sqrt(dot(a, a));
    for (int i = 0; i < 3; i++) a[i] /= n;
}

/* q v q* by v + 2 w (u x v) + 2 u x (u x v) */
static void rotate(double out[3], const double q[4], const double v[3])
{
    double once[3], twice[3];
    cross(once, q + 1, v);
    cross(twice, q + 1, once);
    for (int i = 0; i < 3; i++) out[i] = v[i] + 2 * q[0] * once[i] + 2 * twice[i];
}

static void project(double px[2], const double p[3], const double eye[3], const double target[3], const double lens[8])
{
    double ahead[3], right[3], down[3], from[3];
    const double up[3] = { 0, 0, 1 };
    for (int i = 0; i < 3; i++) ahead[i] = target[i] - eye[i], from[i] = p[i] - eye[i];
    unit(ahead);
    cross(right, ahead, up);
    unit(right);
    cross(down, ahead, right);
    double z = dot(from, ahead), x = dot(from, right) / z, y = dot(from, down) / z, r2 = x * x + y * y;
    const double k1 = lens[4], k2 = lens[5], p1 = lens[6], p2 = lens[7], radial = 1 + r2 * (k1 + r2 * k2);
    px[0] = lens[0] * (x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x)) + lens[2];
    px[1] = lens[1] * (y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y) + lens[3];
}

int main(int argc, char **argv)
{
    json_error_t error;
    if (argc != 17) return 2;
    json_t *labels = json_load_file(argv[1], 0, &error);
    const json_t *entity = labels ? find(labels, atoi(argv[2])) : NULL;
    if (!entity) return 2;
    double given[14], q[4], t[3], size[3], box[4], low[2] = { INFINITY, INFINITY }, high[2] = { -INFINITY, -INFINITY };
    for (int i = 0; i < 14; i++) given[i] = strtod(argv[3 + i], NULL);
    const json_t *pose = json_object_get(entity, "world_from_entity");
    numbers(q, 4, json_object_get(pose, "quaternion_wxyz"));
    numbers(t, 3, json_object_get(pose, "translation_m"));
    numbers(size, 3, json_object_get(entity, "size_m"));
    numbers(box, 4, json_object_get(entity, "box_amodal_px"));
    for (int corner = 0; corner < 8; corner++) {
        double own[3] = { (corner & 4 ? 0.5 : -0.5) * size[0], (corner & 2 ? 0.5 : -0.5) * size[1], corner & 1 ? size[2] : 0 };
        double p[3], px[2];
        rotate(p, q, own);
        for (int i = 0; i < 3; i++) p[i] += t[i];
        project(px, p, given, given + 3, given + 6);
        for (int i = 0; i < 2; i++) low[i] = fmin(low[i], px[i]), high[i] = fmax(high[i], px[i]);
    }
    double off = 0;
    for (int i = 0; i < 2; i++) off = fmax(off, fmax(fabs(low[i] - box[i]), fabs(high[i] - box[i] - box[i + 2])));
    printf("%.3f\n", off);
    json_decref(labels);
    return 0;
}
