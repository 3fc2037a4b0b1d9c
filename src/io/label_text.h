/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Identifiers of points in results: the one place that knows how they are written. Numbers are dyd_engine_row. */
#ifndef DYD_IO_LABEL_TEXT_H
#define DYD_IO_LABEL_TEXT_H

#include "io/sink.h"
#include <dyadel/engine.h>

/* Columns behind others: ",id_i,id_j" for count = 2, at most 3; ",id" for count = 0. "" without identifiers. */
const char *dyd_csv_id_head(const dyd_engine *e, size_t count);
/* Their values: ",NAME" for each site, quoted where need be (RFC 4180); nothing without identifiers. */
void dyd_csv_ids(FILE *out, const dyd_engine *e, const uint32_t *site, size_t count);
/* What a picture calls a site: its identifier if it is short and printable, else the number, written to spare. */
enum { DYD_LABEL_SIZE = 24 };
const char *dyd_label_text(char spare[DYD_LABEL_SIZE], const dyd_engine *e, size_t site);
/* A text as csv has it. */
void dyd_sink_csv_text(dyd_sink *s, const char *text);
/* Members behind others: , "id_i": "NAME", "id_j": "NAME"; for count = 0 , "id": "NAME" of one site. */
void dyd_sink_json_ids(dyd_sink *s, const dyd_engine *e, const uint32_t *site, size_t count);
void dyd_json_ids(FILE *out, const dyd_engine *e, const uint32_t *site, size_t count);
/* A text as JSON has it; what is no UTF-8 becomes U+FFFD. */
void dyd_sink_json_text(dyd_sink *s, const char *text);
void dyd_json_text(FILE *out, const char *text);

#endif
