/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* All statuses in one number, to tell whether two results are equal. */
#ifndef DYD_ENGINE_DIGEST_H
#define DYD_ENGINE_DIGEST_H

#include <dyadel/delaunay.h>

/* FNV-1a of the pairs with their statuses, as dyd_stage_row has it. O(pairs log pairs). */
dyd_status dyd_digest_pairs(uint64_t *out, const dyd_delaunay *pd);

#endif
