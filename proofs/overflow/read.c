/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/read.c: scanning a number stays within the text. */
#include "exact.h"

#include "checker/read.h"

/*@ requires valid_read_string(text); assigns \nothing; exits \false;
    ensures \result == \null || \subset(\result, text + (1 .. strlen(text))); */
static const char *scan_decimal(const char *text);
#include "checker/read.c"
