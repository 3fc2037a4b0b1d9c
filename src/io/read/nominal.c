/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Points by their nominal coordinates: a hash table of texts that are equal exactly when the numbers are.
 *
 * The text of a decimal m * 10^k, 10 not dividing m, is "mek"; that of another rational is "p/q" in lowest terms. */
#include "io/read/nominal.h"

#include "base/alloc.h"
#include "io/read/coordinate.h"
#include <dyadel/stream.h>
#include <inttypes.h>
#include <string.h>

void dyd_nominals_clear(dyd_nominals *n) {
  free(n->item);
  free(n->slot);
  free(n->text);
  *n = (dyd_nominals){0};
}

static bool key_put(dyd_nominals *n, const char *text, size_t length) {
  if (!dyd_reserve((void **)&n->text, &n->text_cap, n->used + length + 1, 1)) return false;
  memcpy(n->text + n->used, text, length);
  n->used += length;
  return true;
}

/* ---- one coordinate ---- */

static bool key_put_plain(dyd_nominals *n, dyd_plain p) {
  char text[48];
  for (; p.man && p.man % 10 == 0; p.exp++) p.man /= 10;
  int length = snprintf(text, sizeof text, "%" PRId64 "e%d ", p.man, p.man ? p.exp : 0);
  return key_put(n, text, (size_t)length);
}

/* Is q the decimal *out? */
static bool plain_of_rational(dyd_plain *out, const mpq_t q) {
  mpz_t den, man;
  dyd_plain p = {0, 0};
  mpz_init_set(den, mpq_denref(q));
  mpz_init_set(man, mpq_numref(q));
  for (; p.exp > -60 && mpz_divisible_ui_p(den, 10); p.exp--) mpz_divexact_ui(den, den, 10);
  for (; p.exp > -60 && mpz_divisible_ui_p(den, 5); p.exp--) mpz_divexact_ui(den, den, 5), mpz_mul_ui(man, man, 2);
  for (; p.exp > -60 && mpz_divisible_ui_p(den, 2); p.exp--) mpz_divexact_ui(den, den, 2), mpz_mul_ui(man, man, 5);
  for (; mpz_sgn(man) && p.exp < 60 && mpz_divisible_ui_p(man, 10); p.exp++) mpz_divexact_ui(man, man, 10);
  bool good =
      mpz_cmp_ui(den, 1) == 0 && p.exp >= -60 && mpz_fits_slong_p(man) && mpz_cmpabs_ui(man, 1000000000000000000) < 0;
  if (good) *out = (dyd_plain){mpz_get_si(man), p.exp};
  mpz_clear(den);
  mpz_clear(man);
  return good;
}

static dyd_status key_put_rational(dyd_nominals *n, const mpq_t q) {
  dyd_plain plain;
  if (plain_of_rational(&plain, q)) return key_put_plain(n, plain) ? DYD_OK : DYD_E_NOMEM;
  size_t most = mpz_sizeinbase(mpq_numref(q), 10) + mpz_sizeinbase(mpq_denref(q), 10) + 4;
  if (!dyd_reserve((void **)&n->text, &n->text_cap, n->used + most, 1)) return DYD_E_NOMEM;
  mpq_get_str(n->text + n->used, 10, q);
  n->used += strlen(n->text + n->used);
  n->text[n->used++] = ' ';
  return DYD_OK;
}

/* Where a radius begins, or the end of the text. */
static size_t nominal_length(const dyd_span *s) {
  int depth = 0;
  for (size_t k = 0; k + 1 < s->length; k++) {
    const char *p = s->text + k;
    depth += (*p == '(') - (*p == ')');
    if (!depth && (memcmp(p, "+-", 2) == 0 || memcmp(p, "\xC2\xB1", 2) == 0)) return k;
  }
  return s->length;
}

/* The middle of "[a,b]". */
static dyd_status parse_middle(mpq_t out, const char *text, size_t length) {
  const char *end = text + length, *comma = text;
  mpq_t other;
  int depth = 0;
  for (; comma < end && (*comma != ',' || depth != 1); comma++)
    depth += (*comma == '(' || *comma == '[') - (*comma == ')' || *comma == ']');
  if (comma == end || end[-1] != ']') return DYD_E_PARSE;
  mpq_init(other);
  dyd_status st = dyd_real_parse_exact(out, text + 1, (size_t)(comma - text) - 1);
  if (st == DYD_OK) st = dyd_real_parse_exact(other, comma + 1, (size_t)(end - comma) - 2);
  if (st == DYD_OK) mpq_add(out, out, other);
  if (st == DYD_OK) mpq_div_2exp(out, out, 1);
  mpq_clear(other);
  return st;
}

static dyd_status key_put_coordinate(dyd_nominals *n, const dyd_span *s) {
  size_t length = nominal_length(s);
  dyd_plain plain;
  if (dyd_plain_scan(&plain, s->text, length)) return key_put_plain(n, plain) ? DYD_OK : DYD_E_NOMEM;
  mpq_t q;
  mpq_init(q);
  dyd_status st = s->text[0] == '[' ? parse_middle(q, s->text, length) : dyd_real_parse_exact(q, s->text, length);
  if (st == DYD_OK)
    st = key_put_rational(n, q);
  else if (st != DYD_E_NOMEM)
    st = key_put(n, s->text, length) && key_put(n, " ", 1) ? DYD_OK : DYD_E_NOMEM;
  mpq_clear(q);
  return st;
}

/* ---- the table ---- */

/* FNV-1a, with its high half stirred in, as slots are taken by low bits. */
static uint64_t hash_text(const char *text, size_t length) {
  uint64_t h = UINT64_C(14695981039346656037);
  for (size_t k = 0; k < length; k++) h = (h ^ (unsigned char)text[k]) * UINT64_C(1099511628211);
  return h ^ h >> 32;
}

/* The slot of the key, or the free one where it belongs. */
static size_t *slot_find(const dyd_nominals *n, uint64_t hash, const char *key, size_t length) {
  for (size_t k = (size_t)hash & (n->slots - 1);; k = (k + 1) & (n->slots - 1)) {
    if (!n->slot[k]) return &n->slot[k];
    const dyd_nominal *i = &n->item[n->slot[k] - 1];
    if (i->hash == hash && i->length == length && memcmp(n->text + i->text, key, length) == 0) return &n->slot[k];
  }
}

static bool slots_grow(dyd_nominals *n) {
  if (n->slots && n->slots / 3 * 2 > n->count) return true;
  size_t slots = n->slots ? 2 * n->slots : 1024;
  size_t *slot = calloc(slots, sizeof *slot);
  if (!slot) return false;
  free(n->slot);
  n->slot = slot;
  n->slots = slots;
  for (size_t k = 0; k < n->count; k++) {
    const dyd_nominal *i = &n->item[k];
    *slot_find(n, i->hash, n->text + i->text, i->length) = k + 1;
  }
  return true;
}

dyd_status dyd_nominals_find(dyd_nominal **out, dyd_nominals *n, const dyd_span span[2]) {
  size_t begin = n->used;
  dyd_status st = key_put_coordinate(n, &span[0]);
  if (st == DYD_OK) st = key_put_coordinate(n, &span[1]);
  if (st == DYD_OK && (!slots_grow(n) || !dyd_reserve((void **)&n->item, &n->cap, n->count + 1, sizeof *n->item)))
    st = DYD_E_NOMEM;
  if (st != DYD_OK) return st;
  size_t length = n->used - begin;
  uint64_t hash = hash_text(n->text + begin, length);
  size_t *slot = slot_find(n, hash, n->text + begin, length);
  if (*slot)
    n->used = begin;
  else
    n->item[n->count++] = (dyd_nominal){.hash = hash, .text = begin, .length = length};
  if (!*slot) *slot = n->count;
  *out = &n->item[*slot - 1];
  (*out)->count++;
  return DYD_OK;
}
