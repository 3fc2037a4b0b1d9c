/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Checks a certificate, line by line: sites, legal pairs, places, bridges, corners. */
#include "checker/checker.h"
#include "base/alloc.h"
#include "base/error.h"

#include <string.h>

/* ---- words ---- */

dyd_status dyd_cert_expect_word(dyd_checker *c, const char *name) {
  char *word = NULL;
  dyd_status st = dyd_cert_word(&word, &c->in);
  if (st != DYD_OK) return st;
  return strcmp(word, name) == 0 ? DYD_OK : dyd_cert_reject(&c->in, "\"%s\" is missing", name);
}

dyd_status dyd_cert_expect_line(dyd_checker *c, const char *name) {
  dyd_status st = dyd_cert_next_line(&c->in);
  return st == DYD_OK ? dyd_cert_expect_word(c, name) : st;
}

dyd_status dyd_cert_read_choice(size_t *out, dyd_checker *c, const char *const *text, size_t count) {
  char *word = NULL;
  dyd_status st = dyd_cert_word(&word, &c->in);
  if (st != DYD_OK) return st;
  for (*out = 0; *out < count; ++*out)
    if (strcmp(word, text[*out]) == 0) return DYD_OK;
  return dyd_cert_reject(&c->in, "\"%.40s\" is no word that may stand here", word);
}

/* A line "NAME count"; the count is at most `most`. */
static dyd_status read_heading(uint32_t *count, dyd_checker *c, const char *name, uint64_t most) {
  dyd_status st = dyd_cert_expect_line(c, name);
  if (st == DYD_OK) st = dyd_cert_read_index(count, &c->in, most);
  return st == DYD_OK ? dyd_cert_line_done(&c->in) : st;
}

dyd_status dyd_cert_read_site(uint32_t *out, dyd_checker *c) {
  if (c->sites.count == 0) return dyd_cert_reject(&c->in, "there is no site");
  dyd_status st = dyd_cert_read_index(out, &c->in, c->sites.count - 1);
  if (st != DYD_OK) return st;
  if (c->sites.site[*out].alias != *out) return dyd_cert_reject(&c->in, "site %u is an alias", (unsigned)*out);
  return DYD_OK;
}

dyd_status dyd_cert_read_pair(dyd_cert_edge *pair, dyd_checker *c) {
  dyd_cert_edge next;
  dyd_status st = dyd_cert_read_site(&next.i, c);
  if (st == DYD_OK) st = dyd_cert_read_site(&next.j, c);
  if (st != DYD_OK) return st;
  if (next.i >= next.j) return dyd_cert_reject(&c->in, "the second site must have the larger number");
  if (next.i < pair->i || (next.i == pair->i && next.j <= pair->j))
    return dyd_cert_reject(&c->in, "pairs are not in order");
  *pair = next;
  return DYD_OK;
}

/* A line "i x y" of a list sorted by i; *i is that of the line before. The point is c->point. */
static dyd_status read_site_and_point(uint32_t *i, dyd_checker *c, bool first, const char *list) {
  uint32_t last = *i;
  dyd_status st = dyd_cert_next_line(&c->in);
  if (st == DYD_OK) st = dyd_cert_read_site(i, c);
  if (st == DYD_OK) st = dyd_cert_read_point(c->point, &c->in);
  if (st == DYD_OK) st = dyd_cert_line_done(&c->in);
  if (st == DYD_OK && !first && *i <= last) st = dyd_cert_reject(&c->in, "%s are not in order", list);
  return st;
}

void dyd_cert_note_bound(dyd_checker *c, const char *goal, const dyd_exact *bound) {
  if (strcmp(c->report.goal, goal) != 0) return;
  dyd_exact most;
  dyd_exact_init(&most);
  mpz_set_ui(most.man, 1);
  most.exp = -c->report.goal_bits;
  c->reached = dyd_exact_cmp(bound, &most) <= 0;
  dyd_exact_clear(&most);
}

/* ---- head ---- */

static dyd_status check_goal(dyd_checker *c) {
  static const char *const first[] = {"decided", "nearest", "area", "hausdorff", "voronoi"},
                           *const second[] = {"area", "hausdorff"},
                           *const voronoi[] = {"voronoi area", "voronoi hausdorff"};
  size_t k = 0, m = 0;
  dyd_status st = dyd_cert_expect_line(c, "goal");
  if (st == DYD_OK) st = dyd_cert_read_choice(&k, c, first, 5);
  if (st == DYD_OK && k == 4) st = dyd_cert_read_choice(&m, c, second, 2);
  if (st == DYD_OK && k > 1) st = dyd_cert_read_integer(&c->report.goal_bits, &c->in);
  if (st != DYD_OK) return st;
  c->report.goal = k == 4 ? voronoi[m] : first[k];
  return dyd_cert_line_done(&c->in);
}

dyd_status dyd_checker_head(dyd_checker *c) {
  static const char *const outcome[] = {"decided", "certified", "fixpoint", "budget", "cancelled", "error"};
  static const char *const answer[] = {"no", "yes"};
  size_t k = 0;
  dyd_status st = dyd_cert_next_line(&c->in);
  if (st == DYD_OK && strcmp(c->in.line, "dyadel certificate 1") != 0)
    st = dyd_cert_reject(&c->in, "this is no \"dyadel certificate 1\"");
  if (st == DYD_OK) st = dyd_cert_expect_line(c, "outcome");
  if (st == DYD_OK) st = dyd_cert_read_choice(&k, c, outcome, 6);
  if (st == DYD_OK) st = dyd_cert_line_done(&c->in);
  if (st != DYD_OK) return st;
  c->report.outcome = outcome[k];
  st = check_goal(c);
  if (st == DYD_OK) st = dyd_cert_expect_line(c, "capped");
  if (st == DYD_OK) st = dyd_cert_read_choice(&k, c, answer, 2);
  c->report.capped = k == 1;
  return st == DYD_OK ? dyd_cert_line_done(&c->in) : st;
}

/* ---- sites ---- */

static dyd_status read_alias(dyd_checker *c) {
  uint32_t own = (uint32_t)c->sites.count, of;
  dyd_status st = dyd_cert_expect_word(c, "=");
  if (st == DYD_OK) st = dyd_cert_read_site(&of, c);
  if (st != DYD_OK) return st;
  dyd_cert_site *site = dyd_cert_sites_add(&c->sites);
  if (!site) return DYD_E_NOMEM;
  for (int a = 0; a < 2 && st == DYD_OK; a++) {
    const dyd_cert_side *from = &c->sites.site[of].side[a];
    dyd_exact_set(&site->side[a].lo, &from->lo);
    dyd_exact_set(&site->side[a].hi, &from->hi);
    site->side[a].point = from->point;
    if (from->den) st = dyd_cert_side_set_den(&site->side[a], *from->den);
  }
  c->sites.site[own].alias = of;
  c->report.aliases++;
  return st;
}

static dyd_status read_rectangle(dyd_checker *c) {
  dyd_cert_site *site = dyd_cert_sites_add(&c->sites);
  if (!site) return DYD_E_NOMEM;
  dyd_status st = dyd_cert_read_side(&site->side[0], &c->in);
  if (st == DYD_OK) st = dyd_cert_read_side(&site->side[1], &c->in);
  return st;
}

dyd_status dyd_checker_sites(dyd_checker *c) {
  uint32_t count = 0;
  dyd_status st = read_heading(&count, c, "sites", (uint64_t)1 << 28);
  for (uint32_t i = 0; i < count && st == DYD_OK; i++) {
    st = dyd_cert_next_line(&c->in);
    if (st == DYD_OK) st = c->in.line[0] == '=' ? read_alias(c) : read_rectangle(c);
    if (st == DYD_OK) st = dyd_cert_line_done(&c->in);
  }
  c->report.sites = count;
  if (st == DYD_OK) st = dyd_cert_sites_finish(&c->sites);
  if (st == DYD_OK) st = dyd_cert_tree_init(&c->tree, &c->sites);
  return st == DYD_E_NOMEM ? dyd_fail_nomem(c->in.err) : st;
}

/* ---- legal pairs and bridges ---- */

static dyd_status read_witnessed(dyd_checker *c, dyd_cert_edges *to, dyd_cert_edge *pair, bool places) {
  uint32_t other = 0;
  dyd_status st = dyd_cert_next_line(&c->in);
  if (st == DYD_OK) st = dyd_cert_read_pair(pair, c);
  if (st == DYD_OK) st = dyd_cert_read_point(c->point, &c->in);
  if (st == DYD_OK) st = dyd_cert_line_done(&c->in);
  if (st != DYD_OK) return st;
  if (!dyd_cert_is_witness(&other, &c->sites, &c->tree, pair->i, pair->j, c->point, places))
    return dyd_cert_reject(&c->in, "the point is no witness of %u %u: site %u may be as near", (unsigned)pair->i,
                           (unsigned)pair->j, (unsigned)other);
  return dyd_cert_edges_add(to, pair->i, pair->j) != DYD_OK ? dyd_fail_nomem(c->in.err) : DYD_OK;
}

static dyd_status read_edges(dyd_checker *c, dyd_cert_edges *to, const char *name, bool places) {
  uint32_t count;
  dyd_cert_edge pair = {0, 0};
  dyd_status st = read_heading(&count, c, name, UINT32_MAX / 4);
  for (uint32_t e = 0; e < count && st == DYD_OK; e++) st = read_witnessed(c, to, &pair, places);
  return st;
}

dyd_status dyd_checker_legal(dyd_checker *c) {
  dyd_status st = read_edges(c, &c->legal, "legal", false);
  c->report.legal = c->legal.count;
  return st;
}

/* Is v in the side? */
static bool side_holds_value(const dyd_cert_side *s, const dyd_exact *v) {
  if (s->den) return false; /* a dyadic is not a fraction in lowest terms */
  return dyd_exact_cmp(v, &s->lo) >= 0 && dyd_exact_cmp(v, dyd_cert_high(s)) <= 0;
}

dyd_status dyd_checker_places(dyd_checker *c) {
  uint32_t count, i = 0;
  dyd_status st = read_heading(&count, c, "places", c->sites.count);
  for (uint32_t q = 0; q < count && st == DYD_OK; q++) {
    st = read_site_and_point(&i, c, q == 0, "places");
    if (st != DYD_OK) return st;
    dyd_cert_site *site = &c->sites.site[i];
    if (!side_holds_value(&site->side[0], &c->point[0]) || !side_holds_value(&site->side[1], &c->point[1]))
      return dyd_cert_reject(&c->in, "the place is not in the rectangle of site %u", (unsigned)i);
    if (dyd_cert_site_set_place(site, c->point) != DYD_OK) return dyd_fail_nomem(c->in.err);
  }
  return st;
}

dyd_status dyd_checker_bridges(dyd_checker *c) {
  return read_edges(c, &c->bridges, "bridges", true);
}

/* ---- corners ---- */

void dyd_cert_corners_clear(dyd_cert_corners *c) {
  for (size_t q = 0; q < c->count; q++) {
    dyd_exact_clear(&c->item[q].u[0]);
    dyd_exact_clear(&c->item[q].u[1]);
  }
  free(c->item);
  *c = (dyd_cert_corners){0};
}

static dyd_status corners_add(dyd_cert_corners *c, uint32_t i, const dyd_exact u[2]) {
  if (!dyd_reserve((void **)&c->item, &c->cap, c->count + 1, sizeof *c->item)) return DYD_E_NOMEM;
  dyd_cert_corner *corner = &c->item[c->count++];
  corner->i = i;
  for (int a = 0; a < 2; a++) {
    dyd_exact_init(&corner->u[a]);
    dyd_exact_set(&corner->u[a], &u[a]);
  }
  return DYD_OK;
}

static dyd_status checker_find_faces(dyd_checker *c) {
  uint32_t bad;
  dyd_status st = dyd_cert_graph_init(&c->graph, &c->sites, &c->legal, &c->bridges);
  if (st == DYD_OK && c->graph.redundant)
    return dyd_cert_reject(&c->in, "a bridge joins sites that are connected without it");
  if (st == DYD_OK) st = dyd_cert_faces_init(&c->faces, &bad, &c->graph, c->corners.item, c->corners.count);
  if (st != DYD_OK) return dyd_fail_nomem(c->in.err);
  if (bad != DYD_CERT_NONE) return dyd_cert_reject(&c->in, "site %u is not proved to be a corner", (unsigned)bad);
  c->report.connected = c->graph.connected;
  c->report.undecided_sets = c->faces.sets;
  return DYD_OK;
}

dyd_status dyd_checker_corners(dyd_checker *c) {
  uint32_t count, i = 0;
  dyd_status st = read_heading(&count, c, "corners", c->sites.count);
  for (uint32_t q = 0; q < count && st == DYD_OK; q++) {
    st = read_site_and_point(&i, c, q == 0, "corners");
    if (st == DYD_OK && corners_add(&c->corners, i, c->point) != DYD_OK) st = dyd_fail_nomem(c->in.err);
  }
  c->report.corners = count;
  return st == DYD_OK ? checker_find_faces(c) : st;
}
