#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The library as another language sees it: plain numbers, texts, and no struct of GMP.

Usage: test_ctypes.py LIBRARY   (points as text, and a callback that narrows sqrt(2) in integers)
"""
import math
import sys
from ctypes import (CDLL, CFUNCTYPE, POINTER, Structure, byref, c_char, c_char_p, c_int, c_int64, c_size_t, c_uint32,
                    c_uint64, c_void_p, sizeof)

LEGAL, E_ARG, E_PARSE, E_STREAM, DECIDED = 3, -2, -4, -7, 1


class Error(Structure):
    _fields_ = [('code', c_int), ('point', c_size_t), ('stage', c_uint64), ('line', c_size_t), ('column', c_size_t),
                ('message', c_char * 400)]


class Request(Structure):
    _fields_ = [('struct_size', c_size_t), ('point', c_size_t), ('bits', c_int64), ('max_bits', c_int64),
                ('stop', POINTER(c_int))]


Narrow = CFUNCTYPE(c_int, c_void_p, c_void_p, POINTER(Request), POINTER(Error))
Release = CFUNCTYPE(None, c_void_p)


class Source(Structure):
    """As a caller has it that was written before `announce` was thought of."""
    _fields_ = [('struct_size', c_size_t), ('narrow', Narrow), ('release', Release), ('user', c_void_p)]


class Pair(Structure):
    _fields_ = [('i', c_uint32), ('j', c_uint32), ('status', c_int)]


class PairList(Structure):
    _fields_ = [('count', c_size_t), ('item', POINTER(Pair))]


lib = CDLL(sys.argv[1])
lib.dyd_engine_delaunay.restype = c_void_p
lib.dyd_rect_narrow_text.argtypes = [c_void_p, c_char_p, c_size_t, POINTER(Error)]
asked = []


def narrow(out, _user, request, err):
    """Point k is (k, sqrt(2)); point 2 fails."""
    point, bits = request[0].point, request[0].bits
    asked.append(bits)
    if point == 2:
        return lib.dyd_error_set(err, E_STREAM, b'the instrument is off')
    scale = 2 ** max(bits, 0)
    root = math.isqrt(2 * scale * scale)
    text = f'{point} {point} {root}/{scale} {root + 1}/{scale}'.encode()
    return lib.dyd_rect_narrow_text(out, text, len(text), err)


def check(wanted, status, err):
    assert status == wanted, (status, err.message)


def engine_of(count, *texts):
    err, engine = Error(), c_void_p()
    check(0, lib.dyd_engine_new(byref(engine)), err)
    for text in texts:
        check(0, lib.dyd_engine_add_text(engine, text, c_size_t(len(text)), None, byref(err)), err)
    source = Source(sizeof(Source), Narrow(narrow), Release(), None)
    check(0, lib.dyd_engine_add_source(engine, c_size_t(count), byref(source), byref(err)), err)
    return engine, source


def run(engine, wanted=0):
    err, outcome = Error(), c_int()
    check(wanted, lib.dyd_engine_run(byref(outcome), engine, None, byref(err)), err)
    return outcome.value, err


def pairs_of(engine):
    pairs = PairList()
    assert lib.dyd_delaunay_pairs(byref(pairs), c_void_p(lib.dyd_engine_delaunay(engine))) == 0
    found = [(p.i, p.j, p.status) for p in pairs.item[:pairs.count]]
    lib.dyd_pair_list_clear(byref(pairs))
    return found


def main():
    # Nearly a rectangle: sqrt(2) against its first 20 digits decides the diagonal.
    engine, source = engine_of(1, b'1 0\n0 0  # two lines\n', b'1 1.4142135623730950488')
    assert run(engine)[0] == DECIDED
    assert pairs_of(engine) == [(0, 1, LEGAL), (0, 2, LEGAL), (1, 2, LEGAL), (1, 3, LEGAL), (2, 3, LEGAL)]
    assert asked and max(asked) > 60
    lib.dyd_engine_free(engine)

    engine, source = engine_of(3, b'5 5')
    outcome, err = run(engine, E_STREAM)
    assert err.message == b'the instrument is off' and err.point == 3, err.message
    lib.dyd_engine_free(engine)

    err, none = Error(), c_void_p()
    check(0, lib.dyd_engine_new(byref(none)), err)
    check(E_PARSE, lib.dyd_engine_add_text(none, b'1 2\n3 x', c_size_t(7), None, byref(err)), err)
    assert (err.line, err.column) == (2, 3)
    source.struct_size = 0
    check(E_ARG, lib.dyd_engine_add_source(none, c_size_t(1), byref(source), byref(err)), err)
    assert b'DYD_SIZED(dyd_source)' in err.message
    lib.dyd_engine_free(none)
    print(f'{len(asked)} questions asked')


main()
