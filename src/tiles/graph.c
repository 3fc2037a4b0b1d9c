/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The triangulation of a view: who is a partner of whom, which rows follow. */
#include "state.h"

#include <stdlib.h>
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

static dyd_status run_engine(tile *t, const tiles_view *v, dyd_error *err) {
  dyd_engine_options o;
  dyd_outcome outcome = DYD_OUTCOME_NONE;
  dyd_engine_options_init(&o);
  o.max_pairs = t->job->max_pairs;
  dyd_status st = dyd_engine_new(&t->engine);
  if (st == DYD_OK) st = append_sites(t->engine, v->first, err);
  if (st == DYD_OK) st = append_sites(t->engine, v->second, err);
  if (st == DYD_OK) st = dyd_engine_run(&outcome, t->engine, &o, err);
  t->counters.capped |= outcome == DYD_OUTCOME_BUDGET;
  return st;
}

void tile_end_engine(tile *t) {
  dyd_engine_free(t->engine);
  t->engine = NULL;
}

dyd_status tile_triangulate(tile *t, const tiles_view *v, dyd_error *err) {
  struct timespec from, to;
  tile_end_engine(t);
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &from);
  dyd_status st = run_engine(t, v, err);
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &to);
  t->counters.seconds += difftime(to.tv_sec, from.tv_sec) + 1e-9 * (double)(to.tv_nsec - from.tv_nsec);
  if (st == DYD_E_NOMEM) return tiles_no_memory(err);
  return st;
}

/* ---- partners ---- */

void tiles_graph_clear(tiles_graph *g) {
  free(g->start);
  free(g->partner);
  *g = (tiles_graph){0};
}

/* Each row of the list is entered at both its ends; start[i + 1] is where the next partner of i goes, and in the end
 * where those of i + 1 begin. */
static void graph_fill(tiles_graph *g, const dyd_pair_list *l) {
  for (size_t k = 0; k < l->count; k++) {
    g->start[l->item[k].i + 2]++;
    g->start[l->item[k].j + 2]++;
  }
  for (size_t k = 2; k < g->count + 2; k++) g->start[k] += g->start[k - 1];
  for (size_t k = 0; k < l->count; k++) {
    const dyd_pair *p = &l->item[k];
    g->partner[g->start[p->i + 1]++] = p->j | (uint32_t)p->status << 30;
    g->partner[g->start[p->j + 1]++] = p->i | (uint32_t)p->status << 30;
  }
}

dyd_status tile_list_partners(tile *t, bool last, dyd_error *err) {
  tiles_graph *g = &t->graph;
  dyd_pair_list l = {0};
  tiles_graph_clear(g);
  g->count = dyd_engine_count(t->engine);
  dyd_status st = dyd_delaunay_pairs(&l, dyd_engine_delaunay(t->engine));
  if (st != DYD_OK) return tiles_no_memory(err);
  if (last) tile_end_engine(t);
  g->start = calloc(g->count + 2, sizeof *g->start);
  g->partner = malloc((2 * l.count + 1) * sizeof *g->partner);
  if (g->start && g->partner)
    graph_fill(g, &l);
  else
    st = tiles_no_memory(err);
  dyd_pair_list_clear(&l);
  return st;
}

/* ---- rows ---- */

static int compare_tile_rows(const void *a, const void *b) {
  const tiles_row *p = a, *q = b;
  if (p->i != q->i) return p->i < q->i ? -1 : 1;
  return (p->j > q->j) - (p->j < q->j);
}

dyd_status tile_rows_of(tiles_rows *rows, const tile *t, const tiles_view *v, uint32_t i, dyd_error *err) {
  tiles_partners p = tiles_graph_of(&t->graph, i);
  const uint64_t own = tiles_view_number(v, i);
  const size_t from = rows->count;
  if (!tiles_reserve((void **)&rows->item, &rows->room, from + p.count, sizeof *rows->item))
    return tiles_no_memory(err);
  for (size_t k = 0; k < p.count; k++) {
    uint64_t number = tiles_view_number(v, TILES_SITE(p.item[k]));
    if (number > own) rows->item[rows->count++] = (tiles_row){own, number, TILES_STATUS(p.item[k])};
  }
  if (rows->count > from + 1) qsort(rows->item + from, rows->count - from, sizeof *rows->item, compare_tile_rows);
  return DYD_OK;
}
