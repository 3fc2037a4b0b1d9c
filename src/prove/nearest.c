/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Certificates of nearest sites: in the plane, of discs, on a sphere [CERT-12]. */
#include "base/alloc.h"
#include "base/error.h"
#include "base/local.h"
#include "checker/near.h"
#include "io/output.h"
#include "prove/proof.h"
#include "rect/rect.h"
#include "sphere/state.h"
#include <dyadel/certificate.h>
#include <dyadel/io.h>
#include <dyadel/sphere.h>
#include <dyadel/tolerance.h>
#include <math.h>

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
    st = dyd_proof_set_region(&w->compass.region[i], w->sphere, i);
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
    return dyd_proof_put_compass(w->out, w->sphere);
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

dyd_status dyd_proof_put_nearest(FILE *out, const dyd_engine *e, const struct dyd_certificate_parts *parts,
                                 dyd_error *err) {
  DYD_SCOPED(near_proof) w;
  DYD_FREED bool *proved = dyd_alloc(parts->answers, sizeof *proved);
  near_proof_init(&w, out, e, parts->sphere);
  dyd_status st = proved ? put_near_answers(&w, parts, proved) : DYD_E_NOMEM;
  if (st != DYD_OK) return dyd_fail(err, st, "%s", dyd_status_text(st));
  fputs("end\n", out);
  return dyd_output_end(out, err);
}
