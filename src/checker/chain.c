/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Chains that prove a pair illegal.
 *
 * C_ki = { c : dl_k(c) < ds_i(c) } is convex, so a segment lies in it when its ends do; a ray from a point of it lies
 * in it, and i is not extreme in its direction u, when u.y < u.x for all y in R_i, x in R_k. */
#include "checker/chain.h"
#include "base/alloc.h"

void dyd_cert_chain_init(dyd_cert_chain *c) {
  *c = (dyd_cert_chain){0};
  for (int k = 0; k < 4; k++) dyd_exact_init(&c->u[k / 2][k % 2]);
}

void dyd_cert_chain_clear(dyd_cert_chain *c) {
  for (size_t q = 0; q < c->cap; q++) {
    dyd_exact_clear(&c->point[q][0]);
    dyd_exact_clear(&c->point[q][1]);
  }
  free(c->point);
  free(c->blocker);
  for (int k = 0; k < 4; k++) dyd_exact_clear(&c->u[k / 2][k % 2]);
  *c = (dyd_cert_chain){0};
}

dyd_status dyd_cert_chain_resize(dyd_cert_chain *c, size_t points) {
  if (points > c->cap) {
    size_t cap = c->cap, blockers = c->cap ? c->cap + 1 : 0;
    if (!dyd_reserve((void **)&c->blocker, &blockers, points + 64, sizeof *c->blocker) ||
        !dyd_reserve((void **)&c->point, &cap, points + 32, sizeof *c->point))
      return DYD_E_NOMEM;
    cap = points + 32;
    for (size_t q = c->cap; q < cap; q++) {
      dyd_exact_init(&c->point[q][0]);
      dyd_exact_init(&c->point[q][1]);
    }
    c->cap = cap;
  }
  c->points = points;
  return DYD_OK;
}

/* ---- in the blocked region ---- */

static bool blocker_is_nearer(const dyd_cert_sites *s, const dyd_exact at[2], uint32_t k, uint32_t i, uint32_t j) {
  dyd_cert_fraction own, other;
  dyd_cert_fraction_init(&own);
  dyd_cert_fraction_init(&other);
  dyd_cert_distance2(&own, at, &s->site[k], DYD_CERT_FAR);
  dyd_cert_distance2(&other, at, &s->site[i], DYD_CERT_NEAR);
  bool good = dyd_cert_fraction_cmp(&own, &other) < 0;
  dyd_cert_distance2(&other, at, &s->site[j], DYD_CERT_NEAR);
  good = good && dyd_cert_fraction_cmp(&own, &other) < 0;
  dyd_cert_fraction_clear(&own);
  dyd_cert_fraction_clear(&other);
  return good;
}

static bool blocker_is_farther_out(const dyd_cert_sites *s, const dyd_exact u[2], uint32_t k, uint32_t i, uint32_t j) {
  return dyd_cert_compare_heights(s, u, i, k) < 0 && dyd_cert_compare_heights(s, u, j, k) < 0;
}

static bool chain_is_blocked(const dyd_cert_chain *c, const dyd_cert_sites *s, uint32_t i, uint32_t j) {
  for (size_t q = 0; q < c->points; q++)
    if (!blocker_is_nearer(s, c->point[q], c->blocker[q], i, j) ||
        !blocker_is_nearer(s, c->point[q], c->blocker[q + 1], i, j))
      return false;
  return blocker_is_farther_out(s, c->u[0], c->blocker[0], i, j) &&
         blocker_is_farther_out(s, c->u[1], c->blocker[c->points], i, j);
}

/* ---- separation ----
 *
 * The chain, closed at infinity, is a closed curve that avoids the places p of i and q of j; it separates them if it
 * crosses the segment pq an odd number of times. Points on the line pq count as left of it: moving the chain a little
 * changes nothing. */

static int chain_side(dyd_cert_spot p, dyd_cert_spot q, dyd_cert_spot at) {
  return dyd_cert_cross(p, q, p, at) >= 0 ? 1 : -1;
}

/* Is the segment pq met by the line from a to b, known to cross the line pq between them (or beyond, for a ray)? */
static bool segment_is_met(dyd_cert_spot p, dyd_cert_spot q, dyd_cert_spot from, dyd_cert_spot a, dyd_cert_spot b) {
  return dyd_cert_cross(a, b, from, p) * dyd_cert_cross(a, b, from, q) < 0;
}

static bool ray_crosses(dyd_cert_spot p, dyd_cert_spot q, const dyd_exact from[2], const dyd_exact u[2]) {
  dyd_exact zero[2];
  dyd_exact_init(&zero[0]);
  dyd_exact_init(&zero[1]);
  dyd_cert_spot at = dyd_cert_spot_at(from), origin = dyd_cert_spot_at(zero), way = dyd_cert_spot_at(u);
  int here = chain_side(p, q, at), end = dyd_cert_cross(p, q, origin, way);
  bool crosses = end && end != here && segment_is_met(p, q, at, origin, way);
  dyd_exact_clear(&zero[0]);
  dyd_exact_clear(&zero[1]);
  return crosses;
}

static bool segment_crosses(dyd_cert_spot p, dyd_cert_spot q, const dyd_exact a[2], const dyd_exact b[2]) {
  dyd_cert_spot from = dyd_cert_spot_at(a), to = dyd_cert_spot_at(b);
  return chain_side(p, q, from) != chain_side(p, q, to) && segment_is_met(p, q, from, from, to);
}

static bool chain_separates(const dyd_cert_chain *c, const dyd_cert_sites *s, uint32_t i, uint32_t j) {
  dyd_cert_spot p = dyd_cert_place_of(s, i), q = dyd_cert_place_of(s, j);
  bool odd = ray_crosses(p, q, c->point[0], c->u[0]) != ray_crosses(p, q, c->point[c->points - 1], c->u[1]);
  for (size_t k = 0; k + 1 < c->points; k++) odd ^= segment_crosses(p, q, c->point[k], c->point[k + 1]);
  return odd;
}

bool dyd_cert_chain_holds(const dyd_cert_chain *c, const dyd_cert_sites *s, uint32_t i, uint32_t j) {
  return c->points > 0 && chain_is_blocked(c, s, i, j) && chain_separates(c, s, i, j);
}
