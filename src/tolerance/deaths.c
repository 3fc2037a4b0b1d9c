/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Deaths of all edges. Only Delaunay neighbours of i or j can bind [TOL-4]; where one of them is a hub, few of its
 * neighbours do, and whoever else is near enough is asked for.
 *
 * Ranges of vertices are worked on side by side, in doubles, each edge with the end whose site has the smaller number:
 * all rows of a site are made together, at their final place. Vertices are in spatial order, so neighbours are near in
 * memory. What doubles do not decide comes later, one by one. */
#include "base/alloc.h"
#include "base/parallel.h"
#include "base/prefetch.h"
#include "tolerance/state.h"

enum { AHEAD = 8 };

/* An edge, its apexes, and where its circle goes. */
typedef struct death_edge {
  uint32_t v, w, apex[2];
  size_t ring;
} death_edge;

typedef struct death_part {
  dyd_lines_d lines;
  death_edge *later;
  size_t count, cap, rings, filter;
  dyd_status status;
} death_part;

/* first[i]: the first row of site i. */
typedef struct death_pass {
  dyd_tolerance *t;
  size_t *first;
  death_part *part;
} death_pass;

static bool has_hub(const dyd_tolerance *t, uint32_t v, uint32_t w) {
  return dyd_degree(t, v) + dyd_degree(t, w) > DYD_HUB;
}

static bool wants_rings(const dyd_tolerance *t) {
  return t->options.points || t->sigma;
}

/* ---- exactly ---- */

dyd_status dyd_death_exact(dyd_tolerance *t, uint32_t v, uint32_t w) {
  uint32_t hub = t->start && has_hub(t, v, w) ? DYD_HUB : UINT32_MAX;
  dyd_status st = dyd_others_around(&t->others, t, v, w, hub);
  for (bool more = true; st == DYD_OK && more;) {
    st = dyd_lines_load(&t->lines, t->sk, v, w, t->others.vertex, t->others.count);
    if (st != DYD_OK) return st;
    dyd_lines_death(&t->summit, &t->lines);
    more = hub != UINT32_MAX;
    if (more) st = dyd_others_nearer(&more, &t->others, t, v, w, DYD_HUB);
  }
  return st;
}

static dyd_status death_by_integers(dyd_tolerance_row *row, dyd_ring_d *ring, dyd_tolerance *t, uint32_t v,
                                    uint32_t w) {
  const dyd_summit *s = &t->summit;
  dyd_status st = dyd_death_exact(t, v, w);
  t->exact++;
  if (st != DYD_OK) return st;
  *row = dyd_row_of_summit(t, v, w, DYD_EVENT_DEATH);
  if (ring) *ring = (dyd_ring_d){v, w, dyd_summit_place(s), row->lo, mpz_sgn(s->at.q) ? 0 : mpz_sgn(s->at.p)};
  return DYD_OK;
}

/* ---- in doubles ---- */

/* Of v's neighbours all but w, or those that are no apexes of the edge either. */
static bool add_ring_d(dyd_lines_d *l, const dyd_tolerance *t, uint32_t v, uint32_t w, bool apexes) {
  const uint32_t *near = t->near + t->start[v];
  uint32_t size = dyd_degree(t, v), at = 0;
  for (uint32_t k = 1; k < size; k++) at = near[k] == w ? k : at;
  return apexes ? dyd_filter_add(l, &t->points, near, size, at + 1, size - 1)
                : dyd_filter_add(l, &t->points, near, size, at + 2, size - 3);
}

/* Who may bind, each once but for corners of three edges that are no triangle: the neighbours of both ends; with a hub,
 * those of an end that is none, or the apexes alone. false: doubles cannot hold the pair well. */
static bool load_edge(dyd_lines_d *l, const dyd_tolerance *t, const death_edge *e) {
  uint32_t ghost = t->sk->mesh.n, few = dyd_degree(t, e->v) <= DYD_HUB ? e->v : e->w, many = e->v + e->w - few;
  int first = e->apex[0] == ghost;
  if (!dyd_filter_pair(l, &t->points, e->v, e->w)) return false;
  l->apex[0] = e->apex[first];
  l->apex[1] = e->apex[!first] == ghost ? DYD_NONE : e->apex[!first];
  if (!has_hub(t, e->v, e->w)) return add_ring_d(l, t, few, many, true) && add_ring_d(l, t, many, few, false);
  if (l->apex[1] == DYD_NONE) return false;
  return dyd_degree(t, few) <= DYD_HUB ? add_ring_d(l, t, few, many, true)
                                       : dyd_filter_add(l, &t->points, l->apex, 2, 0, 2);
}

/* For the tree: is there anybody whom the lines do not know? */
typedef struct stranger {
  const dyd_lines_d *lines;
  bool found;
} stranger;

static bool meet_stranger(void *context, uint32_t v) {
  stranger *s = context;
  uint32_t k = 0;
  while (k < s->lines->count && s->lines->vertex[k] != v) k++;
  s->found = k == s->lines->count && v != s->lines->i && v != s->lines->j;
  return !s->found;
}

/* An end that is a hub: lines of the other end's neighbours, and nobody else within the disc. */
static dyd_status hub_in_doubles(bool *sure, dyd_death_d *d, dyd_tolerance *t, const death_edge *e) {
  dyd_bbox c;
  double radius2;
  *sure = false;
  if (t->options.no_filter || !has_hub(t, e->v, e->w) || !load_edge(&t->small, t, e)) return DYD_OK;
  dyd_status st = dyd_near_index(t);
  if (st != DYD_OK) return st;
  if (!dyd_filter_death(d, c.e, &radius2, &t->points, &t->small) || !(radius2 < 1e300)) return DYD_OK;
  stranger s = {&t->small, false};
  dyd_tree_near(&t->tree, &c, &radius2, meet_stranger, &s);
  *sure = !s.found;
  return DYD_OK;
}

static void write_death(dyd_tolerance_row *row, dyd_ring_d *ring, const dyd_tolerance *t, const death_edge *e,
                        const dyd_death_d *d) {
  *row = dyd_row_of(t, e->v, e->w, DYD_EVENT_DEATH, d->k, d->l, d->lo, d->hi);
  if (ring) *ring = (dyd_ring_d){e->v, e->w, d->s, d->lo, d->end};
}

static dyd_ring_d *ring_of_edge(const dyd_tolerance *t, const death_edge *e) {
  return t->ring ? &t->ring[e->ring] : NULL;
}

/* false: memory is exhausted. What is left for later, or cancelled, has not been reached as yet. */
static bool death_of_edge(dyd_tolerance_row *row, death_part *p, const dyd_tolerance *t, const death_edge *e) {
  dyd_lines_d *l = &p->lines;
  dyd_death_d d;
  double radius2;
  *row = dyd_row_of(t, e->v, e->w, DYD_EVENT_DEATH, DYD_NONE, DYD_NONE, 0, DYD_UNREACHED);
  if (p->status == DYD_CANCELLED) return true;
  if (!t->options.no_filter && !has_hub(t, e->v, e->w) && load_edge(l, t, e) &&
      dyd_filter_death(&d, NULL, &radius2, &t->points, l)) {
    p->filter++;
    write_death(row, ring_of_edge(t, e), t, e, &d);
    return true;
  }
  if (!dyd_reserve((void **)&p->later, &p->cap, p->count + 1, sizeof *p->later)) return false;
  p->later[p->count++] = *e;
  return true;
}

static dyd_status death_later(dyd_tolerance *t, const death_edge *e) {
  dyd_tolerance_row *row = &t->row[dyd_row_find(t, e->v, e->w)];
  dyd_death_d d;
  bool sure;
  dyd_status st = hub_in_doubles(&sure, &d, t, e);
  if (st != DYD_OK) return st;
  if (!sure) return death_by_integers(row, ring_of_edge(t, e), t, e->v, e->w);
  t->filter++;
  write_death(row, ring_of_edge(t, e), t, e, &d);
  return DYD_OK;
}

/* ---- all ---- */

/* Is the row of v and its neighbour number q one of v's site? The ghost is no legal one, and has no site. */
static bool is_row_of(const dyd_tolerance *t, uint32_t v, uint32_t q) {
  return t->legal[q] && t->sk->reps.site[t->near[q]] > t->sk->reps.site[v];
}

static void count_rows_of_range(void *context, size_t number) {
  const death_pass *p = context;
  const dyd_tolerance *t = p->t;
  size_t end = dyd_range_begin(t->sk->n, number + 1), all = 0;
  for (uint32_t v = (uint32_t)dyd_range_begin(t->sk->n, number); v < end; v++) {
    size_t count = 0;
    for (uint32_t q = t->start[v]; q < t->start[v + 1]; q++) count += is_row_of(t, v, q);
    p->first[t->sk->reps.site[v] + 1] = count;
    all += count;
  }
  p->part[number].rings = all;
}

/* Ends and apexes of the edge from v to its neighbour number q, the end of the smaller number first, the apex on its
 * left first. */
static death_edge edge_around(const dyd_tolerance *t, uint32_t v, uint32_t q, size_t ring) {
  uint32_t begin = t->start[v], end = t->start[v + 1], w = t->near[q];
  uint32_t after = t->near[q + 1 == end ? begin : q + 1], before = t->near[(q == begin ? end : q) - 1];
  return v < w ? (death_edge){v, w, {after, before}, ring} : (death_edge){w, v, {before, after}, ring};
}

static bool deaths_at(death_part *part, dyd_tolerance_row *row, const dyd_tolerance *t, uint32_t v) {
  uint32_t q = t->start[v], end = t->start[v + 1];
  size_t count = 0;
  while (q < end) {
    uint32_t of[8], some = 0;
    for (; q < end && some < 8; q++) {
      of[some] = q;
      some += is_row_of(t, v, q);
    }
    for (uint32_t k = 0; k < some; k++) {
      death_edge e = edge_around(t, v, of[k], part->rings++);
      if (!death_of_edge(&row[count++], part, t, &e)) return false;
    }
  }
  dyd_rows_sort_site(row, count);
  return true;
}

static void deaths_of_range(void *context, size_t number) {
  const death_pass *p = context;
  const dyd_tolerance *t = p->t;
  const uint32_t *site = t->sk->reps.site;
  death_part *part = &p->part[number];
  size_t end = dyd_range_begin(t->sk->n, number + 1);
  for (uint32_t v = (uint32_t)dyd_range_begin(t->sk->n, number); v < end && part->status != DYD_E_NOMEM; v++) {
    if (v + 2 * AHEAD < end) {
      dyd_prefetch(&p->first[site[v + 2 * AHEAD]]);
      dyd_prefetch(&t->row[p->first[site[v + AHEAD]]]);
      dyd_prefetch(&t->row[p->first[site[v + AHEAD]] + 2]);
    }
    if (dyd_flag_is_set(t->options.cancel)) part->status = DYD_CANCELLED; /* from here on rows get their pairs alone */
    if (!deaths_at(part, t->row + p->first[site[v]], t, v)) part->status = DYD_E_NOMEM;
  }
}

static dyd_status deaths_on_line(dyd_tolerance *t) {
  const dyd_line *l = &t->sk->line;
  dyd_status st = DYD_OK;
  for (uint32_t q = 0; q + 1 < l->count && st == DYD_OK; q++) {
    dyd_tolerance_row row;
    if (!l->legal[q]) continue;
    if (dyd_flag_is_set(t->options.cancel)) return DYD_CANCELLED;
    st = death_by_integers(&row, t->ring ? &t->ring[t->rings] : NULL, t, l->order[q], l->order[q + 1]);
    t->rings += t->ring && t->summit.binding != DYD_BINDING_NONE;
    if (st == DYD_OK) st = dyd_row_add(t, row);
  }
  return st;
}

static dyd_status make_place(dyd_tolerance *t, size_t rows) {
  t->row = dyd_alloc(rows + 1, sizeof *t->row);
  if (wants_rings(t)) t->ring = dyd_alloc(rows + 1, sizeof *t->ring);
  t->cap = rows + 1;
  return t->row && (t->ring || !wants_rings(t)) ? DYD_OK : DYD_E_NOMEM;
}

/* Of each range: where its rows and circles begin. */
static dyd_status place_rows(death_pass *p, size_t ranges) {
  dyd_tolerance *t = p->t;
  size_t rows = 0;
  dyd_parallel(t->pd->options.threads, ranges, count_rows_of_range, p);
  for (size_t i = 0; i < t->sk->n; i++) p->first[i + 1] += p->first[i];
  for (size_t r = 0; r < ranges; r++) {
    size_t here = p->part[r].rings;
    p->part[r].rings = rows;
    rows += here;
  }
  t->rows = t->sorted = rows;
  if (wants_rings(t)) t->rings = rows;
  return make_place(t, rows);
}

static dyd_status deaths_in_mesh(death_pass *p, size_t ranges) {
  dyd_tolerance *t = p->t;
  dyd_status st = place_rows(p, ranges);
  if (st != DYD_OK) return st;
  dyd_parallel(t->pd->options.threads, ranges, deaths_of_range, p);
  for (size_t r = 0; r < ranges && st == DYD_OK; r++) {
    const death_part *part = &p->part[r];
    st = part->status;
    t->filter += part->filter;
    for (size_t k = 0; k < part->count && st == DYD_OK; k++)
      st = dyd_flag_is_set(t->options.cancel) ? DYD_CANCELLED : death_later(t, &part->later[k]);
  }
  return st;
}

dyd_status dyd_deaths(dyd_tolerance *t) {
  size_t n = t->sk->n, ranges = dyd_ranges(n);
  if (dyd_is_line(t->pd)) {
    dyd_status st = make_place(t, t->sk->line.count);
    return st == DYD_OK ? deaths_on_line(t) : st;
  }
  death_pass p = {t, calloc(n + 1, sizeof *p.first), calloc(ranges, sizeof *p.part)};
  dyd_status st = p.first && p.part ? deaths_in_mesh(&p, ranges) : DYD_E_NOMEM;
  for (size_t r = 0; p.part && r < ranges; r++) free(p.part[r].later);
  free(p.first);
  free(p.part);
  return st;
}
