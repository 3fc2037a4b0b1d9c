/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The images of places, as the engine of images asks for them.
 *
 * What is asked for is a width of the image; the widths of place and centre that it takes, and the bits of the
 * computation, are found by trying: what is missing is added. Images of wide places, or seen from a wide centre, or of
 * circles, stay wide; they are final once their place and centre are, or are narrow beside what is wide. */
#include "base/error.h"
#include "base/flag.h"
#include "engine/points.h"
#include "rect/rect.h"
#include "sphere/state.h"
#include "stream/ball.h"
#include "stream/stream.h"

enum { GUARD = 64, SPARE = 8, TRIES = 12, WIDE_BITS = 128 };

/* What is asked of an image. */
typedef struct image_wish {
  int64_t bits, max_bits;
  const volatile int *stop; /* as in dyd_request */
} image_wish;

static dyd_status place_narrow(const dyd_sphere *s, uint32_t i, const image_wish *w, dyd_error *err) {
  if (dyd_sphere_is_fixed(s, i)) return DYD_OK;
  dyd_status st = dyd_stream_narrow_until(s->stream[i], w->bits, w->max_bits, w->stop, err);
  return st == DYD_CANCELLED || dyd_failed(st) ? st : DYD_OK;
}

/* The centre, at least so narrow; a box. */
static dyd_status centre_narrow(dyd_sphere *s, const image_wish *w, dyd_error *err) {
  if (s->eye_bits >= w->bits) return DYD_OK;
  dyd_status st = place_narrow(s, s->centre, w, err);
  if (st == DYD_OK) st = dyd_sphere_spot(&s->eye.spot, s, s->centre, err);
  if (st != DYD_OK) return st;
  dyd_spot_box(&s->eye.spot);
  s->eye.prec = 0;
  s->eye_bits = dyd_sphere_is_fixed(s, s->centre) ? INT64_MAX : w->bits;
  return DYD_OK;
}

/* One image on its way. */
typedef struct image {
  dyd_sphere *s;
  uint32_t i;
  dyd_spot spot;
  arb_t x, y;
  bool moving, wide; /* a stream is concerned; something stays wide whatever is asked */
} image;

static slong image_width(const image *m) {
  slong x = dyd_ball_radius_exponent(m->x), y = dyd_ball_radius_exponent(m->y);
  return x > y ? x : y;
}

/* One try; *seen: place and centre are apart. */
static dyd_status image_try(bool *seen, image *m, const image_wish *w, dyd_error *err) {
  dyd_sphere *s = m->s;
  dyd_status st = place_narrow(s, m->i, w, err);
  if (st == DYD_OK) st = centre_narrow(s, w, err);
  if (st == DYD_OK) st = dyd_sphere_spot(&m->spot, s, m->i, err);
  if (st != DYD_OK) return st;
  m->wide = m->spot.stays || s->eye.spot.stays;
  m->moving = !dyd_sphere_is_fixed(s, m->i) || s->eye_bits != INT64_MAX;
  slong prec = (slong)(w->bits < WIDE_BITS && m->wide ? WIDE_BITS : w->bits) + SPARE;
  s->eye.stop = w->stop;
  *seen = dyd_project(m->x, m->y, &m->spot, &s->eye, prec < GUARD ? GUARD : prec);
  return dyd_flag_is_set(w->stop) ? DYD_CANCELLED : DYD_OK;
}

static dyd_status image_fail(const image *m, dyd_error *err) {
  if (m->s->free)
    return dyd_fail(err, DYD_E_DOMAIN,
                    "it may be nearly anywhere, and no place of the sphere is apart from all points; give a smaller "
                    "radius, or `merge` where points that meet are one place");
  return dyd_fail(err, DYD_E_DOMAIN,
                  "it cannot be told from point %zu, from which the sphere is projected; narrow one of them, or give "
                  "`merge` where both are one place",
                  dyd_engine_row(m->s->places, m->s->centre));
}

/* Tries until the image is as narrow as asked for; or will not be, as what stays wide is wide beside what moves; or
 * max_bits are reached. */
static dyd_status image_find(image *m, const image_wish *w, dyd_error *err) {
  int64_t more = SPARE, most = (w->max_bits > w->bits ? w->max_bits : w->bits) + GUARD;
  bool seen = false;
  for (int k = 0; k < TRIES; k++) {
    image_wish now = {w->bits + more < most ? w->bits + more : most, most, w->stop};
    dyd_status st = image_try(&seen, m, &now, err);
    if (st != DYD_OK) return st;
    if (seen && image_width(m) <= -w->bits - 2) return DYD_OK;
    if (now.bits == most || (m->wide && (!m->moving || k > 1))) break;
    more += seen ? image_width(m) + w->bits + SPARE : GUARD << k;
  }
  return seen ? DYD_OK : image_fail(m, err);
}

/* Rounds outward, keeps to what was known before. */
static dyd_status image_give(dyd_rect *out, const image *m, bool known, int64_t bits) {
  dyd_rect now;
  slong width = image_width(m) - 16;
  int64_t grid = m->wide && width > -bits - 2 - GUARD ? width : -bits - 2;
  dyd_rect_init(&now);
  dyd_status st = dyd_ball_interval(&now.x, m->x, grid);
  if (st == DYD_OK) st = dyd_ball_interval(&now.y, m->y, grid);
  if (st == DYD_OK && known) st = dyd_interval_intersect(&now.x, &now.x, &out->x);
  if (st == DYD_OK && known) st = dyd_interval_intersect(&now.y, &now.y, &out->y);
  if (st == DYD_OK) dyd_rect_swap(out, &now);
  dyd_rect_clear(&now);
  return st;
}

static void image_init(image *m, dyd_sphere *s, uint32_t i) {
  *m = (image){.s = s, .i = i};
  dyd_spot_init(&m->spot);
  arb_init(m->x);
  arb_init(m->y);
}

static void image_clear(image *m) {
  arb_clear(m->y);
  arb_clear(m->x);
  dyd_spot_clear(&m->spot);
}

static dyd_status image_request(dyd_rect *out, void *user, const dyd_request *request, dyd_error *err) {
  dyd_sphere *s = user;
  image m;
  image_init(&m, s, s->of[request->point]);
  dyd_status st = image_find(&m, &(image_wish){request->bits, request->max_bits, request->stop}, err);
  if (st == DYD_OK) st = image_give(out, &m, dyd_engine_knows(s->images, (uint32_t)request->point), request->bits);
  if (st == DYD_OK && m.wide && (!m.moving || request->bits >= WIDE_BITS)) st = DYD_FIXED;
  image_clear(&m);
  return st;
}

/* An image that is known without its source having been asked may be narrower than its place would have it. */
dyd_status dyd_sphere_narrow_recalled(dyd_sphere *s, int64_t max_bits, dyd_error *err) {
  dyd_status st = DYD_OK;
  image m;
  for (uint32_t k = 0; k < s->with_image && st == DYD_OK; k++) {
    if (dyd_sphere_is_fixed(s, s->of[k])) continue;
    const dyd_refinable *p = dyd_engine_find(s->images, k);
    if (!p || !p->measured) continue;
    image_init(&m, s, s->of[k]);
    st = image_find(&m, &(image_wish){p->bits, max_bits, NULL}, err);
    if (st != DYD_OK && err) err->point = k;
    image_clear(&m);
  }
  return st;
}

/* ---- a first look ---- */

/* The centre in doubles, where it is an exact place. */
static bool eye_glance(dyd_eye_d *out, dyd_sphere *s) {
  if (!s->free && !dyd_sphere_is_fixed(s, s->centre)) return false;
  if (centre_narrow(s, &(image_wish){0, 0, NULL}, NULL) != DYD_OK || !dyd_spot_is_exact(&s->eye.spot)) return false;
  dyd_eye_enclose(out, &s->eye);
  return true;
}

/* Doubles tell the image of an exact place to some 45 bits, that of a wide one to fewer: returns false where they do
 * not tell it to as many as are asked for. */
static bool image_glance(double box[4], void *user, size_t point, int64_t bits) {
  dyd_sphere *s = user;
  dyd_spot_d place;
  if (!dyd_sphere_is_fixed(s, s->of[point])) return false;
  if (dyd_sphere_spot_d(&place, s, s->of[point], NULL) != DYD_OK) return false;
  return dyd_filter_image(box, &place, &s->eye_d, bits);
}

dyd_status dyd_sphere_add_images(dyd_sphere *s, dyd_error *err) {
  const dyd_source source = {DYD_SIZED(dyd_source), .narrow = image_request, .user = s};
  if (!s->with_image) return DYD_OK;
  dyd_status st = dyd_engine_add_source(s->images, s->with_image, &source, err);
  if (st == DYD_OK && eye_glance(&s->eye_d, s)) dyd_engine_set_glance(s->images, image_glance);
  return st;
}
