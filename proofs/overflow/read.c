/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/read.c: whatever bytes come, they are read where they are, and numbers stay in range. */
/* Without dyd_cert_reader_clear: not tried. */
#include "read.h"

#include "base/alloc.h"
#include "base/error.h"

#define ITEM char
#define RESERVE dyd_reserve
#define ALLOC alloc_chars
#include "lists.h"

/*@ predicate reads_on(reading r, FILE *in, dyd_error *err) = \valid(r) && r->in == in && r->err == err &&
      \valid(in) &&
      (err == \null || \valid(err)) && \separated(r, err, in) && r->cap <= 1152921504606846976 &&
      (0 < r->cap ==> \valid(r->line + (0 .. r->cap - 1))); */

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
    assigns \nothing; exits \false; ensures \result && x->man[0].sign != 0 ==> certified(x); */
static bool exact_in_range(const dyd_exact *x);
/*@ requires \valid(out) && exact(out) && line(text); assigns *out, text[0 .. stop(text)]; exits \false;
    ensures whole(&out->man[0]);
    ensures \result ==> certified(out); */
static bool scan_number(dyd_exact *out, char *text);
/*@ requires \valid_read(r) && (r->err == \null || \valid(r->err)) && \separated(r->err, r) && string(text);
    requires \valid(out) && exact(&out->lo) && \separated(out, r, r->err);
    requires out->den == \null || \valid(out->den) && \separated(out->den, out, r, r->err);
    exits \false; */
static dyd_status read_den(dyd_cert_side *out, dyd_cert_reader *r, const char *text);

#include "checker/read.c"
