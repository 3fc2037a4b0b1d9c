/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Points files like those that users have: crowds beside loneliness, repeats, mixed accuracy. The same on every
 * machine: coordinates are rounded to few decimals. */
#ifndef DYD_BENCH_REAL_H
#define DYD_BENCH_REAL_H

#include <stdio.h>

/* All give an open file of n points, to be closed by the caller, and end the program when that fails. */
/* 3,376 airports, whatever n is: CSV with the columns longitude and latitude. */
FILE *real_airports(size_t n);
/* A Gaussian crowd; 20 of the points are up to 150 times as far out. */
FILE *real_outliers(size_t n);
/* 30 clusters, each of its own density, and 100 points up to a thousand times as far apart. */
FILE *real_clusters(size_t n);
/* Tracks of a receiver: steps of 8 m, places where it stands still and repeats itself, accuracies from 3 to 30 m. */
FILE *real_tracks(size_t n);
/* A coast line: a closed curve with bays in bays, surveyed to 1 % of its steps. */
FILE *real_coast(size_t n);
/* The positions of cloud_gps: CSV with the columns east, north and accuracy. */
FILE *real_gps(size_t n);

#endif
