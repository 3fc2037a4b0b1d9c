/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The polygons of a cell: in doubles, else in dyadics. */
#include "voronoi/shape.h"

#include "base/alloc.h"
#include "voronoi/outline_filter.h"
#include "voronoi/point_cell.h"
#include "voronoi/polygon.h"

dyd_status dyd_window_init(dyd_window *w, const dyd_rect *rect) {
  const dyd_interval *side[2] = {&rect->x, &rect->y};
  w->rect = rect;
  w->cancel = NULL;
  w->room = NULL;
  w->exact = false;
  for (int a = 0; a < 2; a++) {
    if (mpz_cmp_ui(side[a]->den, 1) != 0 || dyd_dyadic_cmp(&side[a]->lo, &side[a]->hi) >= 0) return DYD_E_ARG;
    w->d[2 * a] = dyd_dyadic_get_d(&side[a]->lo, DYD_UP);
    w->d[2 * a + 1] = dyd_dyadic_get_d(&side[a]->hi, DYD_DOWN);
  }
  return DYD_OK;
}

void dyd_shape_clear(dyd_shape *s) {
  dyd_polygon_list_clear(&s->outer_exact);
  dyd_polygon_clear(&s->inner_exact);
  free(s->inner);
  free(s->outer);
  free(s->fan);
  free(s->fan_box);
  free(s->key);
  free(s->outline);
  *s = (dyd_shape){0};
}

static void shape_empty(dyd_shape *s) {
  s->in_doubles = s->on_grid = s->exact = false;
  dyd_polygon_clear(&s->inner_exact);
  dyd_polygon_list_clear(&s->outer_exact);
}

dyd_status dyd_shape_set_unknown(dyd_shape *s, const dyd_rect *window) {
  enum { CORNERS = 4 };
  shape_empty(s);
  dyd_polygon *p = s->outer_exact.item = calloc(1, sizeof *p);
  if (!p) return DYD_E_NOMEM;
  s->outer_exact.count = 1;
  p->vertex = dyd_alloc(CORNERS, sizeof *p->vertex);
  if (!p->vertex) return DYD_E_NOMEM;
  for (; p->count < CORNERS; p->count++) {
    dyd_point *z = &p->vertex[p->count];
    dyd_point_init(z);
    dyd_dyadic_set(&z->x, p->count == 1 || p->count == 2 ? &window->x.hi : &window->x.lo);
    dyd_dyadic_set(&z->y, p->count >= 2 ? &window->y.hi : &window->y.lo);
  }
  return DYD_OK;
}

dyd_status dyd_shape_clip(bool *done, dyd_shape *s, const dyd_window *w, int64_t bits) {
  uint32_t k = 0;
  while (k < s->outer_count && w->d[0] <= s->outer[k].x && s->outer[k].x <= w->d[1] && w->d[2] <= s->outer[k].y &&
         s->outer[k].y <= w->d[3])
    k++;
  if (k == s->outer_count) return DYD_OK;
  dyd_status st = dyd_shape_inner(&s->inner_exact, s);
  if (st == DYD_OK) st = dyd_shape_outer(&s->outer_exact, s);
  if (st == DYD_OK) st = dyd_polygons_clip(done, &s->outer_exact, w->rect, bits + DYD_CLIP_EXTRA, w->cancel);
  s->in_doubles = s->on_grid = false;
  return st;
}

dyd_status dyd_shape_find(dyd_shape *s, const dyd_delaunay *pd, uint32_t i, const dyd_window *w, int64_t bits) {
  bool done = false;
  shape_empty(s);
  if (dyd_flag_is_set(w->cancel)) return DYD_CANCELLED;
  dyd_status found = dyd_point_cell(&done, s, pd, i, w);
  if (found != DYD_OK || done) return found;
  if (!pd->sk.mesh.no_filter) {
    dyd_status st = dyd_filter_shape(&done, s, pd, pd->sk.vertex[i], w, bits);
    if (st == DYD_OK && !done) {
      st = dyd_filter_polygons(&done, s, pd, i, w, bits);
      if (done) st = dyd_shape_clip(&done, s, w, bits);
    }
    if (st != DYD_OK || done) return st;
  }
  shape_empty(s);
  dyd_status st = dyd_exact_inner(&s->inner_exact, pd, i, w, bits);
  if (st == DYD_OK) st = dyd_exact_outer(&s->outer_exact, pd, i, w, bits);
  return st;
}

/* ---- copies and areas ---- */

static dyd_status polygon_from_doubles(dyd_polygon *out, const dyd_xy *z, uint32_t count) {
  dyd_polygon p = {0};
  p.vertex = dyd_alloc(count, sizeof *p.vertex);
  if (!p.vertex) return DYD_E_NOMEM;
  for (; p.count < count; p.count++) {
    dyd_point_init(&p.vertex[p.count]);
    (void)dyd_dyadic_set_d(&p.vertex[p.count].x, z[p.count].x); /* finite: the filter has compared them */
    (void)dyd_dyadic_set_d(&p.vertex[p.count].y, z[p.count].y);
  }
  *out = p;
  return DYD_OK;
}

dyd_status dyd_shape_inner(dyd_polygon *out, const dyd_shape *s) {
  return s->in_doubles ? polygon_from_doubles(out, s->inner, s->inner_count) : dyd_polygon_copy(out, &s->inner_exact);
}

dyd_status dyd_shape_outer(dyd_polygon_list *out, const dyd_shape *s) {
  dyd_polygon_list list = {0};
  size_t parts = s->in_doubles ? s->outer_count > 0 : s->outer_exact.count;
  list.item = calloc(parts ? parts : 1, sizeof *list.item);
  if (!list.item) return DYD_E_NOMEM;
  dyd_status st = DYD_OK;
  for (; list.count < parts && st == DYD_OK; list.count++)
    st = s->in_doubles ? polygon_from_doubles(&list.item[0], s->outer, s->outer_count)
                       : dyd_polygon_copy(&list.item[list.count], &s->outer_exact.item[list.count]);
  if (st == DYD_OK)
    *out = list;
  else
    dyd_polygon_list_clear(&list);
  return st;
}

static dyd_status polygon_list_area2(dyd_dyadic *out, const dyd_polygon_list *l) {
  dyd_dyadic sum, one;
  dyd_dyadic_init(&sum);
  dyd_dyadic_init(&one);
  dyd_status st = DYD_OK;
  for (size_t k = 0; k < l->count && st == DYD_OK; k++) {
    st = dyd_polygon_area2(&one, &l->item[k]);
    if (st == DYD_OK) st = dyd_dyadic_add(&sum, &sum, &one);
  }
  if (st == DYD_OK) dyd_dyadic_swap(out, &sum);
  dyd_dyadic_clear(&one);
  dyd_dyadic_clear(&sum);
  return st;
}

static dyd_status grid_area_to_dyadic(dyd_dyadic *out, const dyd_grid_area *a) {
  mpz_t n;
  bool minus = a->twice < 0;
  __extension__ unsigned __int128 size = minus ? -(unsigned __int128)a->twice : (unsigned __int128)a->twice;
  mpz_init_set_ui(n, (uint64_t)(size >> 64));
  mpz_mul_2exp(n, n, 64);
  mpz_add_ui(n, n, (uint64_t)size);
  if (minus) mpz_neg(n, n);
  dyd_status st = dyd_dyadic_set_z_2exp(out, n, -2 * (int64_t)a->scale);
  mpz_clear(n);
  return st;
}

dyd_status dyd_shape_area2(dyd_dyadic *out, const dyd_shape *s, bool outer) {
  if (s->on_grid) return grid_area_to_dyadic(out, &s->grid_area[outer]);
  if (!s->in_doubles) return outer ? polygon_list_area2(out, &s->outer_exact) : dyd_polygon_area2(out, &s->inner_exact);
  dyd_polygon p = {0};
  dyd_status st = polygon_from_doubles(&p, outer ? s->outer : s->inner, outer ? s->outer_count : s->inner_count);
  if (st == DYD_OK) st = dyd_polygon_area2(out, &p);
  dyd_polygon_clear(&p);
  return st;
}

/* ---- public ---- */

static dyd_status shape_find_public(dyd_shape *s, const dyd_delaunay *pd, uint32_t i, const dyd_rect *window,
                                    int64_t bits) {
  dyd_window w;
  dyd_room room = dyd_delaunay_room(pd);
  if (i >= pd->sk.n || bits < -DYD_EXP_LIMIT / 4 || bits > DYD_EXP_LIMIT / 4) return DYD_E_ARG;
  dyd_status st = dyd_window_init(&w, window);
  if (st != DYD_OK) return st;
  if (dyd_delaunay_is_capped(pd)) return DYD_CAPPED;
  w.room = &room;
  return dyd_shape_find(s, pd, dyd_delaunay_alias(pd, i), &w, bits);
}

dyd_status dyd_voronoi_inner_polygon(dyd_polygon *out, const dyd_delaunay *pd, uint32_t i, const dyd_rect *window,
                                     int64_t bits) {
  if (!pd) return DYD_E_ARG;
  dyd_shape s = {0};
  dyd_polygon p = {0};
  dyd_status st = shape_find_public(&s, pd, i, window, bits);
  if (st == DYD_OK) st = dyd_shape_inner(&p, &s);
  if (st == DYD_OK) {
    dyd_polygon_clear(out);
    *out = p;
  }
  dyd_shape_clear(&s);
  return st;
}

dyd_status dyd_voronoi_outer_polygon(dyd_polygon_list *out, const dyd_delaunay *pd, uint32_t i, const dyd_rect *window,
                                     int64_t bits) {
  if (!pd) return DYD_E_ARG;
  dyd_shape s = {0};
  dyd_polygon_list l = {0};
  dyd_status st = shape_find_public(&s, pd, i, window, bits);
  if (st == DYD_OK) st = dyd_shape_outer(&l, &s);
  if (st == DYD_OK) {
    dyd_polygon_list_clear(out);
    *out = l;
  }
  dyd_shape_clear(&s);
  return st;
}

dyd_status dyd_voronoi_exact_area(mpq_t out, bool *exact, const dyd_delaunay *pd, uint32_t i, const dyd_rect *window) {
  dyd_shape s = {0};
  dyd_window w;
  if (!pd || i >= pd->sk.n) return DYD_E_ARG;
  dyd_status st = dyd_window_init(&w, window);
  if (st == DYD_OK) st = dyd_point_cell_area(out, exact, &s, pd, dyd_delaunay_alias(pd, i), &w);
  dyd_shape_clear(&s);
  return st;
}
