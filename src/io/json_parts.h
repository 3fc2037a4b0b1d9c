/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Members that several json formats share. */
#ifndef DYD_IO_JSON_PARTS_H
#define DYD_IO_JSON_PARTS_H

#include <dyadel/delaunay.h>
#include <stdio.h>

/* "aliases": [[7, 3], ..], for the first `count` sites, and `after` behind it. */
void dyd_json_aliases(FILE *out, const dyd_delaunay *pd, size_t count, const char *after);
/* "NAME": {"exact": "m*2^e", "decimal": rounded up}. */
dyd_status dyd_json_bound(FILE *out, const char *name, const dyd_dyadic *value);

#endif
