/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Before the first insertion: coordinates, filter constants, the first triangle, coincident representatives; and the
 * end. */
#ifndef DYD_SKELETON_MESH_START_H
#define DYD_SKELETON_MESH_START_H

#include "skeleton/mesh.h"

/* Sets xy (a copy for a part of the vertices) and the filter constants. */
dyd_status dyd_mesh_coordinates(dyd_mesh *m);
/* A point that coincides with a vertex becomes its alias, anything else gives way; so points have to come first. Where
 * the order is another one, as that of several strips is, vertices are taken in two rounds: is it the turn of v? */
void dyd_mesh_set_rounds(dyd_mesh *m);
bool dyd_mesh_has_turn(const dyd_mesh *m, uint32_t v, unsigned round);
/* Finds three vertices that make a triangle, counter-clockwise; moves representatives where that is needed and
 * possible; sets m->collinear when every choice is collinear (or there are fewer than three distinct sites). */
dyd_status dyd_mesh_first_triangle(uint32_t first[3], dyd_mesh *m);
/* The first triangle and its three ghost triangles. */
void dyd_mesh_put_first(dyd_mesh *m, const uint32_t first[3]);
/* Moves the representative of v to fraction k of its rectangle. */
dyd_status dyd_mesh_move(dyd_mesh *m, uint32_t v, uint32_t k);
/* Is the site of v an exact point? */
bool dyd_mesh_is_point(const dyd_mesh *m, uint32_t v);
dyd_status dyd_mesh_set_alias(dyd_mesh *m, uint32_t v, uint32_t of);
/* Representatives have been chosen anew: the filter constants follow. */
void dyd_mesh_follow(dyd_mesh *m);
/* Gives back what only building needs. */
void dyd_mesh_trim(dyd_mesh *m);
void dyd_mesh_clear(dyd_mesh *m);

#endif
