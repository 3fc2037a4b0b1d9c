/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* How vectors are chosen, answered and written: a line for each, NAME INPUT ... = ANSWER, for the program of
 * harness.ml.
 *
 * Numbers are chosen where filters could be wrong: integers, neighbours in the last bits, points on a line or a circle,
 * exponents at both ends, zeros of both signs, subnormals, infinities, NaN; and both sides of places where an answer
 * changes. Doubles are written as their 64 bits, in hexadecimal; integers in decimal. */
#ifndef DYD_DEFINITIONS_VECTORS_H
#define DYD_DEFINITIONS_VECTORS_H

#include "support/random.h"

#include <gmp.h>

extern test_random shared;

/* ---- numbers ---- */

/* What the numbers of one vector have in common. */
typedef struct kind {
  int base;    /* exponent */
  unsigned of; /* 0: anything; 1: small integers; 2: near one place; 3: multiples of one vector, and a little */
  double step;
} kind;

double special(void);
double number(const kind *k);

/* ---- answers ---- */

typedef struct answer {
  char text[4096];
  size_t length;
} answer;

void say_double(answer *a, double y);
void say_doubles(answer *a, const double *y, size_t count);
void say_integer(answer *a, long y);
void say_big(answer *a, mpz_srcptr y);
void say_none(answer *a);

/* ---- functions ---- */

enum { INPUTS = 32 };
typedef struct function {
  const char *name; /* of the function in C */
  unsigned inputs;
  void (*ask)(answer *a, const double *x);
  void (*choose)(double *x, unsigned inputs, const kind *k); /* NULL: any numbers */
  unsigned edges; /* how often it is tried to find a place where the answer changes */
  unsigned flags; /* number of inputs at the end that are small integers: they stay */
} function;

/* In pairs, the lower one first, but for a few; the rest as any numbers. */
void choose_intervals(double *x, unsigned inputs, const kind *k);
void put_vector(const function *f, const double *x);
/* A vector of each, and places where their answers change. */
void put_vectors(const function *f, size_t count, const kind *k);

/* The same with integers. */
typedef struct whole {
  const char *name;
  unsigned inputs;
  void (*ask)(answer *a, mpz_t *z);
  void (*choose)(mpz_t *z, unsigned inputs);
} whole;
void put_wholes(const whole *f, size_t count);

/* ---- one case of each subject ---- */

void vectors_of_areas(const kind *k);
void vectors_of_boxes(const kind *k);
void vectors_of_circles(const kind *k);
void vectors_of_expressions(const kind *k);
void vectors_of_fixed(const kind *k);
void vectors_of_intervals(const kind *k);
void vectors_of_near(const kind *k);
void vectors_of_plane(const kind *k);
void vectors_of_stars(const kind *k);

#endif
