/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* An oracle program in plain C, without any library: points whose binary digits are known one by one.
 *
 * Digit k (k = 1, 2, ...) of a coordinate with the odd multiplier a is the parity of the ones in k a written in binary;
 * for a = 1 that is the Thue-Morse constant 0.8249080672802... As many hexadecimal digits as asked for are printed, cut
 * off after one that is not f, so that for the upper end only that one has to be raised. */
#include <stdio.h>
#include <stdlib.h>

#define POINTS 12

static unsigned digit(unsigned long a, unsigned long place) {
  unsigned value = 0;
  for (unsigned long k = 4 * place + 1; k <= 4 * place + 4; k++) value = 2 * value + (unsigned)__builtin_parityl(k * a);
  return value;
}

/* The number cut off behind digit `places`, and the same with that digit raised. */
static void print_interval(unsigned long a, long bits) {
  unsigned long places = bits > 0 ? (unsigned long)bits / 4 + 1 : 1;
  while (digit(a, places) == 15) places++;
  for (int upper = 0; upper < 2; upper++) {
    fputs(" 0x0.", stdout);
    for (unsigned long k = 0; k < places; k++) printf("%x", digit(a, k));
    printf("%x", digit(a, places) + (unsigned)upper);
  }
}

int main(void) {
  unsigned long point;
  long bits;
  printf("points %d\n", POINTS);
  fflush(stdout);
  while (scanf(" refine %lu %ld", &point, &bits) == 2) {
    printf("%lu", point);
    print_interval(2 * point + 1, bits);
    print_interval(2 * point + 1001, bits);
    printf("\n");
    fflush(stdout);
  }
  return 0;
}
