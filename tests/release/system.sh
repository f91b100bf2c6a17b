# Sourced by the scripts that run something in fresh systems, which debootstrap makes in the folder $folder, as the
# superuser. MIRROR: where packages come from, otherwise as the system's apt has it; CCACHE_DIR: a compiler cache that
# the systems share. Systems that are in the folder are used again. alone=--net: without a network.
: "${MIRROR=}" "${CCACHE_DIR=}" "${alone=}"
for tool in debootstrap unshare chroot; do
    command -v $tool >/dev/null || { echo "$tool not found: install Debian's debootstrap and util-linux"; exit 1; }
done
[ -n "$MIRROR" ] || MIRROR=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Label: Debian' |
    head -n 1)
inside() {   # system, command: with /dev and /proc of its own, which end with the command; $alone: options of unshare
    unshare --mount --pid $alone --fork sh -c 'root=$1
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
unpack() {   # system: the sources from the tarball of `make dist`, without what earlier runs left
    rm -rf "$folder/$1/root/harmorph"
    sh c_api/packaging/dist.sh harmorph | tar xz -C "$folder/$1/root"
}
