#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Writes a C program that calls every function of the public headers that takes an object with a life (an engine, a
result, a stream): with NULL, with an engine and a sphere that have no result yet, and with an engine whose run failed.

A call ends in a process of its own; it must not die. With NULL, what returns a dyd_status returns DYD_E_ARG.

Usage: null_calls.py ROOT OUTPUT.c
"""
import pathlib
import re
import sys

PROTOTYPE = re.compile(r'DYD_API\s+([^;{]+?)\b(dyd_\w+)\s*\(((?:[^;()]|\([^()]*\))*)\)\s*;', re.S)

BEGIN = '''/* Written by tests/base/null_calls.py. */
#include <dyadel/certificate.h>
#include <dyadel/dyadel.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

static _Alignas(64) char storage[16][8192];
static FILE *file;
static dyd_error err;
static dyd_rect rect; /* initialised by main */

static dyd_status fails(dyd_rect *out, void *user, const dyd_request *request, dyd_error *why) {
  (void)out, (void)user, (void)request;
  return dyd_error_set(why, DYD_E_STREAM, "the instrument is off");
}

static dyd_engine *engine_fresh(void) {
  dyd_engine *e = NULL;
  dyd_engine_new(&e);
  return e;
}

static dyd_engine *engine_failed(void) {
  dyd_engine *e = engine_fresh();
  const dyd_source source = {DYD_SIZED(dyd_source), .narrow = fails};
  dyd_outcome outcome;
  dyd_engine_add_source(e, 4, &source, &err);
  dyd_engine_run(&outcome, e, NULL, &err);
  return e;
}

static dyd_sphere *sphere_fresh(void) {
  dyd_sphere *s = NULL;
  dyd_engine *places = engine_fresh();
  const double degrees[3] = {0, 10, 20};
  dyd_engine_add_points(places, 3, degrees, degrees, NULL);
  dyd_sphere_new(&s, places, NULL, &err);
  return s;
}

'''
END = '''
/* 0 where it came back as it should, else the signal, or 99 for another status. */
static int outcome_of(int (*call)(void)) {
  int status = 0;
  fflush(NULL);
  pid_t child = fork();
  if (child == 0) {
    alarm(20);
    _exit(call());
  }
  waitpid(child, &status, 0);
  return WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status);
}

int main(void) {
  int failed = 0;
  file = fopen("/dev/null", "r+");
  dyd_rect_init(&rect);
  for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
    int found = outcome_of(all[k].call);
    if (!found) continue;
    printf(found == 99 ? "%s: a status other than DYD_E_ARG\\n" : "%s: signal %d\\n", all[k].name, found);
    failed = 1;
  }
  printf("%zu calls\\n", sizeof all / sizeof *all);
  return failed;
}
'''
GIVEN = {'NULL': {}, 'no result yet': {'dyd_engine': 'engine_fresh()', 'dyd_sphere': 'sphere_fresh()'},
         'a failed run': {'dyd_engine': 'engine_failed()'}}


def arguments(text):
    """Split at the commas outside of parentheses."""
    parts = re.findall(r'(?:[^,()]|\([^()]*\))+', ' '.join(text.split()))
    return [part.strip() for part in parts if part.strip() != 'void']


def read(root):
    """The functions, as (returned, name, arguments), and the names of types whose members are hidden."""
    hidden, shown, functions = set(), set(), []
    for header in sorted((root / 'include' / 'dyadel').glob('*.h')):
        text = re.sub(r'/\*.*?\*/', '', header.read_text(encoding='utf-8'), flags=re.S)
        hidden |= set(re.findall(r'typedef struct (dyd_\w+) dyd_\w+;', text))
        shown |= set(re.findall(r'struct (dyd_\w+) \{', text))
        functions += [(found[1].strip(), found[2], arguments(found[3])) for found in PROTOTYPE.finditer(text)]
    return functions, hidden - shown


def handle(argument, hidden):
    found = re.match(r'(?:const )?(dyd_\w+) \*(?:const )?\w*$', argument)
    return found[1] if found and found[1] in hidden else None


def value(argument, number, hidden, given):
    kind = handle(argument, hidden)
    if kind:
        return given.get(kind, 'NULL')
    if re.match(r'FILE \*\w+$', argument):
        return 'file'
    if re.match(r'const dyd_rect \*\w+$', argument):
        return '&rect'
    if '*' in argument or '[' in argument or re.search(r'\bmp[zq]_(t|ptr|srcptr)\b', argument):
        return f'(void *)storage[{number}]'
    return 'NULL' if re.search(r'_fn\b', argument) else '0'


def main():
    root, output = map(pathlib.Path, sys.argv[1:])
    functions, hidden = read(root)
    lines, table = [BEGIN], []
    for number, (returned, name, taken) in enumerate(functions):
        kinds = {handle(argument, hidden) for argument in taken} - {None}
        for state, given in GIVEN.items():
            if not (kinds & set(given) if given else kinds):
                continue
            call = f'call_{number}_{len(table)}'
            words = f'{name}({", ".join(value(argument, k, hidden, given) for k, argument in enumerate(taken))})'
            checked = returned == 'dyd_status' and not given
            body = f'return {words} == DYD_E_ARG ? 0 : 99;' if checked else f'(void){words}; return 0;'
            lines.append(f'static int {call}(void) {{ {body} }}\n')
            table.append(f'  {{"{name}, {state}", {call}}},\n')
    lines += ['\nstatic const struct {\n  const char *name;\n  int (*call)(void);\n} all[] = {\n', *table, '};\n', END]
    assert len(table) > 200, 'the headers are not understood'
    output.write_text(''.join(lines), encoding='utf-8')


main()
