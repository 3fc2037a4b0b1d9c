/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* strncmp with a literal, whose bytes its size counts: WP forgets that literals are there where a callee, or a loop, may
 * change any memory. What string.h asks of them is asked here, too. */
/*@ requires string(s) && 3 <= n <= 12 && n < size; assigns \nothing; exits \false; */
int compare_with_literal(const char *s, size_t size, size_t n);
#define strncmp(s, literal, n) compare_with_literal(s, sizeof(literal), n)
