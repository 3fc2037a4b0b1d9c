/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* v is surely on the hull iff the arcs in which it is farther out than others have a common direction: intersect arcs
 * of violators. */
#include "legal/hull.h"

#include "skeleton/arcs.h"

static bool hull_same_direction(dyd_arcs *t, const dyd_vec *a, const dyd_vec *b) {
  return dyd_arcs_cross(t, a, b) == 0 && dyd_arcs_dot(t, a, b) > 0;
}

/* Is u strictly inside the arc from a to b, at most a half turn? */
static bool hull_is_inside(dyd_arcs *t, const dyd_vec *a, const dyd_vec *b, const dyd_vec *u) {
  return dyd_arcs_cross(t, a, u) > 0 && dyd_arcs_cross(t, u, b) > 0;
}

/* Intersects the open arc (lo, hi) with the arc found; false if nothing is left. The beginning of the one must lie in
 * the other, its end left out, and so with the ends. */
static bool hull_narrow(dyd_arcs *t, dyd_vec *lo, dyd_vec *hi) {
  bool from_in = hull_is_inside(t, lo, hi, &t->from), to_in = hull_is_inside(t, lo, hi, &t->to);
  bool lo_in = hull_is_inside(t, &t->from, &t->to, lo) || hull_same_direction(t, lo, &t->from);
  bool hi_in = hull_is_inside(t, &t->from, &t->to, hi) || hull_same_direction(t, hi, &t->to);
  if (!(from_in || lo_in) || !(to_in || hi_in)) return false;
  if (from_in) dyd_vec_set(lo, &t->from);
  if (to_in) dyd_vec_set(hi, &t->to);
  return true;
}

/* A short direction strictly between a and b, less than a half dyd_arcs apart. */
static void hull_between(dyd_vec *u, const dyd_vec *a, const dyd_vec *b) {
  size_t sa = mpz_sizeinbase(a->x, 2), sb = mpz_sizeinbase(b->x, 2), ta = mpz_sizeinbase(a->y, 2),
         tb = mpz_sizeinbase(b->y, 2);
  sa = sa > ta ? sa : ta;
  sb = sb > tb ? sb : tb;
  mp_bitcnt_t up_a = sb > sa ? sb - sa : 0, up_b = sa > sb ? sa - sb : 0;
  dyd_vec t;
  dyd_vec_init(&t);
  mpz_mul_2exp(t.x, b->x, up_b);
  mpz_mul_2exp(t.y, b->y, up_b);
  mpz_mul_2exp(u->x, a->x, up_a);
  mpz_mul_2exp(u->y, a->y, up_a);
  mpz_add(u->x, u->x, t.x);
  mpz_add(u->y, u->y, t.y);
  dyd_vec_clear(&t);
}

/* Intersects arcs of violators until none is left at t->u, or nothing of the arc. */
static bool hull_common_direction(dyd_arcs *t) {
  dyd_vec lo, hi;
  bool any = false, left = true;
  dyd_vec_init(&lo);
  dyd_vec_init(&hi);
  dyd_scale_set_empty(&t->w->set);
  mpz_set_si(t->u.x, 1);
  for (dyd_arcs_ask(t); t->status == DYD_OK && t->found != DYD_NONE; dyd_arcs_ask(t)) {
    left = !t->empty && (!any || hull_narrow(t, &lo, &hi));
    if (!left) break;
    if (!any) {
      dyd_vec_set(&lo, &t->from);
      dyd_vec_set(&hi, &t->to);
      any = true;
    }
    if (dyd_arcs_cross(t, &lo, &hi) != 0)
      hull_between(&t->u, &lo, &hi);
    else { /* a half dyd_arcs */
      mpz_neg(t->u.x, lo.y);
      mpz_set(t->u.y, lo.x);
    }
  }
  dyd_vec_clear(&hi);
  dyd_vec_clear(&lo);
  return left && t->status == DYD_OK;
}

dyd_status dyd_hull_sure(bool *sure, dyd_work *w, const dyd_skeleton *sk, uint32_t v) {
  dyd_arcs t;
  dyd_arcs_init(&t, w, sk, v, v, false);
  *sure = hull_common_direction(&t);
  dyd_arcs_clear(&t);
  return t.status;
}

dyd_status dyd_hull_direction(bool *found, mpz_t ux, mpz_t uy, dyd_work *w, const dyd_skeleton *sk, uint32_t i,
                              uint32_t j) {
  dyd_arcs t;
  dyd_arcs_init(&t, w, sk, i, j, false);
  *found = hull_common_direction(&t);
  mpz_set(ux, t.u.x);
  mpz_set(uy, t.u.y);
  dyd_arcs_clear(&t);
  return t.status;
}
