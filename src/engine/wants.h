/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Wants: which points to narrow, and how far. A value: making it changes neither engine nor points. And how coarse
 * the sites of a face are. */
#ifndef DYD_ENGINE_WANTS_H
#define DYD_ENGINE_WANTS_H

#include "engine/state.h"

/* One point and the precision it is to be brought to; why, and the pair that this names. */
typedef struct dyd_want {
  uint32_t point; /* guests of the question come first, then e->point */
  int64_t bits;
  dyd_reason reason;
  uint32_t i, j;
  bool sent; /* this was asked, as a probe, before the rest (probe.c) */
} dyd_want;

/* Invariant: slot[k] is 1 + the place in item of point k, 0 where there is none; bits are more than the point was asked
 * for, and at most o->max_bits. Once `failed` says DYD_E_NOMEM, or DYD_E_ARG for a site `missing`, nothing counts. */
struct dyd_wants {
  const dyd_engine *e;
  const dyd_engine_options *o; /* defaults filled in */
  const dyd_refinable *guest;  /* of the question */
  size_t guests;
  dyd_want *item;
  size_t count, cap;
  uint32_t *slot;
  bool blocked; /* some point would have been in it, but was asked for max_bits before */
  bool again;   /* the question comes again before the triangulation is brought up to date */
  dyd_status failed;
  uint32_t missing;
};

/* Borrows e, o and the guests. Without memory `failed` says so. */
void dyd_wants_init(dyd_wants *p, const dyd_engine *e, const dyd_engine_options *o, const dyd_refinable *guest,
                    size_t guests);
void dyd_wants_clear(dyd_wants *p);
/* Empties the list and frees its contents. */
void dyd_wants_empty(dyd_wants *p);
/* Puts the wants in the order of points; dyd_wants_find may not be used after it. */
void dyd_wants_sort(dyd_wants *p);

const dyd_refinable *dyd_wants_point(const dyd_wants *p, const dyd_want *w);
/* Returns true if the point (NULL: a fixed site) can still be asked, now or under a larger max_bits. The list remembers
 * the second. */
bool dyd_wants_can_narrow(dyd_wants *p, const dyd_refinable *point);
/* Adds a want; of several for one point the one that asks for most is kept, the first among equals. bits are cut to
 * max_bits. */
void dyd_wants_mark(dyd_wants *p, const dyd_refinable *point, int64_t bits, dyd_reason reason, uint32_t i, uint32_t j);
/* The same for a reason that names no pair. */
void dyd_wants_mark_alone(dyd_wants *p, const dyd_refinable *point, int64_t bits, dyd_reason reason);
/* Returns the want of a point, NULL if it has none. Borrowed until the list changes. */
dyd_want *dyd_wants_find(const dyd_wants *p, const dyd_refinable *point);
/* The points never asked, for the first stage. */
void dyd_wants_first(dyd_wants *p);
/* Tells the sources that want to know which of their points sorted wants have, in the order in which
 * narrowing will come to them; `most` points of such sources at most. */
void dyd_wants_announce(const dyd_wants *p, uint64_t most);

/* b + by without overflow, by >= 0; at most max where b is. */
int64_t dyd_bits_raised(int64_t b, int64_t by, int64_t max);
/* The step from precision b to the next. */
int64_t dyd_bits_grown(int64_t b, const dyd_engine_options *o);
/* First precision requested of guests, and of points never asked. */
int64_t dyd_bits_first(const dyd_engine_options *o);

/* Returns true if a policy chooses the points to narrow. */
static inline bool dyd_has_policy(const dyd_engine_options *o) {
  return o->policy || o->policy_program;
}

/* A program that is asked. */
typedef struct dyd_policy dyd_policy;

/* ---- How coarse the sites of a face are, compared with the distances to their neighbours. ---- */

/* A site of the face. width: 2^(width-1) <= longer side < 2^width; scale: the least, over the neighbours examined, of
 * the same exponent of the largest of gap and widths of both. INT64_MIN means zero, INT64_MAX no neighbour. */
typedef struct dyd_site_precision {
  dyd_rect rect;
  int64_t width, scale;
} dyd_site_precision;

/* Init with {0}. Invariant: item[k] belongs to sites.item[k]; sites ascend. */
typedef struct dyd_face_precision {
  dyd_index_list sites;
  dyd_site_precision *item;
} dyd_face_precision;

/* Examines face f: the pairs given, and sites next to one another in x. O((sites + pairs) log sites). */
dyd_status dyd_face_precision_set(dyd_face_precision *out, const dyd_delaunay *pd, size_t f,
                                  const dyd_pair_list *pairs);
void dyd_face_precision_clear(dyd_face_precision *c);
/* The bits to which the site is known relative to its distances: 0 where it meets a neighbour no wider than itself.
 * INT64_MAX for points, and where the distance is unknown. */
int64_t dyd_face_precision_bits(const dyd_face_precision *c, uint32_t site);

#endif
