/* Numbers in text files, fast: what is in the C locale and has up to 19 digits is made here, the rest by strtod. */
#ifndef STAFFAGE_GEN_NUMBER_H
#define STAFFAGE_GEN_NUMBER_H

#include <stdbool.h>

/* Read a number after blanks (and line ends); *at moves behind it. False, *at untouched, where there is none.
 * The text must end in a NUL byte. The value is the double nearest to what is written. */
bool number_read(const char **at, double *value);

#endif
