/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Text on its way to a file: blocks, the digits of whole numbers, and texts of users, which may hold any bytes. */
#include "io/sink.h"

#include "io/read/text.h"

#include <stdbool.h>
#include <string.h>

void dyd_sink_flush(dyd_sink *s) {
  fwrite(s->block, 1, (size_t)(s->end - s->block), s->out);
  s->end = s->block;
}

void dyd_sink_put_long(dyd_sink *s, const char *text, size_t length) {
  dyd_sink_flush(s);
  fwrite(text, 1, length, s->out);
}

static const char two_digits[] =
    "0001020304050607080910111213141516171819202122232425262728293031323334353637383940414243"
    "4445464748495051525354555657585960616263646566676869707172737475767778798081828384858687"
    "888990919293949596979899";

static int digits_of(uint64_t n) {
  int count = 1;
  for (; n >= 10000; n /= 10000) count += 4;
  return count + (n >= 10) + (n >= 100) + (n >= 1000);
}

char *dyd_put_digits(char *to, uint64_t n) {
  char *end = to + digits_of(n), *p = end;
  for (; n >= 100; n /= 100) memcpy(p -= 2, two_digits + 2 * (n % 100), 2);
  if (n >= 10)
    memcpy(to, two_digits + 2 * n, 2);
  else
    *to = (char)('0' + n);
  return end;
}

void dyd_sink_line(dyd_sink *s, const char *word, const uint32_t *n, size_t count, uint32_t more) {
  dyd_sink_text(s, word);
  for (size_t k = 0; k < count; k++) {
    dyd_sink_put(s, " ", 1);
    dyd_sink_index(s, (uint64_t)n[k] + more);
  }
  dyd_sink_put(s, "\n", 1);
}

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
