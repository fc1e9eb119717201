/* What air does to what is seen through it. */
#ifndef STAFFAGE_LIB_AIR_H
#define STAFFAGE_LIB_AIR_H

/* What remains of contrast over a distance, T = 0.05 ^ (distance / visibility); 1 for one not known.
 * Src: Koschmieder's law; WMO Guide to Instruments and Methods of Observation, chapter 9 */
double air_transmission(double visibility_m, double distance_m);

#endif
