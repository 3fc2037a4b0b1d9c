/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Attacks on discs and half-planes: one more site as near to them as may be, without meeting them, must not change the
 * statements that depend on them [REACH-1] [TILE-1]. */
#include <setjmp.h>
#include <stdarg.h>

#include "tiles/sets.h"

#include <cmocka.h>
#include <float.h>
#include <math.h>

enum { SITES = 14, ATTACKS = 12 };

/* A set with the reaches of its sites. */
typedef struct reach_case {
  sets_case s;
  tile t;
  tiles_view v;
  tiles_reach reach[SITES];
  dyd_pair_status status[SITES][SITES];
  size_t whole; /* regions that are the whole plane */
} reach_case;

static void statuses_of(dyd_pair_status status[SITES][SITES], size_t n, const dyd_engine *e) {
  const dyd_delaunay *pd = dyd_engine_delaunay(e);
  for (uint32_t i = 0; i < n; i++)
    for (uint32_t j = 0; j < n; j++) status[i][j] = dyd_delaunay_status(pd, i, j);
}

static bool is_alias(const reach_case *c, uint32_t i) {
  return dyd_delaunay_alias(dyd_engine_delaunay(c->t.engine), i) != i;
}

static void case_find(reach_case *c, const tiles_job *job, tiles_sites *first, const tiles_sites *none) {
  dyd_error err;
  assert_int_equal(tile_new(&c->t, job, 0, &err), DYD_OK);
  for (size_t i = 0; i < c->s.n; i++) assert_true(tiles_sites_add(first, i, c->s.end[i]));
  assert_int_equal(tile_load(&c->v, &c->t, first, none, &err), DYD_OK);
  assert_int_equal(tile_triangulate(&c->t, &err), DYD_OK);
  statuses_of(c->status, c->s.n, c->t.engine);
  for (uint32_t i = 0; i < c->s.n; i++) {
    tiles_partners p;
    assert_int_equal(tile_partners(&p, &c->t, i, &err), DYD_OK);
    assert_true(tiles_reach_find(&c->reach[i], &c->v, i, &p));
    if (c->reach[i].count && c->reach[i].item[0].r == INFINITY) c->whole++;
  }
}

static void case_clear(reach_case *c, tiles_sites *first) {
  for (size_t i = 0; i < c->s.n; i++) tiles_reach_clear(&c->reach[i]);
  tile_free(&c->t);
  tiles_sites_clear(first);
}

/* A place outside of the item, next to it; the outward directions of a rectangle that has it as its corner. */
static void place_beside(double at[2], const tiles_disc *d, const sets_case *s, test_random *r) {
  const double gap = test_chance(r, 2) ? ldexp(1, -(int)test_below(r, 51)) : ldexp(1, -(int)test_between(r, 44, 51));
  const double a = 6.3 * test_unit(r), *some = s->end[test_below(r, s->n)];
  double ux = cos(a), uy = sin(a);
  if (d->far) {
    double square = d->x * d->x + d->y * d->y, along = d->r - gap * (fabs(d->r) + DBL_MIN);
    double t = (test_unit(r) - 0.5) * ldexp(1, (int)test_between(r, -4, 8)) * fabs(along) / square;
    at[0] = d->x * along / square - d->y * t;
    at[1] = d->y * along / square + d->x * t;
    return;
  }
  if (test_chance(r, 2)) { /* in line with some site */
    double x = some[0] - d->x, y = some[s->dim / 2] - d->y, h = hypot(x, y) * (test_chance(r, 2) ? 1 : -1);
    if (h != 0 && isfinite(h)) ux = x / h, uy = y / h;
  }
  at[0] = d->x + d->r * (1 + gap) * ux;
  at[1] = d->y + d->r * (1 + gap) * uy;
}

/* Within twice the distance of two sites from the first one. */
static void place_about(double at[2], const sets_case *s, test_random *r) {
  const double *a = s->end[test_below(r, s->n)], *b = s->end[test_below(r, s->n)];
  const unsigned y = s->dim / 2;
  double h = 2 * hypot(b[0] - a[0], b[y] - a[y]) * test_unit(r), turn = 6.3 * test_unit(r);
  at[0] = a[0] + h * cos(turn);
  at[1] = a[y] + h * sin(turn);
}

static bool attack_draw(sets_case *s, const reach_case *c, test_random *r) {
  const tiles_reach *reach = &c->reach[test_below(r, c->s.n)];
  double at[2], *end;
  if (reach->count == 0) return false;
  const tiles_disc *d = &reach->item[test_below(r, reach->count)];
  if (d->r == INFINITY) return false;
  if (test_chance(r, 3))
    place_about(at, &c->s, r);
  else
    place_beside(at, d, &c->s, r);
  *s = c->s;
  end = s->end[s->n++];
  for (int k = 0; k < 2; k++) {
    const double more = s->dim == 4 && test_chance(r, 3) ? fabs(d->r) * test_unit(r) : 0;
    const bool up = d->far ? (k ? d->y : d->x) < 0 : at[k] > (k ? d->y : d->x);
    if (s->dim == 2) end[k] = at[k];
    if (s->dim == 4) end[2 * k] = at[k] - (up ? 0 : more);
    if (s->dim == 4) end[2 * k + 1] = at[k] + (up ? more : 0);
  }
  for (unsigned k = 0; k < s->dim; k++)
    if (!isfinite(end[k])) return false;
  return true;
}

static bool is_unmet(const tiles_reach *reach, const tiles_box *box) {
  for (size_t k = 0; k < reach->count; k++)
    if (tiles_disc_may_meet(&reach->item[k], box)) return false;
  return true;
}

/* Returns true if the attack on site i of c succeeds. */
static bool is_changed(const reach_case *c, dyd_pair_status status[SITES][SITES], uint32_t i, bool unmet[SITES]) {
  const size_t n = c->s.n;
  const tiles_box own = tiles_view_box(&c->v, i);
  if (status[i][n] != DYD_ILLEGAL) return true;
  for (size_t j = 0; j < n; j++) {
    const tiles_box other = tiles_view_box(&c->v, j);
    const dyd_pair_status was = c->status[i][j], is = status[i][j];
    if ((was == DYD_ILLEGAL) != (is == DYD_ILLEGAL)) return true;
    if (tiles_box_is_point(&own) && tiles_box_is_point(&other) && was != is) return true;
    if (unmet[j] && was != is) return true;
  }
  return false;
}

static size_t attack(const reach_case *c, test_random *r) {
  sets_case s;
  bool unmet[SITES] = {false};
  size_t count = 0;
  dyd_pair_status status[SITES][SITES];
  if (!attack_draw(&s, c, r)) return 0;
  const double *e = s.end[c->s.n];
  const tiles_box box = s.dim == 2 ? (tiles_box){e[0], e[0], e[1], e[1]} : (tiles_box){e[0], e[1], e[2], e[3]};
  for (uint32_t i = 0; i < c->s.n; i++) count += unmet[i] = !is_alias(c, i) && is_unmet(&c->reach[i], &box);
  dyd_engine *with = count ? sets_engine(&s) : NULL;
  if (!with) return 0;
  statuses_of(status, s.n, with);
  dyd_engine_free(with);
  for (uint32_t i = 0; i < c->s.n; i++)
    if (unmet[i] && is_changed(c, status, i, unmet)) {
      sets_print(&s);
      fail_msg("site %u is not as it was without the last site, which does not meet its reach", i);
    }
  return count;
}

static void test_attacks(void **state) {
  (void)state;
  static const tiles_sites none = {.dim = 2};
  const tiles_job job = {.ranks = 1};
  test_random r = test_random_start("attacks");
  size_t sites = 0, whole = 0, resisted = 0, attacks = 0;
  for (size_t k = 0; k < test_cases(3000); k++) {
    reach_case c = {.whole = 0};
    if (test_chance(&r, 4))
      sets_hidden(&c.s, &r);
    else
      sets_make(&c.s, &r, 1, SITES - 1);
    if (test_chance(&r, 6)) sets_stretch(&c.s, &r);
    tiles_sites first = {.dim = c.s.dim};
    dyd_engine *calm = sets_engine(&c.s);
    if (!calm) continue;
    dyd_engine_free(calm);
    case_find(&c, &job, &first, &none);
    for (int a = 0; a < ATTACKS; a++) resisted += attack(&c, &r);
    attacks += ATTACKS;
    sites += c.s.n;
    whole += c.whole;
    case_clear(&c, &first);
  }
  fprintf(stderr, "# %zu sites, %zu without a chain, %zu attacks, %zu sites not met by one\n", sites, whole, attacks,
          resisted);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_attacks)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
