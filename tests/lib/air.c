#include "lib/air.h"

#include "tests/tap.h"

int main(void)
{
    NEAR(air_transmission(200, 200), 0.05, 1e-12, "at the visibility a twentieth of the contrast remains");
    NEAR(air_transmission(200, 100), 0.22360679775, 1e-10, "at half of it the square root");
    NEAR(air_transmission(200, 0), 1, 0, "here, all");
    NEAR(air_transmission(200, (double)NAN), 1, 0, "at no known distance, all");
    return tap_done();
}
