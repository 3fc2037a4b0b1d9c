/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The rectangles of a certificate, exact and on a coarse grid of integers. */
#include "checker/sites.h"
#include "base/alloc.h"

void dyd_cert_sites_init(dyd_cert_sites *s) {
  *s = (dyd_cert_sites){0};
  mpz_inits(s->origin[0], s->origin[1], NULL);
}

static void clear_side(dyd_cert_side *s) {
  dyd_exact_clear(&s->lo);
  dyd_exact_clear(&s->hi);
  if (s->den) mpz_clear(*s->den);
  free(s->den);
}

static void clear_place(dyd_cert_site *s) {
  if (!s->place) return;
  dyd_exact_clear(&s->place[0]);
  dyd_exact_clear(&s->place[1]);
  free(s->place);
  s->place = NULL;
}

void dyd_cert_sites_clear(dyd_cert_sites *s) {
  for (size_t i = 0; i < s->count; i++) {
    clear_side(&s->site[i].side[0]);
    clear_side(&s->site[i].side[1]);
    clear_place(&s->site[i]);
  }
  free(s->site);
  free(s->box);
  mpz_clears(s->origin[0], s->origin[1], NULL);
  *s = (dyd_cert_sites){0};
}

dyd_cert_site *dyd_cert_sites_add(dyd_cert_sites *s) {
  if (s->count >= DYD_CERT_NONE || !dyd_reserve((void **)&s->site, &s->cap, s->count + 1, sizeof *s->site)) return NULL;
  dyd_cert_site *site = &s->site[s->count];
  *site = (dyd_cert_site){.alias = (uint32_t)s->count};
  for (int a = 0; a < 2; a++) {
    dyd_exact_init(&site->side[a].lo);
    dyd_exact_init(&site->side[a].hi);
    site->side[a].point = true;
  }
  s->count++;
  return site;
}

dyd_status dyd_cert_side_set_den(dyd_cert_side *side, mpz_srcptr den) {
  if (!side->den) {
    side->den = malloc(sizeof *side->den);
    if (!side->den) return DYD_E_NOMEM;
    mpz_init(*side->den);
  }
  mpz_set(*side->den, den);
  return DYD_OK;
}

dyd_status dyd_cert_site_set_place(dyd_cert_site *site, const dyd_exact at[2]) {
  if (!site->place) {
    site->place = malloc(2 * sizeof *site->place);
    if (!site->place) return DYD_E_NOMEM;
    dyd_exact_init(&site->place[0]);
    dyd_exact_init(&site->place[1]);
  }
  dyd_exact_set(&site->place[0], &at[0]);
  dyd_exact_set(&site->place[1], &at[1]);
  return DYD_OK;
}

/* ---- the grid ---- */

/* An end as a dyadic, rounded outward by less than 2^-64 of itself. */
static void end_outward(dyd_exact *out, const dyd_cert_side *s, bool upper) {
  const dyd_exact *end = upper ? dyd_cert_high(s) : &s->lo;
  dyd_exact_set(out, end);
  if (!s->den || !dyd_exact_sgn(end)) return;
  out->exp = end->exp - (int64_t)mpz_sizeinbase(*s->den, 2) - 64;
  (upper ? dyd_exact_ceil : dyd_exact_floor)(out->man, end, *s->den, out->exp);
}

/* The least and the greatest end along an axis. */
static void axis_extent(dyd_exact range[2], const dyd_cert_sites *s, int axis) {
  dyd_exact end;
  dyd_exact_init(&end);
  for (size_t i = 0; i < s->count; i++)
    for (int upper = 0; upper < 2; upper++) {
      end_outward(&end, &s->site[i].side[axis], upper);
      int sign = dyd_exact_cmp(&end, &range[upper]);
      if (i == 0 || (upper ? sign > 0 : sign < 0)) dyd_exact_set(&range[upper], &end);
    }
  dyd_exact_clear(&end);
}

static void place_on_grid(dyd_cert_box *box, const dyd_cert_sites *s, size_t i) {
  mpz_t t;
  mpz_init(t);
  for (int axis = 0; axis < 2; axis++) {
    const dyd_cert_side *side = &s->site[i].side[axis];
    dyd_exact_floor(t, &side->lo, dyd_cert_den(side), s->unit);
    mpz_sub(t, t, s->origin[axis]);
    box->e[2 * axis] = (int32_t)mpz_get_si(t);
    dyd_exact_ceil(t, dyd_cert_high(side), dyd_cert_den(side), s->unit);
    mpz_sub(t, t, s->origin[axis]);
    box->e[2 * axis + 1] = (int32_t)mpz_get_si(t);
  }
  mpz_clear(t);
}

dyd_status dyd_cert_sites_finish(dyd_cert_sites *s) {
  dyd_exact range[2][2], width;
  s->box = dyd_alloc(s->count, sizeof *s->box);
  if (!s->box) return DYD_E_NOMEM;
  dyd_exact_init(&width);
  int64_t top = INT64_MIN;
  for (int axis = 0; axis < 2; axis++) {
    dyd_exact_init(&range[axis][0]);
    dyd_exact_init(&range[axis][1]);
    axis_extent(range[axis], s, axis);
    dyd_exact_sub(&width, &range[axis][1], &range[axis][0]);
    if (dyd_exact_top(&width) > top) top = dyd_exact_top(&width);
  }
  /* Widths are below 2^top, so grid coordinates are at most 2^30 + 2. One point only: any unit does. */
  s->unit = top == INT64_MIN ? 0 : top - 30;
  for (int axis = 0; axis < 2; axis++) dyd_exact_floor(s->origin[axis], &range[axis][0], NULL, s->unit);
  for (size_t i = 0; i < s->count; i++) place_on_grid(&s->box[i], s, i);
  for (int k = 0; k < 4; k++) dyd_exact_clear(&range[k / 2][k % 2]);
  dyd_exact_clear(&width);
  return DYD_OK;
}
