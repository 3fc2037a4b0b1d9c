/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Objects of one block: initialised where they are declared, cleared when the block is left, whichever way. */
#ifndef DYD_BASE_LOCAL_H
#define DYD_BASE_LOCAL_H

#include <mpfr.h>
#include <stdlib.h>

/* f of each of up to eight arguments, behind `mark`. */
#define DYD_EACH(f, mark, ...) DYD_EACH_OF(__VA_ARGS__, 8, 7, 6, 5, 4, 3, 2, 1, 0)(f, mark, __VA_ARGS__)
#define DYD_EACH_OF(a, b, c, d, e, f, g, h, n, ...) DYD_EACH_##n
#define DYD_EACH_1(f, mark, a) f(mark a)
#define DYD_EACH_2(f, mark, a, ...) f(mark a), DYD_EACH_1(f, mark, __VA_ARGS__)
#define DYD_EACH_3(f, mark, a, ...) f(mark a), DYD_EACH_2(f, mark, __VA_ARGS__)
#define DYD_EACH_4(f, mark, a, ...) f(mark a), DYD_EACH_3(f, mark, __VA_ARGS__)
#define DYD_EACH_5(f, mark, a, ...) f(mark a), DYD_EACH_4(f, mark, __VA_ARGS__)
#define DYD_EACH_6(f, mark, a, ...) f(mark a), DYD_EACH_5(f, mark, __VA_ARGS__)
#define DYD_EACH_7(f, mark, a, ...) f(mark a), DYD_EACH_6(f, mark, __VA_ARGS__)
#define DYD_EACH_8(f, mark, a, ...) f(mark a), DYD_EACH_7(f, mark, __VA_ARGS__)

/* DYD_SCOPED(dyd_pair_list) pairs = {0}; calls dyd_pair_list_clear at the end of the block. DYD_LOCAL(dyd_rect, a, b)
 * declares, and calls dyd_rect_init, too. */
#define DYD_SCOPED(type) __attribute__((cleanup(type##_clear))) type
#define DYD_LOCAL(type, ...)                                                                                           \
  DYD_SCOPED(type) __VA_ARGS__;                                                                                        \
  DYD_EACH(type##_init, &, __VA_ARGS__)

/* Arrays of n objects: DYD_LOCAL_ARRAY(dyd_rect, r, [4]). DYD_ARRAYS(dyd_rect) once, before that. */
#define DYD_ARRAYS(type) DYD_RUNS(type, type##_init, type##_clear, &)
#define DYD_RUNS(type, init, clear, mark)                                                                              \
  typedef struct type##_run {                                                                                          \
    type *item;                                                                                                        \
    size_t count;                                                                                                      \
  } type##_run;                                                                                                        \
  static inline type##_run type##_run_begin(type *item, size_t count) {                                                \
    for (size_t k = 0; k < count; k++) init(mark item[k]);                                                             \
    return (type##_run){item, count};                                                                                  \
  }                                                                                                                    \
  static inline void type##_run_clear(const type##_run *r) {                                                           \
    for (size_t k = 0; k < r->count; k++) clear(mark r->item[k]);                                                      \
  }
#define DYD_LOCAL_ARRAY(type, x, dimensions)                                                                           \
  type x dimensions;                                                                                                   \
  DYD_SCOPED(type##_run) x##_run __attribute__((unused)) = type##_run_begin((type *)x, sizeof x / sizeof(type))

/* Numbers of GMP and its like, which are arrays: DYD_LOCAL_NUMBERS(mpq, a, b), DYD_LOCAL_ARRAY(mpq_t, end, [4]).
 * DYD_NUMBER(mpq) once, before that. */
#define DYD_NUMBER(kind)                                                                                               \
  DYD_RUNS(kind##_t, kind##_init, kind##_clear, )                                                                      \
  static inline void dyd_drop_##kind(kind##_t *x) {                                                                    \
    kind##_clear(*x);                                                                                                  \
  }
#define DYD_LOCAL_NUMBERS(kind, ...)                                                                                   \
  __attribute__((cleanup(dyd_drop_##kind))) kind##_t __VA_ARGS__;                                                      \
  DYD_EACH(kind##_init, , __VA_ARGS__)
DYD_NUMBER(mpz)
DYD_NUMBER(mpq)
DYD_NUMBER(mpfr)

/* DYD_FREED double *x = dyd_alloc(n, sizeof *x); for memory, or NULL. */
#define DYD_FREED __attribute__((cleanup(dyd_drop)))
static inline void dyd_drop(void *place) {
  free(*(void **)place);
}

/* DYD_OWNED(dyd_delaunay) *pd = NULL; calls dyd_delaunay_free. DYD_OWNERS(dyd_delaunay) once, before that. */
#define DYD_OWNERS(type)                                                                                               \
  static inline void type##_drop(type **place) {                                                                       \
    type##_free(*place);                                                                                               \
  }
#define DYD_OWNED(type) __attribute__((cleanup(type##_drop))) type

/* Of this precision. */
#define DYD_LOCAL_FLOATS(bits, ...)                                                                                    \
  __attribute__((cleanup(dyd_drop_mpfr))) mpfr_t __VA_ARGS__;                                                          \
  mpfr_inits2((bits), __VA_ARGS__, (mpfr_ptr)0)

#endif
