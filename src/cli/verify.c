/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* dyadel verify CERT: checks a certificate and says what was checked and what was not. */
#include "cli.h"
#include <string.h>

static void print_proved(FILE *out, const dyd_certificate_report *r) {
  fprintf(out, "sites: %zu, of which %zu aliases\n", r->sites, r->aliases);
  fprintf(out, "checked: %zu legal pairs, each by its witness against all sites\n", r->legal);
  if (r->connected)
    fprintf(out, "checked: %zu sure triangles, %zu sure corners of the hull\n", r->triangles, r->corners);
  else
    fputs("not checked: faces, since legal pairs and bridges do not connect all sites\n", out);
  if (r->illegal_chains)
    fprintf(out, "checked: %zu illegal pairs within undecided faces, each by its chain\n", r->illegal_chains);
  if (r->area || r->hausdorff) fputs("checked: the bounds of area and Hausdorff distance, for the pairs listed\n", out);
}

static void print_proved_diagram(FILE *out, const dyd_certificate_report *r) {
  if (!r->diagram) return;
  fprintf(out, "checked: the undetermined area of the diagram, by %zu polygons inside cells\n", r->polygons);
  if (r->distance_proved)
    fputs("checked: the distance of undetermined points to the diagram\n", out);
  else if (r->distance)
    fputs("not checked: the distance of undetermined points to the diagram, which is stated without a proof\n", out);
  if (r->distance && !r->distance_proved && strcmp(r->outcome, "certified") == 0 &&
      strcmp(r->goal, "voronoi hausdorff") == 0)
    fputs("not checked: the outcome, as the goal is about that distance\n", out);
}

static void print_unproved(FILE *out, const dyd_certificate_report *r) {
  size_t open = r->indeterminate + r->tie + r->legal_unproved;
  if (r->unproved)
    fprintf(out, "not checked: that %llu pairs within %zu undecided faces are %s\n", (unsigned long long)r->unproved,
            r->undecided_sets, r->capped ? "possible or not (the cap was met: nothing is stated)" : "illegal");
  else
    fputs("checked: all pairs that are not listed are illegal\n", out);
  if (open)
    fprintf(out, "nothing to check: %zu indeterminate pairs, %zu ties, %zu legal pairs without a witness\n",
            r->indeterminate, r->tie, r->legal_unproved);
}

static dyd_status print_verified(FILE *out, const void *what, const cli_options *o, dyd_error *err) {
  const dyd_certificate_report *r = what;
  (void)o, (void)err;
  fprintf(out, "accepted: outcome %s, goal %s", r->outcome, r->goal);
  if (strcmp(r->goal, "decided") != 0) fprintf(out, " %lld", r->goal_bits);
  fputs(r->capped ? ", capped\n" : "\n", out);
  print_proved(out, r);
  print_unproved(out, r);
  print_proved_diagram(out, r);
  if (strcmp(r->outcome, "decided") != 0 && strcmp(r->outcome, "certified") != 0)
    fprintf(out, "not checked: why the run ended (%s)\n", r->outcome);
  return DYD_OK;
}

int cli_verify(const cli_options *o) {
  FILE *in = cli_input_open(o->file, "check the name of the certificate");
  if (!in) return CLI_FAILED;
  dyd_error err;
  dyd_certificate_report report = {DYD_SIZED(dyd_certificate_report)};
  dyd_status st = dyd_verify_certificate(&report, in, &err);
  cli_input_close(in);
  if (st == DYD_E_PARSE)
    cli_complain("%s:%zu: rejected: %s", o->file, err.line, err.message);
  else if (st != DYD_OK)
    cli_complain("%s: %s", o->file, err.message);
  if (st != DYD_OK) return CLI_FAILED;
  return cli_write_file(o->output, o, print_verified, &report);
}
