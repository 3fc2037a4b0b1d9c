/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Computable reals: a source of nested intervals and the narrowest one so far.
 *
 * [NEST-2] A built-in source encloses one and the same value every time; the intersection of two enclosures
 * encloses it too, so nestedness needs no trust. An empty intersection would disprove an enclosure: it is
 * reported as DYD_E_NESTING, never papered over. */
#include "stream/real.h"

#include "base/alloc.h"
#include "base/error.h"
#include "base/flag.h"
#include "base/invariant.h"
#include "base/local.h"
#include "rect/rect.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What every call of a source goes through: requests, invariants, nestedness and complete error records.
 *
 * [NEST-1] A rectangle is taken over only if it is a subset of the one before, decided exactly. */

/* Room for the guard bits that built-in sources add. */
#define GUARD 64

dyd_status dyd_request_make(dyd_request *out, size_t point, int64_t bits, int64_t max_bits, dyd_error *err) {
  int64_t limit = DYD_EXP_LIMIT - GUARD;
  if (bits > limit) {
    return dyd_fail(err, DYD_E_RANGE, "a width of 2^-%lld was asked for; the finest is 2^-%lld", (long long)bits,
                    (long long)limit);
  }
  if (bits < -limit) bits = -limit;
  if (max_bits > limit) max_bits = limit;
  if (max_bits < bits) max_bits = bits;
  *out = (dyd_request){DYD_SIZED(dyd_request), .point = point, .bits = bits, .max_bits = max_bits};
  return DYD_OK;
}

/* Two ends, old and new, and the least e with their distance below 2^e. */
typedef struct nest_ends {
  mpq_t end[2];
  bool low;
  int64_t e;
} nest_ends;

/* Finds the end by which `now` leaves `old` farther. */
static void nest_find(nest_ends *n, const dyd_interval *old, const dyd_interval *now) {
  DYD_LOCAL_NUMBERS(mpq, a, b, c, d);
  dyd_interval_get_q(a, b, old);
  dyd_interval_get_q(c, d, now);
  mpq_set(n->end[0], a);
  mpq_set(n->end[1], c);
  mpq_sub(a, a, c);
  mpq_sub(c, d, b);
  n->low = mpq_cmp(a, c) >= 0;
  if (!n->low) {
    mpq_set(n->end[0], b);
    mpq_set(n->end[1], d);
    mpq_swap(a, c);
  }
  n->e = 1 + (int64_t)mpz_sizeinbase(mpq_numref(a), 2) - (int64_t)mpz_sizeinbase(mpq_denref(a), 2);
}

/* Digits that distinguish the ends, three more than their leading bits have in common; at most NEST_DIGITS. */
enum { NEST_DIGITS = 4000, NEST_SHOWN = 72, NEST_EDGE = 16 };

/* The exponent e with |q| < 2^e; INT64_MIN for 0. */
static int64_t nest_top(mpq_srcptr q) {
  if (!mpq_sgn(q)) return INT64_MIN;
  return 1 + (int64_t)mpz_sizeinbase(mpq_numref(q), 2) - (int64_t)mpz_sizeinbase(mpq_denref(q), 2);
}

static int nest_digits(const nest_ends *n) {
  int64_t top = n->e;
  for (int k = 0; k < 2; k++)
    if (nest_top(n->end[k]) > top) top = nest_top(n->end[k]);
  int64_t digits = (top - n->e) * 31 / 100 + 3;
  return digits < 17 ? 17 : digits < NEST_DIGITS ? (int)digits : NEST_DIGITS;
}

/* Where they are long, most of the digits that both have are omitted. */
static void nest_show(char shown[2][NEST_SHOWN], const nest_ends *n) {
  static char const none[] = "(memory is exhausted)";
  const int digits = nest_digits(n);
  const size_t size = (size_t)digits + 32;
  DYD_FREED char *text = malloc(2 * size);
  mpf_t near;
  mpf_init2(near, (mp_bitcnt_t)digits * 4 + 64);
  for (int k = 0; text && k < 2; k++) {
    mpf_set_q(near, n->end[k]);
    gmp_snprintf(text + (size_t)k * size, size, "%.*Fg", digits, near);
  }
  mpf_clear(near);
  size_t same = 0;
  while (text && text[same] && text[same] == text[size + same]) same++;
  for (int k = 0; k < 2; k++) {
    const char *whole = text ? text + (size_t)k * size : none;
    if (strlen(whole) < NEST_SHOWN || same < 2 * NEST_EDGE)
      snprintf(shown[k], NEST_SHOWN, "%s", whole);
    else
      snprintf(shown[k], NEST_SHOWN, "%.*s...%.*s", NEST_EDGE, whole, NEST_EDGE, whole + same - 4);
  }
}

/* The shortest number m*2^e that the new interval has and the old one has not; "" where it is too long to be shown. */
static void nest_witness(char shown[NEST_SHOWN], const nest_ends *n) {
  enum { LONGEST = 160, SHORT = 20 };
  int64_t exp = nest_top(n->end[0]);
  if (nest_top(n->end[1]) > exp) exp = nest_top(n->end[1]);
  *shown = 0;
  if (exp - n->e > LONGEST) return;
  DYD_LOCAL_NUMBERS(mpq, at);
  DYD_LOCAL_NUMBERS(mpz, m);
  for (bool found = false; !found; exp--) {
    (exp < 0 ? mpq_mul_2exp : mpq_div_2exp)(at, n->end[1], (mp_bitcnt_t)(exp < 0 ? -exp : exp));
    (n->low ? mpz_cdiv_q : mpz_fdiv_q)(m, mpq_numref(at), mpq_denref(at));
    mpq_set_z(at, m);
    (exp < 0 ? mpq_div_2exp : mpq_mul_2exp)(at, at, (mp_bitcnt_t)(exp < 0 ? -exp : exp));
    const int side = mpq_cmp(at, n->end[0]);
    found = n->low ? side < 0 : side > 0;
    if (found && (exp == 0 || !mpz_sgn(m) || (exp > 0 && exp <= SHORT)))
      gmp_snprintf(shown, NEST_SHOWN, "%Zd", mpq_numref(at));
    else if (found)
      gmp_snprintf(shown, NEST_SHOWN, "%Zd*2^%lld", m, (long long)exp);
  }
}

dyd_status dyd_nesting_fail(dyd_error *err, const char *side, const dyd_interval *old, const dyd_interval *now) {
  char shown[2][NEST_SHOWN], witness[NEST_SHOWN];
  nest_ends n;
  mpq_inits(n.end[0], n.end[1], NULL);
  nest_find(&n, old, now);
  nest_show(shown, &n);
  nest_witness(witness, &n);
  mpq_clears(n.end[0], n.end[1], NULL);
  return dyd_fail(err, DYD_E_NESTING,
                  "the new %s %s %s is not inside the old one %s %s: its %s end is outside by less than 2^%lld%s%s; "
                  "each answer must be a subset of the one before",
                  side, n.low ? "from" : "up to", shown[1], n.low ? "from" : "up to", shown[0],
                  n.low ? "lower" : "upper", (long long)n.e, *witness ? ", only the new one has " : "", witness);
}

static dyd_status unset_fail(dyd_error *err, const char *what, size_t point, uint64_t stage) {
  char where[48] = "";
  if (point != DYD_NO_POINT) snprintf(where, sizeof where, " of point %zu", point);
  return dyd_fail(
      err, DYD_E_STREAM,
      "the callback returned DYD_OK at stage %llu without setting the %s%s; set it to an interval that holds "
      "the true value, or return an error",
      (unsigned long long)stage, what, where);
}

dyd_status dyd_rect_check_set(const dyd_rect *r, size_t point, uint64_t stage, dyd_error *err) {
  if (dyd_interval_is_unset(&r->x)) return unset_fail(err, "x side", point, stage);
  return dyd_interval_is_unset(&r->y) ? unset_fail(err, "y side", point, stage) : DYD_OK;
}

dyd_status dyd_nest(dyd_interval *next, const dyd_interval *old, bool encloses, const char *side, dyd_error *err) {
  if (!dyd_interval_is_valid(next))
    return dyd_fail(err, DYD_E_STREAM, "the callback gave no valid %s; fill it with dyd_interval_set_ends", side);
  if (!old || (!encloses && dyd_interval_contains(old, next))) return DYD_OK;
  dyd_status st = encloses ? dyd_interval_intersect(next, old, next) : DYD_E_ARG;
  if (st == DYD_E_ARG) return dyd_nesting_fail(err, side, old, next);
  return st == DYD_OK ? st : dyd_fail(err, st, "%s", dyd_status_text(st));
}

dyd_status dyd_callback_fail(dyd_error *err, const dyd_error *own, dyd_status st, size_t point, uint64_t stage) {
  bool known = dyd_failed(st) && st >= DYD_E_CONTRADICTION;
  dyd_status code = known ? st : DYD_E_STREAM;
  if (!err) return code;
  *err = *own;
  err->code = code;
  if (err->point == DYD_NO_POINT) err->point = point;
  err->stage = stage;
  if (!known) return dyd_fail(err, code, "the callback of the stream returned the unknown status %d", (int)st);
  if (!err->message[0]) return dyd_fail(err, code, "%s (the callback gave no message)", dyd_status_text(code));
  return code;
}

/* Invariant: refs > 0; now: NULL before the first narrowing, else owned and valid; final: known and no call can narrow
 * it; spans: the value lies in span; encloses. */
struct dyd_real {
  size_t refs;
  dyd_narrow_real_fn narrow; /* NULL for values fixed from the start */
  dyd_release_fn release;
  void *user;
  bool encloses, final, spans;
  unsigned char kind; /* a dyd_real_kind, of object */
  const void *object;
  dyd_real *claim; /* NULL, or what the value is, as the caller says */
  uint64_t stage;
  size_t line, column; /* 0: no place known */
  dyd_double_span span;
  dyd_interval *now;
};

/* `more` bytes follow the real. */
static dyd_status real_new(dyd_real **out, size_t more, dyd_narrow_real_fn narrow, dyd_release_fn release, void *user) {
  dyd_real *x = more > SIZE_MAX / 2 ? NULL : malloc(sizeof *x + more);
  if (!x) return DYD_E_NOMEM;
  *x = (dyd_real){.refs = 1, .narrow = narrow, .release = release, .user = user};
  *out = x;
  return DYD_OK;
}

dyd_status dyd_real_new(dyd_real **out, dyd_narrow_real_fn narrow, dyd_release_fn release, void *user) {
  dyd_status st = out && narrow ? real_new(out, 0, narrow, release, user) : DYD_E_ARG;
  if (st != DYD_OK && release) release(user);
  return st;
}

dyd_status dyd_real_new_enclosing(dyd_real **out, dyd_narrow_real_fn narrow, dyd_release_fn release, void *user) {
  dyd_status st = dyd_real_new(out, narrow, release, user);
  if (st == DYD_OK) (*out)->encloses = true;
  return st;
}

dyd_status dyd_real_new_inside(dyd_real **out, void **user, size_t size, dyd_narrow_real_fn narrow,
                               dyd_release_fn release) {
  dyd_status st = real_new(out, size, narrow, release, NULL);
  if (st != DYD_OK) return st;
  (*out)->user = *user = *out + 1;
  (*out)->encloses = true;
  return DYD_OK;
}

void dyd_real_set_span(dyd_real *x, dyd_double_span span) {
  DYD_INVARIANT(x->encloses && !x->now && span.lo <= span.hi);
  x->spans = true;
  x->span = span;
}

void *dyd_real_user(const dyd_real *x, dyd_narrow_real_fn narrow) {
  return x->narrow == narrow ? x->user : NULL;
}

void dyd_real_set_object(dyd_real *x, dyd_real_kind kind, const void *object) {
  x->kind = (unsigned char)kind;
  x->object = object;
}

dyd_real_kind dyd_real_object(const void **object, const dyd_real *x) {
  *object = x->object;
  return x->final && !dyd_interval_is_point(x->now) ? DYD_REAL_VAGUE : (dyd_real_kind)x->kind;
}

/* Makes room for an interval. */
static bool real_hold(dyd_real *x) {
  if (x->now) return true;
  x->now = dyd_alloc(1, sizeof *x->now);
  if (x->now) dyd_interval_init(x->now);
  return x->now;
}

/* A real that is final from the start; swaps *value into it. */
static dyd_status real_new_fixed(dyd_real **out, dyd_interval *value) {
  dyd_real *x;
  dyd_status st = real_new(&x, 0, NULL, NULL, NULL);
  if (st != DYD_OK) return st;
  if (!real_hold(x)) {
    free(x);
    return DYD_E_NOMEM;
  }
  dyd_interval_swap(x->now, value);
  x->final = true;
  DYD_INVARIANT(dyd_interval_is_valid(x->now));
  *out = x;
  return DYD_OK;
}

dyd_real *dyd_real_ref(dyd_real *x) {
  if (x) x->refs++;
  return x;
}

void dyd_real_free(dyd_real *x) {
  if (!x || --x->refs) return;
  if (x->release) x->release(x->user);
  dyd_real_free(x->claim);
  if (x->now) dyd_interval_clear(x->now);
  dyd_free_all(x->now, x);
}

const dyd_interval *dyd_real_interval(const dyd_real *x) {
  return x ? x->now : NULL;
}

bool dyd_real_is_final(const dyd_real *x) {
  return x ? x->final : false;
}

void dyd_real_place(dyd_real *x, size_t line, size_t column) {
  x->line = line;
  x->column = column;
}

/* next, made for `bits`, and the span, which comes rounded to the same grid where it is the shorter one: so all
 * intervals are inside of the glance for fewer bits, and as wide as without the span. */
static dyd_status real_cut_to_span(dyd_interval *next, dyd_double_span span, int64_t bits, dyd_error *err) {
  if (bits < 0) return DYD_OK;
  dyd_filter_round(&span, span, bits);
  DYD_LOCAL(dyd_interval, old);
  dyd_status st = dyd_interval_set_d(&old, span.lo, span.hi);
  return st == DYD_OK ? dyd_nest(next, &old, true, "interval", err) : dyd_fail(err, st, "%s", dyd_status_text(st));
}

/* Takes `next` over if it may follow; it becomes the interval now. */
static dyd_status real_accept(dyd_real *x, dyd_interval *next, dyd_error *err) {
  dyd_status st = dyd_nest(next, x->now, x->encloses, "interval", err);
  if (st != DYD_OK) return st;
  if (!real_hold(x)) return dyd_fail_nomem(err);
  dyd_interval_swap(x->now, next);
  return DYD_OK;
}

static dyd_status real_check_claim(dyd_real *claim, const dyd_interval *now, const dyd_request *request,
                                   dyd_error *err) {
  dyd_status st = dyd_real_narrow_until(claim, request->bits, request->max_bits, request->stop, err);
  if (dyd_narrow_ended(st)) return st;
  if (dyd_interval_meets(dyd_real_interval(claim), now)) return DYD_OK;
  return dyd_fail(err, DYD_E_NESTING, "the interval does not hold the root that the value is claimed to be");
}

dyd_status dyd_real_set_claim(dyd_real *x, dyd_real *claim, dyd_error *err) {
  const dyd_request request = {.bits = 64, .max_bits = 64};
  dyd_status st = DYD_OK;
  if (x->now) st = real_check_claim(claim, x->now, &request, err);
  if (st != DYD_OK) return st;
  x->claim = claim;
  x->kind = DYD_REAL_CLAIMED;
  x->object = claim;
  return DYD_OK;
}

static dyd_status real_call_source(dyd_real *x, const dyd_request *request, dyd_error *err) {
  dyd_error own;
  dyd_error_clear(&own);
  DYD_LOCAL(dyd_interval, next);
  if (x->now)
    dyd_interval_set(&next, x->now);
  else
    dyd_interval_unset(&next);
  dyd_status st = x->narrow(&next, x->user, request, &own);
  bool fixed = st == DYD_FIXED;
  if (fixed) st = DYD_OK;
  if (st == DYD_OK && dyd_interval_is_unset(&next)) st = unset_fail(&own, "interval", DYD_NO_POINT, x->stage);
  if (st == DYD_OK && x->spans) st = real_cut_to_span(&next, x->span, request->bits, &own);
  if (st == DYD_OK && x->claim) st = real_check_claim(x->claim, &next, request, &own);
  if (st == DYD_OK) st = real_accept(x, &next, &own);
  if (st == DYD_CANCELLED && dyd_flag_is_set(request->stop)) return st;
  if (st == DYD_OK) {
    x->final = fixed || dyd_interval_is_point(x->now);
  } else {
    st = dyd_callback_fail(err, &own, st, DYD_NO_POINT, x->stage);
  }
  x->stage++;
  return st;
}

/* Moves an error from the coordinate's own text to its place in the file. */
static void place_error(const dyd_real *x, dyd_error *err) {
  if (!err || !x->line) return;
  err->line = x->line;
  err->column = err->column ? err->column + x->column - 1 : x->column;
}

bool dyd_real_glance(dyd_double_span *out, const dyd_real *x, int64_t bits) {
  if (x->final) return dyd_interval_get_exact_d(&out->lo, &out->hi, x->now);
  return x->spans && !x->now && dyd_filter_round(out, x->span, bits);
}

int64_t dyd_real_glance_bits(const dyd_real *x) {
  dyd_double_span exact;
  if (x->final) return dyd_interval_get_exact_d(&exact.lo, &exact.hi, x->now) ? INT64_MAX : INT64_MIN;
  return x->spans && !x->now ? dyd_filter_bits(x->span) : INT64_MIN;
}

/* A span this short, rounded to the grid for `bits`, very likely gives one step of it, as it does with balls. */
#define SPARE 16

static bool span_is_short(const dyd_real *x, int64_t bits) {
  int64_t most = dyd_filter_bits(x->span);
  return most >= SPARE && bits <= most - SPARE;
}

/* Narrows to what the span gives for `bits`. */
static dyd_status real_take_span(dyd_real *x, dyd_double_span span, dyd_error *err) {
  DYD_LOCAL(dyd_interval, next);
  dyd_status st = dyd_interval_set_d(&next, span.lo, span.hi);
  st = st == DYD_OK ? real_accept(x, &next, err) : dyd_fail(err, st, "%s", dyd_status_text(st));
  if (st == DYD_OK) x->final = dyd_interval_is_point(x->now);
  return st;
}

dyd_status dyd_real_narrow(dyd_real *x, int64_t bits, int64_t max_bits, dyd_error *err) {
  return x ? dyd_real_narrow_until(x, bits, max_bits, NULL, err) : dyd_fail_null(err);
}

dyd_status dyd_real_narrow_until(dyd_real *x, int64_t bits, int64_t max_bits, const volatile int *stop,
                                 dyd_error *err) {
  dyd_request request;
  dyd_double_span span;
  if (x->final) return DYD_FIXED;
  if (x->now && dyd_interval_bits(x->now) >= bits) return DYD_OK;
  dyd_status st = dyd_request_make(&request, 0, bits, max_bits, err);
  request.stop = stop;
  if (st == DYD_OK && x->spans && span_is_short(x, request.bits) && dyd_filter_round(&span, x->span, request.bits))
    st = real_take_span(x, span, err);
  else if (st == DYD_OK)
    st = real_call_source(x, &request, err);
  if (st != DYD_OK) {
    place_error(x, err);
    return st;
  }
  return x->final ? DYD_FIXED : DYD_OK;
}

/* Reals known from the start, and reals widened by a radius. */

/* A real of the interval a, just set with status st; a goes. */
static dyd_status real_take_interval(dyd_real **out, dyd_interval *a, dyd_status st) {
  if (st == DYD_OK) st = real_new_fixed(out, a);
  dyd_interval_clear(a);
  return st;
}

dyd_status dyd_real_from_q(dyd_real **out, const mpq_t q) {
  dyd_interval a;
  dyd_interval_init(&a);
  return real_take_interval(out, &a, dyd_interval_set_q(&a, q));
}

/* Exact when dyadic, else rounded to a multiple of 2^exp. */
static dyd_status fixed_end(dyd_dyadic *out, const mpq_t q, int64_t exp, dyd_round dir) {
  size_t two = mpz_scan1(mpq_denref(q), 0);
  if (mpz_sizeinbase(mpq_denref(q), 2) == two + 1) return dyd_dyadic_set_z_2exp(out, mpq_numref(q), -(int64_t)two);
  return dyd_dyadic_round_q(out, q, exp, dir);
}

dyd_status dyd_real_from_interval(dyd_real **out, const mpq_t lo, const mpq_t hi) {
  dyd_interval a;
  dyd_interval_init(&a);
  return real_take_interval(out, &a, dyd_interval_set_ends_q(&a, lo, hi));
}

/* The interval of radius `radius` around x. */
typedef struct widened {
  dyd_real *x;
  mpq_t radius;
} widened;

static void widened_release(void *user) {
  widened *w = user;
  dyd_real_free(w->x);
  mpq_clear(w->radius);
  free(w);
}

/* radius becomes the sum of the radii around x. */
static void real_radius(mpq_t radius, const dyd_real *x);

/* By how much more than the radius an interval of x that is not final is widened, on the grid of 2^exp [DISC-4]. */
static void widened_margin(mpq_t out, const dyd_real *x, const mpq_t lo, const mpq_t hi, int64_t exp) {
  DYD_LOCAL_NUMBERS(mpq, radius);
  real_radius(radius, x);
  mpq_sub(out, hi, lo);
  mpq_sub(out, out, radius);
  mpq_sub(out, out, radius);
  mpq_div_2exp(out, out, 2);
  mpq_set_ui(radius, 1, 1);
  (exp < 0 ? mpq_div_2exp : mpq_mul_2exp)(radius, radius, (mp_bitcnt_t)(exp < 0 ? -exp : exp));
  mpq_add(out, out, radius);
}

/* out = the interval of w->x, widened; fixed once and for all when x is final, else on the grid of 2^exp. */
static dyd_status widened_interval(dyd_interval *out, const widened *w, int64_t exp) {
  const bool final = dyd_real_is_final(w->x);
  DYD_LOCAL_NUMBERS(mpq, lo, hi, more);
  dyd_interval_get_q(lo, hi, dyd_real_interval(w->x));
  if (!final) widened_margin(more, w->x, lo, hi, exp);
  mpq_add(more, more, w->radius);
  mpq_sub(lo, lo, more);
  mpq_add(hi, hi, more);
  return final ? dyd_interval_set_ends_q(out, lo, hi) : dyd_interval_set_outward(out, lo, hi, exp);
}

static dyd_status widened_narrow(dyd_interval *out, void *user, const dyd_request *request, dyd_error *err) {
  widened *w = user;
  dyd_status st = dyd_real_narrow_until(w->x, request->bits + 3, request->max_bits + 3, request->stop, err);
  if (dyd_narrow_ended(st)) return st;
  st = widened_interval(out, w, -request->bits - 3);
  if (st != DYD_OK) return dyd_fail(err, st, "the interval around a value: %s", dyd_status_text(st));
  return dyd_real_is_final(w->x) ? DYD_FIXED : DYD_OK;
}

dyd_status dyd_real_widen(dyd_real **out, dyd_real *x, const mpq_t radius) {
  if (!x) return DYD_E_ARG;
  if (mpq_sgn(radius) == 0) {
    *out = x;
    return DYD_OK;
  }
  widened *w = mpq_sgn(radius) > 0 ? dyd_alloc(1, sizeof *w) : NULL;
  if (!w) {
    dyd_real_free(x);
    return mpq_sgn(radius) > 0 ? DYD_E_NOMEM : DYD_E_ARG;
  }
  w->x = x;
  mpq_init(w->radius);
  mpq_set(w->radius, radius);
  if (!dyd_real_is_final(x)) {
    dyd_status st = dyd_real_new_enclosing(out, widened_narrow, widened_release, w);
    if (st == DYD_OK) dyd_real_set_object(*out, DYD_REAL_VAGUE, NULL);
    return st;
  }
  dyd_interval a; /* final already: one fixed interval */
  dyd_interval_init(&a);
  dyd_status st = real_take_interval(out, &a, widened_interval(&a, w, 0));
  widened_release(w);
  return st;
}

static void real_radius(mpq_t radius, const dyd_real *x) {
  mpq_set_ui(radius, 0, 1);
  for (const widened *w; (w = dyd_real_user(x, widened_narrow)); x = w->x) mpq_add(radius, radius, w->radius);
}

const dyd_real *dyd_real_centre(const dyd_real *x) {
  for (const widened *w; (w = dyd_real_user(x, widened_narrow));) x = w->x;
  return x;
}

void dyd_real_radius(mpq_t radius, const dyd_real *x) {
  real_radius(radius, x);
  if (!dyd_real_is_final(x)) return;
  DYD_LOCAL_NUMBERS(mpq, lo);
  dyd_interval_get_q(lo, radius, dyd_real_interval(x));
  mpq_sub(radius, radius, lo);
  mpq_div_2exp(radius, radius, 1);
}

bool dyd_real_reaches(const dyd_real *x, const dyd_interval *now, int64_t bits) {
  if (dyd_real_is_final(x)) return true;
  DYD_LOCAL_NUMBERS(mpq, lo, hi, most, radius);
  dyd_interval_get_q(lo, hi, now);
  mpq_set_ui(most, 1, 1);
  (bits >= 0 ? mpq_div_2exp : mpq_mul_2exp)(most, most, (mp_bitcnt_t)(bits >= 0 ? bits : -bits));
  real_radius(radius, x);
  mpq_add(most, most, radius);
  mpq_add(most, most, radius);
  mpq_sub(hi, hi, lo);
  return mpq_cmp(hi, most) <= 0;
}

/* [lo,hi] rounded inward by less than a quarter of `slack`; *has: something is left. */
static dyd_status interval_set_inward(dyd_interval *out, bool *has, const mpq_t lo, const mpq_t hi, const mpq_t slack) {
  DYD_LOCAL(dyd_dyadic, l, h);
  int64_t exp = (int64_t)mpz_sizeinbase(mpq_numref(slack), 2) - (int64_t)mpz_sizeinbase(mpq_denref(slack), 2) - 3;
  dyd_status st = fixed_end(&l, lo, exp, DYD_UP);
  if (st == DYD_OK) st = fixed_end(&h, hi, exp, DYD_DOWN);
  *has = st == DYD_OK && dyd_dyadic_cmp(&l, &h) <= 0;
  if (*has) st = dyd_interval_set_ends(out, &l, &h);
  return st;
}

/* Twice the radius away from each end: every interval of x holds those within the radius of some place, and this
 * place is no nearer to the ends of `now` than the radius [SET-3]. */
static dyd_status widened_core(dyd_interval *core, bool *has, const mpq_t radius, const dyd_interval *now) {
  dyd_status st = DYD_OK;
  DYD_LOCAL_NUMBERS(mpq, lo, hi, slack);
  dyd_interval_get_q(lo, hi, now);
  mpq_sub(slack, hi, lo);
  for (int k = 0; k < 2; k++) {
    mpq_sub(slack, slack, radius);
    mpq_sub(hi, hi, radius);
    mpq_add(lo, lo, radius);
  }
  *has = mpq_sgn(slack) >= 0 && mpq_cmp(hi, lo) <= 0;
  if (mpq_sgn(slack) == 0) mpq_div_2exp(slack, radius, 64);
  if (*has) st = interval_set_inward(core, has, hi, lo, slack);
  return st;
}

dyd_status dyd_real_core(dyd_interval *core, bool *has, const dyd_real *x, const dyd_interval *now) {
  *has = dyd_real_is_final(x);
  if (*has) {
    dyd_interval_set(core, dyd_real_interval(x));
    return DYD_OK;
  }
  dyd_status st = DYD_OK;
  DYD_LOCAL_NUMBERS(mpq, radius);
  real_radius(radius, x);
  if (now && mpq_sgn(radius) > 0) st = widened_core(core, has, radius, now);
  return st;
}
