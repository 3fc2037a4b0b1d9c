/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Which sites are nearest to somewhere in a box [CERT-12].
 *
 * C_kj, where k is nearer than j for every choice, is convex: when the corners of a box lie in it, j is nearest nowhere
 * in the box. Rectangles show it by dl_k(c) < ds_j(c), discs by their distances. A box whose corners no C_kj has all is
 * cut in the middle of its longer side. */
#include "checker/near.h"
#include "base/alloc.h"
#include "base/local.h"

DYD_ARRAYS(dyd_exact)

#define MOST_CUTS 3000 /* of a box: what is near one site may be 2^-900 of it */

/* ---- boxes ---- */

void dyd_cert_span_init(dyd_cert_span *b) {
  for (int k = 0; k < 4; k++) dyd_exact_init(&b->e[k]);
}

void dyd_cert_span_clear(dyd_cert_span *b) {
  for (int k = 0; k < 4; k++) dyd_exact_clear(&b->e[k]);
}

static void set_span(dyd_cert_span *out, const dyd_cert_span *b) {
  for (int k = 0; k < 4; k++) dyd_exact_set(&out->e[k], &b->e[k]);
}

/* Squared distances of rational points that differ, do so by more than is lost here, where denominators are alike. */
static void span_end(dyd_exact *out, const dyd_cert_side *s, bool upper) {
  const dyd_exact *end = upper ? dyd_cert_high(s) : &s->lo;
  if (!s->den || !dyd_exact_sgn(end)) {
    dyd_exact_set(out, end);
    return;
  }
  out->exp = end->exp - 12 * (int64_t)mpz_sizeinbase(*s->den, 2) - 64;
  (upper ? dyd_exact_ceil : dyd_exact_floor)(out->man, end, *s->den, out->exp);
}

void dyd_cert_span_set(dyd_cert_span *out, const dyd_cert_site *s) {
  for (int k = 0; k < 4; k++) span_end(&out->e[k], &s->side[k / 2], k % 2);
}

static bool span_axis_is_point(const dyd_cert_span *b, int axis) {
  return dyd_exact_cmp(&b->e[2 * axis], &b->e[2 * axis + 1]) == 0;
}

bool dyd_cert_span_is_point(const dyd_cert_span *b) {
  return span_axis_is_point(b, 0) && span_axis_is_point(b, 1);
}

void dyd_cert_spans_free(dyd_cert_span *span, size_t count) {
  for (size_t i = 0; span && i < count; i++) dyd_cert_span_clear(&span[i]);
  free(span);
}

dyd_status dyd_cert_spans_init(dyd_cert_span **out, const dyd_cert_sites *s) {
  *out = dyd_alloc(s->count, sizeof **out);
  if (!*out) return DYD_E_NOMEM;
  for (size_t i = 0; i < s->count; i++) {
    dyd_cert_span_init(&(*out)[i]);
    dyd_cert_span_set(&(*out)[i], &s->site[i]);
  }
  return DYD_OK;
}

/* ---- distances ---- */

void dyd_cert_axis_gap(dyd_exact *d, dyd_exact *scratch, const dyd_exact *c, const dyd_exact side[2], bool far) {
  dyd_exact_sub(d, &side[0], c);
  dyd_exact_sub(scratch, c, &side[1]);
  if (far) {
    mpz_neg(d->man, d->man);
    mpz_neg(scratch->man, scratch->man);
  }
  if (dyd_exact_cmp(scratch, d) > 0) dyd_exact_set(d, scratch);
  if (dyd_exact_sgn(d) < 0) mpz_set_ui(d->man, 0);
}

void dyd_cert_corner_distance2(dyd_exact *out, const dyd_cert_span *b, int q, const dyd_cert_span *site, bool far) {
  DYD_LOCAL(dyd_exact, d, t);
  dyd_cert_axis_gap(&d, &t, &b->e[q & 1], site->e, far);
  dyd_exact_mul(out, &d, &d);
  dyd_cert_axis_gap(&d, &t, &b->e[2 + (q >> 1)], site->e + 2, far);
  dyd_exact_mul(&d, &d, &d);
  dyd_exact_add(out, out, &d);
}

bool dyd_cert_span_prefers(const dyd_cert_span *b, int q, const dyd_cert_span *k, const dyd_cert_span *j) {
  DYD_LOCAL(dyd_exact, far, near);
  dyd_cert_corner_distance2(&far, b, q, k, true);
  dyd_cert_corner_distance2(&near, b, q, j, false);
  return dyd_exact_cmp(&far, &near) < 0;
}

static bool corner_prefers(const dyd_cert_near *q, const dyd_cert_span *b, int corner, uint32_t k, uint32_t j) {
  const dyd_exact at[2] = {b->e[corner & 1], b->e[2 + (corner >> 1)]}; /* borrowed */
  return dyd_cert_span_prefers(b, corner, &q->span[k], &q->span[j]) ||
         (q->disc && dyd_cert_disc_is_nearer(at, &q->disc[k], &q->disc[j]));
}

static bool span_has_corners_in(const dyd_cert_near *q, const dyd_cert_span *b, uint32_t k, uint32_t j) {
  int corners = dyd_cert_span_is_point(b) ? 1 : 4;
  for (int corner = 0; corner < corners; corner++)
    if (!corner_prefers(q, b, corner, k, j)) return false;
  return true;
}

void dyd_cert_span_on_grid(dyd_cert_centre *out, const dyd_cert_sites *s, const dyd_cert_span *b) {
  dyd_cert_centre upper;
  const dyd_exact low[2] = {b->e[0], b->e[2]}, high[2] = {b->e[1], b->e[3]};
  dyd_cert_centre_set(out, s, low);
  dyd_cert_centre_set(&upper, s, high);
  out->far |= upper.far;
  out->e[1] = upper.e[1];
  out->e[3] = upper.e[3];
}

/* ---- certainly nearest ---- */

typedef struct near_search {
  const dyd_cert_near *q;
  uint32_t other;
  size_t unproved;
  uint64_t effort;
} near_search;

static bool is_farther_everywhere(void *context, uint32_t k) {
  near_search *s = context;
  const dyd_cert_near *q = s->q;
  uint32_t i = q->list[0];
  if (k == i || k == q->self || span_has_corners_in(q, q->at, i, k)) return true;
  s->other = k;
  return false;
}

bool dyd_cert_near_is_certain(uint32_t *other, const dyd_cert_near *q) {
  dyd_cert_centre centre;
  near_search s = {.q = q, .other = DYD_CERT_NONE};
  dyd_cert_span_on_grid(&centre, q->sites, q->at);
  dyd_cert_area limit = centre.far ? 0 : dyd_cert_far_upper(&centre, &q->sites->box[q->list[0]]);
  bool good = dyd_cert_tree_visit(q->tree, &centre, limit, is_farther_everywhere, &s);
  *other = s.other;
  return good;
}

/* ---- nearest nowhere ---- */

void dyd_cert_span_half(dyd_cert_span *part, const dyd_cert_span *b, bool upper) {
  DYD_LOCAL_ARRAY(dyd_exact, w, [2]);
  DYD_LOCAL(dyd_exact, middle);
  for (int a = 0; a < 2; a++) dyd_exact_sub(&w[a], &b->e[2 * a + 1], &b->e[2 * a]);
  int axis = dyd_exact_cmp(&w[1], &w[0]) > 0;
  dyd_exact_add(&middle, &b->e[2 * axis], &b->e[2 * axis + 1]);
  middle.exp--;
  set_span(part, b);
  dyd_exact_set(&part->e[2 * axis + !upper], &middle);
}

/* Is the box covered by the C_kj of the sites listed? */
static bool span_is_covered(near_search *s, const dyd_cert_span *b, uint32_t j, int cuts) {
  const dyd_cert_near *q = s->q;
  for (size_t k = 0; k < q->count; k++)
    if (span_has_corners_in(q, b, q->list[k], j)) return true;
  bool more = cuts < MOST_CUTS && s->effort > q->count && !dyd_cert_span_is_point(b);
  if (!more) return false;
  s->effort -= q->count;
  DYD_LOCAL(dyd_cert_span, part);
  for (int upper = 0; upper < 2 && more; upper++) {
    dyd_cert_span_half(&part, b, upper);
    more = span_is_covered(s, &part, j, cuts + 1);
  }
  return more;
}

static bool is_listed_or_nowhere(void *context, uint32_t j) {
  near_search *s = context;
  size_t k = 0;
  while (k < s->q->count && s->q->list[k] != j) k++;
  if (k < s->q->count || j == s->q->self || span_is_covered(s, s->q->at, j, 0)) return true;
  s->other = j;
  s->unproved++;
  return true;
}

void dyd_cert_near_count(size_t *unproved, uint32_t *other, uint64_t *effort, const dyd_cert_near *q) {
  dyd_cert_centre centre;
  near_search s = {.q = q, .other = DYD_CERT_NONE, .effort = *effort};
  dyd_cert_area limit = 0;
  dyd_cert_span_on_grid(&centre, q->sites, q->at);
  for (size_t k = 0; k < q->count && !centre.far; k++) {
    dyd_cert_area far = dyd_cert_far_upper(&centre, &q->sites->box[q->list[k]]);
    if (k == 0 || far < limit) limit = far;
  }
  dyd_cert_tree_visit(q->tree, &centre, limit, is_listed_or_nowhere, &s);
  *unproved = s.unproved;
  *other = s.other;
  *effort = s.effort;
}

/* ---- bounds of a distance ---- */

/* The squares of the least and the greatest distance of two boxes. */
static void span_distances2(dyd_exact out[2], const dyd_cert_span *a, const dyd_cert_span *b) {
  DYD_LOCAL_ARRAY(dyd_exact, d, [2]);
  for (int far = 0; far < 2; far++) {
    mpz_set_ui(out[far].man, 0);
    for (int axis = 0; axis < 4; axis += 2) {
      dyd_exact_sub(&d[0], &b->e[axis + far], &a->e[axis + !far]);
      dyd_exact_sub(&d[1], &a->e[axis + far], &b->e[axis + !far]);
      const dyd_exact *gap = dyd_exact_cmp(&d[0], &d[1]) < 0 ? &d[1] : &d[0];
      if (dyd_exact_sgn(gap) <= 0) continue;
      dyd_exact_mul(&d[0], gap, gap);
      dyd_exact_add(&out[far], &out[far], &d[0]);
    }
  }
}

/* The same when distances may be up to *more above, or below, those of the boxes. */
static bool near_bounds_hold(const dyd_cert_span *a, const dyd_cert_span *b, const dyd_exact *more, const dyd_exact *lo,
                             const dyd_exact *hi) {
  DYD_LOCAL_ARRAY(dyd_exact, d, [2]);
  DYD_LOCAL(dyd_exact, t);
  span_distances2(d, a, b);
  dyd_exact_add(&t, lo, more);
  dyd_exact_mul(&t, &t, &t);
  bool hold = dyd_exact_sgn(lo) <= 0 || dyd_exact_cmp(&t, &d[0]) <= 0;
  if (hi) {
    dyd_exact_sub(&t, hi, more);
    hold = hold && dyd_exact_sgn(&t) >= 0;
    dyd_exact_mul(&t, &t, &t);
    hold = hold && dyd_exact_cmp(&t, &d[1]) >= 0;
  }
  return hold;
}

bool dyd_cert_near_bounds_hold(const dyd_cert_span *a, const dyd_cert_span *b, const dyd_cert_disc *disc,
                               const dyd_exact *lo, const dyd_exact *hi) {
  DYD_LOCAL(dyd_exact, none);
  bool low = near_bounds_hold(a, b, &none, lo, NULL), high = !hi || near_bounds_hold(a, b, &none, &none, hi);
  if (disc) {
    const dyd_cert_span centre = {{disc->x, disc->x, disc->y, disc->y}}; /* borrowed */
    low = low || near_bounds_hold(a, &centre, &disc->r, lo, NULL);
    high = high || near_bounds_hold(a, &centre, &disc->r, &none, hi);
  }
  return low && high;
}
