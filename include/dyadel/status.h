/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Status codes, three-valued answers and error records: the two channels of every call.
 *
 * dyd_status says how a call went; dyd_sure and dyd_truth say what is known. They are never mixed:
 * "unknown" is an answer, not a failure. */
#ifndef DYADEL_STATUS_H
#define DYADEL_STATUS_H

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define DYD_API __attribute__((visibility("default")))
#else
#define DYD_API
#endif

/* Begins the initialiser of a struct whose first member is struct_size: dyd_read_options o =
 * {DYD_SIZED(dyd_read_options)}; In C, other members may follow: {DYD_SIZED(dyd_read_options), .measured = true}. What
 * is not named is 0. C++ without warnings, and other languages: all 0, then o.struct_size = sizeof o. */
#ifdef __cplusplus
#define DYD_SIZED(type) sizeof(type)
#else
#define DYD_SIZED(type) .struct_size = sizeof(type)
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* 0 done; > 0 valid but unfinished; < 0 failed, outputs as they were before the call. */
typedef enum dyd_status {
  DYD_OK = 0,
  DYD_FIXED = 1,           /* the rectangle given is final: this point cannot be narrowed further */
  DYD_CAPPED = 2,          /* the cap on stored pairs was met; the error record names sites */
  DYD_CANCELLED = 3,       /* the cancel flag was seen; what is stated so far is valid */
  DYD_E_NOMEM = -1,        /* memory exhausted */
  DYD_E_ARG = -2,          /* an argument breaks its contract */
  DYD_E_RANGE = -3,        /* a number leaves the exponent range DYD_EXP_LIMIT */
  DYD_E_PARSE = -4,        /* text is not of the expected form; the error record has line and column */
  DYD_E_DOMAIN = -5,       /* an expression stays undefined (log of a negative, division by zero) up to the budget */
  DYD_E_NESTING = -6,      /* a stream gave a rectangle that is not inside its previous one */
  DYD_E_STREAM = -7,       /* a stream failed for reasons of its own */
  DYD_E_IO = -8,           /* reading or writing failed */
  DYD_E_CONTRADICTION = -9 /* two measurements of a point have nothing in common */
} dyd_status;

/* A sign that is known for every choice, or not known. */
typedef enum dyd_sure { DYD_SURE_MINUS = -1, DYD_UNSURE = 0, DYD_SURE_PLUS = 1 } dyd_sure;

/* Three-valued truth. */
typedef enum dyd_truth { DYD_FALSE = -1, DYD_UNKNOWN = 0, DYD_TRUE = 1 } dyd_truth;

#define DYD_NO_POINT ((size_t)-1)
#define DYD_MESSAGE_SIZE 400

/* What went wrong and where. Plain data: copy it freely, nothing to release.
 * Invariant: message is a terminated UTF-8 string; unknown numbers are 0 (point: DYD_NO_POINT). */
typedef struct dyd_error {
  dyd_status code;
  size_t point;   /* number of the point concerned, from 0 */
  uint64_t stage; /* how many times that point had been narrowed before */
  size_t line;    /* line of the input text, from 1 */
  size_t column;  /* column of the input text in characters, from 1 */
  char message[DYD_MESSAGE_SIZE];
} dyd_error;

/* Sets *err to "no error". */
DYD_API void dyd_error_clear(dyd_error *err);
/* For callbacks in any language: notes code and message (cut where it is too long), and returns code. err may be NULL.
 */
DYD_API dyd_status dyd_error_set(dyd_error *err, dyd_status code, const char *message);

/* A fixed English sentence for a status code. Static storage. */
DYD_API const char *dyd_status_text(dyd_status status);

/* The version of the library, "MAJOR.MINOR.PATCH". Static storage. */
DYD_API const char *dyd_version(void);

#ifdef __cplusplus
}
#endif
#endif
