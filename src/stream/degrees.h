/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Degrees, minutes and seconds as people write them, as exact rationals. */
#ifndef DYD_STREAM_DEGREES_H
#define DYD_STREAM_DEGREES_H

#include <dyadel/status.h>
#include <gmp.h>
#include <stdbool.h>
#include <stddef.h>

/* Reads the whole text: 47°36'18.3"N, 47 36 18.3 N, 47:36:18.3, N47.605, with primes or other quotes; S and W are
 * negative. lo = hi is the number of degrees; measured: the last number is rounded, so that its last digit is half a
 * unit more or less. *letter is N, S, E or W, 0 where there is none. lo and hi are initialised by the caller. Returns
 * DYD_E_ARG, with err as it was, if the text is of another form; DYD_E_PARSE with column and message. */
dyd_status dyd_degrees_read(mpq_t lo, mpq_t hi, char *letter, const char *text, size_t length, bool measured,
                            dyd_error *err);

#endif
