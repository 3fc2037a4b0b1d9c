/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Independent tasks side by side.
 *
 * What a task does may depend on its number only, never on the thread that runs it or on how many there are: then
 * results are the same for every number of threads. */
#ifndef DYD_BASE_PARALLEL_H
#define DYD_BASE_PARALLEL_H

#include <pthread.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef void dyd_task(void *context, size_t number);

/* Runs task(context, 0 .. tasks - 1), each once, in any order, on the calling thread and at most threads - 1 others,
 * which are started with all signals blocked and have ended when this returns. Where threads cannot be started, those
 * there are do all the work. What tasks wrote is visible to the caller afterwards. */
void dyd_parallel(unsigned threads, size_t tasks, dyd_task *task, void *context);

/* Starts up to `want` threads, all signals blocked, since handlers stay with the threads of the program; how many. */
unsigned dyd_start_helpers(pthread_t *helper, unsigned want, void *(*work)(void *), void *context);

/* A long loop over 0 .. count - 1 is cut into DYD_RANGES_MOST ranges or fewer, by count alone. The armed build cuts
 * short ones, too. */
enum { DYD_RANGES_MOST = 64 };

/* How many. */
size_t dyd_ranges(size_t count);
/* First item of range `number`; of the range after the last: count. */
size_t dyd_range_begin(size_t count, size_t number);
/* For the items begin .. end - 1, which are range `number`. */
typedef void dyd_range_task(void *context, size_t number, size_t begin, size_t end);
/* As dyd_parallel, a task for each range of 0 .. count - 1. Returns how many there were. */
size_t dyd_parallel_ranges(unsigned threads, size_t count, dyd_range_task *task, void *context);

/* ---- work apart ----
 *
 * Long work that cannot be interrupted, such as one function of millions of digits: a thread of its own does it, so
 * that the caller can leave. */

/* Does work(job) in another thread. true: it is done. false: *stop was set before; the thread continues without a
 * waiting caller, and calls drop(job) at its end: until then all that job points to is its own. stop NULL, and where no
 * thread can be had: the calling thread does it. */
bool dyd_run_detached(void (*work)(void *job), void (*drop)(void *job), void *job, const volatile int *stop);

#endif
