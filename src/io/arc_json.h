/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Exact boundaries as JSON. */
#ifndef DYD_IO_ARC_JSON_H
#define DYD_IO_ARC_JSON_H

#include <dyadel/arc.h>
#include <dyadel/engine.h>
#include <stdio.h>

/* Words for dyd_feature_kind, dyd_arc_kind, dyd_end_kind. */
extern const char *const dyd_feature_names[8], *const dyd_arc_names[3], *const dyd_end_names[5];

/* Texts of the points written last: an arc begins where the one before it ends, and the boundaries of Int and Pos of
 * exact points have the same ends. Zeroed before the first use.
 * Invariant: text[k] is owned, NULL, or the text of point[k], which is initialised where text[k] is not NULL. */
enum { DYD_POINT_TEXTS = 64 };
typedef struct dyd_point_texts {
  dyd_surd_point point[DYD_POINT_TEXTS];
  char *text[DYD_POINT_TEXTS];
  size_t next;              /* to be replaced */
  const dyd_engine *engine; /* whose sites the arcs name; NULL: of none */
} dyd_point_texts;
void dyd_point_texts_clear(dyd_point_texts *t);

/* {"whole": .., "chains": [{"closed": .., "arcs": [..]}]}. */
dyd_status dyd_boundary_json(FILE *out, const dyd_boundary *b, dyd_point_texts *texts);

#endif
