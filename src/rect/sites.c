/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The table of sites: outward doubles in arrays, exact rectangles packed beside them where needed. */
#include "rect/columns_filter.h"
#include "rect/interval.h"
#include "rect/sites_table.h"

#include "base/alloc.h"

#include <math.h>
#include <string.h>

dyd_status dyd_sites_new(dyd_sites **out) {
  dyd_sites *s = calloc(1, sizeof *s);
  if (!s) return DYD_E_NOMEM;
  *out = s;
  return DYD_OK;
}

void dyd_sites_free(dyd_sites *s) {
  if (!s) return;
  if (s->exact)
    for (size_t i = 0; i < s->count; i++) free(s->exact[i]);
  free(s->exact);
  free(s->word);
  free(s->point);
  free(s->joined);
  for (int a = 0; a < 2; a++) {
    free(s->lower[a]);
    free(s->upper[a]);
  }
  free(s);
}

size_t dyd_sites_count(const dyd_sites *s) {
  if (!s) return 0;
  return s->count;
}

static dyd_status sites_make_exact(dyd_sites *s) {
  if (s->exact) return DYD_OK;
  s->exact = calloc(s->cap ? s->cap : 1, sizeof *s->exact);
  return s->exact ? DYD_OK : DYD_E_NOMEM;
}

static bool ends_are_good(size_t n, const double *lo, const double *hi) {
  for (size_t i = 0; i < n; i++)
    if (!isfinite(lo[i]) || !isfinite(hi[i]) || lo[i] > hi[i]) return false;
  return true;
}

/* Says of n sites behind the last one that doubles hold them. */
static void sites_append_held(dyd_sites *s, size_t n) {
  if (s->exact) memset(s->exact + s->count, 0, n * sizeof *s->exact);
  if (s->word) memset(s->word + s->count, 0, n * sizeof *s->word);
  s->count += n;
}

/* Adding +0.0 turns -0.0 into +0.0, so that equal numbers are equal bits. */
static void sites_copy_ends(double *to, const double *from, size_t n) {
  for (size_t i = 0; i < n; i++) to[i] = from[i] + 0.0;
}

static dyd_status sites_add_doubles(dyd_sites *s, size_t n, const double *const lo[2], const double *const hi[2]) {
  bool points = lo[0] == hi[0] && lo[1] == hi[1];
  for (int a = 0; a < 2; a++)
    if (!ends_are_good(n, lo[a], hi[a])) return DYD_E_ARG;
  dyd_status st = dyd_sites_reserve(s, n);
  if (st == DYD_OK && !points) st = dyd_sites_split_ends(s);
  if (st != DYD_OK) return st;
  for (int a = 0; a < 2; a++) {
    sites_copy_ends(s->lower[a] + s->count, lo[a], n);
    if (s->upper[a]) sites_copy_ends(s->upper[a] + s->count, hi[a], n);
  }
  sites_append_held(s, n);
  return DYD_OK;
}

dyd_status dyd_sites_add_points(dyd_sites *s, size_t n, const double *x, const double *y) {
  if (!s) return DYD_E_ARG;
  const double *const lo[2] = {x, y};
  return sites_add_doubles(s, n, lo, lo);
}

dyd_status dyd_sites_add_boxes(dyd_sites *s, size_t n, const double *x0, const double *x1, const double *y0,
                               const double *y1) {
  if (!s) return DYD_E_ARG;
  const double *const lo[2] = {x0, y0}, *const hi[2] = {x1, y1};
  return sites_add_doubles(s, n, lo, hi);
}

/* One axis, written behind the last site, where there is room. */
static bool put_columns(double *lower, double *upper, size_t n, const dyd_column *x, const dyd_column *radius) {
  bool good = true;
  for (size_t i = 0; i < n; i++) {
    double lo = dyd_column_at(x, i) + 0.0, hi = lo;
    good &= radius ? dyd_widen_d(&lo, &hi, lo, dyd_column_at(radius, i)) : isfinite(lo);
    lower[i] = lo;
    if (upper) upper[i] = hi;
  }
  return good;
}

dyd_status dyd_sites_add_columns(dyd_sites *s, size_t n, const dyd_column xy[2], const dyd_column *radius) {
  if (!s) return DYD_E_ARG;
  dyd_status st = dyd_sites_reserve(s, n);
  if (st == DYD_OK && radius) st = dyd_sites_split_ends(s);
  for (int a = 0; st == DYD_OK && a < 2; a++) {
    double *upper = s->upper[a] ? s->upper[a] + s->count : NULL;
    if (!put_columns(s->lower[a] + s->count, upper, n, &xy[a], radius ? &radius[a] : NULL)) st = DYD_E_ARG;
  }
  if (st != DYD_OK) return st;
  sites_append_held(s, n);
  return DYD_OK;
}

dyd_status dyd_sites_add_planes(dyd_sites *s, size_t n) {
  dyd_status st = dyd_sites_reserve(s, n);
  if (st == DYD_OK) st = dyd_sites_split_ends(s);
  if (st != DYD_OK) return st;
  for (size_t i = s->count; i < s->count + n; i++) {
    for (int a = 0; a < 2; a++) {
      s->lower[a][i] = -INFINITY;
      s->upper[a][i] = INFINITY;
    }
  }
  sites_append_held(s, n);
  return DYD_OK;
}

/* ---- packing ---- */

static size_t limbs_of(int32_t size) {
  return size == DYD_SAME_AS_LOWER ? 0 : (size_t)(size < 0 ? -size : size);
}

static size_t packed_size(const dyd_packed *p) {
  size_t limbs = 0;
  for (int k = 0; k < 6; k++) limbs += limbs_of(p->size[k]);
  return sizeof *p + limbs * sizeof(mp_limb_t);
}

static void interval_sizes(int32_t size[3], int64_t exp[2], const dyd_interval *a) {
  bool point = dyd_interval_is_point(a);
  exp[0] = a->lo.exp;
  exp[1] = a->hi.exp;
  size[0] = a->lo.man->_mp_size;
  size[1] = point ? DYD_SAME_AS_LOWER : a->hi.man->_mp_size;
  size[2] = mpz_cmp_ui(a->den, 1) == 0 ? 0 : a->den->_mp_size;
}

static mp_limb_t *put_limbs(mp_limb_t *to, const mpz_t z, int32_t size) {
  size_t n = limbs_of(size);
  if (n) memcpy(to, mpz_limbs_read(z), n * sizeof *to);
  return to + n;
}

static dyd_packed *pack_rect(const dyd_rect *r) {
  dyd_packed head;
  interval_sizes(head.size, head.exp, &r->x);
  interval_sizes(head.size + 3, head.exp + 2, &r->y);
  dyd_packed *p = malloc(packed_size(&head));
  if (!p) return NULL;
  memcpy(p, &head, sizeof head);
  const dyd_interval *side[2] = {&r->x, &r->y};
  mp_limb_t *to = p->limb;
  for (int a = 0; a < 2; a++) {
    to = put_limbs(to, side[a]->lo.man, p->size[3 * a]);
    to = put_limbs(to, side[a]->hi.man, p->size[3 * a + 1]);
    to = put_limbs(to, side[a]->den, p->size[3 * a + 2]);
  }
  return p;
}

static const mp_limb_t *take_limbs(mpz_t z, const mp_limb_t *from, int32_t size) {
  mpz_t view;
  mpz_set(z, mpz_roinit_n(view, from, size));
  return from + limbs_of(size);
}

static const mp_limb_t *unpack_interval(dyd_interval *out, const mp_limb_t *from, const int32_t size[3],
                                        const int64_t exp[2]) {
  from = take_limbs(out->lo.man, from, size[0]);
  out->lo.exp = exp[0];
  if (size[1] == DYD_SAME_AS_LOWER) {
    dyd_dyadic_set(&out->hi, &out->lo);
  } else {
    from = take_limbs(out->hi.man, from, size[1]);
    out->hi.exp = exp[1];
  }
  if (size[2] == 0)
    mpz_set_ui(out->den, 1);
  else
    from = take_limbs(out->den, from, size[2]);
  return from;
}

/* ---- single sites ---- */

static dyd_status sites_get_plane(dyd_rect *out) {
  mpz_t man;
  dyd_dyadic lo, hi;
  mpz_init(man);
  dyd_dyadic_init(&lo);
  dyd_dyadic_init(&hi);
  mpz_ui_pow_ui(man, 2, 64);
  mpz_sub_ui(man, man, 1);
  dyd_status st = dyd_dyadic_set_z_2exp(&hi, man, DYD_EXP_LIMIT - 64);
  dyd_dyadic_neg(&lo, &hi);
  if (st == DYD_OK) st = dyd_interval_set_ends(&out->x, &lo, &hi);
  if (st == DYD_OK) st = dyd_interval_set_ends(&out->y, &lo, &hi);
  dyd_dyadic_clear(&hi);
  dyd_dyadic_clear(&lo);
  mpz_clear(man);
  return st;
}

dyd_status dyd_sites_get(dyd_rect *out, const dyd_sites *s, size_t i) {
  if (!s) return DYD_E_ARG;
  if (i >= s->count) return DYD_E_ARG;
  if (dyd_sites_in_doubles(s, i) && isinf(dyd_sites_lo(s, 0, i))) return sites_get_plane(out);
  if (dyd_sites_in_doubles(s, i))
    return dyd_rect_set_d(out, dyd_sites_lo(s, 0, i), dyd_sites_hi(s, 0, i), dyd_sites_lo(s, 1, i),
                          dyd_sites_hi(s, 1, i));
  if (dyd_sites_in_words(s, i)) return dyd_sites_get_point(out, s, i);
  const dyd_packed *p = s->exact[i];
  const mp_limb_t *from = unpack_interval(&out->x, p->limb, p->size, p->exp);
  unpack_interval(&out->y, from, p->size + 3, p->exp + 2);
  return DYD_OK;
}

void dyd_sites_get_d(double out[4], const dyd_sites *s, size_t i) {
  if (!s) return;
  for (int a = 0; a < 2; a++) {
    out[2 * a] = dyd_sites_lo(s, a, i);
    out[2 * a + 1] = dyd_sites_hi(s, a, i);
  }
}

dyd_status dyd_sites_copy_d(double *out, const dyd_sites *s, size_t first, size_t count) {
  if (!s) return DYD_E_ARG;
  if (first > s->count || count > s->count - first) return DYD_E_ARG;
  for (size_t k = 0; k < count; k++) dyd_sites_get_d(out + 4 * k, s, first + k);
  return DYD_OK;
}

bool dyd_sites_is_point(const dyd_sites *s, size_t i) {
  if (!s) return false;
  if (dyd_sites_in_doubles(s, i))
    return dyd_sites_lo(s, 0, i) == dyd_sites_hi(s, 0, i) && dyd_sites_lo(s, 1, i) == dyd_sites_hi(s, 1, i);
  if (dyd_sites_in_words(s, i)) return true;
  return s->exact[i]->size[1] == DYD_SAME_AS_LOWER && s->exact[i]->size[4] == DYD_SAME_AS_LOWER;
}

/* Writes r over entry i, which has room in every array it needs. */
static dyd_status sites_put(dyd_sites *s, size_t i, const dyd_rect *r, dyd_packed *old) {
  double lo[2], hi[2];
  dyd_packed *p = NULL;
  const dyd_interval *side[2] = {&r->x, &r->y};
  bool doubles = true;
  for (int a = 0; a < 2; a++) {
    if (dyd_interval_get_exact_d(&lo[a], &hi[a], side[a])) continue;
    dyd_interval_get_d(&lo[a], &hi[a], side[a]);
    doubles = false;
  }
  if (!doubles || lo[0] != hi[0] || lo[1] != hi[1]) {
    dyd_status st = dyd_sites_split_ends(s);
    if (st == DYD_OK && !doubles) st = sites_make_exact(s);
    if (st != DYD_OK) return st;
  }
  if (!doubles) {
    p = pack_rect(r);
    if (!p) return DYD_E_NOMEM;
  }
  for (int a = 0; a < 2; a++) {
    s->lower[a][i] = lo[a] + 0.0;
    if (s->upper[a]) s->upper[a][i] = hi[a] + 0.0;
  }
  if (old) s->packed_bytes -= packed_size(old);
  free(old);
  if (p) s->packed_bytes += packed_size(p);
  if (s->exact) s->exact[i] = p;
  if (s->word) s->word[i] = 0;
  return DYD_OK;
}

dyd_status dyd_sites_add_rect(dyd_sites *s, const dyd_rect *r) {
  if (!s) return DYD_E_ARG;
  dyd_status st = dyd_sites_reserve(s, 1);
  if (st != DYD_OK) return st;
  st = sites_put(s, s->count, r, NULL);
  if (st == DYD_OK) s->count++;
  return st;
}

dyd_status dyd_sites_narrow(dyd_sites *s, size_t i, const dyd_rect *r) {
  if (!s) return DYD_E_ARG;
  if (i >= s->count) return DYD_E_ARG;
  dyd_rect now;
  dyd_rect_init(&now);
  dyd_status st = dyd_sites_get(&now, s, i);
  if (st == DYD_OK && !dyd_rect_contains(&now, r)) st = DYD_E_NESTING;
  if (st == DYD_OK && !dyd_sites_in_words(s, i)) st = sites_put(s, i, r, s->exact ? s->exact[i] : NULL);
  dyd_rect_clear(&now);
  return st;
}

/* Narrows site i to a rectangle of doubles by way of exact ones. */
static dyd_status sites_narrow_exact(dyd_sites *s, size_t i, const double box[4]) {
  dyd_rect r;
  dyd_rect_init(&r);
  dyd_status st = dyd_rect_set_d(&r, box[0], box[1], box[2], box[3]);
  if (st == DYD_OK) st = dyd_sites_narrow(s, i, &r);
  dyd_rect_clear(&r);
  return st;
}

dyd_status dyd_sites_narrow_d(dyd_sites *s, size_t i, const double box[4]) {
  if (i >= s->count) return DYD_E_ARG;
  if (!dyd_sites_in_doubles(s, i) || !s->upper[0]) return sites_narrow_exact(s, i, box);
  for (int a = 0; a < 2; a++)
    if (box[2 * a] < s->lower[a][i] || box[2 * a + 1] > s->upper[a][i]) return DYD_E_NESTING;
  for (int a = 0; a < 2; a++) {
    s->lower[a][i] = box[2 * a];
    s->upper[a][i] = box[2 * a + 1];
  }
  return DYD_OK;
}

size_t dyd_sites_memory(const dyd_sites *s) {
  if (!s) return 0;
  size_t arrays = 2 + (s->upper[0] != NULL) + (s->upper[1] != NULL) + (s->exact != NULL);
  size_t words = (s->word ? s->cap * sizeof *s->word : 0) + s->point_cap * sizeof *s->point;
  return sizeof *s + s->cap * arrays * sizeof(double) + s->packed_bytes + words + s->joined_count * sizeof *s->joined;
}
