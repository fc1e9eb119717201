#include "gen/scene/nearest.h"

#include <ctype.h>
#include <string.h>

#define LENGTH_MAX 64

static size_t least(size_t a, size_t b) { return a < b ? a : b; }

/* Insertions, deletions, replacements and swaps of neighbours that turn a into b; case is no difference. */
static size_t edit_distance(const char *a, size_t a_length, const char *b, size_t b_length)
{
    size_t rows[3][LENGTH_MAX + 1];
    size_t *before = rows[0], *last = rows[1], *row = rows[2];
    for (size_t j = 0; j <= b_length; j++) last[j] = j;
    for (size_t i = 1; i <= a_length; i++) {
        row[0] = i;
        for (size_t j = 1; j <= b_length; j++) {
            int ca = tolower((unsigned char)a[i - 1]), cb = tolower((unsigned char)b[j - 1]);
            row[j] = least(least(last[j], row[j - 1]) + 1, last[j - 1] + (ca != cb));
            if (i > 1 && j > 1 && ca == tolower((unsigned char)b[j - 2]) && cb == tolower((unsigned char)a[i - 2]))
                row[j] = least(row[j], before[j - 2] + 1);
        }
        size_t *unused = before;
        before = last;
        last = row;
        row = unused;
    }
    return last[b_length];
}

void nearest_offer(struct nearest *nearest, const char *text, const char *candidate)
{
    size_t a = strlen(text), b = strlen(candidate);
    if (a > LENGTH_MAX || b > LENGTH_MAX) return;
    size_t distance = edit_distance(text, a, candidate, b), near = b < 6 ? 1 : b / 3;
    if (!strncmp(candidate, text, a) && candidate[a] == '_') distance = 1; /* the unit was left out */
    if (distance > near || (nearest->name && distance >= nearest->distance)) return;
    *nearest = (struct nearest){ candidate, distance };
}
