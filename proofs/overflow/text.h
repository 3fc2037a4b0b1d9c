/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Contracts for src/dyadic/text.c, put in front of its functions: texts are of any bytes. */

typedef const dyd_numeral *numeral;

/*@ predicate holds(chars text, integer length) = 0 <= length <= 1152921504606846976 &&
      \valid_read(text + (0 .. length - 1));
    predicate small(integer e, integer most) = -most <= e <= most;
    predicate read(numeral n, integer length) = \valid(n) && holds(n->text, length) &&
      n->first <= n->mantissa_end <= n->end <= length && n->digits <= n->mantissa_end - n->first &&
      n->fraction <= n->mantissa_end - n->first && small(n->exponent, 10995116277769) &&
      small(n->two, 10995116277769) && (n->few ==> n->man < 1152921504606846976);
    predicate beside(numeral n, chars text, integer length) = \separated(n, text + (0 .. length - 1)); */

/*@ assigns \nothing; exits \false; ensures 0 <= \result <= 16; */
static unsigned text_hex(char c);
/*@ requires \valid(man) && holds(text, length) && pos <= length && \separated(man, text + (0 .. length - 1));
    assigns *man; exits \false; ensures pos <= \result <= length; */
static size_t text_hex_digits(uint64_t *man, const char *text, size_t length, size_t pos);
/*@ requires \valid(man) && holds(text, length) && pos <= length && \separated(man, text + (0 .. length - 1));
    assigns *man; exits \false; ensures pos <= \result <= length; */
static size_t text_digits(uint64_t *man, const char *text, size_t length, size_t pos, bool hex);
/*@ requires \valid(out) && \valid(pos) && holds(text, length) && *pos <= length &&
      \separated(out, pos, text + (0 .. length - 1));
    assigns *out, *pos; exits \false; ensures \old(*pos) <= *pos <= length && small(*out, 10995116277769); */
static bool text_exponent(int64_t *out, const char *text, size_t length, size_t *pos);
/*@ requires \valid_read(n) && holds(n->text, n->mantissa_end) && n->first <= n->mantissa_end;
    assigns \nothing; exits \false; */
static bool text_is_few(const dyd_numeral *n, size_t most);
/*@ requires holds(text, length) && pos <= length; assigns \nothing; exits \false;
    ensures \result ==> pos + 2 < length; */
static bool text_starts_hex(const char *text, size_t length, size_t pos);
/*@ requires read(n, length) && n->end < length && beside(n, n->text, length);
    assigns n->exponent, n->end, n->integer; exits \false; ensures read(n, length) && n->text == \old(n->text); */
static void text_scale(dyd_numeral *n, size_t length);
/*@ requires \valid(n) && holds(text, length) && pos <= length && beside(n, text, length);
    assigns *n; exits \false; ensures n->text == text && pos <= n->end <= length; ensures \result ==> read(n, length); */
static bool text_literal(dyd_numeral *n, const char *text, size_t length, size_t pos, unsigned forms);
/*@ requires \valid(n) && holds(text, length) && pos <= length && beside(n, text, length);
    assigns *n; exits \false; ensures n->text == text && pos <= n->end <= length; ensures \result ==> read(n, length); */
bool dyd_literal_scan(dyd_numeral *n, const char *text, size_t length, size_t pos, unsigned forms);
/*@ requires read(n, length) && beside(n, n->text, length);
    assigns n->below, n->end, n->two, n->twos; exits \false; ensures read(n, length) && n->text == \old(n->text); */
static bool text_suffix(dyd_numeral *n, size_t length, unsigned forms);
/*@ requires \valid(n) && holds(text, length) && beside(n, text, length);
    assigns *n; exits \false; ensures n->end <= length; ensures \result ==> read(n, length) && n->text == text; */
bool dyd_numeral_scan(dyd_numeral *n, const char *text, size_t length, unsigned forms);
/*@ requires \valid(out) && holds(text, length) && \separated(out, text + (0 .. length - 1));
    assigns *out; exits \false; */
bool dyd_integer_scan(int64_t *out, const char *text, size_t length, unsigned signs, int64_t least, int64_t most);
/*@ requires \valid(out) && whole(out) && \valid_read(n) && holds(n->text, n->mantissa_end) &&
      n->first <= n->mantissa_end;
    assigns *out; exits \false; ensures whole(out); */
dyd_status dyd_numeral_digits(mpz_ptr out, const dyd_numeral *n);
/*@ requires \valid(out) && dyadic(out) && \valid(man) && whole(man) && \separated(out, man) &&
      small(exp2, 4611708008659943442) && small(exp10, 1152932499723124745);
    assigns *out, *man; exits \false; ensures dyadic(out) && whole(man); */
static dyd_status text_value(dyd_dyadic *out, mpz_ptr man, int64_t exp2, int64_t exp10);
/*@ requires err == \null || \valid(err); assigns *err; exits \false; ensures \result == st; */
static dyd_status text_refuse(dyd_error *err, dyd_status st, size_t column, const char *what);
/*@ requires \valid(out) && dyadic(out) && string(text) &&
      (err == \null || \valid(err) && \separated(err, out, text + (0 .. stop(text)))) &&
        \separated(out, text + (0 .. stop(text)));
    exits \false; */
dyd_status dyd_dyadic_set_str(dyd_dyadic *out, const char *text, dyd_error *err);
/*@ requires dyadic(x); exits \false; */
char *dyd_dyadic_get_str(const dyd_dyadic *x);
