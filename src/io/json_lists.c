/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What the json formats of a plane and of a sphere share: lists of pairs and triangles, counters. */
#include "io/result.h"
#include "io/sink.h"
#include <inttypes.h>

void dyd_json_pairs(FILE *out, const dyd_engine *e, const char *name, const dyd_pair_list *pairs) {
  dyd_sink s;
  dyd_sink_begin(&s, out);
  dyd_sink_text(&s, "\"");
  dyd_sink_text(&s, name);
  dyd_sink_text(&s, "\": [");
  for (size_t k = 0; k < pairs->count; k++) {
    const dyd_pair *p = &pairs->item[k];
    dyd_sink_text(&s, k ? ",\n{\"i\": " : "\n{\"i\": ");
    dyd_sink_index(&s, dyd_engine_row(e, p->i));
    dyd_sink_text(&s, ", \"j\": ");
    dyd_sink_index(&s, dyd_engine_row(e, p->j));
    dyd_sink_text(&s, ", \"status\": \"");
    dyd_sink_text(&s, dyd_pair_status_text(p->status));
    dyd_sink_text(&s, "\"}");
  }
  dyd_sink_text(&s, "\n]");
  dyd_sink_flush(&s);
}

void dyd_json_triangles(FILE *out, const dyd_engine *e, const dyd_triangle_list *list) {
  dyd_sink s;
  dyd_sink_begin(&s, out);
  dyd_sink_text(&s, "\"triangles\": [");
  for (size_t k = 0; k < list->count; k++) {
    const uint32_t *v = list->item[k].v;
    if (k) dyd_sink_text(&s, k % 8 ? ", " : ",\n");
    for (int c = 0; c < 3; c++) {
      dyd_sink_text(&s, c ? ", " : "[");
      dyd_sink_index(&s, dyd_engine_row(e, v[c]));
    }
    dyd_sink_text(&s, "]");
  }
  dyd_sink_text(&s, "],\n");
  dyd_sink_flush(&s);
}

void dyd_json_counters(FILE *out, const dyd_engine *e) {
  dyd_engine_counters c = {DYD_SIZED(dyd_engine_counters)};
  dyd_engine_get_counters(&c, e, NULL);
  const dyd_delaunay_counters *d = &c.delaunay;
  const dyd_tie_counters *t = &c.ties;
  fprintf(out,
          "\"counters\": {\"stages\": %" PRIu64 ", \"stream_calls\": %" PRIu64 ", \"bits_least\": %" PRId64
          ", \"bits_most\": %" PRId64 ", \"bits_total\": %" PRIu64 ",\n\"undecided_faces\": %" PRIu64
          ", \"faces_worked_on\": %" PRIu64 ", \"filter\": %" PRIu64 ", \"integer\": %" PRIu64 ", \"exact\": %" PRIu64
          ",\n\"witness_guess\": %" PRIu64 ", \"witness_search\": %" PRIu64 ", \"cover_walks\": %" PRIu64
          ", \"milliseconds_rounded_up\": %" PRIu64 ",\n\"zero_tests\": %" PRIu64 ", \"zero_by_identity\": %" PRIu64
          ", \"zero_by_bound\": %" PRIu64 ", \"not_zero\": %" PRIu64 ", \"zero_unknown\": %" PRIu64
          ", \"zero_bits_most\": %" PRId64 ", \"zero_degree_most\": %" PRId64
          ", \"zero_milliseconds_rounded_up\": %" PRIu64 "}\n",
          c.stages, c.calls, c.bits_least, c.bits_most, c.bits_total, c.undecided_faces, d->faces, d->filter,
          d->integer, d->exact, d->witness_guess, d->witness_search, d->cover_walks, (uint64_t)(c.seconds * 1000) + 1,
          t->tests, t->by_identity, t->by_bound, t->nonzero, t->unknown, t->bits_most, t->degree_most,
          (uint64_t)(t->seconds * 1000) + 1);
}
