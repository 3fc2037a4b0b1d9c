/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Of src/base/error.h what these proofs need: messages are not looked at. */
#ifndef DYD_PROOFS_ERROR_H
#define DYD_PROOFS_ERROR_H

#include <dyadel/status.h>
#include <stddef.h>

/*@ requires err == \null || \valid(err); assigns *err; exits \false; ensures \result == code; */
dyd_status fail(dyd_error *err, dyd_status code);
#define dyd_fail(err, code, ...) fail(err, code)
/*@ requires err == \null || \valid(err); assigns *err; exits \false; ensures \result == DYD_E_NOMEM; */
dyd_status dyd_fail_nomem(dyd_error *err);

#endif
