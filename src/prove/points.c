/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Checks that a certificate is about these points [CERT-8].
 *
 * A proof about its rectangles holds for the points when these lie in them, site by site. A fixed point is a rectangle,
 * whose points are all meant: it has to be that of its site. Any other point is narrowed until it is seen where it
 * lies; one that is what the certificate describes, number by number, was seen there by the checker. */
#include "engine/points.h"
#include "base/abi.h"
#include "base/alloc.h"
#include "base/error.h"
#include "base/local.h"
#include "checker/checker.h"
#include "prove/proof.h"
#include "rect/rect.h"
#include "sphere/state.h"
#include "tolerance/discs.h"
#include "tolerance/lines.h"
#include <dyadel/io.h>

/* The question put to the engine. found[i]: point i lies in the rectangle of its site; wrong: one that does not. */
typedef struct location {
  dyd_rect *site; /* of the certificate */
  bool *found;
  size_t count, open;
  uint32_t wrong;
  const char *why;
} location;

static dyd_status location_wrong(location *l, uint32_t i, const char *why) {
  l->wrong = i;
  l->why = why;
  return DYD_OK;
}

/* Certificates state dyadic rectangles [CERT-8]. */
static dyd_status rect_round(dyd_rect *out, const dyd_sites *sites, size_t i) {
  dyd_status st = dyd_sites_get(out, sites, i);
  if (st == DYD_OK) st = dyd_interval_round(&out->x, &out->x);
  return st == DYD_OK ? dyd_interval_round(&out->y, &out->y) : st;
}

/* Examines point i as it is now. */
static dyd_status locate_point(location *l, const dyd_engine *e, dyd_rect *r, uint32_t i) {
  const dyd_refinable *p = dyd_engine_find(e, i);
  if (!dyd_engine_knows(e, i)) return DYD_OK;
  dyd_status st = rect_round(r, dyd_engine_sites(e), i);
  if (st != DYD_OK) return st;
  l->found[i] = dyd_rect_contains(&l->site[i], r);
  if (!p && !dyd_rect_equal(&l->site[i], r)) return location_wrong(l, i, "is not that of the point");
  if (l->found[i]) return DYD_OK;
  if (!dyd_rect_meets(&l->site[i], r)) return location_wrong(l, i, "does not hold the point");
  return p->final ? location_wrong(l, i, "is narrower than the point is known") : DYD_OK;
}

static dyd_status location_ask(bool *answered, dyd_wants *wants, void *user, const dyd_engine *e, dyd_error *err) {
  location *l = user;
  (void)err;
  DYD_LOCAL(dyd_rect, r);
  dyd_status st = DYD_OK;
  l->open = 0;
  for (uint32_t i = 0; i < l->count && st == DYD_OK && !l->why; i++) {
    if (l->found[i]) continue;
    st = locate_point(l, e, &r, i);
    if (st != DYD_OK || l->found[i] || l->why) continue;
    l->open++;
    st = dyd_wants_add(wants, i, DYD_BITS_NEXT);
  }
  *answered = l->open == 0 || l->why;
  return st;
}

/* ---- rectangles of the certificate ---- */

static dyd_status side_interval(dyd_interval *out, const dyd_cert_side *s) {
  DYD_LOCAL(dyd_dyadic, lo, hi);
  const dyd_exact *top = dyd_cert_high(s);
  dyd_status st = dyd_dyadic_set_z_2exp(&lo, s->lo.man, s->lo.exp);
  if (st == DYD_OK) st = dyd_dyadic_set_z_2exp(&hi, top->man, top->exp);
  if (st == DYD_OK && s->den) {
    DYD_LOCAL_NUMBERS(mpq, q);
    dyd_dyadic_get_q(q, &lo);
    mpz_mul(mpq_denref(q), mpq_denref(q), *s->den);
    mpq_canonicalize(q);
    st = dyd_interval_set_q(out, q);
  } else if (st == DYD_OK) {
    st = dyd_interval_set_ends(out, &lo, &hi);
  }
  return st;
}

static void location_clear(location *l) {
  for (size_t i = 0; l->site && i < l->count; i++) dyd_rect_clear(&l->site[i]);
  dyd_free_all(l->site, l->found);
}

static dyd_status location_init(location *l, const dyd_cert_sites *s) {
  *l = (location){.count = s->count, .site = dyd_alloc(s->count, sizeof *l->site)};
  l->found = calloc(s->count ? s->count : 1, sizeof *l->found);
  dyd_status st = l->site && l->found ? DYD_OK : DYD_E_NOMEM;
  for (size_t i = 0; l->site && i < s->count; i++) dyd_rect_init(&l->site[i]);
  for (size_t i = 0; st == DYD_OK && i < s->count; i++) {
    st = side_interval(&l->site[i].x, &s->site[i].side[0]);
    if (st == DYD_OK) st = side_interval(&l->site[i].y, &s->site[i].side[1]);
  }
  return st;
}

/* ---- discs of the certificate ---- */

/* A disc that holds the rectangle of a site: the sum of the half-widths is at least half of a diagonal. */
static dyd_status disc_around_site(dyd_disc *out, const dyd_sites *s, size_t i) {
  DYD_LOCAL_NUMBERS(mpq, width);
  DYD_LOCAL(dyd_rect, r);
  dyd_status st = dyd_sites_get(&r, s, i);
  if (st == DYD_OK) {
    dyd_side_sum(out->x, out->r, &r.x);
    dyd_side_sum(out->y, width, &r.y);
    mpq_add(out->r, out->r, width);
    mpq_ptr all[3] = {out->x, out->y, out->r};
    for (int k = 0; k < 3; k++) mpq_div_2exp(all[k], all[k], 1);
  }
  return st;
}

/* Returns true if the disc of the certificate holds that of the point. */
static bool disc_holds_point(const dyd_cert_disc *d, const dyd_disc *own) {
  DYD_LOCAL(dyd_disc, held);
  dyd_cert_exact_to_q(held.x, &d->x, NULL);
  dyd_cert_exact_to_q(held.y, &d->y, NULL);
  dyd_cert_exact_to_q(held.r, &d->r, NULL);
  return mpq_cmp(own->r, held.r) <= 0 && dyd_disc_is_within(own, &held);
}

/* Adds to the report the points that are not seen to lie in their discs. A fixed one does or does not. */
static dyd_status locate_in_discs(location *l, dyd_checker *c, const dyd_engine *e, bool discs) {
  const dyd_sites *sites = dyd_engine_sites(e);
  dyd_status st = DYD_OK;
  DYD_LOCAL(dyd_disc, d);
  for (uint32_t i = 0; c->disc && i < l->count && st == DYD_OK; i++) {
    st = (discs ? dyd_disc_of_site : disc_around_site)(&d, sites, i);
    const bool square = st != DYD_E_ARG;
    if (square && st != DYD_OK) break;
    st = DYD_OK;
    if (square && disc_holds_point(&c->disc[c->sites.site[i].alias], &d)) continue;
    if (discs && !dyd_engine_find(e, i))
      location_wrong(l, i, square ? "has a disc that does not hold that of the point" : "is that of no disc");
    c->report.undescribed++;
  }
  return st;
}

/* ---- all ---- */

/* still[i]: no call narrows point i any more, and its site is as narrow. */
static dyd_status list_still(bool *still, const location *l, const dyd_engine *e) {
  DYD_LOCAL(dyd_rect, r);
  dyd_status st = DYD_OK;
  for (uint32_t i = 0; i < l->count && st == DYD_OK; i++) {
    const dyd_refinable *p = dyd_engine_find(e, i);
    st = rect_round(&r, dyd_engine_sites(e), i);
    still[i] = (!p || p->final) && dyd_rect_equal(&l->site[i], &r);
  }
  return st;
}

static dyd_status write_still(FILE *out, const bool *still, size_t count, dyd_error *err) {
  for (size_t i = 0; i < count; i++)
    if (still[i]) fprintf(out, "%zu\n", i);
  return fflush(out) || ferror(out) ? dyd_fail(err, DYD_E_IO, "the sites that stay cannot be written") : DYD_OK;
}

/* The same of the images of places. */
static dyd_status write_still_images(FILE *out, const bool *still, const dyd_checker *c) {
  DYD_FREED bool *image = dyd_alloc(c->sites.count, sizeof *image);
  if (!image) return DYD_E_NOMEM;
  dyd_checker_still_images(image, c, still);
  return write_still(out, image, c->sites.count, c->in.err);
}

static dyd_status location_settle(dyd_checker *c, FILE *out, const location *l, const dyd_engine *e) {
  if (l->why) return dyd_fail(c->in.err, DYD_E_PARSE, "the rectangle of site %u %s", (unsigned)l->wrong, l->why);
  DYD_FREED bool *still = dyd_alloc(l->count, sizeof *still);
  if (!still) return DYD_E_NOMEM;
  dyd_status st = list_still(still, l, e);
  c->report.bound = true;
  c->report.unlocated = l->open;
  if (l->open || c->report.undescribed) c->report.gaps |= DYD_GAP_POINTS;
  if (st == DYD_OK) st = dyd_checker_settle(c, still);
  if (st == DYD_OK && out && !c->globe.stated) st = write_still(out, still, l->count, c->in.err);
  if (st == DYD_OK && out && c->globe.stated) st = write_still_images(out, still, c);
  return st;
}

/* ---- on a sphere ---- */

/* Checks that the radius of all points is that of the certificate. */
static dyd_status compare_radius(const dyd_checker *c, const dyd_sphere_options *o) {
  mpq_t radius;
  bool ground = false;
  mpq_init(radius);
  dyd_status st = dyd_sphere_radius(radius, &ground, o, c->in.err);
  bool same = mpq_equal(radius, c->globe.radius) && (!mpq_sgn(radius) || ground == c->globe.ground);
  mpq_clear(radius);
  if (st != DYD_OK || same) return st;
  return dyd_fail(c->in.err, DYD_E_PARSE, "the radius of the points is not the one that it states");
}

/* And that of each? */
static dyd_status compare_metres(const dyd_checker *c, const dyd_engine *e) {
  uint32_t i = 0;
  bool same = true;
  DYD_LOCAL_NUMBERS(mpq, given, stated);
  for (; i < c->globe.place.count && same; i++) {
    mpq_set_d(given, dyd_engine_number(e, i, DYD_ROW_RADIUS));
    dyd_cert_exact_to_q(stated, &c->globe.metres[i], NULL);
    same = mpq_equal(given, stated);
  }
  if (same) return DYD_OK;
  return dyd_fail(c->in.err, DYD_E_PARSE, "the radius of point %u is not the one that it states", (unsigned)(i - 1));
}

static dyd_status compare_sphere(const dyd_checker *c, const dyd_engine *e, const dyd_sphere_options *sphere) {
  if (!sphere != !c->globe.stated)
    return dyd_fail(c->in.err, DYD_E_DOMAIN, "the certificate is about points %s, and these are not",
                    sphere ? "of a plane" : "on a sphere");
  if (!sphere) return DYD_OK;
  dyd_status st = compare_radius(c, sphere);
  return st == DYD_OK ? compare_metres(c, e) : st;
}

static dyd_status checker_locate(dyd_checker *c, bool discs, FILE *still, dyd_engine *e,
                                 const dyd_sphere_options *sphere, const dyd_engine_options *options) {
  location l;
  dyd_outcome outcome;
  const dyd_question question = {DYD_SIZED(dyd_question), .ask = location_ask, .user = &l};
  const dyd_cert_sites *about = c->globe.stated ? &c->globe.place : &c->sites;
  if (dyd_engine_count(e) != about->count)
    return dyd_fail(c->in.err, DYD_E_PARSE, "it has %zu sites, and there are %zu points", about->count,
                    (size_t)dyd_engine_count(e));
  dyd_status st = compare_sphere(c, e, sphere);
  if (st == DYD_OK) st = location_init(&l, about);
  if (st == DYD_E_NOMEM) return dyd_fail_nomem(c->in.err);
  if (st != DYD_OK) return st;
  st = dyd_proof_compare_points(l.found, &c->report.undescribed, &c->ties, e);
  if (st == DYD_OK) st = dyd_engine_ask(&outcome, e, &question, options, c->in.err);
  if (st == DYD_OK && outcome == DYD_OUTCOME_CANCELLED) st = DYD_CANCELLED;
  /* again: some are known to be exact only now */
  if (st == DYD_OK) st = dyd_proof_compare_points(l.found, &c->report.undescribed, &c->ties, e);
  if (st == DYD_OK && !l.why) st = locate_in_discs(&l, c, e, discs);
  if (st == DYD_OK) st = location_settle(c, still, &l, e);
  location_clear(&l);
  return st == DYD_E_NOMEM ? dyd_fail_nomem(c->in.err) : st;
}

dyd_status dyd_verify_certificate(dyd_certificate_report *out, FILE *in, const dyd_verify_options *about,
                                  dyd_error *err) {
  dyd_error unused;
  dyd_verify_options o;
  dyd_sphere_options sphere;
  if (!err) err = &unused;
  dyd_error_clear(err);
  if (dyd_abi_check(out, 0, "dyd_certificate_report", err) != DYD_OK) return DYD_E_ARG;
  if (dyd_abi_take(&o, sizeof o, about, "dyd_verify_options", err) != DYD_OK) return DYD_E_ARG;
  if (!o.engine) return dyd_checker_verify(out, in, err);
  if (dyd_abi_take(&sphere, sizeof sphere, o.sphere, "dyd_sphere_options", err) != DYD_OK) return DYD_E_ARG;
  DYD_SCOPED(dyd_checker) c;
  dyd_checker_init(&c, in, err);
  dyd_status st = dyd_checker_run(&c);
  if (st == DYD_OK) st = checker_locate(&c, o.discs, o.still, o.engine, o.sphere ? &sphere : NULL, o.options);
  if (st == DYD_OK) dyd_abi_give(out, &c.report, sizeof c.report);
  return st;
}
