/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The unbounded face cut into parts at sure corners of the hull. */
#include "checker/parts.h"
#include "base/alloc.h"
#include "base/index.h"
#include "checker/by_key.h"

#include <string.h>

size_t dyd_cert_distinct(uint32_t *item, size_t count) {
  size_t kept = 0;
  if (count) qsort(item, count, sizeof *item, dyd_compare_index);
  for (size_t q = 0; q < count; q++)
    if (kept == 0 || item[kept - 1] != item[q]) item[kept++] = item[q];
  return kept;
}

/* What is borrowed while parts are made; at: half-edge -> its position in the walk, DYD_CERT_NONE: not there. */
typedef struct maker {
  const dyd_cert_graph *g;
  const uint32_t *walk;
  size_t count, first;
  const bool *corner;
  uint32_t *parent, *at, *number;
  dyd_cert_entry *entry;
} maker;

static uint32_t site_on_walk(const maker *m, size_t q) {
  return dyd_cert_origin(m->g, m->walk[q % m->count]);
}

/* group[q] = the number of the part that begins at the last corner at or before q; then parts with a bridge in common
 * are united, and groups are numbered. */
static void number_groups(dyd_cert_parts *p, maker *m) {
  uint32_t part = 0;
  for (m->first = 0; m->first < m->count && !m->corner[site_on_walk(m, m->first)];) m->first++;
  for (size_t k = 0; k < m->count; k++) {
    size_t q = (m->first + k) % m->count;
    if (k && m->corner[site_on_walk(m, q)]) part++;
    p->group[q] = part;
    m->parent[part] = part;
    m->at[m->walk[q]] = (uint32_t)q;
  }
  for (size_t q = 0; q < m->count; q++) {
    uint32_t h = m->walk[q], twin = m->at[h ^ 1];
    if (h / 2 >= m->g->legal->count && twin != DYD_CERT_NONE) {
      uint32_t a = dyd_cert_root(m->parent, p->group[q]), b = dyd_cert_root(m->parent, p->group[twin]);
      m->parent[a < b ? b : a] = a < b ? a : b;
    }
  }
  for (uint32_t k = 0; k <= part; k++) {
    uint32_t root = dyd_cert_root(m->parent, k); /* the least of its group, numbered before */
    m->number[k] = root == k ? (uint32_t)p->groups++ : m->number[root];
  }
  for (size_t q = 0; q < m->count; q++) p->group[q] = m->number[p->group[q]];
}

/* Sorts each group's sites, and drops repeats. */
static void keep_distinct(dyd_cert_parts *p) {
  size_t kept = 0;
  for (size_t r = 0; r < p->groups; r++) {
    size_t from = p->start[r], count = p->start[r + 1] - from;
    memmove(p->site + kept, p->site + from, count * sizeof *p->site);
    p->start[r] = kept;
    kept += dyd_cert_distinct(p->site + kept, count);
  }
  p->start[p->groups] = kept;
}

/* A position's site is a site of its group; a corner also of the group before. */
static void gather_group_sites(dyd_cert_parts *p, const maker *m) {
  size_t entries = 0;
  for (size_t q = 0; q < m->count; q++) {
    uint32_t next = site_on_walk(m, q + 1);
    m->entry[entries++] = (dyd_cert_entry){p->group[q], site_on_walk(m, q)};
    if (m->corner[next]) m->entry[entries++] = (dyd_cert_entry){p->group[q], next};
  }
  dyd_cert_by_key(p->start, p->site, p->groups, m->entry, entries);
  keep_distinct(p);
}

dyd_status dyd_cert_parts_init(dyd_cert_parts *p, const dyd_cert_graph *g, const uint32_t *walk, size_t count,
                               const bool *corner) {
  maker m = {.g = g, .walk = walk, .count = count, .corner = corner};
  *p = (dyd_cert_parts){0};
  p->group = dyd_alloc(count, sizeof *p->group);
  p->site = dyd_alloc(2 * count, sizeof *p->site);
  p->start = dyd_alloc(count + 1, sizeof *p->start);
  m.parent = dyd_alloc(count, sizeof *m.parent);
  m.number = dyd_alloc(count, sizeof *m.number);
  m.at = dyd_alloc(2 * g->count, sizeof *m.at);
  m.entry = dyd_alloc(2 * count, sizeof *m.entry);
  bool good = p->group && p->site && p->start && m.parent && m.number && m.at && m.entry;
  if (good) {
    for (size_t h = 0; h < 2 * g->count; h++) m.at[h] = DYD_CERT_NONE;
    number_groups(p, &m);
    gather_group_sites(p, &m);
  } else {
    dyd_cert_parts_clear(p);
  }
  free(m.parent);
  free(m.number);
  free(m.at);
  free(m.entry);
  return good ? DYD_OK : DYD_E_NOMEM;
}

void dyd_cert_parts_clear(dyd_cert_parts *p) {
  free(p->group);
  free(p->site);
  free(p->start);
  *p = (dyd_cert_parts){0};
}
