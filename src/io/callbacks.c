/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Files whose bytes come from, or go to, callbacks: what reads or writes a FILE then serves languages without one. */
#if defined(DYD_HAS_FOPENCOOKIE) && !defined(_GNU_SOURCE)
#define _GNU_SOURCE 1 /* fopencookie */
#endif
#include "base/error.h"
#include <dyadel/io.h>
#include <errno.h>
#include <stdlib.h>

#ifdef DYD_HAS_FOPENCOOKIE

/* Of put and get one is NULL. */
typedef struct byte_callback {
  dyd_put_fn put;
  dyd_get_fn get;
  void *user;
  bool failed;
} byte_callback;

static ssize_t callback_write(void *cookie, const char *bytes, size_t count) {
  byte_callback *b = cookie;
  if (!b->failed && b->put(b->user, bytes, count)) return (ssize_t)count;
  b->failed = true;
  errno = EIO;
  return 0;
}

static ssize_t callback_read(void *cookie, char *bytes, size_t room) {
  byte_callback *b = cookie;
  size_t got = 0;
  if (!b->failed && b->get(&got, b->user, bytes, room) && got <= room) return (ssize_t)got;
  b->failed = true;
  errno = EIO;
  return -1;
}

static int callback_close(void *cookie) {
  byte_callback *b = cookie;
  bool failed = b->failed;
  free(b);
  if (failed) errno = EIO;
  return failed ? -1 : 0;
}

#endif

dyd_status dyd_file_of_callback(FILE **out, dyd_put_fn put, dyd_get_fn get, void *user, dyd_error *err) {
  if (!put == !get) return dyd_fail_null(err);
#ifdef DYD_HAS_FOPENCOOKIE
  const cookie_io_functions_t call = {.read = callback_read, .write = callback_write, .close = callback_close};
  byte_callback *b = malloc(sizeof *b);
  if (b) *b = (byte_callback){.put = put, .get = get, .user = user};
  FILE *f = b ? fopencookie(b, put ? "w" : "r", call) : NULL;
  if (!f) free(b);
  if (!f) return dyd_fail_nomem(err);
  *out = f;
  return DYD_OK;
#else
  (void)out, (void)user;
  return dyd_fail(err, DYD_E_IO, "the C library of this system has no fopencookie; use a file or a pipe");
#endif
}
