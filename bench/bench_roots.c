/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Row roots: computable points (sqrt(a) + sqrt(b), sqrt(c) + sqrt(d)) as streams through the engine, until decided. */
#include "answers.h"
#include "ours.h"
#include "peer.h"

#include <dyadel/engine.h>
#include <stdlib.h>
#include <string.h>

/* Writes "sqrt(a)" at the end of a text. */
static char *write_root(char *end, uint32_t a) {
  char digit[10];
  int n = 0;
  memcpy(end, "sqrt(", 5);
  end += 5;
  do digit[n++] = (char)('0' + a % 10);
  while (a /= 10);
  while (n) *end++ = digit[--n];
  *end++ = ')';
  return end;
}

static void add_point(dyd_engine *e, const uint32_t r[4], dyd_error *err) {
  dyd_real *coordinate[2] = {NULL, NULL};
  dyd_stream *s = NULL;
  for (int k = 0; k < 2; k++) {
    char text[64];
    char *end = write_root(text, r[2 * k]);
    *end++ = '+';
    end = write_root(end, r[2 * k + 1]);
    bench_need("roots", dyd_real_parse(&coordinate[k], text, (size_t)(end - text), err), err);
  }
  bench_need("roots", dyd_stream_from_reals(&s, coordinate[0], coordinate[1]), err);
  bench_need("roots", dyd_engine_add_stream(e, s, NULL), err);
}

/* Writing the text is part of the cost, as is making the numbers for the peer. */
static bench_cost run(char *remark, size_t size, bench_edges *edges, size_t *legal, size_t *undecided, double *input,
                      size_t n, const uint32_t *r) {
  dyd_engine *e = NULL;
  dyd_outcome outcome = DYD_OUTCOME_NONE;
  dyd_error err;
  size_t count[4];
  dyd_error_clear(&err);
  bench_meter meter = bench_start();
  bench_need("roots", dyd_engine_new(&e), &err);
  for (size_t i = 0; i < n; i++) add_point(e, r + 4 * i, &err);
  bench_need("roots", dyd_engine_run(&outcome, e, NULL, &err), &err);
  const dyd_delaunay *pd = dyd_engine_delaunay(e);
  dyd_delaunay_count(count, pd);
  bench_cost cost = bench_stop(&meter);
  *input = (double)dyd_sites_memory(dyd_delaunay_sites(pd)) / (double)n;
  if (edges) ours_edges(edges, "roots", pd);
  *legal = count[DYD_LEGAL];
  *undecided = count[DYD_INDETERMINATE] + count[DYD_TIE];
  snprintf(remark, size, "outcome %s; legal %zu; undecided %zu", dyd_outcome_text(outcome), count[DYD_LEGAL],
           *undecided);
  dyd_engine_free(e);
  return cost;
}

static uint32_t *radicands(size_t n) {
  uint32_t *r = malloc(4 * n * sizeof *r);
  uint64_t state = 4;
  if (!r) bench_die("roots", "out of memory");
  for (size_t i = 0; i < 4 * n; i++) {
    state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    r[i] = (uint32_t)((state >> 33) % 1000000) + 1;
  }
  return r;
}

static void row_roots(const bench_options *o, size_t n) {
  uint32_t *r = radicands(n);
  bench_series ours = {0}, peer = {0};
  bench_edges edges = {0}, peers = {0};
  size_t legal = 0, undecided = 0;
  double input = 0;
  char remark[200];
  for (size_t k = 0; k < bench_runs(o, 3); k++) {
    bench_cost cost;
    bench_series_add(&ours, run(remark, sizeof remark, k ? NULL : &edges, &legal, &undecided, &input, n, r));
    if (peer_roots(&cost, k ? NULL : &peers, n, r)) bench_series_add(&peer, cost);
  }
  if (bench_edges_missing(&peers, &edges)) bench_die("roots", "the peer has an edge that is not possible here");
  if (peers.count && undecided == 0 && edges.count != peers.count)
    bench_die("roots", "decided, yet not the peer's edges");
  bench_check_numbers(o, "roots", n, legal, undecided, 0);
  bench_report(o, &(bench_row){.name = "roots",
                               .n = n,
                               .ours = &ours,
                               .peer = &peer,
                               .peer_name = peer_roots_name(),
                               .ratio_goal = n < 100000 ? 0.6 : 0.4,
                               .input_bytes = input,
                               .remark = remark});
  bench_edges_clear(&edges);
  bench_edges_clear(&peers);
  free(r);
}

int main(int argc, char **argv) {
  bench_options o;
  bench_options_read(&o, argc, argv);
  if (bench_wants(&o, "roots")) {
    row_roots(&o, bench_size(&o, 10000));
    if (!o.n) row_roots(&o, 100000);
  }
  bench_options_close(&o);
  return 0;
}
