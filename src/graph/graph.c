/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The graphs: nearest neighbours [NNG-1], Gabriel [GAB-1], minimum spanning tree [MST-1]. */
#include "graph/graph.h"

#include "base/alloc.h"
#include "base/error.h"
#include "base/flag.h"
#include "base/float_filter.h"
#include "base/local.h"
#include "delaunay/state.h"
#include "rect/sites_table.h"

/* ---- lists of edges ---- */

void dyd_graph_list_clear(dyd_graph_list *l) {
  free(l->item);
  *l = (dyd_graph_list){0};
}

static dyd_status graph_add(dyd_graph_work *w, uint32_t i, uint32_t j, bool sure) {
  if (!DYD_GROW(w->out.item, w->cap, w->out.count + 1)) return DYD_E_NOMEM;
  w->out.item[w->out.count++] = (dyd_graph_edge){i, j, sure};
  return DYD_OK;
}

/* ---- lengths of pairs ---- */

/* Adds the square of what counts along one side. */
static void add_side2(mpq_ptr sum, const dyd_interval *a, const dyd_interval *b, bool largest) {
  DYD_LOCAL_NUMBERS(mpq, alo, ahi, blo, bhi);
  dyd_interval_get_q(alo, ahi, a);
  dyd_interval_get_q(blo, bhi, b);
  mpq_sub(ahi, ahi, blo); /* how far a reaches beyond b, and b beyond a */
  mpq_sub(bhi, bhi, alo);
  mpq_ptr d = ahi;
  if (largest ? mpq_cmp(bhi, ahi) > 0 : mpq_cmp(bhi, ahi) < 0) d = bhi;
  if (largest || mpq_sgn(d) < 0) {
    mpq_mul(d, d, d);
    mpq_add(sum, sum, d);
  }
}

static void exact_length(mpq_ptr out, const dyd_length *l) {
  const dyd_pair *p = &l->of->pairs.item[l->pair];
  DYD_LOCAL(dyd_rect, a, b);
  dyd_sites_get(&a, l->of->sites, p->i);
  dyd_sites_get(&b, l->of->sites, p->j);
  mpq_set_ui(out, 0, 1);
  add_side2(out, &a.x, &b.x, l->largest);
  add_side2(out, &a.y, &b.y, l->largest);
}

/* Sign of a - b. */
static int length_compare(const dyd_length *a, const dyd_length *b) {
  if (a->hi < b->lo) return -1;
  if (b->hi < a->lo) return 1;
  if (a->lo == a->hi && b->lo == b->hi) return 0;
  if (a->pair == b->pair && a->largest == b->largest) return 0;
  DYD_LOCAL_NUMBERS(mpq, x, y);
  exact_length(x, a);
  exact_length(y, b);
  return mpq_cmp(x, y);
}

/* By length; for qsort. */
static int length_order(const void *a, const void *b) {
  return length_compare(a, b);
}

/* ---- a few rectangles, compared exactly ---- */

static void reach_init(dyd_reach *r) {
  *r = (dyd_reach){0};
  mpz_inits(r->rho, r->d, r->e, NULL);
}

static void reach_clear(dyd_reach *r) {
  for (size_t k = 0; k < r->made; k++) {
    dyd_rect_clear(&r->rect[k]);
    dyd_irect_clear(&r->grid[k]);
  }
  dyd_free_all(r->rect, r->in, r->grid, r->mark);
  mpz_clears(r->rho, r->d, r->e, NULL);
}

static bool reach_room(dyd_reach *r, size_t count) {
  size_t cap[4] = {r->made, r->made, r->made, r->made};
  if (count <= r->made) return true;
  if (!DYD_GROW(r->rect, cap[0], count) || !DYD_GROW(r->in, cap[1], count) || !DYD_GROW(r->grid, cap[2], count) ||
      !DYD_GROW(r->mark, cap[3], count))
    return false;
  for (; r->made < cap[0]; r->made++) {
    dyd_rect_init(&r->rect[r->made]);
    dyd_irect_init(&r->grid[r->made]);
  }
  for (size_t k = 0; k < r->made; k++) r->in[k] = &r->rect[k];
  return true;
}

/* grid[0] becomes site i, grid[1 ..] the others. DYD_E_NOMEM, DYD_E_RANGE as dyd_sites_get. */
static dyd_status reach_load(dyd_reach *r, const dyd_sites *sites, uint32_t i, const uint32_t *other, size_t count) {
  if (!reach_room(r, count + 1)) return DYD_E_NOMEM;
  dyd_status st = dyd_sites_get(&r->rect[0], sites, i);
  for (size_t k = 0; k < count && st == DYD_OK; k++) st = dyd_sites_get(&r->rect[k + 1], sites, other[k]);
  if (st != DYD_OK) return st;
  r->count = count + 1;
  dyd_irects_scale(r->grid, r->in, r->count, NULL, NULL);
  for (size_t k = 0; k < r->count; k++) {
    mpz_ptr end[4] = {r->grid[k].x0, r->grid[k].x1, r->grid[k].y0, r->grid[k].y1};
    for (int e = 0; e < 4; e++) mpz_mul_2exp(end[e], end[e], 2);
  }
  return DYD_OK;
}

/* ---- for every choice ---- */

/* dl_j^2 - ds_k^2 is a maximum of functions that are affine in x: largest at a corner of R_0. */
static bool reach_is_nearest(dyd_reach *r, size_t j) {
  for (int c = 0; c < 4; c++) {
    mpz_srcptr x = dyd_irect_end(&r->grid[0], 0, c & 1), y = dyd_irect_end(&r->grid[0], 1, c >> 1);
    dyd_irect_dl2(r->d, x, y, &r->grid[j]);
    for (size_t k = 1; k < r->count; k++) {
      if (k == j) continue;
      dyd_irect_ds2(r->e, x, y, &r->grid[k]);
      if (mpz_cmp(r->d, r->e) >= 0) return false;
    }
  }
  return true;
}

/* *least = min (z - x)(z - y) over the sides of a, b, k along an axis: x and y at ends, since it is affine in each; z
 * as near as can be to their middle. */
static void least_product(mpz_ptr least, mpz_ptr z, mpz_ptr t, const dyd_irect *a, const dyd_irect *b,
                          const dyd_irect *k, int axis) {
  for (int c = 0; c < 4; c++) {
    mpz_srcptr x = dyd_irect_end(a, axis, c & 1), y = dyd_irect_end(b, axis, c >> 1);
    mpz_add(z, x, y);
    mpz_fdiv_q_2exp(z, z, 1);
    if (mpz_cmp(z, dyd_irect_end(k, axis, 0)) < 0) mpz_set(z, dyd_irect_end(k, axis, 0));
    if (mpz_cmp(z, dyd_irect_end(k, axis, 1)) > 0) mpz_set(z, dyd_irect_end(k, axis, 1));
    mpz_sub(t, z, x);
    mpz_sub(z, z, y);
    mpz_mul(t, t, z);
    if (c == 0 || mpz_cmp(t, least) < 0) mpz_set(least, t);
  }
}

/* p_k is outside of the disc with diameter p_i p_j iff (p_k - p_i).(p_k - p_j) > 0: a sum over both coordinates, each
 * with its own variables. */
static bool reach_is_gabriel(dyd_reach *r, size_t j) {
  bool free_of_all = true;
  DYD_LOCAL_NUMBERS(mpz, z);
  for (size_t k = 1; k < r->count && free_of_all; k++) {
    if (k == j) continue;
    least_product(r->d, z, r->rho, &r->grid[0], &r->grid[j], &r->grid[k], 0);
    least_product(r->e, z, r->rho, &r->grid[0], &r->grid[j], &r->grid[k], 1);
    mpz_add(r->d, r->d, r->e);
    free_of_all = mpz_sgn(r->d) > 0;
  }
  return free_of_all;
}

/* Returns true if number j (from 1) is nearest to number 0 for some choice (ties included), for every choice (alone).
 */
static bool reach_may_be_nearest(dyd_reach *r, size_t j) {
  return dyd_reach_has_place(r, j, false, &r->grid[0]);
}

/* Returns true if the open disc with diameter 0 j is free of the others for some choice, the closed one for every
 * choice. */
static bool reach_may_be_gabriel(dyd_reach *r, size_t j) {
  const dyd_irect *a = &r->grid[0], *b = &r->grid[j];
  DYD_LOCAL(dyd_irect, middle);
  mpz_ptr end[4] = {middle.x0, middle.x1, middle.y0, middle.y1};
  for (int k = 0; k < 4; k++) {
    mpz_add(end[k], dyd_irect_end(a, k / 2, k % 2), dyd_irect_end(b, k / 2, k % 2));
    mpz_fdiv_q_2exp(end[k], end[k], 1);
  }
  return dyd_reach_has_place(r, j, true, &middle);
}

/* ---- nearest neighbours ---- */

/* Only for exact points i, which have one distance to each: the least of the largest distances of all but one decides
 * about that one, so a hub takes time by its degree. */
static dyd_status nearest_of_point(dyd_graph_work *w, uint32_t i) {
  dyd_reach *r = &w->reach;
  DYD_LOCAL_ARRAY(mpz_t, least, [2]); /* the two least of dl^2 */
  DYD_LOCAL_NUMBERS(mpz, own);
  size_t who = 0;
  dyd_status st = DYD_OK;
  for (size_t k = 1; k < r->count; k++) {
    dyd_irect_dl2(own, r->grid[0].x0, r->grid[0].y0, &r->grid[k]);
    bool first = !who || mpz_cmp(own, least[0]) < 0;
    if (first) mpz_swap(least[0], least[1]);
    if (first || k == 2 || mpz_cmp(own, least[1]) < 0) mpz_set(least[first ? 0 : 1], own);
    if (first) who = k;
  }
  for (size_t k = 1; k < r->count && st == DYD_OK; k++) {
    dyd_irect_ds2(own, r->grid[0].x0, r->grid[0].y0, &r->grid[k]);
    if (r->count > 2 && mpz_cmp(own, least[who == k]) > 0) continue;
    bool sure = who == k && reach_is_nearest(r, k);
    st = graph_add(w, i, w->other[k - 1], sure);
  }
  return st;
}

/* Of w->other[number] as the nearest one to i. *loaded: w->reach holds i and all others. */
static dyd_status status_as_nearest(dyd_graph_status *out, dyd_graph_work *w, bool *loaded, uint32_t i, size_t number) {
  dyd_graph_verdict v = dyd_filter_nearest(w, i, w->other[number]);
  if (w->discs && v.status == DYD_GRAPH_POSSIBLE) v.status = dyd_filter_ball_nearest(w, i, w->other[number]);
  *out = v.status;
  if (v.known || v.status != DYD_GRAPH_POSSIBLE) return DYD_OK;
  if (!*loaded) {
    dyd_status st = reach_load(&w->reach, w->sites, i, w->other, w->others);
    if (st != DYD_OK) return st;
    *loaded = true;
  }
  if (reach_is_nearest(&w->reach, number + 1))
    *out = DYD_GRAPH_SURE;
  else
    *out = reach_may_be_nearest(&w->reach, number + 1) ? DYD_GRAPH_POSSIBLE : DYD_GRAPH_NEVER;
  return DYD_OK;
}

/* With more candidates than these, those of an exact point are compared by their distances. */
enum { NEAREST_MANY = 8 };

static dyd_status nearest_of(dyd_graph_work *w, uint32_t i) {
  bool loaded = false;
  dyd_status st = DYD_OK;
  dyd_filter_nearest_few(w, i);
  if (w->others > NEAREST_MANY && dyd_sites_is_point(w->sites, i)) {
    st = reach_load(&w->reach, w->sites, i, w->other, w->others);
    return st == DYD_OK ? nearest_of_point(w, i) : st;
  }
  for (size_t k = 0; k < w->others && st == DYD_OK; k++) {
    dyd_graph_status status;
    st = status_as_nearest(&status, w, &loaded, i, k);
    if (st == DYD_OK && status != DYD_GRAPH_NEVER) st = graph_add(w, i, w->other[k], status == DYD_GRAPH_SURE);
  }
  return st;
}

static dyd_status nearest_graph(dyd_graph_work *w) {
  dyd_status st = DYD_OK;
  for (uint32_t i = 0; i < w->n && st == DYD_OK; i++)
    st = dyd_flag_is_set(w->cancel) ? DYD_CANCELLED : nearest_of(w, i);
  return st;
}

/* ---- Gabriel ---- */

static size_t degree_of(const dyd_graph_work *w, uint32_t i) {
  return w->start[i + 1] - w->start[i];
}

static size_t partner_number(const dyd_graph_work *w, uint32_t i, uint32_t j) {
  size_t k = 0;
  while (w->partner[w->start[i] + k] != j) k++;
  return k;
}

static dyd_status gabriel_status(dyd_graph_status *out, dyd_graph_work *w, uint32_t i, uint32_t j) {
  if (degree_of(w, j) < degree_of(w, i)) {
    uint32_t other = i;
    i = j, j = other;
  }
  dyd_graph_verdict v = dyd_filter_gabriel(w, i, j);
  if (w->discs && v.status == DYD_GRAPH_POSSIBLE) v.status = dyd_filter_ball_gabriel(w, i, j);
  *out = v.status;
  if (v.known || v.status != DYD_GRAPH_POSSIBLE) return DYD_OK;
  dyd_status st = reach_load(&w->reach, w->sites, i, &w->partner[w->start[i]], degree_of(w, i));
  if (st != DYD_OK) return st;
  size_t number = partner_number(w, i, j) + 1;
  if (reach_is_gabriel(&w->reach, number))
    *out = DYD_GRAPH_SURE;
  else
    *out = reach_may_be_gabriel(&w->reach, number) ? DYD_GRAPH_POSSIBLE : DYD_GRAPH_NEVER;
  return DYD_OK;
}

static dyd_status gabriel_graph(dyd_graph_work *w) {
  dyd_status st = DYD_OK;
  for (size_t k = 0; k < w->pairs.count && st == DYD_OK; k++) {
    const dyd_pair *p = &w->pairs.item[k];
    dyd_graph_status status;
    if (dyd_flag_is_set(w->cancel)) return DYD_CANCELLED;
    st = gabriel_status(&status, w, p->i, p->j);
    if (st == DYD_OK && status != DYD_GRAPH_NEVER) st = graph_add(w, p->i, p->j, status == DYD_GRAPH_SURE);
  }
  return st;
}

/* ---- the minimum spanning tree ---- */

/* By the least and the largest length of each pair [MST-1].
 *
 * never   legal pairs that are certainly shorter join i and j, or ij is never an edge of the Gabriel graph
 * sure    other pairs, not among those, that may be as short do not join i and j: the bottleneck between i and j by
 *         least lengths is in the spanning tree by least lengths, or, where ij is in that itself, the first pair that
 *         closes a circle with it; or j is certainly the nearest one to i, or i to j */

/* The top of the set of site i in the forest `up`. */
static uint32_t set_of(uint32_t *up, uint32_t i) {
  while (up[i] != i) {
    up[i] = up[up[i]];
    i = up[i];
  }
  return i;
}

static void sets_begin(uint32_t *up, size_t n) {
  for (size_t i = 0; i < n; i++) up[i] = (uint32_t)i;
}

enum { SPAN_NONE = UINT32_MAX };

/* least, largest: of all pairs, sorted. nearest: the certainly nearest site to each site, or SPAN_NONE. replaced: by
 * pair, the number in least[] of the first pair that closes a circle with it, where it is in the tree; SPAN_NONE: none.
 * tree: is it? Neither counts pairs that are in no minimum spanning tree. */
typedef struct span_work {
  dyd_graph_work *w;
  dyd_length *least, *largest;
  uint32_t *replaced, *nearest;
  bool *tree, *never;
  uint32_t *up; /* sets of sites */
  /* the tree by least lengths: towards the root */
  uint32_t *parent, *link, *depth;
  size_t *start;
  uint32_t *edge; /* pairs of the tree at each site */
} span_work;

/* Sorting lengths may take as much again as one list of them. */
static bool span_has_room(const span_work *s) {
  uint64_t pair = 3 * sizeof *s->least + sizeof *s->replaced + sizeof *s->tree + sizeof *s->never;
  uint64_t site = 7 * sizeof(uint32_t) + sizeof *s->start;
  uint64_t bytes = dyd_bytes_times(s->w->pairs.count, pair) + dyd_bytes_times(s->w->n, site);
  return dyd_memory_has(&s->w->memory, bytes, "the spanning tree");
}

static bool span_alloc(span_work *s) {
  size_t n = s->w->n, pairs = s->w->pairs.count;
  return DYD_NEW(s->least, pairs) && DYD_NEW(s->largest, pairs) && DYD_NEW(s->replaced, pairs) &&
         DYD_NEW(s->nearest, n) && DYD_ZEROED(s->tree, pairs + 1) && DYD_ZEROED(s->never, pairs + 1) &&
         DYD_NEW(s->up, n) && DYD_NEW(s->parent, n) && DYD_NEW(s->link, n) && DYD_NEW(s->depth, n) &&
         DYD_ZEROED(s->start, n + 2) && DYD_NEW(s->edge, 2 * n);
}

static void spanning_work_clear(span_work *s) {
  dyd_free_all(s->least, s->largest, s->replaced, s->nearest, s->tree, s->never, s->up, s->parent, s->link, s->depth,
               s->start, s->edge);
}

static void sort_lengths(span_work *s) {
  size_t pairs = s->w->pairs.count;
  for (uint32_t p = 0; p < pairs; p++) {
    s->least[p] = dyd_filter_length(s->w, p, false);
    s->largest[p] = dyd_filter_length(s->w, p, true);
  }
  qsort(s->least, pairs, sizeof *s->least, length_order);
  qsort(s->largest, pairs, sizeof *s->largest, length_order);
}

/* Legal pairs stay legal, so sites that they join stay joined when rectangles shrink. */
static void find_never(span_work *s) {
  const dyd_pair *pair = s->w->pairs.item;
  size_t next = 0;
  sets_begin(s->up, s->w->n);
  for (size_t q = 0; q < s->w->pairs.count; q++) {
    for (; next < s->w->pairs.count && length_compare(&s->largest[next], &s->least[q]) < 0; next++) {
      const dyd_pair *p = &pair[s->largest[next].pair];
      if (p->status == DYD_LEGAL) s->up[set_of(s->up, p->i)] = set_of(s->up, p->j);
    }
    const dyd_pair *p = &pair[s->least[q].pair];
    s->never[s->least[q].pair] = set_of(s->up, p->i) == set_of(s->up, p->j);
  }
}

static dyd_status find_never_gabriel(span_work *s) {
  const dyd_pair *pair = s->w->pairs.item;
  dyd_status st = DYD_OK;
  for (size_t p = 0; p < s->w->pairs.count && st == DYD_OK; p++) {
    dyd_graph_status status;
    if (s->never[p]) continue;
    st = dyd_flag_is_set(s->w->cancel) ? DYD_CANCELLED : gabriel_status(&status, s->w, pair[p].i, pair[p].j);
    s->never[p] = st == DYD_OK && status == DYD_GRAPH_NEVER;
  }
  return st;
}

static void find_tree(span_work *s) {
  sets_begin(s->up, s->w->n);
  for (size_t q = 0; q < s->w->pairs.count; q++) {
    const dyd_pair *p = &s->w->pairs.item[s->least[q].pair];
    if (s->never[s->least[q].pair]) continue;
    uint32_t a = set_of(s->up, p->i), b = set_of(s->up, p->j);
    s->tree[s->least[q].pair] = a != b;
    s->up[a] = b;
  }
}

/* The pairs of the tree at each site. */
static void deal_tree(span_work *s) {
  const dyd_pair *pair = s->w->pairs.item;
  for (size_t p = 0; p < s->w->pairs.count; p++) {
    if (!s->tree[p]) continue;
    s->start[pair[p].i + 2]++;
    s->start[pair[p].j + 2]++;
  }
  for (size_t i = 2; i <= s->w->n + 1; i++) s->start[i] += s->start[i - 1];
  for (uint32_t p = 0; p < s->w->pairs.count; p++) {
    if (!s->tree[p]) continue;
    s->edge[s->start[pair[p].i + 1]++] = p;
    s->edge[s->start[pair[p].j + 1]++] = p;
  }
}

/* Hangs every tree on one of its sites. `queue`: room for all. */
static void root_trees(span_work *s, uint32_t *queue) {
  size_t head = 0, tail = 0;
  for (uint32_t i = 0; i < s->w->n; i++) s->parent[i] = SPAN_NONE;
  for (uint32_t i = 0; i < s->w->n; i++) {
    if (s->parent[i] != SPAN_NONE) continue;
    s->parent[i] = i, s->depth[i] = 0, s->link[i] = SPAN_NONE;
    for (queue[tail++] = i; head < tail; head++) {
      uint32_t v = queue[head];
      for (size_t k = s->start[v]; k < s->start[v + 1]; k++) {
        const dyd_pair *p = &s->w->pairs.item[s->edge[k]];
        uint32_t other = p->i == v ? p->j : p->i;
        if (s->parent[other] != SPAN_NONE) continue;
        s->parent[other] = v, s->depth[other] = s->depth[v] + 1, s->link[other] = s->edge[k];
        queue[tail++] = other;
      }
    }
  }
}

/* The other pairs, shortest first: each is the first around the links of the tree between its ends that none was
 * around before; those are passed over from then on. */
static void find_replacements(span_work *s) {
  for (size_t p = 0; p < s->w->pairs.count; p++) s->replaced[p] = SPAN_NONE;
  sets_begin(s->up, s->w->n);
  for (size_t q = 0; q < s->w->pairs.count; q++) {
    const dyd_pair *p = &s->w->pairs.item[s->least[q].pair];
    if (s->tree[s->least[q].pair] || s->never[s->least[q].pair]) continue;
    uint32_t a = set_of(s->up, p->i), b = set_of(s->up, p->j);
    while (a != b) {
      uint32_t *lower = s->depth[a] >= s->depth[b] ? &a : &b;
      s->replaced[s->link[*lower]] = (uint32_t)q;
      s->up[*lower] = s->parent[*lower];
      *lower = set_of(s->up, *lower);
    }
  }
}

static bool is_surely_shortest(const span_work *s, uint32_t p) {
  if (!s->tree[p]) return false;
  dyd_length own = dyd_filter_length(s->w, p, true);
  return s->replaced[p] == SPAN_NONE || length_compare(&own, &s->least[s->replaced[p]]) < 0;
}

/* The certainly nearest site to each site. */
static dyd_status find_sure_nearest(span_work *s) {
  dyd_graph_list *l = &s->w->out;
  dyd_status st = nearest_graph(s->w);
  for (size_t i = 0; i < s->w->n; i++) s->nearest[i] = SPAN_NONE;
  for (size_t k = 0; k < l->count; k++)
    if (l->item[k].sure) s->nearest[l->item[k].i] = l->item[k].j;
  l->count = 0;
  return st;
}

static dyd_status span_pair(const span_work *s, uint32_t number) {
  uint32_t i = s->w->pairs.item[number].i, j = s->w->pairs.item[number].j;
  if (s->never[number]) return DYD_OK;
  return graph_add(s->w, i, j, s->nearest[i] == j || s->nearest[j] == i || is_surely_shortest(s, number));
}

static dyd_status spanning_graph(dyd_graph_work *w) {
  span_work s = {.w = w};
  dyd_status st = span_has_room(&s) && span_alloc(&s) ? DYD_OK : DYD_E_NOMEM;
  if (st == DYD_OK) {
    sort_lengths(&s);
    find_never(&s);
    st = find_never_gabriel(&s);
  }
  if (st == DYD_OK) {
    find_tree(&s);
    deal_tree(&s);
    root_trees(&s, s.up);
    find_replacements(&s);
    st = find_sure_nearest(&s);
  }
  for (uint32_t p = 0; p < w->pairs.count && st == DYD_OK; p++) st = span_pair(&s, p);
  spanning_work_clear(&s);
  return st;
}

/* ---- the public call ---- */

/* The partners and boxes, and a list of edges that grows. */
static bool graph_has_room(dyd_graph_work *w) {
  uint64_t pairs = dyd_pairs_bytes(w->pd, w->least) / sizeof(dyd_pair);
  uint64_t each = sizeof(dyd_pair) + 2 * sizeof *w->partner + 2 * sizeof *w->out.item;
  uint64_t bytes = dyd_bytes_times(pairs, each) + dyd_bytes_times(w->n, sizeof *w->start + sizeof *w->box);
  if (!dyd_memory_has(&w->memory, bytes, "the graph")) return false;
  w->memory.held += bytes;
  return true;
}

/* For the exact rung: rectangles of `most` partners. */
static bool partners_have_room(dyd_graph_work *w, size_t most) {
  enum { NUMBERS = 10, BLOCK = 40 };
  uint64_t each = sizeof *w->other + sizeof *w->reach.rect + sizeof *w->reach.grid + NUMBERS * BLOCK;
  return dyd_memory_has(&w->memory, dyd_bytes_times(most, each), "the partners of a point");
}

/* Those of the discs that may bound something. */
static dyd_status take_disc_pairs(dyd_graph_work *w) {
  dyd_pair *item = dyd_alloc(w->discs->count, sizeof *item);
  w->pairs = (dyd_pair_list){0, item};
  if (!item) return DYD_E_NOMEM;
  for (size_t k = 0; k < w->discs->count; k++)
    if (w->discs->item[k].status >= w->least) item[w->pairs.count++] = w->discs->item[k];
  return DYD_OK;
}

static dyd_status graph_prepare(dyd_graph_work *w) {
  if (!graph_has_room(w)) return DYD_E_NOMEM;
  dyd_status st = w->discs ? take_disc_pairs(w) : dyd_pairs_take(&w->pairs, w->pd, w->least);
  if (st != DYD_OK) return st;
  size_t most = 0;
  w->box = dyd_alloc(w->n, sizeof *w->box);
  st = w->box ? dyd_pairs_deal(&w->start, &w->partner, &w->pairs, w->n) : DYD_E_NOMEM;
  if (st != DYD_OK) return st;
  for (size_t i = 0; i < w->n; i++) {
    dyd_sites_get_d(w->box[i].e, w->sites, i);
    if (w->start[i + 1] - w->start[i] > most) most = w->start[i + 1] - w->start[i];
  }
  if (!partners_have_room(w, most)) return DYD_E_NOMEM;
  w->other = dyd_alloc(most, sizeof *w->other);
  return w->other ? DYD_OK : DYD_E_NOMEM;
}

static void graph_work_clear(dyd_graph_work *w) {
  reach_clear(&w->reach);
  dyd_pair_list_clear(&w->pairs);
  dyd_free_all(w->start, w->partner, w->box, w->other);
}

dyd_status dyd_graph_of_discs(dyd_graph_list *out, const dyd_delaunay *pd, const dyd_pair_list *discs,
                              dyd_iv (*ball)[3], dyd_graph graph, const volatile int *cancel, dyd_error *err) {
  if (!pd) return dyd_fail_null(err);
  static dyd_status (*const make[])(dyd_graph_work *) = {nearest_graph, gabriel_graph, spanning_graph};
  if (err) dyd_error_clear(err);
  if (dyd_float_check(err) != DYD_OK) return DYD_E_ARG;
  if ((size_t)graph >= sizeof make / sizeof *make)
    return dyd_fail(err, DYD_E_ARG, "there is no graph number %d", (int)graph);
  if (dyd_delaunay_is_capped(pd))
    return dyd_fail(err, DYD_CAPPED, "there are more pairs than can be stored; raise `max_pairs`");
  dyd_graph_work w = {.pd = pd,
                      .sites = dyd_delaunay_sites(pd),
                      .discs = discs,
                      .ball = ball,
                      .cancel = cancel,
                      .memory = dyd_delaunay_memory_left(pd)};
  w.n = dyd_sites_count(w.sites);
  /* A tied pair is longer than those between on the rim [GRP-1] [GRP-2]; it may be a diameter of its circle. */
  w.least = graph == DYD_GRAPH_GABRIEL && !dyd_is_line(pd) ? DYD_TIE : dyd_least_bounding_true(pd);
  reach_init(&w.reach);
  dyd_status st = graph_prepare(&w);
  if (st == DYD_OK) st = make[graph](&w);
  graph_work_clear(&w);
  if (st != DYD_OK) {
    dyd_graph_list_clear(&w.out);
    if (st == DYD_E_NOMEM && w.memory.refused) return dyd_fail_memory(err, &w.memory);
    return dyd_fail(err, st, "%s", dyd_status_text(st));
  }
  dyd_graph_list_clear(out);
  *out = w.out;
  return DYD_OK;
}
