/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The map of pairs against a table of all of them. */
#include <setjmp.h>
#include <stdarg.h>

#include "possible/pair_map.h"
#include "support/random.h"
#include <cmocka.h>
#include <string.h>

static test_random shared;

enum { MEMBERS = 90 };

static void lists_agree(const dyd_pair_map *m, unsigned char want[MEMBERS][MEMBERS]) {
  for (uint32_t a = 0; a < MEMBERS; a++) {
    unsigned char seen[MEMBERS] = {0};
    for (uint32_t l = m->head[a]; l != UINT32_MAX; l = m->link[l].next) {
      assert_in_range(l, 0, m->links - 1);
      seen[m->link[l].to]++;
      assert_int_equal(m->link[l ^ 1].to, a);
    }
    for (uint32_t b = 0; b < MEMBERS; b++) {
      assert_int_equal(seen[b], want[a][b] >= DYD_PAIR_OPEN);
      if (a != b) assert_int_equal(dyd_pair_map_get(m, a, b), want[a][b]);
    }
  }
}

static void test_pair_map(void **state) {
  (void)state;
  for (size_t k = test_cases(20); k; k--) {
    static unsigned char want[MEMBERS][MEMBERS];
    dyd_pair_map m;
    memset(want, 0, sizeof want);
    assert_int_equal(dyd_pair_map_init(&m, MEMBERS), DYD_OK);
    for (size_t n = (size_t)test_below(&shared, 5000); n; n--) {
      uint32_t a = (uint32_t)test_below(&shared, MEMBERS), b = (uint32_t)test_below(&shared, MEMBERS);
      if (a == b || want[a][b]) continue;
      want[a][b] = want[b][a] = (unsigned char)test_between(&shared, 1, 3);
      assert_int_equal(dyd_pair_map_add(&m, a, b, (dyd_pair_state)want[a][b]), DYD_OK);
    }
    lists_agree(&m, want);
    dyd_pair_map_clear(&m);
  }
}

/* The longest chain of occupied places. */
static size_t longest_run(const dyd_pair_map *m) {
  size_t run = 0, longest = 0;
  for (size_t q = 0; q <= 2 * m->mask; q++) {
    run = m->key[q & m->mask] ? run + 1 : 0;
    if (run > longest) longest = run;
  }
  return longest;
}

/* Once all pairs with the same larger member began at the same place. */
static void test_hash_uses_both(void **state) {
  (void)state;
  for (uint32_t shape = 0; shape < 3; shape++) {
    dyd_pair_map m;
    assert_int_equal(dyd_pair_map_init(&m, 5001), DYD_OK);
    for (uint32_t a = 0; a < 1900; a++) {
      uint32_t from = shape == 2 ? a / 44 : a, to = shape == 0 ? 5000 : shape == 1 ? a + 1 : 100 + a % 44;
      assert_int_equal(dyd_pair_map_add(&m, from, to, DYD_PAIR_OPEN), DYD_OK);
    }
    assert_in_range(longest_run(&m), 1, 150);
    dyd_pair_map_clear(&m);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_pair_map), cmocka_unit_test(test_hash_uses_both)};
  shared = test_random_start("pair map");
  return cmocka_run_group_tests(tests, NULL, NULL);
}
