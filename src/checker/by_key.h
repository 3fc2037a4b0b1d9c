/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Lists by key. */
#ifndef DYD_CHECKER_BY_KEY_H
#define DYD_CHECKER_BY_KEY_H

#include <stddef.h>
#include <stdint.h>

typedef struct dyd_cert_entry {
  uint32_t key, item;
} dyd_cert_entry;

/* Sorts the items by their keys, which are below `keys`: those of key v are item[start[v] .. start[v+1]), in the order
 * of their entries. start has keys + 1 places, item one for each entry. Counting: O(keys + count). */
void dyd_cert_by_key(size_t *start, uint32_t *item, size_t keys, const dyd_cert_entry *entry, size_t count);

#endif
