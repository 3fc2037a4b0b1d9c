/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Bridges of a certificate.
 *
 * The strictly Delaunay edges of distinct points connect them (a shortest spanning tree consists of such
 * edges), and they do not cross legal edges, which are strictly Delaunay for these points too. So the triangulation
 * of the places, computed as of exact points, has bridges enough, each with a witness. */
#include "base/alloc.h"
#include "prove/proof.h"

/* ---- places ---- */

/* The place of a site as an exact point. */
static dyd_status place_rect(dyd_rect *out, const dyd_cert_site *s) {
  dyd_status st = DYD_OK;
  for (int a = 0; a < 2 && st == DYD_OK; a++) {
    mpz_srcptr den;
    const dyd_exact *at = dyd_cert_place(&den, s, a);
    dyd_interval *side = a ? &out->y : &out->x;
    dyd_dyadic v;
    mpq_t q;
    dyd_dyadic_init(&v);
    mpq_init(q);
    st = dyd_dyadic_set_z_2exp(&v, at->man, at->exp);
    dyd_dyadic_get_q(q, &v);
    if (den) mpz_mul(mpq_denref(q), mpq_denref(q), den);
    if (den) mpq_canonicalize(q);
    if (st == DYD_OK) st = dyd_interval_set_q(side, q);
    mpq_clear(q);
    dyd_dyadic_clear(&v);
  }
  return st;
}

/* Moves a place that another site has too to a point of the rectangle that depends on the number of the site. */
static dyd_status move_place(dyd_cert_site *s, uint32_t i, unsigned round) {
  dyd_exact at[2], width;
  dyd_exact_init(&width);
  uint64_t part[2] = {i, (i + 1) * UINT64_C(0x9E3779B97F4A7C15) >> 32};
  dyd_status st = DYD_OK;
  for (int a = 0; a < 2; a++) {
    dyd_exact_init(&at[a]);
    if (s->side[a].den) st = DYD_E_ARG; /* a place is given in dyadics */
    dyd_exact_set(&at[a], &s->side[a].lo);
    if (s->side[a].point) continue;
    dyd_exact_sub(&width, &s->side[a].hi, &s->side[a].lo);
    mpz_mul_ui(width.man, width.man, 2 * (unsigned long)(part[a] ^ round * 0x5555u) + 1);
    width.exp -= 34;
    dyd_exact_add(&at[a], &at[a], &width);
    dyd_proof_trim(&at[a]);
  }
  if (st == DYD_OK) st = dyd_cert_site_set_place(s, at);
  dyd_exact_clear(&at[0]);
  dyd_exact_clear(&at[1]);
  dyd_exact_clear(&width);
  return st == DYD_E_ARG ? DYD_OK : st;
}

/* The places as a table of exact points, site[k] being the site of point k. */
static dyd_status table_of_places(dyd_sites *out, uint32_t *site, const dyd_proof *p) {
  dyd_rect r;
  dyd_rect_init(&r);
  dyd_status st = DYD_OK;
  size_t count = 0;
  for (size_t i = 0; i < p->sites.count && st == DYD_OK; i++) {
    if (p->sites.site[i].alias != i) continue;
    site[count++] = (uint32_t)i;
    st = place_rect(&r, &p->sites.site[i]);
    if (st == DYD_OK) st = dyd_sites_add_rect(out, &r);
  }
  dyd_rect_clear(&r);
  return st;
}

/* ---- bridges ---- */

static bool bridge_join(uint32_t *parent, uint32_t a, uint32_t b) {
  a = dyd_cert_root(parent, a);
  b = dyd_cert_root(parent, b);
  parent[a] = b;
  return a != b;
}

static dyd_status add_bridges(dyd_proof *p, uint32_t *parent, const dyd_delaunay *pd, const uint32_t *site) {
  dyd_pair_list pairs = {0};
  dyd_point c;
  dyd_point_init(&c);
  dyd_status st = dyd_delaunay_pairs(&pairs, pd);
  for (size_t k = 0; k < pairs.count && st == DYD_OK; k++) {
    const dyd_pair *pair = &pairs.item[k];
    uint32_t i = site[pair->i], j = site[pair->j];
    if (pair->status != DYD_LEGAL || dyd_cert_root(parent, i) == dyd_cert_root(parent, j)) continue;
    bool found = false;
    st = dyd_delaunay_witness(&c, pd, pair->i, pair->j);
    if (st == DYD_OK) st = dyd_proof_add_witness(&found, &p->centre, p, i, j, &c, true);
    if (st == DYD_E_RANGE) st = DYD_OK; /* no witness: another bridge may do */
    if (st != DYD_OK || !found) continue;
    bridge_join(parent, i, j);
    st = dyd_cert_edges_add(&p->bridges, i, j);
  }
  dyd_point_clear(&c);
  dyd_pair_list_clear(&pairs);
  return st;
}

/* *apart: no two places coincide; else places are moved, and it may be tried again. */
static dyd_status try_bridges(bool *apart, dyd_proof *p, uint32_t *parent, uint32_t *site, unsigned round) {
  dyd_sites *table = NULL;
  dyd_delaunay *pd = NULL;
  dyd_status st = dyd_sites_new(&table);
  if (st == DYD_OK) st = table_of_places(table, site, p);
  if (st == DYD_OK) st = dyd_delaunay_new(&pd, table, NULL, NULL);
  if (st == DYD_CAPPED) st = DYD_OK; /* its legal pairs will do */
  *apart = true;
  for (size_t k = 0; st == DYD_OK && k < dyd_sites_count(table); k++) {
    uint32_t other = dyd_delaunay_alias(pd, (uint32_t)k);
    if (other == k) continue;
    *apart = false;
    st = move_place(&p->sites.site[site[k]], site[k], round);
    if (st == DYD_OK) st = move_place(&p->sites.site[site[other]], site[other], round);
  }
  if (st == DYD_OK && *apart) st = add_bridges(p, parent, pd, site);
  dyd_delaunay_free(pd);
  dyd_sites_free(table);
  return st;
}

/* Unites what the legal edges join; returns how many parts are left. */
static size_t bridge_unite(uint32_t *parent, const dyd_proof *p) {
  size_t parts = 0;
  for (size_t v = 0; v < p->sites.count; v++) {
    parent[v] = (uint32_t)v;
    parts += p->sites.site[v].alias == v;
  }
  for (size_t e = 0; e < p->legal.count; e++) parts -= bridge_join(parent, p->legal.item[e].i, p->legal.item[e].j);
  return parts;
}

/* Two joined sites with one place are possible when the two are all there are. */
static bool have_joined_places(const dyd_proof *p) {
  for (size_t e = 0; e < p->legal.count; e++)
    if (dyd_cert_compare_places(&p->sites, p->legal.item[e].i, p->legal.item[e].j) == 0) return true;
  return false;
}

static void drop_bridges(dyd_proof *p) {
  dyd_proof_points_clear(&p->centre);
  p->bridges.count = 0;
}

dyd_status dyd_proof_find_bridges(dyd_proof *p) {
  size_t n = p->sites.count;
  uint32_t *parent = dyd_alloc(n, sizeof *parent), *site = dyd_alloc(n, sizeof *site);
  dyd_status st = parent && site ? DYD_OK : DYD_E_NOMEM;
  if (st == DYD_OK && (bridge_unite(parent, p) > 1 || have_joined_places(p))) {
    bool apart = false;
    for (unsigned round = 0; round < 4 && st == DYD_OK && !apart; round++)
      st = try_bridges(&apart, p, parent, site, round);
    if (st == DYD_E_RANGE || (st == DYD_OK && !apart)) {
      drop_bridges(p);
      st = DYD_OK;
    }
  }
  free(parent);
  free(site);
  return st;
}
