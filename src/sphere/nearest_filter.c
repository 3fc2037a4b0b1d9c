/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Which places may be nearest to a place, as far as doubles tell [SPH-6]: an index, sorted by the height z of places
 * over the plane of the equator.
 *
 * A region is within a chord `reach` of its middle; middles are at most SLACK off, which is more than 8 * 2^-50 from
 * turns [FLT-SPH] and a product, and more than the rounding of what follows. So chords between points of two regions
 * are within the sum of their reaches and 2 SLACK of the one between their middles, and |z - z'| is not above it. */
#include "base/alloc.h"
#include "base/error.h"
#include "base/index.h"
#include "sphere/state.h"

#define SLACK 0x1p-44
#define RADIANS_ABOVE 0.017453292519943298

typedef struct middle {
  double at[3], reach;
  uint32_t place;
} middle;

struct dyd_near_index {
  middle *item;
  size_t count;
  double widest; /* reach */
};

/* Half of the side, and more. */
static double half_above(const double side[2], double mid) {
  return dyd_up(fmax(side[1] - mid, mid - side[0]) * RADIANS_ABOVE);
}

static dyd_iv middle_turn(dyd_iv *cos, double degrees) {
  dyd_iv sin;
  if (!dyd_filter_sin_cos(&sin, cos, (dyd_iv){degrees, degrees})) sin = *cos = (dyd_iv){-1, 1};
  return sin;
}

static void middle_set(middle *out, const dyd_spot_d *p, uint32_t place) {
  const double lon = (p->box[0] + p->box[1]) / 2, lat = (p->box[2] + p->box[3]) / 2;
  dyd_iv cl, cf, sl = middle_turn(&cl, lon), sf = middle_turn(&cf, lat);
  const dyd_iv v[3] = {dyd_iv_mul(cf, cl), dyd_iv_mul(cf, sl), sf};
  double up = half_above(p->box + 2, lat), along = half_above(p->box, lon) * fmin(1, fmax(cf.hi, 0) + up);
  out->place = place;
  out->reach = dyd_spot_d_is_tight(p) ? 0 : (up + along + p->angle) * (1 + 0x1p-40);
  for (int a = 0; a < 3; a++) {
    out->at[a] = (v[a].lo + v[a].hi) / 2;
    if (v[a].hi - v[a].lo > SLACK / 4) out->reach = 4;
  }
}

static int compare_middles(const void *a, const void *b) {
  const middle *x = a, *y = b;
  return (x->at[2] > y->at[2]) - (x->at[2] < y->at[2]);
}

void dyd_near_index_free(dyd_near_index *index) {
  if (index) free(index->item);
  free(index);
}

static dyd_status index_make(dyd_near_index **out, const dyd_sphere *s, dyd_error *err) {
  dyd_status st = DYD_OK;
  dyd_near_index *x = calloc(1, sizeof *x);
  if (x) x->item = dyd_alloc(s->count, sizeof *x->item);
  if (!x || !x->item) st = dyd_fail_nomem(err);
  for (uint32_t i = 0; i < s->count && st == DYD_OK; i++) {
    dyd_spot_d p;
    if (s->alias[i] != i) continue;
    st = dyd_sphere_spot_d(&p, s, i, err);
    if (st != DYD_OK) break;
    middle_set(&x->item[x->count++], &p, i);
    x->widest = fmax(x->widest, x->item[x->count - 1].reach);
  }
  if (st == DYD_OK) qsort(x->item, x->count, sizeof *x->item, compare_middles);
  if (st == DYD_OK)
    *out = x;
  else
    dyd_near_index_free(x);
  return st;
}

static double chord(const middle *a, const middle *b) {
  double x = a->at[0] - b->at[0], y = a->at[1] - b->at[1], z = a->at[2] - b->at[2];
  return sqrt(x * x + y * y + z * z);
}

/* The first that is not below. */
static size_t index_find(const dyd_near_index *x, double z) {
  size_t lo = 0, hi = x->count;
  while (lo < hi) {
    size_t mid = lo + (hi - lo) / 2;
    if (x->item[mid].at[2] < z)
      lo = mid + 1;
    else
      hi = mid;
  }
  return lo;
}

/* The least of chord and reach: those above and below the place in turn, as long as their heights may be as near. */
static double index_least(const dyd_near_index *x, const middle *here) {
  size_t up = index_find(x, here->at[2]), down = up;
  double least = HUGE_VAL;
  for (bool more = true; more;) {
    more = false;
    if (up < x->count && x->item[up].at[2] - here->at[2] <= least) {
      least = fmin(least, chord(&x->item[up], here) + x->item[up].reach);
      up++;
      more = true;
    }
    if (down > 0 && here->at[2] - x->item[down - 1].at[2] <= least) {
      down--;
      least = fmin(least, chord(&x->item[down], here) + x->item[down].reach);
      more = true;
    }
  }
  return least;
}

dyd_status dyd_sphere_near(dyd_index_list *out, dyd_sphere *s, const dyd_spot_d *at, dyd_error *err) {
  dyd_status st = s->near ? DYD_OK : index_make(&s->near, s, err);
  middle here;
  if (st != DYD_OK) return st;
  const dyd_near_index *x = s->near;
  middle_set(&here, at, DYD_NO_PLACE);
  double most = index_least(x, &here) + 2 * here.reach + 8 * SLACK, high = most + x->widest;
  size_t from = index_find(x, here.at[2] - high), to = index_find(x, here.at[2] + high), n = 0;
  while (to < x->count && x->item[to].at[2] <= here.at[2] + high) to++;
  uint32_t *item = dyd_alloc(to - from, sizeof *item);
  if (!item) return dyd_fail_nomem(err);
  for (size_t k = from; k < to; k++)
    if (chord(&x->item[k], &here) - x->item[k].reach <= most) item[n++] = x->item[k].place;
  qsort(item, n, sizeof *item, dyd_compare_index);
  dyd_index_list_clear(out);
  *out = (dyd_index_list){n, item};
  return DYD_OK;
}
