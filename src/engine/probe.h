/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Probes: a few points of a crowded face go ahead, to learn how far the others must go. */
#ifndef DYD_ENGINE_PROBE_H
#define DYD_ENGINE_PROBE_H

#include "engine/wants.h"

#define DYD_PROBE_QUADS 4

/* Pairs (v[0], v[1]) and (v[2], v[3]) for which the quad rule could not prove that one cannot displace the other. */
typedef struct dyd_quad_sites {
  uint32_t v[4];
} dyd_quad_sites;

/* The probes of one face. over: no quad can be taken further; bits > 0: a quad is decided, and about that many bits of
 * its points were needed for it.
 * Invariant: quads >= 2, no site twice. */
typedef struct dyd_probe {
  dyd_quad_sites quad[DYD_PROBE_QUADS];
  size_t quads;
  int64_t bits;
  bool over;
} dyd_probe;

/* Init with {0}. Invariant: of = NULL or of[k] is 1 + the number of the last probe added whose face has point k as an
 * end that is to be narrowed, 0 when there is none. */
typedef struct dyd_probes {
  dyd_probe *item;
  size_t count, cap;
  uint32_t *of;
} dyd_probes;

void dyd_probes_clear(dyd_probes *s);
/* Looks for quads among the indeterminate pairs of a face with ends that are wanted; adds a probe when there are two or
 * more. */
dyd_status dyd_probes_add(dyd_probes *s, const dyd_wants *wants, const dyd_pair_list *pairs);
/* Judges the quads of all probes; *out, empty, becomes the probes of probes that continue, which are narrowed further,
 * while all else in `held` waits. Nothing in *out: all probes are over. */
dyd_status dyd_probes_next(dyd_wants *out, dyd_probes *s, dyd_wants *held);
/* *out, empty, becomes the wants that have waited, with more bits for the ends of decided probes. */
void dyd_probes_finish(dyd_wants *out, const dyd_probes *s, const dyd_wants *held);

#endif
