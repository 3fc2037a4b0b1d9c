/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Cancellation flag. */
#ifndef DYD_BASE_FLAG_H
#define DYD_BASE_FLAG_H

#include <stdbool.h>

/* Another thread or a signal handler may set the flag at any time. */
static inline bool dyd_flag_is_set(const volatile int *flag) {
  return flag && __atomic_load_n(flag, __ATOMIC_RELAXED);
}

#endif
