#include "lib/draw.h"

#include "tests/tap.h"

#define N 100000

static double correlation(const double *a, const double *b, int n)
{
    double sum = 0;
    for (int i = 0; i < n; i++) sum += (a[i] - 0.5) * (b[i] - 0.5);
    return sum / n * 12;
}

int main(void)
{
    /* Published for seed 1234567, e.g. Rosetta Code, "Pseudo-random numbers/Splitmix64". */
    static const uint64_t published[5] = { 6457827717110365317u, 3203168211198807973u, 9817491932198370423u,
                                           4593380528125082431u, 16408922859458223821u };
    uint64_t state = 1234567;
    bool same = true;
    for (int i = 0; i < 5; i++) same = splitmix64(&state) == published[i] && same;
    OK(same, "splitmix64 gives the published sequence");

    static double u[N], by_entity[N], by_seed[N], by_purpose[N], by_frame[N];
    struct draw_key key = { .seed = 7, .frame = 3, .entity = 5, .purpose = DRAW_SPEED };
    long bins[100] = { 0 };
    bool inside = true;
    for (int i = 0; i < N; i++) {
        u[i] = draw_uniform(key, (uint32_t)i);
        inside = inside && u[i] >= 0 && u[i] < 1;
        bins[(int)(u[i] * 100)]++;
        struct draw_key other = key;
        other.entity = (uint32_t)i;
        by_entity[i] = draw_uniform(other, 0);
        other = key;
        other.seed = (uint64_t)i;
        by_seed[i] = draw_uniform(other, 0);
        other = key;
        other.purpose = DRAW_PHASE;
        by_purpose[i] = draw_uniform(other, (uint32_t)i);
        other = key;
        other.frame = -key.frame;
        by_frame[i] = draw_uniform(other, (uint32_t)i);
    }
    OK(inside, "draws are in [0, 1)");
    double chi2 = 0;
    for (int i = 0; i < 100; i++) chi2 += (double)((bins[i] - N / 100) * (bins[i] - N / 100)) / (N / 100);
    /* 99 degrees of freedom: below 67 or above 139 comes once in 200 times on either side. */
    OK(chi2 > 67 && chi2 < 139, "and uniform: chi-squared of 100 bins is %.1f", chi2);

    double limit = 4 / sqrt(N);
    NEAR(correlation(u, u + 1, N - 1), 0, limit, "one index says nothing of the next");
    NEAR(correlation(by_entity, by_entity + 1, N - 1), 0, limit, "one entity nothing of the next");
    NEAR(correlation(by_seed, by_seed + 1, N - 1), 0, limit, "one seed nothing of the next");
    NEAR(correlation(u, by_purpose, N), 0, limit, "one purpose nothing of another");
    NEAR(correlation(u, by_frame, N), 0, limit, "one frame nothing of another");
    NEAR(correlation(by_seed, by_entity, N), 0, limit, "a seed is not an entity");
    OK(draw_uniform(key, 12345) == u[12345], "a key gives its number again, whatever was drawn between");

    double sum = 0, squares = 0;
    int below[3] = { 0 };
    static const double quantile[3] = { -1.959963985, 0.674489750, 2.575829304 }, share[3] = { 0.025, 0.75, 0.995 };
    double worst = 0;
    for (int i = 0; i < N; i++) {
        double x = draw_normal(key, (uint32_t)i);
        sum += x;
        squares += x * x;
        for (int k = 0; k < 3; k++) below[k] += x < quantile[k];
        worst = fmax(worst, fabs(erfc(-x / sqrt(2)) / 2 - u[i]));
    }
    NEAR(sum / N, 0, 4 / sqrt(N), "normal draws have mean 0");
    NEAR(squares / N, 1, 4 * sqrt(2.0 / N), "and variance 1");
    for (int k = 0; k < 3; k++)
        NEAR((double)below[k] / N, share[k], 4 * sqrt(share[k] * (1 - share[k]) / N), "the %.3f quantile is in its place",
             share[k]);
    NEAR(worst, 0, 1e-9, "the distribution takes each normal draw back to its uniform one");
    return tap_done();
}
