/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What the writers of bisectors and discs share. */
#ifndef DYD_IO_PIECES_H
#define DYD_IO_PIECES_H

#include <dyadel/engine.h>
#include <stdio.h>

/* {"x": [lo, hi], "y": [lo, hi]} with exact texts. */
dyd_status dyd_rect_json(FILE *out, const dyd_rect *r);
/* The opening of the object, up to the outcome. */
void dyd_pieces_json_head(FILE *out, const char *format, dyd_outcome outcome);

#endif
