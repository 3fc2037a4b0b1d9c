/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Rows over boxes: boxes (thin, every edge certified), boxes2 (two threads, by the clock), thick (a few per cent of the
 * spacing), overlap, line (on one line: nearly all pairs are possible). */
#include "answers.h"
#include "cloud.h"
#include "ours.h"
#include "peer.h"

#include <math.h>
#include <string.h>

static const bench_series no_peer;

/* Thin boxes against the peer on their centres. Where all pairs are legal, the edges are those of every choice, the
 * centres included. */
static void compare(char *remark, size_t size, const ours_answer *a, const bench_edges *peer) {
  size_t undecided = a->count[DYD_INDETERMINATE] + a->count[DYD_TIE];
  if (peer->count == 0) {
    snprintf(remark, size, "legal %zu; undecided %zu; no peer to compare with", a->count[DYD_LEGAL], undecided);
    return;
  }
  if (bench_edges_missing(peer, &a->edges)) bench_die("boxes", "the peer has an edge that is not possible here");
  if (undecided == 0 && a->edges.count != peer->count)
    bench_die("boxes", "all legal, yet not the edges of the centres");
  snprintf(remark, size, "legal %zu; undecided %zu; the peer's %zu edges of the centres are among them",
           a->count[DYD_LEGAL], undecided, peer->count);
}

static void row_boxes(const bench_options *o, const char *name, unsigned threads, double goal) {
  cloud boxes;
  bench_series ours = {0}, peer = {0};
  ours_answer first = {0}, again;
  bench_edges edges = {0};
  char remark[200];
  cloud_uniform(&boxes, bench_size(o, 1000000));
  cloud_widen(&boxes, 0x1p-30);
  for (size_t r = 0; r < bench_runs(o, 5); r++) {
    bench_cost cost;
    bench_series_add(&ours, ours_run(r ? &again : &first, name, &boxes, r ? OURS_STATUSES : OURS_AND_EDGES, threads));
    if (peer_points(&cost, r ? NULL : &edges, boxes.n, boxes.x, boxes.y)) bench_series_add(&peer, cost);
  }
  compare(remark, sizeof remark, &first, &edges);
  bench_check(o, name, boxes.n, first.count);
  bench_report(o, &(bench_row){.name = name,
                               .n = boxes.n,
                               .ours = &ours,
                               .peer = &peer,
                               .peer_name = peer_points_name(),
                               .input_bytes = first.input_bytes / (double)boxes.n,
                               .ratio_bar = 2.0,
                               .ratio_goal = goal,
                               .by_the_clock = threads > 1,
                               .total_bar = 400,
                               .beyond_goal = 180,
                               .remark = remark});
  bench_edges_clear(&edges);
  bench_edges_clear(&first.edges);
  cloud_clear(&boxes);
}

/* Boxes of half-width share / sqrt(n), or, on a line, share / n: time per possible pair, with a goal (0: none); nobody
 * else computes these statuses. Returns the CPU seconds of one run. */
static double wide(const bench_options *o, const char *name, size_t n, double share, double goal, size_t runs) {
  cloud boxes;
  bench_series ours = {0};
  ours_answer a = {0};
  char remark[200];
  const bool line = strcmp(name, "line") == 0;
  cloud_uniform(&boxes, n);
  for (size_t k = 0; line && k < n; k++) boxes.x[k] = (double)k / (double)n, boxes.y[k] = 0;
  cloud_widen(&boxes, share / (line ? (double)n : sqrt((double)n)));
  for (size_t r = 0; r < runs; r++) bench_series_add(&ours, ours_run(&a, name, &boxes, OURS_STATUSES, 1));
  bench_check(o, name, n, a.count);
  double seconds = bench_series_median(&ours).seconds;
  size_t pairs = a.count[DYD_LEGAL] + a.count[DYD_INDETERMINATE] + a.count[DYD_TIE];
  snprintf(remark, sizeof remark, "%zu pairs; legal %zu; indeterminate %zu; tied %zu", pairs, a.count[DYD_LEGAL],
           a.count[DYD_INDETERMINATE], a.count[DYD_TIE]);
  bench_report(o, &(bench_row){.name = name,
                               .n = n,
                               .ours = &ours,
                               .peer = &no_peer,
                               .input_bytes = a.input_bytes / (double)n,
                               .measure = "us a possible pair",
                               .figure = seconds / (double)pairs * 1e6,
                               .figure_goal = goal,
                               .bytes_each = bench_series_median(&ours).bytes / (double)pairs,
                               .bytes_each_goal = 200,
                               .output = pairs,
                               .remark = remark});
  cloud_clear(&boxes);
  return seconds;
}

/* The size asked for; or 10^3, 10^4, ... up to n, but no step that looks like taking more than a minute. */
static void row_wide(const bench_options *o, const char *name, size_t n, double share, double goal) {
  if (o->part > 1) return;
  if (o->n) {
    wide(o, name, o->n, share, goal, bench_runs(o, 3));
    return;
  }
  for (size_t step = 1000; step <= n; step *= 10) {
    double seconds = wide(o, name, step, share, step == n ? goal : 0, bench_runs(o, 3));
    if (step < n && 15 * seconds > 60) {
      printf("%-8s stops here: n=%zu would take more than a minute (ask with --n)\n", name, 10 * step);
      return;
    }
  }
}

int main(int argc, char **argv) {
  bench_options o;
  bench_options_read(&o, argc, argv);
  while (bench_next_part(&o)) {
    if (bench_wants(&o, "boxes")) row_boxes(&o, "boxes", 1, 0.65);
    if (bench_wants(&o, "boxes2")) row_boxes(&o, "boxes2", 2, 0.4);
    if (bench_wants(&o, "thick")) row_wide(&o, "thick", 100000, 0.03, 5);
    if (bench_wants(&o, "overlap")) row_wide(&o, "overlap", 10000, 0.5, 10);
    if (bench_wants(&o, "line") && !o.n) wide(&o, "line", 500, 0.1, 0, bench_runs(&o, 3));
    if (bench_wants(&o, "line")) wide(&o, "line", bench_size(&o, 2000), 0.1, 5, bench_runs(&o, 3));
  }
  bench_options_close(&o);
  return 0;
}
