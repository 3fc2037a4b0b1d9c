/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Cases as text: one rectangle per line, a number or [lower,upper] for each axis; numbers as dyd_dyadic_set_str. */
#ifndef DYD_TESTS_DELAUNAY_READ_CASE_H
#define DYD_TESTS_DELAUNAY_READ_CASE_H

#include "delaunay/harness.h"

/* out becomes the case; fails the test when the text is not one. */
void read_case(orc_case *out, const char *name, const char *text);
/* Engine (default, exact rung) against the oracle; every query, witness and triangle. Fails the test. */
void expect_right(harness *h, const orc_case *c);
/* The engine's status of a pair, by the exact rung or not. */
int engine_status(const orc_case *c, uint32_t i, uint32_t j, bool no_filter);

#endif
