/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Asking memory ahead of time. */
#ifndef DYD_BASE_PREFETCH_H
#define DYD_BASE_PREFETCH_H

static inline void dyd_prefetch(const void *address) {
#if defined(__GNUC__)
  __builtin_prefetch(address);
#else
  (void)address;
#endif
}

#endif
