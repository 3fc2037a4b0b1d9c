/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/checker.c: what is read of sites and pairs is in their lists, in order. */
#define __int128 long long /* of areas nothing is proved here */
#include "checks.h"
#include "pairing.h"

#include "base/alloc.h"
#include "base/error.h"

#define ITEM dyd_cert_corner
#define KEPT(a, b) ((a).i == (b).i)
#define RESERVE dyd_reserve
#include "keeps.h"

/*@ requires checker(c) && \valid(count) && most <= 4294967295 &&
      \separated(count, c, c->in.err, c->in.in, LINES + (..));
    assigns c->in.number, c->in.line, c->in.cap, c->in.at, LINES[..], *c->in.in, *c->in.err, errno, *count;
      exits \false;
    ensures \result == DYD_OK ==> checks(c) && *count <= most; */
static dyd_status read_heading(uint32_t *count, dyd_checker *c, const char *name, uint64_t most);
/*@ requires checker(c) && point(c) && \separated(c, &errno) && \valid(i) &&
      \separated(i, c, c->in.err, c->in.in, LINES + (..)) &&
      \separated(i, c->sites.site + (0 .. c->sites.count - 1));
    assigns c->in.number, c->in.line, c->in.cap, c->in.at, LINES[..], *c->in.in, *c->in.err, errno, *i,
      c->point[0 .. 1];
    exits \false;
    ensures \result == DYD_OK ==> kept(&c->in);
    ensures \result == DYD_OK && !first ==> \old(*i) < *i;
    ensures \result == DYD_OK ==> *i < c->sites.count && certified(&c->point[0]) && certified(&c->point[1]); */
static dyd_status read_site_and_point(uint32_t *i, dyd_checker *c, bool first, const char *list);
/*@ requires \valid_read(s) && exact(&s->lo) && exact(&s->hi) && exact(v); assigns \nothing; exits \false; */
static bool side_holds_value(const dyd_cert_side *s, const dyd_exact *v);
/*@ requires checker(c);
    assigns c->in.number, c->in.line, c->in.cap, c->in.at, LINES[..], *c->in.in, *c->in.err, errno,
      c->report.goal_bits, c->report.goal; exits \false;
    ensures \result == DYD_OK ==> \old(-999999999999999999 <= c->report.goal_bits <= 999999999999999999) ==>
      -999999999999999999 <= c->report.goal_bits <= 999999999999999999; */
static dyd_status check_goal(dyd_checker *c);
/*@ requires checker(c);
    assigns c->in.number, c->in.line, c->in.cap, c->in.at, LINES[..], *c->in.in, *c->in.err, errno, c->report.outcome,
      c->report.goal_bits, c->report.goal, c->report.capped;
    exits \false; CHECKER_LEFT
    ensures \result == DYD_OK ==> \old(-999999999999999999 <= c->report.goal_bits <= 999999999999999999) ==>
      -999999999999999999 <= c->report.goal_bits <= 999999999999999999; */
dyd_status dyd_checker_head(dyd_checker *c);
/*@ requires \valid(c) && c->count <= 1152921504606846976 &&
      (0 < c->count ==> \valid(c->item + (0 .. c->count - 1)) && \separated(c, c->item + (0 .. c->count - 1)));
    exits \false; */
void dyd_cert_corners_clear(dyd_cert_corners *c);
/* Corners are in order; corner_list is what faces.c asks of them. */
typedef const dyd_cert_corner *corner_of;
typedef const dyd_cert_corners *corners;
/*@ predicate corner_list(corner_of c, integer count) = count <= 1152921504606846976 &&
      (0 < count ==> \valid_read(c + (0 .. count - 1))) && (\forall integer k; 0 <= k < count ==> c[k].i < SITES) &&
      (\forall integer k, l; 0 <= k < l < count ==> c[k].i < c[l].i);
    predicate extends(corners c) = \valid(c) && c->count <= c->cap <= 1152921504606846976 &&
      (0 < c->cap ==> \valid(c->item + (0 .. c->cap - 1))) && corner_list(c->item, c->count); */
/*@ requires extends(c) && c->count < 4294967295 && exact(u) && exact(u + 1) && i < SITES &&
      (0 < c->count ==> c->item[c->count - 1].i < i);
    exits \false;
    ensures \result == DYD_OK ==> c->count == \old(c->count) + 1 && c->item[c->count - 1].i == i;
    ensures \result == DYD_OK ==> extends(c); */
static dyd_status corners_add(dyd_cert_corners *c, uint32_t i, const dyd_exact u[2]);


typedef dyd_cert_sites *list_of_sites;
typedef dyd_cert_site *new_site;

/*@ predicate room(list_of_sites s) = \valid(s) && s->count <= s->cap <= 1152921504606846976 &&
      s->count <= 4294967295 &&
      (0 < s->cap ==> \valid(s->site + (0 .. s->cap - 1)) && \separated(s->site + (0 .. s->cap - 1), s));
    predicate blank(new_site s) = exact(&s->side[0].lo) && exact(&s->side[0].hi) && exact(&s->side[1].lo) &&
      exact(&s->side[1].hi) && s->side[0].den == \null && s->side[1].den == \null && s->place == \null;
    predicate located(checking c) = checker(c) && room(&c->sites) &&
      \separated(c->sites.site + (0 .. c->sites.cap - 1), c, c->in.err, c->in.in, LINES + (..)); */

/* Of sites.c and tree.c, and that all else stays, which WP does not see: new memory is new. */
/*@ requires room(s);
    assigns s->site, s->cap, s->count, s->site[0 .. s->cap - 1]; exits \false;
    ensures room(s);
    ensures \result == \null ==> s->count == \old(s->count) && s->site == \old(s->site) && s->cap == \old(s->cap);
    ensures \result != \null ==> s->count == \old(s->count) + 1 && \result == s->site + \old(s->count) &&
      blank(\result); */
dyd_cert_site *dyd_cert_sites_add(dyd_cert_sites *s);
/*@ requires room(s); assigns s->box, s->unit, s->origin[0 .. 1][0 .. 0]; exits \false; */
dyd_status dyd_cert_sites_finish(dyd_cert_sites *s);
/*@ requires \valid(t) && \valid_read(s); assigns *t; exits \false; */
dyd_status dyd_cert_tree_init(dyd_cert_tree *t, const dyd_cert_sites *s);
/*@ requires \valid(site) && exact(at) && exact(at + 1) && \separated(site, at + (0 .. 1));
    requires site->place == \null || \valid(site->place + (0 .. 1)) && exact(site->place) && exact(site->place + 1) &&
      \separated(site->place + (0 .. 1), site, at + (0 .. 1));
    assigns site->place, site->place[0 .. 1]; exits \false; */
dyd_status dyd_cert_site_set_place(dyd_cert_site *site, const dyd_exact at[2]);
/*@ requires \valid(f) && \valid(bad) && \valid_read(g) && corner_list(corner, corners);
    assigns *f, *bad; exits \false; ensures \result == DYD_OK && *bad == DYD_CERT_NONE ==> indexed(f); */
dyd_status dyd_cert_faces_init(dyd_cert_faces *f, uint32_t *bad, const dyd_cert_graph *g, const dyd_cert_corner *corner,
                               size_t corners);

/*@ requires located(c) && reads(&c->in); exits \false; ensures \result == DYD_OK ==> reads(&c->in); */
static dyd_status read_rectangle(dyd_checker *c);
/*@ requires located(c) && reads(&c->in); exits \false;
    CHECKER_LEFT
    ensures \result == DYD_OK && c->in.at != \null ==> 0 < c->in.cap && inside(&c->in, c->in.at);
    ensures \result == DYD_OK ==> room(&c->sites);
    ensures \result == DYD_OK ==>
      \separated(c->sites.site + (0 .. c->sites.cap - 1), c, c->in.err, c->in.in, LINES + (..));
    ensures \result == DYD_OK ==> c->sites.count == \old(c->sites.count) + 1; */
static dyd_status read_alias(dyd_checker *c);
/*@ requires located(c) && c->sites.count == 0; exits \false;
    ensures \result == DYD_OK ==> located(c); */
dyd_status dyd_checker_sites(dyd_checker *c);

/*@ predicate ready(checking c) = checker(c) && point(c) && \separated(c, &errno) && c->sites.count == SITES; */
/*@ requires ready(c) && (to == &c->legal || to == &c->bridges) && grows(to) && \valid(pair) &&
      \separated(pair, c, c->in.err, c->in.in, LINES + (..), c->sites.site + (0 .. c->sites.count - 1)) &&
      \separated(to->item + (0 .. to->cap - 1), c, c->in.err, pair);
    exits \false;
    ensures \result == DYD_OK ==> ready(c);
    ensures \result == DYD_OK ==> grows(to); */
static dyd_status read_witnessed(dyd_checker *c, dyd_cert_edges *to, dyd_cert_edge *pair, bool places);
/*@ requires ready(c) && (to == &c->legal || to == &c->bridges) && grows(to) &&
      \separated(to->item + (0 .. to->cap - 1), c, c->in.err);
    exits \false; ensures \result == DYD_OK ==> ready(c) && grows(to);
    ensures \valid(c); */
static dyd_status read_edges(dyd_checker *c, dyd_cert_edges *to, const char *name, bool places);
/*@ requires ready(c) && grows(&c->legal) && \separated(c->legal.item + (0 .. c->legal.cap - 1), c, c->in.err);
    exits \false; ensures \result == DYD_OK ==> ready(c) && grows(&c->legal); */
dyd_status dyd_checker_legal(dyd_checker *c);
/*@ requires ready(c) && grows(&c->bridges) && \separated(c->bridges.item + (0 .. c->bridges.cap - 1), c, c->in.err);
    exits \false; ensures \result == DYD_OK ==> ready(c) && grows(&c->bridges); */
dyd_status dyd_checker_bridges(dyd_checker *c);
/*@ requires ready(c); exits \false; ensures \result == DYD_OK ==> ready(c); */
dyd_status dyd_checker_places(dyd_checker *c);

/*@ predicate linked(checking c) = pairs(&c->legal, SITES) && pairs(&c->bridges, SITES) &&
      \separated(&c->graph, &c->sites, &c->legal, &c->bridges, c->sites.site + (0 .. SITES - 1),
        c->legal.item + (0 .. c->legal.count - 1), c->bridges.item + (0 .. c->bridges.count - 1)); */
/*@ requires ready(c) && linked(c) && extends(&c->corners);
    exits \false; ensures \result == DYD_OK ==> indexed(&c->faces); */
static dyd_status checker_find_faces(dyd_checker *c);
/*@ requires ready(c) && linked(c) && c->corners.count == 0 && c->corners.cap == 0;
    exits \false; ensures \result == DYD_OK ==> indexed(&c->faces); */
dyd_status dyd_checker_corners(dyd_checker *c);

#include "checker/checker.c"
