/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Roots as values: made, copied, freed. */
#include "stream/root.h"

#include "base/alloc.h"

void dyd_root_free(dyd_root *r) {
  if (!r) return;
  for (size_t k = 0; k < r->count; k++) mpz_clear(r->coeff[k]);
  free(r->coeff);
  mpz_clear(r->slot);
  mpq_clears(r->lo, r->hi, NULL);
  free(r);
}

dyd_root *dyd_root_alloc(size_t count) {
  dyd_root *r = dyd_alloc(1, sizeof *r);
  if (!r) return NULL;
  *r = (dyd_root){.jump = 2};
  mpq_inits(r->lo, r->hi, NULL);
  mpz_init(r->slot);
  r->coeff = dyd_alloc(count, sizeof *r->coeff);
  if (!r->coeff) return dyd_root_free(r), NULL;
  for (; r->count < count; r->count++) mpz_init(r->coeff[r->count]);
  return r;
}

dyd_status dyd_root_copy(dyd_root **out, const dyd_root *r) {
  dyd_root *c = dyd_root_alloc(r->count);
  if (!c) return DYD_E_NOMEM;
  for (size_t k = 0; k < r->count; k++) mpz_set(c->coeff[k], r->coeff[k]);
  mpq_set(c->lo, r->lo);
  mpq_set(c->hi, r->hi);
  mpz_set(c->slot, r->slot);
  c->on_grid = r->on_grid;
  c->exact = r->exact;
  c->isolated = r->isolated;
  c->sign_left = r->sign_left;
  c->s = r->s;
  c->jump = r->jump;
  *out = c;
  return DYD_OK;
}
