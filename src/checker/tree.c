/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* A tree of boxes on the grid: items sorted along a Z-curve, boxes of eight, of eight times eight, and so on. */
#include "checker/tree.h"
#include "base/alloc.h"

typedef struct keyed {
  uint64_t key;
  uint32_t site;
} keyed;

/* Spreads the low 32 bits to the even places. */
static uint64_t spread_bits(uint64_t v) {
  v = (v | v << 16) & UINT64_C(0x0000FFFF0000FFFF);
  v = (v | v << 8) & UINT64_C(0x00FF00FF00FF00FF);
  v = (v | v << 4) & UINT64_C(0x0F0F0F0F0F0F0F0F);
  v = (v | v << 2) & UINT64_C(0x3333333333333333);
  return (v | v << 1) & UINT64_C(0x5555555555555555);
}

static uint64_t key_of_box(const dyd_cert_box *b) {
  uint64_t x = ((uint64_t)b->e[0] + (uint64_t)b->e[1]) / 2, y = ((uint64_t)b->e[2] + (uint64_t)b->e[3]) / 2;
  return spread_bits(x) | spread_bits(y) << 1;
}

static int compare_keyed(const void *a, const void *b) {
  const keyed *x = a, *y = b;
  if (x->key != y->key) return x->key < y->key ? -1 : 1;
  return (x->site > y->site) - (x->site < y->site);
}

static dyd_status sort_tree_items(dyd_cert_tree *t, const dyd_cert_sites *s) {
  keyed *k = dyd_alloc(s->count, sizeof *k);
  t->item = dyd_alloc(s->count, sizeof *t->item);
  if (k && t->item) {
    for (size_t i = 0; i < s->count; i++)
      if (s->site[i].alias == i) k[t->count++] = (keyed){key_of_box(&s->box[i]), (uint32_t)i};
    qsort(k, t->count, sizeof *k, compare_keyed);
    for (size_t q = 0; q < t->count; q++) t->item[q] = k[q].site;
  }
  dyd_status st = k && t->item ? DYD_OK : DYD_E_NOMEM;
  free(k);
  return st;
}

static void enclose_child(dyd_cert_box *out, const dyd_cert_box *b, bool first) {
  for (int k = 0; k < 4; k++)
    if (first || (k % 2 ? b->e[k] > out->e[k] : b->e[k] < out->e[k])) out->e[k] = b->e[k];
}

static const dyd_cert_box *tree_child(const dyd_cert_tree *t, int level, size_t q) {
  return level == 0 ? &t->box[t->item[q]] : &t->node[t->start[level - 1] + q];
}

static size_t size_below(const dyd_cert_tree *t, int level) {
  return level == 0 ? t->count : t->start[level] - t->start[level - 1];
}

static void fill_level(dyd_cert_tree *t, int level) {
  size_t children = size_below(t, level), nodes = (children + DYD_CERT_FANOUT - 1) / DYD_CERT_FANOUT;
  for (size_t q = 0; q < children; q++)
    enclose_child(&t->node[t->start[level] + q / DYD_CERT_FANOUT], tree_child(t, level, q), q % DYD_CERT_FANOUT == 0);
  t->start[level + 1] = t->start[level] + nodes;
}

dyd_status dyd_cert_tree_init(dyd_cert_tree *t, const dyd_cert_sites *s) {
  *t = (dyd_cert_tree){.box = s->box};
  dyd_status st = sort_tree_items(t, s);
  t->node = dyd_alloc(t->count / 4 + DYD_CERT_LEVELS, sizeof *t->node); /* 1/8 + 1/64 + ... < 1/4, one more a level */
  if (st != DYD_OK || !t->node) {
    dyd_cert_tree_clear(t);
    return DYD_E_NOMEM;
  }
  do fill_level(t, t->levels);
  while (size_below(t, ++t->levels) > 1);
  return DYD_OK;
}

void dyd_cert_tree_clear(dyd_cert_tree *t) {
  free(t->item);
  free(t->node);
  *t = (dyd_cert_tree){0};
}

/* ---- distances on the grid ---- */

void dyd_cert_centre_set(dyd_cert_centre *out, const dyd_cert_sites *s, const dyd_exact c[2]) {
  mpz_t t;
  mpz_init(t);
  out->far = false;
  for (int k = 0; k < 4; k++) {
    (k % 2 ? dyd_exact_ceil : dyd_exact_floor)(t, &c[k / 2], NULL, s->unit);
    mpz_sub(t, t, s->origin[k / 2]);
    out->far |= mpz_sizeinbase(t, 2) > 60;
    out->e[k] = out->far ? 0 : mpz_get_si(t);
  }
  mpz_clear(t);
}

dyd_cert_area dyd_cert_far_upper(const dyd_cert_centre *c, const dyd_cert_box *b) {
  dyd_cert_area sum = 0;
  for (int a = 0; a < 4; a += 2) {
    int64_t left = c->e[a + 1] - b->e[a], right = b->e[a + 1] - c->e[a];
    sum += dyd_cert_square(left > right ? left : right);
  }
  return sum;
}

/* A lower bound of that to its closest point. */
static dyd_cert_area near_lower(const dyd_cert_centre *c, const dyd_cert_box *b) {
  dyd_cert_area sum = 0;
  for (int a = 0; a < 4; a += 2) {
    int64_t left = b->e[a] - c->e[a + 1], right = c->e[a] - b->e[a + 1], d = left > right ? left : right;
    if (d > 0) sum += dyd_cert_square(d);
  }
  return sum;
}

static bool visit_node(const dyd_cert_tree *t, int level, size_t q, const dyd_cert_centre *c, dyd_cert_area limit,
                       dyd_cert_visit *visit, void *context) {
  size_t first = q * DYD_CERT_FANOUT, last = first + DYD_CERT_FANOUT, size = size_below(t, level);
  for (size_t child = first; child < last && child < size; child++) {
    if (!c->far && near_lower(c, tree_child(t, level, child)) > limit) continue;
    bool more = level == 0 ? visit(context, t->item[child]) : visit_node(t, level - 1, child, c, limit, visit, context);
    if (!more) return false;
  }
  return true;
}

bool dyd_cert_tree_visit(const dyd_cert_tree *t, const dyd_cert_centre *c, dyd_cert_area limit, dyd_cert_visit *visit,
                         void *context) {
  return t->count == 0 || visit_node(t, t->levels - 1, 0, c, limit, visit, context);
}
