#include "import/control_points.h"

#include "lib/file.h"
#include "lib/place.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { NAME, X, Y, Z, LATITUDE, LONGITUDE, HEIGHT, FIELD_COUNT };
static const char *const field_names[FIELD_COUNT] = {
    "NAME", "X", "Y", "Z", "LATITUDE", "LONGITUDE", "HEIGHT",
};
#define WHAT_IS_RIGHT "a line is NAME X Y Z LATITUDE LONGITUDE HEIGHT"

struct place_in_file { const char *path; int line; };
struct point { const char *name; double value[FIELD_COUNT]; };

static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

/* Splits a line where it lies. Out: fields, each ended by NUL; columns from 1; how many (at most one too many). */
static int split(char *fields[FIELD_COUNT + 1], int columns[FIELD_COUNT + 1], char *line)
{
    int count = 0;
    line[strcspn(line, "#")] = 0;
    for (char *c = line; *c && count <= FIELD_COUNT;) {
        if (is_blank(*c)) {
            c++;
            continue;
        }
        fields[count] = c;
        columns[count++] = (int)(c - line) + 1;
        while (*c && !is_blank(*c)) c++;
        if (*c) *c++ = 0;
    }
    return count;
}

static bool read_point(struct point *point, char *fields[], const int columns[], int count, struct place_in_file at,
                       struct error *err)
{
    if (count < FIELD_COUNT) {
        int end = columns[count - 1] + (int)strlen(fields[count - 1]);
        return error_at(err, ERR_INPUT, at.path, at.line, end, "%s is missing; " WHAT_IS_RIGHT, field_names[count]);
    }
    if (count > FIELD_COUNT)
        return error_at(err, ERR_INPUT, at.path, at.line, columns[FIELD_COUNT],
                        "\"%s\" is one field too many; " WHAT_IS_RIGHT ", and a name has no blanks", fields[FIELD_COUNT]);
    point->name = fields[NAME];
    for (int i = X; i < FIELD_COUNT; i++) {
        char *end;
        point->value[i] = strtod(fields[i], &end);
        if (*end || !isfinite(point->value[i]))
            return error_at(err, ERR_INPUT, at.path, at.line, columns[i], "%s is \"%s\", which is no number; " WHAT_IS_RIGHT,
                            field_names[i], fields[i]);
    }
    const double limits[] = { 90, 180 };
    for (int i = LATITUDE; i <= LONGITUDE; i++)
        if (fabs(point->value[i]) > limits[i - LATITUDE])
            return error_at(err, ERR_INPUT, at.path, at.line, columns[i], "%s is %s; it is -%g to %g deg, %s positive",
                            field_names[i], fields[i], limits[i - LATITUDE], limits[i - LATITUDE],
                            i == LATITUDE ? "north" : "east");
    return true;
}

static bool add_tie(struct tie **ties, size_t *n, const struct point *point, const double origin[3],
                    struct place_in_file at, int column, struct error *err)
{
    for (size_t i = 0; i < *n; i++)
        if (!strcmp((*ties)[i].name, point->name))
            return error_at(err, ERR_INPUT, at.path, at.line, column, "there is a point \"%s\" above", point->name);
    double enu_m[3];
    if (!place_enu_from_geodetic(enu_m, origin, &point->value[LATITUDE], err)) return false;
    struct tie *grown = realloc(*ties, (*n + 1) * sizeof **ties);
    if (grown) *ties = grown;
    char *name = grown ? strdup(point->name) : NULL;
    if (!name) return error_set(err, ERR_MEMORY, "no memory for %zu control points", *n + 1);
    grown[(*n)++] = (struct tie){
        .name = name,
        .p_reconstruction = { point->value[X], point->value[Y], point->value[Z] },
        .p_enu_m = { enu_m[0], enu_m[1], enu_m[2] },
    };
    return true;
}

bool control_points_read(struct tie **ties, size_t *n, double origin_lat_lon_h[3], const char *path, struct error *err)
{
    char *text;
    size_t size;
    if (!file_read(&text, &size, path, err)) return false;
    struct tie *found = NULL;
    size_t count = 0;
    double origin[3] = { 0 };
    struct place_in_file at = { path, 1 };
    bool good = true;
    for (char *line = text, *next; good && line < text + size; line = next, at.line++) {
        next = line + strcspn(line, "\n") + 1;
        next[-1] = 0;
        char *fields[FIELD_COUNT + 1];
        int columns[FIELD_COUNT + 1], field_count = split(fields, columns, line);
        if (!field_count) continue;
        struct point point;
        good = read_point(&point, fields, columns, field_count, at, err);
        if (good && !count) memcpy(origin, &point.value[LATITUDE], sizeof origin);
        good = good && add_tie(&found, &count, &point, origin, at, columns[NAME], err);
    }
    if (good && !count) good = error_at(err, ERR_INPUT, path, 0, 0, "no control point is in it; " WHAT_IS_RIGHT);
    free(text);
    if (!good) {
        control_points_release(found, count);
        return false;
    }
    memcpy(origin_lat_lon_h, origin, sizeof origin);
    *ties = found;
    *n = count;
    return true;
}

void control_points_release(struct tie *ties, size_t n)
{
    for (size_t i = 0; i < n; i++) free((void *)ties[i].name);
    free(ties);
}
