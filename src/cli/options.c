/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Arguments to cli_options, by the table: options may stand before or after the command and its operands.
 *
 * What begins with a minus sign and a digit or a point is an operand, not an option: coordinates may be negative. */
#include "cli.h"

#include <ctype.h>
#include <getopt.h>
#include <math.h>
#include <mpfr.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* ---- "did you mean" ----
 *
 * The name nearest to the typed one, in edits of one character (Damerau and Levenshtein, in the form
 * where no piece is edited twice). */

enum { LONGEST = 63 };

static size_t least_size(size_t a, size_t b) {
  return a < b ? a : b;
}

/* The number of insertions, deletions, changes and swaps of neighbours from a to b; LONGEST for long words. */
static size_t edit_distance(const char *a, const char *b) {
  size_t m = strlen(a), n = strlen(b), d[LONGEST + 1][LONGEST + 1];
  if (m > LONGEST || n > LONGEST) return LONGEST;
  for (size_t i = 0; i <= m; i++) {
    for (size_t j = 0; j <= n; j++) {
      if (i == 0 || j == 0) {
        d[i][j] = i + j;
        continue;
      }
      d[i][j] = least_size(least_size(d[i - 1][j], d[i][j - 1]) + 1, d[i - 1][j - 1] + (a[i - 1] != b[j - 1]));
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = least_size(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[m][n];
}

/* Returns the candidate (0 and on, up to a NULL) most like `name`, NULL when none is like it. A name that begins as
 * `name` does, or a few typing errors away. */
static const char *suggest_name(const char *name, const char *(*candidate)(size_t k)) {
  const char *best = NULL, *one;
  size_t length = strlen(name), least = length < 3 ? length : 2 + length / 3; /* a third of the letters may be wrong */
  for (size_t k = 0; (one = candidate(k)); k++) {
    size_t d = length > 1 && strncmp(name, one, length) == 0 ? 0 : edit_distance(name, one);
    if (d >= least) continue;
    least = d;
    best = one;
  }
  return best;
}

/* ---- values: converts text as the table says, or prints a message with the remedy ---- */

/* Splits at the commas outside parentheses: there are to be exactly four numbers. */
static dyd_status read_window_ends(mpq_t end[4], const char *text) {
  size_t k = 0;
  int depth = 0;
  for (const char *from = text, *at = text;; at++) {
    depth += (*at == '(') - (*at == ')');
    if (*at && (*at != ',' || depth)) continue;
    dyd_status st = k == 4 ? DYD_E_PARSE : dyd_real_parse_exact(end[k++], from, (size_t)(at - from));
    if (st != DYD_OK) return st;
    if (!*at) return k == 4 ? DYD_OK : DYD_E_PARSE;
    from = at + 1;
  }
}

static dyd_status round_window_side(dyd_interval *out, const mpq_t lo, const mpq_t hi) {
  dyd_status st = dyd_interval_set_ends_q(out, lo, hi);
  return st == DYD_OK ? dyd_interval_round(out, out) : st;
}

int cli_window_read(dyd_rect *out, const char *text) {
  const char *wrong = NULL;
  mpq_t end[4];
  for (int k = 0; k < 4; k++) mpq_init(end[k]);
  dyd_status st = read_window_ends(end, text);
  if (st != DYD_OK)
    wrong = "is not four exact numbers; give XLO,XHI,YLO,YHI such as -1,2.5,0,1/3";
  else if (mpq_cmp(end[0], end[1]) > 0 || mpq_cmp(end[2], end[3]) > 0)
    wrong = "has its ends in the wrong order; give the lower end of x, the upper end of x, then those of y";
  else if (mpq_equal(end[0], end[1]) || mpq_equal(end[2], end[3]))
    wrong = "has no area; give XLO < XHI and YLO < YHI";
  else if ((st = round_window_side(&out->x, end[0], end[1])) != DYD_OK ||
           (st = round_window_side(&out->y, end[2], end[3])) != DYD_OK)
    wrong = "lies beyond the range of numbers; give smaller ones";
  for (int k = 0; k < 4; k++) mpq_clear(end[k]);
  if (!wrong) return 0;
  if (st == DYD_E_NOMEM) return cli_complain_memory();
  return cli_usage("--window \"%s\" %s", text, wrong);
}

int cli_number_read(mpq_ptr out, const char *name, const char *text) {
  dyd_status st = dyd_real_parse_exact(out, text, strlen(text));
  if (st == DYD_OK && mpq_sgn(out) >= 0) return 0;
  if (st == DYD_E_NOMEM) return cli_complain_memory();
  return cli_usage("--%s \"%s\" is not understood; give an exact number of 0 or more, such as 0.01", name, text);
}

static bool value_usage(const cli_option *option, const char *value, const char *wanted) {
  cli_complain("--%s \"%s\" is not understood; give %s", option->name, value, wanted);
  return false;
}

bool cli_integer_read(int64_t *out, const char *text, size_t length, unsigned forms, int64_t least, int64_t most) {
  mpq_t q;
  mpq_init(q);
  const bool read = dyd_parse_number(q, text, length, forms, NULL) == DYD_OK && mpz_fits_slong_p(mpq_numref(q));
  *out = mpz_get_si(mpq_numref(q));
  mpq_clear(q);
  return read && *out >= least && *out <= most;
}

bool cli_field_integer(int64_t *out, const dyd_record *row, size_t k, int64_t least, int64_t most) {
  size_t length;
  const char *text = dyd_record_field(&length, row, k);
  return cli_integer_read(out, text, length, DYD_NUMBER_MINUS, least, most);
}

/* The nearest double; NAN where it is no number. */
static double value_double(const char *text, size_t length) {
  mpq_t q;
  mpfr_t x;
  mpq_init(q);
  mpfr_init2(x, 53);
  const unsigned forms = CLI_FORMS | DYD_NUMBER_POINT | DYD_NUMBER_EXPONENT | DYD_NUMBER_HEX;
  if (dyd_parse_number(q, text, length, forms, NULL) == DYD_OK) mpfr_set_q(x, q, MPFR_RNDN);
  const double nearest = mpfr_get_d(x, MPFR_RNDN);
  mpfr_clear(x);
  mpq_clear(q);
  return nearest;
}

/* Returns the power of 2 meant by K, M, G or T at the end of a number of bytes. */
static int value_unit(const char *text) {
  static const char unit[] = "KMGT";
  const char *at = *text ? strchr(unit, text[strlen(text) - 1]) : NULL;
  return at ? 10 * (int)(at - unit + 1) : 0;
}

static bool value_integer(void *place, const cli_option *option, const char *text) {
  int64_t value;
  const int shift = option->kind == CLI_BYTES ? value_unit(text) : 0;
  if (!cli_integer_read(&value, text, strlen(text) - (shift > 0), CLI_FORMS, option->least, option->most >> shift)) {
    char wanted[96];
    snprintf(wanted, sizeof wanted,
             option->kind == CLI_BYTES ? "a number of bytes, such as 500M or 2G" : "a whole number from %lld to %lld",
             option->least, option->most);
    return value_usage(option, text, wanted);
  }
  if (option->width == sizeof(unsigned)) {
    *(unsigned *)place = (unsigned)value;
  } else {
    value <<= shift;
    memcpy(place, &value, sizeof value); /* uint64_t and size_t hold these values the same way */
  }
  return true;
}

static bool value_number(double *place, const cli_option *option, const char *text) {
  const double value = value_double(text, strlen(text));
  bool seconds = option->kind == CLI_SECONDS;
  if (!isfinite(value) || value <= 0 || (!seconds && value > 90))
    return value_usage(option, text, seconds ? "a number of seconds above 0" : "degrees above 0, at most 90");
  *place = value;
  return true;
}

static bool value_length(double *place, const cli_option *option, const char *text) {
  static const struct {
    const char *name;
    double points;
  } unit[] = {{"pt", 1}, {"mm", 72 / 25.4}, {"cm", 72 / 2.54}, {"in", 72}, {"", 1}};
  const size_t length = strlen(text), behind = length < 2 ? 0 : length - 2;
  size_t k = 0;
  while (k < 4 && strcmp(text + behind, unit[k].name) != 0) k++;
  *place = value_double(text, k < 4 ? behind : length) * unit[k].points;
  if (!(*place >= 1 && *place <= 5000))
    return value_usage(option, text,
                       "a length of at least a point and at most 5000, such as 240, 85mm, 12cm or 3.25in");
  return true;
}

static bool value_goal(dyd_engine_options *e, const cli_option *option, const char *text) {
  const char *colon = strchr(text, ':');
  size_t length = colon ? (size_t)(colon - text) : strlen(text);
  int64_t bits = 0;
  e->goal = DYD_GOAL_DECIDED;
  if (!colon && strcmp(text, "decided") == 0) return true;
  if (length == 4 && strncmp(text, "area", 4) == 0) e->goal = DYD_GOAL_AREA;
  if (length == 9 && strncmp(text, "hausdorff", 9) == 0) e->goal = DYD_GOAL_HAUSDORFF;
  if (!colon || e->goal == DYD_GOAL_DECIDED ||
      !cli_integer_read(&bits, colon + 1, strlen(colon + 1), CLI_FORMS, -DYD_EXP_LIMIT, DYD_EXP_LIMIT))
    return value_usage(option, text, "decided, area:M or hausdorff:M with a whole number M");
  e->goal_bits = bits;
  return true;
}

/* The first word of a list with blanks between words; NULL: none is left. */
static const char *next_word(size_t *length, const char *list) {
  list += strspn(list, " ");
  *length = strcspn(list, " ");
  return *length ? list : NULL;
}

static bool choice_usage(const cli_option *option, const char *text) {
  char wanted[96] = "";
  size_t length, next;
  for (const char *word = option->words; (word = next_word(&length, word)); word += length) {
    const char *after = word + length, *then = next_word(&next, after);
    const char *between = !then ? "" : next_word(&next, then + next) ? ", " : " or ";
    snprintf(wanted + strlen(wanted), sizeof wanted - strlen(wanted), "%.*s%s", (int)length, word, between);
  }
  return value_usage(option, text, wanted);
}

static bool value_choice(void *place, const cli_option *option, const char *text) {
  size_t length;
  unsigned k = 0;
  for (const char *word = option->words; (word = next_word(&length, word)); word += length, k++) {
    if (strlen(text) != length || strncmp(word, text, length) != 0) continue;
    if (option->width == sizeof(bool))
      *(bool *)place = k;
    else
      *(unsigned *)place = k; /* as wide as these enums */
    return true;
  }
  return choice_usage(option, text);
}

/* Whether the command writes it is seen later, when the command is known. */
static bool value_format(dyd_format *place, const cli_option *option, const char *text) {
  if (dyd_format_from_name(place, text)) return true;
  fprintf(stderr, "dyadel: --%s \"%s\" is not understood; give ", option->name, text);
  cli_formats_print(stderr, CLI_ALL, ", ", false);
  fputs("\n", stderr);
  return false;
}

static bool value_crs(unsigned *place, const cli_option *option, const char *text) {
  int64_t number;
  if (strncasecmp(text, "EPSG:", 5) != 0 ||
      !cli_integer_read(&number, text + 5, strlen(text + 5), CLI_FORMS, 1, 999999))
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
  case CLI_BYTES:
    return value_integer(place, option, text);
  case CLI_SECONDS:
  case CLI_DEGREES:
    return value_number(place, option, text);
  case CLI_LENGTH:
    return value_length(place, option, text);
  case CLI_GOAL:
    return value_goal(place, option, text);
  case CLI_CHOICE:
    return value_choice(place, option, text);
  case CLI_FORMAT:
    return value_format(place, option, text);
  case CLI_LAYER: /* whether the command has it is seen later */
    *(const char **)place = text;
    return true;
  case CLI_CRS:
    return value_crs(place, option, text);
  case CLI_HELP:
    *(const char **)place = text ? text : "";
    return true;
  }
  return false;
}

/* Reads the value of an option into *o. 0, or an exit status after a message. */
static int value_read(cli_options *o, const cli_option *option, const char *text) {
  int status = option->kind == CLI_WINDOW ? check_window(text) : 0;
  if (status) return status;
  return value_any(o, option, text) ? 0 : CLI_USAGE;
}

/* ---- arguments ---- */

enum { MOST_OPTIONS = 96, MOST_OPERANDS = 5, FIRST_VALUE = 256 };

/* Options and operands, before the command is known. Invariant: seen[k] when option k was given. */
typedef struct scan {
  struct option known[MOST_OPTIONS + 1];
  char letters[2 * MOST_OPTIONS + 3];
  bool seen[MOST_OPTIONS];
  const char *operand[MOST_OPERANDS];
  size_t operands;
  char **call; /* place of the next word of the call that changes the result */
} scan;

/* Tells getopt_long of all options; its value for option k is FIRST_VALUE + k. */
static void scan_prepare(scan *s) {
  size_t n = 0, m = 0;
  *s = (scan){0};
  s->letters[m++] = '+';
  s->letters[m++] = ':';
  for (size_t k = 0; k < cli_option_count && n < MOST_OPTIONS; k++) {
    const cli_option *o = &cli_option_table[k];
    int argument = o->kind == CLI_HELP ? optional_argument : o->argument ? required_argument : no_argument;
    s->known[n++] = (struct option){o->name, argument, NULL, FIRST_VALUE + (int)k};
    if (!o->letter) continue;
    s->letters[m++] = o->letter;
    if (argument == required_argument) s->letters[m++] = ':';
  }
}

static size_t option_number(int value) {
  if (value >= FIRST_VALUE) return (size_t)(value - FIRST_VALUE);
  for (size_t k = 0; k < cli_option_count; k++)
    if (cli_option_table[k].letter == value) return k;
  return 0;
}

static const char *option_name(size_t k) {
  return k < cli_option_count ? cli_option_table[k].name : NULL;
}

static int complain_unknown(const char *argument) {
  char name[64];
  snprintf(name, sizeof name, "%s", argument + strspn(argument, "-"));
  name[strcspn(name, "=")] = 0;
  const char *best = suggest_name(name, option_name);
  if (strcmp(name, "no-voronoi") == 0)
    return cli_usage("--no-voronoi is the default now; --of voronoi computes the bounds of the diagram");
  if (best) return cli_usage("there is no option %s; did you mean --%s?", argument, best);
  return cli_usage("there is no option %s; see dyadel --help", argument);
}

static int complain_option(int kind, const char *argument) {
  if (kind == ':')
    cli_complain("%s needs a value; see dyadel --help", argument);
  else if (optopt >= FIRST_VALUE)
    cli_complain("--%s takes no value; remove \"=\" and what follows", cli_option_table[option_number(optopt)].name);
  else if (optopt)
    cli_complain("there is no option -%c; see dyadel --help", optopt);
  else
    return complain_unknown(argument);
  return CLI_USAGE;
}

static bool is_operand(const char *a) {
  return a[0] != '-' || !a[1] || isdigit((unsigned char)a[1]) || a[1] == '.';
}

static int scan_operand(scan *s, const char *text) {
  if (s->operands < MOST_OPERANDS) {
    s->operand[s->operands++] = text;
    return 0;
  }
  return cli_usage("\"%s\" is one argument too many; see dyadel --help", text);
}

static int scan_all(scan *s, cli_options *o, int argc, char **argv) {
  bool operands_only = false;
  opterr = 0;
  if (argc) *s->call++ = argv[0];
  for (int status = 0; optind < argc;) {
    char **word = &argv[optind], *a = *word;
    bool silent = false;
    if (!operands_only && strcmp(a, "--") == 0) {
      operands_only = true;
      optind++;
    } else if (operands_only || is_operand(a)) {
      status = scan_operand(s, a);
      optind++;
    } else {
      int value = getopt_long(argc, argv, s->letters, s->known, NULL);
      if (value == '?' || value == ':') return complain_option(value, a);
      size_t k = option_number(value);
      s->seen[k] = true;
      silent = cli_option_table[k].silent;
      status = value_read(o, &cli_option_table[k], optarg);
    }
    if (status) return status;
    while (word < &argv[optind] && !silent) *s->call++ = *word++;
  }
  *s->call = NULL;
  return 0;
}

/* ---- checks that options fit the command ---- */

static const char *command_name(size_t k) {
  return k < CLI_COMMANDS ? cli_commands[k].name : NULL;
}

static int unknown_command(const char *name) {
  const char *best = suggest_name(name, command_name);
  if (best)
    cli_complain("there is no command \"%s\"; did you mean %s?", name, best);
  else
    cli_complain("there is no command \"%s\"; the commands are:", name);
  for (size_t c = 0; !best && c < CLI_COMMANDS; c++)
    fprintf(stderr, "  dyadel %s %s\n", cli_commands[c].name, cli_commands[c].operands);
  return CLI_USAGE;
}

/* A trace of converge has the points in it; the schedule that check replays has not. */
static bool trace_has_points(const cli_options *o, const cli_command *c) {
  return o->replay && c == &cli_commands[CLI_CONVERGE];
}

/* What contradicts itself, or says too little. */
static int meanings_fit(const cli_options *o, const cli_command *c) {
  if (o->sphere && o->plane) return cli_usage("--sphere and --plane contradict each other; remove one of them");
  if (o->clip && (o->sphere || !(o->all_layers || (o->layer && strcmp(o->layer, "edges") == 0))))
    return cli_usage("--clip is about edges in the plane; give --layer edges, or remove it");
  if (o->clip_to && (o->sphere || !(o->all_layers || (o->layer && strcmp(o->layer, "tiles") == 0))))
    return cli_usage("--clip-to cuts tiles in the plane; give --layer tiles, or remove it");
  if (o->sphere && o->lengths) return cli_usage("--length is about the plane; remove it or --sphere");
  if (o->sphere && o->discs) return cli_usage("--discs is about the plane; remove --discs or --sphere");
  const dyd_write_style *style = &o->style;
  const bool styled = style->bare || style->width > 0 || style->font_size > 0 || style->font;
  if (styled && !o->plot && !o->pgf && !cli_is_picture(o->format))
    return cli_usage("--bare, --width, --font-size and --font are about pictures; give -o with a name in %s, or remove "
                     "them",
                     c == &cli_commands[CLI_CONVERGE] ? "--plot" : ".svg, .pdf, .png or .tikz");
  if (!o->read.sigma_column || o->read.confidence || c == &cli_commands[CLI_TOLERANCE]) return 0;
  return cli_usage("--sigma-column alone gives no region; state the probability with which all points have to lie in "
                   "theirs: --confidence 95%%");
}

static int options_fit(const cli_options *o, const bool *seen, const cli_command *c) {
  for (size_t k = 0; k < cli_option_count; k++) {
    if (!seen[k] || cli_option_exists(&cli_option_table[k], cli_command_bit(c))) continue;
    return cli_usage("%s does not take --%s; see dyadel %s --help", c->name, cli_option_table[k].name, c->name);
  }
  for (size_t k = 0; trace_has_points(o, c) && k < cli_option_count; k++) {
    cli_group group = cli_option_table[k].group;
    const bool timeout = cli_option_table[k].offset == offsetof(cli_options, engine.seconds);
    if (!seen[k] || timeout || (group != CLI_INPUT && group != CLI_REFINEMENT)) continue;
    return cli_usage("--replay takes points and options from the trace; remove --%s", cli_option_table[k].name);
  }
  for (size_t k = 0; c == &cli_commands[CLI_VERIFY] && !o->points && k < cli_option_count; k++) {
    if (!seen[k] || cli_option_table[k].group != CLI_INPUT) continue;
    return cli_usage("--%s says how points are read; give their file with --points", cli_option_table[k].name);
  }
  return 0;
}

/* The layer named, as a layer of the command's output. */
static int layer_fits(cli_options *o, const cli_command *c) {
  dyd_content of = c->content;
  if (o->sphere && of == DYD_CONTENT_DELAUNAY) of = DYD_CONTENT_SPHERE;
  if (o->sphere && of == DYD_CONTENT_VORONOI) of = DYD_CONTENT_SPHERE_VORONOI;
  o->content = o->queries ? DYD_CONTENT_PLACES : o->simulate ? DYD_CONTENT_TRIALS : of;
  if (!o->layer || dyd_layer_from_name(&o->content, of, o->layer)) return 0;
  fprintf(stderr, "dyadel: %s%s has no layer \"%s\"; give ", c->name, o->sphere ? " --sphere" : "", o->layer);
  for (size_t k = 0; dyd_layer_name(NULL, NULL, of, k); k++)
    fprintf(stderr, "%s%s", k ? ", " : "", dyd_layer_name(NULL, NULL, of, k));
  fputs("\n", stderr);
  return CLI_USAGE;
}

/* The layer or the format may state more than discs decide. */
static int discs_fit(const cli_options *o, const cli_command *c) {
  const bool layer = !dyd_format_holds(DYD_FORMAT_CSV, o->content, true);
  if (!o->discs || c != &cli_commands[CLI_DELAUNAY] || dyd_format_holds(o->format, o->content, true)) return 0;
  return cli_usage("delaunay --discs does not write %s%s; give a layer of pairs, points, triangles, aliases or graphs, "
                   "as csv, wkt or geojson, or pairs or graphs as svg, pdf, png, html or tikz",
                   layer ? "--layer " : "", layer ? o->layer : dyd_format_get(o->format)->name);
}

/* The format has to hold the content; without --format, the first that does is taken. */
static int format_fits(cli_options *o, const cli_command *c) {
  while (!o->format_set && dyd_format_get(o->format) && !dyd_format_holds(o->format, o->content, false)) o->format++;
  if (!o->format_set || dyd_format_holds(o->format, o->content, false)) return 0;
  fprintf(stderr, "dyadel: %s%s%s%s does not write %s; give", c->name, o->sphere ? " --sphere" : "",
          o->layer ? " --layer " : "",
          o->layer      ? o->layer
          : o->queries  ? " --queries"
          : o->simulate ? " --simulate"
                        : "",
          dyd_format_get(o->format)->name);
  const char *before = " ";
  for (unsigned f = 0; dyd_format_get((dyd_format)f); f++) {
    if (!dyd_format_holds((dyd_format)f, o->content, false)) continue;
    fprintf(stderr, "%s%s", before, dyd_format_get((dyd_format)f)->name);
    before = ", ";
  }
  fputs("\n", stderr);
  return CLI_USAGE;
}

/* Behind the last dot of the file's name; NULL: there is none. */
static const char *name_ending(const char *name) {
  const char *slash = strrchr(name, '/'), *dot = strrchr(slash ? slash : name, '.');
  return dot && dot[1] ? dot + 1 : NULL;
}

static int ending_unknown(const cli_options *o, const char *name, const cli_command *c) {
  const char *ending = name_ending(name);
  bool table = strcasecmp(ending, "xlsx") == 0 || strcasecmp(ending, "ods") == 0 || strcasecmp(ending, "xls") == 0;
  fprintf(stderr, "dyadel: -o %s: no format is called %s; ", o->output, ending);
  if (table) fputs("for a table end the name in .csv; ", stderr);
  fputs("formats are ", stderr);
  cli_formats_print(stderr, cli_command_bit(c), ", ", false);
  fprintf(stderr, " (other names: with --format)\n");
  return CLI_USAGE;
}

/* Rows go to GDAL as wkt, or as csv where they have no geometry. */
static int format_of_driver(cli_options *o, bool several) {
  if (o->format_set)
    return cli_usage("-o %s says the format; remove --format %s", o->output, dyd_format_get(o->format)->name);
  if (cli_name_is_packed(&(size_t){0}, o->output)) return cli_usage("-o %s: GDAL packs no such file", o->output);
  o->all_layers = several && !o->layer;
  o->format = dyd_format_holds(DYD_FORMAT_WKT, o->content, false) ? DYD_FORMAT_WKT : DYD_FORMAT_CSV;
  o->format_set = true;
  return 0;
}

/* The ending of the file that is written, .gz or .zst aside, chooses the format, and does not contradict the one given.
 */
static int format_from_output(cli_options *o, const cli_command *c) {
  char name[4096];
  size_t length;
  if (!o->output || c->content == DYD_CONTENT_NONE) return 0;
  cli_name_is_packed(&length, o->output);
  snprintf(name, sizeof name, "%.*s", (int)length, o->output);
  bool known = dyd_format_from_file(o->format_set ? &(dyd_format){0} : &o->format, name);
  const char *ending = name_ending(name);
  bool several = false;
  o->driver = known ? NULL : cli_spatial_driver(&several, ending);
  if (o->driver) return format_of_driver(o, several);
  if (!o->format_set && !known && ending && strcmp(ending, "txt") != 0) return ending_unknown(o, name, c);
  o->format_set |= known;
  const dyd_format_facts *f = dyd_format_get(o->format);
  if (!known || strcasecmp(ending, f->name) == 0 || (f->also && strcasecmp(ending, f->also) == 0)) return 0;
  return cli_usage("-o %s does not name a %s file; remove --format %s, or end the name in .%s", o->output, f->name,
                   f->name, f->name);
}

/* Longitude and latitude in degrees: WGS 84, ETRS89, NAD27, NAD83, GDA94, SIRGAS, GDA2020 and others much used. */
bool cli_crs_is_degrees(unsigned epsg) {
  static const unsigned of_degrees[] = {4326, 4979, 4258, 4267, 4269, 4283, 4674, 7844, 4617, 4167, 4490,
                                        6318, 6668, 4612, 4148, 4171, 4277, 4314, 4275, 4265, 4230, 4322};
  size_t k = 0, count = sizeof of_degrees / sizeof *of_degrees;
  while (k < count && of_degrees[k] != epsg) k++;
  return k < count;
}

/* Checks that the format has a place for the reference system, and that the system fits the output. */
static int crs_fits(const cli_options *o) {
  static const bool none[] = {
      [DYD_FORMAT_CSV] = true, [DYD_FORMAT_WKT] = true, [DYD_FORMAT_OBJ] = true, [DYD_FORMAT_VTK] = true};
  if (o->epsg && o->sphere && !cli_crs_is_degrees(o->epsg))
    return cli_usage("with --sphere coordinates are degrees, and EPSG:%u is not known as a system of degrees; give "
                     "--crs EPSG:4326",
                     o->epsg);
  if (o->driver) return 0;
  if (!o->epsg || (size_t)o->format >= sizeof none / sizeof *none || !none[o->format]) return 0;
  return cli_usage("%s has no place for a reference system; remove --crs, or give --format geojson",
                   dyd_format_get(o->format)->name);
}

/* Hands the operands behind the command's name to their fields. An oracle or a trace replaces the file, with a
 * file of places no place. */
static int place_operands(cli_options *o, const scan *s, const cli_command *c) {
  const char *operands = o->queries ? "FILE" : c->operands;
  const char **place[MOST_OPERANDS];
  size_t wanted = 0;
  bool file = !o->oracle && !trace_has_points(o, c);
  if (file) place[wanted++] = &o->file;
  if (strstr(operands, " X Y")) {
    place[wanted++] = &o->at[0];
    place[wanted++] = &o->at[1];
  }
  size_t given = s->operands - 1;
  if (given > wanted)
    return cli_usage("\"%s\" is one argument too many; give dyadel %s %s", s->operand[wanted + 1], c->name,
                     file ? operands : operands + strcspn(operands, " "));
  for (size_t k = 0; k < given; k++) *place[k] = s->operand[k + 1];
  if (given == wanted) return 0;
  if (given == 0 && file && strncmp(operands, "FILE", 4) == 0)
    return cli_usage("the points file is missing; give its name, or - for standard input");
  return cli_usage("an argument is missing; give dyadel %s %s", c->name, operands);
}

/* dyadel help [COMMAND] is dyadel [COMMAND] --help. */
static int options_help(cli_options *o, const scan *s) {
  if (s->operands > 2) return cli_usage("\"%s\" is one argument too many; give dyadel help COMMAND", s->operand[2]);
  if (!o->help) o->help = "";
  if (s->operands < 2) return 0;
  if (!cli_command_find(s->operand[1])) return unknown_command(s->operand[1]);
  o->command = s->operand[1];
  return 0;
}

int cli_options_read(cli_options *out, int argc, char **argv, char **call) {
  scan s;
  *out = (cli_options){.format = DYD_FORMAT_CSV, .read = {DYD_SIZED(dyd_read_options)}};
  out->style = (dyd_write_style){DYD_SIZED(dyd_write_style)};
  dyd_engine_options_init(&out->engine);
  scan_prepare(&s);
  s.call = call;
  int status = scan_all(&s, out, argc, argv);
  if (status) return status;
  if (s.operands == 0) {
    if (out->help || out->version) return 0;
    return cli_usage("a command is missing; try: dyadel delaunay FILE, or dyadel --help");
  }
  if (strcmp(s.operand[0], "help") == 0) return options_help(out, &s);
  const cli_command *c = cli_command_find(s.operand[0]);
  if (!c) return unknown_command(s.operand[0]);
  out->command = c->name;
  if (out->help || out->version) return 0;
  if (out->comments && !out->no_times) out->style.command_line = (const char *const *)call;
  out->read.round = out->engine.discs = out->discs;
  status = options_fit(out, s.seen, c);
  if (!status) status = layer_fits(out, c);
  if (out->output && strcmp(out->output, "-") == 0) out->output = NULL; /* standard output, as without -o */
  if (!status) status = format_from_output(out, c);
  if (!status) status = meanings_fit(out, c);
  if (!status) status = format_fits(out, c);
  if (!status) status = discs_fit(out, c);
  if (!status) status = crs_fits(out);
  return status ? status : place_operands(out, &s, c);
}
