#!/bin/sh
# usage: web.sh BUILD   (called by `make test-web` and `make test`; MAKE, CC from the environment)
# The package for npm (c_api/web): `make web`, the bits of the native library, every call, memory, damaged input, and
# the tarball installed in an empty folder without a network.
: "${MAKE:=make}" "${CC:=cc}"
build=$(cd "$1" && pwd)
dir=$build/web-test
topic=web log=$dir/log
. "$(dirname "$0")/count.sh"
rm -rf "$dir" && mkdir -p "$dir/installed" || exit 1

check "make web" $MAKE -s BUILD="$1" web
version=$(sed -n 's/^#define HM_VERSION "\(.*\)"/\1/p' include/harmorph.h)
tarball=$build/web/harmorph-$version.tgz
installed() (
    cd "$dir/installed" && echo '{ "private": true, "type": "module" }' >package.json &&
        npm_config_cache="$dir/cache" npm_config_offline=true npm_config_update_notifier=false \
            npm install --silent --no-audit --no-fund "$tarball"
)
check "npm install of the tarball in an empty folder, offline" installed
cp tests/web/*.mjs "$dir/installed/"

no_imports() { node --input-type=module -e 'import fs from "fs";
    for (const name of process.argv.slice(1)) {
        const { length } = WebAssembly.Module.imports(new WebAssembly.Module(fs.readFileSync(name)));
        if (length > 0) throw new Error(`${name} has ${length} imports`);
    }' "$build/web/harmorph.wasm" "$build/web/harmorph_simd128.wasm"; }
check "the modules import nothing" no_imports
small() { [ "$(gzip -9 -c "$build/web/$1.wasm" | wc -c)" -le 350000 ]; }
for name in harmorph harmorph_simd128; do check "$name.wasm has at most 350 kB with gzip" small $name; done

native() {
    $CC -std=c99 -O2 -ffp-contract=off -Iinclude -o "$dir/morphs" tests/cross/morphs.c "$build/libharmorph.a" -lm &&
        "$dir/morphs" >"$dir/sums"
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
    ln -s "$build/web/package" "$dir/package" && cp tests/web/case.mjs tests/web/checksums.mjs "$dir/"
    sums_of_browser() { node tests/web/browser.mjs "$chromium" "$dir" checksums.mjs simd128 | diff "$dir/sums" -; }
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
if command -v tsc >/dev/null; then
    types() (
        cp tests/web/types.ts "$dir/installed/" && cd "$dir/installed" &&
            tsc --noEmit --strict --target es2022 --module esnext --moduleResolution node16 --lib es2022,dom types.ts
    )
    check "types" types
else
    skip "types" "tsc is not installed (Debian's node-typescript)"
fi
finish "$dir"
