/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Notes on the points that were read: rows skipped, points merged, and values with another possible meaning. */
#include "cli.h"

#include <math.h>
#include <string.h>
#include <strings.h>

/* The box of point i in doubles; false: it is not known yet. */
static bool known_box(double b[4], const dyd_engine *e, size_t i) {
  bool known = dyd_engine_knows(e, (uint32_t)i);
  if (known) dyd_sites_get_d(b, dyd_engine_sites(e), i);
  return known;
}

/* Returns true if all points can be places on the globe. */
static bool points_are_degrees(const dyd_engine *e) {
  double b[4];
  bool good = dyd_engine_count(e) > 0;
  for (size_t i = 0; good && i < dyd_engine_count(e); i++) {
    if (!known_box(b, e, i)) continue;
    good = b[0] >= -180 && b[1] <= 180 && b[2] >= -90 && b[3] <= 90;
  }
  return good;
}

void cli_note_lines(const cli_options *o, const dyd_read_report *r) {
  if (!r->rows) cli_note(o, "%s: this file has no points", o->file);
  if (r->missing)
    cli_note(o,
             "%s: %zu of %zu rows are skipped because a coordinate or radius is missing; the others keep their numbers",
             o->file, r->missing, r->rows);
  if (r->commented)
    cli_note(o, "%s: lines that begin with # or %% and may be rows: %zu; they are skipped as comments", o->file,
             r->commented);
  if (r->recoded)
    cli_note(o,
             "%s: lines that are not UTF-8: %zu; they are read as Windows-1252 (Latin-1); for another encoding give "
             "iconv -f ENCODING -t UTF-8 %s | dyadel %s ... -",
             o->file, r->recoded, o->file, o->command ? o->command : "nearest FILE --queries");
}

void cli_shell_name(char *out, size_t size, const char *name) {
  static const char plain[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_./-+:,=@%";
  if (!name[strspn(name, plain)]) {
    snprintf(out, size, "%s", name);
    return;
  }
  size_t n = 0;
  out[n++] = '\'';
  for (; *name && n + 6 < size; name++) {
    if (*name == '\'') n += (size_t)snprintf(out + n, size - n, "'\\'");
    out[n++] = *name;
  }
  snprintf(out + n, size - n, "'");
}

/* k is shown rounded up. */
static void note_confidence(const dyd_engine *e, const cli_options *o) {
  dyd_confidence c = {DYD_SIZED(dyd_confidence)};
  if (!dyd_engine_confidence(&c, e)) return;
  const char *digit = c.probability + 2, *rest = digit[1] ? digit + 2 : ""; /* behind "0." */
  int percent = 10 * (digit[0] - '0') + (digit[1] ? digit[1] - '0' : 0);
  cli_note(o,
           "%s: with probability at least %d%s%s %% everything stated here holds: then all %zu points with errors are "
           "within k = %.4f standard deviations",
           o->file, percent, *rest ? "." : "", rest, c.n, ceil(c.k * 1e4) / 1e4);
}

static void note_repeated(const dyd_engine *e, const cli_options *o, const dyd_read_report *r) {
  size_t i = 0;
  while (i < dyd_engine_count(e) && dyd_engine_row(e, i) != r->repeat[0]) i++;
  const char *id = dyd_engine_id(e, i);
  cli_note(o,
           "%s: rows %zu and %zu are both \"%.60s\"; rows with the identifier of an earlier one: %zu (if they are one "
           "point: --merge-by id)",
           o->file, r->repeat[0], r->repeat[1], id ? id : "", r->repeated);
}

/* What the name of a column of radii says of its numbers. part: the word is a part of it. scale: what makes standard
 * deviations of them; NULL: give is to be given. */
static const struct radius_name {
  const char *word;
  bool part;
  const char *what, *scale, *give;
} radius_names[] = {
    {"ce90", false, "circles that hold 90 % of positions, each", " --radius-scale 0.466", NULL},
    {"ce95", false, "circles that hold 95 % of positions, each", " --radius-scale 0.409", NULL},
    {"cep", false, "circles that hold half of the positions", " --radius-scale 0.85", NULL},
    {"2drms", false, "circles that hold about 97 % of positions, each", " --radius-scale 0.354", NULL},
    {"dop", false, "factors of an error", NULL, "--radius-scale with the error of the receiver, such as 3"},
    {"variance", false, "squares of standard deviations", NULL, "a column of their roots to --sigma-column"},
    {"rms", false, "standard deviations", "", NULL},
    {"sigma", false, "standard deviations", "", NULL},
    {"std", false, "standard deviations", "", NULL},
    {"sd", true, "standard deviations", "", NULL},
    {"sde", true, "standard deviations", "", NULL},
    {"sdn", true, "standard deviations", "", NULL},
    {"mm", true, "millimetres", NULL, "--radius-scale 0.001 if those are metres"},
    {"cm", true, "centimetres", NULL, "--radius-scale 0.01 if those are metres"},
    {"km", true, "kilometres", NULL, "--radius-scale 1000 if those are metres"},
    {"ft", true, "feet", NULL, "--radius-scale 0.3048 if those are metres"},
    {"in", true, "inches", NULL, "--radius-scale 0.0254 if those are metres"}};

static bool is_unit(const struct radius_name *r) {
  return r->give && strstr(r->give, "if those are metres");
}

static bool is_name_letter(char c) {
  return (c | 0x20) >= 'a' && (c | 0x20) <= 'z';
}

static bool name_says(const char *name, const struct radius_name *r) {
  size_t n = strlen(r->word);
  for (const char *at = name; *at; at++)
    if (strncasecmp(at, r->word, n) == 0 &&
        (!r->part || ((at == name || !is_name_letter(at[-1])) && !is_name_letter(at[n]))) &&
        (*r->word != 'i' || strchr(")]", at[n]))) /* "error in m" */
      return true;
  return false;
}

/* Radii bound an error; a name may say that these do not, or in which unit they or standard deviations are. */
static void note_radii(const cli_options *o) {
  const bool sigma = !o->read.radius_columns;
  const char *names = sigma ? o->read.sigma_column : o->read.radius_columns;
  const struct radius_name *r = radius_names, *end = r + sizeof radius_names / sizeof *radius_names;
  char typed[160];
  if (!names || o->read.radius_scale || o->content == DYD_CONTENT_TOLERANCE) return;
  while (r < end && !((is_unit(r) || !sigma) && name_says(names, r))) r++;
  if (r == end || (o->sphere && is_unit(r))) return;
  cli_shell_name(typed, sizeof typed, names);
  cli_note(o, "%s: by the name \"%.60s\" its numbers are %s; they are taken as %s%s: give %s%s%s%s", o->file, names,
           r->what, sigma ? "standard deviations" : "bounds", o->sphere ? "" : " in the unit of the coordinates",
           r->scale ? "--sigma-column " : r->give, r->scale ? typed : "", r->scale ? r->scale : "",
           r->scale ? " --confidence 95%" : "");
}

/* Points both of whose coordinates are a number that many programs write for none. 0 is one where degrees are meant and
 * nothing else is on the equator or the first meridian. */
static void note_nowhere(const dyd_engine *e, const cli_options *o, bool degrees) {
  static const double none[] = {0, -9999, -99999, -999999, -999, 9999, 99999, -32768, 1e20, 1e30, -1e30};
  double b[4];
  size_t found = 0, k = 0, at = 0, zeros = 0;
  for (size_t i = 0; i < dyd_engine_count(e) && !o->read.missing; i++) {
    if (!known_box(b, e, i)) continue;
    zeros += (b[0] <= 0 && b[1] >= 0) != (b[2] <= 0 && b[3] >= 0);
    if (b[0] != b[2] || b[0] != b[1] || b[0] != b[3]) continue;
    for (k = !degrees; k < sizeof none / sizeof *none && none[k] != b[0];) k++;
    if (k < sizeof none / sizeof *none && !found++) at = k;
  }
  if (found && (at || !zeros) && found < dyd_engine_count(e))
    cli_note(o,
             "%s: points with %g for both coordinates: %zu; if it means a missing value, give --missing %g "
             "--skip-missing",
             o->file, none[at], found, none[at]);
}

/* Receivers and phones state 0 where they do not know their accuracy; here it makes a point exact. */
static void note_zero_radii(const dyd_engine *e, const cli_options *o) {
  double b[4];
  size_t zeros = 0;
  bool any = (o->read.radius_columns || (o->read.sigma_column && o->read.confidence)) && !o->read.radius &&
             !o->read.missing && !o->read.keep_radii;
  for (size_t i = 0; any && i < dyd_engine_count(e); i++) {
    if (dyd_engine_number(e, i, DYD_ROW_RADIUS) > 0 || !known_box(b, e, i)) continue;
    zeros += b[1] <= nextafter(b[0], INFINITY) && b[3] <= nextafter(b[2], INFINITY);
  }
  if (zeros)
    cli_note(o,
             "%s: radii that are 0: %zu; these points are taken as exact; if 0 means that the accuracy is unknown, "
             "leave such rows out: --missing 0 --skip-missing",
             o->file, zeros);
}

/* Columns called longitude and latitude in the plane that hold ddmm.mmmm, as sentences of receivers do. */
static void note_minutes(const dyd_engine *e, const cli_options *o, const dyd_read_report *r) {
  double b[4], most = 0;
  bool all = r->degrees && !o->sphere && !o->plane;
  for (size_t i = 0; all && i < dyd_engine_count(e); i++) {
    if (!known_box(b, e, i)) continue;
    most = fmax(most, fabs(b[2]));
    all = fabs(b[0]) < 18100 && fabs(b[2]) < 9100 && fmod(fabs(b[0]), 100) < 60 && fmod(fabs(b[2]), 100) < 60;
  }
  if (all && most > 90)
    cli_note(o,
             "%s: the columns are longitude and latitude by their names, and hold degrees and minutes (ddmm.mmmm); for "
             "degrees give sed -E 's/([0-9]+)([0-9]{2}\\.[0-9]+)/\\1:\\2/g' %s | dyadel %s ... -",
             o->file, o->file, o->command);
}

/* Eastings with the number of a zone in front (Gauss-Krueger, UTM), of several zones: each is within 300 km of the
 * middle of its zone, which is 500 km. */
static void note_eastings(const dyd_engine *e, const cli_options *o) {
  double b[4], zone[2] = {0, 0};
  bool all = o->read.columns && !o->sphere && dyd_engine_count(e) > 2;
  for (size_t i = 0; all && i < dyd_engine_count(e); i++) {
    if (!known_box(b, e, i)) continue;
    const double own = floor(b[0] / 1e6);
    all = own >= 1 && own <= 60 && b[2] >= 0 && b[2] < 1e7 && fabs(b[0] - own * 1e6 - 5e5) < 3e5;
    if (!zone[0]) zone[0] = own;
    if (own != zone[0]) zone[1] = own;
  }
  if (all && zone[1])
    cli_note(
        o,
        "%s: x seems to begin with numbers of zones, %g and %g; coordinates of several zones are not of one plane: "
        "transform them to one system first",
        o->file, zone[0], zone[1]);
}

/* The reference system and the coordinates: degrees both, or neither. */
static void note_system(const dyd_engine *e, const cli_options *o, const dyd_read_report *r) {
  if (!o->epsg || o->sphere || !dyd_engine_count(e)) return;
  const bool known = cli_crs_is_degrees(o->epsg);
  if (known == points_are_degrees(e) || (!known && !r->degrees)) return;
  cli_note(o, "%s: EPSG:%u is %s, and the coordinates are %s; give their own reference system to --crs", o->file,
           o->epsg, known ? "a system of degrees" : "not known as a system of degrees",
           known ? "beyond 180 or 90" : "longitude and latitude by their names or letters");
}

void cli_note_points(const dyd_engine *e, const cli_options *o, const dyd_read_report *r) {
  cli_note_lines(o, r);
  if (r->vertices) cli_note(o, "%s: the vertices of lines and polygons are the points: %zu", o->file, r->vertices);
  note_radii(o);
  if (o->read.columns) note_nowhere(e, o, o->sphere || r->degrees);
  note_zero_radii(e, o);
  note_system(e, o, r);
  note_minutes(e, o, r);
  note_eastings(e, o);
  if (r->zone[1][0] && !o->sphere)
    cli_note(
        o,
        "%s: the column of zones has %s and %s; coordinates of several zones are not of one plane: transform them to "
        "one system first, or give longitude and latitude with --sphere",
        o->file, r->zone[0], r->zone[1]);
  note_confidence(e, o);
  if (r->merged)
    cli_note(o, "%s: %zu row%s merged with earlier ones of equal %s", o->file, r->merged,
             r->merged == 1 ? " is" : "s are", o->read.merge_by ? "identifiers" : "coordinates");
  if (r->repeated) note_repeated(e, o, r);
  if (r->shared)
    cli_note(o,
             "%s: %zu rectangles have the centre of another one, so pairs next to them cannot be decided (if "
             "equal coordinates are one point: --merge)",
             o->file, r->shared);
  if (r->swapped && !o->plane)
    cli_note(
        o,
        "%s: by their names or letters the columns are latitude and longitude, or northing and easting, and are taken "
        "as x and y: a mirrored map; exchange the two, or give --plane if that is meant",
        o->file);
  if (r->degrees && !o->sphere && !o->plane && points_are_degrees(e))
    cli_note(o,
             "%s: the columns are longitude and latitude by their names or letters, and taken as coordinates in a "
             "plane; for "
             "neighbours on the globe give delaunay or voronoi --sphere; --plane says that the plane is meant",
             o->file);
}

void cli_note_area(const dyd_engine *e, const cli_options *o, const dyd_rect *window) {
  double b[4], w[4];
  dyd_rect_get_d(w, window);
  for (size_t i = 0; i < dyd_engine_count(e); i++)
    if (!known_box(b, e, i) || (b[1] >= w[0] && b[0] <= w[1] && b[3] >= w[2] && b[2] <= w[3])) return;
  if (dyd_engine_count(e))
    cli_note(o, "%s: no point is within the bounds of the polygons; do both have the same reference system?",
             o->clip_to);
}
