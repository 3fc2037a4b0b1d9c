/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The section on a graph of neighbours: which of its edges are certain, and that others than those listed are none
 * [CERT-13]. */
#include "base/alloc.h"
#include "base/error.h"
#include "base/local.h"
#include "checker/by_key.h"
#include "checker/checker.h"
#include "checker/near.h"

#include <stdlib.h>
#include <string.h>

DYD_ARRAYS(dyd_exact)

#define EFFORT_BITS 16
#define MOST_CUTS 3000 /* of a box of middles */

/* Rows being read; list: of the site read last. partner[first[i] .. first[i+1]):
 * in a possible pair with i. */
typedef struct graph_rows {
  dyd_checker *c;
  dyd_cert_span *span;
  uint32_t *list;
  size_t count, cap;
  size_t *first;
  uint32_t *partner;
  uint64_t effort;
} graph_rows;

/* ---- nearest: ordered pairs ---- */

/* The rows of site i are read. */
static dyd_status check_nearest_of(graph_rows *g, uint32_t i, bool certain) {
  dyd_checker *c = g->c;
  const dyd_cert_near q = {&c->sites, &c->tree, g->span, NULL, &g->span[i], i, g->list, g->count};
  uint32_t other = DYD_CERT_NONE;
  size_t unproved = 0;
  if (certain && g->count > 1) return dyd_cert_reject(&c->in, "of site %u another one is nearest, too", (unsigned)i);
  if (certain && !dyd_cert_near_is_certain(&other, &q))
    return dyd_cert_reject(&c->in, "site %u may be as near to %u", (unsigned)other, (unsigned)i);
  if (!certain && g->count) dyd_cert_near_count(&unproved, &other, &g->effort, &q);
  c->report.graph_unproved += unproved;
  return DYD_OK;
}

/* Sites without a row, of which others than aliases are there, have a nearest one that is not stated. */
static void count_silent(graph_rows *g, uint32_t from, uint32_t to) {
  const dyd_checker *c = g->c;
  if (c->sites.count - c->report.aliases < 2) return;
  for (uint32_t i = from; i < to; i++) g->c->report.graph_unproved += c->sites.site[i].alias == i;
}

static dyd_status read_row(graph_rows *g, dyd_cert_edge *row, bool *certain) {
  static const char *const kinds[] = {"c", "p"};
  size_t kind = 0;
  dyd_status st = dyd_cert_next_line(&g->c->in);
  if (st == DYD_OK) st = dyd_cert_read_choice(&kind, g->c, kinds, 2);
  if (st == DYD_OK) st = dyd_cert_read_site(&row->i, g->c);
  if (st == DYD_OK) st = dyd_cert_read_site(&row->j, g->c);
  if (st == DYD_OK) st = dyd_cert_line_done(&g->c->in);
  if (st == DYD_OK && row->i == row->j) st = dyd_cert_reject(&g->c->in, "a site is not nearest to itself");
  *certain = kind == 0;
  g->c->report.graph_certain += kind == 0;
  return st;
}

static dyd_status check_nearest_rows(graph_rows *g, uint32_t rows) {
  dyd_cert_edge row, last = {DYD_CERT_NONE, 0};
  bool certain, has_certain = false;
  dyd_status st = DYD_OK;
  for (uint32_t k = 0; k < rows && st == DYD_OK; k++, last = row) {
    st = read_row(g, &row, &certain);
    if (st != DYD_OK) return st;
    if (k && (row.i < last.i || (row.i == last.i && row.j <= last.j)))
      return dyd_cert_reject(&g->c->in, "rows are not in order");
    if (!k || row.i != last.i) {
      if (k) st = check_nearest_of(g, last.i, has_certain);
      count_silent(g, k ? last.i + 1 : 0, row.i);
      g->count = 0;
      has_certain = false;
    }
    has_certain |= certain;
    if (!dyd_reserve((void **)&g->list, &g->cap, g->count + 1, sizeof *g->list)) return dyd_fail_nomem(g->c->in.err);
    g->list[g->count++] = row.j;
  }
  if (st == DYD_OK && rows) st = check_nearest_of(g, last.i, has_certain);
  count_silent(g, rows ? last.i + 1 : 0, (uint32_t)g->c->sites.count);
  return st;
}

/* ---- gabriel: certain ---- */

/* Lowers `least` to (z - x)(z - y), z in [side[0], side[1]] as near to the middle of x and y as can be. */
static void lower_angle(dyd_exact *least, bool first, const dyd_exact *x, const dyd_exact *y, const dyd_exact side[2]) {
  DYD_LOCAL(dyd_exact, z, t);
  dyd_exact_add(&z, x, y);
  z.exp--;
  if (dyd_exact_cmp(&z, &side[0]) < 0) dyd_exact_set(&z, &side[0]);
  if (dyd_exact_cmp(&z, &side[1]) > 0) dyd_exact_set(&z, &side[1]);
  dyd_exact_sub(&t, &z, x);
  dyd_exact_sub(&z, &z, y);
  dyd_exact_mul(&t, &t, &z);
  if (first || dyd_exact_cmp(&t, least) < 0) dyd_exact_set(least, &t);
}

/* Is (p_k - p_i).(p_k - p_j) > 0 for every choice? */
static bool is_outside_diameter(const dyd_cert_span *i, const dyd_cert_span *j, const dyd_cert_span *k) {
  DYD_LOCAL_ARRAY(dyd_exact, least, [2]);
  for (int a = 0; a < 2; a++)
    for (int q = 0; q < 4; q++)
      lower_angle(&least[a], q == 0, &i->e[2 * a + (q & 1)], &j->e[2 * a + (q >> 1)], &k->e[2 * a]);
  dyd_exact_add(&least[0], &least[0], &least[1]);
  return dyd_exact_sgn(&least[0]) > 0;
}

typedef struct diameter {
  const dyd_cert_span *span;
  uint32_t i, j, other;
} diameter;

static bool meet_diameter(void *context, uint32_t k) {
  diameter *d = context;
  if (k == d->i || k == d->j || is_outside_diameter(&d->span[d->i], &d->span[d->j], &d->span[k])) return true;
  d->other = k;
  return false;
}

/* out = the box of all middles of the two. */
static void span_of_middles(dyd_cert_span *out, const dyd_cert_span *i, const dyd_cert_span *j) {
  for (int k = 0; k < 4; k++) {
    dyd_exact_add(&out->e[k], &i->e[k], &j->e[k]);
    out->e[k].exp--;
  }
}

/* A disc with the pair as a diameter has its centre among the middles, and at most half of the greatest length as its
 * radius. */
static bool gabriel_is_certain(uint32_t *other, const graph_rows *g, const dyd_cert_edge *p) {
  const dyd_cert_sites *s = &g->c->sites;
  diameter d = {g->span, p->i, p->j, DYD_CERT_NONE};
  dyd_cert_centre centre, end;
  DYD_LOCAL(dyd_cert_span, middles);
  span_of_middles(&middles, &g->span[p->i], &g->span[p->j]);
  dyd_cert_span_on_grid(&centre, s, &middles);
  dyd_cert_span_on_grid(&end, s, &g->span[p->i]);
  dyd_cert_area limit = end.far ? 0 : dyd_cert_far_upper(&end, &s->box[p->j]) / 4 + 1;
  centre.far |= end.far;
  bool certain = dyd_cert_tree_visit(&g->c->tree, &centre, limit, meet_diameter, &d);
  *other = d.other;
  return certain;
}

/* ---- gabriel: never ---- */

/* The square of half the least length of a pair whose middle is corner q of the box. */
static void middle_radius2(dyd_exact *out, const dyd_cert_span *b, int q, const dyd_cert_span *i,
                           const dyd_cert_span *j) {
  DYD_LOCAL(dyd_exact, d, t, u);
  mpz_set_ui(out->man, 0);
  for (int a = 0; a < 2; a++) {
    const dyd_exact *c = &b->e[2 * a + (a ? q >> 1 : q & 1)];
    dyd_cert_axis_gap(&d, &u, c, &i->e[2 * a], false);
    dyd_cert_axis_gap(&t, &u, c, &j->e[2 * a], false);
    if (dyd_exact_cmp(&t, &d) > 0) dyd_exact_set(&d, &t);
    dyd_exact_mul(&d, &d, &d);
    dyd_exact_add(out, out, &d);
  }
}

/* Is k inside, for every choice, of each disc whose middle is a corner of the box? */
static bool is_inside_middles(const graph_rows *g, const dyd_cert_span *b, const dyd_cert_edge *p, uint32_t k) {
  bool inside = true;
  DYD_LOCAL(dyd_exact, far, radius);
  for (int q = 0; q < 4 && inside; q++) {
    dyd_cert_corner_distance2(&far, b, q, &g->span[k], true);
    middle_radius2(&radius, b, q, &g->span[p->i], &g->span[p->j]);
    inside = dyd_exact_cmp(&far, &radius) < 0;
  }
  return inside;
}

/* In the box half the least length is, by each coordinate, 0 or the distance to one number: so a site that is inside at
 * its corners is inside at all of it. */
static bool middles_are_covered(graph_rows *g, const dyd_cert_span *b, const dyd_cert_edge *p, int cuts) {
  size_t from = g->first[p->i], to = g->first[p->i + 1];
  for (size_t k = from; k < to; k++)
    if (is_inside_middles(g, b, p, g->partner[k])) return true; /* j never is */
  bool more = cuts < MOST_CUTS && g->effort > to - from && !dyd_cert_span_is_point(b);
  if (!more) return false;
  g->effort -= to - from;
  DYD_LOCAL(dyd_cert_span, part);
  for (int upper = 0; upper < 2 && more; upper++) {
    dyd_cert_span_half(&part, b, upper);
    more = middles_are_covered(g, &part, p, cuts + 1);
  }
  return more;
}

/* Ends of the sides of two sites, and the places equally far from opposite ends: those in the side of middles,
 * ascending, its ends among it. Returns how many. */
static int cut_middles(dyd_exact cut[8], const dyd_exact middle[2], const dyd_exact i[2], const dyd_exact j[2]) {
  int count = 0;
  dyd_exact *all = cut;
  for (int k = 0; k < 2; k++) {
    dyd_exact_set(&all[k], &middle[k]);
    dyd_exact_set(&all[2 + k], &i[k]);
    dyd_exact_set(&all[4 + k], &j[k]);
    dyd_exact_add(&all[6 + k], &i[k], &j[1 - k]);
    all[6 + k].exp--;
  }
  for (int k = 0; k < 8; k++) { /* by insertion; numbers outside, and repeats, are skipped */
    if (dyd_exact_cmp(&all[k], &middle[0]) < 0 || dyd_exact_cmp(&all[k], &middle[1]) > 0) continue;
    int at = count;
    dyd_exact t = all[k];
    while (at && dyd_exact_cmp(&all[at - 1], &t) > 0) at--;
    if (at && dyd_exact_cmp(&all[at - 1], &t) == 0) continue;
    for (int l = k; l > at; l--) all[l] = all[l - 1];
    all[at] = t;
    count++;
  }
  return count;
}

static bool gabriel_is_never(graph_rows *g, const dyd_cert_edge *p) {
  const dyd_cert_span *i = &g->span[p->i], *j = &g->span[p->j];
  int count[2];
  bool never = true;
  DYD_LOCAL_ARRAY(dyd_exact, cut, [2][8]);
  DYD_LOCAL(dyd_cert_span, middles, part);
  span_of_middles(&middles, i, j);
  for (int a = 0; a < 2; a++) count[a] = cut_middles(cut[a], &middles.e[2 * a], &i->e[2 * a], &j->e[2 * a]);
  int last[2] = {count[0] > 1 ? count[0] - 1 : 1, count[1] > 1 ? count[1] - 1 : 1};
  for (int k = 0; k < last[0] * last[1] && never; k++) {
    int at[2] = {k / last[1], k % last[1]};
    for (int q = 0; q < 4; q++) {
      int a = q / 2, n = at[a] + (q % 2 && count[a] > 1);
      dyd_exact_set(&part.e[q], &cut[a][n]);
    }
    never = middles_are_covered(g, &part, p, 0);
  }
  return never;
}

/* ---- gabriel: rows ---- */

/* Fills in the partners of each site in possible pairs. */
static dyd_status index_partners(graph_rows *g) {
  const dyd_cert_edges *list[2] = {&g->c->legal, &g->c->open};
  size_t all = 2 * (list[0]->count + list[1]->count), count = 0;
  DYD_FREED dyd_cert_entry *entry = dyd_alloc(all, sizeof *entry);
  g->first = dyd_alloc(g->c->sites.count + 1, sizeof *g->first);
  g->partner = dyd_alloc(all, sizeof *g->partner);
  bool good = entry && g->first && g->partner;
  for (int k = 0; k < 2 && good; k++)
    for (size_t e = 0; e < list[k]->count; e++) {
      const dyd_cert_edge *p = &list[k]->item[e];
      entry[count++] = (dyd_cert_entry){p->i, p->j};
      entry[count++] = (dyd_cert_entry){p->j, p->i};
    }
  if (good) dyd_cert_by_key(g->first, g->partner, g->c->sites.count, entry, count);
  return good ? DYD_OK : dyd_fail_nomem(g->c->in.err);
}

static dyd_status read_pair_row(graph_rows *g, dyd_cert_edge *row, const dyd_cert_edge *last, bool *certain) {
  dyd_status st = read_row(g, row, certain);
  if (st == DYD_OK && (row->i > row->j || dyd_cert_compare_edges(last, row) >= 0))
    st = dyd_cert_reject(&g->c->in, "rows are not in order");
  return st;
}

static dyd_status check_gabriel_rows(graph_rows *g, uint32_t rows) {
  dyd_checker *c = g->c;
  const dyd_cert_edges *list[2] = {&c->legal, &c->open};
  dyd_cert_edges listed = {0};
  dyd_cert_edge row, last = {0, 0};
  uint32_t other;
  bool certain;
  dyd_status st = index_partners(g);
  for (uint32_t k = 0; k < rows && st == DYD_OK; k++, last = row) {
    st = read_pair_row(g, &row, &last, &certain);
    if (st == DYD_OK && certain && !gabriel_is_certain(&other, g, &row))
      st = dyd_cert_reject(&c->in, "site %u may be in the disc", (unsigned)other);
    if (st == DYD_OK && dyd_cert_edges_add(&listed, row.i, row.j) != DYD_OK) st = dyd_fail_nomem(c->in.err);
  }
  for (int k = 0; k < 2 && st == DYD_OK; k++)
    for (size_t e = 0; e < list[k]->count; e++) {
      const dyd_cert_edge *p = &list[k]->item[e];
      if (!dyd_cert_edges_have(&listed, p->i, p->j)) c->report.graph_unproved += !gabriel_is_never(g, p);
    }
  free(listed.item);
  return st;
}

/* ---- mst ---- */

typedef struct squared_length {
  dyd_exact square;
  uint32_t pair;
} squared_length;

/* Possible pairs, legal ones first; least, largest: of all pairs, by length; most: by pair, as in largest. never: in no
 * minimum spanning tree; link: the pair to the parent in the tree by least lengths of all others, of which the sites
 * are in order[]; replaced: of a pair of the tree, the least length of another one that joins what it joins, or NULL.
 */
typedef struct cert_spanning {
  graph_rows *g;
  size_t sites, pairs;
  dyd_cert_edge *pair;
  squared_length *least, *largest;
  const dyd_exact **most, **replaced;
  bool *never, *tree;
  uint32_t *up, *parent, *link, *depth, *order;
  size_t *start;
  uint32_t *at; /* pairs of the tree at each site */
} cert_spanning;

/* out = the square of the least, or the largest, distance of two points of the boxes. */
static void span_length2(dyd_exact *out, const dyd_cert_span *i, const dyd_cert_span *j, bool largest) {
  DYD_LOCAL(dyd_exact, d, t);
  mpz_set_ui(out->man, 0);
  for (int a = 0; a < 4; a += 2) {
    dyd_exact_sub(&d, &i->e[a + largest], &j->e[a + !largest]);
    dyd_exact_sub(&t, &j->e[a + largest], &i->e[a + !largest]);
    if (dyd_exact_cmp(&t, &d) > 0) dyd_exact_set(&d, &t);
    if (dyd_exact_sgn(&d) <= 0) continue;
    dyd_exact_mul(&d, &d, &d);
    dyd_exact_add(out, out, &d);
  }
}

static int squared_length_order(const void *a, const void *b) {
  const squared_length *x = a, *y = b;
  int sign = dyd_exact_cmp(&x->square, &y->square);
  return sign ? sign : (x->pair > y->pair) - (x->pair < y->pair);
}

static dyd_status spanning_begin(cert_spanning *s, graph_rows *g) {
  const dyd_cert_edges *list[2] = {&g->c->legal, &g->c->open};
  size_t n = g->c->sites.count, pairs = list[0]->count + list[1]->count;
  *s = (cert_spanning){.g = g, .sites = n};
  s->pair = dyd_alloc(pairs, sizeof *s->pair);
  s->least = dyd_alloc(pairs, sizeof *s->least);
  s->largest = dyd_alloc(pairs, sizeof *s->largest);
  s->most = dyd_alloc(pairs, sizeof *s->most);
  s->replaced = calloc(pairs + 1, sizeof *s->replaced);
  s->never = calloc(pairs + 1, sizeof *s->never);
  s->tree = calloc(pairs + 1, sizeof *s->tree);
  s->up = dyd_alloc(n, sizeof *s->up);
  s->parent = dyd_alloc(n, sizeof *s->parent);
  s->link = dyd_alloc(n, sizeof *s->link);
  s->depth = dyd_alloc(n, sizeof *s->depth);
  s->order = dyd_alloc(n, sizeof *s->order);
  s->start = dyd_alloc(n + 1, sizeof *s->start);
  s->at = dyd_alloc(2 * n, sizeof *s->at);
  if (!s->pair || !s->least || !s->largest || !s->most || !s->replaced || !s->never || !s->tree || !s->up ||
      !s->parent || !s->link || !s->depth || !s->order || !s->start || !s->at)
    return dyd_fail_nomem(g->c->in.err);
  for (int k = 0; k < 2; k++)
    for (size_t e = 0; e < list[k]->count; e++) {
      uint32_t p = (uint32_t)s->pairs++;
      s->pair[p] = list[k]->item[e];
      s->least[p].pair = s->largest[p].pair = p;
      dyd_exact_init(&s->least[p].square);
      dyd_exact_init(&s->largest[p].square);
      span_length2(&s->least[p].square, &g->span[s->pair[p].i], &g->span[s->pair[p].j], false);
      span_length2(&s->largest[p].square, &g->span[s->pair[p].i], &g->span[s->pair[p].j], true);
    }
  if (s->pairs) qsort(s->least, s->pairs, sizeof *s->least, squared_length_order);
  if (s->pairs) qsort(s->largest, s->pairs, sizeof *s->largest, squared_length_order);
  for (size_t k = 0; k < s->pairs; k++) s->most[s->largest[k].pair] = &s->largest[k].square;
  return DYD_OK;
}

static void spanning_clear(cert_spanning *s) {
  for (size_t p = 0; p < s->pairs; p++) {
    dyd_exact_clear(&s->least[p].square);
    dyd_exact_clear(&s->largest[p].square);
  }
  void *all[] = {s->pair, s->least,  s->largest, s->most,  s->replaced, s->never, s->tree,
                 s->up,   s->parent, s->link,    s->depth, s->order,    s->start, s->at};
  for (size_t k = 0; k < sizeof all / sizeof *all; k++) free(all[k]);
}

/* The top of the set of site i. */
static uint32_t spanning_top(uint32_t *up, uint32_t i) {
  while (up[i] != i) i = up[i] = up[up[i]];
  return i;
}

static void spanning_apart(cert_spanning *s) {
  for (uint32_t i = 0; i < s->sites; i++) s->up[i] = i;
}

/* Shorter legal pairs join the ends; or no disc of the pair is empty, which is tried where it has no row. */
static void spanning_never(cert_spanning *s, const dyd_cert_edges *listed) {
  size_t next = 0;
  spanning_apart(s);
  for (size_t k = 0; k < s->pairs; k++) {
    const uint32_t p = s->least[k].pair;
    for (; next < s->pairs && dyd_exact_cmp(&s->largest[next].square, &s->least[k].square) < 0; next++) {
      const dyd_cert_edge *q = &s->pair[s->largest[next].pair];
      if (s->largest[next].pair < s->g->c->legal.count) s->up[spanning_top(s->up, q->i)] = spanning_top(s->up, q->j);
    }
    s->never[p] = spanning_top(s->up, s->pair[p].i) == spanning_top(s->up, s->pair[p].j);
  }
  for (size_t p = 0; p < s->pairs; p++) {
    bool open = !s->never[p] && !dyd_cert_edges_have(listed, s->pair[p].i, s->pair[p].j);
    s->never[p] = s->never[p] || (open && gabriel_is_never(s->g, &s->pair[p]));
    s->g->c->report.graph_unproved += open && !s->never[p];
  }
}

/* The tree by least lengths, dealt to its sites. */
static dyd_status spanning_tree(cert_spanning *s) {
  DYD_FREED dyd_cert_entry *entry = dyd_alloc(2 * s->sites, sizeof *entry);
  size_t count = 0;
  if (!entry) return dyd_fail_nomem(s->g->c->in.err);
  spanning_apart(s);
  for (size_t k = 0; k < s->pairs; k++) {
    const uint32_t p = s->least[k].pair, a = spanning_top(s->up, s->pair[p].i), b = spanning_top(s->up, s->pair[p].j);
    if (s->never[p] || a == b) continue;
    s->tree[p] = true;
    s->up[a] = b;
    entry[count++] = (dyd_cert_entry){s->pair[p].i, p};
    entry[count++] = (dyd_cert_entry){s->pair[p].j, p};
  }
  dyd_cert_by_key(s->start, s->at, s->sites, entry, count);
  return DYD_OK;
}

/* Site i, and all that is in its tree, get their parents. */
static void spanning_root(cert_spanning *s, uint32_t i) {
  size_t count = 1;
  s->order[0] = s->parent[i] = i;
  s->depth[i] = 1;
  for (size_t k = 0; k < count; k++) {
    uint32_t v = s->order[k];
    for (size_t q = s->start[v]; q < s->start[v + 1]; q++) {
      const dyd_cert_edge *p = &s->pair[s->at[q]];
      uint32_t w = p->i == v ? p->j : p->i;
      if (s->depth[w]) continue;
      s->parent[w] = v;
      s->link[w] = s->at[q];
      s->depth[w] = s->depth[v] + 1;
      s->order[count++] = w;
    }
  }
}

/* What each pair of the tree is replaced by first: pairs that are not in it, the shortest first, cover the way between
 * their ends; what is covered is passed over from then on. */
static void spanning_replace(cert_spanning *s) {
  memset(s->depth, 0, s->sites * sizeof *s->depth);
  for (uint32_t i = 0; i < s->sites; i++)
    if (!s->depth[i]) spanning_root(s, i);
  spanning_apart(s);
  for (size_t k = 0; k < s->pairs; k++) {
    const uint32_t p = s->least[k].pair;
    if (s->never[p] || s->tree[p]) continue;
    uint32_t a = spanning_top(s->up, s->pair[p].i), b = spanning_top(s->up, s->pair[p].j);
    while (a != b) {
      uint32_t *low = s->depth[a] > s->depth[b] ? &a : &b;
      s->replaced[s->link[*low]] = &s->least[k].square;
      s->up[*low] = s->parent[*low];
      *low = spanning_top(s->up, *low);
    }
  }
}

/* Is no other way between the ends as short as the pair may be, or one of them surely nearest to the other [MST-1]? */
static bool spanning_is_certain(const cert_spanning *s, const dyd_cert_edge *row) {
  const graph_rows *g = s->g;
  const dyd_cert_edges *list[2] = {&g->c->legal, &g->c->open};
  for (int k = 0; k < 2; k++) {
    const dyd_cert_edge *at =
        list[k]->count ? bsearch(row, list[k]->item, list[k]->count, sizeof *row, dyd_cert_compare_edges) : NULL;
    if (!at) continue;
    size_t p = (size_t)(at - list[k]->item) + (k ? list[0]->count : 0);
    if (s->tree[p] && (!s->replaced[p] || dyd_exact_cmp(s->replaced[p], s->most[p]) > 0)) return true;
  }
  for (int k = 0; k < 2; k++) {
    uint32_t other, self = k ? row->j : row->i, near = k ? row->i : row->j;
    const dyd_cert_near q = {&g->c->sites, &g->c->tree, g->span, NULL, &g->span[self], self, &near, 1};
    if (dyd_cert_near_is_certain(&other, &q)) return true;
  }
  return false;
}

static dyd_status read_spanning_rows(dyd_cert_edges *listed, dyd_cert_edges *sure, graph_rows *g, uint32_t rows) {
  dyd_cert_edge row, last = {0, 0};
  bool certain;
  dyd_status st = DYD_OK;
  for (uint32_t k = 0; k < rows && st == DYD_OK; k++, last = row) {
    st = read_pair_row(g, &row, &last, &certain);
    if (st == DYD_OK) st = dyd_cert_edges_add(listed, row.i, row.j);
    if (st == DYD_OK && certain) st = dyd_cert_edges_add(sure, row.i, row.j);
    if (st == DYD_E_NOMEM) dyd_fail_nomem(g->c->in.err);
  }
  return st;
}

/* Rows c that are not proved to be certain are counted: the checker may fail to see that a pair is in no tree. */
static dyd_status check_spanning_rows(graph_rows *g, uint32_t rows) {
  cert_spanning s = {.g = g};
  dyd_cert_edges listed = {0}, sure = {0};
  dyd_status st = read_spanning_rows(&listed, &sure, g, rows);
  if (st == DYD_OK) st = index_partners(g);
  if (st == DYD_OK) st = spanning_begin(&s, g);
  if (st == DYD_OK) spanning_never(&s, &listed);
  if (st == DYD_OK) st = spanning_tree(&s);
  if (st == DYD_OK) spanning_replace(&s);
  for (size_t k = 0; k < sure.count && st == DYD_OK; k++) {
    bool unproved = !spanning_is_certain(&s, &sure.item[k]);
    g->c->report.graph_certain -= unproved;
    g->c->report.graph_unproved += unproved;
  }
  free(listed.item);
  free(sure.item);
  spanning_clear(&s);
  return st;
}

/* ---- the section ---- */

dyd_status dyd_checker_graph(dyd_checker *c) {
  static const char *const names[] = {"nearest", "gabriel", "mst"};
  static dyd_status (*const check[])(graph_rows *, uint32_t) = {check_nearest_rows, check_gabriel_rows,
                                                                check_spanning_rows};
  graph_rows g = {.c = c, .effort = ((uint64_t)c->sites.count + 64) << EFFORT_BITS};
  uint32_t rows = 0;
  size_t kind = 0;
  dyd_status st = dyd_cert_expect_word(c, "graph");
  if (st == DYD_OK) st = dyd_cert_read_choice(&kind, c, names, 3);
  if (st == DYD_OK) st = dyd_cert_read_index(&rows, &c->in, DYD_CERT_NONE);
  if (st == DYD_OK) st = dyd_cert_line_done(&c->in);
  if (st != DYD_OK) return st;
  c->report.graph = names[kind];
  if (dyd_cert_spans_init(&g.span, &c->sites) != DYD_OK) st = dyd_fail_nomem(c->in.err);
  if (st == DYD_OK) st = check[kind](&g, rows);
  c->report.graph_rows = rows;
  dyd_cert_spans_free(g.span, c->sites.count);
  free(g.first);
  free(g.partner);
  free(g.list);
  return st;
}
