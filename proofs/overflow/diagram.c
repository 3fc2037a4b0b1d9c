/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/diagram.c: corners of a polygon are in its list, ends of the window in theirs. */
/* Without dyd_cert_polygon_area2, read_vertices, check_polygon, check_polygons, check_area,
   check_bound, check_distance, read_window, dyd_checker_diagram: not tried. */
#define __int128 long long /* of areas nothing is proved here */
#include "checks.h"

#include "base/error.h"

typedef const dyd_cert_chain *polygon_of;
typedef const dyd_cert_window *window_of;

/*@ predicate polygon(polygon_of p) = \valid_read(p) && 0 < p->points <= 1152921504606846976 &&
      \valid_read(p->point + (0 .. p->points - 1)) &&
      (\forall integer k; 0 <= k < p->points ==> small(&p->point[k][0]) && small(&p->point[k][1]));
    predicate window(window_of w) = \valid_read(w) && (\forall integer k; 0 <= k < 4 ==> exact(&w->e[k])); */

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
    assigns *out; exits \false; */
void dyd_cert_window_area(dyd_exact *out, const dyd_cert_window *w);

#include "checker/diagram.c"
