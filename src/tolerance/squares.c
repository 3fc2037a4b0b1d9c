/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Deaths and births where points move in squares, by bisection with statuses [TOL-9].
 *
 * At any t, whether some sites leave the pair legal, or possible, is decided exactly. What they refute, all sites do;
 * what they allow all sites allow when nobody else comes to the disc that shows it, and who may come is one of `some`
 * from then on. A square of half-width t holds the disc of radius t and lies in that of radius sqrt(2) t, so the event
 * of discs, which is known, brackets a death.
 *
 * Squares are rounded outward to multiples of 2^exp: they hold those of half-width t, and lie in those of t + 2^exp. So
 * "yes" at t holds below t, "no" above t + 2^exp. The floor of the search for witnesses is far below another 2^exp. */
#include "tolerance/squares.h"
#include "legal/witness.h"
#include "possible/cover.h"
#include "tolerance/roots.h"

#include <math.h>
#include <stdlib.h>

#define WIDTH (1 + 0x1p-20)
/* Nothing is tried beyond 2^+-RANGE. */
enum { RANGE = 900, FIRST_SEEN = 24 };

/* ---- at one t ---- */

typedef dyd_status squares_question(dyd_truth *answer, dyd_squares *q, double t);

static dyd_status squares_are_legal(dyd_truth *answer, dyd_squares *q, double t) {
  dyd_status st = DYD_OK;
  for (bool more = true; more && st == DYD_OK;) {
    st = dyd_squares_build(q, t);
    if (st != DYD_OK) return st;
    const uint32_t *v = q->sk.vertex;
    uint32_t across[2] = {v[2], q->seen.count > 1 ? v[3] : v[2]};
    more = false;
    st = dyd_witness_decide(answer, &q->c, &q->work, &q->sk, v[0], v[1], q->guess, q->seen.count > 1 ? across : NULL);
    if (st == DYD_OK && *answer == DYD_TRUE) st = dyd_squares_see_rivals(&more, q);
    dyd_squares_unbuild(q);
  }
  if (st != DYD_OK || *answer != DYD_TRUE) return st;
  uint32_t k, l;
  dyd_squares_bind(&k, &l, q, false);
  return DYD_OK;
}

/* A common point is as near as can be, whoever else there is. */
static dyd_status squares_meet(bool *meet, dyd_squares *q) {
  dyd_rect r[2];
  for (int k = 0; k < 2; k++) dyd_rect_init(&r[k]);
  dyd_status st = dyd_sites_get(&r[0], q->sites, 0);
  if (st == DYD_OK) st = dyd_sites_get(&r[1], q->sites, 1);
  *meet = st == DYD_OK && dyd_rect_meets(&r[0], &r[1]);
  for (int k = 0; k < 2; k++) dyd_rect_clear(&r[k]);
  return st;
}

static dyd_status squares_are_illegal(dyd_truth *answer, dyd_squares *q, double t) {
  static const uint32_t no_hint[2] = {DYD_NONE, DYD_NONE};
  dyd_status st = DYD_OK;
  for (bool more = true; more && st == DYD_OK;) {
    bool meet, possible = true;
    st = dyd_squares_build(q, t);
    if (st != DYD_OK) return st;
    more = false;
    const uint32_t *v = q->sk.vertex;
    st = squares_meet(&meet, q);
    if (st == DYD_OK && !meet) st = dyd_cover_possible(&possible, &q->work, &q->sk, v[0], v[1], no_hint);
    if (st == DYD_OK && !meet && possible) st = dyd_squares_see_blockers(&more, q);
    *answer = possible ? DYD_FALSE : DYD_TRUE;
    dyd_squares_unbuild(q);
  }
  return st;
}

/* ---- where it changes ---- */

/* Yes at *lo, or *lo is 0; no at *hi. Until they are near to each other, or no answer is found. */
static dyd_status squares_halve(double *lo, double *hi, dyd_squares *q, squares_question *ask) {
  dyd_status st = DYD_OK;
  while (*hi > *lo * WIDTH && st == DYD_OK) {
    double mid = 4 * *lo >= *hi ? *lo + (*hi - *lo) / 2 : *hi / 4, over = mid + ldexp(mid, 2 - DYD_SQUARE_BITS);
    dyd_truth answer = DYD_UNKNOWN;
    if (!(mid > *lo && over < *hi && mid > ldexp(1, -RANGE) && mid < ldexp(1, RANGE))) return DYD_OK;
    st = ask(&answer, q, mid);
    if (answer == DYD_UNKNOWN) return st;
    *(answer == DYD_TRUE ? lo : hi) = answer == DYD_TRUE ? mid : over;
  }
  return st;
}

/* ---- rows ---- */

static dyd_status squares_see_all(dyd_squares *q, const uint32_t *vertex, size_t count) {
  dyd_status st = DYD_OK;
  for (size_t k = 0; k < count && st == DYD_OK; k++) {
    bool more;
    st = dyd_squares_see(&more, q, vertex[k]);
  }
  return st;
}

/* The sites of the row, and some around it. */
static dyd_status squares_begin(dyd_squares *q, const dyd_tolerance_row *row) {
  const dyd_tolerance *t = q->t;
  const uint32_t *vertex = t->sk->vertex;
  dyd_status st = DYD_OK;
  bool more;
  q->i = vertex[row->i];
  q->j = vertex[row->j];
  q->seen.count = 0;
  q->place = (dyd_bbox){{NAN, NAN, NAN, NAN}};
  if (row->k != DYD_NO_SITE) st = dyd_squares_see(&more, q, vertex[row->k]);
  if (row->l != DYD_NO_SITE && st == DYD_OK) st = dyd_squares_see(&more, q, vertex[row->l]);
  if (st == DYD_OK) st = dyd_others_around(&q->t->others, t, q->i, q->j, FIRST_SEEN);
  if (st == DYD_OK) st = squares_see_all(q, t->others.vertex, t->others.count);
  uint32_t any = 0; /* two hubs: begin with anybody */
  while (any == q->i || any == q->j || dyd_mesh_alias(&t->sk->mesh, any) != DYD_NONE) any++;
  return st == DYD_OK && !q->seen.count ? dyd_squares_see(&more, q, any) : st;
}

static void row_bind(dyd_tolerance_row *row, dyd_squares *q, bool far) {
  const uint32_t *site = q->t->sk->reps.site;
  uint32_t k, l;
  dyd_squares_bind(&k, &l, q, far);
  if (k == DYD_NONE) return;
  row->k = site[k];
  row->l = l == DYD_NONE ? DYD_NO_SITE : site[l];
  if (row->l >= row->k) return;
  row->k = site[l];
  row->l = site[k];
}

/* The death for discs is at most sqrt(2) times that for squares. */
static dyd_status square_death(dyd_squares *q, dyd_tolerance_row *row) {
  if (row->lo == HUGE_VAL) return DYD_OK;
  dyd_status st = squares_begin(q, row);
  q->guess = dyd_squares_guess(q, row->k, row->l);
  row->lo *= 0.70710678118654746 * (1 - 0x1p-50);
  if (st == DYD_OK) st = squares_halve(&row->lo, &row->hi, q, squares_are_legal);
  if (st == DYD_OK) row_bind(row, q, false);
  return st;
}

/* *late: it is above t->options.up_to for sure. */
static dyd_status square_birth(bool *late, dyd_squares *q, dyd_tolerance_row *row) {
  dyd_truth illegal = DYD_UNKNOWN;
  double up_to = dyd_q_double(q->t->options.up_to, 1);
  dyd_status st = squares_begin(q, row);
  if (st == DYD_OK) st = squares_are_illegal(&illegal, q, up_to);
  *late = st == DYD_OK && illegal == DYD_TRUE;
  row->lo = 0;
  row->hi = up_to + ldexp(up_to, 2 - DYD_SQUARE_BITS);
  if (st == DYD_OK && !*late) st = squares_halve(&row->lo, &row->hi, q, squares_are_illegal);
  if (st == DYD_OK && !*late) row_bind(row, q, true);
  return st;
}

static dyd_status square_row(bool *late, dyd_tolerance_row *row, void *squares) {
  return row->event == DYD_EVENT_DEATH ? square_death(squares, row) : square_birth(late, squares, row);
}

dyd_status dyd_square_rows(dyd_tolerance *t) {
  dyd_squares q = {.t = t};
  mpq_inits(q.half, q.end[0], q.end[1], NULL);
  dyd_point_init(&q.c);
  dyd_status st = dyd_near_index(t);
  if (st == DYD_OK) st = dyd_rows_rework(t, square_row, &q);
  dyd_point_clear(&q.c);
  mpq_clears(q.half, q.end[0], q.end[1], NULL);
  free(q.seen.vertex);
  return st;
}
