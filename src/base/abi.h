/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Structs that begin with their size (dyadel/dyadel.h, "ABI rules"): no byte beyond the caller's size is touched. */
#ifndef DYD_BASE_ABI_H
#define DYD_BASE_ABI_H

#include <dyadel/status.h>

/* Checks that a size is set, and at least `least`; returns DYD_E_ARG with a message that says how to set it; type is
 * the struct's name. */
dyd_status dyd_abi_check(const void *theirs, size_t least, const char *type, dyd_error *err);
/* *own, a struct of `size` bytes, becomes what the caller gave: 0 where theirs is shorter or NULL. DYD_E_ARG (*own has
 * its size, and is 0) when no size is set, or when theirs has members that are unknown here and not 0. */
dyd_status dyd_abi_take(void *own, size_t size, const void *theirs, const char *type, dyd_error *err);
/* The caller's struct, checked before, becomes *own as far as it reaches, and 0 beyond; it keeps its size. */
void dyd_abi_give(void *theirs, const void *own, size_t size);

#endif
