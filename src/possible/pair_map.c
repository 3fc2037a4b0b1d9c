/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Open addressing with multiplicative hashing, and adjacency as linked lists in one array. */
#include "possible/pair_map.h"

#include "base/alloc.h"

#include <string.h>

static uint64_t pair_key(uint32_t a, uint32_t b) {
  return a < b ? ((uint64_t)a << 32 | b) + 1 : ((uint64_t)b << 32 | a) + 1;
}

static size_t pair_place(const dyd_pair_map *m, uint64_t key) {
  uint64_t mixed = (key ^ key >> 32) * UINT64_C(0x9E3779B97F4A7C15);
  size_t q = (size_t)(mixed >> 24 ^ mixed >> 44) & m->mask;
  while (m->key[q] && m->key[q] != key) q = (q + 1) & m->mask;
  return q;
}

static dyd_status resize(dyd_pair_map *m, size_t size) {
  uint64_t *key = calloc(size, sizeof *key);
  uint8_t *state = calloc(size, sizeof *state);
  if (!key || !state) {
    dyd_free_all(key, state);
    return DYD_E_NOMEM;
  }
  dyd_pair_map old = *m;
  m->key = key;
  m->state = state;
  m->mask = size - 1;
  for (size_t q = 0; old.key && q <= old.mask; q++)
    if (old.key[q]) {
      size_t p = pair_place(m, old.key[q]);
      m->key[p] = old.key[q];
      m->state[p] = old.state[q];
    }
  dyd_free_all(old.key, old.state);
  return DYD_OK;
}

dyd_status dyd_pair_map_init(dyd_pair_map *m, uint32_t members) {
  *m = (dyd_pair_map){.members = members};
  if (!DYD_NEW(m->head, members)) return DYD_E_NOMEM;
  memset(m->head, 0xff, members * sizeof *m->head);
  return resize(m, 64);
}

void dyd_pair_map_clear(dyd_pair_map *m) {
  dyd_free_all(m->key, m->state, m->head, m->link);
  memset(m, 0, sizeof *m);
}

dyd_pair_state dyd_pair_map_get(const dyd_pair_map *m, uint32_t a, uint32_t b) {
  return (dyd_pair_state)m->state[pair_place(m, pair_key(a, b))];
}

static void join(dyd_pair_map *m, uint32_t from, uint32_t to) {
  m->link[m->links] = (dyd_pair_link){to, m->head[from]};
  m->head[from] = (uint32_t)m->links++;
}

static bool table_is_full(const dyd_pair_map *m) {
  return 2 * (m->used + 1) > m->mask + 1;
}

bool dyd_pair_map_is_full(const dyd_pair_map *m) {
  return table_is_full(m) || m->links + 2 > m->link_cap;
}

uint64_t dyd_pair_map_bytes(const dyd_pair_map *m) {
  uint64_t tables = table_is_full(m) ? 3 : 1,
           links = m->links + 2 > m->link_cap ? m->link_cap / 2 * 3 + 16 : m->link_cap;
  return tables * (m->mask + 1) * (sizeof *m->key + sizeof *m->state) + links * sizeof *m->link +
         m->members * sizeof *m->head;
}

dyd_status dyd_pair_map_add(dyd_pair_map *m, uint32_t a, uint32_t b, dyd_pair_state state) {
  if (table_is_full(m)) {
    dyd_status st = resize(m, 2 * (m->mask + 1));
    if (st != DYD_OK) return st;
  }
  if (dyd_pair_is_possible(state) && !DYD_GROW(m->link, m->link_cap, m->links + 2)) return DYD_E_NOMEM;
  uint64_t key = pair_key(a, b);
  size_t q = pair_place(m, key);
  if (!m->key[q]) m->used++;
  m->key[q] = key;
  m->state[q] = (uint8_t)state;
  if (dyd_pair_is_possible(state)) {
    join(m, a, b);
    join(m, b, a);
  }
  return DYD_OK;
}
