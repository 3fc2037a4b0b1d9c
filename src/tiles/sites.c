/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Tables of sites, mail, and the triangulation of sites: partners and rows. */
#include "tiles/tiles.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

/* ---- mail and tables of sites ---- */

dyd_status tiles_no_memory(dyd_error *err) {
  return dyd_fail(err, DYD_E_NOMEM, "memory is exhausted; use more ranks on more machines");
}

bool tiles_mail_put(tiles_mail *m, const void *bytes, size_t count) {
  if (count == 0) return true;
  if (!dyd_reserve((void **)&m->bytes, &m->cap, m->count + count, 1)) return false;
  memcpy(m->bytes + m->count, bytes, count);
  m->count += count;
  return true;
}

bool tiles_mail_take(void *out, size_t count, const tiles_mail *m, size_t *read) {
  if (m->count - *read < count) return false;
  memcpy(out, m->bytes + *read, count);
  *read += count;
  return true;
}

void tiles_mail_clear(tiles_mail *m) {
  free(m->bytes);
  *m = (tiles_mail){0};
}

bool tiles_sites_reserve(tiles_sites *s, size_t count) {
  return DYD_GROW(s->number, s->cap_number, count) && DYD_GROW(s->end, s->cap_end, count * s->dim);
}

bool tiles_sites_add(tiles_sites *s, uint64_t number, const double *end) {
  if (!tiles_sites_reserve(s, s->count + 1)) return false;
  s->number[s->count] = number;
  memcpy(s->end + s->count * s->dim, end, s->dim * sizeof *end);
  s->count++;
  return true;
}

tiles_box tiles_sites_box(const tiles_sites *s, size_t k) {
  const double *e = s->end + k * s->dim;
  return s->dim == 2 ? (tiles_box){e[0], e[0], e[1], e[1]} : (tiles_box){e[0], e[1], e[2], e[3]};
}

bool tiles_sites_put(tiles_mail *m, const tiles_sites *s, size_t k) {
  return tiles_mail_put(m, &s->number[k], sizeof *s->number) &&
         tiles_mail_put(m, s->end + k * s->dim, s->dim * sizeof *s->end);
}

bool tiles_sites_take(tiles_sites *s, const tiles_mail *m, size_t *read) {
  uint64_t number;
  double end[4];
  while (*read < m->count) {
    if (!tiles_mail_take(&number, sizeof number, m, read) || !tiles_mail_take(end, s->dim * sizeof *end, m, read) ||
        !tiles_sites_add(s, number, end))
      return false;
  }
  return true;
}

void tiles_sites_clear(tiles_sites *s) {
  dyd_free_all(s->number, s->end);
  *s = (tiles_sites){.dim = s->dim};
}

void tiles_sites_end(tiles_sites *s) {
  free(s->end);
  s->end = NULL;
  s->cap_end = 0;
}

tiles_box tiles_view_box(const tiles_view *v, size_t k) {
  double end[4];
  dyd_sites_get_d(end, v->place, k);
  return (tiles_box){end[0], end[1], end[2], end[3]};
}

uint64_t tiles_view_number(const tiles_view *v, size_t k) {
  return k < v->first->count ? v->first->number[k] : v->second->number[k - v->first->count];
}

bool tiles_sites_copy(tiles_sites *s, const tiles_view *v, size_t k) {
  tiles_box b = tiles_view_box(v, k);
  const double end[4] = {b.x0, s->dim == 2 ? b.y0 : b.x1, b.y0, b.y1};
  return tiles_sites_add(s, tiles_view_number(v, k), end);
}

/* ---- sets ---- */

static size_t set_place(const tiles_set *s, uint32_t site) {
  size_t at = (site * 2654435769u) & (s->cap - 1);
  while (s->slot[at] && s->slot[at] != site + 1) at = (at + 1) & (s->cap - 1);
  return at;
}

bool tiles_set_has(const tiles_set *s, uint32_t site) {
  return s->cap && s->slot[set_place(s, site)];
}

static bool set_grow(tiles_set *s) {
  tiles_set wider = {.cap = s->cap ? 2 * s->cap : 64};
  wider.slot = calloc(wider.cap, sizeof *wider.slot);
  if (!wider.slot) return false;
  for (size_t k = 0; k < s->cap; k++)
    if (s->slot[k]) wider.slot[set_place(&wider, s->slot[k] - 1)] = s->slot[k];
  free(s->slot);
  wider.count = s->count;
  *s = wider;
  return true;
}

bool tiles_set_add(tiles_set *s, uint32_t site) {
  if (2 * (s->count + 1) > s->cap && !set_grow(s)) return false;
  size_t at = set_place(s, site);
  if (!s->slot[at]) s->count++;
  s->slot[at] = site + 1;
  return true;
}

void tiles_set_clear(tiles_set *s) {
  free(s->slot);
  *s = (tiles_set){0};
}

/* ---- the triangulation of a view ---- */

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
    st = dyd_engine_add_boxes(e, n, end[0], end[1], end[2], end[3], err);
  }
  return st;
}

static dyd_status append_sites(dyd_engine *e, const tiles_sites *s, dyd_error *err) {
  if (s->count == 0) return DYD_OK;
  if (s->dim == 4) return append_tile_boxes(e, s, err);
  const dyd_column xy[2] = {{s->end, 2 * sizeof *s->end}, {s->end + 1, 2 * sizeof *s->end}};
  return dyd_engine_add_columns(e, s->count, xy, NULL, err);
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

void tiles_graph_clear(tiles_graph *g) {
  dyd_free_all(g->start, g->partner);
  *g = (tiles_graph){0};
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
  if (!DYD_GROW(g->start, g->cap_start, g->count + 2)) return false;
  memset(g->start, 0, (g->count + 2) * sizeof *g->start);
  dyd_delaunay_each_pair(pd, count_partners, g);
  for (size_t k = 2; k < g->count + 2; k++) g->start[k] += g->start[k - 1];
  if (!DYD_GROW(g->partner, g->cap_partner, g->start[g->count + 1] + 1)) return false;
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

void tiles_rows_sort(tiles_rows *rows, size_t from) {
  if (rows->count > from + 1) qsort(rows->item + from, rows->count - from, sizeof *rows->item, compare_tile_rows);
}

dyd_status tiles_rows_add(tiles_rows *rows, tiles_row row, dyd_error *err) {
  if (!DYD_GROW(rows->item, rows->cap, rows->count + 1)) return tiles_no_memory(err);
  rows->item[rows->count++] = row;
  return DYD_OK;
}

dyd_status tile_rows_of(tiles_rows *rows, tile *t, const tiles_view *v, uint32_t i, dyd_error *err) {
  tiles_partners p = {0};
  const uint64_t own = tiles_view_number(v, i);
  const size_t from = rows->count;
  dyd_status st = tile_partners(&p, t, i, err);
  for (size_t k = 0; st == DYD_OK && k < p.count; k++) {
    uint64_t number = tiles_view_number(v, TILES_SITE(p.item[k]));
    if (number > own) st = tiles_rows_add(rows, (tiles_row){own, number, TILES_STATUS(p.item[k])}, err);
  }
  tiles_rows_sort(rows, from);
  return st;
}

bool tile_has_wide(const tile *t) {
  uint64_t wide = 0;
  for (size_t r = 0; r < t->job->ranks; r++) wide += t->info[r].wide;
  return wide > 0;
}
