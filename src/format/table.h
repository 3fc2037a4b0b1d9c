/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The table of formats: the only list of formats. */
#ifndef DYD_FORMAT_TABLE_H
#define DYD_FORMAT_TABLE_H

#include "io/output.h"

/* Writes o->what, of the type that output.h says for this content; o->err is ignored. DYD_E_ARG where the format
 * cannot hold it. err may be NULL. */
dyd_status dyd_format_write(const dyd_output *o, dyd_error *err);

/* Estimated memory, in bytes, for writing a result with these numbers of sites and pairs; for its diagram, without what
 * its writers request themselves. */
uint64_t dyd_format_bytes(const dyd_output *o, bool diagram, uint64_t sites, uint64_t pairs);

#endif
