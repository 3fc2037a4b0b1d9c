/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* In place of src/base/alloc.h: see lists.h. */
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
