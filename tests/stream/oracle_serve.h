/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The other side of an oracle: the test program itself, started again as a program that serves points. */
#ifndef DYD_TESTS_STREAM_ORACLE_SERVE_H
#define DYD_TESTS_STREAM_ORACLE_SERVE_H

#include <gmp.h>
#include <stdint.h>

/* The point that misbehaves. */
#define BAD_POINT 2

/* floor(2^bits value) for coordinate `axis` of point k: the points are (k^2, k^3) / 7. */
void oracle_floor(mpz_t out, unsigned long k, int axis, int64_t bits);

/* argv: "serve" FAULT N STAGE [MORE]. Serves N points by the protocol; point BAD_POINT misbehaves as FAULT says when it
 * has been answered STAGE times. The faults are those of the table in oracle_serve.c. */
int oracle_serve(int argc, char **argv);

#endif
