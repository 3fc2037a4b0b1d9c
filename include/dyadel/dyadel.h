/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Everything dyadel offers. */
#ifndef DYADEL_DYADEL_H
#define DYADEL_DYADEL_H

#include <dyadel/certificate.h>
#include <dyadel/check.h>
#include <dyadel/compose.h>
#include <dyadel/converge.h>
#include <dyadel/engine.h>
#include <dyadel/io.h>
#include <dyadel/metric.h>
#include <dyadel/oracle.h>
#include <dyadel/voronoi.h>

#endif
