/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The values of options: text to what the table says, or a message with what to give instead. */
#include "table.h"
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static bool value_usage(const cli_option *option, const char *value, const char *wanted) {
  cli_complain("--%s \"%s\" is not understood; give %s", option->name, value, wanted);
  return false;
}

static bool value_scan_integer(long long *out, const char *text, long long least, long long most) {
  char *end;
  errno = 0;
  *out = strtoll(text, &end, 10);
  return end != text && !*end && errno == 0 && *out >= least && *out <= most;
}

static bool value_integer(void *place, const cli_option *option, const char *text) {
  long long value;
  if (!value_scan_integer(&value, text, option->least, option->most)) {
    char wanted[96];
    snprintf(wanted, sizeof wanted, "a whole number from %lld to %lld", option->least, option->most);
    return value_usage(option, text, wanted);
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

static bool value_number(double *place, const cli_option *option, const char *text) {
  char *end;
  double value = strtod(text, &end);
  bool seconds = option->kind == CLI_SECONDS;
  if (end == text || *end || !isfinite(value) || value <= 0 || (!seconds && value > 90))
    return value_usage(option, text, seconds ? "a number of seconds above 0" : "degrees above 0, at most 90");
  *place = value;
  return true;
}

static bool value_goal(dyd_engine_options *e, const cli_option *option, const char *text) {
  const char *colon = strchr(text, ':');
  size_t length = colon ? (size_t)(colon - text) : strlen(text);
  long long bits = 0;
  e->goal = DYD_GOAL_DECIDED;
  if (!colon && strcmp(text, "decided") == 0) return true;
  if (length == 4 && strncmp(text, "area", 4) == 0) e->goal = DYD_GOAL_AREA;
  if (length == 9 && strncmp(text, "hausdorff", 9) == 0) e->goal = DYD_GOAL_HAUSDORFF;
  if (!colon || e->goal == DYD_GOAL_DECIDED || !value_scan_integer(&bits, colon + 1, -DYD_EXP_LIMIT, DYD_EXP_LIMIT))
    return value_usage(option, text, "decided, area:M or hausdorff:M with a whole number M");
  e->goal_bits = bits;
  return true;
}

static bool value_schedule(dyd_schedule *place, const cli_option *option, const char *text) {
  bool uniform = strcmp(text, "uniform") == 0;
  if (!uniform && strcmp(text, "adaptive") != 0) return value_usage(option, text, "adaptive or uniform");
  *place = uniform ? DYD_SCHEDULE_UNIFORM : DYD_SCHEDULE_ADAPTIVE;
  return true;
}

static bool value_subject(bool *voronoi, const cli_option *option, const char *text) {
  *voronoi = strcmp(text, "voronoi") == 0;
  return *voronoi || strcmp(text, "delaunay") == 0 || value_usage(option, text, "delaunay or voronoi");
}

static bool value_metric(dyd_metric *place, const cli_option *option, const char *text) {
  bool box = strcmp(text, dyd_metric_text(DYD_METRIC_BOX)) == 0;
  *place = box ? DYD_METRIC_BOX : DYD_METRIC_EUCLID;
  return box || strcmp(text, dyd_metric_text(DYD_METRIC_EUCLID)) == 0 || value_usage(option, text, "euclid or box");
}

static bool value_ties(bool *off, const cli_option *option, const char *text) {
  *off = strcmp(text, "off") == 0;
  return *off || strcmp(text, "prove") == 0 || value_usage(option, text, "prove or off");
}

static bool value_list_ties(dyd_list_ties *out, const cli_option *option, const char *text) {
  static const char *const name[] = {"pairs", "groups", "none"};
  for (int k = 0; k < 3; k++)
    if (strcmp(text, name[k]) == 0) return *out = (dyd_list_ties)k, true;
  return value_usage(option, text, "pairs, groups or none");
}

/* Whether the command writes it is seen later, when the command is known. */
static bool value_format(dyd_format *place, const cli_option *option, const char *text) {
  if (dyd_format_from_name(place, text)) return true;
  fprintf(stderr, "dyadel: --%s \"%s\" is not understood; give ", option->name, text);
  cli_formats_print(stderr, CLI_ALL, ", ", false);
  fputs("\n", stderr);
  return false;
}

/* Whether it is one of the command is seen later. */
static bool value_layer(const char **place, const cli_option *option, const char *text) {
  dyd_content layer;
  *place = text;
  for (unsigned c = 0; c < CLI_COMMANDS; c++)
    if (dyd_layer_from_name(&layer, cli_commands[c].content, text)) return true;
  fprintf(stderr, "dyadel: --%s \"%s\" is not understood; give ", option->name, text);
  cli_layers_print(stderr, CLI_ALL, ", ");
  fputs("\n", stderr);
  return false;
}

static bool value_crs(unsigned *place, const cli_option *option, const char *text) {
  long long number;
  if (strncasecmp(text, "EPSG:", 5) != 0 || !value_scan_integer(&number, text + 5, 1, 999999))
    return value_usage(option, text, "EPSG: and a number, such as EPSG:32632");
  *place = (unsigned)number;
  return true;
}

static int check_window(const char *text) {
  dyd_rect window;
  dyd_rect_init(&window);
  int status = cli_window_read(&window, text);
  dyd_rect_clear(&window);
  return status;
}

/* ---- any option ---- */

static bool value_text(const char **place, const cli_option *option, const char *text) {
  if (!*text) return value_usage(option, text, option->kind != CLI_TEXT ? "the name of a file" : option->argument);
  *place = text;
  return true;
}

static bool value_any(cli_options *o, const cli_option *option, const char *text) {
  void *place = (char *)o + option->offset;
  if (option->given) *(bool *)((char *)o + option->given) = true;
  switch (option->kind) {
  case CLI_FLAG:
    return *(bool *)place = true;
  case CLI_WINDOW:
  case CLI_TEXT:
  case CLI_FILE:
  case CLI_SOURCE:
    return value_text(place, option, text);
  case CLI_INTEGER:
    return value_integer(place, option, text);
  case CLI_SECONDS:
  case CLI_DEGREES:
    return value_number(place, option, text);
  case CLI_GOAL:
    return value_goal(place, option, text);
  case CLI_SCHEDULE:
    return value_schedule(place, option, text);
  case CLI_SUBJECT:
    return value_subject(place, option, text);
  case CLI_METRIC:
    return value_metric(place, option, text);
  case CLI_TIES:
    return value_ties(place, option, text);
  case CLI_LIST_TIES:
    return value_list_ties(place, option, text);
  case CLI_FORMAT:
    return value_format(place, option, text);
  case CLI_LAYER:
    return value_layer(place, option, text);
  case CLI_CRS:
    return value_crs(place, option, text);
  case CLI_HELP:
    *(const char **)place = text ? text : "";
    return true;
  }
  return false;
}

int cli_value_read(cli_options *o, const cli_option *option, const char *text) {
  int status = option->kind == CLI_WINDOW ? check_window(text) : 0;
  if (status) return status;
  return value_any(o, option, text) ? 0 : CLI_USAGE;
}
