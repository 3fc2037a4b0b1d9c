/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/dyadic/text.c: LENGTH is that of the text that is read, of any bytes. */
#include "contracts.h"

#include "base/error.h"
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

/* "*2^", a sign, 19 digits, the end. */
/*@ requires \valid(at + (0 .. 23)); assigns at[0 .. 23]; exits \false; */
void print_exponent(char *at, int64_t exp);
#define sprintf(at, format, exp) print_exponent(at, exp)
/*@ assigns \nothing; exits \false; */
const char *dyd_status_text(dyd_status status);

/*@ axiomatic Length { logic integer LENGTH; axiom length: 0 <= LENGTH <= 1152921504606846976; } */
#include "dyadic/text.c"
