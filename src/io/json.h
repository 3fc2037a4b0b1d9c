/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* A streaming writer of JSON. It sets the commas, quotes and line breaks; callers name the members:
 *
 *     dyd_json_begin(&j, out);
 *     dyd_json_object(&j, NULL, DYD_JSON_LINES);
 *     dyd_json_word(&j, "format", "dyadel x 1");
 *     dyd_json_array(&j, "items", DYD_JSON_LIST);
 *     for each item  dyd_json_index(&j, NULL, item);
 *     dyd_json_close(&j, 1);
 *     st = dyd_json_end(&j, "}\n");
 *
 * A name is that of a member; NULL in arrays. Names and words are our own ASCII, which needs no escaping. */
#ifndef DYD_IO_JSON_H
#define DYD_IO_JSON_H

#include "io/output.h"
#include "io/sink.h"
#include <dyadel/arc.h>
#include <dyadel/sphere.h>

/* Where lines break between the members of an object or array. */
typedef enum dyd_json_form {
  DYD_JSON_FLAT,  /* nowhere */
  DYD_JSON_LINES, /* behind each comma */
  DYD_JSON_LIST,  /* before each member, and before the closing bracket */
  DYD_JSON_ROWS,  /* before each member */
  DYD_JSON_DENSE  /* nowhere, nor are there blanks; so it is with objects and arrays in it */
} dyd_json_form;

enum { DYD_JSON_DEPTH = 12 };

/* The text before the first member, between members, and before the closing bracket, by form: at most 4 bytes; the
 * length of what follows a name. */
typedef struct dyd_json_breaks {
  const char *first, *between, *close;
  size_t colon;
} dyd_json_breaks;
extern const dyd_json_breaks dyd_json_forms[];

/* Invariant: level[1 .. depth] are the open objects and arrays; `before` is what the next member begins with. */
typedef struct dyd_json {
  dyd_sink to;
  dyd_status st; /* the first failure; nothing needs to be asked before the end */
  size_t depth;
  struct {
    const char *before;
    const dyd_json_breaks *form;
    char bracket;
  } level[DYD_JSON_DEPTH + 1];
} dyd_json;

/* Between begin and end, `out` must not be written to by others. */
void dyd_json_begin(dyd_json *j, FILE *out);
/* Puts `end`, which closes the outermost object; returns the first failure. */
dyd_status dyd_json_end(dyd_json *j, const char *end);
/* Records a failure; returns whether there was none so far. */
bool dyd_json_good(dyd_json *j, dyd_status st);

/* The name, after which the caller puts one value to j->to. Inline, as are others below, so that the length of a
 * literal is a constant: large results have millions of members. */
static inline void dyd_json_name(dyd_json *j, const char *name) {
  size_t length = name ? strlen(name) : 0;
  char *p = dyd_sink_room(&j->to, length + 16);
  for (const char *c = j->level[j->depth].before; *c;) *p++ = *c++;
  if (name) {
    *p++ = '"';
    memcpy(p, name, length);
    memcpy(p + length, "\": ", 3);
    p += length + j->level[j->depth].form->colon;
  }
  j->to.end = p;
  j->level[j->depth].before = j->level[j->depth].form->between;
}
/* The same for a value that goes to a file: nothing of it is held back. */
FILE *dyd_json_file(dyd_json *j, const char *name);
static inline void dyd_json_open(dyd_json *j, const char *name, dyd_json_form form, char open, char close) {
  dyd_json_name(j, name);
  *j->to.end++ = open; /* there is room behind a name */
  if (j->level[j->depth].form == &dyd_json_forms[DYD_JSON_DENSE]) form = DYD_JSON_DENSE;
  j->depth++;
  j->level[j->depth].form = &dyd_json_forms[form];
  j->level[j->depth].before = dyd_json_forms[form].first;
  j->level[j->depth].bracket = close;
}
static inline void dyd_json_object(dyd_json *j, const char *name, dyd_json_form form) {
  dyd_json_open(j, name, form, '{', '}');
}
static inline void dyd_json_array(dyd_json *j, const char *name, dyd_json_form form) {
  dyd_json_open(j, name, form, '[', ']');
}
/* Closes `count` objects and arrays. */
static inline void dyd_json_close(dyd_json *j, int count) {
  for (; count--; j->depth--) {
    char *p = dyd_sink_room(&j->to, 8);
    for (const char *c = j->level[j->depth].form->close; *c;) *p++ = *c++;
    *p++ = j->level[j->depth].bracket;
    j->to.end = p;
  }
}
/* The next member comes behind `between`: a comma and another line break than that of the form. */
void dyd_json_break(dyd_json *j, const char *between);

/* ---- values ---- */

static inline void dyd_json_index(dyd_json *j, const char *name, uint64_t n) {
  dyd_json_name(j, name);
  dyd_sink_index(&j->to, n);
}
void dyd_json_signed(dyd_json *j, const char *name, int64_t n);
static inline void dyd_json_word(dyd_json *j, const char *name, const char *text) {
  dyd_json_name(j, name);
  *j->to.end++ = '"';
  dyd_sink_text(&j->to, text);
  dyd_sink_put(&j->to, "\"", 1);
}
/* A text of users. */
void dyd_json_text(dyd_json *j, const char *name, const char *text);
void dyd_json_bool(dyd_json *j, const char *name, bool b);
/* A value as it is, such as null. */
void dyd_json_raw(dyd_json *j, const char *name, const char *text);
/* A decimal; null where x is not finite. */
void dyd_json_decimal(dyd_json *j, const char *name, double x, dyd_round dir);
/* [lo, hi], rounded outward. */
void dyd_json_decimals(dyd_json *j, const char *name, double lo, double hi);
/* "x": [lo, hi], "y": [lo, hi]; decimal: "x_decimal", "y_decimal", beside exact ones; NULL: null. */
void dyd_json_box(dyd_json *j, bool decimal, const double *box);
void dyd_json_rational(dyd_json *j, const char *name, mpq_srcptr q);
void dyd_json_dyadic(dyd_json *j, const char *name, const dyd_dyadic *x);
/* {"exact": "m*2^e", "decimal": rounded up}; null where the value is not known (NULL). */
void dyd_json_bound(dyd_json *j, const char *name, const dyd_dyadic *value);
/* "x": [lo, hi], "y": [lo, hi], exact texts. */
void dyd_json_sides(dyd_json *j, const dyd_rect *r);
/* The same as an object. */
void dyd_json_rect(dyd_json *j, const char *name, const dyd_rect *r);
/* The four ends of a window as exact texts, `between` them; NULL: null. */
void dyd_json_window(dyd_json *j, const char *name, const dyd_rect *w, const char *between);

/* ---- results ---- */

/* The object of a file: "format", "version", and where they are known "command_line" and "crs". */
void dyd_json_head(dyd_json *j, const char *format, const dyd_output *o);
/* What a run narrows, and until when: its schedule, goal, and bits. */
void dyd_json_schedule(dyd_json *j, const dyd_engine_options *o);
/* "confidence", "k" and "n", where points have a confidence. */
void dyd_json_confidence(dyd_json *j, const dyd_engine *e);
/* The head with the outcome and confidence, where pairs of numbers are rounded outward and texts are exact. */
void dyd_json_head_outward(dyd_json *j, const char *format, const dyd_output *o, const dyd_engine *e,
                           dyd_outcome outcome);
/* The row of a site; identifiers "id_i", "id_j", ..; "id" of a single one (count 0), where there are any. */
static inline void dyd_json_site(dyd_json *j, const char *name, const dyd_engine *e, size_t i) {
  dyd_json_index(j, name, dyd_engine_row(e, i));
}
void dyd_json_ids(dyd_json *j, const dyd_engine *e, const uint32_t *site, size_t count);
/* "carried": the columns that points carry, of point i; nothing where they carry none. */
void dyd_json_carried(dyd_json *j, const dyd_engine *e, size_t i);
bool dyd_json_is_number(const char *text);
/* The rows of sites, in an array. */
void dyd_json_sites(dyd_json *j, const char *name, const dyd_engine *e, const dyd_index_list *list);
/* "aliases": [[7, 3], ..]: rows of e, or of the places of a sphere. */
void dyd_json_aliases(dyd_json *j, const dyd_engine *e, const dyd_sphere *s);
void dyd_json_pairs(dyd_json *j, const char *name, const dyd_engine *e, const dyd_pair_list *pairs);
void dyd_json_triangles(dyd_json *j, const dyd_engine *e, const dyd_triangle_list *list);
void dyd_json_counters(dyd_json *j, const dyd_engine *e);

/* ---- exact boundaries ---- */

/* Words for dyd_feature_kind, dyd_arc_kind, dyd_end_kind. */
extern const char *const dyd_feature_names[8], *const dyd_arc_names[3], *const dyd_end_names[5];

/* Texts of the points written last: an arc begins where the one before it ends, and the boundaries of Int and Pos of
 * exact points have the same ends. Zeroed before the first use.
 * Invariant: text[k] is owned, NULL, or the text of point[k], which is initialised where text[k] is not NULL. */
enum { DYD_POINT_TEXTS = 64 };
typedef struct dyd_point_texts {
  dyd_surd_point point[DYD_POINT_TEXTS];
  char *text[DYD_POINT_TEXTS];
  size_t next;              /* to be replaced */
  const dyd_engine *engine; /* whose sites the arcs name; NULL: of none */
} dyd_point_texts;
void dyd_point_texts_clear(dyd_point_texts *t);

/* {"whole": .., "chains": [{"closed": .., "arcs": [..]}]}. */
void dyd_json_boundary(dyd_json *j, const char *name, const dyd_boundary *b, dyd_point_texts *texts);

#endif
