/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Tiles: one triangulation in pieces (mathematics: section 15; [REACH-1], [TILE-1]).
 *
 * Each rank owns the sites of its box of the plane. It triangulates them with a halo of others' sites, and asks the
 * owners for what its answer may still depend on, until nothing is left. Ranks are not bound to processes: a rank
 * works in steps (tile), and between two steps the mail that it wrote is carried to the other ranks, by MPI or in
 * memory (tiles_carrier). Numbers of points are 64 bits wide in mail and files, 32 within one rank. */
#ifndef TILES_TILES_H
#define TILES_TILES_H

#include "base/alloc.h"
#include "base/error.h"
#include <dyadel/engine.h>
#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* DYD_E_NOMEM with a remedy. */
dyd_status tiles_no_memory(dyd_error *err);

/* ---- mail ---- */

/* Bytes from one rank to another. */
typedef struct tiles_mail {
  unsigned char *bytes;
  size_t count, cap;
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
  size_t count, cap_number, cap_end;
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

/* A set of own sites, those of another rank. */
typedef struct tiles_set {
  size_t count, cap; /* cap: 0 or a power of two, more than count */
  uint32_t *slot;    /* site + 1; 0: free */
} tiles_set;

/* ---- what the pairs of a site may depend on: discs and half-planes [REACH-1] ---- */

/* The disc about (x, y) of radius r; far: the half-plane of all p with x p.x + y p.y >= r. Closed. */
typedef struct tiles_disc {
  double x, y, r;
  uint64_t far;
} tiles_disc;

/* Begun as {0}; kept from site to site, for its memory. */
typedef struct tiles_reach {
  size_t count, cap;
  tiles_disc *item;
  struct tiles_spoke *spoke; /* scratch */
  struct tiles_knot *knot;
  size_t cap_spoke, cap_knot;
} tiles_reach;
void tiles_reach_clear(tiles_reach *r);

/* Sites of a triangulation that are partners of one. */
typedef struct tiles_partners {
  const uint32_t *item; /* the site, and its status << 30 */
  size_t count;
} tiles_partners;
#define TILES_SITE(partner) ((partner)&0x3fffffffu)
#define TILES_STATUS(partner) ((dyd_pair_status)((partner) >> 30))

/* Fills *out: while no rectangle outside of the view meets an item, the possible pairs of site i in the view are all
 * that it has, and those of exact points have their status [REACH-1]; so have legal pairs of rectangles of both of
 * whose ends this holds [TILE-1]. Where rectangles crowd, it is the whole plane. Takes any partners, best all possible
 * ones. false: memory is exhausted. O(n log n). */
bool tiles_reach_find(tiles_reach *out, const tiles_view *v, uint32_t i, const tiles_partners *p);
/* The disc about a witness of a legal pair of the two boxes, of which `centre` is a double next to it. */
tiles_disc tiles_witness_disc(const double centre[2], const tiles_box *a, const tiles_box *b);

/* May be, when doubles are not certain. */
bool tiles_disc_may_meet(const tiles_disc *d, const tiles_box *box);
/* Certainly. */
bool tiles_disc_is_inside(const tiles_disc *d, const tiles_box *box);
/* The smaller, the nearer to the middle of the disc, or the deeper in the half-plane; INFINITY: certainly outside. No
 * box inside of `box` has a smaller one. */
double tiles_disc_score(const tiles_disc *d, const tiles_box *box);
bool tiles_box_is_point(const tiles_box *b);
bool tiles_boxes_meet(const tiles_box *a, const tiles_box *b);
/* Returns true if it is higher than wide. */
bool tiles_box_is_tall(const tiles_box *a);
/* Grows *a to hold b. */
void tiles_box_join(tiles_box *a, const tiles_box *b);
/* The box with nothing in it. */
tiles_box tiles_box_empty(void);
/* Wider on each side by `times` mean distances of `count` sites in it. */
tiles_box tiles_box_wider(const tiles_box *box, size_t count, double times);

/* The site that goes farthest into direction k of `of`, about; the first one among equals. s is not empty. */
size_t tiles_farthest(const tiles_sites *s, unsigned k, unsigned of);

/* ---- finding own sites by place: a tree of boxes, split at medians ---- */

/* Invariant: node 1 holds all sites; node k its half-ranges of order as 2k and 2k + 1, ranges of a few sites are
 * leaves; box[k] holds the sites of node k. */
typedef struct tiles_tree {
  uint32_t *order;
  tiles_box *box;
  size_t count;
} tiles_tree;

/* The sites that may meet `disc`, without those of `skip`; no more than `most` of them, those with the least scores. */
typedef struct tiles_search {
  const tiles_disc *disc;
  const tiles_set *skip;
  const bool *alias; /* which others to skip; NULL: none */
  size_t most;
  /* The answer, ascending by score; cleared by the caller. */
  size_t count, cap_site, cap_score;
  uint32_t *site;
  double *score;
} tiles_search;

/* ---- one rank at work: its steps between one delivery of mail and the next ---- */

/* The job, the same for all ranks. */
typedef struct tiles_job {
  const char *input, *folder;
  bool boxes;    /* the input has four numbers a point */
  bool text;     /* it is lines of decimals */
  uint64_t size; /* of the input, in bytes */
  size_t ranks;
  size_t max_pairs;
  bool restart; /* parts that are there already stay */
  /* Sites sent without a question, and how many at once: no result depends on it. */
  double halo;      /* in mean distances: wide enough for most discs of evenly spread points */
  unsigned corners; /* of each hull, sent to all: discs at the rim of all points end there */
  size_t nearest;   /* sites that answer a disc; more when that has not been enough for long */
} tiles_job;

/* Lines of a slice: how many points; most digits left and right of a decimal point. */
typedef struct tiles_survey {
  uint64_t rows;
  int64_t before, after;
} tiles_survey;

/* Sent by each rank to all others. */
typedef struct tiles_info {
  uint64_t count;
  uint64_t wide; /* how many of its sites are no exact points */
  uint64_t digest;
  tiles_box box;  /* holds them */
  tiles_box seen; /* it knows every site that meets this box */
} tiles_info;

typedef struct tiles_counters {
  uint64_t own, ghosts, rounds, aliases;
  uint64_t sent;     /* bytes */
  uint64_t fringe;   /* sites of the last small triangulation */
  uint64_t late;     /* own sites that were not settled by the first one */
  uint64_t count[4]; /* pairs written, by status */
  uint64_t sum;      /* over the bytes of the part */
  double seconds;    /* in the library, of the processor */
  bool capped;
} tiles_counters;

/* Partners of `count` sites of a view, from `first` on. */
typedef struct tiles_graph {
  uint32_t first, count;
  size_t *start; /* count + 2 */
  uint32_t *partner;
  size_t cap_start, cap_partner;
} tiles_graph;

typedef struct tiles_row {
  uint64_t i, j;
  uint32_t status;
} tiles_row;
typedef struct tiles_rows {
  size_t count, cap;
  tiles_row *item;
} tiles_rows;
dyd_status tiles_rows_add(tiles_rows *rows, tiles_row row, dyd_error *err);
/* Sorts rows `from` and on by i, then j. */
void tiles_rows_sort(tiles_rows *rows, size_t from);

typedef struct tile {
  const tiles_job *job;
  size_t rank;
  uint64_t points;      /* in the input */
  tiles_mail *in, *out; /* one from, and for, each rank */
  tiles_sites own, ghosts, fringe;
  tiles_tree tree; /* of own, once the first triangulation is over */
  tiles_info *info;
  tiles_set *sent; /* own sites that each rank has; at its own place those of the fringe */
  bool *alias;     /* sites of the first triangulation that are no vertices */
  dyd_engine *engine;
  tiles_graph graph; /* of its result, as far as it was asked for last */
  tiles_reach reach;
  tiles_search search;
  unsigned char *mark; /* of the sites of the first triangulation */
  size_t *late;        /* sites of the fringe whose pairs are not settled yet */
  size_t late_count, asked;
  FILE *spool;  /* rows that are settled, but for those of `late` */
  FILE *parked; /* places of own sites, while the first triangulation needs the memory */
  tiles_rows rows, aliases;
  bool done;
  tiles_counters counters;
} tile;

dyd_status tile_new(tile *t, const tiles_job *job, size_t rank, dyd_error *err);
void tile_free(tile *t);

/* The first step: counts in its slice of a text; out: the counts. */
dyd_status tile_survey(tile *t, dyd_error *err);
/* For the steps themselves. */
dyd_status tile_read_text(tile *t, dyd_error *err);
/* A new engine gets the sites of both tables, which may forget the places then. */
dyd_status tile_load(tiles_view *v, tile *t, const tiles_sites *first, const tiles_sites *second, dyd_error *err);
/* Triangulates them. */
dyd_status tile_triangulate(tile *t, dyd_error *err);
/* The possible pairs of site i of the view; they last until the next call. Quick when i ascends. */
dyd_status tile_partners(tiles_partners *p, tile *t, uint32_t i, dyd_error *err);

/* ---- parts ---- */

/* Bytes of a record: i and j of 8, status of 4, little-endian. */
enum { TILES_RECORD = 20, TILES_SUM = 8 };
/* Puts the places of own sites on the disk, and gets them back. */
dyd_status tile_park(tile *t, dyd_error *err);
dyd_status tile_unpark(tile *t, dyd_error *err);
/* Writes the rows to the spool. */
dyd_status tile_spool(tile *t, const tiles_rows *rows, dyd_error *err);
/* The part, whole or not at all: header, spool and rows, aliases, then the sum over all of that. */
dyd_status tile_write_part(tile *t, dyd_error *err);
/* Tells own points apart. */
uint64_t tile_digest(const tile *t);
/* t->done: there is a part of just this rank, these points, these options; its aliases and counters are taken. */
dyd_status tile_find_part(tile *t, dyd_error *err);
/* Rank 0, with the counters of all in its mail: manifest.json. */
dyd_status tile_write_manifest(tile *t, dyd_error *err);
/* The rows of all parts in a folder, as `dyadel delaunay` writes them; with comments: the aliases first. */
dyd_status tiles_write_csv(FILE *out, const char *folder, bool comments, dyd_error *err);

/* Name of a file in the folder; the caller frees it. NULL: memory is exhausted. */
char *tiles_path(const char *folder, const char *name);
/* A file that appears under its name when it is complete. */
typedef struct tiles_file {
  FILE *stream;
  char *name, *temporary;
} tiles_file;

/* ---- mail from rank to rank: by MPI, each process being a rank, or in memory, one process being all of them ---- */

typedef struct tiles_carrier {
  /* Delivers the mail of the `count` ranks of this process, and brings mail of other processes to them. */
  dyd_status (*carry)(tile *member, size_t count, dyd_error *err);
  /* Returns true if it is so in any process. */
  bool (*any)(bool here);
} tiles_carrier;

extern const tiles_carrier tiles_in_memory;
#ifdef TILES_MPI
extern const tiles_carrier tiles_by_mpi;
/* Begins, and ends; *rank and *ranks are 0 and 1 where no mpirun started the process. */
void tiles_mpi_begin(size_t *rank, size_t *ranks);
void tiles_mpi_end(void);
#endif

/* All steps of all ranks of this process. DYD_OK also when another process failed, with *elsewhere. */
dyd_status tiles_drive(tile *member, size_t count, const tiles_carrier *by, bool *elsewhere, dyd_error *err);

#endif
