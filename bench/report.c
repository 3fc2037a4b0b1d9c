/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Arguments in, table and CSV out.
 *
 * CSV:
 * row,n,ours_ns_per_point,peer,peer_ns_per_point,ratio,ratio_goal,ours_bytes_per_point,peer_bytes_per_point,measure,
 * figure,figure_goal,flags,commit,machine. The flags column holds the compiler flags, then the remarks of the row,
 * separated by semicolons. */
#include "bench_commit.h"
#include "bench_config.h"
#include "harness.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void usage(const char *program) {
  fprintf(stderr, "usage: %s [ROW ...] [--n POINTS] [--runs R] [--csv FILE] [--known]\n", program);
  exit(2);
}

static size_t positive(const char *program, const char *text, size_t most) {
  char *end = NULL;
  unsigned long long v = text ? strtoull(text, &end, 10) : 0;
  if (!text || *end || v == 0 || v > most) usage(program);
  return (size_t)v;
}

void bench_options_read(bench_options *o, int argc, char **argv) {
  memset(o, 0, sizeof *o);
  o->argv = argv;
  for (int i = 1; i < argc; i++) {
    const char *a = argv[i], *next = i + 1 < argc ? argv[i + 1] : NULL;
    if (strncmp(a, "--", 2)) {
      o->argv[o->argc++] = argv[i];
      continue;
    }
    if (!strcmp(a, "--known")) {
      o->known = true;
      continue;
    }
    if (!strcmp(a, "--n"))
      o->n = positive(argv[0], next, (size_t)1 << 30);
    else if (!strcmp(a, "--runs"))
      o->runs = positive(argv[0], next, BENCH_MAX_RUNS);
    else if (!strcmp(a, "--csv") && next)
      o->csv = next;
    else
      usage(argv[0]);
    i++;
  }
  if (o->csv && !(o->out = fopen(o->csv, "a"))) {
    perror(o->csv);
    exit(1);
  }
}

void bench_options_close(bench_options *o) {
  if (o->out && fclose(o->out)) perror(o->csv);
  o->out = NULL;
}

bool bench_wants(const bench_options *o, const char *row) {
  for (int i = 0; i < o->argc; i++)
    if (!strcmp(o->argv[i], row)) return true;
  return o->argc == 0;
}

enum { PART = 4 };

bool bench_next_part(bench_options *o) {
  size_t before = o->part;
  o->part = before == 0 && !o->n && !o->known ? PART : 1;
  return before != 1;
}

size_t bench_size(const bench_options *o, size_t otherwise) {
  return o->n ? o->n : otherwise / (o->part ? o->part : 1);
}
size_t bench_runs(const bench_options *o, size_t otherwise) {
  return o->runs ? o->runs : otherwise;
}

void bench_die(const char *row, const char *what) {
  fprintf(stderr, "bench: %s: %s\n", row, what);
  exit(1);
}

/* The processor's name, without commas and quotes. */
static void machine(char *out, size_t size) {
  FILE *f = fopen("/proc/cpuinfo", "r");
  char line[256];
  snprintf(out, size, "unknown");
  while (f && fgets(line, sizeof line, f)) {
    char *colon = strchr(line, ':');
    if (strncmp(line, "model name", 10) || !colon) continue;
    colon[strcspn(colon, "\n")] = 0;
    snprintf(out, size, "%s", colon + 2);
    break;
  }
  if (f) fclose(f);
  for (char *c = out; *c; c++)
    if (*c == ',' || *c == '"') *c = ' ';
}

/* "figure (goal g, bar b)"; a dash where there is no figure. */
static void print_figure(const char *what, double figure, double goal, double bar) {
  if (figure > 0)
    printf("  %s %.3g", what, figure);
  else
    printf("  %s -", what);
  if (goal > 0) printf(" (goal %.3g%s", goal, figure <= goal ? "" : " NOT MET");
  if (bar > 0) printf("%sbar %.3g%s", goal > 0 ? ", " : " (", bar, figure < bar ? "" : " NOT MET");
  if (goal > 0 || bar > 0) printf(")");
}

static void csv_number(FILE *f, double x) {
  if (x > 0) fprintf(f, "%.4g", x);
  fputc(',', f);
}

static void csv_line(const bench_options *o, const bench_row *row, bench_cost ours, bench_cost peer, double ratio,
                     double exponent) {
  char name[200];
  double n = (double)row->n;
  machine(name, sizeof name);
  if (fseek(o->out, 0, SEEK_END) == 0 && ftell(o->out) == 0)
    fputs("row,n,ours_ns_per_point,peer,peer_ns_per_point,ratio,ratio_goal,ours_bytes_per_point,peer_bytes_per_point,"
          "measure,figure,figure_goal,flags,commit,machine\n",
          o->out);
  fprintf(o->out, "%s,%zu,", row->name, row->n);
  csv_number(o->out, ours.seconds / n * 1e9);
  fprintf(o->out, "%s,", row->peer->count ? row->peer_name : "");
  csv_number(o->out, peer.seconds / n * 1e9);
  csv_number(o->out, ratio);
  csv_number(o->out, row->ratio_goal);
  csv_number(o->out, ours.bytes / n);
  csv_number(o->out, peer.bytes / n);
  fprintf(o->out, "%s,", row->measure ? row->measure : "");
  csv_number(o->out, row->figure);
  csv_number(o->out, row->figure_goal);
  fprintf(o->out, "%s; %s", BENCH_FLAGS, row->remark ? row->remark : "");
  if (row->bytes_each > 0) fprintf(o->out, "; %.4g bytes a possible pair", row->bytes_each);
  if (exponent > 0) fprintf(o->out, "; growth %.3g", exponent);
  fprintf(o->out, ",%s,%s\n", BENCH_COMMIT, name);
  fflush(o->out);
}

/* The last report of each row. */
typedef struct earlier {
  char name[24];
  double n, seconds, output;
} earlier;

/* Has the row been reported with fewer points? *exponent: of its growth since. Keeps it for the next report. */
static bool grown(double *exponent, const bench_row *row, double seconds) {
  enum { MOST = 32 };
  static earlier kept[MOST];
  static size_t count;
  earlier now = {.n = (double)row->n, .seconds = seconds, .output = (double)(row->output ? row->output : row->n)};
  size_t k = 0;
  snprintf(now.name, sizeof now.name, "%s", row->name);
  while (k < count && strcmp(kept[k].name, now.name)) k++;
  if (k == MOST) return false;
  count += k == count;
  earlier before = kept[k];
  kept[k] = now;
  if (!(before.n > 0 && now.n > before.n)) return false;
  double points = log(now.n / before.n), output = log(now.output / before.output);
  *exponent = log(now.seconds / before.seconds) / (output > points ? output : points);
  return true;
}

void bench_report(const bench_options *o, const bench_row *row) {
  bench_cost ours = bench_series_median(row->ours), peer = bench_series_median(row->peer);
  if (row->by_the_clock) {
    ours.seconds = ours.wall;
    peer.seconds = peer.wall;
  }
  double exponent = 0, n = (double)row->n;
  bool growth = grown(&exponent, row, ours.seconds);
  if (o->part > 1) return;
  double ratio = row->peer->count ? ours.seconds / peer.seconds : 0;
  printf("%-10s n=%-9zu ours %.1f ns/pt", row->name, row->n, ours.seconds / n * 1e9);
  if (row->peer->count) printf("  %s %.1f ns/pt", row->peer_name, peer.seconds / n * 1e9);
  print_figure("ratio", ratio, row->peer->count ? row->ratio_goal : 0, row->peer->count ? row->ratio_bar : 0);
  if (row->measure) print_figure(row->measure, row->figure, row->figure_goal, 0);
  if (row->bytes_each > 0) print_figure("bytes a possible pair", row->bytes_each, row->bytes_each_goal, 0);
  if (growth) print_figure("growth", exponent, 1.15, 0);
  print_figure("bytes/pt beyond the input", ours.bytes / n - row->input_bytes, row->beyond_goal, 0);
  print_figure("in all", ours.bytes / n, 0, row->total_bar);
  if (row->peer->count) print_figure("peer's", peer.bytes / n, 0, 0);
  printf("  [%s; %zu runs]\n", row->remark ? row->remark : "", row->ours->count);
  fflush(stdout);
  if (o->out) csv_line(o, row, ours, peer, ratio, exponent);
}

void bench_report_seconds(const bench_options *o, const char *name, size_t n, const bench_series *ours, double goal,
                          const char *remark) {
  static const bench_series no_peer;
  bench_report(o, &(bench_row){.name = name,
                               .n = n,
                               .ours = ours,
                               .peer = &no_peer,
                               .measure = "seconds",
                               .figure = bench_series_median(ours).seconds,
                               .figure_goal = goal,
                               .remark = remark});
}
