/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/dyadic/text.c. */
/* Unproved dyd_numeral_digits_assigns_exit_part3, dyd_numeral_digits_assigns_exit_part4,
   dyd_numeral_digits_assigns_normal_part4, dyd_numeral_digits_assigns_normal_part5: the digits are in new memory, of
   which the caller knows nothing; WP does not follow malloc. */
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

/*@ assigns \nothing; exits \false; */
static inline bool dyd_is_blank(char c);
#include "dyadic/text.c"
