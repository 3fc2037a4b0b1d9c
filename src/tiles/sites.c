/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Growing arrays: mail, tables of sites, sets. */
#include "tiles.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool tiles_reserve(void **array, size_t *room, size_t count, size_t size) {
  if (count <= *room) return true;
  size_t more = *room + *room / 2 < 16 ? 16 : *room + *room / 2;
  if (more < count) more = count;
  void *moved = more <= SIZE_MAX / size ? realloc(*array, more * size) : NULL;
  if (!moved) return false;
  *array = moved;
  *room = more;
  return true;
}

dyd_status tiles_fail(dyd_error *err, dyd_status code, const char *format, ...) {
  char message[DYD_MESSAGE_SIZE];
  va_list args;
  va_start(args, format);
  vsnprintf(message, sizeof message, format, args);
  va_end(args);
  return dyd_error_set(err, code, message);
}

dyd_status tiles_no_memory(dyd_error *err) {
  return tiles_fail(err, DYD_E_NOMEM, "memory is exhausted; use more ranks on more machines");
}

bool tiles_mail_put(tiles_mail *m, const void *bytes, size_t count) {
  if (count == 0) return true;
  if (!tiles_reserve((void **)&m->bytes, &m->room, m->count + count, 1)) return false;
  memcpy(m->bytes + m->count, bytes, count);
  m->count += count;
  return true;
}

bool tiles_mail_take(void *out, size_t count, const tiles_mail *m, size_t *read) {
  if (m->count - *read < count) return false;
  memcpy(out, m->bytes + *read, count);
  *read += count;
  return true;
}

void tiles_mail_clear(tiles_mail *m) {
  free(m->bytes);
  *m = (tiles_mail){0};
}

bool tiles_sites_reserve(tiles_sites *s, size_t count) {
  return tiles_reserve((void **)&s->number, &s->room_number, count, sizeof *s->number) &&
         tiles_reserve((void **)&s->end, &s->room_end, count * s->dim, sizeof *s->end);
}

bool tiles_sites_add(tiles_sites *s, uint64_t number, const double *end) {
  if (!tiles_sites_reserve(s, s->count + 1)) return false;
  s->number[s->count] = number;
  memcpy(s->end + s->count * s->dim, end, s->dim * sizeof *end);
  s->count++;
  return true;
}

tiles_box tiles_sites_box(const tiles_sites *s, size_t k) {
  const double *e = s->end + k * s->dim;
  return s->dim == 2 ? (tiles_box){e[0], e[0], e[1], e[1]} : (tiles_box){e[0], e[1], e[2], e[3]};
}

bool tiles_sites_put(tiles_mail *m, const tiles_sites *s, size_t k) {
  return tiles_mail_put(m, &s->number[k], sizeof *s->number) &&
         tiles_mail_put(m, s->end + k * s->dim, s->dim * sizeof *s->end);
}

bool tiles_sites_take(tiles_sites *s, const tiles_mail *m, size_t *read) {
  uint64_t number;
  double end[4];
  while (*read < m->count) {
    if (!tiles_mail_take(&number, sizeof number, m, read) || !tiles_mail_take(end, s->dim * sizeof *end, m, read) ||
        !tiles_sites_add(s, number, end))
      return false;
  }
  return true;
}

void tiles_sites_clear(tiles_sites *s) {
  free(s->number);
  free(s->end);
  *s = (tiles_sites){.dim = s->dim};
}

void tiles_sites_end(tiles_sites *s) {
  free(s->end);
  s->end = NULL;
  s->room_end = 0;
}

tiles_box tiles_view_box(const tiles_view *v, size_t k) {
  double end[4];
  dyd_sites_get_d(end, v->place, k);
  return (tiles_box){end[0], end[1], end[2], end[3]};
}

uint64_t tiles_view_number(const tiles_view *v, size_t k) {
  return k < v->first->count ? v->first->number[k] : v->second->number[k - v->first->count];
}

bool tiles_sites_copy(tiles_sites *s, const tiles_view *v, size_t k) {
  tiles_box b = tiles_view_box(v, k);
  const double end[4] = {b.x0, s->dim == 2 ? b.y0 : b.x1, b.y0, b.y1};
  return tiles_sites_add(s, tiles_view_number(v, k), end);
}

/* ---- sets ---- */

static size_t set_place(const tiles_set *s, uint32_t site) {
  size_t at = (site * 2654435769u) & (s->room - 1);
  while (s->slot[at] && s->slot[at] != site + 1) at = (at + 1) & (s->room - 1);
  return at;
}

bool tiles_set_has(const tiles_set *s, uint32_t site) {
  return s->room && s->slot[set_place(s, site)];
}

static bool set_grow(tiles_set *s) {
  tiles_set wider = {.room = s->room ? 2 * s->room : 64};
  wider.slot = calloc(wider.room, sizeof *wider.slot);
  if (!wider.slot) return false;
  for (size_t k = 0; k < s->room; k++)
    if (s->slot[k]) wider.slot[set_place(&wider, s->slot[k] - 1)] = s->slot[k];
  free(s->slot);
  wider.count = s->count;
  *s = wider;
  return true;
}

bool tiles_set_add(tiles_set *s, uint32_t site) {
  if (2 * (s->count + 1) > s->room && !set_grow(s)) return false;
  size_t at = set_place(s, site);
  if (!s->slot[at]) s->count++;
  s->slot[at] = site + 1;
  return true;
}

void tiles_set_clear(tiles_set *s) {
  free(s->slot);
  *s = (tiles_set){0};
}
