/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What rows have answered. A row whose input is made anew is recorded anew: a run with --known prints the line. */
#include "answers.h"

#include <dyadel/delaunay.h>
#include <string.h>

typedef struct answer {
  const char *row;
  size_t n, legal, indeterminate, tied;
} answer;

static const answer known[] = {
    {"uniform", 10000, 29974, 0, 0},        {"uniform", 1000000, 2999957, 0, 0}, {"grid", 10000, 19800, 0, 39006},
    {"grid", 1000000, 1998000, 0, 3990006}, {"circle", 10000, 19997, 0, 0},      {"circle", 100000, 199997, 0, 0},
    {"cocircular", 1024, 1024, 0, 522752},  {"boxes", 1000000, 2999940, 34, 0},  {"boxes2", 1000000, 2999940, 34, 0},
    {"thick", 1000, 2270, 1516, 0},         {"thick", 10000, 23188, 14637, 0},   {"thick", 100000, 233850, 143039, 0},
    {"overlap", 1000, 2, 26304, 0},         {"overlap", 10000, 16, 279967, 0},   {"airports05", 3376, 5067, 13100, 0},
    {"airports1", 3376, 1857, 28714, 0},    {"airports3", 3376, 80, 113350, 0},  {"outliers", 600, 153, 9272, 0},
    {"outliers", 3000, 149, 136199, 0},     {"clusters", 600, 1060, 1829, 0},    {"clusters", 6000, 2556, 97018, 0},
    {"tracks", 600, 0, 23813, 0},           {"tracks", 40000, 9, 1767332, 0},    {"coast", 600, 1441, 607, 0},
    {"coast", 100000, 248885, 109732, 0},
};

void bench_check(const bench_options *o, const char *row, size_t n, const size_t count[4]) {
  char text[200];
  snprintf(text, sizeof text, "answers {\"%s\", %zu, %zu, %zu, %zu}", row, n, count[DYD_LEGAL],
           count[DYD_INDETERMINATE], count[DYD_TIE]);
  for (size_t k = 0; k < sizeof known / sizeof *known; k++) {
    const answer *a = &known[k];
    if (strcmp(a->row, row) || a->n != n) continue;
    if (a->legal == count[DYD_LEGAL] && a->indeterminate == count[DYD_INDETERMINATE] && a->tied == count[DYD_TIE])
      return;
    bench_die(row, strncat(text, ", which were others", sizeof text - strlen(text) - 1));
  }
  if (o->known) bench_die(row, strncat(text, ", which are not recorded", sizeof text - strlen(text) - 1));
}
