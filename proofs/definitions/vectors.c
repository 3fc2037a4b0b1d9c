/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What the filters in C say of many numbers, a line for each vector, for definitions.ml.
 *
 * Numbers are chosen where filters could be wrong: integers, neighbours in the last bits, points on a line or a circle,
 * exponents at both ends, zeros of both signs, subnormals, infinities, NaN. */
#include "skeleton/distance_filter.h"
#include "skeleton/mesh_filter.h"
#include "support/random.h"

#include <float.h>
#include <inttypes.h>
#include <math.h>
#include <string.h>

static test_random shared;

/* ---- numbers ---- */

/* What the numbers of one vector have in common. */
typedef struct kind {
  int base;    /* exponent */
  unsigned of; /* 0: anything; 1: small integers; 2: near one place; 3: multiples of one vector, and a little */
  double step;
} kind;

static double special(void) {
  static const double all[] = {0.0,       -0.0,      1,        -1,          DBL_MAX,   -DBL_MAX,
                               INFINITY,  -INFINITY, NAN,      DBL_MIN,     0x1p-1074, -0x1p-1074,
                               0x1p-1023, 0x1p511,   0x1p-511, DBL_MAX / 4, 0x1p1022,  0x1p-537};
  return all[test_below(&shared, sizeof all / sizeof *all)];
}

static double number(const kind *k) {
  double sign = test_chance(&shared, 2) ? 1 : -1, unit = ldexp(1, k->base);
  if (test_below(&shared, 60) == 0) return special();
  switch (k->of) {
  case 1:
    return sign * unit * (double)test_below(&shared, 9);
  case 2:
    return unit * (1 + 0x1p-52 * (double)test_below(&shared, 64));
  case 3:
    return unit * (k->step * (double)test_below(&shared, 8) + 0x1p-52 * (double)test_below(&shared, 2));
  default:
    return sign * ldexp(1 + test_unit(&shared), k->base + (int)test_below(&shared, 12));
  }
}

static kind some_kind(void) {
  static const int bases[] = {0,   0,   0,   -3,   20,   100,  250,  272,  300,   505,
                              511, 515, 600, 1010, -200, -270, -400, -520, -1000, -1070};
  kind k = {bases[test_below(&shared, sizeof bases / sizeof *bases)], (unsigned)test_below(&shared, 4),
            test_unit(&shared)};
  return k;
}

/* ---- lines ---- */

static void begin(const char *name, const double *x, size_t count) {
  printf("%s", name);
  for (size_t q = 0; q < count; q++) {
    uint64_t bits;
    memcpy(&bits, &x[q], sizeof bits);
    printf(" %016" PRIx64, bits);
  }
  fputs(" = ", stdout);
}

static void put_double(double y) {
  uint64_t bits;
  memcpy(&bits, &y, sizeof bits);
  if (isnan(y))
    puts("nan");
  else
    printf("%016" PRIx64 "\n", bits);
}

/* ---- signs ---- */

/* x[0]: the bound, or what belongs in its place; then x and y of points, the last one seen from. UNTOLD: no answer. */
enum { MOST = 9, UNTOLD = 2 };
typedef int sign_filter(const double *x);

static dyd_xy point_of(const double *x, int k) {
  return (dyd_xy){x[2 * k + 1], x[2 * k + 2]};
}

static int sign_orient(const double *x) {
  dyd_mesh m = {.orient_bound = x[0]};
  return dyd_filter_orient(&m, point_of(x, 0), point_of(x, 1), point_of(x, 2));
}
static int sign_orient_near(const double *x) {
  dyd_mesh m = {.incircle_delta = x[0]};
  return dyd_filter_orient_near(&m, point_of(x, 0), point_of(x, 1), point_of(x, 2));
}
static int sign_orient_small(const double *x) {
  int sign;
  dyd_mesh m = {.exact_s = x[0]};
  return dyd_filter_orient_small(&sign, &m, point_of(x, 0), point_of(x, 1), point_of(x, 2)) ? sign : UNTOLD;
}
static int sign_incircle_at(const double *x) {
  dyd_mesh m = {.incircle_delta = x[0]};
  return dyd_filter_incircle_at(&m, dyd_incircle_of(point_of(x, 0), point_of(x, 1), point_of(x, 2), point_of(x, 3)));
}
static int sign_incircle_near(const double *x) {
  dyd_mesh m = {.incircle_delta = x[0]};
  return dyd_filter_incircle_near(&m, point_of(x, 0), point_of(x, 1), point_of(x, 2), point_of(x, 3));
}
static int sign_incircle_small(const double *x) {
  int sign;
  dyd_mesh m = {.exact_s = x[0]};
  dyd_incircle i = dyd_incircle_of(point_of(x, 0), point_of(x, 1), point_of(x, 2), point_of(x, 3));
  return dyd_filter_incircle_small(&sign, &m, i) ? sign : UNTOLD;
}

static const struct {
  const char *name;
  size_t count;
  sign_filter *sign;
} filter[] = {{"orient", 7, sign_orient},
              {"orient_near", 7, sign_orient_near},
              {"orient_small", 7, sign_orient_small},
              {"incircle_at", 9, sign_incircle_at},
              {"incircle_near", 9, sign_incircle_near},
              {"incircle_small", 9, sign_incircle_small}};
enum { FILTERS = sizeof filter / sizeof *filter };

static void put_vector(int f, const double *x) {
  int sign = filter[f].sign(x);
  begin(filter[f].name, x, filter[f].count);
  if (sign == UNTOLD)
    puts("none");
  else
    printf("%d\n", sign);
}

/* Doubles of one sign in their order, as integers. */
static double between(double a, double b) {
  uint64_t x, y;
  memcpy(&x, &a, sizeof x);
  memcpy(&y, &b, sizeof y);
  x = x / 2 + y / 2 + (x & y & 1);
  memcpy(&a, &x, sizeof a);
  return a;
}

/* Where one number is changed until the answer does: both sides of that place, one bit apart. */
static void put_edge(int f, const double *x) {
  double here[MOST], there[MOST], middle[MOST];
  size_t q = test_below(&shared, filter[f].count);
  memcpy(here, x, sizeof here);
  memcpy(there, x, sizeof there);
  there[q] = here[q] * (1 + ldexp(1, -(int)test_below(&shared, 53)));
  if (filter[f].sign(here) == filter[f].sign(there) || !isfinite(there[q])) return;
  memcpy(middle, here, sizeof middle);
  while (middle[q] = between(here[q], there[q]), middle[q] != here[q] && middle[q] != there[q])
    memcpy(filter[f].sign(middle) == filter[f].sign(here) ? here : there, middle, sizeof middle);
  put_vector(f, here);
  put_vector(f, there);
}

/* Two points whose products differ by so few last bits that the bound for three points alone has to tell. */
static void put_near_turn(void) {
  double bits = 5 + (double)test_below(&shared, 3),
         off = ldexp(test_unit(&shared) - 0.5, -(int)test_below(&shared, 30));
  double left = bits / 4.01 * (1 + off), sign = test_chance(&shared, 2) ? 1 : -1;
  const double x[MOST] = {0, left, 1, left - sign * bits * 0x1p-52, 1, 0, 0};
  put_vector(1, x);
}

/* ---- bounds ---- */

static void vectors_of_bounds(const double *x) {
  const dyd_bbox c = {{x[0], x[1], x[2], x[3]}}, b = {{x[4], x[5], x[6], x[7]}};
  begin("orient_bound", x, 3);
  put_double(dyd_filter_orient_bound(x[0], x[1], x[2]));
  begin("lower", x, 1);
  put_double(dyd_lower(x[0]));
  begin("upper", x, 1);
  put_double(dyd_upper(x[0]));
  begin("ds2_lower", x, 8);
  put_double(dyd_ds2_lower(&c, &b));
  begin("dl2_upper", x, 8);
  put_double(dyd_dl2_upper(&c, &b));
  begin("ds2_upper", x, 9);
  put_double(dyd_ds2_upper(&c, &b, x[8]));
  begin("dl2_lower", x, 9);
  put_double(dyd_dl2_lower(&c, &b, x[8]));
}

int main(int argc, char **argv) {
  size_t cases = test_cases(argc > 1 ? strtoul(argv[1], NULL, 10) : 1000);
  shared = test_random_start("vectors");
  for (size_t q = 0; q < cases; q++) {
    kind k = some_kind();
    double x[MOST];
    static const double deltas[] = {0, 0, 0x1p-60, 0x1p40, INFINITY};
    for (int e = 0; e < MOST; e++) x[e] = number(&k);
    vectors_of_bounds(x);
    put_near_turn();
    if (test_chance(&shared, 2)) x[0] = deltas[test_below(&shared, 5)];
    for (int f = 0; f < FILTERS; f++) {
      put_vector(f, x);
      for (int e = 0; e < 12; e++) put_edge(f, x);
    }
  }
  return ferror(stdout) ? 1 : 0;
}
