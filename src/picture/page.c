/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Pages: a view in its frame, coordinates around it, the legend below. */
#include "picture/picture.h"
#include <math.h>

#define EDGE DYD_VIEW_EDGE
#define FOOT 140.0 /* room of coordinates and legend */

dyd_status dyd_view_write(const dyd_output *o, const dyd_view *v, const char *title, dyd_draw_fn inside,
                          dyd_draw_fn legend, void *context) {
  dyd_canvas *c = dyd_canvas_new(o, ceil(v->width + DYD_VIEW_LEFT + EDGE), ceil(v->height + EDGE + FOOT), title);
  if (!c) return DYD_E_NOMEM;
  dyd_view_frame_path(c, v);
  dyd_canvas_clip(c);
  inside(c, context);
  dyd_canvas_unclip(c);
  dyd_axes_draw(c, v);
  legend(c, context);
  return dyd_canvas_end(c, DYD_OK, o->err);
}
