/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Serves the truth harness by the C API: a line "boxes N [xlo,xhi] [ylo,yhi] ..." or "source N X Y ..." (fractions,
 * points of a callback) is answered by one line of json. */
#include <dyadel/dyadel.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct places {
  size_t count;
  mpq_t *q; /* x and y of each */
} places;

/* Between multiples of 2^-(bits+2) around the place; the same ends again are within the old ones. */
static dyd_status narrow(dyd_rect *out, void *user, const dyd_request *request, dyd_error *err) {
  const places *p = user;
  (void)err;
  dyd_status status = DYD_OK;
  for (int k = 0; k < 2 && status == DYD_OK; k++) {
    mpq_t *q = &p->q[2 * request->point + k];
    status = dyd_interval_set_outward(k ? &out->y : &out->x, *q, *q, -request->bits - 2);
  }
  return status;
}

static dyd_status add_boxes(dyd_engine *e, size_t n, dyd_error *err) {
  dyd_rect r;
  dyd_status status = DYD_OK;
  dyd_rect_init(&r);
  for (size_t k = 0; k < n && status >= 0; k++) {
    char *x = strtok(NULL, " \n"), *y = strtok(NULL, " \n");
    if (!x || !y) return dyd_rect_clear(&r), DYD_E_ARG;
    x[strlen(x)] = ' '; /* one line again */
    status = dyd_rect_set_text(&r, x, (size_t)(y - x) + strlen(y), err);
    if (status >= 0) status = dyd_engine_add_rect(e, &r, err);
  }
  dyd_rect_clear(&r);
  return status;
}

static dyd_status add_source(dyd_engine *e, places *p, dyd_error *err) {
  for (size_t k = 0; k < 2 * p->count; k++) {
    const char *text = strtok(NULL, " \n");
    if (!text || mpq_set_str(p->q[k], text, 10) != 0) return DYD_E_ARG;
  }
  const dyd_source source = {DYD_SIZED(dyd_source), .narrow = narrow, .user = p};
  return dyd_engine_add_source(e, p->count, &source, err);
}

static void print_pairs(const dyd_engine *e, dyd_outcome outcome) {
  const char *const name[] = {"illegal", "tie", "indeterminate", "legal"};
  const dyd_delaunay *pd = dyd_engine_delaunay(e);
  dyd_pair_list pairs = {0};
  printf("{\"outcome\": \"%s\", \"pairs\": [", dyd_outcome_text(outcome));
  if (dyd_delaunay_pairs(&pairs, pd) >= 0)
    for (size_t k = 0; k < pairs.count; k++)
      printf("%s[%u, %u, \"%s\"]", k ? ", " : "", pairs.item[k].i, pairs.item[k].j, name[pairs.item[k].status]);
  printf("], \"aliases\": [");
  const char *before = "";
  for (uint32_t i = 0; i < dyd_engine_count(e); i++) {
    uint32_t of = dyd_delaunay_alias(pd, i);
    if (of == i) continue;
    printf("%s[%u, %u]", before, i, of);
    before = ", ";
  }
  puts("]}");
  dyd_pair_list_clear(&pairs);
}

static void answer(char *line) {
  const char *kind = strtok(line, " \n"), *count = strtok(NULL, " \n");
  places p = {count ? strtoul(count, NULL, 10) : 0, NULL};
  dyd_engine *e = NULL;
  dyd_outcome outcome = DYD_OUTCOME_NONE;
  dyd_error err = {0};
  dyd_status status = dyd_engine_new(&e);
  p.q = calloc(2 * p.count + 1, sizeof *p.q);
  if (!p.q) exit(1);
  for (size_t k = 0; k < 2 * p.count; k++) mpq_init(p.q[k]);
  if (status >= 0) status = kind && strcmp(kind, "source") == 0 ? add_source(e, &p, &err) : add_boxes(e, p.count, &err);
  if (status >= 0) status = dyd_engine_run(&outcome, e, NULL, &err);
  if (status >= 0)
    print_pairs(e, outcome);
  else
    printf("{\"error\": \"%s\"}\n", dyd_status_text(status));
  dyd_engine_free(e);
  for (size_t k = 0; k < 2 * p.count; k++) mpq_clear(p.q[k]);
  free(p.q);
}

int main(void) {
  char *line = NULL;
  size_t room = 0;
  while (getline(&line, &room, stdin) > 0) {
    answer(line);
    fflush(stdout);
  }
  free(line);
  return 0;
}
