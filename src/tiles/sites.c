/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Tables of sites, mail, and the triangulation of sites: partners and rows. */
#include "tiles/tiles.h"

#include <stdio.h>
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

tiles_box tiles_view_box(const tiles_view *v, size_t k) {
  double end[4];
  dyd_sites_get_d(end, v->place, k);
  return (tiles_box){end[0], end[1], end[2], end[3]};
}
