/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The probability of an edge for Gaussian errors, from below [TOL-7].
 *
 * Any disc will do: with i and j in it and all others outside, ij is an edge. About the centre of the largest empty
 * annulus, which is rounded to doubles, and half way between its circles. Errors are independent, sigma in each
 * coordinate (of each point its own), so the probability is at least the product of
 *
 *   outside   Phi(x), x = (|c - p_k| - m) / sigma: beyond the tangent;
 *   inside    a sum over slabs across the direction from c: what the slab holds, times what of it is in a rectangle
 *             within the disc; or a square within a disc about p_i.
 *
 * Whoever is farther than REACH sigma outside counts as MISS each. Phi is concave above 0: between two entries of a
 * table, rounded down, the chord is below it, by at most Phi'' h^2 / 8 < 0.242 / 8 / 512^2 < 1.16e-7. Entries are
 * lowered by 1e-13, which covers what is rounded (|x| < 10: a few 2^-50), and UP leaves as much. Distances are bounded
 * as [FLT-DST] has it; quotients and products, each off by 2^-53 of itself, are lowered by LESS. */
#include "base/alloc.h"
#include "tolerance/state.h"

#include <math.h>
#include <mpfr.h>

enum { PER_UNIT = 512, REACH = 9, ENTRIES = PER_UNIT * REACH + 2, SLABS = 48 };
#define MISS 1.2e-19 /* above 1 - Phi(9) */
#define UP 1.2e-7
#define LESS (1 - 0x1p-45)
#define FAR 0x1p20 /* a half-plane is a disc so many times as large as all */
#define NEVER 0x1p-40

/* ---- the normal distribution ---- */

/* 1 - erfc(x / sqrt 2) / 2, rounded down. */
static double phi_rounded(double x) {
  mpfr_t y, root;
  mpfr_inits2(80, y, root, (mpfr_ptr)0);
  mpfr_sqrt_ui(root, 2, MPFR_RNDU);
  mpfr_set_d(y, x, MPFR_RNDD);
  mpfr_div(y, y, root, MPFR_RNDD);
  mpfr_erfc(y, y, MPFR_RNDU);
  mpfr_div_2ui(y, y, 1, MPFR_RNDU);
  mpfr_ui_sub(y, 1, y, MPFR_RNDD);
  double out = mpfr_get_d(y, MPFR_RNDD);
  mpfr_clears(y, root, (mpfr_ptr)0);
  return out;
}

/* Below Phi(x), x >= 0. */
static double phi_table(const double *table, double x) {
  if (!(x < REACH)) return table[PER_UNIT * REACH];
  int k = (int)(x * PER_UNIT);
  return table[k] + (table[k + 1] - table[k]) * (x * PER_UNIT - k);
}

static double phi_lower(const double *table, double x) {
  return x >= 0 ? phi_table(table, x) : 1 - (phi_table(table, -x) + UP);
}

static double phi_upper(const double *table, double x) {
  return x >= 0 ? phi_table(table, x) + UP : 1 - phi_table(table, -x);
}

/* ---- one edge ---- */

typedef struct chance_pass {
  dyd_tolerance *t;
  const double *phi;
  const dyd_ring_d *ring;
  dyd_bbox at;
  double middle, product;
} chance_pass;

/* In units of sigma: p_i at `d` from the centre of a disc of radius `m`; slabs get thicker from its rim, or from 9, to
 * 8 on the other side of p_i. */
static double chance_inside(const double *phi, double m, double d) {
  double rim = fmin(m - d, REACH) * LESS, all = fmin(rim + 8, m + d + rim), sum = 0;
  for (int q = 0; q < SLABS && rim > 0; q++) {
    double depth = all * q * q / (SLABS * SLABS), next = all * (q + 1) * (q + 1) / (SLABS * SLABS);
    double outer = rim - depth, inner = rim - next, half2 = depth * (m + d + outer);
    if (d + inner < 0) half2 = fmin(half2, (m + d + inner - 0x1p-48 * (m + d)) * (m - d - inner));
    double mass = phi_lower(phi, outer) - phi_upper(phi, inner);
    if (half2 > 0 && mass > 0) sum += mass * fmax(0, 2 * phi_lower(phi, sqrt(half2) * LESS) - 1);
  }
  double side = 2 * phi_lower(phi, fmax(rim, 0) * 0.7071067811865 * LESS) - 1;
  return fmax(sum, side * side) * LESS;
}

static bool chance_outside(void *context, uint32_t k) {
  chance_pass *p = context;
  if (k == p->ring->i || k == p->ring->j) return true;
  double d = sqrt(fmax(dyd_ds2_lower(&p->at, &p->t->box[k]), 0)) * LESS, x = (d - p->middle) / p->t->sigma[k];
  p->product *= x > 0 ? phi_lower(p->phi, x * LESS) * LESS : 0;
  return p->product > NEVER;
}

static void set_chance_centre(chance_pass *p) {
  const dyd_xy *xy = p->t->points.xy;
  dyd_xy a = xy[p->ring->i], b = xy[p->ring->j];
  double jx = b.x - a.x, jy = b.y - a.y, s = p->ring->s;
  if (p->ring->end)
    s = p->ring->end * FAR * (p->t->sk->mesh.extent[0] + p->t->sk->mesh.extent[1]) / sqrt(jx * jx + jy * jy);
  double x = a.x + (jx / 2 - s * jy), y = a.y + (jy / 2 + s * jx);
  p->at = (dyd_bbox){{x, x, y, y}};
}

static double chance_of_ring(chance_pass *p) {
  double d[2], most = 0;
  set_chance_centre(p);
  for (int e = 0; e < 2; e++) {
    d[e] = sqrt(dyd_dl2_upper(&p->at, &p->t->box[e ? p->ring->j : p->ring->i])) * (1 + 0x1p-45);
    most = fmax(most, d[e]);
  }
  p->middle = most + p->ring->half;
  double reach = p->middle + REACH * p->t->widest, radius2 = dyd_upper(reach * reach) * (1 + 0x1p-45);
  if (!(radius2 < 1e300) || !(most > 0)) return 0;
  p->product = 1 - (double)p->t->sk->n * MISS;
  for (int e = 0; e < 2; e++) {
    double sigma = p->t->sigma[e ? p->ring->j : p->ring->i];
    p->product *= chance_inside(p->phi, p->middle / sigma, d[e] / sigma) * LESS;
  }
  if (p->product > NEVER) dyd_tree_near(&p->t->tree, &p->at, &radius2, chance_outside, p);
  return p->product > NEVER ? p->product : 0;
}

/* ---- all ---- */

dyd_status dyd_chances(dyd_tolerance *t) {
  dyd_status st = dyd_near_index(t);
  double *phi = dyd_alloc(ENTRIES, sizeof *phi);
  t->chance = dyd_alloc(t->rows, sizeof *t->chance);
  if (!phi || !t->chance) st = DYD_E_NOMEM;
  for (int k = 0; k < ENTRIES && st == DYD_OK; k++) phi[k] = phi_rounded((double)k / PER_UNIT) - 1e-13;
  for (size_t r = 0; r < t->rows && st == DYD_OK; r++) {
    bool lasts = t->row[r].lo == HUGE_VAL;
    t->chance[r] = t->row[r].event != DYD_EVENT_DEATH ? 0 : lasts ? 1 : NAN; /* each NaN has its ring */
  }
  chance_pass p = {.t = t, .phi = phi};
  for (size_t k = 0; k < t->rings && st == DYD_OK; k++) {
    p.ring = &t->ring[k];
    if (dyd_flag_is_set(t->options.cancel)) st = DYD_CANCELLED;
    if (st == DYD_OK) t->chance[dyd_row_find(t, p.ring->i, p.ring->j)] = chance_of_ring(&p);
  }
  free(phi);
  return st;
}
