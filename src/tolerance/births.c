/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Births up to a cap. Discs of that radius lie in squares, so who is born is a possible pair of these; each such pair
 * is worked out on few lines, and whoever lies nearer to the best place is added until nobody does [TOL-3]. */
#include "base/error.h"
#include "dyadic/raw.h"
#include "tolerance/roots.h"
#include "tolerance/state.h"

/* Births begin with so many others. */
enum { FIRST_OTHERS = 24 };

/* ---- one pair ---- */

/* w / 2 against -up_to: sqrt(minus) - sqrt(plus) against sqrt(4 up_to^2). */
static bool is_late(const dyd_summit *s, mpq_srcptr up_to) {
  mpq_t cap, zero;
  mpq_inits(cap, zero, NULL);
  mpq_mul(cap, up_to, up_to);
  mpq_mul_2exp(cap, cap, 2);
  bool late = dyd_roots_compare(s->minus, s->plus, cap, zero) > 0;
  mpq_clears(cap, zero, NULL);
  return late;
}

dyd_status dyd_birth_exact(bool *late, dyd_tolerance *t, uint32_t v, uint32_t w) {
  dyd_status st = dyd_others_around(&t->others, t, v, w, FIRST_OTHERS);
  *late = false;
  if (st == DYD_OK && t->others.count == 0) { /* two hubs: begin with anybody */
    uint32_t any = 0;
    while (any == v || any == w || t->sk->leaving[any] == DYD_NONE) any++;
    if (!dyd_others_add(&t->others, any)) st = DYD_E_NOMEM;
  }
  for (bool more = true; st == DYD_OK && more;) {
    st = dyd_lines_load(&t->lines, t->sk, v, w, t->others.vertex, t->others.count);
    if (st != DYD_OK) return st;
    dyd_lines_birth(&t->summit, &t->lines);
    *late = is_late(&t->summit, t->options.up_to);
    if (*late) return DYD_OK;
    st = dyd_others_nearer(&more, &t->others, t, v, w, FIRST_OTHERS);
  }
  return st;
}

/* ---- candidates ---- */

/* A square that holds the disc of radius up_to around a point, its ends rounded outward finely against up_to. */
static dyd_status add_square(dyd_sites *squares, dyd_rect *r, mpq_t end[2], mpq_srcptr up_to, int64_t exp) {
  dyd_status st = DYD_OK;
  for (int axis = 0; axis < 2 && st == DYD_OK; axis++) {
    dyd_interval *side = axis ? &r->y : &r->x;
    dyd_interval_get_q(end[0], end[1], side);
    mpq_sub(end[0], end[0], up_to);
    mpq_add(end[1], end[1], up_to);
    st = dyd_interval_set_outward(side, end[0], end[1], exp);
  }
  return st == DYD_OK ? dyd_sites_add_rect(squares, r) : st;
}

static dyd_status make_squares(dyd_sites *squares, const dyd_tolerance *t) {
  const dyd_sites *sites = t->sk->reps.sites;
  int64_t exp = dyd_q_log2_above(t->options.up_to) - 20;
  dyd_rect r;
  mpq_t end[2], half;
  dyd_rect_init(&r);
  mpq_inits(end[0], end[1], half, NULL);
  dyd_status st = DYD_OK;
  for (size_t i = 0; i < dyd_sites_count(sites) && st == DYD_OK; i++) {
    st = dyd_sites_get(&r, sites, i);
    mpq_set(half, t->options.up_to);
    if (t->weight) mpq_set_d(half, t->weight[t->sk->vertex[i]]);
    if (t->weight) mpq_mul(half, half, t->options.up_to);
    if (st == DYD_OK) st = add_square(squares, &r, end, half, exp);
  }
  mpq_clears(end[0], end[1], half, NULL);
  dyd_rect_clear(&r);
  return st;
}

static dyd_status births_among(dyd_tolerance *t, const dyd_pair_list *pairs) {
  dyd_status st = DYD_OK;
  t->births_left = 0;
  for (size_t k = 0; k < pairs->count && st == DYD_OK; k++) {
    const dyd_pair *p = &pairs->item[k];
    bool late;
    if (dyd_delaunay_alias(t->pd, p->i) != p->i || dyd_delaunay_alias(t->pd, p->j) != p->j) continue;
    if (p->status == DYD_LEGAL || dyd_delaunay_status(t->pd, p->i, p->j) != DYD_ILLEGAL) continue;
    if (t->births_left || dyd_flag_is_set(t->options.cancel)) {
      t->births_left++;
      continue;
    }
    uint32_t v = t->sk->vertex[p->i], w = t->sk->vertex[p->j];
    if (t->weight || t->options.metric == DYD_METRIC_BOX) {
      st = dyd_row_add(t, dyd_row_of(t, v, w, DYD_EVENT_BIRTH, DYD_NONE, DYD_NONE, 0, HUGE_VAL));
      continue;
    }
    st = dyd_birth_exact(&late, t, v, w);
    if (st == DYD_OK && !late) st = dyd_row_add(t, dyd_row_of_summit(t, v, w, DYD_EVENT_BIRTH));
  }
  return st == DYD_OK && t->births_left ? DYD_CANCELLED : st;
}

/* For the list of candidates beside their triangulation, and for rows of all of them. */
static dyd_status births_have_room(dyd_tolerance *t, const dyd_delaunay *wide) {
  if (!t->room.most) return DYD_OK;
  t->room.beside += dyd_delaunay_memory(wide) + dyd_pairs_bytes(wide, DYD_TIE);
  return dyd_rows_have_room(t, dyd_pairs_bytes(wide, DYD_TIE) / sizeof(dyd_pair), "the births") ? DYD_OK : DYD_E_NOMEM;
}

dyd_status dyd_births(dyd_tolerance *t, dyd_error *err) {
  dyd_sites *squares = NULL;
  dyd_delaunay *wide = NULL;
  dyd_pair_list pairs = {0};
  dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .cancel = t->options.cancel,
                            .max_pairs = t->options.max_pairs};
  dyd_status st = dyd_sites_new(&squares);
  if (st == DYD_OK) st = make_squares(squares, t);
  t->room.beside = squares ? dyd_sites_memory(squares) : 0;
  o.max_bytes = dyd_room_left(&t->room);
  if (st == DYD_OK) st = dyd_delaunay_new(&wide, squares, &o, err);
  if (st == DYD_CAPPED)
    dyd_fail(err, st, "there are too many pairs that may be born up to there; ask for less, or raise `max_pairs`");
  if (st == DYD_OK) st = births_have_room(t, wide);
  if (st == DYD_OK) st = dyd_delaunay_pairs(&pairs, wide);
  if (st == DYD_OK) st = births_among(t, &pairs);
  t->room.beside = 0;
  dyd_pair_list_clear(&pairs);
  dyd_delaunay_free(wide);
  dyd_sites_free(squares);
  return st;
}
