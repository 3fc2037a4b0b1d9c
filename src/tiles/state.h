/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* One rank at work: what it does between one delivery of mail and the next. */
#ifndef TILES_STATE_H
#define TILES_STATE_H

#include "tree.h"
#include <jansson.h>
#include <stdio.h>

/* What is to be done: the same for all ranks. */
typedef struct tiles_job {
  const char *input, *folder;
  bool boxes;    /* the input has four numbers a point */
  bool text;     /* it is lines of decimals */
  uint64_t size; /* of the input, in bytes */
  size_t ranks;
  size_t max_pairs;
  bool restart; /* parts that are there already stay */
  /* What is sent before anybody asks, and how much at once: no result depends on it. */
  double halo;      /* in mean distances: wide enough for most discs of evenly spread points */
  unsigned corners; /* of each hull, told to everybody: discs at the rim of all points end there */
  size_t nearest;   /* sites that answer a disc; more when that has not been enough for long */
} tiles_job;

/* Lines of a slice: how many points; most digits left and right of a decimal point. */
typedef struct tiles_survey {
  uint64_t rows;
  int64_t before, after;
} tiles_survey;

/* What each rank tells all others of itself. */
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
  size_t room_start, room_partner;
} tiles_graph;
void tiles_graph_clear(tiles_graph *g);

typedef struct tiles_row {
  uint64_t i, j;
  uint32_t status;
} tiles_row;
typedef struct tiles_rows {
  size_t count, room;
  tiles_row *item;
} tiles_rows;

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

/* The steps, in this order; the last two again while any rank asked something. Each takes the mail in t->in and writes
 * t->out. *err names the remedy. */
dyd_status tile_survey(tile *t, dyd_error *err); /* counts in its slice of a text; out: the counts */
dyd_status tile_read(tile *t, dyd_error *err);   /* its slice of the input; out: a sample of it */
dyd_status tile_split(tile *t, dyd_error *err);  /* boxes of the plane; out: points to their owners */
dyd_status tile_own(tile *t, dyd_error *err);    /* its own sites; out: where they are, and corners of their hull */
dyd_status tile_halo(tile *t, dyd_error *err);   /* out: sites near the boxes of others */
dyd_status tile_first(tile *t, dyd_error *err);  /* triangulates; out: discs */
dyd_status tile_answer(tile *t, dyd_error *err); /* out: the nearest sites in the discs asked for */
dyd_status tile_extend(tile *t, dyd_error *err); /* triangulates what is not settled; out: discs */
dyd_status tile_report(tile *t, dyd_error *err); /* at the end; out: counters, to rank 0 */

/* For the steps themselves. */
dyd_status tile_read_text(tile *t, dyd_error *err);
/* A new engine gets the sites of both tables, which may forget the places then. */
dyd_status tile_load(tiles_view *v, tile *t, const tiles_sites *first, const tiles_sites *second, dyd_error *err);
/* Triangulates them. */
dyd_status tile_triangulate(tile *t, dyd_error *err);
/* The possible pairs of site i of the view; they last until the next call. Quick when i ascends. */
dyd_status tile_partners(tiles_partners *p, tile *t, uint32_t i, dyd_error *err);
void tile_end_engine(tile *t);
dyd_status tile_fringe(tile *t, dyd_error *err);
/* Adds the rows of site i of the view: pairs with higher numbers. */
dyd_status tile_rows_of(tiles_rows *rows, tile *t, const tiles_view *v, uint32_t i, dyd_error *err);
bool tile_has_wide(const tile *t);

/* ---- parts ---- */

/* Bytes of a record: i and j of 8, status of 4, little-endian. */
enum { TILES_RECORD = 20, TILES_SUM = 8 };
tiles_row tiles_row_decode(const unsigned char bytes[TILES_RECORD]);
/* Puts the places of own sites on the disk, and gets them back. */
dyd_status tile_park(tile *t, dyd_error *err);
dyd_status tile_unpark(tile *t, dyd_error *err);
/* Writes the rows to the spool. */
dyd_status tile_spool(tile *t, const tiles_rows *rows, dyd_error *err);
/* The part, whole or not at all: header, spool and rows, aliases, then the sum over all of that. */
dyd_status tile_write_part(tile *t, dyd_error *err);
/* Sets *out to the sum over a part; false where the one written behind it is another. Then and there `in` is at its
 * begin. */
bool tiles_part_sum(uint64_t *out, FILE *in);
/* The header of a part; `in` is behind it then. NULL: there is none. */
json_t *tiles_part_header(FILE *in);
/* Tells own points apart. */
uint64_t tile_digest(const tile *t);
/* t->done: there is a part of just this rank, these points, these options; its aliases and counters are taken. */
dyd_status tile_find_part(tile *t, dyd_error *err);
/* Rank 0, with the counters of all in its mail: manifest.json. */
dyd_status tile_write_manifest(tile *t, dyd_error *err);
/* The rows of all parts in a folder, as `dyadel delaunay` writes them. */
dyd_status tiles_write_csv(FILE *out, const char *folder, dyd_error *err);

/* Name of a file in the folder; the caller frees it. NULL: memory is exhausted. */
char *tiles_path(const char *folder, const char *name);
void tiles_part_name(char name[32], size_t rank);
/* A file that appears under its name when it is complete. */
typedef struct tiles_file {
  FILE *stream;
  char *name, *temporary;
} tiles_file;
dyd_status tiles_file_open(tiles_file *f, const char *folder, const char *name, dyd_error *err);
/* st, or what writing failed with; the file is there when that is DYD_OK. */
dyd_status tiles_file_close(tiles_file *f, dyd_status st, dyd_error *err);

#endif
