/* SPDX-License-Identifier: LGPL-3.0-or-later */
#include <dyadel/dyadel.h>
#include <stdio.h>

int main(void) { /* four points x y; radius 0.01: each lies in a square of half-width 0.01 */
  const double xy[] = {0, 0, 3, 0, 3, 2.75, 0, 2.5};
  dyd_pair_list pairs = {0};
  dyd_error err;
  if (dyd_delaunay_of(&pairs, 4, xy, 0.01, NULL, &err) != DYD_OK) return puts(err.message), 1;
  for (size_t k = 0; k < pairs.count; k++)
    printf("%u %u %s\n", pairs.item[k].i, pairs.item[k].j, dyd_pair_status_text(pairs.item[k].status));
  dyd_pair_list_clear(&pairs);
}
