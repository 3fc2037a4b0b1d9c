/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* One program of an oracle: its queue of requests, and what is read from and written to it without waiting.
 *
 * Memory is bounded whatever the program writes: a line of DYD_ORACLE_LINE bytes, DYD_ORACLE_HELD bytes of answers and
 * one more line. Reading stops when that much is held; since answers come in order, nothing is held while the first
 * request is unanswered, so the answer waited for is always read. A line that nothing was asked for is a failure, so
 * endless lines end at the second. */
#include "stream/oracle_worker.h"

#include "base/alloc.h"
#include "base/error.h"
#include "base/invariant.h"
#include <errno.h>
#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#define READ_SIZE ((size_t)1 << 16)
/* How long a program that closed its output is given to end, so that the message can tell how. */
#define END_SECONDS 0.5

void dyd_worker_init(dyd_worker *w, unsigned batch) {
  *w = (dyd_worker){.process = {.in = -1, .out = -1}, .batch = batch};
}

void dyd_worker_clear(dyd_worker *w) {
  dyd_process_end(&w->process);
  for (size_t k = w->head; k < w->count; k++) free(w->asked[k].answer);
  free(w->asked);
  free(w->line);
  free(w->text);
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

void dyd_worker_fail(dyd_worker *w, dyd_status code, const char *format, ...) {
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
static bool queue_is_valid(const dyd_worker *w) {
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

static bool push_asked(dyd_worker *w, dyd_asked a) {
  if (!dyd_reserve((void **)&w->asked, &w->cap, w->count + 1, sizeof *w->asked)) return false;
  w->asked[w->count++] = a;
  return true;
}

bool dyd_worker_ask(dyd_worker *w, size_t point, int64_t bits) {
  return push_asked(w, (dyd_asked){.point = point, .bits = bits, .wanted = true});
}

bool dyd_worker_expect_count(dyd_worker *w) {
  if (!push_asked(w, (dyd_asked){.point = DYD_NO_POINT, .wanted = true})) return false;
  w->sent = w->count;
  return true;
}

void dyd_worker_drop(dyd_worker *w) {
  dyd_asked *a = &w->asked[w->head++];
  if (a->answer) w->held -= a->length;
  free(a->answer);
}

void dyd_worker_forget(dyd_worker *w) {
  while (w->head < w->answered) dyd_worker_drop(w);
  for (size_t k = w->answered; k < w->sent; k++) w->asked[k].wanted = false;
  size_t left = w->sent - w->head;
  if (left) memmove(w->asked, w->asked + w->head, left * sizeof *w->asked);
  w->head = w->answered = 0;
  w->sent = w->count = left;
  DYD_INVARIANT(queue_is_valid(w));
}

/* Requests that are not wanted any more come first, and are not sent again. */
void dyd_worker_adopt(dyd_worker *w, dyd_worker *old) {
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
  free(old->line);
  free(old->text);
  DYD_INVARIANT(queue_is_valid(w));
}

dyd_asked *dyd_worker_first(dyd_worker *w) {
  for (size_t k = w->head; k < w->count; k++)
    if (w->asked[k].wanted) return &w->asked[k];
  return NULL;
}

bool dyd_worker_is_answered(dyd_worker *w) {
  while (w->head < w->answered && !w->asked[w->head].wanted) dyd_worker_drop(w);
  return w->head < w->answered;
}

bool dyd_worker_is_lost(dyd_worker *w) {
  if (!w->failed && w->deaf && w->answered == w->sent) {
    char how[100];
    if (dyd_process_ended(how, sizeof how, &w->process, END_SECONDS))
      dyd_worker_fail(w, DYD_E_STREAM, "%s; it must go on answering until its input ends", how);
    else
      dyd_worker_fail(w, DYD_E_STREAM, "it has closed its standard input; it must go on reading requests");
  }
  return w->failed;
}

/* ---- writing ---- */

static bool put_request(dyd_worker *w, const dyd_asked *a) {
  enum { MOST = 64 };
  if (!dyd_reserve((void **)&w->text, &w->text_cap, w->text_length + MOST, 1)) return false;
  int n = snprintf(w->text + w->text_length, MOST, "refine %zu %" PRId64 "\n", a->point, a->bits);
  w->text_length += (size_t)n;
  return true;
}

void dyd_worker_fill(dyd_worker *w) {
  if (w->failed || w->deaf || w->sent == w->count || w->sent - w->answered > w->batch / 2) return;
  if (w->answered == w->sent) dyd_worker_hear(w); /* what was written unasked is no answer to this */
  while (!w->failed && w->sent < w->count && w->sent - w->answered < w->batch) {
    if (put_request(w, &w->asked[w->sent]))
      w->sent++;
    else
      dyd_worker_fail(w, DYD_E_NOMEM, "%s", dyd_status_text(DYD_E_NOMEM));
  }
}

bool dyd_worker_writes(const dyd_worker *w) {
  return !w->failed && !w->deaf && w->text_done < w->text_length;
}

/* The requests that did not get through count as not sent. */
static void become_deaf(dyd_worker *w) {
  for (size_t k = w->text_done; k < w->text_length; k++)
    if (w->text[k] == '\n') w->sent--;
  w->text_done = w->text_length = 0;
  w->deaf = true;
}

void dyd_worker_tell(dyd_worker *w) {
  size_t done;
  if (!dyd_worker_writes(w)) return;
  dyd_written how = dyd_process_write(&done, &w->process, w->text + w->text_done, w->text_length - w->text_done);
  w->text_done += done;
  if (w->text_done == w->text_length) w->text_done = w->text_length = 0;
  if (how == DYD_WRITE_BROKEN) become_deaf(w);
}

/* ---- reading ---- */

bool dyd_worker_reads(const dyd_worker *w) {
  return !w->failed && w->held <= DYD_ORACLE_HELD;
}

/* Does the line begin with the number of this point, as a word? */
static bool names_point(const char *line, size_t length, size_t point) {
  char number[32];
  size_t n = (size_t)snprintf(number, sizeof number, "%zu", point);
  return length > n && memcmp(line, number, n) == 0 && (line[n] == ' ' || line[n] == '\t');
}

static void take_answer(dyd_worker *w, const char *line, size_t length) {
  dyd_asked *a = &w->asked[w->answered];
  char shown[80];
  if (a->point != DYD_NO_POINT && !names_point(line, length, a->point)) {
    dyd_worker_fail(w, DYD_E_STREAM, "it wrote %s, which is no answer for point %zu",
                    dyd_quoted(shown, sizeof shown, line, length), a->point);
    return;
  }
  if (a->wanted) {
    a->answer = dyd_alloc(length + 1, 1);
    if (!a->answer) {
      dyd_worker_fail(w, DYD_E_NOMEM, "%s", dyd_status_text(DYD_E_NOMEM));
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

static void take_answer_line(dyd_worker *w, const char *line, size_t length) {
  char shown[80];
  if (length && line[length - 1] == '\r') length--;
  if (w->answered == w->sent)
    dyd_worker_fail(w, DYD_E_STREAM, "it wrote %s when nothing was asked; one line is the answer to each request",
                    dyd_quoted(shown, sizeof shown, line, length));
  else
    take_answer(w, line, length);
}

/* Takes all whole lines out of the buffer. */
static void take_answer_lines(dyd_worker *w) {
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
    dyd_worker_fail(w, DYD_E_STREAM, "it wrote a line of more than %zu bytes; an answer is one line of five words",
                    DYD_ORACLE_LINE);
  DYD_INVARIANT(queue_is_valid(w));
}

static void hear_end(dyd_worker *w) {
  char how[100];
  if (w->line_length)
    dyd_worker_fail(w, DYD_E_STREAM,
                    "its output ended in the middle of a line; end each line, and answer until the "
                    "input ends");
  else if (dyd_process_ended(how, sizeof how, &w->process, END_SECONDS))
    dyd_worker_fail(w, DYD_E_STREAM, "%s; it must go on answering until its input ends", how);
  else
    dyd_worker_fail(w, DYD_E_STREAM, "it has closed its standard output; it must go on answering until its input ends");
}

void dyd_worker_hear(dyd_worker *w) {
  if (!dyd_worker_reads(w)) return;
  if (!dyd_reserve((void **)&w->line, &w->line_cap, w->line_length + READ_SIZE, 1)) {
    dyd_worker_fail(w, DYD_E_NOMEM, "%s", dyd_status_text(DYD_E_NOMEM));
    return;
  }
  ssize_t n = read(w->process.out, w->line + w->line_length, READ_SIZE);
  if (n > 0) {
    w->line_length += (size_t)n;
    take_answer_lines(w);
  } else if (n == 0) {
    hear_end(w);
  } else if (errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR) {
    dyd_worker_fail(w, DYD_E_STREAM, "its output cannot be read: %s", strerror(errno));
  }
}
