#!/bin/sh
# SPDX-License-Identifier: LGPL-3.0-or-later
# The Debian packages: built, installed in a new Debian, used by command, GDAL, C and Python, and removed; nothing of them
# is left. Usage: package.sh [FOLDER]   (needs root, a mirror of Debian, and mmdebstrap debhelper dh-python chrpath; the
# build and the chroot, which stay in FOLDER, take 2 GB and the better part of an hour)
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
work=$(mkdir -p "${1:-/tmp/dyadel-package}" && cd "${1:-/tmp/dyadel-package}" && pwd)
packages='libdyadel0 libdyadel-dev dyadel dyadel-gdal python3-dyadel'
rm -rf "$work/src" "$work/new"
git clone -q "$root" "$work/src"
cp -r "$work/src/src/packaging/debian" "$work/src/"
(cd "$work/src" && dpkg-buildpackage -us -uc -b) >"$work/build.log" 2>&1
needs=$(for p in $packages; do dpkg-deb -f "$work/${p}_"*.deb Depends; done | tr ',\n' '\n\n' | sed 's/(.*//; s/ //g; /dyadel/d' |
  sort -u | tr '\n' ,)
mmdebstrap --variant=apt --include="${needs}gcc,libc6-dev,pkg-config" "$(. /etc/os-release && echo "$VERSION_CODENAME")" "$work/new"
for p in $packages; do cp "$work/${p}_"*.deb "$work/new/tmp"; done

cat >"$work/new/tmp/try" <<'EOT'
set -eu
files() { find / -xdev ! -path '/proc/*' ! -path '/tmp/*' ! -path '/var/lib/dpkg/*' ! -path '/var/log/*' ! -path '/var/cache/*' | sort; }
cd /tmp
files >before
dpkg -i ./*.deb
dpkg -V $1
printf '0 0\nsqrt(2) 1\n1/3 2\n[1,2] 5\n' >points
dyadel delaunay points -q -o pairs.gpkg --certificate c
dyadel verify c --points points
python3 -c 'import dyadel; assert len(dyadel.delaunay([(0, 0), (1, 3), (2, 1)]).pairs) == 3'
printf '#include <dyadel/dyadel.h>\n#include <stdio.h>\nint main(void) { return puts(dyd_version()) < 0; }\n' >a.c
gcc a.c $(pkg-config --cflags --libs dyadel) -o a && ./a
dpkg --purge $1
files >after
diff before after
EOT
chroot "$work/new" sh /tmp/try "$packages"
echo "built, installed, used and removed: $packages"
