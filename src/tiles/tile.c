/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Tables of sites, their triangulation, and the way from the input to sites with owners: samples, boxes of the plane,
 * halos. */
#include "tiles/tiles.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
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
  return dyd_reserve((void **)&s->number, &s->cap_number, count, sizeof *s->number) &&
         dyd_reserve((void **)&s->end, &s->cap_end, count * s->dim, sizeof *s->end);
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
  free(s->number);
  free(s->end);
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

static void tiles_graph_clear(tiles_graph *g) {
  free(g->start);
  free(g->partner);
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
  if (!dyd_reserve((void **)&g->start, &g->cap_start, g->count + 2, sizeof *g->start)) return false;
  memset(g->start, 0, (g->count + 2) * sizeof *g->start);
  dyd_delaunay_each_pair(pd, count_partners, g);
  for (size_t k = 2; k < g->count + 2; k++) g->start[k] += g->start[k - 1];
  if (!dyd_reserve((void **)&g->partner, &g->cap_partner, g->start[g->count + 1] + 1, sizeof *g->partner)) return false;
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
  if (!dyd_reserve((void **)&rows->item, &rows->cap, rows->count + 1, sizeof *rows->item)) return tiles_no_memory(err);
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

enum { SAMPLES = 1 << 16 };

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
  free(t->in);
  free(t->out);
  free(t->info);
  free(t->sent);
  tiles_sites_clear(&t->own);
  tiles_sites_clear(&t->ghosts);
  tiles_sites_clear(&t->fringe);
  tiles_tree_clear(&t->tree);
  tiles_graph_clear(&t->graph);
  tiles_reach_clear(&t->reach);
  tiles_search_clear(&t->search);
  dyd_engine_free(t->engine);
  free(t->alias);
  free(t->mark);
  free(t->late);
  free(t->rows.item);
  free(t->aliases.item);
  if (t->spool) fclose(t->spool);
  if (t->parked) fclose(t->parked);
}

bool tile_has_wide(const tile *t) {
  uint64_t wide = 0;
  for (size_t r = 0; r < t->job->ranks; r++) wide += t->info[r].wide;
  return wide > 0;
}

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

dyd_status tile_read(tile *t, dyd_error *err) {
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

dyd_status tile_split(tile *t, dyd_error *err) {
  const size_t ranks = t->job->ranks;
  tiles_mail sample = {0};
  split_cut *cut = calloc(ranks, sizeof *cut);
  bool fits = cut && take_sample(&sample, t);
  if (fits && sample.count)
    split_ranks(cut, (double(*)[2])(void *)sample.bytes, sample.count / sizeof(double[2]), 0, ranks);
  for (size_t k = 0; fits && k < t->own.count; k++) {
    tiles_box b = tiles_sites_box(&t->own, k);
    fits = tiles_sites_put(&t->out[owner_of(cut, ranks, &b)], &t->own, k);
  }
  tiles_sites_clear(&t->own);
  tiles_mail_clear(&sample);
  free(cut);
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

dyd_status tile_own(tile *t, dyd_error *err) {
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

dyd_status tile_halo(tile *t, dyd_error *err) {
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
