/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The section of a certificate on a sphere: the places whose images its sites are, and who is a neighbour of the eye.
 */
#ifndef DYD_CHECKER_GLOBE_H
#define DYD_CHECKER_GLOBE_H

#include "checker/globe_near.h"
#include "checker/image.h"

typedef struct dyd_cert_globe {
  bool stated;
  dyd_cert_sites place; /* longitudes and latitudes as they are stated; alias */
  dyd_exact *metres;    /* of each place, how far it may be from there */
  size_t metres_cap;
  mpq_t radius; /* of all: degrees; metres on the ground */
  bool ground;
  bool gap;     /* no place is the eye */
  uint32_t eye; /* the place that is; meaningless in a gap */
  dyd_cert_lens lens;
  bool borrowed;   /* places and metres are those of the first certificate */
  uint32_t *of;    /* site k is the image of place of[k] */
  uint32_t *image; /* and image[i] is that of place i; DYD_CERT_NONE: it has none */
  char *kind;      /* of each site: l, t, o as stated; 0 */
  size_t listed;
  const char *outcome;
} dyd_cert_globe;

void dyd_cert_globe_init(dyd_cert_globe *g);
void dyd_cert_globe_clear(dyd_cert_globe *g);
/* Sets out to where place i may be; false: at no latitude within 90, or its radius is above that of the earth. */
bool dyd_cert_globe_region(dyd_cert_region *out, const dyd_cert_globe *g, uint32_t i);

#endif
