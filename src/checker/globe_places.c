/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The places of a certificate on a sphere, and where each may be. */
#include "base/local.h"
#include "checker/globe.h"

#include <stdlib.h>

void dyd_cert_globe_init(dyd_cert_globe *g) {
  *g = (dyd_cert_globe){0};
  dyd_cert_sites_init(&g->place);
  dyd_cert_lens_init(&g->lens);
  mpq_init(g->radius);
}

void dyd_cert_globe_clear(dyd_cert_globe *g) {
  for (size_t i = 0; g->metres && !g->borrowed && i < g->place.count; i++) dyd_exact_clear(&g->metres[i]);
  if (!g->borrowed) free(g->metres);
  if (!g->borrowed) dyd_cert_sites_clear(&g->place);
  free(g->of);
  free(g->image);
  free(g->kind);
  dyd_cert_lens_clear(&g->lens);
  mpq_clear(g->radius);
}

/* The mean radius of the earth (IUGG) is 6371008.8 metres. */
static void angle_of_metres(mpq_ptr x) {
  DYD_LOCAL_NUMBERS(mpq, metre);
  mpq_set_ui(metre, 5, 31855044);
  mpq_mul(x, x, metre);
}

bool dyd_cert_globe_region(dyd_cert_region *out, const dyd_cert_globe *g, uint32_t i) {
  DYD_LOCAL_NUMBERS(mpq, angle, degrees);
  dyd_cert_exact_to_q(angle, &g->metres[i], NULL);
  if (g->ground) mpq_add(angle, angle, g->radius);
  angle_of_metres(angle);
  if (!g->ground) mpq_set(degrees, g->radius);
  return dyd_cert_region_set(out, g->place.site[i].side, degrees, angle);
}
