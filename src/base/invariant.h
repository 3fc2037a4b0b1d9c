/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Invariant checks, armed only in the build that the tests link. */
#ifndef DYD_BASE_INVARIANT_H
#define DYD_BASE_INVARIANT_H

#ifdef DYD_ARMED
#include <stdio.h>
#include <stdlib.h>
#define DYD_INVARIANT(condition)                                                                                       \
  do {                                                                                                                 \
    if (!(condition)) {                                                                                                \
      fprintf(stderr, "%s:%d: invariant broken: %s\n", __FILE__, __LINE__, #condition);                                \
      abort();                                                                                                         \
    }                                                                                                                  \
  } while (0)
#else
#define DYD_INVARIANT(condition) ((void)0)
#endif

#endif
