/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Points served by programs of the user: starting them, waiting for them, ending them.
 *
 * One loop (wait_for_answer) does all waiting: it sends every program the requests allowed, reads the output of all of
 * them, and ends when the one request in question is answered, cannot be answered, took too long, or is not wanted any
 * more. Which program is asked what, in which order, does not depend on time [ORA-2]. */
#include "base/abi.h"
#include "base/alloc.h"
#include "base/clock.h"
#include "base/error.h"
#include "base/flag.h"
#include "base/invariant.h"
#include "base/local.h"
#include "rect/rect.h"
#include "stream/number.h"
#include "stream/process.h"
#include "stream/real.h"
#include "stream/stream.h"

#include <dyadel/oracle.h>
#include <dyadel/sites.h>
#include <dyadel/stream.h>
#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <poll.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* What the lines of an oracle program mean.
 *
 * An answer [lo,hi] must lie inside the rectangle K known so far [NEST-1]: that is required of the rational ends. Only
 * then is it rounded outward to dyadics, and cut to K: K contains [lo,hi], so the cut does too, and it lies inside K
 * whatever the two roundings were [ORA-1]. */

/* A word of a line: text[begin, end). */
typedef struct word {
  size_t begin, end;
} word;

static bool answer_is_blank(char c) {
  return c == ' ' || c == '\t';
}

/* *w becomes the first word behind it; false: there is none. */
static bool next_answer_word(word *w, const char *line, size_t length) {
  size_t k = w->end;
  while (k < length && answer_is_blank(line[k])) k++;
  w->begin = k;
  while (k < length && !answer_is_blank(line[k])) k++;
  w->end = k;
  return w->begin < w->end;
}

/* The words of a line; returns their number, at most `most` + 1. */
static size_t split_answer(word *out, size_t most, const char *line, size_t length) {
  size_t n = 0;
  for (word w = {0, 0}; next_answer_word(&w, line, length);) {
    if (n == most) return most + 1;
    out[n++] = w;
  }
  return n;
}

static bool answer_word_is(const char *line, word w, const char *text) {
  return w.end - w.begin == strlen(text) && memcmp(line + w.begin, text, w.end - w.begin) == 0;
}

static dyd_status read_cost(double *out, const char *line, word w, size_t point, dyd_error *err) {
  char shown[80];
  DYD_LOCAL_NUMBERS(mpq, own);
  dyd_status st = dyd_parse_number(own, line + w.begin, w.end - w.begin, DYD_NUMBER_ANY, NULL);
  *out = st == DYD_OK ? mpq_get_d(own) : 0;
  if (st == DYD_E_NOMEM) return dyd_fail_nomem(err);
  if (*out > 0 && isfinite(*out)) return DYD_OK;
  return dyd_fail(err, DYD_E_STREAM,
                  "the first line of the oracle program: the cost of point %zu, %s, is no exact number above 0; print "
                  "one such as 2 or 0.5",
                  point, dyd_quoted(shown, sizeof shown, line + w.begin, w.end - w.begin));
}

/* Those behind w. */
static dyd_status read_costs(double *cost, size_t count, const char *line, size_t length, word w, dyd_error *err) {
  size_t n = 0;
  for (; next_answer_word(&w, line, length); n++) {
    dyd_status st = n < count ? read_cost(&cost[n], line, w, n, err) : DYD_OK;
    if (st != DYD_OK) return st;
  }
  if (n == count) return DYD_OK;
  return dyd_fail(err, DYD_E_STREAM,
                  "the first line of the oracle program has %zu points and %zu costs; print one for each point, or "
                  "\"points %zu\" alone",
                  count, n, count);
}

dyd_status dyd_oracle_read_count(size_t *out, double **cost, const char *line, size_t length, dyd_error *err) {
  word w[3];
  int64_t count;
  size_t words = split_answer(w, 3, line, length);
  char shown[80];
  const bool costs = words > 2 && answer_word_is(line, w[2], "cost");
  if ((words != 2 && !costs) || !answer_word_is(line, w[0], "points") ||
      !dyd_integer_scan(&count, line + w[1].begin, w[1].end - w[1].begin, 0, 0, DYD_MAX_SITES)) {
    return dyd_fail(err, DYD_E_STREAM,
                    "the first line of the oracle program is %s; print \"points N\", with the number "
                    "of points",
                    dyd_quoted(shown, sizeof shown, line, length));
  }
  double *own = costs ? dyd_alloc((size_t)count < length ? (size_t)count : length, sizeof *own) : NULL;
  if (costs && !own) return dyd_fail_nomem(err);
  dyd_status st = costs ? read_costs(own, (size_t)count, line, length, w[2], err) : DYD_OK;
  if (st != DYD_OK) {
    free(own);
    return st;
  }
  *out = (size_t)count;
  *cost = own;
  return DYD_OK;
}

/* ---- answers ---- */

static dyd_status read_answer_end(mpq_t out, const char *line, word w, dyd_error *err) {
  dyd_error own;
  char shown[80];
  dyd_error_clear(&own);
  dyd_status st = dyd_parse_number(out, line + w.begin, w.end - w.begin, DYD_NUMBER_ANY, &own);
  if (st == DYD_OK || st == DYD_E_NOMEM || st == DYD_E_RANGE) {
    return st != DYD_OK ? dyd_fail(err, st, "%s", own.message) : st;
  }
  return dyd_fail(err, DYD_E_STREAM, "%s, column %zu of its answer, is not an exact number: %s",
                  dyd_quoted(shown, sizeof shown, line + w.begin, w.end - w.begin), dyd_text_column(line, w.begin),
                  own.message);
}

/* *side is the known side on entry (if known) and the new side on return. */
static dyd_status set_answer_side(dyd_interval *side, bool known, const char *name, const mpq_t lo, const mpq_t hi,
                                  dyd_error *err) {
  DYD_LOCAL(dyd_interval, next);
  dyd_status st = dyd_interval_set_ends_q(&next, lo, hi);
  if (st != DYD_OK)
    dyd_fail(err, st, "the %s of its answer: %s", name, dyd_status_text(st));
  else if (known && !dyd_interval_contains(side, &next))
    st = dyd_nesting_fail(err, name, side, &next);
  if (st == DYD_OK) dyd_interval_swap(side, &next);
  return st;
}

static dyd_status read_answer_ends(mpq_t end[4], const char *line, const word *w, dyd_error *err) {
  dyd_status st = DYD_OK;
  for (int k = 0; st == DYD_OK && k < 4; k++) st = read_answer_end(end[k], line, w[k], err);
  return st;
}

/* Returns true if no answer was given: r is unset, or the point that dyd_rect_init gives (an exact point is not
 * requested again). */
static bool answer_is_first(const dyd_rect *r) {
  return dyd_rect_is_point(r) || dyd_interval_is_unset(&r->x) || dyd_interval_is_unset(&r->y);
}

/* *r is the known rectangle on entry (if known), on return that of the four ends, which must be in order. */
static dyd_status take_answer_ends(dyd_rect *r, bool known, const mpq_t end[4], dyd_error *err) {
  for (int k = 0; k < 4; k += 2) {
    if (mpq_cmp(end[k], end[k + 1]) <= 0) continue;
    return dyd_fail(err, DYD_E_STREAM,
                    "the lower end of the %c side in its answer is above the upper end; exchange them", k ? 'y' : 'x');
  }
  DYD_LOCAL(dyd_rect, next);
  if (known) dyd_rect_set(&next, r);
  dyd_status st = set_answer_side(&next.x, known, "x side", end[0], end[1], err);
  if (st == DYD_OK) st = set_answer_side(&next.y, known, "y side", end[2], end[3], err);
  if (st == DYD_OK) dyd_rect_swap(r, &next);
  return st;
}

static dyd_status read_answer_rect(dyd_rect *r, bool known, const char *line, const word *w, dyd_error *err) {
  DYD_LOCAL_ARRAY(mpq_t, end, [4]);
  dyd_status st = read_answer_ends(end, line, w, err);
  return st == DYD_OK ? take_answer_ends(r, known, (const mpq_t *)end, err) : st;
}

/* The four ends behind `before` words, and whether they are fixed. */
static dyd_status read_answer(dyd_rect *r, bool known, size_t before, const char *form, const char *line, size_t length,
                              dyd_error *err) {
  word w[6];
  char shown[80];
  size_t words = split_answer(w, before + 5, line, length);
  bool fixed = words == before + 5 && answer_word_is(line, w[before + 4], "fixed");
  if (words != before + 4 && !fixed) {
    return dyd_fail(err, DYD_E_STREAM, "its answer %s has not the %s (and \"fixed\", if it is)",
                    dyd_quoted(shown, sizeof shown, line, length), form);
  }
  dyd_status st = read_answer_rect(r, known, line, w + before, err);
  return st != DYD_OK || !fixed ? st : DYD_FIXED;
}

dyd_status dyd_oracle_read_answer(dyd_rect *r, bool known, const char *line, size_t length, dyd_error *err) {
  return read_answer(r, known, 1, "five words I XLO XHI YLO YHI", line, length, err);
}

dyd_status dyd_rect_narrow_text(dyd_rect *r, const char *text, size_t length, dyd_error *err) {
  return read_answer(r, !answer_is_first(r), 0, "four words XLO XHI YLO YHI", text, length, err);
}

dyd_status dyd_rect_narrow_q(dyd_rect *r, const mpq_t end[4], dyd_error *err) {
  return take_answer_ends(r, !answer_is_first(r), end, err);
}

/* ---- one program of an oracle: its queue of requests, with reads and writes that do not wait ----
 *
 * Memory is bounded whatever the program writes: a line of DYD_ORACLE_LINE bytes, ORACLE_HELD bytes of answers and
 * one more line. Reading stops when that much is held; since answers come in order, nothing is held while the first
 * request is unanswered, so the answer waited for is always read. A line that nothing was asked for is a failure, so
 * endless lines end at the second. */

/* How many bytes of answers wait at most (and one line) before no more are read. */
#define ORACLE_HELD ((size_t)1 << 20)

/* A request and its answer. The line "points N" is the answer to point DYD_NO_POINT. */
typedef struct dyd_asked {
  size_t point;
  int64_t bits;
  char *answer;  /* the whole line without its end, terminated by a NUL byte of ours; NULL: none yet, or not wanted */
  size_t length; /* of the answer */
  bool wanted;
} dyd_asked;

/* A queue of requests, two buffers, and a process.
 * Invariant: head <= answered <= sent <= count; of asked[]: from head on not yet collected, before `answered` answered,
 * before `sent` handed to `text`. held is the sum of the lengths of the answers held. Answers come in order, so those
 * of requests no longer wanted come first. failed: why has the reason, and nothing more is read or written. */
typedef struct worker {
  dyd_process process;
  dyd_asked *asked;
  size_t head, answered, sent, count, cap;
  size_t held;
  char *line; /* bytes read, not yet a whole line; the first `scanned` hold no line end */
  size_t line_length, line_cap, scanned;
  char *text; /* bytes to write, from text_done on */
  size_t text_length, text_done, text_cap;
  unsigned batch;
  bool deaf; /* it has closed its standard input */
  bool failed;
  double heard; /* when the last whole line came */
  dyd_status code;
  char why[DYD_MESSAGE_SIZE / 2];
} worker;

#define READ_SIZE ((size_t)1 << 16)

/* Time for a program that closed its output to end, so that the message can say how it ended. */
#define END_SECONDS 0.5

static void worker_init(worker *w, unsigned batch) {
  *w = (worker){.process = {.in = -1, .out = -1}, .batch = batch};
}

/* Ends the process and releases everything. */
static void worker_clear(worker *w) {
  dyd_process_end(&w->process);
  for (size_t k = w->head; k < w->count; k++) free(w->asked[k].answer);
  dyd_free_all(w->asked, w->line, w->text);
}

/* From now on w has failed; its group is killed. */
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
static void
worker_fail(worker *w, dyd_status code, const char *format, ...) {
  if (w->failed) return;
  va_list args;
  va_start(args, format);
  vsnprintf(w->why, sizeof w->why, format, args);
  va_end(args);
  w->failed = true;
  w->code = code;
  dyd_process_close(&w->process);
  dyd_process_stop(&w->process);
}

/* ---- the queue ---- */

#ifdef DYD_ARMED

static bool queue_is_valid(const worker *w) {
  size_t held = 0;
  bool wanted = false, sorted = true;
  for (size_t k = w->head; k < w->count; k++) {
    held += w->asked[k].answer ? w->asked[k].length : 0;
    if (wanted && !w->asked[k].wanted) sorted = false;
    wanted = w->asked[k].wanted;
  }
  return w->head <= w->answered && w->answered <= w->sent && w->sent <= w->count && held == w->held && sorted;
}

#endif

static bool push_asked(worker *w, dyd_asked a) {
  if (!DYD_GROW(w->asked, w->cap, w->count + 1)) return false;
  w->asked[w->count++] = a;
  return true;
}

/* Appends a request; false: memory is exhausted. */
static bool worker_ask(worker *w, size_t point, int64_t bits) {
  return push_asked(w, (dyd_asked){.point = point, .bits = bits, .wanted = true});
}

/* Appends the request that is answered by the first line of the program, and that is not sent. */
static bool worker_expect_count(worker *w) {
  if (!push_asked(w, (dyd_asked){.point = DYD_NO_POINT, .wanted = true})) return false;
  w->sent = w->count;
  return true;
}

/* Takes the answered request at asked[head] off the queue. */
static void worker_drop(worker *w) {
  dyd_asked *a = &w->asked[w->head++];
  if (a->answer) w->held -= a->length;
  free(a->answer);
}

/* Drops requests not yet sent; answers to the others are not wanted any more. */
static void worker_forget(worker *w) {
  while (w->head < w->answered) worker_drop(w);
  for (size_t k = w->answered; k < w->sent; k++) w->asked[k].wanted = false;
  size_t left = w->sent - w->head;
  if (left) memmove(w->asked, w->asked + w->head, left * sizeof *w->asked);
  w->head = w->answered = 0;
  w->sent = w->count = left;
  DYD_INVARIANT(queue_is_valid(w));
}

/* w, new, takes over the requests of `old`, whose process has ended: answers stay, unanswered requests are to be sent
 * again. Requests that are not wanted any more come first, and are not sent again. `old` is left empty. */
static void worker_adopt(worker *w, worker *old) {
  size_t first = old->answered;
  while (first < old->sent && !old->asked[first].wanted) first++;
  memmove(old->asked + old->answered, old->asked + first, (old->count - first) * sizeof *old->asked);
  for (size_t k = w->head; k < w->count; k++) free(w->asked[k].answer);
  free(w->asked);
  w->asked = old->asked;
  w->cap = old->cap;
  w->held = old->held;
  w->head = old->head;
  w->answered = w->sent = old->answered;
  w->count = old->count - (first - old->answered);
  dyd_free_all(old->line, old->text);
  DYD_INVARIANT(queue_is_valid(w));
}

/* The first request that is wanted, NULL when there is none. */
static dyd_asked *worker_first(worker *w) {
  for (size_t k = w->head; k < w->count; k++)
    if (w->asked[k].wanted) return &w->asked[k];
  return NULL;
}

/* Returns true if the first request that is wanted is answered. Then it is at asked[head]. */
static bool worker_is_answered(worker *w) {
  while (w->head < w->answered && !w->asked[w->head].wanted) worker_drop(w);
  return w->head < w->answered;
}

/* Returns true, with failed set, if the first request can no longer be answered. */
static bool worker_is_lost(worker *w) {
  if (!w->failed && w->deaf && w->answered == w->sent) {
    char how[100];
    if (dyd_process_ended(how, sizeof how, &w->process, END_SECONDS))
      worker_fail(w, DYD_E_STREAM, "%s; it must answer until its input ends", how);
    else
      worker_fail(w, DYD_E_STREAM, "it has closed its standard input; it must read requests until its input ends");
  }
  return w->failed;
}

/* ---- reading ---- */

static bool worker_reads(const worker *w) {
  return !w->failed && w->held <= ORACLE_HELD;
}

/* Returns true if the line begins with the number of this point, as a word. */
static bool names_point(const char *line, size_t length, size_t point) {
  char number[32];
  size_t n = (size_t)snprintf(number, sizeof number, "%zu", point);
  return length > n && memcmp(line, number, n) == 0 && (line[n] == ' ' || line[n] == '\t');
}

static void take_answer(worker *w, const char *line, size_t length) {
  dyd_asked *a = &w->asked[w->answered];
  char shown[80];
  if (a->point != DYD_NO_POINT && !names_point(line, length, a->point)) {
    worker_fail(w, DYD_E_STREAM, "it wrote %s instead of an answer for point %zu",
                dyd_quoted(shown, sizeof shown, line, length), a->point);
    return;
  }
  if (a->wanted) {
    a->answer = dyd_alloc(length + 1, 1);
    if (!a->answer) {
      worker_fail(w, DYD_E_NOMEM, "%s", dyd_status_text(DYD_E_NOMEM));
      return;
    }
    memcpy(a->answer, line, length);
    a->answer[length] = 0;
    a->length = length;
    w->held += length;
  }
  w->answered++;
  w->heard = dyd_seconds();
}

static void take_answer_line(worker *w, const char *line, size_t length) {
  char shown[80];
  if (length && line[length - 1] == '\r') length--;
  if (w->answered == w->sent)
    worker_fail(w, DYD_E_STREAM, "it wrote %s when nothing was asked; one line is the answer to each request",
                dyd_quoted(shown, sizeof shown, line, length));
  else
    take_answer(w, line, length);
}

/* Takes all whole lines out of the buffer. */
static void take_answer_lines(worker *w) {
  size_t begin = 0;
  while (!w->failed) {
    char *end = memchr(w->line + w->scanned, '\n', w->line_length - w->scanned);
    if (!end) break;
    size_t at = (size_t)(end - w->line);
    take_answer_line(w, w->line + begin, at - begin);
    begin = w->scanned = at + 1;
  }
  memmove(w->line, w->line + begin, w->line_length - begin);
  w->line_length -= begin;
  w->scanned = w->line_length;
  if (w->line_length > DYD_ORACLE_LINE)
    worker_fail(w, DYD_E_STREAM, "it wrote a line of more than %zu bytes; an answer is one line of five words",
                DYD_ORACLE_LINE);
  DYD_INVARIANT(queue_is_valid(w));
}

static void hear_end(worker *w) {
  char how[100];
  if (w->line_length)
    worker_fail(w, DYD_E_STREAM,
                "its output ended in the middle of a line; end each line, and answer until the "
                "input ends");
  else if (dyd_process_ended(how, sizeof how, &w->process, END_SECONDS))
    worker_fail(w, DYD_E_STREAM, "%s; it must answer until its input ends", how);
  else
    worker_fail(w, DYD_E_STREAM, "it has closed its standard output; it must answer until its input ends");
}

/* Reads as much as possible without waiting. */
static void worker_hear(worker *w) {
  if (!worker_reads(w)) return;
  if (!dyd_reserve((void **)&w->line, &w->line_cap, w->line_length + READ_SIZE, 1)) {
    worker_fail(w, DYD_E_NOMEM, "%s", dyd_status_text(DYD_E_NOMEM));
    return;
  }
  ssize_t n = read(w->process.out, w->line + w->line_length, READ_SIZE);
  if (n > 0) {
    w->line_length += (size_t)n;
    take_answer_lines(w);
  } else if (n == 0) {
    hear_end(w);
  } else if (errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR) {
    worker_fail(w, DYD_E_STREAM, "its output cannot be read: %s", strerror(errno));
  }
}

/* ---- writing ---- */

static bool put_request(worker *w, const dyd_asked *a) {
  enum { MOST = 64 };
  if (!dyd_reserve((void **)&w->text, &w->text_cap, w->text_length + MOST, 1)) return false;
  int n = snprintf(w->text + w->text_length, MOST, "refine %zu %" PRId64 "\n", a->point, a->bits);
  w->text_length += (size_t)n;
  return true;
}

/* Puts requests into the text to write, as far as the batch allows: again when half of those sent are answered. */
static void worker_fill(worker *w) {
  if (w->failed || w->deaf || w->sent == w->count || w->sent - w->answered > w->batch / 2) return;
  if (w->answered == w->sent) worker_hear(w); /* output before this request does not answer it */
  while (!w->failed && w->sent < w->count && w->sent - w->answered < w->batch) {
    if (put_request(w, &w->asked[w->sent]))
      w->sent++;
    else
      worker_fail(w, DYD_E_NOMEM, "%s", dyd_status_text(DYD_E_NOMEM));
  }
}

static bool worker_writes(const worker *w) {
  return !w->failed && !w->deaf && w->text_done < w->text_length;
}

/* The requests that did not get through count as not sent. */
static void become_deaf(worker *w) {
  for (size_t k = w->text_done; k < w->text_length; k++)
    if (w->text[k] == '\n') w->sent--;
  w->text_done = w->text_length = 0;
  w->deaf = true;
}

static void worker_tell(worker *w) {
  size_t done;
  if (!worker_writes(w)) return;
  dyd_written how = dyd_process_write(&done, &w->process, w->text + w->text_done, w->text_length - w->text_done);
  w->text_done += done;
  if (w->text_done == w->text_length) w->text_done = w->text_length = 0;
  if (how == DYD_WRITE_BROKEN) become_deaf(w);
}

/* ---- all programs ---- */

/* Time for programs to end unforced, or for a replaced one to end by a signal; how often the stop flag is examined. */
#define GRACE_SECONDS 1.0

#define STOP_SECONDS 0.25

#define SLICE_SECONDS 0.05

/* Invariant: lifeline is the pipe the watchers read, both ends of it; worker[0 .. jobs) are initialised; room for two
 * entries of poll per worker. */
typedef struct dyd_oracle {
  char *command;
  pid_t owner;
  worker *worker;
  struct pollfd *poll;
  unsigned jobs, batch, retries;
  double seconds;
  size_t points; /* 0 until the first program has reported */
  double *cost;  /* of each, as it reported; NULL: it did not */
  int lifeline[2];
} dyd_oracle;

/* ---- waiting ---- */

/* Sends and receives as much as possible within the time. */
static void exchange_lines(dyd_oracle *o, double seconds) {
  for (unsigned k = 0; k < o->jobs; k++) {
    worker *w = &o->worker[k];
    worker_fill(w);
    worker_tell(w);
    o->poll[2 * k] = (struct pollfd){.fd = worker_reads(w) ? w->process.out : -1, .events = POLLIN};
    o->poll[2 * k + 1] = (struct pollfd){.fd = worker_writes(w) ? w->process.in : -1, .events = POLLOUT};
  }
  if (poll(o->poll, 2 * (nfds_t)o->jobs, (int)(seconds * 1000 + 0.999)) <= 0) return;
  for (unsigned k = 0; k < o->jobs; k++) {
    if (o->poll[2 * k].revents) worker_hear(&o->worker[k]);
    if (o->poll[2 * k + 1].revents) worker_tell(&o->worker[k]);
  }
}

static void oracle_fail_silent(const dyd_oracle *o, worker *w) {
  char how[100];
  const char *deaf = dyd_process_is_deaf(&w->process) ? " and has closed its standard input" : "";
  if (dyd_process_ended(how, sizeof how, &w->process, 0))
    worker_fail(w, DYD_E_STREAM, "%s, and a process that it started was silent for %g s; answer until the input ends",
                how, o->seconds);
  else
    worker_fail(w, DYD_E_STREAM,
                "it was silent for %g s%s; flush its output after each line, or allow more time (`oracle_timeout`)",
                o->seconds, deaf);
}

/* Waits until the first request of w that is wanted is answered (DYD_OK), w has failed (its code), or *stop is raised
 * (DYD_CANCELLED). The clock starts anew with each line of w, and pending output is read before it is examined. */
static dyd_status wait_for_answer(dyd_oracle *o, worker *w, const volatile int *stop) {
  double begun = dyd_seconds(), left = o->seconds;
  while (!worker_is_answered(w)) {
    if (worker_is_lost(w)) return w->code;
    if (dyd_flag_is_set(stop)) return DYD_CANCELLED;
    exchange_lines(o, left < SLICE_SECONDS ? left : SLICE_SECONDS);
    left = (w->heard > begun ? w->heard : begun) + o->seconds - dyd_seconds();
    if (left > 0) continue;
    if (!w->failed && !worker_is_answered(w)) oracle_fail_silent(o, w);
    left = 0;
  }
  return DYD_OK;
}

/* ---- starting one, and starting it again ---- */

/* Starts the program of w, which is empty, as number k. */
static dyd_status program_begin(dyd_oracle *o, unsigned k, dyd_error *err) {
  worker *w = &o->worker[k];
  worker_init(w, o->batch);
  dyd_status st = dyd_process_start(&w->process, o->command, k, o->lifeline[0], err);
  if (st == DYD_OK && !worker_expect_count(w)) st = dyd_fail_nomem(err);
  return st;
}

/* Reads its first line, which must agree with what the first program said; its costs count where it is the first. */
static dyd_status program_read_count(size_t *count, dyd_oracle *o, unsigned k, const volatile int *stop,
                                     dyd_error *err) {
  worker *w = &o->worker[k];
  dyd_status st = wait_for_answer(o, w, stop);
  if (dyd_failed(st)) {
    return dyd_fail(err, st, "the oracle program was to print \"points N\", with the number of points: %s", w->why);
  }
  if (st != DYD_OK) return st;
  DYD_FREED double *cost = NULL;
  st = dyd_oracle_read_count(count, &cost, w->asked[w->head].answer, w->asked[w->head].length, err);
  worker_drop(w);
  if (!o->points && !o->cost) {
    o->cost = cost;
    cost = NULL;
  }
  if (st != DYD_OK || !o->points || *count == o->points) return st;
  return dyd_fail(err, DYD_E_STREAM, "oracle program 0 has %zu points, program %u has %zu; all must serve the same",
                  o->points, k, *count);
}

/* Starts program k instead of one that failed. Its requests wait until it has reported its count, and are sent again
 * unless they were answered. On failure it has failed again. */
static dyd_status program_restart(dyd_oracle *o, unsigned k, const volatile int *stop) {
  worker *w = &o->worker[k], old = *w;
  char how[100];
  size_t count;
  dyd_error err;
  dyd_error_clear(&err);
  dyd_process_ended(how, sizeof how, &old.process, STOP_SECONDS);
  dyd_process_end(&old.process);
  dyd_status st = program_begin(o, k, &err);
  if (st == DYD_OK) st = program_read_count(&count, o, k, stop, &err);
  if (dyd_failed(st)) worker_fail(w, st, "%s", err.message);
  worker_adopt(w, &old);
  return st;
}

/* As wait_for_answer; a program that fails is started again, as often as one request may. */
static dyd_status wait_retrying(dyd_oracle *o, unsigned k, const volatile int *stop) {
  dyd_status st = wait_for_answer(o, &o->worker[k], stop);
  for (unsigned tries = 0; st == DYD_E_STREAM && tries < o->retries; tries++) {
    st = program_restart(o, k, stop);
    if (st == DYD_OK) st = wait_for_answer(o, &o->worker[k], stop);
  }
  return st;
}

/* ---- the source ---- */

/* Not in a process that was forked since: the pipes are those of its parent. */
static bool oracle_is_ours(const dyd_oracle *o) {
  return o->owner == getpid();
}

static unsigned oracle_job_of(const dyd_oracle *o, size_t point) {
  return (unsigned)(point % o->jobs);
}

/* Requests already sent stay; a list that does not fit into memory is ignored. */
static void oracle_announce(void *user, const dyd_request *request, size_t count) {
  dyd_oracle *o = user;
  if (!oracle_is_ours(o)) return;
  for (unsigned k = 0; k < o->jobs; k++) worker_forget(&o->worker[k]);
  for (size_t k = 0; k < count; k++) {
    const dyd_request *r = dyd_request_at(request, k);
    if (r->point >= o->points) continue;
    if (!worker_ask(&o->worker[oracle_job_of(o, r->point)], r->point, r->bits)) break;
  }
  exchange_lines(o, 0);
}

/* Sees to it that the first request of w that is wanted is this one. */
static bool ask_first(worker *w, const dyd_request *request) {
  const dyd_asked *first = worker_first(w);
  if (first && first->point == request->point && first->bits == request->bits) return true;
  worker_forget(w);
  return worker_ask(w, request->point, request->bits);
}

/* Puts the request in front of the message. */
static dyd_status oracle_fail_request(dyd_error *err, dyd_status st, const dyd_request *request, const char *why) {
  return dyd_fail(err, st, "the oracle program was asked \"refine %zu %" PRId64 "\": %s", request->point, request->bits,
                  why);
}

static dyd_status oracle_narrow(dyd_rect *out, void *user, const dyd_request *request, dyd_error *err) {
  dyd_oracle *o = user;
  dyd_error own;
  if (request->point >= o->points) {
    return dyd_fail(err, DYD_E_ARG, "the oracle program has %zu points only", o->points);
  }
  if (!oracle_is_ours(o))
    return dyd_fail(err, DYD_E_STREAM,
                    "the oracle program belongs to the process that started it; start another one after fork()");
  unsigned job = oracle_job_of(o, request->point);
  worker *w = &o->worker[job];
  if (!ask_first(w, request)) return dyd_fail_nomem(err);
  dyd_status st = wait_retrying(o, job, request->stop);
  if (dyd_failed(st)) return oracle_fail_request(err, st, request, w->why);
  if (st != DYD_OK) return st;
  dyd_error_clear(&own);
  const dyd_asked *a = &w->asked[w->head];
  st = dyd_oracle_read_answer(out, !answer_is_first(out), a->answer, a->length, &own);
  worker_drop(w);
  return dyd_failed(st) ? oracle_fail_request(err, st, request, own.message) : st;
}

/* ---- ending ---- */

/* Waits at most that time in total for programs that are to end. */
static void wait_for_programs(const dyd_oracle *o, double seconds) {
  double until = dyd_seconds() + seconds;
  for (unsigned k = 0; k < o->jobs; k++) {
    char how[100];
    double left = until - dyd_seconds();
    dyd_process_ended(how, sizeof how, &o->worker[k].process, left > 0 ? left : 0);
  }
}

/* Closes all pipes, so that programs that read on can end; busy ones get a signal. */
static void let_programs_end(dyd_oracle *o) {
  for (unsigned k = 0; k < o->jobs; k++) dyd_process_close(&o->worker[k].process);
  wait_for_programs(o, GRACE_SECONDS / 2);
  for (unsigned k = 0; k < o->jobs; k++) dyd_process_stop(&o->worker[k].process);
  wait_for_programs(o, GRACE_SECONDS / 2);
}

static void oracle_release(void *user) {
  dyd_oracle *o = user;
  for (unsigned k = 0; k < o->jobs && !oracle_is_ours(o); k++) dyd_process_disown(&o->worker[k].process);
  let_programs_end(o);
  for (unsigned k = 0; k < o->jobs; k++) worker_clear(&o->worker[k]);
  dyd_close(&o->lifeline[0]);
  dyd_close(&o->lifeline[1]);
  dyd_free_all(o->command, o->cost, o->poll, o->worker, o);
}

/* ---- starting ---- */

/* Starts programs jobs .. want-1, side by side; they count as soon as they run. Each that fails at once is started
 * again, as often as one may. */
static dyd_status start_programs(dyd_oracle *o, unsigned want, const volatile int *stop, dyd_error *err) {
  unsigned first = o->jobs;
  dyd_status st = DYD_OK;
  while (st == DYD_OK && o->jobs < want) st = program_begin(o, o->jobs++, err);
  for (unsigned k = first; st == DYD_OK && k < o->jobs; k++) {
    size_t count = 0;
    st = program_read_count(&count, o, k, stop, err);
    for (unsigned tries = 0; st == DYD_E_STREAM && tries < o->retries; tries++) {
      worker_clear(&o->worker[k]);
      st = program_begin(o, k, err);
      if (st == DYD_OK) st = program_read_count(&count, o, k, stop, err);
    }
    if (st == DYD_OK) o->points = count;
  }
  return st;
}

/* The first program says how many points there are; then the others are started, no more than points, and must say the
 * same. */
static dyd_status start_all_programs(dyd_oracle *o, unsigned jobs, const volatile int *stop, dyd_error *err) {
  if (!dyd_pipe(o->lifeline)) {
    return dyd_fail(err, DYD_E_STREAM, "no pipe for the oracle program: %s; close other files", strerror(errno));
  }
  dyd_status st = start_programs(o, 1, stop, err);
  if (jobs > o->points) jobs = o->points ? (unsigned)o->points : 1;
  return st == DYD_OK ? start_programs(o, jobs, stop, err) : st;
}

/* Room for the programs, none started. NULL: memory is exhausted. */
static dyd_oracle *oracle_new(const char *command, const dyd_oracle_options *options) {
  dyd_oracle *o = dyd_alloc(1, sizeof *o);
  if (!o) return NULL;
  *o = (dyd_oracle){.owner = getpid(),
                    .batch = options->batch,
                    .retries = options->retries,
                    .seconds = options->seconds,
                    .lifeline = {-1, -1}};
  o->command = strdup(command);
  o->worker = dyd_alloc(options->jobs, sizeof *o->worker);
  o->poll = dyd_alloc(2 * (size_t)options->jobs, sizeof *o->poll);
  if (o->command && o->worker && o->poll) return o;
  oracle_release(o);
  return NULL;
}

dyd_status dyd_oracle_source(dyd_source *out, size_t *points, const char *command, const dyd_oracle_options *options,
                             dyd_error *err) {
  dyd_oracle_options given;
  if (err) dyd_error_clear(err);
  if (dyd_abi_take(&given, sizeof given, options, "dyd_oracle_options", err) != DYD_OK ||
      dyd_abi_check(out, offsetof(dyd_source, announce), "dyd_source", err) != DYD_OK)
    return DYD_E_ARG;
  if (given.jobs == 0) given.jobs = 1;
  if (given.batch == 0) given.batch = 1;
  if (given.seconds == 0) given.seconds = DYD_ORACLE_SECONDS;
  if (!command) return dyd_fail_null(err);
  if (given.jobs > DYD_ORACLE_MAX_JOBS || given.batch > DYD_ORACLE_MAX_BATCH)
    return dyd_fail(err, DYD_E_ARG, "`jobs` is above %d or `batch` above %d, which are the most; give less",
                    (int)DYD_ORACLE_MAX_JOBS, (int)DYD_ORACLE_MAX_BATCH);
  if (!(given.seconds > 0))
    return dyd_fail(err, DYD_E_ARG, "`seconds` is below 0 or no number; give a time above 0, or 0 for the default");
  dyd_oracle *o = oracle_new(command, &given);
  if (!o) return dyd_fail_nomem(err);
  dyd_status st = start_all_programs(o, given.jobs, given.stop, err);
  if (st != DYD_OK) {
    oracle_release(o);
    return st;
  }
  const dyd_source source = {
      .narrow = oracle_narrow, .release = oracle_release, .user = o, .announce = oracle_announce, .cost = o->cost};
  dyd_abi_give(out, &source, sizeof source);
  *points = o->points;
  return DYD_OK;
}
