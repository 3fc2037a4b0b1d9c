/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Tiles: one triangulation in pieces (mathematics: section 15; [REACH-1], [TILE-1]).
 *
 * Each rank owns the sites of its box of the plane. It triangulates them with a halo of others' sites, and asks the
 * owners for what its answer may still depend on, until nothing is left. Ranks are not bound to processes: a rank
 * works in steps (state.h), and between two steps the mail that it wrote is carried to the other ranks, by MPI or in
 * memory (carry.h). Numbers of points are 64 bits wide in mail and files, 32 within one rank. */
#ifndef TILES_TILES_H
#define TILES_TILES_H

#include <dyadel/engine.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Makes room for `count` items of `size` bytes in *array, which has *room; false: memory is exhausted. */
bool tiles_reserve(void **array, size_t *room, size_t count, size_t size);
/* Notes a message and returns code. */
dyd_status tiles_fail(dyd_error *err, dyd_status code, const char *format, ...) __attribute__((format(printf, 3, 4)));
dyd_status tiles_no_memory(dyd_error *err);

/* ---- mail ---- */

/* Bytes from one rank to another. */
typedef struct tiles_mail {
  unsigned char *bytes;
  size_t count, room;
} tiles_mail;
bool tiles_mail_put(tiles_mail *m, const void *bytes, size_t count);
/* Takes `count` bytes off the front, which *read counts; false: there are not so many. */
bool tiles_mail_take(void *out, size_t count, const tiles_mail *m, size_t *read);
void tiles_mail_clear(tiles_mail *m);

/* ---- sites ---- */

typedef struct tiles_box {
  double x0, x1, y0, y1;
} tiles_box;

/* Rows of a number and `dim` doubles: x y, or, of boxes, xlo xhi ylo yhi. Exact. */
typedef struct tiles_sites {
  unsigned dim; /* 2 or 4 */
  size_t count, room_number, room_end;
  uint64_t *number;
  double *end;
} tiles_sites;
bool tiles_sites_add(tiles_sites *s, uint64_t number, const double *end);
tiles_box tiles_sites_box(const tiles_sites *s, size_t k);
bool tiles_sites_reserve(tiles_sites *s, size_t count);
/* Of one of them in mail. */
static inline size_t tiles_sites_bytes(const tiles_sites *s) {
  return sizeof *s->number + s->dim * sizeof *s->end;
}
bool tiles_sites_put(tiles_mail *m, const tiles_sites *s, size_t k);
/* Takes all that is left in the mail. false: memory is exhausted. */
bool tiles_sites_take(tiles_sites *s, const tiles_mail *m, size_t *read);
void tiles_sites_clear(tiles_sites *s);
/* Their places alone. */
void tiles_sites_end(tiles_sites *s);

/* What a triangulation is about: numbers of two tables one behind the other, places as the engine has them. */
typedef struct tiles_view {
  const tiles_sites *first, *second;
  const dyd_sites *place;
} tiles_view;
static inline size_t tiles_view_count(const tiles_view *v) {
  return v->first->count + v->second->count;
}
tiles_box tiles_view_box(const tiles_view *v, size_t k);
uint64_t tiles_view_number(const tiles_view *v, size_t k);
/* Adds site k of the view to a table. */
bool tiles_sites_copy(tiles_sites *s, const tiles_view *v, size_t k);

/* A set of own sites, those that somebody else has. */
typedef struct tiles_set {
  size_t count, room; /* room: 0 or a power of two, more than count */
  uint32_t *slot;     /* site + 1; 0: free */
} tiles_set;
bool tiles_set_has(const tiles_set *s, uint32_t site);
bool tiles_set_add(tiles_set *s, uint32_t site);
void tiles_set_clear(tiles_set *s);

#endif
