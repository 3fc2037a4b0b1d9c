#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Every option: wrong values, wrong commands; help, manual page and completion agree with the values accepted.

Usage: test_options.py COMMAND DATA
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

from harness import COMMAND, DATA, expect, few, main, run, share

WHOLE = ('0', '-1', 'x', '1.5', '', '1e3', '99999999999999999999', '3 4')
SECONDS = ('0', '-1', 'nan', 'inf', 'x', '', '1s')
# Values that are refused before any file is opened.
WRONG = {
    '--until': ('', 'area', 'area:', 'are:3', 'decided:3', 'hausdorff:3x', 'hausdorff:99999999'),
    '--max-bytes': WHOLE + ('3X', 'M', '2GB', '99999999T', '9' * 80, '-1K'), '--max-bits': WHOLE, '--relative-bits': WHOLE + ('41',), '--max-pairs': WHOLE, '--threads': WHOLE, '--tie-bits': WHOLE, '--start-bits': WHOLE, '--step-bits': WHOLE,
    '--oracle-jobs': WHOLE, '--oracle-batch': WHOLE, '--schedules': WHOLE, '--simulate': WHOLE, '--hindsight': WHOLE, '--modulus': ('3', '9:3', 'a:b', '1:2:3'),
    '--seed': WHOLE[1:], '--site': WHOLE[1:], '--oracle-retries': WHOLE[1:],
    '--flatten': WHOLE[2:],
    '--max-arc': SECONDS, '--timeout': SECONDS, '--oracle-timeout': SECONDS, '--trace-sync': SECONDS,
    '--schedule': ('', 'fast', 'Adaptive', 'uniform '),
    '--of': ('', 'Voronoi', 'both'),
    '--metric': ('', 'max', 'Box', 'box '),
    '--ties': ('', 'on', 'Prove', 'off '),
    '--list-ties': ('', 'pair', 'Groups', 'none '),
    '--format': ('', 'gif', 'CSV', 'csv,json'),
    '--layer': ('', 'edge', 'Points', 'pairs,points'),
    '--crs': ('', '4326', 'EPSG', 'EPSG:', 'EPSG:0', 'EPSG:x', 'EPSG:1000000', 'epsg 4326'),
    '--window': ('', '0,1,0', '0,1,0,1,2', '0,1,0,x', '0,1,0,pi', '0,1,,1', '0,1,0,1,', '1,0,0,1', '0,1,2,1', '1,1,0,1',
                 '0,1,2,2', '[0,1],0,1,2'),
    '--plot': ('', 'plot', 'plot.gif', 'png'),
    '--width': ('', '0', '-3', '12km', 'cm', '12 cm', '5001', '6e3mm', 'nan', 'inf'), '--font-size': ('', '0', '12px', '71in'),
    '--help': ('fish', 'MAN'),
}
RIGHT = {'--modulus': '0:9', '--layer': 'points', '--crs': 'EPSG:4326', '--window': '0,1,0,1', '--format': 'csv', '--help': 'man', '--schedule': 'uniform', '--of': 'voronoi', '--ties': 'off', '--list-ties': 'none', '--metric': 'box', '--until': 'decided', '--width': '85mm', '--font-size': '9'}
# Any text that is not empty will do for a start; what is wrong is found when it is used.
TEXTS = {'--queries', '--query-columns', '--query-id', '--up-to', '--sigma', '--sigma-column', '--confidence', '--cost-column', '--label', '--font', '--pgf', '--accuracy', '--pairs', '--clip-to', '--columns', '--delimiter', '--id', '--in-layer', '--carry', '--merge-by', '--points', '--radius', '--radius-column', '--radius-unit', '--radius-scale', '--skip-lines', '--thousands', '--missing', '--oracle', '--policy', '--output', '--trace',
         '--replay', '--resume', '--certificate'}


def help_of(*command):
    result = run(*command, '--help')
    expect(result, 0, r'\AUsage: dyadel', r'\A\Z')
    assert all(len(line) <= 110 for line in result.out.splitlines()), 'a line is too long'
    return result.out


def commands():
    part = help_of().split('Commands\n')[1].split('\n\n')[0]
    return re.findall(r'^  (\w+) ([A-Z ]*[A-Z])  ', part, re.M)


def options(text):
    """Long name: placeholder or None."""
    return {name: value or None for name, value in re.findall(r'^  (?:-\w, )?(--[\w-]+)[ [=]*(\S+)?(?=\]| |$)', text, re.M)
            } | {name: None for name in re.findall(r'^  (?:-\w, )?(--[\w-]+)  ', text, re.M)}


def test_every_option_is_explained():
    """Clauses about options that a command lacks are not all that its help says of another."""
    for name, _ in commands():
        bare = re.findall(r'^  (--[\w-]+(?: [A-Z,]+)?) *\n(?! {20})', help_of(name), re.M)
        assert not bare, (name, bare)


def test_every_option_has_wrong_values():
    known = options(help_of())
    values = {name for name, placeholder in known.items() if placeholder}
    assert values <= set(WRONG) | TEXTS, f'no wrong values are tried for {values - set(WRONG) - TEXTS}'


def test_wrong_values():
    for k, (name, operands) in enumerate(commands()):
        taken = options(help_of(name))
        rest = operands.replace('FILE', 'nowhere').replace('CERT', 'nowhere').replace('X Y', '1 2').split()
        for option, values in share(WRONG.items(), k):
            for value in few(values) if option in taken else ():
                expect(run(name, *rest, f'{option}={value}'), 2, r'\A\Z', r'\Adyadel: .*give |\Adyadel: .*end it in')
        for option in share(sorted(TEXTS & set(taken)), k):
            expect(run(name, *rest, f'{option}='), 2, r'\A\Z', rf'{option} "" is not understood; give')
        for option, placeholder in share(taken.items(), k):
            if placeholder and option != '--help':
                expect(run(name, *rest, option), 2, r'\A\Z', f'{option} needs a value')
            if not placeholder:
                expect(run(name, *rest, f'{option}=yes'), 2, r'\A\Z', f'{option} takes no value')


def test_options_of_other_commands():
    everything = options(help_of())
    for name, operands in commands():
        taken = options(help_of(name))
        assert set(taken) <= set(everything)
        for option in few(sorted(set(everything) - set(taken))):
            value = RIGHT.get(option, '3')
            arguments = [f'{option}={value}' if everything[option] else option]
            expect(run(name, *operands.split(), *arguments), 2, r'\A\Z', f'{name} does not take {option}; see dyadel {name} --help')


def test_formats_of_commands():
    lists = {name: re.search(r'^  --format F +(.*)$', help_of(name), re.M) for name, _ in commands()}
    known = {name: re.findall(r'\w+(?= \(default\)|,|$)', match[1]) for name, match in lists.items() if match}
    everything = set().union(*known.values())
    for name, formats in known.items():
        for other in share(sorted(everything - set(formats)), len(name)):
            expect(run(name, 'a', '--format', other), 2, r'\A\Z', f'{name} does not write {other}; give {", ".join(formats)}$')


def test_operands():
    for name, operands in commands():
        rest = operands.split()
        expect(run(name, *['1'] * (len(rest) + 1)), 2, r'\A\Z', f'too many; give dyadel {name} {operands}')
        expect(run(name, *['1'] * (len(rest) - 1)), 2, r'\A\Z', 'is missing; give')
    assert run('delaunay', '-5').code == 1  # a file of that name
    expect(run('delaunay', '-.5x'), 1, r'\A\Z', r'-\.5x: cannot open')


def test_suggestions():
    for wrong, meant in (('--qiuet', '--quiet'), ('--colums', '--columns'), ('--oclumsn', '--columns'), ('--timout', '--timeout'), ('--max', '--max-bits'),
                         ('--Stats', '--stats'), ('--schedul=x', '--schedule')):
        result = run('delaunay', '-', wrong)
        assert f'did you mean {meant}?' in result.err or meant + ' "' in result.err, (wrong, result.err)
    for wrong, meant in (('delauney', 'delaunay'), ('converg', 'converge'), ('conv', 'converge'), ('Delaunay', 'delaunay')):
        expect(run(wrong, '-'), 2, r'\A\Z', rf'there is no command "{wrong}"; did you mean {meant}\?')
    for wrong in ('--zzzzzzzz', '--x', '-Q'):
        expect(run('delaunay', '-', wrong), 2, r'\A\Z', 'there is no option .*see dyadel --help')


def test_window():
    for window in ('0,1,0,1', '-1/3,1/3,0.1,2', '0x1p-3,1,-5*2^3,1e9', ' 0 , 1 , (1+1)/7 , 2 '):
        for name in [name for name, _ in commands() if '--window' in options(help_of(name))]:
            assert run(name, 'nowhere', *(['0', '0'] if name == 'nearest' else []), '--window', window).code == 1, window


def test_manual_page():
    page = run('--help=man')
    expect(page, 0, r'^\.Sh NAME', r'\A\Z')
    for name, _ in commands():
        assert f'.It Cm {name}' in page.out
    for option in options(help_of()):
        assert re.search(rf'^\.It .*Fl \\{option[1:]}( |$)', page.out, re.M), option
    formats = re.search(r'^  --format F +(.*)$', help_of(), re.M)[1]
    for name in re.findall(r'\w+(?= \(default\)|,|$)', formats):
        assert f'.It Cm {name}\n' in page.out.split('.Sh FORMATS')[1], f'the manual page says nothing of the format {name}'
    if shutil.which('mandoc'):
        lint = subprocess.run(['mandoc', '-Tlint'], input=page.out.encode(), stdout=subprocess.PIPE, check=False)
        assert lint.stdout == b'', lint.stdout.decode()
        text = subprocess.run(['mandoc', '-Tascii'], input=page.out.encode(), stdout=subprocess.PIPE, check=True).stdout
        assert b'22/7' in text and b'--' in re.sub(rb'.\x08', b'', text)


def complete(*words):
    """What bash offers for the last word."""
    script = run('--help=bash').out
    array = ' '.join("'" + word + "'" for word in words)
    script += f'\nCOMP_WORDS=({array}); COMP_CWORD={len(words) - 1}; _dyadel; printf "%s\\n" "${{COMPREPLY[@]}}"\n'
    done = subprocess.run(['bash', '--norc', '-u'], input=script.encode(), stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=True)
    assert done.stderr == b'', done.stderr
    return done.stdout.decode().split()


def test_bash_completion():
    names = [name for name, _ in commands()]
    assert sorted(complete('dyadel', '')) == sorted(names)
    assert complete('dyadel', 'del') == ['delaunay']
    assert complete('dyadel', '--quiet', 'conv') == ['converge']
    for name in names:
        offered = {word for word in complete('dyadel', name, '-') if word.startswith('--')}
        assert offered == set(options(help_of(name))), name
    assert set(complete('dyadel', '--')) == set(options(help_of()))
    assert complete('dyadel', 'delaunay', '--max') == ['--max-bits', '--max-pairs', '--max-bytes']
    assert complete('dyadel', 'delaunay', '--schedule', 'u') == ['uniform']
    assert complete('dyadel', 'tolerance', '--metric', '') == ['euclid', 'box']
    assert complete('dyadel', 'delaunay', '--format', '=', 'js') == ['json']
    assert complete('dyadel', 'delaunay', '--format', '=') == complete('dyadel', 'delaunay', '--format', '')
    assert complete('dyadel', 'converge', '--format', '') == ['csv', 'json', 'html']
    assert complete('dyadel', 'delaunay', '--until', 'a') == ['area:']
    assert complete('dyadel', '--help', '=', '') == ['man', 'bash', 'zsh']
    for words in (('delaunay', '-o', ''), ('delaunay', '--max-bits', ''), ('delaunay', ''), ('delaunay', 'no')):
        assert complete('dyadel', *words) == []  # names of files, or nothing


def test_zsh_completion():
    script = run('--help=zsh')
    expect(script, 0, r'\A#compdef dyadel', r'\A\Z')
    for name, _ in commands():
        part = re.search(rf'^    {name}\) options=\((.*?)^      \) ;;', script.out, re.M | re.S)[1]
        assert set(re.findall(r'--[\w-]+(?==|\[|\})', part)) == set(options(help_of(name))), name
    if shutil.which('zsh'):
        subprocess.run(['zsh', '-n'], input=script.out.encode(), check=True)


def test_readme():
    with open(os.path.join(DATA, '..', '..', 'README.md'), encoding='utf-8') as f:
        readme = f.read()
    for option in re.findall(r'`(--[a-z-]+)', readme):
        assert option in options(help_of()), f'README knows {option}, the command does not'
    for name, operands in commands():
        assert f'`dyadel {name} {operands}`' in readme, f'README does not know dyadel {name}'


def test_help_of_one_command():
    """It has examples, and names no option that the command does not take, nor what options do in other commands."""
    whole = run('--help').out
    names = re.findall(r'^  ([a-z]+) ', whole.split('Commands\n')[1].split('\n\n')[0], re.M)
    assert len(names) == 10, names
    for name in names:
        text, _, rest = run('help', name).out.partition('\nExamples\n')
        taken = set(re.findall(r'^  (?:-\w, )?--([a-z-]+)', text, re.M))
        options = text[text.index('\nInput\n'):] if '\nInput\n' in text else text
        assert set(re.findall(r'--([a-z]+(?:-[a-z]+)*)', options)) <= taken, (name, set(re.findall('--([a-z-]+)', options)) - taken)
        assert f'  dyadel {name} ' in rest or f'dyadel {name} ' in rest, name
        others = [f'{other}: ' for other in names if other != name]
        assert not any(re.search(r'(^|[;,] )\s*' + other, line) for other in others for line in options.splitlines()), name


def test_help_into_a_full_device():
    with open('/dev/full', 'w', encoding='utf-8') as full:
        for arguments in (['--help'], ['--version'], ['--help=man']):
            assert subprocess.run([COMMAND, *arguments], stdout=full, stderr=subprocess.PIPE, check=False).returncode == 1


def test_check_replays():
    """A schedule is played on the points of a file or of an oracle, whatever other input options say."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder)
        (path / 'schedule').write_text('# moves\nbase 8\nseed 5\n1 0 16\n1 1 16\n2 0 40\n')
        (path / 'points').write_text('sqrt(2) 0\n1 pi\n0 0\n')
        (path / 'table').write_text('x,y\n1,2\n5,pi\nsqrt(3),0\n')
        oracle = f'{sys.executable} {DATA}/../programs/polygon.py 7 200'
        for points in (['points'], ['--oracle', oracle], ['--columns', 'y,x', 'table']):
            played = run('check', *points, '--replay', 'schedule', cwd=folder)
            expect(played, 0, r'^fine,1,3,')
        expect(run('check', '--replay', 'schedule', cwd=folder), 2, err='the points file is missing')
        expect(run('check', 'points', '--replay', 'none', cwd=folder), 1, err='none: cannot open')
        (path / 'schedule').write_text('2 0 16\n1 0 16\n')
        for text, where in ((b'2 0 16\n1 0 16\n', '2:1: this stage comes after a later one; sort'),
                            (b'base 8\n1 0 16\n 2 99 20\n', '3:4: there is no point 99 among these 3 points; give'),
                            (b'1 0 16\n\0\xff\n', '2:1: a NUL byte; give'),
                            (b'1 0 16\n\xff\n', '2:1: this is not a move; give STAGE POINT BITS'),
                            (b'1 0 16 7\n', '1:8: this is not a move'), (b'1 0\n', '1:4: this is not a move'),
                            (b'0 0 16\n', '1:1: this is not a move'), (b'1 0 9999999999999999999\n', '1:5: this is not'),
                            (b'base 0\n', '1:1: this is not a move'), (b'1 0 16' + b' ' * (1 << 20), '1:1: this line is longer')):
            (path / 'schedule').write_bytes(text)
            expect(run('check', 'points', '--replay', 'schedule', cwd=folder), 1, r'\A\Z', f'\\Adyadel: schedule:{where}')


# Point 1 of three leaves its box by 2^-169 at each request of more than 170 bits; its error message is long.
DRIFTS = """import sys
print('points', 3, flush=True)
last = [0, 0, 0]
for line in sys.stdin:
    word = line.split()
    i, bits = int(word[1]), int(word[2])
    bits = last[i] = max(bits, last[i])
    n = (26 << bits) + (1 << bits) // 3 + (i << bits)
    if i == 1 and bits > 170:
        n += 1 << bits - 169
    print(f'{i} {n}*2^-{bits} {n + 1}*2^-{bits} {n * i}*2^-{bits} {n * i + 1 + i}*2^-{bits}', flush=True)
"""


def test_check_walks_to_the_cap():
    """A source that leaves its box late is found by default; the message tells the ends apart, and what --trace wrote
    shows it again, however long the message is."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder)
        (path / 'drifts.py').write_text(DRIFTS)
        oracle = ('--oracle', f'{sys.executable} drifts.py')
        found = run('check', *oracle, '--trace', 'schedule', cwd=folder)
        expect(found, 1, r'^stream,1,', r'point 1, asked for 1\d\d bits: .*is not inside the old one')
        ends = 'the new . side (?:from|up to) (\\S+) is not inside the old one (?:from|up to) (\\S+):'
        new, old = re.search(ends, found.err).groups()
        assert new != old, found.err
        text = (path / 'schedule').read_text()
        assert max(map(len, text.splitlines())) > 256, text
        again = run('check', *oracle, '--replay', 'schedule', cwd=folder)
        expect(again, 1, r'^stream,1,', re.escape(found.err.splitlines()[0].split(': ', 3)[-1]))


def test_check_replays_long_messages():
    """A comment of any length up to that of a line is passed over."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder)
        (path / 'points').write_text('sqrt(2) 0\n1 pi\n0 0\n')
        (path / 'schedule').write_text('# dyadel check schedule: ' + 'x' * 5000 + '\nbase 8\nseed 5\n1 0 16\n')
        expect(run('check', 'points', '--replay', 'schedule', cwd=folder), 0, r'^fine,1,2,')


def test_check_limits():
    """check ends in time, and finds no fault in a side that is fixed or as wide as a radius makes it."""
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / 'points').write_text('sqrt(2) [0,1]\n0 sqrt(3)\n-1 0\n1/3 -1\n')
        for options in ([], ['--radius', '0.1'], ['--max-bits', '40']):
            expect(run('check', 'points', '--schedules', '6', *options, cwd=folder), 0, r'^fine,6,')
        expect(run('check', 'points', '--schedules', '1000000', '--timeout', '0.5', cwd=folder), 4, r'^fine,',
               err='time limit reached after [0-9]+ schedules .raise --timeout')


main(globals())
