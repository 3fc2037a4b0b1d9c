/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Pairs of open sets proved illegal all together, by boxes that cover the plane. */
#ifndef DYD_CHECKER_BOXES_H
#define DYD_CHECKER_BOXES_H

#include "checker/faces.h"

/* What is known of pairs: sorted lists without repeats, borrowed. */
typedef struct dyd_cert_known {
  const dyd_cert_edges *list[3];
} dyd_cert_known;

/* left = the pairs within open sets that are in no list and that boxes do not prove illegal [CERT-9], sorted; *given_up
 * (and no pairs): too much work, nothing is proved. Released by free(left->item). The same input gives the same. Cost:
 * about N log N, and in proportion to the length of what lies between the regions of pairs that nearly meet. */
dyd_status dyd_cert_boxes_left(dyd_cert_edges *left, bool *given_up, const dyd_cert_sites *s, const dyd_cert_faces *f,
                               const dyd_cert_known *known);

#endif
