/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Dyadic numbers of any size as decimals rounded in a known direction. */
#include "io/decimal.h"

#include <inttypes.h>
#include <mpfr.h>
#include <string.h>

/* MPFR rounds decimals correctly, and its exponents reach far beyond DYD_EXP_LIMIT. */
void dyd_decimal_dyadic(char out[DYD_DECIMAL_SIZE], const dyd_dyadic *x, int digits, dyd_round dir) {
  strcpy(out, "0");
  if (dyd_dyadic_sgn(x) == 0) return;
  char text[DYD_DECIMAL_SIZE];
  mpfr_t exact;
  mpfr_exp_t point;
  size_t bits = mpz_sizeinbase(x->man, 2);
  mpfr_init2(exact, bits < 2 ? 2 : (mpfr_prec_t)bits);
  mpfr_set_z_2exp(exact, x->man, (mpfr_exp_t)x->exp, MPFR_RNDN);
  mpfr_get_str(text, &point, 10, (size_t)digits, exact, dir == DYD_UP ? MPFR_RNDU : MPFR_RNDD);
  mpfr_clear(exact);
  const char *digit = text + (*text == '-');
  snprintf(out, DYD_DECIMAL_SIZE, "%s%c.%se%" PRIdMAX, *text == '-' ? "-" : "", *digit, digit + 1, (intmax_t)point - 1);
}
