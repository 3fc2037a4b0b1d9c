/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What the lines of an oracle program mean. */
#ifndef DYD_STREAM_ORACLE_ANSWER_H
#define DYD_STREAM_ORACLE_ANSWER_H

#include <dyadel/rect.h>

/* "points N", or "points N cost C ... C" with N numbers above 0: *cost becomes new memory that holds them, or NULL.
 * DYD_OK, or with both unchanged: DYD_E_STREAM, DYD_E_NOMEM. */
dyd_status dyd_oracle_read_count(size_t *out, double **cost, const char *line, size_t length, dyd_error *err);
/* "I XLO XHI YLO YHI [fixed]", I checked before. known: *r comes in as the rectangle so far. *r becomes the answer,
 * rounded outward by less than 2^-64 of each width where an end is not dyadic, and cut to the rectangle so far.
 * DYD_OK, DYD_FIXED, or with *r unchanged: DYD_E_STREAM, DYD_E_NESTING (the answer is not inside; decided exactly, for
 * the ends as given), DYD_E_RANGE, DYD_E_NOMEM. */
dyd_status dyd_oracle_read_answer(dyd_rect *r, bool known, const char *line, size_t length, dyd_error *err);

#endif
