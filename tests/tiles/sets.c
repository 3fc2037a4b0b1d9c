/* SPDX-License-Identifier: LGPL-3.0-or-later */
#include "tiles/sets.h"

#include <float.h>
#include <math.h>

/* ---- places ---- */

typedef struct sets_shape {
  unsigned kind;
  double at[2], size, turn;
} sets_shape;

static double signed_unit(test_random *r) {
  return 2 * test_unit(r) - 1;
}

/* 1, or less by a power of two. */
static double small(test_random *r, unsigned most) {
  return ldexp(1, -(int)test_below(r, most + 1));
}

static sets_shape shape_draw(test_random *r) {
  sets_shape s = {.kind = (unsigned)test_below(r, 8), .at = {signed_unit(r), signed_unit(r)}, .turn = signed_unit(r)};
  s.size = small(r, test_chance(r, 4) ? 20 : 4);
  if (test_chance(r, 3)) s.at[0] = s.at[1] = 0;
  return s;
}

static void shape_place(double p[2], const sets_shape *s, test_random *r) {
  double t = signed_unit(r), u = signed_unit(r), round = 3.2 * t;
  switch (s->kind) {
  case 0:
    p[0] = t, p[1] = u;
    break;
  case 1:
    p[0] = floor(3 * t) / 4, p[1] = floor(3 * u) / 4;
    break; /* grid */
  case 2:
    p[0] = t, p[1] = floor(8 * s->turn) / 4 * t;
    break; /* line, perhaps exact */
  case 3:
    p[0] = t, p[1] = 0.001 * u * s->turn;
    break; /* strip */
  case 4:
    p[0] = cos(round), p[1] = sin(round);
    break; /* circle */
  case 5:
    p[0] = floor(16 * t), p[1] = ldexp(p[0] * p[0], -20);
    break; /* so flat that circles are large */
  case 6:
    p[0] = cos(round) * (1 + 0.1 * u), p[1] = sin(round);
    break; /* ring */
  default:
    p[0] = t * t * t * t * t, p[1] = u * u * u * u * u * s->turn; /* crowded in the middle */
  }
  for (int k = 0; k < 2; k++) p[k] = s->at[k] + s->size * p[k];
}

/* ---- rectangles ---- */

typedef struct sets_width {
  unsigned kind;
  double size;
} sets_width;

static double width_draw(const sets_width *w, test_random *r) {
  switch (w->kind) {
  case 0:
    return 0;
  case 1:
    return w->size;
  case 2:
    return w->size * test_unit(r);
  case 3:
    return test_chance(r, 4) ? w->size * test_unit(r) : 0;
  case 4:
    return test_chance(r, 8) ? 16 * w->size * test_unit(r) : w->size * 0x1p-6 * test_unit(r);
  default:
    return w->size * small(r, 30);
  }
}

static void case_row(double end[4], unsigned dim, const sets_shape *s, const sets_width *w, test_random *r) {
  double p[2];
  shape_place(p, s, r);
  for (int k = 0; k < 2 && dim == 2; k++) end[k] = p[k];
  for (int k = 0; k < 2 && dim == 4; k++) {
    end[2 * k] = p[k] - width_draw(w, r);
    end[2 * k + 1] = p[k] + (test_chance(r, 2) ? p[k] - end[2 * k] : width_draw(w, r));
    if (test_chance(r, 16)) end[2 * k + 1] = end[2 * k];
  }
}

/* ---- */

static void case_move(sets_case *s, test_random *r) {
  double away[2] = {0, 0};
  int bits[2] = {0, 0}, all = 0;
  for (int k = 0; k < 2; k++) {
    if (test_chance(r, 6)) away[k] = ldexp(signed_unit(r), (int)test_below(r, 45));
    if (test_chance(r, 4)) bits[k] = (int)test_between(r, -12, 12);
    if (test_chance(r, 64)) bits[k] = (int)test_between(r, -300, 300);
  }
  if (test_chance(r, 32)) all = (int)test_between(r, -700, 700);
  for (size_t i = 0; i < s->n; i++)
    for (unsigned k = 0; k < s->dim; k++) {
      const unsigned axis = k / (s->dim / 2);
      s->end[i][k] = ldexp(s->end[i][k] + away[axis], bits[axis] + all);
    }
}

void sets_make(sets_case *s, test_random *r, size_t least, size_t most) {
  sets_shape shape[3] = {shape_draw(r), shape_draw(r), shape_draw(r)};
  sets_width width[3];
  const unsigned shapes = 1 + (unsigned)test_below(r, 3);
  s->n = least + (size_t)test_below(r, most - least + 1);
  s->dim = test_chance(r, 3) ? 2 : 4;
  for (unsigned k = 0; k < 3; k++)
    width[k] = (sets_width){(unsigned)test_below(r, 6), shape[k].size * small(r, 8) / sqrt((double)s->n)};
  for (size_t i = 0; i < s->n; i++) {
    unsigned k = (unsigned)test_below(r, shapes);
    case_row(s->end[i], s->dim, &shape[k], &width[k], r);
    if (i && test_chance(r, 40)) memcpy(s->end[i], s->end[test_below(r, i)], sizeof s->end[i]);
  }
  case_move(s, r);
}

void sets_stretch(sets_case *s, test_random *r) {
  const int least = (int)test_between(r, -1060, 900),
            range[2] = {(int)test_below(r, 3) * 60, (int)test_below(r, 3) * 60};
  const bool each = test_chance(r, 2);
  int bits[2] = {0, 0};
  for (size_t i = 0; i < s->n; i++) {
    for (int k = 0; k < 2; k++)
      if (i == 0 || each) bits[k] = least + (int)test_below(r, (uint64_t)range[k] + 1);
    for (unsigned k = 0; k < s->dim; k++) {
      const double end = ldexp(s->end[i][k], bits[k / (s->dim / 2)]);
      s->end[i][k] = fmax(-DBL_MAX, fmin(end, DBL_MAX));
    }
  }
}

void sets_hidden(sets_case *s, test_random *r) {
  const double gap = 6.3 * test_unit(r), at[2] = {1.5, signed_unit(r) * small(r, 6)};
  const double c[2] = {at[0] + 0.2 * signed_unit(r), at[1] + 0.2 * signed_unit(r)};
  double size[2][2], far[2] = {0, 0};
  s->dim = 4;
  s->n = 9 + (size_t)test_below(r, 5);
  for (int k = 0; k < 2; k++) {
    size[0][k] = test_chance(r, 2) ? 0 : 0.4 * test_unit(r);
    size[1][k] = test_chance(r, 2) ? 0 : 0.1 * test_unit(r);
    s->end[0][2 * k] = -size[0][k];
    s->end[0][2 * k + 1] = size[0][k];
    s->end[1][2 * k] = at[k] - size[1][k];
    s->end[1][2 * k + 1] = at[k] + size[1][k];
    for (int i = 0; i < 2; i++) far[i] += pow(fabs(i ? c[k] - at[k] : c[k]) + size[i][k], 2);
  }
  for (size_t i = 2; i < s->n; i++) {
    const double wide = 0.5, turn = gap + wide + (6.28 - 2 * wide) * (double)(i - 2) / (double)(s->n - 3);
    const double radius = sqrt(fmax(far[0], far[1])) * (1.0001 + 0.03 * test_unit(r));
    for (int k = 0; k < 2; k++) s->end[i][2 * k] = s->end[i][2 * k + 1] = c[k] + radius * (k ? sin(turn) : cos(turn));
  }
}

dyd_engine *sets_engine(const sets_case *s) {
  dyd_engine *e = NULL;
  dyd_outcome outcome = DYD_OUTCOME_NONE;
  dyd_engine_options o;
  dyd_engine_options_init(&o);
  o.max_pairs = 3 * s->n + 1;
  if (dyd_engine_new(&e) != DYD_OK) abort();
  for (size_t i = 0; i < s->n; i++) {
    const double *p = s->end[i];
    dyd_status st = s->dim == 2 ? dyd_engine_add_points(e, 1, p, p + 1, NULL)
                                : dyd_engine_add_boxes(e, 1, p, p + 1, p + 2, p + 3, NULL);
    if (st != DYD_OK) abort();
  }
  if (dyd_engine_run(&outcome, e, &o, NULL) != DYD_OK) abort();
  if (outcome != DYD_OUTCOME_BUDGET) return e;
  dyd_engine_free(e);
  return NULL;
}

void sets_print(const sets_case *s) {
  for (size_t i = 0; i < s->n; i++) {
    for (unsigned k = 0; k < s->dim; k++) fprintf(stderr, "%a ", s->end[i][k]);
    fprintf(stderr, "\n");
  }
}
