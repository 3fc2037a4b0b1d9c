/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What the writers of bisectors, discs and nearest points share. */
#ifndef DYD_IO_PIECES_H
#define DYD_IO_PIECES_H

#include <dyadel/arc.h>
#include <dyadel/io.h>

/* {"x": [lo, hi], "y": [lo, hi]} with exact texts. */
dyd_status dyd_rect_json(FILE *out, const dyd_rect *r);
/* The opening of the object, up to the outcome. */
void dyd_pieces_json_head(FILE *out, const char *format, dyd_outcome outcome);

/* *box (xlo, xhi, ylo, yhi) grows to hold r; false, with a message, unless doubles can hold it. */
dyd_status dyd_pieces_grow(double box[4], const dyd_rect *r, dyd_error *err);
/* *box grows by a margin on all sides, and to the shape of a page. */
void dyd_pieces_pad(double box[4]);
/* Pictures, of kind svg, pdf or png. curve: of (r[0],r[1]) and (r[1],r[0]), sites named 0 and 1 in both. */
dyd_status dyd_picture_bisector(FILE *out, dyd_format kind, const dyd_rect *const r[2], const dyd_boundary curve[2],
                                dyd_error *err);
dyd_status dyd_picture_disc(FILE *out, dyd_format kind, const dyd_partial_disc *d, const dyd_rect *const *r, size_t n,
                            dyd_error *err);
dyd_status dyd_picture_nearest(FILE *out, dyd_format kind, const dyd_delaunay *pd, const dyd_nearest_answer *answer,
                               dyd_error *err);

#endif
