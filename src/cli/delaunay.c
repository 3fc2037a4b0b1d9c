/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* dyadel delaunay FILE and dyadel voronoi FILE, in the plane and on a sphere: read, run, write. */
#include "cli.h"

/* ---- delaunay: a window is what pictures and pages show ---- */

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

static const cli_work work_discs;

static const cli_work *delaunay_instead(const cli_options *o) {
  return o->sphere ? &cli_sphere : o->discs ? &work_discs : NULL;
}

/* Statuses found before a point failed stay true: they are written, and the exit status reports the failure. */
static int pairs_find(cli_session *s) {
  int status = cli_session_run(s, &s->o.engine, cli_run_engine);
  s->known = dyd_engine_delaunay(s->engine);
  if (!status && !s->known) cli_session_lacks(s, s->outcome, "the first triangulation was complete");
  return status;
}

/* The first member of what a command keeps that takes --discs. */
typedef struct disc_result {
  dyd_pair_list pairs;
  dyd_graph_list graph;
  bool cut; /* not all pairs were reached */
} disc_result;

static dyd_status run_graph(cli_session *s, const dyd_engine_options *options, dyd_error *err) {
  dyd_graph_list *list = s->o.discs ? &((disc_result *)s->state)->graph : s->state;
  dyd_graph graph = (dyd_graph)(s->o.content - DYD_CONTENT_GRAPH_NEAREST);
  dyd_status st = dyd_engine_graph(list, &s->outcome, s->engine, graph, options, err);
  if (st == DYD_OK)
    s->graph = list;
  else
    s->outcome = DYD_OUTCOME_NONE;
  return st > 0 ? DYD_OK : st;
}

static int find_graph(cli_session *s, int status) {
  if (status || !cli_layer_is_graph(s->o.content) || !cli_run_was_whole(s->engine)) return status;
  status = cli_session_run(s, &s->o.engine, run_graph);
  if (status == CLI_BUDGET) s->known = false; /* memory was refused */
  return status;
}

static int delaunay_find(cli_session *s) {
  return find_graph(s, pairs_find(s));
}

/* The pairs of s->discs, if there are any; else those of the engine. */
static dyd_status delaunay_write(FILE *out, const cli_session *s, dyd_error *err) {
  const cli_options *o = &s->o;
  dyd_tolerance *tolerance = NULL;
  if (!s->discs && o->format == DYD_FORMAT_HTML) tolerance = find_tolerance(dyd_engine_delaunay(s->engine));
  dyd_write_options how = cli_write_options(out, s);
  how.graph = s->graph;
  how.tolerance = tolerance;
  how.cancel = cli_signals_flag();
  how.ties = o->list_ties;
  how.lengths = o->lengths;
  dyd_status st = cli_write(out, s, &how, err);
  dyd_tolerance_free(tolerance);
  return st;
}

/* Of the diagram, where the engine has a window; else of the pairs, and the graph of --layer. */
static dyd_status write_certificate(FILE *out, const cli_session *s, dyd_error *err) {
  dyd_graph_list list = {0};
  dyd_certificate_parts parts = {DYD_SIZED(dyd_certificate_parts), .window = s->o.engine.window};
  dyd_status st = DYD_OK;
  if (s->discs && cli_layer_is_graph(s->o.content))
    cli_note(&s->o, "the certificate states the pairs of the discs, not the graph");
  parts.diagram = parts.window;
  parts.discs = s->discs;
  if (!parts.diagram && !s->discs && cli_layer_is_graph(s->o.content)) {
    parts.kind = (int)(s->o.content - DYD_CONTENT_GRAPH_NEAREST);
    /* Where the run was cut, rectangles may be narrower than those of the graph. */
    bool found = s->graph && (s->outcome == DYD_OUTCOME_DECIDED || s->outcome == DYD_OUTCOME_FIXPOINT);
    parts.graph = found ? s->graph : &list;
    if (!found)
      st = dyd_graph_edges(&list, dyd_engine_delaunay(s->engine), NULL, (dyd_graph)parts.kind, cli_signals_flag(), err);
  }
  if (st == DYD_OK) st = dyd_write_certificate(out, s->engine, &parts, err);
  dyd_graph_list_clear(&list);
  return st;
}

/* Of a graph, how many of its edges are certain. */
static int graph_summary(cli_session *s, int status) {
  const dyd_graph_list *list = s->graph;
  size_t sure = 0;
  bool failed = status == CLI_FAILED || status == CLI_USAGE;
  if (failed || !list || cli_exit_status(s->outcome) <= status) return status;
  for (size_t k = 0; k < list->count; k++) sure += list->item[k].sure;
  cli_note(&s->o, "%s: %zu edges of the graph are certain, %zu possible", dyd_outcome_text(s->outcome), sure,
           list->count - sure);
  return cli_exit_status(s->outcome);
}

static int delaunay_summary(cli_session *s, int status) {
  return graph_summary(s, cli_pairs_summary(s, status));
}

static void delaunay_end(cli_session *s) {
  dyd_graph_list_clear(s->state);
}

const cli_work cli_delaunay = {.size = sizeof(dyd_graph_list),
                               .instead = delaunay_instead,
                               .find = delaunay_find,
                               .write = delaunay_write,
                               .prove = write_certificate,
                               .summary = delaunay_summary,
                               .end = delaunay_end};

/* ---- --discs ---- */

static dyd_status run_discs(cli_session *s, const dyd_engine_options *options, dyd_error *err) {
  disc_result *r = s->state;
  dyd_status st = cli_run_was_whole(s->engine)
                      ? dyd_engine_discs(&r->pairs, &s->outcome, s->engine, options, err)
                      : dyd_disc_pairs(&r->pairs, dyd_engine_delaunay(s->engine), cli_signals_flag(), err);
  r->cut = st == DYD_CANCELLED;
  cli_session_cut(st, err);
  cli_note_unlisted(s);
  return st < 0 ? st : DYD_OK;
}

static int find_discs(cli_session *s) {
  disc_result *r = s->state;
  cli_progress_phase(s->progress, "the discs");
  int status = cli_session_run(s, &s->o.engine, run_discs);
  s->known = !status;
  if (status) return status;
  s->discs = &r->pairs;
  if (r->cut && !cli_deadline_passed()) s->o.certificate = NULL;
  return 0;
}

static int disc_pairs_find(cli_session *s) {
  int status = pairs_find(s);
  s->known = s->known && !status;
  if (s->known) status = find_discs(s);
  return s->known && !((disc_result *)s->state)->cut ? find_graph(s, status) : status;
}

/* Counts pairs by status. */
static void count_pairs(size_t count[4], const dyd_pair_list *pairs) {
  for (int k = 0; k < 4; k++) count[k] = 0;
  for (size_t k = 0; k < pairs->count; k++) count[pairs->item[k].status]++;
}

/* Reports the undecided pairs of the discs. Returns the exit status. */
static int disc_pairs_outcome(const cli_session *s) {
  const disc_result *r = s->state;
  size_t count[4];
  if (!s->known) return cli_exit_status(s->outcome);
  if (r->cut) return cli_exit_cut();
  /* The run on squares had all it wanted. */
  const bool bits = s->outcome == DYD_OUTCOME_BUDGET && dyd_engine_outcome(s->engine) == DYD_OUTCOME_FIXPOINT;
  const char *advice = bits && !cli_deadline_passed() ? "precision limit reached (raise --max-bits)" : NULL;
  count_pairs(count, &r->pairs);
  if (!dyd_delaunay_is_capped(dyd_engine_delaunay(s->engine)) && count[DYD_INDETERMINATE] + count[DYD_TIE] == 0)
    return CLI_OK;
  if (!s->o.quiet) cli_note_pairs(s, s->outcome, count, advice);
  return cli_exit_status(s->outcome);
}

static int disc_pairs_summary(cli_session *s, int status) {
  if (!status && !s->graph) status = disc_pairs_outcome(s);
  cli_session_stats(s, NULL);
  return graph_summary(s, status);
}

static void disc_pairs_end(cli_session *s) {
  dyd_graph_list_clear(&((disc_result *)s->state)->graph);
  dyd_pair_list_clear(&((disc_result *)s->state)->pairs);
}

static const cli_work work_discs = {.size = sizeof(disc_result),
                                    .find = disc_pairs_find,
                                    .write = delaunay_write,
                                    .prove = write_certificate,
                                    .summary = disc_pairs_summary,
                                    .end = disc_pairs_end};

/* ---- voronoi ---- */

typedef struct voronoi_result {
  disc_result discs;
  cli_diagram diagram;
} voronoi_result;

static const cli_work *voronoi_instead(const cli_options *o) {
  return o->sphere ? &cli_sphere : NULL;
}

/* Reads the area that tiles are cut to; the window is the box around it, unless one is given. */
static int voronoi_read_area(cli_session *s) {
  dyd_area *a = &s->diagram->clip_to;
  dyd_error err;
  dyd_error_clear(&err);
  FILE *in = cli_input_open(s->o.clip_to, "check the name of the file of polygons");
  if (!in) return CLI_FAILED;
  dyd_status st = dyd_area_read(a, in, &err);
  cli_input_close(in);
  if (st != DYD_OK) return cli_complain_at(s->o.clip_to, &err);
  double box[4] = {a->xy[0], a->xy[0], a->xy[1], a->xy[1]};
  for (size_t k = 0; k < 2 * a->offset[a->rings]; k++) {
    double *side = &box[2 * (k & 1)];
    if (a->xy[k] < side[0]) side[0] = a->xy[k];
    if (a->xy[k] > side[1]) side[1] = a->xy[k];
  }
  if (dyd_rect_set_d(&s->window, box[0], box[1], box[2], box[3]) != DYD_OK) return cli_complain_memory();
  s->view = &s->window;
  return 0;
}

static int voronoi_begin(cli_session *s) {
  s->diagram = &((voronoi_result *)s->state)->diagram;
  dyd_voronoi_bounds_init(&s->diagram->bounds);
  s->o.engine.goal = cli_voronoi_goal(s->o.engine.goal);
  s->o.engine.window = &s->window;
  s->share = 0.75; /* the cells get some of the time, too */
  if (!(s->o.max_arc > 0)) return s->o.clip_to ? voronoi_read_area(s) : 0;
  return cli_usage("--max-arc is about the globe; give --sphere or remove it");
}

/* Sets the default window, which needs to know where the points are: after a first stage if the goal is about it, else
 * after the run. false after a message. */
static bool voronoi_window(int *status, cli_session *s) {
  dyd_engine_options first = s->o.engine;
  if (first.goal != DYD_GOAL_DECIDED) first.max_stages = 1;
  first.goal = DYD_GOAL_DECIDED;
  *status = cli_session_run(s, &first, cli_run_engine);
  const dyd_delaunay *pd = dyd_engine_delaunay(s->engine);
  if (!pd || dyd_voronoi_window(&s->window, dyd_delaunay_sites(pd)) == DYD_OK) return true;
  cli_complain("the points span more than doubles hold; give --window XLO,XHI,YLO,YHI");
  return false;
}

static int voronoi_find(cli_session *s) {
  int status = 0;
  bool more = s->view || s->o.engine.goal != DYD_GOAL_DECIDED;
  if (!s->view && !voronoi_window(&status, s)) return status ? status : CLI_FAILED;
  more = more && !status && (s->view || cli_run_was_whole(s->engine));
  if (more) status = cli_session_run(s, &s->o.engine, cli_run_engine);
  const dyd_delaunay *pd = dyd_engine_delaunay(s->engine);
  s->known = pd && !dyd_delaunay_is_capped(pd);
  if (pd && !s->known)
    cli_complain("neighbours are missing, so no diagram is written: %s", cli_outcome_advice(s->engine));
  else if (!pd && !status)
    cli_session_lacks(s, s->outcome, "the first triangulation was complete");
  return s->known && !status && s->o.discs ? find_discs(s) : status;
}

static dyd_status voronoi_write(FILE *out, const cli_session *s, dyd_error *err) {
  cli_diagram *r = s->diagram;
  dyd_write_options how = cli_write_options(out, s);
  how.flatten_bits = s->o.flatten_bits;
  how.flatten_set = s->o.flatten_set;
  how.window = s->o.engine.window;
  how.bounds = &r->bounds;
  how.cancel = cli_deadline_flag();
  how.clip = s->o.clip;
  if (s->o.clip_to && s->o.content == DYD_CONTENT_TILES) how.clip_to = &r->clip_to;
  how.cut = &r->cut;
  how.coincident = &r->coincident;
  return cli_write(out, s, &how, err);
}

static int voronoi_summary(cli_session *s, int status) {
  const cli_diagram *r = s->diagram;
  if (s->known && (!s->written || s->written == CLI_BUDGET)) {
    s->bounds = &r->bounds;
    if (s->o.clip_to) cli_note_area(s->engine, &s->o, &s->window);
    if (r->cut)
      cli_note(&s->o,
               "budget: time limit reached: %zu cells or regions are not worked out, and the whole window takes their "
               "place (raise --timeout)",
               r->cut);
    if (r->coincident)
      cli_note(&s->o,
               "%zu points have the place or the centre of an earlier one and no tile of their own (coincident rows: "
               "--layer aliases)",
               r->coincident);
    if (r->cut && !status) status = CLI_BUDGET;
  }
  return s->discs && s->o.engine.goal == DYD_GOAL_DECIDED ? disc_pairs_summary(s, status)
                                                          : cli_pairs_summary(s, status);
}

static void voronoi_end(cli_session *s) {
  dyd_area_clear(&s->diagram->clip_to);
  disc_pairs_end(s);
  dyd_voronoi_bounds_clear(&s->diagram->bounds);
}

const cli_work cli_voronoi = {.size = sizeof(voronoi_result),
                              .instead = voronoi_instead,
                              .begin = voronoi_begin,
                              .find = voronoi_find,
                              .write = voronoi_write,
                              .prove = write_certificate,
                              .summary = voronoi_summary,
                              .end = voronoi_end};

/* ---- --sphere: the points of the file are places, their images are run ---- */

void cli_sphere_begin(cli_session *s) {
  s->radius = s->o.read.radius;
  s->resume = s->o.resume;
  s->o.resume = NULL;
  cli_options_degrees(&s->o);
}

int cli_sphere_make(cli_session *s, bool no_images) {
  cli_options *o = &s->o;
  dyd_error err;
  o->read.radius = s->radius;
  o->resume = s->resume;
  const dyd_sphere_options how = {DYD_SIZED(dyd_sphere_options), .radius = o->read.radius,
                                  .radius_unit = o->read.radius_unit, .radius_scale = o->read.radius_scale,
                                  .no_images = no_images};
  dyd_status st = dyd_sphere_new(&s->sphere, s->engine, &how, &err);
  if (st == DYD_OK) return 0;
  cli_complain_of(s->engine, st == DYD_E_ARG ? NULL : o->file, &err);
  return st == DYD_E_ARG ? CLI_USAGE : CLI_FAILED;
}

int cli_sphere_look(cli_session *s) {
  int status = cli_sphere_make(s, false);
  if (status) return status;
  s->places = s->engine;
  s->engine = dyd_sphere_images(s->sphere);
  return s->o.resume ? cli_trace_resume(s) : 0;
}

static int places_on_sphere_begin(cli_session *s) {
  cli_options *o = &s->o;
  const char *what = o->flatten_set ? "--flatten" : o->engine.goal != DYD_GOAL_DECIDED ? "--until" : NULL;
  bool picture = o->format == DYD_FORMAT_SVG || o->format == DYD_FORMAT_PDF || o->format == DYD_FORMAT_PNG;
  if (what)
    cli_complain("%s is about the plane; remove %s or --sphere", what, what);
  else if (o->window && !picture)
    cli_complain("on a sphere --window is the part that a picture shows; give svg, pdf or png, or remove it");
  else {
    cli_sphere_begin(s);
    return 0;
  }
  return CLI_USAGE;
}

static dyd_status sphere_run_images(cli_session *s, const dyd_engine_options *options, dyd_error *err) {
  dyd_outcome outcome;
  return dyd_sphere_run(&outcome, s->sphere, options, err);
}

static int sphere_find(cli_session *s) {
  dyd_engine_options run = s->o.engine;
  int status = cli_sphere_look(s);
  if (!s->o.start_set) run.start_bits = 0;
  if (!status) status = cli_session_run(s, &run, sphere_run_images);
  s->known = s->places && dyd_engine_delaunay(s->engine);
  return status || s->known ? status : cli_session_stopped(s, "the triangulation was");
}

static dyd_status sphere_write(FILE *out, const cli_session *s, dyd_error *err) {
  dyd_write_options how = cli_write_options(out, s);
  how.max_arc = s->o.max_arc;
  return cli_write(out, s, &how, err);
}

static dyd_status sphere_prove(FILE *out, const cli_session *s, dyd_error *err) {
  const dyd_certificate_parts parts = {DYD_SIZED(dyd_certificate_parts), .sphere = s->sphere};
  if (strcmp(s->o.command, "voronoi") == 0)
    cli_note(&s->o, "the certificate states the pairs of neighbours on the sphere, not the cells");
  return dyd_write_certificate(out, NULL, &parts, err);
}

int cli_sphere_summary(cli_session *s, int status) {
  const dyd_sphere *sphere = s->sphere;
  dyd_pair_list pairs = {0};
  size_t count[4];
  if (!s->known) return status;
  cli_session_stats(s, sphere);
  dyd_outcome outcome = dyd_sphere_outcome(sphere);
  if (status || outcome == DYD_OUTCOME_DECIDED) return status;
  if (dyd_sphere_pairs(&pairs, sphere) != DYD_OK) return cli_complain_memory();
  count_pairs(count, &pairs);
  dyd_pair_list_clear(&pairs);
  cli_note_unlisted(s);
  if (!s->o.quiet) cli_note_pairs(s, outcome, count, NULL);
  cli_note_spacing(s, dyd_engine_delaunay(s->engine));
  return cli_exit_status(outcome);
}

const cli_work cli_sphere = {.begin = places_on_sphere_begin,
                             .find = sphere_find,
                             .write = sphere_write,
                             .prove = sphere_prove,
                             .summary = cli_sphere_summary};
