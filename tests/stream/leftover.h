/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Is anything left behind? Processes are found by a mark in their environment, wherever they went. */
#ifndef DYD_TESTS_STREAM_LEFTOVER_H
#define DYD_TESTS_STREAM_LEFTOVER_H

/* Puts a mark into the environment, and remembers how many descriptors are open. */
void leftover_mark(void);
/* Other processes that carry the mark. */
int count_marked(void);
int count_descriptors(void);
/* Within two seconds no marked process is left; no child exists, not even a zombie; no descriptor was leaked; SIGPIPE
 * is as it was and not pending. */
void assert_nothing_left(void);

#endif
