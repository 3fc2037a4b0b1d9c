/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* A command at work: it reads points into an engine, runs it with progress, signals and a trace, writes a result file
 * and its certificate, reports undecided pairs, and ends with an exit status. */
#include "cli.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- reading ---- */

/* Options that say how a text is read mean nothing for the answers of a program. */
static int oracle_refuse(const dyd_read_options *read) {
  const dyd_read_field *field;
  const char *value;
  for (size_t k = 0; (field = dyd_read_field_at(&value, read, k)); k++) {
    if (!value || !field->text) continue;
    return cli_usage("`%s` is for points files; remove it, and %s", field->name,
                     strcmp(field->name, "cost_column") == 0    ? "let the oracle begin with \"points N cost C ... C\""
                     : strcmp(field->name, "sigma_column") == 0 ? "give --sigma"
                                                                : "let the oracle answer with what you mean");
  }
  return 0;
}

/* Adds the points that the programs of --oracle serve. 0, or an exit status after a message. */
static int session_read_oracle(dyd_engine *e, const cli_options *o) {
  int status = oracle_refuse(&o->read);
  if (status) return status;
  dyd_source source = {DYD_SIZED(dyd_source)};
  size_t points;
  dyd_error err;
  dyd_error_clear(&err);
  const dyd_oracle_options options = {DYD_SIZED(dyd_oracle_options), .jobs = o->oracle_jobs, .batch = o->oracle_batch,
                                      .retries = o->oracle_retries, .seconds = o->oracle_timeout};
  dyd_status st = dyd_oracle_source(&source, &points, o->oracle, &options, &err);
  if (st != DYD_OK) return cli_complain("%s", err.message);
  st = dyd_engine_add_source(e, points, &source, NULL);
  return st == DYD_OK ? 0 : cli_complain("the points of the oracle cannot be added: %s", dyd_status_text(st));
}

/* The file has another format: names it, and the command to type. */
static void complain_kind(const cli_options *o, const dyd_read_report *r) {
  const char *make = r->make, *place;
  char name[1024], line[2048] = "";
  bool gdal = strncmp(make, "ogr2ogr", 7) == 0;
  cli_shell_name(name, sizeof name, strcmp(o->file, "-") != 0 ? o->file : gdal ? "/vsistdin/" : "/dev/stdin");
  if ((place = strstr(make, "FILE"))) {
    snprintf(line, sizeof line, "%.*s%s%s", (int)(place - make), make, name, place + strlen("FILE"));
    make = line;
  }
  const char *columns = r->make_columns ? r->make_columns : "";
  const char *option = !*columns ? "" : o->command ? " --columns " : " --query-columns ";
  const char *before = !o->command ? " --queries" : o->points ? " CERT --points" : "";
  const char *install = gdal && cli_spatial_kind(o->file) ? ", or install dyadel-gdal, which reads such files" : "";
  cli_complain("%s: the file is %s; give %s | dyadel %s%s%s%s -%s", o->file, r->kind, make,
               o->command ? o->command : "nearest FILE", option, columns, before, install);
}

/* Opens the file; NULL after a message. */
static FILE *session_open_file(const cli_options *o) {
  struct stat info;
  FILE *in = cli_input_open(o->file, "check the name of the points file");
  if (!in || fstat(fileno(in), &info) != 0 || !S_ISDIR(info.st_mode)) return in;
  cli_complain("%s: is a directory; give the name of a points file in it", o->file);
  cli_input_close(in);
  return NULL;
}

/* Says why the file could not be read; the exit status. */
static int session_complain_read(const cli_options *o, dyd_status st, const dyd_read_report *report,
                                 const dyd_error *err) {
  if (st == DYD_OK) return 0;
  if (report->kind && report->make)
    complain_kind(o, report);
  else if (st == DYD_E_ARG)
    cli_complain("%s", err->message);
  else
    cli_complain_at(o->file, err);
  return st == DYD_E_ARG ? CLI_USAGE : cli_exit_refused(o, st);
}

static int session_read_file(dyd_engine *e, cli_options *o, dyd_read_report *report) {
  FILE *in;
  const bool features = cli_gdal_here && (o->in_layer || cli_spatial_kind(o->file));
  int opened = features ? cli_gdal_here->open(&in, o->file, o) : 0;
  if (opened) return opened;
  if (!features) in = session_open_file(o);
  if (!in) return CLI_FAILED;
  dyd_error err;
  dyd_read_options read = o->read;
  read.report = report;
  read.max_bytes = o->engine.max_bytes;
  dyd_status st = dyd_read_points(e, in, &read, &err);
  if (!features)
    cli_input_close(in);
  else if (!cli_gdal_here->close(in, o->file))
    return CLI_FAILED;
  if (features && err.line > 1) return cli_complain("%s: feature %zu: %s", o->file, err.line - 2, err.message);
  return session_complain_read(o, st, report, &err);
}

int cli_points_read(dyd_engine *e, cli_options *o, bool noting) {
  if (o->oracle) return session_read_oracle(e, o);
  dyd_read_report r = {DYD_SIZED(dyd_read_report)};
  int status = session_read_file(e, o, &r);
  if (status || !noting) return status;
  cli_note_points(e, o, &r);
  return 0;
}

/* ---- places ---- */

/* Names the options of places where the message names those of points. */
static void rename_options(dyd_error *err) {
  static const char *const name[][2] = {{"`columns`", "--query-columns"}, {"`id`", "--query-id"}};
  for (size_t k = 0; k < 2; k++) {
    for (char *at; (at = strstr(err->message, name[k][0]));) {
      char before[sizeof err->message];
      size_t begin = (size_t)(at - err->message);
      memcpy(before, err->message, sizeof before);
      snprintf(at, sizeof err->message - begin, "%s%.*s", name[k][1], (int)(sizeof before - begin - 20),
               before + begin + strlen(name[k][0]));
    }
  }
}

/* A file that can be read again; NULL after a message. */
static FILE *places_open(const cli_options *o) {
  char part[4096];
  FILE *in = session_open_file(o);
  if (!in || fseeko(in, 0, SEEK_SET) == 0) return in;
  FILE *copy = tmpfile();
  size_t n = 1;
  while (copy && (n = fread(part, 1, sizeof part, in)) > 0 && fwrite(part, 1, n, copy) == n) continue;
  if (!copy || n) cli_complain("%s: cannot be kept to be read: %s; give a file", o->file, strerror(errno));
  cli_input_close(in);
  if (copy && n) fclose(copy);
  return n ? NULL : copy;
}

static bool names_numbers(const char *columns) {
  return !columns[strspn(columns, "0123456789, ")];
}

/* The ways to read the file, in the order in which they are tried. */
static size_t places_ways(dyd_read_options way[4], const cli_options *of) {
  const dyd_read_options *r = &of->read;
  const char *columns = of->query_columns;
  if (!columns && r->columns && (of->query_id || !names_numbers(r->columns))) columns = r->columns;
  dyd_read_options base = {DYD_SIZED(dyd_read_options), .decimal_comma = r->decimal_comma,
                           .missing = r->missing,       .skip_missing = r->skip_missing,
                           .degrees = r->degrees,       .max_bytes = of->engine.max_bytes};
  size_t ways = 0;
  if (columns) {
    dyd_read_options *table = &way[ways++];
    *table = base;
    table->columns = columns;
    table->id = of->query_id;
    table->thousands = r->thousands;
    if (r->delimiter) way[ways] = *table, way[ways++].delimiter = r->delimiter;
    if (names_numbers(columns)) way[ways] = *table, way[ways++].no_header = true;
  }
  if (!of->query_columns && !of->query_id) way[ways++] = base;
  return ways;
}

int cli_places_read(dyd_engine *e, const cli_options *of) {
  cli_options o = {.file = of->queries, .quiet = of->quiet, .plane = true, .read = {DYD_SIZED(dyd_read_options)}};
  dyd_read_options way[4];
  dyd_read_report report;
  dyd_error err;
  o.engine.max_bytes = of->engine.max_bytes;
  if (cli_gdal_here && cli_spatial_kind(o.file)) {
    o.read.id = of->query_id;
    return cli_points_read(e, &o, false);
  }
  FILE *in = places_open(&o);
  if (!in) return CLI_FAILED;
  dyd_status st = DYD_E_PARSE;
  size_t ways = places_ways(way, of);
  for (size_t k = 0; k < ways && st == DYD_E_PARSE; k++) {
    report = (dyd_read_report){DYD_SIZED(dyd_read_report)};
    way[k].report = &report;
    rewind(in);
    st = dyd_read_points(e, in, &way[k], &err);
    if (st == DYD_E_PARSE && (report.rows || report.kind)) break; /* the header is right */
  }
  cli_input_close(in);
  if (st != DYD_OK) rename_options(&err);
  int status = session_complain_read(&o, st, &report, &err);
  if (!status) cli_note_lines(&o, &report);
  return status;
}

void cli_options_degrees(cli_options *o) {
  o->read.degrees = true;
  o->read.radius = NULL; /* it may have a unit, and widens places */
}

/* ---- traces ----
 *
 * A trace appears when it has begun: with the answers of --resume, if there are any. From then on it gets a line for
 * each answer as it comes, so that it is there when the run is killed, and goes to the disk in short intervals. */

static uint64_t digest_bytes(uint64_t digest, const char *byte, size_t count) {
  for (size_t k = 0; k < count; k++) digest = (digest ^ (unsigned char)byte[k]) * 1099511628211u;
  return digest;
}

/* FNV-1a of the points file and of the options that select its points. false: it cannot be read twice. */
static bool digest_input(char text[17], const cli_options *o) {
  const dyd_read_field *field;
  const char *value;
  uint64_t digest = 14695981039346656037u;
  char part[4096];
  size_t count;
  FILE *in = o->file && strcmp(o->file, "-") != 0 && !o->oracle ? fopen(o->file, "rb") : NULL;
  if (!in) return false;
  while ((count = fread(part, 1, sizeof part, in)) > 0) digest = digest_bytes(digest, part, count);
  bool good = !ferror(in);
  fclose(in);
  for (size_t k = 0; (field = dyd_read_field_at(&value, &o->read, k)); k++) {
    if (!value || !field->points) continue;
    digest = digest_bytes(digest, field->name, strlen(field->name) + 1);
    digest = digest_bytes(digest, value, strlen(value) + 1);
  }
  snprintf(text, 17, "%016llx", (unsigned long long)digest);
  return good;
}

int cli_trace_resume(const cli_session *s) {
  const cli_options *o = &s->o;
  char input[17];
  dyd_recall_report r = {DYD_SIZED(dyd_recall_report)};
  dyd_error err;
  FILE *in = cli_input_open(o->resume, "check the name of the trace");
  if (!in) return CLI_FAILED;
  dyd_status st = dyd_trace_recall(&r, s->engine, in, digest_input(input, o) ? input : NULL, &err);
  cli_input_close(in);
  if (st != DYD_OK) return cli_complain_at(o->resume, &err);
  cli_note(o, "%s: %zu answers are taken from this trace%s", o->resume, r.answers,
           r.cut ? "; its last line is cut short, and skipped" : "");
  return 0;
}

enum { SYNC_SECONDS = 5 };

/* Begins the trace with the first run. */
static int trace_begin(cli_session *s, const dyd_engine_options *options) {
  const cli_options *o = &s->o;
  char input[17];
  dyd_error err;
  if (!cli_output_open(&s->trace_file, o->trace)) return CLI_FAILED;
  setvbuf(s->trace_file.stream, NULL, _IOLBF, BUFSIZ);
  const char *name = digest_input(input, o) ? input : NULL;
  dyd_status st = dyd_trace_new(&s->trace, s->trace_file.stream, s->engine, name, options, s->converge, &err);
  if (st == DYD_OK) st = dyd_trace_sync(s->trace, o->trace_sync > 0 ? o->trace_sync : SYNC_SECONDS, &err);
  if (st != DYD_OK) cli_complain("%s: %s; choose another place with --trace", o->trace, err.message);
  return st == DYD_OK && cli_output_appear(&s->trace_file) ? 0 : CLI_FAILED;
}

/* Notes the result of a stage where the format shows stages. Where memory is exhausted the run ends, and with it the
 * command. */
static void note_stage(cli_session *s) {
  if (!s->history || s->forgot) return;
  s->forgot = dyd_history_note(s->history, dyd_engine_delaunay(s->engine)) != DYD_OK;
  if (s->forgot) dyd_engine_cancel(s->engine);
}

static void trace_stage(void *user, const dyd_progress *p) {
  cli_session *s = user;
  cli_progress_stage(s->progress, p);
  note_stage(s);
  if (s->trace) dyd_trace_stage(s->trace, p);
}

/* Makes progress and --trace part of a run's options; the trace begins with the first. 0, or an exit status after a
 * message. */
static int trace_attach(dyd_engine_options *options, cli_session *s) {
  int status = s->o.trace && !s->trace ? trace_begin(s, options) : 0;
  options->progress = trace_stage;
  options->progress_user = s;
  options->trace = s->trace ? dyd_trace_step : NULL;
  options->trace_user = s->trace;
  return status;
}

/* Ends the trace, if there is one. 0, or an exit status after a message. */
static int trace_end(cli_session *s) {
  dyd_error err;
  if (!s->trace_file.stream) return 0;
  dyd_error_clear(&err);
  dyd_status st = s->trace ? dyd_trace_end(s->trace, s->outcome, &err) : DYD_OK;
  bool good = fclose(s->trace_file.stream) == 0;
  s->trace = NULL;
  s->trace_file.stream = NULL;
  cli_output_drop(&s->trace_file);
  if (st == DYD_OK && good) return 0;
  return cli_complain("%s: %s; choose another place with --trace", s->o.trace,
                      st == DYD_OK ? strerror(errno) : err.message);
}

/* ---- running ---- */

int cli_session_run(cli_session *s, const dyd_engine_options *options, cli_run_fn run) {
  cli_progress_phase(s->progress, "triangulating");
  dyd_engine_options o = *options;
  o.seconds = cli_deadline_left(s->share);
  o.policy_seconds = s->o.oracle_timeout;
  int status = trace_attach(&o, s);
  if (status) return status;
  dyd_error err;
  dyd_error_clear(&err);
  cli_signals_cancel(s->engine);
  s->outcome = DYD_OUTCOME_NONE;
  dyd_status st = run(s, &o, &err);
  cli_signals_cancel(NULL);
  if (s->outcome == DYD_OUTCOME_NONE) s->outcome = dyd_engine_outcome(s->engine);
  if (s->forgot) return cli_complain_memory();
  if (st == DYD_OK) return 0;
  cli_complain_of(s->places ? s->places : s->engine, s->o.file, &err);
  return cli_exit_refused(&s->o, st);
}

dyd_status cli_run_engine(cli_session *s, const dyd_engine_options *options, dyd_error *err) {
  dyd_outcome outcome;
  return dyd_engine_run(&outcome, s->engine, options, err);
}

int cli_exit_status(dyd_outcome outcome) {
  static const int status[] = {
      [DYD_OUTCOME_NONE] = CLI_FAILED,       [DYD_OUTCOME_DECIDED] = CLI_OK,    [DYD_OUTCOME_CERTIFIED] = CLI_OK,
      [DYD_OUTCOME_FIXPOINT] = CLI_FIXPOINT, [DYD_OUTCOME_BUDGET] = CLI_BUDGET, [DYD_OUTCOME_CANCELLED] = CLI_CANCELLED,
      [DYD_OUTCOME_ERROR] = CLI_FAILED};
  return status[outcome];
}

static const char *budget_advice(dyd_budget b) {
  switch (b) {
  case DYD_BUDGET_BITS:
    return "precision limit reached (raise --max-bits, unless the points are tied)";
  case DYD_BUDGET_PAIRS:
    return "limit of stored pairs reached (raise --max-pairs)";
  case DYD_BUDGET_SECONDS:
    return "time limit reached (raise --timeout)";
  default:
    return "limit reached";
  }
}

void cli_note_pairs(const cli_session *s, dyd_outcome outcome, const size_t count[4], const char *advice) {
  char ties[40] = "";
  if (count[DYD_TIE]) snprintf(ties, sizeof ties, ", %zu tied", count[DYD_TIE]);
  if (outcome == DYD_OUTCOME_FIXPOINT && !advice)
    advice = count[DYD_INDETERMINATE]
                 ? "only better measurements can decide them (see dyadel plan)"
                 : "ties: points on one line or circle, which no refinement decides (see --list-ties groups)";
  const bool plain = outcome == DYD_OUTCOME_FIXPOINT || outcome == DYD_OUTCOME_DECIDED;
  cli_complain("%s%s%zu legal, %zu indeterminate%s pairs; %s", plain ? "" : dyd_outcome_text(outcome),
               plain ? "" : ": ", count[DYD_LEGAL], count[DYD_INDETERMINATE], ties,
               advice ? advice : cli_outcome_advice(s->engine));
}

static bool session_is_capped(const cli_session *s) {
  return dyd_engine_delaunay(s->engine) && dyd_delaunay_is_capped(dyd_engine_delaunay(s->engine));
}

void cli_note_unlisted(const cli_session *s) {
  if (session_is_capped(s))
    cli_note(&s->o, "not all pairs are known: one that is not listed, or not counted, may be an edge, too");
}

const char *cli_outcome_advice(const dyd_engine *e) {
  dyd_engine_counters c = {DYD_SIZED(dyd_engine_counters)};
  switch (dyd_engine_outcome(e)) {
  case DYD_OUTCOME_FIXPOINT:
    return "only better measurements can decide more, and nothing decides ties";
  case DYD_OUTCOME_BUDGET:
    dyd_engine_get_counters(&c, e, NULL);
    return budget_advice(c.spent);
  case DYD_OUTCOME_ERROR:
    return "a point failed; the result is the one before it";
  default:
    return "stopped on request";
  }
}

/* Without a result, no budget but that of time was there. */
static bool session_is_late(const dyd_engine *e) {
  dyd_engine_counters c = {DYD_SIZED(dyd_engine_counters)};
  dyd_engine_get_counters(&c, e, NULL);
  return dyd_engine_outcome(e) == DYD_OUTCOME_BUDGET && (!dyd_engine_delaunay(e) || c.spent == DYD_BUDGET_SECONDS);
}

bool cli_run_was_whole(const dyd_engine *e) {
  return dyd_engine_delaunay(e) && dyd_engine_outcome(e) != DYD_OUTCOME_CANCELLED && !session_is_late(e);
}

dyd_status cli_session_cut(dyd_status st, const dyd_error *err) {
  bool late = cli_deadline_passed();
  if (st != DYD_CANCELLED) return st;
  cli_complain("%s: %s%s", late ? "budget" : "cancelled", err->message, late ? " (raise --timeout)" : "");
  return DYD_OK;
}

int cli_exit_cut(void) {
  return cli_deadline_passed() ? CLI_BUDGET : CLI_CANCELLED;
}

void cli_session_settle(cli_session *s) {
  cli_progress_phase(s->progress, "writing");
  if (s->o.output || !isatty(STDOUT_FILENO)) return;
  cli_progress_stop(s->progress);
  s->progress = NULL;
}

void cli_session_lacks(cli_session *s, dyd_outcome outcome, const char *what) {
  cli_session_settle(s);
  cli_complain("%s before %s: there is no result to write", dyd_outcome_text(outcome), what);
}

/* The engine may see the end of time a little before the flag is raised. */
int cli_session_stopped(cli_session *s, const char *what) {
  cli_session_settle(s);
  bool late = cli_deadline_passed() || session_is_late(s->engine);
  cli_complain("%s before %s known: there is no result to write%s", late ? "budget: time limit reached" : "cancelled",
               what, late ? " (raise --timeout)" : "");
  return late ? CLI_BUDGET : CLI_CANCELLED;
}

/* ---- writing ---- */

/* The certificate that the options ask for, after results were written with this status. Returns the status of all. */
static int session_prove(cli_session *s, int status) {
  const char *certificate = s->o.certificate;
  if (!certificate || !s->work->prove || (status && !cli_output_lost_reader())) return status;
  if (cli_deadline_passed()) {
    cli_complain("budget: time limit reached, so no certificate is written (raise --timeout)");
    return CLI_BUDGET;
  }
  cli_progress_phase(s->progress, "the certificate");
  int written = cli_write_file(certificate, s, s->work->prove);
  return status ? status : written;
}

/* ---- comments of csv ----
 *
 * Without --comments their summary of the whole result goes to standard error. */

/* The last part of the name of the points file; NULL: there is none. */
static const char *points_name(const cli_options *o) {
  const char *slash = o->file ? strrchr(o->file, '/') : NULL;
  return !o->file || strcmp(o->file, "-") == 0 ? NULL : slash ? slash + 1 : o->file;
}

dyd_write_options cli_write_options(FILE *out, const cli_session *s) {
  return (dyd_write_options){DYD_SIZED(dyd_write_options),
                             .style = &s->o.style,
                             .window = s->view,
                             .sphere = s->sphere,
                             .pairs = s->discs,
                             .history = s->discs ? NULL : s->history,
                             .epsg = s->o.epsg,
                             .name = points_name(&s->o),
                             .outcome = s->outcome,
                             .comments = s->o.comments ? out : s->noted};
}

dyd_status cli_write(FILE *out, const cli_session *s, const dyd_write_options *how, dyd_error *err) {
  return dyd_write(out, s->engine, s->o.content, s->o.format, how, err);
}

/* Returns true if the line says something that no other line of ours says. */
static bool comment_is_summary(const char *line) {
  static const char *const begin[] = {
      "undetermined_area", "distance_to",     "tolerance ", "plan ", "ties ",  "orientation ",
      "partial ",          "the rectangles ", "schedule ",  "con ",  "trials "};
  for (size_t k = 0; k < sizeof begin / sizeof *begin; k++)
    if (strncmp(line, begin[k], strlen(begin[k])) == 0) return true;
  return false;
}

/* The window of a diagram, as decimals. Returns the length of the text. */
static size_t note_window(char *text, size_t size, const cli_session *s) {
  double b[4];
  char end[4][32];
  bool exact = true;
  if (!s->diagram) return 0;
  dyd_rect_get_d(b, &s->window);
  for (int k = 0; k < 4; k++) {
    snprintf(end[k], sizeof end[k], "%.6g", b[k]);
    exact &= strtod(end[k], NULL) == b[k];
    for (char *comma = end[k]; (comma = strchr(comma, ','));) *comma = '.'; /* of a locale */
  }
  return (size_t)snprintf(text, size, "window %s%s,%s,%s,%s", exact ? "" : "about ", end[0], end[1], end[2], end[3]);
}

/* The comments that were put aside, in one line. */
static void note_comments(cli_session *s) {
  char text[2048] = "";
  const size_t window = note_window(text, sizeof text, s);
  size_t used = window, aliases = 0, length;
  if (s->noted && fclose(s->noted) == 0 && s->note && !s->written) {
    for (const char *line = s->note; *line; line += length + (line[length] == '\n')) {
      length = strcspn(line, "\n");
      aliases += strncmp(line, "# alias", 7) == 0;
      if (length < 2 || !comment_is_summary(line + 2) || used + length >= sizeof text) continue;
      used += (size_t)snprintf(text + used, sizeof text - used, "%s%.*s%s", used ? "; " : "", (int)length - 2, line + 2,
                               line[length - 1] == ',' ? "unbounded or beyond doubles" : "");
      if (used >= sizeof text) used = sizeof text - 1;
    }
    for (char *comma = text + window; (comma = strchr(comma, ',')) && comma[1] != ' ';) *comma = ' ';
    if (used) cli_note(&s->o, "%s", text);
    if (aliases)
      cli_note(&s->o, "points that coincide with earlier ones: %zu (--comments lists them in front of the table)",
               aliases);
  }
  free(s->note);
}

/* ---- summaries ----
 *
 * A bound m * 2^e > 0 with k bits in m is at most 2^(k+e), or 2^(k+e-1) when m = 1: bounds are printed as such
 * powers, as goals are given. */

static const char *goal_subject(dyd_goal goal) {
  static const char *const subject[] = {[DYD_GOAL_AREA] = "the undecided area of the triangulation",
                                        [DYD_GOAL_HAUSDORFF] = "the distance to the true triangulation",
                                        [DYD_GOAL_VORONOI_AREA] = "the undecided area of the diagram",
                                        [DYD_GOAL_VORONOI_HAUSDORFF] = "the distance to the true diagram"};
  return subject[goal];
}

dyd_goal cli_voronoi_goal(dyd_goal goal) {
  if (goal == DYD_GOAL_AREA) return DYD_GOAL_VORONOI_AREA;
  return goal == DYD_GOAL_HAUSDORFF ? DYD_GOAL_VORONOI_HAUSDORFF : goal;
}

static bool goal_is_area(dyd_goal goal) {
  return goal == DYD_GOAL_AREA || goal == DYD_GOAL_VORONOI_AREA;
}

/* The bound reached; false when none is known. */
static bool goal_reached(dyd_dyadic *out, const cli_session *s, dyd_goal goal) {
  bool known = false;
  dyd_dyadic other;
  dyd_dyadic_init(&other);
  if (goal == DYD_GOAL_AREA)
    known = dyd_engine_bounds(out, &other, s->engine) == DYD_OK;
  else if (goal == DYD_GOAL_HAUSDORFF)
    known = dyd_engine_bounds(&other, out, s->engine) == DYD_OK;
  else if (s->bounds)
    known = goal_is_area(goal) || s->bounds->finite;
  if (known && goal == DYD_GOAL_VORONOI_AREA) dyd_dyadic_set(out, &s->bounds->area);
  if (known && goal == DYD_GOAL_VORONOI_HAUSDORFF) dyd_dyadic_set(out, &s->bounds->hausdorff);
  dyd_dyadic_clear(&other);
  return known && dyd_dyadic_sgn(out) > 0;
}

/* The least e with bound <= 2^e. */
static int64_t power_above(const dyd_dyadic *bound) {
  int64_t top = bound->exp + (int64_t)mpz_sizeinbase(bound->man, 2);
  return mpz_cmp_ui(bound->man, 1) == 0 ? top - 1 : top;
}

/* Prints one line about a requested bound that was not reached: the reason (advice) and the remedy. Returns false, and
 * prints nothing, if no bound was requested. */
static bool note_goal(const cli_session *s, const char *advice) {
  int64_t bits;
  dyd_goal goal = dyd_engine_goal(&bits, s->engine);
  if (goal == DYD_GOAL_DECIDED) return false;
  const char *outcome = dyd_outcome_text(dyd_engine_outcome(s->engine)),
             *name = goal_is_area(goal) ? "area" : "hausdorff";
  dyd_dyadic bound;
  dyd_dyadic_init(&bound);
  if (goal_reached(&bound, s, goal)) {
    int64_t power = power_above(&bound);
    cli_complain("%s: %s is at most 2^%" PRId64 ", not 2^%" PRId64 " as asked; %s; --until %s:%" PRId64 " holds",
                 outcome, goal_subject(goal), power, -bits, advice, name, -power);
  } else {
    cli_complain("%s: %s is not known to be at most 2^%" PRId64 ", as asked; no bound is known; %s", outcome,
                 goal_subject(goal), -bits, advice);
  }
  dyd_dyadic_clear(&bound);
  return true;
}

/* One line about a result that leaves something open. */
static void session_note_outcome(const cli_session *s) {
  const dyd_delaunay *pd = dyd_engine_delaunay(s->engine);
  dyd_outcome outcome = dyd_engine_outcome(s->engine);
  if (!pd || outcome == DYD_OUTCOME_DECIDED || outcome == DYD_OUTCOME_CERTIFIED) return;
  cli_note_unlisted(s);
  if (note_goal(s, cli_outcome_advice(s->engine))) return;
  size_t count[4];
  dyd_delaunay_count(count, pd);
  cli_note_pairs(s, outcome, count, NULL);
}

/* Rectangles that meet can be chosen as points arbitrarily near to each other, so their pair is possible: going over
 * the possible pairs finds all of them. */

static bool note_is_wide(const double b[4]) {
  return b[1] > b[0] || b[3] > b[2];
}

/* Longitudes count modulo 360. */
static bool note_meets(const double a[4], const double b[4], bool globe) {
  bool across = a[0] <= b[1] && b[0] <= a[1];
  for (int turn = -360; globe && !across && turn <= 360; turn += 720)
    across = a[0] <= b[1] + turn && b[0] + turn <= a[1];
  return across && a[2] <= b[3] && b[2] <= a[3];
}

/* The boxes of all sites, of places in degrees; NULL: memory is exhausted. */
static double (*note_boxes(const dyd_sites *sites, const dyd_sphere *sphere, size_t n))[4] {
  double(*box)[4] = calloc(n + 1, sizeof *box);
  dyd_rect r;
  dyd_rect_init(&r);
  for (uint32_t i = 0; box && i < n; i++) {
    if (!sphere)
      dyd_sites_get_d(box[i], sites, i);
    else if (dyd_sphere_rect(&r, sphere, i) == DYD_OK)
      dyd_rect_get_d(box[i], &r);
  }
  dyd_rect_clear(&r);
  return box;
}

/* Counts rectangles (points are none), and those among them that meet another site. false: memory is exhausted. */
static bool count_meetings(size_t *rectangles, size_t *meeting, const dyd_delaunay *pd, const dyd_sphere *sphere) {
  const dyd_sites *sites = dyd_delaunay_sites(pd);
  size_t n = sphere ? dyd_engine_count(dyd_sphere_places(sphere)) : dyd_sites_count(sites);
  bool *meets = calloc(n + 1, sizeof *meets);
  double(*box)[4] = note_boxes(sites, sphere, n);
  dyd_pair_list pairs = {0};
  dyd_status st = sphere ? dyd_sphere_pairs(&pairs, sphere) : dyd_delaunay_pairs(&pairs, pd);
  bool good = meets && box && st == DYD_OK;
  for (size_t k = 0; good && k < pairs.count; k++) {
    const dyd_pair *p = &pairs.item[k];
    if (note_meets(box[p->i], box[p->j], sphere)) meets[p->i] = meets[p->j] = true;
  }
  *rectangles = *meeting = 0;
  for (size_t i = 0; good && i < n; i++) {
    *rectangles += note_is_wide(box[i]);
    *meeting += note_is_wide(box[i]) && meets[i];
  }
  dyd_pair_list_clear(&pairs);
  free(box);
  free(meets);
  return good;
}

void cli_note_spacing(const cli_session *s, const dyd_delaunay *pd) {
  const cli_options *o = &s->o;
  size_t rectangles, meeting;
  if (!pd || o->quiet || (!o->read.radius && !o->read.radius_columns)) return;
  if (!count_meetings(&rectangles, &meeting, pd, s->sphere) || 2 * meeting <= rectangles) return;
  cli_note(o,
           "the radius is large for the spacing of the points: %s%zu of %zu %s meet another one, so that few "
           "pairs can be decided (a smaller radius decides more)",
           session_is_capped(s) ? "at least " : "", meeting, rectangles, s->sphere ? "regions" : "rectangles");
}

/* A line when points have no row in wkt or geojson, since they coincide with others. */
static void note_aliases(const dyd_delaunay *pd, const cli_options *o) {
  bool of_points =
      o->content == DYD_CONTENT_DELAUNAY || o->content == DYD_CONTENT_VORONOI || cli_layer_is_graph(o->content);
  size_t aliases = 0, n = pd ? dyd_sites_count(dyd_delaunay_sites(pd)) : 0;
  if (!of_points || (o->format != DYD_FORMAT_WKT && o->format != DYD_FORMAT_GEOJSON)) return;
  for (size_t i = 0; i < n; i++) aliases += dyd_delaunay_alias(pd, (uint32_t)i) != i;
  if (aliases)
    cli_note(o, "%zu points coincide with earlier ones and have no row of their own (list them: --layer aliases)",
             aliases);
}

/* ---- statistics: one "name value" per line ---- */

static void stats_line(FILE *out, const char *name, uint64_t value) {
  fprintf(out, "%-26s %" PRIu64 "\n", name, value);
}

/* discs: their pairs; NULL: those of rectangles count. */
static void plane_count(size_t count[4], size_t *aliases, const dyd_delaunay *pd, const dyd_pair_list *discs) {
  size_t sites = dyd_sites_count(dyd_delaunay_sites(pd));
  for (size_t i = 0; i < sites; i++) *aliases += dyd_delaunay_alias(pd, (uint32_t)i) != i;
  if (!discs) dyd_delaunay_count(count, pd);
  for (size_t k = 0; discs && k < discs->count; k++) count[discs->item[k].status]++;
}

/* Of the places, not of their images. */
static void sphere_count(size_t count[4], size_t *aliases, const dyd_sphere *sphere) {
  dyd_pair_list pairs = {0};
  size_t places = dyd_engine_count(dyd_sphere_places(sphere));
  for (size_t i = 0; i < places; i++) *aliases += dyd_sphere_alias(sphere, (uint32_t)i) != i;
  if (dyd_sphere_pairs(&pairs, sphere) == DYD_OK)
    for (size_t k = 0; k < pairs.count; k++) count[pairs.item[k].status]++;
  dyd_pair_list_clear(&pairs);
}

static void result_stats(FILE *out, const dyd_delaunay *pd, const dyd_sphere *sphere, const dyd_pair_list *discs) {
  size_t count[4] = {0}, aliases = 0;
  if (sphere)
    sphere_count(count, &aliases, sphere);
  else
    plane_count(count, &aliases, pd, discs);
  stats_line(out, "aliases", aliases);
  stats_line(out, "pairs legal", count[DYD_LEGAL]);
  stats_line(out, "pairs indeterminate", count[DYD_INDETERMINATE]);
  stats_line(out, "pairs tie", count[DYD_TIE]);
  fprintf(out, "%-26s %s\n", "capped", dyd_delaunay_is_capped(pd) ? "yes" : "no");
  stats_line(out, "bytes triangulation", dyd_delaunay_memory(pd));
  stats_line(out, "bytes sites", dyd_sites_memory(dyd_delaunay_sites(pd)));
}

static const char *budget_text(dyd_budget b) {
  static const char *const text[] = {
      [DYD_BUDGET_NONE] = "none",   [DYD_BUDGET_BITS] = "bits",   [DYD_BUDGET_STAGES] = "stages",
      [DYD_BUDGET_CALLS] = "calls", [DYD_BUDGET_PAIRS] = "pairs", [DYD_BUDGET_SECONDS] = "seconds"};
  return text[b];
}

static void tie_stats(FILE *out, const dyd_tie_counters *t) {
  stats_line(out, "zero tests", t->tests);
  stats_line(out, "zero by identity", t->by_identity);
  stats_line(out, "zero by bound", t->by_bound);
  stats_line(out, "not zero", t->nonzero);
  stats_line(out, "zero or not, unknown", t->unknown);
  fprintf(out, "%-26s %" PRId64 "\n%-26s %" PRId64 "\n%-26s %.3f\n", "bits in tests, most", t->bits_most,
          "degree in tests, most", t->degree_most, "seconds in tests", t->seconds);
}

static void session_print_stats(FILE *out, const dyd_engine *e, const dyd_sphere *sphere, const dyd_pair_list *discs,
                                double seconds) {
  dyd_engine_counters c = {DYD_SIZED(dyd_engine_counters)};
  dyd_engine_get_counters(&c, e, NULL);
  fprintf(out, "%-26s %s\n", "outcome", dyd_outcome_text(sphere ? dyd_sphere_outcome(sphere) : dyd_engine_outcome(e)));
  fprintf(out, "%-26s %s\n", "budget spent", budget_text(c.spent));
  stats_line(out, "points", dyd_engine_count(sphere ? dyd_sphere_places(sphere) : e));
  if (dyd_engine_delaunay(e)) result_stats(out, dyd_engine_delaunay(e), sphere, discs);
  stats_line(out, "undecided faces", c.undecided_faces);
  stats_line(out, "stages", c.stages);
  stats_line(out, "stream calls", c.calls);
  fprintf(out, "%-26s %" PRId64 "\n%-26s %" PRId64 "\n", "bits asked, least", c.bits_least, "bits asked, most",
          c.bits_most);
  stats_line(out, "bits asked, total", c.bits_total);
  stats_line(out, "decisions in doubles", c.delaunay.filter);
  stats_line(out, "decisions in integers", c.delaunay.integer);
  stats_line(out, "decisions in GMP", c.delaunay.exact);
  stats_line(out, "witnesses guessed", c.delaunay.witness_guess);
  stats_line(out, "witnesses searched", c.delaunay.witness_search);
  stats_line(out, "cover walks", c.delaunay.cover_walks);
  stats_line(out, "faces worked on", c.delaunay.faces);
  tie_stats(out, &c.ties);
  fprintf(out, "%-26s %.3f\n%-26s %.3f\n", "seconds in the engine", c.seconds, "seconds in all", seconds);
  struct rusage usage;
  if (getrusage(RUSAGE_SELF, &usage) == 0) stats_line(out, "KiB of memory at most", (uint64_t)usage.ru_maxrss);
}

void cli_session_stats(const cli_session *s, const dyd_sphere *sphere) {
  if (!s->o.stats || (!sphere && dyd_engine_outcome(s->engine) == DYD_OUTCOME_NONE)) return;
  session_print_stats(stderr, s->engine, sphere, s->discs, cli_clock() - s->begun);
}

int cli_pairs_summary(cli_session *s, int status) {
  const dyd_delaunay *pd = dyd_engine_delaunay(s->engine);
  if (status == CLI_OK) status = cli_exit_status(dyd_engine_outcome(s->engine));
  if (status != CLI_OK && !s->o.quiet) session_note_outcome(s);
  note_aliases(pd, &s->o);
  if (status != CLI_OK) cli_note_spacing(s, pd);
  cli_session_stats(s, NULL);
  return status;
}

/* ---- a command ---- */

/* The ends of the window of tiles are corners of these: doubles, outward. What doubles do not hold stays. */
static int window_of_tiles(cli_session *s) {
  double b[4];
  dyd_rect_get_d(b, &s->window);
  const bool held = isfinite(b[0]) && isfinite(b[1]) && isfinite(b[2]) && isfinite(b[3]);
  if (!held || !s->diagram || (s->o.content != DYD_CONTENT_TILES && !s->o.all_layers)) return 0;
  return dyd_rect_set_d(&s->window, b[0], b[1], b[2], b[3]) == DYD_OK ? 0 : cli_complain_memory();
}

/* Runs `begin`, and reads the window. */
static int work_begin(cli_session *s) {
  int status = s->work->begin ? s->work->begin(s) : 0;
  if (!status && s->o.window) {
    s->view = &s->window;
    status = cli_window_read(&s->window, s->o.window);
    if (!status) status = window_of_tiles(s);
  }
  if (!status && s->o.format == DYD_FORMAT_HTML && !s->o.sphere && dyd_history_new(&s->history) != DYD_OK)
    return cli_complain_memory();
  return status;
}

static int work_open(cli_session *s) {
  if (dyd_engine_new(&s->engine) != DYD_OK) return cli_complain_memory();
  s->progress = cli_progress_start(s->o.quiet);
  cli_progress_phase(s->progress, "reading");
  int status = cli_points_read(s->engine, &s->o, true);
  return status == 0 && s->o.resume ? cli_trace_resume(s) : status;
}

/* Frees s after all was written with this status; the exit status. */
static int work_close(cli_session *s, int status) {
  cli_progress_stop(s->progress);
  int traced = trace_end(s);
  if (!status) status = traced;
  if (s->work->summary && (s->engine || s->work->bare)) status = s->work->summary(s, status);
  cli_deadline_written(status);
  if (s->work->end && s->state) s->work->end(s);
  free(s->state);
  if (s->places) s->engine = s->places; /* images are the sphere's */
  dyd_sphere_free(s->sphere);
  dyd_engine_free(s->engine);
  dyd_history_free(s->history);
  dyd_rect_clear(&s->window);
  return status;
}

int cli_work_run(const cli_work *work, const cli_options *o) {
  cli_session s = {.work = work, .o = *o, .begun = cli_clock(), .share = 1};
  const cli_work *instead = work->instead ? work->instead(o) : NULL;
  if (instead) s.work = instead;
  dyd_rect_init(&s.window);
  s.state = calloc(1, s.work->size + 1);
  int status = s.state ? work_begin(&s) : cli_complain_memory();
  if (!status && !s.work->bare) status = work_open(&s);
  if (!status) status = s.work->find(&s);
  cli_session_settle(&s);
  if (s.known && s.work->write) {
    if (s.o.format == DYD_FORMAT_CSV && !s.o.comments && !s.o.quiet) s.noted = open_memstream(&s.note, &s.note_size);
    s.written = session_prove(&s, s.o.driver ? cli_gdal_here->write(&s, s.work->write)
                                             : cli_write_file(s.o.output, &s, s.work->write));
    if (!status) status = s.written;
    note_comments(&s);
  }
  return work_close(&s, status);
}
