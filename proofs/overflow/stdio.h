/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Of <stdio.h> what these proofs need: any byte may come, or the end. */
#ifndef DYD_PROOFS_STDIO_H
#define DYD_PROOFS_STDIO_H

#define EOF (-1)
typedef struct FILE {
  int state;
} FILE;

/*@ requires \valid(in); assigns *in; exits \false; ensures -1 <= \result <= 255; */
int getc(FILE *in);
/*@ requires \valid(in); assigns \nothing; exits \false; */
int ferror(FILE *in);

#endif
