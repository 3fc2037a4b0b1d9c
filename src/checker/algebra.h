/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Numbers that a certificate describes, one by one from those before, with what is known of each: a quotient of
 * polynomials in leaves, and an enclosure to any precision.
 *
 * A number that is not rational in those before makes a leaf, unless equal operands made it before (exp, cos, ...), or
 * the certificate says what it is, and this is checked: sqrt a = V where V^2 = a and V >= 0 [CERT-10]. */
#ifndef DYD_CHECKER_ALGEBRA_H
#define DYD_CHECKER_ALGEBRA_H

#include "checker/enclosure.h"
#include "checker/quotient.h"
#include "checker/read.h"

/* Greatest N of 2 cos(2 pi / N), degree of a polynomial; precision to which numbers are enclosed, and to which signs
 * are looked for. */
#define DYD_CERT_ORDER 1024
#define DYD_CERT_DEGREE 1000
#define DYD_CERT_PRECISION ((long)1 << 14)
#define DYD_CERT_SIGN_PRECISION ((long)1 << 12)

/* In the order of their names in algebra.c. */
typedef enum dyd_cert_op {
  DYD_CERT_VALUE, /* = V */
  DYD_CERT_ADD,
  DYD_CERT_SUB,
  DYD_CERT_MUL,
  DYD_CERT_DIV,
  DYD_CERT_MIN,
  DYD_CERT_MAX,
  DYD_CERT_POW, /* ^ a n */
  DYD_CERT_NEG,
  DYD_CERT_CLAIM, /* what a callback gives is number a, its author says */
  DYD_CERT_ABS,
  DYD_CERT_SQRT, /* may be followed by V */
  DYD_CERT_CBRT,
  DYD_CERT_COS,
  DYD_CERT_SIN,
  DYD_CERT_TAN,
  DYD_CERT_EXP,
  DYD_CERT_SINH,
  DYD_CERT_COSH,
  DYD_CERT_TANH,
  DYD_CERT_LOG, /* of this and the next three nothing is known but values, and that equal operands give equal ones */
  DYD_CERT_ASIN,
  DYD_CERT_ACOS,
  DYD_CERT_ATAN,
  DYD_CERT_PI,
  DYD_CERT_E,
  DYD_CERT_CYCLE, /* cycle N: 2 cos(2 pi / N) */
  DYD_CERT_ROOT,  /* root LO HI c0,c1,...,cn, may be followed by V */
  DYD_CERT_CALLBACK,
  DYD_CERT_OPS
} dyd_cert_op;

/* The coefficients of the polynomial of a root, lowest first, and its bracket [end[0] / end[1], end[2] / end[3]], which
 * holds one root of it, in its inside. */
typedef struct dyd_cert_bracket {
  mpz_t *coeff, end[4];
  size_t count;
} dyd_cert_bracket;

/* now is known to precision p; 0: not yet. */
typedef struct dyd_cert_number {
  dyd_cert_op op;
  uint32_t a, b;
  long exponent; /* POW; CYCLE: N */
  dyd_cert_bracket *root;
  dyd_cert_quotient value;
  dyd_cert_enclosure now;
  long p;
} dyd_cert_number;

/* What leaf k is: `den` times number `number`; of a sine `sine` is set, and number is the cosine; whole: a zero of a
 * monic polynomial with integer coefficients over those before, all of whose zeros are at most `bound`. */
typedef struct dyd_cert_leaf {
  uint32_t number;
  bool sine, whole;
  dyd_cert_poly den;
  mpz_t bound;
} dyd_cert_leaf;

/* cosine[k] = 2 cos(2 pi k / cycle), k < cosines. */
typedef struct dyd_cert_algebra {
  dyd_cert_number *number;
  size_t count, cap;
  dyd_cert_relations relations;
  dyd_cert_leaf leaf[DYD_CERT_LEAVES];
  long cycle;
  dyd_cert_poly *cosine;
  size_t cosines, claims;
} dyd_cert_algebra;

const char *dyd_cert_op_name(dyd_cert_op op);
/* How many numbers of before an operation has. */
int dyd_cert_op_operands(dyd_cert_op op);
void dyd_cert_algebra_clear(dyd_cert_algebra *a);
void dyd_cert_number_clear(dyd_cert_number *n);
/* Reads the rest of a line that describes one more number; rejects what is not true, or not seen to be. */
dyd_status dyd_cert_algebra_read(dyd_cert_algebra *a, dyd_cert_reader *in);

/* Enclosures to precision p; of polynomials too. Those of numbers are borrowed. */
const dyd_cert_enclosure *dyd_cert_algebra_enclose(dyd_cert_algebra *a, uint32_t k, long p);
void dyd_cert_poly_enclose(dyd_cert_enclosure *out, dyd_cert_algebra *a, const dyd_cert_poly *q, long p);
/* The sign of a number, of a polynomial at the true leaves; 0: it is 0, or not known. */
int dyd_cert_algebra_sign(dyd_cert_algebra *a, uint32_t k);
int dyd_cert_poly_sign(dyd_cert_algebra *a, const dyd_cert_poly *q);
/* out >= |q| for all conjugates of its leaves; false: not all of them are whole, or it is too long to be of use. */
bool dyd_cert_poly_bound(mpz_ptr out, const dyd_cert_algebra *a, const dyd_cert_poly *q);
/* Is q 0 at the true leaves? By a bound of its conjugates [SEP-1]. */
bool dyd_cert_poly_is_null(dyd_cert_algebra *a, const dyd_cert_poly *q);

/* A leaf for number a->count; DYD_CERT_LEAVES: there is no room. */
size_t dyd_cert_algebra_leaf(dyd_cert_algebra *a);
/* The value of n, the number to be added, from those before. false: beyond the limits, or not defined for sure. */
bool dyd_cert_number_value(dyd_cert_number *n, dyd_cert_algebra *a);
/* The same where the certificate says it is n->value; true: it is. */
bool dyd_cert_number_check(dyd_cert_number *n, dyd_cert_algebra *a);
/* Begins the cycle of order n, of which there is none yet; n->value is set. */
bool dyd_cert_cycle_begin(dyd_cert_number *n, dyd_cert_algebra *a);
/* value = cos(2 pi num / den) for a fraction den that divides the order; false: it does not, or beyond the limits. */
bool dyd_cert_cycle_cosine(dyd_cert_quotient *value, dyd_cert_algebra *a, mpz_srcptr num, mpz_srcptr den);
/* Is there one root in the inside of the bracket, and none at its ends? */
bool dyd_cert_root_is_single(const dyd_cert_bracket *r);
void dyd_cert_root_enclose(dyd_cert_enclosure *out, const dyd_cert_bracket *r, long p);

#endif
