/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Invariant checks, armed only in the verify build that the tests link. */
#ifndef DYD_BASE_VERIFY_H
#define DYD_BASE_VERIFY_H

#ifdef DYD_VERIFY
#include <stdio.h>
#include <stdlib.h>
#define DYD_CHECK(condition)                                                                                           \
  do {                                                                                                                 \
    if (!(condition)) {                                                                                                \
      fprintf(stderr, "%s:%d: invariant broken: %s\n", __FILE__, __LINE__, #condition);                                \
      abort();                                                                                                         \
    }                                                                                                                  \
  } while (0)
#else
#define DYD_CHECK(condition) ((void)0)
#endif

#endif
