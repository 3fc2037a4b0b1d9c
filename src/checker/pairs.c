/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Checks a certificate from its pairs on: chains, what is left unproved, bounds, outcome. */
#include "base/error.h"
#include "checker/check.h"

#include <string.h>

/* ---- pairs ---- */

/* The rest of a line "n i j": direction, blocker, point, blocker, ..., point, blocker, direction. */
static dyd_status read_chain(dyd_cert_check *c) {
  dyd_cert_chain *chain = &c->chain;
  dyd_status status = dyd_cert_read_point(chain->u[0], &c->in);
  for (size_t q = 0; status >= 0; q++) {
    if (dyd_cert_chain_resize(chain, q + 1) < 0) return dyd_fail_nomem(c->in.err);
    status = dyd_cert_read_site(&chain->blocker[q], c);
    if (status >= 0) status = dyd_cert_read_point(chain->point[q], &c->in);
    if (status < 0 || dyd_cert_line_has_more(&c->in)) continue;
    /* the last point read is the direction */
    dyd_exact_set(&chain->u[1][0], &chain->point[q][0]);
    dyd_exact_set(&chain->u[1][1], &chain->point[q][1]);
    return dyd_cert_chain_resize(chain, q);
  }
  return status;
}

static dyd_status check_chain(dyd_cert_check *c, const dyd_cert_edge *pair) {
  dyd_status status = read_chain(c);
  if (status < 0) return status;
  if (!dyd_cert_faces_share(&c->faces, pair->i, pair->j))
    return dyd_cert_reject(&c->in, "the chain is for a pair of no open set");
  if (!dyd_cert_chain_holds(&c->chain, &c->sites, pair->i, pair->j))
    return dyd_cert_reject(&c->in, "the chain does not prove that %u %u is illegal", (unsigned)pair->i,
                           (unsigned)pair->j);
  c->report.illegal_chains++;
  return DYD_OK;
}

static dyd_status check_open(dyd_cert_check *c, const dyd_cert_edge *pair, char kind) {
  dyd_status status = dyd_cert_line_done(&c->in);
  if (status < 0) return status;
  if (kind == 't' && !(dyd_cert_is_point(&c->sites.site[pair->i]) && dyd_cert_is_point(&c->sites.site[pair->j])))
    return dyd_cert_reject(&c->in, "a tie of sites that are not exact");
  if (!dyd_cert_faces_share(&c->faces, pair->i, pair->j))
    return dyd_cert_reject(&c->in, "the pair is in no open set, so it is illegal");
  if (kind == 'o') c->report.indeterminate++;
  if (kind == 't') c->report.tie++;
  if (kind == 'l') c->report.legal_unproved++;
  return dyd_cert_edges_add(&c->open, pair->i, pair->j) < 0 ? dyd_fail_nomem(c->in.err) : DYD_OK;
}

static dyd_status read_pair_line(dyd_cert_check *c, dyd_cert_edge *pair) {
  static const char *const kinds[] = {"o", "t", "l", "n"};
  size_t kind;
  dyd_status status = dyd_cert_read_choice(&kind, c, kinds, 4);
  if (status >= 0) status = dyd_cert_read_pair(pair, c);
  if (status < 0) return status;
  if (dyd_cert_edges_have(&c->legal, pair->i, pair->j)) return dyd_cert_reject(&c->in, "the pair is legal already");
  status = kind == 3 ? check_chain(c, pair) : check_open(c, pair, kinds[kind][0]);
  if (status >= 0) dyd_cert_faces_cover(&c->faces, pair->i, pair->j);
  return status;
}

/* Stops at the line "triangles", which is left to be read on. */
static dyd_status read_pairs(dyd_cert_check *c) {
  dyd_cert_edge pair = {0, 0};
  dyd_status status = dyd_cert_next_line(&c->in);
  if (status >= 0) status = dyd_cert_expect_word(c, "pairs");
  if (status >= 0) status = dyd_cert_line_done(&c->in);
  while (status >= 0) {
    status = dyd_cert_next_line(&c->in);
    if (status < 0 || strncmp(c->in.line, "triangles", 9) == 0) break;
    status = read_pair_line(c, &pair);
  }
  return status;
}

/* ---- counts ---- */

static dyd_status check_counts(dyd_cert_check *c) {
  long long triangles, unproved;
  dyd_status status = dyd_cert_expect_word(c, "triangles");
  if (status >= 0) status = dyd_cert_read_integer(&triangles, &c->in);
  if (status >= 0) status = dyd_cert_line_done(&c->in);
  if (status < 0) return status;
  if ((uint64_t)triangles != c->faces.triangles)
    return dyd_cert_reject(&c->in, "there are %zu sure triangles", c->faces.triangles);
  status = dyd_cert_next_line(&c->in);
  if (status >= 0) status = dyd_cert_expect_word(c, "unproved");
  if (status >= 0) status = dyd_cert_read_integer(&unproved, &c->in);
  if (status >= 0) status = dyd_cert_line_done(&c->in);
  if (status < 0) return status;
  c->report.triangles = c->faces.triangles;
  c->report.unproved = dyd_cert_faces_left(&c->faces);
  if ((uint64_t)unproved != c->report.unproved)
    return dyd_cert_reject(&c->in, "of the pairs that are not listed, %llu are not proved to be illegal",
                           (unsigned long long)c->report.unproved);
  return DYD_OK;
}

/* ---- bounds ---- */

/* "NAME none" or "NAME number"; *present tells. */
static dyd_status read_bound(bool *present, dyd_exact *out, dyd_cert_check *c, const char *name) {
  dyd_status status = dyd_cert_next_line(&c->in);
  if (status >= 0) status = dyd_cert_expect_word(c, name);
  if (status < 0) return status;
  *present = !c->in.at || strcmp(c->in.at, "none") != 0;
  if (!*present) return DYD_OK;
  status = dyd_cert_read_number(out, &c->in);
  return status < 0 ? status : dyd_cert_line_done(&c->in);
}

static void add_all(dyd_cert_bounds *b, const dyd_cert_check *c) {
  for (size_t e = 0; e < c->legal.count; e++)
    dyd_cert_bounds_add(b, &c->sites, c->legal.item[e].i, c->legal.item[e].j, true);
  for (size_t e = 0; e < c->open.count; e++)
    dyd_cert_bounds_add(b, &c->sites, c->open.item[e].i, c->open.item[e].j, false);
}

void dyd_cert_note_bound(dyd_cert_check *c, const char *goal, const dyd_exact *bound) {
  if (strcmp(c->report.goal, goal) != 0) return;
  dyd_exact most;
  dyd_exact_init(&most);
  mpz_set_ui(most.man, 1);
  most.exp = -c->report.goal_bits;
  c->reached = dyd_exact_cmp(bound, &most) <= 0;
  dyd_exact_clear(&most);
}

static dyd_status check_outcome(const dyd_cert_check *c) {
  const dyd_certificate_report *r = &c->report;
  bool open = r->indeterminate || r->tie || r->legal_unproved || r->capped;
  if (strcmp(r->outcome, "decided") == 0 && open)
    return dyd_cert_reject(&c->in, "the outcome is not decided: pairs are open");
  if (strcmp(r->outcome, "certified") == 0 && !c->reached)
    return dyd_cert_reject(&c->in, "the outcome is not certified: no bound reaches the goal");
  return DYD_OK;
}

static dyd_status check_bounds(dyd_cert_check *c, dyd_exact bound[2]) {
  static const char *const name[2] = {"area", "hausdorff"};
  bool present[2] = {false, false};
  for (int k = 0; k < 2; k++) {
    dyd_status status = read_bound(&present[k], &bound[k], c, name[k]);
    if (status < 0) return status;
  }
  c->report.area = present[0];
  c->report.hausdorff = present[1];
  if (c->report.capped && (present[0] || present[1])) return dyd_cert_reject(&c->in, "a capped result has no bounds");
  dyd_cert_bounds b;
  dyd_cert_bounds_init(&b);
  b.hausdorff = present[1] ? &bound[1] : NULL;
  if (present[0] || present[1]) add_all(&b, c);
  bool area = !present[0] || dyd_cert_bounds_area_holds(&b, &bound[0]), exceeded = b.exceeded;
  if (present[1] && dyd_exact_sgn(&bound[1]) < 0) exceeded = true;
  dyd_cert_bounds_clear(&b);
  if (!area) return dyd_cert_reject(&c->in, "the hulls of the pairs have a greater area");
  if (exceeded) return dyd_cert_reject(&c->in, "a pair's term is greater than the Hausdorff bound");
  for (int k = 0; k < 2; k++)
    if (present[k]) dyd_cert_note_bound(c, name[k], &bound[k]);
  return DYD_OK;
}

dyd_status dyd_cert_check_pairs(dyd_cert_check *c) {
  dyd_exact bound[2];
  dyd_exact_init(&bound[0]);
  dyd_exact_init(&bound[1]);
  dyd_status status = read_pairs(c);
  if (status >= 0) status = check_counts(c);
  if (status >= 0) status = check_bounds(c, bound);
  dyd_exact_clear(&bound[0]);
  dyd_exact_clear(&bound[1]);
  return status;
}

dyd_status dyd_cert_check_end(dyd_cert_check *c) {
  dyd_status status = dyd_cert_next_line(&c->in);
  if (status >= 0 && strncmp(c->in.line, "window", 6) == 0) {
    status = dyd_cert_check_diagram(c);
    if (status >= 0) status = dyd_cert_next_line(&c->in);
  }
  if (status >= 0) status = check_outcome(c);
  if (status >= 0) status = dyd_cert_expect_word(c, "end");
  if (status >= 0) status = dyd_cert_line_done(&c->in);
  return status < 0 ? status : dyd_cert_expect_end(&c->in);
}
