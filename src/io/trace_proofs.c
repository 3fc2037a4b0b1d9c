/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Proofs of a trace stand for the expressions that are not in it. */
#include "io/trace_proofs.h"

#include "base/alloc.h"
#include "io/trace.h"

#include <string.h>

void dyd_trace_proofs_clear(dyd_trace_proofs *p) {
  for (size_t k = 0; k < p->count; k++) free(p->item[k].site);
  free(p->item);
  *p = (dyd_trace_proofs){0};
}

static bool proof_relation(dyd_relation *out, const char *name) {
  for (int k = DYD_COINCIDENT; name && k <= DYD_COCIRCULAR; k++)
    if (strcmp(name, dyd_trace_relations[k]) == 0) {
      *out = (dyd_relation)k;
      return true;
    }
  return false;
}

dyd_status dyd_trace_proofs_read(dyd_trace_proofs *p, const json_t *line, size_t points) {
  const json_t *list = json_object_get(line, "points");
  dyd_trace_proof proof = {.count = json_array_size(list)};
  if (proof.count < 2 || !proof_relation(&proof.relation, json_string_value(json_object_get(line, "proved"))))
    return DYD_E_PARSE;
  if (!dyd_reserve((void **)&p->item, &p->cap, p->count + 1, sizeof *p->item)) return DYD_E_NOMEM;
  proof.site = dyd_alloc(proof.count, sizeof *proof.site);
  if (!proof.site) return DYD_E_NOMEM;
  for (size_t k = 0; k < proof.count; k++) {
    const json_t *number = json_array_get(list, k);
    json_int_t site = json_is_integer(number) ? json_integer_value(number) : -1;
    if (site < 0 || (uint64_t)site >= points) return free(proof.site), DYD_E_PARSE;
    proof.site[k] = (uint32_t)site;
  }
  p->item[p->count++] = proof;
  return DYD_OK;
}

dyd_status dyd_trace_prove(bool *proved, void *user, dyd_relation relation, const uint32_t *site, size_t count,
                           dyd_error *err) {
  const dyd_trace_proofs *p = user;
  (void)err;
  *proved = false;
  for (size_t k = 0; k < p->count && !*proved; k++)
    *proved = p->item[k].relation == relation && p->item[k].count == count &&
              memcmp(p->item[k].site, site, count * sizeof *site) == 0;
  return DYD_OK;
}

dyd_status dyd_trace_join(bool *any, dyd_trace_proofs *p, dyd_sites *sites) {
  dyd_status st = DYD_OK;
  *any = false;
  for (; p->joined < p->count && st == DYD_OK; p->joined++) {
    const dyd_trace_proof *proof = &p->item[p->joined];
    if (proof->relation != DYD_COINCIDENT) continue;
    st = dyd_sites_join(sites, proof->site[0], proof->site[1]);
    *any = true;
  }
  return st;
}
