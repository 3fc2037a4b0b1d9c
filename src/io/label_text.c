/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Identifiers of points in results. They come from files of users: any bytes may be in them. */
#include "io/label_text.h"
#include "io/read/text.h"

#include <stdbool.h>
#include <string.h>

void dyd_sink_csv_text(dyd_sink *s, const char *text) {
  size_t n = strlen(text);
  if (!text[strcspn(text, ",;\t|\"\r\n")] && text[0] != ' ' && (!n || text[n - 1] != ' ')) {
    dyd_sink_put(s, text, n);
    return;
  }
  dyd_sink_text(s, "\"");
  for (; *text; text++) dyd_sink_put(s, *text == '"' ? "\"\"" : text, *text == '"' ? 2 : 1);
  dyd_sink_text(s, "\"");
}

void dyd_sink_json_text(dyd_sink *s, const char *text) {
  const unsigned char *p = (const unsigned char *)text;
  dyd_sink_text(s, "\"");
  for (size_t n; *p; p += n ? n : 1) {
    n = dyd_utf8_length((const char *)p, 4);
    if (!n)
      dyd_sink_text(s, "\\ufffd");
    else if (*p == '"' || *p == '\\')
      dyd_sink_put(s, (const char[]){'\\', (char)*p}, 2);
    else if (*p < 0x20)
      s->end += sprintf(dyd_sink_room(s, sizeof "\\u001f"), "\\u%04x", *p);
    else
      dyd_sink_put(s, (const char *)p, n);
  }
  dyd_sink_text(s, "\"");
}

/* Returns true if it is worth a place in a picture. */
static bool label_is_plain(const char *text) {
  const unsigned char *p = (const unsigned char *)text;
  if (!*p || strlen(text) >= DYD_LABEL_SIZE) return false;
  for (size_t n; *p; p += n) {
    n = dyd_utf8_length((const char *)p, 4);
    if (!n || *p < 0x20 || *p == 0x7f) return false;
  }
  return true;
}

const char *dyd_label_text(char spare[DYD_LABEL_SIZE], const dyd_engine *e, size_t site) {
  const char *id = dyd_engine_id(e, site);
  if (id && label_is_plain(id)) return id;
  snprintf(spare, DYD_LABEL_SIZE, "%zu", dyd_engine_row(e, site));
  return spare;
}
