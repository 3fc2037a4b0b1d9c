/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* How mail goes from rank to rank: by MPI, each process being a rank, or in memory, one process being all of them, one
 * after another. */
#ifndef TILES_CARRY_H
#define TILES_CARRY_H

#include "state.h"

typedef struct tiles_carrier {
  /* Moves what the `count` ranks of this process wrote to where it goes, and brings what others wrote to them. */
  dyd_status (*carry)(tile *member, size_t count, dyd_error *err);
  /* Is it so in any process? */
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
