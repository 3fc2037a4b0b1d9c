/* SPDX-License-Identifier: LGPL-3.0-or-later */
#define _DEFAULT_SOURCE 1 /* madvise */
#include "base/alloc.h"

#if defined(__linux__)
#include <sys/mman.h>
#include <unistd.h>
#endif

enum { LARGE = 1 << 20 };

void *dyd_alloc_in_large_pages(void *p, size_t bytes) {
#if defined(MADV_HUGEPAGE)
  if (!p || bytes < LARGE) return p;
  uintptr_t page = (uintptr_t)sysconf(_SC_PAGESIZE), end = ((uintptr_t)p + bytes) & ~(page - 1);
  uintptr_t begin = ((uintptr_t)p + page - 1) & ~(page - 1);
  (void)madvise((char *)p + (begin - (uintptr_t)p), end - begin, MADV_HUGEPAGE);
#else
  (void)bytes;
#endif
  return p;
}
