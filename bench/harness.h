/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What every benchmark driver shares: arguments, cost meter, medians, the table and the CSV.
 *
 * A cost is CPU time of the whole process (all threads), time by the clock, and the peak of resident memory beyond what
 * was resident at the start: Linux lets a process reset its own high-water mark. */
#ifndef DYD_BENCH_HARNESS_H
#define DYD_BENCH_HARNESS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

#define BENCH_MAX_RUNS 99

typedef struct bench_options {
  int argc; /* row names asked for; none: all */
  char **argv;
  size_t n;    /* 0: each row's own size */
  size_t runs; /* 0: each row's own number */
  size_t part; /* rows are made that many times smaller, and only kept for the growth of those that follow */
  bool known;  /* answers that are not recorded end the program */
  const char *csv;
  FILE *out; /* open CSV, or NULL */
} bench_options;

/* Exits with 2 on bad usage: this is a program. */
void bench_options_read(bench_options *o, int argc, char **argv);
void bench_options_close(bench_options *o);
/* Every row twice: at a quarter of its size, then at its own; with --n at that size alone. false: no more. */
bool bench_next_part(bench_options *o);
bool bench_wants(const bench_options *o, const char *row);
size_t bench_size(const bench_options *o, size_t otherwise);
size_t bench_runs(const bench_options *o, size_t otherwise);

typedef struct bench_cost {
  double seconds, wall; /* CPU time; by the clock */
  double bytes;         /* peak beyond the start; negative when the system does not tell */
} bench_cost;

typedef struct bench_meter {
  double seconds, wall, bytes;
} bench_meter;
bench_meter bench_start(void);
bench_cost bench_stop(const bench_meter *m);

/* Costs of the runs of one contestant. */
typedef struct bench_series {
  size_t count;
  double seconds[BENCH_MAX_RUNS], wall[BENCH_MAX_RUNS], bytes[BENCH_MAX_RUNS];
} bench_series;
void bench_series_add(bench_series *s, bench_cost c);
/* Medians over the runs; zeros when there was none. */
bench_cost bench_series_median(const bench_series *s);

/* One line of the result. A goal or bar of 0 does not exist. */
typedef struct bench_row {
  const char *name;
  size_t n;
  const bench_series *ours, *peer; /* peer may be empty */
  const char *peer_name;
  bool by_the_clock;                  /* compare times by the clock, for rows with several threads */
  double input_bytes;                 /* what the table of sites holds, per point; part of ours' peak */
  double ratio_bar, ratio_goal;       /* of time, ours to the peer */
  double total_bar, beyond_goal;      /* bytes a point: the whole peak / the peak less the input */
  const char *measure;                /* what else is measured, with its unit; NULL: nothing */
  double figure, figure_goal;         /* of that; the goal is an upper bound */
  double bytes_each, bytes_each_goal; /* bytes a possible pair, in all; 0: not of interest */
  size_t output;                      /* what the answer's size grows like; 0: n */
  const char *remark;
} bench_row;
/* Prints the row with its goals, and appends it to the CSV; and with what exponent its time grows since the row of that
 * name reported before, with the points or, if there is more of it, with the output. */
void bench_report(const bench_options *o, const bench_row *row);
/* The same of a row of seconds, up to a goal, that nobody else stands beside. */
void bench_report_seconds(const bench_options *o, const char *name, size_t n, const bench_series *ours, double goal,
                          const char *remark);
/* Ends the program with a message: the answer is wrong or the library failed. */
void bench_die(const char *row, const char *what);

#ifdef __cplusplus
}
#endif
#endif
