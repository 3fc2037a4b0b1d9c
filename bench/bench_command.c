/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Rows command, command2: the whole command from a file of decimals of 17 digits to a csv of all pairs, by one thread
 * and by two (by the clock), against a program that does the same with CGAL. Both are processes; both times are those
 * of the whole process, bytes are its peak. */
#define _DEFAULT_SOURCE 1 /* wait4 */
#include "answers.h"
#include "bench_config.h"
#include "cloud.h"
#include "edges.h"
#include "harness.h"

#include <fcntl.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

extern char **environ;

enum { PATH_SIZE = 32 };

static double clock_now(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void temporary(char path[PATH_SIZE]) {
  snprintf(path, PATH_SIZE, "/tmp/bench-XXXXXX");
  int fd = mkstemp(path);
  if (fd < 0) bench_die("command", "no temporary file");
  close(fd);
}

static double time_of(struct timeval t) {
  return (double)t.tv_sec + 1e-6 * (double)t.tv_usec;
}

/* Runs the program with its standard output to the file `to`. */
static bench_cost run_program(char *const argv[], const char *to) {
  posix_spawn_file_actions_t actions;
  pid_t child;
  int status;
  struct rusage usage;
  double start = clock_now();
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, to, O_WRONLY | O_TRUNC, 0);
  if (posix_spawn(&child, argv[0], &actions, NULL, argv, environ)) bench_die("command", "a program does not start");
  posix_spawn_file_actions_destroy(&actions);
  if (wait4(child, &status, 0, &usage) != child || status != 0) bench_die("command", "a program failed");
  return (bench_cost){time_of(usage.ru_utime) + time_of(usage.ru_stime), clock_now() - start,
                      1024 * (double)usage.ru_maxrss};
}

/* The first two numbers of all lines that have them, sorted. */
static void read_edges(bench_edges *out, const char *path) {
  FILE *f = fopen(path, "r");
  char line[80];
  size_t cap = 0;
  while (f && fgets(line, sizeof line, f)) {
    unsigned i, j;
    if (sscanf(line, "%u,%u", &i, &j) != 2) continue;
    if (out->count == cap) out->item = realloc(out->item, (cap = 2 * cap + 1000) * sizeof *out->item);
    if (!out->item) bench_die("command", "out of memory");
    out->item[out->count++] = (bench_edge){i, j};
  }
  if (f) fclose(f);
  bench_edges_sort(out);
}

typedef struct contest {
  char in[PATH_SIZE], ours[PATH_SIZE], peer[PATH_SIZE]; /* files */
  bench_edges edges, others;
} contest;

static void contest_begin(contest *c, size_t n) {
  cloud points;
  cloud_uniform(&points, n);
  temporary(c->in);
  temporary(c->ours);
  temporary(c->peer);
  FILE *f = fopen(c->in, "w");
  for (size_t i = 0; f && i < n; i++) fprintf(f, "%.17g %.17g\n", points.x[i], points.y[i]);
  if (!f || fclose(f)) bench_die("command", "writing failed");
  cloud_clear(&points);
}

static void contest_end(contest *c) {
  bench_edges_clear(&c->edges);
  bench_edges_clear(&c->others);
  unlink(c->in);
  unlink(c->ours);
  unlink(c->peer);
}

static void row_command(const bench_options *o, const char *name, unsigned threads, double goal) {
  contest c = {0};
  bench_series ours = {0}, peer = {0};
  size_t n = bench_size(o, 1000000);
  char remark[100] = "no peer to compare with";
  char count[16];
  contest_begin(&c, n);
  snprintf(count, sizeof count, "%u", threads);
  char *const dyadel[] = {(char[]){BENCH_DYADEL}, "delaunay", "--quiet", "--threads", count, c.in, NULL};
  char *const cgal[] = {(char[]){BENCH_PEER}, c.in, NULL};
  for (size_t r = 0; r < bench_runs(o, 3); r++) {
    bench_series_add(&ours, run_program(dyadel, c.ours));
    if (*cgal[0]) bench_series_add(&peer, run_program(cgal, c.peer));
  }
  read_edges(&c.edges, c.ours);
  if (*cgal[0]) {
    read_edges(&c.others, c.peer);
    if (c.edges.count != c.others.count || bench_edges_missing(&c.others, &c.edges))
      bench_die(name, "the edges are not the peer's");
    snprintf(remark, sizeof remark, "the %zu edges are the peer's", c.edges.count);
  }
  bench_check_numbers(o, name, n, c.edges.count, 0, 0);
  bench_report(o, &(bench_row){.name = name,
                               .n = n,
                               .ours = &ours,
                               .peer = &peer,
                               .peer_name = "a program with CGAL",
                               .ratio_goal = goal,
                               .by_the_clock = threads > 1,
                               .remark = remark});
  contest_end(&c);
}

int main(int argc, char **argv) {
  bench_options o;
  bench_options_read(&o, argc, argv);
  while (bench_next_part(&o)) {
    if (bench_wants(&o, "command")) row_command(&o, "command", 1, 0.65);
    if (bench_wants(&o, "command2")) row_command(&o, "command2", 2, 0.5);
  }
  bench_options_close(&o);
  return 0;
}
