/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Rows update-10, update-100, update-1000, or update for all: thin boxes, k of them wide, so that there are about k
 * undecided faces; then these are narrowed and the faces worked on again, against the first run. Row remeasure: tracks
 * of a receiver, one undecided face; points of it are measured again, one after another, each followed by a run of the
 * engine. */
#include "answers.h"
#include "cloud.h"
#include "ours.h"
#include "real.h"

#include <dyadel/io.h>
#include <math.h>
#include <stdlib.h>

static void narrow(dyd_sites *sites, const cloud *c, size_t i, double half_width) {
  dyd_rect r;
  dyd_rect_init(&r);
  double x = c->x[i], y = c->y[i], h = half_width;
  bench_need(
      "update",
      dyd_rect_set_d(&r, fmax(x - h, c->x0[i]), fmin(x + h, c->x1[i]), fmax(y - h, c->y0[i]), fmin(y + h, c->y1[i])),
      NULL);
  bench_need("update", dyd_sites_narrow(sites, i, &r), NULL);
  dyd_rect_clear(&r);
}

/* One first run and one update. */
static void run(bench_series *first, bench_series *again, size_t *faces, size_t *left, cloud *c, size_t k) {
  dyd_sites *sites = NULL;
  dyd_delaunay *pd = NULL;
  uint32_t *changed = malloc(k * sizeof *changed);
  if (!changed) bench_die("update", "out of memory");
  bench_meter meter = bench_start();
  bench_need("update", dyd_sites_new(&sites), NULL);
  bench_need("update", dyd_sites_add_boxes(sites, c->n, c->x0, c->x1, c->y0, c->y1), NULL);
  bench_need("update", dyd_delaunay_new(&pd, sites, NULL, NULL), NULL);
  bench_series_add(first, bench_stop(&meter));
  *faces = dyd_delaunay_undecided_faces(pd);
  for (size_t q = 0; q < k; q++) {
    changed[q] = (uint32_t)(q * (c->n / k));
    narrow(sites, c, changed[q], 0x1p-30);
  }
  meter = bench_start();
  bench_need("update", dyd_delaunay_update(pd, changed, k, NULL, NULL), NULL);
  bench_series_add(again, bench_stop(&meter));
  *left = dyd_delaunay_undecided_faces(pd);
  dyd_delaunay_free(pd);
  dyd_sites_free(sites);
  free(changed);
}

static void row_update(const bench_options *o, size_t k) {
  cloud boxes;
  bench_series first = {0}, again = {0};
  size_t faces = 0, left = 0;
  char remark[200], name[24];
  snprintf(name, sizeof name, "update-%zu", k);
  if (!bench_wants(o, "update") && !bench_wants(o, name)) return;
  cloud_uniform(&boxes, bench_size(o, 1000000));
  cloud_widen(&boxes, 0x1p-30);
  for (size_t q = 0; q < k; q++) cloud_widen_one(&boxes, q * (boxes.n / k), 0.25 / sqrt((double)boxes.n));
  for (size_t r = 0; r < bench_runs(o, 3); r++) run(&first, &again, &faces, &left, &boxes, k);
  bench_check_numbers(o, name, boxes.n, faces, left, 0);
  double part = bench_series_median(&again).seconds / bench_series_median(&first).seconds;
  snprintf(remark, sizeof remark, "%zu sites narrowed; undecided faces %zu before and %zu after; %.2f us a site", k,
           faces, left, bench_series_median(&again).seconds / (double)k * 1e6);
  bench_report(o, &(bench_row){.name = name,
                               .n = boxes.n,
                               .ours = &again,
                               .peer = &first,
                               .peer_name = "first run",
                               .measure = "per cent of the first run",
                               .figure = 100 * part,
                               .figure_goal = 1,
                               .remark = remark});
  cloud_clear(&boxes);
}

/* ---- one giant face ---- */

/* A random part of the interval, a quarter to three quarters as wide. */
static void shrink(dyd_interval *a, const double box[2], uint64_t *state) {
  double width = (box[1] - box[0]) * (0.25 + 0.5 * cloud_unit(state)),
         from = box[0] + (box[1] - box[0] - width) * cloud_unit(state);
  bench_need("update", dyd_interval_set_d(a, from, from + width), NULL);
}

static void measure(dyd_engine *e, uint32_t i, uint64_t *state) {
  dyd_outcome outcome;
  double box[4];
  dyd_rect r;
  dyd_rect_init(&r);
  bench_need("update", dyd_sites_get(&r, dyd_engine_sites(e), i), NULL);
  dyd_rect_get_d(box, &r);
  shrink(&r.x, box, state);
  shrink(&r.y, box + 2, state);
  bench_need("update", dyd_engine_remeasure(e, i, &r, NULL), NULL);
  bench_need("update", dyd_engine_run(&outcome, e, NULL, NULL), NULL);
  dyd_rect_clear(&r);
}

/* The number of pairs of the same places as a new engine has them is looked at by the tests of delaunay. */
static bench_cost remeasure(size_t count[4], size_t *face, FILE *in, size_t updates) {
  dyd_engine *e = NULL;
  dyd_outcome outcome;
  dyd_index_list sites = {0};
  uint64_t state = 15;
  rewind(in);
  bench_need("update", dyd_engine_new(&e), NULL);
  bench_need("update", dyd_read_points(e, in, NULL, NULL), NULL);
  bench_need("update", dyd_engine_run(&outcome, e, NULL, NULL), NULL);
  *face = 0;
  for (size_t f = 0; f < dyd_delaunay_undecided_faces(dyd_engine_delaunay(e)); f++) {
    bool outer;
    bench_need("update", dyd_delaunay_face(&sites, &outer, dyd_engine_delaunay(e), f), NULL);
    if (sites.count > *face) *face = sites.count;
    dyd_index_list_clear(&sites);
  }
  bench_meter meter = bench_start();
  for (size_t q = 0; q < updates; q++) measure(e, (uint32_t)(q * 7919 % dyd_engine_count(e)), &state);
  bench_cost cost = bench_stop(&meter);
  dyd_delaunay_count(count, dyd_engine_delaunay(e));
  dyd_engine_free(e);
  return cost;
}

static void row_remeasure(const bench_options *o) {
  enum { UPDATES = 300 };
  bench_series ours = {0};
  size_t n = bench_size(o, 2000), count[4], face = 0;
  char remark[200];
  FILE *in = real_tracks(n);
  for (size_t r = 0; r < bench_runs(o, 3); r++) bench_series_add(&ours, remeasure(count, &face, in, UPDATES));
  fclose(in);
  bench_check(o, "remeasure", n, count);
  snprintf(remark, sizeof remark, "%d points measured again; %zu in the greatest face at first; indeterminate %zu then",
           UPDATES, face, count[DYD_INDETERMINATE]);
  bench_report_seconds(o, "remeasure", n, &ours, 1, remark);
}

int main(int argc, char **argv) {
  bench_options o;
  bench_options_read(&o, argc, argv);
  while (bench_next_part(&o)) {
    for (size_t k = 10; k <= 1000; k *= 10) row_update(&o, k);
    if (bench_wants(&o, "remeasure")) row_remeasure(&o);
  }
  bench_options_close(&o);
  return 0;
}
