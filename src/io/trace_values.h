/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The values in a line of a trace; each function returns false when there is none of that kind. */
#ifndef DYD_IO_TRACE_VALUES_H
#define DYD_IO_TRACE_VALUES_H

#include <dyadel/stream.h>
#include <jansson.h>

/* FNV-1a, where it has come to before, of more bytes. */
#define DYD_TRACE_SUM_BEGIN UINT64_C(14695981039346656037)
uint64_t dyd_trace_sum(uint64_t sum, const char *text, size_t length);
/* Takes the sum over the line, of which it is not part, into *sum: is it the one that the line ends with? */
bool dyd_trace_is_sealed(uint64_t *sum, const char *text, size_t length);
bool dyd_trace_integer(int64_t *out, const json_t *line, const char *name, int64_t least, int64_t most);
bool dyd_trace_has_text(const json_t *line, const char *name, const char *wanted);
/* Dyadic texts at `from` and behind it. */
bool dyd_trace_ends(dyd_interval *out, const json_t *list, size_t from);
/* The side "x" or "y" of a rectangle. */
bool dyd_trace_side(dyd_interval *out, const json_t *line, const char *name);

#endif
