/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Identifiers of points in results. They come from files of users: any bytes may be in them. */
#include "io/label_text.h"

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

/* The length of the character of UTF-8 at p: 1 to 4; 0: it is none (RFC 3629: shortest forms, no surrogates). */
static size_t utf8_length(const unsigned char *p) {
  size_t n = p[0] < 0x80 ? 1 : p[0] < 0xC2 ? 0 : p[0] < 0xE0 ? 2 : p[0] < 0xF0 ? 3 : p[0] < 0xF5 ? 4 : 0;
  for (size_t k = 1; k < n; k++)
    if ((p[k] & 0xC0) != 0x80) return 0;
  if (n == 3 && ((p[0] == 0xE0 && p[1] < 0xA0) || (p[0] == 0xED && p[1] >= 0xA0))) return 0;
  if (n == 4 && ((p[0] == 0xF0 && p[1] < 0x90) || (p[0] == 0xF4 && p[1] >= 0x90))) return 0;
  return n;
}

void dyd_sink_json_text(dyd_sink *s, const char *text) {
  const unsigned char *p = (const unsigned char *)text;
  dyd_sink_text(s, "\"");
  for (size_t n; *p; p += n ? n : 1) {
    n = utf8_length(p);
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

/* Is it worth a place in a picture? */
static bool label_is_plain(const char *text) {
  const unsigned char *p = (const unsigned char *)text;
  if (!*p || strlen(text) >= DYD_LABEL_SIZE) return false;
  for (size_t n; *p; p += n) {
    n = utf8_length(p);
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
