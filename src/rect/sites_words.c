/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Points and ends of sides in single words, for readers and writers of millions of them. */
#include "base/alloc.h"
#include "rect/sites_table.h"

#include <math.h>
#include <string.h>

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

/* Room for n further points: at once for as many as sites find room. */
static dyd_status words_make_room(dyd_sites *s, size_t n) {
  if (!s->word && !(s->word = calloc(s->cap, sizeof *s->word))) return DYD_E_NOMEM;
  if (n <= s->point_cap - s->points) return DYD_OK;
  size_t need = s->points + (s->cap - s->count);
  return dyd_reserve((void **)&s->point, &s->point_cap, need, sizeof *s->point) ? DYD_OK : DYD_E_NOMEM;
}

/* Writes a point behind the last site, where there is room in every array. */
static void put_words(dyd_sites *s, const dyd_words xy[2]) {
  size_t i = s->count++;
  for (int a = 0; a < 2; a++) words_get_d(&s->lower[a][i], &s->upper[a][i], &xy[a]);
  if (s->exact) s->exact[i] = NULL;
  s->word[i] = 0;
  if (words_in_doubles(&xy[0]) && words_in_doubles(&xy[1])) return;
  s->point[s->points] =
      (dyd_word_point){{xy[0].man, xy[1].man}, {xy[0].den, xy[1].den}, {(int16_t)xy[0].exp, (int16_t)xy[1].exp}};
  s->word[i] = (uint32_t)++s->points;
}

dyd_status dyd_sites_add_words(dyd_sites *s, size_t n, const dyd_words *xy) {
  if (n == 0) return DYD_OK;
  dyd_status st = dyd_sites_reserve(s, n);
  if (st == DYD_OK) st = dyd_sites_split_ends(s);
  if (st == DYD_OK) st = words_make_room(s, n);
  for (size_t k = 0; k < n && st == DYD_OK; k++) put_words(s, xy + 2 * k);
  return st;
}

static dyd_words words_of_point(const dyd_sites *s, size_t i, int axis) {
  const dyd_word_point *p = &s->point[s->word[i] - 1];
  return (dyd_words){p->man[axis], p->den[axis], p->exp[axis]};
}

dyd_status dyd_sites_get_point(dyd_rect *out, const dyd_sites *s, size_t i) {
  dyd_interval *side[2] = {&out->x, &out->y};
  for (int a = 0; a < 2; a++) {
    dyd_words w = words_of_point(s, i, a);
    mpz_set_si(side[a]->lo.man, w.man);
    side[a]->lo.exp = w.exp;
    dyd_dyadic_set(&side[a]->hi, &side[a]->lo);
    mpz_set_ui(side[a]->den, w.den);
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

/* The number of the limbs at *from, of which sizes tell. Moves *from behind them. */
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
  if (size[2]) end[0].den = end[1].den = *(*from)++;
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
    for (int k = 0; k < 4; k++) end[k] = words_of_point(s, i, k / 2);
    return true;
  }
  const dyd_packed *p = s->exact[i];
  const mp_limb_t *from = p->limb;
  return words_of_side(end, &from, p->size, p->exp) && words_of_side(end + 2, &from, p->size + 3, p->exp + 2);
}
