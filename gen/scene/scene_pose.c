#include "gen/scene/scene_pose.h"

#include "gen/scene/scene_keys.h"

/* Figures in files are rounded: this much off is still meant as a rotation. */
#define ROUNDING 1e-3

struct reading { const char *file; struct error *err; };
#define FAIL(r, node, ...) \
    error_at((r)->err, ERR_INPUT, (r)->file, (node)->line, (node)->column, __VA_ARGS__)

static struct vec3 read_vec3(const struct yaml_node *node)
{
    double v[3];
    schema_numbers(v, 3, node);
    return vec3(v[0], v[1], v[2]);
}

/* Columns: where the x, y and z of the file's world point to. May mirror. */
static bool read_world_axes(const struct reading *r, struct mat3 *world_from_file, const struct yaml_node *axes)
{
    static const struct vec3 directions[] = {
        [WORLD_EAST] = { 1, 0, 0 },  [WORLD_WEST] = { -1, 0, 0 }, [WORLD_NORTH] = { 0, 1, 0 },
        [WORLD_SOUTH] = { 0, -1, 0 }, [WORLD_UP] = { 0, 0, 1 },   [WORLD_DOWN] = { 0, 0, -1 },
    };
    struct vec3 column[3];
    for (int i = 0; i < 3; i++) column[i] = directions[schema_choice(world_direction_name, axes->items[i])];
    struct mat3 columns = mat3_from_columns(column[0], column[1], column[2]);
    if (mat3_orthonormality(columns) > 0)
        return FAIL(r, axes,
                    "camera.pose.world_axes: one each of east or west, north or south, up or down is needed");
    *world_from_file = columns;
    return true;
}

static struct mat3 file_camera_from_camera(enum camera_axes axes)
{
    switch (axes) {
    case CAMERA_AXES_OPENGL: return (struct mat3){ { { 1, 0, 0 }, { 0, -1, 0 }, { 0, 0, -1 } } };
    case CAMERA_AXES_X_LEFT_Y_UP: return (struct mat3){ { { -1, 0, 0 }, { 0, -1, 0 }, { 0, 0, 1 } } };
    case CAMERA_AXES_OPENCV: break;
    }
    return mat3_identity();
}

/* The orthonormal matrix near to one that is nearly so; keeps the handedness. */
static struct mat3 straighten(struct mat3 m)
{
    struct vec3 x = mat3_column(m, 0), y = mat3_column(m, 1), z = mat3_column(m, 2);
    if (mat3_determinant(m) > 0) return mat3_orthonormalize(m);
    m = mat3_orthonormalize(mat3_from_columns(vec3_scale(x, -1), y, z));
    return mat3_from_columns(vec3_scale(mat3_column(m, 0), -1), mat3_column(m, 1), mat3_column(m, 2));
}

/* The upper left 3x3 of rows. */
static bool read_matrix(const struct reading *r, struct mat3 *rotation, const struct yaml_node *rows, const char *key)
{
    struct mat3 m;
    for (int i = 0; i < 3; i++) schema_numbers(m.m[i], 3, rows->items[i]);
    double off = mat3_orthonormality(m);
    if (!(off <= ROUNDING))
        return FAIL(r, rows,
                    "camera.pose.%s: not a rotation: its rows must have length 1 and be at right angles, these are "
                    "off by %.2g", key, off);
    *rotation = straighten(m);
    return true;
}

static bool read_quaternion(const struct reading *r, struct mat3 *rotation, const struct yaml_node *wxyz,
                            const char *key)
{
    double q[4];
    schema_numbers(q, 4, wxyz);
    double norm = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(fabs(norm - 1) <= ROUNDING))
        return FAIL(r, wxyz, "camera.pose.%s: the norm is %.4g, that of a rotation is 1", key, norm);
    *rotation = mat3_from_quat((struct quat){ q[0], q[1], q[2], q[3] });
    return true;
}

static bool read_transform(const struct reading *r, struct pose *pose, const struct yaml_node *matrix)
{
    static const double last[4] = { 0, 0, 0, 1 };
    struct mat3 rotation;
    if (!read_matrix(r, &rotation, matrix, "matrix")) return false;
    double row[4];
    if (matrix->count == 4) {
        schema_numbers(row, 4, matrix->items[3]);
        for (int j = 0; j < 4; j++)
            if (row[j] != last[j])
                return FAIL(r, matrix->items[3], "camera.pose.matrix[3]: the last row must be [0, 0, 0, 1]");
    }
    double t[3];
    for (int i = 0; i < 3; i++) {
        schema_numbers(row, 4, matrix->items[i]);
        t[i] = row[3];
    }
    *pose = (struct pose){ rotation, vec3(t[0], t[1], t[2]) };
    return true;
}

static bool read_camera_from_world(const struct reading *r, struct pose *pose, const struct yaml_node *node)
{
    const struct yaml_node *quaternion = yaml_get(node, "quaternion_wxyz"), *rows = yaml_get(node, "rotation");
    struct mat3 rotation;
    if (quaternion ? !read_quaternion(r, &rotation, quaternion, "camera_from_world.quaternion_wxyz")
                   : !read_matrix(r, &rotation, rows, "camera_from_world.rotation"))
        return false;
    *pose = pose_inverse((struct pose){ rotation, read_vec3(yaml_get(node, "translation_m")) });
    return true;
}

static bool read_position(const struct reading *r, struct pose *pose, const struct yaml_node *node)
{
    const struct yaml_node *quaternion = yaml_get(node, "quaternion_wxyz"), *rows = yaml_get(node, "rotation");
    const struct yaml_node *position = yaml_get(node, "position_m");
    struct mat3 rotation;
    if (!quaternion == !rows)
        return FAIL(r, position, "camera.pose.position_m: goes with %s quaternion_wxyz or rotation",
                    quaternion ? "only one of" : "one of");
    if (quaternion ? !read_quaternion(r, &rotation, quaternion, "quaternion_wxyz")
                   : !read_matrix(r, &rotation, rows, "rotation"))
        return false;
    *pose = (struct pose){ rotation, read_vec3(position) };
    return true;
}

/* Out: in CONVENTIONS axes on both sides. */
static bool read_look_at(const struct reading *r, struct pose *world_from_camera, struct mat3 world_from_file,
                         const struct yaml_node *node)
{
    const struct yaml_node *target = yaml_get(node, "target_m"), *up_given = yaml_get(node, "up");
    struct vec3 position = mat3_apply(world_from_file, read_vec3(yaml_get(node, "position_m")));
    struct vec3 forward = vec3_sub(mat3_apply(world_from_file, read_vec3(target)), position);
    struct vec3 up = up_given ? mat3_apply(world_from_file, read_vec3(up_given)) : vec3(0, 0, 1);
    if (!(vec3_norm(forward) > 0)) return FAIL(r, target, "camera.pose.look_at.target_m: is where the camera stands");
    if (!(vec3_norm(up) > 0)) return FAIL(r, up_given, "camera.pose.look_at.up: has no direction");
    forward = vec3_unit(forward);
    struct vec3 right = vec3_cross(forward, vec3_unit(up));
    if (vec3_norm(right) < 1e-6)
        return FAIL(r, up_given ? up_given : target,
                    "camera.pose.look_at: the view goes along up: give another \"up\" (what points to the "
                    "top of the picture)");
    right = vec3_unit(right);
    struct vec3 down = vec3_cross(forward, right);
    double roll = schema_number(yaml_get(node, "roll_deg")) * M_PI / 180, c = cos(roll), s = sin(roll);
    struct vec3 x = vec3_add(vec3_scale(right, c), vec3_scale(down, s));
    struct vec3 y = vec3_sub(vec3_scale(down, c), vec3_scale(right, s));
    *world_from_camera = (struct pose){ mat3_from_columns(x, y, forward), position };
    return true;
}

bool scene_pose(struct pose *world_from_camera, const struct yaml_node *node, const char *file, struct error *err)
{
    struct reading r = { file, err };
    const struct yaml_node *matrix = yaml_get(node, "matrix"), *inverse = yaml_get(node, "camera_from_world");
    const struct yaml_node *position = yaml_get(node, "position_m"), *look_at = yaml_get(node, "look_at");
    const struct yaml_node *axes = yaml_get(node, "axes"), *world_axes = yaml_get(node, "world_axes");
    const struct yaml_node *alone = yaml_get(node, "quaternion_wxyz");
    if (!alone) alone = yaml_get(node, "rotation");
    if (alone && !position)
        return FAIL(&r, alone, "camera.pose: quaternion_wxyz and rotation go with position_m");
    struct mat3 world_from_file;
    if (!read_world_axes(&r, &world_from_file, world_axes)) return false;
    if (look_at && !axes->is_default)
        return FAIL(&r, axes, "camera.pose.axes: has no meaning with look_at: remove it");
    if (look_at) return read_look_at(&r, world_from_camera, world_from_file, look_at);

    struct pose pose = pose_identity();
    if (matrix       ? !read_transform(&r, &pose, matrix)
        : inverse    ? !read_camera_from_world(&r, &pose, inverse)
                     : !read_position(&r, &pose, node))
        return false;
    struct mat3 to_camera = file_camera_from_camera((enum camera_axes)schema_choice(camera_axes_name, axes));
    struct mat3 rotation = mat3_multiply(world_from_file, mat3_multiply(pose.rotation, to_camera));
    if (mat3_determinant(rotation) < 0)
        return FAIL(&r, matrix ? matrix : inverse ? inverse : position,
                    "camera.pose: mirrors (determinant -1) with axes %s and world_axes [%s, %s, %s]: one of "
                    "them is not what these figures are in",
                    axes->text, world_axes->items[0]->text, world_axes->items[1]->text, world_axes->items[2]->text);
    *world_from_camera = (struct pose){ rotation, mat3_apply(world_from_file, pose.translation) };
    return true;
}
