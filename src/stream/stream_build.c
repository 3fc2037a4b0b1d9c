/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Streams from rectangles and from pairs of reals. */
#include "stream/stream.h"

#include "base/error.h"
#include "stream/real.h"

dyd_status dyd_stream_from_rect(dyd_stream **out, const dyd_rect *r) {
  dyd_rect copy;
  dyd_rect_init(&copy);
  dyd_rect_set(&copy, r);
  dyd_status st = dyd_stream_new_fixed(out, &copy);
  dyd_rect_clear(&copy);
  return st;
}

static void pair_release(void *user) {
  dyd_stream_pair *p = user;
  dyd_real_free(p->y);
  dyd_real_free(p->x);
}

static bool pair_is_final(const dyd_stream_pair *p) {
  return dyd_real_is_final(p->x) && dyd_real_is_final(p->y);
}

static void pair_rect(dyd_rect *out, const dyd_stream_pair *p) {
  dyd_interval_set(&out->x, dyd_real_interval(p->x));
  dyd_interval_set(&out->y, dyd_real_interval(p->y));
}

static dyd_status pair_narrow(dyd_rect *out, void *user, const dyd_request *request, dyd_error *err) {
  dyd_stream_pair *p = user;
  dyd_status st = dyd_real_narrow_until(p->x, request->bits, request->max_bits, request->stop, err);
  if (dyd_narrow_ended(st)) return st;
  st = dyd_real_narrow_until(p->y, request->bits, request->max_bits, request->stop, err);
  if (dyd_narrow_ended(st)) return st;
  pair_rect(out, p);
  return pair_is_final(p) ? DYD_FIXED : DYD_OK;
}

static dyd_status pair_fixed(dyd_stream **out, const dyd_stream_pair *p) {
  dyd_rect r;
  dyd_rect_init(&r);
  pair_rect(&r, p);
  dyd_status st = dyd_stream_new_fixed(out, &r);
  dyd_rect_clear(&r);
  return st;
}

dyd_status dyd_stream_from_reals(dyd_stream **out, dyd_real *x, dyd_real *y) {
  dyd_stream_pair p = {x, y};
  void *inside;
  dyd_status st = x && y ? DYD_OK : DYD_E_ARG;
  if (st == DYD_OK && !pair_is_final(&p)) {
    st = dyd_stream_new_inside(out, &inside, sizeof p, pair_narrow, pair_release);
    if (st == DYD_OK) {
      *(dyd_stream_pair *)inside = p;
      dyd_stream_set_object(*out, DYD_STREAM_PAIR, inside);
      return DYD_OK;
    }
  } else if (st == DYD_OK) {
    st = pair_fixed(out, &p);
  }
  pair_release(&p);
  return st;
}

bool dyd_stream_reaches(const dyd_stream *s, const dyd_rect *now, int64_t bits) {
  const dyd_stream_pair *p = dyd_stream_user(s, pair_narrow);
  if (p) return dyd_real_reaches(p->x, &now->x, bits) && dyd_real_reaches(p->y, &now->y, bits);
  return dyd_stream_is_final(s) || dyd_rect_bits(now) >= bits;
}

/* A side becomes its core. What it is cut to by others goes on to be cut from it. */
static dyd_status side_core(dyd_interval *side, bool *has, const dyd_real *x, bool narrower) {
  dyd_interval core;
  dyd_interval_init(&core);
  dyd_status st = dyd_real_core(&core, has, x, narrower ? dyd_real_interval(x) : side);
  *has = *has && dyd_interval_meets(&core, side);
  if (st == DYD_OK && *has) st = dyd_interval_intersect(side, side, &core);
  dyd_interval_clear(&core);
  return st;
}

dyd_status dyd_stream_core(dyd_rect *r, bool core[2], const dyd_stream *s, bool narrower) {
  const dyd_stream_pair *p = dyd_stream_user(s, pair_narrow);
  core[0] = core[1] = dyd_stream_is_final(s);
  if (!p || core[0]) return DYD_OK;
  dyd_status st = side_core(&r->x, &core[0], p->x, narrower);
  return st == DYD_OK ? side_core(&r->y, &core[1], p->y, narrower) : st;
}

bool dyd_stream_glance(dyd_double_span out[2], const dyd_stream *s, int64_t bits) {
  const dyd_stream_pair *p = dyd_stream_user(s, pair_narrow);
  if (!p || dyd_stream_rect(s)) return false;
  return dyd_real_glance(&out[0], p->x, bits) && dyd_real_glance(&out[1], p->y, bits);
}

int64_t dyd_stream_glance_bits(const dyd_stream *s) {
  const dyd_stream_pair *p = dyd_stream_user(s, pair_narrow);
  if (!p || dyd_stream_rect(s)) return INT64_MIN;
  int64_t x = dyd_real_glance_bits(p->x), y = dyd_real_glance_bits(p->y);
  return x < y ? x : y;
}
