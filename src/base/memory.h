/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Memory budget of a run: large allocations are estimated and checked before they are made.
 *
 * An estimate counts the bytes of the coming arrays when they are full; arrays that stay are `held`. So a run is
 * refused while there still is memory, which GMP, MPFR and FLINT, which end the process without it, cannot do. */
#ifndef DYD_BASE_MEMORY_H
#define DYD_BASE_MEMORY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* All in bytes. Invariant: refused is NULL, or static and says for what `wanted`, more than `most`, was asked. */
typedef struct dyd_memory {
  uint64_t most;         /* 0: no bound, and nothing is counted */
  uint64_t beside, held; /* by others, during the whole run; by the present step */
  uint64_t peak;         /* the largest granted sum of held and estimated bytes */
  uint64_t wanted;
  const char *refused;
} dyd_memory;

static inline uint64_t dyd_bytes_add(uint64_t a, uint64_t b) {
  return a > UINT64_MAX - b ? UINT64_MAX : a + b;
}
static inline uint64_t dyd_bytes_times(uint64_t count, uint64_t size) {
  return size && count > UINT64_MAX / size ? UINT64_MAX : count * size;
}

/* Returns true if `more` bytes fit next to those held. `what`, a static string, names their use. */
static inline bool dyd_memory_has(dyd_memory *r, uint64_t more, const char *what) {
  uint64_t all = dyd_bytes_add(dyd_bytes_add(r->beside, r->held), more);
  if (!r->most) return true;
  if (all > r->most) {
    r->wanted = all;
    r->refused = what;
    return false;
  }
  if (all > r->peak) r->peak = all;
  return true;
}

/* Returns the bytes left; 0 without a bound. */
static inline uint64_t dyd_memory_left(const dyd_memory *r) {
  uint64_t taken = dyd_bytes_add(r->beside, r->held);
  return !r->most ? 0 : r->most > taken ? r->most - taken : 1;
}

/* Cuts the budget to the share of one of `parts` parallel tasks (0 counts as 1). */
static inline void dyd_memory_share(dyd_memory *r, unsigned parts) {
  uint64_t taken = dyd_bytes_add(r->beside, r->held);
  if (parts > 1 && r->most > taken) r->most = taken + (r->most - taken) / parts;
}
/* Takes over what another room, of the same run, has seen. */
static inline void dyd_memory_join(dyd_memory *r, const dyd_memory *other) {
  if (other->peak > r->peak) r->peak = other->peak;
  if (!other->refused) return;
  r->wanted = other->wanted;
  r->refused = other->refused;
}

#endif
