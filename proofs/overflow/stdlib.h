/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Of <stdlib.h> what these proofs need: memory of so many bytes, or none. */
#ifndef DYD_PROOFS_STDLIB_H
#define DYD_PROOFS_STDLIB_H

#include <stddef.h>
#include <string.h>

/*@ assigns \nothing; exits \false;
    ensures \result == \null || \valid((char *)\result + (0 .. size - 1)); */
void *malloc(size_t size);
/*@ assigns \nothing; exits \false;
    ensures \result == \null || \valid((char *)\result + (0 .. size - 1)); */
void *realloc(void *p, size_t size);
/*@ assigns \nothing; exits \false; */
void free(void *p);
/*@ requires string(text) && end == \null && base == 10; assigns \nothing; exits \false;
    ensures stop(text) <= 18 ==> -999999999999999999 <= \result <= 999999999999999999; */
long long strtoll(const char *text, char **end, int base);

#endif
