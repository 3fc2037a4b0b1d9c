/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* One program of an oracle: its requests, its answers, and the reason why it accepts no more requests. */
#ifndef DYD_STREAM_ORACLE_WORKER_H
#define DYD_STREAM_ORACLE_WORKER_H

#include "base/clock.h"
#include <dyadel/status.h>
#include <dyadel/stream.h>
#include <stdbool.h>
#include <stddef.h>
#include <sys/types.h>

/* A shell command that runs next to the caller: pipes to and from it, and a certain end for it and all its children. */

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

/* The longest line taken, and how many bytes of answers wait at most (and one line) before no more are read. */
#define DYD_ORACLE_LINE ((size_t)1 << 20)
#define DYD_ORACLE_HELD ((size_t)1 << 20)

/* A request and its answer. The line "points N" is the answer to point DYD_NO_POINT. */
typedef struct dyd_asked {
  size_t point;
  int64_t bits;
  char *answer;  /* the whole line without its end, terminated by a NUL byte of ours; NULL: none yet, or not wanted */
  size_t length; /* of the answer */
  bool wanted;
} dyd_asked;

/* A queue of requests, two buffers, and a process.
 * Invariant: head <= answered <= sent <= count; of asked[]: from head on not yet collected, before `answered` answered,
 * before `sent` handed to `text`. held is the sum of the lengths of the answers held. Answers come in order, so those
 * of requests no longer wanted come first. failed: why has the reason, and nothing more is read or written. */
typedef struct dyd_worker {
  dyd_process process;
  dyd_asked *asked;
  size_t head, answered, sent, count, cap;
  size_t held;
  char *line; /* bytes read, not yet a whole line; the first `scanned` hold no line end */
  size_t line_length, line_cap, scanned;
  char *text; /* bytes to write, from text_done on */
  size_t text_length, text_done, text_cap;
  unsigned batch;
  bool deaf; /* it has closed its standard input */
  bool failed;
  double heard; /* when the last whole line came */
  dyd_status code;
  char why[DYD_MESSAGE_SIZE / 2];
} dyd_worker;

void dyd_worker_init(dyd_worker *w, unsigned batch);
/* Ends the process and releases everything. */
void dyd_worker_clear(dyd_worker *w);

/* w, new, takes over the requests of `old`, whose process has ended: answers stay, unanswered requests are to be sent
 * again. `old` is left empty. */
void dyd_worker_adopt(dyd_worker *w, dyd_worker *old);
/* Appends a request; false: memory is exhausted. */
bool dyd_worker_ask(dyd_worker *w, size_t point, int64_t bits);
/* Appends the request that is answered by the first line of the program, and that is not sent. */
bool dyd_worker_expect_count(dyd_worker *w);
/* Drops requests not yet sent; answers to the others are not wanted any more. */
void dyd_worker_forget(dyd_worker *w);
/* The first request that is wanted, NULL when there is none. */
dyd_asked *dyd_worker_first(dyd_worker *w);
/* Returns true if the first request that is wanted is answered. Then it is at asked[head]. */
bool dyd_worker_is_answered(dyd_worker *w);
/* Takes the answered request at asked[head] off the queue. */
void dyd_worker_drop(dyd_worker *w);
/* Returns true, with failed set, if the first request can no longer be answered. */
bool dyd_worker_is_lost(dyd_worker *w);

/* Return true if reading, or writing, may be possible. */
bool dyd_worker_reads(const dyd_worker *w);
bool dyd_worker_writes(const dyd_worker *w);
/* Puts requests into the text to write, as far as the batch allows: again when half of those sent are answered. */
void dyd_worker_fill(dyd_worker *w);
/* Read and write as much as possible without waiting. */
void dyd_worker_hear(dyd_worker *w);
void dyd_worker_tell(dyd_worker *w);

/* From now on w has failed; its group is killed. */
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
void
dyd_worker_fail(dyd_worker *w, dyd_status code, const char *format, ...);
/* Copies a text for a message: in quotes, cut, with anything but printable ASCII as '?'. Returns out. */
char *dyd_quoted(char *out, size_t size, const char *text, size_t length);

#endif
