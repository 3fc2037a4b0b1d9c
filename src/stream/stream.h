/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Streams inside the library. */
#ifndef DYD_STREAM_STREAM_H
#define DYD_STREAM_STREAM_H

#include <dyadel/stream.h>

/* As dyd_stream_new for a source that encloses one and the same point every time: its rectangles are intersected
 * with the former ones [NEST-2]. The context is released on failure too. */
dyd_status dyd_stream_new_enclosing(dyd_stream **out, const dyd_source *source);
/* A stream that is final from the start; swaps *value into it. */
dyd_status dyd_stream_new_fixed(dyd_stream **out, dyd_rect *value);
/* The context of s if `narrow` is its callback, else NULL. Borrowed. */
void *dyd_stream_user(const dyd_stream *s, dyd_narrow_fn narrow);

#endif
