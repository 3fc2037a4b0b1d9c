/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Identifiers of points in results: the one place that knows how they are written. Numbers are dyd_engine_row. */
#ifndef DYD_IO_LABEL_TEXT_H
#define DYD_IO_LABEL_TEXT_H

#include "io/sink.h"
#include <dyadel/engine.h>

/* What a picture calls a site: its identifier if it is short and printable, else the number, written to spare. */
enum { DYD_LABEL_SIZE = 24 };
const char *dyd_label_text(char spare[DYD_LABEL_SIZE], const dyd_engine *e, size_t site);
/* A text as csv has it. */
void dyd_sink_csv_text(dyd_sink *s, const char *text);
/* A text in JSON syntax; bytes that are not UTF-8 become U+FFFD. */
void dyd_sink_json_text(dyd_sink *s, const char *text);

#endif
