/* How bright a colour is: its CIE Y, linear light of Rec.709 primaries. */
#ifndef STAFFAGE_LIB_LUMINANCE_H
#define STAFFAGE_LIB_LUMINANCE_H

static inline double luminance_of(const double linear[3])
{
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2];
}

static inline double luminance_of_f32(const float linear[3])
{
    return luminance_of((const double[3]){ (double)linear[0], (double)linear[1], (double)linear[2] });
}

#endif
