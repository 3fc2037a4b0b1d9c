/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts of src/checker/read.c: a line is any bytes up to the first zero. */
#ifndef DYD_PROOFS_READ_H
#define DYD_PROOFS_READ_H

#include "sites.h"

#include <errno.h>

#include "checker/read.h"

typedef const dyd_cert_reader *reading;

/* The memory of the lines, which dyd_reserve gives: apart from all other. */
extern char LINES[1152921504606846976];

/*@ predicate kept(reading r) = \valid(r) && \valid(r->in) && r->cap <= 1152921504606846976 &&
      (r->err == \null || \valid(r->err)) && \separated(r, r->err, r->in, LINES + (..)) &&
      (0 < r->cap ==> \valid(r->line + (0 .. r->cap - 1)) && \base_addr(r->line) == \base_addr(LINES + 0));
    predicate inside(reading r, chars s) = string(s) && within(s, r->line) && (s - r->line) + stop(s) < r->cap;
    predicate reads(reading r) = kept(r) && (r->at != \null ==> 0 < r->cap && inside(r, r->at)); */

/*@ requires \valid_read(r) && (r->err == \null || \valid(r->err)); assigns *r->err; exits \false;
    ensures \result == DYD_E_PARSE; */
dyd_status reject(const dyd_cert_reader *r);
#define dyd_cert_reject(r, ...) reject(r)

/*@ requires \valid(r); assigns r->line; exits \false; */
void dyd_cert_reader_clear(dyd_cert_reader *r);
/*@ requires kept(r); assigns r->number, r->line, r->cap, r->at, LINES[..], *r->in, *r->err, errno; exits \false;
    ensures kept(r); ensures \result == DYD_OK ==> r->at == r->line && reads(r) && 0 < r->cap; */
dyd_status dyd_cert_next_line(dyd_cert_reader *r);
/*@ requires kept(r); assigns r->number, *r->err, *r->in, errno; exits \false; */
dyd_status dyd_cert_expect_end(dyd_cert_reader *r);
/*@ requires \valid_read(r); assigns \nothing; exits \false; ensures \result <==> r->at != \null; */
bool dyd_cert_line_has_more(const dyd_cert_reader *r);
/*@ requires reads(r) && \valid(out) && \separated(out, r, r->err);
    assigns r->at, r->line[0 .. r->cap - 1], *out, *r->err; exits \false; ensures reads(r);
    ensures \result == DYD_OK ==> inside(r, *out) &&
      (r->at != \null ==> within(r->at, *out) && stop(*out) < r->at - *out) &&
        \separated(r->err, r->line + (0 .. r->cap - 1)) &&
      \valid(r->line + (0 .. r->cap - 1)); */
dyd_status dyd_cert_word(char **out, dyd_cert_reader *r);
/*@ requires reads(r); assigns *r->err; exits \false; ensures \result == DYD_OK ==> r->at == \null; */
dyd_status dyd_cert_line_done(dyd_cert_reader *r);
/*@ requires \valid(out) && whole(out) && string(text); assigns *out; exits \false; ensures whole(out); */
bool dyd_cert_scan_integer(mpz_ptr out, const char *text);
/*@ requires reads(r) && \valid(out) && \separated(out, r, r->err);
    assigns r->at, r->line[0 .. r->cap - 1], *out, *r->err;
    exits \false; ensures reads(r);
    ensures \result == DYD_OK ==> -999999999999999999 <= *out <= 999999999999999999; */
dyd_status dyd_cert_read_integer(long long *out, dyd_cert_reader *r);
/*@ requires reads(r) && \valid(out) && \separated(out, r, r->err) && most <= 4294967295;
    assigns r->at, r->line[0 .. r->cap - 1], *out, *r->err; exits \false; ensures reads(r);
    ensures \result == DYD_OK ==> *out <= most; */
dyd_status dyd_cert_read_index(uint32_t *out, dyd_cert_reader *r, uint64_t most);

/*@ predicate certified(exact_number x) = exact(x) && -1048576 <= x->exp <= 1048576 && bits(&x->man[0]) <= 2097152; */
/*@ requires reads(r) && \valid(out) && exact(out) && \separated(out, r, r->err);
    assigns r->at, r->line[0 .. r->cap - 1], *out, *r->err; exits \false; ensures reads(r) && whole(&out->man[0]);
    ensures \result == DYD_OK ==> certified(out); */
dyd_status dyd_cert_read_number(dyd_exact *out, dyd_cert_reader *r);
/*@ requires reads(r) && \valid(out + (0 .. 1)) && exact(out) && exact(out + 1) &&
      \separated(out + (0 .. 1), r, r->err);
    assigns r->at, r->line[0 .. r->cap - 1], out[0 .. 1], *r->err; exits \false; ensures reads(r);
    ensures \result == DYD_OK ==> certified(out) && certified(out + 1); */
dyd_status dyd_cert_read_point(dyd_exact out[2], dyd_cert_reader *r);
/*@ requires reads(r) && \valid(out) && exact(&out->lo) && exact(&out->hi) && \separated(out, r, r->err);
    requires \separated(out, r->in, LINES + (..)) && (out->den == \null || \separated(out->den, r->in, LINES + (..)));
    requires out->den == \null || \valid(out->den) && \separated(out->den, out, r, r->err);
    assigns r->at, r->line[0 .. r->cap - 1], *out, (*out->den)[0], *r->err; exits \false;
    ensures \result == DYD_OK ==> \valid(r) && \valid(r->in);
    ensures \result == DYD_OK ==> r->err == \null || \valid(r->err);
    ensures \result == DYD_OK ==> r->cap <= 1152921504606846976;
    ensures \result == DYD_OK ==> \separated(r, r->err, r->in, LINES + (..));
    ensures \result == DYD_OK && 0 < r->cap ==> \valid(r->line + (0 .. r->cap - 1)) &&
      \base_addr(r->line) == \base_addr(LINES + 0);
    ensures \result == DYD_OK && r->at != \null ==> 0 < r->cap && inside(r, r->at); */
dyd_status dyd_cert_read_side(dyd_cert_side *out, dyd_cert_reader *r);

#endif
