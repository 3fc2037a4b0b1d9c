/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* A triangulation whose sites become narrower, or wider again, one at a time. Faces are not kept: a step visits only
 * the surroundings of the site, however large its face is. */
#ifndef DYD_DELAUNAY_STEPS_H
#define DYD_DELAUNAY_STEPS_H

#include "delaunay/state.h"
#include "skeleton/work.h"

/* pair: those open at the beginning, vertices i < j; open[k]: still. Those of vertex v are at[start[v]] to
 * at[start[v + 1] - 1]. ended: pairs that the last step has decided. part: the triangles that the
 * last widening reached, lost: edges that it made uncertain. mark: of vertices; seen: of triangles. */
typedef struct dyd_steps {
  dyd_delaunay *pd;
  dyd_run run;
  dyd_work w;
  dyd_vertex_pair *pair;
  size_t pairs, *start;
  uint32_t *at;
  bool *open, *nearest;
  uint8_t *mark, *seen;
  dyd_index_list near, doubt, ended, part, lost;
  size_t near_cap, doubt_cap, ended_cap, part_cap, lost_cap;
} dyd_steps;

/* Returns true if there are triangles, and all open pairs are stored. */
bool dyd_steps_can(const dyd_delaunay *pd);
/* Bytes of a start, the list of all pairs included. */
uint64_t dyd_steps_bytes(const dyd_delaunay *pd);
/* Borrows pd, whose faces and pairs hold no longer; init with {0}, and clear, whatever it returns. */
dyd_status dyd_steps_begin(dyd_steps *s, dyd_delaunay *pd, const volatile int *cancel);
void dyd_steps_clear(dyd_steps *s);
/* The site was narrowed in the table, and *holds its representative; else *holds is false, and all has to be made anew.
 * Its decisions are those of dyd_delaunay_update [LOC-4]. */
dyd_status dyd_steps_narrow(bool *holds, dyd_steps *s, uint32_t site);
/* The site has become wider in the table: decides edges again outward from it until certain ones surround it.
 * stop(user, i, j), asked about each pair of sites that is legal no longer, says whether that is enough. *holds: it was
 * not, and s->part is not large. Edges outside with an end at a corner of it may have lost their witnesses even so
 * [LOC-7]: who relies on them makes all anew. dyd_steps_back takes it back, once the table has the old rectangle. */
dyd_status dyd_steps_widen(bool *holds, dyd_steps *s, uint32_t site, bool (*stop)(void *user, uint32_t i, uint32_t j),
                           void *user);
void dyd_steps_back(dyd_steps *s, uint32_t site);
/* Are all edges of s->part certain? The sites at its corners, ascending. */
bool dyd_steps_part_is_sure(const dyd_steps *s);
dyd_status dyd_steps_part_sites(dyd_index_list *out, const dyd_steps *s);
/* Sets large[i] for the sites i of undecided faces of more than `most` sites. */
dyd_status dyd_steps_large(bool *large, const dyd_steps *s, size_t most);

#endif
