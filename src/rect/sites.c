/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The table of sites: outward doubles in arrays, with packed exact rectangles where needed. */
#include "base/alloc.h"
#include "base/local.h"
#include "rect/columns_filter.h"
#include "rect/rect.h"
#include "rect/sites_table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The arrays of the table of sites. */

static bool resize_array(void *array, size_t cap, size_t size) {
  void *p = dyd_alloc_in_large_pages(realloc(*(void **)array, cap * size), cap * size);
  if (p) *(void **)array = p;
  return p != NULL;
}

dyd_status dyd_sites_reserve(dyd_sites *s, size_t more) {
  if (more > DYD_MAX_SITES - s->count) return DYD_E_RANGE;
  if (s->count + more <= s->cap) return DYD_OK;
  size_t cap = s->cap + s->cap / 2;
  if (cap < s->count + more) cap = s->count + more;
  for (int a = 0; a < 2; a++) {
    if (!resize_array(&s->lower[a], cap, sizeof(double))) return DYD_E_NOMEM;
    if (s->upper[a] && !resize_array(&s->upper[a], cap, sizeof(double))) return DYD_E_NOMEM;
  }
  if (s->exact && !resize_array(&s->exact, cap, sizeof *s->exact)) return DYD_E_NOMEM;
  if (s->word && !resize_array(&s->word, cap, sizeof *s->word)) return DYD_E_NOMEM;
  s->cap = cap;
  return DYD_OK;
}

/* Gives upper ends arrays of their own. */
static dyd_status sites_split_ends(dyd_sites *s) {
  for (int a = 0; a < 2; a++) {
    if (s->upper[a]) continue;
    double *p = dyd_alloc(s->cap ? s->cap : 1, sizeof *p);
    if (!p) return DYD_E_NOMEM;
    if (s->count) memcpy(p, s->lower[a], s->count * sizeof *p);
    s->upper[a] = p;
  }
  return DYD_OK;
}

/* Points and ends of sides in single words, for readers and writers of millions of them. */

/* ---- points ---- */

__extension__ typedef unsigned __int128 u128;

_Static_assert(sizeof(long) >= sizeof(int64_t), "GMP takes a word for a long");

static uint64_t size_of_word(int64_t man) {
  return man < 0 ? 0 - (uint64_t)man : (uint64_t)man;
}

static bool words_in_doubles(const dyd_words *w) {
  return w->den == 1 && size_of_word(w->man) < (uint64_t)1 << 53;
}

static int bits_of_word(uint64_t z) {
  return 64 - __builtin_clzll(z);
}

/* The doubles next to w. q, of 63 or 64 bits, is the integer part of |w| * 2^(k - exp); its first 53 bits are a double,
 * far from the ends of the range, and w is above it unless nothing was cut off. */
static void words_get_d(double *lo, double *hi, const dyd_words *w) {
  *lo = *hi = 0;
  if (!w->man) return;
  uint64_t m = size_of_word(w->man);
  int k = 63 - bits_of_word(m) + bits_of_word(w->den);
  u128 n = (u128)m << k;
  uint64_t q = (uint64_t)(n / w->den);
  int cut = bits_of_word(q) - 53;
  bool exact = (u128)q * w->den == n && (q >> cut) << cut == q;
  double below = ldexp((double)(q >> cut), cut + w->exp - k);
  double above = exact ? below : ldexp((double)((q >> cut) + 1), cut + w->exp - k);
  *lo = w->man < 0 ? -above : below;
  *hi = w->man < 0 ? -below : above;
}

/* Makes space for n further sites of `corners` points each: at once for the capacity of the table. */
static dyd_status words_make_room(dyd_sites *s, size_t n, size_t corners) {
  if (!s->word && !(s->word = calloc(s->cap, sizeof *s->word))) return DYD_E_NOMEM;
  if (n * corners <= s->point_cap - s->points) return DYD_OK;
  size_t need = s->points + (s->cap - s->count) * corners;
  return DYD_GROW(s->point, s->point_cap, need) ? DYD_OK : DYD_E_NOMEM;
}

/* Writes a site of one or two corners behind the last one, where there is room in every array. */
static void put_words(dyd_sites *s, const dyd_words *xy, size_t corners) {
  size_t i = s->count++;
  bool doubles = true;
  double none;
  for (int a = 0; a < 2; a++) {
    const dyd_words *upper = &xy[a + 2 * (corners - 1)];
    words_get_d(&s->lower[a][i], &s->upper[a][i], &xy[a]);
    if (corners == 2) words_get_d(&none, &s->upper[a][i], upper);
    doubles = doubles && words_in_doubles(&xy[a]) && words_in_doubles(upper);
  }
  if (s->exact) s->exact[i] = NULL;
  s->word[i] = 0;
  if (doubles) return;
  s->word[i] = (uint32_t)s->points + 1;
  if (corners == 2) s->word[i] |= DYD_WORD_BOX;
  for (; corners--; xy += 2)
    s->point[s->points++] =
        (dyd_word_point){{xy[0].man, xy[1].man}, {xy[0].den, xy[1].den}, {(int16_t)xy[0].exp, (int16_t)xy[1].exp}};
}

static dyd_status sites_add_corners(dyd_sites *s, size_t n, const dyd_words *xy, size_t corners) {
  if (n == 0) return DYD_OK;
  dyd_status st = dyd_sites_reserve(s, n);
  if (st == DYD_OK) st = sites_split_ends(s);
  if (st == DYD_OK) st = words_make_room(s, n, corners);
  for (size_t k = 0; k < n && st == DYD_OK; k++) put_words(s, xy + 2 * corners * k, corners);
  return st;
}

dyd_status dyd_sites_add_words(dyd_sites *s, size_t n, const dyd_words *xy) {
  return sites_add_corners(s, n, xy, 1);
}

dyd_status dyd_sites_add_word_boxes(dyd_sites *s, size_t n, const dyd_words *corner) {
  return sites_add_corners(s, n, corner, 2);
}

/* The lower or upper end of a site that is held in words. */
static dyd_words words_of_end(const dyd_sites *s, size_t i, int axis, bool upper) {
  const dyd_word_point *p = &s->point[(s->word[i] & ~DYD_WORD_BOX) - 1 + (upper && dyd_site_is_word_box(s, i))];
  return (dyd_words){p->man[axis], p->den[axis], p->exp[axis]};
}

/* *end = w times den, a multiple of its denominator. */
static void end_set_words(dyd_dyadic *end, const dyd_words *w, const mpz_t den) {
  mpz_divexact_ui(end->man, den, w->den);
  mpz_mul_si(end->man, end->man, w->man);
  end->exp = w->exp;
}

/* The rectangle of a site that is held in words. Factors of a denominator are odd, so that numerators stay odd. */
static dyd_status sites_get_in_words(dyd_rect *out, const dyd_sites *s, size_t i) {
  for (int a = 0; a < 2; a++) {
    dyd_interval *side = a ? &out->y : &out->x;
    const dyd_words lo = words_of_end(s, i, a, false), hi = words_of_end(s, i, a, true);
    mpz_set_ui(side->den, lo.den);
    if (hi.den != lo.den) mpz_lcm_ui(side->den, side->den, hi.den);
    end_set_words(&side->lo, &lo, side->den);
    end_set_words(&side->hi, &hi, side->den);
  }
  return DYD_OK;
}

/* ---- ends ---- */

static bool words_of_double(dyd_words *out, double x) {
  uint64_t bits;
  memcpy(&bits, &x, sizeof bits);
  int exponent = (int)(bits >> 52 & 0x7ff);
  int64_t man = (int64_t)(bits & ((UINT64_C(1) << 52) - 1)) | INT64_C(1) << 52;
  *out = (dyd_words){0, 1, 0};
  if (x == 0) return true;
  int twos = __builtin_ctzll((uint64_t)man), exp = exponent - 1075 + twos;
  if (!exponent || !isfinite(x) || exp < -DYD_WORDS_MOST_EXP || exp > DYD_WORDS_MOST_EXP) return false;
  *out = (dyd_words){(x < 0 ? -man : man) / (INT64_C(1) << twos), 1, exp};
  return true;
}

/* The number of the limbs at *from, given by its size. Moves *from behind them. */
static bool words_of_limbs(dyd_words *out, const mp_limb_t **from, int32_t size, int64_t exp) {
  if (size < -1 || size > 1 || exp < -DYD_WORDS_MOST_EXP || exp > DYD_WORDS_MOST_EXP) return false;
  mp_limb_t man = size ? *(*from)++ : 0;
  if (man > INT64_MAX) return false;
  *out = (dyd_words){size < 0 ? -(int64_t)man : (int64_t)man, 1, (int)exp};
  return true;
}

/* Those of one side of p, at *from. */
static bool words_of_side(dyd_words end[2], const mp_limb_t **from, const int32_t size[3], const int64_t exp[2]) {
  if (!words_of_limbs(&end[0], from, size[0], exp[0])) return false;
  if (size[1] == DYD_SAME_AS_LOWER)
    end[1] = end[0];
  else if (!words_of_limbs(&end[1], from, size[1], exp[1]))
    return false;
  if (size[2] > 1) return false;
  if (size[2] == 0) return true;
  const mp_limb_t den = *(*from)++;
  for (int k = 0; k < 2; k++) {
    int64_t common = end[k].man ? (int64_t)mpn_gcd_1(&den, 1, size_of_word(end[k].man)) : 0;
    end[k].den = common ? den / (uint64_t)common : 1;
    if (common) end[k].man /= common;
  }
  return true;
}

bool dyd_sites_get_words(dyd_words end[4], const dyd_sites *s, size_t i) {
  if (dyd_sites_in_doubles(s, i)) {
    for (int a = 0; a < 2; a++)
      if (!words_of_double(&end[2 * a], dyd_sites_lo(s, a, i)) ||
          !words_of_double(&end[2 * a + 1], dyd_sites_hi(s, a, i)))
        return false;
    return true;
  }
  if (dyd_sites_in_words(s, i)) {
    for (int k = 0; k < 4; k++) end[k] = words_of_end(s, i, k / 2, k % 2);
    return true;
  }
  const dyd_packed *p = s->exact[i];
  const mp_limb_t *from = p->limb;
  return words_of_side(end, &from, p->size, p->exp) && words_of_side(end + 2, &from, p->size + 3, p->exp + 2);
}

/* Sites that are known to be the same place. */

size_t dyd_sites_joined(const dyd_sites *s, size_t i) {
  return s ? dyd_site_joined(s, i) : 0;
}

static dyd_status joined_make_room(dyd_sites *s) {
  uint32_t *p = s->joined_count < s->count ? realloc(s->joined, s->count * sizeof *p) : s->joined;
  if (!p) return DYD_E_NOMEM;
  s->joined = p;
  for (; s->joined_count < s->count; s->joined_count++) p[s->joined_count] = (uint32_t)s->joined_count;
  return DYD_OK;
}

/* *common = what sites i and j have in common. */
static dyd_status joined_rect(dyd_rect *common, const dyd_sites *s, size_t i, size_t j) {
  DYD_LOCAL(dyd_rect, other);
  dyd_status st = dyd_sites_get(common, s, i);
  if (st == DYD_OK) st = dyd_sites_get(&other, s, j);
  if (st == DYD_OK && !dyd_rect_meets(common, &other)) st = DYD_E_NESTING;
  if (st == DYD_OK) st = dyd_interval_intersect(&common->x, &common->x, &other.x);
  return st == DYD_OK ? dyd_interval_intersect(&common->y, &common->y, &other.y) : st;
}

/* Of the two and all that are joined with them. */
static dyd_status joined_narrow(dyd_sites *s, uint32_t low, uint32_t high, const dyd_rect *common) {
  dyd_status st = DYD_OK;
  for (size_t k = 0; k < s->joined_count && st == DYD_OK; k++)
    if (s->joined[k] == low || s->joined[k] == high) st = dyd_sites_narrow(s, k, common);
  for (size_t k = 0; k < s->joined_count && st == DYD_OK; k++)
    if (s->joined[k] == high) s->joined[k] = low;
  return st;
}

dyd_status dyd_sites_join(dyd_sites *s, size_t i, size_t j) {
  if (!s) return DYD_E_ARG;
  if (i >= s->count || j >= s->count) return DYD_E_ARG;
  dyd_status st = joined_make_room(s);
  if (st != DYD_OK) return st;
  uint32_t low = s->joined[i < j ? i : j], high = s->joined[i < j ? j : i];
  if (low == high) return DYD_OK;
  DYD_LOCAL(dyd_rect, common);
  st = joined_rect(&common, s, low, high);
  if (st == DYD_OK) st = low < high ? joined_narrow(s, low, high, &common) : joined_narrow(s, high, low, &common);
  if (st == DYD_OK) s->joins++;
  return st;
}

dyd_status dyd_sites_new(dyd_sites **out) {
  dyd_sites *s = calloc(1, sizeof *s);
  if (!s) return DYD_E_NOMEM;
  *out = s;
  return DYD_OK;
}

void dyd_sites_free(dyd_sites *s) {
  if (!s) return;
  dyd_sites_cut(s, 0);
  dyd_free_all(s->exact, s->word, s->point, s->joined, s->kind);
  for (int a = 0; a < 2; a++) {
    dyd_free_all(s->lower[a], s->upper[a]);
  }
  free(s);
}

size_t dyd_sites_count(const dyd_sites *s) {
  return s ? s->count : 0;
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
  if (st == DYD_OK && !points) st = sites_split_ends(s);
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
  if (st == DYD_OK && radius) st = sites_split_ends(s);
  for (int a = 0; st == DYD_OK && a < 2; a++) {
    double *upper = s->upper[a] ? s->upper[a] + s->count : NULL;
    if (!put_columns(s->lower[a] + s->count, upper, n, &xy[a], radius ? &radius[a] : NULL)) st = DYD_E_ARG;
  }
  if (st != DYD_OK) return st;
  sites_append_held(s, n);
  return DYD_OK;
}

dyd_status dyd_sites_set_kind(dyd_sites *s, size_t i, size_t n, dyd_site_kind kind) {
  if (i + n > s->kind_count) {
    if (kind == DYD_SITE_ANY && i >= s->kind_count) return DYD_OK;
    if (!DYD_GROW(s->kind, s->kind_cap, i + n)) return DYD_E_NOMEM;
    memset(s->kind + s->kind_count, DYD_SITE_ANY, i + n - s->kind_count);
    s->kind_count = i + n;
  }
  if (n) memset(s->kind + i, (int)kind, n);
  return DYD_OK;
}

dyd_status dyd_sites_add_planes(dyd_sites *s, size_t n, dyd_site_kind kind) {
  dyd_status st = dyd_sites_reserve(s, n);
  if (st == DYD_OK) st = sites_split_ends(s);
  if (st == DYD_OK && !DYD_GROW(s->kind, s->kind_cap, s->count + n)) st = DYD_E_NOMEM;
  if (st != DYD_OK) return st;
  for (size_t i = s->count; i < s->count + n; i++) {
    for (int a = 0; a < 2; a++) {
      s->lower[a][i] = -INFINITY;
      s->upper[a][i] = INFINITY;
    }
  }
  sites_append_held(s, n);
  return dyd_sites_set_kind(s, s->count - n, n, kind);
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

void dyd_sites_cut(dyd_sites *s, size_t count) {
  while (s->count > count) {
    const size_t i = --s->count;
    if (s->exact && s->exact[i]) s->packed_bytes -= packed_size(s->exact[i]);
    if (s->exact) free(s->exact[i]);
    if (dyd_sites_in_words(s, i)) s->points = (s->word[i] & ~DYD_WORD_BOX) - 1;
  }
  if (s->kind_count > count) s->kind_count = count;
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
  DYD_LOCAL_NUMBERS(mpz, man);
  DYD_LOCAL(dyd_dyadic, lo, hi);
  mpz_ui_pow_ui(man, 2, 64);
  mpz_sub_ui(man, man, 1);
  dyd_status st = dyd_dyadic_set_z_2exp(&hi, man, DYD_EXP_LIMIT - 64);
  dyd_dyadic_neg(&lo, &hi);
  if (st == DYD_OK) st = dyd_interval_set_ends(&out->x, &lo, &hi);
  return st == DYD_OK ? dyd_interval_set_ends(&out->y, &lo, &hi) : st;
}

dyd_status dyd_sites_get(dyd_rect *out, const dyd_sites *s, size_t i) {
  if (!s) return DYD_E_ARG;
  if (i >= s->count) return DYD_E_ARG;
  if (dyd_sites_in_doubles(s, i) && isinf(dyd_sites_lo(s, 0, i))) return sites_get_plane(out);
  if (dyd_sites_in_doubles(s, i))
    return dyd_rect_set_d(out, dyd_sites_lo(s, 0, i), dyd_sites_hi(s, 0, i), dyd_sites_lo(s, 1, i),
                          dyd_sites_hi(s, 1, i));
  if (dyd_sites_in_words(s, i)) return sites_get_in_words(out, s, i);
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

bool dyd_sites_is_point(const dyd_sites *s, size_t i) {
  return s && dyd_site_is_point(s, i);
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
    dyd_status st = sites_split_ends(s);
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
  if (!DYD_GROW(s->kind, s->kind_cap, s->count + 1)) return DYD_E_NOMEM;
  st = sites_put(s, s->count, r, NULL);
  return st == DYD_OK ? dyd_sites_set_kind(s, s->count++, 1, DYD_SITE_GIVEN) : st;
}

/* A rectangle that was given is narrowed. */
static void kind_narrow(dyd_sites *s, size_t i) {
  if (i < s->kind_count && s->kind[i] == DYD_SITE_GIVEN) s->kind[i] = DYD_SITE_ANY;
}

dyd_status dyd_sites_narrow(dyd_sites *s, size_t i, const dyd_rect *r) {
  if (!s) return DYD_E_ARG;
  if (i >= s->count) return DYD_E_ARG;
  DYD_LOCAL(dyd_rect, now);
  dyd_status st = dyd_sites_get(&now, s, i);
  if (st == DYD_OK && !dyd_rect_contains(&now, r)) st = DYD_E_NESTING;
  if (st == DYD_OK && (!dyd_sites_in_words(s, i) || dyd_site_is_word_box(s, i))) {
    st = sites_put(s, i, r, s->exact ? s->exact[i] : NULL);
    kind_narrow(s, i);
  }
  return st;
}

dyd_status dyd_sites_replace(dyd_sites *s, size_t i, const dyd_rect *r) {
  kind_narrow(s, i);
  return sites_put(s, i, r, s->exact ? s->exact[i] : NULL);
}

/* Narrows site i to a rectangle of doubles by way of exact ones. */
static dyd_status sites_narrow_exact(dyd_sites *s, size_t i, const double box[4]) {
  DYD_LOCAL(dyd_rect, r);
  dyd_status st = dyd_rect_set_d(&r, box[0], box[1], box[2], box[3]);
  return st == DYD_OK ? dyd_sites_narrow(s, i, &r) : st;
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
  kind_narrow(s, i);
  return DYD_OK;
}

size_t dyd_sites_memory(const dyd_sites *s) {
  if (!s) return 0;
  size_t arrays = 2 + (s->upper[0] != NULL) + (s->upper[1] != NULL) + (s->exact != NULL);
  size_t words = (s->word ? s->cap * sizeof *s->word : 0) + s->point_cap * sizeof *s->point;
  return sizeof *s + s->cap * arrays * sizeof(double) + s->packed_bytes + words + s->joined_count * sizeof *s->joined +
         s->kind_cap * sizeof *s->kind;
}
