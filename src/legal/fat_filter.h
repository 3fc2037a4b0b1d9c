/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Which triangles of the skeleton a few large rectangles can spoil for the first pass [WIT-FAT]. */
#ifndef DYD_LEGAL_FAT_FILTER_H
#define DYD_LEGAL_FAT_FILTER_H

#include "skeleton/skeleton.h"

/* *met, released with free(): a number for each triangle, 0 when no rectangle of the vertices fat[0 .. count-1] comes
 * within `reach` of its circle (of a ghost triangle: of the half-plane beyond its hull edge). NULL when that would take
 * too long, or count is 0. Representatives are doubles. Cost: the triangles that are met. */
dyd_status dyd_fat_meet(uint32_t **met, const dyd_skeleton *sk, const uint32_t *fat, uint32_t count, double reach);

#endif
