/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The boundary of a region in doubles: parts that are worked out exactly where these leave a doubt [OUTLINE-1]. */
#include "voronoi/outline_filter.h"

#include "base/local.h"
#include "rect/rect.h"

bool dyd_outline_rect(dyd_rect *r, dyd_outline *o, size_t k) {
  if (dyd_sites_get(r, o->sites, o->site[k]) == DYD_OK) return true;
  o->unsure = true;
  return false;
}

void dyd_outline_number(mpq_ptr out, dyd_outline *o, size_t far, size_t near, int axis, int mark) {
  bool window = mark == DYD_WINDOW_LO || mark == DYD_WINDOW_HI, of_near = mark == DYD_NEAR_LO || mark == DYD_NEAR_HI;
  bool high = mark == DYD_WINDOW_HI || mark == DYD_NEAR_HI || mark == DYD_MARKS + 1;
  DYD_LOCAL(dyd_rect, rect);
  DYD_LOCAL_NUMBERS(mpq, other);
  mpq_ptr lo = high ? other : out, hi = high ? out : other;
  if (window && !o->of_window[2 * axis + high])
    mpq_set_d(out, o->bound[2 * axis + high].lo);
  else if (window)
    dyd_interval_get_q(lo, hi, axis ? &o->rect->y : &o->rect->x);
  else if (dyd_outline_rect(&rect, o, of_near ? near : far))
    dyd_interval_get_q(lo, hi, axis ? &rect.y : &rect.x);
  if (mark != DYD_MIDDLE) return;
  mpq_add(out, out, other);
  mpq_div_2exp(out, out, 1);
}

/* ---- where the curves of two others cross, on straight arcs ---- */

/* An arc of points of the same distance from corners s and q. */
typedef struct straight_arc {
  mpq_t s[2], q[2], lo[2], hi[2];
} straight_arc;

static void straight_arc_init(straight_arc *a) {
  for (int k = 0; k < 2; k++) mpq_inits(a->s[k], a->q[k], a->lo[k], a->hi[k], NULL);
}

static void straight_arc_clear(straight_arc *a) {
  for (int k = 0; k < 2; k++) mpq_clears(a->s[k], a->q[k], a->lo[k], a->hi[k], NULL);
}

DYD_ARRAYS(straight_arc)

static void straight_arc_set(straight_arc *out, dyd_outline *o, const dyd_outline_arc *a) {
  size_t far = o->outer ? a->curve : o->count, near = o->outer ? o->count : a->curve;
  for (int k = 0; k < 2; k++) {
    dyd_outline_number(out->s[k], o, far, near, k, DYD_MARKS + (a->corner >> k & 1));
    dyd_outline_number(out->q[k], o, far, near, k, a->feature >> k & 1 ? DYD_NEAR_HI : DYD_NEAR_LO);
    dyd_outline_number(out->lo[k], o, far, near, k, a->mark[k][0]);
    dyd_outline_number(out->hi[k], o, far, near, k, a->mark[k][1]);
  }
}

/* Its line: normal . c = rest. */
static void straight_line(mpq_t normal[2], mpq_ptr rest, const straight_arc *a) {
  DYD_LOCAL_NUMBERS(mpq, sum);
  mpq_set_ui(rest, 0, 1);
  for (int k = 0; k < 2; k++) {
    mpq_sub(normal[k], a->q[k], a->s[k]);
    mpq_add(sum, a->q[k], a->s[k]);
    mpq_mul(sum, sum, normal[k]);
    mpq_add(rest, rest, sum);
  }
  mpq_div_2exp(rest, rest, 1);
}

/* out = x y - z t */
static void cross_products(mpq_ptr out, mpq_srcptr x, mpq_srcptr y, mpq_srcptr z, mpq_srcptr t) {
  DYD_LOCAL_NUMBERS(mpq, product);
  mpq_mul(product, z, t);
  mpq_mul(out, x, y);
  mpq_sub(out, out, product);
}

/* The point of both lines; false: they are parallel. */
static bool straight_lines_cross(mpq_t at[2], const straight_arc *a, const straight_arc *b) {
  DYD_LOCAL_ARRAY(mpq_t, normal, [2][2]);
  DYD_LOCAL_ARRAY(mpq_t, rest, [2]);
  DYD_LOCAL_NUMBERS(mpq, turn);
  straight_line(normal[0], rest[0], a);
  straight_line(normal[1], rest[1], b);
  cross_products(turn, normal[0][0], normal[1][1], normal[0][1], normal[1][0]);
  cross_products(at[0], rest[0], normal[1][1], rest[1], normal[0][1]);
  cross_products(at[1], normal[0][0], rest[1], normal[1][0], rest[0]);
  for (int k = 0; k < 2 && mpq_sgn(turn); k++) mpq_div(at[k], at[k], turn);
  return mpq_sgn(turn) != 0;
}

/* Where a point of its line is: beyond the closed pane (-1), at an end of the arc (0), or elsewhere (1). A border of
 * the pane along the line has no end. */
static int straight_arc_side(const straight_arc *a, const mpq_t at[2]) {
  int side = 1;
  for (int k = 0; k < 2; k++) {
    int low = mpq_cmp(at[k], a->lo[k]), high = mpq_cmp(at[k], a->hi[k]);
    if (low < 0 || high > 0) return -1;
    if ((!low || !high) && !mpq_equal(a->s[1 - k], a->q[1 - k])) side = 0;
  }
  return side;
}

bool dyd_outline_needs_no_cut(dyd_outline *o, uint32_t a, uint32_t b) {
  if (o->arc[a].shape.parabola || o->arc[b].shape.parabola) return false;
  DYD_LOCAL_ARRAY(straight_arc, arc, [2]);
  DYD_LOCAL_ARRAY(mpq_t, at, [2]);
  for (int k = 0; k < 2; k++) straight_arc_set(&arc[k], o, &o->arc[k ? b : a]);
  if (o->unsure || !straight_lines_cross(at, &arc[0], &arc[1])) return false;
  int first = straight_arc_side(&arc[0], (const mpq_t *)at), second = straight_arc_side(&arc[1], (const mpq_t *)at);
  return first < 0 || second < 0 || (first == 0 && second == 0);
}
