/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* From which place to project: one that is exact, or narrow for the distance of its nearest neighbour.
 *
 * A guess in doubles: on it depends how wide images are, not whether they are right. */
#include "base/alloc.h"
#include "base/error.h"
#include "sphere/state.h"
#include <math.h>

/* Where a place is about: a vector of length 1, and how far from it the place may be. */
typedef struct ball_guess {
  double at[3], reach;
  uint32_t place;
} ball_guess;

/* How many pairs are looked at, about, and candidates at most. */
enum { WORK = 1 << 20, CANDIDATES = 16 };

static void guess_set(ball_guess *out, const dyd_sphere *s, uint32_t i) {
  static const double degree = 0.017453292519943295;
  const dyd_rough_place *r = &s->rough[i];
  double lon = degree * r->at[0], lat = degree * r->at[1], dx = degree * r->half[0], dy = degree * r->half[1];
  *out = (ball_guess){{cos(lat) * cos(lon), cos(lat) * sin(lon), sin(lat)}, .place = i};
  out->reach = dy + fmin(dx * cos(fmax(0, fabs(lat) - dy)), 4) + mpq_get_d(s->angle);
}

static int compare_guesses(const void *a, const void *b) {
  const ball_guess *x = a, *y = b;
  if (x->reach != y->reach) return x->reach < y->reach ? -1 : 1;
  return (x->place > y->place) - (x->place < y->place);
}

/* The distance that is left between place k and the others. */
static double guess_gap(const ball_guess *g, size_t n, size_t k) {
  double least = 4;
  for (size_t j = 0; j < n; j++) {
    if (j == k) continue;
    double x = g[j].at[0] - g[k].at[0], y = g[j].at[1] - g[k].at[1], z = g[j].at[2] - g[k].at[2];
    least = fmin(least, sqrt(x * x + y * y + z * z) - g[j].reach);
  }
  return least - g[k].reach;
}

/* Those that are narrowest are looked at, spread among all that are exact; more only while none is apart. */
static double guess_best(uint32_t *out, const ball_guess *g, size_t n) {
  size_t exact = 0, tried = 0, most = 1 + WORK / (n + 1);
  double best = -1;
  while (exact < n && g[exact].reach == 0) exact++;
  if (most > CANDIDATES) most = CANDIDATES;
  size_t step = exact > most ? exact / most : 1;
  for (size_t k = 0; k < n && (tried < most || best <= 0); k += k < exact ? step : 1, tried++) {
    double gap = guess_gap(g, n, k), score = gap <= 0 ? gap : g[k].reach == 0 ? 1e9 + gap : gap / g[k].reach;
    if (best > 1e9 && g[k].reach > 0) break;
    if (tried && score <= best) continue;
    best = score;
    *out = g[k].place;
  }
  return best;
}

dyd_status dyd_sphere_choose(uint32_t *out, const dyd_sphere *s, dyd_error *err) {
  ball_guess *g = dyd_alloc(s->count, sizeof *g);
  size_t n = 0;
  if (!g) return dyd_fail_nomem(err);
  for (uint32_t i = 0; i < s->count; i++)
    if (s->alias[i] == i) guess_set(&g[n++], s, i);
  qsort(g, n, sizeof *g, compare_guesses);
  double best = guess_best(out, g, n);
  free(g);
  if (best > 0 || n < 2) return DYD_OK;
  return dyd_fail(err, DYD_E_ARG,
                  "each point may be at the same place as another one, so that nothing is known of any; give a smaller "
                  "radius, or --merge where such points are one");
}
