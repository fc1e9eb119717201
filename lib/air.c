#include "lib/air.h"

#include <math.h>

double air_transmission(double visibility_m, double distance_m)
{
    return distance_m > 0 ? exp(log(0.05) * distance_m / visibility_m) : 1;
}
