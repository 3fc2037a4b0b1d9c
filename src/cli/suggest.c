/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* "Did you mean": the name nearest to what was typed, in edits of one character (Damerau and Levenshtein, in the form
 * where no piece is edited twice). */
#include "table.h"
#include <string.h>

enum { LONGEST = 63 };

static size_t least_size(size_t a, size_t b) {
  return a < b ? a : b;
}

/* The number of insertions, deletions, changes and swaps of neighbours from a to b; LONGEST for long words. */
static size_t edit_distance(const char *a, const char *b) {
  size_t m = strlen(a), n = strlen(b), d[LONGEST + 1][LONGEST + 1];
  if (m > LONGEST || n > LONGEST) return LONGEST;
  for (size_t i = 0; i <= m; i++) {
    for (size_t j = 0; j <= n; j++) {
      if (i == 0 || j == 0) {
        d[i][j] = i + j;
        continue;
      }
      d[i][j] = least_size(least_size(d[i - 1][j], d[i][j - 1]) + 1, d[i - 1][j - 1] + (a[i - 1] != b[j - 1]));
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = least_size(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[m][n];
}

void cli_suggest_begin(cli_suggestion *s, const char *name) {
  /* A third of the letters may be wrong. */
  *s = (cli_suggestion){.name = name, .distance = 2 + strlen(name) / 3};
  if (strlen(name) < 3) s->distance = strlen(name);
}

void cli_suggest_try(cli_suggestion *s, const char *candidate) {
  size_t length = strlen(s->name);
  bool begins = length > 1 && strncmp(s->name, candidate, length) == 0;
  size_t d = begins ? 0 : edit_distance(s->name, candidate);
  if (d >= s->distance) return;
  s->distance = d;
  s->best = candidate;
}
