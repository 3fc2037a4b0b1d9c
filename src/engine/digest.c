/* SPDX-License-Identifier: LGPL-3.0-or-later */
#include "engine/digest.h"
#include "delaunay/memory.h"

static uint64_t digest_word(uint64_t digest, uint32_t word) {
  for (int k = 0; k < 4; k++) digest = (digest ^ (word >> 8 * k & 255)) * 1099511628211u;
  return digest;
}

dyd_status dyd_digest_pairs(uint64_t *out, const dyd_delaunay *pd) {
  dyd_pair_list pairs = {0};
  dyd_status st = dyd_pairs_list(&pairs, pd, DYD_TIE);
  if (st != DYD_OK) return st;
  *out = 14695981039346656037u;
  for (size_t k = 0; k < pairs.count; k++) {
    *out = digest_word(*out, pairs.item[k].i);
    *out = digest_word(*out, pairs.item[k].j);
    *out = digest_word(*out, (uint32_t)pairs.item[k].status);
  }
  dyd_pair_list_clear(&pairs);
  return DYD_OK;
}
