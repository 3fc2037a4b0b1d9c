/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Sites and witnesses in the form that the checker of certificates takes; witnesses shortened; numbers as they are
 * written. */
#include "base/alloc.h"
#include "base/local.h"
#include "checker/region.h"
#include "prove/proof.h"
#include "rect/rect.h"
#include "tolerance/discs.h"
#include <inttypes.h>
#include <stdarg.h>

void dyd_proof_set(dyd_exact *out, const dyd_dyadic *x) {
  mpz_set(out->man, x->man);
  out->exp = x->exp;
}

dyd_status dyd_proof_set_side(dyd_cert_side *out, const dyd_interval *a) {
  DYD_LOCAL(dyd_interval, held);
  dyd_status st = dyd_interval_round(&held, a);
  dyd_proof_set(&out->lo, &held.lo);
  out->point = dyd_interval_is_point(&held);
  if (!out->point) dyd_proof_set(&out->hi, &held.hi);
  if (st == DYD_OK && mpz_cmp_ui(held.den, 1)) st = dyd_cert_side_set_den(out, held.den);
  return st;
}

dyd_status dyd_proof_add_site(dyd_cert_sites *out, const dyd_rect *r) {
  dyd_cert_site *site = dyd_cert_sites_add(out);
  if (!site) return DYD_E_NOMEM;
  dyd_status st = dyd_proof_set_side(&site->side[0], &r->x);
  return st == DYD_OK ? dyd_proof_set_side(&site->side[1], &r->y) : st;
}

void dyd_proof_init(dyd_exact *x, size_t count) {
  for (size_t k = 0; k < count; k++) dyd_exact_init(&x[k]);
}

void dyd_proof_clear(dyd_exact *x, size_t count) {
  for (size_t k = 0; k < count; k++) dyd_exact_clear(&x[k]);
}

void dyd_proof_points_clear(dyd_proof_points *p) {
  for (size_t q = 0; q < p->count; q++) dyd_proof_clear(p->item[q], 2);
  free(p->item);
  *p = (dyd_proof_points){0};
}

void dyd_proof_trim(dyd_exact *x) {
  if (!mpz_sgn(x->man)) {
    x->exp = 0;
    return;
  }
  mp_bitcnt_t zeros = mpz_scan1(x->man, 0);
  mpz_tdiv_q_2exp(x->man, x->man, zeros);
  x->exp += (int64_t)zeros;
}

void dyd_proof_round(dyd_exact *out, const dyd_exact *x, int64_t exp) {
  dyd_exact_set(out, x);
  if (x->exp >= exp) return;
  DYD_LOCAL_NUMBERS(mpz, half);
  mpz_set_ui(half, 1);
  mpz_mul_2exp(half, half, (mp_bitcnt_t)(exp - x->exp - 1));
  mpz_add(half, half, x->man);
  mpz_fdiv_q_2exp(out->man, half, (mp_bitcnt_t)(exp - x->exp));
  out->exp = exp;
  dyd_proof_trim(out);
}

/* A power of two about the distance of c from the lower left corner of the site. */
static int64_t size_of_distance(const dyd_exact c[2], const dyd_cert_site *s) {
  DYD_LOCAL(dyd_exact, d);
  int64_t top = INT64_MIN;
  for (int a = 0; a < 2; a++) {
    mpz_srcptr den;
    const dyd_exact *at = dyd_cert_place(&den, s, a);
    dyd_exact_floor(d.man, at, den, at->exp - 64);
    d.exp = at->exp - 64;
    dyd_exact_sub(&d, &c[a], &d);
    if (dyd_exact_top(&d) > top) top = dyd_exact_top(&d);
  }
  return top;
}

/* Multiples of ever smaller powers of two, from a size like the distance on, until one is a witness. */
static bool shorten_witness(dyd_exact out[2], const dyd_proof *p, uint32_t i, uint32_t j, const dyd_exact c[2],
                            bool places) {
  int64_t last = c[0].exp < c[1].exp ? c[0].exp : c[1].exp, exp = size_of_distance(c, &p->sites.site[i]);
  for (exp = exp == INT64_MIN ? last : exp - 2; exp > last; exp -= exp - last > 200 ? 32 : 2) {
    dyd_proof_round(&out[0], &c[0], exp);
    dyd_proof_round(&out[1], &c[1], exp);
    if (dyd_cert_is_witness(NULL, &p->sites, &p->tree, i, j, out, places)) return true;
  }
  dyd_exact_set(&out[0], &c[0]);
  dyd_exact_set(&out[1], &c[1]);
  return dyd_cert_is_witness(NULL, &p->sites, &p->tree, i, j, out, places);
}

dyd_status dyd_proof_add_witness(bool *found, dyd_proof_points *out, const dyd_proof *p, uint32_t i, uint32_t j,
                                 const dyd_point *c, bool places) {
  if (!DYD_GROW(out->item, out->cap, out->count + 1)) return DYD_E_NOMEM;
  DYD_LOCAL_ARRAY(dyd_exact, from, [2]);
  dyd_exact *to = out->item[out->count];
  dyd_proof_init(to, 2);
  dyd_proof_set(&from[0], &c->x);
  dyd_proof_set(&from[1], &c->y);
  *found = shorten_witness(to, p, i, j, from, places);
  if (!*found) {
    dyd_proof_clear(to, 2);
    return DYD_OK;
  }
  dyd_proof_trim(&to[0]);
  dyd_proof_trim(&to[1]);
  out->count++;
  return DYD_OK;
}

/* ---- all sites ---- */

dyd_status dyd_proof_gather_sites(dyd_proof *p) {
  const dyd_sites *sites = dyd_delaunay_sites(p->pd);
  DYD_LOCAL(dyd_rect, r);
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
  if (st == DYD_OK) st = dyd_cert_sites_finish(&p->sites);
  return st == DYD_OK ? dyd_cert_tree_init(&p->tree, &p->sites) : st;
}

/* ---- discs ---- */

/* x rounded down to a multiple of 2^exp; the difference is added to *lost. */
static void round_rational(dyd_exact *out, mpq_t lost, mpq_srcptr x, int64_t exp) {
  DYD_LOCAL_NUMBERS(mpq, at);
  if (exp < 0)
    mpq_mul_2exp(at, x, (mp_bitcnt_t)-exp);
  else
    mpq_div_2exp(at, x, (mp_bitcnt_t)exp);
  mpz_fdiv_q(out->man, mpq_numref(at), mpq_denref(at));
  out->exp = exp;
  dyd_cert_exact_to_q(at, out, NULL);
  mpq_sub(at, x, at);
  mpq_add(lost, lost, at);
}

static int64_t exponent_of(mpq_srcptr x) {
  return (int64_t)mpz_sizeinbase(mpq_numref(x), 2) - (int64_t)mpz_sizeinbase(mpq_denref(x), 2);
}

enum { DISC_BITS = 256 };

/* The least power of two that the numbers of the disc are multiples of, or DISC_BITS bits below the least of them. */
static int64_t grid_of_disc(const dyd_disc *d) {
  mpq_srcptr all[3] = {d->x, d->y, d->r};
  int64_t least = INT64_MAX;
  for (int k = 0; k < 3; k++) {
    if (!mpq_sgn(all[k])) continue;
    mp_bitcnt_t zeros = mpz_scan1(mpq_denref(all[k]), 0);
    bool dyadic = mpz_sizeinbase(mpq_denref(all[k]), 2) == zeros + 1;
    int64_t exp = dyadic ? -(int64_t)zeros : exponent_of(all[k]) - DISC_BITS;
    if (exp < least) least = exp;
  }
  return least == INT64_MAX ? 0 : least;
}

void dyd_proof_hold_disc(dyd_cert_disc *out, const dyd_disc *d) {
  DYD_LOCAL_NUMBERS(mpq, lost, r);
  int64_t exp = grid_of_disc(d);
  round_rational(&out->x, lost, d->x, exp);
  round_rational(&out->y, lost, d->y, exp);
  mpq_add(r, d->r, lost);
  mpq_set_ui(lost, 0, 1);
  round_rational(&out->r, lost, r, exp);
  if (mpq_sgn(lost)) mpz_add_ui(out->r.man, out->r.man, 1);
}

/* ---- writing ---- */

static void put_number(FILE *out, const dyd_exact *x) {
  DYD_LOCAL(dyd_exact, t);
  dyd_exact_set(&t, x);
  dyd_proof_trim(&t);
  mpz_out_str(out, 10, t.man);
  if (t.exp) fprintf(out, "*2^%" PRId64, t.exp);
}

static void proof_put_side(FILE *out, const dyd_cert_side *s) {
  put_number(out, &s->lo);
  if (s->den) {
    putc('/', out);
    mpz_out_str(out, 10, *s->den);
  }
  if (s->point) return;
  DYD_LOCAL(dyd_exact, width);
  dyd_exact_sub(&width, &s->hi, &s->lo);
  putc('+', out);
  put_number(out, &width);
}

void dyd_proof_put(FILE *out, const char *format, ...) {
  va_list of;
  va_start(of, format);
  for (const char *at = format; *at; at++) {
    const dyd_exact *x;
    if (*at != '%') {
      putc(*at, out);
      continue;
    }
    switch (*++at) {
    case 'i':
      fprintf(out, "%" PRIu32, va_arg(of, uint32_t));
      break;
    case 's':
      proof_put_side(out, va_arg(of, const dyd_cert_side *));
      break;
    default: /* a number, or two */
      x = va_arg(of, const dyd_exact *);
      put_number(out, x);
      if (*at == 'p') putc(' ', out), put_number(out, x + 1);
    }
  }
  va_end(of);
}

void dyd_proof_put_sites(FILE *out, const dyd_proof *p) {
  fprintf(out, "sites %zu\n", p->sites.count);
  for (size_t i = 0; i < p->sites.count; i++) {
    const dyd_cert_site *s = &p->sites.site[i];
    if (s->alias != i)
      dyd_proof_put(out, "= %i\n", s->alias);
    else
      dyd_proof_put(out, "%s %s\n", &s->side[0], &s->side[1]);
  }
}
