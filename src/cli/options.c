/* SPDX-License-Identifier: LGPL-3.0-or-later */
/* The options of the command, before or after the file name. */
#include "cli.h"
#include <errno.h>
#include <getopt.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
  OPT_UNTIL = 256,
  OPT_MAX_BITS,
  OPT_MAX_PAIRS,
  OPT_TIMEOUT,
  OPT_SCHEDULE,
  OPT_THREADS,
  OPT_FORMAT,
  OPT_STATS,
  OPT_QUIET,
  OPT_COLUMNS,
  OPT_MEASURED,
  OPT_RADIUS,
  OPT_VERSION
};

static const struct option table[] = {{"until", required_argument, NULL, OPT_UNTIL},
                                      {"max-bits", required_argument, NULL, OPT_MAX_BITS},
                                      {"max-pairs", required_argument, NULL, OPT_MAX_PAIRS},
                                      {"timeout", required_argument, NULL, OPT_TIMEOUT},
                                      {"schedule", required_argument, NULL, OPT_SCHEDULE},
                                      {"threads", required_argument, NULL, OPT_THREADS},
                                      {"format", required_argument, NULL, OPT_FORMAT},
                                      {"output", required_argument, NULL, 'o'},
                                      {"stats", no_argument, NULL, OPT_STATS},
                                      {"quiet", no_argument, NULL, OPT_QUIET},
                                      {"columns", required_argument, NULL, OPT_COLUMNS},
                                      {"measured", no_argument, NULL, OPT_MEASURED},
                                      {"radius", required_argument, NULL, OPT_RADIUS},
                                      {"help", no_argument, NULL, 'h'},
                                      {"version", no_argument, NULL, OPT_VERSION},
                                      {NULL, 0, NULL, 0}};

void cli_help(FILE *out) {
  fputs("Usage: dyadel delaunay [OPTION...] FILE\n"
        "Delaunay triangulation of points that are exact, imprecise or computable reals:\n"
        "which pairs are edges surely (legal), possibly (indeterminate, tie), never (not listed).\n"
        "FILE has one point per line, two coordinates; - is standard input.\n"
        "\n"
        "Input\n"
        "  --columns NAME,NAME   FILE is CSV with a header; take these two columns as x,y\n"
        "  --measured            decimals are rounded measurements: 47.61 is [47.605,47.615]\n"
        "  --radius R            widen every point by R on each side\n"
        "Refinement\n"
        "  --until GOAL          decided (default), area:M or hausdorff:M (bound 2^-M)\n"
        "  --max-bits B          precision at which to give up (default 4096)\n"
        "  --max-pairs K         cap on stored pairs (default 4000000 + 16 per point)\n"
        "  --timeout SECONDS     stop after this time\n"
        "  --schedule WHICH      adaptive (default) or uniform\n"
        "  --threads T           threads to use (default 1)\n"
        "Output\n"
        "  --format F            csv (default), json, wkt, geojson, obj, svg\n"
        "  -o, --output FILE     write to FILE, whole or not at all\n"
        "  --stats               print counters to standard error\n"
        "  --quiet               no progress, no notes\n"
        "  -h, --help            this text\n"
        "  --version             the version\n"
        "\n"
        "Exit status: 0 decided or certified, 1 bad input or failure, 2 bad usage,\n"
        "3 fixpoint (ties or fixed rectangles), 4 budget spent, 5 cancelled.\n"
        "Results are written for 0, 3, 4 and 5.\n",
        out);
}

static bool usage(const char *option, const char *value, const char *wanted) {
  cli_complain("--%s \"%s\" is not understood; give %s", option, value, wanted);
  return false;
}

static bool read_integer(long long *out, const char *text, long long least, long long most) {
  char *end;
  errno = 0;
  *out = strtoll(text, &end, 10);
  return end != text && !*end && errno == 0 && *out >= least && *out <= most;
}

static bool read_until(cli_options *o, const char *text) {
  const char *colon = strchr(text, ':');
  size_t length = colon ? (size_t)(colon - text) : strlen(text);
  long long bits = 0;
  o->engine.goal = DYD_GOAL_DECIDED;
  if (!colon && strcmp(text, "decided") == 0) return true;
  if (length == 4 && strncmp(text, "area", 4) == 0) o->engine.goal = DYD_GOAL_AREA;
  if (length == 9 && strncmp(text, "hausdorff", 9) == 0) o->engine.goal = DYD_GOAL_HAUSDORFF;
  if (!colon || o->engine.goal == DYD_GOAL_DECIDED || !read_integer(&bits, colon + 1, -DYD_EXP_LIMIT, DYD_EXP_LIMIT))
    return usage("until", text, "decided, area:M or hausdorff:M with a whole number M");
  o->engine.goal_bits = bits;
  return true;
}

static bool read_timeout(cli_options *o, const char *text) {
  char *end;
  double seconds = strtod(text, &end);
  if (end == text || *end || !isfinite(seconds) || seconds <= 0)
    return usage("timeout", text, "a number of seconds above 0");
  o->engine.seconds = seconds;
  return true;
}

static bool read_schedule(cli_options *o, const char *text) {
  if (strcmp(text, "adaptive") == 0)
    o->engine.schedule = DYD_SCHEDULE_ADAPTIVE;
  else if (strcmp(text, "uniform") == 0)
    o->engine.schedule = DYD_SCHEDULE_UNIFORM;
  else
    return usage("schedule", text, "adaptive or uniform");
  return true;
}

static bool read_count(long long *out, const char *option, const char *text, long long most) {
  return read_integer(out, text, 1, most) || usage(option, text, "a whole number above 0 (and not beyond reason)");
}

static bool read_limit(cli_options *o, int option, const char *text) {
  long long value;
  switch (option) {
  case OPT_MAX_BITS:
    if (!read_count(&value, "max-bits", text, DYD_EXP_LIMIT)) return false;
    o->engine.max_bits = value;
    return true;
  case OPT_MAX_PAIRS:
    if (!read_count(&value, "max-pairs", text, (long long)1 << 40)) return false;
    o->engine.max_pairs = (size_t)value;
    return true;
  default:
    if (!read_count(&value, "threads", text, 1024)) return false;
    o->engine.threads = (unsigned)value;
    return true;
  }
}

static bool read_format(cli_options *o, const char *text) {
  return dyd_format_from_name(&o->format, text) || usage("format", text, "csv, json, wkt, geojson, obj or svg");
}

static bool read_one(cli_options *o, int option, const char *value) {
  switch (option) {
  case OPT_UNTIL:
    return read_until(o, value);
  case OPT_TIMEOUT:
    return read_timeout(o, value);
  case OPT_SCHEDULE:
    return read_schedule(o, value);
  case OPT_FORMAT:
    return read_format(o, value);
  case OPT_COLUMNS:
    o->read.columns = value;
    return true;
  case OPT_MEASURED:
    return o->read.measured = true;
  case OPT_RADIUS:
    o->read.radius = value;
    return true;
  case OPT_STATS:
    return o->stats = true;
  case OPT_QUIET:
    return o->quiet = true;
  case OPT_VERSION:
    return o->version = true;
  case 'o':
    o->output = value;
    return true;
  case 'h':
    return o->help = true;
  default:
    return read_limit(o, option, value);
  }
}

static int complain_option(int kind, char **argv) {
  if (kind == ':')
    cli_complain("%s needs a value; see dyadel --help", argv[optind - 1]);
  else if (optopt && optopt < 256)
    cli_complain("there is no option -%c; see dyadel --help", optopt);
  else
    cli_complain("there is no option %s, or it takes no value; see dyadel --help", argv[optind - 1]);
  return CLI_USAGE;
}

int cli_options_read(cli_options *out, int argc, char **argv) {
  *out = (cli_options){.format = DYD_FORMAT_CSV};
  dyd_engine_options_init(&out->engine);
  opterr = 0;
  for (int option; (option = getopt_long(argc, argv, ":o:h", table, NULL)) != -1;) {
    if (option == '?' || option == ':') return complain_option(option, argv);
    if (!read_one(out, option, optarg)) return CLI_USAGE;
  }
  if (optind < argc) out->command = argv[optind++];
  if (optind < argc) out->file = argv[optind++];
  if (optind >= argc) return 0;
  cli_complain("\"%s\" is one argument too many; give one file", argv[optind]);
  return CLI_USAGE;
}
