/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The text of --window to a rectangle; numbers of other options. */
#include "cli.h"
#include <string.h>

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
  dyd_real *real = NULL;
  dyd_status st = dyd_real_from_interval(&real, lo, hi);
  if (st == DYD_OK) dyd_interval_set(out, dyd_real_interval(real));
  dyd_real_free(real);
  return st;
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
  cli_complain("--window \"%s\" %s", text, wrong);
  return CLI_USAGE;
}

int cli_number_read(mpq_ptr out, const char *name, const char *text) {
  dyd_status st = dyd_real_parse_exact(out, text, strlen(text));
  if (st == DYD_OK && mpq_sgn(out) >= 0) return 0;
  if (st == DYD_E_NOMEM) return cli_complain_memory();
  cli_complain("--%s \"%s\" is not understood; give an exact number of 0 or more, such as 0.01", name, text);
  return CLI_USAGE;
}
