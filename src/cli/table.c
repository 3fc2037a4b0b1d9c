/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The table of commands and options.
 *
 * A new command: its row in cli_commands, and its cli_work, declared in cli.h.
 * A new option: its row in cli_option_table and its field in cli_options. The rest follows: parsing, messages, help,
 * manual page, completion. */
#include "cli.h"
#include <string.h>

#define BIT(number) (1u << (number))
#define AT(field) .offset = offsetof(cli_options, field), .width = sizeof(((cli_options *)0)->field)
#define RANGE(low, high) .least = (low), .most = (high)
#define WORDS(text) .words = (text)
#define GIVEN(field) .given = offsetof(cli_options, field)
#define SILENT .silent = true

enum {
  READ = CLI_ALL & ~BIT(CLI_VERIFY),                                               /* reads points */
  RUN = BIT(CLI_DELAUNAY) | BIT(CLI_VORONOI) | BIT(CLI_CONVERGE) | BIT(CLI_CHECK), /* runs the engine to a goal */
  TEXT = READ | BIT(CLI_VERIFY),                                                   /* from a file */
  PIECES = BIT(CLI_DISC) | BIT(CLI_BISECTOR),
  REFINE = RUN | PIECES | BIT(CLI_NEAREST) | BIT(CLI_TOLERANCE),                   /* asks points to narrow */
  DRAW = (RUN & ~BIT(CLI_CHECK)) | PIECES | BIT(CLI_NEAREST) | BIT(CLI_TOLERANCE), /* writes pictures */
  GLOBE = BIT(CLI_DELAUNAY) | BIT(CLI_VORONOI) | BIT(CLI_CONVERGE) | BIT(CLI_NEAREST) | BIT(CLI_PLAN) |
          BIT(CLI_VERIFY) /* takes --sphere */
};

const cli_command cli_commands[CLI_COMMANDS] = {
    [CLI_DELAUNAY] = {"delaunay", "FILE", "edges of the Delaunay triangulation: certain, possible, tied",
                      "Delaunay triangulation of the points. A pair is legal (an edge wherever in their\n"
                      "rectangles the points lie; if two rectangles meet, the points may also coincide),\n"
                      "indeterminate (an edge for some choices), a tie (as indeterminate, but no refinement\n"
                      "can decide it), or not listed (never an edge).",
                      DYD_CONTENT_DELAUNAY, &cli_delaunay},
    [CLI_VORONOI] = {"voronoi", "FILE", "the cells of the points on a window, with certified bounds",
                     "Voronoi diagram of the points on a window: for each point the part of the window that\n"
                     "certainly belongs to its cell and the part that possibly does, the certain vertices with\n"
                     "enclosures, and bounds of the undecided area. The goals area:M and hausdorff:M of\n"
                     "--until are those of the diagram.",
                     DYD_CONTENT_VORONOI, &cli_voronoi},
    [CLI_CONVERGE] = {"converge", "FILE", "a run stage by stage, as a table",
                      "The run of delaunay, with one line for each stage: precision asked for, widths,\n"
                      "statuses, bounds of the undecided area, decisions, calls of points, seconds. The first\n"
                      "stage asks for 4 bits (--start-bits). With --of disc or bisector: of the partial disc\n"
                      "of the first three points, of the partial bisector of the first two.",
                      DYD_CONTENT_CONVERGENCE, &cli_converge},
    [CLI_CHECK] = {"check", "FILE", "try random refinement schedules, and look for broken promises",
                   "Runs random refinement schedules over the points and checks, after each stage, that\n"
                   "rectangles are nested and shrink as asked, that no status is retracted, that cells only\n"
                   "grow, that the way to the rectangles does not matter, and that random choices of points\n"
                   "agree. The first schedule narrows each point step by step up to --max-bits.\n"
                   "A fault is shown by the shortest schedule found, which --trace writes and --replay\n"
                   "repeats. Exit status 0: no fault; 1: a fault.",
                   DYD_CONTENT_CHECK, &cli_check},
    [CLI_VERIFY] = {"verify", "CERT", "check a certificate, in integers, without the engine",
                    "Checks a certificate that --certificate wrote. Exit status 0: everything that it states is\n"
                    "proved; 3: accepted, but something that it states is not proved, and named; 1: rejected,\n"
                    "with the line and the reason. With --points FILE, and the options that FILE is read by, it\n"
                    "also has to be about these points.",
                    DYD_CONTENT_NONE, &cli_verify},
    [CLI_DISC] = {"disc", "FILE", "the partial disc of the first three points, and where the others are",
                  "The six critical circles of the first three points, exactly and enclosed by decimals: F\n"
                  "encloses a rectangle, C touches it. The summary has the orientation, the box of all\n"
                  "centres of circles through the three points, and how many other points are certainly\n"
                  "inside or outside all these circles; --layer con lists these points. Points are refined\n"
                  "until that is known.",
                  DYD_CONTENT_DISC, &cli_disc},
    [CLI_BISECTOR] = {"bisector", "FILE", "the partial bisector of the first two points",
                      "The two curves that bound the regions certainly nearer to one point and to the other:\n"
                      "each a chain of at most seven arcs of lines and parabolas, with exact ends. The points\n"
                      "are refined until their rectangles are disjoint.",
                      DYD_CONTENT_BISECTOR, &cli_bisector},
    [CLI_NEAREST] = {"nearest", "FILE X Y", "the points that are certainly or possibly nearest to a place",
                     "The points nearest to the place (X,Y), coordinates of any form: certain if\n"
                     "one is nearest wherever in their rectangles the points lie, possible otherwise; with\n"
                     "bounds of the distance. The place and the points concerned are refined until one is\n"
                     "certain. --queries FILE answers many places at once.",
                     DYD_CONTENT_NEAREST, &cli_nearest},
    [CLI_TOLERANCE] = {"tolerance", "FILE", "how far the points may move before edges are lost or born",
                       "For every edge the distance up to which all points may move at\n"
                       "once before it may be lost (death), for other pairs that before which none becomes\n"
                       "an edge (birth), for every point how far it may be from its place, and the like for\n"
                       "the whole. Numbers lo are rounded down, hi up, at most 2^-40 of themselves apart;\n"
                       "empty: never. k and l are the points that bind.",
                       DYD_CONTENT_TOLERANCE, &cli_tolerance},
    [CLI_PLAN] = {"plan", "FILE", "which points to measure next, and how accurately, so that all is decided",
                  "For points known as rectangles: the points to measure, the most useful first.\n"
                  "If each new position is within half_width_needed of the old one (the centre of its\n"
                  "rectangle), every pair is decided; otherwise run plan again. One triangulation proves\n"
                  "it. Pairs that tie at the centres are not counted. Exit status 3: some pairs stay\n"
                  "undecided.",
                  DYD_CONTENT_PLAN, &cli_plan},
};

const char *const cli_group_names[CLI_GROUPS] = {[CLI_INPUT] = "Input",
                                                 [CLI_REFINEMENT] = "Refinement",
                                                 [CLI_OUTPUT] = "Output",
                                                 [CLI_EXPERIMENTS] = "Experiments",
                                                 [CLI_OTHER] = "Other"};

const cli_option cli_option_table[] = {
    {"points", 0, "FILE", CLI_SOURCE, BIT(CLI_VERIFY), CLI_INPUT, "the certificate has to be about the points of FILE",
     AT(points)},
    {"proved", 0, NULL, CLI_FLAG, BIT(CLI_VERIFY), CLI_OTHER,
     "check by dyadel-proved, extracted from a proof in Coq; it\nchecks fewer statements, and names the others; "
     "this\nprogram compares "
     "points, and passes on which cannot be narrowed",
     AT(proved)},
    {"columns", 0, "NAME,NAME", CLI_TEXT, TEXT, CLI_INPUT,
     "FILE is CSV with a header; take these two columns as x,y:\nnames (capitals count only where names differ by "
     "them\n"
     "alone), or numbers from 1",
     AT(read.columns)},
    {"delimiter", 0, "C", CLI_TEXT, TEXT, CLI_INPUT,
     "what separates columns (default: of , ; tab, | and blanks the\none that suits the header); tab, or blank for "
     "runs of "
     "blanks",
     AT(read.delimiter)},
    {"decimal-comma", 0, NULL, CLI_FLAG, TEXT, CLI_INPUT, "47,61 is 47.61", AT(read.decimal_comma)},
    {"thousands", 0, "C", CLI_TEXT, TEXT, CLI_INPUT, "separator of thousands in numbers: , . ' _ or blank",
     AT(read.thousands)},
    {"no-header", 0, NULL, CLI_FLAG, TEXT, CLI_INPUT, "the table has no header: --columns and the like are numbers",
     AT(read.no_header)},
    {"units-row", 0, NULL, CLI_FLAG, TEXT, CLI_INPUT,
     "the row behind the header holds units and no point; with\n--sphere they are the units of radii",
     AT(read.units_row)},
    {"skip-lines", 0, "N", CLI_TEXT, TEXT, CLI_INPUT, "skip the first N lines of FILE", AT(read.skip_lines)},
    {"radius-column", 0, "NAME", CLI_TEXT, TEXT, CLI_INPUT,
     "widen each point by the value in this column; NAME,NAME\nfor x and y apart; with --sphere each value, the "
     "column's\n"
     "name (\"sde(m)\", \"s [mm]\") or --radius-unit states a unit;\ntolerance: each point moves in proportion to it, "
     "0: "
     "not at\nall",
     AT(read.radius_columns)},
    {"radius-unit", 0, "U", CLI_TEXT, GLOBE, CLI_INPUT,
     "with --sphere: the unit of radii without one: m, mm, cm, km,\nft, in, deg, arcmin or arcsec",
     AT(read.radius_unit)},
    {"radius-scale", 0, "K", CLI_TEXT, TEXT, CLI_INPUT,
     "multiply all radii by K: 0.001 for millimetres with\ncoordinates in metres, 3 for a bound of 3 sigma",
     AT(read.radius_scale)},
    {"sigma-column", 0, "S", CLI_TEXT, TEXT, CLI_INPUT,
     "one standard deviation (1 sigma) of normal errors of each\npoint, with --confidence; SX,SY for x and y apart, "
     "SX,SY,RHO\nwith their correlation; units as of radii; receivers that\nstate CEP (50%) or 95%: --radius-scale "
     "0.8494 or 0.4086;\ntolerance: as --sigma, of each point its own",
     AT(read.sigma_column)},
    {"confidence", 0, "P", CLI_TEXT, TEXT & ~BIT(CLI_TOLERANCE), CLI_INPUT,
     "such as 95% or 0.95: widen each point by k of its standard\ndeviations, so that with at least this probability "
     "everything\nthat is stated holds, all together",
     AT(read.confidence)},
    {"cost-column", 0, "NAME", CLI_TEXT, (RUN & ~BIT(CLI_CHECK)) | BIT(CLI_PLAN), CLI_INPUT,
     "cost of measuring each point again: the schedule prefers\ncheap points; plan minimises the total cost instead "
     "of\nthe number of points",
     AT(read.cost_column)},
    {"id", 0, "NAME", CLI_TEXT, TEXT, CLI_INPUT, "column of identifiers, written next to row numbers", AT(read.id)},
    {"carry", 0, "NAME,...", CLI_TEXT, TEXT & ~BIT(CLI_VERIFY), CLI_INPUT,
     "layers with a row for each point repeat these columns of\nFILE; all: all but x and y", AT(read.carry)},
    {"in-layer", 0, "NAME", CLI_TEXT, TEXT, CLI_INPUT,
     "the layer of a GeoPackage, GPX or other file that GDAL reads\n(default: the one that has points); its attributes "
     "are\ncolumns",
     AT(in_layer)},
    {"skip-missing", 0, NULL, CLI_FLAG, TEXT, CLI_INPUT,
     "skip rows whose coordinate or radius is missing: empty,\nNA, N/A, NaN, null, None, -, errors of a "
     "spreadsheet; "
     "the\nothers keep their row numbers",
     AT(read.skip_missing)},
    {"missing", 0, "TEXT", CLI_TEXT, TEXT, CLI_INPUT, "what means missing besides, such as -9999", AT(read.missing)},
    {"merge", 0, NULL, CLI_FLAG, TEXT, CLI_INPUT, "equal coordinates are one point, with the smallest of their\nradii",
     AT(read.merge)},
    {"merge-by", 0, "id", CLI_TEXT, TEXT, CLI_INPUT,
     "rows of one --id are one point, in the region of each: boxes\nintersect, of discs the smallest counts; with "
     "--confidence\nthe mean weighted by inverse variances: errors of these rows\nmust be independent",
     AT(read.merge_by)},
    {"measured", 0, NULL, CLI_FLAG, TEXT & ~BIT(CLI_TOLERANCE), CLI_INPUT,
     "decimals are rounded measurements: 47.61 is [47.605,47.615]", AT(read.measured)},
    {"radius", 0, "R", CLI_TEXT, TEXT & ~BIT(CLI_TOLERANCE), CLI_INPUT, "widen every point by R on each side",
     AT(read.radius)},
    {"discs", 0, NULL, CLI_FLAG,
     BIT(CLI_DELAUNAY) | BIT(CLI_VORONOI) | BIT(CLI_CONVERGE) | BIT(CLI_NEAREST) | BIT(CLI_PLAN) | BIT(CLI_VERIFY),
     CLI_INPUT,
     "radii are those of discs, not of squares around them:\nfewer pairs stay indeterminate; plan: for pairs that do;\n"
     "voronoi, converge: cells of discs, bounded by hyperbolas;\n"
     "verify: the discs of FILE have to be those of the certificate",
     AT(discs)},
    {"sphere", 0, NULL, CLI_FLAG, GLOBE, CLI_INPUT,
     "points are longitude and latitude in degrees, on a sphere;\nradii have a unit: 30m, 2km, 5ft, 0.01deg, "
     "3arcsec;\nnearest: X Y are degrees, too, distances are metres along\nthe ground; "
     "plan: half-widths are metres on the ground;\nconverge: counts pairs, without bounds",
     AT(sphere)},
    {"plane", 0, NULL, CLI_FLAG, TEXT, CLI_INPUT,
     "columns called longitude and latitude are meant to be\ncoordinates in a plane: no note about it", AT(plane)},
    {"oracle", 0, "COMMAND", CLI_TEXT, READ, CLI_INPUT,
     "instead of FILE: ask this program (sh -c) for the points;\nit prints \"points N\", then answers each line "
     "\"refine I B\"\nby \"I XLO XHI YLO YHI\", aiming at widths of 2^-B",
     AT(oracle)},
    {"oracle-jobs", 0, "K", CLI_INTEGER, READ, CLI_INPUT,
     "this many programs in parallel (default 1); each finds its\n"
     "number, from 0, in DYADEL_JOB",
     AT(oracle_jobs), RANGE(1, DYD_ORACLE_MAX_JOBS)},
    {"oracle-batch", 0, "B", CLI_INTEGER, READ, CLI_INPUT,
     "send a program up to this many lines before awaiting answers\n"
     "(default 1); higher where lines travel far",
     AT(oracle_batch), RANGE(1, DYD_ORACLE_MAX_BATCH)},
    {"oracle-retries", 0, "K", CLI_INTEGER, READ, CLI_INPUT,
     "start a program that died, or is silent, again, at most so\noften for one request (default 0)",
     AT(oracle_retries), RANGE(0, 1000000)},
    {"oracle-timeout", 0, "SECONDS", CLI_SECONDS, READ, CLI_INPUT,
     "wait at most this long for a line of a program, also that of\n--policy (default 30)", AT(oracle_timeout)},

    {"queries", 0, "FILE", CLI_SOURCE, BIT(CLI_NEAREST), CLI_INPUT,
     "instead of X Y: a file of places, in any form that FILE may\nhave; one triangulation answers all", AT(queries)},
    {"query-columns", 0, "X,Y", CLI_TEXT, BIT(CLI_NEAREST), CLI_INPUT,
     "--columns of the file of places (default: the names of\n--columns, where its header has them)",
     AT(query_columns)},
    {"query-id", 0, "NAME", CLI_TEXT, BIT(CLI_NEAREST), CLI_INPUT,
     "write the value of this column of the file of places", AT(query_id)},

    {"until", 0, "GOAL", CLI_GOAL, RUN | PIECES, CLI_REFINEMENT,
     "decided (default), area:M or hausdorff:M (bound 2^-M)", AT(engine), WORDS("decided area: hausdorff:")},
    {"of", 0, "WHAT", CLI_CHOICE, BIT(CLI_CONVERGE), CLI_REFINEMENT,
     "what the table is about, which bounds it has, and --until\nmeans: delaunay (default); voronoi (those of the "
     "diagram as\n"
     "well: they cost most); disc (of the first three points, and\nCon of the others); bisector (of the first two)",
     AT(of), WORDS("delaunay voronoi disc bisector")},
    {"modulus", 0, "A:B", CLI_TEXT, BIT(CLI_CONVERGE), CLI_REFINEMENT,
     "instead of stages: for each m from A to B the first stage with\na distance of at most 2^-m (with --until area:M, "
     "an area),\nthe bits asked of all points and of one, and the bits known a\npriori to suffice; steps of 1 bit from "
     "1 on "
     "(--step-bits,\n--start-bits), until 2^-B is reached",
     AT(modulus)},
    {"hindsight", 0, "K", CLI_INTEGER, BIT(CLI_CONVERGE), CLI_REFINEMENT,
     "column ratio: bits_total to the least bits by which the goal\ncould have been reached; of few points, found with "
     "up "
     "to K\ntriangulations",
     AT(hindsight), RANGE(1, (long long)1 << 40)},
    {"max-bits", 0, "B", CLI_INTEGER, REFINE, CLI_REFINEMENT,
     "precision at which to give up (default 4096, of check 192)", AT(engine.max_bits), RANGE(1, DYD_EXP_LIMIT),
     GIVEN(max_bits_set)},
    {"max-pairs", 0, "K", CLI_INTEGER, RUN | BIT(CLI_TOLERANCE) | BIT(CLI_PLAN), CLI_REFINEMENT,
     "cap on stored pairs (default 4000000 + 16 per point)", AT(engine.max_pairs), RANGE(1, (long long)1 << 40)},
    {"max-bytes", 0, "BYTES", CLI_BYTES, READ & ~BIT(CLI_CHECK) & ~PIECES, CLI_REFINEMENT,
     "memory for points, triangulation and results, by\nestimates: 500M, 2G (powers of 1024); where more "
     "would be\ntaken the command ends with status 4 (default: no limit)",
     AT(engine.max_bytes), RANGE(1, (long long)1 << 50)},
    {"timeout", 0, "SECONDS", CLI_SECONDS, CLI_ALL, CLI_REFINEMENT, "end after this time, reading and writing included",
     AT(engine.seconds), SILENT},
    {"schedule", 0, "WHICH", CLI_CHOICE, RUN, CLI_REFINEMENT,
     "adaptive (default): refine undecided pairs;\nuniform: refine all points", AT(engine.schedule),
     WORDS("adaptive uniform")},
    {"policy", 0, "COMMAND", CLI_TEXT, RUN & ~BIT(CLI_CHECK), CLI_REFINEMENT,
     "this program (sh -c) may change the plan of each stage: it\nreads \"stage S points N\", \"pair I J\" for each "
     "undecided\n"
     "pair, \"plan I B\" for each point planned, \"choose\"; it answers\nby lines \"refine I B\" instead of the plan, "
     "and \"go\"",
     AT(engine.policy_program)},
    {"start-bits", 0, "B", CLI_INTEGER, RUN | PIECES, CLI_REFINEMENT,
     "precision of the first stage (default 64, of converge 4)", AT(engine.start_bits), RANGE(1, DYD_EXP_LIMIT),
     GIVEN(start_set)},
    {"step-bits", 0, "K", CLI_INTEGER, RUN | PIECES, CLI_REFINEMENT,
     "refine in steps of K bits (default: geometric growth)", AT(engine.step_bits), RANGE(1, DYD_EXP_LIMIT)},
    {"ties", 0, "WHICH", CLI_CHOICE, RUN | BIT(CLI_NEAREST) | BIT(CLI_TOLERANCE), CLI_REFINEMENT,
     "prove (default): prove that points given by expressions\nand roots are the same, on one line or circle; off: do "
     "not",
     AT(engine.no_ties), WORDS("prove off")},
    {"tie-bits", 0, "B", CLI_INTEGER, RUN | BIT(CLI_NEAREST) | BIT(CLI_TOLERANCE), CLI_REFINEMENT,
     "precision at which to give up a proof (default 131072)", AT(engine.tie_bits), RANGE(1, 1 << 26)},
    {"threads", 0, "T", CLI_INTEGER, RUN | BIT(CLI_TOLERANCE) | BIT(CLI_PLAN), CLI_REFINEMENT,
     "threads to use (default 1); results do not depend on it", AT(engine.threads), RANGE(1, 1024), SILENT},

    {"window", 0, "XLO,XHI,YLO,YHI", CLI_WINDOW, RUN | PIECES | BIT(CLI_TOLERANCE) | BIT(CLI_PLAN), CLI_OUTPUT,
     "part of the plane, exact numbers;\nvoronoi, converge, check: of the diagram (default: the box of the\n"
     "points enlarged by half);\nbisector: where --until holds, and of pictures; disc: of\npictures; delaunay, "
     "tolerance: what svg, pdf, png and html show (default: all),\nother formats "
     "list everything all the same;\nwith "
     "--sphere: the degrees that svg, pdf and png show;\n"
     "plan: only pairs with an end in it are to be decided",
     AT(window)},
    {"flatten", 0, "M", CLI_INTEGER, BIT(CLI_VORONOI), CLI_OUTPUT, "draw arcs by polygons within 2^-M of them",
     AT(flatten_bits), RANGE(-DYD_EXP_LIMIT, DYD_EXP_LIMIT), GIVEN(flatten_set)},
    {"max-arc", 0, "DEG", CLI_DEGREES, BIT(CLI_VORONOI), CLI_OUTPUT,
     "with --sphere: divide sides of cells into arcs of DEG degrees\nat most (default 1)", AT(max_arc)},
    {"format", 0, "F", CLI_FORMAT, CLI_ALL, CLI_OUTPUT, NULL, AT(format), GIVEN(format_set)},
    {"accuracy", 0, "A", CLI_TEXT, BIT(CLI_PLAN), CLI_REFINEMENT,
     "measuring gives a point within A, an exact number, with\n--sphere a length with its unit: 5m (default: as "
     "exactly as\nit takes)",
     AT(accuracy)},
    {"pairs", 0, "FILE", CLI_SOURCE, BIT(CLI_PLAN), CLI_REFINEMENT,
     "only these pairs are to be decided: lines i,j,... as\ndelaunay writes them", AT(pairs)},
    {"site", 0, "K", CLI_INTEGER, BIT(CLI_PLAN), CLI_REFINEMENT, "only pairs of point K are to be decided", AT(site),
     RANGE(0, UINT32_MAX), GIVEN(site_set)},
    {"next", 0, NULL, CLI_FLAG, BIT(CLI_PLAN), CLI_OUTPUT, "only the first point to measure", AT(next)},
    {"up-to", 0, "EPS", CLI_TEXT, BIT(CLI_TOLERANCE), CLI_REFINEMENT,
     "also births: pairs that may become edges when points\nmove by EPS at most; an exact number", AT(up_to)},
    {"relative-bits", 0, "B", CLI_INTEGER, BIT(CLI_TOLERANCE), CLI_REFINEMENT,
     "computable points: refine until lo and hi are at most 2^-B\nof themselves apart (default 20)", AT(relative_bits),
     RANGE(1, 40)},
    {"metric", 0, "WHICH", CLI_CHOICE, BIT(CLI_TOLERANCE), CLI_REFINEMENT,
     "euclid (default): points move in discs; box: x and y each\nby as much, in squares, bounds 2^-20 of themselves "
     "apart",
     AT(metric), WORDS("euclid box")},
    {"sigma", 0, "S", CLI_TEXT, BIT(CLI_TOLERANCE), CLI_REFINEMENT,
     "also a lower bound of each edge's probability, for normal\nerrors of standard deviation S in x and in y",
     AT(sigma)},

    {"layer", 0, "L", CLI_LAYER, BIT(CLI_DELAUNAY) | BIT(CLI_VORONOI) | BIT(CLI_TOLERANCE) | BIT(CLI_DISC), CLI_OUTPUT,
     "what csv, wkt and geojson hold, and html shows first;\ndelaunay: pairs (default), points, triangles,\n"
     "graph:nearest, graph:gabriel, graph:mst (edges that are\ncertain or possible; also pictures), aliases (rows "
     "that\n"
     "have a point in common with an earlier one), ties,\nhulls (partial edges and triangles), exterior (where "
     "certainly\nno edge is: exact polygons);\nvoronoi: cells (default), tiles (a partition), vertices,\n"
     "regions, edges, aliases;\n"
     "delaunay, voronoi: json and vtk hold all of them but graphs,\nhulls and exterior;\n"
     "tolerance: pairs (default), points, barcode (csv: how "
     "many\n"
     "edges are certain at which accuracy)\n"
     "disc: circles (default: the six critical circles), con (where\nthe other points are)",
     AT(layer)},
    {"list-ties", 0, "HOW", CLI_CHOICE, BIT(CLI_DELAUNAY), CLI_OUTPUT,
     "pairs (default): a row for each tied pair; groups: csv\nlists the circles and lines that the tied points are on\n"
     "instead of pairs (kind,sites); none: no tied pair",
     AT(list_ties), WORDS("pairs groups none")},
    {"crs", 0, "EPSG:N", CLI_CRS, BIT(CLI_DELAUNAY) | BIT(CLI_VORONOI) | BIT(CLI_TOLERANCE) | BIT(CLI_PLAN), CLI_OUTPUT,
     "the reference system of the coordinates, for geojson and\njson (default: none is claimed)", AT(epsg),
     WORDS("EPSG:")},
    {"clip", 0, NULL, CLI_FLAG, BIT(CLI_VORONOI), CLI_OUTPUT,
     "--layer edges: cut edges to the window, and omit edges\nbeyond it", AT(clip)},
    {"clip-to", 0, "FILE", CLI_SOURCE, BIT(CLI_VORONOI), CLI_OUTPUT,
     "--layer tiles: cut tiles to the polygons of FILE, well-known\ntext or GeoJSON, with holes and islands; one row "
     "for each\n"
     "point (not in vtk); the default window is around them",
     AT(clip_to)},
    {"length", 0, NULL, CLI_FLAG, BIT(CLI_DELAUNAY), CLI_OUTPUT,
     "rows of pairs and graphs have bounds of the length: columns\nlength_lo and length_hi", AT(lengths)},
    {"comments", 0, NULL, CLI_FLAG, READ & ~BIT(CLI_CHECK), CLI_OUTPUT,
     "csv begins with lines of \"# \": window, bounds, goal, points\nthat coincide, how numbers are rounded; json "
     "repeats the call",
     AT(comments)},
    {"output", 'o', "FILE", CLI_FILE, CLI_ALL, CLI_OUTPUT,
     "write to FILE, whole or not at all; its ending, such as\n.svg, chooses the format", AT(output), SILENT},
    {"bare", 0, NULL, CLI_FLAG, DRAW, CLI_OUTPUT, "pictures: without legend, scale and coordinates", AT(style.bare)},
    {"width", 0, "LENGTH", CLI_LENGTH, DRAW, CLI_OUTPUT,
     "pictures: so wide: 85mm, 12cm, 3.25in, or points of 1/72 inch\n(default: 1120)", AT(style.width)},
    {"font-size", 0, "LENGTH", CLI_LENGTH, DRAW, CLI_OUTPUT,
     "pictures: of texts, in points (default: 14; on a smaller page\nless, down to 7)", AT(style.font_size)},
    {"font", 0, "NAME", CLI_TEXT, DRAW, CLI_OUTPUT,
     "pictures: a family of fonts (default: sans-serif); tikz: one\nof LaTeX, such as phv (default: the document's)",
     AT(style.font)},
    {"certificate", 0, "FILE", CLI_FILE, BIT(CLI_DELAUNAY) | BIT(CLI_VORONOI) | BIT(CLI_NEAREST), CLI_OUTPUT,
     "write what proves the result; see dyadel verify", AT(certificate)},
    {"stats", 0, NULL, CLI_FLAG, RUN, CLI_OUTPUT, "print counters to standard error", AT(stats)},
    {"accept-fixpoint", 0, NULL, CLI_FLAG, REFINE & ~BIT(CLI_CHECK) & ~BIT(CLI_TOLERANCE), CLI_OUTPUT,
     "exit status 0 instead of 3, for scripts that stop at errors", AT(accept_fixpoint)},
    {"quiet", 'q', NULL, CLI_FLAG, CLI_ALL, CLI_OUTPUT, "no progress, no notes", AT(quiet), SILENT},

    {"plot", 0, "FILE", CLI_FILE, BIT(CLI_CONVERGE), CLI_EXPERIMENTS,
     "draw the table; FILE ends in .svg, .pdf, .png, .tikz or .pgf", AT(plot)},
    {"pgf", 0, "FILE", CLI_FILE, BIT(CLI_CONVERGE), CLI_EXPERIMENTS,
     "write the curves of bounds and widths as an axis of pgfplots,\nfor \\input in a LaTeX document", AT(pgf)},
    {"trace", 0, "FILE", CLI_FILE, REFINE, CLI_EXPERIMENTS,
     "write which point was narrowed to what, and why, as it\nhappens; check: the schedule that shows a fault",
     AT(trace), SILENT},
    {"trace-sync", 0, "SECONDS", CLI_SECONDS, REFINE & ~BIT(CLI_CHECK), CLI_EXPERIMENTS,
     "sync the trace with the disk after this time of asking (default 5):\nwhen the machine fails, only later answers "
     "are "
     "lost",
     AT(trace_sync), SILENT},
    {"resume", 0, "FILE", CLI_SOURCE, REFINE & ~BIT(CLI_CHECK), CLI_INPUT,
     "continue from this trace, which may have been cut short: its\nanswers are not requested again", AT(resume),
     SILENT},
    {"replay", 0, "FILE", CLI_SOURCE, BIT(CLI_CONVERGE) | BIT(CLI_CHECK), CLI_EXPERIMENTS,
     "repeat a trace instead of asking points;\ncheck: repeat a schedule on the points of FILE or --oracle",
     AT(replay)},
    {"no-times", 0, NULL, CLI_FLAG, BIT(CLI_CONVERGE), CLI_EXPERIMENTS,
     "omit seconds, and from json the command line: equal runs give\nequal bytes", AT(no_times)},
    {"label", 0, "NAME=VALUE,...", CLI_TEXT, BIT(CLI_CONVERGE), CLI_EXPERIMENTS,
     "columns before the others, to distinguish runs", AT(label)},
    {"rows-only", 0, NULL, CLI_FLAG, BIT(CLI_CONVERGE), CLI_EXPERIMENTS,
     "csv: rows only, so that tables put behind each other are one", AT(no_header)},
    {"seed", 0, "S", CLI_INTEGER, BIT(CLI_CHECK), CLI_EXPERIMENTS, "seed of random choices; printed", AT(seed),
     RANGE(0, INT64_MAX), GIVEN(seed_set)},
    {"schedules", 0, "K", CLI_INTEGER, BIT(CLI_CHECK), CLI_EXPERIMENTS, "random schedules to try", AT(schedules),
     RANGE(1, 1000000)},

    {"help", 'h', "KIND", CLI_HELP, CLI_ALL, CLI_OTHER,
     "this text; after a command: its options;\n--help=man, bash, zsh: manual page, completion script", AT(help)},
    {"version", 'V', NULL, CLI_FLAG, CLI_ALL, CLI_OTHER, "the version", AT(version)},
};
const size_t cli_option_count = sizeof cli_option_table / sizeof *cli_option_table;

/* Returns true if one of the commands writes the format. */
static bool is_format_of(dyd_format format, unsigned commands) {
  for (unsigned c = 0; c < CLI_COMMANDS; c++)
    if (commands & BIT(c) && dyd_format_holds(format, cli_commands[c].content)) return true;
  return false;
}

bool cli_option_exists(const cli_option *option, unsigned commands) {
  unsigned f = 0, takers = option->commands & commands;
  if (option->kind != CLI_FORMAT) return takers != 0;
  while (dyd_format_name((dyd_format)f) && !is_format_of((dyd_format)f, takers)) f++;
  return dyd_format_name((dyd_format)f) != NULL;
}

const cli_command *cli_command_find(const char *name) {
  for (unsigned c = 0; c < CLI_COMMANDS; c++)
    if (strcmp(cli_commands[c].name, name) == 0) return &cli_commands[c];
  return NULL;
}

unsigned cli_command_bit(const cli_command *c) {
  return BIT((unsigned)(c - cli_commands));
}

void cli_commands_print(FILE *out, unsigned commands, const char *separator) {
  const char *before = "";
  for (unsigned c = 0; c < CLI_COMMANDS; c++) {
    if (!(commands & BIT(c))) continue;
    fprintf(out, "%s%s", before, cli_commands[c].name);
    before = separator;
  }
}

void cli_layers_print(FILE *out, unsigned commands, const char *separator) {
  const char *before = "";
  for (unsigned c = 0; c < CLI_COMMANDS; c++)
    for (size_t k = 0; commands & BIT(c) && dyd_layer_name(cli_commands[c].content, k); k++) {
      fprintf(out, "%s%s", before, dyd_layer_name(cli_commands[c].content, k));
      before = separator;
    }
}

void cli_formats_print(FILE *out, unsigned commands, const char *separator, bool mark) {
  bool first = true;
  for (unsigned f = 0; dyd_format_name((dyd_format)f); f++) {
    if (!is_format_of((dyd_format)f, commands)) continue;
    fprintf(out, "%s%s%s", first ? "" : separator, dyd_format_name((dyd_format)f), first && mark ? " (default)" : "");
    first = false;
  }
}
