/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Mail by MPI: lengths first, then pieces that MPI can count. */
#include "base/local.h"
#include "tiles/tiles.h"

#include <mpi.h>
#include <stdlib.h>

enum { PIECE = 1 << 30 };

void tiles_mpi_begin(size_t *rank, size_t *ranks) {
  int own = 0, all = 1;
  MPI_Init(NULL, NULL);
  MPI_Comm_rank(MPI_COMM_WORLD, &own);
  MPI_Comm_size(MPI_COMM_WORLD, &all);
  *rank = (size_t)own;
  *ranks = (size_t)all;
}

void tiles_mpi_end(void) {
  MPI_Finalize();
}

static bool any_by_mpi(bool here) {
  int mine = here, all = 0;
  MPI_Allreduce(&mine, &all, 1, MPI_INT, MPI_LOR, MPI_COMM_WORLD);
  return all != 0;
}

static size_t pieces_of(size_t bytes) {
  return bytes / PIECE + (bytes % PIECE != 0);
}

/* Pieces between two ranks keep their order. */
static size_t post_pieces(MPI_Request *request, const tiles_mail *m, size_t other, bool send) {
  size_t count = 0;
  for (size_t at = 0; at < m->count; at += PIECE) {
    int size = m->count - at < PIECE ? (int)(m->count - at) : PIECE;
    if (send)
      MPI_Isend(m->bytes + at, size, MPI_BYTE, (int)other, 0, MPI_COMM_WORLD, &request[count++]);
    else
      MPI_Irecv(m->bytes + at, size, MPI_BYTE, (int)other, 0, MPI_COMM_WORLD, &request[count++]);
  }
  return count;
}

/* Exchanges lengths and reserves memory; *pieces is the number of pieces both ways. */
static dyd_status expect_mail(size_t *pieces, tile *t, dyd_error *err) {
  const size_t ranks = t->job->ranks;
  DYD_FREED uint64_t *length = calloc(2 * ranks, sizeof *length);
  bool fits = length;
  for (size_t r = 0; fits && r < ranks; r++) length[r] = t->out[r].count;
  if (any_by_mpi(!fits)) {
    free(length);
    return tiles_no_memory(err);
  }
  MPI_Alltoall(length, 1, MPI_UINT64_T, length + ranks, 1, MPI_UINT64_T, MPI_COMM_WORLD);
  *pieces = 0;
  for (size_t r = 0; fits && r < ranks; r++) {
    t->in[r].count = 0;
    fits = dyd_reserve((void **)&t->in[r].bytes, &t->in[r].cap, length[ranks + r], 1);
    t->in[r].count = length[ranks + r];
    *pieces += pieces_of(t->in[r].count) + pieces_of(t->out[r].count);
    if (r != t->rank) t->counters.sent += t->out[r].count;
  }
  return any_by_mpi(!fits) ? tiles_no_memory(err) : DYD_OK;
}

static dyd_status carry_by_mpi(tile *t, size_t count, dyd_error *err) {
  size_t pieces = 0, posted = 0;
  (void)count;
  dyd_status st = expect_mail(&pieces, t, err);
  if (st != DYD_OK) return st;
  DYD_FREED MPI_Request *request = malloc((pieces + 1) * sizeof *request);
  if (any_by_mpi(!request)) {
    free(request);
    return tiles_no_memory(err);
  }
  for (size_t r = 0; r < t->job->ranks; r++) posted += post_pieces(request + posted, &t->in[r], r, false);
  for (size_t r = 0; r < t->job->ranks; r++) posted += post_pieces(request + posted, &t->out[r], r, true);
  for (size_t k = 0; k < posted; k++) MPI_Wait(&request[k], MPI_STATUS_IGNORE);
  for (size_t r = 0; r < t->job->ranks; r++) tiles_mail_clear(&t->out[r]);
  return DYD_OK;
}

const tiles_carrier tiles_by_mpi = {carry_by_mpi, any_by_mpi};
