/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Probes: a few points of a crowded face go ahead, to learn how far the others must go.
 *
 * Where many points are nearly on one circle, a stage that does not decide them costs much: all their pairs stay
 * possible. Whether two crossing pairs can displace one another depends on four points only, and is asked again for
 * nothing (dyd_cannot_displace). So up to four disjoint quads of the face are narrowed alone, step by step, until the
 * first of them is decided; then the precision at which it would have been is found by rounding its rectangles outward,
 * and the other ends of the face are narrowed to a little more than that. Where fewer than four quads show it, they are
 * narrowed to sixteen times their bits at most, and where no quad is decided at the limit, for just that: a stage costs
 * as much as the finest rectangles in it. The first, not the last: quads that hold two points very near to one another,
 * or a tie, say nothing about the rest. Probes that were sent too far belong to quads that are undecided, or were so a
 * step before: the schedule would have come to that precision as well.
 *
 * Like all of the schedule this only chooses what to narrow. */
#include "engine/probe.h"

#include "base/alloc.h"
#include "engine/points.h"
#include "predicate/circle.h"
#include "rect/rect.h"
#include <dyadel/predicate.h>

/* For each quad to be found: number of tries of the quad rule for one pair, number of tries for four in all, and number
 * of pairs examined. The stride is a prime beyond the number of pairs, so that it leads to all of them. */
#define TRIES 8
#define STEPS 256
#define STRIDE ((size_t)2654435761)
/* Beyond this many bits the steps of probes are shorter. */
#define DEAR 1024
/* Bits requested beyond the number that decides a quad: this, and one in 64. */
#define MARGIN 8
#define MOST_LEAP 16

void dyd_probes_clear(dyd_probes *s) {
  dyd_free_all(s->item, s->of);
  *s = (dyd_probes){0};
}

/* ---- quads ---- */

static dyd_status quad_fetch(dyd_rect r[4], const dyd_engine *e, const dyd_quad_sites *q) {
  dyd_status st = DYD_OK;
  for (int k = 0; st == DYD_OK && k < 4; k++) st = dyd_sites_get(&r[k], e->sites, q->v[k]);
  return st;
}

static bool quad_rule_decides(const dyd_rect r[4]) {
  return dyd_cannot_displace(&r[0], &r[1], &r[2], &r[3]) == DYD_TRUE ||
         dyd_cannot_displace(&r[2], &r[3], &r[0], &r[1]) == DYD_TRUE;
}

static dyd_status quad_is_decided(bool *out, const dyd_engine *e, const dyd_quad_sites *q) {
  DYD_LOCAL_ARRAY(dyd_rect, r, [4]);
  dyd_status st = quad_fetch(r, e, q);
  if (st == DYD_OK) *out = quad_rule_decides(r);
  return st;
}

/* ---- finding them ---- */

static bool is_marked(const dyd_wants *wants, uint32_t site) {
  const dyd_refinable *p = dyd_engine_find(wants->e, site);
  return p && dyd_wants_find(wants, p);
}

static bool probe_has(const dyd_probe *probe, uint32_t site) {
  for (size_t k = 0; k < 4 * probe->quads; k++)
    if (probe->quad[k / 4].v[k % 4] == site) return true;
  return false;
}

/* An indeterminate pair with ends that are marked and free. */
static bool probe_can_take(const dyd_probe *probe, const dyd_wants *wants, const dyd_pair *p) {
  return p->status == DYD_INDETERMINATE && !probe_has(probe, p->i) && !probe_has(probe, p->j) &&
         is_marked(wants, p->i) && is_marked(wants, p->j);
}

static bool share_an_end(const dyd_pair *p, const dyd_pair *q) {
  return p->i == q->i || p->i == q->j || p->j == q->i || p->j == q->j;
}

/* Adds the quad of p and one of the pairs from number *at on, when one is found within the bounds. */
static dyd_status probe_find_partner(size_t *at, size_t *tries, dyd_probe *probe, const dyd_wants *wants,
                                     const dyd_pair_list *pairs, const dyd_pair *p) {
  dyd_status st = DYD_OK;
  bool decided = true;
  for (size_t n = 0; st == DYD_OK && decided && n < pairs->count && n < STEPS && *tries % TRIES; n++) {
    const dyd_pair *q = &pairs->item[*at];
    *at = (*at + STRIDE) % pairs->count;
    if (share_an_end(p, q) || !probe_can_take(probe, wants, q)) continue;
    const dyd_quad_sites quad = {{p->i, p->j, q->i, q->j}};
    st = quad_is_decided(&decided, wants->e, &quad);
    ++*tries;
    if (st == DYD_OK && !decided) probe->quad[probe->quads++] = quad;
  }
  return st;
}

/* Adds a quad, when one is found within the bounds. Pairs are taken in strides, as if at random. */
static dyd_status probe_find_quad(size_t *at, dyd_probe *probe, const dyd_wants *wants, const dyd_pair_list *pairs) {
  dyd_status st = DYD_OK;
  size_t before = probe->quads;
  for (size_t n = 0, tries = 1; st == DYD_OK && probe->quads == before && n < STEPS && tries < 4 * TRIES; n++) {
    const dyd_pair *p = &pairs->item[*at];
    *at = (*at + STRIDE) % pairs->count;
    if (!probe_can_take(probe, wants, p)) continue;
    st = probe_find_partner(at, &tries, probe, wants, pairs, p);
    tries = (tries / TRIES + 1) * TRIES + 1;
  }
  return st;
}

static dyd_status probes_append(dyd_probes *s, const dyd_wants *wants, const dyd_pair_list *pairs,
                                const dyd_probe *probe) {
  const dyd_engine *e = wants->e;
  if (!s->of) s->of = calloc(e->points, sizeof *s->of);
  if (!s->of || s->count >= UINT32_MAX || !DYD_GROW(s->item, s->cap, s->count + 1)) {
    return DYD_E_NOMEM;
  }
  s->item[s->count++] = *probe;
  for (size_t k = 0; k < 2 * pairs->count; k++) {
    const dyd_refinable *p = dyd_engine_find(e, k % 2 ? pairs->item[k / 2].j : pairs->item[k / 2].i);
    if (p && dyd_wants_find(wants, p)) s->of[p - e->point] = (uint32_t)s->count;
  }
  return DYD_OK;
}

dyd_status dyd_probes_add(dyd_probes *s, const dyd_wants *wants, const dyd_pair_list *pairs) {
  dyd_probe probe = {.quads = 0};
  dyd_status st = DYD_OK;
  /* Eight points have at least eight pairs that are not edges of their hull, if all cross. */
  if (pairs->count < 8) return DYD_OK;
  for (size_t k = 0, at = 0; st == DYD_OK && k < DYD_PROBE_QUADS && probe.quads == k; k++)
    st = probe_find_quad(&at, &probe, wants, pairs);
  return st != DYD_OK || probe.quads < 2 ? st : probes_append(s, wants, pairs, &probe);
}

/* ---- the probe ---- */

/* Ends rounded outward to multiples of 2^-bits; rational points stay. */
static dyd_status quad_widen_side(dyd_interval *a, int64_t bits) {
  if (mpz_cmp_ui(a->den, 1) != 0) return DYD_OK;
  dyd_status st = dyd_dyadic_round(&a->lo, &a->lo, -bits, DYD_DOWN);
  return st != DYD_OK ? st : dyd_dyadic_round(&a->hi, &a->hi, -bits, DYD_UP);
}

static dyd_status quad_decides_at(bool *out, const dyd_rect r[4], int64_t bits) {
  DYD_LOCAL_ARRAY(dyd_rect, wide, [4]);
  dyd_status st = DYD_OK;
  for (int k = 0; st == DYD_OK && k < 4; k++) {
    dyd_rect_set(&wide[k], &r[k]);
    st = quad_widen_side(&wide[k].x, bits);
    if (st == DYD_OK) st = quad_widen_side(&wide[k].y, bits);
  }
  if (st == DYD_OK) *out = quad_rule_decides(wide);
  return st;
}

/* About the least bits that decide the quad, which is decided now: at most what its points were asked for. */
static dyd_status quad_find_need(int64_t *out, const dyd_engine *e, const dyd_quad_sites *q) {
  DYD_LOCAL_ARRAY(dyd_rect, r, [4]);
  int64_t hi = 0, lo = 0;
  for (int k = 0; k < 4; k++) {
    const dyd_refinable *p = dyd_engine_find(e, q->v[k]);
    if (p && p->bits > hi) hi = p->bits;
  }
  dyd_status st = quad_fetch(r, e, q);
  while (st == DYD_OK && hi - lo > MARGIN + hi / 128) {
    int64_t mid = lo + (hi - lo) / 2;
    bool decided = false;
    st = quad_decides_at(&decided, r, mid);
    if (decided)
      hi = mid;
    else
      lo = mid;
  }
  *out = hi;
  return st;
}

/* From b bits to the next, at most to `most`: twice as many, and half as many again where that begins to cost. */
static int64_t probe_step(int64_t b, int64_t most) {
  return dyd_bits_raised(b, b < 16 ? 16 : b < DEAR ? b : b / 2, most);
}

/* Sends the probes of a quad that can continue: first for the bits wanted, then for more. Returns their number. */
static size_t probe_send_quad(dyd_wants *out, dyd_wants *held, const dyd_quad_sites *q) {
  size_t sent = 0;
  for (int k = 0; k < 4; k++) {
    const dyd_refinable *p = dyd_engine_find(out->e, q->v[k]);
    if (p->final || p->bits >= out->o->max_bits) continue;
    dyd_want *first = dyd_wants_find(held, p), *now = dyd_wants_find(out, p);
    int64_t bits = first->sent ? probe_step(p->bits, out->o->max_bits) : first->bits;
    if (now)
      now->bits = bits;
    else
      dyd_wants_mark(out, p, bits, first->reason, first->i, first->j);
    first->sent = true;
    sent++;
  }
  return sent;
}

/* Judges one probe, and sends the probes on when it continues. */
static dyd_status probe_run(dyd_wants *out, dyd_probe *probe, dyd_wants *held) {
  dyd_status st = DYD_OK;
  size_t sent = 0;
  for (size_t k = 0; st == DYD_OK && !probe->over && k < probe->quads; k++) {
    st = quad_is_decided(&probe->over, out->e, &probe->quad[k]);
    if (st == DYD_OK && probe->over) st = quad_find_need(&probe->bits, out->e, &probe->quad[k]);
  }
  if (st != DYD_OK || probe->over) return st;
  for (size_t k = 0; k < probe->quads; k++) sent += probe_send_quad(out, held, &probe->quad[k]);
  probe->over = sent == 0;
  return out->failed;
}

dyd_status dyd_probes_next(dyd_wants *out, dyd_probes *s, dyd_wants *held) {
  dyd_status st = DYD_OK;
  for (size_t k = 0; st == DYD_OK && k < s->count; k++)
    if (!s->item[k].over) st = probe_run(out, &s->item[k], held);
  return st;
}

/* Least precision requested of an end with b bits in a face with this probe: 0 when the probe shows nothing. Where no
 * quad was decided at the limit, the least that is worth a stage. */
static int64_t probe_leap(const dyd_probe *probe, int64_t b, int64_t most) {
  int64_t need = probe->bits + MARGIN + probe->bits / 64, longest = b > 0 ? MOST_LEAP * b : 0;
  if (!probe->over) return 0;
  if (probe->bits == 0 || (probe->quads < DYD_PROBE_QUADS && need > longest)) need = longest;
  return need < most ? need : most;
}

void dyd_probes_finish(dyd_wants *out, const dyd_probes *s, const dyd_wants *held) {
  for (size_t k = 0; k < held->count; k++) {
    const dyd_want *w = &held->item[k];
    const dyd_refinable *p = dyd_wants_point(held, w);
    uint32_t probe = s->of[p - held->e->point];
    int64_t more = probe ? probe_leap(&s->item[probe - 1], p->bits, out->o->max_bits) : 0;
    if (!w->sent) dyd_wants_mark(out, p, more > w->bits ? more : w->bits, w->reason, w->i, w->j);
  }
}
