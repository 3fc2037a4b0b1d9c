/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Long work that cannot be interrupted, such as one function of millions of digits: a thread of its own does it, so
 * that the caller can leave. */
#ifndef DYD_BASE_APART_H
#define DYD_BASE_APART_H

#include <stdbool.h>

/* Does work(job) in another thread. true: it is done. false: *stop was set before; the thread goes on without anybody
 * waiting, and calls drop(job) at its end: until then all that job points to is its own. stop NULL, and where no thread
 * can be had: the calling thread does it. */
bool dyd_apart(void (*work)(void *job), void (*drop)(void *job), void *job, const volatile int *stop);

#endif
