/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Runs the engine on cases, compares every query with the oracle, and cuts failing cases down to a minimum. */
#ifndef DYD_TESTS_DELAUNAY_HARNESS_H
#define DYD_TESTS_DELAUNAY_HARNESS_H

#include "oracle/oracle.h"
#include "oracle/oracle_gen.h"
#include <dyadel/delaunay.h>

#define MESSAGE_SIZE 400

/* What the cases share. */
typedef struct harness {
  orc_pool pool;
  test_random random;
  size_t cases, pairs, legal, undecided; /* how much was compared */
  size_t carried;                        /* legal statuses carried over where a fresh run says indeterminate */
  size_t missed;                         /* the same with room, in cases whose ends span more than 2^WIDE_SPAN */
  size_t hairlines;                      /* legal pairs called indeterminate, with room below the engine's floor */
} harness;

void harness_init(harness *h, const char *name);
/* Prints the counts and clears. */
void harness_clear(harness *h);

/* Returns true if the case is fine; otherwise sets message to the error. */
typedef bool (*case_check)(char *message, harness *h, const orc_case *c);
/* Runs the check; on failure drops rectangles while it still fails, prints the case and fails the test. The
 * check must be deterministic: the generator's state is the same at every call. */
void harness_run(harness *h, const orc_case *c, case_check check);
/* Run the check on random cases of at most `most` rectangles: `cases` of every kind, or `cases` in all. */
void harness_run_kinds(harness *h, size_t most, size_t cases, case_check check);
void harness_run_cases(harness *h, size_t most, size_t cases, case_check check);

/* false, with the formatted message. */
bool wrong(char *message, const char *format, ...);

void harness_rect(dyd_rect *out, const orc_rect *r);
dyd_sites *harness_sites(const orc_case *c);
/* dyd_delaunay_new, NULL with a message when it does not return DYD_OK. */
dyd_delaunay *harness_engine(char *message, const dyd_sites *s, const dyd_delaunay_options *options);

/* The floor documented in legal/witness.h is about 2^-30 of the distances concerned; some slack for "about". */
#define FLOOR_BITS 24
/* The search gives up after a number of exact steps, too: seen only where the ends of a case span this many bits. */
#define WIDE_SPAN 200

/* Returns true if the engine may miss that the pair is legal. Counts it as a hairline (less room for witnesses than the
 * floor asks for) or as missed (a very wide span). */
bool is_hairline(harness *h, const orc_case *c, uint32_t i, uint32_t j);
/* All statuses of the engine against the oracle's. A legal pair may be called indeterminate only if its
 * witnesses have no room above the floor and not all sites are points. */
bool same_as_oracle(char *message, harness *h, const orc_case *c, const orc_table *t, const dyd_delaunay *pd);
/* All statuses of two engines; hairlines may differ. */
bool same_statuses(char *message, harness *h, const orc_case *c, const dyd_delaunay *a, const dyd_delaunay *b);
/* Two statuses of one pair of the case: equal, or one is legal, one indeterminate and the pair a hairline. */
bool same_status(harness *h, const orc_case *c, uint32_t i, uint32_t j, int s, int t);
/* Statuses of all pairs, to be compared with later ones. */
typedef unsigned char snapshot[ORC_MAX][ORC_MAX];
void snapshot_take(snapshot out, const dyd_delaunay *pd, size_t n);
/* Returns whether every definite status still holds. Two sites that have become one point are not a pair any more. */
bool snapshot_kept(char *message, snapshot was, const orc_case *now, const dyd_delaunay *pd);
/* Pairs, neighbours, counts, faces, aliases, hull against dyd_delaunay_status. */
bool queries_agree(char *message, const orc_case *c, const dyd_delaunay *pd);
/* The sure triangles against the definition. */
bool triangles_right(char *message, orc_pool *p, const orc_case *c, const dyd_delaunay *pd);
/* Every legal pair has a witness that holds in the oracle's arithmetic. */
bool witnesses_hold(char *message, orc_pool *p, const orc_case *c, const dyd_delaunay *pd);

#endif
