/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Checks the pairs of a certificate: chains, what is left unproved, bounds. */
#include "base/error.h"
#include "checker/checker.h"

#include <stdlib.h>
#include <string.h>

/* ---- pairs ---- */

/* The rest of a line "n i j": direction, blocker, point, blocker, ..., point, blocker, direction. */
static dyd_status read_chain(dyd_checker *c) {
  dyd_cert_chain *chain = &c->chain;
  dyd_status st = dyd_cert_read_point(chain->u[0], &c->in);
  for (size_t q = 0; st == DYD_OK; q++) {
    if (dyd_cert_chain_resize(chain, q + 1) != DYD_OK) return dyd_fail_nomem(c->in.err);
    st = dyd_cert_read_site(&chain->blocker[q], c);
    if (st == DYD_OK) st = dyd_cert_read_point(chain->point[q], &c->in);
    if (st != DYD_OK || dyd_cert_line_has_more(&c->in)) continue;
    /* the last point read is the direction */
    dyd_exact_set(&chain->u[1][0], &chain->point[q][0]);
    dyd_exact_set(&chain->u[1][1], &chain->point[q][1]);
    return dyd_cert_chain_resize(chain, q);
  }
  return st;
}

static dyd_status check_chain(dyd_checker *c, const dyd_cert_edge *pair) {
  dyd_status st = read_chain(c);
  if (st != DYD_OK) return st;
  if (!dyd_cert_faces_share(&c->faces, pair->i, pair->j))
    return dyd_cert_reject(&c->in, "the chain is for a pair of no open set");
  if (!dyd_cert_chain_holds(&c->chain, &c->sites, pair->i, pair->j))
    return dyd_cert_reject(&c->in, "the chain does not prove that %u %u is illegal", (unsigned)pair->i,
                           (unsigned)pair->j);
  c->report.illegal_chains++;
  return dyd_cert_edges_add(&c->chained, pair->i, pair->j) != DYD_OK ? dyd_fail_nomem(c->in.err) : DYD_OK;
}

static dyd_status check_open(dyd_checker *c, const dyd_cert_edge *pair, char kind) {
  dyd_status st = dyd_cert_line_done(&c->in);
  if (st != DYD_OK) return st;
  if (!dyd_cert_faces_share(&c->faces, pair->i, pair->j))
    return dyd_cert_reject(&c->in, "the pair is in no open set, so it is illegal");
  if (kind == 'o') c->report.indeterminate++;
  if (kind == 't') c->report.tie++;
  if (kind == 'l') c->report.legal_unproved++;
  if (kind == 't') st = dyd_cert_edges_add(&c->tie, pair->i, pair->j);
  if (kind == 'l') st = dyd_cert_edges_add(&c->bare, pair->i, pair->j);
  if (st == DYD_OK) st = dyd_cert_edges_add(&c->open, pair->i, pair->j);
  return st != DYD_OK ? dyd_fail_nomem(c->in.err) : DYD_OK;
}

static dyd_status read_pair_line(dyd_checker *c, dyd_cert_edge *pair) {
  static const char *const kinds[] = {"o", "t", "l", "n"};
  size_t kind;
  dyd_status st = dyd_cert_read_choice(&kind, c, kinds, 4);
  if (st == DYD_OK) st = dyd_cert_read_pair(pair, c);
  if (st != DYD_OK) return st;
  if (dyd_cert_edges_have(&c->legal, pair->i, pair->j)) return dyd_cert_reject(&c->in, "the pair is legal already");
  st = kind == 3 ? check_chain(c, pair) : check_open(c, pair, kinds[kind][0]);
  if (st == DYD_OK) dyd_cert_faces_cover(&c->faces, pair->i, pair->j);
  return st;
}

/* Stops at the line "boxes" or "triangles", which is left to be read on. */
static dyd_status read_pairs(dyd_checker *c) {
  dyd_cert_edge pair = {0, 0};
  dyd_status st = dyd_cert_expect_line(c, "pairs");
  if (st == DYD_OK) st = dyd_cert_line_done(&c->in);
  while (st == DYD_OK) {
    st = dyd_cert_next_line(&c->in);
    if (st != DYD_OK || strncmp(c->in.line, "triangles", 9) == 0 || strncmp(c->in.line, "boxes", 5) == 0) break;
    st = read_pair_line(c, &pair);
  }
  return st;
}

/* ---- boxes ---- */

dyd_status dyd_cert_boxes_unproved(uint64_t *out, const dyd_cert_sites *s, const dyd_cert_faces *f,
                                   const dyd_cert_known *known) {
  dyd_cert_edges left;
  bool given_up;
  dyd_status st = dyd_cert_boxes_left(&left, &given_up, s, f, known);
  if (st != DYD_OK) return st;
  *out = given_up ? dyd_cert_faces_left(f) : 0;
  for (size_t e = 0; e < left.count; e++) *out += dyd_cert_faces_common(f, left.item[e].i, left.item[e].j);
  free(left.item);
  return DYD_OK;
}

/* The line "boxes P", when it is there; then the next one is read. */
static dyd_status check_boxes(dyd_checker *c) {
  long long stated;
  const dyd_cert_known known = {{&c->legal, &c->open, &c->chained}};
  c->report.unproved = dyd_cert_faces_left(&c->faces);
  if (strncmp(c->in.line, "boxes", 5) != 0) return DYD_OK;
  uint64_t before = c->report.unproved;
  dyd_status st = dyd_cert_expect_word(c, "boxes");
  if (st == DYD_OK) st = dyd_cert_read_integer(&stated, &c->in);
  if (st == DYD_OK) st = dyd_cert_line_done(&c->in);
  if (st != DYD_OK) return st;
  if (c->report.capped) return dyd_cert_reject(&c->in, "a capped result states nothing that boxes prove");
  if (dyd_cert_boxes_unproved(&c->report.unproved, &c->sites, &c->faces, &known) != DYD_OK)
    return dyd_fail_nomem(c->in.err);
  c->report.illegal_boxes = before - c->report.unproved;
  if (stated < 0 || (uint64_t)stated != c->report.illegal_boxes)
    return dyd_cert_reject(&c->in, "boxes prove %llu pairs", (unsigned long long)c->report.illegal_boxes);
  return dyd_cert_next_line(&c->in);
}

/* ---- counts ---- */

static dyd_status check_counts(dyd_checker *c) {
  long long triangles, unproved;
  dyd_status st = dyd_cert_expect_word(c, "triangles");
  if (st == DYD_OK) st = dyd_cert_read_integer(&triangles, &c->in);
  if (st == DYD_OK) st = dyd_cert_line_done(&c->in);
  if (st != DYD_OK) return st;
  if (triangles < 0 || (uint64_t)triangles != c->faces.triangles)
    return dyd_cert_reject(&c->in, "there are %zu sure triangles", c->faces.triangles);
  st = dyd_cert_expect_line(c, "unproved");
  if (st == DYD_OK) st = dyd_cert_read_integer(&unproved, &c->in);
  if (st == DYD_OK) st = dyd_cert_line_done(&c->in);
  if (st != DYD_OK) return st;
  c->report.triangles = c->faces.triangles;
  if (unproved < 0 || (uint64_t)unproved != c->report.unproved)
    return dyd_cert_reject(&c->in, "of the pairs that are not listed, %llu are not proved to be illegal",
                           (unsigned long long)c->report.unproved);
  return DYD_OK;
}

/* ---- bounds ---- */

/* "NAME none" or "NAME number"; *present tells. */
static dyd_status read_bound(bool *present, dyd_exact *out, dyd_checker *c, const char *name) {
  dyd_status st = dyd_cert_expect_line(c, name);
  if (st != DYD_OK) return st;
  *present = !c->in.at || strcmp(c->in.at, "none") != 0;
  if (!*present) return DYD_OK;
  st = dyd_cert_read_number(out, &c->in);
  return st == DYD_OK ? dyd_cert_line_done(&c->in) : st;
}

static void add_all_pairs(dyd_cert_bounds *b, const dyd_checker *c) {
  for (size_t e = 0; e < c->legal.count; e++)
    dyd_cert_bounds_add(b, &c->sites, c->legal.item[e].i, c->legal.item[e].j, true);
  for (size_t e = 0; e < c->open.count; e++)
    dyd_cert_bounds_add(b, &c->sites, c->open.item[e].i, c->open.item[e].j, false);
}

static dyd_status check_bounds(dyd_checker *c, dyd_exact bound[2]) {
  static const char *const name[2] = {"area", "hausdorff"};
  bool present[2] = {false, false};
  for (int k = 0; k < 2; k++) {
    dyd_status st = read_bound(&present[k], &bound[k], c, name[k]);
    if (st != DYD_OK) return st;
  }
  c->report.area = present[0];
  c->report.hausdorff = present[1];
  if (c->report.capped && (present[0] || present[1])) return dyd_cert_reject(&c->in, "a capped result has no bounds");
  dyd_cert_bounds b;
  dyd_cert_bounds_init(&b);
  b.hausdorff = present[1] ? &bound[1] : NULL;
  if (present[0] || present[1]) add_all_pairs(&b, c);
  bool area = !present[0] || dyd_cert_bounds_area_holds(&b, &bound[0]), exceeded = b.exceeded;
  if (present[1] && dyd_exact_sgn(&bound[1]) < 0) exceeded = true;
  dyd_cert_bounds_clear(&b);
  if (!area) return dyd_cert_reject(&c->in, "the hulls of the pairs have a greater area");
  if (exceeded) return dyd_cert_reject(&c->in, "a pair's term is greater than the Hausdorff bound");
  for (int k = 0; k < 2; k++)
    if (present[k]) dyd_cert_note_bound(c, name[k], &bound[k]);
  return DYD_OK;
}

dyd_status dyd_checker_pairs(dyd_checker *c) {
  dyd_exact bound[2];
  dyd_exact_init(&bound[0]);
  dyd_exact_init(&bound[1]);
  dyd_status st = read_pairs(c);
  if (st == DYD_OK) st = check_boxes(c);
  if (st == DYD_OK) st = check_counts(c);
  if (st == DYD_OK) st = check_bounds(c, bound);
  dyd_exact_clear(&bound[0]);
  dyd_exact_clear(&bound[1]);
  return st;
}
