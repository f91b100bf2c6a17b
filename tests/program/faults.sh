#!/bin/sh
# usage: faults.sh path/to/harmorph path/to/meshes folder/for/output
# What happens to files when something fails: no room at any size, a kill at any write, unwritable and strange places.
# An output is whole or absent, other files are as before, and the message names the file.
harmorph=$1 meshes=$2 tmp=$3
case $harmorph in /*) ;; *) harmorph=$PWD/$harmorph ;; esac
mesh=$(cd "$meshes" && pwd)/naca0012.su2
topic=faults
. "$(dirname "$0")/../count.sh"
rm -rf "$tmp"
mkdir -p "$tmp" && cd "$tmp" || exit 1
run() { "$harmorph" "$@" >out 2>err; }   # leaves the exit code

# The good files, in a folder of their own; every command below must leave these bytes or nothing.
mkdir good
run fit "$mesh" --marker airfoil -o good/a.curve; passes "fit" $?
run solve "$mesh" --curve airfoil=good/a.curve -o good/a.basis; passes "solve" $?
echo "3 0.002 0.004" >moves.txt
run morph "$mesh" good/a.basis --move moves.txt -o good/m.su2; passes "morph" $?

command_for() {   # name of an output: the words of the command that writes it as $2
    case $1 in
        a.curve) run fit "$mesh" --marker airfoil -o "$2" ;;
        a.basis) run solve "$mesh" --curve airfoil=good/a.curve -o "$2" ;;
        m.su2) run morph "$mesh" good/a.basis --move moves.txt -o "$2" ;;
    esac
}

# No file may have more than so many blocks of 512 bytes: writes fail, or (without the trap) the process is killed.
for name in a.curve a.basis m.su2; do
    blocks=$((($(wc -c <good/$name) + 511) / 512))
    for part in 0 1 2 3; do
        room=$((blocks * part / 4))
        for way in fails killed; do
            rm -rf place && mkdir place && echo old >place/$name
            {
                (
                    if [ $way = fails ]; then trap '' XFSZ; fi
                    ulimit -c 0
                    ulimit -f $room
                    command_for $name place/$name
                )
                status=$?
            } 2>shell_says
            passes "$name in $room blocks, $way: exit code $status" "$([ $status -gt 1 ]; echo $?)"
            if [ "$(cat place/$name)" = old ] || cmp -s place/$name good/$name; then whole=0; else whole=1; fi
            passes "$name in $room blocks, $way: neither the old file nor the new one" $whole
            if [ $way = fails ]; then
                passes "$name in $room blocks: something is left beside" "$([ "$(ls -A place)" = $name ]; echo $?)"
            fi
        done
    done
done
if [ -c /dev/full ]; then
    command_for m.su2 /dev/full
    status=$?
    passes "/dev/full: exit code $status" "$([ $status = 3 ]; echo $?)"
    passes "/dev/full is not named" "$(grep -q /dev/full err; echo $?)"
fi

# Killed at each system call that has to do with files, and each write refused because the disk is full.
system_calls=openat,read,write,lseek,fstat,newfstatat,close,rename,unlink,fsync,fchmod,chmod,ftruncate
under_strace() {   # what to inject, command...: leaves the exit code
    inject=$1; shift
    strace -f -qq -o trace -e trace=$system_calls -e inject="$inject" "$harmorph" "$@" >out 2>err
}
arguments() {   # name of an output, where it is written
    case $1 in
        a.curve) echo "fit $mesh --marker airfoil -o $2" ;;
        a.basis) echo "solve $mesh --curve airfoil=good/a.curve -o $2" ;;
        m.su2) echo "morph $mesh good/a.basis --move moves.txt -o $2" ;;
    esac
}
if strace -f -qq -o trace -e trace=$system_calls "$harmorph" --version >out 2>err; then
    for name in a.curve a.basis m.su2; do
        rm -rf place && mkdir place
        strace -f -qq -o trace -e trace=$system_calls "$harmorph" $(arguments $name place/$name) >out 2>err
        n=$(grep -c '(' trace)
        first=$(grep -n '"place' trace | head -n 1 | cut -d: -f1)   # before it, nothing can be left in the folder
        begin=$((first > 3 ? first - 3 : 1)) bad=0
        for call in $(seq $begin $((n + 1))); do
            rm -rf place && mkdir place && echo old >place/$name
            under_strace "$system_calls:signal=KILL:when=$call" $(arguments $name place/$name) 2>shell_says
            [ "$(cat place/$name)" = old ] || cmp -s place/$name good/$name || bad=$((bad + 1))
        done 2>shell_says
        passes "$name, killed at each of the calls $begin to $n: $bad times neither the old file nor the new one" \
            $((bad > 0))
        writes=$(grep -c 'write(' trace) bad=0
        for call in $(seq 1 "$writes"); do
            rm -rf place && mkdir place && echo old >place/$name
            under_strace "write:error=ENOSPC:when=$call" $(arguments $name place/$name)
            status=$?
            if grep -q 'write([3-9].*INJECTED' trace; then   # not a word to the terminal
                [ $status = 3 ] && [ "$(cat place/$name)" = old ] && grep -q "$name" err &&
                    [ "$(ls -A place)" = $name ] || bad=$((bad + 1))
            fi
        done
        passes "$name, the disk full at each of $writes writes: $bad times not the old file alone and exit code 3" \
            $((bad > 0))
    done
else
    skip "kills at each system call and full disks at each write" "strace is not installed or may not trace"
fi

# All outputs of one command, or none: one of them cannot be written, or cannot take its place.
outputs="-o m.su2 --curve-out m.curve --vtu m.vtu --svg m.svg --boundary-svg b.svg --csv m.csv --report r.html"
names="b.svg m.csv m.curve m.su2 m.svg m.vtu r.html"
morph_all="morph $mesh good/a.basis --move moves.txt $(echo "$outputs" | sed 's| \([mbr]\.\)| place/\1|g')"
old_place() {   # a folder where every second output has an older file
    rm -rf place && mkdir place
    for name in b.svg m.curve m.svg r.html; do echo "old $name" >place/$name; done
}
as_before() {   # the older files alone, with their text
    [ "$(ls -A place | tr '\n' ' ')" = "b.svg m.curve m.svg r.html " ] &&
        for name in b.svg m.curve m.svg r.html; do [ "$(cat place/$name)" = "old $name" ] || return 1; done
}
all_new() { [ "$(ls -A place | tr '\n' ' ')" = "$names " ] && ! grep -l '^old' place/*; }
for name in $names; do
    old_place
    run $(echo "$morph_all" | sed "s|place/$name|missing/$name|")
    status=$?
    passes "one output of seven cannot be written: exit code $status for $name" "$([ $status = 3 ]; echo $?)"
    passes "one output of seven cannot be written: $name is not named" "$(grep -q "missing/$name" err; echo $?)"
    passes "one output of seven cannot be written: $name; others are" "$(as_before; echo $?)"
done
old_place
run $morph_all
passes "seven outputs" $?
passes "seven outputs: not the new files alone" "$(all_new; echo $?)"
if strace -f -qq -o trace -e trace=rename "$harmorph" --version >out 2>err; then
    for place in 1 2 3 4 5 6 7; do
        old_place
        strace -f -qq -o trace -e trace=rename -e inject=rename:error=EPERM:when=$place \
            "$harmorph" $morph_all >out 2>err
        status=$?
        passes "output $place of seven cannot take its place: exit code $status" "$([ $status = 3 ]; echo $?)"
        passes "output $place of seven cannot take its place: others have" "$(as_before; echo $?)"
    done
    # Ended at every third system call: the old files, or the new ones, and nothing beside them.
    old_place
    strace -f -qq -o trace -e trace=$system_calls "$harmorph" $morph_all >out 2>err
    n=$(grep -c '(' trace)
    first=$(grep -n '"place' trace | head -n 1 | cut -d: -f1)
    for signal in TERM INT HUP; do
        bad=0
        for call in $(seq $((first - 2)) 3 $((n + 1))); do
            old_place
            under_strace "$system_calls:signal=$signal:when=$call" $morph_all 2>shell_says
            as_before || all_new || bad=$((bad + 1))
        done 2>shell_says
        passes "ended by $signal at a call from $first to $n: $bad times not all outputs or none" $((bad > 0))
    done
    # Another program shortens a file just after it was mapped, which takes a second here.
    for size in 0 5000; do
        cp "$mesh" shrinking.su2
        (sleep .4; truncate -s $size shrinking.su2) &
        strace -f -qq -o trace -P shrinking.su2 -e trace=mmap -e inject=mmap:delay_exit=1000000 \
            "$harmorph" convert shrinking.su2 converted.msh >out 2>err
        code=$?
        wait
        passes "a file that another program shortens to $size bytes: exit code 3" $((code != 3))
        passes "a file that shrinks: its name" "$(grep -q 'shrinking.su2: cannot be read' err; echo $?)"
        passes "a file that shrinks: no output" "$(ls | grep -c converted)"
    done
else
    skip "outputs that cannot take their places, and signals" "strace is not installed or may not trace"
fi
(trap '' TERM; under_strace "write:signal=TERM:when=3" $morph_all)
passes "a signal that is ignored" "$(all_new; echo $?)"

# An output keeps the permissions of the file that it replaces, and while it is written only its owner may read it. A
# link stays a link.
mode() { stat -c %a "$1"; }
for name in a.curve a.basis m.su2; do
    for permissions in 600 640 400 664 755; do
        rm -rf place && mkdir place && echo old >place/$name && chmod $permissions place/$name
        command_for $name place/$name
        passes "$name over a file of mode $permissions" $?
        passes "$name over a file of mode $permissions: has mode $(mode place/$name)" \
            "$([ "$(mode place/$name)" = $permissions ] && cmp -s place/$name good/$name; echo $?)"
    done
    for mask in 022 077; do
        rm -rf place && mkdir place
        (umask $mask && command_for $name place/$name)
        passes "a new $name: mode $(mode place/$name)" \
            "$([ "$(mode place/$name)" = "$(printf '%o' $((0666 & ~0$mask)))" ]; echo $?)"
    done
    rm -rf place && mkdir place && echo old >place/file && chmod 600 place/file && ln -s file place/$name
    command_for $name place/$name
    passes "$name over a link" "$([ -L place/$name ] && [ "$(mode place/file)" = 600 ] &&
        cmp -s place/file good/$name; echo $?)"
    rm -rf place && mkdir place && ln -s file place/$name
    command_for $name place/$name
    passes "$name over a link to no file" "$([ -L place/$name ] && cmp -s place/file good/$name; echo $?)"
    if [ "$(id -u)" = 0 ]; then
        rm -rf place && mkdir place && echo old >place/$name && chown 65534:65534 place/$name
        command_for $name place/$name
        passes "$name over a file of another user" "$([ "$(stat -c %u:%g place/$name)" = 65534:65534 ]; echo $?)"
    fi
    if strace -f -qq -o trace -e trace=$system_calls "$harmorph" --version >out 2>err; then
        rm -rf place && mkdir place && echo old >place/$name && chmod 644 place/$name
        strace -f -qq -o trace -e trace=fchmodat,chmod,fchmod -e inject=fchmodat,chmod,fchmod:signal=KILL:when=1 \
            "$harmorph" $(arguments $name place/$name) >out 2>shell_says
        passes "$name while it is written: mode $(mode place/$name.part*)" \
            "$([ "$(mode place/$name.part*)" = 600 ]; echo $?)" 2>shell_says
    fi
done

# Places that are no files.
mkdir -p folder
for name in a.curve a.basis m.su2; do
    for place in folder missing/$name "$(printf '%0300d' 0)" "$(printf 'missing/%.0s' $(seq 700))$name" \
        /dev/null/$name; do
        command_for $name "$place"
        status=$?
        passes "$name to $place: exit code $status" "$([ $status = 3 ]; echo $?)"
        passes "$name to $place: no reason" "$([ "$(wc -l <err)" -ge 1 ]; echo $?)"
    done
done
# The superuser writes everywhere: nobody does not, in a folder that everybody may enter.
sealed() {   # folder with an unwritable one, how to begin a command
    folder=$1; shift
    mkdir -p "$folder/sealed" && chmod 555 "$folder/sealed"
    (cd "$folder" && "$@" fit "$mesh_there" --marker airfoil -o sealed/a.curve) >out 2>err
    status=$?
    passes "an unwritable folder: exit code $status" "$([ $status = 3 ]; echo $?)"
    passes "an unwritable folder is not named" "$(grep -q sealed err; echo $?)"
}
nobody="setpriv --reuid 65534 --regid 65534 --clear-groups"
if [ "$(id -u)" != 0 ]; then
    mesh_there=$mesh
    sealed . "$harmorph"
elif $nobody true 2>/dev/null; then
    open_to_all=$(mktemp -d) && chmod 755 "$open_to_all" && cp "$harmorph" "$mesh" "$open_to_all/"
    mesh_there=$(basename "$mesh")
    sealed "$open_to_all" $nobody "./$(basename "$harmorph")"
    rm -rf "$open_to_all"
else
    skip "unwritable folders" "the superuser writes there, and setpriv is not installed"
fi
for input in folder /dev/null missing.su2; do
    run check "$input"
    status=$?
    passes "$input as a mesh: exit code $status" "$([ $status = 3 ]; echo $?)"
    passes "$input is not named" "$(grep -q "$input" err; echo $?)"
    for what in curve basis moves; do
        case $what in
            curve) run solve "$mesh" --curve airfoil="$input" -o never ;;
            basis) run morph "$mesh" "$input" --move moves.txt -o never ;;
            moves) run morph "$mesh" good/a.basis --move "$input" -o never ;;
        esac
        status=$?
        passes "$input as a file of $what: exit code $status" "$([ $status = 3 ]; echo $?)"
        passes "$input as a file of $what is not named" "$(grep -q "$input" err; echo $?)"
        passes "$input as a file of $what: something is written" "$([ ! -e never ]; echo $?)"
        rm -f never
    done
done

# The mesh goes through a pipe to and from the program, and is read with CR LF.
"$harmorph" morph "$mesh" good/a.basis --move moves.txt -o /dev/stdout 2>/dev/null | cat >piped
passes "a mesh to a pipe" "$(head -c "$(wc -c <good/m.su2)" piped | cmp -s - good/m.su2; echo $?)"
mkfifo fifo
cat "$mesh" >fifo &
run check fifo
status=$?
passes "a mesh from a pipe: exit code $status" "$([ $status = 0 ] || [ $status = 3 ]; echo $?)"
kill $! 2>/dev/null
"$harmorph" morph "$mesh" good/a.basis --move moves.txt -o /dev/stdout 2>/dev/null | head -c 100 >beginning
passes "a pipe that nobody reads on from" "$([ "$(wc -c <beginning)" = 100 ]; echo $?)"
sed 's/$/\r/' "$mesh" >crlf.su2
sed 's/$/\r/' moves.txt >crlf.txt
run morph crlf.su2 good/a.basis --move crlf.txt -o crlf_moved.su2
passes "lines that end with CR LF" $?
tr -d '\r' <crlf_moved.su2 >without_cr
passes "lines that end with CR LF: the same mesh" "$(cmp -s without_cr good/m.su2; echo $?)"
# Every file of the demo, and what commands print as JSON, where the decimal sign is a comma, and where the small letter
# of I has no dot.
all_outputs() {   # folder: the demo in it, and what is printed; the times are taken out
    rm -rf demo
    run demo demo --mesh "$mesh" || return 1
    "$harmorph" check "$mesh" --json >demo/check.json
    "$harmorph" curve demo/airfoil.curve --stations .25,.5 --json >demo/curve.json
    "$harmorph" variables demo/airfoil.curve --naca .4 -o demo/map --json >demo/map.json
    "$harmorph" fit "$mesh" --marker airfoil -o demo/CURVE.IGS >/dev/null
    "$harmorph" convert "$mesh" demo/new.vtu >/dev/null
    sed -i 's/"seconds": [^,}]*//g' demo/report.html
    rm -rf "$1" && mv demo "$1"
}
all_outputs locale_of_c
passes "the demo where the decimal sign is a point" $?
for name in de_DE tr_TR; do
    if localedef -i $name -f UTF-8 ./$name.UTF-8 >/dev/null 2>&1; then
        passes "$name has a decimal comma" \
            "$([ "$(LOCPATH=$PWD LC_ALL=$name.UTF-8 locale decimal_point)" = , ]; echo $?)"
        (export LOCPATH="$PWD" LC_ALL=$name.UTF-8 && all_outputs locale_of_$name)
        passes "the demo, $name" $?
        diff -rq locale_of_c locale_of_$name >differences
        passes "the demo, $name: other files" $? differences
    else
        skip "the locale $name" "there is no localedef, or no Debian package locales"
    fi
done

finish
