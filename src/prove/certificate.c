/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Writes certificates (proofs/certificates.md has the format).
 *
 * Everything that needs a proof is put before the checker's own tests first; a statement that they reject is written as
 * unproved. */
#include "base/abi.h"
#include "base/alloc.h"
#include "base/error.h"
#include "checker/bounds.h"
#include "checker/near.h"
#include "delaunay/memory.h"
#include "io/output.h"
#include "prove/proof.h"
#include "rect/rect.h"
#include "sphere/state.h"
#include "voronoi/shape.h"
#include <dyadel/certificate.h>
#include <dyadel/graph.h>
#include <dyadel/io.h>
#include <dyadel/sphere.h>
#include <inttypes.h>

/* What a certificate is of. parts: discs, a graph, or none; window: NULL: no section on the diagram; sphere: NULL: none
 * on a sphere, whose images are those of the engine; again: its places have been written. */
typedef struct subject {
  const dyd_engine *engine;
  const dyd_certificate_parts *parts;
  const dyd_rect *window;
  const dyd_sphere *sphere;
  bool again;
} subject;

static const dyd_certificate_parts no_parts = {0};

static void proof_clear(dyd_proof *p) {
  dyd_proof_drop_corners(p);
  free(p->corner);
  dyd_proof_points_clear(&p->witness);
  dyd_proof_points_clear(&p->centre);
  dyd_cert_sites_clear(&p->sites);
  dyd_cert_tree_clear(&p->tree);
  dyd_cert_graph_clear(&p->graph);
  dyd_cert_faces_clear(&p->faces);
  dyd_free_all(p->legal.item, p->bridges.item, p->open.item, p->chained.item);
  dyd_pair_list_clear(&p->pairs);
}

/* ---- gathering ---- */

static dyd_status proof_gather_sites(dyd_proof *p) {
  const dyd_sites *sites = dyd_delaunay_sites(p->pd);
  dyd_rect r;
  dyd_rect_init(&r);
  dyd_status st = DYD_OK;
  for (size_t i = 0; i < dyd_sites_count(sites) && st == DYD_OK; i++) {
    st = dyd_sites_get(&r, sites, i);
    for (int a = 0; a < 2; a++) {
      const dyd_interval *side = a ? &r.y : &r.x;
      p->rounded |= mpz_cmp_ui(side->den, 1) && !dyd_interval_is_point(side);
    }
    if (st == DYD_OK) st = dyd_proof_add_site(&p->sites, &r);
    if (st == DYD_OK) p->sites.site[i].alias = dyd_delaunay_alias(p->pd, (uint32_t)i);
  }
  dyd_rect_clear(&r);
  if (st == DYD_OK) st = dyd_cert_sites_finish(&p->sites);
  return st == DYD_OK ? dyd_cert_tree_init(&p->tree, &p->sites) : st;
}

/* Legal pairs with a witness become edges; the others stay in the list of pairs only. */
static dyd_status proof_gather_legal(dyd_proof *p) {
  dyd_point c;
  dyd_point_init(&c);
  dyd_status st = dyd_delaunay_pairs(&p->pairs, p->pd);
  for (size_t k = 0; k < p->pairs.count && st == DYD_OK; k++) {
    const dyd_pair *pair = &p->pairs.item[k];
    bool found = false;
    if (pair->status != DYD_LEGAL) continue;
    st = dyd_delaunay_witness(&c, p->pd, pair->i, pair->j);
    if (st == DYD_OK) st = dyd_proof_add_witness(&found, &p->witness, p, pair->i, pair->j, &c, false);
    if (st == DYD_E_RANGE) st = DYD_OK;
    if (st == DYD_OK && found) st = dyd_cert_edges_add(&p->legal, pair->i, pair->j);
  }
  dyd_point_clear(&c);
  return st;
}

static dyd_status proof_gather(dyd_proof *p) {
  dyd_status st = proof_gather_sites(p);
  if (st == DYD_OK) st = proof_gather_legal(p);
  if (st == DYD_OK) st = dyd_proof_find_bridges(p);
  return st == DYD_OK ? dyd_proof_find_faces(p) : st;
}

/* ---- sections ---- */

/* Discs may decide what rectangles leave open. */
static dyd_outcome outcome_of_parts(const dyd_proof *p, const dyd_certificate_parts *parts) {
  bool open = dyd_engine_goal(NULL, p->engine) != DYD_GOAL_DECIDED || dyd_delaunay_is_capped(p->pd);
  if (!parts->discs) return dyd_engine_outcome(p->engine);
  for (size_t k = 0; k < parts->discs->count && !open; k++) open = parts->discs->item[k].status != DYD_LEGAL;
  return open ? dyd_engine_outcome(p->engine) : DYD_OUTCOME_DECIDED;
}

static void certificate_head(FILE *out, const dyd_proof *p, const dyd_certificate_parts *parts) {
  int64_t bits;
  dyd_goal goal = dyd_engine_goal(&bits, p->engine);
  fprintf(out, "dyadel certificate 1\noutcome %s\ngoal %s", dyd_outcome_text(outcome_of_parts(p, parts)),
          dyd_goal_text(goal));
  if (goal != DYD_GOAL_DECIDED) fprintf(out, " %" PRId64, bits);
  fprintf(out, "\ncapped %s\n", dyd_delaunay_is_capped(p->pd) ? "yes" : "no");
}

static void certificate_sites(FILE *out, const dyd_proof *p) {
  fprintf(out, "sites %zu\n", p->sites.count);
  for (size_t i = 0; i < p->sites.count; i++) {
    const dyd_cert_site *s = &p->sites.site[i];
    if (s->alias != i)
      dyd_proof_put(out, "= %i\n", s->alias);
    else
      dyd_proof_put(out, "%s %s\n", &s->side[0], &s->side[1]);
  }
}

static void certificate_edges(FILE *out, const char *name, const dyd_cert_edges *edges,
                              const dyd_proof_points *centre) {
  fprintf(out, "%s %zu\n", name, edges->count);
  for (size_t e = 0; e < edges->count; e++)
    dyd_proof_put(out, "%i %i %p\n", edges->item[e].i, edges->item[e].j, centre->item[e]);
}

static void certificate_places(FILE *out, const dyd_proof *p) {
  size_t count = 0;
  for (size_t i = 0; i < p->sites.count; i++) count += p->sites.site[i].place != NULL;
  fprintf(out, "places %zu\n", count);
  for (uint32_t i = 0; i < p->sites.count; i++)
    if (p->sites.site[i].place) dyd_proof_put(out, "%i %p\n", i, p->sites.site[i].place);
}

static void certificate_corners(FILE *out, const dyd_proof *p) {
  fprintf(out, "corners %zu\n", p->corners);
  for (size_t q = 0; q < p->corners; q++) dyd_proof_put(out, "%i %p\n", p->corner[q].i, p->corner[q].u);
}

/* ---- the end ---- */

/* Sets *fits: do the bounds of area and distance hold for the rectangles stated, which may be rounded? */
static void bounds_check(bool fits[2], const dyd_proof *p, const dyd_exact bound[2]) {
  dyd_cert_bounds b;
  dyd_cert_bounds_init(&b);
  b.hausdorff = &bound[1];
  for (size_t e = 0; e < p->legal.count; e++)
    dyd_cert_bounds_add(&b, &p->sites, p->legal.item[e].i, p->legal.item[e].j, true);
  for (size_t e = 0; e < p->open.count; e++)
    dyd_cert_bounds_add(&b, &p->sites, p->open.item[e].i, p->open.item[e].j, false);
  fits[0] = dyd_cert_bounds_area_holds(&b, &bound[0]);
  fits[1] = !b.exceeded;
  dyd_cert_bounds_clear(&b);
}

/* Raises the bounds of rectangles that are stated rounded: by 2^-60 of each, by 16 times as much, and so on. */
static void bounds_raise(dyd_exact bound[2], const dyd_proof *p) {
  dyd_exact more;
  bool fits[2];
  dyd_exact_init(&more);
  for (int64_t exp = -60; exp < 0 && (bounds_check(fits, p, bound), !fits[0] || !fits[1]); exp += 4)
    for (int k = 0; k < 2; k++) {
      if (fits[k]) continue;
      mpz_set_ui(more.man, 1);
      more.exp = dyd_exact_top(&bound[k]) + exp;
      dyd_exact_add(&bound[k], &bound[k], &more);
    }
  dyd_exact_clear(&more);
}

static dyd_status certificate_end(FILE *out, const dyd_proof *p) {
  dyd_dyadic area, hausdorff;
  dyd_exact bound[2];
  dyd_dyadic_init(&area);
  dyd_dyadic_init(&hausdorff);
  dyd_proof_init(bound, 2);
  fprintf(out, "triangles %zu\nunproved %" PRIu64 "\n", p->faces.triangles, p->unproved);
  dyd_status st = dyd_engine_bounds(&area, &hausdorff, p->engine);
  if (st == DYD_OK) {
    dyd_proof_set(&bound[0], &area);
    dyd_proof_set(&bound[1], &hausdorff);
    if (p->rounded) bounds_raise(bound, p);
    dyd_proof_put(out, "area %n\nhausdorff %n\n", &bound[0], &bound[1]);
  } else {
    fputs("area none\nhausdorff none\n", out);
  }
  dyd_proof_clear(bound, 2);
  dyd_dyadic_clear(&area);
  dyd_dyadic_clear(&hausdorff);
  return st == DYD_E_NOMEM ? st : DYD_OK;
}

static void certificate_graph(FILE *out, const dyd_graph_list *l, int kind) {
  static const char *const name[] = {
      [DYD_GRAPH_NEAREST] = "nearest", [DYD_GRAPH_GABRIEL] = "gabriel", [DYD_GRAPH_MST] = "mst"};
  fprintf(out, "graph %s %zu\n", name[kind], l->count);
  for (size_t k = 0; k < l->count; k++)
    fprintf(out, "%c %" PRIu32 " %" PRIu32 "\n", l->item[k].sure ? 'c' : 'p', l->item[k].i, l->item[k].j);
}

static dyd_status certificate_sections(FILE *out, dyd_proof *p, const subject *of) {
  const dyd_certificate_parts *parts = of->parts;
  certificate_head(out, p, parts);
  certificate_sites(out, p);
  certificate_edges(out, "legal", &p->legal, &p->witness);
  certificate_places(out, p);
  certificate_edges(out, "bridges", &p->bridges, &p->centre);
  certificate_corners(out, p);
  dyd_status st = dyd_proof_put_pairs(out, p);
  if (st == DYD_OK) st = certificate_end(out, p);
  if (st == DYD_OK) st = dyd_proof_put_ties(out, p);
  if (st == DYD_OK && parts->discs) st = dyd_proof_put_discs(out, p, parts->discs);
  if (st == DYD_OK && parts->graph) certificate_graph(out, parts->graph, parts->kind);
  if (st == DYD_OK && of->window) st = dyd_proof_put_diagram(out, p, of->window);
  if (st == DYD_OK && of->sphere) st = dyd_proof_put_globe(out, p, of->sphere, of->again);
  return st;
}

/* The pairs of sites of one undecided face each. */
static dyd_status pairs_of_faces(uint64_t *out, const dyd_delaunay *pd) {
  dyd_index_list sites = {0};
  dyd_status st = DYD_OK;
  *out = 0;
  for (size_t f = 0; f < dyd_delaunay_undecided_faces(pd) && st == DYD_OK; f++) {
    bool outer;
    st = dyd_delaunay_face(&sites, &outer, pd, f);
    if (st == DYD_OK && sites.count) *out += (uint64_t)sites.count * (sites.count - 1) / 2;
  }
  dyd_index_list_clear(&sites);
  return st;
}

/* Sites, pairs, witnesses and the graph, as the checker holds them; illegal pairs of faces, of which boxes leave so
 * many at most before they give up. */
static dyd_status certificate_grant(const dyd_delaunay *pd, dyd_error *err) {
  enum { SITE = 650, PAIR = 40, LEFT = 16, MOST_LEFT = 1 << 22 };
  if (!dyd_delaunay_is_bounded(pd)) return DYD_OK;
  uint64_t of_faces, pairs = dyd_pairs_bytes(pd, DYD_TIE) / sizeof(dyd_pair);
  dyd_status st = pairs_of_faces(&of_faces, pd);
  if (st != DYD_OK) return dyd_fail(err, st, "%s", dyd_status_text(st));
  uint64_t left = of_faces > pairs ? of_faces - pairs : 0, bytes = (left < MOST_LEFT ? left : MOST_LEFT) * LEFT;
  bytes = dyd_bytes_add(bytes, dyd_bytes_times(dyd_sites_count(dyd_delaunay_sites(pd)), SITE));
  return dyd_delaunay_grant(pd, dyd_bytes_add(bytes, dyd_bytes_times(pairs, PAIR)), "the certificate", err);
}

static dyd_status certificate_put(FILE *out, const subject *of, dyd_error *err) {
  dyd_proof p = {.engine = of->engine, .pd = dyd_engine_delaunay(of->engine)};
  dyd_status st = certificate_grant(p.pd, err);
  if (st != DYD_OK) return st;
  dyd_cert_sites_init(&p.sites);
  st = proof_gather(&p);
  if (st == DYD_OK) st = certificate_sections(out, &p, of);
  proof_clear(&p);
  return st == DYD_OK ? st : dyd_fail(err, st, "%s", dyd_status_text(st));
}

/* On a sphere, the certificate from a second eye as well. */
static dyd_status certificate_put_all(FILE *out, const subject *of, dyd_error *err) {
  const dyd_sphere *second = of->sphere ? dyd_proof_second(of->sphere) : NULL;
  dyd_status st = certificate_put(out, of, err);
  if (st == DYD_OK && second) {
    const subject again = {.engine = dyd_sphere_images(second), .parts = &no_parts, .sphere = second, .again = true};
    fputs("also\n", out);
    st = certificate_put_all(out, &again, err);
  }
  if (st == DYD_OK && of->sphere) fprintf(out, "outcome %s\n", dyd_outcome_text(dyd_sphere_proved_outcome(of->sphere)));
  if (st == DYD_OK) fputs("end\n", out);
  return st;
}

static dyd_status certificate_write(FILE *out, const subject *of, dyd_error *err) {
  dyd_status st = certificate_put_all(out, of, err);
  return st == DYD_OK ? dyd_output_end(out, err) : st;
}

/* Sets out to the window, or where NULL is given to the default one. */
static dyd_status certificate_window(dyd_rect *out, const dyd_delaunay *pd, const dyd_rect *given, dyd_error *err) {
  dyd_window w;
  dyd_status st = DYD_OK;
  if (given)
    dyd_rect_set(out, given);
  else
    st = dyd_voronoi_window(out, dyd_delaunay_sites(pd));
  if (st != DYD_OK) return dyd_fail(err, st, "the points span more than doubles hold; give a window");
  if (dyd_window_init(&w, out) == DYD_OK) return DYD_OK;
  return dyd_fail(err, DYD_E_ARG, "the window has to have positive area and dyadic ends");
}

/* ---- places ---- */

/* Sets *out to a bound; returns false if it is infinite. */
static bool near_bound_set(dyd_exact *out, double bound) {
  dyd_dyadic d;
  dyd_dyadic_init(&d);
  bool finite = dyd_dyadic_set_d(&d, bound) == DYD_OK;
  if (finite) dyd_proof_set(out, &d);
  dyd_dyadic_clear(&d);
  return finite;
}

static void put_near_bound(FILE *out, double bound) {
  dyd_exact x;
  dyd_exact_init(&x);
  bool finite = near_bound_set(&x, bound);
  dyd_proof_put(out, finite ? " %n" : " none", &x);
  dyd_exact_clear(&x);
}

/* Until the checker, which rounds rational ends outward, sees the distance between them. */
static void widen_near_bounds(double *lo, double *hi, const dyd_cert_site *place, const dyd_cert_site *site) {
  dyd_cert_span a, b;
  dyd_exact low, high;
  dyd_cert_span_init(&a);
  dyd_cert_span_init(&b);
  dyd_exact_init(&low);
  dyd_exact_init(&high);
  dyd_cert_span_set(&a, place);
  dyd_cert_span_set(&b, site);
  double step = *hi > 0 ? *hi * 0x1p-52 : 0x1p-1000;
  for (; near_bound_set(&low, *lo) && near_bound_set(&high, *hi); step *= 16) {
    if (dyd_cert_near_bounds_hold(&a, &b, &low, &high)) break;
    *lo = *lo > step ? *lo - step : 0;
    *hi += step;
  }
  dyd_exact_clear(&high);
  dyd_exact_clear(&low);
  dyd_cert_span_clear(&b);
  dyd_cert_span_clear(&a);
}

static dyd_status put_near_site(FILE *out, const dyd_proof *p, const dyd_rect *at, const dyd_cert_site *place,
                                uint32_t i, dyd_rect *scratch) {
  double lo, hi;
  dyd_status st = dyd_sites_get(scratch, dyd_delaunay_sites(p->pd), i);
  if (st != DYD_OK) return st;
  dyd_rect_distance(&lo, &hi, at, scratch);
  widen_near_bounds(&lo, &hi, place, &p->sites.site[i]);
  dyd_proof_put(out, " %i", i);
  put_near_bound(out, lo);
  put_near_bound(out, hi);
  return DYD_OK;
}

static dyd_status put_near_place(FILE *out, const dyd_proof *p, const dyd_nearest_answer *a, dyd_rect *scratch) {
  dyd_cert_sites at;
  dyd_cert_sites_init(&at);
  dyd_status st = dyd_proof_add_site(&at, a->at);
  if (st == DYD_OK) dyd_proof_put(out, a->sure ? "%s %s c" : "%s %s p", &at.site[0].side[0], &at.site[0].side[1]);
  for (size_t k = 0; k < a->found->count && st == DYD_OK; k++)
    st = put_near_site(out, p, a->at, &at.site[0], a->found->item[k], scratch);
  putc('\n', out);
  dyd_cert_sites_clear(&at);
  return st;
}

static dyd_status nearest_sections(FILE *out, dyd_proof *p, const dyd_nearest_answer *const *answer, size_t count,
                                   int outcome) {
  dyd_rect scratch;
  dyd_status st = proof_gather_sites(p);
  if (st != DYD_OK) return st;
  fprintf(out, "dyadel certificate 1\noutcome %s\ngoal nearest\ncapped no\n", dyd_outcome_text((dyd_outcome)outcome));
  certificate_sites(out, p);
  fprintf(out, "nearest %zu\n", count);
  dyd_rect_init(&scratch);
  for (size_t k = 0; k < count && st == DYD_OK; k++) st = put_near_place(out, p, answer[k], &scratch);
  dyd_rect_clear(&scratch);
  return st;
}

static dyd_status nearest_write(FILE *out, const dyd_engine *e, const dyd_certificate_parts *parts, dyd_error *err) {
  dyd_proof p = {.engine = e, .pd = dyd_engine_delaunay(e)};
  dyd_cert_sites_init(&p.sites);
  dyd_status st = nearest_sections(out, &p, parts->answer, parts->answers, parts->outcome);
  proof_clear(&p);
  if (st != DYD_OK) return dyd_fail(err, st, "%s", dyd_status_text(st));
  fputs("end\n", out);
  return dyd_output_end(out, err);
}

/* ---- all kinds ---- */

static bool needs_window(const dyd_engine *e) {
  dyd_goal goal = dyd_engine_goal(NULL, e);
  return dyd_engine_outcome(e) == DYD_OUTCOME_CERTIFIED &&
         (goal == DYD_GOAL_VORONOI_AREA || goal == DYD_GOAL_VORONOI_HAUSDORFF);
}

dyd_status dyd_write_certificate(FILE *out, const struct dyd_engine *e, const dyd_certificate_parts *given,
                                 dyd_error *err) {
  dyd_certificate_parts parts;
  dyd_rect window;
  if (err) dyd_error_clear(err);
  dyd_status st = dyd_abi_take(&parts, sizeof parts, given, "dyd_certificate_parts", err);
  if (st != DYD_OK) return st;
  if (parts.sphere) e = dyd_sphere_images(parts.sphere);
  const dyd_delaunay *pd = dyd_engine_delaunay(e);
  if (parts.graph && (parts.kind < DYD_GRAPH_NEAREST || parts.kind > DYD_GRAPH_MST))
    return dyd_fail(err, DYD_E_ARG, "the kind of the graph is no dyd_graph");
  if (!pd) return dyd_fail(err, DYD_E_ARG, "there is no result yet");
  if (parts.answer) return nearest_write(out, e, &parts, err);
  if (!parts.diagram && !parts.sphere && needs_window(e))
    return dyd_fail(err, DYD_E_ARG, "a goal on the diagram was reached; its certificate needs the window");
  dyd_rect_init(&window);
  if (parts.diagram) st = certificate_window(&window, pd, parts.window, err);
  const subject of = {.engine = e, .parts = &parts, .window = parts.diagram ? &window : NULL, .sphere = parts.sphere};
  if (st == DYD_OK) st = certificate_write(out, &of, err);
  dyd_rect_clear(&window);
  return st;
}
