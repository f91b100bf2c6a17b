#!/bin/sh
# usage: systems.sh FOLDER   (by `make test-systems`, as the superuser)
# Runs README.md's two commands (.ci/run) in fresh systems, which debootstrap makes in FOLDER: SYSTEMS="bookworm trixie"
# are Debian 12 and 13; of a system that is no release (unstable) only the first command and what the library needs from
# outside, as its packages change every day. MIRROR: where packages come from, otherwise as the system's apt has it.
# CCACHE_DIR: a compiler cache that the systems share. Systems that are in FOLDER are used again.
: "${SYSTEMS:=bookworm trixie}" "${MIRROR=}" "${CCACHE_DIR=}"
mkdir -p "${1:?usage: systems.sh FOLDER}" && folder=$(cd "$1" && pwd) || exit 1
topic=systems log=$folder/log
. "$(dirname "$0")/count.sh"
for tool in debootstrap unshare chroot; do
    command -v $tool >/dev/null || { echo "$tool not found: install Debian's debootstrap and util-linux"; exit 1; }
done
[ -n "$MIRROR" ] || MIRROR=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Label: Debian' |
    head -n 1)
inside() {   # system, command: with /dev and /proc of its own, which end with the command
    unshare --mount --pid --fork sh -c 'root=$1
        mount --bind /dev "$root/dev" && mount -t proc proc "$root/proc" || exit 1
        if [ -n "$3" ]; then mkdir -p "$root/ccache" && mount --bind "$3" "$root/ccache" || exit 1; fi
        exec chroot "$root" env -i HOME=/root LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive CCACHE_DIR=/ccache \
            CCACHE_NOHASHDIR=1 PATH=/usr/lib/ccache:/usr/sbin:/usr/bin:/sbin:/bin sh -c "$2"' \
        sh "$folder/$1" "$2" "$CCACHE_DIR" </dev/null
}
# The mirror may be a copy of an older day: what apt says here about dates, and its proxies, holds inside, too.
begin() {   # system
    [ -e "$folder/$1/ready" ] && return
    rm -rf "${folder:?}/$1"
    debootstrap --variant=minbase "$1" "$folder/$1" "$MIRROR" || return 1
    apt-config dump | grep -iE '^Acquire::(Check-|https?::)' >"$folder/$1/etc/apt/apt.conf.d/90as-outside"
    if [ -n "$CCACHE_DIR" ]; then inside "$1" 'apt-get update && apt-get install -y ccache' || return 1; fi
    touch "$folder/$1/ready"
}
copy() {   # system: what is in git, without what earlier runs left
    rm -rf "$folder/$1/root/harmorph" && mkdir -p "$folder/$1/root/harmorph" &&
        git ls-files -z | tar cf - --null -T - | tar xf - -C "$folder/$1/root/harmorph"
}
for system in $SYSTEMS; do
    out=$folder/$system.log
    check "$system: debootstrap" begin "$system" || continue
    [ -e "$folder/$system/ready" ] || continue
    check "$system: the sources" copy "$system"
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
