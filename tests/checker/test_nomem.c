/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The checker with every allocation failing once, for each certificate of a file as judge.c reads it: what memory fails
 * for is neither accepted nor rejected for it. Run under a leak checker. */
#include "checker/exhaust.h"

#include <stdlib.h>

static bool fails_well(size_t *faults, const char *text, size_t length) {
  char message[1400];
  size_t before = *faults;
  if (every_allocation_fails_well(message, sizeof message, faults, text, length)) return true;
  printf("%s:\n%.*s(%zu faults)\n", message, (int)length, text, *faults - before);
  return false;
}

int main(int argc, char **argv) {
  FILE *file = argc == 2 ? fopen(argv[1], "r") : NULL, *all = NULL;
  char *text = NULL, *line = NULL;
  size_t length = 0, cap = 0, faults = 0, certificates = 0;
  bool good = file;
  while (good && getline(&line, &cap, file) > 0) {
    if (!all) all = open_memstream(&text, &length);
    if (strncmp(line, "---- ", 5) != 0) {
      fputs(line, all);
      continue;
    }
    fclose(all);
    good = fails_well(&faults, text, length);
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
