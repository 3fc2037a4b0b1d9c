/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Rows: one for each pair, sorted in the end by i, then j; deaths, births, and the whole. */
#include "base/alloc.h"
#include "base/error.h"
#include "base/flag.h"
#include "base/index.h"
#include "base/parallel.h"
#include "delaunay/state.h"
#include "dyadic/raw.h"
#include "rect/rect.h"
#include "tolerance/lines.h"
#include "tolerance/state.h"

/* Rows that are worked on together; that are sorted by hand. */
enum { SHARE = 64, FEW = 32 };

/* ---- rows ---- */

bool dyd_rows_have_room(dyd_tolerance *t, uint64_t pairs, const char *what) {
  bool rings = t->options.points || t->sigma;
  uint64_t each = 2 * sizeof *t->row + (rings ? sizeof *t->ring + sizeof *t->chance : 0);
  uint64_t bytes = dyd_bytes_times(pairs, each);
  if (!dyd_memory_has(&t->memory, bytes, what)) return false;
  t->memory.held = dyd_bytes_add(t->memory.held, t->memory.most ? bytes : 0);
  return true;
}

static dyd_tolerance_row row_of_summit(const dyd_tolerance *t, uint32_t v, uint32_t w, dyd_tolerance_event event) {
  const dyd_summit *s = &t->summit;
  double lo = HUGE_VAL, hi = HUGE_VAL;
  if (s->binding == DYD_BINDING_NONE) return dyd_row_of(t, v, w, event, DYD_NONE, DYD_NONE, lo, hi);
  dyd_roots_half(&lo, &hi, s->plus, s->minus);
  return dyd_row_of(t, v, w, event, t->lines.item[s->a].vertex, t->lines.item[s->b].vertex, lo, hi);
}

dyd_status dyd_row_add(dyd_tolerance *t, dyd_tolerance_row row) {
  if (!DYD_GROW(t->row, t->cap, t->rows + 1)) return DYD_E_NOMEM;
  t->row[t->rows++] = row;
  return DYD_OK;
}

/* Which rows are finished: by ranges of SHARE rows. */
typedef struct quick_rows {
  const dyd_tolerance *t;
  size_t first;
  bool *done;
} quick_rows;

static void rework_quickly(void *context, size_t number) {
  const quick_rows *q = context;
  const dyd_tolerance *t = q->t;
  dyd_others spare = {0};
  size_t begin = q->first + number * SHARE, end = begin + SHARE < t->rows ? begin + SHARE : t->rows;
  for (size_t k = begin; k < end && !dyd_flag_is_set(t->options.cancel); k++) {
    dyd_tolerance_row *row = &t->row[k];
    if (row->event == DYD_EVENT_BIRTH)
      q->done[k] = row->hi < HUGE_VAL; /* made when it was listed */
    else if (row->event == DYD_EVENT_DEATH && row->hi != DYD_UNREACHED)
      q->done[k] = dyd_filter_moved_death(row, t, &spare);
  }
  free(spare.vertex);
}

static dyd_status rework_slowly(dyd_tolerance *t, size_t first, const bool *done, dyd_row_work *work, void *user) {
  size_t kept = first;
  bool cut = false;
  dyd_status st = DYD_OK;
  for (size_t k = first; k < t->rows && st == DYD_OK; k++) {
    dyd_tolerance_row *row = &t->row[k];
    bool late = false, open = !done[k] && row->event != DYD_EVENT_TIE && row->hi != DYD_UNREACHED;
    cut = cut || dyd_flag_is_set(t->options.cancel);
    if (cut && open)
      row->hi = DYD_UNREACHED;
    else if (open)
      st = work(&late, row, user);
    if (!late) t->row[kept++] = *row;
  }
  t->rows = kept;
  return st == DYD_OK && cut ? DYD_CANCELLED : st;
}

dyd_status dyd_rows_rework(dyd_tolerance *t, size_t first, dyd_row_work *work, void *user) {
  DYD_FREED bool *done = calloc(t->rows + 1, sizeof *done);
  quick_rows q = {t, first, done};
  if (!done) return DYD_E_NOMEM;
  if (!t->options.no_filter) dyd_parallel(t->pd->options.threads, (t->rows - first) / SHARE + 1, rework_quickly, &q);
  return rework_slowly(t, first, done, work, user);
}

void dyd_rows_reached(dyd_tolerance *t) {
  size_t kept = 0, count[4];
  dyd_delaunay_count(count, t->pd);
  t->result.edges_left = count[DYD_LEGAL];
  for (size_t k = 0; k < t->rows; k++) {
    const dyd_tolerance_row *row = &t->row[k];
    bool reached = row->hi != DYD_UNREACHED;
    t->result.edges_left -= reached && row->event == DYD_EVENT_DEATH;
    t->result.births_left += !reached && row->event == DYD_EVENT_BIRTH && t->result.births_left != SIZE_MAX;
    if (reached) t->row[kept++] = *row;
  }
  t->rows = kept;
  t->sorted = 0;
}

/* A short run, such as nearly all sites have. */
static void sort_few_rows(dyd_tolerance_row *row, size_t count) {
  for (size_t q = 1; q < count; q++) {
    dyd_tolerance_row r = row[q];
    size_t at = q;
    for (; at && row[at - 1].j > r.j; at--) row[at] = row[at - 1];
    row[at] = r;
  }
}

/* Rows of one i, by j. */
static void rows_sort_site(dyd_tolerance_row *row, size_t count) {
  if (count > FEW)
    qsort(row, count, sizeof *row, dyd_compare_two);
  else
    sort_few_rows(row, count);
}

size_t dyd_row_find(const dyd_tolerance *t, uint32_t v, uint32_t w) {
  uint32_t a = t->sk->reps.site[v], b = t->sk->reps.site[w];
  const dyd_tolerance_row pair = {.i = a < b ? a : b, .j = a < b ? b : a};
  size_t lo = 0, hi = t->rows;
  while (lo < hi) {
    size_t mid = lo + (hi - lo) / 2;
    if (dyd_compare_two(&t->row[mid], &pair) < 0)
      lo = mid + 1;
    else
      hi = mid;
  }
  return lo;
}

/* Dealt to the sites i, then each site's by j. Deaths alone are sorted as they come. */
dyd_status dyd_rows_sort(dyd_tolerance *t) {
  if (t->rows == t->sorted) return DYD_OK;
  size_t n = t->sk->n, *start = calloc(n + 2, sizeof *start);
  dyd_tolerance_row *to = dyd_alloc(t->rows, sizeof *to);
  if (!start || !to) {
    dyd_free_all(start, to);
    return DYD_E_NOMEM;
  }
  for (size_t k = 0; k < t->rows; k++) start[t->row[k].i + 2]++;
  for (size_t i = 1; i <= n; i++) start[i + 1] += start[i];
  for (size_t k = 0; k < t->rows; k++) to[start[t->row[k].i + 1]++] = t->row[k];
  for (size_t i = 0; i < n; i++) rows_sort_site(to + start[i], start[i + 1] - start[i]);
  dyd_free_all(start, t->row);
  t->row = to;
  t->cap = t->rows;
  return DYD_OK;
}

/* ---- deaths ---- */

/* Only Delaunay neighbours of i or j can bind [TOL-4]; where one of them is a hub, few of its neighbours do, and a
 * search finds the others that are near enough.
 *
 * Ranges of vertices are worked on side by side, in doubles, each edge with the end whose site has the smaller number:
 * all rows of a site are made together, at their final place. Vertices are in spatial order, so neighbours are near in
 * memory. What doubles do not decide comes later, one by one. */

enum { AHEAD = 8 };

/* An edge, its apexes, and where its circle goes. */
typedef struct death_edge {
  uint32_t v, w, apex[2];
  size_t ring;
} death_edge;

typedef struct death_part {
  dyd_lines_d lines;
  dyd_batch_d batch;
  death_edge edge[DYD_BATCH];
  dyd_tolerance_row *row[DYD_BATCH];
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

/* t->summit becomes that of the legal pair of vertices v, w. */
static dyd_status death_exact(dyd_tolerance *t, uint32_t v, uint32_t w) {
  uint32_t hub = t->start && has_hub(t, v, w) ? DYD_HUB : UINT32_MAX;
  dyd_status st = dyd_others_around(&t->others, t, v, w, hub);
  for (bool more = true, again = false; st == DYD_OK && more; again = true) {
    st = dyd_lines_load(&t->lines, t->sk, v, w, t->others.vertex, t->others.count, again);
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
  dyd_status st = death_exact(t, v, w);
  t->result.exact++;
  if (st != DYD_OK) return st;
  *row = row_of_summit(t, v, w, DYD_EVENT_DEATH);
  if (ring) *ring = (dyd_ring_d){v, w, dyd_summit_place(s), row->lo, mpz_sgn(s->at.q) ? 0 : mpz_sgn(s->at.p)};
  return DYD_OK;
}

/* The points that may bind: the neighbours of both ends; with a hub, those of an end that is none, or the apexes alone.
 * false: there are none. */
static bool load_edge(dyd_lines_d *l, const dyd_tolerance *t, const death_edge *e) {
  uint32_t ghost = t->sk->mesh.n;
  bool hub = has_hub(t, e->v, e->w);
  int first = e->apex[0] == ghost;
  l->i = e->v;
  l->j = e->w;
  l->apex[0] = e->apex[first];
  l->apex[1] = e->apex[!first] == ghost ? DYD_NONE : e->apex[!first];
  for (int n = 0; n < 2; n++) {
    uint32_t v = n ? e->w : e->v, degree = dyd_degree(t, v);
    l->ring[n] = t->near + t->start[v];
    l->rings[n] = hub && degree > DYD_HUB ? 0 : degree;
  }
  if (!hub || l->apex[1] == DYD_NONE) return !hub;
  if (l->rings[0] + l->rings[1] == 0) l->ring[0] = l->apex, l->rings[0] = 2;
  return true;
}

/* For the tree: has it a point without a line? */
typedef struct stranger {
  const dyd_lines_d *lines;
  bool found;
} stranger;

static bool meet_stranger(void *context, uint32_t v) {
  stranger *s = context;
  const dyd_lines_d *l = s->lines;
  bool known = v == l->i || v == l->j;
  for (int n = 0; n < 2; n++)
    for (uint32_t k = 0; k < l->rings[n] && !known; k++) known = l->ring[n][k] == v;
  s->found = !known;
  return known;
}

/* An end that is a hub: lines of the other end's neighbours, and no other point within the disc. */
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

/* false: memory is exhausted. Rows put off or cancelled are marked as not reached. *again: not yet. */
static bool death_of_edge(bool *again, death_part *p, const dyd_tolerance *t, uint32_t k) {
  const death_edge *e = &p->edge[k];
  dyd_lines_d *l = &p->lines;
  dyd_death_d d;
  double radius2;
  *again = false;
  if (p->status != DYD_CANCELLED && !t->options.no_filter && !has_hub(t, e->v, e->w) && load_edge(l, t, e)) {
    bool sure = dyd_filter_batched(&d, again, &p->batch, k, &t->points, l);
    if (*again) return true;
    if (sure || dyd_filter_death(&d, NULL, &radius2, &t->points, l)) {
      p->filter++;
      write_death(p->row[k], ring_of_edge(t, e), t, e, &d);
      return true;
    }
  }
  *p->row[k] = dyd_row_of(t, e->v, e->w, DYD_EVENT_DEATH, DYD_NONE, DYD_NONE, 0, DYD_UNREACHED);
  if (p->status == DYD_CANCELLED) return true;
  if (!DYD_GROW(p->later, p->cap, p->count + 1)) return false;
  p->later[p->count++] = *e;
  return true;
}

/* Edges that are to be tried again remain. */
static void deaths_of_edges(death_part *p, const dyd_tolerance *t) {
  dyd_batch_d *c = &p->batch;
  uint32_t kept = 0;
  if (!t->low && t->points.usable) dyd_filter_batch(c, &t->points);
  for (uint32_t k = 0; k < c->count; k++) {
    bool again;
    if (!death_of_edge(&again, p, t, k)) p->status = DYD_E_NOMEM;
    if (!again) continue;
    for (int n = 0; n < 4; n++) c->of[n][kept] = c->of[n][k];
    c->round[kept] = c->round[k];
    p->edge[kept] = p->edge[k];
    p->row[kept++] = p->row[k];
  }
  c->count = kept;
}

static dyd_status death_later(dyd_tolerance *t, const death_edge *e) {
  dyd_tolerance_row *row = &t->row[dyd_row_find(t, e->v, e->w)];
  dyd_death_d d;
  bool sure;
  dyd_status st = hub_in_doubles(&sure, &d, t, e);
  if (st != DYD_OK) return st;
  if (!sure) return death_by_integers(row, ring_of_edge(t, e), t, e->v, e->w);
  t->result.filter++;
  write_death(row, ring_of_edge(t, e), t, e, &d);
  return DYD_OK;
}

static void count_rows_of_range(void *context, size_t number) {
  const death_pass *p = context;
  const dyd_tolerance *t = p->t;
  size_t end = dyd_range_begin(t->sk->n, number + 1), all = 0;
  for (uint32_t v = (uint32_t)dyd_range_begin(t->sk->n, number); v < end; v++) {
    size_t count = 0;
    for (uint32_t q = t->start[v]; q < t->start[v + 1]; q++) count += t->own[q];
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
  bool back = w < v;
  return (death_edge){back ? w : v, back ? v : w, {back ? before : after, back ? after : before}, ring};
}

static void put_edge(death_part *p, const dyd_tolerance *t, uint32_t v, uint32_t q, dyd_tolerance_row *row) {
  dyd_batch_d *c = &p->batch;
  uint32_t k = c->count++;
  death_edge e = p->edge[k] = edge_around(t, v, q, p->rings++);
  c->of[0][k] = e.v;
  c->of[1][k] = e.w;
  c->of[2][k] = e.apex[1];
  c->of[3][k] = e.apex[0];
  c->round[k] = 0;
  p->row[k] = row;
  __builtin_prefetch(row);
  __builtin_prefetch(&t->near[t->start[e.v == v ? e.w : e.v]]);
  while (c->count == DYD_BATCH) deaths_of_edges(p, t);
}

/* The rows of v, by the sites of the other ends. Few are sorted without branches, which would be taken at random. */
static void deaths_at(death_part *part, dyd_tolerance_row *row, const dyd_tolerance *t, uint32_t v) {
  const uint32_t *site = t->sk->reps.site, *near = t->near, begin = t->start[v], end = t->start[v + 1];
  uint64_t few[FEW + 1];
  uint32_t some = 0;
  for (uint32_t q = begin; q < end; q++) {
    few[some < FEW ? some : FEW] = (uint64_t)site[t->own[q] ? near[q] : v] << 32 | q;
    some += t->own[q];
  }
  for (uint32_t k = 1; k < some && some <= FEW; k++)
    for (uint32_t at = 0; at < k; at++) {
      uint64_t a = few[at], b = few[k];
      few[at] = a < b ? a : b;
      few[k] = a < b ? b : a;
    }
  for (uint32_t k = 0, q = begin; k < some; k++, q++) {
    while (some > FEW && !t->own[q]) q++;
    put_edge(part, t, v, some > FEW ? q : (uint32_t)few[k], row + k);
  }
  if (some <= FEW) return;
  while (part->batch.count) deaths_of_edges(part, t);
  rows_sort_site(row, some);
}

static void deaths_of_range(void *context, size_t number) {
  const death_pass *p = context;
  const dyd_tolerance *t = p->t;
  const uint32_t *site = t->sk->reps.site;
  death_part *part = &p->part[number];
  size_t end = dyd_range_begin(t->sk->n, number + 1);
  for (uint32_t v = (uint32_t)dyd_range_begin(t->sk->n, number); v < end && part->status != DYD_E_NOMEM; v++) {
    if (v + AHEAD < end) __builtin_prefetch(&p->first[site[v + AHEAD]]);
    if (dyd_flag_is_set(t->options.cancel)) part->status = DYD_CANCELLED; /* from here on rows get their pairs alone */
    deaths_at(part, t->row + p->first[site[v]], t, v);
  }
  while (part->batch.count) deaths_of_edges(part, t);
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
    t->result.filter += part->filter;
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
  dyd_free_all(p.first, p.part);
  return st;
}

/* ---- births up to a cap ---- */

/* Discs of that radius lie in squares, so a pair that is born is a possible pair of these; each such pair is worked out
 * on few lines, and points nearer to the best place are added until there are none [TOL-3]. */

/* The search for a birth begins with at most this many neighbours. */
enum { FIRST_OTHERS = 24 };

/* w / 2 against -up_to: sqrt(minus) - sqrt(plus) against sqrt(4 up_to^2). */
static bool is_late(const dyd_summit *s, mpq_srcptr up_to) {
  DYD_LOCAL_NUMBERS(mpq, cap, zero);
  mpq_mul(cap, up_to, up_to);
  mpq_mul_2exp(cap, cap, 2);
  return dyd_roots_compare(s->minus, s->plus, cap, zero) > 0;
}

/* Sets t->summit to that of a pair without an edge. *late: it is certainly above t->options.up_to. */
static dyd_status birth_exact(bool *late, dyd_tolerance *t, uint32_t v, uint32_t w) {
  dyd_status st = dyd_others_around(&t->others, t, v, w, FIRST_OTHERS);
  *late = false;
  if (st == DYD_OK && t->others.count == 0) { /* two hubs: begin with any point */
    uint32_t any = 0;
    while (any == v || any == w || t->sk->leaving[any] == DYD_NONE) any++;
    if (!dyd_others_add(&t->others, any)) st = DYD_E_NOMEM;
  }
  for (bool more = true, again = false; st == DYD_OK && more; again = true) {
    st = dyd_lines_load(&t->lines, t->sk, v, w, t->others.vertex, t->others.count, again);
    if (st != DYD_OK) return st;
    dyd_lines_birth(&t->summit, &t->lines);
    *late = is_late(&t->summit, t->options.up_to);
    if (*late) return DYD_OK;
    st = dyd_others_nearer(&more, &t->others, t, v, w, FIRST_OTHERS);
  }
  return st;
}

/* A square that holds the disc of radius up_to around the point, its ends rounded outward finely against up_to. */
static dyd_status square_of_birth(dyd_rect *out, const void *tolerance, size_t i) {
  const dyd_tolerance *t = tolerance;
  DYD_LOCAL_NUMBERS(mpq, half);
  dyd_status st = dyd_sites_get(out, t->sk->reps.sites, i);
  mpq_set(half, t->options.up_to);
  if (t->weight) mpq_set_d(half, t->weight[t->sk->vertex[i]]);
  if (t->weight) mpq_mul(half, half, t->options.up_to);
  return st == DYD_OK ? dyd_rect_widen(out, half, dyd_q_log2_above(t->options.up_to) - 20) : st;
}

/* Of each pair listed: what doubles find. */
typedef enum birth_state { BIRTH_NONE, BIRTH_OPEN, BIRTH_LATE, BIRTH_FOUND } birth_state;

typedef bool birth_filter(dyd_tolerance_row *, bool *, const dyd_tolerance *, uint32_t, uint32_t, double, dyd_others *);

static birth_filter *filter_of(const dyd_tolerance *t) {
  bool moved = t->weight || t->options.metric == DYD_METRIC_BOX;
  return t->options.no_filter ? NULL : moved ? dyd_filter_moved_birth : dyd_filter_birth;
}

/* Rows that doubles have found while pairs were listed. */
typedef struct births_told {
  const dyd_tolerance *t;
  birth_filter *filter;
  double up_to;
  dyd_tolerance_row *row;
  size_t rows, cap;
  dyd_others spare;
} births_told;

typedef struct birth_pass {
  const dyd_tolerance *t;
  const dyd_pair_list *pairs;
  const births_told *told;
  dyd_tolerance_row *row;
  uint8_t *state;
} birth_pass;

static bool may_be_born(const dyd_tolerance *t, const dyd_pair *p) {
  return p->status != DYD_LEGAL && dyd_delaunay_alias(t->pd, p->i) == p->i && dyd_delaunay_alias(t->pd, p->j) == p->j &&
         dyd_delaunay_status(t->pd, p->i, p->j) == DYD_ILLEGAL;
}

/* For the closure of squares. */
static bool tell_birth(bool *possible, void *context, uint32_t i, uint32_t j) {
  births_told *told = context;
  const dyd_tolerance *t = told->t;
  uint32_t a = i < j ? i : j, b = i + j - a;
  dyd_tolerance_row row;
  bool late;
  if (dyd_delaunay_alias(t->pd, a) != a || dyd_delaunay_alias(t->pd, b) != b) return false;
  *possible = dyd_delaunay_status(t->pd, a, b) != DYD_ILLEGAL;
  if (*possible) return true;
  if (!told->filter(&row, &late, t, t->sk->vertex[a], t->sk->vertex[b], told->up_to, &told->spare)) return false;
  *possible = !late;
  if (!late && DYD_GROW(told->row, told->cap, told->rows + 1)) told->row[told->rows++] = row;
  return true;
}

static void births_in_doubles(void *context, size_t number) {
  const birth_pass *p = context;
  const dyd_tolerance *t = p->t;
  const births_told *b = p->told;
  bool late;
  dyd_others spare = {0};
  size_t end = (number + 1) * SHARE < p->pairs->count ? (number + 1) * SHARE : p->pairs->count;
  for (size_t k = number * SHARE; k < end; k++) {
    const dyd_pair *q = &p->pairs->item[k];
    const dyd_tolerance_row *row = b->rows ? bsearch(q, b->row, b->rows, sizeof *row, dyd_compare_two) : NULL;
    p->state[k] = row ? BIRTH_FOUND : may_be_born(t, q) ? BIRTH_OPEN : BIRTH_NONE;
    if (row) p->row[k] = *row;
    if (p->state[k] != BIRTH_OPEN || !b->filter || dyd_flag_is_set(t->options.cancel)) continue;
    if (b->filter(&p->row[k], &late, t, t->sk->vertex[q->i], t->sk->vertex[q->j], b->up_to, &spare))
      p->state[k] = late ? BIRTH_LATE : BIRTH_FOUND;
  }
  free(spare.vertex);
}

static dyd_status birth_open(dyd_tolerance *t, const dyd_pair *p) {
  uint32_t v = t->sk->vertex[p->i], w = t->sk->vertex[p->j];
  bool late;
  if (t->weight || t->options.metric == DYD_METRIC_BOX)
    return dyd_row_add(t, dyd_row_of(t, v, w, DYD_EVENT_BIRTH, DYD_NONE, DYD_NONE, 0, HUGE_VAL));
  dyd_status st = birth_exact(&late, t, v, w);
  return st == DYD_OK && !late ? dyd_row_add(t, row_of_summit(t, v, w, DYD_EVENT_BIRTH)) : st;
}

static dyd_status births_in_order(dyd_tolerance *t, const birth_pass *p) {
  dyd_status st = DYD_OK;
  t->result.births_left = 0;
  for (size_t k = 0; k < p->pairs->count && st == DYD_OK; k++) {
    if (p->state[k] == BIRTH_FOUND) st = dyd_row_add(t, p->row[k]);
    if (p->state[k] != BIRTH_OPEN) continue;
    if (t->result.births_left || dyd_flag_is_set(t->options.cancel))
      t->result.births_left++;
    else
      st = birth_open(t, &p->pairs->item[k]);
  }
  return st == DYD_OK && t->result.births_left ? DYD_CANCELLED : st;
}

static dyd_status births_among(dyd_tolerance *t, const dyd_pair_list *pairs, const births_told *told) {
  birth_pass p = {t, pairs, told, dyd_alloc(pairs->count, sizeof *p.row), calloc(pairs->count + 1, sizeof *p.state)};
  dyd_status st = p.row && p.state ? DYD_OK : DYD_E_NOMEM;
  if (told->rows) qsort(told->row, told->rows, sizeof *told->row, dyd_compare_two);
  if (st == DYD_OK) dyd_parallel(t->pd->options.threads, pairs->count / SHARE + 1, births_in_doubles, &p);
  if (st == DYD_OK) st = births_in_order(t, &p);
  dyd_free_all(p.row, p.state);
  return st;
}

/* Work was cancelled while pairs were listed: the births found so far, each once. */
static dyd_status births_so_far(dyd_tolerance *t, const births_told *told) {
  dyd_status st = DYD_OK;
  if (told->rows) qsort(told->row, told->rows, sizeof *told->row, dyd_compare_two);
  for (size_t k = 0; k < told->rows && st == DYD_OK; k++)
    if (!k || dyd_compare_two(&told->row[k - 1], &told->row[k])) st = dyd_row_add(t, told->row[k]);
  return st == DYD_OK ? DYD_CANCELLED : st;
}

/* For the list of candidates beside their triangulation, and for rows of all of them. */
static dyd_status births_have_room(dyd_tolerance *t, const dyd_delaunay *wide) {
  if (!t->memory.most) return DYD_OK;
  t->memory.beside = dyd_sites_memory(wide->own) + dyd_delaunay_memory(wide) + dyd_pairs_bytes(wide, DYD_TIE);
  return dyd_rows_have_room(t, dyd_pairs_bytes(wide, DYD_TIE) / sizeof(dyd_pair), "the births") ? DYD_OK : DYD_E_NOMEM;
}

dyd_status dyd_births(dyd_tolerance *t, dyd_error *err) {
  DYD_OWNED(dyd_delaunay) *wide = NULL;
  DYD_SCOPED(dyd_pair_list) pairs = {0};
  const dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .cancel = t->options.cancel,
                                  .max_pairs = t->options.max_pairs, .max_bytes = dyd_memory_left(&t->memory)};
  births_told told = {.t = t, .filter = filter_of(t), .up_to = dyd_q_double(t->options.up_to, 1)};
  const dyd_decider decider = {tell_birth, &told};
  dyd_status st = dyd_near_index(t);
  if (st == DYD_OK)
    st = dyd_delaunay_decided(&wide, dyd_sites_count(t->sk->reps.sites), square_of_birth, t,
                              told.filter ? &decider : NULL, &o, err);
  if (st == DYD_CAPPED)
    dyd_fail(err, st, "there are too many pairs that may be born up to there; ask for less, or raise `max_pairs`");
  if (st == DYD_OK) st = births_have_room(t, wide);
  if (st == DYD_OK) st = dyd_delaunay_pairs(&pairs, wide);
  if (st == DYD_OK)
    st = births_among(t, &pairs, &told);
  else if (st == DYD_CANCELLED)
    st = births_so_far(t, &told);
  t->memory.beside = 0;
  dyd_free_all(told.row, told.spare.vertex);
  return st;
}

/* ---- the whole ---- */

/* The least death, and the least motion that takes a corner off the hull [TOL-5]. */

/* The vectors a = u - v, b = w - u of three corners u, v, w. */
static dyd_status corner_vectors(mpq_t a[2], mpq_t b[2], const dyd_tolerance *t, const uint32_t v[3]) {
  dyd_status st = DYD_OK;
  DYD_LOCAL_NUMBERS(mpq, other, p);
  DYD_LOCAL_ARRAY(dyd_rect, r, [3]);
  for (int k = 0; k < 3 && st == DYD_OK; k++) st = dyd_sites_get(&r[k], t->sk->reps.sites, t->sk->reps.site[v[k]]);
  for (int axis = 0; axis < 2; axis++) {
    dyd_interval_get_q(a[axis], other, axis ? &r[0].y : &r[0].x);
    dyd_interval_get_q(p, other, axis ? &r[2].y : &r[2].x);
    mpq_sub(b[axis], p, a[axis]);
    dyd_interval_get_q(p, other, axis ? &r[1].y : &r[1].x);
    mpq_sub(a[axis], a[axis], p);
  }
  return st;
}

static void inner_product(mpq_ptr out, mpq_t a[2], mpq_t b[2]) {
  DYD_LOCAL_NUMBERS(mpq, x);
  mpq_mul(out, a[0], b[0]);
  mpq_mul(x, a[1], b[1]);
  mpq_add(out, out, x);
}

/* Squared distance of v to the line uw: |a x b|^2 / |b|^2; where points move in squares, |b| is the sum norm. */
static void distance2(mpq_ptr out, mpq_t a[2], mpq_t b[2], dyd_metric metric) {
  DYD_LOCAL_NUMBERS(mpq, x, y);
  mpq_mul(out, a[0], b[1]);
  mpq_mul(x, a[1], b[0]);
  mpq_sub(out, out, x);
  mpq_mul(out, out, out);
  if (metric == DYD_METRIC_BOX) {
    mpq_abs(x, b[0]);
    mpq_abs(y, b[1]);
    mpq_add(x, x, y);
    mpq_mul(x, x, x);
  } else {
    inner_product(x, b, b);
  }
  mpq_div(out, out, x);
}

static void lower_whole(dyd_tolerance *t, double lo, double hi) {
  if (lo < t->result.lo) t->result.lo = lo;
  if (hi < t->result.hi) t->result.hi = hi;
}

/* Discs about u and w, of radius t times their weights, hold between them those about a + s b, 0 <= s <= 1, of radius t
 * (r_u + s (r_w - r_u)): that of v meets one of these from t^2 = min |a + s b|^2 / L^2 on, L = p + s q, p = r_v + r_u,
 * q = r_w - r_u. Between the ends that is at s = (q a.a - p a.b) / (p b.b - q a.b); at them v meets u or w, which takes
 * an edge. */
static void weighted_corner(double *lo, double *hi, const dyd_tolerance *t, const uint32_t v[3], mpq_t a[2],
                            mpq_t b[2]) {
  DYD_LOCAL_NUMBERS(mpq, p, q, s, x, y, zero);
  mpq_set_d(p, t->weight[v[0]]);
  mpq_set_d(q, t->weight[v[2]]);
  mpq_sub(q, q, p);
  mpq_set_d(x, t->weight[v[1]]);
  mpq_add(p, p, x);
  inner_product(x, a, b);
  mpq_mul(y, p, x);
  mpq_mul(x, q, x);
  inner_product(zero, a, a);
  mpq_mul(s, q, zero);
  mpq_sub(s, s, y);
  inner_product(zero, b, b);
  mpq_mul(y, p, zero);
  mpq_sub(y, y, x);
  if (mpq_sgn(y)) mpq_div(s, s, y);
  if (mpq_sgn(y) && mpq_sgn(s) >= 0 && mpq_cmp_si(s, 1, 1) <= 0) {
    mpq_mul(q, q, s);
    mpq_add(p, p, q);
    for (int axis = 0; axis < 2; axis++) {
      mpq_mul(x, b[axis], s);
      mpq_add(a[axis], a[axis], x);
    }
    inner_product(x, a, a);
    mpq_mul_2exp(x, x, 2);
    mpq_mul(p, p, p);
    mpq_set_ui(zero, 0, 1);
    if (mpq_sgn(p)) {
      mpq_div(x, x, p);
      dyd_roots_half(lo, hi, x, zero);
      *lo *= 1 - 0x1p-51; /* weights may be the doubles next to the intended ones */
      *hi *= 1 + 0x1p-50;
    }
  }
}

dyd_status dyd_hull_corner(double *lo, double *hi, const dyd_tolerance *t, dyd_half_edge h, bool weighted) {
  const dyd_mesh *m = &t->sk->mesh;
  uint32_t v[3] = {dyd_hull_origin(m, h), dyd_hull_target(m, h), dyd_hull_target(m, dyd_hull_following(m, h))};
  *lo = *hi = HUGE_VAL;
  /* uw is an edge exactly when v has no other neighbours */
  if (dyd_degree(t, v[1]) == 3) return DYD_OK;
  DYD_LOCAL_ARRAY(mpq_t, a, [2]);
  DYD_LOCAL_ARRAY(mpq_t, b, [2]);
  DYD_LOCAL_NUMBERS(mpq, d, zero);
  dyd_status st = corner_vectors(a, b, t, v);
  if (st == DYD_OK && weighted)
    weighted_corner(lo, hi, t, v, a, b);
  else if (st == DYD_OK) {
    distance2(d, a, b, t->options.metric);
    dyd_roots_half(lo, hi, d, zero);
  }
  return st;
}

dyd_status dyd_whole(dyd_tolerance *t) {
  const dyd_mesh *m = &t->sk->mesh;
  dyd_status st = DYD_OK;
  t->result.lo = t->result.hi = HUGE_VAL;
  for (size_t k = 0; k < t->rows; k++)
    if (t->row[k].event != DYD_EVENT_BIRTH) lower_whole(t, t->row[k].lo, t->row[k].hi);
  if (t->result.edges_left) t->result.lo = 0;
  if (t->result.edges_left || dyd_is_line(t->pd)) return DYD_OK;
  dyd_half_edge first = dyd_hull_first(m), h = first;
  do {
    double lo, hi;
    st = dyd_hull_corner(&lo, &hi, t, h, t->weight);
    if (st == DYD_OK) lower_whole(t, lo, hi);
    h = dyd_hull_following(m, h);
  } while (st == DYD_OK && h != first);
  return st;
}
