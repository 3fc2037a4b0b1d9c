/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What a trace says was proved about points. */
#ifndef DYD_IO_TRACE_PROOFS_H
#define DYD_IO_TRACE_PROOFS_H

#include <dyadel/delaunay.h>
#include <jansson.h>

typedef struct dyd_trace_proof {
  dyd_relation relation;
  size_t count;
  uint32_t *site;
} dyd_trace_proof;

/* Init with {0}. Sites are below `points`; joined: so many of them have been looked at for points that are the same. */
typedef struct dyd_trace_proofs {
  dyd_trace_proof *item;
  size_t count, cap, joined;
} dyd_trace_proofs;

void dyd_trace_proofs_clear(dyd_trace_proofs *p);
/* Reads the line {"proved":RELATION,"points":[...]}. DYD_E_PARSE: it is none; DYD_E_NOMEM. */
dyd_status dyd_trace_proofs_read(dyd_trace_proofs *p, const json_t *line, size_t points);
/* A dyd_prove_fn; user is a dyd_trace_proofs. */
dyd_status dyd_trace_prove(bool *proved, void *user, dyd_relation relation, const uint32_t *site, size_t count,
                           dyd_error *err);
/* Joins sites that are the same since the last call; *any: some are. */
dyd_status dyd_trace_join(bool *any, dyd_trace_proofs *p, dyd_sites *sites);

#endif
