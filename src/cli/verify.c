/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* dyadel verify CERT: checks a certificate and reports its proved and unproved parts. */
#include "cli.h"

#include <errno.h>
#include <stdarg.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <signal.h>
#include <sys/prctl.h>
#endif

/* dyadel verify --proved: the check is done by dyadel-proved, a program of its own, extracted from the
 * proofs in Coq. */

#define PROGRAM "dyadel-proved"

enum { CANNOT_RUN = 127 };

/* Where the program is, by how the folder of this command ends: as installed, and as built. */
static const struct {
  const char *end, *instead;
} PLACE[] = {{"/", "/"}, {"/bin/", "/libexec/"}, {"/src/cli/", "/proofs/"}};

enum { PLACES = sizeof PLACE / sizeof *PLACE };

/* Sets *at to where `end` begins in the folder; returns false if the folder does not end in it. */
static bool folder_ends(size_t *at, const char *folder, const char *end) {
  size_t length = strlen(folder), tail = strlen(end);
  if (tail > length) return false;
  *at = length - tail;
  return strcmp(folder + *at, end) == 0;
}

/* Sets path to the program in one of the places, or to its name, for PATH to find it. */
static void proved_find(char *path, size_t size, const char *folder) {
  size_t at;
  for (int k = 0; k < PLACES; k++) {
    if (!folder_ends(&at, folder, PLACE[k].end)) continue;
    snprintf(path, size, "%.*s%s" PROGRAM, (int)at, folder, PLACE[k].instead);
    if (access(path, X_OK) == 0) return;
  }
  snprintf(path, size, PROGRAM);
}

/* Reports the missing program, where it was looked for, and the remedy. */
static void complain_missing(const char *folder) {
  size_t at;
  if (folder_ends(&at, folder, PLACE[PLACES - 1].end))
    cli_complain("there is no " PROGRAM " in %.*s%s or in PATH (to build it, which needs coqc, ocamlfind and Zarith: "
                 "meson configure -Dproofs=enabled %.*s && ninja -C %.*s)",
                 (int)at, folder, PLACE[PLACES - 1].instead, (int)at, folder, (int)at, folder);
  else
    cli_complain("there is no " PROGRAM " in %s%sPATH (omit --proved, or install " PROGRAM
                 " from a build of dyadel with meson setup -Dproofs=enabled)",
                 folder, *folder ? " or in " : "");
}

/* Becomes the program, by functions only that may follow fork. `still` becomes its standard input (-1: no list). */
static void proved_become(int out, int still, const char *path, const char *file) {
  const char *option = still < 0 ? NULL : "--still"; /* NULL ends the arguments */
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGKILL); /* whatever ends the command ends it */
#endif
  if (dup2(out, STDOUT_FILENO) < 0) _exit(CANNOT_RUN);
  if (still >= 0 && dup2(still, STDIN_FILENO) < 0) _exit(CANNOT_RUN);
  execlp(path, PROGRAM, file, option, "-", (char *)NULL);
  _exit(CANNOT_RUN);
}

/* Runs the program to its end and returns its exit status, which has the same meaning as ours. */
static int proved_run(int out, int still, const char *file) {
  char folder[4096], path[sizeof folder + 64];
  int how = 0;
  cli_folder_find(folder, sizeof folder);
  proved_find(path, sizeof path, folder);
  pid_t child = fork();
  if (child == 0) proved_become(out, still, path, file);
  while (child > 0 && waitpid(child, &how, 0) < 0)
    if (errno != EINTR) child = -1;
  if (child < 0) return cli_complain("cannot run " PROGRAM ": %s", strerror(errno));
  if (WIFEXITED(how) && WEXITSTATUS(how) != CANNOT_RUN) return WEXITSTATUS(how);
  if (WIFEXITED(how))
    complain_missing(folder);
  else
    cli_complain("%s: not judged: " PROGRAM " was ended by signal %d", file, WTERMSIG(how));
  return CLI_FAILED;
}

/* `still`: the sites that stay, or NULL; `more` follows the report. */
static int verify_proved(const cli_options *o, FILE *still, const char *more) {
  cli_output out;
  cli_deadline_phase("checking the certificate");
  if (!cli_output_open(&out, o->output)) return CLI_FAILED;
  if (still) rewind(still); /* input of the child */
  int status = proved_run(fileno(out.stream), still ? fileno(still) : -1, o->file);
  if (status == CLI_OK || status == CLI_FIXPOINT) {
    fputs(more, out.stream);
    return cli_output_finish(&out, o) ? status : CLI_FAILED;
  }
  cli_output_drop(&out);
  return status;
}

/* Prints a line if `when` is true. */
__attribute__((format(printf, 3, 4))) static void print_if(FILE *out, bool when, const char *format, ...) {
  va_list args;
  va_start(args, format);
  if (when) vfprintf(out, format, args);
  va_end(args);
}

static void print_pairs(FILE *out, const dyd_certificate_report *r) {
  fprintf(out, "checked: %zu legal pairs, each by its witness against all sites\n", r->legal);
  print_if(out, r->sphere && !r->gap, "checked: %zu legal pairs with the place that is projected from\n",
           r->legal_around);
  print_if(out, r->second, "checked: from a gap between them as well: %zu legal pairs\n", r->second_legal);
  print_if(out, r->connected, "checked: %zu certain triangles, %zu certain corners of the hull\n", r->triangles,
           r->corners);
  print_if(out, r->illegal_chains, "checked: %zu illegal pairs within undecided faces, each by its chain\n",
           r->illegal_chains);
  print_if(out, r->illegal_boxes, "checked: %llu illegal pairs within undecided faces, by boxes that cover the plane\n",
           (unsigned long long)r->illegal_boxes);
  print_if(out, !r->unproved && !r->capped && !r->around_unproved,
           "checked: all pairs that are not listed%s are illegal\n",
           r->gap ? ", nor of two neighbours of the gap," : "");
  print_if(out, (r->area || r->hausdorff) && !(r->gaps & DYD_GAP_BOUNDS),
           "checked: the bounds of area and Hausdorff distance\n");
  print_if(out, r->diagram, "checked: the undecided area of the diagram, by %zu polygons inside cells\n", r->polygons);
  print_if(out, r->distance_proved, "checked: the distance of undecided points to the diagram\n");
  print_if(out, r->identities || r->tie_bounds,
           "checked: what points are described to be: %zu identities, %zu bounds\n", r->identities, r->tie_bounds);
  print_if(out, r->tie > r->ties_unproved, "checked: %zu ties, on empty circles or lines of the hull\n",
           r->tie - r->ties_unproved);
}

static void print_parts(FILE *out, const dyd_certificate_report *r) {
  print_if(out, r->discs, "checked: %zu more legal pairs of the discs by witnesses, %zu illegal ones by blockers\n",
           r->discs_legal, r->discs_illegal);
  print_if(out, r->graph, "checked: %zu of %zu edges of the graph %s are certain\n", r->graph_certain, r->graph_rows,
           r->graph);
  print_if(out, r->graph && !(r->gaps & DYD_GAP_GRAPH), "checked: pairs without a row are not edges of it\n");
}

static void print_places(FILE *out, const dyd_certificate_report *r) {
  fprintf(out, "checked: %zu of %zu places have a certain nearest site\n", r->places_certain, r->places);
  print_if(out, !r->near_unproved,
           "checked: sites that are not listed are not nearest, distances lie in their bounds\n");
}

static void print_proved(FILE *out, const dyd_certificate_report *r) {
  const bool nearest = strcmp(r->goal, "nearest") == 0;
  if (r->sphere && nearest)
    fprintf(out, "places: %zu on a sphere\n", r->sphere_places);
  else if (r->sphere)
    fprintf(out, "places: %zu on a sphere, projected from %s: %zu images\n", r->sphere_places,
            r->gap ? "a gap between them" : "one of them", r->sites);
  else
    fprintf(out, "sites: %zu, of which %zu aliases\n", r->sites, r->aliases);
  print_if(out, r->discs, "about: points in %zu discs%s\n", r->discs, r->discs_fixed ? ", which nothing narrows" : "");
  print_if(out, r->bound && !r->unlocated, "checked: the points given %s%s\n",
           r->sphere ? "are its places, with their radii" : "lie in its rectangles",
           r->discs && !r->undescribed ? " and discs" : "");
  print_if(out, r->sphere && !nearest && !r->images_unproved,
           "checked: each image lies in its rectangle, radii included\n");
  if (nearest) {
    print_places(out, r);
  } else {
    print_pairs(out, r);
    print_parts(out, r);
  }
  print_if(out, !(r->gaps & DYD_GAP_OUTCOME), "checked: the outcome %s\n", r->outcome);
}

/* Undecided pairs, without anything to prove. */
static void print_open(FILE *out, const dyd_certificate_report *r) {
  print_if(out, r->indeterminate, "undecided: %zu indeterminate pairs, which have no proof\n", r->indeterminate);
  print_if(out, r->capped, "undecided: %llu pairs within %zu undecided faces: the limit of pairs was reached\n",
           (unsigned long long)r->unproved, r->undecided_sets);
}

/* Why an outcome is no more than a word. */
static const char *outcome_reason(const dyd_certificate_report *r) {
  if (strcmp(r->outcome, "fixpoint") == 0)
    return r->bound ? "narrower rectangles may decide more" : "--points may show which points cannot be narrowed";
  if (strcmp(r->outcome, "decided") == 0 || strcmp(r->outcome, "certified") == 0)
    return "a statement that it needs is not proved";
  return "the reason why the run ended has no proof";
}

static void print_part_gaps(FILE *out, const dyd_certificate_report *r) {
  print_if(out, r->gaps & DYD_GAP_DISCS,
           "not proved: the statuses of %zu pairs of the discs, which have no witness or blockers\n",
           r->discs_unproved);
  print_if(out, r->gaps & DYD_GAP_GRAPH,
           "not proved: that pairs without a row are not edges of the graph %s%s (%llu possible ones)\n", r->graph,
           !r->graph || strcmp(r->graph, "mst") ? "" : ", or that those stated to be certain are",
           (unsigned long long)r->graph_unproved);
  print_if(out, r->gaps & DYD_GAP_NEAREST,
           "not proved: that %llu sites are not nearest to places that do not list them\n",
           (unsigned long long)r->near_unproved);
}

static void print_gaps(FILE *out, const dyd_certificate_report *r) {
  print_if(out, r->gaps & DYD_GAP_IMAGES, "not proved: that %zu rectangles hold the images of their places\n",
           r->images_unproved);
  print_if(out, r->gaps & DYD_GAP_AROUND,
           "not proved: that %zu images that are not listed are not neighbours of the point projected from\n",
           r->around_unproved);
  print_if(out, r->gaps & DYD_GAP_LEGAL, "not proved: that %zu pairs without a witness are legal\n", r->legal_unproved);
  print_if(out, r->gaps & DYD_GAP_ILLEGAL, "not proved: that %llu pairs within %zu undecided faces are illegal\n",
           (unsigned long long)r->unproved, r->undecided_sets);
  print_if(out, r->gaps & DYD_GAP_TIES, "not proved: that %zu pairs are ties\n", r->ties_unproved);
  print_if(out, r->gaps & DYD_GAP_CLAIMS,
           "not proved: that %zu callbacks are the roots that their authors say they are\n", r->claims);
  print_if(out, r->gaps & DYD_GAP_ALIASES,
           "not proved: that %zu aliases of points that are not exact are the same points\n", r->aliases_unproved);
  print_if(out, r->gaps & DYD_GAP_BOUNDS,
           "not proved: the bounds of area and Hausdorff distance, as more pairs may be possible\n");
  print_if(out, r->gaps & DYD_GAP_DISTANCE, "not proved: the distance of undecided points to the diagram\n");
  print_part_gaps(out, r);
  print_if(out, r->gaps & DYD_GAP_OUTCOME, "not proved: the outcome %s (%s)\n", r->outcome, outcome_reason(r));
  print_if(out, r->undescribed, "not proved: that %zu of the points given are what the certificate describes%s\n",
           r->undescribed, r->discs ? " (if radii are those of discs: --discs)" : "");
  print_if(out, r->unlocated, "not proved: that %zu of the points given lie in its rectangles\n", r->unlocated);
}

static dyd_status print_verified(FILE *out, const cli_session *s, dyd_error *err) {
  const dyd_certificate_report *r = s->state;
  (void)err;
  if (r->gaps)
    fputs("accepted, not all of it proved: see the statements below\n", out);
  else
    fputs("accepted, all of it proved\n", out);
  fprintf(out, "states: outcome %s, goal %s", r->outcome, r->goal);
  if (strcmp(r->goal, "decided") != 0 && strcmp(r->goal, "nearest") != 0) fprintf(out, " %lld", r->goal_bits);
  fputs(r->capped ? ", capped\n" : "\n", out);
  print_proved(out, r);
  print_open(out, r);
  print_gaps(out, r);
  return DYD_OK;
}

/* Reads the points of --points into a new engine and checks against them; fixed sites are listed in `still` (or NULL).
 */
static dyd_status verify_points(int *status, dyd_certificate_report *report, FILE *still, FILE *in,
                                const cli_options *o, dyd_error *err) {
  dyd_engine *e = NULL;
  cli_options reading = *o;
  const dyd_sphere_options sphere = {DYD_SIZED(dyd_sphere_options), .radius = o->read.radius,
                                     .radius_unit = o->read.radius_unit, .radius_scale = o->read.radius_scale};
  reading.file = o->points;
  if (o->sphere) cli_options_degrees(&reading);
  dyd_status st = dyd_engine_new(&e);
  if (st != DYD_OK) return dyd_error_set(err, st, dyd_status_text(st));
  *status = cli_points_read(e, &reading, false);
  const dyd_verify_options about = {
      DYD_SIZED(dyd_verify_options),        .engine = e,          .discs = o->discs, .still = still,
      .sphere = o->sphere ? &sphere : NULL, .options = &o->engine};
  if (*status == 0) st = dyd_verify_certificate(report, in, &about, err);
  dyd_engine_free(e);
  return st;
}

static int complain_rejected(const cli_options *o, const dyd_error *err) {
  const char *rejected = err->code == DYD_E_PARSE ? "rejected: " : "";
  if (err->line)
    cli_complain("%s:%zu: %s%s", o->file, err->line, rejected, err->message);
  else if (err->code == DYD_E_DOMAIN && o->points && err->point == DYD_NO_POINT)
    cli_complain("%s: %s; %s", o->file, err->message, o->sphere ? "remove --sphere" : "give --sphere");
  else
    cli_complain("%s: %s%s", o->file, rejected, err->message);
  return CLI_FAILED;
}

/* Checks it in this program: fills the report, or returns an exit status after a message. */
static int verify_here(dyd_certificate_report *report, FILE *still, const cli_options *o) {
  FILE *in = cli_input_open(o->file, "check the name of the certificate");
  if (!in) return CLI_FAILED;
  dyd_error err;
  int status = 0;
  cli_deadline_phase("checking the certificate");
  dyd_error_clear(&err);
  dyd_status st =
      o->points ? verify_points(&status, report, still, in, o, &err) : dyd_verify_certificate(report, in, NULL, &err);
  cli_input_close(in);
  if (status) return status;
  return st == DYD_OK ? 0 : complain_rejected(o, &err);
}

/* The proved checker does not read points: it checks the certificate, this program that they are those of it, and which
 * of them stay. */
static int verify_proved_of(cli_session *s) {
  const cli_options *o = &s->o;
  const dyd_certificate_report *r = s->state;
  char more[200];
  FILE *still = tmpfile();
  if (!still) return cli_complain("cannot make a temporary file: %s", strerror(errno));
  int status = verify_here(s->state, still, o);
  size_t others = r->undescribed + r->unlocated;
  if (others)
    snprintf(more, sizeof more, "not proved: that %zu of the points given are those of the certificate\n", others);
  else
    snprintf(more, sizeof more,
             "compared by dyadel itself: the points given lie in its rectangles, and which of them stay there\n");
  if (!status) status = verify_proved(o, still, more);
  fclose(still);
  return status == CLI_OK && others ? CLI_FIXPOINT : status;
}

/* "-" can be read once. */
static int verify_begin(cli_session *s) {
  const cli_options *o = &s->o;
  *(dyd_certificate_report *)s->state = (dyd_certificate_report){DYD_SIZED(dyd_certificate_report)};
  if (!o->points || strcmp(o->file, "-") != 0) return 0;
  if (strcmp(o->points, "-") == 0)
    cli_complain("standard input cannot be both the certificate and the points; give a file for one of them");
  else if (o->proved)
    cli_complain("with --proved and --points the certificate is read twice; give a file instead of \"-\"");
  else
    return 0;
  return CLI_USAGE;
}

static int verify_find(cli_session *s) {
  if (s->o.proved) return s->o.points ? verify_proved_of(s) : verify_proved(&s->o, NULL, "");
  int status = verify_here(s->state, NULL, &s->o);
  s->known = status == 0;
  return status;
}

static int verify_summary(cli_session *s, int status) {
  const dyd_certificate_report *r = s->state;
  return !status && s->known && r->gaps ? CLI_FIXPOINT : status;
}

const cli_work cli_verify = {.size = sizeof(dyd_certificate_report),
                             .bare = true,
                             .begin = verify_begin,
                             .find = verify_find,
                             .write = print_verified,
                             .summary = verify_summary};
