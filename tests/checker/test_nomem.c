/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The checker with every allocation failing once, for each certificate of a file as judge.c reads it: what memory fails
 * for is neither accepted nor rejected for it. Run under a leak checker. */
#define _GNU_SOURCE /* fopencookie */
#include "checker/exhaust.h"

#include <errno.h>
#include <stdlib.h>

static bool fails_well(size_t *faults, const char *text, size_t length) {
  char message[1400];
  size_t before = *faults;
  if (every_allocation_fails_well(message, sizeof message, faults, text, length)) return true;
  printf("%s:\n%.*s(%zu faults)\n", message, (int)length, text, *faults - before);
  return false;
}

#ifdef DYD_HAS_FOPENCOOKIE
/* Text that cannot be read from some place on. */
typedef struct broken {
  const char *text;
  size_t at, end;
} broken;

static ssize_t broken_read(void *cookie, char *out, size_t size) {
  broken *b = cookie;
  size_t left = b->end - b->at, count = size < left ? size : left;
  errno = EIO;
  memcpy(out, b->text + b->at, count);
  b->at += count;
  return count ? (ssize_t)count : -1;
}

/* Every line ends there once, and every 40th byte of long ones. */
static size_t next_end(const char *text, size_t end, size_t length) {
  const char *line = end < length ? memchr(text + end, '\n', length - end) : NULL;
  size_t next = line ? (size_t)(line - text) + 1 : length;
  return end == length ? length + 1 : next - end > 40 ? end + 40 : next;
}

/* What cannot be read to its end is neither accepted nor rejected, however much of it could be. */
static bool breaks_well(const char *text, size_t length) {
  dyd_certificate_report r = {DYD_SIZED(dyd_certificate_report)};
  dyd_error err;
  for (size_t end = 0; end <= length; end = next_end(text, end, length)) {
    broken b = {text, 0, end};
    FILE *in = fopencookie(&b, "r", (cookie_io_functions_t){.read = broken_read});
    dyd_status status = dyd_verify_certificate(&r, in, NULL, &err);
    fclose(in);
    if (status == DYD_E_IO && err.code == DYD_E_IO && strncmp(err.message, "cannot read: ", 13) == 0) continue;
    printf("read up to %zu of %zu bytes: %d\n%s", end, length, status, text);
    return false;
  }
  return true;
}
#else
static bool breaks_well(const char *text, size_t length) {
  (void)text, (void)length;
  return true;
}
#endif

/* These take a hundred times as long as others: one of them will do. */
static bool boxes_give_up(const char *text) {
  return strstr(text, "\nboxes ") && !strstr(text, "\nunproved 0\n");
}

int main(int argc, char **argv) {
  FILE *file = argc == 2 ? fopen(argv[1], "r") : NULL, *all = NULL;
  char *text = NULL, *line = NULL;
  size_t length = 0, cap = 0, faults = 0, certificates = 0, given_up = 0;
  bool good = file;
  while (good && getline(&line, &cap, file) > 0) {
    if (!all) all = open_memstream(&text, &length);
    if (strncmp(line, "---- ", 5) != 0) {
      fputs(line, all);
      continue;
    }
    fclose(all);
    if (!boxes_give_up(text) || ++given_up == 1)
      good = fails_well(&faults, text, length) && (line[5] != 'a' || breaks_well(text, length));
    certificates++;
    free(text);
    all = NULL;
  }
  if (all) fclose(all), free(text);
  if (file) fclose(file);
  free(line);
  printf("%zu faults in %zu certificates\n", faults, certificates);
  return !(good && certificates);
}
