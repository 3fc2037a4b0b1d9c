/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Runs a target on the files of a folder and on random changes of them: a replacement where no fuzzer is installed, and
 * a way to repeat what a fuzzer found.
 *
 * Usage: fuzz-TARGET COUNT DICTIONARY FOLDER_OR_FILE...   (DYADEL_TEST_SEED, DYADEL_TEST_SCALE as everywhere) */
#include "support/random.h"
#include "targets.h"

#include <dirent.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>

enum { MOST = 1 << 16, MOST_SEEDS = 256, MOST_WORDS = 256, PATIENCE = 5 };

typedef struct text {
  size_t size;
  uint8_t byte[MOST];
} text;

static text *seed[MOST_SEEDS];
static size_t seeds, words, runs;
static char word[MOST_WORDS][64];
static double slowest;

static double seconds(void) {
  struct timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* The last input is kept in fuzz-last, so that what ends the process can be repeated. */
static void run_input(const text *t) {
  const char *last = getenv("DYADEL_FUZZ_LAST");
  FILE *out = last ? fopen(last, "wb") : NULL;
  if (out) {
    fwrite(t->byte, 1, t->size, out);
    fclose(out);
  }
  double begun = seconds();
  LLVMFuzzerTestOneInput(t->byte, t->size);
  double took = seconds() - begun;
  runs++;
  if (took > slowest) slowest = took;
  if (took < PATIENCE) return;
  fprintf(stderr, "an input of %zu bytes took %.1f s: %.*s\n", t->size, took, t->size < 400 ? (int)t->size : 400,
          (const char *)t->byte);
  exit(1);
}

static void read_seed(const char *path) {
  FILE *in = seeds < MOST_SEEDS ? fopen(path, "rb") : NULL;
  text *t = in ? malloc(sizeof *t) : NULL;
  if (t) {
    t->size = fread(t->byte, 1, MOST, in);
    seed[seeds++] = t;
  }
  if (in) fclose(in);
}

static int by_name(const struct dirent **a, const struct dirent **b) {
  return strcmp((*a)->d_name, (*b)->d_name);
}

static void read_seeds(const char *path) {
  struct dirent **entry;
  int n = scandir(path, &entry, NULL, by_name);
  if (n < 0) read_seed(path);
  for (int k = 0; k < n; k++) {
    char name[4096];
    if (entry[k]->d_name[0] != '.' && snprintf(name, sizeof name, "%s/%s", path, entry[k]->d_name) < (int)sizeof name)
      read_seed(name);
    free(entry[k]);
  }
  if (n >= 0) free(entry);
}

/* The byte behind a backslash, in the forms that libFuzzer takes: \\, \", \xAB; *at is moved to its end. */
static char escaped(char **at, const char *line) {
  unsigned byte;
  const char c = *++*at;
  if (c == '\\' || c == '"') return c;
  if (c == 'x' && sscanf(*at + 1, "%2x", &byte) == 1) return *at += 2, (char)byte;
  fprintf(stderr, "the dictionary has an escape that libFuzzer does not take: %s", line);
  exit(1);
}

/* Lines "word" of a dictionary of libFuzzer. */
static void read_words(const char *path) {
  char line[80];
  FILE *in = fopen(path, "r");
  while (in && words < MOST_WORDS && fgets(line, sizeof line, in)) {
    char *from = strchr(line, '"'), *to = strrchr(line, '"'), *at = word[words];
    if (!from || to == from) continue;
    for (from++; from < to; from++) *at++ = *from != '\\' ? *from : escaped(&from, line);
    words++;
  }
  if (in) fclose(in);
}

/* ---- changes ---- */

/* Replaces the bytes [at, at + cut) by `size` others. */
static void splice(text *t, size_t at, size_t cut, const void *bytes, size_t size) {
  if (t->size - cut + size > MOST) return;
  memmove(t->byte + at + size, t->byte + at + cut, t->size - at - cut);
  if (size) memcpy(t->byte + at, bytes, size);
  t->size += size - cut;
}

static void change(text *t, test_random *r) {
  size_t at = t->size ? test_u64(r) % (t->size + 1) : 0, rest = t->size - at, length = rest ? test_u64(r) % rest : 0;
  const text *other = seed[test_u64(r) % seeds];
  const char *w = words ? word[test_u64(r) % words] : "";
  uint8_t byte = (uint8_t)test_u64(r), digit = (uint8_t)('0' + byte % 10);
  if (length > 40) length %= 40;
  switch (test_u64(r) % 7) {
  case 0:
    splice(t, at, rest > 0, &byte, 1);
    break;
  case 1:
    splice(t, at, rest > 0, &digit, 1);
    break;
  case 2:
    splice(t, at, length, w, strlen(w));
    break;
  case 3:
    splice(t, at, 0, w, strlen(w));
    break;
  case 4:
    splice(t, at, length, NULL, 0);
    break;
  case 5: {
    size_t from = other->size ? test_u64(r) % other->size : 0, most = other->size - from;
    splice(t, at, length, other->byte + from, most > 60 ? test_u64(r) % 60 : most);
    break;
  }
  default:
    if (length) {
      uint8_t piece[40];
      memcpy(piece, t->byte + at, length);
      splice(t, at, 0, piece, length);
    }
  }
}

int main(int argc, char **argv) {
  static text t;
  if (argc < 4) return 2;
  size_t count = test_cases(strtoull(argv[1], NULL, 10));
  read_words(argv[2]);
  for (int k = 3; k < argc; k++) read_seeds(argv[k]);
  if (!seeds) return 2;
  test_random r = test_random_start(argv[0]);
  for (size_t k = 0; k < seeds; k++) run_input(seed[k]);
  for (size_t k = 0; k < count; k++) {
    t = *seed[test_u64(&r) % seeds];
    for (size_t n = 1 + test_u64(&r) % 6; n > 0; n--) change(&t, &r);
    run_input(&t);
  }
  printf("%zu executions, the slowest %.2f s of CPU time\n", runs, slowest);
  for (size_t k = 0; k < seeds; k++) free(seed[k]);
  return 0;
}
