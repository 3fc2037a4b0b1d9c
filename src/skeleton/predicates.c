/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The rungs in their order: filter, fixed-size integers, GMP. */
#include "skeleton/predicates.h"

#include "skeleton/mesh_exact.h"
#include "skeleton/mesh_fixed.h"

static int orient_slow(dyd_tally *tally, const dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c) {
  if (!m->no_filter) {
    int sign = dyd_filter_orient_near(m, m->xy[a], m->xy[b], m->xy[c]);
    if (sign || dyd_filter_orient_small(&sign, m, m->xy[a], m->xy[b], m->xy[c])) return sign;
    if (m->fixed) return tally->integer++, dyd_fixed_orient(m, a, b, c);
  }
  tally->exact++;
  return dyd_mesh_orient_exact(m, a, b, c);
}

int dyd_mesh_orient(dyd_tally *tally, const dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c) {
  tally->asked++;
  int sign = dyd_filter_orient(m, m->xy[a], m->xy[b], m->xy[c]);
  return sign ? sign : orient_slow(tally, m, a, b, c);
}

static int incircle_real(dyd_tally *tally, const dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c, uint32_t p) {
  int sign;
  if (!m->no_filter) {
    if (dyd_filter_incircle_small(&sign, m, dyd_incircle_of(m->xy[a], m->xy[b], m->xy[c], m->xy[p]))) return sign;
    if ((sign = dyd_filter_incircle_near(m, m->xy[a], m->xy[b], m->xy[c], m->xy[p]))) return sign;
    if (dyd_fixed_incircle(&sign, m, a, b, c, p)) return tally->integer++, sign;
  }
  tally->exact++;
  return dyd_mesh_incircle_exact(m, a, b, c, p);
}

/* Counted with the in-circle test that it answers. */
static int incircle_ghost(dyd_tally *tally, const dyd_mesh *m, uint32_t a, uint32_t b, uint32_t p) {
  int side = dyd_filter_orient(m, m->xy[a], m->xy[b], m->xy[p]);
  if (!side) side = orient_slow(tally, m, a, b, p);
  if (side) return side;
  tally->ties++;
  return dyd_mesh_between(m, a, b, p) ? 1 : 0;
}

static int incircle_slow(dyd_tally *tally, const dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c, uint32_t p) {
  if (a == m->n) return incircle_ghost(tally, m, b, c, p);
  if (b == m->n) return incircle_ghost(tally, m, c, a, p);
  if (c == m->n) return incircle_ghost(tally, m, a, b, p);
  int sign = incircle_real(tally, m, a, b, c, p);
  if (!sign) tally->ties++;
  return sign;
}

int dyd_mesh_incircle(dyd_tally *tally, const dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c, uint32_t p) {
  int sign;
  return dyd_incircle_quick(&sign, tally, m, a, b, c, p) ? sign : incircle_slow(tally, m, a, b, c, p);
}

/* The grid costs O(n), so it is made when the filters have said that they do not know. */
int dyd_build_orient_slow(dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c) {
  bool tried = m->fixed || m->no_fixed;
  if (!tried && !dyd_filter_orient_near(m, m->xy[a], m->xy[b], m->xy[c])) dyd_fixed_prepare(m);
  return orient_slow(&m->tally, m, a, b, c);
}

int dyd_build_incircle_slow(dyd_mesh *m, uint32_t a, uint32_t b, uint32_t c, uint32_t p) {
  uint32_t g = m->n, u = a == g ? b : b == g ? c : a, v = a == g ? c : b == g ? a : b;
  bool real = a != g && b != g && c != g, tried = m->fixed || m->no_fixed;
  if (!tried && (real || !dyd_filter_orient(m, m->xy[u], m->xy[v], m->xy[p]))) dyd_fixed_prepare(m);
  return incircle_slow(&m->tally, m, a, b, c, p);
}

void dyd_tally_add(dyd_delaunay_counters *sum, const dyd_tally *tally, bool no_filter) {
  uint64_t beyond = tally->integer + tally->exact;
  if (!no_filter && tally->asked > beyond) sum->filter += tally->asked - beyond;
  sum->integer += tally->integer;
  sum->exact += tally->exact;
}
