#!/bin/sh
# usage: dist.sh NAME   Writes the tarball of the sources, packed, all below the folder NAME. The same bytes from a
# checkout and from an unpacked tarball, on any day and for any user; needs GNU tar.
set -e
list=$(mktemp)
trap 'rm -f "$list"' EXIT
if git ls-files >"$list" 2>/dev/null && [ -s "$list" ]; then
    :
else
    find . \( -name build -o -name .git \) -prune -o -type f -print | sed 's|^\./||' >"$list"
fi
LC_ALL=C sort -o "$list" "$list"
tar --create --format=ustar --no-recursion --files-from="$list" --transform="s|^|$1/|" --mtime=@946684800 --owner=0 \
    --group=0 --numeric-owner --mode=u=rw,go=r | gzip -9 -n
