/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* dyadel disc, bisector and nearest: questions about a few points or places, put to the engine. */
#include "cli.h"

#include <stdlib.h>
#include <string.h>

/* ---- pieces: the common part of disc and bisector ---- */

enum { FIRST_BITS = 64 };

/* The piece is made of the first `first` points; rect[i] is &own[i], i < count. */
typedef struct cli_pieces {
  bool (*answered)(const struct cli_pieces *p);         /* everything is known */
  bool (*wanted)(const struct cli_pieces *p, size_t i); /* knowing more about point i helps */
  dyd_rect *own;
  const dyd_rect **rect;
  size_t count, first;
  int64_t bits; /* the precision worked towards */
  bool rest;    /* points `first` and on are next at this precision */
} cli_pieces;

static bool pieces_are_known(const cli_pieces *p, const dyd_engine *e) {
  for (size_t i = 0; i < p->count; i++)
    if (!dyd_engine_knows(e, (uint32_t)i)) return false;
  return true;
}

/* At each precision the points that make the piece come first, then, as far as they are known, the others that are
 * wanted. If one group wants nothing, the other one has its turn. */
static dyd_status pieces_want(dyd_wants *wants, cli_pieces *p) {
  dyd_status st = DYD_OK;
  for (int turn = 0; turn < 2 && st == DYD_OK && !dyd_wants_count(wants); turn++) {
    size_t end = p->rest ? p->count : p->first;
    if (!p->rest) p->bits *= 2;
    for (size_t i = p->rest ? p->first : 0; st == DYD_OK && i < end; i++)
      if (!p->wanted || p->wanted(p, i)) st = dyd_wants_add(wants, (uint32_t)i, p->bits);
    p->rest = !p->rest;
  }
  return st;
}

/* Before all points have a rectangle nothing can be said. */
static dyd_status pieces_ask(bool *answered, dyd_wants *wants, void *user, const dyd_engine *e, dyd_error *err) {
  cli_pieces *p = user;
  dyd_status st = DYD_OK;
  (void)err;
  if (!pieces_are_known(p, e)) {
    for (size_t i = 0; st == DYD_OK && i < p->count; i++) st = dyd_wants_add(wants, (uint32_t)i, p->bits);
    return st;
  }
  for (size_t i = 0; st == DYD_OK && i < p->count; i++) st = dyd_sites_get(&p->own[i], dyd_engine_sites(e), i);
  *answered = st == DYD_OK && p->answered(p);
  return st == DYD_OK && !*answered ? pieces_want(wants, p) : st;
}

/* Doubles the precision of the points that are wanted until the question is answered, they are final, the budget is
 * spent, or a signal asks to stop. */
static dyd_status pieces_refine(cli_session *s, const dyd_engine_options *options, dyd_error *err) {
  const dyd_question question = {DYD_SIZED(dyd_question), .ask = pieces_ask, .user = s->state};
  cli_progress_phase(s->progress, "refining");
  return dyd_engine_ask(&s->outcome, s->engine, &question, options, err);
}

/* The same stage by stage, to the goal and by the steps that were given. */
static dyd_status pieces_converge(cli_session *s, const dyd_engine_options *options, dyd_error *err) {
  cli_pieces *p = s->state;
  dyd_convergence table = {DYD_SIZED(dyd_convergence)};
  const dyd_converge_options how = {DYD_SIZED(dyd_converge_options), .window = s->view,
                                    .of = p->first == 2 ? DYD_CONVERGE_BISECTOR : DYD_CONVERGE_DISC};
  cli_progress_phase(s->progress, "refining");
  dyd_status st = dyd_converge_run(&table, s->engine, options, &how, err);
  s->outcome = table.outcome;
  for (size_t i = 0; st == DYD_OK && i < p->count; i++) st = dyd_sites_get(&p->own[i], dyd_engine_sites(s->engine), i);
  dyd_convergence_clear(&table);
  return st;
}

/* Makes space for `count` rectangles. */
static bool pieces_reserve(cli_pieces *p, size_t count) {
  p->own = calloc(count, sizeof *p->own);
  p->rect = calloc(count, sizeof *p->rect);
  if (!p->own || !p->rect) return false;
  for (; p->count < count; p->count++) {
    dyd_rect_init(&p->own[p->count]);
    p->rect[p->count] = &p->own[p->count];
  }
  return true;
}

bool cli_has_points(const cli_session *s, size_t least) {
  size_t count = dyd_engine_count(s->engine);
  if (count >= least) return true;
  cli_complain("%s: %zu points are needed, here are %zu; give more", s->o.file ? s->o.file : "the oracle", least,
               count);
  return false;
}

/* Of the first `least` points, and of others up to `most`. */
static int pieces_find(cli_session *s, size_t least, size_t most) {
  cli_pieces *p = s->state;
  size_t count = dyd_engine_count(s->engine);
  if (!cli_has_points(s, least)) return CLI_FAILED;
  p->first = least;
  p->bits = FIRST_BITS;
  if (!pieces_reserve(p, count < most ? count : most)) return cli_complain_memory();
  const bool staged = s->o.start_set || s->o.engine.step_bits || s->o.engine.goal != DYD_GOAL_DECIDED;
  int status = cli_session_run(s, &s->o.engine, staged ? pieces_converge : pieces_refine);
  s->known = !status && pieces_are_known(p, s->engine);
  if (!status && !s->known) cli_session_lacks(s, s->outcome, "the points were known");
  return status;
}

static dyd_status pieces_write(FILE *out, const cli_session *s, dyd_error *err) {
  const cli_pieces *p = s->state;
  dyd_write_options how = cli_write_options(out, s);
  how.rect = p->rect;
  how.rects = p->count;
  return cli_write(out, s, &how, err);
}

int cli_pieces_outcome(const cli_session *s) {
  if (s->known && s->outcome == DYD_OUTCOME_CANCELLED)
    cli_note(&s->o, "cancelled: stopped on request; the result is partial");
  if (s->known && s->outcome == DYD_OUTCOME_FIXPOINT)
    cli_note(&s->o, "fixpoint: only better measurements can decide more, and nothing decides ties");
  if (s->known && s->outcome == DYD_OUTCOME_BUDGET)
    cli_note(&s->o, "budget: limit of precision or time reached (raise --max-bits or --timeout, unless the points "
                    "are tied)");
  return cli_exit_status(s->outcome);
}

static int pieces_summary(cli_session *s, int status) {
  return status ? status : cli_pieces_outcome(s);
}

static void pieces_end(cli_session *s) {
  cli_pieces *p = s->state;
  for (size_t i = p->count; i-- > 0;) dyd_rect_clear(&p->own[i]);
  free(p->rect);
  free(p->own);
}

/* ---- bisector FILE: the partial bisector of the first two points, narrowed until their rectangles are disjoint ----
 */

static bool bisector_is_answered(const cli_pieces *p) {
  return !dyd_rect_meets(p->rect[0], p->rect[1]);
}

static int bisector_find(cli_session *s) {
  ((cli_pieces *)s->state)->answered = bisector_is_answered;
  return pieces_find(s, 2, 2);
}

const cli_work cli_bisector = {.size = sizeof(cli_pieces),
                               .find = bisector_find,
                               .write = pieces_write,
                               .summary = pieces_summary,
                               .end = pieces_end};

/* ---- disc FILE: the partial disc of the first three points and where the others are, narrowed until that is certain
 * ---- */

enum { TRIPLE = 3 };

static bool disc_is_oriented(const cli_pieces *p) {
  return dyd_orientation(p->rect[0], p->rect[1], p->rect[2]) != DYD_UNSURE;
}

static bool disc_knows(const cli_pieces *p, size_t i) {
  return dyd_con(p->rect[i], p->rect[0], p->rect[1], p->rect[2]) != DYD_UNSURE;
}

static bool disc_is_answered(const cli_pieces *p) {
  size_t i = disc_is_oriented(p) ? TRIPLE : 0;
  while (i >= TRIPLE && i < p->count && disc_knows(p, i)) i++;
  return i == p->count;
}

/* While the orientation is undecided, narrowing the other points has no effect. */
static bool disc_wants(const cli_pieces *p, size_t i) {
  return i < TRIPLE || (disc_is_oriented(p) && !disc_knows(p, i));
}

static int disc_find(cli_session *s) {
  cli_pieces *p = s->state;
  p->answered = disc_is_answered;
  p->wanted = disc_wants;
  return pieces_find(s, TRIPLE, SIZE_MAX);
}

const cli_work cli_disc = {
    .size = sizeof(cli_pieces), .find = disc_find, .write = pieces_write, .summary = pieces_summary, .end = pieces_end};

/* ---- nearest FILE X Y, nearest --queries PLACES FILE: which points are certainly, which are possibly nearest to a
 * place, or to each of many ---- */

/* A place and its answer. */
typedef struct queried_place {
  dyd_stream *at;
  dyd_nearest_answer answer;
  dyd_index_list found;
  size_t row; /* of its file */
  char *id;   /* NULL: it has none */
} queried_place;

typedef struct place_query {
  queried_place *place;
  size_t count, answered; /* places; those of the first that are answered */
  dyd_outcome outcome;    /* of all */
} place_query;

static int read_real(dyd_real **out, const char *name, const char *text) {
  dyd_error err;
  memset(&err, 0, sizeof err);
  dyd_status st = dyd_real_parse(out, text, strlen(text), &err);
  if (st >= 0) return 0;
  if (st == DYD_E_NOMEM) return cli_complain_memory();
  return cli_usage("%s \"%s\", column %zu: %s", name, text, err.column, err.message);
}

static int read_place(dyd_stream **out, const cli_options *o) {
  dyd_real *x = NULL, *y = NULL;
  int status = read_real(&x, "X", o->at[0]);
  if (!status) status = read_real(&y, "Y", o->at[1]);
  if (!status) return dyd_stream_from_reals(out, x, y) == DYD_OK ? 0 : cli_complain_memory();
  dyd_real_free(x);
  return status;
}

static int places_reserve(place_query *q, size_t count) {
  q->place = calloc(count ? count : 1, sizeof *q->place);
  if (!q->place) return cli_complain_memory();
  q->count = count;
  return 0;
}

/* The points of the file become places: streams that stay when their engine goes. */
static int places_read_file(place_query *q, dyd_engine *from, const cli_options *o) {
  int status = cli_places_read(from, o);
  if (!status) status = places_reserve(q, dyd_engine_count(from));
  for (size_t k = 0; k < q->count && !status; k++)
    if (dyd_engine_stream(&q->place[k].at, from, (uint32_t)k) != DYD_OK) status = cli_complain_memory();
  for (size_t k = 0; k < q->count && !status; k++) {
    const char *id = dyd_engine_id(from, k);
    q->place[k].row = dyd_engine_row(from, k);
    q->place[k].id = id ? strdup(id) : NULL;
    if (id && !q->place[k].id) status = cli_complain_memory();
  }
  return status;
}

static int places_read(cli_session *s) {
  const cli_options *o = &s->o;
  if (o->sphere && o->format != DYD_FORMAT_CSV && o->format != DYD_FORMAT_JSON)
    return cli_usage("on a sphere nearest writes csv and json; remove --format %s or --sphere",
                     dyd_format_get(o->format)->name);
  if (o->sphere) cli_sphere_begin(s);
  place_query *q = s->state;
  dyd_engine *from = NULL;
  if (!o->queries && (o->query_columns || o->query_id))
    return cli_usage("--%s is about a file of places; give --queries FILE", o->query_id ? "query-id" : "query-columns");
  if (!o->queries) {
    int status = places_reserve(q, 1);
    return status ? status : read_place(&q->place[0].at, o);
  }
  if (o->file && strcmp(o->file, "-") == 0 && strcmp(o->queries, "-") == 0)
    return cli_usage("points and places cannot both come from standard input; give the name of a file for one of them");
  int status = dyd_engine_new(&from) == DYD_OK ? places_read_file(q, from, o) : cli_complain_memory();
  dyd_engine_free(from);
  return status;
}

static void places_end(cli_session *s) {
  place_query *q = s->state;
  for (size_t k = 0; k < q->count; k++) {
    dyd_index_list_clear(&q->place[k].found);
    dyd_stream_free(q->place[k].at);
    free(q->place[k].id);
  }
  free(q->place);
}

/* The outcome of all is the one that leaves most to be done. */
static dyd_outcome worse_outcome(dyd_outcome a, dyd_outcome b) {
  return a > b ? a : b;
}

/* An error at a place names it. */
static dyd_status name_place(dyd_status st, size_t k, const cli_session *s, dyd_error *err) {
  char message[sizeof err->message];
  if (st == DYD_OK || !s->o.queries || err->point < dyd_engine_count(s->engine)) return st;
  snprintf(message, sizeof message, "%s", err->message);
  err->point = DYD_NO_POINT;
  snprintf(err->message, sizeof err->message, "place %zu of %s: %.180s", ((place_query *)s->state)->place[k].row,
           s->o.queries, message);
  return st;
}

static dyd_status answer_place(cli_session *s, size_t k, const dyd_engine_options *o, dyd_error *err) {
  place_query *q = s->state;
  queried_place *p = &q->place[k];
  dyd_outcome outcome;
  bool sure, tied = false;
  dyd_status st = s->sphere ? dyd_sphere_nearest(&p->found, &sure, &tied, &outcome, s->sphere, p->at, o, err)
                            : dyd_engine_nearest(&p->found, &sure, &outcome, s->engine, p->at, o, err);
  if (!s->sphere) tied = dyd_engine_nearest_tied(s->engine);
  if (st == DYD_OK && s->o.discs) {
    st = dyd_disc_nearest(&p->found, &sure, dyd_engine_sites(s->engine), dyd_stream_rect(p->at), err);
    if (sure && outcome == DYD_OUTCOME_FIXPOINT) outcome = DYD_OUTCOME_DECIDED;
  }
  if (st != DYD_OK) return name_place(st, k, s, err);
  p->answer = (dyd_nearest_answer){DYD_SIZED(dyd_nearest_answer),
                                   dyd_stream_rect(p->at),
                                   &p->found,
                                   sure,
                                   outcome,
                                   tied,
                                   s->o.discs,
                                   true,
                                   p->row,
                                   p->id};
  q->answered++;
  q->outcome = worse_outcome(q->outcome, outcome);
  return DYD_OK;
}

/* In the plane the first triangulation serves as an index; the queries refine the points that they need. The first
 * place is always looked up, also when no time is left or a signal asked to stop. */
static dyd_status answer_places(cli_session *s, const dyd_engine_options *options, dyd_error *err) {
  place_query *q = s->state;
  dyd_engine_options o = *options;
  const double end = cli_clock() + s->o.engine.seconds;
  o.max_stages = 1;
  dyd_outcome first = DYD_OUTCOME_DECIDED;
  dyd_status st = s->sphere ? DYD_OK : dyd_engine_run(&first, s->engine, &o, err);
  bool begun = st == DYD_OK && (s->sphere || dyd_engine_delaunay(s->engine));
  q->outcome = begun ? DYD_OUTCOME_DECIDED : first;
  if (q->outcome != DYD_OUTCOME_DECIDED) return st;
  if (first == DYD_OUTCOME_CANCELLED) dyd_engine_cancel(s->engine);
  for (size_t k = 0; k < q->count && st == DYD_OK; k++) {
    double left = end - cli_clock();
    if (o.seconds > 0) o.seconds = left > 1e-3 ? left : 1e-3;
    st = answer_place(s, k, &o, err);
    if (q->outcome == DYD_OUTCOME_CANCELLED) break;
    if (o.seconds > 0 && left <= 0 && q->answered < q->count) {
      q->outcome = DYD_OUTCOME_BUDGET;
      break;
    }
  }
  s->outcome = q->outcome;
  return st;
}

static int nearest_find(cli_session *s) {
  place_query *q = s->state;
  int status = s->o.sphere ? cli_sphere_make(s, true) : 0;
  if (!status && s->sphere && s->o.resume) status = cli_trace_resume(s);
  if (!status) status = cli_session_run(s, &s->o.engine, answer_places);
  s->known = !status && (q->answered || !q->count);
  if (!status && !s->known) cli_session_lacks(s, q->outcome, "the points were known");
  if (!q->answered) s->o.certificate = NULL;
  return status;
}

/* ---- output ---- */

static const dyd_nearest_answer **list_answers(const place_query *q) {
  const dyd_nearest_answer **list = malloc((q->answered + 1) * sizeof(const dyd_nearest_answer *));
  for (size_t k = 0; list && k < q->answered; k++) list[k] = &q->place[k].answer;
  return list;
}

static dyd_status places_write(FILE *out, const cli_session *s, dyd_error *err) {
  const place_query *q = s->state;
  const dyd_nearest_answer **list = list_answers(q);
  if (!list) return DYD_E_NOMEM;
  dyd_write_options how = cli_write_options(out, s);
  how.answer = list;
  how.answers = q->answered;
  how.outcome = q->outcome;
  dyd_status st = cli_write(out, s, &how, err);
  free(list);
  return st;
}

static dyd_status places_prove(FILE *out, const cli_session *s, dyd_error *err) {
  const place_query *q = s->state;
  const dyd_nearest_answer **list = list_answers(q);
  if (!list) return DYD_E_NOMEM;
  const dyd_certificate_parts parts = {DYD_SIZED(dyd_certificate_parts), .answer = list, .answers = q->answered,
                                       .sphere = s->sphere, .outcome = q->outcome};
  dyd_status st = dyd_write_certificate(out, s->engine, &parts, err);
  free(list);
  return st;
}

static const char *nearest_reason(dyd_outcome outcome) {
  if (outcome == DYD_OUTCOME_FIXPOINT) return "no refinement can decide: ties or fixed rectangles";
  if (outcome == DYD_OUTCOME_BUDGET)
    return "limit of precision or time reached (raise --max-bits or --timeout, unless the distances are equal)";
  return "stopped on request";
}

static void note_places(const cli_session *s) {
  const place_query *q = s->state;
  size_t open = 0;
  const char *outcome = dyd_outcome_text(q->outcome), *why = nearest_reason(q->outcome);
  if (!s->o.queries && q->place[0].answer.tied) why = "no refinement can decide: they are equally far, a tie";
  for (size_t k = 0; k < q->answered; k++) open += !q->place[k].answer.sure;
  if (!s->o.queries)
    cli_note(&s->o, "%s: %zu possibly nearest; %s", outcome, q->place[0].found.count, why);
  else if (q->answered < q->count)
    cli_note(&s->o,
             "%s: only the first %zu of %zu places are answered, %zu of them without a certain nearest point; %s",
             outcome, q->answered, q->count, open, why);
  else
    cli_note(&s->o, "%s: %zu of %zu places have no certain nearest point; %s", outcome, open, q->count, why);
}

static int nearest_summary(cli_session *s, int status) {
  const place_query *q = s->state;
  if (status) return status;
  if (q->answered && q->outcome != DYD_OUTCOME_DECIDED) note_places(s);
  return cli_exit_status(q->outcome);
}

const cli_work cli_nearest = {.size = sizeof(place_query),
                              .begin = places_read,
                              .find = nearest_find,
                              .write = places_write,
                              .prove = places_prove,
                              .summary = nearest_summary,
                              .end = places_end};
