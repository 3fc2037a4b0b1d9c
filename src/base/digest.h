/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* A digest of bytes (FNV-1a, Fowler, Noll and Vo): one byte changed changes it; no protection against forgers. */
#ifndef DYD_BASE_DIGEST_H
#define DYD_BASE_DIGEST_H

#include <stddef.h>
#include <stdint.h>

#define DYD_DIGEST_BEGIN UINT64_C(14695981039346656037)
#define DYD_DIGEST_PRIME UINT64_C(1099511628211)

/* Returns the digest of the bytes before, continued. */
static inline uint64_t dyd_digest(uint64_t digest, const void *bytes, size_t count) {
  const unsigned char *byte = bytes;
  for (size_t k = 0; k < count; k++) digest = (digest ^ byte[k]) * DYD_DIGEST_PRIME;
  return digest;
}

#endif
