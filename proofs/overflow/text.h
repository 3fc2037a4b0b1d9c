/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/dyadic/text.c, put behind its struct reader. */

typedef const reader *reading;

/*@ predicate reads(reading r) = \valid(r) && \valid_read(r->text + (0 .. LENGTH)) && r->text[LENGTH] == 0 &&
      \subset(r->at, r->text + (0 .. LENGTH)) && \valid(r->digits + (0 .. LENGTH)) &&
      0 <= r->count <= r->at - r->text && \separated(r, r->text + (0 .. LENGTH), r->digits + (0 .. LENGTH));
    predicate small(integer e, integer most) = -most <= e <= most; */

/*@ assigns \nothing; exits \false; ensures \result ==> c != 0; */
static bool text_is_blank(char c);
/*@ assigns \nothing; exits \false; ensures \result ==> c != 0; ensures \result && base == 10 ==> '0' <= c <= '9'; */
static bool text_is_digit(char c, int base);
/*@ requires reads(r); assigns r->at, r->count, r->digits[0 .. LENGTH]; exits \false; ensures reads(r);
    ensures \old(r->count) <= r->count && 0 <= r->at - \old(r->at); */
static void text_read_digits(reader *r, int base);
/*@ requires reads(r) && \valid(out) && \separated(out, r, r->text + (0 .. LENGTH), r->digits + (0 .. LENGTH)) ||
      (reads(r) && (out == &r->exp2 || out == &r->exp10));
    assigns r->at, *out; exits \false; ensures reads(r);
    ensures \result ==> small(*out, 10995116277769); */
static bool text_read_exponent(reader *r, int64_t *out);
/*@ requires reads(r) && r->count == 0 && \valid(fraction) &&
      \separated(fraction, r, r->text + (0 .. LENGTH), r->digits + (0 .. LENGTH));
    assigns r->at, r->count, r->digits[0 .. LENGTH], *fraction; exits \false; ensures reads(r);
    ensures 0 <= r->at - \old(r->at) && (\result ==> 0 <= *fraction <= LENGTH); */
static bool text_read_mantissa(reader *r, int base, int64_t *fraction);
/*@ requires reads(r) && 0 <= fraction <= LENGTH && r->exp2 == 0 && r->exp10 == 0;
    assigns r->at, r->exp2, r->exp10; exits \false; ensures reads(r);
    ensures \result ==> small(r->exp2, 4611697013544457473) && small(r->exp10, 1152932499723124745); */
static bool text_read_suffix(reader *r, int base, int64_t fraction, bool pointed);
/*@ requires reads(r) && r->at == r->text && r->count == 0 && r->exp2 == 0 && r->exp10 == 0 && \valid(base) &&
      \valid(negative) && \separated(base, negative, r, r->text + (0 .. LENGTH), r->digits + (0 .. LENGTH));
    assigns r->at, r->count, r->exp2, r->exp10, r->digits[0 .. LENGTH], *base, *negative; exits \false;
    ensures reads(r);
    ensures \result ==> *base == 10 || *base == 16;
    ensures \result ==> small(r->exp2, 4611697013544457473) && small(r->exp10, 1152932499723124745); */
static bool text_read(reader *r, int *base, bool *negative);
/*@ requires \valid(out) && dyadic(out) && \valid(man) && whole(man) && \separated(out, man) &&
      small(exp2, 4611697013544457473) && small(exp10, 1152932499723124745);
    assigns *out, *man; exits \false; ensures dyadic(out) && whole(man); */
static dyd_status text_value(dyd_dyadic *out, mpz_ptr man, int64_t exp2, int64_t exp10);
/*@ requires err == \null || \valid(err); assigns *err; exits \false; ensures \result == st; */
static dyd_status text_refuse(dyd_error *err, dyd_status st, size_t column, const char *what);
/*@ requires \valid(out) && dyadic(out) && ends(text, LENGTH) && (\forall integer k;
    0 <= k < LENGTH ==> text[k] != 0) &&
      (err == \null || \valid(err) && \separated(err, out, text + (0 .. LENGTH))) &&
        \separated(out, text + (0 .. LENGTH));
    exits \false; */
/* That out is a dyadic again is asserted at the ends of both branches (overflow.py): CVC4 does not join them. */
dyd_status dyd_dyadic_set_str(dyd_dyadic *out, const char *text, dyd_error *err);
/*@ requires dyadic(x); exits \false; */
char *dyd_dyadic_get_str(const dyd_dyadic *x);
