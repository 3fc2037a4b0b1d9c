/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Enclosures of Voronoi vertices and of undecided regions against random choices: [VERT-1] [REGION-1] [CEN-1]. */
#include <setjmp.h>
#include <stdarg.h>

#include "delaunay/harness.h"
#include "support/thin_case.h"
#include <cmocka.h>
#include <dyadel/voronoi.h>

static size_t sure_vertices, open_vertices;

/* The circumcentre of three points that are not collinear. */
static void centre(mpq_srcptr out[2], orc_pool *p, const orc_rect *a, const orc_rect *b, const orc_rect *c) {
  mpq_srcptr bx = orc_sub(p, b->e[0], a->e[0]), by = orc_sub(p, b->e[2], a->e[2]);
  mpq_srcptr cx = orc_sub(p, c->e[0], a->e[0]), cy = orc_sub(p, c->e[2], a->e[2]);
  mpq_srcptr d = orc_twice(p, orc_sub(p, orc_mul(p, bx, cy), orc_mul(p, by, cx)));
  mpq_srcptr b2 = orc_add(p, orc_sqr(p, bx), orc_sqr(p, by)), c2 = orc_add(p, orc_sqr(p, cx), orc_sqr(p, cy));
  mpq_srcptr x = orc_div(p, orc_sub(p, orc_mul(p, cy, b2), orc_mul(p, by, c2)), d);
  mpq_srcptr y = orc_div(p, orc_sub(p, orc_mul(p, bx, c2), orc_mul(p, cx, b2)), d);
  out[0] = orc_add(p, a->e[0], x);
  out[1] = orc_add(p, a->e[2], y);
}

static bool holds(const dyd_rect *r, mpq_srcptr const z[2]) {
  mpq_t lo, hi;
  mpq_inits(lo, hi, NULL);
  bool in = true;
  for (int axis = 0; axis < 2; axis++) {
    dyd_interval_get_q(lo, hi, axis ? &r->y : &r->x);
    in = in && mpq_cmp(lo, z[axis]) <= 0 && mpq_cmp(z[axis], hi) <= 0;
  }
  mpq_clears(lo, hi, NULL);
  return in;
}

static const dyd_triangle *find_sure(const dyd_triangle_list *l, uint32_t a, uint32_t b, uint32_t c) {
  for (size_t k = 0; k < l->count; k++) {
    const uint32_t *v = l->item[k].v;
    bool all = true;
    for (int m = 0; m < 3; m++) all = all && (v[m] == a || v[m] == b || v[m] == c);
    if (all) return &l->item[k];
  }
  return NULL;
}

typedef struct setting {
  const orc_case *c;
  const dyd_delaunay *pd;
  dyd_rect window;
  dyd_triangle_list sure;
  dyd_rect *region;
  size_t regions;
} setting;

/* One Delaunay triangle of a choice. */
static bool check_triangle(char *message, orc_pool *p, const setting *s, const orc_case *choice, const uint32_t v[3],
                           int64_t bits) {
  mpq_srcptr z[2];
  dyd_rect r;
  centre(z, p, &choice->rect[v[0]], &choice->rect[v[1]], &choice->rect[v[2]]);
  const dyd_triangle *t = find_sure(&s->sure, v[0], v[1], v[2]);
  if (t) {
    dyd_rect_init(&r);
    bool good = dyd_voronoi_vertex(&r, s->pd, t, bits) == DYD_OK && holds(&r, z);
    dyd_rect_clear(&r);
    sure_vertices++;
    return good || wrong(message, "the vertex of %u %u %u is outside of its enclosure", v[0], v[1], v[2]);
  }
  if (!holds(&s->window, z)) return true;
  open_vertices++;
  for (size_t k = 0; k < s->regions; k++)
    if (holds(&s->region[k], z)) return true;
  return wrong(message, "the vertex of %u %u %u is in none of the %zu regions", v[0], v[1], v[2], s->regions);
}

static bool is_delaunay(orc_pool *p, const orc_case *choice, uint32_t a, uint32_t b, uint32_t c) {
  for (size_t d = 0; d < choice->n; d++)
    if (d != a && d != b && d != c &&
        orc_in_circle(p, &choice->rect[a], &choice->rect[b], &choice->rect[c], &choice->rect[d]) > 0)
      return false;
  return true;
}

static bool check_choice(char *message, harness *h, const setting *s, const orc_case *choice) {
  for (uint32_t a = 0; a < choice->n; a++)
    for (uint32_t b = a + 1; b < choice->n; b++)
      for (uint32_t c = b + 1; c < choice->n; c++) {
        size_t mark = orc_mark(&h->pool);
        int turn = orc_turn(&h->pool, &choice->rect[a], &choice->rect[b], &choice->rect[c]);
        uint32_t v[3] = {a, turn > 0 ? b : c, turn > 0 ? c : b};
        bool good = !turn || !is_delaunay(&h->pool, choice, v[0], v[1], v[2]) ||
                    check_triangle(message, &h->pool, s, choice, v, test_between(&h->random, -4, 90));
        orc_release(&h->pool, mark);
        if (!good) return false;
      }
  return true;
}

static bool find_regions(char *message, setting *s) {
  size_t faces = dyd_delaunay_undecided_faces(s->pd);
  s->region = calloc(faces ? faces : 1, sizeof *s->region);
  for (size_t f = 0; f < faces; f++) {
    bool any;
    dyd_rect_init(&s->region[s->regions]);
    if (dyd_voronoi_region(&s->region[s->regions], &any, s->pd, f, &s->window) != DYD_OK)
      return wrong(message, "no region for face %zu", f);
    if (any)
      s->regions++;
    else
      dyd_rect_clear(&s->region[s->regions]);
  }
  return true;
}

/* Aliases would be triangles' corners under another name. */
static bool has_alias(const orc_case *c) {
  for (size_t i = 0; i < c->n; i++)
    if (orc_case_alias(c, i) != i) return true;
  return false;
}

static bool check_case(char *message, harness *h, const orc_case *c) {
  if (c->n < 3 || has_alias(c)) return true;
  dyd_sites *sites = harness_sites(c);
  dyd_delaunay *pd = harness_engine(message, sites, NULL);
  setting s = {.c = c, .pd = pd};
  orc_case choice;
  orc_case_init(&choice);
  dyd_rect_init(&s.window);
  bool good = pd != NULL;
  bool windowed = dyd_voronoi_window(&s.window, sites) == DYD_OK;
  good = good && dyd_delaunay_triangles(&s.sure, NULL, pd, 0) == DYD_OK;
  if (good && windowed) good = find_regions(message, &s);
  for (int k = 0; k < 4 && good && windowed; k++) {
    orc_choose(&choice, &h->random, c, 3);
    good = check_choice(message, h, &s, &choice);
  }
  for (size_t k = 0; k < s.regions; k++) dyd_rect_clear(&s.region[k]);
  free(s.region);
  dyd_rect_clear(&s.window);
  dyd_triangle_list_clear(&s.sure);
  orc_case_clear(&choice);
  dyd_delaunay_free(pd);
  dyd_sites_free(sites);
  return good;
}

static void random_cases(void **state) {
  (void)state;
  harness h;
  harness_init(&h, "vertices random");
  orc_case c;
  orc_case_init(&c);
  harness_run_cases(&h, 8, test_cases(600), check_case);
  for (size_t k = 0; k < test_cases(60); k++) {
    thin_case(&c, &h.random, 9, 6, 50);
    harness_run(&h, &c, check_case);
  }
  fprintf(stderr, "# %zu sure vertices, %zu in regions\n", sure_vertices, open_vertices);
  assert_true(sure_vertices > 100 && open_vertices > 100);
  orc_case_clear(&c);
  harness_clear(&h);
}

static void refused(void **state) {
  (void)state;
  orc_case c;
  char message[MESSAGE_SIZE];
  orc_case_init(&c);
  orc_case_add(&c, 0, 0, 0, 0, 1);
  orc_case_add(&c, 4, 4, 0, 0, 1);
  orc_case_add(&c, 0, 0, 4, 4, 1);
  dyd_sites *s = harness_sites(&c);
  dyd_delaunay *pd = harness_engine(message, s, NULL);
  dyd_rect r;
  dyd_rect_init(&r);
  const dyd_triangle wrong_way = {{0, 2, 1}}, none = {{0, 1, 7}}, right = {{0, 1, 2}};
  assert_int_equal(dyd_voronoi_vertex(&r, pd, &right, 20), DYD_OK);
  assert_int_equal(dyd_voronoi_vertex(&r, pd, &wrong_way, 20), DYD_E_ARG);
  assert_int_equal(dyd_voronoi_vertex(&r, pd, &none, 20), DYD_E_ARG);
  bool any;
  assert_int_equal(dyd_voronoi_region(&r, &any, pd, 0, &r), DYD_E_ARG);
  dyd_rect_clear(&r);
  dyd_delaunay_free(pd);
  dyd_sites_free(s);
  orc_case_clear(&c);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(random_cases), cmocka_unit_test(refused)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
