/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The life of expressions: drafts that grow while they are parsed, and finished ones in one block. */
#include "stream/expr.h"

#include "base/alloc.h"
#include <string.h>

void dyd_draft_init(dyd_draft *d) {
  d->e = (dyd_expr){.node = d->node, .constant = d->constant};
  d->node_cap = sizeof d->node / sizeof *d->node;
  d->constant_cap = sizeof d->constant / sizeof *d->constant;
  d->root_cap = 0;
}

void dyd_expr_clear(dyd_expr *e) {
  for (size_t i = 0; i < e->constants; i++) dyd_constant_clear(&e->constant[i]);
  for (size_t i = 0; i < e->roots; i++) dyd_real_free(e->root[i]);
  e->count = e->constants = e->roots = 0;
}

void dyd_draft_clear(dyd_draft *d) {
  dyd_expr_clear(&d->e);
  if (d->e.node != d->node) free(d->e.node);
  if (d->e.constant != d->constant) free(d->e.constant);
  free(d->e.root);
  dyd_draft_init(d);
}

/* Room for one more than `count` items of `size` bytes in *array, which is `own` until it has to move. */
static bool draft_reserve(void **array, size_t *cap, size_t count, size_t size, void *own) {
  if (count < *cap) return true;
  void *block = *array == own ? NULL : *array;
  size_t block_cap = block ? *cap : 0;
  if (!dyd_reserve(&block, &block_cap, 2 * count, size)) return false;
  if (*array == own) memcpy(block, own, count * size);
  *array = block;
  *cap = block_cap;
  return true;
}

bool dyd_draft_reserve_node(dyd_draft *d) {
  return draft_reserve((void **)&d->e.node, &d->node_cap, d->e.count, sizeof *d->node, d->node);
}

bool dyd_draft_reserve_constant(dyd_draft *d) {
  return draft_reserve((void **)&d->e.constant, &d->constant_cap, d->e.constants, sizeof *d->constant, d->constant);
}

bool dyd_draft_reserve_root(dyd_draft *d) {
  return dyd_reserve((void **)&d->e.root, &d->root_cap, d->e.roots + 1, sizeof *d->e.root);
}

size_t dyd_expr_size(const dyd_expr *e) {
  return e->roots * sizeof *e->root + e->constants * sizeof *e->constant + e->count * sizeof *e->node;
}

void dyd_expr_take(dyd_expr *out, dyd_draft *d) {
  out->count = d->e.count;
  out->constants = d->e.constants;
  out->roots = d->e.roots;
  out->root = (dyd_real **)(void *)(out + 1); /* 8 bytes aligned, as dyd_expr is */
  out->constant = (dyd_constant *)(void *)(out->root + out->roots);
  out->node = (dyd_node *)(void *)(out->constant + out->constants);
  memcpy(out->constant, d->e.constant, out->constants * sizeof *out->constant);
  if (out->roots) memcpy(out->root, d->e.root, out->roots * sizeof *out->root);
  memcpy(out->node, d->e.node, out->count * sizeof *out->node);
  d->e.constants = d->e.roots = 0;
}

const dyd_constant *dyd_expr_rational(const dyd_expr *e) {
  return e->count == 1 && e->node[0].op == DYD_OP_CONST ? &e->constant[e->node[0].argument] : NULL;
}
