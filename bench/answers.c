/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What rows have answered. A row whose input is made anew is recorded anew: a run with --known prints the line. */
#include "answers.h"

#include <dyadel/delaunay.h>
#include <string.h>

/* number: of legal, indeterminate, tied pairs, or what the row says. */
typedef struct answer {
  const char *row;
  size_t n, number[3];
} answer;

static const answer known[] = {
    {"uniform", 10000, {29974, 0, 0}},
    {"uniform", 1000000, {2999957, 0, 0}},
    {"grid", 10000, {19800, 0, 39006}},
    {"grid", 1000000, {1998000, 0, 3990006}},
    {"circle", 10000, {19997, 0, 0}},
    {"circle", 100000, {199997, 0, 0}},
    {"cocircular", 1024, {1024, 0, 522752}},
    {"boxes", 1000000, {2999940, 34, 0}},
    {"boxes2", 1000000, {2999940, 34, 0}},
    {"thick", 1000, {2270, 1516, 0}},
    {"thick", 10000, {23188, 14637, 0}},
    {"thick", 100000, {233850, 143039, 0}},
    {"overlap", 1000, {2, 26304, 0}},
    {"overlap", 10000, {16, 279967, 0}},
    {"line", 500, {499, 124251, 0}},
    {"line", 1000, {999, 498501, 0}},
    {"line", 2000, {1999, 1997001, 0}},
    {"airports05", 3376, {5067, 13100, 0}},
    {"airports1", 3376, {1857, 28714, 0}},
    {"airports3", 3376, {80, 113350, 0}},
    {"outliers", 600, {153, 9272, 0}},
    {"outliers", 3000, {149, 136199, 0}},
    {"clusters", 600, {1060, 1829, 0}},
    {"clusters", 6000, {2556, 97018, 0}},
    {"tracks", 600, {0, 23813, 0}},
    {"tracks", 40000, {9, 1767332, 0}},
    {"coast", 600, {1441, 607, 0}},
    {"coast", 100000, {248885, 109732, 0}},
    {"verify-airports", 3376, {1857, 28714, 32}},
    {"verify-tracks", 600, {0, 23813, 32}},
    {"verify-tracks", 2000, {0, 84964, 32}},
    {"read", 1000, {2976, 0, 0}},
    {"write", 1000, {41, 0, 0}},
    {"write-json", 1000, {508, 0, 0}},
    {"write-wkt", 1000, {339, 0, 0}},
    {"write-obj", 1000, {98, 0, 0}},
    {"write-vtk", 1000, {114, 0, 0}},
    {"write-svg", 1000, {843, 0, 0}},
    {"write-geojson", 1000, {732, 0, 0}},
    {"readhex", 1000, {2976, 0, 0}},
    {"command", 1000, {2976, 0, 0}},
    {"command2", 1000, {2976, 0, 0}},
    {"near", 64, {125, 0, 0}},
    {"roots", 1000, {2982, 0, 0}},
    {"cells", 300, {360244, 4378, 0}},
    {"cells-near", 300, {213981220, 118349596, 0}},
    {"cells-apart", 300, {599944798, 128846256, 0}},
    {"cells-touch", 300, {962881239, 171417161, 0}},
    {"cells-gps", 300, {797681118, 193242790, 0}},
    {"cells-grid", 289, {811275523, 403466810, 0}},
    {"discs", 300, {152, 2266, 0}},
    {"tiles", 300, {300, 1738, 0}},
    {"tiles-grid", 289, {289, 1156, 0}},
    {"diagram", 300, {300, 1738, 0}},
    {"clip", 300, {390, 0, 0}},
    {"update-10", 600, {22, 0, 0}},
    {"remeasure", 600, {7, 18885, 0}},
    {"remeasure", 2000, {0, 78887, 0}},
    {"read", 1000000, {2999957, 0, 0}},
    {"write", 1000000, {59332, 0, 0}},
    {"write-json", 1000000, {546545, 0, 0}},
    {"write-wkt", 1000000, {360258, 0, 0}},
    {"write-obj", 1000000, {134819, 0, 0}},
    {"write-vtk", 1000000, {150829, 0, 0}},
    {"write-svg", 1000000, {133, 0, 0}},
    {"write-geojson", 1000000, {756252, 0, 0}},
    {"readhex", 1000000, {2999957, 0, 0}},
    {"command", 1000000, {2999957, 0, 0}},
    {"command2", 1000000, {2999957, 0, 0}},
    {"roots", 10000, {29979, 0, 0}},
    {"roots", 100000, {299975, 0, 0}},
    {"cells", 100000, {67864, 13931, 0}},
    {"cells-near", 2000, {229421791, 46173768, 0}},
    {"cells-apart", 1000, {600348949, 68405466, 0}},
    {"cells-touch", 1000, {968501267, 96057538, 0}},
    {"cells-gps", 10000, {851584209, 38770503, 0}},
    {"cells-grid", 10000, {848220908, 362038672, 0}},
    {"discs", 10000, {3833, 91684, 0}},
    {"tiles", 1000000, {1000000, 5996398, 0}},
    {"tiles-grid", 1000000, {1000000, 4000000, 0}},
    {"diagram", 1000000, {1000000, 5996398, 0}},
    {"update-10", 1000000, {38, 17, 0}},
    {"update-100", 1000000, {212, 17, 0}},
    {"update-1000", 1000000, {2061, 17, 0}},
    {"plan", 1000, {10600, 0, 871}},
    {"deaths", 3000, {8979, 25632917262, 0}},
    {"deaths", 1000000, {2999957, 11305062, 0}},
    {"radii", 3000, {8979, 25632917262, 770186865}},
    {"radii", 1000000, {2999957, 11305062, 13912265035}},
    {"weights", 3000, {8980, 167643598321, 0}},
    {"weights", 100000, {299974, 754238191, 0}},
    {"squares", 3000, {8980, 8124158415, 0}},
    {"squares", 100000, {299974, 231677543, 0}},
    {"births", 3000, {32269, 9424018664, 0}},
    {"births", 20000, {217056, 2520146529, 0}},
    {"births-weights", 3000, {13221, 167643598321, 0}},
    {"births-squares", 3000, {40971, 8124158415, 0}},
    {"hub", 3000, {8087, 1937947031, 0}},
    {"hub", 100000, {297313, 1291888, 0}},
    {"sphere", 1800, {5394, 0, 0}},
    {"sphere", 100000, {299994, 0, 0}},
    {"parallels", 1800, {3540, 0, 6900}},
    {"parallels", 64800, {129240, 0, 257400}},
    {"airports", 3376, {10122, 0, 0}},
};

void bench_check(const bench_options *o, const char *row, size_t n, const size_t count[4]) {
  bench_check_numbers(o, row, n, count[DYD_LEGAL], count[DYD_INDETERMINATE], count[DYD_TIE]);
}

void bench_check_numbers(const bench_options *o, const char *row, size_t n, size_t a, size_t b, size_t c) {
  char text[200];
  snprintf(text, sizeof text, "answers {\"%s\", %zu, {%zu, %zu, %zu}}", row, n, a, b, c);
  for (size_t k = 0; k < sizeof known / sizeof *known; k++) {
    const answer *was = &known[k];
    if (strcmp(was->row, row) || was->n != n) continue;
    if (was->number[0] == a && was->number[1] == b && was->number[2] == c) return;
    bench_die(row, strncat(text, ", which were others", sizeof text - strlen(text) - 1));
  }
  if (o->known) bench_die(row, strncat(text, ", which are not recorded", sizeof text - strlen(text) - 1));
}
