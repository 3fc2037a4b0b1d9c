/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Signs of numbers with roots, and circles through features, in integers. */
#include "dyadic/sqrt_sign.c"
#include "predicate/circle.c" /* functions are static */
#include "predicate/circle.h"
#include "vectors.h"

/* ---- signs ---- */

static void ask_compare_squares(answer *a, mpz_t *z) {
  say_integer(a, compare_squares(z[0], z[1], z[2]));
}
static void ask_sqrt_sign(answer *a, mpz_t *z) {
  say_integer(a, dyd_sqrt_sign(z[0], z[1], z[2]));
}
static void ask_sqrt2_sign(answer *a, mpz_t *z) {
  say_integer(a, dyd_sqrt2_sign(z[0], z[1], z[2], z[3], z[4]));
}

static void some_integer(mpz_t z) {
  mpz_set_ui(z, (unsigned long)(test_u64(&shared) >> test_between(&shared, 4, 63)));
  if (test_chance(&shared, 4)) mpz_mul_ui(z, z, (unsigned long)(test_u64(&shared) >> test_between(&shared, 4, 63)));
  if (test_chance(&shared, 2)) mpz_neg(z, z);
}
static void choose_integers(mpz_t *z, unsigned inputs) {
  for (unsigned q = 0; q < inputs; q++) some_integer(z[q]);
}
/* a^2 is about b^2 c, or just that. */
static void choose_squares(mpz_t *z, unsigned inputs) {
  choose_integers(z, inputs);
  mpz_abs(z[2], z[2]);
  if (mpz_sgn(z[1]) == 0) mpz_set_ui(z[1], 1);
  mpz_add_ui(z[2], z[2], 1);
  if (test_chance(&shared, 2)) mpz_mul(z[2], z[2], z[2]);
  if (test_chance(&shared, 4)) return;
  int sign = test_chance(&shared, 2) ? 1 : -1;
  mpz_mul(z[0], z[1], z[1]);
  mpz_mul(z[0], z[0], z[2]);
  mpz_sqrt(z[0], z[0]);
  if (test_chance(&shared, 3)) mpz_add_ui(z[0], z[0], 1);
  mpz_mul_si(z[0], z[0], sign);
  if (mpz_sgn(z[0]) == 0) mpz_set_si(z[0], sign);
}
static void choose_root(mpz_t *z, unsigned inputs) {
  choose_squares(z, inputs);
  if (test_chance(&shared, 8)) mpz_set_ui(z[test_below(&shared, 3)], 0);
}
/* d^2 e is about (a + b sqrt c)^2. */
static void choose_two_roots(mpz_t *z, unsigned inputs) {
  choose_integers(z, inputs);
  mpz_abs(z[2], z[2]);
  if (test_chance(&shared, 2)) mpz_mul(z[2], z[2], z[2]);
  if (test_chance(&shared, 2)) {
    mpz_set_si(z[3], test_chance(&shared, 2) ? 1 : -1);
    mpz_mul(z[4], z[1], z[1]);
    mpz_mul(z[4], z[4], z[2]);
    mpz_sqrt(z[4], z[4]);
    if (mpz_sgn(z[1]) < 0) mpz_neg(z[4], z[4]);
    mpz_add(z[4], z[4], z[0]);
    mpz_mul(z[4], z[4], z[4]);
    if (test_chance(&shared, 2)) mpz_add_ui(z[4], z[4], (unsigned long)test_below(&shared, 3));
  }
  mpz_abs(z[4], z[4]);
  if (test_chance(&shared, 8)) mpz_set_ui(z[test_below(&shared, 5)], 0);
}

/* ---- centres ---- */

static void say_centre(answer *a, bool found, const dyd_centre *c) {
  mpz_srcptr part[6] = {c->a[0], c->a[1], c->b[0], c->b[1], c->c, c->d};
  if (!found)
    say_none(a);
  else
    for (int q = 0; q < 6; q++) say_big(a, part[q]);
}
/* Features as numbers of which axes they have, and their coordinates: z[q], z[q + 1], z[q + 2]. */
static dyd_feature feature_at(mpz_t *z, int q) {
  unsigned long has = mpz_get_ui(z[q]);
  dyd_feature f = {{has & 1, has & 2}, {{*z[q + 1]}, {*z[q + 2]}}};
  return f;
}
static dyd_centre with_junk(void) {
  dyd_centre c;
  centre_init(&c);
  mpz_ptr part[8] = {c.a[0], c.a[1], c.b[0], c.b[1], c.c, c.d, c.s, c.t};
  for (int q = 0; q < 8; q++) mpz_set_si(part[q], 7 - 2 * q);
  return c;
}
static void ask_solve(answer *a, mpz_t *z) {
  dyd_feature f = feature_at(z, 0), g = feature_at(z, 3);
  dyd_centre c = with_junk();
  bool found = solve_circle(&c, &f, &g, mpz_sgn(z[6]) != 0);
  say_centre(a, found, &c);
  centre_clear(&c);
}
static void ask_solve_two_points(answer *a, mpz_t *z) {
  dyd_feature f = {{true, true}, {{*z[0]}, {*z[1]}}}, g = {{true, true}, {{*z[2]}, {*z[3]}}};
  dyd_centre c = with_junk();
  bool found = solve_two_points(&c, &f, &g);
  say_centre(a, found, &c);
  centre_clear(&c);
}
static void ask_beside_line(answer *a, mpz_t *z) {
  dyd_centre c = with_junk();
  bool found = solve_point_beside_line(&c, z[0], z[1], mpz_sgn(z[2]) != 0);
  say_centre(a, found, &c);
  centre_clear(&c);
}
/* z[4]: the axis across the line, z[5]: which */
static void ask_solve_point_and_line(answer *a, mpz_t *z) {
  int k = mpz_sgn(z[4]) != 0;
  dyd_feature point = {{true, true}, {{*z[0]}, {*z[1]}}}, line = {{k == 0, k == 1}, {{*z[2]}, {*z[3]}}};
  dyd_centre c = with_junk();
  bool found = solve_point_and_line(&c, &point, &line, mpz_sgn(z[5]) != 0);
  say_centre(a, found, &c);
  centre_clear(&c);
}
static void ask_solve_parallel_lines(answer *a, mpz_t *z) {
  dyd_centre c = with_junk();
  bool found = solve_parallel_lines(&c, z[0], z[1], mpz_sgn(z[2]) != 0, mpz_sgn(z[3]) != 0);
  say_centre(a, found, &c);
  centre_clear(&c);
}
static void ask_solve_crossing_lines(answer *a, mpz_t *z) {
  dyd_centre c = with_junk();
  bool found = solve_crossing_lines(&c, z[0], z[1], mpz_sgn(z[2]) != 0);
  say_centre(a, found, &c);
  centre_clear(&c);
}
/* Of (x, y) / d, without roots, d > 0; or d < 0, and made positive */
static void ask_make(answer *a, mpz_t *z, bool positive) {
  dyd_centre c = with_junk();
  mpz_set(c.a[0], z[0]);
  mpz_set(c.a[1], z[1]);
  mpz_set(c.d, z[2]);
  centre_make_rational(&c);
  if (positive) centre_make_positive(&c);
  say_centre(a, true, &c);
  centre_clear(&c);
}
static void ask_make_rational(answer *a, mpz_t *z) {
  ask_make(a, z, false);
}
static void ask_make_positive(answer *a, mpz_t *z) {
  ask_make(a, z, true);
}

static void choose_small(mpz_t *z, unsigned inputs) {
  unsigned zeros = test_chance(&shared, 2) ? 4 : 40;
  for (unsigned q = 0; q < inputs; q++) {
    some_integer(z[q]);
    if (test_chance(&shared, 3)) mpz_set_si(z[q], (long)test_between(&shared, -4, 4));
    if (test_chance(&shared, zeros)) mpz_set_ui(z[q], 0);
  }
}
/* Draws by choose_small, with a flag at the end. */
static void choose_one_flag(mpz_t *z, unsigned inputs) {
  choose_small(z, inputs);
  mpz_set_ui(z[inputs - 1], (unsigned long)test_below(&shared, 2));
}
static void choose_two_flags(mpz_t *z, unsigned inputs) {
  choose_one_flag(z, inputs);
  mpz_set_ui(z[inputs - 2], (unsigned long)test_below(&shared, 2));
}
static void choose_features(mpz_t *z, unsigned inputs) {
  choose_one_flag(z, inputs);
  mpz_set_ui(z[0], 1 + (unsigned long)test_below(&shared, 3));
  mpz_set_ui(z[3], 1 + (unsigned long)test_below(&shared, 3));
}
static void choose_fraction(mpz_t *z, unsigned inputs) {
  choose_small(z, inputs);
  if (mpz_sgn(z[2]) == 0) mpz_set_si(z[2], -1);
}
static void choose_positive(mpz_t *z, unsigned inputs) {
  choose_fraction(z, inputs);
  mpz_abs(z[2], z[2]);
}

/* ---- circles ---- */

/* z: ax, bx, ay, by, c, d, px, py */
static void ask_radius(answer *a, mpz_t *z) {
  dyd_icircle k = {{*z[0]}, {*z[1]}, {*z[2]}, {*z[3]}, {*z[4]}, {*z[5]}, {*z[6]}, {*z[7]}};
  dyd_circle out;
  dyd_circle_init(&out);
  circle_set_radius(&out, &k);
  say_big(a, out.ar);
  say_big(a, out.br);
  say_big(a, out.dr);
  dyd_circle_clear(&out);
}
/* z: p, q, a, b, c, d, z; is there a z? */
static void ask_add_square(answer *a, mpz_t *z) {
  dyd_surd s = {z[2], z[3], z[4], z[5]};
  mpz_t p, q, t;
  mpz_init_set(p, z[0]);
  mpz_init_set(q, z[1]);
  mpz_init(t);
  surd_add_square(p, q, t, &s, mpz_sgn(z[7]) ? z[6] : NULL);
  say_big(a, p);
  say_big(a, q);
  mpz_clears(p, q, t, NULL);
}
/* z: a, b, c, d, lo2, hi2; is there a bound below, above? */
static void ask_within_slab(answer *a, mpz_t *z) {
  circle_search q = {.circle = {.c = {*z[2]}, .d = {*z[3]}}};
  dyd_slab s = {.lo2 = mpz_sgn(z[6]) ? z[4] : NULL, .hi2 = mpz_sgn(z[7]) ? z[5] : NULL};
  mpz_inits(q.s, q.t, NULL);
  say_integer(a, within_slab(&q, z[0], z[1], &s));
  mpz_clears(q.s, q.t, NULL);
}

/* The bounds are about twice the number, or just that. */
static void choose_slab(mpz_t *z, unsigned inputs) {
  choose_two_flags(z, inputs);
  mpz_abs(z[2], z[2]);
  mpz_abs(z[3], z[3]);
  mpz_add_ui(z[3], z[3], 1);
  if (test_chance(&shared, 2)) mpz_mul(z[2], z[2], z[2]);
  for (int q = 4; q < 6; q++) {
    mpz_sqrt(z[q], z[2]);
    mpz_mul(z[q], z[q], z[1]);
    mpz_add(z[q], z[q], z[0]);
    mpz_mul_2exp(z[q], z[q], 1);
    mpz_fdiv_q(z[q], z[q], z[3]);
    if (test_chance(&shared, 2)) mpz_add_ui(z[q], z[q], 1);
    if (test_chance(&shared, 4)) mpz_sub_ui(z[q], z[q], 1);
  }
}

static const whole circle[] = {{"compare_squares", 3, ask_compare_squares, choose_squares},
                               {"dyd_sqrt_sign", 3, ask_sqrt_sign, choose_root},
                               {"dyd_sqrt2_sign", 5, ask_sqrt2_sign, choose_two_roots},
                               {"solve_circle", 7, ask_solve, choose_features},
                               {"solve_two_points", 4, ask_solve_two_points, choose_small},
                               {"solve_point_beside_line", 3, ask_beside_line, choose_one_flag},
                               {"solve_point_and_line", 6, ask_solve_point_and_line, choose_two_flags},
                               {"solve_parallel_lines", 4, ask_solve_parallel_lines, choose_two_flags},
                               {"solve_crossing_lines", 3, ask_solve_crossing_lines, choose_one_flag},
                               {"centre_make_rational", 3, ask_make_rational, choose_positive},
                               {"centre_make_positive", 3, ask_make_positive, choose_fraction},
                               {"circle_set_radius", 8, ask_radius, choose_small},
                               {"surd_add_square", 8, ask_add_square, choose_one_flag},
                               {"within_slab", 8, ask_within_slab, choose_slab}};

void vectors_of_circles(const kind *k) {
  (void)k;
  put_wholes(circle, sizeof circle / sizeof *circle);
}
