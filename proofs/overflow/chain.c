/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/chain.c: both lists of a chain grow together. */
#define SPELL_OUT
#include "sites.h"

#include "base/alloc.h"
#include "chains.h"

typedef dyd_exact two_numbers[2];
#define ITEM two_numbers
#define RESERVE reserve_points
#define ALLOC alloc_points
#include "lists.h"
#define ITEM uint32_t
#define RESERVE reserve_blockers
#define ALLOC alloc_indices
#include "lists.h"

/*@ requires \valid(c) && c->points <= c->cap <= 1152921504606846976 && points <= 1152921504606846976 &&
      (0 < c->cap ==> \valid(c->point + (0 .. c->cap - 1)) && \valid(c->blocker + (0 .. c->cap)));
    exits \false;
    ensures \result == DYD_OK ==> c->points == points <= c->cap && (0 < c->cap ==>
      \valid(c->point + (0 .. c->cap - 1)) && \valid(c->blocker + (0 .. c->cap))); */
dyd_status dyd_cert_chain_resize(dyd_cert_chain *c, size_t points);

/*@ requires \valid(c); assigns *c; exits \false; */
void dyd_cert_chain_init(dyd_cert_chain *c);
/*@ requires \valid(c) && (0 < c->cap ==> \valid(c->point + (0 .. c->cap - 1))) && c->cap <= 1152921504606846976 &&
      \separated(c, &c->point[0][0] + (0 .. 2 * c->cap - 1)) &&
      (\forall integer q; 0 <= q < c->cap ==> whole(&c->point[q][0].man[0]) && whole(&c->point[q][1].man[0])) &&
      whole(&c->u[0][0].man[0]) && whole(&c->u[0][1].man[0]) && whole(&c->u[1][0].man[0]) &&
      whole(&c->u[1][1].man[0]);
    exits \false; */
void dyd_cert_chain_clear(dyd_cert_chain *c);
/*@ requires \valid_read(s) && small(at) && small(at + 1) && small_site(s->site + k) && small_site(s->site + i) &&
      small_site(s->site + j);
    assigns \nothing; exits \false; */
static bool blocker_is_nearer(const dyd_cert_sites *s, const dyd_exact at[2], uint32_t k, uint32_t i, uint32_t j);
/*@ requires \valid_read(s) && small(u) && small(u + 1) && small_site(s->site + k) && small_site(s->site + i) &&
      small_site(s->site + j);
    assigns \nothing; exits \false; */
static bool blocker_is_farther_out(const dyd_cert_sites *s, const dyd_exact u[2], uint32_t k, uint32_t i, uint32_t j);
/*@ requires \valid_read(s) && certified_chain(c, s) && small_site(s->site + i) && small_site(s->site + j);
    assigns \nothing; exits \false; */
static bool chain_is_blocked(const dyd_cert_chain *c, const dyd_cert_sites *s, uint32_t i, uint32_t j);
/*@ requires spotted(p) && spotted(q) && spotted(at); assigns \nothing; exits \false;
    ensures \result == 1 || \result == -1; */
static int chain_side(dyd_cert_spot p, dyd_cert_spot q, dyd_cert_spot at);
/*@ requires spotted(p) && spotted(q) && spotted(from) && spotted(a) && spotted(b); assigns \nothing; exits \false; */
static bool segment_is_met(dyd_cert_spot p, dyd_cert_spot q, dyd_cert_spot from, dyd_cert_spot a, dyd_cert_spot b);
/*@ requires spotted(p) && spotted(q) && small(from) && small(from + 1) && small(u) && small(u + 1);
    assigns \nothing; exits \false; */
static bool ray_crosses(dyd_cert_spot p, dyd_cert_spot q, const dyd_exact from[2], const dyd_exact u[2]);
/*@ requires spotted(p) && spotted(q) && small(a) && small(a + 1) && small(b) && small(b + 1);
    assigns \nothing; exits \false; */
static bool segment_crosses(dyd_cert_spot p, dyd_cert_spot q, const dyd_exact a[2], const dyd_exact b[2]);
/*@ requires \valid_read(s) && certified_chain(c, s) && small_site(s->site + i) && small_site(s->site + j);
    assigns \nothing; exits \false; */
static bool chain_separates(const dyd_cert_chain *c, const dyd_cert_sites *s, uint32_t i, uint32_t j);
/*@ requires \valid_read(s) && \valid_read(c) && (0 < c->points ==> certified_chain(c, s)) &&
      small_site(s->site + i) && small_site(s->site + j);
    assigns \nothing; exits \false; */
bool dyd_cert_chain_holds(const dyd_cert_chain *c, const dyd_cert_sites *s, uint32_t i, uint32_t j);

/*@ requires \valid(c) && c->cap <= 1152921504606846976 && (0 < c->cap ==> \valid(c->point + (0 .. c->cap - 1)) &&
      \separated(c, c->point + (0 .. c->cap - 1)));
    requires \forall integer j; 0 <= j < c->cap ==> whole(&c->point[j][0].man[0]) && whole(&c->point[j][1].man[0]);
    requires \forall integer a, k; 0 <= a < 2 && 0 <= k < 2 ==> whole(&c->u[a][k].man[0]);
    exits \false; */
void dyd_cert_chain_clear(dyd_cert_chain *c);

#include "checker/chain.c"
