/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Files of the command line. Before anything is read: no output may be an input, or another output; no picture goes to
 * a terminal. */
#include "table.h"
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MOST_FILES = 16 };

/* A file that is named by the arguments, or a standard stream. For one that does not exist: that of its folder, and its
 * name in there. */
typedef struct named_file {
  const char *option, *name;
  bool written, known, exists;
  dev_t device;
  ino_t inode;
  char *last;
} named_file;

static void named_identify(named_file *f, const struct stat *info) {
  f->known = true;
  f->device = info->st_dev;
  f->inode = info->st_ino;
}

/* What is no regular file may be used twice. false: memory is exhausted. */
static bool named_open(named_file *f, int descriptor) {
  struct stat info;
  f->exists = descriptor >= 0 ? fstat(descriptor, &info) == 0 : stat(f->name, &info) == 0;
  if (f->exists && S_ISREG(info.st_mode)) named_identify(f, &info);
  char *path = !f->exists && descriptor < 0 && f->written ? cli_output_target(f->name) : NULL;
  if (!path) return true; /* opening it will tell */
  char *slash = strrchr(path, '/');
  f->last = strdup(slash ? slash + 1 : path);
  if (slash) slash[slash == path ? 1 : 0] = 0;
  if (f->last && stat(slash ? path : ".", &info) == 0) named_identify(f, &info);
  free(path);
  return f->last != NULL;
}

static bool named_equal(const named_file *a, const named_file *b) {
  if (!a->known || !b->known || a->exists != b->exists || a->device != b->device || a->inode != b->inode) return false;
  return a->exists || strcmp(a->last, b->last) == 0;
}

/* All files of the options, then the operand, then standard streams in use. */
static size_t list_files(named_file file[MOST_FILES], const cli_options *o) {
  size_t n = 0;
  for (size_t k = 0; k < cli_option_count && n < MOST_FILES - 2; k++) {
    const cli_option *option = &cli_option_table[k];
    if (!cli_kind_is_file(option->kind)) continue;
    const char *name = *(const char *const *)((const char *)o + option->offset);
    if (name) file[n++] = (named_file){.option = option->name, .name = name, .written = option->kind == CLI_FILE};
  }
  if (o->file) file[n++] = (named_file){.name = o->file};
  if (!o->output) file[n++] = (named_file){.name = "standard output", .written = true};
  return n;
}

static void complain_equal(const named_file *a, const named_file *b) {
  const named_file *out = a->written ? a : b, *other = a->written ? b : a;
  const char *dash = out->option ? "--" : "", *option = out->option ? out->option : "";
  if (other->written)
    cli_complain("%s%s%s%s and --%s %s are the same file; give each result a file of its own", dash, option,
                 *option ? " " : "", out->name, other->option, other->name);
  else
    cli_complain("%s%s%s%s is the file that is read; give another one for what is written", dash, option,
                 *option ? " " : "", out->name);
}

int cli_files_check(const cli_options *o) {
  named_file file[MOST_FILES];
  size_t n = list_files(file, o);
  int status = 0;
  for (size_t k = 0; k < n && !status; k++) {
    int descriptor = -1;
    if (!file[k].option && file[k].written) descriptor = STDOUT_FILENO;
    if (!file[k].written && strcmp(file[k].name, "-") == 0) descriptor = STDIN_FILENO;
    if (!named_open(&file[k], descriptor)) status = cli_complain_memory();
    for (size_t m = 0; m < k && !status; m++) {
      if ((!file[k].written && !file[m].written) || !named_equal(&file[k], &file[m])) continue;
      complain_equal(&file[k], &file[m]);
      status = CLI_USAGE;
    }
  }
  for (size_t k = 0; k < n; k++) free(file[k].last);
  if (status || o->output || !dyd_format_is_binary(o->format) || !isatty(STDOUT_FILENO)) return status;
  cli_complain("%s is nothing for a terminal; give a file: -o NAME.%s", dyd_format_name(o->format),
               dyd_format_name(o->format));
  return CLI_USAGE;
}

FILE *cli_input_open(const char *name, const char *advice) {
  FILE *in = strcmp(name, "-") == 0 ? stdin : fopen(name, "rb");
  if (!in) cli_complain("%s: cannot open: %s; %s", name, strerror(errno), advice);
  return in;
}

void cli_input_close(FILE *in) {
  if (in != stdin) fclose(in);
}
