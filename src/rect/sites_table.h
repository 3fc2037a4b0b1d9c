/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Inside the table of sites, for the layers that read it in hot loops. */
#ifndef DYD_RECT_SITES_TABLE_H
#define DYD_RECT_SITES_TABLE_H

#include "base/local.h"
#include "rect/irect.h"
#include <dyadel/sites.h>

DYD_OWNERS(dyd_sites)

/* An exact rectangle packed into one block: the limbs of xlo, xhi, xden, ylo, yhi, yden one after the other.
 * A size of DYD_SAME_AS_LOWER for an upper end says "the same as the lower end". */
#define DYD_SAME_AS_LOWER INT32_MIN
typedef struct dyd_packed {
  int64_t exp[4];
  int32_t size[6];
  mp_limb_t limb[];
} dyd_packed;

/* The rational man * 2^exp / den. Invariant: man is odd, or 0 with exp = 0 and den = 1; den is odd and has no factor in
 * common with man; |exp| <= DYD_WORDS_MOST_EXP. */
enum { DYD_WORDS_MOST_EXP = 200 };
typedef struct dyd_words {
  int64_t man;
  uint64_t den;
  int exp;
} dyd_words;

/* A point of them, x and y, in fewer bytes. */
typedef struct dyd_word_point {
  int64_t man[2];
  uint64_t den[2];
  int16_t exp[2];
} dyd_word_point;

/* A word[] with this bit is that of a rectangle: the point is its lower left corner, the next one the opposite one. */
#define DYD_WORD_BOX ((uint32_t)1 << 31)

/* Invariant: upper[a] = NULL means that every site is an exact double point (lower and upper ends are the same array);
 * exact[i] or word[i] that are not 0 (where the arrays are not NULL, and never both) mean that its doubles do not hold
 * the rectangle of site i: it is *exact[i], or that of word[i] - 1 in point[], a point for ever. Infinite doubles mean
 * the whole plane, of a site that is unknown yet: the square whose ends are the largest dyadics of 64 bits. */
struct dyd_sites {
  size_t count, cap;
  double *lower[2]; /* x, y; rounded down */
  double *upper[2]; /* rounded up */
  dyd_packed **exact;
  size_t packed_bytes;
  uint32_t *word;
  dyd_word_point *point;
  size_t points, point_cap;
  uint32_t *joined; /* of sites below joined_count: the lowest site known to be the same place; NULL: none are joined */
  size_t joined_count, joins; /* joins made */
  uint8_t *kind;              /* of sites below kind_count: dyd_site_kind; NULL: all are of any kind */
  size_t kind_count, kind_cap;
};

/* Room for `more` further sites in every array there is. */
dyd_status dyd_sites_reserve(dyd_sites *s, size_t more);
/* Removes the sites from number `count` on, which were never visible to callers. */
void dyd_sites_cut(dyd_sites *s, size_t count);
/* Appends n exact points, number k being (xy[2 k], xy[2 k + 1]); none on failure. */
dyd_status dyd_sites_add_words(dyd_sites *s, size_t n, const dyd_words *xy);
/* The same of rectangles from a lower left to an upper right corner: point 2 k to point 2 k + 1. */
dyd_status dyd_sites_add_word_boxes(dyd_sites *s, size_t n, const dyd_words *corner);
/* The ends x lower, x upper, y lower, y upper of site i; false where one of them is not of single words. */
bool dyd_sites_get_words(dyd_words end[4], const dyd_sites *s, size_t i);
/* As dyd_sites_narrow, for the rectangle [box[0],box[1]] x [box[2],box[3]] of finite doubles, without -0. */
dyd_status dyd_sites_narrow_d(dyd_sites *s, size_t i, const double box[4]);

/* Site i becomes r, even where that is wider: for tables whose owner knows what depends on them. */
dyd_status dyd_sites_replace(dyd_sites *s, size_t i, const dyd_rect *r);

/* Facts about a site besides its rectangle. GIVEN: it was added as an exact one, or in words, and not narrowed since,
 * so that only its maker rounded its ends. Of sites that can be narrowed, BARE: it encloses one place, with no radius
 * about it; ROUND: all within one radius of a place, as [DISC-4] has it. */
typedef enum dyd_site_kind { DYD_SITE_ANY, DYD_SITE_GIVEN, DYD_SITE_BARE, DYD_SITE_ROUND } dyd_site_kind;
/* Sets the kind of n existing sites from i on. DYD_E_NOMEM. */
dyd_status dyd_sites_set_kind(dyd_sites *s, size_t i, size_t n, dyd_site_kind kind);
/* Appends n sites of this kind that hold the whole plane; none on failure. */
dyd_status dyd_sites_add_planes(dyd_sites *s, size_t n, dyd_site_kind kind);
static inline double dyd_sites_lo(const dyd_sites *s, int axis, size_t i) {
  return s->lower[axis][i];
}
static inline double dyd_sites_hi(const dyd_sites *s, int axis, size_t i) {
  return s->upper[axis] ? s->upper[axis][i] : s->lower[axis][i];
}
/* Asks memory for where the exact rectangle of site i is, for loops that visit the sites in another order. */
static inline void dyd_sites_fetch_entry(const dyd_sites *s, size_t i) {
  if (s->exact) __builtin_prefetch(&s->exact[i]);
  if (s->word) __builtin_prefetch(&s->word[i]);
}
/* For that and its doubles. */
static inline void dyd_sites_fetch(const dyd_sites *s, size_t i) {
  for (int a = 0; a < 2; a++) {
    __builtin_prefetch(&s->lower[a][i]);
    if (s->upper[a]) __builtin_prefetch(&s->upper[a][i]);
  }
  dyd_sites_fetch_entry(s, i);
}
/* A while after either: for the exact rectangle, if there is one. */
static inline void dyd_sites_fetch_exact(const dyd_sites *s, size_t i) {
  if (s->exact && s->exact[i]) __builtin_prefetch(s->exact[i]);
}
/* Returns true if every site is certainly a point that is held by doubles, without a test of each. */
static inline bool dyd_sites_are_double_points(const dyd_sites *s) {
  return !s->exact && !s->upper[0] && !s->upper[1];
}
/* Returns true if the ends of site i are in single words. */
static inline bool dyd_sites_in_words(const dyd_sites *s, size_t i) {
  return s->word && s->word[i];
}
static inline dyd_site_kind dyd_sites_kind(const dyd_sites *s, size_t i) {
  const dyd_site_kind kind = i < s->kind_count ? (dyd_site_kind)s->kind[i] : DYD_SITE_ANY;
  return kind == DYD_SITE_ANY && dyd_sites_in_words(s, i) ? DYD_SITE_GIVEN : kind;
}
/* Returns true if the doubles hold the rectangle of site i exactly. */
static inline bool dyd_sites_in_doubles(const dyd_sites *s, size_t i) {
  return (!s->exact || !s->exact[i]) && !dyd_sites_in_words(s, i);
}
/* The same of every site, without a test of each. */
static inline bool dyd_sites_all_in_doubles(const dyd_sites *s) {
  return !s->exact && !s->word;
}

/* Of the ends in words of site i: they are those of a rectangle. */
static inline bool dyd_site_is_word_box(const dyd_sites *s, size_t i) {
  return dyd_sites_in_words(s, i) && s->word[i] & DYD_WORD_BOX;
}
/* dyd_sites_is_point of an existing site, for loops. */
static inline bool dyd_site_is_point(const dyd_sites *s, size_t i) {
  return dyd_sites_in_doubles(s, i)
             ? dyd_sites_lo(s, 0, i) == dyd_sites_hi(s, 0, i) && dyd_sites_lo(s, 1, i) == dyd_sites_hi(s, 1, i)
         : dyd_sites_in_words(s, i)
             ? !dyd_site_is_word_box(s, i)
             : s->exact[i]->size[1] == DYD_SAME_AS_LOWER && s->exact[i]->size[4] == DYD_SAME_AS_LOWER;
}

/* The lowest site joined with site i: i itself where there is none. */
static inline size_t dyd_site_joined(const dyd_sites *s, size_t i) {
  return i < s->joined_count ? s->joined[i] : i;
}
/* The same where there may be no table. */
size_t dyd_sites_joined(const dyd_sites *s, size_t i);
/* Says that the true points of two sites are the same place: the higher number becomes an alias of the lower one, and
 * both get what their rectangles have in common. Transitive. DYD_E_NESTING (nothing changed) when they have nothing in
 * common, DYD_E_ARG when there is no such site. A triangulation follows in dyd_delaunay_update. */
dyd_status dyd_sites_join(dyd_sites *s, size_t i, size_t j);

/* As dyd_engine_add_columns. */
dyd_status dyd_sites_add_columns(dyd_sites *s, size_t n, const dyd_column xy[2], const dyd_column *radius);

#endif
