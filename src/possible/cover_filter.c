/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The cover walk from the middle to both ends, in doubles.
 *
 * [COV-2] What k blocks of beta = {ds_i = ds_j} is connected if k does not block one of its ends strictly. So a chain
 * of such k, the first of which blocks the end at -inf, the last the end at inf, and each of which blocks a point of
 * beta together with the next one, covers beta: the pair is impossible. A centre nearer to which nobody is shows that
 * it is possible [POS-1].
 *
 * Where to look needs no bound: from the blocker of one place go to where its part of beta seems to end. Just behind
 * somebody else blocks, or nobody, which the tree confirms. */
#include "possible/cover_filter.h"

#include "possible/beta_filter.h"
#include "skeleton/skeleton.h"

/* MOST_LINKS: of a chain, to each side. BISECTIONS, DOUBLINGS: steps of a search for an end. */
enum { MOST_LINKS = 48, MAX_RIVALS = 48, BISECTIONS = 40, DOUBLINGS = 40, JOINTS = 5 };

/* Ends are found up to so much of the distance; chains are joined, and go on, beside them. */
#define BESIDE 0x1p-22

/* rival: neighbours of i and j in the skeleton, once gathered. */
typedef struct quick {
  const dyd_skeleton *sk;
  dyd_beta beta;
  const uint32_t *hint;
  bool gathered;
  int rivals;
  uint32_t rival[MAX_RIVALS];
} quick;

/* ---- who blocks a place ---- */

static bool seems_blocked(const quick *q, uint32_t k, double t) {
  dyd_place p = dyd_beta_at(&q->beta, t);
  return dyd_place_far2(&p, &q->sk->rects.box[k]) < p.ds2;
}

/* About who is nearest among the hints and neighbours, if nearer than i and j. */
static uint32_t likely_blocker(quick *q, const dyd_place *p) {
  double least = p->ds2;
  uint32_t best = DYD_NONE;
  if (!q->gathered) {
    q->gathered = true;
    q->rivals = dyd_neighbours(q->rival, MAX_RIVALS, q->sk, q->beta.i, q->beta.j);
  }
  for (int k = 0; k < q->rivals + 2; k++) {
    uint32_t v = k < 2 ? q->hint[k] : q->rival[k - 2];
    double d = v == DYD_NONE ? INFINITY : dyd_place_far2(p, &q->sk->rects.box[v]);
    if (!(d < least)) continue;
    least = d;
    best = v;
  }
  return best;
}

typedef struct search {
  const quick *q;
  dyd_bbox c;
  double bound;
  uint32_t found;
} search;

static bool perhaps_nearer(void *context, uint32_t k) {
  search *s = context;
  const dyd_beta *b = &s->q->beta;
  if (k == b->i || k == b->j || dyd_surely_not_nearer(&s->q->sk->rects, &s->c, k, s->bound)) return true;
  s->found = k;
  return false;
}

/* Somebody who is perhaps nearer than i or j; DYD_NONE: surely nobody, so the pair is possible [POS-1]. */
static uint32_t any_blocker(const quick *q, const dyd_place *p) {
  search s = {q, {{p->at[0], p->at[0], p->at[1], p->at[1]}}, 0, DYD_NONE};
  s.bound = dyd_pair_ds2_upper(&q->sk->rects, &s.c, q->beta.i, q->beta.j);
  dyd_tree_near(&q->sk->rects.tree, &s.c, &s.bound, perhaps_nearer, &s);
  return s.found;
}

static uint32_t blocker_at(quick *q, const dyd_place *p) {
  uint32_t k = likely_blocker(q, p);
  return k == DYD_NONE ? any_blocker(q, p) : k;
}

/* ---- the chain ---- */

/* Is what k blocks surely connected? */
static bool is_link(const quick *q, uint32_t k) {
  return dyd_beta_blocks_end(&q->beta, k, 0) == DYD_SURE_MINUS || dyd_beta_blocks_end(&q->beta, k, 1) == DYD_SURE_MINUS;
}

static bool is_last_link(const quick *q, uint32_t k, int up) {
  return dyd_beta_blocks_end(&q->beta, k, up) == DYD_SURE_PLUS &&
         dyd_beta_blocks_end(&q->beta, k, !up) == DYD_SURE_MINUS;
}

/* About where the part that k blocks ends, from the blocked place t on; beside: how far from it to look. NaN: not
 * found. */
static double find_end(double *beside, const quick *q, uint32_t k, double t, int up) {
  dyd_place p = dyd_beta_at(&q->beta, t);
  double way = up ? 1 : -1, guess = dyd_beta_guess_end(&q->beta, k, p), step = 0x1p-4 * sqrt(p.ds2), from = 0, to;
  int tries = 0;
  *beside = BESIDE * sqrt(dyd_beta_at(&q->beta, guess).ds2);
  if ((guess - t) * way > 0 && seems_blocked(q, k, guess - way * *beside) &&
      !seems_blocked(q, k, guess + way * *beside))
    return guess;
  for (to = step; seems_blocked(q, k, t + way * to); to *= 2) {
    if (tries++ == DOUBLINGS) return NAN;
    from = to;
  }
  for (tries = 0; tries < BISECTIONS && to - from > BESIDE / 4 * step; tries++) {
    double middle = from + (to - from) / 2;
    *(seems_blocked(q, k, t + way * middle) ? &from : &to) = middle;
  }
  *beside = BESIDE * sqrt(dyd_beta_at(&q->beta, t + way * from).ds2);
  return t + way * from;
}

/* Do k and next surely block one place of beta, a little before what k blocks ends? */
static bool are_joined(const quick *q, uint32_t k, uint32_t next, double end, double beside) {
  const uint32_t both[2] = {k, next};
  for (int tries = 0; tries < JOINTS; tries++, beside *= 0x1p5)
    if (dyd_beta_surely_blocked(&q->beta, both, 2, end - beside)) return true;
  return false;
}

/* From the blocked place t towards an end. FALSE: all is blocked there; TRUE: *centre has been found. */
static dyd_truth extend(dyd_place *centre, quick *q, uint32_t k, double t, int up) {
  double way = up ? 1 : -1, beside;
  for (int link = 0; link < MOST_LINKS; link++) {
    if (is_last_link(q, k, up)) return DYD_FALSE;
    double end = find_end(&beside, q, k, t, up);
    t = end + way * beside;
    *centre = dyd_beta_at(&q->beta, t);
    if (!isfinite(centre->ds2)) return DYD_UNKNOWN;
    uint32_t next = blocker_at(q, centre);
    if (next == DYD_NONE) return DYD_TRUE;
    if (next == k || !is_link(q, next) || !are_joined(q, k, next, end, way * beside)) return DYD_UNKNOWN;
    k = next;
  }
  return DYD_UNKNOWN;
}

/* Between the ends of what the hints block, or about in the middle. */
static double first_place(const quick *q) {
  const dyd_beta *b = &q->beta;
  double t = b->a->e[2 * b->t] / 4 + b->a->e[2 * b->t + 1] / 4 + b->b->e[2 * b->t] / 4 + b->b->e[2 * b->t + 1] / 4;
  dyd_place middle = dyd_beta_at(b, t);
  if (q->hint[0] == DYD_NONE || q->hint[1] == DYD_NONE) return t;
  double between = dyd_beta_guess_end(b, q->hint[0], middle) / 2 + dyd_beta_guess_end(b, q->hint[1], middle) / 2;
  return isfinite(between) ? between : t;
}

/* Do the two hints block everything? */
static bool hints_cover(const quick *q, double t) {
  const uint32_t *k = q->hint;
  if (k[0] == DYD_NONE || k[1] == DYD_NONE || !dyd_beta_surely_blocked(&q->beta, k, 2, t)) return false;
  return (is_last_link(q, k[0], 0) && is_last_link(q, k[1], 1)) ||
         (is_last_link(q, k[0], 1) && is_last_link(q, k[1], 0));
}

static dyd_truth walk_both_ways(dyd_place *centre, quick *q) {
  double t = first_place(q);
  if (hints_cover(q, t)) return DYD_FALSE;
  *centre = dyd_beta_at(&q->beta, t);
  if (!isfinite(centre->ds2)) return DYD_UNKNOWN;
  uint32_t k = blocker_at(q, centre);
  if (k == DYD_NONE) return DYD_TRUE;
  dyd_truth sure = is_link(q, k) && dyd_beta_surely_blocked(&q->beta, &k, 1, t) ? DYD_FALSE : DYD_UNKNOWN;
  for (int up = 0; up < 2; up++) {
    dyd_truth side = extend(centre, q, k, t, up);
    if (side == DYD_TRUE) return side;
    if (side == DYD_UNKNOWN) sure = side;
  }
  return sure;
}

/* Of what both share, or of the gap between them. */
static dyd_xy cover_middle(const dyd_bbox *a, const dyd_bbox *b) {
  return (dyd_xy){dyd_max(a->e[0], b->e[0]) / 2 + dyd_min(a->e[1], b->e[1]) / 2,
                  dyd_max(a->e[2], b->e[2]) / 2 + dyd_min(a->e[3], b->e[3]) / 2};
}

dyd_truth dyd_filter_cover(dyd_xy *centre, const dyd_skeleton *sk, uint32_t i, uint32_t j, const uint32_t hint[2]) {
  quick q = {.sk = sk, .hint = hint};
  dyd_truth apart = dyd_beta_start(&q.beta, &sk->rects, i, j), truth = apart == DYD_FALSE ? DYD_TRUE : DYD_UNKNOWN;
  dyd_place p;
  *centre = cover_middle(&sk->rects.box[i], &sk->rects.box[j]);
  if (apart != DYD_TRUE) return truth;
  truth = walk_both_ways(&p, &q);
  if (truth == DYD_TRUE) *centre = (dyd_xy){p.at[0], p.at[1]};
  return truth;
}
