/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* What --stats prints: one "name value" per line. */
#include "cli.h"
#include <inttypes.h>
#include <sys/resource.h>

static void stats_line(FILE *out, const char *name, uint64_t value) {
  fprintf(out, "%-26s %" PRIu64 "\n", name, value);
}

/* discs: their pairs; NULL: those of rectangles count. */
static void plane_count(size_t count[4], size_t *aliases, const dyd_delaunay *pd, const dyd_pair_list *discs) {
  size_t sites = dyd_sites_count(dyd_delaunay_sites(pd));
  for (size_t i = 0; i < sites; i++) *aliases += dyd_delaunay_alias(pd, (uint32_t)i) != i;
  if (!discs) dyd_delaunay_count(count, pd);
  for (size_t k = 0; discs && k < discs->count; k++) count[discs->item[k].status]++;
}

/* Of the places, not of their images. */
static void sphere_count(size_t count[4], size_t *aliases, const dyd_sphere *sphere) {
  dyd_pair_list pairs = {0};
  size_t places = dyd_engine_count(dyd_sphere_places(sphere));
  for (size_t i = 0; i < places; i++) *aliases += dyd_sphere_alias(sphere, (uint32_t)i) != i;
  if (dyd_sphere_pairs(&pairs, sphere) == DYD_OK)
    for (size_t k = 0; k < pairs.count; k++) count[pairs.item[k].status]++;
  dyd_pair_list_clear(&pairs);
}

static void result_stats(FILE *out, const dyd_delaunay *pd, const dyd_sphere *sphere, const dyd_pair_list *discs) {
  size_t count[4] = {0}, aliases = 0;
  if (sphere)
    sphere_count(count, &aliases, sphere);
  else
    plane_count(count, &aliases, pd, discs);
  stats_line(out, "aliases", aliases);
  stats_line(out, "pairs legal", count[DYD_LEGAL]);
  stats_line(out, "pairs indeterminate", count[DYD_INDETERMINATE]);
  stats_line(out, "pairs tie", count[DYD_TIE]);
  fprintf(out, "%-26s %s\n", "capped", dyd_delaunay_is_capped(pd) ? "yes" : "no");
  stats_line(out, "bytes triangulation", dyd_delaunay_memory(pd));
  stats_line(out, "bytes sites", dyd_sites_memory(dyd_delaunay_sites(pd)));
}

static const char *budget_text(dyd_budget b) {
  static const char *const text[] = {
      [DYD_BUDGET_NONE] = "none",   [DYD_BUDGET_BITS] = "bits",   [DYD_BUDGET_STAGES] = "stages",
      [DYD_BUDGET_CALLS] = "calls", [DYD_BUDGET_PAIRS] = "pairs", [DYD_BUDGET_SECONDS] = "seconds"};
  return text[b];
}

static void tie_stats(FILE *out, const dyd_tie_counters *t) {
  stats_line(out, "zero tests", t->tests);
  stats_line(out, "zero by identity", t->by_identity);
  stats_line(out, "zero by bound", t->by_bound);
  stats_line(out, "not zero", t->nonzero);
  stats_line(out, "zero or not, unknown", t->unknown);
  fprintf(out, "%-26s %" PRId64 "\n%-26s %" PRId64 "\n%-26s %.3f\n", "bits in tests, most", t->bits_most,
          "degree in tests, most", t->degree_most, "seconds in tests", t->seconds);
}

void cli_stats(FILE *out, const dyd_engine *e, const dyd_sphere *sphere, const dyd_pair_list *discs, double seconds) {
  dyd_engine_counters c = {DYD_SIZED(dyd_engine_counters)};
  dyd_engine_get_counters(&c, e, NULL);
  fprintf(out, "%-26s %s\n", "outcome", dyd_outcome_text(sphere ? dyd_sphere_outcome(sphere) : dyd_engine_outcome(e)));
  fprintf(out, "%-26s %s\n", "budget spent", budget_text(c.spent));
  stats_line(out, "points", dyd_engine_count(sphere ? dyd_sphere_places(sphere) : e));
  if (dyd_engine_delaunay(e)) result_stats(out, dyd_engine_delaunay(e), sphere, discs);
  stats_line(out, "undecided faces", c.undecided_faces);
  stats_line(out, "stages", c.stages);
  stats_line(out, "stream calls", c.calls);
  fprintf(out, "%-26s %" PRId64 "\n%-26s %" PRId64 "\n", "bits asked, least", c.bits_least, "bits asked, most",
          c.bits_most);
  stats_line(out, "bits asked, total", c.bits_total);
  stats_line(out, "decisions in doubles", c.delaunay.filter);
  stats_line(out, "decisions in integers", c.delaunay.integer);
  stats_line(out, "decisions in GMP", c.delaunay.exact);
  stats_line(out, "witnesses guessed", c.delaunay.witness_guess);
  stats_line(out, "witnesses searched", c.delaunay.witness_search);
  stats_line(out, "cover walks", c.delaunay.cover_walks);
  stats_line(out, "faces worked on", c.delaunay.faces);
  tie_stats(out, &c.ties);
  fprintf(out, "%-26s %.3f\n%-26s %.3f\n", "seconds in the engine", c.seconds, "seconds in all", seconds);
  struct rusage usage;
  if (getrusage(RUSAGE_SELF, &usage) == 0) stats_line(out, "KiB of memory at most", (uint64_t)usage.ru_maxrss);
}
