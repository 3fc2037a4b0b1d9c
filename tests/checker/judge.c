/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Judges the certificates of a file, each ended by a line "----": one line of output for each, "rejected: " and why, or
 * what is stated and proved. For test_seeded.py, which links it with a checker that has a fault. */
#include <dyadel/certificate.h>

#include <stdlib.h>
#include <string.h>

static void judge_text(char *text, size_t length) {
  dyd_certificate_report r = {DYD_SIZED(dyd_certificate_report)};
  dyd_error err;
  dyd_error_clear(&err);
  FILE *in = length ? fmemopen(text, length, "r") : NULL;
  if (in && dyd_verify_certificate(&r, in, &err) == DYD_OK)
    printf("accepted: gaps %u, unproved %llu, triangles %zu, distance %d\n", r.gaps, (unsigned long long)r.unproved,
           r.triangles, r.distance_proved);
  else
    printf("rejected: %s\n", err.message);
  if (in) fclose(in);
}

int main(int argc, char **argv) {
  FILE *file = argc == 2 ? fopen(argv[1], "r") : NULL;
  char *text = NULL, *line = NULL;
  size_t length = 0, size = 0, cap = 0;
  if (!file) return 1;
  FILE *all = open_memstream(&text, &length);
  while (all && getline(&line, &cap, file) > 0) {
    if (strcmp(line, "----\n") != 0) {
      fputs(line, all);
      continue;
    }
    fflush(all);
    size = length;
    judge_text(text, size);
    rewind(all);
  }
  if (all) fclose(all);
  fclose(file);
  free(text);
  free(line);
  return 0;
}
