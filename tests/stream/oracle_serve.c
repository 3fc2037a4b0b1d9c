/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The other side of an oracle: a program that serves points, with faults on demand. */
#define _GNU_SOURCE /* usleep, NSIG */
#include "stream/oracle_serve.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

void oracle_floor(mpz_t out, unsigned long k, int axis, int64_t bits) {
  mpz_ui_pow_ui(out, k, axis ? 3 : 2);
  if (bits >= 0)
    mpz_mul_2exp(out, out, (mp_bitcnt_t)bits);
  else
    mpz_fdiv_q_2exp(out, out, (mp_bitcnt_t)-bits);
  mpz_fdiv_q_ui(out, out, 7);
}

/* The rectangle of point k, moved by `step` units, under the name of point `as`. */
static void answer(unsigned long as, unsigned long k, long bits, int step, const char *end) {
  mpz_t m;
  mpz_init(m);
  printf("%lu", as);
  for (int axis = 0; axis < 2; axis++) {
    oracle_floor(m, k, axis, bits);
    if (step >= 0)
      mpz_add_ui(m, m, (unsigned long)step);
    else
      mpz_sub_ui(m, m, (unsigned long)-step);
    gmp_printf(" %Zd*2^%ld", m, -bits);
    mpz_add_ui(m, m, 1);
    gmp_printf(" %Zd*2^%ld", m, -bits);
  }
  printf("%s", end);
  fflush(stdout);
  mpz_clear(m);
}

static void forever(void) {
  for (;;) pause();
}

static void flood(const char *text) {
  for (;;) fputs(text, stdout);
}

/* Text written unchanged. */
static const struct {
  const char *name, *text;
} lines[] = {{"rubbish", "lorem ipsum\n"},
             {"empty", "\n"},
             {"bytes", "\x1b[2J\xff\xfe 1 2\n"},
             {"nul", "2 0 1 0"},
             {"number", "2"},
             {"four", "2 0 1 0\n"},
             {"seven", "2 0 1 0 1 fixed 8\n"},
             {"sixth", "2 0 1 0 1 final\n"},
             {"exchanged", "2 1 0 0 1\n"},
             {"word", "2 0 1 0 one\n"},
             {"root", "2 0 1 0 sqrt(2)\n"},
             {"zero", "2 0 1/0 0 1\n"},
             {"infinite", "2 -inf inf 0 1\n"},
             {"range", "2 0 1e999999999 0 1\n"},
             {"wide", "2 -1000 1000 -1000 1000\n"},
             {"bare", "2\n"},
             {"negative", "-2 0 1 0 1\n"},
             {"glued", "22 0 1 0 1\n"},
             {"other", "3 0 1 0 1\n"}};

static int line_of(const char *fault) {
  for (size_t k = 0; k < sizeof lines / sizeof *lines; k++)
    if (strcmp(lines[k].name, fault) == 0) return (int)k;
  return -1;
}

/* A child that keeps the pipes, and does not care about anything. */
static void leave_child(void) {
  if (fork()) return;
  for (int s = 1; s < NSIG; s++) signal(s, SIG_IGN);
  forever();
}

static void misbehave(const char *fault, long bits) {
  int line = line_of(fault);
  if (line >= 0) {
    fputs(lines[line].text, stdout);
    if (strcmp(fault, "nul") == 0) fwrite("\0 1\n", 1, 4, stdout);
    if (strcmp(fault, "number") == 0) fputs("2 0 1 0 1\n", stdout);
    fflush(stdout);
    return;
  }
  if (strcmp(fault, "exit") == 0) _exit(3);
  if (strcmp(fault, "kill") == 0) raise(SIGKILL);
  if (strcmp(fault, "hang") == 0) forever();
  if (strcmp(fault, "drift") == 0) {
    answer(BAD_POINT, BAD_POINT, bits / 2 - 2, 1, "\n");
    return;
  }
  if (strcmp(fault, "flood") == 0) flood("0123456789");
  if (strcmp(fault, "child") == 0) {
    leave_child();
    _exit(3);
  }
  if (strcmp(fault, "stubborn") == 0) {
    for (int s = 1; s < NSIG; s++) signal(s, SIG_IGN);
    leave_child();
    forever();
  }
  if (strcmp(fault, "half") == 0) {
    fputs("2 0 1", stdout);
    fflush(stdout);
    _exit(0);
  }
  if (strcmp(fault, "mute") == 0) {
    close(STDOUT_FILENO);
    forever();
  }
  /* The rest answers well, and then... */
  answer(BAD_POINT, BAD_POINT, bits, 0, "\n");
  if (strcmp(fault, "twice") == 0) answer(BAD_POINT, BAD_POINT, bits, 0, "\n");
  if (strcmp(fault, "lines") == 0) flood("2 0 1 0 1\n");
  if (strcmp(fault, "blank") == 0) flood("\n");
  if (strcmp(fault, "last") == 0) _exit(0);
  if (strcmp(fault, "deaf") == 0) {
    close(STDIN_FILENO);
    forever();
  }
}

static void misbehave_at_start(const char *fault) {
  if (strcmp(fault, "start-exit") == 0) _exit(5);
  if (strcmp(fault, "start-hang") == 0) forever();
  if (strcmp(fault, "start-flood") == 0) flood("points 3 ");
  if (strcmp(fault, "start-rubbish") == 0) puts("hello, world");
  if (strcmp(fault, "start-minus") == 0) puts("points -3");
  if (strcmp(fault, "start-many") == 0) puts("points 999999999999");
  if (strcmp(fault, "start-more") == 0) puts("points 5 or so");
  if (strcmp(fault, "start-huge") == 0) puts("points 999999999");
  if (strcmp(fault, "start-child") == 0) {
    leave_child();
    _exit(0);
  }
  if (strcmp(fault, "start-differ") == 0) printf("points %d\n", 5 + atoi(getenv("DYADEL_JOB")));
  fflush(stdout);
}

/* Waits until `count` programs have come here, each leaving a mark in the folder. */
static void meet(const char *folder, int count) {
  char name[500];
  struct stat info;
  snprintf(name, sizeof name, "%s/%s", folder, getenv("DYADEL_JOB"));
  FILE *f = fopen(name, "w");
  if (f) fclose(f);
  for (int k = 0; k < count; usleep(2000)) {
    snprintf(name, sizeof name, "%s/%d", folder, k);
    if (stat(name, &info) == 0) k++;
  }
}

/* Reads `count` requests before it answers the first. */
static void gather(int count) {
  unsigned long point[64];
  long bits[64];
  for (int k = 0; k < count; k++)
    if (scanf("refine %lu %ld%*1[\n]", &point[k], &bits[k]) != 2) _exit(9);
  for (int k = 0; k < count; k++) answer(point[k], point[k], bits[k], 0, k % 2 ? "\r\n" : "\n");
}

int oracle_serve(int argc, char **argv) {
  const char *fault = argv[2];
  unsigned long n = strtoul(argv[3], NULL, 10), stage = strtoul(argv[4], NULL, 10), seen = 0, point;
  const char *more = argc > 5 ? argv[5] : "";
  long bits;
  if (strncmp(fault, "start-", 6) == 0) misbehave_at_start(fault);
  printf("points %lu\n", n);
  fflush(stdout);
  setvbuf(stdin, NULL, _IONBF, 0);
  if (strcmp(fault, "gather") == 0) gather(atoi(more));
  while (scanf("refine %lu %ld%*1[\n]", &point, &bits) == 2) {
    if (strcmp(fault, "meet") == 0) {
      meet(more, (int)stage);
      fault = "none";
    }
    if (strcmp(fault, "slow") == 0) usleep(5000);
    if (strcmp(fault, "noisy") == 0) fprintf(stderr, "asked for %lu\n", point);
    if (point == BAD_POINT && seen++ == stage && strcmp(fault, "none") != 0 && strcmp(fault, "slow") != 0)
      misbehave(fault, bits);
    else
      answer(point, point, bits, 0, "\n");
  }
  return 0;
}
