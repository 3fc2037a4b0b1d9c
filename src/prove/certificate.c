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
#include <dyadel/tolerance.h>

#include <inttypes.h>
#include <math.h>

/* ---- points on a globe ---- */

static dyd_status put_interval(FILE *out, const dyd_interval *a) {
  DYD_LOCAL(dyd_cert_sites, one);
  dyd_cert_site *site = dyd_cert_sites_add(&one);
  dyd_status st = site ? dyd_proof_set_side(&site->side[0], a) : DYD_E_NOMEM;
  if (st == DYD_OK) dyd_proof_put(out, "%s", &site->side[0]);
  return st;
}

static dyd_status put_rational(FILE *out, mpq_srcptr q) {
  DYD_LOCAL(dyd_interval, a);
  dyd_status st = dyd_interval_set_q(&a, q);
  return st == DYD_OK ? put_interval(out, &a) : st;
}

static dyd_status put_metres(FILE *out, double metres) {
  if (!(metres > 0)) return DYD_OK;
  DYD_LOCAL_NUMBERS(mpq, q);
  mpq_set_d(q, metres);
  putc(' ', out);
  return put_rational(out, q);
}

static dyd_status put_eye(FILE *out, const dyd_sphere *s) {
  if (!s->free && s->count) {
    dyd_proof_put(out, "eye %i\n", s->centre);
    return DYD_OK;
  }
  fputs("eye gap ", out);
  dyd_status st = put_rational(out, s->eye.spot.mid[0]);
  putc(' ', out);
  if (st == DYD_OK) st = put_rational(out, s->eye.spot.mid[1]);
  putc('\n', out);
  return st;
}

static dyd_status put_radius(FILE *out, const dyd_sphere *s) {
  mpq_t radius;
  bool ground = mpq_sgn(s->angle) != 0;
  if (!ground && !mpq_sgn(s->degrees)) {
    fputs("radius none\n", out);
    return DYD_OK;
  }
  mpq_init(radius);
  mpq_set(radius, s->degrees);
  if (ground) mpq_div(radius, s->angle, s->metre);
  fputs(ground ? "radius metres " : "radius degrees ", out);
  dyd_status st = put_rational(out, radius);
  putc('\n', out);
  mpq_clear(radius);
  return st;
}

/* The same places from a second eye; NULL: it has no result. */
static const struct dyd_sphere *proof_second(const struct dyd_sphere *s) {
  return !s->free && s->second && dyd_engine_delaunay(s->second->images) ? s->second : NULL;
}

/* Each eye has streams of its own: the rectangle stated lies in those of both. */
static dyd_status place_narrowest(dyd_rect *out, const dyd_sphere *s, uint32_t i) {
  dyd_status st = dyd_sphere_stated(out, s, i);
  if (st != DYD_OK || !proof_second(s)) return st;
  DYD_LOCAL(dyd_rect, other);
  st = dyd_sphere_stated(&other, s->second, i);
  if (st == DYD_OK) st = dyd_interval_intersect(&out->x, &out->x, &other.x);
  return st == DYD_OK ? dyd_interval_intersect(&out->y, &out->y, &other.y) : st;
}

static dyd_status put_stated_place(FILE *out, const dyd_sphere *s, uint32_t i, dyd_rect *r) {
  dyd_status st = place_narrowest(r, s, i);
  if (st == DYD_OK) st = put_interval(out, &r->x);
  putc(' ', out);
  if (st == DYD_OK) st = put_interval(out, &r->y);
  if (st == DYD_OK) st = put_metres(out, dyd_engine_number(s->places, i, DYD_ROW_RADIUS));
  if (s->alias[i] != i) dyd_proof_put(out, " = %i", s->alias[i]);
  putc('\n', out);
  return st;
}

static dyd_status put_places(FILE *out, const dyd_sphere *s) {
  DYD_LOCAL(dyd_rect, r);
  dyd_status st = DYD_OK;
  fprintf(out, "places %zu\n", s->count);
  for (uint32_t i = 0; i < s->count && st == DYD_OK; i++) st = put_stated_place(out, s, i, &r);
  return st;
}

/* kind[k]: of image k and the eye, as a letter of the list; 0: no neighbour. */
static dyd_status find_kinds(char *kind, const dyd_sphere *s) {
  static const char letter[] = {[DYD_TIE] = 't', [DYD_INDETERMINATE] = 'o', [DYD_LEGAL] = 'l'};
  DYD_FREED dyd_pair_status *status = dyd_alloc(s->with_image, sizeof *status);
  dyd_status st = status ? dyd_sphere_about_centre(status, s) : DYD_E_NOMEM;
  for (size_t k = 0; k < s->with_image && st == DYD_OK; k++)
    kind[k] = status[k] == DYD_ILLEGAL ? '\0' : s->free ? 'o' : letter[status[k]];
  return st;
}

static bool is_among_corners(const dyd_proof *p, uint32_t k) {
  for (size_t q = 0; q < p->corners; q++)
    if (p->corner[q].i == k) return true;
  return false;
}

/* A corner of the hull that is not listed as one, with a direction, all sites being those of the list. */
static void put_direction(FILE *out, const dyd_proof *p, uint32_t k, const uint32_t *all, size_t count) {
  if (p->sites.count <= 2 || is_among_corners(p, k)) return;
  DYD_LOCAL_ARRAY(dyd_exact, u, [2]);
  if (dyd_proof_find_direction(u, p, k, all, count)) dyd_proof_put(out, " %p", u);
}

static void put_neighbour(FILE *out, const dyd_proof *p, char kind, uint32_t k, const uint32_t *all, size_t count) {
  if (!kind) return;
  fprintf(out, "%c %" PRIu32, kind, k);
  if (kind == 'l') put_direction(out, p, k, all, count);
  putc('\n', out);
}

static dyd_status put_neighbours(FILE *out, const dyd_proof *p, const dyd_sphere *s) {
  DYD_FREED char *kind = dyd_alloc(s->with_image, sizeof *kind);
  DYD_FREED uint32_t *all = dyd_alloc(s->with_image, sizeof *all);
  dyd_status st = kind && all ? find_kinds(kind, s) : DYD_E_NOMEM;
  size_t count = 0, sites = 0;
  for (uint32_t k = 0; k < s->with_image && st == DYD_OK; k++) {
    count += kind[k] != 0;
    if (p->sites.site[k].alias == k) all[sites++] = k;
  }
  if (st == DYD_OK) fprintf(out, "neighbours %zu\n", count);
  for (uint32_t k = 0; k < s->with_image && st == DYD_OK; k++) put_neighbour(out, p, kind[k], k, all, sites);
  return st;
}

/* Writes the lines on radii and places. */
static dyd_status proof_put_compass(FILE *out, const struct dyd_sphere *s) {
  dyd_status st = put_radius(out, s);
  return st == DYD_OK ? put_places(out, s) : st;
}

/* Sets the region where the certificate says that place i is. */
static dyd_status proof_set_region(dyd_cert_region *out, const struct dyd_sphere *s, uint32_t i) {
  DYD_LOCAL(dyd_cert_sites, one);
  DYD_LOCAL(dyd_rect, r);
  DYD_LOCAL_NUMBERS(mpq, angle);
  dyd_cert_site *site = dyd_cert_sites_add(&one);
  dyd_status st = site ? place_narrowest(&r, s, i) : DYD_E_NOMEM;
  if (st == DYD_OK) st = dyd_proof_set_side(&site->side[0], &r.x);
  if (st == DYD_OK) st = dyd_proof_set_side(&site->side[1], &r.y);
  mpq_set_d(angle, fmax(0, dyd_engine_number(s->places, i, DYD_ROW_RADIUS)));
  mpq_mul(angle, angle, s->metre);
  mpq_add(angle, angle, s->angle);
  if (st == DYD_OK && !dyd_cert_region_set(out, site->side, s->degrees, angle)) st = DYD_E_DOMAIN;
  return st;
}

/* Writes the section on a sphere, of whose images the sites are. again: the places are those of a section before. */
static dyd_status proof_put_globe(FILE *out, const dyd_proof *p, const struct dyd_sphere *s, bool again) {
  fputs("sphere\n", out);
  dyd_status st = put_eye(out, s);
  if (st == DYD_OK && !again) st = proof_put_compass(out, s);
  return st == DYD_OK ? put_neighbours(out, p, s) : st;
}

/* ---- the sites nearest to a place: in the plane, of discs, on a sphere [CERT-12] ---- */

/* A certificate being written. at, here, place: of the answer at hand. On a sphere the compass replaces the sites. */
typedef struct near_proof {
  FILE *out;
  dyd_proof p;
  const dyd_sphere *sphere;
  dyd_cert_disc *disc; /* NULL: rectangles */
  bool fixed;
  dyd_cert_span *span, at;
  dyd_cert_compass compass;
  dyd_cert_region here;
  dyd_cert_sites place;
} near_proof;

/* ---- sites and places ---- */

static void near_proof_init(near_proof *w, FILE *out, const dyd_engine *e, const dyd_sphere *sphere) {
  *w = (near_proof){.out = out, .sphere = sphere, .p = {.engine = e, .pd = e ? dyd_engine_delaunay(e) : NULL}};
  dyd_cert_sites_init(&w->p.sites);
  dyd_cert_sites_init(&w->place);
  dyd_cert_span_init(&w->at);
  dyd_cert_region_init(&w->here);
}

static void near_proof_clear(near_proof *w) {
  dyd_cert_spans_free(w->span, w->p.sites.count);
  dyd_proof_free_discs(w->disc, &w->p);
  dyd_cert_compass_clear(&w->compass);
  dyd_cert_region_clear(&w->here);
  dyd_cert_span_clear(&w->at);
  dyd_cert_sites_clear(&w->place);
  dyd_cert_sites_clear(&w->p.sites);
  dyd_cert_tree_clear(&w->p.tree);
}

static dyd_status near_gather(near_proof *w, bool discs) {
  dyd_status st = DYD_OK;
  if (!w->sphere) {
    st = dyd_proof_gather_sites(&w->p);
    if (st == DYD_OK && discs) st = dyd_proof_gather_discs(&w->disc, &w->fixed, &w->p);
    return st == DYD_OK ? dyd_cert_spans_init(&w->span, &w->p.sites) : st;
  }
  st = dyd_cert_compass_init(&w->compass, w->sphere->count);
  for (uint32_t i = 0; st == DYD_OK && i < w->compass.count; i++) {
    st = proof_set_region(&w->compass.region[i], w->sphere, i);
    if (st == DYD_OK) dyd_cert_compass_note(&w->compass, i, w->sphere->alias[i] != i);
  }
  return st;
}

static dyd_status near_set_place(near_proof *w, const dyd_nearest_answer *a) {
  dyd_cert_sites_clear(&w->place);
  dyd_cert_sites_init(&w->place);
  dyd_status st = dyd_proof_add_site(&w->place, a->at);
  if (st != DYD_OK) return st;
  dyd_cert_span_set(&w->at, w->place.site);
  if (!w->sphere) return DYD_OK;
  DYD_LOCAL_NUMBERS(mpq, none);
  if (!dyd_cert_region_set(&w->here, w->place.site->side, none, none)) st = DYD_E_DOMAIN;
  return st;
}

/* Does the checker see that the answer is certain? Ends that are rational but not dyadic are stated rounded. */
static bool near_is_proved(const near_proof *w, const dyd_nearest_answer *a) {
  uint32_t other;
  const dyd_cert_near q = {&w->p.sites, &w->p.tree,    w->span,        w->disc,
                           &w->at,      DYD_CERT_NONE, a->found->item, a->found->count};
  if (!a->sure) return false;
  return w->sphere ? dyd_cert_compass_is_certain(&other, &w->compass, &w->here, *a->found->item)
                   : dyd_cert_near_is_certain(&other, &q);
}

/* ---- bounds ---- */

/* Sets *out to a bound; returns false if it is infinite. */
static bool near_bound_set(dyd_exact *out, double bound) {
  DYD_LOCAL(dyd_dyadic, d);
  bool finite = dyd_dyadic_set_d(&d, bound) == DYD_OK;
  if (finite) dyd_proof_set(out, &d);
  return finite;
}

static bool near_bounds_pass(const near_proof *w, uint32_t i, const dyd_exact *lo, const dyd_exact *hi) {
  if (w->sphere) return dyd_cert_ground_bounds_hold(&w->here, &w->compass.region[i], lo, hi);
  return dyd_cert_near_bounds_hold(&w->at, &w->span[i], w->disc ? &w->disc[i] : NULL, lo, hi);
}

/* Writes bounds that the checker sees to hold: each as it is, or, where it does not, wider. */
static void put_near_bounds(near_proof *w, uint32_t i, double lo, double hi) {
  DYD_LOCAL_ARRAY(dyd_exact, bound, [2]);
  const double least = w->sphere ? 0x1p-60 : 0x1p-1000;
  /* of boxes of degrees the checker looks at parts */
  const bool boxed = w->sphere && (mpq_sgn(w->here.half[1]) || mpq_sgn(w->compass.region[i].half[1]));
  double step = fmax(hi * (boxed ? 0x1p-20 : 0x1p-52), least);
  for (double by = step; near_bound_set(&bound[0], lo) && !near_bounds_pass(w, i, &bound[0], NULL); by *= 16)
    lo = lo > by ? lo - by : 0;
  dyd_proof_put(w->out, " %i %n", i, &bound[0]);
  mpz_set_ui(bound[0].man, 0);
  bool finite = near_bound_set(&bound[1], hi);
  for (double by = step; finite && !near_bounds_pass(w, i, &bound[0], &bound[1]); by *= 16)
    finite = near_bound_set(&bound[1], hi += by);
  dyd_proof_put(w->out, finite ? " %n" : " none", &bound[1]);
}

static dyd_status put_near_site(near_proof *w, const dyd_nearest_answer *a, uint32_t i) {
  double lo = 0, hi = 0;
  dyd_status st = DYD_OK;
  DYD_LOCAL(dyd_rect, r);
  if (w->sphere) {
    st = dyd_sphere_distance(&lo, &hi, w->sphere, i, a->at);
  } else if (w->disc) {
    st = dyd_disc_distance(&lo, &hi, dyd_delaunay_sites(w->p.pd), i, a->at);
  } else {
    st = dyd_sites_get(&r, dyd_delaunay_sites(w->p.pd), i);
    if (st == DYD_OK) dyd_rect_distance(&lo, &hi, a->at, &r);
  }
  if (st == DYD_OK) put_near_bounds(w, i, lo, hi);
  return st;
}

/* ---- writing ---- */

static dyd_status put_near_place(near_proof *w, const dyd_nearest_answer *a, bool proved) {
  dyd_status st = near_set_place(w, a);
  if (st != DYD_OK) return st;
  const dyd_cert_side *side = w->place.site->side;
  dyd_proof_put(w->out, proved ? "%s %s c" : "%s %s p", &side[0], &side[1]);
  for (size_t k = 0; k < a->found->count && st == DYD_OK; k++) st = put_near_site(w, a, a->found->item[k]);
  putc('\n', w->out);
  return st;
}

static dyd_status put_before_places(near_proof *w) {
  if (w->sphere) {
    fputs("sites 0\nsphere\n", w->out);
    return proof_put_compass(w->out, w->sphere);
  }
  dyd_proof_put_sites(w->out, &w->p);
  if (w->disc) dyd_proof_put_disc_lines(w->out, w->disc, w->fixed, &w->p);
  return DYD_OK;
}

/* An outcome that needs more than is proved becomes "budget". */
static dyd_status put_near_answers(near_proof *w, const dyd_certificate_parts *parts, bool *proved) {
  dyd_outcome outcome = (dyd_outcome)parts->outcome;
  dyd_status st = near_gather(w, parts->answers && parts->answer[0]->discs);
  for (size_t k = 0; k < parts->answers && st == DYD_OK; k++) {
    st = near_set_place(w, parts->answer[k]);
    proved[k] = st == DYD_OK && near_is_proved(w, parts->answer[k]);
    if (parts->answer[k]->sure && !proved[k] && outcome == DYD_OUTCOME_DECIDED) outcome = DYD_OUTCOME_BUDGET;
  }
  if (st != DYD_OK) return st;
  fprintf(w->out, "dyadel certificate 1\noutcome %s\ngoal nearest\ncapped no\n", dyd_outcome_text(outcome));
  st = put_before_places(w);
  fprintf(w->out, "nearest %zu\n", parts->answers);
  for (size_t k = 0; k < parts->answers && st == DYD_OK; k++) st = put_near_place(w, parts->answer[k], proved[k]);
  return st;
}

/* Writes a certificate of answers, as dyd_write_certificate; e: NULL: on a sphere. */
static dyd_status proof_put_nearest(FILE *out, const dyd_engine *e, const struct dyd_certificate_parts *parts,
                                    dyd_error *err) {
  DYD_SCOPED(near_proof) w;
  DYD_FREED bool *proved = dyd_alloc(parts->answers, sizeof *proved);
  near_proof_init(&w, out, e, parts->sphere);
  dyd_status st = proved ? put_near_answers(&w, parts, proved) : DYD_E_NOMEM;
  if (st != DYD_OK) return dyd_fail(err, st, "%s", dyd_status_text(st));
  fputs("end\n", out);
  return dyd_output_end(out, err);
}

/* ---- a whole certificate ---- */

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
  if (st == DYD_OK && of->sphere) st = proof_put_globe(out, p, of->sphere, of->again);
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
  const dyd_sphere *second = of->sphere ? proof_second(of->sphere) : NULL;
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
  if (parts.answer && parts.sphere) return proof_put_nearest(out, NULL, &parts, err);
  if (parts.sphere) e = dyd_sphere_images(parts.sphere);
  const dyd_delaunay *pd = dyd_engine_delaunay(e);
  if (parts.graph && (parts.kind < DYD_GRAPH_NEAREST || parts.kind > DYD_GRAPH_MST))
    return dyd_fail(err, DYD_E_ARG, "the kind of the graph is no dyd_graph");
  if (!pd) return dyd_fail(err, DYD_E_ARG, "there is no result yet");
  if (parts.answer) return proof_put_nearest(out, e, &parts, err);
  if (!parts.diagram && !parts.sphere && needs_window(e))
    return dyd_fail(err, DYD_E_ARG, "a goal on the diagram was reached; its certificate needs the window");
  dyd_rect_init(&window);
  if (parts.diagram) st = certificate_window(&window, pd, parts.window, err);
  const subject of = {.engine = e, .parts = &parts, .window = parts.diagram ? &window : NULL, .sphere = parts.sphere};
  if (st == DYD_OK) st = certificate_write(out, &of, err);
  dyd_rect_clear(&window);
  return st;
}
