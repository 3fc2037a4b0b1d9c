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

const char *cli_suggest(const char *name, const char *(*candidate)(size_t k)) {
  const char *best = NULL, *one;
  size_t length = strlen(name), least = length < 3 ? length : 2 + length / 3; /* a third of the letters may be wrong */
  for (size_t k = 0; (one = candidate(k)); k++) {
    size_t d = length > 1 && strncmp(name, one, length) == 0 ? 0 : edit_distance(name, one);
    if (d >= least) continue;
    least = d;
    best = one;
  }
  return best;
}
