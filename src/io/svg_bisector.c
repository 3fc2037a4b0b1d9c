/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The picture of a partial bisector.
 *
 * A parabola v(t) between t0 and t1 is the quadratic Bezier curve whose middle point has t = (t0 + t1) / 2 and lies on
 * the tangent at the first end: v = v(t0) + v'(t0) (t1 - t0) / 2. Arcs with an end at infinity are lines. */
#include "io/exact_text.h"
#include "io/svg_pieces.h"
#include <math.h>

/* Corners and the line of an arc in doubles: focus s; corner q, or line of coordinate q[1 - k] along axis k. */
typedef struct shape {
  double s[2], q[2];
  int k;
} shape;

static void box_of(double b[4], const dyd_rect *r) {
  dyd_interval_get_d(&b[0], &b[1], &r->x);
  dyd_interval_get_d(&b[2], &b[3], &r->y);
}

static shape shape_of(const dyd_arc *a, const dyd_rect *const r[2]) {
  double far[4], near[4];
  shape s = {.k = -1};
  box_of(far, r[a->far_site]);
  box_of(near, r[a->near_site]);
  s.s[0] = far[a->corner & 1];
  s.s[1] = far[2 + (a->corner >> 1)];
  if (a->kind == DYD_ARC_PARABOLA) {
    s.k = a->feature < DYD_SIDE_Y0 ? 1 : 0;
    s.q[1 - s.k] = near[a->feature - DYD_SIDE_X0];
  } else {
    s.q[0] = near[a->feature & 1];
    s.q[1] = near[2 + (a->feature >> 1)];
  }
  return s;
}

static void place(double out[2], const dyd_surd_point *p) {
  for (int axis = 0; axis < 2; axis++) {
    double lo, hi;
    dyd_exact_enclose(&lo, &hi, p, axis);
    out[axis] = lo / 2 + hi / 2;
  }
}

static double on_parabola(const shape *s, double t) {
  double h = s->s[1 - s->k] - s->q[1 - s->k], u = t - s->s[s->k];
  return (u * u / h + s->s[1 - s->k] + s->q[1 - s->k]) / 2;
}

static void to(const dyd_canvas *c, const char *before, const shape *s, double t, double v) {
  dyd_canvas_point(c, before, s->k ? v : t, s->k ? t : v);
}

/* Only the part near the picture: far out a thin parabola would leave the range of pixels. */
static void put_parabola(const dyd_canvas *c, const shape *s, const double begin[2], const double end[2]) {
  double h = s->s[1 - s->k] - s->q[1 - s->k], most = sqrt(20 * fabs(h) * (c->width + c->height) / c->scale);
  double t[2] = {begin[s->k], end[s->k]};
  for (int e = 0; e < 2; e++) t[e] = fmax(s->s[s->k] - most, fmin(s->s[s->k] + most, t[e]));
  double v = on_parabola(s, t[0]), slope = (t[0] - s->s[s->k]) / h;
  to(c, "M", s, t[0], v);
  to(c, "Q", s, (t[0] + t[1]) / 2, v + slope * (t[1] - t[0]) / 2);
  to(c, " ", s, t[1], on_parabola(s, t[1]));
}

/* The line through the middle of s and q, from `begin` to `end` (NULL: infinite), with the part far out cut off. */
static void put_line(const dyd_canvas *c, const shape *s, const double *begin, const double *end) {
  double n[2] = {s->q[0] - s->s[0], s->q[1] - s->s[1]}, length = hypot(n[0], n[1]);
  double along[2] = {-n[1] / length, n[0] / length}, middle[2], reach = 10 * (c->width + c->height) / c->scale;
  for (int a = 0; a < 2; a++) middle[a] = s->q[a] / 2 + s->s[a] / 2;
  double t[2] = {-reach, reach};
  const double *ends[2] = {begin, end};
  for (int e = 0; e < 2; e++)
    if (ends[e]) t[e] = (ends[e][0] - middle[0]) * along[0] + (ends[e][1] - middle[1]) * along[1];
  for (int e = 0; e < 2; e++) {
    t[e] = fmax(-reach, fmin(reach, t[e]));
    dyd_canvas_point(c, e ? "L" : "M", middle[0] + t[e] * along[0], middle[1] + t[e] * along[1]);
  }
}

static void put_arc(const dyd_canvas *c, const dyd_arc *a, const dyd_rect *const r[2], const char *colour) {
  shape s = shape_of(a, r);
  double begin[2], end[2];
  bool first = a->begin.kind != DYD_END_INFINITE, last = a->end.kind != DYD_END_INFINITE;
  if (first) place(begin, &a->begin.at);
  if (last) place(end, &a->end.at);
  fprintf(c->out, "<path class=\"%s\" fill=\"none\" stroke=\"%s\" stroke-width=\"2\"%s d=\"",
          a->kind == DYD_ARC_PARABOLA ? "parabola" : "line", colour,
          a->kind == DYD_ARC_PARABOLA ? " stroke-dasharray=\"7 3\"" : "");
  if (a->kind == DYD_ARC_PARABOLA)
    put_parabola(c, &s, begin, end);
  else
    put_line(c, &s, first ? begin : NULL, last ? end : NULL);
  fputs("\"/>\n", c->out);
  if (first) {
    dyd_canvas_put(c, "<circle cx=\"", (begin[0] - c->left) * c->scale);
    dyd_canvas_put(c, "\" cy=\"", (c->top - begin[1]) * c->scale);
    fprintf(c->out, "\" r=\"3.5\" fill=\"%s\"/>\n", colour);
  }
}

/* *box grows by the ends that are not far out. */
static void see_ends(double box[4], const dyd_boundary *b, double reach) {
  double most[4] = {box[0] - reach, box[1] + reach, box[2] - reach, box[3] + reach}, at[2];
  for (size_t m = 0; m < b->count; m++)
    for (size_t k = 0; k < b->chain[m].count; k++) {
      const dyd_arc_end *e = &b->chain[m].arc[k].begin;
      if (e->kind == DYD_END_INFINITE) continue;
      place(at, &e->at);
      for (int a = 0; a < 2; a++) {
        box[2 * a] = fmin(box[2 * a], fmax(most[2 * a], at[a]));
        box[2 * a + 1] = fmax(box[2 * a + 1], fmin(most[2 * a + 1], at[a]));
      }
    }
}

dyd_status dyd_bisector_svg(FILE *out, const dyd_rect *const r[2], const dyd_boundary curve[2]) {
  static const char *const colours[2] = {"#0072b2", "#d55e00"};
  double box[4] = {INFINITY, -INFINITY, INFINITY, -INFINITY};
  dyd_canvas c;
  for (int k = 0; k < 2; k++)
    if (!dyd_canvas_grow(box, r[k])) return DYD_E_RANGE;
  double reach = 2 * fmax(box[1] - box[0], box[3] - box[2]);
  for (int k = 0; k < 2; k++) see_ends(box, &curve[k], reach);
  dyd_status status = dyd_canvas_begin(&c, out, box, 0.1, "Partial bisector");
  if (status < 0) return status;
  for (int k = 0; k < 2; k++)
    for (size_t m = 0; m < curve[k].count; m++)
      for (size_t a = 0; a < curve[k].chain[m].count; a++) put_arc(&c, &curve[k].chain[m].arc[a], r, colours[k]);
  for (size_t k = 0; k < 2; k++) dyd_canvas_rect(&c, r[k], k, k ? "#f6cfae" : "#b3d4e8");
  dyd_canvas_end(&c, curve[0].count ? "surely nearer to 0 (blue) and to 1 (orange) beyond the curves; parabolas dashed"
                                    : "the rectangles meet: nothing is surely nearer to one of them");
  return DYD_OK;
}
