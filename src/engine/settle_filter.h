/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Where to put points in cores, so that a pair becomes an edge, or cannot be legal. Guesses: nothing
 * that is stated depends on them. */
#ifndef DYD_ENGINE_SETTLE_FILTER_H
#define DYD_ENGINE_SETTLE_FILTER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A site: its outward box (x lower, x upper, y lower, y upper), and along which sides its point may be chosen. absent:
 * a disc may hold all of it. disc: centre and radius of one in which the point may be chosen; radius 0: the box counts.
 */
typedef struct dyd_settle_site {
  double box[4];
  bool core[2], absent;
  double disc[3];
} dyd_settle_site;

/* Sets z to the point of the disc that is nearest to `at`, or one that is farthest, off by less than 2^-19 radii; it is
 * in the disc for certain, if the centre is at most 2^20 radii from 0. */
void dyd_filter_disc_point(double z[2], const double disc[3], const double at[2], bool farthest);

/* Returns true if (x, y) is for certain within r of the centre of the disc, r at most a few of its radii. */
bool dyd_filter_within(const double disc[3], double x, double y, double r);

/* The centre of a disc that holds points of sites i and j, and of each other site not all, by choices along cores
 * sides, wherever points are along the others; of such centres one with much room. false: none with any room was
 * found. thorough: looks about ten times as long. */
bool dyd_filter_find_centre(double c[2], const dyd_settle_site *site, size_t count, size_t i, size_t j, bool thorough);

/* Moves the centre c of a disc for two sites that is farther from `other` to where the point of `beside` is as far, or
 * farther by about `more` of the disc, which is within the old one, or hardly larger. */
void dyd_filter_lean(double c[2], const dyd_settle_site *site, size_t beside, size_t other, double more);

/* Four points at[k] of site[k]. inside: number 3 is among the three others, all of them of the two ends; else 0 and 1
 * are of ends, and 2 and 3 of others: the segments 01 and 23 cross, and the circle through 0, 1, 2 goes around 3. Sites
 * have their middles there along sides without a core. */
typedef struct dyd_settle_cut {
  size_t site[4];
  double at[4][2];
  bool inside;
} dyd_settle_cut;

/* Such points for the ends i and j; false: none were found. */
bool dyd_filter_find_cut(dyd_settle_cut *out, const dyd_settle_site *site, size_t count, size_t i, size_t j);

#endif
