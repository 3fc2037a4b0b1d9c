/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The file of a page: the page itself, which is the same for all, around its data.
 *
 * The page is made of the texts in page/ when the library is built (pack.py); its Content-Security-Policy allows the
 * script and style in it, by their digests, and nothing else: no request can leave it. Data are one JSON object, packed
 * by zlib, as base64. */
#ifndef DYD_PICTURE_HTML_FILE_H
#define DYD_PICTURE_HTML_FILE_H

#include "io/output.h"

/* Writes JSON to `to`. */
typedef dyd_status (*dyd_html_data_fn)(FILE *to, const dyd_output *o);
/* A page with the data that `data` writes. */
dyd_status dyd_html_write(const dyd_output *o, dyd_html_data_fn data);

#endif
