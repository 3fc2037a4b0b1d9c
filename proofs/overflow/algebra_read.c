/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/checker/algebra_read.c: operands are numbers before, operations have names. */
/* Without read_value, read_operation, dyd_cert_algebra_read: they have no contracts; without, 11 of 19, 5 of 10 and
   2 of 8 goals are proved. Open: what dyd_cert_word, dyd_cert_poly_scan, read_op and read_operand require, reads of
   *a. */
/* Without read_bracket: without a contract 18 of 19 goals are proved. Open: the memory of a bracket is asked for in
   the name of a list of other things (_call_alloc_indices_requires). */
/* Without scan_coefficients: without a contract 15 of 26 goals are proved. Open: reads of the text and of the list. */
/* Without read_number: without a contract 1 of 9 goals is proved. */
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
