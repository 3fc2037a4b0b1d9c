/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Points of an engine as streams that outlive it.
 *
 * A fixed site is copied. The stream of a site is shared: one more reference. A point of a source becomes a stream of
 * its own, which begins with the rectangle that the engine knows and asks the same callback; the source is counted from
 * then on, and released by the last of its users. So does the stream of a point that was measured again: its answers
 * are intersected with the known rectangle. */
#include "engine/points.h"

#include "base/alloc.h"
#include "base/error.h"
#include "base/local.h"
#include "rect/rect.h"
#include <dyadel/compose.h>

/* One point of a shared source, or (shared = NULL) of a stream. begins: `known` is the rectangle to begin with, not
 * handed on yet; measured: answers are intersected with it. */
typedef struct taken {
  dyd_shared_source *shared;
  dyd_stream *stream;
  size_t point;
  bool begins, measured;
  dyd_rect known;
} taken;

static void taken_release(void *user) {
  taken *t = user;
  dyd_shared_source_free(t->shared);
  dyd_stream_free(t->stream);
  dyd_rect_clear(&t->known);
  free(t);
}

static dyd_status taken_ask(dyd_rect *out, const taken *t, const dyd_request *request, dyd_error *err) {
  dyd_request own = *request;
  own.point = t->point;
  if (t->shared) return t->shared->source.narrow(out, t->shared->source.user, &own, err);
  dyd_status st = dyd_stream_narrow(t->stream, request->bits, request->max_bits, err);
  if (dyd_failed(st)) return st;
  dyd_rect_set(out, dyd_stream_rect(t->stream));
  return dyd_stream_is_final(t->stream) ? DYD_FIXED : DYD_OK;
}

/* Cuts *out, an answer, to the known rectangle. */
static dyd_status taken_keep(dyd_rect *out, const taken *t) {
  if (t->begins && !t->measured && !dyd_rect_contains(&t->known, out)) return DYD_E_NESTING;
  if (!t->measured) return DYD_OK;
  dyd_status st = dyd_interval_intersect(&out->x, &out->x, &t->known.x);
  if (st == DYD_OK) st = dyd_interval_intersect(&out->y, &out->y, &t->known.y);
  return st == DYD_E_ARG ? DYD_E_CONTRADICTION : st;
}

static dyd_status taken_narrow(dyd_rect *out, void *user, const dyd_request *request, dyd_error *err) {
  taken *t = user;
  if (t->begins) dyd_rect_set(out, &t->known);
  bool enough = t->begins && dyd_rect_bits(&t->known) >= request->bits;
  dyd_status st = enough ? DYD_OK : taken_ask(out, t, request, err);
  if (st == DYD_OK || st == DYD_FIXED) {
    dyd_status kept = taken_keep(out, t);
    if (kept != DYD_OK) return kept;
    t->begins = false;
  }
  return st;
}

static dyd_status source_share(dyd_source_use *use) {
  if (use->shared) return DYD_OK;
  use->shared = dyd_alloc(1, sizeof *use->shared);
  if (!use->shared) return DYD_E_NOMEM;
  *use->shared = (dyd_shared_source){1, use->source};
  return DYD_OK;
}

static dyd_status taken_new(dyd_stream **out, dyd_engine *e, const dyd_refinable *p) {
  dyd_source_use *use = p->stream ? NULL : &e->source[p->source];
  dyd_status st = use ? source_share(use) : DYD_OK;
  taken *t = st != DYD_OK ? NULL : dyd_alloc(1, sizeof *t);
  if (!t) return DYD_E_NOMEM;
  *t = (taken){.begins = p->asked || p->measured, .measured = p->measured};
  if (use) {
    t->shared = use->shared;
    t->point = p->site - use->first;
    use->shared->refs++;
  } else {
    t->stream = dyd_stream_ref(p->stream);
  }
  dyd_rect_init(&t->known);
  if (t->begins) st = dyd_sites_get(&t->known, e->sites, p->site);
  if (st != DYD_OK) {
    taken_release(t);
    return st;
  }
  const dyd_source source = {DYD_SIZED(dyd_source), .narrow = taken_narrow, .release = taken_release, .user = t};
  return dyd_stream_new(out, &source, p->site, NULL);
}

static dyd_status fixed_copy(dyd_stream **out, const dyd_engine *e, uint32_t i) {
  DYD_LOCAL(dyd_rect, r);
  dyd_status st = dyd_sites_get(&r, e->sites, i);
  return st == DYD_OK ? dyd_stream_from_rect(out, &r) : st;
}

dyd_status dyd_engine_stream(dyd_stream **out, dyd_engine *e, uint32_t i) {
  if (!e) return DYD_E_ARG;
  if (i >= dyd_sites_count(e->sites)) return DYD_E_ARG;
  const dyd_refinable *p = dyd_engine_find(e, i);
  if (!p || p->final) return fixed_copy(out, e, i);
  if (!p->stream || p->measured) return taken_new(out, e, p);
  *out = dyd_stream_ref(p->stream);
  return DYD_OK;
}
