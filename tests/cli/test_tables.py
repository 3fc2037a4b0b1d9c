#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tables as people have them: no header, blanks, units, thousands, missing words, other encodings and ends of lines.
Ambiguous input is refused with the option for each reading; input that is not a table is named, with a command that
makes one.

Usage: test_tables.py COMMAND DATA
"""
import json
import os
import pathlib
import random
import re
import shutil
import subprocess
import tempfile
from fractions import Fraction

from harness import COMMAND, cases, expect, main, run, share

HEAD = 'i,j,status\n'
THREE = HEAD + '0,1,legal\n0,2,legal\n1,2,legal\n'

# Options and text: each holds the points 1 2, 1234.5 5, 5 1000.
SAME = [
    ('--columns x,y', 'x,y\n1,2\n1234.5,5\n5,1000\n'),
    ('--columns x,y', 'x,y\n(3-2),22/11\n2469/2,1/2*10\n5,1e3\n'),
    ('--columns 2,3 --no-header --decimal-comma', '1;1;2,0\n2;1234,5;5\n3;5,0;1000\n'),
    ('--columns x,y --delimiter blank', 'x  y\n 1\t2\n1234.5   5  \n\n   \n5 1000\n'),
    ('--columns x,y --delimiter blank', '"x"  "y z"  y\n 1 "a ""b" 2\n1234.5 c  5  \n5 d 1000\n'),
    ('--columns x,y', 'x y n\n1 2 a\n1234.5 5 b\n5 1000 c\n'),
    ('--columns x,y', '# written by hand\n# x y z\n1 2 3\n1234.5 5 3\n5 1000 3\n'),
    ('--columns x,y', '% x y z\n1 2 3 1\n1234.5 5 3 1\n5 1000 3 1\n'.replace('% x y z', '% x y z w')),
    ('--columns x,y', '% t x y\n01 00:00 1 2\n01 00:00 1234.5 5\n01 00:00 5 1000\n'),
    ('--columns x,y', '#x\ty\n1\t2\n1234.5\t5\n5\t1000\n'),
    ('--columns 1,2', '# x y\n1 2\n1234.5 5\n5 1000\n'),
    ('--columns 1,2 --no-header', '1,2\n1234.5,5\n5,1000\n'),
    ('--columns 2,1 --no-header', '# of today\n2;1\n% half\n5;1234.5\n1000;5\n'),
    ('--columns 3,2 --no-header', 'a|2|1|\nb|5|1234.5|\nc|1000|5|\n'),
    ('--columns 1,2 --no-header --skip-lines 3', 'a\n"b\n\n1,2\n1234.5,5\n5,1000\n'),
    ('--skip-lines 1', 'x y\n1 2\n% comment\n  % another\n1234.5 5\n5 1000\n'),
    ('--columns x,y --units-row', 'x,y\nm,m\n1,2\n1234.5,5\n5,1000\n'),
    ('--columns x,y', 'sep=;\nx;y;a,b\n1;2;0\n1234.5;5;0\n5;1000;0\n'),
    ('--columns x,y', '"sep=|"\nx|y\n1|2\n1234.5|5\n5|1000\n'),
    ('--columns x,y', 'x,y,name,\n1,2,a\n1234.5,5,b\n5,1000,c\n'),
    ('--columns x,y', 'x,y,name\n1,2,a,\n1234.5,5,b,\n5,1000,c,\n'),
    ('--columns x,y', 'x,y\r1,2\r1234.5,5\r5,1000\r'),
    ('--columns x,y', 'id, "x", "y"\nA, "1", "2"\nB, "1234.5" , "5"\nC, "5", "1000"\n'),
    ('--columns x,y', '| id | x | y |\n|:---|--:|---|\n| A | 1 | 2 |\n| B | 1234.5 | 5 |\n| C | 5 | 1000 |\n'),
    ('--columns x,y', ' id |   x    |  y  \n----+--------+-----\n A  |      1 |    2\n B  | 1234.5 |    5\n C  |      5 | 1000\n'),
    ('--columns x,y', 'x      y   n\n------ --- -\n1      2   a\n1234.5 5   b\n5    1000  c\n'),
    ('--columns x,y --units-row', 'x,y\n-,m\n1,2\n1234.5,5\n5,1000\n'),
    ('--columns x,y', 'x,y\n1,2\n1234.5,5\n5,1000\n\x1a'),
    ('', '1 2\n1234.5 5\n5 1000\n\x1a\n'),
    ('', '1 2\r1234.5 5\r5 1000'),
    ('--columns x,y --thousands ,', 'x,y\n1,2\n"1,234.5",5\n5,"1,000"\n'),
    ('--columns x,y --decimal-comma --thousands .', 'x;y\n1;2\n1.234,5;5\n5;1.000\n'),
    ('--columns x,y --decimal-comma --thousands blank', 'x;y\n1;2\n1 234,5;5\n5;1\u202f000\n'),
    ('--columns x,y --decimal-comma --thousands blank', 'x;y\n1;2\n1\xa0234,5;5\n5;+1\u2009000\n'),
    ('--columns x,y --thousands \'', "x;y\n1;2\n1'234.5;5\n5;1’000\n"),
    ('--columns x,y --thousands ’', "x;y\n1;2\n1'234.5;5\n5;1’000\n"),
    ('--columns x,y --thousands _', 'x;y\n1;2\n1_234.5;5\n5;1_000\n'),
    ('--columns x,y --decimal-comma', 'x,y\n1,2\n"1234,5",5\n5,"1000,000"\n'),
    ('--columns x,y', 'n,x,y\n="01",="1",2\n="a,b",="1234.5",5\n="",5, ="1000"\n'),
    ('--columns x,y', 'x,y\n"=""1""",2\n"=""1234.5""",5\n5,"=""1000"""\n'),
    ('--columns geom,geom', 'geom\n"EPSG:25832;POINT(1 2)"\n"SRID=25832;POINT(1234.5 5)"\nPOINT(5 1000)\n'),
    ('', 'EPSG:25832;POINT(1 2)\nEPSG:25832;POINT(1234.5 5)\nPOINT(5 1000)\n'),
]


def test_same_points():
    for k, (options, text) in enumerate(SAME):
        for data in share((text, text.replace('\n', '\r\n'), text.replace('\n', '\r')), k):
            result = run('delaunay', *options.split(), '-', stdin=data)
            assert (result.code, result.out, result.err) == (0, THREE, ''), (options, data, result)


# Options and text; exit status and message.
TOLD = [
    ('--columns x,y', 'x,y\n999,5\n"1,001",7\n', 1, r'-:3:3: .*; if this is 1001, give --thousands ,; if it is 1.001, give --thousands . --decimal-comma$'),
    ('--columns x,y', 'x,y\n"1,001.5",7\n', 1, r'; if this is 1001.5, give --thousands ,$'),
    ('--columns x,y', 'x,y\n"-1,234,567",7\n', 1, r'; if this is -1234567, give --thousands ,$'),
    ('--columns x,y', 'x;y\n3.456.789,12;7\n', 1, r'; if this is 3456789.12, give --thousands . --decimal-comma$'),
    ('--columns x,y', 'x;y\n3.456.789;7\n', 1, r'; if this is 3456789, give --thousands . --decimal-comma$'),
    ('--columns x,y', 'x;y\n691 000,5;7\n', 1, r'; if this is 691000.5, give --thousands blank --decimal-comma$'),
    ('--columns x,y', 'x;y\n691\xa0000;7\n', 1, r'; if this is 691000, give --thousands blank$'),
    ('--columns x,y', "x;y\n691'000;7\n", 1, r'; if this is 691000, give --thousands "\'"$'),
    ('--columns x,y', 'x;y\n47,61;7\n', 1, r'; where commas are decimal points, give --decimal-comma$'),
    ('--columns x,y --decimal-comma', 'x;y\n3.456.789,12;7\n', 1, r'; if this is 3456789.12, give --thousands . --decimal-comma$'),
    ('--columns x,y --decimal-comma', 'x,y\n999,5\n"1,001",7\n', 1, r'-:3:2: .*give --thousands , instead of --decimal-comma if they are, or --thousands . as well'),
    ('--columns x,y --decimal-comma --thousands .', 'x,y\n999,5\n"1,001",7\n', 0, ''),
    ('--columns x,y --decimal-comma', 'x;y\n1,001;7\n', 0, ''),
    ('--columns x,y --thousands ,', 'x,y\n"1,00",7\n', 1, r'-:2:2: what --thousands names is not between groups of three digits'),
    ('--columns x,y --thousands ,', 'x,y\n"1,0001",7\n', 1, 'groups of three digits'),
    ('--columns x,y --thousands ,', 'x,y\n"1234,000",7\n', 1, 'groups of three digits'),
    ('--columns x,y --thousands ,', 'x,y\n"1,000.123,4",7\n', 1, 'groups of three digits'),
    ('--columns x,y --thousands , --decimal-comma', 'x,y\n', 2, 'not both: --thousands or --decimal-comma$'),
    ('--columns x,y --thousands .', 'x,y\n', 2, 'give --decimal-comma as well$'),
    ('--columns x,y --thousands xx', 'x,y\n', 2, r'"xx" is not between thousands; --thousands is one of , \. \' _ or blank$'),
    ('--thousands ,', '1 2\n', 2, '--thousands is about columns'),
    ('--no-header', '1 2\n', 2, '--no-header is about columns'),
    ('--units-row', '1 2\n', 2, '--units-row is about columns'),
    ('--skip-lines 00000000009', '1 2\n', 1, '-: the file has fewer lines than --skip-lines 00000000009$'),
    ('--skip-lines -1', '1 2\n', 2, 'give one such as --skip-lines 3$'),
    ('--skip-lines x', '1 2\n', 2, 'give one such as --skip-lines 3$'),
    ('--skip-lines 9', '1 2\n', 1, '-: the file has fewer lines than --skip-lines 9$'),
    ('--columns x,y --no-header', '1,2\n', 2, 'without a header columns have numbers, .* "x": --columns$'),
    ('--columns 1,3 --no-header', '1,2\n', 1, '-:1:1: there is no column 3; the first line has 2, counted from 1$'),
    ('--columns 1,2 --no-header', 'x,y\n1,2\n', 1, '; if this line names the columns, remove --no-header$'),
    ('--columns 1,2 --no-header', '1,2\n1,2,3\n', 1, '-:2:1: this record has 3 fields, the first one 2; quote'),
    ('--columns 1,2 --no-header', '', 0, 'this file has no points'),
    ('--columns 1,2', '1,2\n3,4\n', 1, r'-:1:1: the first line holds numbers, .*, give --no-header, and where these are names, put them into quotes$'),
    ('--columns x,y', 'x,y\nm,m\n1,2\n', 1, r'-:2:1: .*; if this line holds units, give --units-row$'),
    ('--sphere --columns x,y --radius-unit m --radius-column r(mm)', 'x,y,r(mm)\n1,2,3\n', 2, 'the radius is in mm, and --radius-unit says m; remove --radius-unit'),
    ('--sphere --columns x,y --radius-unit mm --radius-column r(mm)', 'x,y,r(mm)\n1,2,3\n', 0, ''),
    ('--sphere --columns x,y --radius-unit deg --confidence .5 --sigma-column a,b(m)', 'x,y,a,b(m)\n1,2,3,4\n', 2, 'the standard deviation is in m, and --radius-unit says deg'),
    ('--sphere --columns x,y --units-row --radius-unit m --radius-column r', 'x,y,r\ndeg,deg,km\n1,2,3\n', 2, 'the radius is in km, and --radius-unit says m'),
    ('--sphere --columns x,y --units-row --radius-column r(mm)', 'x,y,r(mm)\ndeg,deg,km\n1,2,3\n', 1, r'-:2:9: the name of this column states another unit'),
    ('--columns x,y --units-row', 'x,y\n1,2\n', 1, r'-:2:1: this row holds numbers, not units; remove --units-row$'),
    ('--columns x,y', 'x,y\n1,2 m\n', 1, r'; coordinates are numbers without a unit: give 2$'),
    ('--columns x,y --radius-column r', 'x,y,r\n1,2,0.02 m\n', 1, r'-:2:9: radii in the plane are in the unit of the coordinates: .* by --radius-scale$'),
    ('--radius 0.02m', '1 2\n', 2, 'the radius "0.02m" has a unit, but radii in the plane are in the unit of the coordinates'),
    ('--columns x,y', 'x,y\n1,2\n#3,4\n% c,4\n', 0, r'begin with # or % and may be rows: 1; they are skipped as comments$'),
    ('--columns x,y', 'n,x,y\n%,1,2\n', 0, r'this file has no points'),
    ('--sphere --columns lat,lon', 'lon,lat\n1,2\n', 2, 'longitude comes first: --columns lon,lat$'),
    ('--sphere --columns 1,2', 'Lat (deg),Lon (deg)\n1,2\n', 2, r"longitude comes first: --columns 'Lon \(deg\),Lat \(deg\)'$"),
    ('--columns x,y', 'Survey of 2024\nOperator: Smith, J.\n\nid,x,y\nA,1,2\n', 1, r'-:1:1: line 4 has the names of the columns: pass over those before it by --skip-lines 3$'),
    ('--columns x,y', 'Station,Coordinates,,Quality\n,x,y,sigma\nA,0,0,0.1\n', 1, r'line 2 has .*--skip-lines 1$'),
    ('', 'Survey of 2024\nOperator: Smith, J.\n\nid,x,y\nA,1,2\n', 1, r'-:4:1: this line is a header .*: --skip-lines 3 --columns x,y \(it has: id, x, y\)$'),
    ('', 'Station,Coordinates,,Quality\n,x,y,sigma\nA,0,0,0.1\n', 1, r'-:2:1: this line is a header .*: --skip-lines 1 --columns x,y '),
    ('', 'Name,X,Y,\nA,1,2,\n', 1, r'-:1:1: this line is a header .*: --columns X,Y '),
    ('', ',x,y\n0,1,2\n', 1, r'-:1:1: this line is a header .*: --columns x,y '),
    ('', '@id\t@lat\t@lon\n7\t1\t2\n', 1, r"this line is a header .*: --columns '@lon,@lat' "),
    ('', 'sep=,\nid,x,y\nA,1,2\n', 1, r'-:2:1: this line is a header .*: --columns x,y '),
    ('', 'geom,id\nPOINT (1 2),3\n', 1, r'--columns geom,geom '),
    ('', '// by a tool\n1 2\n', 1, r'; comments begin with # or %: pass over the first lines by --skip-lines N$'),
    ('', '; by\n1 2\n', 1, r'-:1:1: unexpected ";"; .*--skip-lines N$'),
    ('', '(0, 1)\n(2, 3)\n', 1, r"; pairs in brackets: sed -E '.*' FILE writes one a line, without them$"),
    ('', '3\nC 1 2 0\n', 1, '; if this is the number of points, pass over it by --skip-lines 1$'),
    ('', '> part\n1 2\n', 1, "grep -v '\\^>' FILE$"),
    ('', '1\xa02\n', 1, "its blank is one that does not break: sed "),
    ('', '1 & 2 \\\\\n', 1, "columns of LaTeX: sed"),
    ('', '0101000000000000000000F03F0000000000000040\n', 1, "; this is WKB; .* --columns wkb,wkb$"),
    ('--columns x,y', 'id,x,y\nA,1,2\nid,x,y\nB,2,3\n', 1, r'-:3:4: this line is the header again; remove it$'),
    ('--columns x,y', 'id,x,y\nA,1\n', 1, r'-:2:1: this record has 2 fields, the header 3; complete the line, or remove it$'),
    ('--columns x,y', ' id | x\n A | 1\n(1 row)\n', 1, r'no column is called "y"'),
    ('--columns x,y', ' x | y\n 1 | 1\n(1 row)\n', 1, r'-:3:1: this record has 1 field, the header 2; complete the line, or remove it$'),
    ('--columns x,y', 'id,x,y\nA,1,2\rB,3,4\nC,5,9\n', 1, r"-:2:1: .* a CR alone ends a line in it: tr '\\r' '\\n' < FILE "),
    ('--columns x,y', '"x" "y"\n"1" 0 0\n', 1, r'-:2:2: .* as R writes tables, give --skip-lines 1 --no-header and numbers to --columns$'),
    ('--columns 2,3 --no-header --delimiter blank', '4 2 0 0\n1 0 0\n', 1, r'lines before the table are passed over by --skip-lines$'),
    ('--columns x,y', 'x,y\n2024-01-02,0\n', 1, r'-:2:1: this is a date, a range or a mixed number; write a range as \[1\.2,1\.4\]'),
    ('--columns x,y', 'x,y\n5,1.2-1.4\n', 1, r'-:2:3: this is a date, a range'),
    ('--columns x,y', 'x,y\n5,-1.2-1.4\n', 1, r'-:2:3: this is a date, a range'),
    ('--columns x,y', 'x,y\n1/2/2024,0\n', 1, r'-:2:1: this is a date, a range'),
    ('--columns x,y', 'x,y\n5-1/2,0\n', 1, r'-:2:1: this is .* a mixed number; .* 5 1/2 as \(5\+1/2\)'),
    ('--columns x,y', 'x,y\n(5-1/2),1/3\n', 0, ''),
    ('--columns x,y', 'x,y\n7,(1.5)\n', 1, r'-:2:3: a number in brackets may be one below 0;'),
    ('--columns x,y', 'x,y\n1.5+103,2\n', 1, r'-:2:1: Fortran writes 1\.5e103 as 1\.5\+103;'),
    ('--columns x,y', 'x,y\n1.5+10,2\n', 0, ''),
    ('--columns x,y', 'x,y\n<NA>,2\n', 1, r'-:2:1: the coordinate is missing \(<NA>\)'),
    ('--columns x,y --skip-missing', 'x,y\n-1.#IND,2\n1,1.#QNAN\n-nan(ind),3\n', 0, '3 of 3 rows are skipped'),
    ('--columns x,y', 'x,y\n1,2\n3;4\n', 1, r'-:3:1: .*; columns are separated by semicolons here, and by commas before; make all lines alike$'),
    ('', 'SRID=4326;POINT(1 2)\nSRID=3857;POINT(3 4)\n', 1, r'-:2:1: SRID 3857 here, and 4326 before; transform all'),
    ('--columns g,g', 'g\nEPSG:25832;POINT(1 2)\nEPSG:25833;POINT(3 4)\n', 1, r'-:3:1: SRID 25833 here, and 25832 before;'),
    ('', 'POINT(1 2),3 7\n', 1, r'-:1:12: there is more than a geometry on this line; .*--columns G,G, or without a header --no-header --columns 1,1$'),
    ('--no-header --columns 1,1', 'POINT(1 2),3 7\nPOINT(4 2),name\n', 0, ''),
    ('', 'POINT(1 2\nPOINT(3 4)\n', 1, r'-:1:10: the parentheses of this geometry do not match'),
    ('', 'POINT(1,2)\n', 1, r'-:1:8: this place has one coordinate only; two have a blank between'),
    ('', 'POINT(inf 2)\n', 1, r'-:1:7: .*infinite'),
    ('--columns g,g', 'g\n"POINT(1 2),POINT(3 4)"\n', 1, 'this geometry is not a POINT'),
    ('', 'SRID=4326;POINT(1 2)\n', 0, 'taken as coordinates in a plane; .* --sphere'),
    ('--columns x_km,y_m', 'x_km,y_m\n1,2\n', 2, 'x is in km and y in m; convert one of them'),
    ('--columns 1,2', 'x [ft];y [m]\n1;2\n', 2, 'x is in ft and y in m'),
    ('--columns x,y --units-row', 'x,y\nkm,m\n1,2\n', 2, 'x is in km and y in m'),
    ('--columns x_m,y_in_m', 'x_m,y_in_m\n1,2\n', 0, ''),
    ('--columns lonE7,latE7 --sphere', 'latE7,lonE7\n476101234,-122.3\n', 1, r'-:2:11: columns called E7 hold integers, of 1e-7 degrees'),
    ('--columns latE7,lonE7 --sphere', 'latE7,lonE7\n476101234,-1223\n', 2, 'longitude comes first: --columns lonE7,latE7$'),
    ('--columns lon_rad,lat_rad --sphere', 'lat_rad,lon_rad\n0.8,-1.2\n', 2, r'in another unit \(rad\); coordinates on the sphere are degrees'),
    ('--columns 2,1 --sphere', 'lat (gon),lon [gon]\n0.8,-1.2\n', 2, r'in another unit \(gon\)'),
    ('--columns 2,1 --sphere', 'lat (arcsec),lon (arcsec)\n0.8,-1.2\n', 2, r'in another unit \(arcsec\)'),
    ('--columns 2,1 --sphere', 'lat (deg),lon (deg)\n0.8,-1.2\n', 0, ''),
    ('--columns lon_deg,lat_deg --sphere', 'lat_deg,lat_min,lon_deg\n47,36,8\n', 1, r'-:2:7: degrees and minutes are in columns apart'),
    ('--columns LonDegrees,LatDegrees --plane', 'LatDegrees,LatMinutes,LonDegrees\n47,36,8\n', 1, r'degrees and minutes are in columns apart'),
    ('--columns lon_deg,lat_deg --sphere', 'lat_deg,lat_min,lon_deg\n47.6,36,8.1\n47:36.5,0,8:1\n', 0, ''),
    ('--columns lon,lat --sphere', 'lat,ns,lon,ew\n47.1,N,122.1,W\n', 1, r'-:2:8: the letter in the column beside makes this number negative; .*122\.5W'),
    ('--columns lon,lat', 'ns;lat;ew;lon\n South;47.1;E;122.1\n', 1, r'-:2:8: the letter in the column beside'),
    ('--columns lon,lat --plane', 'lat,ns,lon,ew\n-47.1,S,122.1W,W\n47,N,8,E\n', 0, ''),
    ('--columns x,y', 'x,y,side\n1,2,S\n3,4,W\n', 0, ''),
    ('--columns lon,lat', 'lat,lon\n4807.038,01131.000\n4808.1,1133.5\n', 0, r"hold degrees and minutes \(ddmm\.mmmm\); for degrees give sed "),
    ('--columns lon,lat', 'lat,lon\n4807.038,01131.000\n4868.1,1133.5\n', 0, ''),
    ('--columns x,y', 'x,y\n3500000,5300000\n4500100,5300100\n4500200,5300000\n', 0, r'begin with numbers of zones, 3 and 4; '),
    ('--columns x,y', 'x,y\n3500000,5300000\n4500100,5300100\n4900200,5300000\n', 0, ''),
    ('--columns lon,lat --sphere', 'lat,lon\n0,0\n47.1,-122.1\n47,-121\n', 0, r'points with 0 for both coordinates: 1; .* --missing 0 --skip-missing$'),
    ('--columns lon,lat --sphere', 'lat,lon\n0,0\n0,10\n10,0\n', 0, ''),
    ('--columns x,y', 'x,y\n1e20,1e20\n1,2\n', 0, r'points with 1e\+20 for both .*--missing 1e\+20 '),
    ('--columns x,y', 'x,y\n0,0\n1,2\n', 0, ''),
    ('--columns lon,lat --plane --crs EPSG:3857 --format geojson', 'lat,lon\n1,2\n3,4\n', 0, 'EPSG:3857 is not known as a system of degrees, and the coordinates are longitude and latitude'),
    ('--columns x,y --crs EPSG:4326 --format geojson', 'x,y\n691000,5334000\n3,4\n', 0, 'EPSG:4326 is a system of degrees, and the coordinates are beyond 180 or 90'),
    ('--columns x,y --crs EPSG:3857 --format geojson', 'x,y\n1,2\n3,4\n', 0, ''),
    ('--columns lon,lat --plane --crs EPSG:4258 --format geojson', 'lat,lon\n1,2\n3,4\n', 0, ''),
    ('--columns lon,lat --sphere', 'lon,lat\n691000,5334289\n', 1, r'-:2:8: the latitude is beyond 90 degrees; give degrees, not metres'),
    ('--columns lon,lat --sphere', 'lon,lat\n48.1,111.5\n', 1, r'-:2:6: the latitude is beyond 90 degrees; longitude comes first'),
    ('', 'ID,XCOORD,YCOORD\n1,1,2\n', 1, r'--columns XCOORD,YCOORD '),
    ('', 'Nr;X [m];Y [m]\n1;5 000,1;6 000,1\n', 1, r"--columns 'X \[m\],Y \[m\]' "),
    ('--columns x,y', 'x,y\ninf,0\n', 1, r"-:2:1: coordinates are finite, .*--missing 'inf' --skip-missing$"),
    ('--columns x,y --radius-column r', 'x,y,r\n1,2.3,0\n9,2,.1\n1,9,0.0\n', 0, r'radii that are 0: 2; these points are taken as exact; .* --missing 0 --skip-missing$'),
    ('--columns lon,lat --sphere --radius-column r', 'lon,lat,r\n1,2.3,0m\n9,2,1m\n1,9,0\n', 0, r'radii that are 0: 2; '),
    ('--columns x,y --discs --radius-column r', 'x,y,r\n1,2.3,0\n9,2,.1\n1,9,.1\n', 0, r'radii that are 0: 1; '),
    ('--columns x,y', 'x,y\n-9999,-9999\n1,2\n', 0, r'points with -9999 for both coordinates: 1; .* --missing -9999 --skip-missing$'),
    ('--columns x,y --missing -9999', 'x,y\n99999,99999\n1,2\n', 0, ''),
    ('--columns x,y', 'x,y\n-9999,9999\n1,2\n', 0, ''),
    ('--columns x,y', 'x,y\n1,2\n\0\0\n', 1, r"-:3:1: a NUL byte; .*tr -d '\\000' < FILE"),
    ('--columns x,y', 'x,\x1b[31my\x9b2J\x07\n1,2\n', 1, r'names are: x, \\x1B\[31my›2J\\x07; give'),
]


def test_told():
    for options, text, code, message in share(TOLD):
        data = text if '\x9b' not in text else text.encode('latin-1')
        expect(run('delaunay', *options.split(), '-', stdin=data), code, r'\A\Z' if code else '', r'\Adyadel: .*' + message if message else r'\A\Z')


def test_missing_words():
    """Each word that means nothing, in x and y and radii, with and without a remedy."""
    words = ['', 'NA', 'N/A', '#N/A', 'NaN', 'nan', '-nan', 'null', 'NULL', 'None', 'none', '-', '\\N', '#VALUE!', '#DIV/0!', '-9999', '-9999.00', 'void']
    for word in words:
        extra = ['--missing', '-9999'] if '9999' in word else ['--missing', 'void'] if word == 'void' else []
        for row in share((f'{word},5,1', f'5,{word},1', f'5,1,{word}'), len(word)):
            text = f'x,y,r\n0,0,0.1\n{row}\n4,1,0.1\n2,6,0.1\n'
            options = ['--columns', 'x,y', '--radius-column', 'r', *extra, '-']
            expect(run('delaunay', *options, stdin=text), 1, r'\A\Z', r'-:3:\d: the .* is (missing|empty).*: --skip-missing$')
            expect(run('delaunay', '--skip-missing', *options, stdin=text), 0, r'\A' + HEAD + '0,2,legal\n0,3,legal\n2,3,legal\n\\Z', '1 of 4 rows are skipped')
    for word in ('-5', '-0', '+', '--', 'N', 'nano'):
        result = run('delaunay', '--skip-missing', '--missing', '9999', '--columns', 'x,y', '-', stdin=f'x,y\n0,0\n4,{word}\n2,6\n')
        assert 'are skipped' not in result.err, (word, result)


def exact(text):
    """m*2^e/d or p/q as a fraction."""
    m, star, e = text.partition('*2^')
    e, _, d = e.partition('/')
    return Fraction(m) * Fraction(2) ** int(e) / int(d or 1) if star else Fraction(m)


def read_exact(lines, *options):
    result = run('delaunay', '--format', 'json', '-q', *options, '-', stdin=''.join(l + '\n' for l in lines))
    assert result.code in (0, 3), result.err
    return {s['i']: [exact(t) for t in (*s['x'], *s['y'])] for s in json.loads(result.out)['sites']}


def degrees_forms():
    """Texts and their values, at random."""
    rand = random.Random(7)
    for _ in range(cases(400)):
        d, m, s = rand.randint(0, 89), rand.randint(0, 59), rand.randint(0, 59999)
        seconds, minutes = f'{s // 1000}.{s % 1000:03}', f'{m}.{s:05}'
        value, rough = d + Fraction(m, 60) + Fraction(s, 3600000), d + Fraction(minutes) / 60
        sign, letter = rand.choice((('', 'N'), ('', 'E'), ('-', 'S'), ('-', 'W')))
        a, b, c = rand.choice(('°', 'º', '˚', 'd')), rand.choice("'′’´"), rand.choice(('"', '″', "''", '”', '′′'))
        for text, v in ((f'{d}{a}{m}{b}{seconds}{c}', value), (f'{d}:{m:02}:{seconds}', value), (f'{d}{a}{minutes}{b}', rough), (f'{d}{a}{m}{b}{seconds}', value),
                        (f'{d}°', Fraction(d)), (f'{d}.{m:02}', Fraction(f'{d}.{m:02}')), (f'{d}:{minutes}', rough)):
            written = text + letter if rand.random() < 0.5 else letter + text
            yield written, v if sign == '' else -v
            if letter not in text and text[-1:] in '"\'°':
                yield text + letter.lower(), v if sign == '' else -v
            if re.search('[°:]', text):
                yield rand.choice((sign, sign.replace('-', '−'))) + text, v if sign == '' else -v


def test_degrees():
    """Every way to write degrees is the exact number, in lines and in tables; blanks may stand between."""
    forms = list(degrees_forms())
    want = {k: v for k, (_, v) in enumerate(forms)}
    got = read_exact(f'{t} {k}' for k, (t, v) in enumerate(forms))
    assert all(got[k][:2] == [want[k]] * 2 for k in want), [(forms[k], got[k]) for k in want if got[k][:2] != [want[k]] * 2][:3]
    got = read_exact(['x;y', *(f'{t};{k}' if '"' not in t or k % 2 else '"' + t.replace('"', '""') + f'";{k}' for k, (t, v) in enumerate(forms))], '--columns', 'x,y')
    assert all(got[k][:2] == [want[k]] * 2 for k in want)
    spread = [re.sub(r"(?<=[°'\"])(?=\d)|(?=[NSEW])(?<=.)", ' ', t) for t, _ in forms]
    spread = [t for t in spread if re.search('[NSEW]', t)] + ['47 36 18.3 N', 'E 8 1 40', '8 1 W']
    whole = read_exact(['x', *spread], '--no-header', '--skip-lines', '1', '--delimiter', '|', '--columns', '1,1')
    for between in (' ', ' , ', ',', '\t'):
        split = read_exact(f'{a}{between}{a}' for a in spread)
        assert split == whole, between
    assert whole[len(spread) - 3][0] == 47 + Fraction(36, 60) + Fraction('18.3') / 3600
    assert (whole[len(spread) - 2][0], whole[len(spread) - 1][0]) == (8 + Fraction(1, 36), -8 - Fraction(1, 60))


def test_degrees_measured():
    """The last digit is rounded, in its own unit; ends are outward by less than 2^-60."""
    for text, middle, half in (('47°36\'18.3"', 47 + Fraction(36, 60) + Fraction('18.3') / 3600, Fraction('0.05') / 3600),
                               ('47:36', 47 + Fraction(36, 60), Fraction(1, 120)), ('W8.5', -Fraction('8.5'), Fraction('0.05'))):
        (xlo, xhi, _, _), = read_exact([text + ', 1'], '--measured').values()
        assert 0 <= middle - half - xlo < Fraction(1, 2**60) and 0 <= xhi - middle - half < Fraction(1, 2**60), text


def test_degrees_refused():
    for text, column, why in (("47°60' 8", 4, 'minutes are below 60'), ('47:36:60 8', 7, 'seconds are below 60'), ("47.5°30' 8", 1, 'write whole degrees'),
                              ('90.1N 8', 1, 'beyond 90 degrees'), ('8 361E', 3, 'beyond 360 degrees'), ('-47N 8', 1, 'remove one of them'), ('8 47 36 18', 6, 'more than two coordinates'),
                              ("36' 8", 3, ''), ('47°36\'18.3"x 8', 3, ''), ('47d 8', 3, ''), ("1'2° 3", 2, ''), ('N 8', 1, '')):
        result = run('delaunay', '-', stdin=text + '\n')
        assert result.code == 1 and why in result.err and result.err.startswith(f'dyadel: -:1:{column}: '), (text, result)
    for text in ('47N 8E', "47°36'N, 8"):
        expect(run('delaunay', '--sphere', '-', stdin=text + '\n'), 1, r'\A\Z', '-:1:1: a latitude where the longitude is expected; give the longitude first')
        expect(run('delaunay', '-', stdin=text + '\n'), 0, HEAD, 'a mirrored map; exchange the two')
    expect(run('delaunay', '-', stdin='8E 47N\n9E 46N\n'), 0, HEAD, 'for neighbours on the globe')
    expect(run('delaunay', '--sphere', '-', stdin='8E 47N\n9E 46N\n8:00 47:00\n'), 0, r'\A# alias 2 0\n' + HEAD + r'0,1,legal\n\Z', r'\A\Z')
    expect(run('delaunay', '-', stdin='sqrt(4) exp(0)\ne E\n'), 1, '', '-:2:3: ')
    expect(run('delaunay', '--radius', '5d', '-', stdin='0 0\n'), 2, '', 'the radius "5d" is not')


def test_encodings():
    """Names of Latin-1 are read with a note; never U+FFFD."""
    text = 'Stadt;Länge;Breite\nDüsseldorf;6.8;51.2\nKöln’s;6.9;50.9\nŁódź;7;52\n'
    want = run('delaunay', '--plane', '--columns', 'Länge,Breite', '--id', 'Stadt', '-', stdin=text.replace('Łódź', 'Bonn'))
    expect(want, 0, 'Düsseldorf,Köln’s', r'\A\Z')
    got = run('delaunay', '--plane', '--columns', 'Länge,Breite', '--id', 'Stadt', '-', stdin=text.replace('Łódź', 'Bonn').encode('cp1252'))
    assert got.out == want.out
    expect(got, 0, '', r'-: lines that are not UTF-8: 3; they are read as Windows-1252 .*iconv -f ENCODING -t UTF-8 - \| dyadel delaunay \.\.\. -$')
    for data in (b'1 2\n3 4\xb10.5\n', b'0x1p0 2 # \xfc\n3 4\n'):
        expect(run('delaunay', '-', stdin=data), 0, HEAD + '0,1,legal', 'not UTF-8: 1;')


def test_names_over_lines():
    """A name may go over lines and have blanks of any number; it is written with one."""
    text = '"Longitude\n(deg)","Lat   (deg)",n\n1,2,"a\nb"\n4,1,""\n2,6,"c, ""d"""\n'
    expect(run('delaunay', '--plane', '--columns', 'longitude (deg),lat (deg)', '-', stdin=text), 0, r'\A' + THREE, r'\A\Z')
    expect(run('delaunay', '--columns', 'x,y', '-', stdin=text), 1, '', r'names are: Longitude \(deg\), Lat   \(deg\), n;')


def test_radii_east_and_north():
    """Lengths east and north are those of a box within a disc: 3 m and 4 m are 5 m, hardly more."""
    def boxes(*options):
        out = read_exact(['lon,lat,r,e,n', *(f'{k},2,5,3,4' for k in range(3))], '--sphere', '--columns', 'lon,lat', '--radius-unit', 'm', *options)
        return [float(b - a) for k in sorted(out) for a, b in (out[k][:2], out[k][2:])]
    for wide, narrow in zip(boxes('--radius-column', 'e,n'), boxes('--radius-column', 'r')):
        assert narrow <= wide <= narrow * (1 + 2**-40), (narrow, wide)
    assert boxes('--radius-column', 'r,r') == boxes('--radius-column', 'r')


def test_units_of_radii():
    """A unit in the row of units counts."""
    for columns in ('r', 'e,n'):
        text = 'lon lat r e n\ndeg deg m cm cm\n1 2 5 300 400\n1.01 2 5 300 400\n1 2.01 5 300 400\n'
        options = ('--sphere', '--columns', 'lon,lat', '--radius-column', columns, '--delimiter', 'blank')
        result = run('delaunay', *options, '--units-row', '-', stdin=text)
        expect(result, 0, r'\A' + THREE, r'\A\Z')
        expect(run('delaunay', *options, '-', stdin=text.replace('deg deg m cm cm\n', '')), 2, '', 'state a unit: --radius-unit')


KINDS = [(b'{"type":"FeatureCollection","features":[]}', 'GeoJSON', 'ogr2ogr'), (b'\n <?xml version="1.0"?>\n<gpx>', 'GPX', 'waypoints'),
         (b'<kml>', 'KML', 'ogr2ogr'), (b'<?xml?><osm>', 'OpenStreetMap XML', 'points'), (b'PAR1\x15\x04', 'Parquet', 'ogr2ogr'),
         (b'OFF\n3 1 0\n1 2 0\n', 'OFF', 'awk'), (b'# .PCD v.7\nDATA ascii\n1 2 0\n', 'PCD', 'sed'), (b'# a\nmtllib a\nv 1 2 0\n', 'OBJ', 'sed'), (b'ncols 3\ncellsize 1\n', 'a grid of ESRI', 'gdal_translate'),
         (b'DSAA\n', 'a grid of Surfer', 'gdal_translate'), (b'EXP  0 a\n', r'an export of ArcInfo \(E00\)', 'ogr2ogr'), (b'$GNRMC,1,A\n', 'NMEA', 'gpsbabel'),
         (b'{"locations":[{"latitudeE7":1}]}', 'a timeline of Google', 'jq'), (b'\0\0\x27\x0a\0\0', 'a Shapefile', 'ogr2ogr'), (b'SQLite format 3\0', 'an SQLite database', 'ogr2ogr'), (b'fgb\3fgb\0', 'FlatGeobuf', 'ogr2ogr'),
         (b'[[1,2],[3,4]]', 'JSON', 'jq'), (b'[[0. 1.]\n [2. 3.]]\n', 'an array as NumPy prints it', 'tr -d'),
         (b'  0\nSECTION\n  2\nENTITIES\n', 'DXF', 'ogr2ogr'), (b'0\r\nSECTION\r\n', 'DXF', 'ogr2ogr'), (b'ply\nformat ascii 1.0\n', 'PLY', 'sed'),
         (b'AXXX\nHFDTE010124\n', 'IGC', 'gpsbabel'), (b'<?xml?><TrainingCenterDatabase>', 'TCX', 'gpsbabel'),
         (b'NAME : a\nNODE_COORD_SECTION\n1 2 3\nEOF\n', 'TSPLIB', 'sed'),
         (b'PK\3\4 a.shp', 'a zip archive with a Shapefile', '/vsizip/'), (b'PK\3\4 doc.kml', 'KML in a zip archive', '/vsizip/')]


def test_other_formats():
    """What a file is comes from its first bytes, packed or not; the command to type is one."""
    for data, name, make in share(KINDS):
        expect(run('delaunay', '-', stdin=data), 1, r'\A\Z', rf'\Adyadel: -: the file is {name}.*; give .*{make}.* \| dyadel delaunay (--columns (X,Y|Longitude,Latitude|lonE7,latE7) )?-$')
        expect(run('delaunay', '--columns', 'x,y', '-', stdin=data), 1, r'\A\Z', f'the file is {name}')
    for data, name in share(((b'{"a":1}', 'JSON; make a table of it, for instance jq'), (b'[{"x":1}]', 'JSON; make a table'), (b'<?xml?><LandXML>', 'LandXML; export'),
                       (b'<?xml?><JOBFile>', 'JobXML'), (b'\x89PNG\r\n', r'a picture \(PNG\)'), (b'\xff\xd8\xff\xe0', 'a picture'), (b'\x89HDF\r\n', 'HDF5'),
                       (b'CDF\1\0', 'NetCDF'), (b'MATLAB 5.0 MAT-file', 'a MAT-file'), (b'\x80\4\x95\0', 'binary'), (b'*110001+01 81..00+01\n', 'GSI'),
                       (b'110001+01 81..00+01\n', 'GSI'), (b'MATLAB 7.3 MAT-file, a', 'a MAT-file'), (b'AutoCAD Binary DXF\r\n', 'binary DXF'), (b'AC1027\0\1', 'DWG'),
                       (b'ASTM-E57\1', 'E57'), (b'# .PCD\nDATA binary\n', 'binary PCD'), (b'# vtk DataFile Version 3.0\n', 'VTK'), (b'solid a\nfacet\n', 'STL'),
                       (b'$MeshFormat\n', 'a mesh of Gmsh'), (b'structure(list(x = 1))', 'code of R'), (b'X\n\0\0\0\3', r'data of R \(RDS'), (b'RDX3\nX\n', r'data of R \(RData'),
                       (b'$FL2@(#) SPSS', 'data of SPSS'), (b'<stata_dta>', 'data of Stata'), (b'HEADER RECORD*******LIB', 'data of SAS'), (b'%=SNX 2.02', 'SINEX'),
                       (b'JB,NMX,DT\n', 'a raw file of Carlson'), (b'00NMSC V10\n', 'a DC file of Trimble'), (b'PK\3\4 a.npy', 'an archive of NumPy'),
                       (b'7z\xbc\xaf\x27', 'packed by 7-Zip'), (b'Rar!\x1a', 'packed by RAR'), (b'\x04"M\x18', 'packed by LZ4'), (b'\xff\xfe\0\0x\0\0\0', 'text in UTF-32'),
                       (b'     3.04           OBSERVATION DATA    M    RINEX VERSION / TYPE\n', 'RINEX'))):
        expect(run('delaunay', '-', stdin=data), 1, r'\A\Z', r'\Adyadel: -: the file is ' + name)
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / 'f').write_bytes(data)
            expect(run('delaunay', 'f', cwd=folder), 1, r'\A\Z', r'\Adyadel: f: the file is ' + name)
    for cell, name in (('{""type"":""Point"",""coordinates"":[0,0]}', 'GeoJSON'), ('0101000020E6100000000000000000F03F0000000000000000', 'WKB')):
        for options in ((), ('--columns', 'geom,geom')):
            expect(run('delaunay', *options, '-', stdin=f'id,geom\n1,"{cell}"\n'), 1, '', f'a table with a column of {name}.*ogr2ogr .*GEOM_POSSIBLE_NAMES=.geom')
    for data in (b'[0,1] 0\n', b'Point,X,Y\n'):
        assert 'the file is' not in run('delaunay', '-', stdin=data).err
    expect(run('delaunay', '--columns', 'i,g', '-', stdin='i;g\n1;POINT(1 2)\n'), 1, '', r'a table with a column of WKT .*GEOM_POSSIBLE_NAMES.* \| dyadel delaunay --columns X,Y -$')


def test_commands_to_type():
    """The command that a message gives does it, with names that a shell would split."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder)
        files = {"it's.json": '[[1,2],[4,1],[2,6]]\n'} if shutil.which('jq') else {}
        if shutil.which('ogr2ogr'):
            files['c d.geojson'] = '{"type":"FeatureCollection","features":[' + ','.join(
                '{"type":"Feature","properties":{"n":1},"geometry":{"type":"Point","coordinates":[%s]}}' % p for p in ('1,2', '4,1', '2,6')) + ']}'
        for name, text in files.items():
            (path / name).write_text(text)
            told = run('delaunay', *((name,) if name.endswith('json') and 'geo' not in name else ('-',)), stdin=text, cwd=folder)
            command = re.search(r'; give (.*)$', told.err, re.M)[1]
            env = {**os.environ, 'PATH': os.path.dirname(os.path.abspath(COMMAND)) + ':' + os.environ['PATH']}
            done = subprocess.run(['sh', '-c', command], cwd=folder, env=env, input=text.encode(), stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
            assert done.stdout.decode().endswith(THREE), (command, done)


def test_names_of_files():
    """A name of a file cannot steer a terminal, and bytes of UTF-8 stay."""
    with tempfile.TemporaryDirectory() as folder:
        name = 'é\x1b]0;x\x07\x9b\n€.csv'
        expect(run('delaunay', name, cwd=folder), 1, r'\A\Z', r'\Adyadel: é\\x1B\]0;x\\x07\\xC2\\x9B\\x0A€\.csv: cannot open')


def test_header_is_no_geometry():
    """A header that begins with Point was taken for well-known text without places, and skipped."""
    expect(run('delaunay', '-', stdin='Point,Northing,Easting\nP1,2,3\n'), 1, r'\A\Z', r'-:1:1: this line is a header .*--columns Easting,Northing \(it has: Point, Northing, Easting\)$')
    expect(run('delaunay', '-', stdin='point 1 2\n3 4\n'), 1, r'\A\Z', r'-:1:9: more than two')
    expect(run('delaunay', '-', stdin='Point Z (1 2 9)\npoint(1234.5 5)\nSRID=4326;POINT (5 1000)\n'), 0, re.escape(THREE))


def test_remedies():
    for text, remedy in (('P1,2.5,3.5,a\n', '--no-header --columns 1,2'), ('2023 1.5 2.5 3\n', '--delimiter blank'),
                         ('$GPGGA,123519,4807.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,*47\n', 'NMEA .*gpsbabel -i nmea')):
        expect(run('delaunay', '-', stdin=text), 1, r'\A\Z', remedy)
    for cell, remedy in share((('?', "--missing '\\?' --skip-missing"), ('n.d.', "--missing 'n.d.'"), ('8 9 30', '47 36 18.3 N'), ('8.1O', 'O is east in German'),
                         ('8.3w', 'N, S, E, W'), ('8d06m10sE', 'N, S, E, W'), ('\u22121.5', "sed 's/\u2212/-/g' FILE"), ('\u20131.5', "sed 's/\u2013/-/g' FILE"),
                         ('1 +/- 0.1', r"sed 's\|\+/-\|\+-\|g' FILE"), ('"(48.1, 11.5)"', 'two coordinates'), ('48.1 11.5', 'two coordinates'), ('1.234(5)', r'1\.234\+-0\.005'),
                         ('0.1D+01', r'sed -E .*\[Dd\]'), ('32UPU9100034289', 'GeoConvert'), ("'5'", r"""tr "'" '"' < FILE"""), ('5%', "tr -d '%\\$'"), ('$5', 'no such sign'), ('\u20ac5', 'no such sign'), ('~5', 'all its values'),
                         ('<0.5', 'all its values'), ('\u22645', 'all its values'), ('5\' 6"', 'feet and inches'), ('12\'', 'feet and inches'), ('5 1/2', 'sums of such numbers'), ('5-', 'belongs in front'),
                         ('5f', 'end with a digit'), ('7L', 'end with a digit'), ('1+2i', 'complex'), ('(1-2j)', 'complex'), ('\uff11', 'not 0 to 9'), ('\u0661\u066b\u0665', 'not 0 to 9'), ('\u0967', 'not 0 to 9'),
                         ('\xa05', 'not seen'), ('5\u200b', 'not seen'), ('\x0b5', 'not seen'), ('1\xb75', 'a plain one'), ('1\u22c55', 'a plain one'), ('1.5\xd710', 'as in 1.5e3'), ('1.5x10^3', 'as in 1.5e3'),
                         ('1.5*^3', 'as in 1.5e3'), ('1.5`', 'Mathematica'), ('****', 'did not fit'), ('=A1', 'formula'), ('<Point>', 'XML'), ('{5}', "tr -d '{}'"), ("'5", 'apostrophe'), ('10T 550200 5272748', 'code of a place'),
                         ('TQ 300 775', 'code of a place'), ('849VCWC8+R9', 'code of a place'), ('c23nb62w', 'code of a place'), ('8928308280fffff', 'code of a place'), ('CN87uo', 'code of a place'))):
        expect(run('delaunay', '--columns', 'x,y', '-', stdin=f'x,y\n1,2\n{cell},7\n'), 1, r'\A\Z', f'-:3:.*{remedy}')
    for cell, remedy in (('<0.5', 'as the largest value'), ('5%', 'no such sign'), ('\xb10.5', 'as the largest value'), ('5"', 'feet and inches'), ('low', 'give one such as')):
        expect(run('delaunay', '--columns', 'x,y', '--radius-column', 'r', '-', stdin=f'x,y,r\n1,2,{cell}\n'), 1, r'\A\Z', f'-:2:5: the radius is not .*{remedy}')
    expect(run('delaunay', '--columns', 'g', '-', stdin='g\n'), 2, r'\A\Z', 'its name twice')


def test_names_of_radii():
    """A column whose name says that it holds no bounds, or that its unit is another one, gets a note."""
    def note(name, *more):
        return run('delaunay', '--columns', 'x,y', '--radius-column', name, *more, '-', stdin=f'x,y,{name}\n1,2,0.1\n5,3,0.1\n2,9,0.1\n').err

    for name, said in (('HRMS', '--sigma-column HRMS --confidence 95%'), ('Sigma_XY', 'standard deviations'), ('sd', '--sigma-column sd '),
                       ('CE90', '--sigma-column CE90 --radius-scale 0.466 --confidence 95%'), ('HDOP', 'factors'), ('s [mm]', '--radius-scale 0.001'),
                       ('acc(cm)', '--radius-scale 0.01'), ('r_in', '--radius-scale 0.0254'), ('err_ft', '--radius-scale 0.3048'), ('Lateral RMS', "--sigma-column 'Lateral RMS' --confidence 95%")):
        assert said in note(name), (name, note(name))
        assert not note(name, '--radius-scale', '0.5')
    for name in ('acc', 'radius', 'used', 'error in m', 'r_inner', 's [m]', 'summit', 'wisdom', 'st'):
        assert not note(name), (name, note(name))
    for name, said in (('s [mm]', '--radius-scale 0.001'), ('sd', '')):
        found = run('delaunay', '--columns', 'x,y', '--sigma-column', name, '--confidence', '95%', '-', stdin=f'x,y,{name}\n1,2,1\n5,3,1\n2,9,1\n').err
        assert ('taken as standard deviations' in found) == (said != '') and said in found, (name, found)


def test_typed_remedies():
    """What a message gives to type makes a file that is read."""
    for text, command in (('0.1D+01 2\n4D0 1\n2 6\n', r"sed -E 's/([0-9.])[Dd]([-+0-9])/\1e\2/g'"), 
                          ('1 2\n4 1\n2 6\n\0\0', r"tr -d '\000'"), ('[[1. 2.]\n [4. 1.]\n [2. 6.]]\n', "tr -d '[]'"),
                          ('NAME : a\nNODE_COORD_SECTION\n 1 1 2\n2 4 1\n3 2 6\nEOF\n', r"sed -nE 's/^ *[0-9]+ +([^ ]+ +[^ ]+) *$/\1/p'"),
                          ('1 2\n4 1\r2 6\n', r"tr '\r' '\n'")):
        told = run('delaunay', '-', stdin=text)
        assert told.code == 1 and (command in told.err or '\r' in text), (command, told)
        made = subprocess.run(['sh', '-c', command], input=text.encode(), stdout=subprocess.PIPE, check=True).stdout
        expect(run('delaunay', '-', stdin=made), 0, re.escape(THREE), r'\A\Z')


# Options and text of 1 2, 4.5 1, 2 6: the message has a command of which FILE is the input, up to its name.
REWRITTEN = [
    ('', '(1, 2)\n(4.5, 1)\n(2, 6)\n'), ('', '[(1, 2), (4.5, 1), (2, 6)]\n'), ('', 'P = [1 2; 4.5 1; 2 6];\n'), ('', 'P = [\n1 2\n4.5 1\n2 6\n];\n'), ('', '{{1,2},{4.5,1},{2,6}}\n'),
    ('', '(1,2) (4.5,1) (2,6)\n'), ('', '{1, 2},\n{4.5, 1},\n{2, 6},\n'), ('', '1 & 2 \\\\\n4.5 & 1 \\\\\n2 & 6 \\\\ \\hline\n'), ('', '> a\n1 2\n4.5 1\n> b\n2 6\n'), ('', '1\xa02\n4.5\xa01\n2\xa06\n'),
    ('xy', 'x,y\n1\' 0",2\'\n4\' 6",1\'-0"\n2\',6\'\n'), ('xy', 'x,y\n"1\' 0""",2\'\n"4\'6""",1\'\n2\',6\'\n'), ('xy', 'x;y\n1;2\n4 1/2;1\n2;6\n'), ('xy', 'x,y\n1f,2.f\n4.5F,1f\n2L,6L\n'),
    ('xy', 'x,y\n\uff11,\uff12\n\uff14\uff0e\uff15,1\n2,6\n'), ('xy', 'x,y\n\u0661,\u0662\n\u0664\u066b\u0665,1\n2,6\n'), ('xy', 'x,y\n\xa01,2\u200b\n\u200e4.5,1\x0b\n2,\ufeff6\x0c\n'),
    ('xy', 'x,y\n1\xb70,2\n4\xb75,1\n2,6\n'), ('xy', 'x,y\n1`,2`15.2\n4.5`3,1\n2,6\n'), ('xy', "x,y\n'1,2\n4.5,1\n2,6\n"), ('xy', 'x,y\n{1},{2}\n{4.5},{1}\n{2},{6}\n'), ('xy', 'x;y\n$1;$2\n$4.5;$1\n2;6\n'),
]


def test_rewritten():
    for options, text in share(REWRITTEN):
        options = ['--columns', 'x,y'] if options else []
        told = run('delaunay', *options, '-', stdin=text)
        command = re.search(r"((LC_ALL=C )?(sed|tr|grep|python3) .*?) (< )?FILE", told.err)
        assert told.code == 1 and command, (text, told)
        made = subprocess.run(['sh', '-c', command[1]], input=text.encode(), stdout=subprocess.PIPE, check=True).stdout
        got = read_exact(made.decode().splitlines(), *options)
        assert [[p[0], p[2]] for p in got.values()] == [[1, 2], [4.5, 1], [2, 6]], (text, command[1], made)
    for text, want in (('x,y\n1-,2.5-\n', [-1, -2.5]), ("x,y\n-5' 6\",-1'\n", [-5.5, -1])):
        told = run('delaunay', '--columns', 'x,y', '-', stdin=text)
        command = re.search(r"(sed .*) FILE", told.err)[1]
        made = subprocess.run(['sh', '-c', command], input=text.encode(), stdout=subprocess.PIPE, check=True).stdout
        got = read_exact(made.decode().splitlines(), '--columns', 'x,y')[0]
        assert [got[0], got[2]] == want, (made, got)


def test_e7():
    """Columns called E7 are integers of 1e-7 degrees, on the sphere and in the plane, however small."""
    text = 'latE7,lonE7\n476101234,-1223301234\n-5,+7\n0,1700000000\n'
    want = [[Fraction(-1223301234, 10**7), Fraction(476101234, 10**7)], [Fraction(7, 10**7), Fraction(-5, 10**7)], [170, 0]]
    for options in ([], ['--sphere']):
        got = read_exact(text.splitlines(), '--columns', 'lonE7,latE7', *options)
        assert all(p[0] <= w[0] <= p[1] and p[2] <= w[1] <= p[3] and p[1] - p[0] < Fraction(1, 2**40) for p, w in zip(got.values(), want)), got
    result = run('delaunay', '--columns', 'longitudeE7,latitudeE7', '--skip-missing', '-', stdin='latitudeE7,longitudeE7\n1,2\n,3\n5,NA\n')
    expect(result, 0, '', '2 of 3 rows are skipped')


def test_zones():
    rows = 'zone,x,y\n32U,1,2\n{},5,3\n32U,2,9\n'
    for second, noted in (('33U', True), ('32 N', False), ('31', True), ('B2', False), ('', False), ('32T', False)):
        found = run('delaunay', '--columns', 'x,y', '-', stdin=rows.format(second)).err
        assert ('several zones' in found) == noted, (second, found)
    expect(run('delaunay', '--columns', 'Hochwert,Rechtswert', '-', stdin='Rechtswert,Hochwert\n1,2\n3,4\n9,1\n'), 0, 'legal', 'mirrored map')


main(globals())
