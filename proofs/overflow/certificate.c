/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/certificate.c: the words that are compared are there. */
/* Without dyd_checker_init, dyd_checker_clear, checker_ties, checker_end, dyd_checker_settle, dyd_checker_run,
   dyd_verify_certificate: not tried. */
#define __int128 long long /* of areas nothing is proved here */
#include "checks.h"

#include "base/error.h"

/*@ predicate reported(checking c) = \valid_read(c) && string(c->report.outcome) && string(c->report.goal); */

/*@ requires reported(c) && (c->in.err == \null || \valid(c->in.err)); assigns *c->in.err; exits \false; */
static dyd_status checker_outcome(const dyd_checker *c);
/*@ requires reported(c); assigns \nothing; exits \false; */
static bool outcome_is_proved(const dyd_checker *c, bool stays);

#include "checker/certificate.c"
