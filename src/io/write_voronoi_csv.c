/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The csv format of the Voronoi diagram: cells with areas, vertices with enclosures, undecided regions. */
#include "io/diagram.h"
#include "io/label_text.h"
#include "io/parts.h"
#include <math.h>
#include <stdlib.h>

static void csv_decimal(FILE *out, double x, dyd_round dir) {
  fputc(',', out);
  dyd_decimal_put(out, x, dir, "");
}

static void csv_box(FILE *out, const double b[4]) {
  for (int k = 0; k < 4; k++) csv_decimal(out, b[k], k & 1 ? DYD_UP : DYD_DOWN);
}

static dyd_status keep_row(void *context, uint32_t i, const dyd_shape *shape, const dyd_cell_row *row) {
  (void)shape;
  dyd_cell_row *rows = context;
  rows[i] = *row;
  return DYD_OK;
}

static dyd_status cells_csv_head(const dyd_diagram *d) {
  FILE *out = d->out;
  dyd_csv_aliases(out, d->engine);
  fputs("# window ", out);
  dyd_status st = dyd_put_window(out, &d->window, "", " ");
  fputs("\n# undetermined_area", out);
  csv_decimal(out, dyd_dyadic_get_d(&d->bounds->area, DYD_UP), DYD_UP);
  fputs("\n# distance_to_true_diagram", out);
  csv_decimal(out, d->bounds->finite ? dyd_dyadic_get_d(&d->bounds->hausdorff, DYD_UP) : INFINITY, DYD_UP);
  fprintf(out,
          "\n# rounding: lo down, hi up, bounds up; empty: unbounded or beyond doubles; m*2^e is exact\n"
          "type,i,j,k,xlo,xhi,ylo,yhi,area_lo,area_hi%s\n",
          dyd_csv_id_head(d->engine, 3));
  return st;
}

static void csv_cells(const dyd_diagram *d, const dyd_cell_row *rows) {
  for (uint32_t i = 0; i < d->count; i++) {
    if (!rows[i].present) continue;
    fprintf(d->out, "cell,%zu,,", dyd_engine_row(d->engine, i));
    csv_box(d->out, rows[i].box);
    csv_decimal(d->out, rows[i].area[0], DYD_DOWN);
    csv_decimal(d->out, rows[i].area[1], DYD_UP);
    dyd_csv_row_end(d->out, d->engine, &i, 1);
  }
}

static dyd_status csv_exact_vertex(const dyd_diagram *d, size_t k) {
  char *text[4];
  dyd_status st = dyd_diagram_vertex(text, d, k);
  for (int m = 0; m < 4; m++) {
    if (st == DYD_OK) fprintf(d->out, ",%s", text[m]);
    free(text[m]);
  }
  return st;
}

/* Where a goal asks for more than decimals of 17 digits show, the enclosures are exact numbers. */
static dyd_status csv_vertices(const dyd_diagram *d) {
  int64_t goal_bits;
  bool exact = dyd_engine_goal(&goal_bits, d->engine) == DYD_GOAL_VORONOI_HAUSDORFF && goal_bits > 32;
  dyd_status st = DYD_OK;
  for (size_t k = 0; k < d->triangles.count && st == DYD_OK; k++) {
    const uint32_t *v = d->triangles.item[k].v;
    fprintf(d->out, "vertex,%zu,%zu,%zu", dyd_engine_row(d->engine, v[0]), dyd_engine_row(d->engine, v[1]),
            dyd_engine_row(d->engine, v[2]));
    if (exact)
      st = csv_exact_vertex(d, k);
    else
      csv_box(d->out, d->vertex[k]);
    fputs(",,", d->out);
    dyd_csv_row_end(d->out, d->engine, v, 3);
  }
  return st;
}

static dyd_status csv_region(void *context, size_t face, const double box[4]) {
  const dyd_diagram *d = *(const dyd_diagram *const *)context;
  if (!box) return DYD_OK;
  fprintf(d->out, "region,%zu,,", face);
  csv_box(d->out, box);
  fputs(",,", d->out);
  dyd_csv_row_end(d->out, d->engine, NULL, 0);
  return DYD_OK;
}

dyd_status dyd_voronoi_csv(const dyd_output *o) {
  const dyd_diagram *d = o->what;
  dyd_cell_row *rows = calloc(d->count ? d->count : 1, sizeof *rows);
  if (!rows) return DYD_E_NOMEM;
  dyd_status st = dyd_diagram_visit(d, keep_row, rows);
  if (st == DYD_OK) st = cells_csv_head(d);
  if (st == DYD_OK) {
    csv_cells(d, rows);
    st = csv_vertices(d);
  }
  if (st == DYD_OK) st = dyd_diagram_regions(d, csv_region, &d);
  free(rows);
  return st;
}
