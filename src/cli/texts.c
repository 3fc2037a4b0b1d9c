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
    {"3", "fixpoint: nothing that is open can be refined (ties, fixed rectangles)"},
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

const cli_term cli_results[] = {
    {"csv, wkt, geojson",
     "one layer each (see --layer), with plain columns and one kind of geometry. A point stands for its rectangle; "
     "max_coordinate_error bounds, rounded up, how far in x or y any point of the rectangle is from it: 0 for "
     "coordinates "
     "printed exactly. Without --crs geojson claims no reference system; programs that see none would take the "
     "coordinates "
     "for degrees. csv of delaunay: \"# alias 7 3\" for each point 7 that is the same as point 3, then i,j,status, "
     "sorted; where the cap on pairs was met, \"# capped\" and \"# face i j k ...\" name the faces within which "
     "further "
     "pairs may be possible. csv of voronoi: two bounds in comments, the area that is undetermined, and how far an "
     "undetermined point can be from the true diagram."},
    {"json",
     "delaunay: the rectangles reached (exact, and as decimals rounded outward), aliases, pairs, sure triangles, "
     "outcome, bounds of area and Hausdorff distance (exact, and rounded up), counters. voronoi: besides these "
     "the exact boundaries, arc by arc (line or parabola, focus, feature, ends as (a + b sqrt(c)) / d), the "
     "polygons, edges with their vertices, rays with bounds of their directions. Exact numbers are texts m*2^e "
     "or p/q."},
    {"obj", "vertices \"v x y 0\", legal edges l, sure triangles f; how far vertices are off is in a comment."},
    {"svg, pdf, png",
     "Lines that would be one mass are shown by their density; a crowd too small to see is told of with "
     "the --window that shows it. In svg text is text, and what is drawn has an id (pair-3-7) and a "
     "title. The picture of nearest shows the disc that is surely free of points, the ring that surely "
     "holds the nearest one, and who reaches into it."},
    {"polygons of voronoi", "For every point an inner polygon, all of whose points are surely nearest to it, and outer "
                            "polygons that hold all points possibly nearest; vertices are dyadic, so that anybody can "
                            "check them by comparing distances in integers. The cell of an exact point among exact "
                            "points is one polygon (kind exact), whose vertices are rounded by at most vertex_error. "
                            "All lie in the window."},
    {"converge", "One line for each stage: bits asked for (least, most, total), largest and median width, pairs by "
                 "status, undecided faces, bounds of the triangulation and of the diagram on the window, decisions per "
                 "rung, calls, a digest of all statuses, seconds. Widths and bounds are rounded up."},
    {"--trace FILE", "one JSON object per line; the format is in dyadel/io.h, that of certificates in "
                     "dyadel/certificate.h"},
    {NULL, NULL}};

const char cli_oracle_text[] =
    "With --oracle, a program (sh -c COMMAND) takes the place of FILE. It prints \"points N\"; then for each line "
    "\"refine I B\" that it reads, it answers one line \"I XLO XHI YLO YHI\": exact numbers (any plain form of the "
    "points "
    "file) between which point I lies, aiming at widths of 2^-B, inside its former answers for I. It may add the word "
    "\"fixed\" when that can never be narrowed. Where points cost differently, it begins with \"points N cost C ... "
    "C\", one "
    "number above 0 for each, and cheap ones are asked before dear ones. It flushes after every line, answers in the "
    "order of the requests, and "
    "ends when its input ends. Of K programs, number I modulo K is always asked for point I. Results do not depend on "
    "--oracle-jobs and --oracle-batch. A program that dies, is silent, or answers what is not an answer ends the run "
    "with exit status 1 and a message that names the point and the request; what was known before is written all the "
    "same. No process is left behind, even when dyadel itself is killed. Begin COMMAND with exec when it is a single "
    "program, so that no shell stands between.";
