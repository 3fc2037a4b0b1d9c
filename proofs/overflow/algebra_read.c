/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/algebra_read.c: operands are numbers before, operations have names. */
/* Without read_value, read_bracket, read_operation, read_number, dyd_cert_algebra_read: tried with conditions of their
   callers; open in 3 s: conditions of mpz_cmp_ui, dyd_cert_poly_reduce (read_value), of scan_fraction and its loop
   invariant (read_bracket), reads after read_op or the first call (read_operation, read_number), conditions of
   read_number and dyd_cert_number_clear (dyd_cert_algebra_read). */
/* Without scan_coefficients: given a contract, but the run (150 s, for all of these) ended before its goals. */
#include "polys.h"

#include "base/alloc.h"
#include "base/error.h"

#define ITEM mpz_t
#define RESERVE reserve_numbers
#define ALLOC alloc_indices
#include "lists.h"

#undef mpz_inits
#define mpz_inits(a, b, c, d, end) (mpz_init(a), mpz_init(b), mpz_init(c), mpz_init(d))

/*@ requires 0 <= op < 29; assigns \nothing; exits \false; ensures string(\result); */
const char *dyd_cert_op_name(dyd_cert_op op);
/*@ requires \valid(out) && \valid_read(a) && a->count <= 4194304 && reads(in) && \separated(out, in, in->err);
    assigns in->at, in->line[0 .. in->cap - 1], *out, *in->err; exits \false;
    ensures \result == DYD_OK ==> *out < \old(a->count); */
static dyd_status read_operand(uint32_t *out, const dyd_cert_algebra *a, dyd_cert_reader *in);
/*@ requires \valid(op) && reads(in) && \separated(op, in, in->err, in->line + (0 .. in->cap - 1));
    assigns in->at, in->line[0 .. in->cap - 1], *op, *in->err; exits \false;
    ensures \result == DYD_OK ==> 0 <= *op < 29; */
static dyd_status read_op(dyd_cert_op *op, dyd_cert_reader *in);
/*@ requires \valid(num) && \valid(den) && whole(num) && whole(den) && line(text) &&
      \separated(num, den, text + (0 .. stop(text))); exits \false; */
static bool scan_fraction(mpz_ptr num, mpz_ptr den, char *text);
/*@ requires \valid_read(n) && \valid_read(in); assigns \nothing; exits \false; */
static bool has_value(const dyd_cert_number *n, const dyd_cert_reader *in);

#include "checker/algebra_read.c"
