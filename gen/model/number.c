#include "gen/model/number.h"

#include <ctype.h>
#include <stdint.h>
#include <stdlib.h>

/* Powers of ten that a double holds exactly: one multiplication or division of two exact numbers rounds once.
 * Src: Clinger 1990, How to Read Floating Point Numbers Accurately, the easy case */
static const double tens[] = { 1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                               1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22 };
#define EXACT_MAX (UINT64_C(1) << 53)

static bool by_strtod(const char **at, double *value)
{
    char *end;
    double v = strtod(*at, &end);
    if (end == *at) return false;
    *value = v;
    *at = end;
    return true;
}

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

bool number_read(const char **at, double *value)
{
    const char *c = *at;
    while (*c == ' ' || (*c >= '\t' && *c <= '\r')) c++;
    bool negative = *c == '-';
    if (*c == '-' || *c == '+') c++;
    uint64_t digits = 0;
    int count = 0, exponent = 0;
    for (; is_digit(*c); c++, count++) digits = digits * 10 + (uint64_t)(*c - '0');
    if (*c == '.')
        for (c++; is_digit(*c); c++, count++, exponent--) digits = digits * 10 + (uint64_t)(*c - '0');
    if (count == 0 || count > 19 || isalpha((unsigned char)*c)) {
        if (count == 0 || (*c != 'e' && *c != 'E')) return by_strtod(at, value);
        const char *e = c + 1;
        bool down = *e == '-';
        int power = 0, places = 0;
        if (*e == '-' || *e == '+') e++;
        for (; is_digit(*e) && places < 4; e++, places++) power = power * 10 + (*e - '0');
        if (count > 19 || places == 0 || places == 4) return by_strtod(at, value);
        exponent += down ? -power : power;
        c = e;
    }
    if (digits > EXACT_MAX || exponent < -22 || exponent > 22) return by_strtod(at, value);
    double v = exponent < 0 ? (double)digits / tens[-exponent] : (double)digits * tens[exponent];
    *value = negative ? -v : v;
    *at = c;
    return true;
}
