/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Ends of sides in single words, for writers of millions of them. */
#include "rect/sites_table.h"

#include <math.h>
#include <string.h>

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
  const dyd_packed *p = s->exact[i];
  const mp_limb_t *from = p->limb;
  return words_of_side(end, &from, p->size, p->exp) && words_of_side(end + 2, &from, p->size + 3, p->exp + 2);
}
