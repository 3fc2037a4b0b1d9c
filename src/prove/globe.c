/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The section of a certificate on a sphere: places, radii, the eye, its possible neighbours. */
#include "base/alloc.h"
#include "base/local.h"
#include "prove/proof.h"
#include "rect/rect.h"
#include "sphere/state.h"
#include <dyadel/io.h>
#include <inttypes.h>
#include <math.h>

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

/* Each eye has streams of its own: the rectangle stated lies in those of both. */
static dyd_status place_narrowest(dyd_rect *out, const dyd_sphere *s, uint32_t i) {
  dyd_status st = dyd_sphere_stated(out, s, i);
  if (st != DYD_OK || !dyd_proof_second(s)) return st;
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

dyd_status dyd_proof_put_compass(FILE *out, const struct dyd_sphere *s) {
  dyd_status st = put_radius(out, s);
  return st == DYD_OK ? put_places(out, s) : st;
}

dyd_status dyd_proof_set_region(dyd_cert_region *out, const struct dyd_sphere *s, uint32_t i) {
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

const struct dyd_sphere *dyd_proof_second(const struct dyd_sphere *s) {
  return !s->free && s->second && dyd_engine_delaunay(s->second->images) ? s->second : NULL;
}

dyd_status dyd_proof_put_globe(FILE *out, const dyd_proof *p, const struct dyd_sphere *s, bool again) {
  fputs("sphere\n", out);
  dyd_status st = put_eye(out, s);
  if (st == DYD_OK && !again) st = dyd_proof_put_compass(out, s);
  return st == DYD_OK ? put_neighbours(out, p, s) : st;
}
