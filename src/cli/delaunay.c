/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* dyadel delaunay FILE: read, run, write. A window is what pictures and pages show. */
#include "cli.h"

/* Of points that are all exact, as far as time allows; NULL: not known. */
static dyd_tolerance *find_tolerance(const dyd_delaunay *pd) {
  const dyd_tolerance_options options = {DYD_SIZED(dyd_tolerance_options), .points = true,
                                         .cancel = cli_signals_flag()};
  const dyd_sites *sites = dyd_delaunay_sites(pd);
  dyd_tolerance *t = NULL;
  for (size_t i = 0; i < dyd_sites_count(sites); i++)
    if (!dyd_sites_is_point(sites, i)) return NULL;
  if (dyd_tolerance_new(&t, pd, &options, NULL) == DYD_OK) return t;
  dyd_tolerance_free(t);
  return NULL;
}

/* pairs: of discs; NULL: those of the engine. */
static dyd_status write_pairs(FILE *out, const dyd_engine *e, const dyd_pair_list *pairs, const cli_options *o,
                              dyd_error *err) {
  dyd_tolerance *tolerance = NULL;
  if (!pairs && o->format == DYD_FORMAT_HTML) tolerance = find_tolerance(dyd_engine_delaunay(e));
  const dyd_write_options how = {DYD_SIZED(dyd_write_options),
                                 .window = o->view,
                                 .pairs = pairs,
                                 .epsg = o->epsg,
                                 .history = pairs ? NULL : o->history,
                                 .tolerance = tolerance,
                                 .cancel = cli_signals_flag(),
                                 .ties = o->list_ties};
  dyd_status st = dyd_write(out, e, o->content, o->format, &how, err);
  dyd_tolerance_free(tolerance);
  return st;
}

static dyd_status delaunay_write(FILE *out, const void *engine, const cli_options *o, dyd_error *err) {
  return write_pairs(out, engine, NULL, o, err);
}

/* ---- discs ---- */

typedef struct disc_result {
  const dyd_engine *engine;
  dyd_pair_list pairs;
} disc_result;

static dyd_status discs_write(FILE *out, const void *what, const cli_options *o, dyd_error *err) {
  const disc_result *r = what;
  return write_pairs(out, r->engine, &r->pairs, o, err);
}

static dyd_status discs_certificate(FILE *out, const void *what, const cli_options *o, dyd_error *err) {
  const disc_result *r = what;
  (void)o;
  const dyd_certificate_parts parts = {DYD_SIZED(dyd_certificate_parts), .discs = &r->pairs};
  return dyd_write_certificate_parts(out, r->engine, &parts, err);
}

/* What is open among the discs: exit status, and a note. cut: not all pairs were reached. */
static int discs_outcome(const disc_result *r, bool cut, const cli_options *o) {
  size_t count[4] = {0};
  for (size_t k = 0; k < r->pairs.count; k++) count[r->pairs.item[k].status]++;
  dyd_outcome outcome = dyd_engine_outcome(r->engine);
  if (cut) return cli_exit_cut();
  if (!dyd_delaunay_is_capped(dyd_engine_delaunay(r->engine)) && count[DYD_INDETERMINATE] + count[DYD_TIE] == 0)
    return CLI_OK;
  if (!o->quiet)
    cli_complain("%s: %zu legal, %zu indeterminate, %zu tie among the discs; %s", dyd_outcome_text(outcome),
                 count[DYD_LEGAL], count[DYD_INDETERMINATE], count[DYD_TIE], cli_outcome_advice(r->engine));
  return cli_exit_status(outcome);
}

static int discs_result(cli_session *s, disc_result *r, const cli_options *o) {
  dyd_error err;
  r->engine = s->engine;
  int status = cli_session_run(s, &o->engine);
  if (status) return status;
  if (!dyd_engine_delaunay(s->engine)) return cli_session_write(s, delaunay_write);
  cli_progress_phase(s->progress, "the discs");
  dyd_status st = dyd_disc_pairs_until(&r->pairs, dyd_engine_delaunay(s->engine), cli_signals_flag(), &err);
  if (st < 0) {
    cli_complain_at(o->file, &err);
    return CLI_FAILED;
  }
  cli_session_cut(st, &err);
  s->discs = &r->pairs;
  cli_session_settle(s);
  status = cli_write_file(o->output, o, discs_write, r);
  if (st == DYD_OK || cli_deadline_passed()) status = cli_session_certificate(s, status, discs_certificate, r);
  return status ? status : discs_outcome(r, st == DYD_CANCELLED, o);
}

static int delaunay_discs(cli_options *o) {
  const cli_options as_given = *o;
  disc_result r = {0};
  cli_session s;
  int status = cli_session_open(&s, o);
  if (!status) {
    status = discs_result(&s, &r, &as_given);
    o->quiet = true; /* the session would tell of the squares */
  }
  int end = cli_session_close(&s, status);
  dyd_pair_list_clear(&r.pairs);
  return o->quiet && status == CLI_OK ? CLI_OK : end;
}

int cli_delaunay(const cli_options *o) {
  cli_options own = *o; /* with the window read */
  dyd_rect window;
  if (o->certificate && o->content == DYD_CONTENT_GRAPH_MST) {
    cli_complain("no certificate proves a minimum spanning tree: leave --certificate or --layer graph:mst out");
    return CLI_USAGE;
  }
  if (o->sphere) return cli_sphere(o);
  dyd_rect_init(&window);
  int status = 0;
  if (o->window) {
    own.view = &window;
    status = cli_window_read(&window, o->window);
  }
  if (!status) status = cli_history_open(&own);
  if (!status) status = o->discs ? delaunay_discs(&own) : cli_session_all(&own, delaunay_write);
  dyd_history_free(own.history);
  dyd_rect_clear(&window);
  return status;
}
