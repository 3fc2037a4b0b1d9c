/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* A shell command that runs next to the caller.
 *
 * The command is the leader of a process group of its own. A second shell in the group, the watcher, reads from a pipe
 * without a writer, the lifeline: when the last writing end is closed, by dyd_oracle_free or because the process
 * that holds it is dead, it kills the group, itself included. A leader that has ended is left unreaped to the last, so
 * that the number of the group cannot become that of a stranger. */
#define _GNU_SOURCE /* pipe2 */
#include "stream/process.h"

#include "base/alloc.h"
#include "base/clock.h"
#include "base/error.h"
#include "base/local.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

static void sleep_for(double seconds) {
  struct timespec t = {.tv_sec = (time_t)seconds};
  t.tv_nsec = (long)((seconds - (double)t.tv_sec) * 1e9);
  nanosleep(&t, NULL);
}

void dyd_close(int *fd) {
  if (*fd >= 0) close(*fd);
  *fd = -1;
}

/* Moves a descriptor above the three standard ones. */
static bool raise_fd(int *fd) {
  if (*fd > STDERR_FILENO) return true;
  int high = fcntl(*fd, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  if (high < 0) return false;
  close(*fd);
  *fd = high;
  return true;
}

bool dyd_pipe(int end[2]) {
  if (pipe2(end, O_CLOEXEC)) {
    end[0] = end[1] = -1;
    return false;
  }
  if (raise_fd(&end[0]) && raise_fd(&end[1])) return true;
  int why = errno;
  dyd_close(&end[0]);
  dyd_close(&end[1]);
  errno = why;
  return false;
}

/* ---- starting ---- */

/* What a child gets: its group (0: its own), standard input and output (out < 0: output and errors go nowhere), and the
 * signals as a fresh program has them. Returns an errno. */
static int spawn_child(pid_t *pid, pid_t group, int in, int out, char *const argv[], char *const env[]) {
  posix_spawnattr_t attr;
  posix_spawn_file_actions_t files;
  sigset_t none, all;
  sigemptyset(&none);
  sigfillset(&all);
  int why = posix_spawnattr_init(&attr);
  if (why) return why;
  why = posix_spawn_file_actions_init(&files);
  if (why) {
    posix_spawnattr_destroy(&attr);
    return why;
  }
  posix_spawnattr_setflags(&attr, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  posix_spawnattr_setpgroup(&attr, group);
  posix_spawnattr_setsigmask(&attr, &none);
  posix_spawnattr_setsigdefault(&attr, &all);
  why = posix_spawn_file_actions_adddup2(&files, in, STDIN_FILENO);
  for (int fd = STDOUT_FILENO; !why && fd <= (out < 0 ? STDERR_FILENO : STDOUT_FILENO); fd++)
    why = out < 0 ? posix_spawn_file_actions_addopen(&files, fd, "/dev/null", O_WRONLY, 0)
                  : posix_spawn_file_actions_adddup2(&files, out, fd);
  if (!why) why = posix_spawn(pid, "/bin/sh", &files, &attr, argv, env);
  posix_spawn_file_actions_destroy(&files);
  posix_spawnattr_destroy(&attr);
  return why;
}

/* exec takes arguments that it promises not to change. */
static char *shell_word(const char *word) {
  union {
    const char *given;
    char *taken;
  } w = {.given = word};
  return w.taken;
}

/* The environment with DYADEL_JOB, whose text is borrowed, in the place of a former one. NULL: memory is exhausted. */
static char **make_environment(char *job) {
  size_t n = 0, kept = 0;
  while (environ[n]) n++;
  char **env = dyd_alloc(n + 2, sizeof *env);
  if (!env) return NULL;
  for (size_t k = 0; k < n; k++)
    if (strncmp(environ[k], "DYADEL_JOB=", 11) != 0) env[kept++] = environ[k];
  env[kept++] = job;
  env[kept] = NULL;
  return env;
}

static int spawn_command(pid_t *pid, const char *command, unsigned number, int in, int out) {
  char job[40];
  snprintf(job, sizeof job, "DYADEL_JOB=%u", number);
  DYD_FREED char **env = make_environment(job);
  if (!env) return ENOMEM;
  char *const argv[] = {shell_word("sh"), shell_word("-c"), shell_word(command), NULL};
  return spawn_child(pid, 0, in, out, argv, env);
}

/* Ends the group when the lifeline does: each that can ends in an orderly way, as programs with processes elsewhere do.
 */
static int spawn_watcher(pid_t *pid, pid_t group, int lifeline) {
  char leader[24];
  snprintf(leader, sizeof leader, "%ld", (long)group);
  char *const argv[] = {shell_word("sh"),
                        shell_word("-c"),
                        shell_word("trap '' TERM; read _; kill -s TERM 0; "
                                   "for _ in 1 2 3; do kill -s 0 $1 || break; sleep 1; done; kill -s KILL 0"),
                        shell_word("dyadel-watcher"),
                        leader,
                        NULL};
  return spawn_child(pid, group, lifeline, -1, argv, environ);
}

static bool unblock_descriptor(int fd) {
  int flags = fcntl(fd, F_GETFL);
  return flags >= 0 && fcntl(fd, F_SETFL, flags | O_NONBLOCK) >= 0;
}

/* The ends of the child are closed in every case. Returns an errno. */
static int start_program(dyd_process *p, const char *command, unsigned job, int lifeline) {
  int to[2] = {-1, -1}, from[2] = {-1, -1};
  int why = dyd_pipe(to) && dyd_pipe(from) && unblock_descriptor(to[1]) && unblock_descriptor(from[0]) ? 0 : errno;
  p->in = to[1];
  p->out = from[0];
  if (!why) why = spawn_command(&p->pid, command, job, to[0], from[1]);
  if (why)
    p->pid = 0;
  else
    why = spawn_watcher(&p->watcher, p->pid, lifeline);
  if (why) p->watcher = 0;
  dyd_close(&to[0]);
  dyd_close(&from[1]);
  return why;
}

dyd_status dyd_process_start(dyd_process *p, const char *command, unsigned job, int lifeline, dyd_error *err) {
  *p = (dyd_process){.in = -1, .out = -1};
  int why = start_program(p, command, job, lifeline);
  if (!why) return DYD_OK;
  dyd_process_end(p);
  if (why == ENOMEM) return dyd_fail_nomem(err);
  return dyd_fail(err, DYD_E_STREAM,
                  "the oracle program cannot be started: %s; ask for fewer jobs, or raise the limits of the system",
                  strerror(why));
}

/* ---- looking ---- */

/* 1 ended, 0 runs, -1 the caller's process has reaped it or does not allow waiting. */
static int process_look(siginfo_t *info, pid_t pid) {
  info->si_pid = 0;
  int failed = waitid(P_PID, (id_t)pid, info, WEXITED | WNOHANG | WNOWAIT);
  if (failed) return errno == EINTR ? 0 : -1;
  return info->si_pid != 0;
}

static void process_describe(char *how, size_t size, const siginfo_t *info) {
  if (info->si_code != CLD_EXITED) {
    snprintf(how, size, "it was killed by signal %d", info->si_status);
    return;
  }
  const char *note = "";
  if (info->si_status == 127) note = " (the shell did not find the command)";
  if (info->si_status == 126) note = " (the shell may not run the command)";
  snprintf(how, size, "it ended with exit status %d%s", info->si_status, note);
}

bool dyd_process_ended(char *how, size_t size, const dyd_process *p, double seconds) {
  siginfo_t info;
  double until = dyd_seconds() + seconds;
  for (double nap = 0.001; p->pid; nap = nap < 0.05 ? 2 * nap : nap) {
    int ended = process_look(&info, p->pid);
    if (ended > 0) process_describe(how, size, &info);
    if (ended < 0) snprintf(how, size, "it ended");
    if (ended) return true;
    if (dyd_seconds() >= until) return false;
    sleep_for(nap);
  }
  snprintf(how, size, "it ended");
  return true;
}

bool dyd_process_is_deaf(const dyd_process *p) {
  struct pollfd fd = {.fd = p->in};
  return p->in < 0 || (poll(&fd, 1, 0) > 0 && fd.revents & POLLERR);
}

/* ---- writing ---- */

/* write() with SIGPIPE held back in this thread; one that it raised is taken away, one that was there before stays. */
static ssize_t write_quietly(int fd, const char *text, size_t length) {
  sigset_t pipe, before, pending;
  int number;
  sigemptyset(&pipe);
  sigaddset(&pipe, SIGPIPE);
  sigpending(&pending);
  bool was = sigismember(&pending, SIGPIPE) == 1;
  if (pthread_sigmask(SIG_BLOCK, &pipe, &before)) return -1;
  ssize_t done = write(fd, text, length);
  int why = errno;
  if (done < 0 && why == EPIPE && !was) {
    sigpending(&pending);
    if (sigismember(&pending, SIGPIPE) == 1) sigwait(&pipe, &number);
  }
  pthread_sigmask(SIG_SETMASK, &before, NULL);
  errno = why;
  return done;
}

dyd_written dyd_process_write(size_t *done, const dyd_process *p, const char *text, size_t length) {
  ssize_t n = write_quietly(p->in, text, length);
  *done = n > 0 ? (size_t)n : 0;
  if (n >= 0) return DYD_WROTE;
  return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR ? DYD_WRITE_LATER : DYD_WRITE_BROKEN;
}

/* ---- ending ---- */

void dyd_process_close(dyd_process *p) {
  dyd_close(&p->in);
  dyd_close(&p->out);
}

void dyd_process_stop(const dyd_process *p) {
  if (p->pid > 0) kill(-p->pid, SIGTERM);
}

void dyd_process_disown(dyd_process *p) {
  dyd_process_close(p);
  p->pid = p->watcher = 0;
}

/* A child of ours that was killed. */
static void process_reap(pid_t *pid) {
  while (*pid > 0 && waitpid(*pid, NULL, 0) < 0 && errno == EINTR) continue;
  *pid = 0;
}

void dyd_process_end(dyd_process *p) {
  dyd_process_close(p);
  if (p->pid > 0) kill(-p->pid, SIGKILL);
  process_reap(&p->watcher);
  process_reap(&p->pid);
}

char *dyd_quoted(char *out, size_t size, const char *text, size_t length) {
  enum { MOST = 60 };
  size_t n = 0, shown = length < MOST ? length : MOST;
  if (size < MOST + 6) shown = 0;
  out[n++] = '"';
  for (size_t k = 0; k < shown; k++) out[n++] = text[k] >= ' ' && text[k] <= '~' ? text[k] : '?';
  out[n++] = '"';
  strcpy(out + n, shown < length ? "..." : "");
  return out;
}
