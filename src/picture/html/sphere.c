/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Pages of a sphere: degrees as a map, sides are great circles. They show what was reached in the end. */
#include "picture/html/file.h"
#include "picture/html/html.h"
#include "picture/html/list.h"
#include "picture/html/scene.h"

#include "base/alloc.h"
#include "io/json.h"

/* number: of places on the page, which aliases are not. */
typedef struct html_globe {
  FILE *out;
  const dyd_result *r;
  uint32_t *number;
} html_globe;

static dyd_status html_globe_points(html_globe *g) {
  const dyd_engine *places = dyd_sphere_places(g->r->sphere);
  uint32_t shown = 0;
  dyd_rect rect;
  dyd_json j;
  dyd_rect_init(&rect);
  dyd_json_begin(&j, g->out);
  dyd_json_array(&j, "points", DYD_JSON_ROWS);
  for (uint32_t i = 0; i < dyd_engine_count(places) && j.st == DYD_OK; i++) {
    if (dyd_sphere_alias(g->r->sphere, i) != i) continue;
    g->number[i] = shown++;
    dyd_json_object(&j, NULL, DYD_JSON_FLAT);
    dyd_json_site(&j, "i", places, i);
    if (dyd_json_good(&j, dyd_sphere_rect(&rect, g->r->sphere, i))) dyd_json_sides(&j, &rect);
    dyd_json_ids(&j, places, &i, 0);
    dyd_json_close(&j, 1);
  }
  dyd_json_close(&j, 1);
  dyd_rect_clear(&rect);
  dyd_json_break(&j, ",\n");
  dyd_json_aliases(&j, places, g->r->sphere);
  return dyd_json_end(&j, ",\n");
}

static dyd_status html_globe_triangles(const html_globe *g) {
  dyd_triangle_list list = {0};
  dyd_html_list l;
  dyd_status st = dyd_sphere_triangles(&list, g->r->sphere);
  dyd_html_list_begin(&l, g->out, "triangles");
  for (size_t k = 0; k < list.count; k++) {
    const uint32_t *v = list.item[k].v;
    dyd_html_list_put(&l, (uint32_t[]){g->number[v[0]], g->number[v[1]], g->number[v[2]]}, 3);
  }
  dyd_html_list_end(&l);
  fputs(",\n", g->out);
  dyd_triangle_list_clear(&list);
  return st;
}

/* One stage. */
static void html_globe_pairs(const html_globe *g) {
  dyd_html_list l;
  fputs("\"stages\": [\n{", g->out);
  for (int status = DYD_ILLEGAL; status <= DYD_LEGAL; status++) {
    dyd_html_list_begin(&l, g->out, dyd_pair_status_text((dyd_pair_status)status));
    for (size_t k = 0; k < g->r->pairs.count; k++) {
      const dyd_pair *p = &g->r->pairs.item[k];
      if ((int)p->status == status) dyd_html_list_put(&l, (uint32_t[]){g->number[p->i], g->number[p->j]}, 2);
    }
    dyd_html_list_end(&l);
    fputs(", ", g->out);
  }
  fputs("\"boxes\": [], \"final\": []}\n]}\n", g->out);
}

static dyd_status html_globe_page(FILE *to, const dyd_output *o) {
  const dyd_result *s = o->what;
  const dyd_engine *images = dyd_sphere_images(s->sphere);
  const dyd_result r = {.engine = images,
                        .pd = dyd_engine_delaunay(images),
                        .count = dyd_engine_count(dyd_sphere_places(s->sphere)),
                        .epsg = s->epsg};
  html_globe g = {to, s, dyd_alloc(r.count, sizeof *g.number)};
  dyd_status st = g.number ? dyd_html_check_pairs(s->pairs.count, "", "", o->err) : DYD_E_NOMEM;
  if (st == DYD_OK) st = dyd_html_head(to, &r, "delaunay", o->content);
  fputs("\"surface\": \"sphere\",\n", to);
  if (st == DYD_OK) st = html_globe_points(&g);
  if (st == DYD_OK) st = html_globe_triangles(&g);
  if (st == DYD_OK) html_globe_pairs(&g);
  free(g.number);
  return st;
}

dyd_status dyd_html_sphere(const dyd_output *o) {
  return dyd_html_write(o, html_globe_page);
}
