/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Pairs of small numbers with a state, and the partners of each number: the working memory of a closure. */
#ifndef DYD_POSSIBLE_PAIR_MAP_H
#define DYD_POSSIBLE_PAIR_MAP_H

#include <dyadel/status.h>
#include <stdbool.h>

typedef enum dyd_pair_state {
  DYD_PAIR_UNKNOWN = 0,
  DYD_PAIR_IMPOSSIBLE,
  DYD_PAIR_OPEN, /* possible, not certain */
  DYD_PAIR_CERTAIN
} dyd_pair_state;

/* A half of a possible pair in the list of its first member. */
typedef struct dyd_pair_link {
  uint32_t to, next;
} dyd_pair_link;

/* Invariant: key[] is an open-addressing table of (a << 32 | b) + 1 with a < b, 0 = empty, at most half full; link 2p
 * and 2p+1 belong to the p-th possible pair, in order of addition; head[v] = DYD_NONE ends a list. */
typedef struct dyd_pair_map {
  uint64_t *key;
  uint8_t *state;
  size_t mask, used;
  uint32_t *head;
  uint32_t members;
  dyd_pair_link *link;
  size_t links, link_cap;
} dyd_pair_map;

dyd_status dyd_pair_map_init(dyd_pair_map *m, uint32_t members);
void dyd_pair_map_clear(dyd_pair_map *m);
dyd_pair_state dyd_pair_map_get(const dyd_pair_map *m, uint32_t a, uint32_t b);
/* Sets the state of a pair that has none yet; possible pairs are linked. */
dyd_status dyd_pair_map_add(dyd_pair_map *m, uint32_t a, uint32_t b, dyd_pair_state state);
/* Returns true if one more pair does not fit; dyd_pair_map_bytes then returns the peak while it grows, with both
 * tables. */
bool dyd_pair_map_is_full(const dyd_pair_map *m);
uint64_t dyd_pair_map_bytes(const dyd_pair_map *m);
static inline bool dyd_pair_is_possible(dyd_pair_state s) {
  return s >= DYD_PAIR_OPEN;
}

#endif
