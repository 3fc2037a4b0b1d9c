/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The command dyadel-tiles: its words, one job, the exit status. */
#include "base/local.h"
#include "dyadic/numeral.h"
#include "tiles/tiles.h"

#include <errno.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { EXIT_FAILED = 1, EXIT_USAGE = 2, EXIT_FIXPOINT = 3, EXIT_BUDGET = 4 };

typedef struct main_options {
  const char *command, *file, *output;
  tiles_job job;
  bool accept_fixpoint, stats, comments;
} main_options;

static const char usage[] =
    "usage: mpirun -n P dyadel-tiles delaunay FILE -o FOLDER [OPTION...]\n"
    "       dyadel-tiles delaunay FILE -o FOLDER --tiles T [OPTION...]\n"
    "       dyadel-tiles to-csv FOLDER [-o FILE] [--comments]\n"
    "\n"
    "The statuses of `dyadel delaunay` for points that one process cannot hold. Each of P processes owns a part of "
    "the\n"
    "plane and writes FOLDER/part-RRRRR.bin, the first one at last FOLDER/manifest.json; to-csv joins them.\n"
    "FILE holds doubles, little-endian: x y, x y, ... Points are numbered from 0. FILE.csv and FILE.txt hold decimals, "
    "a "
    "point\n"
    "a line: exact when all together have at most 15 digits before and behind the point, else the intervals between\n"
    "doubles next to them.\n"
    "\n"
    "  --boxes            FILE holds xlo xhi ylo yhi for each point\n"
    "  --tiles T          one process does the work of T, one after another\n"
    "  --restart          parts that are in FOLDER from the same job stay\n"
    "  --max-pairs K      each process stores K pairs beyond the skeleton at most\n"
    "  --accept-fixpoint  exit status 0 instead of 3: ties and undecided pairs are expected\n"
    "  --stats            counters on standard error\n"
    "  --comments         the csv begins with \"# alias I J\" for each point I equal to a point J with a lower number\n"
    "  --help, --version\n"
    "\n"
    "A part is a line of JSON (pairs, aliases: how many records), then records of i, j (64 bits) and status (32 bits,\n"
    "3 legal, 2 indeterminate, 1 tie), little-endian, sorted; then records of points equal to one with a lower number "
    "j;\n"
    "then 64 bits, a digest (FNV-1a) of all before it, which the manifest has as well: to-csv and --restart compare "
    "it.\n"
    "Exit status: 0 decided, 3 fixpoint, 4 budget (--max-pairs), 1 failure, 2 bad usage.\n";

/* In one piece: other ranks may complain at the same time. */
static void main_complain(const char *format, ...) {
  char text[8192];
  va_list args;
  va_start(args, format);
  vsnprintf(text, sizeof text, format, args);
  va_end(args);
  fprintf(stderr, "dyadel-tiles: %s\n", text);
}

/* ---- words ---- */

static bool number_of(size_t *out, const char *word, const char *text, size_t most) {
  int64_t n;
  if (text && dyd_integer_scan(&n, text, strlen(text), 0, 1, (int64_t)most)) {
    *out = (size_t)n;
    return true;
  }
  main_complain("%s: needs a number from 1 to %zu, not '%s'", word, most, text ? text : "");
  return false;
}

/* One option at arg[k]; returns how many words it took, 0 after a message. */
static int take_option(main_options *o, char **arg) {
  const char *word = arg[0], *value = arg[1];
  const struct {
    const char *name;
    bool *flag;
  } flags[] = {{"--boxes", &o->job.boxes},
               {"--restart", &o->job.restart},
               {"--accept-fixpoint", &o->accept_fixpoint},
               {"--stats", &o->stats},
               {"--comments", &o->comments}};
  for (size_t k = 0; k < sizeof flags / sizeof *flags; k++)
    if (strcmp(word, flags[k].name) == 0) return *flags[k].flag = true, 1;
  if (strcmp(word, "--tiles") == 0) return number_of(&o->job.ranks, word, value, 100000) ? 2 : 0;
  if (strcmp(word, "--max-pairs") == 0) return number_of(&o->job.max_pairs, word, value, SIZE_MAX / 64) ? 2 : 0;
  if (strcmp(word, "-o") == 0 && value) return o->output = value, 2;
  if (strcmp(word, "-o") == 0)
    main_complain("-o: needs a name");
  else
    main_complain("unknown option '%s'; see dyadel-tiles --help", word);
  return 0;
}

static int take_words(main_options *o, int count, char **arg) {
  for (int k = 1; k < count;) {
    if (arg[k][0] == '-' && arg[k][1]) {
      int taken = take_option(o, arg + k);
      if (taken == 0) return EXIT_USAGE;
      k += taken;
      continue;
    }
    const char **place = !o->command ? &o->command : !o->file ? &o->file : NULL;
    if (!place) {
      main_complain("one input is enough, '%s' is too much", arg[k]);
      return EXIT_USAGE;
    }
    *place = arg[k++];
  }
  return 0;
}

static int check_words(const main_options *o) {
  const bool join = o->command && strcmp(o->command, "to-csv") == 0;
  if (!o->command || (!join && strcmp(o->command, "delaunay") != 0))
    main_complain("the command is 'delaunay' or 'to-csv', not '%s'", o->command ? o->command : "");
  else if (!o->file)
    main_complain(join ? "to-csv needs the folder that delaunay wrote" : "delaunay needs a file");
  else if (!join && !o->output)
    main_complain("delaunay needs a folder for its parts; give it with -o");
  else
    return 0;
  return EXIT_USAGE;
}

/* ---- delaunay ---- */

static bool ends_with(const char *name, const char *end) {
  size_t n = strlen(name), m = strlen(end);
  return n >= m && strcmp(name + n - m, end) == 0;
}

static int size_of_input(tiles_job *job) {
  struct stat s;
  const unsigned size = (job->boxes ? 4 : 2) * sizeof(double);
  const uint16_t order = 1;
  job->text = ends_with(job->input, ".csv") || ends_with(job->input, ".txt");
  if (*(const unsigned char *)&order != 1)
    main_complain("this machine is not little-endian");
  else if (stat(job->input, &s) != 0)
    main_complain("%s: cannot read: %s", job->input, strerror(errno));
  else if (!S_ISREG(s.st_mode))
    main_complain("%s: not a file; ranks read their slices side by side", job->input);
  else if (!job->text && s.st_size % size)
    main_complain("%s: %lld bytes are no whole number of points of %u bytes; doubles in binary are expected, or text "
                  "in a file called .csv or .txt%s",
                  job->input, (long long)s.st_size, size,
                  job->boxes ? "" : ", and --boxes where there are four a point");
  else
    return job->size = (uint64_t)s.st_size, 0;
  return EXIT_FAILED;
}

/* Without --restart, what an earlier job says of itself no longer holds. */
static int prepare_folder(const tiles_job *job, size_t rank) {
  if (mkdir(job->folder, 0777) != 0 && errno != EEXIST) {
    main_complain("%s: cannot make the folder: %s; choose another one with -o", job->folder, strerror(errno));
    return EXIT_FAILED;
  }
  DYD_FREED char *manifest = tiles_path(job->folder, "manifest.json");
  if (manifest && rank == 0) unlink(manifest);
  return 0;
}

static void print_stats(const tiles_counters *c, size_t rank, bool total) {
  fprintf(stderr,
          "%s %zu: own %llu, ghosts %llu, late %llu, fringe %llu, rounds %llu, bytes sent %llu, pairs %llu, library "
          "%.2f s\n",
          total ? "ranks" : "rank", rank, (unsigned long long)c->own, (unsigned long long)c->ghosts,
          (unsigned long long)c->late, (unsigned long long)c->fringe, (unsigned long long)c->rounds,
          (unsigned long long)c->sent, (unsigned long long)(c->count[1] + c->count[2] + c->count[3]), c->seconds);
}

static int status_of(const tiles_counters *all, const main_options *o) {
  if (all->capped) return EXIT_BUDGET;
  return !o->accept_fixpoint && all->count[DYD_INDETERMINATE] + all->count[DYD_TIE] > 0 ? EXIT_FIXPOINT : 0;
}

static int run_members(main_options *o, tile *member, size_t count, size_t first, const tiles_carrier *by) {
  dyd_error err;
  dyd_error_clear(&err);
  dyd_status st = DYD_OK;
  bool elsewhere = false;
  for (size_t k = 0; st == DYD_OK && k < count; k++) st = tile_new(&member[k], &o->job, first + k, &err);
  bool failed = by->any(st != DYD_OK);
  if (!failed) st = tiles_drive(member, count, by, &elsewhere, &err);
  if (st != DYD_OK) main_complain("%s", err.message[0] ? err.message : dyd_status_text(st));
  if (st != DYD_OK || elsewhere || failed) return EXIT_FAILED;
  for (size_t k = 0; o->stats && k < count; k++)
    if (first + k > 0) print_stats(&member[k].counters, first + k, false);
  if (first > 0) return 0;
  if (o->stats) print_stats(&member[0].counters, o->job.ranks, true);
  return status_of(&member[0].counters, o);
}

static int delaunay_main(main_options *o, size_t rank, const tiles_carrier *by, bool alone) {
  o->job.input = o->file;
  o->job.folder = o->output;
  int status = size_of_input(&o->job);
  if (status == 0) status = prepare_folder(&o->job, rank);
  if (by->any(status != 0)) return EXIT_FAILED;
  size_t count = alone ? o->job.ranks : 1;
  DYD_FREED tile *member = calloc(count, sizeof *member);
  for (size_t k = 0; member && k < count; k++) member[k].job = &o->job;
  status = EXIT_FAILED;
  if (by->any(!member))
    main_complain("memory is exhausted; close other programs");
  else
    status = run_members(o, member, count, rank, by);
  for (size_t k = 0; member && k < count; k++) tile_free(&member[k]);
  return status;
}

/* ---- to-csv ---- */

static int csv_main(const main_options *o) {
  dyd_error err;
  dyd_error_clear(&err);
  FILE *out = o->output ? fopen(o->output, "wb") : stdout;
  if (!out) {
    main_complain("%s: cannot write: %s; choose another place with -o", o->output, strerror(errno));
    return EXIT_FAILED;
  }
  dyd_status st = tiles_write_csv(out, o->file, o->comments, &err);
  if (out != stdout && fclose(out) != 0 && st == DYD_OK)
    st = dyd_fail(&err, DYD_E_IO, "cannot write: %s", strerror(errno));
  if (st == DYD_OK) return 0;
  main_complain("%s", err.message[0] ? err.message : dyd_status_text(st));
  if (out != stdout) unlink(o->output);
  return EXIT_FAILED;
}

/* ---- */

static int run_words(main_options *o) {
  if (strcmp(o->command, "to-csv") == 0) return csv_main(o);
  if (o->job.ranks) return delaunay_main(o, 0, &tiles_in_memory, true);
#ifdef TILES_MPI
  size_t rank;
  tiles_mpi_begin(&rank, &o->job.ranks);
  int status = delaunay_main(o, rank, &tiles_by_mpi, false);
  tiles_mpi_end();
  return status;
#else
  main_complain("this one was built without MPI (meson setup -Dmpi=enabled); --tiles T works in one process");
  return EXIT_USAGE;
#endif
}

int main(int count, char **arg) {
  main_options o = {.job = {.halo = 3, .corners = 16, .nearest = 8}};
#ifdef M_MMAP_THRESHOLD
  mallopt(M_MMAP_THRESHOLD, 1 << 18); /* freed memory goes back to the system at once */
#endif
  for (int k = 1; k < count; k++) {
    if (strcmp(arg[k], "--help") == 0 || strcmp(arg[k], "--version") == 0) {
      if (arg[k][2] == 'h')
        fputs(usage, stdout);
      else
        printf("dyadel-tiles %s\n", dyd_version());
      return 0;
    }
  }
  int status = take_words(&o, count, arg);
  if (status == 0) status = check_words(&o);
  return status ? status : run_words(&o);
}
