/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Streams from rectangles and from pairs of reals. */
#include "stream/stream.h"

#include "base/alloc.h"
#include "base/error.h"

dyd_status dyd_stream_from_rect(dyd_stream **out, const dyd_rect *r) {
  dyd_rect copy;
  dyd_rect_init(&copy);
  dyd_rect_set(&copy, r);
  dyd_status st = dyd_stream_new_fixed(out, &copy);
  dyd_rect_clear(&copy);
  return st;
}

typedef struct pair {
  dyd_real *x, *y;
} pair;

static void pair_release(void *user) {
  pair *p = user;
  dyd_real_free(p->y);
  dyd_real_free(p->x);
  free(p);
}

static bool pair_is_final(const pair *p) {
  return dyd_real_is_final(p->x) && dyd_real_is_final(p->y);
}

static void pair_rect(dyd_rect *out, const pair *p) {
  dyd_interval_set(&out->x, dyd_real_interval(p->x));
  dyd_interval_set(&out->y, dyd_real_interval(p->y));
}

static dyd_status pair_narrow(dyd_rect *out, void *user, const dyd_request *request, dyd_error *err) {
  pair *p = user;
  dyd_status st = dyd_real_narrow(p->x, request->bits, request->max_bits, err);
  if (st >= 0) st = dyd_real_narrow(p->y, request->bits, request->max_bits, err);
  if (st < 0) return st;
  pair_rect(out, p);
  return pair_is_final(p) ? DYD_FIXED : DYD_OK;
}

static dyd_status pair_fixed(dyd_stream **out, const pair *p) {
  dyd_rect r;
  dyd_rect_init(&r);
  pair_rect(&r, p);
  dyd_status st = dyd_stream_new_fixed(out, &r);
  dyd_rect_clear(&r);
  return st;
}

dyd_status dyd_stream_from_reals(dyd_stream **out, dyd_real *x, dyd_real *y) {
  pair *p = x && y ? dyd_alloc(1, sizeof *p) : NULL;
  if (!p) {
    dyd_real_free(x);
    dyd_real_free(y);
    return x && y ? DYD_E_NOMEM : DYD_E_ARG;
  }
  *p = (pair){x, y};
  if (!pair_is_final(p)) {
    dyd_source source = {.narrow = pair_narrow, .release = pair_release, .user = p};
    return dyd_stream_new_enclosing(out, &source);
  }
  dyd_status st = pair_fixed(out, p);
  pair_release(p);
  return st;
}
