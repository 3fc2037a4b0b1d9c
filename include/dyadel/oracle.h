/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Points served by a program of the user, in any language, over its standard input and output.
 *
 * The program is started as `sh -c COMMAND`. All is lines of text, at most 2^20 bytes long:
 *   it first prints          points N                         or, with a number above 0 for each point,
 *                            points N cost C ... C
 *   then for each line       refine I B                       (0 <= I < N)
 *   it answers one line      I XLO XHI YLO YHI                or, when that can never be narrowed,
 *                            I XLO XHI YLO YHI fixed
 * where [XLO,XHI] x [YLO,YHI] encloses point I, lies inside every earlier answer for I, and aims at widths of 2^-B. The
 * ends are plain exact numbers: -3.25, 1e-3, 22/7, 0x1.8p-3, 5*2^-20. Answers come in the order of the requests,
 * without waiting for further ones, and the output is flushed after each. The program ends when its input does. Its
 * answers should depend on I, B and its former answers for I only. Standard error is that of the caller. C says what
 * asking a point again costs, such as minutes, with regard to the others: the adaptive schedule asks cheap points
 * of a face before expensive ones. Of several programs, the first one decides.
 *
 * A COMMAND that is one program should begin with exec: else a shell stands between, which keeps the pipes open when
 * the program closes them, so that this is seen only as silence.
 *
 * Several programs: point I is always asked of program number I modulo jobs, so a program may keep data of its
 * points. Each finds its number, from 0, in the environment as DYADEL_JOB (to choose a machine, say).
 *
 * Results do not depend on jobs, batch and time as long as the answers do not.
 *
 * Failures (statuses of narrow, with point and reason in the error record): DYD_E_STREAM when the program ended, was
 * silent for too long, or wrote something other than an answer to the request; DYD_E_NESTING, DYD_E_RANGE. Earlier
 * answers count. With `retries` a program that ended, was silent, or wrote something other than an answer is first
 * started again, so often for one request, and gets the open requests again: it then knows nothing of its former
 * answers, which its new ones still have to lie in (or say the same).
 *
 * Nothing is left behind: every program and its children are one process group. When the source is released their
 * inputs end, half a second later they get SIGTERM (srun and the like free resources elsewhere), and are killed after
 * another half; likewise, within three seconds, when the process that uses the library dies of whatever cause (a shell
 * next to it watches for that). Only a process that leaves the group, such as a daemon, or runs on
 * another machine, must detect that its input has ended. SIGPIPE is never raised. */
#ifndef DYADEL_ORACLE_H
#define DYADEL_ORACLE_H

#include <dyadel/stream.h>

#ifdef __cplusplus
extern "C" {
#endif

#define DYD_ORACLE_MAX_JOBS 1024
#define DYD_ORACLE_MAX_BATCH 65536
#define DYD_ORACLE_SECONDS 30

typedef struct dyd_oracle_options {
  size_t struct_size;       /* set by DYD_SIZED */
  unsigned jobs;            /* programs that run side by side; 0: one; never more than there are points */
  unsigned batch;           /* requests a program is sent before its answers are awaited; 0: one */
  unsigned retries;         /* how often a program is started again for one request before that has failed */
  double seconds;           /* the longest wait for one line; 0: DYD_ORACLE_SECONDS */
  const volatile int *stop; /* not NULL: starting gives up with DYD_CANCELLED when it becomes not 0; borrowed for
                             * the call only */
} dyd_oracle_options;

/* Starts the programs, waits until each has reported how many points there are, and sets *out, begun with DYD_SIZED, to
 * a source of points 0 .. *points - 1, for dyd_engine_add_source. Its release ends the programs: their inputs end, and
 * programs that run a second later are killed. options may be NULL. DYD_E_ARG for options out of range, DYD_E_STREAM
 * when a program cannot be started or does not begin as it should, DYD_E_NOMEM, DYD_CANCELLED; *err (may be NULL) says
 * more, outputs are unchanged, and nothing is left running. */
DYD_API dyd_status dyd_oracle_source(dyd_source *out, size_t *points, const char *command,
                                     const dyd_oracle_options *options, dyd_error *err);

#ifdef __cplusplus
}
#endif
#endif
