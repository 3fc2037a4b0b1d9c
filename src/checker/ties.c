/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Checks what points are said to be: each lies in the rectangle of its site; determinants of them are 0, as
 * polynomials, or by a bound; base points of a line differ, those of a circle are on no line [CERT-10]. */
#include "checker/ties.h"

#include "base/alloc.h"
#include "base/error.h"
#include "checker/parts.h"

#include <string.h>

/* Numbers of a block, facts, points of a fact: at most. */
#define MOST_NUMBERS ((uint64_t)1 << 22)

void dyd_cert_ties_clear(dyd_cert_ties *t) {
  for (size_t k = 0; k < t->blocks; k++) {
    dyd_cert_algebra_clear(&t->block[k]->algebra);
    free(t->block[k]->point);
    free(t->block[k]);
  }
  free(t->block);
  free(t->fact);
  free(t->member);
  *t = (dyd_cert_ties){0};
}

/* ---- where points are ---- */

/* out = an end of a side in units of 2^-p, rounded down (a lower end up): what is beyond it is outside. */
static bool side_holds_enclosure(const dyd_cert_side *s, const dyd_cert_enclosure *x, long p) {
  mpz_t end;
  mpz_init(end);
  dyd_exact_ceil(end, &s->lo, NULL, -p);
  bool inside = mpz_cmp(end, x->lo) <= 0;
  dyd_exact_floor(end, &s->hi, NULL, -p);
  inside = inside && mpz_cmp(x->hi, end) <= 0;
  mpz_clear(end);
  return inside;
}

/* Is the number that of a side that is a point? */
static bool side_is_number(const dyd_cert_side *s, dyd_cert_algebra *a, uint32_t number) {
  dyd_cert_quotient at = {{0}, {0}};
  mpz_t num, den;
  mpz_init_set(num, s->lo.man);
  mpz_init_set_ui(den, 1);
  mpz_ptr shifted = s->lo.exp < 0 ? den : num;
  bool fits = s->lo.exp < (int64_t)DYD_CERT_BITS && -s->lo.exp < (int64_t)DYD_CERT_BITS;
  if (fits) mpz_mul_2exp(shifted, shifted, (mp_bitcnt_t)(s->lo.exp < 0 ? -s->lo.exp : s->lo.exp));
  if (s->den) mpz_mul(den, den, *s->den);
  fits = fits && dyd_cert_quotient_set_q(&at, num, den, &a->relations) &&
         dyd_cert_quotient_add(&at, -1, &a->number[number].value, &a->relations) && dyd_cert_poly_is_null(a, &at.num);
  dyd_cert_quotient_clear(&at);
  mpz_clears(num, den, NULL);
  return fits;
}

/* Is the number seen to lie outside of the side, which is no point, at precision p? */
static bool side_lacks_number(const dyd_cert_side *s, dyd_cert_algebra *a, uint32_t number, long p) {
  mpz_t end;
  if (s->point) return false;
  const dyd_cert_enclosure *x = dyd_cert_algebra_enclose(a, number, p);
  if (!x->known) return false;
  mpz_init(end);
  dyd_exact_floor(end, &s->lo, NULL, -p);
  bool outside = mpz_cmp(x->hi, end) < 0;
  dyd_exact_ceil(end, &s->hi, NULL, -p);
  outside = outside || mpz_cmp(end, x->lo) < 0;
  mpz_clear(end);
  return outside;
}

/* Is the number seen to lie in the side at precision p? */
static bool side_holds_number(const dyd_cert_side *s, dyd_cert_algebra *a, uint32_t number, long p) {
  if (s->point) return side_is_number(s, a, number);
  const dyd_cert_enclosure *x = dyd_cert_algebra_enclose(a, number, p);
  return x->known && side_holds_enclosure(s, x, p);
}

/* All points at one precision after the other, as enclosures are kept; at the last one all is decided. */
static dyd_status check_rectangles(dyd_cert_block *b, dyd_cert_reader *in, const dyd_cert_sites *s) {
  size_t first = 0;
  for (long p = 128; first < b->points; p *= 2)
    for (size_t k = first; k < b->points; k++) {
      const dyd_cert_described *d = &b->point[k];
      const dyd_cert_side *side = s->site[d->site].side;
      bool held = side_holds_number(&side[0], &b->algebra, d->number[0], p) &&
                  side_holds_number(&side[1], &b->algebra, d->number[1], p);
      bool lacks = !held && (side_lacks_number(&side[0], &b->algebra, d->number[0], p) ||
                             side_lacks_number(&side[1], &b->algebra, d->number[1], p));
      if (lacks || (!held && 2 * p > DYD_CERT_PRECISION))
        return dyd_cert_reject(in, "the point described is not seen to lie in the rectangle of site %u",
                               (unsigned)d->site);
      if (!held) break;
      first = k + 1;
    }
  return DYD_OK;
}

/* ---- determinants ---- */

static const dyd_cert_described *find_described(const dyd_cert_block *b, uint32_t site) {
  size_t lo = 0, hi = b->points;
  while (lo < hi) {
    size_t middle = (lo + hi) / 2;
    if (b->point[middle].site < site)
      lo = middle + 1;
    else
      hi = middle;
  }
  return lo < b->points && b->point[lo].site == site ? &b->point[lo] : NULL;
}

/* out = the enclosure of coordinate `axis` of q - p. */
static void enclose_difference(dyd_cert_enclosure *out, dyd_cert_algebra *a, const dyd_cert_described *p,
                               const dyd_cert_described *q, int axis, long prec) {
  dyd_cert_enclosure_set(out, dyd_cert_algebra_enclose(a, q->number[axis], prec));
  dyd_cert_enclosure_sub(out, dyd_cert_algebra_enclose(a, p->number[axis], prec));
}

static bool are_different(dyd_cert_algebra *a, const dyd_cert_described *p, const dyd_cert_described *q) {
  dyd_cert_enclosure d;
  int sign = 0;
  dyd_cert_enclosure_init(&d);
  for (long prec = 64; prec <= DYD_CERT_SIGN_PRECISION && !sign; prec *= 2)
    for (int axis = 0; axis < 2 && !sign; axis++) {
      enclose_difference(&d, a, p, q, axis, prec);
      sign = dyd_cert_enclosure_sign(&d);
    }
  dyd_cert_enclosure_clear(&d);
  return sign != 0;
}

/* Are three points surely on no line? */
static bool are_a_triangle(dyd_cert_algebra *a, const dyd_cert_described *const p[3]) {
  dyd_cert_enclosure d[2], e[2];
  int sign = 0;
  for (int k = 0; k < 2; k++) {
    dyd_cert_enclosure_init(&d[k]);
    dyd_cert_enclosure_init(&e[k]);
  }
  for (long prec = 64; prec <= DYD_CERT_SIGN_PRECISION && !sign; prec *= 2) {
    for (int k = 0; k < 2; k++) {
      enclose_difference(&d[k], a, p[0], p[1], k, prec);
      enclose_difference(&e[k], a, p[0], p[2], k, prec);
    }
    dyd_cert_enclosure_mul(&d[0], &e[1], prec);
    dyd_cert_enclosure_mul(&d[1], &e[0], prec);
    dyd_cert_enclosure_sub(&d[0], &d[1]);
    sign = dyd_cert_enclosure_sign(&d[0]);
  }
  for (int k = 0; k < 2; k++) {
    dyd_cert_enclosure_clear(&e[k]);
    dyd_cert_enclosure_clear(&d[k]);
  }
  return sign != 0;
}

/* A vector and the square of its length. */
typedef struct vector {
  dyd_cert_quotient x, y, square;
} vector;

static void vector_clear(vector *v) {
  dyd_cert_quotient_clear(&v->x);
  dyd_cert_quotient_clear(&v->y);
  dyd_cert_quotient_clear(&v->square);
}

/* out = x y - z w. */
static bool product_difference(dyd_cert_quotient *out, const dyd_cert_quotient *x, const dyd_cert_quotient *y,
                               const dyd_cert_quotient *z, const dyd_cert_quotient *w, dyd_cert_relations *r) {
  dyd_cert_quotient t = {{0}, {0}};
  bool fits = dyd_cert_quotient_set(out, x, r) && dyd_cert_quotient_mul(out, y, r) && dyd_cert_quotient_set(&t, z, r) &&
              dyd_cert_quotient_mul(&t, w, r) && dyd_cert_quotient_add(out, -1, &t, r);
  dyd_cert_quotient_clear(&t);
  return fits;
}

/* v = q - p. */
static bool vector_set(vector *v, dyd_cert_algebra *a, const dyd_cert_described *p, const dyd_cert_described *q) {
  dyd_cert_quotient minus = {{0}, {0}};
  dyd_cert_relations *r = &a->relations;
  const dyd_cert_number *n = a->number;
  bool fits = dyd_cert_quotient_set(&v->x, &n[q->number[0]].value, r) &&
              dyd_cert_quotient_add(&v->x, -1, &n[p->number[0]].value, r) &&
              dyd_cert_quotient_set(&v->y, &n[q->number[1]].value, r) &&
              dyd_cert_quotient_add(&v->y, -1, &n[p->number[1]].value, r) && dyd_cert_quotient_set(&minus, &v->y, r);
  dyd_cert_quotient_neg(&minus);
  fits = fits && product_difference(&v->square, &v->x, &v->x, &v->y, &minus, r);
  dyd_cert_quotient_clear(&minus);
  return fits;
}

/* The determinant of a further point with the difference d from the first base point is along[0] d.x + along[1] d.y +
 * along[2] d^2; on a line, without d^2. */
typedef struct base {
  const dyd_cert_described *first;
  dyd_cert_quotient along[3];
  int terms;
} base;

static void base_clear(base *b) {
  for (int k = 0; k < 3; k++) dyd_cert_quotient_clear(&b->along[k]);
}

static bool base_set_line(base *b, dyd_cert_algebra *a, const dyd_cert_described *const p[3]) {
  vector v = {.x = {{0}, {0}}};
  bool fits = vector_set(&v, a, p[0], p[1]) && dyd_cert_quotient_set(&b->along[0], &v.y, &a->relations) &&
              dyd_cert_quotient_set(&b->along[1], &v.x, &a->relations);
  dyd_cert_quotient_neg(&b->along[0]);
  b->first = p[0];
  b->terms = 2;
  vector_clear(&v);
  return fits;
}

/* With the differences v, w: v^2 (w x d) - w^2 (v x d) + d^2 (v x w). */
static bool base_set_circle(base *b, dyd_cert_algebra *a, const dyd_cert_described *const p[3]) {
  vector v = {.x = {{0}, {0}}}, w = {.x = {{0}, {0}}};
  dyd_cert_relations *r = &a->relations;
  bool fits = vector_set(&v, a, p[0], p[1]) && vector_set(&w, a, p[0], p[2]) &&
              product_difference(&b->along[0], &w.square, &v.y, &v.square, &w.y, r) &&
              product_difference(&b->along[1], &v.square, &w.x, &w.square, &v.x, r) &&
              product_difference(&b->along[2], &v.x, &w.y, &v.y, &w.x, r);
  b->first = p[0];
  b->terms = 3;
  vector_clear(&w);
  vector_clear(&v);
  return fits;
}

static bool number_is_null(dyd_cert_algebra *a, const dyd_cert_poly *q, bool by_bound) {
  return by_bound ? dyd_cert_poly_is_null(a, q) : dyd_cert_poly_is_zero(q);
}

/* Is the point on the line or circle? */
static bool base_has(const base *b, dyd_cert_algebra *a, const dyd_cert_described *p, bool by_bound) {
  vector d = {.x = {{0}, {0}}};
  dyd_cert_quotient sum = {{0}, {0}}, t = {{0}, {0}};
  dyd_cert_relations *r = &a->relations;
  bool fits = vector_set(&d, a, b->first, p);
  const dyd_cert_quotient *part[3] = {&d.x, &d.y, &d.square};
  fits = fits && dyd_cert_quotient_set(&sum, &b->along[0], r) && dyd_cert_quotient_mul(&sum, part[0], r);
  for (int k = 1; k < b->terms && fits; k++)
    fits = dyd_cert_quotient_set(&t, &b->along[k], r) && dyd_cert_quotient_mul(&t, part[k], r) &&
           dyd_cert_quotient_add(&sum, 1, &t, r);
  bool null = fits && number_is_null(a, &sum.num, by_bound);
  dyd_cert_quotient_clear(&t);
  dyd_cert_quotient_clear(&sum);
  vector_clear(&d);
  return null;
}

static bool are_same(dyd_cert_algebra *a, const dyd_cert_described *p, const dyd_cert_described *q, bool by_bound) {
  vector v = {.x = {{0}, {0}}};
  bool same = vector_set(&v, a, p, q) && number_is_null(a, &v.x.num, by_bound) && number_is_null(a, &v.y.num, by_bound);
  vector_clear(&v);
  return same;
}

/* ---- facts ---- */

bool dyd_cert_fact_holds(dyd_cert_block *b, dyd_cert_relation_kind kind, const uint32_t *site, size_t count,
                         bool by_bound) {
  const dyd_cert_described *p[3] = {NULL, NULL, NULL};
  size_t bases = kind == DYD_CERT_CIRCLE ? 3 : 2;
  base at = {.first = NULL};
  for (size_t k = 0; k < bases; k++) p[k] = find_described(b, site[k]);
  if (kind == DYD_CERT_SAME) return are_same(&b->algebra, p[0], p[1], by_bound);
  bool holds = kind == DYD_CERT_LINE ? are_different(&b->algebra, p[0], p[1]) && base_set_line(&at, &b->algebra, p)
                                     : are_a_triangle(&b->algebra, p) && base_set_circle(&at, &b->algebra, p);
  for (size_t k = bases; k < count && holds; k++)
    holds = base_has(&at, &b->algebra, find_described(b, site[k]), by_bound);
  base_clear(&at);
  return holds;
}

/* Sites up to the last word of the line, which is the method. */
static dyd_status read_members(dyd_cert_ties *t, dyd_cert_reader *in, const dyd_cert_block *b, bool *by_bound) {
  uint32_t site;
  char *word = NULL;
  dyd_status st = DYD_OK;
  while (st == DYD_OK && strchr(in->at ? in->at : "", ' ')) {
    st = dyd_cert_read_index(&site, in, DYD_CERT_NONE - 1);
    if (st == DYD_OK && !find_described(b, site)) st = dyd_cert_reject(in, "site %u is not described", (unsigned)site);
    if (st == DYD_OK && !dyd_reserve((void **)&t->member, &t->member_cap, t->members + 1, sizeof *t->member))
      st = dyd_fail_nomem(in->err);
    if (st == DYD_OK) t->member[t->members++] = site;
  }
  if (st == DYD_OK) st = dyd_cert_word(&word, in);
  if (st != DYD_OK) return st;
  *by_bound = strcmp(word, "bound") == 0;
  if (!*by_bound && strcmp(word, "identity") != 0) return dyd_cert_reject(in, "\"%.40s\" is no method", word);
  return DYD_OK;
}

static dyd_status read_kind(dyd_cert_relation_kind *kind, dyd_cert_reader *in) {
  static const char *const names[] = {"same", "line", "circle"};
  char *word = NULL;
  int k = 0;
  dyd_status st = dyd_cert_word(&word, in);
  if (st != DYD_OK) return st;
  while (k < 3 && strcmp(word, names[k])) k++;
  *kind = (dyd_cert_relation_kind)k;
  return k < 3 ? DYD_OK : dyd_cert_reject(in, "\"%.40s\" is no fact", word);
}

static dyd_status read_fact(dyd_cert_ties *t, dyd_cert_reader *in, dyd_cert_block *b) {
  dyd_cert_fact f = {.first = t->members};
  bool by_bound = false;
  dyd_status st = dyd_cert_next_line(in);
  if (st == DYD_OK) st = read_kind(&f.kind, in);
  if (st == DYD_OK) st = read_members(t, in, b, &by_bound);
  if (st != DYD_OK) return st;
  f.count = t->members - f.first;
  if (f.kind == DYD_CERT_SAME ? f.count != 2 : f.count < (f.kind == DYD_CERT_LINE ? 3U : 4U))
    return dyd_cert_reject(in, "the fact has a wrong number of points");
  uint32_t *site = t->member + f.first;
  if (!dyd_cert_fact_holds(b, f.kind, site, f.count, by_bound))
    return b->algebra.relations.nomem ? dyd_fail_nomem(in->err) : dyd_cert_reject(in, "the fact is not seen to hold");
  if (dyd_cert_distinct(site, f.count) != f.count) return dyd_cert_reject(in, "a point occurs twice");
  if (!dyd_reserve((void **)&t->fact, &t->fact_cap, t->facts + 1, sizeof *t->fact)) return dyd_fail_nomem(in->err);
  t->bounds += by_bound;
  t->identities += !by_bound;
  t->fact[t->facts++] = f;
  return DYD_OK;
}

/* ---- blocks ---- */

static dyd_status read_count(uint32_t *count, dyd_cert_reader *in, const char *name, uint64_t most) {
  char *word = NULL;
  dyd_status st = dyd_cert_word(&word, in);
  if (st == DYD_OK && strcmp(word, name) != 0) st = dyd_cert_reject(in, "\"%s\" is missing", name);
  if (st == DYD_OK) st = dyd_cert_read_index(count, in, most);
  return st == DYD_OK ? dyd_cert_line_done(in) : st;
}

static dyd_status read_point(dyd_cert_block *b, dyd_cert_reader *in, const dyd_cert_sites *s) {
  dyd_cert_described *d = &b->point[b->points];
  dyd_status st = dyd_cert_next_line(in);
  if (st == DYD_OK) st = dyd_cert_read_index(&d->site, in, s->count - 1);
  for (int axis = 0; axis < 2 && st == DYD_OK; axis++)
    st = dyd_cert_read_index(&d->number[axis], in, b->algebra.count - 1);
  if (st == DYD_OK && b->points && d[-1].site >= d->site) st = dyd_cert_reject(in, "points are not in order");
  if (st == DYD_OK) st = dyd_cert_line_done(in);
  b->points += st == DYD_OK;
  return st;
}

static dyd_status read_points(dyd_cert_block *b, dyd_cert_reader *in, const dyd_cert_sites *s) {
  uint32_t count;
  dyd_status st = dyd_cert_next_line(in);
  if (st == DYD_OK) st = read_count(&count, in, "points", s->count);
  if (st != DYD_OK) return st;
  if (count && !b->algebra.count) return dyd_cert_reject(in, "there are no numbers");
  b->point = dyd_alloc(count, sizeof *b->point);
  if (!b->point) return dyd_fail_nomem(in->err);
  while (st == DYD_OK && b->points < count) st = read_point(b, in, s);
  if (st == DYD_OK) st = check_rectangles(b, in, s);
  return st;
}

static dyd_status read_block(dyd_cert_block *b, dyd_cert_ties *t, dyd_cert_reader *in, const dyd_cert_sites *s) {
  uint32_t count = 0;
  dyd_status st = read_count(&count, in, "algebra", MOST_NUMBERS);
  while (st == DYD_OK && count-- > 0) {
    st = dyd_cert_next_line(in);
    if (st == DYD_OK) st = dyd_cert_algebra_read(&b->algebra, in);
  }
  if (st == DYD_OK) st = read_points(b, in, s);
  if (st == DYD_OK) st = dyd_cert_next_line(in);
  if (st == DYD_OK) st = read_count(&count, in, "facts", MOST_NUMBERS);
  while (st == DYD_OK && count-- > 0) st = read_fact(t, in, b);
  return st;
}

dyd_status dyd_cert_ties_read(dyd_cert_ties *t, dyd_cert_reader *in, const dyd_cert_sites *s) {
  if (!dyd_reserve((void **)&t->block, &t->block_cap, t->blocks + 1, sizeof(dyd_cert_block *)))
    return dyd_fail_nomem(in->err);
  dyd_cert_block *b = calloc(1, sizeof *b);
  if (!b) return dyd_fail_nomem(in->err);
  t->block[t->blocks++] = b;
  b->algebra.relations.work = t->work;
  dyd_status st = read_block(b, t, in, s);
  t->work = b->algebra.relations.work;
  return st;
}

/* ---- what follows ---- */

static bool fact_has_set(const dyd_cert_ties *t, const dyd_cert_fact *x, const dyd_cert_faces *f, size_t k) {
  size_t count = f->start[k + 1] - f->start[k];
  dyd_cert_shape shape = x->kind == DYD_CERT_CIRCLE ? DYD_CERT_POLYGON : DYD_CERT_CHAIN;
  return x->kind != DYD_CERT_SAME && f->shape[k] == shape && x->count == count &&
         !memcmp(t->member + x->first, f->member + f->start[k], count * sizeof *t->member);
}

/* Only the sets of its first site are looked at. */
void dyd_cert_ties_mark(dyd_cert_faces *f, const dyd_cert_ties *t) {
  for (size_t q = 0; q < t->facts; q++) {
    uint32_t v = t->member[t->fact[q].first];
    for (size_t k = f->first[v]; k < f->first[v + 1]; k++)
      if (fact_has_set(t, &t->fact[q], f, f->of[k])) f->tied[f->of[k]] = true;
  }
}

dyd_status dyd_cert_ties_aliases(size_t *out, const dyd_cert_ties *t, const dyd_cert_sites *s) {
  uint32_t *parent = dyd_alloc(s->count, sizeof *parent);
  if (!parent) return DYD_E_NOMEM;
  for (uint32_t i = 0; i < s->count; i++) parent[i] = i;
  for (size_t q = 0; q < t->facts; q++) {
    const uint32_t *two = t->member + t->fact[q].first;
    if (t->fact[q].kind == DYD_CERT_SAME) parent[dyd_cert_root(parent, two[0])] = dyd_cert_root(parent, two[1]);
  }
  *out = 0;
  for (uint32_t i = 0; i < s->count; i++) {
    uint32_t of = s->site[i].alias;
    if (of == i || dyd_cert_is_point(&s->site[of])) continue;
    *out += dyd_cert_root(parent, i) != dyd_cert_root(parent, of);
  }
  free(parent);
  return DYD_OK;
}
