#!/bin/sh
# usage: release.sh BUILD FOLDER   (by `make test-release` after `make`; MAKE, PYTHON, CC, FC, JOBS: the environment)
# Builds all that a release gives away, and uses each of them as its page says, from the files that a user would get.
# PARTS: some of the parts below, otherwise all. As the superuser, and with debootstrap, also in fresh systems of Debian
# 12 and 13 in FOLDER, which see no more than their part needs: the wheel without compiler and network, the Debian
# packages installed by apt, and the tarball with both commands of README. Each part prints a line of counts; the last
# line is their sum. The tools that Debian builds packages with, Meson and clang are used where they are installed.
: "${PARTS:=tarball wheel source packages projects web installed systems}"
: "${MAKE:=make}" "${PYTHON:=/usr/bin/python3}" "${JOBS:=2}" "${SYSTEMS:=bookworm trixie}"
export MAKE PYTHON JOBS SYSTEMS
given=$1
mkdir -p "$1/release" && build=$(cd "$1" && pwd) && top=$(pwd) || exit 1
roots=${2:?usage: release.sh BUILD FOLDER}
topic=release log=$build/release/log
. "$(dirname "$0")/../count.sh"
can_make_systems() { [ "$(id -u)" = 0 ] && command -v debootstrap >/dev/null && command -v unshare >/dev/null; }
all_passed=0 all_failed=0
part() {   # name, command: runs it, and adds up the counts that it prints
    name=$1 out=$build/release/$1.log; shift
    echo "== $name"
    "$@" </dev/null >"$out" 2>&1
    status=$?
    cat "$out"
    set -- $(sed -n 's/^\([0-9][0-9]*\) passed, \([0-9][0-9]*\) failed$/\1 \2/p' "$out" |
        awk '{ p += $1; f += $2 } END { print p + 0, f + 0, NR }')
    all_passed=$((all_passed + $1)) all_failed=$((all_failed + $2))
    if [ "$2" = 0 ] && { [ $status != 0 ] || [ "$3" = 0 ]; }; then
        echo "this part failed"
        all_failed=$((all_failed + 1))
    fi
}
made() {   # make's target, script that proves what was made
    $MAKE -s "$1" BUILD="$build" && shift && "$@"
}
export HARMORPH_MESHES=$build/meshes
wheel() { HARMORPH_PROGRAM=$build/harmorph sh tests/release/wheel.sh "$(ls "$build"/wheel/*.whl)" "$build/release"; }
source() {   # the one source by each compiler, with no flag but the level of optimisation
    status=0
    LEVEL=-O2 CXX=g++ CC=gcc sh tests/release/amalgamation.sh "$build" || status=1
    if command -v clang++ >/dev/null; then
        LEVEL=-O2 CXX=clang++ CC=clang WARNINGS= sh tests/release/amalgamation.sh "$build" || status=1
    else
        echo "skipped: the one source by clang++, as clang is not installed"
    fi
    return $status
}

# In fresh systems: what a user gets is copied into them, and the sources of the tests beside.
install_quietly='apt-get -qq update && apt-get -qq install -y --no-install-recommends >/dev/null'
wheel_inside() {   # system: numpy, cffi and pytest are those of Debian, whose scipy needs a compiler; no network
    rm -rf "$folder/$1/root/meshes" && cp -r "$build"/wheel/*.whl "$build/meshes" "$folder/$1/root/" || return 1
    inside "$1" "$install_quietly python3-numpy python3-cffi python3-venv python3-pytest &&
        ! command -v gcc && ! command -v c++" || return 1
    (alone=--net; inside "$1" 'cd /root/harmorph && python3 --version &&
        HARMORPH_MESHES=/root/meshes sh tests/release/wheel.sh "$(ls /root/*.whl)" /root/out')
}
packages_inside() {   # system, in which the packages were built: from the archives, by apt
    rm -rf "$folder/$1/root/debian" && mkdir -p "$folder/$1/root/debian" &&
        cp "$build"/debian/*.deb "$folder/$1/root/debian/" && rm -f "$folder/$1"/root/debian/*-dbgsym_*.deb || return 1
    inside "$1" "$install_quietly gcc g++ gfortran pkg-config cmake make /root/debian/*.deb" || return 1
    inside "$1" 'cd /root/harmorph && sh c_api/packaging/debian/tests/morph'
}
installed() {
    topic="fresh systems" log=$build/release/system.log
    folder=$roots/plain
    mkdir -p "$folder" && . tests/release/system.sh
    here=$(sed -n 's/^VERSION_CODENAME=//p' /etc/os-release)
    for system in $SYSTEMS; do
        check "$system: debootstrap" begin "$system"
        check "$system: the sources of the tests" unpack "$system"
        if wheel_inside "$system"; then ok; else fail "$system: the wheel"; fi
        if [ "$system" != "$here" ]; then continue; fi
        if [ -n "$(ls "$build"/debian/*.deb 2>/dev/null)" ]; then
            check "$system: the Debian packages, installed" packages_inside "$system"
        else
            skip "the Debian packages, installed" "they were not built"
        fi
    done
    finish
}

for name in $PARTS; do
    case $name in
    tarball) part tarball sh tests/release/dist.sh "$build" ;;
    wheel) part wheel made wheel wheel ;;
    source) part source source ;;
    packages) part packages sh tests/release/packages.sh "$build" ;;
    projects) part projects sh tests/release/projects.sh "$build" ;;
    web)
        without=
        for tool in clang++ wasm-ld node npm; do command -v $tool >/dev/null || without="$without $tool"; done
        if [ -z "$without" ]; then part web $MAKE -s test-web BUILD="$given"
        else echo "skipped: the package for npm, as not installed:$without"; fi ;;
    installed | systems)
        if ! can_make_systems; then
            echo "skipped: $name in fresh systems, which need the superuser, debootstrap and unshare"
        elif [ "$name" = installed ]; then part installed installed
        else part systems sh tests/release/systems.sh "$roots"; fi ;;
    *) echo "no such part: $name"; all_failed=$((all_failed + 1)) ;;
    esac
done
echo "$all_passed passed, $all_failed failed"
[ $all_failed = 0 ]
