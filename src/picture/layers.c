/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Pictures as tables of layers: draws the rows in their order, and writes the legend from them. */
#include "base/invariant.h"
#include "io/diagram.h"
#include "picture/picture.h"

#include <math.h>
#include <string.h>

#define FOOT 140.0 /* room of coordinates and legend */

/* What a style draws, as a key can show it. */
static bool key_suits(const dyd_picture_layer *l) {
  const dyd_picture_style *s = &l->style;
  if (s->levels) return l->key == DYD_KEY_SQUARES && l->entry;
  if (l->key == DYD_KEY_NONE) return s->fill || s->stroke;
  return l->key == DYD_KEY_LINE
             ? s->stroke != DYD_NO_COLOUR && (s->lines > 0 || s->points > 0)
             : s->fill && s->fill != DYD_NO_COLOUR && (l->key == DYD_KEY_PATCH || l->key == DYD_KEY_DOT);
}

bool dyd_picture_is_whole(const dyd_picture_table *t) {
  bool whole = t->count > 0 && t->count <= DYD_PICTURE_LAYERS_MOST && t->row[0].walk;
  for (size_t k = 0; k < t->count && whole; k++) {
    const dyd_picture_layer *l = &t->row[k];
    whole = key_suits(l) && l->text && *l->text && (l->place > 0) == (l->key != DYD_KEY_NONE);
    whole = whole && l->place <= DYD_PICTURE_LAYERS_MOST;
  }
  return whole;
}

void dyd_picture_seen(dyd_picture *p, const dyd_picture_layer *l) {
  p->drawn[l - p->table->row]++;
}

void dyd_picture_tint(dyd_picture *p, const dyd_picture_layer *l, unsigned rgb) {
  const dyd_picture_style *s = &l->style;
  const double width = p->view->line * s->lines + s->points, unit = fmax(width, 0.7);
  dyd_canvas_paint(p->canvas, &(dyd_paint){rgb, s->stroke, 1, width, s->on * unit, s->off * unit});
  dyd_picture_seen(p, l);
}

void dyd_picture_paint(dyd_picture *p, const dyd_picture_layer *l) {
  dyd_picture_tint(p, l, l->style.fill);
}

void dyd_frame_walk(dyd_picture *p, const dyd_picture_layer *l) {
  dyd_view_frame_path(p->canvas, p->view);
  dyd_picture_paint(p, l);
}

bool dyd_picture_join(dyd_picture *p, const dyd_result *r, uint32_t i, uint32_t j) {
  double b[4], z[2][2];
  for (int e = 0; e < 2; e++) {
    dyd_sites_get_d(b, r->sites, e ? j : i);
    dyd_view_middle(z[e], p->view, b);
  }
  if (!dyd_clip_segment(z, p->view->frame)) return false;
  dyd_canvas_segment(p->canvas, z);
  return true;
}

void dyd_lines_walk(dyd_picture *p, const dyd_picture_layer *l) {
  for (size_t k = 0; k < p->lines.count; k++) {
    const int kind = p->lines.kind ? p->lines.kind(p, k) : dyd_pairs_kind(p, k);
    if (kind != l->kind || !p->lines.path(p, k) || !p->lines.name) continue;
    p->lines.name(p, l, k);
    dyd_picture_paint(p, l);
  }
}

static void draw_layers(dyd_picture *p, dyd_canvas *c) {
  p->canvas = c;
  memset(p->drawn, 0, sizeof p->drawn);
  for (const dyd_picture_layer *l = p->table->row; l < p->table->row + p->table->count && p->st == DYD_OK; l++) {
    if (l->walk) l->walk(p, l);
    if (c->count) dyd_picture_paint(p, l);
  }
}

/* ---- the page ---- */

/* Layers of one place follow the table. */
static void write_legend(const dyd_picture *p) {
  const dyd_picture_table *t = p->table;
  dyd_legend legend;
  if (p->st != DYD_OK) return;
  dyd_legend_begin(&legend, p->canvas, p->view);
  for (unsigned place = 1; place <= DYD_PICTURE_LAYERS_MOST; place++)
    for (const dyd_picture_layer *l = t->row; l < t->row + t->count; l++) {
      if (l->place != place) continue;
      if (l->entry)
        l->entry(&legend, p, l);
      else if (dyd_picture_drawn(p, l))
        dyd_legend_put(&legend, l, l->text);
    }
  if (t->notes) t->notes(&legend, p);
}

/* The page: the frame alone, or with coordinates and a legend as low as it gets. */
static dyd_status page_of_view(dyd_page *page, double box[4], dyd_picture *p, const dyd_output *o) {
  dyd_output nowhere = *o;
  const dyd_view *v = p->view;
  memcpy(box, v->frame, sizeof v->frame);
  dyd_status st = dyd_page_fit(page, o, o->style.bare ? box[1] - box[0] : v->width,
                               o->style.bare ? 0 : DYD_VIEW_LEFT + DYD_VIEW_EDGE);
  if (st != DYD_OK || o->style.bare) return st;
  box[0] = DYD_VIEW_LEFT * (1 - page->text);
  box[1] = box[0] + v->width + (DYD_VIEW_LEFT + DYD_VIEW_EDGE) * page->text;
  box[2] = 0, box[3] = ceil(v->height + DYD_VIEW_EDGE + FOOT);
  if (page->scale == 1) box[1] = ceil(box[1]);
  if (page->text == 1) return DYD_OK;
  nowhere.format = DYD_FORMAT_CSV;
  dyd_canvas *c = dyd_canvas_new(&nowhere, page, box, "");
  if (c) {
    draw_layers(p, c); /* the legend lists layers that were drawn */
    write_legend(p);
    box[3] = c->low + 10 * page->text;
  }
  return dyd_canvas_end(c, DYD_OK, o->err);
}

dyd_status dyd_picture_write(dyd_picture *p, const dyd_output *o) {
  dyd_page page;
  double box[4];
  DYD_INVARIANT(dyd_picture_is_whole(p->table));
  dyd_status st = page_of_view(&page, box, p, o);
  dyd_canvas *c = st == DYD_OK ? dyd_canvas_new(o, &page, box, p->title) : NULL;
  if (!c) return st == DYD_OK ? DYD_E_NOMEM : st;
  dyd_view_frame_path(c, p->view);
  dyd_canvas_clip(c);
  draw_layers(p, c);
  dyd_canvas_unclip(c);
  if (!o->style.bare) {
    dyd_view_axes(c, p->view);
    write_legend(p);
  }
  st = dyd_canvas_end(c, DYD_OK, o->err);
  return p->st == DYD_OK ? st : p->st;
}
