/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* From the input to sites with owners: samples, boxes of the plane, halos. */
#include "tiles/tiles.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

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
