/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Sums of roots of unity: are they 0?
 *
 * [SPH-3] z_n = exp(2 pi i / n). For a prime p and m = n / p:
 *   p divides m: 1, z_n, .., z_n^(p-1) are a basis of Q(z_n) over Q(z_m), so a sum is 0 iff for each r its terms with
 *     e = r mod p are, and these are z_n^r times a sum of powers of z_m;
 *   p does not divide m: z_n^e = z_p^a z_m^b with a = e / m mod p, b = e / p mod m, and the one relation among
 *     1, .., z_p^(p-1) over Q(z_m) is that their sum is 0: the sum is 0 iff the sums of the b for each a are all equal.
 * So n loses its primes. Those above the number of terms need not be found: some class a is empty then, so all have to
 * be 0, and so on down to classes of equal e, which are not 0 once equal e are one term. */
#include "sphere/cyclic.h"

#include "base/alloc.h"
#include <string.h>

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

/* A sum times a root of unity is 0 iff the sum is: the first e becomes 0; what all of e and n have in common is left
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

/* e becomes its class times n plus what is left: sorted by that, classes are runs. */
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

/* Is the sum of a less that of b 0? b stays as it is. */
static dyd_status runs_agree(bool *zero, const root_run *a, const root_run *b, dyd_turns m) {
  dyd_root_term *term = dyd_alloc(a->count + b->count, sizeof *term);
  if (!term) return DYD_E_NOMEM;
  memcpy(term, a->term, a->count * sizeof *term);
  for (size_t k = 0; k < b->count; k++) term[a->count + k] = (dyd_root_term){b->term[k].e, -b->term[k].c};
  dyd_status st = dyd_cyclic_is_zero(zero, term, a->count + b->count, m);
  free(term);
  return st;
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
  root_run *run = dyd_alloc(p, sizeof *run);
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
  free(run);
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
