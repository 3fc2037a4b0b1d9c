/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What points answered in an earlier run, given again instead of asking them; statuses of the stages of a run. */
#ifndef DYD_ENGINE_RECORD_H
#define DYD_ENGINE_RECORD_H

#include "engine/state.h"
#include <dyadel/converge.h>
#include <dyadel/delaunay.h>

/* What the site will answer next without being asked, or NULL: the first answer left that is for at least `bits`. */
const dyd_recalled *dyd_recall_next(dyd_recall *m, uint32_t site, int64_t bits);
/* Calls fn for each answer given, those of a site in the order given, until it returns other than DYD_OK. */
typedef dyd_status (*dyd_recalled_fn)(void *user, uint32_t site, int64_t bits, const dyd_rect *r, bool final);
dyd_status dyd_recall_each(const dyd_recall *m, dyd_recalled_fn fn, void *user);
/* The rectangle it was narrowed to; *final: no call can narrow it further. */
void dyd_recall_free(dyd_recall *m);

/* All statuses in one number, to compare two results: FNV-1a of the pairs with their statuses, as
 * dyd_stage_row has it. O(pairs log pairs). */
uint64_t dyd_digest_list(const dyd_pair_list *pairs);
dyd_status dyd_digest_pairs(uint64_t *out, const dyd_delaunay *pd);

/* A pair that is in one of two lists, or in both: with its status in the second, and in the first; illegal where it is
 * not listed. */
typedef struct dyd_pair_change {
  dyd_pair pair;
  dyd_pair_status before;
} dyd_pair_change;
/* The next pair, in order, of two sorted lists; false: there is none. at: places in them, {0, 0} at first. */
bool dyd_pairs_next(dyd_pair_change *out, size_t at[2], const dyd_pair_list *before, const dyd_pair_list *now);

typedef struct dyd_history_box {
  uint32_t site;
  double box[4]; /* as dyd_sites_get_d */
} dyd_history_box;

/* Invariant: change[] of a stage are sorted by i, then j, and list pairs whose status (dyd_pair_status) differs from
 * the stage before; before the first one all are illegal. box[] likewise, ascending; the first stage has all sites
 * except aliases. The end of a stage is where the next one begins, of the last one the count. */
struct dyd_history {
  size_t stages, changes, boxes, sites;
  size_t *change_begin, *box_begin; /* by stage */
  dyd_pair *change;
  dyd_history_box *box;
  dyd_pair_list last; /* possible pairs after the last stage */
  size_t *last_box;   /* of each site: the number of its box, DYD_HISTORY_NO_BOX: none */
  size_t stage_cap, box_stage_cap, change_cap, box_cap;
};
#define DYD_HISTORY_NO_BOX SIZE_MAX

/* The same as dyd_history_note of these pairs of the sites of pd; takes over the list, which is empty then. */
dyd_status dyd_history_add(dyd_history *h, const dyd_delaunay *pd, dyd_pair_list *pairs);
static inline size_t dyd_history_changes_end(const dyd_history *h, size_t stage) {
  return stage + 1 < h->stages ? h->change_begin[stage + 1] : h->changes;
}
static inline size_t dyd_history_boxes_end(const dyd_history *h, size_t stage) {
  return stage + 1 < h->stages ? h->box_begin[stage + 1] : h->boxes;
}

/* Appends a row about pd: everything that pd tells; discs: of the discs in its squares. stage is one more than that of
 * the row before; the caller fills in bits, calls and seconds. *row is borrowed until out is cleared. */
dyd_status dyd_convergence_add(dyd_stage_row **row, dyd_convergence *out, const dyd_delaunay *pd,
                               const dyd_converge_options *converge, bool discs, dyd_error *err);

#endif
