/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Faults on demand, for LD_PRELOAD: the n-th call of a kind fails, as set by the environment.
 *
 *   FAULT_CALL   "alloc", or the name of a function below
 *   FAULT_IN     alloc: only calls from objects whose file name contains this
 *   FAULT_AT     n, counted from 1; 0: none fails
 *   FAULT_ON     with any value: so do all that follow
 *   FAULT_ERRNO  what errno says of it (EIO)
 *   FAULT_SIGNAL a signal that the process gets as soon as mkstemp has made a file
 *   FAULT_LOCALE with any value: the locale is that of the environment, as in programs that call setlocale
 *   FAULT_SYNCED a file that gets a line "INODE SIZE" for each file that is brought to the disk
 *   FAULT_POWER  n: the process is killed when it is about to sync, link or rename a file for the n-th time
 *   FAULT_COUNT  a file that is given the number of calls when the process ends in the usual way */
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <link.h>
#include <locale.h>
#include <pthread.h>
#include <signal.h>
#include <spawn.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *old, size_t size);

enum { MOST_RANGES = 64 };
static struct { uintptr_t begin, end; } range[MOST_RANGES];
static size_t ranges;
static const char *call, *inside;
static atomic_long *seen; /* by children, too */
static long at;
static int on, error;

/* ---- the fault requested ---- */

static int note_object(struct dl_phdr_info *info, size_t size, void *unused) {
  (void)size, (void)unused;
  const char *name = info->dlpi_name;
  char self[4096] = "";
  if (!*name && readlink("/proc/self/exe", self, sizeof self - 1) > 0) name = self;
  const char *slash = strrchr(name, '/');
  if (!strstr(slash ? slash : name, inside)) return 0;
  for (int k = 0; k < info->dlpi_phnum && ranges < MOST_RANGES; k++) {
    const ElfW(Phdr) *p = &info->dlpi_phdr[k];
    if (p->p_type != PT_LOAD || !(p->p_flags & PF_X)) continue;
    range[ranges].begin = info->dlpi_addr + p->p_vaddr;
    range[ranges++].end = info->dlpi_addr + p->p_vaddr + p->p_memsz;
  }
  return 0;
}

static void read_number(const char *name, long *out) {
  const char *text = getenv(name);
  if (text) *out = atol(text);
}

__attribute__((constructor)) static void faults_begin(void) {
  long number = EIO;
  void *shared = mmap(NULL, sizeof *seen, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (shared == MAP_FAILED) abort();
  seen = shared;
  if (getenv("FAULT_LOCALE")) setlocale(LC_ALL, "");
  inside = getenv("FAULT_IN");
  read_number("FAULT_AT", &at);
  read_number("FAULT_ERRNO", &number);
  error = (int)number;
  on = getenv("FAULT_ON") != NULL;
  if (inside) dl_iterate_phdr(note_object, NULL);
  call = getenv("FAULT_CALL");
}

__attribute__((destructor)) static void faults_end(void) {
  const char *name = getenv("FAULT_COUNT");
  int fd = name ? (int)syscall(SYS_openat, AT_FDCWD, name, O_WRONLY | O_CREAT | O_TRUNC, 0666) : -1;
  if (fd < 0) return;
  dprintf(fd, "%ld\n", atomic_load(seen));
  close(fd);
}

static int counted_fails(void) {
  long k = atomic_fetch_add(seen, 1) + 1;
  if (!at || (on ? k < at : k != at)) return 0;
  errno = error;
  return 1;
}

static int fails(const char *name) {
  return call && strcmp(call, name) == 0 && counted_fails();
}

/* ---- memory ---- */

static int alloc_fails(const void *caller) {
  uintptr_t from = (uintptr_t)caller;
  if (!call || strcmp(call, "alloc") != 0) return 0;
  for (size_t k = 0; k < ranges; k++)
    if (range[k].begin <= from && from < range[k].end) return counted_fails();
  return 0;
}

void *malloc(size_t size) {
  return alloc_fails(__builtin_return_address(0)) ? NULL : __libc_malloc(size);
}
void *calloc(size_t count, size_t size) {
  return alloc_fails(__builtin_return_address(0)) ? NULL : __libc_calloc(count, size);
}
void *realloc(void *old, size_t size) {
  return alloc_fails(__builtin_return_address(0)) ? NULL : __libc_realloc(old, size);
}

/* ---- files, processes, threads ---- */

#define NEXT(name) (__extension__(__typeof__(&name)) dlsym(RTLD_NEXT, #name))

/* "tmpfile": the system has no files without a name. */
int open(const char *path, int flags, ...) {
  va_list args;
  va_start(args, flags);
  mode_t mode = flags & (O_CREAT | __O_TMPFILE) ? va_arg(args, mode_t) : 0;
  va_end(args);
  if ((flags & O_TMPFILE) == O_TMPFILE && fails("tmpfile")) return -1;
  return fails("open") ? -1 : NEXT(open)(path, flags, mode);
}
FILE *fopen(const char *path, const char *mode) {
  return fails("fopen") ? NULL : NEXT(fopen)(path, mode);
}
FILE *fdopen(int fd, const char *mode) {
  return fails("fdopen") ? NULL : NEXT(fdopen)(fd, mode);
}
int mkstemp(char *path) {
  long number = 0;
  int fd = fails("mkstemp") ? -1 : NEXT(mkstemp)(path);
  read_number("FAULT_SIGNAL", &number);
  if (fd >= 0 && number) kill(getpid(), (int)number);
  return fd;
}
int fchmod(int fd, mode_t mode) {
  return fails("fchmod") ? -1 : NEXT(fchmod)(fd, mode);
}
static int note_synced(int fd, int done) {
  const char *name = getenv("FAULT_SYNCED");
  struct stat info;
  int log = done == 0 && name && fstat(fd, &info) == 0
                ? (int)syscall(SYS_openat, AT_FDCWD, name, O_WRONLY | O_CREAT | O_APPEND, 0666)
                : -1;
  if (log < 0) return done;
  dprintf(log, "%lu %lld\n", (unsigned long)info.st_ino, (long long)info.st_size);
  close(log);
  return done;
}
/* Power is lost before the n-th step that makes a file last. */
static void lose_power(void) {
  static atomic_long steps;
  long number = 0;
  read_number("FAULT_POWER", &number);
  if (number && atomic_fetch_add(&steps, 1) + 1 == number) kill(getpid(), SIGKILL);
}
int fsync(int fd) {
  lose_power();
  return fails("fsync") ? -1 : note_synced(fd, NEXT(fsync)(fd));
}
int fdatasync(int fd) {
  return fails("fdatasync") ? -1 : note_synced(fd, NEXT(fdatasync)(fd));
}
int linkat(int from, const char *old, int to, const char *name, int flags) {
  lose_power();
  return fails("linkat") ? -1 : NEXT(linkat)(from, old, to, name, flags);
}
int rename(const char *old, const char *name) {
  lose_power();
  return fails("rename") ? -1 : NEXT(rename)(old, name);
}
int fclose(FILE *f) {
  int failed = fails("fclose"), why = errno, done = NEXT(fclose)(f);
  if (!failed) return done;
  errno = why;
  return EOF;
}
/* The stream reads a folder from now on, so that the stream knows of the error. */
static void spoil(FILE *f) {
  int folder = NEXT(open)("/", O_RDONLY);
  dup2(folder, fileno(f));
  close(folder);
}
size_t fread(void *out, size_t size, size_t count, FILE *f) {
  if (fails("fread")) spoil(f);
  return NEXT(fread)(out, size, count, f);
}
ssize_t read(int fd, void *out, size_t size) {
  return fails("read") ? -1 : NEXT(read)(fd, out, size);
}
ssize_t write(int fd, const void *text, size_t size) {
  return fails("write") ? -1 : NEXT(write)(fd, text, size);
}
int pipe2(int end[2], int flags) {
  return fails("pipe2") ? -1 : NEXT(pipe2)(end, flags);
}
int posix_spawn(pid_t *pid, const char *path, const posix_spawn_file_actions_t *files, const posix_spawnattr_t *attr,
                char *const argv[], char *const env[]) {
  return fails("posix_spawn") ? error : NEXT(posix_spawn)(pid, path, files, attr, argv, env);
}
pid_t fork(void) {
  return fails("fork") ? -1 : NEXT(fork)();
}
int pthread_create(pthread_t *out, const pthread_attr_t *attr, void *(*work)(void *), void *user) {
  return fails("pthread_create") ? error : NEXT(pthread_create)(out, attr, work, user);
}
