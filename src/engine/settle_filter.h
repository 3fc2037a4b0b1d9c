/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Where to put the points of fixed rectangles, so that a pair becomes legal, or illegal. Guesses: nothing that is
 * stated depends on them. */
#ifndef DYD_ENGINE_SETTLE_FILTER_H
#define DYD_ENGINE_SETTLE_FILTER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A site: its outward box (x lower, x upper, y lower, y upper), whether its point may be chosen, and the choice. */
typedef struct dyd_settle_site {
  double box[4];
  bool fixed;
  double at[2];
} dyd_settle_site;

/* The middles. */
void dyd_filter_choose_middles(dyd_settle_site *site, size_t count);
/* Anywhere. */
void dyd_filter_choose_any(dyd_settle_site *site, size_t count, uint64_t *random);
/* For sites i and j to be a legal pair: towards a centre, the others away from it, the centre being the one for which
 * that leaves most room. false, and no choice: none with any room was found. thorough: looks about ten times as long.
 */
bool dyd_filter_choose_joined(dyd_settle_site *site, size_t count, size_t i, size_t j, bool thorough);
/* Do the pairs ij and kl cross, taken as points in the middles? */
bool dyd_filter_middles_cross(const dyd_settle_site *site, size_t i, size_t j, size_t k, size_t l);
/* For them to be no pair: apart, and the others between them. */
void dyd_filter_choose_parted(dyd_settle_site *site, size_t count, size_t i, size_t j);

#endif
