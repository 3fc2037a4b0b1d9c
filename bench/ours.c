/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Timing the library. */
#include "ours.h"

#include <stdlib.h>

void bench_need(const char *row, dyd_status status, const dyd_error *err) {
  if (status != DYD_OK) bench_die(row, err && *err->message ? err->message : dyd_status_text(status));
}

static void take_edges(bench_edges *out, const char *row, const dyd_pair_list *pairs) {
  out->count = pairs->count;
  out->item = malloc((pairs->count ? pairs->count : 1) * sizeof *out->item);
  if (!out->item) bench_die(row, "out of memory");
  for (size_t k = 0; k < pairs->count; k++) out->item[k] = (bench_edge){pairs->item[k].i, pairs->item[k].j};
}

void ours_edges(bench_edges *out, const char *row, const dyd_delaunay *pd) {
  dyd_pair_list pairs = {0};
  bench_need(row, dyd_delaunay_pairs(&pairs, pd), NULL);
  take_edges(out, row, &pairs);
  dyd_pair_list_clear(&pairs);
}

bench_cost ours_run(ours_answer *out, const char *row, const cloud *c, ours_what what, unsigned threads) {
  dyd_sites *sites = NULL;
  dyd_delaunay *pd = NULL;
  dyd_pair_list pairs = {0};
  dyd_delaunay_options options = {DYD_SIZED(dyd_delaunay_options), .threads = threads};
  *out = (ours_answer){0};
  bench_meter meter = bench_start();
  bench_need(row, dyd_sites_new(&sites), NULL);
  if (c->x0)
    bench_need(row, dyd_sites_add_boxes(sites, c->n, c->x0, c->x1, c->y0, c->y1), NULL);
  else
    bench_need(row, dyd_sites_add_points(sites, c->n, c->x, c->y), NULL);
  bench_need(row, dyd_delaunay_new(&pd, sites, &options, NULL), NULL);
  dyd_delaunay_count(out->count, pd);
  dyd_triangle_list triangles = {0}, beyond = {0};
  if (what == OURS_ARRAYS) {
    meter = bench_start();
    bench_need(row, dyd_delaunay_triangles(&triangles, &beyond, pd, DYD_TRIANGLES_AS_FOUND), NULL);
  }
  if (what == OURS_LISTED) bench_need(row, dyd_delaunay_pairs(&pairs, pd), NULL);
  bench_cost cost = bench_stop(&meter);
  out->input_bytes = (double)dyd_sites_memory(sites);
  if (what == OURS_LISTED) take_edges(&out->edges, row, &pairs);
  if (what == OURS_AND_EDGES) ours_edges(&out->edges, row, pd);
  dyd_triangle_list_clear(&triangles);
  dyd_triangle_list_clear(&beyond);
  dyd_pair_list_clear(&pairs);
  dyd_delaunay_free(pd);
  dyd_sites_free(sites);
  return cost;
}

bench_cost ours_capped(char *remark, size_t size, const cloud *c) {
  dyd_sites *sites = NULL;
  dyd_delaunay *pd = NULL;
  dyd_error err;
  bench_meter meter = bench_start();
  bench_need("capped", dyd_sites_new(&sites), NULL);
  bench_need("capped", dyd_sites_add_points(sites, c->n, c->x, c->y), NULL);
  dyd_status status = dyd_delaunay_new(&pd, sites, NULL, &err);
  bench_cost cost = bench_stop(&meter);
  if (status != DYD_CAPPED) bench_die("capped", "the cap was not met");
  snprintf(remark, size, "%s", err.message);
  for (char *q = remark; *q; q++)
    if (*q == ',') *q = ';';
  dyd_delaunay_free(pd);
  dyd_sites_free(sites);
  return cost;
}
