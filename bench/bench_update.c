/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Row update: thin boxes, k of them wide, so that there are about k undecided faces; then these are narrowed and the
 * faces worked on again, against the first run. */
#include "cloud.h"
#include "ours.h"

#include <math.h>
#include <stdlib.h>

static void check(dyd_status status) {
  if (status != DYD_OK) bench_die("update", dyd_status_text(status));
}

static void narrow(dyd_sites *sites, const cloud *c, size_t i, double half_width) {
  dyd_rect r;
  dyd_rect_init(&r);
  double x = c->x[i], y = c->y[i], h = half_width;
  check(dyd_rect_set_d(&r, fmax(x - h, c->x0[i]), fmin(x + h, c->x1[i]), fmax(y - h, c->y0[i]), fmin(y + h, c->y1[i])));
  check(dyd_sites_narrow(sites, i, &r));
  dyd_rect_clear(&r);
}

/* One first run and one update. */
static void run(bench_series *first, bench_series *again, size_t *faces, size_t *left, cloud *c, size_t k) {
  dyd_sites *sites = NULL;
  dyd_delaunay *pd = NULL;
  uint32_t *changed = malloc(k * sizeof *changed);
  if (!changed) bench_die("update", "out of memory");
  bench_meter meter = bench_start();
  check(dyd_sites_new(&sites));
  check(dyd_sites_add_boxes(sites, c->n, c->x0, c->x1, c->y0, c->y1));
  check(dyd_delaunay_new(&pd, sites, NULL, NULL));
  bench_series_add(first, bench_stop(&meter));
  *faces = dyd_delaunay_undecided_faces(pd);
  for (size_t q = 0; q < k; q++) {
    changed[q] = (uint32_t)(q * (c->n / k));
    narrow(sites, c, changed[q], 0x1p-30);
  }
  meter = bench_start();
  check(dyd_delaunay_update(pd, changed, k, NULL, NULL));
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
  char remark[200];
  cloud_uniform(&boxes, bench_size(o, 1000000));
  cloud_widen(&boxes, 0x1p-30);
  for (size_t q = 0; q < k; q++) cloud_widen_one(&boxes, q * (boxes.n / k), 0.25 / sqrt((double)boxes.n));
  for (size_t r = 0; r < bench_runs(o, 3); r++) run(&first, &again, &faces, &left, &boxes, k);
  double part = bench_series_median(&again).seconds / bench_series_median(&first).seconds;
  snprintf(remark, sizeof remark, "%zu sites narrowed; undecided faces %zu before and %zu after; %.2f us a site", k,
           faces, left, bench_series_median(&again).seconds / (double)k * 1e6);
  bench_report(o, &(bench_row){.name = "update",
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

int main(int argc, char **argv) {
  bench_options o;
  bench_options_read(&o, argc, argv);
  if (bench_wants(&o, "update"))
    for (size_t k = 10; k <= 1000; k *= 10) row_update(&o, k);
  bench_options_close(&o);
  return 0;
}
