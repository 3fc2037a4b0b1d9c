/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* A rank: its begin and end, the order of its steps, and mail within one process. */
#include "base/local.h"
#include "tiles/tiles.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* From the input to sites with owners: samples, boxes of the plane, halos. */

enum { SAMPLES = 1 << 16 };

static bool mail_to_all(tile *t, const void *bytes, size_t count) {
  bool fits = true;
  for (size_t r = 0; fits && r < t->job->ranks; r++) fits = tiles_mail_put(&t->out[r], bytes, count);
  return fits;
}

/* ---- reading ---- */

static dyd_status check_site(const tile *t, uint64_t number, const double *e, dyd_error *err) {
  const unsigned dim = t->own.dim;
  const char *file = t->job->input;
  for (unsigned k = 0; k < dim; k++)
    if (!isfinite(e[k]))
      return dyd_fail(err, DYD_E_ARG, "%s: point %llu (byte %llu): not a finite number; leave the point out", file,
                      (unsigned long long)number, (unsigned long long)(number * dim + k) * sizeof *e);
  if (dim == 4 && (e[0] > e[1] || e[2] > e[3]))
    return dyd_fail(err, DYD_E_ARG,
                    "%s: point %llu (byte %llu): the lower end is above the upper one; --boxes reads xlo xhi ylo yhi",
                    file, (unsigned long long)number, (unsigned long long)(number * dim) * sizeof *e);
  return DYD_OK;
}

static dyd_status read_rows(tile *t, FILE *in, uint64_t first, uint64_t end, dyd_error *err) {
  enum { AT_ONCE = 4096 };
  const size_t size = t->own.dim * sizeof(double);
  double row[AT_ONCE * 4];
  dyd_status st = DYD_OK;
  while (first < end && st == DYD_OK) {
    size_t want = end - first < AT_ONCE ? (size_t)(end - first) : AT_ONCE, got = fread(row, size, want, in);
    if (got != want)
      return dyd_fail(err, DYD_E_IO, "%s: cannot read points %llu to %llu: %s; is the file still there, and whole?",
                      t->job->input, (unsigned long long)first, (unsigned long long)(end - 1),
                      ferror(in) ? strerror(errno) : "the file ends");
    for (size_t k = 0; k < got && st == DYD_OK; k++) {
      st = check_site(t, first + k, row + k * t->own.dim, err);
      if (st == DYD_OK && !tiles_sites_add(&t->own, first + k, row + k * t->own.dim)) st = tiles_no_memory(err);
    }
    first += got;
  }
  return st;
}

static dyd_status read_slice(tile *t, dyd_error *err) {
  t->points = t->job->size / (t->own.dim * sizeof(double));
  const uint64_t n = t->points, ranks = t->job->ranks;
  uint64_t first = n / ranks * t->rank + (t->rank < n % ranks ? t->rank : n % ranks);
  uint64_t end = first + n / ranks + (t->rank < n % ranks);
  if (!tiles_sites_reserve(&t->own, (size_t)(end - first))) return tiles_no_memory(err);
  FILE *in = fopen(t->job->input, "rb");
  if (!in || fseeko(in, (off_t)(first * t->own.dim * sizeof(double)), SEEK_SET) != 0) {
    if (in) fclose(in);
    return dyd_fail(err, DYD_E_IO, "%s: cannot read: %s; every rank needs to see the file", t->job->input,
                    strerror(errno));
  }
  dyd_status st = read_rows(t, in, first, end, err);
  fclose(in);
  return st;
}

/* Its slice of the input; out: a sample of it. */
static dyd_status tile_read(tile *t, dyd_error *err) {
  dyd_status st = t->job->text ? tile_read_text(t, err) : read_slice(t, err);
  size_t most = SAMPLES / t->job->ranks < 16 ? 16 : SAMPLES / t->job->ranks, step = t->own.count / most + 1;
  for (size_t k = 0; st == DYD_OK && k < t->own.count; k += step) {
    tiles_box b = tiles_sites_box(&t->own, k);
    const double place[2] = {b.x0, b.y0};
    if (!mail_to_all(t, place, sizeof place)) st = tiles_no_memory(err);
  }
  return st;
}

/* ---- boxes of the plane ---- */

static int compare_x(const void *a, const void *b) {
  const double *p = a, *q = b;
  return (p[0] > q[0]) - (p[0] < q[0]);
}

static int compare_y(const void *a, const void *b) {
  const double *p = a, *q = b;
  return (p[1] > q[1]) - (p[1] < q[1]);
}

typedef struct split_cut {
  unsigned along;
  double at;
} split_cut;

/* Cuts ranks first .. end-1 by the sample; the cut between ranks m-1 and m is cut[m]: those below, strictly, are before
 * it. */
static void split_ranks(split_cut *cut, double (*place)[2], size_t count, size_t first, size_t end) {
  if (end - first < 2) return;
  size_t middle = first + (end - first) / 2, at = count * (middle - first) / (end - first);
  tiles_box box = tiles_box_empty();
  for (size_t k = 0; k < count; k++) {
    tiles_box b = {place[k][0], place[k][0], place[k][1], place[k][1]};
    tiles_box_join(&box, &b);
  }
  cut[middle].along = tiles_box_is_tall(&box);
  qsort(place, count, sizeof *place, cut[middle].along ? compare_y : compare_x);
  cut[middle].at = count ? place[at][cut[middle].along] : 0;
  while (at > 0 && place[at - 1][cut[middle].along] == cut[middle].at) at--;
  split_ranks(cut, place, at, first, middle);
  split_ranks(cut, place + at, count - at, middle, end);
}

static size_t owner_of(const split_cut *cut, size_t ranks, const tiles_box *b) {
  size_t first = 0, end = ranks;
  while (end - first > 1) {
    size_t middle = first + (end - first) / 2;
    if ((cut[middle].along ? b->y0 : b->x0) < cut[middle].at)
      end = middle;
    else
      first = middle;
  }
  return first;
}

static bool take_sample(tiles_mail *all, const tile *t) {
  bool fits = true;
  for (size_t r = 0; fits && r < t->job->ranks; r++) fits = tiles_mail_put(all, t->in[r].bytes, t->in[r].count);
  return fits;
}

/* Boxes of the plane; out: points to their owners. */
static dyd_status tile_split(tile *t, dyd_error *err) {
  const size_t ranks = t->job->ranks;
  DYD_SCOPED(tiles_mail) sample = {0};
  DYD_FREED split_cut *cut = calloc(ranks, sizeof *cut);
  bool fits = cut && take_sample(&sample, t);
  if (fits && sample.count)
    split_ranks(cut, (double(*)[2])(void *)sample.bytes, sample.count / sizeof(double[2]), 0, ranks);
  for (size_t k = 0; fits && k < t->own.count; k++) {
    tiles_box b = tiles_sites_box(&t->own, k);
    fits = tiles_sites_put(&t->out[owner_of(cut, ranks, &b)], &t->own, k);
  }
  tiles_sites_clear(&t->own);
  return fits ? DYD_OK : tiles_no_memory(err);
}

/* ---- owners ---- */

static void describe_own(tile *t) {
  tiles_info *own = &t->info[t->rank];
  own->box = tiles_box_empty();
  own->count = t->counters.own = t->own.count;
  for (size_t k = 0; k < t->own.count; k++) {
    tiles_box b = tiles_sites_box(&t->own, k);
    tiles_box_join(&own->box, &b);
    own->wide += !tiles_box_is_point(&b);
  }
  own->digest = tile_digest(t);
  own->seen = tiles_box_wider(&own->box, t->own.count, t->job->halo);
}

static uint64_t tiles_view_number(const tiles_view *v, size_t k) {
  return k < v->first->count ? v->first->number[k] : v->second->number[k - v->first->count];
}

/* Adds site k of the view to a table. */
static bool tiles_sites_copy(tiles_sites *s, const tiles_view *v, size_t k) {
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

static bool tiles_set_has(const tiles_set *s, uint32_t site) {
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

static bool tiles_set_add(tiles_set *s, uint32_t site) {
  if (2 * (s->count + 1) > s->cap && !set_grow(s)) return false;
  size_t at = set_place(s, site);
  if (!s->slot[at]) s->count++;
  s->slot[at] = site + 1;
  return true;
}

static void tiles_set_clear(tiles_set *s) {
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

static void tiles_graph_clear(tiles_graph *g) {
  dyd_free_all(g->start, g->partner);
  *g = (tiles_graph){0};
}

static void tile_end_engine(tile *t) {
  tiles_graph_clear(&t->graph);
  dyd_engine_free(t->engine);
  t->engine = NULL;
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

/* Adds the rows of site i of the view: pairs with higher numbers. */
static dyd_status tile_rows_of(tiles_rows *rows, tile *t, const tiles_view *v, uint32_t i, dyd_error *err) {
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

static bool tile_has_wide(const tile *t) {
  uint64_t wide = 0;
  for (size_t r = 0; r < t->job->ranks; r++) wide += t->info[r].wide;
  return wide > 0;
}

/* Broadcasts the extreme site in each direction. */
static bool tell_corners(tile *t) {
  bool fits = true;
  for (unsigned k = 0; fits && t->own.count && k < t->job->corners; k++) {
    size_t corner = tiles_farthest(&t->own, k, t->job->corners);
    if (tiles_set_has(&t->sent[t->rank], (uint32_t)corner)) continue;
    for (size_t r = 0; fits && r < t->job->ranks; r++)
      fits = tiles_set_add(&t->sent[r], (uint32_t)corner) && tiles_sites_put(&t->out[r], &t->own, corner);
  }
  return fits;
}

/* Its own sites; out: where they are, and corners of their hull. */
static dyd_status tile_own(tile *t, dyd_error *err) {
  size_t count = 0;
  for (size_t r = 0; r < t->job->ranks; r++) count += t->in[r].count / tiles_sites_bytes(&t->own);
  bool fits = tiles_sites_reserve(&t->own, count);
  for (size_t r = 0; fits && r < t->job->ranks; r++) {
    size_t read = 0;
    fits = tiles_sites_take(&t->own, &t->in[r], &read);
    tiles_mail_clear(&t->in[r]);
  }
  if (!fits) return tiles_no_memory(err);
  if (t->own.count >= DYD_MAX_SITES)
    return dyd_fail(err, DYD_E_RANGE, "rank %zu: %zu points are too many for one; use more ranks", t->rank,
                    t->own.count);
  describe_own(t);
  if (!mail_to_all(t, &t->info[t->rank], sizeof *t->info) || !tell_corners(t)) return tiles_no_memory(err);
  tiles_set_clear(&t->sent[t->rank]);
  return DYD_OK;
}

/* Ascending: of equal points the lowest comes first, and represents the others there, too. */
static dyd_status halo_for(tile *t, size_t r, dyd_error *err) {
  bool fits = true;
  if (!tiles_boxes_meet(&t->info[r].seen, &t->info[t->rank].box)) return DYD_OK;
  for (uint32_t k = 0; fits && k < t->own.count; k++) {
    tiles_box b = tiles_sites_box(&t->own, k);
    if (tiles_boxes_meet(&t->info[r].seen, &b) && !tiles_set_has(&t->sent[r], k))
      fits = tiles_set_add(&t->sent[r], k) && tiles_sites_put(&t->out[r], &t->own, k);
  }
  return fits ? DYD_OK : tiles_no_memory(err);
}

/* Out: sites near the boxes of others. */
static dyd_status tile_halo(tile *t, dyd_error *err) {
  dyd_status st = DYD_OK;
  for (size_t r = 0; r < t->job->ranks; r++) {
    size_t read = 0;
    if (!tiles_mail_take(&t->info[r], sizeof *t->info, &t->in[r], &read))
      return dyd_fail(err, DYD_E_IO, "rank %zu: the mail of rank %zu is cut short; restart", t->rank, r);
    if (r != t->rank && !tiles_sites_take(&t->ghosts, &t->in[r], &read)) return tiles_no_memory(err);
  }
  for (size_t r = 0; st == DYD_OK && r < t->job->ranks; r++)
    if (r != t->rank && t->info[r].count) st = halo_for(t, r, err);
  return st == DYD_OK ? tile_find_part(t, err) : st;
}

/* The statements of one rank: pairs on which no unseen site has an influence [REACH-1] [TILE-1].
 *
 * The first triangulation, of all own sites and the halo, settles nearly all of them. Those left, their partners and
 * the ghosts are the fringe: it is triangulated alone, and grows by the answers of owners (the rank itself is one). */

/* ---- the tree over own sites ---- */

enum { LEAF = 32 };

typedef struct tree_maker {
  tiles_tree *t;
  const tiles_sites *s;
  unsigned along; /* which coordinate is compared: 0 x, 1 y */
} tree_maker;

static double key_of(const tree_maker *m, size_t k) {
  const double *e = m->s->end + m->t->order[k] * (size_t)m->s->dim;
  return e[m->along * (m->s->dim / 2)];
}

static void swap_order(uint32_t *order, size_t a, size_t b) {
  uint32_t kept = order[a];
  order[a] = order[b];
  order[b] = kept;
}

/* Puts order[lo .. hi] such that no key before `at` is larger than a key from there on (Hoare's selection). */
static void tree_select(const tree_maker *m, ptrdiff_t lo, ptrdiff_t hi, ptrdiff_t at) {
  while (lo < hi) {
    double pivot = key_of(m, (size_t)at);
    ptrdiff_t i = lo, j = hi;
    while (i <= j) {
      while (key_of(m, (size_t)i) < pivot) i++;
      while (key_of(m, (size_t)j) > pivot) j--;
      if (i <= j) swap_order(m->t->order, (size_t)i++, (size_t)j--);
    }
    if (j < at) lo = i;
    if (at < i) hi = j;
  }
}

static tiles_box box_of_range(const tree_maker *m, size_t lo, size_t hi) {
  tiles_box all = tiles_box_empty();
  for (size_t k = lo; k < hi; k++) {
    tiles_box b = tiles_sites_box(m->s, m->t->order[k]);
    tiles_box_join(&all, &b);
  }
  return all;
}

static void tree_node(tree_maker *m, size_t node, size_t lo, size_t hi) {
  tiles_box *box = &m->t->box[node];
  *box = box_of_range(m, lo, hi);
  if (hi - lo <= LEAF) return;
  size_t middle = lo + (hi - lo) / 2;
  m->along = tiles_box_is_tall(box);
  tree_select(m, (ptrdiff_t)lo, (ptrdiff_t)hi - 1, (ptrdiff_t)middle);
  tree_node(m, 2 * node, lo, middle);
  tree_node(m, 2 * node + 1, middle, hi);
}

static bool tiles_tree_make(tiles_tree *t, const tiles_sites *s) {
  size_t nodes = 2;
  for (size_t n = s->count; n > LEAF; n = (n + 1) / 2) nodes *= 2;
  *t = (tiles_tree){.count = s->count};
  if (s->count == 0) return true;
  t->order = malloc(s->count * sizeof *t->order);
  t->box = malloc(nodes * sizeof *t->box);
  if (!t->order || !t->box) return false;
  for (size_t k = 0; k < s->count; k++) t->order[k] = (uint32_t)k;
  tree_maker m = {t, s, 0};
  tree_node(&m, 1, 0, s->count);
  return true;
}

/* false: memory is exhausted. O(n log n). */
static void tiles_tree_clear(tiles_tree *t) {
  dyd_free_all(t->order, t->box);
  *t = (tiles_tree){0};
}

static bool is_too_late(const tiles_search *q, double score) {
  return score == INFINITY || (q->count == q->most && score >= q->score[q->count - 1]);
}

static bool search_take(tiles_search *q, uint32_t site, double score) {
  if (q->count < q->most) {
    if (!DYD_GROW(q->site, q->cap_site, q->count + 1)) return false;
    if (!DYD_GROW(q->score, q->cap_score, q->count + 1)) return false;
    q->count++;
  }
  size_t at = q->count - 1;
  for (; at > 0 && q->score[at - 1] > score; at--) {
    q->score[at] = q->score[at - 1];
    q->site[at] = q->site[at - 1];
  }
  q->site[at] = site;
  q->score[at] = score;
  return true;
}

static bool search_node(tiles_search *q, const tiles_tree *t, const tiles_sites *s, size_t node, size_t lo, size_t hi) {
  if (is_too_late(q, tiles_disc_score(q->disc, &t->box[node]))) return true;
  if (hi - lo > LEAF) {
    size_t middle = lo + (hi - lo) / 2;
    return search_node(q, t, s, 2 * node, lo, middle) && search_node(q, t, s, 2 * node + 1, middle, hi);
  }
  for (size_t k = lo; k < hi; k++) {
    if (tiles_set_has(q->skip, t->order[k]) || (q->alias && q->alias[t->order[k]])) continue;
    tiles_box b = tiles_sites_box(s, t->order[k]);
    double score = tiles_disc_score(q->disc, &b);
    if (!is_too_late(q, score) && !search_take(q, t->order[k], score)) return false;
  }
  return true;
}

static bool tiles_tree_search(tiles_search *q, const tiles_tree *t, const tiles_sites *s) {
  q->count = 0;
  return t->count == 0 || search_node(q, t, s, 1, 0, t->count);
}

/* Replaces the answer. false: memory is exhausted. */
static void tiles_search_clear(tiles_search *q) {
  dyd_free_all(q->site, q->score);
  *q = (tiles_search){.disc = q->disc};
}

/* Marks of a site: an unseen site may meet its discs; its pairs are not settled. */
enum { MET = 1, LATE = 2 };

/* ---- discs ---- */

/* Nothing that the rank has not seen meets the disc; own sites outside of the fringe count when `self`. */
static dyd_status disc_is_unmet(bool *clear, tile *t, const tiles_disc *d, bool self, dyd_error *err) {
  *clear = true;
  if (!tiles_disc_is_inside(d, &t->info[t->rank].seen))
    for (size_t r = 0; *clear && r < t->job->ranks; r++)
      *clear = r == t->rank || t->info[r].count == 0 || !tiles_disc_may_meet(d, &t->info[r].box);
  if (!*clear || !self) return DYD_OK;
  tiles_search *q = &t->search;
  q->disc = d;
  q->skip = &t->sent[t->rank];
  q->alias = t->alias;
  q->most = 1;
  if (!tiles_tree_search(q, &t->tree, &t->own)) return tiles_no_memory(err);
  *clear = q->count == 0;
  return DYD_OK;
}

/* Sets *clear to whether it is so of every disc that the pairs of site i of the view depend on. */
static dyd_status reach_is_unmet(bool *clear, tile *t, const tiles_view *v, uint32_t i, const tiles_partners *p,
                                 dyd_error *err) {
  if (!tiles_reach_find(&t->reach, v, i, p)) return tiles_no_memory(err);
  dyd_status st = DYD_OK;
  *clear = true;
  for (size_t k = 0; *clear && st == DYD_OK && k < t->reach.count; k++)
    st = disc_is_unmet(clear, t, &t->reach.item[k], false, err);
  return st;
}

/* ---- the first triangulation ---- */

/* Equal points have one owner, since places have one. */
static dyd_status first_aliases(tile *t, const tiles_view *v, dyd_error *err) {
  const dyd_delaunay *pd = dyd_engine_delaunay(t->engine);
  dyd_status st = DYD_OK;
  t->alias = calloc(tiles_view_count(v) + 1, sizeof *t->alias);
  if (!t->alias) return tiles_no_memory(err);
  for (size_t i = 0; st == DYD_OK && i < tiles_view_count(v); i++) {
    uint32_t of = dyd_delaunay_alias(pd, (uint32_t)i);
    t->alias[i] = of != i;
    if (of != i && i < t->own.count)
      st = tiles_rows_add(&t->aliases, (tiles_row){t->own.number[i], t->own.number[of], 0}, err);
  }
  return st;
}

static dyd_status mark_site(tile *t, const tiles_view *v, uint32_t i, dyd_error *err) {
  bool closed = true;
  tiles_partners p;
  dyd_status st = tile_partners(&p, t, i, err);
  if (st == DYD_OK && !t->alias[i]) st = reach_is_unmet(&closed, t, v, i, &p, err);
  t->mark[i] = closed ? 0 : MET | LATE;
  return st;
}

/* A legal pair with a rectangle stays one when no site meets the discs of its ends. */
static dyd_status legal_marks(tile *t, const tiles_view *v, dyd_error *err) {
  dyd_status st = DYD_OK;
  for (uint32_t i = 0; st == DYD_OK && i < t->own.count; i++) {
    tiles_partners p = {0};
    if (!(t->mark[i] & LATE)) st = tile_partners(&p, t, i, err);
    for (size_t k = 0; k < p.count && !(t->mark[i] & LATE); k++) {
      uint32_t j = TILES_SITE(p.item[k]);
      tiles_box a = tiles_view_box(v, i), b = tiles_view_box(v, j);
      if (TILES_STATUS(p.item[k]) != DYD_LEGAL || tiles_view_number(v, j) < t->own.number[i]) continue;
      if (tiles_box_is_point(&a) && tiles_box_is_point(&b)) continue;
      if (t->mark[j] & MET) t->mark[i] |= LATE;
    }
  }
  return st;
}

/* Where there are rectangles, own sites and ghosts: both may be ends of legal pairs. */
static dyd_status wide_marks(tile *t, const tiles_view *v, dyd_error *err) {
  dyd_status st = DYD_OK;
  for (uint32_t i = 0; st == DYD_OK && i < tiles_view_count(v); i++) st = mark_site(t, v, i, err);
  return st == DYD_OK ? legal_marks(t, v, err) : st;
}

/* Rows of settled sites go out; the other sites become the fringe. */
static dyd_status first_rows(tile *t, const tiles_view *v, dyd_error *err) {
  enum { AT_ONCE = 1 << 12 };
  const bool wide = tile_has_wide(t);
  dyd_status st = DYD_OK;
  t->mark = calloc(tiles_view_count(v) + 1, 1);
  if (!t->mark) return tiles_no_memory(err);
  if (wide) st = wide_marks(t, v, err);
  for (uint32_t i = 0; st == DYD_OK && i < t->own.count; i++) {
    if (!wide) st = mark_site(t, v, i, err);
    if (t->mark[i] & LATE)
      t->late_count++;
    else if (st == DYD_OK)
      st = tile_rows_of(&t->rows, t, v, i, err);
    if (st == DYD_OK && (t->rows.count >= AT_ONCE || i + 1 == t->own.count)) {
      st = tile_spool(t, &t->rows, err);
      t->rows.count = 0;
    }
  }
  t->counters.late = t->late_count;
  return st;
}

/* Late sites and their own partners, ascending; then ghosts that are not aliases. */
static dyd_status first_fringe(tile *t, const tiles_view *v, dyd_error *err) {
  enum { PARTNER = 4 };
  bool fits = true;
  size_t late = 0;
  dyd_status st = DYD_OK;
  for (uint32_t i = 0; st == DYD_OK && i < t->own.count; i++) {
    tiles_partners p = {0};
    if (t->mark[i] & LATE) st = tile_partners(&p, t, i, err);
    for (size_t k = 0; k < p.count; k++) t->mark[TILES_SITE(p.item[k])] |= PARTNER;
  }
  if (st != DYD_OK) return st;
  t->late = calloc(t->late_count + 1, sizeof *t->late);
  if (!t->late) return tiles_no_memory(err);
  for (uint32_t i = 0; fits && i < t->own.count; i++) {
    if (t->mark[i] & LATE) t->late[late++] = t->fringe.count;
    if (t->mark[i] & (LATE | PARTNER)) fits = tiles_set_add(&t->sent[t->rank], i) && tiles_sites_copy(&t->fringe, v, i);
  }
  for (size_t i = t->own.count; fits && i < tiles_view_count(v); i++)
    if (!t->alias[i]) fits = tiles_sites_copy(&t->fringe, v, i);
  return fits ? DYD_OK : tiles_no_memory(err);
}

/* Now a rank needs the most memory: only the engine keeps places. */
static dyd_status first_settle(tile *t, dyd_error *err) {
  tiles_view v;
  dyd_status st = tile_load(&v, t, &t->own, &t->ghosts, err);
  if (st == DYD_OK) st = tile_park(t, err);
  tiles_sites_end(&t->ghosts);
  if (st == DYD_OK) st = tile_triangulate(t, err);
  if (st == DYD_OK) st = first_aliases(t, &v, err);
  if (st == DYD_OK) st = first_rows(t, &v, err);
  if (st == DYD_OK) st = first_fringe(t, &v, err);
  free(t->mark);
  t->mark = NULL;
  tile_end_engine(t);
  return st == DYD_OK ? tile_unpark(t, err) : st;
}

/* ---- the fringe ---- */

static dyd_status fringe_ask(tile *t, const tiles_disc *d, dyd_error *err) {
  bool clear;
  dyd_status st = disc_is_unmet(&clear, t, d, true, err);
  if (st != DYD_OK || clear) return st;
  const bool inside = tiles_disc_is_inside(d, &t->info[t->rank].seen);
  for (size_t r = 0; r < t->job->ranks; r++) {
    if (t->info[r].count == 0 || (inside && r != t->rank) || !tiles_disc_may_meet(d, &t->info[r].box)) continue;
    if (!tiles_mail_put(&t->out[r], d, sizeof *d)) return tiles_no_memory(err);
  }
  t->asked++;
  return DYD_OK;
}

static dyd_status fringe_discs(tile *t, const tiles_view *v, uint32_t i, dyd_error *err) {
  tiles_partners p;
  dyd_status st = tile_partners(&p, t, i, err);
  if (st == DYD_OK && !tiles_reach_find(&t->reach, v, i, &p)) st = tiles_no_memory(err);
  for (size_t k = 0; st == DYD_OK && k < t->reach.count; k++) st = fringe_ask(t, &t->reach.item[k], err);
  return st;
}

/* The disc about the witness of a legal pair with a rectangle. */
static dyd_status fringe_witness(tile *t, const tiles_view *v, uint32_t i, uint32_t j, dyd_error *err) {
  tiles_box a = tiles_view_box(v, i), b = tiles_view_box(v, j);
  DYD_LOCAL(dyd_point, c);
  dyd_status st = dyd_delaunay_witness(&c, dyd_engine_delaunay(t->engine), i, j);
  const double centre[2] = {dyd_dyadic_get_d(&c.x, DYD_DOWN), dyd_dyadic_get_d(&c.y, DYD_DOWN)};
  tiles_disc d = tiles_witness_disc(centre, &a, &b);
  return st == DYD_OK ? fringe_ask(t, &d, err) : dyd_fail(err, st, "%s", dyd_status_text(st));
}

static dyd_status fringe_legal(tile *t, const tiles_view *v, uint32_t i, dyd_error *err) {
  tiles_partners p;
  tiles_box a = tiles_view_box(v, i);
  dyd_status st = tile_partners(&p, t, i, err);
  for (size_t k = 0; st == DYD_OK && k < p.count; k++) {
    uint32_t j = TILES_SITE(p.item[k]);
    tiles_box b = tiles_view_box(v, j);
    if (TILES_STATUS(p.item[k]) != DYD_LEGAL || tiles_view_number(v, j) < tiles_view_number(v, i)) continue;
    if (!tiles_box_is_point(&a) || !tiles_box_is_point(&b)) st = fringe_witness(t, v, i, j, err);
  }
  return st;
}

static dyd_status fringe_check(tile *t, const tiles_view *v, dyd_error *err) {
  dyd_status st = DYD_OK;
  for (size_t k = 0; st == DYD_OK && k < t->late_count; k++) {
    st = fringe_discs(t, v, (uint32_t)t->late[k], err);
    if (st == DYD_OK && tile_has_wide(t)) st = fringe_legal(t, v, (uint32_t)t->late[k], err);
  }
  return st;
}

static dyd_status fringe_finish(tile *t, const tiles_view *v, dyd_error *err) {
  dyd_status st = DYD_OK;
  t->rows.count = 0;
  for (size_t k = 0; st == DYD_OK && k < t->late_count; k++)
    st = tile_rows_of(&t->rows, t, v, (uint32_t)t->late[k], err);
  if (st == DYD_OK) st = tile_write_part(t, err);
  tile_end_engine(t);
  t->done = true;
  return st;
}

static dyd_status tile_fringe(tile *t, dyd_error *err) {
  static const tiles_sites none = {.dim = 2};
  tiles_view v = {&t->fringe, &none, NULL};
  dyd_status st = DYD_OK;
  t->asked = 0;
  t->counters.fringe = t->fringe.count;
  if (t->late_count) st = tile_load(&v, t, &t->fringe, &none, err);
  if (st == DYD_OK && t->late_count) st = tile_triangulate(t, err);
  if (st == DYD_OK && t->late_count) st = fringe_check(t, &v, err);
  if (st == DYD_OK && t->asked == 0) st = fringe_finish(t, &v, err);
  return st;
}

/* ---- steps ---- */

/* Triangulates; out: discs. */
static dyd_status tile_first(tile *t, dyd_error *err) {
  for (size_t r = 0; r < t->job->ranks; r++) {
    size_t read = 0;
    if (r != t->rank && !tiles_sites_take(&t->ghosts, &t->in[r], &read)) return tiles_no_memory(err);
    tiles_mail_clear(&t->in[r]);
  }
  t->counters.ghosts = t->ghosts.count;
  dyd_status st = !t->done && t->own.count ? first_settle(t, err) : DYD_OK;
  tiles_sites_clear(&t->ghosts);
  if (st == DYD_OK && !tiles_tree_make(&t->tree, &t->own)) st = tiles_no_memory(err);
  return st == DYD_OK && !t->done ? tile_fringe(t, err) : st;
}

static dyd_status answer_disc(tile *t, size_t r, const tiles_disc *d, dyd_error *err) {
  tiles_search *q = &t->search;
  enum { PATIENCE = 4, MOST_DOUBLINGS = 20 };
  uint64_t doublings = t->counters.rounds / PATIENCE;
  q->disc = d;
  q->skip = &t->sent[r];
  q->alias = t->alias;
  q->most = t->job->nearest << (doublings < MOST_DOUBLINGS ? doublings : MOST_DOUBLINGS);
  bool fits = tiles_tree_search(q, &t->tree, &t->own);
  for (size_t k = 0; fits && k < q->count; k++)
    fits = tiles_set_add(&t->sent[r], q->site[k]) && tiles_sites_put(&t->out[r], &t->own, q->site[k]);
  return fits ? DYD_OK : tiles_no_memory(err);
}

/* Out: the nearest sites in the discs asked for. */
static dyd_status tile_answer(tile *t, dyd_error *err) {
  dyd_status st = DYD_OK;
  for (size_t r = 0; r < t->job->ranks; r++) {
    tiles_disc d;
    for (size_t read = 0; st == DYD_OK && tiles_mail_take(&d, sizeof d, &t->in[r], &read);)
      st = answer_disc(t, r, &d, err);
    tiles_mail_clear(&t->in[r]);
  }
  t->counters.rounds++;
  return st;
}

/* Triangulates the fringe; out: discs. */
static dyd_status tile_extend(tile *t, dyd_error *err) {
  const size_t before = t->fringe.count;
  for (size_t r = 0; r < t->job->ranks; r++) {
    size_t read = 0;
    if (!tiles_sites_take(&t->fringe, &t->in[r], &read)) return tiles_no_memory(err);
    if (r != t->rank) t->counters.ghosts += t->in[r].count / tiles_sites_bytes(&t->own);
    tiles_mail_clear(&t->in[r]);
  }
  if (t->done || t->asked == 0) return DYD_OK;
  if (t->fringe.count > before) return tile_fringe(t, err);
  t->asked = 0;
  static const tiles_sites none = {.dim = 2};
  tiles_view v = {&t->fringe, &none, dyd_engine_sites(t->engine)};
  return fringe_finish(t, &v, err);
}

/* At the end; out: counters, to rank 0. */
static dyd_status tile_report(tile *t, dyd_error *err) {
  return tiles_mail_put(&t->out[0], &t->counters, sizeof t->counters) ? DYD_OK : tiles_no_memory(err);
}

dyd_status tile_new(tile *t, const tiles_job *job, size_t rank, dyd_error *err) {
  const unsigned dim = job->boxes ? 4 : 2;
  *t = (tile){.job = job, .rank = rank, .own.dim = dim, .ghosts.dim = dim, .fringe.dim = dim};
  t->in = calloc(job->ranks, sizeof *t->in);
  t->out = calloc(job->ranks, sizeof *t->out);
  t->info = calloc(job->ranks, sizeof *t->info);
  t->sent = calloc(job->ranks, sizeof *t->sent);
  return t->in && t->out && t->info && t->sent ? DYD_OK : tiles_no_memory(err);
}

void tile_free(tile *t) {
  for (size_t r = 0; r < t->job->ranks; r++) {
    if (t->in) tiles_mail_clear(&t->in[r]);
    if (t->out) tiles_mail_clear(&t->out[r]);
    if (t->sent) tiles_set_clear(&t->sent[r]);
  }
  dyd_free_all(t->in, t->out, t->info, t->sent);
  tiles_sites_clear(&t->own);
  tiles_sites_clear(&t->ghosts);
  tiles_sites_clear(&t->fringe);
  tiles_tree_clear(&t->tree);
  tiles_graph_clear(&t->graph);
  tiles_reach_clear(&t->reach);
  tiles_search_clear(&t->search);
  dyd_engine_free(t->engine);
  dyd_free_all(t->alias, t->mark, t->late, t->rows.item, t->aliases.item);
  if (t->spool) fclose(t->spool);
  if (t->parked) fclose(t->parked);
}

/* ---- the order of steps, and mail within one process ---- */

static dyd_status carry_in_memory(tile *member, size_t count, dyd_error *err) {
  (void)err;
  for (size_t from = 0; from < count; from++)
    for (size_t to = 0; to < count; to++) {
      tiles_mail *mail = &member[from].out[to];
      if (from != to) member[from].counters.sent += mail->count;
      tiles_mail_clear(&member[to].in[from]);
      member[to].in[from] = *mail;
      *mail = (tiles_mail){0};
    }
  return DYD_OK;
}

static bool any_in_memory(bool here) {
  return here;
}

const tiles_carrier tiles_in_memory = {carry_in_memory, any_in_memory};

/* Each step takes the mail in t->in and writes t->out. *err names the remedy. */
typedef dyd_status step_fn(tile *t, dyd_error *err);

typedef struct step_crew {
  tile *member;
  size_t count;
  const tiles_carrier *by;
  bool elsewhere;
  dyd_error *err;
} step_crew;

/* One step of all; false: a rank failed. */
static bool step_all(dyd_status *st, step_crew *c, step_fn *step) {
  for (size_t k = 0; *st == DYD_OK && k < c->count; k++) *st = step(&c->member[k], c->err);
  if (c->by->any(*st != DYD_OK)) {
    c->elsewhere = *st == DYD_OK;
    return false;
  }
  *st = c->by->carry(c->member, c->count, c->err);
  return *st == DYD_OK;
}

static bool anybody_asks(const step_crew *c) {
  bool here = false;
  for (size_t k = 0; k < c->count; k++) here |= c->member[k].asked > 0;
  return c->by->any(here);
}

dyd_status tiles_drive(tile *member, size_t count, const tiles_carrier *by, bool *elsewhere, dyd_error *err) {
  static step_fn *const begin[] = {tile_survey, tile_read, tile_split, tile_own, tile_halo, tile_first};
  step_crew c = {member, count, by, false, err};
  dyd_status st = DYD_OK;
  bool on = true;
  for (size_t k = 0; on && k < sizeof begin / sizeof *begin; k++) on = step_all(&st, &c, begin[k]);
  while (on && anybody_asks(&c)) on = step_all(&st, &c, tile_answer) && step_all(&st, &c, tile_extend);
  if (on && step_all(&st, &c, tile_report)) {
    if (member[0].rank == 0) st = tile_write_manifest(&member[0], err);
    c.elsewhere = by->any(st != DYD_OK) && st == DYD_OK;
  }
  *elsewhere = c.elsewhere;
  return st;
}
