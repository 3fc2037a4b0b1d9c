/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Pairs of open sets proved illegal all together, by boxes that cover the plane [CERT-9].
 *
 * C_ki = { c : dl_k(c) < ds_i(c) } is convex: when the corners of a box lie in it, i is nowhere in the box possibly
 * nearest. A pair with no box that holds both is illegal. Boxes are cut in four as long as they hold a pair that is not
 * listed. The first boxes are a square o + [-h,h]^2 and, for h doubled again and again, the twelve squares of side h
 * around it. Outside of the last there are cones in place of boxes, { o + s (v - o) : s >= 1, v on a part of the border
 * }: i is nowhere in one when that holds at the two ends of the part, and k is surely farther out than i in the
 * directions of both. All in integers, on the grid of the sites, where rectangles are rounded outward. */
#include "checker/boxes.h"
#include "base/alloc.h"
#include "base/index.h"
#include "checker/by_key.h"
#include "checker/tree.h"

#define MIDDLE (INT64_C(1) << 29) /* of the grid: o */
#define HALF (INT64_C(1) << 30)   /* h of the first square, and of the last */
#define LAST (INT64_C(1) << 58)
#define MOST_CUTS 40      /* of a box */
#define MOST_CONE_CUTS 12 /* of a cone */
#define FEW 64            /* sites of a box whose pairs are listed: at once; when a cut does not help much */
#define MANY 4096
#define EFFORT_BITS 16
#define STUCK 3 /* cuts, one after the other, that left more than seven eighths of the sites */
#define OUTER_CUTS 5
#define MOST_LEFT ((size_t)1 << 22)

__extension__ typedef __int128 height;

/* A box (four corners), or a cone (two, and their directions from the middle). */
typedef struct region {
  int64_t corner[4][2];
  int corners, depth, stuck;
  bool cone;
} region;

/* Sites and pairs of nested regions lie one behind the other in site[] and pair[]. */
typedef struct pair_search {
  const dyd_cert_sites *sites;
  const dyd_cert_faces *faces;
  size_t *first; /* known partners, of greater number: partner[first[i] .. first[i+1]), ascending */
  uint32_t *partner;
  uint32_t *site;
  size_t site_cap, pair_cap;
  dyd_cert_edge *pair;
  uint64_t *stamp, now; /* stamp[v] = now: site v is possible in the region looked at */
  uint64_t effort, effort_most;
  dyd_cert_edges *left;
  bool given_up;
} pair_search;

/* ---- one site in one region ---- */

static dyd_cert_area far_from_corner(const int64_t c[2], const dyd_cert_box *b) {
  dyd_cert_area sum = 0;
  for (int a = 0; a < 2; a++) {
    int64_t left = c[a] - b->e[2 * a], right = b->e[2 * a + 1] - c[a];
    sum += dyd_cert_square(left > right ? left : right);
  }
  return sum;
}

static dyd_cert_area near_from_corner(const int64_t c[2], const dyd_cert_box *b) {
  dyd_cert_area sum = 0;
  for (int a = 0; a < 2; a++) {
    int64_t left = b->e[2 * a] - c[a], right = c[a] - b->e[2 * a + 1], d = left > right ? left : right;
    if (d > 0) sum += dyd_cert_square(d);
  }
  return sum;
}

/* max (upper) or min of u.x over the box, u the direction of the corner from the middle. */
static height box_height(const int64_t corner[2], const dyd_cert_box *b, bool upper) {
  height sum = 0;
  for (int a = 0; a < 2; a++) {
    int64_t u = corner[a] - MIDDLE;
    sum += (height)u * b->e[2 * a + ((u > 0) == upper)];
  }
  return sum;
}

/* A blocker: at each corner how far it is, and how far out. */
typedef struct blocker {
  uint32_t site;
  dyd_cert_area far[4];
  height bottom[2];
} blocker;

static void make_blocker(blocker *b, const pair_search *s, const region *r, uint32_t v) {
  b->site = v;
  for (int k = 0; k < r->corners; k++) b->far[k] = far_from_corner(r->corner[k], &s->sites->box[v]);
  for (int k = 0; r->cone && k < 2; k++) b->bottom[k] = box_height(r->corner[k], &s->sites->box[v], false);
}

/* The nearest at each corner, and in a cone the farthest out. */
static int choose_blockers(blocker *b, const pair_search *s, const region *r, const uint32_t *site, size_t count) {
  int kinds = !count ? 0 : r->corners + (r->cone ? 2 : 0);
  for (int k = 0; k < kinds; k++) {
    const int64_t *corner = r->corner[k % r->corners];
    uint32_t best = site[0];
    dyd_cert_area least = 0;
    height most = 0;
    for (size_t q = 0; q < count; q++) {
      const dyd_cert_box *box = &s->sites->box[site[q]];
      if (k < r->corners) {
        dyd_cert_area far = far_from_corner(corner, box);
        if (q && far >= least) continue;
        least = far;
      } else {
        height bottom = box_height(corner, box, false);
        if (q && bottom <= most) continue;
        most = bottom;
      }
      best = site[q];
    }
    make_blocker(&b[k], s, r, best);
  }
  return kinds;
}

static bool is_region_blocked(const pair_search *s, const region *r, uint32_t v, const blocker *b, int blockers) {
  dyd_cert_area near[4];
  height top[2] = {0, 0};
  for (int k = 0; k < r->corners; k++) near[k] = near_from_corner(r->corner[k], &s->sites->box[v]);
  for (int k = 0; r->cone && k < 2; k++) top[k] = box_height(r->corner[k], &s->sites->box[v], true);
  for (int q = 0; q < blockers; q++) {
    bool blocked = b[q].site != v;
    for (int k = 0; k < r->corners; k++) blocked = blocked && b[q].far[k] < near[k];
    for (int k = 0; r->cone && k < 2; k++) blocked = blocked && top[k] < b[q].bottom[k];
    if (blocked) return true;
  }
  return false;
}

/* ---- sites and pairs of a region ---- */

/* Puts those of site[from .. from+count) that are possible in r behind them; returns how many. */
static dyd_status keep_region_sites(size_t *kept, pair_search *s, const region *r, size_t from, size_t count) {
  blocker b[6];
  *kept = 0;
  if (!dyd_reserve((void **)&s->site, &s->site_cap, from + 2 * count, sizeof *s->site)) return DYD_E_NOMEM;
  const uint32_t *site = s->site + from;
  int blockers = choose_blockers(b, s, r, site, count);
  s->now++;
  for (size_t q = 0; q < count; q++) {
    if (is_region_blocked(s, r, site[q], b, blockers)) continue;
    s->site[from + count + (*kept)++] = site[q];
    s->stamp[site[q]] = s->now;
  }
  s->effort += count;
  return DYD_OK;
}

/* The pairs of site[from .. from+count), ascending, that are in no list and share an open set, put at pair[at]. */
static dyd_status list_region_pairs(size_t *pairs, pair_search *s, size_t at, size_t from, size_t count) {
  *pairs = 0;
  for (size_t a = 0; a < count; a++) {
    uint32_t i = s->site[from + a];
    size_t known = s->first[i], end = s->first[i + 1];
    if (!dyd_reserve((void **)&s->pair, &s->pair_cap, at + *pairs + count, sizeof *s->pair)) return DYD_E_NOMEM;
    for (size_t b = a + 1; b < count; b++) {
      uint32_t j = s->site[from + b];
      while (known < end && s->partner[known] < j) known++;
      if ((known == end || s->partner[known] != j) && dyd_cert_faces_share(s->faces, i, j))
        s->pair[at + (*pairs)++] = (dyd_cert_edge){i, j};
    }
  }
  s->effort += count * count / 16;
  return DYD_OK;
}

/* Those of pair[at .. at+count) with both sites possible in the region looked at, put behind them. */
static dyd_status keep_region_pairs(size_t *kept, pair_search *s, size_t at, size_t count) {
  *kept = 0;
  if (!dyd_reserve((void **)&s->pair, &s->pair_cap, at + 2 * count, sizeof *s->pair)) return DYD_E_NOMEM;
  for (size_t q = at; q < at + count; q++)
    if (s->stamp[s->pair[q].i] == s->now && s->stamp[s->pair[q].j] == s->now)
      s->pair[at + count + (*kept)++] = s->pair[q];
  s->effort += count / 16;
  return DYD_OK;
}

/* ---- regions ---- */

/* Part k of r, of four or two; false: r is too small to be cut. */
static bool region_part(region *out, const region *r, int k) {
  int64_t middle[2];
  *out = *r;
  out->depth++;
  for (int a = 0; a < 2; a++) middle[a] = r->corner[0][a] + (r->corner[r->corners - 1][a] - r->corner[0][a]) / 2;
  if (r->cone) {
    for (int a = 0; a < 2; a++) out->corner[1 - k][a] = middle[a];
  } else {
    const int64_t *lo = r->corner[0], *hi = r->corner[3];
    for (int c = 0; c < 4; c++)
      for (int a = 0; a < 2; a++) {
        bool high = k >> a & 1, upper = c >> a & 1;
        int64_t x = high != upper ? middle[a] : high ? hi[a] : lo[a];
        out->corner[c][a] = x;
      }
  }
  return r->cone ? r->depth < MOST_CONE_CUTS : r->depth < MOST_CUTS && r->corner[3][0] - r->corner[0][0] > 1;
}

static dyd_status add_left(pair_search *s, size_t at, size_t count) {
  dyd_status st = DYD_OK;
  for (size_t q = at; q < at + count && st == DYD_OK; q++) st = dyd_cert_edges_add(s->left, s->pair[q].i, s->pair[q].j);
  return st;
}

/* site[from .. from+count): the sites of the region around r; pair[at .. at+pairs) its pairs, when `listed`. */
static dyd_status look_at_region(pair_search *s, const region *r, size_t from, size_t count, size_t at, size_t pairs,
                                 bool listed) {
  region part;
  size_t sites = 0, kept = 0;
  if (s->given_up) return DYD_OK;
  dyd_status st = keep_region_sites(&sites, s, r, from, count);
  if (st != DYD_OK || sites < 2) return st;
  int stuck = 8 * sites > 7 * count ? r->stuck + 1 : 0;
  from += count;
  if (listed) {
    st = keep_region_pairs(&kept, s, at, pairs);
    at += pairs;
  } else if (sites <= FEW || (sites <= MANY && stuck >= STUCK)) {
    st = list_region_pairs(&kept, s, at, from, sites);
    listed = true;
  }
  if (st != DYD_OK || (listed && kept == 0)) return st;
  bool cut = region_part(&part, r, 0) && s->effort <= s->effort_most;
  s->given_up = (!cut && !listed) || s->left->count > MOST_LEFT;
  if (!cut || s->given_up)
    st = add_left(s, at, kept);
  else
    for (int k = 0; k < r->corners && st == DYD_OK; k++) {
      region_part(&part, r, k);
      part.stuck = stuck;
      st = look_at_region(s, &part, from, sites, at, kept, listed);
    }
  return st;
}

/* The square of this side with the lower left corner x, y. */
static void square_region(region *out, int64_t x, int64_t y, int64_t side) {
  *out = (region){0};
  out->corners = 4;
  for (int c = 0; c < 4; c++) {
    out->corner[c][0] = x + (c & 1 ? side : 0);
    out->corner[c][1] = y + (c & 2 ? side : 0);
  }
}

/* The cone behind a side of the square of half side h. */
static void cone_region(region *out, int side, int64_t h) {
  const int64_t end[2] = {MIDDLE - h, MIDDLE + h};
  *out = (region){0};
  out->corners = 2;
  out->cone = true;
  for (int c = 0; c < 2; c++) {
    out->corner[c][side & 1] = end[side >> 1];
    out->corner[c][1 - (side & 1)] = end[c];
  }
}

/* Marks those of site[from .. from+count) that are possible in the cone r, cut a few times. */
static dyd_status mark_outer_sites(bool *is_outer, pair_search *s, const region *r, size_t from, size_t count) {
  region part;
  size_t kept;
  dyd_status st = keep_region_sites(&kept, s, r, from, count);
  from += count;
  for (size_t q = 0; q < kept && st == DYD_OK && r->depth == OUTER_CUTS; q++) is_outer[s->site[from + q]] = true;
  for (int k = 0; k < 2 && st == DYD_OK && r->depth < OUTER_CUTS; k++) {
    region_part(&part, r, k);
    st = mark_outer_sites(is_outer, s, &part, from, kept);
  }
  return st;
}

/* Keeps of site[0 .. *count) those that are possible outside of the first square. */
static dyd_status keep_outer_sites(pair_search *s, size_t *count) {
  size_t outer = 0;
  region r;
  bool *is_outer = calloc(s->sites->count, sizeof *is_outer);
  dyd_status st = is_outer ? DYD_OK : DYD_E_NOMEM;
  for (int side = 0; side < 4 && st == DYD_OK; side++) {
    cone_region(&r, side, HALF);
    st = mark_outer_sites(is_outer, s, &r, 0, *count);
  }
  for (size_t q = 0; q < *count && st == DYD_OK; q++)
    if (is_outer[s->site[q]]) s->site[outer++] = s->site[q];
  *count = outer;
  free(is_outer);
  return st;
}

/* The twelve squares around the one of half side h. */
static dyd_status look_around(pair_search *s, size_t count, int64_t h) {
  const int64_t low = MIDDLE - 2 * h;
  region r;
  dyd_status st = DYD_OK;
  for (int k = 0; k < 16 && st == DYD_OK; k++) {
    int x = k % 4, y = k / 4;
    if (x % 3 && y % 3) continue;
    square_region(&r, low + x * h, low + y * h, h);
    st = look_at_region(s, &r, 0, count, 0, 0, false);
  }
  return st;
}

static dyd_status look_everywhere(pair_search *s, size_t count) {
  region r;
  square_region(&r, MIDDLE - HALF, MIDDLE - HALF, 2 * HALF);
  dyd_status st = look_at_region(s, &r, 0, count, 0, 0, false);
  if (st == DYD_OK) st = keep_outer_sites(s, &count);
  for (int64_t h = HALF; h < LAST && st == DYD_OK; h *= 2) st = look_around(s, count, h);
  for (int side = 0; side < 4 && st == DYD_OK; side++) {
    cone_region(&r, side, LAST);
    st = look_at_region(s, &r, 0, count, 0, 0, false);
  }
  return st;
}

/* ---- all ---- */

static dyd_status index_known(pair_search *s, const dyd_cert_known *known) {
  size_t n = s->sites->count, all = 0, count = 0;
  for (int k = 0; k < 3; k++) all += known->list[k]->count;
  dyd_cert_entry *entry = dyd_alloc(all, sizeof *entry);
  s->first = dyd_alloc(n + 1, sizeof *s->first);
  s->partner = dyd_alloc(all, sizeof *s->partner);
  bool good = entry && s->first && s->partner;
  for (int k = 0; k < 3 && good; k++)
    for (size_t e = 0; e < known->list[k]->count; e++, count++) {
      const dyd_cert_edge *p = &known->list[k]->item[e];
      entry[count].key = p->i;
      entry[count].item = p->j;
    }
  if (good) dyd_cert_by_key(s->first, s->partner, n, entry, count);
  free(entry);
  for (size_t v = 0; v < n && good; v++)
    if (s->first[v + 1] > s->first[v] + 1)
      qsort(s->partner + s->first[v], s->first[v + 1] - s->first[v], sizeof *s->partner, dyd_compare_index);
  return good ? DYD_OK : DYD_E_NOMEM;
}

static void sort_left(dyd_cert_edges *left) {
  size_t kept = 0;
  if (left->count) qsort(left->item, left->count, sizeof *left->item, dyd_cert_compare_edges);
  for (size_t e = 0; e < left->count; e++)
    if (kept == 0 || dyd_cert_compare_edges(&left->item[kept - 1], &left->item[e]) != 0)
      left->item[kept++] = left->item[e];
  left->count = kept;
}

/* All but aliases; returns how many. */
static size_t list_sites(uint32_t *site, const dyd_cert_sites *sites) {
  size_t count = 0;
  for (uint32_t v = 0; v < sites->count; v++)
    if (sites->site[v].alias == v) site[count++] = v;
  return count;
}

dyd_status dyd_cert_boxes_left(dyd_cert_edges *left, bool *given_up, const dyd_cert_sites *sites,
                               const dyd_cert_faces *f, const dyd_cert_known *known) {
  pair_search s = {.sites = sites, .faces = f, .left = left};
  *left = (dyd_cert_edges){0};
  dyd_status st = index_known(&s, known);
  s.stamp = calloc(sites->count ? sites->count : 1, sizeof *s.stamp);
  s.effort_most = ((uint64_t)sites->count + 64) << EFFORT_BITS;
  if (!s.stamp || !dyd_reserve((void **)&s.site, &s.site_cap, sites->count, sizeof *s.site)) st = DYD_E_NOMEM;
  size_t count = st == DYD_OK ? list_sites(s.site, sites) : 0;
  if (count > 1) st = look_everywhere(&s, count);
  *given_up = s.given_up;
  if (s.given_up) left->count = 0;
  sort_left(left);
  free(s.first);
  free(s.partner);
  free(s.site);
  free(s.pair);
  free(s.stamp);
  if (st != DYD_OK) {
    free(left->item);
    *left = (dyd_cert_edges){0};
  }
  return st;
}
