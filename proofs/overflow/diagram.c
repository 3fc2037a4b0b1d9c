/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/diagram.c: corners of a polygon are in its list, ends of the window in theirs. */
#define __int128 long long /* of areas nothing is proved here */
#include "checks.h"

#include "base/error.h"

typedef const dyd_cert_chain *polygon_of;
typedef const dyd_cert_window *window_of;

/*@ predicate polygon(polygon_of p) = \valid_read(p) && 0 < p->points <= 1152921504606846976 &&
      \valid_read(p->point + (0 .. p->points - 1)) &&
      (\forall integer k; 0 <= k < p->points ==> small(&p->point[k][0]) && small(&p->point[k][1]));
    predicate window(window_of w) = \valid_read(w) && (\forall integer k; 0 <= k < 4 ==> exact(&w->e[k])); */

#include "literals.h"

/*@ predicate sized(exact_number x) = exact(x) && -3145728 <= x->exp <= 3145728; */
/*@ requires polygon(p) && k <= p->points; assigns \nothing; exits \false; */
static bool polygon_goes_on(const dyd_cert_chain *p, size_t k);
/*@ requires window(w) && exact(at) && exact(at + 1); assigns \nothing; exits \false; */
bool dyd_cert_window_has(const dyd_cert_window *w, const dyd_exact at[2]);
/*@ requires polygon(p) && k <= p->points + 2; assigns \nothing; exits \false; ensures spotted(\result); */
static dyd_cert_spot polygon_spot(const dyd_cert_chain *p, size_t k);
/*@ requires \valid_read(p) && (0 < p->points ==> polygon(p)); assigns \nothing; exits \false; */
bool dyd_cert_polygon_is_convex(const dyd_cert_chain *p);
/*@ requires \valid(out) && window(w) && (\forall integer k; 0 <= k < 4 ==> certified(&w->e[k])) &&
      \separated(out, w);
    assigns *out; exits \false; ensures sized(out); */
void dyd_cert_window_area(dyd_exact *out, const dyd_cert_window *w);

/*@ requires \valid(out) && sized(out) && polygon(p) && \separated(out, p, p->point + (0 .. p->points - 1));
    assigns *out; exits \false; ensures sized(out); */
void dyd_cert_polygon_area2(dyd_exact *out, const dyd_cert_chain *p);

/*@ predicate drawn_polygon(checking c) = c->chain.points <= c->chain.cap <= 1152921504606846976 &&
      (0 < c->chain.cap ==> \valid(c->chain.point + (0 .. c->chain.cap - 1)) &&
        \valid(c->chain.blocker + (0 .. c->chain.cap)));
    predicate drawing(checking c) = checker(c) && drawn_polygon(c);
    predicate frame(window_of w) = \valid(w) && certified(&w->e[0]) && certified(&w->e[1]) && certified(&w->e[2]) &&
      certified(&w->e[3]); */
/* Of chain.c: and that a chain is all that changes, that points before stay, and new ones are numbers, which WP does
 * not see. */
/*@ requires \valid(c) && c->points <= c->cap <= 1152921504606846976 && points <= 1152921504606846976 &&
      (0 < c->cap ==> \valid(c->point + (0 .. c->cap - 1)) && \valid(c->blocker + (0 .. c->cap)));
    assigns c->points, c->cap, c->point, c->blocker; exits \false;
    ensures \result == DYD_OK ==> c->points == points <= c->cap <= 1152921504606846976 && (0 < c->cap ==>
      \valid(c->point + (0 .. c->cap - 1)) && \valid(c->blocker + (0 .. c->cap)));
    ensures \result == DYD_OK ==> \forall integer k; 0 <= k < points ==> exact(&c->point[k][0]) &&
      exact(&c->point[k][1]); */
dyd_status dyd_cert_chain_resize(dyd_cert_chain *c, size_t points);
/*@ requires \valid(holds) && \valid_read(s) && window(w) && exact(bound); assigns *holds; exits \false; */
dyd_status dyd_cert_distance_holds(bool *holds, const dyd_cert_sites *s, const dyd_cert_window *w,
                                   const dyd_exact *bound);
/*@ requires \valid(w); assigns w->e[0 .. 3]; exits \false;
    ensures \forall integer k; 0 <= k < 4 ==> exact(&w->e[k]) && w->e[k].exp == 0; */
void dyd_cert_window_init(dyd_cert_window *w);
/*@ requires \valid(w) && whole(&w->e[0].man[0]) && whole(&w->e[1].man[0]) && whole(&w->e[2].man[0]) &&
      whole(&w->e[3].man[0]);
    assigns w->e[0 .. 3]; exits \false; */
void dyd_cert_window_clear(dyd_cert_window *w);

/*@ requires drawing(c) && reads(&c->in); exits \false;
    ensures \result == DYD_OK ==> drawing(c); ensures \result == DYD_OK ==> polygon(&c->chain); */
static dyd_status read_vertices(dyd_checker *c);
/*@ requires drawing(c);
    requires reads(&c->in);
    requires \valid(area2) && sized(area2) && frame(w) && i < c->sites.count;
    requires \separated(area2, w, c, c->in.err, c->in.in, LINES + (..));
    exits \false; ensures sized(area2); CHECKER_LEFT
    ensures \result == DYD_OK ==> drawn_polygon(c); */
static dyd_status check_polygon(dyd_checker *c, dyd_exact *area2, const dyd_cert_window *w, uint32_t i);
/*@ requires drawing(c) && \valid(area2) && sized(area2) && frame(w) &&
      \separated(area2, w, c, c->in.err, c->in.in, LINES + (..));
    exits \false; ensures sized(area2);
    ensures \result == DYD_OK ==> drawing(c);
    ensures \result == DYD_OK ==> reads(&c->in);
    ensures \result == DYD_OK ==> frame(w);
    ensures \result == DYD_OK ==> \separated(area2, w, c, c->in.err, c->in.in, LINES + (..)); */
static dyd_status check_polygons(dyd_checker *c, dyd_exact *area2, const dyd_cert_window *w);
/*@ requires checks(c) && \valid(area2) && sized(area2) && frame(w) &&
      -999999999999999999 <= c->report.goal_bits <= 999999999999999999 &&
      \separated(area2, w, c, c->in.err, c->in.in, LINES + (..));
    assigns c->in.at, c->in.line[0 .. c->in.cap - 1], *c->in.err, *area2, c->reached; exits \false;
    ensures whole(&area2->man[0]); ensures \result == DYD_OK ==> checker(c); */
static dyd_status check_area(dyd_checker *c, dyd_exact *area2, const dyd_cert_window *w);
/*@ requires checks(c) && certified(bound) && window(w) && \separated(bound, c, c->in.err) &&
      \separated(w, c, c->in.err) &&
      -999999999999999999 <= c->report.goal_bits <= 999999999999999999;
    assigns c->in.at, c->in.line[0 .. c->in.cap - 1], *c->in.err, c->reached, c->report.distance,
      c->report.distance_proved; exits \false; */
static dyd_status check_bound(dyd_checker *c, const dyd_exact *bound, const dyd_cert_window *w);
/*@ requires checker(c) && window(w) && -999999999999999999 <= c->report.goal_bits <= 999999999999999999 &&
      \separated(w, c, c->in.err, c->in.in, LINES + (..)) && \separated(w, &errno);
    assigns c->in.number, c->in.line, c->in.cap, c->in.at, LINES[..], *c->in.in, *c->in.err, errno, c->reached,
      c->report.distance, c->report.distance_proved; exits \false; */
static dyd_status check_distance(dyd_checker *c, const dyd_cert_window *w);
/*@ requires checks(c) && \valid(w) && exact(&w->e[0]) && exact(&w->e[1]) && exact(&w->e[2]) && exact(&w->e[3]) &&
      \separated(w, c, c->in.err, c->in.in, LINES + (..));
    assigns c->in.at, c->in.line[0 .. c->in.cap - 1], *c->in.err, w->e[0 .. 3]; exits \false;
    ensures whole(&w->e[0].man[0]) && whole(&w->e[1].man[0]) && whole(&w->e[2].man[0]) && whole(&w->e[3].man[0]);
    ensures \result == DYD_OK ==> checker(c);
    ensures \result == DYD_OK ==> frame(w); */
static dyd_status read_window(dyd_checker *c, dyd_cert_window *w);
/*@ requires drawing(c) && reads(&c->in) && -999999999999999999 <= c->report.goal_bits <= 999999999999999999;
    exits \false; */
dyd_status dyd_checker_diagram(dyd_checker *c);

#include "checker/diagram.c"
