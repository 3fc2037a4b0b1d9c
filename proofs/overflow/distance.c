/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/distance.c: what is reckoned on the grid, roots, sites kept of nested boxes. Areas are
 * numbers of 64 bits here: their values are no part of the proof. */
/* Unproved has_two_near_sites_assert: that all stays when s->effort grows, decided in 10 s when all is quiet. */
#define __int128 long long
#define SPELL_OUT
#include "sites.h"

#include "base/alloc.h"

#define ITEM uint32_t
#define RESERVE dyd_reserve
#include "keeps.h"

#include "checker/distance.h"
#include "checker/tree.h"

#undef mpz_inits
#undef mpz_clears
#define mpz_inits(a, b, c, d, end) mpz_init(a), mpz_init(b), mpz_init(c), mpz_init(d)
#define mpz_clears(a, b, c, d, end) mpz_clear(a), mpz_clear(b), mpz_clear(c), mpz_clear(d)

/* GMP's mpz_import of an area. */
/*@ requires \valid(z) && whole(z) && count * size == sizeof(dyd_cert_area) && \valid_read(area); assigns z->value;
    exits \false; ensures whole(z) && 0 <= sign(z); */
void import_area(mpz_ptr z, size_t count, size_t size, const dyd_cert_area *area);
#define mpz_import(z, count, order, size, endian, nails, area) import_area(z, count, size, area)

/*@ requires -2305843009213693952 <= d <= 2305843009213693952; assigns \nothing; exits \false; */
static inline dyd_cert_area dyd_cert_square(int64_t d);
typedef const dyd_cert_window *window_of;

/*@ requires \valid(w); assigns *w; exits \false;
    ensures exact(&w->e[0]) && exact(&w->e[1]) && exact(&w->e[2]) && exact(&w->e[3]); */
void dyd_cert_window_init(dyd_cert_window *w);
/*@ requires \valid(w) && whole(&w->e[0].man[0]) && whole(&w->e[1].man[0]) && whole(&w->e[2].man[0]) &&
      whole(&w->e[3].man[0]);
    assigns *w; exits \false; */
void dyd_cert_window_clear(dyd_cert_window *w);
/*@ requires \valid(man) && \valid(exp) && fraction(f, 68719476736) && 0 <= sign(&f->num.man[0]) &&
      \separated(man, f) && \separated(exp, f) && \separated(man, exp);
    assigns *man, *exp; exits \false; ensures -103079215168 <= *exp <= 103079215168; */
static void root_above(uint64_t *man, int64_t *exp, const dyd_cert_fraction *f);
/*@ assigns \nothing; exits \false; ensures \result ==> count <= 1024; */
static bool is_worth_a_look(size_t count, size_t before);

#include "checker/distance.c"
