# SPDX-License-Identifier: LGPL-3.0-or-later
"""Makes C of the texts of the command: the rows of its table of options and of that of its commands, and what --help, the
manual page and the completion scripts say besides.

Usage: pack.py options.txt manual.txt completion.bash completion.zsh OPTIONS.inc COMMANDS.inc MANUAL.inc
"""
import json
import pathlib
import re
import sys

HEAD = re.compile(r'--(?P<name>[\w-]+)(?:, -(?P<letter>\w))?(?: (?P<argument>\S+))? = (?P<field>[\w.]+)')


def quoted(text):
    return json.dumps(text, ensure_ascii=False) if text else 'NULL'


def lines_of(path):
    return [line for line in pathlib.Path(path).read_text(encoding='utf-8').splitlines() if not line.startswith('#')]


def option(head, group, text, commands):
    """A row of cli_option_table."""
    name, kind, takers, *rest = head.split('; ')
    name = HEAD.fullmatch(name)
    kind, _, values = kind.partition(' ')
    row = [quoted(name['name']), f"'{name['letter']}'" if name['letter'] else '0', quoted(name['argument']),
           f'CLI_{kind.upper()}', re.sub(rf'\b({"|".join(commands)})\b', lambda m: f'BIT(CLI_{m[1].upper()})', takers),
           f'CLI_{group.upper()}', quoted('\n'.join(text)), f"AT({name['field']})"]
    if kind == 'choice':
        row.append(f'WORDS({quoted(values)})')
    elif values:
        row.append('RANGE({}, {})'.format(*values.split(' .. ')))
    for word, _, value in (entry.partition(' ') for entry in rest):
        row.append({'words': f'WORDS({quoted(value)})', 'given': f'GIVEN({value})', 'silent': 'SILENT'}[word])
    return '{' + ', '.join(row) + '},\n'


def options(lines, commands):
    rows, group, head, text = [], None, None, []
    for line in lines + ['']:
        if line.startswith('    '):
            text.append(line[4:])
        elif head:
            rows.append(option(head, group, text, commands))
            head, text = None, []
        if line.startswith('--'):
            head = line
        elif line and line[0] != ' ':
            group = line
    return ''.join(rows)


def terms(lines):
    """The terms, which are not indented, each with the lines below it."""
    found = []
    for line in lines:
        if line and line[0] != ' ':
            found.append((line, []))
        elif found:
            found[-1][1].append(line.strip())
    return found


def sections(lines):
    found = {}
    for line in lines:
        if line.startswith('== '):
            found[line[3:]] = part = []
        elif found:
            part.append(line)
    return found


def command(term, text):
    """A row of cli_commands."""
    name, _, operands = term.partition(' ')
    line, _, *about = text
    content = {'verify': 'NONE', 'converge': 'CONVERGENCE'}.get(name, name.upper())
    return (f'[CLI_{name.upper()}] = {{{quoted(name)}, {quoted(operands)}, {quoted(line)}, '
            f'{quoted(chr(10).join(about).strip())}, DYD_CONTENT_{content}, &cli_{name}}},\n')


def prose(name, lines):
    if any(line.startswith('    ') for line in lines):
        rows = ''.join(f"{{{quoted(term)}, {quoted(' '.join(text).strip())}}},\n" for term, text in terms(lines))
        return f'static const help_term help_{name}[] = {{\n{rows}{{NULL, NULL}}}};\n'
    text = (' ' if name == 'oracle' else '\n').join(lines).strip()
    return f'static const char help_{name}[] = {quoted(text)};\n'


def main():
    table, manual, bash, zsh, *out = sys.argv[1:]
    parts = sections(lines_of(manual))
    commands = terms(parts.pop('commands'))
    scripts = (f'static const char help_{pathlib.Path(path).suffix[1:]}[] = '
               f"{quoted(pathlib.Path(path).read_text(encoding='utf-8'))};\n" for path in (bash, zsh))
    rows = options(lines_of(table), [term.partition(' ')[0] for term, _ in commands])
    made = rows, ''.join(command(*entry) for entry in commands), ''.join([*(prose(*part) for part in parts.items()), *scripts])
    for path, text in zip(out, made):
        pathlib.Path(path).write_text('/* Made by pack.py. */\n' + text, encoding='utf-8')


if __name__ == '__main__':
    main()
