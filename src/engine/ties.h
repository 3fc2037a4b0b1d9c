/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Proofs about the true points of an engine. */
#ifndef DYD_ENGINE_TIES_H
#define DYD_ENGINE_TIES_H

#include "engine/state.h"
#include "stream/algebra/form.h"

/* Points that are proved to be the same place. */

/* Joins the sites of pd, a triangulation of e's sites, that are proved to be the same [TIE-4]; *any: some are, and pd
 * is to be brought up to date. Examines sites that share an undecided face and whose rectangles meet: others are
 * different, or so wide that they are narrowed first. */
dyd_status dyd_aliases_find(bool *any, dyd_engine *e, const dyd_delaunay *pd, dyd_error *err);

/* As dyd_prove_fn, for the points of the engine `user`; former requests are remembered. */
dyd_status dyd_ties_prove(bool *proved, void *user, dyd_relation relation, const uint32_t *site, size_t count,
                          dyd_error *err);
/* Returns the callbacks about e; none under no_ties. */
dyd_prover dyd_engine_prover(dyd_engine *e, const dyd_engine_options *o);
/* Returns proof number k, from 0, in the order of the proofs. Returns false if k is not below their number. *site is
 * borrowed. */
bool dyd_ties_proved(dyd_relation *relation, const uint32_t **site, size_t *count, const dyd_engine *e, size_t k);
/* The forms of a site's coordinates; DYD_NONE where they are unknown. An exact coordinate is a number, unless `given`
 * asks for the point as it was given. */
dyd_status dyd_ties_describe(dyd_form_point *out, dyd_forms *f, const dyd_engine *e, uint32_t i, bool given);
/* *tied: the sites (two at least) are proved to be equally far from `at`. Otherwise *needed is the precision at which
 * it shows that they are not, 0: not known. Nothing is remembered. */
dyd_status dyd_ties_equidistant(bool *tied, int64_t *needed, dyd_engine *e, dyd_stream *at, const dyd_index_list *sites,
                                dyd_error *err);
void dyd_ties_free(dyd_ties *t);

#endif
