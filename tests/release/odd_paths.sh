#!/bin/sh
# usage: odd_paths.sh BUILD   (MAKE, CXX from the environment)
# Folders with a blank, both quotes and a dollar sign in their names: the sources are built, installed and cleaned
# there, and a BUILD of such a name is refused before anything is written or removed. The compiler copies the objects of
# BUILD (copy_objects.sh).
: "${MAKE:=make}" "${CXX:=c++}" "${CC:=cc}" "${CFLAGS:=-O2}"
build=$(cd "$1" && pwd)
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
topic="odd paths" log=$dir/log
. "$(dirname "$0")/../count.sh"
odd="it's a \"\$HOME"
sources=$dir/$odd/sources prefix="$dir/$odd/prefix" stage=$dir/$odd/stage
mkdir -p "$sources" "$dir/running"
unset MAKEFLAGS MFLAGS MAKELEVEL

cat >"$dir/compiler" <<END
#!/bin/sh
# With GATHER=N: waits until N of them run at once, and notes when they do.
if [ -n "\$GATHER" ] && [ ! -e "$dir/gathered" ]; then
    : >"$dir/running/\$\$"
    for k in \$(seq 100); do
        if [ "\$(ls "$dir/running" | wc -l)" -ge "\$GATHER" ]; then : >"$dir/gathered"; fi
        if [ -e "$dir/gathered" ]; then break; fi
        sleep .1
    done
    rm "$dir/running/\$\$"
fi
exec sh "$PWD/tests/release/copy_objects.sh" "$build" "$CXX" "\$@"
END
chmod +x "$dir/compiler"
# Files that git knows, or all that are no output: the way of the tarball.
{ git ls-files 2>/dev/null || find . \( -name build -o -name .git \) -prune -o -type f -print; } |
    tar -c -f - -T - | tar -x -f - -C "$sources"
make_there() (cd "$sources" && $MAKE -s CXX="$dir/compiler" CXXFLAGS="$CXXFLAGS" CC="$CC" LDFLAGS="$LDFLAGS" "$@")
in_make() { printf '%s' "$1" | sed 's/\$/$$/g'; }   # as a value on make's command line

check "a build" make_there
left_out() { make_there demo EMXX=none | grep 'left out: build/demo/workbench.html, as none not found: install'; }
check "make demo, which says that the workbench is left out without emscripten" left_out
check "make demo leaves the page" test -s "$sources/build/demo/page.html"
check "make amalgamation" make_there amalgamation
check "make dist" make_there dist
check "make install" make_there install PREFIX="$(in_make "$prefix")"
check "the installed program" "$prefix/bin/harmorph" --version
check "the installed library" test -s "$prefix/lib/libharmorph.a"
check "make install-shared" make_there install-shared PREFIX="$(in_make "$prefix")"
check "the installed shared library" test -L "$prefix/lib/libharmorph.so"
check "make uninstall" make_there uninstall PREFIX="$(in_make "$prefix")"
is_empty "make uninstall leaves files" "$(find "$prefix" ! -type d)"
check "make install with DESTDIR" make_there install DESTDIR="$(in_make "$stage")" PREFIX="/opt/it's"
check "the staged program" test -x "$stage/opt/it's/bin/harmorph"
check "make clean" make_there clean
check "make clean takes the folder away" test ! -e "$sources/build"

# Refused, and nothing is written or removed: neither the folder, nor a folder that the shell would make of the name.
refuses_build() {   # target, name
    rm -rf "$sources/parent" "$sources/build" "$sources/$2/kept"
    mkdir -p "$sources/parent/my" "$sources/build" "$sources/a" "$sources/b" "$sources/./$2"
    for folder in parent/my build a b; do echo kept >"$sources/$folder/kept"; done
    echo kept >"$sources/./$2/kept"
    find "$sources" | sort >"$dir/before"
    make_there "$1" BUILD="$(in_make "$2")" PREFIX="$(in_make "$prefix")" >"$log" 2>&1
    status=$?
    find "$sources" | sort >"$dir/after"
    passes "make $1 BUILD=$2: exit code $status" "$([ $status != 0 ]; echo $?)"
    passes "make $1 BUILD=$2: the reason" "$(grep -q 'Choose a name of letters' "$log"; echo $?)" "$log"
    passes "make $1 BUILD=$2: files come or go" "$(cmp -s "$dir/before" "$dir/after"; echo $?)"
}
# One rule refuses a name for all targets: each name is tried with one target, and each target with two names.
for name in "it's" 'say "no"' 'a$b' "a;b" "a&b" "a*" "a:b" "a#b" 'a\b' "a%b" "a=b" "-rf"; do
    refuses_build clean "$name"
done
for target in all clean dist amalgamation install; do
    refuses_build $target "parent/my build"
    refuses_build $target ""
done
rm -rf "$sources/build"

# The option -j states how many compilers run at once; JOBS states this without -j.
GATHER=5
export GATHER
rm -f "$dir/gathered"
check "make -j6" make_there -j6 all WASM_CXX=none
passes "make -j6 runs no 5 compilers at once" "$([ -e "$dir/gathered" ]; echo $?)"
rm -rf "$sources/build" "$dir/gathered"
echo 'rm -rf build '"$dir/gathered"'; mkdir build; exec $MAKE -s JOBS="$JOBS" all WASM_CXX=none' \
    >"$sources/tests/run.sh"
check "make -j6 test" make_there -j6 test
passes "make -j6 test: its script runs no 5 compilers at once" "$([ -e "$dir/gathered" ]; echo $?)"
finish
