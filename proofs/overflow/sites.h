/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts of what src/checker/sites.h has in it. */
#ifndef DYD_PROOFS_SITES_H
#define DYD_PROOFS_SITES_H

#include "exact.h"

#include "checker/sites.h"

typedef const dyd_cert_side *side_of;

/*@ predicate side(side_of s) = \valid_read(s) && exact(&s->lo) && exact(&s->hi) &&
      (s->den == \null || whole(&(*s->den)[0]) && sign(&(*s->den)[0]) == 1); */

/*@ requires \valid_read(s); assigns \nothing; exits \false; */
static inline bool dyd_cert_is_point(const dyd_cert_site *s);
/*@ requires \valid_read(s); assigns \nothing; exits \false; ensures \result == (s->point ? &s->lo : &s->hi); */
static inline const dyd_exact *dyd_cert_high(const dyd_cert_side *s);
/*@ requires \valid_read(s) && (s->den == \null || \valid_read(s->den)); assigns \nothing; exits \false;
    ensures s->den == \null ? \result == \null : \result == &(*s->den)[0]; */
static inline mpz_srcptr dyd_cert_den(const dyd_cert_side *s);
/*@ requires \valid_read(s) && 0 <= axis <= 1 && \valid(den) && \separated(den, s) &&
      (s->side[axis].den == \null || \valid_read(s->side[axis].den));
    assigns *den; exits \false;
    ensures s->place != \null ==> \result == s->place + axis && *den == \null;
    ensures s->place == \null ==> \result == &s->side[axis].lo &&
      (s->side[axis].den == \null ? *den == \null : *den == &(*s->side[axis].den)[0]); */
static inline const dyd_exact *dyd_cert_place(mpz_srcptr *den, const dyd_cert_site *s, int axis);
/*@ requires \valid(side) && whole(den) && (side->den == \null || \valid(side->den));
    assigns side->den, (*side->den)[0]; exits \false; ensures \result == DYD_OK || \result == DYD_E_NOMEM; */
dyd_status dyd_cert_side_set_den(dyd_cert_side *side, mpz_srcptr den);

/* Fractions: of_parts, of any exponents; fraction, where they are no farther than `most` from 0. */
#define of_parts(f) (\valid_read(f) && whole(&(f)->num.man[0]) && whole(&(f)->den[0]) && \
    (!(f)->whole ==> sign(&(f)->den[0]) == 1))
#define fraction(f, most) (of_parts(f) && -(most) <= (f)->num.exp <= (most))
#define same_or_apart(f, g) ((f) == (g) || \separated(f, g))
#define FRACTION(f) PARTS(&(f)->num), (f)->den[0].value, (f)->whole

/* Numbers of certificates, and what is made of them: sides, sites, spots. */
#define small(x) (\valid_read(x) && whole(&(x)->man[0]) && -1048576 <= (x)->exp <= 1048576)
#define denominator(z) ((z) == \null || whole(z) && sign(z) == 1)
#define small_side(s) (\valid_read(s) && small(&(s)->lo) && small(&(s)->hi) && ((s)->den == \null || \
    whole(&(*(s)->den)[0]) && sign(&(*(s)->den)[0]) == 1))
#define apart_from_side(x, s) (\separated(x, s) && ((s)->den == \null || \separated(x, &(*(s)->den)[0])))
#define placed(s) ((s)->place == \null || small((s)->place) && small((s)->place + 1))
#define small_site(s) (\valid_read(s) && small_side(&(s)->side[0]) && small_side(&(s)->side[1]) && placed(s))
#define apart_from_site(x, s) (\separated(x, s) && apart_from_side(x, &(s)->side[0]) && \
    apart_from_side(x, &(s)->side[1]) && ((s)->place == \null || \separated(x, (s)->place + (0 .. 1))))


/*@ requires \valid(f); assigns FRACTION(f);
    exits \false; ensures fraction(f, 0) && f->whole && sign(&f->num.man[0]) == 0; */
void dyd_cert_fraction_init(dyd_cert_fraction *f);
/*@ requires \valid(f) && whole(&f->num.man[0]) && whole(&f->den[0]); assigns FRACTION(f); exits \false; */
void dyd_cert_fraction_clear(dyd_cert_fraction *f);
/*@ requires fraction(a, 274877906944) && fraction(b, 274877906944); assigns \nothing; exits \false;
    ensures -1 <= \result <= 1; */
int dyd_cert_fraction_cmp(const dyd_cert_fraction *a, const dyd_cert_fraction *b);
/*@ requires \valid(out) && of_parts(out) && exact(a) && exact(b) &&
      denominator(da) && denominator(db);
    requires \separated(out, a) && \separated(out, b) && (da == \null || \separated(out, da)) &&
      (db == \null || \separated(out, db));
    assigns FRACTION(out); exits \false; ensures of_parts(out) && between(out->num.exp, \old(a->exp), \old(b->exp)); */
void dyd_cert_fraction_sub(dyd_cert_fraction *out, const dyd_exact *a, mpz_srcptr da, const dyd_exact *b,
                           mpz_srcptr db);
/*@ requires \valid(out) && of_parts(out) && fraction(a, 274877906944) && fraction(b, 274877906944) &&
      same_or_apart(out, a) && same_or_apart(out, b);
    assigns FRACTION(out);
    exits \false; ensures of_parts(out) && out->num.exp == \old(a->num.exp) + \old(b->num.exp); */
void dyd_cert_fraction_mul(dyd_cert_fraction *out, const dyd_cert_fraction *a, const dyd_cert_fraction *b);
/*@ requires \valid(out) && of_parts(out) && fraction(a, 274877906944) && fraction(b, 274877906944) &&
      same_or_apart(out, a) && same_or_apart(out, b);
    assigns FRACTION(out); exits \false;
    ensures of_parts(out) && between(out->num.exp, \old(a->num.exp), \old(b->num.exp)); */
void dyd_cert_fraction_add(dyd_cert_fraction *out, const dyd_cert_fraction *a, const dyd_cert_fraction *b);
/*@ requires \valid(a) && \valid(b) && of_parts(a) && of_parts(b) && \separated(a, b);
    assigns FRACTION(a), FRACTION(b); exits \false;
    ensures of_parts(a) && of_parts(b) && a->num.exp == \old(b->num.exp) && b->num.exp == \old(a->num.exp); */
void dyd_cert_fraction_swap(dyd_cert_fraction *a, dyd_cert_fraction *b);

#define spot(p) (\valid_read(p) && small((p)->v[0]) && small((p)->v[1]) && denominator((p)->den[0]) && \
    denominator((p)->den[1]))
#define apart_from_spot(x, p) (\separated(x, (p)->v[0]) && \separated(x, (p)->v[1]) && \
    ((p)->den[0] == \null || \separated(x, (p)->den[0])) && ((p)->den[1] == \null || \separated(x, (p)->den[1])))
#define spotted(r) (small(r.v[0]) && small(r.v[1]) && denominator(r.den[0]) && denominator(r.den[1]))

/*@ requires \valid(out) && of_parts(out) && small(c) && small(c + 1) && small_site(s) &&
      \separated(out, c + (0 .. 1)) &&
      apart_from_site(out, s);
    assigns FRACTION(out); exits \false; ensures fraction(out, 2097152); */
void dyd_cert_distance2(dyd_cert_fraction *out, const dyd_exact c[2], const dyd_cert_site *s,
                        dyd_cert_measure measure);
/*@ requires \valid_read(s) && small_site(s->site + v); assigns \nothing; exits \false; ensures spotted(\result); */
dyd_cert_spot dyd_cert_place_of(const dyd_cert_sites *s, uint32_t v);
/*@ requires small(v) && small(v + 1); assigns \nothing; exits \false;
    ensures spotted(\result) && \result.v[0] == v && \result.v[1] == v + 1; */
dyd_cert_spot dyd_cert_spot_at(const dyd_exact v[2]);
/*@ requires spotted(a) && spotted(b) && spotted(c) && spotted(d); assigns \nothing; exits \false;
    ensures -1 <= \result <= 1; */
int dyd_cert_cross(dyd_cert_spot a, dyd_cert_spot b, dyd_cert_spot c, dyd_cert_spot d);
/*@ requires \valid_read(s) && small(u) && small(u + 1) && small_site(s->site + a) && small_site(s->site + b);
    assigns \nothing; exits \false; ensures -1 <= \result <= 1; */
int dyd_cert_compare_heights(const dyd_cert_sites *s, const dyd_exact u[2], uint32_t a, uint32_t b);

#endif
