/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Large arrays. */
#define _DEFAULT_SOURCE /* madvise */

#include "base/alloc.h"

#include <sys/mman.h>

enum { HUGE_PAGE = 1 << 21 };

void *dyd_alloc_large(size_t bytes) {
#ifdef MADV_HUGEPAGE
  if (bytes > SIZE_MAX - HUGE_PAGE) return NULL;
  size_t whole = bytes / HUGE_PAGE * HUGE_PAGE;
  void *p = aligned_alloc(HUGE_PAGE, whole + HUGE_PAGE);
  if (p) (void)madvise(p, whole, MADV_HUGEPAGE); /* a wish: without it only slower */
  return p;
#else
  return malloc(bytes);
#endif
}
