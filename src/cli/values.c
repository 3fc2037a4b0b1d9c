/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The values of options: text to what the table says, or a message with what to give instead. */
#include "table.h"
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool usage(const cli_option *option, const char *value, const char *wanted) {
  cli_complain("--%s \"%s\" is not understood; give %s", option->name, value, wanted);
  return false;
}

static bool scan_integer(long long *out, const char *text, long long least, long long most) {
  char *end;
  errno = 0;
  *out = strtoll(text, &end, 10);
  return end != text && !*end && errno == 0 && *out >= least && *out <= most;
}

static bool read_integer(void *place, const cli_option *option, const char *text) {
  long long value;
  if (!scan_integer(&value, text, option->least, option->most)) {
    char wanted[96];
    snprintf(wanted, sizeof wanted, "a whole number from %lld to %lld", option->least, option->most);
    return usage(option, text, wanted);
  }
  if (option->width == sizeof(unsigned)) {
    *(unsigned *)place = (unsigned)value;
  } else {
    /* int64_t, uint64_t and size_t hold these values the same way. */
    int64_t wide = value;
    memcpy(place, &wide, sizeof wide);
  }
  return true;
}

static bool read_seconds(double *place, const cli_option *option, const char *text) {
  char *end;
  double seconds = strtod(text, &end);
  if (end == text || *end || !isfinite(seconds) || seconds <= 0)
    return usage(option, text, "a number of seconds above 0");
  *place = seconds;
  return true;
}

static bool read_goal(dyd_engine_options *e, const cli_option *option, const char *text) {
  const char *colon = strchr(text, ':');
  size_t length = colon ? (size_t)(colon - text) : strlen(text);
  long long bits = 0;
  e->goal = DYD_GOAL_DECIDED;
  if (!colon && strcmp(text, "decided") == 0) return true;
  if (length == 4 && strncmp(text, "area", 4) == 0) e->goal = DYD_GOAL_AREA;
  if (length == 9 && strncmp(text, "hausdorff", 9) == 0) e->goal = DYD_GOAL_HAUSDORFF;
  if (!colon || e->goal == DYD_GOAL_DECIDED || !scan_integer(&bits, colon + 1, -DYD_EXP_LIMIT, DYD_EXP_LIMIT))
    return usage(option, text, "decided, area:M or hausdorff:M with a whole number M");
  e->goal_bits = bits;
  return true;
}

static bool read_schedule(dyd_schedule *place, const cli_option *option, const char *text) {
  bool uniform = strcmp(text, "uniform") == 0;
  if (!uniform && strcmp(text, "adaptive") != 0) return usage(option, text, "adaptive or uniform");
  *place = uniform ? DYD_SCHEDULE_UNIFORM : DYD_SCHEDULE_ADAPTIVE;
  return true;
}

/* Whether the command writes it is seen later, when the command is known. */
static bool read_format(dyd_format *place, const cli_option *option, const char *text) {
  if (dyd_format_from_name(place, text)) return true;
  fprintf(stderr, "dyadel: --%s \"%s\" is not understood; give ", option->name, text);
  cli_formats_print(stderr, cli_formats_of(cli_existing()), ", ", false);
  fputs("\n", stderr);
  return false;
}

/* ---- windows ---- */

/* The exact number text[0..length), which may be an expression with a rational value. */
static bool read_number(mpq_t out, const char *text, size_t length) {
  dyd_interval a;
  dyd_interval_init(&a);
  bool exact = dyd_interval_set_text(&a, text, length, NULL) == DYD_OK && dyd_interval_is_point(&a);
  if (exact) dyd_interval_get_q(out, out, &a);
  dyd_interval_clear(&a);
  return exact;
}

/* Splits at the commas outside parentheses; true when there are exactly four numbers. */
static bool read_four(mpq_t end[4], const char *text) {
  size_t k = 0;
  int depth = 0;
  for (const char *from = text, *at = text;; at++) {
    depth += (*at == '(') - (*at == ')');
    if (*at && (*at != ',' || depth)) continue;
    if (k == 4 || !read_number(end[k++], from, (size_t)(at - from))) return false;
    if (!*at) return k == 4;
    from = at + 1;
  }
}

static bool set_side(dyd_interval *out, const mpq_t lo, const mpq_t hi) {
  dyd_real *real = NULL;
  if (dyd_real_from_interval(&real, lo, hi) < 0) return false;
  dyd_interval_set(out, dyd_real_interval(real));
  dyd_real_free(real);
  return true;
}

bool cli_window_read(dyd_rect *out, const char *text) {
  const char *wrong = NULL;
  mpq_t end[4];
  for (int k = 0; k < 4; k++) mpq_init(end[k]);
  if (!read_four(end, text))
    wrong = "is not four exact numbers; give XLO,XHI,YLO,YHI such as -1,2.5,0,1/3";
  else if (mpq_cmp(end[0], end[1]) > 0 || mpq_cmp(end[2], end[3]) > 0)
    wrong = "has its ends in the wrong order; give the lower end of x, the upper end of x, then those of y";
  else if (mpq_equal(end[0], end[1]) || mpq_equal(end[2], end[3]))
    wrong = "has no area; give XLO < XHI and YLO < YHI";
  else if (!set_side(&out->x, end[0], end[1]) || !set_side(&out->y, end[2], end[3]))
    wrong = "lies beyond the range of numbers; give smaller ones";
  for (int k = 0; k < 4; k++) mpq_clear(end[k]);
  if (wrong) cli_complain("--window \"%s\" %s", text, wrong);
  return !wrong;
}

static bool check_window(const char *text) {
  dyd_rect window;
  dyd_rect_init(&window);
  bool good = cli_window_read(&window, text);
  dyd_rect_clear(&window);
  return good;
}

/* ---- any option ---- */

static bool read_text(const char **place, const cli_option *option, const char *text) {
  if (!*text) return usage(option, text, option->kind == CLI_FILE ? "the name of a file" : option->argument);
  *place = text;
  return true;
}

bool cli_value_read(cli_options *o, const cli_option *option, const char *text) {
  void *place = (char *)o + option->offset;
  if (option->given) *(bool *)((char *)o + option->given) = true;
  switch (option->kind) {
  case CLI_FLAG:
    return *(bool *)place = true;
  case CLI_WINDOW:
    return check_window(text) && read_text(place, option, text);
  case CLI_TEXT:
  case CLI_FILE:
    return read_text(place, option, text);
  case CLI_INTEGER:
    return read_integer(place, option, text);
  case CLI_SECONDS:
    return read_seconds(place, option, text);
  case CLI_GOAL:
    return read_goal(place, option, text);
  case CLI_SCHEDULE:
    return read_schedule(place, option, text);
  case CLI_FORMAT:
    return read_format(place, option, text);
  case CLI_HELP:
    *(const char **)place = text ? text : "";
    return true;
  }
  return false;
}
