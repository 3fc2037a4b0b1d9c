/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What the harness found: csv, json. */
#include "io/output.h"
#include <inttypes.h>

static dyd_status check_report(const dyd_output *o, const char *form) {
  const dyd_check_report *r = o->what;
  fprintf(o->out, form, dyd_check_fault_text(r->fault), r->schedules, r->stages, r->pairs, r->cells, r->floors, r->seed,
          r->moves);
  return DYD_OK;
}

dyd_status dyd_check_csv(const dyd_output *o) {
  return check_report(o, "fault,schedules,stages,pairs,cells,floors,seed,moves\n%s,%" PRIu64 ",%" PRIu64 ",%" PRIu64
                         ",%" PRIu64 ",%" PRIu64 ",%" PRIu64 ",%zu\n");
}

dyd_status dyd_check_json(const dyd_output *o) {
  return check_report(o, "{\"fault\": \"%s\", \"schedules\": %" PRIu64 ", \"stages\": %" PRIu64 ", \"pairs\": %" PRIu64
                         ", \"cells\": %" PRIu64 ", \"floors\": %" PRIu64 ", \"seed\": %" PRIu64 ", \"moves\": %zu}\n");
}
