/* The Test Anything Protocol, as automake's driver reads it. A test program is a list of
 * OK(...) and NEAR(...) calls between main's braces, and ends with `return tap_done();`. */
#ifndef STAFFAGE_TESTS_TAP_H
#define STAFFAGE_TESTS_TAP_H

#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int tap_count, tap_failed;

__attribute__((format(printf, 4, 5), unused))
static bool tap_ok(bool good, const char *file, int line, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    printf("%sok %d - ", good ? "" : "not ", ++tap_count);
    vprintf(format, args);
    putchar('\n');
    va_end(args);
    if (!good) {
        tap_failed++;
        printf("# failed at %s:%d\n", file, line);
    }
    fflush(stdout);
    return good;
}

/* OK(condition, "behaviour, in words", ...) */
#define OK(condition, ...) tap_ok((condition), __FILE__, __LINE__, __VA_ARGS__)

/* NEAR(got, want, tolerance, "behaviour") : prints the figures when they differ */
#define NEAR(got, want, tolerance, ...) \
    do { \
        double tap_got = (got), tap_want = (want), tap_tol = (tolerance); \
        if (!tap_ok(fabs(tap_got - tap_want) <= tap_tol, __FILE__, __LINE__, __VA_ARGS__)) \
            printf("# got %.12g, want %.12g +- %.3g\n", tap_got, tap_want, tap_tol); \
    } while (0)

/* SKIP("what", "why") counts as passed and is shown as skipped. */
#define SKIP(what, why) printf("ok %d - %s # SKIP %s\n", ++tap_count, what, why)

__attribute__((unused))
static int tap_done(void)
{
    printf("1..%d\n", tap_count);
    fflush(stdout);
    return tap_failed != 0;
}

/* The folder of real material, or NULL where there is none. */
__attribute__((unused))
static const char *tap_shared(void)
{
    static char path[512];
    const char *given = getenv("STAFFAGE_SHARED"), *top = getenv("top_srcdir");
    snprintf(path, sizeof path, "%s", given ? given : "");
    if (!given) snprintf(path, sizeof path, "%s/../shared", top ? top : ".");
    char probe[600];
    snprintf(probe, sizeof probe, "%s/data/README.md", path);
    FILE *f = fopen(probe, "r");
    if (f) fclose(f);
    return f ? path : NULL;
}

#endif
