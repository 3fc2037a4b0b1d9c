/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Lists of differences. */
#include "picture/html/list.h"

#include <inttypes.h>

void dyd_html_list_begin(dyd_html_list *l, FILE *out, const char *name) {
  *l = (dyd_html_list){.out = out, .between = ""};
  fprintf(out, "\"%s\": [", name);
}

/* Modulo 2^32: a page of so few points reads what is less than 0 as such. */
void dyd_html_list_put(dyd_html_list *l, const uint32_t *number, int count) {
  fprintf(l->out, "%s%" PRId32, l->between, (int32_t)(number[0] - l->before));
  for (int k = 1; k < count; k++) fprintf(l->out, ",%" PRId32, (int32_t)(number[k] - number[0]));
  l->before = number[0];
  l->between = ",";
}

void dyd_html_list_end(dyd_html_list *l) {
  fputc(']', l->out);
}
