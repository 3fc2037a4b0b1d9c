/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The form of one plain number, between scanning and evaluating it. */
#ifndef DYD_STREAM_NUMBER_FORM_H
#define DYD_STREAM_NUMBER_FORM_H

#include "stream/number.h"

/* (-) literal, (-) literal / denominator, or (-) literal * 2^two.
 * Invariant: at most one of rational and dyadic; denominator counts only when rational, two only when dyadic. */
typedef struct dyd_number_form {
  bool negative, rational, dyadic;
  dyd_literal literal, denominator;
  int64_t two;
} dyd_number_form;

/* Reads the whole text, blanks around it aside. false: *bad is the offset of the first character that does not
 * fit (the length of the text when it ends too early). */
bool dyd_number_scan(dyd_number_form *out, size_t *bad, const char *text, size_t length);

#endif
