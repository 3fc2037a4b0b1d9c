/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Nearest sites of a computable point, graphs of neighbours, pairs of discs: narrow the point and the sites concerned
 * until one is surely nearest.
 *
 * Only sites that are possibly nearest matter: where i is not listed, its distance to every point of the query is above
 * the least dl of some other site, and stays so [NEAR-3]. The result pd serves as an index; sites narrowed since it was
 * made only make its boxes wider than they need be. Precision goes up in levels, as in run.c: at each level
 * each site concerned that has fewer bits is narrowed to the level.
 *
 * The nearest sites are listed. If all that are listed are equally far from the point, all of them are nearest, and no
 * refinement changes that: a tie. It is looked for when the list has changed [NEAR-4]. */
#include "base/abi.h"
#include "base/alloc.h"
#include "base/error.h"
#include "base/index.h"
#include "base/local.h"
#include "delaunay/state.h"
#include "engine/points.h"
#include "engine/settle.h"
#include "engine/ties.h"
#include "engine/wants.h"
#include "graph/graph.h"
#include "rect/rect.h"
#include "tolerance/discs.h"
#include <dyadel/tolerance.h>
#include <dyadel/voronoi.h>

#include <stdlib.h>
#include <string.h>

/* level: the precision worked towards, INT64_MIN at first; the point asked about is the only guest. tried: how many
 * were listed when a tie was looked for last. */
typedef struct nearest_question {
  dyd_engine *e;
  dyd_stream *at;
  int64_t level;
  dyd_index_list near;
  size_t tried;
  bool sure, tied;
} nearest_question;

/* Adds a want for p if its precision is below the level. *open: p can be narrowed still. */
static void nearest_mark(bool *open, dyd_wants *wants, const dyd_refinable *p, int64_t level) {
  if (!p || p->final) return;
  *open = true;
  if (!p->asked || p->bits < level) dyd_wants_mark_alone(wants, p, level, DYD_REASON_QUESTION);
}

/* Raises the level until the guest or some site of the list is below it. */
static void nearest_plan(int64_t *level, dyd_wants *wants, const dyd_index_list *site) {
  if (*level == INT64_MIN) *level = dyd_bits_first(wants->o);
  for (bool open = false;; *level = dyd_bits_grown(*level, wants->o)) {
    if (*level > wants->o->max_bits) *level = wants->o->max_bits;
    for (size_t k = 0; k < wants->guests; k++) nearest_mark(&open, wants, &wants->guest[k], *level);
    for (size_t k = 0; k < site->count; k++)
      nearest_mark(&open, wants, dyd_engine_find(wants->e, site->item[k]), *level);
    wants->blocked = open;
    if (wants->count || wants->failed || !open || *level == wants->o->max_bits) return;
  }
}

/* Exact points about an exact point are listed when none is nearer. */
static bool all_are_exact(const nearest_question *q) {
  bool exact = dyd_rect_is_point(dyd_stream_rect(q->at));
  for (size_t k = 0; k < q->near.count && exact; k++) exact = dyd_sites_is_point(q->e->sites, q->near.item[k]);
  return exact;
}

/* Tries to prove that the sites listed are equally far for good. Where they are seen not to be, raises the level to
 * where rectangles show it. */
static dyd_status nearest_try_tie(nearest_question *q, const dyd_engine_options *o, dyd_error *err) {
  int64_t needed = 0;
  q->tied = all_are_exact(q);
  if (q->tied || o->no_ties || q->tried == q->near.count) return DYD_OK;
  q->tried = q->near.count;
  dyd_status st = dyd_ties_equidistant(&q->tied, &needed, q->e, q->at, &q->near, err);
  if (needed > q->level && !o->step_bits) q->level = needed;
  return st;
}

/* Counts the firm sites that may be nearest to some point of `at`, by a triangulation of the sites listed, as they are
 * in the problem of [NEAR-5]. */
static dyd_status nearest_count_firm(size_t *count, const nearest_question *q, const dyd_rect *at,
                                     const dyd_dyadic *eps) {
  dyd_delaunay *pd = NULL;
  DYD_SCOPED(dyd_index_list) near = {0};
  bool sure, *firm = dyd_alloc(q->near.count, sizeof *firm);
  const dyd_firm_sites cores = {q->e, eps, firm, q->near.item};
  const dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .cancel = &q->e->stop};
  dyd_status st = firm ? dyd_delaunay_made(&pd, q->near.count, dyd_firm_rect, &cores, &o, NULL) : DYD_E_NOMEM;
  *count = 0;
  if (st == DYD_OK) st = dyd_nearest(&near, &sure, pd, at);
  for (size_t k = 0; st == DYD_OK && k < near.count; k++) *count += firm[near.item[k]];
  dyd_delaunay_free(pd);
  free(firm);
  return st == DYD_CAPPED ? DYD_OK : st;
}

/* Sets *out to whether two sites stay possible, whatever is refined [NEAR-5]. */
static dyd_status nearest_is_settled(bool *out, const nearest_question *q) {
  size_t count = 0;
  DYD_LOCAL(dyd_dyadic, eps);
  DYD_LOCAL(dyd_rect, at);
  dyd_status st = dyd_firm_place(&at, &eps, q->at);
  for (size_t k = 0; st == DYD_OK && k < q->near.count; k++) st = dyd_firm_raise(&eps, q->e, q->near.item[k]);
  for (int k = 0; st == DYD_OK && k < 2; k++) st = dyd_dyadic_add(&eps, &eps, &eps);
  if (st == DYD_OK) st = nearest_count_firm(&count, q, &at, &eps);
  *out = count > 1;
  return st;
}

static dyd_status nearest_ask(bool *answered, dyd_wants *wants, void *user, const dyd_engine *e, dyd_error *err) {
  nearest_question *q = user;
  dyd_status st = dyd_nearest(&q->near, &q->sure, e->pd, dyd_stream_rect(q->at));
  *answered = st == DYD_OK && q->sure;
  if (st == DYD_OK && q->near.count > 1) st = nearest_try_tie(q, wants->o, err);
  bool settled = q->sure || q->tied || q->near.count == 0;
  if (st == DYD_OK && !settled && q->near.count > 1) st = nearest_is_settled(&settled, q);
  if (st == DYD_OK && !settled) nearest_plan(&q->level, wants, &q->near);
  return st;
}

dyd_status dyd_engine_nearest(dyd_index_list *out, bool *sure, dyd_outcome *outcome, dyd_engine *e, dyd_stream *at,
                              const dyd_engine_options *options, dyd_error *err) {
  if (!e || !at) return dyd_fail_null(err);
  nearest_question q = {.e = e, .at = at, .level = INT64_MIN};
  const dyd_question question = {DYD_SIZED(dyd_question), .ask = nearest_ask, .user = &q, .guest = &at, .guests = 1};
  *outcome = DYD_OUTCOME_ERROR;
  e->nearest_tied = false;
  if (err) dyd_error_clear(err);
  if (!e->pd) return dyd_fail(err, DYD_E_ARG, "there is no result yet: run the engine first");
  dyd_status st = dyd_engine_ask(outcome, e, &question, options, err);
  if (st != DYD_OK) {
    dyd_index_list_clear(&q.near);
    return st;
  }
  dyd_index_list_clear(out);
  *out = q.near;
  *sure = q.sure;
  e->nearest_tied = q.tied;
  return DYD_OK;
}

bool dyd_engine_nearest_tied(const dyd_engine *e) {
  if (!e) return false;
  return e->nearest_tied;
}

/* ---- graphs of neighbours ---- */

/* Limits of random choices: in all, and in a row without anything new. */
enum { CHOICES_MOST = 128, CHOICES_IDLE = 8 };

/* site: where edges are that refinement may make certain; seen: of each site, is it in the list; known: edges are those
 * of some rectangles reached; discs: of the discs in them, with these pairs. may, may_not: of each edge, is there a
 * choice in the cores that makes it one, and one that makes it none, whatever the other points are [NEAR-6]. */
typedef struct graph_question {
  dyd_graph graph;
  int64_t level;
  uint32_t drawn;
  dyd_graph_list edges;
  dyd_index_list site;
  bool *seen, *may, *may_not, known, discs;
  dyd_pair_list pairs;
} graph_question;

/* The problem of some choices: its edges, and of which sites more is known than a point. */
typedef struct graph_problem {
  dyd_delaunay *pd;
  dyd_graph_list edges;
  bool *firm;
} graph_problem;

static void graph_take(graph_question *q, uint32_t i) {
  if (!q->seen[i]) q->site.item[q->site.count++] = i;
  q->seen[i] = true;
}

/* Some sites of the engine. */
typedef struct some_sites {
  const dyd_engine *e;
  const uint32_t *site;
} some_sites;

static dyd_status some_rect(dyd_rect *out, const void *user, size_t k) {
  const some_sites *s = user;
  return dyd_sites_get(out, s->e->sites, s->site[k]);
}

/* Sets *may to whether the closed disc of a Gabriel edge may hold site k: the three alone are asked. */
static dyd_status graph_may_hold(bool *may, const dyd_engine *e, const dyd_graph_edge *edge, uint32_t k) {
  const uint32_t site[3] = {edge->i, edge->j, k};
  const some_sites of = {e, site};
  const dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options)};
  DYD_OWNED(dyd_delaunay) *pd = NULL;
  DYD_SCOPED(dyd_graph_list) three = {0};
  dyd_status st = dyd_delaunay_made(&pd, 3, some_rect, &of, &o, NULL);
  if (st == DYD_OK) st = dyd_graph_edges(&three, pd, NULL, DYD_GRAPH_GABRIEL, NULL, NULL);
  const dyd_graph_edge *first = st == DYD_OK && three.count ? three.item : NULL;
  *may = !first || first->i != 0 || first->j != 1 || !first->sure;
  return st;
}

/* The ends of an edge, and what else may be in the disc of a Gabriel edge, of the sites next to both. In the other
 * graphs rivals are ends of edges that are not certain either. */
static dyd_status graph_take_edge(graph_question *q, const dyd_engine *e, const dyd_graph_edge *edge) {
  dyd_index_list near[2] = {{0}, {0}};
  dyd_status st = DYD_OK;
  graph_take(q, edge->i);
  graph_take(q, edge->j);
  if (q->graph != DYD_GRAPH_GABRIEL) return DYD_OK;
  for (int k = 0; k < 2 && st == DYD_OK; k++)
    st = dyd_delaunay_neighbours(&near[k], e->pd, k ? edge->j : edge->i, DYD_TIE);
  for (size_t a = 0, b = 0; st == DYD_OK && a < near[0].count && b < near[1].count;) {
    uint32_t i = near[0].item[a], j = near[1].item[b];
    const dyd_refinable *p = i == j && !q->seen[i] ? dyd_engine_find(e, i) : NULL;
    bool may = false;
    if (p && !p->final) st = graph_may_hold(&may, e, edge, i);
    if (may) graph_take(q, i);
    a += i <= j, b += j <= i;
  }
  for (int k = 0; k < 2; k++) dyd_index_list_clear(&near[k]);
  return st;
}

/* A choice, by its number: an end of each core. */
typedef struct core_choice {
  const dyd_engine *e;
  uint32_t number;
} core_choice;

static dyd_status choice_rect(dyd_rect *out, const void *user, size_t k) {
  const core_choice *c = user;
  bool core[2];
  uint32_t site = (uint32_t)k, bits = (site * 2654435761u) ^ (c->number * 2246822519u);
  bits = (bits ^ bits >> 15) * 2654435761u;
  dyd_status st = dyd_site_get_core(out, core, c->e, site);
  for (int a = 0; st == DYD_OK && a < 2; a++) {
    dyd_interval *side = a ? &out->y : &out->x;
    if (!core[a] || dyd_interval_is_point(side)) continue;
    dyd_interval_set_over(side, bits >> (30 + a) & 1 ? &side->hi : &side->lo, side->den);
  }
  return st;
}

/* Returns true if two points of the choice coincide that are two sites. Then one of them takes part in nothing. */
static bool choice_joins(const dyd_delaunay *pd, const dyd_engine *e) {
  for (uint32_t k = 0; k < dyd_sites_count(e->sites); k++)
    if (dyd_delaunay_alias(pd, k) != dyd_delaunay_alias(e->pd, k)) return true;
  return false;
}

static void problem_clear(graph_problem *p) {
  dyd_graph_list_clear(&p->edges);
  dyd_delaunay_free(p->pd);
  free(p->firm);
}

/* Triangulates the sites, and finds the graph, unless sites join. */
static dyd_status problem_solve(bool *good, graph_problem *p, const graph_question *q, const dyd_wants *wants,
                                dyd_rect_fn *rect, const void *user, dyd_error *err) {
  const dyd_engine *e = wants->e;
  const dyd_delaunay_options o = {DYD_SIZED(dyd_delaunay_options), .max_pairs = wants->o->max_pairs, .cancel = &e->stop,
                                  .threads = wants->o->threads, .no_filter = wants->o->no_filter};
  dyd_status st = dyd_delaunay_made(&p->pd, dyd_sites_count(e->sites), rect, user, &o, err);
  *good = st == DYD_OK && !choice_joins(p->pd, e);
  if (*good) st = dyd_graph_edges(&p->edges, p->pd, NULL, q->graph, &e->stop, err);
  return st == DYD_CAPPED ? DYD_OK : st;
}

static const dyd_graph_edge *problem_edge(const graph_problem *p, const dyd_graph_edge *edge) {
  return dyd_find_two(edge, p->edges.item, p->edges.count, sizeof *edge);
}

/* Draws one choice in the cores, and looks which edges are certain, and which none, whatever the other points are.
 * *found: one of them was not known to be so. */
static dyd_status graph_draw(bool *found, graph_question *q, const dyd_wants *wants, uint32_t choice, dyd_error *err) {
  graph_problem p = {0};
  bool good = false;
  const core_choice drawn = {wants->e, choice};
  dyd_status st = problem_solve(&good, &p, q, wants, choice_rect, &drawn, err);
  for (size_t k = 0; good && st == DYD_OK && k < q->edges.count; k++) {
    const dyd_graph_edge *same = problem_edge(&p, &q->edges.item[k]);
    *found |= (!q->may[k] && same && same->sure) || (!q->may_not[k] && !same);
    q->may[k] |= same && same->sure;
    q->may_not[k] |= !same;
  }
  problem_clear(&p);
  return st;
}

/* Examines all choices in the cores, less 4 eps where a site is firm: one point represents the places of other sites.
 */
static dyd_status graph_shrink(graph_question *q, const dyd_wants *wants, dyd_error *err) {
  size_t sites = dyd_sites_count(wants->e->sites);
  graph_problem p = {.firm = dyd_alloc(sites, sizeof *p.firm)};
  bool good = false;
  DYD_LOCAL(dyd_dyadic, eps);
  const dyd_firm_sites cores = {wants->e, &eps, p.firm, NULL};
  dyd_status st = p.firm ? dyd_firm_eps(&eps, wants->e) : DYD_E_NOMEM;
  bool moving = dyd_dyadic_sgn(&eps) != 0;
  for (int k = 0; st == DYD_OK && k < 2; k++) st = dyd_dyadic_add(&eps, &eps, &eps);
  if (st == DYD_OK) st = problem_solve(&good, &p, q, wants, dyd_firm_rect, &cores, err);
  for (size_t k = 0; good && st == DYD_OK && k < q->edges.count; k++) {
    const dyd_graph_edge *edge = &q->edges.item[k], *same = problem_edge(&p, edge);
    bool ends = p.firm[edge->j] && (q->graph == DYD_GRAPH_NEAREST || p.firm[edge->i]);
    q->may[k] = q->may_not[k] = same && !same->sure && (!moving || (ends && q->graph != DYD_GRAPH_MST));
  }
  problem_clear(&p);
  return st;
}

static bool graph_is_open(const graph_question *q, size_t k) {
  return !q->edges.item[k].sure && !(q->may[k] && q->may_not[k]);
}

/* Returns true if an edge that is open can be refined at one of its ends. */
static bool graph_can_narrow(const graph_question *q, const dyd_engine *e) {
  for (size_t k = 0; k < q->edges.count; k++) {
    const uint32_t end[2] = {q->edges.item[k].i, q->edges.item[k].j};
    for (int m = 0; m < 2 && graph_is_open(q, k); m++) {
      const dyd_refinable *p = dyd_engine_find(e, end[m]);
      if (p && !p->final) return true;
    }
  }
  return false;
}

/* Sets *out to whether some core is not a point. */
static dyd_status graph_has_cores(bool *out, const dyd_engine *e) {
  DYD_LOCAL(dyd_rect, r);
  dyd_status st = DYD_OK;
  *out = false;
  for (uint32_t k = 0; st == DYD_OK && !*out && k < dyd_sites_count(e->sites); k++) {
    bool core[2];
    st = dyd_site_get_core(&r, core, e, k);
    *out = st == DYD_OK && ((core[0] && !dyd_interval_is_point(&r.x)) || (core[1] && !dyd_interval_is_point(&r.y)));
  }
  return st;
}

static dyd_status graph_reserve(graph_question *q, size_t sites) {
  dyd_free_all(q->may, q->may_not);
  q->may = dyd_alloc(q->edges.count, sizeof *q->may);
  q->may_not = dyd_alloc(q->edges.count, sizeof *q->may_not);
  if (!q->seen) q->seen = dyd_alloc(sites, sizeof *q->seen);
  if (!q->site.item) q->site.item = dyd_alloc(sites, sizeof *q->site.item);
  if (!q->may || !q->may_not || !q->seen || !q->site.item) return DYD_E_NOMEM;
  memset(q->may, 0, q->edges.count);
  memset(q->may_not, 0, q->edges.count);
  memset(q->seen, 0, sites * sizeof *q->seen);
  q->site.count = 0;
  return DYD_OK;
}

/* Takes edges that are in no tree by the squares from those by the discs, and makes those sure that are by squares:
 * lengths of squares are compared exactly. */
static dyd_status tree_of_both(dyd_graph_list *l, const dyd_delaunay *pd, const volatile int *cancel, dyd_error *err) {
  DYD_SCOPED(dyd_graph_list) squares = {0};
  size_t kept = 0;
  dyd_status st = dyd_graph_edges(&squares, pd, NULL, DYD_GRAPH_MST, cancel, err);
  for (size_t k = 0; st == DYD_OK && k < l->count; k++) {
    const dyd_graph_edge *same = dyd_find_two(&l->item[k], squares.item, squares.count, sizeof *same);
    if (!same) continue;
    l->item[kept] = l->item[k];
    l->item[kept++].sure |= same->sure;
  }
  if (st == DYD_OK) l->count = kept;
  return st;
}

dyd_status dyd_graph_edges(dyd_graph_list *out, const dyd_delaunay *pd, const dyd_pair_list *pairs, dyd_graph graph,
                           const volatile int *cancel, dyd_error *err) {
  if (!pd || !pairs) return dyd_graph_of_discs(out, pd, NULL, NULL, graph, cancel, err);
  const dyd_sites *sites = dyd_delaunay_sites(pd);
  size_t n = dyd_sites_count(sites);
  bool points = true; /* the squares say all then */
  dyd_iv(*ball)[3] = dyd_alloc(n, sizeof *ball);
  dyd_status st = ball ? DYD_OK : DYD_E_NOMEM;
  for (size_t i = 0; i < n && st == DYD_OK; i++) {
    points = points && dyd_sites_is_point(sites, i);
    st = dyd_filter_ball(ball[i], sites, i);
    if (st == DYD_E_ARG) dyd_fail(err, st, "site %zu is not a square", i);
  }
  if (st == DYD_E_NOMEM) dyd_fail_nomem(err);
  dyd_graph_list found = {0};
  if (st == DYD_OK) st = dyd_graph_of_discs(&found, pd, points ? NULL : pairs, ball, graph, cancel, err);
  if (st == DYD_OK && !points && graph == DYD_GRAPH_MST) st = tree_of_both(&found, pd, cancel, err);
  free(ball);
  dyd_graph_list_clear(st == DYD_OK ? out : &found);
  if (st == DYD_OK) *out = found;
  return st;
}

static dyd_status disc_mark_near(dyd_wants *wants, uint32_t end);

/* Asks for the centres that edges that are not certain depend on, up to the accuracy of discs. */
static dyd_status graph_mark_discs(dyd_wants *wants, const dyd_graph_list *edges) {
  dyd_status st = DYD_OK;
  for (size_t k = 0; st == DYD_OK && k < edges->count; k++) {
    if (edges->item[k].sure) continue;
    st = disc_mark_near(wants, edges->item[k].i);
    if (st == DYD_OK) st = disc_mark_near(wants, edges->item[k].j);
  }
  return st;
}

static dyd_status graph_ask(bool *answered, dyd_wants *wants, void *user, const dyd_engine *e, dyd_error *err) {
  graph_question *q = user;
  size_t sites = dyd_sites_count(e->sites);
  dyd_status st = q->discs ? dyd_disc_pairs(&q->pairs, e->pd, &e->stop, err) : DYD_OK;
  if (st == DYD_OK) st = dyd_graph_edges(&q->edges, e->pd, q->discs ? &q->pairs : NULL, q->graph, &e->stop, err);
  *answered = st == DYD_OK;
  q->known |= *answered;
  for (size_t k = 0; *answered && k < q->edges.count; k++) *answered = q->edges.item[k].sure;
  if (st != DYD_OK || *answered) return st;
  if (q->discs) return graph_mark_discs(wants, &q->edges);
  bool cores = false;
  st = graph_reserve(q, sites);
  if (st == DYD_OK && graph_can_narrow(q, e)) st = graph_has_cores(&cores, e);
  if (st == DYD_OK && cores) st = graph_shrink(q, wants, err);
  for (uint32_t idle = 0;
       st == DYD_OK && cores && q->drawn < CHOICES_MOST && idle < CHOICES_IDLE && graph_can_narrow(q, e);) {
    bool found = false;
    st = graph_draw(&found, q, wants, q->drawn++, err);
    idle = found ? 0 : idle + 1;
  }
  for (size_t k = 0; st == DYD_OK && k < q->edges.count; k++)
    if (graph_is_open(q, k)) st = graph_take_edge(q, e, &q->edges.item[k]);
  if (st == DYD_OK) nearest_plan(&q->level, wants, &q->site);
  return st;
}

dyd_status dyd_engine_graph(dyd_graph_list *out, dyd_outcome *outcome, dyd_engine *e, dyd_graph graph,
                            const dyd_engine_options *options, dyd_error *err) {
  if (!e) return dyd_fail_null(err);
  dyd_engine_options o;
  *outcome = DYD_OUTCOME_ERROR;
  dyd_status st = dyd_abi_take(&o, sizeof o, options, "dyd_engine_options", err);
  graph_question q = {.graph = graph, .level = INT64_MIN, .discs = o.discs};
  const dyd_question question = {DYD_SIZED(dyd_question), .ask = graph_ask, .user = &q, .triangulate = true};
  if (e->pd && dyd_delaunay_is_capped(e->pd))
    return dyd_fail(err, DYD_CAPPED, "there are more pairs than can be stored");
  if (st == DYD_OK) st = dyd_engine_ask(outcome, e, &question, options, err);
  if (st == DYD_OK && !q.known) st = DYD_CANCELLED;
  dyd_graph_list_clear(st == DYD_OK ? out : &q.edges);
  if (st == DYD_OK) *out = q.edges;
  dyd_pair_list_clear(&q.pairs);
  dyd_index_list_clear(&q.site);
  dyd_free_all(q.may, q.may_not, q.seen);
  return st;
}

/* ---- pairs of discs ---- */

/* Discs are computed to 2^-48 of their size: centres known a little better than that make no difference [DISC-1]. */
enum { DISC_SPARE = 56 };

/* st: DYD_CANCELLED where pairs were not reached, with why. settled: pairs that no precision decides. */
typedef struct disc_question {
  dyd_pair_list pairs;
  dyd_settled settled;
  dyd_status st;
  dyd_error why;
} disc_question;

/* Adds a want for the site up to the accuracy of discs. */
static dyd_status disc_mark(dyd_wants *wants, uint32_t site) {
  const dyd_refinable *p = dyd_engine_find(wants->e, site);
  if (!p || p->final) return DYD_OK;
  DYD_LOCAL(dyd_rect, r);
  dyd_status st = dyd_sites_get(&r, wants->e->sites, site);
  int64_t bits = st == DYD_OK ? dyd_rect_bits(&r) + DISC_SPARE : INT64_MIN;
  wants->blocked = wants->blocked || (p->bits < bits && bits > wants->o->max_bits);
  if (bits > wants->o->max_bits) bits = wants->o->max_bits;
  if (st == DYD_OK && p->bits < bits) dyd_wants_mark_alone(wants, p, bits, DYD_REASON_QUESTION);
  return st;
}

/* Of the end of an open pair, and of all that may be next to it. */
static dyd_status disc_mark_near(dyd_wants *wants, uint32_t end) {
  DYD_SCOPED(dyd_index_list) near = {0};
  dyd_status st = dyd_delaunay_neighbours(&near, wants->e->pd, end, DYD_INDETERMINATE);
  if (st == DYD_OK) st = disc_mark(wants, end);
  for (size_t k = 0; st == DYD_OK && k < near.count; k++) st = disc_mark(wants, near.item[k]);
  return st;
}

static dyd_status disc_mark_pairs(dyd_wants *wants, const disc_question *q) {
  dyd_status st = DYD_OK;
  for (size_t k = 0; st == DYD_OK && k < q->pairs.count; k++) {
    const dyd_pair *pair = &q->pairs.item[k];
    if (pair->status != DYD_INDETERMINATE || dyd_is_settled(&q->settled, pair)) continue;
    st = disc_mark_near(wants, pair->i);
    if (st == DYD_OK) st = disc_mark_near(wants, pair->j);
  }
  return st;
}

static dyd_status disc_ask(bool *answered, dyd_wants *wants, void *user, const dyd_engine *e, dyd_error *err) {
  disc_question *q = user;
  q->st = dyd_disc_pairs(&q->pairs, e->pd, &e->stop, err);
  if (q->st == DYD_CANCELLED && err) q->why = *err;
  if (q->st == DYD_CANCELLED || q->st < 0) return q->st;
  *answered = q->st == DYD_OK;
  bool narrows = false;
  for (size_t k = 0; k < e->points && !narrows; k++) narrows = !e->point[k].final;
  for (size_t k = 0; k < q->pairs.count; k++) *answered = *answered && q->pairs.item[k].status == DYD_LEGAL;
  if (!narrows) return DYD_OK;
  q->settled.discs = &q->pairs;
  dyd_status st = disc_mark_pairs(wants, q);
  if (st == DYD_OK && wants->count + wants->blocked) {
    st = dyd_settle(&q->settled, wants);
    dyd_wants_empty(wants);
    if (st == DYD_OK) st = disc_mark_pairs(wants, q);
  }
  return st;
}

dyd_status dyd_engine_discs(dyd_pair_list *out, dyd_outcome *outcome, dyd_engine *e, const dyd_engine_options *options,
                            dyd_error *err) {
  if (!e) return dyd_fail_null(err);
  disc_question q = {.st = DYD_CANCELLED};
  dyd_engine_options o;
  const dyd_question question = {DYD_SIZED(dyd_question), .ask = disc_ask, .user = &q, .triangulate = true};
  *outcome = DYD_OUTCOME_ERROR;
  dyd_status st = dyd_abi_take(&o, sizeof o, options, "dyd_engine_options", err);
  if (st == DYD_OK) q.settled.prover = dyd_engine_prover(e, &o);
  if (st == DYD_OK) st = dyd_engine_ask(outcome, e, &question, options, err);
  dyd_pair_list_clear(st == DYD_OK ? out : &q.pairs);
  dyd_settled_clear(&q.settled);
  if (st != DYD_OK) return st;
  *out = q.pairs;
  if (q.st == DYD_CANCELLED && err) *err = q.why;
  return q.st;
}
