/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Outputs that are inputs again: streams made of streams. Points of an engine as streams: dyd_engine_stream in
 * engine.h.
 *
 * Life times: a stream holds references to all that it is made of, so everything stays alive as long as a stream needs
 * it, an engine freed meanwhile included; the context of a callback is released when the engine and the last stream
 * made from it are gone.
 * Threads: streams that share a part are used by one thread at a time (stream.h); that holds for an engine and the
 * streams made from its points, too. */
#ifndef DYADEL_COMPOSE_H
#define DYADEL_COMPOSE_H

#include <dyadel/stream.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The centre of the circle through three computable points, such as the Voronoi vertex of a triangle; takes over the
 * three references, also on failure. Three exact points give the exact rational centre at once, so that ties among such
 * centres are recognised (DYD_E_DOMAIN when they are collinear). Otherwise each narrowing refines the points until the
 * triple is certainly oriented and the enclosure narrow enough [VTX-1]; where they are still possibly collinear at the
 * precision allowed, DYD_E_DOMAIN: collinear points have no centre. Fixed rectangles give an enclosure of their partial
 * centre, final. DYD_E_ARG for NULL, or when two of the streams are the same. */
DYD_API dyd_status dyd_stream_voronoi_vertex(dyd_stream **out, dyd_stream *a, dyd_stream *b, dyd_stream *c);
/* The point sum of weight[k] of[k] (k < n) plus shift (NULL: none); takes over the n references, also on failure.
 * Exact points give an exact point, n = 0 the point `shift` [CMB-1]. weight and shift are copied. */
DYD_API dyd_status dyd_stream_combination(dyd_stream **out, size_t n, dyd_stream *const *of, const mpq_t *weight,
                                          const mpq_t shift[2]);

#ifdef __cplusplus
}
#endif
#endif
