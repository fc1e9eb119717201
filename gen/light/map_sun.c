#include "gen/light/map_sun.h"

#include "lib/file.h"

#include <math.h>
#include <stdlib.h>

#define DEG (180 / M_PI)
#define AGREE_DEG 15.0 /* more than a north taken from a picture is off, less than an hour of the sun's way */

bool map_sun_doubt(char **text, const struct light *light, const struct scene *scene, struct error *err)
{
    *text = NULL;
    if (scene->sky != SKY_MAP || scene->sun != SUN_IN_MAP || !light->has_sun || !scene->has_place || !scene->has_time) return true;
    struct sun_position sun;
    const struct vec3 d = light->sun_direction;
    struct error unknown = ERROR_NONE; /* a year that it does not know is no reason for a run to fail that needs no sun of it */
    if (!sun_position(&sun, scene->time_utc, 0, scene->place, (struct atmosphere){ 0, 0 }, &unknown)) return true;
    double azimuth = atan2(d.x, d.y) + scene->north_rad, elevation = asin(fmin(1, d.z));
    struct vec3 shown = vec3(cos(elevation) * sin(azimuth), cos(elevation) * cos(azimuth), sin(elevation));
    double off_deg = acos(fmax(-1, fmin(1, vec3_dot(shown, sun.direction)))) * DEG;
    if (off_deg <= AGREE_DEG) return true;
    *text = string_format("%s:%d:%d: light.map: its sun stands at azimuth %.1f deg, elevation %.1f deg; by place and time it is at "
                          "azimuth %.1f deg, elevation %.1f deg, %.0f deg off: check the map's north, north_deg, place and time",
                          scene->path, scene->map.north_source.line, scene->map.north_source.column, fmod(azimuth * DEG + 720, 360),
                          elevation * DEG, sun.azimuth_rad * DEG, sun.elevation_rad * DEG, off_deg);
    return *text || error_set(err, ERR_MEMORY, "no memory for a warning");
}
