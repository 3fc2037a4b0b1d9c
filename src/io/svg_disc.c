/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The picture of a partial disc: the six critical circles, I shaded, the vertices of the partial centre, the others. */
#include "io/exact_text.h"
#include "io/svg_pieces.h"
#include <math.h>

enum { CIRCLES = 6, F_ONCE = 3 };

/* Centre and radius in doubles. */
static void place(double out[3], const dyd_circle *k) {
  dyd_surd_point p;
  double lo, hi;
  dyd_surd_point_init(&p);
  mpz_set(p.ax, k->ax);
  mpz_set(p.bx, k->bx);
  mpz_set(p.ay, k->ay);
  mpz_set(p.by, k->by);
  mpz_set(p.c, k->c);
  mpz_set(p.d, k->d);
  for (int axis = 0; axis < 2; axis++) {
    dyd_exact_enclose(&lo, &hi, &p, axis);
    out[axis] = lo / 2 + hi / 2;
  }
  mpz_set(p.ax, k->ar);
  mpz_set(p.bx, k->br);
  mpz_set(p.d, k->dr);
  dyd_exact_enclose_root(&lo, &hi, &p);
  out[2] = lo / 2 + hi / 2;
  dyd_surd_point_clear(&p);
}

static void put_circle(const dyd_canvas *c, const double at[3], double radius, const char *rest) {
  dyd_canvas_put(c, "<circle cx=\"", (at[0] - c->left) * c->scale);
  dyd_canvas_put(c, "\" cy=\"", (c->top - at[1]) * c->scale);
  dyd_canvas_put(c, "\" r=\"", radius);
  fprintf(c->out, "\" %s/>\n", rest);
}

/* I: one disc clipped by the two others. */
static void put_inside(const dyd_canvas *c, double at[CIRCLES][3]) {
  for (int k = 0; k < 2; k++) {
    fprintf(c->out, "<clipPath id=\"disc%d\">", k);
    put_circle(c, at[k], at[k][2] * c->scale, "");
    fputs("</clipPath>\n", c->out);
  }
  fputs("<g clip-path=\"url(#disc0)\"><g clip-path=\"url(#disc1)\">\n", c->out);
  put_circle(c, at[2], at[2][2] * c->scale, "id=\"inside\" fill=\"#b3d4e8\"");
  fputs("</g></g>\n", c->out);
}

static void put_circles(const dyd_canvas *c, double at[CIRCLES][3]) {
  put_inside(c, at);
  for (int k = 0; k < CIRCLES; k++)
    put_circle(c, at[k], at[k][2] * c->scale,
               k < F_ONCE ? "fill=\"none\" stroke=\"#0072b2\" stroke-width=\"1.5\""
                          : "fill=\"none\" stroke=\"#d55e00\" stroke-width=\"1.5\" stroke-dasharray=\"7 3\"");
  for (int k = 0; k < CIRCLES; k++) put_circle(c, at[k], 3, k < F_ONCE ? "fill=\"#0072b2\"" : "fill=\"#d55e00\"");
}

/* The circles, cut at ten times the size of the rectangles around them. */
static bool see_circles(double box[4], double at[CIRCLES][3]) {
  double reach = 10 * fmax(box[1] - box[0], box[3] - box[2]);
  double most[4] = {box[0] - reach, box[1] + reach, box[2] - reach, box[3] + reach};
  for (int k = 0; k < CIRCLES; k++) {
    if (!isfinite(at[k][0]) || !isfinite(at[k][1]) || !isfinite(at[k][2])) return false;
    for (int e = 0; e < 4; e++) {
      double end = at[k][e >> 1] + (e & 1 ? at[k][2] : -at[k][2]);
      box[e] = e & 1 ? fmax(box[e], fmin(end, most[e])) : fmin(box[e], fmax(end, most[e]));
    }
  }
  return true;
}

static const char *colour_of(dyd_sure con) {
  return con == DYD_SURE_PLUS ? "#0072b2" : con == DYD_SURE_MINUS ? "#d55e00" : "#bbb";
}

dyd_status dyd_disc_svg(FILE *out, const dyd_partial_disc *d, const dyd_rect *const *r, size_t n) {
  double box[4] = {INFINITY, -INFINITY, INFINITY, -INFINITY}, at[CIRCLES][3];
  dyd_canvas c;
  for (size_t i = 0; i < n; i++)
    if (!dyd_canvas_grow(box, r[i])) return DYD_E_RANGE;
  for (int k = 0; k < CIRCLES && d->known; k++) place(at[k], &d->circle[k]);
  if (d->known && !see_circles(box, at)) return DYD_E_RANGE;
  dyd_status status = dyd_canvas_begin(&c, out, box, 0.05, "Partial disc");
  if (status < 0) return status;
  if (d->known) put_circles(&c, at);
  for (size_t i = 0; i < n; i++)
    dyd_canvas_rect(&c, r[i], i, i < 3 ? "#e69f00" : colour_of(dyd_partial_disc_con(d, r[i])));
  dyd_canvas_end(&c, d->known ? "shaded: surely inside, bounded by the F-once circles (solid); beyond the F-twice "
                                "circles (dashed): surely outside"
                              : "the three points may be on a line: there is no partial disc");
  return DYD_OK;
}
