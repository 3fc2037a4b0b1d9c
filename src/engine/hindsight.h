/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The best plan in hindsight. */
#ifndef DYD_ENGINE_HINDSIGHT_H
#define DYD_ENGINE_HINDSIGHT_H

#include <dyadel/converge.h>

/* Sets *bits to the least sum of bits by which the goal of the run that has just ended holds, as
 * dyd_converge_options.hindsight says; 0: the outcome is neither decided nor certified, the goal is about the diagram,
 * or more than `most` triangulations are needed. DYD_CANCELLED is none: then it is not known either. */
dyd_status dyd_hindsight_find(uint64_t *bits, dyd_engine *e, const dyd_engine_options *o, dyd_outcome outcome,
                              dyd_stage_row *const *row, size_t rows, uint64_t most, dyd_error *err);

#endif
