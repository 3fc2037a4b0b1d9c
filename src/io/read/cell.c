/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Cells of tables as people write them: nothing in many words, commas for points, thousands apart.
 *
 * A number whose thousands are apart is a sign, one to three digits, and groups of a mark and three digits. "1,001" may
 * be that or a decimal; which one is meant the options say. Where they only say that commas are decimal, in a table
 * that has commas between its columns as well, a file in which each number with a comma may be of either kind is
 * refused. */
#define _GNU_SOURCE /* memmem */
#include "io/read/cell.h"

#include "base/alloc.h"
#include "base/error.h"
#include "io/read/coordinate.h"
#include "io/read/csv.h"
#include "sphere/units.h"

#include <regex.h>
#include <string.h>

/* ---- options ---- */

dyd_status dyd_style_read(dyd_style *out, const dyd_read_options *o, dyd_error *err) {
  const char *c = o->thousands;
  *out = (dyd_style){.o = o};
  if (!c) return DYD_OK;
  if (strcmp(c, "blank") == 0) c = " ";
  if (strcmp(c, "\xE2\x80\x99") == 0) c = "'";
  if (strlen(c) != 1 || !strchr(" ,.'_", *c))
    return dyd_fail(err, DYD_E_ARG, "\"%.20s\" is not between thousands; `thousands` is one of , . ' _ or blank", c);
  if (o->decimal_comma ? *c == ',' : *c == '.')
    return dyd_fail(err, DYD_E_ARG, "%s",
                    *c == ',' ? "commas are between thousands or decimal, not both: `thousands` or `decimal_comma`"
                              : "points between thousands need commas before decimals: give `decimal_comma` as well");
  out->thousands = *c;
  return DYD_OK;
}

void dyd_style_clear(dyd_style *style) {
  free(style->plain);
  *style = (dyd_style){0};
}

/* ---- missing ---- */

static bool is_word(const char *text, size_t length, const char *word) {
  if (length != strlen(word)) return false;
  for (size_t k = 0; k < length; k++)
    if (text[k] != word[k] && (text[k] | 0x20) != word[k]) return false;
  return true;
}

/* The same text, or the same decimal. */
static bool is_the_missing(const char *missing, const dyd_span *s) {
  dyd_plain a, b;
  if (strlen(missing) == s->length && memcmp(missing, s->text, s->length) == 0) return true;
  if (!dyd_plain_scan(&a, missing, strlen(missing)) || !dyd_plain_scan(&b, s->text, s->length)) return false;
  for (dyd_plain *p = &a; p; p = p == &a ? &b : NULL)
    for (; p->man && p->man % 10 == 0; p->exp++) p->man /= 10;
  return a.man == b.man && (!a.man || a.exp == b.exp);
}

bool dyd_cell_is_missing(const dyd_style *style, const dyd_span *s) {
  static const char *const words[] = {"na",   "n/a",      "nan",       "null",   "none",    "-",       "\\n",
                                      "<na>", "nan(ind)", "-nan(ind)", "1.#ind", "-1.#ind", "1.#qnan", "-1.#qnan"};
  if (!s->length || (style->o->missing && is_the_missing(style->o->missing, s))) return true;
  if (s->text[s->length - 1] >= '0' && s->text[s->length - 1] <= '9') return false;
  size_t sign = *s->text == '-' || *s->text == '+';
  for (size_t k = 0; k < sizeof words / sizeof *words; k++)
    if (is_word(s->text, s->length, words[k])) return true;
  return is_word(s->text + sign, s->length - sign, "nan") ||
         (*s->text == '#' && dyd_is_sheet_error(s->text, s->length));
}

/* ---- commas and thousands ---- */

static bool is_digit(const char *at, const char *end) {
  return at < end && *at >= '0' && *at <= '9';
}

/* The length of the mark at `at`; 0: it is another character. */
static size_t mark_length(const char *at, const char *end, char mark) {
  static const char *const blanks[] = {" ", "\xC2\xA0", "\xE2\x80\x89", "\xE2\x80\xAF"}, *const quotes[] = {
                                                                                             "'", "\xE2\x80\x99"};
  const char *const *known = mark == ' ' ? blanks : quotes;
  size_t count = mark == ' ' ? 4 : mark == '\'' ? 2 : 0;
  for (size_t k = 0; k < count; k++) {
    size_t n = strlen(known[k]);
    if ((size_t)(end - at) >= n && memcmp(at, known[k], n) == 0) return n;
  }
  return !count && at < end && *at == mark;
}

/* Where the whole part of a number ends whose thousands are apart; *groups behind the first. NULL: it is none. */
static const char *groups_end(size_t *groups, const char *at, const char *end, char mark) {
  size_t digits = 0, n;
  *groups = 0;
  if (at < end && (*at == '-' || *at == '+')) at++;
  for (; is_digit(at, end); at++) digits++;
  if (digits < 1 || digits > 3) return NULL;
  for (; (n = mark_length(at, end, mark)); at += n + 3, ++*groups)
    if (!is_digit(at + n, end) || !is_digit(at + n + 1, end) || !is_digit(at + n + 2, end)) return NULL;
  return *groups && !is_digit(at, end) ? at : NULL;
}

/* Commas within brackets separate ends and arguments. */
static bool has_brackets(const dyd_span *s) {
  return memchr(s->text, '(', s->length) || memchr(s->text, '[', s->length);
}

/* Returns true if the text has the mark, and otherwise only characters of decimals. */
static bool has_mark(const char *at, const char *end, char mark) {
  size_t marks = 0;
  for (size_t n; at < end; at += n ? n : 1) {
    n = mark_length(at, end, mark);
    marks += n > 0;
    if (!n && !memchr("0123456789.,eE+-", *at, 16)) return false;
  }
  return marks;
}

static dyd_status fail_groups(const dyd_span *s, dyd_error *err) {
  return dyd_span_fail(err, s, 0,
                       "what `thousands` names is not between groups of three digits here; correct the number");
}

/* Rewrites the cell to *to, and moves that behind it. */
static dyd_status cell_plain(dyd_style *style, dyd_span *s, char **to, dyd_error *err) {
  const char *at = s->text, *end = at + s->length;
  size_t groups;
  const char *whole = style->thousands ? groups_end(&groups, at, end, style->thousands) : NULL;
  if (style->thousands && style->thousands != ' ' && has_mark(whole ? whole : at, end, style->thousands))
    return fail_groups(s, err);
  bool commas = style->o->decimal_comma && memchr(at, ',', s->length);
  if (!whole && !commas) return DYD_OK;
  if (commas && !style->thousands && groups_end(&groups, at, end, ',') != end) style->settled = true;
  if (commas && !style->doubt.text && !style->settled) {
    style->doubt = *s;
    dyd_span_position(&style->line, &style->column, s, 0);
  }
  s->text = *to;
  for (size_t n; at < end; at++)
    if (whole && at < whole && (n = mark_length(at, end, style->thousands)))
      at += n - 1;
    else
      *(*to)++ = *at == ',' && commas ? '.' : *at;
  s->length = (size_t)(*to - s->text);
  return DYD_OK;
}

dyd_status dyd_cells_plain(dyd_style *style, dyd_span *cell, size_t count, dyd_error *err) {
  size_t size = 1;
  for (size_t k = 0; k < count; k++) size += cell[k].text ? cell[k].length : 0;
  if (!dyd_reserve((void **)&style->plain, &style->plain_cap, size, 1)) return dyd_fail_nomem(err);
  char *to = style->plain;
  dyd_status st = DYD_OK;
  for (size_t k = 0; k < count && st == DYD_OK; k++)
    if (cell[k].text && !has_brackets(&cell[k])) st = cell_plain(style, &cell[k], &to, err);
  return st;
}

dyd_status dyd_style_settle(const dyd_style *style, dyd_error *err) {
  if (!style->doubt.text || style->settled || style->thousands) return DYD_OK;
  if (err) err->line = style->line, err->column = style->column;
  return dyd_fail(err, DYD_E_PARSE,
                  "commas separate columns, and each number with a comma may have it between thousands: give "
                  "`thousands` , instead of `decimal_comma` if they are, or `thousands` . as well if they are decimal");
}

/* ---- possible meanings ---- */

size_t dyd_cell_number(const dyd_span *s) {
  dyd_plain p;
  size_t n = s->length;
  while (n && ((s->text[n - 1] | 0x20) >= 'a' && (s->text[n - 1] | 0x20) <= 'z')) n--;
  const dyd_unit *unit = dyd_unit_find(s->text + n, s->length - n);
  while (n && s->text[n - 1] == ' ') n--;
  return unit && dyd_plain_scan(&p, s->text, n) ? n : 0;
}

/* The groups of digits of a number, the decimals behind them, and what to give for it. */
static bool hint_groups(char *out, size_t size, const dyd_span *s, char mark) {
  const char *end = s->text + s->length;
  size_t groups, used = 0;
  const char *whole = groups_end(&groups, s->text, end, mark), *at = whole;
  if (!whole) return false;
  char point = at < end ? *at : 0;
  if (at < end) at++;
  while (is_digit(at, end)) at++;
  if (at < end || (point && point != '.' && point != ',') || point == mark || s->length > 40) return false;
  char number[48];
  for (const char *p = s->text; p < end; p++)
    if (*p == '-' || *p == '+' || is_digit(p, end) || p == whole) number[used++] = p == whole ? '.' : *p;
  number[used] = 0;
  snprintf(out, size, "; if this is %s, give `thousands` %s%s", number,
           mark == ' '    ? "blank"
           : mark == '\'' ? "\"'\""
                          : (char[]){mark, 0},
           point == ',' || mark == '.' ? " `decimal_comma`" : "");
  if (mark == ',' && groups == 1 && !point) {
    size_t n = strlen(out), head = (size_t)((const char *)memchr(s->text, ',', s->length) - s->text);
    snprintf(out + n, size - n, "; if it is %.*s.%.*s, give `thousands` . `decimal_comma`", (int)head, s->text, 3,
             s->text + head + 1);
  }
  return true;
}

static bool has_no_digit(const dyd_span *s) {
  for (size_t k = 0; k < s->length; k++)
    if (is_digit(s->text + k, s->text + s->length)) return false;
  return true;
}

static bool has_no_letter(const dyd_span *s) {
  for (size_t k = 0; k < s->length; k++)
    if ((s->text[k] | 0x20) >= 'a' && (s->text[k] | 0x20) <= 'z') return false;
  return true;
}

/* How many of the characters at from, up to the end of the cell, are in the set. */
static size_t cell_span(const dyd_span *s, size_t from, const char *set) {
  size_t n = 0, most = strlen(set);
  while (from + n < s->length && memchr(set, s->text[from + n], most)) n++;
  return n;
}

/* The length of the decimal at from, the longest one. */
static size_t number_length(const dyd_span *s, size_t from) {
  dyd_plain p;
  size_t n = cell_span(s, from, "+-0123456789.eE");
  while (n && !dyd_plain_scan(&p, s->text + from, n)) n--;
  return n;
}

/* Decimals between minus signs, or three between slashes. */
static bool is_difference(const dyd_span *s) {
  const size_t first = s->length && (*s->text == '-' || *s->text == '+');
  size_t at = first, parts = 0, n;
  bool minus = false;
  for (; (n = cell_span(s, at, "0123456789.")); at += n + 1, parts++) {
    if (at + n < s->length && !memchr("-/", s->text[at + n], 2)) return false;
    minus = minus || (at + n < s->length && s->text[at + n] == '-');
  }
  return at == s->length + 1 && parts > (minus ? 1 : 2);
}

/* 1.5+103 */
static bool is_wide_exponent(const dyd_span *s) {
  const size_t n = s->length < 5 ? 0 : s->length - 4;
  return n && s->text[n] == '+' && memchr(s->text, '.', n) && number_length(s, 0) == n &&
         cell_span(s, n + 1, "0123456789") == 3;
}

const char *dyd_cell_doubt(const dyd_span *s) {
  if (s->length > 2 && *s->text == '(' && number_length(s, 1) == s->length - 2 && s->text[s->length - 1] == ')')
    return "a number in brackets may be one below 0; write it without brackets, and with a minus if that is meant";
  if (is_wide_exponent(s)) return "Fortran writes 1.5e103 as 1.5+103; write the e, or brackets around a sum";
  return is_difference(s) ? "this is a date, a range or a mixed number; write a range as [1.2,1.4], 5 1/2 as (5+1/2), "
                            "and put a difference or quotient that is meant into brackets"
                          : NULL;
}

static bool has_foreign_digit(const char *text) {
  static const struct script {
    const char *lead;
    int first;
  } scripts[] = {{"\xEF\xBC", 0x90}, {"\xD9", 0xA0}, {"\xDB", 0xB0}, {"\xE0\xA5", 0xA6}, {"\xE0\xA7", 0xA6}};
  for (size_t k = 0; k < sizeof scripts / sizeof *scripts; k++) {
    const char *at = strstr(text, scripts[k].lead);
    const int behind = at ? (unsigned char)at[strlen(scripts[k].lead)] - scripts[k].first : -1;
    if (behind >= 0 && behind < 10) return true;
  }
  return false;
}

/* Characters of no width, blanks that do not break, and others below the blank. */
static bool is_invisible(const char *text) {
  static const char *const marks[] = {"\xC2\xA0",     "\xE2\x80\xAF", "\xE2\x80\x8B", "\xE2\x80\x8E",
                                      "\xE2\x80\x8F", "\xE2\x81\xA0", "\xEF\xBB\xBF"};
  for (const char *at = text; *at; at++)
    if ((unsigned char)*at < ' ') return true;
  for (size_t k = 0; k < sizeof marks / sizeof *marks; k++)
    if (strstr(text, marks[k])) return true;
  return false;
}

#define NUMBER "[-+]?([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][-+]?[0-9]+)?"
#define POINTED "[-+]?[0-9]*\\.[0-9]*"

/* Ways to write numbers that are not read: a pattern (extended, POSIX) that the cell holds, or a test of it; what to
 * do. The first that fits counts. */
static const struct habit {
  const char *pattern;
  bool (*is)(const char *text);
  const char *remedy;
} habits[] = {
    {"\xE2\x88\x92", NULL,
     "; this minus is a character of its own: sed 's/\xE2\x88\x92/-/g' FILE makes it a plain one"},
    {"\xE2\x80\x93", NULL, "; this is a dash, not a minus: sed 's/\xE2\x80\x93/-/g' FILE makes it one"},
    {"\\+/-", NULL, "; a radius follows +-, as in 1.25+-0.01: sed 's|+/-|+-|g' FILE"},
    {"^(\\(" NUMBER "[ ,;]+" NUMBER "\\)|" POINTED "[ ,;]+" POINTED ")$", NULL,
     "; this cell holds two coordinates; give each a column of its own"},
    {"^" NUMBER "\\([0-9]+\\)$", NULL,
     "; if the digits in brackets are the error of the last ones, write it as in 1.234+-0.005"},
    {"^" NUMBER "[dD]" NUMBER "$", NULL,
     "; exponents begin with e, not D: sed -E 's/([0-9.])[Dd]([-+0-9])/\\1e\\2/g' FILE"},
    {"^'.+'$", NULL, "; fields are quoted by \", not by ': tr \"'\" '\"' < FILE"},
    {"^[-+]?[0-9.]+('[-0-9 ./\"]*|\")$", NULL,
     "; if these are feet and inches: sed -E \"s/([0-9.]+)' *-?([0-9.]+)\\\"{1,2}/(\\1+\\2\\/12)/g; "
     "s/([0-9.]+)'/\\1/g\" "
     "FILE "
     "makes feet of them"},
    {"^[-+]?[0-9]+ +[0-9]+/[0-9]+$", NULL,
     "; sed -E 's,([0-9]+) +([0-9]+/[0-9]+),(\\1+\\2),g' FILE makes sums of such numbers"},
    {"^" NUMBER "-$", NULL, "; the minus belongs in front: sed -E 's/([0-9.]+)-([,;|\\t ]|$)/-\\1\\2/g' FILE"},
    {"^" NUMBER "[fFlL]$", NULL, "; numbers end with a digit: sed -E 's/([0-9.])[fFlL]([,;|\\t ]|$)/\\1\\2/g' FILE"},
    {"^\\(?" NUMBER "[-+][0-9.]+[ijIJ]\\)?$", NULL,
     "; this is a complex number: give its two parts as two coordinates"},
    {NULL, has_foreign_digit,
     "; these digits are not 0 to 9: python3 -c 'import sys, unicodedata as u; sys.stdout.write(\"\".join(str(int(c)) "
     "if "
     "c.isdecimal() else c for c in u.normalize(\"NFKC\", sys.stdin.read()).replace(chr(0x66b), \".\")))' < FILE"},
    {NULL, is_invisible,
     "; it holds a character that is not seen: LC_ALL=C sed "
     "'s/\\xC2\\xA0\\|\\xE2\\x80[\\x8B-\\x8F\\xAF]\\|\\xE2\\x81\\xA0\\|\\xEF\\xBB\\xBF\\|[\\x0B\\x0C]//g' FILE removes "
     "such"},
    {"\xC2\xB7", NULL, "; this point is a character of its own: sed 's/\xC2\xB7/./g' FILE makes it a plain one"},
    {"\xE2\x8B\x85", NULL,
     "; this point is a character of its own: sed 's/\xE2\x8B\x85/./g' FILE makes it a plain one"},
    {"^(~|<[^a-zA-Z/!?]|>|\xE2\x89\x88|\xE2\x89\xA4|\xE2\x89\xA5|\xC2\xB1)", NULL,
     "; write a bound or an estimate as the interval of all its values, such as [0,0.5]; a radius as the largest "
     "value"},
    {"[$%]|\xE2\x82\xAC|\xC2\xA3", NULL, "; numbers have no such sign: tr -d '%$' < FILE"},
    {"[0-9.] ?(x ?10|\xC3\x97|\\*\\^)", NULL, "; powers of ten are written with e, as in 1.5e3"},
    {"[0-9.]`", NULL, "; sed -E 's/`[0-9.]*//g' FILE removes the precision that Mathematica writes"},
    {"^\\*+$", NULL, "; the number did not fit its field; write the file with wider fields"},
    {"^=", NULL, "; this is a formula of a spreadsheet; save the values"},
    {"^<[a-zA-Z]", NULL, "; this cell holds XML; make columns of its coordinates"},
    {"^\\{.*\\}$", NULL, "; brackets do not belong to numbers: tr -d '{}' < FILE"},
    {"^'[-+0-9.]", NULL, "; an apostrophe marks text in spreadsheets: tr -d \"'\" < FILE"},
    {"^(([0-9]{1,2}[A-Z] ?)?[A-Z]{2}( ?[0-9]){2,10}|[0-9]{1,2}[A-Z]( [0-9.]+){2}|[A-R]{2}[0-9]{2}[A-Xa-x]{2}|"
     "[2-9C-X]{4,8}\\+[2-9C-X]{2,3}|([0-9]+[b-z]|[b-z]+[0-9])[0-9b-z]{4,10}|8[0-9a-f]{14})$",
     NULL,
     "; if this is the code of a place (MGRS or UTM, a national grid, geohash, Plus Code, H3), make degrees of it; "
     "GeoConvert of geographiclib does of MGRS, UTM and geohashes"},
};

/* Returns true if the text, of less than 80 bytes, has the pattern. */
static bool fits_pattern(const char *text, const char *pattern) {
  regex_t r;
  if (regcomp(&r, pattern, REG_EXTENDED | REG_NOSUB) != 0) return false;
  const bool fits = regexec(&r, text, 0, NULL, 0) == 0;
  regfree(&r);
  return fits;
}

const char *dyd_cell_remedy(const dyd_span *s) {
  char text[80];
  if (!s->length || s->length >= sizeof text) return NULL;
  memcpy(text, s->text, s->length);
  text[s->length] = 0;
  for (const struct habit *h = habits; h < habits + sizeof habits / sizeof *habits; h++)
    if (h->is ? h->is(text) : fits_pattern(text, h->pattern)) return h->remedy;
  return NULL;
}

static bool is_count(const dyd_text_line *line) {
  size_t k = 0;
  while (k < line->length && line->text[k] >= '0' && line->text[k] <= '9') k++;
  return k == line->length;
}

const char *dyd_line_remedy(const dyd_text_line *line, const char *message) {
  const char first = line->length ? *line->text : ' ';
  const bool one = strncmp(message, "the line has one", 16) == 0;
  const dyd_file_kind *kind = dyd_kind_of_cell(line->text, line->length);
  if (strchr("/;!", first)) return "; comments begin with # or %: pass over the first lines by `skip_lines` N";
  if (first == '>') return "; lines that begin with > separate parts in files of GMT: grep -v '^>' FILE";
  if (strchr("([{", first) || memmem(line->text, line->length, "= [", 3))
    return "; pairs in brackets: sed -E 's/^[^[({]*=//; s/[])}][ ,;]*[[({]/\\n/g; s/[][(){}]//g; s/;/\\n/g; s/[, "
           "]*$//Mg' "
           "FILE writes one a line, without them";
  if (one && is_count(line)) return "; if this is the number of points, pass over it by `skip_lines` 1";
  if (one && memmem(line->text, line->length, "\xC2\xA0", 2))
    return "; its blank is one that does not break: sed 's/\xC2\xA0/ /g' FILE makes it a plain one";
  if (memchr(line->text, '&', line->length)) return "; columns of LaTeX: sed 's/&/,/g; s/\\\\.*//' FILE";
  if (kind && strstr(kind->name, "WKB"))
    return "; this is WKB; give it a header, as a table: sed '1i wkb' FILE, and name its column: `columns` wkb,wkb";
  return strncmp(message, "more than two", 13) != 0
             ? ""
             : "; if this is a table, name two of its columns: `columns` X,Y, with `delimiter` blank where blanks are "
               "between them, or by numbers where no line has names: `no_header` `columns` 1,2";
}

/* Returns true if digits are followed by a letter of a direction, a blank or a d, or have the sign of degrees.
 */
static bool is_like_degrees(const dyd_span *s) {
  const char *end = s->text + s->length;
  for (const char *at = s->text; at + 1 < end; at++)
    if ((*at == '\xC2' && at[1] == '\xB0') || (is_digit(at, end) && (at[1] == ' ' || at[1] == 'd'))) return true;
  return s->length > 1 && strchr("NSEWOnsewo", end[-1]) && has_mark(s->text, end - 1, '.');
}

dyd_status dyd_cell_hint(dyd_status st, const dyd_style *style, const dyd_span *s, bool first, dyd_error *err) {
  size_t length = strlen(err->message), size = sizeof err->message - length;
  char *out = err->message + length;
  const dyd_read_options *o = style->o;
  const dyd_span written = {.text = o->decimal_comma ? s->at : s->text, .length = s->length};
  const char *remedy = st == DYD_E_PARSE ? dyd_cell_remedy(&written) : NULL;
  for (const char *mark = ",. '"; *mark && st == DYD_E_PARSE && o->columns && !style->thousands; mark++)
    if (hint_groups(out, size, &written, *mark)) return st;
  if (remedy) snprintf(out, size, "%s", remedy);
  if (remedy || st != DYD_E_PARSE || !s->length || has_brackets(s)) return st;
  if (!o->decimal_comma && memchr(s->text, ',', s->length))
    snprintf(out, size, "; where commas are decimal points, give `decimal_comma`");
  else if (dyd_cell_number(s))
    snprintf(out, size, "; coordinates are numbers without a unit: give %.*s", (int)dyd_cell_number(s), s->text);
  else if (first && o->columns && has_no_digit(s) && !has_no_letter(s) && !strstr(err->message, "infinite"))
    snprintf(out, size,
             o->no_header ? "; if this line names the columns, remove `no_header`"
                          : "; if this line holds units, give `units_row`");
  else if (o->columns && has_no_digit(s) && s->length < 20)
    snprintf(out, size, "; if the value is missing, give `missing` '%.*s' `skip_missing`", (int)s->length, s->text);
  else if (is_like_degrees(s))
    snprintf(out, size,
             "; degrees are read as 47.605 N, 47\xC2\xB0"
             "36'18.3\"N, 47 36 18.3 N or -47:36:18.3; their letters are N, S, "
             "E, W (O is east in German, west in French)");
  return st;
}
