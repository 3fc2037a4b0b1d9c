/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Does a rectangle hold the image of a place, seen from the eye? [CERT-14]
 *
 * With d the longitude from the eye, f and f0 the latitudes, the place has the coordinates
 *     X = cos f sin d,  Y = sin f cos f0 - cos f sin f0 cos d,  C = sin f sin f0 + cos f cos f0 cos d
 * to the east, to the north and towards the eye, and what is within an angle a of it goes to the disc with centre (X,
 * Y) / E and radius sin a / E, E = cos a - C, as long as E > 0 [SPH-2]. So a side x >= m of the rectangle asks for X -
 * m E - sin a >= 0, and there are four such forms and E > 0, over a box of d, f and f0. Where the derivative of a form
 * has one sign over the box, its least value is at an end; where it has not, its value at the middle is off by at most
 * the greatest slope times half the width. A box that is too wide for this is cut in two. */
#include "checker/image.h"

#include "base/local.h"
#include "checker/algebra.h"

enum { FIRST_PRECISION = 128, MOST_DEPTH = 64 * DYD_CERT_ANGLES, FORMS = 5, DISTANCE = 4 };

/* ---- sums of products ---- */

typedef enum factor { COS_D, SIN_D, COS_F, SIN_F, COS_0, SIN_0, ONE } factor;
typedef struct product {
  int sign; /* 0: none */
  factor of[3];
} product;

/* X, Y and E but for cos a; then their derivatives by d, f and f0. */
static const product sums[1 + DYD_CERT_ANGLES][3][2] = {
    {{{1, {COS_F, SIN_D, ONE}}},
     {{1, {SIN_F, COS_0, ONE}}, {-1, {COS_F, SIN_0, COS_D}}},
     {{-1, {SIN_F, SIN_0, ONE}}, {-1, {COS_F, COS_0, COS_D}}}},
    {{{1, {COS_F, COS_D, ONE}}}, {{1, {COS_F, SIN_0, SIN_D}}}, {{1, {COS_F, COS_0, SIN_D}}}},
    {{{-1, {SIN_F, SIN_D, ONE}}},
     {{1, {COS_F, COS_0, ONE}}, {1, {SIN_F, SIN_0, COS_D}}},
     {{1, {SIN_F, COS_0, COS_D}}, {-1, {COS_F, SIN_0, ONE}}}},
    {{{0, {ONE, ONE, ONE}}},
     {{-1, {SIN_F, SIN_0, ONE}}, {-1, {COS_F, COS_0, COS_D}}},
     {{-1, {SIN_F, COS_0, ONE}}, {1, {COS_F, SIN_0, COS_D}}}}};

/* X, Y, E; or derivatives. */
typedef struct values {
  dyd_cert_enclosure of[3];
} values;

static void values_init(values *v) {
  for (int k = 0; k < 3; k++) dyd_cert_enclosure_init(&v->of[k]);
}

static void values_clear(values *v) {
  for (int k = 0; k < 3; k++) dyd_cert_enclosure_clear(&v->of[k]);
}

static void add_trig_product(dyd_cert_enclosure *out, const product *t, const dyd_cert_trig *const at[DYD_CERT_ANGLES],
                             long p) {
  if (!t->sign) return;
  DYD_LOCAL(dyd_cert_enclosure, x);
  for (int k = 0; k < 3; k++) {
    if (t->of[k] == ONE) continue;
    const dyd_cert_trig *of = at[t->of[k] / 2];
    const dyd_cert_enclosure *y = t->of[k] % 2 ? &of->s : &of->c;
    k ? dyd_cert_enclosure_mul(&x, y, p) : dyd_cert_enclosure_set(&x, y);
  }
  (t->sign > 0 ? dyd_cert_enclosure_add : dyd_cert_enclosure_sub)(out, &x);
}

/* row: of the sums above. */
static void values_set(values *v, int row, const dyd_cert_trig *const at[DYD_CERT_ANGLES], long p) {
  for (int k = 0; k < 3; k++) {
    dyd_cert_enclosure_set_si(&v->of[k], 0, p);
    for (int t = 0; t < 2; t++) add_trig_product(&v->of[k], &sums[row][k][t], at, p);
  }
}

/* out = the form, of values or of derivatives, without sin a. */
static void form_set(dyd_cert_enclosure *out, int form, const values *v, const dyd_cert_lens *g) {
  dyd_cert_enclosure_set(out, &v->of[2]);
  if (form == DISTANCE) return;
  int axis = form / 2, upper = form % 2;
  dyd_cert_enclosure_mul(out, &g->side[axis][upper], g->p);
  dyd_cert_enclosure_sub(out, &v->of[axis]);
  if (!upper) dyd_cert_enclosure_neg(out);
}

/* ---- an angle over a part ---- */

static void angle_span_init(dyd_cert_angle_span *v) {
  mpq_inits(v->mid, v->half, NULL);
  mpz_init(v->reach);
  for (int k = 0; k < DYD_CERT_ENDS; k++) dyd_cert_trig_init(&v->at[k]);
  dyd_cert_trig_init(&v->over);
  v->p = 0;
}

static void angle_span_clear(dyd_cert_angle_span *v) {
  dyd_cert_trig_clear(&v->over);
  for (int k = 0; k < DYD_CERT_ENDS; k++) dyd_cert_trig_clear(&v->at[k]);
  mpz_clear(v->reach);
  mpq_clears(v->mid, v->half, NULL);
}

static const dyd_cert_trig *span_at(dyd_cert_angle_span *v, int end, const dyd_cert_lens *g) {
  if (v->known[end]) return &v->at[end];
  DYD_LOCAL_NUMBERS(mpq, q);
  mpq_set(q, v->mid);
  if (end == DYD_CERT_LOW) mpq_sub(q, q, v->half);
  if (end == DYD_CERT_UPPER) mpq_add(q, q, v->half);
  dyd_cert_trig_of_degrees(&v->at[end], q, &g->pi, g->p);
  v->known[end] = true;
  return &v->at[end];
}

/* x becomes wider by reach on both sides, within [-1, 1]. */
static void widen(dyd_cert_enclosure *x, mpz_srcptr reach, long p) {
  DYD_LOCAL(dyd_cert_enclosure, one);
  mpz_sub(x->lo, x->lo, reach);
  mpz_add(x->hi, x->hi, reach);
  dyd_cert_enclosure_set_si(&one, 1, p);
  dyd_cert_enclosure_extreme(x, -1, &one);
  dyd_cert_enclosure_neg(&one);
  dyd_cert_enclosure_extreme(x, 1, &one);
}

static void span_set(dyd_cert_angle_span *v, mpq_srcptr mid, mpq_srcptr half, const dyd_cert_lens *g) {
  if (v->p == g->p && mpq_equal(v->mid, mid) && mpq_equal(v->half, half)) return;
  mpq_set(v->mid, mid);
  mpq_set(v->half, half);
  v->p = g->p;
  for (int k = 0; k < DYD_CERT_ENDS; k++) v->known[k] = false;
  const dyd_cert_trig *middle = span_at(v, DYD_CERT_MIDDLE, g);
  dyd_cert_enclosure_set(&v->over.c, &middle->c);
  dyd_cert_enclosure_set(&v->over.s, &middle->s);
  mpz_set_ui(v->reach, 0);
  if (!mpq_sgn(half)) return;
  DYD_LOCAL(dyd_cert_enclosure, x);
  dyd_cert_radians(&x, half, &g->pi, g->p);
  mpz_set(v->reach, x.hi);
  widen(&v->over.c, v->reach, g->p);
  widen(&v->over.s, v->reach, g->p);
}

/* ---- a part ---- */

/* Of one form: at which end of each angle it is looked at, and by how much it may be less elsewhere. */
typedef struct descent {
  int end[DYD_CERT_ANGLES];
  mpz_t loss;
  bool known;
} descent;

/* The slope of the form by angle k is known over the part. */
static void descend(descent *to, int k, const dyd_cert_enclosure *slope, const dyd_cert_lens *g) {
  to->end[k] = DYD_CERT_LOW;
  if (slope->known && mpz_sgn(slope->lo) >= 0) return;
  to->end[k] = DYD_CERT_UPPER;
  if (slope->known && mpz_sgn(slope->hi) <= 0) return;
  to->end[k] = DYD_CERT_MIDDLE;
  to->known = to->known && slope->known;
  DYD_LOCAL_NUMBERS(mpz, t);
  mpz_abs(t, mpz_cmpabs(slope->lo, slope->hi) > 0 ? slope->lo : slope->hi);
  mpz_mul(t, t, g->span[k].reach);
  mpz_cdiv_q_2exp(t, t, (mp_bitcnt_t)g->p);
  mpz_add(to->loss, to->loss, t);
}

/* Sets where each form is looked at. */
static void descents_set(descent to[FORMS], dyd_cert_lens *g) {
  const dyd_cert_trig *const over[DYD_CERT_ANGLES] = {&g->span[0].over, &g->span[1].over, &g->span[2].over};
  DYD_LOCAL(values, slopes);
  DYD_LOCAL(dyd_cert_enclosure, slope);
  for (int k = 0; k < DYD_CERT_ANGLES; k++) {
    for (int form = 0; form < FORMS; form++) to[form].end[k] = DYD_CERT_MIDDLE;
    if (!mpq_sgn(g->span[k].half)) continue;
    values_set(&slopes, 1 + k, over, g->p);
    for (int form = 0; form < FORMS; form++) {
      form_set(&slope, form, &slopes, g);
      descend(&to[form], k, &slope, g);
    }
  }
}

/* What is known of a form over a part: FINER: more digits would tell more; CUT: smaller parts. */
typedef enum verdict { HOLDS, FAILS, FINER, CUT } verdict;

static verdict form_judge(const descent *to, int form, dyd_cert_lens *g) {
  const dyd_cert_trig *at[DYD_CERT_ANGLES];
  for (int k = 0; k < DYD_CERT_ANGLES; k++) at[k] = span_at(&g->span[k], to->end[k], g);
  DYD_LOCAL(values, v);
  DYD_LOCAL(dyd_cert_enclosure, x);
  values_set(&v, 0, at, g->p);
  dyd_cert_enclosure_add(&v.of[2], &g->cap.c);
  form_set(&x, form, &v, g);
  if (form != DISTANCE) dyd_cert_enclosure_sub(&x, &g->cap.s);
  int least = form == DISTANCE; /* it has to be above 0 */
  verdict found = !to->known || !x.known || mpz_sgn(x.lo) < least ? FINER : HOLDS;
  if (x.known && mpz_sgn(x.hi) < least) found = FAILS;
  if (found == HOLDS) {
    mpz_sub(x.lo, x.lo, to->loss);
    if (mpz_sgn(x.lo) < least) found = CUT;
  }
  return found;
}

/* The forms of *forms that hold are taken out of it. */
static verdict part_judge(unsigned *forms, dyd_cert_lens *g) {
  descent to[FORMS];
  verdict found = HOLDS;
  for (int form = 0; form < FORMS; form++) mpz_init(to[form].loss), to[form].known = true;
  descents_set(to, g);
  for (int form = 0; form < FORMS && (found == HOLDS || found == CUT); form++) {
    if (!(*forms & 1U << form)) continue;
    verdict of = form_judge(&to[form], form, g);
    if (of == HOLDS)
      *forms &= ~(1U << form);
    else
      found = of;
  }
  for (int form = 0; form < FORMS; form++) mpz_clear(to[form].loss);
  return found;
}

/* ---- parts ---- */

typedef struct part {
  mpq_t mid[DYD_CERT_ANGLES], half[DYD_CERT_ANGLES];
} part;

static void view_part_init(part *a) {
  for (int k = 0; k < DYD_CERT_ANGLES; k++) mpq_inits(a->mid[k], a->half[k], NULL);
}

static void view_part_clear(part *a) {
  for (int k = 0; k < DYD_CERT_ANGLES; k++) mpq_clears(a->mid[k], a->half[k], NULL);
}

/* *out is one half of a, across angle k. */
static void part_cut(part *out, const part *a, int k, bool upper) {
  for (int j = 0; j < DYD_CERT_ANGLES; j++) {
    mpq_set(out->mid[j], a->mid[j]);
    mpq_set(out->half[j], a->half[j]);
  }
  mpq_div_2exp(out->half[k], out->half[k], 1);
  (upper ? mpq_add : mpq_sub)(out->mid[k], out->mid[k], out->half[k]);
}

/* Of the forms given. *out is CUT where it has been cut too often. */
static verdict part_prove(dyd_cert_lens *g, const part *a, unsigned forms, int depth) {
  part half;
  int widest = 0;
  if (g->pieces == 0 || depth == MOST_DEPTH) return CUT;
  g->pieces--;
  for (int k = 0; k < DYD_CERT_ANGLES; k++) {
    span_set(&g->span[k], a->mid[k], a->half[k], g);
    if (mpq_cmp(a->half[k], a->half[widest]) > 0) widest = k;
  }
  verdict found = part_judge(&forms, g);
  if (found != CUT) return found;
  view_part_init(&half);
  part_cut(&half, a, widest, false);
  found = part_prove(g, &half, forms, depth + 1);
  part_cut(&half, a, widest, true);
  if (found == HOLDS) found = part_prove(g, &half, forms, depth + 1);
  view_part_clear(&half);
  return found;
}

/* ---- a region ---- */

void dyd_cert_lens_init(dyd_cert_lens *g) {
  dyd_cert_region_init(&g->eye);
  dyd_cert_enclosure_init(&g->pi);
  for (int k = 0; k < DYD_CERT_ANGLES; k++) angle_span_init(&g->span[k]);
  dyd_cert_trig_init(&g->cap);
  for (int k = 0; k < 4; k++) dyd_cert_enclosure_init(&g->side[k / 2][k % 2]);
  g->p = 0;
  g->pieces = 0;
}

void dyd_cert_lens_clear(dyd_cert_lens *g) {
  for (int k = 0; k < 4; k++) dyd_cert_enclosure_clear(&g->side[k / 2][k % 2]);
  dyd_cert_trig_clear(&g->cap);
  for (int k = 0; k < DYD_CERT_ANGLES; k++) angle_span_clear(&g->span[k]);
  dyd_cert_enclosure_clear(&g->pi);
  dyd_cert_region_clear(&g->eye);
}

static void lens_focus(dyd_cert_lens *g, const dyd_cert_region *place, const dyd_cert_side rect[2], long p) {
  DYD_LOCAL_NUMBERS(mpq, end);
  if (g->p != p) dyd_cert_enclosure_pi(&g->pi, p);
  g->p = p;
  dyd_cert_trig_of_radians(&g->cap, place->angle, p);
  for (int axis = 0; axis < 2; axis++) {
    dyd_cert_exact_to_q(end, &rect[axis].lo, dyd_cert_den(&rect[axis]));
    dyd_cert_enclosure_set_q(&g->side[axis][0], mpq_numref(end), mpq_denref(end), p);
    dyd_cert_exact_to_q(end, dyd_cert_high(&rect[axis]), dyd_cert_den(&rect[axis]));
    dyd_cert_enclosure_set_q(&g->side[axis][1], mpq_numref(end), mpq_denref(end), p);
  }
}

dyd_cert_holds dyd_cert_image_in(dyd_cert_lens *g, const dyd_cert_region *place, const dyd_cert_side rect[2]) {
  part all;
  verdict found = FINER;
  view_part_init(&all);
  mpq_sub(all.mid[0], place->mid[0], g->eye.mid[0]);
  mpq_add(all.half[0], place->half[0], g->eye.half[0]);
  mpq_set(all.mid[1], place->mid[1]);
  mpq_set(all.half[1], place->half[1]);
  mpq_set(all.mid[2], g->eye.mid[1]);
  mpq_set(all.half[2], g->eye.half[1]);
  for (long p = FIRST_PRECISION; p <= DYD_CERT_PRECISION && found == FINER; p *= 2) {
    lens_focus(g, place, rect, p);
    found = part_prove(g, &all, (1U << FORMS) - 1, 0);
  }
  view_part_clear(&all);
  return found == HOLDS ? DYD_CERT_YES : found == FAILS ? DYD_CERT_NO : DYD_CERT_OPEN;
}
