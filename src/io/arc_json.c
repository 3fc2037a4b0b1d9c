/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Exact boundaries as JSON: what each arc lies on, and its ends as integers a, b, c, d of (a + b sqrt(c)) / d. */
#define _POSIX_C_SOURCE 200809L /* open_memstream */
#include "io/arc_json.h"

#include "io/parts.h"
#include "voronoi/surd_point.h"
#include <stdlib.h>

const char *const dyd_feature_names[8] = {"x0y0", "x1y0", "x0y1", "x1y1", "x0", "x1", "y0", "y1"};
const char *const dyd_arc_names[3] = {"line", "parabola", "window"};
const char *const dyd_end_names[5] = {"infinite", "sites", "axis", "feature", "window"};

/* {"x": {"a": "..", "b": "..", "c": "..", "d": ".."}, ...}: the point (a + b sqrt(c)) / d with integers, and its
 * decimal enclosure. */
static dyd_status surd_point_json(FILE *out, const dyd_surd_point *p) {
  gmp_fprintf(out,
              "{\"x\": {\"a\": \"%Zd\", \"b\": \"%Zd\"}, \"y\": {\"a\": \"%Zd\", \"b\": \"%Zd\"}, \"c\": \"%Zd\", "
              "\"d\": \"%Zd\"",
              p->ax, p->bx, p->ay, p->by, p->c, p->d);
  double box[4];
  dyd_rect r;
  dyd_rect_init(&r);
  dyd_status st = dyd_surd_point_enclose(&r, p, 64);
  if (st == DYD_OK) {
    dyd_rect_get_d(box, &r);
    fputs(", ", out);
    dyd_json_box(out, "_decimal", box);
  }
  fputs("}", out);
  dyd_rect_clear(&r);
  return st;
}

/* ---- texts kept ---- */

void dyd_point_texts_clear(dyd_point_texts *t) {
  for (size_t k = 0; k < DYD_POINT_TEXTS; k++) {
    if (t->text[k]) dyd_surd_point_clear(&t->point[k]);
    free(t->text[k]);
    t->text[k] = NULL;
  }
}

static bool surd_point_is_same(const dyd_surd_point *p, const dyd_surd_point *q) {
  return !mpz_cmp(p->ax, q->ax) && !mpz_cmp(p->ay, q->ay) && !mpz_cmp(p->d, q->d) && !mpz_cmp(p->bx, q->bx) &&
         !mpz_cmp(p->by, q->by) && !mpz_cmp(p->c, q->c);
}

/* The text of p, made if need be; borrowed from t until 64 others were made. */
static dyd_status find_point_text(const char **out, dyd_point_texts *t, const dyd_surd_point *p) {
  char *text = NULL;
  size_t size = 0;
  for (size_t k = 0; k < DYD_POINT_TEXTS; k++)
    if (t->text[k] && surd_point_is_same(&t->point[k], p)) return *out = t->text[k], DYD_OK;
  FILE *memory = open_memstream(&text, &size);
  if (!memory) return DYD_E_NOMEM;
  dyd_status st = surd_point_json(memory, p);
  bool good = !ferror(memory);
  if (fclose(memory) != 0 || !good) st = DYD_E_NOMEM;
  if (st != DYD_OK) {
    free(text);
    return st;
  }
  size_t k = t->next++ % DYD_POINT_TEXTS;
  if (!t->text[k]) dyd_surd_point_init(&t->point[k]);
  dyd_surd_point_set(&t->point[k], p);
  free(t->text[k]);
  *out = t->text[k] = text;
  return DYD_OK;
}

/* ---- arcs ---- */

static dyd_status arc_end_json(FILE *out, const char *name, const dyd_arc_end *end, dyd_point_texts *texts) {
  fprintf(out, ",\n  \"%s\": {\"kind\": \"%s\"", name, dyd_end_names[end->kind]);
  dyd_status st = DYD_OK;
  if (end->kind == DYD_END_SITES) fprintf(out, ", \"site\": %zu", dyd_engine_row(texts->engine, end->site));
  if (end->kind != DYD_END_INFINITE) {
    const char *text = "";
    st = find_point_text(&text, texts, &end->at);
    fputs(", \"at\": ", out);
    fputs(text, out);
  }
  fputs("}", out);
  return st;
}

static dyd_status arc_json(FILE *out, const dyd_arc *arc, dyd_point_texts *texts) {
  fprintf(out, "\n {\"kind\": \"%s\"", dyd_arc_names[arc->kind]);
  if (arc->kind != DYD_ARC_WINDOW)
    fprintf(out, ", \"far\": %zu, \"corner\": \"%s\", \"near\": %zu, \"feature\": \"%s\"",
            dyd_engine_row(texts->engine, arc->far_site), dyd_feature_names[arc->corner],
            dyd_engine_row(texts->engine, arc->near_site), dyd_feature_names[arc->feature]);
  dyd_status st = arc_end_json(out, "begin", &arc->begin, texts);
  if (st == DYD_OK) st = arc_end_json(out, "end", &arc->end, texts);
  fputs("}", out);
  return st;
}

dyd_status dyd_boundary_json(FILE *out, const dyd_boundary *b, dyd_point_texts *texts) {
  dyd_status st = DYD_OK;
  fprintf(out, "{\"whole\": %s, \"chains\": [", b->whole ? "true" : "false");
  for (size_t k = 0; k < b->count && st == DYD_OK; k++) {
    fprintf(out, "%s{\"closed\": %s, \"arcs\": [", k ? ", " : "", b->chain[k].closed ? "true" : "false");
    for (size_t a = 0; a < b->chain[k].count && st == DYD_OK; a++) {
      if (a) fputs(",", out);
      st = arc_json(out, &b->chain[k].arc[a], texts);
    }
    fputs("]}", out);
  }
  fputs("]}", out);
  return st;
}
