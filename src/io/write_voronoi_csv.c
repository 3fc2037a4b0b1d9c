/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The csv format of the Voronoi diagram: cells with areas, vertices with enclosures, undecided regions. */
#include "base/alloc.h"
#include "base/error.h"
#include "io/diagram.h"
#include <math.h>

static void put(FILE *out, double x, dyd_round dir) {
  char text[DYD_DECIMAL_SIZE] = "";
  if (isfinite(x)) dyd_decimal_directed(text, x, 17, dir);
  fputc(',', out);
  fputs(text, out);
}

static void put_box(FILE *out, const double b[4]) {
  for (int k = 0; k < 4; k++) put(out, b[k], k & 1 ? DYD_UP : DYD_DOWN);
}

static dyd_status keep_row(void *context, uint32_t i, const dyd_shape *shape, const dyd_cell_row *row) {
  (void)shape;
  dyd_cell_row *rows = context;
  rows[i] = *row;
  return DYD_OK;
}

static dyd_status write_exact(FILE *out, const char *name, const dyd_dyadic *x) {
  char *text = dyd_dyadic_get_str(x);
  if (!text) return DYD_E_NOMEM;
  fprintf(out, "%s%s", name, text);
  free(text);
  return DYD_OK;
}

static dyd_status write_head(const dyd_diagram *d) {
  FILE *out = d->out;
  for (size_t i = 0; i < d->count; i++) {
    uint32_t of = dyd_delaunay_alias(d->pd, (uint32_t)i);
    if (of != i) fprintf(out, "# alias %zu %u\n", i, (unsigned)of);
  }
  dyd_status status = write_exact(out, "# window ", &d->window.x.lo);
  if (status >= 0) status = write_exact(out, " ", &d->window.x.hi);
  if (status >= 0) status = write_exact(out, " ", &d->window.y.lo);
  if (status >= 0) status = write_exact(out, " ", &d->window.y.hi);
  fputs("\n# undetermined_area", out);
  put(out, dyd_dyadic_get_d(&d->bounds.area, DYD_UP), DYD_UP);
  fputs("\n# distance_to_true_diagram", out);
  put(out, d->bounds.finite ? dyd_dyadic_get_d(&d->bounds.hausdorff, DYD_UP) : INFINITY, DYD_UP);
  fputs("\n# rounding: lo down, hi up, bounds up; empty: unbounded or beyond doubles; m*2^e is exact\n"
        "type,i,j,k,xlo,xhi,ylo,yhi,area_lo,area_hi\n",
        out);
  return status;
}

static void write_cells(const dyd_diagram *d, const dyd_cell_row *rows) {
  for (size_t i = 0; i < d->count; i++) {
    if (!rows[i].present) continue;
    fprintf(d->out, "cell,%zu,,", i);
    put_box(d->out, rows[i].box);
    put(d->out, rows[i].area[0], DYD_DOWN);
    put(d->out, rows[i].area[1], DYD_UP);
    fputc('\n', d->out);
  }
}

static dyd_status put_exact(const dyd_diagram *d, size_t k) {
  char *text[4];
  dyd_status status = dyd_diagram_vertex(text, d, k);
  for (int m = 0; m < 4; m++) {
    if (status >= 0) fprintf(d->out, ",%s", text[m]);
    free(text[m]);
  }
  return status;
}

/* Where a goal asks for more than decimals of 17 digits show, the enclosures are exact numbers. */
static dyd_status write_vertices(const dyd_diagram *d) {
  int64_t goal_bits;
  bool exact = dyd_engine_goal(&goal_bits, d->engine) == DYD_GOAL_VORONOI_HAUSDORFF && goal_bits > 32;
  dyd_status status = DYD_OK;
  for (size_t k = 0; k < d->triangles.count && status >= 0; k++) {
    const uint32_t *v = d->triangles.item[k].v;
    fprintf(d->out, "vertex,%u,%u,%u", (unsigned)v[0], (unsigned)v[1], (unsigned)v[2]);
    if (exact)
      status = put_exact(d, k);
    else
      put_box(d->out, d->vertex[k]);
    fputs(",,\n", d->out);
  }
  return status;
}

static dyd_status write_region(void *context, size_t face, const double box[4]) {
  FILE *out = context;
  if (!box) return DYD_OK;
  fprintf(out, "region,%zu,,", face);
  put_box(out, box);
  fputs(",,\n", out);
  return DYD_OK;
}

dyd_status dyd_write_voronoi_csv(dyd_diagram *d, dyd_error *err) {
  dyd_cell_row *rows = calloc(d->count ? d->count : 1, sizeof *rows);
  if (!rows) return dyd_fail_nomem(err);
  dyd_status status = dyd_diagram_visit(d, keep_row, rows);
  if (status >= 0) status = write_head(d);
  if (status >= 0) {
    write_cells(d, rows);
    status = write_vertices(d);
    if (status >= 0) status = dyd_diagram_regions(d, write_region, d->out);
  }
  free(rows);
  return status < 0 ? dyd_fail(err, status, "%s", dyd_status_text(status)) : DYD_OK;
}
