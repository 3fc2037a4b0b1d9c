/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Whose rectangles meet a disc: the tree of boxes visits all candidates [FLT-DST]; each is then tested exactly. */
#include "delaunay/disc_filter.h"

#include "delaunay/index_list.h"
#include "delaunay/state.h"
#include "rect/rect.h"
#include "skeleton/rects_filter.h"

#include <math.h>
#include <stdlib.h>

typedef struct disc_query {
  const dyd_delaunay *pd;
  const dyd_point *c;
  mpq_srcptr radius2;
  mpq_t ds2;
  dyd_rect rect;
  dyd_index_list met;
  size_t cap;
  dyd_status status;
} disc_query;

static bool disc_visit(void *context, uint32_t v) {
  disc_query *d = context;
  dyd_rects_get(&d->rect, &d->pd->sk.rects, v);
  dyd_rect_ds2(d->ds2, d->c, &d->rect);
  if (mpq_cmp(d->ds2, d->radius2) > 0) return true;
  d->status = dyd_index_list_add(&d->met, &d->cap, &d->pd->sk.reps.site[v], 1);
  return d->status == DYD_OK;
}

static void disc_visit_all(disc_query *d) {
  const dyd_skeleton *sk = &d->pd->sk;
  for (uint32_t i = 0; i < sk->n; i++)
    if (sk->reps.site[sk->vertex[i]] == i && !disc_visit(d, sk->vertex[i])) return;
}

dyd_status dyd_delaunay_meet_disc(dyd_index_list *out, const dyd_delaunay *pd, const dyd_point *c,
                                  const mpq_t radius2) {
  disc_query d = {.pd = pd, .c = c, .radius2 = radius2};
  mpq_init(d.ds2);
  dyd_rect_init(&d.rect);
  if (pd->sk.rects.box) {
    const dyd_bbox centre = dyd_point_box(c);
    double above = nextafter(mpq_get_d(radius2), HUGE_VAL); /* mpq_get_d cuts off */
    dyd_tree_near(&pd->sk.rects.tree, &centre, &above, disc_visit, &d);
  } else {
    disc_visit_all(&d);
  }
  mpq_clear(d.ds2);
  dyd_rect_clear(&d.rect);
  dyd_index_list_sort(&d.met);
  dyd_index_list_clear(d.status == DYD_OK ? out : &d.met);
  if (d.status == DYD_OK) *out = d.met;
  return d.status;
}
