/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Adding many exact points that are rationals of single words; for the readers. */
#ifndef DYD_ENGINE_WORDS_H
#define DYD_ENGINE_WORDS_H

#include "rect/sites_table.h"
#include <dyadel/engine.h>

/* Adds n exact points, as dyd_sites_add_words; nothing on failure. DYD_E_ARG when e has been started. */
dyd_status dyd_engine_add_words(dyd_engine *e, size_t n, const dyd_words *xy);

#endif
