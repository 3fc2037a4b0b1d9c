/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The table of formats: the one place that knows which there are. */
#ifndef DYD_FORMAT_TABLE_H
#define DYD_FORMAT_TABLE_H

#include "io/output.h"

/* Writes o->what, of the type that output.h says for this content; o->err is not looked at. DYD_E_ARG where the format
 * cannot hold it. err may be NULL. */
dyd_status dyd_format_write(const dyd_output *o, dyd_error *err);

/* What writing a result of so many sites and pairs takes in memory beside it, by estimate; or its diagram, beside what
 * the writers of that ask for. */
uint64_t dyd_format_bytes(dyd_format format, bool diagram, uint64_t sites, uint64_t pairs);

#endif
