/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Deaths of all edges. Only Delaunay neighbours of i or j can bind [TOL-4]; where one of them is a hub, few of its
 * neighbours do, and whoever else is near enough is asked for. */
#include "tolerance/state.h"

static bool has_hub(const dyd_tolerance *t, uint32_t v, uint32_t w) {
  return dyd_degree(t, v) + dyd_degree(t, w) > DYD_HUB;
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

static dyd_status death_by_integers(dyd_tolerance *t, uint32_t v, uint32_t w) {
  dyd_status st = dyd_death_exact(t, v, w);
  t->exact++;
  if (st == DYD_OK) st = dyd_row_add_summit(t, v, w, DYD_EVENT_DEATH);
  if (st != DYD_OK || t->summit.binding == DYD_BINDING_NONE) return st;
  return dyd_ring_add(t, v, w, dyd_summit_place(&t->summit), mpz_sgn(t->summit.at.q) ? 0 : mpz_sgn(t->summit.at.p),
                      t->row[t->rows - 1].lo);
}

/* ---- in doubles ---- */

/* v has at most DYD_HUB neighbours. */
static bool add_ring_d(dyd_lines_d *l, const dyd_tolerance *t, uint32_t v, uint32_t w) {
  uint32_t k[DYD_HUB], count = 0;
  for (const uint32_t *q = t->near + t->start[v], *end = t->near + t->start[v + 1]; q < end; q++) {
    k[count] = *q;
    count += (*q != w) & (*q != t->sk->mesh.n);
  }
  return dyd_filter_add(l, &t->points, k, count);
}

static bool add_apexes_d(dyd_lines_d *l, const dyd_tolerance *t, dyd_half_edge h) {
  const dyd_mesh *m = &t->sk->mesh;
  uint32_t apex[2] = {dyd_edge_apex(m, h), dyd_edge_across(m, h)};
  for (int k = 0; k < 2; k++)
    if (apex[k] == m->n || !dyd_filter_add(l, &t->points, &apex[k], 1)) return false;
  return true;
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
static dyd_status hub_in_doubles(bool *sure, dyd_death_d *d, dyd_tolerance *t, dyd_half_edge h) {
  uint32_t v = t->small.i, w = t->small.j;
  dyd_bbox c;
  double radius2;
  dyd_status st = dyd_near_index(t);
  *sure = false;
  if (st != DYD_OK || !add_apexes_d(&t->small, t, h)) return st;
  if (dyd_degree(t, v) <= DYD_HUB && !add_ring_d(&t->small, t, v, w)) return st;
  if (dyd_degree(t, w) <= DYD_HUB && dyd_degree(t, v) > DYD_HUB && !add_ring_d(&t->small, t, w, v)) return st;
  if (!dyd_filter_death(d, c.e, &radius2, &t->points, &t->small) || !(radius2 < 1e300)) return st;
  stranger s = {&t->small, false};
  dyd_tree_near(&t->tree, &c, &radius2, meet_stranger, &s);
  *sure = !s.found;
  return st;
}

static dyd_status death_of_edge(dyd_tolerance *t, dyd_half_edge h) {
  uint32_t v = dyd_edge_origin(&t->sk->mesh, h), w = dyd_edge_target(&t->sk->mesh, h);
  dyd_death_d d;
  double radius2;
  bool sure = false;
  dyd_status st = DYD_OK;
  if (!t->options.no_filter && dyd_filter_pair(&t->small, &t->points, v, w)) {
    if (has_hub(t, v, w))
      st = hub_in_doubles(&sure, &d, t, h);
    else
      sure = add_ring_d(&t->small, t, v, w) && add_ring_d(&t->small, t, w, v) &&
             dyd_filter_death(&d, NULL, &radius2, &t->points, &t->small);
  }
  if (st != DYD_OK) return st;
  if (!sure) return death_by_integers(t, v, w);
  t->filter++;
  st = dyd_ring_add(t, v, w, d.s, d.end, d.lo);
  return st == DYD_OK ? dyd_row_add(t, v, w, DYD_EVENT_DEATH, d.k, d.l, d.lo, d.hi) : st;
}

/* ---- all ---- */

static dyd_status deaths_at(dyd_tolerance *t, uint32_t v) {
  const dyd_mesh *m = &t->sk->mesh;
  dyd_half_edge first = t->sk->leaving[v], h = first;
  dyd_status st = DYD_OK;
  if (first == DYD_NONE) return DYD_OK;
  do {
    uint32_t w = dyd_edge_target(m, h);
    if (w > v && w != m->n && dyd_edge_is_certain(t->sk, h)) st = death_of_edge(t, h);
    h = dyd_edge_turn(m, h);
  } while (st == DYD_OK && h != first);
  return st;
}

static dyd_status deaths_on_line(dyd_tolerance *t) {
  const dyd_line *l = &t->sk->line;
  dyd_status st = DYD_OK;
  for (uint32_t q = 0; q + 1 < l->count && st == DYD_OK; q++)
    if (l->legal[q]) st = death_by_integers(t, l->order[q], l->order[q + 1]);
  return st;
}

/* In the order of the vertices, so that neighbours are near in memory. */
dyd_status dyd_deaths(dyd_tolerance *t) {
  dyd_status st = DYD_OK;
  if (dyd_is_line(t->pd)) return deaths_on_line(t);
  for (uint32_t v = 0; v < t->sk->n && st == DYD_OK; v++) {
    if (dyd_flag_is_set(t->options.cancel)) return DYD_CANCELLED;
    st = deaths_at(t, v);
  }
  return st;
}
