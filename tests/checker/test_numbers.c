/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The numbers that certificates describe [CERT-10]: each operation against libm, by a narrow rectangle that holds the
 * value and is accepted, and by its neighbours, which are rejected; undefined, misspelled and too large operations are
 * refused. All of them with every allocation failing once, too. */
#include "checker/exhaust.h"
#include "checker/number_cases.h"
#include "checker/ties.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>
#include <gmp.h>
#include <math.h>
#include <stdlib.h>

enum { SIZE = 1 << 18 };

static void say(char *text, const char *format, ...) {
  va_list args;
  size_t at = strlen(text);
  va_start(args, format);
  assert_true(vsnprintf(text + at, SIZE - at, format, args) < (int)(SIZE - at));
  va_end(args);
}

/* A certificate of one site: along x, in this side, the last number is said to be, along y another one. */
static void write_certificate(char *text, const char *lines, const char *side, const char *other_side, int other) {
  size_t count = 1;
  for (const char *c = lines; *c; c++) count += *c == '\n';
  *text = 0;
  say(text, "dyadel certificate 1\noutcome budget\ngoal decided\ncapped no\nsites 1\n%s %s\n", side, other_side);
  say(text, "legal 0\nplaces 0\nbridges 0\ncorners 0\npairs\ntriangles 0\nunproved 0\narea none\nhausdorff none\n");
  say(text, "algebra %zu\n= 0\n%s\npoints 1\n0 %zu %d\nfacts 0\nend\n", count + 1, lines, count, other);
}

/* Appends man 2^exp as certificates write it. */
static void say_number(char *text, mpz_ptr man, long exp) {
  if (exp > 0) {
    mpz_mul_2exp(man, man, (mp_bitcnt_t)exp);
    exp = 0;
  }
  for (; exp < 0 && mpz_sgn(man) && mpz_even_p(man); exp++) mpz_fdiv_q_2exp(man, man, 1);
  char *digits = mpz_get_str(NULL, 10, man);
  say(text, exp && mpz_sgn(man) ? "%s*2^%ld" : "%s", digits, exp);
  free(digits);
}

/* The side of width 5 units, a unit some 2^-40 of the value, that begins `from` units from it. */
static void write_side(char *text, double value, int from) {
  int top;
  mpz_t man;
  frexp(value, &top);
  if (top < 1) top = 1;
  mpz_init(man);
  mpz_set_d(man, floor(ldexp(value, 40 - top)));
  from < 0 ? mpz_sub_ui(man, man, (unsigned)-from) : mpz_add_ui(man, man, (unsigned)from);
  *text = 0;
  say_number(text, man, top - 40);
  say(text, "+");
  mpz_set_ui(man, 5);
  say_number(text, man, top - 40);
  mpz_clear(man);
}

/* NULL: accepted. The text is the certificate. */
static void check(char *text, const char *lines, const char *side, const char *other_side, int other, const char *why) {
  dyd_certificate_report r = {DYD_SIZED(dyd_certificate_report)};
  dyd_error err;
  write_certificate(text, lines, side, other_side, other);
  FILE *in = fmemopen(text, strlen(text), "r");
  dyd_status status = dyd_verify_certificate(&r, in, NULL, &err);
  fclose(in);
  if (status != (why ? DYD_E_PARSE : DYD_OK) || (why && strcmp(err.message, why) != 0))
    fail_msg("%.300s\nin %.100s: %d, line %zu: %s", lines, side, status, status ? err.line : 0,
             status ? err.message : "");
}

/* The same of the number alone, and with every allocation failing. */
static void expect(const char *lines, const char *side, const char *why) {
  static char text[SIZE];
  char message[1400];
  size_t faults = 0;
  check(text, lines, side, "0", 0, why);
  if (!every_allocation_fails_well(message, sizeof message, &faults, text, strlen(text)))
    fail_msg("%.300s\nin %.100s: %s", lines, side, message);
}

static void known_values(void **state) {
  (void)state;
  static char side[SIZE];
  for (size_t k = 0; k < sizeof of_known_value / sizeof *of_known_value; k++)
    for (int from = -8; from <= 4; from += 6) { /* on the left of it, around it, on the right */
      write_side(side, of_known_value[k].value, from);
      expect(of_known_value[k].lines, side, from == -2 ? NULL : NOT_THERE);
    }
}

static void exact_values(void **state) {
  (void)state;
  for (size_t k = 0; k < sizeof of_exact_value / sizeof *of_exact_value; k++) {
    expect(of_exact_value[k][0], of_exact_value[k][1], NULL);
    expect(of_exact_value[k][0], "7/11", NOT_THERE);
  }
}

static void refusals(void **state) {
  (void)state;
  char lines[100], why[200];
  for (size_t k = 0; k < sizeof refused / sizeof *refused; k++) expect(refused[k][0], refused[k][1], refused[k][2]);
  for (size_t k = 0; k < sizeof misspelled / sizeof *misspelled; k++) {
    snprintf(lines, sizeof lines, "callback\ncallback\n= %s", misspelled[k]);
    snprintf(why, sizeof why, "\"%s\" is no quotient of polynomials in leaves before", misspelled[k]);
    expect(lines, "0", why);
  }
}

/* A text that repeats this piece `count` times, between a prefix and a suffix. */
static const char *repeated(const char *before, const char *piece, size_t times, const char *behind) {
  static char text[SIZE];
  *text = 0;
  say(text, "%s", before);
  size_t length = strlen(piece), at = strlen(text);
  assert_true(at + times * length + strlen(behind) < SIZE);
  for (size_t k = 0; k < times; k++, at += length) memcpy(text + at, piece, length + 1);
  say(text, "%s", behind);
  return text;
}

/* Leaves, digits, terms, coefficients: the largest allowed number is accepted, one more is not. */
static void limits(void **state) {
  (void)state;
  static const char *const more[] = {"callback", "= 2\nsqrt 65", "= 2\ncbrt 65", "root 1 2 -2,0,1", "cycle 5",
                                     "e",        "pi",           "= 1\ncos 65",  "= 1\nexp 65",     "= 3\nlog 65"};
  expect(repeated("", "callback\n", 63, "callback\n* 64 0"), "0", NULL);
  for (size_t k = 0; k < sizeof more / sizeof *more; k++)
    expect(repeated("", "callback\n", 64, more[k]), "0", NOT_DEFINED);
  expect(repeated("", "callback\n", 63, "= 1\ncos 64"), "0", NOT_DEFINED);
  expect(repeated("= ", "1", 65536, "\n* 0 1"), "0", NULL);
  expect(repeated("= ", "1", 65537, "\n* 0 1"), "0",
         "\"1111111111111111111111111111111111111111\" is no quotient of polynomials in leaves before");
  expect(repeated("callback\n= x0", "+x0", 1 << 14, ""), "0",
         "\"x0+x0+x0+x0+x0+x0+x0+x0+x0+x0+x0+x0+x0+x\" is no quotient of polynomials in leaves before");
  expect(repeated("root -1/2 1/2 0,1", ",0", 998, ",1\n* 0 1"), "0", NULL);
  expect(repeated("root -1/2 1/2 0,1", ",0", 999, ",1\n* 0 1"), "0",
         "\"0,1,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,\" is no end of a bracket, or no polynomial");
  expect(repeated("root 1/1", "0", 2000, " 2 -1,1\n* 0 1"), "0", NULL);
  expect(repeated("root 1/1", "0", 6000, " 2 -1,1\n* 0 1"), "0",
         "the bracket is not seen to hold one root of the polynomial");
}

/* The root 1/2 of a long polynomial, and sqrt 2, in a rectangle of 2^-3000: too much work at the precision it takes. */
static void too_much_work(void **state) {
  (void)state;
  static char text[SIZE], side[SIZE];
  mpz_t root;
  mpz_init_set_ui(root, 2);
  mpz_mul_2exp(root, root, 6000);
  mpz_sqrt(root, root);
  *side = 0;
  say_number(side, root, -3000);
  say(side, "+1*2^-3000");
  for (size_t zeros = 10; zeros <= 600; zeros += 590) {
    const char *lines = repeated("= 2\nsqrt 1\nroot 2/5 3/5 -1,2", ",0", zeros, ",-1,2");
    check(text, lines, "1*2^-1+1*2^-3000", side, 2, zeros == 10 ? NULL : NOT_THERE);
  }
  mpz_clear(root);
}

/* x + x^2 + ... in leaf x. */
static void set_powers(dyd_cert_poly *p, size_t leaf, size_t terms, dyd_cert_relations *r) {
  dyd_cert_poly power = {0};
  for (size_t k = 1; k <= terms; k++) {
    assert_true(dyd_cert_poly_set_leaf(&power, leaf, r));
    power.term->e[leaf] = (uint16_t)k;
    assert_true(dyd_cert_poly_add(p, &power, 1, r));
  }
  dyd_cert_poly_clear(&power);
}

/* Returns whether the product of two sums of the given numbers of terms fits into the remaining work. *work: the work
 * it took. */
static bool product_fits(uint64_t *work, size_t terms, uint64_t left) {
  static dyd_cert_relations r;
  dyd_cert_poly p = {0}, q = {0};
  r = (dyd_cert_relations){.count = 2};
  set_powers(&p, 0, terms, &r);
  set_powers(&q, 1, terms, &r);
  r.work = DYD_CERT_WORK - left;
  bool fits = dyd_cert_poly_mul(&p, &q, &r);
  if (fits) assert_int_equal(p.count, terms * terms);
  *work = r.work - (DYD_CERT_WORK - left);
  dyd_cert_poly_clear(&p);
  dyd_cert_poly_clear(&q);
  return fits;
}

/* Every pair of terms is counted, every limb of enclosures, every copy; anything beyond the limit is not computed. */
static void work_is_counted(void **state) {
  (void)state;
  static dyd_cert_algebra a;
  dyd_cert_enclosure x;
  dyd_cert_poly five = {0}, copy = {0};
  mpz_t z;
  uint64_t work, rest;
  for (size_t terms = 1; terms <= 64; terms *= 4) {
    assert_true(product_fits(&work, terms, DYD_CERT_WORK));
    assert_in_range(work, terms * terms, SIZE_MAX);
    assert_true(product_fits(&rest, terms, work));
    assert_false(product_fits(&rest, terms, work - 1));
  }
  mpz_init_set_ui(z, 5);
  dyd_cert_enclosure_init(&x);
  assert_true(dyd_cert_poly_set_z(&five, z, &a.relations));
  for (int over = 0; over < 2; over++) {
    a.relations.work = DYD_CERT_WORK - 65 + (uint64_t)over;
    dyd_cert_poly_enclose(&x, &a, &five, 64 * GMP_NUMB_BITS);
    assert_int_equal(x.known, !over);
    a.relations.work = DYD_CERT_WORK - 2 + (uint64_t)over;
    assert_int_equal(dyd_cert_poly_set(&copy, &five, &a.relations), !over);
  }
  dyd_cert_poly_clear(&copy);
  dyd_cert_poly_clear(&five);
  dyd_cert_enclosure_clear(&x);
  mpz_clear(z);
}

/* The result of reading a block after the given amount of work. */
static dyd_status read_after(uint64_t *work, char *text) {
  dyd_error err;
  dyd_cert_sites sites = {.count = 1};
  dyd_cert_ties t = {.work = *work};
  dyd_cert_reader in = {.in = fmemopen(text, strlen(text), "r"), .err = &err};
  dyd_status st = dyd_cert_next_line(&in);
  if (st == DYD_OK) st = dyd_cert_ties_read(&t, &in, &sites);
  *work = t.work;
  dyd_cert_reader_clear(&in);
  fclose(in.in);
  dyd_cert_ties_clear(&t);
  return st;
}

/* Blocks share the work there may be: a small one is refused behind as much. */
static void work_is_shared(void **state) {
  (void)state;
  char text[] = "algebra 3\ncallback\n+ 0 0\n* 1 1\npoints 0\nfacts 0\n";
  uint64_t work = 0;
  assert_int_equal(read_after(&work, text), DYD_OK);
  assert_in_range(work, 3, 300);
  for (uint64_t over = 0; over < 2; over++) {
    uint64_t before = DYD_CERT_WORK - work + over;
    assert_int_equal(read_after(&before, text), over ? DYD_E_PARSE : DYD_OK);
  }
}

/* ---- memory ---- */

static size_t bytes_now, bytes_most;

static void *counted_malloc(size_t size) {
  bytes_now += size;
  if (bytes_now > bytes_most) bytes_most = bytes_now;
  void *p = malloc(size);
  assert_non_null(p);
  return p;
}

static void *counted_realloc(void *p, size_t from, size_t to) {
  bytes_now += to - from;
  if (bytes_now > bytes_most) bytes_most = bytes_now;
  p = realloc(p, to);
  assert_non_null(p);
  return p;
}

static void counted_free(void *p, size_t size) {
  bytes_now -= size;
  free(p);
}

/* Cube roots, each of the square of all before times the 998th power of a root: bounds of conjugates grow by 5/3. */
static void say_towers(char *lines, int levels) {
  *lines = 0;
  say(lines, "root 200 300 -1");
  for (int k = 0; k < 2400; k++) say(lines, "0");
  for (int k = 1; k < 999; k++) say(lines, ",0");
  say(lines, ",1");
  for (int k = 0; k < levels; k++) {
    say(lines, "\n= x0^998");
    for (int j = 1; j <= k; j++) say(lines, "*x%d^2", j);
    say(lines, "\ncbrt %d", 2 * k + 2);
  }
}

/* What forged lines make long is given up, before it fills the memory. */
static void no_long_numbers(void **state) {
  (void)state;
  static char text[SIZE], lines[SIZE];
  mp_set_memory_functions(counted_malloc, counted_realloc, counted_free);
  say_towers(lines, 6);
  check(text, lines, "0", "0", 0, NOT_THERE);
  assert_in_range(bytes_most, 0, (size_t)4 << 20);
  *lines = 0; /* x - x for an x too large for an enclosure; long products of that */
  say(lines, "= 200\nexp 1\n^ 2 120\n- 3 3\n= 1");
  for (int k = 0; k < 9000; k++) say(lines, "0");
  for (int k = 4; k < 400; k++) say(lines, "\n* 5 %d", k == 4 ? 4 : k + 1);
  bytes_most = 0;
  check(text, lines, "0+1", "0", 0, NOT_THERE);
  assert_in_range(bytes_most, 0, (size_t)32 << 20);
  *lines = 0; /* an end of which powers would be made */
  say(lines, " 2 -1");
  for (int k = 1; k < 400; k++) say(lines, ",0");
  say(lines, ",1");
  bytes_most = 0;
  check(text, repeated("root -1", "0", 20000, lines), "0", "0", 0,
        "the bracket is not seen to hold one root of the polynomial");
  assert_in_range(bytes_most, 0, (size_t)1 << 20);
  mp_set_memory_functions(NULL, NULL, NULL);
}

/* Facts of each kind, by either method, of points around a square and on its diagonal, one of them twice. */
static void facts(void **state) {
  (void)state;
  static const char text[] =
      "dyadel certificate 1\noutcome budget\ngoal decided\ncapped no\nsites 8\n0 0\n1+1 0\n1+1 1+1\n0 1+1\n"
      "1*2^1+1 1*2^1+1\n0 0\n1/3 1/7\n= 6\nlegal 0\nplaces 0\nbridges 0\ncorners 0\npairs\ntriangles 0\nunproved "
      "21\narea none\n"
      "hausdorff none\nalgebra 4\n= 0\n= 2\nsqrt 1\n+ 2 2\npoints 6\n0 0 0\n1 2 0\n2 2 2\n3 0 2\n4 3 3\n5 0 0\n"
      "facts 6\nline 0 2 4 identity\nline 4 2 5 bound\ncircle 0 1 2 3 identity\ncircle 3 5 1 2 bound\n"
      "same 0 5 identity\nsame 5 0 bound\nend\n";
  char message[1400], verdict[600];
  bool over;
  size_t faults = 0;
  assert_int_equal(verdict_of(verdict, sizeof verdict, &over, text, strlen(text), 0), DYD_OK);
  assert_non_null(strstr(verdict, "facts 3 and 3"));
  for (size_t phase = 0; phase < 16; phase++) {
    faults = phase;
    if (!every_allocation_fails_well(message, sizeof message, &faults, text, strlen(text))) fail_msg("%s", message);
  }
  static const char *const wrong[][2] = {{"2 4 identity", "1 4 identity"}, {"2 5 bound", "1 5 bound"},
                                         {"2 3 identity", "2 4 identity"}, {"1 2 bound", "1 4 bound"},
                                         {"0 5 identity", "0 2 identity"}, {"5 0 bound", "5 1 bound"}};
  for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++) {
    char other[sizeof text];
    strcpy(other, text);
    memcpy(strstr(other, wrong[k][0]), wrong[k][1], strlen(wrong[k][1]));
    assert_int_equal(verdict_of(verdict, sizeof verdict, &over, other, strlen(other), 0), DYD_E_PARSE);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(known_values),    cmocka_unit_test(exact_values),    cmocka_unit_test(refusals),
      cmocka_unit_test(limits),          cmocka_unit_test(facts),           cmocka_unit_test(too_much_work),
      cmocka_unit_test(no_long_numbers), cmocka_unit_test(work_is_counted), cmocka_unit_test(work_is_shared)};
  return cmocka_run_group_tests_name("numbers of certificates", tests, NULL, NULL);
}
