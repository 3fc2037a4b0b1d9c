/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Discs of a certificate: which circle is a witness of two, and which others rule all circles of two out [CERT-11].
 *
 * Let r_i <= r_j, neither disc in the other, P_k = p_k - p_i. With delta = r_j - r_i, N_j = |P_j|^2 - delta^2, s_k =
 * r_k + r_i, N_k = |P_k|^2 - s_k^2, a direction u has no circle for i and j that k does not forbid, for any choice,
 * when it is in the cap { u : u.w > tau } of k,
 *
 *     w = N_j P_k - N_k P_j,   tau = N_j s_k + N_k delta,
 *
 * or in that of the pair itself, w = -P_j, tau = delta [DISC-1]. When all directions are in such caps the pair is
 * illegal. The opposites of the directions that lie in no closed cap are those of witnesses. */
#ifndef DYD_CHECKER_CAPS_H
#define DYD_CHECKER_CAPS_H

#include "checker/tree.h"

/* Invariant: r >= 0. */
typedef struct dyd_cert_disc {
  dyd_exact x, y, r;
} dyd_cert_disc;

void dyd_cert_disc_init(dyd_cert_disc *d);
void dyd_cert_disc_clear(dyd_cert_disc *d);
/* Returns true if |p_a - p_b| is at most the sum of the radii. */
bool dyd_cert_discs_meet(const dyd_cert_disc *a, const dyd_cert_disc *b);
/* Returns true if |c - p_i| + r_i < |c - p_k| - r_k. */
bool dyd_cert_disc_is_nearer(const dyd_exact c[2], const dyd_cert_disc *i, const dyd_cert_disc *k);

/* Returns true if |c - p_i| + r_i and |c - p_j| + r_j are less than |c - p_k| - r_k for all other sites k but aliases
 * that can be that near: a site is skipped when its rectangle is farther than those of i and j reach. disc: of each
 * site. *other (may be NULL) is a site that is too near when the answer is false. */
bool dyd_cert_is_disc_witness(uint32_t *other, const dyd_cert_sites *s, const dyd_cert_tree *t,
                              const dyd_cert_disc *disc, uint32_t i, uint32_t j, const dyd_exact c[2]);

/* Invariant: tau >= 0, ww = |w|^2, c = ww - tau^2; the cap is empty unless c > 0. n: N_k. */
typedef struct dyd_cert_cap {
  dyd_exact wx, wy, tau, ww, c, n;
} dyd_cert_cap;

/* Invariant: item[0 .. made-1] are initialised, item[0 .. count-1] in use; the first is that of the pair. i, j:
 * borrowed, the smaller disc first. */
typedef struct dyd_cert_caps {
  const dyd_cert_disc *i, *j;
  dyd_exact jx, jy, delta, nj;
  dyd_cert_cap *item;
  size_t count, made, cap;
} dyd_cert_caps;

void dyd_cert_caps_init(dyd_cert_caps *c);
void dyd_cert_caps_clear(dyd_cert_caps *c);
/* Begins for two discs, which are borrowed until the next call. *good = false: one is in the other, no cap is there.
 * DYD_E_NOMEM. */
dyd_status dyd_cert_caps_begin(bool *good, dyd_cert_caps *c, const dyd_cert_disc *a, const dyd_cert_disc *b);
/* Adds disc k. *added = false: it meets one of the two, and forbids nothing. DYD_E_NOMEM. */
dyd_status dyd_cert_caps_add(bool *added, dyd_cert_caps *c, const dyd_cert_disc *k);
/* Returns true if each direction is in a cap. If not, *end is a cap whose counter-clockwise end is in none, or
 * c->count: all caps are empty. O(count^2) */
bool dyd_cert_caps_cover(size_t *end, const dyd_cert_caps *c);

#endif
