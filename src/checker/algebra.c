/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The numbers of a certificate: names of operations, leaves, their end. */
#include "checker/algebra.h"

#include <stdlib.h>

static const char *const op_names[DYD_CERT_OPS] = {"=",   "+",     "-",     "*",    "/",       "min",  "max",  "^",
                                                   "neg", "claim", "abs",   "sqrt", "cbrt",    "cos",  "sin",  "tan",
                                                   "exp", "sinh",  "cosh",  "tanh", "log",     "asin", "acos", "atan",
                                                   "pi",  "e",     "cycle", "root", "callback"};

int dyd_cert_op_operands(dyd_cert_op op) {
  if (op == DYD_CERT_VALUE || op >= DYD_CERT_PI) return 0;
  return op >= DYD_CERT_ADD && op <= DYD_CERT_MAX ? 2 : 1;
}

const char *dyd_cert_op_name(dyd_cert_op op) {
  return op_names[op];
}

/* ---- life ---- */

static void root_free(dyd_cert_bracket *r) {
  if (!r) return;
  for (size_t k = 0; k < r->count; k++) mpz_clear(r->coeff[k]);
  for (int k = 0; k < 4; k++) mpz_clear(r->end[k]);
  free(r->coeff);
  free(r);
}

void dyd_cert_number_clear(dyd_cert_number *n) {
  root_free(n->root);
  dyd_cert_quotient_clear(&n->value);
  dyd_cert_enclosure_clear(&n->now);
}

void dyd_cert_algebra_clear(dyd_cert_algebra *a) {
  for (size_t k = 0; k < a->count; k++) dyd_cert_number_clear(&a->number[k]);
  for (size_t k = 0; k < a->relations.count; k++) {
    dyd_cert_poly_clear(&a->relations.leaf[k].rest);
    dyd_cert_poly_clear(&a->leaf[k].den);
    mpz_clear(a->leaf[k].bound);
  }
  for (size_t k = 0; k < a->cosines; k++) dyd_cert_poly_clear(&a->cosine[k]);
  free(a->cosine);
  free(a->number);
  *a = (dyd_cert_algebra){0};
}

size_t dyd_cert_algebra_leaf(dyd_cert_algebra *a) {
  if (a->relations.count == DYD_CERT_LEAVES) return DYD_CERT_LEAVES;
  size_t k = a->relations.count++;
  a->relations.leaf[k] = (dyd_cert_relation){0};
  a->leaf[k] = (dyd_cert_leaf){.number = (uint32_t)a->count};
  mpz_init(a->leaf[k].bound);
  return k;
}
