#!/bin/sh
# usage: pack.sh tools        says which tools `make web` lacks
#        pack.sh workbench    says which tools the program and the workbench lack
#        pack.sh pack BUILD   leaves BUILD/web/package and BUILD/web/harmorph-VERSION.tgz; VERSION from the environment
set -e
tool() {   # command, Debian's package
    command -v "$1" >/dev/null 2>&1 || { echo "$1 not found: install Debian's $2" >&2; missing=1; }
}
case $1 in
tools)
    missing=
    tool "${WASM_CXX%% *}" clang
    tool wasm-ld lld
    [ -z "$missing" ] ;;
workbench)
    missing=
    tool "${WASM_CXX%% *}" clang
    tool wasm-ld lld
    tool "${EMXX%% *}" "emscripten and node-acorn"
    [ -z "$missing" ] ;;
pack)
    missing=
    tool npm npm
    [ -z "$missing" ] || exit 1
    web=$2/web to=$2/web/package
    rm -rf "$to" && mkdir -p "$to"
    cp c_api/web/package/*.*js c_api/web/package/*.d.ts c_api/web/README.md LICENSE "$web"/harmorph*.wasm \
        "$2/meshes/naca0012.su2" "$to/"
    # The program is there where emscripten was.
    if [ -e "$web/program.js" ] && command -v "${EMXX:-em++}" >/dev/null; then
        cp "$web/program.js" "$to/program.cjs" && cp "$web/program.wasm" "$to/"
    fi
    awk -f c_api/packaging/table.awk $(sed 's|^|include/|' fortran/harmorph/headers) | awk -f c_api/web/reports.awk \
        >"$to/reports.d.ts"
    sed "s/@VERSION@/$VERSION/" c_api/web/package/package.json >"$to/package.json"
    chmod 644 "$to"/*
    # Nothing is fetched: the package has no dependencies, and npm's cache is a folder of the build.
    npm_config_cache=$(cd "$web" && pwd)/npm-cache npm_config_offline=true npm_config_update_notifier=false \
        npm pack --silent --pack-destination "$web" "./$to" >/dev/null
    echo "$web/harmorph-$VERSION.tgz" ;;
esac
