#!/bin/sh
# usage: web.sh BUILD   (called by `make test-web` and `make test`; MAKE, CC, EMXX from the environment)
# The package for npm (c_api/web): `make web`, the bits of the native library, every call, memory, damaged input, and
# the tarball installed in an empty folder without a network.
: "${MAKE:=make}" "${CC:=cc}" "${CXX:=c++}" "${EMXX:=em++}"
build=$(cd "$1" && pwd)
dir=$build/web-test
topic=web log=$dir/log
. "$(dirname "$0")/../count.sh"
rm -rf "$dir" && mkdir -p "$dir/installed" || exit 1

check "make web" $MAKE -s BUILD="$1" EMXX="$EMXX" web
version=$(sed -n 's/^#define HM_VERSION "\(.*\)"/\1/p' include/harmorph.h)
tarball=$build/web/harmorph-$version.tgz
installed() (
    cd "$dir/installed" && echo '{ "private": true, "type": "module" }' >package.json &&
        npm_config_cache="$dir/cache" npm_config_offline=true npm_config_update_notifier=false \
            npm install --silent --no-audit --no-fund "$tarball"
)
check "npm install of the tarball in an empty folder, offline" installed
cp tests/hosts/web/*.mjs "$dir/installed/"

no_imports() { node --input-type=module -e 'import fs from "fs";
    for (const name of process.argv.slice(1)) {
        const { length } = WebAssembly.Module.imports(new WebAssembly.Module(fs.readFileSync(name)));
        if (length > 0) throw new Error(`${name} has ${length} imports`);
    }' "$build/web/harmorph.wasm" "$build/web/harmorph_simd128.wasm"; }
check "the modules import nothing" no_imports
small() { [ "$(gzip -9 -c "$build/web/$1.wasm" | wc -c)" -le 350000 ]; }
for name in harmorph harmorph_simd128; do check "$name.wasm has at most 350 kB with gzip" small $name; done

native() {
    $CC -std=c99 -O2 -ffp-contract=off -Iinclude -o "$dir/morphs" tests/release/cross/morphs.c "$build/libharmorph.a" \
        -lm && "$dir/morphs" >"$dir/sums"
}
check "checksums of the native library, baseline kernel" native
same_sums() { node "$dir/installed/checksums.mjs" harmorph "$1" | diff "$dir/sums" -; }

# Scripts count for themselves; what they say is added up.
counted() {   # what, command...
    what=$1; shift
    "$@" >"$log" 2>&1 || fail "$what" "$log"
    passed=$((passed + $(sed -n 's/^\([0-9][0-9]*\) passed, .*/\1/p' "$log" | grep . || echo 0)))
}
for kernel in baseline simd128; do
    check "the same checksums in node, kernel $kernel" same_sums $kernel
    counted "every call, kernel $kernel" node "$dir/installed/package.mjs" harmorph $kernel
done
check "a mesh that is too large, and a worker" node "$dir/installed/large.mjs" harmorph "$build/web/harmorph.wasm"

chromium=$CHROMIUM
for name in chromium chromium-browser google-chrome; do
    [ -n "$chromium" ] || chromium=$(command -v $name)
done
if [ -n "$chromium" ]; then
    ln -s "$build/web/package" "$dir/package" && cp tests/hosts/web/case.mjs tests/hosts/web/checksums.mjs "$dir/"
    sums_of_browser() {
        node tests/hosts/web/browser.mjs "$chromium" "$dir" checksums.mjs simd128 | diff "$dir/sums" -
    }
    check "the same checksums in Chromium" sums_of_browser
else
    skip "the package in a browser" "no Chromium is found (Debian's package chromium, or CHROMIUM=path)"
fi

# The program of the package's page runs as it stands there.
page_program() (
    awk '/^```js$/ { inside = 1; next } /^```$/ { inside = 0 } inside' c_api/web/README.md >"$dir/installed/page.mjs"
    cd "$dir/installed" && node page.mjs >said && cat said &&
        grep -q '^0 inverted cells; the mesh could follow [0-9.]* times as far$' said &&
        grep -q '^kernel simd128: ' said
)
check "the program of the package's page" page_program
# So do its commands, on the mesh in the package.
page_commands() (
    awk '/^```sh$/ { inside = 1; next } /^```$/ { if (inside) exit } inside' c_api/web/README.md |
        sed "s|./harmorph-[0-9.]*tgz|$tarball|" >"$dir/page.sh"
    mkdir -p "$dir/page" && cd "$dir/page" && export npm_config_cache="$dir/cache" npm_config_offline=true \
        npm_config_update_notifier=false npm_config_audit=false npm_config_fund=false && sh -e "$dir/page.sh" &&
        "$build/harmorph" check case/morphed.su2 && [ -s case/page.html ]
)
if command -v $EMXX >/dev/null; then check "the commands of the package's page" page_commands; fi
# The program in node writes the bytes of the native program with one thread and the baseline kernel.
commands() (   # folder, program...
    mkdir -p "$dir/$1" && cd "$dir/$1" || exit 1
    shift
    naca=$build/meshes/naca0012.su2
    printf '3 0 .02\n8 .001 -.01\n' >moves.txt
    printf 'rigid airfoil .01 .02 7 1.1\n' >rigid.txt
    "$@" fit "$naca" --marker airfoil -o airfoil.curve >fit.txt &&
        "$@" solve "$naca" --curve airfoil=airfoil.curve --kernel baseline --threads 1 -o airfoil.basis >solve.txt &&
        "$@" morph "$naca" airfoil.basis --move moves.txt -o moved.su2 >morph.txt &&
        "$@" check moved.su2 --json >check.json &&
        "$@" convert moved.su2 moved.vtu >convert.txt &&
        "$@" solve "$naca" --rigid airfoil=.25,0 --kernel baseline --threads 1 -o rigid.basis >solve_rigid.txt &&
        "$@" morph "$naca" rigid.basis --move rigid.txt --kernel baseline --threads 1 --safe --reached reached.txt \
            --report report.html -o rigid.su2 >rigid_morph.txt || exit 1
    for kind in --naca --cst=3,4; do   # sections by formulas
        "$@" sample "$naca" airfoil.basis $kind --count 3 --threads 1 -o "sample$kind" >"sample$kind.txt" || exit 1
    done
    if "$@" check no.su2 >/dev/null 2>refusal.txt; then exit 1; fi
    # Times, and the sizes of objects, in which addresses are shorter, are others.
    for text in solve*.txt *morph.txt sample*.txt; do
        grep -v -E '^(seconds|megabytes|engine|time) ' $text >new.txt && mv new.txt $text
    done
)
if command -v $EMXX >/dev/null; then
    check "the native program" commands native "$build/harmorph"
    check "the program in node" commands node "$dir/installed/node_modules/.bin/harmorph"
    check "writes the same bytes" diff -r "$dir/native" "$dir/node"
    # A third of a megabyte is the module that pages contain, which gzip cannot make smaller again.
    program_is_small() { [ "$(gzip -9 -c "$build/web/program.wasm" | wc -c)" -le 1200000 ]; }
    check "the program has at most 1.2 MB with gzip" program_is_small
else
    without_program() { ! "$dir/installed/node_modules/.bin/harmorph"; }
    check "without emscripten the program says that it is not there" without_program
    skip "the program in node" "$EMXX is not installed (Debian's emscripten, node-acorn)"
fi
# A program that was made without clang and lld has no pages, and says why.
without_pages() {
    echo "clang and lld (Debian's packages clang and lld)" >"$dir/reason"
    sh c_api/cli/page/module.sh "$dir/reason" >"$dir/page_module.cpp" &&
        $CXX -std=c++17 -Ic_api/cli -c -o "$dir/page_module.o" "$dir/page_module.cpp" &&
        $CXX -pthread -o "$dir/without_pages" "$dir/page_module.o" "$1/objects/cli/c_api-cli-main.o" \
            $(tr ' ' '\n' <"$1/objects/program.list" | grep -v page_module) "$1/libharmorph.a" $LDFLAGS
}
check "a program without the module of pages" without_pages "$1"
refuses_pages() {
    ! "$dir/without_pages" explore "$build/meshes/naca0012.su2" no.basis -o "$dir/page.html" 2>"$dir/said" &&
        [ ! -e "$dir/page.html" ] && grep -F "$(cat "$dir/reason")" "$dir/said" &&
        grep -F "this program was made without " "$dir/said" && grep -F ", with which pages compute" "$dir/said"
}
check "refuses a page, and names the packages" refuses_pages
leaves_page_out() {
    "$dir/without_pages" demo "$dir/demo" --mesh "$build/meshes/naca0012.su2" >"$dir/said" 2>&1 &&
        [ -s "$dir/demo/report.html" ] && [ ! -e "$dir/demo/page.html" ] &&
        grep -F "left out: $dir/demo/page.html, as this program was made without" "$dir/said"
}
check "its demo makes everything else, and names the file that is left out" leaves_page_out
if command -v tsc >/dev/null; then
    types() (
        cp tests/hosts/web/types.ts "$dir/installed/" && cd "$dir/installed" &&
            tsc --noEmit --strict --target es2022 --module esnext --moduleResolution node16 --lib es2022,dom types.ts
    )
    check "types" types
else
    skip "types" "tsc is not installed (Debian's node-typescript)"
fi
finish "$dir"
