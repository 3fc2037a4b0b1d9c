/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What every stage of a run knew, as what changed from stage to stage. */
#ifndef DYD_ENGINE_HISTORY_H
#define DYD_ENGINE_HISTORY_H

#include <dyadel/converge.h>

typedef struct dyd_history_box {
  uint32_t site;
  double box[4]; /* as dyd_sites_get_d */
} dyd_history_box;

/* Invariant: change[] of a stage are sorted by i, then j, and tell of pairs whose status (dyd_pair_status) is another
 * one than after the stage before; before the first one all are illegal. box[] likewise, ascending; the first stage has
 * all sites that stand for themselves. The end of a stage is where the next one begins, of the last one the count. */
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

#endif
