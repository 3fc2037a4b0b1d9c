/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What is said of centres on the grid, and contracts of functions of src/checker/tree.c that others call. */
#ifndef DYD_PROOFS_CENTRES_H
#define DYD_PROOFS_CENTRES_H

#include "exact.h"

#include "checker/tree.h"

typedef const dyd_cert_centre *grid_centre;

/*@ predicate centre(grid_centre c) = \valid_read(c) &&
      (\forall integer k; 0 <= k < 4 ==> -1152921504606846976 <= c->e[k] <= 1152921504606846976); */

/*@ requires \valid(out) && \valid_read(s) && exact(c) && exact(c + 1) && whole(&s->origin[0][0]) &&
      whole(&s->origin[1][0]) && -274877906944 <= s->unit <= 274877906944 && \separated(out, s, c + (0 .. 1));
    assigns out->far, out->e[0 .. 3]; exits \false; ensures centre(out); */
void dyd_cert_centre_set(dyd_cert_centre *out, const dyd_cert_sites *s, const dyd_exact c[2]);
/*@ requires centre(c) && \valid_read(b); assigns \nothing; exits \false; */
dyd_cert_area dyd_cert_far_upper(const dyd_cert_centre *c, const dyd_cert_box *b);

#endif
