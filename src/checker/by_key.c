/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Lists by key. */
#include "checker/by_key.h"

#include <string.h>

void dyd_cert_by_key(size_t *start, uint32_t *item, size_t keys, const dyd_cert_entry *entry, size_t count) {
  memset(start, 0, (keys + 1) * sizeof *start);
  for (size_t k = 0; k < count; k++) start[entry[k].key]++;
  for (size_t v = 0; v < keys; v++) start[v + 1] += start[v]; /* ends, which filling makes beginnings */
  for (size_t k = count; k-- > 0;) {
    size_t at = --start[entry[k].key];
    item[at] = entry[k].item;
  }
}
