/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Certificates on a sphere: one eye or two, and what of them is proved [CERT-14].
 *
 * Seen from a place that may be wide all images are wide; from a gap only pairs about it are lost. So a second
 * certificate may follow, of the same places from a second eye: each proves what it states, and open is what is open in
 * both. */
#include "base/alloc.h"
#include "base/local.h"
#include "checker/checker.h"

#include <stdlib.h>

/* ---- two eyes ---- */

dyd_checker *dyd_checker_room(void) {
  return malloc(sizeof(dyd_checker));
}

/* Leaves of the open pairs those that are open from the second eye, too. */
void dyd_checker_join(dyd_checker *c) {
  const dyd_cert_globe *g = &c->globe;
  size_t *open = &c->report.indeterminate;
  *open = 0;
  for (size_t e = 0; e < c->open.count; e++) {
    const dyd_cert_edge *p = &c->open.item[e];
    if (dyd_cert_edges_have(&c->tie, p->i, p->j)) continue;
    *open += dyd_checker_is_open(c->second, g->of[p->i], g->of[p->j]);
  }
  for (uint32_t k = 0; k < c->sites.count; k++)
    *open += g->kind[k] == 'o' && dyd_checker_is_open(c->second, g->of[k], g->eye);
}

/* ---- what is proved ---- */

static bool lens_is_wide(const dyd_cert_globe *g) {
  return mpq_sgn(g->lens.eye.half[0]) || mpq_sgn(g->lens.eye.half[1]);
}

/* An image stays where place and eye do, and one of them is wide: else it is a point, of which digits are asked. */
void dyd_checker_still_images(bool *still, const dyd_checker *c, const bool *place_still) {
  const dyd_cert_globe *g = &c->globe;
  bool wide = lens_is_wide(g), fixed = g->gap || !wide;
  if (!fixed) fixed = place_still ? place_still[g->eye] : dyd_cert_is_point(&g->place.site[g->eye]);
  for (size_t k = 0; k < c->sites.count; k++) {
    uint32_t i = g->of[k];
    bool point = dyd_cert_is_point(&g->place.site[i]), own = mpq_sgn(g->radius) || dyd_exact_sgn(&g->metres[i]);
    still[k] = fixed && (place_still ? place_still[i] : point) && (wide || own || !point);
  }
}

/* Do all images stay? */
static bool all_stay(const dyd_checker *c, const bool *still) {
  for (size_t k = 0; k < c->sites.count; k++)
    if (!still[k] && c->sites.site[k].alias == k) return false;
  return true;
}

dyd_status dyd_checker_stays_on_sphere(bool *stays, dyd_checker *c, const bool *place_still) {
  DYD_FREED bool *still = dyd_alloc(c->sites.count, sizeof *still);
  if (!still) return DYD_E_NOMEM;
  dyd_checker_still_images(still, c, place_still);
  dyd_status st = dyd_checker_stays(stays, c, still);
  if (!all_stay(c, still)) *stays = *stays && !lens_is_wide(&c->globe) && dyd_checker_is_closed_around(c);
  *stays = *stays && !c->report.images_unproved && !c->report.around_unproved;
  return st;
}
