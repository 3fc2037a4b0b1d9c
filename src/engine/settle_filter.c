/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Choices of the points of fixed rectangles, by a few centres and a descent in doubles.
 *
 * For a centre c the choice that joins i and j best is clear: theirs nearest to c, all others farthest. There is room
 * when the farther of i and j is then nearer to c than all others, wherever those are that cannot be chosen. */
#include "engine/settle_filter.h"

#include <math.h>
#include <stdlib.h>

/* First centres lie this often the distance of i and j off the middle, on both sides. From the best of them descents
 * begin: from all, when that matters, with more steps. */
static const double offset[] = {0, 0.125, 0.25, 0.5, 1, 2, 4, 16, 64, 4096};
enum { STARTS = 2 * sizeof offset / sizeof *offset, BEST = 3, STEPS = 40, MORE_STEPS = 150 };

/* A question: sites i and j among `count`. last: who left least room the last time, and is looked at first. */
typedef struct joining {
  const dyd_settle_site *site;
  size_t count, i, j, last;
} joining;

typedef struct centre {
  double at[2], room, step;
} centre;

static double clamped(double v, double lo, double hi) {
  return v < lo ? lo : v > hi ? hi : v;
}

static void site_choose_near(dyd_settle_site *s, const double c[2]) {
  for (int a = 0; a < 2; a++) s->at[a] = clamped(c[a], s->box[2 * a], s->box[2 * a + 1]);
}

static void site_choose_far(dyd_settle_site *s, const double c[2]) {
  for (int a = 0; a < 2; a++)
    s->at[a] = c[a] - s->box[2 * a] > s->box[2 * a + 1] - c[a] ? s->box[2 * a] : s->box[2 * a + 1];
}

static double square(double x) {
  return x * x;
}

static double site_near2(const dyd_settle_site *s, const double c[2]) {
  return square(c[0] - clamped(c[0], s->box[0], s->box[1])) + square(c[1] - clamped(c[1], s->box[2], s->box[3]));
}

static double site_far2(const dyd_settle_site *s, const double c[2]) {
  return square(fmax(c[0] - s->box[0], s->box[1] - c[0])) + square(fmax(c[1] - s->box[2], s->box[3] - c[1]));
}

static double site_middle(const dyd_settle_site *s, int axis) {
  return s->box[2 * axis] / 2 + s->box[2 * axis + 1] / 2;
}

/* How far site k can be from c when that is wanted (an end: how near). */
static double joining_reach2(const joining *q, size_t k, const double c[2]) {
  bool end = k == q->i || k == q->j;
  return q->site[k].fixed == end ? site_near2(&q->site[k], c) : site_far2(&q->site[k], c);
}

/* The room at c; at most `most` where it is no more than that. */
static double centre_room(joining *q, const double c[2], double most) {
  double inner = sqrt(fmax(joining_reach2(q, q->i, c), joining_reach2(q, q->j, c)));
  double enough = inner + most > 0 ? square(inner + most) : 0, outer2 = HUGE_VAL;
  for (size_t n = 0; n <= q->count && outer2 > enough; n++) {
    size_t k = n ? n - 1 : q->last;
    if (k == q->i || k == q->j) continue;
    double d2 = joining_reach2(q, k, c);
    if (d2 < outer2) {
      outer2 = d2;
      q->last = k;
    }
  }
  return sqrt(outer2) - inner;
}

/* Moves c where there is more room. Room has ridges: the four ways are turned from step to step. */
static void centre_climb(centre *c, joining *q, int steps) {
  double way[2] = {1, 0};
  for (int n = 0; n < steps; n++) {
    centre best = *c;
    for (int w = 0; w < 4; w++) {
      const double next[2] = {c->at[0] + c->step * way[0], c->at[1] + c->step * way[1]}, turned = -way[1];
      double room = centre_room(q, next, best.room);
      if (room > best.room) best = (centre){{next[0], next[1]}, room, c->step * 1.25};
      way[1] = way[0];
      way[0] = turned;
    }
    if (!(best.room > c->room)) best.step /= 2;
    *c = best;
    const double turned = 0.8 * way[0] - 0.6 * way[1];
    way[1] = 0.6 * way[0] + 0.8 * way[1];
    way[0] = turned;
  }
}

static int centre_compare(const void *a, const void *b) {
  const centre *c = a, *d = b;
  return (c->room < d->room) - (c->room > d->room);
}

/* The first centres, best first. */
static void centre_starts(centre start[STARTS], joining *q) {
  const dyd_settle_site *a = &q->site[q->i], *b = &q->site[q->j];
  double middle[2], d[2];
  for (int x = 0; x < 2; x++) {
    middle[x] = site_middle(a, x) / 2 + site_middle(b, x) / 2;
    d[x] = site_middle(b, x) - site_middle(a, x);
  }
  for (size_t n = 0; n < STARTS; n++) {
    double t = n % 2 ? -offset[n / 2] : offset[n / 2];
    start[n] = (centre){{middle[0] - t * d[1], middle[1] + t * d[0]}, 0, fmax(fabs(t), 0.25) / 2 * hypot(d[0], d[1])};
    start[n].room = centre_room(q, start[n].at, -HUGE_VAL);
  }
  qsort(start, STARTS, sizeof *start, centre_compare);
}

static centre centre_find(joining *q, bool thorough) {
  centre start[STARTS];
  centre_starts(start, q);
  centre best = start[0];
  for (size_t n = 0; n < (thorough ? STARTS : BEST); n++) {
    centre_climb(&start[n], q, thorough ? MORE_STEPS : STEPS);
    if (start[n].room > best.room) best = start[n];
  }
  return best;
}

/* Where both ends could be at the centre they are put apart, within its room. */
static void ends_part(dyd_settle_site *a, const dyd_settle_site *b, const centre *c) {
  double corner[2], way;
  if (!a->fixed || a->at[0] != b->at[0] || a->at[1] != b->at[1]) return;
  for (int q = 0; q < 2; q++) corner[q] = a->at[q];
  site_choose_far(a, corner);
  way = hypot(a->at[0] - corner[0], a->at[1] - corner[1]);
  double part = way > 0 ? fmin(c->room / 2 / way, 0.5) : 0;
  for (int q = 0; q < 2; q++) a->at[q] = corner[q] + part * (a->at[q] - corner[q]);
}

bool dyd_filter_choose_joined(dyd_settle_site *site, size_t count, size_t i, size_t j, bool thorough) {
  joining q = {site, count, i, j, i};
  centre c = centre_find(&q, thorough);
  if (!(c.room > 0)) return false;
  for (size_t k = 0; k < count; k++) {
    if (k == i || k == j)
      site_choose_near(&site[k], c.at);
    else
      site_choose_far(&site[k], c.at);
  }
  ends_part(&site[i], &site[j], &c);
  return true;
}

static double side_of(const dyd_settle_site *a, const dyd_settle_site *b, const dyd_settle_site *c) {
  return (site_middle(b, 0) - site_middle(a, 0)) * (site_middle(c, 1) - site_middle(a, 1)) -
         (site_middle(b, 1) - site_middle(a, 1)) * (site_middle(c, 0) - site_middle(a, 0));
}

bool dyd_filter_middles_cross(const dyd_settle_site *site, size_t i, size_t j, size_t k, size_t l) {
  const dyd_settle_site *a = &site[i], *b = &site[j], *c = &site[k], *d = &site[l];
  return side_of(a, b, c) * side_of(a, b, d) < 0 && side_of(c, d, a) * side_of(c, d, b) < 0;
}

void dyd_filter_choose_parted(dyd_settle_site *site, size_t count, size_t i, size_t j) {
  double c[2];
  for (int a = 0; a < 2; a++) c[a] = site_middle(&site[i], a) / 2 + site_middle(&site[j], a) / 2;
  for (size_t k = 0; k < count; k++) {
    if (k == i || k == j)
      site_choose_far(&site[k], c);
    else
      site_choose_near(&site[k], c);
  }
}

void dyd_filter_choose_middles(dyd_settle_site *site, size_t count) {
  for (size_t k = 0; k < count; k++)
    for (int a = 0; a < 2; a++) site[k].at[a] = site_middle(&site[k], a);
}

void dyd_filter_choose_any(dyd_settle_site *site, size_t count, uint64_t *random) {
  for (size_t k = 0; k < 2 * count; k++) {
    const double *side = &site[k / 2].box[2 * (k % 2)];
    *random = *random * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    site[k / 2].at[k % 2] = side[0] + (side[1] - side[0]) * ((double)(*random >> 11) * 0x1p-53);
  }
}
