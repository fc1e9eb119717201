#include "lib/draw.h"

#include <math.h>

uint64_t splitmix64(uint64_t *state)
{
    uint64_t z = *state += 0x9e3779b97f4a7c15;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9;
    z = (z ^ z >> 27) * 0x94d049bb133111eb;
    return z ^ z >> 31;
}

/* Each field is mixed in before the next, so that keys which differ anywhere share no sequence. */
static uint64_t fold(uint64_t hash, uint64_t field)
{
    uint64_t state = hash ^ field;
    return splitmix64(&state);
}

double draw_uniform(struct draw_key key, uint32_t index)
{
    uint64_t hash = fold(0, key.seed);
    hash = fold(hash, (uint64_t)key.frame);
    hash = fold(hash, key.entity);
    hash = fold(hash, (uint64_t)key.purpose);
    hash = fold(hash, index);
    return (double)(hash >> 11) * 0x1p-53;
}

size_t draw_weighted(struct draw_key key, const double *weights, size_t n)
{
    double sum = 0;
    for (size_t i = 0; i < n; i++) sum += weights[i];
    double left = draw_uniform(key, 0) * sum;
    size_t i = 0;
    while (i + 1 < n && left >= weights[i]) left -= weights[i++];
    return i;
}

double draw_normal(struct draw_key key, uint32_t index)
{
    double p = draw_uniform(key, index) + 0x1p-54; /* never 0 */
    double tail = fmin(p, 1 - p), t = sqrt(-2 * log(tail));
    /* Abramowitz & Stegun 26.2.23 is good to 4.5e-4; two steps of Newton's give the rest. */
    double x = t - (2.515517 + t * (0.802853 + t * 0.010328)) / (1 + t * (1.432788 + t * (0.189269 + t * 0.001308)));
    for (int k = 0; k < 2; k++)
        x += (erfc(x * M_SQRT1_2) / 2 - tail) * sqrt(2 * M_PI) * exp(x * x / 2);
    return p < 0.5 ? -x : x;
}
