/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/read.c: whatever bytes come, they are read where they are, and numbers stay in range. */
#include "read.h"

#include "base/alloc.h"
#include "base/error.h"

#include <stdarg.h>

/* That arguments are of the types that the format names, the compiler looks at. */
/*@ requires 0 < size && \valid(s + (0 .. size - 1)); assigns s[0 .. size - 1]; exits \false; */
int vsnprintf(char *s, size_t size, const char *format, va_list args);

/* As in lists.h; what it gives is in LINES. */
/*@ requires \valid(array) && \valid(cap) && \separated(array, cap) && size == 1 && *cap <= 1152921504606846976;
    requires 0 < *cap ==> \valid(*array + (0 .. *cap - 1)) && \base_addr(*array) == \base_addr(LINES + 0);
    assigns *array, *cap; exits \false;
    ensures !\result ==> *array == \old(*array) && *cap == \old(*cap);
    ensures \result ==> need <= *cap <= 1152921504606846976;
    ensures \result && 0 < *cap ==> \valid(*array + (0 .. *cap - 1)) && \base_addr(*array) == \base_addr(LINES + 0); */
bool dyd_reserve(char **array, size_t *cap, size_t need, size_t size);

/*@ requires \valid_read(r) && (r->err == \null || \valid(r->err)); assigns *r->err; exits \false;
    ensures \result == DYD_E_IO; */
static dyd_status input_failed(dyd_cert_reader *r);
/*@ requires string(text); assigns \nothing; exits \false;
    ensures \result != \null ==> 1 <= \result - text <= stop(text) && within(\result, text); */
static const char *scan_decimal(const char *text);
/*@ requires \valid(out) && string(text); assigns *out; exits \false;
    ensures \result ==> -999999999999999999 <= *out <= 999999999999999999; */
static bool scan_small(long long *out, const char *text);
/*@ requires whole(&x->man[0]) && \valid_read(x) && -999999999999999999 <= x->exp <= 999999999999999999;
    assigns \nothing; exits \false; ensures \result && sign(&x->man[0]) != 0 ==> certified(x); */
static bool exact_in_range(const dyd_exact *x);
/*@ requires \valid(out) && exact(out) && line(text); assigns *out, text[0 .. stop(text)]; exits \false;
    ensures whole(&out->man[0]);
    ensures \result ==> certified(out); */
static bool scan_number(dyd_exact *out, char *text);
/*@ requires \valid_read(r) && (r->err == \null || \valid(r->err)) && \separated(r->err, r) && string(text);
    requires \valid(out) && exact(&out->lo) && \separated(out, r, r->err);
    requires out->den == \null || \valid(out->den) && \separated(out->den, out, r, r->err);
    assigns out->den, (*out->den)[0], *r->err; exits \false; */
static dyd_status read_den(dyd_cert_side *out, dyd_cert_reader *r, const char *text);

#include "checker/read.c"
