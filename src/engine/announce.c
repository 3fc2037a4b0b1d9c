/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Telling sources what they will be asked, so that slow answers can be sought side by side. */
#include "engine/plan.h"

#include "base/alloc.h"
#include "engine/points.h"
#include "engine/recall.h"

/* Will p be asked for `bits`, or is it that narrow already, or its answer known? */
static bool announce_is_due(dyd_rect *scratch, const dyd_refinable *p, const dyd_engine *e, int64_t bits) {
  if (dyd_recall_next(e->recall, p->site, bits)) return false;
  if (!p->asked) return true;
  return dyd_sites_get(scratch, e->sites, p->site) != DYD_OK || dyd_rect_bits(scratch) < bits;
}

/* Wants first .. end-1 are those of one source: tells it of them; *left is how many calls there may be. What cannot be
 * told, for lack of memory or because the request is refused, is left out. */
static void announce_source(uint64_t *left, const dyd_plan *plan, size_t first, size_t end) {
  const dyd_engine *e = plan->e;
  const dyd_source *source = &e->source[dyd_plan_point(plan, &plan->item[first])->source].source;
  dyd_request *list = dyd_alloc(end - first, sizeof *list);
  dyd_rect scratch;
  size_t count = 0;
  dyd_rect_init(&scratch);
  for (size_t k = first; list && *left && k < end; k++) {
    const dyd_want *w = &plan->item[k];
    const dyd_refinable *p = dyd_plan_point(plan, w);
    if (!announce_is_due(&scratch, p, e, w->bits)) continue;
    --*left;
    if (dyd_engine_request(&list[count], p, e, w->bits, plan->o->max_bits, NULL) == DYD_OK) count++;
  }
  dyd_rect_clear(&scratch);
  if (count) source->announce(source->user, list, count);
  free(list);
}

void dyd_plan_announce(const dyd_plan *plan, uint64_t most) {
  for (size_t k = 0, end; k < plan->count; k = end) {
    const dyd_refinable *p = dyd_plan_point(plan, &plan->item[k]);
    for (end = k + 1; end < plan->count && !p->stream; end++) {
      const dyd_refinable *next = dyd_plan_point(plan, &plan->item[end]);
      if (next->stream || next->source != p->source) break;
    }
    if (!p->stream && plan->e->source[p->source].source.announce) announce_source(&most, plan, k, end);
  }
}
