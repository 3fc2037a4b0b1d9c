/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The picture of a partial bisector: what is surely nearer to the one point, to the other, and the band between.
 *
 * A parabola v(t) between t0 and t1 is the quadratic Bezier curve whose middle point has t = (t0 + t1) / 2 and lies on
 * the tangent at the first end: v = v(t0) + v'(t0) (t1 - t0) / 2. Arcs with an end at infinity are lines. What is
 * surely nearer to a point is convex, and goes on to infinity between the ends of its chain. */
#include "io/decimal.h"
#include "picture/picture.h"
#include <math.h>

#define CURVE 0x0072b2
static const unsigned tint[2] = {0xcfe4f3, 0xd9eccf}, body[2] = {0x6aaed6, 0x8cc27a};

typedef struct bisector_drawing {
  const dyd_rect *const *r;
  const dyd_boundary *curve;
  const dyd_engine *engine;
  dyd_view view;
  double reach; /* arcs are cut off so far from the rectangles: far outside of the picture */
} bisector_drawing;

/* Corners and the line of an arc in doubles: focus s; corner q, or line of coordinate q[1 - k] along axis k. */
typedef struct locus {
  double s[2], q[2];
  int k;
} locus;

/* An arc as it is drawn: ends at[0], at[2], and, of a parabola, the point where the tangents at the ends meet. */
typedef struct piece {
  double at[3][2];
  bool curved;
} piece;

static locus locus_of(const dyd_arc *a, const dyd_rect *const r[2]) {
  double far[4], near[4];
  locus s = {.k = -1};
  dyd_rect_get_d(far, r[a->far_site]);
  dyd_rect_get_d(near, r[a->near_site]);
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

static double on_parabola(const locus *s, double t) {
  double h = s->s[1 - s->k] - s->q[1 - s->k], u = t - s->s[s->k];
  return (u * u / h + s->s[1 - s->k] + s->q[1 - s->k]) / 2;
}

static void parabola_piece(piece *p, const locus *s, const double begin[2], const double end[2], double reach) {
  double h = s->s[1 - s->k] - s->q[1 - s->k], most = sqrt(2 * fabs(h) * reach), t[3] = {begin[s->k], 0, end[s->k]};
  for (int e = 0; e < 3; e += 2) t[e] = fmax(s->s[s->k] - most, fmin(s->s[s->k] + most, t[e]));
  t[1] = t[0] / 2 + t[2] / 2;
  for (int e = 0; e < 3; e++) p->at[e][s->k] = t[e];
  p->at[0][1 - s->k] = on_parabola(s, t[0]);
  p->at[1][1 - s->k] = p->at[0][1 - s->k] + (t[0] - s->s[s->k]) / h * (t[2] - t[0]) / 2;
  p->at[2][1 - s->k] = on_parabola(s, t[2]);
}

/* The line through the middle of s and q, from `begin` to `end` (NULL: infinite). */
static void line_piece(piece *p, const locus *s, const double *begin, const double *end, double reach) {
  double n[2] = {s->q[0] - s->s[0], s->q[1] - s->s[1]}, length = hypot(n[0], n[1]);
  double along[2] = {-n[1] / length, n[0] / length}, middle[2], t[2] = {-reach, reach};
  const double *ends[2] = {begin, end};
  for (int a = 0; a < 2; a++) middle[a] = s->q[a] / 2 + s->s[a] / 2;
  for (int e = 0; e < 2; e++) {
    if (ends[e]) t[e] = (ends[e][0] - middle[0]) * along[0] + (ends[e][1] - middle[1]) * along[1];
    t[e] = fmax(-reach, fmin(reach, t[e]));
    for (int a = 0; a < 2; a++) p->at[2 * e][a] = middle[a] + t[e] * along[a];
  }
}

static piece piece_of(const bisector_drawing *d, const dyd_arc *a) {
  locus s = locus_of(a, d->r);
  piece p = {.curved = a->kind == DYD_ARC_PARABOLA};
  double begin[2], end[2];
  bool first = a->begin.kind != DYD_END_INFINITE, last = a->end.kind != DYD_END_INFINITE;
  if (first) dyd_exact_middle(begin, &a->begin.at);
  if (last) dyd_exact_middle(end, &a->end.at);
  if (p.curved)
    parabola_piece(&p, &s, begin, end, d->reach);
  else
    line_piece(&p, &s, first ? begin : NULL, last ? end : NULL, d->reach);
  return p;
}

/* ---- drawing ---- */

static void line_to(dyd_canvas *c, const dyd_view *v, double x, double y) {
  dyd_canvas_line(c, dyd_view_x(v, x), dyd_view_y(v, y));
}

/* Behind the path so far. The cubic curve of a quadratic one has its inner points two thirds of the way to the middle
 * point. */
static void piece_path(dyd_canvas *c, const dyd_view *v, const piece *p) {
  double inner[2][2];
  line_to(c, v, p->at[0][0], p->at[0][1]);
  if (!p->curved) {
    line_to(c, v, p->at[2][0], p->at[2][1]);
    return;
  }
  for (int e = 0; e < 2; e++)
    for (int a = 0; a < 2; a++) inner[e][a] = p->at[2 * e][a] / 3 + p->at[1][a] * 2 / 3;
  dyd_canvas_curve(c, dyd_view_x(v, inner[0][0]), dyd_view_y(v, inner[0][1]), dyd_view_x(v, inner[1][0]),
                   dyd_view_y(v, inner[1][1]), dyd_view_x(v, p->at[2][0]), dyd_view_y(v, p->at[2][1]));
}

/* What is on the left of the chain, closed far outside of the picture. */
static void fill_left(dyd_canvas *c, const bisector_drawing *d, const dyd_chain *chain, unsigned rgb) {
  piece p = {0};
  double begin[2] = {0}, *end = p.at[2], n[2];
  for (size_t k = 0; k < chain->count; k++) {
    p = piece_of(d, &chain->arc[k]);
    if (k == 0) begin[0] = p.at[0][0], begin[1] = p.at[0][1];
    piece_path(c, &d->view, &p);
  }
  double across[2] = {end[0] - begin[0], end[1] - begin[1]}, length = hypot(across[0], across[1]);
  n[0] = length > 0 ? -across[1] / length * d->reach : 0;
  n[1] = length > 0 ? across[0] / length * d->reach : 0;
  line_to(c, &d->view, end[0] + n[0], end[1] + n[1]);
  line_to(c, &d->view, begin[0] + n[0], begin[1] + n[1]);
  dyd_canvas_close(c);
  dyd_picture_fill(c, rgb);
}

static void draw_arc(dyd_canvas *c, const bisector_drawing *d, const dyd_arc *a, int curve, size_t number) {
  piece p = piece_of(d, a);
  char id[48], title[120];
  snprintf(id, sizeof id, "arc-%d-%zu", curve, number);
  snprintf(title, sizeof title, "%s: the bound of what is surely nearer to %d, piece %zu",
           p.curved ? "parabola" : "line", curve, number);
  dyd_canvas_name(c, id, title);
  piece_path(c, &d->view, &p);
  dyd_picture_stroke(c, CURVE, 1.8, p.curved ? 4 : 0, p.curved ? 2.5 : 0);
}

static void bisector_mark(dyd_canvas *c, double x, double y, dyd_end_kind kind) {
  dyd_picture_dot(c, x, y, 3.5, kind == DYD_END_AXIS ? CURVE : 0xffffff, CURVE);
}

static void draw_ends(dyd_canvas *c, const bisector_drawing *d, const dyd_chain *chain) {
  double limit = 2 * d->reach, at[2];
  for (size_t k = 1; k < chain->count; k++) {
    dyd_exact_middle(at, &chain->arc[k].begin.at);
    if (!(fabs(at[0] - d->view.left) < limit && fabs(at[1] - d->view.top) < limit)) continue;
    bisector_mark(c, dyd_view_x(&d->view, at[0]), dyd_view_y(&d->view, at[1]), chain->arc[k].begin.kind);
  }
}

static void draw_curves(dyd_canvas *c, const bisector_drawing *d) {
  const dyd_chain *chain[2] = {d->curve[0].chain, d->curve[1].chain};
  dyd_view_frame_path(c, &d->view);
  dyd_picture_fill(c, DYD_PICTURE_BAND);
  for (int k = 0; k < 2; k++)
    if (d->curve[k].count) fill_left(c, d, chain[k], tint[k]);
  for (int k = 0; k < 2; k++)
    for (size_t a = 0; d->curve[k].count && a < chain[k]->count; a++) draw_arc(c, d, &chain[k]->arc[a], k, a);
  for (int k = 0; k < 2; k++)
    if (d->curve[k].count) draw_ends(c, d, chain[k]);
}

/* Which kinds of arcs, and of joints, there are. */
static void bisector_kinds(bool arcs[2], bool joints[2], const bisector_drawing *d) {
  for (int k = 0; k < 2; k++)
    for (size_t a = 0; d->curve[k].count && a < d->curve[k].chain->count; a++) {
      const dyd_arc *arc = &d->curve[k].chain->arc[a];
      arcs[arc->kind == DYD_ARC_PARABOLA] = true;
      if (a > 0) joints[arc->begin.kind == DYD_END_AXIS] = true;
    }
}

static void bisector_legend(dyd_canvas *c, void *context) {
  const bisector_drawing *d = context;
  bool arcs[2] = {false, false}, joints[2] = {false, false};
  dyd_legend l;
  dyd_legend_begin(&l, c, &d->view);
  bisector_kinds(arcs, joints, d);
  if (d->curve[0].count) dyd_legend_patch(&l, tint[0], "surely nearer to 0");
  if (d->curve[1].count) dyd_legend_patch(&l, tint[1], "surely nearer to 1");
  dyd_legend_patch(&l, DYD_PICTURE_BAND, "undetermined");
  if (arcs[0]) dyd_legend_line(&l, CURVE, 0, 0, "line");
  if (arcs[1]) dyd_legend_line(&l, CURVE, 4, 2.5, "parabola");
  if (joints[1]) dyd_legend_dot(&l, CURVE, CURVE, "from here on another corner of the one rectangle is farthest");
  if (joints[0]) dyd_legend_dot(&l, 0xffffff, CURVE, "another corner or side of the other is closest");
  if (!d->curve[0].count) dyd_legend_text(&l, "the rectangles meet: nothing is surely nearer to one of them");
}

static void bisector_inside(dyd_canvas *c, void *context) {
  const bisector_drawing *d = context;
  dyd_numbers labels;
  double b[2][4];
  draw_curves(c, d);
  for (size_t k = 0; k < 2; k++) {
    dyd_rect_get_d(b[k], d->r[k]);
    dyd_picture_marked(c, &d->view, b[k], d->engine, k, body[k]);
  }
  if (!dyd_numbers_init(&labels, &d->view)) return;
  for (size_t k = 0; k < 4; k++)
    if (k < 2)
      dyd_numbers_keep_off(&labels, b[k]);
    else
      dyd_numbers_put(&labels, c, b[k - 2], 18, d->engine, k - 2);
  dyd_numbers_clear(&labels);
}

/* *box grows by the ends that are not far out. */
static void see_ends(double box[4], const dyd_boundary *b, double reach) {
  double most[4] = {box[0] - reach, box[1] + reach, box[2] - reach, box[3] + reach}, at[2];
  for (size_t k = 1; b->count && k < b->chain->count; k++) {
    dyd_exact_middle(at, &b->chain->arc[k].begin.at);
    for (int a = 0; a < 2; a++) {
      box[2 * a] = fmin(box[2 * a], fmax(most[2 * a], at[a]));
      box[2 * a + 1] = fmax(box[2 * a + 1], fmin(most[2 * a + 1], at[a]));
    }
  }
}

dyd_status dyd_bisector_picture(const dyd_output *o) {
  const dyd_bisector_output *c = o->what;
  bisector_drawing d = {.r = c->r, .curve = c->curve, .engine = c->engine};
  double box[4] = {INFINITY, -INFINITY, INFINITY, -INFINITY}, see[4];
  dyd_status st = DYD_OK;
  for (int k = 0; k < 2 && st == DYD_OK; k++) st = dyd_view_grow(box, d.r[k], o->err);
  if (st != DYD_OK) return st;
  for (int e = 0; e < 4; e++) see[e] = box[e];
  for (int k = 0; k < 2; k++) see_ends(see, &d.curve[k], fmax(box[1] - box[0], box[3] - box[2]));
  dyd_view_pad(see);
  st = dyd_view_fit(&d.view, see, 0, o->err);
  if (st != DYD_OK) return st;
  d.reach = 10 * (d.view.width + d.view.height) / d.view.scale;
  return dyd_view_write(o, &d.view, "partial bisector", bisector_inside, bisector_legend, &d);
}
