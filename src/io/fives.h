/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The powers of five that are single words: what decimals are divided by. */
#ifndef DYD_IO_FIVES_H
#define DYD_IO_FIVES_H

#include <stdint.h>

/* 5^27 < 2^63 < 5^28. */
enum { DYD_MOST_FIVES = 27 };
extern const uint64_t dyd_power_of_five[DYD_MOST_FIVES + 1];

#endif
