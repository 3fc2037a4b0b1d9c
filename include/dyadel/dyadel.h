/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Includes the complete public interface of dyadel.
 *
 * Arguments of all functions and callbacks have one order: outputs, then objects that are changed (the user pointer of
 * a callback among it), then inputs, and the error record, which may be NULL, last. A count comes before the arrays
 * that share it, or after its only array; a callback is followed by its user pointer.
 *
 * NULL instead of an object with a life (an engine, a stream, a result that does not exist yet) is DYD_E_ARG.
 * Functions without a status then return 0, false, NULL, or the answer that states nothing, such as DYD_INDETERMINATE.
 * Functions that free an object take NULL; functions that clear a struct of the caller do not. Outputs, numbers,
 * rectangles, texts and arrays that are not empty are never NULL unless the function says so.
 *
 * Points come in and statements go out as doubles, texts and numbers of sites. Only for exact corners, witnesses and
 * arcs are there the numbers and rectangles of dyadic.h, rect.h, predicate.h and arc.h; arc.h includes the others.
 *
 * Messages of errors name fields of options in backquotes, as in "raise `max_pairs`".
 *
 * ABI rules. A program keeps working with every later library of the same soname:
 *  1. Every struct of options, counters, reports, and every struct that callbacks are given, begins with struct_size,
 *     the size that its user was compiled with. The caller initialises it with DYD_SIZED (status.h) or the init
 *     function that is named next to the struct. The library reads and writes no byte beyond: members that an older
 *     caller lacks have their defaults (0); members of a newer caller that the library does not know must be 0
 *     (DYD_E_ARG otherwise), and are 0 in results. A size of 0 is DYD_E_ARG, with a message.
 *  2. Such a struct only ever grows at its end, by members for which 0 means the former behaviour, and never into
 *     padding: sizeof grows. So it is neither a member of another struct nor an element of an array, but for
 *     dyd_delaunay_counters, which has room to spare, and the requests of dyd_announce_fn (dyd_request_at).
 *  3. All other structs (numbers, rectangles, arcs, pairs, lists, dyd_error, ...) never change. Enumerations only get
 *     new values; functions keep their arguments and their meaning.
 *  4. tests/data/abi.xml describes the ABI, and the test "abi" fails on any difference: additions too, so that each
 *     is reviewed. After an intended change: `meson compile -C build renew-abi`.
 *  5. The soname (dyadel_soversion in meson.build) goes up by one with the first change since the last release that is
 *     more than rules 2 and 3 allow, whatever the version; at no other time. The library's version is never part of the
 *     soname. Before the first release anything may change. */
#ifndef DYADEL_DYADEL_H
#define DYADEL_DYADEL_H

#include <dyadel/certificate.h>
#include <dyadel/check.h>
#include <dyadel/compose.h>
#include <dyadel/converge.h>
#include <dyadel/engine.h>
#include <dyadel/graph.h>
#include <dyadel/io.h>
#include <dyadel/metric.h>
#include <dyadel/oracle.h>
#include <dyadel/sphere.h>
#include <dyadel/survey.h>
#include <dyadel/tolerance.h>
#include <dyadel/voronoi.h>

#endif
