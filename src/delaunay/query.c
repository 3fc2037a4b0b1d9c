/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Reading the statuses: pairs, neighbours, triangles, faces, hull. Queries about undecided parts have one switch each
 * over the way they are stored. */
#include "base/abi.h"
#include "base/alloc.h"
#include "base/error.h"
#include "base/local.h"
#include "delaunay/faces.h"
#include "delaunay/index_list.h"
#include "delaunay/memory.h"
#include "delaunay/undecided.h"
#include "legal/witness.h"
#include "skeleton/centre_filter.h"

#include <math.h>
#include <string.h>

/* ---- faces ---- */

/* Sorts, drops repeats. */
static size_t distinct(uint32_t *v, size_t count) {
  size_t kept = 0;
  if (count) qsort(v, count, sizeof *v, dyd_compare_index);
  for (size_t q = 0; q < count; q++)
    if (kept == 0 || v[kept - 1] != v[q]) v[kept++] = v[q];
  return kept;
}

static dyd_status listed_vertices(uint32_t **vertex, size_t *count, const dyd_delaunay *pd, size_t f) {
  const dyd_face *face = &pd->open.face[f];
  const dyd_mesh *m = &pd->sk.mesh;
  uint32_t *v = dyd_alloc(3 * (size_t)face->tris, sizeof *v);
  size_t all = 0;
  if (!v) return DYD_E_NOMEM;
  for (uint32_t q = 0; q < face->tris; q++)
    for (int k = 0; k < 3; k++) {
      uint32_t w = m->tri[pd->open.tri[face->first_tri + q]].v[k];
      if (w != m->n) v[all++] = w;
    }
  *vertex = v;
  *count = distinct(v, all);
  return DYD_OK;
}

static dyd_status line_vertices(uint32_t **vertex, size_t *count, const dyd_line *l) {
  uint32_t *v = dyd_alloc(l->count, sizeof *v);
  if (!v) return DYD_E_NOMEM;
  for (uint32_t q = 0; q < l->count; q++) v[q] = l->order[q];
  *vertex = v;
  *count = distinct(v, l->count);
  return DYD_OK;
}

static dyd_status tie_vertices(uint32_t **vertex, size_t *count, const dyd_delaunay *pd, size_t f) {
  const dyd_mesh *m = &pd->sk.mesh;
  dyd_half_edge first = dyd_tie_start(pd, f), h = first;
  uint32_t *v = NULL;
  size_t kept = 0, cap = 0;
  do {
    uint32_t w = dyd_edge_origin(m, h);
    if (!DYD_GROW(v, cap, kept + 1)) return free(v), DYD_E_NOMEM;
    if (w != m->n) v[kept++] = w;
    h = dyd_tie_next(&pd->sk, h);
  } while (h != first);
  qsort(v, kept, sizeof *v, dyd_compare_index);
  *vertex = v;
  *count = kept;
  return DYD_OK;
}

dyd_status dyd_open_vertices(uint32_t **vertex, size_t *count, const dyd_delaunay *pd, size_t f) {
  switch (pd->open.kind) {
  case DYD_LINE:
    return line_vertices(vertex, count, &pd->sk.line);
  case DYD_TIED:
    return tie_vertices(vertex, count, pd, f);
  default:
    return listed_vertices(vertex, count, pd, f);
  }
}

bool dyd_open_is_outer(const dyd_delaunay *pd, size_t f) {
  switch (pd->open.kind) {
  case DYD_LINE:
    return true;
  case DYD_TIED:
    return dyd_is_ghost_triangle(&pd->sk.mesh, dyd_tie_seed(pd, f));
  default:
    return pd->open.face[f].outer;
  }
}

bool dyd_open_is_capped(const dyd_delaunay *pd, size_t f) {
  if (pd->open.kind == DYD_LINE) return pd->open.capped;
  return pd->open.kind == DYD_LISTED && pd->open.face[f].capped;
}

bool dyd_open_is_postponed(const dyd_delaunay *pd, size_t f) {
  return pd->open.kind == DYD_LISTED && pd->open.face[f].postponed;
}

/* ---- one pair ---- */

/* The status of vw by face f alone, of which v is a vertex. */
static dyd_pair_status status_in_face(const dyd_delaunay *pd, uint32_t f, uint32_t v, uint32_t w) {
  if (pd->open.kind == DYD_TIED) return dyd_is_corner_of(pd, w, f) ? dyd_open_status_of(pd, f) : DYD_ILLEGAL;
  const dyd_vertex_pair *p = dyd_listed_pair(pd, f, v, w);
  return p && !p->hidden ? dyd_open_status_of(pd, f) : DYD_ILLEGAL;
}

/* In a capped face any pair may be possible. */
static bool may_be_missing(const dyd_delaunay *pd, uint32_t f, uint32_t w) {
  return pd->open.kind == DYD_LISTED && pd->open.face[f].capped && dyd_is_corner_of(pd, w, f);
}

/* The status of a pair that is not legal: not yet decided, or illegal. */
static dyd_pair_status open_status(const dyd_delaunay *pd, uint32_t v, uint32_t w) {
  if (pd->open.kind == DYD_LINE) return dyd_open_status_of(pd, 0);
  dyd_half_edge first = pd->sk.leaving[v];
  uint32_t before = DYD_NONE;
  bool missing = false;
  for (dyd_half_edge h = first; h != DYD_NONE; h = dyd_edge_around(&pd->sk.mesh, h, first)) {
    uint32_t f = dyd_face_of(pd, dyd_edge_triangle(h));
    if (f != DYD_NONE && f != before) {
      dyd_pair_status status = status_in_face(pd, f, v, w);
      if (status != DYD_ILLEGAL) return status;
      missing = missing || may_be_missing(pd, f, w);
    }
    before = f;
  }
  return missing ? DYD_INDETERMINATE : DYD_ILLEGAL;
}

/* ---- all of them ---- */

static void count_listed(size_t count[4], const dyd_delaunay *pd) {
  for (size_t f = 0; f < pd->open.count; f++) {
    const dyd_face *face = &pd->open.face[f];
    count[dyd_listed_status(face)] += face->pairs - face->hidden;
  }
}

/* How many pairs of each status, that are not legal, are added to count[]. */
static void open_count(size_t count[4], const dyd_delaunay *pd) {
  switch (pd->open.kind) {
  case DYD_LINE:
    if (!pd->open.capped) count[dyd_open_status_of(pd, 0)] += dyd_line_open_pairs(&pd->sk.line);
    return;
  case DYD_TIED:
    count[DYD_TIE] += pd->open.tied_pairs;
    return;
  default:
    count_listed(count, pd);
  }
}

/* How many pairs are legal; is this one? */
static uint64_t legal_count(const dyd_delaunay *pd) {
  return pd->open.kind == DYD_LINE ? dyd_line_legal_pairs(&pd->sk.line) : dyd_certain_edges(&pd->sk);
}

bool dyd_pair_is_legal(const dyd_delaunay *pd, uint32_t v, uint32_t w) {
  return pd->open.kind == DYD_LINE ? dyd_line_is_legal(&pd->sk.line, v, w) : dyd_is_legal(&pd->sk, v, w);
}

bool dyd_corner_is_sure(const dyd_delaunay *pd, uint32_t v) {
  return pd->open.kind == DYD_LINE ? dyd_line_is_end(&pd->sk.line, v) : dyd_is_legal(&pd->sk, v, pd->sk.mesh.n);
}

bool dyd_is_hull_edge(const dyd_delaunay *pd, uint32_t v, uint32_t w) {
  if (pd->open.kind == DYD_LINE) return pd->sk.line.count == 2;
  for (int k = 0; k < 2; k++) {
    dyd_half_edge h = k ? dyd_find_edge(&pd->sk, w, v) : dyd_find_edge(&pd->sk, v, w);
    if (h != DYD_NONE && dyd_is_ghost_triangle(&pd->sk.mesh, dyd_edge_triangle(h))) return true;
  }
  return false;
}

/* ---- those of one face ---- */

/* Passes on the pairs that are not legal. */
typedef struct only_open {
  dyd_pair_visit visit;
  void *context;
} only_open;

static void visit_open(void *context, uint32_t v, uint32_t w, dyd_pair_status status) {
  const only_open *o = context;
  if (status != DYD_LEGAL) o->visit(o->context, v, w, status);
}

/* The pairs of face f that are not legal, each once. */
static void open_each_in(const dyd_delaunay *pd, size_t f, dyd_pair_visit visit, void *context) {
  only_open o = {visit, context};
  if (pd->open.kind == DYD_LINE)
    dyd_each_on_line(pd, dyd_open_status_of(pd, 0), visit_open, &o);
  else if (pd->open.kind == DYD_LISTED)
    dyd_each_listed(pd, f, visit, context);
  else
    dyd_each_tied(pd, f, visit, context);
}

/* ---- those of one vertex ---- */

static void each_on_line_at(const dyd_delaunay *pd, uint32_t v, dyd_pair_visit visit, void *context) {
  const dyd_line *l = &pd->sk.line;
  for (uint32_t q = 0; q < l->count; q++)
    if (l->order[q] != v && !dyd_line_is_legal(l, v, l->order[q]))
      visit(context, v, l->order[q], dyd_open_status_of(pd, 0));
}

/* Of the tied face on the left of the rim's half-edge h: the pairs of the origin with sites that are not next to it on
 * the rim. */
static void each_tied_at(const dyd_delaunay *pd, dyd_half_edge h, dyd_pair_visit visit, void *context) {
  const dyd_skeleton *sk = &pd->sk;
  uint32_t v = dyd_edge_origin(&sk->mesh, h);
  for (dyd_half_edge at = dyd_tie_next(sk, dyd_tie_next(sk, h)), next; at != h; at = next) {
    uint32_t w = dyd_edge_origin(&sk->mesh, at);
    next = dyd_tie_next(sk, at);
    if (w != sk->mesh.n && next != h) visit(context, v, w, DYD_TIE);
  }
}

/* Of the pairs of a face, in the order of turned or their own (NULL): how many begin with less than v. */
static uint32_t listed_below(const dyd_vertex_pair *pair, const uint32_t *turned, uint32_t pairs, uint32_t v) {
  uint32_t low = 0, high = pairs;
  while (low < high) {
    uint32_t mid = low + (high - low) / 2;
    if ((turned ? pair[turned[mid]].j : pair[mid].i) < v)
      low = mid + 1;
    else
      high = mid;
  }
  return low;
}

static void visit_listed(const dyd_face *face, dyd_vertex_pair p, uint32_t v, dyd_pair_visit visit, void *context) {
  if (!p.hidden) visit(context, v, p.i == v ? p.j : p.i, dyd_listed_status(face));
}

static void each_listed_at(const dyd_delaunay *pd, uint32_t f, uint32_t v, dyd_pair_visit visit, void *context) {
  const dyd_face *face = &pd->open.face[f];
  const dyd_vertex_pair *pair = pd->open.pair + face->first_pair;
  uint32_t pairs = face->pairs, q = 0;
  if (pairs <= DYD_FEW_PAIRS) {
    for (; q < pairs; q++)
      if (pair[q].i == v || pair[q].j == v) visit_listed(face, pair[q], v, visit, context);
    return;
  }
  const uint32_t *turned = pd->open.turned + face->first_pair;
  for (q = listed_below(pair, turned, pairs, v); q < pairs && pair[turned[q]].j == v; q++)
    visit_listed(face, pair[turned[q]], v, visit, context);
  for (q = listed_below(pair, NULL, pairs, v); q < pairs && pair[q].i == v; q++)
    visit_listed(face, pair[q], v, visit, context);
}

void dyd_open_each_at(const dyd_delaunay *pd, uint32_t v, dyd_pair_status least, dyd_pair_visit visit, void *context) {
  if (!pd->open.count || (pd->open.kind != DYD_LISTED && dyd_open_status_of(pd, 0) < least)) return;
  if (pd->open.kind == DYD_LINE) {
    each_on_line_at(pd, v, visit, context);
    return;
  }
  dyd_half_edge first = pd->sk.leaving[v];
  uint32_t before = DYD_NONE;
  for (dyd_half_edge h = first; h != DYD_NONE; h = dyd_edge_around(&pd->sk.mesh, h, first)) {
    uint32_t f = dyd_face_of(pd, dyd_edge_triangle(h));
    if (f != DYD_NONE && pd->open.kind == DYD_LISTED) {
      if (f != before) each_listed_at(pd, f, v, visit, context);
    } else if (f != DYD_NONE && dyd_edge_is_certain(&pd->sk, h)) {
      each_tied_at(pd, h, visit, context);
    }
    before = f;
  }
}

void dyd_legal_each_at(const dyd_delaunay *pd, uint32_t v, dyd_pair_visit visit, void *context) {
  const dyd_line *l = &pd->sk.line;
  if (pd->open.kind == DYD_LINE) {
    uint32_t q = l->rank[v];
    if (q > 0 && l->legal[q - 1]) visit(context, v, l->order[q - 1], DYD_LEGAL);
    if (q + 1 < l->count && l->legal[q]) visit(context, v, l->order[q + 1], DYD_LEGAL);
    return;
  }
  const dyd_mesh *m = &pd->sk.mesh;
  dyd_half_edge first = pd->sk.leaving[v];
  for (dyd_half_edge h = first; h != DYD_NONE; h = dyd_edge_around(m, h, first))
    if (dyd_edge_is_certain(&pd->sk, h) && dyd_edge_target(m, h) != m->n)
      visit(context, v, dyd_edge_target(m, h), DYD_LEGAL);
}

/* ---- the hull ---- */

static dyd_status line_ends(dyd_index_list *out, const dyd_skeleton *sk) {
  const dyd_line *l = &sk->line;
  uint32_t ends = l->count < 2 ? l->count : 2;
  uint32_t *item = dyd_alloc(ends, sizeof *item);
  if (!item) return DYD_E_NOMEM;
  for (uint32_t q = 0; q < ends; q++) item[q] = sk->reps.site[l->order[q ? l->count - 1 : 0]];
  dyd_index_list_clear(out);
  *out = (dyd_index_list){ends, item};
  return DYD_OK;
}

dyd_status dyd_delaunay_hull(dyd_index_list *out, const dyd_delaunay *pd) {
  if (!pd) return DYD_E_ARG;
  const dyd_mesh *m = &pd->sk.mesh;
  dyd_half_edge last = dyd_hull_first(m), h = last;
  dyd_index_list list = {0};
  size_t cap = 0;
  if (last == DYD_NONE) return line_ends(out, &pd->sk);
  dyd_status st = DYD_OK;
  do {
    h = dyd_hull_following(m, h);
    st = dyd_index_list_add(&list, &cap, &pd->sk.reps.site[dyd_hull_target(m, h)], 1);
  } while (h != last && st == DYD_OK);
  dyd_index_list_clear(st == DYD_OK ? out : &list);
  if (st == DYD_OK) *out = list;
  return st;
}

/* ---- witnesses ---- */

static uint32_t degree(const dyd_skeleton *sk, uint32_t v) {
  dyd_half_edge first = sk->leaving[v], h = first;
  uint32_t count = 0;
  do count++;
  while ((h = dyd_edge_turn(&sk->mesh, h)) != first);
  return count;
}

/* v and the other ends of its edges. */
static void add_star(dyd_rects *few, uint32_t *item, uint32_t *count, const dyd_skeleton *sk, uint32_t v) {
  dyd_half_edge first = sk->leaving[v], h = first;
  dyd_rects_set_box(few, item[(*count)++] = v);
  do {
    uint32_t w = dyd_edge_target(&sk->mesh, h);
    if (w != sk->mesh.n) dyd_rects_set_box(few, item[(*count)++] = w);
    h = dyd_edge_turn(&sk->mesh, h);
  } while (h != first);
}

/* Exact points have no boxes of their own. For a centre nearer to i and j than to all their Delaunay neighbours no
 * other site is nearer (see [FLT-STAR]), so a tree over these neighbours will do; on a line, one over all. */
static dyd_status few_rects(dyd_rects *few, const dyd_skeleton *sk, uint32_t v, uint32_t w) {
  bool line = sk->mesh.count == 0;
  size_t size = line ? sk->line.count : (size_t)degree(sk, v) + degree(sk, w) + 2;
  uint32_t *item = dyd_alloc(size, sizeof *item), count = 0;
  *few = (dyd_rects){.sites = sk->rects.sites, .site = sk->rects.site};
  few->box = dyd_alloc(sk->n, sizeof *few->box);
  if (!few->box || !item) return free(item), DYD_E_NOMEM;
  for (uint32_t q = 0; line && q < size; q++) dyd_rects_set_box(few, item[count++] = sk->line.order[q]);
  if (!line) {
    add_star(few, item, &count, sk, v);
    add_star(few, item, &count, sk, w);
  }
  return dyd_tree_init(&few->tree, item, count, few->box);
}

static dyd_status find_witness(dyd_point *out, dyd_work *work, const dyd_skeleton *sk, uint32_t v, uint32_t w) {
  dyd_half_edge h = dyd_find_edge(sk, v, w);
  dyd_xy guess = h == DYD_NONE ? (dyd_xy){NAN, NAN} : dyd_edge_centre(sk, h);
  bool found;
  dyd_status st = dyd_witness_search(&found, out, work, sk, v, w, guess, NULL);
  if (st == DYD_OK && !found) st = dyd_witness_far(&found, out, work, sk, v, w);
  return st == DYD_OK && !found ? DYD_E_RANGE : st;
}

dyd_status dyd_delaunay_witness(dyd_point *out, const dyd_delaunay *pd, uint32_t i, uint32_t j) {
  if (!pd) return DYD_E_ARG;
  if (dyd_delaunay_status(pd, i, j) != DYD_LEGAL) return DYD_E_ARG;
  const dyd_skeleton *sk = &pd->sk;
  uint32_t v = sk->vertex[i], w = sk->vertex[j];
  dyd_rects few = {0};
  DYD_SCOPED(dyd_work) work;
  dyd_status st = sk->rects.box ? DYD_OK : few_rects(&few, sk, v, w);
  dyd_work_init(&work, sk, NULL);
  if (few.box) work.rects = &few;
  if (st == DYD_OK) st = find_witness(out, &work, sk, v, w);
  dyd_tree_clear(&few.tree);
  free(few.box);
  return st;
}

/* ---- memory ---- */

dyd_memory dyd_delaunay_memory_left(const dyd_delaunay *pd) {
  uint64_t most = pd->options.max_bytes;
  return (dyd_memory){.most = most, .held = most ? dyd_delaunay_memory(pd) : 0};
}

void dyd_delaunay_allow(dyd_delaunay *pd, uint64_t max_bytes) {
  pd->options.max_bytes = max_bytes;
}

bool dyd_delaunay_is_bounded(const dyd_delaunay *pd) {
  return pd->options.max_bytes != 0;
}

dyd_status dyd_delaunay_grant(const dyd_delaunay *pd, uint64_t bytes, const char *what, dyd_error *err) {
  dyd_memory memory = dyd_delaunay_memory_left(pd);
  return dyd_memory_has(&memory, bytes, what) ? DYD_OK : dyd_fail_memory(err, &memory);
}

dyd_pair_status dyd_least_bounding(const dyd_delaunay *pd) {
  return pd->sk.all_points ? DYD_INDETERMINATE : DYD_TIE;
}

static bool is_proved_line(const dyd_delaunay *pd) {
  return pd->open.kind == DYD_LINE && pd->line_tie && !pd->sk.all_points;
}

static bool is_in_proved_tie(const dyd_delaunay *pd, uint32_t i) {
  dyd_half_edge first = pd->sk.leaving[pd->sk.vertex[i]];
  if (pd->open.kind != DYD_LISTED) return is_proved_line(pd);
  for (dyd_half_edge h = first; h != DYD_NONE; h = dyd_edge_around(&pd->sk.mesh, h, first)) {
    uint32_t f = dyd_face_of(pd, dyd_edge_triangle(h));
    if (f != DYD_NONE && pd->open.face[f].proved) return true;
  }
  return false;
}

bool dyd_has_proved_tie(const dyd_delaunay *pd) {
  if (pd->open.kind != DYD_LISTED) return is_proved_line(pd);
  for (size_t f = 0; f < pd->open.count; f++)
    if (pd->open.face[f].proved) return true;
  return false;
}

dyd_pair_status dyd_least_bounding_true(const dyd_delaunay *pd) {
  return dyd_has_proved_tie(pd) ? DYD_INDETERMINATE : dyd_least_bounding(pd);
}

dyd_pair_status dyd_least_at(const dyd_delaunay *pd, uint32_t i, bool proved) {
  return proved && is_in_proved_tie(pd, i) ? DYD_INDETERMINATE : dyd_least_bounding(pd);
}

uint64_t dyd_pairs_bytes(const dyd_delaunay *pd, dyd_pair_status least) {
  size_t count[4];
  dyd_delaunay_count(count, pd);
  return dyd_bytes_times(count[DYD_LEGAL] + (least <= DYD_INDETERMINATE ? count[DYD_INDETERMINATE] : 0) +
                             (least <= DYD_TIE ? count[DYD_TIE] : 0),
                         sizeof(dyd_pair));
}

/* Sorted with their numbers in the mesh, then listed. */
uint64_t dyd_triangles_bytes(const dyd_delaunay *pd) {
  return dyd_bytes_times(pd->sk.mesh.count, 2 * sizeof(dyd_triangle) + sizeof(uint32_t)) +
         dyd_bytes_times((uint64_t)pd->sk.n + 1, sizeof(uint32_t));
}

const char *dyd_pair_status_text(dyd_pair_status status) {
  static const char *const text[] = {"illegal", "tie", "indeterminate", "legal"};
  return (unsigned)status < sizeof text / sizeof *text ? text[status] : "unknown status";
}

void dyd_pair_list_clear(dyd_pair_list *l) {
  free(l->item);
  *l = (dyd_pair_list){0};
}

void dyd_triangle_list_clear(dyd_triangle_list *l) {
  free(l->item);
  *l = (dyd_triangle_list){0};
}

void dyd_index_list_clear(dyd_index_list *l) {
  free(l->item);
  *l = (dyd_index_list){0};
}

const dyd_sites *dyd_delaunay_sites(const dyd_delaunay *pd) {
  return pd ? pd->sk.rects.sites : NULL;
}

dyd_status dyd_delaunay_get_counters(dyd_delaunay_counters *out, const dyd_delaunay *pd, dyd_error *err) {
  dyd_status st = dyd_abi_check(out, 0, "dyd_delaunay_counters", err);
  if (st == DYD_OK) dyd_abi_give(out, &pd->counters, sizeof pd->counters);
  return st;
}

size_t dyd_delaunay_undecided_faces(const dyd_delaunay *pd) {
  return pd ? pd->open.count : 0;
}

uint32_t dyd_delaunay_alias(const dyd_delaunay *pd, uint32_t i) {
  if (!pd) return 0;
  return pd->sk.mesh.alias ? pd->sk.reps.site[pd->sk.vertex[i]] : i;
}

dyd_pair_status dyd_delaunay_status(const dyd_delaunay *pd, uint32_t i, uint32_t j) {
  if (!pd) return DYD_INDETERMINATE;
  if (i >= pd->sk.n || j >= pd->sk.n) return DYD_ILLEGAL;
  uint32_t v = pd->sk.vertex[i], w = pd->sk.vertex[j];
  if (v == w) return DYD_ILLEGAL;
  return dyd_pair_is_legal(pd, v, w) ? DYD_LEGAL : open_status(pd, v, w);
}

void dyd_delaunay_count(size_t count[4], const dyd_delaunay *pd) {
  if (!pd) return;
  memset(count, 0, 4 * sizeof *count);
  count[DYD_LEGAL] = legal_count(pd);
  open_count(count, pd);
}

void dyd_pairs_count(size_t count[4], const dyd_pair_list *list, const dyd_delaunay *pd) {
  if (!list) {
    dyd_delaunay_count(count, pd);
    return;
  }
  for (int k = 0; k < 4; k++) count[k] = 0;
  for (size_t k = 0; k < list->count; k++) count[list->item[k].status]++;
}

/* ---- index lists ---- */

typedef struct collector {
  dyd_index_list list;
  size_t cap;
  dyd_status status;
} collector;

static void collect(collector *c, uint32_t i) {
  if (c->status == DYD_OK) c->status = dyd_index_list_add(&c->list, &c->cap, &i, 1);
}

/* Sorts, drops repeats, and hands over. */
static dyd_status deliver(dyd_index_list *out, collector *c) {
  dyd_index_list_sort(&c->list);
  dyd_index_list_clear(c->status == DYD_OK ? out : &c->list);
  if (c->status == DYD_OK) *out = c->list;
  return c->status;
}

/* For visits: those with at least the status asked for. */
typedef struct neighbour_filter {
  collector list;
  const uint32_t *site;
  dyd_pair_status least;
} neighbour_filter;

static void collect_neighbour(void *context, uint32_t v, uint32_t w, dyd_pair_status status) {
  neighbour_filter *f = context;
  (void)v;
  if (status >= f->least) collect(&f->list, f->site[w]);
}

dyd_status dyd_delaunay_neighbours(dyd_index_list *out, const dyd_delaunay *pd, uint32_t i, dyd_pair_status least) {
  if (!pd) return DYD_E_ARG;
  neighbour_filter c = {.site = pd->sk.reps.site, .least = least};
  if (i >= pd->sk.n) return DYD_E_ARG;
  dyd_legal_each_at(pd, pd->sk.vertex[i], collect_neighbour, &c);
  if (least < DYD_LEGAL) dyd_open_each_at(pd, pd->sk.vertex[i], least, collect_neighbour, &c);
  return deliver(out, &c.list);
}

dyd_status dyd_delaunay_face(dyd_index_list *out, bool *outer, const dyd_delaunay *pd, size_t f) {
  if (!pd) return DYD_E_ARG;
  collector c = {0};
  DYD_FREED uint32_t *v = NULL;
  size_t count;
  if (f >= pd->open.count) return DYD_E_ARG;
  dyd_status st = dyd_open_vertices(&v, &count, pd, f);
  if (st != DYD_OK) return st;
  for (size_t q = 0; q < count; q++) collect(&c, pd->sk.reps.site[v[q]]);
  *outer = dyd_open_is_outer(pd, f);
  return deliver(out, &c);
}

/* For visits: a list of pairs. */
typedef struct pair_collector {
  const uint32_t *site;
  dyd_pair_list list;
  size_t cap;
  dyd_status status;
} pair_collector;

static void collect_pair(void *context, uint32_t v, uint32_t w, dyd_pair_status status) {
  pair_collector *c = context;
  uint32_t i = c->site[v], j = c->site[w];
  if (c->status != DYD_OK) return;
  if (!DYD_GROW(c->list.item, c->cap, c->list.count + 1))
    c->status = DYD_E_NOMEM;
  else
    c->list.item[c->list.count++] = (dyd_pair){i < j ? i : j, i < j ? j : i, status};
}

dyd_status dyd_delaunay_face_pairs(dyd_pair_list *out, const dyd_delaunay *pd, size_t f) {
  if (!pd) return DYD_E_ARG;
  pair_collector c = {.site = pd->sk.reps.site};
  if (f >= pd->open.count) return DYD_E_ARG;
  open_each_in(pd, f, collect_pair, &c);
  if (c.list.count) qsort(c.list.item, c.list.count, sizeof *c.list.item, dyd_compare_two);
  dyd_pair_list_clear(c.status == DYD_OK ? out : &c.list);
  if (c.status == DYD_OK) *out = c.list;
  return c.status;
}

/* ---- ties as groups: the sites of one circle, in its order, or of one line of the hull ---- */

typedef struct group_list {
  dyd_index_list sites;
  size_t cap;
  bool chain;
} group_list;

/* Around the rim from h on; a chain begins behind the ghost. */
static dyd_status group_walk(group_list *g, const dyd_delaunay *pd, dyd_half_edge h) {
  const dyd_mesh *m = &pd->sk.mesh;
  dyd_half_edge first = h;
  dyd_status st = DYD_OK;
  do {
    g->chain = dyd_edge_origin(m, h) == m->n;
    if (!g->chain) h = dyd_tie_next(&pd->sk, h);
  } while (!g->chain && h != first);
  first = h;
  do {
    uint32_t v = dyd_edge_origin(m, h);
    if (v != m->n) st = dyd_index_list_add(&g->sites, &g->cap, &pd->sk.reps.site[v], 1);
    h = dyd_tie_next(&pd->sk, h);
  } while (st == DYD_OK && h != first);
  return st;
}

static dyd_status group_of_line(group_list *g, const dyd_line *l, const uint32_t *site) {
  dyd_status st = DYD_OK;
  g->chain = true;
  for (uint32_t q = 0; q < l->count && st == DYD_OK; q++)
    st = dyd_index_list_add(&g->sites, &g->cap, &site[l->order[q]], 1);
  return st;
}

/* Where to walk around tied face f; DYD_NONE where its rim is not one cycle. */
static dyd_half_edge group_start(const dyd_delaunay *pd, size_t f) {
  bool chain;
  return pd->open.kind == DYD_TIED ? dyd_tie_start(pd, f) : dyd_rim_start(&chain, pd, &pd->open.face[f]);
}

/* Visits the pairs of a face whose rim is not one cycle, one by one. */
static dyd_status visit_pairs_of_face(const dyd_delaunay *pd, size_t f, dyd_group_fn visit, void *user) {
  DYD_SCOPED(dyd_pair_list) pairs = {0};
  dyd_status st = dyd_delaunay_face_pairs(&pairs, pd, f);
  for (size_t k = 0; k < pairs.count && st == DYD_OK; k++)
    st = visit(user, DYD_GROUP_PAIR, &(dyd_index_list){2, (uint32_t[]){pairs.item[k].i, pairs.item[k].j}});
  return st;
}

dyd_status dyd_delaunay_each_group(const dyd_delaunay *pd, dyd_group_fn visit, void *user) {
  if (!pd) return DYD_E_ARG;
  group_list g = {0};
  dyd_status st = DYD_OK;
  bool line = pd->open.kind == DYD_LINE, all = false; /* a chain of all sites has a face on each side */
  for (size_t f = 0; f < pd->open.count && st == DYD_OK; f++) {
    if (dyd_open_status_of(pd, f) != DYD_TIE) continue;
    dyd_half_edge start = line ? 0 : group_start(pd, f);
    if (start == DYD_NONE) {
      st = visit_pairs_of_face(pd, f, visit, user);
      continue;
    }
    g.sites.count = 0;
    st = line ? group_of_line(&g, &pd->sk.line, pd->sk.reps.site) : group_walk(&g, pd, start);
    bool again = all;
    all = all || (g.chain && 2 * g.sites.count == (size_t)pd->sk.mesh.count + 2);
    if (st == DYD_OK && !again) st = visit(user, g.chain ? DYD_GROUP_CHAIN : DYD_GROUP_CIRCLE, &g.sites);
  }
  dyd_index_list_clear(&g.sites);
  return st;
}
