/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Certificates checked while memory fails: the checker returns the same verdict as with enough memory, or reports
 * exhausted memory. */
#ifndef DYD_TESTS_CHECKER_EXHAUST_H
#define DYD_TESTS_CHECKER_EXHAUST_H

#include "support/failing_memory.h"
#include "support/random.h"

#include <dyadel/certificate.h>
#include <stdio.h>
#include <string.h>

/* Checks the certificate with its k-th allocation failing (0: none). Returns a status and sets `verdict` to the whole
 * report; when memory is exhausted, to that alone. *over: the check makes fewer than k allocations. */
static dyd_status verdict_of(char *verdict, size_t size, bool *over, const char *text, size_t length, size_t k) {
  dyd_certificate_report r = {DYD_SIZED(dyd_certificate_report)};
  dyd_error err;
  FILE *in = length ? fmemopen((char *)(uintptr_t)text, length, "r") : fopen("/dev/null", "r");
  setvbuf(in, NULL, _IONBF, 0); /* what the stream asks for does not count */
  dyd_error_clear(&err);
  countdown = k;
  dyd_status status = dyd_verify_certificate(&r, in, NULL, &err);
  *over = countdown > 0;
  countdown = 0;
  fclose(in);
  snprintf(verdict, size, "%d, line %zu: %s; gaps %u, unproved %llu, boxes %llu, triangles %zu, facts %zu and %zu",
           status, status == DYD_E_NOMEM ? 0 : err.line, status == DYD_OK ? "" : err.message, r.gaps,
           (unsigned long long)r.unproved, (unsigned long long)r.illegal_boxes, r.triangles, r.identities,
           r.tie_bounds);
  return status;
}

/* Every allocation fails once, of many of them later ones less densely, and others for each certificate. Returns false
 * if another verdict comes out, with a `message`. *faults counts them. */
static bool every_allocation_fails_well(char *message, size_t size, size_t *faults, const char *text, size_t length) {
  char with[600], without[600], exhausted[600];
  bool over;
  snprintf(exhausted, sizeof exhausted, "%d, line 0: %s; gaps 0, unproved 0, boxes 0, triangles 0, facts 0 and 0",
           DYD_E_NOMEM, dyd_status_text(DYD_E_NOMEM));
  verdict_of(with, sizeof with, &over, text, length, 0);
  size_t dense = test_stride() == 1 ? 32 : 8, phase = *faults % dense;
  for (size_t k = 1;; k += 1 + (k + phase) / dense) {
    dyd_status status = verdict_of(without, sizeof without, &over, text, length, k);
    if (over) return true;
    ++*faults;
    if (strcmp(without, status == DYD_E_NOMEM ? exhausted : with) == 0) continue;
    snprintf(message, size, "allocation %zu fails: %s, not %s", k, without, with);
    return false;
  }
}

#endif
