/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Writes certificates (certificate.h has the format).
 *
 * Everything that needs a proof is put before the checker's own tests first; what they do not take is written as
 * unproved. */
#include "base/alloc.h"
#include "base/error.h"
#include "io/certificate.h"
#include <dyadel/certificate.h>
#include <errno.h>
#include <inttypes.h>
#include <string.h>

/* After so much work in all (a blocker looked at is 1, a pair CHAIN_PAIR beside) the search for chains gives up. */
#define CHAIN_EFFORT ((uint64_t)30 * 1000 * 1000)
#define CHAIN_PAIR 200

static void clear(dyd_proof *p) {
  for (size_t q = 0; q < p->corners; q++) {
    dyd_exact_clear(&p->corner[q].u[0]);
    dyd_exact_clear(&p->corner[q].u[1]);
  }
  free(p->corner);
  dyd_proof_points_clear(&p->witness);
  dyd_proof_points_clear(&p->centre);
  dyd_cert_sites_clear(&p->sites);
  dyd_cert_tree_clear(&p->tree);
  dyd_cert_graph_clear(&p->graph);
  dyd_cert_faces_clear(&p->faces);
  free(p->legal.item);
  free(p->bridges.item);
  dyd_pair_list_clear(&p->pairs);
}

/* ---- gathering ---- */

static dyd_status gather_sites(dyd_proof *p) {
  const dyd_sites *sites = dyd_delaunay_sites(p->pd);
  dyd_rect r;
  dyd_rect_init(&r);
  dyd_status status = DYD_OK;
  for (size_t i = 0; i < dyd_sites_count(sites) && status >= 0; i++) {
    status = dyd_sites_get(&r, sites, i);
    if (status >= 0) status = dyd_proof_add_site(&p->sites, &r);
    if (status >= 0) p->sites.site[i].alias = dyd_delaunay_alias(p->pd, (uint32_t)i);
  }
  dyd_rect_clear(&r);
  if (status >= 0) status = dyd_cert_sites_finish(&p->sites);
  return status < 0 ? status : dyd_cert_tree_init(&p->tree, &p->sites);
}

/* Legal pairs with a witness become edges; the others stay in the list of pairs only. */
static dyd_status gather_legal(dyd_proof *p) {
  dyd_point c;
  dyd_point_init(&c);
  dyd_status status = dyd_delaunay_pairs(&p->pairs, p->pd);
  for (size_t k = 0; k < p->pairs.count && status >= 0; k++) {
    const dyd_pair *pair = &p->pairs.item[k];
    bool found = false;
    if (pair->status != DYD_LEGAL) continue;
    status = dyd_delaunay_witness(&c, p->pd, pair->i, pair->j);
    if (status >= 0) status = dyd_proof_add_witness(&found, &p->witness, p, pair->i, pair->j, &c, false);
    if (status == DYD_E_RANGE) status = DYD_OK;
    if (status >= 0 && found) status = dyd_cert_edges_add(&p->legal, pair->i, pair->j);
  }
  dyd_point_clear(&c);
  return status;
}

static dyd_status gather(dyd_proof *p) {
  dyd_status status = gather_sites(p);
  if (status >= 0) status = gather_legal(p);
  if (status >= 0) status = dyd_proof_find_bridges(p);
  return status < 0 ? status : dyd_proof_find_faces(p);
}

/* ---- numbers ---- */

static void put_number(FILE *out, const dyd_exact *x) {
  dyd_exact t;
  dyd_exact_init(&t);
  dyd_exact_set(&t, x);
  dyd_proof_trim(&t);
  mpz_out_str(out, 10, t.man);
  if (t.exp) fprintf(out, "*2^%" PRId64, t.exp);
  dyd_exact_clear(&t);
}

static void put_point(FILE *out, const dyd_exact c[2]) {
  put_number(out, &c[0]);
  putc(' ', out);
  put_number(out, &c[1]);
}

static void put_side(FILE *out, const dyd_cert_side *s) {
  put_number(out, &s->lo);
  if (s->den) {
    putc('/', out);
    mpz_out_str(out, 10, *s->den);
  }
  if (s->point) return;
  dyd_exact width;
  dyd_exact_init(&width);
  dyd_exact_sub(&width, &s->hi, &s->lo);
  putc('+', out);
  put_number(out, &width);
  dyd_exact_clear(&width);
}

/* ---- sections ---- */

static void put_head(FILE *out, const dyd_proof *p) {
  static const char *const goals[] = {
      [DYD_GOAL_DECIDED] = "decided", [DYD_GOAL_AREA] = "area", [DYD_GOAL_HAUSDORFF] = "hausdorff"};
  int64_t bits;
  dyd_goal goal = dyd_engine_goal(&bits, p->engine);
  fprintf(out, "dyadel certificate 1\noutcome %s\ngoal %s", dyd_outcome_text(dyd_engine_outcome(p->engine)),
          goals[goal]);
  if (goal != DYD_GOAL_DECIDED) fprintf(out, " %" PRId64, bits);
  fprintf(out, "\ncapped %s\n", dyd_delaunay_is_capped(p->pd) ? "yes" : "no");
}

static void put_sites(FILE *out, const dyd_proof *p) {
  fprintf(out, "sites %zu\n", p->sites.count);
  for (size_t i = 0; i < p->sites.count; i++) {
    const dyd_cert_site *s = &p->sites.site[i];
    if (s->alias != i) {
      fprintf(out, "= %" PRIu32 "\n", s->alias);
      continue;
    }
    put_side(out, &s->side[0]);
    putc(' ', out);
    put_side(out, &s->side[1]);
    putc('\n', out);
  }
}

static void put_edges(FILE *out, const char *name, const dyd_cert_edges *edges, const dyd_proof_points *centre) {
  fprintf(out, "%s %zu\n", name, edges->count);
  for (size_t e = 0; e < edges->count; e++) {
    fprintf(out, "%" PRIu32 " %" PRIu32 " ", edges->item[e].i, edges->item[e].j);
    put_point(out, (const dyd_exact *)centre->item[e]);
    putc('\n', out);
  }
}

static void put_places(FILE *out, const dyd_proof *p) {
  size_t count = 0;
  for (size_t i = 0; i < p->sites.count; i++) count += p->sites.site[i].place != NULL;
  fprintf(out, "places %zu\n", count);
  for (size_t i = 0; i < p->sites.count; i++) {
    if (!p->sites.site[i].place) continue;
    fprintf(out, "%zu ", i);
    put_point(out, (const dyd_exact *)p->sites.site[i].place);
    putc('\n', out);
  }
}

static void put_corners(FILE *out, const dyd_proof *p) {
  fprintf(out, "corners %zu\n", p->corners);
  for (size_t q = 0; q < p->corners; q++) {
    fprintf(out, "%" PRIu32 " ", p->corner[q].i);
    put_point(out, (const dyd_exact *)p->corner[q].u);
    putc('\n', out);
  }
}

/* ---- pairs ---- */

/* A line of the section: an open pair, or an illegal one of an open set, to be proved. Invariant: i < j. */
typedef struct line {
  uint32_t i, j;
  char kind;
} line;

typedef struct lines {
  line *item;
  size_t count, cap;
} lines;

static dyd_status add_line(lines *l, uint32_t i, uint32_t j, char kind) {
  if (!dyd_reserve((void **)&l->item, &l->cap, l->count + 1, sizeof *l->item)) return DYD_E_NOMEM;
  l->item[l->count++] = (line){i, j, kind};
  return DYD_OK;
}

static int compare_line(const void *a, const void *b) {
  const line *x = a, *y = b;
  if (x->i != y->i) return x->i < y->i ? -1 : 1;
  return (x->j > y->j) - (x->j < y->j);
}

static dyd_status open_lines(lines *l, const dyd_proof *p) {
  static const char kind[] = {[DYD_TIE] = 't', [DYD_INDETERMINATE] = 'o', [DYD_LEGAL] = 'l'};
  dyd_status status = DYD_OK;
  for (size_t k = 0; k < p->pairs.count && status >= 0; k++) {
    const dyd_pair *q = &p->pairs.item[k];
    if (q->status == DYD_LEGAL && dyd_cert_edges_have(&p->legal, q->i, q->j)) continue;
    status = add_line(l, q->i, q->j, kind[q->status]);
  }
  return status;
}

static bool is_listed(const lines *l, size_t count, const dyd_proof *p, uint32_t i, uint32_t j) {
  line key = {i, j, 0};
  return dyd_cert_edges_have(&p->legal, i, j) ||
         (count && bsearch(&key, l->item, count, sizeof key, compare_line) != NULL);
}

/* The pairs of open sets that are not listed, as far as the effort allows. The first `known` lines are sorted. */
static dyd_status illegal_lines(lines *l, const dyd_proof *p, size_t known) {
  uint64_t effort = 0;
  dyd_status status = DYD_OK;
  for (size_t f = 0; f < p->faces.sets; f++) {
    const uint32_t *site = p->faces.member + p->faces.start[f];
    uint64_t m = p->faces.start[f + 1] - p->faces.start[f];
    if (m < 3 || p->faces.covered[f] == m * (m - 1) / 2) continue;
    for (size_t a = 0; a < m; a++)
      for (size_t b = a + 1; b < m && status >= 0 && effort < CHAIN_EFFORT; b++) {
        if (is_listed(l, known, p, site[a], site[b])) continue;
        status = add_line(l, site[a], site[b], 'n');
        effort += m + CHAIN_PAIR;
      }
  }
  return status;
}

/* Where blockers are looked for: the open set of both sites, and their neighbours. Owned by the list. */
typedef struct blockers {
  uint32_t *site;
  size_t count, cap;
} blockers;

static dyd_status add_blockers(blockers *b, const uint32_t *site, size_t count) {
  if (!dyd_reserve((void **)&b->site, &b->cap, b->count + count, sizeof *b->site)) return DYD_E_NOMEM;
  memcpy(b->site + b->count, site, count * sizeof *site);
  b->count += count;
  return DYD_OK;
}

static dyd_status add_neighbours(blockers *b, const dyd_proof *p, uint32_t v) {
  dyd_status status = DYD_OK;
  for (size_t q = p->graph.start[v]; q < p->graph.start[v + 1] && status >= 0; q++) {
    uint32_t w = dyd_cert_origin(&p->graph, p->graph.around[q] ^ 1);
    status = add_blockers(b, &w, 1);
  }
  return status;
}

static dyd_status find_blockers(blockers *b, const dyd_proof *p, uint32_t i, uint32_t j) {
  const dyd_cert_faces *f = &p->faces;
  b->count = 0;
  dyd_status status = add_neighbours(b, p, i);
  if (status >= 0) status = add_neighbours(b, p, j);
  for (size_t k = f->first[i]; k < f->first[i + 1] && status >= 0; k++) {
    bool shared = false;
    for (size_t l = f->first[j]; l < f->first[j + 1]; l++) shared |= f->of[k] == f->of[l];
    size_t start = f->start[f->of[k]];
    if (shared) status = add_blockers(b, f->member + start, f->start[f->of[k] + 1] - start);
  }
  return status;
}

static dyd_status put_chain(FILE *out, dyd_cert_chain *chain, blockers *near, dyd_proof *p, const line *l) {
  bool found = false;
  dyd_status status = find_blockers(near, p, l->i, l->j);
  if (status >= 0) status = dyd_proof_find_chain(&found, chain, p, l->i, l->j, near->site, near->count);
  if (status < 0 || !found) return status;
  fprintf(out, "n %" PRIu32 " %" PRIu32 " ", l->i, l->j);
  put_point(out, (const dyd_exact *)chain->u[0]);
  for (size_t q = 0; q < chain->points; q++) {
    fprintf(out, " %" PRIu32 " ", chain->blocker[q]);
    put_point(out, (const dyd_exact *)chain->point[q]);
  }
  fprintf(out, " %" PRIu32 " ", chain->blocker[chain->points]);
  put_point(out, (const dyd_exact *)chain->u[1]);
  putc('\n', out);
  dyd_cert_faces_cover(&p->faces, l->i, l->j);
  return DYD_OK;
}

static dyd_status put_lines(FILE *out, dyd_proof *p, const lines *l) {
  dyd_cert_chain chain;
  blockers near = {0};
  dyd_cert_chain_init(&chain);
  dyd_status status = DYD_OK;
  for (size_t k = 0; k < l->count && status >= 0; k++) {
    const line *at = &l->item[k];
    if (k && compare_line(at, at - 1) == 0) continue; /* a pair of two sets */
    if (at->kind == 'n')
      status = put_chain(out, &chain, &near, p, at);
    else
      fprintf(out, "%c %" PRIu32 " %" PRIu32 "\n", at->kind, at->i, at->j);
  }
  dyd_cert_chain_clear(&chain);
  free(near.site);
  return status;
}

static dyd_status put_pairs(FILE *out, dyd_proof *p) {
  lines l = {0};
  fputs("pairs\n", out);
  dyd_status status = open_lines(&l, p);
  size_t known = l.count;
  for (size_t k = 0; k < known; k++) dyd_cert_faces_cover(&p->faces, l.item[k].i, l.item[k].j);
  if (status >= 0 && !dyd_delaunay_is_capped(p->pd)) status = illegal_lines(&l, p, known);
  if (status >= 0 && l.count) qsort(l.item, l.count, sizeof *l.item, compare_line);
  if (status >= 0) status = put_lines(out, p, &l);
  free(l.item);
  return status;
}

/* ---- the end ---- */

static void put_bound(FILE *out, const char *name, const dyd_dyadic *bound) {
  dyd_exact x;
  dyd_exact_init(&x);
  mpz_set(x.man, bound->man);
  x.exp = bound->exp;
  fprintf(out, "%s ", name);
  put_number(out, &x);
  putc('\n', out);
  dyd_exact_clear(&x);
}

static dyd_status put_end(FILE *out, const dyd_proof *p) {
  dyd_dyadic area, hausdorff;
  dyd_dyadic_init(&area);
  dyd_dyadic_init(&hausdorff);
  fprintf(out, "triangles %zu\nunproved %" PRIu64 "\n", p->faces.triangles, dyd_cert_faces_left(&p->faces));
  dyd_status status = dyd_engine_bounds(&area, &hausdorff, p->engine);
  if (status == DYD_OK) {
    put_bound(out, "area", &area);
    put_bound(out, "hausdorff", &hausdorff);
  } else {
    fputs("area none\nhausdorff none\n", out);
  }
  dyd_dyadic_clear(&area);
  dyd_dyadic_clear(&hausdorff);
  return status == DYD_E_NOMEM ? status : DYD_OK;
}

static dyd_status put_all(FILE *out, dyd_proof *p) {
  put_head(out, p);
  put_sites(out, p);
  put_edges(out, "legal", &p->legal, &p->witness);
  put_places(out, p);
  put_edges(out, "bridges", &p->bridges, &p->centre);
  put_corners(out, p);
  dyd_status status = put_pairs(out, p);
  return status < 0 ? status : put_end(out, p);
}

dyd_status dyd_write_certificate(FILE *out, const struct dyd_engine *e, dyd_error *err) {
  if (err) dyd_error_clear(err);
  dyd_proof p = {.engine = e, .pd = dyd_engine_delaunay(e)};
  if (!p.pd) return dyd_fail(err, DYD_E_ARG, "there is no result yet");
  dyd_cert_sites_init(&p.sites);
  dyd_status status = gather(&p);
  if (status >= 0) status = put_all(out, &p);
  clear(&p);
  if (status < 0) return dyd_fail(err, status, "%s", dyd_status_text(status));
  if (fputs("end\n", out) < 0 || fflush(out) != 0 || ferror(out))
    return dyd_fail(err, DYD_E_IO, "cannot write: %s", strerror(errno ? errno : EIO));
  return DYD_OK;
}
