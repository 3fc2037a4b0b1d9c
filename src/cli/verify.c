/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* dyadel verify CERT: checks a certificate and says what of it is proved and what is not. */
#include "cli.h"
#include <errno.h>
#include <string.h>

static void print_pairs(FILE *out, const dyd_certificate_report *r) {
  fprintf(out, "checked: %zu legal pairs, each by its witness against all sites\n", r->legal);
  if (r->sphere && !r->gap)
    fprintf(out, "checked: %zu legal pairs with the place that is projected from\n", r->legal_around);
  if (r->second) fprintf(out, "checked: from a gap between them as well: %zu legal pairs\n", r->second_legal);
  if (r->connected)
    fprintf(out, "checked: %zu sure triangles, %zu sure corners of the hull\n", r->triangles, r->corners);
  if (r->illegal_chains)
    fprintf(out, "checked: %zu illegal pairs within undecided faces, each by its chain\n", r->illegal_chains);
  if (r->illegal_boxes)
    fprintf(out, "checked: %llu illegal pairs within undecided faces, by boxes that cover the plane\n",
            (unsigned long long)r->illegal_boxes);
  if (!r->unproved && !r->capped && !r->around_unproved)
    fprintf(out, "checked: all pairs that are not listed%s are illegal\n",
            r->gap ? ", nor of two neighbours of the gap," : "");
  if ((r->area || r->hausdorff) && !(r->gaps & DYD_GAP_BOUNDS))
    fputs("checked: the bounds of area and Hausdorff distance\n", out);
  if (r->diagram)
    fprintf(out, "checked: the undetermined area of the diagram, by %zu polygons inside cells\n", r->polygons);
  if (r->distance_proved) fputs("checked: the distance of undetermined points to the diagram\n", out);
  if (r->identities || r->tie_bounds)
    fprintf(out, "checked: what points are described to be: %zu identities, %zu bounds\n", r->identities,
            r->tie_bounds);
  if (r->tie > r->ties_unproved)
    fprintf(out, "checked: %zu ties, on empty circles or lines of the hull\n", r->tie - r->ties_unproved);
}

static void print_parts(FILE *out, const dyd_certificate_report *r) {
  if (r->discs)
    fprintf(out, "checked: %zu more legal pairs of the discs by witnesses, %zu illegal ones by blockers\n",
            r->discs_legal, r->discs_illegal);
  if (r->graph)
    fprintf(out, "checked: %zu of %zu edges of the graph %s are certain\n", r->graph_certain, r->graph_rows, r->graph);
  if (r->graph && !(r->gaps & DYD_GAP_GRAPH)) fputs("checked: pairs without a row are no edges of it\n", out);
}

static void print_places(FILE *out, const dyd_certificate_report *r) {
  fprintf(out, "checked: %zu of %zu places have a certain nearest site\n", r->places_certain, r->places);
  if (!r->near_unproved)
    fputs("checked: sites that are not listed are not nearest, distances lie in their bounds\n", out);
}

static void print_proved(FILE *out, const dyd_certificate_report *r) {
  if (r->sphere)
    fprintf(out, "places: %zu on a sphere, projected from %s: %zu images\n", r->sphere_places,
            r->gap ? "a gap between them" : "one of them", r->sites);
  else
    fprintf(out, "sites: %zu, of which %zu aliases\n", r->sites, r->aliases);
  if (r->discs)
    fprintf(out, "about: points in %zu discs%s\n", r->discs, r->discs_fixed ? ", which nothing narrows" : "");
  if (r->bound && !r->unlocated)
    fprintf(out, "checked: the points given %s%s\n",
            r->sphere ? "are its places, with their radii" : "lie in its rectangles",
            r->discs && !r->undescribed ? " and discs" : "");
  if (r->sphere && !r->images_unproved) fputs("checked: each image lies in its rectangle, radii included\n", out);
  if (strcmp(r->goal, "nearest") == 0) {
    print_places(out, r);
  } else {
    print_pairs(out, r);
    print_parts(out, r);
  }
  if (!(r->gaps & DYD_GAP_OUTCOME)) fprintf(out, "checked: the outcome %s\n", r->outcome);
}

/* What is left open, so that there is nothing to prove. */
static void print_open(FILE *out, const dyd_certificate_report *r) {
  if (r->indeterminate) fprintf(out, "open: %zu indeterminate pairs, of which nothing is stated\n", r->indeterminate);
  if (r->capped)
    fprintf(out, "open: %llu pairs within %zu undecided faces: the cap was met, nothing is stated\n",
            (unsigned long long)r->unproved, r->undecided_sets);
}

/* Why an outcome is no more than a word. */
static const char *outcome_reason(const dyd_certificate_report *r) {
  if (strcmp(r->outcome, "fixpoint") == 0)
    return r->bound ? "what is narrowed may decide some of what is open" : "--points may show who cannot be narrowed";
  if (strcmp(r->outcome, "decided") == 0 || strcmp(r->outcome, "certified") == 0)
    return "what it rests on is not proved";
  return "why the run ended leaves no proof";
}

static void print_part_gaps(FILE *out, const dyd_certificate_report *r) {
  if (r->gaps & DYD_GAP_DISCS)
    fprintf(out, "not proved: the statuses of %zu pairs of the discs, which have no witness or blockers\n",
            r->discs_unproved);
  if (r->gaps & DYD_GAP_GRAPH)
    fprintf(out, "not proved: that pairs without a row are no edges of the graph %s (%llu possible ones)\n", r->graph,
            (unsigned long long)r->graph_unproved);
  if (r->gaps & DYD_GAP_NEAREST)
    fprintf(out, "not proved: that %llu sites are not nearest to places that do not list them\n",
            (unsigned long long)r->near_unproved);
}

static void print_gaps(FILE *out, const dyd_certificate_report *r) {
  if (r->gaps & DYD_GAP_IMAGES)
    fprintf(out, "not proved: that %zu rectangles hold the images of their places\n", r->images_unproved);
  if (r->gaps & DYD_GAP_AROUND)
    fprintf(out, "not proved: that %zu images that are not listed are no neighbours of what is projected from\n",
            r->around_unproved);
  if (r->gaps & DYD_GAP_LEGAL)
    fprintf(out, "not proved: that %zu pairs without a witness are legal\n", r->legal_unproved);
  if (r->gaps & DYD_GAP_ILLEGAL)
    fprintf(out, "not proved: that %llu pairs within %zu undecided faces are illegal\n",
            (unsigned long long)r->unproved, r->undecided_sets);
  if (r->gaps & DYD_GAP_TIES) fprintf(out, "not proved: that %zu pairs are ties\n", r->ties_unproved);
  if (r->gaps & DYD_GAP_CLAIMS)
    fprintf(out, "not proved: that %zu callbacks are the roots that their authors say they are\n", r->claims);
  if (r->gaps & DYD_GAP_ALIASES)
    fprintf(out, "not proved: that %zu aliases of points that are not exact are the same points\n",
            r->aliases_unproved);
  if (r->gaps & DYD_GAP_BOUNDS)
    fputs("not proved: the bounds of area and Hausdorff distance, as more pairs may be possible\n", out);
  if (r->gaps & DYD_GAP_DISTANCE) fputs("not proved: the distance of undetermined points to the diagram\n", out);
  print_part_gaps(out, r);
  if (r->gaps & DYD_GAP_OUTCOME) fprintf(out, "not proved: the outcome %s (%s)\n", r->outcome, outcome_reason(r));
  if (r->undescribed)
    fprintf(out, "not proved: that %zu of the points given are what the certificate describes%s\n", r->undescribed,
            r->discs ? " (if radii are those of discs: --discs)" : "");
  if (r->unlocated) fprintf(out, "not proved: that %zu of the points given lie in its rectangles\n", r->unlocated);
}

static dyd_status print_verified(FILE *out, const void *what, const cli_options *o, dyd_error *err) {
  const dyd_certificate_report *r = what;
  (void)o, (void)err;
  if (r->gaps)
    fputs("accepted, not all of it proved: see what is not proved below\n", out);
  else
    fputs("accepted, all of it proved\n", out);
  fprintf(out, "states: outcome %s, goal %s", r->outcome, r->goal);
  if (strcmp(r->goal, "decided") != 0 && strcmp(r->goal, "nearest") != 0) fprintf(out, " %lld", r->goal_bits);
  fputs(r->capped ? ", capped\n" : "\n", out);
  print_proved(out, r);
  print_open(out, r);
  print_gaps(out, r);
  return DYD_OK;
}

/* Reads the points of --points into a new engine and checks against them; what stays goes to `still` (or NULL). */
static dyd_status verify_points(int *status, dyd_certificate_report *report, FILE *still, FILE *in,
                                const cli_options *o, dyd_error *err) {
  dyd_engine *e = NULL;
  cli_options reading = *o;
  const dyd_sphere_options sphere = {DYD_SIZED(dyd_sphere_options), .radius = o->read.radius,
                                     .radius_unit = o->read.radius_unit, .radius_scale = o->read.radius_scale};
  reading.file = o->points;
  if (o->sphere) cli_options_degrees(&reading);
  dyd_status st = dyd_engine_new(&e);
  if (st != DYD_OK) return dyd_error_set(err, st, dyd_status_text(st));
  *status = cli_points_read(e, &reading);
  if (*status == 0)
    st = dyd_verify_certificate_on(report, still, in, e, o->discs, o->sphere ? &sphere : NULL, &o->engine, err);
  dyd_engine_free(e);
  return st;
}

static int complain_rejected(const cli_options *o, const dyd_error *err) {
  const char *rejected = err->code == DYD_E_PARSE ? "rejected: " : "";
  if (err->line)
    cli_complain("%s:%zu: %s%s", o->file, err->line, rejected, err->message);
  else if (err->code == DYD_E_DOMAIN && o->points && err->point == DYD_NO_POINT)
    cli_complain("%s: %s; %s", o->file, err->message, o->sphere ? "leave --sphere away" : "give --sphere");
  else
    cli_complain("%s: %s%s", o->file, rejected, err->message);
  return CLI_FAILED;
}

/* Checks it here; what is wrong was told of, or the report is filled. */
static int verify_here(dyd_certificate_report *report, FILE *still, const cli_options *o) {
  FILE *in = cli_input_open(o->file, "check the name of the certificate");
  if (!in) return CLI_FAILED;
  dyd_error err;
  int status = 0;
  cli_deadline_phase("checking the certificate");
  dyd_error_clear(&err);
  dyd_status st =
      o->points ? verify_points(&status, report, still, in, o, &err) : dyd_verify_certificate(report, in, &err);
  cli_input_close(in);
  if (status) return status;
  return st == DYD_OK ? 0 : complain_rejected(o, &err);
}

/* The proved checker does not read points: it checks the certificate, this program that they are those of it, and which
 * of them stay. */
static int verify_proved_of(const cli_options *o) {
  dyd_certificate_report r = {DYD_SIZED(dyd_certificate_report)};
  char more[200];
  FILE *still = tmpfile();
  if (!still) {
    cli_complain("cannot make a temporary file: %s", strerror(errno));
    return CLI_FAILED;
  }
  int status = verify_here(&r, still, o);
  size_t others = r.undescribed + r.unlocated;
  if (others)
    snprintf(more, sizeof more, "not proved: that %zu of the points given are those of the certificate\n", others);
  else
    snprintf(more, sizeof more,
             "compared by dyadel itself: the points given lie in its rectangles, and which of them stay there\n");
  if (!status) status = cli_verify_proved(o, still, more);
  fclose(still);
  return status == CLI_OK && others ? CLI_FIXPOINT : status;
}

/* "-" can be read once. */
static bool reads_twice(const cli_options *o) {
  if (!o->points || strcmp(o->file, "-") != 0) return false;
  if (strcmp(o->points, "-") == 0)
    cli_complain("standard input cannot be both the certificate and the points; give a file for one of them");
  else if (o->proved)
    cli_complain("with --proved and --points the certificate is read twice; give a file in place of \"-\"");
  else
    return false;
  return true;
}

int cli_verify(const cli_options *o) {
  dyd_certificate_report report = {DYD_SIZED(dyd_certificate_report)};
  if (reads_twice(o)) return CLI_USAGE;
  if (o->proved) return o->points ? verify_proved_of(o) : cli_verify_proved(o, NULL, "");
  int status = verify_here(&report, NULL, o);
  if (!status) status = cli_write_file(o->output, o, print_verified, &report);
  return status || !report.gaps ? status : CLI_FIXPOINT;
}
