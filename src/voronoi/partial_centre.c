/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Partial centres, partial discs and bisectors: three-valued answers and enclosures.
 *
 * [CEN-1] O(a,b,c) is bounded by parts of the boundaries of the convex sets C_xy, outside of which it lies, so that a
 * linear function has no local maximum over O inside such a part, flat parts aside; its maximum is at a point where two
 * of them meet, the centre of a critical circle. So the six centres have the bounding box of O. */
#include "rect/irect.h"
#include <dyadel/arc.h>

enum { CENTRES = 6 };

static void take_centre(dyd_surd_point *out, const dyd_circle *k) {
  mpz_set(out->ax, k->ax);
  mpz_set(out->bx, k->bx);
  mpz_set(out->ay, k->ay);
  mpz_set(out->by, k->by);
  mpz_set(out->c, k->c);
  mpz_set(out->d, k->d);
}

dyd_status dyd_partial_centre(dyd_surd_point out[6], const dyd_rect *a, const dyd_rect *b, const dyd_rect *c) {
  dyd_partial_disc d;
  dyd_partial_disc_init(&d);
  dyd_partial_disc_set(&d, a, b, c);
  bool known = d.known;
  for (int k = 0; known && k < CENTRES; k++) take_centre(&out[k], &d.circle[k]);
  dyd_partial_disc_clear(&d);
  return known ? DYD_OK : DYD_E_ARG;
}

/* *side grows to hold s. */
static dyd_status interval_grow(dyd_interval *side, const dyd_interval *s) {
  const dyd_dyadic *lo = dyd_dyadic_cmp(&s->lo, &side->lo) < 0 ? &s->lo : &side->lo;
  const dyd_dyadic *hi = dyd_dyadic_cmp(&s->hi, &side->hi) > 0 ? &s->hi : &side->hi;
  dyd_interval both;
  dyd_interval_init(&both);
  dyd_status st = dyd_interval_set_ends(&both, lo, hi);
  if (st == DYD_OK) dyd_interval_swap(side, &both);
  dyd_interval_clear(&both);
  return st;
}

static dyd_status enclose_centres(dyd_rect *out, const dyd_surd_point centre[CENTRES], int64_t bits) {
  dyd_rect one;
  dyd_rect_init(&one);
  dyd_status st = dyd_surd_point_enclose(out, &centre[0], bits);
  for (int k = 1; k < CENTRES && st == DYD_OK; k++) {
    st = dyd_surd_point_enclose(&one, &centre[k], bits);
    if (st == DYD_OK) st = interval_grow(&out->x, &one.x);
    if (st == DYD_OK) st = interval_grow(&out->y, &one.y);
  }
  dyd_rect_clear(&one);
  return st;
}

dyd_status dyd_partial_centre_enclose(dyd_rect *out, const dyd_rect *a, const dyd_rect *b, const dyd_rect *c,
                                      int64_t bits) {
  dyd_surd_point centre[CENTRES];
  dyd_rect r;
  dyd_rect_init(&r);
  for (int k = 0; k < CENTRES; k++) dyd_surd_point_init(&centre[k]);
  dyd_status st = dyd_partial_centre(centre, a, b, c);
  if (st == DYD_OK) st = enclose_centres(&r, centre, bits);
  if (st == DYD_OK) dyd_rect_swap(out, &r);
  for (int k = CENTRES; k-- > 0;) dyd_surd_point_clear(&centre[k]);
  dyd_rect_clear(&r);
  return st;
}

dyd_truth dyd_partial_disc_side(const dyd_partial_disc *d, const dyd_point *c) {
  dyd_rect r;
  dyd_rect_init(&r);
  bool placed =
      dyd_interval_set_ends(&r.x, &c->x, &c->x) == DYD_OK && dyd_interval_set_ends(&r.y, &c->y, &c->y) == DYD_OK;
  dyd_sure con = placed ? dyd_partial_disc_con(d, &r) : DYD_UNSURE;
  dyd_rect_clear(&r);
  return con == DYD_SURE_PLUS ? DYD_TRUE : con == DYD_SURE_MINUS ? DYD_FALSE : DYD_UNKNOWN;
}

/* Are all corners of q nearer to a than to b, dl_a < ds_b? */
static bool corners_nearer(const dyd_irect *q, const dyd_irect *a, const dyd_irect *b) {
  mpz_t dl, ds;
  mpz_inits(dl, ds, NULL);
  bool nearer = true;
  for (int corner = 0; corner < 4 && nearer; corner++) {
    mpz_srcptr x = corner & 1 ? q->x1 : q->x0, y = corner & 2 ? q->y1 : q->y0;
    dyd_irect_dl2(dl, x, y, a);
    dyd_irect_ds2(ds, x, y, b);
    nearer = mpz_cmp(dl, ds) < 0;
  }
  mpz_clears(dl, ds, NULL);
  return nearer;
}

dyd_truth dyd_rect_nearer(const dyd_rect *q, const dyd_rect *a, const dyd_rect *b) {
  const dyd_rect *in[3] = {q, a, b};
  dyd_irect r[3];
  for (int k = 0; k < 3; k++) dyd_irect_init(&r[k]);
  dyd_irects_scale(r, in, 3, NULL, NULL);
  dyd_truth answer = DYD_UNKNOWN;
  if (corners_nearer(&r[0], &r[1], &r[2])) {
    answer = DYD_TRUE;
  } else if (corners_nearer(&r[0], &r[2], &r[1])) {
    answer = DYD_FALSE;
  }
  for (int k = 3; k-- > 0;) dyd_irect_clear(&r[k]);
  return answer;
}
