#!/bin/sh
# usage: dist.sh NAME   Writes the tarball of the sources, packed, all below the folder NAME. The same bytes from a
# checkout and from an unpacked tarball, on any day and for any user; needs GNU tar. The file for Meson is also at the
# top, where Meson looks for a subproject.
set -e
list=$(mktemp)
trap 'rm -f "$list"' EXIT
if git ls-files >"$list" 2>/dev/null && [ -s "$list" ]; then
    :
else
    find . \( -name build -o -name .git \) -prune -o -type f -print | sed 's|^\./||' >"$list"
fi
grep -vx meson.build "$list" | LC_ALL=C sort >"$list.sorted" && mv "$list.sorted" "$list"
tar --create --format=ustar --no-recursion --files-from="$list" --transform="s|^|$1/|" --mtime=@946684800 --owner=0 \
    --group=0 --numeric-owner --mode=u=rw,go=r -C c_api/packaging meson.build | gzip -9 -n
