/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Every query of a partial triangulation against the oracle, or against the statuses it should agree with. */
#include "delaunay/harness.h"
#include "delaunay/state.h"
#include "delaunay/table.h"
#include <stdlib.h>
#include <string.h>

/* log2 of the largest end over the smallest that is not 0, in size. */
static long span_of(const orc_case *c) {
  long least = 0, most = 0;
  bool some = false;
  for (size_t i = 0; i < c->n; i++)
    for (size_t k = 0; k < 4; k++) {
      mpq_srcptr x = c->rect[i].e[k];
      if (mpq_sgn(x) == 0) continue;
      long size = (long)mpz_sizeinbase(mpq_numref(x), 2) - (long)mpz_sizeinbase(mpq_denref(x), 2);
      if (!some || size < least) least = size;
      if (!some || size > most) most = size;
      some = true;
    }
  return most - least;
}

bool is_hairline(harness *h, const orc_case *c, uint32_t i, uint32_t j) {
  orc_case unique;
  size_t at[2] = {0, 0}, mark = orc_mark(&h->pool);
  orc_case_init(&unique);
  for (size_t k = 0; k < c->n; k++) {
    if (orc_case_alias(c, k) != k) continue;
    if (k == orc_case_alias(c, i)) at[0] = unique.n;
    if (k == orc_case_alias(c, j)) at[1] = unique.n;
    orc_case_add_rect(&unique, &c->rect[k]);
  }
  mpq_srcptr x = NULL, y = NULL;
  bool legal = orc_legal(&x, &y, &h->pool, &unique, at[0], at[1]);
  bool thin = legal && !orc_is_roomy(&h->pool, &unique, at[0], at[1], x, y, FLOOR_BITS);
  bool wide = legal && !thin && span_of(c) > WIDE_SPAN;
  orc_release(&h->pool, mark);
  orc_case_clear(&unique);
  h->hairlines += thin;
  h->missed += wide;
  return thin || wide;
}

bool same_status(harness *h, const orc_case *c, uint32_t i, uint32_t j, int s, int t) {
  if (s == t) return true;
  return s + t == DYD_LEGAL + DYD_INDETERMINATE && (s == DYD_LEGAL || t == DYD_LEGAL) && is_hairline(h, c, i, j);
}

bool same_as_oracle(char *message, harness *h, const orc_case *c, const orc_table *t, const dyd_delaunay *pd) {
  bool points = orc_case_all_points(c);
  for (uint32_t i = 0; i < c->n; i++)
    for (uint32_t j = 0; j < c->n; j++) {
      int is = (int)dyd_delaunay_status(pd, i, j), want = t->status[i][j];
      bool same = is == want || (!points && want == ORC_INDETERMINATE && is == ORC_TIE);
      bool thin = !same && !points && want == ORC_LEGAL && is == DYD_INDETERMINATE && is_hairline(h, c, i, j);
      if (!same && !thin) return wrong(message, "pair %u %u: engine %d, oracle %d", i, j, is, want);
    }
  return true;
}

bool same_statuses(char *message, harness *h, const orc_case *c, const dyd_delaunay *a, const dyd_delaunay *b) {
  for (uint32_t i = 0; i < c->n; i++)
    for (uint32_t j = 0; j < c->n; j++) {
      int s = (int)dyd_delaunay_status(a, i, j), t = (int)dyd_delaunay_status(b, i, j);
      if (!same_status(h, c, i, j, s, t))
        return wrong(message, "pair %u %u: status %d in one engine, %d in the other", i, j, s, t);
    }
  return true;
}

/* Are the pairs sorted, i < j, without aliases, and right? Counts them by status. */
void snapshot_take(snapshot out, const dyd_delaunay *pd, size_t n) {
  for (uint32_t i = 0; i < n; i++)
    for (uint32_t j = 0; j < n; j++) out[i][j] = (unsigned char)dyd_delaunay_status(pd, i, j);
}

bool snapshot_kept(char *message, snapshot was, const orc_case *now, const dyd_delaunay *pd) {
  for (uint32_t i = 0; i < now->n; i++)
    for (uint32_t j = 0; j < now->n; j++) {
      if (orc_case_alias(now, i) == orc_case_alias(now, j)) continue;
      unsigned char is = (unsigned char)dyd_delaunay_status(pd, i, j);
      if (was[i][j] != DYD_INDETERMINATE && is != was[i][j])
        return wrong(message, "pair %u %u: retracted from %d to %d", i, j, was[i][j], is);
    }
  return true;
}

static bool list_right(char *message, size_t count[4], const orc_case *c, const dyd_delaunay *pd,
                       const dyd_pair_list *l, const char *name) {
  memset(count, 0, 4 * sizeof *count);
  for (size_t k = 0; k < l->count; k++) {
    dyd_pair p = l->item[k];
    if (p.i >= p.j || p.j >= c->n) return wrong(message, "bad pair %u %u listed", p.i, p.j);
    if (k && (l->item[k - 1].i > p.i || (l->item[k - 1].i == p.i && l->item[k - 1].j >= p.j)))
      return wrong(message, "%s: not sorted at %u %u", name, p.i, p.j);
    if (orc_case_alias(c, p.i) != p.i || orc_case_alias(c, p.j) != p.j)
      return wrong(message, "pair %u %u of an alias listed", p.i, p.j);
    if (p.status == DYD_ILLEGAL || p.status != dyd_delaunay_status(pd, p.i, p.j))
      return wrong(message, "pair %u %u listed as %d", p.i, p.j, (int)p.status);
    count[p.status]++;
  }
  return true;
}

typedef struct pair_visits {
  const dyd_pair_list *list;
  unsigned char *met;
  size_t count, wrong;
} pair_visits;

static void visit_pair(void *user, uint32_t i, uint32_t j, dyd_pair_status status) {
  pair_visits *v = user;
  size_t k = 0;
  while (k < v->list->count && (v->list->item[k].i != i || v->list->item[k].j != j)) k++;
  v->count++;
  if (k == v->list->count || v->list->item[k].status != status || v->met[k]++) v->wrong++;
}

/* Returns true if each pair of the list is met once, and no other. */
static bool visits_agree(char *message, const dyd_delaunay *pd, const dyd_pair_list *l) {
  pair_visits v = {.list = l, .met = calloc(l->count + 1, 1)};
  if (!v.met) return wrong(message, "no memory");
  dyd_delaunay_each_pair(pd, visit_pair, &v);
  free(v.met);
  if (v.count == l->count && v.wrong == 0) return true;
  return wrong(message, "%zu pairs met, %zu wrong ones, of %zu", v.count, v.wrong, l->count);
}

static bool pairs_agree(char *message, const orc_case *c, const dyd_delaunay *pd) {
  dyd_pair_list l = {0};
  size_t listed[4], count[4] = {9, 9, 9, 9}, possible = 0;
  if (dyd_delaunay_pairs(&l, pd) != DYD_OK) return wrong(message, "dyd_delaunay_pairs fails");
  bool good = list_right(message, listed, c, pd, &l, "dyd_delaunay_pairs");
  for (uint32_t i = 0; i < c->n; i++)
    for (uint32_t j = i + 1; j < c->n; j++)
      if (orc_case_alias(c, i) == i && orc_case_alias(c, j) == j)
        possible += dyd_delaunay_status(pd, i, j) != DYD_ILLEGAL;
  if (good && possible != l.count) good = wrong(message, "%zu pairs listed of %zu", l.count, possible);
  if (good) good = visits_agree(message, pd, &l);
  dyd_delaunay_count(count, pd);
  for (size_t s = 0; s < 4 && good; s++)
    if (count[s] != listed[s]) good = wrong(message, "count[%zu] is %zu, not %zu", s, count[s], listed[s]);
  dyd_pair_list_clear(&l);
  return good;
}

static bool neighbours_agree(char *message, const orc_case *c, const dyd_delaunay *pd, uint32_t i,
                             dyd_pair_status least) {
  dyd_index_list l = {0};
  if (dyd_delaunay_neighbours(&l, pd, i, least) != DYD_OK) return wrong(message, "dyd_delaunay_neighbours fails");
  size_t k = 0;
  bool good = true;
  for (uint32_t j = 0; j < c->n && good; j++) {
    if (orc_case_alias(c, j) != j || dyd_delaunay_status(pd, i, j) < least) continue;
    good = k < l.count && l.item[k++] == j;
    if (!good) wrong(message, "neighbours of %u at least %d: %u missing", i, (int)least, j);
  }
  if (good && k != l.count) good = wrong(message, "neighbours of %u at least %d: too many", i, (int)least);
  dyd_index_list_clear(&l);
  return good;
}

static bool all_neighbours_agree(char *message, const orc_case *c, const dyd_delaunay *pd) {
  for (uint32_t i = 0; i < c->n; i++) {
    if (dyd_delaunay_alias(pd, i) != orc_case_alias(c, i)) return wrong(message, "wrong alias of %u", i);
    if (orc_case_alias(c, i) != i) continue;
    for (int least = DYD_TIE; least <= DYD_LEGAL; least++)
      if (!neighbours_agree(message, c, pd, i, (dyd_pair_status)least)) return false;
  }
  return true;
}

static bool has_index(const dyd_index_list *l, uint32_t i) {
  for (size_t k = 0; k < l->count; k++)
    if (l->item[k] == i) return true;
  return false;
}

/* One face: its sites ascending, its pairs among them and undecided; a tie exactly when all its sites are points. */
static bool face_right(char *message, unsigned char seen[ORC_MAX][ORC_MAX], const orc_case *c,
                       const dyd_index_list *sites, const dyd_pair_list *pairs) {
  bool points = true;
  for (size_t k = 0; k < sites->count; k++) {
    if (sites->item[k] >= c->n || (k && sites->item[k - 1] >= sites->item[k]))
      return wrong(message, "sites of a face not ascending");
    points = points && orc_rect_is_point(&c->rect[sites->item[k]]);
  }
  for (size_t k = 0; k < pairs->count; k++) {
    dyd_pair p = pairs->item[k];
    if (!has_index(sites, p.i) || !has_index(sites, p.j))
      return wrong(message, "pair %u %u is not among the sites of its face", p.i, p.j);
    if (p.status != (points ? DYD_TIE : DYD_INDETERMINATE))
      return wrong(message, "pair %u %u of a face %s has status %d", p.i, p.j, points ? "of points" : "not of points",
                   (int)p.status);
    if (seen[p.i][p.j]++) return wrong(message, "pair %u %u in two faces", p.i, p.j);
  }
  return true;
}

static bool one_face(char *message, unsigned char seen[ORC_MAX][ORC_MAX], const orc_case *c, const dyd_delaunay *pd,
                     size_t f) {
  dyd_index_list sites = {0};
  dyd_pair_list pairs = {0};
  bool outer = false, good = true;
  size_t count[4];
  if (dyd_delaunay_face(&sites, &outer, pd, f) != DYD_OK || dyd_delaunay_face_pairs(&pairs, pd, f) != DYD_OK)
    good = wrong(message, "face %zu cannot be had", f);
  good = good && list_right(message, count, c, pd, &pairs, "dyd_delaunay_face_pairs") &&
         face_right(message, seen, c, &sites, &pairs);
  dyd_index_list_clear(&sites);
  dyd_pair_list_clear(&pairs);
  return good;
}

static bool faces_agree(char *message, const orc_case *c, const dyd_delaunay *pd) {
  unsigned char seen[ORC_MAX][ORC_MAX];
  memset(seen, 0, sizeof seen);
  size_t faces = dyd_delaunay_undecided_faces(pd);
  for (size_t f = 0; f < faces; f++)
    if (!one_face(message, seen, c, pd, f)) return false;
  for (uint32_t i = 0; i < c->n; i++)
    for (uint32_t j = i + 1; j < c->n; j++) {
      dyd_pair_status s = dyd_delaunay_status(pd, i, j);
      bool undecided = s == DYD_TIE || s == DYD_INDETERMINATE;
      if (orc_case_alias(c, i) != i || orc_case_alias(c, j) != j) undecided = false;
      if (undecided != (seen[i][j] == 1)) return wrong(message, "pair %u %u is in %d faces", i, j, seen[i][j]);
    }
  return true;
}

/* Neighbours on the hull of the representatives are a possible pair. */
static bool hull_right(char *message, const orc_case *c, const dyd_delaunay *pd) {
  dyd_index_list l = {0};
  bool good = true;
  if (dyd_delaunay_hull(&l, pd) != DYD_OK) return wrong(message, "dyd_delaunay_hull fails");
  if (c->n && !l.count) good = wrong(message, "empty hull");
  for (size_t k = 0; k < l.count && good; k++) {
    uint32_t i = l.item[k], j = l.item[(k + 1) % l.count];
    if (i >= c->n || orc_case_alias(c, i) != i)
      good = wrong(message, "hull with alias %u", i);
    else if (i != j && dyd_delaunay_status(pd, i, j) == DYD_ILLEGAL)
      good = wrong(message, "hull pair %u %u illegal", i, j);
  }
  dyd_index_list_clear(&l);
  return good;
}

bool queries_agree(char *message, const orc_case *c, const dyd_delaunay *pd) {
  return table_is_right(message, pd) && pairs_agree(message, c, pd) && all_neighbours_agree(message, c, pd) &&
         faces_agree(message, c, pd) && hull_right(message, c, pd);
}

/* Three disjoint legal neighbours of one another turn the same way for every choice, and no site can enter or leave the
 * triangle; so one choice (the lower left corners) decides whether it is empty. */
static bool is_sure_triangle(dyd_triangle *out, orc_pool *p, const orc_case *c, const dyd_delaunay *pd, uint32_t i,
                             uint32_t j, uint32_t k) {
  const orc_rect *r = c->rect;
  if (dyd_delaunay_status(pd, i, j) != DYD_LEGAL || dyd_delaunay_status(pd, j, k) != DYD_LEGAL) return false;
  if (dyd_delaunay_status(pd, i, k) != DYD_LEGAL) return false;
  if (orc_rect_meets(&r[i], &r[j]) || orc_rect_meets(&r[j], &r[k]) || orc_rect_meets(&r[i], &r[k])) return false;
  *out = (dyd_triangle){{i, j, k}};
  if (orc_turn(p, &r[i], &r[j], &r[k]) < 0) *out = (dyd_triangle){{i, k, j}};
  const orc_rect *v[3] = {&r[out->v[0]], &r[out->v[1]], &r[out->v[2]]};
  for (uint32_t m = 0; m < c->n; m++) {
    if (orc_case_alias(c, m) != m || m == i || m == j || m == k) continue;
    bool inside = true;
    for (size_t e = 0; e < 3 && inside; e++) inside = orc_turn(p, v[e], v[(e + 1) % 3], &r[m]) > 0;
    if (inside) return false;
  }
  return true;
}

static bool lists_triangle(const dyd_triangle_list *l, dyd_triangle t) {
  for (size_t k = 0; k < l->count; k++)
    if (!memcmp(l->item[k].v, t.v, sizeof t.v)) return true;
  return false;
}

static bool triangles_sorted(const dyd_triangle_list *l) {
  for (size_t k = 0; k + 1 < l->count; k++) {
    const uint32_t *a = l->item[k].v, *b = l->item[k + 1].v;
    size_t m = 0;
    while (m < 2 && a[m] == b[m]) m++;
    if (a[m] >= b[m]) return false;
  }
  return true;
}

bool triangles_right(char *message, orc_pool *p, const orc_case *c, const dyd_delaunay *pd) {
  dyd_triangle_list l = {0};
  dyd_triangle t;
  if (dyd_delaunay_triangles(&l, NULL, pd, 0) != DYD_OK) return wrong(message, "dyd_delaunay_triangles fails");
  size_t found = 0;
  bool good = triangles_sorted(&l) || wrong(message, "triangles not sorted");
  for (uint32_t i = 0; i < c->n && good; i++)
    for (uint32_t j = i + 1; j < c->n && good; j++)
      for (uint32_t k = j + 1; k < c->n && good; k++) {
        if (orc_case_alias(c, i) != i || orc_case_alias(c, j) != j || orc_case_alias(c, k) != k) continue;
        size_t mark = orc_mark(p);
        bool sure = is_sure_triangle(&t, p, c, pd, i, j, k);
        orc_release(p, mark);
        found += sure;
        if (sure && !lists_triangle(&l, t)) good = wrong(message, "triangle %u %u %u missing", t.v[0], t.v[1], t.v[2]);
      }
  if (good && found != l.count) good = wrong(message, "%zu triangles listed, %zu expected", l.count, found);
  dyd_triangle_list_clear(&l);
  return good;
}

bool witnesses_hold(char *message, orc_pool *p, const orc_case *c, const dyd_delaunay *pd) {
  dyd_point w;
  dyd_point_init(&w);
  bool good = true;
  for (uint32_t i = 0; i < c->n && good; i++)
    for (uint32_t j = 0; j < c->n && good; j++) {
      size_t mark = orc_mark(p);
      bool legal = dyd_delaunay_status(pd, i, j) == DYD_LEGAL;
      dyd_status status = dyd_delaunay_witness(&w, pd, i, j);
      if (status != (legal ? DYD_OK : DYD_E_ARG)) good = wrong(message, "witness of %u %u: status %d", i, j, status);
      mpq_ptr x = orc_new(p), y = orc_new(p);
      dyd_dyadic_get_q(x, &w.x);
      dyd_dyadic_get_q(y, &w.y);
      if (good && legal && !orc_is_witness(p, c, i, j, x, y)) good = wrong(message, "witness of %u %u is none", i, j);
      orc_release(p, mark);
    }
  dyd_point_clear(&w);
  return good;
}
