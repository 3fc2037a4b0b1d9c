/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What src/dyadic takes from <math.h>, as far as integers go: the values of doubles are no part of these proofs. */
#ifndef DYD_PROOFS_MATH_H
#define DYD_PROOFS_MATH_H

#define HUGE_VAL 1e300
/*@ assigns \nothing; exits \false; */
int isfinite(double x);
/*@ requires \valid(exp); assigns *exp; exits \false; ensures -1073 <= *exp <= 1024; */
double frexp(double x, int *exp);
/*@ assigns \nothing; exits \false; */
double ldexp(double x, int exp);

#endif
