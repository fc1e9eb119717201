#include "lib/place.h"

#include <GeographicLib/LocalCartesian.hpp>

#include <cmath>
#include <exception>

namespace {

bool is_finite(const double v[3])
{
    return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

/* The library answers a bad latitude with NaN, not with an exception. */
bool is_place(const double lat_lon_h[3], struct error *err)
{
    if (is_finite(lat_lon_h) && std::fabs(lat_lon_h[0]) <= 90) return true;
    return error_set(err, ERR_INPUT,
                     "no place has latitude %.9g, longitude %.9g, height %.9g; latitude is -90 to 90 deg, north positive",
                     lat_lon_h[0], lat_lon_h[1], lat_lon_h[2]);
}

template <class Conversion>
bool convert(double out[3], struct error *err, Conversion conversion)
{
    try {
        double result[3];
        conversion(result);
        if (!is_finite(result)) return error_set(err, ERR_INPUT, "the place is too far away to be converted");
        for (int i = 0; i < 3; i++) out[i] = result[i];
        return true;
    } catch (const std::exception &e) {
        return error_set(err, ERR_BUG, "GeographicLib: %s", e.what());
    } catch (...) {
        return error_set(err, ERR_BUG, "GeographicLib: an unknown exception");
    }
}

}

extern "C" bool place_enu_from_geodetic(double enu_m[3], const double origin_lat_lon_h[3], const double lat_lon_h[3],
                                        struct error *err)
{
    if (!is_place(origin_lat_lon_h, err) || !is_place(lat_lon_h, err)) return false;
    return convert(enu_m, err, [&](double out[3]) {
        GeographicLib::LocalCartesian local(origin_lat_lon_h[0], origin_lat_lon_h[1], origin_lat_lon_h[2]);
        local.Forward(lat_lon_h[0], lat_lon_h[1], lat_lon_h[2], out[0], out[1], out[2]);
    });
}

extern "C" bool place_geodetic_from_enu(double lat_lon_h[3], const double origin_lat_lon_h[3], const double enu_m[3],
                                        struct error *err)
{
    if (!is_place(origin_lat_lon_h, err)) return false;
    if (!is_finite(enu_m)) return error_set(err, ERR_INPUT, "a place's east, north or up is not finite");
    return convert(lat_lon_h, err, [&](double out[3]) {
        GeographicLib::LocalCartesian local(origin_lat_lon_h[0], origin_lat_lon_h[1], origin_lat_lon_h[2]);
        local.Reverse(enu_m[0], enu_m[1], enu_m[2], out[0], out[1], out[2]);
    });
}
