/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* --oracle COMMAND: the points come from programs of the user. */
#include "cli.h"

#include <string.h>

static int oracle_add(dyd_engine *e, dyd_oracle *oracle) {
  dyd_source source = {DYD_SIZED(dyd_source)};
  dyd_status st = dyd_oracle_source(&source, oracle, NULL);
  if (st == DYD_OK) st = dyd_engine_add_source(e, dyd_oracle_count(oracle), &source, NULL);
  if (st == DYD_OK) return 0;
  cli_complain("the points of the oracle cannot be added: %s", dyd_status_text(st));
  return CLI_FAILED;
}

int cli_oracle_read(dyd_engine *e, const cli_options *o) {
  const dyd_read_options *r = &o->read;
  const char *no = r->columns          ? "--columns"
                   : r->measured       ? "--measured"
                   : r->radius         ? "--radius"
                   : r->radius_columns ? "--radius-column"
                   : r->radius_unit    ? "--radius-unit"
                   : r->radius_scale   ? "--radius-scale"
                   : r->id             ? "--id"
                   : r->delimiter      ? "--delimiter"
                   : r->decimal_comma  ? "--decimal-comma"
                   : r->skip_missing   ? "--skip-missing"
                   : r->merge          ? "--merge"
                   : r->cost_column    ? "--cost-column"
                                       : NULL;
  if (no) {
    cli_complain("%s is for points files; leave it out, and let the oracle %s", no,
                 strcmp(no, "--cost-column") ? "answer with what you mean" : "begin with \"points N cost C ... C\"");
    return CLI_USAGE;
  }
  dyd_oracle *oracle = NULL;
  dyd_error err;
  dyd_error_clear(&err);
  const dyd_oracle_options options = {DYD_SIZED(dyd_oracle_options), .jobs = o->oracle_jobs, .batch = o->oracle_batch,
                                      .retries = o->oracle_retries, .seconds = o->oracle_timeout};
  if (dyd_oracle_new(&oracle, o->oracle, &options, &err) != DYD_OK) {
    cli_complain("%s", err.message);
    return CLI_FAILED;
  }
  int status = oracle_add(e, oracle);
  dyd_oracle_free(oracle);
  return status;
}
