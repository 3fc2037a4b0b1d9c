/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What a certificate states, read by a reader of its own, and judged by the oracle. */
#ifndef DYD_TESTS_CHECKER_STATEMENT_H
#define DYD_TESTS_CHECKER_STATEMENT_H

#include <setjmp.h>
#include <stdarg.h>

#include "delaunay/harness.h"
#include <dyadel/dyadel.h>

#include <cmocka.h>

/* kind[i][j], i < j: 'L' legal, 'l' legal without a witness, 'o', 't', 'n' illegal by a chain, 0 not listed. */
typedef struct statement {
  orc_case sites; /* aliases as points of their own */
  char kind[ORC_MAX][ORC_MAX];
  char outcome[16], goal[24];
  long goal_bits;
  bool capped;
  unsigned long triangles, unproved;
  bool area_given, hausdorff_given;
  mpq_t area, hausdorff;
} statement;

void statement_init(statement *s);
void statement_clear(statement *s);
/* Fails the test when the text is not a certificate. */
void statement_read(statement *s, const char *text);
/* Returns true if both say the same of the same rectangles. Bounds and the words that claim nothing (see
 * dyd_certificate_gap) apart.
 */
bool statement_same(const statement *a, const statement *b);
/* Returns true if all ties are ties of points. Others follow from what the sites are, not from their rectangles. */
bool statement_ties_are_exact(const statement *s);
/* Checks the statements against the oracle. Returns NULL, or a description of the first false one. */
const char *statement_judge(orc_pool *p, const statement *s);
/* The same by the engine, which is quick and shares nothing with the checker but numbers: a pair called legal is not
 * illegal (the engine may miss a witness), and a pair called illegal is illegal. */
const char *statement_judge_by_engine(const statement *s);
/* Returns true if the bounds are not below those of the listed pairs. */
bool statement_bounds_hold(const statement *s);

/* Reads m or m*2^e; returns what follows. */
const char *statement_number(mpq_ptr out, const char *text);

/* The engine of the case, run with these options (may be NULL). */
dyd_engine *engine_of_case(const orc_case *c, const dyd_engine_options *o);
/* The certificate of the case, run with these options (may be NULL); release with free(). */
char *certificate_of_case(const orc_case *c, const dyd_engine_options *o);
char *certificate_of_engine(const dyd_engine *e);
/* DYD_OK or the error; report may be NULL. */
dyd_status certificate_check(dyd_certificate_report *report, const char *text, size_t length, dyd_error *err);

#endif
