/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Which places are on one circle of the sphere, and which are equally far from a place: exactly, for degrees that are
 * rational numbers.
 *
 * [SPH-3] Four places a, b, c, d are on one circle iff their vectors are in one plane, iff
 *     det(b,c,d) - det(a,c,d) + det(a,b,d) - det(a,b,c) = 0,
 * where det(u,v,w) is the sum over the cyclic shifts of sin f_w cos f_u cos f_v sin(l_v - l_u). Written by exponentials
 * that is, up to a factor, a sum of 4 * 3 * 16 roots of unity with coefficients 1 and -1. Three different places of a
 * sphere are on one circle only, so a group is when each other one is on the circle of three of them. Images on a line
 * are places on a circle with the centre.
 *
 * Is a sum of roots of unity 0? Let z_n = exp(2 pi i / n). For a prime p and m = n / p:
 *   p divides m: 1, z_n, .., z_n^(p-1) are a basis of Q(z_n) over Q(z_m), so a sum is 0 iff for each r its terms with
 *     e = r mod p are, and these are z_n^r times a sum of powers of z_m;
 *   p does not divide m: z_n^e = z_p^a z_m^b with a = e / m mod p, b = e / p mod m, and the one relation among
 *     1, .., z_p^(p-1) over Q(z_m) is that their sum is 0: the sum is 0 iff the sums of the b for each a are all equal.
 * So n loses its primes. Those above the number of terms need not be found: some class a is empty then, so all have to
 * be 0, and so on down to classes of equal e, which are not 0 once equal e are one term. */
#include "base/alloc.h"
#include "base/error.h"
#include "base/local.h"
#include "sphere/state.h"

#include <string.h>

/* ---- sums of roots of unity ---- */

static int compare_terms(const void *a, const void *b) {
  const dyd_root_term *x = a, *y = b;
  return (x->e > y->e) - (x->e < y->e);
}

static dyd_turns gcd_turns(dyd_turns a, dyd_turns b) {
  while (b) {
    dyd_turns r = a % b;
    a = b;
    b = r;
  }
  return a;
}

/* Sorted, each e once, none with c = 0. */
static size_t terms_collect(dyd_root_term *term, size_t count) {
  size_t n = 0;
  qsort(term, count, sizeof *term, compare_terms);
  for (size_t k = 0; k < count; k++) {
    if (n && term[n - 1].e == term[k].e)
      term[n - 1].c += term[k].c;
    else
      term[n++] = term[k];
    if (!term[n - 1].c) n--;
  }
  return n;
}

/* A sum times a root of unity is 0 iff the sum is: the first e becomes 0; the common factor of all e and n is divided
 * out. Returns the order. */
static dyd_turns terms_reduce(dyd_root_term *term, size_t count, dyd_turns n) {
  dyd_turns first = term[0].e, common = n;
  for (size_t k = 0; k < count; k++) common = gcd_turns(common, term[k].e -= first);
  for (size_t k = 0; k < count; k++) term[k].e /= common;
  return n / common;
}

/* The least prime that divides n and is not above most; 0: there is none. */
static unsigned small_prime(dyd_turns n, size_t most) {
  for (unsigned p = 2; p <= most; p += p == 2 ? 1 : 2)
    if (n % (dyd_turns)p == 0) return p; /* the least divisor above 1 is prime */
  return 0;
}

/* e becomes its class times n plus the rest: sorted by that, classes are runs. */
static dyd_turns term_split(dyd_turns e, unsigned p, dyd_turns n, dyd_turns of_m) {
  dyd_turns m = n / p;
  if (m % p == 0) return (e % p) * n + e / p;
  dyd_turns a = (e % p) * of_m % p, b = e - a * m; /* divisible by p: e = a m modulo p */
  b %= n;
  return a * n + (b < 0 ? b + n : b) / p;
}

/* The inverse of m modulo p, which does not divide it. */
static dyd_turns inverse_of(dyd_turns m, unsigned p) {
  dyd_turns x = 1;
  while (m % p * x % p != 1) x++;
  return x;
}

/* A run of terms with the class taken off. */
typedef struct root_run {
  dyd_root_term *term;
  size_t count;
} root_run;

/* Runs of equal class; at most p. */
static size_t runs_find(root_run *run, dyd_root_term *term, size_t count, dyd_turns n) {
  size_t runs = 0;
  dyd_turns last = -1;
  for (size_t k = 0; k < count; k++) {
    dyd_turns class = term[k].e / n;
    if (class != last) run[runs++] = (root_run){term + k, 0};
    last = class;
    run[runs - 1].count++;
    term[k].e %= n;
  }
  return runs;
}

/* Sets *zero to whether the sum of a less that of b is 0. b stays as it is. */
static dyd_status runs_agree(bool *zero, const root_run *a, const root_run *b, dyd_turns m) {
  DYD_FREED dyd_root_term *term = dyd_alloc(a->count + b->count, sizeof *term);
  if (!term) return DYD_E_NOMEM;
  memcpy(term, a->term, a->count * sizeof *term);
  for (size_t k = 0; k < b->count; k++) term[a->count + k] = (dyd_root_term){b->term[k].e, -b->term[k].c};
  return dyd_cyclic_is_zero(zero, term, a->count + b->count, m);
}

static size_t least_run(const root_run *run, size_t runs) {
  size_t least = 0;
  for (size_t k = 1; k < runs; k++)
    if (run[k].count < run[least].count) least = k;
  return least;
}

static dyd_status split_is_zero(bool *zero, dyd_root_term *term, size_t count, dyd_turns n, unsigned p) {
  dyd_turns m = n / p, of_m = m % p ? inverse_of(m, p) : 0;
  dyd_status st = DYD_OK;
  DYD_FREED root_run *run = dyd_alloc(p, sizeof *run);
  if (!run) return DYD_E_NOMEM;
  for (size_t k = 0; k < count; k++) term[k].e = term_split(term[k].e, p, n, of_m);
  qsort(term, count, sizeof *term, compare_terms);
  size_t runs = runs_find(run, term, count, n), least = least_run(run, runs);
  bool equal = m % p && runs == p; /* all classes have to be equal, not 0 */
  *zero = true;
  for (size_t k = 0; k < runs && *zero && st == DYD_OK; k++) {
    if (!equal)
      st = dyd_cyclic_is_zero(zero, run[k].term, run[k].count, m);
    else if (k != least)
      st = runs_agree(zero, &run[k], &run[least], m);
  }
  return st;
}

dyd_status dyd_cyclic_is_zero(bool *zero, dyd_root_term *term, size_t count, dyd_turns n) {
  for (size_t k = 0; k < count; k++) term[k].e = term[k].e % n + (term[k].e % n < 0 ? n : 0);
  count = terms_collect(term, count);
  *zero = count == 0;
  if (count < 2) return DYD_OK;
  n = terms_reduce(term, count, n);
  unsigned p = small_prime(n, count);
  return p ? split_is_zero(zero, term, count, n, p) : DYD_OK;
}

enum { TERMS = 4 * 3 * 16 };

/* Longitude and latitude in units of 1/n of a turn. */
typedef struct turned {
  dyd_turns lon, lat;
} turned;

/* ---- places ---- */

static bool turns_set_z(dyd_turns *out, mpz_srcptr z) {
  if (mpz_sizeinbase(z, 2) > 110) return false;
  DYD_LOCAL_NUMBERS(mpz, high);
  mpz_tdiv_q_2exp(high, z, 62);
  dyd_turns value = (dyd_turns)mpz_get_si(high) << 62;
  mpz_tdiv_r_2exp(high, z, 62);
  *out = value + mpz_get_si(high);
  return true;
}

/* x degrees, a multiple of 1/n of a turn; reduced to a turn. */
static bool turns_set_degrees(dyd_turns *out, mpq_srcptr x, mpz_srcptr n) {
  DYD_LOCAL_NUMBERS(mpz, z);
  mpz_mul(z, n, mpq_numref(x));
  mpz_divexact_ui(z, z, 360);
  mpz_divexact(z, z, mpq_denref(x));
  mpz_mod(z, z, n);
  return turns_set_z(out, z);
}

/* The subject of the question: places, the unit of their angles. chosen: NULL, or given instead of `site`. */
typedef struct circle_question {
  const dyd_sphere *s;
  const uint32_t *site;
  const dyd_site_place *chosen;
  size_t count; /* of sites; with the centre, one more */
  bool line;
  dyd_spot *spot;
  mpz_t n;
} circle_question;

static size_t circle_places(const circle_question *q) {
  return q->count + q->line;
}

/* Which place number k is; the last one is that which is projected from. */
static uint32_t place_of_circle(const circle_question *q, size_t k) {
  if (k == q->count) return q->s->centre;
  return q->s->of[q->chosen ? q->chosen[k].site : q->site[k]];
}

/* Reads place number k; of a line the last one is the centre of the projection. */
static dyd_status circle_read_one(circle_question *q, size_t k, dyd_error *err) {
  const dyd_sphere *s = q->s;
  dyd_spot *spot = &q->spot[k];
  if (k == q->count && s->free) {
    for (int a = 0; a < 2; a++) mpq_set(spot->mid[a], s->eye.spot.mid[a]);
    return DYD_OK;
  }
  const uint32_t i = place_of_circle(q, k);
  dyd_status st = dyd_sphere_spot(spot, s, i, err);
  if (st == DYD_OK && q->chosen && spot->stays && dyd_sphere_is_fixed(s, i))
    dyd_spot_choose(spot, k < q->count ? q->chosen[k].place : 0);
  return st;
}

/* Reads places; *exact: all are exact. The unit divides all angles. */
static dyd_status circle_read(bool *exact, circle_question *q, dyd_error *err) {
  *exact = true;
  for (size_t k = 0; k < circle_places(q) && *exact; k++) {
    dyd_status st = circle_read_one(q, k, err);
    if (st != DYD_OK) return st;
    *exact = dyd_spot_is_exact(&q->spot[k]);
    for (int a = 0; a < 2; a++) mpz_lcm(q->n, q->n, mpq_denref(q->spot[k].mid[a]));
  }
  mpz_mul_ui(q->n, q->n, 360);
  return DYD_OK;
}

/* ---- a sum ---- */

/* sign * sin f_w cos f_u cos f_v sin(l_v - l_u), times -16. */
static dyd_root_term *put_product(dyd_root_term *t, turned u, turned v, turned w, int sign, dyd_turns n) {
  for (int k = 0; k < 16; k++) {
    int a = k & 1 ? -1 : 1, b = k & 2 ? -1 : 1, c = k & 4 ? -1 : 1, d = k & 8 ? -1 : 1;
    *t++ = (dyd_root_term){(a * w.lat + b * u.lat + c * v.lat + d * (v.lon - u.lon)) % n, sign * a * d};
  }
  return t;
}

static dyd_root_term *put_determinant(dyd_root_term *t, turned u, turned v, turned w, int sign, dyd_turns n) {
  t = put_product(t, u, v, w, sign, n);
  t = put_product(t, v, w, u, sign, n);
  return put_product(t, w, u, v, sign, n);
}

/* Returns true if a and b are on one parallel, c and d as well, with the same meridian half way. Each is the other's
 * mirror image in the plane of that meridian, so both lines are across it, and in one plane. */
static bool are_mirrored(turned a, turned b, turned c, turned d, dyd_turns n) {
  return a.lat == b.lat && c.lat == d.lat && (a.lon + b.lon - c.lon - d.lon) % n == 0;
}

/* Grids of parallels and meridians, without a sum. */
static bool circle_shows(const turned p[4], dyd_turns n) {
  if (p[0].lat == p[1].lat && p[0].lat == p[2].lat && p[0].lat == p[3].lat) return true;
  return are_mirrored(p[0], p[1], p[2], p[3], n) || are_mirrored(p[0], p[2], p[1], p[3], n) ||
         are_mirrored(p[0], p[3], p[1], p[2], n);
}

static dyd_status four_are_cocircular(bool *out, const turned p[4], dyd_turns n) {
  dyd_root_term term[TERMS], *t = term;
  *out = circle_shows(p, n);
  if (*out) return DYD_OK;
  t = put_determinant(t, p[1], p[2], p[3], 1, n);
  t = put_determinant(t, p[0], p[2], p[3], -1, n);
  t = put_determinant(t, p[0], p[1], p[3], 1, n);
  t = put_determinant(t, p[0], p[1], p[2], -1, n);
  return dyd_cyclic_is_zero(out, term, (size_t)(t - term), n);
}

static bool turned_set(turned *out, const dyd_spot *spot, mpz_srcptr n) {
  return turns_set_degrees(&out->lon, spot->mid[0], n) && turns_set_degrees(&out->lat, spot->mid[1], n);
}

/* Returns true if no two of the places are the same: chosen ones may be. */
static bool circle_is_apart(const circle_question *q) {
  bool apart = true;
  for (size_t k = 1; k < circle_places(q) && apart; k++)
    for (size_t l = 0; l < k && apart; l++) {
      turned a, b;
      apart =
          turned_set(&a, &q->spot[k], q->n) && turned_set(&b, &q->spot[l], q->n) && (a.lon != b.lon || a.lat != b.lat);
    }
  return apart;
}

/* Three of the places far apart in the order given are the circle. */
static dyd_status circle_answer(bool *proved, const circle_question *q) {
  size_t count = circle_places(q), base[3] = {0, count / 3, 2 * count / 3};
  turned p[4];
  dyd_turns n;
  dyd_status st = DYD_OK;
  bool good = turns_set_z(&n, q->n) && n < DYD_CYCLIC_MOST;
  for (int b = 0; b < 3 && good; b++) good = turned_set(&p[b], &q->spot[base[b]], q->n);
  for (size_t k = 0; k < count && good && st == DYD_OK; k++) {
    if (k == base[0] || k == base[1] || k == base[2]) continue;
    good = turned_set(&p[3], &q->spot[k], q->n);
    if (good) st = four_are_cocircular(&good, p, n);
  }
  *proved = good && st == DYD_OK;
  return st;
}

static dyd_status circle_ask(bool *proved, circle_question *q, dyd_error *err) {
  bool exact;
  dyd_status st = circle_read(&exact, q, err);
  if (st == DYD_OK && exact && (!q->chosen || circle_is_apart(q))) st = circle_answer(proved, q);
  return st;
}

static dyd_status circle_decide(bool *proved, circle_question *q, dyd_error *err) {
  *proved = false;
  if (q->line && q->s->free && !q->chosen) return DYD_OK; /* no place is, so that it is no tie */
  q->spot = dyd_alloc(circle_places(q), sizeof *q->spot);
  if (!q->spot) return dyd_fail_nomem(err);
  mpz_init_set_ui(q->n, 1);
  for (size_t k = 0; k < circle_places(q); k++) dyd_spot_init(&q->spot[k]);
  dyd_status st = circle_ask(proved, q, err);
  for (size_t k = 0; k < circle_places(q); k++) dyd_spot_clear(&q->spot[k]);
  mpz_clear(q->n);
  free(q->spot);
  return st;
}

dyd_status dyd_sphere_on_circle(bool *proved, const dyd_sphere *s, bool centre, const uint32_t *site, size_t count,
                                dyd_error *err) {
  circle_question q = {.s = s, .site = site, .count = count, .line = centre};
  return circle_decide(proved, &q, err);
}

/* Decides once the places that may be exact are recognised. */
static dyd_status images_prove(bool *proved, dyd_sphere *s, circle_question q, dyd_error *err) {
  const size_t count = q.count + (q.line && !s->free);
  dyd_status st = DYD_OK;
  *proved = false;
  for (size_t k = 0; k < count && st == DYD_OK; k++) st = dyd_sphere_recognise(s, place_of_circle(&q, k), err);
  return st == DYD_OK ? circle_decide(proved, &q, err) : st;
}

dyd_status dyd_sphere_prove_places(bool *proved, void *user, dyd_relation relation, const dyd_site_place *at,
                                   size_t count) {
  const circle_question q = {.s = user, .chosen = at, .count = count, .line = relation == DYD_COLLINEAR};
  return images_prove(proved, user, q, NULL);
}

dyd_status dyd_sphere_prove(bool *proved, void *user, dyd_relation relation, const uint32_t *site, size_t count,
                            dyd_error *err) {
  const circle_question q = {.s = user, .site = site, .count = count, .line = relation == DYD_COLLINEAR};
  *proved = false;
  return relation == DYD_COINCIDENT ? DYD_OK : images_prove(proved, user, q, err);
}

/* ---- distances ---- */

/* sign * (the product of the unit vectors of a and b), times 8. */
static dyd_root_term *put_dot(dyd_root_term *t, turned a, turned b, int sign, dyd_turns n) {
  const dyd_turns more = a.lat + b.lat, less = a.lat - b.lat, d = a.lon - b.lon;
  const dyd_turns e[6] = {less, more, more + d, more - d, less + d, less - d};
  const int c[6] = {2, -2, 1, 1, 1, 1};
  for (int k = 0; k < 12; k++) *t++ = (dyd_root_term){(k & 1 ? -e[k / 2] : e[k / 2]) % n, (int64_t)sign * c[k / 2]};
  return t;
}

/* The first is as far from `at` as each other one. */
static dyd_status distances_agree(bool *proved, const dyd_spot *at, const dyd_spot *spot, size_t count,
                                  mpz_srcptr unit) {
  turned p[3];
  dyd_turns n;
  dyd_status st = DYD_OK;
  bool good =
      turns_set_z(&n, unit) && n < DYD_CYCLIC_MOST && turned_set(&p[0], at, unit) && turned_set(&p[1], &spot[0], unit);
  for (size_t k = 1; k < count && good && st == DYD_OK; k++) {
    dyd_root_term term[24], *t = term;
    good = turned_set(&p[2], &spot[k], unit);
    t = put_dot(t, p[0], p[1], 1, n);
    t = put_dot(t, p[0], p[2], -1, n);
    if (good) st = dyd_cyclic_is_zero(&good, term, (size_t)(t - term), n);
  }
  *proved = good && st == DYD_OK;
  return st;
}

dyd_status dyd_spots_equidistant(bool *proved, const dyd_spot *at, const dyd_spot *spot, size_t count) {
  DYD_LOCAL_NUMBERS(mpz, n);
  mpz_set_ui(n, 1);
  for (int a = 0; a < 2; a++) {
    mpz_lcm(n, n, mpq_denref(at->mid[a]));
    for (size_t k = 0; k < count; k++) mpz_lcm(n, n, mpq_denref(spot[k].mid[a]));
  }
  mpz_mul_ui(n, n, 360);
  return distances_agree(proved, at, spot, count, n);
}
