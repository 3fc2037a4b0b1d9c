#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Arguments and input against exit status, output and message: one line per case.

Usage: test_table.py COMMAND DATA
"""
from harness import expect, main, run

SQUARE = '0 0\n1 0\n1 1\n0 1.5\n'
HEADER = r'\Ai,j,status\n'
TWO = HEADER + r'0,1,legal\n\Z'

# (arguments after "delaunay -", standard input, exit status, standard output, standard error)
EMPTY = r'\Adyadel: -: this file has no points\n\Z'
INPUT = [
    ('', '', 0, HEADER + r'\Z', EMPTY),
    ('', '# nothing\n\n   \n', 0, HEADER + r'\Z', EMPTY),
    ('', '1 2', 0, HEADER + r'\Z', r'\A\Z'),
    ('', '1 2\n3 4\n', 0, TWO, r'\A\Z'),
    ('', '\ufeff1 2\n3 4\n', 0, TWO, r'\A\Z'),
    ('', '1 2\r\n3,4\r\n', 0, TWO, r'\A\Z'),
    ('', '1\t,\t2 # first\n3   4#second', 0, TWO, r'\A\Z'),
    ('', '22/7 1e-3\n0x1.8p-3 5*2^-20\n', 0, TWO, ''),
    ('', '[1.2,1.3] [0, 1]\n9 9\n', 0, TWO, ''),
    ('', '1.25+-0.01 1.25±0.01\n9 9\n', 0, TWO, ''),
    ('', 'sqrt(2)+pi/4 cos( 2*pi / 7 ),\n', 1, r'\A\Z', r'^dyadel: -:1:29: .*more than two coordinates.*; give two'),
    ('', 'sqrt(2)+pi/4 cos( 2*pi / 7 )\n(1+sqrt(5))/2, root(x^5-x-1, 1, 2)\n', 0, TWO, ''),
    ('', '1 2\n3 4\n1 2\n', 0, r'\A# alias 2 0\ni,j,status\n0,1,legal\n\Z', ''),
    ('', '0.1 1\n3 4\n1/10 1.0\n1e-1 1\n', 0, r'\A# alias 2 0\n# alias 3 0\ni,j,status\n0,1,legal\n\Z', ''),
    ('', SQUARE, 0, r'(\n\d,\d,legal){5}\n\Z', r'\A\Z'),
    ('', '0 0\n1 0\n1 1\n0 1\n', 3, r'0,1,legal\n0,2,tie\n0,3,legal\n1,2,legal\n1,3,tie\n2,3,legal\n\Z', '^dyadel: [0-9]+ legal, [0-9]+ indeterminate.* pairs; '),
    ('--quiet', '0 0\n1 0\n1 1\n0 1\n', 3, r'0,2,tie', r'\A\Z'),
    ('', '1\n', 1, r'\A\Z', r'\Adyadel: -:1:2: the line has one coordinate only; give two.*\n\Z'),
    ('', '1 2\n\n1 2 3\n', 1, r'\A\Z', r'\Adyadel: -:3:5: more than two coordinates.*; give two'),
    ('', '1 2 # fine\n1,,2\n', 1, r'\A\Z', r'\Adyadel: -:2:3: two commas'),
    ('', ',1 2\n', 1, r'\A\Z', r'\Adyadel: -:1:1: '),
    ('', '1 2\n1 two\n', 1, r'\A\Z', r'\Adyadel: -:2:3: '),
    ('', '±± é\n', 1, r'\A\Z', r'\Adyadel: -:1:1: '),
    ('', '[1,é] 2\n', 1, r'\A\Z', r'\Adyadel: -:1:4: '),
    ('', '(1+é) 2é\n', 1, r'\A\Z', r'\Adyadel: -:1:4: '),
    ('', '1 2\n1 2\0\n', 1, r'\A\Z', r'\Adyadel: -:2:4: a NUL byte; give plain text'),
    ('', '1 ' + '2' * 1100000, 1, r'\A\Z', r'\Adyadel: -:1:1: this line is longer'),
    ('', '[2,1] 0\n', 1, r'\A\Z', r'\Adyadel: -:1:'),
    ('', '0 0\n1 0\n2 sqrt(-2)\n', 1, r'\A\Z', r'\Adyadel: -:3:3: '),
    ('', '0 0\n1 0\n log(sin(pi)-1)   5\n', 1, r'\A\Z', r'\Adyadel: -:3:2: '),
    ('', '0 0\n1 0\n5 1/(sqrt(2)*sqrt(2)-2)\n', 1, r'\A\Z', r'\Adyadel: -:3:4: point 2: .* rewrite'),
    ('--columns x,y', 'x,y\n1,2\n3,4\n', 0, TWO, ''),
    ('--columns y,x', 'name,x,y\na,1,2\nb,3,4\n', 0, TWO, ''),
    ('--columns x,y', 'x,y\r\n1,2\r\n\r\n3,4', 0, TWO, ''),
    ('--columns x,y', '\ufeffx,y\n1,2\n3,4\n', 0, TWO, ''),
    ('--columns x,y', 'x,y\n', 0, HEADER + r'\Z', ''),
    ('--columns x,y', '"x","na""me",y\n"1","two\nlines, ""quoted""", 2\n3,"",\t4 \n', 0, TWO, ''),
    ('--columns "a,b",y', '"a,b",y\n1,2\n3,4\n', 0, TWO, ''),
    ('--columns x,y', 'x,y\n"[1,2]","sqrt(2)"\n9,4\n', 0, TWO, ''),
    ('--columns x,y', '', 1, r'\A\Z', r'\Adyadel: -:1:1: the file has no header'),
    ('--columns x,z', 'x,y,w\n', 1, r'\A\Z', r'\Adyadel: -:1:1: no column is called "z"; the header\'s names are: x, y, w; give'),
    ('--columns x,y', 'x,y,x\n', 1, r'\A\Z', r'\Adyadel: -:1:5: 2 columns are called "x"; rename'),
    ('--columns x,y', 'x,y\n1,2\n1,2,3\n', 1, r'\A\Z', r'\Adyadel: -:3:1: this record has 3 fields, the header 2'),
    ('--columns x,y', 'n,x,y\n"a\nb",1,2\n"c\nd",1,two\n', 1, r'\A\Z', r'\Adyadel: -:5:6: '),
    ('--columns x,y', 'n,x,y\n"a,1,2\n', 1, r'\A\Z', r'\Adyadel: -:2:1: the quotes'),
    ('--columns x,y', 'x,y\n1,2"\n"3",4\n', 1, r'\A\Z', r'\Adyadel: -:2:'),
    ('--columns x,y', 'x,y\n1,\n', 1, r'\A\Z', r'\Adyadel: -:2:3: the coordinate is empty'),
    ('--columns x', 'x,y\n', 2, r'\A\Z', r'\Adyadel: "x" is not two column names; give NAME,NAME'),
    ('--measured', '0.0 0.0\n1.0 0.0\n0.5 0.1\n', 3, '0,1,indeterminate', '^dyadel: [0-9]+ legal, [0-9]+ indeterminate.* pairs; '),
    ('--measured', '0 0\n5 0\n', 0, TWO, ''),
    ('--radius 1/4', '0 0\n1 0\n', 0, TWO, ''),
    ('--radius 0', '0 0\n1 0\n', 0, TWO, ''),
    ('--radius 1/4', '0 0\n3 sqrt(2)\n3 0\n', 0, r'(\n\d,\d,legal){3}\n\Z', ''),
    ('--radius 2', '0 0\n1 0\n0 1\n', 3, 'indeterminate', '^dyadel: [0-9]+ legal, [0-9]+ indeterminate.* pairs; '),
    ('--radius=-1', '0 0\n', 2, r'\A\Z', 'the radius "-1" is not'),
    ('--radius pi', '0 0\n', 2, r'\A\Z', 'the radius "pi" is not'),
]

# (all arguments, exit status, standard output, standard error)
USAGE = [
    ('', 2, r'\A\Z', 'a command is missing'),
    ('--help', 0, r'\AUsage: dyadel COMMAND', r'\A\Z'),
    ('delaunay -h', 0, '^Usage: dyadel delaunay', r'\A\Z'),
    ('--version', 0, r'\Adyadel \d+\.\d+\.\d+\n\Z', r'\A\Z'),
    ('delaunay', 2, r'\A\Z', 'the points file is missing'),
    ('delauney x', 2, r'\A\Z', r'there is no command "delauney"; did you mean delaunay\?'),
    ('quickhull x', 2, r'\A\Z', r'there is no command "quickhull"; the commands are:\n  dyadel delaunay FILE'),
    ('delaunay a b', 2, r'\A\Z', '"b" is one argument too many'),
    ('delaunay - --frobnicate', 2, r'\A\Z', 'there is no option --frobnicate'),
    ('delaunay - -x', 2, r'\A\Z', 'there is no option -x'),
    ('delaunay - --sttas', 2, r'\A\Z', r'there is no option --sttas; did you mean --stats\?'),
    ('delaunay - --max 3', 2, r'\A\Z', r'there is no option --max; did you mean --max-bits\?'),
    ('delaunay - --help=fish', 2, r'\A\Z', 'not understood; give --help, --help=man'),
    ('delaunay - --stats=yes', 2, r'\A\Z', '--stats takes no value'),
    ('delaunay - --format', 2, r'\A\Z', '--format needs a value'),
    ('delaunay - -o', 2, r'\A\Z', '-o needs a value'),
    ('delaunay - --format gif', 2, r'\A\Z', '--format "gif" is not understood; give csv, json'),
    ('delaunay - --until area', 2, r'\A\Z', '--until "area" is not understood; give decided'),
    ('delaunay - --until area:', 2, r'\A\Z', '--until'),
    ('delaunay - --until are:3', 2, r'\A\Z', '--until'),
    ('delaunay - --until decided:3', 2, r'\A\Z', '--until'),
    ('delaunay - --until hausdorff:3x', 2, r'\A\Z', '--until'),
    ('delaunay - --max-bits 0', 2, r'\A\Z', '--max-bits "0"'),
    ('delaunay - --max-bits 99999999999999999999', 2, r'\A\Z', '--max-bits'),
    ('delaunay - --max-pairs -3', 2, r'\A\Z', '--max-pairs "-3"'),
    ('delaunay - --timeout nan', 2, r'\A\Z', '--timeout "nan"'),
    ('delaunay - --timeout 0', 2, r'\A\Z', '--timeout'),
    ('delaunay - --schedule fast', 2, r'\A\Z', '--schedule "fast" is not understood; give adaptive or uniform'),
    ('delaunay - --threads 0', 2, r'\A\Z', '--threads'),
    ('delaunay nowhere.txt', 1, r'\A\Z', r'\Adyadel: nowhere.txt: cannot open: No such file or directory; check'),
    ('delaunay .', 1, r'\A\Z', r'\Adyadel: \.: is a directory; give the name of a points file'),
    ('--quiet - --stats', 2, r'\A\Z', 'there is no command "-"'),
    ('--format svg --quiet delaunay -', 0, r'\A<(svg |\?xml )', r'\A\Z'),
    ('delaunay - --format svg --quiet', 0, r'\A<(svg |\?xml )', r'\A\Z'),
    ('delaunay --quiet -- -', 0, r'\Ai,j,status\n\Z', r'\A\Z'),
    ('delaunay - -o nowhere/x.csv', 1, r'\A\Z', r'^dyadel: nowhere/x.csv: cannot write: No such file'),
    ('delaunay - -o /dev/null', 0, r'\A\Z', EMPTY),
    ('delaunay - -o /dev/full', 1, r'\A\Z', r'cannot write: No space left'),
]


def check(cases):
    """Runs (name, run function, expectations) and names all that fail."""
    problems = []
    for name, act, wanted in cases:
        try:
            expect(act(), *wanted)
        except AssertionError as problem:
            problems.append(f'\n  {name}: {problem}')
    assert not problems, ''.join(problems)


def test_input():
    check((f'{arguments} <<< {text[:80]!r}', lambda a=arguments, t=text: run('delaunay', '-', *a.split(), stdin=t), wanted)
          for arguments, text, *wanted in INPUT)


def test_usage():
    check((arguments, lambda a=arguments: run(*a.split()), wanted) for arguments, *wanted in USAGE)


main(globals())
