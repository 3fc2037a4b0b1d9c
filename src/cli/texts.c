/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The prose of help and manual page. Plain text; the manual page escapes what troff would take for its own. */
#include "table.h"

const char cli_summary[] =
    "Delaunay triangulation and Voronoi diagram of points that are exact, imprecise or computable\n"
    "reals. What is stated holds for every choice of points in the rectangles.";

const char cli_file_text[] = "FILE has one point per line: two coordinates separated by blanks or one comma.\n"
                             "\"#\" starts a comment; \"-\" is standard input. Points are numbered from 0.";

const cli_term cli_coordinate_forms[] = {
    {"-3.25 1e-3 22/7", "decimal, integer, rational: exact"},
    {"0x1.8p-3 5*2^-20", "hexadecimal float, dyadic: exact"},
    {"[1.2,1.3]", "interval: fixed, never refined"},
    {"1.25+-0.01", "value with radius: the interval"},
    {"sqrt(2)+pi/4", "expression: a computable real, refined on demand. Known are + - * / ^, pi e, sqrt cbrt exp log "
                     "sin cos tan asin acos atan sinh cosh tanh abs min max; blanks are allowed inside parentheses"},
    {"root(x^5-x-1, 1, 2)", "the root of the polynomial between 1 and 2; it may stand in expressions"},
    {NULL, NULL}};

const cli_term cli_exit_statuses[] = {
    {"0", "decided (no pair is open), or certified (the bound asked for holds)"},
    {"1", "bad input, a failed point, or a failure to read or write; what was known before a point failed is written"},
    {"2", "bad usage"},
    {"3", "fixpoint: what is open cannot be decided by refinement (ties, fixed rectangles)"},
    {"4", "budget: bits, pairs or time are used up"},
    {"5", "cancelled (Ctrl-C: the first one stops the work and writes what is known)"},
    {NULL, NULL}};

const cli_term cli_examples[] = {
    {"dyadel delaunay points.txt", "edges as csv"},
    {"dyadel delaunay --columns longitude,latitude --measured --format svg -o map.svg airports.csv",
     "a picture of columns of measured decimals"},
    {"dyadel delaunay --columns x,y --radius-column accuracy --id name --skip-missing -o edges.csv survey.csv.gz",
     "points with their own accuracies; the result names them"},
    {"dyadel delaunay --until hausdorff:40 points.txt", "refine until edges are known to 2^-40"},
    {"dyadel delaunay --certificate c.txt points.txt && dyadel verify c.txt", "edges, and a check of what proves them"},
    {"dyadel converge --schedule uniform --step-bits 8 --plot run.svg points.txt",
     "how bounds and statuses develop with the precision"},
    {NULL, NULL}};
