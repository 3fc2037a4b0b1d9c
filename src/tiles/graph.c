/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The triangulation of a view: who is a partner of whom, which rows follow. */
#include "state.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

/* ---- triangulating ---- */

static dyd_status append_tile_boxes(dyd_engine *e, const tiles_sites *s, dyd_error *err) {
  enum { AT_ONCE = 1024 };
  double end[4][AT_ONCE];
  dyd_status st = DYD_OK;
  for (size_t k = 0; k < s->count && st == DYD_OK;) {
    size_t n = 0;
    for (; n < AT_ONCE && k < s->count; n++, k++) {
      tiles_box b = tiles_sites_box(s, k);
      end[0][n] = b.x0;
      end[1][n] = b.x1;
      end[2][n] = b.y0;
      end[3][n] = b.y1;
    }
    st = dyd_engine_append_boxes(e, n, end[0], end[1], end[2], end[3], err);
  }
  return st;
}

static dyd_status append_sites(dyd_engine *e, const tiles_sites *s, dyd_error *err) {
  if (s->count == 0) return DYD_OK;
  if (s->dim == 4) return append_tile_boxes(e, s, err);
  const dyd_column xy[2] = {{s->end, 2 * sizeof *s->end}, {s->end + 1, 2 * sizeof *s->end}};
  return dyd_engine_append_columns(e, s->count, xy, NULL, err);
}

static double cpu_seconds(void) {
  struct timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return difftime(t.tv_sec, 0) + 1e-9 * (double)t.tv_nsec;
}

dyd_status tile_load(tiles_view *v, tile *t, const tiles_sites *first, const tiles_sites *second, dyd_error *err) {
  tile_end_engine(t);
  const double from = cpu_seconds();
  dyd_status st = dyd_engine_new(&t->engine);
  if (st == DYD_OK) st = append_sites(t->engine, first, err);
  if (st == DYD_OK) st = append_sites(t->engine, second, err);
  t->counters.seconds += cpu_seconds() - from;
  if (st == DYD_E_NOMEM) return tiles_no_memory(err);
  if (st == DYD_OK) *v = (tiles_view){first, second, dyd_engine_sites(t->engine)};
  return st;
}

void tile_end_engine(tile *t) {
  tiles_graph_clear(&t->graph);
  dyd_engine_free(t->engine);
  t->engine = NULL;
}

dyd_status tile_triangulate(tile *t, dyd_error *err) {
  dyd_engine_options o;
  dyd_outcome outcome = DYD_OUTCOME_NONE;
  const double from = cpu_seconds();
  dyd_engine_options_init(&o);
  o.max_pairs = t->job->max_pairs;
  dyd_status st = dyd_engine_run(&outcome, t->engine, &o, err);
  t->counters.capped |= outcome == DYD_OUTCOME_BUDGET;
  t->counters.seconds += cpu_seconds() - from;
  return st == DYD_E_NOMEM ? tiles_no_memory(err) : st;
}

/* ---- partners ---- */

void tiles_graph_clear(tiles_graph *g) {
  free(g->start);
  free(g->partner);
  *g = (tiles_graph){0};
}

static void count_at(tiles_graph *g, uint32_t i) {
  if (i - g->first < g->count) g->start[i - g->first + 2]++;
}

static void count_partners(void *user, uint32_t i, uint32_t j, dyd_pair_status status) {
  (void)status;
  count_at(user, i);
  count_at(user, j);
}

static void place_at(tiles_graph *g, uint32_t i, uint32_t partner) {
  if (i - g->first < g->count) g->partner[g->start[i - g->first + 1]++] = partner;
}

static void place_partners(void *user, uint32_t i, uint32_t j, dyd_pair_status status) {
  place_at(user, i, j | (uint32_t)status << 30);
  place_at(user, j, i | (uint32_t)status << 30);
}

/* Partners of all at once would take a third of the memory of the triangulation. start[k + 1] is where the next partner
 * of site k goes, and in the end where those of k + 1 begin. */
static bool list_partners(tiles_graph *g, const dyd_delaunay *pd, uint32_t first, uint32_t sites) {
  enum { PARTS = 8, LEAST = 4096 };
  const uint32_t most = sites / PARTS < LEAST ? LEAST : sites / PARTS, left = sites - first;
  g->first = first;
  g->count = left < most ? left : most;
  if (!tiles_reserve((void **)&g->start, &g->room_start, g->count + 2, sizeof *g->start)) return false;
  memset(g->start, 0, (g->count + 2) * sizeof *g->start);
  dyd_delaunay_each_pair(pd, count_partners, g);
  for (size_t k = 2; k < g->count + 2; k++) g->start[k] += g->start[k - 1];
  if (!tiles_reserve((void **)&g->partner, &g->room_partner, g->start[g->count + 1] + 1, sizeof *g->partner))
    return false;
  dyd_delaunay_each_pair(pd, place_partners, g);
  return true;
}

dyd_status tile_partners(tiles_partners *p, tile *t, uint32_t i, dyd_error *err) {
  tiles_graph *g = &t->graph;
  if (i - g->first >= g->count &&
      !list_partners(g, dyd_engine_delaunay(t->engine), i, (uint32_t)dyd_engine_count(t->engine)))
    return tiles_no_memory(err);
  const size_t *start = g->start + (i - g->first);
  *p = (tiles_partners){g->partner + start[0], start[1] - start[0]};
  return DYD_OK;
}

/* ---- rows ---- */

static int compare_tile_rows(const void *a, const void *b) {
  const tiles_row *p = a, *q = b;
  if (p->i != q->i) return p->i < q->i ? -1 : 1;
  return (p->j > q->j) - (p->j < q->j);
}

dyd_status tile_rows_of(tiles_rows *rows, tile *t, const tiles_view *v, uint32_t i, dyd_error *err) {
  tiles_partners p;
  const uint64_t own = tiles_view_number(v, i);
  const size_t from = rows->count;
  dyd_status st = tile_partners(&p, t, i, err);
  if (st != DYD_OK) return st;
  if (!tiles_reserve((void **)&rows->item, &rows->room, from + p.count, sizeof *rows->item))
    return tiles_no_memory(err);
  for (size_t k = 0; k < p.count; k++) {
    uint64_t number = tiles_view_number(v, TILES_SITE(p.item[k]));
    if (number > own) rows->item[rows->count++] = (tiles_row){own, number, TILES_STATUS(p.item[k])};
  }
  if (rows->count > from + 1) qsort(rows->item + from, rows->count - from, sizeof *rows->item, compare_tile_rows);
  return DYD_OK;
}
