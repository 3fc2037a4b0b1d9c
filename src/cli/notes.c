/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Notes on the points that were read: rows skipped, points merged, and values with another possible meaning. */
#include "cli.h"

#include <math.h>

/* Returns true if all points can be places on the globe. */
static bool points_are_degrees(const dyd_engine *e) {
  double b[4];
  bool good = dyd_engine_count(e) > 0;
  for (size_t i = 0; good && i < dyd_engine_count(e); i++) {
    if (!dyd_engine_knows(e, (uint32_t)i)) continue;
    dyd_sites_get_d(b, dyd_engine_sites(e), i);
    good = b[0] >= -180 && b[1] <= 180 && b[2] >= -90 && b[3] <= 90;
  }
  return good;
}

void cli_note_lines(const cli_options *o, const dyd_read_report *r) {
  if (!r->rows) cli_note(o, "%s: there are no points in this file", o->file);
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

void cli_note_points(const dyd_engine *e, const cli_options *o, const dyd_read_report *r) {
  cli_note_lines(o, r);
  if (r->vertices) cli_note(o, "%s: the vertices of lines and polygons are the points: %zu", o->file, r->vertices);
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
