/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Rows: one for each pair, sorted in the end by i, then j. */
#include "base/alloc.h"
#include "base/index.h"
#include "tolerance/roots.h"
#include "tolerance/state.h"

#include <string.h>

bool dyd_rows_have_room(dyd_tolerance *t, uint64_t pairs, const char *what) {
  bool rings = t->options.points || t->sigma;
  uint64_t each = 2 * sizeof *t->row + (rings ? sizeof *t->ring + sizeof *t->chance : 0);
  uint64_t bytes = dyd_bytes_times(pairs, each);
  if (!dyd_room_has(&t->room, bytes, what)) return false;
  t->room.held = dyd_bytes_add(t->room.held, t->room.most ? bytes : 0);
  return true;
}

dyd_tolerance_row dyd_row_of(const dyd_tolerance *t, uint32_t v, uint32_t w, dyd_tolerance_event event, uint32_t k,
                             uint32_t l, double lo, double hi) {
  const uint32_t *site = t->sk->reps.site;
  uint32_t i = site[v], j = site[w], a = k == DYD_NONE ? DYD_NO_SITE : site[k],
           b = l == DYD_NONE || l == k ? DYD_NO_SITE : site[l];
  return (dyd_tolerance_row){i < j ? i : j, i < j ? j : i, event, a < b ? a : b, a < b ? b : a, lo, hi};
}

dyd_tolerance_row dyd_row_of_summit(const dyd_tolerance *t, uint32_t v, uint32_t w, dyd_tolerance_event event) {
  const dyd_summit *s = &t->summit;
  double lo = HUGE_VAL, hi = HUGE_VAL;
  if (s->binding == DYD_BINDING_NONE) return dyd_row_of(t, v, w, event, DYD_NONE, DYD_NONE, lo, hi);
  dyd_roots_half(&lo, &hi, s->plus, s->minus);
  return dyd_row_of(t, v, w, event, t->lines.item[s->a].vertex, t->lines.item[s->b].vertex, lo, hi);
}

dyd_status dyd_row_add(dyd_tolerance *t, dyd_tolerance_row row) {
  if (!dyd_reserve((void **)&t->row, &t->cap, t->rows + 1, sizeof *t->row)) return DYD_E_NOMEM;
  t->row[t->rows++] = row;
  return DYD_OK;
}

dyd_status dyd_rows_rework(dyd_tolerance *t, dyd_row_work *work, void *user) {
  size_t kept = 0;
  bool cut = false;
  dyd_status st = DYD_OK;
  for (size_t k = 0; k < t->rows && st == DYD_OK; k++) {
    dyd_tolerance_row *row = &t->row[k];
    bool late = false;
    cut = cut || dyd_flag_is_set(t->options.cancel);
    if (cut && row->event != DYD_EVENT_TIE)
      row->hi = DYD_UNREACHED;
    else if (row->event != DYD_EVENT_TIE && row->hi != DYD_UNREACHED)
      st = work(&late, row, user);
    if (!late) t->row[kept++] = *row;
  }
  t->rows = kept;
  return st == DYD_OK && cut ? DYD_CANCELLED : st;
}

void dyd_rows_reached(dyd_tolerance *t) {
  size_t kept = 0, count[4];
  dyd_delaunay_count(count, t->pd);
  t->edges_left = count[DYD_LEGAL];
  for (size_t k = 0; k < t->rows; k++) {
    const dyd_tolerance_row *row = &t->row[k];
    bool reached = row->hi != DYD_UNREACHED;
    t->edges_left -= reached && row->event == DYD_EVENT_DEATH;
    t->births_left += !reached && row->event == DYD_EVENT_BIRTH && t->births_left != SIZE_MAX;
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

void dyd_rows_sort_site(dyd_tolerance_row *row, size_t count) {
  if (count > 32)
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
    free(start);
    free(to);
    return DYD_E_NOMEM;
  }
  for (size_t k = 0; k < t->rows; k++) start[t->row[k].i + 2]++;
  for (size_t i = 1; i <= n; i++) start[i + 1] += start[i];
  for (size_t k = 0; k < t->rows; k++) to[start[t->row[k].i + 1]++] = t->row[k];
  for (size_t i = 0; i < n; i++) dyd_rows_sort_site(to + start[i], start[i + 1] - start[i]);
  free(start);
  free(t->row);
  t->row = to;
  t->cap = t->rows;
  return DYD_OK;
}
