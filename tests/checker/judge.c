/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Judges the certificates of a file, each ended by a line "---- " and its verdict: "rejected", or the counts accepted
 * as stated and proved. Exit status 1, and a word on which one, when a verdict is another; why something is rejected
 * does not count. A line "---- circle ", the degrees of four places and "yes" or "no" says whether they are seen to be
 * on one circle. test_seeded.py links it with checkers that have a fault. */
#include "checker/checker.h"
#include "checker/cocircular.h"

#include <stdlib.h>
#include <string.h>

static bool text_gets(const char *verdict, char *text, size_t length) {
  char found[200] = "rejected";
  dyd_certificate_report r = {DYD_SIZED(dyd_certificate_report)};
  FILE *in = length ? fmemopen(text, length, "r") : NULL;
  char ties[40] = "";
  dyd_error err;
  dyd_error_clear(&err);
  dyd_status st = in ? dyd_checker_verify(&r, in, &err) : DYD_E_PARSE;
  if (r.ties_unproved) snprintf(ties, sizeof ties, ", ties %zu", r.ties_unproved);
  if (st == DYD_OK)
    snprintf(found, sizeof found, "accepted: gaps %u, unproved %llu, triangles %zu, distance %d%s", r.gaps,
             (unsigned long long)r.unproved, r.triangles, r.distance_proved, ties);
  size_t end = strlen(found);
  if (r.sphere)
    snprintf(found + end, sizeof found - end, ", sphere: %zu places, %zu legal around, %zu open, %zu ties, %zu not",
             r.sphere_places, r.legal_around, r.indeterminate, r.tie, r.ties_unproved + r.legal_unproved);
  if (in) fclose(in);
  if (strcmp(found, verdict) != 0) printf("%s, not %s:\n%.*s", found, verdict, (int)length, text);
  return strcmp(found, verdict) == 0;
}

static bool circle_gets(char *line) {
  dyd_cert_region at[4];
  const dyd_cert_region *const four[4] = {&at[0], &at[1], &at[2], &at[3]};
  char *rest = NULL, *word = strtok_r(line, " ", &rest);
  for (int k = 0; k < 4; k++) dyd_cert_region_init(&at[k]);
  bool good = true;
  for (int k = 0; k < 8 && good; k++) {
    word = strtok_r(NULL, " ", &rest);
    good = word && mpq_set_str(at[k / 2].mid[k % 2], word, 10) == 0;
    if (good) mpq_canonicalize(at[k / 2].mid[k % 2]);
  }
  word = strtok_r(NULL, " ", &rest);
  good = good && word && strcmp(word, dyd_cert_are_cocircular(four) ? "yes" : "no") == 0;
  if (!good) printf("the circle before \"%s\" is judged otherwise\n", word ? word : "");
  for (int k = 0; k < 4; k++) dyd_cert_region_clear(&at[k]);
  return good;
}

int main(int argc, char **argv) {
  FILE *file = argc == 2 ? fopen(argv[1], "r") : NULL;
  char *text = NULL, *line = NULL;
  size_t length = 0, cap = 0, judged = 0;
  bool good = true;
  FILE *all = open_memstream(&text, &length);
  while (file && all && good && getline(&line, &cap, file) > 0) {
    if (strncmp(line, "---- ", 5) != 0) {
      fputs(line, all);
      continue;
    }
    fflush(all);
    line[strcspn(line, "\n")] = 0;
    good = strncmp(line + 5, "circle ", 7) == 0 ? circle_gets(line + 5) : text_gets(line + 5, text, length);
    judged++;
    rewind(all);
  }
  if (all) fclose(all);
  if (file) fclose(file);
  free(text);
  free(line);
  return !(good && judged);
}
