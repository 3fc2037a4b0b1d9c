/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Writes certificates (proofs/certificates.md has the format).
 *
 * Everything that needs a proof is put before the checker's own tests first; a statement that they reject is written as
 * unproved. */
#include "base/abi.h"
#include "base/alloc.h"
#include "base/error.h"
#include "base/local.h"
#include "checker/bounds.h"
#include "delaunay/memory.h"
#include "io/output.h"
#include "prove/proof.h"
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

/* Legal pairs with a witness become edges; the others stay in the list of pairs only. */
static dyd_status proof_gather_legal(dyd_proof *p) {
  DYD_LOCAL(dyd_point, c);
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
  return st;
}

static dyd_status proof_gather(dyd_proof *p) {
  dyd_status st = dyd_proof_gather_sites(p);
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
  DYD_LOCAL(dyd_cert_bounds, b);
  b.hausdorff = &bound[1];
  for (size_t e = 0; e < p->legal.count; e++)
    dyd_cert_bounds_add(&b, &p->sites, p->legal.item[e].i, p->legal.item[e].j, true);
  for (size_t e = 0; e < p->open.count; e++)
    dyd_cert_bounds_add(&b, &p->sites, p->open.item[e].i, p->open.item[e].j, false);
  fits[0] = dyd_cert_bounds_area_holds(&b, &bound[0]);
  fits[1] = !b.exceeded;
}

/* Raises the bounds of rectangles that are stated rounded: by 2^-60 of each, by 16 times as much, and so on. */
static void bounds_raise(dyd_exact bound[2], const dyd_proof *p) {
  bool fits[2];
  DYD_LOCAL(dyd_exact, more);
  for (int64_t exp = -60; exp < 0 && (bounds_check(fits, p, bound), !fits[0] || !fits[1]); exp += 4)
    for (int k = 0; k < 2; k++) {
      if (fits[k]) continue;
      mpz_set_ui(more.man, 1);
      more.exp = dyd_exact_top(&bound[k]) + exp;
      dyd_exact_add(&bound[k], &bound[k], &more);
    }
}

static dyd_status certificate_end(FILE *out, const dyd_proof *p) {
  DYD_LOCAL_ARRAY(dyd_exact, bound, [2]);
  DYD_LOCAL(dyd_dyadic, area, hausdorff);
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
  dyd_proof_put_sites(out, p);
  certificate_edges(out, "legal", &p->legal, &p->witness);
  certificate_places(out, p);
  certificate_edges(out, "bridges", &p->bridges, &p->centre);
  certificate_corners(out, p);
  dyd_status st = dyd_proof_put_pairs(out, p);
  if (st == DYD_OK) st = certificate_end(out, p);
  if (st == DYD_OK) st = dyd_proof_put_ties(out, p);
  if (st == DYD_OK && parts->discs) st = dyd_proof_put_discs(out, p, parts->discs);
  if (st == DYD_OK && parts->graph) certificate_graph(out, parts->graph, parts->kind);
  if (st == DYD_OK && of->window) st = dyd_proof_put_diagram(out, p, of->window, parts->discs);
  if (st == DYD_OK && of->sphere) st = dyd_proof_put_globe(out, p, of->sphere, of->again);
  return st;
}

/* The pairs of sites of one undecided face each. */
static dyd_status pairs_of_faces(uint64_t *out, const dyd_delaunay *pd) {
  DYD_SCOPED(dyd_index_list) sites = {0};
  dyd_status st = DYD_OK;
  *out = 0;
  for (size_t f = 0; f < dyd_delaunay_undecided_faces(pd) && st == DYD_OK; f++) {
    bool outer;
    st = dyd_delaunay_face(&sites, &outer, pd, f);
    if (st == DYD_OK && sites.count) *out += (uint64_t)sites.count * (sites.count - 1) / 2;
  }
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
  if (parts.answer && parts.sphere) return dyd_proof_put_nearest(out, NULL, &parts, err);
  if (parts.sphere) e = dyd_sphere_images(parts.sphere);
  const dyd_delaunay *pd = dyd_engine_delaunay(e);
  if (parts.graph && (parts.kind < DYD_GRAPH_NEAREST || parts.kind > DYD_GRAPH_MST))
    return dyd_fail(err, DYD_E_ARG, "the kind of the graph is no dyd_graph");
  if (!pd) return dyd_fail(err, DYD_E_ARG, "there is no result yet");
  if (parts.answer) return dyd_proof_put_nearest(out, e, &parts, err);
  if (!parts.diagram && !parts.sphere && needs_window(e))
    return dyd_fail(err, DYD_E_ARG, "a goal on the diagram was reached; its certificate needs the window");
  dyd_rect_init(&window);
  if (parts.diagram) st = certificate_window(&window, pd, parts.window, err);
  const subject of = {.engine = e, .parts = &parts, .window = parts.diagram ? &window : NULL, .sphere = parts.sphere};
  if (st == DYD_OK) st = certificate_write(out, &of, err);
  dyd_rect_clear(&window);
  return st;
}
