/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What points take in memory, now and when they are narrower. */
#include "engine/bytes.h"

#include "delaunay/memory.h"
#include "engine/goal_voronoi.h"
#include "stream/stream.h"

/* Ends that doubles do not hold are kept by the stream, and packed in the table of sites: four numbers each. */
enum { ENDS = 8, END = 24 };

static uint64_t bytes_of_ends(int64_t bits) {
  return bits > 53 ? ENDS * ((uint64_t)bits / 8 + END) : 0;
}

uint64_t dyd_engine_point_bytes(const dyd_engine *e) {
  uint64_t bytes = dyd_sites_memory(e->sites) + e->point_cap * sizeof *e->point + e->change_cap * sizeof *e->changed;
  for (size_t k = 0; k < e->points; k++) {
    const dyd_refinable *p = &e->point[k];
    bytes += dyd_stream_bytes(p->stream) + (p->asked ? bytes_of_ends(p->bits) / 2 : 0); /* half is in the table */
  }
  return bytes;
}

void dyd_engine_allow(dyd_engine *e, uint64_t most) {
  const dyd_room room = {.most = most, .beside = most ? dyd_engine_point_bytes(e) : 0};
  if (e->pd) dyd_delaunay_allow(e->pd, dyd_room_left(&room));
}

uint64_t dyd_plan_bytes(const dyd_plan *p) {
  uint64_t stays = dyd_bytes_times(p->count, sizeof *p->item), most = 0;
  for (size_t k = 0; k < p->count; k++) {
    const dyd_refinable *point = dyd_plan_point(p, &p->item[k]);
    uint64_t work = dyd_stream_work_bytes(point->stream, p->item[k].bits);
    stays = dyd_bytes_add(stays, bytes_of_ends(p->item[k].bits) - (point->asked ? bytes_of_ends(point->bits) : 0));
    if (work > most) most = work;
  }
  return dyd_bytes_add(stays, most);
}

uint64_t dyd_goal_bytes(const dyd_engine *e, const dyd_engine_options *o) {
  if (o->goal == DYD_GOAL_DECIDED) return 0;
  uint64_t bytes = dyd_pairs_bytes(e->pd, dyd_goal_is_voronoi(o->goal) ? dyd_least_bounding(e->pd) : DYD_TIE);
  if (dyd_goal_is_voronoi(o->goal)) bytes += 2 * sizeof(double) * dyd_sites_count(e->sites);
  return bytes + (o->goal == DYD_GOAL_VORONOI_HAUSDORFF ? dyd_triangles_bytes(e->pd) : 0);
}
