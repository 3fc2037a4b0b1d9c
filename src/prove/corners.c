/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Corners of a certificate: a direction in which a site is surely beyond the parts of the rim on either side.
 *
 * All differences of a point of those sites and a point of the corner's rectangle must lie in an open half-plane; they
 * span a cone, and a direction at an obtuse angle to both of its sides will do. Integers only. */
#include "base/alloc.h"
#include "checker/parts.h"
#include "prove/proof.h"

/* The walk of the unbounded face as sites, and which of them may be corners. */
typedef struct rim {
  uint32_t *walk, *site;
  size_t count;
  bool *corner; /* by site */
} rim;

static dyd_status make_rim(rim *r, const dyd_proof *p) {
  dyd_status st = dyd_cert_walk(&r->walk, &r->count, &p->graph, dyd_cert_outer(&p->graph));
  if (st != DYD_OK) return st;
  r->site = dyd_alloc(r->count, sizeof *r->site);
  if (!r->site) return DYD_E_NOMEM;
  for (size_t q = 0; q < r->count; q++) r->site[q] = dyd_cert_origin(&p->graph, r->walk[q]);
  uint32_t *copy = dyd_alloc(r->count, sizeof *copy), *times = calloc(p->sites.count, sizeof *times);
  r->corner = dyd_alloc(p->sites.count, sizeof *r->corner);
  size_t kept = 0;
  if (copy && times && r->corner) {
    for (size_t q = 0; q < r->count; q++)
      if (times[r->site[q]]++ == 0) copy[kept++] = r->site[q];
    st = dyd_cert_hull(r->corner, &p->sites, copy, kept);
    for (size_t q = 0; q < r->count; q++)
      if (times[r->site[q]] > 1) r->corner[r->site[q]] = false;
  } else {
    st = DYD_E_NOMEM;
  }
  free(copy);
  free(times);
  return st;
}

/* A cone of directions: all d with first x d >= 0 >= last x d. */
typedef struct cone {
  dyd_exact first[2], last[2];
  bool empty, broken; /* broken: a half-plane or more */
} cone;

/* Sign of the cross product, exactly. */
static int cone_cross(const dyd_exact a[2], const dyd_exact b[2]) {
  dyd_exact s, t;
  dyd_exact_init(&s);
  dyd_exact_init(&t);
  dyd_exact_mul(&s, &a[0], &b[1]);
  dyd_exact_mul(&t, &a[1], &b[0]);
  int sign = dyd_exact_cmp(&s, &t);
  dyd_exact_clear(&s);
  dyd_exact_clear(&t);
  return sign;
}

static int cone_dot(const dyd_exact a[2], const dyd_exact b[2]) {
  dyd_exact s, t;
  dyd_exact_init(&s);
  dyd_exact_init(&t);
  dyd_exact_mul(&s, &a[0], &b[0]);
  dyd_exact_mul(&t, &a[1], &b[1]);
  dyd_exact_add(&s, &s, &t);
  int sign = dyd_exact_sgn(&s);
  dyd_exact_clear(&s);
  dyd_exact_clear(&t);
  return sign;
}

static void set_direction(dyd_exact out[2], const dyd_exact d[2]) {
  dyd_exact_set(&out[0], &d[0]);
  dyd_exact_set(&out[1], &d[1]);
}

static void cone_widen(cone *k, const dyd_exact d[2]) {
  if (k->broken) return;
  if (!dyd_exact_sgn(&d[0]) && !dyd_exact_sgn(&d[1])) {
    k->broken = true;
  } else if (k->empty) {
    set_direction(k->first, d);
    set_direction(k->last, d);
    k->empty = false;
  } else {
    int a = cone_cross(k->first, d), b = cone_cross(d, k->last);
    if (a >= 0 && b >= 0 && (a || b || cone_dot(k->first, d) > 0)) return; /* inside */
    bool before = a < 0 && cone_cross(d, k->last) > 0, after = b < 0 && cone_cross(k->first, d) > 0;
    if (before)
      set_direction(k->first, d);
    else if (after)
      set_direction(k->last, d);
    else
      k->broken = true;
  }
}

/* The cone takes in all differences of a point of w and a point of v. */
static void cone_take_in(cone *k, const dyd_cert_sites *s, uint32_t v, uint32_t w) {
  dyd_cert_fraction end[2][2];
  dyd_exact d[2];
  for (int q = 0; q < 4; q++) dyd_cert_fraction_init(&end[q / 2][q % 2]);
  dyd_exact_init(&d[0]);
  dyd_exact_init(&d[1]);
  for (int a = 0; a < 2; a++) {
    const dyd_cert_side *from = &s->site[v].side[a], *to = &s->site[w].side[a];
    dyd_cert_fraction_sub(&end[a][0], &to->lo, dyd_cert_den(to), dyd_cert_high(from), dyd_cert_den(from));
    dyd_cert_fraction_sub(&end[a][1], dyd_cert_high(to), dyd_cert_den(to), &from->lo, dyd_cert_den(from));
  }
  for (int q = 0; q < 4; q++) {
    const dyd_cert_fraction *x = &end[0][q / 2], *y = &end[1][q % 2];
    dyd_exact_set(&d[0], &x->num);
    dyd_exact_set(&d[1], &y->num);
    if (!y->whole) dyd_exact_mul_z(&d[0], &d[0], y->den);
    if (!x->whole) dyd_exact_mul_z(&d[1], &d[1], x->den);
    cone_widen(k, (const dyd_exact *)d);
  }
  for (int q = 0; q < 4; q++) dyd_cert_fraction_clear(&end[q / 2][q % 2]);
  dyd_exact_clear(&d[0]);
  dyd_exact_clear(&d[1]);
}

/* ---- a direction ---- */

/* Scales d to about `bits` bits, rounding. */
static void cut_direction(dyd_exact out[2], const dyd_exact d[2], int64_t bits) {
  int64_t x = dyd_exact_top(&d[0]), y = dyd_exact_top(&d[1]), top = x > y ? x : y;
  for (int a = 0; a < 2; a++) {
    dyd_proof_round(&out[a], &d[a], top - bits);
    out[a].exp -= top - bits;
  }
}

/* out = d turned a quarter, counter-clockwise for sign = 1. */
static void turn_quarter(dyd_exact out[2], const dyd_exact d[2], int sign) {
  dyd_exact_set(&out[0], &d[1]);
  dyd_exact_set(&out[1], &d[0]);
  mpz_neg(out[sign > 0 ? 0 : 1].man, out[sign > 0 ? 0 : 1].man);
}

/* u = a direction at an obtuse angle to the sides of the cone, as far as so many bits allow. */
static void cone_choose(dyd_exact u[2], const cone *k, int64_t bits) {
  dyd_exact a[2], b[2], t[2];
  for (int q = 0; q < 2; q++) {
    dyd_exact_init(&a[q]);
    dyd_exact_init(&b[q]);
    dyd_exact_init(&t[q]);
  }
  bool wide = cone_dot(k->first, k->last) <= 0;
  cut_direction(a, k->first, bits);
  cut_direction(b, k->last, bits);
  if (wide) {
    turn_quarter(t, (const dyd_exact *)a, -1);
    turn_quarter(a, (const dyd_exact *)b, 1);
  } else {
    set_direction(t, (const dyd_exact *)b);
  }
  for (int q = 0; q < 2; q++) {
    dyd_exact_add(&u[q], &a[q], &t[q]);
    if (!wide) mpz_neg(u[q].man, u[q].man);
    dyd_proof_trim(&u[q]);
    dyd_exact_clear(&a[q]);
    dyd_exact_clear(&b[q]);
    dyd_exact_clear(&t[q]);
  }
}

/* Two lists of sites. */
typedef struct crowds {
  const uint32_t *site[2];
  size_t count[2];
} crowds;

/* For the sites beside v: takes them into the cone (u = NULL), or asks whether v is beyond them all in direction u. */
static bool each_beside(cone *k, const dyd_exact *u, const dyd_proof *p, uint32_t v, const crowds *beside) {
  for (int way = 0; way < 2; way++) {
    for (size_t m = 0; m < beside->count[way]; m++) {
      uint32_t w = beside->site[way][m];
      if (w == v) continue;
      if (!u)
        cone_take_in(k, &p->sites, v, w);
      else if (dyd_cert_compare_heights(&p->sites, u, w, v) >= 0)
        return false;
      if (k->broken) return false;
    }
  }
  return true;
}

static bool find_direction(dyd_exact u[2], const dyd_proof *p, uint32_t v, const crowds *beside) {
  cone k = {.empty = true};
  for (int a = 0; a < 2; a++) {
    dyd_exact_init(&k.first[a]);
    dyd_exact_init(&k.last[a]);
  }
  bool found = false;
  if (each_beside(&k, NULL, p, v, beside) && !k.empty)
    for (int64_t bits = 3; bits <= (int64_t)1 << 14 && !found; bits += bits / 2 + 1) {
      cone_choose(u, &k, bits);
      found = each_beside(&k, u, p, v, beside);
    }
  for (int a = 0; a < 2; a++) {
    dyd_exact_clear(&k.first[a]);
    dyd_exact_clear(&k.last[a]);
  }
  return found;
}

bool dyd_proof_find_direction(dyd_exact u[2], const dyd_proof *p, uint32_t v, const uint32_t *site, size_t count) {
  const crowds all = {{site, NULL}, {count, 0}};
  return find_direction(u, p, v, &all);
}

/* ---- all corners ---- */

/* The sites of the two groups at the corner at position q. */
static crowds groups_beside(const rim *r, const dyd_cert_parts *parts, size_t q) {
  crowds out;
  for (int way = 0; way < 2; way++) {
    uint32_t group = parts->group[way ? q : (q + r->count - 1) % r->count];
    out.site[way] = parts->site + parts->start[group];
    out.count[way] = parts->start[group + 1] - parts->start[group];
  }
  return out;
}

static dyd_status keep_corner(dyd_proof *p, uint32_t v, const dyd_exact u[2]) {
  if (!dyd_reserve((void **)&p->corner, &p->corner_cap, p->corners + 1, sizeof *p->corner)) return DYD_E_NOMEM;
  dyd_cert_corner *c = &p->corner[p->corners++];
  c->i = v;
  for (int a = 0; a < 2; a++) {
    dyd_exact_init(&c->u[a]);
    dyd_exact_set(&c->u[a], &u[a]);
  }
  return DYD_OK;
}

static bool have_corner(const rim *r) {
  for (size_t q = 0; q < r->count; q++)
    if (r->corner[r->site[q]]) return true;
  return false;
}

void dyd_proof_drop_corners(dyd_proof *p) {
  for (size_t q = 0; q < p->corners; q++) {
    dyd_exact_clear(&p->corner[q].u[0]);
    dyd_exact_clear(&p->corner[q].u[1]);
  }
  p->corners = 0;
}

/* Keeps the corners that have a direction; *again: some have none and are corners no more, so parts have grown. */
static dyd_status try_corners(bool *again, dyd_proof *p, rim *r) {
  dyd_cert_parts parts;
  dyd_exact u[2];
  *again = false;
  dyd_proof_drop_corners(p);
  dyd_status st = dyd_cert_parts_init(&parts, &p->graph, r->walk, r->count, r->corner);
  if (st != DYD_OK) return st;
  dyd_exact_init(&u[0]);
  dyd_exact_init(&u[1]);
  for (size_t q = 0; q < r->count && st == DYD_OK; q++) {
    if (!r->corner[r->site[q]]) continue;
    const crowds beside = groups_beside(r, &parts, q);
    if (find_direction(u, p, r->site[q], &beside)) {
      st = keep_corner(p, r->site[q], (const dyd_exact *)u);
    } else {
      r->corner[r->site[q]] = false;
      *again = true;
    }
  }
  dyd_exact_clear(&u[0]);
  dyd_exact_clear(&u[1]);
  dyd_cert_parts_clear(&parts);
  return st;
}

static int compare_corner_sites(const void *a, const void *b) {
  uint32_t x = ((const dyd_cert_corner *)a)->i, y = ((const dyd_cert_corner *)b)->i;
  return (x > y) - (x < y);
}

static dyd_status rim_corners(dyd_proof *p) {
  if (!p->graph.connected || p->graph.count == 0) return DYD_OK;
  rim r = {0};
  dyd_status st = make_rim(&r, p);
  for (bool again = true; again && st == DYD_OK;) {
    again = false;
    if (have_corner(&r))
      st = try_corners(&again, p, &r);
    else
      dyd_proof_drop_corners(p);
  }
  if (p->corners) qsort(p->corner, p->corners, sizeof *p->corner, compare_corner_sites);
  free(r.walk);
  free(r.site);
  free(r.corner);
  return st;
}

dyd_status dyd_proof_find_faces(dyd_proof *p) {
  uint32_t bad = DYD_CERT_NONE;
  dyd_status st = dyd_cert_graph_init(&p->graph, &p->sites, &p->legal, &p->bridges);
  if (st == DYD_OK) st = rim_corners(p);
  if (st == DYD_OK) st = dyd_cert_faces_init(&p->faces, &bad, &p->graph, p->corner, p->corners);
  return st;
}
