#!/bin/sh
# usage: systems.sh FOLDER   (by `make test-systems`, as the superuser)
# Unpacks the tarball of `make dist` in fresh systems, which debootstrap makes in FOLDER (system.sh), and runs the two
# commands of README.md there (.ci/run): SYSTEMS="bookworm trixie" are Debian 12 and 13; of a system that is no release
# (unstable) only the first command and what the library needs from outside, as its packages change every day.
: "${SYSTEMS:=bookworm trixie}"
mkdir -p "${1:?usage: systems.sh FOLDER}" && folder=$(cd "$1" && pwd) || exit 1
topic=systems log=$folder/log
. "$(dirname "$0")/../count.sh"
. "$(dirname "$0")/system.sh"
for system in $SYSTEMS; do
    out=$folder/$system.log
    check "$system: debootstrap" begin "$system" || continue
    [ -e "$folder/$system/ready" ] || continue
    check "$system: the sources" unpack "$system"
    case $system in
    unstable | sid)
        command='apt-get update && apt-get install -y g++ gcc make binutils && make demo check-link' ;;
    *) command='bash .ci/run' ;;
    esac
    inside "$system" "cd /root/harmorph && $command" >"$out" 2>&1
    passes "$system: $command" $? "$out"
    is_empty "$system: warnings of compilers" "$(grep -cE '[0-9]: *[Ww]arning:|^Warning: ' "$out" | grep -v '^0$')"
    counts=$(sed -n 's/^\([0-9]*\) passed, \([0-9]*\) failed$/passed \1, failed \2/p' "$out" | tail -n 1)
    echo "$system, $(inside "$system" 'g++ --version' | head -n 1): $counts"
done
finish
