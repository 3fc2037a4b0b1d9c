/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Orientation and Con of partial points: filters, then integers.
 *
 * A filter answers when every choice in the outward boxes agrees, or, for boxes that are the rectangles themselves,
 * when two choices surely differ. Everything else goes to the exact rung [ORI-1] [CON-1]. */
#include "predicate/icircle.h"
#include "predicate/predicate_filter.h"

/* The four rectangles on a common integer scale. */
static void irects_scaled(dyd_irect *out, const dyd_rect *const *in, size_t n) {
  for (size_t k = 0; k < n; k++) dyd_irect_init(&out[k]);
  dyd_irects_scale(out, in, n, NULL, NULL);
}

static void irects_release(dyd_irect *r, size_t n) {
  while (n-- > 0) dyd_irect_clear(&r[n]);
}

static dyd_sure orient_boxes(const dyd_rect *const abc[3], const dyd_box box[3]) {
  dyd_turns t = dyd_filter_turns(box[0].outer, box[1].outer, box[2].outer);
  if (t.all_left) return DYD_SURE_PLUS;
  if (t.all_right) return DYD_SURE_MINUS;
  if (t.some_left && t.some_right && box[0].exact && box[1].exact && box[2].exact) return DYD_UNSURE;
  dyd_irect r[3];
  irects_scaled(r, abc, 3);
  dyd_sure answer = dyd_irect_orientation(&r[0], &r[1], &r[2]);
  irects_release(r, 3);
  return answer;
}

dyd_sure dyd_orientation(const dyd_rect *a, const dyd_rect *b, const dyd_rect *c) {
  const dyd_rect *abc[3] = {a, b, c};
  dyd_box box[3];
  for (int k = 0; k < 3; k++) dyd_filter_box(&box[k], abc[k]);
  return orient_boxes(abc, box);
}

/* in[0..2]: surely oriented triple, in[3]: the rectangle asked about. */
static dyd_sure con_exact(const dyd_rect *const in[4], dyd_sure orientation) {
  dyd_irect r[4];
  irects_scaled(r, in, 4);
  const dyd_irect *abc[3] = {&r[0], &r[1], &r[2]};
  dyd_sure answer = dyd_irect_con_oriented(&r[3], abc, orientation);
  irects_release(r, 4);
  return answer;
}

dyd_sure dyd_con(const dyd_rect *r, const dyd_rect *a, const dyd_rect *b, const dyd_rect *c) {
  const dyd_rect *in[4] = {a, b, c, r};
  dyd_box box[4];
  bool exact = true;
  for (int k = 0; k < 4; k++) {
    dyd_filter_box(&box[k], in[k]);
    exact = exact && box[k].exact;
  }
  dyd_sure orientation = orient_boxes(in, box);
  if (orientation == DYD_UNSURE) return DYD_UNSURE;
  const double *o[4] = {box[0].outer, box[1].outer, box[2].outer, box[3].outer};
  int sign = (int)dyd_filter_incircle(o[0], o[1], o[2], o[3]) * (int)orientation;
  if (sign) return sign > 0 ? DYD_SURE_PLUS : DYD_SURE_MINUS;
  if (exact && dyd_filter_incircle_mixed(o[0], o[1], o[2], o[3])) return DYD_UNSURE;
  return con_exact(in, orientation);
}
