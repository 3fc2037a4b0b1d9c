/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* A shell command that runs next to the caller: pipes to and from it, and a certain end for it and all its children. */
#ifndef DYD_STREAM_PROCESS_H
#define DYD_STREAM_PROCESS_H

#include <dyadel/status.h>
#include <dyadel/stream.h>
#include <stdbool.h>
#include <stddef.h>
#include <sys/types.h>

/* Invariant: pid > 0 until it is reaped, which only dyd_process_end does: so the number of its group, which is the
 * same, stays its own. watcher is a shell of that group. in and out are our non-blocking ends of its standard input and
 * output, -1 when closed. All descriptors are closed on exec. */
typedef struct dyd_process {
  pid_t pid, watcher;
  int in, out;
} dyd_process;

/* How a write ended. */
typedef enum dyd_written { DYD_WROTE, DYD_WRITE_LATER, DYD_WRITE_BROKEN } dyd_written;

/* A pipe whose ends are above 2 and closed on exec; false when there is none to be had, errno says why. */
bool dyd_pipe(int end[2]);
void dyd_close(int *fd);

/* Starts `command` with DYADEL_JOB=job. lifeline is the reading end of a pipe: when all its writing ends are closed,
 * the group is asked to end, and killed three seconds later. On failure *p is as after dyd_process_end. */
dyd_status dyd_process_start(dyd_process *p, const char *command, unsigned job, int lifeline, dyd_error *err);
/* Says in at most size bytes how the program ended; false when it still runs after `seconds`. */
bool dyd_process_ended(char *how, size_t size, const dyd_process *p, double seconds);
/* Returns true if the program has closed its standard input, all its copies of it. */
bool dyd_process_is_deaf(const dyd_process *p);
/* Writes without waiting and without SIGPIPE; *done becomes the number of bytes taken. */
dyd_written dyd_process_write(size_t *done, const dyd_process *p, const char *text, size_t length);
/* Closes both pipes, so that a program that reads on sees the end of its input. */
void dyd_process_close(dyd_process *p);
/* Asks the group to end (SIGTERM). The processes are still to be reaped. */
void dyd_process_stop(const dyd_process *p);
/* Closes both pipes and leaves the program to its owner: for the copy in a forked process. */
void dyd_process_disown(dyd_process *p);
/* Kills and reaps. Nothing to do for a process that never was ({0, 0, -1, -1}). */
void dyd_process_end(dyd_process *p);

/* The longest line taken. */
#define DYD_ORACLE_LINE ((size_t)1 << 20)

/* Copies a text for a message: in quotes, cut, with anything but printable ASCII as '?'. Returns out. */
char *dyd_quoted(char *out, size_t size, const char *text, size_t length);

#endif
