/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What functions in C say of many numbers. Usage: vectors [CASES [NAME ...]]   (NAME: these functions only) */
#include "vectors.h"

#include <float.h>
#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <string.h>

test_random shared;

/* ---- which functions ---- */

static char **wanted; /* NULL at the end; NULL: all */

static bool is_wanted(const char *name) {
  if (!wanted || !*wanted) return true;
  for (char **w = wanted; *w; w++)
    if (strcmp(*w, name) == 0) return true;
  return false;
}

/* ---- numbers ---- */

double special(void) {
  static const double all[] = {0.0,       -0.0,      1,        -1,          DBL_MAX,   -DBL_MAX,
                               INFINITY,  -INFINITY, NAN,      DBL_MIN,     0x1p-1074, -0x1p-1074,
                               0x1p-1023, 0x1p511,   0x1p-511, DBL_MAX / 4, 0x1p1022,  0x1p-537};
  return all[test_below(&shared, sizeof all / sizeof *all)];
}

double number(const kind *k) {
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
  static const int bases[] = {0,   0,   0,    -3,   20,   100,  250,  272,  300,   505,  511,
                              515, 600, 1013, -200, -265, -270, -400, -520, -1000, -1070};
  kind k = {bases[test_below(&shared, sizeof bases / sizeof *bases)], (unsigned)test_below(&shared, 4),
            test_unit(&shared)};
  return k;
}

/* The upper end: the same, a few doubles away, or another number. */
static double upper_end(double lower, const kind *k) {
  switch (test_below(&shared, 4)) {
  case 0:
    return lower;
  case 1:
    return lower + fabs(lower) * 0x1p-52 * (double)test_below(&shared, 4);
  case 2:
    return lower + ldexp(fabs(lower), -(int)test_below(&shared, 50));
  default:
    return number(k);
  }
}

void choose_intervals(double *x, unsigned inputs, const kind *k) {
  for (unsigned q = 0; q < inputs; q++) x[q] = number(k);
  for (unsigned q = 0; q + 1 < inputs; q += 2) {
    x[q + 1] = upper_end(x[q], k);
    if (x[q] > x[q + 1] && !test_chance(&shared, 20)) {
      double higher = x[q];
      x[q] = x[q + 1];
      x[q + 1] = higher;
    }
  }
}

/* ---- answers ---- */

static void say(answer *a, const char *format, ...) {
  va_list list;
  va_start(list, format);
  if (a->length) a->text[a->length++] = ' ';
  a->length += (size_t)vsnprintf(a->text + a->length, sizeof a->text - a->length, format, list);
  if (a->length + 2 > sizeof a->text) abort();
  va_end(list);
}

static uint64_t pattern(double y) {
  uint64_t bits;
  memcpy(&bits, &y, sizeof bits);
  return bits;
}

void say_double(answer *a, double y) {
  if (isnan(y))
    say(a, "nan");
  else
    say(a, "%016" PRIx64, pattern(y));
}
void say_doubles(answer *a, const double *y, size_t count) {
  for (size_t q = 0; q < count; q++) say_double(a, y[q]);
}
void say_integer(answer *a, long y) {
  say(a, "%ld", y);
}
void say_big(answer *a, mpz_srcptr y) {
  char *text = mpz_get_str(NULL, 10, y);
  say(a, "%s", text);
  free(text);
}
void say_none(answer *a) {
  say(a, "none");
}

/* ---- functions ---- */

static void ask(answer *a, const function *f, const double *x) {
  a->length = 0;
  a->text[0] = 0;
  f->ask(a, x);
}

static bool same(const answer *a, const answer *b) {
  return a->length == b->length && memcmp(a->text, b->text, a->length) == 0;
}

void put_vector(const function *f, const double *x) {
  answer a;
  if (!is_wanted(f->name)) return;
  ask(&a, f, x);
  printf("%s", f->name);
  for (unsigned q = 0; q < f->inputs; q++) printf(" %016" PRIx64, pattern(x[q]));
  printf(" = %s\n", a.text);
}

/* Doubles of one sign in their order, as integers. */
static double between(double a, double b) {
  uint64_t x = pattern(a), y = pattern(b);
  x = x / 2 + y / 2 + (x & y & 1);
  memcpy(&a, &x, sizeof a);
  return a;
}

/* Where one number is changed until the answer does: both sides of that place, one bit apart. */
static void put_edge(const function *f, const double *x) {
  double here[INPUTS], there[INPUTS], middle[INPUTS];
  answer at, beyond, found;
  size_t q = test_below(&shared, f->inputs - f->flags);
  memcpy(here, x, sizeof here);
  memcpy(there, x, sizeof there);
  there[q] = here[q] * (1 + ldexp(1, -(int)test_below(&shared, 53)));
  ask(&at, f, here);
  ask(&beyond, f, there);
  if (same(&at, &beyond) || !isfinite(there[q])) return;
  memcpy(middle, here, sizeof middle);
  while (middle[q] = between(here[q], there[q]), middle[q] != here[q] && middle[q] != there[q]) {
    ask(&found, f, middle);
    memcpy(same(&found, &at) ? here : there, middle, sizeof middle);
  }
  put_vector(f, here);
  put_vector(f, there);
}

void put_vectors(const function *f, size_t count, const kind *k) {
  for (size_t e = 0; e < count; e++) {
    double x[INPUTS] = {0};
    if (!is_wanted(f[e].name)) continue;
    for (unsigned q = 0; q < f[e].inputs; q++) x[q] = number(k);
    if (f[e].choose) f[e].choose(x, f[e].inputs, k);
    put_vector(&f[e], x);
    for (unsigned q = 0; q < f[e].edges; q++) put_edge(&f[e], x);
  }
}

static void put_whole(const whole *f, mpz_t *z) {
  answer a = {.length = 0};
  printf("%s", f->name);
  for (unsigned q = 0; q < f->inputs; q++) {
    char *text = mpz_get_str(NULL, 10, z[q]);
    printf(" %s", text);
    free(text);
  }
  f->ask(&a, z);
  printf(" = %s\n", a.text);
}

void put_wholes(const whole *f, size_t count) {
  mpz_t z[INPUTS];
  for (int q = 0; q < INPUTS; q++) mpz_init(z[q]);
  for (size_t e = 0; e < 3 * count; e++) {
    if (!is_wanted(f[e % count].name)) continue;
    f[e % count].choose(z, f[e % count].inputs);
    put_whole(&f[e % count], z);
  }
  for (int q = 0; q < INPUTS; q++) mpz_clear(z[q]);
}

int main(int argc, char **argv) {
  static void (*const subject[])(const kind *) = {vectors_of_areas,       vectors_of_boxes, vectors_of_circles,
                                                  vectors_of_expressions, vectors_of_fixed, vectors_of_intervals,
                                                  vectors_of_near,        vectors_of_plane, vectors_of_stars};
  wanted = argc > 2 ? argv + 2 : NULL;
  size_t cases = test_cases(argc > 1 ? strtoul(argv[1], NULL, 10) : 1000);
  shared = test_random_start("vectors");
  for (size_t q = 0; q < cases; q++) {
    kind k = some_kind();
    for (size_t e = 0; e < sizeof subject / sizeof *subject; e++) subject[e](&k);
  }
  return ferror(stdout) ? 1 : 0;
}
