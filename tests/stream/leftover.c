/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Is anything left behind? */
#define _GNU_SOURCE /* memmem */
#include "stream/leftover.h"

#include "stream/harness.h"
#include <ctype.h>
#include <dirent.h>
#include <errno.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

static char mark[80];
static int descriptors;

int count_descriptors(void) {
  int count = -1; /* the folder itself */
  DIR *folder = opendir("/proc/self/fd");
  assert_non_null(folder);
  for (struct dirent *entry; (entry = readdir(folder));) count += entry->d_name[0] != '.';
  closedir(folder);
  return count;
}

void leftover_mark(void) {
  snprintf(mark, sizeof mark, "DYADEL_TEST_MARK=%ld.%ld", (long)getpid(), (long)time(NULL));
  putenv(mark);
  descriptors = count_descriptors();
}

static bool is_marked(const char *pid) {
  char name[300], text[20000];
  snprintf(name, sizeof name, "/proc/%s/environ", pid);
  FILE *f = fopen(name, "r");
  if (!f) return false;
  size_t length = fread(text, 1, sizeof text, f);
  fclose(f);
  return memmem(text, length, mark, strlen(mark)) != NULL;
}

int count_marked(void) {
  int count = 0;
  DIR *folder = opendir("/proc");
  assert_non_null(folder);
  for (struct dirent *entry; (entry = readdir(folder));)
    if (isdigit((unsigned char)entry->d_name[0]) && atol(entry->d_name) != getpid()) count += is_marked(entry->d_name);
  closedir(folder);
  return count;
}

void assert_nothing_left(void) {
  sigset_t pending;
  struct sigaction pipe;
  for (int k = 0; k < 600 && count_marked(); k++) usleep(10000); /* a stubborn program has three seconds */
  assert_int_equal(0, count_marked());
  assert_int_equal(-1, waitpid(-1, NULL, WNOHANG));
  assert_int_equal(ECHILD, errno);
  assert_int_equal(descriptors, count_descriptors());
  sigpending(&pending);
  assert_int_equal(0, sigismember(&pending, SIGPIPE));
  sigaction(SIGPIPE, NULL, &pipe);
  assert_true(pipe.sa_handler == SIG_DFL);
}
