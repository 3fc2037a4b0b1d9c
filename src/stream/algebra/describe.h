/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Reals and points as forms. */
#ifndef DYD_STREAM_ALGEBRA_DESCRIBE_H
#define DYD_STREAM_ALGEBRA_DESCRIBE_H

#include "stream/algebra/form.h"
#include <dyadel/stream.h>

/* The form of x; DYD_NONE where it is not one number. x is borrowed for the life of f. */
uint32_t dyd_forms_real(dyd_forms *f, const dyd_real *x);
/* The forms of both coordinates of a stream, or of the point r, a rectangle that is a point; DYD_NONE where nothing is
 * known of one. */
dyd_form_point dyd_forms_stream(dyd_forms *f, const dyd_stream *s);
dyd_form_point dyd_forms_rect(dyd_forms *f, const dyd_rect *r);

/* Forms that are 0 where three points are on one line, where four are on one circle or line. */
uint32_t dyd_forms_collinear(dyd_forms *f, const dyd_form_point p[3]);
uint32_t dyd_forms_cocircular(dyd_forms *f, const dyd_form_point p[4]);
/* The square of the distance of two points. */
uint32_t dyd_forms_distance2(dyd_forms *f, dyd_form_point p, dyd_form_point q);

#endif
