/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The csv format: "i,j,status", one line per possible pair; comment lines tell aliases and capped faces. */
#include "base/error.h"
#include "io/result.h"

/* Pairs within a capped face may be possible without being listed, so the sites of such faces are. */
static dyd_status write_faces(const dyd_result *r, dyd_error *err) {
  fputs("# capped: pairs within one of these faces may be possible though they are not listed\n", r->out);
  dyd_index_list face = {0};
  dyd_status status = DYD_OK;
  for (size_t f = 0; f < dyd_delaunay_undecided_faces(r->pd) && status >= 0; f++) {
    bool outer;
    status = dyd_delaunay_face(&face, &outer, r->pd, f);
    if (status < 0) break;
    fputs("# face", r->out);
    for (size_t k = 0; k < face.count; k++) fprintf(r->out, " %u", (unsigned)face.item[k]);
    fputs("\n", r->out);
  }
  dyd_index_list_clear(&face);
  return status < 0 ? dyd_fail(err, status, "%s", dyd_status_text(status)) : DYD_OK;
}

dyd_status dyd_write_csv(const dyd_result *r, dyd_error *err) {
  for (size_t i = 0; i < r->count; i++) {
    uint32_t of = dyd_delaunay_alias(r->pd, (uint32_t)i);
    if (of != i) fprintf(r->out, "# alias %zu %u\n", i, (unsigned)of);
  }
  if (dyd_delaunay_is_capped(r->pd)) {
    dyd_status status = write_faces(r, err);
    if (status < 0) return status;
  }
  fputs("i,j,status\n", r->out);
  for (size_t k = 0; k < r->pairs.count; k++) {
    const dyd_pair *p = &r->pairs.item[k];
    fprintf(r->out, "%u,%u,%s\n", (unsigned)p->i, (unsigned)p->j, dyd_pair_status_text(p->status));
  }
  return DYD_OK;
}
