#!/bin/sh
# usage: debian.sh BUILD   (MAKE from the environment)
# Builds the Debian packages in BUILD/debian from the tarball of `make dist`, without network and without writing
# anywhere else. Needs dpkg-dev, debhelper, dh-python and what debian/control names.
set -e
: "${MAKE:=make}"
build=$(cd "$1" && pwd)
version=$(sed -n 's/^#define HM_VERSION "\(.*\)"/\1/p' include/harmorph.h)
rm -rf "$build/debian"
mkdir -p "$build/debian"
$MAKE -s BUILD="$build" dist
cp "$build/harmorph-$version.tar.gz" "$build/debian/harmorph_$version.orig.tar.gz"
cd "$build/debian"
tar xzf "harmorph_$version.orig.tar.gz"
cd "harmorph-$version"
cp -r c_api/packaging/debian .
unset MAKEFLAGS MFLAGS MAKELEVEL CXXFLAGS CFLAGS LDFLAGS BUILD
# The tools of Debian, and no others that come first in the path.
PATH=${DEBIAN_PATH:-/usr/sbin:/usr/bin:/sbin:/bin} dpkg-buildpackage -us -uc -F -j"${JOBS:-2}"
