/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Rows over exact points: uniform, arrays, grid, circle, cocircular, capped, growth. */
#include "answers.h"
#include "cloud.h"
#include "ours.h"
#include "peer.h"

#include <string.h>

typedef struct contest {
  bench_series ours, peer;
  ours_answer answer;
  bench_edges peer_edges;
} contest;

static void contest_clear(contest *c) {
  bench_edges_clear(&c->answer.edges);
  bench_edges_clear(&c->peer_edges);
}

/* Interleaved runs. The edges are compared in the first round only: all runs of one program are the same. */
static void contest_run(contest *c, const char *row, const cloud *points, ours_what what, size_t runs) {
  memset(c, 0, sizeof *c);
  for (size_t r = 0; r < runs; r++) {
    ours_answer again;
    bench_cost cost;
    bool first = r == 0;
    ours_what now = first && what == OURS_STATUSES ? OURS_AND_EDGES : what;
    bench_series_add(&c->ours, ours_run(first ? &c->answer : &again, row, points, now, 1));
    if (!first) bench_edges_clear(&again.edges);
    if (peer_points(&cost, first ? &c->peer_edges : NULL, points->n, points->x, points->y))
      bench_series_add(&c->peer, cost);
  }
}

/* Every edge of the peer must be possible; without ties the two lists must be the same. */
static void compare(char *remark, size_t size, const char *row, const contest *c) {
  const ours_answer *a = &c->answer;
  size_t ties = a->count[DYD_TIE], peer = c->peer_edges.count, ours = a->edges.count;
  if (a->count[DYD_INDETERMINATE]) bench_die(row, "indeterminate pairs of exact points");
  if (ours != a->count[DYD_LEGAL] + ties) bench_die(row, "pairs counted and listed differ");
  if (c->peer.count == 0) {
    snprintf(remark, size, "legal %zu; tied %zu; no peer to compare with", a->count[DYD_LEGAL], ties);
    return;
  }
  if (bench_edges_missing(&c->peer_edges, &a->edges)) bench_die(row, "the peer has an edge that is not possible here");
  if (ties == 0 && ours != peer) bench_die(row, "without ties the edges must be the peer's");
  if (ties == 0)
    snprintf(remark, size, "the %zu edges are the peer's", ours);
  else
    snprintf(remark, size, "legal %zu; tied %zu: the peer gives %zu edges: one choice among the ties",
             a->count[DYD_LEGAL], ties, peer);
}

static void row_of(const bench_options *o, const bench_row *goals, cloud *points, ours_what what, size_t runs) {
  contest c;
  char remark[200];
  bench_row row = *goals;
  contest_run(&c, row.name, points, what, bench_runs(o, runs));
  compare(remark, sizeof remark, row.name, &c);
  bench_check(o, row.name, points->n, c.answer.count);
  row.n = points->n;
  row.output = c.answer.count[DYD_LEGAL] + c.answer.count[DYD_TIE];
  row.ours = &c.ours;
  row.peer = &c.peer;
  row.peer_name = peer_points_name();
  row.input_bytes = c.answer.input_bytes / (double)points->n;
  row.remark = remark;
  bench_report(o, &row);
  contest_clear(&c);
  cloud_clear(points);
}

static void row_uniform(const bench_options *o) {
  cloud points;
  bench_row goals = {.name = "uniform", .ratio_bar = 2.0, .ratio_goal = 0.38, .total_bar = 400, .beyond_goal = 100};
  cloud_uniform(&points, bench_size(o, 1000000));
  row_of(o, &goals, &points, OURS_STATUSES, 5);
}

/* What a binding hands over: the triangles of `uniform` and their neighbours; against the time of the run itself. */
static void row_arrays(const bench_options *o) {
  static const bench_series no_peer;
  cloud points;
  bench_series arrays = {0}, run = {0};
  ours_answer answer;
  if (o->part > 1) return;
  cloud_uniform(&points, bench_size(o, 1000000));
  for (size_t r = 0; r < bench_runs(o, 5); r++) {
    bench_series_add(&arrays, ours_run(&answer, "arrays", &points, OURS_ARRAYS, 1));
    bench_series_add(&run, ours_run(&answer, "arrays", &points, OURS_STATUSES, 1));
  }
  bench_check(o, "uniform", points.n, answer.count);
  bench_report(o, &(bench_row){.name = "arrays",
                               .n = points.n,
                               .ours = &arrays,
                               .peer = &no_peer,
                               .measure = "of the run",
                               .figure = bench_series_median(&arrays).seconds / bench_series_median(&run).seconds,
                               .figure_goal = 0.2,
                               .remark = "triangles and neighbours as found"});
  cloud_clear(&points);
}

static void row_grid(const bench_options *o) {
  cloud points;
  bench_row goals = {.name = "grid", .ratio_goal = 0.8};
  cloud_grid(&points, bench_size(o, 1000000));
  row_of(o, &goals, &points, OURS_LISTED, 3);
}

static void row_circle(const bench_options *o) {
  cloud points;
  bench_row goals = {.name = "circle", .ratio_goal = 1.0};
  cloud_circle(&points, bench_size(o, 100000));
  row_of(o, &goals, &points, OURS_STATUSES, 5);
}

/* Integers exactly on one circle: every pair is tied. */
static void row_cocircular(const bench_options *o) {
  cloud points;
  bench_row goals = {.name = "cocircular", .ratio_goal = 0};
  if (o->part > 1) return;
  cloud_cocircular(&points, 8);
  row_of(o, &goals, &points, OURS_STATUSES, 3);
}

/* So many of them that their pairs are beyond the cap: said with a message, at no great cost. */
static void row_capped(const bench_options *o) {
  cloud points;
  bench_series ours = {0};
  char remark[300];
  if (o->part > 1) return;
  cloud_cocircular(&points, 10);
  for (size_t r = 0; r < bench_runs(o, 3); r++) bench_series_add(&ours, ours_capped(remark, sizeof remark, &points));
  bench_report_seconds(o, "capped", points.n, &ours, 1, remark);
  cloud_clear(&points);
}

/* Time a point at 10^4, 10^5, ... up to the size asked for; the greatest over the least must stay below 2. */
static void row_growth(const bench_options *o) {
  static const bench_series no_peer;
  double least = 0, greatest = 0;
  if (o->part > 1) return;
  for (size_t n = 10000; n <= bench_size(o, 10000000); n *= 10) {
    cloud points;
    bench_series ours = {0};
    ours_answer answer;
    char remark[100];
    cloud_uniform(&points, n);
    for (size_t r = 0; r < bench_runs(o, n > 1000000 ? 1 : 5); r++)
      bench_series_add(&ours, ours_run(&answer, "growth", &points, OURS_STATUSES, 1));
    double each = bench_series_median(&ours).seconds / (double)n;
    least = least == 0 || each < least ? each : least;
    greatest = each > greatest ? each : greatest;
    snprintf(remark, sizeof remark, "of the time a point from 10^4 on");
    bench_report(o, &(bench_row){.name = "growth",
                                 .n = n,
                                 .ours = &ours,
                                 .peer = &no_peer,
                                 .input_bytes = answer.input_bytes / (double)n,
                                 .measure = "greatest over least",
                                 .figure = greatest / least,
                                 .figure_goal = 2,
                                 .remark = remark});
    cloud_clear(&points);
  }
}

int main(int argc, char **argv) {
  bench_options o;
  bench_options_read(&o, argc, argv);
  while (bench_next_part(&o)) {
    if (bench_wants(&o, "uniform")) row_uniform(&o);
    if (bench_wants(&o, "arrays")) row_arrays(&o);
    if (bench_wants(&o, "grid")) row_grid(&o);
    if (bench_wants(&o, "circle")) row_circle(&o);
    if (bench_wants(&o, "cocircular")) row_cocircular(&o);
    if (bench_wants(&o, "capped")) row_capped(&o);
    if (bench_wants(&o, "growth")) row_growth(&o);
  }
  bench_options_close(&o);
  return 0;
}
