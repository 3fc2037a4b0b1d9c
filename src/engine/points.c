/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Adding points to an engine, and asking one point to narrow.
 *
 * A fixed site is an entry of the table of sites and nothing else. A site that can be narrowed has a record besides,
 * and holds the whole plane in the table until it is first asked. [NEST-1] is kept by dyd_sites_narrow, for sources and
 * streams alike: the table is the one memory of what was given before. */
#include "engine/points.h"
#include "engine/words.h"

#include "base/abi.h"
#include "base/alloc.h"
#include "base/error.h"
#include "base/index.h"
#include "rect/interval.h"
#include "rect/sites_table.h"
#include "stream/real.h"
#include "stream/stream.h"

dyd_status dyd_engine_add_points(dyd_engine *e, size_t n, const double *x, const double *y) {
  return e->started ? DYD_E_ARG : dyd_sites_add_points(e->sites, n, x, y);
}

dyd_status dyd_engine_add_boxes(dyd_engine *e, size_t n, const double *x0, const double *x1, const double *y0,
                                const double *y1) {
  return e->started ? DYD_E_ARG : dyd_sites_add_boxes(e->sites, n, x0, x1, y0, y1);
}

dyd_status dyd_engine_add_rect(dyd_engine *e, const dyd_rect *r) {
  return e->started ? DYD_E_ARG : dyd_sites_add_rect(e->sites, r);
}

dyd_status dyd_engine_add_words(dyd_engine *e, size_t n, const dyd_words *xy) {
  return e->started ? DYD_E_ARG : dyd_sites_add_words(e->sites, n, xy);
}

/* Appends n sites with records like p; the site number is filled in. Nothing on failure. */
static dyd_status points_add_refinable(dyd_engine *e, size_t n, dyd_refinable p) {
  size_t first = dyd_sites_count(e->sites);
  if (n > DYD_MAX_SITES) return DYD_E_RANGE;
  if (!dyd_reserve((void **)&e->point, &e->point_cap, e->points + n, sizeof *e->point)) return DYD_E_NOMEM;
  dyd_status st = dyd_sites_add_planes(e->sites, n);
  if (st != DYD_OK) return st;
  for (size_t k = 0; k < n; k++) {
    p.site = (uint32_t)(first + k);
    e->point[e->points++] = p;
  }
  return DYD_OK;
}

dyd_status dyd_engine_add_stream(dyd_engine *e, dyd_stream *s) {
  dyd_status st;
  const dyd_rect *fixed = dyd_stream_is_final(s) ? dyd_stream_rect(s) : NULL;
  if (e->started)
    st = DYD_E_ARG;
  else if (fixed)
    st = dyd_sites_add_rect(e->sites, fixed);
  else
    st = points_add_refinable(e, 1, (dyd_refinable){.stream = s});
  if (fixed || st != DYD_OK) dyd_stream_free(s);
  return st;
}

static dyd_status points_add_source(dyd_engine *e, size_t n, const dyd_source *source) {
  if (e->started || !source->narrow) return DYD_E_ARG;
  if (!dyd_reserve((void **)&e->source, &e->source_cap, e->sources + 1, sizeof *e->source)) return DYD_E_NOMEM;
  size_t first = dyd_sites_count(e->sites);
  dyd_status st = points_add_refinable(e, n, (dyd_refinable){.source = (uint32_t)e->sources});
  if (st == DYD_OK) e->source[e->sources++] = (dyd_source_use){*source, (uint32_t)first, NULL};
  return st;
}

dyd_status dyd_engine_add_source(dyd_engine *e, size_t n, const dyd_source *source, dyd_error *err) {
  dyd_source s;
  dyd_status st = dyd_abi_take(&s, sizeof s, source, "dyd_source", err);
  if (st != DYD_OK) return st;
  st = points_add_source(e, n, &s);
  if (st != DYD_OK && s.release) s.release(s.user);
  return st == DYD_OK ? st : dyd_fail(err, st, "%s", dyd_status_text(st));
}

void dyd_shared_source_free(dyd_shared_source *s) {
  if (!s || --s->refs) return;
  if (s->source.release) s->source.release(s->source.user);
  free(s);
}

void dyd_engine_clear_points(dyd_engine *e) {
  for (size_t k = 0; k < e->points; k++) dyd_stream_free(e->point[k].stream);
  for (size_t k = 0; k < e->sources; k++) {
    const dyd_source *s = &e->source[k].source;
    if (e->source[k].shared)
      dyd_shared_source_free(e->source[k].shared);
    else if (s->release)
      s->release(s->user);
  }
  free(e->point);
  free(e->source);
}

const dyd_refinable *dyd_engine_find(const dyd_engine *e, uint32_t site) {
  return dyd_find_index(&site, e->point, e->points, sizeof *e->point);
}

/* ---- asking ---- */

dyd_status dyd_engine_request(dyd_request *out, const dyd_refinable *p, const dyd_engine *e, int64_t bits,
                              int64_t max_bits, dyd_error *err) {
  dyd_status st = dyd_request_make(out, p->site - e->source[p->source].first, bits, max_bits, err);
  out->stop = &e->stop;
  return st;
}

/* Asks the source of p. *r comes in as the rectangle so far and goes out as the answer, checked to be one; *final:
 * no call can narrow it further. */
static dyd_status point_ask_source(dyd_rect *r, bool *final, const dyd_refinable *p, const dyd_engine *e, int64_t bits,
                                   int64_t max_bits, dyd_error *err) {
  const dyd_source_use *use = &e->source[p->source];
  dyd_request request;
  dyd_error own;
  dyd_error_clear(&own);
  dyd_status st = dyd_engine_request(&request, p, e, bits, max_bits, err);
  if (st != DYD_OK) return st;
  st = use->source.narrow(r, use->source.user, &request, &own);
  *final = st == DYD_FIXED;
  if (st == DYD_CANCELLED && dyd_flag_get(&e->stop)) return st;
  if (st != DYD_OK && st != DYD_FIXED) return dyd_callback_fail(err, &own, st, p->site, p->calls);
  if (!dyd_interval_is_valid(&r->x) || !dyd_interval_is_valid(&r->y)) {
    return dyd_fail(err, DYD_E_STREAM, "the source gave no valid rectangle; fill it with dyd_interval_set_ends");
  }
  return DYD_OK;
}

static dyd_status point_ask_stream(dyd_rect *r, bool *final, const dyd_refinable *p, int64_t bits, int64_t max_bits,
                                   dyd_error *err) {
  dyd_status st = dyd_stream_narrow(p->stream, bits, max_bits, err);
  if (dyd_failed(st)) return st;
  const dyd_rect *now = dyd_stream_rect(p->stream);
  if (!now) return dyd_fail(err, DYD_E_STREAM, "the stream has no rectangle after it was narrowed");
  if (r) dyd_rect_set(r, now);
  *final = dyd_stream_is_final(p->stream);
  return DYD_OK;
}

/* DYD_E_NESTING with the sides that are not nested. */
static dyd_status point_nesting_fail(dyd_error *err, const dyd_engine *e, const dyd_refinable *p, const dyd_rect *r) {
  dyd_rect old;
  dyd_rect_init(&old);
  dyd_status st = dyd_sites_get(&old, e->sites, p->site);
  if (st != DYD_OK)
    dyd_fail(err, st, "%s", dyd_status_text(st));
  else if (!dyd_interval_contains(&old.x, &r->x))
    st = dyd_nesting_fail(err, "x side", &old.x, &r->x);
  else
    st = dyd_nesting_fail(err, "y side", &old.y, &r->y);
  dyd_rect_clear(&old);
  return st;
}

/* Puts what was given for p into the table, which checks that it is nested. */
static dyd_status point_put(const dyd_refinable *p, const dyd_engine *e, const dyd_rect *r, dyd_error *err) {
  dyd_status st = dyd_sites_narrow(e->sites, p->site, r);
  if (st == DYD_E_NESTING && !p->asked) {
    return dyd_fail(err, DYD_E_RANGE, "the rectangle given leaves the exponent range");
  }
  if (st == DYD_E_NESTING) return point_nesting_fail(err, e, p, r);
  return st != DYD_OK ? dyd_fail(err, st, "%s", dyd_status_text(st)) : st;
}

/* Fills in what the engine knows about a failure at p. */
static dyd_status point_blame(const dyd_refinable *p, dyd_status st, dyd_error *err) {
  err->code = st;
  err->point = p->site;
  err->stage = p->calls;
  if (!err->message[0]) dyd_fail(err, st, "%s", dyd_status_text(st));
  return st;
}

/* The first call of a stream, where doubles hold its answer. */
static bool point_narrow_in_doubles(dyd_refinable *p, uint64_t *calls, dyd_engine *e, int64_t bits) {
  dyd_double_span side[2];
  if (p->asked || !p->stream || !dyd_stream_glance(side, p->stream, bits)) return false;
  const double box[4] = {side[0].lo, side[0].hi, side[1].lo, side[1].hi};
  if (dyd_sites_narrow_d(e->sites, p->site, box) < 0) return false;
  ++*calls;
  p->calls++;
  p->bits = bits;
  p->final = box[0] == box[1] && box[2] == box[3];
  p->asked = true;
  return true;
}

/* A guest has no place in the table, and counts what its stream was asked. */
static dyd_status guest_narrow(dyd_refinable *p, uint64_t *calls, int64_t bits, int64_t max_bits, dyd_error *err) {
  uint64_t before = dyd_stream_stage(p->stream);
  dyd_status st = point_ask_stream(NULL, &p->final, p, bits, max_bits, err);
  *calls += dyd_stream_stage(p->stream) - before;
  p->bits = bits;
  p->asked = true;
  return st;
}

dyd_status dyd_engine_narrow(dyd_refinable *p, uint64_t *calls, dyd_engine *e, int64_t bits, int64_t max_bits,
                             dyd_error *err) {
  dyd_rect r;
  bool final = p->final;
  if (p->site >= dyd_sites_count(e->sites)) return guest_narrow(p, calls, bits, max_bits, err);
  if (point_narrow_in_doubles(p, calls, e, bits)) return DYD_OK;
  dyd_error_clear(err);
  dyd_rect_init(&r);
  dyd_status st = p->asked ? dyd_sites_get(&r, e->sites, p->site) : DYD_OK;
  if (st == DYD_OK && !(p->asked && dyd_rect_bits(&r) >= bits)) {
    ++*calls;
    st = p->stream ? point_ask_stream(&r, &final, p, bits, max_bits, err)
                   : point_ask_source(&r, &final, p, e, bits, max_bits, err);
    final |= dyd_rect_is_point(&r);
    if (st == DYD_OK) st = point_put(p, e, &r, err);
    if (st == DYD_OK) p->calls++;
  }
  if (st == DYD_OK) {
    p->bits = bits;
    p->final = final;
    p->asked = true;
  }
  dyd_rect_clear(&r);
  return st == DYD_OK || st == DYD_CANCELLED ? st : point_blame(p, st, err);
}
