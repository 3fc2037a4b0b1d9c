/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Four points, nearly the corners of a rectangle: the third is (3, e), e given by its continued fraction
 * [2; 1, 2, 1, 1, 4, 1, 1, 6, ...]; the fourth is (0, d), d the double next to e. Which diagonal is Delaunay? */
#include <dyadel/dyadel.h>
#include <inttypes.h>
#include <stdio.h>

/* Narrows the point (3, e) to a height of 2^-bits: e lies between two successive convergents p/q. */
static dyd_status narrow(dyd_rect *out, void *user, const dyd_request *request, dyd_error *err) {
  (void)user, (void)err;
  mpq_t three, older, newer, width, goal;
  mpq_inits(three, older, newer, width, goal, NULL);
  mpq_set_ui(three, 3, 1);
  mpq_set_ui(older, 1, 0); /* the convergents start with 1/0 and 2/1 */
  mpq_set_ui(newer, 2, 1);
  mpq_set_ui(goal, 1, 1);
  mpq_div_2exp(goal, goal, (mp_bitcnt_t)(request->bits + 1));
  for (unsigned long k = 1; k < 3 || mpq_cmp(width, goal) > 0; k++) {
    unsigned long term = k % 3 == 2 ? 2 * (k / 3 + 1) : 1;
    mpz_addmul_ui(mpq_numref(older), mpq_numref(newer), term);
    mpz_addmul_ui(mpq_denref(older), mpq_denref(newer), term);
    mpq_swap(older, newer);
    mpq_sub(width, newer, older);
    mpq_abs(width, width);
  }
  int up = mpq_cmp(older, newer) < 0;
  dyd_status status = dyd_interval_set_q(&out->x, three);
  if (status == DYD_OK) /* rounded outward to multiples of 2^-(bits+2) */
    status = dyd_interval_set_outward(&out->y, up ? older : newer, up ? newer : older, -request->bits - 2);
  mpq_clears(three, older, newer, width, goal, NULL);
  return status;
}

int main(void) {
  const double x[] = {0, 3}, y[] = {0, 0}, left = 0, d = 2.718281828459045;
  const dyd_source source = {DYD_SIZED(dyd_source), .narrow = narrow};
  dyd_engine *engine = NULL;
  dyd_outcome outcome = DYD_OUTCOME_NONE;
  dyd_pair_list pairs = {0};
  dyd_error err;
  dyd_status status = dyd_engine_new(&engine);
  if (status >= 0) status = dyd_engine_add_points(engine, 2, x, y);          /* points 0 and 1 */
  if (status >= 0) status = dyd_engine_add_source(engine, 1, &source, NULL); /* point 2 */
  if (status >= 0) status = dyd_engine_add_points(engine, 1, &left, &d);
  if (status >= 0) status = dyd_engine_run(&outcome, engine, NULL, &err);
  if (status >= 0) status = dyd_delaunay_pairs(&pairs, dyd_engine_delaunay(engine));
  printf("%s\n", status < 0 ? dyd_status_text(status) : dyd_outcome_text(outcome));
  for (size_t k = 0; k < pairs.count; k++)
    printf("%" PRIu32 " %" PRIu32 " %s\n", pairs.item[k].i, pairs.item[k].j,
           pairs.item[k].status == DYD_LEGAL ? "legal" : "not decided");
  dyd_pair_list_clear(&pairs);
  dyd_engine_free(engine);
  return status < 0;
}
