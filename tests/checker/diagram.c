/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What a certificate states of the Voronoi diagram, read by a reader of its own, and judged literally. */
#include "checker/diagram.h"

#include <stdlib.h>
#include <string.h>

static void each_number(diagram *d, void (*visit)(mpq_ptr)) {
  for (int k = 0; k < 4; k++) visit(d->window[k]);
  visit(d->undetermined);
  visit(d->distance);
  for (size_t i = 0; i < ORC_MAX; i++)
    for (size_t k = 0; k < DIAGRAM_VERTICES; k++) {
      visit(d->vertex[i][k][0]);
      visit(d->vertex[i][k][1]);
    }
}

static void init_number(mpq_ptr v) {
  mpq_init(v);
}
static void clear_number(mpq_ptr v) {
  mpq_clear(v);
}

void diagram_init(diagram *d) {
  memset(d, 0, sizeof *d);
  each_number(d, init_number);
}

void diagram_clear(diagram *d) {
  each_number(d, clear_number);
}

/* ---- reading ---- */

static void read_polygon(diagram *d, const char *line) {
  char *end;
  size_t i = strtoul(line, &end, 10), k = 0;
  assert_true(i < ORC_MAX);
  for (const char *at = end; *at == ' '; k++) {
    size_t put = k < DIAGRAM_VERTICES ? k : 0;
    at = statement_number(d->vertex[i][put][0], at + 1);
    at = statement_number(d->vertex[i][put][1], at + 1);
  }
  d->large |= k > DIAGRAM_VERTICES;
  d->count[i] = k < DIAGRAM_VERTICES ? k : DIAGRAM_VERTICES;
}

static void read_line(diagram *d, const char *line) {
  const char *at = line + strlen("window");
  if (strncmp(line, "window ", 7) == 0) {
    d->present = true;
    for (int k = 0; k < 4; k++) at = statement_number(d->window[k], at + 1);
  } else if (strncmp(line, "undetermined ", 13) == 0) {
    statement_number(d->undetermined, line + 13);
  } else if (strncmp(line, "distance ", 9) == 0) {
    d->distance_given = strcmp(line + 9, "none") != 0;
    d->distance_proved = d->distance_given && !strstr(line, "unproved");
    if (d->distance_given) statement_number(d->distance, line + 9);
  } else if (d->present && *line >= '0' && *line <= '9') {
    read_polygon(d, line);
  }
}

void diagram_read(diagram *d, const char *text) {
  char *copy = strdup(text), *next;
  d->present = d->large = d->distance_given = d->distance_proved = false;
  memset(d->count, 0, sizeof d->count);
  for (char *line = copy; (next = strchr(line, '\n')) != NULL; line = next + 1) {
    *next = 0;
    read_line(d, line);
  }
  free(copy);
}

bool diagram_same(const diagram *a, const diagram *b) {
  if (a->present != b->present) return false;
  if (!a->present) return true;
  for (int k = 0; k < 4; k++)
    if (!mpq_equal(a->window[k], b->window[k])) return false;
  for (size_t i = 0; i < ORC_MAX; i++) {
    if (a->count[i] != b->count[i]) return false;
    for (size_t k = 0; k < a->count[i]; k++)
      if (!mpq_equal(a->vertex[i][k][0], b->vertex[i][k][0]) || !mpq_equal(a->vertex[i][k][1], b->vertex[i][k][1]))
        return false;
  }
  return mpq_equal(a->undetermined, b->undetermined) && a->distance_given == b->distance_given &&
         a->distance_proved == b->distance_proved && (!a->distance_given || mpq_equal(a->distance, b->distance));
}

/* ---- polygons ---- */

/* out = (b - a) x (c - a). */
static void cross(mpq_ptr out, mpq_t *a, mpq_t *b, mpq_t *c) {
  mpq_t d[4];
  for (int k = 0; k < 4; k++) {
    mpq_init(d[k]);
    mpq_sub(d[k], k < 2 ? b[k % 2] : c[k % 2], a[k % 2]);
  }
  mpq_mul(d[0], d[0], d[3]);
  mpq_mul(d[1], d[1], d[2]);
  mpq_sub(out, d[0], d[1]);
  for (int k = 0; k < 4; k++) mpq_clear(d[k]);
}

/* Twice the area, by trapezoids; *convex: all other vertices are strictly left of each edge. */
static void measure_polygon(mpq_ptr area2, bool *convex, const diagram *d, size_t i) {
  size_t n = d->count[i];
  mpq_t t, s;
  mpq_inits(t, s, NULL);
  mpq_set_ui(area2, 0, 1);
  *convex = n >= 3;
  for (size_t k = 0; k < n; k++) {
    mpq_t *a = (mpq_t *)(uintptr_t)d->vertex[i][k], *b = (mpq_t *)(uintptr_t)d->vertex[i][(k + 1) % n];
    mpq_sub(t, a[0], b[0]);
    mpq_add(s, a[1], b[1]);
    mpq_mul(t, t, s);
    mpq_add(area2, area2, t);
    for (size_t l = 0; l < n; l++) {
      if (l == k || l == (k + 1) % n) continue;
      cross(t, a, b, (mpq_t *)(uintptr_t)d->vertex[i][l]);
      if (mpq_sgn(t) <= 0) *convex = false;
    }
  }
  mpq_clears(t, s, NULL);
}

/* out = the square of ds, or of dl, literally. */
static void distance2(mpq_ptr out, mpq_t *z, const orc_rect *r, bool far) {
  mpq_t lo, hi;
  mpq_inits(lo, hi, NULL);
  mpq_set_ui(out, 0, 1);
  for (int a = 0; a < 2; a++) {
    mpq_sub(lo, r->e[2 * a], z[a]);
    mpq_sub(hi, z[a], r->e[2 * a + 1]);
    if (far) {
      mpq_neg(lo, lo);
      mpq_neg(hi, hi);
    }
    if (mpq_cmp(hi, lo) > 0) mpq_swap(hi, lo);
    if (!far && mpq_sgn(lo) < 0) mpq_set_ui(lo, 0, 1);
    mpq_mul(lo, lo, lo);
    mpq_add(out, out, lo);
  }
  mpq_clears(lo, hi, NULL);
}

static const char *judge_vertex(const diagram *d, const orc_case *c, size_t i, mpq_t *z) {
  const char *wrong = NULL;
  mpq_t own, other;
  mpq_inits(own, other, NULL);
  for (int a = 0; a < 2; a++)
    if (mpq_cmp(z[a], d->window[2 * a]) < 0 || mpq_cmp(z[a], d->window[2 * a + 1]) > 0)
      wrong = "a vertex is outside of the window";
  distance2(own, z, &c->rect[i], true);
  for (size_t k = 0; k < c->n; k++) {
    if (k == i || orc_case_alias(c, k) != k) continue;
    distance2(other, z, &c->rect[k], false);
    if (mpq_cmp(own, other) >= 0) wrong = "a vertex is not surely nearest";
  }
  mpq_clears(own, other, NULL);
  return wrong;
}

static const char *judge_polygons(const diagram *d, const orc_case *c) {
  const char *wrong = NULL;
  mpq_t sum, one, side;
  mpq_inits(sum, one, side, NULL);
  mpq_sub(sum, d->window[1], d->window[0]);
  mpq_sub(side, d->window[3], d->window[2]);
  if (mpq_sgn(sum) <= 0 || mpq_sgn(side) <= 0) wrong = "the window has no area";
  mpq_mul(sum, sum, side);
  for (size_t i = 0; i < ORC_MAX && !wrong; i++) {
    bool convex;
    if (d->count[i] == 0) continue;
    if (i >= c->n || orc_case_alias(c, i) != i) wrong = "a polygon of no site";
    measure_polygon(one, &convex, d, i);
    if (!convex) wrong = "a polygon is not convex";
    for (size_t k = 0; k < d->count[i] && !wrong; k++)
      wrong = judge_vertex(d, c, i, (mpq_t *)(uintptr_t)d->vertex[i][k]);
    mpq_div_2exp(one, one, 1);
    mpq_sub(sum, sum, one);
  }
  if (!wrong && mpq_cmp(d->undetermined, sum) < 0) wrong = "the area is too small";
  mpq_clears(sum, one, side, NULL);
  return wrong;
}

/* ---- the distance ---- */

/* out = a point of [lo, hi], often an end. */
static void choose(mpq_ptr out, const mpq_t lo, const mpq_t hi, test_random *r) {
  mpq_sub(out, hi, lo);
  unsigned long share = test_chance(r, 2) ? 64 * (unsigned long)test_below(r, 2) : (unsigned long)test_below(r, 65);
  mpq_t t;
  mpq_init(t);
  mpq_set_ui(t, share, 64);
  mpq_canonicalize(t);
  mpq_mul(out, out, t);
  mpq_add(out, out, lo);
  mpq_clear(t);
}

/* Returns true if z is certainly nearest to some site. */
static bool is_determined(const orc_case *c, mpq_t *z) {
  bool found = false;
  mpq_t own, other;
  mpq_inits(own, other, NULL);
  for (size_t i = 0; i < c->n && !found; i++) {
    if (orc_case_alias(c, i) != i) continue;
    found = true;
    distance2(own, z, &c->rect[i], true);
    for (size_t k = 0; k < c->n && found; k++) {
      if (k == i || orc_case_alias(c, k) != k) continue;
      distance2(other, z, &c->rect[k], false);
      found = mpq_cmp(own, other) < 0;
    }
  }
  mpq_clears(own, other, NULL);
  return found;
}

/* The points of one choice: x and y are single rationals in each rectangle. */
static void choose_points(orc_case *p, const orc_case *c, test_random *r) {
  p->n = c->n;
  for (size_t k = 0; k < c->n; k++)
    for (int a = 0; a < 2; a++) {
      choose(p->rect[k].e[2 * a], c->rect[k].e[2 * a], c->rect[k].e[2 * a + 1], r);
      mpq_set(p->rect[k].e[2 * a + 1], p->rect[k].e[2 * a]);
    }
}

/* Returns true if z is within d->distance of the border of the cell that it is in. The cell of p_a is cut out by lines:
 * from inside, its border is as far as the nearest line, (|z - p_k|^2 - |z - p_a|^2) / (2 |p_a - p_k|) for some k. */
static bool is_near_border(const diagram *d, const orc_case *p, mpq_t *z) {
  mpq_t least, other, line, apart;
  mpq_inits(least, other, line, apart, NULL);
  size_t a = 0;
  for (size_t k = 0; k < p->n; k++) {
    distance2(other, z, &p->rect[k], false);
    if (k && mpq_cmp(other, least) >= 0) continue;
    mpq_set(least, other);
    a = k;
  }
  bool near = false;
  for (size_t k = 0; k < p->n && !near; k++) {
    mpq_t at[2];
    mpq_init(at[0]);
    mpq_init(at[1]);
    mpq_set(at[0], p->rect[a].e[0]);
    mpq_set(at[1], p->rect[a].e[2]);
    distance2(apart, at, &p->rect[k], false);
    distance2(other, z, &p->rect[k], false);
    mpq_sub(line, other, least);
    mpq_mul(line, line, line);
    mpq_mul(other, d->distance, d->distance);
    mpq_mul(other, other, apart);
    mpq_mul_2exp(other, other, 2);
    near = mpq_sgn(apart) > 0 && mpq_cmp(line, other) <= 0;
    mpq_clear(at[0]);
    mpq_clear(at[1]);
  }
  mpq_clears(least, other, line, apart, NULL);
  return near;
}

static const char *judge_distance(const diagram *d, const orc_case *c, test_random *r, size_t points) {
  const char *wrong = NULL;
  orc_case p;
  mpq_t z[2];
  orc_case_init(&p);
  mpq_init(z[0]);
  mpq_init(z[1]);
  for (size_t k = 0; k < points && !wrong; k++) {
    choose(z[0], d->window[0], d->window[1], r);
    choose(z[1], d->window[2], d->window[3], r);
    if (is_determined(c, z)) continue;
    choose_points(&p, c, r);
    if (!is_near_border(d, &p, z)) wrong = "the distance is too small";
  }
  mpq_clear(z[0]);
  mpq_clear(z[1]);
  orc_case_clear(&p);
  return wrong;
}

const char *diagram_judge(const diagram *d, const orc_case *c, test_random *r, size_t points) {
  if (!d->present || d->large) return NULL;
  const char *wrong = judge_polygons(d, c);
  if (wrong || !d->distance_proved) return wrong;
  if (mpq_sgn(d->distance) < 0) return "the distance is negative";
  return judge_distance(d, c, r, points);
}

/* ---- certificates ---- */

char *diagram_of_engine(const dyd_engine *e, const dyd_rect *window) {
  char *text = NULL;
  size_t size;
  dyd_error err;
  FILE *out = open_memstream(&text, &size);
  const dyd_certificate_parts parts = {DYD_SIZED(dyd_certificate_parts), .diagram = true, .window = window};
  dyd_status status = dyd_write_certificate(out, e, &parts, &err);
  fclose(out);
  if (status == DYD_OK) return text;
  if (status != DYD_E_RANGE) fail_msg("%s", err.message);
  free(text);
  return NULL;
}
