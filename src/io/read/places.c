/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Points are equal by their nominal coordinates. A hash table holds texts that are equal exactly if the numbers are:
 * "mek" for a decimal m * 10^k where 10 does not divide m, "p/q" in lowest terms for another rational. */
#include "io/read/places.h"

#include "base/alloc.h"
#include "base/digest.h"
#include "base/local.h"

#include <inttypes.h>
#include <string.h>

void dyd_places_clear(dyd_places *n) {
  dyd_free_all(n->item, n->slot, n->text);
  *n = (dyd_places){0};
}

size_t dyd_places_bytes(const dyd_places *n) {
  return n->count * sizeof *n->item + n->slots * sizeof *n->slot + n->used;
}

static bool key_put(dyd_places *n, const char *text, size_t length) {
  if (!dyd_reserve((void **)&n->text, &n->text_cap, n->used + length + 1, 1)) return false;
  memcpy(n->text + n->used, text, length);
  n->used += length;
  return true;
}

static bool key_put_plain(dyd_places *n, dyd_plain p) {
  char text[48];
  for (; p.man && p.man % 10 == 0; p.exp++) p.man /= 10;
  int length = snprintf(text, sizeof text, "%" PRId64 "e%d ", p.man, p.man ? p.exp : 0);
  return key_put(n, text, (size_t)length);
}

/* Divides z, not 0, by p as often as it goes; returns how often. Short numbers are divided one digit after the other.
 */
static mp_bitcnt_t take_out(mpz_ptr z, unsigned long p) {
  enum { SHORT = 4 };
  mp_bitcnt_t times = 0;
  if (mpz_size(z) <= SHORT) {
    for (; mpz_divisible_ui_p(z, p); times++) mpz_divexact_ui(z, z, p);
    return times;
  }
  mpz_t factor;
  mpz_init_set_ui(factor, p);
  times = mpz_remove(z, z, factor);
  mpz_clear(factor);
  return times;
}

/* Destroys q, which is man / den * 10^ten with den coprime to 10 and man not divisible by 10: "mek" or "p/qek". */
static dyd_status key_put_rational(dyd_places *n, mpq_t q) {
  mpz_ptr man = mpq_numref(q), den = mpq_denref(q);
  DYD_LOCAL_NUMBERS(mpz, factor);
  mp_bitcnt_t twos = mpz_scan1(den, 0);
  mpz_tdiv_q_2exp(den, den, twos);
  mp_bitcnt_t fives = take_out(den, 5);
  int64_t ten = -(int64_t)(twos > fives ? twos : fives);
  mpz_ui_pow_ui(factor, twos > fives ? 5 : 2, twos > fives ? twos - fives : fives - twos);
  mpz_mul(man, man, factor);
  ten = mpz_sgn(man) ? ten + (int64_t)take_out(man, 10) : 0;
  size_t most = mpz_sizeinbase(man, 10) + mpz_sizeinbase(den, 10) + 32;
  if (!dyd_reserve((void **)&n->text, &n->text_cap, n->used + most, 1)) return DYD_E_NOMEM;
  char *to = n->text + n->used;
  n->used += (size_t)(mpz_cmp_ui(den, 1) ? gmp_snprintf(to, most, "%Zd/%Zde%" PRId64 " ", man, den, ten)
                                         : gmp_snprintf(to, most, "%Zde%" PRId64 " ", man, ten));
  return DYD_OK;
}

static dyd_status key_put_coordinate(dyd_places *n, const dyd_span *s) {
  size_t length = dyd_nominal_length(s);
  dyd_plain plain;
  if (dyd_plain_scan(&plain, s->text, length)) return key_put_plain(n, plain) ? DYD_OK : DYD_E_NOMEM;
  DYD_LOCAL_NUMBERS(mpq, lo, hi);
  dyd_status st = dyd_coordinate_ends(lo, hi, s, NULL);
  mpq_add(lo, lo, hi);
  mpq_div_2exp(lo, lo, 1);
  if (st == DYD_OK)
    st = key_put_rational(n, lo);
  else if (st != DYD_E_NOMEM)
    st = key_put(n, s->text, length) && key_put(n, " ", 1) ? DYD_OK : DYD_E_NOMEM;
  return st;
}

/* The digest with its high half stirred in, as slots are taken by low bits. */
static uint64_t hash_text(const char *text, size_t length) {
  uint64_t h = dyd_digest(DYD_DIGEST_BEGIN, text, length);
  return h ^ h >> 32;
}

/* The slot of the key, or the free one where it belongs; key = NULL: it is new. */
static dyd_place_slot *slot_find(const dyd_places *n, uint64_t hash, const char *key, size_t length) {
  for (size_t k = (size_t)hash & (n->slots - 1);; k = (k + 1) & (n->slots - 1)) {
    dyd_place_slot *s = &n->slot[k];
    if (!s->item) return s;
    if (!key || s->tag != (uint32_t)(hash >> 32)) continue;
    const dyd_place *i = &n->item[s->item - 1];
    if (i->hash == hash && i->length == length && memcmp(n->text + i->text, key, length) == 0) return s;
  }
}

static bool slots_grow(dyd_places *n) {
  if (n->slots && n->slots / 3 * 2 > n->count) return true;
  size_t slots = n->slots ? 2 * n->slots : 1024;
  dyd_place_slot *slot = n->count < UINT32_MAX ? calloc(slots, sizeof *slot) : NULL;
  if (!slot) return false;
  free(n->slot);
  n->slot = slot;
  n->slots = slots;
  for (size_t k = 0; k < n->count; k++) {
    uint64_t hash = n->item[k].hash;
    *slot_find(n, hash, NULL, 0) = (dyd_place_slot){(uint32_t)k + 1, (uint32_t)(hash >> 32)};
  }
  return true;
}

/* The item of the key that ends the text, begun at `begin`, with its count raised by 1. */
static dyd_status places_count(dyd_place **out, dyd_places *n, size_t begin) {
  if (!slots_grow(n) || !DYD_GROW(n->item, n->cap, n->count + 1)) return DYD_E_NOMEM;
  size_t length = n->used - begin;
  uint64_t hash = hash_text(n->text + begin, length);
  dyd_place_slot *slot = slot_find(n, hash, n->text + begin, length);
  if (slot->item) {
    n->used = begin;
  } else {
    n->item[n->count++] = (dyd_place){.hash = hash, .text = begin, .length = length};
    *slot = (dyd_place_slot){(uint32_t)n->count, (uint32_t)(hash >> 32)};
  }
  *out = &n->item[slot->item - 1];
  (*out)->count++;
  return DYD_OK;
}

dyd_status dyd_places_find(dyd_place **out, dyd_places *n, const dyd_span span[2]) {
  size_t begin = n->used;
  dyd_status st = key_put_coordinate(n, &span[0]);
  if (st == DYD_OK) st = key_put_coordinate(n, &span[1]);
  return st == DYD_OK ? places_count(out, n, begin) : st;
}

dyd_status dyd_places_find_id(dyd_place **out, dyd_places *n, const dyd_span *id) {
  size_t begin = n->used;
  return key_put(n, id->text, id->length) ? places_count(out, n, begin) : DYD_E_NOMEM;
}
