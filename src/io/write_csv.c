/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The csv format. Of the triangulation "i,j,status", one line per possible pair; comment lines tell aliases and capped
 * faces, as pairs within those may be possible without being listed. */
#include "io/label_text.h"
#include "io/parts.h"
#include "io/result.h"
#include <string.h>

/* The digits of v and the character behind; returns the place behind both. */
static char *csv_number(char *at, size_t v, char behind) {
  char digits[20], *p = digits + sizeof digits;
  do *--p = (char)('0' + v % 10);
  while (v /= 10);
  size_t count = (size_t)(digits + sizeof digits - p);
  memcpy(at, p, count);
  at[count] = behind;
  return at + count + 1;
}

enum { BLOCK = 1 << 14, LINE = 64 };

/* By hand and in blocks, since there are millions of lines. */
static void csv_pairs(FILE *out, const dyd_engine *e, const dyd_pair_list *pairs) {
  bool named = dyd_engine_id(e, 0) != NULL;
  char block[BLOCK], *end = block;
  for (size_t k = 0; k < pairs->count; k++) {
    const dyd_pair *p = &pairs->item[k];
    if (end > block + BLOCK - LINE) {
      fwrite(block, 1, (size_t)(end - block), out);
      end = block;
    }
    end = csv_number(csv_number(end, dyd_engine_row(e, p->i), ','), dyd_engine_row(e, p->j), ',');
    for (const char *st = dyd_pair_status_text(p->status); *st; st++) *end++ = *st;
    if (named) {
      fwrite(block, 1, (size_t)(end - block), out);
      end = block;
      dyd_csv_ids(out, e, (const uint32_t[]){p->i, p->j}, 2);
    }
    *end++ = '\n';
  }
  fwrite(block, 1, (size_t)(end - block), out);
}

static dyd_status csv_delaunay(const dyd_output *o) {
  const dyd_result *r = o->what;
  dyd_status st = DYD_OK;
  dyd_csv_aliases(o->out, r->engine);
  if (dyd_delaunay_is_capped(r->pd)) {
    fputs("# capped: pairs within one of these faces may be possible though they are not listed\n", o->out);
    st = dyd_result_faces(r, "# face ", "# face ", " ", "\n");
  }
  if (st != DYD_OK) return st;
  fprintf(o->out, "i,j,status%s\n", dyd_csv_id_head(r->engine, 2));
  csv_pairs(o->out, r->engine, &r->pairs);
  return DYD_OK;
}

dyd_writer *const dyd_csv_writers[DYD_CONTENTS] = {[DYD_CONTENT_DELAUNAY] = csv_delaunay,
                                                   [DYD_CONTENT_VORONOI] = dyd_voronoi_csv,
                                                   [DYD_CONTENT_CONVERGENCE] = dyd_convergence_csv,
                                                   [DYD_CONTENT_CHECK] = dyd_check_csv,
                                                   [DYD_CONTENT_DISC] = dyd_disc_csv,
                                                   [DYD_CONTENT_BISECTOR] = dyd_bisector_csv,
                                                   [DYD_CONTENT_NEAREST] = dyd_nearest_csv};
