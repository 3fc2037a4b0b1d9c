/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Is a centre a witness? The grid excludes who is surely farther; the others are compared exactly. */
#include "checker/witness.h"

typedef struct site_search {
  const dyd_cert_sites *sites;
  const dyd_exact *c;
  uint32_t i, j, other;
  dyd_cert_measure measure;
  dyd_cert_fraction radius2, here;
} site_search;

static bool is_outside_disc(void *context, uint32_t k) {
  site_search *s = context;
  if (k == s->i || k == s->j) return true;
  dyd_cert_distance2(&s->here, s->c, &s->sites->site[k], s->measure);
  if (dyd_cert_fraction_cmp(&s->radius2, &s->here) < 0) return true;
  s->other = k;
  return false;
}

bool dyd_cert_is_witness(uint32_t *other, const dyd_cert_sites *s, const dyd_cert_tree *t, uint32_t i, uint32_t j,
                         const dyd_exact c[2], bool places) {
  dyd_cert_centre centre;
  dyd_cert_centre_set(&centre, s, c);
  site_search q = {.sites = s, .c = c, .i = i, .j = j, .measure = places ? DYD_CERT_PLACE : DYD_CERT_NEAR};
  dyd_cert_fraction_init(&q.radius2);
  dyd_cert_fraction_init(&q.here);
  dyd_cert_measure own = places ? DYD_CERT_PLACE : DYD_CERT_FAR;
  dyd_cert_distance2(&q.radius2, c, &s->site[i], own);
  dyd_cert_distance2(&q.here, c, &s->site[j], own);
  if (dyd_cert_fraction_cmp(&q.here, &q.radius2) > 0) dyd_cert_fraction_swap(&q.here, &q.radius2);
  dyd_cert_area limit = 0;
  if (!centre.far) {
    dyd_cert_area a = dyd_cert_far_upper(&centre, &s->box[i]), b = dyd_cert_far_upper(&centre, &s->box[j]);
    limit = a > b ? a : b;
  }
  bool good = dyd_cert_tree_visit(t, &centre, limit, is_outside_disc, &q);
  if (!good && other) *other = q.other;
  dyd_cert_fraction_clear(&q.radius2);
  dyd_cert_fraction_clear(&q.here);
  return good;
}
