/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* Of <string.h> what these proofs need: texts end within memory that is there. */
#ifndef DYD_PROOFS_STRING_H
#define DYD_PROOFS_STRING_H

#include <stddef.h>

typedef const char *chars;

/*@ predicate ends(chars s, integer n) = 0 <= n <= 1152921504606846976 && \valid_read(s + (0 .. n)) && s[n] == 0;
    axiomatic Stop { logic integer stop{L}(chars s) reads s[0 ..];
      axiom stop_first{L}: \forall chars s, integer n; ends{L}(s, n) ==> ends{L}(s, stop{L}(s)) && stop{L}(s) <= n; }
    predicate string(chars s) = ends(s, stop(s));
    predicate line(char *s) = string(s) && \valid(s + (0 .. stop(s)));
    predicate within(chars p, chars s) = 0 <= p - s && p == s + (p - s);
    lemma string_kept{K, L}: \forall chars s; string{K}(s) && \valid_read{L}(s + (0 .. stop{K}(s))) &&
      (\forall integer k; 0 <= k <= stop{K}(s) ==> \at(s[k], K) == \at(s[k], L)) ==>
      ends{L}(s, stop{K}(s)) && string{L}(s);
    lemma string_part: \forall chars s, integer k, n; ends(s, n) && 0 <= k <= n ==> ends(s + k, n - k); */

/*@ requires string(s); assigns \nothing; exits \false; ensures \result == stop(s); */
size_t strlen(const char *s);
/*@ ghost /@ requires string(s); assigns \nothing; exits \false; ensures \result == stop(s); @/
    size_t length_of(const char *s); */
/*@ requires \valid_read((const char *)s + (0 .. n - 1)); assigns \nothing; exits \false;
    ensures \result == \null || \subset((const char *)\result, (const char *)s + (0 .. n - 1)); */
void *memchr(const void *s, int c, size_t n);
/*@ requires string(s) && c != 0; assigns \nothing; exits \false;
    ensures \result != \null ==> *\result == c && within(\result, s) && \result - s < stop(s); */
char *strchr(const char *s, int c);
/*@ requires string(s) && \valid_read(none + (0 .. 2)) && none[2] == 0; assigns \nothing; exits \false;
    ensures 0 <= \result <= stop(s) && (s[\result] == 0 || s[\result] == none[0] || s[\result] == none[1]); */
size_t strcspn(const char *s, const char *none);
/*@ requires string(s) && \valid_read(all + (0 .. 10)) && all[10] == 0; assigns \nothing; exits \false;
    ensures 0 <= \result <= stop(s); */
size_t strspn(const char *s, const char *all);
/*@ requires \valid((char *)to + (0 .. n - 1)) && \valid_read((const char *)from + (0 .. n - 1));
    assigns ((char *)to)[0 .. n - 1]; exits \false; */
void *memcpy(void *to, const void *from, size_t n);
/*@ requires string(s) && (string(t) || ends(t, 4) || ends(t, 7) || ends(t, 8) || ends(t, 9) || ends(t, 17) ||
      ends(t, 20));
    assigns \nothing; exits \false; */
int strcmp(const char *s, const char *t);
/*@ requires string(s) && 3 <= n <= 12 && \valid_read(t + (0 .. n - 1)); assigns \nothing; exits \false;
    ensures \result == 0 && t[0] != 0 && t[1] != 0 && t[2] != 0 ==> s[0] == t[0] && s[1] == t[1] && s[2] == t[2]; */
int strncmp(const char *s, const char *t, size_t n);

#endif
