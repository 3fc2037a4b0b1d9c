/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Reads the names of columns: which hold longitude and latitude, in which order, and in which unit; and cells that
 * are not degrees alone, because another column has the rest. */
#include "base/error.h"
#include "dyadic/numeral.h"
#include "io/read/csv.h"

#include <string.h>

static bool is_latin(char c) {
  return (c | 0x20) >= 'a' && (c | 0x20) <= 'z';
}

static bool is_capital(char c) {
  return c >= 'A' && c <= 'Z';
}

/* Words that the names of coordinates hold: anywhere in a name, at its begin, or as its last part (stop_lat, gpsLon).
 */
typedef struct axis_words {
  const char *any, *begin[2], *last[3];
} axis_words;

static const axis_words latitude = {"latitude", {"lat", "lat"}, {"lat", "lat", "lat"}},
                        longitude = {"longitude", {"lon", "lng"}, {"lon", "lng", "long"}},
                        northing = {"northing", {"northing", "hochwert"}, {"north", "nord", "norte"}},
                        easting = {"easting", {"easting", "rechtswert"}, {"east", "est", "este"}};

/* The word is at place k of the field, in any case. */
static bool has_word(const dyd_span *f, size_t k, const char *word) {
  const size_t n = strlen(word);
  return n <= f->length && k <= f->length - n && dyd_same_name(f->text + k, word, n);
}

/* A part of a name begins where a capital follows a small letter, or after a character that is not a letter. */
static bool ends_with_part(const dyd_span *f, const char *word) {
  const size_t n = strlen(word), at = f->length - n;
  if (n > f->length || !has_word(f, at, word)) return false;
  return !at || !is_latin(f->text[at - 1]) || (!is_capital(f->text[at - 1]) && is_capital(f->text[at]));
}

/* X, POINT_X, XCOORD, "X [m]", X-Koordinate */
static bool is_xy(const dyd_span *f, const char *x) {
  const char next = f->length > 1 && has_word(f, 0, x) ? f->text[1] : 'a';
  return ends_with_part(f, x) || !is_latin(next) || (has_word(f, 0, x) && has_word(f, 1, "coord"));
}

static bool is_called(const dyd_span *f, const axis_words *w) {
  for (size_t k = 0; k < f->length; k++)
    if (has_word(f, k, w->any)) return true;
  return has_word(f, 0, w->begin[0]) || has_word(f, 0, w->begin[1]) || ends_with_part(f, w->last[0]) ||
         ends_with_part(f, w->last[1]) || ends_with_part(f, w->last[2]);
}

bool dyd_name_is_axis(const dyd_span *name, int axis) {
  return is_called(name, axis ? &latitude : &longitude) || is_called(name, axis ? &northing : &easting) ||
         is_xy(name, axis ? "y" : "x");
}

static const char plain_letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-.,";

/* A name as `columns` takes it, at most 60 bytes of it. */
static void put_name(char *out, size_t *used, const dyd_span *name) {
  size_t length = name->length < 60 ? name->length : 60;
  bool quoted = memchr(name->text, ',', length);
  if (quoted) out[(*used)++] = '"';
  memcpy(out + *used, name->text, length);
  *used += length;
  if (quoted) out[(*used)++] = '"';
}

void dyd_names_put(char out[160], const dyd_span *x, const dyd_span *y) {
  size_t used = 1;
  put_name(out, &used, x);
  out[used++] = ',';
  put_name(out, &used, y);
  out[0] = '\'';
  out[used] = 0;
  if (out[1 + strspn(out + 1, plain_letters)])
    strcpy(out + used, "'");
  else
    memmove(out, out + 1, used);
}

/* ---- units of coordinates ---- */

static size_t letters_from(const dyd_span *f, size_t k) {
  size_t n = k;
  while (n < f->length && is_latin(f->text[n])) n++;
  return n;
}

/* lat_deg and lat_min, LatDegrees and LatMinutes. */
static bool holds_minutes(const dyd_span *m, const dyd_span *degrees) {
  for (size_t k = 0; k < m->length && k < degrees->length && dyd_same_name(m->text, degrees->text, k); k++) {
    if (!has_word(degrees, k, "deg") || !has_word(m, k, "min")) continue;
    const size_t a = letters_from(degrees, k), b = letters_from(m, k), left = m->length - b;
    if (left == degrees->length - a && dyd_same_name(degrees->text + a, m->text + b, left)) return true;
  }
  return false;
}

/* The other units of angles that a name may end with, in brackets or not; NULL: none. */
static const char *other_angle(const dyd_span *name) {
  static const char *const words[] = {"rad", "radian", "radians", "gon", "grad", "mas", "microdeg", "e7", "e6"};
  dyd_span f = *name;
  while (f.length && strchr(" )]", f.text[f.length - 1])) f.length--;
  for (size_t k = 0; k < sizeof words / sizeof *words; k++)
    if (ends_with_part(&f, words[k])) return words[k];
  return NULL;
}

/* Degrees are wanted. */
static dyd_status check_unit(const dyd_csv *csv, int axis, dyd_error *err) {
  const dyd_span *f = &csv->field[csv->column[axis]];
  const char *angle = other_angle(f), *name = csv->unit[axis] ? csv->unit[axis]->name : angle;
  if (csv->e7 || !name || strcmp(name, "deg") == 0) return DYD_OK;
  if (err) dyd_span_position(&err->line, &err->column, f, 0);
  return dyd_fail(
      err, DYD_E_ARG,
      "by its name the column is in another unit (%s); coordinates on the sphere are degrees: convert them, "
      "and give the column another name",
      name);
}

dyd_status dyd_names_agree(const dyd_span *cell, const dyd_unit *x, const dyd_unit *y, dyd_error *err) {
  if (!x || !y || x == y) return DYD_OK;
  if (err) dyd_span_position(&err->line, &err->column, cell, 0);
  return dyd_fail(err, DYD_E_ARG, "x is in %s and y in %s; convert one of them, and name both alike", x->name, y->name);
}

/* The unit that the name of a coordinate states, as in "x [km]" or y_m. */
static const dyd_unit *unit_of_axis(const dyd_span *f) {
  const dyd_unit *unit = dyd_unit_of_column(f->text, f->length);
  size_t at = f->length;
  while (at && is_latin(f->text[at - 1])) at--;
  return unit || !at || !strchr("_ ", f->text[at - 1]) ? unit : dyd_unit_find(f->text + at, f->length - at);
}

dyd_status dyd_names_mean(dyd_csv *csv, bool degrees, dyd_error *err) {
  const dyd_span *x = &csv->field[csv->column[DYD_CSV_X]], *y = &csv->field[csv->column[DYD_CSV_Y]];
  const bool x_lat = is_called(x, &latitude), y_lon = is_called(y, &longitude);
  for (int role = DYD_CSV_X; role < csv->roles; role++) {
    const dyd_span *f = csv->want[role].name ? &csv->field[csv->column[role]] : NULL;
    csv->unit[role] = f ? dyd_unit_of_column(f->text, f->length) : NULL;
  }
  csv->degrees = is_called(x, &longitude) && is_called(y, &latitude);
  csv->swapped = (x_lat || is_called(x, &northing)) && (y_lon || is_called(y, &easting));
  csv->e7 = (csv->degrees || (x_lat && y_lon)) && ends_with_part(x, "e7") && ends_with_part(y, "e7");
  for (size_t k = 0; k < csv->fields; k++)
    csv->minutes = csv->minutes || holds_minutes(&csv->field[k], x) || holds_minutes(&csv->field[k], y);
  if (csv->swapped && degrees) {
    char names[160];
    dyd_names_put(names, y, x);
    return dyd_fail(err, DYD_E_ARG,
                    "by their names the columns are latitude and longitude; longitude comes first: `columns` %s",
                    names);
  }
  dyd_status st = dyd_names_agree(y, unit_of_axis(x), unit_of_axis(y), err);
  for (int axis = DYD_CSV_X; axis <= DYD_CSV_Y && degrees && st == DYD_OK; axis++) st = check_unit(csv, axis, err);
  return st;
}

/* ---- cells ---- */

/* Returns true if the cell says that the number beside is below 0: W or S. */
static bool is_negative(const dyd_span *cell, int axis) {
  static const char *const words[2] = {"west", "south"};
  const char *at = cell->text, *end = at + cell->length;
  while (at < end && *at == ' ') at++;
  while (at < end && end[-1] == ' ') end--;
  const size_t n = (size_t)(end - at), word = strlen(words[axis]);
  return (n == 1 || n == word) && dyd_same_name(at, words[axis], n);
}

/* Most cells are seen by their first character not to be such. */
static bool is_negated(const dyd_csv *csv, int axis) {
  const dyd_span *cell = csv->field + csv->column[axis], *end = csv->field + csv->fields;
  const char letter = axis ? 's' : 'w';
  return (cell > csv->field && cell[-1].length && (cell[-1].text[0] == ' ' || (cell[-1].text[0] | 0x20) == letter) &&
          is_negative(cell - 1, axis)) ||
         (cell + 1 < end && cell[1].length && (cell[1].text[0] == ' ' || (cell[1].text[0] | 0x20) == letter) &&
          is_negative(cell + 1, axis));
}

dyd_status dyd_names_complete(dyd_csv *csv, dyd_span cell[2], dyd_error *err) {
  static const char digits[] = "0123456789";
  for (int a = DYD_CSV_X; a <= DYD_CSV_Y; a++) {
    const bool negated = is_negated(csv, a);
    if (!negated && !csv->minutes && !csv->e7) continue;
    const bool sign = cell[a].length && (*cell[a].text == '-' || *cell[a].text == '+');
    size_t n = sign;
    while (n < cell[a].length && memchr(digits, cell[a].text[n], 10)) n++;
    const bool number = n > sign, whole = number && n == cell[a].length;
    if (negated && number && *cell[a].text != '-' && !is_latin(cell[a].text[cell[a].length - 1]))
      return dyd_span_fail(err, &cell[a], 0,
                           "the letter in the column beside makes this number negative; write both into one cell, as "
                           "122.5W: sed -E 's/([0-9.])([,;|\\t])([NSEWnsew])/\\1\\3\\2/g' FILE");
    if (whole && csv->minutes)
      return dyd_span_fail(err, &cell[a], 0,
                           "degrees and minutes are in columns apart; write them into one cell, as 47:36.5 or "
                           "47:36:18.3");
    if (!csv->e7 || !number) continue;
    if (!whole || n > sizeof csv->scaled[a] - 4)
      return dyd_span_fail(err, &cell[a], 0, "columns called E7 hold integers, of 1e-7 degrees; rename others");
    memcpy(csv->scaled[a], cell[a].text, n);
    memcpy(csv->scaled[a] + n, "e-7", 3);
    cell[a].text = csv->scaled[a];
    cell[a].length = n + 3;
  }
  return DYD_OK;
}

/* ---- zones ---- */

size_t dyd_zone_find(const dyd_csv *csv) {
  static const char *const names[] = {"zone", "utm_zone", "utm zone", "utmzone", "zona", "fuseau", "huso"};
  for (size_t k = 0; k < csv->fields && !csv->headless; k++)
    for (size_t n = 0; n < sizeof names / sizeof *names; n++)
      if (csv->field[k].length == strlen(names[n]) && dyd_same_name(csv->field[k].text, names[n], strlen(names[n])))
        return k + 1;
  return 0;
}

void dyd_zone_see(char seen[2][4], const dyd_span *f) {
  char zone[4] = "";
  size_t used = 0;
  for (size_t k = 0; k < f->length && f->length <= 4; k++)
    if (f->text[k] != ' ' && used < 3) zone[used++] = f->text[k];
  dyd_numeral now, before;
  if (!dyd_literal_scan(&now, zone, used, 0, 0) || now.man < 1 || now.man > 60 || used > now.end + 1) return;
  if (!dyd_literal_scan(&before, seen[0], strlen(seen[0]), 0, 0) || now.man != before.man)
    memcpy(seen[seen[0][0] != 0], zone, sizeof zone);
}
