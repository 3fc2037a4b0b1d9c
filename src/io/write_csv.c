/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The csv format: "i,j,status", one line per possible pair; comment lines tell aliases and capped faces. */
#include "base/error.h"
#include "io/result.h"
#include <string.h>

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

/* The digits of v and the character behind; returns the place behind both. */
static char *put_number(char *at, uint32_t v, char behind) {
  char digits[10], *p = digits + sizeof digits;
  do *--p = (char)('0' + v % 10);
  while (v /= 10);
  size_t count = (size_t)(digits + sizeof digits - p);
  memcpy(at, p, count);
  at[count] = behind;
  return at + count + 1;
}

enum { BLOCK = 1 << 14, LINE = 48 };

/* By hand and in blocks, since there are millions of lines. */
static void write_pairs(FILE *out, const dyd_pair_list *pairs) {
  char block[BLOCK], *end = block;
  for (size_t k = 0; k < pairs->count; k++) {
    const dyd_pair *p = &pairs->item[k];
    if (end > block + BLOCK - LINE) {
      fwrite(block, 1, (size_t)(end - block), out);
      end = block;
    }
    end = put_number(put_number(end, p->i, ','), p->j, ',');
    for (const char *status = dyd_pair_status_text(p->status); *status; status++) *end++ = *status;
    *end++ = '\n';
  }
  fwrite(block, 1, (size_t)(end - block), out);
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
  write_pairs(r->out, &r->pairs);
  return DYD_OK;
}
